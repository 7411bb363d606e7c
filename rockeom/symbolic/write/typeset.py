"""Derived equations for people: LaTeX and Markdown, as one would write them in a paper."""

from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from typing import Any, Self

import sympy as sp

from rockeom.numbers.checks import InputError
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.hybrid import HybridModel, Lowers
from rockeom.symbolic.impulse import AFTER, BEFORE, ImpulseMap, at_impact
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Coordinate
from rockeom.symbolic.reactions import reactions, total_reaction
from rockeom.symbolic.statics import holding_force, pushover
from rockeom.symbolic.text.page import (
    LINE,
    Block,
    Display,
    Heading,
    Part,
    environment,
    to_latex,
    to_markdown,
    width,
)
from rockeom.symbolic.write.contact_page import contact_sections, signs_of_search
from rockeom.symbolic.write.notation import Notation
from rockeom.symbolic.write.polar import has_polar_form, in_polar_form, polar_model
from rockeom.symbolic.write.symbols import energies, listed, symbols_of


@dataclass(frozen=True, repr=False, kw_only=True)
class _OfMode:
    """Derived object of a mode, with the records that its notation needs."""

    mode: Mode
    model: HybridModel

    @classmethod
    def of(cls, derived: Any, mode: Mode, model: HybridModel) -> Self:
        parts = {f.name: getattr(derived, f.name) for f in fields(derived)}
        return cls(**parts, mode=mode, model=model)

    @property
    def notation(self) -> Notation:
        return Notation(self.mode, self.model)


@dataclass(frozen=True, repr=False)
class WrittenEquations(_OfMode, Equations):
    """Equations of a mode that are shown as one would write them in a paper."""

    def equation_lines(self) -> list[str]:
        """LaTeX of each equation, in the order of the coordinates."""
        return _lines(self, self.mode.coordinates, self.notation)


@dataclass(frozen=True, repr=False)
class WrittenImpulseMap(_OfMode, ImpulseMap):
    """Impulse map into a mode that is shown as one would write it in a paper."""

    def equation_lines(self) -> list[str]:
        """LaTeX of each row; - is just before, + just after the change."""
        return _momentum_lines(self, self.notation, self.model)


def equation_lines(mode: Mode, form: str = "width") -> list[str]:
    """One line of LaTeX an equation of motion, in the order of the mode's coordinates.

    Left: accelerations, velocities, damping, gravity, stiffness; right: excitation, horizontal
    then vertical, and declared forces. `form` is "width" (B, H) or "polar" (R, alpha).
    Raises ValueError if `form` is neither or the mode has no polar form.
    """
    _check(form)
    equations = in_polar_form(mode) if form == "polar" else mode.equations
    return _lines(equations, mode.coordinates, Notation(mode))


def equations_latex(mode: Mode, form: str = "width") -> str:
    """The equations of motion as an `aligned` block, a line each; "" if no coordinate is free."""
    lines = [line.replace(" = ", " &= ") for line in equation_lines(mode, form)]
    return environment("aligned", lines) if lines else ""


def latex_document(model: HybridModel, form: str = "width") -> str:
    """A LaTeX article on the whole structure, in width form where it has no polar one.

    Raises ValueError if `form` is neither "width" nor "polar".
    """
    return to_latex(content(model, form))


def markdown_page(model: HybridModel) -> str:
    """The same in Markdown, with mathematics between dollar signs."""
    return to_markdown(content(model, "width"), numbered=True)


def notebook_display(model: HybridModel) -> str:
    """The equations of motion of the model's first mode, as a notebook shows the model."""
    return f"$${equations_latex(model.modes[0])}$$"


def _check(form: str) -> None:
    if form not in ("width", "polar"):
        raise InputError("form", form).give('"width" (B, H) or "polar" (R, alpha)')


def _equations(
    equations: Equations, coordinates: tuple[Coordinate, ...], notation: Notation
) -> list[list[Part]]:
    """Each equation in its physical parts."""
    found = []
    for i in range(len(coordinates)):
        row = {c.acceleration: equations.mass_matrix[i, j] for j, c in enumerate(coordinates)}
        statics = {
            "gravity": equations.gravity_forces[i],
            "elastic forces": equations.elastic_forces[i],
        }
        # one sum where weight and spring cancel in part, as about a settled position
        apart = [term for part in statics.values() for term in notation.terms(part)]
        if len(notation.terms(sum(statics.values()))) < len(apart):
            statics = {"gravity and elastic forces": sum(statics.values())}
        resisting = {
            "velocity terms": equations.velocity_forces[i],
            "damping": equations.damping_forces[i],
            **statics,
        }
        acting = {
            "excitation": equations.excitation_forces[i],
            "applied forces": equations.applied_forces[i],
        }
        found.append(notation.equation(row, resisting, acting))
    return found


def _lines(
    equations: Equations, coordinates: tuple[Coordinate, ...], notation: Notation
) -> list[str]:
    return list(Display.of_parts(_equations(equations, coordinates, notation)).lines)


# --- the content of a document


def content(declaration: Lowers, form: str) -> list[Block]:
    """Everything derived of a structure, as blocks of a page."""
    _check(form)
    model = declaration.hybrid
    polar = form == "polar" and any(has_polar_form(mode) for mode in model.modes)
    signs = signs_of_modes(model) if model.search is None else signs_of_search(model.search)
    blocks: list[Block] = [Heading(1, model.title)]
    blocks += [f"Reference: {model.reference}."] if model.reference else []
    blocks += [_OF_SOURCES] if model.sources else []
    blocks += symbols_of(model, polar, signs)
    if model.search is not None:
        return [*blocks, *contact_sections(model, model.search)]
    shown = polar_model(model) if polar else model
    for mode, original in zip(shown.modes, model.modes, strict=True):
        # where no body is placed by R and alpha, the geometry left is that of B and H
        blocks += _mode(model, mode if has_polar_form(mode) else original)
    return [*blocks, *_transitions(shown), *_pushover(shown)]


_OF_SOURCES = """\
The number of an equation is followed by the source's number where the source has it: in its right
form where it is misprinted, and without what the source leaves out, such as the ground's vertical
acceleration.""".replace("\n", " ")


def signs_of_modes(model: HybridModel) -> list[tuple[sp.Symbol, str]]:
    """The states of elements that equations contain, with meanings."""
    return [(s.symbol, f"1 {s.meaning}, else 0") for s in model.modes[0].switches]


def _sides(mode: Mode) -> str:
    return ", ".join(f"$s = {side:+d}$ in `{name}`" for name, side in mode.sides.items())


def _served(mode: Mode) -> str:
    """The modes that one form serves, in words."""
    if not mode.switches:
        return f"both sides: {_sides(mode)}"
    symbols = " and ".join(f"${sp.latex(switch.symbol)}$" for switch in mode.switches)
    sides = ", and for both sides, by $s$" if mode.has_side else ""
    return f"all states, by {symbols}{sides}: {listed(mode.sides)}"


def _mode(model: HybridModel, mode: Mode) -> list[Block]:
    notation, equations = Notation(mode, model), mode.equations
    of_sides = {side: name for name, side in reversed(mode.sides.items())}  # the first of each
    named = sorted(of_sides.values()) if mode.switches else mode.sides
    first = mode.sides == model.modes[0].sides
    blocks: list[Block] = [Heading(2, f"Contact {listed(named)}")]
    blocks += [f"One form for {_served(mode)}."] if mode.has_side or mode.switches else []
    if mode.small:
        small = ", ".join(f"${notation.plain(x)}$" for x in mode.small)
        blocks.append(f"Energies are expanded to second order in the small quantities {small}.")
    blocks.append(Heading(3, "Equations of motion"))
    if mode.coordinates:
        motion = Display.of_parts(_equations(equations, mode.coordinates, notation))
        of = [c.name for c in mode.coordinates] if first else []
        blocks.append(replace(motion, sources=_sources(model, motion.lines, *of)))
    else:
        blocks.append("No coordinate is free: the structure stands still on the ground.")
    return [
        *blocks,
        Heading(3, "Energies"),
        "Kinetic energy $T$, potential energies of gravity $V_g$ and of springs $V_e$, half the "
        "power lost to damping $D$; what is not shown is zero.",
        *energies(mode, notation),
        Heading(3, "Support reactions"),
        *_reactions(model, mode, notation),
    ]


def _sources(model: HybridModel, lines: Iterable[str], *of: str) -> dict[str, str]:
    """The lines that have sources, by what each is of."""
    named = zip(lines, of, strict=False)
    return {line: model.sources[name] for line, name in named if name in model.sources}


def _reactions(model: HybridModel, mode: Mode, notation: Notation) -> list[Block]:
    forces = reactions(model, mode)
    lines = [f"F = {notation.write(forces['horizontal_reaction'])}"]
    text = "Force of the ground on the structure, horizontal $F$"
    if mode.has_side and mode.feet:
        lines.append(f"N = {notation.write(total_reaction(mode)[1])}")
        text += ", vertical $N$ at the foot on the ground: the right one for $s = +1$, "
        text += "the left one for $s = -1$."
    elif mode.feet:
        for foot in ("left", "right"):
            given = mode.feet[foot].force is not None
            force = (notation.plain if given else notation.write)(forces[f"{foot}_reaction"])
            lines.append(rf"N_{{\mathrm{{{foot}}}}} = {force}")
        text += " (sum over both feet), vertical $N$ at each foot."
    of = ("horizontal_reaction", "vertical_reaction") if mode.feet and mode.has_side else ()
    sources = _sources(model, lines, *of)
    return [text if text.endswith(".") else text + ".", Display(tuple(lines), sources=sources)]


# --- transitions and statics


def _transitions(model: HybridModel) -> list[Block]:
    order = {name: i for i, mode in enumerate(model.modes) for name in mode.sides}
    groups: dict[tuple, list[Transition]] = {}
    for t in model.transitions:
        alike = t.guard if model.switches else None  # of many modes in one
        key = (t.kind, order[t.source], order[t.target], order.get(t.fallback or "", -1), alike)
        groups.setdefault(key, []).append(t)
    blocks: list[Block] = [Heading(2, "Transitions")]
    for group in groups.values():
        guard = _common_guard(model, group)
        for alike in [group] if guard is not None else [[t] for t in group]:
            blocks += _transition(model, alike, alike[0].guard if guard is None else guard)
    ratio = model.velocity_ratio
    if ratio not in (None, sp.nan):
        dot = Notation(model.modes[0], model).plain(model.rotation.velocity)
        e = Notation(model.modes[0], model).quotient(ratio)
        lines = (rf"e = \frac{{{dot}^+}}{{{dot}^-}} = {e}", r"r = \frac{T^+}{T^-} = e^2")
        blocks += [
            Heading(3, "Restitution of the rigid structure"),
            "Ratios of velocities $e$ and of kinetic energies $r$ after and before an impact, all "
            "other coordinates held at zero:",
            Display(lines, sources=_sources(model, lines[1:], "energy_ratio")),
        ]
    return blocks


def _common_guard(model: HybridModel, group: list[Transition]) -> sp.Expr | None:
    """The guard written once with s for the transitions of both sides; 0 if they have none."""
    guards = {t.guard for t in group}
    if len(guards) == 1:
        (guard,) = guards
        return sp.Integer(0) if guard is None else guard
    q = model.rotation
    for t in group:
        if model.mode(t.source).side_of(t.source) == 1 and t.guard is not None:
            flip = {q.position: SIDE * q.position, q.velocity: SIDE * q.velocity}
            common = t.guard.subs(flip, simultaneous=True)
            sides = [model.mode(other.source).side_of(other.source) for other in group]
            if all(common.subs(SIDE, s) == o.guard for s, o in zip(sides, group, strict=True)):
                return common
    return None


def _transition(model: HybridModel, alike: list[Transition], guard: sp.Expr | None) -> list[Block]:
    first = alike[0]
    notation = Notation(model.mode(first.source), model)
    pairs = [f"`{t.source}` to `{t.target}`" for t in alike]
    shown = 2 if model.switches else len(pairs)  # of many modes in one
    blocks: list[Block] = [Heading(3, f"{first.kind.capitalize()}: {', '.join(pairs[:shown])}")]
    blocks += [f"Likewise {', '.join(pairs[shown:])}."] if pairs[shown:] else []
    theta, rate, acceleration = (
        notation.plain(x)
        for x in (model.rotation.position, model.rotation.velocity, model.rotation.acceleration)
    )
    if first.kind == "uplift":
        blocks.append(
            f"The foot opposite to the new pivot lifts when $s {acceleration} > 0$, with "
            f"${acceleration}$ from the equations of the mode that would follow at "
            f"${theta} = 0$, ${rate} = 0$, and {_sides(model.mode(first.target))}. "
            "That is when its vertical reaction falls to zero."
        )
        return blocks
    ends = "The gap closes" if first.kind == "impact" else "The mode changes"
    short, *lines = _guard_lines(notation, sp.sympify(guard))
    stays = "" if first.kind == "impact" else "; velocities stay as they are"
    blocks.append(f"{ends} when ${short}$ falls through zero{stays}{':' if lines else '.'}")
    blocks += [Display(tuple(lines))] if lines else []
    setting: dict[tuple[str, ...], list[str]] = {}
    for t, pair in zip(alike, pairs, strict=True) if first.sets else ():
        put = tuple(f"{notation.plain(x)} = {notation.plain(e)}" for x, e in t.sets.items())
        setting.setdefault(put, []).append(pair)
    for put, ways in setting.items():
        whence = "This" if len(ways) > 1 else f"From {ways[0]} this"
        blocks += [f"{whence} is put to a new value:", Display(put)]
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


def _impulse(model: HybridModel, source: str, target: str) -> list[Block]:
    """Conservation of the momenta of the mode that follows, and its solution where short."""
    after = model.mode(target)
    if not after.coordinates:
        return [f"In `{target}` all motion has stopped."]
    notation, derived = Notation(after, model), model.sided_impulse_map(source, target)
    new, arriving = _rates_at_impact(derived, model)
    lines = _momentum_lines(derived, notation, model)
    if len(model.coordinates) > 1:
        solved = zip(new, derived.velocities().subs(arriving), strict=True)
        closed = [f"{notation.plain(x)} = {notation.quotient(v)}" for x, v in solved]
        lines += [line for line in closed if width(line) < LINE and line not in lines]
    text = "Momentum in the directions that stay free is conserved; $-$ is just before, $+$ just "
    text += "after, and $s$ is the side before:" if after.has_side else "after:"
    return [text, Display(tuple(lines), sources=_sources(model, lines, "impact"))]


def _rates_at_impact(
    derived: ImpulseMap, model: HybridModel
) -> tuple[sp.Matrix, dict[sp.Symbol, sp.Symbol]]:
    """Velocities just after an impact, and those just before it by their plain symbols."""
    arriving = {c.velocity: at_impact(c, BEFORE) for c in model.coordinates}
    return sp.Matrix([at_impact(c, AFTER) for c in derived.coordinates]), arriving


def _momentum_lines(derived: ImpulseMap, notation: Notation, model: HybridModel) -> list[str]:
    """Conservation of the momenta of the mode that follows."""
    if not derived.coordinates:
        return []
    new, arriving = _rates_at_impact(derived, model)
    rows = zip(derived.mass_matrix * new, derived.momentum.subs(arriving), strict=True)
    return [f"{notation.write(a)} = {notation.write(b)}" for a, b in rows]


def _pushover(model: HybridModel) -> list[Block]:
    blocks: list[Block] = []
    theta = model.rotation.position
    for mode in model.modes:
        held = any(foot.force != 0 for foot in mode.feet.values()) or not mode.feet
        if model.rotation not in mode.coordinates or mode.load_point is None or not held:
            continue
        notation = Notation(mode, model)
        by_side = sorted(mode.sides, key=mode.side_of)
        left, right = by_side[0], by_side[-1]
        try:  # that of the left, which takes long to simplify, as a rule is the mirror image
            lacking = holding_force(model, right).subs(theta, -theta) + holding_force(model, left)
        except NotImplementedError:
            continue
        mirrored = tidy(sp.numer(sp.together(lacking))) == 0
        for name in [right] if mirrored else by_side:
            force = pushover(model, name)
            blocks.append(f"In `{name}`:")
            blocks.append(Display((f"P = {notation.quotient(force)}",)))
        if mirrored and left != right:
            blocks.append(f"In `{left}` it is the mirror image.")
    if not blocks:
        return []
    return [
        Heading(2, "Pushover"),
        f"Horizontal force at the load point, positive to the right, that holds the structure at "
        f"${Notation(model.modes[0], model).plain(theta)}$, the other coordinates condensed.",
        *blocks,
    ]
