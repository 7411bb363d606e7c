"""``rockeom thesis tables``: tables of the thesis, printed and computed."""

import argparse
import sys
import textwrap

from rockeom.cli.errors import UsageError
from rockeom.cli.text.terminal import listing, width
from rockeom.thesis.side_by_side import TextTable, side_by_side
from rockeom.thesis.tables import TABLES

DESCRIPTION = """\
List the tables of Ma's thesis (2010) and the lists of numbers under its figures, or show some of
them: each computed column next to the printed one, and remarks on them. A-1 has
the peaks of the free vibration by each model of the wall and impact law, too.
The first simulation of a structure compiles it, which takes a second or two.
"""
EPILOG = """\
examples:
  rockeom thesis tables                the list
  rockeom thesis tables 2-1            one, printed and computed
  rockeom thesis tables 4-1 4-2        several
  rockeom thesis tables A-1            measured and simulated peaks of the controlled wall
  rockeom thesis tables "Figure 3-3"   the list of numbers under a figure
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "numbers", nargs="*", metavar="NUMBER", help="such as 2-1; a list of all if left out"
    )


def run(args: argparse.Namespace) -> int:
    if not args.numbers:
        rows = [("", "WHAT IT HOLDS"), *((n, table.title) for n, table in TABLES.items())]
        print(f"{listing(rows)}\n\n{len(TABLES)} tables; rockeom thesis tables NUMBER shows one.")
        return 0
    for number in args.numbers:
        if number not in TABLES:
            raise UsageError(f"no table {number!r}; there are {', '.join(TABLES)}")
    print("computing ...", file=sys.stderr)
    shown = [_shown(table) for number in args.numbers for table in side_by_side(number)]
    print("\n\n".join(shown))
    return 0


def _shown(table: TextTable) -> str:
    room = width()
    parts = [
        textwrap.fill(f"{table.heading}: {table.title}", room),
        "\n".join(_aligned(table)),
        *(
            textwrap.fill(remark, room, initial_indent="- ", subsequent_indent="  ")
            for remark in table.remarks
        ),
    ]
    return "\n\n".join(parts)


def _aligned(table: TextTable) -> list[str]:
    """Columns as wide as their cells and the words of their name need; a short name stays whole."""
    columns = list(zip(*table.rows, strict=True))
    widths = [
        max(*map(len, (*cells, *name.split())), min(len(name), 9))
        for name, cells in zip(table.columns, columns, strict=True)
    ]
    right = [all(_is_number(cell) for cell in cells) for cells in columns]
    names = [textwrap.wrap(n, w) or [""] for n, w in zip(table.columns, widths, strict=True)]
    depth = max(map(len, names))
    head = zip(*([""] * (depth - len(lines)) + lines for lines in names), strict=True)
    return [
        "  ".join(
            f"{cell:>{w}}" if r else f"{cell:{w}}"
            for cell, w, r in zip(row, widths, right, strict=True)
        ).rstrip()
        for row in (*head, ("-" * w for w in widths), *table.rows)
    ]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return cell == "–"
    return True
