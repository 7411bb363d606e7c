"""The dense record of a motion: its steps, in each of which the states are polynomials of time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

_TOGETHER = 4096  # steps that are evaluated at a time, so that memory is bounded


class Rows(NamedTuple):
    """Times t (n,) [s], states y (n, N) and numbers of the modes (n,) of a motion."""

    t: np.ndarray
    y: np.ndarray
    mode: np.ndarray


Evaluate = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""(n, m) values of m quantities at times (n,), states (n, N) and modes (n,)."""


@dataclass(frozen=True, eq=False)
class Steps:
    """Dense record of a motion.

    Parameters
    ----------
    span : ndarray
        Start and length of each step (n, 2) [s].
    mode : ndarray
        Number of the mode of each step (n,).
    powers : ndarray
        Polynomial coefficients of the states in each step (n, 8, N).
    """

    span: np.ndarray
    mode: np.ndarray
    powers: np.ndarray

    def __len__(self) -> int:
        return len(self.span)

    def __getitem__(self, which: slice | np.ndarray) -> Steps:
        return Steps(self.span[which], self.mode[which], self.powers[which])

    def joined(self, *others: Steps) -> Steps:
        """These steps and those that follow them."""
        fields = zip(*((s.span, s.mode, s.powers) for s in (self, *others)), strict=True)
        return Steps(*map(np.concatenate, fields))

    def at(self, times: np.ndarray, side: str) -> tuple[np.ndarray, np.ndarray]:
        """States (m, N) and modes (m,) at times (m,)."""
        starts = self.span[:, 0]
        place = np.searchsorted(starts, times, side="right" if side == "right" else "left")
        index = np.clip(place - 1, 0, len(starts) - 1)
        x = (times - starts[index]) / self.span[index, 1]
        return self.states(index, x), self.mode[index]

    def states(self, index: np.ndarray, x: np.ndarray) -> np.ndarray:
        """States (m, N) at places x in [0, 1] of the steps `index`."""
        values = np.empty((len(index), self.powers.shape[2]))
        for first in range(0, len(index), _TOGETHER):
            some = slice(first, first + _TOGETHER)
            powers, at = self.powers[index[some]], x[some, None]
            value = powers[:, 7]
            for j in range(6, -1, -1):
                value = value * at + powers[:, j]
            values[some] = value
        return values

    def samples(self, spacing: float) -> Rows:
        """Both ends of every step, and places between them no wider apart than spacing [s]."""
        n = np.maximum(np.ceil(self.span[:, 1] / spacing - 1e-9).astype(int), 1)
        index = np.repeat(np.arange(len(n)), n + 1)
        first = np.cumsum(n + 1) - (n + 1)
        x = (np.arange(len(index)) - np.repeat(first, n + 1)) / np.repeat(n, n + 1)
        values = self.states(index, x)
        t = self.span[index, 0] + x * self.span[index, 1]
        # the end of a step is the start of the next: keep one unless a state jumps there
        keep = np.ones(len(t), dtype=bool)
        seam = first[1:]
        same = np.all(
            np.abs(values[seam] - values[seam - 1]) <= 1e-9 * np.abs(values[seam]), axis=1
        )
        keep[seam[same & (self.mode[1:] == self.mode[:-1])]] = False
        return Rows(t[keep], values[keep], self.mode[index][keep])
