"""RENADIC, Chile (.v1), and CDMG's old raw files: components of pairs of time and value in g/10."""

from collections.abc import Sequence

import numpy as np

from rockeom.motion.formats.grammar import Component, Page, Peak, each_until, in_si

TEXT = 13
"""Lines of text of each component; a hundred whole numbers and 58 reals follow."""


EVEN = 1.01e-3
"""Times [s] by which those of a file may be off an even step: a unit of their last digit."""


def recognises(head: Sequence[str]) -> bool:
    return head[0].startswith("UNCORRECTED ACCELEROGRAM DATA") and any(
        line.startswith("UNITS OF UNCOR ACCEL ARE SEC AND G/10") for line in head[:TEXT]
    )


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    return each_until(page, lambda first: _component(page, first, gravity))


def _component(page: Page, first: int, gravity: float) -> tuple[Component, int]:
    """The component that begins at a line, and the line after its end."""
    page.match(first, r"^UNCORRECTED ACCELEROGRAM DATA", "the first line of a component")
    name = page.match(first + 6, r"^CHAN\s+\d+:\s*(.*?)\s*(?:\(|$)", "the channel")[1]
    count = page.whole(
        first + 10,
        page.match(first + 10, r"^NO\. OF POINTS\s*=\s*(\d+)\s", "the number of points")[1],
        "the number of points",
    )
    peak = page.match(
        first + 11,
        r"^UNITS OF UNCOR ACCEL ARE SEC AND G/10\.\s+MAX\s*=\s*(\S+)\s+G",
        "the unit and the peak",
    )[1]
    _, after = page.fixed(first + TEXT, 100, [5] * 16, "whole number of the header")
    _, after = page.fixed(after, 50, [10] * 8, "real of the header")
    begin = after
    pairs, after = page.fixed(begin, 2 * count, [7] * 10, "time or value")
    time, values = pairs[::2], pairs[1::2]
    page.match(after, r"^/&", "the end of the component")
    dt = round(float(time[-1] - time[0]) / (count - 1), 6) if count > 1 else 0.0
    off = np.abs(time - time[0] - dt * np.arange(count))
    if not dt > 0 or off.max() > EVEN:
        worst = int(off.argmax())
        raise page.error(
            begin + (2 * worst) // 10,
            f"the times are not even: {time[worst]:g} s is {off[worst]:.3g} s off a step of {dt:g}",
            "resample to an even step, as numpy.interp does, for GroundMotion.from_array",
        )
    return (
        Component(
            in_si(values, "g/10", gravity), dt, name, "g/10", first,
            station=page.lines[first + 4].strip(), event=page.lines[first].strip(),
            peak=Peak(peak, "g", first + 11), stage="uncorrected",
        ).directed(),
        after + 1,
    )  # fmt: skip
