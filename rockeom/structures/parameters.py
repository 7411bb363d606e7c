"""Checks of the parameters that a structure is made of, and of the states that its methods get."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Any

from rockeom.codes import CONTACT_LAWS, LEAST_RESTITUTION
from rockeom.numbers.checks import described, near, number
from rockeom.numbers.degrees import in_radians, named_in_degrees
from rockeom.numbers.explained import listed
from rockeom.numbers.functions import isfinite

LARGEST = 1e50
"""The largest size of a parameter: its sixth power is a number, and that of its inverse."""


class ParameterError(TypeError):
    """Parameters that a structure lacks or does not know, or that are given without their name."""


def named_states(what: str, values: Any, module: Any) -> Mapping[str, Any]:
    """States by name, in radians; raises TypeError for anything but a mapping of names.

    module : the generated one, which has the names and units. See `rockeom.numbers.degrees`.
    """
    if not (type(values) is dict or isinstance(values, Mapping)):  # most are, and it is faster
        example = f"{{{module.STATES[0]!r}: 0.01}}"
        raise TypeError(f"{what} is {described(values)}: name the states, as in {example}")
    if not named_in_degrees(values):
        return values
    return in_radians(what, values, dict(zip(module.STATES, module.STATE_UNITS, strict=True)))


SYNONYMS = {
    "r": "velocity_ratio",
    "e": "velocity_ratio",
    "m": "mass",
    "g": "gravity",
    "b": "half_width",
    "B": "half_width",
    "h": "half_height",
    "H": "half_height",
    "alpha": "overturning_angles",
    "p": "frequency_parameters",
    "width": "2 * half_width",
    "height": "2 * half_height",
    "k": "stiffness",
    "c": "damping",
    "I": "inertia",
    "mu": "friction",
    "name": "model",
}
"""Symbols and names that people try first, and the attributes that they mean."""

_AS_ARGUMENTS = SYNONYMS | {
    "friction": "support = rk.Sliding(friction=..., ...)",
    "e": "restitution",
    "width": "half_width = width/2",
    "height": "half_height = height/2",
}


def check_names(
    what: str,
    required: Collection[str],
    known: Collection[str],
    given: Collection[str],
    doc: str | None = None,
    others: Callable[[str], str] = lambda name: "",
) -> None:
    """Raise ParameterError naming all that is missing and all that is unknown, with the remedy.

    doc : a docstring that has the units and meanings of the parameters.
    others : gives another call that takes an unknown one, or "".
    """
    missing = [name for name in required if name not in given]
    unknown = [name for name in given if name not in known]
    if not missing and not unknown:
        return
    synonyms = {name: m for name, m in _AS_ARGUMENTS.items() if m.split(" ")[0] in known}
    text = [f"missing {listed(missing, doc)}"] if missing else []
    for name in unknown:
        hint = near(name, {**synonyms, **dict.fromkeys(known)}, synonyms)
        text.append(f"unknown {name}{others(name) or hint}")
    raise ParameterError(f"{what}: {'; '.join(text)}. Its parameters are {', '.join(known)}")


def check_named(
    what: str, unnamed: tuple[Any, ...], known: Iterable[str], doc: str | None = None
) -> None:
    """Raise ParameterError for parameters that are given by their place."""
    if unnamed:
        raise ParameterError(
            f"{what} takes its parameters by name, and {described(unnamed[0])} has none. "
            f"Its parameters are {listed(known, doc)}"
        )


def check_values(
    what: str,
    values: Mapping[str, float],
    may_vanish: frozenset[str] = frozenset(),
    may_be_negative: frozenset[str] = frozenset(),
    largest: float = LARGEST,
) -> None:
    """Raise ValueError for a parameter that is not positive and finite, TypeError for no number.

    Where allowed it may be zero, or any finite number. largest : the size beyond which a parameter
    is refused; one that must be positive is no smaller than its inverse.
    """
    for name, value in values.items():
        given = number(f"{what}: {name}", value, "give a number in SI units")
        allowed = given >= 0 if name in may_vanish else given > 0
        if name in may_be_negative:
            if not isfinite(given):
                raise ValueError(f"{what}: {name} is {value}: it must be finite")
        elif not (isfinite(given) and allowed):
            wanted = "zero or positive" if name in may_vanish else "positive"
            raise ValueError(f"{what}: {name} is {value}: it must be finite and {wanted}")
        signless = name in may_vanish or name in may_be_negative
        if abs(given) > largest or not (signless or given >= 1.0 / largest):
            limits = f"beyond {largest:g}" if abs(given) > 1.0 else f"below {1.0 / largest:g}"
            raise ValueError(
                f"{what}: {name} is {value}, {limits}, so that products of it leave the range of "
                "numbers: give it in SI units"
            )


def check_slenderness(what: str, alpha: float) -> None:
    """Raise ValueError for an angle of a block that is a right one or more, such as degrees."""
    if not alpha < math.pi / 2:
        raise ValueError(
            f"{what}: alpha is {alpha} rad: it must be below pi/2; alpha_degrees= takes degrees"
        )


def check_contact_law(what: str, restitution: float, law: str) -> None:
    """Raise ValueError for an impact law that points have not, and a restitution that it has not.

    law : one of `CONTACT_LAWS`.
    """
    if restitution > 1:
        raise ValueError(
            f"{what}: restitution is {restitution}: give the ratio of rates after and before a "
            "landing, 0 to 1"
        )
    if not isinstance(law, str) or law not in CONTACT_LAWS:
        raise ValueError(
            f"{what}: law is {described(law)}{near(str(law), CONTACT_LAWS)}: give the impact law "
            f"of the feet, one of {', '.join(CONTACT_LAWS)}"
        )
    if law == "lzb" and 0.0 < restitution < LEAST_RESTITUTION:
        raise ValueError(
            f"{what}: restitution is {restitution}: with law='lzb' give 0, or "
            f"{LEAST_RESTITUTION:g} and more, since its springs give back 1 / e times as fast"
        )
