"""Units of what records hold, converted once, where a record enters."""

import math
import re
from typing import Any

from rockeom.numbers.checks import InputError, described, is_number
from rockeom.numbers.constants import STANDARD_GRAVITY as STANDARD_GRAVITY

# In the spelling that `_plain` leaves; "g" is not here because its value is the user's.
_FACTORS = {
    "m/s2": 1.0,
    "cm/s2": 0.01,
    "gal": 0.01,
    "mm/s2": 0.001,
    "in/s2": 0.0254,
    "ft/s2": 0.3048,
}
NAMES = ("m/s2", "g", "cm/s2", "gal", "mm/s2", "in/s2", "ft/s2")


def _plain(units: str) -> str:
    """One spelling for CM/SEC/SEC, cm/sec**2, cm/s^2 and cm/s²."""
    text = "".join(units.lower().split()).replace("sec", "s").replace("²", "2")
    return text.replace("^", "").replace("**", "").replace("/s/s", "/s2")


def is_known(units: str) -> bool:
    """Whether `factor` knows these units."""
    return _plain(units) in ("g", "g/10", *_FACTORS)


def factor(units: str, gravity: float = STANDARD_GRAVITY) -> float:
    """The factor of a value in these units to m/s2.

    gravity : the value of 1 g [m/s2], used for units="g" only.

    Raises InputError for unknown units and for a gravity that is not finite and positive.
    """
    if not (is_number(gravity) and math.isfinite(gravity) and gravity > 0):
        raise InputError("gravity", gravity).give("a positive number of m/s2, such as 9.81")
    if not isinstance(units, str) or not is_known(units):
        raise InputError("units", units).says(
            f"units {described(units)} are unknown: choose one of {', '.join(NAMES)}"
        )
    plain = _plain(units)
    of_g = {"g": 1.0, "g/10": 0.1}
    return float(gravity) * of_g[plain] if plain in of_g else _FACTORS[plain]


_WITH_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\s\d.,].*)")


def acceleration(name: str, value: Any, gravity: float = STANDARD_GRAVITY) -> Any:
    """An acceleration [m/s2] that an argument gives: as it is, or a text with its unit.

    gravity : the value of 1 g [m/s2], for texts in g.

    >>> acceleration("pga", "250 cm/s2")
    2.5

    Raises InputError for a text without a number, or without a unit that is known.
    """
    if not isinstance(value, str):
        return value
    found = _WITH_UNIT.fullmatch(value)
    if not found:
        raise InputError(name, value).give(
            'a number of m/s2, or a text with its unit, such as "0.4 g" or "250 cm/s2"'
        )
    try:
        return float(found[1]) * factor(found[2], gravity)
    except InputError as error:
        raise InputError(name, value).so(f"{error}") from None


# --- what a test measures

_OF_CHANNELS = {
    "m": 1.0,
    "cm": 0.01,
    "mm": 0.001,
    "um": 1e-6,
    "in": 0.0254,
    "rad": 1.0,
    "mrad": 0.001,
    "deg": math.pi / 180,
    "m/s": 1.0,
    "cm/s": 0.01,
    "mm/s": 0.001,
    "rad/s": 1.0,
    "deg/s": math.pi / 180,
    "rad/s2": 1.0,
    "deg/s2": math.pi / 180,
    "n": 1.0,
    "kn": 1e3,
    "-": 1.0,
}
CHANNEL_UNITS = (
    *("m", "cm", "mm", "um", "in", "rad", "mrad", "deg", "m/s", "cm/s", "mm/s", "rad/s", "deg/s"),
    *("rad/s2", "deg/s2", "N", "kN", "-"),
    *NAMES,
)
"""Units in which a channel of a test may stand."""


def channel_factor(units: str, gravity: float = STANDARD_GRAVITY) -> float | None:
    """The factor of a value in these units to SI units; None for unknown units.

    Besides accelerations: lengths, angles, their rates, forces, and "-" for a pure number.
    """
    plain = _plain(units).replace("µ", "u").replace("°", "deg")
    if plain in _OF_CHANNELS:
        return _OF_CHANNELS[plain]
    return factor(units, gravity) if is_known(units) else None
