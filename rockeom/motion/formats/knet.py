"""NIED, Japan: K-NET (.EW, .NS, .UD) and KiK-net (.EW1, .EW2 ...); counts times a scale in gal.

The mean of the record is removed, as NIED's own peak has it. KiK-net's directions 1 to 3 are those
in the borehole, 4 to 6 those at the surface: two stations.
"""

import re
from collections.abc import Sequence

from rockeom.motion.formats.grammar import Component, Page, Peak, in_si
from rockeom.motion.formats.text import short

LABELS = (
    "Origin Time", "Lat.", "Long.", "Depth. (km)", "Mag.", "Station Code", "Station Lat.",
    "Station Long.", "Station Height(m)", "Record Time", "Sampling Freq(Hz)", "Duration Time(s)",
    "Dir.", "Scale Factor", "Max. Acc. (gal)", "Last Correction", "Memo.",
)  # fmt: skip
COLUMN = 18
"""Where the value of a label begins."""
DIRECTIONS = {
    "N-S": ("N-S", 0.0, ""), "E-W": ("E-W", 90.0, ""), "U-D": ("U-D", None, ""),
    "1": ("N-S", 0.0, " borehole"), "2": ("E-W", 90.0, " borehole"),
    "3": ("U-D", None, " borehole"), "4": ("N-S", 0.0, " surface"),
    "5": ("E-W", 90.0, " surface"), "6": ("U-D", None, " surface"),
}  # fmt: skip
"""Name, azimuth and place of each direction."""


def recognises(head: Sequence[str]) -> bool:
    return head[0].startswith(LABELS[0]) and sum(one[:COLUMN].strip() in LABELS for one in head) > 2


def components(page: Page, gravity: float) -> list[Component]:
    """The one component of a file."""
    value = {}
    for n, label in enumerate(LABELS, 1):
        text = page.line(n, f"{label!r}")
        if text[:COLUMN].rstrip() != label:
            raise page.error(n, f"{label!r} is expected here, and not {short(text)}")
        value[label] = n, text[COLUMN:].strip()
    n, rate = value["Sampling Freq(Hz)"]
    hertz = page.positive(n, rate.removesuffix("Hz"), "the sampling frequency")
    n, duration = value["Duration Time(s)"]
    count = page.count(n, hertz, page.positive(n, duration, "the duration"))
    n, scale = value["Scale Factor"]
    found = re.fullmatch(r"(\S+)\(gal\)/(\S+)", scale)
    if not found:
        raise page.error(
            n, f"the scale is {short(scale)}, not GAL(gal)/COUNTS such as 2000(gal)/8388608"
        )
    gal, counts = (page.positive(n, part, "the scale") for part in found.groups())
    n, where = value["Dir."]
    if where not in DIRECTIONS:
        raise page.error(n, f"the direction is {short(where)}, not one of {', '.join(DIRECTIONS)}")
    name, azimuth, place = DIRECTIONS[where]
    numbers, after = page.fixed(len(LABELS) + 1, count, [9] * 8, "count", blank=1)
    page.ends(after)
    values = gal / counts * (numbers - numbers.mean())
    n, peak = value["Max. Acc. (gal)"]
    return [
        Component(
            in_si(values, "gal", gravity), 1 / hertz, name, "gal", 1, azimuth, azimuth is None,
            value["Station Code"][1] + place, value["Origin Time"][1], Peak(peak, "gal", n),
        )
    ]  # fmt: skip
