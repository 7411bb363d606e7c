"""Measured against simulated ensembles: tests of peaks and outcomes, and the distance of the means.

A campaign that is compared with m simulated campaigns of the same tests has `predictive_test`,
which compares each test with its own simulations. The others take two independent ensembles, such
as those of two laboratories.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy import stats

from rockeom.analysis.risk.fragility import Estimate
from rockeom.analysis.validation.ensembles import Ensemble
from rockeom.numbers.checks import InputError, require, require_word


class Significance(NamedTuple):
    """Statistic of a test, and its significance.

    Parameters
    ----------
    statistic : float
        Statistic.
    p_value : float
        Probability of one as large where both ensembles are alike.
    """

    statistic: float
    p_value: float


PEAK_TESTS = ("cramer-von mises", "kolmogorov-smirnov", "anderson-darling")
OUTCOME_TESTS = ("fisher", "barnard")
_DRAWS = 9999
_PAIRS = 1999
_AT_ONCE = 2**21
"""Motions that are drawn at once."""


def compare_peaks(
    measured: Ensemble, simulated: Ensemble, test: str = "cramer-von mises", *, seed: int = 0
) -> Significance:
    """Test whether two independent ensembles have peaks of one distribution, overturning included.

    Parameters
    ----------
    measured : Ensemble
        Ensemble of any shape; all its motions count together.
    simulated : Ensemble
        Other ensemble of any shape.
    test : str, optional
        Test whose statistic is the difference of the two empirical distributions F and G: the
        largest, of "kolmogorov-smirnov"; the mean over all motions of ``(F - G)**2``, of
        "cramer-von mises"; or of ``(F - G)**2/(H (1 - H))``, of "anderson-darling", which sees more
        of the tails. H is that of both together; the means are times n m/(n + m). Choose it before
        you look.
    seed : int, optional
        Seed of the draws of the p-value.

    Returns
    -------
    Significance
        Statistic and p-value.

    Raises
    ------
    ValueError
        For another test.

    Notes
    -----
    Overturned motions are above all others and equal to each other. Equal values are not for the
    tables of these tests: of 20 motions and 200, of which three in ten overturn,
    ``cramervonmises_2samp`` of scipy.stats rejects always and ``anderson_ksamp`` in 7 % instead of
    5 %. The p-value is that of 9999 random divisions of all motions among both ensembles instead,
    exact for any equal values; it is 1e-4 at least. Peaks of the same records are not independent,
    which makes a rejection rarer than stated: use `predictive_test` for them.
    """
    _known("compare_peaks", test, PEAK_TESTS)
    both = np.concatenate([measured.peaks.ravel(), simulated.peaks.ravel()])
    n, total = measured.number, len(both)
    last = np.cumsum(np.unique(both, return_counts=True)[1])  # places up to which values are equal
    order = np.argsort(both, kind="stable")
    statistic = float(_difference(test, (order < n)[None, :], last)[0])
    rng = np.random.default_rng(seed)
    as_large = 0
    for start in range(0, _DRAWS, rows := max(1, _AT_ONCE // total)):
        drawn = np.tile(np.arange(total) < n, (min(rows, _DRAWS - start), 1))
        others = _difference(test, rng.permuted(drawn, axis=1), last)
        as_large += int((others >= statistic * (1.0 - 1e-9)).sum())
    return Significance(statistic, (1 + as_large) / (1 + _DRAWS))


def _difference(test: str, measured: np.ndarray, last: np.ndarray) -> np.ndarray:
    """(k,) statistic of k divisions (k, N) of ordered motions; last : ends of equal values."""
    total = measured.shape[1]
    n = int(measured[0].sum())
    f = np.cumsum(measured, axis=1, dtype=np.int32)[:, last - 1] / n
    h = last / total
    apart = (f - h) * total / (total - n)  # F - G
    if test == "kolmogorov-smirnov":
        return np.abs(apart).max(axis=1)
    weights = np.diff(last, prepend=0) * n * (total - n) / total**2
    if test == "anderson-darling":  # all values but the largest, where F = G = 1
        apart, weights, h = apart[:, :-1], weights[:-1], h[:-1]
        weights = weights / (h * (1.0 - h))
    return apart**2 @ weights


def compare_outcomes(measured: Ensemble, simulated: Ensemble, test: str = "fisher") -> Significance:
    """Test whether two independent ensembles overturn with one probability, by an exact test.

    Parameters
    ----------
    measured : Ensemble
        Ensemble of any shape; all its motions count together.
    simulated : Ensemble
        Other ensemble of any shape.
    test : str, optional
        "fisher", of the numbers that overturned in both together, with the odds ratio as statistic;
        or "barnard", which rejects more often and takes long for ensembles of more than some
        hundreds of motions. Both by scipy.stats.

    Returns
    -------
    Significance
        Statistic and p-value.

    Raises
    ------
    ValueError
        For another test.
    """
    _known("compare_outcomes", test, OUTCOME_TESTS)
    fell = [int(one.overturned.sum()) for one in (measured, simulated)]
    table = [fell, [measured.number - fell[0], simulated.number - fell[1]]]
    if sum(fell) in (0, measured.number + simulated.number):
        return Significance(float("nan"), 1.0)
    done = stats.fisher_exact(table) if test == "fisher" else stats.barnard_exact(table)
    return Significance(float(done.statistic), float(done.pvalue))


def compare_means(
    measured: Ensemble,
    simulated: Ensemble,
    *,
    limit: float | None = None,
    level: float = 0.95,
    seed: int = 0,
) -> Estimate:
    """Mean measured peak less the mean simulated one, with its interval of confidence.

    Parameters
    ----------
    measured : Ensemble
        Measured ensemble (n,).
    simulated : Ensemble
        Simulated ensemble (n, m), m campaigns of the same tests; or (m,), an independent ensemble.
    limit : float, optional
        Limit up to which peaks count, as in `Ensemble.censored`: needed where a motion overturned.
    level : float, optional
        Probability that the interval holds the true distance.
    seed : int, optional
        Seed of the draws, for (m,).

    Returns
    -------
    Estimate
        Difference with its interval, in the unit of the peaks.

    Raises
    ------
    ValueError
        For fewer than two motions, and fewer campaigns than tell the level.

    Notes
    -----
    The interval is that of Student's statistic, distance over standard error, whose distribution
    follows from the simulations, not from a table: few skewed peaks are not normal. The m campaigns
    have it one by one, with a parameter that is the same in all tests of a campaign, too; from an
    independent ensemble 1999 pairs of ensembles are drawn (bootstrap-t: Efron and Tibshirani 1993,
    An Introduction to the Bootstrap, 12.5). The peaks may be shifted and scaled against those of
    the model, but have its shape.
    """
    require(0.0 < level < 1.0, "compare_means", "level", level, "it lies between 0 and 1")
    x, y = measured.censored(limit), simulated.censored(limit)
    if len(x) < 2 or len(y) < 2:
        raise InputError("ensembles", of="compare_means").says(
            "an interval needs two motions or more of each ensemble"
        )
    if y.ndim == 1:
        student, drawn = _student(x, y), _pairs(np.random.default_rng(seed), len(x), y)
    else:
        mean = _of_tests("compare_means", measured, y).mean(axis=1)
        student, drawn = _student(x - mean), _student(y - mean[:, None])
    needed = math.ceil(2.0 / (1.0 - level) - 1e-9) - 1
    rule = f"an interval of this level takes {needed} campaigns: simulate more, or take a lower one"
    require(len(drawn[0]) >= needed, "compare_means", "level", level, rule)
    with np.errstate(divide="ignore", invalid="ignore"):  # of motions that all have one peak
        places = np.nan_to_num(drawn[0] / drawn[1])
    tail = 0.5 * (1.0 - level)
    low, high = np.quantile(places, [tail, 1.0 - tail], method="weibull")
    value, error = student
    return Estimate(float(value), float(value - high * error), float(value - low * error))


def _student(x: np.ndarray, y: np.ndarray | None = None) -> np.ndarray:
    """(distance, standard error) of the mean of x (n, ...) from that of y (m, ...), or from 0."""
    distance, variance = x.mean(axis=0), x.var(axis=0, ddof=1) / len(x)
    if y is not None:
        distance, variance = distance - y.mean(axis=0), variance + y.var(axis=0, ddof=1) / len(y)
    return np.array([distance, np.sqrt(variance)])


def _pairs(rng: np.random.Generator, n: int, y: np.ndarray) -> np.ndarray:
    """`_student` of pairs of ensembles of n and m motions, both drawn from y (m,)."""
    at_once = max(1, _AT_ONCE // (n + len(y)))
    sizes = np.diff([*range(0, _PAIRS, at_once), _PAIRS])
    drawn = (rng.choice(y, (n + len(y), int(size))) for size in sizes)
    return np.concatenate([_student(both[:n], both[n:]) for both in drawn], axis=1)


class Prediction(NamedTuple):
    """Campaign among those that a model simulates, of `predictive_test`.

    Parameters
    ----------
    bias : float
        Mean place of the measured peaks among the simulated ones of their tests, less a half: 0 if
        the model is right, up to -0.5 or 0.5 where all are smaller or larger.
    distance : float
        Mean distance of the measured peaks from the simulated ones of their tests, over that of two
        campaigns of all: 1 if the model is right, more where peaks lie outside or overturn where
        none should, less where the model scatters too much.
    bias_p : float
        Part of all campaigns whose bias is as far from 0.
    distance_p : float
        Part of all campaigns whose distance is as far from the median.
    p_value : float
        Part of all campaigns of which the smaller of both is as small: one test of both.
    """

    bias: float
    distance: float
    bias_p: float
    distance_p: float
    p_value: float


def predictive_test(
    measured: Ensemble, simulated: Ensemble, *, limit: float | None = None
) -> Prediction:
    """Test whether a campaign may be one of those that a model with uncertain parameters simulates.

    Parameters
    ----------
    measured : Ensemble
        Measured ensemble (n,), of n tests.
    simulated : Ensemble
        Simulated ensemble (n, m), each column a campaign of the same tests.
    limit : float, optional
        Limit up to which peaks count in distances, as in `Ensemble.censored`: needed where a motion
        overturned. In places, overturned motions are above all peaks.

    Returns
    -------
    Prediction
        Bias, distance and their p-values.

    Raises
    ------
    ValueError
        For other shapes.

    Notes
    -----
    The measured campaign is the first of m + 1, and two numbers of each campaign are compared with
    those of all: the bias of its peaks, and their distance from the peaks of the others
    (`Prediction`). If the model is right, the measured campaign is any of them: the p-values hold
    at most as often as they say, for any n and m, records that differ, motions that overturn, and
    parameters that all tests of a campaign share (Barnard 1963). They are 1/(m + 1) at least.

    Places depend on the smallest differences: noise of a sensor in place of a block at rest is a
    bias. `Ensemble.resolved` removes it from both ensembles.

    References
    ----------
    Barnard (1963), Journal of the Royal Statistical Society B 25(2), 294.

    Examples
    --------
    >>> import numpy as np
    >>> from rockeom.analysis import validation
    >>> drawn = np.random.default_rng(1).lognormal(-2.5, 0.4, (30, 199))  # rad
    >>> simulated = validation.Ensemble(drawn)
    >>> measured = validation.Ensemble(1.5 * drawn[:, 0])
    >>> prediction = validation.predictive_test(measured, simulated)
    >>> prediction.bias > 0.2, prediction.p_value < 0.01
    (True, True)
    """
    _of_tests("predictive_test", measured, simulated.peaks)
    ranked = np.column_stack([measured.peaks, simulated.peaks])
    places = (stats.rankdata(ranked, axis=1) - 0.5) / ranked.shape[1]
    bias = places.mean(axis=0) - 0.5
    counted = np.column_stack([measured.censored(limit), simulated.censored(limit)])
    apart = _mean_distances(counted).mean(axis=0)
    usual = apart.mean()
    distance = apart / usual if usual > 0 else np.ones_like(apart)
    parts = _as_large(np.abs(bias)), _as_large(np.abs(distance - np.median(distance)))
    return Prediction(
        float(bias[0]), float(distance[0]), float(parts[0][0]), float(parts[1][0]),
        float(_as_large(-np.minimum(*parts))[0]),
    )  # fmt: skip


def _as_large(values: np.ndarray) -> np.ndarray:
    """The part of all values (k,) that are as large as each; rounding makes none larger."""
    return 1.0 - np.searchsorted(np.sort(values), values - 1e-12) / len(values)


def _mean_distances(x: np.ndarray) -> np.ndarray:
    """Mean of |x - y| over all y of the row of each x (n, k), by sums over the sorted row."""
    order = np.argsort(x, axis=1)
    y = np.take_along_axis(x, order, axis=1)
    y = y - y[:, :1]  # equal values leave no rounding error
    below = np.cumsum(y, axis=1)
    count = np.arange(1, x.shape[1] + 1)
    distances = (2 * count - x.shape[1]) * y + below[:, -1:] - 2 * below
    means = np.empty_like(x)
    np.put_along_axis(means, order, distances / x.shape[1], axis=1)
    return means


def _of_tests(function: str, measured: Ensemble, simulated: np.ndarray) -> np.ndarray:
    """The simulated peaks, if they are (n, m) for n measured ones."""
    if measured.peaks.ndim == 1 and simulated.ndim == 2 and len(simulated) == measured.number:
        return simulated
    raise InputError("measured", of=function).wrong(
        f"has the shape {measured.peaks.shape}, simulated {simulated.shape}: give (n,) peaks of n "
        "tests and (n, m) peaks of m motions of each of these tests"
    )


def _known(function: str, test: str, tests: tuple[str, ...]) -> None:
    require_word("test", test, tests, function)
