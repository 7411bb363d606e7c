"""Two rectangular blocks on one another, by the reference: nothing slips, nothing bounces."""

import math
from dataclasses import dataclass

import numpy as np

from .reference import Assembly, Body, Point

LOWER_LEFT, LOWER_RIGHT, UPPER_LEFT, UPPER_RIGHT = range(4)


@dataclass(frozen=True)
class Stack:
    """Half-dimensions of the lower block (1) and of the upper one (2), b2 <= b1, and masses."""

    b1: float
    h1: float
    b2: float
    h2: float
    m1: float
    m2: float

    @property
    def assembly(self) -> Assembly:
        b, h, free = (self.b1, self.b2), (self.h1, self.h2), math.inf
        bodies = [
            Body(m, m * (b[i] ** 2 + h[i] ** 2) / 3) for i, m in enumerate((self.m1, self.m2))
        ]
        points = [
            Point("left", 0, -b[0], -h[0], free),
            Point("right", 0, b[0], -h[0], free),
            Point("upper left", 1, -b[1], -h[1], free, on=0, level=h[0]),
            Point("upper right", 1, b[1], -h[1], free, on=0, level=h[0]),
        ]
        return Assembly(bodies, points)

    def state(self, rotations, rates, feet) -> tuple[np.ndarray, np.ndarray]:
        """(q, v) of both mass centres, each block on its foot: -1 the left one, 1 the right one."""
        place, moves = np.array([feet[0] * self.b1, 0.0]), np.zeros(2)
        q, v = [], []
        for block, (b, h) in enumerate(((self.b1, self.h1), (self.b2, self.h2))):
            c, s, rate = math.cos(rotations[block]), math.sin(rotations[block]), rates[block]
            along, across = np.array([c, -s]), np.array([s, c])
            if block == 1:  # from the lower block's mass centre to the upper's foot
                place = place + feet[1] * b * along + self.h1 * across
                moves = moves + (-feet[1] * b * across + self.h1 * along) * rates[0]
            place = place - feet[block] * b * along + h * across
            moves = moves + (feet[block] * b * across + h * along) * rate
            q += [*place, rotations[block]]
            v += [*moves, rate]
        return np.array(q), np.array(v)

    def momentum(self, q, v, about, blocks=(0, 1)) -> float:
        """Angular momentum about a point, clockwise."""
        bodies, found = self.assembly.bodies, 0.0
        for i in blocks:
            x, y = q[3 * i : 3 * i + 2] - about
            u, w, rate = v[3 * i : 3 * i + 3]
            found += bodies[i].mass * (y * u - x * w) + bodies[i].inertia * rate
        return found

    def foot(self, q, point) -> np.ndarray:
        """Where a foot is."""
        p = self.assembly.points[point]
        x, y, rotation = q[3 * p.of : 3 * p.of + 3]
        c, s = math.cos(rotation), math.sin(rotation)
        return np.array([x + p.along * c + p.across * s, y - p.along * s + p.across * c])


def lower_begins_to_rock(stack: Stack) -> bool:
    """Whether an upper block that lands on the resting lower one sets it rocking, by hand.

    The upper block turns over the new corner, h2 > b2/sqrt 2, and gives the lower one the impulses
    P down at b2 and 3 s c/(4 - 3 s^2) P sideways at the height 2 h1.
    """
    radius = math.hypot(stack.b2, stack.h2)
    s, c = stack.b2 / radius, stack.h2 / radius
    return stack.b1 - stack.b2 < 6 * s * c * stack.h1 / (4 - 3 * s * s)
