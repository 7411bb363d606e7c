"""Checks of declared modes, and of the transitions between them."""

from typing import Any

import sympy as sp

from rockeom.numbers.checks import require_word
from rockeom.symbolic.algebra import at_side
from rockeom.symbolic.checks.common import (
    Expressions,
    ModelError,
    Names,
    body_expressions,
    springs_outputs,
)
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Coordinate
from rockeom.symbolic.valid import repeated

KINDS = ("impact", "uplift", "switch")


def names_of_modes(model: HybridModel) -> Names:
    """Names of modes, quantities and springs."""
    quantities = list(dict.fromkeys(name for mode in model.modes for name in mode.quantities))
    springs = elements_of(model.modes[0])[0] if model.modes else ()
    items = [("mode", name) for name in model.mode_names]
    items += [("quantity", name) for name in quantities]
    items += [("element", name) for name in springs]
    # a tendon may be a quantity, too, of the same value
    of_springs = {*springs_outputs(springs)}
    states = model.states
    return Names(
        items,
        [[*states, *quantities], [*model.mode_names], [*springs], [*{*states}, *of_springs]],
        {*states, *quantities},
    )


def elements_of(mode: Mode) -> list[tuple[str, ...]]:
    """Names of a mode's elements, on each of its sides."""
    sides = sorted({*mode.sides.values()}) or [0]
    return [tuple(sorted(e.called(side) for e in mode.elements)) for side in sides]


def check_modes(model: HybridModel) -> None:
    if not model.coordinates:
        raise ModelError("it has no coordinates: declare the rotation")
    if model.rotation not in model.coordinates:
        raise ModelError(f"the rotation {model.rotation.name!r} is not in `coordinates`")
    if len(model.mode_names) < 2 or not model.transitions:
        raise ModelError(
            f"its modes are {', '.join(model.mode_names) or 'none'}: declare two or more, "
            "and the transitions between them",
        )
    for mode in model.modes:
        what = f"{model.name}: mode {'/'.join(mode.sides)}"
        if not mode.sides:
            raise ValueError(f"{what}: it serves no mode: name one in `sides`")
        if not mode.bodies:
            raise ValueError(f"{what}: it has no bodies: declare the masses")
        _sides(model, mode, what)
        _coordinates_of(model, mode, what)
        names = [b.name for b in mode.bodies]
        if repeated(names):
            raise ValueError(f"{what}: two bodies are called {repeated(names)[0]!r}: rename one")
    _same_outputs(model)


def _sides(model: HybridModel, mode: Mode, what: str) -> None:
    for name, side in mode.sides.items():
        if side not in (-1, 0, 1):
            raise ValueError(f"{what}: the side of {name!r} is {side!r}: give -1, 0 or 1")
        if (name, side) in (("left", 1), ("right", -1)):
            raise ValueError(
                f"{what}: the side of {name!r} is {side}: the left foot carries where the "
                "rotation is negative, side -1, and the right foot where it is positive, side 1"
            )
        if side and model.rotation not in mode.coordinates:
            raise ValueError(
                f"{what}: it has a side, but the rotation {model.rotation.name!r} is not free in "
                "it: add it to the mode's coordinates"
            )


def _coordinates_of(model: HybridModel, mode: Mode, what: str) -> None:
    strange = [c.name for c in mode.coordinates if c not in model.coordinates]
    if strange:
        raise ValueError(f"{what}: {', '.join(strange)} is not in the model's `coordinates`")
    if repeated([c.name for c in mode.coordinates]):
        raise ValueError(f"{what}: it has a coordinate twice")
    if len(mode.forces) not in (0, len(mode.coordinates)):
        raise ValueError(
            f"{what}: {len(mode.forces)} forces for {len(mode.coordinates)} coordinates: "
            "declare one for each, zero where there is none"
        )
    if set(mode.feet) not in (set(), {"left", "right"}):
        raise ValueError(
            f"{what}: its feet are {', '.join(mode.feet)}: declare a left and a right one, or none"
        )
    if len({foot.force is None for foot in mode.feet.values()}) > 1:
        raise ValueError(f"{what}: one foot has a force and the other none: give both, or none")
    for name, (unit, _) in mode.quantities.items():
        if unit not in ("m", "N"):
            raise ValueError(f"{what}: quantity {name!r} is in {unit!r}: give 'm' or 'N'")


def _same_outputs(model: HybridModel) -> None:
    """A response has the same columns in each mode."""
    first, *others = model.modes
    for mode in model.modes:
        if len({*elements_of(mode)}) > 1:
            raise ModelError(
                f"mode {'/'.join(mode.sides)} has other elements on one side than on the "
                "other: call an element and its image by `name` and `mirrored`, and each the other",
            )
    for mode in others:
        for item, of in (
            ("feet", lambda p: sorted(p.feet)),
            ("load point", lambda p: p.load_point is not None),
            ("bodies", lambda p: [(b.name, b.outline, b.copies, b.apart) for b in p.bodies]),
            ("elements", lambda p: elements_of(p)[0]),
            ("quantities", lambda p: [(name, unit) for name, (unit, _) in p.quantities.items()]),
        ):
            if of(mode) != of(first):
                raise ModelError(
                    f"modes {'/'.join(first.sides)} and {'/'.join(mode.sides)} differ "
                    f"in {item}: declare the same in each, in the same order",
                )


def expressions_of_modes(model: HybridModel) -> Expressions:
    """(item, expression, what it may contain besides constants)."""
    for d in model.definitions:
        yield f"definition {d.name!r}", d.value, ""
    for f in model.functions:
        yield f"function {f.name!r}", f.symbol, "q"
        yield f"function {f.name!r}", f.value, "qvs" if f.symbol.is_Symbol else "qs"
    for mode in model.modes:
        of = f" in mode {'/'.join(mode.sides)}"
        for b in mode.bodies:
            yield from body_expressions(b, f" of body {b.name!r}{of}", "qs")
        yield f"gravity{of}", mode.gravity, ""
        yield f"elastic energy{of}", mode.elastic_energy, "qs"
        yield f"dissipation{of}", mode.dissipation, "qvs"
        for spring in mode.elements:
            element = f" of element {spring.name!r}{of}"
            yield f"deformation{element}", spring.deformation, "qs"
            for constant, e in (*spring.constants.items(), ("initial force", spring.initial_force)):
                yield f"{constant}{element}", e, "s"
        for c, e in zip(mode.coordinates, mode.forces, strict=False):
            yield f"force on {c.name!r}{of}", e, "qvs"
        for name, foot in mode.feet.items():
            for axis, e in zip("xy", foot.position, strict=True):
                yield f"{axis} of the {name} foot{of}", e, "qs"
            if foot.force is not None:
                yield f"force on the {name} foot{of}", foot.force, "qvasg"
        for axis, e in zip("xy", mode.beside_feet, strict=True):
            yield f"{axis} of the force elsewhere than at the feet{of}", e, "qvsg"
        for axis, e in zip("xy", mode.load_point or (), strict=False):
            yield f"{axis} of the load point{of}", e, "qs"
        for x in mode.small:
            yield f"small symbol {x}{of}", x, "qvg"
        for name, (unit, e) in mode.quantities.items():
            yield f"quantity {name!r}{of}", e, "qvs" if unit == "m" else "qvasg"
    for t in model.transitions:
        if t.guard is not None:
            yield f"guard of {words_of(t)}", t.guard, "qvsg"
        for x, e in t.sets.items():
            yield f"{x} set by {words_of(t)}", e, "qvs"
    if model.rigid_velocity_ratio is not None:
        yield "rigid_velocity_ratio", model.rigid_velocity_ratio, ""


def words_of(t: Transition) -> str:
    return f"{t.kind} {t.source!r} -> {t.target!r}"


def check_transitions(model: HybridModel) -> None:
    for t in model.transitions:
        what = f"{model.name}: transition {t.source!r} -> {t.target!r}"
        require_word("kind", t.kind, KINDS, what)
        for item, name in (("source", t.source), ("target", t.target), ("fallback", t.fallback)):
            if name is not None or item != "fallback":
                require_word(item, name, model.mode_names, what)
        positions = [x for c in model.coordinates for x in (c.position, c.velocity)]
        for x in t.sets:
            if x not in positions:
                raise ValueError(
                    f"{what}: it sets {x}, which is no coordinate: name `coordinate.position`"
                )
        if t.kind != "impact" and t.fallback is not None:
            raise ValueError(
                f"{what}: only an impact has a fallback, this is of kind {t.kind!r}: leave it out"
            )
        {"impact": _impact, "uplift": _uplift, "switch": _switch}[t.kind](model, t, what)
    impacts = [t.source for t in model.transitions if t.kind == "impact"]
    if repeated(impacts):
        raise ModelError(f"two impacts end the mode {repeated(impacts)[0]!r}: declare one")
    _pairs(model)
    _grounded(model)


def side_of(model: HybridModel, mode: str) -> int:
    return model.mode(mode).side_of(mode)


def _impact(model: HybridModel, t: Transition, what: str) -> None:
    """The rotation falls to zero, and the structure rocks about its other foot then."""
    side, gap = side_of(model, t.source), model.rotation.position
    name = model.rotation.name
    if side == 0 or side_of(model, t.target) != -side:
        raise ValueError(
            f"{what}: an impact leads from a mode of side -1 or 1 to one of the other "
            f"side, not from {side} to {side_of(model, t.target)}; full contact is its `fallback`, "
            "and a foot that lands out of flight is not modelled: declare a spring, and a switch"
        )
    if t.fallback is not None and side_of(model, t.fallback) != 0:
        raise ValueError(f"{what}: the fallback {t.fallback!r} must be a mode of side 0")
    wanted = side * gap
    if t.guard is None or sp.expand(at_side(t.guard, side) - wanted) != 0:
        raise ValueError(
            f"{what}: the guard of this impact is {t.guard}; it must be the rotation {name!r} on "
            f"its side, {wanted}, which is positive before the impact: no other gap is modelled"
        )
    if t.sets:
        raise ValueError(
            f"{what}: an impact sets nothing but velocities, which are derived: leave `sets` out, "
            "or put it to a switch"
        )


def _uplift(model: HybridModel, t: Transition, what: str) -> None:
    """The rotation, held until now, becomes free."""
    if t.guard is not None:
        raise ValueError(f"{what}: the guard of an uplift is derived: leave `guard` out")
    free = model.rotation in model.mode(t.source).coordinates
    if side_of(model, t.source) != 0 or free or side_of(model, t.target) == 0:
        raise ValueError(
            f"{what}: an uplift leads from full contact (side 0, the rotation held) to rocking "
            "(side -1 or 1)"
        )
    foot = "left" if side_of(model, t.target) < 0 else "right"
    for name, wanted in ((t.source, "both"), (t.target, foot)):
        if name.split("_")[0] != wanted:
            raise ValueError(f"{what}: call {name!r} {wanted!r}, or {wanted}_...")
    for name in ("left", "both", "right"):
        if name not in model.mode_names:
            raise ValueError(f"{what}: a structure that lifts has a mode {name!r}, too")


def _switch(model: HybridModel, t: Transition, what: str) -> None:
    if t.guard is None:
        raise ValueError(f"{what}: a switch needs a guard, positive inside {t.source!r}")
    if isinstance(t.guard, sp.Max) and len(t.guard.args) != 2:
        raise ValueError(f"{what}: its guard is the Max of {len(t.guard.args)}: give two at most")


def _pairs(model: HybridModel) -> None:
    """A transition and the one back cannot have the same guard: each is positive in its source."""
    switches = [t for t in model.transitions if t.kind == "switch"]
    places = {c: i for i, c in enumerate(model.mode_names)}
    by_ends = {(t.source, t.target): t for t in switches}
    for (source, target), t in by_ends.items():
        back = by_ends.get((target, source))
        if back is None or places[source] > places[target]:
            continue
        if sp.sympify(t.guard).is_negative:  # it is passed at once, and meant to be
            continue
        mine, other = (set(_parts(model, x)) for x in (t, back))
        if mine & other:
            raise ModelError(
                f"the guards of {words_of(t)} and of {words_of(back)} have one sign "
                f"({', '.join(map(str, mine & other))}): each must be positive inside its source",
            )


def _parts(model: HybridModel, t: Transition) -> list[sp.Expr]:
    parts = t.guard.args if isinstance(t.guard, sp.Max) else (t.guard,)
    return [sp.expand(at_side(e, side_of(model, t.source))) for e in parts]


def _grounded(model: HybridModel) -> None:
    """No way into the ground is open."""
    impacts = {t.source for t in model.transitions if t.kind == "impact"}
    lifted = {t.target for t in model.transitions if t.kind != "switch"}
    for mode in model.modes:
        rigid = any(foot.force is None for foot in mode.feet.values())
        held = model.rotation not in mode.coordinates
        for name, side in mode.sides.items():
            out = [t for t in model.transitions if t.source == name]
            if side and (not out or ((rigid or name in lifted) and name not in impacts)):
                raise ModelError(
                    f"no impact ends the mode {name!r}, and the structure would turn "
                    f'into the ground: add Transition("{name}", ..., "impact", guard='
                    f"{side * model.rotation.position})",
                )
            if not side and rigid and not held:
                raise ModelError(
                    f"the rotation is free in the mode {name!r}, which has no side, "
                    "and its feet have no force: declare the force on each foot",
                )
            ends = {side_of(model, t.target) for t in out if t.kind == "uplift"}
            if not side and rigid and ends != {-1, 1}:
                raise ModelError(
                    f"the mode {name!r} lifts to {len(ends)} of the two sides: add "
                    f'Transition("{name}", "left", "uplift"), and the same to "right"',
                )


# --- a structure that rocks about the edges of its base


def check_turning(name: str, rocking: Mode, rotation: Coordinate) -> None:
    """The feet turn clockwise about the right one as the rotation grows, and a body with them.

    Raises ValueError where they do not.
    """
    turn = rotation.position
    upright_at = {c.position: 0 for c in rocking.coordinates}

    def upright(expr: Any) -> sp.Expr:
        return at_side(sp.sympify(expr).subs(upright_at), 1)

    left, right = (rocking.feet[foot].position for foot in ("left", "right"))
    # what the left foot rises by, as a part of their distance
    turns = sp.cancel(upright(sp.diff(left[1], turn)) / upright(right[0] - left[0]))
    if turns.is_negative:
        raise ValueError(
            f"{name}: as {turn} grows from zero the structure turns counterclockwise, and its left "
            "foot into the ground: give the rotation its other sign"
        )
    pivot = upright(right[0])
    for b in () if turns == 0 else rocking.bodies:
        x, y = (upright(e) for e in b.position)
        vx, vy = (upright(sp.diff(e, turn)) for e in b.position)
        if sp.simplify(vx - y * turns) == 0 and sp.simplify(vy + (x - pivot) * turns) == 0:
            return
    raise ValueError(
        f"{name}: no body turns about the edges with {turn}, the first of `coordinates` or the "
        "`rotation` of a Model: put the rotation first, or name it, and place bodies and feet by "
        "`turned(point, pivot, rotation)`"
    )
