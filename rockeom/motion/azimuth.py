"""A structure in space that is turned under two horizontal ground motions: those along its axes.

Azimuths here are counter-clockwise seen from above, from the first of both motions.
"""

import math
import re
from typing import Any

import numpy as np

from rockeom.motion.segments import C0, C1, KIND, LINEAR
from rockeom.motion.slope import summed, without_end
from rockeom.numbers.checks import InputError, number
from rockeom.numbers.degrees import RADIANS
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import mathematics

_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+))\s*(deg|degrees?|rad)\s*")


def azimuth_angle(azimuth: Any) -> Any:
    """An azimuth [rad]: a number, or a text such as "30 deg"; raises InputError for another."""
    angle = azimuth
    if isinstance(azimuth, str):
        match = _TEXT.fullmatch(azimuth)
        size, unit = match.groups() if match else ("nan", "rad")
        angle = float(size) * (1.0 if unit == "rad" else RADIANS)
    angle = number("azimuth", angle)
    if not math.isfinite(value_of(angle)):
        raise InputError("azimuth", azimuth).give(
            'radians, or a text such as "30 deg", counter-clockwise seen from above'
        )
    return angle


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
    cos, sin = mathematics.cos(azimuth), mathematics.sin(azimuth)
    x, y = without_end(first), without_end(second)
    return summed(x, cos, y, sin), summed(y, cos, x, -sin)
