"""What a declaration must be, so that what is derived from it is what was meant.

Each check raises ValueError, which names the declaration, the item and the remedy. `check` looks
at names, symbols and references, when a model is made; `check_derived` at what follows from it,
before it is generated; `check_values` at the values of its parameters.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.pycode import pycode

from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE, at_side

if TYPE_CHECKING:
    from rockeom.symbolic.contacts import Contact, Model
    from rockeom.symbolic.elements import Element
    from rockeom.symbolic.model import Body, Coordinate, Mechanism, RockingModel, Transition

KINDS = ("impact", "uplift", "switch")

_OUTPUTS = """
t phase kinetic_energy gravitational_energy elastic_energy total_energy
ground_acceleration vertical_ground_acceleration
horizontal_reaction left_reaction right_reaction displacement left_uplift right_uplift
"""
RESPONSE = frozenset(_OUTPUTS.split())
"""What a response calls by name besides the states."""

# --- a model, when it is made


def check(model: RockingModel) -> None:
    """Names, symbols and references of a declaration."""
    ratio = model.rigid_velocity_ratio
    valid.expressions(
        str(model.name), overturning=model.overturning,
        rigid_velocity_ratio=1 if ratio is None else ratio,
    )  # fmt: skip
    _names(model)
    distinct_symbols(model)
    _phases(model)
    sketched(model)
    known = declared_kinds(model)
    for item, expr, kinds in _expressions(model):
        contents(model, known, item, sp.sympify(expr), kinds)
    _transitions(model)
    _grounded(model)


def fail(model: RockingModel | Model, what: str) -> NoReturn:
    raise ValueError(f"{model.name}: {what}")


def common_names(model: RockingModel | Model) -> None:
    """Refuse what may not be the name of a model, a parameter or a coordinate."""
    valid.name("model", model.name)
    if not model.name.isascii():
        fail(model, "a file is called by the model's name: write it in ASCII")
    valid.texts(model.name, title=model.title, reference=model.reference)
    for p in model.parameters:
        valid.name(f"{model.name}: parameter {p.symbol}", p.name)
    for c in model.coordinates:
        valid.name(f"{model.name}: coordinate {c.position}", c.name)


def _names(model: RockingModel) -> None:
    common_names(model)
    for contact in model.contacts:
        valid.name(f"{model.name}: contact state", contact)
    outputs = _quantities(model)
    for name in outputs:
        valid.name(f"{model.name}: quantity", name)
    names = [p.name for p in model.parameters] + list(model.states)
    springs = elements_of(model.mechanisms[0])[0] if model.mechanisms else ()
    for name in springs:
        valid.name(f"{model.name}: element", name)
    told = springs_outputs(springs)  # of a tendon that is a quantity, too, it tells the same
    twice = repeated(names) or repeated([*model.states, *outputs]) or repeated(model.contacts)
    twice = twice or repeated(springs) or sorted({*model.states} & {*told})
    if twice:
        fail(model, f"declared twice: {', '.join(twice)}; give each a name of its own")
    taken = sorted(RESPONSE & {*model.states, *outputs})
    if taken:
        fail(model, f"every response calls something else {', '.join(taken)}: choose another name")


def repeated(names: Iterable[Any]) -> list[str]:
    names = list(names)
    return sorted({str(n) for n in names if names.count(n) > 1})


def elements_of(phase: Mechanism) -> list[tuple[str, ...]]:
    """Names of a mechanism's elements, on each of its sides."""
    sides = sorted({*phase.contacts.values()}) or [0]
    return [tuple(sorted(e.called(side) for e in phase.elements)) for side in sides]


def springs_outputs(springs: Iterable[str]) -> tuple[str, ...]:
    """What a response tells of springs of these names, by name."""
    told = ("deformation", "force", "energy", "loss")
    return tuple(f"{name}_{what}" for name in springs for what in told)


def _quantities(model: RockingModel) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for phase in model.mechanisms for name in phase.quantities))


def distinct_symbols(model: RockingModel | Model, others: Iterable[sp.Symbol] = ()) -> None:
    """Each symbol stands for one thing."""
    from rockeom.symbolic.model import GROUND_X, GROUND_Y
    from rockeom.symbolic.statics import LOAD

    symbols = [p.symbol for p in model.parameters] + [d.symbol for d in model.definitions]
    symbols += [s for c in model.coordinates for s in (c.position, c.velocity, c.acceleration)]
    symbols += [*(law.symbol for law in model.functions), *others]
    twice = repeated(symbols)
    if twice:
        fail(
            model,
            f"the symbol {', '.join(twice)} is declared twice, and stands for two things: "
            "give each parameter, coordinate and internal variable a symbol of its own",
        )
    kept = {
        SIDE: "the side, sgn(theta)",
        GROUND_X: "the ground's horizontal acceleration",
        GROUND_Y: "the ground's vertical acceleration",
        LOAD: "the load of a pushover",
    }
    for symbol in kept.keys() & set(symbols):
        fail(model, f"the symbol {symbol} is kept for {kept[symbol]}: choose another")


def _phases(model: RockingModel) -> None:
    if not model.coordinates:
        fail(model, "it has no coordinates: declare the rotation")
    if model.rotation not in model.coordinates:
        fail(model, f"the rotation {model.rotation.name!r} is not in `coordinates`")
    if len(model.contacts) < 2 or not model.transitions:
        fail(
            model,
            f"its contact states are {', '.join(model.contacts) or 'none'}: declare two or more, "
            "and the transitions between them",
        )
    for phase in model.mechanisms:
        what = f"{model.name}: mechanism {'/'.join(phase.contacts)}"
        if not phase.contacts:
            raise ValueError(f"{what}: it serves no contact state: name one in `contacts`")
        if not phase.bodies:
            raise ValueError(f"{what}: it has no bodies: declare the masses")
        _sides(model, phase, what)
        _coordinates_of(model, phase, what)
        names = [b.name for b in phase.bodies]
        if repeated(names):
            raise ValueError(f"{what}: two bodies are called {repeated(names)[0]!r}: rename one")
    _same_outputs(model)


def _sides(model: RockingModel, phase: Mechanism, what: str) -> None:
    for contact, side in phase.contacts.items():
        if side not in (-1, 0, 1):
            raise ValueError(f"{what}: the side of {contact!r} is {side!r}: give -1, 0 or 1")
        if (contact, side) in (("left", 1), ("right", -1)):
            raise ValueError(
                f"{what}: the side of {contact!r} is {side}: the left foot carries where the "
                "rotation is negative, side -1, and the right foot where it is positive, side 1"
            )
        if side and model.rotation not in phase.coordinates:
            raise ValueError(
                f"{what}: it has a side, but the rotation {model.rotation.name!r} is not free in "
                "it: add it to the mechanism's coordinates"
            )


def _coordinates_of(model: RockingModel, phase: Mechanism, what: str) -> None:
    strange = [c.name for c in phase.coordinates if c not in model.coordinates]
    if strange:
        raise ValueError(f"{what}: {', '.join(strange)} is not in the model's `coordinates`")
    if repeated([c.name for c in phase.coordinates]):
        raise ValueError(f"{what}: it has a coordinate twice")
    if len(phase.forces) not in (0, len(phase.coordinates)):
        raise ValueError(
            f"{what}: {len(phase.forces)} forces for {len(phase.coordinates)} coordinates: "
            "declare one for each, zero where there is none"
        )
    if set(phase.feet) not in (set(), {"left", "right"}):
        raise ValueError(
            f"{what}: its feet are {', '.join(phase.feet)}: declare a left and a right one, or none"
        )
    if len({foot.force is None for foot in phase.feet.values()}) > 1:
        raise ValueError(f"{what}: one foot has a force and the other none: give both, or none")
    for name, (unit, _) in phase.quantities.items():
        if unit not in ("m", "N"):
            raise ValueError(f"{what}: quantity {name!r} is in {unit!r}: give 'm' or 'N'")


def _same_outputs(model: RockingModel) -> None:
    """A response has the same columns in each phase."""
    first, *others = model.mechanisms
    for phase in model.mechanisms:
        if len({*elements_of(phase)}) > 1:
            fail(
                model,
                f"mechanism {'/'.join(phase.contacts)} has other elements on one side than on the "
                "other: call an element and its image by `name` and `mirrored`, and each the other",
            )
    for phase in others:
        for item, of in (
            ("feet", lambda p: sorted(p.feet)),
            ("load point", lambda p: p.load_point is not None),
            ("bodies", lambda p: [(b.name, b.outline, b.copies, b.apart) for b in p.bodies]),
            ("elements", lambda p: elements_of(p)[0]),
            ("quantities", lambda p: [(name, unit) for name, (unit, _) in p.quantities.items()]),
        ):
            if of(phase) != of(first):
                fail(
                    model,
                    f"mechanisms {'/'.join(first.contacts)} and {'/'.join(phase.contacts)} differ "
                    f"in {item}: declare the same in each, in the same order",
                )


# What may stand where
_PLACES, _RATES, _ACCELERATIONS, _SIDED, _GROUND, INTERNAL = "qvasgz"
_WORDS = {
    _PLACES: "the coordinate",
    _RATES: "the velocity",
    _ACCELERATIONS: "the acceleration",
    _SIDED: "the side",
    _GROUND: "the ground's acceleration",
    INTERNAL: "the internal variable",
}


def declared_kinds(model: RockingModel | Model) -> dict[sp.Basic, str]:
    """What each symbol and function of a declaration is; "" for constants."""
    from rockeom.symbolic.model import GROUND_X, GROUND_Y

    kinds: dict[sp.Basic, str] = {p.symbol: "" for p in model.parameters}
    kinds |= {d.symbol: "" for d in model.definitions}
    for c in model.coordinates:
        kinds |= {c.position: _PLACES, c.velocity: _RATES, c.acceleration: _ACCELERATIONS}
    kinds |= {SIDE: _SIDED, GROUND_X: _GROUND, GROUND_Y: _GROUND}
    for law in model.functions:
        kinds[law.symbol if law.symbol.is_Symbol else law.symbol.func] = _PLACES
    return kinds


def _expressions(model: RockingModel) -> Iterator[tuple[str, Any, str]]:
    """(item, expression, what it may contain besides constants)."""
    for d in model.definitions:
        yield f"definition {d.name!r}", d.value, ""
    for law in model.functions:
        yield f"function {law.name!r}", law.symbol, _PLACES
        yield f"function {law.name!r}", law.value, "qvs" if law.symbol.is_Symbol else "qs"
    for phase in model.mechanisms:
        of = f" in mechanism {'/'.join(phase.contacts)}"
        for b in phase.bodies:
            body = f" of body {b.name!r}{of}"
            yield f"mass{body}", b.mass, "qs"
            yield f"inertia{body}", b.inertia, "qs"
            yield f"rotation{body}", b.rotation, "qs"
            for axis, e in zip("xy", b.position, strict=True):
                yield f"{axis}{body}", e, "qs"
            yield from shape(b)
        yield f"gravity{of}", phase.gravity, ""
        yield f"elastic energy{of}", phase.elastic_energy, "qs"
        yield f"dissipation{of}", phase.dissipation, "qvs"
        for spring in phase.elements:
            element = f" of element {spring.name!r}{of}"
            yield f"deformation{element}", spring.deformation, "qs"
            for constant, e in (*spring.constants.items(), ("initial force", spring.initial_force)):
                yield f"{constant}{element}", e, "s"
        for c, e in zip(phase.coordinates, phase.forces, strict=False):
            yield f"force on {c.name!r}{of}", e, "qvs"
        for name, foot in phase.feet.items():
            for axis, e in zip("xy", foot.position, strict=True):
                yield f"{axis} of the {name} foot{of}", e, "qs"
            if foot.force is not None:
                yield f"force on the {name} foot{of}", foot.force, "qvasg"
        for axis, e in zip("xy", phase.beside_feet, strict=True):
            yield f"{axis} of the force beside the feet{of}", e, "qvsg"
        for axis, e in zip("xy", phase.load_point or (), strict=False):
            yield f"{axis} of the load point{of}", e, "qs"
        for x in phase.small:
            yield f"small symbol {x}{of}", x, "qvg"
        for name, (unit, e) in phase.quantities.items():
            yield f"quantity {name!r}{of}", e, "qvs" if unit == "m" else "qvasg"
    for t in model.transitions:
        if t.guard is not None:
            yield f"guard of {_called(t)}", t.guard, "qvsg"
        for x, e in t.sets.items():
            yield f"{x} set by {_called(t)}", e, "qvs"
    yield "overturning", model.overturning, ""
    yield from constants(model)
    if model.rigid_velocity_ratio is not None:
        yield "rigid_velocity_ratio", model.rigid_velocity_ratio, ""


def shape(body: Body) -> Iterator[tuple[str, Any, str]]:
    """What a sketch shows of a body is fixed to it."""
    of = f"of the outline of body {body.name!r}"
    for corner in body.outline:
        for axis, e in zip("xy", corner, strict=True):
            yield f"{axis} of a corner {of}", e, ""
    yield f"the number of copies {of}", body.copies, ""
    yield f"the distance of copies {of}", body.apart, ""


def constants(model: RockingModel | Model) -> Iterator[tuple[str, Any, str]]:
    """Ends of members, and sizes at which coordinates have fallen."""
    for m in model.members:
        for at in (*m.start_at, *m.end_at):
            yield f"an end of the {m.kind} from {m.start!r} to {m.end!r}", at, ""
    for c, size in model.falls.items():
        yield f"size at which {c.name!r} has fallen", size, ""


def sketched(model: RockingModel | Model) -> None:
    """What has a place has a name of its own; members end at bodies; what falls is a coordinate."""
    from rockeom.symbolic.model import GROUND, Coordinate, Member
    from rockeom.symbolic.places import LOAD, bodies_of, names_of

    twice = repeated(names_of(model))
    if twice:
        fail(
            model,
            f"{', '.join(twice)} is the name of two of its bodies, contacts and elements, and the "
            f"load point, which is called {LOAD!r}: give each a name of its own",
        )
    bodies = [b.name for b in bodies_of(model)]
    for m in model.members:
        if not isinstance(m, Member):
            fail(model, f"members holds {m!r}: give objects of Member")
        for item, name in (("start", m.start), ("end", m.end)):
            valid.known(f"{model.name}: member", item, name, (*bodies, GROUND))
    if not isinstance(model.falls, Mapping):
        fail(model, f"falls is {model.falls!r}: give a mapping, {{coordinate: size}}")
    for c, size in model.falls.items():
        if not isinstance(c, Coordinate) or c not in model.coordinates or c == model.rotation:
            others = [c.name for c in model.coordinates if c != model.rotation]
            fail(
                model,
                f"falls holds {getattr(c, 'name', c)!r}: name coordinates beside the rotation, of "
                f"which there are {', '.join(others) or 'none'}",
            )
        valid.expressions(f"{model.name}: falls", **{c.name: size})
        if sp.sympify(size).is_nonpositive:
            fail(model, f"falls: the size of {c.name!r} is {size}: it must be positive")


def _called(t: Transition) -> str:
    return f"{t.kind} {t.source!r} -> {t.target!r}"


def contents(
    model: RockingModel | Model, known: Mapping[sp.Basic, str], item: str, expr: sp.Expr, kinds: str
) -> None:
    for f in expr.atoms(sp.Function) - expr.atoms(AppliedUndef, sp.Piecewise):
        try:
            pycode(f.func(*(sp.Symbol(f"x{i}", real=True) for i in range(len(f.args)))))
        except NotImplementedError:
            fail(model, f"{item} contains {f.func}, which Python's math module does not know")
    used = expr.free_symbols | {f.func for f in expr.atoms(AppliedUndef)}
    unknown = sorted(str(x) for x in used if x not in known)
    if unknown:
        names = {str(x) for x in known}
        hint = (
            "; a declared one of that name has other assumptions: use its `.symbol` or `.position`"
            if names & set(unknown)
            else ""
        )
        fail(
            model,
            f"{item} contains undeclared symbols {', '.join(unknown)}: add them to `parameters` "
            f"or `coordinates`{hint}",
        )
    for x in sorted(used, key=str):
        if known[x] not in kinds:
            fail(
                model,
                f"{item} contains {_WORDS[known[x]]} {x}, which it must not: it is a function of "
                + (", ".join(["the parameters", *(_WORDS[k] for k in kinds)])),
            )


def _transitions(model: RockingModel) -> None:
    for t in model.transitions:
        what = f"{model.name}: transition {t.source!r} -> {t.target!r}"
        valid.known(what, "kind", t.kind, KINDS)
        for item, contact in (("source", t.source), ("target", t.target), ("fallback", t.fallback)):
            if contact is not None or item != "fallback":
                valid.known(what, item, contact, model.contacts)
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
        fail(model, f"two impacts end the contact state {repeated(impacts)[0]!r}: declare one")
    _pairs(model)


def _side(model: RockingModel, contact: str) -> int:
    return model.mechanism(contact).side_of(contact)


def _impact(model: RockingModel, t: Transition, what: str) -> None:
    """The rotation falls to zero, and the structure goes on about its other foot."""
    side, gap = _side(model, t.source), model.rotation.position
    name = model.rotation.name
    if side == 0 or _side(model, t.target) != -side:
        raise ValueError(
            f"{what}: an impact leads from a contact state of side -1 or 1 to one of the other "
            f"side, not from {side} to {_side(model, t.target)}; full contact is its `fallback`, "
            "and a foot that lands out of flight is not modelled: declare a spring, and a switch"
        )
    if t.fallback is not None and _side(model, t.fallback) != 0:
        raise ValueError(f"{what}: the fallback {t.fallback!r} must be a contact state of side 0")
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


def _uplift(model: RockingModel, t: Transition, what: str) -> None:
    """The rotation, held until now, becomes free."""
    if t.guard is not None:
        raise ValueError(f"{what}: the guard of an uplift is derived: leave `guard` out")
    free = model.rotation in model.mechanism(t.source).coordinates
    if _side(model, t.source) != 0 or free or _side(model, t.target) == 0:
        raise ValueError(
            f"{what}: an uplift leads from full contact (side 0, the rotation held) to rocking "
            "(side -1 or 1)"
        )
    foot = "left" if _side(model, t.target) < 0 else "right"
    for contact, name in ((t.source, "both"), (t.target, foot)):
        if contact.split("_")[0] != name:
            raise ValueError(f"{what}: call {contact!r} {name!r}, or {name}_...")
    for contact in ("left", "both", "right"):
        if contact not in model.contacts:
            raise ValueError(f"{what}: a structure that lifts has a contact state {contact!r}, too")


def _switch(model: RockingModel, t: Transition, what: str) -> None:
    if t.guard is None:
        raise ValueError(f"{what}: a switch needs a guard, positive inside {t.source!r}")
    if isinstance(t.guard, sp.Max) and len(t.guard.args) != 2:
        raise ValueError(f"{what}: its guard is the Max of {len(t.guard.args)}: give two at most")


def _pairs(model: RockingModel) -> None:
    """A passage and the one back cannot have the same guard: each is positive in its source."""
    switches = [t for t in model.transitions if t.kind == "switch"]
    places = {c: i for i, c in enumerate(model.contacts)}
    by_ends = {(t.source, t.target): t for t in switches}
    for (source, target), t in by_ends.items():
        back = by_ends.get((target, source))
        if back is None or places[source] > places[target]:
            continue
        if sp.sympify(t.guard).is_negative:  # it is passed at once, and meant to be
            continue
        mine, other = (set(_parts(model, x)) for x in (t, back))
        if mine & other:
            fail(
                model,
                f"the guards of {_called(t)} and of {_called(back)} have one sign "
                f"({', '.join(map(str, mine & other))}): each must be positive inside its source",
            )


def _parts(model: RockingModel, t: Transition) -> list[sp.Expr]:
    parts = t.guard.args if isinstance(t.guard, sp.Max) else (t.guard,)
    return [sp.expand(at_side(e, _side(model, t.source))) for e in parts]


def _grounded(model: RockingModel) -> None:
    """No way into the ground is open."""
    impacts = {t.source for t in model.transitions if t.kind == "impact"}
    lifted = {t.target for t in model.transitions if t.kind != "switch"}
    for phase in model.mechanisms:
        rigid = any(foot.force is None for foot in phase.feet.values())
        held = model.rotation not in phase.coordinates
        for contact, side in phase.contacts.items():
            out = [t for t in model.transitions if t.source == contact]
            if side and (not out or ((rigid or contact in lifted) and contact not in impacts)):
                fail(
                    model,
                    f"no impact ends the contact state {contact!r}, and the structure would turn "
                    f'into the ground: add Transition("{contact}", ..., "impact", guard='
                    f"{side * model.rotation.position})",
                )
            if not side and rigid and not held:
                fail(
                    model,
                    f"the rotation is free in the contact state {contact!r}, which has no side, "
                    "and its feet have no force: declare the force on each foot",
                )
            ends = {_side(model, t.target) for t in out if t.kind == "uplift"}
            if not side and rigid and ends != {-1, 1}:
                fail(
                    model,
                    f"the contact state {contact!r} lifts to {len(ends)} of the two sides: add "
                    f'Transition("{contact}", "left", "uplift"), and the same to "right"',
                )


# --- what follows from a declaration

_SAMPLES = 200
_NEGLIGIBLE = 1e-9


def check_derived(model: RockingModel) -> None:
    """Equations, impacts and guards of a declaration, at random states and parameters."""
    sample = Sample(model)
    matrices = {p.equations.mass_matrix.as_immutable(): p for p in reversed(model.mechanisms)}
    for phase in reversed(matrices.values()):
        invertible(model, phase, sample)
    _one_ratio(model, sample)
    _guards_open(model, sample)
    _rests(model, sample)
    _energies_are_even(model, sample)


class Sample:
    """Random values of all symbols, by which expressions become arrays (k, n)."""

    def __init__(self, model: RockingModel | Model) -> None:
        from rockeom.symbolic.model import GROUND_X, GROUND_Y

        rng = np.random.default_rng(1)
        self.model = model
        self.values: dict[sp.Symbol, np.ndarray] = {}
        self.functions: dict[tuple[str, tuple[sp.Expr, ...]], Any] = {}
        for p in model.parameters:
            size = 2.0 ** rng.uniform(-1, 1, _SAMPLES)
            sign = 1.0 if p.symbol.is_nonnegative else rng.choice([-1.0, 1.0], _SAMPLES)
            self.values[p.symbol] = sign * size
        for c in model.coordinates:
            for x in (c.position, c.velocity, c.acceleration):
                size = 10.0 ** rng.uniform(-3, 3, _SAMPLES)
                self.values[x] = rng.choice([-1.0, 1.0], _SAMPLES) * size
        for x in (GROUND_X, GROUND_Y):
            self.values[x] = rng.uniform(-1, 1, _SAMPLES)

    def __call__(
        self,
        contact: str,
        expressions: Iterable[sp.Expr],
        put: Mapping[sp.Symbol, Any] | None = None,
    ) -> np.ndarray:
        """Values (k, n) in a contact state, those of some symbols changed."""
        from rockeom.symbolic.evaluate import array_function

        values = {**self.values, **(put or {})}
        given = [np.broadcast_to(v, _SAMPLES) for v in values.values()]
        key = contact, tuple(expressions)
        if key not in self.functions:  # some are asked for with other values of many symbols
            written = [
                self.model.in_contact(e, contact).xreplace(self.model.constants) for e in key[1]
            ]
            self.functions[key] = array_function(list(values), written)
        with np.errstate(all="ignore"):
            return self.functions[key](given)


def _contact_of(phase: Mechanism) -> str:
    return next(iter(phase.contacts))


def invertible(model: RockingModel | Model, phase: Mechanism, sample: Sample) -> None:
    """Each free coordinate moves a mass of its own."""
    n = len(phase.coordinates)
    if n == 0:
        return
    found = sample(_contact_of(phase), phase.equations.mass_matrix)
    matrices = np.moveaxis(found.reshape(n, n, -1), -1, 0)
    matrices = matrices[np.isfinite(matrices).all(axis=(1, 2))]
    for i, c in enumerate(phase.coordinates):
        if len(matrices) and not (matrices[:, i, i] > 0).any():
            fail(
                model,
                f"the coordinate {c.name!r} moves no mass in mechanism {'/'.join(phase.contacts)}: "
                "its mass matrix is singular; give a body whose position contains it a mass",
            )
    size = np.sqrt(np.abs(np.diagonal(matrices, axis1=1, axis2=2)))
    with np.errstate(all="ignore"):
        lowest = np.linalg.eigvalsh(matrices / size[:, :, None] / size[:, None, :])[:, 0]
    if len(lowest) and not (lowest > 1e-12).any():
        fail(
            model,
            f"the mass matrix of mechanism {'/'.join(phase.contacts)} is singular: its coordinates "
            f"{', '.join(c.name for c in phase.coordinates)} move fewer masses than they are",
        )


def _one_ratio(model: RockingModel, sample: Sample) -> None:
    """The laws of impact multiply the rate by one ratio, whichever side closes."""
    from rockeom.symbolic.impulse import rigid_velocity_ratio

    impacts = [t for t in model.transitions if t.kind == "impact"]
    if model.rigid_velocity_ratio is not None or len(impacts) < 2:
        return
    first, *others = impacts
    ratios = sample(first.source, [rigid_velocity_ratio(model, t) for t in impacts])
    for t, ratio in zip(others, ratios[1:], strict=True):
        if not np.allclose(ratio, ratios[0], rtol=_NEGLIGIBLE, atol=0, equal_nan=True):
            fail(
                model,
                f"the ratio of the rates of rotation differs between {_called(first)} and "
                f"{_called(t)}: the feet are not equally far from the masses, which is not "
                "modelled; make both sides alike, or give `rigid_velocity_ratio`, or declare a "
                "Model whose feet have the law Rigid(restitution=0, friction=None)",
            )


def _guards_open(model: RockingModel, sample: Sample) -> None:
    """A contact state of one side has states on that side inside it."""
    theta = model.rotation.position
    for side in sorted({_side(model, contact) for contact in model.contacts} - {0}):
        here = [contact for contact in model.contacts if _side(model, contact) == side]
        out = [t for t in model.transitions if t.source in here and t.kind == "switch"]
        if not out:
            continue
        # many contact states of a side have the same guards
        guards = list(dict.fromkeys(t.guard for t in out))
        put = {theta: side * np.abs(sample.values[theta])}
        found = dict(zip(guards, sample(here[0], guards, put), strict=True))
        for t in out:
            values = found[t.guard]
            known = values[np.isfinite(values)]
            if known.size and not (known > 0).any():
                fail(
                    model,
                    f"the guard of {_called(t)} is nowhere positive where {model.rotation.name!r} "
                    f"has the sign of {t.source!r}: it must be positive inside its source; turn "
                    "its sign",
                )


def _at_rest(model: RockingModel) -> dict[sp.Symbol, Any]:
    """No coordinate has moved. Parameters of either sign, which may make sides differ, are zero."""
    states = {x: 0.0 for c in model.coordinates for x in (c.position, c.velocity)}
    return states | {p.symbol: 0.0 for p in model.parameters if not p.symbol.is_nonnegative}


def _rests(model: RockingModel, sample: Sample) -> None:
    """Springs do not push the structure away from where it is said to rest.

    Without a spring at work, or where it carries the weight, a coordinate may be zero.
    """
    pushed: dict[str, bool] = {}
    for phase in model.mechanisms:
        eq, n = phase.equations, len(phase.coordinates)
        others = [c for c in phase.coordinates if c != model.rotation]
        if not others or not any(t.kind != "switch" for t in model.transitions):
            continue
        parts = sample(_contact_of(phase), (*eq.stiffness, *eq.gravity, *eq.force), _at_rest(model))
        elastic, weight, force = parts.reshape(3, n, -1)
        bound = _NEGLIGIBLE * (np.abs(elastic) + np.abs(weight) + np.abs(force))
        wrong = (np.abs(elastic) > bound) & (np.abs(elastic + weight - force) > bound)
        for c, found in zip(phase.coordinates, wrong, strict=True):
            if c != model.rotation:
                pushed[c.name] = pushed.get(c.name, True) and bool(found.any())
    for name in (name for name, always in pushed.items() if always):
        fail(
            model,
            f"the elastic energy pushes {name!r} away from zero, where the structure is said to "
            "rest: declare an energy such as k u**2/2, not a force",
        )


def _energies_are_even(model: RockingModel, sample: Sample) -> None:
    """The elastic energy does not rise to one side of rest while it falls to the other.

    Of a coordinate that is not the rotation, less what a spring that is compressed at rest gives.
    """
    rest = _at_rest(model)
    pairs = {(t.source, t.target) for t in model.transitions if t.kind == "impact"}
    for one, other in sorted(pairs):
        if _side(model, one) > 0:
            continue
        phase = model.mechanism(one)
        energy, slopes = phase.equations.elastic_energy, phase.equations.stiffness
        for c, slope in zip(phase.coordinates, slopes, strict=True):
            if not model.written_out(energy).has(c.position):
                continue
            turns = c == model.rotation
            gains = []
            for way, contact in ((-1, one), (1, other if turns else one)):
                (there,) = sample(contact, [energy], {**rest, c.position: 1e-2 * way})
                here, given = sample(contact, [energy, slope], rest)
                given = 0.0 * given if turns else 1e-2 * way * given
                gain = there - here - given
                gains.append(
                    np.sign(gain) * (np.abs(gain) > 1e-12 * (np.abs(there) + np.abs(given)))
                )
            if np.all(gains[0] * gains[1] < 0):
                fail(
                    model,
                    f"the elastic energy with contact {one!r} rises where {c.name!r} moves to one "
                    "side and falls on the other: it must grow to either side, as k u**2/2 does, "
                    "or k s theta with the side s",
                )


# --- the values of its parameters


def check_values(model: RockingModel | Model, values: Mapping[str, float]) -> None:
    """Masses must not be negative, and the left foot stands to the left of the right one."""
    put = {p.symbol: sp.Float(float(values[p.name])) for p in model.parameters}
    for size in sizes(model):
        found = size.value.xreplace(put)
        if found > 0 or (found == 0 and size.may_vanish):
            continue
        given = ", ".join(f"{name} = {values[name]}" for name in size.parameters)
        fail(model, f"{size.what} is {float(found):g} with {given}: {size.remedy}")


class Size(NamedTuple):
    """What the parameters must make positive, or no less than zero where it may vanish."""

    what: str
    value: sp.Expr
    may_vanish: bool
    parameters: tuple[str, ...]
    remedy: str


def sizes(model: RockingModel | Model) -> tuple[Size, ...]:
    """Masses, moments of inertia, widths of bases, laws of contacts, that parameters alone give."""
    from rockeom.symbolic.model import RockingModel

    symbols = {p.symbol: p.name for p in model.parameters}

    def size(what: str, value: sp.Expr, may_vanish: bool, remedy: str) -> Size:
        value = sp.sympify(value).xreplace(model.constants)
        names = tuple(n for symbol, n in symbols.items() if symbol in value.free_symbols)
        return Size(what, value, may_vanish, names, remedy)

    def of(phase: Mechanism) -> Iterator[Size]:
        for b in phase.bodies:
            for what, value in (("mass", b.mass), ("moment of inertia", b.inertia)):
                yield size(f"the {what} of body {b.name!r}", value, True, "it must not be negative")
        if phase.feet:
            left, right = (sp.sympify(phase.feet[f].position[0]) for f in ("left", "right"))
            width = model.in_contact((right - left).subs(upright), _contact_of(phase))
            remedy = "the left foot must stand to the left of the right one"
            yield size("the distance of the feet", width, False, remedy)

    def of_points(points: Iterable[Contact]) -> Iterator[Size]:
        for c in points:
            at = f"of contact {c.name!r}"
            law = c.law
            yield size(f"1 less the restitution {at}", 1 - law.restitution, True, "give 0 to 1")
            if law.friction is not None:
                yield size(f"the friction {at}", law.friction, True, "it must not be negative")
            if c.side:
                width = c.side * (c.at(c.side)[1] - c.at(-c.side)[1]).subs(upright)
                remedy = "the point of side -1 must stand to the left of that of side 1"
                yield size(f"the width {at}", width, False, remedy)

    def of_elements(elements: Iterable[Element]) -> Iterator[Size]:
        for e in elements:
            for what, value in e.constants.items():
                at = f"the {what} of element {e.name!r}"
                remedy = "give a positive one" if what in e.positive else "it must not be negative"
                yield size(at, value, what not in e.positive, remedy)

    upright = {c.position: 0 for c in model.coordinates}
    every = dict.fromkeys(found for phase in model.mechanisms for found in of(phase))
    if not isinstance(model, RockingModel):
        every |= dict.fromkeys((*of_points(model.contacts), *of_elements(model.elements)))
    return tuple(found for found in every if found.value.free_symbols <= symbols.keys())


# --- a structure that rocks about the edges of its base


def check_turning(name: str, rocking: Mechanism, rotation: Coordinate) -> None:
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


__all__ = ["Size", "check", "check_derived", "check_turning", "check_values", "sizes"]
