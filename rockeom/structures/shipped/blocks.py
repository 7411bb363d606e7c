"""Closed forms that all blocks with their centroid above the middle of the base share."""

from typing import Any

from rockeom.numbers.functions import mathematics
from rockeom.structures.declared import StructureWithFields


class Block(StructureWithFields):
    """A block with a radius, alpha, mass, inertia and gravity: fields, or properties (`Any`)."""

    @property
    def R(self: Any) -> float:
        """`radius` [m], by the letter of formulas."""
        return self.radius

    @property
    def p(self: Any) -> float:
        """`frequency_parameter` [rad/s], by the letter of formulas."""
        return self.frequency_parameter

    @property
    def frequency_parameter(self: Any) -> float:
        """p = sqrt(m g R/I_o) [rad/s]."""
        pivot_inertia = self.parameters()["inertia"] + self.mass * self.radius**2
        return mathematics.sqrt(self.mass * self.gravity * self.radius / pivot_inertia)

    @property
    def has_overturning_angles(self) -> bool:
        return True

    @property
    def overturning_angles(self: Any) -> tuple[float, float]:
        """(left, right) rotations beyond which the block does not come back, alpha both [rad]."""
        return self.alpha, self.alpha

    def hints(self: Any) -> tuple[str, ...]:
        """Hints of all structures, and one at an inertia that no body within the block has.

        Returns
        -------
        tuple of str
            A sentence each.
        """
        most = self.mass * self.radius**2
        if self.inertia is None or self.inertia <= most * (1 + 1e-12):
            return super().hints()
        return (
            *super().hints(),
            f"inertia is {self.inertia:.4g} kg m2 about the centroid; a body of this size has at "
            f"most m R**2 = {most:.4g} kg m2, with all its mass at the corners.",
        )

    def parameters(self: Any) -> dict[str, float]:
        values = super().parameters()
        if self.inertia is None:
            values["inertia"] = self.mass * self.radius**2 / 3
        return values
