"""The check of ground motions against the spectrum of a code, by the rule of Eurocode 8."""

from dataclasses import dataclass

import numpy as np

LEAST_NUMBER = 3
LEAST_RATIO = 0.9
BAND = 0.2, 2.0
"""Periods of the rule, over the fundamental one."""
DAMPING = 0.05


@dataclass(frozen=True, eq=False)
class SpectrumCheck:
    """Motions against a design spectrum by EN 1998-1:2004, 3.2.3.1.2(4). `print` shows the verdict.

    Parameters
    ----------
    number : int
        Number of the motions, at least 3 (a).
    zero_period : float
        Mean of their largest accelerations [m/s2].
    zero_period_target : float
        Spectrum at the period 0, a_g S, which the mean must reach (b) [m/s2].
    periods : ndarray
        Periods from 0.2 to 2 times the fundamental one (n,) [s].
    mean : ndarray
        Mean of their spectra for 5 % damping (n,) [m/s2]; none below 90 % of the design spectrum
        (c).
    target : ndarray
        Design spectrum (n,) [m/s2].
    """

    number: int
    zero_period: float
    zero_period_target: float
    periods: np.ndarray
    mean: np.ndarray
    target: np.ndarray

    @property
    def ratio(self) -> np.ndarray:
        """(n,) mean over target."""
        return self.mean / self.target

    @property
    def clauses(self) -> dict[str, bool]:
        """Whether each clause is met, by its letter."""
        return {
            "a": self.number >= LEAST_NUMBER,
            "b": self.zero_period >= self.zero_period_target,
            "c": bool(self.ratio.min() >= LEAST_RATIO),
        }

    @property
    def passed(self) -> bool:
        """Whether all clauses are met."""
        return all(self.clauses.values())

    def __str__(self) -> str:
        lowest = int(self.ratio.argmin())
        said = {
            "a": f"{self.number} motions, of {LEAST_NUMBER} or more",
            "b": f"mean of the largest accelerations {self.zero_period:.3g} m/s2, of "
            f"{self.zero_period_target:.3g} m/s2 or more",
            "c": f"mean spectrum at least {100 * self.ratio[lowest]:.0f} % of the target, at "
            f"{self.periods[lowest]:.3g} s, of {100 * LEAST_RATIO:.0f} % or more from "
            f"{self.periods[0]:.3g} to {self.periods[-1]:.3g} s",
        }
        verdict = "met" if self.passed else "not met"
        lines = [f"EN 1998-1, 3.2.3.1.2(4): {verdict}"]
        lines += [
            f"  ({letter}) {'yes' if met else 'no '}  {said[letter]}"
            for letter, met in self.clauses.items()
        ]
        return "\n".join(lines)
