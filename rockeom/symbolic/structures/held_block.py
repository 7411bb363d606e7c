"""The block that straps and anchors hold, on sharp or rounded corners that slide and roll."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Rigid, feet
from rockeom.symbolic.model import Body, Parameter, parameter, rectangle
from rockeom.symbolic.parts.restraints import attachments
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.parts.supports import FREE_ROTATION, FRICTION, RESTITUTION, X, Y, moved
from rockeom.symbolic.registry import family
from rockeom.symbolic.structures.rigid_block import HALF_WIDTH, HEIGHT, INERTIA, MASS

OFFSET = Parameter(
    sp.Symbol("e_c", real=True), "centroid_offset", "m", "place of the centroid, to the right"
)
RADIUS = parameter("r", "corner_radius", "m", "radius of the lower corners")


@family
def held_block(
    law: str = "newton", attached: Sequence[tuple[str, str, bool, str]] = (), rounded: bool = False
) -> Any:
    """A rigid block whose feet open, stick, slip and bounce, held by straps and anchors.

    law : as of `Rigid`. attached : kinds of its ties and pushes. rounded : whether its lower
    corners are arcs, which roll: the lowest point of an arc is its radius below its centre, and
    slips as much less than the centre moves as the block turns.
    """
    theta, b = FREE_ROTATION.position, HALF_WIDTH.symbol
    place = moved((X.position, Y.position))
    r = RADIUS.symbol if rounded else sp.S.Zero
    ties = attachments(attached, place, lambda point: point)
    centroid = place((OFFSET.symbol, HEIGHT.symbol))
    block = Body(
        "block", MASS.symbol, centroid, INERTIA.symbol, theta, outline=rectangle(b, HEIGHT.symbol)
    )
    size = (MASS, HALF_WIDTH, replace(HEIGHT, name="centroid_height"), OFFSET, INERTIA, GRAVITY)
    return Model(
        name="held_block",
        title="Rigid block that is held",
        parameters=(
            *size,
            FRICTION,
            RESTITUTION,
            *((RADIUS,) if rounded else ()),
            *ties.parameters,
        ),
        coordinates=(X, Y, FREE_ROTATION),
        bodies=(block,),
        gravity=GRAVITY.symbol,
        rotation=FREE_ROTATION,
        contacts=feet(
            gap=lambda s: place((s * (b - r), r))[1] - r,
            slip=lambda s: place((s * (b - r), r))[0] - r * theta,
            law=Rigid(restitution=RESTITUTION.symbol, friction=FRICTION.symbol, law=law),
        ),
        elements=ties.elements,
        load_point=centroid,
    )
