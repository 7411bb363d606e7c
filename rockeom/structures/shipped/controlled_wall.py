"""The rigid controlled wall, made from a wall of the thesis or of `rockeom.analysis`."""

from __future__ import annotations

from rockeom.structures.shipped.declarations import controlled_wall as declared
from rockeom.structures.shipped.walls import RockingWall, of_wall
from rockeom.structures.wall import Wall


class ControlledWall(RockingWall, declared.ControlledWall):
    @classmethod
    def from_wall(cls, wall: Wall, anchor_distance: float = 3.1) -> ControlledWall:
        """The wall of `rockeom.analysis`; anchor_distance of the tendon's anchors [m].

        The lower anchor is put at the base. The inertia about the centroid is that of 4-19 when
        the wall turns about its centreline.
        """
        shared = of_wall(cls.__name__, wall)
        about_base = float(wall.moment_of_inertia(wall.half_width))
        return cls(
            **shared,
            centroid_height=wall.centroid_height,
            inertia=about_base - wall.mass * wall.centroid_height**2,
            anchor_height=anchor_distance,
            anchor_depth=0.0,
        )

    @classmethod
    def thesis(cls, initial_force: float = 75.6e3) -> ControlledWall:
        """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N]."""
        return cls.from_wall(Wall.thesis(initial_force))
