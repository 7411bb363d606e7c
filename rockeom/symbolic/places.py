"""Where things are: what a generated module tells of the places of bodies and feet, by name.

Places are (x, y) in axes that move with the ground, x to the right and y upwards.
"""

from __future__ import annotations

from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.algebra import tidy
from rockeom.symbolic.contacts import Contact, Model
from rockeom.symbolic.elements import Unilateral
from rockeom.symbolic.model import Body, Mechanism, RockingModel

LOAD = "load"
BODY, MASSLESS, FOOT, POINT, SPRING, DAMPED = (
    "body", "massless", "foot", "point", "spring", "spring_and_damper",
)  # fmt: skip
WALL_LEFT, WALL_RIGHT = "wall_on_the_left", "wall_on_the_right"


class Place(NamedTuple):
    """A body's centre, with the angle through which the body turns; or a point.

    kind : "body", or "massless", a body for sketches; "foot", above rigid ground, or beside a wall
    that stands, "wall_on_the_left" or "wall_on_the_right"; "point", that touches another body;
    "spring" or "spring_and_damper", which carry it; "load".
    """

    kind: str
    x: sp.Expr
    y: sp.Expr
    rotation: sp.Expr = sp.S.Zero


def places(model: RockingModel | Model, mechanism: Mechanism) -> dict[str, Place]:
    """Of bodies, feet or contacts, springs and the load point, by name, in a mechanism."""
    found = [
        (b.name, Place(BODY if b.mass != 0 else MASSLESS, *b.position, b.rotation))
        for b in mechanism.bodies
    ]
    if isinstance(model, Model):
        found += [(c.name, Place(touches(model, c), *c.point)) for c in model.contacts]
        for e in model.switching:
            if isinstance(e, Unilateral) and e.place is not None:
                found.append((e.name, Place(DAMPED if e.damping != 0 else SPRING, *e.place)))
    else:
        found += [
            (name, Place(DAMPED if foot.sprung else FOOT, *foot.position))
            for name, foot in sorted(mechanism.feet.items())
        ]
    if mechanism.load_point is not None:
        found.append((LOAD, Place(LOAD, *mechanism.load_point)))
    return dict(found)


def names_of(model: RockingModel | Model) -> list[str]:
    """All names of places, of which none may stand for two."""
    if isinstance(model, Model):
        points = [*(c.name for c in model.contacts), *(e.name for e in model.switching)]
    else:
        points = sorted(model.mechanisms[0].feet)
    return [*(b.name for b in bodies_of(model)), *points, LOAD]


def bodies_of(model: RockingModel | Model) -> tuple[Body, ...]:
    """Those of a declaration, which are the same in all its mechanisms but for where they are."""
    return model.bodies if isinstance(model, Model) else model.mechanisms[0].bodies


def touches(model: Model, contact: Contact) -> str:
    """What a contact meets: the ground or a wall, if where its gap ends stays where it is."""
    x, y = contact.point
    gap = contact.at(contact.side)[0]
    moving = {c.position for c in model.coordinates}
    for kind, end in ((FOOT, y - gap), (WALL_LEFT, x - gap), (WALL_RIGHT, x + gap)):
        if not tidy(end).free_symbols & moving:
            return kind
    return POINT
