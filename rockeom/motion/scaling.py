"""How a motion is scaled: the intensity that it is to have, and the name that it gets."""

import re
from typing import Any, NamedTuple

from rockeom.motion.units import acceleration
from rockeom.numbers.batch import Many
from rockeom.numbers.checks import InputError, InputTypeError, described, is_number, positive_number
from rockeom.numbers.functions import Compound

Acceleration = float | str
"""An acceleration [m/s2], or a text with its unit: "0.4 g"."""


class Target(NamedTuple):
    """The intensity that a motion is to have [m/s2].

    period [s] : of the oscillator of a spectral acceleration; None for the largest of the ground.
    """

    value: float
    period: float | None

    @property
    def intensity(self) -> str:
        return "pga" if self.period is None else "sa"


def target(
    peak: Acceleration | None,
    pga: Acceleration | None,
    sa: Acceleration | None,
    period: float | None,
) -> Target:
    """The one intensity that the arguments of `scaled_to` name; else InputError."""
    given = {"peak": peak, "pga": pga, "sa": sa}
    given = {name: value for name, value in given.items() if value is not None}
    if len(given) != 1:
        named = " and ".join(f"{name}={value!r}" for name, value in given.items())
        raise InputError("pga", pga, "scaled_to").says(
            f"it has {named or 'no intensity'}: give exactly one, such as "
            '{pga:"0.4 g"}, or {sa:3.0} [m/s2] with {period:1.0} [s]'
        )
    ((name, value),) = given.items()
    if name != "sa" and period is not None:
        raise InputError(name).wrong("has no period: leave it out, or give sa")
    if name == "sa" and period is None:
        raise InputError("sa").wrong("needs the period of its oscillator [s]: give {period}")
    wanted = acceleration(name, value)
    return Target(
        positive_number(name, wanted), None if period is None else positive_number("period", period)
    )


def multiplier(value: Any, done: str = "multiplied") -> Any:
    """The number that a motion is multiplied or divided by.

    Raises InputTypeError for anything else, and InputError where zero divides.
    """
    if not (is_number(value) or isinstance(value, Compound)):
        raise InputTypeError("factor", value).says(
            f"a ground motion is {done} by {described(value)}: give a number, as in 2 * motion"
        )
    if done == "divided" and value == 0.0:
        raise InputError("factor", value).so("no motion is divided by it")
    return value


_PRINTED = r"(-?\d+\.?\d*(?:e[+-]\d+)?)"
SCALE_IN_NAME = re.compile(f"-A{_PRINTED}-T{_PRINTED}$")


def scaled_name(name: str, acceleration: float, time: float) -> str:
    """The name with its factors at the end; those of an earlier scaling are multiplied."""
    if scale := SCALE_IN_NAME.search(name):
        name = name[: scale.start()]
        acceleration, time = acceleration * float(scale[1]), time * float(scale[2])
    return name + named("-A{:.4g}-T{:.4g}", acceleration, time)


def named(text: str, *values: float) -> str:
    """A text with numbers; empty for a batch of motions, which differ in them."""
    return "" if Many in map(type, values) else text.format(*values)
