"""Checks of 4-5, 4-17 to 4-26 and 4-44: quarter periods and motion without losses."""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import sympy as sp
from scipy.integrate import quad, solve_ivp
from sympy import Rational, cos, sin

from rockeom.analysis.formulas.controlled_wall import Wall
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.approximations import taylor
from rockeom.thesis.checks.check import Finding, Findings, close, derived, reproduced, vanishes
from rockeom.thesis.equation import Equation
from rockeom.thesis.printed import TABLES
from rockeom.thesis.wall_tests import quarter_period_fit

# --- 4-18 to 4-22, 4-44: energies


@cache
def potential_energy(start: sp.Rational = wall.FORCE) -> Callable:
    """U + U_E of Delta [J], by 4-18 with the elastic tendon of 4-16."""
    force = wall.right("4-16").subs(th.P_initial, start)
    elastic = (force**2 - start**2) / (2 * wall.STIFFNESS)
    return wall.of_displacement(wall.right("4-18") / 1000 + elastic)


@cache
def restoring_force() -> Callable:
    """F_k of Delta > 0 [kN], the derivative of `potential_energy`."""
    size = sp.Symbol("size", positive=True)
    elastic = (wall.right("4-16") ** 2 - wall.FORCE**2) / (2 * wall.STIFFNESS)
    whole = (wall.right("4-18") / 1000 + elastic).subs(th.Delta, size)
    return sp.lambdify(size, sp.diff(whole, size).subs(wall.WALL), "numpy")


def rise_of_centroid(equation: Equation, relation: sp.Eq) -> Findings:
    """U = m g times the rise of the centroid; 4-18 omits its descent on the circle."""
    for side in equation.sides:
        rise = wall.turned(side, th.d_lifted - th.B, th.H_c)[1]
        exact = th.m_T * th.g * rise.subs(th.B, wall.HALF_WIDTH).subs(th.d_lifted, wall.lifted())
        omitted = th.m_T * th.g * th.H_c * (1 - cos(th.theta))
        rest = relation.rhs.subs(th.B, wall.HALF_WIDTH) - exact - omitted
        yield vanishes(
            "thesis minus exact minus the term it omits", wall.placed(rest, side), wall.reduced
        )
        *below, leading = taylor(omitted, (th.theta,), 2)
        yield vanishes("the term it omits below order 2", sum(below))
        stated = th.m_T * th.g * th.H_c * th.theta**2 / 2
        yield vanishes("its term of order 2 minus the stated one", leading - stated, sp.simplify)
        energy = wall.of_displacement(relation.rhs / 1000)(wall.FALL)
        lost = omitted.subs(wall.WALL).subs(th.theta, math.asin(wall.FALL / wall.HEIGHT)) / 1000
        yield close("U at 30.41 mm in J", energy, 101.7, 0.1)
        yield close("omitted from it", float(lost), 3.34, 0.01)


@cache
def inertia_over_height() -> tuple[float, float, float, float]:
    """Exact inertia of 4-19 over H**2 [kg]: upright, its maximum, where, once rocking is developed.

    The centroid of the wall whose centre of rotation moves by 4-8 also moves as O does.
    """
    lever = (wall.lifted() - wall.HALF_WIDTH).subs(th.theta, sp.asin(th.Delta / wall.HEIGHT))
    angle = sp.asin(th.Delta / wall.HEIGHT)
    x = lever * (1 - cos(angle)) + wall.CENTROID * sin(angle)
    y = lever * sin(angle) + wall.CENTROID * cos(angle)
    moving = sp.diff(x, th.Delta) ** 2 + sp.diff(y, th.Delta) ** 2
    own = wall.corner_inertia() - float(wall.MASS) * wall.radius() ** 2
    whole = wall.MASS * moving + own * 1e6 * sp.diff(angle, th.Delta) ** 2
    mass = wall.of_displacement(whole)
    at = np.linspace(0.01, 30, 3000)
    values = mass(at)
    top = int(values.argmax())
    return float(values[0]), float(values[top]), float(at[top]), float(values[-1])


def kinetic_energy(equation: Equation, relation: sp.Eq) -> Findings:
    fixed = th.I_o * (th.Delta_d / (th.H * cos(th.theta))) ** 2 / 2
    exact = fixed.subs(th.theta, sp.asin(th.Delta / th.H))
    *below, leading = taylor(sp.simplify(exact) - relation.rhs, (th.Delta,), 2)
    for order, term in enumerate(below):
        yield vanishes(f"term of order {order} of exact minus thesis, O fixed", term, sp.simplify)
    error = th.I_o * th.Delta_d**2 * th.Delta**2 / (2 * th.H**4)
    yield vanishes("its term of order 2 minus the stated error", leading - error, sp.simplify)
    size = float((error / relation.rhs).subs({**wall.WALL, th.Delta: wall.FALL}))
    yield close("the same at 30.41 mm, over the value", size, 1.56e-4, 1e-6)
    constant = relation.rhs.subs(
        {th.I_o: wall.corner_inertia(), th.H: wall.HEIGHT / 1e3, th.Delta_d: 1}
    )
    upright, largest, where, developed = inertia_over_height()
    for what, exact, size in (
        ("upright", upright, 0.045),
        (f"at {where:.2f} mm", largest, -0.0155),
        ("once developed", developed, 0.0148),
    ):
        what = f"excess of a constant I_o about the corner, O moving, {what}"
        yield close(what, float(2 * constant) / exact - 1, size, 5e-4)


def _elastic(start: sp.Rational) -> Callable:
    """Check the work of the elastic-plastic tendon from the force `start` on."""

    def find(equation: Equation, relation: sp.Eq) -> Findings:
        (before, condition), (after, _) = sp.piecewise_fold(relation.rhs).args
        stiffness = th.E_tendon * th.A_tendon / th.L_T
        rest = sp.diff(before, th.P_tendon) * stiffness - th.P_tendon
        yield vanishes("growth with the extension minus the force", rest, sp.simplify)
        at_first = before.subs(th.P_tendon, start).subs(wall.WALL)
        yield close("energy upright in J", at_first, 0, 0.01)
        plastic = sp.diff(after, th.extension)
        yield close("growth after yield in kN", plastic, 900e-3 * float(wall.AREA), 1e-9)
        yields = condition.rhs
        yield close("force at yield in kN", yields, plastic, 1e-9)
        at_yield = (yields - start) / wall.STIFFNESS
        gap = after.subs(th.extension, at_yield) - before.subs(th.P_tendon, yields).subs(wall.WALL)
        yield close("jump of the energy at yield in J", gap, 0, 0.02)

    return find


def _energies_at_peaks(equation: Equation, *relations: sp.Eq) -> Findings:
    """Check the list of Figure 4-29 with the displacements and forces of Table A-1."""
    record = wall.measured()
    rows = np.flatnonzero(record.at_peak)
    gravity = wall.of_displacement(wall.right("4-18") / 1000)
    elastic = wall.right("4-20").subs(wall.WALL)
    for row, stated in zip(rows, TABLES["Figure 4-29"].numbers("total energy"), strict=False):
        parts = {
            th.U_start: gravity(1e3 * record.displacement[row]),
            th.U_E_start: elastic.subs(th.P_tendon, record.tendon_force[row] / 1e3),
        }
        computed = float(relations[0].rhs.subs(parts))
        yield close(f"energy at {record.time[row]:.3f} s in J", computed, stated, 1.1)


def _conserved(equation: Equation, relation: sp.Eq) -> Findings:
    """Check that the energy 4-22 with 4-19 is constant in the motion 4-27 under 4-30 alone."""
    path = sp.Function("Delta")(th.t)
    U, U_E = (sp.Function(name) for name in ("U", "U_E"))
    kinetic = wall.right("4-19").subs(th.Delta_d, path.diff(th.t))
    total = relation.rhs.subs({th.U_of: U(path), th.U_E_of: U_E(path), th.E_k_of: kinetic})
    acceleration = sp.Dummy("a")
    power = total.diff(th.t).subs(path.diff(th.t, 2), acceleration).doit()
    force = wall.right("4-30").subs(th.Delta, path).doit()
    (motion,) = EQUATIONS["4-27"].right
    free = motion.lhs.subs({th.F_damp: 0, th.F_k: force, th.M_e: th.I_o / th.H**2})
    (solved,) = sp.solve(free, th.Delta_dd)
    at_rest = {th.E_k_of: 0, th.U_of: th.U_start, th.U_E_of: th.U_E_start}
    yield vanishes("4-22 at rest minus 4-21", relation.rhs.subs(at_rest) - wall.right("4-21"))
    yield vanishes("rate of the total energy", power.subs(acceleration, solved).doit(), sp.simplify)


def _release_at_rest(equation: Equation, *relations: sp.Eq) -> Findings:
    total = wall.right("4-22").subs(th.E_k_of, wall.right("4-19").subs(th.Delta_d, 0))
    total = total.subs({th.U_of: th.U_start, th.U_E_of: th.U_E_start})
    yield vanishes("4-21 minus 4-22 at rest", relations[0].rhs - total)


# --- 4-23 to 4-26: the motion without losses


def _trajectory(equation: Equation, relation: sp.Eq) -> Findings:
    kinetic = wall.right("4-19").subs(th.Delta_d, relation.rhs)
    yield vanishes(
        "4-22 minus 4-21",
        wall.right("4-22").subs(th.E_k_of, kinetic) - wall.right("4-21"),
        sp.simplify,
    )


def _time(equation: Equation, relation: sp.Eq) -> Findings:
    (step,) = sp.solve(relation.lhs - relation.rhs, th.step)
    velocity = relation.lhs.atoms(sp.Integral).pop().function ** -1
    at_end = velocity.subs(th.Delta, th.Delta_end)
    yield vanishes(
        "growth with Delta_end, times the velocity, minus 1",
        step.diff(th.Delta_end) * at_end - 1,
        sp.simplify,
    )
    yield vanishes("time of no way", step.subs(th.Delta_end, th.Delta_start).doit())


@cache
def fall_in_time(begin: float, end: float) -> tuple[float, float]:
    """Time [s] and speed [m/s] at `end` of the motion 4-27 without losses, from `begin` on.

    The wall starts at rest at FALL; the energy gives its speed at `begin`.
    """
    mass = wall.corner_inertia() / (wall.HEIGHT / 1e3) ** 2
    energy, force = potential_energy(), restoring_force()
    speed = math.sqrt(2 * (energy(wall.FALL) - energy(begin)) / mass)

    def arrives(t, state):
        return state[0] - end

    arrives.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(
        lambda t, y: (1e3 * y[1], -1e3 * force(y[0]) / mass),
        (0, 1),
        (begin, -speed),
        events=arrives,
        rtol=1e-10,
        atol=1e-10,
    )
    return float(run.t_events[0][0]), -float(run.y_events[0][0][1])


def _speed_of_motion(equation: Equation, *relations: sp.Eq) -> Findings:
    """The root of 4-23 and 4-26 is the positive one: the speed of 4-27 at a quarter of the peak."""
    end = wall.FALL / 4
    energy = potential_energy()
    parts = {
        th.U_start: energy(wall.FALL),
        th.U_peak: energy(wall.FALL),
        th.I_o: wall.corner_inertia(),
    }
    parts |= {th.U_of: energy(end), th.U_limit: energy(end), th.H: wall.HEIGHT / 1e3}
    elastic = dict.fromkeys((th.U_E_start, th.U_E_peak, th.U_E_of, th.U_E_limit), 0)
    stated = float(relations[0].rhs.subs({**parts, **elastic}))
    _, speed = fall_in_time(0.99 * wall.FALL, end)
    yield close("speed in m/s, against the motion in time", stated, speed, 1e-8)


def _time_of_motion(equation: Equation, relation: sp.Eq) -> Findings:
    """Compare 4-24 by 4-23 with 4-27 integrated in time, from 30.41 mm to a quarter of it."""
    mass = wall.corner_inertia() / (wall.HEIGHT / 1e3) ** 2
    energy = potential_energy()
    begin, end = 0.99 * wall.FALL, 0.25 * wall.FALL
    fraction = sp.solve(relation.lhs - relation.rhs, th.step)[0] / relation.lhs

    def slowness(place: float) -> float:
        return 1e-3 / math.sqrt(2 * (energy(wall.FALL) - energy(place)) / mass)

    by_energy = float(fraction) * quad(slowness, end, begin)[0]
    time, _ = fall_in_time(begin, end)
    yield close("time in s, against the motion in time", by_energy, time, 1e-8)


def _limit(equation: Equation, relation: sp.Eq) -> Findings:
    computed = float(relation.rhs.subs(th.Delta_peak, wall.FALL)) / wall.FALL
    yield close("fraction of the peak, 25 % by 4.7", computed, 0.25, 1e-12)


def _limit_speed(equation: Equation, relation: sp.Eq) -> Findings:
    at_limit = {th.U_of: th.U_limit, th.U_E_of: th.U_E_limit}
    total = wall.right("4-22").subs(at_limit)
    total = total.subs(th.E_k_of, wall.right("4-19").subs(th.Delta_d, relation.rhs))
    yield vanishes(
        "energy there minus that of the peak", total - th.U_peak - th.U_E_peak, sp.simplify
    )


# --- 4-5, 4-17: quarter periods


def _quarters() -> tuple[np.ndarray, np.ndarray]:
    """Peaks (22,) [mm] and times from them to the next crossing (22,) [s]."""
    peak, time = wall.measured().quarter_periods()
    return 1e3 * np.abs(peak), time


def quarter(relation: sp.Eq) -> sp.Expr:
    """A quarter of the period that a relation states."""
    return sp.solve(relation.lhs - th.t, th.period)[0].subs(th.t, relation.rhs) / 4


def _quarter_fit(equation: Equation, *relations: sp.Eq) -> Findings:
    stated = wall.of_displacement(quarter(relations[0]))
    peak, time = _quarters()
    yield close("R**2 of Table A-1", wall.r_squared(time, stated(peak)), 0.976, 0.006)
    rms = float(np.sqrt(np.mean((stated(peak) - time) ** 2)))
    yield Finding("rms error in s, below half of a sample, 0.0025", rms, rms < 0.0025)
    for at, hertz in ((1.62, 11), (wall.FALL, 4)):
        yield close(f"frequency at {at} mm", 1 / (4 * stated(at)), hertz, 0.2)
    gone = np.abs(stated(peak) - quarter_period_fit(peak / 1e3)).max()
    yield close("against rockeom.analysis", float(gone), 0, 1e-12)


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


def _substitute_gravity(equation: Equation, relation: sp.Eq) -> Findings:
    d = wall.lifted().subs(th.penalty, wall.PENALTY)
    numbers = {
        th.I_o: wall.corner_inertia(),
        th.R: wall.radius(),
        th.P_tendon: 1000 * wall.right("4-16"),
        th.T_fixed_base: Rational("0.0428"),
        th.d_lifted: d,
    }
    whole = quarter(relation).subs(numbers).subs(th.theta, sp.asin(th.Delta / wall.HEIGHT))
    stated = wall.of_displacement(whole)
    peak, time = _quarters()
    yield close("R**2 of Table A-1", wall.r_squared(time, stated(peak)), 0.911, 0.01)
    fixed = relation.rhs.subs(th.Delta, 0) - th.T_fixed_base / 4
    yield vanishes("quarter period from upright minus that of the fixed base", fixed)
    for at, size in ((10.0, -0.0495), (20.0, -0.1337), (wall.FALL, -0.1628)):
        exact = conservative_quarter(at, wall.corner_inertia() / (wall.HEIGHT / 1e3) ** 2)
        error = stated(at) / exact - 1
        yield close(f"error over the time by energy from {at} mm", error, size, 5e-4)
    tested = Wall.thesis()
    gone = np.abs(stated(peak) / tested.quarter_period_substitute_gravity(peak / 1e3) - 1).max()
    yield close("against rockeom.analysis", float(gone), 0, 1e-9)


# --- the checks of each equation

DESCENT = "order 2 in theta: 3.34 of 101.7 J at 30.41 mm, the centroid's descent H_c (1 - cos)"
MOVING_INERTIA = (
    "order 2 in Delta/H, 0.016 % at 30.41 mm, for a fixed O; where O moves, with a constant I_o "
    "about the corner, +4.5 % upright, -1.5 % at 4.35 mm, +1.5 % once rocking is developed"
)
TENDON_WORK = "work of the elastic-plastic tendon"

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
    "4-18": derived(wall.TURNED, rise_of_centroid, DESCENT),
    "4-19": derived(
        "kinetic energy of the wall about a fixed and a moving O", kinetic_energy, MOVING_INERTIA
    ),
    "4-20": derived(TENDON_WORK, _elastic(wall.FORCE)),
    "4-21": (
        derived("4-22 at rest", _release_at_rest),
        reproduced("list of Figure 4-29", _energies_at_peaks),
    ),
    "4-22": derived("constant in the motion 4-27 without losses", _conserved),
    "4-23": (
        derived("4-22 is 4-21", _trajectory),
        derived("4-27 integrated in time", _speed_of_motion),
    ),
    "4-24": (
        derived("derivative by its end", _time),
        derived("4-27 integrated in time", _time_of_motion),
    ),
    "4-25": check.transcribed("the words of 4.7", _limit),
    "4-26": (
        derived("4-22 there is that of the peak", _limit_speed),
        derived("4-27 integrated in time", _speed_of_motion),
    ),
    "4-44": derived(TENDON_WORK, _elastic(wall.LATER_FORCE)),
}
