"""How likely a structure of random parameters fails: by first order, and by Monte Carlo.

    from scipy import stats

    block = rk.RigidBlock(half_width=0.1, half_height=0.6)
    case = rk.Case(block, record, rk.EnergyRatio(0.85), duration=12.0)
    random = {"half_width": stats.norm(0.1, 0.003), "r": stats.uniform(0.8, 0.1),
              "scale": stats.lognorm(0.4, scale=2.0)}
    found = analysis.risk.reliability_of(case, random)  # of overturning
    found.index, found.probability, found.design_point, found.importance
    analysis.risk.monte_carlo(case, random, 10_000).interval()

The first-order method searches the values nearest to the medians, in standard deviations, with
which the structure fails, and replaces the boundary there by a plane. Derivatives are those of
`rk.tangents`.
"""

import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol, Self

import numpy as np
from scipy.special import ndtr

from rockeom.analysis.random_parameters import RandomParameters, in_words
from rockeom.analysis.risk.fragility import proportion_interval
from rockeom.analysis.sweeps import FALLS, exceedances, outcome_labels, unanswered
from rockeom.numbers.checks import InputError, require
from rockeom.numbers.dual import Dual
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.sweeps.case_numbers import function_of
from rockeom.sweeps.dataset import Sweep
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many
from rockeom.sweeps.sensitivity import answer
from rockeom.sweeps.tangents import tangents

_LEAST = 1e-300
"""Least distance of the boundary, where the medians lie on it."""
REACH = 6.0
"""Range of a search around the medians [standard deviations]: a probability of 1e-9 lies beyond."""
RAYS = 32
"""Places on a ray at which a structure is simulated: a narrower window of failure is missed."""
ACCURACY = 1e-12
"""Accuracy of the distance to a boundary [standard deviations]."""
SETTLED = 1e-4
"""Angle between the design point and the normal of the boundary that counts as zero [rad].

Its square is the largest relative error of the index.
"""
APART = 0.01
"""Difference of two motions that diverge at a boundary, in parts of the overturning rotation."""
NEWTON = 1e-5
"""Step of Newton's rule from where the next one would be its square [standard deviations]."""
MOST_RAYS = 30
"""Most rays of a search: a corner at the nearest point of the boundary needs ever more."""
ROUNDS = 60
"""Most steps of any search in this module."""
MOST_DOUBLINGS = 6
"""Most doublings of the duration of a motion that lingers near the unstable equilibrium."""


@dataclass(frozen=True, eq=False)
class FirstOrder:
    """Nearest failure, and the probability of failure by first order.

    Parameters
    ----------
    index : float
        Reliability index beta, the distance of the design point from the medians [standard
        deviations]; negative where the medians fail.
    design_point : dict of str to float
        Likeliest values with which it fails, by name.
    deviates : ndarray
        The same as standard normal deviates (k,), in the order of the names.
    importance : dict of str to float
        Parts, of a sum of 1, of the parameters in the variance of the linearised limit state, by
        name: alpha squared.
    angle : float
        Angle between the design point and the normal of the boundary [rad], 0 at a nearest point.
    settled : bool
        Whether the point is a nearest one, to ``SETTLED``. If not, the boundary has a corner there
        or is broken up, and the index is that of the nearest point of the search.
    runs : int
        Number of evaluations of the limit state, or of simulations.
    """

    index: float
    design_point: dict[str, float]
    deviates: np.ndarray
    importance: dict[str, float]
    angle: float
    settled: bool
    runs: int

    @property
    def probability(self) -> float:
        """Phi(-index): exact if the boundary is a plane of the normal deviates."""
        return float(ndtr(-self.index))

    def __repr__(self) -> str:
        lines = [f"index {self.index:.4f}, probability {self.probability:.3g} by first order"]
        if not self.settled:
            lines[0] += f" (not settled: {self.angle:.2g} rad off the normal)"
        for name, value in self.design_point.items():
            lines.append(f"{name} = {value:.5g}, importance {self.importance[name]:.3f}")
        return "\n".join(lines)


@dataclass(frozen=True, eq=False)
class MonteCarlo:
    """Probability of failure by counting.

    Parameters
    ----------
    failures : int
        Number of samples that failed.
    number : int
        Number of samples.
    left_out : int
        Number of samples without an answer, which are not counted.
    sweep : Sweep
        Dataset of `simulate_many`, a case a sample, with the values drawn as coordinates.
    """

    failures: int
    number: int
    left_out: int
    sweep: Sweep

    @property
    def probability(self) -> float:
        """The part that failed."""
        return self.failures / self.number

    def interval(self, level: float = 0.95) -> tuple[float, float]:
        """Bounds of the probability, of Clopper and Pearson.

        Parameters
        ----------
        level : float, optional
            Probability, at least, that the bounds hold the true one.

        Returns
        -------
        lower : float
            Lower bound.
        upper : float
            Upper bound.

        Raises
        ------
        ValueError
            For a level that does not lie between 0 and 1.
        """
        low, high = proportion_interval(self.failures, self.number, level)
        return float(low), float(high)

    def __repr__(self) -> str:
        low, high = self.interval()
        lost = unanswered(outcome_labels(self.sweep))
        least, most = self.failures, self.failures + self.left_out
        told = (
            f"{self.failures} of {self.number} fail: probability {self.probability:.3g}, "
            f"{low:.3g} to {high:.3g} (95 %)"
        )
        none, all_ = (f"{n / (self.number + self.left_out):.3g}" for n in (least, most))
        left_out = f"; {lost} left out: {none} if none of them fails, {all_} if all do"
        return told + left_out * bool(lost)


def first_order_reliability(
    limit_state: Callable[..., Any], random: Mapping[str, Any], *, reach: float = REACH
) -> FirstOrder:
    """Reliability of any smooth limit state of independent random parameters.

    Parameters
    ----------
    limit_state : callable
        Function of the parameters, by name, as `rk.Dual`, which returns one, positive where the
        structure is safe. Where it fails without a derivative, -math.inf.
    random : dict of str to distribution
        Distribution of each parameter, by name: a continuous distribution of scipy.stats, frozen.
    reach : float, optional
        Largest distance of a failure in the search [standard deviations].

    Returns
    -------
    FirstOrder
        Index, design point and probability of failure.

    Raises
    ------
    ValueError
        For distributions that are none, for a limit state that does not change at the medians,
        jumps or has no boundary within reach, and for derivatives that are not finite.

    Notes
    -----
    The rule of Hasofer and Lind (1974), for distributions as by Rackwitz and Fiessler (1978), kept
    on the boundary: rays from the medians meet it by Newton's rule on the exact gradient, and turn
    towards its normal, by BFGS, as long as it comes nearer. The result is one nearest point; there
    may be others.

    Examples
    --------
    >>> from scipy import stats
    >>> from rockeom.analysis import risk
    >>> random = {"strength": stats.norm(5.0, 0.6), "load": stats.norm(2.0, 0.8)}
    >>> first = risk.first_order_reliability(lambda strength, load: strength - load, random)
    >>> round(first.index, 4)  # 3/1
    3.0
    """
    space = RandomParameters.of("first_order_reliability", random)
    require(reach > 0, "first_order_reliability", "reach", reach, "it must be positive")
    surface = _Smooth(space, limit_state, reach)
    if not surface.changes:
        raise ValueError(
            "first_order_reliability: no parameter changes the limit state at the medians, so that "
            "they do not tell where it fails: choose one that does, or use `monte_carlo`"
        )
    return _nearest(surface, surface.towards_failure())


def reliability_of(
    case: Case | Callable[..., Case],
    random: Mapping[str, Any],
    *,
    demand: str | None = None,
    limit: float | None = None,
    reach: float = REACH,
    options: SolverOptions | None = None,
) -> FirstOrder:
    """Probability that a structure of random parameters overturns or exceeds a limit, by first
    order.

    Parameters
    ----------
    case : Case or callable
        A `Case`, of whose numbers the names of `random` are some, as in `simulate_many`; or a
        function of the parameters, by name, that returns one and calculates with numbers and with
        `rk.Dual`.
    random : dict of str to distribution
        Distribution of each parameter, by name: a continuous distribution of scipy.stats, frozen.
    demand : str, optional
        State, energy, displacement or uplift whose largest size is to stay below the limit;
        whatever overturns exceeds it. If neither is given, overturning is meant.
    limit : float, optional
        Limit of the demand [its unit].
    reach : float, optional
        Largest distance of a failure in the search [standard deviations].
    options : SolverOptions, optional
        Choices of the integration.

    Returns
    -------
    FirstOrder
        Index, design point and probability of failure.

    Raises
    ------
    ValueError
        As `first_order_reliability`, and for a motion without an answer.

    Notes
    -----
    A largest size has a derivative, where one crest remains the highest; of overturning there is no
    margin that would have one, since the peak goes to the unstable equilibrium with a vertical
    slope and does not exist beyond. Its boundary is searched on rays from the medians instead: the
    first change of fate of 32 places, narrowed down to 1e-12. With the values there the structure
    lingers about the unstable equilibrium, and the gradient of its rotation, by then large along
    nothing but the normal of the boundary, is that normal. Islands of overturning narrower than a
    place are missed, as are other nearest points; compare the result with `monte_carlo`.

    Examples
    --------
    With a case and the distributions `random`::

        risk.reliability_of(case, random)                              # overturning
        risk.reliability_of(case, random, demand="theta", limit=0.05)  # a rotation of 0.05 rad
    """
    space = RandomParameters.of("reliability_of", random)
    case = function_of(case, space.names)
    require(reach > 0, "reliability_of", "reach", reach, "it must be positive")
    condition = _Condition.of("reliability_of", demand, limit)
    fates = partial(_Fates, space, case, condition, reach, options)
    if demand is None or limit is None:
        overturning = _Overturning(fates())
        return _nearest(overturning, overturning.fates.towards_failure())
    surface = _Smooth(space, _Margin(case, demand, limit, options), reach)
    # a structure that does not move at the medians has no derivatives there
    start = surface if surface.changes else fates()
    return _nearest(surface, start.towards_failure())


def monte_carlo(
    case: Case | Callable[..., Case],
    random: Mapping[str, Any],
    number: int = 10_000,
    *,
    demand: str | None = None,
    limit: float | None = None,
    seed: int = 0,
    **how: Any,
) -> MonteCarlo:
    """Number of failures among structures with parameters drawn at random.

    Parameters
    ----------
    case : Case or callable
        Case or function of the parameters, as for `reliability_of`.
    random : dict of str to distribution
        Distribution of each parameter, by name, as for `reliability_of`.
    number : int, optional
        Number of samples.
    demand : str, optional
        Any quantity whose largest size is to stay below the limit; overturning if not given.
    limit : float, optional
        Limit of the demand [its unit].
    seed : int, optional
        Seed of the draws; the same seed draws the same.
    **how : object
        Other arguments of `simulate_many`: ``options``, and ``sweep_options``, in which a store of
        finished cases lets the same call continue after a stop.

    Returns
    -------
    MonteCarlo
        Probability with its interval.

    Raises
    ------
    ValueError
        For bad arguments, and where no case gave an answer.

    Notes
    -----
    Cases that gave no answer do not count; `MonteCarlo.left_out` is their number. An interrupt is
    raised, as some of the samples are no sample.
    """
    space = RandomParameters.of("monte_carlo", random)
    require(number >= 1, "monte_carlo", "number", number, "draw one sample at least")
    condition = _Condition.of("monte_carlo", demand, limit)
    u = np.random.default_rng(seed).standard_normal((number, len(space.names)))
    kept = condition.quantities(function_of(case, space.names)(**space.values(u[0])))
    sweep = simulate_many(case, space.table(u), quantities=kept, **how)
    fails, answered = condition.of_sweep(sweep)
    if not answered.any():
        raise ValueError(
            f"monte_carlo: none of {number} cases gave an answer; the outcome of the first is "
            f"{outcome_labels(sweep).values[0]!r}"
        )
    return MonteCarlo(int(fails.sum()), int(answered.sum()), int((~answered).sum()), sweep)


# -- the nearest point of a surface


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector)


class _Surface(Protocol):
    """The boundary of failure around the medians, as rays from there meet it."""

    space: RandomParameters
    side: int
    reach: float

    @property
    def runs(self) -> int:
        """Number of motions, or evaluations of a limit state."""

    def distance(self, ray: np.ndarray) -> float:
        """Along a unit vector (k,), to where failure begins or, from within, ends; inf if not."""

    def normal(self, ray: np.ndarray) -> np.ndarray:
        """(k,) of unit length and outwards, where the last ray that was asked for meets it."""


def _nearest(surface: _Surface, ray: np.ndarray) -> FirstOrder:
    """Where the surface is nearest, of rays that begin with one that meets it.

    Minimised is the logarithm of the distance. The first step along its gradient leads to the
    normal: the step of Hasofer, Lind, Rackwitz and Fiessler. BFGS learns the curvature from there.
    """
    from scipy.optimize import minimize  # takes long to import

    met: list[tuple[float, np.ndarray, np.ndarray]] = []

    def logarithm(ray: np.ndarray) -> tuple[float, np.ndarray]:
        if len(met) == MOST_RAYS:
            raise _EnoughError
        along = _unit(ray)
        distance = surface.distance(along)
        if math.isinf(distance):
            return distance, np.zeros(len(ray))
        normal = surface.normal(along)
        met.append((distance, along, normal))
        slope = (along - normal / (normal @ along)) / np.linalg.norm(ray)
        return math.log(max(distance, _LEAST)), slope

    how = {"gtol": 0.1 * SETTLED, "norm": 2, "maxiter": ROUNDS}
    with np.errstate(invalid="ignore"), suppress(_EnoughError):  # invalid where a ray meets nothing
        minimize(logarithm, ray, jac=True, method="BFGS", options=how)
    if not met:
        raise _none_found(surface.reach, "on the likeliest ray")
    distance, along, normal = min(met, key=lambda of: of[0])
    angle = 2.0 * math.asin(min(0.5 * float(np.linalg.norm(along - normal)), 1.0))
    names = surface.space.names
    return FirstOrder(
        index=surface.side * distance,
        design_point=surface.space.values(distance * along),
        deviates=distance * along,
        importance=dict(zip(names, (along**2).tolist(), strict=True)),
        angle=angle,
        settled=angle <= SETTLED,
        runs=surface.runs,
    )


class _EnoughError(Exception):
    """The search has used all its rays."""


def _none_found(reach: float, where: str) -> ValueError:
    return ValueError(
        f"no failure was found within {reach:g} standard deviations of the medians, looked for "
        f"{where}: the index is larger, or it fails elsewhere; give a larger reach, or use "
        "`monte_carlo`"
    )


# -- a smooth limit state


class _Smooth:
    """The surface on which a limit state of `rk.Dual` is zero."""

    def __init__(
        self, space: RandomParameters, limit_state: Callable[..., Any], reach: float
    ) -> None:
        self.space, self.limit_state, self.reach = space, limit_state, reach
        self.runs = 0
        self.first = self._at(np.zeros(len(space.names)))
        self.side = 1 if self.first[0] >= 0 else -1
        self.met = np.zeros(len(space.names))
        self.slope = self.first[1]

    @property
    def changes(self) -> bool:
        """Whether the limit state changes about the medians."""
        return bool(np.any(self.first[1]))

    def towards_failure(self) -> np.ndarray:
        """The first of Newton's steps down the gradient whose ray meets a boundary."""
        u, (value, slope) = np.zeros(len(self.space.names)), self.first
        for _ in range(ROUNDS):
            if not np.any(slope):
                break
            u = u - (value or self.side) * slope / (slope @ slope)
            u = u * min(1.0, self.reach / float(np.linalg.norm(u)))
            if math.isfinite(self.distance(_unit(u))):
                return _unit(u)
            value, slope = self._at(u)
        raise _none_found(self.reach, "down the gradient")

    def _at(self, u: np.ndarray) -> tuple[float, np.ndarray]:
        """The limit state and its gradient (k,) at deviates u (k,)."""
        self.runs += 1
        values = self.space.duals(u)
        limit_state = self.limit_state(**values)
        if isinstance(limit_state, Dual):
            value, slope = float(limit_state.value), limit_state.tangent
        else:
            value, slope = float(limit_state), np.zeros(len(u))
        if value == -math.inf:
            return value, np.zeros(len(u))
        if not (math.isfinite(value) and np.all(np.isfinite(slope))):
            raise ValueError(
                f"the limit state is {value} with the gradient {slope} at "
                f"{in_words(self.space.values(u))}: it must be finite there"
            )
        return value, slope

    def normal(self, ray: np.ndarray) -> np.ndarray:
        return -self.side * _unit(self.slope)

    def distance(self, ray: np.ndarray) -> float:
        """The distance by Newton's rule, kept between places before and beyond the boundary."""
        low, high, s = 0.0, math.inf, self._expected(ray)
        for _ in range(ROUNDS):
            value, slope = self.first if s == 0.0 else self._at(s * ray)
            value, along = self.side * value, self.side * float(slope @ ray)
            step = -value / along if along < 0 and math.isfinite(value) else math.nan
            if abs(step) <= NEWTON * (1.0 + s):
                self.met, self.slope = (s + step) * ray, slope
                return s + step
            low, high = (s, high) if value > 0 else (low, s)
            if low == self.reach:
                return math.inf
            if high - low <= 1e-10 * (1.0 + low):
                raise ValueError(
                    f"the limit state jumps {low:.6g} standard deviations from the medians: a "
                    "demand that is exceeded by overturning alone is `reliability_of` overturning"
                )
            s = _within(low, high, s + step, self.reach)
        raise ValueError(f"the limit state has no clear zero between {low:g} and {high:g} deviates")

    def _expected(self, ray: np.ndarray) -> float:
        """Where a ray meets the plane that the boundary was like where the last one met it."""
        along = float(self.slope @ ray)
        distance = float(self.slope @ self.met) / along if along else 0.0
        return distance if 0.0 < distance < self.reach else float(np.linalg.norm(self.met))


def _within(low: float, high: float, wanted: float, reach: float) -> float:
    """The place wanted if it lies between; otherwise one that halves, or goes on outwards."""
    if low < wanted < high:
        return min(wanted, reach)
    if high < math.inf:
        return 0.5 * (low + high)
    return min(2.0 * low + 0.5, reach)


@dataclass(frozen=True)
class _Margin:
    """1 - peak/limit of a state, as a limit state."""

    case: Callable[..., Case]
    demand: str
    limit: float
    options: SolverOptions | None

    def __call__(self, **parameters: Dual) -> Any:
        propagated = tangents(self.case(**parameters), self.options)
        if propagated.response.outcome == FALLS:
            return -math.inf
        peak = answer(f"peak {self.demand}", propagated)
        if propagated.grazing and not np.all(np.isfinite(peak.tangent)):
            raise ValueError(f"the peak of {self.demand} has no derivatives: {propagated.grazing}")
        return 1.0 - peak / self.limit


# -- overturning: a motion has no margin, only a fate


@dataclass(frozen=True)
class _Condition:
    """Condition of failure: a structure overturns, or its demand reaches a limit as well."""

    demand: str | None = None
    limit: float | None = None

    @classmethod
    def of(cls, where: str, demand: str | None, limit: float | None) -> Self:
        if (limit is None) != (demand is None):
            raise InputError("limit", limit, where).give("demand and limit, or neither")
        if limit is not None:
            require(limit > 0, where, "limit", limit, "it must be positive, in the demand's unit")
        return cls(demand, limit)

    def quantities(self, one: Case) -> tuple[str, ...]:
        """Quantities that `simulate_many` must record of the cases; one : any of them."""
        recorded = self.demand is None or self.demand in one.structure.states
        return () if recorded else (str(self.demand),)

    def of_sweep(self, sweep: Sweep) -> tuple[np.ndarray, np.ndarray]:
        """(n,) which cases of a sweep fail, and (n,) which gave an answer."""
        fails, answered, _ = exceedances(sweep, self.demand, self.limit)
        return fails.values, answered.values


class _Fates:
    """Whether structures fail, and the first places on rays from the medians where it changes."""

    def __init__(
        self,
        space: RandomParameters,
        case: Callable[..., Case],
        condition: _Condition,
        reach: float,
        options: SolverOptions | None,
    ) -> None:
        self.space, self.case, self.condition = space, case, condition
        self.reach, self.options = reach, options
        self.runs = 0
        self.failed = bool(self._fail(np.zeros((1, len(space.names))))[0])

    def _fail(self, u: np.ndarray) -> np.ndarray:
        """(n,) whether structures with the deviates u (n, k) fail."""
        self.runs += len(u)
        kept = self.condition.quantities(self.case(**self.space.values(u[0])))
        sweep = simulate_many(
            self.case, self.space.table(u), quantities=kept, options=self.options,
            sweep_options=SweepOptions(lanes=False, progress=False),
        )  # fmt: skip
        fails, answered = self.condition.of_sweep(sweep)
        if not answered.all():
            row = int(np.argmin(answered))
            raise ValueError(
                f"with {in_words(self.space.values(u[row]))} the motion gives no answer: its "
                f"outcome is {outcome_labels(sweep).values[row]!r}"
            )
        return fails

    def first_changes(self, rays: np.ndarray) -> np.ndarray:
        """(n, 2) last place as at the medians and first one that is not; inf, inf without any."""
        places = np.linspace(0.0, self.reach, RAYS + 1)
        u = places[None, 1:, None] * rays[:, None, :]
        changed = self._fail(u.reshape(-1, rays.shape[1])).reshape(len(rays), RAYS) != self.failed
        index = np.argmax(changed, axis=1)
        changes = np.stack([places[index], places[index + 1]], axis=1)
        return np.where(changed.any(axis=1)[:, None], changes, math.inf)

    def towards_failure(self) -> np.ndarray:
        """The ray to begin with: the normal of a plane through where the axes meet the surface."""
        k = len(self.space.names)
        rays = np.concatenate([np.eye(k), -np.eye(k)])
        first = self.first_changes(rays)[:, 1]
        if np.all(np.isinf(first)):
            raise _none_found(self.reach, "where one parameter changes alone")
        plane = _unit(rays.T @ (1.0 / first))
        nearer = self.first_changes(plane[None])[0, 1] <= first.min()
        return plane if nearer else rays[int(np.argmin(first))]


class _Overturning:
    """The boundary of overturning, about which a motion lingers at the unstable equilibrium."""

    def __init__(self, fates: _Fates) -> None:
        self.fates, self.space, self.reach = fates, fates.space, fates.reach
        self.side = -1 if fates.failed else 1
        self.own_runs = 0
        self.ends = (0.0, 0.0)

    @property
    def runs(self) -> int:
        return self.fates.runs + self.own_runs

    def distance(self, ray: np.ndarray) -> float:
        """The distance by halves, between places of many motions at once."""
        low, high = self.fates.first_changes(ray[None])[0].tolist()
        while high - low > ACCURACY * (1.0 + low) and high < math.inf:
            middle = 0.5 * (low + high)
            if (self._run(middle * ray).outcome == FALLS) == self.fates.failed:
                low = middle
            else:
                high = middle
        self.ends = low, high
        return low

    def normal(self, ray: np.ndarray) -> np.ndarray:
        """Gradient of the rotation that falls, when the motions on both sides have parted."""
        low, high = self.ends
        stands, falls = (high, low) if self.fates.failed else (low, high)
        time, duration, name = self._parting(stands * ray, falls * ray)
        case = self.fates.case(**self.space.duals(stands * ray))
        propagated = tangents(replace(case, duration=duration), self.fates.options)
        self.own_runs += 1
        slope = propagated.at(np.array([time]))[0, propagated.response.states.index(name)]
        if not np.all(np.isfinite(slope)):
            raise ValueError(f"the boundary of overturning has no normal: {propagated.grazing}")
        return _unit(slope) * np.sign(slope @ ray)

    def _run(self, u: np.ndarray, duration: float | None = None) -> Response:
        self.own_runs += 1
        case = self.fates.case(**self.space.values(u))
        if duration is not None:
            case = replace(case, duration=duration)
        return simulate(**vars(case), options=self.fates.options)

    def _parting(self, stands: np.ndarray, falls: np.ndarray) -> tuple[float, float, str]:
        """When both motions differ clearly [s], how long they must last, and in what."""
        duration = self._run(stands).duration
        for _ in range(MOST_DOUBLINGS):
            one, other = self._run(stands, duration), self._run(falls, duration)
            name = other.overturned
            t = one.t[one.t <= other.t[-1]]
            apart = np.abs(one.at(t)[name] - other.at(t)[name])
            clear = apart > APART * one.structure.falls[name]
            if clear.any():
                return float(t[np.argmax(clear)]), duration, name
            duration *= 2.0
        raise ValueError(f"motions on both sides of overturning do not part in {duration:g} s")
