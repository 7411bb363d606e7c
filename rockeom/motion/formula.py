"""The formula of a motion, as `GroundMotion.single_sine(3.0, 0.8)`, and it with other numbers."""

import inspect
from collections.abc import Callable, Mapping
from functools import cache, wraps
from typing import Any, NamedTuple, TypeVar

from rockeom.motion.units import acceleration
from rockeom.numbers.checks import InputError, is_number, positive_number

C = TypeVar("C", bound=type)

FORMULAS = (
    "none", "constant", "half_sine", "single_sine", "single_cosine", "harmonic", "ricker",
    "mavroeidis_papageorgiou",
)  # fmt: skip
"""Class methods of `GroundMotion` whose motions know the call that made them."""

UNITS = {
    "amplitude": "m/s2", "acceleration": "m/s2", "velocity": "m/s", "period": "s",
    "frequency": "Hz", "angular_frequency": "rad/s", "phase": "rad", "gamma": "-",
    "duration": "s", "total_duration": "s",
}  # fmt: skip
"""Units of the numbers of all formulas, by name."""


class Formula(NamedTuple):
    """A class method of `GroundMotion`, and the arguments that it was called with."""

    make: Callable[..., Any]
    arguments: Mapping[str, Any]

    @property
    def numbers(self) -> dict[str, float]:
        """Its numbers by name; of a period or a frequency also the other one of the two."""
        found = {name: x for name, x in self.arguments.items() if name in UNITS and is_number(x)}
        for name, other in _RECIPROCALS.items():
            if name in found:
                found.setdefault(other, 1.0 / found[name])
        return found

    def with_numbers(self, changes: Mapping[str, Any]) -> Any:
        """The motion with other numbers; raises InputError for a period with its frequency."""
        if {*_RECIPROCALS} <= changes.keys():
            raise InputError("frequency").wrong("is 1/period: name one of both")
        arguments = dict(self.arguments)
        for name, x in changes.items():
            if arguments.get(name) is None and name in _RECIPROCALS:
                arguments[_RECIPROCALS[name]] = 1 / positive_number(name, x)
            else:
                arguments[name] = x
        return self.make(**arguments)


_RECIPROCALS = {"period": "frequency", "frequency": "period"}


def formula_of(motion: Any) -> Formula | None:
    """The formula that made a motion; None of a record, and of one that was changed since."""
    if (call := vars(motion).get(_CALL)) is None:
        return None
    name, values, named = call
    make = getattr(type(motion), name)
    bound = _signature(make).bind(*values, **named)
    bound.apply_defaults()
    return Formula(make, bound.arguments)


def call_of(motion: Any) -> dict[str, Any]:
    """The attribute by which a motion knows its formula, for a pickle; none where it has none."""
    return {name: x for name, x in vars(motion).items() if name == _CALL}


_CALL = "_call"
_signature = cache(inspect.signature)


def with_formulas(cls: C) -> C:
    """Let the motions of `FORMULAS` know the call that made them."""
    for name in FORMULAS:
        setattr(cls, name, classmethod(_recorded(vars(cls)[name].__func__)))
    return cls


def _recorded(make: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(make)
    def recorded(cls: type, *values: Any, **named: Any) -> Any:
        if any(isinstance(x, str) for x in (*values, *named.values())):
            bound = inspect.signature(make).bind(cls, *values, **named)
            named = {n: acceleration(n, x) if UNITS.get(n) == "m/s2" else x
                     for n, x in bound.arguments.items() if n != "cls"}  # fmt: skip
            values = ()
        motion = make(cls, *values, **named)
        vars(motion)[_CALL] = make.__name__, values, named
        return motion

    return recorded
