"""Motions that several tests look at, each followed once."""

import math
from functools import cache

from .reference import Block, Motion

P, ALPHA = 2.14, 0.25
LEANING = 0.2


@cache
def leaning(friction: float = 0.15) -> Block:
    """The block of p = 2.14 rad/s and alpha = 0.25, a rectangle."""
    radius = 3 * 9.81 / (4 * P * P)
    return Block(radius * math.sin(ALPHA), radius * math.cos(ALPHA), friction)


@cache
def leaning_motion() -> Motion:
    """Let go on its right foot, until its impacts are small."""
    block = leaning()
    return block.assembly.follow(*block.state(theta=LEANING), 4.2, least_impact=1e-4)
