"""Closed forms of the block with its centroid off the middle of the base."""

from rockeom.numbers.checks import InputError
from rockeom.numbers.functions import mathematics
from rockeom.structures.shipped.declarations import offset_block as declared


class OffsetBlock(declared.OffsetBlock):
    full_height: float | None = None

    def __post_init__(self) -> None:
        if not -self.half_width < self.offset < self.half_width:
            raise InputError("offset", self.offset, "OffsetBlock").wrong(
                f"is {self.offset} and half_width {self.half_width}: the centroid is not above the "
                "base, and the block falls over at rest; give the distance of the centroid from "
                "the middle of the base [m], positive to the right"
            )

    @property
    def _arms(self) -> tuple[float, float]:
        """Horizontal distances of the centroid from the left foot and from the right one [m]."""
        return self.half_width + self.offset, self.half_width - self.offset

    @property
    def overturning_angles(self) -> tuple[float, float]:
        """Angles (left, right) of the lines from the feet to the centroid, from the vertical [rad].

        The block that leans to the left by more than the first does not come back by itself.
        """
        left, right = (mathematics.atan2(arm, self.half_height) for arm in self._arms)
        return left, right

    @property
    def frequency_parameters(self) -> tuple[float, float]:
        """(left, right) p = sqrt(m g R/I_o) of rocking about each foot [rad/s]."""
        inertia = self.parameters()["inertia"]

        def about(arm: float) -> float:
            radius = mathematics.hypot(arm, self.half_height)
            moment = self.mass * self.gravity * radius
            return mathematics.sqrt(moment / (inertia + self.mass * radius**2))

        left, right = (about(arm) for arm in self._arms)
        return left, right

    def parameters(self) -> dict[str, float]:
        values = super().parameters()
        if self.inertia is None:
            values["inertia"] = self.mass * (self.half_width**2 + self.half_height**2) / 3
        return values
