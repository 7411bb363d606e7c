"""Functions of a state: energies, reactions, kinematics, statics, places, powers, elements.

Each fills `out`, in each mode by its own expressions; see `rockeom.symbolic.outputs`.
"""

from collections.abc import Callable, Iterable, Mapping

import sympy as sp

from rockeom.codegen.rates import found_accelerations
from rockeom.codegen.text import Text, branched
from rockeom.symbolic import outputs as expressions
from rockeom.symbolic.impulse import momentum
from rockeom.symbolic.mode import Mode

Columns = tuple[str, ...]
"""Names of the values that a function fills `out` with."""

_AXES = {2: "Horizontal and vertical", 3: "First and second horizontal, and vertical"}
_INERTIA = {2: "moment of inertia", 3: "inertia tensor, row by row,"}
_PLACE = {
    2: "x, y [m] and clockwise rotation [rad]",
    3: "x, y, z [m] and rotation matrix, by rows,",
}
"""Words of a structure's axes, by their number."""


def _entries(inertia: sp.Expr | sp.MatrixBase) -> tuple[sp.Expr, ...]:
    return tuple(sp.Matrix([[inertia]]))


def outputs(text: Text) -> dict[str, Columns]:
    """Add all of them; returns the tables that name the columns of `out`."""
    model = text.model
    axes = len(model.shaking)
    columns = {
        "ENERGIES": _named(
            text,
            "energies(mode, y, p, out)",
            "Kinetic, gravitational and elastic energy [J] into out (3,).",
            lambda mode: expressions.energies(model, mode),
        ),
        "KINEMATICS": _named(
            text,
            "kinematics(mode, y, p, out)",
            "Displacement of the load point, gaps and slips [m] into out, as KINEMATICS.",
            lambda mode: expressions.kinematics(model, mode),
        ),
    }
    _named(
        text,
        "momentum(mode, y, p, out)",
        f"{_AXES[axes]} momentum of all masses [kg m/s] into out ({axes},).",
        lambda mode: dict(zip("xyz", momentum(mode), strict=False)),
    )
    _in_order(
        text,
        "statics(mode, y, p, load, out)",
        "Lack of equilibrium dV/dq - load dx/dq under a force at the load point [N], (n,).",
        lambda mode: expressions.statics(model, mode),
    )
    _in_order(
        text,
        "masses(mode, y, p, out)",
        f"Mass and {_INERTIA[axes]} of each body, as in POSITIONS, and then gravity, into out.",
        lambda mode: [
            *(e for b in mode.bodies for e in (b.mass, *_entries(b.inertia))),
            mode.gravity,
        ],
    )
    _in_order(
        text,
        f"powers(mode, y, p, {text.shaking}, out)",
        """Powers [W] into out (3,): of the shaking, of dampers and yielding, and of declared
    forces.""",
        lambda mode: expressions.powers(model, mode),
    )
    return columns | _positions(text) | {"ELEMENT_NAMES": _elements(text)}


def reactions(text: Text) -> Columns:
    """Add the forces in declared modes."""
    return _named(
        text,
        f"reactions(mode, y, p, {text.shaking}, out)",
        "Forces of the ground [N] into out, in the order of REACTIONS.",
        lambda mode: expressions.forces(text.model, mode),
    )


def into_out(values: Iterable[sp.Expr]) -> dict[str, sp.Expr]:
    """Expressions by their places in `out`."""
    return {f"out[{i}]": sp.sympify(e) for i, e in enumerate(values)}


def _named(
    text: Text, signature: str, doc: str, table: Callable[[Mode], Mapping[str, sp.Expr]]
) -> Columns:
    """A function of named quantities; returns their names."""
    _in_order(text, signature, doc, lambda mode: table(mode).values())
    return tuple(table(text.model.modes[0]))


def _in_order(
    text: Text, signature: str, doc: str, values: Callable[[Mode], Iterable[sp.Expr]]
) -> None:
    """A function that fills out; accelerations of coordinates that a mode holds are zero."""
    name = signature.partition("(")[0]

    def branch(mode: Mode, indent: str) -> list[str]:
        targets = into_out(values(mode))
        used = set().union(*(e.free_symbols for e in targets.values()))
        lines = []
        if used & {c.acceleration for c in mode.coordinates}:
            lines.append(found_accelerations(text, indent))
            lines += [
                f"{indent}{text.name(c.acceleration)} = found[{i}]"
                for i, c in enumerate(text.model.coordinates)
                if c.acceleration in used
            ]
        return lines + text.evaluate(name, targets, indent)

    text.by_mode(signature, doc, branch)


def _positions(text: Text) -> dict[str, Columns]:
    model = text.model
    _in_order(
        text,
        "positions(mode, y, p, out)",
        f"Place {_PLACE[len(model.shaking)]} of each of POSITIONS into out, one by one.",
        lambda mode: (
            e
            for place in expressions.places(model, mode).values()
            for e in (*place.at, *place.rotation)
        ),
    )
    shown = expressions.places(model, model.modes[0])
    return {
        "POSITIONS": tuple(shown),
        "POSITION_KINDS": tuple(place.kind for place in shown.values()),
    }


# -- elements -----------------------------------------------------------------------------------


def _elements(text: Text) -> Columns:
    model = text.model
    first = model.modes[0]
    side = next(iter(first.sides.values()))
    names = tuple(_called(a, side) for a in expressions.elements(model, first))
    signature = "elements(mode, y, p, out)"
    doc = """Deformation [m], force [N], energy [J] and power lost [W] of each of ELEMENT_NAMES.

    Into out, one element behind the other."""
    if any(e.mirrored for mode in model.modes for e in mode.elements):
        text.function(signature, doc, _on_each_side(text, names))
        return names

    def values(mode: Mode) -> Iterable[sp.Expr]:
        acting = {a.element.name: a for a in expressions.elements(model, mode)}
        for name in names:
            for x in expressions.of_element(acting[name], mode.coordinates):
                yield model.written_out(x)

    _in_order(text, signature, doc, values)
    return names


def _called(acting: expressions.Acting, side: int) -> str:
    """Name of an element on a side."""
    e = acting.element
    return e.called(side) if isinstance(e, expressions.Spring) else e.name


def _on_each_side(text: Text, names: Columns) -> list[str]:
    """Lines for each mode: an element and its image on the other side have names of their own."""
    model = text.model
    branches: dict[tuple[str, ...], list[str]] = {}
    for mode in model.modes:
        for name, side in mode.sides.items():
            acting = {_called(a, side): a for a in expressions.elements(model, mode)}
            values = (
                model.in_mode(x, name)
                for element in names
                for x in expressions.of_element(acting[element], mode.coordinates)
            )
            lines = tuple(text.evaluate("elements", into_out(values), " " * 8))
            branches.setdefault(lines, []).append(text.mode_constants[name])
    return branched(
        [(f"mode in ({', '.join(modes)},)", [*lines]) for lines, modes in branches.items()]
    )
