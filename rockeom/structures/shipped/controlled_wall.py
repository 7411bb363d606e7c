"""The rigid controlled wall, made from a wall of the thesis or of `rockeom.analysis`."""

from typing import Self

from rockeom.structures.shipped.declarations import controlled_wall as declared
from rockeom.structures.shipped.tendoned_wall import Wall
from rockeom.structures.shipped.walls import RockingWall, of_wall


class ControlledWall(RockingWall, declared.ControlledWall):
    @classmethod
    def from_wall(cls, wall: Wall, anchor_distance: float = 3.1) -> Self:
        """Wall of `rockeom.analysis`.

        The lower anchor is put at the base. The inertia about the centroid is that of 4-19 when the
        wall turns about its centreline.

        Parameters
        ----------
        wall : Wall
            Wall with one tendon.
        anchor_distance : float, optional
            Distance of the tendon's anchors [m].

        Returns
        -------
        ControlledWall
            Wall by Lagrange's equations.
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
    def thesis(cls, initial_force: float = 75.6e3) -> Self:
        """Wall of thesis chapter 4.

        Parameters
        ----------
        initial_force : float, optional
            Initial force of its tendon, 75.6 kN or 111 kN [N].

        Returns
        -------
        ControlledWall
            Wall by Lagrange's equations.
        """
        return cls.from_wall(Wall.thesis(initial_force))
