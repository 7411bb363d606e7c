"""Derivation of rocking structures with SymPy: declare bodies and contacts, derive the rest."""

from typing import Any

from rockeom.numbers import explained
from rockeom.symbolic import space
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Contact, Force, Pinned, Rigid, dead_load, feet
from rockeom.symbolic.elements import Break, Damper, Pulse, Spring, Tie, Unilateral, Yielding
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    Definition,
    Foot,
    InternalVariable,
    Member,
    NamedFunction,
    Parameter,
    coordinate,
    internal_variable,
    parameter,
    rectangle,
    turned,
)
from rockeom.symbolic.registry import SHIPPED, derive, models
from rockeom.symbolic.rocking import RockingModel, rocking_structure


def __getattr__(name: str) -> Any:
    """The function that declares a shipped structure, such as `controlled_wall`."""
    if name in SHIPPED:
        return SHIPPED[name]
    message = f"module {__name__!r} has no attribute {name!r}"
    if name.startswith("_"):
        raise AttributeError(message)
    offers = {one: one for one in (*__all__, *SHIPPED)}
    raise explained.UnknownAttributeError(message, name, lambda: offers)


__all__ = [
    "SHIPPED",
    "SIDE",
    "Body",
    "Break",
    "Contact",
    "Coordinate",
    "Damper",
    "Definition",
    "Foot",
    "Force",
    "InternalVariable",
    "Member",
    "Mode",
    "Model",
    "NamedFunction",
    "Parameter",
    "Pinned",
    "Pulse",
    "Rigid",
    "RockingModel",
    "Spring",
    "Tie",
    "Transition",
    "Unilateral",
    "Yielding",
    "coordinate",
    "dead_load",
    "derive",
    "feet",
    "internal_variable",
    "models",
    "parameter",
    "rectangle",
    "rocking_structure",
    "space",
    "turned",
]
