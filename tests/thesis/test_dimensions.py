"""The dimensions of all equations, by the units of their symbols and numbers."""

from dataclasses import replace

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS, NOTATION, dimensions, entry, notation as th
from rockeom.thesis.appendix_d import d_8_squares
from rockeom.thesis.dimensions import DimensionError, check_dimensions
from rockeom.thesis.equation import says


def is_inconsistent(number: str, form: str) -> bool:
    try:
        check_dimensions(EQUATIONS[number], getattr(EQUATIONS[number], form))
    except DimensionError:
        return True
    return False


def test_right_forms_are_consistent_and_three_printed_ones_are_not():
    assert [number for number in EQUATIONS if is_inconsistent(number, "right")] == []
    wrong = [number for number in EQUATIONS if is_inconsistent(number, "printed")]
    assert wrong == ["5-29", "D-12", "D-14"]


@pytest.mark.parametrize("square", d_8_squares(1, sp.cos))
def test_rate_that_each_square_of_d_8_lacks_is_noticed(square):
    """In their sum the two terms cancel."""
    with pytest.raises(DimensionError):
        check_dimensions(EQUATIONS["D-8"], says(th.v_e**2, square))


def test_other_unit_of_any_symbol_is_noticed(monkeypatch):
    """But of those that 2-33 and 2-35 count in seconds."""
    unnoticed = set()
    for one in NOTATION:
        uses = [
            number
            for number, equation in EQUATIONS.items()
            if one.symbol in equation.symbols and entry(one.symbol, equation.chapter) is one
        ]
        changed = {id(one): replace(one, unit=f"{one.unit} kg5")}

        def with_change(symbol, chapter, changed=changed):
            return changed.get(id(entry(symbol, chapter)), entry(symbol, chapter))

        monkeypatch.setattr(dimensions, "entry", with_change)
        if uses and not any(is_inconsistent(number, "right") for number in uses):
            unnoticed.add(one.symbol.name)
    assert unnoticed == {"T_e", "c"}
