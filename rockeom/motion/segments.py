"""A ground acceleration as a table of analytic segments, (n, 7) float64.

Columns: start [s], end [s], kind, c0, c1, c2, c3. Within a segment the acceleration is a smooth
function of the local time tau = t - start, so that an integrator which stops at every segment's
end never steps over a kink or a jump. c0 is the amplitude of every kind but LINEAR; c3 is spare.
"""

from __future__ import annotations

import math
from enum import IntEnum
from typing import Any

import numpy as np

START, END, KIND, C0, C1, C2 = range(6)
COLUMNS = 7


class SegmentKind(IntEnum):
    """How the acceleration runs within a segment."""

    LINEAR = 0  # c0 + c1 tau
    SINE = 1  # c0 sin(c1 tau + c2)
    RICKER = 2  # c0 (1 - 2 x^2) exp(-x^2), x = c1 (tau - c2)
    ANTISYMMETRIC_RICKER = 3  # c0 x (x^2 - 3) exp(-x^2 / 2), x = c1 (tau - c2)


LINEAR, SINE, RICKER, ANTISYMMETRIC_RICKER = map(int, SegmentKind)  # an enum is slow to look up

# Both wavelets are stationary where a quadratic in x^2 vanishes.
_RICKER_EXTREMA = (0.0, math.sqrt(1.5))
_ANTISYMMETRIC_EXTREMA = (math.sqrt(3.0 - math.sqrt(6.0)), math.sqrt(3.0 + math.sqrt(6.0)))

ANTISYMMETRIC_RICKER_PEAK = math.sqrt(6.0 * (3.0 - math.sqrt(6.0))) * math.exp(
    -0.5 * (3.0 - math.sqrt(6.0))
)
"""Largest value of |x (x^2 - 3) exp(-x^2 / 2)|, the beta = 1.38 of Vassiliou and Makris (2011)."""


def acceleration(rows: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Acceleration (m,) [m/s2] of the segments `rows` (m, 7) at their local times tau (m,) [s]."""
    found = np.empty(len(tau))
    for kind in SegmentKind:
        of_kind = rows[:, KIND] == kind
        if of_kind.any():
            c0, c1, c2 = rows[of_kind, C0 : C2 + 1].T
            found[of_kind] = within(kind, c0, c1, c2, tau[of_kind])
    return found


def within(kind: float, c0: Any, c1: Any, c2: Any, tau: Any) -> Any:
    """Acceleration [m/s2] at the local time tau [s] of a segment; numbers or arrays."""
    if kind == LINEAR:
        return c0 + c1 * tau
    if kind == SINE:
        return c0 * np.sin(c1 * tau + c2)
    x = c1 * (tau - c2)
    if kind == RICKER:
        return c0 * (1.0 - 2.0 * x**2) * np.exp(-(x**2))
    return c0 * x * (x**2 - 3.0) * np.exp(-0.5 * x**2)


def peak(segments: np.ndarray) -> float:
    """Largest absolute acceleration [m/s2]: at the ends and at the stationary points inside."""
    length = segments[:, END] - segments[:, START]
    candidates = [np.zeros_like(length), length]

    kind, c1, c2 = segments[:, KIND], segments[:, C1], segments[:, C2]
    rate = np.where(kind == LINEAR, 1.0, c1)  # that of linear segments is not used
    first_crest = np.pi * (np.ceil(c2 / np.pi - 0.5) + 0.5)
    stationary = [(SINE, (first_crest - c2) / rate)]
    stationary += [(RICKER, c2 + s * x / rate) for x in _RICKER_EXTREMA for s in (1, -1)]
    stationary += [
        (ANTISYMMETRIC_RICKER, c2 + s * x / rate) for x in _ANTISYMMETRIC_EXTREMA for s in (1, -1)
    ]
    for of_kind, tau in stationary:
        # A point beyond an end falls back on that end, which is a candidate anyway.
        candidates.append(np.where(kind == of_kind, np.clip(tau, 0.0, length), 0.0))
    return float(max(np.abs(acceleration(segments, tau)).max() for tau in candidates))


def shaking_ends(segments: np.ndarray) -> float:
    """Time after which the acceleration is identically zero [s]; 0.0 if it always is."""
    for row in segments[::-1]:  # one by one: few are quiet at the end
        _, end, kind, c0, c1, _, _ = row.tolist()
        if c0 != 0.0 or (kind == LINEAR and c1 != 0.0):
            return end
    return 0.0


def scaled(segments: np.ndarray, amplitude: float, time: float) -> np.ndarray:
    """The table with accelerations times `amplitude` and the time axis times `time`."""
    linear = segments[:, KIND] == LINEAR
    found = segments * np.array([time, time, 1.0, amplitude, 1.0, 1.0, 1.0])
    rate = segments[:, C1] / time
    found[:, C1] = np.where(linear, rate * amplitude, rate)
    wavelet = segments[:, KIND] >= RICKER
    found[wavelet, C2] *= time  # the centre of a wavelet is a time, the c2 of a sine an angle
    return found
