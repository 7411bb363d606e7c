"""Checks of the motion of the wall: 4-28 to 4-32 and 4-36 to 4-43."""

import math
from collections.abc import Callable, Iterable
from functools import cache

import numpy as np
import sympy as sp
from scipy.integrate import cumulative_simpson, solve_ivp
from sympy import cos, sin

from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.approximations import leads
from rockeom.thesis.checks.chapter_4_free_vibration import restoring_force
from rockeom.thesis.checks.check import Findings, close, derived, reproduced, states, vanishes
from rockeom.thesis.comparison import at_side
from rockeom.thesis.equation import BOTH, Equation
from rockeom.thesis.wall_tests import energy_ratio_4_31, energy_ratio_4_36, energy_ratio_4_38

# --- 4-28 to 4-30, 4-39 to 4-43: forces


def left(number: str) -> sp.Expr:
    """Left minus right side of an equation of motion."""
    relation = EQUATIONS[number].right[0]
    return relation.lhs - relation.rhs


def solved(expr: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
    (value,) = sp.solve(expr, symbol)
    return value


def _passage(equation: Equation, relation: sp.Eq) -> Findings:
    """M_e v dv/dx = -F_Damp on the left of 4-27: separable, with ln(v) = -int F/(M_e v**2) dx."""
    free = {th.F_k: 0, th.P_e: 0, th.F_damp: relation.rhs}
    force = solved(left("4-27").subs(free), th.Delta_dd)
    w = sp.Dummy("w", positive=True)
    for direction in BOTH:
        slope = sp.simplify((force / th.Delta_d**2).subs(th.Delta_d, direction * w))
        growth = direction * sp.integrate(slope, (th.Delta, -sp.oo, sp.oo))
        what = f"ratio of the velocities of a passage to {'+-'[direction < 0]}Delta minus sqrt(r)"
        yield vanishes(what, sp.exp(growth) - sp.sqrt(th.r), sp.simplify)


def _push(equation: Equation, relation: sp.Eq) -> Findings:
    """Check 4-29 by the moments of weight, tendon and push in equilibrium about a fixed O."""
    lever, load, pull, turn, half = sp.symbols("b mg P dtheta half", positive=True)
    angle = 2 * half
    right_move, up_move = wall.turned(1, lever)
    chord = 2 * lever * sin(th.theta / 2)
    tendon = pull * (up_move * right_move - (right_move - lever) * up_move) / chord
    centroid = -lever * cos(th.theta) + th.H_c * sin(th.theta)
    push = (tendon - load * centroid) / (th.H * cos(th.theta))
    rise = wall.turned(1, lever, th.H_c)[1]
    ways = {th.dDelta: th.H * sin(th.theta), th.dU: load * rise, th.dU_E: pull * chord}
    put = {th.F_k: push} | {d: sp.diff(way, th.theta) * turn for d, way in ways.items()}
    rest = (relation.lhs - relation.rhs).subs(put).subs(th.theta, angle)
    yield vanishes("thesis with the force by moments", sp.expand_trig(rest), sp.simplify)


def gradient(side: int) -> sp.Expr:
    """F_k of 4-29 by increments of the energies."""
    names = {th.dU: sp.Function("U"), th.dU_E: sp.Function("U_E")}
    put = {dU: f(th.Delta).diff(th.Delta) * th.dDelta for dU, f in names.items()}
    return solved(left("4-29"), th.F_k).subs(put)


def _driving_force(equation: Equation, relation: sp.Eq) -> Findings:
    """Check the work of -m a_g at the centroid for a change of Delta, upright, with M_e as m."""
    moved = wall.turned(1, sp.Dummy("b", positive=True), th.H_c)[0]
    per_delta = sp.diff(moved, th.theta) / sp.diff(th.H * sin(th.theta), th.theta)
    exact = -th.M_e * th.a_g * per_delta.subs(th.theta, 0)
    rest = relation.rhs * th.H_c / th.H - exact
    yield vanishes("thesis times H_c/H minus the generalised force", rest, sp.simplify)
    size = float((relation.rhs / exact - 1).subs(wall.WALL))
    yield close("excess of the thesis", size, 0.122, 5e-4)


def driven(ground: sp.Expr = th.a_g, damping: sp.Symbol = th.F_damp) -> sp.Expr:
    """4-27 with 4-39, left minus right side."""
    put = {th.P_e: wall.right("4-39").subs(th.a_g, ground), th.F_damp: damping}
    return left("4-27").subs(put)


# --- 4-32, 4-40: the tendon's force taken as weight


def _tendon_as_weight(equation: Equation, relation: sp.Eq, *_: sp.Eq) -> Findings:
    """The tendon pulls on the mouth of its duct; its lever is B cos(theta/2)."""
    angle = sp.Dummy("angle", positive=True)
    exact = th.R * sin(th.alpha) * cos(angle / 2)
    error = th.R * cos(th.alpha) * angle
    for side in equation.sides:
        stated = sp.expand(at_side(relation.rhs, side)).coeff(th.P_tendon)
        stated = -side * stated.subs(th.theta, side * angle)
        yield from leads(exact, stated, (angle,), 1, error)
    size = wall.CENTROID * math.asin(wall.FALL / wall.HEIGHT) / wall.HALF_WIDTH
    yield close("the same at 30.41 mm, over B", size, 0.0534, 1e-4)


# --- 4-31, 4-36, 4-38: energy ratios by the speed, against the peaks of Table A-1


def by_speed(function: Callable, jumps: Iterable[float] = ()) -> check.Find:
    """Check a fit of r by the speed, of which one case holds on either side of each jump."""

    def find(equation: Equation, relation: sp.Eq) -> Findings:
        cases = getattr(relation.rhs, "args", ()) if jumps else ((relation.rhs, sp.true),)
        cases = [sp.lambdify(th.Delta_d, list(case), "math") for case in cases]
        beside = [speed + aside for speed in jumps for aside in (-1e-4, 1e-4)]
        for speed in (0.05, 0.2, 0.4, 0.6, 0.87, *beside):
            for velocity in (speed, -speed):
                values = [value for value, holds in (case(velocity) for case in cases) if holds]
                yield check.Finding(f"one case at {velocity} m/s", values, len(values) == 1)
                yield close(f"r at {velocity} m/s", values[0], float(function(speed)), 1e-12)

    return find


def peaks_of_oscillator(
    ratio: Callable[[float], float], passages: int, stiffer: float = 1
) -> list[float]:
    """Absolute peaks [mm] of 4-27 with 4-28 from the release on; r depends on the speed.

    Integrated over Delta, with the kinetic energy as the unknown.
    """
    elastic, mass = restoring_force(), float(wall.MASS)
    # F_Damp/M_e [m/s2] of r, Delta [mm], velocity [m/s]; the width n is in metres in it
    metres = {th.M_e: 1, th.Delta: th.Delta / 1000, th.n: wall.PENALTY / 1000}
    force = wall.right("4-28").subs(metres, simultaneous=True)
    damping = sp.lambdify((th.r, th.Delta, th.Delta_d), force, "math")

    def growth(place, energy):
        speed = max(math.sqrt(max(2 * energy[0] / mass, 0.0)), 1e-9)
        pull = stiffer * math.copysign(elastic(abs(place)), place)
        return (-pull - mass / 1e3 * damping(ratio(speed), place, speed),)

    def rest(place, energy):
        return energy[0]

    rest.terminal, rest.direction = True, -1  # type: ignore[attr-defined]
    peaks = [wall.FALL]
    for _ in range(passages):
        peak = peaks[-1]
        begin = [stiffer * elastic(peak) * 1e-6 * peak]
        options = {"events": rest, "rtol": 1e-7, "atol": 1e-8, "max_step": peak / 20}
        run = solve_ivp(growth, (-peak * (1 - 1e-6), 2 * peak), begin, **options)
        peaks.append(float(run.t_events[0][0]))
    return peaks


CORNER = sp.Integer(wall.HALF_WIDTH)
"""Lever of 4-32, R sin(alpha) [mm]; that of the block whose centre moves is 4-37."""


@cache
def potential(lever: sp.Expr) -> tuple[np.ndarray, np.ndarray]:
    """Displacement Delta [mm] and potential energy [J] of 4-32, (4001,) each.

    lever : R sin(alpha) [mm], a function of Delta.
    """
    theta = np.linspace(0, 40 / wall.HEIGHT, 4001)
    place = wall.HEIGHT * np.sin(theta)
    tendon = wall.of_displacement(wall.right("4-16"))(place)
    arm = np.broadcast_to(wall.of_displacement(lever)(place), place.shape) / 1e3
    polar = {th.R * sin(th.alpha): th.b_moving, th.R * cos(th.alpha): wall.CENTROID / 1e3}
    moment = -sp.expand(sp.expand_trig(at_side(wall.right("4-32"), 1))).subs(polar)
    stated = sp.lambdify((th.theta, th.P_tendon, th.b_moving), moment.subs(wall.WALL), "numpy")
    return place, cumulative_simpson(stated(theta, 1e3 * tendon, arm), x=theta, initial=0)


def peaks_of_block(
    ratio: Callable[[float], float], passages: int, lever: sp.Expr = CORNER
) -> list[float]:
    """Peaks [mm] of 4-32 from the release on; r depends on the speed of the passage."""
    place, energy = potential(lever)
    peaks, rest = [wall.FALL], float(np.interp(wall.FALL, place, energy))
    for _ in range(passages):
        rest *= ratio(math.sqrt(2 * rest / wall.corner_inertia()) * wall.HEIGHT / 1e3)
        peaks.append(float(np.interp(rest, energy, place)))
    return peaks


def decay(peaks_by: Callable, passages: int, low: float, high: float, add: float = 0) -> check.Find:
    """Check the rms error of peaks by an energy ratio, `add` to it, against Table A-1 [mm]."""

    def find(equation: Equation, relation: sp.Eq) -> Findings:
        stated = sp.lambdify(th.Delta_d, relation.rhs + add, "math")
        errors = np.array(peaks_by(stated, passages)) - wall.sizes_of_peaks()[: passages + 1]
        rms = float(np.sqrt(np.mean(errors**2)))
        what = f"rms error of {passages} passages in mm, from {low} to {high}"
        yield check.Finding(what, rms, low < rms < high)

    return find


def _words_of_4_36(equation: Equation, relation: sp.Eq) -> Findings:
    stated = sp.lambdify(th.Delta_d, relation.rhs, "math")
    slope = stated(1.0) - stated(0.0)
    yield close("0.91 - 0.88 over its slope, in m/s", 0.03 / slope, 0.68, 0.001)
    yield close("r = 0.91 is reached at, in m/s", (0.91 - stated(0.0)) / slope, 1.02, 0.005)


def _moving_lever(equation: Equation, relation: sp.Eq) -> Findings:
    far = float(relation.rhs.subs(th.Delta, sp.oo))
    longer = far / (wall.HALF_WIDTH - wall.developed("rotation_centre")) - 1
    yield close("longer than the lever of Table A-1, by its uplifts", longer, 0.15, 0.005)
    longer = far / (wall.HALF_WIDTH - wall.REMAINS) - 1
    yield close("longer than that of 4-7", longer, 0.23, 0.005)


# --- the checks of each equation

_PEAKS = "peaks of Table A-1, as in Figure"
_BANDS = "the shipped law of impacts, band by band"

CHECKS: check.Checks = {
    "4-28": derived("the velocity after one passage, in 4-27", _passage),
    "4-29": derived("moments about O", _push),
    "4-30": derived("4-29", states(gradient)),
    "4-31": (
        check.transcribed(_BANDS, by_speed(energy_ratio_4_31, (0.3, 0.47, 0.78))),
        reproduced(
            f"{_PEAKS} 4-37 with F_k 6 % larger",
            decay(lambda r, n: peaks_of_oscillator(r, n, 1.06), 13, 0, 1.5),
        ),
    ),
    "4-32": derived(
        "lever of the tendon in its duct",
        _tendon_as_weight,
        "order 1 in theta: the lever of the tendon is too short by H_c theta, 5.3 % of B at "
        "30.41 mm",
    ),
    "4-36": (
        check.transcribed("the shipped law of impacts", by_speed(energy_ratio_4_36)),
        check.transcribed("its numbers, and those of the words", _words_of_4_36),
        reproduced(f"{_PEAKS} 4-43", decay(peaks_of_block, 21, 0, 1.6)),
        reproduced("the same with 0.876 for 0.865", decay(peaks_of_block, 21, 2.5, 2.7, 0.011)),
    ),
    "4-37": reproduced("levers of Table A-1 and 4-7", _moving_lever),
    "4-38": (
        reproduced(
            f"{_PEAKS} 4-45",
            decay(lambda r, n: peaks_of_block(r, n, wall.right("4-37")), 12, 0, 1.6),
        ),
        check.transcribed(_BANDS, by_speed(energy_ratio_4_38, (0.365, 0.47, 0.78))),
    ),
    "4-39": derived(
        "work of the inertia at the centroid",
        _driving_force,
        "no order: too large by H/H_c - 1 = 12 % where M_e is the mass",
    ),
    "4-40": derived(
        "lever of the tendon in its duct", _tendon_as_weight, "order 1 in theta, as 4-32"
    ),
    "4-41": derived("4-27 with 4-39", states(lambda side: driven(damping=th.F_D))),
    "4-42": derived(
        "4-41 without velocity", states(lambda side: solved(left("4-41").subs(th.F_D, 0), th.F_k))
    ),
    "4-43": derived(
        "4-27 with 4-39", states(lambda side: driven(th.Z * sin(2 * sp.pi * 8 * th.t)))
    ),
}
