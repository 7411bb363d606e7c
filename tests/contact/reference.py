"""Motions of rigid bodies that stand, slide, rock, bounce and fly on points: small, slow and clear.

The mechanics is that of `tests.mechanics`, written by hand: it shares nothing with the package.
Each pattern of contacts is integrated by SciPy up to its first event, in the package's coordinates.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from tests.mechanics import (
    OPEN,
    SENSE,
    STICK,
    ZERO,
    At,
    BlockOnFeet,
    Fit,
    Foot,
    Mechanics,
    distinct,
    impulses,
    motions,
)

Pattern = tuple[int, ...]
Ground = Callable[[float], Sequence[float]]
"""Both accelerations at a time."""


@dataclass(frozen=True)
class Event:
    kind: str
    point: str
    time: float
    before: np.ndarray
    after: np.ndarray
    pattern_before: Pattern
    pattern_after: Pattern


class UndecidedError(Exception):
    """No pattern fits, or several with different motions."""

    def __init__(self, fits: list[Fit]) -> None:
        super().__init__("several solutions" if fits else "no solution")
        self.fits = fits


def one(fits: list[Fit]) -> Fit:
    """The one solution; those with equal motions count as one. Raises UndecidedError."""
    apart = distinct(fits)
    if len(apart) != 1:
        raise UndecidedError(apart)
    return apart[0]


def touching(at: At) -> np.ndarray:
    """(m,) whether each point does, in a state without errors of integration."""
    return np.abs(at.gaps[0]) < ZERO


def followers(at: At, ground: Sequence[float] = (0.0, 0.0)) -> list[Fit]:
    """All patterns that can follow at this state: the algebraic problem of accelerations."""
    return motions(at, touching(at) & (np.abs(at.rates[0, :, 1]) < ZERO), ground)


def landings(at: At, bounces: float = 1.0) -> list[Fit]:
    """All patterns after an impact of the points that touch: the algebraic law."""
    return impulses(at, touching(at), ZERO, bounces)


def held(at: At, pattern: Pattern, ground: Sequence[float] = (0.0, 0.0)) -> Fit:
    """Accelerations and contact forces in a pattern, signs not asked for."""
    return Fit(at, pattern, at.solve(pattern, at.forces(*ground)))


@dataclass
class Motion:
    """Events in time order, and each pattern with its integration."""

    of: Mechanics
    events: list[Event] = field(default_factory=list)
    spans: list[tuple[Pattern, Any]] = field(default_factory=list)
    time: float = 0.0
    end: np.ndarray = field(default_factory=lambda: np.zeros(0))

    def times(self, kind: str) -> list[float]:
        return [e.time for e in self.events if e.kind == kind]

    def at(self, t: float) -> tuple[Pattern, At]:
        """Pattern and state at a time."""
        for pattern, span in self.spans:
            if span.t[0] <= t <= span.t[-1]:
                return pattern, state_of(self.of, span.sol(t))
        raise ValueError(f"{t} s is not within the motion")

    def named(self, t: float) -> dict[str, float]:
        """Coordinates and rates at a time, by the names of the package."""
        states = self.at(t)[1].states
        rates = {f"{name}_dot": v for name, v in zip(states.names, states.v[0], strict=True)}
        return dict(zip(states.names, states.q[0], strict=True)) | rates


def state_of(of: Mechanics, y: np.ndarray) -> At:
    """One state of coordinates and rates, one after the other."""
    n = len(y) // 2
    return of.at(y[None, :n], y[None, n:])


def follow(
    start: At,
    end: float,
    ground: Ground = lambda t: (0.0, 0.0),
    breaks: Sequence[float] = (),
    max_step: float = 0.05,
    least_impact: float = 1e-5,
) -> Motion:
    """The motion from a state, by one integration after the other, each up to an event.

    breaks : times at which the ground's accelerations are not smooth. Where infinitely many impacts
    follow, those slower than `least_impact` do not bounce, and end the motion if none would.
    """
    of, t, y = start.of, 0.0, np.concatenate([start.states.q[0], start.states.v[0]])
    motion = Motion(of)
    restitution = np.array([point.restitution for point in start.parts.points])
    pattern: Pattern = ()
    while t < end:
        before, at = y.copy(), state_of(of, y)
        meets = touching(at) & (at.rates[0, :, 1] < -ZERO)
        if meets.any():
            slow = np.abs(at.rates[0, meets, 1]).max() < least_impact
            if slow and not restitution[meets].any():
                break
            fit = one(landings(at, 0.0 if slow else 1.0))
            y = np.concatenate([at.states.q[0], fit.motion])
        old, pattern = pattern, _choose(state_of(of, y), pattern, ground(t))
        motion.events += _noted(at, t, old, pattern, meets, before, y)
        stop = min([end, *(b for b in breaks if b > t + 1e-12)])
        span = _within(of, t, y, stop, pattern, ground, max_step)
        motion.spans.append((pattern, span))
        t, y = span.t[-1], span.y[:, -1].copy()
    motion.time, motion.end = t, y
    return motion


def _choose(at: At, old: Pattern, ground: Sequence[float]) -> Pattern:
    """The pattern that follows; of those with equal accelerations not the one that ended."""
    fits = followers(at, ground)
    first = one(fits)
    others = [fit for fit in fits if fit.pattern != old]
    return (others or [first])[0].pattern


def _noted(
    at: At, t: float, old: Pattern, new: Pattern, meets: np.ndarray, before: np.ndarray,
    after: np.ndarray,
) -> list[Event]:  # fmt: skip
    """What happened at which point; nothing at the start but landings."""
    events = []
    for i, point in enumerate(at.parts.points):
        was, is_ = old[i] if old else None, new[i]
        happened = {
            "landing": meets[i],
            "lifting": was not in (None, OPEN) and is_ == OPEN and not meets[i],
            "slip begins": was == STICK and SENSE[is_],
            "slip ends": was is not None and SENSE[was] and is_ == STICK,
        }
        events += [
            Event(kind, point.name, t, before, after, old, new)
            for kind, did in happened.items()
            if did
        ]
    return events


def _within(
    of: Mechanics, t: float, y: np.ndarray, end: float, pattern: Pattern, ground: Ground,
    max_step: float,
) -> Any:  # fmt: skip
    """Integrate a pattern until it ends."""
    n, latest = len(y) // 2, [(math.nan, y, None)]

    def look(time: float, state: np.ndarray) -> Fit:
        """What follows in a state, computed once for all that ask."""
        if latest[0][0] != time or (latest[0][1] != state).any():
            latest[0] = time, state.copy(), held(state_of(of, state), pattern, ground(time))
        return latest[0][2]

    def watch(margin: Callable[[Fit], float]) -> Callable[[float, np.ndarray], float]:
        def event(time: float, state: np.ndarray) -> float:
            return float(margin(look(time, state)))

        event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
        return event

    margins: list[Callable[[Fit], float]] = []
    start = look(t, y)
    for i, state in enumerate(pattern):
        if state == OPEN:
            margins.append(lambda fit, i=i: fit.at.gaps[0, i])
        if SENSE[state]:
            margins.append(lambda fit, i=i, s=SENSE[state]: s * fit.at.rates[0, i, 0])
    margins += [lambda fit, i=i: fit.normal[i] for i in start.solved.normal]
    for i in start.solved.along:
        if pattern[i] == STICK and math.isfinite(start.at.parts.points[i].friction):
            margins += [
                lambda fit, i=i, s=s: fit.at.bound(i, fit.solved)[0] - s * fit.friction[i]
                for s in (1.0, -1.0)
            ]
    # a point that has just lifted must be seen above its surface before it comes back
    rates = start.at.rates[0, :, 1]
    leaving = rates[touching(start.at) & (rates > ZERO)]
    return solve_ivp(
        lambda time, state: np.concatenate([state[n:], look(time, state).motion]),
        (t, end), y, method="DOP853", rtol=3e-14, atol=1e-15, max_step=max_step,
        first_step=min([0.1 * max_step, end - t, *(0.2 * leaving / of.gravity)]),
        events=[watch(margin) for margin in margins], dense_output=True,
    )  # fmt: skip


@dataclass(frozen=True)
class Block:
    """A rectangular block on two feet, by half-width b and half-height h.

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
    def mechanics(self) -> BlockOnFeet:
        feet = tuple(
            Foot(name, side * self.b, 0.0, self.friction, self.restitution)
            for name, side in (("left", -1.0), ("right", 1.0))
        )
        return BlockOnFeet(self.mass, self.about_centre, self.h, feet, gravity=self.gravity)

    def at(self, **state: float) -> At:
        """Mechanics in a state. What is not given: the lowest foot touches, and sticks."""
        theta, turning = state.get("theta", 0.0), state.get("theta_dot", 0.0)
        side = 0.0 if theta == turning == 0.0 else math.copysign(1.0, theta or turning)
        s, c = math.sin(theta), math.cos(theta)
        stands: Mapping[str, float] = {
            "x": 0.0, "y": self.b * abs(s), "theta": 0.0, "x_dot": side * self.b * s * turning,
            "y_dot": side * self.b * c * turning, "theta_dot": 0.0,
        }  # fmt: skip
        return self.mechanics.in_state({**stands, **state})
