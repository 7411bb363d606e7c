"""Numbers with their first two rates: what is written for places tells velocities, too.

A `Jet` is a quantity of n states with its first and second derivative with respect to time, and
calculates as a number does, by the rules of Leibniz and of the chain. A function of a generated
module that is called with jets of the coordinates gives those of places, without a derivative
being written anywhere.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from functools import cache
from types import FunctionType, ModuleType, SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from rockeom.many import Many


class Jet:
    """value, first and second derivative, (n,) each."""

    __slots__ = ("first", "second", "value")
    __array_ufunc__ = None  # NumPy's numbers leave it to what stands here

    def __init__(self, value: Any, first: Any, second: Any) -> None:
        self.value, self.first, self.second = value, first, second

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
            return _FUNCTIONS["exp"](n * _FUNCTIONS["log"](self))
        x = self.value
        return self.through(
            x**n,
            n * x ** (n - 1) if n != 0 else 0.0 * x,
            n * (n - 1) * x ** (n - 2) if n not in (0, 1) else 0.0 * x,
        )

    def __rpow__(self, base: float) -> Jet:
        return _FUNCTIONS["exp"](self * math.log(base))

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


class _Derivatives(NamedTuple):
    """A function of one number with its first two derivatives, of arrays."""

    f: Callable[[Any], Any]
    slope: Callable[[Any], Any]
    curvature: Callable[[Any], Any]

    def __call__(self, x: Any) -> Any:
        if not isinstance(x, Jet):
            return self.f(x)
        return x.through(self.f(x.value), self.slope(x.value), self.curvature(x.value))


def _none(x: Any) -> Any:
    return 0.0 * x


_FUNCTIONS: dict[str, _Derivatives] = {
    "sin": _Derivatives(np.sin, np.cos, lambda x: -np.sin(x)),
    "cos": _Derivatives(np.cos, lambda x: -np.sin(x), lambda x: -np.cos(x)),
    "tan": _Derivatives(
        np.tan, lambda x: np.cos(x) ** -2.0, lambda x: 2.0 * np.tan(x) * np.cos(x) ** -2.0
    ),
    "asin": _Derivatives(
        np.arcsin, lambda x: (1.0 - x**2) ** -0.5, lambda x: x * (1.0 - x**2) ** -1.5
    ),
    "acos": _Derivatives(
        np.arccos, lambda x: -((1.0 - x**2) ** -0.5), lambda x: -x * (1.0 - x**2) ** -1.5
    ),
    "atan": _Derivatives(
        np.arctan, lambda x: 1.0 / (1.0 + x**2), lambda x: -2.0 * x / (1.0 + x**2) ** 2
    ),
    "sinh": _Derivatives(np.sinh, np.cosh, np.sinh),
    "cosh": _Derivatives(np.cosh, np.sinh, np.cosh),
    "tanh": _Derivatives(
        np.tanh,
        lambda x: 1.0 - np.tanh(x) ** 2,
        lambda x: -2.0 * np.tanh(x) * (1.0 - np.tanh(x) ** 2),
    ),
    "exp": _Derivatives(np.exp, np.exp, np.exp),
    "log": _Derivatives(np.log, lambda x: 1.0 / x, lambda x: -1.0 / x**2),
    "sqrt": _Derivatives(np.sqrt, lambda x: 0.5 * x**-0.5, lambda x: -0.25 * x**-1.5),
    "fabs": _Derivatives(np.abs, np.sign, _none),
}


class _Mathematics:
    """The functions of `math`, of jets as well; another one is that of numbers alone."""

    def __getattr__(self, name: str) -> Any:
        return _FUNCTIONS.get(name) or getattr(math, name)


@cache
def of_jets(module: ModuleType) -> Any:
    """The functions of a generated module, which take jets for numbers; arrays hold objects."""
    names = vars(module) | {
        "math": _Mathematics(),
        "np": SimpleNamespace(empty=lambda n: np.empty(n, dtype=object)),
    }
    for name, function in vars(module).items():
        if isinstance(function, FunctionType):
            names[name] = FunctionType(function.__code__, names)
    return SimpleNamespace(**names)
