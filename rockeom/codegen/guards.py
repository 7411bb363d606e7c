"""Guards: what ends a contact state, and where guards and their parts stand in g."""

from __future__ import annotations

import sympy as sp

from rockeom.codegen.text import Text
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.model import RockingModel, Transition


def guards(text: Text) -> None:
    model = text.model
    body: list[str] = []
    done: set[str] = set()
    for contact in model.contacts:
        transitions = outgoing(model, contact)
        if not transitions or contact in done:
            continue
        image = _image(model, contact)
        done |= {contact, image or contact}
        served = [f"contact == {text.contacts[c]}" for c in (contact, image) if c]
        body.append(f"    {'elif' if body else 'if'} {' or '.join(served)}:")
        if image:
            body += text.side(" " * 8, model.mechanism(contact))
            expressions = _on_both_sides(model, contact)
        else:
            expressions = _in_contact(model, contact)
        targets = {f"g[{i}]": e for i, e in expressions.items()}
        body += text.evaluate("guards", targets, " " * 8, hoist=True)
        body += [
            f"        g[{i}] = -opening_acceleration({text.contacts[t.target]}, y, p, ax, ay)"
            for i, t in enumerate(transitions)
            if t.kind == "uplift"
        ]
    text.function(
        "guards(contact, y, p, ax, ay, g)",
        """Guards of a contact state into g: all positive inside it; the first to fall ends it.

    g (N_GUARDS + N_PARTS,) : behind the guards stand the two parts of those that are the larger
        of two, where PARTS says.""",
        body or ["    pass"],
    )


def outgoing(model: RockingModel, contact: str) -> list[Transition]:
    """The transitions out of a contact state, an impact first."""
    found = [t for t in model.transitions if t.source == contact]
    return sorted(found, key=lambda t: t.kind != "impact")


def longest(model: RockingModel) -> int:
    """The largest number of guards of a contact state."""
    return max(len(outgoing(model, c)) for c in model.contacts)


def parts(model: RockingModel, contact: str) -> list[dict[int, sp.Expr]]:
    """For each guard of a contact state: its two parts by their place in g, if it has any."""
    found: list[dict[int, sp.Expr]] = []
    place = longest(model)
    for t in outgoing(model, contact):
        if isinstance(t.guard, sp.Max):
            two = (model.in_contact(e, contact) for e in t.guard.args)
            found.append(dict(zip((place, place + 1), two, strict=True)))
            place += 2
        else:
            found.append({})
    return found


def _in_contact(model: RockingModel, contact: str) -> dict[int, sp.Expr]:
    """Guards of a contact state and their parts, by their place in g."""
    found = {
        i: model.in_contact(t.guard, contact)
        for i, t in enumerate(outgoing(model, contact))
        if t.guard is not None
    }
    for two in parts(model, contact):
        found |= two
    return found


def _on_both_sides(model: RockingModel, contact: str) -> dict[int, sp.Expr]:
    """Guards of a contact state and of its image, with s, by their place in g."""
    closing = SIDE * model.rotation.position
    return {
        i: closing if t.kind == "impact" else t.guard
        for i, t in enumerate(outgoing(model, contact))
    }


def _image(model: RockingModel, contact: str) -> str | None:
    """The contact state on the other side, where its guards are the same but for laws of s.

    They are then written once, with s: a mirrored motion has mirrored guards to the last bit.
    """
    phase = model.mechanism(contact)
    if sorted(phase.contacts.values()) != [-1, 1]:
        return None
    (other,) = (c for c in phase.contacts if c != contact)
    mine, others = outgoing(model, contact), outgoing(model, other)
    alike = len(mine) == len(others) and all(
        t.kind == o.kind and (t.kind == "impact" or (t.kind == "switch" and t.guard == o.guard))
        for t, o in zip(mine, others, strict=True)
    )
    switches = [model.written_out(t.guard) for t in mine if t.kind == "switch"]
    if alike and any(e.has(SIDE) for e in switches):
        return other
    return None
