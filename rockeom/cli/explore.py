"""``rockeom explore``: a page with sliders that simulates in the browser."""

import argparse
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from rockeom.browser.controls import slider
from rockeom.browser.page import explorer
from rockeom.browser.traced import UntracedError
from rockeom.cli.errors import UsageError, words
from rockeom.cli.models import dimensions_of, made
from rockeom.cli.simulate import add_case, case
from rockeom.cli.text.options import add_pairs
from rockeom.files import check_target
from rockeom.modelling.named import class_named
from rockeom.simulation.case import Case
from rockeom.sweeps.case_numbers import Number, OtherCase

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
    add_pairs(
        parser,
        "--vary",
        "NUMBER=LOW..HIGH",
        "sliders: numbers of the case by name, such as half_width, amplitude or scale, or "
        "full dimensions of a block that --set gives",
        required=True,
    )
    parser.add_argument(
        "--title", default="", help="heading of the page; the structure if not given"
    )
    parser.add_argument("--out", type=Path, required=True, metavar="FILE.html", help="the page")


def run(args: argparse.Namespace) -> int:
    if args.out.suffix != ".html":
        raise UsageError(f"--out {args.out}: name a file that ends in .html")
    check_target(args.out)
    ranges = words(args.vary, "--vary", "half_width=0.1..0.4").items()
    page = explorer(*_page(args, {name: _range(name, text) for name, text in ranges}), args.title)
    try:
        page.save(args.out)
    except UntracedError as error:
        raise UsageError(str(error)) from error
    print(f"wrote {args.out}: open it in a browser")
    return 0


def _page(args: argparse.Namespace, ranges: Mapping[str, Any]) -> tuple[Any, Mapping[str, Any]]:
    """A case and its sliders; where a full dimension varies, a function that makes the case."""
    one = case(args)
    full = dimensions_of(class_named(args.name), ranges)
    if not full:
        return one, ranges
    rest = OtherCase(one, tuple(name for name in ranges if name not in full))
    first = words(args.set, "--set", "width=0.6")
    numbers = {n: Number("structure", (n,), float(first.get(n, 0.0)), "m") for n in full}

    def of_dimensions(**values: Any) -> Case:
        structure = made(args, **{name: values.pop(name) for name in full})
        return OtherCase(replace(one, structure=structure), rest.names)(**values)

    numbers |= rest.numbers
    return of_dimensions, {name: slider(name, x, numbers[name]) for name, x in ranges.items()}


def _range(name: str, text: str) -> tuple[float, float]:
    """The ends of "0.1..0.4"; raises InputError for anything else."""
    low, dots, high = text.partition("..")
    try:
        if dots:
            return float(low), float(high)
    except ValueError:
        pass
    raise UsageError(f"--vary {name}={text}: write lowest..highest, as in {name}=0.1..0.4")
