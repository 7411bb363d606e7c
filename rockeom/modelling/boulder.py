"""`Boulder`: a rigid body of a mesh in space, on the points by which it rests."""

from __future__ import annotations

import functools
import os
from typing import Any, ClassVar, Self

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.modelling.mesh import read_body, support_points
from rockeom.modelling.standing import LeggedStatue


class Boulder(LeggedStatue):
    """Rigid body of any shape in space on the points by which it rests; `from_mesh` finds them.

    It is a `LeggedStatue`, and has its arguments and states; the feet are its support points.

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
        scale: float = 1.0,
        **others: Any,
    ) -> Self:
        """Homogeneous body of a closed surface in a file, as it lies there.

        Parameters
        ----------
        path : path_like
            File .stl, .obj or .ply, z upwards. It is read by trimesh, of the extra `mesh`.
        mass : float, optional
            Mass [kg].
        density : float, optional
            Density [kg/m3], in place of the mass.
        bearing_height : float, optional
            Height above the lowest point within which the surface bears [m].
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
        The support points are the corners of the area below those vertices of the convex hull that
        are within the bearing height, at most eight, and are put into one plane. They decide how
        far a boulder leans before it falls: compare several bearing heights.
        """
        body = read_body(path, mass, density, scale)
        return cls(
            feet=support_points(body, bearing_height, "Boulder"), mass=body.mass,
            centroid=tuple(body.centroid.tolist()), inertia=body.inertia, shape=body.shape,
            **others,
        )  # fmt: skip
