"""Numbers that make or change a ground motion: as floats, or refused with a MotionError."""

from __future__ import annotations

from typing import Any

from rockeom.motion.errors import MotionError
from rockeom.numbers.checks import number, whole_number
from rockeom.numbers.functions import isfinite

COMPONENTS = ("horizontal", "vertical", "all")
"""Components of records that a set may hold."""


def finite(name: str, value: Any) -> float:
    """The number given for what is named; many at once stay so."""
    try:
        given = number(name, value)
    except TypeError as error:
        raise MotionError(str(error)) from None
    if not isfinite(given):
        raise MotionError(f"{name} is {given}: give a finite number")
    return given


def positive(name: str, value: Any) -> float:
    """As `finite`; refuses what is not positive, too."""
    number = finite(name, value)
    if number <= 0.0:
        raise MotionError(f"{name} is {number:g}: give a positive number")
    return number


def whole(name: str, value: Any, least: int) -> int:
    """The whole number given for what is named, which may be written as a float."""
    try:
        return whole_number(name, value, least)
    except (TypeError, ValueError) as error:
        raise MotionError(str(error)) from None
