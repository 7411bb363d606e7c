"""Reliability diagrams: how often motions overturn to which a model gives one probability."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.risk.fragility import proportion_interval
from rockeom.numbers.checks import InputError, numbers, require, whole_number

_DRAWS = 9999


@dataclass(frozen=True, eq=False)
class Calibration:
    """Predicted probabilities of overturning against observed frequencies, in k bins.

    Parameters
    ----------
    number : ndarray
        Number of tests of each bin (k,); bins without a test are left out.
    probability : ndarray
        Mean of the probabilities predicted for them (k,).
    frequency : ndarray
        Part of them that overturned (k,).
    lower : ndarray
        Lower confidence bound of the probability that the frequency tells, if tests are independent
        (k,).
    upper : ndarray
        Upper confidence bound (k,).
    expected_lower : ndarray
        Lower bound of the frequency (k,), with the same level, if the predicted probabilities are
        right.
    expected_upper : ndarray
        Upper bound of the frequency (k,).
    p_value : float
        Probability of frequencies as far from the predictions, all bins together, if these are
        right.
    level : float
        Level of the bounds.
    campaigns : int, optional
        Number of campaigns given as `outcomes`; 0 where tests count as independent.
    """

    number: np.ndarray
    probability: np.ndarray
    frequency: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    expected_lower: np.ndarray
    expected_upper: np.ndarray
    p_value: float
    level: float
    campaigns: int = 0

    @property
    def basis(self) -> str:
        """With what tests are compared, in words."""
        return f"by {self.campaigns} campaigns" if self.campaigns else "assumes independent tests"

    def __repr__(self) -> str:
        lines = [
            f"{self.number.sum()} tests: p = {self.p_value:.3g} if the probabilities are right; "
            f"{self.basis}"
        ]
        for n, p, f, low, high in zip(
            self.number, self.probability, self.frequency, self.expected_lower,
            self.expected_upper, strict=True,
        ):  # fmt: skip
            lines.append(
                f"predicted {p:.3f}, observed {f:.3f} of {n} ({low:.3f} to {high:.3f} if right)"
            )
        return "\n".join(lines)


def calibration_of(
    overturned: ArrayLike,
    probability: ArrayLike,
    bins: int | ArrayLike = 5,
    *,
    outcomes: ArrayLike | None = None,
    level: float = 0.95,
    seed: int = 0,
) -> Calibration:
    """Check whether as many motions overturn as a model predicts, for small and large
    probabilities.

    Parameters
    ----------
    overturned : array_like
        True or False (n,), the measured outcome of each test.
    probability : array_like
        Probability (n,) predicted for it, such as `Ensemble.overturning_probability`.
    bins : int or array_like, optional
        Number of equal bins from 0 to 1, or their bounds in ascending order.
    outcomes : array_like, optional
        True or False (n, m), of m campaigns of the same tests that the model simulates, such as
        ``simulated.overturned``. Without them the function **assumes independent tests**, and
        rejects a right model too often where they share a parameter, such as the width of the
        specimen.
    level : float, optional
        Level of the bounds of `Calibration`.
    seed : int, optional
        Seed of the draws of the p-value.

    Returns
    -------
    Calibration
        Frequencies and probabilities of the bins, and the p-value.

    Raises
    ------
    ValueError
        For probabilities that do not lie between 0 and 1, bounds that leave one out, where n
        differs, for probabilities that the campaigns contradict, and for fewer campaigns than tell
        the level.

    Notes
    -----
    The p-value is that of the sum over the bins of the squared excess of the count over its
    variance. With `outcomes` the measured campaign is one of m + 1: each is compared with the
    probabilities by all others, and its part of those that are as far off holds whatever tests
    share (Barnard 1963). Expected ranges are order statistics of the campaigns.

    Without them 9999 draws of all outcomes are compared. The interval of a frequency is that of
    `risk.proportion_interval`; where the probabilities of a bin differ, it holds their mean at
    least as often (Hoeffding 1956). The expected range is exact, of a sum of outcomes of unequal
    probabilities (Broecker and Smith 2007).

    References
    ----------
    Barnard (1963), Journal of the Royal Statistical Society B 25(2), 294; Broecker and Smith
    (2007), Weather and Forecasting 22(3), 651-661.

    Examples
    --------
    >>> from rockeom import analysis
    >>> overturned = [False, False, True, False, True, True]
    >>> analysis.validation.calibration_of(overturned, [0.1, 0.1, 0.1, 0.8, 0.8, 0.8], bins=2)
    6 tests: p = 0.35 if the probabilities are right; assumes independent tests
    predicted 0.100, observed 0.333 of 3 (0.000 to 0.667 if right)
    predicted 0.800, observed 0.667 of 3 (0.333 to 1.000 if right)
    """
    where = "calibration_of"
    fell, p = numbers(where, overturned=overturned, probability=probability)
    require((fell == 0) | (fell == 1), where, "overturned", fell, "give True or False")
    require((p >= 0) & (p <= 1), where, "probability", p, "it lies between 0 and 1")
    require(0.0 < level < 1.0, where, "level", level, "it lies between 0 and 1, as 0.95")
    fell, p = (np.atleast_1d(a).ravel() for a in np.broadcast_arrays(fell, p))
    member, tail = _members(where, p, bins), 0.5 * (1.0 - level)
    number, hits = member.sum(axis=1), member @ fell
    if outcomes is None:
        campaigns = 0
        ranges = np.array([_range(p[row], tail) for row in member])
        drawn = np.random.default_rng(seed).random((_DRAWS, len(p))) < p
        excess = _excess(np.vstack([fell, drawn]), p, member)
    else:
        every = np.vstack([fell, _campaigns(where, outcomes, len(fell), level)])
        campaigns = len(every) - 1
        least, most = proportion_interval(every[1:].sum(axis=0), campaigns, _CONTRADICTED)
        require((p >= least) & (p <= most), where, "probability", p, _OF_ONE_MODEL)
        place = math.floor(tail * len(every) + 1e-9)
        ranges = np.sort(member @ every[1:].T, axis=1)[:, [place - 1, -place]]
        # bins by all campaigns alike, the measured one too: each could be any of them
        alike = _members(where, np.clip(every.mean(axis=0), p.min(), p.max()), bins)
        excess = _excess(every, (every.sum(axis=0) - every + 0.5) / len(every), alike)
    (lower, upper), (low, high) = proportion_interval(hits, number, level), ranges.T / number
    return Calibration(
        number, member @ p / number, hits / number, lower, upper, low, high,
        float((excess >= excess[0] * (1 - 1e-12)).mean()), level, campaigns,
    )  # fmt: skip


_CONTRADICTED = 1.0 - 1e-6
"""Level of the interval of a fraction of the campaigns that has the probability of a test."""
_OF_ONE_MODEL = "the campaigns of `outcomes` contradict it: give both of one model"


def _campaigns(where: str, outcomes: ArrayLike, n: int, level: float) -> np.ndarray:
    """(m, n) outcomes of campaigns of n tests, as many as an expected range needs."""
    (given,) = numbers(where, outcomes=outcomes)
    require((given == 0) | (given == 1), where, "outcomes", given, "give True or False")
    needed = math.ceil(2.0 / (1.0 - level) - 1e-9) - 1
    if given.ndim != 2 or len(given) != n or given.shape[1] < needed:
        raise InputError("outcomes", of=where).wrong(
            f"has the shape {given.shape}: give (n, m), here {n} tests and for this level {needed} "
            "campaigns or more"
        )
    return given.T


def _members(where: str, p: np.ndarray, bins: int | ArrayLike) -> np.ndarray:
    """(k, n) whether each bin has each test; bins without a test are left out."""
    if np.ndim(bins) == 0:
        edges = np.linspace(0.0, 1.0, whole_number("bins", bins, 1, where) + 1)
    else:
        (edges,) = numbers(where, bins=bins)
        require(np.diff(edges) > 0, where, "bins", edges[1:], "bounds must increase")
        rule = f"it lies in no bin: let them reach from {p.min():g} to {p.max():g}"
        require((p >= edges[0]) & (p <= edges[-1]), where, "probability", p, rule)
    place = np.clip(np.searchsorted(edges, p, side="right") - 1, 0, len(edges) - 2)
    member = place == np.arange(len(edges) - 1)[:, None]
    return member[member.any(axis=1)]


def _excess(fell: np.ndarray, p: np.ndarray, member: np.ndarray) -> np.ndarray:
    """Sum over the bins of squared excesses over their variance; infinite where none is.

    fell (..., n) : outcomes, whose last axis goes.
    """
    weights = member.T.astype(float)
    squares, variance = ((fell - p) @ weights) ** 2, (p * (1.0 - p)) @ weights
    impossible = np.where(squares > 0, np.inf, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(variance > 0, squares / variance, impossible).sum(axis=-1)


def _range(p: np.ndarray, tail: float) -> tuple[int, int]:
    """Least and largest count of outcomes with probabilities p, each tail beyond being smaller."""
    density = np.ones(1)
    for one in p:
        density = np.convolve(density, [1.0 - one, one])
    below = np.cumsum(density)
    return int((below <= tail).sum()), int((below < 1.0 - tail).sum())
