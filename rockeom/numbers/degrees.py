"""Angles in degrees, by the names of their arguments: converted to radians at the border.

Whatever has the unit rad or rad/s may be named with `_degrees` behind its name: a parameter
(`alpha_degrees=14`), a state (`initial={"theta_degrees": 5}`), its rate
(`theta_dot_degrees`, degrees per second), a number of a sweep (`over={"alpha_degrees": [12, 14]}`).
"""

import math
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, TypeVar

import numpy as np

from rockeom.numbers.checks import InputError, array_of, number

F = TypeVar("F", bound=Callable[..., Any])
SUFFIX = "_degrees"
ANGLES = {"rad": "degree", "rad/s": "degree/s"}
"""Units of what may be named in degrees, and those that it has then."""
RADIANS = math.pi / 180.0
"""One degree."""


def in_radians(what: str, values: Mapping[str, Any], units: Mapping[str, str]) -> dict[str, Any]:
    """The values by name, those in degrees under their name in radians.

    units : of all names that are known. A name with the suffix that is none of an angle stays as it
    is, for the check of names. Raises ValueError where an angle is given in both units.
    """
    converted: dict[str, Any] = {}
    for name, value in values.items():
        plain = name.removesuffix(SUFFIX) if isinstance(name, str) else name
        if name in units or plain == name or units.get(plain) not in ANGLES:
            converted[name] = value
            continue
        if plain in values:
            raise InputError(name, of=what).says(
                f"{plain} and {name} are both given, which are one angle in two units: leave one "
                "out"
            )
        read = number if np.ndim(value) == 0 else array_of
        converted[plain] = read(f"{what}: {name}", value) * RADIANS
    return converted


def named_in_degrees(names: Any) -> bool:
    """Whether any of the names may be that of an angle in degrees."""
    return any(type(name) is str and name.endswith(SUFFIX) for name in names)


def accepts_degrees(*angles: str) -> Callable[[F], F]:
    """Let a function take the arguments of these names in degrees, too: `alpha_degrees=14`."""
    units = dict.fromkeys(angles, "rad")

    def decorate(function: F) -> F:
        @wraps(function)
        def call(*arguments: Any, **named: Any) -> Any:
            if named_in_degrees(named):
                named = in_radians(function.__qualname__, named, units)
            return function(*arguments, **named)

        return call  # type: ignore[return-value]

    return decorate


def with_degrees(value: float, unit: str) -> str:
    """A value with its unit, that of an angle with its degrees: "0.245 rad (14.0 degrees)"."""
    size = f"{value:.4g} {unit}".removesuffix(" -")
    return f"{size} ({math.degrees(value):.3g} degrees)" if unit == "rad" and value else size
