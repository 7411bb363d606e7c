"""The tables of the thesis as text to be read: printed next to computed numbers.

from rockeom.thesis.side_by_side import side_by_side

for table in side_by_side("2-1"):
    print(table.heading, table.columns, table.rows)
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rockeom.thesis.free_vibration_table import free_vibration_peaks, measured_peaks
from rockeom.thesis.printed import Cell
from rockeom.thesis.tables import TABLES, PrintedTable, computed


class TextTable(NamedTuple):
    """Table of cells of text, with its heading, its title and remarks on it.

    Parameters
    ----------
    heading : str
        Heading.
    title : str
        Title.
    columns : tuple of str
        Names of the columns, with units.
    rows : tuple of tuple of str
        As many cells each.
    remarks : tuple of str, optional
        Remarks.
    """

    heading: str
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    remarks: tuple[str, ...] = ()


def side_by_side(number: str) -> tuple[TextTable, ...]:
    """Table of the thesis, printed next to computed; with A-1 also the peaks of the models.

    Parameters
    ----------
    number : str
        "2-1" or "Figure 3-3", a key of `rockeom.thesis.tables.TABLES`.

    Returns
    -------
    tuple of TextTable
        Tables.

    Raises
    ------
    KeyError
        For an unknown number.
    """
    rows = computed(number)
    also = free_vibration() if number == "A-1" else ()
    return (beside(TABLES[number], rows), *also)


def beside(one: PrintedTable, rows: Iterable[tuple[Cell, ...]]) -> TextTable:
    """A printed table and its rows computed again, the columns in pairs.

    A measured column has no partner, nor has one that the computation starts from or repeats. The
    computed columns that the thesis does not print come last.
    """
    again = list(zip(*rows, strict=True))
    columns: list[tuple[str, Iterable[str]]] = []
    for i, name in enumerate(one.columns):
        texts = [row[i] for row in one.cells]
        if all(cell in (None, row[i]) for cell, row in zip(again[i], one.rows, strict=True)):
            columns.append((name, texts))
        else:
            columns += [(f"{name}, printed", texts), ("computed", map(_text, again[i]))]
    for name, cells in zip(one.computed_columns, again[len(one.columns) :], strict=True):
        columns.append((f"{name}, computed", map(_text, cells)))
    head, texts_of = zip(*columns, strict=True)
    return TextTable(
        one.number if one.number.startswith("Figure") else f"Table {one.number}",
        one.title,
        head,
        tuple(zip(*texts_of, strict=True)),
        one.remarks,
    )


def free_vibration() -> tuple[TextTable, ...]:
    """`free_vibration_peaks` in three tables: how far off each is, the times, and the peaks."""
    models = free_vibration_peaks()
    time, peak = measured_peaks()
    names = tuple(str(i) for i in range(1, len(models) + 1))
    summary = tuple(
        (name, m.model, m.law, f"{1e3 * m.rms_time:.2f}", f"{1e3 * m.rms_peak:.2f}")
        for name, m in zip(names, models, strict=True)
    )
    return (
        TextTable(
            "Free vibration from the first peak of Table A-1",
            f"Root mean squares of the errors of the first {len(time)} peaks by each model",
            ("", "model", "restitution", "rms of the times [ms]", "rms of the peaks [mm]"),
            summary,
            (
                f"The {len(time)} peaks are legible as scanned; those in repaired or guessed rows "
                "come later and do not count. The first is the start, without error, and counts. "
                "Measured times are printed in steps of 5 ms.",
                "F_k + 6 % is the factor of section 4.8.1, by an effective mass divided by 1.06. "
                "It changes the times only: no mass is in the peaks of a constant r.",
                "4-31 and 4-38 jump, most of all at 0.78 m/s, and small changes decide on which "
                "side a passage is (Figures 4-37 and 4-47). With F_k + 5 % in place of 6, or a "
                "rotation centre that moves out 10 % later, the peaks of 3 and 5 are half a "
                "millimetre nearer.",
            ),
        ),
        _numbered("Times of the peaks [s]", names, [time, *(m.time for m in models)], 4),
        _numbered(
            "Displacements at the peaks [mm]",
            names,
            [1e3 * peak, *(1e3 * m.peak for m in models)],
            2,
        ),
    )


def _numbered(
    heading: str, names: tuple[str, ...], columns: list[np.ndarray], decimals: int
) -> TextTable:
    rows = tuple(tuple(f"{x:.{decimals}f}" for x in row) for row in zip(*columns, strict=True))
    title = "Measured, and by the models as numbered above"
    return TextTable(heading, title, ("measured", *names), rows)


def _text(value: Cell) -> str:
    if value is None:
        return "–"
    return value if isinstance(value, str) else f"{value:.4g}"
