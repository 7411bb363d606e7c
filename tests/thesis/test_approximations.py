"""Approximations of the thesis that the checks of single equations do not reach."""

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS, notation as th
from rockeom.thesis.checks.approximations import APPROXIMATIONS
from rockeom.thesis.comparison import ALPHA, SCALED, in_engine_notation, normal_form


@pytest.mark.parametrize("number", APPROXIMATIONS)
def test_stated_error_is_not_zero(number):
    """A check of the order of an error that vanishes would check nothing."""
    assert APPROXIMATIONS[number].error != 0


def test_slender_limit_does_not_show_the_slip_of_2_13():
    """alpha(1 - x) and alpha**2(1 - x) both vanish: 2-14 follows from the printed form too."""
    x = SCALED["x"]
    for side in (1, -1):
        (printed,), (limit,) = EQUATIONS["2-13"].printed, EQUATIONS["2-14"].right
        difference = in_engine_notation((printed.lhs - printed.rhs) / th.alpha, side)
        difference -= in_engine_notation(limit.lhs - limit.rhs, side)
        assert x in difference.free_symbols
        assert normal_form(sp.limit(difference, ALPHA, 0)) == 0
