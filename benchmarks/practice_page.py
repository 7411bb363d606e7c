"""Table, sentences and figure of `benchmarks.plane_or_space`, for the guide."""

import textwrap
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.special import stdtrit

from benchmarks import report
from benchmarks.practice_objects import OBJECTS
from rockeom.drawing import style

LEVEL = 0.95
_WORDS = "safe", "not safe", "not known"
_LABELS = {
    "safe": "the plane is safe",
    "not safe": "the plane is not safe",
    "not known": "the plane may be safe or not",
}
_HEAD = (
    "object", "PGA [g]", "plane [%]", "space [%]", "space less plane [%]", "plane, turned [%]",
    "falls most", "plane is",
)  # fmt: skip


def whole(found: Mapping[str, Any]) -> str:
    """The text between the marks of the page."""
    rows = found["objects"]
    unsafe = sorted((row for row in rows if row["more"][1] > 0.0), key=lambda row: -row["more"][0])
    return "\n\n".join(
        [
            _filled(_introduction(found)),
            "![Probability of overturning, plane and space](../images/plane_or_space.png)",
            report.table(_HEAD, [cells(row) for row in rows]),
            _filled(_again_in_words(found["again"])),
            "## Where the plane is not safe",
            _filled(_summary(rows)),
            "\n".join(map(_named, unsafe)),
            "## The objects",
            report.table(("object", "size", "why"), [(o.name, o.size, o.reason) for o in OBJECTS]),
        ]
    )


def cells(row: Mapping[str, Any]) -> tuple[str, ...]:
    """A row of the table."""
    low, high = row["interval"]
    more, least, most = row["more"]
    worst = int(np.argmax(row["by azimuth"]))
    where = f"{row['by azimuth'][worst]} at {row['azimuths'][worst]:.3g}°"
    return (
        row["name"],
        f"{row['pga']:.2g}",
        _percent(row["plane"]),
        f"{_percent(row['space'])} ({_percent(low)} to {_percent(high)})",
        f"{_percent(more, '+')} ({_percent(least, '+')} to {_percent(most, '+')})",
        _percent(row["turned"]),
        where if row["turns"] > 1 else f"{row['by azimuth'][0]} at any",
        verdict(row),
    )


def _percent(part: float, sign: str = "") -> str:
    value = round(100.0 * part)
    return f"{value:{sign if value else ''}d}".replace("-", "−")


def verdict(row: Mapping[str, Any]) -> str:
    """Whether the plane is safe, by the interval of the difference."""
    _, low, high = row["more"]
    return "not safe" if low > 0.0 else "safe" if high < 0.0 else "not known"


def _named(row: Mapping[str, Any]) -> str:
    more, low, high = map(_percent, row["more"])
    said = f"- **{row['name']}**: {_percent(row['plane'])} % in the plane"
    if row["plane without loss"] is not None:
        said += f" ({_percent(row['plane without loss'])} % without loss at impacts)"
    return f"{said}, {_percent(row['space'])} % in space, {more} % more ({low} to {high})"


def _introduction(found: Mapping[str, Any]) -> str:
    rows = found["objects"]
    space, flat = (np.mean([row[key] for row in rows]) for key in ("space", "plane"))
    motions = sum(row["turns"] for row in rows) * found["recordings"]
    unanswered = motions - sum(row["answered"] for row in rows)
    return (
        f"Written by `python -m benchmarks.plane_or_space` on {found['date']}, from {motions:,} "
        f"motions in space, {unanswered} of them without an answer. Averaged over objects, "
        f"{_percent(flat)} % overturn in the plane and {_percent(space)} % in space. The intervals "
        f"are at {_percent(LEVEL)} %; their unit is a recording."
    )


def _again_in_words(found: Mapping[str, Any]) -> str:
    motions, differ, near, asked, of_asked = (
        sum(found[key]) for key in ("motions", "differ", "near", "asked", "near of asked")
    )
    within = "all" if differ == near else str(near)
    return (
        f"Ten objects were simulated once more, motion by motion, by another method at a tighter "
        f"tolerance (DOP853, rtol 1e-11), in the plane, too: {', '.join(found['name'])}. "
        f"{differ} of {motions:,} outcomes differ, and {within} of these are within 1 % of their "
        "boundary: the motion times one of 21 factors from 0.99 to 1.01 has the other outcome. So "
        f"are {of_asked} of {asked} others that were asked, which is every eighteenth: a single "
        "outcome says little."
    )


def _summary(rows: Sequence[Mapping[str, Any]]) -> str:
    count = {word: sum(verdict(row) == word for row in rows) for word in _WORDS}
    strict = 1.0 - (1.0 - LEVEL) / len(rows)
    edges = [row for row in rows if row["turns"] > 1]
    more = [row["more"][0] for row in edges]
    beyond = sum(row["more than turned"][1] > 0.0 for row in edges)
    turned = np.mean([row["more than turned"][0] for row in edges])
    return (
        f"The plane is safe for {count['safe']} of {len(rows)} objects, and not safe for "
        f"{count['not safe']}; for {count['not known']} it is not known, since the interval holds "
        f"zero. Were plane and space alike for all, about one would be named all the same: "
        f"{_left(rows, strict)} of those named are left where all {len(rows)} intervals hold at "
        f"once. For the {len(edges)} objects that are not round, space less plane is "
        f"{_percent(np.mean(more), '+')} % on average, from {_percent(min(more), '+')} % to "
        f"{_percent(max(more), '+')} %. Compared with the block that is turned along, which is not "
        f"always under the stronger component, it is {_percent(turned, '+')} % on average, and "
        f"measurably more for {beyond} of them."
    )


def _left(rows: Sequence[Mapping[str, Any]], level: float) -> int:
    """Objects not safe at a stricter level: Student's intervals are as long as their quantiles."""
    freedom = 29
    wider = stdtrit(freedom, 0.5 + 0.5 * level) / stdtrit(freedom, 0.5 + 0.5 * LEVEL)
    return sum(row["more"][0] > wider * (row["more"][0] - row["more"][1]) for row in rows)


_filled = partial(textwrap.fill, width=100, break_long_words=False, break_on_hyphens=False)


def draw(rows: Sequence[Mapping[str, Any]], path: Path) -> None:
    """Probabilities of each object in the plane and in space."""
    figure = style.new_figure(7.2, 8.8)
    ax: Axes = figure.subplots()
    colors = dict(zip(_WORDS, (style.LINES[0], style.LINES[1], "0.45"), strict=True))
    for y, row in enumerate(rows):
        color = colors[verdict(row)]
        ax.plot(row["interval"], (y, y), color=color, lw=4.0, alpha=0.3, solid_capstyle="butt")
        ax.plot((row["plane"], row["space"]), (y, y), color=color, lw=1.0)
        ax.plot(row["plane"], y, "s", mfc="white", mec=style.INK, ms=5)
        ax.plot(row["space"], y, "o", color=color, ms=5)
    signs = [Line2D([], [], ls="", marker="s", mfc="white", mec=style.INK, label="in the plane")]
    signs += [
        Line2D([], [], marker="o", color=color, label=f"in space; {_LABELS[word]}")
        for word, color in colors.items()
    ]
    figure.legend(handles=signs, loc="outside upper center", ncols=2, fontsize=8)
    ax.set_yticks(range(len(rows)), [row["name"] for row in rows], fontsize=8)
    ax.set(xlim=(0.0, 1.0), ylim=(len(rows) - 0.4, -0.6), xlabel="probability of overturning")
    ax.grid(axis="x", color="0.9")
    ax.set_axisbelow(True)
    figure.savefig(path, dpi=110)
