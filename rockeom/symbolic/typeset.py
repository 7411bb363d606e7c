"""Derived equations for people: LaTeX and Markdown, as one would write them in a paper."""

from __future__ import annotations

import re
from collections.abc import Iterable

import sympy as sp

from rockeom.symbolic.algebra import SIDE, angles_in, tidy
from rockeom.symbolic.contact import reactions, total_reaction
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.model import (
    GROUND_X,
    GROUND_Y,
    Coordinate,
    Mechanism,
    NamedFunction,
    RockingModel,
    Transition,
)
from rockeom.symbolic.notation import AFTER, BEFORE, Notation, at_impact
from rockeom.symbolic.page import (
    LINE,
    Block,
    Display,
    Heading,
    Table,
    environment,
    to_latex,
    to_markdown,
    width,
)
from rockeom.symbolic.polar import has_polar_form, in_polar_form, polar_model, polar_parameters
from rockeom.symbolic.statics import holding_force, pushover


def equation_lines(phase: Mechanism, form: str = "width") -> list[str]:
    """One line of LaTeX an equation of motion, in the order of the mechanism's coordinates.

    Left: accelerations, velocities, damping, gravity, stiffness; right: excitation, horizontal
    then vertical, and declared forces. `form` is "width" (B, H) or "polar" (R, alpha).
    Raises ValueError if `form` is neither or the mechanism has no polar form.
    """
    _check(form)
    equations = in_polar_form(phase) if form == "polar" else phase.equations
    return _equation_lines(equations, phase.coordinates, Notation(phase))


def equations_latex(phase: Mechanism, form: str = "width") -> str:
    """The equations of motion as an `aligned` block, a line each; "" if no coordinate is free."""
    lines = [line.replace(" = ", " &= ") for line in equation_lines(phase, form)]
    return environment("aligned", lines) if lines else ""


def latex_document(model: RockingModel | Model, form: str = "width") -> str:
    """A LaTeX article on the whole structure, in width form where it has no polar one.

    Raises ValueError if `form` is neither "width" nor "polar".
    """
    return to_latex(content(model, form))


def markdown_page(model: RockingModel | Model) -> str:
    """The same in Markdown, with mathematics between dollar signs."""
    return to_markdown(content(model, "width"))


def notebook_display(model: RockingModel) -> str:
    """The equations of motion of the model's first phase, as a notebook shows the model."""
    return f"$${equations_latex(model.mechanisms[0])}$$"


def _check(form: str) -> None:
    if form not in ("width", "polar"):
        raise ValueError(f'form must be "width" (B, H) or "polar" (R, alpha), not {form!r}')


def _equation_lines(
    equations: Equations, coordinates: tuple[Coordinate, ...], notation: Notation
) -> list[str]:
    lines = []
    for i in range(len(coordinates)):
        accelerations = [
            equations.mass_matrix[i, j] * c.acceleration for j, c in enumerate(coordinates)
        ]
        statics = [equations.gravity[i], equations.stiffness[i]]
        # one sum where weight and spring cancel in part, as about a settled position
        apart = [term for part in statics for term in notation.terms(part)]
        if len(notation.terms(sum(statics))) < len(apart):
            statics = [sum(statics)]
        parts = [*accelerations, equations.velocity[i], equations.damping[i], *statics]
        left = notation.sum([notation.write(part) for part in parts if part != 0])
        given = [part for part in (equations.excitation[i], equations.force[i]) if part != 0]
        lines.append(f"{left} = {notation.sum([notation.write(part) for part in given])}")
    return lines


# --- what a document says


def content(model: RockingModel | Model, form: str) -> list[Block]:
    """All that was derived of a structure."""
    _check(form)
    model = model.reduced
    if isinstance(model, Model):
        from rockeom.symbolic.contact_page import contact_content

        return contact_content(model)
    polar = form == "polar" and any(has_polar_form(phase) for phase in model.mechanisms)
    shown = polar_model(model) if polar else model
    blocks: list[Block] = [Heading(1, model.title)]
    blocks += [f"Reference: {model.reference}."] if model.reference else []
    blocks += symbols_of(model, polar)
    for phase, original in zip(shown.mechanisms, model.mechanisms, strict=True):
        # where no body is placed by R and alpha, the geometry left is that of B and H
        blocks += _phase(model, phase if has_polar_form(phase) else original)
    return [*blocks, *_transitions(shown), *_pushover(shown)]


def symbols_of(
    model: RockingModel | Model, polar: bool, signs: Iterable[tuple[sp.Symbol, str]] = ()
) -> list[Block]:
    notation = Notation(model.mechanisms[0], model)
    header = ("Symbol", "Name", "Unit", "Meaning")

    def row(symbol: sp.Symbol, name: str, unit: str, meaning: str) -> tuple[str, ...]:
        unit = re.sub(r"(?<=[a-z])[23]", lambda m: {"2": "²", "3": "³"}[m[0]], unit)
        return f"${notation.plain(symbol)}$", name and f"`{name}`", unit, meaning

    rows = [row(c.position, c.name, c.unit, c.meaning) for c in model.coordinates]
    if isinstance(model, Model):
        rows += [row(z.symbol, z.name, z.unit, z.meaning) for z in model.internal]
    rows += [row(p.symbol, p.name, p.unit, p.meaning) for p in model.parameters]
    unit = "m/s2" if model.mechanisms[0].gravity.free_symbols else "g"
    rows += [
        row(GROUND_X, "", unit, "horizontal ground acceleration, positive to the right"),
        row(GROUND_Y, "", unit, "vertical ground acceleration, positive upwards"),
    ]
    if any(phase.has_side for phase in model.mechanisms):
        side = rf"\operatorname{{sgn}} {notation.plain(model.rotation.position)}"
        rows.append(row(SIDE, "", "-", f"side, ${side}$"))
    rows += [row(symbol, "", "-", meaning) for symbol, meaning in signs]
    blocks: list[Block] = [
        Heading(2, "Symbols"),
        Table(header, tuple(rows)),
        "Dots denote derivatives with respect to time.",
    ]
    if isinstance(model, Model):
        return blocks
    blocks += _laws(model, notation)
    derived = [(d.symbol, d.name, d.unit, d.meaning, d.value) for d in model.definitions]
    if polar:
        derived += [(p.symbol, "", p.unit, p.meaning, e) for p, e in polar_parameters(model)]
    known: dict[sp.Symbol, sp.Expr] = {}
    lines = []
    for symbol, *_, value in derived:
        lines.append(f"{notation.plain(symbol)} = {notation.plain(_in_terms_of(known, value))}")
        known[symbol] = value
    if derived:
        table = Table(header, tuple(row(*words) for *words, _ in derived))
        blocks += ["Constants that follow from these:", table, Display(tuple(lines))]
    return blocks


def _laws(model: RockingModel, notation: Notation) -> list[Block]:
    """What the equations name of the coordinates, written out."""
    if not model.functions:
        return []
    rows = tuple(
        (f"${notation.plain(x.symbol)}$", f"`{x.name}`", x.unit, x.meaning) for x in model.functions
    )
    q = notation.plain(model.rotation.position)
    held = [
        law for law in model.functions if law.symbol.is_Symbol and law.unit == "m"
    ]  # in positions
    text = f"Functions that the equations name; a prime is a derivative with respect to ${q}$."
    for law in held:
        symbol = notation.plain(law.symbol)
        text += f" Lagrange's equations take ${symbol}$ as a constant at each instant."
    table = Table(("Symbol", "Name", "Unit", "Meaning"), rows)
    whole = [law for law in model.functions if not isinstance(law.value, sp.Piecewise)]
    lines = (f"{notation.plain(x.symbol)} = {notation.plain(x.value)}" for x in whole)
    pieces = [_pieces(law, notation) for law in model.functions if law not in whole]
    return [text, table, Display(tuple(lines)), *pieces]


def _pieces(law: NamedFunction, notation: Notation) -> str:
    """A law in pieces, each below a limit and the last one beyond all, as a sentence."""
    words = []
    for value, holds in law.value.args:
        limit = "beyond" if holds == True else f"for ${notation.plain(holds.lhs)}$ below "  # noqa: E712
        limit += "" if holds == True else f"${notation.plain(holds.rhs)}$"  # noqa: E712
        words.append(f"${notation.plain(value)}$ {limit}")
    return f"${notation.plain(law.symbol)}$ is {', '.join(words)}."


def _in_terms_of(known: dict[sp.Symbol, sp.Expr], expr: sp.Expr) -> sp.Expr:
    """`expr`, the angles in it written by the constants known before where that is shorter."""
    for symbol, value in known.items():
        for angle in angles_in(expr):
            ratio = sp.cancel(angle / value)
            if ratio.count_ops() + 1 < angle.count_ops():
                expr = expr.subs(angle, ratio * symbol)
    return expr


def listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _sides(phase: Mechanism) -> str:
    return ", ".join(f"$s = {side:+d}$ in `{name}`" for name, side in phase.contacts.items())


def _phase(model: RockingModel, phase: Mechanism) -> list[Block]:
    notation, equations = Notation(phase, model), phase.equations
    blocks: list[Block] = [Heading(2, f"Contact {listed(phase.contacts)}")]
    blocks += [f"One form for both sides: {_sides(phase)}."] if phase.has_side else []
    if phase.small:
        small = ", ".join(f"${notation.plain(x)}$" for x in phase.small)
        blocks.append(f"Energies are kept to second order in the small quantities {small}.")
    blocks.append(Heading(3, "Equations of motion"))
    if phase.coordinates:
        lines = _equation_lines(equations, phase.coordinates, notation)
        blocks.append(Display(tuple(lines)))
    else:
        blocks.append("No coordinate is free: the structure stands still on the ground.")
    energies = [
        f"T = {notation.write(equations.kinetic_energy)}",
        f"V_g = {notation.write(equations.gravitational_energy)}",
        f"V_e = {notation.plain(equations.elastic_energy)}",
        f"D = {notation.plain(phase.dissipation_function)}",
    ]
    energies = [line for line in energies if not line.endswith(" = 0")]
    return [
        *blocks,
        Heading(3, "Energies"),
        "Kinetic energy $T$, potential energies of gravity $V_g$ and of springs $V_e$, half the "
        "power lost to damping $D$; what is not shown is zero.",
        *([Display(tuple(energies))] if energies else []),
        Heading(3, "Support reactions"),
        *_reactions(model, phase, notation),
    ]


def _reactions(model: RockingModel, phase: Mechanism, notation: Notation) -> list[Block]:
    forces = reactions(model, phase)
    lines = [f"F = {notation.write(forces['horizontal_reaction'])}"]
    text = "Force of the ground on the structure, horizontal $F$"
    if phase.has_side and phase.feet:
        lines.append(f"N = {notation.write(total_reaction(phase)[1])}")
        text += ", vertical $N$ at the foot on the ground: the right one for $s = +1$, "
        text += "the left one for $s = -1$."
    elif phase.feet:
        for foot in ("left", "right"):
            given = phase.feet[foot].force is not None
            force = (notation.plain if given else notation.write)(forces[f"{foot}_reaction"])
            lines.append(rf"N_{{\mathrm{{{foot}}}}} = {force}")
        text += " (sum over both feet), vertical $N$ at each foot."
    return [text if text.endswith(".") else text + ".", Display(tuple(lines))]


# --- transitions and statics


def _transitions(model: RockingModel) -> list[Block]:
    order = {name: i for i, phase in enumerate(model.mechanisms) for name in phase.contacts}
    groups: dict[tuple, list[Transition]] = {}
    for t in model.transitions:
        key = (t.kind, order[t.source], order[t.target], order.get(t.fallback or "", -1))
        groups.setdefault(key, []).append(t)
    blocks: list[Block] = [Heading(2, "Transitions")]
    for group in groups.values():
        guard = _common_guard(model, group)
        for alike in [group] if guard is not None else [[t] for t in group]:
            blocks += _transition(model, alike, alike[0].guard if guard is None else guard)
    ratio = model.velocity_ratio
    if ratio is not None:
        dot = Notation(model.mechanisms[0], model).plain(model.rotation.velocity)
        e = Notation(model.mechanisms[0], model).quotient(ratio)
        blocks += [
            Heading(3, "Velocity ratio of the rigid structure"),
            "After and before an impact, all other coordinates held at zero:",
            Display((rf"e = \frac{{{dot}^+}}{{{dot}^-}} = {e}",)),
        ]
    return blocks


def _common_guard(model: RockingModel, group: list[Transition]) -> sp.Expr | None:
    """The guard written once with s for the transitions of both sides; 0 if they have none."""
    if all(t.guard is None for t in group):
        return sp.Integer(0)
    q = model.rotation
    for t in group:
        if model.mechanism(t.source).side_of(t.source) == 1 and t.guard is not None:
            flip = {q.position: SIDE * q.position, q.velocity: SIDE * q.velocity}
            common = t.guard.subs(flip, simultaneous=True)
            sides = [model.mechanism(other.source).side_of(other.source) for other in group]
            if all(common.subs(SIDE, s) == o.guard for s, o in zip(sides, group, strict=True)):
                return common
    return None


def _transition(model: RockingModel, alike: list[Transition], guard: sp.Expr | None) -> list[Block]:
    first = alike[0]
    notation = Notation(model.mechanism(first.source), model)
    passages = ", ".join(f"`{t.source}` to `{t.target}`" for t in alike)
    blocks: list[Block] = [Heading(3, f"{first.kind.capitalize()}: {passages}")]
    theta, rate, acceleration = (
        notation.plain(x)
        for x in (model.rotation.position, model.rotation.velocity, model.rotation.acceleration)
    )
    if first.kind == "uplift":
        blocks.append(
            f"The foot opposite to the new pivot lifts when $s {acceleration} > 0$, with "
            f"${acceleration}$ from the equations of the contact that would follow at "
            f"${theta} = 0$, ${rate} = 0$, and {_sides(model.mechanism(first.target))}. "
            "That is when its vertical reaction falls to zero."
        )
        return blocks
    ends = "The gap closes" if first.kind == "impact" else "The contact changes"
    short, *lines = _guard_lines(notation, sp.sympify(guard))
    go_on = "" if first.kind == "impact" else "; velocities go on unchanged"
    blocks.append(f"{ends} when ${short}$ falls through zero{go_on}{':' if lines else '.'}")
    blocks += [Display(tuple(lines))] if lines else []
    for t in alike if first.sets else ():
        put = tuple(f"{notation.plain(x)} = {notation.plain(e)}" for x, e in t.sets.items())
        blocks += [f"From `{t.source}` to `{t.target}` this is put to a new value:", Display(put)]
    if first.kind != "impact":
        return blocks
    if model.rigid_velocity_ratio is not None:
        return [*blocks, f"The velocity after it is ${rate}^+ = e {rate}^-$, with $e$ below."]
    blocks += _impulse(model, first.source, first.target)
    if first.fallback:
        blocks.append(f"If the old foot cannot lift after it, `{first.fallback}` follows instead.")
        blocks += _impulse(model, first.source, first.fallback)
    return blocks


def _guard_lines(notation: Notation, guard: sp.Expr) -> list[str]:
    """A short form of the guard, and equations for what it names."""
    parts = [a for m in _sorted(guard.atoms(sp.Max)) for a in _sorted(m.args)]
    if not parts and width(notation.plain(guard)) < LINE / 3:
        return [notation.plain(guard)]
    names = {part: sp.Symbol(rf"\gamma_{i}") for i, part in enumerate(parts or [guard], 1)}
    if not parts:
        names = {guard: sp.Symbol(r"\gamma")}
    lines = [f"{notation.plain(name)} = {notation.plain(part)}" for part, name in names.items()]
    return [notation.plain(guard.subs(names)), *lines]


def _sorted(expressions: Iterable[sp.Basic]) -> list[sp.Basic]:
    return sorted(expressions, key=sp.default_sort_key)


def _impulse(model: RockingModel, source: str, target: str) -> list[Block]:
    """Conservation of the momenta of the mechanism that follows, and its solution where short."""
    after = model.mechanism(target)
    if not after.coordinates:
        return [f"In `{target}` all motion has stopped."]
    notation, derived = Notation(after, model), model.impulse_map(source, target)
    arriving = {c.velocity: at_impact(c, BEFORE) for c in model.coordinates}
    new = sp.Matrix([at_impact(c, AFTER) for c in derived.coordinates])
    momentum = derived.momentum.subs(arriving)
    rows = zip(derived.mass_matrix * new, momentum, strict=True)
    lines = [f"{notation.write(a)} = {notation.write(b)}" for a, b in rows]
    if len(model.coordinates) > 1:
        solved = zip(new, derived.velocities().subs(arriving), strict=True)
        closed = [f"{notation.plain(x)} = {notation.quotient(v)}" for x, v in solved]
        lines += [line for line in closed if width(line) < LINE and line not in lines]
    text = "Momentum in the directions that stay free is conserved; $-$ is just before, $+$ just "
    text += "after, and $s$ is the side before:" if after.has_side else "after:"
    return [text, Display(tuple(lines))]


def _pushover(model: RockingModel) -> list[Block]:
    blocks: list[Block] = []
    theta = model.rotation.position
    for phase in model.mechanisms:
        held = any(foot.force != 0 for foot in phase.feet.values()) or not phase.feet
        if model.rotation not in phase.coordinates or phase.load_point is None or not held:
            continue
        notation = Notation(phase, model)
        by_side = sorted(phase.contacts, key=phase.side_of)
        left, right = by_side[0], by_side[-1]
        try:  # that of the left, which takes long to simplify, as a rule is the mirror image
            lacking = holding_force(model, right).subs(theta, -theta) + holding_force(model, left)
        except NotImplementedError:
            continue
        mirrored = tidy(sp.numer(sp.together(lacking))) == 0
        for contact in [right] if mirrored else by_side:
            force = pushover(model, contact)
            blocks.append(f"In `{contact}`:")
            blocks.append(Display((f"P = {notation.quotient(force)}",)))
        if mirrored and left != right:
            blocks.append(f"In `{left}` it is the mirror image.")
    if not blocks:
        return []
    return [
        Heading(2, "Pushover"),
        f"Horizontal force at the load point, positive to the right, that holds the structure at "
        f"${Notation(model.mechanisms[0], model).plain(theta)}$, the other coordinates condensed.",
        *blocks,
    ]
