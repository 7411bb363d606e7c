"""Declared modes and transitions: motion, guards, impact maps, and where transitions lead."""

import sympy as sp

from rockeom.codegen.names import string
from rockeom.codegen.outputs import Columns, reactions
from rockeom.codegen.rates import equations_of_motion
from rockeom.codegen.solve import by_states, eliminate, solve
from rockeom.codegen.tables import rows
from rockeom.codegen.text import Text
from rockeom.codes import KIND_OF, SWITCH
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.impulse import ImpulseMap
from rockeom.symbolic.mode import Transition

ImpulseNames = dict[tuple[str, str], str]
"""Name of the function of an impact map, by the modes before and after."""


def declared(text: Text) -> tuple[dict[str, Columns], list[str]]:
    """Add all functions; returns the table of names of forces, and the tables of guards."""
    equations_of_motion(text)
    _guards(text)
    _jump(text)
    held = _held_guards(text)
    return {"REACTIONS": reactions(text)}, _tables(text, held)


# -- tables ------------------------------------------------------------------------------------


def _tables(text: Text, held: int) -> list[str]:
    model = text.model
    sides = [model.mode(name).side_of(name) for name in model.mode_names]
    return [
        f"N_GUARDS = {_longest(model)}",
        f"N_PARTS = {max(sum(map(len, _parts(model, name))) for name in model.mode_names)}",
        f"SIDES = ({', '.join(str(float(s)) for s in sides)},)",
        f"GUARDS = ({', '.join(str(len(_outgoing(model, x))) for x in model.mode_names)},)",
        *_of_transitions(model),
        *_of_guards(model),
        *_of_switches(model),
        f"LOCALISED = {bool(model.functions)}  # whether forces may act in a small part of a step",
        f"FULL_CONTACT = {held}  # mode whose guards are sums of the state and the ground, or -1",
        f"HAS_IMPULSIVE = {_impulsive(model)}",
    ]


def _of_switches(model: HybridModel) -> list[str]:
    if not model.switches:
        return []
    meanings = ", ".join(switch.meaning for switch in model.modes[0].switches)
    states = {m: list(map(float, model.mode(m).states_of(m))) for m in model.mode_names}
    return rows(f"ELEMENT_STATES = (  # of each mode, 1 {meanings}", states)


def _of_transitions(model: HybridModel) -> list[str]:
    return [
        "TRANSITIONS = (",
        *(
            f"    ({string(t.source)}, {string(t.target)}, {string(t.kind)}),"
            for name in model.mode_names
            for t in _outgoing(model, name)
        ),
        ")",
    ]


def _of_guards(model: HybridModel) -> list[str]:
    """Tables with a row for each mode, and in it a number for each guard."""
    leaving = {m: _outgoing(model, m) for m in model.mode_names}
    legend = ", ".join(f"{number} {kind}" for kind, number in KIND_OF.items())
    return [
        *rows(
            f"KINDS = (  # of each guard of each mode; {legend}",
            {m: [KIND_OF[t.kind] for t in row] for m, row in leaving.items()},
            SWITCH,
        ),
        *rows(
            "TARGETS = (  # mode to which each guard leads",
            {m: [model.mode_names.index(t.target) for t in row] for m, row in leaving.items()},
        ),
        *rows(
            "REVERSE = (  # guard of the mode that follows which is closed on entering it",
            {m: _reverse(model, m) for m in leaving},
        ),
        *rows(
            "PARTS = (  # place in g of the two parts of a guard, or -1",
            {m: [min(two, default=-1) for two in _parts(model, m)] for m in leaving},
        ),
    ]


def _reverse(model: HybridModel, mode: str) -> list[int]:
    """For each guard of a mode: the one of its target that leads back, or -1.

    It is zero on entering, up to rounding, and must not count as another event.
    """
    back = []
    for t in _outgoing(model, mode):
        returning = [
            i
            for i, other in enumerate(_outgoing(model, t.target))
            if t.reversible and mode in (other.target, other.fallback)
        ]
        back.append(returning[0] if returning else -1)
    return back


# -- guards ------------------------------------------------------------------------------------


def _guards(text: Text) -> None:
    model = text.model
    body: list[str] = []
    done: set[str] = set()
    for mode in model.mode_names:
        transitions = _outgoing(model, mode)
        if not transitions or mode in done:
            continue
        image = _image(model, mode)
        done |= {mode, image or mode}
        served = [f"mode == {text.mode_constants[m]}" for m in (mode, image) if m]
        body.append(f"    {'elif' if body else 'if'} {' or '.join(served)}:")
        if image:
            body += text.side(" " * 8, model.mode(mode))
            expressions = _on_both_sides(model, mode)
        else:
            expressions = _by_place(model, mode)
        targets = {f"g[{i}]": e for i, e in expressions.items()}
        body += text.evaluate("guards", targets, " " * 8, hoist=True)
        body += [
            f"        g[{i}] = -opening_acceleration("
            f"{text.mode_constants[t.target]}, y, p, {text.shaking})"
            for i, t in enumerate(transitions)
            if t.kind == "uplift"
        ]
    text.function(
        f"guards(mode, y, p, {text.shaking}, g)",
        """Guards of a mode into g: all positive inside it; the first to fall ends it.

    g (N_GUARDS + N_PARTS,) : behind the guards stand the two parts of those that are the larger
        of two, where PARTS says.""",
        body or ["    pass"],
    )


def _outgoing(model: HybridModel, mode: str) -> list[Transition]:
    """The transitions out of a mode, an impact first."""
    leaving = [t for t in model.transitions if t.source == mode]
    return sorted(leaving, key=lambda t: t.kind != "impact")


def _longest(model: HybridModel) -> int:
    """The largest number of guards of a mode."""
    return max(len(_outgoing(model, m)) for m in model.mode_names)


def _parts(model: HybridModel, mode: str) -> list[dict[int, sp.Expr]]:
    """For each guard of a mode: its two parts by their place in g, if it has any."""
    places: list[dict[int, sp.Expr]] = []
    place = _longest(model)
    for t in _outgoing(model, mode):
        if isinstance(t.guard, sp.Max):
            two = (model.in_mode(e, mode) for e in t.guard.args)
            places.append(dict(zip((place, place + 1), two, strict=True)))
            place += 2
        else:
            places.append({})
    return places


def _by_place(model: HybridModel, mode: str) -> dict[int, sp.Expr]:
    """Guards of a mode and their parts, by their place in g."""
    by_place = {
        i: model.in_mode(t.guard, mode)
        for i, t in enumerate(_outgoing(model, mode))
        if t.guard is not None
    }
    for two in _parts(model, mode):
        by_place |= two
    return by_place


def _on_both_sides(model: HybridModel, mode: str) -> dict[int, sp.Expr]:
    """Guards of a mode and of its image, with s, by their place in g."""
    closing = SIDE * model.rotation.position
    return {
        i: closing if t.kind == "impact" else t.guard for i, t in enumerate(_outgoing(model, mode))
    }


def _image(model: HybridModel, mode: str) -> str | None:
    """The mode on the other side, where its guards are the same but for functions of s.

    They are then written once, with s: a mirrored motion has mirrored guards to the last bit.
    """
    of = model.mode(mode)
    side, states = of.side_of(mode), of.states_of(mode)
    mine = _outgoing(model, mode)
    switches = [model.written_out(t.guard) for t in mine if t.kind == "switch"]
    if not side or not any(e.has(SIDE) for e in switches):
        return None
    images = (
        name
        for name in of.sides
        if of.side_of(name) == -side
        and of.states_of(name) == states
        and _mirrors(mine, _outgoing(model, name))
    )
    return next(images, None)


def _mirrors(mine: list[Transition], others: list[Transition]) -> bool:
    """Whether transitions have the same guards, written with s."""
    return len(mine) == len(others) and all(
        t.kind == o.kind and (t.kind == "impact" or (t.kind == "switch" and t.guard == o.guard))
        for t, o in zip(mine, others, strict=True)
    )


# -- guards in full contact ----------------------------------------------------------------------


def _held_guards(text: Text) -> int:
    """Add `full_contact_guards`; returns the mode that it is for, -1 if there is none.

    An acceleration out of M a = f lifts a foot. But for the factor that M gives, which is positive,
    it is often a sum of the states and of the ground's acceleration, each by a constant: in a step,
    in which these are polynomials, so is that sum, and its coefficients are known at once.
    """
    sums_of = {m: sums for m in text.model.mode_names if (sums := _sums(text, m))}
    mode = next(iter(sums_of)) if len(sums_of) == 1 else None
    sums = sums_of[mode] if mode else []
    text.function(
        "full_contact_guards(y, p, ax, g)",
        """Guards of the mode FULL_CONTACT into g, each divided by what is positive.

    Sums of the states and ax, while there is no vertical shaking.""",
        text.evaluate("guards", {f"g[{i}]": e for i, e in enumerate(sums)}, "    ", hoist=True)
        or ["    pass"],
        "@inlined",
    )
    return text.model.mode_names.index(mode) if mode else -1


def _sums(text: Text, mode: str) -> list[sp.Expr]:
    """The guards of a mode as such sums; none where one of them is no such sum.

    A structure of one coordinate does not move on both feet.
    """
    leaving = _outgoing(text.model, mode)
    if (
        text.n < 2
        or len(text.model.shaking) > 2
        or any(t.kind != "uplift" or t.guard is not None for t in leaving)
    ):
        return []
    terms = [_sum(text, t.target) for t in leaving]
    return [e for e in terms if e is not None] if None not in terms else []


def _sum(text: Text, rocking: str) -> sp.Expr | None:
    """Force that keeps the gap of a rocking mode closed, as such a sum, if it is one."""
    model = text.model
    mode = model.mode(rocking)
    rotation = mode.coordinates.index(model.rotation)
    eq = mode.equations
    M, F = eq.mass_matrix.copy(), eq.forcing.copy()
    left, _ = eliminate(text, M, F)
    if not left:  # all of M is constant
        F = eq.mass_matrix.adjugate() * eq.forcing
    elif left != [rotation]:
        return None
    closed = {model.rotation.position: 0, model.rotation.velocity: 0, model.shaking[-1]: 0}
    side = mode.side_of(rocking)
    opens = sp.expand(model.in_mode(F[rotation], rocking).subs(closed))
    return by_states(text, -side * opens)


# -- transitions -------------------------------------------------------------------------------


def _impulsive(model: HybridModel) -> bool:
    """Whether the impulsive form of Lagrange's equations gives the rates after an impact."""
    return model.has_impacts and model.rigid_velocity_ratio is None


def _jump(text: Text) -> None:
    """The functions of the impact maps, and one that passes through a transition."""
    impulses = _impulses(text)
    body = ["    for i in range(N_STATES):", "        out[i] = y[i]"]
    setting: dict[str, list[Transition]] = {}
    for mode in text.model.mode_names:
        for i, t in enumerate(_outgoing(text.model, mode)):
            if t.sets:
                setting.setdefault(f"{i} {t.sets}", []).append(t)
                continue
            body.append(f"    if mode == {text.mode_constants[mode]} and guard == {i}:")
            if t.kind == "impact":
                body += _impact(text, t, impulses, " " * 8)
            else:
                body.append(f"        return {text.mode_constants[t.target]}")
    for key, alike in setting.items():
        body += _setting(text, alike, key.partition(" ")[0])
    body.append("    return mode")
    text.function(
        "jump(mode, guard, law, ratio, y, p, out)",
        """Pass through the transition whose guard fell: state after into out (N,).

    law : RATIO multiplies the rate of rotation by `ratio` and leaves the other rates; IMPULSIVE
        applies the impulsive form of Lagrange's equations.
    Returns the mode that follows.""",
        body,
    )


def _setting(text: Text, alike: list[Transition], guard: str) -> list[str]:
    """Lines of transitions without an impact that set states alike."""
    sources = ", ".join(text.mode_constants[t.source] for t in alike)
    sets = {f"out[{text.index(x)}]": text.model.written_out(e) for x, e in alike[0].sets.items()}
    lines = text.evaluate("jump", sets, " " * 8)
    return [
        f"    if mode in ({sources},) and guard == {guard}:",
        *text.signs(lines, [text.model.mode(alike[0].source)]),
        *lines,
        "        return TARGETS[mode][guard]",
    ]


def _impact(text: Text, t: Transition, impulses: ImpulseNames, indent: str) -> list[str]:
    """Lines of an impact: the target follows if its gap opens, otherwise the fallback."""
    rotation = text.model.rotation
    theta, theta_dot = text.index(rotation.position), text.index(rotation.velocity)
    arriving = text.model.mode(t.source).side_of(t.source)
    side = text.model.mode(t.target).side_of(t.target)
    opens = f"{'' if side == 1 else '-'}out[{theta_dot}] > 0.0 and y[{theta_dot}] != 0.0"

    def by_impulses(target: str) -> list[str]:
        return [
            f"{indent}if law == IMPULSIVE:",
            f"{indent}    {impulses[t.source, target]}({arriving}.0, y, p, out)",
        ]

    by_ratio = f"out[{theta_dot}] = ratio * y[{theta_dot}]"
    lines = [f"{indent}out[{theta}] = 0.0"]
    if impulses:
        lines += [*by_impulses(t.target), f"{indent}else:", f"{indent}    {by_ratio}"]
    else:
        lines.append(f"{indent}{by_ratio}")
    lines += [f"{indent}if {opens}:", f"{indent}    return {text.mode_constants[t.target]}"]
    # the old foot does not lift
    if impulses and t.fallback:
        lines += by_impulses(t.fallback)
    lines.append(f"{indent}out[{theta_dot}] = 0.0")
    return [*lines, f"{indent}return {text.mode_constants[t.fallback or t.target]}"]


def _impulses(text: Text) -> ImpulseNames:
    """Add a function for each impact map; those that differ in the side alone share one."""
    names: ImpulseNames = {}
    if not _impulsive(text.model):
        return names
    maps: dict[str, ImpulseMap] = {}
    for t in text.model.transitions:
        if t.kind == "impact":
            for target in filter(None, (t.target, t.fallback)):
                if (t.source, target) not in names:
                    names[t.source, target] = _impulse(text, t, target, maps)
    return names


def _impulse(text: Text, t: Transition, target: str, maps: dict[str, ImpulseMap]) -> str:
    """Name of the function of the map from the source of `t` to `target`: one of `maps`, or new."""
    impact = text.model.sided_impulse_map(t.source, target)
    side = text.model.mode(t.source).side_of(t.source)
    for name, other in maps.items():
        if other.at_side(side).equals(impact.at_side(side)):
            return name
    word = "opposite" if target == t.target else target
    follows = "the opposite mode" if target == t.target else f"mode {target}"
    name = text.function_name(f"impulse_to_{word}", f"impulse_{len(maps)}")
    maps[name] = impact
    after = [f"{text.name(c.velocity)}_after" for c in impact.coordinates]
    body = ["    pass"]
    if after:
        body = solve(text, "impulse", impact.mass_matrix, impact.momentum, after, "    ")
    places = [text.index(c.velocity) for c in impact.coordinates]
    body += [f"    out[{i}] = {a}" for i, a in zip(places, after, strict=True)]
    text.function(
        f"{name}(s, y, p, out)",
        f"Rates after side s closes and {follows} follows: M+ q'+ = sum J+^T m v-.",
        body,
    )
    return name
