"""Figures of the datasets of `simulate_many`: maps, spectra, fragility and incremental analyses."""

from collections.abc import Sequence
from itertools import combinations
from textwrap import wrap
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from rockeom.analysis.dynamics.overturning import impacts_before_overturning
from rockeom.analysis.risk.fragility import Fragility, fragility_of
from rockeom.analysis.sweeps import (
    FALLS,
    STANDS,
    check_finished,
    coordinate,
    outcome_labels,
    peaks_of,
    unanswered,
)
from rockeom.drawing import style
from rockeom.numbers.checks import InputError, positive
from rockeom.plots import coordinates

_STYLES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 3)))
_NAMED = len(style.LINES)
"""Number of lines that have a name each in a legend, at most."""


# --- which pulses overturn

_NO_ANSWER = 6
_CLASSES = (
    ("stands, no impact", "#ffffff"),
    ("stands, after impacts", "#dbe9f6"),
    ("overturns after 3 or more impacts", "#f2bd80"),
    ("overturns after 2 impacts", "#e8924a"),
    ("overturns after 1 impact", "#b24a2b"),
    ("overturns without impact", "#591513"),
    ("no answer", "#9a9a9a"),
)
"""Outcomes of a case, each darker than the one before."""


@style.styled
def overturning_map(
    sweep: xr.Dataset,
    *,
    x: str,
    y: str,
    boundaries: xr.Dataset | None = None,
    ax: Axes | None = None,
) -> Figure:
    """Draw which cases overturn, and after how many impacts, over two names of a sweep.

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset of `simulate_many`.
    x : str
        Name of a dimension of the sweep, or a coordinate of the cases of a table, which are then
        drawn as dots. A name's attributes `long_name` and `units` label its axis:
        ``sweep["frequency"].attrs["units"] = "Hz"``.
    y : str
        Name of another dimension or coordinate.
    boundaries : xarray.Dataset, optional
        Dataset of `analysis.overturning_boundaries`, drawn as lines: where they cross the sides of
        the sweep's cells they are accurate, and in a cell they are straight.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    ValueError
        For names that the sweep or the boundaries do not have, where the sweep varies others as
        well, and for boundaries of a sweep that is no grid of numbers.

    Notes
    -----
    Each class is darker than the one before, without colours, too. Overturning without an impact
    and after some are the two modes of Zhang and Makris. Cases that were not run or gave no answer
    are grey and crossed out.

    References
    ----------
    Zhang and Makris (2001), Journal of Engineering Mechanics 127(5), 473-483.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> def shaken(amplitude, period):
    ...     return rk.Case(block, rk.GroundMotion.single_sine(amplitude, period, duration=6.0))
    >>> sweep = rk.simulate_many(shaken, over={"amplitude": [3.0, 4.0], "period": [0.4, 0.8]})
    >>> figure = plots.overturning_map(sweep, x="period", y="amplitude")
    """
    kinds = coordinates.only("overturning_map", _classes(sweep), sweep, x, y)
    ax = ax or style.new_figure(6.8, 4.2).add_subplot()
    coordinates.name_axes(ax, sweep, x, y)
    if kinds.ndim == 1:
        at = coordinates.places(sweep[x]), coordinates.places(sweep[y])
        colours = [_CLASSES[kind][1] for kind in kinds.values]
        ax.scatter(*at, c=colours, s=22, edgecolors="0.3", linewidths=0.5)
    else:
        _cells(ax, kinds.transpose(y, x).sortby(coordinates.sortable(sweep, x, y)), x, y)
    present = [_CLASSES[kind] for kind in np.unique(kinds.values)]
    handles: list[Artist] = [
        Patch(facecolor=colour, edgecolor="0.3", lw=0.6, label=label,
              hatch="xxx" if label == _CLASSES[_NO_ANSWER][0] else None)
        for label, colour in present
    ]  # fmt: skip
    if boundaries is not None:
        handles.append(_draw_boundaries(ax, boundaries, sweep, x, y))
    ax.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    _entitle(ax, sweep, kinds.size)
    return style.parent_figure(ax)


def _classes(sweep: xr.Dataset) -> xr.DataArray:
    """Which of _CLASSES each case is."""
    before = impacts_before_overturning(sweep, most=3)
    stands = xr.where(sweep["impacts"] > 0, 1, 0)
    classes = xr.where(np.isinf(before), stands, 5 - before)
    return classes.fillna(_NO_ANSWER).astype(int)


def _cells(ax: Axes, kinds: xr.DataArray, x: str, y: str) -> None:
    """A rectangle around each pair of values; those without an answer are crossed out."""
    edges = [coordinates.edges(coordinates.places(kinds[name])) for name in (x, y)]
    colours = np.array([to_rgb(colour) for _, colour in _CLASSES])
    ax.pcolormesh(*edges, colours[kinds.values], rasterized=True)
    unknown = np.ma.masked_not_equal(kinds.values, _NO_ANSWER)
    if unknown.count():
        grey = ListedColormap([_CLASSES[_NO_ANSWER][1]])
        ax.pcolor(*edges, unknown, cmap=grey, hatch="xxx", edgecolor="0.3", lw=0)
    ax.grid(visible=False)
    ax.set(xlim=(edges[0][0], edges[0][-1]), ylim=(edges[1][0], edges[1][-1]))


def _draw_boundaries(ax: Axes, boundaries: xr.Dataset, sweep: xr.Dataset, x: str, y: str) -> Line2D:
    """Lines through the cells of a grid, dots where none leads on; returns what stands for them."""
    for name in (x, y):
        if name not in boundaries.coords or sweep[name].dims != (name,):
            raise InputError("boundaries", of="overturning_map").says(
                f"the boundaries of a grid over {x!r} and {y!r} are wanted: give those of this "
                "sweep"
            )
    points = np.stack([boundaries[name].values for name in (x, y)], axis=1)
    lines, alone = _joined(points, boundaries, sweep, (x, y))
    look: dict[str, Any] = {"color": style.INK, "lw": 0.8}
    ax.add_collection(LineCollection([points[list(pair)] for pair in lines], **look), autolim=False)
    ax.plot(*points[alone].T, ".", color=style.INK, ms=1.5, mew=0)
    return Line2D([], [], label="boundary", **look)


def _joined(
    points: np.ndarray, boundaries: xr.Dataset, sweep: xr.Dataset, names: tuple[str, str]
) -> tuple[list[tuple[int, int]], list[int]]:
    """Pairs of points that a line joins, and the points that none does.

    Two on different sides of a cell are joined if the same fates meet in both, the closest first.
    """
    edges = [np.sort(sweep[name].values) for name in names]
    fates = np.sort([boundaries["below"].values, boundaries["above"].values], axis=0).T
    cells: dict[tuple[int, ...], list[tuple[int, tuple[int, int]]]] = {}
    for i, along in enumerate(boundaries["along"].values):
        axis = names.index(along)
        place = [int((e <= v).sum()) - 1 for e, v in zip(edges, points[i], strict=True)]
        for back in (0, 1):
            cell = place.copy()
            cell[1 - axis] -= back
            cells.setdefault((*cell, *fates[i]), []).append((i, (axis, back)))
    spans = np.array([edge[-1] - edge[0] for edge in edges])
    pairs: list[tuple[int, int]] = []
    for there in cells.values():
        pairs += _closest(points / spans, there)
    joined = {i for pair in pairs for i in pair}
    return pairs, [i for i in range(len(points)) if i not in joined]


def _closest(points: np.ndarray, there: list[tuple[int, tuple[int, int]]]) -> list[tuple[int, int]]:
    """Each point of a cell with one on another side, the closest first."""
    choices = sorted(
        (float(np.hypot(*(points[i] - points[j]))), i, j)
        for (i, side), (j, other) in combinations(there, 2)
        if side != other
    )
    taken: set[int] = set()
    pairs = []
    for _, i, j in choices:
        if not taken & {i, j}:
            pairs.append((i, j))
            taken |= {i, j}
    return pairs


# --- how far it rocks


@style.styled
def rocking_spectrum(
    sweep: xr.Dataset,
    *,
    x: str,
    alpha: float | str,
    by: str | None = None,
    state: str = "theta",
    fractiles: Sequence[float] = (),
    ax: Axes | None = None,
) -> Figure:
    """Draw the peak rotation over the slenderness against a name of a sweep, a line for each value
    of `by`.

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset of `simulate_many`, such as that of `analysis.rocking_spectrum`.
    x : str
        Name of the sweep, such as the frequency parameter p or the period 2 pi/p of the blocks.
    alpha : float or str
        Slenderness of the blocks [rad], or the sweep's name of it.
    by : str, optional
        Another name of the sweep, if it varies one. Many lines have a scale of colours; many of
        words, such as records, are thin and grey.
    state : str, optional
        The rotation.
    fractiles : sequence of float, optional
        Parts of the lines, such as (0.16, 0.5, 0.84): thick lines that so many of the others do not
        exceed at each x, overturning being more than any rotation. They have gaps where so many
        overturn.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    ValueError
        For names that the sweep does not have, where it varies others as well, and for cases that
        were not run.

    Notes
    -----
    Cases that overturn have no peak: they are triangles in the band above, a row for each line.
    Lines have gaps there, and where there is no answer.

    References
    ----------
    Makris and Konstantinidis (2003), Earthquake Engineering and Structural Dynamics 32(2), 265-289.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import analysis, plots
    >>> pulse = rk.GroundMotion.ricker(4.0, 0.6)  # m/s2, s
    >>> sweep = analysis.rocking_spectrum(pulse, periods=[2.0, 3.0, 4.0], alpha=[0.2, 0.3])
    >>> figure = plots.rocking_spectrum(sweep, x="period", by="alpha", alpha="alpha")
    """
    function = "rocking_spectrum"
    check_finished(function, sweep)
    labels = outcome_labels(sweep)
    slenderness: Any = (
        coordinate(function, sweep, alpha)
        if isinstance(alpha, str)
        else positive(function, alpha=alpha)[0]
    )
    ratios = (peaks_of(sweep, state) / slenderness).where(labels.isin(STANDS))
    names = (x,) if by is None else (by, x)
    ratios = coordinates.only(function, ratios, sweep, *names).transpose(*reversed(names))
    fell = coordinates.only(function, labels == FALLS, sweep, *names).transpose(*reversed(names))
    order = np.argsort(at := coordinates.places(sweep[x]))
    at = at[order]
    lines = ratios.values.reshape(len(at), -1)[order]
    down = fell.values.reshape(lines.shape)[order]
    ax = ax or style.new_figure(6.4, 3.8).add_subplot()
    top = 1.05 * np.nanmax(lines, initial=1.0)
    rows = top * (1.0 + 0.2 * (np.arange(lines.shape[1]) + 0.5) / lines.shape[1])
    looks = _looks(ax, sweep, by, lines.shape[1])
    for line, lost, row, look in zip(lines.T, down.T, rows, looks, strict=True):
        ax.plot(at, line, marker=".", markevery=_alone(line), **look)
        ax.plot(at[lost], np.full(lost.sum(), row), "^", color=look["color"], ms=3.5, mew=0)
    for part, dashes in zip(fractiles, _STYLES, strict=False):
        ax.plot(at, _not_exceeded(lines, down, part), ls=dashes, color=style.LINES[1], lw=1.8,
                zorder=5, label=f"{100 * part:.0f} % of them")  # fmt: skip
    if down.any():
        ax.axhspan(top, 1.2 * top, facecolor="0.95", lw=0, zorder=0)
        ax.plot([], [], "^", color=style.INK, ms=3.5, mew=0, label="overturned")
        ax.set_yticks([tick for tick in ax.get_yticks() if tick <= top])
    ax.set(
        ylim=(0.0, 1.2 * top if down.any() else top),
        xlim=(at[0], at[-1]),
        xlabel=coordinates.label(sweep, x),
        ylabel=rf"largest $|${style.symbol(state)}$|/\alpha$ [-]",
    )
    if ax.get_legend_handles_labels()[0]:
        title = None if by is None or lines.shape[1] > _NAMED else coordinates.label(sweep, by)
        ax.legend(title=title, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    _entitle(ax, sweep, lines.size)
    return style.parent_figure(ax)


def _alone(line: np.ndarray) -> list[int]:
    """Places of values that no line leads to: both neighbours are nan, or there is none."""
    there = np.pad(np.isfinite(line), 1)
    return np.flatnonzero(there[1:-1] & ~there[:-2] & ~there[2:]).tolist()


def _not_exceeded(lines: np.ndarray, down: np.ndarray, part: float) -> np.ndarray:
    """(n,) the least of lines (n, m) that this part of them does not exceed; nan where it fell."""
    order = np.sort(np.where(down, np.inf, lines), axis=1)  # those without an answer come last
    number = np.isfinite(order).sum(axis=1) + down.sum(axis=1)
    place = np.maximum(np.ceil(part * number - 1e-9).astype(int) - 1, 0)
    demands = order[np.arange(len(order)), place]
    return np.where(np.isfinite(demands), demands, np.nan)


def _looks(ax: Axes, sweep: xr.Dataset, by: str | None, n: int) -> list[dict[str, Any]]:
    """How each of n lines is drawn: few by name, many by a scale of colours, words in grey."""
    if by is None:
        return [{"color": style.LINES[0]}]
    values = sweep[by].values
    if n <= _NAMED:
        return [
            {"color": colour, "ls": dashes, "label": coordinates.said(value)}
            for value, colour, dashes in zip(values, style.LINES, _STYLES, strict=False)
        ]
    if values.dtype.kind not in "iuf":
        name = style.plain(by.replace("_", " "))
        return [{"color": "0.45", "lw": 0.6, "label": f"each {name}" * (i == 0)} for i in range(n)]
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    scale = ScalarMappable(Normalize(values.min(), values.max()), colormaps["viridis"])
    style.parent_figure(ax).colorbar(scale, ax=ax, label=coordinates.label(sweep, by))
    return [{"color": scale.to_rgba(value), "lw": 0.9} for value in values]


# --- how likely it is


@style.styled
def fragility_curve(
    result: xr.Dataset | Fragility,
    *,
    intensity: str = "intensity",
    demand: str | None = None,
    limit: float | None = None,
    group: str | None = "recording",
    level: float = 0.95,
    ax: Axes | None = None,
) -> Figure:
    """Draw the lognormal fragility curve of a sweep, its confidence bounds, and the observations.

    Parameters
    ----------
    result : xarray.Dataset or Fragility
        A sweep, or a curve that `analysis.risk.fit_fragility` has fitted.
    intensity : str, optional
        Name of the intensity, as for `analysis.fragility_of`; it labels the axis where a curve is
        given.
    demand : str, optional
        State or quantity, as for `analysis.fragility_of`; overturning if not given.
    limit : float, optional
        Limit of the demand [its unit].
    group : str, optional
        Name of the sweep's of motions that depend on one another, as for `analysis.fragility_of`.
    level : float, optional
        Probability of the bounds at an intensity, which come from the covariance of the curve.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes. Dots are the fractions observed.

    Raises
    ------
    ValueError
        Where no curve is most likely, as `analysis.risk.fit_fragility` says.

    Examples
    --------
    With a sweep over the peak ground acceleration::

        fragility_curve(sweep, intensity="pga")
        fragility_curve(sweep, intensity="pga", demand="theta", limit=0.05)
    """
    if isinstance(result, Fragility):
        curve, label = result, style.plain(intensity.replace("_", " "))
    else:
        curve = fragility_of(result, intensity=intensity, demand=demand, limit=limit, group=group)
        label = coordinates.label(result, intensity)
    ax = ax or style.new_figure(5.4, 3.8).add_subplot()
    levels, fractions = curve.fractions()
    end = 1.05 * max(levels[-1], curve.median)
    im = np.linspace(1e-3 * end, end, 400)
    low, high = curve.bounds(im, level)
    ax.fill_between(im, low, high, facecolor="#cfe0ee", lw=0, label=f"{100 * level:g} % confidence")
    ax.plot(im, curve.probability(im), color=style.LINES[0], lw=1.6, label="maximum likelihood")
    ax.plot(levels, fractions, "o", color=style.INK, mfc="white", ms=4.5, zorder=4,
            label="observed", clip_on=False)  # fmt: skip
    ax.plot([curve.median] * 2, [0.0, 0.5], ":", color=style.INK, lw=0.9)
    ax.set(xlabel=label, xlim=(0.0, end), ylim=(0.0, 1.0))
    ax.set_ylabel(_event(demand, limit, result))
    _, _, unit = label.partition(" [")
    title = f"median {curve.median:.4g} {unit.rstrip(']')}".rstrip(" -")
    title += f", dispersion {curve.dispersion:.3g}, {curve.grouped}"
    ax.set_title("\n".join(map(style.plain, [title, *wrap(curve.not_counted, 70)])), fontsize=8.5)
    ax.legend(loc="lower right")
    return style.parent_figure(ax)


def _event(demand: str | None, limit: float | None, observed: xr.Dataset | Fragility) -> str:
    if isinstance(observed, Fragility):
        return "probability of exceedance [-]"
    if demand is None:
        return "probability of overturning [-]"
    unit = _unit_of_demand(observed, demand)
    reached = f"{limit:g} {unit}".rstrip()
    return f"probability that |{style.plain(demand)}|\nreaches {reached} or overturns [-]"


# --- what each record asks for

_FRACTILES = ((0.16, "--"), (0.50, "-"), (0.84, "-."))
_FEW_NAMES = 12
_LINE = 0.035
"""Height of a line of small text, over that of the axes."""


@style.styled
def incremental_dynamic_analysis(
    sweep: xr.Dataset,
    *,
    intensity: str,
    demand: str = "theta",
    record: str | None = None,
    ax: Axes | None = None,
) -> Figure:
    """Draw the demand of each record on a structure as its intensity grows, and fractiles of all.

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset of `simulate_many`.
    intensity : str
        Name of the sweep, or a coordinate of its cases: of a table, or one that has other values
        for each record, such as a spectral acceleration where the records were scaled to peaks.
    demand : str, optional
        State or quantity whose largest size is drawn.
    record : str, optional
        The sweep's name of the records: whatever else it varies, if not given.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    ValueError
        For names that the sweep does not have, where `record` is missing, and for cases that were
        not run.

    Notes
    -----
    A record is a thin line. Where it overturns there is no demand: the line goes to the band at the
    right, and a few records are named where they do so first. Thick lines are the 16, 50 and 84 %
    fractiles of the demand at an intensity, overturning being more than any demand; they end in the
    band where so many records overturn. Between the intensities of a record the demand is linear,
    and overturning lasts from the first of two to the second.

    References
    ----------
    Vamvatsikos and Cornell (2002), Earthquake Engineering and Structural Dynamics 31(3), 491-514.

    Examples
    --------
    With a sweep over motions and their peak ground acceleration::

        incremental_dynamic_analysis(sweep, intensity="pga", demand="theta")
    """
    function = "incremental_dynamic_analysis"
    curves, names = _by_record(function, sweep, intensity, demand, record)
    peaks = np.concatenate([d[np.isfinite(d)] for _, d in curves])
    if not len(peaks):
        raise InputError("demand", of=function).says("no case has one: all fell, or gave no answer")
    last = 1.04 * peaks.max() or 1.0
    edge = 1.14 * last
    ax = ax or style.new_figure(7.2, 4.4).add_subplot()
    for i, (im, d) in enumerate(curves):
        at = np.where(np.isposinf(d), edge, d)
        ax.plot(at, im, color="0.6", lw=0.6, zorder=2, label="each record" * (i == 0) or None)
        down = np.isposinf(d)
        ax.plot(at[down], im[down], ">", color="0.35", ms=3, mew=0, zorder=3, clip_on=False)
    levels = _common_levels(curves)
    demands = np.array([_demands_at(levels, *curve) for curve in curves])
    for part, dashes in _FRACTILES:
        at, im = _fractile(demands, levels, part)
        ax.plot(np.where(np.isposinf(at), edge, at), im, ls=dashes, color=style.LINES[1], lw=1.8,
                zorder=5, label=f"{100 * part:.0f} % of records")  # fmt: skip
    ax.set(xlim=(0.0, edge), ylim=(0.0, 1.03 * max(im.max() for im, _ in curves)))
    if any(np.isposinf(d).any() for _, d in curves):
        ax.axvspan(last, edge, facecolor="0.93", lw=0, zorder=1)
        ax.text((last + edge) / 2, 0.02, "overturned", rotation=90, ha="center", va="bottom",
                fontsize=8, transform=ax.get_xaxis_transform(), zorder=6)  # fmt: skip
        ax.set_xticks([tick for tick in ax.get_xticks() if tick <= last])
        if len(names) <= _FEW_NAMES:
            _name_fallen(ax, curves, names, edge)
    ax.set(xlabel=_demand_label(sweep, demand), ylabel=coordinates.label(sweep, intensity))
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.2)
    if lost := unanswered(outcome_labels(sweep)):
        ax.set_title(f"{lost}: in no fractile", fontsize=9, pad=24)
    return style.parent_figure(ax)


def _by_record(
    function: str, sweep: xr.Dataset, intensity: str, demand: str, record: str | None
) -> tuple[list[tuple[np.ndarray, np.ndarray]], list[str]]:
    """(intensities, demands) of each record, overturned being infinite, and their names.

    Cases without an answer are nan.
    """
    check_finished(function, sweep)
    im = coordinate(function, sweep, intensity)
    labels = outcome_labels(sweep)
    peaks = peaks_of(sweep, demand).where(labels.isin(STANDS)).where(labels != FALLS, np.inf)
    others = [str(d) for d in labels.dims if d not in im.dims]
    others = others or [str(d) for d in labels.dims if sweep[d].dtype.kind in "OTU"]
    if record is None and not others:
        raise InputError("record", of=function).says(
            f"the sweep varies {', '.join(map(str, labels.dims))}, and no record: give record=, "
            "the name of its coordinate that tells one"
        )
    keys = [record] if record is not None else others
    columns = [coordinate(function, sweep, key) for key in keys]
    each = [a.values.ravel() for a in xr.broadcast(im, peaks, *columns)]
    of = np.array([", ".join(map(str, key)) for key in zip(*each[2:], strict=True)])
    curves, names = [], list(dict.fromkeys(of.tolist()))
    for name in names:
        mine = np.flatnonzero(of == name)
        mine = mine[np.argsort(each[0][mine], kind="stable")]
        curves.append((each[0][mine], each[1][mine]))
    return curves, names


def _common_levels(curves: Sequence[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Intensities (n,) of any record, from the first to the last that all records reach."""
    levels = np.unique(np.concatenate([im for im, _ in curves]))
    first, last = max(im.min() for im, _ in curves), min(im.max() for im, _ in curves)
    return levels[(levels >= first) & (levels <= last)]


def _demands_at(levels: np.ndarray, im: np.ndarray, demand: np.ndarray) -> np.ndarray:
    """Demands (n,) of a record at intensities: its own, and linear between two of its own.

    Infinite between two of which one is; nan for its own without an answer.
    """
    answered = ~np.isnan(demand)
    if not answered.any():
        return np.full(len(levels), np.nan)
    at, d = im[answered], demand[answered]
    down = np.isposinf(d)
    demands = np.interp(levels, at, np.where(down, 0.0, d))
    demands[np.interp(levels, at, down) > 0.0] = np.inf
    demands[np.isin(levels, im[~answered])] = np.nan
    return demands


def _fractile(
    demands: np.ndarray, levels: np.ndarray, part: float
) -> tuple[np.ndarray, np.ndarray]:
    """The least demand that is not exceeded by this part of the records, at each intensity.

    demands (m, n) : of m records at n levels; nan does not count. It ends at the first intensity at
    which it is infinite.
    """
    quantiles = []
    for there in demands.T:
        there = there[~np.isnan(there)]
        quantiles.append(np.quantile(there, part, method="inverted_cdf") if len(there) else np.nan)
    at = np.array(quantiles)
    down = np.flatnonzero(np.isposinf(at))
    end = down[0] + 1 if len(down) else len(at)
    return at[:end], levels[:end]


def _name_fallen(
    ax: Axes, curves: Sequence[tuple[np.ndarray, np.ndarray]], names: Sequence[str], edge: float
) -> None:
    """Records, each with the intensity at which it overturns first."""
    first: dict[float, list[str]] = {}
    for (im, d), name in zip(curves, names, strict=True):
        if np.isposinf(d).any():
            first.setdefault(float(im[np.isposinf(d)][0]), []).append(name)
    line, free = _LINE * ax.get_ylim()[1], 0.0
    for level, those in sorted(first.items()):
        more = f"\nand {len(those) - 1} more" if len(those) > 1 else ""
        half = 0.5 * line * (2 if more else 1)
        place = max(level, free + half)  # of a name whose neighbour below leaves no room: above it
        free = place + half
        ax.annotate(style.plain(coordinates.short(those[0]) + more), (edge, level),
                    xytext=(1.03 * edge, place), fontsize=7, va="center", annotation_clip=False,
                    arrowprops={"arrowstyle": "-", "lw": 0.4, "color": "0.5", "relpos": (0.0, 0.5),
                                "shrinkA": 0.0, "shrinkB": 0.0})  # fmt: skip


# --- names


def _demand_label(sweep: xr.Dataset, demand: str) -> str:
    unit = _unit_of_demand(sweep, demand)
    shown = style.plain(demand.replace("_", " "))
    return f"largest |{shown}|" + (f" [{unit}]" if unit else "")


def _unit_of_demand(sweep: xr.Dataset, demand: str) -> str:
    """Unit of a state or quantity, where the dataset tells it; else nothing."""
    peaks = peaks_of(sweep, demand)
    for name in ("state_unit", "quantity_unit"):
        if name in peaks.coords:
            return coordinates.unit(peaks[name].values)
    return coordinates.unit(peaks.attrs.get("units", ""))


def _entitle(ax: Axes, sweep: xr.Dataset, n: int) -> None:
    name = style.plain(str(sweep.attrs.get("model", "")).replace("_", " "))
    title = f"{name[:1].upper()}{name[1:]}, {n:,} motions".lstrip(", ")
    ax.set_title(f"{title}\n{unanswered(outcome_labels(sweep))}".rstrip(), fontsize=9)
