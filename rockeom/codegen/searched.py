"""The functions of a structure whose contacts were declared: motion, forces, guards, outputs.

Each mode has one text, written with the side s, the sign sigma of each slip and the state chi
of each element as numbers. Tables give the one of each mode.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import prod
from typing import NamedTuple

import sympy as sp

from rockeom.codegen.outputs import Columns
from rockeom.codegen.points import functions_of_points, impact_law
from rockeom.codegen.solve import TOTAL_GRAVITY, eliminated, unsymmetric
from rockeom.codegen.tables import column, rows, table
from rockeom.codegen.text import Text, branched
from rockeom.codes import (
    BOUND,
    FRICTIONLESS,
    LANDING,
    LIFTING,
    MOST_DIGITS,
    OPEN,
    SLIPPING,
    STICK,
    STICKING,
    SWITCH,
)
from rockeom.symbolic.algebra import SIDE, brief, tidy
from rockeom.symbolic.beds import number_of_combinations
from rockeom.symbolic.contacts import Contact, ContactDeclaration
from rockeom.symbolic.elements import Ending, Tie
from rockeom.symbolic.hybrid import Search
from rockeom.symbolic.model import Body, InternalVariable
from rockeom.symbolic.modes.balance import force_of
from rockeom.symbolic.modes.derived import VERBS, DerivedMode
from rockeom.symbolic.modes.every import Modes, Pattern
from rockeom.symbolic.modes.kinematics import SLIP, sign_of_slip
from rockeom.symbolic.reactions import total_reaction

MOST_QUICK = 2
"""Number of modes with functions of their own, each of which makes the program longer."""


class Written:
    """Names of signs and switches, and of the functions of each mode as they are written."""

    def __init__(self, text: Text, search: Search) -> None:
        self.text, self.of, self.modes = text, search.of, search.modes
        self.rates: list[str] = []
        self.forces: dict[int, str] = {}
        self.slips = max(len(m.slipping) for m in self.modes.derived)
        for i in range(self.slips):
            text.names[sign_of_slip(i)] = sp.Symbol(f"sigma_{i}")

    def call(self, function: str, mode: DerivedMode) -> str:
        """The call of a function of a mode."""
        side = ["s"] if mode.sided else []
        sigmas = [f"sigma_{i}" for i in range(len(mode.slipping))]
        arguments = [*side, *sigmas, *self.text.switches, *self.text.states, "p", self.text.shaking]
        return f"{function}({', '.join(arguments)})"

    def read(self, mode: DerivedMode, indent: str) -> list[str]:
        """Lines that read the signs of a mode from the tables."""
        lines = [f"{indent}s = IMAGES[mode]"] if mode.sided else []
        lines += [f"{indent}sigma_{i} = SIGMAS[mode][{i}]" for i in range(len(mode.slipping))]
        return lines + self.text.read_switches(indent)

    def found_forces(self, pattern: Pattern, indent: str) -> list[str]:
        """Lines that find the forces of a pattern's points, by their own numbers.

        The friction is that of a group, and has the number of the first of its points.
        """
        mode = self.modes.derived[pattern.mode]
        if not mode.closed:
            return self.text.read_switches(indent)
        lines = self.read(mode, indent)
        lines += [f"{indent}{x} = y[{i}]" for i, x in enumerate(self.text.states)]
        names = [f"normal_{pattern.points[i]}" for i in mode.closed]
        names += [f"friction_{first_of(pattern, g)}" for g in groups_of(mode)]
        left = ", ".join(names) + ("," if len(names) == 1 else "")
        return [*lines, f"{indent}{left} = {self.forces[pattern.mode]}"]


def groups_of(mode: DerivedMode) -> list[tuple[int, ...]]:
    """Points that share friction, in the order in which a mode tells of them."""
    return [*mode.slipping, *mode.sticking]


def first_of(pattern: Pattern, group: tuple[int, ...]) -> int:
    """The first of the points that play the parts of a mode's group."""
    return min(pattern.points[i] for i in group)


def searched(text: Text, search: Search) -> tuple[dict[str, Columns], list[str]]:
    """Add all functions; returns the table of names of forces, and the tables of guards."""
    written = Written(text, search)
    _motions(written)
    _forces(written)
    _guards(written)
    if search.of.switching or not search.of.contacts:
        _jump(written)
    functions_of_points(text, search.of)
    return {"REACTIONS": _reactions(written)}, _tables(written)


def _chosen(name: str, table: str, branches: list[list[str]]) -> list[str]:
    """Lines of the branch that a table gives for a mode; of one branch alone, its own."""
    tested = [(f"{name} == {i}", branch) for i, branch in enumerate(branches)]
    read = [f"    {name} = {table}[mode]"] if len(branches) > 1 else []
    return [*read, *branched(tested, otherwise=True)]


# -- motion -----------------------------------------------------------------------------------


def _suffix(mode: DerivedMode) -> str:
    """End of the names of the functions of a mode."""
    points = zip(mode.model.contacts, mode.states, strict=True)
    words = [f"{c.name}_{VERBS[state]}" for c, state in points if state]
    return "_".join(words) or mode.model.open_mode


def _words(mode: DerivedMode) -> str:
    """A mode in words."""
    points = zip(mode.model.contacts, mode.states, strict=True)
    words = [f"{c.name} {VERBS[state]}" for c, state in points if state]
    mirrored = ", or its mirror image" if mode.sided else ""
    return (", ".join(words) or "no point is closed") + mirrored


def _motions(written: Written) -> None:
    """Rates of all states: of each mode, of the one that moves, and on arrays."""
    text, derived = written.text, written.modes.derived
    branches = []
    for i, mode in enumerate(derived):
        written.rates.append(_motion_of(written, i, mode))
        branches.append([*written.read(mode, " " * 8), f"        return {written.rates[-1]}"])
    n, states = text.n, ", ".join(text.states)
    text.function(
        f"rates_of_states(mode, {states}, p, {text.shaking})",
        "Rates of all states, in their order.",
        _chosen("equations", "EQUATIONS", branches),
        "@inlined",
    )
    items = ", ".join(f"found[{n + i}]" for i in range(n))
    text.function(
        f"accelerations(mode, {states}, p, {text.shaking})",
        f"Accelerations of the coordinates under ground accelerations {text.shaking} [m/s2].",
        [
            f"    found = rates_of_states(mode, {states}, p, {text.shaking})",
            f"    return ({items},)",
        ],
        "@inlined",
    )
    for i, _ in quick(written.modes):
        text.function(
            f"accelerations_{i}(mode, {states}, p, {text.shaking})",
            f"The same where {_words(derived[i])}.",
            [
                *written.read(derived[i], "    "),
                f"    found = {written.rates[i]}",
                f"    return ({items},)",
            ],
            "@everywhere",
        )
    of_states = ", ".join(f"y[{i}]" for i in range(2 * n))
    text.function(
        f"rates(mode, y, p, {text.shaking}, dy)",
        f"Rates of the states y (N,) under ground accelerations {text.shaking} [m/s2], "
        "into dy (N,).",
        [
            f"    found = rates_of_states(mode, {of_states}, p, {text.shaking})",
            *(f"    dy[{i}] = found[{i}]" for i in range(2 * n)),
        ],
    )
    text.function(
        f"opening_acceleration(mode, y, p, {text.shaking})",
        "Zero: whether a gap opens is found among the candidates.",
        ["    return 0.0"],
        "@inlined",
    )


def quick(modes: Modes) -> list[tuple[int, int]]:
    """The modes of one coordinate, that the others follow, where nothing slips; and which."""
    return [
        (i, m.independent[0])
        for i, m in enumerate(modes.derived)
        if len(m.independent) == 1 and not m.slipping
    ][:MOST_QUICK]


def _motion_of(written: Written, number: int, mode: DerivedMode) -> str:
    """Add the function of one mode; returns how it is called."""
    text = written.text
    name = text.function_name(f"rates_{_suffix(mode)}", f"rates_{number}")
    names = [text.name(a) for a in mode.qdd]
    internal = {text.name(z.rate): mode.here(e) for z, e in written.of.internal.items()}
    rates = list(text.states[text.n :])
    entries: dict[str, sp.Expr] = dict(internal)
    tied: list[str] = []
    for d in mode.dependent:
        speed, drift = mode.velocity[mode.qd[d]], mode.drift[d]
        rates[d] = "0.0" if speed == 0 else f"speed_{d}"
        if speed != 0:
            entries[f"speed_{d}"] = speed
        terms = []
        if drift != 0:
            entries[f"drift_{d}"] = drift
            terms.append(f"drift_{d}")
        for j, i in enumerate(mode.independent):
            if mode.motions[d, j] != 0:
                entries[f"tie_{d}_{i}"] = mode.motions[d, j]
                terms.append(f"tie_{d}_{i} * {names[i]}")
        tied.append(f"    {names[d]} = {' + '.join(terms) or '0.0'}")
    solve = eliminated if mode.balance.symmetric else unsymmetric
    gravity, out = written.of.gravity, [names[i] for i in mode.independent]
    of_motion, solved = solve(
        text, mode.mass_matrix, mode.forcing, out, "    ", gravity
    )  # fmt: skip
    first = {TOTAL_GRAVITY.name: gravity + text.model.shaking[-1]}
    body = text.evaluate("rates", of_motion | entries, "    ", first, hoist=True, states=False)
    call = written.call(name, mode)
    text.function(
        call,
        f"Rates of all states where {_words(mode)}.",
        [*body, *solved, *tied, f"    return ({', '.join([*rates, *names, *internal])},)"],
        "@inlined",
    )
    return call


# -- forces -----------------------------------------------------------------------------------


def _forces(written: Written) -> None:
    """Normal forces of each mode with a closed point, and the friction of each group."""
    text = written.text
    for number, mode in enumerate(written.modes.derived):
        if not mode.closed:
            continue
        name = text.function_name(f"forces_{_suffix(mode)}", f"forces_{number}")
        normal, friction = mode.forces
        targets = {f"normal_{i}": e for i, e in normal.items()}
        targets |= {f"friction_{g[0]}": friction[g[0]] for g in groups_of(mode)}
        used = set().union(*(e.free_symbols for e in targets.values()))
        moving = used & set(mode.qdd)
        lines = [f"    found = {written.rates[number]}"] if moving else []
        lines += [
            f"    {text.name(a)} = found[{text.n + j}]"
            for j, a in enumerate(mode.qdd)
            if a in moving
        ]
        lines += text.evaluate("forces", targets, "    ", hoist=True, states=False)
        written.forces[number] = written.call(name, mode)
        text.function(
            written.forces[number],
            f"Normal forces, then friction [N], where {_words(mode)}.",
            [*lines, f"    return ({', '.join(targets)},)"],
            "@inlined",
        )


@dataclass(frozen=True)
class Guard:
    """A guard of a pattern: of a point, or of an element, whose numbers follow on theirs.

    sign : of the friction that it bounds. place : among the endings of its element.
    """

    kind: int
    subject: int
    sign: int = 0
    place: int = 0

    def of(self, place: int | None) -> Guard | None:
        """The guard of another ending of its element."""
        return None if place is None else replace(self, place=place)


def guards_of(of: ContactDeclaration, pattern: Pattern) -> list[Guard]:
    """The guards of a pattern in the order that they have in g, elements last."""
    guards: list[Guard] = []
    for i, state in enumerate(pattern.states):
        if state == OPEN:
            guards.append(Guard(LANDING, i))
            continue
        guards.append(Guard(LIFTING, i))
        if pattern.shared[i] != i:
            continue
        group = [j for j, first in enumerate(pattern.shared) if first == i]
        if state == SLIP:
            guards.append(Guard(STICKING, i))
        elif state == STICK and all(of.contacts[j].law.friction is not None for j in group):
            guards += [Guard(SLIPPING, i, 1), Guard(SLIPPING, i, -1)]
    first = len(of.contacts) + len(of.switching)
    guards += [Guard(BOUND, first + i) for i in range(len(of.bounds))]
    return [*guards, *_of_elements(of)]


def _of_elements(of: ContactDeclaration) -> list[Guard]:
    points = len(of.contacts)
    return [
        Guard(SWITCH, points + i, place=place)
        for i, endings in enumerate(of.endings)
        for place in range(len(endings[of.switching[i].states[0]]))
    ]


def ending_of(of: ContactDeclaration, guard: Guard, state: int) -> Ending:
    """The ending that ends a state of an element by a guard."""
    return of.endings[guard.subject - len(of.contacts)][state][guard.place]


def pairs_of(of: ContactDeclaration) -> list[tuple[int, int, int]]:
    """(element, state, place) of each guard that is the larger of two."""
    return [
        (i, state, place)
        for i, row in enumerate(of.endings)
        for state, endings in row.items()
        for place, ending in enumerate(endings)
        if len(ending.guard) == 2
    ]


def _guards(written: Written) -> None:
    text, patterns = written.text, written.modes.patterns
    branches = [_guards_of(written, pattern) for pattern in patterns]
    text.function(
        f"guards(mode, y, p, {text.shaking}, g)",
        """Guards of a mode into g: all positive inside it; the first to fall ends it.

    g (N_GUARDS + N_PARTS,) : behind the guards stand the two parts of those that are the larger
        of two, where PARTS says.""",
        _chosen("pattern", "PATTERNS", branches),
        "@inlined",
    )


def _guards_of(written: Written, pattern: Pattern) -> list[str]:
    """The branch of one pattern."""
    text, of, indent = written.text, written.of, " " * 8
    mode = written.modes.derived[pattern.mode]
    part_of = {played: part for part, played in enumerate(pattern.points)}
    lines = written.found_forces(pattern, indent)
    if not mode.closed:
        lines += [f"{indent}{x} = y[{i}]" for i, x in enumerate(text.states)]
    targets: dict[str, sp.Expr] = {}
    for k, guard in enumerate(guards_of(of, pattern)):
        i, place = guard.subject, f"g[{k}]"
        if guard.kind == LANDING:
            targets[place] = mode.gap(part_of[i])
        elif guard.kind == LIFTING:
            targets[place] = sp.Symbol(f"normal_{i}")
        elif guard.kind == STICKING:
            group = next(g for g in mode.slipping if first_of(pattern, g) == i)
            targets[place] = mode.sigma(group[0]) * mode.slip_rate(group)
        elif guard.kind == SLIPPING:
            points = [j for j, f in enumerate(pattern.shared) if f == i and pattern.states[j]]
            cone = sum(mode.friction(j) * sp.Symbol(f"normal_{j}") for j in points)
            targets[place] = cone - guard.sign * sp.Symbol(f"friction_{i}")
        elif guard.kind == BOUND:
            bound = [*of.bounds.values()][i - len(of.contacts) - len(of.switching)]
            targets[place] = _here(bound, pattern, mode)
    switches = _Switches(of)
    targets |= {name: _here(e, pattern, mode) for name, e in switches.values.items()}
    lines += text.evaluate("guards", targets, indent, hoist=True, states=False)
    first = len(guards_of(of, pattern)) - len(_of_elements(of))
    return [*lines, *(f"{indent}{line}" for line in switches.lines(first))]


def _here(expr: sp.Expr, pattern: Pattern, mode: DerivedMode) -> sp.Expr:
    """An expression where the pattern's points are closed.

    The place and the rate of a point that is closed are zero then, not what rounding leaves: a bar
    at a foot that stands would begin and cease to act without end.
    """
    if not mode.closed:
        return expr
    return brief(mode.here(expr).subs(SIDE, pattern.side))


class _Switches:
    """Parts of the guards of elements, each expression once, and their lines.

    values : by name.
    """

    def __init__(self, of: ContactDeclaration) -> None:
        self.of = of
        every = prod(len(e.states) for e in of.switching)
        self.waits = number_of_combinations(of.switching) < every  # others switch before some
        self.values: dict[str, sp.Expr] = {}
        self._names: dict[sp.Expr, str] = {}
        for row in of.endings:
            for endings in row.values():
                for e in (e for ending in endings for e in ending.guard):
                    self._add(sp.sympify(e))

    def _add(self, expr: sp.Expr) -> None:
        if expr not in self._names:
            name = f"part_{len(self.values)}"
            self._names |= {expr: name, -expr: f"-{name}"}
            self.values[name] = expr

    def _written(self, ending: Ending) -> str:
        names = [self._names[sp.sympify(e)] for e in ending.guard]
        return names[0] if len(names) == 1 else f"max({', '.join(names)})"

    def lines(self, first: int) -> list[str]:
        """They begin at g[first]; the parts of those that are the larger of two at g[N_GUARDS]."""
        of = self.of
        lines: list[str] = []
        for i, state, place in pairs_of(of):
            for e in of.endings[i][state][place].guard:
                lines.append(f"g[N_GUARDS + {len(lines)}] = {self._names[sp.sympify(e)]}")
        for k, guard in enumerate(_of_elements(of)):
            i = guard.subject - len(of.contacts)
            states = of.switching[i].states
            values = {s: self._written(ending_of(of, guard, s)) for s in states}
            *others, last = values.items()
            tests = [f"{value} if ELEMENT_STATES[mode][{i}] == {s} else" for s, value in others]
            waits = [f"1.0 if TARGETS[mode][{first + k}] == mode else"] if self.waits else []
            lines.append(f"g[{first + k}] = {' '.join([*waits, *tests, last[1]])}")
        return lines


def _jump(written: Written) -> None:
    """The ending of an element has its target, and no velocity jumps."""
    text, of, lines = written.text, written.of, []
    switches = _of_elements(of)

    def put(values: Mapping[InternalVariable, sp.Expr], i: int, state: int, then: str) -> list[str]:
        places = {f"out[{text.index(z.symbol)}]": e for z, e in values.items()}
        return [
            "    if (",
            f"        SUBJECTS[mode][guard] == {len(of.contacts) + i}",
            f"        and ELEMENT_STATES[mode][{i}] == {state}",
            *([f"        and {then}"] if then else []),
            "    ):",
            *text.evaluate("jump", places, " " * 8),
        ]

    for i, element in enumerate(of.switching):
        for state in element.states:
            if settled := element.settled(state):
                lines += put(settled, i, state, "")
            for place, ending in enumerate(of.endings[i][state]):
                guard = Guard(SWITCH, len(of.contacts) + i, place=place)
                behind = len(switches) - switches.index(guard)
                if ending.sets:
                    lines += put(dict(ending.sets), i, state, f"guard == GUARDS[mode] - {behind}")
    text.function(
        "jump(mode, guard, law, ratio, y, p, out)",
        "The state goes on into out (N,); returns the mode that follows a guard's fall.",
        [
            "    for i in range(N_STATES):",
            "        out[i] = y[i]",
            *lines,
            "    return TARGETS[mode][guard]",
        ],
    )


# -- forces of a state ------------------------------------------------------------------------


def _reactions(written: Written) -> Columns:
    """The ground's horizontal force, then the forces at each point and element."""
    text, of = written.text, written.of
    patterns = written.modes.patterns
    points, elements = of.contacts, of.switching
    totals = total_reaction(of.free)
    totals = totals if len(totals) > 2 else totals[:1]  # in the plane the points have the vertical
    columns = [f"{way}_reaction" for way in ("horizontal", "transverse", "vertical")[: len(totals)]]
    columns += [f"{c.name}_reaction" for c in points]
    columns += [f"{e.name}_{e.outputs[0]}" for e in elements]
    columns += [f"{c.name}_friction" for c in points]
    states = ", ".join(f"y[{i}]" for i in range(2 * text.n))
    body = [f"    found = accelerations(mode, {states}, p, {text.shaking})"]
    body += [
        f"    {text.name(c.acceleration)} = found[{i}]"
        for i, c in enumerate(of.coordinates)
        if any(c.acceleration in total.free_symbols for total in totals)
    ]
    presses = {
        f"out[{len(totals) + len(points) + i}]": force_of(of, i) for i in range(len(elements))
    }
    body += written.text.read_switches("    ")
    body += text.evaluate(
        "reactions", {f"out[{i}]": e for i, e in enumerate(totals)} | presses, "    "
    )
    if points:
        behind = len(totals) + len(points) + len(elements)
        branches = [
            [*written.found_forces(a, " " * 8), *_shares(written, a, behind)] for a in patterns
        ]
        body += _chosen("pattern", "PATTERNS", branches)
    text.function(
        f"reactions(mode, y, p, {text.shaking}, out)",
        """Forces [N] into out, in the order of REACTIONS: of the ground, and at each point.

    Where only the sum of frictions is determined, each has the same part of its largest.""",
        body,
    )
    return tuple(columns)


def _ties(of: ContactDeclaration) -> tuple[str, ...]:
    """The names of the ties."""
    return tuple(e.name for e in of.switching if isinstance(e, Tie))


def _shares(written: Written, pattern: Pattern, behind: int) -> list[str]:
    """Lines that put the forces of a pattern's points to their places."""
    of, indent = written.of, " " * 8
    mode = written.modes.derived[pattern.mode]
    part_of = {played: part for part, played in enumerate(pattern.points)}
    normals = {
        f"out[{1 + i}]": sp.Symbol(f"normal_{i}") if state else sp.S.Zero
        for i, state in enumerate(pattern.states)
    }
    lines = written.text.evaluate("reactions", normals, indent, states=False)
    targets: dict[str, sp.Expr] = {}
    for i, state in enumerate(pattern.states):
        place = f"out[{behind + i}]"
        group = [j for j, f in enumerate(pattern.shared) if f == pattern.shared[i]]
        friction = sp.Symbol(f"friction_{group[0]}")
        part = part_of[i]
        if state in (OPEN, FRICTIONLESS):
            targets[place] = sp.S.Zero
        elif state == SLIP:
            normal = sp.Symbol(f"normal_{i}")
            targets[place] = -mode.sigma(part) * mode.friction(part) * normal
        elif len(group) == 1:
            targets[place] = friction
        else:
            cones = {j: _cone(of, j) * sp.Symbol(f"normal_{j}") for j in group}
            targets[f"total_{group[0]}"] = sum(cones.values())
            share = sp.Symbol(f"share_{group[0]}")
            targets[place] = cones[i] * share
    totals = {k: targets.pop(k) for k in list(targets) if k.startswith("total")}
    lines += written.text.evaluate("reactions", totals, indent, states=False)
    for name in totals:
        first = name.removeprefix("total_")
        lines.append(f"{indent}share_{first} = friction_{first} / {name} if {name} != 0.0 else 0.0")
    return lines + written.text.evaluate("reactions", targets, indent, states=False)


def _cone(of: ContactDeclaration, point: int) -> sp.Expr:
    mu = of.contacts[point].law.friction
    return sp.S.One if mu is None else sp.sympify(mu)


# -- tables ------------------------------------------------------------------------------------


def _tables(written: Written) -> list[str]:
    """Points and elements, their states in each mode, and guards."""
    of, modes = written.of, written.modes
    guards = [guards_of(of, pattern) for pattern in modes.patterns]
    guards_in = {state.name: guards[state.pattern] for state in modes.states}
    longest_row = max(1, *map(len, guards_in.values()))
    if of.contacts and longest_row > MOST_DIGITS:
        raise ValueError(
            f"{of.name}: its contacts and elements have {longest_row} guards in one mode, "
            f"more than {MOST_DIGITS}: declare fewer of them"
        )
    slips = max(len(mode.slipping) for mode in modes.derived)
    return [
        *table("POINTS", [c.name for c in of.contacts]),
        *table("ELEMENTS", [e.name for e in of.switching]),
        f"N_GUARDS = {longest_row}",
        f"N_PARTS = {2 * len(pairs_of(of))}",
        f"N_POINTS = {len(of.contacts)}",
        f"FEET_OF = {_feet_of(of)}  # 1 where a point is one of each body",
        f"N_ELEMENTS = {len(of.switching)}",
        *([f"TIES = {ties!r}"] if (ties := _ties(of)) else []),
        *(table("BOUNDS", of.bounds) if of.bounds else []),
        *(["HELD_ACROSS = True"] if of.is_held_across else []),
        *impact_law(of),
        "TRANSITIONS = ()",
        *column("SIDES = (", dict.fromkeys(modes.names, "0.0")),
        *column("GUARDS = (", {name: str(len(row)) for name, row in guards_in.items()}),
        *_states_of_contacts(of, modes, slips),
        *_of_guards(of, modes, guards_in, longest_row),
        "LOCALISED = False  # whether forces may act in a small part of a step",
        "FULL_CONTACT = -1  # mode whose guards are sums of the state and the ground, or -1",
        "HAS_IMPULSIVE = False",
    ]


def _feet_of(of: ContactDeclaration) -> tuple[tuple[int, ...], ...]:
    """Whether each point is one of each body: at one distance from its centroid."""
    q = {c.position for c in of.coordinates}

    def is_of(contact: Contact, body: Body) -> bool:
        apart = sum((a - b) ** 2 for a, b in zip(contact.point, body.position, strict=True))
        return not tidy(sp.expand_trig(apart)).free_symbols & q

    return tuple(tuple(int(is_of(c, b)) for c in of.contacts) for b in of.bodies)


def _states_of_contacts(of: ContactDeclaration, modes: Modes, slips: int) -> list[str]:
    """States of points and elements in each mode, and the equations that serve it."""
    written = {state: modes.patterns[state.pattern] for state in modes.states}
    smooth = any(FRICTIONLESS in state.points for state in written)
    return [
        *rows(
            "POINT_STATES = (  # 0 open, 1 sticks, 2 slips to the right, 3 to the left"
            + (", 4 touches without friction" if smooth else ""),
            {state.name: state.points for state in written},
        ),
        *rows(f"ELEMENT_STATES = (  # {_legend(of)}", {s.name: s.elements for s in written}),
        *rows(
            "SHARED = (  # the first point with which each shares its friction",
            {state.name: pattern.shared for state, pattern in written.items()},
        ),
        *column("PATTERNS = (", {s.name: str(s.pattern) for s in written}),
        *column("EQUATIONS = (", {s.name: str(a.mode) for s, a in written.items()}),
        f"QUICK = ({''.join(f'({i}, {moves}), ' for i, moves in quick(modes)).rstrip()})"
        "  # derived with a step of their own, and the coordinate that the others follow",
        *column(
            "IMAGES = (  # the side s with which its mode is written",
            {state.name: f"{a.side}.0" for state, a in written.items()},
        ),
        *rows(
            "SIGMAS = (  # sigma of each group of points that slips",
            {
                state.name: [f"{sign}.0" for sign in modes.signs_of(state)]
                + ["0.0"] * (slips - len(modes.signs_of(state)))
                for state in written
            },
        ),
    ]


def _legend(of: ContactDeclaration) -> str:
    """Meaning of the states of elements."""
    yields = any(-1 in e.states for e in of.switching)
    return "0 elastic or off, 1 yields or on, -1 yields back or slack" if yields else "0 off, 1 on"


class _Row(NamedTuple):
    """A guard of a mode in the tables; -1 is none."""

    kind: int
    subject: int
    target: int = -1
    back: int = -1
    part: int = -1


def _of_guards(
    of: ContactDeclaration, modes: Modes, guards_in: Mapping[str, list[Guard]], longest_row: int
) -> list[str]:
    numbers = {(state.points, state.elements): i for i, state in enumerate(modes.states)}
    places = {
        state.pattern: {guard: k for k, guard in enumerate(guards_in[state.name])}
        for state in modes.states
    }
    points = len(of.contacts)
    parts = {pair: longest_row + 2 * k for k, pair in enumerate(pairs_of(of))}

    def row(number: int, guard: Guard) -> _Row:
        entry = _Row(guard.kind, guard.subject)
        if guard.kind != SWITCH:
            return entry
        state, i = modes.states[number], guard.subject - points
        ending = ending_of(of, guard, state.elements[i])
        switched = (*state.elements[:i], ending.target, *state.elements[i + 1 :])
        target = numbers.get((state.points, switched))
        if target is None:  # others switch before it
            return entry._replace(target=number)
        back, pair = guard.of(ending.back), (i, state.elements[i], guard.place)
        return entry._replace(
            target=target,
            back=-1 if back is None else places[state.pattern].get(back, -1),
            part=parts.get(pair, -1),
        )

    every = {
        name: [row(i, g) for g in guards] for i, (name, guards) in enumerate(guards_in.items())
    }

    def numbers_of(first: str, value: Callable[[_Row], int], filler: int = -1) -> list[str]:
        entry = {name: [*map(value, row)] for name, row in every.items()}
        return rows(first, entry, filler, longest_row)

    legend = "2 switch, 4 landing, 5 lifting, 6 slipping, 7 sticking"
    legend += ", 8 bound" if of.bounds else ""
    return [
        *numbers_of(f"KINDS = (  # of each guard of each mode; {legend}", lambda r: r.kind, SWITCH),
        *numbers_of(
            "SUBJECTS = (  # the point of each guard, or the element, numbered behind the points",
            lambda r: r.subject,
        ),
        *numbers_of("TARGETS = (  # mode to which a switch leads", lambda r: r.target),
        *numbers_of("REVERSE = (  # guard of it that leads back", lambda r: r.back),
        *numbers_of("PARTS = (  # place in g of the two parts of a guard, or -1", lambda r: r.part),
    ]
