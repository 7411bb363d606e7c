"""A rigid wall under a constant axial force on a bed that does not pull, and crushes."""

import sympy as sp

from rockeom.symbolic import valid
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import dead_load
from rockeom.symbolic.elements import Tie
from rockeom.symbolic.model import Body, coordinate, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, HALF_WIDTH, HEIGHT, INERTIA, MASS, Point
from rockeom.symbolic.parts.supports import FOUNDATION_STIFFNESS, FREE_ROTATION

HEAVE = coordinate("v", "heave", "m", "rise of the base's centre above the unloaded bed")
AXIAL_FORCE = parameter("N", "axial_force", "N", "constant force on the wall, along its axis")
SHEAR_SPAN = parameter("H_0", "shear_span", "m", "height of both loads above the base")
STRENGTH = parameter("f_c", "strength", "N", "force at which a spring crushes")
MIDDLE = (sp.S.Zero, sp.S.Zero)


def place(point: Point) -> Point:
    """Place of a point of the wall, given from the middle of its base, which is guided vertically.

    The base's middle rises and falls, and does not slide.
    """
    x, y = turned(point, MIDDLE, FREE_ROTATION.position)
    return x, y + HEAVE.position


def compression(x: sp.Expr) -> sp.Expr:
    """Compression of the bed at the distance x to the right of the middle of the base."""
    return -place((x, sp.S.Zero))[1]


def wall_on_bed(springs: int, following: bool = True) -> Model:
    """A wall on equal springs, each in the middle of one of as many equal strips of its base.

    They press and do not pull, and crush at their strength, which they keep: `Tie` under
    compression, slack in tension. following : whether the axial force turns with the wall, or
    stays vertical.

    Each spring is elastic, crushes or is slack: there are 3^n modes, of which a model may have
    4096, that is seven springs. Statics of more is that of `rk.WallOnBed`.

    Raises ValueError for a number of springs that is not whole, and for more than seven.
    """
    valid.counts("wall_on_bed", springs=springs)
    theta, top = FREE_ROTATION.position, place((sp.S.Zero, SHEAR_SPAN.symbol))
    centroid = place((sp.S.Zero, HEIGHT.symbol))
    wall = Body(
        "wall", MASS.symbol, centroid, INERTIA.symbol, theta,
        outline=rectangle(HALF_WIDTH.symbol, HEIGHT.symbol),
    )  # fmt: skip
    middles = [
        HALF_WIDTH.symbol * sp.Rational(2 * i + 1 - springs, springs) for i in range(springs)
    ]
    return Model(
        name=f"wall_on_{springs}_crushing_springs",
        title=f"A wall on a bed of {springs} springs that crush",
        parameters=(
            MASS, HEIGHT, INERTIA, HALF_WIDTH, GRAVITY, AXIAL_FORCE, SHEAR_SPAN,
            FOUNDATION_STIFFNESS, STRENGTH,
        ),
        coordinates=(FREE_ROTATION, HEAVE),
        bodies=(wall,),
        gravity=GRAVITY.symbol,
        rotation=FREE_ROTATION,
        elements=tuple(
            Tie(f"spring_{i}", compression(x), FOUNDATION_STIFFNESS.symbol, STRENGTH.symbol)
            for i, x in enumerate(middles, 1)
        ),
        forces=(
            dead_load("axial", AXIAL_FORCE.symbol, top, theta if following else sp.S.Zero),
        ),
        load_point=top,
    )  # fmt: skip
