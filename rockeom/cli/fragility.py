"""``rockeom fragility``: the probability of overturning against the intensity of records."""

import argparse
import sys
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from rockeom.analysis.risk.fragility import Fragility, fragility_of
from rockeom.analysis.sweeps import exceedances
from rockeom.assessment.words import plural
from rockeom.cli.errors import UsageError
from rockeom.cli.models import add_structure, made
from rockeom.cli.motions import SETS, accelerations, add_records, records_for
from rockeom.cli.output import csv_of
from rockeom.cli.simulate import add_azimuth, check_folder, impact_law
from rockeom.cli.text.options import add_number, add_words
from rockeom.drawing.style import save_figure
from rockeom.files import write
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import near
from rockeom.plots.sweeps import fragility_curve
from rockeom.simulation.case import Case
from rockeom.structures.units import main_units
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
    add_number(parser, "--duration", "S", "of each simulation [s]")
    add_azimuth(parser)
    add_records(parser)
    intensity = parser.add_argument_group("intensities (one of the first two)")
    one = intensity.add_mutually_exclusive_group(required=True)
    add_words(one, "--pga", "VALUES", f"largest accelerations: {_LEVELS}")
    add_words(one, "--sa", "VALUES", "spectral accelerations at --period, 5 %% damped, alike")
    add_number(intensity, "--period", "S", "of --sa [s]")
    limit = parser.add_argument_group("limit; overturning if not given")
    limit.add_argument(
        "--demand",
        metavar="NAME",
        help="a state, or a quantity such as displacement, whose largest size is limited",
    )
    add_number(limit, "--limit", "X", "of --demand, in its unit")
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="write fragility.csv and .png into this folder"
    )


Rows = list[tuple[float, int, int]]
"""Each intensity [g], how many records exceed the limit, and how many have an answer."""


class Intensity(NamedTuple):
    """The measure that records are scaled to, by its name of `scaled_to`, and its values [g]."""

    name: str
    meaning: str
    values: list[float]


def run(args: argparse.Namespace) -> int:
    structure, law, intensity = made(args), impact_law(args.impact), _intensity(args)
    if (args.demand is None) != (args.limit is None):
        raise UsageError("--demand and --limit belong together, as in --demand theta --limit 0.05")
    if args.limit is not None and not args.limit > 0.0:
        raise UsageError(f"--limit {args.limit:g}: give a positive number, a largest size")
    units = {**main_units(structure.module)}
    if args.demand not in (None, *units):
        meant = near(args.demand, units)
        raise UsageError(f"--demand {args.demand}{meant}: there are {', '.join(units)}")
    quantities = () if args.demand in (None, *structure.states) else (args.demand,)
    if args.out is not None:
        check_folder(args.out)
    motions = records_for(structure, args)

    def case(motion: Any, **level: float) -> Case:
        wanted: dict[str, Any] = {name: x * STANDARD_GRAVITY for name, x in level.items()}
        scaled = motion.scaled_to(**wanted, period=args.period)
        return Case(structure, scaled, law, duration=args.duration, azimuth=args.azimuth)

    about = {"units": "g", "long_name": intensity.meaning}
    levels = xr.DataArray(intensity.values, dims=intensity.name, attrs=about)
    print(f"simulating {len(levels) * len(motions)} motions ...", file=sys.stderr)
    over = {intensity.name: levels, "motion": list(motions)}
    sweep = simulate_many(case, over=over, quantities=quantities)
    counts = [of.sum("motion").values for of in exceedances(sweep, args.demand, args.limit)[:2]]
    rows: Rows = [*zip(intensity.values, *counts, strict=True)]
    print(_table(rows, args, intensity, len(motions)))
    curve = _fit(sweep, args, intensity)
    print(_fitted(curve))
    if args.out is not None:
        for path in _write(rows, curve, intensity, args):
            print(f"wrote {path}")
    return 0


def _intensity(args: argparse.Namespace) -> Intensity:
    if (args.sa is None) != (args.period is None):
        raise UsageError("--sa and --period belong together, as in --sa 0.2g 0.4g --period 1.0")
    name = "pga" if args.sa is None else "sa"
    levels, option = getattr(args, name), f"--{name}"
    values = [x / STANDARD_GRAVITY for x in accelerations(levels, option)]
    if not 1 < len({*values}) == len(values):
        raise UsageError(f"{option} {' '.join(levels)}: give two values or more, each once")
    if name == "pga":
        return Intensity(name, "peak ground acceleration", values)
    return Intensity(name, f"spectral acceleration at {args.period:g} s", values)


def _fit(sweep: xr.Dataset, args: argparse.Namespace, intensity: Intensity) -> Fragility:
    """The curve; raises InputError, with the option to change, where there is none."""
    try:
        return fragility_of(sweep, intensity=intensity.name, demand=args.demand, limit=args.limit)
    except ValueError as error:
        said = str(error).removeprefix("fit_fragility: ").replace("intensities", "values")
        levels = " ".join(getattr(args, intensity.name))
        raise UsageError(
            f"no curve fits these observations: {said} (--{intensity.name} {levels})"
        ) from None


def _table(rows: Rows, args: argparse.Namespace, intensity: Intensity, number: int) -> str:
    """How many records exceed the limit at each intensity."""
    what = "overturned" if args.demand is None else f"reached {args.demand} = {args.limit:g}"
    lines = [
        f"{args.name} under {plural(number, 'record')}, each scaled to {len(rows)} values of "
        f"{intensity.meaning}:"
    ]
    lines += [f"  {x:6.3g} g: {hits:3d} of {of} {what}" for x, hits, of in rows]
    return "\n".join(lines)


def _fitted(curve: Fragility) -> str:
    """The intensities at 5 and 50 percent with their intervals."""
    lines = [f"Lognormal curve of maximum likelihood, {curve.grouped}, intervals of 95 %:"]
    for part in (0.05, 0.5):
        x = curve.quantile(part)
        lines.append(f"  {part:.0%}: {x.value:.3g} g ({x.lower:.3g} to {x.upper:.3g} g)")
    lines.append(f"  dispersion: {curve.dispersion:.3g}")
    return "\n".join([*lines, *filter(None, [curve.not_counted])])


def _write(
    rows: Rows, curve: Fragility, intensity: Intensity, args: argparse.Namespace
) -> list[Path]:
    args.out.mkdir(parents=True, exist_ok=True)
    table, picture = args.out / "fragility.csv", args.out / "fragility.png"
    heads = [f"{intensity.name} [g]", "exceeded", "motions", "probability", "lower", "upper"]
    curves = curve.probability(intensity.values), *curve.bounds(intensity.values)
    written = (
        [f"{x:.9g}", hits, of, *(f"{p:.6g}" for p in rest)]
        for (x, hits, of), *rest in zip(rows, *curves, strict=True)
    )
    write(table, csv_of([heads, *written]))
    figure = fragility_curve(curve, intensity=f"{intensity.meaning} [g]")
    if args.demand is None:
        figure.axes[0].set_ylabel("probability of overturning [-]")
    save_figure(figure, picture)
    return [table, picture]
