"""Motions in space seen from above: tracks of the feet, and tilt against its direction."""

from collections.abc import Mapping
from typing import cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator
from scipy.spatial import ConvexHull, QhullError

from rockeom.drawing import style
from rockeom.drawing.checks import check_drawn
from rockeom.integrator.schema import in_space
from rockeom.numbers.checks import InputError, InputTypeError, require_word
from rockeom.simulation.response import Response
from rockeom.structures.base import Structure
from rockeom.structures.positions import NO_FEET, barrier_over, has_barrier, lean_of

_TOUCHES = 1e-9  # part of the size of the base: a gap below is rounding
_SLIDES = 1e-4  # and a shorter way on the ground is left out
AZIMUTHS = np.linspace(0.0, 2 * np.pi, 721)


@style.styled
def plot_tracks(run: Response, *, ax: Axes | None = None) -> Figure:
    """Draw where the feet of a structure in space touched and slid, seen from above.

    Parameters
    ----------
    run : Response
        Response of a structure in space.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    InputError
        For a structure that moves in a plane, or has no feet.

    Notes
    -----
    Places are relative to the ground. Thick lines are the ways of a foot on the ground, dots the
    places at which it came down, thin lines its ways through the air; the legend has the length of
    its way on the ground, or how far it is from its place at the end. The base is dashed where it
    was at the start, and drawn through where it is at the end.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> prism = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)  # m, kg
    >>> run = rk.simulate(prism, rk.GroundMotion.none(2.0), initial={"pitch": 0.05, "roll": 0.02})
    >>> figure = plots.plot_tracks(run)
    """
    _check_spatial(run)
    m, at = run.structure.module, run.places.positions()
    kinds = zip(m.POSITIONS, m.POSITION_KINDS, strict=True)
    feet = [name for name, kind in kinds if kind not in NO_FEET or kind == "massless"]
    feet.sort(key=lambda name: name not in style.FEET)  # their colours as in plot_response
    if not feet:
        raise InputError("run").says(f"{style.name_of(run)} has no feet, and they leave no tracks")
    ax = ax or _titled(5.4, 5.4, run).add_subplot()
    size = float(np.ptp([places[0] for places in at.values()], axis=0).max())
    for line, moment in (((0, (4, 3)), 0), ("-", -1)):
        base = np.array([at[foot][moment, :2] for foot in feet])
        ax.fill(*base[hull_of(base)].T, fc="none", ec=style.INK, ls=line, lw=0.8, zorder=1)
    for foot, stroke in zip(feet, style.strokes(style.LINES), strict=False):
        _track(ax, run, foot, size, stroke["color"])
    unit = "-" if style.is_dimensionless(run) else "m"
    ax.set(xlabel=f"$x$ [{unit}]", ylabel=f"$y$ [{unit}]")
    ax.set_aspect("equal", adjustable="datalim")
    style.legend_above(ax)
    return style.parent_figure(ax)


@style.styled
def plot_tilt(run: Response, *, body: str | None = None, ax: PolarAxes | None = None) -> Figure:
    """Draw the tilt of a body in space against its direction, with the barrier of its weight.

    Parameters
    ----------
    run : Response
        Response of a structure in space.
    body : str, optional
        Name of the body; the one that tilts most if not given.
    ax : matplotlib.projections.polar.PolarAxes, optional
        Polar axes to draw on, ``plt.subplot(projection="polar")``; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    InputError
        For a structure that moves in a plane, and for an unknown body.
    TypeError
        For axes that are not polar.

    Notes
    -----
    Directions are those to which the body leans, from its own x and counter-clockwise, so that the
    base stays where it is when the body yaws. The dashed line is where the centroid is straight
    above the foot that is farthest in that direction: tan(tilt) = s/h, with the distance s of the
    centroid from the line through that foot across the direction, and its height h. For a
    rectangular base of half edges b and c, s = b |cos d| + c |sin d|. Beyond it the body falls
    unless something turns it back.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> prism = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)  # m, kg
    >>> run = rk.simulate(prism, rk.GroundMotion.none(2.0), initial={"pitch": 0.05, "roll": 0.02})
    >>> figure = plots.plot_tilt(run)
    """
    _check_spatial(run)
    turns = run.places.rotations()
    if body is None:
        body = next(iter(tilts_of(turns)))
    require_word("body", body, turns.keys())
    ax = ax or cast(PolarAxes, _titled(4.4, 4.8, run).add_subplot(projection="polar"))
    if not isinstance(ax, PolarAxes):
        raise InputTypeError("ax", ax).give('polar axes, plt.subplot(projection="polar")')
    lean = lean_of(entries(turns[body]))
    tilt, direction = lean.tilt, lean.direction
    surface = barrier_tilts(run.structure, body, AZIMUTHS)
    if np.isfinite(surface).all():
        ax.plot(AZIMUTHS, surface, "--", color=style.INK, lw=1.0, label="barrier")
    reach = float(surface.max() if np.isfinite(surface).all() else tilt.max()) or 1.0
    limit = min(max(1.1 * reach, 1.05 * float(tilt.max())), 1.6 * reach)
    until = np.append(np.flatnonzero(tilt > limit), len(tilt))[0] + 1  # where it leaves the picture
    tilt, direction = np.minimum(tilt[:until], limit), direction[:until]
    ax.plot(direction, tilt, color=style.LINES[0], lw=0.9, label="tilt [rad]")
    ax.plot(direction[:1], tilt[:1], "o", color=style.LINES[0], ms=4, label="start")
    style.mark_overturning(ax, run, tilt, direction, style.LINES[0])
    ax.set_ylim(0.0, limit)
    ax.yaxis.set_major_locator(MaxNLocator(3))
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.08), ncols=4, columnspacing=1.2)
    return style.parent_figure(ax)


def _track(ax: Axes, run: Response, foot: str, size: float, color: str) -> None:
    """The track of a foot of a structure of some size; its legend has how far it went."""
    x, y, above = run.places.positions()[foot].T
    contacts, (spans, _) = style.contacts(run), run.support.spans
    touches = above <= _TOUCHES * size
    if foot in contacts:  # while it never slips, its height has an error of integration
        touches = contacts[foot][np.searchsorted(spans[1:, 0], run.t, side="right")] > 0
    down = touches & ~np.append(False, touches[:-1])
    way, word = np.hypot(np.diff(x), np.diff(y))[touches[1:] & touches[:-1]].sum(), "on the ground"
    if way < _SLIDES * size:
        way, word = np.hypot(x[-1] - x[0], y[-1] - y[0]), "from its place"
    factor, unit = style.length_scale(run)
    name = f"{foot.replace('_', ' ')}, {style.digits(factor * way)} {unit} {word}"
    ax.plot(x, y, color=color, lw=0.7, alpha=0.5)
    shown = np.where(touches, 1.0, np.nan)
    ax.plot(x * shown, y * shown, color=color, lw=2.2, solid_capstyle="round")
    ax.plot(x[down], y[down], "o", color=color, mec="w", mew=0.5, ms=4.5, label=name, zorder=3)


def _titled(width: float, height: float, run: Response) -> Figure:
    """An empty figure of that size [in] with the names of structure and motion."""
    figure = style.new_figure(width, height)
    title = style.wrapped(style.plain(style.title_of(run)), int(14 * width))
    figure.suptitle(title, fontsize=9)
    return figure


def entries(turns: np.ndarray) -> np.ndarray:
    """(9, ...) entries of matrices (..., 3, 3), row by row."""
    return np.moveaxis(turns.reshape(*turns.shape[:-2], 9), -1, 0)


def tilts_of(turns: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Tilts (n,) of bodies by name, of matrices (n, 3, 3), that of the one that tilts most first.

    Those that never tilt are left out, unless none does.
    """
    found = {body: lean_of(entries(of)).tilt for body, of in turns.items()}
    most = sorted(found, key=lambda body: -found[body].max())
    return {name: found[name] for name in most if found[name].any() or name == most[0]}


def barrier_tilts(structure: Structure, body: str, directions: np.ndarray) -> np.ndarray:
    """(n,) barriers of a body on its base, leaning to directions (n,) from its x [rad].

    NaN where neither feet nor a surface say what its base is.
    """
    if has_barrier(structure):
        return structure.overturning_tilts(directions)
    solid = structure.solids.get(body)
    if solid is None or solid.vertices[:, 2].min() >= 0.0:  # a slab on columns
        return np.full(len(directions), np.nan)
    vertices = solid.vertices
    base = vertices[:, 2] <= vertices[:, 2].min() + _TOUCHES * np.ptp(vertices)
    return np.asarray(barrier_over(vertices[base], directions))


def hull_of(points: np.ndarray) -> np.ndarray:
    """Numbers of those of points (n, 2) that lie around all, in order."""
    try:
        return ConvexHull(points).vertices
    except (QhullError, ValueError):  # on one line, or fewer than three
        return np.arange(len(points))


def _check_spatial(run: Response) -> None:
    """Raise InputError for a response of a structure that moves in a plane."""
    check_drawn("run", run, Response)
    if not in_space(run.structure.module):
        raise InputError("run").says(
            f"{style.name_of(run)} moves in a plane: draw run.plot(), or a structure in space"
        )
