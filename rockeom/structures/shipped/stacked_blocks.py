"""Two blocks on one another, of the parameters of each or of two blocks."""

import functools
from typing import Any

from rockeom.codes import POISSON
from rockeom.integrator.texts import load_text, source
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.structures.parameters import check_contact_law
from rockeom.structures.shipped.declarations import stacked_blocks as declared
from rockeom.structures.shipped.rigid_block import RigidBlock
from rockeom.structures.supports import SupportedStructure

_OF_A_BLOCK = ("half_width", "half_height", "mass", "inertia")


class StackedBlocks(SupportedStructure, declared.StackedBlocks):
    def __post_init__(self) -> None:
        super().__post_init__()
        check_contact_law("StackedBlocks", self.restitution, "poisson")
        if self.support and self.restitution:
            raise InputError("restitution", of="StackedBlocks").wrong(
                "is given with a support: leave it out"
            )
        if self.upper_half_width > self.lower_half_width:
            raise InputError("upper_half_width", self.upper_half_width, "StackedBlocks").wrong(
                f"is {self.upper_half_width} and lower_half_width {self.lower_half_width}: corners "
                "that hang over are not modelled, give an upper block that is no wider"
            )

    @classmethod
    def complete(cls, values: dict[str, Any]) -> dict[str, Any]:
        """Arguments of the fields, each block in place of its parameters.

        Parameters
        ----------
        values : dict of str to object
            Arguments of the constructor by name, with ``lower`` and ``upper``.

        Returns
        -------
        dict of str to object
            Arguments of the fields by name.

        Raises
        ------
        TypeError
            For a ``lower`` or ``upper`` that is no block.
        ValueError
            For blocks under two gravities.
        InputTypeError
            For a block and its parameters at once.
        """
        given = dict(values)
        for name in ("lower", "upper"):
            if (block := given.pop(name, None)) is None:
                continue
            if type(block) is not RigidBlock:
                raise InputTypeError(name, block, "StackedBlocks").give("a RigidBlock")
            if given.setdefault("gravity", block.gravity) != block.gravity:
                raise InputError("gravity", given["gravity"], "StackedBlocks").wrong(
                    f"is {given['gravity']}, and {block.gravity} of the {name} block: give both "
                    "blocks the same"
                )
            parts = {f"{name}_{part}": getattr(block, part) for part in _OF_A_BLOCK}
            for part in parts.keys() & given.keys():
                raise InputTypeError(part, of="StackedBlocks").says(
                    f"{part} is given, and so is {name}: leave one out"
                )
            given |= parts
        return given

    def of_base(self) -> tuple[float, float]:
        return self.lower_mass, self.lower_mass * self.lower_half_height**2

    @functools.cached_property
    def module(self) -> Any:
        """The generated module, by Poisson's law where corners bounce and none slips."""
        made, name = super().module, f"{self.model}_by_poisson"
        if self.support or not self.restitution > 0:
            return made
        text = source(made).replace(f'\nNAME = "{self.model}"', f'\nNAME = "{name}"')
        text += f"\nIMPACT_LAW = {POISSON}\n\n\ndef point_numbers(p, out):\n    pass\n"
        return load_text(name, text)

    def _block(self, which: str) -> RigidBlock:
        parts = {part: getattr(self, f"{which}_{part}") for part in _OF_A_BLOCK}
        return RigidBlock(gravity=self.gravity, **parts)

    @property
    def lower(self) -> RigidBlock:
        """Lower block."""
        return self._block("lower")

    @property
    def upper(self) -> RigidBlock:
        """Upper block."""
        return self._block("upper")

    def parameters(self) -> dict[str, float]:
        blocks = {"lower": self.lower, "upper": self.upper}
        inertias = {f"{w}_inertia": block.parameters()["inertia"] for w, block in blocks.items()}
        return super().parameters() | inertias

    def hints(self) -> tuple[str, ...]:
        return (*self.lower.hints(), *self.upper.hints())
