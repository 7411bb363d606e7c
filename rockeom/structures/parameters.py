"""Checks of the parameters that a structure is made of, and of the states that its methods get."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Any

from rockeom.codes import CONTACT_LAWS, LEAST_RESTITUTION
from rockeom.numbers.checks import InputError, InputTypeError, described, near, number
from rockeom.numbers.degrees import in_radians, named_in_degrees
from rockeom.numbers.explained import listed
from rockeom.numbers.functions import isfinite

LARGEST = 1e50
"""The largest size of a parameter: its sixth power is a number, and that of its inverse."""


def named_states(what: str, values: Any, module: Any) -> Mapping[str, Any]:
    """States by name, in radians; raises TypeError for anything but a mapping of names.

    module : the generated one, which has the names and units. See `rockeom.numbers.degrees`.
    """
    if not (type(values) is dict or isinstance(values, Mapping)):  # most are, and it is faster
        example = f"{{{module.STATES[0]!r}: 0.01}}"
        raise InputTypeError(what, values).so(f"name the states, as in {example}")
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

OF_DERIVATION = {
    name: f"rockeom.derive(it).{meant}"
    for name, meant in {
        "equations": 'equations("right")',
        "eom": 'equations("right")',
        "mass_matrix": 'equations("right").mass_matrix',
        "forcing": 'equations("right").forcing',
        "impulse_map": 'impulse_map("right", "left")',
        "impact_map": 'impulse_map("right", "left")',
        "linearize": 'linearize("right")',
        "lambdify": "lambdify()",
        "latex": "latex()",
        "symbols": "symbols",
    }.items()
}
"""Names that people try on a structure, and what has them: the derivation."""

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
    """Raise InputTypeError naming all that is missing and all that is unknown, with the remedy.

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
    raise InputTypeError((missing or unknown)[0], of=what).says(
        f"{'; '.join(text)}: its parameters are {', '.join(known)}"
    )


def check_named(
    what: str, unnamed: tuple[Any, ...], known: Iterable[str], doc: str | None = None
) -> None:
    """Raise InputTypeError for parameters that are given by their place."""
    if unnamed:
        raise InputTypeError("", unnamed[0], what).says(
            f"it takes its parameters by name, and {described(unnamed[0])} has none: they are "
            f"{listed(known, doc)}"
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
        given = number(name, value, what, "a number in SI units")
        allowed = given >= 0 if name in may_vanish else given > 0
        if name in may_be_negative:
            if not isfinite(given):
                raise InputError(name, value, what).hold("it must be finite")
        elif not (isfinite(given) and allowed):
            wanted = "zero or positive" if name in may_vanish else "positive"
            raise InputError(name, value, what).hold(f"it must be finite and {wanted}")
        signless = name in may_vanish or name in may_be_negative
        if abs(given) > largest or not (signless or given >= 1.0 / largest):
            limits = f"beyond {largest:g}" if abs(given) > 1.0 else f"below {1.0 / largest:g}"
            raise InputError(name, value, what).wrong(
                f"is {value}, {limits}, so that products of it leave the range of numbers: give it "
                "in SI units"
            )


def check_slenderness(what: str, alpha: float) -> None:
    """Raise ValueError for an angle of a block that is a right one or more, such as degrees."""
    if not alpha < math.pi / 2:
        raise InputError("alpha", alpha, what).give("less than pi/2; alpha_degrees= takes degrees")


def check_contact_law(what: str, restitution: float, law: str) -> None:
    """Raise ValueError for an impact law that points have not, and a restitution that it has not.

    law : one of `CONTACT_LAWS`.
    """
    if restitution > 1:
        raise InputError("restitution", restitution, what).give(
            "the ratio of rates after and before a landing, 0 to 1"
        )
    if not isinstance(law, str) or law not in CONTACT_LAWS:
        raise InputError("law", law, what).says(
            f"law is {described(law)}{near(str(law), CONTACT_LAWS)}: give the impact law of the "
            f"feet, one of {', '.join(CONTACT_LAWS)}"
        )
    if law == "lzb" and 0.0 < restitution < LEAST_RESTITUTION:
        raise InputError("restitution", restitution, what).so(
            f"with law='lzb' give 0, or {LEAST_RESTITUTION:g} and more, since its springs give "
            "back 1 / e times as fast"
        )
