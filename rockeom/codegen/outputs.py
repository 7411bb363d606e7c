"""What is asked of a state: energies, reactions, kinematics, momentum, and equilibrium.

Each is a function that fills `out`.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from rockeom.codegen.rates import found_accelerations
from rockeom.codegen.text import Text
from rockeom.symbolic.contact import reactions
from rockeom.symbolic.impulse import momentum
from rockeom.symbolic.model import Mechanism
from rockeom.symbolic.statics import equilibrium

Columns = tuple[str, ...]
"""What a function fills `out` with, by name."""


def outputs(text: Text) -> dict[str, Columns]:
    """Add all of them; returns the columns of those that have a table of names."""
    columns = {
        "ENERGIES": _energies(text),
        "REACTIONS": _reactions(text),
        "KINEMATICS": _kinematics(text),
    }
    _momentum(text)
    _statics(text)
    return columns


def _energies(text: Text) -> Columns:
    def table(phase: Mechanism) -> dict[str, sp.Expr]:
        eq = phase.equations
        return {
            "kinetic_energy": eq.kinetic_energy,
            "gravitational_energy": eq.gravitational_energy,
            "elastic_energy": eq.elastic_energy,
        }

    return _named(
        text,
        "energies",
        "contact, y, p, out",
        "Kinetic, gravitational and elastic energy [J] into out (3,).",
        table,
    )


def _reactions(text: Text) -> Columns:
    return _named(
        text,
        "reactions",
        "contact, y, p, ax, ay, out",
        "Forces of the ground [N] into out, in the order of REACTIONS.",
        lambda phase: reactions(text.model, phase) | phase.quantities_in("N"),
    )


def _kinematics(text: Text) -> Columns:
    """Displacement of the load point and uplift of the feet, relative to the rest position."""
    rest = {c.position: 0 for c in text.model.coordinates}

    def table(phase: Mechanism) -> dict[str, sp.Expr]:
        def moved(expr) -> sp.Expr:
            expr = phase.approximated(expr)
            return expr - expr.subs(rest)

        values: dict[str, sp.Expr] = {}
        if phase.load_point is not None:
            values["displacement"] = moved(phase.load_point[0])
        for foot in sorted(phase.feet):
            values[f"{foot}_uplift"] = moved(phase.feet[foot].position[1])
        return values | phase.quantities_in("m")

    return _named(
        text,
        "kinematics",
        "contact, y, p, out",
        "Displacement of the load point and uplift of the feet [m] into out, as KINEMATICS.",
        table,
    )


def _momentum(text: Text) -> None:
    """What changes at an impact is the impulse of the ground."""
    _named(
        text,
        "momentum",
        "contact, y, p, out",
        "Horizontal and vertical momentum of all masses [kg m/s] into out (2,).",
        lambda phase: dict(zip("xy", momentum(phase), strict=True)),
    )


def _statics(text: Text) -> None:
    def branch(phase: Mechanism, indent: str) -> list[str]:
        free = dict(zip(phase.coordinates, equilibrium(phase), strict=True))
        targets = {
            f"out[{i}]": free.get(c, sp.Integer(0)) for i, c in enumerate(text.model.coordinates)
        }
        return text.evaluate("statics", targets, indent)

    text.by_phase(
        "statics(contact, y, p, load, out)",
        "Lack of equilibrium dV/dq - load dx/dq under a force at the load point [N], (n,).",
        branch,
    )


def _named(
    text: Text,
    name: str,
    arguments: str,
    doc: str,
    table: Callable[[Mechanism], dict[str, sp.Expr]],
) -> Columns:
    """A function that fills out with named quantities; held accelerations are zero."""
    columns: list[str] = []

    def branch(phase: Mechanism, indent: str) -> list[str]:
        values = table(phase)
        columns[:] = list(values)
        used = set().union(*(sp.sympify(e).free_symbols for e in values.values()))
        lines = []
        if used & {c.acceleration for c in phase.coordinates}:
            lines.append(found_accelerations(text, indent))
            lines += [
                f"{indent}{text.name(c.acceleration)} = found[{i}]"
                for i, c in enumerate(text.model.coordinates)
                if c.acceleration in used
            ]
        targets = {f"out[{i}]": e for i, e in enumerate(values.values())}
        return lines + text.evaluate(name, targets, indent)

    text.by_phase(f"{name}({arguments})", doc, branch)
    return tuple(columns)
