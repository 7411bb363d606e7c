"""Dimensions of an equation, by the units of its symbols: mass, length and time.

A number has none unless `Equation.units` states one, an angle has none, and millimetres are metres.
"""

from collections.abc import Iterable, Iterator

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from rockeom.thesis.equation import Equation, Relations, fractions
from rockeom.thesis.notation import entry

KG, M, S = sp.symbols("kg m s", positive=True)
NEWTON = KG * M / S**2
UNITS = {"1": sp.S.One, "rad": sp.S.One, "0": sp.S.Zero, "kg": KG, "m": M, "mm": M, "s": S}
UNITS |= {"N": NEWTON, "kN": NEWTON, "J": NEWTON * M, "W": NEWTON * M / S}
"""Dimension of each unit; that of zero, which is any, is zero."""

FUNCTIONS = {
    "x": "1", "f(x)": "1", r"g(\dot{x})": "1", "U": "J", "U_E": "J", r"\dot{\Delta}": "m/s",
    r"\mathcal{L}": "J", "F_{nc}": "W", "q_i": "rad",
}  # fmt: skip
"""Unit of each function that the thesis leaves open, q_i taken as an angle."""


class DimensionError(ValueError):
    """Terms of different dimensions."""


def check_dimensions(one: Equation, relations: Relations) -> None:
    """Compare both sides of relations of an equation, row by row, and all terms within.

    Raises
    ------
    DimensionError
        Where two terms differ.
    """
    units = _Units(one)
    for relation in relations:
        left, right = map(units.rows, relation.args)
        for pair in zip(left * (len(right) // len(left)), right, strict=True):
            _same(pair)


def unit(text: str) -> sp.Expr:
    """Dimension of a unit such as "kg m2/s"; of alternatives, "N or N m", the last."""
    above, _, below = text.rpartition(" or ")[2].partition("/")
    return sp.Mul(*_factors(above)) / sp.Mul(*_factors(below))


def _factors(text: str) -> Iterator[sp.Expr]:
    for factor in text.split():
        name = factor.rstrip("23456789")
        yield UNITS[name] ** int(factor.removeprefix(name) or 1)


def _same(dimensions: Iterable[sp.Expr]) -> sp.Expr:
    """Dimension that all terms have."""
    first, *others = [d for d in dimensions if d != 0] or [sp.S.Zero]
    for other in others:
        if other != first:
            words = (str(d).replace("**", "").replace("*", " ") for d in (first, other))
            raise DimensionError(" and ".join(words))
    return first


class _Units:
    """Dimensions of the expressions of an equation."""

    def __init__(self, one: Equation) -> None:
        self.chapter = one.chapter
        stated = (part.split(" ", 1) for part in one.units.split(", ") if part)
        self.stated = {
            sp.Rational(name) if name[0].isdigit() else name: unit(text) for name, text in stated
        }

    def rows(self, expr: sp.Basic) -> list[sp.Expr]:
        """Dimensions of the rows of a column, or the one of a number."""
        if isinstance(expr, sp.MatrixBase):
            return [self.of(row) for row in expr]
        if isinstance(expr, sp.MatMul):
            matrix, column = map(self._of_matrix, expr.args)
            return [row.as_coeff_Mul()[1] for row in matrix * column]
        return list(self._of_matrix(expr)) if expr.is_Matrix else [self.of(expr)]

    def _of_matrix(self, symbol: sp.MatrixSymbol) -> sp.Matrix:
        rows = entry(symbol, self.chapter).unit.split("; ")
        return sp.Matrix([[unit(x) for x in row.split(", ")] for row in rows])

    def of(self, expr: sp.Basic) -> sp.Expr:
        """Dimension of an expression; zero has any."""
        if expr.is_Number:
            any_unit = expr == 0 or expr.is_infinite
            return sp.S.Zero if any_unit else self.stated.get(abs(fractions(expr)), sp.S.One)
        if expr.is_Symbol:
            return self.stated.get(expr.name) or unit(entry(expr, self.chapter).unit)
        if isinstance(expr, AppliedUndef):
            return unit(FUNCTIONS[expr.func.__name__])
        if isinstance(expr, sp.Derivative):
            by = (self.of(variable) ** count for variable, count in expr.variable_count)
            return self.of(expr.expr) / sp.Mul(*by)
        if isinstance(expr, sp.Integral):
            (limits,) = expr.limits
            return self.of(expr.function) * _same(map(self.of, limits))
        if isinstance(expr, sp.Piecewise):
            for _, condition in expr.args:
                self._compare(condition)
            return _same([self.of(value) for value, _ in expr.args])
        return self._of_operation(expr, [self.of(argument) for argument in expr.args])

    def _of_operation(self, expr: sp.Basic, arguments: list[sp.Expr]) -> sp.Expr:
        if isinstance(expr, sp.Add | sp.Min | sp.Max | sp.Abs):
            return _same(arguments)
        if isinstance(expr, sp.Mul):
            return sp.Mul(*arguments)
        if isinstance(expr, sp.Pow) and (expr.exp.is_Number or arguments[0] == 1):
            _same([arguments[1], sp.S.One])
            return arguments[0] ** expr.exp
        if isinstance(expr, sp.DiracDelta):
            return 1 / arguments[0]
        if not isinstance(expr, sp.sign):
            _same([*arguments, sp.S.One])
        return sp.S.One

    def _compare(self, condition: sp.Basic) -> None:
        """Compare the two sides of each inequality in a condition."""
        for inequality in condition.atoms(Relational):
            _same(map(self.of, inequality.args))
