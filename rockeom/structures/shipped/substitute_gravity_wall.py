"""The controlled wall as Housner's block, made from a wall of the thesis or of the analysis."""

from typing import Self

from rockeom.structures.shipped.declarations import substitute_gravity_wall as declared
from rockeom.structures.shipped.tendoned_wall import Wall
from rockeom.structures.shipped.walls import RockingWall, of_wall


class SubstituteGravityWall(RockingWall, declared.SubstituteGravityWall):
    @classmethod
    def from_wall(cls, wall: Wall) -> Self:
        """Wall of `rockeom.analysis`, its inertia that about a corner.

        Parameters
        ----------
        wall : Wall
            Wall with one tendon.

        Returns
        -------
        SubstituteGravityWall
            Wall with the force of the tendon as weight.
        """
        return cls(
            **of_wall(cls.__name__, wall),
            centroid_height=wall.centroid_height,
            pivot_inertia=wall.corner_inertia,
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
        SubstituteGravityWall
            Wall with the force of the tendon as weight.
        """
        return cls.from_wall(Wall.thesis(initial_force))
