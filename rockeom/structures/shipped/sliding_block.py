"""Closed forms of the block that slides and bounces: those of the rigid one."""

from rockeom.structures.shipped.declarations import sliding_block as declared
from rockeom.structures.shipped.rigid_block import RigidBlock


class SlidingBlock(declared.SlidingBlock, RigidBlock):
    pass
