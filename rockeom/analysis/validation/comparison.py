"""Measured against simulated ensembles: tests of peaks and outcomes, and the distance of the means.

A campaign that is compared with m simulated campaigns of the same tests has `predictive_test`,
which compares each test with its own simulations. The others take two independent ensembles, such
as those of two laboratories.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import stats

from rockeom.analysis.risk.fragility import Estimate
from rockeom.analysis.validation.ensembles import Ensemble
from rockeom.numbers.arguments import require
from rockeom.numbers.checks import near


class Significance(NamedTuple):
    """The statistic of a test, and how likely one as large is where both ensembles are alike."""

    statistic: float
    p_value: float


PEAK_TESTS = ("cramer-von mises", "kolmogorov-smirnov", "anderson-darling")
OUTCOME_TESTS = ("fisher", "barnard")
_DRAWS = 9999
_AT_ONCE = 2**21
"""Motions that are drawn at once."""


def compare_peaks(
    measured: Ensemble, simulated: Ensemble, test: str = "cramer-von mises", *, seed: int = 0
) -> Significance:
    """Whether two independent ensembles have peaks of one distribution, overturning included.

    measured, simulated : of any shapes; all motions of an ensemble are taken together.
    test : whose statistic is the difference of the two empirical distributions F and G: the
        largest, of "kolmogorov-smirnov"; the mean over all motions of (F - G)**2, of "cramer-von
        mises"; or of (F - G)**2/(H (1 - H)), of "anderson-darling", which sees more of the tails.
        H is that of both together; the means are times n m/(n + m). Choose it before you look.
    seed : of the draws of the p-value.

    Overturned motions are above all others and equal to each other. So many equal values are not
    for the tables of the tests: with three motions of ten overturned, `cramervonmises_2samp` of
    scipy.stats rejects nearly always and `anderson_ksamp` too often. The p-value is that of 9999
    random divisions of all motions among both ensembles instead, exact for any equal values; it is
    1e-4 at least. Peaks of the same records are not independent, which makes a rejection rarer
    than stated: use `predictive_test` for them.

    Raises ValueError for another test.
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
    """Whether two independent ensembles overturn with one probability, by an exact test.

    measured, simulated : of any shapes; all motions of an ensemble are taken together.
    test : "fisher", of the numbers that overturned in both together, with the odds ratio as
        statistic; or "barnard", which rejects more often and takes long for ensembles of more than
        some hundreds of motions. Both by scipy.stats.

    Raises ValueError for another test.
    """
    _known("compare_outcomes", test, OUTCOME_TESTS)
    fell = [int(one.overturned.sum()) for one in (measured, simulated)]
    table = [fell, [measured.number - fell[0], simulated.number - fell[1]]]
    if sum(fell) in (0, measured.number + simulated.number):
        return Significance(float("nan"), 1.0)
    done = stats.fisher_exact(table) if test == "fisher" else stats.barnard_exact(table)
    return Significance(float(done.statistic), float(done.pvalue))


def compare_means(
    measured: Ensemble, simulated: Ensemble, *, limit: float | None = None, level: float = 0.95
) -> Estimate:
    """Mean measured peak less the mean simulated one, with its interval of confidence.

    measured : (n,). simulated : (n, m), and the interval is that of the n differences from the
        mean of the simulations of the same test; or (m,), an independent ensemble.
    limit : up to which peaks count, as of `Ensemble.censored`: needed where a motion overturned.
    level : probability that the interval holds the true distance, by Student's distribution, of
        Welch (1947) for independent ensembles. It is approximate for few tests and skewed peaks.

    The interval is for tests drawn at random. Doubt in a parameter that is the same in all of them
    is no scatter between them: `predictive_test` has it.
    """
    require(0.0 < level < 1.0, "compare_means", "level", level, "it lies between 0 and 1")
    x, y = measured.censored(limit), simulated.censored(limit)
    if len(x) < 2 or len(y) < 2:
        raise ValueError("compare_means: an interval needs two motions or more of each ensemble")
    if y.ndim == 1:
        done = stats.ttest_ind(x, y, equal_var=False)
        value = float(x.mean() - y.mean())
    else:
        apart = x - _of_tests("compare_means", measured, y).mean(axis=1)
        done, value = stats.ttest_1samp(apart, 0.0), float(apart.mean())
    return Estimate(value, *map(float, done.confidence_interval(level)))


def predictive_test(measured: Ensemble, simulated: Ensemble) -> Significance:
    """Whether a campaign may be one of those that a model with uncertain parameters simulates.

    measured : (n,), of n tests. simulated : (n, m), each column a campaign of the same tests.

    The rank of each peak among those of its own test, over m + 1, is uniform if the model is right.
    The statistic is the distance of Cramer and von Mises of these n ranks from uniform ones, of
    the measured campaign and likewise of each simulated one; the p-value is the part of all m + 1
    campaigns whose distance is as large (Barnard 1963, Journal of the Royal Statistical Society B
    25(2), 294). It is exact for any n and m, with records that differ, with motions that overturn
    and with parameters that all tests of a campaign share; it is 1/(m + 1) at least.

    Raises ValueError for another shape.
    """
    peaks = _of_tests("predictive_test", measured, simulated.peaks)
    all_ = np.column_stack([measured.peaks, peaks])
    n, campaigns = all_.shape
    places = np.sort((stats.rankdata(all_, axis=1) - 0.5) / campaigns, axis=0)
    uniform = (np.arange(n) + 0.5) / n
    distances = ((places - uniform[:, None]) ** 2).sum(axis=0) + 1.0 / (12 * n)
    return Significance(float(distances[0]), float((distances >= distances[0]).mean()))


def _of_tests(function: str, measured: Ensemble, simulated: np.ndarray) -> np.ndarray:
    """The simulated peaks, if they are (n, m) for n measured ones."""
    if measured.peaks.ndim == 1 and simulated.ndim == 2 and len(simulated) == measured.number:
        return simulated
    raise ValueError(
        f"{function}: measured has the shape {measured.peaks.shape}, simulated {simulated.shape}: "
        "give (n,) peaks of n tests and (n, m) peaks of m motions of each of these tests"
    )


def _known(function: str, test: str, tests: tuple[str, ...]) -> None:
    if test not in tests:
        raise ValueError(
            f"{function}: test is {test!r}{near(test, tests)}: choose one of {', '.join(tests)}"
        )
