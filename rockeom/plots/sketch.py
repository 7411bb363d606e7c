"""A sketch of a structure, to scale."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D

from rockeom.plots import style

if TYPE_CHECKING:
    from rockeom.numeric.structures import Structure

Place = Callable[[np.ndarray], np.ndarray]


@style.styled
def draw_structure(
    structure: Structure, *, rotation: float = 0.0, deformation: float = 0.0, ax: Axes | None = None
) -> Figure:
    """The masses, the feet and the ground of a shipped structure.

    rotation : at which it is drawn, clockwise, about the foot on the ground [rad].
    deformation : of a flexible column, to the right [m].
    ax : axes to draw in; those of a new figure if not given. Returns their figure.

    Raises ValueError for a structure without a known shape, such as one declared by a user.
    """
    values = structure.parameters()
    if "alpha" in values and "radius" in values:
        values["half_width"] = values["radius"] * math.sin(values["alpha"])
        values["height"] = values["radius"] * math.cos(values["alpha"])
    if not {"half_width", "height"} <= set(values):
        raise ValueError(
            f"{structure.model} has no half_width and height to draw; plot its response instead"
        )
    if ax is None:
        ax = style.new_figure(2.6, 3.4).add_subplot()
    b = values["half_width"]
    springs = "foundation_stiffness" in values
    pivot = 0.0 if springs else math.copysign(b, rotation)
    turn = Affine2D().rotate_around(pivot, 0.0, -rotation).transform
    if "base_mass" in values or "stiffness" in values:
        _lumped(ax, values, turn, deformation)
    else:
        _block(ax, values, turn)
    feet = turn(np.array([[-b, 0.0], [b, 0.0]]))
    depth = 0.35 * b if springs else 0.0
    for foot in feet:
        if springs:
            _spring(ax, foot, -depth)
        ax.plot(*foot, "o", color=style.INK, ms=4, zorder=4)
    _ground(ax, 1.9 * b, -depth, 0.09 * values["height"])
    ax.set_aspect("equal", adjustable="datalim")
    ax.axis("off")
    return style.parent_figure(ax)


def _block(ax: Axes, values: dict[str, float], turn: Place) -> None:
    b, h = values["half_width"], values["height"]
    corners = turn(np.array([[-b, 0.0], [b, 0.0], [b, 2 * h], [-b, 2 * h]]))
    ax.fill(*corners.T, facecolor="#dbe9f6", edgecolor=style.LINES[0], lw=1.2)
    _mass(ax, turn, (0.0, h), "")


def _lumped(ax: Axes, values: dict[str, float], turn: Place, deformation: float) -> None:
    """A base between the feet, a column, and the superstructure's mass; the base may have none."""
    b, h, low = values["half_width"], values["height"], values.get("base_height", 0.0)
    thick = max(2 * low, 0.04 * h)
    corners = turn(np.array([[-b, 0.0], [b, 0.0], [b, thick], [-b, thick]]))
    ax.fill(*corners.T, facecolor="#dbe9f6", edgecolor=style.LINES[0], lw=1.2)
    z = np.linspace(0.0, 1.0, 40)
    bent = deformation * z**2 * (3.0 - z) / 2.0  # a cantilever under a force at its end
    column = turn(np.column_stack([bent, thick + (h - thick) * z]))
    flexible = "stiffness" in values
    ax.plot(*column.T, color=style.LINES[0], lw=1.3 if flexible else 4.0, solid_capstyle="butt")
    _mass(ax, turn, (deformation, h), "mass", size=13)
    if "base_mass" in values:
        _mass(ax, turn, (0.0, low), "base")


def _mass(ax: Axes, turn: Place, at: tuple[float, float], name: str, size: float = 6.0) -> None:
    (point,) = turn(np.array([at]))
    ax.plot(*point, "o", color=style.LINES[1], mec=style.INK, mew=0.7, ms=size, zorder=5)
    ax.annotate(
        name, point, xytext=(5 + size / 2, 0), textcoords="offset points", va="center", fontsize=8
    )


def _spring(ax: Axes, foot: np.ndarray, bottom: float) -> None:
    """A zigzag from the foot, or from its place if it has lifted, down to the ground."""
    top = min(float(foot[1]), 0.0)
    t = np.linspace(0.0, 1.0, 10)
    sway = np.array([0, 0, 1, -1, 1, -1, 1, -1, 0, 0]) * 0.18 * abs(bottom)
    ax.plot(foot[0] + sway, bottom + (top - bottom) * t, color=style.INK, lw=1.0)


def _ground(ax: Axes, half: float, level: float, depth: float) -> None:
    ax.fill_between(
        [-half, half], level - depth, level, facecolor="0.92", hatch="////", ec="0.7", lw=0
    )
    ax.plot([-half, half], [level, level], color=style.INK, lw=1.2)
