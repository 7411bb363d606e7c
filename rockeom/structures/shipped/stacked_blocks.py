"""Two blocks on one another, of the parameters of each or of two blocks."""

from __future__ import annotations

from typing import Any

from rockeom.numbers.checks import described
from rockeom.structures.parameters import ParameterError, check_restitution
from rockeom.structures.shipped.declarations import stacked_blocks as declared
from rockeom.structures.shipped.rigid_block import RigidBlock

_OF_A_BLOCK = ("half_width", "half_height", "mass", "inertia")


class StackedBlocks(declared.StackedBlocks):
    def __post_init__(self) -> None:
        check_restitution("StackedBlocks", self.restitution)
        if self.upper_half_width > self.lower_half_width:
            raise ValueError(
                f"StackedBlocks: upper_half_width is {self.upper_half_width} and lower_half_width "
                f"{self.lower_half_width}: corners that hang over are not modelled, give an upper "
                "block that is no wider"
            )

    @classmethod
    def complete(cls, values: dict[str, Any]) -> dict[str, Any]:
        """The arguments, each block that is given replaced by its parameters."""
        given = dict(values)
        for name in ("lower", "upper"):
            if (block := given.pop(name, None)) is None:
                continue
            if type(block) is not RigidBlock:
                raise TypeError(f"StackedBlocks: {name} is {described(block)}: give a RigidBlock")
            if given.setdefault("gravity", block.gravity) != block.gravity:
                raise ValueError(
                    f"StackedBlocks: gravity is {given['gravity']}, and {block.gravity} of the "
                    f"{name} block: give both blocks the same"
                )
            for part in _OF_A_BLOCK:
                if f"{name}_{part}" in given:
                    raise ParameterError(
                        f"StackedBlocks: {name}_{part} is given, and so is {name}: leave one out"
                    )
                given[f"{name}_{part}"] = getattr(block, part)
        return given

    def _block(self, which: str) -> RigidBlock:
        parts = {part: getattr(self, f"{which}_{part}") for part in _OF_A_BLOCK}
        return RigidBlock(gravity=self.gravity, **parts)

    @property
    def lower(self) -> RigidBlock:
        return self._block("lower")

    @property
    def upper(self) -> RigidBlock:
        return self._block("upper")

    def parameters(self) -> dict[str, float]:
        values = super().parameters()
        for which, block in (("lower", self.lower), ("upper", self.upper)):
            values[f"{which}_inertia"] = block.parameters()["inertia"]
        return values

    def hints(self) -> tuple[str, ...]:
        return (*self.lower.hints(), *self.upper.hints())
