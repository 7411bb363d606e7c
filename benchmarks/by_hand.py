"""What heyoka and SciPy are given: the equations of motion, uplift and rest, typed by hand.

An arc starts AHEAD seconds after its impact, and an uplift with the rate CREEP: at a gap of zero
both libraries would find the event that is just over.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks import workloads as w

AHEAD = 1e-15  # [s]
CREEP = 1e-14  # [rad/s]

Law = tuple[float, float, float, float, float, float]
"""(start, end, kind, c0, c1, c2): a row of a motion's table; kind 0 is a line, 1 a sine."""


def laws(motion) -> list[Law]:
    return [tuple(row[:6]) for row in motion.segments.tolist()]


def acceleration(law: Law, t: float) -> float:
    """Of the ground, at t after the start of the law."""
    _, _, kind, c0, c1, c2 = law
    return c0 + c1 * t if kind == 0.0 else c0 * math.sin(c1 * t + c2)


@dataclass(frozen=True)
class Block:
    """theta'' = p^2 (sin(theta - s alpha) - a/g cos(theta - s alpha))."""

    p2: float
    alpha: float
    gravity: float
    ratio: float

    rate_at = 1

    @property
    def limit(self) -> float:
        """Acceleration of the ground that lifts it off a foot."""
        return self.gravity * math.tan(self.alpha)

    def rate(self, side, theta, a, sin: Callable, cos: Callable):
        """Of the rate of rotation; a None: of the ground at rest."""
        angle = theta - side * self.alpha
        pull = sin(angle)
        return self.p2 * (pull if a is None else pull - a / self.gravity * cos(angle))

    def closes(self, side: float, _, a: float) -> bool:
        """Whether the gap of a side closes from rest."""
        return side * a > -self.limit

    def uplift(self, law: Law, t: float) -> float:
        """First time from t on, after the start of the law, at which a foot lifts; may be inf."""
        _, _, kind, c0, c1, c2 = law
        limit = self.limit
        if abs(acceleration(law, t)) > limit:
            return t
        if kind == 0.0:
            return (math.copysign(limit, c1) - c0) / c1 if c1 else math.inf
        if abs(c0) <= limit:
            return math.inf
        reached = math.asin(limit / abs(c0))
        wait = (reached - c1 * t - c2) % math.pi
        return t + wait / c1


BLOCK = Block(
    w.BLOCK.frequency_parameter**2,
    w.BLOCK.alpha,
    w.GRAVITY,
    1.0 - 1.5 * math.sin(w.BLOCK.alpha) ** 2,
)
DRIVEN = Block(1.0, w.DRIVEN.alpha, 1.0, w.DRIVEN_RATIO)
"""The non-dimensional block, in theta rather than theta/alpha: the same motion."""


class Column:
    """Two masses in axes that turn with the base, as in benchmarks/c/flexible_structure.c.

    States: theta, u and their rates. In full contact u vibrates alone.
    """

    rate_at = 2

    def __init__(self) -> None:
        v = w.COLUMN.parameters()
        self.m, self.H, self.B, self.g = v["mass"], v["height"], v["half_width"], v["gravity"]
        self.m_b, H_b = v["base_mass"], v["base_height"]
        J = v["inertia"] + v["base_inertia"] + self.m_b * (H_b**2 + self.B**2)
        self.J, self.S = J, self.m * self.H + self.m_b * H_b
        self.k, self.c = v["stiffness"] / self.m, v["damping"] / self.m
        whole = J + self.m * self.H**2 - self.m_b * self.B**2
        weight = (self.m + self.m_b) * self.B**2
        self.ratio = (whole - weight) / (whole + weight)

    def rates(self, side, theta, u, theta_dot, u_dot, a, sin: Callable, cos: Callable):
        """(theta'', u'')."""
        m, g, sine, cosine = self.m, self.g, sin(theta), cos(theta)
        beside = u - side * self.B
        along, across = g * sine - a * cosine, g * cosine + a * sine
        F = beside * theta_dot * theta_dot + along - self.k * u - self.c * u_dot
        moment = (
            self.S * along
            + (m * beside - side * (self.m_b * self.B)) * across
            - 2.0 * m * beside * u_dot * theta_dot
            - m * self.H * F
        )
        theta_ddot = moment / (self.J + m * beside * beside)
        return theta_ddot, F - self.H * theta_ddot

    def upright(self, u, u_dot, a):
        """u'' in full contact."""
        return -a - self.k * u - self.c * u_dot

    def opening(self, side, u, u_dot, a):
        """A positive multiple of the acceleration with which a side opens from full contact."""
        offset = self.m * u - side * ((self.m + self.m_b) * self.B)
        at_rest = self.upright(u, u_dot, a)
        return side * (self.g * offset - self.S * a - self.m * self.H * at_rest)

    def closes(self, side: float, y, a: float) -> bool:
        return self.opening(side, y[1], y[3], a) < 0.0


COLUMN = Column()
