"""Modes whose number is a code of digits, one for the state of each point: what a number says.

Generated modules of structures in space have tables by these codes, which are as long as there are
codes and work out a row when it is asked for.
"""

import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rockeom.codes import (
    BEARS,
    BOUND,
    DIGITS_OF_STATES,
    FRICTIONLESS,
    IDLE_POINT,
    IDLES,
    LANDING,
    LIFTING,
    OPEN,
    RELEASED,
    SLIP_RIGHT,
    SLIPPING,
    SLIPS,
    STICK,
    STICKING,
)

_WORDS = {BEARS: "", IDLES: "_idle", RELEASED: "_released"} | {
    SLIPS + turns: f"_slides_{way}" for turns, way in enumerate(("east", "north", "west", "south"))
}
_DIGITS = {word: digit for digit, word in _WORDS.items()}
_FLIGHT = "flight"


class ByCode(Sequence[Any]):
    """A table with a row for each mode.

    Parameters
    ----------
    points : int
        Number of points.
    row : callable
        What the table has of a mode, by the digits of its points, a tuple of int.
    """

    def __init__(self, points: int, row: Callable[[tuple[int, ...]], Any]) -> None:
        self._points, self._row = points, row

    def __len__(self) -> int:
        return len(DIGITS_OF_STATES) ** self._points

    def __getitem__(self, mode: Any) -> Any:
        if isinstance(mode, slice):
            return [self[i] for i in range(*mode.indices(len(self)))]
        if not 0 <= mode < len(self):
            raise IndexError(f"mode {mode} of {len(self)}")
        return self._row(digits_of(int(mode), self._points))


class ModeNames(ByCode):
    """Names of modes: points that touch, joined by "_"; "flight" where none does.

    Parameters
    ----------
    points : tuple of str
        Names of the points.
    """

    def __init__(self, points: Sequence[str]) -> None:
        self.points = tuple(points)
        super().__init__(len(points), self._name)

    def _name(self, digits: tuple[int, ...]) -> str:
        words = (name + _WORDS[d] for name, d in zip(self.points, digits, strict=True) if d)
        return "_".join(words) or _FLIGHT

    def index(self, value: Any, *_: Any) -> int:
        """The mode of that name; ValueError where there is none."""
        parts = "".join(
            f"(?:{re.escape(name)}({'|'.join(_WORDS.values())})_)?" for name in self.points
        )
        match = re.fullmatch(parts, "" if value == _FLIGHT else f"{value}_")
        if match is None or not value:
            raise ValueError(f"{value!r} is not a mode")
        return code_of([_DIGITS.get(word, OPEN) for word in match.groups()])

    def __contains__(self, value: object) -> bool:
        try:
            self.index(value)
        except ValueError:
            return False
        return True


def rows_of(table: Sequence[Any], modes: np.ndarray) -> np.ndarray:
    """The rows that a table has of modes (n,), (n, ...); of codes only those that occur."""
    if not isinstance(table, ByCode):
        return np.array(table)[modes]
    found, which = np.unique(modes, return_inverse=True)
    return np.array([table[mode] for mode in found.tolist()])[which.reshape(np.shape(modes))]


def digits_of(mode: int, points: int) -> tuple[int, ...]:
    """The digits of the points in the number of a mode."""
    base = len(DIGITS_OF_STATES)
    return tuple(mode // base**i % base for i in range(points))


def code_of(digits: Sequence[int]) -> int:
    """The number of the mode in which points have these digits."""
    return sum(digit * len(DIGITS_OF_STATES) ** i for i, digit in enumerate(digits))


def tables_by_code(points: Sequence[str], smooth: int, guards: int, bounds: int) -> tuple[Any, ...]:
    """MODES, POINT_STATES, KINDS, SUBJECTS, SHARED and others whose rows are alike.

    Parameters
    ----------
    points : tuple of str
        Names of the points.
    smooth : int
        Number with a binary digit 1 for each point without friction.
    guards : int
        Number of guards.
    bounds : int
        Number of bounds, whose guards stand behind those of the points.

    Returns
    -------
    tuple of ByCode
        Tables MODES, POINT_STATES, KINDS, SUBJECTS, SHARED, GUARDS, ELEMENT_STATES and SIDES; then
        TARGETS, REVERSE and PARTS, which are one.
    """
    m = len(points)
    subjects = (*[i % m for i in range(guards - bounds)], *range(m, m + bounds))

    def kinds(digits: tuple[int, ...]) -> tuple[int, ...]:
        of_gaps = (LANDING if digit == OPEN else LIFTING for digit in digits)
        of_slips = [STICKING if digit >= SLIPS else SLIPPING for digit in digits]
        every = (*of_gaps, *of_slips, *of_slips)[: guards - bounds]
        return (*every, *[BOUND] * bounds)

    def states(digits: tuple[int, ...]) -> tuple[int, ...]:
        return tuple(
            {OPEN: OPEN, IDLES: IDLE_POINT, RELEASED: FRICTIONLESS}.get(
                digit, SLIP_RIGHT if digit >= SLIPS else FRICTIONLESS if smooth >> i & 1 else STICK
            )
            for i, digit in enumerate(digits)
        )

    def alike(value: Any) -> ByCode:
        return ByCode(m, lambda digits: value)

    none = alike((-1,) * len(subjects))
    return (
        ModeNames(points), ByCode(m, states), ByCode(m, kinds), alike(subjects),
        alike(tuple(range(m))), alike(len(subjects)), alike(()), alike(0.0), none, none, none,
    )  # fmt: skip
