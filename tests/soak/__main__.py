"""python -m tests.soak: run many seeds, or one again."""

from __future__ import annotations

import argparse
import os
import sys
import warnings

from tests.soak.cases import draw
from tests.soak.checks import COMPARED
from tests.soak.run import DECLARED, checked, soaked


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.soak", description=__doc__)
    parser.add_argument("--seed", type=int, help="run one seed again, and tell all of it")
    parser.add_argument(
        "--check",
        choices=[*COMPARED, *DECLARED, "pushover"],
        help="with --seed: this check that is not made for all, drawn or not",
    )
    parser.add_argument("--runs", type=int, default=20_000, help="how many seeds")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args(arguments)
    if given.seed is not None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            print(draw(given.seed))
        result = checked(given.seed, given.check)
        print(result)
        return bool(result.violations)
    last = given.first + given.runs - 1
    print(f"seeds {given.first} to {last}, {given.workers} workers", file=sys.stderr, flush=True)
    summary = soaked(range(given.first, given.first + given.runs), given.workers)
    print(summary)
    return bool(summary.violations)


if __name__ == "__main__":
    sys.exit(main())
