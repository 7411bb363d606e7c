"""Extremes of the quantities of a motion, within its steps and not among its samples.

In a step the states are polynomials of time and the ground follows one segment, so that every
quantity is smooth. It is evaluated at places close to one another; where their second difference
leaves room for more than the best value so far, the extreme is enclosed and narrowed down.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockeom.simulation.steps import Evaluate, Steps

PARTS = 8  # of a step
CHUNK = 1024  # steps evaluated together, so that memory is bounded
MOST_HELD = 16 * CHUNK  # candidate steps, before their extremes are found
MOST_PIECES = 64  # pieces of candidates, before those that are none any more are dropped
FINER = np.linspace(0.0, 1.0, 17)  # places within a bracket, each time again
BRACKETS = PARTS * CHUNK // len(FINER)  # narrowed together: as many places as steps have
NARROWINGS = 8  # 0.25 / 8**8 of a step is 1.5e-8: of the value its square is lost
SHORTEST = 1e-6
"""[s] Within a shorter step nothing happens: there is no extreme but at its ends. Slips in space as
slow as 1e-6 m/s bound explicit steps by their stability, and between the ends of such steps the
direction of friction is not known."""
_SIGNS = np.array([-1.0, 1.0])


@dataclass(frozen=True)
class Extremes:
    """Least and greatest value of a quantity in a motion, and their times.

    Parameters
    ----------
    minimum : float
        Least value, in the unit of the quantity.
    maximum : float
        Greatest value, in the unit of the quantity.
    minimum_time : float
        Time of the least value [s].
    maximum_time : float
        Time of the greatest value [s].
    """

    minimum: float
    maximum: float
    minimum_time: float
    maximum_time: float

    @property
    def peak(self) -> float:
        """The value of largest size, with its sign."""
        return self.minimum if -self.minimum > self.maximum else self.maximum

    @property
    def peak_time(self) -> float:
        """Time of `peak` [s]."""
        return self.minimum_time if -self.minimum > self.maximum else self.maximum_time


@dataclass(frozen=True, eq=False)
class Search:
    """Steps, each up to a part `width` of it and its last time [s], and the quantities there."""

    steps: Steps
    evaluate: Evaluate
    width: np.ndarray
    last: np.ndarray

    @classmethod
    def within(
        cls, steps: Steps, evaluate: Evaluate, end: float = np.inf, after: float = np.inf
    ) -> Search:
        """Steps in a row, up to the time `end` [s]; after : when the one behind them begins."""
        start, length = steps.span.T
        # the end of a step is still in its own segment of the ground motion, which may jump there
        ends = np.minimum(start + length, np.append(start[1:], after))
        last = np.maximum(np.nextafter(ends, -np.inf), start)
        return cls(steps, evaluate, np.clip((end - start) / length, 0.0, 1.0), last)

    def __getitem__(self, which: np.ndarray) -> Search:
        return Search(self.steps[which], self.evaluate, self.width[which], self.last[which])

    def joined(self, *others: Search) -> Search:
        all_ = (self, *others)
        return Search(
            self.steps.joined(*(search.steps for search in others)),
            self.evaluate,
            np.concatenate([search.width for search in all_]),
            np.concatenate([search.last for search in all_]),
        )

    def at(self, index: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(times (n,), values (n, m)) at places x in [0, 1] of the steps `index`, which rise."""
        start, length = self.steps.span[index].T
        t = np.minimum(start + x * length, self.last[index])
        values = self.evaluate(t, self.steps.states(index, x), self.steps.mode[index])
        return t, values

    def grid(self, first: int, last: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(places, times (n, PARTS + 1), values (n, PARTS + 1, m)) of the steps of a range."""
        index = np.repeat(np.arange(first, last), PARTS + 1)
        x = np.multiply.outer(self.width[first:last], np.linspace(0.0, 1.0, PARTS + 1))
        t, values = self.at(index, x.ravel())
        return x, t.reshape(x.shape), values.reshape(*x.shape, -1)

    def narrowed(
        self,
        index: np.ndarray,
        low: np.ndarray,
        high: np.ndarray,
        column: np.ndarray,
        sign: np.ndarray,
    ) -> tuple[np.ndarray, np.ndarray]:
        """(times, values of sign * quantity) (n,) of the maxima between low and high.

        All at once: the time goes with the number of calls, not with that of places.
        """
        rows, of = np.arange(len(index)), np.repeat(np.arange(len(index)), len(FINER))
        for _ in range(NARROWINGS):
            x = low[:, None] + (high - low)[:, None] * FINER
            t, values = self.at(index[of], x.ravel())
            f = sign[of] * values[np.arange(len(of)), column[of]]
            f = np.where(np.isnan(f), -np.inf, f).reshape(x.shape)
            best = f.argmax(axis=1)
            low = x[rows, np.maximum(best - 1, 0)]
            high = x[rows, np.minimum(best + 1, len(FINER) - 1)]
        return t.reshape(x.shape)[rows, best], f[rows, best]


class Running:
    """The extremes of quantities over steps that come one piece after the other.

    It holds only the steps of a piece in which an extreme may lie. end : up to when [s].
    """

    def __init__(self, evaluate: Evaluate, end: float = np.inf) -> None:
        self.evaluate, self.end = evaluate, end
        self.best: np.ndarray | None = None  # (2, m) of -values and values
        self.when = np.empty(0)
        self.pieces: list[tuple[Search, tuple[np.ndarray, ...]]] = []

    def add(self, steps: Steps, after: float = np.inf) -> None:
        """The next steps; after : when the one behind them begins [s]."""
        search = Search.within(steps, self.evaluate, self.end, after)
        x, t, values = search.grid(0, len(steps))
        _straighten(values, steps.span[:, 1] < SHORTEST)
        f = _SIGNS[:, None, None, None] * values  # (2, steps, places, m)
        f[np.isnan(f)] = -np.inf
        flat = f.reshape(2, -1, f.shape[-1])
        place = flat.argmax(axis=1)
        most = np.take_along_axis(flat, place[:, None], axis=1)[:, 0]
        if self.best is None:
            self.best, self.when = np.full(most.shape, -np.inf), np.full(most.shape, np.nan)
        better = most > self.best  # of equal ones the first, so that pieces of any length do
        self.when = np.where(better, t.ravel()[place], self.when)
        self.best = np.where(better, most, self.best)
        self._hold(search, _candidates(f, x, self.best))
        if len(self.pieces) > MOST_PIECES:
            self._join()
            if sum(len(held.steps) for held, _ in self.pieces) > MOST_HELD:
                self._settle()

    def _hold(self, search: Search, block: tuple[np.ndarray, ...]) -> None:
        """Hold the steps of candidates, if they still are."""
        step, *others, side, column, bound = block
        assert self.best is not None
        worth = bound > self.best[side, column]
        if worth.any():
            used, step = np.unique(step[worth], return_inverse=True)
            rest = (a[worth] for a in (*others, side, column, bound))
            self.pieces.append((search[used], (step, *rest)))

    def _join(self) -> None:
        """Make one piece of those that are held, without steps that are no candidates any more."""
        searches, blocks = zip(*self.pieces, strict=True)
        first = np.cumsum([0, *(len(search.steps) for search in searches)])
        steps = [step + offset for (step, *_), offset in zip(blocks, first, strict=False)]
        columns = zip(*(others for _, *others in blocks), strict=True)
        joined = (np.concatenate(steps), *map(np.concatenate, columns))
        self.pieces = []
        self._hold(searches[0].joined(*searches[1:]), joined)

    def _settle(self) -> None:
        """Find the extremes in the steps that are held, which then need not be held any more."""
        best, when = self.best, self.when
        assert best is not None
        for search, (index, low, high, side, column, _) in self.pieces:
            brackets = (index, low, high, column, _SIGNS[side])
            some = [slice(i, i + BRACKETS) for i in range(0, len(index), BRACKETS)]
            parts = [search.narrowed(*(a[part] for a in brackets)) for part in some]
            t, value = map(np.concatenate, zip(*parts, strict=True))
            for i in np.flatnonzero(value > best[side, column]):
                if value[i] > best[side[i], column[i]]:
                    best[side[i], column[i]], when[side[i], column[i]] = value[i], t[i]
        self.pieces = []

    def found(self) -> list[Extremes]:
        """The extremes of each quantity."""
        if self.pieces:
            self._join()
        self._settle()
        best, when = self.best, self.when
        assert best is not None
        return [
            Extremes(float(-best[0, i]), float(best[1, i]), float(when[0, i]), float(when[1, i]))
            for i in range(best.shape[1])
        ]


def _straighten(values: np.ndarray, short: np.ndarray) -> None:
    """Let values (n, PARTS + 1, m) go straight from end to end in steps that are short (n,)."""
    if short.any():
        first, last = values[short, :1], values[short, -1:]
        values[short] = first + np.linspace(0.0, 1.0, PARTS + 1)[:, None] * (last - first)


def extremes(steps: Steps, evaluate: Evaluate, end: float = np.inf) -> list[Extremes]:
    """The extremes of each quantity over the steps up to the time `end` [s]."""
    running, start = Running(evaluate, end), steps.span[:, 0]
    number = max(int(np.searchsorted(start, end, side="right")), 1)
    for first in range(0, number, CHUNK):
        last = min(first + CHUNK, number)
        running.add(steps[first:last], start[last] if last < len(start) else np.inf)
    return running.found()


def _candidates(f: np.ndarray, x: np.ndarray, best: np.ndarray) -> tuple[np.ndarray, ...]:
    """Steps, brackets, signs and columns of the local maxima that may exceed the best place."""
    least = best + 1e-14 * np.where(np.isfinite(best), np.abs(best), 0.0)
    # between equal places a parabola rises by an eighth of the second difference: eight times that
    with np.errstate(invalid="ignore"):
        bend = np.abs(f[1, :, 2:] - 2.0 * f[1, :, 1:-1] + f[1, :, :-2]).max(axis=1)
        reach = f.max(axis=2) + bend > least[:, None]
    (some,) = np.nonzero(reach.any(axis=(0, 2)))  # few of the steps of a long motion
    f, x, bound = f[:, some], x[some], f[:, some] + bend[some, None]
    crest = np.ones(f.shape, dtype=bool)
    crest[:, :, 1:] &= f[:, :, 1:] >= f[:, :, :-1]
    crest[:, :, :-1] &= f[:, :, :-1] >= f[:, :, 1:]
    side, step, place, column = np.nonzero(crest & (bound > least[:, None, None]))
    low = x[step, np.maximum(place - 1, 0)]
    high = x[step, np.minimum(place + 1, PARTS)]
    order = np.argsort(step, kind="stable")
    return tuple(
        a[order] for a in (some[step], low, high, side, column, bound[side, step, place, column])
    )


def last_crest(steps: Steps, evaluate: Evaluate) -> float:
    """The last time [s] up to which a quantity rises; the start if it never does."""
    search = Search.within(steps, evaluate)
    for last in range(len(steps), 0, -CHUNK):
        first = max(last - CHUNK, 0)
        x, _, values = search.grid(first, last)
        step, place = np.nonzero(np.diff(values[:, :, 0], axis=1) > 0)
        if len(step):
            i, k = step[-1], place[-1]
            column = np.zeros(1, dtype=int)
            low, high = x[i, k : k + 1], x[i, min(k + 2, PARTS)][None]
            t, _ = search.narrowed(np.array([first + i]), low, high, column, np.ones(1))
            return float(t[0])
    return float(steps.span[0, 0])
