"""Closed forms of Housner's block."""

from __future__ import annotations

import math
from typing import Self

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.functions import mathematics
from rockeom.structures.parameters import check_values
from rockeom.structures.shipped.declarations import rigid_block as declared


class RigidBlock(declared.RigidBlock):
    @classmethod
    def from_frequency(
        cls,
        p: float,
        alpha: float,
        mass: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
        **others: float,
    ) -> Self:
        """The homogeneous rectangular block of frequency parameter p [rad/s] and angle alpha [rad].

        p**2 = m g R/I_o = 3 g/(4 R). others : the parameters that are left.
        """
        check_values(cls.__name__, {"p": p, "alpha": alpha, "gravity": gravity})
        if not alpha < math.pi / 2:
            raise ValueError(f"{cls.__name__}: alpha is {alpha}: it must be below pi/2")
        radius = 0.75 * gravity / p**2
        return cls(
            half_width=radius * mathematics.sin(alpha),
            half_height=radius * mathematics.cos(alpha),
            mass=mass,
            gravity=gravity,
            **others,
        )

    @property
    def alpha(self) -> float:
        """Angle of the line from an edge to the centroid, from the vertical [rad]."""
        return mathematics.atan2(self.half_width, self.half_height)

    @property
    def radius(self) -> float:
        """Distance of the centroid from an edge, R [m]."""
        return mathematics.hypot(self.half_width, self.half_height)

    @property
    def frequency_parameter(self) -> float:
        """p = sqrt(m g R/I_o) [rad/s]."""
        pivot_inertia = self.parameters()["inertia"] + self.mass * self.radius**2
        return mathematics.sqrt(self.mass * self.gravity * self.radius / pivot_inertia)

    def hints(self) -> tuple[str, ...]:
        return (*super().hints(), *inertia_hints(self.mass, self.radius, self.inertia))

    def parameters(self) -> dict[str, float]:
        values = super().parameters()
        if self.inertia is None:
            values["inertia"] = self.mass * self.radius**2 / 3
        return values


def inertia_hints(mass: float, radius: float, inertia: float | None) -> tuple[str, ...]:
    """Hints at a centroid amid a rectangle and an inertia that no body within it has."""
    most = mass * radius**2
    if inertia is None or inertia <= most * (1 + 1e-12):
        return ()
    return (
        f"inertia is {inertia:.4g} kg m2 about the centroid; a body of this size has at most "
        f"m R**2 = {most:.4g} kg m2, with all its mass at the corners.",
    )
