"""Lognormal fragility curves: how likely an intensity makes a structure exceed a limit.

Observed fractions and the curve each have an interval of confidence.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy.special import betaincinv, log_ndtr, ndtr, ndtri, stdtrit

from rockeom.analysis.sweeps import FALLS, STANDS, check_sweep, outcome_labels, peaks_of
from rockeom.analysis.unfinished import check_finished
from rockeom.numbers import explained
from rockeom.numbers.arguments import numbers, positive, require
from rockeom.numbers.checks import near


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
    require(0.0 < level < 1.0, where, "level", level, "it lies between 0 and 1, as 0.95")
    require(of > 0, where, "number", of, "give one motion or more")
    require((hits >= 0) & (hits <= of), where, "exceeded", hits, "it lies between 0 and number")
    hits, of = np.broadcast_arrays(hits, of)
    tail = 0.5 * (1.0 - level)
    none, every = hits == 0, hits == of
    lower = np.where(none, 0.0, betaincinv(np.where(none, 1, hits), of - hits + 1, tail))
    upper = np.where(every, 1.0, betaincinv(hits + 1, np.where(every, 1, of - hits), 1.0 - tail))
    return lower, upper


def proportion_interval_by_group(
    exceeded: ArrayLike, group: ArrayLike, level: float = 0.95
) -> tuple[float, float]:
    """Lower and upper confidence bound of a probability, by dependent observations.

    exceeded (n,) : True or False. group (n,) : labels; observations of one label, such as both
    components of a recording, depend on one another in any way. level : as of
    `proportion_interval`.

    The lower bound is that of groups all of which exceeded, the upper one that of groups any of
    which did: the probability lies between those of both, whatever the dependence. Raises
    ValueError as `proportion_interval` does, and for other shapes.
    """
    hits, labels = np.asarray(exceeded, dtype=bool), np.asarray(group)
    function = "proportion_interval_by_group"
    require(
        hits.shape == labels.shape, function, "group", labels.size, "a label for each observation"
    )
    groups = [hits[labels == label] for label in np.unique(labels)]
    lower, _ = proportion_interval(sum(one.all() for one in groups), len(groups), level)
    _, upper = proportion_interval(sum(one.any() for one in groups), len(groups), level)
    return float(lower), float(upper)


@dataclass(frozen=True, eq=False)
class Fragility:
    """The probability Phi(ln(im/median)/dispersion) that a limit is exceeded, and its doubt.

    median : intensity at which half exceed the limit [unit of the intensity]; dispersion :
        standard deviation of its logarithm [-].
    covariance (2, 2) : of median and dispersion, the inverse of the expected Fisher information;
        that of `fit_fragility` by `group` where motions are scaled to several intensities.
    intensity (n,), exceeded (n,), number (n,) : the observations.
    left_out : cases without an answer, which are not counted.
    groups : number of groups of dependent observations; 0 where all are independent.

    Intervals take so many standard errors as the normal distribution asks for, or Student's with
    groups - 1 degrees of freedom.
    """

    median: float
    dispersion: float
    covariance: np.ndarray
    intensity: np.ndarray
    exceeded: np.ndarray
    number: np.ndarray
    left_out: int = 0
    groups: int = 0

    def probability(self, im: ArrayLike) -> np.ndarray:
        """Probability that the limit is exceeded at intensities, of the shape of `im`."""
        return ndtr(self._deviates(im))

    def bounds(self, im: ArrayLike, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper confidence bound of the probability, each of the shape of `im`.

        level : probability that both lie around the true curve at an intensity. They are Wald's:
        of the normal deviate ln(im/median)/dispersion, by the covariance. Raises ValueError for a
        level that does not lie between 0 and 1.
        """
        require(0.0 < level < 1.0, "bounds", "level", level, "it lies between 0 and 1, as 0.95")
        deviates = self._deviates(im)
        slopes = np.stack([np.full_like(deviates, -1.0 / self.median), -deviates], axis=-1)
        slopes /= self.dispersion
        variance = np.einsum("...i,ij,...j", slopes, self.covariance, slopes)
        reach = self._standard_errors(level) * np.sqrt(variance)
        return ndtr(deviates - reach), ndtr(deviates + reach)

    def quantile(self, probability: float, level: float = 0.95) -> Estimate:
        """Intensity at which the limit is exceeded with a probability, and its interval.

        level : of the interval, whose ends are where `bounds` reach the probability (Fieller 1954,
        Journal of the Royal Statistical Society B 16, 175-185); 0 and infinity where they do not,
        since the curve may be flat. Raises ValueError for a probability or a level that does not
        lie between 0 and 1.
        """
        for name, part in (("probability", probability), ("level", level)):
            require(0.0 < part < 1.0, "quantile", name, part, "it lies between 0 and 1")
        deviate = float(ndtri(probability))
        value = self.median * np.exp(self.dispersion * deviate)
        scale = np.array([1.0 / self.median, 1.0]) * self._standard_errors(level) / self.dispersion
        (c_0, c_1), (_, c_2) = self.covariance * np.outer(scale, scale)
        # the ends are the deviates x with (x - deviate)**2 = c_0 + 2 c_1 x + c_2 x**2
        if c_2 >= 1.0:
            return Estimate(float(value), 0.0, np.inf)
        middle, rest = deviate + c_1, deviate**2 - c_0
        reach = np.sqrt(middle**2 - (1.0 - c_2) * rest)
        ends = (middle + np.array([-reach, reach])) / (1.0 - c_2)
        return Estimate(float(value), *(self.median * np.exp(self.dispersion * ends)).tolist())

    def fractions(self) -> tuple[np.ndarray, np.ndarray]:
        """(k,) the different intensities, and (k,) which part exceeded the limit at each."""
        levels, where = np.unique(self.intensity, return_inverse=True)
        exceeded, number = (np.bincount(where, weights) for weights in (self.exceeded, self.number))
        return levels[number > 0], exceeded[number > 0] / number[number > 0]

    def _standard_errors(self, level: float) -> float:
        """Half of an interval in standard errors."""
        tail = 0.5 + 0.5 * level
        return float(stdtrit(self.groups - 1, tail) if self.groups else ndtri(tail))

    def _deviates(self, im: ArrayLike) -> np.ndarray:
        (intensity,) = positive("Fragility", im=im)
        return np.asarray(np.log(intensity / self.median) / self.dispersion)

    def __repr__(self) -> str:
        doubt = np.sqrt(np.diag(self.covariance))
        return (
            f"Fragility(median={self.median:.4g} +- {doubt[0]:.2g}, "
            f"dispersion={self.dispersion:.4g} +- {doubt[1]:.2g})"
        )


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
    group : the record of each observation, where each of n records is scaled to several
        intensities; any labels, of a shape that broadcasts with the others. Observations of one
        record are not independent: the covariance is then that of scores which one capacity of the
        record decides, from which on it exceeds the limit. Where a group has several motions, such
        as both components of a recording, it is an upper bound, since they may depend on one
        another fully. The sandwich of Liang and Zeger (1986), Biometrika 73(1), 13-22, is too
        small for tens of records, see `benchmarks/assessment.py`.

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
    columns = np.column_stack([np.ones(len(im)), np.log(im) - centre])
    (level, slope), information = _probit(columns, hits, of)
    spread = np.linalg.inv(information)
    if group is not None:
        spread = spread @ _between(columns, np.array([level, slope]), of, labels) @ spread
    if slope <= 0.0 or abs(level) > _FLATTEST * slope:
        raise ValueError(f"{function}: the fraction that exceeds falls as the intensity rises")
    median, dispersion = np.exp(centre - level / slope), 1.0 / slope
    turned = np.array(
        [[-median / slope, median * level / slope**2], [0.0, -1.0 / slope**2]]
    )  # of median and dispersion by level and slope
    covariance = turned @ spread @ turned.T
    groups = 0 if group is None else len(np.unique(labels))
    return Fragility(float(median), float(dispersion), covariance, im, hits, of, left_out, groups)


@explained.calls()
def fragility_of(
    sweep: xr.Dataset, *, intensity: str, limit: float | None = None, demand: str | None = None
) -> Fragility:
    """The fragility curve of a sweep of `simulate_many`, all its other names taken together.

        fragility_of(sweep, intensity="pga")                                # of overturning
        fragility_of(sweep, intensity="pga", demand="theta", limit=0.05)    # of a rotation

    intensity : a name of the sweep's dimensions or coordinates.
    demand, limit : of the state or quantity whose largest size is to stay below the limit [its
        unit]; who overturns exceeds it. If neither is given, overturning is meant.

    Cases that gave no answer do not count; `left_out` is their number. Else as `fit_fragility`.
    Raises ValueError also for names that the sweep does not have, and for cases that were not run.
    """
    if (limit is None) != (demand is None):
        raise ValueError("fragility_of: demand and limit belong together: give both or neither")
    check_sweep("fragility_of", sweep)
    if intensity not in sweep.coords:
        raise ValueError(
            f"fragility_of: the sweep has no coordinate {intensity!r}"
            f"{near(intensity, map(str, sweep.coords))}; it has "
            f"{', '.join(map(str, sweep.coords))}"
        )
    check_finished("fragility_of", sweep)
    labels = outcome_labels(sweep)
    fell = labels == FALLS
    answered = fell | labels.isin(STANDS)
    exceeds = fell
    if demand is not None and limit is not None:
        exceeds = fell | (peaks_of(sweep, demand) >= limit)
    im, counted, hit = xr.broadcast(sweep[intensity], answered, exceeds)
    rows = counted.values.ravel()
    return fit_fragility(
        im.values.ravel()[rows], hit.values.ravel()[rows], left_out=int((~rows).sum())
    )


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


def _hazards(deviates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) slopes of ln p and of -ln(1 - p) by the normal deviates of probabilities p."""
    density = -0.5 * deviates**2 - 0.5 * np.log(2 * np.pi)
    return np.exp(density - log_ndtr(deviates)), np.exp(density - log_ndtr(-deviates))


def _between(
    columns: np.ndarray, coefficients: np.ndarray, of: np.ndarray, labels: np.ndarray
) -> np.ndarray:
    """(2, 2) covariance of the sum of the scores, if one capacity decides all of a label.

    Observations i, j with p_i <= p_j have the covariance p_i (1 - p_j), their scores that over
    p (1 - p) of both, times the densities: the slope of -ln(1 - p_i) times that of ln p_j.
    """
    distinct = np.unique(labels)
    n = len(distinct)
    require(n > 1, "fit_fragility", "group", n, "one record alone tells nothing of others")
    deviates = columns @ coefficients
    later, earlier = ((of * slopes)[:, None] * columns for slopes in _hazards(deviates))
    total = np.zeros((2, 2))
    for label in distinct:
        rows = np.flatnonzero(labels == label)
        rows = rows[np.argsort(deviates[rows])]
        before = np.cumsum(earlier[rows], axis=0) - earlier[rows]
        pairs = before.T @ later[rows]
        total += earlier[rows].T @ later[rows] + pairs + pairs.T
    return total


_FLATTEST = 100.0
"""Logarithm of the median over the mean intensity beyond which a curve does not rise."""
_ROUNDS = 100


def _probit(columns: np.ndarray, hits: np.ndarray, of: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients (2,) of the most likely probit regression, and their expected information.

    By Fisher's scoring. The likelihood is concave: a step is halved until it gains.
    """
    coefficients, best = np.zeros(2), -np.inf
    step = np.zeros(2)
    for _ in range(_ROUNDS):
        deviates = columns @ (coefficients + step)
        above, below = log_ndtr(deviates), log_ndtr(-deviates)
        likelihood = float(hits @ above + (of - hits) @ below)
        if likelihood < best - 1e-12 * abs(best):
            step = step / 2
            continue
        coefficients, best = coefficients + step, likelihood
        rising, falling = _hazards(deviates)
        score = (hits * rising - (of - hits) * falling) @ columns
        weights = of * rising * falling
        information = columns.T @ (weights[:, None] * columns)
        step = np.linalg.solve(information, score)
        if np.abs(step).max() <= 1e-13 * np.abs(coefficients).max():
            return coefficients, information
    return coefficients, information
