"""What is kept of the cases of a sweep: a row of each array a case."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rockeom.codes import (
    AT_THE_START,
    CONTACT,
    FULL,
    IMPACT,
    IMPACTS,
    LANDING,
    REFINED,
    STEPS,
    TIME,
)
from rockeom.integrator.program import Program
from rockeom.numbers.checks import numbers
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.simulate import simulate
from rockeom.sweeps.cases import Part

NOT_RUN = -1


@dataclass(frozen=True)
class Results:
    """What the compiled loop tells of n cases; threads write to rows of their own.

    outcome (n,) : a number of the contract, or NOT_RUN; it is written last.
    peaks (n, 2, N) : minimum and maximum of each state; times (n, k) : of the first impacts [s].
    gains (n, 2) : number of impacts that gained energy, and the sum of what they gained [J].
    """

    outcome: np.ndarray
    final_time: np.ndarray
    contact: np.ndarray
    impacts: np.ndarray
    refined: np.ndarray
    peaks: np.ndarray
    final: np.ndarray
    times: np.ndarray
    gains: np.ndarray

    @classmethod
    def empty(cls, n: int, states: int, times: int) -> Results:
        return cls(
            np.full(n, NOT_RUN, np.int64),
            np.full(n, np.nan),
            np.zeros(n, np.int64),
            np.zeros(n, np.int64),
            np.zeros(n, np.int64),
            np.full((n, 2, states), np.nan),
            np.full((n, states), np.nan),
            np.full((n, times), np.nan),
            np.zeros((n, 2)),
        )

    def run(
        self,
        part: Part,
        compiled: Program,
        options: SolverOptions,
        stop: threading.Event,
        lanes: bool = False,
    ) -> None:
        """Run a part and write its rows; those of motions that are stopped stay as not run.

        Lanes take other steps than the loop. Motions that came near `max_steps` in them are run
        anew by the loop, so that the limit ends them where it ends a single motion.
        """
        q, rows = part.problems, part.rows
        n, width = q.y0.shape
        final, peaks, rates = np.empty((n, width)), np.empty((n, 2, width)), np.empty((n, width))
        times, clock = np.empty((n, self.times.shape[1])), np.empty((n, 4))
        gains = np.empty((n, 2))
        status = np.empty((n, len(AT_THE_START)), np.int64)
        outcome = np.empty(n, np.int64)

        def begin(these: np.ndarray) -> None:
            final[these], peaks[these], rates[these] = q.y0[these], q.y0[these, None], 0.0
            times[these], gains[these] = np.nan, 0.0
            clock[these], outcome[these] = 0.0, FULL
            status[these] = AT_THE_START
            status[these, CONTACT] = q.mode[these]

        begin(np.full(n, True))
        state = status, clock, final, rates
        others = (
            q.horizontal, q.h_rows, q.vertical, q.v_rows, q.p, q.law, q.ratio, options.rtol,
            np.full(width, options.atol), options.max_step, options.steps_per_segment, q.fallen,
            options.rest_tolerance, options.max_impacts, options.max_steps, outcome, peaks, times,
            gains,
        )  # fmt: skip
        in_lanes = ended = 0
        try:
            if lanes:
                z, w = _aligned(compiled.Z_SIZE), np.full(compiled.W_SIZE, -1)
                call = compiled.integrate_lanes.bound(0, z, w, *state, q.end, q.quiet_from, *others)
                while in_lanes >= 0 and not stop.is_set():
                    call["first"] = in_lanes
                    in_lanes = call()
                if in_lanes < 0:
                    begin(status[:, STEPS] >= options.max_steps / 2)
            call = compiled.integrate_many.bound(0, *state, q.end, q.quiet_from, *others)
            while ended < n and not stop.is_set():
                call["first"] = ended
                ended = call()
        finally:
            ran = np.arange(n) < ended
            if lanes:  # what is left to find out is whether those that have ended fall
                ran = (outcome != FULL) | (clock[:, TIME] >= q.end)
                ends, quiet = np.where(ran, q.end, 0.0), np.where(ran, q.quiet_from, np.inf)
                compiled.integrate_many(0, *state, ends, quiet, *others)
            there = rows[ran]
            self.final[rows], self.peaks[rows] = final, peaks
            self.times[there], self.gains[there] = times[ran], gains[ran]
            self.final_time[there] = clock[ran, TIME]
            self.contact[there] = status[ran, CONTACT]
            self.impacts[there] = status[ran, IMPACTS]
            self.refined[there] = status[ran, REFINED]
            self.outcome[there] = outcome[ran]


@dataclass(frozen=True)
class Asked:
    """What needs whole responses of n cases.

    extremes (n, 2, m) and histories (n, m, k) : of m named quantities.
    impacts (n, i, 2, N) : states before and after each of the first impacts.
    """

    quantities: tuple[str, ...]
    times: np.ndarray
    options: SolverOptions
    extremes: np.ndarray
    histories: np.ndarray
    impacts: np.ndarray

    @classmethod
    def empty(
        cls,
        n: int,
        names: Sequence[str],
        times: Sequence[float] | np.ndarray,
        how: SolverOptions,
        impacts: int = 0,
        states: int = 0,
    ) -> Asked:
        if isinstance(names, str):
            raise ValueError(f"quantities is the word {names!r}: give a list of names")
        at, m = numbers("times", times), len(names)
        if at.size and not m:
            raise ValueError("`times` is given, but no `quantities` whose history is wanted")
        if not np.all(at >= 0.0):
            raise ValueError(f"times holds {at.min()}: give times from 0 on, in seconds")
        extremes, histories = np.full((n, 2, m), np.nan), np.full((n, m, at.size), np.nan)
        of_impacts = np.full((n, impacts, 2, states), np.nan)
        return cls(tuple(names), at, how, extremes, histories, of_impacts)

    def run(self, part: Part, stop: threading.Event) -> None:
        if not (self.quantities or self.impacts.size):
            return
        for row, case in zip(part.rows, part.cases, strict=True):
            if stop.is_set():
                return
            response = simulate(
                case.structure, case.motion, impact=case.impact, initial=case.initial,
                duration=case.duration, vertical=case.vertical, mode=case.mode,
                options=self.options,
            )  # fmt: skip
            _, kinds, states = response.events.columns
            found = states[np.isin(kinds[:, 0], (IMPACT, LANDING))][: self.impacts.shape[1]]
            self.impacts[row, : len(found)] = found
            if self.quantities:
                of_each = response.extremes_of(self.quantities).values()
                self.extremes[row] = np.array([(e.minimum, e.maximum) for e in of_each]).T
            if self.times.size:
                known = self.times <= response.t[-1]
                history = response.at(self.times[known], names=self.quantities)
                self.histories[row, :, known] = np.stack([*history.values()], axis=1)


@dataclass(frozen=True)
class Kept:
    """All that is kept of the cases: a row of each array a case."""

    results: Results
    asked: Asked

    def run(
        self,
        part: Part,
        compiled: Program,
        options: SolverOptions,
        stop: threading.Event,
        lanes: bool,
    ) -> None:
        self.asked.run(part, stop)
        self.results.run(part, compiled, options, stop, lanes)

    def arrays(self) -> dict[str, np.ndarray]:
        """By name."""
        asked = self.asked
        return vars(self.results) | {
            "extremes": asked.extremes,
            "histories": asked.histories,
            "impact_states": asked.impacts,
        }

    def put(self, rows: np.ndarray | slice, found: Mapping[str, np.ndarray]) -> None:
        """Write what was found of some rows elsewhere."""
        for name, array in self.arrays().items():
            array[rows] = found[name]


def _aligned(size: int) -> np.ndarray:
    """Zeros that begin where a line of the processor's cache does: no vector straddles two."""
    zeros = np.zeros(size + 8)
    first = -zeros.ctypes.data % 64 // zeros.itemsize
    return zeros[first : first + size]
