"""CESMD, CDMG and USGS, the formats before COSMOS (.V1, .V2): components one after the other.

Each has lines of text, a hundred whole numbers, reals, the accelerations behind a line that states
their number, step, unit and FORTRAN format, in a V2 velocities and displacements, and an end line.
"""

import re
from collections.abc import Sequence

import numpy as np

from rockeom.motion.formats.grammar import (
    Component,
    Page,
    Peak,
    columns_of,
    direction_and_place,
    each_until,
    in_si,
)
from rockeom.motion.formats.text import other_quantity, short

_FIRST = r"uncorrected accelerogram data|corrected accelerogram\s+\S+\s+chan"
_SPECTRA = r"response and fourier amplitude spectra"
_RAW = (
    r"^\s*(\d+) accelerogram points at\s+(\S+) pts/sec in units of\s+(\S+?)\s*\.\s+"
    r"format:\s*(\(\S+\))"
)
_BLOCK = (
    r"^\s*(\d+) points of (accel|veloc|displ) data equally spaced at\s+(\S+) sec[,.]\s+"
    r"(?:in |\(units:\s*)(\S+?)[.)]?\s*(\(\S+\))?\s*$"
)
BLOCKS = {
    "accel": ("cm/sec2", "cm/sec/sec"),
    "veloc": ("cm/sec",),
    "displ": ("cm",),
}
"""Blocks of values in a V2 and the names of their units."""
WITHOUT_FORMAT = {True: "(8f9.6)", False: "(8f10.3)"}
"""Format of a raw file and of a corrected one that states none, as CDMG wrote them before 1996."""


TEXT = {True: 13, False: 25}
"""Lines of text of each component of a raw file, a V1, and of a corrected one, a V2."""
UP = "500"
"""Azimuth, the 27th whole number of the header, of a vertical component."""


def recognises(head: Sequence[str]) -> bool:
    return bool(re.match(f"{_FIRST}|{_SPECTRA}", head[0], re.IGNORECASE))


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    if re.match(_SPECTRA, page.lines[0], re.IGNORECASE):
        raise other_quantity(page.path, 1, "spectra", f"the line says {short(page.lines[0])}")
    return each_until(page, lambda first: _component(page, first, gravity))


def _component(page: Page, first: int, gravity: float) -> tuple[Component, int]:
    """The component that begins at a line, and the line after its end."""
    kind = page.match(first, rf"^(?:{_FIRST})", "the first line of a component")[0]
    channel, found = page.find(
        r"^Chan\s+\d+:\s*(.*?)\s*(?:\(.*)?$", "the channel", first + 5, first + 8
    )
    station = page.find(r"^Station (?:No|Id)\.?\s*(\S+)", "the station", first, first + 8)[1][1]
    is_raw = kind.lower().startswith("un")
    if is_raw:
        values, unit, dt, after, peak = _raw(page, first)
    else:
        values, unit, dt, after, peak = _corrected(page, first)
    page.match(after, r"^/&", "the end of the component")
    station = " ".join(filter(None, (station, direction_and_place(found[1])[1])))
    component = Component(
        in_si(values, unit, gravity), dt, found[1], unit, first, station=station,
        event=re.split(r"\s{2,}", page.lines[channel].strip())[0], peak=peak,
        stage="uncorrected" if is_raw else "corrected",
    )  # fmt: skip
    line = first + TEXT[is_raw] + 1
    code = page.line(line, "whole numbers of the header")[50:55].strip()
    azimuth = int(code) if code.isascii() and code.isdecimal() and 1 <= int(code) <= 360 else None
    return component.along(page, line, azimuth, code == UP), after + 1


def _raw(page: Page, first: int) -> tuple[np.ndarray, str, float, int, Peak]:
    """Values of a V1, their unit and step, the line after them, and the stated peak."""
    what = "number, rate, unit and format of the values"
    n, head = page.find(f"{_RAW}|{_BLOCK}", what, first, first + 60)
    points, rate, unit, form, number, _, step, unit_too, form_too = head.groups()
    if (unit or unit_too).lower() != "g":
        raise page.error(n, f"the unit is {short(unit or unit_too)}, not g")
    count = page.whole(n, points or number, "the number of values")
    dt = 1 / page.positive(n, rate, "the rate") if rate else page.positive(n, step, "the step")
    columns = columns_of(page, n, form or form_too or WITHOUT_FORMAT[True])
    values, after = page.fixed(n + 1, count, columns, "value")
    line, peak = page.find(r"\bMax\s*=\s*(\S+)\s*g\b", "the peak", first, n)
    return values, "g", dt, after, Peak(peak[1], "g", line)


def _corrected(page: Page, first: int) -> tuple[np.ndarray, str, float, int, Peak]:
    """The same of a V2; velocities and displacements are read and left."""
    after = n = page.find(_BLOCK, "number, step, unit and format of the values", first, first + 60)[
        0
    ]
    blocks = []
    for kind, units in BLOCKS.items():
        head = page.match(after, _BLOCK, f"number, step and unit of {kind}")
        if head[2].lower() != kind or head[4].lower() not in units:
            what = f"{head[2]} in {head[4]}, where {kind} in {units[0]} is expected"
            raise page.error(after, what)
        count = page.whole(after, head[1], "the number of values")
        columns = columns_of(page, after, head[5] or WITHOUT_FORMAT[False])
        block, after = page.fixed(after + 1, count, columns, "value")
        blocks.append(block)
    dt = page.positive(n, page.match(n, _BLOCK, "the step")[3], "the step")
    line, peak = page.find(r"^Peak acceleration\s*=\s*(\S+)\s+cm/sec", "the peak", first, n)
    return blocks[0], "cm/s2", dt, after, Peak(peak[1], "cm/s2", line)
