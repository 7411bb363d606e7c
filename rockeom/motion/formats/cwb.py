"""CWB and CWA, Taiwan, free field (.dat): columns of time, U, N and E in gal."""

import re
from collections.abc import Sequence

import numpy as np

from rockeom.motion.formats.grammar import Component, Page, Peak, columns_of, in_si
from rockeom.motion.formats.text import number_of, short

NAMES = {"U": (None, True), "N": (0.0, False), "E": (90.0, False)}
"""Azimuth of each column, and whether it is vertical."""


def recognises(head: Sequence[str]) -> bool:
    return head[0].startswith("#Earthquake Information")


def components(page: Page, gravity: float) -> list[Component]:
    """Three components of a file."""
    last = next((n for n, line in enumerate(page.lines, 1) if line.startswith("#Data:")), None)
    if last is None:
        raise page.error(None, "no line #Data: with the format of the values")
    rate = _stated(page, "SampleRate(Hz)", last)
    length = _stated(page, "RecordLength(sec)", last)
    unit_line, unit = page.find(r"^#AmplitudeUnit:\s*(\w+)", "the unit", 1, last)
    if unit[1].lower() != "gal":
        raise page.error(unit_line, f"the unit is {short(unit[1])}, not gal")
    order_line, order = page.find(
        r"^#DataSequence:\s*Time\s+([UNE])\(\+\);\s*([UNE])\(\+\);\s*([UNE])\(\+\)",
        "the order of the columns",
        1,
        last,
    )
    if sorted(order.groups()) != ["E", "N", "U"]:
        raise page.error(order_line, f"the columns are {', '.join(order.groups())}")
    columns = columns_of(page, last, page.match(last, r"^#Data:\s*(\S+)", "the format")[1])
    if len(columns) != 4:
        raise page.error(last, f"the format is {short(page.lines[last - 1])}, not such as 4F10.3")
    hertz = page.positive(*rate, "the sample rate")
    count = page.count(length[0], hertz, page.positive(*length, "the length"))
    table, after = page.fixed(last + 1, 4 * count, columns, "number")
    page.ends(after)
    table = table.reshape(-1, 4)
    off = np.abs(table[:, 0] - table[0, 0] - np.arange(count) / hertz)
    if off.max() > 0.0011:
        n = int(off.argmax())
        raise page.error(
            last + 1 + n,
            f"the time is {table[n, 0]:g} s, {off[n]:.3g} s off the {hertz:g} samples a second",
        )
    station = page.find(r"^#StationCode:\s*(\S+)", "the station's code", 1, last)[1][1]
    event = page.find(r"^#Origin Time.*?:\s*(\S+)", "the origin time", 1, last)[1][1]
    return [
        Component(
            in_si(table[:, 1 + i], "gal", gravity), 1 / hertz, name, "gal", 1, *NAMES[name],
            station, event, _peak(page, name, last),
        )
        for i, name in enumerate(order.groups())
    ]  # fmt: skip


def _stated(page: Page, label: str, last: int) -> tuple[int, str]:
    n, found = page.find(rf"^#{re.escape(label)}:\s*(\S+)\s*$", label, 1, last)
    return n, found[1]


def _peak(page: Page, name: str, last: int) -> Peak:
    """The larger of the two peaks of a column."""
    n, found = page.find(
        rf"^#AmplitudeMAX\. {name}:\s*(\S+?)\s*~\s*(\S+)", f"the peaks of {name}", 1, last
    )
    high, low = found.groups()
    larger = max((high, low), key=lambda text: abs(number_of(text, page.path, n, "a peak")))
    return Peak(larger, "gal", n)
