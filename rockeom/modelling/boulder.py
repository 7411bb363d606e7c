"""`Boulder`: a rigid body of a mesh in space, on the points by which it rests."""

from __future__ import annotations

import functools
import os
from typing import Any, ClassVar, Self

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.modelling.mesh import read_body, settled, support_points
from rockeom.modelling.standing import LeggedStatue


class Boulder(LeggedStatue):
    """Rigid body of any shape in space on the points by which it rests; `from_mesh` finds them.

    It is a `LeggedStatue` whose feet are its support points, and has its states.

    Parameters
    ----------
    feet : dict of str to tuple of float
        Place of each support point along x and y [m], by its name; with a third number, its height
        above the lowest ones.
    centroid : tuple of (float, float, float)
        Place of the centroid [m], in the same axes, z above the support points.
    mass : float
        Mass [kg].
    inertia : array_like
        Inertia tensor (3, 3) about the centroid along these axes [kg m2].
    friction : float, optional
        As of `LeggedStatue`.
    restitution : float, optional
        Ratio of the rates of a point's gap after and before it lands alone, 0 to 1.
    gravity : float, optional
        Acceleration of gravity [m/s2].
    shape : tuple, optional
        Surface for pictures, as of `LeggedStatue`.

    Raises
    ------
    InputError
        As of `LeggedStatue`.

    Examples
    --------
    >>> import rockeom as rk
    >>> boulder = rk.Boulder.from_mesh("boulder.ply", mass=350.0)  # doctest: +SKIP
    """

    model: ClassVar[str] = "boulder"

    @functools.cached_property
    def module(self) -> GeneratedModule:
        return module_of(LeggedStatue.model, **self.derivation)

    @classmethod
    def from_mesh(
        cls,
        path: str | os.PathLike[str],
        *,
        mass: float | None = None,
        density: float | None = None,
        bearing_height: float = 0.005,
        settle: bool = False,
        scale: float = 1.0,
        **others: Any,
    ) -> Self:
        """Homogeneous body of a closed surface in a file, as it lies there or as it comes to rest.

        Parameters
        ----------
        path : path_like
            File .stl, .obj or .ply, z upwards. It is read by trimesh, of the extra `mesh`.
        mass : float, optional
            Mass [kg].
        density : float, optional
            Density [kg/m3], in place of the mass.
        bearing_height : float, optional
            Height above the lowest point within which the surface bears as it rests [m].
        settle : bool, optional
            Whether the body is turned first, by the least turn, onto a face of its convex hull on
            which it rests: a scan that is turned by a degree touches the ground in one point.
        scale : float, optional
            Factor of the lengths in the file to metres, such as 0.001.
        **others : object
            Further arguments of the class.

        Returns
        -------
        Boulder
            Boulder.

        Raises
        ------
        InputError
            For a surface that is open, inside out or of no volume, for other than one of mass and
            density, and for support points that do not support the centroid.
        FileNotFoundError
            For a missing file.
        ModuleNotFoundError
            Without trimesh.

        Notes
        -----
        Support points are vertices of the convex hull, at most eight. Those within the bearing
        height are put into one plane, on which the boulder rests. Those above, which are lowered as
        much, touch as it leans: they are chosen so that it rolls as it does on its surface, up to a
        tilt of 8 degrees. Points that would touch beyond that, and some of a base of many corners,
        are left out, so that it lifts and falls sooner there. The bearing points decide when it
        lifts, the others how far it leans before it falls: compare several bearing heights.
        """
        body = read_body(path, mass, density, scale)
        if settle:
            body = settled(body)
        return cls(
            feet=support_points(body, bearing_height, "Boulder"), mass=body.mass,
            centroid=tuple(body.centroid.tolist()), inertia=body.inertia, shape=body.shape,
            **others,
        )  # fmt: skip
