"""``rockeom thesis verify``: every equation of the thesis decided."""

import argparse
import sys
import textwrap
import time

from rockeom.thesis import EQUATIONS, Decision, Verdict, equation, verify

DESCRIPTION = """\
Derive, reproduce or compare every numbered equation of the thesis, and print the verdicts and
their counts. A printed form that is wrong must fail its checks, and the corrected one pass them.
Takes less than a minute. The exit code is 1 if any check fails or any equation has none.
"""
EPILOG = """\
examples:
  rockeom thesis verify              all of them
  rockeom thesis verify 2-9 5-34     some of them
  rockeom thesis verify --failures   the table of those only that fail
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("numbers", nargs="*", metavar="NUMBER", help="such as 5-34; all if none")
    parser.add_argument("--failures", action="store_true", help="print only what fails")


def run(args: argparse.Namespace) -> int:
    numbers = [equation(n).number for n in args.numbers] or list(EQUATIONS)
    progress = _Progress(len(numbers))
    start = time.perf_counter()
    report = verify(numbers, progress.show)
    progress.end()
    shown = [d for d in report.decisions if not (args.failures and d.verdict.passes)]
    for decision in shown:
        print(_row(decision))
    print()
    for verdict in Verdict:
        if verdict in report.counts or not verdict.passes:
            print(f"{report.counts.get(verdict, 0):4}  {verdict.value}")
    print(f"{len(report.decisions):4}  in {time.perf_counter() - start:.0f} s")
    return 0 if report.passes else 1


def _row(decision: Decision) -> str:
    one = decision.equation
    means = ", ".join(dict.fromkeys(check.means.value for check in decision.checks))
    line = f"{one.number:6} {decision.verdict.value:26} {means:24} {one.meaning}"
    if decision.why:
        line += "\n" + textwrap.fill(decision.why, 100, initial_indent=" " * 7)
    return line


class _Progress:
    """A line on stderr, where that is a terminal."""

    def __init__(self, total: int) -> None:
        self.total, self.done, self.shown = total, 0, sys.stderr.isatty()

    def show(self, decision: Decision) -> None:
        self.done += 1
        if self.shown:
            number = decision.equation.number
            sys.stderr.write(f"\r{self.done} of {self.total}: {number:6}")
            sys.stderr.flush()

    def end(self) -> None:
        if self.shown:
            sys.stderr.write("\r" + " " * 30 + "\r")
