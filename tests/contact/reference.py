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
from typing import Any

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


class UndecidedError(Exception):
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
        a, b = np.zeros((n + 2 * m, n + 2 * m)), np.zeros(n + 2 * m)
        a[:n, :n], b[:n] = self.mass, right
        for i, state in enumerate(pattern):
            along, across = n + 2 * i, n + 2 * i + 1
            a[:n, along], a[:n, across] = -rows[i, 0], -rows[i, 1]
            if state == OPEN:
                a[along, along] = a[across, across] = 1.0
                continue
            a[across, :n], b[across] = rows[i, 1], known[i, 1]
            if state == STICK:
                a[along, :n], b[along] = rows[i, 0], known[i, 0]
            else:
                a[along, along] = 1.0
                a[along, across] = SENSE[state] * self.points[tried[i]].friction
        z = solved(a, b)
        if z is None:
            return None
        for together in self.sticking_together(tried, pattern):
            along = [n + 2 * i for i in together]
            pressed = sum(z[k + 1] for k in along)
            if pressed != 0.0:
                fraction = sum(z[k] for k in along) / pressed
                for k in along:
                    a[k], b[k] = 0.0, 0.0
                    a[k, k], a[k, k + 1] = 1.0, -fraction
                again = solved(a, b)
                z = z if again is None else again
        forces = z[n:].reshape(m, 2)
        forces[[state == OPEN for state in pattern]] = 0.0  # to the last bit
        return Candidate(tuple(pattern), z[:n], forces[:, 1], forces[:, 0])

    def sticking_together(self, tried: Sequence[int], pattern: Sequence[str]) -> list[list[int]]:
        """Places in `tried` of points of one body that stick to one surface, where several do."""
        groups: dict[tuple[int, int | None], list[int]] = {}
        for i, state in enumerate(pattern):
            if state == STICK:
                groups.setdefault(self.pair(tried[i]), []).append(i)
        return [group for group in groups.values() if len(group) > 1]

    def pair(self, i: int) -> tuple[int, int | None]:
        return self.points[i].of, self.points[i].on

    def patterns(self, tried: Sequence[int]) -> list[tuple[str, ...]]:
        """All patterns in which points of one body on one surface slip alike."""
        states = [
            (OPEN, STICK) + (RIGHT, LEFT) * math.isfinite(self.points[i].friction) for i in tried
        ]
        found = []
        for pattern in itertools.product(*states):
            held: dict[tuple[int, int | None], set[str]] = {}
            for i, state in zip(tried, pattern, strict=True):
                if state != OPEN:
                    held.setdefault(self.pair(i), set()).add(state)
            if all(len(alike) == 1 for alike in held.values()):
                found.append(pattern)
        return found

    def bears(self, tried: Sequence[int], found: Candidate) -> bool:
        """Whether no point pulls, and those that stick need no more friction than there is."""
        scale = np.abs(found.normal).max(initial=0.0) + 1e-300
        if np.any(found.normal < -ZERO * scale):
            return False
        return all(
            state != STICK
            or math.isinf(self.points[i].friction)
            or abs(along) <= self.points[i].friction * (across + ZERO * scale) + ZERO * scale
            for i, state, along, across in zip(
                tried, found.pattern, found.friction, found.normal, strict=True
            )
        )

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
        seen = [self.seen(p, q, v) for p in self.points]
        touching = [i for i, s in enumerate(seen) if abs(s.gap) < ZERO and abs(s.rate[1]) < ZERO]
        found = []
        for part in self.patterns(touching):
            states = dict(zip(touching, part, strict=True))
            if not all(agrees(state, seen[i].rate[0]) for i, state in states.items()):
                continue
            pattern = [states.get(i, OPEN) for i in range(len(seen))]
            candidate = self.forces(q, v, pattern, ground)
            if candidate is None or not self.bears(range(len(seen)), candidate):
                continue
            small = ZERO * max(1.0, np.abs(candidate.motion).max())
            if all(
                follows(
                    state,
                    seen[i].rows @ candidate.motion + seen[i].bias,
                    0.0,
                    small,
                    sliding=abs(seen[i].rate[0]) > ZERO,
                )
                for i, state in states.items()
            ):
                found.append(candidate)
        return found

    # -- what follows: impulses -------------------------------------------------------------

    def impulses(self, q: np.ndarray, v: np.ndarray, bounces: bool = True) -> list[Candidate]:
        """All patterns after an impact of the points that touch: the algebraic law.

        bounces : False takes the restitution for 0.
        """
        everything = [self.seen(p, q, v) for p in self.points]
        touching = [i for i, s in enumerate(everything) if abs(s.gap) < ZERO]
        seen = [everything[i] for i in touching]
        rows = np.array([s.rows for s in seen])
        least = np.array(
            [
                -self.points[i].restitution * min(s.rate[1], 0.0) * bounces
                for i, s in zip(touching, seen, strict=True)
            ]
        )
        known = np.column_stack([np.zeros(len(seen)), least])
        small = 1e-12 * max(1.0, np.abs(v).max())
        found = []
        for pattern in self.patterns(touching):
            candidate = self.solve(touching, pattern, self.mass @ v, rows, known)
            if candidate is None or not self.bears(touching, candidate):
                continue
            after = rows @ candidate.motion
            if all(follows(*what, small) for what in zip(pattern, after, least, strict=True)):
                found.append(candidate)
        return found

    # -- a motion ---------------------------------------------------------------------------

    def follow(
        self,
        q: np.ndarray,
        v: np.ndarray,
        end: float,
        ground: Callable[[float], Sequence[float]] = lambda t: (0.0, 0.0),
        breaks: Sequence[float] = (),
        max_step: float = 0.05,
        least_impact: float = 1e-5,
    ) -> "Motion":
        """The motion from a state, by one integration after the other, each up to an event.

        ground : both accelerations at a time; breaks : times at which they are not smooth.
        Where infinitely many impacts follow, those slower than `least_impact` do not bounce, and
        end the motion if none would.
        """
        t, y, n = 0.0, np.concatenate([q, v]), len(q)
        motion = Motion()
        pattern = ("",) * len(self.points)
        while t < end:
            before = y.copy()
            gap, rate, _ = self.gaps(y[:n], y[n:])
            landing = np.flatnonzero((np.abs(gap) < ZERO) & (rate < -ZERO))
            if len(landing):
                slow = np.abs(rate[landing]).max() < least_impact
                if slow and not any(self.points[i].restitution for i in landing):
                    break
                after = one(self.impulses(y[:n], y[n:], bounces=not slow)).motion
                y = np.concatenate([y[:n], after])
            old, pattern = pattern, self.choose(y, pattern, ground(t))
            motion.events += self.noted(t, old, pattern, landing, before, y)
            stop = min([end, *(b for b in breaks if b > t + 1e-12)])
            span = self.within(t, y, stop, pattern, ground, max_step)
            motion.spans.append((pattern, span))
            t, y = span.t[-1], span.y[:, -1].copy()
        motion.time, motion.end = t, y
        return motion

    def choose(self, y: np.ndarray, old: Sequence[str], ground: Sequence[float]) -> tuple[str, ...]:
        """The pattern that follows; of those with equal accelerations not the one that ended."""
        n = len(y) // 2
        found = self.motions(y[:n], y[n:], ground)
        first = one(found)
        others = [c for c in found if c.pattern != tuple(old)]
        return (others or [first])[0].pattern

    def noted(
        self,
        t: float,
        old: tuple[str, ...],
        new: tuple[str, ...],
        landing: Sequence[int],
        before: np.ndarray,
        after: np.ndarray,
    ) -> list[Event]:
        """What happened at which point; nothing at the start."""
        found = []
        for i, point in enumerate(self.points):
            was, is_ = old[i], new[i]
            happened = {
                "landing": i in landing,
                "lifting": was not in ("", OPEN) and is_ == OPEN and i not in landing,
                "slip begins": was == STICK and is_ in SENSE,
                "slip ends": was in SENSE and is_ == STICK,
            }
            found += [
                Event(kind, point.name, t, before, after, old, new)
                for kind, did in happened.items()
                if did
            ]
        return found

    def within(
        self,
        t: float,
        y: np.ndarray,
        end: float,
        pattern: tuple[str, ...],
        ground: Callable[[float], Sequence[float]],
        max_step: float,
    ) -> Any:
        """Integrate a pattern until it ends."""
        n = len(y) // 2

        def forces(time: float, state: np.ndarray) -> Candidate:
            found = self.forces(state[:n], state[n:], pattern, ground(time))
            assert found is not None
            return found

        def watch(i: int, sign: float, what: str) -> Callable[[float, np.ndarray], float]:
            point = self.points[i]

            def margin(time: float, state: np.ndarray) -> float:
                if what == "gap":
                    return self.seen(point, state[:n], state[n:]).gap
                if what == "slip":
                    return sign * self.seen(point, state[:n], state[n:]).rate[0]
                found = forces(time, state)
                if what == "normal":
                    return found.normal[i]
                return point.friction * found.normal[i] - sign * found.friction[i]

            margin.terminal, margin.direction = True, -1  # type: ignore[attr-defined]
            return margin

        watched = []
        for i, state in enumerate(pattern):
            watched.append(watch(i, 1.0, "gap" if state == OPEN else "normal"))
            if state == STICK and math.isfinite(self.points[i].friction):
                watched += [watch(i, sign, "friction") for sign in (1.0, -1.0)]
            if state in SENSE:
                watched.append(watch(i, SENSE[state], "slip"))
        # a point that has just lifted must be seen above its surface before it comes back
        gap, rate, _ = self.gaps(y[:n], y[n:])
        leaving = rate[(np.abs(gap) < ZERO) & (rate > ZERO)]
        return solve_ivp(
            lambda time, state: np.concatenate([state[n:], forces(time, state).motion]),
            (t, end), y, method="DOP853", rtol=3e-14, atol=1e-15, max_step=max_step,
            first_step=min([0.1 * max_step, end - t, *(0.2 * leaving / self.gravity)]),
            events=watched, dense_output=True,
        )  # fmt: skip


@dataclass(frozen=True)
class Seen:
    """A point as its surface sees it; rate, rows and bias: along, across."""

    along: float
    gap: float
    rate: np.ndarray
    rows: np.ndarray
    bias: np.ndarray


@dataclass
class Motion:
    """Events in time order, and each pattern with its integration."""

    events: list[Event] = field(default_factory=list)
    spans: list[tuple[tuple[str, ...], Any]] = field(default_factory=list)
    time: float = 0.0
    end: np.ndarray = field(default_factory=lambda: np.zeros(0))

    def times(self, kind: str) -> list[float]:
        return [e.time for e in self.events if e.kind == kind]

    def at(self, t: float) -> tuple[tuple[str, ...], np.ndarray]:
        """Pattern and state at a time."""
        for pattern, span in self.spans:
            if span.t[0] <= t <= span.t[-1]:
                return pattern, span.sol(t)
        raise ValueError(f"{t} s is not within the motion")


def agrees(state: str, slip_rate: float) -> bool:
    """Whether a point that slips at this rate can be in a state."""
    if state == STICK:
        return abs(slip_rate) < ZERO
    return state == OPEN or SENSE[state] * slip_rate > -ZERO


def follows(
    state: str, moves: np.ndarray, least: float, small: float, sliding: bool = False
) -> bool:
    """Whether what follows, along and across, is what a state at zero needs."""
    along, across = moves
    if state == OPEN:
        return across >= least - small
    return state == STICK or sliding or SENSE[state] * along >= -small


def solved(a: np.ndarray, b: np.ndarray) -> np.ndarray | None:
    """The least z of a z = b, whose rows are not all independent; None if they contradict."""
    z = np.linalg.lstsq(a, b, rcond=1e-12)[0]
    scale = np.abs(a) @ np.abs(z) + np.abs(b)
    return None if np.any(np.abs(a @ z - b) > 1e-8 * scale.max()) else z


def one(found: list[Candidate]) -> Candidate:
    """The one solution; those with equal motions count as one. Raises UndecidedError."""
    if not found:
        raise UndecidedError(found)
    first = found[0].motion
    near = 1e-7 * max(1.0, np.abs(first).max())
    if any(np.abs(c.motion - first).max() > near for c in found):
        raise UndecidedError(found)
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
