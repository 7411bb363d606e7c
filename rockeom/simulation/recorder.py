"""What is kept of a motion: all of its steps, or samples of it, and how they are gathered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from rockeom.simulation.extremes import Evaluate, Extremes, Running
from rockeom.simulation.steps import Steps

ALL, SAMPLES = KEPT = ("all", "samples")
"""What `simulate` may be told to keep."""

_DOUBLED = 4096  # steps up to which a full record doubles; then it grows by so many, or an eighth


@dataclass(frozen=True)
class Samples:
    """A motion at some times: t (n,) [s], states (n, N), contact (n,), and its extremes by name."""

    t: np.ndarray
    y: np.ndarray
    contact: np.ndarray
    extremes: Mapping[str, Extremes]


Passages = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Times (k,), kinds (k, 4) with contact states before and after and the guard, states (k, 2, N)."""


class Gathering(Protocol):
    """What takes the steps of a motion as they are made."""

    def add(self, steps: Steps) -> None:
        """Takes the next steps; their arrays are used again afterwards."""

    def __len__(self) -> int:
        """How many steps there were."""


class AllSteps:
    """Keeps every step, in arrays that grow in their place: none is in memory twice."""

    def __init__(self) -> None:
        self.n = 0
        self.arrays: tuple[np.ndarray, ...] = ()

    def __len__(self) -> int:
        return self.n

    def add(self, steps: Steps) -> None:
        new, first, self.n = (steps.span, steps.contact, steps.powers), self.n, self.n + len(steps)
        if not first:
            self.arrays = tuple(a.copy() for a in new)
            return
        for array, more in zip(self.arrays, new, strict=True):
            if self.n > len(array):
                _resize(array, max(self.n, first + max(first // 8, min(first, _DOUBLED))))
            array[first : self.n] = more

    def record(self, _: Passages) -> Steps:
        for array in self.arrays:
            _resize(array, self.n)
        return Steps(*self.arrays)


def _resize(array: np.ndarray, n: int) -> None:
    """Change the length in place; nobody else holds the array, or a view of it."""
    if len(array) != n:
        array.resize((n, *array.shape[1:]), refcheck=False)


class SomeSamples:
    """Keeps the states at equal times, and the extremes that are found within the steps.

    spacing : of the samples [s]. names, evaluate : of the quantities whose extremes are found.
    """

    def __init__(self, spacing: float, names: Sequence[str], evaluate: Evaluate) -> None:
        self.n = self.taken = 0
        self.spacing = min(spacing, 1e300)  # infinite: the start, the events and the end
        self.names, self.running = names, Running(evaluate)
        self.held: Steps | None = None  # the last step: up to where it counts the next one tells
        self.found: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []

    def __len__(self) -> int:
        return self.n

    def add(self, steps: Steps) -> None:
        if not len(steps):
            return
        self.n += len(steps)
        whole = steps if self.held is None else self.held.joined(steps)
        last = len(whole) - 1
        if last > 0:
            after = float(whole.span[last, 0])
            self.running.add(whole[:last], after)
            self._sample(whole[:last], after)
        self.held = whole[np.array([last])]  # a copy

    def _sample(self, steps: Steps, end: float) -> None:
        """Keep the states at all times before `end` that were not reached yet."""
        numbers = np.arange(self.taken, int(np.ceil(end / self.spacing)) + 1)
        t = self.spacing * numbers
        t = t[t < end]
        self.taken += len(t)
        self.found.append((t, *steps.at(t, "right")))

    def record(self, passages: Passages) -> Samples:
        """The samples, with the end and both sides of every passage; the extremes."""
        assert self.held is not None
        end = float(self.held.span[0].sum())
        self.running.add(self.held)
        self._sample(self.held, end)
        self.found.append((np.array([end]), *self.held.at(np.array([end]), "right")))
        t, y, contact = map(np.concatenate, zip(*self.found, strict=True))
        times, kinds, states = passages
        plain = ~np.isin(t, times)
        t = np.concatenate([t[plain], np.repeat(times, 2)])
        y = np.concatenate([y[plain], states.reshape(-1, y.shape[1])])
        contact = np.concatenate([contact[plain], kinds[:, 1:3].ravel()])
        order = np.argsort(t, kind="stable")
        extremes = dict(zip(self.names, self.running.found(), strict=True))
        return Samples(t[order], y[order], contact[order], extremes)
