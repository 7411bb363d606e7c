"""The functions of a structure whose contacts were declared: motion, forces, guards, outputs.

Each mechanism has one text, written with the side s, the sign sigma of each slip and the state chi
of each element as numbers. Which one moves in a contact state stands in tables.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import prod

import sympy as sp

from rockeom.codegen.outputs import Columns
from rockeom.codegen.solve import TOTAL_GRAVITY, eliminated, unsymmetric
from rockeom.codegen.text import Text
from rockeom.codes import (
    FRICTIONLESS,
    LANDING,
    LIFTING,
    NEVER_SLIPS,
    SLIPPING,
    STICKING,
    SWITCH,
)
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.beds import number_of_combinations
from rockeom.symbolic.contact import total_reaction
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.elements import Passage
from rockeom.symbolic.impulse import momentum
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import GROUND_Y
from rockeom.symbolic.modes import (
    OPEN,
    SLIP,
    STICK,
    VERBS,
    Arrangement,
    DerivedMechanism,
    Modes,
    brief,
    force_of,
    free_motion,
    sign_of_slip,
    switch_of,
)
from rockeom.symbolic.statics import equilibrium

MOST_QUICK = 2
"""So many mechanisms have functions of their own: each makes the program longer."""


class Written:
    """Names of signs and switches, and of the functions of each mechanism as they are written."""

    def __init__(self, text: Text) -> None:
        self.text, self.modes = text, text.model.modes
        self.rates: list[str] = []
        self.forces: dict[int, str] = {}
        self.slips = max(len(m.slipping) for m in self.modes.mechanisms)
        self.switches = [f"chi_{i}" for i in range(len(text.model.switching))]
        for i in range(self.slips):
            text.names[sign_of_slip(i)] = sp.Symbol(f"sigma_{i}")
        for i, name in enumerate(self.switches):
            text.names[switch_of(i)] = sp.Symbol(name)

    def call(self, function: str, mechanism: DerivedMechanism) -> str:
        """How a function of a mechanism is called."""
        side = ["s"] if mechanism.sided else []
        sigmas = [f"sigma_{i}" for i in range(len(mechanism.slipping))]
        given = [*side, *sigmas, *self.switches, *self.text.states, "p", "ax", "ay"]
        return f"{function}({', '.join(given)})"

    def read(self, mechanism: DerivedMechanism, indent: str) -> list[str]:
        """Lines that read the signs of a contact state from the tables."""
        lines = [f"{indent}s = IMAGES[contact]"] if mechanism.sided else []
        lines += [
            f"{indent}sigma_{i} = SIGMAS[contact][{i}]" for i in range(len(mechanism.slipping))
        ]
        return lines + self.read_switches(indent)

    def read_switches(self, indent: str) -> list[str]:
        return [
            f"{indent}{name} = 1.0 * ELEMENT_STATES[contact][{i}]"
            for i, name in enumerate(self.switches)
        ]

    def found_forces(self, arrangement: Arrangement, indent: str) -> list[str]:
        """Lines that find the forces of an arrangement's points, by their own numbers.

        The friction is that of a group, and has the number of the first of its points.
        """
        mechanism = self.modes.mechanisms[arrangement.mechanism]
        if not mechanism.closed:
            return self.read_switches(indent)
        lines = self.read(mechanism, indent)
        lines += [f"{indent}{x} = y[{i}]" for i, x in enumerate(self.text.states)]
        names = [f"normal_{arrangement.points[i]}" for i in mechanism.closed]
        names += [f"friction_{first_of(arrangement, g)}" for g in groups_of(mechanism)]
        found = ", ".join(names) + ("," if len(names) == 1 else "")
        return [*lines, f"{indent}{found} = {self.forces[arrangement.mechanism]}"]


def groups_of(mechanism: DerivedMechanism) -> list[tuple[int, ...]]:
    """Points that share friction, in the order in which a mechanism tells of them."""
    return [*mechanism.slipping, *mechanism.sticking]


def first_of(arrangement: Arrangement, group: tuple[int, ...]) -> int:
    """The first of the points that play the parts of a mechanism's group."""
    return min(arrangement.points[i] for i in group)


def contact_functions(text: Text) -> dict[str, Columns]:
    """Add all functions; returns the columns of those that have a table of names."""
    written = Written(text)
    _motions(written)
    _forces(written)
    _guards(written)
    if text.model.switching:
        _jump(text)
    _free_motion(written)
    _points(text)
    _point_laws(text)
    columns = {
        "ENERGIES": _energies(written),
        "REACTIONS": _reactions(written),
        "KINEMATICS": _kinematics(text),
    }
    _momentum(text)
    _statics(written)
    return columns


def _every(text: Text, name: str, targets: Mapping[str, sp.Expr]) -> list[str]:
    """Lines of a function that is the same in every contact state."""
    return text.evaluate(name, targets, "    ") or ["    pass"]


def _chosen(name: str, branches: list[list[str]]) -> list[str]:
    """Lines of the branch of a contact state's mechanism or arrangement; of one alone, its own."""
    if len(branches) == 1:
        return [line[4:] for line in branches[0]]
    lines = [f"    {name} = {name.upper()}S[contact]"]
    for i, branch in enumerate(branches):
        test = f"{'elif' if i else 'if'} {name} == {i}"
        lines += [f"    {'else' if i == len(branches) - 1 else test}:", *branch]
    return lines


# -- motion -----------------------------------------------------------------------------------


def _suffix(mechanism: DerivedMechanism) -> str:
    """What the functions of a mechanism are called by."""
    points = zip(mechanism.model.contacts, mechanism.states, strict=True)
    words = [f"{c.name}_{VERBS[state]}" for c, state in points if state]
    return "_".join(words) or "flight"


def _told(mechanism: DerivedMechanism) -> str:
    """What a mechanism is, in words."""
    points = zip(mechanism.model.contacts, mechanism.states, strict=True)
    words = [f"{c.name} {VERBS[state]}" for c, state in points if state]
    mirrored = ", or its mirror image" if mechanism.sided else ""
    return (", ".join(words) or "no point is closed") + mirrored


def _motions(written: Written) -> None:
    """Rates of all states: of each mechanism, of the one that moves, and on arrays."""
    text, mechanisms = written.text, written.modes.mechanisms
    branches = []
    for i, mechanism in enumerate(mechanisms):
        written.rates.append(_motion_of(written, i, mechanism))
        branches.append([*written.read(mechanism, " " * 8), f"        return {written.rates[-1]}"])
    n, states = text.n, ", ".join(text.states)
    text.function(
        f"rates_of_states(contact, {states}, p, ax, ay)",
        "Rates of all states, in their order.",
        _chosen("mechanism", branches),
        "@inlined",
    )
    found = ", ".join(f"found[{n + i}]" for i in range(n))
    text.function(
        f"accelerations(contact, {states}, p, ax, ay)",
        "Accelerations of the coordinates under ground accelerations ax, ay [m/s2].",
        [
            f"    found = rates_of_states(contact, {states}, p, ax, ay)",
            f"    return ({found},)",
        ],
        "@inlined",
    )
    for i, _ in quick(written.modes):
        text.function(
            f"accelerations_{i}(contact, {states}, p, ax, ay)",
            f"The same where {_told(mechanisms[i])}.",
            [
                *written.read(mechanisms[i], "    "),
                f"    found = {written.rates[i]}",
                f"    return ({found},)",
            ],
            "@everywhere",
        )
    given = ", ".join(f"y[{i}]" for i in range(2 * n))
    text.function(
        "rates(contact, y, p, ax, ay, dy)",
        "Rates of the states y (N,) under ground accelerations ax, ay [m/s2], into dy (N,).",
        [
            f"    found = rates_of_states(contact, {given}, p, ax, ay)",
            *(f"    dy[{i}] = found[{i}]" for i in range(2 * n)),
        ],
    )
    text.function(
        "opening_acceleration(contact, y, p, ax, ay)",
        "Zero: whether a gap opens is found among the candidates.",
        ["    return 0.0"],
        "@inlined",
    )


def quick(modes: Modes) -> list[tuple[int, int]]:
    """The mechanisms of one coordinate, that the others follow, where nothing slips; and which."""
    return [
        (i, m.independent[0])
        for i, m in enumerate(modes.mechanisms)
        if len(m.independent) == 1 and not m.slipping
    ][:MOST_QUICK]


def _motion_of(written: Written, number: int, mechanism: DerivedMechanism) -> str:
    """Add the function of one mechanism; returns how it is called."""
    text = written.text
    name = text.function_name(f"rates_{_suffix(mechanism)}", f"rates_{number}")
    names = [text.name(a) for a in mechanism.qdd]
    internal = {text.name(z.rate): mechanism.here(e) for z, e in text.model.internal.items()}
    rates = list(text.states[text.n :])
    entries: dict[str, sp.Expr] = dict(internal)
    tied: list[str] = []
    for d in mechanism.dependent:
        speed, drift = mechanism.velocity[mechanism.qd[d]], mechanism.drift[d]
        rates[d] = "0.0" if speed == 0 else f"speed_{d}"
        if speed != 0:
            entries[f"speed_{d}"] = speed
        terms = []
        if drift != 0:
            entries[f"drift_{d}"] = drift
            terms.append(f"drift_{d}")
        for j, i in enumerate(mechanism.independent):
            if mechanism.motions[d, j] != 0:
                entries[f"tie_{d}_{i}"] = mechanism.motions[d, j]
                terms.append(f"tie_{d}_{i} * {names[i]}")
        tied.append(f"    {names[d]} = {' + '.join(terms) or '0.0'}")
    solve = eliminated if mechanism.symmetric else unsymmetric
    gravity, out = text.model.gravity, [names[i] for i in mechanism.independent]
    of_motion, solved = solve(
        text, mechanism.mass_matrix, mechanism.forcing, out, "    ", gravity
    )  # fmt: skip
    first = {TOTAL_GRAVITY.name: gravity + GROUND_Y}
    body = text.evaluate("rates", of_motion | entries, "    ", first, hoist=True, states=False)
    call = written.call(name, mechanism)
    text.function(
        call,
        f"Rates of all states where {_told(mechanism)}.",
        [*body, *solved, *tied, f"    return ({', '.join([*rates, *names, *internal])},)"],
        "@inlined",
    )
    return call


# -- forces -----------------------------------------------------------------------------------


def _forces(written: Written) -> None:
    """Of each mechanism with a closed point: its normal forces, and the friction of each group."""
    text = written.text
    for number, mechanism in enumerate(written.modes.mechanisms):
        if not mechanism.closed:
            continue
        name = text.function_name(f"forces_{_suffix(mechanism)}", f"forces_{number}")
        normal, friction = mechanism.forces
        targets = {f"normal_{i}": e for i, e in normal.items()}
        targets |= {f"friction_{g[0]}": friction[g[0]] for g in groups_of(mechanism)}
        used = set().union(*(e.free_symbols for e in targets.values()))
        moving = used & set(mechanism.qdd)
        lines = [f"    found = {written.rates[number]}"] if moving else []
        lines += [
            f"    {text.name(a)} = found[{text.n + j}]"
            for j, a in enumerate(mechanism.qdd)
            if a in moving
        ]
        lines += text.evaluate("forces", targets, "    ", hoist=True, states=False)
        written.forces[number] = written.call(name, mechanism)
        text.function(
            written.forces[number],
            f"Normal forces, then friction [N], where {_told(mechanism)}.",
            [*lines, f"    return ({', '.join(targets)},)"],
            "@inlined",
        )


@dataclass(frozen=True)
class Guard:
    """A guard of an arrangement: of a point, or of an element, whose numbers follow on theirs.

    sign : of the friction that it bounds. place : among the passages of its element.
    """

    kind: int
    subject: int
    sign: int = 0
    place: int = 0

    def of(self, place: int | None) -> Guard | None:
        """That of another passage of its element."""
        return None if place is None else replace(self, place=place)


def guards_of(model: Model, arrangement: Arrangement) -> list[Guard]:
    """The guards of an arrangement in the order in which they stand in g, elements last."""
    found: list[Guard] = []
    for i, state in enumerate(arrangement.states):
        if state == OPEN:
            found.append(Guard(LANDING, i))
            continue
        found.append(Guard(LIFTING, i))
        if arrangement.shared[i] != i:
            continue
        group = [j for j, first in enumerate(arrangement.shared) if first == i]
        if state == SLIP:
            found.append(Guard(STICKING, i))
        elif state == STICK and all(model.contacts[j].law.friction is not None for j in group):
            found += [Guard(SLIPPING, i, 1), Guard(SLIPPING, i, -1)]
    return [*found, *_of_elements(model)]


def _of_elements(model: Model) -> list[Guard]:
    points = len(model.contacts)
    return [
        Guard(SWITCH, points + i, place=place)
        for i, passages in enumerate(model.passages)
        for place in range(len(passages[model.switching[i].states[0]]))
    ]


def passage_of(model: Model, guard: Guard, state: int) -> Passage:
    """The passage that ends a state of an element by a guard."""
    return model.passages[guard.subject - len(model.contacts)][state][guard.place]


def pairs_of(model: Model) -> list[tuple[int, int, int]]:
    """(element, state, place) of each guard that is the larger of two."""
    return [
        (i, state, place)
        for i, of in enumerate(model.passages)
        for state, passages in of.items()
        for place, passage in enumerate(passages)
        if len(passage.guard) == 2
    ]


def _guards(written: Written) -> None:
    text, arrangements = written.text, written.modes.arrangements
    branches = [_guards_of(written, arrangement) for arrangement in arrangements]
    text.function(
        "guards(contact, y, p, ax, ay, g)",
        """Guards of a contact state into g: all positive inside it; the first to fall ends it.

    g (N_GUARDS + N_PARTS,) : behind the guards stand the two parts of those that are the larger
        of two, where PARTS says.""",
        _chosen("arrangement", branches),
        "@inlined",
    )


def _guards_of(written: Written, arrangement: Arrangement) -> list[str]:
    """The branch of one arrangement."""
    text, model, indent = written.text, written.text.model, " " * 8
    mechanism = written.modes.mechanisms[arrangement.mechanism]
    part_of = {played: part for part, played in enumerate(arrangement.points)}
    lines = written.found_forces(arrangement, indent)
    if not mechanism.closed:
        lines += [f"{indent}{x} = y[{i}]" for i, x in enumerate(text.states)]
    targets: dict[str, sp.Expr] = {}
    for k, guard in enumerate(guards_of(model, arrangement)):
        i, place = guard.subject, f"g[{k}]"
        if guard.kind == LANDING:
            targets[place] = mechanism.gap(part_of[i])
        elif guard.kind == LIFTING:
            targets[place] = sp.Symbol(f"normal_{i}")
        elif guard.kind == STICKING:
            group = next(g for g in mechanism.slipping if first_of(arrangement, g) == i)
            targets[place] = mechanism.sigma(group[0]) * mechanism.slip_rate(group)
        elif guard.kind == SLIPPING:
            points = [
                j for j, f in enumerate(arrangement.shared) if f == i and arrangement.states[j]
            ]
            cone = sum(mechanism.friction(j) * sp.Symbol(f"normal_{j}") for j in points)
            targets[place] = cone - guard.sign * sp.Symbol(f"friction_{i}")
    switches = _Switches(model)
    targets |= {name: _here(e, arrangement, mechanism) for name, e in switches.values.items()}
    lines += text.evaluate("guards", targets, indent, hoist=True, states=False)
    first = len(guards_of(model, arrangement)) - len(_of_elements(model))
    return [*lines, *(f"{indent}{line}" for line in switches.lines(first))]


def _here(expr: sp.Expr, arrangement: Arrangement, mechanism: DerivedMechanism) -> sp.Expr:
    """An expression where the arrangement's points are closed.

    The place and the rate of a point that is closed are zero then, not what rounding leaves: a bar
    at a foot that stands would begin and cease to act without end.
    """
    if not mechanism.closed:
        return expr
    return brief(mechanism.here(expr).subs(SIDE, arrangement.side))


class _Switches:
    """What guards of elements are made of, each expression once, and their lines.

    values : by name.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        every = prod(len(e.states) for e in model.switching)
        self.waits = number_of_combinations(model.switching) < every  # others switch before some
        self.values: dict[str, sp.Expr] = {}
        self._names: dict[sp.Expr, str] = {}
        for of in model.passages:
            for passages in of.values():
                for e in (e for passage in passages for e in passage.guard):
                    self._add(sp.sympify(e))

    def _add(self, expr: sp.Expr) -> None:
        if expr not in self._names:
            name = f"part_{len(self.values)}"
            self._names |= {expr: name, -expr: f"-{name}"}
            self.values[name] = expr

    def _written(self, passage: Passage) -> str:
        names = [self._names[sp.sympify(e)] for e in passage.guard]
        return names[0] if len(names) == 1 else f"max({', '.join(names)})"

    def lines(self, first: int) -> list[str]:
        """They begin at g[first]; the parts of those that are the larger of two at g[N_GUARDS]."""
        model = self.model
        found: list[str] = []
        for i, state, place in pairs_of(model):
            for e in model.passages[i][state][place].guard:
                found.append(f"g[N_GUARDS + {len(found)}] = {self._names[sp.sympify(e)]}")
        for k, guard in enumerate(_of_elements(model)):
            i = guard.subject - len(model.contacts)
            states = model.switching[i].states
            values = {s: self._written(passage_of(model, guard, s)) for s in states}
            *others, last = values.items()
            tests = [f"{value} if ELEMENT_STATES[contact][{i}] == {s} else" for s, value in others]
            waits = [f"1.0 if TARGETS[contact][{first + k}] == contact else"] if self.waits else []
            found.append(f"g[{first + k}] = {' '.join([*waits, *tests, last[1]])}")
        return found


def _jump(text: Text) -> None:
    """The passage of an element has its target, and no velocity jumps."""
    model, lines = text.model, []
    for i, element in enumerate(model.switching):
        for state in element.states:
            put = element.settled(state)
            if put:
                places = {f"out[{text.index(z.symbol)}]": e for z, e in put.items()}
                lines += [
                    "    if (",
                    f"        SUBJECTS[contact][guard] == {len(model.contacts) + i}",
                    f"        and ELEMENT_STATES[contact][{i}] == {state}",
                    "    ):",
                    *text.evaluate("jump", places, " " * 8),
                ]
    text.function(
        "jump(contact, guard, law, ratio, y, p, out)",
        "The state goes on into out (N,); returns the contact state that follows a guard's fall.",
        [
            "    for i in range(N_STATES):",
            "        out[i] = y[i]",
            *lines,
            "    return TARGETS[contact][guard]",
        ],
    )


def _free_motion(written: Written) -> None:
    text, n = written.text, written.text.n
    matrix, forces = free_motion(text.model)
    inertia = sp.diag(matrix, *([0] * len(text.model.internal)))  # internal variables have none
    targets = {f"matrix[{n * i + j}]": inertia[i, j] for i in range(n) for j in range(n)}
    targets |= {f"forces[{i}]": e for i, e in enumerate([*forces, *_still(text.model)])}
    text.function(
        "free_motion(y, p, ax, ay, contact, matrix, forces)",
        "M (n * n, row by row) and f (n) of M q'' = f + J^T lambda, without forces of contact.",
        written.read_switches("    ") + text.evaluate("free_motion", targets, "    "),
    )


def _still(model: Model) -> list[sp.Expr]:
    """A zero for the integral of each internal variable: no force, no gap knows of it."""
    return [sp.S.Zero] * len(model.internal)


def _points(text: Text) -> None:
    coordinates, targets = text.model.coordinates, {}
    still = {c.acceleration: 0 for c in coordinates}
    size = 5 + 2 * text.n
    for i, contact in enumerate(text.model.contacts):
        gap, slip = contact.at(contact.side)
        rates = [rate(e, coordinates) for e in (gap, slip)]
        biases = [rate(e, coordinates).subs(still) for e in rates]
        slopes = [
            slope
            for e in (gap, slip)
            for slope in (*(sp.diff(e, c.position) for c in coordinates), *_still(text.model))
        ]
        for j, e in enumerate([gap, *rates, *biases, *slopes]):
            targets[f"out[{size * i + j}]"] = tidy(e)
    text.function(
        "points(y, p, out)",
        f"""Of each point from out[i * {size}]: gap, its rate and the slip's, biases, rows.

    gap'' = J_N q'' + bias, and so the slip. The rows are J_N (n), then J_T (n).""",
        _every(text, "points", targets),
    )


def _point_laws(text: Text) -> None:
    targets: dict[str, sp.Expr] = {}
    for i, contact in enumerate(text.model.contacts):
        friction = contact.law.friction
        targets[f"out[{2 * i}]"] = sp.sympify(contact.law.restitution)
        mu = sp.Float(NEVER_SLIPS) if friction is None else sp.sympify(friction)
        targets[f"out[{2 * i + 1}]"] = mu
    text.function(
        "point_laws(p, out)",
        "Of each point from out[2 * i]: restitution, and coefficient of friction.",
        _every(text, "point_laws", targets),
    )


# -- what is asked of a state -----------------------------------------------------------------


def _energies(written: Written) -> Columns:
    text, equations = written.text, written.text.model.free.equations
    pressed = sum((e.energy(switch_of(i)) for i, e in enumerate(text.model.switching)), sp.S.Zero)
    values = {
        "kinetic_energy": equations.kinetic_energy,
        "gravitational_energy": equations.gravitational_energy,
        "elastic_energy": equations.elastic_energy + pressed,
    }
    targets = {f"out[{i}]": e for i, e in enumerate(values.values())}
    text.function(
        "energies(contact, y, p, out)",
        "Kinetic, gravitational and elastic energy [J] into out (3,).",
        written.read_switches("    ") + _every(text, "energies", targets),
    )
    return tuple(values)


def _reactions(written: Written) -> Columns:
    """The ground's horizontal force, then the forces at each point and element."""
    text, model = written.text, written.text.model
    arrangements = written.modes.arrangements
    points, elements = model.contacts, model.switching
    columns = ["horizontal_reaction"]
    columns += [f"{c.name}_reaction" for c in points]
    columns += [f"{e.name}_{e.outputs[0]}" for e in elements]
    columns += [f"{c.name}_friction" for c in points]
    states = ", ".join(f"y[{i}]" for i in range(2 * text.n))
    total = total_reaction(model.free)[0]
    body = [f"    found = accelerations(contact, {states}, p, ax, ay)"]
    body += [
        f"    {text.name(c.acceleration)} = found[{i}]"
        for i, c in enumerate(model.coordinates)
        if c.acceleration in total.free_symbols
    ]
    presses = {f"out[{1 + len(points) + i}]": force_of(model, i) for i in range(len(elements))}
    body += written.read_switches("    ")
    body += text.evaluate("reactions", {"out[0]": total} | presses, "    ")
    if points:
        behind = 1 + len(points) + len(elements)
        branches = [
            [*written.found_forces(a, " " * 8), *_shares(written, a, behind)] for a in arrangements
        ]
        body += _chosen("arrangement", branches)
    text.function(
        "reactions(contact, y, p, ax, ay, out)",
        """Forces [N] into out, in the order of REACTIONS: of the ground, and at each point.

    Where only the sum of frictions is determined, each has the same part of its largest.""",
        body,
    )
    return tuple(columns)


def _shares(written: Written, arrangement: Arrangement, behind: int) -> list[str]:
    """Lines that put the forces of an arrangement's points to their places."""
    model, indent = written.text.model, " " * 8
    mechanism = written.modes.mechanisms[arrangement.mechanism]
    part_of = {played: part for part, played in enumerate(arrangement.points)}
    normals = {
        f"out[{1 + i}]": sp.Symbol(f"normal_{i}") if state else sp.S.Zero
        for i, state in enumerate(arrangement.states)
    }
    lines = written.text.evaluate("reactions", normals, indent, states=False)
    targets: dict[str, sp.Expr] = {}
    for i, state in enumerate(arrangement.states):
        place = f"out[{behind + i}]"
        group = [j for j, f in enumerate(arrangement.shared) if f == arrangement.shared[i]]
        friction = sp.Symbol(f"friction_{group[0]}")
        part = part_of[i]
        if state in (OPEN, FRICTIONLESS):
            targets[place] = sp.S.Zero
        elif state == SLIP:
            normal = sp.Symbol(f"normal_{i}")
            targets[place] = -mechanism.sigma(part) * mechanism.friction(part) * normal
        elif len(group) == 1:
            targets[place] = friction
        else:
            cones = {j: _cone(model, j) * sp.Symbol(f"normal_{j}") for j in group}
            targets[f"total_{group[0]}"] = sum(cones.values())
            share = sp.Symbol(f"share_{group[0]}")
            targets[place] = cones[i] * share
    totals = {k: targets.pop(k) for k in list(targets) if k.startswith("total")}
    lines += written.text.evaluate("reactions", totals, indent, states=False)
    for name in totals:
        first = name.removeprefix("total_")
        lines.append(f"{indent}share_{first} = friction_{first} / {name} if {name} != 0.0 else 0.0")
    return lines + written.text.evaluate("reactions", targets, indent, states=False)


def _cone(model: Model, point: int) -> sp.Expr:
    mu = model.contacts[point].law.friction
    return sp.S.One if mu is None else sp.sympify(mu)


def _kinematics(text: Text) -> Columns:
    """Displacement of the load point; gap and slip of each point."""
    model = text.model
    rest = {c.position: 0 for c in model.coordinates}
    values: dict[str, sp.Expr] = {}
    if model.load_point is not None:
        x = sp.sympify(model.load_point[0])
        values["displacement"] = x - x.subs(rest)
    for contact in model.contacts:
        values[f"{contact.name}_uplift"] = contact.at(contact.side)[0]
    for element in model.switching:
        values[f"{element.name}_{element.outputs[1]}"] = element.told_displacement
    for contact in model.contacts:
        slip = contact.at(contact.side)[1]
        values[f"{contact.name}_slip"] = slip - slip.subs(rest)
    targets = {f"out[{i}]": tidy(e) for i, e in enumerate(values.values())}
    text.function(
        "kinematics(contact, y, p, out)",
        "Displacement of the load point, gap and slip of each point [m] into out, as KINEMATICS.",
        _every(text, "kinematics", targets),
    )
    return tuple(values)


def _momentum(text: Text) -> None:
    total = momentum(text.model.free)
    text.function(
        "momentum(contact, y, p, out)",
        "Horizontal and vertical momentum of all masses [kg m/s] into out (2,).",
        _every(text, "momentum", {f"out[{i}]": e for i, e in enumerate(total)}),
    )


def _statics(written: Written) -> None:
    text = written.text
    lacking = equilibrium(text.model.free)
    for i, e in enumerate(text.model.switching):
        for j, c in enumerate(text.model.coordinates):
            lacking[j] += e.still_force(switch_of(i)) * sp.diff(e.displacement, c.position)
    targets = {f"out[{i}]": tidy(e) for i, e in enumerate([*lacking, *_still(text.model)])}
    text.function(
        "statics(contact, y, p, load, out)",
        "Lack of equilibrium dV/dq - load dx/dq under a force at the load point [N], (n,).",
        written.read_switches("    ") + _every(text, "statics", targets),
    )
