"""The controlled wall that bends: how it is made, its fixed base, and its equilibrium."""

from __future__ import annotations

import math

import numpy as np

from rockeom.structures.base import FixedBase
from rockeom.structures.parameters import check_values
from rockeom.structures.shipped.controlled_wall import ControlledWall
from rockeom.structures.shipped.declarations import flexible_controlled_wall as declared
from rockeom.structures.shipped.flexible_structure import FlexibleStructure
from rockeom.structures.shipped.tendoned_wall import Wall
from rockeom.structures.shipped.walls import RockingWall


class FlexibleControlledWall(RockingWall, declared.FlexibleControlledWall):
    @classmethod
    def from_wall(
        cls,
        wall: Wall,
        fixed_base_period: float | None = None,
        damping_ratio: float = 0.0,
        anchor_distance: float = 3.1,
    ) -> FlexibleControlledWall:
        """Wall of `rockeom.analysis` that bends.

        Parameters
        ----------
        wall : Wall
            Wall with one tendon.
        fixed_base_period : float, optional
            Period on a fixed base [s]; the wall's own if not given.
        damping_ratio : float, optional
            Part of critical damping on a fixed base.
        anchor_distance : float, optional
            Distance of the tendon's anchors [m], as for `ControlledWall.from_wall`.

        Returns
        -------
        FlexibleControlledWall
            Wall by Lagrange's equations.

        Raises
        ------
        ValueError
            For numbers that are not positive.
        """
        rigid = ControlledWall.from_wall(wall, anchor_distance)
        period = wall.fixed_base_period if fixed_base_period is None else fixed_base_period
        given = {"fixed_base_period": period, "damping_ratio": damping_ratio}
        check_values(cls.__name__, given, frozenset({"damping_ratio"}))
        frequency = 2 * math.pi / period
        return cls(
            **rigid.parameters(),
            stiffness=rigid.mass * frequency**2,
            damping=2 * damping_ratio * frequency * rigid.mass,
        )

    @classmethod
    def thesis(
        cls, initial_force: float = 75.6e3, damping_ratio: float = 0.0
    ) -> FlexibleControlledWall:
        """Wall of thesis chapter 4 that bends.

        Parameters
        ----------
        initial_force : float, optional
            Initial force of its tendon, 75.6 kN or 111 kN [N].
        damping_ratio : float, optional
            Part of critical damping on a fixed base.

        Returns
        -------
        FlexibleControlledWall
            Wall by Lagrange's equations.
        """
        return cls.from_wall(Wall.thesis(initial_force), damping_ratio=damping_ratio)

    def fixed_base(self) -> FixedBase:
        """Wall on a base that cannot turn: its mass at centroid_height on the elastic column.

        The tendon then keeps its force, which bends nothing; the forces on the feet are those of
        weight and ground motion alone.

        Returns
        -------
        FixedBase
            Structure on a fixed base.
        """
        same = ("mass", "inertia", "half_width", "gravity", "stiffness", "damping")
        values = {name: getattr(self, name) for name in same}
        base = dict.fromkeys(("base_mass", "base_height", "base_inertia"), 0.0)
        return FlexibleStructure(height=self.centroid_height, **values, **base).fixed_base()

    def load(self, mode: int, y: np.ndarray) -> float:
        """Force with which the rotation of a state is in equilibrium, as for the rigid wall.

        The deflection u of the state is put to its own equilibrium.

        Parameters
        ----------
        mode : int
            Number of the mode.
        y : ndarray
            State (N,), whose u changes.

        Returns
        -------
        float
            Force at the load point [N].

        Raises
        ------
        ValueError
            Where there is no equilibrium.
        """
        u = self.states.index("u")
        last = math.inf
        for _ in range(50):  # each time the error falls by about m g/(k H)
            load = super().load(mode, y)
            change = self.lacking(mode, y, load)[u] / self.stiffness
            y[u] -= change
            if abs(change) <= 1e-14 * abs(y[u]):
                return load
            if abs(change) > last:  # where it does not fall, there is one kilometres away
                break
            last = abs(change)
        raise ValueError(
            f"no equilibrium of {self.model} at rotation {y[self.module.ROTATION]}: its stiffness, "
            f"{self.stiffness}, hardly holds its weight upright"
        )
