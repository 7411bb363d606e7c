"""Checks of 4-1 to 4-16 but 4-5: the centre of rotation, the uplift and the tendon of the wall."""

import math

import numpy as np
import sympy as sp
from sympy import Rational, cos, sin

from rockeom.analysis.formulas.controlled_wall import Wall
from rockeom.thesis import notation as th
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.approximations import taylor
from rockeom.thesis.checks.check import Finding, Findings, close, derived, reproduced, vanishes
from rockeom.thesis.equation import Equation
from rockeom.thesis.wall_tests import corrected_uplifts

# --- 4-1 to 4-4: a straight base between the gauges

BETWEEN = 1076
LOW, HIGH = sp.symbols("low high", positive=True)
SIGNS = {
    "the right side lifts": (-LOW, HIGH),
    "the left side lifts": (HIGH, -LOW),
    "both readings positive": (LOW, LOW + HIGH),
}


def _profile(place: sp.Expr, readings: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    """Uplift of the straight base at a distance from the left gauge."""
    left, other = readings
    return left + (other - left) * place / BETWEEN


def _base(equation: Equation, relation: sp.Eq) -> Findings:
    right_sides = {n: wall.right(n) for n in ("4-1", "4-2")} | {equation.number: relation.rhs}
    places = {"4-1": 0, "4-2": BETWEEN, "4-3": 30, "4-4": BETWEEN - 30}
    for what, readings in SIGNS.items():
        put = dict(zip((th.u_L, th.u_R), readings, strict=True))
        centre = right_sides["4-1"].subs(put)
        other = right_sides["4-2"].subs(th.x, centre)
        computed = relation.rhs.subs({th.x: centre, th.y_centre: other, **put})
        if equation.number in ("4-1", "4-2"):
            place = computed if equation.number == "4-1" else BETWEEN - computed
            rest = _profile(place, readings)
            yield vanishes(f"uplift of the base there, {what}", rest, sp.simplify)
        else:
            rest = computed - _profile(places[equation.number], readings)
            yield vanishes(f"thesis minus uplift of the base, {what}", rest, sp.simplify)


def _uplifts_again(equation: Equation, *relations: sp.Eq) -> Findings:
    stated = relations[0].rhs
    right_sides = {n: wall.right(n) for n in ("4-1", "4-2")} | {equation.number: stated}
    for left, other in ((-0.6, 11.7), (11.0, -0.8), (0.3, 0.5)):
        centre = right_sides["4-1"].subs({th.u_L: left, th.u_R: other})
        put = {th.x: centre, th.y_centre: right_sides["4-2"].subs(th.x, centre)}
        computed = float(stated.subs({th.u_L: left, th.u_R: other, **put}))
        again = corrected_uplifts(left / 1e3, other / 1e3)
        reference = {
            "4-1": again.centre_from_left_gauge,
            "4-2": BETWEEN / 1e3 - again.centre_from_left_gauge,
            "4-3": again.left,
            "4-4": again.right,
        }[equation.number]
        what = f"against rockeom.analysis in mm, readings {left} and {other} mm"
        yield close(what, computed, 1e3 * float(reference), 1e-9)


def _edges_of_table_a1(equation: Equation, *relations: sp.Eq) -> Findings:
    """Compare the last column of Table A-1 with x of the readings by the inverse of 4-3, 4-4."""
    record = wall.measured()
    rows = record.at_peak & (record.reading == "clean")
    left, other, distance = (
        1e3 * a[rows] for a in (record.left_uplift, record.right_uplift, record.centre_from_edge)
    )
    reading = (
        left - 30 / (BETWEEN - 60) * (other - left),
        other + 30 / (BETWEEN - 60) * (other - left),
    )
    stated = sp.lambdify((th.u_L, th.u_R), relations[0].rhs)
    x = np.array([stated(*pair) for pair in zip(*reading, strict=True)])
    pressed = np.where(record.displacement[rows] < 0, x, BETWEEN - x)
    worst = float(np.abs(pressed - distance).max())
    what = "distance of the 17 legible peaks from the gauge, largest error in mm, below 2.2"
    yield Finding(what, worst, worst < 2.2)


# --- 4-6 to 4-9: the path of the centre of rotation, and the uplift of the edge


def _migration(equation: Equation, distance: sp.Eq, penalty: sp.Eq) -> Findings:
    """Check the choices that the text states: upright, developed, and the penalty parameter."""
    width = distance.lhs + th.d_lifted * cos(th.theta)
    yield vanishes("width of the base minus twice B", width - 2 * wall.HALF_WIDTH)
    upright = distance.rhs.subs(th.Delta, 0)
    yield vanishes("distance upright minus B", upright - wall.HALF_WIDTH)
    far = distance.rhs.subs(th.Delta, sp.oo)
    by_gauge, by_uplifts = wall.mean_distance_from_gauge(), wall.developed_distance()
    yield close("distance once rocking is developed, from the gauge", float(far), by_gauge, 1)
    yield close(
        "the same less the 30 mm to the edge, by its uplifts", float(far) - 30, by_uplifts, 1
    )
    left = distance.rhs.subs(th.Delta, th.penalty) - far
    yield vanishes("remainder at epsilon, minus 1/e", left / (upright - far) - sp.exp(-1))
    yield close("epsilon, by 4.8.1", penalty.rhs, 3.551, 1e-12)


def _general(equation: Equation, relation: sp.Eq) -> Findings:
    """Check the two fixed points of 4-8 that the text names, and 4-9 by 4-8."""
    yield vanishes("upright", relation.rhs.subs(th.Delta, 0) - th.C_1 - th.C_2)
    yield vanishes("developed", relation.rhs.subs(th.Delta, sp.oo) - th.C_2)
    numbers = {th.C_1: wall.VANISHES, th.C_2: wall.REMAINS}
    d = (2 * wall.HALF_WIDTH - relation.rhs.subs(numbers)) / cos(th.theta)
    yield vanishes(
        "d sin(theta) minus 4-9",
        wall.placed(d * sin(th.theta) - wall.right("4-9"), 1),
        wall.reduced,
    )


def _edge_uplifts(equation: Equation, *relations: sp.Eq) -> Findings:
    record = wall.measured()
    rows = record.at_peak & (record.reading == "clean")
    at = record.displacement[rows]
    reference = np.where(at > 0, record.left_uplift[rows], record.right_uplift[rows])
    stated = wall.of_displacement(relations[0].rhs)(1e3 * at) / 1e3
    yield close(
        "R**2 of the 17 legible peaks of Table A-1", wall.r_squared(reference, stated), 0.99, 5e-3
    )
    gone = np.abs(stated - Wall.thesis().uplift(at)).max()
    yield close("against rockeom.analysis in m", float(gone), 0, 1e-12)


# --- 4-10, 4-16: the tendon


def _chord(equation: Equation, relation: sp.Eq) -> Findings:
    """The mouth of the duct moves on a circle about O; the tendon follows the chord."""
    lever = sp.Dummy("b", positive=True)
    for side in equation.sides:
        right_move, up_move = wall.turned(side, lever)
        chord = sp.sqrt(sp.trigsimp(sp.expand(right_move**2 + up_move**2)))
        small = sp.Dummy("small", positive=True)
        exact = 2 * lever * sin(small / 2)
        half = sp.trigsimp(sp.expand_trig((chord**2 - exact**2).subs(th.theta, side * small)))
        yield vanishes("chord**2 minus (2 b sin(theta/2))**2", half, sp.simplify)
        stated = relation.rhs.subs(th.u_tendon, up_move).subs(th.theta, side * small)
        *below, leading = taylor(exact - stated, (small,), 3)
        for order, term in enumerate(below):
            yield vanishes(f"term of order {order} of exact minus thesis", term, sp.expand)
        error = -Rational(3, 8) * lever * small**3
        yield vanishes("its term of order 3 minus the stated error", leading - error, sp.expand)
        at = {small: math.asin(30 / wall.HEIGHT)}
        size = float((stated / exact - 1).subs(lever, 1).subs(at))
        yield close("error over the extension at 30 mm", size, 5.7e-5, 0.1e-5)


def _elastic_tendon(equation: Equation, force: sp.Eq) -> Findings:
    stiffness = th.E_tendon * th.A_tendon / th.L_T0
    for side in equation.sides:
        stretched = th.P_initial / stiffness + wall.with_numbers(wall.tendon_extension)(side)
        rest = wall.placed((force.rhs - stiffness * stretched).subs(th.B, wall.HALF_WIDTH), side)
        yield vanishes("thesis minus stiffness times extension from zero force", rest, wall.reduced)


def _tendon_forces(equation: Equation, *relations: sp.Eq) -> Findings:
    record = wall.measured()
    rows = record.at_peak & (record.reading == "clean")
    at = record.displacement[rows]
    stated = wall.of_displacement(relations[0].rhs)(1e3 * at) * 1e3
    computed = wall.r_squared(record.tendon_force[rows], stated)
    yield close("R**2 of the 17 legible peaks of Table A-1", computed, 0.927, 0.005)
    gone = np.abs(stated / Wall.thesis().tendon_force(at) - 1).max()
    yield close("against rockeom.analysis", float(gone), 0, 1e-5)


# --- the checks of each equation

STRAIGHT_BASE = "a straight base between the gauges"

CHECKS: check.Checks = {
    "4-1": (
        derived(STRAIGHT_BASE, _base),
        reproduced("Table A-1, distances from its uplifts", _edges_of_table_a1),
        reproduced("rockeom.analysis", _uplifts_again),
    ),
    "4-2": (derived(STRAIGHT_BASE, _base), reproduced("rockeom.analysis", _uplifts_again)),
    "4-3": (derived(STRAIGHT_BASE, _base), reproduced("rockeom.analysis", _uplifts_again)),
    "4-4": (derived(STRAIGHT_BASE, _base), reproduced("rockeom.analysis", _uplifts_again)),
    "4-6": derived(wall.TURNED, wall.by_geometry(wall.edge_uplift)),
    "4-7": reproduced("the choices of the text: the centreline, and Table A-1", _migration),
    "4-8": derived("its fixed points; in 4-6 it gives 4-9", _general),
    "4-9": (
        derived(wall.TURNED, wall.by_geometry(wall.with_numbers(wall.edge_uplift))),
        reproduced("uplifts of Table A-1", _edge_uplifts),
    ),
    "4-10": derived(
        "chord on which the mouth of the duct moves",
        _chord,
        "order 3 in theta, 3/8 (d - B) theta**3: 0.006 % of the extension at 30 mm",
    ),
    "4-11": derived(
        wall.TURNED,
        wall.by_geometry(
            lambda side: wall.turned(side, th.d_tendon)[1] / cos(th.theta), u_edge=wall.edge_uplift
        ),
    ),
    "4-12": derived(wall.TURNED, wall.by_geometry(wall.tendon_extension, u_edge=wall.edge_uplift)),
    "4-13": derived(wall.TURNED, wall.by_geometry(wall.tendon_extension)),
    "4-14": derived(wall.TURNED, wall.by_geometry(wall.tendon_extension, u_edge=wall.edge_uplift)),
    "4-15": derived(
        wall.TURNED, wall.by_geometry(wall.with_numbers(wall.tendon_extension), B=wall.half_width)
    ),
    "4-16": (
        derived(f"{wall.TURNED}, and an elastic tendon", _elastic_tendon),
        reproduced("tendon forces of Table A-1", _tendon_forces),
    ),
}
