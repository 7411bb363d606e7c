"""The ground motions of a command: files, pulses, records of the library, and their scale."""

import argparse
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from rockeom.cli.errors import UsageError, spread, words
from rockeom.cli.text.options import add_number, add_words
from rockeom.integrator.schema import in_space
from rockeom.motion import GroundMotion, MotionSet, units
from rockeom.motion.ground_motion import every_component
from rockeom.motion.recording import Recording
from rockeom.motion.recordings import COMPONENTS, by_name, chosen
from rockeom.numbers.checks import InputError, near, positive_number
from rockeom.structures.base import Structure
from rockeom.structures.parameters import check_names

PULSES: dict[str, tuple[Callable[..., GroundMotion], set[str], set[str]]] = {
    "constant": (GroundMotion.constant, {"acceleration", "duration"}, {"total_duration"}),
    "half-sine": (GroundMotion.half_sine, {"amplitude", "period"}, {"duration"}),
    "single-sine": (GroundMotion.single_sine, {"amplitude", "period"}, {"duration"}),
    "single-cosine": (GroundMotion.single_cosine, {"amplitude", "period"}, {"duration"}),
    "ricker": (GroundMotion.ricker, {"amplitude", "period"}, {"duration"}),
    "antisymmetric-ricker": (
        lambda **values: GroundMotion.ricker(antisymmetric=True, **values),
        {"amplitude", "period"},
        {"duration"},
    ),
    "harmonic": (
        GroundMotion.harmonic,
        {"amplitude", "duration"},
        {"frequency", "angular_frequency", "period", "phase"},
    ),
}
"""Maker, required and optional numbers of each pulse."""


SETS = """\
sets of records (extras records and fema), by words that all their names have:
  far field, near field pulse, near field no pulse: those of FEMA P695
  El Centro 1940: both horizontal components; a line names the vertical one, which is left out
  `rockeom records WORD ...` lists what some words find
"""
"""Help for the sets that the options of `add_records` name."""


def add_motion(group, required: bool = True) -> None:
    """The options that `motions` reads."""
    one = group.add_mutually_exclusive_group(required=required)
    one.add_argument(
        "--motion", nargs="+", metavar="FILE",
        help="a recorded acceleration: a file of a network, PEER .AT2, or two columns; in space "
        "all its components, or the files of all: x, y, upwards",
    )  # fmt: skip
    add_words(one, "--pulse", ("KIND", "NAME=VALUE"), "a pulse by formula, see below")
    add_words(
        one,
        "--record",
        "WORD",
        "a record of the library by words of its name, as El Centro 1940 180, in space a recording "
        "by those of all its components; `rockeom records` lists all",
    )
    one.add_argument("--free", action="store_true", help="no shaking; needs --duration")
    group.add_argument("--vertical", metavar="FILE", help="vertical acceleration, scaled alike")
    add_component(group)
    add_files(group)
    add_scale(group)


def add_records(parser: argparse.ArgumentParser) -> Any:
    """The options that `records` reads; returns their group."""
    group = parser.add_argument_group("ground motions (one of the first two)")
    one = group.add_mutually_exclusive_group(required=True)
    add_words(one, "--records", "WORD", "all records whose names have these words")
    add_words(one, "--motion", "FILE", "recorded accelerations, or one folder of them")
    group.add_argument(
        "--components",
        choices=COMPONENTS,
        help="of records by words, of a folder, of files of several; horizontal if not given, of "
        "structures in space all",
    )
    add_component(group)
    add_files(group)
    return group


def add_component(group) -> None:
    """The option that `from_file` reads where a file holds several components."""
    group.add_argument(
        "--component",
        metavar="NAME",
        help="of a --motion file of several: name, azimuth [degrees], or number from 1 on",
    )


def add_files(group) -> None:
    """The options that `from_file` reads."""
    group.add_argument(
        "--units",
        metavar="UNITS",
        help="of a file that does not say its own: m/s2, g, cm/s2, gal, mm/s2, in/s2, ft/s2",
    )
    add_words(
        group,
        "--columns",
        "COLUMN",
        "time and acceleration in a file of more columns, by heading or number from 0; with "
        "--dt that of the acceleration alone",
    )
    add_number(group, "--dt", "S", "time step of a file without a column of times [s]")
    group.add_argument(
        "--layout",
        choices=("columns", "wrapped"),
        help="with --dt: wrapped, if the values of the file run on from one column to the next",
    )


def add_scale(group) -> None:
    """The options that `scaled` reads."""
    size = group.add_mutually_exclusive_group()
    add_number(size, "--acceleration-scale", "X", "multiply accelerations by X")
    size.add_argument(
        "--pga", metavar="A", help="scale to this largest acceleration: 0.4g, or in m/s2"
    )
    size.add_argument(
        "--sa", metavar="A", help="scale to this spectral acceleration at --period, 5 %% damped"
    )
    add_number(group, "--period", "S", "of --sa [s]")
    add_number(group, "--time-scale", "X", "multiply times by X", default=1.0)


def motions(args: argparse.Namespace) -> tuple[GroundMotion, GroundMotion | None]:
    """The horizontal and the vertical motion, both scaled alike."""
    if args.motion is None and args.vertical is None:
        _check_no_files(args)
    motion = _horizontal(args)
    factor = _factor(motion, args)
    vertical = None if args.vertical is None else _vertical(args.vertical, args)
    return _times(motion, factor, args), vertical and _times(vertical, factor, args)


def shaking(
    args: argparse.Namespace,
) -> tuple[GroundMotion | Recording, GroundMotion | None]:
    """The same of a structure in space: all components of a recording, or one, and a vertical one.

    All are scaled alike, recordings by the geometric mean of both horizontal components.
    """
    one = _recording(args)
    if one is None or (one.vertical is None and len(one.horizontal) == 1):
        args.motion = args.motion and args.motion[:1]
        return motions(args)
    if args.vertical is not None:
        raise UsageError(
            f"--vertical {args.vertical}: {one.name} has several components: leave it out"
        )
    timed, factor = one.scaled(time=args.time_scale), _factor(one.horizontal[0], args)
    if args.pga is None and args.sa is None:
        return timed.scaled(factor), None
    option, wanted = ("--pga", args.pga) if args.sa is None else ("--sa", args.sa)
    asked: Any = {option[2:]: acceleration(wanted, option), "period": args.period}
    return timed.scaled_to(**asked), None


def _recording(args: argparse.Namespace) -> Recording | None:
    """The components that the options name; None for one alone, and for a pulse."""
    if args.record is not None:
        _check_no_files(args)
        return Recording.from_library(" ".join(args.record))
    if args.motion is None or args.component is not None:
        return None
    if not _of_columns(args):
        return Recording.read(*args.motion, units=args.units)
    if len(args.motion) > 3:
        raise UsageError(f"--motion has {len(args.motion)} files: name those of x, y and upwards")
    read = [from_file(path, args) for path in args.motion]
    return Recording(read[0].name, tuple(read[:2]), *read[2:])


def scaled(motion: GroundMotion, args: argparse.Namespace) -> GroundMotion:
    """The motion as the options of `add_scale` say."""
    return _times(motion, _factor(motion, args), args)


def _times(motion: GroundMotion, factor: float, args: argparse.Namespace) -> GroundMotion:
    if (factor, args.time_scale) == (1.0, 1.0):
        return motion
    return motion.scaled(acceleration=factor, time=args.time_scale)


def _factor(motion: GroundMotion, args: argparse.Namespace) -> float:
    """The factor of accelerations by which the motion, its time scaled, has the intensity asked."""
    if (args.sa is None) != (args.period is None):
        raise UsageError("--sa and --period belong together, as in --sa 0.4g --period 1.0")
    if args.pga is None and args.sa is None:
        return 1.0 if args.acceleration_scale is None else args.acceleration_scale
    option, text = ("--sa", args.sa) if args.pga is None else ("--pga", args.pga)
    wanted = acceleration(text, option)
    if not motion.peak:
        raise UsageError(f"{option} {text}: there is no acceleration to scale")
    if args.pga is not None:
        return wanted / motion.peak
    period = positive_number("period", args.period)
    spectrum = _times(motion, 1.0, args).response_spectrum([period])
    return wanted / float(spectrum.pseudo_acceleration[0])


def acceleration(text: str, option: str) -> float:
    """The acceleration [m/s2] that "2.5", "0.4g" or "0.4 g" says.

    Raises InputError for another text, and for what is not positive and finite.
    """
    try:
        value = float(text)
    except ValueError:
        value = units.acceleration(option, text)
    return positive_number(option, value)


def accelerations(texts: Sequence[str], option: str) -> list[float]:
    """Accelerations [m/s2], such as "0.2g", "0.4g", or "0.1g:1.0g:10", ten of them.

    Raises InputError as `acceleration`.
    """
    read = partial(acceleration, option=option)
    example = f"{option} 0.1g:1.0g:10 or {option} 0.2g 0.4g 0.8g"
    return [x for one in texts for x in spread(one, f"{option} {one}", example, read)]


def records_for(structure: Structure, args: argparse.Namespace) -> Sequence[Any]:
    """The motions of the options of `add_records`; recordings of a structure in space."""
    if not in_space(structure.module):
        return records(args)
    if args.component is None:
        args.components = args.components or "all"
    return records(args).recordings()


def records(args: argparse.Namespace) -> MotionSet:
    """The motions of the options of `add_records`, as they were recorded."""
    if args.records is not None:
        _check_no_files(args)
        words = " ".join(args.records)
        return MotionSet.from_library(words, components=args.components or "horizontal")
    if len(args.motion) == 1 and Path(args.motion[0]).is_dir():
        return _of_folder(args.motion[0], args)
    if twice := [path for path in args.motion if args.motion.count(path) > 1]:
        raise UsageError(f"--motion has {twice[0]} {len(twice)} times: name each once")
    motions = by_name({Path(path): _components(path, args) for path in args.motion})
    return MotionSet(motions.values(), "files")


def _components(path: str, args: argparse.Namespace) -> list[GroundMotion]:
    """The motion of a file, or of a file of several components those of --components."""
    if args.component is not None and args.components is not None:
        raise UsageError("--component and --components: one of both says what is read of a file")
    if _of_columns(args) or args.component is not None:
        return [from_file(path, args)]
    found = {one.name: one for one in every_component(path, units=args.units)}
    if len(found) == 1 and args.components is None:
        return list(found.values())
    return list(chosen(found, args.components or "horizontal", path).values())


def _of_columns(args: argparse.Namespace) -> bool:
    """Whether options say in which columns of a file the motion is."""
    return args.columns is not None or args.dt is not None or args.layout is not None


def _vertical(path: str, args: argparse.Namespace) -> GroundMotion:
    """The motion of a file, or the vertical one of a file of several components."""
    if _of_columns(args):
        return from_file(path, args)
    found = every_component(path, units=args.units)
    upward = [one for one in found if one.is_vertical] if len(found) > 1 else found
    if len(upward) != 1:
        names = ", ".join(one.name for one in found)
        raise UsageError(
            f"--vertical {path}: {len(upward)} of {names} are vertical: give a file of one"
        )
    return upward[0]


def _of_folder(path: str, args: argparse.Namespace) -> MotionSet:
    for option in ("columns", "dt", "layout", "component"):
        if getattr(args, option) is not None:
            raise UsageError(f"--{option} is for files: name them, as {path}/*.txt")
    components = args.components or "horizontal"
    try:
        return MotionSet.from_folder(path, units=args.units, components=components)
    except InputError as error:
        if error.argument != "path" or "\n" in error.remedy:
            raise
        columns = f"--motion {path}/*.txt --units g reads columns of text"
        raise error.so(f"{error.remedy}; {columns}") from None


def from_file(path: str, args: argparse.Namespace) -> GroundMotion:
    """A record by the options of `add_files`."""
    if args.layout is not None and args.dt is None:
        raise UsageError(f"--layout {args.layout} needs --dt, the time step of the file")
    if args.columns is None and args.dt is None:
        component = getattr(args, "component", None)
        return GroundMotion.read(path, units=args.units, component=component)
    columns = [int(c) if c.isdecimal() else c for c in args.columns or ()]
    if (args.dt is None and len(columns) != 2) or len(columns) > 2 - (args.dt is not None):
        raise UsageError(
            f"--columns {' '.join(map(str, columns))}: name two, those of time and acceleration, "
            "or with --dt one, that of the acceleration"
        )
    time = None if args.dt is not None else columns[0]
    return GroundMotion.from_csv(
        path,
        time_column=time,
        acceleration_column=columns[-1] if columns else None,
        dt=args.dt,
        units=args.units,
        layout=args.layout,
    )


def _check_no_files(args: argparse.Namespace) -> None:
    """Raise InputError for options that say how to read a file, where there is none."""
    for option in ("units", "columns", "dt", "layout", "component"):
        if getattr(args, option) is not None:
            raise UsageError(f"--{option} is for a file: leave it out, or give --motion FILE")


def _horizontal(args: argparse.Namespace) -> GroundMotion:
    if args.motion is not None:
        if len(args.motion) > 1:
            raise UsageError(f"--motion has {len(args.motion)} files: in a plane one is horizontal")
        return from_file(args.motion[0], args)
    if args.record is not None:
        return GroundMotion.from_library(" ".join(args.record))
    if args.free:
        if args.duration is None:
            raise UsageError("--free needs --duration, the time to follow [s]")
        return GroundMotion.none(args.duration)
    return pulse(*args.pulse)


def pulse(kind: str, *pairs: str) -> GroundMotion:
    """The pulse that "single-sine", "amplitude=4", "period=0.5" name.

    Raises InputError for an unknown kind and for what is no number, InputTypeError for missing
    and unknown names.
    """
    if kind not in PULSES:
        raise UsageError(f"--pulse {kind}{near(kind, PULSES)}: there are {', '.join(PULSES)}")
    make, required, optional = PULSES[kind]
    given = words(list(pairs), "--pulse", f"{kind} amplitude=4 period=0.5")
    check_names(f"--pulse {kind}", required, required | optional, given)
    numbers = {name: _of_pulse(name, text) for name, text in given.items()}
    try:
        return make(**numbers)
    except InputError as error:
        raise UsageError(f"--pulse {kind}: {error}") from None


def _of_pulse(name: str, text: str) -> float:
    """A number of a pulse; that of an acceleration may have its unit, as amplitude=0.3g."""
    try:
        return float(text)
    except ValueError:
        if name in ("amplitude", "acceleration"):
            return float(units.acceleration(name, text))
        said = f"--pulse {name}={text}"
        raise UsageError(f"{said}: {text!r} is no number; write it without a unit") from None
