"""USGS, SMC (.smc): 11 lines of text, 48 whole numbers, 50 reals, comments and values."""

from collections.abc import Sequence
from dataclasses import replace

from rockeom.motion.formats.grammar import Component, Page, Peak, in_si
from rockeom.motion.formats.text import other_quantity, short

KINDS = {
    "1": "uncorrected",
    "2": "corrected acceleration",
    "3": "velocity",
    "4": "displacement",
    "5": "response spectra",
}
TEXT, WHOLE, REALS = 11, 6, 10
"""Lines of each part of the header."""
NONE = 1.0e38
"""From here on a real of the header says that there is none."""


def recognises(head: Sequence[str]) -> bool:
    return head[0][:2].strip() in KINDS and any(
        line.strip() == "*" or line.startswith("station =") for line in head[1:6]
    )


def components(page: Page, gravity: float) -> list[Component]:
    """The one component of a file."""
    number = page.match(1, r"^\s?([1-5])", "the kind of the record, 1 to 5")[1]
    kind = KINDS[number]
    if number > "2" or "acceler" not in page.lines[0].lower():
        raise other_quantity(page.path, 1, kind, f"the line says {short(page.lines[0])}")
    whole, after = page.fixed(TEXT + 1, 8 * WHOLE, [10] * 8, "whole number of the header")
    reals, after = page.fixed(after, 5 * REALS, [15] * 5, "real of the header")
    comments, count = round(whole[15]), round(whole[16])
    if comments < 0 or count < 1:
        raise page.error(TEXT + 3, f"{comments} comments and {count} values are stated")
    for n in range(after, after + comments):
        page.match(n, r"^\|", "a comment, |")
    values, after = page.fixed(after + comments, count, [10] * 8, "value")
    page.ends(after)
    station, name = page.match(
        6, r"^station\s*=\s*(.*?)\s*component\s*=\s*(.*?)\s*$", "station and component"
    ).groups()
    peak = page.match(7, r"\bpk(?:\s+acc)?\s*=\s*(\S*)", "the peak")[1]
    rate = reals[1]
    if rate >= NONE:
        raise other_quantity(page.path, TEXT + WHOLE + 1, "uneven samples", "it states no rate")
    if rate <= 0:
        raise page.error(TEXT + WHOLE + 1, f"{rate:g} samples a second")
    none, tilt, azimuth = round(whole[0]), round(whole[12]), round(whole[13])
    component = Component(
        in_si(values, "cm/s2", gravity), 1 / float(rate), name, "cm/s2", 1, station=station,
        event=page.lines[3].strip(), stage=kind, peak=Peak(peak, "cm/s2", 7) if peak else None,
    )  # fmt: skip
    if none in (tilt, azimuth):
        return [component.directed()]
    is_vertical = tilt in (0, 180)
    north_is_360 = None if is_vertical else azimuth % 360 or 360
    component = component.along(page, TEXT + 2, north_is_360, is_vertical)
    return [replace(component, is_down=tilt == 180)]
