"""Relations of the thesis made slightly wrong, and whether the checks notice."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from rockeom.thesis import CHECKS, Equation
from rockeom.thesis.equation import Relations

HUNDREDTH = sp.Rational(101, 100)


def notices(equation: Equation, relations: Relations) -> bool:
    """Whether a finding of any check of the equation does not hold for these relations."""
    return any(
        not finding.holds
        for check in CHECKS[equation.number]
        for finding in check.find(equation, relations)
    )


def with_more(equation: Equation, i: int, symbol: sp.Symbol | None) -> Relations:
    """One relation with a hundredth more: of its right side (None), or of a symbol in it."""
    relations = list(equation.right)
    if symbol is None:
        relations[i] = sp.Eq(relations[i].lhs, _more(relations[i].rhs), evaluate=False)
    else:
        relations[i] = _changed(relations[i], lambda side: side.subs(symbol, HUNDREDTH * symbol))
    return tuple(relations)


def symbols_in(relation: sp.Eq) -> list[sp.Symbol]:
    """Those of the right side, and of the left one unless it is one symbol; no double sign."""
    found = set(relation.rhs.free_symbols)
    if not relation.lhs.is_Symbol:
        found |= relation.lhs.free_symbols
    return sorted((x for x in found if str(x) != r"\pm"), key=str)


def _changed(relation: sp.Eq, change: Callable[[sp.Expr], sp.Expr]) -> sp.Eq:
    """Both sides of an equation of motion are changed, of another the right side."""
    left = relation.lhs if relation.lhs.is_Symbol else change(relation.lhs)
    return relation.func(left, change(relation.rhs), evaluate=False)


def _more(expr: sp.Expr) -> sp.Expr:
    if isinstance(expr, sp.Piecewise):
        return sp.Piecewise(*((HUNDREDTH * value, condition) for value, condition in expr.args))
    return HUNDREDTH * expr
