"""``rockeom fragility``: the probability of overturning against the intensity of records."""

from __future__ import annotations

import argparse
import csv
import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from rockeom.analysis.risk.fragility import Fragility, fragility_of
from rockeom.analysis.sweeps import FALLS, STANDS, outcome_labels, peaks_of
from rockeom.cli.errors import UsageError
from rockeom.cli.models import add_structure, made
from rockeom.cli.motions import SETS, accelerations, add_records, records
from rockeom.cli.simulate import check_folder, impact_law
from rockeom.drawing.style import save_figure
from rockeom.files import write
from rockeom.motion import GroundMotion
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.plots.sweeps import fragility_curve
from rockeom.simulation.case import Case
from rockeom.sweeps.run import simulate_many

DESCRIPTION = """\
Scale each record of a set to several intensities, simulate all, and fit the probability that the
structure overturns, or that a demand reaches a limit, against the intensity: a lognormal fragility
curve of maximum likelihood. With --out, write the curve as a table and a picture.
"""
_USAGE = """\
rockeom fragility NAME --set PARAMETER=VALUE ... (--records WORD ... | --motion FILE ...)
         (--pga VALUES | --sa VALUES --period S) [--demand NAME --limit X] [--impact LAW]
         [--out DIR] [more options, see --help]
"""
EPILOG = f"""\
{SETS}
examples:
  rockeom fragility rigid_block --set half_width=0.25 half_height=1.0 --records far field \\
      --pga 0.1g:1.0g:10 --out block
  rockeom fragility rigid_block --set half_width=0.25 half_height=1.0 --motion records/ \\
      --sa 0.1g 0.2g 0.4g 0.8g --period 1.0
  rockeom fragility rigid_block --set half_width=0.25 half_height=1.0 --records far field \\
      --pga 0.1g:0.6g:6 --demand theta --limit 0.05
"""
_LEVELS = "0.1g:1.0g:10, ten from 0.1 to 1.0 g, or 0.2g 0.4g 0.8g; numbers alone are m/s2"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_structure(parser)
    parser.add_argument("--impact", metavar="LAW", help="as for rockeom simulate")
    parser.add_argument("--duration", type=float, metavar="S", help="of each simulation [s]")
    add_records(parser)
    intensity = parser.add_argument_group("intensities (one of the first two)")
    one = intensity.add_mutually_exclusive_group(required=True)
    one.add_argument("--pga", nargs="+", metavar="VALUES", help=f"largest accelerations: {_LEVELS}")
    one.add_argument(
        "--sa",
        nargs="+",
        metavar="VALUES",
        help="spectral accelerations at --period, 5 %% damped, alike",
    )
    intensity.add_argument("--period", type=float, metavar="S", help="of --sa [s]")
    limit = parser.add_argument_group("limit; overturning if not given")
    limit.add_argument("--demand", metavar="NAME", help="a state whose largest size is limited")
    limit.add_argument("--limit", type=float, metavar="X", help="of --demand, in its unit")
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="write fragility.csv and .png into this folder"
    )


class Intensity(NamedTuple):
    """The measure that records are scaled to, and its values [g].

    scaled : a motion scaled to a value [m/s2].
    """

    name: str
    meaning: str
    values: list[float]
    scaled: Callable[[GroundMotion, float], GroundMotion]


def run(args: argparse.Namespace) -> int:
    structure, law, intensity = made(args), impact_law(args.impact), _intensity(args)
    if (args.demand is None) != (args.limit is None):
        raise UsageError("--demand and --limit belong together, as in --demand theta --limit 0.05")
    if args.limit is not None and not args.limit > 0.0:
        raise UsageError(f"--limit {args.limit:g}: give a positive number, a largest size")
    if args.demand not in (None, *structure.states):
        raise UsageError(f"--demand {args.demand}: there are {', '.join(structure.states)}")
    if args.out is not None:
        check_folder(args.out)
    motions = {motion.name: motion for motion in records(args)}

    def case(record: str, **level: float) -> Case:
        motion = intensity.scaled(motions[record], level[intensity.name] * STANDARD_GRAVITY)
        return Case(structure, motion, law, duration=args.duration)

    about = {"units": "g", "long_name": intensity.meaning}
    levels = xr.DataArray(intensity.values, dims=intensity.name, attrs=about)
    print(f"simulating {len(levels) * len(motions)} motions ...", file=sys.stderr)
    sweep = simulate_many(case, over={intensity.name: levels, "record": list(motions)})
    print(_observed(sweep, args, intensity))
    try:
        curve = fragility_of(sweep, intensity=intensity.name, demand=args.demand, limit=args.limit)
    except ValueError as error:
        said = str(error).removeprefix("fit_fragility: ").replace("intensities", "values")
        raise UsageError(f"no curve fits these observations: {said} (--{intensity.name})") from None
    print(_fitted(curve))
    if args.out is not None:
        for path in _write(sweep, curve, intensity, args):
            print(f"wrote {path}")
    return 0


def _intensity(args: argparse.Namespace) -> Intensity:
    if (args.sa is None) != (args.period is None):
        raise UsageError("--sa and --period belong together, as in --sa 0.2g 0.4g --period 1.0")
    name = "pga" if args.sa is None else "sa"
    given, option = getattr(args, name), f"--{name}"
    values = [x / STANDARD_GRAVITY for x in accelerations(given, option)]
    if not 1 < len({*values}) == len(values):
        raise UsageError(f"{option} {' '.join(given)}: give two values or more, each once")
    if name == "pga":
        return Intensity(
            name, "peak ground acceleration", values, lambda motion, x: motion.scaled_to(pga=x)
        )
    return Intensity(
        name,
        f"spectral acceleration at {args.period:g} s",
        values,
        lambda motion, x: motion.scaled_to(sa=x, period=args.period),
    )


def _observed(sweep: xr.Dataset, args: argparse.Namespace, intensity: Intensity) -> str:
    """How many records exceed the limit at each intensity."""
    what = "overturned" if args.demand is None else f"reached {args.demand} = {args.limit:g}"
    exceeded, number = _counts(sweep, args)
    lines = [
        f"{args.name} under {sweep.sizes['record']} records, each scaled to "
        f"{len(intensity.values)} values of {intensity.meaning}:"
    ]
    lines += [
        f"  {level:6.3g} g: {hits:3d} of {of} {what}"
        for level, hits, of in zip(intensity.values, exceeded, number, strict=True)
    ]
    if lost := sweep.sizes["record"] * len(intensity.values) - number.sum():
        lines.append(f"{lost} motions without an answer are left out.")
    return "\n".join(lines)


def _counts(sweep: xr.Dataset, args: argparse.Namespace) -> tuple[np.ndarray, np.ndarray]:
    """(n,) numbers of records that exceed the limit, and of those with an answer."""
    labels = outcome_labels(sweep)
    exceeds = fell = labels == FALLS
    if args.demand is not None:
        exceeds = fell | (peaks_of(sweep, args.demand) >= args.limit)
    answered = fell | labels.isin(STANDS)
    return (exceeds & answered).sum("record").values, answered.sum("record").values


def _fitted(curve: Fragility) -> str:
    doubt = 1.96 * np.sqrt(np.diag(curve.covariance))
    return (
        f"Median {curve.median:.3g} g (95 % interval {curve.median - doubt[0]:.3g} to "
        f"{curve.median + doubt[0]:.3g} g), dispersion {curve.dispersion:.2g}: lognormal curve of "
        "maximum likelihood."
    )


def _write(
    sweep: xr.Dataset, curve: Fragility, intensity: Intensity, args: argparse.Namespace
) -> list[Path]:
    args.out.mkdir(parents=True, exist_ok=True)
    table, picture = args.out / "fragility.csv", args.out / "fragility.png"
    low, high = curve.bounds(intensity.values)
    columns = [
        intensity.values,
        *_counts(sweep, args),
        curve.probability(intensity.values),
        low,
        high,
    ]
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(
        [f"{intensity.name} [g]", "exceeded", "motions", "probability", "lower", "upper"]
    )
    writer.writerows(zip(*(np.round(column, 9).tolist() for column in columns), strict=True))
    write(table, text.getvalue())
    figure = fragility_curve(sweep, intensity=intensity.name, demand=args.demand, limit=args.limit)
    save_figure(figure, picture)
    return [table, picture]
