"""The checks of 2.6, of chapters 3 and 5 and of Appendix D notice an equation that is wrong."""

from __future__ import annotations

import pytest
import sympy as sp

from rockeom.thesis import CHECKS, EQUATIONS
from rockeom.thesis.checks import appendix_d, chapter_3, chapter_5, section_2_6

HUNDREDTH = sp.Rational(101, 100)
UNSEEN = {
    ("2-19b", 0): "the right side is zero",
    ("3-17", 0): "measured: impacts of the same speed differ by more",
    ("3-18", 0): "measured: impacts of the same speed differ by more",
}


def more(expr: sp.Expr) -> sp.Expr:
    if isinstance(expr, sp.Piecewise):
        return sp.Piecewise(*((HUNDREDTH * value, condition) for value, condition in expr.args))
    return HUNDREDTH * expr


@pytest.mark.parametrize(
    ("number", "i"),
    [
        (number, i)
        for module in (section_2_6, chapter_3, chapter_5, appendix_d)
        for number in module.CHECKS
        for i in range(len(EQUATIONS[number].right))
        if (number, i) not in UNSEEN
    ],
)
def test_a_hundredth_too_much_is_noticed(number, i):
    equation = EQUATIONS[number]
    relations = list(equation.right)
    relations[i] = sp.Eq(relations[i].lhs, more(relations[i].rhs), evaluate=False)
    findings = (f for check in CHECKS[number] for f in check.find(equation, tuple(relations)))
    assert not all(finding.holds for finding in findings)
