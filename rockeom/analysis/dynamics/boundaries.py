"""Boundaries of overturning by derivatives of the motion: accurate points, and continuation.

    point = dynamics.overturning_point(pulse, {"frequency": 4, "amplitude": 1.5},
                                       {"frequency": 4, "amplitude": 2.0})
    point.at  # {"frequency": 4.0, "amplitude": 1.788563...}
    line = dynamics.followed_boundary(
        pulse, point, within={"frequency": (0.5, 8.0), "amplitude": (0.5, 8.0)}
    )

On the boundary the motion comes to the unstable equilibrium and stays there. At a small distance h
from the boundary it leaves the equilibrium after a time that grows as -ln|h|/lambda, lambda being
the rate at which it departs, and then either overturns or comes back. So the derivative of the time
T of that event grows as 1/h, from both sides, and 1/(dT/dh) goes through zero as a straight line,
of slope -lambda: a secant of it is right to second order.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
import xarray as xr

from rockeom.analysis.sweeps import FALLS, RESTS, STANDS
from rockeom.numbers.checks import InputError, numbers, positive
from rockeom.numbers.dual import duals
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.sweeps.tangents import Tangents, tangents

_LONGER = 5
"""Most doublings of the duration of a motion until its fate shows."""


@dataclass(frozen=True, eq=False)
class OverturningPoint:
    """Case at which the fate changes: its motion converges to the unstable equilibrium.

    Parameters
    ----------
    at : dict of str to float
        Values of the case, by name.
    normal : ndarray
        Direction (k,) of length 1 in which the fate changes from `below` to `above` fastest, in the
        order of the names; changes at right angles to it stay on the boundary.
    below : float
        Number of impacts before overturning on the one side, inf where the structure stands.
    above : float
        Number of impacts before overturning on the other side, inf where the structure stands.
    runs : int
        Number of motions simulated, with their derivatives.
    """

    at: dict[str, float]
    normal: np.ndarray
    below: float
    above: float
    runs: int


def overturning_point(
    case: Callable[..., Case],
    start: Mapping[str, float],
    end: Mapping[str, float],
    *,
    accuracy: float = 1e-10,
    options: SolverOptions | None = None,
) -> OverturningPoint:
    """Case between two at which the number of impacts before overturning changes.

    Parameters
    ----------
    case : callable
        Function that makes a case from numbers by name, which may be duals (`rk.duals`), as for
        `rk.tangents`.
    start : dict of str to float
        Numbers by name.
    end : dict of str to float
        Numbers by the same names, of a case with another fate; the point is searched on the
        straight line between the two.
    accuracy : float, optional
        Accuracy of the place on that line, in parts of the size of the numbers.
    options : SolverOptions, optional
        Choices of the integration. Its tolerance limits the accuracy of the boundary.

    Returns
    -------
    OverturningPoint
        Values at the change, the direction across it, and the fates on both sides.

    Raises
    ------
    ValueError
        For names that differ, for two cases of one fate, and where a third fate, or none, comes
        between them: then give closer ones.

    Notes
    -----
    Secants of 1/(dT/dh), see the docstring of the module, are as good as Newton's method, and are
    bracketed by points of both sides (Brent's method); where there is no such derivative the line
    is halved.
    """
    return _Line(case, *_ends("overturning_point", start, end), options).point(accuracy)


def _ends(
    function: str, start: Mapping[str, float], end: Mapping[str, float]
) -> tuple[tuple[str, ...], np.ndarray, np.ndarray]:
    if {*start} != {*end}:
        raise InputError("start", of=function).wrong(
            f"has {', '.join(start)}, end {', '.join(end)}: give the same names"
        )
    low, high = numbers(function, start=[*start.values()], end=[end[name] for name in start])
    return tuple(start), low, high


@dataclass
class _Line:
    """Cases on a straight line, at places from 0 to 1, each run once."""

    case: Callable[..., Case]
    names: tuple[str, ...]
    start: np.ndarray
    end: np.ndarray
    options: SolverOptions | None
    runs: dict[float, _Run] = field(default_factory=dict)

    def values(self, place: float) -> np.ndarray:
        return self.start + place * (self.end - self.start)

    def run(self, place: float) -> _Run:
        if place not in self.runs:
            self.runs[place] = _Run.of(self.case, self.names, self.values(place), self.options)
        return self.runs[place]

    @property
    def fates(self) -> tuple[float, float]:
        return self.run(0.0).fate, self.run(1.0).fate

    def point(self, accuracy: float) -> OverturningPoint:
        """Raises ValueError where both ends have the same fate, or there is a third."""
        from scipy.optimize import brentq  # takes long to import

        below, above = self.fates
        if below == above or math.isnan(below + above):
            raise ValueError(
                f"overturning_point: {self.said(0.0)}, and {self.said(1.0)}: give two fates"
            )
        size = np.abs(self.values(0.5)).max() / np.abs(self.end - self.start).max()
        place = brentq(self.steepness, 0.0, 1.0, xtol=max(accuracy * size, 1e-15), rtol=1e-15)
        sloped = [x for x in self.runs if self.gradient(x).any()]
        nearest = min(sloped or [place], key=lambda x: abs(x - place))
        normal = self.gradient(nearest) * (1.0 if self.run(nearest).fate == below else -1.0)
        return OverturningPoint(
            dict(zip(self.names, self.values(place).tolist(), strict=True)),
            normal / (np.linalg.norm(normal) or np.nan), below, above, len(self.runs),
        )  # fmt: skip

    def said(self, place: float) -> str:
        values = zip(self.names, self.values(place).tolist(), strict=True)
        numbers = ", ".join(f"{name} = {value:.12g}" for name, value in values)
        fate = self.run(place).fate
        return f"{numbers} " + (
            "stands" if math.isinf(fate) else f"overturns after {fate:g} impacts"
        )

    def steepness(self, place: float) -> float:
        """1/(dT/dplace), negative on the side of the start; only its sign where T is unknown."""
        below, above = self.fates
        fate = self.run(place).fate
        if fate not in (below, above):
            raise ValueError(
                f"overturning_point: between its ends there is another fate, at "
                f"{self.said(place)}: give closer ones"
            )
        slope = abs(self.gradient(place) @ (self.end - self.start))
        return (-1.0 if fate == below else 1.0) * (1.0 / slope if slope > 0 else 1.0)

    def gradient(self, place: float) -> np.ndarray:
        """(k,) of the time at which the motion leaves the equilibrium; zeros where unknown."""
        fallen = [run.events for run in (self.run(0.0), self.run(1.0)) if run.falls]
        return self.run(place).gradient(min(fallen))


@dataclass
class _Run:
    """A motion and its derivatives by the k numbers of its case."""

    case: Case
    options: SolverOptions | None
    tangents: Tangents

    @classmethod
    def of(
        cls,
        case: Callable[..., Case],
        names: tuple[str, ...],
        values: np.ndarray,
        options: SolverOptions | None,
    ) -> _Run:
        made = case(**duals(**dict(zip(names, values.tolist(), strict=True))))
        return cls(made, options, tangents(made, options))

    @property
    def events(self) -> int:
        return len(self.tangents.event_times)

    @property
    def falls(self) -> bool:
        return self.tangents.response.outcome == FALLS

    @property
    def fate(self) -> float:
        run = self.tangents.response
        if self.falls:
            return float(len(run.impacts))
        return math.inf if run.outcome in STANDS else math.nan

    def gradient(self, events: int) -> np.ndarray:
        """Gradient of the time of the event after so many events, overturning included."""
        for motion in self.longer():
            if len(motion.event_times) > events:
                slope = motion.event_times[events]
            elif motion.response.t[-1] < motion.response.duration:  # it has overturned
                slope = motion.end_time
            else:
                continue
            return np.nan_to_num(slope, posinf=0.0, neginf=0.0)
        return np.zeros(len(self.tangents.end_time))

    def longer(self) -> Iterator[Tangents]:
        """The motion, and ever longer ones while it moves; the last one is cached."""
        for _ in range(_LONGER):
            yield self.tangents
            if self.tangents.response.outcome == RESTS:
                return
            last = 2.0 * self.tangents.response.duration
            self.tangents = tangents(replace(self.case, duration=last), self.options)


# --- from point to point


def followed_boundary(
    case: Callable[..., Case],
    point: OverturningPoint,
    within: Mapping[str, tuple[float, float]],
    *,
    step: float = 0.02,
    accuracy: float = 1e-8,
    most: int = 1000,
    options: SolverOptions | None = None,
) -> xr.Dataset:
    """Boundary of overturning through a point, followed both ways through all its turns.

    Parameters
    ----------
    case : callable
        Function that makes a case from numbers by name, which may be duals, as for
        `overturning_point`.
    point : OverturningPoint
        Result of `overturning_point`, of two names.
    within : dict of str to tuple of (float, float)
        Least and largest value of each name, where the boundary is left.
    step : float, optional
        Longest step, in parts of the ranges; steps are shorter where the boundary bends.
    accuracy : float, optional
        Accuracy of each point, in parts of the size of the numbers.
    most : int, optional
        Largest number of points, each way.
    options : SolverOptions, optional
        Choices of the integration. Its tolerance limits the accuracy of the boundary.

    Returns
    -------
    xarray.Dataset
        Dataset over "point" with a coordinate of each name, the normal's components, the fates in
        ``attrs`` "below" and "above", and in "first" and "last" why it ended there.

    Raises
    ------
    ValueError
        For another number of names than two, and a point that is not within the ranges.

    Notes
    -----
    From a point the line goes on at a right angle to its normal, and from there along it to the
    next point. A step that ends between other fates is halved; the line ends where a hundredth of
    it does not help: where three fates meet, or nearly so, because one of the two is too narrow.
    """
    where = "followed_boundary"
    names = tuple(point.at)
    if len(names) != 2 or {*within} != {*names}:
        raise InputError("within", of=where).wrong(
            f"has {', '.join(within)}, the point {', '.join(names)}: give the range of each of two "
            "names"
        )
    (box,) = numbers(where, within=[within[name] for name in names])
    positive(where, step=step, accuracy=accuracy, within=box[:, 1] - box[:, 0])
    walk = _Walk(case, names, box, (point.below, point.above), step, accuracy, options)
    if not walk.contains(walk.scaled(point)):
        raise InputError("point", point.at, where).give(f"one within {dict(within)}")
    ways = [walk.points(point, sign, most) for sign in (-1.0, 1.0)]
    (back, first), (ahead, last) = ways
    line = [*reversed(back), point, *ahead]
    normal = {f"normal_{name}": [one.normal[i] for one in line] for i, name in enumerate(names)}
    return xr.Dataset(
        {name: ("point", values) for name, values in normal.items()},
        {name: ("point", [one.at[name] for one in line]) for name in names},
        {"below": point.below, "above": point.above, "first": first, "last": last},
    )


@dataclass(frozen=True)
class _Walk:
    """Steps along a boundary; lengths are in parts of a box (2, 2) of the names' values."""

    case: Callable[..., Case]
    names: tuple[str, ...]
    box: np.ndarray
    fates: tuple[float, float]
    step: float
    accuracy: float
    options: SolverOptions | None

    def scaled(self, point: OverturningPoint) -> np.ndarray:
        low, high = self.box.T
        return (np.array([*point.at.values()]) - low) / (high - low)

    def contains(self, place: np.ndarray) -> bool:
        return bool((place >= 0.0).all() and (place <= 1.0).all())

    def along(self, point: OverturningPoint, sign: float) -> np.ndarray:
        """(2,) direction in which the boundary goes on."""
        normal = point.normal * (self.box[:, 1] - self.box[:, 0])
        return sign * np.array([-normal[1], normal[0]]) / np.linalg.norm(normal)

    def points(
        self, point: OverturningPoint, sign: float, most: int
    ) -> tuple[list[OverturningPoint], str]:
        """Points of the boundary on one side of a point, and why there are no more."""
        followed: list[OverturningPoint] = []
        step = self.step
        while len(followed) < most:
            if not self.contains(self.scaled(point) + step * self.along(point, sign)):
                return followed, "left what is within"
            following = self.next(point, sign, step)
            if following is not None:
                followed.append(following)
                point, step = following, min(1.5 * step, self.step)
            elif step > 0.01 * self.step:
                step *= 0.5
            else:
                return followed, "the boundary between these fates ends"
        return followed, f"{most} points"

    def next(self, point: OverturningPoint, sign: float, step: float) -> OverturningPoint | None:
        """The point one step on, or None where the fates are others or the boundary bends more."""
        along = self.along(point, sign)
        across = sign * np.array([along[1], -along[0]])
        ahead = self.scaled(point) + step * along
        low, span = self.box[:, 0], self.box[:, 1] - self.box[:, 0]
        for width in step * np.array([0.001, 0.01, 0.1]):
            start, end = (low + span * (ahead + side * width * across) for side in (-1.0, 1.0))
            line = _Line(self.case, self.names, start, end, self.options)
            if line.fates == self.fates:
                try:
                    following = line.point(self.accuracy)
                except ValueError:
                    return None
                return following if self.along(following, sign) @ along > _STRAIGHT else None
        return None


_STRAIGHT = math.cos(0.2)
"""A boundary turns by no more in a step."""
