"""The swings of a simulated free vibration: peaks and crossings, and their derivatives."""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rockeom.numbers.checks import require
from rockeom.numbers.dual import tangent_of, with_tangent
from rockeom.simulation.case import Case
from rockeom.simulation.ground import ground_of
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.structures.evaluation import filled
from rockeom.sweeps.sensitivity import quantity_of
from rockeom.sweeps.tangents import Tangents, tangents

BESIDE = 1e-3
"""Part of a quarter period to both sides of a peak at which its rate is evaluated."""


class Swings(NamedTuple):
    """Free vibration by its peaks and crossings.

    Parameters
    ----------
    peak : ndarray
        Peaks (n,) in the unit of the quantity, one on each side in turn, the first one at the
        release. Where the motion has fewer, peaks are zero and times those of its end.
    peak_time : ndarray
        Times of the peaks (n,) [s].
    crossing_time : ndarray
        Times of the crossings of zero behind each peak (n,) [s].
    """

    peak: np.ndarray
    peak_time: np.ndarray
    crossing_time: np.ndarray


def swings(run: Response, quantity: str = "displacement", number: int = 10) -> Swings:
    """First peaks and crossings of a quantity in a response, from its dense output.

    Parameters
    ----------
    run : Response
        Response with all its steps.
    quantity : str, optional
        One of ``run.names`` that crosses zero, as "theta".
    number : int, optional
        Number of swings.

    Returns
    -------
    Swings
        Peaks and crossings.

    Raises
    ------
    ValueError
        For a number below 1.
    KeyError
        For an unknown quantity.
    """
    require(number >= 1, "swings", "number", number, "ask for one peak at least")
    start, length = run.steps.span.T
    end = float(start[-1] + length[-1])

    def at(times: np.ndarray) -> np.ndarray:
        times = np.clip(times, 0.0, end)
        if quantity in run.states:  # without the samples of a whole response
            values = run.steps.at(times.ravel(), "right")[0][:, run.states.index(quantity)]
            return values.reshape(times.shape)
        return run.at(np.minimum(times, run.t[-1]), names=(quantity,))[quantity]

    grid = np.unique(np.append(start[:, None] + length[:, None] * np.arange(8) / 8, end))
    grid = grid[grid <= end]
    x = at(grid)
    away = np.flatnonzero(x)
    change = np.flatnonzero(np.diff(np.sign(x[away])))[:number]
    last, first = away[change], away[change + 1]  # next to each crossing
    crossing_time = _crossings(at, grid[last], grid[first])

    edges = [0, *first.tolist()]
    if len(change) < number:
        edges.append(len(grid))
    crest = [a + int(np.argmax(np.abs(x[a:b]))) for a, b in pairwise(edges)]
    crest = [row for row in crest if row < len(grid) - 1 and x[row]]  # else it has not turned back
    low, high = (grid[np.clip(np.add(crest, d), 0, len(grid) - 1)] for d in (-1, 1))
    peak_time = _crests(at, low, high, np.sign(x[crest]))

    def filled(values: np.ndarray, rest: float) -> np.ndarray:
        return np.append(values, np.full(number, rest))[:number]

    return Swings(filled(at(peak_time), 0.0), filled(peak_time, end), filled(crossing_time, end))


_Curve = Callable[[np.ndarray], np.ndarray]


def _crossings(at: _Curve, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """(n,) times between low and high, of other signs, where a quantity passes through zero."""
    row = np.arange(len(low))
    for _ in range(5):
        t = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, 33)
        x = at(t)
        k = np.argmax(np.sign(x) != np.sign(x[:, :1]), axis=1)
        low, high = t[row, k - 1], t[row, k]
    return low + (high - low) * x[row, k - 1] / (x[row, k - 1] - x[row, k])


def _crests(at: _Curve, low: np.ndarray, high: np.ndarray, side: np.ndarray) -> np.ndarray:
    """(n,) times between low and high at which side * quantity is largest."""
    row = np.arange(len(low))
    for _ in range(3):
        t = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, 17)
        x = side[:, None] * at(t)
        k = np.argmax(x, axis=1)
        low, high = t[row, np.maximum(k - 1, 0)], t[row, np.minimum(k + 1, 16)]
    inside = (k > 0) & (k < 16)
    k = np.clip(k, 1, 15)
    before, top, after = x[row, k - 1], x[row, k], x[row, k + 1]
    bend = 2 * top - before - after
    move = np.divide(after - before, 2 * bend, out=np.zeros(len(row)), where=bend > 0)
    return np.where(
        inside, t[row, k] + move * (t[row, 1] - t[row, 0]), t[row, np.argmax(x, axis=1)]
    )


def swing_tangents(
    case: Case, quantity: str, number: int, options: SolverOptions | None
) -> tuple[Swings, Swings]:
    """Swings of a case, and their derivatives along the directions of its duals.

    Parameters
    ----------
    case : Case
        Case that holds duals with m directions.
    quantity : str
        Quantity, as for `swings`.
    number : int
        Number n of swings.
    options : SolverOptions
        Choices of the integration.

    Returns
    -------
    swings : Swings
        Swings of the case.
    derivatives : Swings
        Their derivatives (n, m).

    Raises
    ------
    ValueError
        Where an event of the motion has no derivatives.

    Notes
    -----
    The derivative of the time of a peak is -x_tp/x_tt, of the exact x_t and x_p a little before and
    behind it.
    """
    carried = tangents(case, options)
    if carried.grazing:
        raise ValueError(f"the swings have no derivatives: {carried.grazing}")
    run = carried.response
    nominal = swings(run, quantity, number)
    there, crossed = nominal.peak != 0.0, nominal.crossing_time < run.t[-1]
    beside = BESIDE * np.abs(nominal.crossing_time - nominal.peak_time)
    times = np.stack(
        [
            nominal.peak_time,
            np.maximum(nominal.peak_time - beside, 0.0),
            np.minimum(nominal.peak_time + beside, run.t[-1]),
            nominal.crossing_time,
        ]
    )
    along = quantity_tangents(carried, quantity, times.ravel()).reshape(*times.shape, -1)
    by, rate = along[..., :-1], along[..., -1]
    turns = there & (nominal.peak_time > 0.0)  # others are those of the start
    peak_time = _quotient(by[2] - by[1], rate[2] - rate[1], turns)
    crossing_time = _quotient(by[3], rate[3], crossed)
    for row, time in enumerate(nominal.crossing_time):  # at an impact the rate jumps
        (at,) = np.nonzero(np.abs(run.events.columns[0] - time) <= beside[row])
        if len(at):
            crossing_time[row] = carried.event_times[at[0]]
    return nominal, Swings(np.where(there[:, None], by[0], 0.0), peak_time, crossing_time)


def quantity_tangents(carried: Tangents, quantity: str, times: np.ndarray) -> np.ndarray:
    """Derivatives of a quantity at fixed times.

    Parameters
    ----------
    carried : Tangents
        Motion with its derivatives along m directions.
    quantity : str
        A state, or one that `rk.sensitivity` knows.
    times : ndarray
        Times (n,) [s].

    Returns
    -------
    ndarray
        Derivatives (n, m + 1), the last of them by time.
    """
    run, m = carried.response, len(carried.end_time)
    module, p = run.structure.module, run.structure.vector
    still = np.zeros((len(p), 1))  # by time
    moving = with_tangent(p, np.append(carried.parameters, still, axis=1))
    y, modes = run.steps.at(times, "right")
    ground = ground_of(run).accelerations(times)
    rates = filled(module, run.structure.vector, "rates", module.N_STATES, modes, y, *ground)
    by = np.append(carried.at(times), rates.T[..., None], axis=2)
    values = [
        quantity_of(module, quantity, int(of), with_tangent(*row), moving)
        for of, *row in zip(modes, y, by, strict=True)
    ]
    return tangent_of(np.array(values, dtype=object), m + 1)


def _quotient(by: np.ndarray, rate: np.ndarray, which: np.ndarray) -> np.ndarray:
    """-by/rate (n, m) where `which` (n,) is true, and zero elsewhere."""
    here = np.broadcast_to(which[:, None], by.shape)
    return -np.divide(by, rate[:, None], out=np.zeros(by.shape), where=here)
