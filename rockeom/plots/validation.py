"""Figures of statistical validation: distributions with their bands, reliability diagrams."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.drawing import style
from rockeom.numbers.checks import require

if TYPE_CHECKING:  # which import scipy.stats, and that takes long
    from rockeom.analysis.validation.calibration import Calibration
    from rockeom.analysis.validation.ensembles import Ensemble

_NAMED = len(style.LINES)


@style.styled
def peak_distributions(
    ensembles: Mapping[str, Ensemble],
    *,
    limit: float | None = None,
    level: float = 0.95,
    quantity: str = "largest rotation [rad]",
    ax: Axes | None = None,
) -> Figure:
    """Draw empirical distributions of peaks with their confidence bands, the overturned at the
    right.

    Parameters
    ----------
    ensembles : dict of str to Ensemble
        Ensembles by their names in the legend; six at most.
    limit : float, optional
        Rotation at which the axis ends, in the unit of the peaks; the largest peak if not given.
    level : float, optional
        Level of the bands, see `Ensemble.band`; that of one campaign assumes independent tests.
    quantity : str, optional
        Name of the peaks, with its unit, for the axis.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes. The part that overturned is missing from 1 at the right end.

    Raises
    ------
    ValueError
        For too many or no ensembles, and where no motion has a peak and no limit is given.

    Examples
    --------
    With two ensembles::

        peak_distributions({"measured": measured, "nominal": simulated}, limit=0.24)
    """
    function = "peak_distributions"
    rule = f"give 1 to {_NAMED} of them"
    require(1 <= len(ensembles) <= _NAMED, function, "ensembles", len(ensembles), rule)
    finite = [one.peaks[np.isfinite(one.peaks)] for one in ensembles.values()]
    end = limit if limit is not None else max((p.max() for p in finite if p.size), default=0.0)
    require(end > 0, function, "limit", end, "no motion has a peak above zero: give limit=")
    ax = ax or style.new_figure(5.6, 3.8).add_subplot()
    for (name, one), peaks, colour in zip(ensembles.items(), finite, style.LINES, strict=False):
        x = np.concatenate([[0.0], np.unique(peaks[(peaks > 0) & (peaks < end)]), [end]])
        lower, upper = one.band(x, level)
        ax.fill_between(x, lower, upper, step="post", color=colour, alpha=0.15, lw=0)
        of = f"{one.number:,}, assumed independent"
        if one.campaigns > 1:
            of = f"{one.number // one.campaigns:,} x {one.campaigns:,}"
        label = f"{style.plain(name)} ({of})"
        ax.step(x, one.distribution(x), where="post", color=colour, label=label)
    ax.set(xlim=(0.0, end), ylim=(0.0, 1.0), xlabel=quantity)
    ax.set_ylabel("part of all motions that do not exceed it [-]")
    ax.legend(title=f"tests (x campaigns); bands of {100 * level:g} %", loc="lower right")
    return style.parent_figure(ax)


@style.styled
def reliability_diagram(calibration: Calibration, *, ax: Axes | None = None) -> Figure:
    """Draw observed frequencies of overturning against predicted probabilities.

    Parameters
    ----------
    calibration : Calibration
        Result of `analysis.validation.calibration_of`.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Notes
    -----
    A dot is a bin, with the number of its tests. The grey bar is the range in which it lies, at the
    level of the calibration, if the predictions are right: by the campaigns, or of independent
    tests, for which a dot has the interval of its probability, too.

    Examples
    --------
    With measured outcomes and predicted probabilities::

        reliability_diagram(analysis.validation.calibration_of(overturned, probability))
    """
    c = calibration
    ax = ax or style.new_figure(4.4, 4.6).add_subplot()
    per_cent = f"{100 * c.level:g} %"
    ax.plot([0, 1], [0, 1], color=style.INK, lw=0.8, ls="--")
    ax.vlines(
        c.probability, c.expected_lower, c.expected_upper, color="0.85", lw=9, zorder=2,
        label=f"range if the predictions are right, {per_cent}",
    )  # fmt: skip
    reach = None if c.campaigns else np.abs([c.frequency - c.lower, c.upper - c.frequency])
    interval = "" if c.campaigns else f", with its interval of {per_cent}"
    ax.errorbar(
        c.probability, c.frequency, reach, fmt="o", color=style.LINES[0], ms=4.5, capsize=2.5,
        lw=1.1, zorder=4, label=f"observed{interval}",
    )  # fmt: skip
    for x, y, n in zip(c.probability, c.frequency, c.number, strict=True):
        ax.annotate(f"{n}", (x, y), xytext=(6, 3), textcoords="offset points", fontsize=7.5)
    ax.set(xlim=(-0.04, 1.04), ylim=(-0.04, 1.04))
    ax.set(xlabel="predicted probability of overturning [-]", ylabel="observed frequency [-]")
    ax.set_title(f"{c.number.sum()} tests, p = {c.p_value:.2g}\n{c.basis}", fontsize=9)
    ax.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), borderaxespad=0.0)
    return style.parent_figure(ax)
