"""``rockeom thesis statements``: sentences of the thesis with a number, and what was found."""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Iterable

from rockeom.cli.errors import UsageError
from rockeom.cli.text.terminal import width
from rockeom.thesis import statements
from rockeom.thesis.figures import FIGURES, Statement

DESCRIPTION = """\
Show sentences of Ma's thesis (2010) with a number, and the number found: those that belong to no
figure, and what is wrong as printed outside the equations; or those of the figures named, which
are drawn for it.
"""
EPILOG = """\
examples:
  rockeom thesis statements             of no figure, and the slips
  rockeom thesis statements 2-22 4-20   of two figures
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("figures", nargs="*", metavar="FIGURE", help="such as 4-20")


def run(args: argparse.Namespace) -> int:
    for number in args.figures:
        if number not in FIGURES:
            raise UsageError(f"no figure {number!r} is drawn; rockeom thesis figure lists them")
    print("computing ...", file=sys.stderr)
    if args.figures:
        print(_shown(statements.of_figures(*args.figures)) or "these figures have no statements")
        return 0
    print(_shown(statements.others()))
    print("\nWrong as printed, outside the equations:\n")
    print(_shown(statements.slips()))
    return 0


def _shown(said: Iterable[Statement]) -> str:
    return "\n\n".join(
        "\n".join(
            textwrap.fill(line, width(), subsequent_indent="  ")
            for line in (f"{one.where}: {one.printed}", f"found: {one.found} ({one.verdict})")
        )
        for one in said
    )
