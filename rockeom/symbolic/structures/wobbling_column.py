"""Round columns that roll on their rims without twist: one alone, and several under a slab.

Two modes lean to either side along one diameter, whose azimuth is a coordinate, and one stands
flat. Where the column comes flat along that diameter, the rim on the other side is struck; as soon
as it precesses it never does, and rolls round instead (Srinivasan and Ruina 2008).
"""

from dataclasses import replace

import sympy as sp

from rockeom.symbolic import space
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Body, Parameter, Point, coordinate, parameter
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.registry import family
from rockeom.symbolic.rocking import SIDES, RockingModel

MASS = parameter("m", "mass", "kg", "mass of a column")
RADIUS = parameter("b", "radius", "m", "radius of the base")
HEIGHT = parameter("H", "centroid_height", "m", "height of a column's centroid above its base")
ACROSS = parameter("I_1", "inertia_xx", "kg m2", "moment of inertia about a diameter")
ALONG = parameter("I_3", "inertia_zz", "kg m2", "moment of inertia about the axis")
COLUMNS = Parameter(
    sp.Symbol("n", positive=True, integer=True), "columns", "-", "number of columns"
)
SLAB_MASS = Parameter(sp.Symbol("M", nonnegative=True), "slab_mass", "kg", "mass of the slab")
TILT = coordinate("theta", "tilt", "rad", "tilt of the axis, negative away from the direction")
DIRECTION = coordinate("psi", "direction", "rad", "azimuth to which a positive tilt leans")
FLATTEST = sp.Rational(1, 10**24)
"""Moment of inertia of the point of contact about the vertical, in m b^2.

It has none, nor has the precession of a column that stands flat, and rates would be 0/0 there. With
this one a column that comes nearer to flat than some 1e-12 rad strikes, and no digit changes else.
"""


@family
def wobbling_column() -> RockingModel:
    """A round column on its rim: a cylinder, or another body of revolution on a flat base."""
    return _rolling("wobbling_column", "Column that wobbles on its rim", ())


@family
def podium() -> RockingModel:
    """A slab on equal columns, which wobble alike and touch it with the rim opposite their base's.

    It moves by twice the way of a column's centroid, and does not turn (Vassiliou 2018).
    """
    return _rolling("podium", "Slab on columns that wobble", (COLUMNS, SLAB_MASS))


def _rolling(name: str, title: str, slab: tuple[Parameter, ...]) -> RockingModel:
    at = space.wobble(TILT.position, DIRECTION.position, SIDE * RADIUS.symbol)
    centroid = at.at((sp.S.Zero, sp.S.Zero, HEIGHT.symbol))
    number = COLUMNS.symbol if slab else sp.S.One
    mass, inertia = number * MASS.symbol, sp.diag(ACROSS.symbol, ACROSS.symbol, ALONG.symbol)
    bodies = [Body("column", mass, centroid, number * inertia, at.rotation)]
    if slab:
        bodies.insert(0, Body("slab", SLAB_MASS.symbol, tuple(2 * x for x in centroid)))
    bodies.append(_contact())
    rocking = Mode(dict(SIDES), (TILT, DIRECTION), tuple(bodies), GRAVITY.symbol)
    flat = Mode({"both": 0}, (), tuple(map(_flat, bodies)), GRAVITY.symbol)
    opposite = zip(SIDES, reversed(SIDES), strict=True)
    return RockingModel(
        name,
        title,
        (*slab, MASS, RADIUS, HEIGHT, ACROSS, ALONG, GRAVITY),
        coordinates=(TILT, DIRECTION),
        modes=(rocking, flat),
        transitions=(
            *(
                Transition(rim, other, "impact", SIDES[rim] * TILT.position, "both")
                for rim, other in opposite
            ),
            *(Transition("both", rim, "uplift") for rim in SIDES),
        ),
        rotation=TILT,
        reference="Vassiliou et al. (2017); Vassiliou (2018)",
    )


def _contact() -> Body:
    """The point of contact, without mass: a response has its track."""
    psi, b = DIRECTION.position, RADIUS.symbol
    place: Point = (SIDE * b * sp.cos(psi), SIDE * b * sp.sin(psi), sp.S.Zero)
    inertia = FLATTEST * MASS.symbol * b**2 * sp.eye(3)
    return Body("contact", sp.S.Zero, place, inertia, space.about("z", psi))


def _flat(body: Body) -> Body:
    """The body where the base lies on the ground; the diameter has the direction it had."""
    held = {TILT.position: sp.S.Zero, SIDE: sp.S.One}
    place = tuple(sp.sympify(x).subs(held) for x in body.position)
    return replace(body, position=place, rotation=body.rotation.subs(held))
