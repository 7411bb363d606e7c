"""Statements on printed numbers alone: cells of tables, numbers of equations and figures."""

import itertools

import numpy as np

from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.statements import statement as st
from rockeom.thesis.tables import TABLES

# --- cells


def _sizes(table: str, columns: str, rows: str) -> np.ndarray:
    """(m, n) sizes of numbers in columns and rows, each with " | " between them."""
    names = itertools.product(columns.split(" | "), rows.split(" | "))
    cells = [abs(TABLES[table].cell(row, column)) for column, row in names]
    return np.reshape(cells, (len(columns.split(" | ")), -1))


def _said(columns: str, rows: str, values: np.ndarray) -> str:
    """Each column with its numbers, and the rows."""
    of = zip(columns.split(" | "), values, strict=True)
    said = "; ".join(f"{name} {', '.join(f'{x:.3g}' for x in line)}" for name, line in of)
    return f"{said} ({rows.replace(' |', ',')})"


def largest(table: str, column: str) -> st.Finding:
    """The largest size in a column."""
    most = max(map(abs, TABLES[table].numbers(column)))
    return st.finding(most, f"{most:g} at most")


def ends(table: str, column: str, rows: str) -> st.Finding:
    """The smallest and the largest size in some rows of a column."""
    values = _sizes(table, column, rows)
    return st.finding(
        [values.min(), values.max()], f"{values.min():g} to {values.max():g} in these runs"
    )


def cells(table: str, column: str, rows: str) -> st.Finding:
    """Sizes in some rows of a column."""
    values = _sizes(table, column, rows)
    return st.finding(values.ravel(), _said(column, rows, values))


def columns(table: str, over: str, under: str, rows: str) -> st.Finding:
    """Columns over another one."""
    ratios = _sizes(table, over, rows) / _sizes(table, under, rows)
    return st.finding(ratios.ravel(), _said(over, rows, ratios))


def rows(table: str, names: str, over: str, under: str) -> st.Finding:
    """Rows over other ones, in each of some columns."""
    ratios = _sizes(table, names, over) / _sizes(table, names, under)
    return st.finding(ratios.ravel(), _said(names, f"{over} over {under}", ratios))


# --- references of the text


def equation(number: str, word: str) -> st.Finding:
    """Whether the meaning of an equation has a word in it."""
    meaning = EQUATIONS[number].meaning
    return st.finding(word in meaning, f"{number} is the {meaning}")


def caption(number: str, words: str, word: str) -> st.Finding:
    """Whether the caption of a figure has a word in it."""
    return st.finding(word in words, f'Figure {number} is "{words}"')


def elsewhere(number: str, words: str) -> st.Finding:
    """A number as the text has it in other words."""
    if number not in words:
        raise ValueError(f"no {number} in {words!r}")
    return st.finding(float(number), f'elsewhere "{words}"')
