"""Derivatives of motions without a derivative: differences of tight integrations, extrapolated.

A motion here is a function from numbers by name to a `Case`; see `observed` for what is told of it.
"""

import itertools
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

import rockeom as rk

TIGHT = rk.SolverOptions(rtol=1e-14, atol=1e-17)
FIRST_PART, LEVELS, MOST_LEVELS, GOOD_ENOUGH = 4e-3, 4, 8, 1e-9
"""Of differences, see `differenced`."""

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
    """Derivatives as of `Observed`, and what each of them may be wrong by, in parts of its size."""

    derivative: Observed
    error: float


def size_of(derivative: np.ndarray) -> float:
    """To what an error of it is compared; numbers here are of the size of one, or less."""
    return max(1.0, np.abs(derivative).max(initial=0.0))


def run(case: rk.Case, options: rk.SolverOptions = TIGHT) -> rk.Response:
    return rk.simulate(case, options=options)


def observed(response: rk.Response, times: np.ndarray) -> Observed:
    events, states = response.events, response.states

    def column(side: str) -> np.ndarray:
        rows = [[getattr(e, side)[n] for n in states] for e in events]
        return np.reshape(rows, (len(events), len(states)))

    found = response.at(times)
    return Observed(
        np.array([e.time for e in events]), column("before"), column("after"), response.end,
        np.stack([found[n] for n in states], axis=-1),
    )  # fmt: skip


def differenced(
    motion: Motion, values: Mapping[str, float], direction: Mapping[str, float],
    times: Any = (), options: rk.SolverOptions = TIGHT,
) -> Reference:  # fmt: skip
    """Derivative of a motion along a direction of its numbers, by Richardson's extrapolation.

    Central differences over smaller and smaller parts of the direction: their error has even powers
    of the part alone. The last LEVELS are extrapolated; what the finest of them changed bounds the
    error that is left, of rounding as well. It goes on until that is below GOOD_ENOUGH.

    Raises OtherEventsError where all neighbours that are far enough for it pass through other
    events.
    """
    kinds = sequence(run(motion(**values), options))

    def moved(part: float) -> Observed:
        at = {name: value + part * direction.get(name, 0.0) for name, value in values.items()}
        response = run(motion(**at), options)
        if sequence(response) != kinds:
            raise OtherEventsError(f"{sequence(response)} in place of {kinds}")
        return observed(response, np.asarray(times, dtype=float))

    best: Reference | None = None
    rows: list[Observed] = []
    for part in FIRST_PART / 2.0 ** np.arange(MOST_LEVELS):
        try:
            pair = zip(moved(part), moved(-part), strict=True)
        except OtherEventsError as other:
            rows, said = [], other
            continue
        rows.append(Observed(*((a - b) / (2 * part) for a, b in pair)))
        if len(rows) >= LEVELS:
            found = extrapolated(rows[-LEVELS:])
            best = found if best is None or found.error < best.error else best
            if best.error < GOOD_ENOUGH:
                break
    if best is None:
        raise said
    return best


def extrapolated(rows: list[Observed]) -> Reference:
    """The limit of values at halved steps, whose error has even powers of the step."""
    factor = 4.0
    while len(rows) > 1:
        before = rows[0]
        rows = [
            Observed(*((factor * fine - coarse) / (factor - 1)
                       for coarse, fine in zip(*two, strict=True)))
            for two in itertools.pairwise(rows)
        ]  # fmt: skip
        factor *= 4.0
    pairs = zip(rows[0], before, strict=True)
    errors = [np.abs(last - less).max(initial=0.0) / size_of(last) for last, less in pairs]
    return Reference(rows[0], float(max(errors)))


def sequence(response: rk.Response) -> list[Any]:
    """Its events but for their times and states, and how it ends."""
    passed = [(e.kind, e.mode_before, e.mode_after) for e in response.events]
    return [*passed, response.outcome]
