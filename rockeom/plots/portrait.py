"""The response in the plane of rotation and rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.contract import IMPACT, LANDING
from rockeom.plots import style

if TYPE_CHECKING:
    from rockeom.numeric.response import Response


@style.styled
def plot_phase_portrait(run: Response, *, ax: Axes | None = None) -> Figure:
    """Rate of rotation against rotation; impacts are the dotted jumps.

    ax : axes to draw in; those of a new figure if not given. Returns their figure.
    """
    if ax is None:
        ax = style.new_figure(4.6, 3.8).add_subplot()
        ax.set_title(style.wrapped(style.plain(style.title_of(run)), 70), fontsize=9)
    p = run.program
    y, dy = run.y[:, p.ROTATION], run.y[:, p.ROTATION_RATE]
    jumps = np.flatnonzero(np.diff(run.t) == 0) + 1
    for piece in np.split(np.column_stack([y, dy]), jumps):
        ax.plot(*piece.T, color=style.OTHERS[0])
    _, kinds, states = run.passages
    for before, after in states[np.isin(kinds[:, 0], (IMPACT, LANDING))]:
        ends = np.array([before, after])
        ax.plot(ends[:, p.ROTATION], ends[:, p.ROTATION_RATE], ":", color=style.OTHERS[1], lw=0.9)
    ax.plot(y[0], dy[0], "o", color=style.OTHERS[0], ms=4)
    ax.annotate("start", (y[0], dy[0]), xytext=(4, 4), textcoords="offset points", fontsize=8)
    name = run.states[p.ROTATION]
    ax.set_xlabel(f"{style.symbol(name)} [{p.STATE_UNITS[p.ROTATION]}]")
    rate, unit = style.rate_of(run)
    ax.set_ylabel(f"${rate}$ [{unit}]")
    return style.parent_figure(ax)
