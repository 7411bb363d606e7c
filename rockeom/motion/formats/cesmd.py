"""CESMD, CDMG and USGS, the formats before COSMOS (.V1, .V2): components one after the other.

Each has lines of text, a hundred whole numbers, reals, the accelerations behind a line that states
their number, step, unit and FORTRAN format, in a V2 velocities and displacements, and an end line.
"""

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockeom.motion.formats.grammar import Component, Page, Peak, columns_of, each_until, in_si
from rockeom.motion.formats.text import short

_FIRST = r"uncorrected accelerogram data|corrected accelerogram\s+\S+\s+chan"
_RAW = (
    r"^\s*(\d+) accelerogram points at\s+(\S+) pts/sec in units of\s+(\S+?)\s*\.\s+"
    r"format:\s*(\(\S+\))"
)
_BLOCK = (
    r"^\s*(\d+) points of (accel|veloc|displ) data equally spaced at\s+(\S+) sec, "
    r"in (\S+?)\.?\s+(\(\S+\))"
)
BLOCKS = {"accel": "cm/sec2", "veloc": "cm/sec", "displ": "cm"}
"""Blocks of values in a V2 and their units."""


TEXT = {True: 13, False: 25}
"""Lines of text of each component of a raw file, a V1, and of a corrected one, a V2."""
UP = "500"
"""Azimuth, the 27th whole number of the header, of a vertical component."""


def recognises(head: Sequence[str]) -> bool:
    text = "\n".join(head).upper()
    return bool(re.match(_FIRST, head[0], re.IGNORECASE)) and "RENADIC" not in text


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    return each_until(page, lambda first: _component(page, first, gravity))


def _component(page: Page, first: int, gravity: float) -> tuple[Component, int]:
    """The component that begins at a line, and the line after its end."""
    kind = page.match(first, rf"^(?:{_FIRST})", "the first line of a component")[0]
    channel, found = page.find(
        r"^Chan\s+\d+:\s*(.*?)\s*(?:\(.*)?$", "the channel", first + 5, first + 8
    )
    station = page.find(r"^Station No\.?\s*(\S+)", "the station", first, first + 8)[1][1]
    is_raw = kind.lower().startswith("un")
    if is_raw:
        values, unit, dt, after, peak = _raw(page, first)
    else:
        values, unit, dt, after, peak = _corrected(page, first)
    page.match(after, r"^/&", "the end of the component")
    component = Component(
        in_si(values, unit, gravity), dt, found[1], unit, first, station=station,
        event=re.split(r"\s{2,}", page.lines[channel].strip())[0], peak=peak,
    )  # fmt: skip
    code = page.line(first + TEXT[is_raw] + 1, "whole numbers of the header")[50:55].strip()
    if code == UP:
        is_down = found[1][:1].upper() == "D"
        return replace(component, is_vertical=True, is_down=is_down), after + 1
    if code.isdecimal() and int(code) <= 360:
        return replace(component, azimuth=float(int(code) % 360)), after + 1
    return component.directed(), after + 1


def _raw(page: Page, first: int) -> tuple[np.ndarray, str, float, int, Peak]:
    """Values of a V1, their unit and step, the line after them, and the stated peak."""
    n, head = page.find(_RAW, "number, rate, unit and format of the values", first, first + 60)
    if head[3] != "g":
        raise page.error(n, f"the unit is {short(head[3])}, not g")
    count = page.whole(n, head[1], "the number of values")
    dt = 1 / page.positive(n, head[2], "the rate")
    values, after = page.fixed(n + 1, count, columns_of(page, n, head[4]), "value")
    line, peak = page.find(r"\bMax\s*=\s*(\S+)\s*g\b", "the peak", first, n)
    return values, "g", dt, after, Peak(peak[1], "g", line)


def _corrected(page: Page, first: int) -> tuple[np.ndarray, str, float, int, Peak]:
    """The same of a V2; velocities and displacements are read and left."""
    after = n = page.find(_BLOCK, "number, step, unit and format of the values", first, first + 60)[
        0
    ]
    blocks = []
    for kind, unit in BLOCKS.items():
        head = page.match(after, _BLOCK, f"number, step and format of {kind}")
        if (head[2].lower(), head[4].lower()) != (kind, unit):
            raise page.error(after, f"{head[2]} in {head[4]}, where {kind} in {unit} is expected")
        count = page.whole(after, head[1], "the number of values")
        block, after = page.fixed(after + 1, count, columns_of(page, after, head[5]), "value")
        blocks.append(block)
    dt = page.positive(n, page.match(n, _BLOCK, "the step")[3], "the step")
    line, peak = page.find(r"^Peak acceleration\s*=\s*(\S+)\s+cm/sec", "the peak", first, n)
    return blocks[0], "cm/s2", dt, after, Peak(peak[1], "cm/s2", line)
