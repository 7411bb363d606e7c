"""`GroundMotion`: the acceleration of the ground in one direction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion import segments as pieces
from rockeom.motion.components import name_of
from rockeom.motion.formula import call_of, with_formulas
from rockeom.motion.record import Origin, Record
from rockeom.motion.scaling import Acceleration, multiplier, named, scaled_name, target
from rockeom.motion.units import STANDARD_GRAVITY, factor
from rockeom.numbers import explained
from rockeom.numbers.batch import one_of
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import (
    FilePath,
    InputError,
    array_of,
    finite_number,
    number,
    positive_number,
    require,
)
from rockeom.numbers.dual import nominal, value_of
from rockeom.numbers.pictures import picture

if TYPE_CHECKING:
    from rockeom.motion import intensity, processing
    from rockeom.motion.spectra import ResponseSpectrum

QUIET_PERIODS = 10
"""Quiet time after a pulse without a duration [periods]: the free motion after it often
decides whether a structure overturns."""

_RICKER_HALF_WINDOW = 2  # periods; beyond, the wavelet is below 1e-8 of its peak
_ABSURD_PEAK = 10 * STANDARD_GRAVITY  # the strongest recorded one is about 4 g

MEANT = {
    "load": "read(path)",
    "open": "read(path)",
    "from_file": "read(path)",
    "from_txt": "from_columns(path)",
    "from_peer": "from_at2(path)",
    "from_list": "from_array(values, dt)",
    "from_numpy": "from_array(values, dt)",
    "sine": "single_sine",
    "cosine": "single_cosine",
    "sinusoidal": "harmonic",
    "pulse": "single_sine",
    "noise": "kanai_tajimi",
    "pga": "peak",
    "pgv": "peak_velocity",
    "pgd": "peak_displacement",
    "t": "sampled(dt)",
    "time": "sampled(dt)",
    "times": "sampled(dt)",
    "a": "acceleration(t)",
    "values": "samples",
    "scale": "scaled_to(pga=...)",
    "spectrum": "response_spectrum(periods)",
    "filter": "filtered(low, high)",
}
"""Names that people ask a ground motion or its class for, and what to write for each."""


@explained.attributes(**MEANT)
@explained.calls(frequency="period = 1/frequency", scale="units=, or multiply the motion")
@with_formulas
@dataclass(frozen=True, eq=False, repr=False)
class GroundMotion(metaclass=explained.Constructors):
    """Acceleration of the ground in one direction, as a table of analytic segments.

    The class methods make motions: `none`, `constant`, `half_sine`, `single_sine`, `single_cosine`,
    `harmonic`, `ricker`, `mavroeidis_papageorgiou`, `kanai_tajimi`, `clough_penzien`, `from_array`,
    `from_at2`, `from_columns`, `from_csv`, `read`, `from_library`. The acceleration of a formula is
    a number [m/s2], or a text with its unit, such as "0.3 g".

    Parameters
    ----------
    segments : ndarray
        Table (n, 7) of start [s], end [s], kind, c0, c1, c2, c3 (see `SegmentKind`); contiguous
        from time 0. Before and after them the acceleration is zero. Read-only.
    name : str, optional
        Label of the motion in figures.
    source : str, optional
        Origin of the motion.
    dt : float, optional
        Time step of a record [s], which is linear between its samples; None for an analytic motion.
    samples : ndarray, optional
        Accelerations of a record (m,) [m/s2]; None for an analytic motion.
    is_vertical : bool, optional
        Whether it is the vertical component of a recording, as its file says; another verdict is
        ``dataclasses.replace(motion, is_vertical=...)``.
    origin : Origin, optional
        Station, event, component and azimuth [degrees] of a record from the file of a network.

    Raises
    ------
    InputError
        For a table of another form.

    Notes
    -----
    Two motions are equal if their names, sources and tables are.

    Examples
    --------
    >>> import rockeom as rk
    >>> pulse = rk.GroundMotion.single_sine(amplitude="0.3 g", period=0.5, duration=5.0)  # s
    >>> round(pulse.peak, 3), pulse.duration  # m/s2, s
    (2.943, 5.0)
    >>> round(float(pulse.velocity(0.25)), 4)  # m/s
    0.4684
    """

    segments: np.ndarray
    name: str = ""
    source: str = ""
    dt: float | None = None
    samples: np.ndarray | None = None
    is_vertical: bool = False
    origin: Origin | None = None

    def __post_init__(self) -> None:
        # Adding zero copies, and makes -0.0 plain 0.0: equal tables have equal bytes.
        for field in ("segments", "samples"):
            if (values := getattr(self, field)) is not None:
                values = array_of(field, values) + 0.0
                values.setflags(write=False)
                object.__setattr__(self, field, values)
        pieces.check(self.segments)
        for field in ("name", "source"):
            if not isinstance(getattr(self, field), str):
                raise InputError(field, getattr(self, field)).give("a text")
        if (self.dt is None) != (self.samples is None):
            raise InputError("dt").says("dt and samples belong together: give both or neither")

    # -- made from a formula

    @classmethod
    def none(cls, duration: float) -> GroundMotion:
        """No shaking, for free rocking.

        Parameters
        ----------
        duration : float
            Duration [s].

        Returns
        -------
        GroundMotion
            Motion without acceleration.

        Raises
        ------
        InputError
            For a duration that is not positive.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> run = rk.simulate(block, rk.GroundMotion.none(10.0), initial={"theta": 0.1})  # s, rad
        >>> print(run.outcome)
        came to rest
        """
        return _analytic("no shaking", [(positive_number("duration", duration), pieces.LINEAR)])

    @classmethod
    def constant(
        cls, acceleration: Acceleration, duration: float, total_duration: float | None = None
    ) -> GroundMotion:
        """Constant acceleration: a rectangular pulse if quiet follows.

        Parameters
        ----------
        acceleration : float or str
            Acceleration, a number [m/s2] or a text with its unit.
        duration : float
            Duration of the acceleration [s].
        total_duration : float, optional
            Duration with the quiet time after it [s]; `duration` if not given.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For a duration that is not positive.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> push = rk.GroundMotion.constant(1.0, duration=5.0)  # m/s2, s; lifts no foot
        >>> float(rk.simulate(block, push)["theta"].max())
        0.0
        """
        a, end = finite_number("acceleration", acceleration), positive_number("duration", duration)
        total = end if total_duration is None else total_duration
        name = named("constant, {:.4g} m/s2, {:.4g} s", a, end)
        return _analytic(name, [(end, pieces.LINEAR, a)]).padded_to(total)

    @classmethod
    def half_sine(
        cls, amplitude: Acceleration, period: float, duration: float | None = None
    ) -> GroundMotion:
        """Half of a sine: amplitude sin(2 pi t/period) up to period/2.

        Parameters
        ----------
        amplitude : float or str
            Amplitude, a number [m/s2] or a text with its unit.
        period : float
            Period of the full sine [s].
        duration : float, optional
            Duration with the quiet time after the pulse [s], at least the pulse; if not given, ten
            periods of quiet follow.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For a period that is not positive, and a duration shorter than the pulse.

        Examples
        --------
        >>> import rockeom as rk
        >>> push = rk.GroundMotion.half_sine(amplitude=3.0, period=1.0)  # m/s2, s
        >>> push.duration  # s
        10.5
        """
        return _pulse("half sine", amplitude, period, 0.5, 0.0, duration)

    @classmethod
    def single_sine(
        cls, amplitude: Acceleration, period: float, duration: float | None = None
    ) -> GroundMotion:
        """One full sine: amplitude sin(2 pi t/period) up to one period.

        Parameters
        ----------
        amplitude : float or str
            Amplitude, a number [m/s2] or a text with its unit.
        period : float
            Period [s].
        duration : float, optional
            Duration with the quiet time after the pulse [s], at least the pulse; if not given, ten
            periods of quiet follow.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For a period that is not positive, and a duration shorter than the pulse.

        Examples
        --------
        >>> import rockeom as rk
        >>> pulse = rk.GroundMotion.single_sine(amplitude=3.0, period=0.5, duration=5.0)
        >>> pulse.peak, pulse.duration  # m/s2, s
        (3.0, 5.0)
        """
        return _pulse("single sine", amplitude, period, 1.0, 0.0, duration)

    @classmethod
    def single_cosine(
        cls, amplitude: Acceleration, period: float, duration: float | None = None
    ) -> GroundMotion:
        """One full cosine: amplitude cos(2 pi t/period) up to one period.

        Parameters
        ----------
        amplitude : float or str
            Amplitude, a number [m/s2] or a text with its unit.
        period : float
            Period [s].
        duration : float, optional
            Duration with the quiet time after the pulse [s], at least the pulse; if not given, ten
            periods of quiet follow.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For a period that is not positive, and a duration shorter than the pulse.
        """
        return _pulse("single cosine", amplitude, period, 1.0, 0.5 * math.pi, duration)

    @classmethod
    def harmonic(
        cls,
        amplitude: Acceleration,
        *,
        duration: float,
        frequency: float | None = None,
        angular_frequency: float | None = None,
        period: float | None = None,
        phase: float = 0.0,
    ) -> GroundMotion:
        """Harmonic motion: amplitude sin(omega t + phase), without end up to the duration.

        Exactly one of frequency, angular_frequency and period is needed.

        Parameters
        ----------
        amplitude : float or str
            Amplitude, a number [m/s2] or a text with its unit.
        duration : float
            Duration [s].
        frequency : float, optional
            Frequency [Hz].
        angular_frequency : float, optional
            Angular frequency omega [rad/s].
        period : float, optional
            Period [s].
        phase : float, optional
            Phase angle [rad], pi/2 for a cosine.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For none or several of the three, and for numbers that are not positive.

        Examples
        --------
        >>> import rockeom as rk
        >>> shaking = rk.GroundMotion.harmonic(amplitude=2.0, frequency=1.5, duration=20.0)
        >>> shaking.duration  # s
        20.0
        """
        a, phase = finite_number("amplitude", amplitude), finite_number("phase", phase)
        end = positive_number("duration", duration)
        values = {"frequency": frequency, "angular_frequency": angular_frequency, "period": period}
        stated = [name for name, value in values.items() if value is not None]
        if len(stated) != 1:
            error = InputError("harmonic").wrong(f"has {' and '.join(stated) or 'no frequency'}")
            wanted = "exactly one of frequency [Hz], angular_frequency [rad/s] and period [s]"
            raise error.give(wanted)
        value = positive_number(stated[0], values[stated[0]])
        omega = {
            "frequency": 2.0 * math.pi * value,
            "angular_frequency": value,
            "period": 2.0 * math.pi / value,
        }[stated[0]]
        name = named("harmonic, {:.4g} m/s2, {:.4g} rad/s", a, omega)
        return _analytic(name, [(end, pieces.SINE, a, omega, phase)])

    @classmethod
    def ricker(
        cls,
        amplitude: Acceleration,
        period: float,
        duration: float | None = None,
        antisymmetric: bool = False,
    ) -> GroundMotion:
        """Ricker wavelet with a largest acceleration.

        Parameters
        ----------
        amplitude : float or str
            Largest acceleration, a number [m/s2] or a text with its unit.
        period : float
            2 pi over the angular frequency at which the Fourier spectrum peaks [s].
        duration : float, optional
            Duration with the quiet time after the wavelet [s], at least four periods; if not given,
            ten periods of quiet follow.
        antisymmetric : bool, optional
            Whether the wavelet is antisymmetric: it reaches +amplitude before its centre and
            -amplitude after it. The symmetric one is largest at its centre.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For a period that is not positive, and a duration shorter than the wavelet.

        Notes
        -----
        The wavelet is centred at two periods and cut off two periods before and after its centre,
        where the symmetric one is below 1e-14 and the antisymmetric one below 2e-9 of its peak.

        References
        ----------
        Ricker (1943, 1944) as written by Vassiliou and Makris, Bulletin of the Seismological
        Society of America 101 (2011) 596-618.

        Examples
        --------
        >>> import rockeom as rk
        >>> wavelet = rk.GroundMotion.ricker(4.0, 0.6)  # m/s2, s
        >>> round(wavelet.peak, 3)
        4.0
        """
        a, t_p = finite_number("amplitude", amplitude), positive_number("period", period)
        centre = _RICKER_HALF_WINDOW * t_p
        kind, c0, c1 = pieces.RICKER, a, math.pi / t_p
        if antisymmetric:
            kind, c0 = pieces.ANTISYMMETRIC_RICKER, a / pieces.ANTISYMMETRIC_RICKER_PEAK
            c1 = 2.0 * math.pi / (math.sqrt(3.0) * t_p)
        shape = "antisymmetric Ricker" if antisymmetric else "Ricker"
        end = 2.0 * centre
        name = named(shape + ", {:.4g} m/s2, {:.4g} s", a, t_p)
        motion = _analytic(name, [(end, kind, c0, c1, centre)])
        return motion.padded_to(end + QUIET_PERIODS * t_p if duration is None else duration)

    @classmethod
    def mavroeidis_papageorgiou(
        cls,
        velocity: float,
        period: float,
        gamma: float,
        phase: float = 0.0,
        duration: float | None = None,
    ) -> GroundMotion:
        """Pulse of near-fault motions by Mavroeidis and Papageorgiou: a sine that swells.

        Parameters
        ----------
        velocity : float
            Amplitude A of the velocity [m/s].
        period : float
            1 over the prevailing frequency f_p [s].
        gamma : float
            Ratio of the envelope's length to the period, above 1.
        phase : float, optional
            Phase angle nu at the centre [rad].
        duration : float, optional
            Duration with the quiet time after the pulse [s], at least gamma periods; if not given,
            ten periods of quiet follow.

        Returns
        -------
        GroundMotion
            Motion.

        Raises
        ------
        InputError
            For a period that is not positive, a gamma that is not above 1, and a duration shorter
            than the pulse.

        Notes
        -----
        Its velocity is velocity/2 (1 + cos(2 pi x/(gamma period))) cos(2 pi x/period + phase) at a
        time x from its centre, within gamma period/2 of it; its acceleration, the rate of that, is
        a sum of three sines and no approximation.

        References
        ----------
        Mavroeidis and Papageorgiou, Bulletin of the Seismological Society of America 93 (2003)
        1099-1131.
        """
        a, t_p = finite_number("velocity", velocity), positive_number("period", period)
        g, nu = finite_number("gamma", gamma), finite_number("phase", phase)
        require(g > 1.0, "", "gamma", g, "give more than 1, the envelope is longer than a period")
        omega, end = 2.0 * math.pi / t_p, g * t_p
        pulse = (
            end, pieces.MAVROEIDIS_PAPAGEORGIOU, 0.5 * a * omega, omega, nu - math.pi * g, omega / g
        )  # fmt: skip
        name = named("Mavroeidis-Papageorgiou, {:.4g} m/s, {:.4g} s", a, t_p)
        motion = _analytic(name, [pulse])
        return motion.padded_to(end + QUIET_PERIODS * t_p if duration is None else duration)

    # -- random

    @classmethod
    def kanai_tajimi(
        cls,
        spectral_intensity: float,
        *,
        duration: float,
        seed: int,
        angular_frequency: float = 5.0 * math.pi,
        damping_ratio: float = 0.6,
        envelope: Callable[[np.ndarray], ArrayLike] | None = None,
        dt: float = 0.01,
    ) -> GroundMotion:
        """Gaussian white noise of the rock, filtered by the ground above it.

        Parameters
        ----------
        spectral_intensity : float
            Density S_0 of the white noise [m2/s3].
        duration : float
            Duration [s].
        seed : int
            Seed; equal seeds give equal motions.
        angular_frequency : float, optional
            Angular frequency omega_g of the ground [rad/s]; the default is that of firm ground.
        damping_ratio : float, optional
            Damping ratio xi of the ground; the default is that of firm ground.
        envelope : callable, optional
            Function of times (n,) [s] that multiplies the stationary noise, such as
            `JenningsEnvelope` or `ShinozukaSatoEnvelope`.
        dt : float, optional
            Time step of the samples [s].

        Returns
        -------
        GroundMotion
            Record.

        Raises
        ------
        InputError
            For numbers that are not positive.

        Notes
        -----
        Its power spectral density, over angular frequencies of both signs, is ``S_0 (1 + 4 xi**2
        r**2)/((1 - r**2)**2 + 4 xi**2 r**2)``, r = omega/omega_g, up to pi/dt.

        References
        ----------
        Kanai (1957), Tajimi (1960); the method: Shinozuka and Deodatis, Applied Mechanics Reviews
        44 (1991) 191-204, with Gaussian amplitudes.

        Examples
        --------
        >>> import rockeom as rk
        >>> motion = rk.GroundMotion.kanai_tajimi(0.01, duration=20.0, seed=1)
        >>> motion == rk.GroundMotion.kanai_tajimi(0.01, duration=20.0, seed=1)
        True
        """
        ground = _filter("", angular_frequency, damping_ratio)
        return _of_noise(
            "Kanai-Tajimi", spectral_intensity, ground, None, duration, seed, envelope, dt
        )

    @classmethod
    def clough_penzien(
        cls,
        spectral_intensity: float,
        *,
        duration: float,
        seed: int,
        angular_frequency: float = 5.0 * math.pi,
        damping_ratio: float = 0.6,
        high_pass_angular_frequency: float = 0.5 * math.pi,
        high_pass_damping_ratio: float = 0.6,
        envelope: Callable[[np.ndarray], ArrayLike] | None = None,
        dt: float = 0.01,
    ) -> GroundMotion:
        """Noise as of `kanai_tajimi`, with a second filter that keeps displacements finite.

        Parameters
        ----------
        spectral_intensity : float
            Density S_0 of the white noise [m2/s3].
        duration : float
            Duration [s].
        seed : int
            Seed; equal seeds give equal motions.
        angular_frequency : float, optional
            Angular frequency omega_g of the ground [rad/s].
        damping_ratio : float, optional
            Damping ratio xi of the ground.
        high_pass_angular_frequency : float, optional
            Angular frequency omega_f of the second filter [rad/s].
        high_pass_damping_ratio : float, optional
            Damping ratio xi_f of the second filter.
        envelope : callable, optional
            Function of times (n,) [s] that multiplies the stationary noise.
        dt : float, optional
            Time step of the samples [s].

        Returns
        -------
        GroundMotion
            Record.

        Raises
        ------
        InputError
            For numbers that are not positive.

        Notes
        -----
        The second filter multiplies the density by ``q**4/((1 - q**2)**2 + 4 xi_f**2 q**2)``, q =
        omega/omega_f.

        References
        ----------
        Clough and Penzien, Dynamics of Structures (1975).
        """
        ground = _filter("", angular_frequency, damping_ratio)
        high_pass = _filter("high_pass_", high_pass_angular_frequency, high_pass_damping_ratio)
        return _of_noise(
            "Clough-Penzien", spectral_intensity, ground, high_pass, duration, seed, envelope, dt
        )

    # -- made from numbers and files

    @classmethod
    def from_array(
        cls,
        acceleration: ArrayLike,
        dt: float,
        *,
        name: str = "array",
        units: str = "m/s2",
        gravity: float = STANDARD_GRAVITY,
    ) -> GroundMotion:
        """Record of accelerations at even steps.

        Parameters
        ----------
        acceleration : array_like
            Accelerations (n,) in `units` at times 0, dt, 2 dt ..., n >= 2.
        dt : float
            Time step [s].
        name : str, optional
            Label of the motion.
        units : str, optional
            Unit of the accelerations: "m/s2", "g", "cm/s2", "gal", "mm/s2", "in/s2" or "ft/s2".
        gravity : float, optional
            Value of 1 g [m/s2].

        Returns
        -------
        GroundMotion
            Record, linear between the samples.

        Raises
        ------
        InputError
            For NaN or infinity (with its index) and for other than one dimension.

        Examples
        --------
        >>> import rockeom as rk
        >>> values = [0.0, 0.1, -0.2, 0.1]
        >>> rk.GroundMotion.from_array(values, dt=0.01, units="g").peak  # m/s2
        1.962...
        """
        values = _accelerations(acceleration) * factor(units, gravity)
        return _from_record(Record(values, dt, name, "array"))

    @classmethod
    def from_at2(
        cls,
        path: FilePath,
        *,
        units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
        name: str | None = None,
    ) -> GroundMotion:
        """PEER record (.AT2), with the old or the new header.

        Parameters
        ----------
        path : path_like
            File.
        units : str, optional
            Unit, only where the header does not state it ("IN UNITS OF G").
        gravity : float, optional
            Value of 1 g [m/s2].
        name : str, optional
            Label of the motion; the second line of the file if not given.

        Returns
        -------
        GroundMotion
            Record.

        Raises
        ------
        InputError
            With file, line, value and remedy, for anything the file does not state.

        Examples
        --------
        >>> import rockeom as rk
        >>> record = rk.GroundMotion.from_at2("RSN6_IMPVALL.I_I-ELC180.AT2")  # doctest: +SKIP
        """
        return _from_record(_readers().read(path, units, gravity, name, is_at2=True))

    @classmethod
    def from_columns(
        cls,
        path: FilePath,
        *,
        units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
        name: str | None = None,
    ) -> GroundMotion:
        """Record of a text file of two columns, time [s] and acceleration.

        Parameters
        ----------
        path : path_like
            File.
        units : str, optional
            Unit of the accelerations: "m/s2", "g", "cm/s2", "gal", "mm/s2", "in/s2" or "ft/s2"; may
            be left out only where the heading states it, as in "acceleration (g)".
        gravity : float, optional
            Value of 1 g [m/s2].
        name : str, optional
            Label of the motion; the file's name if not given.

        Returns
        -------
        GroundMotion
            Record. It starts at the first time, whatever its value.

        Raises
        ------
        InputError
            With file, line, value and remedy, for anything the file does not state, and for a time
            step that is not uniform.

        Notes
        -----
        Columns are separated by blanks, tabs, commas or semicolons. Lines that start with # or %
        are comments, and one line of names may precede the numbers.

        Examples
        --------
        >>> import rockeom as rk
        >>> record = rk.GroundMotion.from_columns("record.txt", units="g")  # doctest: +SKIP
        """
        return _from_record(_readers().read(path, units, gravity, name, is_at2=False))

    @classmethod
    def from_csv(
        cls,
        path: FilePath,
        *,
        time_column: str | int | None = None,
        acceleration_column: str | int | None = None,
        dt: float | None = None,
        units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
        name: str | None = None,
        layout: str | None = None,
    ) -> GroundMotion:
        """Record of two columns out of several of a text file.

        Parameters
        ----------
        path : path_like
            File.
        time_column : str or int, optional
            Heading or number (from 0) of the column of the time [s].
        acceleration_column : str or int, optional
            Heading or number (from 0) of the column of the acceleration.
        dt : float, optional
            Time step [s] of a file without a column of times.
        units : str, optional
            Unit of the accelerations, as for `from_columns`.
        gravity : float, optional
            Value of 1 g [m/s2].
        name : str, optional
            Label of the motion; the file's name if not given.
        layout : str, optional
            "wrapped" for accelerations that run on from one column to the next, "columns" for a
            channel in each. If not given, a file without a heading that looks wrapped is refused.

        Returns
        -------
        GroundMotion
            Record.

        Raises
        ------
        InputError
            As `from_columns`.

        Examples
        --------
        >>> import rockeom as rk
        >>> record = rk.GroundMotion.from_csv("record.csv", units="m/s2")  # doctest: +SKIP
        """
        columns = time_column, acceleration_column
        return _from_record(_readers().read_csv(path, *columns, dt, units, gravity, name, layout))

    @classmethod
    def read(
        cls,
        path: FilePath,
        *,
        component: str | float | None = None,
        units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
        name: str | None = None,
        stated_peak: bool = True,
    ) -> GroundMotion:
        """Record from a file of a network, a PEER record or two columns, recognised by content.

        Parameters
        ----------
        path : path_like
            File. :doc:`/how-to/network-files` lists the formats.
        component : str or float, optional
            Component of a file that holds several: its name ("N28W"), its number from 1 on, or
            its azimuth, clockwise from north [degrees].
        units : str, optional
            Unit of the accelerations, where the file does not state it.
        gravity : float, optional
            Value of 1 g [m/s2].
        name : str, optional
            Label of the motion.
        stated_peak : bool, optional
            Whether the peak that a network's header states must be that of the values, to half a
            unit of its last digit.

        Returns
        -------
        GroundMotion
            Record.

        Raises
        ------
        InputError
            With file, line, value and remedy, for anything the file does not state, and for a file
            of several components without `component`.

        See Also
        --------
        Recording.read : All components of a station.

        Examples
        --------
        >>> import rockeom as rk
        >>> record = rk.GroundMotion.read("RSN6_IMPVALL.I_I-ELC180.AT2")  # doctest: +SKIP
        """
        readers = _readers()
        records = readers.read_file(path, units, gravity, stated_peak)
        record = readers.one_component(path, records, component)
        return _from_record(record if name is None else record._replace(name=name))

    @classmethod
    def from_library(cls, words: str) -> GroundMotion:
        """Real record of the extras `records` and `fema`, by words of its name.

        Parameters
        ----------
        words : str
            Enough words to identify one record, such as "El Centro 1940 180"; `library` lists the
            names.

        Returns
        -------
        GroundMotion
            Record. Those in g are converted with 9.81 m/s2.

        Raises
        ------
        InputError
            If none or several match, or if no extra is installed.

        Examples
        --------
        >>> import rockeom as rk
        >>> rk.GroundMotion.from_library("El Centro 1940 180").duration  # doctest: +SKIP
        53.71
        """
        return _from_record(_library().find(words).read())

    @classmethod
    def library(cls, words: str = "") -> tuple[str, ...]:
        """Names of the records that `from_library` knows, or of those that have all these words.

        Parameters
        ----------
        words : str, optional
            Words of the names, such as "Northridge", or one of the sets of FEMA P695 (2009),
            Appendix A: "far field" (44 components), "near field pulse" and "near field no pulse"
            (28 each).

        Returns
        -------
        tuple of str
            Names.

        Raises
        ------
        InputError
            If none has the words, or if no extra is installed.

        Examples
        --------
        >>> import rockeom as rk
        >>> len(rk.GroundMotion.library("far field"))  # doctest: +SKIP
        44
        """
        return _library().names(words)

    # -- time histories

    @property
    def duration(self) -> float:
        """End of the last segment [s]."""
        return number("duration", self.segments[-1, pieces.END])

    @property
    def peak(self) -> float:
        """Largest absolute acceleration [m/s2], exact to rounding."""
        if self.samples is not None:
            return number("peak", np.abs(self.samples).max())
        return pieces.peak(self.segments)

    @property
    def shaking_ends(self) -> float:
        """Time after which the acceleration is identically zero [s]; 0.0 if it always is."""
        return pieces.shaking_ends(self.segments)

    @property
    def breakpoints(self) -> np.ndarray:
        """Ends of the segments (n + 1,) [s], where an integrator has to stop."""
        return np.append(self.segments[:, pieces.START], self.segments[-1, pieces.END])

    def acceleration(self, t: ArrayLike) -> Any:
        """Acceleration of the ground.

        Parameters
        ----------
        t : array_like
            Times [s], any shape.

        Returns
        -------
        float or ndarray
            Acceleration [m/s2], in the shape of t. At a breakpoint the value is that of the segment
            which starts there.
        """
        time = array_of("t", t)
        flat = time.ravel()
        index, tau = self._at(flat)
        result = pieces.acceleration(self.segments[index], tau)
        result[(flat < 0.0) | (flat > self.duration)] = 0.0
        return result.reshape(time.shape)[()]

    def _at(self, flat: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Index of the segment at each time (m,) [s], and the local time in it [s]."""
        starts = self.segments[:, pieces.START]
        index = np.maximum(np.searchsorted(starts, flat, side="right") - 1, 0)
        return index, flat - starts[index]

    def velocity(self, t: ArrayLike) -> Any:
        """Velocity of the ground, the exact integral of the acceleration, for ground at rest up to
        time 0.

        Parameters
        ----------
        t : array_like
            Times [s], any shape.

        Returns
        -------
        float or ndarray
            Velocity [m/s], in the shape of t. After the end it keeps its last value, which is zero
            only for a corrected motion.
        """
        time = array_of("t", t)
        flat = np.clip(time.ravel(), 0.0, self.duration)
        index, tau = self._at(flat)
        v, _ = pieces.at_starts(self.segments)
        result = v[index] + pieces.velocity(self.segments[index], tau)
        return result.reshape(time.shape)[()]

    def displacement(self, t: ArrayLike) -> Any:
        """Displacement of the ground, the exact integral of `velocity`, also after the end.

        Parameters
        ----------
        t : array_like
            Times [s], any shape.

        Returns
        -------
        float or ndarray
            Displacement [m], in the shape of t.
        """
        time = array_of("t", t)
        flat = np.clip(time.ravel(), 0.0, self.duration)
        index, tau = self._at(flat)
        v, d = pieces.at_starts(self.segments)
        result = d[index] + v[index] * tau + pieces.displacement(self.segments[index], tau)
        result += v[-1] * np.maximum(time.ravel() - self.duration, 0.0)
        return result.reshape(time.shape)[()]

    # -- intensity

    @property
    def peak_velocity(self) -> float:
        """Largest absolute velocity of the ground [m/s] within the duration, exact to rounding."""
        return _intensity().peak_velocity(self)

    @property
    def peak_displacement(self) -> float:
        """Largest absolute displacement within the duration, exact to rounding [m].

        A record that ends with a velocity has a displacement that grows with it: see
        `baseline_corrected`.
        """
        return _intensity().peak_displacement(self)

    def measures(self) -> intensity.Measures:
        """All intensity measures by name, from PGA to the predominant period, with units.

        Returns
        -------
        Measures
            Intensity measures.

        Examples
        --------
        >>> import rockeom as rk
        >>> round(rk.GroundMotion.single_sine(2.0, 0.5, duration=0.5).measures().cav, 6)  # m/s
        0.63662
        """
        return _intensity().measures(self)

    def significant_interval(self, lower: float = 0.05, upper: float = 0.95) -> tuple[float, float]:
        """Times at which Arias intensity reaches two parts of its whole.

        Their difference is the significant duration (Trifunac and Brady 1975).

        Parameters
        ----------
        lower : float, optional
            Part of the whole at the first time.
        upper : float, optional
            Part of the whole at the second time.

        Returns
        -------
        start : float
            First time, exact within the segments [s].
        end : float
            Second time [s].

        Raises
        ------
        InputError
            For parts that are not between 0 and 1, and for no shaking.
        """
        return _intensity().significant_interval(self, lower, upper)

    def response_spectrum(
        self, periods: ArrayLike | None = None, damping_ratio: float = 0.05
    ) -> ResponseSpectrum:
        """Elastic response spectrum, see `analysis.response_spectrum`.

        Parameters
        ----------
        periods : array_like, optional
            Periods (n,) [s]; if not given, 100 from 0.02 to 10 s.
        damping_ratio : float, optional
            Damping ratio of the oscillators.

        Returns
        -------
        ResponseSpectrum
            Spectrum.

        Raises
        ------
        ValueError
            For a period that is not positive and for a damping ratio outside [0, 1).

        Examples
        --------
        >>> import rockeom as rk
        >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
        >>> spectrum = pulse.response_spectrum(periods=[0.5, 1.0, 2.0], damping_ratio=0.05)
        >>> spectrum.acceleration.shape  # m/s2
        (3,)
        """
        from rockeom.motion.spectra import response_spectrum

        periods = np.geomspace(0.02, 10.0, 100) if periods is None else periods
        return response_spectrum(self, periods, damping_ratio)

    def plot(self, **kwargs: Any) -> Any:
        """Draw acceleration, velocity and displacement; see `plots.plot_motion`.

        Parameters
        ----------
        **kwargs : object
            Further arguments of `plots.plot_motion`.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.
        """
        return picture("plot_motion", self, **kwargs)

    def sampled(self, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Accelerations at even steps up to the duration.

        Parameters
        ----------
        dt : float
            Time step [s].

        Returns
        -------
        t : ndarray
            Times 0, dt, 2 dt ... (m,) [s].
        acceleration : ndarray
            Accelerations (m,) [m/s2].

        Raises
        ------
        InputError
            For a step that is not positive.
        """
        steps = math.floor(self.duration / positive_number("dt", dt) * (1.0 + 1e-12))
        t = np.minimum(dt * np.arange(steps + 1), self.duration)
        return t, self.acceleration(t)

    # -- made from another

    def scaled(self, acceleration: float = 1.0, time: float = 1.0) -> GroundMotion:
        """Motion with accelerations and the time axis multiplied by factors.

        Parameters
        ----------
        acceleration : float, optional
            Factor of the accelerations.
        time : float, optional
            Factor of the times.

        Returns
        -------
        GroundMotion
            Motion, named as in Table 4-1 of the thesis: "Tabas-A1-T0.38" has the accelerations of
            Tabas in 0.38 times its time.

        Raises
        ------
        InputError
            For a factor of the times that is not positive.

        Examples
        --------
        >>> import rockeom as rk
        >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
        >>> weaker = pulse.scaled(acceleration=0.5, time=2.0)
        >>> weaker.peak, weaker.duration  # m/s2, s
        (1.75, 8.0)
        """
        a, s = finite_number("acceleration", acceleration), positive_number("time", time)
        if len(self.segments) > pieces.SHORT:
            a, s = one_of(a), one_of(s)  # one such table at a time, also of columns
        return GroundMotion(
            pieces.scaled(self.segments, a, s),
            scaled_name(self.name, a, s),
            self.source,
            None if self.dt is None else self.dt * s,
            None if self.samples is None else self.samples * a,
            self.is_vertical,
            self.origin,
        )

    def scaled_to(
        self,
        peak: Acceleration | None = None,
        *,
        pga: Acceleration | None = None,
        sa: Acceleration | None = None,
        period: float | None = None,
        damping_ratio: float = 0.05,
    ) -> GroundMotion:
        """Motion with accelerations multiplied so that its intensity has a value.

        Exactly one of peak, pga and sa is needed, a number [m/s2] or a text with its unit: "0.4 g",
        "250 cm/s2". A vertical component is scaled along by `Recording.scaled_to`.

        Parameters
        ----------
        peak : float or str, optional
            Largest absolute acceleration.
        pga : float or str, optional
            Largest absolute acceleration, by its other name.
        sa : float or str, optional
            Pseudo-acceleration of an oscillator with the period and the damping ratio.
        period : float, optional
            Period of the oscillator [s].
        damping_ratio : float, optional
            Damping ratio of the oscillator.

        Returns
        -------
        GroundMotion
            Scaled motion.

        Raises
        ------
        InputError
            For none or two of the three, sa without a period, a value that is not positive, and a
            motion without shaking.

        Examples
        --------
        >>> import rockeom as rk
        >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4)  # m/s2, s
        >>> round(pulse.scaled_to(pga="0.4 g").peak, 3)  # m/s2
        3.924
        >>> stronger = pulse.scaled_to(sa=6.0, period=1.0)  # m/s2, s
        """
        wanted = target(peak, pga, sa, period)
        found = self.peak
        if wanted.period is not None:
            spectrum = self.response_spectrum(wanted.period, damping_ratio)
            found = spectrum.pseudo_acceleration[0]
        multiple = wanted.value / found if found > 0.0 else math.inf
        if not math.isfinite(value_of(multiple)):
            raise InputError("pga", of=self.name).says(
                "no factor makes a motion of zero acceleration shake"
            )
        return self.scaled(multiple)

    def padded_to(self, duration: float) -> GroundMotion:
        """Motion with quiet time at its end, for a total duration.

        Parameters
        ----------
        duration : float
            Total duration [s].

        Returns
        -------
        GroundMotion
            Longer motion.

        Raises
        ------
        InputError
            For a duration shorter than that of the motion.
        """
        wanted = positive_number("duration", duration)
        if wanted < self.duration:
            raise InputError("duration", wanted).wrong(
                f"is {wanted:g} s, but {self.name or 'the motion'} lasts {self.duration:g} s: give "
                "a longer duration"
            )
        if wanted == self.duration:
            return self
        quiet = [self.duration, wanted, pieces.LINEAR, 0.0, 0.0, 0.0, 0.0]
        return replace(self, segments=np.vstack([self.segments, quiet]))

    def padded_by(self, quiet: float) -> GroundMotion:
        """Motion with quiet time added at its end.

        Parameters
        ----------
        quiet : float
            Quiet time [s].

        Returns
        -------
        GroundMotion
            Longer motion.

        Raises
        ------
        InputError
            For a time that is not positive.
        """
        return self.padded_to(self.duration + positive_number("quiet", quiet))

    # -- processed

    def baseline_corrected(self, degree: int = 1, of: str = "velocity") -> GroundMotion:
        """Record without the polynomial that fits its velocity best.

        Parameters
        ----------
        degree : int, optional
            Degree of the polynomial, fitted by least squares to all samples.
        of : str, optional
            Series that the polynomial fits: "velocity", "acceleration" or "displacement". For the
            velocity and the displacement the polynomial starts at rest, as the ground does, and its
            first or second derivative is subtracted from the acceleration.

        Returns
        -------
        GroundMotion
            Corrected record.

        Raises
        ------
        InputError
            For a motion without samples and for a degree that such a polynomial cannot have.
        """
        return self._changed(_processing().baseline_corrected(self, degree, of))

    def filtered(
        self, low: float | None = None, high: float | None = None, order: int = 4
    ) -> GroundMotion:
        """Record through a Butterworth filter, forward and backward, without phase shift.

        Parameters
        ----------
        low : float, optional
            Corner below which frequencies are removed [Hz]; None for no such corner.
        high : float, optional
            Corner above which frequencies are removed [Hz]; None for no such corner. At a corner
            the filter halves the amplitude.
        order : int, optional
            Order of one pass.

        Returns
        -------
        GroundMotion
            Filtered record of the same duration.

        Raises
        ------
        InputError
            For a motion without samples, and for corners in wrong order, above half of the rate of
            sampling, or so low that a hundredth of a period fills the record.

        Notes
        -----
        Zeros extend the record before and after, for as long as the filter rings.
        """
        return self._changed(_processing().filtered(self, low, high, order))

    def resampled(self, dt: float, method: str = "linear") -> GroundMotion:
        """Motion as a record with another time step.

        Parameters
        ----------
        dt : float
            Time step [s].
        method : str, optional
            "linear" evaluates the acceleration at the new times: this cuts peaks between them and
            aliases frequencies above half of the new rate. "band limited" interpolates a record
            through its Fourier spectrum and removes these frequencies, by
            scipy.signal.resample_poly; the ratio of the old and the new step must then be one of
            whole numbers up to 1000.

        Returns
        -------
        GroundMotion
            Record, linear between the new times. The last one is the last whole step within the
            motion.

        Raises
        ------
        InputError
            For a step that is not positive, another method, or a ratio of steps that the method
            cannot have.
        """
        return self._changed(_processing().resampled(self, dt, method))

    def trimmed(self, start: float = 0.0, end: float | None = None) -> GroundMotion:
        """Part of the motion between two times, its times counted from the first.

        Parameters
        ----------
        start : float, optional
            First time [s].
        end : float, optional
            Last time [s]; the end of the motion if not given.

        Returns
        -------
        GroundMotion
            Part of the motion. A record begins and ends at the samples nearest to them; an analytic
            motion exactly there.

        Raises
        ------
        InputError
            For times outside the motion, for fewer than two samples, and where a
            Mavroeidis-Papageorgiou pulse would lose its beginning.

        Examples
        --------
        >>> import rockeom as rk
        >>> record = rk.GroundMotion.kanai_tajimi(0.01, duration=20.0, seed=1)
        >>> record.trimmed(*record.significant_interval(0.05, 0.95)).duration < 20.0  # s
        True
        """
        until = self.duration if end is None else end
        return self._changed(_processing().trimmed(self, start, until))

    def _changed(self, to: processing.Processed) -> GroundMotion:
        """The motion of a processed record; its source names the process."""
        if to.segments is not None:
            made = GroundMotion(to.segments, self.name)
        else:
            assert to.samples is not None
            assert to.dt is not None
            made = GroundMotion.from_array(to.samples, to.dt, name=self.name)
            if to.padded and made.duration < self.duration * (1.0 - 1e-9):
                made = made.padded_to(self.duration)
        source = f"{self.source}, {to.done}"
        return replace(made, source=source, is_vertical=self.is_vertical, origin=self.origin)

    def rotated(self, other: GroundMotion, angle: float) -> GroundMotion:
        """Component between two records at right angles: cos(angle) self + sin(angle) other.

        Parameters
        ----------
        other : GroundMotion
            Component at 90 degrees from this one, recorded at the same times.
        angle : float
            Angle from this component's direction towards the other's [rad].

        Returns
        -------
        GroundMotion
            Record along the direction.

        Raises
        ------
        InputError
            For motions without samples, or with other times.

        Examples
        --------
        Sylmar 360 from its components 032 and 122, which run 32 and 122 degrees from north:

        >>> import math
        >>> import rockeom as rk
        >>> names = ("Sylmar SYL 032", "Sylmar SYL 122")
        >>> first, second = map(rk.GroundMotion.from_library, names)  # doctest: +SKIP
        >>> first.rotated(second, math.radians(-32)).peak  # m/s2  # doctest: +SKIP
        8.272833079011688
        """
        require(isinstance(other, GroundMotion), "", "other", other, "give a GroundMotion")
        turn = finite_number("angle", angle)
        segments, samples = _processing().rotated(self, other, turn)
        name = (
            f"{named('{:.4g} degrees from ', turn * (180.0 / math.pi))}{self.name} to {other.name}"
        )
        source = f"of {self.source} and of {other.source}"
        return GroundMotion(segments, name, source, self.dt, samples)

    __array_ufunc__ = None  # so that a number of NumPy leaves the product to the motion

    def __mul__(self, factor: float) -> GroundMotion:
        """The motion with its accelerations multiplied by a number."""
        return self.scaled(acceleration=multiplier(factor))

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> GroundMotion:
        """The motion with its accelerations divided by a number."""
        return self.scaled(acceleration=1.0 / multiplier(divisor, "divided"))

    def __neg__(self) -> GroundMotion:
        """The mirrored motion."""
        name = self.name[1:] if self.name.startswith("-") else f"-{self.name}"
        return replace(self.scaled(acceleration=-1.0), name=name)

    # -- comparison, text, pickling

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, GroundMotion):
            return NotImplemented
        mine, theirs = (self.name, self.source), (other.name, other.source)
        return mine == theirs and np.array_equal(self.segments, other.segments)

    def __hash__(self) -> int:
        table = self.segments
        numbers = tuple(table.flat) if table.dtype == object else table.tobytes()
        return hash((self.name, self.source, numbers))

    def __repr__(self) -> str:
        record = "" if self.samples is None else f", {len(self.samples)} samples at {self.dt:.6g} s"
        return (
            f"GroundMotion({self.name!r}: {self.duration:.6g} s, peak {nominal(self).peak:.4g} "
            f"m/s2{record})"
        )

    def _repr_html_(self) -> str:
        return picture("page_of_motion", self)

    def __reduce__(self) -> tuple[Any, ...]:
        # Arrays come back writable from a pickle; the constructor locks them again.
        fields = self.segments, self.name, self.source, self.dt, self.samples
        return GroundMotion, (*fields, self.is_vertical, self.origin), call_of(self)


# -- construction --------------------------------------------------------------------------------


def _accelerations(acceleration: ArrayLike) -> np.ndarray:
    """Accelerations of a record as finite numbers (n,).

    Raises InputError for other than one dimension, and for NaN or infinity, with the index.
    """
    values = array_of(
        "acceleration", acceleration, bounds="numbers; GroundMotion.read reads a file"
    )
    require(values.ndim == 1, "", "acceleration", values, "give one dimension, (n,)")
    finite = np.isfinite(value_of(values))
    require(finite, "", "acceleration", values, "give finite numbers, or cut the record there")
    return values


def _analytic(name: str, segments: list[tuple[float, ...]]) -> GroundMotion:
    """Segments one after the other, each by its end, kind and constants."""
    rows = []
    start = 0.0
    for end, *values in segments:
        rows.append([start, end, *values, *[0.0] * (pieces.COLUMNS - pieces.KIND - len(values))])
        start = end
    return GroundMotion(np.array(rows), name, "analytic")


def _pulse(
    shape: str,
    amplitude: Acceleration,
    period: float,
    periods: float,
    angle: float,
    duration: float | None,
) -> GroundMotion:
    """A sine with a phase angle for a number of periods, and quiet time after it."""
    a, t_p = finite_number("amplitude", amplitude), positive_number("period", period)
    end = periods * t_p
    pulse = (end, pieces.SINE, a, 2.0 * math.pi / t_p, angle)
    name = named(shape + ", {:.4g} m/s2, {:.4g} s", a, t_p)
    total = end + QUIET_PERIODS * t_p if duration is None else positive_number("duration", duration)
    if total > end:  # both at once: maps make many of them
        return _analytic(name, [pulse, (total, pieces.LINEAR)])
    return _analytic(name, [pulse]).padded_to(total)


def _intensity() -> ModuleType:
    """How strong a motion is; imported on use, as what processes and reads records."""
    from rockeom.motion import intensity

    return intensity


def _processing() -> ModuleType:
    from rockeom.motion import processing

    return processing


def _readers() -> ModuleType:
    """The readers of files; imported on use, since they compile many patterns."""
    from rockeom.motion import readers

    return readers


def _filter(which: str, angular_frequency: float, damping_ratio: float) -> tuple[float, float]:
    """The two numbers of an oscillator through which noise passes."""
    frequency = positive_number(f"{which}angular_frequency", angular_frequency)
    return frequency, positive_number(f"{which}damping_ratio", damping_ratio)


def _of_noise(*arguments: Any) -> GroundMotion:
    """See `rockeom.motion.synthetic.noise`."""
    from rockeom.motion.synthetic import noise

    made = noise(*arguments)
    motion = GroundMotion.from_array(made.samples, made.dt, name=made.name)
    return replace(motion, source=made.source)


def _library() -> ModuleType:
    """The records that packages carry; imported on use, as the readers."""
    from rockeom.motion import library

    return library


def every_component(
    path: FilePath,
    *,
    units: str | None = None,
    gravity: float = STANDARD_GRAVITY,
    stated_peak: bool = True,
) -> list[GroundMotion]:
    """All components of a file, named as the file is."""
    records = _readers().read_file(path, units, gravity, stated_peak)
    if len(records) == 1:
        records = [records[0]._replace(name=name_of(path))]
    return [_from_record(one) for one in records]


def is_recognised(path: FilePath) -> bool:
    """Whether a file is one of a network or of PEER, by its content."""
    return _readers().is_recognised(path)


def _from_record(record: Record) -> GroundMotion:
    """A record as linear segments between samples."""
    a, source, dt = record.acceleration, record.source, positive_number("dt", record.dt)
    require(len(a) >= 2, source, "acceleration", a, "give two samples or more")
    largest = np.abs(a).max()
    if largest > _ABSURD_PEAK:
        warn_caller(
            f"{source}: the peak of {largest:.4g} m/s2 ({largest / STANDARD_GRAVITY:.4g} g) "
            "is above the largest recorded one: check the units",
        )
    t = dt * np.arange(len(a))
    segments = np.zeros((len(a) - 1, pieces.COLUMNS), np.result_type(a, t))
    segments[:, pieces.START], segments[:, pieces.END] = t[:-1], t[1:]
    segments[:, pieces.C0], segments[:, pieces.C1] = a[:-1], np.diff(a) / np.diff(t)
    return GroundMotion(segments, record.name, source, dt, a, record.is_vertical, record.origin)
