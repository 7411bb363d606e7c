"""Ground in the axes of a structure that is turned against it: by a slope, or in space an azimuth.

Ground that slopes: accelerations along and normal to it, with the part that weight has in them.

In axes along a slope phi and normal to it weight acts as g sin(phi) downhill and g cos(phi) into
the ground. For a structure, whose equations have the weight g along the normal, that is ground with
the further accelerations -g sin(phi) along the slope and g (cos(phi) - 1) along the normal, for all
times: before, during and after the shaking.

Azimuths are counter-clockwise seen from above, from the first of two horizontal motions.
"""

import math
import re
from typing import Any

import numpy as np

from rockeom.codes import WITH_CONSTANT
from rockeom.motion import segments as pieces
from rockeom.motion.segments import C0, C1, C3, END, KIND, LINEAR, START
from rockeom.numbers.batch import one_of
from rockeom.numbers.checks import InputError, number
from rockeom.numbers.degrees import RADIANS
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import mathematics

AXES = SLOPE, WORLD = "slope", "world"
"""Axes of the ground motions: along and normal to the slope, or level and upright."""

_LARGEST = 1e6
"""Azimuth of which rounding leaves a billionth of a radian [rad]."""
_NUMBER = r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*"
_TEXT = re.compile(rf"{_NUMBER}(?:(deg|degrees?|rad)\s*|in{_NUMBER})")


def slope_angle(slope: Any) -> Any:
    """A slope [rad]: a number, or a text such as "5 deg" or "1 in 20", the rise in a run.

    Raises InputError for another text, and for an angle that is not between -90 and 90 degrees.
    """
    remedy = (
        'radians between -1.57 and 1.57, "5 deg" or "1 in 20", positive where it falls to the right'
    )
    angle = _angle("slope", slope)
    if not abs(value_of(angle)) < 0.5 * math.pi:
        raise InputError("slope", slope).give(remedy)
    return angle


def azimuth_angle(azimuth: Any, argument: str = "azimuth", of: str = "") -> Any:
    """An azimuth [rad]: a number, or a text such as "30 deg"; raises InputError for another.

    argument, of : what an error names.
    """
    angle = _angle(argument, azimuth, of)
    if not abs(value_of(angle)) <= _LARGEST:
        raise InputError(argument, azimuth, of).give(
            'radians, or a text such as "30 deg" or "0.5 rad", counter-clockwise seen from above, '
            "a million radians at most"
        )
    return angle


def _angle(name: str, given: Any, of: str = "") -> Any:
    """A number, or an angle out of a text [rad]; NaN for another text."""
    if not isinstance(given, str):
        return number(name, given, of)
    match = _TEXT.fullmatch(given)
    size, unit, run = match.groups() if match else ("nan", "rad", None)
    if run:
        return math.atan2(float(size), float(run))
    return float(size) * (1.0 if unit == "rad" else RADIANS)


def weight_on(slope: Any, gravity: Any) -> tuple[Any, Any]:
    """(along, normal) accelerations of the ground that do to a structure what the slope does."""
    half = mathematics.sin(0.5 * slope)
    return -gravity * mathematics.sin(slope), -2.0 * gravity * half * half


def turned(slope: Any, across: Any, up: Any) -> tuple[Any, Any]:
    """(along, normal) of a level and an upright acceleration."""
    cos, sin = mathematics.cos(slope), mathematics.sin(slope)
    return across * cos - up * sin, across * sin + up * cos


def tables_on(
    slope: Any, axes: str, gravity: Any, horizontal: np.ndarray, vertical: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Tables (m, 7) along the slope and normal to it, the part of weight included, without end.

    Raises InputError for motions whose sum no row can hold.
    """
    if (np.append(horizontal[:, KIND], vertical[:, KIND]) == pieces.MAVROEIDIS_PAPAGEORGIOU).any():
        raise InputError("slope").says(
            "a Mavroeidis-Papageorgiou pulse is not known on a slope: give its samples, "
            "motion.resampled(dt), with a time step of a hundredth of its period"
        )
    along, normal = weight_on(slope, gravity)
    across, up = _endless(horizontal), _endless(vertical)
    if axes == SLOPE:
        parts = (across, along), (up, normal)
        first, second = (
            _plus(table, np.full(len(table), x, np.result_type(float, type(x))))
            for table, x in parts
        )
        return first, second
    cos, sin = mathematics.cos(slope), mathematics.sin(slope)
    return _sum(across, cos, up, -sin, along), _sum(up, cos, across, sin, normal)


def seen_from(azimuth: Any, first: Any, second: Any) -> tuple[Any, Any]:
    """(along, across) axes at an azimuth, of two horizontal accelerations at right angles."""
    cos, sin = mathematics.cos(azimuth), mathematics.sin(azimuth)
    return cos * first + sin * second, cos * second - sin * first


def tables_at(azimuth: Any, first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tables (m, 7) along axes at an azimuth, of two motions at right angles, without end.

    Raises InputError for motions whose sum no row can hold.
    """
    curved = any((table[:, KIND] != LINEAR).any() for table in (first, second))
    if curved and all(table[:, C0 : C1 + 1].any() for table in (first, second)):
        raise InputError("azimuth").says(
            "two motions act along each axis of a structure that is turned, and one of them is a "
            "formula: give its samples, motion.resampled(dt)"
        )
    azimuth = one_of(azimuth)  # of many cases, the rows of each would be numbers one by one
    cos, sin = mathematics.cos(azimuth), mathematics.sin(azimuth)
    x, y = _endless(first), _endless(second)
    return _sum(x, cos, y, sin), _sum(y, cos, x, -sin)


def _endless(table: np.ndarray) -> np.ndarray:
    """The table with quiet ground behind it."""
    quiet = np.zeros((1, pieces.COLUMNS), table.dtype)
    quiet[0, START], quiet[0, END] = table[-1, END] if len(table) else 0.0, np.inf
    return np.concatenate([table, quiet])


def _plus(table: np.ndarray, constants: np.ndarray) -> np.ndarray:
    """The table with constants (m,) added to its accelerations."""
    rows = table.astype(np.result_type(table, constants))
    curved = table[:, KIND] != LINEAR
    rows[~curved, C0] += constants[~curved]
    rows[curved, C3] = constants[curved]
    rows[curved, KIND] += WITH_CONSTANT
    return rows


def _sum(
    first: np.ndarray, by_first: Any, second: np.ndarray, by_second: Any, constant: Any = None
) -> np.ndarray:
    """The table of by_first times the first, by_second times the second, and a constant, if any.

    Both are without end.
    """
    ends = np.concatenate([first[:, END], second[:, END]])
    ends = ends[np.unique(value_of(ends).real, return_index=True)[1]]
    a, b = (_parted(table, ends) for table in (first, second))
    curved_a, curved_b = (rows[:, KIND] != LINEAR for rows in (a, b))
    if ((curved_a & (b[:, C1] != 0.0)) | (curved_b & (a[:, C1] != 0.0))).any():
        raise InputError("ground_axes", WORLD).says(
            "the horizontal and the vertical motion act along the slope together, and one of them "
            "is a formula: give its samples, motion.resampled(dt), or ground_axes='slope'"
        )
    shape, other = np.where(curved_b[:, None], (b, a), (a, b))
    by_shape = np.where(curved_b, by_second, by_first)
    by_other = np.where(curved_b, by_first, by_second)
    rows = shape.astype(np.result_type(shape, by_shape))
    linear = ~(curved_a | curved_b)
    rows[:, C0] = shape[:, C0] * by_shape
    rows[linear, C1] = (shape[:, C1] * by_shape + other[:, C1] * by_other)[linear]
    if constant is None and not other[:, C0].any():
        return rows
    return _plus(rows, other[:, C0] * by_other + (0.0 if constant is None else constant))


def _parted(table: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """The table with a row for each of the parts that have these ends (k,)."""
    starts = np.append(0.0, ends[:-1])
    index = np.searchsorted(value_of(table[:, END]).real, value_of(starts).real, side="right")
    rows = pieces.begun_later(table[index], starts - table[index, START])
    rows[:, START], rows[:, END] = starts, ends
    return rows
