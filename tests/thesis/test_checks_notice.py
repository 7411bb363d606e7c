"""The checks notice an equation that is slightly wrong: nothing is decided by looking away."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS
from rockeom.thesis.checks import appendix_b, chapter_2, chapter_4

from .wrong import notices, symbols_in, with_more

UNSEEN = {
    ("2-9", 0): "the right side is zero",
    ("2-19b", 0): "the right side is zero",
    ("3-17", 0): "measured: impacts of the same speed differ by more",
    ("3-18", 0): "measured: impacts of the same speed differ by more",
}


def right_sides() -> Iterator[tuple[str, int, sp.Symbol | None]]:
    for number in EQUATIONS:
        for i in range(len(EQUATIONS[number].right)):
            if (number, i) not in UNSEEN:
                yield number, i, None


def each_symbol() -> Iterator[tuple[str, int, sp.Symbol | None]]:
    for number in (n for module in (chapter_2, chapter_4, appendix_b) for n in module.CHECKS):
        for i, relation in enumerate(EQUATIONS[number].right):
            for symbol in symbols_in(relation):
                yield number, i, symbol


@pytest.mark.parametrize(("number", "i", "symbol"), [*right_sides(), *each_symbol()])
def test_a_hundredth_too_much_is_noticed(number, i, symbol):
    """Of the right side (None), or of one symbol wherever it stands."""
    equation = EQUATIONS[number]
    assert notices(equation, with_more(equation, i, symbol))
