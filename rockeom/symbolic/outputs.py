"""Outputs of a state, by name: places, energies, kinematics, statics, powers, elements of a mode.

They are functions of a model and one of its modes. Elements of a search act by their states, chi.
Places are (x, y) in axes that move with the ground, x to the right and y upwards; in space (x, y,
z), z upwards.
"""

from collections.abc import Iterable
from typing import Any, NamedTuple, Self

import sympy as sp

from rockeom.symbolic.algebra import tidy
from rockeom.symbolic.contacts import Contact, ContactDeclaration
from rockeom.symbolic.elements import Damper, Element, Pulse, Spring, Switching, Tie, switch_of
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import Coordinate, Member, Point
from rockeom.symbolic.reactions import reactions
from rockeom.symbolic.statics import equilibrium

LOAD_POINT = "load"
BODY, MASSLESS, FOOT, POINT, DAMPED = "body", "massless", "foot", "point", "spring_and_damper"
END = "end"
WALL_LEFT, WALL_RIGHT = "wall_on_the_left", "wall_on_the_right"


class Place(NamedTuple):
    """A body's centre, with the angle through which the body turns; or a point.

    In space the rotation has the nine entries of the body's matrix, row by row.

    kind : "body", or "massless", a body for sketches; "foot", above rigid ground, or beside a wall
    that stands, "wall_on_the_left" or "wall_on_the_right"; "point", that touches another body;
    "spring" or "spring_and_damper", which carry it; "tendon", "damper" or "push", an element of
    that kind, and "end", the other end of one; "load".
    """

    kind: str
    at: Point
    rotation: tuple[sp.Expr, ...]

    @classmethod
    def of(cls, kind: str, at: Point, rotation: Any = sp.S.Zero) -> Self:
        """rotation : that of a `Body`; none of a point."""
        if len(at) == 2:
            return cls(kind, at, (rotation,))
        return cls(kind, at, tuple(sp.eye(3) if rotation == 0 else rotation))


def places(model: HybridModel, mode: Mode) -> dict[str, Place]:
    """Places of bodies, feet or contacts, springs and the load point, by name, in a mode."""
    found = [
        (b.name, Place.of(BODY if b.mass != 0 else MASSLESS, b.position, b.rotation))
        for b in mode.bodies
    ]
    if model.search is not None:
        of = model.search.of
        found += [(c.name, Place.of(_touches(of, c), c.point)) for c in of.contacts]
        for e in of.switching:
            if e.place is not None:
                found.append((e.name, Place.of(e.drawn, e.place)))
        found += [(m.end, Place.of(END, end)) for m, end in drawn(model)]
    else:
        found += [
            (name, Place.of(DAMPED if foot.sprung else FOOT, foot.position))
            for name, foot in sorted(mode.feet.items())
        ]
    if mode.load_point is not None:
        found.append((LOAD_POINT, Place.of(LOAD_POINT, mode.load_point)))
    return dict(found)


def drawn(model: HybridModel) -> list[tuple[Member, Point]]:
    """Members for elements that have two ends, each with the place of the other end."""
    return [
        (Member(e.drawn, e.name, f"{e.name} end"), e.end)
        for e, _ in switching(model)
        if isinstance(e, Tie | Damper) and e.place is not None and e.end is not None
    ]


def names_of(model: HybridModel) -> list[str]:
    """All names of places, which must differ."""
    if model.search is not None:
        of = model.search.of
        points = [*(c.name for c in of.contacts), *(e.name for e in of.switching)]
        points += [m.end for m, _ in drawn(model)]
    else:
        points = sorted(model.modes[0].feet)
    return [*(b.name for b in model.bodies), *points, LOAD_POINT]


def _touches(of: ContactDeclaration, contact: Contact) -> str:
    """Kind of a contact: with the ground or a wall, if the end of its gap does not move.

    A surface that moves along below a foot is no ground: the foot slips on it by another distance
    than it moves. A foot that rolls does so, too, and the difference is a rotation.
    """
    if of.axes == 3:
        return FOOT
    x, y = contact.point
    gap, slip = contact.at(contact.side)
    moving = {c.position for c in of.coordinates}
    along = {c.position for c in of.coordinates if c.unit != "rad"}
    if not tidy(y - gap).free_symbols & moving:
        return POINT if tidy(x - slip).free_symbols & along else FOOT
    for kind, end in ((WALL_LEFT, x - gap), (WALL_RIGHT, x + gap)):
        if not tidy(end).free_symbols & moving:
            return kind
    return POINT


# -- elements ----------------------------------------------------------------------------------


class Acting(NamedTuple):
    """An element, and the symbol of its state: 1 of a spring, which always acts."""

    element: Element
    chi: sp.Expr


def elements(model: HybridModel, mode: Mode) -> tuple[Acting, ...]:
    """All elements of a mode, in the order in which they are declared."""
    if model.search is None:
        return tuple(Acting(e, sp.S.One) for e in mode.elements)
    found: list[Acting] = []
    switches = 0
    for e in model.search.of.elements:
        always = isinstance(e, Spring)
        found.append(Acting(e, sp.S.One if always else switch_of(switches)))
        switches += not always
    return tuple(found)


def switching(model: HybridModel) -> tuple[tuple[Switching, sp.Expr], ...]:
    """Elements with states, each with the symbol of its state."""
    if model.search is None:
        return ()
    return tuple((e, switch_of(i)) for i, e in enumerate(model.search.of.switching))


def of_element(acting: Acting, coordinates: tuple[Coordinate, ...]) -> tuple[sp.Expr, ...]:
    """Deformation [m], force [N], energy [J] and power lost [W]."""
    e, chi = acting
    return e.output_displacement, e.force(chi, coordinates), e.energy(chi), e.loss(chi, coordinates)


# -- energies, motion and equilibrium ----------------------------------------------------------


def energies(model: HybridModel, mode: Mode) -> dict[str, sp.Expr]:
    """Kinetic, gravitational and elastic energy [J]."""
    equations = mode.equations
    pressed = sum((e.energy(chi) for e, chi in switching(model)), sp.S.Zero)
    return {
        "kinetic_energy": equations.kinetic_energy,
        "gravitational_energy": equations.gravitational_energy,
        "elastic_energy": equations.elastic_energy + pressed,
    }


def forces(model: HybridModel, mode: Mode) -> dict[str, sp.Expr]:
    """Forces of the ground in a declared mode, and declared quantities that are forces [N]."""
    return reactions(model, mode) | mode.quantities_in("N")


def kinematics(model: HybridModel, mode: Mode) -> dict[str, sp.Expr]:
    """Displacement of the load point, and gaps and slips, relative to the rest position [m]."""
    rest = {c.position: 0 for c in model.coordinates}

    def moved(expr: sp.Expr) -> sp.Expr:
        expr = mode.approximated(expr)
        return expr - expr.subs(rest)

    values: dict[str, sp.Expr] = {}
    if mode.load_point is not None:
        values["displacement"] = moved(mode.load_point[0])
    if model.search is None:
        for foot in sorted(mode.feet):
            values[f"{foot}_uplift"] = moved(mode.feet[foot].position[1])
        return values | mode.quantities_in("m")
    contacts = model.search.of.contacts
    values |= {f"{c.name}_uplift": c.at(c.side)[0] for c in contacts}
    values |= {f"{e.name}_{e.outputs[1]}": e.output_displacement for e, _ in switching(model)}
    for c in contacts:
        if not c.material:  # what rolls has rates of slips, and no slip
            _, *slips = c.at(c.side)
            along = ("_x", "_y") if len(slips) > 1 else ("",)
            values |= {f"{c.name}_slip{w}": moved(s) for w, s in zip(along, slips, strict=True)}
    # by cosines, as `tidy` may write them, small tilts have no digits
    rolls = {f"{c.name}_uplift" for c in contacts if c.material}
    return {name: e if name in rolls else tidy(e) for name, e in values.items()}


def statics(model: HybridModel, mode: Mode) -> tuple[sp.Expr, ...]:
    """Lack of equilibrium of each coordinate, zero of those that are held and of integrals."""
    lacking = dict(zip(mode.coordinates, equilibrium(mode), strict=True))
    for e, chi in switching(model):
        for c in mode.coordinates:
            lacking[c] += e.still_force(chi) * sp.diff(e.displacement, c.position)
    if model.search is not None:
        lacking = {c: tidy(e) for c, e in lacking.items()}
    return tuple(lacking.get(c, sp.S.Zero) for c in model.integrated)


# -- powers ------------------------------------------------------------------------------------


def powers(model: HybridModel, mode: Mode) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Powers [W] of the shaking, of dampers and yielding, and of declared forces and pushes."""
    equations, coordinates = mode.equations, mode.coordinates
    velocity = sp.Matrix([c.velocity for c in coordinates]).reshape(len(coordinates), 1)
    ground, damping, force = (
        (term.T * velocity)[0] if velocity else sp.S.Zero
        for term in (
            equations.excitation_forces,
            equations.damping_forces,
            equations.applied_forces,
        )
    )
    # declared modes have yielding as a force
    viscous = 2 * sum((e.dissipation(coordinates) for e in mode.elements), sp.S.Zero)
    yielding = _losses(((e, sp.S.One) for e in mode.elements), coordinates) - viscous
    energy = equations.kinetic_energy + equations.gravitational_energy + equations.elastic_energy
    for f in model.functions:
        if f.symbol.is_Symbol:  # Lagrange's equations take it as a constant
            moved = rate(model.written_out(f.value), coordinates)
            force += sp.diff(energy, f.symbol) * moved
    pushes = [a for a in switching(model) if isinstance(a[0], Pulse)]
    force -= _losses(pushes, coordinates)
    damping += _losses((a for a in switching(model) if a not in pushes), coordinates)
    if model.search is not None:
        # elastic energy that grows with an internal variable, such as a dashpot's place
        of = model.search.of
        damping -= sum((sp.diff(of.elastic_energy, z.symbol) * e for z, e in of.rates.items()), 0)
    return ground, damping + yielding, force + yielding


def _losses(
    acting: Iterable[tuple[Element, sp.Expr]], coordinates: tuple[Coordinate, ...]
) -> sp.Expr:
    return sum((e.loss(chi, coordinates) for e, chi in acting), sp.S.Zero)
