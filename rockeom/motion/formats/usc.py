"""USC, Los Angeles (.s0a): one corrected component, values of 10 characters in cm/s2."""

import re
from collections.abc import Sequence

from rockeom.motion.formats.grammar import Component, Page, Peak, in_si

_VALUES = r"^\s*(\d+) POINTS OF (ACC|VEL|DIS) DATA EQUALLY SPACED AT\s+(\S+) SEC\.\s+IN UNITS (\S+)"
BLOCKS = (("ACC", "CM/SEC/SEC"), ("VEL", "CM/SEC"), ("DIS", "CM"))

HEADER = 46
"""Lines up to the one that states the number and step of the accelerations."""


def recognises(head: Sequence[str]) -> bool:
    first = head[0]
    return bool(
        re.match(r"(?:UN)?CORRECTED ACCELEROGRAM\s+\S+.* COMP .*FILE", first)
        or re.match(r"FILE\s+\d+\s+OF UNCORRECTED ACCELEROGRAM DATA", first)
    )


def components(page: Page, gravity: float) -> list[Component]:
    """The one component of a file."""
    if not page.lines[0].startswith("CORRECTED"):
        raise page.error(
            1, "this is an uncorrected accelerogram of USC", "take the corrected one, .s0a"
        )
    name = page.match(8, r"^COMP\s+(\S+)", "the component, COMP N08W")[1]
    station = page.match(6, r"^STATION\s+(.*?),", "the station")[1]
    n, peak = page.find(
        r"^PEAK ACCELERATION\s*=\s*(\S+)\s+CMS/SEC/SEC", "the peak acceleration", 1, HEADER
    )
    values = _VALUES.replace("ACC|VEL|DIS", "ACC")
    after, _ = page.find(values, "the number and step of the accelerations", 1, HEADER)
    begin, blocks = after, []
    for kind, unit in BLOCKS:
        head = page.match(after, _VALUES, f"the number and step of {kind}")
        if (head[2], head[4]) != (kind, unit):
            raise page.error(after, f"{head[2]} in {head[4]}, where {kind} in {unit} is expected")
        count = page.whole(after, head[1], "the number of values")
        block, after = page.fixed(after + 1, count, [10] * 8, "value")
        blocks.append(block)
    page.ends(after)
    dt = page.positive(begin, page.match(begin, _VALUES, "")[3], "the step")
    event = f"{page.lines[2][:72]} {page.lines[3][:72]}"
    return [
        Component(
            in_si(blocks[0], "cm/s2", gravity), dt, name, "cm/s2", 1, station=station,
            event=event, peak=Peak(peak[1], "cm/s2", n, 1e-3),
        ).directed()
    ]  # fmt: skip
