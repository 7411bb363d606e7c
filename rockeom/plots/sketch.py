"""A sketch of a structure, to scale."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D

from rockeom.plots import free_body, style

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
    if "tendon_stiffness" in values:
        _wall(ax, values, turn)
    elif "base_mass" in values or "stiffness" in values:
        _lumped(ax, values, turn, deformation)
    else:
        _block(ax, values, turn)
    feet = turn(np.array([[-b, 0.0], [b, 0.0]]))
    depth = 0.35 * b if springs else 0.0
    for foot in feet:
        if springs:  # from the foot, or from its place if it has lifted
            top = min(float(foot[1]), 0.0)
            free_body.spring(ax, (foot[0], top), (foot[0], -depth), 0.36 * depth)
        ax.plot(*foot, "o", color=style.INK, ms=4, zorder=4)
    free_body.ground(ax, -1.9 * b, 1.9 * b, -depth, 0.09 * values["height"])
    ax.set_aspect("equal", adjustable="datalim")
    ax.axis("off")
    return style.parent_figure(ax)


def _block(ax: Axes, values: dict[str, float], turn: Place) -> None:
    b, h = values["half_width"], values["height"]
    free_body.body(ax, turn(np.array([[-b, 0.0], [b, 0.0], [b, 2 * h], [-b, 2 * h]])))
    _mass(ax, turn, (0.0, h), "", 6)


def _wall(ax: Axes, values: dict[str, float], turn: Place) -> None:
    """A wall up to the point whose displacement counts, and its tendon."""
    b, h, e = values["half_width"], values["height"], values["eccentricity"]
    free_body.body(ax, turn(np.array([[-b, 0.0], [b, 0.0], [b, h], [-b, h]])))
    ((x, y),) = turn(np.array([[e, h]]))
    ax.plot([e, x], [0.0, y], color=style.INK, lw=1.6)
    _mass(ax, turn, (0.0, values.get("centroid_height", h)), "", 6)


def _lumped(ax: Axes, values: dict[str, float], turn: Place, deformation: float) -> None:
    """A base between the feet, a column, and the superstructure's mass; the base may have none."""
    b, h, low = values["half_width"], values["height"], values.get("base_height", 0.0)
    thick = max(2 * low, 0.04 * h)
    corners = turn(np.array([[-b, 0.0], [b, 0.0], [b, thick], [-b, thick]]))
    free_body.body(ax, corners)
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
    free_body.mass(ax, point, name, (5 + size / 2, 0), size)
