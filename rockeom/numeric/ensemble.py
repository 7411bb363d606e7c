"""Many motions at once, on all cores, keeping only what is asked for."""

from __future__ import annotations

import inspect
import math
import os
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace
from functools import cached_property
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from rockeom import hooks
from rockeom.arguments import is_number, numbers, told, whole_number
from rockeom.contract import AT_THE_START, CONTACT, FULL, IMPACT, IMPACTS, REFINED, TIME
from rockeom.many import Differs, Many
from rockeom.numeric.case import Case, Problem, Problems
from rockeom.numeric.choice import DEFAULT, Choice, chosen
from rockeom.numeric.options import SolverOptions
from rockeom.numeric.program import Program, program
from rockeom.numeric.response import Outcome
from rockeom.numeric.simulate import simulate

_OUTCOMES = tuple(Outcome)
NOT_RUN = -1

FEW, MANY = 256, 2048
"""Cases that a thread takes at a time, at most: made one by one, and where made at once."""

LAST_FEW, LAST_MANY = 32, 256
"""And in the end, at least. A part costs what some 60 pulses do: the lanes run empty behind it."""

WORTHWHILE = 8
"""So many cases are made faster at once than one by one."""


_RENAMED = {
    old + of: (f"maximum{of}" if old == "largest" else f"minimum{of}", f"peak{of}")
    for old in ("largest", "smallest")
    for of in ("", "_quantity")
}
"""Former names of variables: the present one, and that of the largest absolute value."""


class Sweep(xr.Dataset):
    """The dataset of `simulate_many`. It knows the former names of its variables, and says so."""

    __slots__ = ()

    def __getitem__(self, key: Any) -> Any:
        for name in key if isinstance(key, list) else [key]:
            if isinstance(name, str) and name in _RENAMED and name not in self.variables:
                raise KeyError(_renamed(name))
        return super().__getitem__(key)

    def __getattr__(self, name: str) -> Any:
        if name in _RENAMED and name not in self.variables:
            raise AttributeError(_renamed(name))
        return super().__getattr__(name)

    def _repr_html_(self) -> str:
        return hooks.html_of(self)


def _renamed(name: str) -> str:
    signed, peak = _RENAMED[name]
    return (
        f"{name!r} is now {signed!r}, which has a sign as before; the largest absolute value is "
        f"{peak!r}"
    )


def simulate_many(
    case: Callable[..., Case],
    over: Mapping[str, Sequence[Any] | np.ndarray],
    *,
    arrays: bool = False,
    impact_times: int = 0,
    options: SolverOptions | None = None,
    threads: int | None = None,
    chunk: int | None = None,
    progress: bool | None = None,
    lanes: bool | None = None,
    quantities: Sequence[str] = (),
    times: Sequence[float] | np.ndarray = (),
) -> Sweep:
    """Simulate every combination of the values in `over`, labelled by them.

        def pulse(frequency, amplitude):
            sine = rk.GroundMotion.single_sine(amplitude, 1 / frequency, duration=8.0)
            return rk.Case(block, sine)

        rk.simulate_many(
            pulse,
            over={"frequency": np.linspace(0.5, 4, 100), "amplitude": np.linspace(1, 8, 100)},
            arrays=True,
        )

    case : makes one case from one value of each name in `over`. All cases are of one model. The
        threads call it in turn, never two at a time.
    arrays : the function is called for many cases at once. Each argument is an object that
        calculates like a number and holds the values of all of them, and so is what the function
        makes of it: a structure, a pulse, a start, a law. That takes a microsecond or two a case
        where a call for each takes tens, and gives the same results to the last bit. What the
        function returns must follow from its arguments alone. Where the cases do not go the same
        way (`if amplitude > 3`), or one number is asked for (`math.sin(x)`, a record scaled by x),
        it is called again for those that do; `np.sin(x)` is of all at once. Values that are no
        numbers, such as motions, it gets one by one.
    impact_times : how many impact times of each case to keep.
    threads : all cores if not given. The result is the same to the last bit for any number of
        threads and any `chunk`, the number of cases that a thread takes at a time: if not given,
        ever fewer towards the end, so that no thread waits long for another.
    options : as of `simulate`. Where they name no method, the first case chooses that of all, and
        `attrs` has it under "method", and why under "chosen".
    progress : a line on stderr; if not given, where stderr is a terminal.
    lanes : many motions at once in the vectors of the processor, up to several times as fast: if
        not given, with explicit methods for all structures on rigid ground and on two springs, as
        `lanes_pay` says. Impact times agree with those without lanes within the tolerances, and
        results are the same to the last bit for any number and order of the cases. False integrates
        one motion after the other, as `simulate` does, to the same bits.
    quantities : what else to keep of each case, by the names of a response ("theta",
        "displacement", "left_uplift", ...): peak_quantity, maximum_quantity and minimum_quantity,
        found within the steps, and, at the `times` [s] given, their history (nan behind the end).
        Each case is then also made and simulated by itself, with its whole response, which takes
        much longer.

    Returns a dataset over the names in `over`: outcome (a label; "not run" after an interrupt),
    final_time [s], final_phase, impacts, refined (segments of the ground in which equal steps would
    have been too long), peak, maximum, minimum and final value of each state, and impact_time (nan
    where there was none). maximum and minimum have a sign, peak is the larger of their sizes; they
    are found within the steps. Memory is bounded by the dataset. A keyboard
    interrupt ends the work early: what is done is returned, `attrs["interrupted"]` is 1.

    Raises ValueError, with the case, for what cannot be simulated, with `lanes` or at all.
    """
    options = SolverOptions.of(options)
    values = _values(over)
    if not callable(case) or isinstance(case, Case):
        raise TypeError(
            f"case is {told(case)}: give a function that makes a case, such as "
            f"lambda {', '.join(values)}: rk.Case(structure, motion)"
        )
    try:
        inspect.signature(case).bind(**values)
    except TypeError as error:
        raise TypeError(
            f"over has {', '.join(values)}, and the function of the sweep takes others: {error}"
        ) from None
    except ValueError:  # a function in C may not tell what it takes
        pass
    threads = (os.cpu_count() or 1) if threads is None else whole_number("threads", threads, 1)
    impact_times = whole_number("impact_times", impact_times, 0)
    shape = tuple(len(v) for v in values.values())
    total = int(np.prod(shape))
    if chunk is not None:
        chunk = whole_number("chunk", chunk, 1)

    first = _made(case, {name: v[0] for name, v in values.items()})
    module = first.structure.module
    method, because = _method(first, options)
    options = replace(options, method=method)
    lanes = _in_lanes(lanes, module, method)
    compiled = program(module, method, lanes)
    results = _Results.empty(total, module.N_STATES, impact_times)
    asked = _Asked.empty(total, quantities, times, options)

    def run(part: Part, stop: threading.Event) -> None:
        asked.run(part, stop)
        results.run(part, compiled, options, stop, lanes)

    interrupted = False
    with _Progress(total, sys.stderr.isatty() if progress is None else progress) as shown:
        try:
            _in_threads(
                threads,
                _Source(case, values, chunk, module, arrays and not asked.quantities, threads),
                run,
                shown.add,
            )
        except KeyboardInterrupt:
            interrupted = True
    dataset = results.dataset(values, module, asked.variables(values))
    dataset.attrs.update(
        model=module.NAME, method=method, chosen=because, interrupted=int(interrupted)
    )
    return dataset


class Part(NamedTuple):
    """Cases that a thread runs at a time, and their rows in the results.

    cases : where they were made one by one; else none.
    """

    rows: np.ndarray
    problems: Problems
    cases: list[Case]


@dataclass(frozen=True)
class _Source:
    """Makes the cases part by part, when they are needed, so that none wait in memory."""

    case: Callable[..., Case]
    values: Mapping[str, list[Any]]
    chunk: int | None
    module: ModuleType
    arrays: bool
    threads: int = 1

    def __iter__(self) -> Iterator[Part]:
        first, total = 0, math.prod(map(len, self.values.values()))
        while first < total:
            rows = np.arange(first, min(first + self.size(total - first), total))
            yield from self.together(rows) if self.arrays else (self.one_by_one(rows),)
            first += len(rows)

    def size(self, left: int) -> int:
        """How many cases a thread takes of those that are left.

        Half of its share at first and ever fewer, but not so few that there are many parts. Cases
        may take ten times as long as others, and those that do often come last: whoever finds no
        more waits for the last part of another.
        """
        if self.chunk is not None:
            return self.chunk
        least, most = (LAST_MANY, MANY) if self.arrays else (LAST_FEW, FEW)
        if self.threads == 1:
            return most
        half, total = 2 * self.threads, math.prod(map(len, self.values.values()))
        return max(min(left // half, most), min(least, -(-total // half)))

    def places(self, rows: np.ndarray) -> tuple[np.ndarray, ...]:
        """Of each name, which of its values the rows have."""
        return np.unravel_index(rows, tuple(map(len, self.values.values())))

    def one_by_one(self, rows: np.ndarray) -> Part:
        points = zip(*(place.tolist() for place in self.places(rows)), strict=True)
        made = [self.made(point) for point in points]
        return Part(rows, Problems.of([q for _, q in made]), [case for case, _ in made])

    def together(self, rows: np.ndarray) -> Iterator[Part]:
        """As many at once as go the same way; raises what the first case does that cannot be."""
        try:
            yield from self.alike(rows)
        except Exception:  # of a case, but of which?
            for part in _few(rows):
                self.one_by_one(part)
            raise

    def alike(self, rows: np.ndarray) -> Iterator[Part]:
        waiting = [rows]
        while waiting:
            rows, problems = waiting.pop(), None
            try:
                if len(rows) >= WORTHWHILE:
                    problems = self.at_once(rows)
            except Differs as ways:
                waiting += [rows[part] for part in ways.parts]
                continue
            except Exception:  # is told by a case that raises it, if there is one
                problems = None
            if problems is None:
                yield from map(self.one_by_one, _few(rows))
            else:
                yield Part(rows, problems, [])

    def at_once(self, rows: np.ndarray) -> Problems:
        """Raises Differs where the rows do not all go the same way, or what one of them would."""
        named = {}
        for (name, values), place in zip(self.values.items(), self.places(rows), strict=True):
            if name in self.numbers:
                named[name] = Many(self.numbers[name][place])
            else:
                named[name] = values[Many(place).one()]
        with np.errstate(divide="raise", over="raise", invalid="raise"):
            _, problem = self.problem(named)
            return Problems.of_many(problem, len(rows))

    @cached_property
    def numbers(self) -> dict[str, np.ndarray]:
        """The values of those names that have numbers only."""
        return {
            name: Many.of(values).values
            for name, values in self.values.items()
            if all(is_number(value) for value in values)
        }

    def made(self, point: tuple[int, ...]) -> tuple[Case, Problem]:
        """One case and its numbers; what goes wrong in making it says which one it was."""
        named = {name: v[i] for (name, v), i in zip(self.values.items(), point, strict=True)}
        try:
            return self.problem(named)
        except Exception as error:
            error.add_note(f"in the case {', '.join(f'{k} = {v}' for k, v in named.items())}")
            raise

    def problem(self, named: Mapping[str, Any]) -> tuple[Case, Problem]:
        case = _made(self.case, named)
        if case.structure.module is not self.module:
            raise ValueError(
                f"a case is a {case.structure.module.NAME}, the first one a "
                f"{self.module.NAME}: simulate each model by itself"
            )
        return case, case.problem()


def _few(rows: np.ndarray) -> list[np.ndarray]:
    return np.split(rows, range(FEW, len(rows), FEW))


def _values(over: Any) -> dict[str, list[Any]]:
    """The values of each name of a sweep; raises TypeError or ValueError where there are none."""
    if not isinstance(over, Mapping):
        raise TypeError(
            f"over is {told(over)}: give names with their values, as in "
            '{"frequency": [0.5, 1.0, 2.0]}'
        )
    for name, values in over.items():
        if not isinstance(name, str):
            raise TypeError(f"over has the name {told(name)}: give an argument of the function")
        one = isinstance(values, str) or getattr(values, "ndim", 1) == 0
        if one or not isinstance(values, Iterable):
            raise TypeError(f"over has {name} = {told(values)}: give a list of values")
    found = {name: list(values) for name, values in over.items()}
    if not found or not all(found.values()):
        raise ValueError("`over` is empty: give at least one name with at least one value")
    return found


def _made(case: Callable[..., Case], named: Mapping[str, Any]) -> Case:
    """What the function makes of one value of each name; raises TypeError for what is no case."""
    made = case(**named)
    if not isinstance(made, Case):
        raise TypeError(
            f"the function of the sweep returned {told(made)}: "
            "let it return a case, rk.Case(structure, motion)"
        )
    return made


MOST_CONTACTS = 4
"""Of a structure in lanes, which find in every step what each contact state would do."""


def lanes_pay(module: ModuleType) -> bool:
    """Whether sweeps step in lanes where it is left open, by the structure alone.

    They do where an impact ends a contact state, and nothing else, or no impact does, and where the
    rotation alone may fall. Others have been measured, the time of lanes in that of one motion
    after the other: 0.7 to 1.0 for the cart on two springs; for walls 0.6 to 1.5, and 4 to 15 s
    more of compiling; 2 to 2.5 for the block of Dirac pulses. Most of their steps end at events,
    and lanes find in each what every contact state would do.
    """
    return (
        not module.NARROW
        and not module.N_FALLS
        and len(module.CONTACTS) <= MOST_CONTACTS
        and all(
            kinds[:guards] == (IMPACT,) or IMPACT not in kinds[:guards]
            for guards, kinds in zip(module.GUARDS, module.KINDS, strict=True)
        )
    )


def _method(case: Case, options: SolverOptions) -> Choice:
    """The method of all cases, chosen by the first where none is named."""
    if options.method is not None:
        return Choice(options.method, "named")
    try:
        method, because = chosen(case.structure, case.problem(), options)
    except Exception:  # is told when the case is run, with its values
        method, because = DEFAULT
    return Choice(method, f"{because}, by the first case")


def _in_lanes(lanes: bool | None, module: ModuleType, method: str) -> bool:
    """Whether a sweep steps in lanes, as asked or by its structure and method."""
    pay, explicit = lanes_pay(module), method != "Radau"
    if lanes is None:
        return pay and explicit
    if lanes and not pay:
        raise ValueError(
            f"lanes gain too little for {module.NAME}, whose contact states change too often: "
            "leave lanes=True out"
        )
    if lanes and not explicit:
        raise ValueError("lanes know no implicit method: choose 'DOP853' or 'RK45'")
    return bool(lanes)


def _in_threads(
    threads: int,
    source: _Source,
    work: Callable[[Part, threading.Event], None],
    done: Callable[[int], None],
) -> None:
    """Threads make a part in turn, and run it, until all are done or `stop` is set.

    Making holds Python's lock and running does not: while one thread makes, the others run. One
    thread is the caller's own.
    """
    parts = iter(source)
    turn, stop = threading.Lock(), threading.Event()

    def worker() -> None:
        ran = 0
        while True:
            with turn:
                if ran:
                    done(ran)
                made = None if stop.is_set() else next(parts, None)
            if made is None:
                return
            work(made, stop)
            ran = len(made.rows)

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


@dataclass(frozen=True)
class _Results:
    """One row a case; threads write to rows of their own."""

    outcome: np.ndarray
    final_time: np.ndarray
    contact: np.ndarray
    impacts: np.ndarray
    refined: np.ndarray
    peaks: np.ndarray
    final: np.ndarray
    times: np.ndarray

    @classmethod
    def empty(cls, n: int, states: int, times: int) -> _Results:
        return cls(
            np.full(n, NOT_RUN, np.int64),
            np.full(n, np.nan),
            np.zeros(n, np.int64),
            np.zeros(n, np.int64),
            np.zeros(n, np.int64),
            np.full((n, 2, states), np.nan),
            np.full((n, states), np.nan),
            np.full((n, times), np.nan),
        )

    def run(
        self,
        part: Part,
        compiled: Program,
        options: SolverOptions,
        stop: threading.Event,
        lanes: bool = False,
    ) -> None:
        """Run a part and write its rows; those of motions that are stopped stay as not run."""
        q, rows = part.problems, part.rows
        n, width = q.y0.shape
        final, peaks = q.y0.copy(), np.empty((n, 2, width))
        times = np.full((n, self.times.shape[1]), np.nan)
        status = np.empty((n, len(AT_THE_START)), np.int64)
        peaks[:], status[:], status[:, CONTACT] = q.y0[:, None], AT_THE_START, q.contact
        clock = np.zeros((n, 4))
        state = status, clock, final, np.zeros((n, width))
        outcome = np.full(n, FULL)
        others = (
            q.horizontal, q.h_rows, q.vertical, q.v_rows, q.p, q.law, q.ratio, options.rtol,
            np.full(width, options.atol), options.max_step, options.steps_per_segment, q.fallen,
            options.rest_tolerance, options.max_impacts, options.max_steps, outcome, peaks, times,
        )  # fmt: skip
        in_lanes = ended = 0
        try:
            if lanes:
                z, w = _aligned(compiled.Z_SIZE), np.full(compiled.W_SIZE, -1)
                call = compiled.integrate_lanes.bound(0, z, w, *state, q.end, *others)
                while in_lanes >= 0 and not stop.is_set():
                    call["first"] = in_lanes
                    in_lanes = call()
            else:
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
            self.times[there] = times[ran]
            self.final_time[there] = clock[ran, TIME]
            self.contact[there] = status[ran, CONTACT]
            self.impacts[there] = status[ran, IMPACTS]
            self.refined[there] = status[ran, REFINED]
            self.outcome[there] = outcome[ran]

    def dataset(
        self, values: Mapping[str, list[Any]], module: ModuleType, asked: Mapping[str, Any]
    ) -> Sweep:
        """All that is kept of the cases, `asked` among it, in one go: a dataset is slow to make."""
        dims = tuple(values)
        shape = tuple(len(v) for v in values.values())
        ran = self.outcome != NOT_RUN

        def shaped(a: np.ndarray) -> np.ndarray:
            return a.reshape(shape + a.shape[1:])

        labels = np.array([*(o.label for o in _OUTCOMES), "not run"])
        phases = np.array([*module.CONTACTS, ""])

        def of_states(a: np.ndarray) -> tuple[tuple[str, ...], np.ndarray]:
            return (*dims, "state"), shaped(np.where(ran[:, None], a, np.nan))

        found = {
            "outcome": (dims, shaped(labels[self.outcome])),
            "final_time": (dims, shaped(self.final_time), {"units": "s"}),
            "final_phase": (dims, shaped(phases[np.where(ran, self.contact, -1)])),
            "impacts": (dims, shaped(self.impacts)),
            "refined": (dims, shaped(self.refined)),
            "peak": of_states(np.abs(self.peaks).max(axis=1)),
            "maximum": of_states(self.peaks[:, 1]),
            "minimum": of_states(self.peaks[:, 0]),
            "final": of_states(self.final),
        }
        if self.times.shape[1]:
            found["impact_time"] = ((*dims, "impact"), shaped(self.times), {"units": "s"})
        coords = {"state": list(module.STATES)} | {d: _labels(v) for d, v in values.items()}
        return Sweep({**found, **asked}, coords=coords)


@dataclass(frozen=True)
class _Asked:
    """Extremes (n, 2, m) and histories (n, m, k) of m named quantities, from whole responses."""

    quantities: tuple[str, ...]
    times: np.ndarray
    options: SolverOptions
    extremes: np.ndarray
    histories: np.ndarray

    @classmethod
    def empty(
        cls, n: int, names: Sequence[str], times: Sequence[float] | np.ndarray, how: SolverOptions
    ) -> _Asked:
        if isinstance(names, str):
            raise ValueError(f"quantities is the word {names!r}: give a list of names")
        at, m = numbers("times", times), len(names)
        if at.size and not m:
            raise ValueError("`times` is given, but no `quantities` whose history is wanted")
        if not np.all(at >= 0.0):
            raise ValueError(f"times holds {at.min()}: give times from 0 on, in seconds")
        extremes, histories = np.full((n, 2, m), np.nan), np.full((n, m, at.size), np.nan)
        return cls(tuple(names), at, how, extremes, histories)

    def run(self, part: Part, stop: threading.Event) -> None:
        for row, case in zip(part.rows, part.cases if self.quantities else (), strict=False):
            if stop.is_set():
                return
            response = simulate(
                case.structure, case.motion, impact=case.impact, initial=case.initial,
                duration=case.duration, vertical=case.vertical, phase=case.phase,
                options=self.options,
            )  # fmt: skip
            known = self.times <= response.t[-1]
            history = response.at(self.times[known], names=self.quantities)
            for i, name in enumerate(self.quantities):
                found = response.extremes(name)
                self.extremes[row, :, i] = found.minimum, found.maximum
                self.histories[row, i, known] = history[name]

    def variables(self, values: Mapping[str, list[Any]]) -> dict[str, Any]:
        if not self.quantities:
            return {}
        dims, shape = tuple(values), tuple(len(v) for v in values.values())

        def shaped(a: np.ndarray) -> tuple[tuple[str, ...], np.ndarray]:
            return (*dims, "quantity"), a.reshape(*shape, -1)

        found: dict[str, Any] = {
            "quantity": list(self.quantities),
            "peak_quantity": shaped(np.abs(self.extremes).max(axis=1)),
            "maximum_quantity": shaped(self.extremes[:, 1]),
            "minimum_quantity": shaped(self.extremes[:, 0]),
        }
        if self.times.size:
            found["time"] = "time", self.times, {"units": "s"}
            history = self.histories.reshape(*shape, len(self.quantities), -1)
            found["history"] = (*dims, "quantity", "time"), history
        return found


def _aligned(size: int) -> np.ndarray:
    """Zeros that begin where a line of the processor's cache does: no vector straddles two."""
    zeros = np.zeros(size + 8)
    first = -zeros.ctypes.data % 64 // zeros.itemsize
    return zeros[first : first + size]


def _labels(values: list[Any]) -> list[Any]:
    """Numbers and words label themselves; other objects are numbered."""
    plain = all(isinstance(v, (str, int, float, np.number)) for v in values)
    return values if plain else list(range(len(values)))


class _Progress:
    """A line on stderr: how many are done, and how long the rest will take."""

    def __init__(self, total: int, shown: bool) -> None:
        self.total, self.shown, self.done = total, shown, 0
        self.started = self.last = time.monotonic()

    def __enter__(self) -> _Progress:
        return self

    def add(self, n: int) -> None:
        self.done += n
        now = time.monotonic()
        if self.shown and now - self.last > 0.2:
            self.last = now
            left = (now - self.started) * (self.total - self.done) / self.done
            sys.stderr.write(f"\r{self.done:,} of {self.total:,} motions, {left:.0f} s left ")
            sys.stderr.flush()

    def __exit__(self, *_: object) -> None:
        if self.shown:
            took = time.monotonic() - self.started
            sys.stderr.write(f"\r{self.done:,} of {self.total:,} motions in {took:.1f} s.\n")
