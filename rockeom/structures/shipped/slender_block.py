"""Closed forms of the linearised block."""

from __future__ import annotations

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.structures.parameters import check_values
from rockeom.structures.shipped.declarations import slender_block as declared
from rockeom.structures.shipped.rigid_block import inertia_hints


class SlenderBlock(declared.SlenderBlock):
    @classmethod
    def from_frequency(
        cls, p: float, alpha: float, mass: float = 1.0, gravity: float = STANDARD_GRAVITY
    ) -> SlenderBlock:
        """The rectangular block of frequency parameter p [rad/s] and angle alpha [rad]."""
        check_values("SlenderBlock", {"p": p, "alpha": alpha, "gravity": gravity})
        return cls(radius=0.75 * gravity / p**2, alpha=alpha, mass=mass, gravity=gravity)

    def hints(self) -> tuple[str, ...]:
        return (*super().hints(), *inertia_hints(self.mass, self.radius, self.inertia))

    def parameters(self) -> dict[str, float]:
        values = super().parameters()
        if self.inertia is None:
            values["inertia"] = self.mass * self.radius**2 / 3
        return values
