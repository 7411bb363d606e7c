"""Noise of a measured channel: how large it is, and what becomes of it in a sum or a filter."""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.arguments import not_negative, numbers, require

COVERED = 2.0
"""Half-widths of intervals in standard deviations: 95 % of a normal distribution, the coverage
factor of the Guide to the Expression of Uncertainty in Measurement (JCGM 100:2008)."""


@dataclass(frozen=True, eq=False)
class Noise:
    """Stationary noise of a channel, by its covariance.

    Parameters
    ----------
    covariance : ndarray
        Covariance (m,) of two samples that lie 0, 1, 2 ... samples apart [unit of the channel
        squared]; beyond the last there is none. White noise has one number, the variance.
    """

    covariance: np.ndarray

    @classmethod
    def white(cls, level: float) -> Noise:
        """Noise that differs from sample to sample.

        Parameters
        ----------
        level : float
            Standard deviation [unit of the channel].

        Returns
        -------
        Noise
            White noise.
        """
        (sigma,) = not_negative("Noise.white", level=level)
        return cls(np.atleast_1d(sigma**2))

    @property
    def level(self) -> float:
        """Standard deviation, in the unit of the channel."""
        return float(np.sqrt(self.covariance[0]))

    def through(self, kernel: ArrayLike) -> Noise:
        """Noise behind a filter.

        Parameters
        ----------
        kernel : array_like
            Response (k,) of the filter to one sample of 1.

        Returns
        -------
        Noise
            Noise of the filtered channel.
        """
        from scipy.signal import fftconvolve

        (k,) = numbers("Noise.through", kernel=kernel)
        own = np.concatenate([self.covariance[:0:-1], self.covariance])
        behind = fftconvolve(fftconvolve(k, k[::-1]), own)
        return Noise(behind[len(behind) // 2 :])

    def of_sum(self, weights: ArrayLike) -> float:
        """Standard deviation of a sum of neighbouring samples.

        Parameters
        ----------
        weights : array_like
            Weights of the samples (k,).

        Returns
        -------
        float
            Standard deviation of the sum.
        """
        (w,) = numbers("Noise.of_sum", weights=weights)
        lags = min(len(self.covariance), len(w))
        products = np.array([w[: len(w) - lag] @ w[lag:] for lag in range(lags)])
        twice = np.where(np.arange(lags) == 0, 1.0, 2.0)
        return float(np.sqrt(max(twice @ (products * self.covariance[:lags]), 0.0)))

    def every(self, step: int) -> Noise:
        """Noise of some of the samples.

        Parameters
        ----------
        step : int
            Every step-th sample remains.

        Returns
        -------
        Noise
            Noise of these.
        """
        return Noise(self.covariance[::step])


def noise_level(time: ArrayLike, values: ArrayLike, order: int = 6) -> float:
    """Standard deviation of the white noise of a channel, estimated from itself.

    Parameters
    ----------
    time : array_like
        Times (n,) [s], increasing.
    values : array_like
        Values (n,).
    order : int, optional
        Order of the divided differences that estimate the noise; they are zero for a polynomial of
        lower degree, and nearly so for a motion that is smooth over order + 1 samples.

    Returns
    -------
    float
        Standard deviation, in the unit of the values. Its own error is about 1.3/sqrt(n) of it.

    Raises
    ------
    ValueError
        For fewer than order + 2 samples and for times that do not increase.

    Notes
    -----
    The median of the sizes of the differences is insensitive to impacts and outliers. Noise that is
    not white, of a record that was filtered before, is underestimated: give its level yourself.
    """
    t, x = numbers("noise_level", time=time, values=values)
    if t.ndim != 1 or t.shape != x.shape or len(t) < order + 2:
        raise ValueError(
            f"noise_level: values has the shape {x.shape}, time has {t.shape}: give one value for "
            f"each of at least order + 2 = {order + 2} instants"
        )
    require(np.diff(t) > 0, "noise_level", "time", t[1:], "times must increase")
    steps = np.diff(t)
    if np.ptp(steps) < 1e-6 * steps[0]:
        left = np.diff(x, order) / np.sqrt(comb(2 * order, order))
    else:
        windows = np.lib.stride_tricks.sliding_window_view(t / np.median(steps), order + 1)
        apart = windows[:, :, None] - windows[:, None, :] + np.eye(order + 1)
        weights = 1 / np.prod(apart, axis=2)
        weights /= np.linalg.norm(weights, axis=1)[:, None]
        left = np.sum(weights * np.lib.stride_tricks.sliding_window_view(x, order + 1), axis=1)
    return float(np.median(np.abs(left)) / 0.6744897501960817)  # of a normal distribution
