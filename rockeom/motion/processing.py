"""Records made fit for use: baseline, filters, another time step, a part of the time."""

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from rockeom.motion.segments import C0, KIND, START, Motion, cut
from rockeom.numbers.checks import (
    InputError,
    described,
    finite_number,
    positive_number,
    require,
    whole_number,
)
from rockeom.numbers.functions import mathematics


class Processed(NamedTuple):
    """A changed motion: samples (m,) [m/s2] dt [s] apart, or analytic segments (n, 7).

    done : the change in words, for the end of the motion's `source`. padded : whether the record
    stays as long as it was.
    """

    done: str
    samples: np.ndarray | None = None
    dt: float | None = None
    segments: np.ndarray | None = None
    padded: bool = False


_INTEGRALS = {"acceleration": 0, "velocity": 1, "displacement": 2}
"""Number of integrations of the acceleration for each series that a baseline fits."""

_MOST_DEGREE = 10
_LARGEST_RATIO = 1000
_SLOWEST = 0.01  # of a period within the record
_RINGS = 1.5
"""Zeros before and after a filtered record: so many orders over the lower corner, as Boore (2005)
has it."""


def baseline_corrected(motion: Motion, degree: int, of: str) -> Processed:
    """See `GroundMotion.baseline_corrected`."""
    if not isinstance(of, str) or of not in _INTEGRALS:
        raise InputError("of", of).says(
            f"a baseline of {described(of)} is unknown: choose one of {', '.join(_INTEGRALS)}"
        )
    first = _INTEGRALS[of]
    n = whole_number("degree", degree, first)
    if n > _MOST_DEGREE:
        raise InputError("degree", n).give(f"at most {_MOST_DEGREE}; filtered(low=) takes out more")
    samples, dt = _samples(motion, "a baseline")
    require(len(samples) > n + 1, "", "degree", n, f"give less: there are {len(samples)} samples")
    t = dt * np.arange(len(samples))
    x = t / t[-1]
    powers = np.arange(first, n + 1)
    fitted = (samples, motion.velocity(t), motion.displacement(t))[first]
    coefficients = np.linalg.lstsq(x[:, None] ** powers, fitted, rcond=None)[0]
    falling = [math.perm(power, first) for power in powers]
    baseline = x[:, None] ** (powers - first) @ (coefficients * falling) / t[-1] ** first
    done = f"less its baseline, of degree {n} of the {of}"
    return Processed(done, samples - baseline, dt, padded=True)


def filtered(motion: Motion, low: float | None, high: float | None, order: int) -> Processed:
    """See `GroundMotion.filtered`."""
    samples, dt = _samples(motion, "a filter")
    n = whole_number("order", order, 1)
    if low is None and high is None:
        raise InputError("low").says("a filter has no corner: give low, high or both [Hz]")
    nyquist, slowest = 0.5 / dt, _SLOWEST / motion.duration
    given = {"low": low, "high": high}
    corners = {
        name: finite_number(name, value) for name, value in given.items() if value is not None
    }
    for name, corner in corners.items():
        if not slowest < corner < nyquist:
            raise InputError(name, corner).give(
                f"a corner below {nyquist:g} Hz, half of the rate of sampling, and above "
                f"{slowest:g} Hz, of which the record has nothing to tell"
            )
    if len(corners) == 2 and corners["low"] >= corners["high"]:
        raise InputError("low", corners["low"]).wrong(
            f"is {corners['low']:g} Hz and high {corners['high']:g} Hz: what lies between them is "
            "kept, give the smaller one as low"
        )
    from scipy.signal import butter, sosfiltfilt  # takes long to import

    kind = "bandpass" if len(corners) == 2 else "highpass" if "low" in corners else "lowpass"
    at = [*corners.values()] if len(corners) == 2 else min(corners.values())
    sos = butter(n, at, btype=kind, fs=1.0 / dt, output="sos")
    around = math.ceil(_RINGS * n / (min(corners.values()) * dt))
    passed = sosfiltfilt(sos, np.pad(samples, around), padtype=None)[around:-around]
    said = ", ".join(f"{name} corner {corner:g} Hz" for name, corner in corners.items())
    done = f"filtered, {said}, order {n} forward and backward"
    return Processed(done, passed, dt, padded=True)


def resampled(motion: Motion, dt: float, method: str) -> Processed:
    """See `GroundMotion.resampled`."""
    new = positive_number("dt", dt)
    if new > motion.duration:
        raise InputError("dt", new).give(f"less than the motion's {motion.duration:g} s")
    if method == "linear":
        return Processed(f"taken every {new:g} s", motion.sampled(new)[1], new)
    require(method == "band limited", "", "method", method, 'give "linear" or "band limited"')
    samples, old = _samples(motion, "a band-limited interpolation")
    ratio = Fraction(old / new).limit_denominator(_LARGEST_RATIO)
    if abs(ratio * new / old - 1) > 1e-9 or ratio.numerator > _LARGEST_RATIO:
        raise InputError("dt", new).wrong(
            f"is {new:g} s and that of the record {old:g} s, which are in no ratio of whole "
            f'numbers up to {_LARGEST_RATIO}: give another one, or method="linear"'
        )
    from scipy.signal import resample_poly  # takes long to import

    values = resample_poly(samples, ratio.numerator, ratio.denominator)
    kept = math.floor((len(samples) - 1) * old / new * (1.0 + 1e-12)) + 1
    done = f"band limited to a step of {new:g} s"
    return Processed(done, values[:kept], new)


def trimmed(motion: Motion, start: float, end: float) -> Processed:
    """See `GroundMotion.trimmed`."""
    first, last = finite_number("start", start), finite_number("end", end)
    if not 0.0 <= first < last <= motion.duration * (1.0 + 1e-12):
        raise InputError("start", first).wrong(
            f"is {first:g} s and end {last:g} s: give times between 0 and the motion's "
            f"{motion.duration:g} s, the smaller one first"
        )
    done = f"from {first:g} to {last:g} s"
    if motion.samples is not None:
        samples, dt = _samples(motion, "a part")
        kept = samples[round(first / dt) : round(last / dt) + 1]
        return Processed(done, kept, dt)
    try:
        segments = cut(motion.segments, first, last)
    except ValueError:
        raise InputError("start", first).wrong(
            f"is {first:g} s, within a Mavroeidis-Papageorgiou pulse, which has no end without its "
            "beginning: make a record of it first, by resampled(dt)"
        ) from None
    return Processed(done, segments=segments)


def rotated(motion: Motion, other: Motion, turn: float) -> tuple[np.ndarray, np.ndarray]:
    """Segments and samples of the component at an angle [rad]; see `GroundMotion.rotated`."""
    times = slice(START, KIND + 1)
    if (
        motion.samples is None
        or other.samples is None
        or not np.array_equal(motion.segments[:, times], other.segments[:, times])
    ):
        raise InputError("other", other).says(
            f"{motion!r} and {other!r} were not recorded at the same times: give two components of "
            "one record; if one is longer, cut its samples and use GroundMotion.from_array"
        )
    cosine, sine = mathematics.cos(turn), mathematics.sin(turn)
    segments = motion.segments.astype(np.result_type(motion.segments, type(turn)))
    segments[:, C0:] = cosine * motion.segments[:, C0:] + sine * other.segments[:, C0:]
    return segments, cosine * motion.samples + sine * other.samples


def _samples(motion: Motion, what: str) -> tuple[np.ndarray, float]:
    """The samples of a record, with zeros for the quiet time after it, and their step [s]."""
    if motion.samples is None or motion.dt is None:
        raise InputError("motion").says(
            f"{motion.name or 'the motion'} has no samples for {what}: resampled(dt) gives it some"
        )
    n = math.floor(motion.duration / motion.dt * (1.0 + 1e-12)) + 1
    return np.append(motion.samples, np.zeros(max(n - len(motion.samples), 0))), motion.dt
