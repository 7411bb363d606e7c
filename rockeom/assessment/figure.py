"""The figure of an assessment: probability of overturning against intensity."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from rockeom.assessment.remedies import Remedy
from rockeom.assessment.trials import Trials
from rockeom.drawing import style
from rockeom.motion.units import STANDARD_GRAVITY

_DASHES = ("--", "-.", ":")


@style.styled
def draw(trials: Trials, remedies: Sequence[Remedy], threshold: float, level: float) -> Figure:
    """Probability of overturning against PGA, with what was counted.

    threshold : acceleration that lifts a foot [m/s2]. level : of the intervals. The band ends at
    the intensities that were tried. One axes, for a telephone to show.
    """
    figure, ax = style.new_axes(5.6, 3.5)
    rows = [row for row in trials.intensities if row.number]
    pga = np.array([row.pga for row in rows]) / STANDARD_GRAVITY
    fractions = np.array([row.overturned / row.number for row in rows])
    lower, upper = np.array([(row.lower, row.upper) for row in rows]).reshape(-1, 2).T
    reach = np.maximum([fractions - lower, upper - fractions], 0.0)
    end = 1.05 * max([*pga, threshold / STANDARD_GRAVITY])
    im = np.linspace(1e-3 * end, end, 300)
    curve = trials.fragility
    if curve is not None:
        tried = np.linspace(pga[0], pga[-1], 200)
        low, high = curve.bounds(tried * STANDARD_GRAVITY, level)
        ax.fill_between(tried, low, high, color="#cfe0ee", lw=0)
        ax.plot(
            im, curve.probability(im * STANDARD_GRAVITY), color=style.LINES[0], label="As it is"
        )
    for one, dashes, color in zip(remedies, _DASHES, style.LINES[1:], strict=False):
        if one.trials.fragility is not None:
            changed = one.trials.fragility.probability(im * STANDARD_GRAVITY)
            ax.plot(im, changed, ls=dashes, color=color, label=one.change.partition(",")[0])
    ax.errorbar(
        pga, fractions, reach, fmt="o", ms=4, mfc="white", color=style.INK,
        lw=0.8, capsize=2, clip_on=False, zorder=4, label=f"Records, {100 * level:g} %",
    )  # fmt: skip
    ax.axvline(threshold / STANDARD_GRAVITY, color=style.INK, ls=":", lw=0.9)
    ax.annotate(
        "a foot lifts", (threshold / STANDARD_GRAVITY, 1.0), (0, 3), fontsize=7.5, ha="center",
        xycoords=("data", "axes fraction"), textcoords="offset points", color=style.INK,
    )  # fmt: skip
    ax.set(xlabel="peak ground acceleration [g]", xlim=(0.0, end))
    ax.set(ylabel="probability of overturning", ylim=(0.0, 1.0))
    ax.legend(loc="upper left", fontsize=7.5, frameon=True, edgecolor="none", borderpad=0.2)
    return figure
