"""``rockeom models``: the shipped structures."""

from __future__ import annotations

import argparse
import dataclasses
import importlib
from collections.abc import Sequence
from types import ModuleType

from rockeom.arguments import near
from rockeom.cli.errors import UsageError
from rockeom.numeric.structures import SHIPPED, Structure

HELP = "list the structures, or explain one of them"
DESCRIPTION = """\
List the shipped structures, or explain one: its states, its parameters with units and
meanings, and its contact phases.
"""
EPILOG = """\
examples:
  rockeom models
  rockeom models flexible_structure
"""

# The user's name of a parameter, where it is not the model's.
_NAME_IN_MODEL = {"half_height": "height"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", nargs="?", metavar="NAME", help="a structure; all if left out")


def run(args: argparse.Namespace) -> int:
    if args.name is None:
        print(_list())
    else:
        print(_explain(shipped(args.name)))
    return 0


def add_structure(parser: argparse.ArgumentParser) -> None:
    """Arguments of a command that makes one: its name, and --set for its parameters."""
    parser.add_argument("name", metavar="NAME", help="a structure, as listed by: rockeom models")
    parser.add_argument(
        "--set",
        nargs="+",
        action="extend",
        default=[],
        metavar="NAME=VALUE",
        help="parameters of the structure",
    )


def shipped(name: str) -> type[Structure]:
    """The class of a shipped structure; raises UsageError naming all of them if it is unknown."""
    if name not in SHIPPED:
        raise UsageError(
            f"no structure named {name!r}{near(name, SHIPPED)}; there are {', '.join(SHIPPED)}"
        )
    return SHIPPED[name]


def _list() -> str:
    rows = [("NAME", "STATES", "TITLE")]
    for name, structure in SHIPPED.items():
        module = _module(structure)
        rows.append((name, ", ".join(module.STATES), _title(module)))
    return "\n".join([*_aligned(rows), "", "rockeom models NAME explains one of them."])


def _explain(structure: type[Structure]) -> str:
    module = _module(structure)
    half = len(module.STATES) // 2
    units = zip(module.STATES[:half], module.STATE_UNITS, strict=False)
    laws = "angular-momentum (if not given), energy-ratio=R, velocity-ratio=E"
    if module.HAS_IMPULSIVE:
        laws += ", impulsive"
    facts = [
        ("in Python", f"rockeom.{structure.__name__}(...)"),
        ("coordinates", ", ".join(f"{name} [{unit}]" for name, unit in units)),
        ("states", ", ".join(module.STATES)),
        ("contact phases", ", ".join(module.CONTACTS)),
        ("impact laws", laws if _has_impacts(module) else _without_a_law(module)),
    ]
    return "\n".join(
        [_title(module), "", *_aligned(facts), "", *_aligned(_parameters(structure, module))]
    )


def _parameters(structure: type[Structure], module: ModuleType) -> list[tuple[str, str, str, str]]:
    """A table of the names that --set takes."""
    words = zip(module.PARAMETER_UNITS, module.PARAMETER_MEANINGS, strict=True)
    known = dict(zip(module.PARAMETERS, words, strict=True))
    rows = [("PARAMETER", "UNIT", "IF NOT SET", "MEANING")]
    for name, given in structure.defaults().items():
        called = name if name in known else _NAME_IN_MODEL.get(name)
        if called is None:  # no number, such as what the base stands on
            continue
        unit, meaning = known[called]
        default = "required" if given is dataclasses.MISSING else str(given)
        if given is None:
            default = "as a homogeneous block"
        rows.append((name, unit, default, meaning))
    return rows


def _has_impacts(module: ModuleType) -> bool:
    return any(kind == "impact" for _, _, kind in module.TRANSITIONS)


def _without_a_law(module: ModuleType) -> str:
    if getattr(module, "POINTS", ()):
        return "none: each point has its restitution, and its friction if it may slip"
    return "none: the contacts are springs"


def _module(structure: type[Structure]) -> ModuleType:
    return importlib.import_module(f"rockeom.generated.{structure.model}")


def _title(module: ModuleType) -> str:
    return (module.__doc__ or "").partition("\n")[0].rstrip(".")


def _aligned(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Rows as lines of aligned columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
