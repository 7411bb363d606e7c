"""Checks of energies and free vibration of the wall: 4-5, 4-17 to 4-26, 4-44, B-4, B-8 to B-13."""

import math
from collections.abc import Callable, Iterable
from functools import cache

import numpy as np
import sympy as sp
from scipy.integrate import quad
from sympy import Rational, cos, sin

from rockeom.analysis.formulas.controlled_wall import Wall
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.approximations import leads
from rockeom.thesis.checks.check import Finding, Findings, close, derived, reproduced, vanishes
from rockeom.thesis.equation import Equation, fractions
from rockeom.thesis.wall_tests import quarter_period_fit

# --- 4-18 to 4-22, B-4, B-8: energies


def elastic_energy(force: sp.Expr, start: sp.Expr = wall.FORCE) -> sp.Expr:
    """Energy of the elastic tendon above that at the force `start` [J]."""
    return (force**2 - start**2) / (2 * wall.STIFFNESS)


@cache
def potential(start: sp.Rational = wall.FORCE) -> sp.Expr:
    """U + U_E of Delta [J], by 4-18 with the elastic tendon of 4-16."""
    force = wall.right("4-16").subs(th.P_initial, start)
    return wall.right("4-18") / 1000 + elastic_energy(force, start)


@cache
def potential_energy() -> Callable:
    """U + U_E [J] as a function of numbers Delta [mm]."""
    return wall.of_displacement(potential())


@cache
def restoring_force() -> Callable:
    """F_k of Delta > 0 [kN], the derivative of `potential_energy`."""
    size = sp.Symbol("size", positive=True)
    force = sp.diff(potential().subs(th.Delta, size), size)
    return sp.lambdify(size, force.subs(wall.WALL), "numpy")


def _rise_of_centroid(equation: Equation, relation: sp.Eq) -> Findings:
    """U = m g times the rise of the centroid; 4-18 omits its descent on the circle."""
    weight = th.m_T * th.g
    omitted = weight * th.H_c * (1 - cos(th.theta))
    for side in equation.sides:
        rise = wall.turned(side, th.d_lifted - th.B, th.H_c)[1].subs(th.d_lifted, wall.lifted())
        rest = (relation.rhs - weight * rise - omitted).subs(th.B, wall.HALF_WIDTH)
        yield vanishes(
            "thesis minus exact minus the term it omits", wall.placed(rest, side), wall.reduced
        )
    yield from leads(omitted, sp.S.Zero, (th.theta,), 2, weight * th.H_c * th.theta**2 / 2)
    energy = wall.of_displacement(relation.rhs / 1000)(wall.FALL)
    lost = omitted.subs(wall.WALL).subs(th.theta, math.asin(wall.FALL / wall.HEIGHT)) / 1000
    yield close("U at 30.41 mm in J", energy, 101.7, 0.1)
    yield close("omitted from it", float(lost), 3.34, 0.01)


@cache
def inertia_over_height() -> tuple[float, float, float, float]:
    """Exact inertia of 4-19 over H**2 [kg]: upright, its maximum, where, once rocking is developed.

    The centroid of the wall whose centre of rotation moves by 4-8 also moves as O does.
    """
    angle = sp.asin(th.Delta / wall.HEIGHT)
    lever = (wall.lifted() - wall.HALF_WIDTH).subs(th.theta, angle)
    x = lever * (1 - cos(angle)) + wall.CENTROID * sin(angle)
    y = lever * sin(angle) + wall.CENTROID * cos(angle)
    moving = sp.diff(x, th.Delta) ** 2 + sp.diff(y, th.Delta) ** 2
    own = wall.corner_inertia() - float(wall.MASS) * wall.radius() ** 2
    mass = wall.of_displacement(wall.MASS * moving + own * 1e6 * sp.diff(angle, th.Delta) ** 2)
    at = np.linspace(0.01, 30, 3000)
    values = mass(at)
    top = int(values.argmax())
    return float(values[0]), float(values[top]), float(at[top]), float(values[-1])


def _kinetic_energy(equation: Equation, relation: sp.Eq) -> Findings:
    rate = th.Delta_d / sp.sqrt(th.H**2 - th.Delta**2)
    error = th.I_o * th.Delta_d**2 * th.Delta**2 / (2 * th.H**4)
    yield from leads(th.I_o * rate**2 / 2, relation.rhs, (th.Delta,), 2, error)
    size = float((error / relation.rhs).subs({**wall.WALL, th.Delta: wall.FALL}))
    yield close("the same at 30.41 mm, over the value", size, 1.56e-4, 1e-6)
    numbers = {th.I_o: wall.corner_inertia(), th.H: wall.HEIGHT / 1e3, th.Delta_d: 1}
    constant = float(2 * relation.rhs.subs(numbers))
    upright, largest, where, developed = inertia_over_height()
    for place, exact, excess in (
        ("upright", upright, 0.045),
        (f"at {where:.2f} mm", largest, -0.0155),
        ("once developed", developed, 0.0148),
    ):
        what = f"excess of a constant I_o about the corner, O moving, {place}"
        yield close(what, constant / exact - 1, excess, 5e-4)


def _conserved(equation: Equation, relation: sp.Eq) -> Findings:
    """Check that the energy 4-22 with 4-19 is constant in the motion 4-27 under 4-30 alone."""
    path = sp.Function("Delta")(th.t)
    U, U_E = (sp.Function(name) for name in ("U", "U_E"))
    kinetic = wall.right("4-19").subs(th.Delta_d, path.diff(th.t))
    total = relation.rhs.subs({th.U_of: U(path), th.U_E_of: U_E(path), th.E_k_of: kinetic})
    force = wall.right("4-30").subs(th.Delta, path).doit()
    (motion,) = EQUATIONS["4-27"].right
    free = motion.lhs.subs({th.F_damp: 0, th.F_k: force, th.M_e: th.I_o / th.H**2})
    (solved,) = sp.solve(free, th.Delta_dd)
    power = total.diff(th.t).subs(path.diff(th.t, 2), solved).doit()
    at_rest = {th.E_k_of: 0, th.U_of: th.U_start, th.U_E_of: th.U_E_start}
    yield vanishes("4-22 at rest minus 4-21", relation.rhs.subs(at_rest) - wall.right("4-21"))
    yield vanishes("rate of the total energy", power, sp.simplify)


# --- 4-20, 4-44, B-9 to B-13: the tendon, and the inertia

BEFORE, AFTER = (0.0, 0.6, 0.97, 0.99), (1.01, 1.7, 4.0)
"""Extensions of the tendon before and after it yields, over that at yield."""


def work(start: sp.Rational, places: Iterable[float]) -> check.Find:
    """Check the energies [J] against the work of an elastic-plastic tendon from a force on."""

    def find(equation: Equation, *relations: sp.Eq) -> Findings:
        reserve = (wall.YIELD - start) / wall.STIFFNESS
        for place in places:
            stretch = place * reserve
            force = min(start + wall.STIFFNESS * stretch, wall.YIELD)
            exact = elastic_energy(force, start) + wall.YIELD * max(stretch - reserve, 0)
            for relation in relations:
                stated = relation.rhs.doit().subs(wall.WALL)
                value = float(stated.subs({th.P_tendon: force, th.extension: stretch}))
                yield close(f"energy in J at {float(stretch):.3g} mm", value, float(exact), 0.02)

    return find


def _extension(equation: Equation, relation: sp.Eq) -> Findings:
    strain = relation.rhs / th.L_T
    rest = strain * th.E_tendon * th.A_tendon - th.P_tendon
    yield vanishes("stress of the stated strain times A, minus the force", rest, sp.simplify)
    for force, extension in ((wall.FORCE, 6.4564), (wall.YIELD, 13.5814)):
        by_equation = float(relation.rhs.subs(wall.WALL).subs(th.P_tendon, force))
        yield close(f"extension in mm at {float(force)} kN", by_equation, extension, 5e-5)


METRES = {th.H: wall.HEIGHT / 1e3, th.B: wall.HALF_WIDTH / 1e3}
CORNER, DEVELOPED, UPRIGHT = (
    d / 1e3 for d in (2 * wall.HALF_WIDTH, wall.HALF_WIDTH + wall.VANISHES, wall.HALF_WIDTH)
)
"""Lengths d that have lifted [m]."""


def _inertia(equation: Equation, relation: sp.Eq) -> Findings:
    about = sp.lambdify(th.d_lifted, relation.rhs.subs(METRES))
    yield close("reduction of I_o, upright", 1 - about(UPRIGHT) / about(DEVELOPED), 0.03, 0.002)
    way = np.linspace(UPRIGHT, CORNER, 51)
    ratio = about(way) / np.hypot(way - METRES[th.B], wall.CENTROID / 1e3)
    change = float(ratio.max() / ratio.min() - 1)
    yield Finding("change of I_o/R on its way, below 2 % by 4.7", change, 0 < change < 0.02)
    arm = 2 * float(wall.MASS) * METRES[th.B] ** 2 / about(CORNER)
    yield close("r of 2-6 about the corner, 0.835 by 4.9.2.1", (1 - arm) ** 2, 0.835, 5e-4)


def parallel_axes(side: int) -> sp.Expr:
    """Inertia of a panel that has lifted up to its far edge, and of a mass on its centreline."""
    across, up = sp.symbols("across up")
    panel = sp.integrate(
        (across**2 + up**2) / (th.d_lifted * th.H), (across, 0, th.d_lifted), (up, 0, th.H)
    )
    added = Rational("2.537") ** 2 + (th.d_lifted - th.B) ** 2
    return 686 + Rational("577.56") * panel + 442 + Rational("1438.5") * added


# --- 4-23 to 4-26: the motion without losses


def _speed(peak: tuple[sp.Symbol, ...], place: tuple[sp.Symbol, ...]) -> check.Find:
    """Check that the energy 4-22 at a place is that of the peak, and the root the positive one."""

    def find(equation: Equation, relation: sp.Eq) -> Findings:
        kinetic = wall.right("4-19").subs(th.Delta_d, relation.rhs)
        total = wall.right("4-22").subs({th.U_of: place[0], th.U_E_of: place[1]})
        rest = total.subs(th.E_k_of, kinetic) - sum(peak)
        yield vanishes("energy minus that of the peak", rest, sp.simplify)
        numbers = dict.fromkeys(place, 1) | dict.fromkeys(peak, 2)
        yield check.positive("the speed at half of the energy", relation.rhs.subs(numbers))

    return find


def _time(equation: Equation, relation: sp.Eq) -> Findings:
    (step,) = sp.solve(relation.lhs - relation.rhs, th.step)
    rest = step.diff(th.Delta_end) * sp.Function(r"\dot{\Delta}")(th.Delta_end) - 1
    yield vanishes("growth with Delta_end, times the velocity, minus 1", rest, sp.simplify)
    yield vanishes("time of no way", step.subs(th.Delta_end, th.Delta_start).doit())


# --- 4-5, 4-17: quarter periods


def _quarters() -> tuple[np.ndarray, np.ndarray]:
    """Peaks (22,) [mm] and times from them to the next crossing (22,) [s]."""
    peak, time = wall.measured().quarter_periods()
    return 1e3 * np.abs(peak), time


def quarter(relation: sp.Eq) -> sp.Expr:
    """A quarter of the period that a relation states."""
    return sp.solve(relation.lhs - th.t, th.period)[0].subs(th.t, relation.rhs) / 4


def _quarter_fit(equation: Equation, relation: sp.Eq) -> Findings:
    stated = wall.of_displacement(quarter(relation))
    peak, time = _quarters()
    yield close("R**2 of Table A-1", wall.r_squared(time, stated(peak)), 0.976, 0.006)
    rms = float(np.sqrt(np.mean((stated(peak) - time) ** 2)))
    yield Finding("rms error in s, below half of a sample, 0.0025", rms, rms < 0.0025)
    for at, hertz in ((1.62, 11), (wall.FALL, 4)):
        yield close(f"frequency at {at} mm", 1 / (4 * stated(at)), hertz, 0.2)
    apart = np.abs(stated(peak) - quarter_period_fit(peak / 1e3)).max()
    yield close("against the shipped function", float(apart), 0, 1e-12)


@cache
def conservative_quarter(start: float, mass: float) -> float:
    """Time in which the wall falls from rest at `start` [mm] to upright, by energy [s].

    Integrated over v, Delta = start (1 - v**2), in which the start is no singularity.
    """
    energy, force = potential_energy(), restoring_force()

    def time(v: float) -> float:
        if v < 1e-4:
            work = force(start) * start * v**2
        else:
            work = energy(start) - energy(start * (1 - v**2))
        return 2 * start * 1e-3 * v / math.sqrt(2 * work / mass)

    return quad(time, 0, 1, epsabs=1e-8)[0]


def quarter_by_weight(relation: sp.Eq) -> Callable:
    """4-17 [s] as a function of Delta [mm]."""
    numbers = {
        th.I_o: wall.corner_inertia(),
        th.R: wall.radius(),
        th.P_tendon: 1000 * wall.right("4-16"),
        th.T_fixed_base: Rational("0.0428"),
        th.d_lifted: wall.lifted().subs(th.penalty, wall.PENALTY),
    }
    whole = quarter(relation).subs(numbers)
    return wall.of_displacement(whole.subs(th.theta, sp.asin(th.Delta / wall.HEIGHT)))


def _substitute_gravity(equation: Equation, relation: sp.Eq) -> Findings:
    stated, (peak, time) = quarter_by_weight(relation), _quarters()
    yield close("R**2 of Table A-1", wall.r_squared(time, stated(peak)), 0.911, 0.01)
    fixed = relation.rhs.subs(th.Delta, 0) - th.T_fixed_base / 4
    yield vanishes("quarter period from upright minus that of the fixed base", fixed)
    mass = wall.corner_inertia() / METRES[th.H] ** 2
    for at, size in ((10.0, -0.0495), (20.0, -0.1337), (wall.FALL, -0.1628)):
        error = stated(at) / conservative_quarter(at, mass) - 1
        yield close(f"error over the time by energy from {at} mm", error, size, 5e-4)
    shipped = Wall.thesis().quarter_period_substitute_gravity(peak / 1e3)
    yield close(
        "against the shipped wall", float(np.abs(stated(peak) / shipped - 1).max()), 0, 1e-9
    )


# --- the checks of each equation

_TENDON_WORK = "work of the elastic-plastic tendon"
_RISE = derived(
    wall.TURNED,
    _rise_of_centroid,
    "order 2 in theta: 3.34 of 101.7 J at 30.41 mm, the centroid's descent H_c (1 - cos)",
)
_KINETIC = derived(
    "kinetic energy of the wall about a fixed and a moving O",
    _kinetic_energy,
    "order 2 in Delta/H, 0.016 % at 30.41 mm, for a fixed O; where O moves, with a constant I_o "
    "about the corner, +4.5 % upright, -1.5 % at 4.35 mm, +1.5 % once rocking is developed",
)

CHECKS: check.Checks = {
    "4-5": reproduced(
        "quarter periods of Table A-1",
        _quarter_fit,
        "a fit: rms 2.2 ms over the 22 quarter periods of Table A-1, R2 0.971 (0.976 printed)",
    ),
    "4-17": reproduced(
        "quarter periods of Table A-1, and those by energy",
        _substitute_gravity,
        "an estimate without an order: 5, 13 and 16 % shorter than 4-24 at 10, 20 and 30.41 mm",
    ),
    "4-18": _RISE,
    "4-19": _KINETIC,
    "4-20": derived(_TENDON_WORK, work(wall.FORCE, BEFORE + AFTER)),
    "4-21": derived("4-22 at rest", check.states(th.U_start + th.U_E_start)),
    "4-22": derived("constant in the motion 4-27 without losses", _conserved),
    "4-23": derived("4-22 is 4-21", _speed((th.U_start, th.U_E_start), (th.U_of, th.U_E_of))),
    "4-24": derived("derivative by its end", _time),
    "4-25": check.transcribed("the words of 4.7", check.states(th.Delta_peak * Rational(25, 100))),
    "4-26": derived(
        "4-22 there is that of the peak",
        _speed((th.U_peak, th.U_E_peak), (th.U_limit, th.U_E_limit)),
    ),
    "4-44": derived(_TENDON_WORK, work(wall.LATER_FORCE, BEFORE + AFTER)),
    "B-4": _RISE,
    "B-8": _KINETIC,
    "B-9": (
        derived(
            "a panel, and a mass on its centreline",
            check.states(parallel_axes, put=lambda expr, side: fractions(expr).doit()),
        ),
        reproduced("what the text says of I_o, I_o/R and r", _inertia),
    ),
    "B-10": derived(
        "area below the force", check.states(th.k * (th.x_1 + th.x_2) / 2 * (th.x_2 - th.x_1))
    ),
    "B-11": derived("Hooke's law; the extensions of B.3", _extension),
    "B-12": derived(_TENDON_WORK, work(wall.FORCE, BEFORE)),
    "B-13": derived(_TENDON_WORK, work(wall.FORCE, AFTER)),
}
