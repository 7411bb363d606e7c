"""Equations of motion: accelerations, rates of the states, and how fast a gap would open."""

from __future__ import annotations

from collections.abc import Collection

from rockeom.codegen.solve import solve
from rockeom.codegen.text import Text
from rockeom.symbolic.model import Mechanism


def equations_of_motion(text: Text) -> None:
    _accelerations(text)
    _rates(text)
    _opening_acceleration(text)


def _accelerations(text: Text) -> None:
    """A function of plain numbers for each phase, and one that chooses the phase."""
    phases = text.model.mechanisms
    indent = " " * 8 if len(phases) > 1 else " " * 4
    chosen: list[str] = []
    for i, phase in enumerate(phases):
        call = _accelerations_of(text, i, phase)
        if len(phases) > 1:
            test = f"{'elif' if chosen else 'if'} {text.test(phase)}"
            chosen.append(f"    {'else' if phase is phases[-1] else test}:")
        chosen += [*text.side(indent, phase), f"{indent}return {call}"]
    text.function(
        f"accelerations(contact, {', '.join(text.states)}, p, ax, ay)",
        "Accelerations of the coordinates under ground accelerations ax, ay [m/s2].",
        chosen,
        "@inlined",
    )


def _accelerations_of(text: Text, number: int, phase: Mechanism) -> str:
    """Add the function of one phase; returns how it is called."""
    several = phase.has_side and len(phase.contacts) > 2
    own = "" if several else "_".join(["accelerations", *phase.contacts])
    name = text.function_name(own, f"accelerations_{number}")
    which = f"of phase {number}" if several else f"with contact {' or '.join(phase.contacts)}"
    out = [text.name(c.acceleration) for c in phase.coordinates]
    body = []
    if out:
        eq = phase.equations
        body = solve(
            text, "accelerations", eq.mass_matrix, eq.forcing, out, "    ", phase.gravity, False
        )
    found = [
        text.name(c.acceleration) if c in phase.coordinates else "0.0"
        for c in text.model.coordinates
    ]
    side = "s, " if phase.has_side else ""
    call = f"{name}({side}{', '.join(text.states)}, p, ax, ay)"
    text.function(
        call,
        f"Accelerations of the coordinates {which}.",
        [*body, f"    return ({', '.join(found)},)"],
        "@inlined",
    )
    return call


def _rates(text: Text) -> None:
    """Of all states, on arrays."""

    def branch(phase: Mechanism, indent: str) -> list[str]:
        return [
            f"{indent}dy[{i}] = {f'y[{text.n + i}]' if c in phase.coordinates else '0.0'}"
            for i, c in enumerate(text.model.coordinates)
        ]

    text.by_phase(
        "rates(contact, y, p, ax, ay, dy)",
        "Rates of the states y (N,) under ground accelerations ax, ay [m/s2], into dy (N,).",
        branch,
        after=[
            found_accelerations(text, "    "),
            *(f"    dy[{text.n + i}] = found[{i}]" for i in range(text.n)),
        ],
    )


def _opening_acceleration(text: Text) -> None:
    """Second derivative of the gap that a rocking phase would open from rest."""
    rotation = text.model.rotation
    theta, theta_dot = text.index(rotation.position), text.index(rotation.velocity)
    text.function(
        "opening_acceleration(contact, y, p, ax, ay)",
        "Acceleration with which a contact state's gap would open from closed and at rest.",
        [
            found_accelerations(text, "    ", zero=(theta, theta_dot)),
            f"    return SIDES[contact] * found[{theta}]",
        ],
        "@inlined",
    )


def found_accelerations(text: Text, indent: str, zero: Collection[int] = ()) -> str:
    """The line that finds the accelerations at y; the states numbered in `zero` are zero."""
    states = ("0.0" if i in zero else f"y[{i}]" for i in range(2 * text.n))
    return f"{indent}found = accelerations(contact, {', '.join(states)}, p, ax, ay)"
