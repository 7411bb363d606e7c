"""Lognormal fragility curves: how likely an intensity makes a structure exceed a limit.

Observed fractions and the curve each have an interval of confidence.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy.special import betaincinv, log_ndtr, ndtr, ndtri, stdtrit

from rockeom.analysis.sweeps import check_finished, check_sweep, coordinate, exceedances, unanswered
from rockeom.motion.recordings import recording_of
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, numbers, positive, require

_WITHIN = "it lies between 0 and 1, as 0.95"


class Estimate(NamedTuple):
    """Value with the bounds of its interval of confidence.

    Parameters
    ----------
    value : float
        Value.
    lower : float
        Lower bound.
    upper : float
        Upper bound.
    """

    value: float
    lower: float
    upper: float


def proportion_interval(
    exceeded: ArrayLike, number: ArrayLike, level: float = 0.95
) -> tuple[np.ndarray, np.ndarray]:
    """Exact confidence bounds of a probability, of events counted in a number of trials.

    Parameters
    ----------
    exceeded : array_like
        Number of trials in which the event occurred.
    number : array_like
        Number of trials.
    level : float, optional
        Probability, at least, that the interval holds the true one, in [0, 1).

    Returns
    -------
    lower : ndarray
        Lower bound, in the shape of the numbers, broadcast.
    upper : ndarray
        Upper bound.

    Raises
    ------
    ValueError
        For numbers that cannot be.

    Notes
    -----
    The interval of Clopper and Pearson: no probability within it makes as few, or as many, less
    likely than (1 - level)/2.

    References
    ----------
    Clopper and Pearson (1934), Biometrika 26, 404-413.
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


def proportion_interval_by_group(
    exceeded: ArrayLike, group: ArrayLike, level: float = 0.95
) -> tuple[float, float]:
    """Confidence bounds of a probability, by dependent observations.

    Parameters
    ----------
    exceeded : array_like
        True or False for each observation (n,).
    group : array_like
        Labels (n,); observations of one label, such as both components of a recording, depend on
        one another in any way.
    level : float, optional
        Probability, at least, that the interval holds the true one, in [0, 1).

    Returns
    -------
    lower : float
        Lower bound.
    upper : float
        Upper bound.

    Raises
    ------
    ValueError
        As `proportion_interval`, and for other shapes.

    Notes
    -----
    The lower bound is that of groups all of which exceeded, the upper one that of groups any of
    which did: the probability lies between those of both, whatever the dependence.
    """
    hits, labels = np.asarray(exceeded, dtype=bool), np.asarray(group)
    function = "proportion_interval_by_group"
    rule = "a label for each observation"
    require(hits.shape == labels.shape, function, "group", labels.size, rule)
    groups = [hits[labels == label] for label in np.unique(labels)]
    lower, _ = proportion_interval(sum(one.all() for one in groups), len(groups), level)
    _, upper = proportion_interval(sum(one.any() for one in groups), len(groups), level)
    return float(lower), float(upper)


@dataclass(frozen=True, eq=False)
class Fragility:
    """Probability Phi(ln(im/median)/dispersion) that a limit is exceeded, with its uncertainty.

    Parameters
    ----------
    median : float
        Intensity at which half exceed the limit [unit of the intensity].
    dispersion : float
        Standard deviation of its logarithm.
    covariance : ndarray
        Covariance (2, 2) of median and dispersion, the inverse of the expected Fisher information,
        or that of `fit_fragility` by `group`.
    intensity : ndarray
        Intensities of the observations (n,).
    exceeded : ndarray
        Number of motions that exceeded the limit at each (n,).
    number : ndarray
        Number of motions at each (n,).
    left_out : int, optional
        Number of cases without an answer, which are not counted.
    groups : int, optional
        Number of groups of motions that depend on one another; 0 where all are independent.
    not_counted : str, optional
        How cases without an answer ended and what follows if they are counted, in words.
    """

    median: float
    dispersion: float
    covariance: np.ndarray
    intensity: np.ndarray
    exceeded: np.ndarray
    number: np.ndarray
    left_out: int = 0
    groups: int = 0
    not_counted: str = ""

    def probability(self, im: ArrayLike) -> np.ndarray:
        """Probability that the limit is exceeded at intensities.

        Parameters
        ----------
        im : array_like
            Intensities, any shape.

        Returns
        -------
        ndarray
            Probabilities in the shape of `im`.
        """
        return ndtr(self._deviates(im))

    def bounds(self, im: ArrayLike, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Confidence bounds of the probability at intensities.

        Parameters
        ----------
        im : array_like
            Intensities, any shape.
        level : float, optional
            Probability that both bounds lie around the true curve at an intensity.

        Returns
        -------
        lower : ndarray
            Lower bound in the shape of `im`.
        upper : ndarray
            Upper bound in the shape of `im`.

        Raises
        ------
        ValueError
            For a level that does not lie between 0 and 1.

        Notes
        -----
        They are Wald's: of the normal deviate ln(im/median)/dispersion, by the covariance and the
        normal distribution, of groups Student's with groups - 1 degrees of freedom.
        """
        deviates, reach = self._deviates(im), self._reach("bounds", level)
        at_zero, mixed, of_square = self._variance
        reach = reach * np.sqrt(at_zero + 2.0 * mixed * deviates + of_square * deviates**2)
        return ndtr(deviates - reach), ndtr(deviates + reach)

    def quantile(self, probability: float, level: float = 0.95) -> Estimate:
        """Intensity at which the limit is exceeded with a probability, and its interval.

        Parameters
        ----------
        probability : float
            Probability, between 0 and 1.
        level : float, optional
            Level of the interval, at whose ends a bound of the curve has this probability; from 0
            to infinity where the slope may be zero.

        Returns
        -------
        Estimate
            Intensity with its bounds.

        Raises
        ------
        ValueError
            For a probability or a level that does not lie between 0 and 1.

        References
        ----------
        Fieller (1954), Journal of the Royal Statistical Society B 16(2), 175-185.
        """
        require(0.0 < probability < 1.0, "quantile", "probability", probability, _WITHIN)
        reach = self._reach("quantile", level)
        (at_zero, mixed, of_square), deviate = reach**2 * self._variance, float(ndtri(probability))
        value = self.median * np.exp(self.dispersion * deviate)
        # the ends are the deviates x with (x - deviate)**2 = at_zero + 2 mixed x + of_square x**2
        if of_square >= 1.0:
            return Estimate(float(value), 0.0, np.inf)
        middle = (deviate + mixed) / (1.0 - of_square)
        away = np.sqrt(middle**2 - (deviate**2 - at_zero) / (1.0 - of_square))
        ends = self.median * np.exp(self.dispersion * (middle + np.array([-away, away])))
        return Estimate(*map(float, (value, *ends)))

    def fractions(self) -> tuple[np.ndarray, np.ndarray]:
        """Part of the motions that exceeded the limit at each intensity.

        Returns
        -------
        intensity : ndarray
            Different intensities (k,).
        fraction : ndarray
            Part at each (k,).
        """
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
        median, low, high = self.quantile(0.5)
        told = (
            f"Fragility: median {median:.4g} ({low:.4g} to {high:.4g} at 95 %), "
            f"dispersion {self.dispersion:.4g}; {self.grouped}"
        )
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
    """Lognormal fragility curve of the greatest likelihood.

    Parameters
    ----------
    intensity : array_like
        Intensity of the ground motion, above zero [any unit].
    exceeded : array_like
        Number of the motions of that intensity that exceeded the limit; for single motions True or
        False.
    number : array_like, optional
        Number of motions of that intensity. The three broadcast.
    left_out : int, optional
        Number of cases that gave no answer, for the result.
    group : array_like, optional
        Recording of each observation, where each of n recordings is scaled to several intensities;
        any labels, of a shape that broadcasts with the others. Observations of one recording are
        not independent.

    Returns
    -------
    Fragility
        Curve with its uncertainty.

    Raises
    ------
    ValueError
        For numbers that cannot be, and where no curve is most likely: all or none exceeded, one
        intensity alone, observations that one intensity separates, or fractions that fall as the
        intensity rises.

    Notes
    -----
    The likelihood of ln-normal limits is that of a probit regression on ln(intensity), whose
    maximum is unique.

    With `group` the covariance is that of scores which one capacity of the recording decides, from
    which on it exceeds the limit. Where a recording has several motions, such as both its
    components, intervals of the curve are upper bounds, since they may depend on one another fully.
    The sandwich of Liang and Zeger (1986), Biometrika 73(1), 13-22, is too small for tens of
    recordings, see ``benchmarks/dependence.py``.

    References
    ----------
    Baker (2015), Earthquake Spectra 31(1), 579-599, equation 11.

    Examples
    --------
    >>> from rockeom.analysis import risk
    >>> curve = risk.fit_fragility([0.2, 0.4, 0.6, 0.8], exceeded=[1, 4, 9, 10], number=10)
    >>> round(curve.median, 2)
    0.38
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
    groups, spread = 0, np.linalg.inv(information)
    if group is not None:
        groups = len(np.unique(labels))
        spread = spread @ _between(columns, np.array([level, slope]), of, labels) @ spread
    if slope <= 0.0 or abs(level) > _FLATTEST * slope:
        raise ValueError(f"{function}: the fraction that exceeds falls as the intensity rises")
    median, dispersion = np.exp(centre - level / slope), 1.0 / slope
    turned = np.array(
        [[-median / slope, median * level / slope**2], [0.0, -1.0 / slope**2]]
    )  # of median and dispersion by level and slope
    covariance = turned @ spread @ turned.T
    return Fragility(float(median), float(dispersion), covariance, im, hits, of, left_out, groups)


@explained.calls()
def fragility_of(
    sweep: xr.Dataset,
    *,
    intensity: str,
    limit: float | None = None,
    demand: str | None = None,
    group: str | None = "recording",
) -> Fragility:
    """Fragility curve of a sweep of `simulate_many`, all its other names taken together.

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset of `simulate_many`.
    intensity : str
        Name of one of the sweep's dimensions or coordinates.
    limit : float, optional
        Limit of the demand [its unit]; whatever overturns exceeds it. If neither is given,
        overturning is meant.
    demand : str, optional
        State or quantity whose largest size is to stay below the limit.
    group : str, optional
        Name of the sweep's, of which each value stands for motions that depend on one another; None
        for none that do. By default "recording": that of each `motion`, by the names of its
        components, where the sweep has two motions or more.

    Returns
    -------
    Fragility
        Curve with its uncertainty.

    Raises
    ------
    ValueError
        As `fit_fragility`, for names that the sweep does not have, and for cases that were not run.

    Notes
    -----
    Cases that gave no answer do not count; `Fragility.not_counted` says how many ended in which
    way, and the median and dispersion, or the fraction at each intensity where no curve fits, with
    all of them counted as fallen, and as standing.

    Examples
    --------
    >>> import numpy as np
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> motions = [rk.GroundMotion.kanai_tajimi(0.02, duration=8.0, seed=s) for s in range(20)]
    >>> def shaken(pga, motion):
    ...     return rk.Case(block, motion.scaled_to(peak=pga))
    >>> over = {"pga": np.linspace(2.5, 4.0, 4), "motion": rk.MotionSet(motions)}  # m/s2
    >>> curve = analysis.fragility_of(rk.simulate_many(shaken, over), intensity="pga")
    >>> 2.5 < curve.median < 4.0  # m/s2
    True

    Of a rotation instead of overturning::

        analysis.fragility_of(sweep, intensity="pga", demand="theta", limit=0.05)  # rad
    """
    if (limit is None) != (demand is None):
        raise InputError("limit", limit, "fragility_of").give("demand and limit, or neither")
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
    require(n > 1, "fit_fragility", "group", n, _ONE_GROUP)
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
_ONE_GROUP = (
    "motions of one recording alone tell nothing of others: give more recordings, or group=None "
    "for motions that do not depend on one another"
)
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
