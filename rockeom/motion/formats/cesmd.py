"""CESMD, CDMG and USGS, the formats before COSMOS (.V1, .V2): components one after the other.

Each has lines of text, a hundred whole numbers, reals, the accelerations behind a line that states
their number, step, unit and FORTRAN format, in a V2 velocities and displacements, and an end line.
"""

import re

from rockeom.motion.formats.grammar import Component, Page, Peak, fortran, in_si
from rockeom.motion.formats.text import short

_END = r"^/&"
_ACCELERATION = (
    r"^\s*(\d+)\s+(?:points of accel data equally spaced at\s+(\S+)\s+sec, in\s+(\S+?)\.?\s+|"
    r"accelerogram points at\s+(\S+)\s+pts/sec in units of\s+(\S+?)\s*\.\s+format:\s*)(\(\S+\))"
)
_OTHER = r"^\s*(\d+)\s+points of (?:veloc|displ) data .*(\(\S+\))"


def recognises(page: Page) -> bool:
    first = page.lines[0].lower()
    others = ("renadic", "mms", "format v01")
    return (
        first.startswith("uncorrected accelerogram data")
        or bool(re.match(r"corrected accelerogram\s+\S+\s+chan", first))
    ) and not any(word in line.lower() for line in page.lines[:13] for word in others)


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    found, first = [], 1
    while first <= len(page) and any(line.strip() for line in page.lines[first - 1 :]):
        one, first = _component(page, first, gravity)
        found.append(one)
    return found


def _component(page: Page, first: int, gravity: float) -> tuple[Component, int]:
    """The component that begins at a line, and the line after its end."""
    is_raw = page.lines[first - 1].lower().startswith("un")
    end = next((n for n in range(first, len(page) + 1) if re.match(_END, page.lines[n - 1])), None)
    if end is None:
        raise page.error(len(page), 'the component has no line "/&" at its end')
    channel, _ = page.find(r"^Chan\s+\d+:", "the channel, Chan  1: N", first, min(first + 12, end))
    name = page.match(channel, r"^Chan\s+\d+:\s*(.*?)\s*(?:\(.*)?$", "the channel")[1]
    n, data = page.find(
        _ACCELERATION, "the number, step and format of the accelerations", first, end
    )
    count = page.whole(n, data[1], "the number of values")
    dt = (
        page.positive(n, data[2], "the step")
        if data[2]
        else 1 / page.positive(n, data[4], "the rate")
    )
    unit = "cm/s2" if data[3] and data[3].lower().startswith("cm/sec") else (data[5] or data[3])
    if unit not in ("cm/s2", "g"):
        raise page.error(n, f"the unit is {short(unit)}, not cm/sec2 or g")
    after = n
    values = None
    for block in ("accelerations", *(() if is_raw else ("velocities", "displacements"))):
        form = (
            data[6]
            if values is None
            else page.match(after, _OTHER, f"the number and format of the {block}")[2]
        )
        columns = fortran(form)
        if columns is None:
            raise page.error(after, f"the format is {short(form)}, not such as (8f10.6)")
        numbers, after = page.fixed(after + 1, count, columns[1], "value")
        values = numbers if values is None else values
    if after != end:
        raise page.error(after, f"{short(page.lines[after - 1])} stands where the component ends")
    assert values is not None
    station = (
        page.match(first + 4, r"^Station No\.?\s*(\S+)", "the station")[1] if not is_raw else ""
    )
    return (
        Component(
            in_si(values, unit, gravity), dt, name, unit, first, station=station or _station(page, first, end),
            event=page.lines[first + (1 if is_raw else 2) - 1].strip(), peak=_peak(page, first, n, is_raw),
        ).directed(),
        end + 1,
    )  # fmt: skip


def _station(page: Page, first: int, end: int) -> str:
    return page.find(r"^Station No\.?\s*(\S+)", "the station", first, min(first + 10, end))[1][1]


def _peak(page: Page, first: int, last: int, is_raw: bool) -> Peak:
    """The peak of the accelerations themselves; in a corrected file that of the raw ones is another."""
    pattern, unit = (
        (r"(?<!Un)\bMax\s*=\s*(\S+)\s*g\b", "g")
        if is_raw
        else (r"^Peak acceleration\s*=\s*(\S+)\s+cm/sec", "cm/s2")
    )
    n, found = page.find(pattern, "the peak acceleration", first, last)
    return Peak(found[1], unit, n)
