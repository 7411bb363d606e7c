"""Values of SymPy expressions by walking through them, each shared part once.

Nothing is rewritten and no text is compiled: for one set of numbers, or one of arrays, that is
many times as fast as `subs` or `lambdify`, and independent of both. Of complex numbers, by which
derivatives are found, signs and the larger of two are those of the real parts.
"""

import math
import operator
from collections.abc import Mapping
from functools import reduce
from typing import Any

import numpy as np
import sympy as sp

Value = float | np.ndarray

FUNCTIONS = {
    sp.sin: np.sin,
    sp.cos: np.cos,
    sp.tan: np.tan,
    sp.atan: np.arctan,
    sp.exp: np.exp,
    sp.log: np.log,
    sp.sinh: np.sinh,
    sp.cosh: np.cosh,
    sp.tanh: np.tanh,
    sp.Abs: lambda x: np.where(np.real(x) < 0, -x, x),
    sp.sign: lambda x: np.sign(np.real(x)),
    sp.Min: lambda *a: reduce(np.minimum, a),
    sp.Max: lambda *a: reduce(np.maximum, a),
    sp.Add: lambda *a: reduce(operator.add, a),
    sp.Mul: lambda *a: reduce(operator.mul, a),
    sp.StrictLessThan: operator.lt,
    sp.LessThan: operator.le,
    sp.StrictGreaterThan: operator.gt,
    sp.GreaterThan: operator.ge,
}


class Values(dict[sp.Basic, Value]):
    """Values of expressions, `self[expr]`, for the given ones of symbols and named functions."""

    def __init__(self, given: Mapping[sp.Basic, Any]) -> None:
        super().__init__(given)

    def __missing__(self, expr: sp.Basic) -> Value:
        self[expr] = value = self._of(expr)
        return value

    def _of(self, expr: sp.Basic) -> Value:
        if not expr.args:
            if expr.is_Symbol:
                raise KeyError(f"no value is given for {expr}")
            return math.inf if expr is sp.oo else float(expr)
        if expr.is_Pow:
            return self._power(expr.base, expr.exp)
        if isinstance(expr, sp.Piecewise):
            found: Value = math.nan
            for value, condition in reversed(expr.args):
                holds = True if condition == True else self[condition]  # noqa: E712
                found = np.where(holds, self[value], found)
            return found
        return FUNCTIONS[expr.func](*(self[a] for a in expr.args))

    def _power(self, base: sp.Expr, exponent: sp.Expr) -> Value:
        if exponent.is_Integer:  # by a float, a negative base gives nothing
            power = self[base] ** abs(int(exponent))
            return 1.0 / power if exponent.is_negative else power
        return np.sqrt(self[base]) if exponent == sp.S.Half else self[base] ** self[exponent]
