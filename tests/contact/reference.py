"""Rigid bodies in a plane that stand, slide, rock, bounce and fly on points: small, slow and clear.

Written by hand from Newton's and Euler's equations about the mass centres, with all positions of
all bodies as coordinates and every contact force as an unknown. Which state follows is found by
trying every pattern of signs. It shares nothing with the package: another choice of coordinates,
NumPy's dense algebra, SciPy's integrator and its search for events.

A body's coordinates are x (right), y (up) of its mass centre and its rotation, clockwise. Its axes
are along = (cos, -sin) and across = (sin, cos) of the rotation.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp

OPEN, STICK, RIGHT, LEFT = "open", "stick", "right", "left"
"""What a point does: it is open, sticks, or slips to one side."""

SENSE = {RIGHT: 1.0, LEFT: -1.0}
ZERO = 1e-9


@dataclass(frozen=True)
class Body:
    mass: float
    inertia: float


@dataclass(frozen=True)
class Point:
    """A point of body `of`, at (along, across) from its mass centre, above a flat surface.

    on : the body that bears the surface, None for the ground. level : height of the surface above
    the ground's zero, or above the mass centre of the bearing body.
    """

    name: str
    of: int
    along: float
    across: float
    friction: float
    restitution: float = 0.0
    on: int | None = None
    level: float = 0.0


@dataclass(frozen=True)
class Candidate:
    """One pattern that meets every condition: what follows from it.

    motion : accelerations, or velocities after. normal, friction : forces, or impulses, of the
    points tried.
    """

    pattern: tuple[str, ...]
    motion: np.ndarray
    normal: np.ndarray
    friction: np.ndarray


@dataclass(frozen=True)
class Event:
    kind: str
    point: str
    time: float
    before: np.ndarray
    after: np.ndarray
    pattern_before: tuple[str, ...]
    pattern_after: tuple[str, ...]


class Undecided(Exception):
    """No candidate, or several that differ."""

    def __init__(self, found: list[Candidate]) -> None:
        super().__init__("several solutions" if found else "no solution")
        self.found = found


def axes(rotation: float) -> tuple[np.ndarray, np.ndarray]:
    c, s = math.cos(rotation), math.sin(rotation)
    return np.array([c, -s]), np.array([s, c])


@dataclass
class Assembly:
    bodies: Sequence[Body]
    points: Sequence[Point]
    gravity: float = 9.81
    mass: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        self.mass = np.diag([v for b in self.bodies for v in (b.mass, b.mass, b.inertia)])

    # -- kinematics -------------------------------------------------------------------------

    def seen(self, point: Point, q: np.ndarray, v: np.ndarray) -> "Seen":
        """A point as its surface sees it: place, rates, rows and biases.

        For the arm d from the surface's origin to the point, place = (d.along, d.across) of the
        surface's axes, which turn: along' = -w across, across' = w along.
        """
        k = 3 * point.of
        along, across = axes(q[k + 2])
        arm = point.along * along + point.across * across
        turned = -point.along * across + point.across * along  # d arm / d rotation
        d, rate = q[k : k + 2] + arm, v[k : k + 2] + turned * v[k + 2]
        bias = -arm * v[k + 2] ** 2
        jacobian = np.zeros((2, len(q)))
        jacobian[:, k : k + 2] = np.eye(2)
        jacobian[:, k + 2] = turned
        if point.on is None:
            return Seen(d[0], d[1] - point.level, rate, jacobian, bias)
        j = 3 * point.on
        a1, n1 = axes(q[j + 2])
        w = v[j + 2]
        d, rate = d - q[j : j + 2], rate - v[j : j + 2]
        jacobian[:, j : j + 2] = -np.eye(2)
        frame = np.array([a1, n1])
        rows = frame @ jacobian
        rows[0, j + 2] -= d @ n1
        rows[1, j + 2] += d @ a1
        biases = frame @ bias
        biases += [-2 * w * (rate @ n1) - w * w * (d @ a1), 2 * w * (rate @ a1) - w * w * (d @ n1)]
        return Seen(d @ a1, d @ n1 - point.level, rows @ v, rows, biases)

    def gaps(self, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Gaps, their rates and the slip rates of all points."""
        seen = [self.seen(p, q, v) for p in self.points]
        return (
            np.array([s.gap for s in seen]),
            np.array([s.rate[1] for s in seen]),
            np.array([s.rate[0] for s in seen]),
        )

    # -- the algebra of one pattern ---------------------------------------------------------

    def solve(
        self,
        tried: Sequence[int],
        pattern: Sequence[str],
        right: np.ndarray,
        rows: np.ndarray,
        known: np.ndarray,
    ) -> Candidate | None:
        """M z = right + J' forces with what the pattern prescribes; None if it contradicts itself.

        rows (points, 2, n) along and across; known (points, 2) what row . z must be where the
        pattern holds it. Of points of one body on one surface that stick only the sum of friction
        is determined; each then bears the same fraction of its normal force.
        """
        n, m = len(right), len(tried)
        closed = [i for i in range(m) if pattern[i] != OPEN]

        def solved(fraction: float | None) -> np.ndarray | None:
            size = n + 2 * m
            a, b = np.zeros((size, size)), np.zeros(size)
            a[:n, :n], b[:n] = self.mass, right
            for i in range(m):
                across, along = n + 2 * i, n + 2 * i + 1
                a[:n, across], a[:n, along] = -rows[i, 1], -rows[i, 0]
                mu = self.points[tried[i]].friction
                if pattern[i] == OPEN:
                    a[across, across] = a[along, along] = 1.0
                    continue
                a[across, :n], b[across] = rows[i, 1], known[i, 1]
                if pattern[i] == STICK:
                    a[along, :n], b[along] = rows[i, 0], known[i, 0]
                else:
                    a[along, along], a[along, across] = 1.0, SENSE[pattern[i]] * mu
            if fraction is not None:  # all but the first take their share
                for i in shared[1:]:
                    a[n + 2 * i + 1] = 0.0
                    b[n + 2 * i + 1] = 0.0
                    a[n + 2 * i + 1, n + 2 * i + 1] = 1.0
                    a[n + 2 * i + 1, n + 2 * i] = -fraction
                first = n + 2 * shared[0] + 1
                a[first] = 0.0
                b[first] = 0.0
                a[first, first], a[first, first - 1] = 1.0, -fraction
            z, _, rank, _ = np.linalg.lstsq(a, b, rcond=1e-12)
            scale = np.abs(a) @ np.abs(z) + np.abs(b)
            if np.any(np.abs(a @ z - b) > 1e-8 * scale.max()):
                return None
            return z

        z = solved(None)
        if z is None:
            return None
        groups: dict[tuple[int, int | None], list[int]] = {}
        for i in closed:
            if pattern[i] == STICK:
                p = self.points[tried[i]]
                groups.setdefault((p.of, p.on), []).append(i)
        for shared in groups.values():
            if len(shared) > 1:
                total = sum(z[n + 2 * i] for i in shared)
                friction = sum(z[n + 2 * i + 1] for i in shared)
                if total != 0.0:
                    again = solved(friction / total)
                    z = z if again is None else again
        forces = z[n:].reshape(m, 2)
        return Candidate(tuple(pattern), z[:n], forces[:, 0], forces[:, 1])

    def patterns(self, tried: Sequence[int]) -> list[tuple[str, ...]]:
        """All patterns in which points that share a surface and a body slip alike."""
        found = []
        for pattern in itertools.product((OPEN, STICK, RIGHT, LEFT), repeat=len(tried)):
            held: dict[tuple[int, int | None], set[str]] = {}
            for i, state in zip(tried, pattern, strict=True):
                if state != OPEN:
                    p = self.points[i]
                    held.setdefault((p.of, p.on), set()).add(state)
            if all(len(states) == 1 for states in held.values()):
                found.append(pattern)
        return found

    def bears(self, tried: Sequence[int], found: Candidate) -> bool:
        """Whether no point pulls, and those that stick need no more friction than there is."""
        scale = np.abs(found.normal).max(initial=0.0) + 1e-300
        if np.any(found.normal < -ZERO * scale):
            return False
        for i, state in enumerate(found.pattern):
            if state == STICK:
                need, mu = abs(found.friction[i]), self.points[tried[i]].friction
                if need > mu * found.normal[i] + ZERO * scale * max(1.0, mu):
                    return False
        return True

    # -- what follows: forces ---------------------------------------------------------------

    def forces(
        self, q: np.ndarray, v: np.ndarray, pattern: Sequence[str], ground: Sequence[float]
    ) -> Candidate | None:
        """Accelerations and contact forces of all points in a pattern, signs not asked for."""
        everything = range(len(self.points))
        seen = [self.seen(self.points[i], q, v) for i in everything]
        rows = np.array([s.rows for s in seen])
        known = -np.array([s.bias for s in seen])
        pull = np.tile([-ground[0], -ground[1] - self.gravity, 0.0], len(self.bodies))
        return self.solve(everything, pattern, self.mass @ pull, rows, known)

    def motions(
        self, q: np.ndarray, v: np.ndarray, ground: Sequence[float] = (0.0, 0.0)
    ) -> list[Candidate]:
        """All patterns that can follow at this state: the algebraic problem of accelerations."""
        gap, rate, slip = self.gaps(q, v)
        touching = [i for i in range(len(gap)) if abs(gap[i]) < ZERO and abs(rate[i]) < ZERO]
        found = []
        for part in self.patterns(touching):
            pattern = [OPEN] * len(gap)
            for i, state in zip(touching, part, strict=True):
                pattern[i] = state
            if any(
                (state == STICK and abs(slip[i]) > ZERO)
                or (state in SENSE and SENSE[state] * slip[i] < -ZERO)
                for i, state in zip(touching, part, strict=True)
            ):
                continue
            candidate = self.forces(q, v, pattern, ground)
            if candidate is None or not self.bears(range(len(gap)), candidate):
                continue
            small = ZERO * max(1.0, np.abs(candidate.motion).max())
            fits = True
            for i, state in zip(touching, part, strict=True):
                s = self.seen(self.points[i], q, v)
                along, across = s.rows @ candidate.motion + s.bias
                fits &= state != OPEN or across >= -small
                if state in SENSE and abs(slip[i]) < ZERO:
                    fits &= SENSE[state] * along >= -small
            if fits:
                found.append(candidate)
        return found

    # -- what follows: impulses -------------------------------------------------------------

    def impulses(self, q: np.ndarray, v: np.ndarray) -> list[Candidate]:
        """All patterns after an impact of the points that touch: the algebraic law."""
        gap, rate, _ = self.gaps(q, v)
        touching = [i for i in range(len(gap)) if abs(gap[i]) < ZERO and rate[i] < ZERO]
        seen = [self.seen(self.points[i], q, v) for i in touching]
        rows = np.array([s.rows for s in seen])
        back = np.array(
            [
                -self.points[i].restitution * min(s.rate[1], 0.0)
                for i, s in zip(touching, seen, strict=True)
            ]
        )
        known = np.column_stack([np.zeros(len(seen)), back])
        found = []
        for pattern in self.patterns(touching):
            candidate = self.solve(touching, pattern, self.mass @ v, rows, known)
            if candidate is None or not self.bears(touching, candidate):
                continue
            small = 1e-12 * max(1.0, np.abs(v).max())
            fits = True
            for row, state, least in zip(rows, pattern, back, strict=True):
                along, across = row @ candidate.motion
                fits &= state != OPEN or across >= least - small
                fits &= state not in SENSE or SENSE[state] * along >= -small
            if fits:
                found.append(candidate)
        return found

    # -- a motion ---------------------------------------------------------------------------

    def follow(
        self,
        q: np.ndarray,
        v: np.ndarray,
        end: float,
        ground: Callable[[float], Sequence[float]] = lambda t: (0.0, 0.0),
        max_step: float = 0.02,
        least_impact: float = 1e-5,
        until: Callable[[float, np.ndarray], float] | None = None,
    ) -> "Motion":
        """The motion from a state, by one integration after the other, each up to an event."""
        t, y, n = 0.0, np.concatenate([q, v]), len(q)
        events: list[Event] = []
        spans = []
        pattern: tuple[str, ...] | None = None
        while t < end:
            pattern_before, before = pattern, y.copy()
            if pattern is None:
                pattern_before = ("",) * len(self.points)
            gap, rate, _ = self.gaps(y[:n], y[n:])
            landing = [
                i
                for i in range(len(gap))
                if abs(gap[i]) < ZERO and rate[i] < -ZERO
            ]
            if landing:
                y = np.concatenate([y[:n], one(self.impulses(y[:n], y[n:])).motion])
                if max(abs(rate[i]) for i in landing) < least_impact:
                    break
            pattern = self.choose(y, pattern, ground(t))
            events += self.noted(t, pattern_before, pattern, landing, before, y)

            span = self.within(t, y, end, pattern, ground, max_step)
            spans.append((pattern, span))
            t, y = span.t[-1], span.y[:, -1].copy()
        return Motion(self, t, y, events, spans)

    def choose(
        self, y: np.ndarray, old: tuple[str, ...] | None, ground: Sequence[float]
    ) -> tuple[str, ...]:
        """The pattern that follows; of those with equal accelerations not the one that ended."""
        n = len(y) // 2
        found = self.motions(y[:n], y[n:], ground)
        first = one(found)
        others = [c for c in found if c.pattern != old]
        return (others or [first])[0].pattern

    def noted(self, t, old, new, landing, before, after) -> list[Event]:
        found = []
        for i, point in enumerate(self.points):
            kinds = []
            if i in landing:
                kinds.append("landing")
            elif old[i] not in (OPEN, "") and new[i] == OPEN:
                kinds.append("lifting")
            if old[i] in SENSE and new[i] == STICK:
                kinds.append("slip ends")
            if old[i] == STICK and new[i] in SENSE:
                kinds.append("slip begins")
            found += [
                Event(kind, point.name, t, before, after, tuple(old), tuple(new))
                for kind in kinds
            ]
        return found

    def within(self, t, y, end, pattern, ground, max_step):
        """Integrate a pattern until it ends."""
        n = len(y) // 2

        def rates(time, state):
            found = self.forces(state[:n], state[n:], pattern, ground(time))
            return np.concatenate([state[n:], found.motion])

        watched = []
        for i, state in enumerate(pattern):
            if state == OPEN:
                watched.append(lambda t, y, i=i: self.seen(self.points[i], y[:n], y[n:]).gap)
                continue
            watched.append(
                lambda t, y, i=i: self.forces(y[:n], y[n:], pattern, ground(t)).normal[i]
            )
            if state == STICK:
                for sign in (1.0, -1.0):

                    def spare(t, y, i=i, sign=sign):
                        f = self.forces(y[:n], y[n:], pattern, ground(t))
                        return self.points[i].friction * f.normal[i] - sign * f.friction[i]

                    watched.append(spare)
            else:
                watched.append(
                    lambda t, y, i=i, sign=SENSE[state]: sign
                    * self.seen(self.points[i], y[:n], y[n:]).rate[0]
                )
        for g in watched:
            g.terminal, g.direction = True, -1
        # a point that has just lifted must be seen above its surface before it comes back
        gap, rate, _ = self.gaps(y[:n], y[n:])
        leaving = rate[(np.abs(gap) < ZERO) & (rate > ZERO)]
        first = min([0.1 * max_step, end - t, *(0.2 * leaving / self.gravity)])
        span = solve_ivp(
            rates, (t, end), y, method="DOP853", rtol=3e-14, atol=1e-15, max_step=max_step,
            first_step=first, events=watched, dense_output=True,
        )  # fmt: skip
        return span


@dataclass(frozen=True)
class Seen:
    """A point as its surface sees it; rate, rows and bias: along, across."""

    along: float
    gap: float
    rate: np.ndarray
    rows: np.ndarray
    bias: np.ndarray


@dataclass(frozen=True)
class Motion:
    assembly: Assembly
    time: float
    end: np.ndarray
    events: list[Event]
    spans: list

    def at(self, t: float) -> np.ndarray:
        for _, span in self.spans:
            if span.t[0] <= t <= span.t[-1]:
                return span.sol(t)
        raise ValueError(f"{t} is not within the motion")


def one(found: list[Candidate]) -> Candidate:
    """The one solution; those with equal motions count as one. Raises Undecided."""
    if not found:
        raise Undecided(found)
    first = found[0].motion
    near = 1e-7 * max(1.0, np.abs(first).max())
    if any(np.abs(c.motion - first).max() > near for c in found):
        raise Undecided(found)
    return found[0]


# -- a rectangular block on two feet --------------------------------------------------------


@dataclass(frozen=True)
class Block:
    """A block by half-width b and half-height h; a state is of the base's centre, as the package's.

    mass 1 and inertia of a rectangle if not given.
    """

    b: float
    h: float
    friction: float
    restitution: float = 0.0
    gravity: float = 9.81
    mass: float = 1.0
    inertia: float | None = None

    @property
    def about_centre(self) -> float:
        if self.inertia is not None:
            return self.inertia
        return self.mass * (self.b**2 + self.h**2) / 3.0

    @property
    def assembly(self) -> Assembly:
        feet = [
            Point("left", 0, -self.b, -self.h, self.friction, self.restitution),
            Point("right", 0, self.b, -self.h, self.friction, self.restitution),
        ]
        return Assembly([Body(self.mass, self.about_centre)], feet, self.gravity)

    def state(self, x=0.0, y=None, theta=0.0, x_dot=None, y_dot=None, theta_dot=0.0):
        """(q, v) of the mass centre. What is not given: the lowest foot touches, and sticks."""
        c, s = math.cos(theta), math.sin(theta)
        side = 0.0 if theta == 0.0 and theta_dot == 0.0 else math.copysign(1.0, theta or theta_dot)
        y = self.b * abs(s) if y is None else y
        # the foot at (side b) along the base: x + side b cos, y - side b sin
        x_dot = side * self.b * s * theta_dot if x_dot is None else x_dot
        y_dot = side * self.b * c * theta_dot if y_dot is None else y_dot
        q = np.array([x + self.h * s, y + self.h * c, theta])
        v = np.array([x_dot + self.h * c * theta_dot, y_dot - self.h * s * theta_dot, theta_dot])
        return q, v

    def base(self, state: np.ndarray) -> dict[str, float]:
        """x, y, theta of the base's centre and their rates from (q, v) of the mass centre."""
        x, y, theta, u, w, rate = state
        c, s = math.cos(theta), math.sin(theta)
        h = self.h
        values = x - h * s, y - h * c, theta, u - h * c * rate, w + h * s * rate, rate
        names = "x", "y", "theta", "x_dot", "y_dot", "theta_dot"
        return dict(zip(names, values, strict=True))

    def kinetic(self, base: dict[str, float]) -> float:
        """Kinetic energy of a state of the base's centre."""
        c, s, rate = math.cos(base["theta"]), math.sin(base["theta"]), base["theta_dot"]
        u, w = base["x_dot"] + self.h * c * rate, base["y_dot"] - self.h * s * rate
        return 0.5 * self.mass * (u * u + w * w) + 0.5 * self.about_centre * rate**2
