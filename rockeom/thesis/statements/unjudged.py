"""Sentences of the thesis with a number, each next to the computed number; and its slips.

    from rockeom.thesis import statements

    statements.of_figures("4-13")        # those that a figure decides
    statements.others()                  # those that belong to no figure
    statements.slips()                   # errors as printed outside the equations

Nothing is typed that can be computed: each is decided on demand. The errata of the
equations themselves are in `rockeom.thesis.EQUATIONS`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import rockeom as rk
from rockeom import analysis
from rockeom.motion import STANDARD_GRAVITY
from rockeom.thesis import shaken
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.figures import FIGURES, Statement
from rockeom.thesis.figures.chapter_4_shaken import settled_speeds
from rockeom.thesis.printed import (
    TABLE_4_1,
    TABLE_4_2,
    TABLE_4_4,
)

__all__ = ["of_figures", "others", "slips"]

Finding = tuple[str, bool | None]
"""The result, and whether the sentence holds."""


class _Sentence(NamedTuple):
    where: str
    printed: str
    find: Callable[[], Finding]

    def decided(self) -> Statement:
        """The statement; open where a record that it needs is missing."""
        try:
            finding = self.find()
        except rk.MotionError as error:
            finding = (str(error), None)
        return Statement(self.where, self.printed, *finding)


_OTHERS: list[_Sentence] = []
_SLIPS: list[_Sentence] = []


def of_figures(*numbers: str) -> tuple[Statement, ...]:
    """The statements of some figures, drawn for it; of all, which takes minutes, if none is named.

    Raises KeyError for a number that is not in FIGURES.
    """
    return tuple(s for n in numbers or FIGURES for s in FIGURES[n].drawn().statements)


def others() -> tuple[Statement, ...]:
    """Sentences with a number that belong to no figure."""
    return tuple(one.decided() for one in _OTHERS)


def slips() -> tuple[Statement, ...]:
    """Errors as printed in the text, the tables and the captions, with their corrections."""
    return tuple(one.decided() for one in _SLIPS)


def _said(
    among: list[_Sentence], where: str, printed: str
) -> Callable[[Callable[[], Finding]], Callable[[], Finding]]:
    def record(find: Callable[[], Finding]) -> Callable[[], Finding]:
        among.append(_Sentence(where, printed, find))
        return find

    return record


def sentence(where: str, printed: str) -> Any:
    """Record the result of the decorated function among the sentences."""
    return _said(_OTHERS, where, printed)


def slip(where: str, printed: str) -> Any:
    """Record the result of the decorated function among the slips."""
    return _said(_SLIPS, where, printed)


def _meaning(number: str) -> str:
    return f"{number} is the {EQUATIONS[number].meaning}"


def _numbers(table: Any, column: int, runs: tuple[str, ...]) -> np.ndarray:
    return np.array([float(row[column]) for row in table.rows if row[0] in runs])


_OF_75_KN = ("1", "2", "3", "4", "6")


# --- sentences


@sentence("4.9.1", "peak accelerations of the table from 0.24 g to 0.84 g")
def _() -> Finding:
    peaks = _numbers(TABLE_4_1, 3, _OF_75_KN) / STANDARD_GRAVITY
    found = [float(peaks.min()), float(peaks.max())]
    return f"{found[0]:.2f} to {found[1]:.2f} g (Table 4-1)", bool(
        np.allclose(found, [0.24, 0.84], atol=0.005)
    )


@sentence("4.9.1", "largest displacements from 4.34 to 23.91 mm")
def _() -> Finding:
    peaks = np.abs(_numbers(TABLE_4_2, 1, _OF_75_KN))
    found = [float(peaks.min()), float(peaks.max())]
    return f"{found[0]:g} to {found[1]:g} mm (Table 4-2)", found == [4.34, 23.91]


@sentence("4.9.1", "test 1 displaced the wall more than test 2, of twice its acceleration")
def _() -> Finding:
    law = rk.EnergyRatioAtSpeed.equation_4_31()
    one, two = (
        1e3 * abs(shaken.peaks_of(shaken.oscillator_run(run, law)).displacement) for run in "12"
    )
    ratio = np.divide(*_numbers(TABLE_4_1, 3, ("2", "1")))
    return (
        f"by 4-27 under the records that were meant {one:.2f} and {two:.2f} mm; the table's peaks "
        f"are as 1 to {1 / ratio:.2f}",
        one > two,
    )


@sentence("4.9.1", "a window of 0.43 times the sampling rate")
def _() -> Finding:
    samples = 0.43 * 200
    return f"{samples:.0f} samples at 200 Hz; frequencies {200 / samples:.1f} Hz apart", None


@sentence("4.9.2", "more prestress decreases the largest displacement where the wall rocks")
def _() -> Finding:
    rows = TABLE_4_4.rows[1:]
    pairs = [(abs(float(row[1] or 0.0)), abs(float(row[2] or 0.0))) for row in rows]
    said = ", ".join(f"{a:g} to {b:g} mm" for a, b in pairs)
    return f"Tabas and Northridge {said} (Table 4-4)", all(b < a for a, b in pairs)


@sentence("4.9.2", "more prestress brings higher accelerations at the same drift")
def _() -> Finding:
    d = 5e-3
    forces = [float(analysis.Wall.thesis(p).restoring_force(d)) / 1e3 for p in (75.6e3, 111e3)]
    return f"F_k at 5 mm {forces[0]:.1f} against {forces[1]:.1f} kN", forces[1] > forces[0]


# --- slips: outside the equations


@slip("4.9.1", "initial tendon forces vary by less than 0.04 %")
def _() -> Finding:
    forces = _numbers(TABLE_4_2, 2, _OF_75_KN)
    spread = 100 * float(np.abs(forces / forces.mean() - 1).max())
    return f"by up to {spread:.1f} % about their mean (Table 4-2)", spread < 0.04


@slip("Figure 4-73", "the period doubles at Z = 6.03 m/s2 under Z sin(16 pi t)")
def _() -> Finding:
    counts = [
        len(np.unique(np.round(settled_speeds(8.0, z, {"u": 0.0})[0], 4))) for z in (5.9, 6.1)
    ]
    return f"{counts[0]} and {counts[1]} velocities when upright at 5.9 and 6.1", counts[1] > 2
