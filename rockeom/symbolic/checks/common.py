"""Words that checks of declarations share: names of a response, and symbols by what they are."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import sympy as sp

from rockeom.symbolic.model import Body

_OUTPUTS = """
t mode kinetic_energy gravitational_energy elastic_energy total_energy
ground_acceleration transverse_ground_acceleration vertical_ground_acceleration
horizontal_reaction transverse_reaction vertical_reaction left_reaction right_reaction
displacement left_uplift right_uplift
damping_loss friction_loss impact_loss ground_work force_work
"""
RESPONSE = frozenset(_OUTPUTS.split())
"""Names in a response besides those of the states."""

PLACES, RATES, ACCELERATIONS, SIDED, SHAKING, INTERNAL = "qvasgz"
"""Kinds of symbols in expressions, besides constants."""
WORDS = {
    PLACES: "the coordinate",
    RATES: "the velocity",
    ACCELERATIONS: "the acceleration",
    SIDED: "the side",
    SHAKING: "the ground's acceleration",
    INTERNAL: "the internal variable",
}

Expressions = Iterator[tuple[str, Any, str]]
"""(item, expression, kinds of symbols that it may contain besides constants)."""


class Names(NamedTuple):
    """Names that a declaration chooses.

    items : (item, name). distinct : rows of names, of which none may stand twice. chosen : those
    that must differ from the names of a response.
    """

    items: list[tuple[str, str]]
    distinct: list[list[str]]
    chosen: set[str]


class ModelError(Exception):
    """A fault of a declaration; the name of the model is put before it where it is known."""


@contextmanager
def naming(model: str, remedy: str = "") -> Iterator[None]:
    """Make a fault a ValueError that names the model, and adds a remedy."""
    try:
        yield
    except ModelError as fault:
        raise ValueError(f"{model}: {fault}{remedy}") from None


def springs_outputs(springs: Iterable[str]) -> tuple[str, ...]:
    """Names of the quantities of these springs in a response."""
    quantities = ("deformation", "force", "energy", "loss")
    return tuple(f"{name}_{what}" for name in springs for what in quantities)


def body_expressions(body: Body, where: str, may: str) -> Expressions:
    """The expressions of a body, whose outline is fixed to it."""
    yield f"mass{where}", body.mass, may
    for what in ("inertia", "rotation"):
        for e in sp.Matrix([[getattr(body, what)]]):
            yield f"{what}{where}", e, may
    for axis, e in zip("xyz", body.position, strict=False):
        yield f"{axis}{where}", e, may
    of = f"of the outline of body {body.name!r}"
    for corner in body.outline:
        for axis, e in zip("xy", corner, strict=True):
            yield f"{axis} of a corner {of}", e, ""
    yield f"the number of copies {of}", body.copies, ""
    yield f"the distance of copies {of}", body.apart, ""
