"""Workers of a sweep: threads of this process, or an executor."""

from __future__ import annotations

import asyncio
import pickle
import queue
import sys
import threading
import time
import traceback
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any

import numpy as np

from rockeom.integrator.program import program, revision
from rockeom.numbers.checks import described
from rockeom.sweeps.cases import Cases, Source, first_of
from rockeom.sweeps.results import Results
from rockeom.sweeps.task import Task

AGAIN = 3
"""Number of times that an executor receives a chunk again that it did not run."""


def run_apart(task: Task, cases: Cases) -> dict[str, np.ndarray] | Exception:
    """Results of a table of cases, run in the process of the caller, which is an executor's.

    The exception of a case is returned, since those that a future raises are the executor's.
    """
    try:
        return _results_of(task, cases).arrays()
    except Exception as error:
        trace = traceback.format_exc()
        try:
            pickle.loads(pickle.dumps(error))
        except Exception:  # an exception that needs more arguments than it keeps, for example
            error = RuntimeError(f"{type(error).__name__}: {error}")
        error.add_note(trace)
        return error


def _results_of(task: Task, cases: Cases) -> Results:
    module = first_of(task.case, cases).structure.module
    method = task.options.method
    assert method is not None
    if revision(module, method, task.lanes) != task.revision:
        raise RuntimeError(
            f"a worker has another {module.NAME}, or another version of rockeom, than who asks: "
            "install the same everywhere"
        )
    compiled, stop = program(module, method, task.lanes), threading.Event()
    results = Results.of(task, cases.total, module.N_STATES)
    for batch in task.source(cases, module, chunk=None):
        results.run(batch, compiled, task, stop)
    return results


def in_executor(
    executor: Any,
    task: Task,
    cases: Cases,
    chunks: Sequence[np.ndarray],
    results: Results,
    done: Callable[[np.ndarray], None],
) -> None:
    """Workers run chunks of rows until all are done; their results are put into `results` here.

    A chunk that the executor cancels, loses with a worker or fails to run for any other reason is
    submitted again, AGAIN times. Raises what a case raises, or the last error of the executor; its
    notes say whose it is and what is left to do.
    """
    ended: queue.SimpleQueue[tuple[int, Any]] = queue.SimpleQueue()
    under_way: dict[int, Any] = {}
    times: Counter[int] = Counter()
    lost: dict[int, BaseException] = {}

    def submit(i: int) -> None:
        while times[i] <= AGAIN:
            times[i] += 1
            try:
                under_way[i] = future = executor.submit(run_apart, task, cases.part(chunks[i]))
            except Exception as error:
                lost[i] = error
            else:
                future.add_done_callback(lambda future: ended.put((i, future)))
                return

    try:
        for i in range(len(chunks)):
            submit(i)
        while under_way:
            try:  # an interrupt is answered in time, also where nothing ends a wait
                i, future = ended.get(timeout=0.2)
            except queue.Empty:
                continue
            del under_way[i]
            try:
                answer = future.result()
                if not isinstance(answer, dict | Exception):
                    raise TypeError(f"a future gives {described(answer)} and no results")
            except (Exception, asyncio.CancelledError) as error:
                lost[i] = error
                submit(i)
                continue
            if isinstance(answer, Exception):
                answer.add_note(f"{_rows(chunks[i])} of the sweep, run by {described(executor)}")
                raise answer
            lost.pop(i, None)
            results.put(chunks[i], answer)
            done(chunks[i])
    finally:
        for future in under_way.values():
            future.cancel()
    if lost:
        raise _of_executor(executor, task, lost, chunks)


def _of_executor(
    executor: Any, task: Task, lost: Mapping[int, BaseException], chunks: Sequence[np.ndarray]
) -> BaseException:
    """The first error of an executor, with notes on whose it is and the chunks not run."""
    error = lost[min(lost)]
    error.add_note(
        f"raised by {described(executor)} itself, and by no case, in each of {AGAIN + 1} tries to "
        f"run {', '.join(_rows(chunks[i]) for i in sorted(lost)[:5])}"
        f"{', ...' if len(lost) > 5 else ''}. Give another executor; with store=... the call "
        "then does only what is missing"
    )
    try:
        pickle.dumps(task)
    except type(error):  # the same error: its class and its words vary with the version of Python
        error.add_note(
            "what goes to another process must be picklable: let the function stand at the top "
            "level of a module"
        )
    return error


def _rows(chunk: np.ndarray) -> str:
    return f"cases {chunk[0]} to {chunk[-1]}"


def in_threads(
    threads: int,
    source: Source,
    run: Callable[..., None],
    done: Callable[[np.ndarray], None],
) -> None:
    """Threads make a batch in turn, and run it, until all are done or `stop` is set.

    Making holds Python's lock and running does not: while one thread makes, the others run. One
    thread is the caller's own.
    """
    batches = iter(source)
    turn, stop = threading.Lock(), threading.Event()

    def worker() -> None:
        ran = None
        while True:
            with turn:
                if ran is not None:
                    done(ran)
                batch = None if stop.is_set() else next(batches, None)
            if batch is None:
                return
            run(batch, stop=stop)
            ran = batch.rows

    if threads == 1:
        worker()
        return
    with ThreadPoolExecutor(threads) as pool:
        try:
            running = {pool.submit(worker) for _ in range(threads)}
            while running:
                # an interrupt that comes just as a wait begins is answered when the wait is over
                ended, running = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
                for one in ended:
                    one.result()
        finally:
            stop.set()  # no more work for the others


class Progress:
    """A line on stderr: how many are done, and how long the rest will take."""

    def __init__(self, total: int, shown: bool, of: str = "motions") -> None:
        self.total, self.shown, self.of, self.done = total, shown, of, 0
        self.started = self.last = time.monotonic()

    def __enter__(self) -> Progress:
        return self

    def add(self, n: int) -> None:
        self.done += n
        now = time.monotonic()
        if self.shown and now - self.last > 0.2:
            self.last = now
            left = (now - self.started) * (self.total - self.done) / self.done
            sys.stderr.write(f"\r{self.done:,} of {self.total:,} {self.of}, {left:.0f} s left ")
            sys.stderr.flush()

    def __exit__(self, *_: object) -> None:
        if self.shown:
            took = time.monotonic() - self.started
            sys.stderr.write(f"\r{self.done:,} of {self.total:,} {self.of} in {took:.1f} s.\n")
