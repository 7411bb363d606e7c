"""``rockeom thesis statements``: sentences of the thesis with a number, judged."""

import argparse
import sys
import textwrap

from rockeom.cli.errors import UsageError
from rockeom.cli.text.terminal import width
from rockeom.thesis import statements

DESCRIPTION = """\
Judge the statements of Ma's thesis (2010) that have a number, all of them or those of some
sections, tables or figures. A statement holds or differs only against independent evidence: a
table, a data file, a closed form, or a simulation with the thesis's own inputs. It is open where an
input is lost, or where the uncertainty of an input decides.
"""
EPILOG = """\
examples:
  rockeom thesis statements              all, and how many hold, differ and are open (a minute)
  rockeom thesis statements 4-20 2.7     of a figure, and of a section
  rockeom thesis statements "Table 4-3"  of a table
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "names", nargs="*", metavar="NAME", help='such as 4-20, 4.9.1 or "Table 4-3"'
    )


def run(args: argparse.Namespace) -> int:
    try:
        chosen = statements.select(*args.names) if args.names else statements.STATEMENTS
    except KeyError as error:
        raise UsageError(f"{error.args[0]}; without a name all are shown") from None
    print("computing ...", file=sys.stderr)
    judgements = []
    for one in chosen:
        judgements.append(one.judged())
        print(in_words(judgements[-1]) + "\n")
    counted = statements.counts(judgements)
    print(", ".join(f"{verdict.value} {n}" for verdict, n in counted.items()))
    return 0


def in_words(one: statements.Judgement) -> str:
    """A judgement as the terminal shows it."""
    of = one.statement
    figure = f" (Figure {of.figure})" if of.figure else ""
    lines = (
        f"{of.place}{figure}: {of.words}",
        f"allows: {of.limits}",
        f"found: {one.words}",
        f"compared with: {one.source}",
        one.conclusion,
    )
    indents = ("", *["  "] * (len(lines) - 1))
    return "\n".join(
        textwrap.fill(line, width(), initial_indent=first, subsequent_indent="    ")
        for first, line in zip(indents, lines, strict=True)
    )
