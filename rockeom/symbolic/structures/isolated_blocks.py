"""Blocks on one base that moves on an isolator."""

from typing import Any

import sympy as sp

from rockeom.symbolic import valid
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Contact, Rigid
from rockeom.symbolic.elements import Spring
from rockeom.symbolic.model import Body, Member, Parameter, coordinate, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.parts.supports import FRICTION, RESTITUTION
from rockeom.symbolic.registry import family

BASE = coordinate("u", "u", "m", "displacement of the base relative to the ground")
BASE_MASS = parameter("m_b", "base_mass", "kg", "mass of the base")
STIFFNESS = parameter("k_b", "isolator_stiffness", "N/m", "stiffness of the isolator")
DAMPING = Parameter(
    sp.Symbol("c_b", nonnegative=True), "isolator_damping", "N s/m", "damping of the isolator"
)


@family
def isolated_blocks(blocks: int = 1, law: str = "newton") -> Any:
    """Rigid blocks, side by side on a base that moves horizontally on a spring and a damper.

    law : as of `Rigid`. The place of a block is relative to the base.
    """
    valid.counts("isolated_blocks", blocks=blocks)
    ends = [f"_{i}" if blocks > 1 else "" for i in range(1, blocks + 1)]
    sizes = [_sizes(end) for end in ends]
    edge = sizes[-1][0].symbol - 2 * sum(b.symbol for b, *_ in sizes)  # of the first block
    slab, bearings = _base(sizes[0][0].symbol / 2 - edge)
    bodies = [slab]
    contacts: list[Contact] = []
    parameters: list[Parameter] = []
    coordinates = [BASE]
    for end, (b, h, m, inertia) in zip(ends, sizes, strict=True):
        x = coordinate(f"x{_tex(end)}", f"x{end}", "m", "place of the block's base on the base")
        y = coordinate(f"y{_tex(end)}", f"y{end}", "m", "height of the block's base above the base")
        theta = coordinate(rf"\theta{_tex(end)}", f"theta{end}", "rad", "rotation, clockwise")
        parameters += [m, b, h, inertia]
        coordinates += [x, y, theta]

        middle = edge + b.symbol
        edge += 4 * b.symbol  # they stand apart by their width

        def place(point: Any, x: Any = x, y: Any = y, theta: Any = theta, at: Any = middle) -> Any:
            across, up = turned(point, (sp.S.Zero, sp.S.Zero), theta.position)
            return BASE.position + at + x.position + across, y.position + up

        bodies.append(
            Body(
                f"block{end}", m.symbol, place((sp.S.Zero, h.symbol)), inertia.symbol,
                theta.position, outline=rectangle(b.symbol, h.symbol),
            )
        )  # fmt: skip
        for side, foot in ((-1, "left"), (1, "right")):
            corner = place((side * b.symbol, sp.S.Zero))
            contacts.append(
                Contact(
                    f"{foot}{end}", corner[1], corner[0] - BASE.position - middle,
                    Rigid(restitution=RESTITUTION.symbol, friction=FRICTION.symbol, law=law),
                    place=corner,
                )
            )  # fmt: skip
    return Model(
        name=f"isolated_blocks_{blocks}",
        title="Blocks on an isolated base",
        parameters=(*parameters, GRAVITY, FRICTION, RESTITUTION, BASE_MASS, STIFFNESS, DAMPING),
        coordinates=tuple(coordinates),
        bodies=tuple(bodies),
        gravity=GRAVITY.symbol,
        rotation=coordinates[3],
        contacts=tuple(contacts),
        elements=(Spring("isolator", BASE.position, STIFFNESS.symbol, DAMPING.symbol),),
        falls=dict.fromkeys(coordinates[6::3], sp.pi / 2),
        load_point=bodies[1].position,
        reference="Vassiliou and Makris (2012)",
        members=bearings,
    )


def _base(half_width: sp.Expr) -> tuple[Body, tuple[Member, ...]]:
    """The base, a slab below the blocks, and bearings that a sketch shows under it."""
    b, thick = half_width, half_width / 6
    outline = ((-b, -thick), (b, -thick), (b, 0), (-b, 0))
    slab = Body("base", BASE_MASS.symbol, (BASE.position, sp.S.Zero), outline=outline)
    places = [b * sp.Rational(k, 4) for k in (-3, -1, 1, 3)]
    bearings = (Member("column", "ground", "base", (x, -2 * thick), (x, -thick)) for x in places)
    return slab, tuple(bearings)


def _sizes(end: str) -> list[Parameter]:
    """Half width, half height, mass and inertia of the block of that ending."""
    return [
        parameter(f"{letter}{_tex(end)}", f"{name}{end}", unit, meaning)
        for letter, name, unit, meaning in _BLOCK
    ]


_BLOCK = (
    ("b", "half_width", "m", "half of the width of a block"),
    ("h", "half_height", "m", "height of its centroid above its base"),
    ("m", "mass", "kg", "its mass"),
    ("I", "inertia", "kg m2", "its moment of inertia about its centroid"),
)


def _tex(end: str) -> str:
    return f"_{{{end.removeprefix('_')}}}" if end else ""
