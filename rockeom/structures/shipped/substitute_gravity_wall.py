"""The controlled wall as Housner's block, made from a wall of the thesis or of the analysis."""

from __future__ import annotations

from typing import Self

from rockeom.structures.shipped.declarations import substitute_gravity_wall as declared
from rockeom.structures.shipped.walls import RockingWall, of_wall
from rockeom.structures.wall import Wall


class SubstituteGravityWall(RockingWall, declared.SubstituteGravityWall):
    @classmethod
    def from_wall(cls, wall: Wall) -> Self:
        """The wall of `rockeom.analysis`, its inertia that about a corner."""
        return cls(
            **of_wall(cls.__name__, wall),
            centroid_height=wall.centroid_height,
            pivot_inertia=wall.corner_inertia,
        )

    @classmethod
    def thesis(cls, initial_force: float = 75.6e3) -> Self:
        """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N]."""
        return cls.from_wall(Wall.thesis(initial_force))
