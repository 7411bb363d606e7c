"""AFAD, Turkey, the old text (.txt): 17 lines of header, columns N-S, E-W and U-D in gal."""

import re
from collections.abc import Sequence

from rockeom.motion.formats.grammar import Component, Page, in_si

COLUMNS = {"N-S": (0.0, False), "E-W": (90.0, False), "U-D": (None, True)}
"""Azimuth of each column, and whether it is vertical."""
HEADER = 17
"""Lines of the header; the next one names the columns."""


def recognises(head: Sequence[str]) -> bool:
    return head[0].startswith("STRONG GROUND MOTION RECORDS OF TURK")


def components(page: Page, gravity: float) -> list[Component]:
    """Three components of a file; its peaks are those of the raw record and are not compared."""

    def stated(label: str) -> tuple[int, str]:
        n, found = page.find(rf"^{re.escape(label)}\s*:\s*(.*?)\s*$", label, 1, HEADER)
        return n, found[1]

    count = page.whole(*stated("NUMBER OF DATA"), "the number of data")
    dt = page.positive(*stated("SAMPLING INTERVAL (sec)"), "the sampling interval")
    page.find(r"^RAW PGA VALUES \(gal\)\s*:", "the unit, gal", 1, HEADER)
    page.match(HEADER + 1, r"^\s*N-S\s+E-W\s+U-D\s*$", "the names of the columns, N-S E-W U-D")
    table, after = page.fixed(HEADER + 2, 3 * count, [12, 14, 13], "value")
    page.ends(after)
    return [
        Component(
            in_si(column, "gal", gravity), dt, name, "gal", 1, *COLUMNS[name],
            stated("STATION ID")[1], stated("EARTHQUAKE DATE")[1],
        )
        for name, column in zip(COLUMNS, table.reshape(-1, 3).T, strict=True)
    ]  # fmt: skip
