"""Derivation of rocking structures with SymPy: declare bodies and contacts, derive the rest."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from rockeom.symbolic.controlled_wall import (
    controlled_wall,
    controlled_wall_oscillator,
    flexible_controlled_wall,
    simplified_substitute_gravity_wall,
    substitute_gravity_wall,
)
from rockeom.symbolic.dirac_delta import dirac_delta_block
from rockeom.symbolic.flexible import flexible_structure
from rockeom.symbolic.lumped_mass import lumped_mass_structure
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    Definition,
    Foot,
    Law,
    Parameter,
    Phase,
    RockingModel,
    Transition,
    coordinate,
    parameter,
    rocking_structure,
    turned,
)
from rockeom.symbolic.rigid_block import nondimensional_block, rigid_block, slender_block
from rockeom.symbolic.two_spring import two_spring_cart, two_spring_structure
from rockeom.symbolic.uplifting_oscillator import uplifting_oscillator

SHIPPED: dict[str, Callable[[], RockingModel]] = {
    build.__name__: build
    for build in (
        rigid_block,
        slender_block,
        nondimensional_block,
        dirac_delta_block,
        lumped_mass_structure,
        two_spring_structure,
        two_spring_cart,
        uplifting_oscillator,
        flexible_structure,
        controlled_wall,
        flexible_controlled_wall,
        controlled_wall_oscillator,
        substitute_gravity_wall,
        simplified_substitute_gravity_wall,
    )
}


def models() -> tuple[str, ...]:
    """Names of the shipped structures."""
    return tuple(SHIPPED)


def derive(name: str) -> RockingModel:
    """A shipped structure by its name, derived once in a session.

    Raises KeyError, naming the shipped ones, if there is none of that name.
    """
    if name not in SHIPPED:
        raise KeyError(f"no structure named {name!r}; shipped are {', '.join(SHIPPED)}")
    return _derived(SHIPPED[name])


@cache
def _derived(structure: Callable[[], RockingModel]) -> RockingModel:
    return structure()


__all__ = [
    "SHIPPED",
    "Body",
    "Coordinate",
    "Definition",
    "Foot",
    "Law",
    "Parameter",
    "Phase",
    "RockingModel",
    "Transition",
    "coordinate",
    "derive",
    "models",
    "parameter",
    "rocking_structure",
    "turned",
]
