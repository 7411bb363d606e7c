"""Derivatives of a motion with respect to anything that a case is made of.

For now by central differences of the case in numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockeom.dual import nominal
from rockeom.numeric.case import Case, Problem, ProblemTangents, parted
from rockeom.numeric.options import SolverOptions
from rockeom.numeric.response import Outcome, Response
from rockeom.numeric.simulate import simulated


@dataclass(frozen=True)
class Tangents:
    """A motion with its derivatives along m directions, those of the duals of its case.

    response : the motion. event_times (k, m) : of the time of each passage of `response.events`.
    before, after (k, N, m) : of the states on both sides of each passage, at the passage, which
    moves. end (N, m) : of the state at the end of the motion; end_time (m,) : of the time of that
    end, zero where it is given by a number.
    grazing : "", or a sentence that names the event that grazes; what is behind it is nan.
    """

    response: Response
    event_times: np.ndarray
    before: np.ndarray
    after: np.ndarray
    end: np.ndarray
    end_time: np.ndarray
    grazing: str
    _at: Callable[[np.ndarray], np.ndarray]

    def at(self, times: Any) -> np.ndarray:
        """(n, N, m) derivatives of the states at fixed times (n,) [s]."""
        return self._at(np.atleast_1d(np.asarray(times, dtype=float)))


def tangents(case: Case, options: SolverOptions | None = None) -> Tangents:
    """The motion of a case that holds duals, with its derivatives along their directions.

    Raises what `simulate` raises.

    >>> start = rk.duals(theta=0.1, theta_dot=0.0)
    >>> flow = rk.tangents(rk.Case(block, motion, initial=start, duration=2.0))
    >>> flow.end.shape
    (2, 2)
    """
    options = SolverOptions.of(options)
    problem, along = parted(case.problem())
    plain = nominal(case)
    response = simulated(plain, problem, options)
    m = along.y0.shape[-1]
    moved = [_Moved(plain, problem, along, j, options) for j in range(m)]
    k, n = len(response.passages[0]), len(problem.y0)

    def columns(of: Callable[[_Moved], np.ndarray], shape: tuple[int, ...]) -> np.ndarray:
        return np.stack([of(x) for x in moved], axis=-1) if m else np.empty((*shape, 0))

    same = all(len(run.passages[0]) == k for x in moved for run in x.runs)
    if not same:
        return Tangents(
            response, np.full((k, m), np.nan), np.full((k, n, m), np.nan),
            np.full((k, n, m), np.nan), np.full((n, m), np.nan), np.full(m, np.nan),
            "an event is there on one side only", lambda t: np.full((len(t), n, m), np.nan),
        )  # fmt: skip
    return Tangents(
        response,
        columns(lambda x: x.of(lambda r: r.passages[0]), (k,)),
        columns(lambda x: x.of(lambda r: r.passages[2][:, 0]), (k, n)),
        columns(lambda x: x.of(lambda r: r.passages[2][:, 1]), (k, n)),
        columns(lambda x: x.of(lambda r: r.end), (n,)),
        columns(lambda x: x.of(_end_time), ()),
        "",
        lambda t: columns(lambda x: x.of(lambda r: _states(r, t)), (len(t), n)),
    )


def _end_time(run: Response) -> np.ndarray:
    overturned = run.outcome is Outcome.OVERTURNED
    return np.array(run.t[-1] if overturned else run.duration)


def _states(run: Response, times: np.ndarray) -> np.ndarray:
    found = run.at(times)
    return np.column_stack([found[name] for name in run.states])


class _Moved:
    """A motion with its numbers a little to both sides in one direction."""

    def __init__(
        self, case: Case, q: Problem, along: ProblemTangents, j: int, options: SolverOptions
    ) -> None:
        sizes = [
            np.max(np.abs(t[..., j]) / np.maximum(np.abs(np.asarray(x)), 1e-3), initial=0.0)
            for x, t in zip(
                (q.y0, q.p(), q.ratio, q.fallen, q.horizontal, q.vertical, q.end), along,
                strict=False,
            )
            if t.size
        ]  # fmt: skip
        self.step = 1e-5 / max(max(s for s in sizes if np.isfinite(s)), 1e-300)
        fine = replace(options, rtol=min(options.rtol, 1e-12), atol=min(options.atol, 1e-14))
        self.runs = [
            simulated(case, _moved(q, along, j, sign * self.step), fine) for sign in (1.0, -1.0)
        ]

    def of(self, what: Callable[[Response], np.ndarray]) -> np.ndarray:
        one, other = map(what, self.runs)
        return (one - other) / (2.0 * self.step)


def _moved(q: Problem, along: ProblemTangents, j: int, h: float) -> Problem:
    def to(x: Any, t: np.ndarray) -> Any:
        return x + h * np.nan_to_num(t[..., j])

    n = len(q.vector)
    return q._replace(
        y0=to(q.y0, along.y0),
        vector=to(q.vector, along.p[:n]),
        table=to(np.array(q.table), along.p[n:]).tolist(),
        ratio=float(to(q.ratio, along.ratio)),
        fallen=float(to(q.fallen, along.fallen)),
        horizontal=to(q.horizontal, along.horizontal),
        vertical=to(q.vertical, along.vertical),
        end=float(to(q.end, along.end)),
        quiet_from=float(to(q.quiet_from, along.quiet_from)),
    )
