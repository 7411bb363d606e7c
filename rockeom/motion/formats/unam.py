"""UNAM, Mexico, the standard file 2.0: a header of 109 lines, columns of the channels in gal."""

import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rockeom.files import in_text
from rockeom.motion.components import azimuth_and_vertical
from rockeom.motion.formats.grammar import Component, Page, Peak, columns_of, in_si
from rockeom.motion.formats.text import short
from rockeom.numbers.callers import warn_caller

_DATA = "DATOS DE ACELERACION:"
"""Line in front of the values: a rule, names and directions of the columns, and a rule follow."""


class Field(NamedTuple):
    """Values of each channel that a line of the header states, and the number of the line."""

    line: int
    values: list[str]


def recognises(head: Sequence[str]) -> bool:
    return any(line.startswith("ARCHIVO ESTANDAR DE ACELERACION") for line in head[:10])


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    head = next((n for n, line in enumerate(page.lines, 1) if line.startswith(_DATA)), None)
    if head is None:
        raise page.error(None, f"no line {_DATA} in front of the values")
    oriented = _of_channels(page, head, "ORIENTACION C1-C6 (rumbo;orientacion)")
    names = [_direction(page, oriented.line, text) for text in oriented.values]
    steps, counts, peaks = (
        _of_channels(page, head, label, len(names))
        for label in (
            "INTERVALO DE MUESTREO, C1-C6 (s)",
            "NUM. TOTAL DE MUESTRAS, C1-C6",
            "ACEL. MAX.(Gal), C1-C6",
        )
    )
    for n, values in (steps, counts):
        if len(set(values)) > 1:
            raise page.error(n, f"the channels differ here, {', '.join(values)}, and must not")
    above = page.match(head + 3, r"^\s*(.*?)\s*$", "the directions")[1].split()
    if [_direction(page, head + 3, text) for text in above] != names:
        raise page.error(
            head + 3, f"the directions are not those of line {oriented.line}, {', '.join(names)}"
        )
    dt = page.positive(steps.line, steps.values[0], "the step")
    count = page.whole(counts.line, counts.values[0], "the number of values")
    table = _table(page, head, count, len(names))
    station = _stated(page, head, "CLAVE DE LA ESTACION")[1]
    when = ("FECHA DEL SISMO [GMT]", "HORA EPICENTRO (GMT)")
    event = " ".join(_stated(page, head, label)[1] for label in when)
    return [
        Component(
            in_si(column, "gal", gravity), dt, name, "gal", 1, station=station, event=event,
            peak=Peak(peak, "gal", peaks.line),
        ).directed()
        for name, peak, column in zip(names, peaks.values, table.T, strict=True)
    ]  # fmt: skip


def _table(page: Page, head: int, count: int, channels: int) -> np.ndarray:
    """Values (count, channels); a warning counts the rows beyond those of the header."""
    n, unit = _stated(page, head, "UNIDADES DE LOS DATOS")
    if not unit.startswith("Gal"):
        raise page.error(n, f"the unit is {short(unit)}, not Gal")
    n, form = _stated(page, head, "FORMATO DATOS (FORTRAN,10 campos/dato)")
    columns = columns_of(page, n, form)
    if len(columns) != channels:
        raise page.error(n, f"the format is {short(form)}, for {channels} channels")
    table, after = page.fixed(head + 5, count * channels, columns, "value")
    end = after
    while after <= len(page) and page.lines[after - 1].strip():
        _, after = page.fixed(after, channels, columns, "value")
    page.ends(after)
    if after > end:
        warn_caller(
            f"{in_text(page.path).name}: the header counts {count} rows, and {after - end} more "
            f"from line {end} on are left out"
        )
    return table.reshape(-1, channels)


def _stated(page: Page, head: int, label: str) -> tuple[int, str]:
    n, found = page.find(rf"^{re.escape(label)}\s*:\s*(.*?)\s*$", label, 1, head)
    return n, found[1]


def _of_channels(page: Page, head: int, label: str, channels: int | None = None) -> Field:
    """The values of a field: those of channels 1 to 6, and of 7 to 12 in a line of their own."""
    line, text = _stated(page, head, label)
    more = label.replace("C1-C6", "C7-C12")
    if any(one.startswith(more) for one in page.lines[:head]):
        text = f"{text.strip('/')}/{_stated(page, head, more)[1].strip('/')}".rstrip("/")
    values = [part.strip() for part in text.removeprefix("/").split("/")]
    if channels is not None and len(values) != channels:
        raise page.error(line, f"{len(values)} values for {channels} channels")
    return Field(line, values)


def _direction(page: Page, line: int, text: str) -> str:
    """The bearing in front of a semicolon, or V for vertical, without a plus."""
    name, _, letter = text.partition(";")
    name = name.removeprefix("+")
    if azimuth_and_vertical(name) == (None, False) or "-" in letter:
        raise page.error(line, f"the direction is {short(text)}, not V or such as N90E")
    return name
