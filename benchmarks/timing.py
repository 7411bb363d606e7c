"""Times of several ways of doing the same work, taken in turns."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Times:
    """Time of one run in each turn [s]."""

    seconds: tuple[float, ...]

    @property
    def median(self) -> float:
        return statistics.median(self.seconds)

    @property
    def fastest(self) -> float:
        return min(self.seconds)

    def ratio_to(self, other: Times) -> float:
        """Median of the ratios turn by turn: what slows a whole turn down drops out."""
        turns = zip(self.seconds, other.seconds, strict=False)
        return statistics.median(mine / theirs for mine, theirs in turns)


def in_turns(
    runs: Mapping[str, Callable[[], object]],
    turns: int,
    *,
    shortest: float = 0.02,
    clock: Callable[[], float] = time.process_time,
) -> dict[str, Times]:
    """Run everything once in every turn, after one run that is not counted.

    clock : that of the process by default, so that what else runs on the machine counts less.
    A run shorter than `shortest` [s] is repeated to fill it.
    """
    repeats = {}
    for name, run in runs.items():
        run()
        started = clock()
        run()
        repeats[name] = max(1, round(shortest / max(clock() - started, 1e-6)))
    seconds: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(turns):
        for name, run in runs.items():
            started = clock()
            for _ in range(repeats[name]):
                run()
            seconds[name].append((clock() - started) / repeats[name])
    return {name: Times(tuple(s)) for name, s in seconds.items()}
