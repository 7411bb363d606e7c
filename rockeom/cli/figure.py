"""``rockeom figure``: figures of the thesis, drawn anew."""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rockeom.cli.errors import UsageError
from rockeom.cli.terminal import listing, width

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HELP = "draw a figure of the thesis anew, from simulations and closed forms"
DESCRIPTION = """\
List the figures of Ma's thesis (2010) that are drawn anew, or draw one of them into a file. What
the thesis leaves open about a figure, and what was taken for it, is printed beside it.
The first drawing of a simulated figure compiles its structures, which takes a second or two.
"""
EPILOG = """\
examples:
  rockeom figure                        the list
  rockeom figure 4-35                   into figure-4-35.png
  rockeom figure 2-16 --out block.pdf   into a file of your own: .png, .pdf or .svg
"""

_SUFFIXES = (".png", ".pdf", ".svg")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "number", nargs="?", metavar="NUMBER", help="such as 4-35; a list of all if left out"
    )
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="draw into FILE; figure-NUMBER.png if left out"
    )


def run(args: argparse.Namespace) -> int:
    from rockeom.thesis.figures import FIGURES

    if args.number is None:
        if args.out is not None:
            raise UsageError(f"--out {args.out}: name the figure as well: rockeom figure 4-35 ...")
        print(_list(FIGURES))
        return 0
    if args.number not in FIGURES:
        raise UsageError(f"no figure {args.number!r} is drawn anew; there are {', '.join(FIGURES)}")
    path = args.out or Path(f"figure-{args.number}.png")
    if path.suffix.lower() not in _SUFFIXES:
        raise UsageError(f"--out {path}: the name must end in {', '.join(_SUFFIXES)}")
    if not path.parent.is_dir():  # told before the drawing, not after
        raise UsageError(f"--out {path}: there is no folder {path.parent}; make it first")
    draw = FIGURES[args.number]
    print(f"drawing figure {args.number} ...", file=sys.stderr)
    draw().savefig(path)
    print(f"wrote {path}", file=sys.stderr)
    print(_explained(args.number, draw))
    return 0


def _list(figures: Mapping[str, Callable[[], Figure]]) -> str:
    rows = [("", "WHAT IT SHOWS"), *((n, _title(draw)) for n, draw in figures.items())]
    return f"{listing(rows)}\n\n{len(figures)} figures; rockeom figure NUMBER draws one."


def _title(draw: Callable[[], Figure]) -> str:
    """The first line of its docstring."""
    return (draw.__doc__ or "").strip().partition("\n")[0].rstrip(".")


def _explained(number: str, draw: Callable[[], Figure]) -> str:
    head, _, rest = (draw.__doc__ or "").strip().partition("\n")
    paragraphs = [f"{number}  {head}", *textwrap.dedent(rest).strip().split("\n\n")]
    return "\n\n".join(textwrap.fill(p, width()) for p in paragraphs if p)
