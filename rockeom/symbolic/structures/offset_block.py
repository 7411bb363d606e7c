"""The rigid block whose centroid is not above the middle of its base."""

from __future__ import annotations

import sympy as sp

from rockeom.symbolic.model import Body, Parameter, parameter, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, ROTATION
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel, rocking_structure


@shipped(
    place=3.2,
    may_vanish=("inertia",),
    defaults={"mass": 1.0, "inertia": "that of a homogeneous rectangle about its middle"},
    called={"height": "half_height"},
)
def offset_block() -> RockingModel:
    """The block with its centroid off the middle of the base; any size of rotation.

    It lifts and overturns at different accelerations and angles to the right and to the left, and
    loses different parts of its angular velocity at impacts of its left and its right foot.
    """
    mass = parameter("m", "mass", "kg", "mass")
    half_width = parameter("B", "half_width", "m", "half of the width of the base")
    height = parameter("H", "height", "m", "height of the centroid above the base")
    offset = Parameter(
        sp.Symbol("d", real=True),
        "offset",
        "m",
        "of the centroid, to the right of the middle of the base",
    )
    inertia = parameter("I_g", "inertia", "kg m2", "moment of inertia about the centroid")
    b, h, d = half_width.symbol, height.symbol, offset.symbol
    theta = ROTATION.position
    outline = tuple((x * b - d, y * h) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))

    def bodies(pivot):
        centroid = turned((d, h), pivot, theta)
        return [Body("block", mass.symbol, centroid, inertia.symbol, theta, outline=outline)]

    return rocking_structure(
        name="offset_block",
        title="Rigid block with its centroid off the middle",
        parameters=(mass, half_width, height, offset, inertia, GRAVITY),
        coordinates=(ROTATION,),
        bodies=bodies,
        half_width=b,
        gravity=GRAVITY.symbol,
        reference="as Housner (1963), the centroid off the middle",
    )
