"""Closed forms of the block whose impacts are forces."""

from __future__ import annotations

from rockeom.structures.shipped.declarations import dirac_delta_block as declared


class DiracDeltaBlock(declared.DiracDeltaBlock):
    def __post_init__(self) -> None:
        if self.energy_ratio > 1:
            raise ValueError(
                f"DiracDeltaBlock: energy_ratio is {self.energy_ratio}: above 1 impacts would "
                "give energy"
            )
