"""``rockeom sweep``: numbers of a simulation varied, every combination of them."""

import argparse
import math
import sys
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from rockeom.cli.errors import spread, words
from rockeom.cli.output import csv_of
from rockeom.cli.simulate import add_case, case, check_folder
from rockeom.cli.text.options import add_pairs
from rockeom.drawing.style import INK, new_axes, save_figure
from rockeom.files import write
from rockeom.plots.sweeps import overturning_map, rocking_spectrum as draw_spectrum
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.structures.positions import RESERVE, TILT, has_barrier
from rockeom.structures.slope import overturning_angles
from rockeom.structures.units import with_unit
from rockeom.sweeps.case_numbers import OtherCase
from rockeom.sweeps.run import simulate_many

DESCRIPTION = """\
Vary numbers of a simulation by their names, simulate every combination, and count the outcomes;
with --out, write a table and a picture: the map of what overturns over two names, the largest
rotation over one. The options of the structure, its motion and its start are those of rockeom
simulate, whose help lists pulses, impact laws and supports.
"""
_USAGE = """\
rockeom sweep NAME --over NUMBER=FIRST:LAST:HOW_MANY NUMBER=VALUE,VALUE ...
         --set PARAMETER=VALUE ... [--initial STATE=VALUE ...] [--impact LAW]
         (--motion FILE | --pulse KIND NUMBER=VALUE ... | --record WORD ... | --free)
         [--out DIR] [more options, see --help]
"""
EPILOG = """\
names that --over knows:
  parameters of the structure, as half_width; "masses[0]" of a list; "support.stiffness"
  numbers of a pulse, as amplitude and period; scale and time_scale, factors of the accelerations
  and times of any ground motion
  restitution, the ratio of angular velocities after and before an impact
  "initial theta" and other states at the start; duration [s]; slope of the ground [rad]

examples:
  rockeom sweep rigid_block --set half_width=0.2 half_height=0.9 --out map \\
      --pulse single-sine amplitude=1 period=1 \\
      --over amplitude=0.5:8:40 period=0.3:2:40
  rockeom sweep rigid_block --set half_width=0.2 half_height=0.9 --record El Centro 1940 180 \\
      --pga 0.5g --over half_width=0.1:0.4:61 --out widths --format netcdf
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_case(parser)
    add_pairs(
        parser,
        "--over",
        "NUMBER=VALUES",
        "what varies: half_width=0.1:0.3:20, twenty values at even distances, or "
        "amplitude=1,2,3; several vary with each other",
        required=True,
    )
    output = parser.add_argument_group("output")
    output.add_argument(
        "--out", type=Path, metavar="DIR", help="write sweep.csv and sweep.png into this folder"
    )
    output.add_argument(
        "--format",
        choices=("csv", "netcdf"),
        default="csv",
        help="of the table; csv if not given; netcdf is sweep.nc, which xarray and MATLAB read",
    )


def run(args: argparse.Namespace) -> int:
    one = case(args)
    over = _over(args.over)
    if args.out is not None:
        check_folder(args.out)
    n = math.prod(map(len, over.values()))
    print(f"simulating {n} motions ...", file=sys.stderr)
    leans = (TILT, RESERVE) if has_barrier(one.structure) else ()
    sweep = simulate_many(one, over=over, quantities=leans, options=SolverOptions(args.method))
    print(_counted(sweep, one))
    if args.out is not None:
        for path in _write(sweep, one, args):
            print(f"wrote {path}")
    return 0


def _over(pairs: list[str]) -> dict[str, list[float]]:
    """name -> values of words such as "half_width=0.1:0.3:20"."""
    example = "--over half_width=0.1:0.3:20 amplitude=1,2,3"
    return {
        name: spread(text, f"--over {name}={text}", example)
        for name, text in words(pairs, "--over", "half_width=0.1:0.3:20").items()
    }


def _counted(sweep: xr.Dataset, one: Case) -> str:
    """How many of the motions ended in which way."""
    labels, counts = np.unique(sweep["outcome"].values, return_counts=True)
    counted = ", ".join(f"{n} {label}" for label, n in zip(labels, counts, strict=True))
    varied = " and ".join(str(name) for name in sweep["outcome"].dims)
    return (
        f"{sweep['outcome'].size} motions of {one.structure.model} over {varied}, "
        f"ground motion {one.motion.name}: {counted}."
    )


def _write(sweep: xr.Dataset, one: Case, args: argparse.Namespace) -> list[Path]:
    args.out.mkdir(parents=True, exist_ok=True)
    if args.format == "csv":
        paths = [args.out / "sweep.csv"]
        write(paths[0], _csv(sweep))
    else:
        paths = [args.out / "sweep.nc"]
        write(paths[0], bytes(sweep.to_netcdf(engine="scipy")))
    if (figure := _picture(sweep, one)) is not None:
        paths.append(args.out / "sweep.png")
        save_figure(figure, paths[1])
    return paths


def _picture(sweep: xr.Dataset, one: Case) -> Figure | None:
    """The map of two names, or the largest rotation against one; None for more of them."""
    names = [str(name) for name in sweep["outcome"].dims]
    if len(names) == 2:
        return overturning_map(sweep, x=names[0], y=names[1])
    if len(names) > 2:
        print("no picture: it would need more than two axes", file=sys.stderr)
        return None
    (name,) = names
    if "quantity" in sweep.dims:
        figure, ax = new_axes(5.6, 3.5)
        ratio = 1.0 - sweep["minimum_quantity"].sel(quantity=RESERVE)
        ax.plot(sweep[name], np.minimum(ratio, 1.1), "o-")  # who fell, just above the line
        ax.axhline(1.0, ls=":", color=INK)
        ax.set(xlabel=name, ylabel="largest tilt over that of the barrier", ylim=(0.0, 1.2))
        return figure
    other = OtherCase(one, (name,))
    cases = (other(**{name: x}) for x in sweep[name].values.tolist())
    angles = [overturning_angles(case.structure, case.slope) for case in cases]
    if None in angles:
        print("no picture: the structure has no overturning angle to compare with", file=sys.stderr)
        return None
    alpha = [min(map(abs, pair)) for pair in angles if pair is not None]
    return draw_spectrum(sweep.assign_coords(alpha=(name, alpha)), x=name, alpha="alpha")


def _csv(sweep: xr.Dataset) -> str:
    """A row for each motion: what was varied, the outcome, and the largest size of each state."""
    names = [str(name) for name in sweep["outcome"].dims]
    states = sweep["state"].values
    units = sweep["state_unit"].values
    headings = [with_unit(name, sweep[name].attrs.get("units", "")) for name in names]
    headings += ["outcome", with_unit("final_time", sweep["final_time"].attrs.get("units", ""))]
    headings += ["impacts", *map(with_unit, [f"peak {s}" for s in states], units)]
    leans = {"maximum_quantity": TILT, "minimum_quantity": RESERVE} if "quantity" in sweep else {}
    headings += ["largest tilt [rad]", "least reserve"][: len(leans)]
    columns = [
        *(a.values.ravel() for a in xr.broadcast(*(sweep[name] for name in names))),
        *(sweep[name].values.ravel() for name in ("outcome", "final_time", "impacts")),
        *sweep["peak"].transpose("state", *names).values.reshape(len(states), -1),
        *(sweep[of].sel(quantity=quantity).values.ravel() for of, quantity in leans.items()),
    ]
    rows = zip(*columns, strict=True)
    written = ([f"{x:.12g}" if isinstance(x, float) else x for x in row] for row in rows)
    return csv_of([headings, *written])
