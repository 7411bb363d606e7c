"""The round body that leans on the rim of its base in space: a cylinder, a disc, a frustum."""

from typing import Any

import sympy as sp

from rockeom.numbers.checks import require_word
from rockeom.symbolic import space
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Rigid
from rockeom.symbolic.model import parameter
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.registry import family
from rockeom.symbolic.structures.rigid_block import MASS
from rockeom.symbolic.structures.standing_body import ANGLES, FALLEN, FRAME, PITCH, PLACE

RADIUS = parameter("b", "radius", "m", "radius of the rim")
CENTROID_HEIGHT = parameter("h", "centroid_height", "m", "height of the centroid above the rim")
ACROSS = parameter("I_1", "inertia_across", "kg m2", "moment of inertia about a diameter")
ALONG = parameter("I_3", "inertia_along", "kg m2", "moment of inertia about the axis of the body")
FRICTION_OF_WAYS = {"without slip": None, "freely": sp.S.Zero}
"""Coefficients of friction of a rim by the word for how it rolls."""


@family
def rolling_cylinder(rolls: str = "without slip") -> Any:
    """A round body on the rim of its base, which rolls without slip, or slips freely.

    rolls : a word of `FRICTION_OF_WAYS`.
    """
    require_word("rolls", rolls, FRICTION_OF_WAYS, "rolling_cylinder")
    inertia = sp.diag(ACROSS.symbol, ACROSS.symbol, ALONG.symbol)
    law, centre = Rigid(friction=FRICTION_OF_WAYS[rolls]), (0, 0, -CENTROID_HEIGHT.symbol)
    return Model(
        name="rolling_cylinder",
        title="Cylinder on its rim in space",
        parameters=(MASS, RADIUS, CENTROID_HEIGHT, ACROSS, ALONG, GRAVITY),
        coordinates=(*PLACE, *ANGLES),
        bodies=(space.body("body", MASS.symbol, inertia, FRAME),),
        gravity=GRAVITY.symbol,
        rotation=PITCH,
        contacts=(space.rim(FRAME, RADIUS.symbol, law, centre),),
        falls=space.tilt(FRAME, FALLEN),
        bounds=space.flat(FRAME),
    )
