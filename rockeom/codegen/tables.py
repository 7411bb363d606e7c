"""Tables of a module: names and units, numbers of states and guards, where guards lead."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rockeom.codegen.guards import longest, outgoing, parts
from rockeom.codegen.jump import impulsive
from rockeom.codegen.names import string
from rockeom.codegen.parameters import sizes_to_check
from rockeom.codegen.printer import WIDTH
from rockeom.codegen.text import Text
from rockeom.contract import IMPULSIVE, KIND_OF, RATIO, SWITCH
from rockeom.symbolic.model import Parameter, RockingModel


def tables(text: Text, columns: Mapping[str, Iterable[str]]) -> list[str]:
    """All tables; `columns` : those that name what functions give."""
    return [
        "",
        *_words(text.model, columns),
        "",
        *_numbers(text),
        *_of_guards(text.model),
        f"NARROW = {bool(text.model.laws)}  # whether forces may act in a small part of a step",
        f"HAS_IMPULSIVE = {impulsive(text.model)}",
        f"RATIO, IMPULSIVE = {RATIO}, {IMPULSIVE}",
        *(f"{name} = {i}" for i, name in enumerate(text.contacts.values())),
    ]


def _words(model: RockingModel, columns: Mapping[str, Iterable[str]]) -> list[str]:
    """What is called how, in which unit."""
    units = [c.unit for c in model.coordinates]
    return [
        f"NAME = {string(model.name)}",
        f"CLASS = {string(class_name(model.name))}",
        *_table("STATES", model.states),
        *_table("STATE_UNITS", units + [_rate_unit(unit) for unit in units]),
        *_table("PARAMETERS", [p.name for p in model.parameters]),
        *_table("PARAMETER_UNITS", [p.unit for p in model.parameters]),
        *_table("PARAMETER_MEANINGS", [p.meaning for p in model.parameters]),
        *_table("PARAMETER_SIGNS", [_sign(p) for p in model.parameters]),
        *_of_sizes(model),
        *_table("CONTACTS", model.contacts),
        "TRANSITIONS = (",
        *(
            f"    ({string(t.source)}, {string(t.target)}, {string(t.kind)}),"
            for c in model.contacts
            for t in outgoing(model, c)
        ),
        ")",
        *(line for name, values in columns.items() for line in _table(name, values)),
    ]


def _numbers(text: Text) -> list[str]:
    """How many there are, and where the rotation stands."""
    model = text.model
    sides = [model.phase(c).side_of(c) for c in model.contacts]
    return [
        f"N_STATES = {2 * text.n}",
        f"N_GUARDS = {longest(model)}",
        f"N_PARTS = {max(sum(map(len, parts(model, c))) for c in model.contacts)}",
        f"ROTATION = {text.index(model.rotation.position)}",
        f"ROTATION_RATE = {text.index(model.rotation.velocity)}",
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


def _of_sizes(model: RockingModel) -> list[str]:
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


def _rows(first: str, rows: Mapping[str, list[int]], filler: int = -1) -> list[str]:
    """A table with a row for each contact state, all of one length."""
    length = max(map(len, rows.values()))
    lines = []
    for contact, numbers in rows.items():
        row = numbers + [filler] * (length - len(numbers))
        lines.append(f"    ({''.join(f'{i}, ' for i in row).strip()}),  # {contact}")
    return [first, *lines, ")"]


def _table(name: str, values: Iterable[str]) -> list[str]:
    items = ", ".join(map(string, values))
    line = f"{name} = ({items},)"
    if len(line) <= WIDTH:
        return [line]
    return [f"{name} = (", *(f"    {string(v)}," for v in values), ")"]
