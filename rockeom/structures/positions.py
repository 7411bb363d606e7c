"""Places of the bodies and feet of a structure, and of the parts that a sketch shows.

A generated module tells both; here they get their names. Places are (x, y) in axes that move with
the ground, x to the right and y upwards, from the origin of the declaration; in space (x, y, z), z
upwards.

A body with tilt t stands on the foot that reaches farthest in the direction d of its lean, seen
along its own axes. Its centroid, a height h above the feet, is then

    h cos t + s(d) sin t,    s(d) = max over the feet of x cos d + y sin d,

above the ground: highest at tan t = s(d)/h. These tilts are the stability surface; of a prism with
half lengths b and c, s = b |cos d| + c |sin d|. The saddle, its lowest place, is over the edge
nearest to the centroid: a body that leans over a corner may still fall over that edge.
"""

import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.integrator.schema import ground_axes, in_space

BODIES = ("body", "massless")
"""Kinds of what turns: the places of all others are points."""
NO_FEET = ("load", "tendon", "damper", "push", "end", *BODIES)
"""Kinds of what is no contact and no spring under the structure."""
_SIDES = 48  # of the polygon that is drawn for a circle
_CREASE, _CREASE_OF_MANY = np.cos(np.radians([30.0, 70.0]))
"""Edges between faces that differ by more are drawn; the second is of surfaces of many faces."""
_MANY = 300


class Member(NamedTuple):
    """A member between two bodies, a body and the "ground", or the two ends of an element.

    kind : "column", "cantilever", "rod", "tendon", "spring", "damper" or "wall". start_at, end_at
    (2,) : where it ends, from the centre of the body in axes that turn with it; on the ground from
    the origin [m].
    """

    kind: str
    start: str
    end: str
    start_at: np.ndarray
    end_at: np.ndarray


class Copies(NamedTuple):
    """How a body that represents several is drawn.

    Parameters
    ----------
    number : int
        Number of bodies, side by side.
    apart : float
        Distance between them in the sketch [m].
    """

    number: int
    apart: float


class Shapes(NamedTuple):
    """Outlines and members of a structure, as it was declared, for sketches.

    Parameters
    ----------
    outlines : dict of str to ndarray
        Corners (k, 2) of each body that has a size, by name, from its centre in axes that turn with
        it [m].
    members : tuple of Member
        Lines that join bodies.
    copies : dict of str to Copies
        Copies of bodies that represent several.
    """

    outlines: dict[str, np.ndarray]
    members: tuple[Member, ...]
    copies: dict[str, Copies]


@dataclass(frozen=True, eq=False)
class Solid:
    """Surface of a body in space, of which pictures are drawn; `Structure.solids` has them.

    A class says by the name of each body what it looks like::

        @functools.cached_property
        def solids(self) -> dict[str, Solid]:
            return {"column": cylinder(self.radius, self.height)}

    Parameters
    ----------
    vertices : ndarray
        Places (n, 3) from the centroid, along axes that turn with the body [m].
    faces : ndarray
        Vertices of each face (m, k), by number and counter-clockwise seen from outside; the last
        one stands again and again where a face has fewer than k.
    """

    vertices: np.ndarray
    faces: np.ndarray

    @functools.cached_property
    def normals(self) -> np.ndarray:
        """(m, 3) unit normals outward."""
        corners = self.vertices[self.faces]
        areas = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1)
        lengths = np.linalg.norm(areas, axis=1, keepdims=True)
        return areas / np.where(lengths > 0.0, lengths, 1.0)

    @functools.cached_property
    def centres(self) -> np.ndarray:
        """(m, 3) means of the corners."""
        once = np.diff(self.faces, axis=1, prepend=-1)[..., None] != 0
        return (self.vertices[self.faces] * once).sum(axis=1) / once.sum(axis=1)

    @functools.cached_property
    def edges(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Vertices (e, 2) and faces (e, 2) of each edge, and whether it is a crease (e,)."""
        ends = np.stack([self.faces, np.roll(self.faces, -1, axis=1)], axis=-1).reshape(-1, 2)
        owners = np.repeat(np.arange(len(self.faces)), self.faces.shape[1])
        proper = ends[:, 0] != ends[:, 1]
        ends, owners = np.sort(ends[proper], axis=1), owners[proper]
        order = np.lexsort(ends.T)
        ends, owners = ends[order], owners[order]
        (first,) = np.nonzero(np.append(True, (ends[1:] != ends[:-1]).any(axis=1)))
        last = np.append(first[1:], len(ends)) - 1
        of = np.column_stack([owners[first], owners[last]])
        turns = np.einsum("ij,ij->i", self.normals[of[:, 0]], self.normals[of[:, 1]])
        crease = _CREASE if len(self.faces) < _MANY else _CREASE_OF_MANY
        return ends[first], of, (turns < crease) | (first == last)


def solid(vertices: ArrayLike, faces: Sequence[Sequence[int]]) -> Solid:
    """Surface whose faces may have different numbers of vertices.

    Parameters
    ----------
    vertices : array_like
        Places (n, 3) from the centroid, along axes that turn with the body [m].
    faces : sequence of sequence of int
        Vertices of each face, by number and counter-clockwise seen from outside.

    Returns
    -------
    Solid
        Surface.
    """
    most = max(map(len, faces))
    rows = np.array([[*face, *[face[-1]] * (most - len(face))] for face in faces])
    places = np.asarray(vertices)
    return Solid(places if places.dtype == object else places.astype(float), rows)


def box(width: float, depth: float, height: float, centre: Sequence[float] = (0, 0, 0)) -> Solid:
    """Box; centre : its middle, from the centroid of the body [m]."""
    half, middle = np.array([width, depth, height]) / 2, np.array(centre)
    signs = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    base = middle + half * [(*xy, -1) for xy in signs]
    return prismatic(base, middle + half * [(*xy, 1) for xy in signs])


def cylinder(
    radius: float,
    height: float,
    top_radius: float | None = None,
    centroid_height: float | None = None,
) -> Solid:
    """Round column, or a frustum of one; half of the height if no height of the centroid is."""
    at = 2 * np.pi * np.arange(_SIDES) / _SIDES
    below = height / 2 if centroid_height is None else centroid_height
    ring = np.column_stack([np.cos(at), np.sin(at), 0 * at])
    top = radius if top_radius is None else top_radius
    return prismatic(radius * ring - [0, 0, below], top * ring + [0, 0, height - below])


def prismatic(base: np.ndarray, top: np.ndarray) -> Solid:
    """Surface between two polygons (n, 3) of as many corners, counter-clockwise from above."""
    n = len(base)
    sides = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    return solid(
        np.vstack([base, top]), [*sides, tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n))]
    )


def size_of_place(module: Any) -> int:
    """Numbers of a place: x, y and the angle; in space x, y, z and the matrix of the rotation."""
    return 12 if in_space(module) else 3


def places(module: Any, modes: np.ndarray, states: np.ndarray, p: np.ndarray) -> np.ndarray:
    """(n, m, k) places and rotations of POSITIONS, in states (n, N) of modes (n,)."""
    size = size_of_place(module)
    out = np.empty((len(states), size * len(module.POSITIONS)))
    for mode, y, row in zip(modes.tolist(), states.tolist(), out, strict=True):
        module.positions(mode, y, p, row)
    return out.reshape(len(states), -1, size)


def positions_of(module: Any, poses: np.ndarray) -> dict[str, np.ndarray]:
    """Places (..., 2), in space (..., 3), by name, of the values (..., m, k) of `places`."""
    axes = len(ground_axes(module))
    return {name: poses[..., i, :axes] for i, name in enumerate(module.POSITIONS)}


def rotations_of(module: Any, poses: np.ndarray) -> dict[str, np.ndarray]:
    """Rotations of the bodies, by name, (...); in space their matrices (..., 3, 3)."""
    kinds = zip(module.POSITIONS, module.POSITION_KINDS, strict=True)
    bodies = {name: poses[..., i, :] for i, (name, kind) in enumerate(kinds) if kind in BODIES}
    if in_space(module):
        return {name: of[..., 3:].reshape(*of.shape[:-1], 3, 3) for name, of in bodies.items()}
    return {name: of[..., 2] for name, of in bodies.items()}


def legs(structure: Any, mode: int, y: np.ndarray) -> list[tuple[int, int]]:
    """Bodies without an outline or a member, each with the feet at which a drawing joins them.

    Places among the positions. A foot belongs to a body from which its distance stays where all
    coordinates move.
    """
    m, drawn, pairs = structure.module, structure.shapes, []
    joined = {name for member in drawn.members for name in (member.start, member.end)}
    moved = np.array([y, y + 0.01 * np.arange(1, len(y) + 1)])
    at = places(m, np.array([mode, mode]), moved, structure.vector)[..., : len(ground_axes(m))]
    for i, j in np.ndindex(len(m.POSITIONS), len(m.POSITIONS)):
        body, lengths = m.POSITIONS[i], np.hypot.reduce(at[:, i] - at[:, j], axis=1)
        alone = m.POSITION_KINDS[i] in BODIES and body not in {*joined, *drawn.outlines}
        foot = m.POSITION_KINDS[j] not in NO_FEET
        if alone and foot and abs(lengths[1] - lengths[0]) <= 1e-9 * lengths[0]:
            pairs.append((i, j))
    return pairs


def shapes(module: Any, p: np.ndarray) -> Shapes:
    """Outlines and members of a structure with parameters and constants p."""
    corners, ends = len(module.CORNERS), len(module.MEMBER_ENDS)
    out = np.empty(2 * (corners + ends + len(module.COPIES)))
    module.shapes(p, out)
    points = out.reshape(-1, 2)
    owners = np.array(module.CORNERS, dtype=str)
    at = points[corners : corners + ends]
    names = module.MEMBER_ENDS
    return Shapes(
        {name: points[:corners][owners == name] for name in dict.fromkeys(module.CORNERS)},
        tuple(
            Member(kind, names[2 * i], names[2 * i + 1], at[2 * i], at[2 * i + 1])
            for i, kind in enumerate(module.MEMBERS)
        ),
        {
            name: Copies(round(number), float(apart))
            for name, (number, apart) in zip(module.COPIES, points[corners + ends :], strict=True)
        },
    )


# -- the lean of bodies in space -------------------------------------------------------------------

LEVEL = 1e-9
"""Relative to the height of the centroid: feet that differ less are level."""


TILT, DIRECTION, RESERVE = "tilt", "tilt_direction", "reserve"
"""Names of the quantities of a body: behind its own where there are several."""


class Lean(NamedTuple):
    """How a body leans, numbers or (n,): angles [rad].

    tilt : of its axis from the vertical. azimuth : to which it leans, from x of the ground.
    direction : the same along the axes of the body.
    """

    tilt: Any
    azimuth: Any
    direction: Any


def lean_of(r: Any) -> Lean:
    """The lean of a body by the nine entries, numbers or arrays, of its rotation, row by row."""
    tilt = np.arctan2(np.hypot(r[2], r[5]), r[8])
    # 0 - x, since the direction of what is upright is 0, and that of -0 half a turn
    return Lean(tilt, np.arctan2(r[5], r[2]), np.arctan2(0.0 - r[7], 0.0 - r[6]))


def bodies(module: Any) -> dict[str, int]:
    """Numbers of the bodies in space among the places, by name."""
    kinds = zip(module.POSITIONS, module.POSITION_KINDS, strict=True)
    return {n: i for i, (n, kind) in enumerate(kinds) if kind in BODIES and in_space(module)}


def names_of_leans(module: Any) -> dict[int, tuple[str, str]]:
    """Names of the tilt and its direction of each body in space, by its number among places.

    None where the tilt is a coordinate.
    """
    of = {} if TILT in module.STATES else bodies(module)
    names = {i: f"{name.replace(' ', '_')}_" * (len(of) > 1) for name, i in of.items()}
    return {i: (prefix + TILT, prefix + DIRECTION) for i, prefix in names.items()}


def of_leans(module: Any, poses: Any) -> dict[str, Any]:
    """The tilt of each body, its direction and the reserve, by name; poses as of `barrier`.

    reserve : 1 - tilt/barrier, below zero beyond the barrier; of one body on feet.
    """
    quantities: dict[str, Any] = {}
    for i, names in names_of_leans(module).items():
        lean = lean_of(poses[i][3:])
        quantities |= dict(zip(names, lean, strict=False))
    if stands_on_feet(module):
        quantities[RESERVE] = 1.0 - lean.tilt / barrier(module, poses, lean.direction)
    return quantities


def stands_on_feet(module: Any) -> bool:
    """Whether a structure is one body on three feet or more, which nothing else holds."""
    feet = getattr(module, "POINTS", ())
    return len(bodies(module)) == 1 and len(feet) > 2 and not module.ELEMENT_NAMES


def has_barrier(structure: Any) -> bool:
    """Whether a structure stands on feet, of which three or more are level and none is lower."""
    return stands_on_feet(structure.module) and bool(feet_at_rest(structure).bear.sum() > 2)


class FeetAtRest(NamedTuple):
    """Feet of a body at rest. places (n, 3) : from its centroid [m]. bear (n,) : the lowest."""

    places: np.ndarray
    bear: np.ndarray


def feet_at_rest(structure: Any) -> FeetAtRest:
    """The feet of a body that stands on feet."""
    module = structure.module
    (at,) = places(module, np.zeros(1, int), np.zeros((1, module.N_STATES)), structure.vector)
    arms = np.array(_arms(module, at))
    heights = arms[:, 2]
    return FeetAtRest(arms, heights - heights.min() <= LEVEL * abs(heights).max())


def barrier(module: Any, poses: Any, direction: Any) -> Any:
    """The tilt from which a body on feet does not come back, in a direction along its axes [rad].

    poses (m, 12) : its place and those of its feet, of numbers or of arrays (n,), as of `places`.
    """
    return barrier_over(_arms(module, poses), direction)


def barrier_over(arms: Iterable[Any], direction: Any) -> Any:
    """The tilt at which a centroid is highest, above one of places (x, y, z) from it [rad].

    There it is above the place that is farthest from it in the plane of the lean; of level places
    that is the outermost one. Places as high as it, or higher, do not count.
    """
    slopes, squares = [], []
    for x, y, z in (arm for arm in arms if np.all(arm[2] < 0.0)):
        slope = x / -z * np.cos(direction) + y / -z * np.sin(direction)
        slopes.append(slope)
        squares.append(z**2 * (1.0 + slope**2) * (slope > 0.0))
    if not np.ndim(slopes[0]):
        least = max(squares) * (1.0 - LEVEL)
        pairs = zip(slopes, squares, strict=True)
        return np.arctan(max(slope for slope, square in pairs if square >= least))
    far = np.array(squares) >= np.max(squares, axis=0) * (1.0 - LEVEL)
    return np.arctan(np.max(slopes, axis=0, where=far, initial=-np.inf))


def _arms(module: Any, poses: Any) -> list[tuple[Any, ...]]:
    """Places of the feet from the centroid, along the axes of the body."""
    (i,) = bodies(module).values()
    center, turned = poses[i][:3], poses[i][3:]
    arms = []
    for foot in module.POINTS:
        at = poses[module.POSITIONS.index(foot)]
        apart = [at[k] - center[k] for k in range(3)]
        arms.append(tuple(sum(turned[3 * k + j] * apart[k] for k in range(3)) for j in range(3)))
    return arms


def barriers(structure: Any, directions: np.ndarray) -> np.ndarray:
    """The stability surface of a structure that `has_barrier`: `Structure.overturning_tilts`."""
    return barrier_over(feet_at_rest(structure).places, directions)
