"""Appendix D step by step: its own Lagrangian, put into its own Lagrange's equation.

Here the coordinates are functions of time and SymPy differentiates by time; the engine works
with symbols for the velocities instead.
"""

from __future__ import annotations

import cmath

import numpy as np
import pytest
import sympy as sp

from rockeom.symbolic.model import turned

from . import printed as th
from .compare import at_side, in_engine_notation, normal_form
from .derived import disagreement, energies, residual, shipped, velocity
from .printed import EQUATIONS

theta_t, u_t = sp.Function("theta")(th.t), sp.Function("u")(th.t)
IN_TIME = {
    th.theta: theta_t,
    th.u: u_t,
    th.theta_d: theta_t.diff(th.t),
    th.u_d: u_t.diff(th.t),
}
AT_ONE_TIME = {
    theta_t.diff(th.t, 2): th.theta_dd,
    u_t.diff(th.t, 2): th.u_dd,
    theta_t.diff(th.t): th.theta_d,
    u_t.diff(th.t): th.u_d,
    theta_t: th.theta,
    u_t: th.u,
}


def lagranges_equation(lagrangian: sp.Expr, coordinate: sp.Expr, force: sp.Expr) -> sp.Expr:
    """D-5 as typed, for one coordinate: left minus right side."""
    (statement,) = EQUATIONS["D-5"].right
    (dissipation,) = EQUATIONS["D-15"].right
    concrete = statement.lhs.subs(th.q_t, coordinate)
    concrete = concrete.replace(th.LAGRANGIAN, lambda *_: lagrangian.subs(IN_TIME))
    concrete = concrete.replace(th.DISSIPATION, lambda *_: dissipation.rhs.subs(IN_TIME))
    left = concrete.doit()
    for derivative, symbol in AT_ONE_TIME.items():
        left = left.subs(derivative, symbol)
    return left - force


def right_side(number: str) -> sp.Expr:
    return EQUATIONS[number].right[-1].rhs


CASES = {"D-19": (theta_t, "D-17", 0), "D-20": (u_t, "D-18", 1)}


@pytest.mark.parametrize("number", CASES)
def test_d_5_with_d_14_gives_the_equation_of_motion(number):
    coordinate, force, row = CASES[number]
    derived = lagranges_equation(right_side("D-14"), coordinate, right_side(force))
    (stated,) = EQUATIONS[number].right
    in_symbols = in_engine_notation(derived, 1)
    assert normal_form(in_symbols - in_engine_notation(stated.lhs - stated.rhs, 1)) == 0
    assert normal_form(in_symbols - residual(shipped("flexible_structure"), 1, row)) == 0


def test_d_5_with_the_printed_d_14_gives_another_inertia():
    """R_b for R_b**2 goes into the equation of motion: the thesis's 5-34 has it right."""
    (printed,) = EQUATIONS["D-14"].printed
    derived = lagranges_equation(printed.rhs, theta_t, right_side("D-17"))
    difference = in_engine_notation(derived, 1) - residual(shipped("flexible_structure"), 1, 0)
    slip = in_engine_notation(th.m_b * th.R_b * (1 - th.R_b) * th.theta_dd, 1)
    assert normal_form(difference - slip) == 0
    assert normal_form(slip) != 0


@pytest.mark.parametrize("number", ["D-6", "D-7"])
def test_definition_holds_of_the_derived_energies(number):
    assert disagreement(number, EQUATIONS[number].right, 1) == [0]


def test_potential_and_kinetic_energy_are_not_exchangeable_in_d_6():
    known = energies(shipped("flexible_structure"), 1)
    assert normal_form(known[th.T] - known[th.V]) != 0


SQUARES_WRONG_BY = (
    2 * th.u * th.u_d * (th.theta_d - 1) * sp.sin(th.theta) * sp.cos(th.theta),
    -2 * th.u * th.u_d * (th.theta_d - 1) * sp.sin(th.theta) * sp.cos(th.theta)
    + th.u_d**2 * sp.cos(2 * th.theta),
)


@pytest.mark.parametrize("component", [0, 1], ids=["D-8, first square", "D-8, second square"])
def test_each_square_of_d_8_is_that_of_a_velocity(component):
    """The missing theta' of the two terms 2 u u' sin cos cancels in their sum."""
    exact = velocity(shipped("flexible_structure"), 1, 0)[component] ** 2
    right = in_engine_notation(th.D_8_SQUARES_CORRECTED[component], 1)
    printed = in_engine_notation(th.D_8_SQUARES[component], 1)
    slip = in_engine_notation(SQUARES_WRONG_BY[component], 1)
    assert normal_form(right - exact) == 0
    assert normal_form(printed - exact - slip) == 0
    assert normal_form(slip) != 0


@pytest.mark.parametrize(("number", "axis"), [("D-9", 0), ("D-10", 1)])
@pytest.mark.parametrize("side", [1, -1])
def test_angle_sum_is_one_turn_after_another(number, axis, side):
    (relation,) = EQUATIONS[number].right
    first = turned((0, 1), (0, 0), th.A_angle)
    twice = turned(first, (0, 0), side * th.B_angle)
    assert sp.expand(at_side(relation.rhs, side) - twice[axis]) == 0
    for a, b in np.random.default_rng(9).uniform(-3, 3, (10, 2)):
        whole = cmath.exp(1j * (a + side * b))
        put = {th.A_angle: a, th.B_angle: b}
        assert float(at_side(relation.rhs, side).subs(put)) == pytest.approx(
            whole.imag if number == "D-9" else whole.real, abs=1e-14
        )
        assert float(at_side(relation.lhs, side).subs(put)) == pytest.approx(
            whole.imag if number == "D-9" else whole.real, abs=1e-14
        )
