"""Uplift, sliding and restraint under a horizontal acceleration that grows slowly.

The ground accelerates the whole structure by a. A structure of mass M that rests on the ground with
the force V presses with H = M a across. The force on the foot that lifts first falls linearly, from
N_0 at rest to zero at the uplift acceleration a_u (g B/H of a block of half width B with its
centroid at height H):

- it slides where H = mu V. Before it lifts it does so if mu < M a_u/V, which is B/H of a block;
- beyond a_u it stays on both feet if the one that would lift is held down by N_0 (a/a_u - 1);
- or if a horizontal force at height z carries the same moment about the other foot, at the distance
  2 B: N_0 (a/a_u - 1) 2 B/z, which is M (a H - g B)/z of a block.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rockeom.structures.base import Structure


class Statics(NamedTuple):
    """A structure at rest, and what changes it.

    uplift_acceleration : that lifts a foot [m/s2]. weight : vertical force of the ground, of
    tendons too [N]. mass : of all that the ground accelerates [kg]. least_foot : force on the foot
    that lifts first [N]. base_width : distance of the feet [m].
    """

    uplift_acceleration: float
    weight: float
    mass: float
    least_foot: float
    base_width: float

    @property
    def friction_to_rock(self) -> float:
        """Coefficient of friction below which it slides before it rocks; B/H of a block."""
        return self.mass * self.uplift_acceleration / self.weight

    @property
    def centroid_height(self) -> float:
        """Height of the centroid of all that the ground accelerates [m]."""
        return self.least_foot * self.base_width / (self.mass * self.uplift_acceleration)

    def sliding_acceleration(self, friction: float) -> float:
        """Acceleration from which it slides if it does not lift before [m/s2]."""
        return friction * self.weight / self.mass

    def hold_down(self, acceleration: float) -> float:
        """Force that keeps the foot on the ground [N]; 0 where it stays there by itself."""
        return self.least_foot * max(0.0, acceleration / self.uplift_acceleration - 1.0)

    def restraint(self, acceleration: float, height: float) -> float:
        """Horizontal force at a height [m] that keeps both feet on the ground [N]."""
        return self.hold_down(acceleration) * self.base_width / height


def statics_of(structure: Structure) -> Statics:
    """The statics of a structure that rocks on rigid ground.

    Raises ValueError for another one, and for one that no acceleration lifts.
    """
    threshold = structure.uplift_acceleration
    if threshold is None or structure.module.STATE_UNITS[structure.module.ROTATION] != "rad":
        raise ValueError(
            f"assess: {structure.model} has no feet that lift from rigid ground, in metres and "
            "seconds: take a RigidBlock, with friction= where it may slide, LumpedMassStructure, "
            "FlexibleStructure or ShearFrame"
        )
    if not math.isfinite(threshold):
        raise ValueError(f"assess: no horizontal acceleration lifts {structure.model}")
    feet, lifted = _feet(structure), _feet(structure, 1.0)
    pushed = structure.reactions({}, ground_acceleration=1.0)["horizontal_reaction"]
    mass = abs(float(pushed)) + _moving_mass(structure)
    places = structure.positions({})
    return Statics(
        threshold,
        # the beam of a rocking frame bears on the feet of one side, and counts on both
        float(feet.sum() * mass / (lifted - feet).sum()),
        mass,
        float(feet.min()),
        float(abs(places["right"][0] - places["left"][0])),
    )


def _feet(structure: Structure, vertical: float = 0.0) -> np.ndarray:
    """(2,) forces on the left and the right foot under a vertical acceleration [N]."""
    forces = structure.reactions({}, vertical_ground_acceleration=vertical)
    return np.array([forces["left_reaction"], forces["right_reaction"]], dtype=float)


def _moving_mass(structure: Structure) -> float:
    """Mass that moves relative to feet that are held [kg]; that of a rigid structure does not."""
    try:
        return float(structure.fixed_base().effective_masses.sum())
    except ValueError:
        return 0.0
