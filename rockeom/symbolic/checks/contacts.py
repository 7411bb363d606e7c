"""Checks of contacts and elements, of which modes are derived."""

from collections.abc import Mapping
from itertools import combinations

import sympy as sp

from rockeom.codes import MOST_MODES, MOST_POINTS_IN_SPACE
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.beds import number_of_combinations
from rockeom.symbolic.checks.common import (
    Expressions,
    ModelError,
    Names,
    body_expressions,
    naming,
    springs_outputs,
)
from rockeom.symbolic.contacts import Contact, ContactDeclaration, Force, Rigid
from rockeom.symbolic.elements import Damper, Pulse, Spring, Tie, Unilateral, Yielding
from rockeom.symbolic.model import Body, Coordinate, InternalVariable, Tilt


def check_items(of: ContactDeclaration) -> None:
    """The lists of a declaration hold what belongs there."""
    with naming(of.name):
        if not isinstance(of.falls, Mapping):
            raise ModelError(f"falls is {of.falls!r}: give a mapping, {{coordinate: size}}")
        _are(of, "bodies", Body)
        _are(of, "contacts", Contact)
        _are(of, "elements", Spring, Damper, Pulse, Tie, Unilateral, Yielding)
        _are(of, "forces", Force)
        _rates(of)


def _are(of: ContactDeclaration, item: str, *kinds: type) -> None:
    for x in getattr(of, item):
        if not isinstance(x, kinds):
            names = " or ".join(kind.__name__ for kind in kinds)
            raise ModelError(f"{item} holds {x!r}: give objects of {names}")


def _rates(of: ContactDeclaration) -> None:
    """A rate for each internal variable."""
    if not isinstance(of.rates, Mapping):
        raise ModelError(f"rates is {of.rates!r}: give a mapping, {{z: its rate}}")
    for z, expr in of.rates.items():
        if isinstance(z, Coordinate):
            raise ModelError(
                f"rates holds the coordinate {z.name!r}, whose acceleration follows from masses "
                "and forces: declare these, or a state of its own by `internal_variable(...)`",
            )
        if not isinstance(z, InternalVariable):
            raise ModelError(f"rates holds {z!r}: give what `internal_variable(...)` returns")
        valid.expressions(f"{of.name}: rates", **{f"the rate of {z.name!r}": expr})


def names_of_contacts(of: ContactDeclaration) -> Names:
    """Names of internal variables, contacts, elements, bodies and forces."""
    named = [c.name for c in of.contacts] + [e.name for e in of.elements]
    items = [(f"internal variable {z.symbol}", z.name) for z in of.internal]
    named += of.limits
    items += [("contact, element or bound", name) for name in named]
    outputs, states = outputs_of(of), of.states
    bodies, forces = [b.name for b in of.bodies], [f.name for f in of.forces]
    distinct = [[*states, *outputs], named, bodies, forces]
    return Names(items, distinct, {*states} - {*outputs})


def outputs_of(of: ContactDeclaration) -> tuple[str, ...]:
    """Names of the quantities of points and elements in a response."""
    points = [c.name for c in of.contacts]
    return (
        *(f"{name}_{what}" for name in points for what in what_of_points(of)),
        *(f"{e.name}_{what}" for e in of.switching for what in e.outputs),
        *springs_outputs(e.name for e in of.springs),
    )


def what_of_points(of: ContactDeclaration) -> tuple[str, ...]:
    """Words of the quantities of a point."""
    if of.by_code:
        return "reaction", "friction_x", "friction_y", "uplift", "slip_x", "slip_y"
    return "reaction", "friction", "uplift", "slip"


def check_contacts(of: ContactDeclaration) -> None:
    """Symbols, the rotation, masses, and pairs of points."""
    _reserved_symbols(of)
    if of.rotation not in of.coordinates:
        raise ModelError(f"the rotation {of.rotation.name!r} is not in `coordinates`")
    if not of.bodies:
        raise ModelError("it has no bodies: declare the masses")
    axes = {len(b.position) for b in of.bodies}
    if len(axes) > 1:
        raise ModelError("some of its bodies have places (x, y), others (x, y, z): give all three")
    if not of.contacts and not of.switching and not of.bounds:
        raise ModelError(
            "nothing touches: declare `contacts`, or `elements` that press, or by `bounds` where "
            "the coordinates alone keep the bodies on what carries them"
        )
    _tilts(of)
    if of.contacts:
        _roll(of)
        _are_in_space(of) if axes == {3} else _are_in_plane(of)
    for contact in of.contacts:
        if contact.law.law != of.impact_law:
            raise ModelError(
                f"contact {contact.name!r} has the impact law {contact.law.law!r}, and "
                f"{of.contacts[0].name!r} has {of.impact_law!r}: points that meet at once have "
                "one law",
            )
    for contact in of.contacts:
        _side(of, contact)


def check_places(of: ContactDeclaration) -> None:
    """Coordinates move contacts and elements, and points turn with their bodies."""
    _moves(of)
    _are_few(of)
    _turns(of)
    for contact in of.contacts if of.axes == 2 else ():
        for body in of.bodies:
            _turns_with(of, contact, body)


def _tilts(of: ContactDeclaration) -> None:
    """A body overturns by its tilt below a quarter turn, at which its angles are singular."""
    for tilt, size in of.falls.items():
        if not isinstance(tilt, Tilt):
            continue
        if not of.by_code:
            raise ModelError(f"falls: {tilt.name!r} is a tilt, and it has no contacts in space")
        angle = sp.sympify(size)
        if angle.is_nonpositive or (sp.pi / 2 - angle).is_nonpositive:
            raise ModelError(
                f"falls: the size of {tilt.name!r} is {size}: give an angle between 0 and pi/2"
            )


def _are_in_plane(of: ContactDeclaration) -> None:
    for c in of.contacts:
        if len(c.slips) > 1:
            raise ModelError(
                f"its bodies move in a plane, and contact {c.name!r} in space: give one slip"
            )


def _are_in_space(of: ContactDeclaration) -> None:
    """Points slip along x and y, by one law of friction each; and no element switches."""
    for c in of.contacts:
        what = f"contact {c.name!r}"
        if len(c.slips) != 2:
            raise ModelError(
                f"its bodies move in space, and {what} in the plane: declare it by "
                "`space.feet(...)`, or leave `contacts` out, and let the coordinates hold the "
                "bodies on the ground, as those of `space.wobble`"
            )
        _has_law_in_space(what, c.law)
    if of.switching:
        raise ModelError(
            f"element {of.switching[0].name!r} switches, and a structure with contacts in space "
            "has springs alone: declare a Spring"
        )
    if len(of.contacts) > (most := MOST_POINTS_IN_SPACE):
        raise ModelError(f"it has {len(of.contacts)} contacts: declare at most {most} in space")


def _has_law_in_space(what: str, law: Rigid) -> None:
    """Moreau's law, with one restitution, and Newton's where that is the same."""
    if law.law not in ("newton", "moreau"):
        raise ModelError(
            f"{what} has the impact law {law.law!r}, by which a slip turns within an impact in "
            "space: give 'moreau'"
        )
    if law.tangential is not None:
        raise ModelError(
            f"{what} has a restitution of its slip, with which Moreau's law may gain energy: leave "
            "`tangential` out, for that of its gap"
        )
    if law.law == "newton" and not law.frictionless and not sp.sympify(law.restitution).is_zero:
        raise ModelError(
            f"{what} has restitution and friction, with which Newton's law may gain energy: give "
            "law='moreau'"
        )


def _roll(of: ContactDeclaration) -> None:
    """A rim rolls without slip or slips freely, and a bound ends the motion where it lies flat."""
    for c in of.contacts:
        if not c.material:
            continue
        if len(c.slips) != 2 or not (c.law.friction is None or c.law.frictionless):
            raise ModelError(
                f"contact {c.name!r} rolls, with the friction {c.law.friction}: in space a rim "
                "rolls without slip, friction=None, or slips freely, friction=0"
            )
        if not of.bounds:
            raise ModelError(
                f"contact {c.name!r} is a rim, which has no lowest point where it lies flat: give "
                "`bounds=space.flat(frame)`"
            )


def _reserved_symbols(of: ContactDeclaration) -> None:
    given = [p.symbol for p in of.parameters]
    given += [x for c in of.coordinates for x in (c.position, c.velocity, c.acceleration)]
    given += [z.symbol for z in of.internal]
    for symbol in given:
        if str(symbol).startswith((r"\sigma", r"\chi_")):
            raise ModelError(
                f"the symbol {symbol} is reserved for the sign of a slip or the state of an "
                "element: choose another",
            )


def _are_few(of: ContactDeclaration) -> None:
    """Refuse more combinations of states of elements than a structure may have modes."""
    ways, most = number_of_combinations(of.switching), MOST_MODES
    if ways > most:
        raise ModelError(
            f"its {len(of.switching)} elements have {ways} combinations of states, more than "
            f"{most}: declare fewer of them; n springs in a straight row whose damping is in one "
            "proportion to the stiffness have n (n + 1)/2 + 1, others 2^n",
        )


def _side(of: ContactDeclaration, contact: Contact) -> None:
    """A point that is written with the side s has an image on the other side."""
    what = f"contact {contact.name!r}"
    sided = any(sp.sympify(e).has(SIDE) for e in (contact.gap, *contact.slips))
    if contact.side not in (-1, 0, 1):
        raise ModelError(f"{what}: its side is {contact.side!r}: give -1, 0 or 1")
    if contact.side == 0 and sided:
        raise ModelError(
            f"{what}: its gap or slip contains the side s: declare both by `feet(...)`"
        )
    images = [
        other
        for other in of.contacts
        if other.side == -contact.side
        and (other.gap, other.slip, other.law) == (contact.gap, contact.slip, contact.law)
    ]
    if contact.side and len(images) != 1:
        raise ModelError(
            f"{what}: it has the side {contact.side}, and no other point is its image: declare "
            "both by `feet(...)`, or write it without s, its side 0",
        )


def expressions_of_contacts(of: ContactDeclaration) -> Expressions:
    """(item, expression, what it may contain besides constants)."""
    yield "gravity", of.gravity, ""
    yield "elastic energy", of.elastic_energy, "qz"
    yield "dissipation", of.dissipation, "qv"
    for b in of.bodies:
        yield from body_expressions(b, f" of body {b.name!r}", "q")
    for c in of.contacts:
        where = f" of contact {c.name!r}"
        yield f"gap{where}", c.gap, "qs"
        for slip in c.slips:
            yield f"slip{where}", slip, "qs"
        for axis, e in zip("xyz", c.place or (), strict=False):
            yield f"{axis} of the place{where}", e, "qs"
        yield f"restitution{where}", c.law.restitution, ""
        yield f"friction{where}", 0 if c.law.friction is None else c.law.friction, ""
        yield f"stiffness{where}", c.law.stiffness, ""
        yield f"tangential{where}", 0 if c.law.tangential is None else c.law.tangential, ""
    for element in of.elements:
        where = f" of element {element.name!r}"
        yield f"displacement{where}", element.displacement, "q"
        for constant, e in element.constants.items():
            yield f"{constant}{where}", e, ""
        for of_point in ("place", "end"):
            for axis, e in zip("xy", getattr(element, of_point, None) or (), strict=False):
                yield f"{axis} of the {of_point}{where}", e, "q"
        yield f"initial force{where}", getattr(element, "initial_force", sp.S.Zero), ""
    for f in of.forces:
        for value, displacement in f.components:
            yield f"value of force {f.name!r}", value, "qvz"
            yield f"displacement of force {f.name!r}", displacement, "q"
    for name, e in of.limits.items():
        yield f"bound {name!r}", e, "q"
    for z, rate in of.rates.items():
        yield f"rate of {z.name!r}", rate, "qvz"
    for axis, e in zip("xy", of.load_point or (), strict=False):
        yield f"{axis} of the load point", e, "q"


def _moves(of: ContactDeclaration) -> None:
    """Gaps, slips and compressions are functions of coordinates, and no two are the same."""
    q = {c.position for c in of.coordinates}
    for c in of.contacts:
        for item, e in zip(("gap", "slip", "slip"), c.at(c.side), strict=False):
            if not sp.sympify(e).free_symbols & q:
                raise ModelError(
                    f"the {item} of contact {c.name!r} is {e}, which no coordinate changes: write "
                    "it with the coordinates of the structure when nothing holds it",
                )
    for one, other in combinations(of.contacts, 2):
        if tidy(one.at(one.side)[0] - other.at(other.side)[0]) == 0:
            raise ModelError(
                f"the contacts {one.name!r} and {other.name!r} have the same gap: they are one "
                "point; declare it once",
            )
    for element in of.elements:
        if not sp.sympify(element.displacement).free_symbols & q:
            raise ModelError(
                f"the displacement of element {element.name!r} is {element.displacement}, which no "
                "coordinate changes",
            )
    for f in of.forces:
        if not any(sp.sympify(w).free_symbols & q for _, w in f.components):
            raise ModelError(
                f"the displacement of force {f.name!r} is {f.displacement}, which no coordinate "
                "changes: the force does no work",
            )


def _turns(of: ContactDeclaration) -> None:
    theta = of.rotation.position
    if not any(sp.sympify(b.rotation).has(theta) for b in of.bodies):
        raise ModelError(
            f"no body turns with the rotation {of.rotation.name!r}: declare the angle through "
            "which each turns, clockwise, as `Body(..., rotation=...)`",
        )


def _turns_with(of: ContactDeclaration, contact: Contact, body: Body) -> None:
    """A point that is fixed to a body turns as the body says: clockwise by its rotation.

    It is a point of the body where its distance from the centroid never changes, the
    slip and the gap being its place in the body's axes.
    """
    gap, slip = contact.at(contact.side)
    across, up = slip - body.position[0], gap - body.position[1]
    q = [c.position for c in of.coordinates]
    turning = sp.sympify(body.rotation)
    if not turning.free_symbols & set(q):
        return
    distance = tidy(across**2 + up**2)
    if distance.free_symbols & set(q):
        return
    for x in q:
        rate = sp.diff(turning, x)
        lacking = [sp.diff(across, x) - rate * up, sp.diff(up, x) + rate * across]
        if any(tidy(e) != 0 for e in lacking):
            raise ModelError(
                f"contact {contact.name!r} is a point of body {body.name!r}, which turns clockwise "
                f"by {turning}, and the point does not: place both by `turned(point, about, "
                "angle)`, with one angle",
            )
