"""GeoNet, New Zealand (.V1A, .V2A): components one after the other, ten columns of 8 characters."""

from collections.abc import Sequence

from rockeom.motion.formats.grammar import Component, Page, Peak, each_until, in_si

TEXT, NUMBERS = 16, 10
"""Lines of text and of numbers at the head of each component."""
WIDTHS = [8] * 10
BLOCKS = {"V1A": 1, "V2A": 3}
"""Blocks of values: acceleration, and in a corrected file velocity and displacement."""
_BEGINS = r"^(?:un)?corrected accelerogram \S+ GNS Science"


def recognises(head: Sequence[str]) -> bool:
    return head[0].rstrip().endswith("GNS Science") and "accelerogram" in head[0]


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    return each_until(page, lambda first: _component(page, first, gravity))


def _component(page: Page, first: int, gravity: float) -> tuple[Component, int]:
    """The component that begins at a line, and the line after its end."""
    page.match(first, _BEGINS, "the first line of a component")
    is_raw = page.lines[first - 1].lower().startswith("un")
    points = page.match(first + 9, r"^Number of points\s+(\d+)\s+Duration", "the number of points")
    count = page.whole(first + 9, points[1], "the number of points")
    steps = (
        r"^Raw readings in units of\s+(\S+)\s+mm/s/s\s+at intervals of\s+(\S+)\s+s\b"
        if is_raw
        else r"^Instrument corrected data at()\s+(\S+)\s+sec intervals"
    )
    scale, dt = page.match(first + 10, steps, "the time step").groups()
    name = page.match(first + 12, r"^Component\s+(\S+)", "the component")[1]
    peak = page.match(
        first + 13, r"^Acceleration:\s+peak\s+(\S+)\s+mm/s/s", "the peak acceleration"
    )[1]
    numbers, _ = page.fixed(first + TEXT, 10 * NUMBERS, WIDTHS, "number of the header")
    if round(numbers[33]) != count:
        raise page.error(first + 19, f"{numbers[33]:g} points, where line {first + 9} has {count}")
    after = first + TEXT + NUMBERS
    blocks = []
    for _ in range(BLOCKS["V1A" if is_raw else "V2A"]):
        block, after = page.fixed(after, count, WIDTHS, "value")
        blocks.append(block)
    factor = page.positive(first + 10, scale, "the unit of the readings") if scale else 1.0
    station = page.match(first + 1, r"^Site\s+(\S+)", "the site")[1]
    component = Component(
        in_si(factor * blocks[0], "mm/s2", gravity),
        page.positive(first + 10, dt, "the time step"),
        name, "mm/s2", first, station=station, event=page.lines[first + 6].strip(),
        peak=Peak(peak, "mm/s2", first + 13), stage="raw" if is_raw else "corrected",
    )  # fmt: skip
    return component.directed(), after
