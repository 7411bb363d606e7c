"""`Recording`: the components that one station recorded, scaled and turned together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.components import azimuth_and_vertical, name_of, split
from rockeom.motion.ground_motion import GroundMotion, every_component
from rockeom.motion.scaling import Acceleration, multiplier, target
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers import explained
from rockeom.numbers.checks import FilePath, InputError, InputTypeError, described, require_word

if TYPE_CHECKING:
    from rockeom.motion.spectra import ResponseSpectrum

_RIGHT_ANGLE = 10.0  # degrees by which the angle between two azimuths may differ from a right one
_SHORTER = 0.02  # part of the samples that one component may lack at its end
_HALF_TURN = 180
"""Directions of a horizontal component, a degree apart, of RotD50 and RotD100."""


@explained.record()
@dataclass(frozen=True)
class Recording:
    """Components that one station recorded in one earthquake.

    A plane structure is shaken by one horizontal component and the vertical one. `in_plane` gives
    these pairs, and a simulation, a case and a sweep take such a pair for a motion. A structure in
    space takes all three components, see `in_space`. All are scaled by one factor.

    Parameters
    ----------
    name : str
        Name of the records, without their components.
    horizontal : tuple of GroundMotion
        One motion, or two at right angles.
    vertical : GroundMotion, optional
        Vertical motion; None where there is no such component.

    Raises
    ------
    InputError
        For none or more than two horizontal components, and for anything but ground motions.

    Examples
    --------
    With three components of a station and a structure `block`::

        recording = rk.Recording("El Centro", (north_south, east_west), vertical)
        for pair in recording.scaled_to(pga="0.4 g").in_plane():
            rk.simulate(block, pair)
    """

    name: str
    horizontal: tuple[GroundMotion, ...]
    vertical: GroundMotion | None = None

    __array_ufunc__ = None  # so that a number of NumPy leaves the product to the recording

    def __post_init__(self) -> None:
        one = isinstance(self.horizontal, GroundMotion)
        if not (one or isinstance(self.horizontal, Iterable)):
            raise InputError("horizontal", self.horizontal).give("one ground motion or two")
        horizontal = (self.horizontal,) if one else tuple(self.horizontal)
        object.__setattr__(self, "horizontal", horizontal)
        for motion in (*horizontal, *(() if self.vertical is None else (self.vertical,))):
            if not isinstance(motion, GroundMotion):
                raise InputError("horizontal", motion).says(
                    f"the recording {self.name!r} has {described(motion)}: give ground motions"
                )
        if not 1 <= len(horizontal) <= 2:
            raise InputError("horizontal").says(
                f"the recording {self.name!r} has {len(horizontal)} horizontal components: give "
                "one or two"
            )

    @classmethod
    def read(
        cls,
        *paths: FilePath,
        units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
        stated_peak: bool = True,
    ) -> Recording:
        """All components of a station, from one file or from several.

        Parameters
        ----------
        *paths : path_like
            Files. :doc:`/how-to/network-files` lists the formats.
        units : str, optional
            Unit of the accelerations, where no file states it.
        gravity : float, optional
            Value of 1 g [m/s2].
        stated_peak : bool, optional
            Whether the peaks that headers state must be those of the values.

        Returns
        -------
        Recording
            Recording, named as the first file is.

        Raises
        ------
        InputError
            As `GroundMotion.read`, and for components that do not belong together.

        Examples
        --------
        >>> import rockeom as rk
        >>> recording = rk.Recording.read("CE89146.V1")  # doctest: +SKIP
        """
        if not paths or isinstance(paths[0], list | tuple):
            raise InputTypeError("paths", paths).give(
                "a file of a recording, or several, one after the other: Recording.read(a, b)"
            )
        motions = [
            one
            for path in paths
            for one in every_component(path, units=units, gravity=gravity, stated_peak=stated_peak)
        ]
        return recording_from(name_of(paths[0]), motions)

    @classmethod
    def from_library(cls, words: str) -> Recording:
        """All components of a station in the library, see `GroundMotion.library`.

        Parameters
        ----------
        words : str
            Words that the names of all its components have, and those of no other station.

        Returns
        -------
        Recording
            Recording, named by these words.

        Raises
        ------
        InputError
            If none has the words, for components of several stations, and if no extra is installed.

        Examples
        --------
        >>> import rockeom as rk
        >>> recording = rk.Recording.from_library("El Centro 1940")
        >>> len(recording.horizontal), recording.vertical.is_vertical
        (2, True)
        """
        from rockeom.motion import library  # with the readers of files

        return recording_from(words, [*map(GroundMotion.from_library, library.names(words))])

    def in_plane(self) -> tuple[Recording, ...]:
        """Recording for each horizontal component, with the vertical one.

        Returns
        -------
        tuple of Recording
            One recording or two.
        """
        if len(self.horizontal) == 1:
            return (self,)
        return tuple(Recording(one.name, (one,), self.vertical) for one in self.horizontal)

    def in_space(self) -> tuple[GroundMotion, GroundMotion]:
        """Horizontal components of a structure in space, the second counter-clockwise of the first.

        Returns
        -------
        tuple of (GroundMotion, GroundMotion)
            First component, and the one at a right angle from it, counter-clockwise seen from
            above.

        Raises
        ------
        InputError
            For one horizontal component, and for two that are not at right angles.

        Notes
        -----
        Networks count azimuths clockwise from north, and rockeom counter-clockwise from the first
        component. Here is the border: a second component that the azimuths of both put clockwise of
        the first one, as 270 after 180, is mirrored. Without azimuths in files or names it counts
        as counter-clockwise.

        Examples
        --------
        >>> import rockeom as rk
        >>> south, west = (
        ...     rk.GroundMotion.from_array([0.0, 1.0, 0.0], dt=0.1, name=f"X {azimuth}")  # m/s2, s
        ...     for azimuth in (180, 270)
        ... )
        >>> [motion.name for motion in rk.Recording("X", (south, west)).in_space()]
        ['X 180', '-X 270']
        """
        if len(self.horizontal) == 1:
            raise InputError("motion").says(
                f"the recording {self.name!r} has one horizontal component, and a structure in "
                "space takes two: add the other one; its horizontal[0] and vertical, as single "
                "motions, shake along one axis"
            )
        if fault := _fault_of_plane(self.horizontal):
            raise InputError("motion").says(
                f"the recording {self.name!r} has {fault}: give two at right angles"
            )
        first, second = self.horizontal
        at = _azimuth(first), _azimuth(second)
        if at[0] is not None and at[1] is not None and (at[1] - at[0]) % 360 < _HALF_TURN:
            second = -second
        return first, second

    def along(self, angle: float) -> Recording:
        """Horizontal component at an angle from the first, with the vertical one.

        Parameters
        ----------
        angle : float
            Angle from the first component towards the second [rad].

        Returns
        -------
        Recording
            Recording with one horizontal component.

        Raises
        ------
        InputError
            Where there is one horizontal component only.

        Notes
        -----
        A component that is up to 2 % shorter than the other gets zeros at its end, as the name of
        the result says.
        """
        if len(self.horizontal) == 1:
            raise InputError("horizontal").says(
                f"the recording {self.name!r} has one horizontal component: two have others between"
            )
        one, other = self._of_one_length()
        turned = one.rotated(other, angle)
        return Recording(turned.name, (turned,), self.vertical)

    def _of_one_length(self) -> list[GroundMotion]:
        """The horizontal components; zeros follow one that is a little shorter than the other."""
        longest = max(self.horizontal, key=lambda one: one.duration)
        return [_as_long_as(longest, one) for one in self.horizontal]

    # -- scaled

    def scaled(self, acceleration: float = 1.0, time: float = 1.0) -> Recording:
        """All components with accelerations and times multiplied, as by `GroundMotion.scaled`.

        Parameters
        ----------
        acceleration : float, optional
            Factor of the accelerations.
        time : float, optional
            Factor of the times.

        Returns
        -------
        Recording
            Scaled recording.
        """
        horizontal = tuple(motion.scaled(acceleration, time) for motion in self.horizontal)
        vertical = None if self.vertical is None else self.vertical.scaled(acceleration, time)
        return replace(self, horizontal=horizontal, vertical=vertical)

    def scaled_to(
        self,
        peak: Acceleration | None = None,
        *,
        pga: Acceleration | None = None,
        sa: Acceleration | None = None,
        period: float | None = None,
        damping_ratio: float = 0.05,
        of: str = "geometric mean",
    ) -> Recording:
        """All components by one factor, so that the horizontal intensity has a value.

        Exactly one of peak, pga and sa is needed, a number [m/s2] or a text with its unit.

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
        of : str, optional
            Intensity of both components, as for `response_spectrum`.

        Returns
        -------
        Recording
            Scaled recording.

        Raises
        ------
        InputError
            As `GroundMotion.scaled_to` and `response_spectrum`.
        """
        wanted = target(peak, pga, sa, period)
        if wanted.period is None:
            (found,) = self._combined(of, lambda motion: np.array([motion.peak]))
        else:
            spectrum = self.response_spectrum(wanted.period, damping_ratio, of)
            (found,) = spectrum.pseudo_acceleration
        if found == 0.0 and any(motion.peak for motion in self.horizontal):
            raise InputError("of", of, self.name).says(
                f"the {of} of its horizontal components is zero, since one does not shake: give "
                "one that does, or leave the recording out",
                'scaled_to(..., of="larger") scales by the other one',
            )
        if found == 0.0:
            raise InputError("pga", of=self.name).says(
                "no factor makes a recording without shaking shake"
            )
        return self.scaled(wanted.value / found)

    def __mul__(self, factor: float) -> Recording:
        """All components with their accelerations multiplied by a number."""
        return self.scaled(multiplier(factor))

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Recording:
        """All components with their accelerations divided by a number."""
        return self.scaled(1.0 / multiplier(divisor, "divided"))

    # -- how strong it is

    def response_spectrum(
        self, periods: ArrayLike, damping_ratio: float = 0.05, of: str = "geometric mean"
    ) -> ResponseSpectrum:
        """Elastic response spectrum of the horizontal components together.

        Parameters
        ----------
        periods : array_like
            Periods (n,) [s].
        damping_ratio : float, optional
            Damping ratio of the oscillators.
        of : str, optional
            "geometric mean", "larger" or "srss" (the root of the sum of squares) of both; "rotd50"
            and "rotd100", the median and the largest value of all components in directions a degree
            apart, which takes as long as 180 components do; of components as of `along`.

        Returns
        -------
        ResponseSpectrum
            Spectrum. Each is the spectrum itself where there is one component.

        Raises
        ------
        InputError
            For another word.

        References
        ----------
        Boore (2010), Bulletin of the Seismological Society of America 100, 1830-1835.
        """
        spectra: list[ResponseSpectrum] = []

        def largest(motion: GroundMotion) -> np.ndarray:
            spectra.append(motion.response_spectrum(periods, damping_ratio))
            one = spectra[-1]
            return np.array([one.displacement, one.velocity, one.acceleration])

        u, v, a = self._combined(of, largest)
        name = f"{self.name}, {of}"
        if of.startswith("rotd"):
            longer = (one.name for one in self._of_one_length() if one not in self.horizontal)
            name = ", ".join([name, *longer])
        return replace(spectra[0], displacement=u, velocity=v, acceleration=a, name=name)

    def _combined(self, of: str, measure: Callable[[GroundMotion], np.ndarray]) -> np.ndarray:
        """A measure of both horizontal components together."""
        require_word("of", of, _COMBINED)
        components = self.horizontal
        if len(components) == 2 and of.startswith("rotd"):
            turns = np.radians(np.arange(_HALF_TURN)).tolist()
            components = tuple(self.along(turn).horizontal[0] for turn in turns)
        return _COMBINED[of](np.array([measure(one) for one in components]))


def _as_long_as(longest: GroundMotion, one: GroundMotion) -> GroundMotion:
    a, b = one.samples, longest.samples
    if a is None or b is None or one.dt is None or one.dt != longest.dt:
        return one
    lacks = len(b) - len(a)
    if not 0 < lacks <= _SHORTER * len(b):
        return one
    longer = GroundMotion.from_array(np.pad(a, (0, lacks)), one.dt)
    return replace(longer, name=f"{one.name}, {lacks} zeros at its end", source=one.source)


_COMBINED: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "geometric mean": lambda x: np.prod(x, axis=0) ** (1.0 / len(x)),
    "larger": partial(np.max, axis=0),
    "srss": lambda x: np.sqrt(np.square(x).sum(axis=0)),
    "rotd50": partial(np.median, axis=0),
    "rotd100": partial(np.max, axis=0),
}


def recording_from(name: str, group: Sequence[GroundMotion]) -> Recording:
    """The recording with these components; raises InputError for what is none."""
    _check_origins(group)
    horizontal = tuple(motion for motion in group if not motion.is_vertical)
    vertical = [motion for motion in group if motion.is_vertical]
    members = ", ".join(motion.name for motion in group)
    if not horizontal:
        raise InputError("components").says(
            f"{members} has no horizontal component in this set: add its horizontal ones, read the "
            'set with {components:"all"}, or leave it out'
        )
    fault = _fault_of_plane(horizontal)
    if len(horizontal) > 2 or len(vertical) > 1:
        fault = f"{len(horizontal)} horizontal and {len(vertical)} vertical components"
    if fault:
        refusal = f"the recording {name!r} has {fault}: {members}"
        if group[0].origin is not None:
            raise InputError("motions").says(
                f"{refusal}. Give the files of one sensor and of one stage of processing",
                "GroundMotion.read(path, component=...) takes one of many components",
            )
        raise InputError("motions").says(
            f'{refusal}. Name the motions by recording and component, as in "ELC-180"',
            "dataclasses.replace(motion, name=...) gives another name",
        )
    return Recording(name, horizontal, vertical[0] if vertical else None)


def _check_origins(group: Sequence[GroundMotion]) -> None:
    """Raise InputError for components of several recordings, stages of processing, or steps."""
    origins = [motion.origin for motion in group if motion.origin is not None]
    names = sorted({_recording_of(motion) for motion in group} - {""})
    if 0 < len(origins) < len(group):
        names = sorted({_recording_of(motion) or motion.name for motion in group})
    if len(names) > 1:
        raise InputError("paths").says(
            f"the components are of several recordings, {'; '.join(names)}: give those of one "
            "station, instrument and earthquake"
        )
    stages = sorted({origin.stage for origin in origins})
    steps = sorted({f"{motion.dt:g} s" for motion in group if origins})
    for what, several in (("stages of processing", stages), ("time steps", steps)):
        if len(several) > 1:
            raise InputError("paths").says(
                f"the components of {names[0]} are of several {what}, {'; '.join(several)}: give "
                "the files of one"
            )


def _recording_of(motion: GroundMotion) -> str:
    """The recording of a component by its file, or by its name if it is of no network."""
    if motion.origin is not None:
        return motion.origin.recording
    name, component = split(motion.name)
    return name if component else ""


def _fault_of_plane(horizontal: Sequence[GroundMotion]) -> str:
    """Why two horizontal components span no plane; empty where they may."""
    if len(horizontal) != 2:
        return ""
    one, other = horizontal
    at = [azimuth for azimuth in map(_azimuth, horizontal) if azimuth is not None]
    if len(at) == 2 and abs((at[0] - at[1]) % 180 - 90) > _RIGHT_ANGLE:
        return "two components at no right angle"
    named = {motion.origin.component for motion in horizontal if motion.origin is not None}
    return "one component twice" if one == other or len(named) == 1 else ""


def _azimuth(motion: GroundMotion) -> float | None:
    """Azimuth of a record [degrees], by its file, or by its name if it is of no network.

    A motion with the other sign, as of `-motion`, has the opposite one.
    """
    if motion.origin is not None:
        at = motion.origin.azimuth
    else:
        title = motion.source.partition(_TITLE)[2].split(",")
        name = "" if _TURNED in motion.name else motion.name
        names = split(name)[1], *reversed(title)
        found = (azimuth_and_vertical(name)[0] for name in names)
        at = next((one for one in found if one is not None), None)
    return at if at is None else (at + _HALF_TURN * (motion.name[:1] == "-")) % 360


_TURNED = " degrees from "
"""In the name of a motion between two, see `GroundMotion.rotated`, whose azimuths it has not."""
_TITLE = "line 2: "
"""In front of the title of a record of PEER, whose last field is its component."""
