"""Tables that every module has: names and units, states and the rotation, numbers of modes."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from rockeom.codegen.names import string
from rockeom.codegen.parameters import sizes_to_check
from rockeom.codegen.printer import WIDTH
from rockeom.codegen.text import Text
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.model import Parameter


def tables(
    text: Text, columns: Mapping[str, Iterable[str]], of_transitions: Iterable[str]
) -> list[str]:
    """All tables. columns : those that name outputs. of_transitions : those of guards."""
    model = text.model
    return [
        "",
        *_words(model),
        *(line for name, values in columns.items() for line in table(name, values)),
        "",
        *_axes(model),
        f"N_STATES = {2 * text.n}",
        *([f"N_INTERNAL = {len(model.internal)}"] if model.internal else []),
        f"ROTATION = {text.index(model.rotation.position)}",
        f"ROTATION_RATE = {text.index(model.rotation.velocity)}",
        *_falls(text),
        *of_transitions,
        "from rockeom.codes import IMPULSIVE, RATIO",
        *(f"{name} = {i}" for i, name in enumerate(text.mode_constants.values())),
    ]


def _axes(model: HybridModel) -> list[str]:
    """Components of the ground, in the order of arguments; a planar structure has no such table."""
    across = ("horizontal", "transverse", "vertical")
    return table("GROUND", across) if len(model.shaking) == len(across) else []


def _falls(text: Text) -> list[str]:
    """Coordinates that may overturn beside the rotation."""
    falls = text.model.falls
    if not falls:
        return ["N_FALLS = 0"]
    return [
        f"N_FALLS = {len(falls)}",
        f"FALLS = ({', '.join(str(text.index(c.position)) for c in falls)},)",
    ]


def _words(model: HybridModel) -> list[str]:
    """Names, units and meanings."""
    units = [c.unit for c in model.integrated]
    rates = [_rate_unit(c.unit) for c in model.coordinates] + [z.unit for z in model.internal]
    return [
        f"NAME = {string(model.name)}",
        f"CLASS = {string(class_name(model.name))}",
        *table("STATES", model.states),
        *table("STATE_UNITS", units + rates),
        *table("PARAMETERS", [p.name for p in model.parameters]),
        *table("PARAMETER_UNITS", [p.unit for p in model.parameters]),
        *table("PARAMETER_MEANINGS", [p.meaning for p in model.parameters]),
        *table("PARAMETER_SIGNS", [_sign(p) for p in model.parameters]),
        *_of_sizes(model),
        *([] if model.is_by_code else table("MODES", model.mode_names)),
    ]


def class_name(model: str) -> str:
    """Name of the class of a model."""
    return "".join(part[:1].upper() + part[1:] for part in model.split("_")) or model


def _sign(parameter: Parameter) -> str:
    """Numbers that a parameter may be: whole and positive, not negative, or any."""
    if parameter.symbol.is_integer:
        return "n"
    return "+" if parameter.symbol.is_nonnegative else "+-"


def _of_sizes(model: HybridModel) -> list[str]:
    """Words of the errors where `sizes` gives a number that no structure has."""
    sizes = sizes_to_check(model)
    if not sizes:
        return ["SIZES = ()"]
    return [
        "SIZES = (  # what, whether it may be zero, parameters, remedy",
        *(
            f"    ({string(s.what)}, {s.may_vanish}, "
            f"({''.join(f'{string(p)}, ' for p in s.parameters).strip()}), {string(s.remedy)}),"
            for s in sizes
        ),
        ")",
    ]


def _rate_unit(unit: str) -> str:
    return "1/s" if unit == "-" else f"{unit}/s"


def column(first: str, values: Mapping[str, str]) -> list[str]:
    """A table with a number for each mode."""
    return [first, *(f"    {value},  # {mode}" for mode, value in values.items()), ")"]


def rows(
    first: str, of: Mapping[str, Sequence[Any]], filler: int = -1, length: int = 0
) -> list[str]:
    """A table with a row for each mode, all of one length."""
    length = max(length, *map(len, of.values()))
    lines = []
    for mode, numbers in of.items():
        row = [*numbers, *[filler] * (length - len(numbers))]
        lines.append(f"    ({''.join(f'{i}, ' for i in row).strip()}),  # {mode}")
    return [first, *lines, ")"]


def table(name: str, values: Iterable[str]) -> list[str]:
    values = list(values)
    items = "".join(f"{string(v)}, " for v in values).strip()
    line = f"{name} = ({items})"
    if len(line) <= WIDTH:
        return [line]
    return [f"{name} = (", *(f"    {string(v)}," for v in values), ")"]
