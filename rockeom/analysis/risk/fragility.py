"""Lognormal fragility curves: how likely an intensity makes a structure exceed a limit.

Observed fractions and the curve each have an interval of confidence.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy.special import betaincinv, log_ndtr, ndtr, ndtri, stdtrit

from rockeom.analysis.sweeps import check_sweep, coordinate, exceedances, unanswered
from rockeom.analysis.unfinished import check_finished
from rockeom.motion.recordings import recording_of
from rockeom.numbers import explained
from rockeom.numbers.arguments import numbers, positive, require

LEAST_GROUPS = 3  # from which on intervals hold the truth as often as they say
_WITHIN = "it lies between 0 and 1, as 0.95"


class Estimate(NamedTuple):
    """A value with the bounds of its interval of confidence."""

    value: float
    lower: float
    upper: float


def proportion_interval(
    exceeded: ArrayLike, number: ArrayLike, level: float = 0.95
) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper confidence bound of a probability, `exceeded` of `number` having occurred.

    exceeded, number : whole numbers of any shapes, broadcast. level : probability, at least, that
    the interval holds the true one, in [0, 1).

    The exact interval of Clopper and Pearson (1934), Biometrika 26, 404-413: no probability within
    it makes as few, or as many, less likely than (1 - level)/2. Raises ValueError for numbers that
    cannot be.
    """
    where = "proportion_interval"
    hits, of = numbers(where, exceeded=exceeded, number=number)
    require(0.0 < level < 1.0, where, "level", level, _WITHIN)
    require(of > 0, where, "number", of, "give one motion or more")
    require((hits >= 0) & (hits <= of), where, "exceeded", hits, "it lies between 0 and number")
    hits, of = np.broadcast_arrays(hits, of)
    tail = 0.5 * (1.0 - level)
    lower = np.where(hits == 0, 0.0, betaincinv(hits, of - hits + 1, tail))
    upper = np.where(hits == of, 1.0, betaincinv(hits + 1, of - hits, 1.0 - tail))
    return lower, upper


@dataclass(frozen=True, eq=False)
class Fragility:
    """The probability Phi(ln(im/median)/dispersion) that a limit is exceeded, and its doubt.

    median : intensity at which half exceed the limit [unit of the intensity]; dispersion :
        standard deviation of its logarithm [-].
    covariance (2, 2) : of median and dispersion, the inverse of the expected Fisher information,
        or of `fit_fragility` by `group`; nan where that has none.
    intensity (n,), exceeded (n,), number (n,) : the observations.
    left_out : cases without an answer, which are not counted.
    groups : number of groups of motions that depend on one another; 0 where all are independent.
    unbiased : the normal deviate z of the curve is unbiased[0] + unbiased[1] z without the bias of
        few groups, about which intervals lie.
    not_counted : how cases without an answer ended and what follows if they are counted, in words.
    """

    median: float
    dispersion: float
    covariance: np.ndarray
    intensity: np.ndarray
    exceeded: np.ndarray
    number: np.ndarray
    left_out: int = 0
    groups: int = 0
    unbiased: tuple[float, float] = (0.0, 1.0)
    not_counted: str = ""

    @property
    def no_interval(self) -> str:
        """Why no interval is known, all of which are nan then; or nothing."""
        known = np.isfinite(self.covariance).all()
        few = f"{self.groups} groups are too few, or no intensities lie on both sides of the median"
        return "" if known else f"no intervals: {few}"

    def probability(self, im: ArrayLike) -> np.ndarray:
        """Probability that the limit is exceeded at intensities, of the shape of `im`."""
        return ndtr(self._deviates(im))

    def bounds(self, im: ArrayLike, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper confidence bound of the probability, each of the shape of `im`.

        level : probability that both lie around the true curve at an intensity. They are Wald's:
        of the normal deviate ln(im/median)/dispersion without its bias, by the covariance and the
        normal distribution, or Student's. Raises ValueError for a level that does not lie between 0
        and 1.
        """
        deviates, reach = self._deviates(im), self._reach("bounds", level)
        at_zero, mixed, of_square = self._variance
        reach = reach * np.sqrt(at_zero + 2.0 * mixed * deviates + of_square * deviates**2)
        middle = self.unbiased[0] + self.unbiased[1] * deviates
        return ndtr(middle - reach), ndtr(middle + reach)

    def quantile(self, probability: float, level: float = 0.95) -> Estimate:
        """Intensity at which the limit is exceeded with a probability, and its interval.

        level : of the interval, at whose ends a bound of the curve has this probability (Fieller
        1954, Journal of the Royal Statistical Society B 16(2), 175-185); from 0 to infinity where
        the slope may be zero. Raises ValueError for a probability or a level that does not lie
        between 0 and 1.
        """
        require(0.0 < probability < 1.0, "quantile", "probability", probability, _WITHIN)
        reach = self._reach("quantile", level)
        (at_zero, mixed, of_square), deviate = reach**2 * self._variance, float(ndtri(probability))
        value, (start, slope) = self.median * np.exp(self.dispersion * deviate), self.unbiased
        curved = slope**2 - of_square
        if curved <= 0.0:
            return Estimate(float(value), 0.0, np.inf)
        middle = (slope * (deviate - start) + mixed) / curved
        away = np.sqrt(middle**2 - ((deviate - start) ** 2 - at_zero) / curved)
        ends = self.median * np.exp(self.dispersion * (middle + np.array([-away, away])))
        return Estimate(*map(float, (value, *ends)))

    def dispersion_interval(self, level: float = 0.95) -> Estimate:
        """The dispersion and its interval, that of the slope 1/dispersion at a level."""
        reach = self._reach("dispersion_interval", level) * np.sqrt(self._variance[2])
        low, high = (float(self.dispersion / (self.unbiased[1] + r)) for r in (reach, -reach))
        return Estimate(self.dispersion, low, np.inf if high < low else high)

    def fractions(self) -> tuple[np.ndarray, np.ndarray]:
        """(k,) the different intensities, and (k,) which part exceeded the limit at each."""
        levels, where = np.unique(self.intensity, return_inverse=True)
        exceeded, number = (np.bincount(where, weights) for weights in (self.exceeded, self.number))
        return levels[number > 0], exceeded[number > 0] / number[number > 0]

    @property
    def grouped(self) -> str:
        """How many motions were counted, and which of them depend on one another, in words."""
        how = f"in {self.groups} groups" if self.groups else "counted as independent"
        return f"{self.number.sum():g} motions {how}"

    def _deviates(self, im: ArrayLike) -> np.ndarray:
        (intensity,) = positive("Fragility", im=im)
        return np.asarray(np.log(intensity / self.median) / self.dispersion)

    @cached_property
    def _variance(self) -> np.ndarray:
        """(3,) a, b, c of the variance a + 2 b z + c z**2 of the normal deviate z of the curve."""
        relative = self.covariance / np.outer([self.median, 1.0], [self.median, 1.0])
        return relative[[0, 0, 1], [0, 1, 1]] / self.dispersion**2

    def _reach(self, where: str, level: float) -> float:
        """Half of an interval over the standard error."""
        require(0.0 < level < 1.0, where, "level", level, _WITHIN)
        upper = 0.5 + 0.5 * level
        return float(stdtrit(self.groups - 1, upper) if self.groups else ndtri(upper))

    def __repr__(self) -> str:
        estimates = self.quantile(0.5), self.dispersion_interval()
        median, dispersion = (
            f"{value:.4g}" + f" ({low:.4g} to {high:.4g})" * (not np.isnan(low))
            for value, low, high in estimates
        )
        of = f"{self.grouped}; {self.no_interval or 'intervals of 95 %'}"
        told = f"Fragility: median {median}, dispersion {dispersion}\n  {of}"
        return f"{told}\n  {self.not_counted}" if self.not_counted else told


@explained.calls()
def fit_fragility(
    intensity: ArrayLike,
    exceeded: ArrayLike,
    number: ArrayLike = 1,
    left_out: int = 0,
    *,
    group: ArrayLike | None = None,
) -> Fragility:
    """The lognormal fragility curve of the greatest likelihood.

        fit_fragility([0.2, 0.4, 0.6, 0.8], exceeded=[1, 4, 9, 10], number=10)

    intensity : of the ground motion, above zero [any unit].
    exceeded : how many of `number` motions of that intensity exceeded the limit; of single motions
        True or False. The three broadcast.
    left_out : cases that gave no answer, for the result.
    group : the recording of each observation, where each of n recordings is scaled to several
        intensities; any labels, of a shape that broadcasts with the others. Observations of one
        recording are not independent: the covariance is then that of the jackknife, the sum of
        squares of the changes by leaving out each recording (Lipsitz, Dear and Zhao 1994,
        Biometrics 50(3), 842-846), and intervals are those of Student, about the curve less its
        bias by the same changes. There are none, and the covariance is nan, for fewer than three
        recordings, where without one of them no curve fits, and where at each intensity more than
        half exceed, or less.

    The likelihood of ln-normal limits is that of a probit regression on ln(intensity), whose
    maximum is unique. Source: Baker (2015), Earthquake Spectra 31(1), 579-599, equation 11.

    Raises ValueError for numbers that cannot be, and where no curve is most likely: all or none
    exceeded, one intensity alone, observations that one intensity separates, or fractions that
    fall as the intensity rises.
    """
    function = "fit_fragility"
    (im,) = positive(function, intensity=intensity)
    hits, of = numbers(function, exceeded=exceeded, number=number)
    require(hits == np.floor(hits), function, "exceeded", hits, "give whole numbers of motions")
    require(of == np.floor(of), function, "number", of, "give whole numbers of motions")
    numbers(function, intensity=im, exceeded=hits, number=of)
    labels = np.asarray(0 if group is None else group)
    im, hits, of, labels = (a.ravel() for a in np.broadcast_arrays(im, hits, of, labels))
    require((hits >= 0) & (hits <= of), function, "exceeded", hits, "it lies between 0 and number")
    _refuse_separable(im, hits, of)
    centre = np.average(np.log(im), weights=of)
    u = np.log(im) - centre
    (level, slope), information = _probit(u, hits, of)
    groups, spread, bias = 0, np.linalg.inv(information), np.zeros(2)
    if group is not None:
        distinct, which = np.unique(labels, return_inverse=True)
        groups, coefficients = len(distinct), np.array([level, slope])
        spread, bias = _jackknife(u, hits, of, which, coefficients)
    if slope <= 0.0:
        raise ValueError(f"{function}: the fraction that exceeds falls as the intensity rises")
    median, dispersion = np.exp(centre - level / slope), 1.0 / slope
    turned = np.array(
        [[-median / slope, median * level / slope**2], [0.0, -1.0 / slope**2]]
    )  # of median and dispersion by level and slope
    covariance = turned @ spread @ turned.T
    unbiased = float(bias[1] * level / slope - bias[0]), float(1.0 - bias[1] / slope)
    return Fragility(
        float(median), float(dispersion), covariance, im, hits, of, left_out, groups, unbiased
    )


@explained.calls()
def fragility_of(
    sweep: xr.Dataset,
    *,
    intensity: str,
    limit: float | None = None,
    demand: str | None = None,
    group: str | None = "recording",
) -> Fragility:
    """The fragility curve of a sweep of `simulate_many`, all its other names taken together.

        fragility_of(sweep, intensity="pga")                                # of overturning
        fragility_of(sweep, intensity="pga", demand="theta", limit=0.05)    # of a rotation

    intensity : a name of the sweep's dimensions or coordinates.
    demand, limit : of the state or quantity whose largest size is to stay below the limit [its
        unit]; who overturns exceeds it. If neither is given, overturning is meant.
    group : a name of the sweep's, of which each value stands for motions that depend on one
        another; None for none that do. By default "recording": that of each `motion`, by the names
        of its components, where the sweep has two motions or more.

    Cases that gave no answer do not count; `not_counted` tells how many ended in which way, and the
    median and dispersion, or the fraction at each intensity where no curve fits, with all of them
    counted as fallen, and as standing. Else as `fit_fragility`.
    Raises ValueError also for names that the sweep does not have, and for cases that were not run.
    """
    if (limit is None) != (demand is None):
        raise ValueError("fragility_of: demand and limit belong together: give both or neither")
    check_sweep("fragility_of", sweep)
    coordinate("fragility_of", sweep, intensity)
    check_finished("fragility_of", sweep)
    by = _groups(sweep, group)
    columns = sweep[intensity], *exceedances(sweep, demand, limit), *([] if by is None else [by])
    im, hits, answered, labels, *groups = (
        column.values.ravel() for column in xr.broadcast(*columns)
    )

    def fitted(hits: np.ndarray, rows: np.ndarray | slice = slice(None)) -> Fragility:
        return fit_fragility(im[rows], hits[rows], group=groups[0][rows] if groups else None)

    def figures(hits: np.ndarray) -> str:
        try:
            curve = fitted(hits)
        except ValueError:
            parts = [hits[im == level].mean() for level in np.unique(im)]
            return f"fractions {', '.join(f'{part:.3g}' for part in parts)}"
        return f"median {curve.median:.4g}, dispersion {curve.dispersion:.3g}"

    if answered.all():
        return fitted(hits)
    left_out = (
        f"{unanswered(labels)} left out; with all of them fallen: "
        f"{figures(hits | ~answered)}; with all standing: {figures(hits)}"
    )
    try:
        curve = fitted(hits, answered)
    except ValueError as error:
        raise ValueError(f"{error}; {left_out}") from None
    return replace(curve, left_out=int((~answered).sum()), not_counted=left_out)


def _groups(sweep: xr.Dataset, group: str | None) -> xr.DataArray | None:
    """The label of the group of each case, see `fragility_of`; None for no groups."""
    if group == "recording" and group not in sweep.coords:
        names = sweep.coords.get("motion")
        if names is None or len(np.unique(names)) < 2:
            return None
        return names.copy(data=[recording_of(name) for name in names.values.ravel().tolist()])
    return None if group is None else coordinate("fragility_of", sweep, group)


def _refuse_separable(im: np.ndarray, hits: np.ndarray, of: np.ndarray) -> None:
    """ValueError where an intensity separates all exceedances: any steeper curve is likelier."""
    function = "fit_fragility"
    with_hits, without = im[hits > 0], im[hits < of]
    if not len(with_hits) or not len(without):
        which = "none" if not len(with_hits) else "all"
        raise ValueError(
            f"{function}: {which} of {of.sum():g} motions exceeded the limit: add "
            f"{'higher' if which == 'none' else 'lower'} intensities, or change the limit"
        )
    if len(np.unique(im[of > 0])) == 1:
        raise ValueError(f"{function}: all motions have the intensity {im[0]:g}: vary it")
    if without.max() <= with_hits.min():
        raise ValueError(
            f"{function}: the observations are separable: all above {with_hits.min():g} exceeded "
            f"the limit and none below {without.max():g}, so that the likelihood has no maximum "
            "(the dispersion goes to zero); add motions or intensities between"
        )
    if with_hits.max() <= without.min():
        raise ValueError(f"{function}: the fraction that exceeds falls as the intensity rises")


def _jackknife(
    u: np.ndarray, hits: np.ndarray, of: np.ndarray, which: np.ndarray, coefficients: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Covariance (2, 2) and bias (2,) of the coefficients, each group left out in turn, or nan."""
    n, unknown = int(which.max()) + 1, (np.full((2, 2), np.nan), np.zeros(2))
    levels, place = np.unique(u, return_inverse=True)
    most = np.bincount(place, 2 * hits - of)[np.bincount(place, of) > 0]  # half, where it is zero
    if n < LEAST_GROUPS or most.min() > 0 or most.max() < 0:
        return unknown
    changes = np.empty((n, 2))
    for k in range(n):
        rows = which != k
        some, every = (np.bincount(place[rows], x[rows], len(levels)) for x in (hits, of))
        try:
            _refuse_separable(levels, some, every)
        except ValueError:
            return unknown
        changes[k] = _probit(levels, some, every, coefficients)[0] - coefficients
    return changes.T @ changes, (n - 1) * changes.mean(axis=0)


_ROUNDS = 100


def _probit(
    u: np.ndarray, hits: np.ndarray, of: np.ndarray, start: ArrayLike = (0.0, 0.0)
) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients (2,) of the most likely probit regression on u, and their expected information.

    By Fisher's scoring. The likelihood is concave: a step is halved until it gains.
    """
    columns = np.column_stack([np.ones(len(u)), u])
    coefficients, best = np.array(start), -np.inf
    step = np.zeros(2)
    for _ in range(_ROUNDS):
        deviates = columns @ (coefficients + step)
        above, below = log_ndtr(deviates), log_ndtr(-deviates)
        likelihood = float(hits @ above + (of - hits) @ below)
        if likelihood < best - 1e-12 * abs(best):
            step = step / 2
            continue
        coefficients, best = coefficients + step, likelihood
        density = -0.5 * deviates**2 - 0.5 * np.log(2 * np.pi)
        score = columns.T @ (hits * np.exp(density - above) - (of - hits) * np.exp(density - below))
        weights = of * np.exp(2 * density - above - below)
        information = columns.T @ (weights[:, None] * columns)
        step = np.linalg.solve(information, score)
        if np.abs(step).max() <= 1e-13 * np.abs(coefficients).max():
            return coefficients, information
    return coefficients, information
