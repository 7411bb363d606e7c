"""Tables of a module: names and units, numbers of states and guards, where guards lead."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from rockeom.codegen.contacts import Guard, guards_of, pairs_of, passage_of, quick
from rockeom.codegen.guards import longest, outgoing, parts
from rockeom.codegen.jump import impulsive
from rockeom.codegen.names import string
from rockeom.codegen.parameters import sizes_to_check
from rockeom.codegen.printer import WIDTH
from rockeom.codegen.text import Text
from rockeom.codes import FRICTIONLESS, IMPULSIVE, KIND_OF, MOST_DIGITS, RATIO, SWITCH
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.model import Parameter, RockingModel
from rockeom.symbolic.modes import Modes


def tables(text: Text, columns: Mapping[str, Iterable[str]], held: int) -> list[str]:
    """All tables; `columns` : those that name what functions give. held : see `held.py`."""
    of = text.model.functions
    return [
        "",
        *_words(text.model, columns, text.model.contacts),
        "",
        *_numbers(text),
        *_of_guards(text.model),
        f"NARROW = {bool(of)}  # whether forces may act in a small part of a step",
        f"HELD = {held}  # contact state whose guards are sums of the state and the ground, or -1",
        f"HAS_IMPULSIVE = {impulsive(text.model)}",
        f"RATIO, IMPULSIVE = {RATIO}, {IMPULSIVE}",
        *(f"{name} = {i}" for i, name in enumerate(text.contacts.values())),
    ]


def contact_tables(text: Text, columns: Mapping[str, Iterable[str]]) -> list[str]:
    """All tables of a structure whose contacts are declared."""
    model, modes = text.model, text.model.modes
    written = {state.name: modes.arrangements[state.arrangement] for state in modes.states}
    guards = [guards_of(model, arrangement) for arrangement in modes.arrangements]
    rows = {state.name: guards[state.arrangement] for state in modes.states}
    longest_row = max(1, *map(len, rows.values()))
    if model.contacts and longest_row > MOST_DIGITS:
        raise ValueError(
            f"{model.name}: its contacts and elements have {longest_row} guards in one contact "
            f"state, more than {MOST_DIGITS}: declare fewer of them"
        )
    slips = max(len(mechanism.slipping) for mechanism in modes.mechanisms)
    return [
        "",
        *_words(model, columns, modes.names),
        *_table("POINTS", [c.name for c in model.contacts]),
        *_table("ELEMENTS", [e.name for e in model.switching]),
        "",
        f"N_STATES = {2 * text.n}",
        f"N_GUARDS = {longest_row}",
        f"N_PARTS = {2 * len(pairs_of(model))}",
        f"N_POINTS = {len(model.contacts)}",
        f"N_ELEMENTS = {len(model.switching)}",
        *_internal(model),
        f"ROTATION = {text.index(model.rotation.position)}",
        f"ROTATION_RATE = {text.index(model.rotation.velocity)}",
        *_falls(text),
        *_column("SIDES = (", dict.fromkeys(written, "0.0")),
        *_column("GUARDS = (", {name: str(len(row)) for name, row in rows.items()}),
        *_states_of_contact(model, modes, slips),
        *_of_derived_guards(model, modes, rows, longest_row),
        "NARROW = False  # whether forces may act in a small part of a step",
        "HELD = -1  # contact state whose guards are sums of the state and the ground, or -1",
        "HAS_IMPULSIVE = False",
        f"RATIO, IMPULSIVE = {RATIO}, {IMPULSIVE}",
        *(f"{name} = {i}" for i, name in enumerate(text.contacts.values())),
    ]


def _falls(text: Text) -> list[str]:
    """Which coordinates may fall beside the rotation."""
    falls = text.model.falls
    if not falls:
        return ["N_FALLS = 0"]
    return [
        f"N_FALLS = {len(falls)}",
        f"FALLS = ({', '.join(str(text.index(c.position)) for c in falls)},)",
    ]


def _internal(model: Model) -> list[str]:
    """How many of the states, the last ones, have no coordinate behind them."""
    return [f"N_INTERNAL = {len(model.internal)}"] if model.internal else []


def _states_of_contact(model: Model, modes: Modes, slips: int) -> list[str]:
    """What each point and element does in each contact state, and which mechanism moves."""
    written = {state: modes.arrangements[state.arrangement] for state in modes.states}
    smooth = any(FRICTIONLESS in state.points for state in written)
    return [
        *_rows(
            "POINT_STATES = (  # 0 open, 1 sticks, 2 slips to the right, 3 to the left"
            + (", 4 touches without friction" if smooth else ""),
            {state.name: state.points for state in written},
        ),
        *_rows(f"ELEMENT_STATES = (  # {_legend(model)}", {s.name: s.elements for s in written}),
        *_rows(
            "SHARED = (  # the first point with which each shares its friction",
            {state.name: arrangement.shared for state, arrangement in written.items()},
        ),
        *_column("ARRANGEMENTS = (", {s.name: str(s.arrangement) for s in written}),
        *_column("MECHANISMS = (", {s.name: str(a.mechanism) for s, a in written.items()}),
        f"QUICK = ({''.join(f'({i}, {moves}), ' for i, moves in quick(modes)).rstrip()})"
        "  # mechanisms with a step of their own, and the coordinate that the others follow",
        *_column(
            "IMAGES = (  # the side s with which its mechanism is written",
            {state.name: f"{a.side}.0" for state, a in written.items()},
        ),
        *_rows(
            "SIGMAS = (  # sigma of each group of points that slips",
            {
                state.name: [f"{sign}.0" for sign in modes.signs_of(state)]
                + ["0.0"] * (slips - len(modes.signs_of(state)))
                for state in written
            },
        ),
    ]


def _legend(model: Model) -> str:
    """What the states of elements are."""
    yields = any(-1 in e.states for e in model.switching)
    return "0 elastic or off, 1 yields or on, -1 yields back or slack" if yields else "0 off, 1 on"


class _Row(NamedTuple):
    """A guard of a contact state in the tables; -1 is none."""

    kind: int
    subject: int
    target: int = -1
    back: int = -1
    part: int = -1


def _of_derived_guards(
    model: Model, modes: Modes, rows: Mapping[str, list[Guard]], longest_row: int
) -> list[str]:
    numbers = {(state.points, state.elements): i for i, state in enumerate(modes.states)}
    places = {
        state.arrangement: {guard: k for k, guard in enumerate(rows[state.name])}
        for state in modes.states
    }
    points = len(model.contacts)
    parts = {pair: longest_row + 2 * k for k, pair in enumerate(pairs_of(model))}

    def row(number: int, guard: Guard) -> _Row:
        found = _Row(guard.kind, guard.subject)
        if guard.kind != SWITCH:
            return found
        state, i = modes.states[number], guard.subject - points
        passage = passage_of(model, guard, state.elements[i])
        switched = (*state.elements[:i], passage.target, *state.elements[i + 1 :])
        target = numbers.get((state.points, switched))
        if target is None:  # others switch before it
            return found._replace(target=number)
        back, pair = guard.of(passage.back), (i, state.elements[i], guard.place)
        return found._replace(
            target=target,
            back=-1 if back is None else places[state.arrangement].get(back, -1),
            part=parts.get(pair, -1),
        )

    every = {name: [row(i, g) for g in of] for i, (name, of) in enumerate(rows.items())}

    def table(first: str, of: Callable[[_Row], int], filler: int = -1) -> list[str]:
        found = {name: [*map(of, row)] for name, row in every.items()}
        return _rows(first, found, filler, longest_row)

    legend = "2 switch, 4 landing, 5 lifting, 6 slipping, 7 sticking"
    return [
        *table(
            f"KINDS = (  # of each guard of each contact state; {legend}", lambda r: r.kind, SWITCH
        ),
        *table(
            "SUBJECTS = (  # the point of each guard, or the element, numbered behind the points",
            lambda r: r.subject,
        ),
        *table("TARGETS = (  # contact state to which a switch leads", lambda r: r.target),
        *table("CLOSED = (  # guard of it that leads back", lambda r: r.back),
        *table("PARTS = (  # place in g of the two parts of a guard, or -1", lambda r: r.part),
    ]


def _words(
    model: RockingModel | Model, columns: Mapping[str, Iterable[str]], contacts: Iterable[str]
) -> list[str]:
    """What is called how, in which unit."""
    units = [c.unit for c in model.coordinates]
    rates = [_rate_unit(unit) for unit in units]
    if isinstance(model, Model):
        units += [c.unit for c in model.integrals]
        rates += [z.unit for z in model.internal]
    return [
        f"NAME = {string(model.name)}",
        f"CLASS = {string(class_name(model.name))}",
        *_table("STATES", model.states),
        *_table("STATE_UNITS", units + rates),
        *_table("PARAMETERS", [p.name for p in model.parameters]),
        *_table("PARAMETER_UNITS", [p.unit for p in model.parameters]),
        *_table("PARAMETER_MEANINGS", [p.meaning for p in model.parameters]),
        *_table("PARAMETER_SIGNS", [_sign(p) for p in model.parameters]),
        *_of_sizes(model),
        *_table("CONTACTS", contacts),
        *_transitions(model),
        *(line for name, values in columns.items() for line in _table(name, values)),
    ]


def _transitions(model: RockingModel | Model) -> list[str]:
    """Those that are declared."""
    if isinstance(model, Model):
        return ["TRANSITIONS = ()"]
    return [
        "TRANSITIONS = (",
        *(
            f"    ({string(t.source)}, {string(t.target)}, {string(t.kind)}),"
            for c in model.contacts
            for t in outgoing(model, c)
        ),
        ")",
    ]


def _numbers(text: Text) -> list[str]:
    """How many there are, and where the rotation stands."""
    model = text.model
    sides = [model.mechanism(c).side_of(c) for c in model.contacts]
    return [
        f"N_STATES = {2 * text.n}",
        f"N_GUARDS = {longest(model)}",
        f"N_PARTS = {max(sum(map(len, parts(model, c))) for c in model.contacts)}",
        f"ROTATION = {text.index(model.rotation.position)}",
        f"ROTATION_RATE = {text.index(model.rotation.velocity)}",
        *_falls(text),
        f"SIDES = ({', '.join(str(float(s)) for s in sides)},)",
        f"GUARDS = ({', '.join(str(len(outgoing(model, c))) for c in model.contacts)},)",
    ]


def _of_guards(model: RockingModel) -> list[str]:
    """Tables with a row for each contact state, and in it a number for each guard."""
    rows = {c: outgoing(model, c) for c in model.contacts}
    legend = ", ".join(f"{number} {kind}" for kind, number in KIND_OF.items())
    return [
        *_rows(
            f"KINDS = (  # of each guard of each contact state; {legend}",
            {c: [KIND_OF[t.kind] for t in row] for c, row in rows.items()},
            SWITCH,
        ),
        *_rows(
            "TARGETS = (  # contact state to which each guard leads",
            {c: [model.contacts.index(t.target) for t in row] for c, row in rows.items()},
        ),
        *_rows(
            "CLOSED = (  # guard of the contact state that follows which is closed on entering it",
            {c: _closed(model, c) for c in rows},
        ),
        *_rows(
            "PARTS = (  # place in g of the two parts of a guard, or -1",
            {c: [min(two, default=-1) for two in parts(model, c)] for c in rows},
        ),
    ]


def _closed(model: RockingModel, contact: str) -> list[int]:
    """For each guard of a contact state: the one of its target that leads back, or -1.

    It is zero on entering, up to rounding, and must not be taken for another event.
    """
    back = []
    for t in outgoing(model, contact):
        returning = [
            i
            for i, other in enumerate(outgoing(model, t.target))
            if t.reversible and contact in (other.target, other.fallback)
        ]
        back.append(returning[0] if returning else -1)
    return back


def class_name(model: str) -> str:
    """What a user calls the class of a model of this name."""
    return "".join(part[:1].upper() + part[1:] for part in model.split("_")) or model


def _sign(parameter: Parameter) -> str:
    """Which numbers a parameter may be: whole and positive, not negative, or any."""
    if parameter.symbol.is_integer:
        return "n"
    return "+" if parameter.symbol.is_nonnegative else "+-"


def _of_sizes(model: RockingModel | Model) -> list[str]:
    """What is told where `sizes` gives a number that no structure has."""
    rows = sizes_to_check(model)
    if not rows:
        return ["SIZES = ()"]
    return [
        "SIZES = (  # what, whether it may be zero, parameters, remedy",
        *(
            f"    ({string(s.what)}, {s.may_vanish}, "
            f"({''.join(f'{string(p)}, ' for p in s.parameters).strip()}), {string(s.remedy)}),"
            for s in rows
        ),
        ")",
    ]


def _rate_unit(unit: str) -> str:
    return "1/s" if unit == "-" else f"{unit}/s"


def _column(first: str, values: Mapping[str, str]) -> list[str]:
    """A table with a number for each contact state."""
    return [first, *(f"    {value},  # {contact}" for contact, value in values.items()), ")"]


def _rows(
    first: str, rows: Mapping[str, Sequence[Any]], filler: int = -1, length: int = 0
) -> list[str]:
    """A table with a row for each contact state, all of one length."""
    length = max(length, *map(len, rows.values()))
    lines = []
    for contact, numbers in rows.items():
        row = [*numbers, *[filler] * (length - len(numbers))]
        lines.append(f"    ({''.join(f'{i}, ' for i in row).strip()}),  # {contact}")
    return [first, *lines, ")"]


def _table(name: str, values: Iterable[str]) -> list[str]:
    values = list(values)
    items = "".join(f"{string(v)}, " for v in values).strip()
    line = f"{name} = ({items})"
    if len(line) <= WIDTH:
        return [line]
    return [f"{name} = (", *(f"    {string(v)}," for v in values), ")"]
