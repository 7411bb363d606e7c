"""Newton-Euler mechanics of bodies on points and springs, written by hand for many states at once.

It shares nothing with the package but the names of the states: positions of mass centres and of
contact points, their Jacobians and the accelerations that velocities alone cause, are written from
the geometry of each structure; forces and impulses follow by NumPy's dense algebra. Which state of
the contacts follows is found by trying every pattern of them.

Rotations are clockwise: a body's axes are along = (cos, -sin) and across = (sin, cos). Arrays have
k states in their first direction, n coordinates and m points.
"""

from __future__ import annotations

import copy
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

OPEN, STICK, SLIP_RIGHT, SLIP_LEFT, FRICTIONLESS = range(5)
"""States of a point, as programs number them."""
SENSE = np.array([0.0, 0.0, 1.0, -1.0, 0.0])
ZERO = 1e-9
"""Gaps [m] and velocities [m/s] below it are zero in a state without errors of integration."""
DISTINCT = 1e-5
"""Motions that differ by less are one, in parts of the larger, or of 1 m/s or m/s2."""


@dataclass(frozen=True)
class Place:
    """A point: value (k, 2), Jacobian (k, 2, n), and bias (k, 2), its acceleration at q'' = 0."""

    value: np.ndarray
    jacobian: np.ndarray
    bias: np.ndarray

    def velocity(self, v: np.ndarray) -> np.ndarray:
        return np.einsum("kin,kn->ki", self.jacobian, v)


@dataclass(frozen=True)
class States:
    """Coordinates q (k, n) and velocities v (k, n), columns by name; internal (k,) by name."""

    names: Sequence[str]
    q: np.ndarray
    v: np.ndarray
    internal: Mapping[str, np.ndarray] = field(default_factory=dict)

    def column(self, name: str) -> int:
        return self.names.index(name)

    def origin(self, horizontal: str | None = None, vertical: str | None = None) -> Place:
        """The point whose place the two coordinates are, zero where there is none."""
        k, n = self.q.shape
        value, jacobian = np.zeros((k, 2)), np.zeros((k, 2, n))
        for i, name in enumerate((horizontal, vertical)):
            if name is not None:
                j = self.column(name)
                value[:, i], jacobian[:, i, j] = self.q[:, j], 1.0
        return Place(value, jacobian, np.zeros((k, 2)))

    def turn(self, **weights: float) -> np.ndarray:
        """An angle as weights (n,) of coordinates."""
        of = np.zeros(len(self.names))
        for name, weight in weights.items():
            of[self.column(name)] = weight
        return of

    def carried(
        self, origin: Place, turn: np.ndarray, along: float, across: float, moves: str | None = None
    ) -> Place:
        """A point of a body that has turned about `origin`.

        along, across : its place in the body's axes. moves : a coordinate that is added to along.
        """
        angle, rate = self.q @ turn, self.v @ turn
        c, s = np.cos(angle), np.sin(angle)
        a, n = _axes(c, s)
        x = np.full(len(angle), along)
        if moves is not None:
            x = x + self.q[:, self.column(moves)]
        arm = x[:, None] * a + across * n
        turned = -x[:, None] * n + across * a
        jacobian = origin.jacobian + turned[:, :, None] * turn
        bias = origin.bias - rate[:, None] ** 2 * arm
        if moves is not None:
            j = self.column(moves)
            jacobian[:, :, j] += a
            bias = bias - 2.0 * (rate * self.v[:, j])[:, None] * n
        return Place(origin.value + arm, jacobian, bias)


def _axes(c: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Along and across (k, 2)."""
    along, across = np.empty((len(c), 2)), np.empty((len(c), 2))
    along[:, 0], along[:, 1] = c, -s
    across[:, 0], across[:, 1] = s, c
    return along, across


@dataclass(frozen=True)
class Mass:
    """A rigid body: its mass, the inertia about its centre, where that is, and its rotation."""

    mass: float
    inertia: float
    centre: Place
    turn: np.ndarray


@dataclass(frozen=True)
class Point:
    """A point above a flat surface: place = (slip, gap) as the surface sees it.

    pair : the body and the surface; points of one pair slip together.
    """

    name: str
    place: Place
    friction: float
    restitution: float
    pair: int


@dataclass(frozen=True)
class Strut:
    """A spring and damper under a foot, whose compression is less its place's height."""

    name: str
    place: Place
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Bar:
    """A bar that yields to both sides; or a tie, which carries no compression and may break.

    drawn (k,), row (k, n) : its elongation, and the derivatives by the coordinates. extension (k,)
    : the permanent one. tie : a `Strap` or an `Anchor`, for its numbers. broken (k,) : 0 or 1.
    """

    name: str
    drawn: np.ndarray
    row: np.ndarray
    extension: np.ndarray
    stiffness: float
    strength: float
    hardening: float
    tie: Any = None
    broken: np.ndarray | float = 0.0

    @property
    def tension(self) -> np.ndarray:
        """(k,) while it is whole; what is negative a tie does not carry."""
        tension = self.stiffness * (self.drawn - self.extension)
        if self.tie is None:
            return tension
        return tension + self.tie.pretension - self.stiffness * self.tie.slack_length

    @property
    def force(self) -> np.ndarray:
        """(k,) in tension."""
        if self.tie is None:
            return self.tension
        return np.maximum(self.tension, 0.0) * (1.0 - self.broken)


@dataclass(frozen=True)
class Parts:
    """What a structure consists of in k states; elastic (k, n): forces of its inner springs."""

    masses: Sequence[Mass]
    points: Sequence[Point] = ()
    struts: Sequence[Strut] = ()
    bars: Sequence[Bar] = ()
    elastic: np.ndarray | float = 0.0
    stored: np.ndarray | float = 0.0
    loads: Sequence[tuple[Place, np.ndarray]] = ()
    """Places, and forces (k, 2) on them."""


class Mechanics:
    """One structure: `parts` is what each writes by hand."""

    coordinates: tuple[str, ...] = ()
    internal: tuple[str, ...] = ()
    has_points: bool = True
    gravity: float = 9.81
    size: float = 1.0
    """A length of the structure, to judge gaps by [m]."""

    def parts(self, states: States) -> Parts:
        raise NotImplementedError

    def at(
        self, q: np.ndarray, v: np.ndarray, internal: Mapping[str, np.ndarray] | None = None
    ) -> At:
        states = States(self.coordinates, q, v, internal or {})
        return At(self, states, self.parts(states))

    def in_state(self, state: Mapping[str, float]) -> At:
        """Mechanics in one state, whose coordinates and rates have the names of the package."""
        q = np.array([[state[name] for name in self.coordinates]])
        return self.at(q, np.array([[state[f"{name}_dot"] for name in self.coordinates]]))


class At:
    """Masses, forces and points of a structure in k states.

    mass (k, n, n); bias (k, n) of forces; weight (k, 2, n): of a unit of acceleration; elastic
    (k, n) and potential (k,); rows (k, m, 2, n), biases and rates (k, m, 2) of slips and gaps;
    slips and gaps (k, m).
    """

    ARRAYS = (
        "mass", "bias", "weight", "elastic", "potential",
        "rows", "biases", "rates", "slips", "gaps",
    )  # fmt: skip

    def __init__(self, of: Mechanics, states: States, parts: Parts) -> None:
        self.of, self.states, self.parts = of, states, parts
        k, n = states.q.shape
        self.mass, self.bias = np.zeros((k, n, n)), np.zeros((k, n))
        self.weight, self.potential = np.zeros((k, 2, n)), np.zeros(k) + parts.stored
        self.elastic = np.zeros((k, n)) + parts.elastic
        self.whole = sum(body.mass for body in parts.masses)
        for body in parts.masses:
            j = body.centre.jacobian
            self.mass += body.mass * (np.swapaxes(j, 1, 2) @ j)
            self.mass += body.inertia * np.outer(body.turn, body.turn)
            self.bias += body.mass * (body.centre.bias[:, None, :] @ j)[:, 0]
            self.weight += body.mass * j
            self.potential += of.gravity * body.mass * body.centre.value[:, 1]
        for bar in parts.bars:
            self.elastic -= bar.force[:, None] * bar.row
            self.potential += 0.5 * bar.force**2 / bar.stiffness
        for place, force in parts.loads:
            self.elastic += np.einsum("kin,ki->kn", place.jacobian, force)
        m = len(parts.points)
        self.rows, self.biases = np.zeros((k, m, 2, n)), np.zeros((k, m, 2))
        self.slips, self.gaps = np.zeros((k, m)), np.zeros((k, m))
        for i, point in enumerate(parts.points):
            self.rows[:, i], self.biases[:, i] = point.place.jacobian, point.place.bias
            self.slips[:, i], self.gaps[:, i] = point.place.value.T
        self.rates = (self.rows @ states.v[:, None, :, None])[..., 0]

    def __getitem__(self, which: np.ndarray) -> At:
        """Some of the states; its parts are those of all, whose places are not to be asked for."""
        some = copy.copy(self)
        some.states = States(self.states.names, self.states.q[which], self.states.v[which])
        for name in self.ARRAYS:
            setattr(some, name, getattr(self, name)[which])
        return some

    def forces(self, ax, ay, pressed: Sequence[int] = ()) -> np.ndarray:
        """(k, n) of all but the points, with the ground's acceleration and what turns.

        pressed : 1 for each strut that acts.
        """
        k = len(self.bias)
        ax, ay = np.broadcast_to(ax, k), np.broadcast_to(ay, k)
        down = ay + self.of.gravity
        found = -ax[:, None] * self.weight[:, 0] - down[:, None] * self.weight[:, 1]
        found = found - self.bias + self.elastic
        for acts, strut in zip(pressed, self.parts.struts, strict=False):
            if acts:
                push = self.push(strut)
                found = found + push[:, None] * strut.place.jacobian[:, 1]
        return found

    def push(self, strut: Strut) -> np.ndarray:
        """k d + c d' of a strut, whether it touches or not."""
        rate = np.einsum("kn,kn->k", strut.place.jacobian[:, 1], self.states.v)
        return -strut.stiffness * strut.place.value[:, 1] - strut.damping * rate

    def kinetic(self, v: np.ndarray | None = None) -> np.ndarray:
        """(k,) with these velocities, or others (n,) in the same places."""
        v = self.states.v if v is None else np.broadcast_to(v, self.states.v.shape)
        return 0.5 * np.einsum("ka,ka->k", v, (self.mass @ v[..., None])[..., 0])

    def held(self, pattern: Sequence[int]) -> tuple[list[int], list[int]]:
        """The points that carry normal forces in a pattern, and those that carry friction.

        Rigid bodies do not say how more than two points of a pair share their force: the outer two
        carry it, and the first of them the friction of all.
        """
        pairs: dict[int, list[int]] = {}
        for i, state in enumerate(pattern):
            if state != OPEN:
                pairs.setdefault(self.parts.points[i].pair, []).append(i)
        normal, along = [], []
        for members in pairs.values():
            if len(members) > 2:
                where = [float(self.slips[0, i]) for i in members]
                members = [members[int(np.argmin(where))], members[int(np.argmax(where))]]
            normal += members
            along.append(members[0])
        return normal, along

    def solve(
        self, pattern: Sequence[int], force: np.ndarray, wanted: np.ndarray | None = None
    ) -> Solved:
        """Accelerations and contact forces in a pattern of point states, by its constraints.

        wanted (k, m, 2) : what rows . z are where the pattern holds them, for M z = force + pushes.
        They are -biases for accelerations. With force = M v they are the rates after an impact, and
        z is the velocity after it. One state alone may leave forces undetermined: the least follow.
        """
        wanted = -self.biases if wanted is None else wanted
        normal, along = self.held(pattern)
        stuck = [i for i in along if pattern[i] == STICK]
        k = len(self.bias)
        rows = [self.rows[:, i, 1] for i in normal] + [self.rows[:, i, 0] for i in stuck]
        free = np.linalg.solve(self.mass, force[:, :, None])[:, :, 0]
        if not rows:
            return Solved(free, np.zeros((k, 0)), np.zeros((k, 0)), normal, along)
        right = [wanted[:, i, 1] for i in normal] + [wanted[:, i, 0] for i in stuck]
        pushes = [self.push_of(i, pattern[i]) for i in normal]
        pushes += [self.rows[:, i, 0] for i in stuck]
        r, p = np.stack(rows, axis=1), np.stack(pushes, axis=2)
        spread = np.linalg.solve(self.mass, p)
        system = r @ spread
        lacks = np.stack(right, axis=1) - np.einsum("krn,kn->kr", r, free)
        if k == 1:
            forces = np.linalg.lstsq(system[0], lacks[0], rcond=1e-12)[0][None]
        else:
            forces = np.linalg.solve(system, lacks[:, :, None])[:, :, 0]
        motion = free + np.einsum("knr,kr->kn", spread, forces)
        pressed = forces[:, : len(normal)]
        friction = np.zeros((k, len(along)))
        for column, i in enumerate(along):
            if i in stuck:
                friction[:, column] = forces[:, len(normal) + stuck.index(i)]
            else:
                for j, other in enumerate(normal):
                    if self.parts.points[other].pair == self.parts.points[i].pair:
                        mu = self.parts.points[other].friction
                        friction[:, column] -= SENSE[pattern[i]] * mu * pressed[:, j]
        return Solved(motion, pressed, friction, normal, along)

    def push_of(self, point: int, state: int) -> np.ndarray:
        """(k, n) of a unit of normal force, with the friction that goes with it where it slips."""
        push = self.rows[:, point, 1]
        if SENSE[state]:
            push = push - self.parts.points[point].friction * SENSE[state] * self.rows[:, point, 0]
        return push

    def bound(self, point: int, solved: Solved) -> np.ndarray:
        """(k,) the most friction of the pair of a point at these normal forces."""
        total = 0.0
        for j, other in enumerate(solved.normal):
            if self.parts.points[other].pair == self.parts.points[point].pair:
                mu, pressed = self.parts.points[other].friction, solved.pressed[:, j]
                total = total + (mu if math.isinf(mu) else mu * np.maximum(pressed, 0.0))
        return total + np.zeros(len(solved.pressed))

    def load(self, ax: np.ndarray | float, ay: np.ndarray | float) -> np.ndarray | float:
        """A force of the structure, to judge others by: its masses times accelerations."""
        return self.whole * (self.of.gravity + np.abs(ax) + np.abs(ay))


@dataclass(frozen=True)
class Solved:
    """Accelerations (k, n); forces of the points in `normal` (k, a) and of the pairs in `along`."""

    motion: np.ndarray
    pressed: np.ndarray
    friction: np.ndarray
    normal: Sequence[int]
    along: Sequence[int]


# -- what follows from one state


@dataclass(frozen=True)
class Fit:
    """A pattern that meets every condition of contact, and what follows from it in a state.

    motion (n,) : accelerations, or the velocities after an impact; normal, friction (m,) : forces
    or impulses of the points. The friction of a pair is that of its first closed point.
    """

    at: At
    pattern: tuple[int, ...]
    solved: Solved

    @property
    def motion(self) -> np.ndarray:
        return self.solved.motion[0]

    @property
    def normal(self) -> np.ndarray:
        return self._of_points(self.solved.normal, self.solved.pressed)

    @property
    def friction(self) -> np.ndarray:
        return self._of_points(self.solved.along, self.solved.friction)

    def _of_points(self, points: Sequence[int], forces: np.ndarray) -> np.ndarray:
        every = np.zeros(len(self.pattern))
        every[list(points)] = forces[0]
        return every


def patterns(at: At, near: np.ndarray) -> Iterator[tuple[int, ...]]:
    """All in which points of a pair that are closed do the same."""
    points = at.parts.points
    choices: list[tuple[int, ...]] = []
    for i, point in enumerate(points):
        if not near[i]:
            choices.append((OPEN,))
        elif math.isinf(point.friction):
            choices.append((OPEN, STICK))
        elif not point.friction:
            choices.append((OPEN, SLIP_RIGHT))
        else:
            choices.append((OPEN, STICK, SLIP_RIGHT, SLIP_LEFT))
    for pattern in itertools.product(*choices):
        pairs: dict[int, set[int]] = {}
        for i, state in enumerate(pattern):
            if state != OPEN:
                pairs.setdefault(points[i].pair, set()).add(state)
        if all(len(states) == 1 for states in pairs.values()):
            yield pattern


def motions(
    at: At, near: np.ndarray, ground: Sequence[float], small: float = ZERO, margin: float = ZERO
) -> list[Fit]:
    """Patterns of one state whose accelerations and contact forces fit.

    near : of each point, whether it may stay closed. small : slip rates below it are zero [m/s].
    margin : of forces and accelerations, by which a pattern may miss, in parts of them.
    """
    slips, force, fits = at.rates[0, :, 0], at.forces(*ground), []
    for pattern in patterns(at, near):
        if not all(
            _agrees(state, slip, small) or not point.friction
            for state, slip, point in zip(pattern, slips, at.parts.points, strict=True)
        ):
            continue
        solved = at.solve(pattern, force)
        room = margin * (at.load(*ground) + np.abs(solved.pressed).max(initial=0.0))
        tiny = margin * (at.of.gravity + np.abs(solved.motion).max())
        follows = at.rows[0] @ solved.motion[0] + at.biases[0]
        decided = np.abs(slips) > small
        if _bears(at, solved, room) and _goes_on(at, pattern, near, solved, follows, tiny, decided):
            fits.append(Fit(at, pattern, solved))
    return fits


def _agrees(state: int, slip: float, small: float) -> bool:
    """Whether a point that slips at a rate can be in a state."""
    if state == STICK:
        return abs(slip) <= small
    return state == OPEN or SENSE[state] * slip >= -small


def impulses(at: At, touching: np.ndarray, small: float = ZERO, bounces: float = 1.0) -> list[Fit]:
    """Patterns that may follow where touching points meet, by Newton's law of restitution.

    bounces : factor of the restitutions.
    """
    fits: list[Fit] = []
    restitution = np.array([point.restitution for point in at.parts.points])
    least = bounces * restitution * np.maximum(-at.rates[0, :, 1], 0.0)
    wanted = np.stack([np.zeros(len(least)), least], axis=1)
    momentum = (at.mass @ at.states.v[..., None])[..., 0]
    none = np.zeros(len(least), bool)
    for pattern in patterns(at, touching):
        solved = at.solve(pattern, momentum, wanted[None])
        follows = at.rows[0] @ solved.motion[0] - wanted
        room = 1e-7 * np.abs(solved.pressed).max(initial=0.0)
        if _bears(at, solved, room) and _goes_on(
            at, pattern, touching, solved, follows, small, none
        ):
            fits.append(Fit(at, pattern, solved))
    return fits


def _bears(at: At, solved: Solved, room: float) -> bool:
    """Whether no point pulls, and no pair needs more friction than there is."""
    if not np.isfinite(solved.motion).all() or (solved.pressed < -room).any():
        return False
    bounds = [float(at.bound(i, solved)[0]) for i in solved.along]
    return bool((np.abs(solved.friction[0]) <= np.array(bounds) + room).all())


def _goes_on(
    at: At, pattern: Sequence[int], near: np.ndarray, solved: Solved, follows: np.ndarray,
    small: float, decided: np.ndarray,
) -> bool:  # fmt: skip
    """Whether what follows (m, 2), along and across, is what each state of a near point needs.

    follows : less what is wanted. decided (m,) : whether the slip has a sense already.
    """
    stuck = [i for i in solved.along if pattern[i] == STICK]
    lacks = *follows[solved.normal, 1], *follows[stuck, 0]
    rubs = np.array([point.friction > 0.0 for point in at.parts.points])
    turns = near & rubs & ~decided & (SENSE[list(pattern)] * follows[:, 0] < -small)
    sinks = near & (follows[:, 1] < -small)
    return not (turns.any() or sinks.any() or (np.abs(lacks) > small).any())


def distinct(fits: Sequence[Fit]) -> list[Fit]:
    """Those with different motions, the first of each."""
    kept: list[Fit] = []
    for fit in fits:
        near = DISTINCT * (1.0 + np.abs(fit.motion).max())
        if all(np.abs(fit.motion - other.motion).max() > near for other in kept):
            kept.append(fit)
    return kept


# -- structures


@dataclass(frozen=True)
class Foot:
    """A foot of a block, from the base's centre."""

    name: str
    along: float
    across: float
    friction: float
    restitution: float


def two_feet(b: float, friction: float, restitution: float) -> tuple[Foot, Foot]:
    """Feet at the ends of a base of half the width b."""
    laws = friction, restitution
    return Foot("left", -b, 0.0, *laws), Foot("right", b, 0.0, *laws)


@dataclass(frozen=True)
class BlockOnFeet(Mechanics):
    """A rigid body on any number of feet; x, y of its base's centre and theta."""

    mass: float
    inertia: float
    height: float
    feet: tuple[Foot, ...]
    pads: tuple[tuple[str, float, float, float, float], ...] = ()
    """Name, place along and across the base, stiffness and damping."""
    bars: tuple[tuple[str, float, float, float, float], ...] = ()
    """Name, place along the base, stiffness, strength and hardening."""
    load: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Force that presses on a point of the axis [N], how far above the base, and 1 if it turns."""
    ties: tuple[Any, ...] = ()
    """Straps and anchors, for their numbers."""
    pushes: tuple[Any, ...] = ()
    """Pushes of half a sine, likewise."""
    radius: float = 0.0
    """Of the arcs on which the feet roll: they are their lowest points when it stands."""
    offset: float = 0.0
    """Place of the centroid along the base."""
    pivot: float | None = None
    """Place along the base of an edge that is held."""
    isolator: tuple[float, float, float] | None = None
    """Mass of a base that moves by u, on a spring and a damper: their constants."""
    internal: tuple[str, ...] = ()
    gravity: float = 9.81
    coordinates: tuple[str, ...] = ("x", "y", "theta")

    @property
    def size(self) -> float:  # type: ignore[override]
        return self.radius + math.hypot(self.height, max(abs(f.along) for f in self.feet))

    def lowest(self, theta: float) -> float:
        """The height of the base's centre at which the lowest foot touches."""
        s, c = math.sin(theta), math.cos(theta)
        return max(f.along * s - f.across * c for f in self.feet)

    def parts(self, states: States) -> Parts:
        start, theta = self.pivot or 0.0, states.turn(theta=1.0)
        seen = states.origin(*(("x", "y") if self.pivot is None else ()))
        base = seen = replace(seen, value=seen.value + np.array([start, 0.0]))
        if self.isolator:
            moves = states.origin("u")
            base = replace(
                seen, value=seen.value + moves.value, jacobian=seen.jacobian + moves.jacobian
            )

        def carried(along: float, across: float, origin: Place = base) -> Place:
            return states.carried(origin, theta, along - start, across)

        points = [
            Point(f.name, self._rolled(states, carried(f.along, f.across + self.radius, seen)),
                  f.friction, f.restitution, 0)
            for f in self.feet
        ]  # fmt: skip
        struts = [Strut(name, carried(along, across), k, c)
                  for name, along, across, k, c in self.pads]  # fmt: skip
        bars = []
        for name, along, *numbers in self.bars:
            end = carried(along, 0.0)
            extension = states.internal[f"{name}_extension"]
            bars.append(Bar(name, end.value[:, 1], end.jacobian[:, 1], extension, *numbers))
        feet = {f.name: (f.along, f.across) for f in self.feet}
        for tie in self.ties:
            at = tie.at if hasattr(tie, "at") else feet[tie.foot]
            bars.append(tied(tie, carried(*at), states.internal))
        force, across, turns = self.load
        _, down = _axes(*(f(turns * states.q @ theta) for f in (np.cos, np.sin)))
        loads = [(carried(0.0, across), -force * down)]
        for push in self.pushes:
            part = np.clip((states.internal["push_time"] - push.start) / push.duration, 0.0, 1.0)
            size = push.force * np.sin(math.pi * part)
            loads.append((carried(*push.at), np.stack([size, 0.0 * size], axis=1)))
        masses = [Mass(self.mass, self.inertia, carried(self.offset, self.height), theta)]
        if not self.isolator:
            return Parts(masses, points, struts, bars, loads=loads)
        mass, stiffness, damping = self.isolator
        masses.append(Mass(mass, 0.0, moves, 0.0 * theta))
        u, rate = (of @ states.turn(u=1.0) for of in (states.q, states.v))
        pulls = np.outer(stiffness * u + damping * rate, states.turn(u=1.0))
        return Parts(masses, points, elastic=-pulls, stored=0.5 * stiffness * u**2)

    def _rolled(self, states: States, arc: Place) -> Place:
        """The lowest point of an arc, from its centre."""
        theta, jacobian = states.turn(theta=1.0), arc.jacobian.copy()
        jacobian[:, 0] -= self.radius * theta
        down = self.radius * np.stack([states.q @ theta, np.ones(len(states.q))], axis=1)
        return Place(arc.value - down, jacobian, arc.bias)


def tied(tie: Any, end: Place, internal: Mapping[str, np.ndarray]) -> Bar:
    """A strap from a place to its fixed end, or an anchor below the place."""
    drawn, row = end.value[:, 1], end.jacobian[:, 1]
    if hasattr(tie, "to"):
        apart = end.value - tie.to
        length = np.hypot(*apart.T)
        drawn = length - math.dist(tie.at, tie.to)
        row = np.einsum("ki,kin->kn", apart / length[:, None], end.jacobian)
    extension, broken = (
        internal.get(f"{tie.name}_{name}", np.zeros(len(drawn))) for name in ("extension", "broken")
    )
    numbers = tie.stiffness, tie.strength, tie.hardening
    return Bar(tie.name, drawn, row, extension, *numbers, tie, broken)


@dataclass(frozen=True)
class AtWall(BlockOnFeet):
    """A block with a point that may touch a smooth wall: to the left of it, or to the right."""

    point: tuple[str, float, float] = ("stop", 0.0, 0.0)
    """Name, place along and across the base."""
    wall: float = 0.0
    """Where the wall stands [m]."""
    facing: float = 1.0
    """1 for a wall to the left, -1 to the right."""
    bounces: float = 0.0

    def parts(self, states: States) -> Parts:
        parts = super().parts(states)
        base, theta = states.origin("x", "y"), states.turn(theta=1.0)
        name, along, across = self.point
        place = states.carried(base, theta, along, across)
        seen = Place(
            np.stack([place.value[:, 1], self.facing * (place.value[:, 0] - self.wall)], axis=1),
            np.stack([place.jacobian[:, 1], self.facing * place.jacobian[:, 0]], axis=1),
            np.stack([place.bias[:, 1], self.facing * place.bias[:, 0]], axis=1),
        )
        smooth = Point(name, seen, 0.0, self.bounces, 1)
        return replace(parts, points=[*parts.points, smooth])


@dataclass(frozen=True)
class TwoBlocks(Mechanics):
    """A rectangular block on another one, half-widths b, half-heights h; nothing slips."""

    b: tuple[float, float]
    h: tuple[float, float]
    m: tuple[float, float]
    inertia: tuple[float, float]
    restitution: float
    gravity: float = 9.81
    coordinates: tuple[str, ...] = ("x", "y", "theta", "xi", "eta", "phi")

    @property
    def size(self) -> float:  # type: ignore[override]
        return math.hypot(self.b[0], 2 * self.h[0])

    def parts(self, states: States) -> Parts:
        theta, phi = states.turn(theta=1.0), states.turn(phi=1.0)
        base = states.origin("x", "y")
        lower = states.carried(base, theta, 0.0, self.h[0])
        # on the lower block's top: along by xi, and across by 2 h + eta
        foot = states.carried(base, theta, 0.0, 2 * self.h[0], moves="xi")
        foot = self._raised(states, foot, theta)
        upper = states.carried(foot, phi, 0.0, self.h[1])
        seen = states.origin("xi", "eta")
        points = [
            Point(name, states.carried(base, theta, s * self.b[0], 0.0), math.inf,
                  self.restitution, 0)
            for name, s in (("left", -1), ("right", 1))
        ] + [
            Point(name, states.carried(seen, phi - theta, s * self.b[1], 0.0), math.inf,
                  self.restitution, 1)
            for name, s in (("upper_left", -1), ("upper_right", 1))
        ]  # fmt: skip
        masses = [
            Mass(self.m[0], self.inertia[0], lower, theta),
            Mass(self.m[1], self.inertia[1], upper, phi),
        ]
        return Parts(masses, points)

    @staticmethod
    def _raised(states: States, foot: Place, theta: np.ndarray) -> Place:
        """The point moved by eta across the lower block's axis."""
        angle, rate = states.q @ theta, states.v @ theta
        j = states.column("eta")
        eta, eta_rate = states.q[:, j], states.v[:, j]
        a, n = _axes(np.cos(angle), np.sin(angle))
        jacobian = foot.jacobian + (eta[:, None] * a)[:, :, None] * theta
        jacobian[:, :, j] += n
        bias = foot.bias - (rate**2 * eta)[:, None] * n + (2 * rate * eta_rate)[:, None] * a
        return Place(foot.value + eta[:, None] * n, jacobian, bias)


@dataclass(frozen=True)
class Storey:
    """A floor: mass, inertia, height, and the stiffness and damping of the storey below it."""

    mass: float
    inertia: float
    height: float
    stiffness: float
    damping: float
    coordinate: str


@dataclass(frozen=True)
class Frame(Mechanics):
    """Floors that move along the axis of a base, which stands on two feet or on struts."""

    floors: tuple[Storey, ...]
    base_mass: float
    base_height: float
    base_inertia: float
    half_width: float
    feet: tuple[Foot, ...] = ()
    struts: tuple[tuple[str, float, float, float], ...] = ()
    """Name, place along the base, stiffness and damping."""
    settlement: float = 0.0
    has_points: bool = True
    guided: str = "centre"
    """What of a base on struts moves up and down alone: its centre, or the foot it leans on."""
    gravity: float = 9.81
    coordinates: tuple[str, ...] = ()

    @property
    def size(self) -> float:  # type: ignore[override]
        return math.hypot(self.half_width, max(f.height for f in self.floors))

    def parts(self, states: States) -> Parts:
        theta = states.turn(theta=1.0)
        if self.struts:
            base = states.origin(None, "heave")
            base = Place(base.value - [0.0, self.settlement], base.jacobian, base.bias)
            if self.guided == "foot":
                base = self._beside_its_foot(states, base)
        else:
            base = states.origin("x", "y")
        masses = [
            Mass(self.base_mass, self.base_inertia,
                 states.carried(base, theta, 0.0, self.base_height), theta)
        ]  # fmt: skip
        k, n = states.q.shape
        elastic, stored = np.zeros((k, n)), np.zeros(k)
        below = None
        for floor in self.floors:
            moves = floor.coordinate or None
            centre = states.carried(base, theta, 0.0, floor.height, moves=moves)
            masses.append(Mass(floor.mass, floor.inertia, centre, theta))
            if moves is None:
                continue
            j = states.column(moves)
            drift, rate = states.q[:, j], states.v[:, j]
            if below is not None:
                drift, rate = drift - states.q[:, below], rate - states.v[:, below]
            force = floor.stiffness * drift + floor.damping * rate
            elastic[:, j] -= force
            if below is not None:
                elastic[:, below] += force
            stored += 0.5 * floor.stiffness * drift**2
            below = j
        points = [
            Point(f.name, states.carried(base, theta, f.along, f.across), f.friction,
                  f.restitution, 0)
            for f in self.feet
        ]  # fmt: skip
        struts = [
            Strut(name, states.carried(base, theta, along, 0.0), k_s, c_s)
            for name, along, k_s, c_s in self.struts
        ]
        return Parts(masses, points, struts, (), elastic, stored)

    def _beside_its_foot(self, states: States, base: Place) -> Place:
        """The base's centre where the foot to which it leans stands on its line."""
        j = states.column("theta")
        theta, rate = states.q[:, j], states.v[:, j]
        side = self.half_width * np.copysign(1.0, theta)
        value, jacobian, bias = base.value.copy(), base.jacobian.copy(), base.bias.copy()
        value[:, 0] += side * (1.0 - np.cos(theta))
        jacobian[:, 0, j] += side * np.sin(theta)
        bias[:, 0] += side * np.cos(theta) * rate**2
        return Place(value, jacobian, bias)


# -- of structures of the package


def _rectangle(mass: float, b: float, h: float) -> float:
    return mass * (b * b + h * h) / 3.0


def of_sliding_block(given: Mapping[str, float]) -> BlockOnFeet:
    b, h = given["half_width"], given["half_height"]
    mass, feet = given.get("mass", 1.0), two_feet(b, given["friction"], given["restitution"])
    return BlockOnFeet(mass, _rectangle(mass, b, h), h, feet)


def of_stack(given: Mapping[str, float]) -> TwoBlocks:
    b = given["lower_half_width"], given["upper_half_width"]
    h = given["lower_half_height"], given["upper_half_height"]
    m = given["lower_mass"], given["upper_mass"]
    inertia = _rectangle(m[0], b[0], h[0]), _rectangle(m[1], b[1], h[1])
    return TwoBlocks(b, h, m, inertia, given["restitution"])
