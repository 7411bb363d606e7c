"""Elastic response spectra of a ground motion, exact for accelerations linear between samples.

    import rockeom as rk
    from rockeom import analysis

    motion = rk.GroundMotion.from_library("El Centro 1940 180")
    spectrum = analysis.response_spectrum(motion, periods=[0.2, 0.5, 1.0, 2.0], damping_ratio=0.05)
    spectrum.displacement, spectrum.pseudo_acceleration  # m, m/s2

The oscillator is u'' + 2 xi omega u' + omega**2 u = -a_g, at rest at time zero. With the complex
lambda = -xi omega + i omega sqrt(1 - xi**2), z = u' - conj(lambda) u obeys z' = lambda z - a_g, one
equation of first order. It is solved exactly from sample to sample (Nigam and Jennings 1969).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import not_negative, positive, require
from rockeom.motion import GroundMotion

Spectrum = Callable[[float, float], float]
"""Period [s] and damping ratio to the largest displacement [m]."""

_PER_PERIOD = 16
"""Steps in a period, at least: no peak between two turns of the velocity is passed over then."""


@dataclass(frozen=True)
class ResponseSpectrum:
    """Largest displacements of elastic oscillators under a motion.

    periods (n,) [s]; damping_ratio : one for all; displacement (n,) relative to the ground [m].
    """

    periods: np.ndarray
    damping_ratio: float
    displacement: np.ndarray

    @property
    def pseudo_velocity(self) -> np.ndarray:
        """omega times the displacement [m/s]."""
        return 2 * np.pi / self.periods * self.displacement

    @property
    def pseudo_acceleration(self) -> np.ndarray:
        """omega**2 times the displacement [m/s2]: the spring's force for each unit of mass."""
        return (2 * np.pi / self.periods) ** 2 * self.displacement


class OscillatorHistory(NamedTuple):
    """Time [s], displacement [m] and velocity [m/s] relative to the ground, (n,) each."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray


def response_spectrum(
    motion: GroundMotion, periods: ArrayLike, damping_ratio: float = 0.05
) -> ResponseSpectrum:
    """The elastic response spectrum of a motion.

    motion : a record, which is linear between its samples; any other motion is taken at a
        hundredth of its shortest period, and linear in between. periods of the oscillators, (n,)
        or a number [s]. damping_ratio xi in [0, 1).

    The largest displacement is found within the steps, and after the end of the motion, when the
    oscillator is free, too.
    Raises ValueError for a period that is not positive and for a damping_ratio outside [0, 1).
    """
    (periods,) = positive("response_spectrum", periods=np.atleast_1d(periods))
    xi = _damping("response_spectrum", damping_ratio)
    acceleration, dt = _samples(motion, float(periods.min()))
    largest = [_Oscillator(float(t), xi, acceleration, dt).largest() for t in periods.ravel()]
    return ResponseSpectrum(periods, xi, np.reshape(largest, periods.shape))


def oscillator_history(
    motion: GroundMotion, period: float, damping_ratio: float = 0.05
) -> OscillatorHistory:
    """Response of an elastic oscillator at the samples of a motion, exact there.

    motion, damping_ratio : as in `response_spectrum`; period [s]. Samples are divided where they
    are further apart than a sixteenth of the period.
    Raises ValueError as `response_spectrum` does.
    """
    (t,) = positive("oscillator_history", period=period)
    xi = _damping("oscillator_history", damping_ratio)
    acceleration, dt = _samples(motion, float(t))
    one = _Oscillator(float(t), xi, acceleration, dt)
    return OscillatorHistory(one.dt * np.arange(len(one.u)), one.u, one.v)


def _damping(where: str, value: float) -> float:
    (xi,) = not_negative(where, damping_ratio=value)
    require(xi.ndim == 0, where, "damping_ratio", value, "give one number")
    require(xi < 1, where, "damping_ratio", xi, "from 1 on nothing vibrates: give less")
    return float(xi)


def _samples(motion: GroundMotion, period: float) -> tuple[np.ndarray, float]:
    """Accelerations [m/s2] and their time step [s]."""
    if motion.samples is not None and motion.dt is not None:
        return motion.samples, motion.dt
    dt = min(period, motion.duration) / 100
    return motion.sampled(dt)[1], dt


class _Oscillator:
    """One oscillator, at rest when the accelerations begin."""

    def __init__(self, period: float, xi: float, acceleration: np.ndarray, dt: float) -> None:
        from scipy.signal import lfilter  # takes long to import

        parts = math.ceil(dt * _PER_PERIOD / period * (1 - 1e-12))
        if parts > 1:
            at = np.arange(parts * (len(acceleration) - 1) + 1) / parts
            acceleration, dt = np.interp(at, np.arange(len(acceleration)), acceleration), dt / parts
        omega = 2 * math.pi / period
        self.dt, self.push = dt, -np.asarray(acceleration, dtype=float)
        self.rate = omega * complex(-xi, math.sqrt(1 - xi**2))
        growth, first, last = self._step(dt)
        gained = np.zeros(len(self.push), complex)
        gained[1:] = first * self.push[:-1] + last * self.push[1:]
        self.z = lfilter([1.0], [1.0, -growth], gained)
        self.u, self.v = self._real(self.z)

    def _step(self, time):
        """What a step multiplies z by, and what the push at its start and at its end adds."""
        w = np.asarray(self.rate * time)
        grown = np.expm1(w)
        near = np.abs(w) < 1e-2
        safe = np.where(near, 1.0, w)
        # (e**w - 1)/w and (e**w - 1 - w)/w**2, by their series where they cancel
        one = np.where(near, 1 + w / 2 * (1 + w / 3 * (1 + w / 4 * (1 + w / 5))), grown / safe)
        series = (1 + w / 3 * (1 + w / 4 * (1 + w / 5 * (1 + w / 6)))) / 2
        two = np.where(near, series, (grown / safe - 1) / safe)
        return 1 + grown, time * (one - two), time * two

    def _real(self, z):
        u = z.imag / self.rate.imag
        return u, z.real + self.rate.real * u

    def largest(self) -> float:
        turns = np.flatnonzero(self.v[:-1] * self.v[1:] < 0)
        sizes = [np.abs(self.u).max(), self._afterwards()]
        if len(turns):
            sizes.append(np.abs(self._between(turns)).max())
        return float(max(sizes))

    def _between(self, k: np.ndarray) -> np.ndarray:
        """Displacement where the velocity vanishes within the steps k, by Newton's method."""
        v0, v1 = self.v[k], self.v[k + 1]
        start, slope = self.push[k], (self.push[k + 1] - self.push[k]) / self.dt
        time = self.dt * v0 / (v0 - v1)
        u = self.u[k]
        for _ in range(3):
            growth, first, last = self._step(time)
            push = start + slope * time
            u, v = self._real(growth * self.z[k] + first * start + last * push)
            a = push + 2 * self.rate.real * v - abs(self.rate) ** 2 * u
            change = np.divide(v, a, out=np.zeros_like(v), where=a != 0)
            time = np.clip(time - change, 0.0, self.dt)
        return u

    def _afterwards(self) -> float:
        """The first peak of the free vibration after the motion."""
        z = self.z[-1]
        angle = (math.atan2(self.rate.imag, -self.rate.real) - np.angle(z)) % math.pi
        return abs((z * np.exp(self.rate * angle / self.rate.imag)).imag / self.rate.imag)
