"""Checks of the numeric arguments of ground motions; a wrong one raises MotionError."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.errors import MotionError
from rockeom.numbers.checks import number, numbers, whole_number
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import isfinite

COMPONENTS = ("horizontal", "vertical", "all")
"""Components of records that a set may hold."""


def finite(name: str, value: Any) -> float:
    """The value of an argument as a finite number, or as a batch of them."""
    try:
        result = number(name, value)
    except TypeError as error:
        raise MotionError(str(error)) from None
    if not isfinite(result):
        raise MotionError(f"{name} is {result}: give a finite number")
    return result


def positive(name: str, value: Any) -> float:
    """As `finite`, for an argument that must be positive."""
    number = finite(name, value)
    if number <= 0.0:
        raise MotionError(f"{name} is {number:g}: give a positive number")
    return number


def whole(name: str, value: Any, least: int) -> int:
    """The value of an argument as a whole number of at least `least`; it may be a whole float."""
    try:
        return whole_number(name, value, least)
    except (TypeError, ValueError) as error:
        raise MotionError(str(error)) from None


def array(name: str, value: ArrayLike) -> np.ndarray:
    """The numbers of an argument as an array; raises MotionError for others."""
    try:
        return numbers(name, value, "give numbers; GroundMotion.read reads a file")
    except TypeError as error:
        raise MotionError(str(error)) from None


def accelerations(acceleration: ArrayLike) -> np.ndarray:
    """Accelerations of a record as finite numbers (n,).

    Raises MotionError for other than one dimension, and for NaN or infinity, with the index.
    """
    values = array("acceleration", acceleration)
    if values.ndim != 1:
        raise MotionError(f"acceleration has shape {values.shape}: give one dimension, (n,)")
    for index in np.flatnonzero(~np.isfinite(value_of(values)))[:1]:
        raise MotionError(
            f"acceleration[{index}] is {values[index]}: give finite numbers only, or cut the "
            "record where it ends"
        )
    return values
