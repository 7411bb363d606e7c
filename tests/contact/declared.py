"""Structures that no file of the package declares, to be derived in tests."""

from dataclasses import replace
from functools import cache

import sympy as sp

from rockeom.symbolic import (
    Body,
    Contact,
    Force,
    Model,
    Rigid,
    Unilateral,
    coordinate,
    feet,
    internal_variable,
    parameter,
    turned,
)
from rockeom.symbolic.lagrange import rate

X = coordinate("x", "x", "m", "place of the base's centre")
Y = coordinate("y", "y", "m", "height of the base's centre")
THETA = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
MASS = parameter("m", "mass", "kg", "mass")
HEIGHT = parameter("h", "height", "m", "height of the centroid above the base")
INERTIA = parameter("I", "inertia", "kg m2", "moment of inertia about the centroid")
GRAVITY = parameter("g", "gravity", "m/s2", "acceleration of gravity")
FRICTION = parameter("mu", "friction", "-", "coefficient of friction")
RESTITUTION = parameter("e", "restitution", "-", "ratio of the rates of a gap")
BLOCK = (MASS, HEIGHT, INERTIA, GRAVITY, FRICTION, RESTITUTION)
LAW = Rigid(restitution=RESTITUTION.symbol, friction=FRICTION.symbol)


def placed(point, x=X.position, y=Y.position, theta=THETA.position):
    """A point of a body whose base's centre is at (x, y)."""
    across, up = turned(point, (0, 0), theta)
    return x + across, y + up


def block() -> Body:
    return Body("block", MASS.symbol, placed((0, HEIGHT.symbol)), INERTIA.symbol, THETA.position)


def on_points(name: str, points: dict[str, tuple], *more, elements=(), laws=None) -> Model:
    """A block on points of any place on it, by name; laws : of those with one of their own."""
    laws = laws or {}
    found = (placed(point) for point in points.values())
    return Model(
        name=name,
        title="A block on points",
        parameters=(*BLOCK, *more),
        coordinates=(X, Y, THETA),
        bodies=(block(),),
        gravity=GRAVITY.symbol,
        rotation=THETA,
        contacts=tuple(
            Contact(of, gap=place[1], slip=place[0], law=laws.get(of, LAW))
            for of, place in zip(points, found, strict=True)
        ),
        elements=elements,
        load_point=block().position,
    )


@cache
def unequal_feet() -> Model:
    """Feet of different distances, heights and frictions: standing on both, it leans."""
    left, right = (parameter(f"b_{i}", f"{i}_width", "m", "distance") for i in ("left", "right"))
    leg = parameter("d", "leg", "m", "length of the right foot's leg")
    places = {"left": (-left.symbol, 0), "right": (right.symbol, -leg.symbol)}
    rough = Rigid(restitution=RESTITUTION.symbol / 2, friction=2 * FRICTION.symbol)
    return on_points("unequal_feet", places, left, right, leg, laws={"right": rough})


@cache
def on_a_step() -> Model:
    """The right foot is as much shorter as the step under it is high: friction at two heights."""
    b = parameter("b", "half_width", "m", "half of the distance of the feet")
    step = parameter("d", "step", "m", "height of the step")
    left, right = placed((-b.symbol, 0)), placed((b.symbol, step.symbol))
    return Model(
        name="on_a_step",
        title="A block on a step",
        parameters=(*BLOCK, b, step),
        coordinates=(X, Y, THETA),
        bodies=(block(),),
        gravity=GRAVITY.symbol,
        rotation=THETA,
        contacts=(
            Contact("left", gap=left[1], slip=left[0], law=LAW),
            Contact("right", right[1] - step.symbol, right[0], LAW, place=right),
        ),
    )


@cache
def four_feet() -> Model:
    """Feet at different heights: any two of them may stand together, no three; and a pad.

    The pad is on a shoulder of the block, which meets the ground only where the block lies down.
    """
    places = {
        "a": (-sp.Rational(3, 2), sp.Rational(1, 5)),
        "b": (-sp.Rational(1, 2), 0),
        "c": (sp.Rational(2, 5), 0),
        "d": (sp.Rational(7, 5), sp.Rational(3, 10)),
    }
    b = parameter("b", "half_width", "m", "unit of length of the base")
    points = {name: (x * b.symbol, y * b.symbol) for name, (x, y) in places.items()}
    k = parameter("k", "stiffness", "N/m", "stiffness of the pad")
    c = parameter("c", "damping", "N s/m", "damping of the pad")
    shoulder = placed((b.symbol, b.symbol))
    rubber = Unilateral("pad", -shoulder[1], stiffness=k.symbol, damping=c.symbol)
    return on_points("four_feet", points, b, k, c, elements=(rubber,))


@cache
def two_springs() -> Model:
    """A block on two springs and dampers that cannot pull, its base's centre guided."""
    k = parameter("k", "stiffness", "N/m", "stiffness of each spring")
    c = parameter("c", "damping", "N s/m", "damping of each damper")
    b = parameter("b", "half_width", "m", "half of the width of the base")
    v, theta = Y.position, THETA.position
    centre = v - MASS.symbol * GRAVITY.symbol / (2 * k.symbol)
    body = Body(
        "block",
        MASS.symbol,
        placed((0, HEIGHT.symbol), x=sp.S.Zero, y=centre),
        INERTIA.symbol,
        theta,
    )
    return Model(
        name="two_springs",
        title="A block on two springs",
        parameters=(MASS, HEIGHT, INERTIA, GRAVITY, k, c, b),
        coordinates=(THETA, Y),
        bodies=(body,),
        gravity=GRAVITY.symbol,
        rotation=THETA,
        elements=tuple(
            Unilateral(name, -end[1], k.symbol, c.symbol, place=end)
            for name, end in (
                (name, placed((s * b.symbol, 0), x=sp.S.Zero, y=centre))
                for name, s in (("left", -1), ("right", 1))
            )
        ),
        load_point=body.position,
    )


K = parameter("k", "stiffness", "N/m", "stiffness of a Maxwell element's spring")
TAU = parameter("tau", "relaxation", "s", "damping over stiffness of a Maxwell element")
PULL = internal_variable("z", "pull", "N", "force of a Maxwell element, positive in tension")
LIFT = block().position[1]


def maxwell(elongation: sp.Expr) -> dict:
    """A spring and a damper in a row, whose force is an internal variable."""
    force = Force("element", -PULL.symbol, elongation)
    stretched = K.symbol * rate(elongation, (X, Y, THETA))
    return {"forces": [force], "rates": {PULL: stretched - PULL.symbol / TAU.symbol}}


@cache
def pulled_block() -> Model:
    """A block on one point that a Maxwell element draws downwards."""
    return replace(on_points("pulled_block", {"tip": (0, 0)}, K, TAU), **maxwell(LIFT))


@cache
def braced_block() -> Model:
    """A block that slides, bounces and flies, held to a wall by a Maxwell element."""
    b = parameter("b", "half_width", "m", "half of the width of the base")
    at = parameter("a", "attached", "m", "height of the element above the base")
    of = on_points("braced_block", {"middle": (0, 0)}, b, K, TAU, at)
    on_feet = feet(
        gap=lambda s: placed((s * b.symbol, 0))[1],
        slip=lambda s: placed((s * b.symbol, 0))[0],
        law=LAW,
    )
    return replace(of, contacts=on_feet, **maxwell(placed((0, at.symbol))[0]))


def _of_two_bodies(name: str, more_symbols, more, second, upper, law) -> Model:
    """A block, and a body on its top, each in axes of the ground, from its mass centre.

    upper : places of the points of the second body by name, beside the ground.
    """
    b, h, m_2, i_2 = more_symbols
    x, y, theta = X.position, Y.position, THETA.position
    contacts = []
    for foot, s in (("left", -1), ("right", 1)):
        along, up = placed((s * b, -h))
        contacts.append(Contact(foot, gap=up, slip=along, law=law))
    for foot, place in upper.items():
        dx, dy = place[0] - x, place[1] - y
        contacts.append(
            Contact(
                foot,
                gap=dx * sp.sin(theta) + dy * sp.cos(theta) - h,
                slip=dx * sp.cos(theta) - dy * sp.sin(theta),
                law=law,
                place=place,
            )
        )
    centre, rotation = (c.position for c in second[:2]), second[2].position if second[2:] else 0
    bodies = (
        Body("lower", MASS.symbol, (x, y), INERTIA.symbol, theta),
        Body("upper", m_2, tuple(centre), i_2, rotation),
    )
    return Model(
        name=name,
        title="Two bodies in axes of the ground",
        parameters=(MASS, INERTIA, GRAVITY, *more),
        coordinates=(X, Y, THETA, *second),
        bodies=bodies,
        gravity=GRAVITY.symbol,
        rotation=THETA,
        contacts=tuple(contacts),
        load_point=(x, y),
    )


_HALF_WIDTH = parameter("b_1", "half_width", "m", "half of the width")
_HALF_HEIGHT = parameter("h_1", "half_height", "m", "half of the height")
_UPPER_MASS = parameter("m_2", "upper_mass", "kg", "mass")
X_2 = coordinate("x_2", "x2", "m", "place of the upper mass centre")
Y_2 = coordinate("y_2", "y2", "m", "height of the upper mass centre")
THETA_2 = coordinate("theta_2", "theta2", "rad", "rotation of the upper block")
NEVER = Rigid(restitution=sp.S.Zero, friction=None)


@cache
def block_and_load() -> Model:
    """A mass without a size on a block's top."""
    b, h, m_2 = (p.symbol for p in (_HALF_WIDTH, _HALF_HEIGHT, _UPPER_MASS))
    return _of_two_bodies(
        "block_and_load", (b, h, m_2, 0), (_HALF_WIDTH, _HALF_HEIGHT, _UPPER_MASS),
        (X_2, Y_2), {"foot": (X_2.position, Y_2.position)}, NEVER,
    )  # fmt: skip


@cache
def two_blocks() -> Model:
    """A block on a block, as `StackedBlocks`, in other coordinates."""
    upper = [
        parameter("b_2", "upper_half_width", "m", "half of the width"),
        parameter("h_2", "upper_half_height", "m", "half of the height"),
        parameter("I_2", "upper_inertia", "kg m2", "moment of inertia about the centroid"),
    ]
    b_2, h_2, i_2 = (p.symbol for p in upper)
    b, h, m_2 = (p.symbol for p in (_HALF_WIDTH, _HALF_HEIGHT, _UPPER_MASS))
    at = (X_2.position, Y_2.position, THETA_2.position)
    corners = {
        f"upper_{foot}": placed((s * b_2, -h_2), *at) for foot, s in (("left", -1), ("right", 1))
    }
    return _of_two_bodies(
        "two_blocks", (b, h, m_2, i_2), (_HALF_WIDTH, _HALF_HEIGHT, _UPPER_MASS, *upper),
        (X_2, Y_2, THETA_2), corners, NEVER,
    )  # fmt: skip
