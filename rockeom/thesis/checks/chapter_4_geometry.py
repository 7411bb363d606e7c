"""Checks of the geometry of the wall: 4-1 to 4-16 but 4-5, 4-33 to 4-35, B-1 to B-3, B-5 to B-7."""

import math

import sympy as sp
from sympy import Rational, cos, sin

from rockeom.thesis import notation as th
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.approximations import leads
from rockeom.thesis.checks.check import Findings, close, derived, reproduced, states, vanishes
from rockeom.thesis.comparison import rate
from rockeom.thesis.equation import Equation

# --- 4-1 to 4-4: a straight base between the gauges

BETWEEN, PLACE = 1076, sp.Symbol("place", real=True)
PROFILE = th.u_L + (th.u_R - th.u_L) * PLACE / BETWEEN
"""Uplift of the straight base at a place from the left gauge."""
(CENTRE,) = sp.solve(PROFILE, PLACE)


def on_straight_base(value: sp.Expr) -> check.Find:
    """Check a value by the readings of both gauges."""
    centre = {th.x: CENTRE, th.y_centre: BETWEEN - CENTRE}
    return states(value, "thesis minus straight base", lambda expr, side: expr.subs(centre))


# --- 4-7, and what Table A-1 has


def _migration(equation: Equation, distance: sp.Eq, penalty: sp.Eq) -> Findings:
    """Check the choices that the text states: upright, developed, and the penalty parameter."""
    width = distance.lhs + th.d_lifted * cos(th.theta)
    yield vanishes("width of the base minus twice B", width - 2 * wall.HALF_WIDTH)
    upright, far, near = (distance.rhs.subs(th.Delta, at) for at in (0, sp.oo, th.penalty))
    yield vanishes("distance upright minus B", upright - wall.HALF_WIDTH)
    by_gauge, by_uplifts = map(wall.developed, ("centre_from_edge", "rotation_centre"))
    yield close("distance once rocking is developed, from the gauge", float(far), by_gauge, 1)
    yield close(
        "the same less the 30 mm to the edge, by its uplifts", float(far) - 30, by_uplifts, 1
    )
    rest = (near - far) / (upright - far) - sp.exp(-1)
    yield vanishes("remainder at epsilon, minus 1/e", rest)
    yield close("epsilon, by 4.8.1", penalty.rhs, 3.551, 1e-12)


# --- 4-10: the tendon


def _chord(equation: Equation, relation: sp.Eq) -> Findings:
    """The mouth of the duct moves on a circle about O; the tendon follows the chord."""
    lever, small = sp.symbols("b small", positive=True)
    exact = 2 * lever * sin(small / 2)
    for side in equation.sides:
        right_move, up_move = (e.subs(th.theta, side * small) for e in wall.turned(side, lever))
        rest = right_move**2 + up_move**2 - exact**2
        yield vanishes("chord**2 minus (2 b sin(theta/2))**2", rest, sp.simplify)
        stated = relation.rhs.subs({th.u_tendon: up_move, th.theta: side * small})
        yield from leads(exact, stated, (small,), 3, -Rational(3, 8) * lever * small**3)
        at = {small: math.asin(30 / wall.HEIGHT), lever: 1}
        size = float((stated / exact - 1).subs(at))
        yield close("error over the extension at 30 mm", size, 5.7e-5, 0.1e-5)


# --- 4-33 to 4-35, B-5 to B-7: rotation and displacement


def rate_of_rotation(side: int) -> sp.Expr:
    return sp.solve(rate(wall.right("4-33")) - th.Delta_d, th.theta_d)[0]


def _small_rate(equation: Equation, relation: sp.Eq) -> Findings:
    exact = wall.right("B-6").subs(th.theta, sp.asin(th.Delta / th.H))
    error = th.Delta_d * th.Delta**2 / (2 * th.H**3)
    yield from leads(exact, relation.rhs, (th.Delta,), 2, error)
    size = float((1 - relation.rhs / exact).subs({**wall.WALL, th.Delta: wall.FALL}))
    yield close("error over the rate at 30.41 mm", size, 7.8e-5, 0.05e-5)


# --- the checks of each equation

STRAIGHT_BASE = "a straight base between the gauges"


def _geometry(*arguments, **by_symbol):
    return derived(wall.TURNED, wall.by_geometry(*arguments, **by_symbol))


CHECKS: check.Checks = {
    "4-1": derived(STRAIGHT_BASE, on_straight_base(CENTRE)),
    "4-2": derived(STRAIGHT_BASE, on_straight_base(BETWEEN - CENTRE)),
    "4-3": derived(STRAIGHT_BASE, on_straight_base(PROFILE.subs(PLACE, 30))),
    "4-4": derived(STRAIGHT_BASE, on_straight_base(PROFILE.subs(PLACE, BETWEEN - 30))),
    "4-6": _geometry(wall.edge_uplift),
    "4-7": reproduced("the choices of the text: the centreline, and Table A-1", _migration),
    "4-9": _geometry(wall.with_numbers(wall.edge_uplift)),
    "4-10": derived(
        "chord on which the mouth of the duct moves",
        _chord,
        "order 3 in theta, 3/8 (d - B) theta**3: 0.006 % of the extension at 30 mm",
    ),
    "4-11": _geometry(
        lambda side: wall.turned(side, th.d_tendon)[1] / cos(th.theta), u_edge=wall.edge_uplift
    ),
    "4-12": _geometry(wall.tendon_extension, u_edge=wall.edge_uplift),
    "4-13": _geometry(wall.tendon_extension),
    "4-14": _geometry(wall.tendon_extension, u_edge=wall.edge_uplift),
    "4-15": _geometry(wall.with_numbers(wall.tendon_extension), B=wall.half_width),
    "4-33": _geometry(lambda side: wall.turned(side, sp.S.Zero, th.H)[0]),
    "4-34": derived("derivative of 4-33", states(lambda side: rate(wall.right("4-33")))),
    "4-35": derived("second derivative of 4-33", states(lambda side: rate(wall.right("4-33"), 2))),
    "B-1": _geometry(wall.tendon_uplift, u_edge=wall.edge_uplift),
    "B-2": _geometry(wall.tendon_uplift, u_edge=wall.edge_uplift),
    "B-3": _geometry(wall.with_numbers(wall.tendon_uplift), B=wall.half_width),
    "B-5": _geometry(lambda side: sp.S.Zero),
    "B-6": derived("derivative of 4-33", wall.by_geometry(rate_of_rotation)),
    "B-7": derived("Taylor series of B-6", _small_rate, "order 2 in Delta/H: 0.008 % at 30.41 mm"),
}
