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

from rockeom.analysis.risk.fragility import Fragility, fit_fragility
from rockeom.analysis.sweeps import FALLS, STANDS, outcome_labels, peaks_of
from rockeom.cli.errors import UsageError
from rockeom.cli.models import add_structure, made
from rockeom.cli.motions import SETS, accelerations, add_records, records
from rockeom.cli.simulate import check_folder, impact_law
from rockeom.drawing.style import save_figure
from rockeom.files import write
from rockeom.motion import GroundMotion
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
    limit.add_argument(
        "--demand",
        metavar="NAME",
        help="a state, or a quantity such as displacement, whose largest size is limited",
    )
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
    known = {**main_units(structure.module)}
    if args.demand not in (None, *known):
        meant = near(args.demand, known)
        raise UsageError(f"--demand {args.demand}{meant}: there are {', '.join(known)}")
    quantities = () if args.demand in (None, *structure.states) else (args.demand,)
    if args.out is not None:
        check_folder(args.out)
    motions = {motion.name: motion for motion in records(args)}

    def case(record: str, **level: float) -> Case:
        motion = intensity.scaled(motions[record], level[intensity.name] * STANDARD_GRAVITY)
        return Case(structure, motion, law, duration=args.duration)

    about = {"units": "g", "long_name": intensity.meaning}
    levels = xr.DataArray(intensity.values, dims=intensity.name, attrs=about)
    print(f"simulating {len(levels) * len(motions)} motions ...", file=sys.stderr)
    over = {intensity.name: levels, "record": list(motions)}
    sweep = simulate_many(case, over=over, quantities=quantities)
    found = _observed(sweep, args)
    print(_table(found, args, intensity))
    curve = _fit(found, args, intensity)
    print(_fitted(curve))
    if args.out is not None:
        for path in _write(found, curve, intensity, args):
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


class Observed(NamedTuple):
    """Whether each motion exceeds the limit and whether it has an answer, (intensity, record)."""

    exceeds: xr.DataArray
    answered: xr.DataArray

    @property
    def counts(self) -> tuple[np.ndarray, np.ndarray]:
        """(n,) numbers of records that exceed the limit, and of those with an answer."""
        return (
            (self.exceeds & self.answered).sum("record").values,
            self.answered.sum("record").values,
        )


def _observed(sweep: xr.Dataset, args: argparse.Namespace) -> Observed:
    labels = outcome_labels(sweep)
    exceeds = fell = labels == FALLS
    if args.demand is not None:
        exceeds = fell | (peaks_of(sweep, args.demand) >= args.limit)
    return Observed(exceeds, fell | labels.isin(STANDS))


def _fit(found: Observed, args: argparse.Namespace, intensity: Intensity) -> Fragility:
    """The curve; raises UsageError, with the option to change, where there is none."""
    answered, exceeds = found.answered, found.exceeds
    levels, records = xr.broadcast(answered[intensity.name], answered["record"])
    rows = answered.values
    try:
        return fit_fragility(
            levels.transpose(*answered.dims).values[rows],
            exceeds.transpose(*answered.dims).values[rows],
            left_out=int((~rows).sum()),
            group=records.transpose(*answered.dims).values[rows],
        )
    except ValueError as error:
        said = str(error).removeprefix("fit_fragility: ").replace("intensities", "values")
        given = " ".join(getattr(args, intensity.name))
        raise UsageError(
            f"no curve fits these observations: {said} (--{intensity.name} {given})"
        ) from None


def _table(found: Observed, args: argparse.Namespace, intensity: Intensity) -> str:
    """How many records exceed the limit at each intensity."""
    what = "overturned" if args.demand is None else f"reached {args.demand} = {args.limit:g}"
    exceeded, number = found.counts
    lines = [
        f"{args.name} under {found.answered.sizes['record']} records, each scaled to "
        f"{len(intensity.values)} values of {intensity.meaning}:"
    ]
    lines += [
        f"  {level:6.3g} g: {hits:3d} of {of} {what}"
        for level, hits, of in zip(intensity.values, exceeded, number, strict=True)
    ]
    if lost := int((~found.answered).sum()):
        lines.append(f"{lost} motions without an answer are left out.")
    return "\n".join(lines)


def _fitted(curve: Fragility) -> str:
    """The intensities at 5 and 50 percent with their intervals."""
    lines = ["Lognormal curve of maximum likelihood, with intervals of 95 % between records:"]
    for part in (0.05, 0.5):
        x = curve.quantile(part)
        lines.append(f"  {part:.0%}: {x.value:.3g} g ({x.lower:.3g} to {x.upper:.3g} g)")
    return "\n".join([*lines, f"  dispersion {curve.dispersion:.2g}"])


def _write(
    found: Observed, curve: Fragility, intensity: Intensity, args: argparse.Namespace
) -> list[Path]:
    args.out.mkdir(parents=True, exist_ok=True)
    table, picture = args.out / "fragility.csv", args.out / "fragility.png"
    low, high = curve.bounds(intensity.values)
    exceeded, number = found.counts
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(
        [f"{intensity.name} [g]", "exceeded", "motions", "probability", "lower", "upper"]
    )
    for x, hits, of, *rest in zip(
        intensity.values,
        exceeded,
        number,
        curve.probability(intensity.values),
        low,
        high,
        strict=True,
    ):
        writer.writerow([f"{x:.9g}", hits, of, *(f"{p:.6g}" for p in rest)])
    write(table, text.getvalue())
    figure = fragility_curve(curve, intensity=f"{intensity.meaning} [g]")
    if args.demand is None:
        figure.axes[0].set_ylabel("probability of overturning [-]")
    save_figure(figure, picture)
    return [table, picture]
