"""BHRC, Iran (.V1): components one after the other, values in g/10 of thirteen columns."""

from collections.abc import Sequence

from rockeom.motion.formats.grammar import Component, Page, each_until, in_si
from rockeom.motion.formats.text import number_of

_BEGINS = r"^\* VOL1DS FILE:"
TEXT, NUMBERS = 13, 14
"""Lines of text and of numbers at the head of each component; the latter are cut at 70 columns."""
RATE = TEXT + 8
"""Line of the real that states the samples a second, from the first line of a component on."""


def recognises(head: Sequence[str]) -> bool:
    return head[0].startswith("* VOL1DS FILE:")


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    return each_until(page, lambda first: _component(page, first, gravity))


def _component(page: Page, first: int, gravity: float) -> tuple[Component, int]:
    """The component that begins at a line, and the line after its end."""
    page.match(first, _BEGINS, "the first line of a component")
    name = page.match(first + 6, r"^COMP\s+([LVT])\d*", "the component, COMP L1")[1]
    station = page.match(
        first + 7, r"^(.*?)\s+Station\b.*\bAzimuth\s+L\s*(\d*)\s+T\s*(\d*)", "station and azimuths"
    )
    points = page.match(
        first + 10, r"^NO\. OF POINTS\s*=\s*(\d+)\s+DURATION\s*=\s*(\S+)\s*$", "points and duration"
    )
    page.match(first + 11, r"^UNITS ARE SECONDS AND G/10\s*$", "the unit, g/10")
    count = page.whole(first + 10, points[1], "the number of points")
    for n in range(first + TEXT, first + TEXT + NUMBERS):
        page.match(n, r"^[\s\d.E+-]+$", "numbers of the header")
    values, after = page.fixed(first + TEXT + NUMBERS, count, [13] * 10, "value")
    page.match(after, r"^/&", "the end of the component")
    azimuth = {"L": station[2], "T": station[3]}.get(name)
    component = Component(
        in_si(values, "g/10", gravity), _step(page, first, count, points[2]), name, "g/10", first,
        float(azimuth) if azimuth else None, name == "V",
        station[1], page.lines[first + 1].strip(),
    )  # fmt: skip
    return component, after + 1


def _step(page: Page, first: int, count: int, duration: str) -> float:
    """The step [s], by the samples a second of the header, by its duration where they are zero."""
    length = page.positive(first + 10, duration, "the duration")
    line = first + RATE
    text = page.line(line, "the samples a second")[:13]
    rate = number_of(text.strip(), page.path, line, "the samples a second")
    if not rate:
        return length / count
    steps = length * rate
    if not count - 1.5 <= steps <= count + 0.5:
        raise page.error(
            line, f"{rate:g} samples a second, where line {first + 10} has {count} in {length:g} s"
        )
    return 1 / rate
