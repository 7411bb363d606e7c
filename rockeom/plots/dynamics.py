"""Figures of motions under shaking that repeats itself: sections, bifurcations, basins."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from rockeom.analysis.arguments import dims_of_starts
from rockeom.analysis.dynamics.sections import FALLEN, NOT_PERIODIC, UNKNOWN
from rockeom.analysis.sweeps import check_finished, coordinate
from rockeom.drawing import style
from rockeom.numbers.checks import InputError, require_word
from rockeom.plots import coordinates

if TYPE_CHECKING:
    from rockeom.analysis.dynamics.branches import Bifurcation, OrbitBranch
    from rockeom.analysis.dynamics.orbits import PeriodicOrbit

_MOMENTS = ("period", "before", "after")
"""When a motion is looked at: at the starts of cycles, and on both sides of impacts."""

_NAMED = len(style.LINES)
"""Number of starts that have a colour each, at most."""

# --- sections and what they settle on


@style.styled
def poincare_section(
    sections: xr.Dataset, *, x: str, y: str, at: str = "period", ax: Axes | None = None
) -> Figure:
    """Draw the points in which motions pass a section of their states, a dot for each look.

    Parameters
    ----------
    sections : xarray.Dataset
        Dataset of `analysis.dynamics.poincare_sections`, of one value of each parameter.
    x : str
        State on the horizontal axis; at impacts also "impact_time", since the start of the cycle.
    y : str
        State on the vertical axis; at impacts also "impact_time".
    at : str, optional
        "period", the starts of the cycles; or "before" or "after" the impacts.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes. Up to six starts have a colour each.

    Raises
    ------
    ValueError
        For names that the sections do not have, and where they vary parameters, too.

    Examples
    --------
    With sections `looks`::

        poincare_section(looks, x="theta", y="theta_dot")
        poincare_section(looks, x="impact_time", y="theta_dot", at="after")
    """
    across, up = (_looks("poincare_section", sections, name, at) for name in (x, y))
    ax = ax or style.new_figure(5.2, 4.2).add_subplot()
    for i, look in enumerate(_looks_of_starts(sections, len(up))):
        ax.plot(across[i].ravel(), up[i].ravel(), ".", mew=0, **look)
    _name_axes(ax, sections, x, y, at)
    return style.parent_figure(ax)


@style.styled
def bifurcation_diagram(
    sections: xr.Dataset,
    *,
    x: str,
    y: str,
    at: str = "period",
    branches: Iterable[OrbitBranch] = (),
    ax: Axes | None = None,
) -> Figure:
    """Draw motions after settling, against a parameter, with the branches of orbits over the dots.

    Parameters
    ----------
    sections : xarray.Dataset
        Dataset of `analysis.dynamics.poincare_sections` over the parameter x alone, from one start
        or more: orbits that coexist show if there are starts of each.
    x : str
        Name of the parameter.
    y : str
        State on the vertical axis.
    at : str, optional
        "period", the starts of the cycles; or "before" or "after" the impacts.
    branches : iterable of OrbitBranch, optional
        Branches of `analysis.dynamics.orbit_branch`, stable motions solid, unstable ones dashed,
        with marks where they bifurcate. Drawn are looks at them or the states before their impacts,
        as `at` says.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes. Up to six starts have a colour each.

    Raises
    ------
    ValueError
        For names that the sections do not have, where they vary other parameters, and for branches
        that cannot be drawn so.

    Examples
    --------
    With sections `looks` and branches `symmetric` and `broken`::

        bifurcation_diagram(looks, x="beta", y="x_dot", at="before", branches=[symmetric, broken])
    """
    function = "bifurcation_diagram"
    coordinate(function, sections, x)
    values = _looks(function, sections, y, at, x)
    ax = ax or style.new_figure(6.6, 4.0).add_subplot()
    for i, look in enumerate(_looks_of_starts(sections, len(values))):
        places = np.repeat(sections[x].values, values.shape[2])
        ax.plot(places, values[i].ravel(), ".", mew=0, **look)
    marked: set[str] = set()
    for branch in branches:
        _draw_branch(ax, branch, y, at)
        for one in branch.bifurcations:
            _mark(ax, one, y, at, marked)
    ax.set_xlim(float(sections[x].min()), float(sections[x].max()))
    _name_axes(ax, sections, x, y, at)
    return style.parent_figure(ax)


def _looks(function: str, sections: xr.Dataset, name: str, at: str, *names: str) -> np.ndarray:
    """(starts, ..., looks) values at all looks of a kind, over the names in between."""
    require_word("at", at, _MOMENTS, function)
    if at != "period" and "impact_state" not in sections:
        raise InputError("at", of=function).says(
            "the sections have no impacts: give analysis.dynamics.poincare_sections impacts=, the "
            "most in a cycle"
        )
    check_finished(function, sections)
    states = sections["state"].values.tolist()
    if at != "period" and name == "impact_time":
        values = sections[name]
    elif name not in states:
        raise InputError("state", name, function).choose(states)
    elif at == "period":
        values = sections["strobe"].sel(state=name)
    else:
        values = sections["impact_state"].sel(state=name, side=at)
    starts = dims_of_starts(function, sections, *names)
    sizes = [sections.sizes[one] for one in names]
    number = math.prod(sections.sizes[one] for one in starts)
    return values.transpose(*starts, *names, ...).values.reshape(number, *sizes, -1)


def _looks_of_starts(sections: xr.Dataset, number: int) -> Iterator[dict[str, Any]]:
    """How the dots of each start are drawn: few by name, many alike."""
    if not 1 < number <= _NAMED:
        yield from [{"color": style.INK, "ms": 1.6}] * number
        return
    names = [name for name in sections["state"].values if name in sections.coords]
    starts = list(dict.fromkeys(dim for name in names for dim in sections[name].dims))
    each = sections[names].reset_coords().stack(motion=starts, create_index=False)
    for i, colour in zip(range(number), style.LINES, strict=False):
        words = [f"{style.symbol(name)} = {each[name].values[i]:g}" for name in names]
        yield {"color": colour, "ms": 2.2, "label": f"from {', '.join(words)}"}


def _name_axes(ax: Axes, sections: xr.Dataset, x: str, y: str, at: str) -> None:
    ax.set(xlabel=_label_of(sections, x, at), ylabel=_label_of(sections, y, at))
    if ax.get_legend_handles_labels()[0]:
        legend = ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
        for line in legend.get_lines():
            line.set_markersize(5)


def _label_of(sections: xr.Dataset, name: str, at: str) -> str:
    """Label of a state, the time of impacts or a parameter."""
    if name == "impact_time":
        unit = coordinates.unit(sections[name].attrs["units"])
        return f"time of the impact in its cycle [{unit}]"
    if name not in sections["state"].values:
        return coordinates.label(sections, name)
    unit = coordinates.unit(sections["state_unit"].sel(state=name).item())
    moment = "" if at == "period" else f" {at} an impact"
    return f"{style.symbol(name)}{moment} [{unit}]"


# --- branches of orbits over the dots

_BRANCH = "k"
_MARKS = {
    "fold": "<",
    "branch point": "s",
    "symmetry breaking": "D",
    "period doubling": "o",
    "torus": "P",
    "grazing": "X",
}


def _draw_branch(ax: Axes, branch: OrbitBranch, y: str, at: str) -> None:
    """Solid where it lasts, dashed where not; its values in order, for impacts change theirs."""
    rows = [_of_orbit(orbit, y, at) for orbit in branch.orbits]
    table = np.full((len(rows), max(map(len, rows))), np.nan)
    for row, values in zip(table, rows, strict=True):
        row[: len(values)] = np.sort(values)
    unstable = ~branch.stable
    dashed = unstable.copy()
    dashed[1:] |= unstable[:-1]  # no gap where it changes
    dashed[:-1] |= unstable[1:]
    for there, dashes in ((branch.stable, "-"), (dashed, "--")):
        ax.plot(branch.values, np.where(there[:, None], table, np.nan), ls=dashes, color=_BRANCH,
                lw=0.8)  # fmt: skip


def _of_orbit(orbit: PeriodicOrbit, y: str, at: str) -> np.ndarray:
    """The ordinate of an orbit; raises ValueError where it is not known."""
    if at == "before":
        return orbit.at_impacts(y)
    if at == "after" or orbit.mirror is not None:
        raise InputError("branches", of="bifurcation_diagram").wrong(
            "are drawn before their impacts, and those of maps that are not mirrored at the "
            "period, too: choose at='before'"
        )
    return orbit.looks[:, orbit.states.index(y)]


def _mark(ax: Axes, point: Bifurcation, y: str, at: str, marked: set[str]) -> None:
    values = _of_orbit(point.orbit, y, at)
    label = None if point.kind in marked else point.kind
    marked.add(point.kind)
    ax.plot(np.full(len(values), point.value), values, _MARKS[point.kind], color=_BRANCH, mfc="w",
            ms=4, mew=0.9, zorder=5, label=label)  # fmt: skip


# --- basins

_FATES = {UNKNOWN: "#9a9a9a", FALLEN: "#4d4d4d", NOT_PERIODIC: "#ffffff"}
_ORBITS = ("#9ecae1", "#fdae6b", "#a1d99b", "#dba9c8", "#f7f0a8", "#c7b8e2")
"""Light shades, on which the orbits are marked."""


@style.styled
def basins_of_attraction(basins: xr.Dataset, *, x: str, y: str, ax: Axes | None = None) -> Figure:
    """Draw the ends of motions over the states from which they start, and the orbits themselves.

    Parameters
    ----------
    basins : xarray.Dataset
        Dataset of `analysis.dynamics.basins`, over a grid of two states or a table of starts, which
        is drawn as dots.
    x : str
        State on the horizontal axis.
    y : str
        State on the vertical axis.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    ValueError
        For states that the starts do not vary, and where they vary others as well.

    Notes
    -----
    Each orbit has a shade, which repeats itself after six, and its looks at the starts of cycles a
    mark each. The legend has its cycles and the part of the starts that ends on it.

    Examples
    --------
    With sections `looks` of `analysis.dynamics.poincare_sections`::

        basins_of_attraction(analysis.dynamics.basins(looks), x="theta", y="theta_dot")
    """
    function = "basins_of_attraction"
    if "fate" not in basins:
        raise InputError("basins", of=function).says(
            "the sections have no fates: give analysis.dynamics.basins(sections)"
        )
    fate = coordinates.only(function, basins["fate"], basins, x, y)
    ax = ax or style.new_figure(6.6, 4.0).add_subplot()
    present, places = np.unique(fate.values, return_inverse=True)
    colours = [_colour(kind) for kind in present]
    if fate.ndim == 1:
        ax.scatter(basins[x], basins[y], c=[colours[i] for i in places], s=14, edgecolors="0.3",
                   linewidths=0.3)  # fmt: skip
    else:
        cells = fate.copy(data=places.reshape(fate.shape)).transpose(y, x).sortby([x, y])
        edges = [coordinates.edges(cells[name].values) for name in (x, y)]
        ax.pcolormesh(*edges, cells, cmap=ListedColormap(colours), vmin=-0.5,
                      vmax=len(colours) - 0.5, rasterized=True)  # fmt: skip
        ax.set(xlim=(edges[0][0], edges[0][-1]), ylim=(edges[1][0], edges[1][-1]))
    ax.grid(visible=False)
    _draw_orbits(ax, basins, x, y)
    handles = [
        Patch(facecolor=colour, edgecolor="0.3", lw=0.6, label=_fate(basins, kind))
        for kind, colour in zip(present, colours, strict=True)
    ]
    ax.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    ax.set(
        xlabel=f"initial {_label_of(basins, x, 'period')}",
        ylabel=f"initial {_label_of(basins, y, 'period')}",
    )
    return style.parent_figure(ax)


def _colour(fate: int) -> str:
    return _FATES[fate] if fate in _FATES else _ORBITS[(fate - 1) % len(_ORBITS)]


def _fate(basins: xr.Dataset, fate: int) -> str:
    """Its words, its cycles and its part of the starts."""
    part = f"{100 * float((basins['fate'] == fate).mean()):.3g} %"
    if fate in _FATES:
        words = {UNKNOWN: "no answer", FALLEN: "overturned", NOT_PERIODIC: "not periodic"}
        return f"{words[fate]}, {part}"
    cycles = int(basins["orbit_cycles"].sel(orbit=fate))
    return f"orbit of {cycles} cycle{'s' * (cycles > 1)}, {part}"


def _draw_orbits(ax: Axes, basins: xr.Dataset, x: str, y: str) -> None:
    """The looks at each orbit, of one motion on it."""
    fate, strobe = basins["fate"].values.ravel(), basins["strobe"]
    looks = strobe.values.reshape(fate.size, *strobe.shape[-2:])
    states = basins["state"].values.tolist()
    for number, cycles in zip(basins["orbit"].values, basins["orbit_cycles"].values, strict=True):
        of = looks[np.flatnonzero(fate == number)[0], -cycles:]
        ax.plot(of[:, states.index(x)], of[:, states.index(y)], "o", color=_colour(int(number)),
                mec="k", mew=0.8, ms=4)  # fmt: skip
