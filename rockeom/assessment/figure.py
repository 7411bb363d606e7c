"""The figure of an assessment: probability against intensity, and rotations as recorded."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.analysis.sweeps import FALLS
from rockeom.assessment.remedies import Remedy
from rockeom.assessment.trials import Trials, UnderRecord
from rockeom.drawing import style
from rockeom.motion.units import STANDARD_GRAVITY

_DASHES = ("--", "-.", ":")


@style.styled
def draw(
    trials: Trials,
    remedies: Sequence[Remedy],
    records: Sequence[UnderRecord],
    threshold: float,
    level: float,
) -> Figure:
    """Probability of overturning against PGA, and the largest rotation under each record.

    threshold : acceleration that lifts a foot [m/s2]. level : of the intervals.
    """
    figure = style.new_figure(8.2, 3.5)
    left, right = figure.subplots(1, 2, width_ratios=(1.25, 1.0))
    _draw_probability(left, trials, remedies, threshold, level)
    _draw_rotations(right, records)
    for ax in (left, right):
        ax.axvline(threshold / STANDARD_GRAVITY, color=style.INK, ls=":", lw=0.9)
        ax.set_xlim(0.0, None)
        ax.set_xlabel("peak ground acceleration [g]")
    left.annotate(
        "a foot lifts", (threshold / STANDARD_GRAVITY, 1.0), (0, 3), fontsize=7.5, ha="center",
        xycoords=("data", "axes fraction"), textcoords="offset points", color=style.INK,
    )  # fmt: skip
    return figure


def _draw_probability(
    ax: Axes, trials: Trials, remedies: Sequence[Remedy], threshold: float, level: float
) -> None:
    rows = [row for row in trials.intensities if row.number]
    pga = np.array([row.pga for row in rows]) / STANDARD_GRAVITY
    fractions = np.array([row.overturned / row.number for row in rows])
    bounds = np.array([(row.lower, row.upper) for row in rows]).reshape(-1, 2)
    end = 1.05 * max([*pga, threshold / STANDARD_GRAVITY])
    im = np.linspace(1e-3 * end, end, 300)
    curve = trials.fragility
    if curve is not None:
        low, high = curve.bounds(im * STANDARD_GRAVITY, level)
        ax.fill_between(im, low, high, color="#cfe0ee", lw=0)
        ax.plot(
            im, curve.probability(im * STANDARD_GRAVITY), color=style.LINES[0], label="as it is"
        )
    for one, dashes, color in zip(remedies, _DASHES, style.LINES[1:], strict=False):
        if one.trials.fragility is not None:
            changed = one.trials.fragility.probability(im * STANDARD_GRAVITY)
            ax.plot(im, changed, ls=dashes, color=color, label=one.change.partition(",")[0])
    ax.errorbar(
        pga, fractions, np.abs(bounds.T - fractions), fmt="o", ms=4, mfc="white", color=style.INK,
        lw=0.8, capsize=2, clip_on=False, zorder=4, label=f"records, {100 * level:g} %",
    )  # fmt: skip
    ax.set(ylabel="probability of overturning [-]", ylim=(0.0, 1.0), xlim=(0.0, end))
    ax.legend(loc="upper left", fontsize=7.5, frameon=True, edgecolor="none", borderpad=0.2)


def _draw_rotations(ax: Axes, records: Sequence[UnderRecord]) -> None:
    """Dots at the part of the overturning angle, triangles in a band above where it overturned."""
    known = any(np.isfinite(one.part) for one in records)
    sizes = [one.part if known else one.rotation for one in records if one.outcome != FALLS]
    top = 1.05 * max([1.0 if known else 0.0, *sizes]) or 1.0
    fell = np.array([one.outcome == FALLS for one in records])
    peaks = np.array([one.peak / STANDARD_GRAVITY for one in records])
    for which, heights, marker, color, inside in (
        (~fell, np.array(sizes), "o", style.LINES[0], "white"),
        (fell, np.full(fell.sum(), 1.06 * top), "^", style.LINES[1], style.LINES[1]),
    ):
        if which.any():  # an empty line that is not clipped breaks the layout
            ax.plot(peaks[which], heights, marker, color=color, mfc=inside, ms=4, clip_on=False)
    ax.axhspan(top, 1.12 * top, facecolor="0.95", lw=0, zorder=0)
    ax.text(
        0.01, 1.06 * top, "overturned", fontsize=7.5, va="center", color=style.INK,
        transform=ax.get_yaxis_transform(),
    )  # fmt: skip
    ax.set_ylabel(r"largest $|\theta|/\alpha$ [-]" if known else r"largest $|\theta|$ [rad]")
    ax.set_ylim(0.0, 1.12 * top)
    ax.set_yticks([tick for tick in ax.get_yticks() if tick <= top])
    n = int(fell.sum())
    said = f"as recorded: {len(sizes)} stand, {n or 'none'} overturn{'s' * (n <= 1)}"
    ax.set_title(said, fontsize=8, loc="right")
