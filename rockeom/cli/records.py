"""``rockeom records``: the recorded earthquakes that are installed."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from rockeom.cli.errors import UsageError, check_picture
from rockeom.drawing.style import save_figure
from rockeom.motion import GroundMotion, library
from rockeom.motion.units import STANDARD_GRAVITY

DESCRIPTION = """\
List the recorded ground motions of the library, those of the extras records and fema, with their
largest acceleration and duration; words choose those whose names have all of them. One record
alone is shown with its intensity measures, and with --out as a picture.
"""
EPILOG = """\
examples:
  rockeom records                              all of them
  rockeom records far field                    a set of FEMA P695
  rockeom records El Centro                    those of a station
  rockeom records El Centro 1940 180 --out el_centro.png

The same words name a record for rockeom simulate --record, and a set for rockeom report --records.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("words", nargs="*", metavar="WORD", help="of their names; all if left out")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="draw the one record: FILE.png, .pdf or .svg"
    )


def run(args: argparse.Namespace) -> int:
    words = " ".join(args.words)
    names = (words,) if words in library.records() else library.names(words)
    if args.out is not None:
        if len(names) > 1:
            raise UsageError(f"--out {args.out}: {len(names)} records have these words: add some")
        check_picture(args.out)
    if len(names) > 1:
        print(_list(names))
        return 0
    motion = GroundMotion.from_library(names[0])
    print(_shown(names[0], motion))
    if args.out is not None:
        save_figure(motion.plot(), args.out)
        print(f"wrote {args.out}")
    return 0


def _list(names: Sequence[str]) -> str:
    """A line for each, none shortened: its words are there to be typed."""
    lines = ["PGA [g]  [s]            words of its name"]
    for name in names:
        motion = GroundMotion.from_library(name)
        up = "vertical" if motion.is_vertical else ""
        lines.append(
            f"{motion.peak / STANDARD_GRAVITY:7.3f} {motion.duration:4.0f}  {up:8}  {_words(name)}"
        )
    return "\n".join(
        [*lines, "", f"{len(names)} records; more words find fewer, and show one alone."]
    )


def _shown(name: str, motion: GroundMotion) -> str:
    facts = [
        ("words of its name", _words(name)),
        ("source", motion.source),
        ("component", "vertical" if motion.is_vertical else "horizontal"),
        ("duration", f"{motion.duration:.6g} s, samples every {motion.dt:g} s"),
        ("largest acceleration", f"{motion.peak / STANDARD_GRAVITY:.4g} g"),
    ]
    wide = max(len(what) for what, _ in facts)
    lines = [f"{what:{wide}}  {said}" for what, said in facts]
    return "\n".join([motion.name, "", *lines, "", str(motion.measures())])


def _words(name: str) -> str:
    """A name as one types it."""
    return name.replace("_", " ")
