"""Motions that several tests look at, each followed once."""

import math
from dataclasses import dataclass
from functools import cache, cached_property

from .reference import Block, Motion, follow

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
    return follow(leaning().at(theta=LEANING), 4.2, least_impact=1e-4)


@dataclass(frozen=True)
class Shaken:
    """A block under one sine across and one up; it starts at rest on both feet."""

    block: Block
    across: tuple[float, float]
    up: tuple[float, float]
    end: float

    def ground(self, t: float) -> tuple[float, float]:
        """Accelerations, each amplitude sin(2 pi t/period) up to its period."""
        across, up = (
            amplitude * math.sin(2 * math.pi * t / period) if t < period - 1e-13 else 0.0
            for amplitude, period in (self.across, self.up)
        )
        return across, up

    @cached_property
    def motion(self) -> Motion:
        breaks = self.across[1], self.up[1]
        return follow(self.block.at(), self.end, self.ground, breaks)


SHAKEN = {
    "rocks, slides and lands": Shaken(
        Block(0.3, 1.0, 0.35, mass=2.0), (6.0, 0.8), (4.0, 0.5), end=0.9
    ),
    "slides, flies, and bounces to its end": Shaken(
        Block(0.3, 0.6, 0.6, 0.4, mass=2.0, inertia=0.4), (14.0, 0.5), (-14.0, 0.4), end=0.9
    ),
}
