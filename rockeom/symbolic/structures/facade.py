"""The one-sided facade: it turns about its outer edge, and leans on transverse walls."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Contact, Force, Rigid
from rockeom.symbolic.model import Body, Member, Parameter, parameter, rectangle, turned
from rockeom.symbolic.parts.restraints import attachments
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.parts.supports import FREE_ROTATION
from rockeom.symbolic.registry import family
from rockeom.symbolic.structures.rigid_block import HALF_WIDTH, HEIGHT, INERTIA, MASS

RESTITUTION = Parameter(
    sp.Symbol("e_n", nonnegative=True), "restitution", "-", "ratio of speeds at the walls"
)
THRUST = Parameter(sp.Symbol("T", real=True), "thrust", "N", "horizontal thrust, outwards")
THRUST_HEIGHT = parameter("h_T", "thrust_height", "m", "height at which the thrust acts")


@family
def facade(attached: Sequence[tuple[str, str, bool, str]] = ()) -> Any:
    """A rigid facade that turns outwards about its outer edge, and inwards meets transverse walls.

    The walls are a smooth stop; the edge neither slides nor lifts. attached : kinds of its ties and
    pushes.
    """
    theta, b = FREE_ROTATION.position, HALF_WIDTH.symbol
    edge = (b, sp.S.Zero)

    def place(point: Any) -> Any:
        """A point from the middle of the base when it stands, when the facade has turned."""
        return turned(point, edge, theta)

    ties = attachments(attached, place, lambda point: point)
    inner = place((-b, sp.S.Zero))
    thrust = place((sp.S.Zero, THRUST_HEIGHT.symbol))
    centroid = place((sp.S.Zero, HEIGHT.symbol))
    body = Body(
        "facade", MASS.symbol, centroid, INERTIA.symbol, theta, outline=rectangle(b, HEIGHT.symbol)
    )
    height = replace(HEIGHT, name="centroid_height")
    size = (MASS, HALF_WIDTH, height, INERTIA, GRAVITY, RESTITUTION, THRUST, THRUST_HEIGHT)
    return Model(
        name="facade",
        title="Facade that turns about one edge",
        parameters=(*size, *ties.parameters),
        coordinates=(FREE_ROTATION,),
        bodies=(body,),
        gravity=GRAVITY.symbol,
        rotation=FREE_ROTATION,
        contacts=(
            Contact(
                "walls", inner[1], inner[0],
                Rigid(restitution=RESTITUTION.symbol, friction=sp.S.Zero), 0,
                place((-b, HEIGHT.symbol)),
            ),
        ),
        forces=(Force("thrust", (THRUST.symbol, sp.S.Zero), thrust),),
        elements=ties.elements,
        members=(Member("wall", "ground", "ground", (-b, 0), (-b, 2 * HEIGHT.symbol)),),
        load_point=centroid,
        reference="AlShawa and others (2019)",
    )  # fmt: skip
