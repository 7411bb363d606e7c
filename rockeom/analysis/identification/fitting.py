"""Parameters from tests: what a measurement says of a structure, and how surely.

    import rockeom as rk
    from rockeom import analysis
    from rockeom.analysis import identification

    def released(r):
        start = {"theta": 0.0265}
        return rk.Case(column, rk.GroundMotion.none(3.0), rk.EnergyRatio(r), start)

    found = analysis.fit_free_vibration(released, {"r": 0.8}, peaks=measured, quantity="theta")
    found.values["r"], found.interval("r")  # and found.covariance, found.summary()

`fit` is for any function of some parameters; the others make one of a simulation or of a formula.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.formulas.controlled_wall import RotationCentre
from rockeom.analysis.identification.free_vibration import coefficient_of_determination
from rockeom.analysis.identification.measured import rotation_centre
from rockeom.numbers.arguments import numbers, positive, require
from rockeom.numbers.dual import duals, tangent_of, with_tangent
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.structures.evaluation import filled
from rockeom.sweeps.sensitivity import quantity_of
from rockeom.sweeps.tangents import Tangents, tangents

CONFIDENCE = 0.95
STEP = 1e-4
"""Of a parameter, in parts of its first guess, for derivatives: simulations are known to 1e-9."""
BESIDE = 1e-3
"""Part of a quarter period to both sides of a peak at which its rate is looked at."""
NO_RATIO = 1e-3
"""The least energy ratio that is tried; some models know no impact without rebound."""


@dataclass(frozen=True)
class Fit:
    """Parameters that fit a measurement best, with their confidence.

    values : by name. covariance (k, k), in the order of values. measured, predicted (n,).
    uncertainty (n,) : standard deviation of each measured value; where none was given, the one that
        the residuals leave (known is False then). informative (n,) : which values any parameter
        moves; others, such as the start of a simulation, tell nothing and count nowhere.
    at_bounds : names of parameters that a bound held; their interval says nothing.
    exact : whether the derivatives of the model were given, and not found by central differences.
    """

    values: dict[str, float]
    covariance: np.ndarray
    measured: np.ndarray
    predicted: np.ndarray
    uncertainty: np.ndarray
    known: bool
    informative: np.ndarray
    at_bounds: tuple[str, ...]
    exact: bool = False

    @property
    def degrees_of_freedom(self) -> int:
        """Measured values that tell something, less parameters."""
        return int(self.informative.sum()) - len(self.values)

    @property
    def residuals(self) -> np.ndarray:
        """(n,) measured less predicted."""
        return self.measured - self.predicted

    @property
    def standard_error(self) -> dict[str, float]:
        """Standard deviation of each parameter, by name."""
        return dict(zip(self.values, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))

    def interval(self, name: str, confidence: float = CONFIDENCE) -> tuple[float, float]:
        """Where a parameter lies with that confidence, if the model is right.

        By Student's distribution where the uncertainty was estimated, by the normal one where it
        was given. Raises KeyError for an unknown name, ValueError for a confidence beyond 0 to 1.
        """
        from scipy.stats import norm, t  # takes long to import

        require(
            0 < confidence < 1, "Fit.interval", "confidence", confidence, "give one such as .95"
        )
        place = 0.5 + 0.5 * confidence
        wide = norm.ppf(place) if self.known else t.ppf(place, self.degrees_of_freedom)
        half = float(wide) * self.standard_error[name]
        return self.values[name] - half, self.values[name] + half

    @property
    def correlation(self) -> np.ndarray:
        """(k, k) of the parameters."""
        size = np.sqrt(np.diag(self.covariance))
        return self.covariance / np.outer(size, size)

    @property
    def reduced_chi_square(self) -> float:
        """Mean square of the residuals over their uncertainties; 1 where it was estimated of them.

        Far above 1 the model is not that of the measurement, or the uncertainty is too small: the
        intervals are then too narrow by about its root.
        """
        parts = (self.residuals / self.uncertainty)[self.informative]
        return float(parts @ parts) / max(self.degrees_of_freedom, 1)

    @property
    def rms(self) -> float:
        """Root mean square of the residuals that tell something, in the unit measured."""
        return float(np.sqrt(np.mean(self.residuals[self.informative] ** 2)))

    @property
    def r_squared(self) -> float:
        """Coefficient of determination of the values that tell something."""
        chosen = self.informative
        return coefficient_of_determination(self.measured[chosen], self.predicted[chosen])

    def summary(self, confidence: float = CONFIDENCE) -> str:
        """The parameters in words, a line each."""
        lines = []
        for name, value in self.values.items():
            low, high = self.interval(name, confidence)
            held = " (held by a bound)" if name in self.at_bounds else ""
            lines.append(f"{name} = {value:.5g}, {low:.5g} to {high:.5g}{held}")
        head = f"{100 * confidence:g} % intervals, {int(self.informative.sum())} values:"
        return "\n".join([head, *lines])


def fit(
    model: Callable[..., ArrayLike],
    measured: ArrayLike,
    start: Mapping[str, float],
    *,
    uncertainty: ArrayLike | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    derivatives: Callable[..., ArrayLike] | None = None,
) -> Fit:
    """Least squares: the parameters with which a function comes closest to a measurement.

        identification.fit(lambda k, c: k * x + c, measured=y, start={"k": 1.0, "c": 0.0})

    model : a function of the parameters, by name, that returns one value for each that was
        measured; smooth, at least about the best parameters. measured (n,).
    start : a first guess of each parameter, of the size that it may have.
    uncertainty : standard deviation of the measured values, one or (n,); if not given, one for all
        is estimated from what the fit leaves. bounds : (lowest, highest) of parameters, by name.
    derivatives : a function of the same parameters that returns the derivatives (n, k) of what the
        model returns, k in the order of start; central differences if not given.

    The covariance is that of the linearised model, (J^T J)^-1 with J the derivatives over the
    uncertainties.

    Raises ValueError for bad arguments, for as many parameters as values where the uncertainty must
    be estimated, and for parameters that the values do not tell apart.
    """
    from scipy.optimize import least_squares  # takes long to import

    where = "fit"
    (y,) = numbers(where, measured=measured)
    if y.ndim != 1 or not y.size:
        raise ValueError(f"{where}: measured has the shape {y.shape}: give a list of values")
    if not start:
        raise ValueError(f"{where}: start is empty: give a first guess of each parameter, by name")
    first = np.array([float(numbers(where, **{name: start[name]})[0]) for name in start])
    low, high = _bounds(where, start, bounds)
    known = uncertainty is not None
    (sigma,) = positive(where, uncertainty=1.0 if uncertainty is None else uncertainty)
    if sigma.shape not in ((), y.shape):
        raise ValueError(
            f"{where}: uncertainty has the shape {sigma.shape}, measured {y.shape}: give one "
            "number, or one for each value"
        )
    sigma = np.broadcast_to(sigma, y.shape)
    scale = np.where(first != 0, np.abs(first), 1.0)

    def predicted(z: np.ndarray) -> np.ndarray:
        (found,) = numbers(where, **{"what the model returned": model(**_named(start, z * scale))})
        if found.shape != y.shape:
            raise ValueError(
                f"{where}: the model returned the shape {found.shape}, measured is {y.shape}: "
                "return one value for each that was measured"
            )
        return found

    def slopes_at(z: np.ndarray) -> np.ndarray:
        assert derivatives is not None
        given = derivatives(**_named(start, z * scale))
        (found,) = numbers(where, **{"what derivatives returned": given})
        if found.shape != (len(y), len(first)):
            raise ValueError(
                f"{where}: derivatives returned the shape {found.shape}: return "
                f"{(len(y), len(first))}, a row for each value and a column for each parameter"
            )
        return found * scale / sigma[:, None]

    best = least_squares(
        lambda z: (predicted(z) - y) / sigma, first / scale,
        jac="3-point" if derivatives is None else slopes_at, diff_step=STEP,
        bounds=(low / scale, high / scale), x_scale="jac", xtol=1e-10, ftol=1e-12, gtol=1e-12,
    )  # fmt: skip
    slopes = best.jac / scale
    informative = np.any(slopes != 0, axis=1)
    freedom = int(informative.sum()) - len(first)
    if freedom < 1 and not known:
        raise ValueError(
            f"{where}: {informative.sum()} values that any parameter moves do not give "
            f"{len(first)} parameters and their scatter: measure more, or give the uncertainty"
        )
    inverse = _inverse(where, slopes, tuple(start))
    if not known:
        sigma = np.broadcast_to(np.sqrt(2 * best.cost / freedom), y.shape)
        inverse = inverse * sigma[0] ** 2
    held = best.active_mask != 0
    return Fit(
        values=_named(start, best.x * scale),
        covariance=inverse,
        measured=y,
        predicted=predicted(best.x),
        uncertainty=sigma,
        known=known,
        informative=informative,
        at_bounds=tuple(name for name, at in zip(start, held, strict=True) if at),
        exact=derivatives is not None,
    )


def _named(names: Mapping[str, float], x: np.ndarray) -> dict[str, float]:
    return dict(zip(names, x.tolist(), strict=True))


def _bounds(
    where: str, start: Mapping[str, float], bounds: Mapping[str, tuple[float, float]] | None
) -> tuple[np.ndarray, np.ndarray]:
    given = {} if bounds is None else bounds
    unknown = [name for name in given if name not in start]
    if unknown:
        raise ValueError(
            f"{where}: bounds has {unknown[0]!r}, start has {', '.join(start)}: give bounds of "
            "parameters that are fitted"
        )
    pairs = np.array([given.get(name, (-np.inf, np.inf)) for name in start], dtype=float)
    for name, guess, (low, high) in zip(start, start.values(), pairs, strict=True):
        if not low < guess < high:
            raise ValueError(
                f"{where}: the first guess of {name} is {guess}, its bounds {low} and {high}: "
                "begin between them"
            )
    return pairs[:, 0], pairs[:, 1]


def _inverse(where: str, slopes: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    """(J^T J)^-1; raises ValueError where some change of the parameters moves nothing."""
    size = np.linalg.norm(slopes, axis=0)
    if not size.all():
        lost = names[int(np.argmin(size))]
        raise ValueError(
            f"{where}: {lost} moves none of the values: leave it out, or measure what it moves"
        )
    _, strength, ways = np.linalg.svd(slopes / size, full_matrices=False)
    if strength[-1] < 1e-9 * strength[0]:
        told = ", ".join(n for n, part in zip(names, ways[-1], strict=True) if abs(part) > 0.1)
        raise ValueError(
            f"{where}: the values do not tell {told} apart: fit fewer of them, or measure more"
        )
    half = (ways.T / strength) / size[:, None]
    return half @ half.T


# -- free vibrations


class Swings(NamedTuple):
    """A free vibration: peaks [unit of the quantity] with their times, and crossing times [s].

    peak, peak_time (n,), one on each side in turn, the first one at the release; crossing_time (n,)
    of the passage through zero behind each peak. Where the motion has fewer, peaks are zero and
    times those of its end.
    """

    peak: np.ndarray
    peak_time: np.ndarray
    crossing_time: np.ndarray


def swings(run: Response, quantity: str = "displacement", number: int = 10) -> Swings:
    """The first peaks and crossings of a quantity in a response, from its dense output.

    quantity : any of `run.names` that passes through zero, as "theta". number : how many.
    Raises ValueError for a number below 1, KeyError for an unknown quantity.
    """
    require(number >= 1, "swings", "number", number, "ask for one peak at least")
    start, length = run.steps.span.T
    end = float(start[-1] + length[-1])

    def at(times: np.ndarray) -> np.ndarray:
        times = np.clip(times, 0.0, end)
        if quantity in run.states:  # without the samples of a whole response
            found = run.steps.at(times.ravel(), "right")[0][:, run.states.index(quantity)]
            return found.reshape(times.shape)
        return run.at(np.minimum(times, run.t[-1]), names=(quantity,))[quantity]

    grid = np.unique(np.append(start[:, None] + length[:, None] * np.arange(8) / 8, end))
    grid = grid[grid <= end]
    x = at(grid)
    away = np.flatnonzero(x)
    change = np.flatnonzero(np.diff(np.sign(x[away])))[:number]
    last, first = away[change], away[change + 1]  # beside each crossing
    crossing_time = _crossings(at, grid[last], grid[first])

    edges = [0, *first.tolist()]
    if len(change) < number:
        edges.append(len(grid))
    crest = [a + int(np.argmax(np.abs(x[a:b]))) for a, b in pairwise(edges)]
    crest = [row for row in crest if row < len(grid) - 1 and x[row]]  # else it has not turned back
    low, high = (grid[np.clip(np.add(crest, d), 0, len(grid) - 1)] for d in (-1, 1))
    peak_time = _crests(at, low, high, np.sign(x[crest]))

    def filled(values: np.ndarray, rest: float) -> np.ndarray:
        return np.append(values, np.full(number, rest))[:number]

    return Swings(filled(at(peak_time), 0.0), filled(peak_time, end), filled(crossing_time, end))


_Curve = Callable[[np.ndarray], np.ndarray]


def _crossings(at: _Curve, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """(n,) times between low and high, of other signs, where a quantity passes through zero."""
    row = np.arange(len(low))
    for _ in range(5):
        t = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, 33)
        x = at(t)
        k = np.argmax(np.sign(x) != np.sign(x[:, :1]), axis=1)
        low, high = t[row, k - 1], t[row, k]
    return low + (high - low) * x[row, k - 1] / (x[row, k - 1] - x[row, k])


def _crests(at: _Curve, low: np.ndarray, high: np.ndarray, side: np.ndarray) -> np.ndarray:
    """(n,) times between low and high at which side * quantity is largest."""
    row = np.arange(len(low))
    for _ in range(3):
        t = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, 17)
        x = side[:, None] * at(t)
        k = np.argmax(x, axis=1)
        low, high = t[row, np.maximum(k - 1, 0)], t[row, np.minimum(k + 1, 16)]
    inside = (k > 0) & (k < 16)
    k = np.clip(k, 1, 15)
    before, top, after = x[row, k - 1], x[row, k], x[row, k + 1]
    bend = 2 * top - before - after
    move = np.divide(after - before, 2 * bend, out=np.zeros(len(row)), where=bend > 0)
    return np.where(
        inside, t[row, k] + move * (t[row, 1] - t[row, 0]), t[row, np.argmax(x, axis=1)]
    )


def _swings_moved(
    case: Case, quantity: str, number: int, options: SolverOptions | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Derivatives (number, m) of each of `Swings`, along the directions of the duals of a case.

    That of the time of a peak is -x_tp/x_tt, of the exact x_t and x_p a little before and behind
    it. Raises ValueError where there are none.
    """
    carried = tangents(case, options)
    if carried.grazing:
        raise ValueError(f"the swings have no derivatives: {carried.grazing}")
    run = carried.response
    found = swings(run, quantity, number)
    there, crossed = found.peak != 0.0, found.crossing_time < run.t[-1]
    beside = BESIDE * np.abs(found.crossing_time - found.peak_time)
    times = np.stack(
        [
            found.peak_time,
            np.maximum(found.peak_time - beside, 0.0),
            np.minimum(found.peak_time + beside, run.t[-1]),
            found.crossing_time,
        ]
    )
    along = _along(carried, quantity, times.ravel()).reshape(*times.shape, -1)
    by, rate = along[..., :-1], along[..., -1]
    turns = there & (found.peak_time > 0.0)  # others are those of the start
    peak_time = _quotient(by[2] - by[1], rate[2] - rate[1], turns)
    crossing_time = _quotient(by[3], rate[3], crossed)
    for row, time in enumerate(found.crossing_time):  # at an impact the rate jumps
        (at,) = np.nonzero(np.abs(run.passages[0] - time) <= beside[row])
        if len(at):
            crossing_time[row] = carried.event_times[at[0]]
    return np.where(there[:, None], by[0], 0.0), peak_time, crossing_time


def _along(carried: Tangents, quantity: str, times: np.ndarray) -> np.ndarray:
    """(n, m + 1) derivatives of a quantity at fixed times (n,), and the last of them by time."""
    run, m = carried.response, len(carried.end_time)
    module, p = run.structure.module, run.structure.vector
    still = np.zeros((len(p), 1))  # by time
    moving = with_tangent(p, np.append(carried.parameters, still, axis=1))
    y, contact = run.steps.at(times, "right")
    ground = [
        np.zeros(len(times)) if motion is None else motion.acceleration(times)
        for motion in (run.motion, run.vertical)
    ]
    rates = filled(run.structure, "rates", module.N_STATES, contact, y, *ground)
    by = np.append(carried.at(times), rates.T[..., None], axis=2)
    found = [
        quantity_of(module, quantity, int(of), with_tangent(*row), moving)
        for of, *row in zip(contact, y, by, strict=True)
    ]
    return tangent_of(np.array(found, dtype=object), m + 1)


def _quotient(by: np.ndarray, rate: np.ndarray, which: np.ndarray) -> np.ndarray:
    """-by/rate (n, m) where `which` (n,) is true, and zero elsewhere."""
    here = np.broadcast_to(which[:, None], by.shape)
    return -np.divide(by, rate[:, None], out=np.zeros(by.shape), where=here)


def fit_free_vibration(
    case: Callable[..., Case],
    start: Mapping[str, float],
    *,
    peaks: ArrayLike | None = None,
    peak_times: ArrayLike | None = None,
    crossing_times: ArrayLike | None = None,
    quantity: str = "displacement",
    uncertainty: float | None = None,
    time_uncertainty: float | None = None,
    release_time: float | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    exact: bool | None = None,
    options: SolverOptions | None = None,
) -> Fit:
    """A structure's parameters and its law of impact, fitted to a measured free vibration.

    case : a function of the parameters, by name, that returns the `Case` of the free vibration.
    start : a first guess of each. peaks (n,) : measured, signed, the release first, in the unit of
    `quantity`, any of those of a response. peak_times, crossing_times (n,) [s], from the release
    on; any of the three may be left out, and n may differ.
    uncertainty of the peaks and time_uncertainty [s] : standard deviations; both are needed where
    peaks and times are given. Where one kind is given, its own may be left out, and is estimated.
    release_time : a first guess [s]; the times then count from another instant, and the release is
    fitted, as the parameter "release_time". options : of the simulations. bounds, and what is
    returned: as in `fit`, the values in the order peaks, peak_times, crossing_times.
    exact : whether the derivatives are those of `rk.tangents`, which need a `case` that calculates
    with `rk.Dual`, and a quantity that `rk.sensitivity` knows; False takes central differences, two
    simulations for each parameter. If not given, exact ones where the first guess has them.

    A peak from which the simulation is let go, moved by no parameter, counts nowhere. Peaks of a
    noisy record lie too far out, the largest of several samples; filter it first, or fit crossings.
    Raises ValueError as `fit` does, and where nothing was measured.
    """
    where = "fit_free_vibration"
    offered = {"peaks": peaks, "peak_times": peak_times, "crossing_times": crossing_times}
    given = {
        name: np.atleast_1d(numbers(where, **{name: value})[0])
        for name, value in offered.items()
        if value is not None
    }
    if not given:
        raise ValueError(f"{where}: nothing was measured: give peaks, peak_times, crossing_times")
    errors = [uncertainty if name == "peaks" else time_uncertainty for name in given]
    kinds = {name == "peaks" for name in given}
    if len(kinds) == 2 and None in errors:
        raise ValueError(
            f"{where}: peaks and times are in units of their own: give the uncertainty of both"
        )
    first = dict(start)
    if release_time is not None:
        first["release_time"] = release_time
    number = max(map(len, given.values()))

    def of_each(columns: Sequence[np.ndarray]) -> np.ndarray:
        named = dict(zip(offered, columns, strict=True))
        return np.concatenate([named[name][: len(values)] for name, values in given.items()])

    def model(**parameters: float) -> np.ndarray:
        shift = parameters.pop("release_time", 0.0) if release_time is not None else 0.0
        found = swings(_run(case(**parameters), options), quantity, number)
        return of_each([found.peak, found.peak_time + shift, found.crossing_time + shift])

    def derivatives(**parameters: float) -> np.ndarray:
        seeds = duals(**parameters)
        along = np.zeros(len(seeds))
        if release_time is not None:
            along = seeds.pop("release_time").tangent
        peak, peak_time, crossing = _swings_moved(case(**seeds), quantity, number, options)
        return of_each([peak, peak_time + along, crossing + along])

    sigma = None
    if None not in errors:
        lengths = [len(values) for values in given.values()]
        sigma = np.repeat(np.array(errors, dtype=float), lengths)
    if exact is None:
        exact = _works(derivatives, first)
    return fit(
        model, np.concatenate(list(given.values())), first, uncertainty=sigma, bounds=bounds,
        derivatives=derivatives if exact else None,
    )  # fmt: skip


def _works(derivatives: Callable[..., np.ndarray], start: Mapping[str, float]) -> bool:
    """Whether there are derivatives at the first guess: not every function takes duals."""
    try:
        return bool(np.all(np.isfinite(derivatives(**start))))
    except (TypeError, ValueError, AttributeError):
        return False


def _run(case: Case, options: SolverOptions | None) -> Response:
    return simulate(
        case.structure, case.motion, impact=case.impact, initial=case.initial,
        duration=case.duration, vertical=case.vertical, phase=case.phase, options=options,
    )  # fmt: skip


def energy_ratios_by_release(
    case: Callable[[float, float], Case],
    peaks: ArrayLike,
    *,
    quantity: str = "displacement",
    options: SolverOptions | None = None,
) -> np.ndarray:
    """(n - 1,) r of each impact: released at each measured peak, that which leads to the next.

    As the thesis's section 4.8.2 found those of Figure 4-40. The structure may be any.

    case : a function of a peak and of r that returns the `Case` released there at rest, long enough
    to reach the next peak. peaks (n,) : measured, signed, one on each side in turn, in the unit of
    `quantity`. options : of the simulations. NaN where no r up to 1 leads as far as the next peak.

    Raises ValueError for peaks that do not change their side, and where the simulation ends before
    the next peak.
    """
    from scipy.optimize import brentq  # takes long to import

    where = "energy_ratios_by_release"
    (x,) = numbers(where, peaks=peaks)
    if x.ndim != 1 or len(x) < 2 or not np.all(x[1:] * x[:-1] < 0):
        raise ValueError(f"{where}: peaks must be two or more, on one side and the other in turn")

    def beyond(r: float, peak: float, following: float) -> float:
        run = _run(case(peak, r), options)
        reached = float(swings(run, quantity, 2).peak[1])
        if not reached and run.outcome != "came to rest":
            raise ValueError(
                f"{where}: released at {peak} the case ends before the next peak: let it last "
                f"longer than {run.t[-1]:g} s"
            )
        return abs(reached) - abs(following)

    ratios = np.full(len(x) - 1, np.nan)
    for i, pair in enumerate(pairwise(x.tolist())):
        if beyond(NO_RATIO, *pair) < 0 < beyond(1.0, *pair):
            ratios[i] = brentq(beyond, NO_RATIO, 1.0, args=pair, xtol=1e-9, rtol=1e-9)
    return ratios


# -- formulas


def fit_rotation_centre(
    displacement: ArrayLike, distance: ArrayLike, *, uncertainty: ArrayLike | None = None
) -> Fit:
    """C1, C2 and epsilon of thesis 4-8 [m], fitted to a measured path of the rotation centre.

    displacement (n,) [m]; distance (n,) of the centre from the pressed edge [m]; uncertainty of the
    distances [m], as in `fit`. The first guess is that of 4-7.
    """
    d, measured = numbers("fit_rotation_centre", displacement=displacement, distance=distance)

    def path(C1: float, C2: float, epsilon: float) -> np.ndarray:
        return RotationCentre(C1, C2, epsilon).distance_from_edge(d)

    guess = RotationCentre.thesis_gauge()
    start = {name: getattr(guess, name) for name in ("C1", "C2", "epsilon")}
    positive_only = dict.fromkeys(start, (0.0, np.inf))
    return fit(path, measured, start, uncertainty=uncertainty, bounds=positive_only)


def fit_moving_centre(
    displacement: ArrayLike,
    centre: ArrayLike,
    velocity: ArrayLike | None = None,
    *,
    base_width: float = 0.6,
    uncertainty: float | None = None,
) -> dict[str, Fit]:
    """Reach [m] and slope [1/m] of thesis 5-5, fitted by the direction of motion.

    displacement (n,) [m]; centre (n,) : distance from the left edge [m]; velocity (n,), whose sign
    is the direction: "clockwise" where it is positive or zero. Returns a `Fit` of both directions
    by name, "clockwise" and "counterclockwise", and of "all"; without velocities that alone.
    base_width [m]; uncertainty of the centre [m], as in `fit`.
    """
    where = "fit_moving_centre"
    d, measured = numbers(where, displacement=displacement, centre=centre)
    parts = {"all": np.ones(d.shape, dtype=bool)}
    if velocity is not None:
        (v,) = numbers(where, velocity=velocity)
        parts |= {"clockwise": v >= 0, "counterclockwise": v < 0}
    start, held = {"reach": 0.2201, "slope": 127.6}, {"reach": (0.0, base_width / 2)}

    def of(rows: np.ndarray) -> Fit:
        def path(reach: float, slope: float) -> np.ndarray:
            return rotation_centre(d[rows], reach=reach, slope=slope, base_width=base_width)

        bounds = held | {"slope": (0.0, np.inf)}
        return fit(path, measured[rows], start, uncertainty=uncertainty, bounds=bounds)

    return {name: of(rows) for name, rows in parts.items()}
