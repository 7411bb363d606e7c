"""Numbers with their first two rates: a text for places gives velocities, too.

A `Jet` is a quantity of n states with its first and second derivative with respect to time, and
calculates as a number does, by the rules of Leibniz and of the chain. A function of a generated
module that is called with jets of the coordinates gives those of places, without a derivative
being written anywhere.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from rockeom.numbers.batch import Many
from rockeom.numbers.functions import COMPARISONS, FUNCTIONS, Compound, mathematics


class Jet(Compound):
    """value, first and second derivative, (n,) each."""

    __slots__ = ("first", "second", "value")
    __array_ufunc__ = None  # type: ignore[assignment]  # NumPy's numbers leave it to what is here

    def __init__(self, value: Any, first: Any, second: Any) -> None:
        self.value, self.first, self.second = value, first, second

    @classmethod
    def meets(cls, other: Any) -> bool:
        return True

    @classmethod
    def of_function(cls, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        if (
            function.__name__ in COMPARISONS
        ):  # where states differ in it, each way is gone by itself
            return Many(np.atleast_1d(function(*(_parts(x)[0] for x in arguments))))
        if function in _RULES:
            return _RULES[function](*arguments)
        (jet,) = arguments
        return jet.through(*(derivative(jet.value) for derivative in FUNCTIONS[function.__name__]))

    def through(self, f: Any, slope: Any, curvature: Any) -> Jet:
        """A function of it, by its value and its derivatives there."""
        first = slope * self.first
        return Jet(f, first, curvature * self.first**2 + slope * self.second)


def _parts(x: Any) -> tuple[Any, Any, Any]:
    return (x.value, x.first, x.second) if isinstance(x, Jet) else (x, 0.0, 0.0)


def _sum(left: Any, right: Any) -> Jet:
    return Jet(*(a + b for a, b in zip(_parts(left), _parts(right), strict=True)))


def _product(left: Any, right: Any) -> Jet:
    (a, da, dda), (b, db, ddb) = _parts(left), _parts(right)
    return Jet(a * b, da * b + a * db, dda * b + 2.0 * da * db + a * ddb)


def _quotient(left: Any, right: Any) -> Jet:
    return left * (right**-1.0 if isinstance(right, Jet) else 1.0 / right)


def _power(base: Any, n: Any) -> Jet:
    if isinstance(n, Jet):
        return mathematics.exp(n * mathematics.log(base))
    x = base.value
    return base.through(
        x**n,
        n * x ** (n - 1) if n != 0 else 0.0 * x,
        n * (n - 1) * x ** (n - 2) if n not in (0, 1) else 0.0 * x,
    )


_RULES: dict[Callable[..., Any], Callable[..., Jet]] = {
    operator.add: _sum, operator.sub: lambda a, b: _sum(a, -b), operator.mul: _product,
    operator.truediv: _quotient, operator.pow: _power,
    operator.neg: lambda a: Jet(-a.value, -a.first, -a.second),
    abs: lambda a: a * np.where(a.value < 0.0, -1.0, 1.0),
}  # fmt: skip
"""The rules of Leibniz and of the chain, by the operator."""
