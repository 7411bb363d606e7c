"""How strong a ground motion is: its peaks, energies and durations, exact within its segments.

Measures of the acceleration alone hold between the samples, too: a segment is divided where
its acceleration changes sign or turns, and integrals over the parts are by Gauss's rule with eight
places, which leaves rounding errors alone.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from rockeom.motion import segments as table
from rockeom.motion.segments import Motion
from rockeom.motion.spectra import response_spectrum
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, finite_number, positive_number, require
from rockeom.numbers.functions import gauss_rule

BRACKET = 0.05 * STANDARD_GRAVITY
"""Acceleration [m/s2] that a bracketed duration begins and ends with, where none is given."""

PREDOMINANT = np.geomspace(0.02, 10.0, 100)
"""Periods [s] of the oscillators among which `predominant_period` looks for the largest answer."""

_MEAN_BAND = 0.25, 20.0  # Hz, as Rathje et al. (1998) take it
_RESOLVED = 0.05  # Hz between two frequencies, at most
_ANALYTIC_STEP = 1 / 400  # s, of the samples of a motion that has none


@dataclass(frozen=True)
class Measures:
    """Intensity measures of a ground motion. `print` shows them with their units.

    Parameters
    ----------
    pga : float
        Largest absolute acceleration [m/s2].
    pgv : float
        Largest absolute velocity [m/s].
    pgd : float
        Largest absolute displacement [m].
    arias_intensity : float
        pi/(2 g) times the integral of the acceleration's square (Arias 1970) [m/s].
    cav : float
        Cumulative absolute velocity, the integral of the acceleration's size [m/s].
    significant_duration_5_75 : float
        Time in which Arias intensity grows from 5 to 75 percent (Trifunac and Brady 1975) [s].
    significant_duration_5_95 : float
        Time in which it grows from 5 to 95 percent [s].
    bracketed_duration : float
        Time between the first and the last that 0.05 g are reached [s].
    mean_period : float
        Mean period of the Fourier spectrum from 0.25 to 20 Hz, ``sum(C**2/f)/sum(C**2)`` with the
        amplitudes C at frequencies f (Rathje et al. 1998) [s].
    predominant_period : float
        Period at which the pseudo-acceleration of an oscillator with 5 % damping is largest, among
        100 periods from 0.02 to 10 s [s].
    """

    pga: float
    pgv: float
    pgd: float
    arias_intensity: float
    cav: float
    significant_duration_5_75: float
    significant_duration_5_95: float
    bracketed_duration: float
    mean_period: float
    predominant_period: float

    @property
    def units(self) -> dict[str, str]:
        """The unit of each measure by its name."""
        units = {"pga": "m/s2", "pgv": "m/s", "pgd": "m", "arias_intensity": "m/s", "cav": "m/s"}
        return {one.name: units.get(one.name, "s") for one in fields(self)}

    def __str__(self) -> str:
        return "\n".join(
            f"{name:<26}{getattr(self, name):>12.6g} {unit}" for name, unit in self.units.items()
        )


def measures(motion: Motion) -> Measures:
    """All intensity measures of a motion.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.

    Returns
    -------
    Measures
        Measures; NaN for those that a motion without shaking does not have.
    """
    parts = _Parts(motion)

    def duration(upper: float) -> float:
        if motion.peak == 0.0:
            return math.nan
        start, end = parts.significant_interval(0.05, upper)
        return end - start

    return Measures(
        pga=motion.peak,
        pgv=parts.peak_velocity,
        pgd=parts.peak_displacement,
        arias_intensity=parts.arias_intensity(STANDARD_GRAVITY),
        cav=parts.cumulative_absolute_velocity,
        significant_duration_5_75=duration(0.75),
        significant_duration_5_95=duration(0.95),
        bracketed_duration=parts.bracketed_duration(BRACKET),
        mean_period=mean_period(motion),
        predominant_period=predominant_period(motion),
    )


def peak_velocity(motion: Motion) -> float:
    """Largest absolute velocity of the ground, within the motion's duration.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.

    Returns
    -------
    float
        Velocity [m/s].
    """
    return _Parts(motion).peak_velocity


def peak_displacement(motion: Motion) -> float:
    """Largest absolute displacement of the ground, within the motion's duration.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.

    Returns
    -------
    float
        Displacement [m].
    """
    return _Parts(motion).peak_displacement


def arias_intensity(motion: Motion, gravity: float = STANDARD_GRAVITY) -> float:
    """Arias intensity.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.
    gravity : float, optional
        Value of 1 g [m/s2].

    Returns
    -------
    float
        Intensity [m/s].
    """
    return _Parts(motion).arias_intensity(positive_number("gravity", gravity))


def cumulative_absolute_velocity(motion: Motion) -> float:
    """Cumulative absolute velocity.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.

    Returns
    -------
    float
        Velocity [m/s].
    """
    return _Parts(motion).cumulative_absolute_velocity


def significant_interval(
    motion: Motion, lower: float = 0.05, upper: float = 0.95
) -> tuple[float, float]:
    """Times at which Arias intensity has reached two parts of its whole.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.
    lower : float, optional
        Part at the first time, such as 0.05.
    upper : float, optional
        Part at the second time, such as 0.75; between 0 and 1.

    Returns
    -------
    start : float
        First time [s].
    end : float
        Second time [s].

    Raises
    ------
    InputError
        For other parts and for a motion that does not shake.
    """
    parts = finite_number("lower", lower), finite_number("upper", upper)
    if not 0.0 <= parts[0] < parts[1] <= 1.0:
        raise InputError("lower", parts[0]).wrong(
            f"is {parts[0]:g} and upper {parts[1]:g}: give parts of the Arias intensity between 0 "
            "and 1, the smaller one first, such as 0.05 and 0.95"
        )
    require(motion.peak != 0.0, "", "motion", motion.name, "it does not shake, and has no duration")
    return _Parts(motion).significant_interval(*parts)


def significant_duration(motion: Motion, lower: float = 0.05, upper: float = 0.95) -> float:
    """Time between those of `significant_interval`.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.
    lower : float, optional
        Part of Arias intensity at the first time.
    upper : float, optional
        Part of Arias intensity at the second time.

    Returns
    -------
    float
        Time [s].
    """
    start, end = significant_interval(motion, lower, upper)
    return end - start


def bracketed_duration(motion: Motion, threshold: float = BRACKET) -> float:
    """Time from the first to the last that the acceleration reaches a threshold.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.
    threshold : float, optional
        Threshold [m/s2]; 0.05 g if not given.

    Returns
    -------
    float
        Time [s]; 0.0 if it never does.
    """
    return _Parts(motion).bracketed_duration(positive_number("threshold", threshold))


def mean_period(motion: Motion) -> float:
    """Mean period of the Fourier spectrum: ``sum(C**2/f)/sum(C**2)`` from 0.25 to 20 Hz.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.

    Returns
    -------
    float
        Period [s]; NaN for a motion that does not shake in that band.

    Notes
    -----
    C are the Fourier amplitudes of the samples, at frequencies f no more than 0.05 Hz apart, for
    which a record of less than 20 s is followed by zeros. A motion without samples is sampled 400
    times a second.

    References
    ----------
    Rathje, Abrahamson and Bray, Journal of Geotechnical and Geoenvironmental Engineering 124 (1998)
    150-159.
    """
    dt = motion.dt or _ANALYTIC_STEP
    samples = motion.sampled(dt)[1] if motion.samples is None else motion.samples
    n = max(len(samples), math.ceil(1.0 / (_RESOLVED * dt)))
    frequency = np.fft.rfftfreq(n, dt)
    band = (frequency >= _MEAN_BAND[0]) & (frequency <= _MEAN_BAND[1])
    power = np.abs(np.fft.rfft(samples, n)[band]) ** 2
    whole = float(power.sum())
    return float((power / frequency[band]).sum()) / whole if whole > 0.0 else math.nan


def predominant_period(motion: Motion) -> float:
    """Period at which the pseudo-acceleration of an oscillator with 5 % damping is largest.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.

    Returns
    -------
    float
        Period [s], among 100 from 0.02 to 10 s, each 6 % above the one before; NaN for no shaking.
    """
    if motion.peak == 0.0:
        return math.nan
    spectrum = response_spectrum(motion, PREDOMINANT, 0.05)
    return float(PREDOMINANT[np.argmax(spectrum.pseudo_acceleration)])


class _Parts:
    """A motion in parts within which its acceleration neither changes sign nor turns.

    rows (m, 7) : the segment of each part; low, high (m,) : local times of its ends [s].
    """

    def __init__(self, motion: Motion) -> None:
        segments = motion.segments
        self.starts = table.at_starts(segments)
        index, low, high = _linear(segments)
        for i in np.flatnonzero(segments[:, table.KIND] != table.LINEAR):
            times = table.turns(segments[i])
            index = np.append(index, np.full(len(times) - 1, i))
            low, high = np.append(low, times[:-1]), np.append(high, times[1:])
        order = np.argsort(segments[index, table.START] + low, kind="stable")
        self.index, self.low, self.high = index[order], low[order], high[order]
        self.rows = segments[self.index]

    def velocity(self, tau: np.ndarray, of: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Velocity [m/s] at local times of some parts."""
        return self.starts[0][self.index[of]] + table.velocity(self.rows[of], tau)

    def displacement(self, tau: np.ndarray, of: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Displacement [m] there."""
        v, d = (found[self.index[of]] for found in self.starts)
        return d + v * tau + table.displacement(self.rows[of], tau)

    def integral(
        self,
        function: Callable[[np.ndarray], np.ndarray],
        high: np.ndarray,
        of: np.ndarray | slice = slice(None),
    ) -> np.ndarray:
        """Integral of a function of the acceleration, from the start of parts to local times."""
        low = self.low[of]
        half = 0.5 * (high - low)
        nodes, weights = gauss_rule()
        tau = low + half * (1.0 + nodes[:, None])
        rows = np.tile(self.rows[of], (len(nodes), 1))
        values = function(table.acceleration(rows, tau.ravel())).reshape(tau.shape)
        return half * (weights @ values)

    @cached_property
    def peak_velocity(self) -> float:
        return float(np.abs([self.velocity(self.low), self.velocity(self.high)]).max())

    @cached_property
    def peak_displacement(self) -> float:
        """The peak at the end of a part, or where the ground stands still within it."""
        before, after = self.velocity(self.low), self.velocity(self.high)
        of = np.flatnonzero(before * after < 0.0)
        still = table.bisected(lambda tau: self.velocity(tau, of), self.low[of], self.high[of])
        found = (self.displacement(self.high), self.displacement(still, of))
        return float(max(np.abs(d).max(initial=0.0) for d in found))

    @cached_property
    def cumulative_absolute_velocity(self) -> float:
        return float(self.integral(np.abs, self.high).sum())

    @cached_property
    def squares(self) -> np.ndarray:
        """Integral of the acceleration's square up to the end of each part, (m,) [m2/s3]."""
        return np.cumsum(self.integral(np.square, self.high))

    def arias_intensity(self, gravity: float) -> float:
        return float(0.5 * math.pi / gravity * self.squares[-1])

    def significant_interval(self, lower: float, upper: float) -> tuple[float, float]:
        """Husid's curve inverted within the part in which it passes each of two heights."""
        wanted = np.array([lower, upper]) * self.squares[-1]
        of = np.minimum(np.searchsorted(self.squares, wanted), len(self.squares) - 1)
        missing = wanted - np.append(0.0, self.squares)[of]
        tau = table.bisected(
            lambda high: self.integral(np.square, high, of) - missing, self.low[of], self.high[of]
        )
        start, end = self.rows[of, table.START] + tau
        return float(start), float(end)

    def bracketed_duration(self, threshold: float) -> float:
        ends = np.abs([table.acceleration(self.rows, at) for at in (self.low, self.high)])
        above = np.flatnonzero(ends.max(axis=0) >= threshold)
        if not len(above):
            return 0.0
        first, last = above[0], above[-1]
        start = self._reached(first, threshold, ends[0, first])
        return self._reached(last, threshold, ends[1, last], from_end=True) - start

    def _reached(self, part: int, threshold: float, at_end: float, from_end: bool = False) -> float:
        """Time at which a part is at a threshold first, or last; at_end : what it has there."""
        of = np.array([part])
        tau = self.high[of] if from_end else self.low[of]
        if at_end < threshold:
            tau = table.bisected(
                lambda t: np.abs(table.acceleration(self.rows[of], t)) - threshold,
                self.low[of],
                self.high[of],
            )
        return (self.rows[of, table.START] + tau).item()


def _linear(segments: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(segment, start, end) of the parts of linear segments, which are divided where they cross 0.

    Start and end are local times [s].
    """
    index = np.flatnonzero(segments[:, table.KIND] == table.LINEAR)
    rows = segments[index]
    length, c0, c1 = rows[:, table.END] - rows[:, table.START], rows[:, table.C0], rows[:, table.C1]
    zero = np.divide(-c0, c1, out=np.zeros_like(c0), where=c1 != 0.0)
    inside = (zero > 0.0) & (zero < length)
    return (
        np.append(index, index[inside]),
        np.append(np.zeros_like(length), zero[inside]),
        np.append(np.where(inside, zero, length), length[inside]),
    )
