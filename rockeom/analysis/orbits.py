"""Periodic motions under shaking that repeats itself: where they are, and whether they last.

    import rockeom as rk
    from rockeom import analysis

    block = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    shaking = rk.GroundMotion.harmonic(1.5, period=0.6, duration=1.2)
    stroboscope = analysis.StroboscopicMap(block, shaking, period=0.6)
    settled = stroboscope.points({"theta": 0.05}, cycles=100)[-1]
    orbit = stroboscope.orbit(settled)
    orbit.multipliers, orbit.stable

A motion is looked at once a period T of the ground, as by a stroboscope: P takes the state at one
look to that at the next (Poincare's map). A motion of k periods is a fixed point of P k times
over. Near it a small difference is multiplied by the matrix A of the derivatives of P k times
over, whose eigenvalues are Floquet's multipliers: the motion lasts if all are inside the unit
circle. As a parameter changes, a multiplier that leaves the circle through -1 doubles the period;
one through +1 ends the motion, or breaks its symmetry.

Of a structure without a preferred side under a_g(t + T/2) = -a_g(t), a motion that is its own
mirror image half a period later cannot double its period unless a second condition happens to be
met: A is the square of the same matrix for half a period, and a real square has an eigenvalue -1
only as one of two. The symmetry breaks first (Swift and Wiesenfeld 1984).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import numbers, positive

if TYPE_CHECKING:
    from rockeom.motion import GroundMotion
    from rockeom.numeric.impact import ImpactLaw
    from rockeom.numeric.options import SolverOptions
    from rockeom.numeric.structures import Structure

_DIFFERENCE = 1e-5
"""Of a state, in parts of its largest value in a cycle, for derivatives: truncation and the noise
of the integration are both about 1e-9 of them."""

_REACH = 0.2
"""How far an orbit may be from the one followed before, in parts of its size, to be the same."""


@dataclass(frozen=True)
class PeriodicOrbit:
    """A motion that repeats itself after `cycles` periods of the ground.

    state (n,) at the time zero of the ground's motion, in the order of `states`. multipliers (n,)
    complex, the largest first, after all the cycles; derivative A (n, n), whose eigenvalues they
    are. size (n,) : the largest absolute value of each state in the motion. residual : how far the
    motion is from closing, in parts of it.
    """

    states: tuple[str, ...]
    state: np.ndarray
    cycles: int
    derivative: np.ndarray
    size: np.ndarray
    residual: float

    @property
    def multipliers(self) -> np.ndarray:
        found = np.linalg.eigvals(self.derivative).astype(complex)
        return found[np.lexsort((-found.imag, -np.abs(found)))]

    @property
    def stable(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return bool(np.abs(self.multipliers).max() < 1)

    @property
    def initial(self) -> dict[str, float]:
        """The state by name, as `simulate` takes it."""
        return dict(zip(self.states, self.state.tolist(), strict=True))


@dataclass(frozen=True)
class StroboscopicMap:
    """The state of a structure one period of the ground after another.

    motion repeats itself with the `period` [s], from time zero on, and is given for two of them at
    least; impact as for `simulate`. states : those that are followed, all of the structure if none
    are named. What is not followed starts in each cycle as `simulate` starts it, mostly at zero. A
    permanent extension that no cycle changes has the multiplier 1, and an orbit for each value:
    leave it out for the orbits without one. options : tolerances of 1e-12, 1e-14 if not given.

    Each cycle is a simulation of its own. One that does not reach its end, because the structure
    falls, is an ArithmeticError.
    """

    structure: Structure
    motion: GroundMotion
    period: float
    impact: ImpactLaw | None = None
    states: tuple[str, ...] = ()
    options: SolverOptions | None = None

    def __post_init__(self) -> None:
        (period,) = positive("StroboscopicMap", period=self.period)
        known = self.structure.states
        unknown = [name for name in self.states if name not in known]
        if unknown:
            raise ValueError(
                f"StroboscopicMap: states has {unknown[0]!r}: choose among {', '.join(known)}"
            )
        if self.motion.duration < 2 * period * (1 - 1e-12):
            raise ValueError(
                f"StroboscopicMap: the motion lasts {self.motion.duration} s: give two periods of "
                f"{period} s, or more"
            )
        early = period * np.linspace(0.03, 0.97, 12)
        now, later = (self.motion.acceleration(t) for t in (early, early + period))
        if np.abs(later - now).max() > 1e-6 * self.motion.peak:
            raise ValueError(
                f"StroboscopicMap: period is {period} s: the motion does not repeat itself after it"
            )
        if not self.states:
            object.__setattr__(self, "states", known)
        if self.options is None:
            from rockeom.numeric.options import SolverOptions

            object.__setattr__(self, "options", SolverOptions(rtol=1e-12, atol=1e-14))

    def points(self, initial: Mapping[str, float] | ArrayLike, cycles: int) -> np.ndarray:
        """States (cycles + 1, n) at the starts of the cycles, `initial` first.

        initial : by name, what is not named being zero, or (n,) in the order of `states`.
        """
        found = [self._vector(initial)]
        for _ in range(cycles):
            found.append(self._cycle(found[-1])[0])
        return np.array(found)

    def derivative(self, state: Mapping[str, float] | ArrayLike, cycles: int = 1) -> np.ndarray:
        """(n, n) derivatives of the state after `cycles` by that before, by central differences."""
        x, product = self._vector(state), np.eye(len(self.states))
        for _ in range(cycles):
            after, size = self._cycle(x)
            columns = []
            for step in np.diag(_DIFFERENCE * np.where(size > 0, size, 1.0)):
                ahead, behind = self._cycle(x + step)[0], self._cycle(x - step)[0]
                columns.append((ahead - behind) / (2 * step.sum()))
            product = np.column_stack(columns) @ product
            x = after
        return product

    def orbit(
        self,
        guess: Mapping[str, float] | ArrayLike,
        cycles: int = 1,
        tolerance: float = 1e-9,
        iterations: int = 20,
    ) -> PeriodicOrbit:
        """The periodic motion near a guess, stable or not, by Newton's method.

        guess : as `initial` of `points`. cycles : of its period; a motion of fewer cycles repeats
        itself after these too, and may be what is found. tolerance : of the residual.
        Raises ArithmeticError where no orbit is found.
        """
        x = self._vector(guess)
        for _ in range(iterations):
            after, size = x, np.zeros(len(x))
            for _ in range(cycles):
                after, largest = self._cycle(after)
                size = np.maximum(size, largest)
            scale = np.where(size > 0, size, 1.0)
            residual = float((np.abs(after - x) / scale).max())
            a = self.derivative(x, cycles)
            if residual <= tolerance:
                return PeriodicOrbit(self.states, x, cycles, a, size, residual)
            # where a multiplier is 1 the map says nothing of that direction: no step along it
            left, stretch, right = np.linalg.svd((np.eye(len(x)) - a) * scale / scale[:, None])
            gains = np.divide(1.0, stretch, out=np.zeros_like(stretch), where=stretch > 1e-8)
            x = x + scale * (right.T @ (gains * (left.T @ ((after - x) / scale))))
        raise ArithmeticError(
            f"StroboscopicMap.orbit: no motion of {cycles} cycles within {iterations} steps of "
            f"Newton's method, the residual is {residual:.1e}: give a closer guess, such as the "
            "last of `points`; at resonance without damping there may be none"
        )

    def _vector(self, state: Mapping[str, float] | ArrayLike) -> np.ndarray:
        if isinstance(state, Mapping):
            unknown = [name for name in state if name not in self.states]
            if unknown:
                raise ValueError(
                    f"StroboscopicMap: unknown state {unknown[0]!r}; it follows "
                    f"{', '.join(self.states)}"
                )
            state = [state.get(name, 0.0) for name in self.states]
        (vector,) = numbers("StroboscopicMap", state=state)
        if vector.shape != (len(self.states),):
            raise ValueError(
                f"StroboscopicMap: a state has the shape {vector.shape}: give one number for each "
                f"of {', '.join(self.states)}"
            )
        return vector

    def _cycle(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The state after a cycle, and the largest size of each state in it."""
        from rockeom.numeric.simulate import simulate

        run = simulate(
            self.structure,
            self.motion,
            impact=self.impact,
            initial=dict(zip(self.states, x.tolist(), strict=True)),
            duration=self.period,
            options=self.options,
        )
        if run.outcome.label not in ("completed", "came to rest"):
            raise ArithmeticError(f"StroboscopicMap: no cycle from {x}: {run.outcome.sentence}")
        columns = [run.states.index(name) for name in self.states]
        return run.end[columns], np.abs(run.steps.powers[:, 0, columns]).max(axis=0)


def continued_orbits(
    stroboscope: Callable[[float], StroboscopicMap],
    values: Sequence[float] | np.ndarray,
    guess: Mapping[str, float] | ArrayLike,
    cycles: int = 1,
) -> list[PeriodicOrbit]:
    """One orbit followed through the values of a parameter.

    stroboscope : makes the map of a value. values : in steps so small that an orbit is a good
    guess for the next; after the first two, the guess is extrapolated. guess, cycles : of the
    first, as for `StroboscopicMap.orbit`.

    Stops, with fewer orbits than values, where Newton's method finds no orbit, or only one that is
    not near the last: at a fold, where this orbit meets another and both end, or because the steps
    are too long.
    """
    found: list[PeriodicOrbit] = []
    for index, value in enumerate(values):
        at: Mapping[str, float] | ArrayLike = found[-1].state if found else guess
        if len(found) > 1:
            ratio = (value - values[index - 1]) / (values[index - 1] - values[index - 2])
            at = found[-1].state + ratio * (found[-1].state - found[-2].state)
        try:
            found.append(_next_orbit(stroboscope(value), at, found[-1] if found else None, cycles))
        except ArithmeticError:
            if not found:
                raise
            break
    return found


def bifurcation_value(
    stroboscope: Callable[[float], StroboscopicMap],
    between: tuple[float, float],
    guess: Mapping[str, float] | ArrayLike,
    cycles: int = 1,
    multiplier: int = -1,
    tolerance: float = 1e-7,
) -> float:
    """Value of a parameter at which a multiplier of an orbit is -1, its period doubles, or +1.

    stroboscope : makes the map of a value. between : two values, on either side. guess : of the
    orbit at the first, cycles : of its period, as for `StroboscopicMap.orbit`. multiplier : -1 or
    1. tolerance : of the value, in its own unit; for 1 the orbit itself is ill determined near
    there.

    Raises ValueError where the multiplier does not pass it in between, once or an odd number of
    times, ArithmeticError where the orbit is lost.
    """
    from scipy.optimize import brentq  # takes long to import

    if multiplier not in (-1, 1):
        raise ValueError(f"bifurcation_value: multiplier is {multiplier}: give -1 or 1")
    first, last = numbers("bifurcation_value", first=between[0], last=between[1])
    orbits = {float(first): stroboscope(float(first)).orbit(guess, cycles)}

    def beyond(value: float) -> float:
        if value not in orbits:
            nearest = min(orbits, key=lambda other: abs(other - value))
            known = orbits[nearest]
            orbits[value] = _next_orbit(stroboscope(value), known.state, known, cycles)
        a = orbits[value].derivative
        return float(np.linalg.det(a - multiplier * np.eye(len(a))))

    for value in np.linspace(first, last, 9):  # so that the last is reached in short steps
        beyond(float(value))
    ends = [beyond(float(first)), beyond(float(last))]
    if ends[0] * ends[1] > 0:
        raise ValueError(
            f"bifurcation_value: between {first} and {last} no multiplier passes {multiplier}: "
            "follow them with `continued_orbits`"
        )
    return float(brentq(beyond, float(first), float(last), xtol=tolerance))


def _next_orbit(
    stroboscope: StroboscopicMap,
    guess: Mapping[str, float] | ArrayLike,
    previous: PeriodicOrbit | None,
    cycles: int,
) -> PeriodicOrbit:
    """The orbit near a guess; ArithmeticError if it is none that the previous one grew into."""
    orbit = stroboscope.orbit(guess, cycles)
    if previous is not None:
        reach = np.abs(orbit.state - previous.state) - _REACH * previous.size
        if reach.max() > 0:
            raise ArithmeticError(
                f"the orbit is lost: from {previous.state} Newton's method went to {orbit.state}"
            )
    return orbit
