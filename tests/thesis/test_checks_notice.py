"""The checks notice an equation that is slightly wrong: nothing is decided by looking away."""

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS, notation as th
from rockeom.thesis.checks import (
    chapter_2,
    chapter_4_free_vibration,
    chapter_4_geometry,
    chapter_4_oscillator,
    section_2_6,
    shipped_walls,
)
from rockeom.thesis.comparison import PIER, differs_somewhere

from .wrong import unnoticed

CHAPTER_4 = chapter_4_geometry, chapter_4_free_vibration, chapter_4_oscillator, shipped_walls
BY_HAND = {n for m in (chapter_2, section_2_6, *CHAPTER_4) for n in m.CHECKS}
"""Those whose checks are not one comparison of all symbols with what the engine derives."""

UNNOTICED = {
    "2-19b": (1, "the delta vanishes beside x = 0, whatever its argument is multiplied by"),
    "2-19c": (2, "any interval that contains zero will do"),
    "2-22": (1, "any interval that contains zero will do"),
    "D-16": (1, "the position of the base does not depend on u: the term is zero"),
    "3-17": (2, "the text bears the coefficients out within 5, 2 and 20 %"),
    "3-18": (2, "the text bears the coefficients out within 3 and 2 %, the last one by its sign"),
}
"""How many slips leave the equation as right as it was, or as near to its data, and why."""


@pytest.mark.parametrize("number", EQUATIONS)
def test_slip_of_a_number_or_a_sign_is_noticed(number):
    """By one hundredth, and by a sign; of the equations in BY_HAND also of each symbol."""
    found = unnoticed(EQUATIONS[number], everything=number in BY_HAND)
    assert len(found) == UNNOTICED.get(number, (0, ""))[0], found


def test_numbers_tell_no_two_forms_of_the_same_apart():
    """They may refute only: a difference that is zero is left to the reduction."""
    theta, width, height = (PIER[name] for name in ("theta", "half_width", "height"))
    turn = sp.sin(2 * theta) - 2 * sp.sin(theta) * sp.cos(theta)
    radius = th.R_e**2 - width**2 - height**2
    assert not any(differs_somewhere(e) for e in (turn, radius, turn / radius, sp.nan, sp.oo))
    assert differs_somewhere(turn + sp.Rational(1, 10**8) * theta)
    assert differs_somewhere(radius * sp.Rational(101, 100) + height**2 / 100)


def test_numbers_of_other_functions_and_of_complex_roots_are_found_too():
    theta, height = PIER["theta"], PIER["height"]
    root = sp.sqrt(-1 - height)
    assert differs_somewhere(root * sp.conjugate(root) + height)
    assert not differs_somewhere(root**2 + 1 + height)
    assert differs_somewhere(sp.exp(theta) - 1 - theta)
