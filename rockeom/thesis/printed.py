"""Tables and lists of numbers of the thesis, as printed, and the specimens of its tests.

The printed cells are in text files, each row with its place in the thesis; `data/tables.toml` lists
the files with titles and remarks. Units of the tables are those of the page; the specimens are in
SI units.
"""

import csv
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.resources import files
from types import MappingProxyType
from typing import Any

Cell = str | float | None
Row = tuple[Cell, ...]


def number(cell: Cell) -> float:
    """The number in a cell; TypeError if it holds none."""
    if not isinstance(cell, float):
        raise TypeError(f"the cell {cell!r} holds no number")
    return cell


@dataclass(frozen=True)
class PrintedTable:
    """Table of the thesis, or a list of numbers under a figure.

    Parameters
    ----------
    number : str
        Number, "2-1", or "Figure 3-3" for a list.
    title : str
        Title.
    columns : tuple of str
        Name of each column. One with a unit in brackets holds numbers; "[-]" is that of a ratio.
    cells : tuple of tuple of str
        Cells of each row as printed, with all digits.
    places : tuple of str, optional
        Place of each row: the section, and the line of the thesis's text.
    scanned : tuple of str, optional
        Cells of each row as that text has them, where it is damaged.
    measured : tuple of str, optional
        Names of the columns that were measured and that no formula gives.
    computed_columns : tuple of str, optional
        Further columns, which the thesis does not print.
    remarks : tuple of str, optional
        Errors of the table, facts that the text leaves open, and the quantities from which it is
        computed.
    """

    number: str
    title: str
    columns: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    places: tuple[str, ...] = ()
    scanned: tuple[str, ...] = ()
    measured: tuple[str, ...] = ()
    computed_columns: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for row in self.cells:
            if len(row) != len(self.columns):
                raise ValueError(
                    f"table {self.number}: the row {row} has {len(row)} cells for "
                    f"{len(self.columns)} columns"
                )

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns without units."""
        return tuple(column.partition(" [")[0] for column in self.columns)

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """Cells of each row, as numbers in the columns that have a unit."""
        units = ["[" in column for column in self.columns]
        return tuple(
            tuple(float(cell) if unit else cell for cell, unit in zip(row, units, strict=True))
            for row in self.cells
        )

    def column(self, name: str) -> tuple[Cell, ...]:
        """Cells of a column.

        Parameters
        ----------
        name : str
            Name of the column without the unit.

        Returns
        -------
        tuple of Cell
            Cells.

        Raises
        ------
        KeyError
            If there is none.
        """
        names = self.names
        if name not in names:
            raise KeyError(f"table {self.number} has no column {name!r}, but {', '.join(names)}")
        return tuple(row[names.index(name)] for row in self.rows)

    def numbers(self, name: str) -> tuple[float, ...]:
        """Cells of a column of numbers.

        Parameters
        ----------
        name : str
            Name of the column without the unit.

        Returns
        -------
        tuple of float
            Numbers.

        Raises
        ------
        TypeError
            If a cell holds none.
        """
        return tuple(number(cell) for cell in self.column(name))

    def by_row(self, column: str) -> dict[Cell, Cell]:
        """Cells of a column by the first cell of each row."""
        first = (cells[0] for cells in self.rows)
        return dict(zip(first, self.column(column), strict=True))

    def cell(self, row: Cell, column: str) -> float:
        """Number in a row and a column.

        Parameters
        ----------
        row : Cell
            First cell of the row.
        column : str
            Name of the column.

        Returns
        -------
        float
            Number.

        Raises
        ------
        KeyError
            If there is none.
        """
        cells = self.by_row(column)
        if row not in cells:
            raise KeyError(f"table {self.number} has no row {row!r}, but {[*cells]}")
        return number(cells[row])


def _read(number: str, about: Mapping[str, Any], shared: Mapping[str, str]) -> PrintedTable:
    """A table by its entry in `data/tables.toml`."""
    text = files("rockeom").joinpath(about["file"]).read_text("utf-8")
    head, *rows = csv.reader(text.splitlines())
    width = head.index("place")
    return PrintedTable(
        number=number,
        title=about["title"],
        columns=tuple(head[:width]),
        cells=tuple(tuple(row[:width]) for row in rows),
        places=tuple(row[width] for row in rows),
        scanned=tuple("".join(row[width + 1 :]) for row in rows),
        measured=tuple(about.get("measured", ())),
        computed_columns=tuple(about.get("computed", ())),
        remarks=tuple(shared.get(remark, remark) for remark in about["remarks"]),
    )


def _tables() -> Mapping[str, PrintedTable]:
    text = files("rockeom.thesis").joinpath("data/tables.toml").read_text("utf-8")
    entries = tomllib.loads(text)
    shared = entries.pop("shared")
    return MappingProxyType(
        {number: _read(number, about, shared) for number, about in entries.items()}
    )


TABLES = _tables()
"""The printed tables, by number."""

TABLE_2_1 = TABLES["2-1"]
TABLE_3_1 = TABLES["3-1"]
TABLE_4_1 = TABLES["4-1"]
TABLE_4_2 = TABLES["4-2"]
TABLE_4_3 = TABLES["4-3"]
TABLE_4_4 = TABLES["4-4"]
TABLE_5_1 = TABLES["5-1"]
FIGURE_3_3 = TABLES["Figure 3-3"]
FIGURE_4_29 = TABLES["Figure 4-29"]
FIGURE_5_6 = TABLES["Figure 5-6"]
FIGURE_5_10 = TABLES["Figure 5-10"]


# --- the specimens

BLOCK = MappingProxyType({"half_width": 0.095, "half_height": 0.4549, "mass": 334.44})
"""Concrete block of chapter 3, 190 mm wide, its centroid 454.9 mm high [m, kg]."""

COLUMN = MappingProxyType(
    {
        "mass": 122.6,
        "height": 1.05,
        "inertia": 44.8,
        "base_mass": 45.6,
        "base_height": 0.10,
        "base_inertia": 1.37,
        "half_width": 0.285,
    }
)
"""Steel column of McManus (1980), chapter 5, as a lumped-mass structure [m, kg, kg m2].

The text fixes the masses, height, width and, by r = 0.74, inertia + base_inertia + base_mass
base_height**2 = 46.7; how that sum is divided is a choice.
"""

TENDON = MappingProxyType({"section": 177e-6, "rupture": 1100e6, "yield": 900e6})
"""Tendon of the wall of chapter 4, section 4.2: section [m2], strengths f_pu and f_py [Pa]."""

GAUGE = (0.285, 1.056)
"""Place of the displacement gauge: B' from the pivot and H' above it, Figure 5-5 [m]."""
