"""What a response tells of elements, masses and powers, of any structure.

Nothing of it stands in a compiled program: it is plain Python, called where it is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from rockeom.codegen.text import Text
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.elements import Element, Spring, switch_of
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, Mechanism, RockingModel

Columns = tuple[str, ...]
Coordinates = tuple[Coordinate, ...]


def quantities(text: Text) -> dict[str, Columns]:
    """Add all functions; returns the table that names what `elements` fills `out` with."""
    _masses(text)
    _powers(text)
    return {"ELEMENT_NAMES": _elements(text)}


def _masses(text: Text) -> None:
    def branch(phase: Mechanism, indent: str) -> list[str]:
        found = [e for b in phase.bodies for e in (b.mass, b.inertia)]
        return text.evaluate("masses", _into_out([*found, phase.gravity]), indent)

    signature = "masses(contact, y, p, out)"
    doc = "Mass and moment of inertia of each body, as in POSITIONS, and then gravity, into out."
    if isinstance(text.model, Model):
        text.function(signature, doc, branch(text.model.free, "    "))
    else:
        text.by_phase(signature, doc, branch)


# -- powers -------------------------------------------------------------------------------------


def _powers(text: Text) -> None:
    signature = "powers(contact, y, p, ax, ay, out)"
    doc = """Powers [W] into out (3,): what the shaking gives, what dampers and yielding take, and
    what declared forces give."""
    if isinstance(text.model, Model):
        text.function(
            signature,
            doc,
            [*_read_switches(text), *text.evaluate("powers", _of_contacts(text.model), "    ")],
        )
        return
    text.by_phase(
        signature, doc, lambda phase, i: text.evaluate("powers", _of_phase(text.model, phase), i)
    )


def _gained(phase: Mechanism) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Powers of the shaking, of dampers and of forces, by the terms of the equations of motion."""
    eq = phase.equations
    velocity = sp.Matrix([c.velocity for c in phase.coordinates]).reshape(len(phase.coordinates), 1)
    ground, damping, force = (
        (term.T * velocity)[0] if velocity else sp.S.Zero
        for term in (eq.excitation, eq.damping, eq.force)
    )
    return ground, damping, force


def _of_phase(model: RockingModel, phase: Mechanism) -> dict[str, sp.Expr]:
    ground, damping, force = _gained(phase)
    # yielding is declared as a force
    viscous = 2 * sum((e.dissipation(phase.coordinates) for e in phase.elements), sp.S.Zero)
    yielding = _losses(phase.elements, phase.coordinates) - viscous
    eq = phase.equations
    energy = eq.kinetic_energy + eq.gravitational_energy + eq.elastic_energy
    for law in model.functions:
        if law.symbol.is_Symbol:  # which Lagrange's equations take as a constant
            moved = rate(model.written_out(law.value), phase.coordinates)
            force += sp.diff(energy, law.symbol) * moved
    return _into_out((ground, damping + yielding, force + yielding))


def _of_contacts(model: Model) -> dict[str, sp.Expr]:
    ground, damping, force = _gained(model.free)
    damping += _losses(model.switching, model.coordinates)
    # of the elastic energy that grows with what is no coordinate, such as a dashpot's place
    damping -= sum((sp.diff(model.elastic_energy, z.symbol) * e for z, e in model.rates.items()), 0)
    return _into_out((ground, damping, force))


def _losses(elements: Iterable[Element], coordinates: Coordinates) -> sp.Expr:
    losses = (e.loss(chi, coordinates) for e, chi in _with_states(elements))
    return sum(losses, sp.S.Zero)


def _with_states(elements: Iterable[Element]) -> list[tuple[Element, sp.Expr]]:
    """Each with the symbol of its state."""
    found: list[tuple[Element, sp.Expr]] = []
    switches = 0
    for e in elements:
        always = isinstance(e, Spring)
        found.append((e, sp.S.One if always else switch_of(switches)))
        switches += not always
    return found


def _read_switches(text: Text) -> list[str]:
    return [
        f"    chi_{i} = 1.0 * ELEMENT_STATES[contact][{i}]"
        for i in range(len(text.model.switching))
    ]


# -- elements -----------------------------------------------------------------------------------


def _elements(text: Text) -> Columns:
    model = text.model
    signature = "elements(contact, y, p, out)"
    doc = """Of each of ELEMENT_NAMES: deformation [m], force [N], energy [J], power lost [W].

    Into out, one element behind the other."""
    if isinstance(model, Model):
        told = _with_states(model.elements)
        targets = _into_out(x for e, chi in told for x in _told(e, chi, model.coordinates))
        lines = [*_read_switches(text), *text.evaluate("elements", targets, "    ")]
        text.function(signature, doc, lines or ["    pass"])
        return tuple(e.name for e in model.elements)
    first = model.mechanisms[0]
    names = tuple(e.called(next(iter(first.contacts.values()))) for e in first.elements)
    if any(e.mirrored for phase in model.mechanisms for e in phase.elements):
        text.function(signature, doc, _by_contact(text, names))
        return names

    def branch(phase: Mechanism, indent: str) -> list[str]:
        of = {e.name: _told(e, sp.S.One, phase.coordinates) for e in phase.elements}
        values = (text.model.written_out(x) for name in names for x in of[name])
        return text.evaluate("elements", _into_out(values), indent)

    text.by_phase(signature, doc, branch)
    return names


def _by_contact(text: Text, names: Columns) -> list[str]:
    """Lines of each contact state: an element and its image on the other side are told apart."""
    model = text.model
    branches: dict[tuple[str, ...], list[str]] = {}
    for phase in model.mechanisms:
        for contact, side in phase.contacts.items():
            found = {e.called(side): _told(e, sp.S.One, phase.coordinates) for e in phase.elements}
            values = (model.in_contact(x, contact) for name in names for x in found[name])
            lines = tuple(text.evaluate("elements", _into_out(values), " " * 8))
            branches.setdefault(lines, []).append(text.contacts[contact])
    if len(branches) == 1:
        return [line[4:] for line in next(iter(branches))]
    body: list[str] = []
    for lines, contacts in branches.items():
        body.append(f"    {'elif' if body else 'if'} contact in ({', '.join(contacts)},):")
        body += lines
    return body


def _told(e: Element, chi: sp.Expr, coordinates: Coordinates) -> tuple[sp.Expr, ...]:
    return (
        e.told_displacement, e.force(chi, coordinates), e.energy(chi), e.loss(chi, coordinates),
    )  # fmt: skip


def _into_out(values: Iterable[sp.Expr]) -> dict[str, sp.Expr]:
    return {f"out[{i}]": sp.sympify(e) for i, e in enumerate(values)}
