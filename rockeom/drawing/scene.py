"""A structure in space, in parallel projection: bodies above the ground, shadows and feet.

Faces that look away are left out, the others are drawn from the farthest to the nearest, as light
as they face a lamp to the left of the viewer.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb

from rockeom.codes import IDLE_POINT, OPEN, SLIP_LEFT, SLIP_RIGHT
from rockeom.drawing import free_body, style
from rockeom.drawing.plan import hull_of
from rockeom.numbers.checks import InputError, array_of
from rockeom.structures.base import Structure
from rockeom.structures.positions import NO_FEET, legs, places, positions_of, rotations_of
from rockeom.structures.units import is_dimensionless

VIEW = (np.radians(-65.0), np.radians(22.0))
"""Azimuth and elevation of the viewer: x to the right, y to the back, z upwards."""
LOOKS = {
    "bears": {"marker": "o", "color": style.LINES[4], "ms": 6.5},
    "slides": {"marker": "o", "color": style.LINES[3], "ms": 6.5},
    "idle": {"marker": "o", "color": "white", "ms": 6.5},
    "open": {"marker": "o", "color": "0.55", "ms": 4.0},
}
"""Marks of feet, by what they do."""
_LAMP = np.array([-0.45, 0.65, 0.6])  # to the left, upwards, towards the viewer
_BODY = np.array(to_rgb("#d3e5f6"))
_SHADOW, _GROUND, _GRID = "0.80", "0.965", "0.88"
_HIDDEN = 0.35  # opacity of a foot behind a face
_TOUCHES = 1e-9  # a gap below this part of the size is rounding
_EDGE_ON = 1e-9  # a face that looks less at the viewer is not seen


class View(NamedTuple):
    """Directions to the right, upwards and towards the viewer, along x, y and z."""

    right: np.ndarray
    up: np.ndarray
    towards: np.ndarray

    def of(self, points: np.ndarray) -> np.ndarray:
        """(..., 2) where points (..., 3) are in the picture."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)


def view_from(view: Sequence[float]) -> View:
    """View from an azimuth and an elevation [rad]; raises InputError for others."""
    angles = array_of("view", view)
    if angles.shape != (2,) or not 0.0 <= angles[1] <= np.pi / 2:
        raise InputError("view", view).wrong(
            f"is {', '.join(f'{x:.4g}' for x in angles.flat)}: give the azimuth from which to look "
            "and the elevation, 0 to 1.57 [rad]"
        )
    (ca, ce), (sa, se) = np.cos(angles), np.sin(angles)
    right, towards = np.array([-sa, ca, 0.0]), np.array([ce * ca, ce * sa, se])
    return View(right, np.cross(towards, right), towards)


class Scene:
    """A drawing of a structure in space in a state (N,) and the mode of that number.

    view : azimuth and elevation of the viewer [rad]. ground (2, 2) : least and greatest x and y of
    the ground that is drawn; that under the structure if not given.
    """

    def __init__(
        self,
        structure: Structure,
        y: np.ndarray,
        mode: int,
        view: Sequence[float] = VIEW,
        ground: np.ndarray | None = None,
    ) -> None:
        m = structure.module
        self.structure, self.view = structure, view_from(view)
        (pose,) = places(m, np.array([mode]), y[None], structure.vector)
        self.places, self.rotations = positions_of(m, pose), rotations_of(m, pose)
        self.kinds = dict(zip(m.POSITIONS, m.POSITION_KINDS, strict=True))
        self.legs = [(m.POSITIONS[i], m.POSITIONS[j]) for i, j in legs(structure, mode, y)]
        self.points = corners(structure, pose[None])[0]
        self.ground = ground_under(self.points) if ground is None else ground
        self.feet = {
            name: self._work(name, mode)
            for name, kind in self.kinds.items()
            if kind not in NO_FEET or kind == "massless"  # that of a rim, where it is
        }

    @property
    def closed_feet(self) -> list[str]:
        """Feet that touch the ground."""
        return [name for name, work in self.feet.items() if work != "open"]

    def feet_at(self, name: str) -> np.ndarray:
        """(1, 2) where a foot is in the picture."""
        return self.view.of(self.places[name])[None]

    def draw(self, ax: Axes, slope: float = 0.0) -> None:
        """Draw it; slope : of the ground, which is level in space."""
        if slope:
            raise InputError("slope", slope).says("ground in space is level: leave the slope out")
        self._floor(ax)
        self._faces(ax)
        for name in self.rotations:
            if name not in self.structure.solids and self.kinds[name] != "massless":
                self._frame(ax, name)
        for name, work in self.feet.items():
            (at,), opacity = self.feet_at(name), _HIDDEN if self._is_hidden(name) else 1.0
            ax.plot(*at, mec=style.INK, mew=0.8, alpha=opacity, zorder=6, ls="", **LOOKS[work])  # type: ignore[arg-type]
        ax.autoscale_view()

    def _work(self, foot: str, mode: int) -> str:
        """The word of `LOOKS` for a foot in a mode."""
        if foot in getattr(self.structure.module, "POINTS", ()):
            return work_of(self.structure.module, foot, mode)
        above = self.places[foot][2] / np.ptp(self.points, axis=0).max()
        return "bears" if above < _TOUCHES else "open"

    # -- bodies

    def _faces(self, ax: Axes) -> None:
        """All faces that look at the viewer, and their edges, the nearest last."""
        polygons: list[np.ndarray] = []
        depths, fills, strokes = [np.empty(0)], [np.empty((0, 3))], [np.empty((0, 3))]
        for name, solid in self.structure.solids.items():
            flat, _, normals = self._seen(name)
            lit = normals @ self.view.towards > _EDGE_ON
            far = (self.places[name] + solid.centres @ self.rotations[name].T) @ self.view.towards
            shade = _BODY * self._shades(normals)[:, None]
            ends, of, sharp = solid.edges
            drawn = lit[of].any(axis=1) & (sharp | ~lit[of].all(axis=1))
            polygons += [*flat[solid.faces[lit]], *flat[ends[drawn]]]
            depths += [far[lit], np.where(lit[of], far[of], -np.inf).max(axis=1)[drawn]]
            ink = np.full((int(drawn.sum()), 3), float(style.INK))
            fills += [shade[lit], ink]
            strokes += [shade[lit], ink]
        order = np.argsort(np.concatenate(depths), kind="stable")
        faces = PolyCollection(
            [polygons[i] for i in order], facecolors=np.vstack(fills)[order],
            edgecolors=np.vstack(strokes)[order], linewidths=0.7, joinstyle="round", zorder=4,
        )  # fmt: skip
        ax.add_collection(faces)

    def _seen(self, body: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Vertices (n, 2) of a body in the picture, how near they are (n,), normals (m, 3)."""
        solid = self.structure.solids[body]
        vertices = self._vertices(body)
        normals = solid.normals @ self.rotations[body].T
        return self.view.of(vertices), vertices @ self.view.towards, normals

    def _shades(self, normals: np.ndarray) -> np.ndarray:
        """(m,) lightness of faces."""
        lamp = _LAMP @ np.array(self.view) / np.linalg.norm(_LAMP)
        return 0.74 + 0.26 * np.clip(normals @ lamp, 0.0, 1.0)

    def _vertices(self, body: str) -> np.ndarray:
        """(n, 3) places of the vertices of a body; of its feet and centroid where it has none."""
        if body in self.structure.solids:
            solid = self.structure.solids[body]
            return solid.vertices @ self.rotations[body].T + self.places[body]
        feet = [self.places[foot] for owner, foot in self.legs if owner == body]
        if not feet:  # where its axis meets the ground
            axis = self.rotations[body][:, 2]
            feet = [self.places[body] - axis * self.places[body][2] / max(axis[2], 0.1)]
        return np.array([*feet, self.places[body]])

    def _frame(self, ax: Axes, body: str) -> None:
        """A body of no known shape: the plate between its feet, its legs and its centroid."""
        *feet, centre = self.view.of(self._vertices(body))
        for foot in feet:
            ax.plot(*np.transpose([centre, foot]), color=style.LINES[0], lw=1.8, zorder=4.5)
        plate = np.array(feet)[hull_of(np.array(feet))].T
        ax.fill(*plate, fc=free_body.BODY, ec=style.LINES[0], alpha=0.85, lw=1.0, zorder=4)
        free_body.mass(ax, centre, size=11.0)

    def _is_hidden(self, foot: str) -> bool:
        """Whether a face is before a foot."""
        (at,), depth = self.feet_at(foot), self.places[foot] @ self.view.towards
        margin = 1e-6 * np.ptp(self.points, axis=0).max()
        for name, solid in self.structure.solids.items():
            flat, near, normals = self._seen(name)
            facing = normals @ self.view.towards
            faces = solid.faces[facing > _EDGE_ON]
            # of the plane of a face at the foot
            slopes = (normals @ np.array([self.view.right, self.view.up]).T)[facing > _EDGE_ON]
            away = np.einsum("ij,ij->i", flat[faces[:, 0]] - at, slopes)
            before = near[faces[:, 0]] + away / facing[facing > _EDGE_ON] - depth
            (x, y), (dx, dy) = (at - flat[faces]).T, (np.roll(flat[faces], -1, 1) - flat[faces]).T
            if ((dx * y >= dy * x).all(axis=0) & (before > margin)).any():
                return True
        return False

    # -- the ground

    def _floor(self, ax: Axes) -> None:
        """The ground with its grid, the shadows of bodies, and the axes."""
        (left, near), (right, far) = self.ground
        ring = ring_of(self.ground)[:, :2]
        ax.fill(*self._level(ring).T, fc=_GROUND, ec=_GRID, lw=0.8, zorder=1)
        step = _step(max(right - left, far - near))
        lines = [
            *([(x, near), (x, far)] for x in _multiples(step, left, right)),
            *([(left, y), (right, y)] for y in _multiples(step, near, far)),
        ]
        ax.add_collection(
            LineCollection(
                [self._level(np.array(ends)) for ends in lines], colors=_GRID, lw=0.6, zorder=1.5
            )
        )
        for name in self.rotations:
            plan = self._vertices(name)[:, :2]
            ax.fill(*self._level(plan[hull_of(plan)]).T, fc=_SHADOW, lw=0, zorder=2)
        self._axes(ax, ring, step)

    def _axes(self, ax: Axes, ring: np.ndarray, step: float) -> None:
        """Arrows along x, y and z, and the width of the grid, at corners of the ground."""
        flat = self._level(ring)
        corner = np.append(ring[flat[:, 0].argmin()], 0.0)
        start = self.view.of(corner)
        for name, way in zip("xyz", np.eye(3), strict=True):
            along = self.view.of(way)
            if (size := np.hypot(*along)) > 0.1:
                tip = start + 0.3 * np.ptp(ring, axis=0).max() * along
                free_body.arrow(ax, start, tip, name, color=style.INK, offset=7 * along / size)
        unit = "" if is_dimensionless(self.structure.module) else " m"
        x, y = flat[flat[:, 1].argmin()].tolist()
        ax.annotate(
            f"grid {style.digits(step)}{unit}", (x, y), xytext=(0, -7),
            textcoords="offset points", fontsize=7.5, color="0.45", ha="center", va="center",
        )  # fmt: skip

    def _level(self, plan: np.ndarray) -> np.ndarray:
        """(n, 2) where places on the ground (n, 2) are in the picture."""
        return plan @ np.array([self.view.right[:2], self.view.up[:2]]).T


def ring_of(ground: np.ndarray) -> np.ndarray:
    """(4, 3) corners of the ground between the least and the greatest x and y, (2, 2)."""
    (left, near), (right, far) = ground
    return np.array([(left, near, 0), (right, near, 0), (right, far, 0), (left, far, 0)])


def corners(structure: Structure, poses: np.ndarray) -> np.ndarray:
    """(n, k, 3) places, those below on the ground, and corners of the boxes around bodies.

    poses (n, m, k) : of `places`.
    """
    m, points = structure.module, [poses[..., :3], poses[..., :3] * [1.0, 1.0, 0.0]]
    at, turns = positions_of(m, poses), rotations_of(m, poses)
    for name, solid in structure.solids.items():
        ends = np.array([solid.vertices.min(axis=0), solid.vertices.max(axis=0)])
        box = np.array([[ends[i, 0], ends[j, 1], ends[k, 2]] for i, j, k in np.ndindex(2, 2, 2)])
        points.append(np.einsum("nij,kj->nki", turns[name], box) + at[name][:, None])
    return np.concatenate(points, axis=1)


def ground_under(points: np.ndarray) -> np.ndarray:
    """(2, 2) least and greatest x and y of the ground under points (..., 3), and a way beyond."""
    plan = points.reshape(-1, points.shape[-1])
    low, high = plan[:, :2].min(axis=0), plan[:, :2].max(axis=0)
    size = float(np.ptp(plan, axis=0).max()) or 1.0
    beyond = max(0.35 * (high - low).max(), 0.15 * size)
    return np.array([low - beyond, high + beyond])


def work_of(module: Any, foot: str, mode: int) -> str:
    """The word of `LOOKS` for a point in a mode."""
    state = module.POINT_STATES[mode][module.POINTS.index(foot)]
    works = {OPEN: "open", IDLE_POINT: "idle", SLIP_LEFT: "slides", SLIP_RIGHT: "slides"}
    return works.get(state, "bears")


def _step(size: float) -> float:
    """Width of a grid on a ground of a size: 1, 2 or 5 times a power of ten."""
    tenth = 10.0 ** np.floor(np.log10(size / 4))
    return float(tenth * max(n for n in (1, 2, 5) if n * tenth <= size / 4))


def _multiples(step: float, low: float, high: float) -> np.ndarray:
    return step * np.arange(np.ceil(low / step), np.floor(high / step) + 1)
