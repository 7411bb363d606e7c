"""What a declaration of contacts must be, so that what is derived from it is what was meant.

Each check raises ValueError, which names the declaration, the item and the remedy. `check` looks
at names, symbols and expressions, when a model is made; `check_derived` at what follows from it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp

from rockeom.codes import MOST_CONTACT_STATES
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.check import (
    INTERNAL,
    RESPONSE,
    common_names,
    constants,
    contents,
    declared_kinds,
    distinct_symbols,
    fail,
    repeated,
    shape,
    sketched,
    springs_outputs,
)

if TYPE_CHECKING:
    from rockeom.symbolic.contacts import Contact, Model
    from rockeom.symbolic.model import Body


def check(model: Model) -> None:
    """Names, symbols and expressions of a declaration."""
    from rockeom.symbolic.contacts import Contact, Force
    from rockeom.symbolic.elements import Spring, Unilateral, Yielding

    _are(model, "bodies", _body_type())
    _are(model, "contacts", Contact)
    _are(model, "elements", Spring, Unilateral, Yielding)
    _are(model, "forces", Force)
    _rates(model)
    _names(model)
    distinct_symbols(model, [x for z in model.internal for x in (z.symbol, z.rate)])
    _signs_are_kept(model)
    if model.rotation not in model.coordinates:
        fail(model, f"the rotation {model.rotation.name!r} is not in `coordinates`")
    if not model.bodies:
        fail(model, "it has no bodies: declare the masses")
    if not model.contacts and not model.switching:
        fail(model, "nothing touches: declare `contacts`, or `elements` that press")
    for contact in model.contacts:
        _side(model, contact)
    sketched(model)
    known = declared_kinds(model) | {z.symbol: INTERNAL for z in model.internal}
    for item, expr, kinds in _expressions(model):
        contents(model, known, item, sp.sympify(expr), kinds)
    _moves(model)
    _are_few(model)
    _turns(model)
    for contact in model.contacts:
        for body in model.bodies:
            _turns_with(model, contact, body)


def _are_few(model: Model) -> None:
    """Refuse more combinations of states of elements than a structure may have contact states."""
    from rockeom.symbolic.beds import number_of_combinations

    ways, most = number_of_combinations(model.switching), MOST_CONTACT_STATES
    if ways > most:
        fail(
            model,
            f"its {len(model.switching)} elements have {ways} combinations of states, more than "
            f"{most}: declare fewer of them; n springs in a straight row whose damping is in one "
            "proportion to the stiffness have n (n + 1)/2 + 1, others 2^n",
        )


def check_derived(model: Model) -> None:
    """The modes of a declaration, and its mass matrix at random states."""
    from rockeom.symbolic.check import Sample, invertible

    invertible(model, model.free, Sample(model))
    _ = model.modes


def _body_type() -> type:
    from rockeom.symbolic.model import Body

    return Body


def _are(model: Model, item: str, *kinds: type) -> None:
    for x in getattr(model, item):
        if not isinstance(x, kinds):
            names = " or ".join(kind.__name__ for kind in kinds)
            fail(model, f"{item} holds {x!r}: give objects of {names}")


def _rates(model: Model) -> None:
    """A rate for each internal variable."""
    from rockeom.symbolic.model import Coordinate, InternalVariable

    if not isinstance(model.rates, Mapping):
        fail(model, f"rates is {model.rates!r}: give a mapping, {{z: its rate}}")
    for z, expr in model.rates.items():
        if isinstance(z, Coordinate):
            fail(
                model,
                f"rates holds the coordinate {z.name!r}, whose acceleration follows from masses "
                "and forces: declare these, or a state of its own by `internal_variable(...)`",
            )
        if not isinstance(z, InternalVariable):
            fail(model, f"rates holds {z!r}: give what `internal_variable(...)` returns")
        valid.expressions(f"{model.name}: rates", **{f"the rate of {z.name!r}": expr})


def _names(model: Model) -> None:
    common_names(model)
    for z in model.internal:
        valid.name(f"{model.name}: internal variable {z.symbol}", z.name)
    touching = [c.name for c in model.contacts] + [e.name for e in model.elements]
    for name in touching:
        valid.name(f"{model.name}: contact or element", name)
    outputs = outputs_of(model)
    for names in (
        [p.name for p in model.parameters] + list(model.states),
        [*model.states, *outputs],
        touching,
        [b.name for b in model.bodies],
        [f.name for f in model.forces],
    ):
        if repeated(names):
            fail(
                model,
                f"declared twice: {', '.join(repeated(names))}; give each a name of its own",
            )
    taken = sorted((RESPONSE - set(outputs)) & set(model.states))
    if taken:
        fail(model, f"every response calls something else {', '.join(taken)}: choose another name")


def outputs_of(model: Model) -> tuple[str, ...]:
    """What a response tells of the points and elements, by name."""
    points = [c.name for c in model.contacts]
    return (
        *(f"{name}_{what}" for name in points for what in ("reaction", "friction")),
        *(f"{name}_{what}" for name in points for what in ("uplift", "slip")),
        *(f"{e.name}_{what}" for e in model.switching for what in e.outputs),
        *springs_outputs(e.name for e in model.springs),
    )


def _signs_are_kept(model: Model) -> None:
    given = [p.symbol for p in model.parameters]
    given += [x for c in model.coordinates for x in (c.position, c.velocity, c.acceleration)]
    given += [z.symbol for z in model.internal]
    for symbol in given:
        if str(symbol).startswith((r"\sigma", r"\chi_")):
            fail(
                model,
                f"the symbol {symbol} is kept for the sign of a slip or the state of an element: "
                "choose another",
            )


def _side(model: Model, contact: Contact) -> None:
    """A point that is written with the side s has an image on the other side."""
    what = f"contact {contact.name!r}"
    sided = SIDE in contact.gap.free_symbols | contact.slip.free_symbols
    if contact.side not in (-1, 0, 1):
        fail(model, f"{what}: its side is {contact.side!r}: give -1, 0 or 1")
    if contact.side == 0 and sided:
        fail(model, f"{what}: its gap or slip contains the side s: declare both by `feet(...)`")
    images = [
        other
        for other in model.contacts
        if other.side == -contact.side
        and (other.gap, other.slip, other.law) == (contact.gap, contact.slip, contact.law)
    ]
    if contact.side and len(images) != 1:
        fail(
            model,
            f"{what}: it has the side {contact.side}, and no other point is its image: declare "
            "both by `feet(...)`, or write it without s, its side 0",
        )


def _expressions(model: Model) -> Iterator[tuple[str, Any, str]]:
    """(item, expression, what it may contain besides constants)."""
    yield "gravity", model.gravity, ""
    yield "overturning", model.overturning, ""
    yield from constants(model)
    yield "elastic energy", model.elastic_energy, "qz"
    yield "dissipation", model.dissipation, "qv"
    for b in model.bodies:
        of = f" of body {b.name!r}"
        yield f"mass{of}", b.mass, "q"
        yield f"inertia{of}", b.inertia, "q"
        yield f"rotation{of}", b.rotation, "q"
        for axis, e in zip("xy", b.position, strict=True):
            yield f"{axis}{of}", e, "q"
        yield from shape(b)
    for c in model.contacts:
        of = f" of contact {c.name!r}"
        yield f"gap{of}", c.gap, "qs"
        yield f"slip{of}", c.slip, "qs"
        for axis, e in zip("xy", c.place or (), strict=False):
            yield f"{axis} of the place{of}", e, "qs"
        yield f"restitution{of}", c.law.restitution, ""
        yield f"friction{of}", 0 if c.law.friction is None else c.law.friction, ""
    for element in model.elements:
        of = f" of element {element.name!r}"
        yield f"displacement{of}", element.displacement, "q"
        for constant, e in element.constants.items():
            yield f"{constant}{of}", e, ""
        for axis, e in zip("xy", getattr(element, "place", None) or (), strict=False):
            yield f"{axis} of the place{of}", e, "q"
    for spring in model.springs:
        yield f"initial force of element {spring.name!r}", spring.initial_force, ""
    for f in model.forces:
        yield f"value of force {f.name!r}", f.value, "qvz"
        yield f"displacement of force {f.name!r}", f.displacement, "q"
    for z, rate in model.rates.items():
        yield f"rate of {z.name!r}", rate, "qvz"
    for axis, e in zip("xy", model.load_point or (), strict=False):
        yield f"{axis} of the load point", e, "q"


def _moves(model: Model) -> None:
    """Gaps, slips and compressions are functions of coordinates, and no two are the same."""
    q = {c.position for c in model.coordinates}
    for c in model.contacts:
        for item, e in zip(("gap", "slip"), c.at(c.side), strict=True):
            if not sp.sympify(e).free_symbols & q:
                fail(
                    model,
                    f"the {item} of contact {c.name!r} is {e}, which no coordinate changes: write "
                    "it with the coordinates of the structure when nothing holds it",
                )
    for one, other in combinations(model.contacts, 2):
        if tidy(one.at(one.side)[0] - other.at(other.side)[0]) == 0:
            fail(
                model,
                f"the contacts {one.name!r} and {other.name!r} have the same gap: they are one "
                "point; declare it once",
            )
    for element in model.elements:
        if not sp.sympify(element.displacement).free_symbols & q:
            fail(
                model,
                f"the displacement of element {element.name!r} is {element.displacement}, which no "
                "coordinate changes",
            )
    for f in model.forces:
        if not sp.sympify(f.displacement).free_symbols & q:
            fail(
                model,
                f"the displacement of force {f.name!r} is {f.displacement}, which no coordinate "
                "changes: the force does no work",
            )


def _turns(model: Model) -> None:
    theta = model.rotation.position
    if not any(sp.sympify(b.rotation).has(theta) for b in model.bodies):
        fail(
            model,
            f"no body turns with the rotation {model.rotation.name!r}: declare the angle through "
            "which each turns, clockwise, as `Body(..., rotation=...)`",
        )


def _turns_with(model: Model, contact: Contact, body: Body) -> None:
    """A point that is fixed to a body turns as the body says: clockwise by its rotation.

    It is taken for a point of the body where its distance from the centroid never changes, the
    slip and the gap being its place in the body's axes.
    """
    gap, slip = contact.at(contact.side)
    across, up = slip - body.position[0], gap - body.position[1]
    q = [c.position for c in model.coordinates]
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
            fail(
                model,
                f"contact {contact.name!r} is a point of body {body.name!r}, which turns clockwise "
                f"by {turning}, and the point does not: place both by `turned(point, about, "
                "angle)`, with one angle",
            )
