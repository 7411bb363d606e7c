"""Numbers with their first two rates: a text for places gives velocities, too.

A `Jet` is a quantity of n states with its first and second derivative with respect to time, and
calculates as a number does, by the rules of Leibniz and of the chain. A function of a generated
module that is called with jets of the coordinates gives those of places, without a derivative
being written anywhere.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from rockeom.numbers.batch import Many
from rockeom.numbers.functions import FUNCTIONS, Compound, mathematics


class Jet(Compound):
    """value, first and second derivative, (n,) each."""

    __slots__ = ("first", "second", "value")
    __array_ufunc__ = None  # NumPy's numbers leave it to what stands here

    def __init__(self, value: Any, first: Any, second: Any) -> None:
        self.value, self.first, self.second = value, first, second

    @classmethod
    def of_function(cls, name: str, arguments: tuple[Any, ...]) -> Any:
        of, (jet,) = FUNCTIONS[name], arguments
        return jet.through(*(derivative(jet.value) for derivative in of))

    def __add__(self, other: Any) -> Jet:
        v, d, dd = _parts(other)
        return Jet(self.value + v, self.first + d, self.second + dd)

    def __sub__(self, other: Any) -> Jet:
        v, d, dd = _parts(other)
        return Jet(self.value - v, self.first - d, self.second - dd)

    def __rsub__(self, other: Any) -> Jet:
        return -self + other

    def __mul__(self, other: Any) -> Jet:
        v, d, dd = _parts(other)
        return Jet(
            self.value * v,
            self.first * v + self.value * d,
            self.second * v + 2.0 * self.first * d + self.value * dd,
        )

    def __truediv__(self, other: Any) -> Jet:
        return self * (other**-1.0 if isinstance(other, Jet) else 1.0 / other)

    def __rtruediv__(self, other: Any) -> Jet:
        return self**-1.0 * other

    def __pow__(self, n: Any) -> Jet:
        if isinstance(n, Jet):
            return mathematics.exp(n * mathematics.log(self))
        x = self.value
        return self.through(
            x**n,
            n * x ** (n - 1) if n != 0 else 0.0 * x,
            n * (n - 1) * x ** (n - 2) if n not in (0, 1) else 0.0 * x,
        )

    def __rpow__(self, base: float) -> Jet:
        return mathematics.exp(self * math.log(base))

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.first, -self.second)

    def __pos__(self) -> Jet:
        return self

    def __abs__(self) -> Jet:
        return self * np.where(self.value < 0.0, -1.0, 1.0)

    def through(self, f: Any, slope: Any, curvature: Any) -> Jet:
        """A function of it, by its value and its derivatives there."""
        first = slope * self.first
        return Jet(f, first, curvature * self.first**2 + slope * self.second)

    # a comparison is one of values; where states differ in it, each way is gone by itself

    def __lt__(self, other: Any) -> Any:
        return _compared(operator.lt, self, other)

    def __le__(self, other: Any) -> Any:
        return _compared(operator.le, self, other)

    def __gt__(self, other: Any) -> Any:
        return _compared(operator.gt, self, other)

    def __ge__(self, other: Any) -> Any:
        return _compared(operator.ge, self, other)

    def __eq__(self, other: object) -> Any:
        return _compared(operator.eq, self, other)

    def __ne__(self, other: object) -> Any:
        return _compared(operator.ne, self, other)

    __hash__ = None  # type: ignore[assignment]


def _parts(x: Any) -> tuple[Any, Any, Any]:
    return (x.value, x.first, x.second) if isinstance(x, Jet) else (x, 0.0, 0.0)


def _compared(how: Callable[[Any, Any], Any], one: Any, other: Any) -> Many:
    return Many(np.atleast_1d(how(_parts(one)[0], _parts(other)[0])))
