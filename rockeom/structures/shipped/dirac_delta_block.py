"""Closed forms of the block whose impacts are forces."""

from rockeom.numbers.checks import InputError
from rockeom.structures.shipped.declarations import dirac_delta_block as declared


class DiracDeltaBlock(declared.DiracDeltaBlock):
    def __post_init__(self) -> None:
        if self.energy_ratio > 1:
            raise InputError("energy_ratio", self.energy_ratio, "DiracDeltaBlock").so(
                "above 1 impacts would give energy"
            )
