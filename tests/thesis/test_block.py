"""The block's equations that are more than a comparison: scaling, and the speed after a fall."""

from __future__ import annotations

import pytest
import sympy as sp

from . import printed as th
from .compare import ALPHA, BLOCK, R, at_side, in_engine_notation, normal_form
from .derived import THETA, THETA_D, in_polar, rectangular, residual, scaled, shipped
from .printed import EQUATIONS


@pytest.mark.parametrize("number", ["2-13"])
@pytest.mark.parametrize("side", [1, -1])
def test_scaled_block_is_the_non_dimensional_one(number, side):
    """2-10 to 2-12 put into the derived 2-9: the corrected 2-13 and not the printed one."""
    inertia = BLOCK["inertia"] + BLOCK["mass"] * R**2
    derived = scaled(in_polar(residual(shipped("rigid_block"), side)), inertia, R)

    def minus(relation: sp.Eq) -> sp.Expr:
        return normal_form(in_engine_notation(relation.lhs - relation.rhs, side) - derived)

    (printed,), (right,) = EQUATIONS[number].printed, EQUATIONS[number].right
    assert minus(right) == 0
    assert minus(printed) != 0


def test_scaling_of_2_10_to_2_12_makes_gravity_and_time_dimensionless():
    """alpha x'' = I_o / (m g R) theta'', and omega t = Omega tau, as the thesis uses them."""
    (rotation,), (frequency,), (time,) = (EQUATIONS[n].right for n in ("2-10", "2-11", "2-12"))
    clock = sp.diff(time.rhs, th.tau)
    in_clock = th.theta_dd / th.alpha / clock**2  # x'' by the chain rule, x = theta / alpha
    assert rotation.rhs == th.theta / th.alpha
    assert sp.simplify(in_clock - th.I_o / (th.m * th.g * th.R) * th.theta_dd / th.alpha) == 0
    assert sp.simplify(frequency.rhs * time.rhs - th.Omega * th.tau) == 0


@pytest.mark.parametrize("side", [1, -1], ids=["3-13, theta > 0", "3-13, theta < 0"])
def test_largest_speed_is_that_of_a_fall_from_alpha(side):
    equations = shipped("rigid_block").equations("right" if side > 0 else "left")

    def at(expr: sp.Expr, theta) -> sp.Expr:
        return rectangular(in_polar(expr)).subs(THETA, theta)

    fall = at(equations.gravitational_energy, side * ALPHA)
    fall -= at(equations.gravitational_energy, 0)
    (relation,) = EQUATIONS["3-13"].right
    stated = at_side(relation.rhs, side)
    speed_squared = in_engine_notation(stated**2, side)
    kinetic = at(equations.kinetic_energy, 0)
    assert normal_form(kinetic.subs(THETA_D, sp.sqrt(speed_squared)) - fall) == 0
    assert at_side(relation.rhs, -side) == -stated
