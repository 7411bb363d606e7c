"""``rockeom thesis figure``: figures of the thesis, drawn again."""

import argparse
import sys
import textwrap
from pathlib import Path

from rockeom.cli.errors import UsageError, check_picture
from rockeom.cli.text.terminal import listing, width
from rockeom.cli.thesis.statements import in_words
from rockeom.drawing.style import save_figure
from rockeom.thesis.album import draw_all
from rockeom.thesis.figures import FIGURES, NOT_DRAWN, ThesisFigure
from rockeom.thesis.statements import of_figure

DESCRIPTION = """\
List the figures of Ma's thesis (2010) that are drawn again, draw one of them into a file, or all
into a folder. A text next to a figure says what the thesis leaves open about it, and which
assumption fills the gap.
The first drawing of a simulated figure compiles its structures, which takes a second or two.
"""
EPILOG = """\
examples:
  rockeom thesis figure                        the list
  rockeom thesis figure 4-35                   into figure-4-35.png
  rockeom thesis figure 2-16 --out block.pdf   into a file of your own: .png, .pdf or .svg
  rockeom thesis figure --all --out figures    all of them, with contact sheets (a minute)
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "number", nargs="?", metavar="NUMBER", help="such as 4-35; a list of all if left out"
    )
    parser.add_argument("--all", action="store_true", help="draw all figures into the folder --out")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="draw into FILE; figure-NUMBER.png if left out"
    )


def run(args: argparse.Namespace) -> int:
    if args.all:
        if args.number is not None or args.out is None:
            raise UsageError("--all draws every figure: leave NUMBER out and add --out FOLDER")
        return bool(draw_all(args.out, lambda words: print(words, file=sys.stderr)))
    if args.number is None:
        if args.out is not None:
            raise UsageError(
                f"--out {args.out}: name the figure as well: rockeom thesis figure 4-35 ..."
            )
        print(_list())
        return 0
    if args.number in NOT_DRAWN:
        raise UsageError(f"figure {args.number} is not drawn: {NOT_DRAWN[args.number]}")
    if args.number not in FIGURES:
        raise UsageError(f"no figure {args.number!r} is drawn; there are {', '.join(FIGURES)}")
    path = args.out or Path(f"figure-{args.number}.png")
    check_picture(path)  # before the drawing, not after
    one = FIGURES[args.number]
    print(f"drawing figure {one.number} ...", file=sys.stderr)
    save_figure(one(), path)
    print(f"wrote {path}", file=sys.stderr)
    print(_explained(one))
    return 0


def _list() -> str:
    of_each = ((one.number, one.source.value, one.title) for one in FIGURES.values())
    rows = [("", "FROM", "WHAT IT SHOWS"), *of_each]
    drawn = f"{listing(rows)}\n\n{len(FIGURES)} figures; rockeom thesis figure NUMBER draws one."
    return f"{drawn}\n\nNot drawn, and why:\n{listing(list(NOT_DRAWN.items()))}"


def _explained(one: ThesisFigure) -> str:
    head, _, rest = one.text.partition("\n")
    paragraphs = [f"{one.number}  {head}", *textwrap.dedent(rest).strip().split("\n\n")]
    paragraphs.append(f"Drawn from: {one.source.value}.")
    said = [textwrap.fill(p, width()) for p in paragraphs if p]
    said += [in_words(statement.judged()) for statement in of_figure(one.number)]
    return "\n\n".join(said)
