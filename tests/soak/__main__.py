"""python -m tests.soak: run many seeds, one seed again, or many with a fault planted."""

import argparse
import os
import sys
import warnings
from contextlib import nullcontext

from tests.soak import bounds
from tests.soak.cases import METHODS, MODELS, draw
from tests.soak.checks import COMPARED
from tests.soak.energy import gains_of
from tests.soak.families import EVERY, drawn, family_of, method_of, model_of, spread
from tests.soak.faults import FAULTS, planted
from tests.soak.run import DECLARED, Checks, checked, soaked


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.soak", description=__doc__)
    parser.add_argument("--runs", type=int, default=20_000, help="how many seeds")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("--models", nargs="*", choices=MODELS, help="only these structures")
    parser.add_argument(
        "--family", nargs="*", choices=EVERY, dest="families",
        help="as many seeds of each of these; all of them, unless structures are named",
    )  # fmt: skip
    parser.add_argument("--methods", nargs="*", choices=sorted(set(METHODS)), help="only these")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--stop", action="store_true", help="at the first violation")
    parser.add_argument("--seed", type=int, help="run one seed again, and tell all of it")
    parser.add_argument(
        "--check",
        choices=[*COMPARED, *DECLARED, "pushover", "none"],
        help="make this one, of the checks that are drawn, for every seed, and no other of them",
    )
    parser.add_argument("--fault", choices=FAULTS, help="plant this fault; the soak must find it")
    parser.add_argument(
        "--energy", type=int, metavar="RUNS", help="elastic structures: do impacts gain energy?"
    )
    parser.add_argument(
        "--bounds", action="store_true",
        help="programs check every index; also those of structures that are not drawn here",
    )  # fmt: skip
    given = parser.parse_args(arguments)
    with bounds.checked() if given.bounds else nullcontext():
        return run(given)


def run(given: argparse.Namespace) -> int:
    if given.energy is not None:
        gains = gains_of(range(given.first, given.first + given.energy))
        print(gains)
        return bool(gains.gained)
    checks = Checks(drawn=()) if given.check == "none" else Checks(always=given.check)
    if given.fault is not None:
        return planted(given.fault)
    if given.seed is not None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            one = given.seed
            print(draw(one) if family_of(one) is None else drawn(one)[0])
        result = checked(given.seed, checks)
        print(result)
        return bool(result.violations)
    named = given.models or given.methods or given.check
    families = given.families or (("structures",) if named else EVERY)
    seeds = [
        seed
        for seed in spread(given.runs, given.first, families)
        if (not given.models or model_of(seed) in given.models)
        and (not given.methods or method_of(seed) in given.methods)
    ]
    print(
        f"{len(seeds):,} seeds from {given.first} on, {given.workers} workers",
        file=sys.stderr, flush=True,
    )  # fmt: skip
    summary = soaked(seeds, given.workers, checks, stop=given.stop)
    print(summary)
    left = []
    if given.bounds:
        each = max(given.runs // 1000, 2)
        left = bounds.searched([*bounds.STRUCTURES], range(given.first, given.first + each))
        print(f"{len(bounds.STRUCTURES)} more structures, {each} motions each: {len(left)} faults")
        print(*left, sep="\n")
    return bool(summary.violations or left)


if __name__ == "__main__":
    sys.exit(main())
