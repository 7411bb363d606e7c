"""Rigid structure of two lumped masses on rigid ground (thesis Model A, 5.3.1)."""

from __future__ import annotations

import sympy as sp

from rockeom.symbolic.model import (
    Body,
    Parameter,
    RockingModel,
    parameter,
    rocking_structure,
    turned,
)
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.structures.rigid_block import GRAVITY, ROTATION

MASS = parameter("m_e", "mass", "kg", "mass of the superstructure")
HEIGHT = parameter("H_e", "height", "m", "height of the superstructure's centroid")
INERTIA = parameter("I_eg", "inertia", "kg m2", "its moment of inertia about its centroid")
BASE_MASS = parameter("m_b", "base_mass", "kg", "mass of the base structure")
BASE_HEIGHT = parameter("H_b", "base_height", "m", "height of the base's centroid")
BASE_INERTIA = parameter(
    "I_bg", "base_inertia", "kg m2", "its moment of inertia about its centroid"
)
HALF_WIDTH = parameter("B", "half_width", "m", "half of the distance between the feet")

PARAMETERS: tuple[Parameter, ...] = (
    MASS,
    HEIGHT,
    INERTIA,
    BASE_MASS,
    BASE_HEIGHT,
    BASE_INERTIA,
    HALF_WIDTH,
    GRAVITY,
)


def polar_symbols(height: Parameter, index: str):
    """R and alpha of a body, for equations in the thesis's form."""
    return (
        HALF_WIDTH.symbol,
        height.symbol,
        sp.Symbol(f"R_{index}", positive=True),
        sp.Symbol(f"alpha_{index}", positive=True),
    )


def base(pivot, angle) -> Body:
    """The base structure turning about `pivot`."""
    return Body(
        "base",
        BASE_MASS.symbol,
        turned((0, BASE_HEIGHT.symbol), pivot, angle),
        BASE_INERTIA.symbol,
        angle,
        polar_symbols(BASE_HEIGHT, "b"),
    )


def superstructure(pivot, angle, deformation=sp.S.Zero) -> Body:
    """The superstructure, displaced by `deformation` at right angles to the turned axis."""
    return Body(
        "superstructure",
        MASS.symbol,
        turned((deformation, HEIGHT.symbol), pivot, angle),
        INERTIA.symbol,
        angle,
        polar_symbols(HEIGHT, "e"),
    )


@shipped(place=5)
def lumped_mass_structure() -> RockingModel:
    """A rigid superstructure and a base, both lumped, rocking about two fixed pivots."""
    theta = ROTATION.position
    return rocking_structure(
        name="lumped_mass_structure",
        title="Rigid lumped-mass structure on rigid ground (Model A)",
        parameters=PARAMETERS,
        coordinates=(ROTATION,),
        bodies=lambda pivot: [superstructure(pivot, theta), base(pivot, theta)],
        half_width=HALF_WIDTH.symbol,
        gravity=GRAVITY.symbol,
        reference="thesis 5-8 to 5-14",
    )
