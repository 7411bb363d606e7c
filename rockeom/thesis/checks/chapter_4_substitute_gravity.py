"""Checks of 4-32 to 4-38 and 4-40: the wall as a rocking block with substitute gravity."""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import sympy as sp
from scipy.integrate import cumulative_simpson
from sympy import cos, sin

from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.approximations import taylor
from rockeom.thesis.checks.chapter_4_oscillator import bands
from rockeom.thesis.checks.check import Finding, Findings, close, derived, transcribed, vanishes
from rockeom.thesis.equation import BOTH, Equation
from rockeom.thesis.wall_tests import energy_ratio_4_36, energy_ratio_4_38

# --- 4-32 to 4-35, 4-40: the equation of motion


def moments(side: int, forces: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    """Clockwise moment about O of forces to the right and upward on the centroid of the block."""
    move = wall.turned(side, th.R * sin(th.alpha), th.R * cos(th.alpha))
    x = -side * th.R * sin(th.alpha) + move[0]
    y = th.R * cos(th.alpha) + move[1]
    return y * forces[0] - x * forces[1]


def at_side(expr: sp.Expr, side: int) -> sp.Expr:
    """`expr` with the side for every sign, expanded."""
    return sp.expand(sp.expand_trig(expr.replace(sp.sign, lambda _: sp.Integer(side))))


def _block(equation: Equation, motion: sp.Eq, *ground: sp.Eq) -> Findings:
    stated = motion.lhs - motion.rhs
    weight = th.m * th.g + th.P_tendon
    for side in equation.sides:
        push = sp.S.Zero
        whole = stated
        for relation in ground:
            push = -th.M_e * th.a_g
            whole = stated.subs(th.tau_t, relation.rhs)
            rest = at_side(relation.rhs + moments(side, (push, sp.S.Zero)), side)
            yield vanishes("moment of the ground's motion minus tau", rest, sp.simplify)
        exact = th.I_o * th.theta_dd - moments(side, (push, -weight))
        yield vanishes("thesis minus moments about O", at_side(whole - exact, side), sp.simplify)


def _tendon_as_weight(equation: Equation, *relations: sp.Eq) -> Findings:
    """The tendon pulls on the mouth of its duct; its lever is B cos(theta/2)."""
    for side in equation.sides:
        angle = sp.Dummy("angle", positive=True)
        stated = at_side(sp.expand(relations[0].rhs).coeff(th.P_tendon), side)
        stated = -side * stated.subs(th.theta, side * angle)
        exact = th.R * sin(th.alpha) * cos(angle / 2)
        none, leading = taylor(exact - stated, (angle,), 1)
        yield vanishes("lever upright, exact minus thesis", none, sp.simplify)
        rest = leading - th.R * cos(th.alpha) * angle
        yield vanishes("its term of order 1 minus H_c theta", rest, sp.simplify)
    size = wall.CENTROID * math.asin(wall.FALL / wall.HEIGHT) / wall.HALF_WIDTH
    yield close("the same at 30.41 mm, over B", size, 0.0534, 1e-4)


def _top_of_wall(equation: Equation, *relations: sp.Eq) -> Findings:
    for side in equation.sides:
        rest = relations[0].rhs - wall.turned(side, sp.S.Zero, th.H)[0]
        yield vanishes("thesis minus the displacement of the point above O", rest, sp.simplify)


def _rate(order: int) -> Callable:
    def find(equation: Equation, *relations: sp.Eq) -> Findings:
        path = sp.Function("theta")(th.t)
        rate = wall.right("4-33").subs(th.theta, path).diff(th.t, order)
        at_once = {path.diff(th.t, 2): th.theta_dd, path.diff(th.t): th.theta_d}
        for derivative, symbol in at_once.items():
            rate = rate.subs(derivative, symbol)
        rest = relations[0].rhs - rate.subs(path, th.theta)
        yield vanishes("thesis minus the derivative of 4-33", rest, sp.simplify)

    return find


# --- 4-36, 4-38: the energy ratios against Table A-1

CORNER = sp.Integer(wall.HALF_WIDTH)
"""Lever of 4-32, R sin(alpha) [mm]; that of the block whose centre moves is 4-37."""
PEAKS = 13
"""Peaks of Table A-1 before the first that is not legible."""


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
    moment = -at_side(wall.right("4-32"), 1).subs(polar).subs({th.m: wall.MASS, th.g: wall.GRAVITY})
    stated = sp.lambdify((th.theta, th.P_tendon, th.b_moving), moment, "numpy")
    return place, cumulative_simpson(stated(theta, 1e3 * tendon, arm), x=theta, initial=0)


def peaks_of_block(
    ratio: Callable[[float], float], passages: int, lever: sp.Expr = CORNER
) -> tuple[list[float], list[float]]:
    """Peaks [mm] of 4-32 and speeds [m/s] of its passages; r depends on the speed."""
    place, energy = potential(lever)
    sizes, speeds = [wall.FALL], []
    left = float(np.interp(wall.FALL, place, energy))
    for _ in range(passages):
        speeds.append(math.sqrt(2 * left / wall.corner_inertia()) * wall.HEIGHT / 1e3)
        left *= ratio(speeds[-1])
        sizes.append(float(np.interp(left, energy, place)))
    return sizes, speeds


def _linear_ratio(equation: Equation, *relations: sp.Eq) -> Findings:
    stated = sp.lambdify(th.Delta_d, relations[0].rhs, "math")
    for speed in (0.1, 0.34, 0.78):
        for way in BOTH:
            reference = float(energy_ratio_4_36(speed))
            yield close(f"r at {way * speed} m/s", stated(way * speed), reference, 1e-12)
    slope = stated(1.0) - stated(0.0)
    yield close("0.91 - 0.88 over its slope, in m/s", 0.03 / slope, 0.68, 0.001)
    yield close("r = 0.91 is reached at, in m/s", (0.91 - stated(0.0)) / slope, 1.02, 0.005)


def _block_decay(equation: Equation, *relations: sp.Eq) -> Findings:
    """Compare 4-32 with impacts, as in Figure 4-43, with the peaks of Table A-1."""
    stated = sp.lambdify(th.Delta_d, relations[0].rhs, "math")
    reference = wall.sizes_of_peaks()

    def rms(ratio: Callable[[float], float]) -> float:
        sizes, _ = peaks_of_block(ratio, len(reference) - 1)
        return float(np.sqrt(np.mean((np.array(sizes) - reference) ** 2)))

    error = rms(stated)
    yield Finding("rms error of 22 peaks in mm, below 1.6", error, error < 1.6)
    reading = rms(lambda speed: stated(speed) + 0.011)
    yield Finding("the same with 0.876, above 2.5", reading, reading > 2.5)
    fastest = max(peaks_of_block(stated, 1)[1])
    yield close("fastest passage in m/s", fastest, 0.87, 0.005)


def _moving_decay(equation: Equation, *relations: sp.Eq) -> Findings:
    """Compare 4-32 with 4-37 and impacts, as in Figure 4-45, with the first peaks of Table A-1."""
    stated = sp.lambdify(th.Delta_d, relations[0].rhs, "math")
    reference = wall.sizes_of_peaks()[:PEAKS]
    sizes, _ = peaks_of_block(stated, PEAKS - 1, wall.right("4-37"))
    error = float(np.sqrt(np.mean((np.array(sizes) - reference) ** 2)))
    yield Finding(f"rms error of {PEAKS} peaks in mm, below 1.6", error, error < 1.6)


# --- 4-37: the centre of rotation


def _moving_lever(equation: Equation, relation: sp.Eq) -> Findings:
    """Check the assumption: from the centreline to the edge, in the course of 4-7."""
    far = relation.rhs.subs(th.Delta, sp.oo)
    yield vanishes("once rocking is developed, minus B", far - wall.HALF_WIDTH)
    course = wall.HALF_WIDTH - EQUATIONS["4-7"].right[0].rhs
    rest = relation.rhs / far - course / course.subs(th.Delta, sp.oo)
    yield vanishes("share of the developed lever, minus that of 4-7", rest, sp.expand)
    longer = float(far) / (wall.HALF_WIDTH - wall.developed_distance()) - 1
    yield close("longer than the lever of Table A-1, by its uplifts", longer, 0.15, 0.005)


# --- the checks of each equation

CHECKS: check.Checks = {
    "4-32": (
        derived("moments about O", _block),
        derived(
            "lever of the tendon in its duct",
            _tendon_as_weight,
            "order 1 in theta: the lever of the tendon is too short by H_c theta, 5.3 % of B at "
            "30.41 mm",
        ),
    ),
    "4-33": derived(wall.TURNED, _top_of_wall),
    "4-34": derived("derivative of 4-33", _rate(1)),
    "4-35": derived("second derivative of 4-33", _rate(2)),
    "4-36": (
        transcribed("its numbers, and those of the words", _linear_ratio),
        check.reproduced("peaks of Table A-1, as in Figure 4-43", _block_decay),
    ),
    "4-37": derived("its assumption, in the course of 4-7", _moving_lever),
    "4-38": (
        check.reproduced("peaks of Table A-1, as in Figure 4-45", _moving_decay),
        transcribed(
            "bands of the speed and their jumps",
            bands(energy_ratio_4_38, {0.365: 0.0, 0.47: 0.04, 0.78: 0.09}),
        ),
    ),
    "4-40": (
        derived("moments about O", _block),
        derived("lever of the tendon in its duct", _tendon_as_weight, "order 1 in theta, as 4-32"),
    ),
}
