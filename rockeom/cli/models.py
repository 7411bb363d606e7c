"""``rockeom models``: the shipped structures."""

from __future__ import annotations

import argparse
import dataclasses
import difflib

from rockeom.cli.errors import UsageError
from rockeom.numeric.structures import SHIPPED, Structure

HELP = "list the structures, or explain one of them"
DESCRIPTION = """\
List the shipped structures, or explain one: its states, its parameters with units and
meanings, and its contact phases.
"""
EPILOG = """\
examples:
  rockeom models
  rockeom models flexible_structure
"""

# The user's name of a parameter, where it is not the model's.
_NAME_IN_MODEL = {"half_height": "height"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", nargs="?", metavar="NAME", help="a structure; all if left out")


def run(args: argparse.Namespace) -> int:
    if args.name is None:
        print(_list())
    else:
        print(_explain(shipped(args.name)))
    return 0


def shipped(name: str) -> type[Structure]:
    """The class of a shipped structure; raises UsageError naming all of them if it is unknown."""
    if name not in SHIPPED:
        near = difflib.get_close_matches(name, SHIPPED, n=1)
        hint = f" (did you mean {near[0]}?)" if near else ""
        raise UsageError(f"no structure named {name!r}{hint}; there are {', '.join(SHIPPED)}")
    return SHIPPED[name]


def title(structure: type[Structure]) -> str:
    return (structure.module_of_class().__doc__ or "").partition("\n")[0].rstrip(".")


def aligned(rows: list[tuple[str, ...]]) -> list[str]:
    """Rows as lines of aligned columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
