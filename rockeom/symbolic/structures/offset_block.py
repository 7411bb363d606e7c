"""The rigid block whose centroid is not above the middle of its base."""

import sympy as sp

from rockeom.symbolic.model import Body, Parameter, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, ROTATION
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel, rocking_structure
from rockeom.symbolic.structures.rigid_block import HALF_WIDTH, HEIGHT, INERTIA, MASS


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

    Parameters
    ----------
    full_height : float, optional
        Height of the whole block [m], for a strap and for words; `from_dimensions` sets it.
    """
    offset = Parameter(
        sp.Symbol("d", real=True),
        "offset",
        "m",
        "distance of the centroid to the right of the middle of the base",
    )
    b, h, d = HALF_WIDTH.symbol, HEIGHT.symbol, offset.symbol
    theta = ROTATION.position
    outline = tuple((x * b - d, y * h) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))

    def bodies(pivot):
        centroid = turned((d, h), pivot, theta)
        return [Body("block", MASS.symbol, centroid, INERTIA.symbol, theta, outline=outline)]

    return rocking_structure(
        name="offset_block",
        title="Rigid block with its centroid off the middle",
        parameters=(MASS, HALF_WIDTH, HEIGHT, offset, INERTIA, GRAVITY),
        coordinates=(ROTATION,),
        bodies=bodies,
        half_width=b,
        gravity=GRAVITY.symbol,
        reference="as Housner (1963), the centroid off the middle",
    )
