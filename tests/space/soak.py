"""python -m tests.space.soak: random motions of bodies in space, against the laws of mechanics."""

import argparse
import sys
from collections import Counter
from multiprocessing import Pool

from tests.space.mechanics import violations
from tests.space.test_random_motions import drawn

RUBBING = 10
"""One seed of so many has feet that rub: such motions take a hundred times as many steps."""
ENDS = ("completed", "overturned", "came to rest")


def judged(seed: int) -> tuple[int, str, list[str]]:
    """Outcome of a seed's motion, and a line for each law that it violates."""
    run, *laws = drawn(seed, rubs=seed % RUBBING == 0)
    return seed, run.outcome.value, list(violations(run, *laws))


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.space.soak", description=__doc__)
    parser.add_argument("--runs", type=int, default=20_000, help="how many seeds")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("--workers", type=int, help="processes; as many as cores if not given")
    given = parser.parse_args(arguments)
    outcomes: Counter[str] = Counter()
    seeds = range(given.first, given.first + given.runs)
    with Pool(given.workers) as pool:
        for seed, outcome, lines in pool.imap_unordered(judged, seeds, chunksize=4):
            outcomes[outcome] += 1
            outcomes["violations"] += bool(lines)
            if lines or outcome not in ENDS:
                print(seed, outcome, *lines[:3], sep=", ", flush=True)
    print(dict(outcomes))
    return bool(outcomes["violations"])


if __name__ == "__main__":
    sys.exit(main())
