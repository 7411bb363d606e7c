"""Derivation of rocking structures with SymPy: declare bodies and contacts, derive the rest."""

from __future__ import annotations

from typing import Any

from rockeom.symbolic import former
from rockeom.symbolic.contacts import Contact, Force, Model, Pinned, Rigid, feet
from rockeom.symbolic.elements import Spring, Unilateral, Yielding
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    Definition,
    Foot,
    InternalVariable,
    Mechanism,
    Member,
    NamedFunction,
    Parameter,
    RockingModel,
    Transition,
    coordinate,
    internal_variable,
    parameter,
    rectangle,
    rocking_structure,
    turned,
)
from rockeom.symbolic.registry import SHIPPED, derive, models


def __getattr__(name: str) -> Any:
    """The function that declares a shipped structure, such as `controlled_wall`."""
    if name in SHIPPED:
        return SHIPPED[name]
    renamed = former.classes(globals(), name)
    if renamed is not None:
        return renamed
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__all__ = [
    "SHIPPED",
    "Body",
    "Contact",
    "Coordinate",
    "Definition",
    "Foot",
    "Force",
    "InternalVariable",
    "Mechanism",
    "Member",
    "Model",
    "NamedFunction",
    "Parameter",
    "Pinned",
    "Rigid",
    "RockingModel",
    "Spring",
    "Transition",
    "Unilateral",
    "Yielding",
    "coordinate",
    "derive",
    "feet",
    "internal_variable",
    "models",
    "parameter",
    "rectangle",
    "rocking_structure",
    "turned",
]
