"""What a base stands on: how it may move, and what holds it."""

from __future__ import annotations

from rockeom.symbolic.model import RockingModel, rocking_structure, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, HALF_WIDTH, ROTATION, Superstructure


def pinned(of: Superstructure, title: str = "", reference: str = "") -> RockingModel:
    """On feet that may lift, and neither slide nor bounce."""
    theta = ROTATION.position
    return rocking_structure(
        name=of.name,
        title=title or f"{of.title} on rigid ground",
        parameters=of.parameters,
        coordinates=(ROTATION, *of.coordinates),
        bodies=lambda pivot: of.bodies(lambda point: turned(point, pivot, theta), theta),
        half_width=HALF_WIDTH.symbol,
        gravity=GRAVITY.symbol,
        elastic_energy=of.elastic_energy,
        dissipation=of.dissipation,
        reference=reference,
    )
