"""COSMOS 1.2 (.V1, .V2, .V2c): text, whole numbers, reals, comments, values, and their formats."""

import re
from collections.abc import Sequence
from dataclasses import replace

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
from rockeom.motion.formats.text import cut, other_quantity, short

_FIRST = r"\(format v0?1\.\d+ with (\d{1,3}) text lines\)"
_KIND = r"^\s*(uncorrected|corrected)\s+accel"
_WHOLE = (
    r"^\s*(\d{1,6}) integer-header values follow on\s+(\d+) lines, format\s*=\s*"
    r"\((\d{1,3})I(\d\d?)\)"
)
_REAL = r"^\s*(\d{1,6}) real-header values follow on\s+(\d+) lines, format\s*=\s*(\(\S+\))"
_COMMENTS = r"^\s*(\d{1,6}) comment line\(s\) follow"
_DATA = (
    r"^\s*(\d+)\s+(?:raw\s+)?((?:accel|veloc|displ)\S*)\s+pts,\s*approx\s+(\S+)\s+secs,\s*"
    r"units=\s*(\S+?)\.?\s*\((\d{1,3})\),?\s*format\s*=\s*(\(\S+\))"
)
CM, G, COUNTS = "cm/s2", "g", 50
UNITS = {4: (CM, ("cm/sec2", "cm/s2", "cm/sec/sec", "cm/s/s")), 2: (G, ("g",))}
"""Unit of acceleration by its code, with its names in files."""
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
    kind = re.match(_KIND, page.lines[first - 1], re.IGNORECASE)
    if kind is None and first == 1:
        quantity = cut(page.lines[0].partition("(")[0].lower())
        raise other_quantity(page.path, 1, quantity, "so its first line says")
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
    if count <= AZIMUTH or len(reals) <= STEP:
        raise page.error(first + texts, f"{count} whole numbers and {len(reals)} reals are too few")
    comments = [page.match(n, r"^\s*(\|.*)", "a comment, |")[1] for n in lines]
    after = lines.stop
    data = page.match(after, _DATA, "the number, unit and format of the values")
    is_acceleration = data[2].lower().startswith("acc")
    if not is_acceleration and first == 1:
        raise other_quantity(page.path, after, data[2], f"the line says {short(data[0])}")
    if int(data[5]) == COUNTS:
        raise other_quantity(page.path, after, "raw counts", f"the line says {short(data[0])}")
    unit, names = UNITS.get(int(data[5]), (CM, ()))
    if data[4].lower().replace("^", "") not in names and is_acceleration:
        what = f"the unit is {data[4]} ({data[5]}), and not cm/sec2 (04) or g (02)"
        raise page.error(after, what, "take the record in units, V1 or V2")
    count = page.whole(after, data[1], "the number of values")
    seconds = page.positive(after, data[3], "the length")
    line = after
    values, after = page.fixed(after + 1, count, columns_of(page, after, data[6]), "value")
    page.match(after, r"^\s*(?:/&|end-of-data)", "the end of the component")
    if not is_acceleration:
        return None, after + 1
    dt = float(reals[STEP]) / 1000
    if not (dt > 0 and abs(count * dt - seconds) <= 1 + 0.02 * seconds):
        raise page.error(
            line, f"some {seconds:g} s, where {count} steps of {reals[STEP]:g} ms, "
            f"real {STEP + 1} of the header, are {count * dt:g} s",
        )  # fmt: skip
    component = Component(
        in_si(values, unit, gravity), dt, "", unit, first, stage=kind[1].lower() if kind else ""
    )
    return _described(page, component, whole, comments), after + 1


def _described(
    page: Page, component: Component, whole: np.ndarray, comments: list[str]
) -> Component:
    """A component with its direction, station, event and peak."""
    first = component.line
    channel = r"^Sta (?:Cha|Chan)\s*:?\s*(?:\S+?)\s*:\s*(.*?)\s*(?:\(Rcrdr.*?\)\s*(.*?)\s*)?$"
    name, place = page.match(first + 8, channel, "the channel").groups("")
    place = direction_and_place(f"{name}  {place}")[1]
    azimuth, code = round(whole[AZIMUTH]), ""
    if code := next((m[1] for text in comments if (m := re.search(_SCNL, text))), ""):
        name = code
    peak = re.search(r"\bMax\s*=\s*(\S+)\s+(cm/sec2|g)\b", page.lines[first + 9], re.IGNORECASE)
    number, own = page.match(first + 4, r"No:\s*(.*?)\s*Code:(\S*)", "the station's code").groups()
    component = replace(
        component, name=name, station=" ".join(filter(None, (own or number, place))),
        event=page.lines[first].strip(),
        peak=Peak(peak[1], CM if len(peak[2]) > 1 else G, first + 10) if peak else None,
    )  # fmt: skip
    letter = code[-1:].upper()
    is_vertical = azimuth in (*UP, DOWN) or letter == "Z"
    stated = azimuth if 1 <= azimuth <= 360 else None
    if (stated and letter == "Z") or (is_vertical and letter in ("N", "E")):
        raise page.error(first, f"the header states the azimuth {azimuth}, and the code {code}")
    component = component.along(page, first + 8, stated, is_vertical)
    return replace(component, is_down=component.is_down or azimuth == DOWN)
