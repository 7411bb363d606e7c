"""Derivatives of motions without a derivative: differences of tight integrations, extrapolated.

A motion here is a function from numbers by name to a `Case`; see `observed` for what is told of it.
"""

import itertools
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

import rockeom as rk

TIGHT = rk.SolverOptions(rtol=1e-14, atol=1e-17)
LEVELS = 4

Motion = Callable[..., rk.Case]


class OtherEventsError(Exception):
    """A neighbour passes through other events: between them there is no derivative."""


class Observed(NamedTuple):
    """What is told of a motion: of every event its time (k,) and the states (k, N) around it,
    the state (N,) at the end, and those (n, N) at fixed times."""

    event_times: np.ndarray
    before: np.ndarray
    after: np.ndarray
    end: np.ndarray
    at: np.ndarray


class Reference(NamedTuple):
    """Derivatives as of `Observed`, and what each of them may be wrong by."""

    derivative: Observed
    error: Observed


def run(case: rk.Case, options: rk.SolverOptions = TIGHT) -> rk.Response:
    c = case
    return rk.simulate(
        c.structure, c.motion, impact=c.impact, initial=c.initial, duration=c.duration,
        vertical=c.vertical, phase=c.phase, options=options,
    )  # fmt: skip


def observed(response: rk.Response, times: np.ndarray) -> Observed:
    events, states = response.events, response.states

    def column(side: str) -> np.ndarray:
        return np.array([[getattr(e, side)[n] for n in states] for e in events])

    found = response.at(times)
    return Observed(
        np.array([e.time for e in events]), column("before"), column("after"), response.end,
        np.stack([found[n] for n in states], axis=-1),
    )  # fmt: skip


def differenced(
    motion: Motion, values: Mapping[str, float], direction: Mapping[str, float],
    times: Any = (), step: float = 2e-3, options: rk.SolverOptions = TIGHT,
) -> Reference:  # fmt: skip
    """Derivative of a motion along a direction of its numbers, by Richardson's extrapolation.

    Central differences over `step` of the direction, half of it and so on: their error has even
    powers of the step alone. What the last extrapolation changed bounds the error that is left.

    Raises OtherEventsError where neighbours pass through other events.
    """
    kinds = sequence(run(motion(**values), options))

    def moved(s: float) -> Observed:
        at = {name: value + s * direction.get(name, 0.0) for name, value in values.items()}
        response = run(motion(**at), options)
        if sequence(response) != kinds:
            raise OtherEventsError(f"{sequence(response)} in place of {kinds}")
        return observed(response, np.asarray(times, dtype=float))

    steps = [step / 2**i for i in range(LEVELS)]
    pairs = [(moved(h), moved(-h)) for h in steps]
    columns = zip(*([(a - b) / (2 * h) for a, b in zip(*pair, strict=True)]
                    for pair, h in zip(pairs, steps, strict=True)), strict=True)  # fmt: skip
    found = [extrapolated(list(column)) for column in columns]
    return Reference(Observed(*(f for f, _ in found)), Observed(*(e for _, e in found)))


def extrapolated(row: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """(limit, error) of values at halved steps, whose error has even powers of the step."""
    factor = 4.0
    while len(row) > 1:
        before = row
        row = [(factor * b - a) / (factor - 1) for a, b in itertools.pairwise(row)]
        factor *= 4.0
    return row[0], np.abs(row[0] - before[0])


def derivative(function: Callable[[float], float], at: float, part: float = 2e-3) -> float:
    """Of a function of a number, over a part of it."""
    steps = [part * at / 2**i for i in range(LEVELS)]
    found = [np.array((function(at + h) - function(at - h)) / (2 * h)) for h in steps]
    return float(extrapolated(found)[0])


def sequence(response: rk.Response) -> list[Any]:
    """Its events but for their times and states, and how it ends."""
    passed = [(e.kind, e.phase_before, e.phase_after) for e in response.events]
    return [*passed, response.outcome]
