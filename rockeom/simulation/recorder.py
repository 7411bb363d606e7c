"""Recorders of a motion: of all of its steps, or of samples and extremes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from rockeom.integrator.program import say
from rockeom.simulation.events import EventColumns
from rockeom.simulation.extremes import Extremes, Running
from rockeom.simulation.steps import Evaluate, Rows, Steps

ALL, SAMPLES = KEEP = ("all", "samples")
"""The parts of a motion that `simulate` may keep."""

_MANY = 100_000  # steps from which a line on stderr says how far it is, at each power of ten


@dataclass(frozen=True, eq=False)
class Samples:
    """A motion at some times: t (n,) [s], states y (n, N), mode (n,), and its extremes by name."""

    t: np.ndarray
    y: np.ndarray
    mode: np.ndarray
    extremes: Mapping[str, Extremes]


class Recorder(Protocol):
    """Takes the steps of a motion as they are made."""

    def add(self, steps: Steps) -> None:
        """Take the next steps; their arrays are used again afterwards."""

    def __len__(self) -> int:
        """Number of steps so far."""


class DenseRecorder:
    """Keeps every step, in bytes that grow in their place: no array is in memory twice."""

    def __init__(self) -> None:
        self.n = 0
        self.columns = bytearray(), bytearray(), bytearray()

    def __len__(self) -> int:
        return self.n

    def add(self, steps: Steps) -> None:
        self.n += len(steps)
        rows = steps.span, steps.mode, steps.powers
        for column, more in zip(self.columns, rows, strict=True):
            column.extend(more.data)

    def record(self, _: EventColumns) -> Steps:
        span, mode, powers = map(np.frombuffer, self.columns, (float, np.int64, float))
        return Steps(span.reshape(self.n, 2), mode, powers.reshape(self.n, 8, -1))


class SampleRecorder:
    """Keeps the states at equal times, and the extremes that are found within the steps.

    spacing : of the samples [s]. names, evaluate : of the quantities whose extremes are found.
    """

    def __init__(self, spacing: float, names: Sequence[str], evaluate: Evaluate) -> None:
        self.n, self.taken, self.told_at = 0, 0, _MANY
        self.spacing = min(spacing, 1e300)  # infinite: the start, the events and the end
        self.names, self.running = names, Running(evaluate)
        self.held: Steps | None = None  # the last step: up to where it counts the next one tells
        self.rows: list[Rows] = []

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
            if self.n >= self.told_at:
                self.told_at *= 10
                say(f"keep='samples' has searched {self.n:,} steps, up to {after:.4g} s")
        self.held = whole[np.array([last])]  # a copy

    def _sample(self, steps: Steps, end: float) -> None:
        """Keep the states at all times before `end` that were not reached yet."""
        numbers = np.arange(self.taken, int(np.ceil(end / self.spacing)) + 1)
        t = self.spacing * numbers
        t = t[t < end]
        self.taken += len(t)
        self.rows.append(Rows(t, *steps.at(t, "right")))

    def record(self, events: EventColumns) -> Samples:
        """The samples, with the end and both sides of every event; the extremes."""
        assert self.held is not None
        end = float(self.held.span[0].sum())
        self.running.add(self.held)
        self._sample(self.held, end)
        self.rows.append(Rows(np.array([end]), *self.held.at(np.array([end]), "right")))
        t, y, mode = map(np.concatenate, zip(*self.rows, strict=True))
        times, kinds, states = events
        plain = ~np.isin(t, times)
        t = np.concatenate([t[plain], np.repeat(times, 2)])
        y = np.concatenate([y[plain], states.reshape(-1, y.shape[1])])
        mode = np.concatenate([mode[plain], kinds[:, 1:3].ravel()])
        order = np.argsort(t, kind="stable")
        extremes = dict(zip(self.names, self.running.found(), strict=True))
        return Samples(t[order], y[order], mode[order], extremes)
