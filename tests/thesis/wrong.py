"""Relations of the thesis made slightly wrong, and whether the checks notice."""

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.thesis import CHECKS, Equation
from rockeom.thesis.equation import Relations

MORE, LESS = sp.Rational(101, 100), sp.Rational(99, 100)
EVEN = (sp.cos, sp.cosh, sp.Abs, sp.DiracDelta)

Slip = tuple[tuple, sp.Basic]
"""What is wrong, in words and expressions, and the expression with it."""


def notices(equation: Equation, relations: Relations) -> bool:
    """Whether these relations fail a check; one that breaks off passes none, as in `decide`."""
    for check in CHECKS[equation.number]:
        try:
            if not all(finding.holds for finding in check.find(equation, *relations)):
                return True
        except Exception:
            return True
    return False


def unnoticed(equation: Equation, everything: bool) -> list[str]:
    """Slips of an equation that none of its checks notices."""
    tried = {relations: words for words, relations in slips(equation.right, everything)}
    found = [words for relations, words in tried.items() if not notices(equation, relations)]
    return [" ".join(map(str, words)) for words in found]


def slips(right: Relations, everything: bool) -> Iterator[tuple[tuple, Relations]]:
    """Every number 1 % more, every sign turned, and the right side 1 % more.

    Signs are those of the right side, of each term of any sum within it, and of the argument of
    any function. Numbers do not include exponents. The same for the left side, if it is no symbol.

    everything : also every number 1 % less, and 1 % more of every symbol at each place where it
        stands.
    """
    for i, relation in enumerate(right):
        for side in (0, 1):
            whole = relation.args[side]
            named = whole.is_Symbol or isinstance(whole, AppliedUndef)
            if whole == 0 or (side == 0 and named):
                continue
            found = [*(_of_whole(whole) if side else ()), *_within(whole, everything)]
            for words, wrong in found:
                sides = (wrong, relation.rhs) if side == 0 else (relation.lhs, wrong)
                changed = relation.func(*sides, evaluate=False)
                if changed != relation:
                    one = (*right[:i], changed, *right[i + 1 :])
                    yield (*words, "relation", i), one


def _of_whole(expr: sp.Basic) -> Iterator[Slip]:
    """Each case of a brace is a side of its own."""
    if isinstance(expr, sp.Piecewise):
        for k, (value, condition) in enumerate(expr.args):
            for words, wrong in _of_whole(value):
                yield words, _with(expr, k, sp.Tuple(wrong, condition))
    else:
        yield ("sign of", expr), -expr
        yield ("more of", expr), MORE * expr


def _within(expr: sp.Basic, everything: bool) -> Iterator[Slip]:
    if expr.is_Number or expr.is_NumberSymbol:
        if expr not in (0, -1) and expr.is_finite:
            yield ("more of", expr), MORE * expr
            if everything:
                yield ("less of", expr), LESS * expr
    elif isinstance(expr, sp.MatrixSymbol):  # its size is no number of the equation
        return
    elif expr.is_Symbol or isinstance(expr, AppliedUndef | sp.Derivative):
        if everything and str(expr) != r"\pm":
            yield ("more of", expr), MORE * expr
    else:
        yield from _signs(expr)
        for k, child in _parts(expr):
            for words, wrong in _within(child, everything):
                yield (*words, "in", expr), _with(expr, k, wrong)


def _signs(expr: sp.Basic) -> Iterator[Slip]:
    if isinstance(expr, sp.Add):
        for k, term in enumerate(expr.args):
            yield ("sign of", term, "in", expr), _with(expr, k, -term)
    elif isinstance(expr, sp.Function) and not isinstance(expr, (sp.Piecewise, *EVEN)):
        for k, argument in enumerate(expr.args):
            yield ("sign of", argument, "in", expr), _with(expr, k, -argument)


def _parts(expr: sp.Basic) -> list[tuple[int, sp.Basic]]:
    """Those of which a number or a symbol may be wrong, with their places."""
    if isinstance(expr, sp.MatrixBase):
        return [(2, expr.args[2])]
    if isinstance(expr, sp.Pow) and expr.exp.is_Number:
        return [(0, expr.base)]
    if isinstance(expr, sp.Tuple) and len(expr) == 3:  # symbol and limits of an integral
        return [(1, expr[1]), (2, expr[2])]
    return list(enumerate(expr.args))


def _with(expr: sp.Basic, place: int, part: sp.Basic) -> sp.Basic:
    """An expression with one of its arguments replaced."""
    if isinstance(expr, sp.MatrixBase):
        return sp.ImmutableMatrix(*expr.shape, list(part))
    return expr.func(*expr.args[:place], part, *expr.args[place + 1 :])
