"""`DesignSpectrum`: the elastic spectrum of a code or a table, and motions that have it."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.design import matching, nzs_1170_5
from rockeom.motion.design.checks import BAND, DAMPING, SpectrumCheck
from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.motion_set import MotionSet
from rockeom.motion.scaling import Acceleration
from rockeom.motion.synthetic import JenningsEnvelope, factors
from rockeom.motion.units import STANDARD_GRAVITY, acceleration, factor
from rockeom.numbers import explained
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import (
    InputError,
    array_of,
    number,
    positive_number,
    require,
    whole_number,
)

_STRONG_PART = JenningsEnvelope(rise=3.0, until=13.0, decay=0.3)
"""With the 10 s of stationary motion that EN 1998-1:2004, 3.2.3.1.2(3), asks for."""

_EUROCODE = {
    1: {  # table 3.2
        "A": (1.0, 0.15, 0.4, 2.0),
        "B": (1.2, 0.15, 0.5, 2.0),
        "C": (1.15, 0.20, 0.6, 2.0),
        "D": (1.35, 0.20, 0.8, 2.0),
        "E": (1.4, 0.15, 0.5, 2.0),
    },
    2: {  # table 3.3
        "A": (1.0, 0.05, 0.25, 1.2),
        "B": (1.35, 0.05, 0.25, 1.2),
        "C": (1.5, 0.10, 0.25, 1.2),
        "D": (1.8, 0.10, 0.30, 1.2),
        "E": (1.6, 0.05, 0.25, 1.2),
    },
}
"""S, T_B, T_C and T_D [s] of EN 1998-1:2004 by type of the spectrum and of the ground."""
_EUROCODE_LONGEST = 4.0  # s, 3.2.2.2(1)
_LEAST_ETA = 0.55
_VERY_LOW = 0.04 * STANDARD_GRAVITY
_CATEGORY_A = 0.167 * STANDARD_GRAVITY

_MATCHED = 0.01, 0.5  # damping ratios: less has too many oscillators, more tells no period apart
_FINER = 16  # parts between two matched periods, in which the largest difference is looked for
_WORST_MATCH = 0.25
_PEAK = 1.05
"""Largest acceleration of a matched motion, over the spectrum at the period 0."""
_CHECKED = 100


@explained.attributes(
    eurocode8="eurocode_8", ec8="eurocode_8", asce7="asce_7", nzs1170="nzs_1170_5",
    match="matched(record)", acceleration="spectrum(periods)",
)  # fmt: skip
@explained.calls(soil="ground_type=", pga="ground_acceleration=")
@dataclass(frozen=True)
class DesignSpectrum(metaclass=explained.Constructors):
    """Elastic design spectrum: pseudo-acceleration over the period.

    A call with periods [s] returns pseudo-accelerations [m/s2]. The class methods make spectra:
    `eurocode_8`, `asce_7`, `nzs_1170_5`, `from_table`.

    Parameters
    ----------
    name : str
        Name.
    damping_ratio : float
        Damping ratio.
    shortest : float
        Shortest period for which the spectrum is defined [s].
    longest : float
        Longest period for which it is defined [s].
    shape : callable
        Function of periods (n,) [s] that gives the pseudo-accelerations (n,) [m/s2].

    Examples
    --------
    >>> import rockeom as rk
    >>> spectrum = rk.DesignSpectrum.eurocode_8("0.25 g", "B")
    >>> spectrum([0.0, 0.5, 2.0]).round(3)  # m/s2
    array([2.943, 7.358, 1.839])

    Artificial motions with this spectrum::

        motions = spectrum.compatible_motions(7, seed=1)  # a MotionSet
        print(spectrum.check(motions, period=0.6))
    """

    name: str
    damping_ratio: float
    shortest: float
    longest: float
    shape: Callable[[np.ndarray], np.ndarray] = field(repr=False)

    def __post_init__(self) -> None:
        if not 0.0 < self.damping_ratio < 1.0:
            raise InputError("damping_ratio", self.damping_ratio).give("less than 1, as 0.05")

    @classmethod
    def eurocode_8(
        cls,
        ground_acceleration: Acceleration,
        ground_type: str,
        spectrum_type: int = 1,
        *,
        damping_ratio: float = 0.05,
    ) -> Self:
        """Horizontal elastic spectrum of EN 1998-1:2004, 3.2.2.2, with the recommended values.

        It is defined up to 4 s.

        Parameters
        ----------
        ground_acceleration : float or str
            Acceleration a_g on ground of type A with the factor of importance, a number [m/s2] or a
            text with its unit, "0.25 g".
        ground_type : str
            "A", "B", "C", "D" or "E".
        spectrum_type : int, optional
            1, or 2 where the earthquakes that govern have surface-wave magnitudes of at most 5.5.
        damping_ratio : float, optional
            Damping ratio xi, which counts by eta = sqrt(10/(5 + xi)), at least 0.55, xi in per
            cent.

        Returns
        -------
        DesignSpectrum
            Spectrum.

        Raises
        ------
        InputError
            For other values.
        """
        a_g = positive_number("ground_acceleration", acceleration("a_g", ground_acceleration))
        _question(ground_acceleration, "a_g", _VERY_LOW, "very low seismicity, EN 1998-1, 3.2.1(5)")
        xi = positive_number("damping_ratio", damping_ratio)
        kinds = _EUROCODE.get(spectrum_type) if isinstance(spectrum_type, int) else None
        if kinds is None:
            raise InputError("spectrum_type", spectrum_type).give("1 or 2")
        if not isinstance(ground_type, str) or ground_type.upper() not in kinds:
            raise InputError("ground_type", ground_type).choose(kinds)
        s, t_b, t_c, t_d = kinds[ground_type.upper()]
        eta = max(math.sqrt(10.0 / (5.0 + 100.0 * xi)), _LEAST_ETA)
        shape = _Branches(a_g * s, 2.5 * eta * a_g * s, t_b, t_c, t_d)
        name = f"EN 1998-1 type {spectrum_type}, ground {ground_type.upper()}, a_g {a_g:.4g} m/s2"
        return cls(name, xi, 0.0, _EUROCODE_LONGEST, shape)

    @classmethod
    def asce_7(cls, s_ds: Acceleration, s_d1: Acceleration, t_l: float) -> Self:
        """Two-period design spectrum of ASCE 7-16, 11.4.6, for 5 % damping.

        Parameters
        ----------
        s_ds : float or str
            Design spectral acceleration at short periods, a number [m/s2] or a text with its unit,
            "1.0 g".
        s_d1 : float or str
            Design spectral acceleration at 1 s, likewise.
        t_l : float
            Long-period transition period T_L [s].

        Returns
        -------
        DesignSpectrum
            Spectrum.

        Raises
        ------
        InputError
            For values that are not positive, and for t_l below s_d1/s_ds.
        """
        short = positive_number("s_ds", acceleration("s_ds", s_ds))
        at_one = positive_number("s_d1", acceleration("s_d1", s_d1))
        _question(s_ds, "s_ds", _CATEGORY_A, "seismic design category A, ASCE 7-16, table 11.6-1")
        t_s, last = at_one / short, positive_number("t_l", t_l)
        require(last > t_s, "", "t_l", last, f"give T_L, above s_d1/s_ds = {t_s:.4g} s")
        name = f"ASCE 7, S_DS {short:.4g} m/s2, S_D1 {at_one:.4g} m/s2"
        shape = _Branches(0.4 * short, short, 0.2 * t_s, t_s, last)
        return cls(name, 0.05, 0.0, math.inf, shape)

    @classmethod
    def nzs_1170_5(
        cls,
        hazard_factor: float,
        return_factor: float,
        site_class: str,
        *,
        fault_distance: float = math.inf,
    ) -> Self:
        """Horizontal elastic spectrum of NZS 1170.5:2004 for modal analysis and 5 % damping.

        Parameters
        ----------
        hazard_factor : float
            Hazard factor Z.
        return_factor : float
            Return period factor R.
        site_class : str
            Site subsoil class "A", "B", "C", "D" or "E".
        fault_distance : float, optional
            Distance D from the nearest major fault [m].

        Returns
        -------
        DesignSpectrum
            Spectrum ``C(T) g = Ch(T) Z R N(T, D) g``. Z R counts as 0.7 where it is more, as its
            name then says.

        Raises
        ------
        InputError
            For factors that are not positive, a negative distance, and another class.

        Notes
        -----
        N is 1 for R up to 0.75; else it grows with the period from 1 at 1.5 s to 1.72 at 5 s, full
        up to 2 km and linear to 1 at 20 km. The text of the standard was not at hand: all values
        are second-hand, the shape factors as the commentary has them.

        References
        ----------
        NZS 1170.5:2004, 3.1, second-hand.
        """
        z = positive_number("hazard_factor", hazard_factor)
        r = positive_number("return_factor", return_factor)
        distance = number("fault_distance", fault_distance)
        require(distance >= 0.0, "", "fault_distance", distance, "give zero or more, in metres")
        kinds = nzs_1170_5.SITE_CLASSES
        if not isinstance(site_class, str) or site_class.upper() not in kinds:
            raise InputError("site_class", site_class).choose(kinds)
        shape = nzs_1170_5.coefficient(site_class.upper(), z, r, distance)
        limit = " (limit)" if shape.hazard < z * r else ""
        near = f", fault at {distance / 1e3:g} km" if shape.near else ""
        name = f"NZS 1170.5, class {site_class.upper()}, Z R {shape.hazard:.4g}{limit}{near}"
        return cls(name, 0.05, 0.0, math.inf, shape)

    @classmethod
    def from_table(
        cls,
        periods: ArrayLike,
        accelerations: ArrayLike,
        *,
        units: str = "m/s2",
        damping_ratio: float = 0.05,
        name: str = "design spectrum",
    ) -> Self:
        """Spectrum through points, linear between them.

        Parameters
        ----------
        periods : array_like
            Periods (n,) [s], rising, from 0 where the peak of the ground is known.
        accelerations : array_like
            Pseudo-accelerations (n,) in `units`.
        units : str, optional
            Unit of the accelerations, such as "g".
        damping_ratio : float, optional
            Damping ratio of the spectrum.
        name : str, optional
            Name.

        Returns
        -------
        DesignSpectrum
            Spectrum.

        Raises
        ------
        InputError
            For fewer than two points, and for values that cannot be.
        """
        t = array_of("periods", periods)
        a = array_of("accelerations", accelerations) * factor(units)
        if t.ndim != 1 or t.shape != a.shape or len(t) < 2:
            raise InputError("periods").wrong(
                f"have the shape {t.shape} and accelerations {a.shape}: give two or more of each"
            )
        if not (np.isfinite(t).all() and t[0] >= 0.0 and (np.diff(t) > 0.0).all()):
            raise InputError("periods").wrong("do not rise from 0 or more: sort them, in s")
        if not (np.isfinite(a) & (a > 0.0)).all():
            raise InputError("accelerations", a).give("finite, positive numbers")
        xi = positive_number("damping_ratio", damping_ratio)
        shape = _Points(tuple(t.tolist()), tuple(a.tolist()))
        return cls(name, xi, float(t[0]), float(t[-1]), shape)

    # -- values

    def __call__(self, periods: ArrayLike) -> Any:
        """Pseudo-acceleration [m/s2] at periods [s], of their shape.

        Raises InputError for periods at which the spectrum is not defined.
        """
        t = array_of("periods", periods)
        outside = ~((t >= self.shortest) & (t <= self.longest))
        if outside.any():
            raise InputError("periods").says(
                f"{self.name} is defined from {self.shortest:g} to {self.longest:g} s, and not at "
                f"{t[outside].flat[-1]:g} s"
            )
        return self.shape(t)[()]

    def displacement(self, periods: ArrayLike) -> Any:
        """Displacement at periods: the pseudo-acceleration over omega^2.

        Parameters
        ----------
        periods : array_like
            Periods [s], any shape.

        Returns
        -------
        float or ndarray
            Displacement [m], in the shape of the periods.

        Raises
        ------
        InputError
            For periods for which the spectrum is not defined.
        """
        return self(periods) * (array_of("periods", periods) / (2.0 * np.pi)) ** 2

    # -- motions

    def compatible_motions(
        self,
        number: int,
        *,
        seed: int,
        duration: float = 25.0,
        dt: float = 0.01,
        envelope: Callable[[np.ndarray], ArrayLike] = _STRONG_PART,
        between: tuple[float, float] | None = None,
    ) -> MotionSet:
        """Artificial motions with this spectrum.

        Parameters
        ----------
        number : int
            Number of motions.
        seed : int
            Seed; the same one gives the same motions.
        duration : float, optional
            Duration of each [s].
        dt : float, optional
            Time step [s].
        envelope : callable, optional
            Function of times (n,) [s], such as `JenningsEnvelope`, that of the start; by default a
            rise of 3 s, 10 s of strong motion and a decay.
        between : tuple of (float, float), optional
            Shortest and longest period of the match [s], as for `matched`.

        Returns
        -------
        MotionSet
            Motions.

        Raises
        ------
        InputError
            As `matched`.

        Notes
        -----
        Each starts as noise with random phase angles (Gasparini and Vanmarcke 1976) and is
        `matched`. Where the mean of their peaks is below the spectrum at the period 0, one factor
        on all of them makes up for it.
        """
        n = round(positive_number("duration", duration) / positive_number("dt", dt)) + 1
        entropy, target = whole_number("seed", seed, 0), self._target(between)
        motions = []
        for i in range(whole_number("number", number, 1)):
            start = matching.noise(target, n, dt, np.random.default_rng([entropy, i]))
            start = start * factors(envelope, dt * np.arange(n))
            name = f"{self.name}, seed {entropy}, motion {i + 1}"
            made = GroundMotion.from_array(start, dt, name=name)
            random = replace(made, source=f"random phase angles, seed {entropy}")
            motions.append(replace(self._matched(random, target), name=name))
        least = 0.0 if self.shortest > 0.0 else float(self(0.0))
        return MotionSet((self._told(m, target) for m in _with_peaks(motions, least)), self.name)

    def matched(
        self, record: GroundMotion, *, between: tuple[float, float] | None = None
    ) -> GroundMotion:
        """Record to which wavelets were added that give it this spectrum.

        Parameters
        ----------
        record : GroundMotion
            Record with samples.
        between : tuple of (float, float), optional
            Shortest and longest period of the match [s]; from 0.04 to 4 s, or to the ends of the
            spectrum, if not given.

        Returns
        -------
        GroundMotion
            Record whose ``source`` has the largest differences of the result, at the oscillators
            and between them.

        Raises
        ------
        InputError
            For a motion without samples, for such coarse ones that they do not hold the shortest
            period, for a spectrum whose damping is not from 1 to 50 %, and where a difference of
            more than 25 % is left.

        Warns
        -----
        UserWarning
            For a ground that moves farther than any oscillator of the match.

        Notes
        -----
        The record is scaled by one factor first. The method is that of Al Atik and Abrahamson, with
        oscillators 6 % apart in period (at 5 % of damping), until these are within 7 %, or as near
        as they come in 15 rounds: some 10 % at 2 % of damping. Where the spectrum has a value at
        the period 0, peaks more than 5 % above it are cut before each round. A baseline of degree 5
        of the displacement is subtracted after it, and the ground is at rest in the end.

        References
        ----------
        Al Atik and Abrahamson (2010), Earthquake Spectra 26, 601-617.
        """
        require(isinstance(record, GroundMotion), "", "record", record, "give a GroundMotion")
        target = self._target(between)
        found = self._told(self._matched(record, target), target)
        is_vertical, origin = record.is_vertical, record.origin
        name = f"{record.name}, matched"
        return replace(found, name=name, is_vertical=is_vertical, origin=origin)

    def _matched(self, record: GroundMotion, target: matching.Target) -> GroundMotion:
        """The record as its wavelets make it, with its name and source."""
        if record.samples is None or record.dt is None:
            raise InputError("record", record).says(
                f"{record.name} has no samples to be matched: resampled(dt) gives it some"
            )
        first, last = float(target.periods[0]), float(target.periods[-1])
        if record.dt > 0.5 * first:
            raise InputError("record", record).says(
                f"the samples of {record.name} are {record.dt:g} s apart, too coarse for a period "
                f"of {first:g} s: give between=({2.0 * record.dt:g}, {last:g})"
            )
        own = record.response_spectrum(target.periods, self.damping_ratio).pseudo_acceleration
        require(bool((own > 0.0).all()), "", "record", record.name, "give a motion that shakes")
        scale = math.exp(float(np.log(target.accelerations / own).mean()))
        samples = matching.matched(record.samples * scale, record.dt, target)
        made = GroundMotion.from_array(samples, record.dt, name=record.name)
        return replace(made, source=record.source)

    def _told(self, motion: GroundMotion, target: matching.Target) -> GroundMotion:
        """A matched motion whose source tells its differences from the spectrum."""
        periods = target.periods
        finer = np.geomspace(periods[0], periods[-1], _FINER * (len(periods) - 1) + 1)
        finer[::_FINER] = periods
        spectrum = motion.response_spectrum(finer, self.damping_ratio)
        differences = np.abs(spectrum.pseudo_acceleration / self(finer) - 1.0)
        at, anywhere = float(differences[::_FINER].max()), float(differences.max())
        if not at <= _WORST_MATCH:
            raise InputError("record").says(
                f"{motion.name} differs by {100.0 * at:.0f} % from {self.name} after matching: "
                "give another record, or a narrower band by between="
            )
        largest = float(self.displacement(periods).max())
        if motion.peak_displacement > largest:
            warn_caller(
                f"{motion.name}: the ground moves by {motion.peak_displacement:.2g} m, and no "
                f"oscillator of the match by more than {largest:.2g} m: take another record or "
                "seed, or filter it and match it again",
            )
        within = f"within {100.0 * at:.0f} % at {len(periods)} periods, {100.0 * anywhere:.0f} % "
        within += f"between, from {periods[0]:.3g} to {periods[-1]:.3g} s"
        return replace(motion, source=f"{motion.source}, matched to {self.name} {within}")

    def _target(self, between: tuple[float, float] | None) -> matching.Target:
        """The spectrum at the periods of the match."""
        if between is None:
            between = max(0.04, self.shortest), min(4.0, self.longest)
        try:
            first, last = (positive_number("between", t) for t in between)
        except (TypeError, ValueError) as error:
            raise InputError("between", between).give("a shorter and a longer period") from error
        require(first < last, "", "between", first, f"give less than the second period, {last:g} s")
        least, most = _MATCHED
        if not least <= self.damping_ratio <= most:
            raise InputError("damping_ratio", self.damping_ratio).says(
                f"damping_ratio of {self.name} is {self.damping_ratio:g}: motions are matched to "
                f"spectra with {least:g} to {most:g}, make one with damping_ratio=0.05"
            )
        periods = matching.periods(first, last, self.damping_ratio)
        peak = math.inf if self.shortest > 0.0 else _PEAK * float(self(0.0))
        return matching.Target(periods, self(periods), self.damping_ratio, peak)

    # -- the check

    def check(self, motions: Iterable[GroundMotion], period: float) -> SpectrumCheck:
        """Check whether motions have this spectrum, by EN 1998-1:2004, 3.2.3.1.2(4).

        Parameters
        ----------
        motions : iterable of GroundMotion
            Horizontal motions.
        period : float
            Fundamental period T_1 of the structure [s]; for a structure that rocks, of the
            structure whose feet are held.

        Returns
        -------
        SpectrumCheck
            Comparison, which prints as text.

        Raises
        ------
        InputError
            For a spectrum that is not for 5 % damping, or is not defined at these periods or at the
            period 0.

        Notes
        -----
        From 0.2 T_1 to 2 T_1 the spectra are compared at 100 periods.
        """
        t_1 = positive_number("period", period)
        if self.damping_ratio != DAMPING:
            raise InputError("damping_ratio", self.damping_ratio).says(
                f"{self.name} is for {100.0 * self.damping_ratio:g} % damping, and the rule is one "
                "of spectra for 5 %: make it with damping_ratio=0.05"
            )
        if isinstance(motions, GroundMotion) or not isinstance(motions, Iterable):
            raise InputError("motions", motions).give("three ground motions or more")
        several = list(motions)
        for one in several:
            require(isinstance(one, GroundMotion), "", "motions", one, "give GroundMotions alone")
            require(not one.is_vertical, "", "motions", one.name, "give horizontal components")
        if not several:
            raise InputError("motions").says("there are no motions to check: give three or more")
        periods = np.geomspace(BAND[0] * t_1, BAND[1] * t_1, _CHECKED)
        spectra = [one.response_spectrum(periods, DAMPING).pseudo_acceleration for one in several]
        return SpectrumCheck(
            len(several),
            float(np.mean([one.peak for one in several])),
            float(self(0.0)),
            periods,
            np.mean(spectra, axis=0),
            self(periods),
        )


def _question(given: Acceleration, name: str, least: float, rule: str) -> None:
    """Warn of a number that is small in m/s2 and usual in g."""
    if not isinstance(given, str) and given < least:
        warn_caller(
            f'{name} is {given:g} m/s2, {rule}: was it meant in g? Then write "{given:g} g"'
        )


def _with_peaks(motions: list[GroundMotion], least: float) -> list[GroundMotion]:
    """The motions, times the factor above one that the mean of their peaks needs [m/s2]."""
    by = (1.0 + 1e-9) * least / float(np.mean([motion.peak for motion in motions]))
    if by <= 1.0:
        return motions
    return [
        replace(one.scaled(by), name=one.name, source=f"{one.source}, times {by:.4g}")
        for one in motions
    ]


@dataclass(frozen=True)
class _Branches:
    """A rise from zero, a plateau, a fall by 1/T from t_c and by 1/T**2 from t_d [m/s2, s]."""

    zero: float
    plateau: float
    t_b: float
    t_c: float
    t_d: float

    def __call__(self, t: np.ndarray) -> np.ndarray:
        rise = self.zero + (self.plateau - self.zero) * np.minimum(t / self.t_b, 1.0)
        fall = self.t_c / np.maximum(t, self.t_c) * self.t_d / np.maximum(t, self.t_d)
        return np.asarray(rise * fall)


@dataclass(frozen=True)
class _Points:
    """Points of a table, linear between them [s, m/s2]."""

    periods: tuple[float, ...]
    accelerations: tuple[float, ...]

    def __call__(self, t: np.ndarray) -> np.ndarray:
        return np.asarray(np.interp(t, self.periods, self.accelerations))
