"""Branches of periodic motions, stable or not, as a parameter changes, and their bifurcations.

    def at(beta):
        motion = rk.GroundMotion.harmonic(beta, period=0.6, duration=1.2)
        return dynamics.StroboscopicMap(block, motion, period=0.6, mirrored=True)

    branch = dynamics.orbit_branch(at, between=(1.0, 2.0), guess=settled)
    branch.values, branch.stable
    for found in branch.bifurcations:
        print(found.kind, found.value)
    other = branch.switched(branch.bifurcations[0])

The parameter is any number that the function uses to make the map: of the ground's motion, of the
structure, of the impact law. The function is called with a `Dual` of it, which calculates as a
number does, and so the derivative by it is exact, too.

States x of all cycles and the parameter are unknown together, z = (x, value); the motion closes on
a curve of them, which is followed along its own length (pseudo-arclength continuation, Keller
1977), so that a fold is no end. Between two points of the curve a function that changes its sign
locates each bifurcation:

    fold               the direction of the curve has no part along the parameter; multiplier +1
    branch point       the Jacobian with the direction as a last row is singular: another branch
                       crosses, and as a rule breaks the symmetry; multiplier +1
    period doubling    det(A + I) = 0, multiplier -1
    symmetry breaking  the same, of a mirrored map after an odd number of half periods
    grazing            an event at which velocities jump appears or vanishes. The motion is not
                       smooth beyond, and the branch ends; halving the step finds where.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.dynamics.orbits import GrazingError, PeriodicOrbit, Shooting, StroboscopicMap
from rockeom.numbers.checks import InputError, numbers, positive, require
from rockeom.numbers.dual import Dual
from rockeom.sweeps.unfinished import Unfinished, part_for_users

FEIGENBAUM = 4.669201609102990
"""The limit of the ratio of distances between one period doubling and the next."""

FLIPS = ("symmetry breaking", "period doubling")
"""Bifurcations with a multiplier -1, behind which a motion needs twice the cycles."""

_CLOSED = 1e-10
"""Residual of a motion that counts as closed."""

_CORRECTIONS = 8
"""Steps of Newton's method after which a shorter step along the branch is tried."""

_INTERRUPTED = "it was interrupted"
_SHORTEST = 1e-10
"""Step along a branch, in parts of it, below which the branch has ended."""

_INSIDE = 1e-9
"""Part of their range by which values may pass a bound, for rounding."""

_AT_THE_LOOK = 1e-6
"""Time between an event and the start of a cycle, in parts of the cycle, that counts as zero."""

_MOST = 1000
"""Motions of a branch."""

_BEND = 0.95
"""Least cosine of the angle between directions at both ends of a step."""

_BESIDE = 5e-3
"""Distance along a branch from a branch point at which the branch is evaluated."""

_CORNER = 0.2
"""The same of the first step to another branch, which may leave at an angle."""

_REACH = 0.2
"""How far an orbit may be from the one followed before, in parts of its size, to be the same."""

Family = Callable[[Any], StroboscopicMap]
"""Makes the map of a value of the parameter, which is a float or a `Dual`."""


@dataclass(frozen=True)
class Bifurcation:
    """Place at which the motions of a branch change.

    Parameters
    ----------
    kind : str
        Kind of change, such as "period doubling".
    value : float
        Value of the parameter there.
    orbit : PeriodicOrbit
        Motion there.
    """

    kind: str
    value: float
    orbit: PeriodicOrbit

    def __repr__(self) -> str:
        return f"<Bifurcation: {self.kind} of a {self.orbit.order} orbit at {self.value:.10g}>"


@dataclass(frozen=True, eq=False)
class OrbitBranch:
    """Motions that grow into one another as a parameter changes.

    An interrupt (Ctrl-C) returns what is done; `orbit_branch` continues it from the last value and
    the `PeriodicOrbit.looks` of the last orbit.

    Parameters
    ----------
    values : ndarray
        Values (k,) of the parameter, which may go back and forth.
    orbits : tuple of PeriodicOrbit
        Motion at each value.
    bifurcations : tuple of Bifurcation
        Bifurcations in the order in which they were passed; they are among the motions.
    ended : str
        Why the branch was not followed further.
    family : callable
        Function that makes the map of a value.
    between : tuple of (float, float)
        Values of the parameter between which the branch was followed.
    tolerance : float, optional
        Accuracy of a bifurcation's place, in parts of the range.
    """

    values: np.ndarray
    orbits: tuple[PeriodicOrbit, ...]
    bifurcations: tuple[Bifurcation, ...]
    ended: str
    family: Family
    between: tuple[float, float]
    tolerance: float = 1e-10

    def __repr__(self) -> str:
        passed = [f"{one.kind} at {one.value:.9g}" for one in self.bifurcations]
        return (
            f"<OrbitBranch: {len(self.values)} motions from {self.values[0]:.6g} to "
            f"{self.values[-1]:.6g}; {', '.join((*passed, self.ended))}>"
        )

    @property
    def interrupted(self) -> bool:
        """Whether a keyboard interrupt ended the branch, which can be continued."""
        return self.ended == _INTERRUPTED

    @property
    def stable(self) -> np.ndarray:
        """(k,) whether each motion is stable; at a bifurcation rounding decides."""
        return np.array([orbit.stable for orbit in self.orbits])

    @property
    def multipliers(self) -> np.ndarray:
        """(k, n) complex, of each motion, the largest first."""
        return np.array([orbit.multipliers for orbit in self.orbits])

    def at(self, value: float) -> PeriodicOrbit:
        """Motion at a value of the parameter, by Newton's method from the nearest one.

        A branch that folds has several.

        Parameters
        ----------
        value : float
            Value of the parameter.

        Returns
        -------
        PeriodicOrbit
            Motion there.

        Raises
        ------
        ValueError
            For a value that the branch does not reach.
        """
        if not self.values.min() <= value <= self.values.max():
            raise InputError("value", value, "at").so(
                f"the branch goes from {self.values.min():.6g} to {self.values.max():.6g}"
            )
        near = self.orbits[np.abs(self.values - value).argmin()]
        return self.family(value).orbit(near.looks, near.cycles)

    def at_impacts(self, name: str) -> np.ndarray:
        """State just before the impacts of each motion.

        Parameters
        ----------
        name : str
            Name of the state.

        Returns
        -------
        ndarray
            Values (k, m), NaN where a motion has fewer than m impacts.
        """
        rows = [orbit.at_impacts(name) for orbit in self.orbits]
        table = np.full((len(rows), max(map(len, rows))), np.nan)
        for row, values in zip(table, rows, strict=True):
            row[: len(values)] = values
        return table

    @part_for_users
    def switched(
        self,
        at: Bifurcation,
        between: tuple[float, float] | None = None,
        step: float = 0.02,
        until: Sequence[str] = (),
    ) -> OrbitBranch:
        """Branch that begins at a bifurcation of this one, followed away from it.

        Parameters
        ----------
        at : Bifurcation
            A period doubling or a break of symmetry, behind which the motions have twice the
            cycles, or a branch point.
        between : tuple of (float, float), optional
            Values that are not left; those of this branch if not given.
        step : float, optional
            Longest step, as for `orbit_branch`.
        until : sequence of str, optional
            Kinds of bifurcation at which to stop, as for `orbit_branch`.

        Returns
        -------
        OrbitBranch
            The other branch.

        Raises
        ------
        ValueError
            For another kind of bifurcation.

        Notes
        -----
        The branch leaves along the eigenvector of the multiplier -1 or +1, on one of the two ways,
        which are one motion a cycle later, or two mirror images.
        """
        if at.kind not in (*FLIPS, "branch point"):
            raise InputError("at", of="switched").says(
                f"at a {at.kind} no other branch begins: choose a period doubling, a symmetry "
                "breaking or a branch point"
            )
        between = self.between if between is None else between
        start, leaves = _leaving(self.family, at)
        follower = _Follower(self.family, between, start, at.value, self.tolerance)
        way = np.append(leaves.ravel() / follower.scale[:-1], 0.0)
        shot = follower.shot(follower.z)
        first = _Point(
            follower.z, way / np.linalg.norm(way), follower.jacobian(shot),
            follower.plain.closed(shot), crossing=True,
        )  # fmt: skip
        return _followed(follower, first, between, step, tuple(until))


@part_for_users
def orbit_branch(
    stroboscope: Family,
    between: tuple[float, float],
    guess: Mapping[str, float] | ArrayLike,
    cycles: int = 1,
    step: float = 0.02,
    until: Sequence[str] = (),
    tolerance: float = 1e-10,
) -> OrbitBranch:
    """Branch of periodic motions, followed from one value of a parameter towards another.

    Parameters
    ----------
    stroboscope : callable
        Function that makes the map of a value; it is called with a float for the first motion, then
        with a `Dual`.
    between : tuple of (float, float)
        First value and the one to go to, beyond neither of which the branch is followed; a branch
        that folds may come back to the first.
    guess : dict of str to float or array_like
        Guess of the first motion, as for `StroboscopicMap.orbit`.
    cycles : int, optional
        Number of cycles of the first motion.
    step : float, optional
        Longest step, in parts of the branch: of the range of values and of the size of the motion.
    until : sequence of str, optional
        Kinds of bifurcation at the first of which to stop.
    tolerance : float, optional
        Accuracy of a bifurcation's place, in parts of the range.

    Returns
    -------
    OrbitBranch
        Motions, bifurcations, and why the branch ended.

    Raises
    ------
    ArithmeticError
        Where there is no first motion.
    ValueError
        For two equal values, and a step or a tolerance that is not positive.
    """
    first, last = (float(v) for v in numbers("orbit_branch", first=between[0], last=between[1]))
    positive("orbit_branch", step=step, tolerance=tolerance)
    require(first != last, "orbit_branch", "between", between, "give two values that differ")
    start = stroboscope(first).orbit(guess, cycles).looks
    follower = _Follower(stroboscope, (first, last), start, first, tolerance)
    towards = np.append(np.zeros(start.size), np.sign(last - first))
    begun = follower.corrected(follower.z, towards)
    point = begun._replace(way=follower.way(begun.jacobian, towards))
    return _followed(follower, point, (first, last), step, tuple(until))


class _Point(NamedTuple):
    """A motion of a branch: scaled unknowns z, the direction of the curve there, the motion.

    jacobian (k n, k n + 1) : of the scaled gaps by z. crossing : whether it is a bifurcation at
    which branches cross, so that a multiplier is 1.
    """

    z: np.ndarray
    way: np.ndarray
    jacobian: np.ndarray
    orbit: PeriodicOrbit
    crossing: bool = False


class _Follower:
    """The equations of a branch: all gaps of the shooting in the unknowns z, scaled to about 1."""

    def __init__(
        self, family: Family, between: tuple[float, float], states: np.ndarray, value: float,
        tolerance: float,
    ) -> None:  # fmt: skip
        self.family, self.shape, self.tolerance = family, states.shape, tolerance
        self.jumps, self.bounds, self.plain = -1, between, family(value)
        size = self._shot(states, value).scale
        of_states = np.tile(size, len(states)) * math.sqrt(states.size)
        self.scale = np.append(of_states, abs(between[1] - between[0]))
        self.rows = np.tile(size, len(states))
        self.z = np.append(states.ravel(), value) / self.scale

    def value(self, z: np.ndarray) -> float:
        """The value of the parameter; a bound, where they differ by rounding alone."""
        value = float(z[-1] * self.scale[-1])
        near = min(self.bounds, key=lambda bound: abs(bound - value))
        return near if abs(near - value) < 1e-14 * abs(near) else value

    def shot(self, z: np.ndarray) -> Shooting:
        """The shooting from z; ArithmeticError where it has not the events of the branch."""
        shot = self._shot((z * self.scale)[:-1].reshape(self.shape), self.value(z))
        if self.jumps < 0:
            self.jumps = shot.jumps
        more = shot.jumps - self.jumps
        if more:
            raise GrazingError(f"{abs(more)} events {'appear' if more > 0 else 'vanish'}")
        return shot

    def _shot(self, states: np.ndarray, value: float) -> Shooting:
        n = self.shape[1]
        return self.family(Dual(value, np.eye(n + 1)[n])).shooting(states, more=1)

    def jacobian(self, shot: Shooting) -> np.ndarray:
        """(k n, k n + 1) derivatives of the scaled gaps by z."""
        return shot.jacobian() * self.scale / self.rows[:, None]

    @staticmethod
    def way(jacobian: np.ndarray, before: np.ndarray) -> np.ndarray:
        """Unit vector along the branch, forward as seen from the one before."""
        bordered = np.vstack([jacobian, before])
        tangent = Shooting.solve(bordered, np.append(np.zeros(len(before) - 1), 1.0))
        return tangent / np.linalg.norm(tangent)

    def corrected(self, anchor: np.ndarray, way: np.ndarray) -> _Point:
        """The motion of the branch in the plane through the anchor across the way.

        Raises ArithmeticError where Newton's method does not find it.
        """
        z = anchor
        for _ in range(_CORRECTIONS):
            shot = self.shot(z)
            jacobian = self.jacobian(shot)
            if shot.residual <= _CLOSED:
                return _Point(z, self.way(jacobian, way), jacobian, self.plain.closed(shot))
            right = np.append(shot.gaps.ravel() / self.rows, way @ (z - anchor))
            z = z - Shooting.solve(np.vstack([jacobian, way]), right)
        raise ArithmeticError(f"the residual is still {shot.residual:.1e}")

    def tests(self, point: _Point) -> dict[str, float]:
        """Functions that change their sign at bifurcations, by kind."""
        orbit = point.orbit
        half = orbit.mirror is not None and orbit.cycles % 2 == 1
        values = {FLIPS[0] if half else FLIPS[1]: np.prod(orbit.multipliers + 1).real}
        if point.crossing:
            return values
        bordered = np.vstack([point.jacobian, point.way])
        return {"fold": point.way[-1], "branch point": np.linalg.det(bordered)} | values

    def next(self, here: _Point, length: float, start: _Point | None) -> tuple[_Point, str]:
        """The next point, and why it is the last, if it is.

        Raises ArithmeticError where a shorter step is to be tried.
        """
        ahead = here.z + length * here.way
        for bound in self.bounds:
            if self._beyond(ahead, bound):
                return self._landed(here, ahead, bound), f"{bound:.12g} was reached"
        there = self.corrected(ahead, here.way)
        if there.way @ here.way < (_CORNER if here.crossing else _BEND):
            raise ArithmeticError("the branch bends within the shortest step")
        for bound in self.bounds:
            if self._beyond(there.z, bound):
                return self._landed(here, there.z, bound), f"{bound:.12g} was reached"
        if start is not None and np.linalg.norm(there.z - start.z) < length:
            return there, "it came back to its start"
        return there, ""

    def _beyond(self, z: np.ndarray, bound: float) -> bool:
        """Whether a point is outside by more than rounding."""
        inwards = sum(self.bounds) - 2 * bound
        return (z[-1] * self.scale[-1] - bound) * np.sign(inwards) < -_INSIDE * self.scale[-1]

    def _landed(self, here: _Point, there: np.ndarray, bound: float) -> _Point:
        """The point of a bound, which the step from here to there passes."""
        part = (bound / self.scale[-1] - here.z[-1]) / (there[-1] - here.z[-1])
        across = np.append(np.zeros(len(here.z) - 1), 1.0)
        point = self.corrected(here.z + part * (there - here.z), across)
        z = np.append(point.z[:-1], bound / self.scale[-1])
        return point._replace(z=z, way=self.way(point.jacobian, here.way))

    def passed(self, here: _Point, there: _Point) -> list[tuple[Bifurcation, _Point]]:
        """The bifurcations between two points, in their order."""
        before, after = self.tests(here), self.tests(there)
        changed = [kind for kind, value in before.items() if value * after[kind] < 0]
        if "branch point" in changed and "fold" in changed:  # it turns where it meets another
            changed.remove("fold")
        located = [(kind, self._located(kind, here, there)) for kind in changed]
        located.sort(key=lambda one: here.way @ one[1].z)
        return [(Bifurcation(kind, self.value(at.z), at.orbit), at) for kind, at in located]

    def _located(self, kind: str, start: _Point, end: _Point) -> _Point:
        """Where between two points a test changes its sign."""
        from scipy.optimize import brentq  # takes long to import

        length = float(start.way @ (end.z - start.z))
        points = {0.0: start, length: end}

        def test(along: float) -> float:
            if along not in points:
                points[along] = self.corrected(start.z + along * start.way, start.way)
            return self.tests(points[along])[kind]

        if kind == "branch point":
            return self._crossed(start, brentq(test, 0.0, length, xtol=_BESIDE))
        return points[brentq(test, 0.0, length, xtol=self.tolerance)]

    def _crossed(self, start: _Point, near: float) -> _Point:
        """The branch point near a distance from a point, by a polynomial through six around it.

        Where branches cross the equations are singular, so that close to there they say nothing.
        """
        beside = _BESIDE * np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
        around = [self.corrected(start.z + (near + s) * start.way, start.way) for s in beside]
        rows = [np.append(point.z, self.tests(point)["branch point"]) for point in around]
        powers = np.polynomial.polynomial.polyfit(beside, rows, 5)
        roots = np.polynomial.polynomial.polyroots(powers[:, -1])
        at = roots[np.abs(roots).argmin()].real
        z = np.polynomial.polynomial.polyval(at, powers[:, :-1])
        shot = self.shot(z)
        return _Point(z, start.way, self.jacobian(shot), self.plain.closed(shot))

    def end(self, here: _Point, lost: ArithmeticError) -> tuple[list[Bifurcation], str]:
        """The bifurcation at the end of a branch, behind which no step succeeds however short."""
        value = self.value(here.z)
        if not isinstance(lost, GrazingError):
            return [], f"it was lost at {value:.12g}: {lost}"
        if here.orbit.nearest_event() < _AT_THE_LOOK:
            return [], (
                f"at {value:.12g} an event falls together with the look: begin the motion of the "
                "ground at another phase angle"
            )
        return [Bifurcation("grazing", value, here.orbit)], f"a grazing was reached: {lost}"


def _followed(
    follower: _Follower, first: _Point, between: tuple[float, float], step: float,
    until: tuple[str, ...],
) -> OrbitBranch:  # fmt: skip
    """The branch from its first point on, as long as it goes."""
    points, bifurcations = [first], list[Bifurcation]()
    length, ended = step / 10, ""
    while not ended:
        here = points[-1]
        try:
            there, ended = follower.next(here, length, first if len(points) > 10 else None)
            passed = follower.passed(here, there)
        except ArithmeticError as error:
            length, ended = length / 2, ""
            if length < _SHORTEST:
                grazing, ended = follower.end(here, error)
                bifurcations += grazing
                points = [*_apart(points, step / 1000), here]
            continue
        except KeyboardInterrupt:
            ended = _INTERRUPTED
            continue
        bifurcations += [bifurcation for bifurcation, _ in passed]
        points += [*(point for _, point in passed), there]
        if any(b.kind in until for b in bifurcations):
            ended = f"a {bifurcations[-1].kind} was reached"
        elif not ended and len(points) >= _MOST:
            ended = f"{_MOST} motions were found"
        length = min(step, 1.5 * length)
    branch = OrbitBranch(
        np.array([follower.value(p.z) for p in points]), tuple(p.orbit for p in points),
        tuple(bifurcations), ended, follower.family, between, follower.tolerance,
    )  # fmt: skip
    if branch.interrupted:
        raise Unfinished(branch)
    return branch


def _apart(points: list[_Point], distance: float) -> list[_Point]:
    """The points but for the last ones, which ever shorter steps left near to the end."""
    while len(points) > 1 and np.linalg.norm(points[-1].z - points[-2].z) < distance:
        points = points[:-1]
    return points[:-1]


def _leaving(family: Family, at: Bifurcation) -> tuple[np.ndarray, np.ndarray]:
    """States (k, n) at a bifurcation as the other branch counts them, and where it leaves to."""
    shot = family(at.value).shooting(at.orbit.looks)
    values, vectors = np.linalg.eig(shot.derivative)
    sign = -1.0 if at.kind in FLIPS else 1.0
    leaves = [vectors[:, np.abs(values - sign).argmin()].real]
    for one in shot.by_state[:-1]:
        leaves.append(one @ leaves[-1])
    if sign > 0:
        return shot.x, np.array(leaves)
    return np.concatenate([shot.x, shot.x]), np.concatenate([leaves, -np.array(leaves)])


@dataclass(frozen=True)
class Cascade:
    """Period doublings, each of the motions that the one before leaves.

    Parameters
    ----------
    bifurcations : tuple of Bifurcation
        Doublings in their order; of a mirrored map the break of symmetry comes first.
    """

    bifurcations: tuple[Bifurcation, ...]

    @property
    def values(self) -> np.ndarray:
        """(k,) of the parameter at each."""
        return np.array([one.value for one in self.bifurcations])

    @property
    def ratios(self) -> np.ndarray:
        """(k - 2,) of the distances between one and the next; they tend to Feigenbaum's 4.6692."""
        gaps = np.diff(self.values)
        return gaps[:-1] / gaps[1:]

    @property
    def accumulations(self) -> np.ndarray:
        """Values (k - 1,) at which they pile up, from each and the one before by Feigenbaum's
        limit.

        The limit is exact for a geometric series. The distance of the last from the one before
        estimates the error.
        """
        return self.values[1:] + np.diff(self.values) / (FEIGENBAUM - 1)


def period_doublings(
    stroboscope: Family,
    between: tuple[float, float],
    guess: Mapping[str, float] | ArrayLike,
    cycles: int = 1,
    number: int = 4,
) -> Cascade:
    """First period doublings of a cascade, by following each branch to where the next begins.

    Parameters
    ----------
    stroboscope : callable
        Function that makes the map of a value.
    between : tuple of (float, float)
        First value of the parameter and the one to go to.
    guess : dict of str to float or array_like
        Guess of the first motion, as for `StroboscopicMap.orbit`.
    cycles : int, optional
        Number of cycles of the first motion.
    number : int, optional
        Number of doublings; there are fewer where a branch has none in between. The time it takes
        doubles with each.

    Returns
    -------
    Cascade
        Doublings in their order.
    """
    branch = orbit_branch(stroboscope, between, guess, cycles, step=0.1, until=FLIPS)
    doublings: list[Bifurcation] = []
    while flips := [one for one in branch.bifurcations if one.kind in FLIPS]:
        doublings.append(flips[0])
        if sum(one.kind == FLIPS[1] for one in doublings) == number:
            break
        here, last = doublings[-1].value, float(between[1])
        if len(doublings) > 1:  # the next is likely to be half as far as this end
            ahead = here + (here - doublings[-2].value) / 2
            last = min(ahead, last, key=lambda value: abs(value - here))
        branch = branch.switched(doublings[-1], (here, last), step=0.1, until=FLIPS)
    return Cascade(tuple(doublings))


def bifurcation_value(
    stroboscope: Family,
    between: tuple[float, float],
    guess: Mapping[str, float] | ArrayLike,
    cycles: int = 1,
    multiplier: int = -1,
    tolerance: float = 1e-9,
) -> float:
    """Value of a parameter at which a multiplier of an orbit is -1 (its period doubles) or +1.

    It is the first on the branch from one value to another, see `orbit_branch`.

    Parameters
    ----------
    stroboscope : callable
        Function that makes the map of a value.
    between : tuple of (float, float)
        The two values.
    guess : dict of str to float or array_like
        Guess of the orbit at the first value, as for `StroboscopicMap.orbit`.
    cycles : int, optional
        Number of cycles of its period.
    multiplier : int, optional
        -1 or 1.
    tolerance : float, optional
        Accuracy of the value, in its own unit.

    Returns
    -------
    float
        Value of the parameter.

    Raises
    ------
    ValueError
        Where the multiplier does not pass this value in between.
    ArithmeticError
        Where the orbit is lost.
    """
    require(multiplier in (-1, 1), "bifurcation_value", "multiplier", multiplier, "give -1 or 1")
    kinds = FLIPS if multiplier < 0 else ("fold", "branch point")
    parts = tolerance / abs(between[1] - between[0])
    branch = orbit_branch(
        stroboscope, between, guess, cycles, step=0.1, until=kinds, tolerance=parts
    )
    for one in branch.bifurcations:
        if one.kind in kinds:
            return one.value
    sentence = f"between {between[0]} and {between[1]} no multiplier passes {multiplier}"
    if branch.values[-1] != between[1]:
        raise ArithmeticError(f"bifurcation_value: {sentence}, and {branch.ended}")
    raise ValueError(f"bifurcation_value: {sentence}: follow them with `orbit_branch`")


def continued_orbits(
    stroboscope: Callable[[float], StroboscopicMap],
    values: Sequence[float] | np.ndarray,
    guess: Mapping[str, float] | ArrayLike,
    cycles: int = 1,
) -> list[PeriodicOrbit]:
    """Follow one orbit through given values of a parameter; `orbit_branch` chooses them itself.

    Parameters
    ----------
    stroboscope : callable
        Function that makes the map of a value.
    values : sequence of float or ndarray
        Values in steps so small that an orbit is a good guess for the next; after the first two,
        the guess is extrapolated.
    guess : dict of str to float or array_like
        Guess of the first orbit, as for `StroboscopicMap.orbit`.
    cycles : int, optional
        Number of cycles of its period.

    Returns
    -------
    list of PeriodicOrbit
        Orbits. They are fewer than the values where Newton's method converges to no orbit, or only
        to one that is not near the last: at a fold, where this orbit meets another and both end, or
        because the steps are too long.
    """
    orbits: list[PeriodicOrbit] = []
    for index, value in enumerate(values):
        at: Mapping[str, float] | ArrayLike = orbits[-1].looks if orbits else guess
        if len(orbits) > 1:
            ratio = (value - values[index - 1]) / (values[index - 1] - values[index - 2])
            at = orbits[-1].looks + ratio * (orbits[-1].looks - orbits[-2].looks)
        try:
            orbit = stroboscope(value).orbit(at, cycles)
        except ArithmeticError:
            if not orbits:
                raise
            break
        if orbits and (np.abs(orbit.state - orbits[-1].state) > _REACH * orbits[-1].size).any():
            break
        orbits.append(orbit)
    return orbits
