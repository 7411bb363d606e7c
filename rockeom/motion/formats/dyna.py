"""DYNA 1.2 (.ASC): ESM, ITACA and AFAD's TADAS; 64 lines "KEY: value", then a value a line."""

import re
from collections.abc import Sequence

from rockeom.motion.formats.grammar import AGAIN, Component, Page, Peak, in_si
from rockeom.motion.formats.text import other_quantity, short

HEADER = 64
"""Lines of the header."""


def recognises(head: Sequence[str]) -> bool:
    return head[0].startswith("EVENT_NAME:")


def components(page: Page, gravity: float) -> list[Component]:
    """The one component of a file."""
    lines: dict[str, tuple[int, str]] = {}
    for n in range(1, HEADER + 1):
        key, value = page.match(
            n, r"^([A-Z][^:]*):(.*)$", "a line KEY: value of the header"
        ).groups()
        if key in lines:
            raise page.error(n, f"{key} is in line {lines[key][0]} already")
        lines[key] = n, value.strip()

    def stated(key: str) -> tuple[int, str]:
        if key not in lines:
            raise page.error(None, f"the header of {HEADER} lines has no {key}")
        return lines[key]

    n, version = stated("HEADER_FORMAT")
    if version != "DYNA 1.2":
        raise page.error(n, f"the format is {short(version)}", "export the record as DYNA 1.2")
    n, kind = stated("DATA_TYPE")
    if kind.upper() != "ACCELERATION":
        raise other_quantity(page.path, n, kind.lower(), f"DATA_TYPE is {short(kind)}")
    n, unit = stated("UNITS")
    if unit.replace("**", "^") != "cm/s^2":
        raise page.error(n, f"the unit is {short(unit)}, and cm/s^2 belongs to an acceleration")
    dt = page.positive(*stated("SAMPLING_INTERVAL_S"), "SAMPLING_INTERVAL_S")
    count = page.whole(*stated("NDATA"), "NDATA")
    first = HEADER + 1
    fields = [
        page.line(n, f"sample {n - HEADER} of {count}").strip() for n in range(first, first + count)
    ]
    values = page.numbers(fields, list(range(first, first + count)), "sample")
    page.ends(first + count)
    name = stated("STREAM")[1]
    line, peak = stated("PGA_CM/S^2")
    azimuth = {"N": 0.0, "E": 90.0}.get(name[-1:].upper())
    if not re.fullmatch(r"[A-Z]{2}[A-Z0-9]|[ENZ]", name):
        raise page.error(
            stated("STREAM")[0], f"the component is {short(name)}, not a code such as HNE", AGAIN
        )

    def joined(mark: str, *keys: str) -> str:
        return mark.join(filter(None, (lines.get(key, (0, ""))[1] for key in keys)))

    return [
        Component(
            in_si(values, unit, gravity), dt, name, unit, 1, azimuth, name[-1] == "Z",
            joined(".", "NETWORK", "STATION_CODE", "LOCATION"),
            joined(" ", "EVENT_NAME", "EVENT_DATE_YYYYMMDD", "EVENT_TIME_HHMMSS"),
            Peak(peak, unit, line) if peak else None, stage=joined("", "PROCESSING"),
        )
    ]  # fmt: skip
