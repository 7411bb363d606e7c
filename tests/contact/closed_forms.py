"""What is known by hand of a block of half-dimensions b and h, a rectangle, on two feet.

a : acceleration of the ground to the right, g : gravity with that of the ground upwards, mu :
friction, e : restitution of a foot. At rest on both feet, if nothing else is said.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Start:
    """Accelerations of the base's centre and of the rotation, and what the ground gives."""

    motion: str
    x: float
    y: float
    theta: float
    normal: float
    friction: float


def critical_friction(a: float, g: float, b: float, h: float) -> float:
    """From this on a block that lifts does not slide."""
    return (a * (4 * b * b + h * h) + 3 * g * b * h) / (g * (4 * h * h + b * b) + 3 * a * b * h)


def painleve_friction(b: float, h: float) -> float:
    """Above this a foot that slides ahead of the mass pushes itself into the ground."""
    return (4 * b * b + h * h) / (3 * b * h)


def start(a: float, g: float, b: float, h: float, mu: float) -> Start:
    """What a block of mass 1 at rest does when the ground begins to move to the right, a >= 0."""
    square = b * b + h * h  # R squared; the inertia about the mass centre is a third of it
    if a <= g * min(mu, b / h):
        return Start("rest", 0.0, 0.0, 0.0, g, a)
    if mu <= b / h:
        return Start("slide", mu * g - a, 0.0, 0.0, g, mu * g)
    if mu < critical_friction(a, g, b, h):
        normal = g * square / (4 * b * b + h * h - 3 * mu * b * h)
        theta = 3 * normal * (b - mu * h) / square
        return Start(
            "slide-rock", mu * normal - a - h * theta, -b * theta, theta, normal, mu * normal
        )
    theta = -0.75 * (a * h - g * b) / square
    return Start("rock", 0.0, -b * theta, theta, g - b * theta, a + h * theta)


def sticking_friction(alpha: float) -> float:
    """A corner that lands sticks with at least this, where the old one stuck until then."""
    s, c = math.sin(alpha), math.cos(alpha)
    return 3 * s * c / (4 - 3 * s * s)


def landing_ratio(alpha: float, mu: float, e: float) -> float:
    """Rate of rotation after over before a corner's landing, the old corner stuck until then."""
    s, c = math.sin(alpha), math.cos(alpha)
    if mu >= sticking_friction(alpha):
        return 1 - 1.5 * (1 + e) * s * s
    return (1 - 3 * (1 + 2 * e) * s * (s - mu * c)) / (1 + 3 * s * (s - mu * c))
