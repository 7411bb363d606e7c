"""``rockeom explore``: a page with sliders that simulates in the browser."""

from __future__ import annotations

import argparse
from pathlib import Path

from rockeom.browser.page import explorer
from rockeom.browser.traced import UntracedError
from rockeom.cli.errors import UsageError, words
from rockeom.cli.simulate import add_case, case
from rockeom.files import check_target

DESCRIPTION = """\
Make one HTML file in which a structure moves as sliders say, integrated in the browser: without a
server, and without a network. The options of the case are those of `rockeom simulate`; --vary names
numbers of it and their ranges.
"""
_USAGE = """\
rockeom explore NAME --set PARAMETER=VALUE ... [--initial STATE=VALUE ...] [--impact LAW]
         (--motion FILE | --pulse KIND NUMBER=VALUE ... | --record WORD ... | --free)
         [--duration S] --vary NUMBER=LOW..HIGH ... --out FILE.html [more options, see --help]
"""
EPILOG = """\
examples:
  rockeom explore rigid_block --set half_width=0.15 half_height=0.6 --pulse half-sine amplitude=4 \\
      period=0.8 duration=6 --vary half_width=0.05..0.4 amplitude=0.5..8 --out block.html
  rockeom explore rigid_block --set half_width=0.15 half_height=0.6 --record El Centro 1940 180 \\
      --vary half_width=0.05..0.4 scale=0.2..4 --out el_centro.html
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_case(parser)
    parser.add_argument(
        "--vary",
        nargs="+",
        action="extend",
        required=True,
        metavar="NUMBER=LOW..HIGH",
        help="sliders: numbers of the case by name, such as half_width, amplitude or scale",
    )
    parser.add_argument(
        "--title", default="", help="heading of the page; the structure if not given"
    )
    parser.add_argument("--out", type=Path, required=True, metavar="FILE.html", help="the page")


def run(args: argparse.Namespace) -> int:
    if args.out.suffix != ".html":
        raise UsageError(f"--out {args.out}: name a file that ends in .html")
    check_target(args.out)
    sliders = {
        n: _range(n, t) for n, t in words(args.vary, "--vary", "half_width=0.1..0.4").items()
    }
    page = explorer(case(args), sliders, args.title)
    try:
        page.save(args.out)
    except UntracedError as error:
        raise UsageError(str(error)) from error
    print(f"wrote {args.out}: open it in a browser")
    return 0


def _range(name: str, text: str) -> tuple[float, float]:
    """The ends of "0.1..0.4"; raises UsageError for anything else."""
    low, dots, high = text.partition("..")
    try:
        if dots:
            return float(low), float(high)
    except ValueError:
        pass
    raise UsageError(f"--vary {name}={text}: write lowest..highest, as in {name}=0.1..0.4")
