"""A measured record: channels in SI units, their noise, and the signal chain of both.

    from rockeom import analysis

    record = analysis.MeasuredRecord.from_csv("test_5.csv", units={"theta": "deg"})
    record.noise["theta"].level                       # rad, estimated from the record itself
    smooth = record.low_pass(25.0).with_derivatives("theta", window=0.05)
    smooth["theta_ddot"], smooth.noise["theta_ddot"].level

The effect of a filter on white noise is known exactly: each step of the chain propagates the noise,
so that its result has a stated one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import lcm
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.identification.free_vibration import FreeVibration, resolved_floor
from rockeom.analysis.identification.noise import Noise, noise_level
from rockeom.motion.readers import read_channels
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers import explained
from rockeom.numbers.checks import FilePath, InputError, not_negative, numbers, positive, require

# --- a record


class Velocities(NamedTuple):
    """A velocity after resampling: factor -> (n,) at `time` (n,); their spread.

    noise : standard deviation that the noise of the record gives to the velocity at its own rate.
    spread : largest standard deviation of a difference to that at its own rate.
    """

    time: np.ndarray
    velocity: dict[float, np.ndarray]
    noise: float
    spread: float


@explained.calls()
@dataclass(frozen=True, eq=False)
class MeasuredRecord:
    """Channels of a test, sampled at even steps, in SI units, and the noise of each.

    time : (n,) [s]. channels : name -> (n,). noise : name -> standard deviation, or a `Noise`, as
    which it is stored; `noise_level` estimates that of other channels.
    name : of the record. `record["theta"]` is a channel.

    Raises ValueError for times that are not even, channels of another length, gaps (NaN), and for
    noise of an unknown channel.
    """

    time: np.ndarray
    channels: Mapping[str, np.ndarray]
    noise: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""

    def __post_init__(self) -> None:
        where = "MeasuredRecord"
        (t,) = numbers(where, time=self.time)
        if t.ndim != 1 or len(t) < 8:
            raise InputError("time", of=where).wrong(
                f"has the shape {t.shape}: give at least 8 instants"
            )
        require(np.diff(t) > 0, where, "time", t[1:], "times must increase")
        mean = (t[-1] - t[0]) / (len(t) - 1)
        even = np.abs(t - t[0] - mean * np.arange(len(t))) < 0.1 * mean
        require(even, where, "time", t, "the steps are not even: resample to an even step")
        channels = {}
        for name, values in self.channels.items():
            (x,) = numbers(where, **{name: values})
            if x.shape != t.shape:
                raise InputError(name, of=where).wrong(
                    f"has the shape {x.shape}, time has {t.shape}: give one value for each instant"
                )
            channels[name] = x
        unknown = [n for n in self.noise if n not in channels]
        if unknown:
            raise InputError("noise", unknown, where).told(
                f"noise of {unknown}, which are no channels of {[*channels]}"
            )
        noise = {n: self._own_noise(t, n, x) for n, x in channels.items()}
        object.__setattr__(self, "time", t)
        object.__setattr__(self, "channels", channels)
        object.__setattr__(self, "noise", noise)

    def _own_noise(self, t: np.ndarray, name: str, x: np.ndarray) -> Noise:
        stated = self.noise.get(name)
        if isinstance(stated, Noise):
            return stated
        return Noise.white(noise_level(t, x) if stated is None else stated)

    @classmethod
    def from_csv(
        cls,
        path: FilePath,
        units: Mapping[str, str] | None = None,
        *,
        channels: Sequence[str] | None = None,
        time_column: str | int = "time",
        noise: Mapping[str, float] | None = None,
        gravity: float = STANDARD_GRAVITY,
    ) -> MeasuredRecord:
        """Columns of a text file (commas, semicolons, tabs or blanks) with a line of headings.

        units : name of a channel -> its unit, such as {"theta": "deg", "tendon force": "kN"}; not
        needed where the heading has it in brackets, as in "theta (deg)". The name of a channel is
        its heading without the brackets. channels : which to read; all but the time if not given.
        time_column : name or number of that of the time [s], evenly spaced. noise : as for the
        class, in SI units. gravity : of accelerations in g [m/s2].

        Raises `InputError`, a ValueError, which names the file, the line, the column and the
        remedy.
        """
        read = read_channels(path, units or {}, channels, time_column, gravity)
        length = len(next(iter(read.values.values()), ()))
        time = read.start + read.dt * np.arange(length)
        return cls(time, read.values, dict(noise or {}), read.name)

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.channels:
            raise KeyError(f"no channel {name!r}; there are {', '.join(self.channels)}")
        return self.channels[name]

    @property
    def step(self) -> float:
        """Time between two samples [s]."""
        return float(self.time[-1] - self.time[0]) / (len(self.time) - 1)

    def with_channel(
        self, name: str, values: ArrayLike, noise: float | Noise | None = None
    ) -> MeasuredRecord:
        """The record with one more channel, (n,), in SI units; noise as for the class."""
        others = {n: one for n, one in self.noise.items() if n != name}
        return replace(
            self,
            channels={**self.channels, name: np.asarray(values)},
            noise=others if noise is None else {**others, name: noise},
        )

    def between(self, start: float, end: float) -> MeasuredRecord:
        """The part of the record from `start` to `end` [s]."""
        kept = (self.time >= start) & (self.time <= end)
        return replace(
            self, time=self.time[kept], channels={n: x[kept] for n, x in self.channels.items()}
        )

    # -- the signal chain -------------------------------------------------------------------

    def low_pass(self, cutoff: float, order: int = 4) -> MeasuredRecord:
        """All channels through a Butterworth filter, forward and backward: no phase is shifted.

        cutoff [Hz], at which the gain is a half; order of one pass. `low_pass_gain` is the gain for
        a vibration, `low_pass_on_peaks` the effect on peaks. The thesis uses 25 Hz for records of
        200 samples a second (section 4.5).
        Raises ValueError for a cutoff at or above half of the rate of sampling.
        """
        from scipy.signal import sosfiltfilt

        sos = self._butterworth("MeasuredRecord.low_pass", cutoff, order)
        reach = int(np.ceil(4 * order / (cutoff * self.step)))
        unit = np.zeros(2 * reach + 1)
        unit[reach] = 1.0
        kernel = sosfiltfilt(sos, unit, padlen=0)
        pad = min(3 * reach, len(self.time) - 1)
        return replace(
            self,
            channels={n: sosfiltfilt(sos, x, padlen=pad) for n, x in self.channels.items()},
            noise={n: one.through(kernel) for n, one in self.noise.items()},
        )

    def low_pass_gain(self, frequency: ArrayLike, cutoff: float, order: int = 4) -> np.ndarray:
        """Gain of `low_pass` at a frequency [Hz], any shape; 1 without attenuation."""
        from scipy.signal import sosfreqz

        (f,) = not_negative("MeasuredRecord.low_pass_gain", frequency=frequency)
        sos = self._butterworth("MeasuredRecord.low_pass_gain", cutoff, order)
        _, response = sosfreqz(sos, np.ravel(f), fs=1 / self.step)
        return np.reshape(np.abs(response) ** 2, f.shape)

    def _butterworth(self, where: str, cutoff: float, order: int) -> np.ndarray:
        from scipy.signal import butter

        (f,) = positive(where, cutoff=cutoff)
        rule = f"it must lie below half of the rate of sampling, {0.5 / self.step:g} Hz"
        require(f < 0.5 / self.step, where, "cutoff", f, rule)
        return butter(order, f, output="sos", fs=1 / self.step)

    def with_derivatives(
        self, channel: str, window: float | None = None, degree: int = 4
    ) -> MeasuredRecord:
        """The record with the rate and the second derivative of a channel, NAME_dot and NAME_ddot.

        Each is that of the polynomial of `degree` that fits the samples within `window` [s] about
        the instant best (Savitzky and Golay); 15 samples if not given. Their noise is stated as
        that of the record is. Within half a window of an impact the fit goes across the bend: the
        jump of the rate is spread over the window, and the acceleration is a lower bound.
        Raises ValueError for a window of fewer than degree + 2 samples.
        """
        from scipy.signal import savgol_filter

        where = "MeasuredRecord.with_derivatives"
        (w,) = positive(where, window=14 * self.step if window is None else window)
        half = round(float(w) / self.step / 2)
        rule = f"it holds too few samples for degree {degree}: widen it or lower the degree"
        require(degree + 2 <= 2 * half + 1 <= len(self.time), where, "window", w, rule)
        channels, noise = dict(self.channels), dict(self.noise)
        for order, name in ((1, f"{channel}_dot"), (2, f"{channel}_ddot")):
            channels[name] = savgol_filter(
                self[channel], 2 * half + 1, degree, deriv=order, delta=self.step
            )
            noise[name] = self.noise[channel].through(_kernel(half, degree, order, self.step))
        return replace(self, channels=channels, noise=noise)

    def resampled(self, factor: float) -> MeasuredRecord:
        """The record at `factor` times its rate: a whole number, or one over a whole number.

        Up, a cubic spline lies through the samples; down, every so many-th sample is kept, as it
        was measured. The noise between samples is that of a spline, somewhat less than stated.
        """
        from scipy.interpolate import CubicSpline

        where = "MeasuredRecord.resampled"
        (f,) = positive(where, factor=factor)
        times = round(float(max(f, 1 / f)))
        rule = "give a whole number, or one over a whole number"
        require(abs(max(f, 1 / f) - times) < 1e-9, where, "factor", f, rule)
        if f < 1:
            return replace(
                self,
                time=self.time[::times],
                channels={n: x[::times] for n, x in self.channels.items()},
                noise={n: one.every(times) for n, one in self.noise.items()},
            )
        t = self.time[0] + self.step / times * np.arange((len(self.time) - 1) * times + 1)
        return replace(
            self,
            time=t,
            channels={n: CubicSpline(self.time, x)(t) for n, x in self.channels.items()},
            noise={n: _between(one, times) for n, one in self.noise.items()},
        )

    def velocities_by_resampling(
        self, channel: str, window: float, factors: Sequence[float] = (0.5, 2.0), degree: int = 4
    ) -> Velocities:
        """The rate of a channel by `with_derivatives`, at other rates of sampling too.

        The method of thesis section 3.2.2, which excludes errors of the differentiation. window [s]
        and degree as in `with_derivatives`; factors as in `resampled`. All are given at their
        common instants. Where their spread is of the size of the noise, the features of the
        velocity are those of the record.
        """
        made = {1.0: self} | {f: self.resampled(f) for f in factors}
        rates = {f: one.with_derivatives(channel, window, degree) for f, one in made.items()}
        shared = lcm(*(round(1 / f) for f in factors if f < 1))
        name = f"{channel}_dot"
        found = {f: one[name][:: round(shared * f)] for f, one in rates.items()}
        shortest = min(len(v) for v in found.values())
        found = {f: v[:shortest] for f, v in found.items()}
        spread = max(float(np.std(v - found[1.0])) for v in found.values())
        noise = rates[1.0].noise[name].level
        return Velocities(self.time[::shared][:shortest], found, noise, spread)

    # -- its free vibration ----------------------------------------------------------------------

    def free_vibration(
        self, channel: str, smallest: float | None = None, **other: str
    ) -> FreeVibration:
        """Peaks and crossings of a channel that counts from upright.

        smallest : as in `FreeVibration.from_samples`; five standard deviations of the noise of the
        channel and the resolution of the sampling if not given. other : further arguments of
        `from_samples`, by the name of the channel, such as tendon_force="tendon".
        """
        floor = smallest
        if floor is None:
            floor = resolved_floor(self.time, self[channel], self.noise[channel].level)
        beside: dict[str, Any] = {name: self[column] for name, column in other.items()}
        return FreeVibration.from_samples(self.time, self[channel], **beside, smallest=floor)


def _kernel(half: int, degree: int, order: int, step: float) -> np.ndarray:
    """Weights of the samples in the derivative of the polynomial that fits them."""
    from scipy.signal import savgol_coeffs

    return savgol_coeffs(2 * half + 1, degree, deriv=order, delta=step, use="dot")


def _between(noise: Noise, times: int) -> Noise:
    lags = np.arange(len(noise.covariance) * times) / times
    own = np.append(noise.covariance, 0.0)
    return Noise(np.interp(lags, np.arange(len(own)), own))
