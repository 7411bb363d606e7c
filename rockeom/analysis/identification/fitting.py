"""Parameters from tests, with their confidence.

    import rockeom as rk
    from rockeom import analysis
    from rockeom.analysis import identification

    def released(r):
        start = {"theta": 0.0265}
        return rk.Case(column, rk.GroundMotion.none(3.0), rk.EnergyRatio(r), start)

    found = analysis.fit_free_vibration(released, {"r": 0.8}, peaks=measured, quantity="theta")
    found.values["r"], found.interval("r")  # and found.covariance, found.summary()

`fit` takes any function of some parameters; the other functions fit a simulation or a formula.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import measured_swings
from rockeom.analysis.formulas.controlled_wall import RotationCentre
from rockeom.analysis.identification.free_vibration import coefficient_of_determination
from rockeom.analysis.identification.measured import rotation_centre
from rockeom.analysis.identification.observed import SwingsOfCase
from rockeom.analysis.identification.swings_of_response import swings
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, numbers, positive, require
from rockeom.numbers.dual import duals
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.simulate import simulate

CONFIDENCE = 0.95
STEP = 1e-4
"""Relative step of the central differences: simulations are exact to 1e-9."""
NO_RATIO = 1e-3
"""The least energy ratio that is tried; some models know no impact without rebound."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Parameters that fit a measurement best, with their confidence.

    Parameters
    ----------
    values : dict of str to float
        Parameters by name.
    covariance : ndarray
        Covariance of the parameters (k, k), in the order of `values`.
    measured : ndarray
        Measured values (n,).
    predicted : ndarray
        Values of the model (n,).
    uncertainty : ndarray
        Standard deviation of each measured value (n,).
    known : bool
        Whether the uncertainty was stated; otherwise it is estimated from the residuals.
    informative : ndarray
        Which values depend on a parameter (n,); others, such as the start of a simulation, count
        nowhere.
    at_bounds : tuple of str
        Names of parameters at a bound; their interval says nothing.
    exact : bool, optional
        Whether the derivatives of the model are exact; central differences otherwise.
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
        """Informative values less parameters."""
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
        """Interval of a parameter with a confidence, if the model is right.

        Parameters
        ----------
        name : str
            Name of the parameter.
        confidence : float, optional
            Confidence, between 0 and 1.

        Returns
        -------
        low : float
            Lower end, in the unit of the parameter.
        high : float
            Upper end.

        Raises
        ------
        KeyError
            For an unknown name.
        ValueError
            For a confidence beyond 0 to 1.

        Notes
        -----
        The interval follows from Student's distribution where the uncertainty was estimated, from
        the normal one where it was stated.
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
        """Mean square of the residuals over their uncertainties; 1 where these were estimated.

        Far above 1 the model is not that of the measurement, or the uncertainty is too small: the
        intervals are then too narrow by about its root.
        """
        parts = (self.residuals / self.uncertainty)[self.informative]
        return float(parts @ parts) / max(self.degrees_of_freedom, 1)

    @property
    def rms(self) -> float:
        """Root mean square of the residuals of informative values, in the unit measured."""
        return float(np.sqrt(np.mean(self.residuals[self.informative] ** 2)))

    @property
    def r_squared(self) -> float:
        """Coefficient of determination of the informative values."""
        chosen = self.informative
        return coefficient_of_determination(self.measured[chosen], self.predicted[chosen])

    def summary(self, confidence: float = CONFIDENCE) -> str:
        """Parameters in words, a line each.

        Parameters
        ----------
        confidence : float, optional
            Confidence of the intervals, between 0 and 1.

        Returns
        -------
        str
            Text of several lines.
        """
        lines = []
        for name, value in self.values.items():
            low, high = self.interval(name, confidence)
            bound = " (at a bound)" if name in self.at_bounds else ""
            lines.append(f"{name} = {value:.5g}, {low:.5g} to {high:.5g}{bound}")
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
    """Least squares: the parameters with which a function is closest to a measurement.

    Parameters
    ----------
    model : callable
        Function of the parameters, by name, that returns one value for each measured one; smooth,
        at least about the best parameters.
    measured : array_like
        Measured values (n,).
    start : dict of str to float
        First guess of each parameter, of the size that it may have.
    uncertainty : array_like, optional
        Standard deviation of the measured values, one or (n,); if not given, one for all is
        estimated from the residuals.
    bounds : dict of str to tuple of (float, float), optional
        Lowest and highest value of parameters, by name.
    derivatives : callable, optional
        Function of the same parameters that returns the derivatives (n, k) of what the model
        returns, k in the order of `start`; central differences if not given.

    Returns
    -------
    Fit
        Parameters with their confidence.

    Raises
    ------
    ValueError
        For bad arguments, for as many parameters as values where the uncertainty must be estimated,
        and for parameters that the values do not distinguish.

    Notes
    -----
    The covariance is that of the linearised model, (J^T J)^-1 with J the derivatives over the
    uncertainties.

    Examples
    --------
    >>> import numpy as np
    >>> from rockeom.analysis import identification
    >>> x, y = np.arange(5.0), np.array([1.0, 3.1, 4.9, 7.0, 9.0])
    >>> line = identification.fit(lambda k, c: k * x + c, measured=y, start={"k": 1.0, "c": 0.0})
    >>> round(line.values["k"], 2)
    1.99
    """
    problem = _LeastSquares.of(model, derivatives, measured, start, uncertainty)
    best = problem.solved(*_bounds(start, bounds))
    slopes = best.jac / problem.scale
    informative = np.any(slopes != 0, axis=1)
    freedom = int(informative.sum()) - len(start)
    known = uncertainty is not None
    if freedom < 1 and not known:
        raise ValueError(
            f"fit: {informative.sum()} values that any parameter moves do not give "
            f"{len(start)} parameters and their scatter: measure more, or give the uncertainty"
        )
    # without an uncertainty that of the problem is 1, and its scale follows from what is left
    sigma = 1.0 if known else np.sqrt(2 * best.cost / freedom)
    at_bound = best.active_mask != 0
    return Fit(
        values=problem.parameters(best.x),
        covariance=_inverse(slopes, tuple(start)) * sigma**2,
        measured=problem.measured,
        predicted=problem.predicted(best.x),
        uncertainty=problem.uncertainty * sigma,
        known=known,
        informative=informative,
        at_bounds=tuple(name for name, at in zip(start, at_bound, strict=True) if at),
        exact=derivatives is not None,
    )


@dataclass(frozen=True)
class _LeastSquares:
    """A least-squares problem, checked; its unknowns z (k,) are the parameters over `scale`.

    names (k,), start (k,) : of the parameters. measured, uncertainty (n,).
    """

    model: Callable[..., ArrayLike]
    derivatives: Callable[..., ArrayLike] | None
    names: tuple[str, ...]
    start: np.ndarray
    measured: np.ndarray
    uncertainty: np.ndarray

    @classmethod
    def of(
        cls,
        model: Callable[..., ArrayLike],
        derivatives: Callable[..., ArrayLike] | None,
        measured: ArrayLike,
        start: Mapping[str, float],
        uncertainty: ArrayLike | None,
    ) -> Self:
        """Raises ValueError for bad arguments of `fit`."""
        (y,) = numbers("fit", measured=measured)
        require(y.ndim == 1 and y.size > 0, "fit", "measured", y, "give a list of values")
        require(bool(start), "fit", "start", {}, "give a first guess of each parameter, by name")
        first = np.array([float(numbers("fit", **{name: start[name]})[0]) for name in start])
        (sigma,) = positive("fit", uncertainty=1.0 if uncertainty is None else uncertainty)
        if sigma.shape not in ((), y.shape):
            raise InputError("uncertainty", of="fit").wrong(
                f"has the shape {sigma.shape}, measured {y.shape}: give one number, or one for "
                "each value"
            )
        return cls(model, derivatives, tuple(start), first, y, np.broadcast_to(sigma, y.shape))

    @property
    def scale(self) -> np.ndarray:
        return np.where(self.start != 0, np.abs(self.start), 1.0)

    def parameters(self, z: np.ndarray) -> dict[str, float]:
        return dict(zip(self.names, (z * self.scale).tolist(), strict=True))

    def predicted(self, z: np.ndarray) -> np.ndarray:
        """(n,) values of the model."""
        value = self.model(**self.parameters(z))
        (y,) = numbers("fit", **{"the value of the model": value})
        if y.shape != self.measured.shape:
            raise InputError("model", of="fit").says(
                f"the model returned the shape {y.shape}, measured is {self.measured.shape}: "
                "return one value for each that was measured"
            )
        return y

    def residuals(self, z: np.ndarray) -> np.ndarray:
        return (self.predicted(z) - self.measured) / self.uncertainty

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        """(n, k) derivatives of the residuals by z."""
        assert self.derivatives is not None
        value = self.derivatives(**self.parameters(z))
        (slopes,) = numbers("fit", **{"the value of derivatives": value})
        shape = (len(self.measured), len(self.start))
        if slopes.shape != shape:
            raise InputError("derivatives", of="fit").says(
                f"derivatives returned the shape {slopes.shape}: return {shape}, a row for each "
                "value and a column for each parameter"
            )
        return slopes * self.scale / self.uncertainty[:, None]

    def solved(self, low: np.ndarray, high: np.ndarray) -> Any:
        """The result of SciPy's `least_squares`, with the parameters between low and high (k,)."""
        from scipy.optimize import least_squares  # takes long to import

        return least_squares(
            self.residuals, self.start / self.scale,
            jac="3-point" if self.derivatives is None else self.jacobian, diff_step=STEP,
            bounds=(low / self.scale, high / self.scale),
            x_scale="jac", xtol=1e-10, ftol=1e-12, gtol=1e-12,
        )  # fmt: skip


def _bounds(
    start: Mapping[str, float], bounds: Mapping[str, tuple[float, float]] | None
) -> tuple[np.ndarray, np.ndarray]:
    bounds = {} if bounds is None else bounds
    unknown = [name for name in bounds if name not in start]
    if unknown:
        raise InputError("bounds", of="fit").wrong(
            f"has {unknown[0]!r}, start has {', '.join(start)}: give bounds of parameters that are "
            "fitted"
        )
    pairs = np.array([bounds.get(name, (-np.inf, np.inf)) for name in start], dtype=float)
    for name, guess, (low, high) in zip(start, start.values(), pairs, strict=True):
        if not low < guess < high:
            raise InputError("start", guess, "fit").says(
                f"the first guess of {name} is {guess}, its bounds {low} and {high}: begin between "
                "them"
            )
    return pairs[:, 0], pairs[:, 1]


def _inverse(slopes: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    """(J^T J)^-1; raises ValueError where some change of the parameters moves nothing."""
    size = np.linalg.norm(slopes, axis=0)
    if not size.all():
        lost = names[int(np.argmin(size))]
        raise ValueError(
            f"fit: {lost} moves none of the values: leave it out, or measure what it moves"
        )
    _, strength, ways = np.linalg.svd(slopes / size, full_matrices=False)
    if strength[-1] < 1e-9 * strength[0]:
        alike = ", ".join(n for n, part in zip(names, ways[-1], strict=True) if abs(part) > 0.1)
        raise ValueError(
            f"fit: the values do not distinguish {alike}: fit fewer of them, or measure more"
        )
    half = (ways.T / strength) / size[:, None]
    return half @ half.T


# -- free vibrations


@explained.calls()
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
    """Parameters of a structure and of its impact law, fitted to a measured free vibration.

    Parameters
    ----------
    case : callable
        Function of the parameters, by name, that returns the `Case` of the free vibration.
    start : dict of str to float
        First guess of each parameter.
    peaks : array_like, optional
        Measured peaks (n,), signed, the release first, in the unit of `quantity`.
    peak_times : array_like, optional
        Measured times of peaks (n,), from the release on [s].
    crossing_times : array_like, optional
        Measured times of crossings (n,), from the release on [s]. Any of the three may be left out,
        and n may differ.
    quantity : str, optional
        Quantity of a response that was measured.
    uncertainty : float, optional
        Standard deviation of the peaks, in their unit.
    time_uncertainty : float, optional
        Standard deviation of the times [s]. Both are needed where peaks and times are stated; where
        one kind is, its own may be left out, and is estimated.
    release_time : float, optional
        First guess of the time of the release [s]; the times then count from another instant, and
        the release is fitted, as the parameter "release_time".
    bounds : dict of str to tuple of (float, float), optional
        Lowest and highest value of parameters, by name.
    exact : bool, optional
        Whether the derivatives are those of `rk.tangents`, which need a `case` that calculates with
        `rk.Dual`, and a quantity that `rk.sensitivity` knows; False takes central differences, two
        simulations for each parameter. If not given, exact ones where the first guess has them.
    options : SolverOptions, optional
        Choices of the integration.

    Returns
    -------
    Fit
        Parameters with their confidence; the values are in the order peaks, peak_times,
        crossing_times.

    Raises
    ------
    ValueError
        As for `fit`, and where nothing was measured.

    Notes
    -----
    The peak at which the simulation is released depends on no parameter and counts nowhere. Noise
    enlarges the peaks of a record, the largest of several samples: filter it first, or fit
    crossings.
    """
    offered = {"peaks": peaks, "peak_times": peak_times, "crossing_times": crossing_times}
    values = measured_swings("fit_free_vibration", offered)
    first, released = dict(start), None
    if release_time is not None:
        released = "release_time"
        first[released] = release_time
    lengths = {name: len(x) for name, x in values.items()}
    model = SwingsOfCase(case, lengths, quantity, released, options)

    def predicted(**parameters: float) -> np.ndarray:
        return model(**parameters).values

    def derivatives(**parameters: float) -> np.ndarray:
        return model(**duals(**parameters)).derivatives

    if exact is None:
        exact = _works(derivatives, first)
    return fit(
        predicted, np.concatenate(list(values.values())), first,
        uncertainty=_of_swings(values, uncertainty, time_uncertainty), bounds=bounds,
        derivatives=derivatives if exact else None,
    )  # fmt: skip


def _of_swings(
    values: Mapping[str, np.ndarray], uncertainty: float | None, time_uncertainty: float | None
) -> np.ndarray | None:
    """Uncertainty of each measured value; None where one is not stated."""
    errors = [uncertainty if name == "peaks" else time_uncertainty for name in values]
    if len({name == "peaks" for name in values}) == 2 and None in errors:
        raise InputError("uncertainty", of="fit_free_vibration").says(
            "peaks and times are in units of their own: give the uncertainty of both"
        )
    if None in errors:
        return None
    return np.repeat(np.array(errors, dtype=float), [len(x) for x in values.values()])


def _works(derivatives: Callable[..., np.ndarray], start: Mapping[str, float]) -> bool:
    """Whether there are derivatives at the first guess: not every function takes duals."""
    try:
        return bool(np.all(np.isfinite(derivatives(**start))))
    except (TypeError, ValueError, AttributeError):
        return False


def energy_ratios_by_release(
    case: Callable[[float, float], Case],
    peaks: ArrayLike,
    *,
    quantity: str = "displacement",
    options: SolverOptions | None = None,
) -> np.ndarray:
    """Energy ratio r of each impact, by simulations from each measured peak to the next.

    The method of thesis section 4.8.2 for Figure 4-40, for any structure.

    Parameters
    ----------
    case : callable
        Function of a peak and of r that returns the `Case` released there at rest, long enough to
        reach the next peak.
    peaks : array_like
        Measured peaks (n,), signed, one on each side in turn, in the unit of `quantity`.
    quantity : str, optional
        Quantity of a response that was measured.
    options : SolverOptions, optional
        Choices of the integration.

    Returns
    -------
    ndarray
        Energy ratios (n - 1,), NaN where no r up to 1 leads as far as the next peak.

    Raises
    ------
    ValueError
        For peaks that do not change their side, and where the simulation ends before the next peak.
    """
    from scipy.optimize import brentq  # takes long to import

    where = "energy_ratios_by_release"
    (x,) = numbers(where, peaks=peaks)
    if x.ndim != 1 or len(x) < 2 or not np.all(x[1:] * x[:-1] < 0):
        raise InputError("peaks", x, where).give("two or more, on both sides in turn")

    def beyond(r: float, peak: float, following: float) -> float:
        run = simulate(case(peak, r), options=options)
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
    """Constants C1, C2 and epsilon of thesis 4-8 [m], fitted to a path of the rotation centre.

    Parameters
    ----------
    displacement : array_like
        Displacements (n,) [m].
    distance : array_like
        Distance of the centre from the pressed edge (n,) [m].
    uncertainty : array_like, optional
        Standard deviation of the distances [m]; estimated if not given.

    Returns
    -------
    Fit
        Constants with their confidence.

    Raises
    ------
    ValueError
        As for `fit`.

    Notes
    -----
    The first guess is that of 4-7.
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

    Parameters
    ----------
    displacement : array_like
        Displacements (n,) [m].
    centre : array_like
        Distance of the centre from the left edge (n,) [m].
    velocity : array_like, optional
        Velocities (n,), whose sign is the direction: "clockwise" where it is positive or zero.
    base_width : float, optional
        Width of the base [m].
    uncertainty : float, optional
        Standard deviation of the centre [m]; estimated if not given.

    Returns
    -------
    dict of str to Fit
        Fit of both directions by name, "clockwise" and "counterclockwise", and of "all"; without
        velocities that alone.

    Raises
    ------
    ValueError
        As for `fit`.
    """
    where = "fit_moving_centre"
    d, measured = numbers(where, displacement=displacement, centre=centre)
    parts = {"all": np.ones(d.shape, dtype=bool)}
    if velocity is not None:
        (v,) = numbers(where, velocity=velocity)
        parts |= {"clockwise": v >= 0, "counterclockwise": v < 0}
    start, reach_bounds = {"reach": 0.2201, "slope": 127.6}, {"reach": (0.0, base_width / 2)}

    def of(rows: np.ndarray) -> Fit:
        def path(reach: float, slope: float) -> np.ndarray:
            return rotation_centre(d[rows], reach=reach, slope=slope, base_width=base_width)

        bounds = reach_bounds | {"slope": (0.0, np.inf)}
        return fit(path, measured[rows], start, uncertainty=uncertainty, bounds=bounds)

    return {name: of(rows) for name, rows in parts.items()}
