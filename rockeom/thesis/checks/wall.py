"""The wall of the tests of chapter 4, for the checks of its equations: numbers and geometry.

The rotated wall follows plane geometry: its points turn about the centre of rotation O, which lies
on its base. Lengths are in mm where the numbers of the thesis are, with forces in kN and energies
in J.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import sympy as sp
from sympy import Rational, cos, sin

from rockeom.analysis.identification import free_vibration
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks.check import Find, states

# --- the wall of the tests

HALF_WIDTH, HEIGHT, CENTROID = 508, 2438, 2173
"""B, H and H_c [mm]; H is inferred, see `rockeom.analysis.Wall.thesis`."""
REMAINS, VANISHES, PENALTY = 96, 412, Rational("3.551")
"""C_2, C_1 and epsilon [mm], as printed in 4-7."""
MASS = Rational("2016.06")  # B-9: 577.56 + 1438.5 [kg]
GRAVITY = Rational("9.81")
MODULUS, AREA, ANCHORS = Rational(205), Rational("176.7"), 3100  # kN/mm2, mm2, mm
FORCE, LATER_FORCE, YIELD = Rational("75.6"), Rational("111.0"), Rational("159.03")  # kN
LENGTH = ANCHORS / (1 + FORCE / (MODULUS * AREA))
"""Unstressed length of the tendon, which is 3100 mm long under 75.6 kN [mm]."""
STIFFNESS = MODULUS * AREA / LENGTH  # kN/mm
FALL = 30.41
"""Displacement of the release [mm]."""

WALL = {
    th.B: HALF_WIDTH,
    th.H: HEIGHT,
    th.H_c: CENTROID,
    th.C_1: VANISHES,
    th.C_2: REMAINS,
    th.penalty: PENALTY,
    th.n: PENALTY,
    th.m: MASS,
    th.m_T: MASS,
    th.M_e: MASS,
    th.g: GRAVITY,
    th.E_tendon: MODULUS,
    th.A_tendon: AREA,
    th.L_T: LENGTH,
    th.L_T0: LENGTH,
    th.P_initial: FORCE,
}


def right(number: str, which: int = 0) -> sp.Expr:
    """Right-hand side of a relation of an equation, in the form that holds."""
    return EQUATIONS[number].right[which].rhs


@cache
def corner_inertia() -> float:
    """I_o about a corner of the wall, by the corrected B-9 [kg m2]."""
    metres = {th.H: HEIGHT / 1e3, th.B: HALF_WIDTH / 1e3, th.d_lifted: 2 * HALF_WIDTH / 1e3}
    return float(right("B-9").subs(metres))


def radius() -> float:
    """R, from the corner to the centroid [m]."""
    return math.hypot(HALF_WIDTH, CENTROID) / 1e3


def measured() -> Any:
    """Table A-1, in SI units."""
    return free_vibration.FreeVibration.table_a1()


def r_squared(measured: np.ndarray, computed: np.ndarray) -> float:
    """Coefficient of determination of computed values."""
    return float(free_vibration.coefficient_of_determination(measured, computed))


def of_displacement(expr: sp.Expr) -> Callable:
    """`expr` with the wall's numbers, as a function of Delta [mm]."""
    numbers = {symbol: sp.sympify(value) for symbol, value in WALL.items()}
    return sp.lambdify(th.Delta, expr.xreplace(numbers), "numpy")


def sizes_of_peaks() -> np.ndarray:
    """Absolute displacements of the peaks of Table A-1 [mm]."""
    record = measured()
    return 1e3 * np.abs(record.displacement[record.at_peak])


def legible_peaks() -> np.ndarray:
    """Which rows of Table A-1 are peaks that can be read."""
    record = measured()
    return record.at_peak & (record.reading == "clean")


def developed(name: str) -> float:
    """Mean distance of the centre of rotation [mm] at the legible peaks to the right.

    name : "centre_from_edge", the last column of Table A-1, or "rotation_centre", by the uplifts.
    """
    record = measured()
    distance = getattr(record, name)
    distance = distance(HALF_WIDTH / 1e3) if callable(distance) else distance
    return float(1e3 * distance[legible_peaks() & (record.displacement > 0)].mean())


# --- geometry

HALF, SCALE, UP = sp.symbols("tan(|theta|/2) scale up", positive=True)
"""Sine, cosine and square root are rational in the first two, so that a zero reduces to zero."""

TURNED = "points of the wall turned about O"
"""The derivation of the checks by plane geometry, in words."""


def turned(side: int, from_centre: sp.Expr, height: sp.Expr | int = 0) -> tuple[sp.Expr, sp.Expr]:
    """Displacement, to the right and upward, of a point of the wall that turns about O.

    from_centre : its distance from O along the base, on the side that lifts.
    """
    x, y = -side * from_centre, height
    return (x * cos(th.theta) + y * sin(th.theta) - x, -x * sin(th.theta) + y * cos(th.theta) - y)


def placed(expr: sp.Expr, side: int) -> sp.Expr:
    """`expr` with rotation, displacement and height in terms of HALF and SCALE."""
    sway, up, height = 2 * HALF, 1 - HALF**2, 1 + HALF**2
    expr = expr.subs(th.H**2 - th.Delta**2, UP**2)
    at = {
        sin(th.theta): side * sway / height,
        cos(th.theta): up / height,
        sp.tan(th.theta): side * sway / up,
        th.Delta: side * sway * SCALE,
        th.H: height * SCALE,
        UP: up * SCALE,
    }
    return expr.xreplace(at)


def reduced(expr: sp.Expr) -> sp.Expr:
    """`expr`, rational except for exponentials, in lowest terms, which are zero for a zero only."""
    bells = {bell: sp.Dummy("bell") for bell in expr.atoms(sp.exp)}
    lowest = sp.cancel(sp.together(expr.subs(bells)))
    return lowest.subs({name: bell for bell, name in bells.items()})


def lifted() -> sp.Expr:
    """d by 4-8 with the numbers of the printed 4-7."""
    distance = right("4-8").subs({th.C_1: VANISHES, th.C_2: REMAINS})
    return (2 * HALF_WIDTH - distance) / cos(th.theta)


def by_geometry(exact: Callable[[int], sp.Expr], **by_symbol: Callable[[int], sp.Expr]) -> Find:
    """Check that the right side equals `exact(side)`, once `by_symbol` replaces its symbols."""

    def put(expr: sp.Expr, side: int) -> sp.Expr:
        return placed(expr.subs({getattr(th, n): e(side) for n, e in by_symbol.items()}), side)

    return states(lambda side: put(exact(side), side), "thesis minus geometry", put, reduced)


def edge_uplift(side: int) -> sp.Expr:
    """Uplift of the edge that lifts."""
    return turned(side, th.d_lifted)[1]


def tendon_uplift(side: int) -> sp.Expr:
    """Uplift of the foot of the tendon, which is on the centreline, B from the edge."""
    return turned(side, th.d_lifted - th.B)[1]


def tendon_extension(side: int) -> sp.Expr:
    """Extension of the tendon by 4-10."""
    return tendon_uplift(side) / cos(th.theta)


def with_numbers(exact: Callable[[int], sp.Expr]) -> Callable[[int], sp.Expr]:
    """`exact` with the numbers of B and d."""
    put = {th.B: HALF_WIDTH}
    return lambda side: exact(side).subs(put).subs(th.d_lifted, lifted())


def half_width(side: int) -> sp.Expr:
    """B [mm] on either side."""
    return sp.Integer(HALF_WIDTH)
