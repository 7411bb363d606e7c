"""Slips of Appendix D that the check of a single equation does not show."""

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS, appendix_d, notation as th
from rockeom.thesis.checks.appendix_d import lagranges_equation, theta_t
from rockeom.thesis.checks.engine import energies, residual, shipped, velocity
from rockeom.thesis.comparison import in_engine_notation, normal_form


def test_d_5_with_the_printed_d_14_gives_another_inertia():
    """R_b for R_b**2 goes into the equation of motion: the thesis's 5-34 has it right."""
    (statement,), (printed,) = EQUATIONS["D-5"].right, EQUATIONS["D-14"].printed
    force = EQUATIONS["D-17"].right[0].rhs
    derived = lagranges_equation(statement, printed.rhs, theta_t, force)
    difference = in_engine_notation(derived, 1) - residual(shipped("flexible_structure"), 1, 0)
    slip = in_engine_notation(th.m_b * th.R_b * (1 - th.R_b) * th.theta_dd, 1)
    assert normal_form(difference - slip) == 0
    assert normal_form(slip) != 0


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
    right = in_engine_notation(appendix_d.d_8_squares(th.theta_d, sp.sin)[component], 1)
    printed = in_engine_notation(appendix_d.d_8_squares(1, sp.cos)[component], 1)
    slip = in_engine_notation(SQUARES_WRONG_BY[component], 1)
    assert normal_form(right - exact) == 0
    assert normal_form(printed - exact - slip) == 0
    assert normal_form(slip) != 0
