"""The block that straps and anchors hold, on corners that slide and roll, beside a wall or not."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from rockeom.numbers.checks import require_word
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Contact, Rigid, feet
from rockeom.symbolic.model import Body, Outline, Parameter, Point, parameter
from rockeom.symbolic.parts.restraints import attachments
from rockeom.symbolic.parts.superstructures import GRAVITY, Place
from rockeom.symbolic.parts.supports import FREE_ROTATION, FRICTION, RESTITUTION, X, Y, moved
from rockeom.symbolic.registry import family
from rockeom.symbolic.structures.rigid_block import HALF_WIDTH, HEIGHT, INERTIA, MASS

OFFSET = Parameter(
    sp.Symbol("e_c", real=True), "centroid_offset", "m", "place of the centroid, to the right"
)
RADIUS = parameter("r", "corner_radius", "m", "radius of the lower corners")
BASE_RADIUS = parameter("R_b", "base_radius", "m", "radius of the round base")
WALL_GAP = parameter("d_w", "wall_gap", "m", "gap between the block and a wall on its right")
FULL_HEIGHT = parameter("H_f", "full_height", "m", "height of the whole block")
WALL_RESTITUTION = Parameter(
    sp.Symbol("e_w", nonnegative=True), "wall_restitution", "-", "ratio of speeds at the wall"
)
OF_CORNERS = {"sharp": (), "rounded": (RADIUS,), "round base": (BASE_RADIUS,)}
"""Parameters of what the block stands on."""


_SIDES = 8
"""Sides of a polygon for an arc, in a sketch."""


@family
def held_block(
    law: str = "newton",
    attached: Sequence[tuple[str, str, bool, str]] = (),
    corners: str = "sharp",
    wall: bool = False,
) -> Any:
    """A rigid block whose feet open, stick, slip and bounce, held by straps and anchors.

    law : as of `Rigid`. attached : kinds of its ties and pushes. corners : a word of `OF_CORNERS`.
    wall : whether there is a smooth wall on its right, which its upper corner may strike.
    """
    require_word("corners", corners, OF_CORNERS, "held_block")
    rolls = corners == "round base"  # up to the edge of its base
    place = moved((X.position, Y.position))
    ties = attachments(attached, place, lambda point: point)
    centroid = place((OFFSET.symbol, HEIGHT.symbol))
    block = Body(
        "block", MASS.symbol, centroid, INERTIA.symbol, FREE_ROTATION.position,
        outline=_outline(corners),
    )  # fmt: skip
    height = replace(HEIGHT, name="centroid_height")
    size = (MASS, HALF_WIDTH, height, OFFSET, FULL_HEIGHT, INERTIA, GRAVITY)
    of_wall = (WALL_GAP, WALL_RESTITUTION) if wall else ()
    return Model(
        name="held_block",
        title="Rigid block that is held",
        parameters=(
            *size, FRICTION, RESTITUTION, *OF_CORNERS[corners], *of_wall, *ties.parameters
        ),
        coordinates=(X, Y, FREE_ROTATION),
        bodies=(block,),
        gravity=GRAVITY.symbol,
        rotation=FREE_ROTATION,
        contacts=(*_stands(corners, place, law), *((_strikes(place, law),) if wall else ())),
        elements=ties.elements,
        load_point=centroid,
        overturning=sp.asin(HALF_WIDTH.symbol / BASE_RADIUS.symbol) if rolls else sp.pi / 2,
    )  # fmt: skip


def _outline(corners: str) -> Outline:
    """Its corners about its centroid; arcs as polygons."""
    b, top, of = HALF_WIDTH.symbol, FULL_HEIGHT.symbol, OF_CORNERS[corners]
    radius = of[0].symbol if of else sp.S.Zero
    round_base = corners == "round base"
    turn = sp.asin(b / radius) if round_base else sp.pi / 2
    flat = sp.S.Zero if round_base else b - radius
    parts = [turn * sp.Rational(k, _SIDES) for k in range(_SIDES + 1 if of else 1)]
    right = [(flat + radius * sp.sin(a), radius * (1 - sp.cos(a))) for a in parts]
    points = (*((-x, y) for x, y in reversed(right)), *right, (b, top), (-b, top))
    return tuple((x - OFFSET.symbol, y - HEIGHT.symbol) for x, y in points)


def _stands(corners: str, place: Place, law: str) -> tuple[Contact, ...]:
    """Points on which it stands: lowest points of arcs, of no radius where corners are sharp.

    The lowest point of an arc is its radius below its centre, and slips as much less than the
    centre moves as the block turns.
    """
    b, of = HALF_WIDTH.symbol, OF_CORNERS[corners]
    radius = of[0].symbol if of else sp.S.Zero
    ground = Rigid(restitution=RESTITUTION.symbol, friction=FRICTION.symbol, law=law)

    def gap(centre: sp.Expr) -> sp.Expr:
        return place((centre, radius))[1] - radius

    def slip(centre: sp.Expr) -> sp.Expr:
        return place((centre, radius))[0] - radius * FREE_ROTATION.position

    def lowest(centre: sp.Expr) -> Point:
        return place((centre, radius))[0], gap(centre)

    if corners == "round base":
        return (Contact("base", gap(sp.S.Zero), slip(sp.S.Zero), ground, 0, lowest(sp.S.Zero)),)
    return feet(
        gap=lambda s: gap(s * (b - radius)),
        slip=lambda s: slip(s * (b - radius)),
        law=ground,
        place=lambda s: lowest(s * (b - radius)),
    )


def _strikes(place: Place, law: str) -> Contact:
    """The upper corner of its right side, which may strike a smooth wall there."""
    x, y = place((HALF_WIDTH.symbol, FULL_HEIGHT.symbol))
    smooth = Rigid(WALL_RESTITUTION.symbol, sp.S.Zero, law)
    return Contact("wall", HALF_WIDTH.symbol + WALL_GAP.symbol - x, y, smooth, 0, (x, y))
