"""``rockeom report``: one page on a structure under a set of records."""

import argparse
import sys
from pathlib import Path

from rockeom.cli.models import add_structure, made
from rockeom.cli.motions import SETS, add_records, add_scale, records, scaled
from rockeom.cli.simulate import impact_law
from rockeom.cli.text.options import add_number
from rockeom.files import check_target
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
EPILOG = f"""\
{SETS}
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
    add_number(parser, "--duration", "S", "of each simulation [s]")
    parser.add_argument(
        "--out",
        nargs="+",
        type=Path,
        required=True,
        metavar="FILE",
        help="write the page into FILE.html or FILE.pdf, or into both",
    )
    add_scale(add_records(parser))


def run(args: argparse.Namespace) -> int:
    structure = made(args)
    law = impact_law(args.impact)
    motions = [scaled(motion, args) for motion in records(args)]
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
