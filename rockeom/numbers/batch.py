"""Many numbers that are handled as one: a text for one case, run for many at once.

A `Many` holds a number of each of n cases and calculates as a number does, for all of them and,
to the last bit, as each would by itself. Where one number is needed (`if x > 0`, `math.sin(x)`,
`round(x)`, a key of a dict) and the cases differ, it raises `Differs`, which tells the cases apart:
whoever began does each part by itself, until all of a part agree.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from itertools import repeat
from numbers import Real
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from rockeom.numbers.functions import OPERATORS, Compound, boxed


class Differs(BaseException):  # nothing is wrong, and `except Exception` must not keep it
    """Cases whose numbers are handled as one do not go the same way from here.

    parts : index arrays, of the cases that do.
    """

    def __init__(self, parts: list[np.ndarray]) -> None:
        super().__init__(f"{len(parts)} ways are gone")
        self.parts = parts


def _of_one(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of the number that all cases have."""
    return lambda many, *more: function(many.one(), *more)


class Many(NDArrayOperatorsMixin, Compound):
    """A number of each case, or a truth.

    values (n,) : of float, of bool, or of objects: whole numbers, which Python makes of any size.
    """

    __slots__ = ("values",)

    def __init__(self, values: np.ndarray) -> None:
        self.values = values

    @classmethod
    def of(cls, numbers: list[Any]) -> Many:
        """The numbers of one case after the other."""
        if {*map(type, numbers)} <= {float, np.float64}:
            return cls(np.array(numbers))
        values = np.empty(len(numbers), dtype=object)
        values[:] = numbers
        return cls(values)

    def floats(self) -> Many:
        """The same in floats; raises OverflowError for a whole number that none can hold."""
        return self if self.values.dtype == float else Many(self.values.astype(float))

    @classmethod
    def of_function(cls, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        return one_by_one(function)(*arguments)

    def one(self) -> Any:
        """The number that all cases have; raises Differs where they have several."""
        numbers = self.values.tolist()
        by_bits = self.values.dtype == float  # which tell -0.0 from 0.0
        keys = self.values.view(np.int64).tolist() if by_bits else numbers
        places = {key: i for i, key in enumerate(dict.fromkeys(keys))}
        if len(places) == 1:
            return numbers[0]
        which = np.array([places[key] for key in keys])
        raise Differs([np.flatnonzero(which == i) for i in places.values()])

    def __bool__(self) -> bool:
        true = self.values.astype(bool)
        if true.all():
            return True
        if not true.any():
            return False
        raise Differs([np.flatnonzero(true), np.flatnonzero(~true)])

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *arguments: Any, **how: Any) -> Any:
        """NumPy's functions of numbers one by one, operators among them."""
        if method != "__call__" or ufunc.signature is not None:
            return NotImplemented
        if any(isinstance(x, np.ndarray) for x in arguments):  # of objects, many among them
            return ufunc(*(boxed(x) if type(x) is Many else x for x in arguments), **how)
        out = how.pop("out", ())  # x += y: a number is not changed in its place, x is another then
        if how or not all(type(x) is Many for x in out):
            return NotImplemented
        numbers = [values(x) for x in arguments]
        kinds = {x.dtype.kind for x in numbers if isinstance(x, np.ndarray)}
        if kinds == {"b"} and ufunc not in _OF_TRUTHS:  # Python's and NumPy's differ
            raise _apart(arguments)
        if "O" in kinds or ufunc in _DIVISIONS:
            return one_by_one(OPERATORS.get(ufunc, ufunc))(*arguments)
        if ufunc is np.power:
            ufunc = np.float_power  # C's, as Python's: NumPy's square of an array is a product
        try:
            result = ufunc(*numbers)
        except FloatingPointError:  # which number by itself may be without
            raise _apart(arguments) from None
        return NotImplemented if isinstance(result, tuple) else Many(result)

    def __repr__(self) -> str:
        return f"<numbers of {len(self.values)} cases>"

    # -- where one number is needed

    __float__, __int__, __index__ = _of_one(float), _of_one(int), _of_one(operator.index)
    __complex__, __hash__ = _of_one(complex), _of_one(hash)
    __str__, __format__, __round__ = _of_one(str), _of_one(format), _of_one(round)
    __floor__, __ceil__, __trunc__ = _of_one(math.floor), _of_one(math.ceil), _of_one(math.trunc)


Real.register(Many)


def one_by_one(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of numbers, of many as well: the bits are those of each number by itself."""

    def of_each(*arguments: Any) -> Any:
        if Many in map(type, arguments):
            numbers = (x.values.tolist() if type(x) is Many else repeat(x) for x in arguments)
            try:
                return Many.of(list(map(function, *numbers)))
            except Exception:  # of one of them
                raise _apart(arguments) from None
        return function(*arguments)

    return of_each


def _apart(arguments: tuple[Any, ...]) -> Differs:
    """Each case by itself."""
    n = next(len(x.values) for x in arguments if type(x) is Many)
    return Differs([np.array([i]) for i in range(n)])


_DIVISIONS = {np.floor_divide, np.remainder}
"""Operators that NumPy may round otherwise than Python."""

_OF_TRUTHS = {
    np.bitwise_and, np.bitwise_or, np.bitwise_xor, np.invert, np.equal, np.not_equal,
    np.logical_and, np.logical_or, np.logical_not,
}  # fmt: skip


def one_of(x: Any) -> Any:
    """A number that is one for all cases; raises Differs where they have several."""
    return x.one() if type(x) is Many else x


def values(x: Any) -> Any:
    """(n,) numbers of n cases, or the one that all of them have."""
    return x.values if type(x) is Many else x
