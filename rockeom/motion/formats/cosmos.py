"""COSMOS 1.2 (.V1, .V2, .V2c): text, whole numbers, reals, comments, values, and their formats."""

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockeom.motion.formats.grammar import Component, Page, Peak, columns_of, each_until, in_si
from rockeom.motion.formats.text import other_quantity, short

_FIRST = r"\(format v0?1\.\d+ with (\d+) text lines\)"
_WHOLE = r"^\s*(\d+) integer-header values follow on\s+(\d+) lines, format=\s*\((\d+)I(\d+)\)"
_REAL = r"^\s*(\d+) real-header values follow on\s+(\d+) lines, format=\s*(\(\S+\))"
_COMMENTS = r"^\s*(\d+) comment line\(s\) follow"
_DATA = (
    r"^\s*(\d+)\s+(?:raw\s+)?((?:accel|veloc|displ)\S*)\s+pts,\s*approx\s+\S+\s+secs,\s*"
    r"units=\s*(\S+?)\s*\((\d+)\),\s*format=\s*(\(\S+\))"
)
UNITS = {("cm/sec2", 4): "cm/s2", ("g", 2): "g"}
"""Units of acceleration by their name and code."""
UP, DOWN = (400, 402), 401
"""Azimuths, by code, of vertical components: up, of no stated sense, and down."""
AZIMUTH, STEP = 53, 61
"""Places, from 0, of the azimuth among the whole numbers and of the step [ms] among the reals."""
_SCNL = r"<SCNL>\s*\S+?\.(\w{3})\."


def recognises(head: Sequence[str]) -> bool:
    return bool(re.search(_FIRST, head[0], re.IGNORECASE))


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    return each_until(page, lambda first: _component(page, first, gravity))


def _component(page: Page, first: int, gravity: float) -> tuple[Component | None, int]:
    """The component that begins at a line, and the line after its end.

    None for velocities and displacements behind accelerations.
    """
    texts = int(page.match(first, _FIRST, "the first line of a COSMOS file")[1])
    after = first + texts
    header = page.match(after, _WHOLE, "the whole numbers of the header")
    count, _, per_line, width = map(int, header.groups())
    whole, after = page.fixed(after + 1, count, [width] * per_line, "whole number of the header")
    head = page.match(after, _REAL, "the reals of the header")
    columns = columns_of(page, after, head[3])
    reals, after = page.fixed(after + 1, int(head[1]), columns, "real of the header")
    lines = range(
        after + 1, after + 1 + int(page.match(after, _COMMENTS, "the number of comments")[1])
    )
    comments = [page.match(n, r"^\s*(\|.*)", "a comment, |")[1] for n in lines]
    after = lines.stop
    data = page.match(after, _DATA, "the number, unit and format of the values")
    is_acceleration = data[2].lower().startswith("acc")
    if not is_acceleration and first == 1:
        raise other_quantity(page.path, after, data[2], f"the line says {short(data[0])}")
    unit = UNITS.get((data[3].lower().replace("^", ""), int(data[4])))
    if unit is None and is_acceleration:
        what = f"the unit is {data[3]} ({data[4]}), and not cm/sec2 (04) or g (02)"
        raise page.error(after, what, "take the record in units, V1 or V2")
    count = page.whole(after, data[1], "the number of values")
    values, after = page.fixed(after + 1, count, columns_of(page, after, data[5]), "value")
    page.match(after, r"^\s*(?:/&|end-of-data)", "the end of the component")
    if unit is None or not is_acceleration:
        return None, after + 1
    return _described(
        page, first, in_si(values, unit, gravity), unit, whole, reals, comments
    ), after + 1


def _described(
    page: Page,
    first: int,
    values: np.ndarray,
    unit: str,
    whole: np.ndarray,
    reals: np.ndarray,
    comments: list[str],
) -> Component:
    """A component with its step, direction, station, event and peak."""
    dt = float(reals[STEP]) / 1000
    if not dt > 0:
        raise page.error(first, f"the step is {reals[STEP]:g} ms in real {STEP + 1} of the header")
    azimuth = round(whole[AZIMUTH])
    channel = r"^Sta (?:Cha|Chan)\s*:?\s*(?:\S+?)\s*:\s*(.*?)\s*(?:\(Rcrdr|$)"
    name = page.match(first + 8, channel, "the channel")[1]
    if code := next((m[1] for text in comments if (m := re.search(_SCNL, text))), None):
        name = code
    peak = None
    if found := re.search(r"\bMax\s*=\s*(\S+)\s+cm/sec2", page.lines[first + 9], re.IGNORECASE):
        peak = Peak(found[1], "cm/s2", first + 10)
    component = Component(
        values, dt, name, unit, first, peak=peak,
        station=page.match(first + 4, r"\bCode:\s*(\S+)", "the station's code")[1],
        event=page.lines[first].strip(),
    )  # fmt: skip
    if azimuth in (*UP, DOWN) or (code and code.upper().endswith("Z")):
        return replace(component, is_vertical=True, is_down=azimuth == DOWN)
    if 1 <= azimuth <= 360:
        return replace(component, azimuth=float(azimuth % 360))
    return component.directed()
