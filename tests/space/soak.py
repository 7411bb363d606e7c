"""python -m tests.space.soak: random motions of bodies in space, against the laws of mechanics.

Ends with a table of families, and with the first seed that is left: `--first` goes on from there.
"""

import argparse
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterable
from multiprocessing import Pool

from tests.space.families import on_a_rim, on_feet, wobbling
from tests.space.mechanics import violations
from tests.space.round_bodies import violations_on_a_rim, violations_wobbling

FAMILIES = ("rubs", *5 * ("feet",), *2 * ("rim",), *2 * ("wobbles",))
"""By the last digit of a seed: feet that rub take a hundred times as many steps as others do."""
MOST_FRICTION = 1.5
BOUNCING = 4
"""One seed of so many has a restitution of 0.5 whatever the friction, half of those that rub."""
ENDS = ("completed", "overturned", "came to rest")
NO_END = ("no solution", "chatter", "stalled")


Judged = tuple[int, str, str, list[str]]
"""Seed, family and outcome of a motion, and a line for each law that it violates."""


def judged(seed: int) -> Judged:
    """What comes of a seed, errors too."""
    try:
        return _judged(seed)
    except Exception as error:  # is no reason to stop
        return seed, FAMILIES[seed % len(FAMILIES)], "raised", [repr(error)]


def _judged(seed: int) -> Judged:
    family = FAMILIES[seed % len(FAMILIES)]
    if family == "rim":
        run = on_a_rim(seed)
        lines = violations_on_a_rim(run)
    elif family == "wobbles":
        run = wobbling(seed)
        lines = violations_wobbling(run)
    else:
        run, *laws = on_feet(seed, MOST_FRICTION if family == "rubs" else 0.0, seed % BOUNCING == 0)
        lines = violations(run, *laws)
        named = "rub" if family == "rubs" else "never slip" if laws[0] is None else "are smooth"
        family = f"{type(run.structure).__name__}, feet {named}" + ", e > 0" * (laws[1] > 0.0)
    return seed, family, run.outcome.value, list(lines)


def table(counts: dict[str, Counter[str]]) -> Iterable[str]:
    """Lines of a table: seeds by family, how they ended, and how many violate a law."""
    columns = ("seeds", "ended", *NO_END, "other", "violations")
    yield f"{'family':36}" + "".join(f"{name:>13}" for name in columns)
    for family, count in sorted(counts.items()):
        yield f"{family:36}" + "".join(f"{count[name]:13}" for name in columns)


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.space.soak", description=__doc__)
    parser.add_argument("--runs", type=int, default=20_000, help="how many seeds")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("--minutes", type=float, default=1e9, help="time after which to stop")
    parser.add_argument("--workers", type=int, help="processes; as many as cores if not given")
    given = parser.parse_args(arguments)
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    seeds, last = (
        range(given.first, given.first + given.runs),
        time.monotonic() + 60 * given.minutes,
    )
    with Pool(given.workers) as pool:
        for seed, family, outcome, lines in pool.imap(judged, seeds, chunksize=4):
            end = "ended" if outcome in ENDS else outcome if outcome in NO_END else "other"
            counts[family].update({"seeds": 1, end: 1, "violations": bool(lines)})
            if lines or end != "ended":
                print(seed, family, outcome, *lines[:3], sep=", ", flush=True)
            if time.monotonic() > last:
                break
        pool.terminate()
    print(*table(counts), f"next: --first {seed + 1}", sep="\n")
    return any(count["violations"] for count in counts.values())


if __name__ == "__main__":
    sys.exit(main())
