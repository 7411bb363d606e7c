"""``rockeom assess``: will it overturn?"""

import argparse
import sys
from pathlib import Path
from typing import Any

from rockeom.assessment.assess import assess, by_recording
from rockeom.assessment.azimuths import azimuths_of
from rockeom.assessment.result import UNITS_CHECKED, check_page
from rockeom.cli.models import add_structure, made
from rockeom.cli.motions import SETS, accelerations, add_records, records_for
from rockeom.cli.simulate import add_slope, impact_law
from rockeom.cli.text.options import add_number, add_words
from rockeom.integrator.schema import in_space
from rockeom.motion.floor import floor_motion

DESCRIPTION = """\
Will it overturn? Judge a structure under a set of records: the acceleration that lifts a foot,
whether it slides before, the probability of overturning against the peak ground acceleration
with its interval, the changes that help, and the assumptions. Components of one recording count as
one; with --components all its vertical one shakes, too. It prints the answer and, with
--out, writes a page. A block may be given by its full size: width,
height, centroid_height, offset [m], mass [kg].
"""
_USAGE = """\
rockeom assess NAME --set PARAMETER=VALUE ...
         (--records WORD ... | --motion FILE ... | --motion FOLDER)
         [--pga 0.2g 0.4g ...] [--friction MU] [--floor T ...] [--out FILE.html]
         [more options, see --help]
"""
EPILOG = f"""\
{SETS}
examples:
  rockeom assess rigid_block --set width=0.6 height=2.0 mass=400 --records far field \\
      --pga 0.2g 0.4g 0.6g --friction 0.5 --out rack.html
  rockeom assess rigid_block --set width=0.5 height=1.8 centroid_height=0.7 \\
      --motion one.AT2 other.AT2 --out statue.html
  rockeom assess prism --set width=0.5 depth=0.7 height=3.0 mass=2000 --motion records \\
      --pga 0.3g 0.5g --azimuths 8
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_structure(parser)
    add_number(
        parser,
        "--friction",
        "MU",
        "coefficient of friction below the feet; without it sliding is not judged",
    )
    add_slope(parser)
    parser.add_argument(
        "--azimuths", nargs="+", metavar="ANGLE",
        help="of a structure in space: 0deg 30deg, or how many; 45 degrees apart if not given",
    )  # fmt: skip
    parser.add_argument("--impact", metavar="LAW", help="as for rockeom simulate")
    parser.add_argument(
        "--units-checked", action="store_true", help="give a verdict though a unit is in doubt"
    )
    add_number(
        parser, "--level", "P", "of the intervals of confidence; 0.95 if not given", default=0.95
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the page into FILE.html")
    group = add_records(parser)
    add_words(
        group,
        "--pga",
        "PGA",
        "peak ground accelerations that each record is scaled to, as 0.4g or 3.9m/s2, or "
        "0.1g:0.8g:8; from 1.25 to 6 times the one that lifts a foot, if not given",
    )
    group.add_argument(
        "--floor", nargs="+", type=float, metavar="T",
        help="it stands on a floor of a building of these periods [s], the longest first",
    )  # fmt: skip
    add_number(
        group,
        "--floor-height",
        "Z",
        "of that floor, as a part of the height of the building; 1, the roof, if not given",
        default=1.0,
    )


def run(args: argparse.Namespace) -> int:
    structure = made(args)
    law = impact_law(args.impact)
    if args.out is not None:
        check_page(args.out)  # before the simulations, not after
    pga = None if args.pga is None else accelerations(args.pga, "--pga")
    motions: Any = records_for(structure, args)
    turns: Any = args.azimuths
    if turns and turns[0].isdecimal() and not turns[1:]:
        turns = int(turns[0])
    azimuths_of(structure, turns)  # before the simulations, not after
    print(f"simulating {len(motions)} record{'s' * (len(motions) > 1)} ...", file=sys.stderr)
    shaking = motions
    if not in_space(structure.module):
        shaking = motions.recordings() if args.components == "all" else by_recording(motions)
    if args.floor:
        shaking = [floor_motion(x, args.floor, height=args.floor_height) for x in shaking]
    answer = assess(
        structure, shaking, pga=pga, friction=args.friction, impact=law, level=args.level,
        units_checked=args.units_checked, slope=args.slope, azimuths=turns,
    )  # fmt: skip
    print(str(answer).replace(UNITS_CHECKED, "--units-checked"))
    if args.out is not None:
        answer.save(args.out)
        print(f"wrote {args.out}")
    return 0
