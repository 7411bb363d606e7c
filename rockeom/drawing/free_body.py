"""Pieces of a free-body diagram: the body, the ground, forces, angles and dimension lines.

Each function draws one piece in the axes it is given. Points are (x, y) in the units of the axes,
angles of rotation are clockwise [rad], and an offset of a label is in points of type (1/72 in),
so that it does not depend on the scale of the drawing.

    figure, ax = plt.subplots()
    free_body.bare(ax)
    free_body.ground(ax, -1.0, 1.0)
    corners = free_body.turned([(-0.3, 0), (0.3, 0), (0.3, 1.6), (-0.3, 1.6)], (0.3, 0.0), 0.2)
    free_body.body(ax, corners)
    free_body.pivot(ax, (0.3, 0.0), "O")
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.path import Path
from numpy.typing import ArrayLike

from rockeom.drawing.style import INK, LINES
from rockeom.numbers.checks import InputError, require

Point = Sequence[float] | np.ndarray

BODY = "#dbe9f6"
"""Colour of a body's face."""
FORCE, MOTION = LINES[1], LINES[2]
"""Colours of a force, and of a velocity or an acceleration."""


def bare(ax: Axes) -> None:
    """Equal scales in both directions, and no frame: axes for a drawing."""
    ax.set_aspect("equal")
    ax.axis("off")


def turned(points: ArrayLike, about: Point, angle: float) -> np.ndarray:
    """(n, 2) points turned clockwise through `angle` about a point."""
    cos, sin = np.cos(angle), np.sin(angle)
    away = np.atleast_2d(np.asarray(points, float)) - np.asarray(about, float)
    return np.asarray(about) + away @ np.array([[cos, -sin], [sin, cos]])


# --- bodies and supports


def body(ax: Axes, corners: ArrayLike, *, faint: bool = False) -> None:
    """A rigid body with these corners (n, 2); a faint one is where the body was before."""
    x, y = np.asarray(corners, float).T
    if faint:
        ax.fill(x, y, facecolor="none", edgecolor="0.6", lw=0.9, ls=(0, (5, 3)))
    else:
        ax.fill(x, y, facecolor=BODY, edgecolor=LINES[0], lw=1.2)


def ground(
    ax: Axes, left: float, right: float, level: float = 0.0, depth: float | None = None
) -> None:
    """The ground from `left` to `right`, hatched below; `depth` is 1/15 of its width by default."""
    depth = (right - left) / 15 if depth is None else depth
    ax.fill_between(
        [left, right], level - depth, level, facecolor="0.92", hatch="////", ec="0.7", lw=0
    )
    ax.plot([left, right], [level, level], color=INK, lw=1.2)


def spring(ax: Axes, start: Point, end: Point, width: float, *, coils: int = 4) -> None:
    """A zigzag from one point to another, `width` across. Raises ValueError if they coincide."""
    along = np.concatenate([[0.0], np.linspace(0.15, 0.85, 2 * coils + 1), [1.0]])
    across = np.zeros_like(along)
    across[2:-2] = width / 2 * (-1.0) ** np.arange(2 * coils - 1)
    ax.plot(*_along(start, end, along, across).T, color=INK, lw=1.0)


def damper(ax: Axes, start: Point, end: Point, width: float) -> None:
    """A dashpot from one point to another, `width` across. Raises ValueError if they coincide."""
    half = width / 2
    cup = ([0.0, 0.35, 0.35, 0.7, 0.35, 0.35, 0.7], [0.0, 0.0, half, half, half, -half, -half])
    piston = ([0.55, 0.55, 0.55, 1.0], [0.7 * half, -0.7 * half, 0.0, 0.0])
    for along, across in (cup, piston):
        ax.plot(*_along(start, end, np.array(along), np.array(across)).T, color=INK, lw=1.0)


def wall(ax: Axes, low: float, high: float, at: float, depth: float) -> None:
    """A wall from `low` to `high` at the place `at`, hatched behind; to the left if depth < 0."""
    ax.fill_betweenx([low, high], at, at + depth, facecolor="0.92", hatch="////", ec="0.7", lw=0)
    ax.plot([at, at], [low, high], color=INK, lw=1.2)


def pivot(ax: Axes, at: Point, label: str = "", offset: Point = (0, -11)) -> None:
    """A point about which the body turns."""
    ax.plot(*at, "o", color="white", mec=INK, mew=1.2, ms=5.5, zorder=6)
    _text(ax, at, label, offset)


def mass(ax: Axes, at: Point, label: str = "", offset: Point = (10, 0), size: float = 10.0) -> None:
    """A lumped mass; `size` is its diameter in points."""
    ax.plot(*at, "o", color=LINES[1], mec=INK, mew=0.7, ms=size, zorder=5)
    _text(ax, at, label, offset, ha="left")


def centroid(ax: Axes, at: Point, label: str = "", offset: Point = (9, 6)) -> None:
    """A centre of mass: a disc with two black quarters."""
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
    """A force, or with `color=MOTION` a velocity or an acceleration, from `tail` to `tip`.

    label_at : "tip", "tail" or "middle"; the label's centre is `offset` away from there.
    Raises ValueError for any other place.
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
    """The angle at `vertex` from the direction of one point to that of another, the smaller one.

    sense : end in an arrow at `second`, as for a rotation or a couple.
    label_radius : where the label stands on the bisector, as a multiple of `radius`.
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
    """A dimension line between two points, moved by `shift` to the left of its direction.

    Raises ValueError if they coincide.
    """
    ends = _along(start, end, np.array([0.0, 1.0]), np.array([shift, shift]))
    for point, moved in zip((start, end), ends, strict=True):
        ax.plot(*np.transpose([point, moved]), color="0.6", lw=0.6)
    style = _arrow("<|-|>,head_width=0.15,head_length=0.4", INK, 0.8)
    ax.annotate("", ends[1], ends[0], arrowprops=style)
    _text(ax, ends.mean(axis=0), label, offset)


def line(ax: Axes, start: Point, end: Point) -> None:
    """A thin dashed line of reference, such as the vertical through a pivot."""
    ax.plot(*np.transpose([start, end]), color="0.45", lw=0.8, ls=(0, (6, 3)))


def _arrow(style: str, color: str, width: float) -> dict[str, Any]:
    """An arrow from its one end to the other, as `annotate` takes it."""
    return {"arrowstyle": style, "color": color, "lw": width, "shrinkA": 0, "shrinkB": 0}


def _along(start: Point, end: Point, along: np.ndarray, across: np.ndarray) -> np.ndarray:
    """(n, 2) points at parts `along` of the way, moved by `across` to the left of it."""
    origin = np.asarray(start, float)
    way = np.asarray(end, float) - origin
    length = float(np.hypot(*way))
    if length == 0.0:
        raise InputError("end", tuple(origin)).so("start is the same point: nothing to draw")
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
