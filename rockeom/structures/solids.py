"""Surfaces of the bodies of a structure in space, of which pictures are drawn.

A class says what its bodies look like by `Structure.solids`, by the name of each body::

    @property
    def solids(self) -> dict[str, Solid]:
        return {"body": cylinder(self.radius, self.height)}

Places are from the centroid of the body, along axes that turn with it [m].
"""

import functools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

_SIDES = 48  # of the polygon that is drawn for a circle
_CREASE, _CREASE_OF_MANY = np.cos(np.radians([30.0, 70.0]))
"""Edges between faces that differ by more are drawn; of surfaces of many faces those by far more."""
_MANY = 300


@dataclass(frozen=True, eq=False)
class Solid:
    """Surface of a body.

    Parameters
    ----------
    vertices : ndarray
        Places (n, 3) [m].
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
        Places (n, 3) [m].
    faces : sequence of sequence of int
        Vertices of each face, by number and counter-clockwise seen from outside.

    Returns
    -------
    Solid
        Surface.
    """
    most = max(map(len, faces))
    rows = np.array([[*face, *[face[-1]] * (most - len(face))] for face in faces])
    return Solid(np.asarray(vertices, float), rows)


def box(width: float, depth: float, height: float, centre: Sequence[float] = (0, 0, 0)) -> Solid:
    """Box; centre : its middle, from the centroid of the body [m]."""
    half, middle = np.array([width, depth, height]) / 2, np.array(centre, dtype=float)
    signs = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    base = middle + half * [(*xy, -1) for xy in signs]
    return prismatic(base, middle + half * [(*xy, 1) for xy in signs])


def cylinder(
    radius: float, height: float, top_radius: float | None = None, centroid_height: float = np.nan
) -> Solid:
    """Round column, or a frustum of one; half of the height if no height of the centroid is."""
    at = 2 * np.pi * np.arange(_SIDES) / _SIDES
    below = height / 2 if np.isnan(centroid_height) else centroid_height
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
