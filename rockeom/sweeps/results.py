"""Results of the cases of a sweep: a row of each array a case."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rockeom.codes import AT_THE_START, FULL, IMPACTS, MODE, REFINED, STEPS, TIME
from rockeom.integrator import records
from rockeom.integrator.program import Program
from rockeom.simulation.case import Case, Problems
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.simulate import simulate
from rockeom.sweeps.cases import Batch
from rockeom.sweeps.task import Task

NOT_RUN = -1
"""The value in place of the number of an outcome, of a case that was not run."""


@dataclass(frozen=True, eq=False)
class Results:
    """Arrays of n cases; threads write to rows of their own.

    By the compiled loop: outcome (n,) : its number, or NOT_RUN; it is written last. peaks (n, 2, N)
    : minimum and maximum of each state; times (n, k) : of the first impacts [s]. gains (n, 2) :
    number of impacts that gained energy, and the sum of their gains [J].

    By whole responses: extremes (n, 2, m) and histories (n, m, h) of m named quantities;
    impact_states (n, i, 2, N) : states before and after each of the first impacts.
    """

    outcome: np.ndarray
    final_time: np.ndarray
    mode: np.ndarray
    impacts: np.ndarray
    refined: np.ndarray
    peaks: np.ndarray
    final: np.ndarray
    times: np.ndarray
    gains: np.ndarray
    extremes: np.ndarray
    histories: np.ndarray
    impact_states: np.ndarray

    @classmethod
    def of(cls, task: Task, n: int, states: int) -> Results:
        """Empty ones of a task, for n cases with so many states."""
        m, h = len(task.quantities), len(task.times)
        return cls.empty(n, states, task.impact_times, task.impact_states, m, h)

    @classmethod
    def empty(
        cls, n: int, states: int, times: int = 0, with_states: bool = False, m: int = 0, h: int = 0
    ) -> Results:
        """Empty results of n cases: so many states, `times` impacts, m quantities at h times."""
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
            np.full((n, 2, m), np.nan),
            np.full((n, m, h), np.nan),
            np.full((n, times * with_states, 2, states), np.nan),
        )

    def arrays(self) -> dict[str, np.ndarray]:
        """The arrays by name."""
        return vars(self)

    def put(self, rows: np.ndarray | slice, values: Mapping[str, np.ndarray]) -> None:
        """Write results of some rows that another process found."""
        for name, array in self.arrays().items():
            array[rows] = values[name]

    def run(self, batch: Batch, compiled: Program, task: Task, stop: threading.Event) -> None:
        """Run a batch and write its rows, whole responses first: the outcome tells that all is."""
        if task.needs_responses:
            self._respond(batch, task, stop)
        self.integrate(batch, compiled, task.options, stop, task.lanes)

    def _respond(self, batch: Batch, task: Task, stop: threading.Event) -> None:
        for row, case in zip(batch.rows, batch.cases, strict=True):
            if stop.is_set():
                return
            try:
                self._respond_to(case, row, task)
            except Exception as error:
                if batch.of is not None:
                    batch.of.name(error, batch.of.named(row))
                raise

    def _respond_to(self, case: Case, row: int, task: Task) -> None:
        response = simulate(case, options=task.options)
        states = response.impacts.columns.states[: self.impact_states.shape[1]]
        self.impact_states[row, : len(states)] = states
        if task.quantities:
            of_each = response.extremes_of(task.quantities).values()
            self.extremes[row] = np.array([(e.minimum, e.maximum) for e in of_each]).T
        if task.times.size:
            reached = task.times <= response.t[-1]
            history = response.at(task.times[reached], names=task.quantities)
            self.histories[row, :, reached] = np.stack([*history.values()], axis=1)

    def integrate(
        self,
        batch: Batch,
        compiled: Program,
        options: SolverOptions,
        stop: threading.Event,
        lanes: bool = False,
    ) -> None:
        """Run a batch and write its rows; those of motions that are stopped stay as not run.

        Lanes take other steps than the loop. Motions that came near `max_steps` in them are run
        again by the loop, so that the limit ends them where it ends a single motion.
        """
        q, rows = batch.problems, batch.rows
        n, m = len(q.y0), _motions(q, options, self.times.shape[1])

        def begin(these: np.ndarray) -> None:
            m.states[these], m.extremes[these] = q.y0[these], q.y0[these, None]
            m.rates[these], m.impact_times[these], m.gains[these] = 0.0, np.nan, 0.0
            m.clock[these], m.outcome[these] = 0.0, FULL
            m.status[these] = AT_THE_START
            m.status[these, MODE] = q.mode[these]

        begin(np.full(n, True))
        in_lanes = ended = 0
        try:
            if lanes:
                z, w = _aligned(compiled.Z_SIZE), np.full(compiled.W_SIZE, -1)
                call = compiled.integrate_lanes.bound(0, z, w, *m)
                while in_lanes >= 0 and not stop.is_set():
                    call["first"] = in_lanes
                    in_lanes = call()
                if in_lanes < 0:
                    begin(m.status[:, STEPS] >= options.max_steps / 2)
            call = compiled.integrate_many.bound(0, *m)
            while ended < n and not stop.is_set():
                call["first"] = ended
                ended = call()
        finally:
            ran = np.arange(n) < ended
            if lanes:  # whether those that have ended fall is still open
                ran = (m.outcome != FULL) | (m.clock[:, TIME] >= q.end)
                ends, quiet = np.where(ran, q.end, 0.0), np.where(ran, q.quiet_from, np.inf)
                compiled.integrate_many(0, *m._replace(t_end=ends, quiet_from=quiet))
            there = rows[ran]
            self.final[rows], self.peaks[rows] = m.states, m.extremes
            self.times[there], self.gains[there] = m.impact_times[ran], m.gains[ran]
            self.final_time[there] = m.clock[ran, TIME]
            self.mode[there] = m.status[ran, MODE]
            self.impacts[there] = m.status[ran, IMPACTS]
            self.refined[there] = m.status[ran, REFINED]
            self.outcome[there] = m.outcome[ran]


def _motions(q: Problems, options: SolverOptions, impacts: int) -> records.Batch:
    """Motions as the loop takes them, with room for their results and their first impacts."""
    n, width = q.y0.shape
    return records.Batch(
        status=np.empty((n, len(AT_THE_START)), np.int64), clock=np.empty((n, 4)),
        states=np.empty((n, width)), rates=np.empty((n, width)), t_end=q.end,
        quiet_from=q.quiet_from, horizontal=q.horizontal, h_rows=q.h_rows, transverse=q.transverse,
        t_rows=q.t_rows, vertical=q.vertical, v_rows=q.v_rows, p=q.p, law=q.law, ratio=q.ratio,
        rtol=options.rtol, atol=np.full(width, options.atol), h_max=options.max_step,
        fixed=options.steps_per_segment, fallen=q.fallen, rest_tolerance=options.rest_tolerance,
        max_impacts=options.max_impacts, max_steps=options.max_steps,
        outcome=np.empty(n, np.int64), extremes=np.empty((n, 2, width)),
        impact_times=np.empty((n, impacts)), gains=np.empty((n, 2)),
    )  # fmt: skip


def _aligned(size: int) -> np.ndarray:
    """Zeros that begin where a line of the processor's cache does: no vector straddles two."""
    zeros = np.zeros(size + 8)
    first = -zeros.ctypes.data % 64 // zeros.itemsize
    return zeros[first : first + size]
