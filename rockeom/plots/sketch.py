"""A sketch of a structure, to scale."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from itertools import pairwise
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
    """The masses, the feet and the ground of a structure.

    rotation : at which it is drawn, clockwise, about the foot on the ground [rad].
    deformation : of a flexible column, to the right [m].
    ax : axes to draw in; those of a new figure if not given. Returns their figure.

    Raises ValueError for a structure without a known shape, such as one declared by a user.
    """
    values = structure.parameters()
    if "alpha" in values and "radius" in values:
        values["half_width"] = values["radius"] * math.sin(values["alpha"])
        values["height"] = values["radius"] * math.cos(values["alpha"])
    floors = [values[name] for name in _numbered("height", values)]
    if floors:
        values["height"] = floors[-1]
    columns = {"columns", "half_height"} <= set(values)
    if columns:
        values["height"] = values["half_height"]
    if not {"half_width", "height"} <= set(values):
        raise ValueError(
            f"{structure.model} has no half_width and height to draw; plot its response instead"
        )
    if ax is None:
        ax = style.new_figure(2.6, 3.4).add_subplot()
    b = values["half_width"]
    springs = "foundation_stiffness" in values
    beside = {"frame_mass", "link_height"} <= set(values)
    pivot = 0.0 if springs else math.copysign(b, rotation)
    turn = Affine2D().rotate_around(pivot, 0.0, -rotation).transform
    if columns:
        _columns_and_beam(ax, values, rotation)
        return style.parent_figure(ax)
    if "tendon_stiffness" in values:
        _wall(ax, values, turn)
    elif floors:
        _storeys(ax, values, floors, turn, deformation)
    elif beside:
        _block(ax, values, turn)
        _frame_beside(ax, values, turn, deformation)
    elif "base_mass" in values or "stiffness" in values:
        _lumped(ax, values, turn, deformation)
    else:
        _block(ax, values, turn)
    depth = 0.35 * b if springs else 0.0
    number = getattr(getattr(structure, "support", None), "springs", 2)
    for x in np.linspace(-b, b, number if springs else 2):
        ((x, y),) = turn(np.array([[x, 0.0]]))
        if springs:  # from the sole, or from its place if it has lifted
            free_body.spring(ax, (x, min(y, 0.0)), (x, -depth), 0.36 * depth)
        ax.plot(x, y, "o", color=style.INK, ms=4, zorder=4)
    _on_ground(ax, -1.9 * b, (4.4 if beside else 1.9) * b, depth, values)
    return style.parent_figure(ax)


def _on_ground(ax: Axes, left: float, right: float, depth: float, values: dict[str, float]) -> None:
    free_body.ground(ax, left, right, -depth, 0.09 * values["height"])
    ax.set_aspect("equal", adjustable="datalim")
    ax.axis("off")


def _numbered(name: str, values: dict[str, float]) -> list[str]:
    """name_1, name_2, ..., as many as there are."""
    found = itertools.takewhile(values.__contains__, (f"{name}_{i}" for i in itertools.count(1)))
    return list(found)


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


def _storeys(
    ax: Axes, values: dict[str, float], floors: list[float], turn: Place, deformation: float
) -> None:
    """A base, columns at its edges and floors between them; the deformation is of the top floor."""
    b, thick = values["half_width"], 0.02 * floors[-1]
    low = max(2 * values.get("base_height", 0.0), thick)
    free_body.body(ax, turn(np.array([[-b, 0.0], [b, 0.0], [b, low], [-b, low]])))
    levels = np.array([low, *floors])
    moved = deformation * (levels - low) / (levels[-1] - low)
    for side in (-0.85 * b, 0.85 * b):
        z = np.linspace(0.0, 1.0, 20)
        bent = z**2 * (3.0 - 2.0 * z)  # a column between floors that stay parallel
        for (x0, x1), (y0, y1) in zip(pairwise(moved), pairwise(levels), strict=True):
            column = turn(np.column_stack([side + x0 + (x1 - x0) * bent, y0 + (y1 - y0) * z]))
            ax.plot(*column.T, color=style.LINES[0], lw=1.3, solid_capstyle="butt")
    for x, y in zip(moved[1:], levels[1:], strict=True):
        corners = [[-b, -thick], [b, -thick], [b, thick], [-b, thick]]
        free_body.body(ax, turn(np.add(corners, (x, y))))
        _mass(ax, turn, (x, y), "", 9)


def _frame_beside(ax: Axes, values: dict[str, float], turn: Place, deformation: float) -> None:
    """A frame on columns of its own to the right of the wall, and the link between them."""
    b, h = values["half_width"], values["link_height"]
    floor = (3.2 * b + deformation, h)
    for foot in (2.5 * b, 3.9 * b):
        z = np.linspace(0.0, 1.0, 40)
        bent = foot + deformation * z**2 * (3.0 - 2.0 * z)
        ax.plot(bent, h * z, color=style.LINES[0], lw=1.3, solid_capstyle="butt")
        ax.plot(foot, 0.0, "s", color=style.INK, ms=4, zorder=4)
    ax.plot([floor[0] - 0.8 * b, floor[0] + 0.8 * b], [h, h], color=style.INK, lw=2.4)
    ((x, y),) = turn(np.array([[0.0, h]]))
    ax.plot(x, y, "o", color="white", mec=style.INK, ms=5, zorder=6)
    free_body.spring(ax, (x, y), (floor[0] - 0.8 * b, y), 0.3 * b)
    free_body.mass(ax, floor, "frame", (0, 8), 11)


_MOST_COLUMNS = 6  # that are drawn


def _columns_and_beam(ax: Axes, values: dict[str, float], rotation: float) -> None:
    """Columns side by side, each about a foot of its own, and the beam that rides on them."""
    b, h = values["half_width"], values["half_height"]
    number = min(int(values["columns"]), _MOST_COLUMNS)
    apart = max(6 * b, 1.2 * h)
    places = apart * (np.arange(number) - (number - 1) / 2)
    side = math.copysign(1.0, rotation)
    corners = np.array([[-b, 0.0], [b, 0.0], [b, 2 * h], [-b, 2 * h]])
    for place in places:
        turn = Affine2D().rotate_around(side * b, 0.0, -rotation).transform
        column = np.add(turn(corners), (place, 0.0))
        free_body.body(ax, column)
        for foot in column[:2]:
            ax.plot(*foot, "o", color=style.INK, ms=4, zorder=4)
    # it stands on the corner opposite the pressed foot, which was at -side*b
    ((x, y),) = turn(np.array([[-side * b, 2 * h]]))
    x += side * b
    end, thick = places[-1] + 2 * b, 0.25 * h
    beam = [[-end, 0.0], [end, 0.0], [end, thick], [-end, thick]]
    free_body.body(ax, np.add(beam, (x, y)))
    free_body.mass(ax, (x, y + thick / 2), "beam", (9, 6), 11)
    _on_ground(ax, -end - b, end + b, 0.0, values)


def _mass(ax: Axes, turn: Place, at: tuple[float, float], name: str, size: float = 6.0) -> None:
    (point,) = turn(np.array([at]))
    free_body.mass(ax, point, name, (5 + size / 2, 0), size)
