"""A measured record: channels in SI units, their noise, and the signal chain of both.

    from rockeom import analysis

    record = analysis.MeasuredRecord.from_csv("test_5.csv", units={"theta": "deg"})
    record.noise["theta"].level                       # rad, estimated from the record itself
    smooth = record.low_pass(25.0).with_derivatives("theta", window=0.05)
    smooth["theta_ddot"], smooth.noise["theta_ddot"].level

The effect of a filter on white noise is known exactly: each step of the chain propagates the noise,
so that its result has a stated one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import lcm
from typing import Any, NamedTuple, Self

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
    """Velocity after resampling.

    Parameters
    ----------
    time : ndarray
        Common instants (n,) [s].
    velocity : dict of float to ndarray
        Velocities (n,) by the factor of the rate.
    noise : float
        Standard deviation that the noise of the record gives to the velocity at its own rate.
    spread : float
        Largest standard deviation of a difference to the velocity at its own rate.
    """

    time: np.ndarray
    velocity: dict[float, np.ndarray]
    noise: float
    spread: float


@explained.calls()
@dataclass(frozen=True, eq=False)
class MeasuredRecord:
    """Channels of a test, sampled at even steps, in SI units, and the noise of each.

    ``record["theta"]`` is a channel.

    Parameters
    ----------
    time : ndarray
        Times (n,) [s].
    channels : dict of str to ndarray
        Values (n,) by the name of the channel.
    noise : dict of str to float or Noise, optional
        Standard deviation by the name of the channel, or a `Noise`, as which it is stored;
        `noise_level` estimates that of other channels.
    name : str, optional
        Name of the record.

    Raises
    ------
    ValueError
        For times that are not even, channels of another length, gaps (NaN), and for noise of an
        unknown channel.

    Examples
    --------
    >>> import numpy as np
    >>> from rockeom import analysis
    >>> t = np.linspace(0.0, 1.0, 201)  # s
    >>> record = analysis.MeasuredRecord(t, {"theta": 0.1 * np.cos(5 * t)}, noise={"theta": 1e-4})
    >>> record["theta"].shape
    (201,)
    """

    time: np.ndarray
    channels: Mapping[str, np.ndarray]
    noise: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""

    def __post_init__(self) -> None:
        where = "MeasuredRecord"
        (t,) = numbers(where, time=self.time)
        require(t.ndim == 1 and len(t) >= 8, where, "time", t, "give at least 8 instants")
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
            raise InputError("noise", unknown, where).says(
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
    ) -> Self:
        """Columns of a text file (commas, semicolons, tabs or blanks) with a line of headings.

        Parameters
        ----------
        path : path_like
            File.
        units : dict of str to str, optional
            Unit by the name of a channel, such as ``{"theta": "deg", "tendon force": "kN"}``; not
            needed where the heading has it in brackets, as in "theta (deg)". The name of a channel
            is its heading without the brackets.
        channels : sequence of str, optional
            Channels to read; all but the time if not given.
        time_column : str or int, optional
            Name or number of the column of the time [s], evenly spaced.
        noise : dict of str to float, optional
            Standard deviation by the name of a channel, in SI units.
        gravity : float, optional
            Acceleration of gravity for accelerations in g [m/s2].

        Returns
        -------
        MeasuredRecord
            Record in SI units.

        Raises
        ------
        InputError
            A ValueError that names the file, the line, the column and the remedy.
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
    ) -> Self:
        """Record with one more channel.

        Parameters
        ----------
        name : str
            Name of the channel.
        values : array_like
            Values (n,) in SI units.
        noise : float or Noise, optional
            Standard deviation of the values, or a `Noise`.

        Returns
        -------
        MeasuredRecord
            The other record.
        """
        others = {n: one for n, one in self.noise.items() if n != name}
        return replace(
            self,
            channels={**self.channels, name: np.asarray(values)},
            noise=others if noise is None else {**others, name: noise},
        )

    def between(self, start: float, end: float) -> Self:
        """Part of the record between two instants.

        Parameters
        ----------
        start : float
            First instant [s].
        end : float
            Last instant [s].

        Returns
        -------
        MeasuredRecord
            The part.
        """
        kept = (self.time >= start) & (self.time <= end)
        return replace(
            self, time=self.time[kept], channels={n: x[kept] for n, x in self.channels.items()}
        )

    # -- the signal chain -------------------------------------------------------------------

    def low_pass(self, cutoff: float, order: int = 4) -> Self:
        """All channels through a Butterworth filter, forward and backward: no phase is shifted.

        Parameters
        ----------
        cutoff : float
            Cutoff frequency, at which the gain is a half [Hz].
        order : int, optional
            Order of one pass.

        Returns
        -------
        MeasuredRecord
            Filtered record, with the noise that the filter leaves.

        Raises
        ------
        ValueError
            For a cutoff at or above half of the rate of sampling.

        See Also
        --------
        low_pass_gain : Gain for a vibration.
        low_pass_on_peaks : Effect on peaks.

        Notes
        -----
        The thesis uses 25 Hz for records of 200 samples a second (section 4.5).
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
        """Gain of `low_pass` at a frequency.

        Parameters
        ----------
        frequency : array_like
            Frequency [Hz], any shape.
        cutoff : float
            Cutoff frequency, at which the gain is a half [Hz].
        order : int, optional
            Order of one pass.

        Returns
        -------
        ndarray
            Gain in the shape of the frequency; 1 without attenuation.
        """
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

    def with_derivatives(self, channel: str, window: float | None = None, degree: int = 4) -> Self:
        """Record with the rate and the second derivative of a channel, NAME_dot and NAME_ddot.

        Parameters
        ----------
        channel : str
            Channel of the record.
        window : float, optional
            Window of the polynomial [s]; 15 samples if not given.
        degree : int, optional
            Degree of the polynomial.

        Returns
        -------
        MeasuredRecord
            Record with the two further channels and their noise.

        Raises
        ------
        ValueError
            For a window of fewer than degree + 2 samples.

        Notes
        -----
        Each derivative is that of the polynomial that fits the samples within the window about the
        instant best (Savitzky and Golay). Within half a window of an impact the fit goes across the
        bend: the jump of the rate is spread over the window, and the acceleration is a lower bound.
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

    def resampled(self, factor: float) -> Self:
        """Record at another rate of sampling.

        Parameters
        ----------
        factor : float
            Factor of the rate: a whole number, or one over a whole number.

        Returns
        -------
        MeasuredRecord
            The other record.

        Raises
        ------
        ValueError
            For another factor.

        Notes
        -----
        Up, a cubic spline lies through the samples; down, every so many-th sample remains, as it
        was measured. The noise between samples is that of a spline, somewhat less than stated.
        """
        from scipy.interpolate import CubicSpline

        where = "MeasuredRecord.resampled"
        (f,) = positive(where, factor=factor)
        times = round(float(max(f, 1 / f)))
        rule = "give a whole number, or one over a whole number"
        require(abs(max(f, 1 / f) - times) < 1e-9, where, "factor", f, rule)
        if f < 1:
            t = self.time[::times]
            channels = {n: x[::times] for n, x in self.channels.items()}
            noise = {n: one.every(times) for n, one in self.noise.items()}
        else:
            t = self.time[0] + self.step / times * np.arange((len(self.time) - 1) * times + 1)
            channels = {n: CubicSpline(self.time, x)(t) for n, x in self.channels.items()}
            noise = {n: _between(one, times) for n, one in self.noise.items()}
        return replace(self, time=t, channels=channels, noise=noise)

    def velocities_by_resampling(
        self, channel: str, window: float, factors: Sequence[float] = (0.5, 2.0), degree: int = 4
    ) -> Velocities:
        """Rate of a channel by `with_derivatives`, at other rates of sampling too.

        Parameters
        ----------
        channel : str
            Channel of the record.
        window : float
            Window of the derivatives [s], as in `with_derivatives`.
        factors : sequence of float, optional
            Factors of the rate of sampling, as in `resampled`.
        degree : int, optional
            Degree of the polynomial.

        Returns
        -------
        Velocities
            Velocities at their common instants, and their spread.

        Raises
        ------
        ValueError
            As `with_derivatives` and `resampled`.

        Notes
        -----
        The method of thesis section 3.2.2, which excludes errors of the differentiation. Where the
        spread is of the size of the noise, the features of the velocity are those of the record.
        """
        made = {1.0: self} | {f: self.resampled(f) for f in factors}
        rates = {f: one.with_derivatives(channel, window, degree) for f, one in made.items()}
        shared = lcm(*(round(1 / f) for f in factors if f < 1))
        name = f"{channel}_dot"
        resampled = {f: one[name][:: round(shared * f)] for f, one in rates.items()}
        shortest = min(len(v) for v in resampled.values())
        resampled = {f: v[:shortest] for f, v in resampled.items()}
        spread = max(float(np.std(v - resampled[1.0])) for v in resampled.values())
        noise = rates[1.0].noise[name].level
        return Velocities(self.time[::shared][:shortest], resampled, noise, spread)

    # -- its free vibration ----------------------------------------------------------------------

    def free_vibration(
        self, channel: str, smallest: float | None = None, **other: str
    ) -> FreeVibration:
        """Peaks and crossings of a channel that counts from upright.

        Parameters
        ----------
        channel : str
            Channel of the record.
        smallest : float, optional
            Displacement at which the record has swung to the other side, as in
            `FreeVibration.from_samples`; if not given, five standard deviations of the noise of the
            channel, or the resolution of the sampling, if that is more.
        **other : str
            Further arguments of `FreeVibration.from_samples`, by the name of the channel, such as
            ``tendon_force="tendon"``.

        Returns
        -------
        FreeVibration
            Peaks and crossings in turn.

        Raises
        ------
        ValueError
            As `FreeVibration.from_samples`.
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
