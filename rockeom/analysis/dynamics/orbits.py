"""Periodic motions under periodic shaking, and their stability.

    import rockeom as rk
    from rockeom.analysis import dynamics

    block = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    shaking = rk.GroundMotion.harmonic(1.5, period=0.6, duration=1.2)
    stroboscope = dynamics.StroboscopicMap(block, shaking, period=0.6)
    settled = stroboscope.points({"theta": 0.05}, cycles=100)[-1]
    orbit = stroboscope.orbit(settled)
    orbit.multipliers, orbit.stable

A motion is looked at once a period T of the ground, as by a stroboscope: P takes the state at one
look to that at the next (Poincare's map). A motion of k periods is a fixed point of P k times
over. Near it a small difference is multiplied by the matrix A of the derivatives of P k times
over, whose eigenvalues are Floquet's multipliers: the motion is stable if all are inside the unit
circle. `rockeom.tangents` propagates the derivatives through the impacts. As a parameter
changes, a multiplier that leaves the circle through -1 doubles the period; one through +1 ends the
motion, or breaks its symmetry. `orbit_branch` follows motions to there.

In a structure without a preferred side under a_g(t + T/2) = -a_g(t), a motion that is its own
mirror image half a period later cannot double its period unless a second condition happens to be
met: A is the square of the same matrix for half a period, and a real square has an eigenvalue -1
only as one of two. The symmetry breaks first (Swift and Wiesenfeld 1984). A map that is `mirrored`
looks every half period, at every second look into a mirror: such a motion is a fixed point of it,
and where its symmetry breaks a multiplier is -1.
"""

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rockeom.codes import SWITCH
from rockeom.motion import GroundMotion
from rockeom.numbers.checks import InputError, numbers, positive
from rockeom.numbers.dual import Dual, directions, value_of
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.sweeps.tangents import tangents

_SINGULAR = 1e-8
"""Singular value, in parts of the states, below which Newton's method makes no step."""

_SAME = 1e-6
"""States that differ by less, in parts of their size, repeat themselves."""


class GrazingError(ArithmeticError):
    """A motion with a grazing event, which appears or vanishes, so that it has no derivative."""


@dataclass(frozen=True, eq=False)
class Shooting:
    """Several states, each integrated over a cycle: multiple shooting.

    Parameters
    ----------
    x : ndarray
        States (k, n), each of which should become the next, and the last the first.
    after : ndarray
        States a cycle later (k, n).
    by_state : ndarray
        Derivatives (k, n, n) of these by the state.
    by_value : ndarray
        Derivatives (k, n, m) by the m directions of the map's own duals.
    runs : tuple of Response
        The k motions.
    size : ndarray
        Largest absolute value of each state in them (n,).
    """

    x: np.ndarray
    after: np.ndarray
    by_state: np.ndarray
    by_value: np.ndarray
    runs: tuple[Response, ...]
    size: np.ndarray

    @property
    def gaps(self) -> np.ndarray:
        """(k, n) by how much each state misses the next."""
        return self.after - np.roll(self.x, -1, axis=0)

    @property
    def scale(self) -> np.ndarray:
        """(n,) the size, 1 for a state that stays zero."""
        return np.where(self.size > 0, self.size, 1.0)

    @property
    def residual(self) -> float:
        """The largest gap, in parts of the size."""
        return float(np.abs(self.gaps / self.scale).max())

    @property
    def derivative(self) -> np.ndarray:
        """A (n, n), of the state after all the cycles by that before."""
        product = np.eye(self.x.shape[1])
        for one in self.by_state:
            product = one @ product
        return product

    def jacobian(self) -> np.ndarray:
        """Derivatives of the gaps by the states and by the map's directions.

        Returns
        -------
        ndarray
            Matrix (k n, k n + m).
        """
        k, n = self.x.shape
        blocks = np.zeros((k, n, k, n))
        for i, one in enumerate(self.by_state):
            blocks[i, :, i] += one
            blocks[i, :, (i + 1) % k] -= np.eye(n)
        return np.hstack([blocks.reshape(k * n, k * n), self.by_value.reshape(k * n, -1)])

    def closer(self) -> np.ndarray:
        """States after a step of Newton's method.

        Where a multiplier is 1 the map says nothing of that direction: no step along it.

        Returns
        -------
        ndarray
            States (k, n).
        """
        k, n = self.x.shape
        scale = np.tile(self.scale, k)
        matrix = self.jacobian()[:, : k * n] * scale / scale[:, None]
        return self.x - (scale * self.solve(matrix, self.gaps.ravel() / scale)).reshape(k, n)

    @staticmethod
    def solve(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
        """Solve matrix x = right without the directions that a nearly singular matrix leaves
        undetermined.

        Parameters
        ----------
        matrix : ndarray
            Matrix (n, n), scaled to be of the order of 1.
        right : ndarray
            Right side (n,), scaled likewise.

        Returns
        -------
        ndarray
            Solution x (n,), the shortest of all where singular values are below 1e-8.
        """
        with contextlib.suppress(np.linalg.LinAlgError):
            inverse = np.linalg.inv(matrix)
            if np.linalg.norm(inverse) < 1 / _SINGULAR:
                return inverse @ right
        left, stretch, across = np.linalg.svd(matrix)
        gains = np.divide(1.0, stretch, out=np.zeros_like(stretch), where=stretch > _SINGULAR)
        return across.T @ (gains * (left.T @ right))

    @property
    def jumps(self) -> int:
        """How many changes of contact there are at which a velocity may jump."""
        return sum(int((run.events.columns[1][:, 0] != SWITCH).sum()) for run in self.runs)


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """Motion that repeats itself after some cycles of its map.

    Parameters
    ----------
    states : tuple of str
        Names of the states.
    state : ndarray
        State (n,) at the time zero of the ground's motion, in the order of `states`.
    cycles : int
        Number of cycles after which the motion repeats itself.
    derivative : ndarray
        Derivative A (n, n) of the state after all the cycles by that before, whose eigenvalues are
        the `multipliers`.
    size : ndarray
        Largest absolute value of each state in the motion (n,).
    residual : float
        How far the motion is from closing, in parts of its size.
    looks : ndarray
        States at the start of each cycle (cycles, n).
    runs : tuple of Response
        Motion in each cycle.
    mirror : ndarray, optional
        For a mirrored map, -1 for each state of the structure that changes its sign in the mirror,
        else 1 (N,); None for another map.
    """

    states: tuple[str, ...]
    state: np.ndarray
    cycles: int
    derivative: np.ndarray
    size: np.ndarray
    residual: float
    looks: np.ndarray = field(repr=False)
    runs: tuple[Response, ...] = field(repr=False)
    mirror: np.ndarray | None = field(default=None, repr=False)

    @property
    def multipliers(self) -> np.ndarray:
        """Eigenvalues of the derivative (n,), complex, the largest first."""
        values = np.linalg.eigvals(self.derivative).astype(complex)
        return values[np.lexsort((-values.imag, -np.abs(values)))]

    @property
    def stable(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return bool(np.abs(self.multipliers).max() < 1)

    @property
    def initial(self) -> dict[str, float]:
        """The state by name, as `simulate` takes it."""
        return dict(zip(self.states, self.state.tolist(), strict=True))

    @property
    def symmetric(self) -> bool:
        """Whether it is its own mirror image half of its period later; known of mirrored maps."""
        return self.mirror is not None and self._repeats % 2 == 1

    @property
    def order(self) -> tuple[int, int]:
        """Order (m, n) of Hogan (1989): m impacts to each side in n periods of the ground.

        n is the least: a motion of one period that was sought as one of two is (m, 1). Impacts are
        counted in all and halved, so that the thesis's (1, 1) of Figure 2-12 comes upright twice a
        period.
        """
        cycles = self._repeats
        legs = [run for run, _ in self.legs(cycles)]
        periods = len(legs) if self.mirror is None else len(legs) // 2
        return sum(len(run.impacts) for run in legs) // 2, periods

    def at_impacts(self, name: str) -> np.ndarray:
        """State just before each impact of the motion.

        Parameters
        ----------
        name : str
            Name of the state.

        Returns
        -------
        ndarray
            Values (k,) in time order.
        """
        i = self.runs[0].states.index(name)
        impacts = ((sign[i], impact) for run, sign in self.legs() for impact in run.impacts)
        return np.array([sign * impact.before[name] for sign, impact in impacts])

    def trajectory(self) -> tuple[np.ndarray, np.ndarray]:
        """States of the structure over the whole motion, for drawing.

        Returns
        -------
        t : ndarray
            Times (n,) [s].
        y : ndarray
            States (n, N).
        """
        times, states, start = [], [], 0.0
        for run, sign in self.legs():
            times.append(start + run.t)
            states.append(sign * run.y)
            start += run.duration
        return np.concatenate(times), np.concatenate(states)

    def nearest_event(self) -> float:
        """Time from a look to the event nearest to one, in parts of the cycle.

        Returns
        -------
        float
            Part of the cycle; inf without any event.
        """
        parts = [run.events.columns[0] / run.duration for run in self.runs]
        return float(min((np.minimum(t, 1 - t).min() for t in parts if len(t)), default=np.inf))

    @cached_property
    def _repeats(self) -> int:
        """Cycles of the map after which the looks repeat themselves."""
        scale = np.where(self.size > 0, self.size, 1.0)
        for k in range(1, self.cycles):
            apart = np.abs(self.looks - np.roll(self.looks, -k, axis=0)) / scale
            if self.cycles % k == 0 and apart.max() < _SAME:
                return k
        return self.cycles

    def legs(self, cycles: int | None = None) -> Iterator[tuple[Response, np.ndarray]]:
        """Runs one after the other, each with the factors of its states.

        Parameters
        ----------
        cycles : int, optional
            Number of cycles; those of the orbit if not given. A motion that an odd number of
            mirrored half periods turns into its mirror image needs as many again to repeat itself.

        Yields
        ------
        run : Response
            Motion of a cycle.
        factors : ndarray
            Factors (N,) of its states, 1 or -1.
        """
        cycles = self.cycles if cycles is None else cycles
        mirror = np.ones(len(self.runs[0].states)) if self.mirror is None else self.mirror
        twice = self.mirror is not None and cycles % 2 == 1
        for i in range(2 * cycles if twice else cycles):
            yield self.runs[i % cycles], mirror**i


@dataclass(frozen=True)
class StroboscopicMap:
    """State of a structure one period of the ground after another.

    Each cycle is a simulation of its own. One that does not reach its end, because the structure
    overturns, is an ArithmeticError. The mode at its start follows from the state: shift the
    motion, by its phase angle, so that no impact coincides with the start of a cycle.

    Parameters
    ----------
    structure : Structure
        Structure that is shaken.
    motion : GroundMotion
        Ground motion that repeats itself with the `period`, from time zero on, over two periods at
        least.
    period : float
        Period of the ground [s].
    impact : ImpactLaw, optional
        Impact law, as for `simulate`.
    states : tuple of str, optional
        States that are followed; all of the structure if none are named. Other states start in each
        cycle as `simulate` starts them, mostly at zero. A permanent extension that no cycle changes
        has the multiplier 1, and an orbit for each value: leave it out for the orbits without one.
    options : SolverOptions, optional
        Choices of the integration; tolerances of 1e-12 and 1e-14 if not given.
    mirrored : bool, optional
        Whether a cycle is half a period, and its end is mirrored: all states change their sign but
        those named by `upward`. A symmetric motion then repeats itself after one cycle, one that is
        not after two. For structures and impact laws without a preferred side, and a motion that is
        its own negative half a period later.
    upward : tuple of str, optional
        States that keep their sign in the mirror, such as heights.

    Notes
    -----
    Structure, motion, impact and period may hold duals, whose directions come behind those of the
    states in `shooting`.
    """

    structure: Structure
    motion: GroundMotion
    period: float
    impact: ImpactLaw | None = None
    states: tuple[str, ...] = ()
    options: SolverOptions | None = None
    mirrored: bool = False
    upward: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        states = self.structure.states
        for argument in ("states", "upward"):
            unknown = [name for name in getattr(self, argument) if name not in states]
            if unknown:
                error = InputError(argument, unknown[0], "StroboscopicMap")
                raise error.wrong(f"has {unknown[0]!r}").choose(states)
        self._check_period()
        if not self.states:
            object.__setattr__(self, "states", states)
        if self.options is None:
            object.__setattr__(self, "options", SolverOptions(rtol=1e-12, atol=1e-14))

    def _check_period(self) -> None:
        (period,) = positive("StroboscopicMap", period=value_of(self.period))
        motion = self.motion
        if directions(motion.segments, self.period):  # the same in numbers was looked at
            return
        if motion.duration < 2 * period * (1 - 1e-12):
            raise InputError("motion", of="StroboscopicMap").says(
                f"the motion lasts {motion.duration} s: give two periods of {period} s, or more"
            )
        early = period * np.linspace(0.03, 0.97, 12)
        now, half, later = (motion.acceleration(early + period * k) for k in (0, 0.5, 1))
        if np.abs(later - now).max() > 1e-6 * motion.peak:
            raise InputError("period", period, "StroboscopicMap").so("the motion has another one")
        if self.mirrored and np.abs(half + now).max() > 1e-6 * motion.peak:
            raise InputError("mirrored", True, "StroboscopicMap").says(
                "mirrored, but the motion is not its own negative half a period later: leave "
                "`mirrored` out"
            )

    @property
    def cycle(self) -> float:
        """Time from one look to the next [s]."""
        return self.period / 2 if self.mirrored else self.period

    @property
    def mirror(self) -> np.ndarray:
        """(N,) factor of each state of the structure at the end of a cycle: -1 or 1."""
        turned = [-1.0 if self.mirrored and name not in self.upward else 1.0
                  for name in self.structure.states]  # fmt: skip
        return np.array(turned)

    def points(self, initial: Mapping[str, float] | ArrayLike, cycles: int) -> np.ndarray:
        """States at the starts of the cycles, `initial` first.

        Parameters
        ----------
        initial : dict of str to float or array_like
            States by name, those that are not named being zero, or (n,) in the order of `states`.
        cycles : int
            Number of cycles.

        Returns
        -------
        ndarray
            States (cycles + 1, n).

        Raises
        ------
        ArithmeticError
            Where a cycle does not reach its end.
        """
        states = [self._vector(initial)]
        for _ in range(cycles):
            states.append(self._next(states[-1]))
        return np.array(states)

    def derivative(self, state: Mapping[str, float] | ArrayLike, cycles: int = 1) -> np.ndarray:
        """Derivatives of the state after some cycles by that before, exact to the tolerance.

        Parameters
        ----------
        state : dict of str to float or array_like
            States by name or (n,), as `initial` of `points`.
        cycles : int, optional
            Number of cycles.

        Returns
        -------
        ndarray
            Matrix (n, n).

        Raises
        ------
        GrazingError
            Where an event grazes, so that there are none.
        """
        return self.shooting(self.points(state, cycles)[:-1]).derivative

    def shooting(self, states: ArrayLike, more: int = 0) -> Shooting:
        """Several states, each integrated over a cycle, with the derivatives.

        Parameters
        ----------
        states : array_like
            States (k, n).
        more : int, optional
            Number m of directions of the duals that the map holds, which number n + m.

        Returns
        -------
        Shooting
            States a cycle later, with their derivatives.
        """
        x = np.array([self._vector(one) for one in np.asarray(states)])
        self._check_stands(x)
        n, columns = len(self.states), self._columns
        sign = self.mirror[columns]
        cycles = [self._tangents(one, n + more) for one in x]
        size = np.max(
            [np.abs(f.response.steps.powers[:, 0, columns]).max(axis=0) for f in cycles], 0
        )
        tangents = np.array([sign[:, None] * f.end[columns] for f in cycles])
        after = np.array([sign * f.response.end[columns] for f in cycles])
        runs = tuple(f.response for f in cycles)
        return Shooting(x, after, tangents[:, :, :n], tangents[:, :, n:], runs, size)

    def orbit(
        self,
        guess: Mapping[str, float] | ArrayLike,
        cycles: int = 1,
        tolerance: float = 1e-9,
        iterations: int = 20,
    ) -> PeriodicOrbit:
        """Periodic motion near a guess, stable or not, by Newton's method.

        Parameters
        ----------
        guess : dict of str to float or array_like
            Guess of the state as `initial` of `points`, or (cycles, n) at the start of each cycle.
        cycles : int, optional
            Number of cycles after which the motion closes; a motion of fewer cycles repeats itself
            after these too, and may be the result.
        tolerance : float, optional
            Largest residual.
        iterations : int, optional
            Largest number of iterations.

        Returns
        -------
        PeriodicOrbit
            Motion with its multipliers.

        Raises
        ------
        ArithmeticError
            Where Newton's method converges to no orbit.
        ValueError
            Where a map is mirrored and its structure is not.

        Notes
        -----
        Each cycle is shot by itself (multiple shooting), so that errors do not grow from one to the
        next.
        """
        x = self._start(guess, cycles)
        residual = np.inf
        for _ in range(iterations):
            shot = self.shooting(x)
            residual = shot.residual
            if residual <= tolerance:
                self._check_mirror(shot)
                return self.closed(shot)
            x = shot.closer()
        raise ArithmeticError(
            f"StroboscopicMap.orbit: no motion of {cycles} cycles within {iterations} steps of "
            f"Newton's method, the residual is {residual:.1e}: give a closer guess, such as the "
            "last of `points`; at resonance without damping there may be none"
        )

    def closed(self, shot: Shooting) -> PeriodicOrbit:
        """Orbit of states that meet one another.

        Parameters
        ----------
        shot : Shooting
            States that each become the next.

        Returns
        -------
        PeriodicOrbit
            Motion through them.
        """
        mirror = self.mirror if self.mirrored else None
        return PeriodicOrbit(
            self.states, shot.x[0], len(shot.x), shot.derivative, shot.size, shot.residual,
            shot.x, shot.runs, mirror,
        )  # fmt: skip

    def _start(self, guess: Mapping[str, float] | ArrayLike, cycles: int) -> np.ndarray:
        if not isinstance(guess, Mapping) and np.shape(guess) == (cycles, len(self.states)):
            return np.asarray(guess, dtype=float)
        return self.points(guess, cycles - 1)

    def _check_stands(self, x: np.ndarray) -> None:
        falls = self.structure.falls
        for name in set(self.states) & set(falls):
            largest = np.abs(x[:, self.states.index(name)]).max()
            if largest >= falls[name]:
                raise ArithmeticError(
                    f"StroboscopicMap: no cycle from {name} = {largest:.6g}: it has overturned"
                )

    def _check_mirror(self, shot: Shooting) -> None:
        """Whether the second half of a period is the mirror image of the first from there."""
        if not self.mirrored:
            return
        run = self._simulated(shot.x[0], self.period)
        apart = np.abs(run.end[self._columns] - self._next(self._next(shot.x[0])))
        if (apart / shot.scale).max() > _SAME * max(1.0, np.abs(shot.by_state).max()):
            raise InputError("mirrored", True, "StroboscopicMap").says(
                "mirrored, but the mirror image moves otherwise: name in `upward` the states that "
                "keep their sign, such as heights, or leave `mirrored` out where structure or "
                "impact prefer a side"
            )

    @property
    def _columns(self) -> list[int]:
        return [self.structure.states.index(name) for name in self.states]

    def _vector(self, state: Mapping[str, float] | ArrayLike) -> np.ndarray:
        if isinstance(state, Mapping):
            unknown = [name for name in state if name not in self.states]
            if unknown:
                raise InputError("state", unknown[0], "StroboscopicMap").says(
                    f"unknown state {unknown[0]!r}: it follows {', '.join(self.states)}"
                )
            state = [state.get(name, 0.0) for name in self.states]
        (vector,) = numbers("StroboscopicMap", state=state)
        if vector.shape != (len(self.states),):
            raise InputError("state", of="StroboscopicMap").says(
                f"a state has the shape {vector.shape}: give one number for each of "
                f"{', '.join(self.states)}"
            )
        return vector

    def _named(self, x: Any) -> dict[str, Any]:
        return dict(zip(self.states, x, strict=True))

    def _simulated(self, x: np.ndarray, duration: float) -> Response:
        initial = self._named(x.tolist())
        case = Case(self.structure, self.motion, self.impact, initial, duration)
        run = simulate(case, options=self.options)
        _check_ended(run, x)
        return run

    def _next(self, x: np.ndarray) -> np.ndarray:
        """The state a cycle later."""
        run = self._simulated(x, self.cycle)
        return (self.mirror * run.end)[self._columns]

    def _tangents(self, x: np.ndarray, m: int) -> Any:
        """The cycle from a state, with derivatives in m directions, those of the state first."""
        initial = self._named([Dual(v, e) for v, e in zip(x, np.eye(len(x), m), strict=True)])
        case = Case(self.structure, self.motion, self.impact, initial, self.cycle)
        propagated = tangents(case, self.options)
        _check_ended(propagated.response, x)
        if propagated.grazing:
            raise GrazingError(f"StroboscopicMap: no derivative from {x}: {propagated.grazing}")
        return propagated


def _check_ended(run: Response, x: np.ndarray) -> None:
    if run.outcome not in ("completed", "came to rest"):
        raise ArithmeticError(f"StroboscopicMap: no cycle from {x}: {run.outcome.sentence}")
