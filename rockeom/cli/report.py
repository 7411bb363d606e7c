"""``rockeom report``: one page on a structure under a set of records."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from rockeom.cli.errors import UsageError
from rockeom.cli.models import add_structure, made
from rockeom.cli.simulate import add_scale, impact_law, scaled
from rockeom.files import check_target
from rockeom.motion import GroundMotion
from rockeom.motion.arguments import COMPONENTS
from rockeom.motion.motion_set import MotionSet
from rockeom.plots.design_report import check_name, design_report

DESCRIPTION = """\
Simulate a structure under each record of a set, rocking and, where it has an elastic
column, with its feet held down, and write one page: figures, demands compared with those of the
fixed base, and the assumptions with how far they held. All numbers are in SI units; `rockeom models
NAME` explains the parameters of a structure.
"""
_USAGE = """\
rockeom report NAME --set PARAMETER=VALUE ... (--records WORD ... | --motion FILE ...)
         --out FILE.html|FILE.pdf ... [--impact LAW] [more options, see --help]
"""
EPILOG = """\
sets of records (extras records and fema), by words that all their names have:
  far field, near field pulse, near field no pulse: those of FEMA P695
  El Centro 1940: both horizontal components; a line names the vertical one, which is left out
  El Centro 1940 180: the one record, as for rockeom simulate

examples:
  rockeom report flexible_structure --records far field \\
      --set mass=300e3 height=12 inertia=2e6 base_mass=40e3 base_height=0.5 \\
      base_inertia=60e3 half_width=1.5 stiffness=20e6 damping=250e3 \\
      --impact impulsive --out pier.html pier.pdf
  rockeom report rigid_block --set half_width=0.3 half_height=1.2 mass=2000 \\
      --motion one.AT2 other.AT2 --out block.pdf
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_structure(parser)
    parser.add_argument("--impact", metavar="LAW", help="as for rockeom simulate")
    parser.add_argument("--duration", type=float, metavar="S", help="of each simulation [s]")
    parser.add_argument(
        "--out",
        nargs="+",
        type=Path,
        required=True,
        metavar="FILE",
        help="write the page into FILE.html or FILE.pdf, or into both",
    )
    group = parser.add_argument_group("ground motions (one of the first two)")
    one = group.add_mutually_exclusive_group(required=True)
    one.add_argument(
        "--records", nargs="+", metavar="WORD", help="all records whose names have these words"
    )
    one.add_argument("--motion", nargs="+", metavar="FILE", help="recorded accelerations")
    group.add_argument(
        "--components",
        choices=COMPONENTS,
        help="of the records by words; horizontal if not given",
    )
    group.add_argument(
        "--units", metavar="UNITS", help="of files that do not say their own, as g or m/s2"
    )
    add_scale(group)


def run(args: argparse.Namespace) -> int:
    structure = made(args)
    law = impact_law(args.impact)
    motions = [scaled(motion, args) for motion in _motions(args)]
    for path in args.out:
        check_name(path)
        check_target(path)  # before the simulations, not after
    print(f"simulating {len(motions)} records ...", file=sys.stderr)
    page = design_report(structure, motions, law, args.duration)
    for sentence in (page.title, *page.findings, *page.assumptions):
        print(sentence)
    for path in args.out:
        page.write(path)
        print(f"wrote {path}")
    return 0


def _motions(args: argparse.Namespace) -> list[GroundMotion]:
    if args.records is not None:
        if args.units is not None:
            raise UsageError(f"--units {args.units} is for files: leave it out")
        words, components = " ".join(args.records), args.components or "horizontal"
        return list(MotionSet.from_library(words, components=components))
    if args.components is not None:
        raise UsageError(f"--components {args.components} is for --records: leave it out")
    return [GroundMotion.read(path, units=args.units) for path in args.motion]
