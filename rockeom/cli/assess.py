"""``rockeom assess``: will it overturn?"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from rockeom.assessment.assess import assess
from rockeom.assessment.result import check_page
from rockeom.cli.errors import UsageError, numbers, words
from rockeom.cli.models import add_structure, made
from rockeom.cli.simulate import impact_law
from rockeom.motion import GroundMotion, MotionError
from rockeom.motion.motion_set import MotionSet
from rockeom.structures.base import Structure
from rockeom.structures.shipped.rigid_block import RigidBlock

DESCRIPTION = """\
Will it overturn? Judge a structure under a set of records: the acceleration that lifts a foot,
whether it slides before, the probability of overturning against the peak ground acceleration
with its interval, the changes that help, and the assumptions. It prints the answer and, with
--out, writes a page. A block may be given by its full size: width, height, centroid_height,
offset [m], mass [kg].
"""
_USAGE = """\
rockeom assess NAME --set PARAMETER=VALUE ...
         (--records WORD ... | --motion FILE ... | --folder FOLDER)
         [--pga 0.2g 0.4g ...] [--friction MU] [--out FILE.html] [more options, see --help]
"""
EPILOG = """\
examples:
  rockeom assess rigid_block --set width=0.6 height=2.0 mass=400 --records far field \\
      --pga 0.2g 0.4g 0.6g --friction 0.5 --out rack.html
  rockeom assess rigid_block --set width=0.5 height=1.8 centroid_height=0.7 \\
      --motion one.AT2 other.AT2 --out statue.html
"""
_SIZES = ("width", "centroid_height", "offset")
"""Parameters that only a block of full dimensions has."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_structure(parser)
    parser.add_argument(
        "--friction", type=float, metavar="MU",
        help="coefficient of friction below the feet; without it sliding is not judged",
    )  # fmt: skip
    parser.add_argument("--impact", metavar="LAW", help="as for rockeom simulate")
    parser.add_argument(
        "--level", type=float, default=0.95, metavar="P",
        help="of the intervals of confidence; 0.95 if not given",
    )  # fmt: skip
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the page into FILE.html")
    group = parser.add_argument_group("ground motions (one of the first three)")
    one = group.add_mutually_exclusive_group(required=True)
    one.add_argument(
        "--records", nargs="+", metavar="WORD", help="all records whose names have these words"
    )
    one.add_argument("--motion", nargs="+", metavar="FILE", help="recorded accelerations")
    one.add_argument("--folder", type=Path, help="of .AT2 files")
    group.add_argument(
        "--units", metavar="UNITS", help="of files that do not say their own, as g or m/s2"
    )
    group.add_argument(
        "--pga", nargs="+", metavar="PGA",
        help="peak ground accelerations that each record is scaled to, as 0.4g or 3.9m/s2; from "
        "1.25 to 6 times the one that lifts a foot, if not given",
    )  # fmt: skip


def run(args: argparse.Namespace) -> int:
    structure = _structure(args)
    law = impact_law(args.impact)
    if args.out is not None:
        check_page(args.out)  # before the simulations, not after
    motions = _motions(args)
    print(f"simulating {len(motions)} record{'s' * (len(motions) > 1)} ...", file=sys.stderr)
    answer = assess(
        structure, motions, pga=_pga(args.pga), friction=args.friction, impact=law, level=args.level
    )
    print(answer)
    if args.out is not None:
        answer.save(args.out)
        print(f"wrote {args.out}")
    return 0


def _structure(args: argparse.Namespace) -> Structure:
    """The structure of --set; a block by its full dimensions, too."""
    example = "width=0.6 height=2.0"
    if args.name != "rigid_block" or not {*_SIZES} & words(args.set, "--set", example).keys():
        return made(args)
    sizes = numbers(args.set, "--set", example)
    missing = {"width", "height"} - sizes.keys()
    if missing:
        raise UsageError(f"--set has no {' and no '.join(sorted(missing))}: write --set {example}")
    try:
        return RigidBlock.from_dimensions(**sizes)
    except TypeError as error:
        raise UsageError(f"--set {' '.join(args.set)}: {error}") from None


def _pga(given: list[str] | None) -> list[float | str] | None:
    """Numbers of m/s2, and texts with their units."""
    if given is None:
        return None
    plain = re.compile(r"[\d.]+(e[-+]?\d+)?", re.IGNORECASE)
    return [float(one) if plain.fullmatch(one) else one for one in given]


def _motions(args: argparse.Namespace) -> list[GroundMotion]:
    if args.units is not None and args.records is not None:
        raise UsageError(f"--units {args.units} is for files: leave it out")
    if args.records is not None:
        return list(MotionSet.from_library(" ".join(args.records)))
    if args.folder is not None:
        try:
            return list(MotionSet.from_folder(args.folder, units=args.units))
        except MotionError as error:
            raise UsageError(
                f"{error}; other files are given by --motion {args.folder}/*.txt --units g"
            ) from None
    return [GroundMotion.read(path, units=args.units) for path in args.motion]
