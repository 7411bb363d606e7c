"""Closed forms of the block that slides and bounces: those of the rigid one."""

from __future__ import annotations

from rockeom.structures.parameters import check_restitution
from rockeom.structures.shipped.declarations import sliding_block as declared
from rockeom.structures.shipped.rigid_block import RigidBlock


class SlidingBlock(declared.SlidingBlock, RigidBlock):
    def __post_init__(self) -> None:
        check_restitution("SlidingBlock", self.restitution)
