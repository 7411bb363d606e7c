"""Two rectangular blocks on one another, by the reference: nothing slips, nothing bounces."""

import math
from dataclasses import dataclass

import numpy as np

from tests.mechanics import At, TwoBlocks, of_stack

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
    def mechanics(self) -> TwoBlocks:
        names = (f"{part}_{of}" for of in ("half_width", "half_height", "mass")
                 for part in ("lower", "upper"))  # fmt: skip
        sizes = self.b1, self.b2, self.h1, self.h2, self.m1, self.m2
        return of_stack({"restitution": 0.0, **dict(zip(names, sizes, strict=True))})

    def at(self, rotations, rates, feet) -> At:
        """Each block on its foot: -1 the left one, 1 the right one."""
        turned = rotations[0], rotations[1] - rotations[0]
        turns = rates[0], rates[1] - rates[0]
        q, v = [], []
        for b, foot, angle, rate, whole, whole_rate in zip(
            (self.b1, self.b2), feet, turned, turns, rotations, rates, strict=True
        ):
            c, s = math.cos(angle), math.sin(angle)
            q += [foot * b * (1.0 - c), foot * b * s, whole]
            v += [foot * b * s * rate, foot * b * c * rate, whole_rate]
        return self.mechanics.at(np.array([q]), np.array([v]))


def momentum(at: At, v: np.ndarray, about: tuple[float, float], blocks=(0, 1)) -> float:
    """Angular momentum about a point, clockwise, at other rates."""
    total = 0.0
    for i in blocks:
        body = at.parts.masses[i]
        (x, y), (u, w) = body.centre.value[0] - about, body.centre.jacobian[0] @ v
        total += body.mass * (y * u - x * w) + body.inertia * (body.turn @ v)
    return total


def lower_begins_to_rock(stack: Stack) -> bool:
    """Whether an upper block that lands on the resting lower one sets it rocking, by hand.

    The upper block turns over the new corner, h2 > b2/sqrt 2, and gives the lower one the impulses
    P down at b2 and 3 s c/(4 - 3 s^2) P sideways at the height 2 h1.
    """
    radius = math.hypot(stack.b2, stack.h2)
    s, c = stack.b2 / radius, stack.h2 / radius
    return stack.b1 - stack.b2 < 6 * s * c * stack.h1 / (4 - 3 * s * s)
