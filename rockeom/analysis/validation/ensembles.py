"""Peaks of an ensemble of motions, of which some overturned, and their empirical distribution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy.special import ndtri, stdtrit

from rockeom.analysis.sweeps import FALLS, check_finished, outcome_labels, peaks_of, unanswered
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, numbers, positive, require

_DRAWS = 999
_PLACES = 1000  # peaks at which distributions of campaigns are compared, at most


@explained.calls()
@dataclass(frozen=True, eq=False)
class Ensemble:
    """Peaks of motions, measured or simulated, of which some overturned.

    Parameters
    ----------
    peaks : ndarray
        Largest size of the rotation [rad], or of another demand, any shape; infinite where the
        motion overturned, whatever was given there, also NaN. Measured ensembles are (n,), of n
        tests; simulated ones (n, m), m motions of each of these tests, or (m,).
    overturned : ndarray, optional
        Whether each overturned, in the same shape; none if not given.

    Raises
    ------
    ValueError
        For a peak that is missing (NaN), infinite or negative although the motion did not overturn,
        and for shapes that differ.
    TypeError
        For outcomes other than True and False.

    Notes
    -----
    An overturned motion exceeds every rotation. So it ranks above all peaks, in distributions and
    tests. Where a number is needed, in means and CRPS, peaks are censored: each counts up to a
    limit, and an overturned motion as the limit.

    Examples
    --------
    >>> import numpy as np
    >>> from rockeom import analysis
    >>> outcomes = np.array(["stood", "overturned", "stood"])
    >>> measured = analysis.validation.Ensemble([0.05, np.nan, 0.12], outcomes == "overturned")
    >>> measured
    Ensemble: 3 motions, 1 overturned
    >>> measured.censored(limit=0.24)  # rad
    array([0.05, 0.24, 0.12])
    >>> measured.distribution([0.1, 0.2]).round(3)
    array([0.333, 0.667])
    """

    peaks: np.ndarray
    overturned: np.ndarray = False  # type: ignore[assignment]  # of the shape of the peaks, below

    def __post_init__(self) -> None:
        fell = np.asarray(self.overturned)
        if fell.dtype != bool:
            raise InputTypeError("overturned", self.overturned, "Ensemble").give(
                'True or False for each motion, such as outcomes == "overturned"'
            )
        try:
            peaks = np.asarray(self.peaks, dtype=float)
        except (TypeError, ValueError):
            raise InputTypeError("peaks", self.peaks, "Ensemble").give("numbers") from None
        fell = np.full(peaks.shape, fell) if fell.ndim == 0 else fell
        if fell.shape != peaks.shape or not peaks.size:
            raise InputError("peaks", of="Ensemble").wrong(
                f"has the shape {peaks.shape}, overturned {fell.shape}: give one peak and one "
                "outcome for each motion, and one motion or more"
            )
        rule = "every motion that did not overturn has a peak: find it, or leave the motion out"
        require(fell | np.isfinite(peaks), "Ensemble", "peaks", peaks, rule)
        require(fell | (peaks >= 0), "Ensemble", "peaks", peaks, "give the size of the rotation")
        object.__setattr__(self, "peaks", np.where(fell, np.inf, peaks))
        object.__setattr__(self, "overturned", fell)

    @classmethod
    def from_sweep(cls, sweep: xr.Dataset, quantity: str = "theta") -> Ensemble:
        """Ensemble of a sweep of `simulate_many`.

        Parameters
        ----------
        sweep : xarray.Dataset
            Dataset of `simulate_many`.
        quantity : str, optional
            State or quantity whose largest size counts.

        Returns
        -------
        Ensemble
            Ensemble in the shape of the sweep.

        Raises
        ------
        ValueError
            For cases that were not run or gave no answer: without them the others are no sample.
        """
        check_finished("Ensemble.from_sweep", sweep)
        labels = outcome_labels(sweep)
        fell = labels == FALLS
        if lost := unanswered(labels):
            raise InputError("sweep", of="Ensemble.from_sweep").says(
                f"of {labels.size} cases {lost}: run them with other solver options, or select the "
                "cases with an answer and state how many were left out"
            )
        return cls(peaks_of(sweep, quantity).transpose(*labels.dims).values, fell.values)

    @property
    def number(self) -> int:
        """How many motions there are."""
        return self.peaks.size

    def distribution(self, x: ArrayLike) -> np.ndarray:
        """Part of all motions whose peak does not exceed a value.

        Parameters
        ----------
        x : array_like
            Rotations, or values of the demand, any shape.

        Returns
        -------
        ndarray
            Parts in the shape of x. Overturned motions exceed each x, so that the distribution ends
            below 1.
        """
        (at,) = numbers("Ensemble.distribution", x=x)
        return np.searchsorted(np.sort(self.peaks, axis=None), at, side="right") / self.number

    def band(
        self, x: ArrayLike, level: float = 0.95, seed: int = 0
    ) -> tuple[np.ndarray, np.ndarray]:
        """Confidence band of the distribution.

        Parameters
        ----------
        x : array_like
            Rotations, or values of the demand, any shape.
        level : float, optional
            Probability, at least, that the true distribution lies within the band everywhere.
        seed : int, optional
            Seed of the draws.

        Returns
        -------
        lower : ndarray
            Lower bound in the shape of x.
        upper : ndarray
            Upper bound in the shape of x.

        Raises
        ------
        ValueError
            For a level that does not lie between 0 and 1.

        Notes
        -----
        m campaigns, peaks (n, m), whose tests may share parameters, are resampled as a whole, 999
        times. The band reaches as far to both sides as the quantile of the largest deviation of the
        resampled distributions, times sqrt(m/(m - 1)) and the quantile of Student over that of the
        normal distribution. The true distribution is that of the same tests.

        The band of one campaign (n,) follows from the inequality of Dvoretzky, Kiefer and Wolfowitz
        (1956) with the constant of Massart (1990), Annals of Probability 18(3), 1269-1283:
        sqrt(ln(2/(1 - level))/(2 n)) to both sides. **It assumes independent tests**, of any
        distribution, with a part that overturns, too. One campaign does not show the scatter of a
        parameter that all its tests share: the band is that of this specimen.
        """
        require(0.0 < level < 1.0, "band", "level", level, "it lies between 0 and 1, as 0.95")
        if self.campaigns == 1:
            reach = np.sqrt(np.log(2.0 / (1.0 - level)) / (2.0 * self.number))
        else:
            reach = self._largest_deviation(level, seed)
        share = self.distribution(x)
        return np.maximum(share - reach, 0.0), np.minimum(share + reach, 1.0)

    @property
    def campaigns(self) -> int:
        """How many campaigns of the same tests there are."""
        return self.peaks.shape[-1] if self.peaks.ndim > 1 else 1

    def _largest_deviation(self, level: float, seed: int) -> float:
        """Half-width of the band of m campaigns, see `band`."""
        m, every = self.campaigns, np.sort(self.peaks, axis=None)
        x = every[np.linspace(0, len(every) - 1, min(len(every), _PLACES)).astype(int)]
        columns = np.sort(self.peaks.reshape(-1, m), axis=0).T
        each = np.array([np.searchsorted(one, x, side="right") for one in columns])
        drawn = np.random.default_rng(seed).multinomial(m, np.full(m, 1.0 / m), _DRAWS)
        deviations = np.abs((drawn - 1.0) @ each).max(axis=1) / self.number
        upper = 0.5 + 0.5 * level
        few = np.sqrt(m / (m - 1.0)) * stdtrit(m - 1, upper) / ndtri(upper)
        return float(few * np.quantile(deviations, level, method="higher"))

    def overturning_probability(self) -> np.ndarray:
        """Probability (k + 1/2)/(m + 1) of overturning of each test, where k of its m motions
        overturned.

        Returns
        -------
        ndarray
            Probabilities (n,).

        Notes
        -----
        The mean of the posterior of Jeffreys: a finite number of motions makes nothing certain.
        """
        return (self.overturned.sum(axis=-1) + 0.5) / (self.overturned.shape[-1] + 1.0)

    def censored(self, limit: float | None = None) -> np.ndarray:
        """Peaks, each up to a limit: min(peak, limit), the limit where the motion overturned.

        Parameters
        ----------
        limit : float, optional
            Largest rotation that is told apart from overturning, such as the slenderness of a
            block; may be left out where no motion overturned.

        Returns
        -------
        ndarray
            Peaks in the shape of the ensemble.

        Raises
        ------
        ValueError
            Where the limit is missing, or not positive.
        """
        if limit is not None:
            return np.minimum(self.peaks, positive("Ensemble.censored", limit=limit)[0])
        if self.overturned.any():
            raise InputError("limit").says(
                f"{self.overturned.sum()} of {self.number} motions overturned and have no peak: "
                "give limit=, the rotation at which they count, such as the slenderness of the "
                "block; none is left out"
            )
        return self.peaks

    def resolved(self, smallest: float) -> Ensemble:
        """Same motions, with peaks up to the smallest that a measurement can tell as zero.

        Parameters
        ----------
        smallest : float
            Resolution, in the unit of the peaks.

        Returns
        -------
        Ensemble
            The other ensemble.

        Notes
        -----
        Use it on both ensembles before places and ranks compare them: a simulated block at rest has
        no rotation, a measured one has noise.
        """
        (floor,) = positive("Ensemble.resolved", smallest=smallest)
        return Ensemble(np.where(self.peaks <= floor, 0.0, self.peaks), self.overturned)

    def __repr__(self) -> str:
        shape = " x ".join(map(str, self.peaks.shape))
        return f"Ensemble: {shape} motions, {int(self.overturned.sum())} overturned"
