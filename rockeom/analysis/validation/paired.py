"""Two models judged by the same tests: which one is right more often, and by how much."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from rockeom.analysis.risk.fragility import Estimate
from rockeom.numbers.checks import InputError, numbers, require

_LEAST_GROUPS = 3


class Disagreement(NamedTuple):
    """Tests of which one of two models is right.

    Parameters
    ----------
    first : int
        Number of tests of which the first alone is right.
    second : int
        Number of tests of which the second alone is right.
    p_value : float
        Probability of numbers as far apart, if both models are right as often: McNemar's test,
        exact.
    """

    first: int
    second: int
    p_value: float


def disagreement(right: ArrayLike, other: ArrayLike) -> Disagreement:
    """McNemar's exact test of two models on the same tests.

    Parameters
    ----------
    right : array_like
        True or False (n,): whether the first model is right.
    other : array_like
        The same of the second.

    Returns
    -------
    Disagreement
        Numbers of tests on which they differ, and the p-value.

    Raises
    ------
    ValueError
        For other values than True and False, and for other than one of each test.

    Notes
    -----
    It **assumes independent tests**: where many have one record, see `paired_difference`.

    References
    ----------
    McNemar (1947), Psychometrika 12(2), 153-157.

    Examples
    --------
    >>> from rockeom.analysis import validation
    >>> validation.disagreement([True] * 8 + [False], [False] * 7 + [True] * 2)
    Disagreement(first=7, second=1, p_value=0.0703125)
    """
    one, two = numbers("disagreement", right=right, other=other)
    for name, values in (("right", one), ("other", two)):
        rule = "give True or False, whether the model is right"
        require((values == 0) | (values == 1), "disagreement", name, values, rule)
    if not one.ndim == two.ndim == 1 or one.shape != two.shape:
        raise InputError("other", other, "disagreement").give("one value of each model for a test")
    first, second = int((one > two).sum()), int((two > one).sum())
    p_value = stats.binomtest(first, first + second).pvalue if first + second else 1.0
    return Disagreement(first, second, float(p_value))


def paired_difference(
    score: ArrayLike,
    other: ArrayLike,
    groups: ArrayLike,
    *,
    level: float = 0.95,
) -> Estimate:
    """Difference of the mean scores of two models on the same tests, with an interval.

    Parameters
    ----------
    score : array_like
        Score (n,) of the first model on each test: whether it is right, or `brier_score`.
    other : array_like
        That of the second.
    groups : array_like
        What tests have in common (n,), such as the name of the record.
    level : float, optional
        Level of the interval.

    Returns
    -------
    Estimate
        Mean of ``score - other``, and its interval.

    Raises
    ------
    ValueError
        For fewer than three groups, and for a level that is no probability.

    Notes
    -----
    The standard error is that of the jackknife, which leaves out one group at a time, and the
    interval Student's with one degree of freedom less than groups. It holds the true difference in
    95 % of samples of 10, 20 and 49 groups of 1 to 24 tests; the bootstrap of whole groups, bias
    corrected and accelerated, in 91 % of 20 and 93 % of 49 (``python -m benchmarks.coverage``).

    References
    ----------
    Tukey (1958), Annals of Mathematical Statistics 29, 614; Efron (1987), Journal of the American
    Statistical Association 82, 171-185, of the bootstrap.

    Examples
    --------
    >>> from rockeom.analysis import validation
    >>> validation.paired_difference([1, 1, 0, 1], [0, 1, 0, 0], ["a", "a", "b", "c"]).value
    0.5
    """
    one, two = numbers("paired_difference", score=score, other=other)
    _, which = np.unique(np.asarray(groups), return_inverse=True)
    if not (one.ndim == 1 and one.shape == two.shape == which.shape):
        raise InputError("groups", groups, "paired_difference").give(
            "as many groups as scores of both models"
        )
    require(0.0 < level < 1.0, "paired_difference", "level", level, "it lies between 0 and 1")
    number = np.bincount(which)
    require(
        len(number) >= _LEAST_GROUPS, "paired_difference", "groups", len(number),
        f"give tests of {_LEAST_GROUPS} groups or more",
    )  # fmt: skip
    total, k = np.bincount(which, one - two), len(number)
    without = (total.sum() - total) / (number.sum() - number)
    error = float(np.sqrt((k - 1) / k * ((without - without.mean()) ** 2).sum()))
    value = float(total.sum() / number.sum())
    away = float(stats.t.ppf((1.0 + level) / 2.0, k - 1)) * error
    return Estimate(value, value - away, value + away)
