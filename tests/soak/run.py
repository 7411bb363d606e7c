"""Many seeds in worker processes, each run watched: compiled code that hangs hears no signal."""

import collections
import multiprocessing
import queue
import re
import sys
import time
import traceback
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TextIO

from tests.soak.cases import Dice, draw
from tests.soak.checks import COMPARED, Record, on_record
from tests.soak.declared import named_otherwise, pushed, unequal_feet
from tests.soak.families import ALLOWED, drawn as of_family, family_of, method_of, model_of
from tests.soak.newton import SOMETIMES, Told, given_back, on_contacts

BATCH = 100
LONGEST = 60.0
"""A run with all its checks may take so long [s]; most take some milliseconds."""
COMPILING = 900.0
"""The first of a structure and method may [s]."""
TO_EXPLAIN = ("chatter", "stalled", "not finite")


@dataclass(frozen=True)
class Result:
    """What came of a seed. outcome : a label, or "refused" with what the error said."""

    seed: int
    outcome: str
    violations: tuple[str, ...] = ()
    seconds: float = 0.0

    def __str__(self) -> str:
        lines = [f"seed {self.seed}, {model_of(self.seed)}, {method_of(self.seed)}: {self.outcome}"]
        lines += [f"    {v}" for v in self.violations]
        return "\n".join([*lines, f"    python -m tests.soak --seed {self.seed}"])


DECLARED = {"names": (0.002, named_otherwise), "feet": (0.0005, unequal_feet)}
PUSHED = 0.1
"""Shares of the seeds for which checks without a motion are made."""
GIVEN_BACK = 0.2
"""Share of the seeds of families of which states of events are given back."""


def drawn(seed: int, compared: Iterable[str] | None = None) -> set[str]:
    """The checks, besides those that all have, which are made for a seed."""
    shares = {name: share for name, (share, _) in (COMPARED | DECLARED).items()}
    shares["pushover"] = PUSHED
    known = shares if compared is None else [name for name in shares if name in compared]
    return {name for name in known if Dice(seed, 0, *name.encode()).chance(shares[name])}


@dataclass(frozen=True)
class Checks:
    """Which checks are made besides those that all seeds have.

    drawn : which may be drawn; all if not given. always : one that every seed has, and no other.
    """

    drawn: tuple[str, ...] | None = None
    always: str | None = None

    def of(self, seed: int) -> set[str]:
        return {self.always} if self.always else drawn(seed, self.drawn)


def checked(seed: int, checks: Checks = Checks()) -> Result:
    """Run a seed with its checks."""
    if family_of(seed) is not None:
        return by_hand(seed)
    started = time.perf_counter()
    asked = checks.of(seed)
    found: list[str] = []
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of odd input, which is meant
            for name, (_, check) in DECLARED.items():
                if name in asked:
                    found += check(seed)
            motion = draw(seed)
            if "pushover" in asked:
                found += pushed(seed, motion.structure)
            try:
                run = motion.run()
            except ValueError as error:
                return Result(seed, f"refused: {error}", tuple(found))
            record = Record(motion, run)
            found += on_record(record)
            for name, (_, check) in COMPARED.items():
                if name in asked:
                    found += check(record)
        outcome = str(run.outcome)
    except Exception as error:
        outcome = "error"
        found.append(f"{type(error).__name__}: {error} " + traceback.format_exc(limit=-3))
    return Result(seed, outcome, tuple(found), time.perf_counter() - started)


def by_hand(seed: int) -> Result:
    """Run a seed of a family, and hold it against mechanics written by hand."""
    started = time.perf_counter()
    outcome, found = "error", []
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            motion, mechanics = of_family(seed)
            run = motion.run()
        outcome = str(run.outcome)
        told = Told(motion, run, mechanics)
        found = list(on_contacts(told))
        if Dice(seed, 1).chance(GIVEN_BACK):
            found += given_back(told)
        for name, (share, families, check) in SOMETIMES.items():
            if family_of(seed) in families and Dice(seed, 1, *name.encode()).chance(share):
                found += check(told)
    except ValueError as error:
        outcome = f"refused: {error}"
        if not any(re.search(text, str(error)) for text in ALLOWED):
            found.append(outcome)
    except Exception as error:
        found.append(f"{type(error).__name__}: {error} " + traceback.format_exc(limit=-3))
    return Result(seed, outcome, tuple(found), time.perf_counter() - started)


@dataclass
class Summary:
    """What came of all seeds."""

    runs: collections.Counter = field(default_factory=collections.Counter)
    violations: list[Result] = field(default_factory=list)
    to_explain: dict[str, list[int]] = field(
        default_factory=lambda: {word: [] for word in TO_EXPLAIN}
    )
    seconds: collections.Counter = field(default_factory=collections.Counter)
    refused: collections.Counter = field(default_factory=collections.Counter)
    kinds: collections.Counter = field(default_factory=collections.Counter)
    """Seeds with a violation of a kind, by what was looked at: what their lines begin with."""

    def add(self, result: Result) -> None:
        word = result.outcome.partition(":")[0]
        self.runs[model_of(result.seed), method_of(result.seed), word] += 1
        self.seconds[model_of(result.seed), method_of(result.seed)] += result.seconds
        if result.violations:
            self.violations.append(result)
            for kind in {line.partition(":")[0] for line in result.violations}:
                self.kinds[model_of(result.seed), kind] += 1
        if word == "refused":
            self.refused[re.sub(r"-?\d[-\d.e+]*", "#", result.outcome.partition(": ")[2])] += 1
        if word in self.to_explain:
            self.to_explain[word].append(result.seed)

    @property
    def total(self) -> int:
        return sum(self.runs.values())

    def table(self) -> str:
        outcomes = sorted({key[2] for key in self.runs}, key=lambda word: -sum(
            n for key, n in self.runs.items() if key[2] == word
        ))  # fmt: skip
        rows = [("", "", "runs", *outcomes, "ms")]
        for model, method in sorted({key[:2] for key in self.runs}):
            counts = [self.runs[model, method, word] for word in outcomes]
            each = 1e3 * self.seconds[model, method] / max(sum(counts), 1)
            rows.append((model, method, *(str(n) for n in (sum(counts), *counts)), f"{each:.1f}"))
        columns = zip(*rows, strict=True)
        wide = [max(map(len, column)) for column in columns]

        def line(row: tuple[str, ...]) -> str:
            names = (word.ljust(w) for word, w in zip(row[:2], wide, strict=False))
            return "  ".join(
                (*names, *(n.rjust(w) for n, w in zip(row[2:], wide[2:], strict=True)))
            )

        return "\n".join(map(line, rows))

    def __str__(self) -> str:
        lines = [self.table(), ""]
        for word, seeds in self.to_explain.items():
            if seeds:
                lines.append(f"{word}: {' '.join(map(str, sorted(seeds)))}")
        lines += [f"refused {n}: {text}" for text, n in self.refused.most_common(12)]
        for (model, kind), n in sorted(self.kinds.items(), key=lambda item: (item[0][0], -item[1])):
            whole = sum(count for key, count in self.runs.items() if key[0] == model)
            lines.append(f"{model}: {kind} in {n} of {whole} ({100 * n / whole:.3g} %)")
        lines.append(f"{self.total:,} runs, {len(self.violations)} with a violation")
        return "\n".join(lines)


# -- in workers


def batches(seeds: Iterable[int]) -> list[list[int]]:
    """Seeds by structure and method, so that a worker loads few programs."""
    groups: dict[tuple[str, str], list[int]] = collections.defaultdict(list)
    for seed in seeds:
        groups[model_of(seed), method_of(seed)].append(seed)
    return [group[i : i + BATCH] for group in groups.values() for i in range(0, len(group), BATCH)]


def _work(jobs, results, present, checks) -> None:
    """Present holds the seed under way and when it began, for the watch."""
    loaded: set[tuple[str, str, str]] = set()
    while True:
        batch = jobs.get()
        if batch is None:
            return
        for seed in batch:
            programs = {"integrate"} | (checks.of(seed) & {"many", "lanes"})
            keys = {(model_of(seed), method_of(seed), program) for program in programs}
            present[0], present[1] = float(seed), time.monotonic()
            present[2] = LONGEST if keys <= loaded else COMPILING
            result = checked(seed, checks)
            if result.outcome.partition(":")[0] not in ("refused", "error"):
                loaded |= keys
            results.put(result)
        present[0] = -1.0
        results.put(len(batch))


class _Worker:
    """A process, its queue of one batch at a time, and the seed that it is at."""

    def __init__(self, context, results, checks) -> None:
        self.context, self.results, self.checks = context, results, checks
        self.start()

    def start(self) -> None:
        self.present = self.context.Array("d", [-1.0, 0.0, COMPILING], lock=False)
        self.jobs = self.context.Queue()
        self.process = self.context.Process(
            target=_work, args=(self.jobs, self.results, self.present, self.checks), daemon=True
        )
        self.process.start()
        self.batch: list[int] = []

    def give(self, batch: list[int]) -> None:
        self.batch = batch
        self.jobs.put(batch)

    def hung(self) -> int | None:
        """The seed that takes too long or has ended the process, if there is one."""
        seed, began, longest = self.present[:]
        if not self.batch or seed < 0:
            return None
        if not self.process.is_alive() or time.monotonic() - began > longest:
            return int(seed)
        return None

    def restart(self) -> None:
        self.process.kill()
        self.process.join()
        self.start()


def soak(
    seeds: Iterable[int],
    workers: int = 2,
    checks: Checks = Checks(),
) -> Iterator[Result]:
    """Results in the order in which they come. A seed that hangs is a violation; others go on."""
    context = multiprocessing.get_context("spawn")
    results = context.Queue()
    waiting = collections.deque(batches(seeds))
    team = [_Worker(context, results, checks) for _ in range(min(workers, len(waiting)))]
    done: set[int] = set()
    for worker in team:
        worker.give(waiting.popleft())
    try:
        while any(worker.batch for worker in team):
            try:
                found = results.get(timeout=1.0)
            except queue.Empty:
                found = None
            if isinstance(found, Result) and found.seed not in done:
                done.add(found.seed)
                yield found
            for worker in team:
                if worker.batch and all(seed in done for seed in worker.batch):
                    worker.batch = []
                elif found is None and (seed := worker.hung()) is not None:
                    what = "hang: no end" if worker.process.is_alive() else "crash: process ended"
                    left = [s for s in worker.batch if s not in done and s != seed]
                    worker.restart()
                    done.add(seed)
                    yield Result(seed, "hang", (f"{what} after {LONGEST:g} s or more",), LONGEST)
                    if left:
                        worker.give(left)
                if not worker.batch and waiting:
                    worker.give(waiting.popleft())
    finally:
        for worker in team:
            worker.process.kill()
            worker.process.join()


def soaked(
    seeds: Iterable[int],
    workers: int = 2,
    checks: Checks = Checks(),
    stream: TextIO | None = None,
    stop: bool = False,
) -> Summary:
    """Run all, with a line of progress and each violation as it is found, to stderr or `stream`.

    stop : at the first violation.
    """
    stream = stream or sys.stderr
    seeds = list(seeds)
    summary = Summary()
    started = last = time.monotonic()
    coming = soak(seeds, workers, checks)
    for result in coming:
        summary.add(result)
        if result.violations:
            print(result, file=stream, flush=True)
            if stop:
                coming.close()
                break
        now = time.monotonic()
        if now - last > 10.0:
            last = now
            left = (now - started) * (len(seeds) - summary.total) / summary.total
            print(
                f"{summary.total:,} of {len(seeds):,} runs, {len(summary.violations)} with a "
                f"violation, {left:.0f} s left",
                file=stream, flush=True,
            )  # fmt: skip
    return summary
