"""Reliability diagrams: how often motions overturn to which a model gives one probability."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.risk.fragility import proportion_interval
from rockeom.numbers.arguments import numbers, require
from rockeom.numbers.checks import whole_number

_DRAWS = 9999


@dataclass(frozen=True, eq=False)
class Calibration:
    """Predicted probabilities of overturning against observed frequencies, in k bins.

    number (k,) : tests of each bin; those without a test are left out.
    probability (k,) : mean of the probabilities predicted for them; frequency (k,) : which part of
        them overturned.
    lower, upper (k,) : confidence bounds of the probability that the frequency tells.
    expected_lower, expected_upper (k,) : between which the frequency lies, with the same level, if
        the predicted probabilities are right.
    p_value : how likely frequencies as far from the probabilities are, all bins together, if these
        are right.
    level : of the bounds.
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

    def __repr__(self) -> str:
        lines = [
            f"{self.number.sum()} tests: p = {self.p_value:.3g} if the probabilities are right"
        ]
        for n, p, f, low, high in zip(
            self.number, self.probability, self.frequency, self.lower, self.upper, strict=True
        ):
            lines.append(f"predicted {p:.3f}, observed {f:.3f} of {n} ({low:.3f} to {high:.3f})")
        return "\n".join(lines)


def calibration_of(
    overturned: ArrayLike,
    probability: ArrayLike,
    bins: int | ArrayLike = 5,
    *,
    level: float = 0.95,
    seed: int = 0,
) -> Calibration:
    """Whether as many motions overturn as a model predicts, for small and for large probabilities.

    overturned : (n,) True or False, the measured outcome of each test.
    probability : (n,) predicted for it, such as `Ensemble.overturning_probability`.
    bins : number of equal bins from 0 to 1, or their bounds in ascending order.
    level : of the bounds of `Calibration`. seed : of the draws of the p-value.

    The interval of a frequency is that of `risk.proportion_interval`; where the probabilities of a
    bin differ, it holds their mean at least as often (Hoeffding 1956). The expected range is exact,
    of a sum of outcomes of unequal probabilities (Broecker and Smith 2007, Weather and Forecasting
    22(3), 651-661). The p-value is that of the sum over the bins of the squared excess of the count
    over its variance, against 9999 draws of all outcomes.

    Raises ValueError for probabilities that do not lie between 0 and 1, bounds that leave one out,
    and where n differs.
    """
    where = "calibration_of"
    fell, p = numbers(where, overturned=overturned, probability=probability)
    require((fell == 0) | (fell == 1), where, "overturned", fell, "give True or False")
    require((p >= 0) & (p <= 1), where, "probability", p, "it lies between 0 and 1")
    require(0.0 < level < 1.0, where, "level", level, "it lies between 0 and 1, as 0.95")
    fell, p = (np.atleast_1d(a).ravel() for a in np.broadcast_arrays(fell, p))
    member = _members(where, p, bins)
    number, hits, expected = member.sum(axis=1), member @ fell, member @ p
    lower, upper = proportion_interval(hits, number, level)
    tail = 0.5 * (1.0 - level)
    ranges = np.array([_range(p[row], tail) for row in member]) / number[:, None]
    variance = member @ (p * (1.0 - p))
    drawn = np.random.default_rng(seed).random((_DRAWS, len(p))) < p
    excess = _excess(hits, expected, variance)
    others = _excess(drawn @ member.T.astype(float), expected, variance)
    p_value = (1 + int((others >= excess * (1 - 1e-12)).sum())) / (_DRAWS + 1)
    return Calibration(
        number, expected / number, hits / number, lower, upper, ranges[:, 0], ranges[:, 1],
        p_value, level,
    )  # fmt: skip


def _members(where: str, p: np.ndarray, bins: int | ArrayLike) -> np.ndarray:
    """(k, n) whether each bin has each test; bins without a test are left out."""
    if np.ndim(bins) == 0:
        edges = np.linspace(0.0, 1.0, whole_number(f"{where}: bins", bins, 1) + 1)
    else:
        (edges,) = numbers(where, bins=bins)
        require(np.diff(edges) > 0, where, "bins", edges[1:], "bounds must increase")
        rule = f"it lies in no bin: let them reach from {p.min():g} to {p.max():g}"
        require((p >= edges[0]) & (p <= edges[-1]), where, "probability", p, rule)
    place = np.clip(np.searchsorted(edges, p, side="right") - 1, 0, len(edges) - 2)
    member = place == np.arange(len(edges) - 1)[:, None]
    return member[member.any(axis=1)]


def _excess(hits: np.ndarray, expected: np.ndarray, variance: np.ndarray) -> np.ndarray:
    """Sum over the bins, the last axis, of squares over their variance; infinite where none is."""
    squares = (hits - expected) ** 2
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
