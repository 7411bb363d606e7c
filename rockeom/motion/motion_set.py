"""`MotionSet`: ground motions that belong together, each with a name of its own."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from fnmatch import fnmatch
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from rockeom.files import in_text
from rockeom.motion import intensity as measured, library
from rockeom.motion.formats.text import OtherQuantityError
from rockeom.motion.ground_motion import GroundMotion, every_component, is_recognised
from rockeom.motion.recording import Recording
from rockeom.motion.recordings import by_name, chosen, recordings
from rockeom.motion.scaling import Acceleration, target
from rockeom.motion.spectra import ResponseSpectrum
from rockeom.motion.units import STANDARD_GRAVITY, acceleration
from rockeom.numbers import explained
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import (
    FilePath,
    InputError,
    described,
    in_template,
    near,
    positive_number,
    require,
)
from rockeom.numbers.pictures import picture

Intensity = str | Callable[[GroundMotion], float]

_OF_MOTION: dict[str, Callable[[GroundMotion], float]] = {
    "pga": lambda motion: motion.peak,
    "pgv": measured.peak_velocity,
    "pgd": measured.peak_displacement,
    "cav": measured.cumulative_absolute_velocity,
    "arias_intensity": measured.arias_intensity,
}
_NAMES = (*_OF_MOTION, "sa")

_MIDDLES: dict[str, Callable[[np.ndarray], float]] = {
    "median": lambda x: float(np.median(x)),
    "geometric mean": lambda x: float(np.exp(np.log(x).mean())),
}


@explained.attributes(motions="names", load="from_folder(path)", read="from_folder(path)")
@explained.calls(directory="path=", folder="path=")
class MotionSet(Sequence[GroundMotion]):
    """Ground motions in order, by number or by name.

    Parameters
    ----------
    motions : iterable of GroundMotion
        Motions, each with a name that no other has.
    name : str, optional
        Name of the set.

    Raises
    ------
    InputError
        For no motions, and for two of one name.

    Examples
    --------
    >>> import rockeom as rk
    >>> motions = rk.MotionSet(
    ...     rk.GroundMotion.kanai_tajimi(0.01, duration=8.0, seed=seed) for seed in range(3)
    ... )
    >>> len(motions), motions[0].duration
    (3, 8.0)
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> runs = rk.simulate_many(lambda motion: rk.Case(block, motion), over={"motion": motions})

    Records by name::

        motions = rk.MotionSet.from_library("far field").scaled_to("sa", 3.0, period=1.0)
        motions["Northridge, 1994, Beverly Hills - Mulhol, MUL009"]
    """

    def __init__(self, motions: Iterable[GroundMotion], name: str = "") -> None:
        if isinstance(motions, GroundMotion) or not isinstance(motions, Iterable):
            raise InputError("motions", motions).give("a list of motions")
        self._motions = tuple(motions)
        self.name = name
        if not self._motions:
            raise InputError("motions").says("a set of no motions: give one or more")
        for one in self._motions:
            require(isinstance(one, GroundMotion), "", "motions", one, "give GroundMotions alone")
        for given in self.names:
            if not given or self.names.count(given) > 1:
                raise InputError("motions", given).says(
                    f"{self.names.count(given)} motion(s) of a set have the name {given!r}: name "
                    "each once",
                    "dataclasses.replace(motion, name=...) gives another name",
                )

    @classmethod
    def from_folder(
        cls,
        path: FilePath,
        pattern: str | None = None,
        *,
        units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
        components: str = "horizontal",
        stated_peak: bool = True,
    ) -> MotionSet:
        """Records of a folder, all components of each file, named as the file is.

        Parameters
        ----------
        path : path_like
            Folder. Folders within it are not looked into.
        pattern : str, optional
            Pattern of the files' names, small and capital letters alike, such as ``*.txt`` or
            ``RSN*_H1.at2``; without one all accelerations of a network and of PEER, recognised by
            content, and a warning names the other files.
        units : str, optional
            Unit of the accelerations of all files, where these do not state it.
        gravity : float, optional
            Value of 1 g [m/s2].
        components : str, optional
            "horizontal", "vertical" or "all". A component is vertical if its header or the name of
            its file says so (UP, DWN, UD, U-D, U, V, VERT, Z, or a SEED code such as HNZ, with or
            without its location); a warning names those that "horizontal" leaves out.
        stated_peak : bool, optional
            Whether the peaks that headers state must be those of the values.

        Returns
        -------
        MotionSet
            Motions in the order of their names.

        Raises
        ------
        InputError
            Where no file has such a name or is of such a component, where two files give one
            component of a recording, and where one cannot be read: the message names all that
            cannot.

        Examples
        --------
        >>> import rockeom as rk
        >>> records = rk.MotionSet.from_folder("records")  # doctest: +SKIP
        """
        folder = Path(path)
        require(folder.is_dir(), "", "path", folder, "give a folder that holds records")
        files = sorted(p for p in folder.iterdir() if p.is_file() and p.name[0] != ".")
        wanted = _recognised(files) if pattern is None else _like(folder, files, pattern)
        read: dict[Path, list[GroundMotion]] = {}
        faults = []
        for file in wanted:
            try:
                read[file] = every_component(
                    file, units=units, gravity=gravity, stated_peak=stated_peak
                )
            except InputError as error:
                if pattern is not None or not isinstance(error, OtherQuantityError):
                    faults.append(error.in_words(in_template))
        if faults:
            text = f"{len(faults)} of {len(wanted)} files cannot be read, and none is left out"
            mend = "mend them, or name those that can be read"
            raise InputError("path", path).says(text).so("\n  ".join([mend, *faults]))
        if pattern is None:
            _tell_of_others(folder, files, read)
        kept = chosen(by_name(read), components, str(folder))
        return cls(kept.values(), in_text(folder).name)

    @classmethod
    def from_library(
        cls, words: str, *, normalized: bool = False, components: str = "horizontal"
    ) -> MotionSet:
        """Records whose names have all these words, see `GroundMotion.library`.

        Parameters
        ----------
        words : str
            Words of the names, such as one of the sets of FEMA P695 (2009): "far field" (44
            components), "near field pulse" and "near field no pulse" (28 each).
        normalized : bool, optional
            Whether each record is multiplied by the factor by which FEMA P695 evens out the peak
            velocities of a set (its Tables A-4D and A-6D).
        components : str, optional
            "horizontal", "vertical" or "all", as for `from_folder`.

        Returns
        -------
        MotionSet
            Motions.

        Raises
        ------
        InputError
            If none has the words, if no extra is installed, and where a record has no such factor.
        """
        read = {name: GroundMotion.from_library(name) for name in library.names(words)}
        kept = chosen(read, components, f"the library with the words {words!r}")
        motions = []
        for name, motion in kept.items():
            if normalized:
                stored = library.records()[name]
                factor = getattr(stored, "normalization", None)
                if factor is None:
                    raise InputError(name).wrong(
                        "is in no set of FEMA P695, which has factors: leave out normalized, or "
                        "give words of such a set"
                    )
                source = f"{motion.source}, normalized"
                motion = replace(motion.scaled(factor), name=motion.name, source=source)
            motions.append(motion)
        if len({one.name for one in motions}) < len(motions):  # of a station in two sets
            motions = [replace(m, name=n) for m, n in zip(motions, kept, strict=True)]
        return cls(motions, words)

    # -- what is in it

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the motions, in order."""
        return tuple(motion.name for motion in self._motions)

    def __len__(self) -> int:
        return len(self._motions)

    def __iter__(self) -> Iterator[GroundMotion]:
        return iter(self._motions)

    @overload
    def __getitem__(self, key: int | str) -> GroundMotion: ...

    @overload
    def __getitem__(self, key: slice) -> MotionSet: ...

    def __getitem__(self, key: int | str | slice) -> GroundMotion | MotionSet:
        """A motion by its number or name; a set of several by a slice."""
        if isinstance(key, slice):
            return MotionSet(self._motions[key], self.name)
        if not isinstance(key, str):
            if not -len(self) <= key < len(self):
                raise IndexError(f"no motion {key}: the set has {len(self)}, from 0 on")
            return self._motions[key]
        if key not in self.names:
            raise KeyError(
                f"no motion is called {key!r}{near(key, self.names)}; `names` lists them"
            )
        return self._motions[self.names.index(key)]

    def __contains__(self, one: object) -> bool:
        return one in self.names if isinstance(one, str) else one in self._motions

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MotionSet):
            return NotImplemented
        return (self.name, self._motions) == (other.name, other._motions)

    def __hash__(self) -> int:
        return hash((self.name, self._motions))

    def __repr__(self) -> str:
        shown = ", ".join(map(repr, self.names[:3])) + (", ..." if len(self) > 3 else "")
        return f"MotionSet({self.name!r}: {len(self)} motions, {shown})"

    def recordings(self) -> tuple[Recording, ...]:
        """Motions by recording: each has one horizontal component or two, and a vertical one.

        Returns
        -------
        tuple of Recording
            Recordings.

        Raises
        ------
        InputError
            For a vertical component without a horizontal one, for more components than three of one
            name, and for two azimuths that are not at right angles.

        Notes
        -----
        Files of networks state station and event. Else the name of a motion contains that of its
        recording, as databases name records: "I-ELC180" and "I-ELC-UP" belong to "I-ELC", and files
        of PEER with one RSN belong together. A set that was read with components="all" has the
        vertical components. Several instruments of a station, told apart by location and channel in
        SEED, are several recordings.

        Examples
        --------
        With a folder of records and a structure `block`::

            for recording in rk.MotionSet.from_folder("records", components="all").recordings():
                for pair in recording.in_plane():
                    rk.simulate(block, pair)
        """
        return recordings(self, self.name)

    # -- how strong it is

    def measures(self) -> dict[str, measured.Measures]:
        """Intensity measures of each motion by its name; see `GroundMotion.measures`.

        Returns
        -------
        dict of str to Measures
            Intensity measures by the name of the motion.
        """
        return {motion.name: motion.measures() for motion in self}

    def intensities(
        self, intensity: Intensity, *, period: float | None = None, damping_ratio: float = 0.05
    ) -> np.ndarray:
        """One intensity measure of each motion.

        Parameters
        ----------
        intensity : str or callable
            "pga" [m/s2], "pgv" [m/s], "pgd" [m], "cav" [m/s], "arias_intensity" [m/s], "sa", or a
            function of a motion. "sa" is the pseudo-acceleration of an oscillator [m/s2].
        period : float, optional
            Period of the oscillator [s].
        damping_ratio : float, optional
            Damping ratio of the oscillator.

        Returns
        -------
        ndarray
            Intensities (n,).

        Raises
        ------
        InputError
            For another word, and where a period is missing or of no use.
        """
        of = _function(intensity, period, damping_ratio)
        return np.array([of(motion) for motion in self])

    def scaled_to(
        self,
        intensity: Intensity | Acceleration | None = None,
        value: Acceleration | None = None,
        *,
        pga: Acceleration | None = None,
        sa: Acceleration | None = None,
        period: float | None = None,
        damping_ratio: float = 0.05,
        of: str = "each",
    ) -> MotionSet:
        """Motions with accelerations multiplied so that an intensity measure has a value.

        Parameters
        ----------
        intensity : str or callable or float or str, optional
            Intensity measure, as for `intensities`; a function must be proportional to the
            accelerations. A peak acceleration may stand alone.
        value : float or str, optional
            Value in the unit of the measure.
        pga : float or str, optional
            Peak acceleration, instead of these: a number [m/s2] or a text with its unit, as for
            `GroundMotion.scaled_to`.
        sa : float or str, optional
            Pseudo-acceleration, likewise.
        period : float, optional
            Period of the oscillator of "sa" [s].
        damping_ratio : float, optional
            Damping ratio of the oscillator.
        of : str, optional
            "each" scales every motion to the value; "recording" the components of each recording by
            one factor, so that the geometric mean of the horizontal ones has it; "median" and
            "geometric mean" multiply all by one factor, so that this of the set has it. Horizontal
            components count where there are any.

        Returns
        -------
        MotionSet
            Motions under the same names, so that each is compared with itself at another intensity;
            their ``source`` has the factor.

        Raises
        ------
        InputError
            For impossible arguments, where a motion has none of that intensity, where a function
            proves not to be proportional, and for "each" of a set that has vertical components
            among horizontal ones.

        Examples
        --------
        >>> import rockeom as rk
        >>> motions = rk.MotionSet(
        ...     rk.GroundMotion.kanai_tajimi(0.01, duration=8.0, seed=seed) for seed in range(3)
        ... )
        >>> motions.scaled_to(pga="0.4 g").intensities("pga").round(3)  # m/s2
        array([3.924, 3.924, 3.924])
        >>> together = motions.scaled_to(sa=3.0, period=1.0, of="geometric mean")  # m/s2, s
        >>> faster = motions.scaled_to("pgv", 0.5)  # m/s
        """
        intensity, wanted = _asked(intensity, value, pga, sa, period)
        measure = _function(intensity, period, damping_ratio)
        found = np.array([measure(motion) for motion in self])
        power = 0.5 if _word(intensity) == "arias_intensity" else 1.0
        factors = (wanted / self._reached(found, wanted, of)) ** power
        scaled = MotionSet(map(_times, self, factors.tolist()), self.name)
        if callable(intensity) and not np.isclose(
            measure(scaled[0]), found[0] * factors[0], rtol=1e-6, atol=0.0
        ):
            raise InputError("intensity").says(
                f"{described(intensity)} is {found[0]:g} of {self.names[0]}, and "
                f"{measure(scaled[0]):g} of {factors[0]:g} times that: give an intensity "
                "proportional to the accelerations"
            )
        return scaled

    def _reached(self, found: np.ndarray, wanted: float, of: str) -> np.ndarray:
        """The intensity (n,) that is to become the one wanted, for each motion; found : its own."""
        vertical = np.array([motion.is_vertical for motion in self])
        counts = ~vertical | vertical.all()
        for motion, one in zip(self, np.where(counts, found, wanted), strict=True):
            if not (np.isfinite(one) and one > 0.0):
                raise InputError("value", wanted).says(
                    f"{motion.name} has an intensity of {one:g}: no factor makes it {wanted:g}"
                )
        if of in _MIDDLES:
            return np.full(len(found), _MIDDLES[of](found[counts]))
        if of == "recording":
            by_name = dict(zip(self.names, found.tolist(), strict=True))
            reached: dict[str, float] = {}
            for recording in self.recordings():
                horizontal = [by_name[motion.name] for motion in recording.horizontal]
                mean = _MIDDLES["geometric mean"](np.array(horizontal))
                of_vertical = () if recording.vertical is None else (recording.vertical,)
                reached |= {one.name: mean for one in (*recording.horizontal, *of_vertical)}
            return np.array([reached[name] for name in self.names])
        if of != "each":
            words = ", ".join(("each", "recording", *_MIDDLES))
            raise InputError("of", of).so(f"choose one of {words}")
        if vertical.any() and not vertical.all():
            raise InputError("of").says(
                f"{self.names[int(vertical.argmax())]} is a vertical component, which is scaled "
                'along with its recording: give of="recording"'
            )
        return found

    def response_spectra(
        self, periods: ArrayLike | None = None, damping_ratio: float = 0.05
    ) -> dict[str, ResponseSpectrum]:
        """Elastic response spectrum of each motion by its name.

        Parameters
        ----------
        periods : array_like, optional
            Periods (n,) [s]; if not given, 100 from 0.02 to 10 s.
        damping_ratio : float, optional
            Damping ratio of the oscillators.

        Returns
        -------
        dict of str to ResponseSpectrum
            Spectra by the name of the motion.
        """
        return {motion.name: motion.response_spectrum(periods, damping_ratio) for motion in self}

    def plot(
        self, periods: ArrayLike | None = None, damping_ratio: float = 0.05, **kwargs: Any
    ) -> Any:
        """Draw the response spectra with their median; see `plots.plot_spectra`.

        Parameters
        ----------
        periods : array_like, optional
            Periods (n,) [s]; if not given, 100 from 0.02 to 10 s.
        damping_ratio : float, optional
            Damping ratio of the oscillators.
        **kwargs : object
            Further arguments of `plots.plot_spectra`.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.
        """
        spectra = [*self.response_spectra(periods, damping_ratio).values()]
        title = self.name and f"Response spectra, {self.name}"
        return picture("plot_spectra", spectra, **{"title": title} | kwargs)


def _times(motion: GroundMotion, factor: float) -> GroundMotion:
    source = f"{motion.source}, times {factor:.6g}"
    return replace(motion.scaled(factor), name=motion.name, source=source)


def _asked(
    intensity: Intensity | Acceleration | None,
    value: Acceleration | None,
    pga: Acceleration | None,
    sa: Acceleration | None,
    period: float | None,
) -> tuple[Intensity, float]:
    """The intensity measure that the arguments of `MotionSet.scaled_to` name, and its value."""
    word = _word(intensity)
    if not (callable(intensity) or word in _NAMES or value is not None):
        wanted = target(intensity, pga, sa, period)
        return wanted.intensity, wanted.value
    if pga is not None or sa is not None:
        raise InputError("intensity", intensity).so("there are two: give a word, pga or sa")
    measure: Any = intensity
    if word in ("pga", "sa"):
        value = acceleration("value", value)
    return measure, positive_number("value", value)


def _function(
    intensity: Intensity, period: float | None, damping_ratio: float
) -> Callable[[GroundMotion], float]:
    """The measure that a word, in small or capital letters, or a function stands for."""
    if callable(intensity):
        return intensity
    word = _word(intensity)
    if word not in _NAMES:
        hint = near(word, _NAMES)
        raise InputError("intensity", intensity).says(
            f"intensity {described(intensity)} is unknown{hint}: choose one of {', '.join(_NAMES)}"
            ", or give a function of a motion"
        )
    if word != "sa":
        if period is not None:
            raise InputError("period", period).so(f"{intensity} has none: leave it out, or give sa")
        return _OF_MOTION[word]
    if period is None:
        raise InputError("sa").wrong("needs the period of its oscillator [s]: give {period}")
    t = positive_number("period", period)
    return lambda motion: float(motion.response_spectrum(t, damping_ratio).pseudo_acceleration[0])


def _word(intensity: Any) -> str:
    return intensity.lower() if isinstance(intensity, str) else ""


def _like(folder: Path, files: list[Path], pattern: str) -> list[Path]:
    """Files whose names are like a pattern; InputError if there are none."""
    require(isinstance(pattern, str), "", "pattern", pattern, 'give a text, such as "*.at2"')
    wanted = [p for p in files if fnmatch(p.name.lower(), pattern.lower())]
    if not wanted:
        endings = ", ".join(sorted({p.suffix for p in files if p.suffix})) or "none at all"
        raise InputError("pattern", pattern).says(
            f"{folder} holds no file like {pattern!r} among {len(files)}: name the files "
            f"themselves; the endings are {endings}",
            "or give another pattern",
        )
    return wanted


def _recognised(files: list[Path]) -> list[Path]:
    """Files of a network or of PEER."""
    return [p for p in files if p.suffix.lower() == ".at2" or is_recognised(p)]


def _tell_of_others(folder: Path, files: list[Path], read: Collection[Path]) -> None:
    """A warning names the files that are not read; InputError if none is."""
    others = ", ".join(p.name for p in files if p not in read)
    if not read:
        raise InputError("path", folder).says(
            f"{folder} holds no accelerations of a network or of PEER among {len(files)} files"
            f"{f', {others}' * bool(others)}: name the files themselves",
            "or give pattern= and units= for columns of text",
        )
    if others:
        warn_caller(f"files of {folder} that are no accelerations of a network or PEER: {others}")
