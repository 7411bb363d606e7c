"""Bodies of closed surfaces in files: mass, centroid, inertia, and the points on which they stand.

Files are read by trimesh, an extra of the package.
"""

import itertools
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.spatial import ConvexHull, QhullError
from scipy.spatial.transform import Rotation

from rockeom.codes import MOST_POINTS_IN_SPACE
from rockeom.files import check_path
from rockeom.numbers.checks import InputError, installed_by, number
from rockeom.structures.positions import solid

FORMATS = ("stl", "obj", "ply")
_MOST_FACES = 3000  # that a picture shows
_FAR = 100.0  # sizes of a body from the origin: there its moments lose ten digits of sixteen
_TILTS = np.radians([0.5, 1.0, 2.0, 4.0, 8.0])  # in which support points keep a centroid's height
_WAYS = 48  # directions of these
_FIRST = 32  # corners of a base at most, of which the first three points are some
_NO_USE = 1e-8  # squared error, of the size of the base, that no further point need mend
_FINEST = 48  # cells along the longest side, of a surface that is drawn coarser


class Surface(tuple[Any, ...]):
    """Vertices and faces of a surface, which are too many to print."""

    def __repr__(self) -> str:
        return f"<surface of {len(self[1])} faces>"


def surface_of(value: Any, kind: str) -> Surface | None:
    """The surface that an argument `shape` gives, None for none; raises InputError for others."""
    if value is None:
        return None
    try:
        vertices, faces = value
        shown = Surface((tuple(map(tuple, vertices)), tuple(map(tuple, faces))))
        corners = solid(*shown).centres
    except (TypeError, ValueError, IndexError):
        corners = np.empty(0)
    if corners.ndim != 2 or corners.shape[1] != 3 or not np.isfinite(corners).all():
        raise InputError("shape", value, kind).give(
            "vertices, [(x, y, z), ...] in m, and faces, [(0, 1, 2), ...], as `from_mesh` does"
        )
    return shown


class MeshBody(NamedTuple):
    """A homogeneous body of a mesh.

    mass [kg]. centroid (3,) : in the axes of the file, z above the lowest vertex [m]. inertia
    (3, 3) : about the centroid [kg m2]. vertices (n, 3) : from the centroid [m]. faces (m, 3) :
    numbers of vertices, counter-clockwise seen from outside.
    """

    mass: float
    centroid: np.ndarray
    inertia: np.ndarray
    vertices: np.ndarray
    faces: np.ndarray

    @property
    def shape(self) -> Surface:
        """Vertices and faces of a surface for pictures: of a fine mesh a coarser one.

        Vertices of one cell of a grid become one, their mean (Rossignac and Borrel 1993).
        """
        vertices, faces, cells = self.vertices, self.faces, _FINEST
        while len(faces) > _MOST_FACES:
            size = np.ptp(self.vertices, axis=0).max() / cells
            grid = np.floor(self.vertices / size).astype(int)
            _, which, number = np.unique(grid, axis=0, return_inverse=True, return_counts=True)
            which, vertices = which.ravel(), np.zeros((len(number), 3))
            np.add.at(vertices, which, self.vertices)
            vertices, faces = vertices / number[:, None], which[self.faces]
            faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
            cells = int(0.8 * cells)
        return Surface(tuple(map(tuple, rows.tolist())) for rows in (vertices, faces))


def read_body(
    path: str | os.PathLike[str], mass: float | None, density: float | None, scale: float
) -> MeshBody:
    """The homogeneous body of a file; scale : of its lengths to metres.

    Raises InputError for a mesh that is open, not oriented or inside out, and for other than one of
    the mass and the density; ModuleNotFoundError without trimesh.
    """
    if (mass is None) == (density is None):
        given = "neither mass nor density is" if mass is None else "mass and density are both"
        raise InputError("mass", mass).says(f"{given} given: give one, {{mass}} or {{density}}")
    numbers = {"mass": mass, "density": density, "scale": scale}
    for name, value in numbers.items():
        if value is not None and not 0.0 < number(name, value) < np.inf:
            raise InputError(name, value).give("a positive number")
    mesh, place = _read(path)
    volume = float(mesh.volume) * scale**3
    if density is None:
        density = float(mass) / volume  # type: ignore[arg-type]
    vertices = np.array(mesh.vertices, dtype=float) * scale
    centroid = np.array(mesh.center_mass, dtype=float) * scale
    inertia = np.array(mesh.moment_inertia) / float(mesh.density) * density * scale**5
    from_lowest = centroid + scale * place - [0.0, 0.0, vertices[:, 2].min() + scale * place[2]]
    tensor = (inertia + inertia.T) / 2  # exactly symmetric
    return MeshBody(
        density * volume, from_lowest, tensor, vertices - centroid, np.array(mesh.faces)
    )


def _read(path: str | os.PathLike[str]) -> tuple[Any, np.ndarray]:
    """The mesh of a file, and what was taken from its places (3,), which is 0 of most.

    Raises InputError for one that bounds no body.
    """
    check_path(path)
    if (ending := Path(path).suffix.lower().removeprefix(".")) not in FORMATS:
        raise _refused(path, f"it is no mesh by its name: give one of {', '.join(FORMATS)}")
    if not Path(path).is_file():
        raise FileNotFoundError(f"{path}: there is no such file")
    try:
        import trimesh
    except ImportError as error:
        raise ModuleNotFoundError(
            f"{path}: meshes are read by trimesh, which is not installed. Remedy: "
            f"{installed_by('mesh')}."
        ) from error
    try:
        mesh: Any = trimesh.load_mesh(os.fspath(path), file_type=ending)
        empty = not len(getattr(mesh, "faces", ()))
    except Exception as error:  # of a parser, whatever the file has in it
        raise _refused(path, f"it cannot be read ({error}): export it again") from error
    if empty:
        raise _refused(path, "it has no faces: export the surface again")
    if not np.isfinite(mesh.vertices).all():
        raise _refused(path, "it has vertices that are not finite: export it again")
    place, size = mesh.bounds[0].copy(), float(mesh.extents.max())
    place[abs(place) <= _FAR * size] = 0.0
    if place.any():  # as in coordinates of a map: volume and moments would be lost in rounding
        mesh.apply_translation(-place)
    edges = np.unique(np.sort(mesh.edges, axis=1), axis=0, return_counts=True)[1]
    if (edges != 2).any():
        raise _refused(
            path,
            f"it is not closed, {int((edges != 2).sum())} of its {len(edges)} edges belong to "
            "other than two faces: close its holes and remove double faces in a mesh editor",
        )
    if not mesh.is_winding_consistent:
        raise _refused(
            path, "some faces look outward, others inward: recompute normals outward in an editor"
        )
    if not mesh.volume > 0.0:
        raise _refused(path, "it is inside out, its volume is not positive: flip its normals")
    return mesh, place


def _refused(path: str | os.PathLike[str], why: str) -> InputError:
    error = InputError("path", path, "from_mesh").says(why)
    error.file = path
    return error


def settled(body: MeshBody) -> MeshBody:
    """The body turned onto the face of its convex hull on which it comes to rest.

    It is the one that takes the least turn, of those above which the centroid stands: a scan lies
    nearly as the body lay, and touches one point of the ground.
    """
    hull = ConvexHull(body.vertices)
    normals, depths = hull.equations[:, :3], -hull.equations[:, 3]
    corners = hull.points[hull.simplices] - (normals * depths[:, None])[:, None]
    sides = np.cross(corners, np.roll(corners, -1, axis=1)) @ normals[..., None]
    below = (sides >= 0.0).all(axis=(1, 2)) | (sides <= 0.0).all(axis=(1, 2))
    down = normals[below][np.argmin(normals[below, 2])]
    turn, _ = Rotation.align_vectors([[0.0, 0.0, -1.0]], [down])
    axes, vertices = turn.as_matrix(), turn.apply(body.vertices)
    inertia = axes @ body.inertia @ axes.T
    return body._replace(
        centroid=np.array([*body.centroid[:2], -vertices[:, 2].min()]), vertices=vertices,
        inertia=(inertia + inertia.T) / 2,
    )  # fmt: skip


def support_points(of: MeshBody, bearing_height: float, kind: str) -> dict[str, tuple[float, ...]]:
    """Places along x and y of the points on which a body stands and leans, and their heights.

    They are corners of its convex hull, counter-clockwise from above. Those within the bearing
    height of the lowest bear as it rests, on one plane; the others are lowered as much. The first
    three bear and have the centroid above them; with the others, while they are of any use and at
    most as many as a structure may have, the height of the centroid is kept as it leans, by least
    squares of its error over the sine of the tilt. Heights are left out where all points bear.
    """
    if not number("bearing_height", bearing_height) > 0.0:
        raise InputError("bearing_height", bearing_height, kind).give("a positive height [m]")
    hull = of.vertices[ConvexHull(of.vertices).vertices]
    rises = np.maximum(hull[:, 2] - hull[:, 2].min() - bearing_height, 0.0)
    bear = np.flatnonzero(rises == 0.0)
    try:
        corners = bear[ConvexHull(hull[bear, :2]).vertices]
    except (QhullError, ValueError):
        raise InputError("bearing_height", bearing_height, kind).wrong(
            f"is {bearing_height:g} m, within which {len(bear)} points of the surface support no "
            "area: give more"
        ) from None
    chosen = _useful(np.column_stack([hull[:, :2], rises - of.centroid[2]]), corners.tolist())
    places = np.column_stack([hull[chosen, :2] + of.centroid[:2], rises[chosen]])
    count = 3 if rises[chosen].any() else 2
    return {f"point_{i + 1}": tuple(place[:count]) for i, place in enumerate(places.tolist())}


def _useful(points: np.ndarray, bearing: list[int]) -> list[int]:
    """Numbers of the most useful points (n, 3) from the centroid, of which some bear at rest."""
    around = np.tile(np.linspace(0.0, 2.0 * np.pi, _WAYS, endpoint=False), len(_TILTS))
    upward = np.column_stack([np.cos(around), np.sin(around), 1.0 / np.tan(_TILTS.repeat(_WAYS))])
    depths = -upward @ points.T  # of each point below the centroid, over the sine of the tilt
    of_all = depths.max(axis=1)

    def error(some: Iterable[int]) -> float:
        return float(((of_all - depths[:, [*some]].max(axis=1)) ** 2).sum())

    few = bearing[:: -(-len(bearing) // _FIRST)]  # of a round base, around it
    fan = ((bearing[0], i, j) for i, j in itertools.pairwise(bearing[1:]))  # covers any base
    tried = itertools.chain(itertools.combinations(few, 3), fan)
    triples = [t for t in tried if _surround(points[list(t), :2])]
    chosen = list(min(triples, key=error, default=tuple(few[:MOST_POINTS_IN_SPACE])))
    least = _NO_USE * float(np.ptp(points[bearing, :2], axis=0).max()) ** 2 * len(depths)
    while len(chosen) < MOST_POINTS_IN_SPACE and error(chosen) > least:
        deepest = np.maximum(depths[:, chosen].max(axis=1)[:, None], depths)
        chosen.append(int(((of_all[:, None] - deepest) ** 2).sum(axis=0).argmin()))
    middle = points[chosen, :2].mean(axis=0)
    angles = np.arctan2(*(points[chosen, :2] - middle).T[::-1])
    return [chosen[i] for i in np.argsort(angles)]


def _surround(corners: np.ndarray) -> bool:
    """Whether corners (3, 2) of a triangle lie around the origin."""
    x, y = corners.T
    sides = x * np.roll(y, -1) - y * np.roll(x, -1)
    return bool((sides > 0.0).all() or (sides < 0.0).all())
