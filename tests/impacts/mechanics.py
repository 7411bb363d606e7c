"""An impact of rigid bodies on several points of contact, as data, and the velocities after it.

    M (v+ - v-) = N^T P + T^T Q,    u = N v,    s = T v

u : rates of the gaps, positive where they open; s : rates of slip; P >= 0 and Q : impulses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Impact:
    """Bodies just before an impact: n velocities, m closed contacts, g rates of slip.

    mass (n, n), velocity (n,), normal (m, n), slip (g, n), friction (m,) with inf for contacts that
    never slip, restitution (m,), stiffness (m,) of which only ratios count, and slips_with (m,):
    the slip of each contact. Contacts of one slip, such as the level feet of a block, share their
    friction: their sum alone is determined.
    """

    mass: np.ndarray
    velocity: np.ndarray
    normal: np.ndarray
    slip: np.ndarray
    friction: np.ndarray
    restitution: np.ndarray
    stiffness: np.ndarray
    slips_with: tuple[int, ...]

    @property
    def delassus(self) -> np.ndarray:
        """G (m + g, m + g): changes of (u, s) by unit impulses (P, Q)."""
        rows = np.vstack([self.normal, self.slip])
        return rows @ np.linalg.solve(self.mass, rows.T)

    @property
    def rates(self) -> np.ndarray:
        """(u, s) before the impact."""
        return np.concatenate([self.normal @ self.velocity, self.slip @ self.velocity])

    def after(self, impulses: np.ndarray) -> np.ndarray:
        """Velocities after impulses (P, Q)."""
        rows = np.vstack([self.normal, self.slip])
        return self.velocity + np.linalg.solve(self.mass, rows.T @ impulses)

    def gain(self, after: np.ndarray) -> float:
        """Kinetic energy after less that before, over that before."""
        before = self.velocity @ self.mass @ self.velocity
        return float((after @ self.mass @ after - before) / before)

    def with_velocity(self, velocity: Any) -> Impact:
        """The same bodies with other velocities before."""
        return replace(self, velocity=np.asarray(velocity, float))

    def with_(self, **changed: Any) -> Impact:
        """The same bodies with other numbers for all contacts."""
        m = len(self.normal)
        return replace(self, **{
            name: np.broadcast_to(np.asarray(value, float), (m,)) for name, value in changed.items()
        })  # fmt: skip


def impact(
    mass: Any, velocity: Any, normal: Any, slip: Any = None, friction: Any = 0.0,
    restitution: Any = 0.0, stiffness: Any = 1.0, slips_with: Any = None,
) -> Impact:  # fmt: skip
    """An impact; numbers for one contact are those of all, and each contact has its own slip."""
    normal = np.atleast_2d(np.asarray(normal, float))
    m, n = normal.shape
    rows = np.zeros((0, n)) if slip is None else np.atleast_2d(np.asarray(slip, float))
    if slip is None:  # smooth contacts: slips that do nothing
        rows, slips_with = np.zeros((1, n)), (0,) * m
    of_contacts = [
        np.broadcast_to(np.asarray(x, float), (m,)) for x in (friction, restitution, stiffness)
    ]
    with_ = tuple(range(m)) if slips_with is None else tuple(slips_with)
    return Impact(
        np.asarray(mass, float), np.asarray(velocity, float), normal, rows, *of_contacts, with_
    )


# --- the bodies of these tests


def block(
    half_width: float, half_height: float, velocity: Any, tilt: float = 0.0, mass: float = 1.0,
    inertia: float | None = None, **contacts: Any,
) -> Impact:  # fmt: skip
    """A block whose corners of the base both touch level ground: left, then right.

    velocity : (x, y) of the mass centre and the angular velocity, clockwise. A clockwise rotation
    presses the right corner and lifts the left one.
    """
    b, h = half_width, half_height
    if inertia is None:
        inertia = mass * (b * b + h * h) / 3
    assert tilt == 0.0
    return impact(
        np.diag([mass, mass, inertia]), velocity, [[0, 1, b], [0, 1, -b]], [[1, 0, -h]],
        slips_with=(0, 0), **contacts,
    )  # fmt: skip


def landing(half_width: float, half_height: float, theta_dot: float, **contacts: Any) -> Impact:
    """The block that has turned about a corner, which is still closed, and lands on the other.

    theta_dot < 0 : counterclockwise about the right corner, onto the left one, which is new.
    """
    b, h = half_width, half_height
    pivot = math.copysign(b, -theta_dot)
    return block(b, h, [h * theta_dot, pivot * theta_dot, theta_dot], **contacts)


def corner(
    half_width: float, half_height: float, angle: float, velocity: Any, **contacts: Any
) -> Impact:
    """A block, turned clockwise by an angle, whose right corner alone touches the ground."""
    b, h = half_width, half_height
    c, s = math.cos(angle), math.sin(angle)
    arm = np.array([b * c - h * s, -b * s - h * c])  # from the mass centre to the corner
    return impact(
        np.diag([1.0, 1.0, (b * b + h * h) / 3]), velocity, [[0, 1, -arm[0]]], [[1, 0, arm[1]]],
        **contacts,
    )  # fmt: skip


def balls(masses: Any, velocity: Any, **contacts: Any) -> Impact:
    """Balls in a row that touch their neighbours."""
    n = len(masses)
    rows = np.zeros((n - 1, n))
    for i in range(n - 1):
        rows[i, i : i + 2] = -1, 1
    return impact(np.diag(masses), velocity, rows, **contacts)
