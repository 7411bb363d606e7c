"""Numbers with their derivatives: a text for numbers gives derivatives, too.

A `Dual` calculates as a number does, to the same bits, and its derivatives along any directions by
the rules of products and of the chain. A structure, an impact law, a ground motion and an initial
state take duals for numbers.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from functools import cache
from numbers import Real
from types import ModuleType
from typing import Any, NoReturn

import numpy as np

from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, array_of, number
from rockeom.numbers.functions import COMPARISONS, FUNCTIONS, IN_MATH, OPERATORS, Compound

Slope = Callable[..., Any]
"""The derivative of a function f of numbers by one of them, from all of them and f itself."""


def _through(
    function: Callable[..., Any], slopes: tuple[Slope, ...], arguments: tuple[Any, ...]
) -> Dual:
    """A function of numbers and duals, by its derivatives with respect to each."""
    plain = [x.value if type(x) is Dual else x for x in arguments]
    value = function(*plain)
    parts = [
        _moved(slope(*plain, value), x.tangent)
        for x, slope in zip(arguments, slopes, strict=True)
        if type(x) is Dual
    ]
    if len(parts) == 1:
        return _dual(np.float64(value), parts[0])
    if len(parts[0]) != len(parts[1]):
        raise InputError("duals").says(
            f"duals of {len(parts[0])} and of {len(parts[1])} directions meet in one calculation: "
            "make all of them by one call of `rk.duals`"
        )
    return _dual(np.float64(value), parts[0] + parts[1])


def _through_array(ufunc: np.ufunc, terms: tuple[Any, ...]) -> np.ndarray:
    """The same of a dual and an array (n,) of floats, as of one after the other."""
    plain = [x.value if type(x) is Dual else x for x in terms]
    values = ufunc(*plain)
    ((x, slope),) = (
        of for of in zip(terms, _slopes(OPERATORS[ufunc]), strict=True) if type(of[0]) is Dual
    )
    slopes = np.broadcast_to(slope(*plain, values), values.shape)
    return with_tangent(values, np.multiply.outer(slopes, x.tangent))


def _moved(slope: Any, tangent: np.ndarray) -> np.ndarray:
    """A zero tangent stays zero, however steep the function is there."""
    if math.isfinite(slope):
        return slope * tangent
    return np.multiply(slope, tangent, where=tangent != 0.0, out=np.zeros(len(tangent)))


def _power_of_base(x: Any, n: Any, _: Any) -> Any:
    return n * x ** (n - 1) if n else 0.0


def _quotient(x: Any, y: Any) -> Any:
    with np.errstate(all="ignore"):  # the number itself has warned
        return np.divide(x, y)


_OF_TWO: dict[str, tuple[Slope, ...]] = {
    "add": (lambda x, y, f: 1.0, lambda x, y, f: 1.0),
    "sub": (lambda x, y, f: 1.0, lambda x, y, f: -1.0),
    "mul": (lambda x, y, f: y, lambda x, y, f: x),
    "truediv": (lambda x, y, f: _quotient(1.0, y), lambda x, y, f: _quotient(-f, y)),
    "pow": (_power_of_base, lambda x, n, f: f * math.log(x)),
    "neg": (lambda x, f: -1.0,),
    "hypot": (lambda x, y, f: x / f, lambda x, y, f: y / f),
    "atan2": (lambda y, x, f: x / (x * x + y * y), lambda y, x, f: -y / (x * x + y * y)),
    "copysign": (lambda x, y, f: math.copysign(1.0, x) * math.copysign(1.0, y), lambda *_: 0.0),
}
"""Derivatives of operators and of functions of two numbers, by their names."""

_OF_VALUES = {*COMPARISONS, "sign", "isfinite"}
"""Functions without derivatives."""

_OF_ARRAYS = {np.add, np.subtract, np.multiply, np.true_divide}
"""Operations on a whole array of floats: thousands of samples of a record."""


def _are_floats(arguments: tuple[Any, ...]) -> bool:
    """Whether an array (n,) of floats meets one dual."""
    return any(isinstance(x, np.ndarray) and x.dtype == float and x.ndim == 1 for x in arguments)


@cache
def _slopes(function: Callable[..., Any]) -> tuple[Slope, ...]:
    name = IN_MATH.get(function.__name__, function.__name__)
    if name in _OF_TWO:
        return _OF_TWO[name]
    if name not in FUNCTIONS:
        raise TypeError(f"the derivative of {name} is not known: take the `.value` of its argument")
    of = FUNCTIONS[name].slope

    def slope(x: Any, _: Any) -> Any:
        with np.errstate(all="ignore"):  # it may be infinite where the function is not
            return of(x)

    return (slope,)


def _is_number(kind: type) -> bool:
    return issubclass(kind, int | float | np.number | Dual)


class Dual(Compound):
    """Number with its derivatives along m directions.

    It is compared by its value. Where a float is needed it raises TypeError, so that no derivative
    is lost in silence: take ``.value``. It is no key of a dict: two that are equal may have other
    derivatives.

    Parameters
    ----------
    value : float
        Number.
    tangent : array_like
        Derivatives (m,). All duals of a calculation have the same directions: those of `duals`, for
        instance, are its arguments.

    Raises
    ------
    TypeError
        For anything but a number.
    ValueError
        For a tangent that is not (m,).

    Examples
    --------
    >>> import rockeom as rk
    >>> x = rk.Dual(3.0, [1.0, 0.0])
    >>> x * x + 1.0
    Dual(10.0, [6.0, 0.0])
    """

    __slots__ = ("tangent", "value")

    def __init__(self, value: float, tangent: Any) -> None:
        if issubclass(type(value), Compound):
            raise InputTypeError("value", value).give("a plain number")
        along = array_of("tangent", tangent)
        if along.ndim != 1:
            raise InputError("tangent").wrong(
                f"has the shape {along.shape}: give a derivative for each direction, (m,)"
            )
        self.value, self.tangent = np.float64(number("value", value)), along

    def __repr__(self) -> str:
        return f"Dual({self.value!s}, {self.tangent.tolist()})"

    def __format__(self, how: str) -> str:
        return format(self.value, how)

    def checked(self) -> float:
        return float(self.value)

    def __bool__(self) -> bool:
        return bool(self.value != 0.0)

    def __float__(self) -> NoReturn:
        raise TypeError(
            f"{self!r} is needed as a float, which has no derivatives: take its `.value` where "
            "none are wanted; `rk.tangents` carries them through a motion"
        )

    @classmethod
    def of_function(cls, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        if function.__name__ in _OF_VALUES:
            of_values = function(*(x.value if isinstance(x, Dual) else x for x in arguments))
            return of_values if function is np.sign else bool(of_values)
        return _through(function, _slopes(function), arguments)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *arguments: Any, **how: Any) -> Any:
        if ufunc in _OF_ARRAYS and method == "__call__" and not how and _are_floats(arguments):
            return _through_array(ufunc, arguments)
        return super().__array_ufunc__(ufunc, method, *arguments, **how)

    def __abs__(self) -> Dual:
        return -self if self.value < 0.0 else self


def _dual(value: np.float64, tangent: np.ndarray) -> Dual:
    """A dual of values that need no check."""
    dual = object.__new__(Dual)
    dual.value, dual.tangent = value, tangent
    return dual


Real.register(Dual)


@explained.calls()
def duals(**values: float) -> dict[str, Any]:
    """Duals by name, each a direction of its own, in which it has the derivative 1.

    Parameters
    ----------
    **values : float
        Numbers by name.

    Returns
    -------
    dict of str to Dual
        Duals by name.

    Raises
    ------
    TypeError
        For anything but numbers.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(**rk.duals(half_width=0.1, half_height=0.4))  # m
    >>> block.half_width
    Dual(0.1, [1.0, 0.0])
    """
    return {
        name: Dual(value, along)
        for (name, value), along in zip(values.items(), np.eye(len(values)), strict=True)
    }


def value_of(x: Any) -> Any:
    """A number without its derivatives; of an array of numbers an array of float."""
    if isinstance(x, np.ndarray):
        if x.dtype != object or not all(map(_is_number, {*map(type, x.flat)})):
            return x  # of many cases
        plain = [element.value if type(element) is Dual else element for element in x.flat]
        plain_array = np.array(plain, dtype=float).reshape(x.shape)
        plain_array.flags.writeable = x.flags.writeable
        return plain_array
    return float(x.value) if isinstance(x, Dual) else x


def nominal(x: Any) -> Any:
    """The same without derivatives: an object with floats wherever it holds duals.

    An object without duals is returned itself. All parts of tuples, lists, dicts and objects are
    looked at; functions, classes and modules are left.
    """
    if isinstance(x, Dual | np.ndarray):
        return value_of(x)
    if isinstance(x, dict):
        return _unless_same(x, dict(zip(x, map(nominal, x.values()), strict=True)))
    if type(x) in (tuple, list):
        return _unless_same(x, type(x)(map(nominal, x)))
    if not hasattr(x, "__dict__") or callable(x) or isinstance(x, ModuleType):
        return x
    changed = {name: new for name, old in vars(x).items() if (new := nominal(old)) is not old}
    if not changed:
        return x
    copy = object.__new__(type(x))  # it was checked when it was made
    vars(copy).update(vars(x) | changed)
    return copy


def _unless_same(old: Any, new: Any) -> Any:
    """The new one, where a part of it is another object than in the old one."""
    parts = [x.values() if isinstance(x, dict) else x for x in (old, new)]
    return old if all(map(operator.is_, *parts)) else new


def with_tangent(values: np.ndarray, tangent: np.ndarray) -> np.ndarray:
    """An array of duals, of values (n,) and their tangents (n, m)."""
    duals = np.empty(len(values), dtype=object)
    duals[:] = list(map(_dual, values, tangent))
    return duals


def tangent_of(x: Any, m: int) -> np.ndarray:
    """(..., m) derivatives of a number or an array (...), zero of those that have none."""
    if isinstance(x, np.ndarray) and x.dtype != object:
        return np.broadcast_to(0.0, (*x.shape, m))  # a single zero: records are long
    tangent = np.zeros((*np.shape(x), m))
    if isinstance(x, Dual):
        tangent[:] = x.tangent
    elif isinstance(x, np.ndarray):
        for row, element in zip(tangent.reshape(-1, m), x.flat, strict=True):
            if type(element) is Dual:
                row[:] = element.tangent
    return tangent


def directions(*values: Any) -> int:
    """Along how many directions numbers, arrays and lists have derivatives; 0 if none has."""
    for x in values:
        if type(x) is float:  # most are
            continue
        if isinstance(x, Dual):
            return len(x.tangent)
        several = isinstance(x, list) or (isinstance(x, np.ndarray) and x.dtype == object)
        if several and (number := directions(*np.ravel(x))):
            return number
    return 0
