"""Flexible structure of two masses on rigid ground (thesis Model C, 5.3.3 and Appendix D)."""

from __future__ import annotations

from rockeom.symbolic.model import RockingModel, coordinate, parameter, rocking_structure
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.structures.lumped_mass import HALF_WIDTH, PARAMETERS, base, superstructure
from rockeom.symbolic.structures.rigid_block import GRAVITY, ROTATION

DEFORMATION = coordinate("u", "u", "m", "deformation of the column, at right angles to its axis")
STIFFNESS = parameter("k", "stiffness", "N/m", "flexural stiffness of the column")
DAMPING = parameter("c", "damping", "N s/m", "viscous damping coefficient of the column")


@shipped(place=9)
def flexible_structure() -> RockingModel:
    """A superstructure on an elastic, damped column that stands on a rocking rigid base."""
    theta, u = ROTATION.position, DEFORMATION.position
    return rocking_structure(
        name="flexible_structure",
        title="Flexible structure on rigid ground (Model C)",
        parameters=(*PARAMETERS, STIFFNESS, DAMPING),
        coordinates=(ROTATION, DEFORMATION),
        bodies=lambda pivot: [superstructure(pivot, theta, u), base(pivot, theta)],
        half_width=HALF_WIDTH.symbol,
        gravity=GRAVITY.symbol,
        elastic_energy=STIFFNESS.symbol * u**2 / 2,
        dissipation=DAMPING.symbol * DEFORMATION.velocity**2 / 2,
        reference="thesis 5-34, 5-35, D-1 to D-29",
    )
