"""The equations of motion once more, by Newton's laws and with numbers.

Positions are complex numbers, turned clockwise by exp(-i theta) about the pivot, and the moments
of inertia forces and weights are summed. SymPy only puts numbers into the thesis's formulas: the
engine has no part in this.
"""

from collections.abc import Callable

import numpy as np
import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS, notation as th
from rockeom.thesis.comparison import at_side

STATES = 20
TOLERANCE = 1e-10


def random_state(rng: np.random.Generator, side: int) -> dict[sp.Symbol, float]:
    """A state of the two masses and of the block, with theta on the given side."""
    n = {
        th.theta: side * rng.uniform(0.01, 0.5),
        th.u: rng.uniform(-0.2, 0.2),
        th.g: rng.uniform(5, 15),
    }
    for symbol in (th.theta_d, th.theta_dd, th.u_d, th.u_dd, th.a_g):
        n[symbol] = rng.uniform(-3, 3)
    for symbol in (th.m_e, th.m_b, th.I_eg, th.I_bg, th.H_e, th.H_b, th.B, th.k, th.c):
        n[symbol] = rng.uniform(0.3, 3)
    for radius, angle, height in (
        (th.R_e, th.alpha_e, th.H_e),
        (th.R_b, th.alpha_b, th.H_b),
        (th.R, th.alpha, th.H_e),
    ):
        n[radius], n[angle] = np.hypot(n[th.B], n[height]), np.arctan2(n[th.B], n[height])
    n[th.m] = n[th.m_e]
    n[th.I_o] = n[th.I_eg] + n[th.m] * n[th.R] ** 2
    n[th.I_O] = sum(
        n[inertia] + n[mass] * n[radius] ** 2
        for inertia, mass, radius in (
            (th.I_eg, th.m_e, th.R_e),
            (th.I_bg, th.m_b, th.R_b),
        )
    )
    n[th.a_gx] = n[th.a_g]
    return n


def turning(n, side: int, height: float, u=0.0, u_d=0.0, u_dd=0.0) -> tuple[complex, complex]:
    """Position from the pivot and acceleration relative to the ground of a point of the axis."""
    w = u - side * n[th.B] + 1j * height
    turn = np.exp(-1j * n[th.theta])
    acceleration = (
        u_dd - 2j * n[th.theta_d] * u_d - 1j * n[th.theta_dd] * w - n[th.theta_d] ** 2 * w
    )
    return turn * w, turn * acceleration


def loads(n, mass: float, acceleration: complex) -> complex:
    """Inertia force and weight of a mass."""
    return -mass * (acceleration + n[th.a_g] + 1j * n[th.g])


def clockwise(place: complex, force: complex) -> float:
    return -(place.conjugate() * force).imag


def moments(n, side: int, *, flexible: bool = False, base: bool = True) -> float:
    """What the moments about the pivot lack of zero: left minus right side of a rotation."""
    deformation = (n[th.u], n[th.u_d], n[th.u_dd]) if flexible else ()
    parts = [(th.m_e, th.I_eg, th.H_e, deformation)]
    parts += [(th.m_b, th.I_bg, th.H_b, ())] if base else []
    total = 0.0
    for mass, inertia, height, deformed in parts:
        place, acceleration = turning(n, side, n[height], *deformed)
        total += clockwise(place, loads(n, n[mass], acceleration)) - n[inertia] * n[th.theta_dd]
    return -total


def across_the_column(n, side: int) -> float:
    """What the forces on the superstructure, at right angles to the column, lack of zero."""
    _, acceleration = turning(n, side, n[th.H_e], n[th.u], n[th.u_d], n[th.u_dd])
    along = np.exp(-1j * n[th.theta])
    pushed = (along.conjugate() * loads(n, n[th.m_e], acceleration)).real
    return n[th.k] * n[th.u] + n[th.c] * n[th.u_d] - pushed


def block(n, side: int) -> float:
    return moments(n, side, base=False)


def model_a(n, side: int) -> float:
    return moments(n, side) / n[th.I_O]


def model_c(n, side: int) -> float:
    return moments(n, side, flexible=True)


def centroid_acceleration(n, side: int) -> complex:
    return turning(n, side, n[th.H_e])[1] + n[th.a_g]


def support(n, side: int) -> complex:
    """Force of the ground on the block."""
    return n[th.m] * (centroid_acceleration(n, side) + 1j * n[th.g])


NEWTON = {
    "2-2": block,
    "2-9": block,
    "3-6": lambda n, side: -centroid_acceleration(n, side).real,
    "3-7": lambda n, side: -centroid_acceleration(n, side).imag,
    "3-8": lambda n, side: -support(n, side).real,
    "3-9": lambda n, side: -support(n, side).imag,
    "5-9": model_a,
    "5-10": model_a,
    "5-11": model_a,
    "5-34": model_c,
    "5-35": across_the_column,
    "D-19": model_c,
    "D-20": across_the_column,
    "D-23": model_c,
    "D-24": across_the_column,
    "D-25": model_c,
    "D-26": across_the_column,
}
"""Left minus right side of an equation by Newton, left sides of no state (3-6 to 3-9) as zero."""

NO_STATE = (th.u_cx_dd, th.u_cy_dd, th.F_H, th.F_V)


def function(relation: sp.Eq, side: int) -> tuple[Callable[..., float], list[sp.Symbol]]:
    """Left minus right side as a function of numbers, and the order of its arguments."""
    stated = at_side(relation.lhs - relation.rhs, side).subs(dict.fromkeys(NO_STATE, 0))
    symbols = sorted(stated.free_symbols, key=str)
    return sp.lambdify(symbols, stated, "math"), symbols


def largest_difference(number: str, relations) -> float:
    """Thesis minus Newton at random states of every side the equation is meant for."""
    rng = np.random.default_rng([ord(letter) for letter in number])
    (relation,) = relations
    differences = []
    for side in EQUATIONS[number].sides:
        thesis, symbols = function(relation, side)
        for _ in range(STATES):
            n = random_state(rng, side)
            if number == "2-2":
                n[th.a_g] = 0.0
            differences.append(thesis(*(n[x] for x in symbols)) - NEWTON[number](n, side))
    return float(np.abs(differences).max())


@pytest.mark.parametrize("number", NEWTON)
def test_equation_follows_from_newton(number):
    equation = EQUATIONS[number]
    assert largest_difference(number, equation.right) < TOLERANCE


@pytest.mark.parametrize("number", [n for n in NEWTON if EQUATIONS[n].is_erratum])
def test_printed_form_does_not_follow_from_newton(number):
    assert largest_difference(number, EQUATIONS[number].printed) > 1e-2


def test_printed_2_13_does_not_follow_from_newton_in_scaled_time():
    """The block's moments over m g R, rotation and time scaled by 2-10 to 2-12."""
    rng = np.random.default_rng(213)
    worst = {"printed": 0.0, "right": 0.0}
    for side in (1, -1):
        states = [random_state(rng, side) for _ in range(STATES)]
        for n in states:
            unit = n[th.m] * n[th.g] * n[th.R]
            n[th.x] = n[th.theta] / n[th.alpha]
            n[th.x_dd] = n[th.theta_dd] * n[th.I_o] / unit / n[th.alpha]
            n[th.omega], n[th.t] = rng.uniform(0.5, 5, 2)
            shape = n[th.alpha] * n[th.g] * np.cos(n[th.omega] * n[th.t])
            n[th.beta] = n[th.a_g] / shape
        for form in worst:
            (relation,) = getattr(EQUATIONS["2-13"], form)
            thesis, symbols = function(relation, side)
            for n in states:
                newton = block(n, side) / (n[th.m] * n[th.g] * n[th.R])
                difference = abs(thesis(*(n[x] for x in symbols)) - newton)
                worst[form] = max(worst[form], difference)
    assert worst["right"] < TOLERANCE
    assert worst["printed"] > 1e-2
