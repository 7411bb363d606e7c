"""Pieces of a free-body diagram: the body, the ground, forces, angles and dimension lines.

Each function draws one piece in the axes it is given. Points are (x, y) in the units of the axes,
angles of rotation are clockwise [rad], and an offset of a label is in points of type (1/72 in),
so that it does not depend on the scale of the drawing::

    figure, ax = plt.subplots()
    free_body.bare(ax)
    free_body.ground(ax, -1.0, 1.0)
    corners = free_body.turned([(-0.3, 0), (0.3, 0), (0.3, 1.6), (-0.3, 1.6)], (0.3, 0.0), 0.2)
    free_body.body(ax, corners)
    free_body.pivot(ax, (0.3, 0.0), "O")
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.path import Path
from matplotlib.text import Annotation
from matplotlib.transforms import Affine2D
from numpy.typing import ArrayLike

from rockeom.drawing.style import INK, LINES
from rockeom.numbers.checks import require

Point = Sequence[float] | np.ndarray

BODY = "#dbe9f6"
"""Colour of a body's face."""
FORCE, MOTION = LINES[1], LINES[2]
"""Colours of a force, and of a velocity or an acceleration."""


def bare(ax: Axes) -> None:
    """Give axes for a drawing equal scales in both directions, and no frame.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    """
    ax.set_aspect("equal")
    ax.axis("off")


def turned(points: ArrayLike, about: Point, angle: float) -> np.ndarray:
    """Points turned clockwise about a point.

    Parameters
    ----------
    points : array_like
        Points (n, 2).
    about : Point
        Pivot (x, y).
    angle : float
        Angle [rad].

    Returns
    -------
    ndarray
        Points (n, 2).
    """
    cos, sin = np.cos(angle), np.sin(angle)
    away = np.atleast_2d(np.asarray(points, float)) - np.asarray(about, float)
    return np.asarray(about) + away @ np.array([[cos, -sin], [sin, cos]])


# --- bodies and supports


def body(ax: Axes, corners: ArrayLike, *, faint: bool = False) -> None:
    """Draw a rigid body.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    corners : array_like
        Corners (n, 2).
    faint : bool, optional
        Whether it is faint, as where the body was before.
    """
    x, y = np.asarray(corners, float).T
    if faint:
        ax.fill(x, y, facecolor="none", edgecolor="0.6", lw=0.9, ls=(0, (5, 3)))
    else:
        ax.fill(x, y, facecolor=BODY, edgecolor=LINES[0], lw=1.2)


def ground(
    ax: Axes, left: float, right: float, level: float = 0.0, depth: float | None = None
) -> None:
    """Draw the ground, hatched below.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    left : float
        Left end.
    right : float
        Right end.
    level : float, optional
        Height of the surface.
    depth : float, optional
        Depth of the hatched part; 1/15 of its width if not given.
    """
    depth = (right - left) / 15 if depth is None else depth
    ax.fill_between(
        [left, right], level - depth, level, facecolor="0.92", hatch="////", ec="0.7", lw=0
    )
    ax.plot([left, right], [level, level], color=INK, lw=1.2)


def spring(ax: Axes, start: Point, end: Point, width: float, *, coils: int = 4) -> None:
    """Draw a zigzag from one point to another.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    start : Point
        Start (x, y).
    end : Point
        End (x, y).
    width : float
        Width across.
    coils : int, optional
        Number of coils.

    Raises
    ------
    ValueError
        If the points coincide.
    """
    along = np.concatenate([[0.0], np.linspace(0.15, 0.85, 2 * coils + 1), [1.0]])
    across = np.zeros_like(along)
    across[2:-2] = width / 2 * (-1.0) ** np.arange(2 * coils - 1)
    ax.plot(*_along(start, end, along, across).T, color=INK, lw=1.0)


def damper(ax: Axes, start: Point, end: Point, width: float) -> None:
    """Draw a dashpot.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    start : Point
        Start (x, y).
    end : Point
        End (x, y).
    width : float
        Width across.

    Raises
    ------
    ValueError
        If the points coincide.
    """
    half = width / 2
    cup = ([0.0, 0.35, 0.35, 0.7, 0.35, 0.35, 0.7], [0.0, 0.0, half, half, half, -half, -half])
    piston = ([0.55, 0.55, 0.55, 1.0], [0.7 * half, -0.7 * half, 0.0, 0.0])
    for along, across in (cup, piston):
        ax.plot(*_along(start, end, np.array(along), np.array(across)).T, color=INK, lw=1.0)


def wall(ax: Axes, low: float, high: float, at: float, depth: float) -> None:
    """Draw a vertical wall, hatched behind.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    low : float
        Lower end.
    high : float
        Upper end.
    at : float
        Place on the horizontal axis.
    depth : float
        Depth of the hatched part; to the left if negative.
    """
    ax.fill_betweenx([low, high], at, at + depth, facecolor="0.92", hatch="////", ec="0.7", lw=0)
    ax.plot([at, at], [low, high], color=INK, lw=1.2)


def pivot(ax: Axes, at: Point, label: str = "", offset: Point = (0, -11)) -> None:
    """Draw a point about which the body turns.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    at : Point
        Place (x, y).
    label : str, optional
        Text.
    offset : Point, optional
        Distance (x, y) of the label's centre from there.
    """
    ax.plot(*at, "o", color="white", mec=INK, mew=1.2, ms=5.5, zorder=6)
    _text(ax, at, label, offset)


def mass(ax: Axes, at: Point, label: str = "", offset: Point = (10, 0), size: float = 10.0) -> None:
    """Draw a lumped mass.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    at : Point
        Place (x, y).
    label : str, optional
        Text.
    offset : Point, optional
        Distance (x, y) of the label's centre from there.
    size : float, optional
        Diameter in points.
    """
    ax.plot(*at, "o", color=LINES[1], mec=INK, mew=0.7, ms=size, zorder=5)
    _text(ax, at, label, offset, ha="left")


def centroid(ax: Axes, at: Point, label: str = "", offset: Point = (9, 6)) -> None:
    """Draw a centre of mass: a disc with two black quarters.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    at : Point
        Place (x, y).
    label : str, optional
        Text.
    offset : Point, optional
        Distance (x, y) of the label's centre from there.
    """
    ax.plot(*at, "o", color="white", mec=INK, mew=0.8, ms=8, zorder=6)
    for start in (0, 180):
        quarter = Path.wedge(start, start + 90)
        ax.plot(*at, marker=quarter, color=INK, mec="none", ms=8, zorder=7)
    _text(ax, at, label, offset)


# --- arrows


def arrow(
    ax: Axes,
    tail: Point,
    tip: Point,
    label: str = "",
    *,
    color: str = FORCE,
    label_at: str = "tip",
    offset: Point = (0, 8),
) -> None:
    """Draw a force, or with ``color=MOTION`` a velocity or an acceleration.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    tail : Point
        Start (x, y).
    tip : Point
        End (x, y).
    label : str, optional
        Text.
    color : str, optional
        Colour.
    label_at : str, optional
        Place of the label, "tip", "tail" or "middle".
    offset : Point, optional
        Distance (x, y) of the label's centre from there.

    Raises
    ------
    ValueError
        For any other place.
    """
    style = _arrow("-|>,head_width=0.22,head_length=0.5", color, 1.5)
    ax.annotate("", _xy(tip), _xy(tail), arrowprops=style, zorder=8)
    ax.plot(*np.transpose([tail, tip]), lw=0)  # an annotation does not widen the limits
    places = {"tip": 1.0, "tail": 0.0, "middle": 0.5}
    require(label_at in places, "", "label_at", label_at, "choose 'tip', 'tail' or 'middle'")
    where = places[label_at]
    at = (1 - where) * np.asarray(tail, float) + where * np.asarray(tip, float)
    _text(ax, at, label, offset, color=color)


def angle(
    ax: Axes,
    vertex: Point,
    first: Point,
    second: Point,
    radius: float,
    label: str = "",
    *,
    sense: bool = False,
    color: str = INK,
    label_radius: float = 1.3,
) -> None:
    """Draw the angle at a vertex from the direction of one point to that of another, the smaller
    one.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    vertex : Point
        Vertex (x, y).
    first : Point
        First point (x, y).
    second : Point
        Second point (x, y).
    radius : float
        Radius of the arc.
    label : str, optional
        Text.
    sense : bool, optional
        Whether the arc ends in an arrow at `second`, as for a rotation or a couple.
    color : str, optional
        Colour.
    label_radius : float, optional
        Place of the label on the bisector, as a multiple of `radius`.
    """
    origin = np.asarray(vertex, float)
    a, b = (np.arctan2(*(np.asarray(p, float) - origin)[::-1]) for p in (first, second))
    b = a + (b - a + np.pi) % (2 * np.pi) - np.pi
    t = np.linspace(a, b, 60)
    arc = origin + radius * np.column_stack([np.cos(t), np.sin(t)])
    ax.plot(*arc.T, color=color, lw=1.0)
    if sense:
        head = _arrow("-|>,head_width=0.18,head_length=0.4", color, 0.0)
        ax.annotate("", arc[-1], arc[-5], arrowprops=head, zorder=8)
    middle = (a + b) / 2
    at = origin + label_radius * radius * np.array([np.cos(middle), np.sin(middle)])
    _text(ax, at, label, (0, 0), color=color)


def dimension(
    ax: Axes, start: Point, end: Point, label: str, shift: float = 0.0, offset: Point = (0, 7)
) -> None:
    """Draw a dimension line between two points.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    start : Point
        Start (x, y).
    end : Point
        End (x, y).
    label : str
        Text.
    shift : float, optional
        Distance of the line to the left of its direction.
    offset : Point, optional
        Distance (x, y) of the label's centre from its place.

    Raises
    ------
    ValueError
        If the points coincide.
    """
    ends = _along(start, end, np.array([0.0, 1.0]), np.array([shift, shift]))
    for point, moved in zip((start, end), ends, strict=True):
        ax.plot(*np.transpose([point, moved]), color="0.6", lw=0.6)
    style = _arrow("<|-|>,head_width=0.15,head_length=0.4", INK, 0.8)
    ax.annotate("", ends[1], ends[0], arrowprops=style)
    _text(ax, ends.mean(axis=0), label, offset)


def line(ax: Axes, start: Point, end: Point) -> None:
    """Draw a thin dashed line of reference, such as the vertical through a pivot.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    start : Point
        Start (x, y).
    end : Point
        End (x, y).
    """
    ax.plot(*np.transpose([start, end]), color="0.45", lw=0.8, ls=(0, (6, 3)))


def tilt(ax: Axes, angle: float, artists: Sequence[Artist]) -> None:
    """Turn what is drawn clockwise about the origin; words stay level.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Axes.
    angle : float
        Angle [rad].
    artists : sequence of matplotlib.artist.Artist
        Lines, shapes and labels of the axes.
    """
    transform = Affine2D().rotate(-angle) + ax.transData
    for artist in artists:
        if isinstance(artist, Annotation):
            artist.xycoords = transform
            if artist.anncoords == "data":  # the tail of an arrow
                artist.anncoords = transform
        else:
            artist.set_transform(transform)


def _arrow(style: str, color: str, width: float) -> dict[str, Any]:
    """An arrow from its one end to the other, as `annotate` takes it."""
    return {"arrowstyle": style, "color": color, "lw": width, "shrinkA": 0, "shrinkB": 0}


def _along(start: Point, end: Point, along: np.ndarray, across: np.ndarray) -> np.ndarray:
    """(n, 2) points at parts `along` of the way, moved by `across` to the left of it."""
    origin = np.asarray(start, float)
    way = np.asarray(end, float) - origin
    length = float(np.hypot(*way))
    require(length != 0.0, "", "end", tuple(origin), "start is the same point: nothing to draw")
    normal = np.array([-way[1], way[0]]) / length
    return origin + np.outer(along, way) + np.outer(across, normal)


def _text(ax: Axes, at: Point, label: str, offset: Point, **kwargs: Any) -> None:
    """A label whose centre is `offset` points from a point of the drawing."""
    kwargs = {"ha": "center", "va": "center", "fontsize": 9.5, "color": INK, **kwargs}
    if label:
        ax.annotate(
            label, _xy(at), xytext=_xy(offset), textcoords="offset points", zorder=9, **kwargs
        )


def _xy(point: Point) -> tuple[float, float]:
    return float(point[0]), float(point[1])
