"""Bodies of sympy.physics.mechanics as models: equations, motions, and declarations refused."""

from functools import cache
from typing import Any, NamedTuple

import pytest
import sympy as sp
from sympy.physics import mechanics as me

import rockeom as rk
from rockeom import symbolic
from rockeom.symbolic import Contact, Force, Model, Pinned, Rigid, Spring, feet
from rockeom.symbolic.lagrange import derive_equations

x, y, theta, phi = COORDINATES = me.dynamicsymbols("x y theta phi")
m, b, h, inertia, g, k, ell = SYMBOLS = sp.symbols("m b h I g k ell", positive=True)
N = me.ReferenceFrame("N")
O = me.Point("O")  # noqa: E741
O.set_vel(N, 0)
WORDS = {
    x: ("x", "m", "place of the base's centre"),
    y: ("y", "m", "height of the base's centre"),
    theta: ("theta", "rad", "rotation, positive clockwise"),
    phi: ("phi", "rad", "rotation of the pendulum from the block, counterclockwise"),
}
PARAMETERS = {
    m: ("mass", "kg", "mass"),
    b: ("half_width", "m", "half of the width"),
    h: ("height", "m", "height of the centroid"),
    inertia: ("inertia", "kg m2", "moment of inertia about the centroid"),
    g: ("gravity", "m/s2", "acceleration of gravity"),
    k: ("stiffness", "N m", "of the pendulum's hinge"),
    ell: ("length", "m", "of the pendulum"),
}


class Block(NamedTuple):
    """A rigid body, its frame, its base's centre and its feet."""

    body: Any
    frame: Any
    base: Any
    left: Any
    right: Any


@cache
def block(angle: sp.Expr = -theta) -> Block:
    frame = me.ReferenceFrame("A")
    frame.orient_axis(N, N.z, angle)
    base = O.locatenew("C", x * N.x + y * N.y)
    centroid = base.locatenew("G", h * frame.y)
    for point in (base, centroid):
        point.set_vel(N, point.pos_from(O).dt(N))
    body = me.RigidBody("block", centroid, frame, m, (me.inertia(frame, 0, 0, inertia), centroid))
    left, right = base.locatenew("L", -b * frame.x), base.locatenew("R", b * frame.x)
    return Block(body, frame, base, left, right)


def declared(*bodies, coordinates=(x, y, theta), **changes) -> Model:
    words = coordinates if isinstance(coordinates, dict) else {q: WORDS[q] for q in coordinates}
    return from_mechanics(bodies=bodies or (block().body,), coordinates=words, **changes)


def from_mechanics(**changes) -> Model:
    its = block()
    law = Rigid(restitution=0, friction=sp.Rational(3, 10))
    arguments = {
        "bodies": [its.body], "coordinates": {q: WORDS[q] for q in (x, y, theta)},
        "name": "declared", "title": "Declared by mechanics", "frame": N, "origin": O,
        "gravity": g, "rotation": theta,
        "parameters": PARAMETERS,
        "contacts": {"left": (its.left, law), "right": (its.right, law)},
    } | changes  # fmt: skip
    return Model.from_mechanics(**arguments)


def lagrange(model: Model, bodies, forces=()) -> sp.Matrix:
    """Equations of sympy.physics.mechanics less those of the model in flight, on quiet ground."""
    weight = {body: body.mass * g * body.masscenter.pos_from(O).dot(N.y) for body in bodies}
    own = {body: body.potential_energy for body in bodies}
    for body in bodies:
        body.potential_energy = own[body] + weight[body]
    try:
        energy = me.Lagrangian(N, *bodies)
    finally:
        for body in bodies:
            body.potential_energy = own[body]
    by_name = {str(q.func): q for q in COORDINATES}
    q = [by_name[c.name] for c in model.coordinates]
    theirs = me.LagrangesMethod(
        energy, q, forcelist=list(forces), frame=N
    ).form_lagranges_equations()
    still = dict.fromkeys(me.dynamicsymbols("a_x a_y"), 0)
    flight = derive_equations(model.free).dynamic().residual.xreplace(still)
    return (theirs - flight).applyfunc(lambda e: sp.trigsimp(sp.expand(sp.expand_trig(e))))


def pendulum() -> tuple[Any, Any]:
    """A particle on a rod, hinged to the top of the block with an angle from it, and its frame."""
    its = block()
    frame = me.ReferenceFrame("P")
    frame.orient_axis(its.frame, its.frame.z, phi)
    hinge = its.base.locatenew("H", 2 * h * its.frame.y)
    bob = hinge.locatenew("bob", ell * frame.y)
    bob.set_vel(N, bob.pos_from(O).dt(N))
    rod = me.RigidBody("rod", bob, frame, m, (me.inertia(frame, 0, 0, inertia), bob))
    return rod, frame


def test_free_block_has_the_equations_of_lagranges_method():
    model = declared(load_point=block().body.masscenter)
    assert lagrange(model, [block().body]) == sp.zeros(3, 1)
    assert model.load_point == model.bodies[0].position


def test_two_bodies_with_a_spring_between_them_have_the_equations_of_lagranges_method():
    """The spring once as potential energy of a body, and once as an element."""
    rod, _ = pendulum()
    bodies = (block().body, rod)
    hinged = declared(*bodies, coordinates=COORDINATES, elements=[Spring("hinge", phi, k)])
    rod.potential_energy = k * phi**2 / 2
    model = declared(*bodies, coordinates=COORDINATES)
    assert lagrange(model, bodies) == sp.zeros(4, 1)
    one, other = (derive_equations(m.free) for m in (model, hinged))
    assert one.elastic_forces == other.elastic_forces != sp.zeros(4, 1)
    turn, inner = (c.position for c in model.coordinates[2:])
    assert model.bodies[1].rotation == turn - inner  # clockwise


def test_motion_of_a_block_is_that_of_the_sliding_block():
    values = {"mass": 2.0, "half_width": 0.25, "height": 1.0, "inertia": 0.7, "gravity": 9.81}
    used = {symbol: PARAMETERS[symbol] for symbol in SYMBOLS[:5]}
    ours = rk.structure(declared(parameters=used), **values)
    shipped = rk.SlidingBlock(
        half_width=0.25, half_height=1.0, mass=2.0, inertia=0.7, friction=0.3, restitution=0.0
    )
    pulse = rk.GroundMotion.single_sine(amplitude=3.2, period=0.8, duration=3.0)
    one, other = (rk.simulate(structure, pulse) for structure in (ours, shipped))
    assert len(one.events) > 3
    assert [event.kind for event in one.events] == [event.kind for event in other.events]
    assert one["theta"] == pytest.approx(other["theta"], abs=1e-7)


def test_pinned_feet_give_the_equation_of_the_rigid_block():
    its = block()

    def foot(side):
        return its.base.locatenew("F", side * b * its.frame.x).pos_from(O)

    model = declared(
        contacts=feet(gap=lambda s: foot(s).dot(N.y), slip=lambda s: foot(s).dot(N.x), law=Pinned())
    )
    ours, shipped = model.reduced.equations("right"), symbolic.rigid_block()
    theirs = shipped.equations("right")
    named = {p.symbol: p.name for p in shipped.parameters}
    same = {
        s: next(k for k, (n, *_) in PARAMETERS.items() if n == name) for s, name in named.items()
    }
    for item in ("mass_matrix", "forcing"):
        difference = getattr(ours, item) - getattr(theirs, item).xreplace(same)
        assert difference.applyfunc(sp.expand) == sp.zeros(1, 1)


def test_inertia_about_another_point_is_moved_to_the_mass_centre():
    its = block()
    about_base = me.inertia(its.frame, 0, 0, inertia + m * h**2)
    body = me.RigidBody("block", its.body.masscenter, its.frame, m, (about_base, its.base))
    assert sp.expand(declared(body).bodies[0].inertia - inertia) == 0


def test_particles_forces_and_further_places_are_written_in_the_coordinates():
    top = block().base.locatenew("T", 2 * h * block().frame.y)
    load = me.Particle("box", top, m)
    model = declared(
        block().body, load, forces=[Force("drag", -k * x.diff(), x)], load_point=top,
        falls={x: b}, outlines={block().body: symbolic.rectangle(b, h)},
    )  # fmt: skip
    turn = sp.Symbol("theta", real=True)
    assert model.bodies[1].inertia == model.bodies[1].rotation == 0
    assert model.load_point == model.bodies[1].position
    assert model.load_point[1] == sp.Symbol("y", real=True) + 2 * h * sp.cos(turn)
    assert model.forces[0].value == -k * model.coordinates[0].velocity
    assert dict(model.falls) == {model.coordinates[0]: b}
    assert model.bodies[0].outline == symbolic.rectangle(b, h)


def test_gravity_may_be_a_number():
    used = {symbol: PARAMETERS[symbol] for symbol in SYMBOLS[:4]}
    assert declared(gravity=9.81, parameters=used).gravity == 9.81


# --- declarations that are refused


def tilted() -> Any:
    frame = me.ReferenceFrame("T")
    frame.orient_axis(N, N.x, theta)
    return me.RigidBody("block", block().base, frame, m, (me.inertia(frame, 1, 1, 1), block().base))


def floating(place) -> Any:
    return me.Particle("load", O.locatenew("P", place), m)


def heavy() -> Any:
    load = floating(x * N.x + y * N.y)
    load.potential_energy = m * g * y
    return load


u, t = me.dynamicsymbols("u"), me.dynamicsymbols._t
FORGOTTEN = {symbol: PARAMETERS[symbol] for symbol in (m, h)}
REFUSED = {
    "turns out of the plane": (lambda: declared(tilted()), "orientation of body 'block' is not in"),
    "leaves the plane": (
        lambda: declared(block().body, floating(x * N.z)), "'load' leaves the plane: along N.z",
    ),
    "no coordinate": (
        lambda: declared(block().body, floating(u * N.x)), "position of body 'load' contains u(t)",
    ),
    "speed for a rate": (
        lambda: declared(forces=[Force("drag", -k * u, x)]), "value of 'drag' contains u(t), none",
    ),
    "speed for a coordinate": (
        lambda: declared(coordinates={**{q: WORDS[q] for q in (x, y, theta)}, u: WORDS[x]}),
        "coordinates holds u(t), which no point",
    ),
    "rate for a coordinate": (
        lambda: declared(coordinates={x.diff(): WORDS[x]}), "and no derivative",
    ),
    "coordinates without words": (
        lambda: declared(coordinates={x: "place"}), "x(t) is described by",
    ),
    "moves by itself": (
        lambda: declared(block().body, floating(sp.sin(t) * N.x)), "changes with the time t",
    ),
    "moving origin": (lambda: declared(origin=block().base), "origin is C, which moves by"),
    "frame of a body": (lambda: declared(frame=block().frame), "frame is A, which is that of"),
    "no frame": (lambda: declared(frame="N"), "give the ReferenceFrame"),
    "no origin": (lambda: declared(origin=(0, 0)), "give the Point"),
    "no bodies": (lambda: declared("block"), "give objects of RigidBody or Particle"),
    "points that hang in the air": (
        lambda: declared(me.Particle("load", me.Point("P"), m)), "by `set_pos` or `locatenew`",
    ),
    "frames that are not oriented": (
        lambda: declared(me.RigidBody("b", block().base, me.ReferenceFrame("B"), m)), "orient_axis",
    ),
    "an angle by another law": (lambda: declared(block(sp.asin(x / b)).body), "not linear in x"),
    "parameters forgotten": (
        lambda: declared(parameters=FORGOTTEN), "parameters lacks I, b, g: give each symbol",
    ),
    "weight counted twice": (lambda: declared(heavy()), "potential energy of body 'load' contains"),
    "one body and no list": (lambda: from_mechanics(bodies=block().body), "give a list"),
    "one contact and no list": (
        lambda: declared(contacts=Contact("left", y, x, Rigid())), "contacts is Contact(",
    ),
    "parameters as a list": (lambda: declared(parameters=[m, h]), "give a mapping, such as {m: ("),
    "gravity as a text": (lambda: declared(gravity="9.81"), "gravity is '9.81'"),
    "rotation is no coordinate": (lambda: declared(rotation=phi), "name one of `coordinates`"),
    "contact without a law": (
        lambda: declared(contacts={"left": block().left}), "give (Point, law)",
    ),
    "outline of another body": (lambda: declared(outlines={tilted(): ()}), "outlines holds block"),
    "contact in another's symbols": (
        lambda: declared(contacts=[Contact("left", phi, x, Rigid())]), "gap of 'left' contains phi",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_a_declaration_that_cannot_be_meant_is_refused_by_name(case):
    declare, message = REFUSED[case]
    with pytest.raises(ValueError, match=r"^declared: ") as error:
        declare()
    assert message in str(error.value)
