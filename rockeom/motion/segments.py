"""A ground acceleration as a table of analytic segments, (n, 7) float64.

Columns: start [s], end [s], kind, c0, c1, c2, c3. Within a segment the acceleration is a smooth
function of the local time tau = t - start, so that an integrator which stops at the end of each
segment never steps over a kink or a jump. c0 is the amplitude of every kind but LINEAR; c3 is the
second rate of the one kind that has two.
"""

import math
from collections.abc import Callable, Iterator
from enum import IntEnum
from functools import partial
from typing import Any, Protocol

import numpy as np

from rockeom.numbers.checks import InputError

START, END, KIND, C0, C1, C2, C3 = range(7)
COLUMNS = 7

SHORT = 50
"""Rows of a table up to which a loop over the rows takes less time than arrays."""


class Motion(Protocol):
    """Attributes of a `GroundMotion` that measures, spectra, processing and plots read."""

    @property
    def segments(self) -> np.ndarray: ...

    @property
    def name(self) -> str: ...

    @property
    def source(self) -> str: ...

    @property
    def dt(self) -> float | None: ...

    @property
    def samples(self) -> np.ndarray | None: ...

    @property
    def duration(self) -> float: ...

    @property
    def peak(self) -> float: ...

    def velocity(self, t: np.ndarray) -> Any: ...

    def displacement(self, t: np.ndarray) -> Any: ...

    def sampled(self, dt: float) -> tuple[np.ndarray, np.ndarray]: ...


class SegmentKind(IntEnum):
    """Function that gives the acceleration within a segment."""

    LINEAR = 0  # c0 + c1 tau
    SINE = 1  # c0 sin(c1 tau + c2)
    RICKER = 2  # c0 (1 - 2 x^2) exp(-x^2), x = c1 (tau - c2)
    ANTISYMMETRIC_RICKER = 3  # c0 x (x^2 - 3) exp(-x^2 / 2), x = c1 (tau - c2)
    MAVROEIDIS_PAPAGEORGIOU = 4  # the rate of the velocity c0/c1 (1 - cos(c3 tau)) cos(y),
    # c0 [c3/c1 sin(c3 tau) cos(y) - (1 - cos(c3 tau)) sin(y)], y = c1 tau + c2, c3 < c1


# an enum is slow to look up
_KINDS = tuple(map(int, SegmentKind))
LINEAR, SINE, RICKER, ANTISYMMETRIC_RICKER, MAVROEIDIS_PAPAGEORGIOU = _KINDS

# Both wavelets are stationary where a quadratic in x^2 vanishes.
_RICKER_EXTREMA = (0.0, math.sqrt(1.5))
_ANTISYMMETRIC_EXTREMA = (math.sqrt(3.0 - math.sqrt(6.0)), math.sqrt(3.0 + math.sqrt(6.0)))

ANTISYMMETRIC_RICKER_PEAK = math.sqrt(6.0 * (3.0 - math.sqrt(6.0))) * math.exp(
    -0.5 * (3.0 - math.sqrt(6.0))
)
"""Largest value of |x (x^2 - 3) exp(-x^2 / 2)|, the beta = 1.38 of Vassiliou and Makris (2011)."""


def acceleration(rows: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Acceleration (m,) [m/s2] of the segments `rows` (m, 7) at their local times tau (m,) [s]."""
    return _by_kind(within, rows, tau)


def _by_kind(function: Callable[..., Any], rows: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Values (m,) of a function of (kind, c0, c1, c2, c3, tau) for rows (m, 7) at tau (m,)."""
    result = np.empty(len(tau))
    for kind in _KINDS:
        of_kind = rows[:, KIND] == kind
        if of_kind.any():
            result[of_kind] = function(kind, *rows[of_kind, C0:].T, tau[of_kind])
    return result


def of_row(function: Callable[..., Any], row: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Values of such a function for one segment, row (7,), at tau of any shape."""
    kind, c0, c1, c2, c3 = row[KIND:].tolist()
    return function(kind, c0, c1, c2, c3, tau)


def within(kind: float, c0: Any, c1: Any, c2: Any, c3: Any, tau: Any) -> Any:
    """Acceleration [m/s2] at the local time tau [s] of a segment; numbers or arrays."""
    if kind == LINEAR:
        return c0 + c1 * tau
    if kind == SINE:
        return c0 * np.sin(c1 * tau + c2)
    if kind == MAVROEIDIS_PAPAGEORGIOU:
        return sum(within(SINE, *sine, 0.0, tau) for sine in sines(c0, c1, c2, c3))
    x = c1 * (tau - c2)
    if kind == RICKER:
        return c0 * (1.0 - 2.0 * x**2) * np.exp(-(x**2))
    return c0 * x * (x**2 - 3.0) * np.exp(-0.5 * x**2)


def sines(c0: Any, c1: Any, c2: Any, c3: Any) -> Iterator[tuple[Any, Any, Any]]:
    """Amplitude, rate and phase of each of the three sines of a pulse with two rates."""
    ratio = c3 / c1
    yield -c0, c1, c2
    yield 0.5 * c0 * (1.0 + ratio), c1 + c3, c2
    yield 0.5 * c0 * (1.0 - ratio), c1 - c3, c2


def jerk(kind: float, c0: Any, c1: Any, c2: Any, c3: Any, tau: Any) -> Any:
    """Rate of the acceleration [m/s3] of a curved segment; as `within`."""
    if kind == SINE:
        return c0 * c1 * np.cos(c1 * tau + c2)
    if kind == MAVROEIDIS_PAPAGEORGIOU:
        return sum(jerk(SINE, *sine, 0.0, tau) for sine in sines(c0, c1, c2, c3))
    x = c1 * (tau - c2)
    if kind == RICKER:
        return c0 * c1 * x * (4.0 * x**2 - 6.0) * np.exp(-(x**2))
    return -c0 * c1 * (x**4 - 6.0 * x**2 + 3.0) * np.exp(-0.5 * x**2)


# -- velocity and displacement -------------------------------------------------------------------


def velocity(rows: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Velocity (m,) [m/s] that segments `rows` (m, 7) add from their start up to tau (m,) [s]."""
    return _by_kind(_velocity, rows, tau)


def displacement(rows: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """Displacement (m,) [m] that they add up to tau (m,) [s], from zero velocity at their start."""
    return _by_kind(_displacement, rows, tau)


def _velocity(kind: float, c0: Any, c1: Any, c2: Any, c3: Any, tau: Any) -> Any:
    if kind == LINEAR:
        return (c0 + 0.5 * c1 * tau) * tau
    if kind == SINE:  # the difference of two cosines
        half = 0.5 * c1 * tau
        return 2.0 * c0 / c1 * np.sin(half + c2) * np.sin(half)
    if kind == MAVROEIDIS_PAPAGEORGIOU:
        return c0 / c1 * (1.0 - np.cos(c3 * tau)) * np.cos(c1 * tau + c2)
    x0, x = -c1 * c2, c1 * (tau - c2)
    return c0 / c1 * (_once(kind, x) - _once(kind, x0))


def _displacement(kind: float, c0: Any, c1: Any, c2: Any, c3: Any, tau: Any) -> Any:
    if kind == LINEAR:
        return (0.5 * c0 + c1 * tau / 6.0) * tau**2
    if kind == SINE:
        return c0 / c1 * (tau * np.cos(c2) - (np.sin(c1 * tau + c2) - np.sin(c2)) / c1)
    if kind == MAVROEIDIS_PAPAGEORGIOU:  # at its start the speeds of its three sines cancel
        return -sum(
            a / rate**2 * (np.sin(rate * tau + angle) - np.sin(angle))
            for a, rate, angle in sines(c0, c1, c2, c3)
        )
    x0, x = -c1 * c2, c1 * (tau - c2)
    twice = (_twice(kind, x) - _twice(kind, x0)) / c1
    return c0 / c1 * (twice - _once(kind, x0) * tau)


def _once(kind: float, x: Any) -> Any:
    """The integral of the shape of a wavelet."""
    if kind == RICKER:
        return x * np.exp(-(x**2))
    return (1.0 - x**2) * np.exp(-0.5 * x**2)


def _twice(kind: float, x: Any) -> Any:
    """The second integral of the shape of a wavelet."""
    return -0.5 * np.exp(-(x**2)) if kind == RICKER else x * np.exp(-0.5 * x**2)


def at_starts(segments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Velocity [m/s] and displacement [m] at the start of each segment and after the last.

    (n + 1,) each, for ground at rest at time 0.
    """
    length = segments[:, END] - segments[:, START]
    v = np.append(0.0, np.cumsum(velocity(segments, length)))
    return v, np.append(0.0, np.cumsum(displacement(segments, length) + v[:-1] * length))


# -- where the acceleration turns ----------------------------------------------------------------


def bisected(
    function: Callable[[np.ndarray], np.ndarray], low: np.ndarray, high: np.ndarray
) -> np.ndarray:
    """The zero (m,) of a function between low (m,) and high (m,), to the last bit.

    function : of (m,), with opposite signs at both ends, or zero at one.
    """
    rises = function(high) > function(low)
    for _ in range(80):
        middle = 0.5 * (low + high)
        if np.array_equal(middle, low):
            break
        above = (function(middle) > 0.0) == rises
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return 0.5 * (low + high)


STEP = 0.5
"""Largest change of phase [rad] of the fastest sine of a curved segment between two samples."""


def turns(row: np.ndarray) -> np.ndarray:
    """Local times [s] that divide a curved segment (7,), its ends among them.

    Between two of them the acceleration neither changes sign nor turns, and its fastest sine runs
    through no more than STEP.
    """
    length, (kind, _, c1, _, c3) = row[END] - row[START], row[KIND:].tolist()
    rate = c1 + (c3 if kind == MAVROEIDIS_PAPAGEORGIOU else 0.0)
    grid = np.linspace(0.0, length, math.ceil(rate * length / STEP) + 1)
    for what in (jerk, within):  # between two turns the acceleration vanishes once at most
        of = partial(of_row, what, row)
        value = of(grid)
        at = np.flatnonzero(value[:-1] * value[1:] < 0.0)
        grid = np.unique(np.append(grid, bisected(of, grid[at], grid[at + 1])))
    return grid


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
    result = max(np.abs(acceleration(segments, tau)).max() for tau in candidates)
    for row in segments[kind == MAVROEIDIS_PAPAGEORGIOU]:
        result = max(result, np.abs(of_row(within, row, turns(row))).max())
    return float(result)


def shaking_ends(segments: np.ndarray) -> float:
    """Time after which the acceleration is identically zero [s]; 0.0 if it always is."""
    for row in segments[::-1]:  # one by one: few are quiet at the end
        _, end, kind, c0, c1, _, _ = row.tolist()
        if c0 != 0.0 or (kind == LINEAR and c1 != 0.0):
            return end
    return 0.0


def scaled(segments: np.ndarray, amplitude: Any, time: Any) -> np.ndarray:
    """The table with accelerations times `amplitude` and the time axis times `time`."""
    linear = segments[:, KIND] == LINEAR
    result = segments.astype(np.result_type(segments, type(amplitude), type(time)))
    for column, factor in ((START, time), (END, time), (C0, amplitude)):
        result[:, column] = segments[:, column] * factor
    rate = segments[:, C1] / time
    result[:, C1] = np.where(linear, rate * amplitude, rate)
    kind = segments[:, KIND]
    wavelet = (kind == RICKER) | (kind == ANTISYMMETRIC_RICKER)
    result[wavelet, C2] *= time  # the centre of a wavelet is a time, the c2 of a sine an angle
    result[kind == MAVROEIDIS_PAPAGEORGIOU, C3] /= time
    return result


def cut(segments: np.ndarray, start: float, end: float) -> np.ndarray:
    """The part of a table from `start` to `end` [s], its times counted from there.

    Raises ValueError where a Mavroeidis-Papageorgiou pulse would begin behind its start: a row
    cannot describe such a part.
    """
    within = segments[(segments[:, END] > start) & (segments[:, START] < end)]
    kept = begun_later(within, np.maximum(start - within[:, START], 0.0))
    kept[:, END] = np.minimum(kept[:, END], end) - start
    kept[:, START] = np.append(0.0, kept[:-1, END])
    return kept


def begun_later(segments: np.ndarray, late: np.ndarray) -> np.ndarray:
    """Rows (n, 7) with the constants of what is left of each some time (n,) [s] after its start.

    Raises ValueError as `cut` does.
    """
    rows, kind = segments.astype(np.result_type(segments, late)), segments[:, KIND]
    if (late[kind == MAVROEIDIS_PAPAGEORGIOU] > 0.0).any():
        raise ValueError("a Mavroeidis-Papageorgiou pulse has no end without its beginning")
    rows[:, C0] += np.where(kind == LINEAR, rows[:, C1] * late, 0.0)
    rows[:, C2] += np.where(kind == SINE, rows[:, C1] * late, 0.0)
    rows[:, C2] -= np.where((kind == RICKER) | (kind == ANTISYMMETRIC_RICKER), late, 0.0)
    return rows


# -- checks --------------------------------------------------------------------------------------


def check(segments: np.ndarray) -> None:
    """Check the shape of a table, its values, and the order and the constants of its rows.

    Raises InputError.
    """
    if segments.ndim != 2 or segments.shape[1] != COLUMNS or not len(segments):
        raise InputError("segments").wrong(
            f"have shape {segments.shape}: they must be (n, {COLUMNS}); GroundMotion.from_array "
            "takes accelerations, GroundMotion.read a file"
        )
    if segments.dtype == float and np.count_nonzero(np.isfinite(segments)) < segments.size:
        raise InputError("segments").wrong("hold NaN or infinity")
    if len(segments) > SHORT:
        _check_rows(np.all, np.append(0.0, segments[:-1, END]), *segments.T)
        return
    before = 0.0
    for row in segments.tolist():
        _check_rows(bool, before, *row)
        before = row[END]


def _check_rows(
    every: Callable[[Any], Any], before: Any, start: Any, end: Any, kind: Any, *constants: Any
) -> None:
    """Check one row of a table, or all rows at once; `before`: the end of the row before."""
    if not every((start == before) & (end > start)):
        raise InputError("segments").wrong("must follow each other without gap from time 0 on")
    linear = kind == LINEAR
    two_rates = kind == MAVROEIDIS_PAPAGEORGIOU
    curved = (kind == SINE) | (kind == RICKER) | (kind == ANTISYMMETRIC_RICKER) | two_rates
    if not every(linear | curved):
        raise InputError("segments").says(
            f"kinds of segments are {', '.join(str(int(k)) for k in SegmentKind)}"
        )
    if not every(linear | (constants[1] > 0.0)):
        raise InputError("segments").says("c1, the rate of a sine or a wavelet, must be positive")
    slower = (constants[3] > 0.0) & (constants[3] < constants[1])
    if not every((kind != MAVROEIDIS_PAPAGEORGIOU) | slower):
        raise InputError("segments").says("c3, the rate of an envelope, must lie between 0 and c1")
