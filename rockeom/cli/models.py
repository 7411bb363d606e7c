"""``rockeom models``: the structures there are, shipped ones and families."""

import argparse
import dataclasses
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from rockeom.cli.errors import UsageError, lists, numbers, words
from rockeom.cli.text.options import add_pairs
from rockeom.integrator.schema import GeneratedModule, in_space
from rockeom.modelling import named
from rockeom.modelling.declared import module_of
from rockeom.numbers.checks import InputTypeError
from rockeom.structures.base import Structure
from rockeom.structures.classes import SHIPPED
from rockeom.structures.impact_laws import Impulsive, default_law

DESCRIPTION = """\
List the structures, or explain one: its states, its parameters with units and meanings, and its
modes. A family takes arguments, such as a number of storeys, and some structures a
support; they are derived where they are used, once on a machine.
"""
EPILOG = """\
examples:
  rockeom models
  rockeom models flexible_structure
  rockeom models shear_frame storeys=3
  rockeom models flexible_structure support=winkler springs=4
"""

# The user's name of a parameter, where it is not the model's.
_NAME_IN_MODEL = {"half_height": "height"}


# Arguments by which a family is explained, where none are given.
_EXAMPLES: dict[str, dict[str, int | str]] = {"shear_frame": {"storeys": 2}}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", nargs="?", metavar="NAME", help="a structure; all if left out")
    add_details(parser)


def run(args: argparse.Namespace) -> int:
    if args.name is None:
        print(_list())
        return 0
    made = named.class_named(args.name)
    print(_explain(made, details(args.arguments) or _EXAMPLES.get(args.name, {})))
    return 0


def add_structure(parser: argparse.ArgumentParser) -> None:
    """Arguments of a command that makes one: its name, and --set for its parameters."""
    parser.add_argument("name", metavar="NAME", help="a structure, as listed by: rockeom models")
    add_pairs(
        parser,
        "--set",
        "NAME=VALUE",
        "parameters of the structure; a list as masses=20e3,20e3; its support as "
        "support=winkler springs=4 foundation_stiffness=1e8 foundation_damping=1e5",
    )


def add_details(parser: argparse.ArgumentParser) -> None:
    """The arguments of a family, and what it stands on."""
    parser.add_argument(
        "arguments",
        nargs="*",
        metavar="NAME=VALUE",
        help="what it is derived for: storeys=3 of shear_frame; support=two_springs, "
        "support=winkler springs=4, support=sliding of those that take a support",
    )


def details(pairs: list[str]) -> dict[str, int | str]:
    """Arguments such as "storeys=3" and "support=winkler"."""
    arguments = words(pairs, "", "storeys=3")
    return {name: int(text) if text.isdecimal() else text for name, text in arguments.items()}


def made(args: argparse.Namespace, **others: Any) -> Structure:
    """The structure of the arguments of `add_structure`; others : values in place of theirs."""
    of, example = named.class_named(args.name), "mass=122.6"
    values: dict[str, Any] = {}
    for name, text in words(args.set, "--set", example).items():
        said = f"--set {name}={text}"
        if name in of.of_each:
            values[name] = lists(text, said, "--set", f"{name}=20e3,20e3")
        elif name in ("support", "guided", "law") and named.takes_support(of):
            values[name] = text
        else:
            values |= numbers([f"{name}={text}"], "--set", example)
    values |= others
    try:
        if dimensions_of(of, values):
            return _of_dimensions(of, values)
        return named.structure(args.name, **values)
    except InputTypeError as error:
        raise UsageError(
            f"{error}. Write --set NAME=VALUE ...; rockeom models {args.name} explains them"
        ) from None


_MOST_MODES = 64
"""Modes that are listed."""
_FULL = frozenset({"width", "height", "centroid_height", "offset"})
"""Full dimensions of a block, by which it may be given as well."""


def dimensions_of(of: Any, names: Iterable[str]) -> set[str]:
    """The names among some that are full dimensions of a block."""
    return _FULL & {*names} - of.defaults().keys() if hasattr(of, "from_dimensions") else set()


def _of_dimensions(of: Any, values: dict[str, Any]) -> Structure:
    missing = [name for name in ("width", "height") if name not in values]
    if missing:
        raise UsageError(
            f"--set has no {' and no '.join(missing)}: write --set width=0.6 height=2.0, the full "
            "dimensions [m], or half_width and half_height"
        )
    return of.from_dimensions(**values)


def _list() -> str:
    rows = [("NAME", "TITLE")]
    rows += [(name, _title(_module(of, {}))) for name, of in SHIPPED.items()]
    notes = []
    for name, of in named.FAMILIES.items():
        arguments = " ".join(f"{n}=N" for n in _EXAMPLES[name])
        rows.append((name, (of.__doc__ or "").partition(",")[0]))
        notes.append(f"  {name} takes {arguments}, and is derived for each")
    rows += [
        (n, (named.class_named(n).__doc__ or "").partition(",")[0].partition(".")[0])
        for n in named.IN_SPACE
    ]
    notes.append(f"  {', '.join(named.IN_SPACE)} move in space, under all three components")
    standing = [n for n, s in {**SHIPPED, **named.FAMILIES}.items() if named.takes_support(s)]
    notes += [f"  {', '.join(standing)} take a support:"]
    notes += [f"    {line}" for line in _aligned(_supports())]
    return "\n".join(
        [
            *_aligned(rows),
            "",
            *notes,
            "",
            "rockeom models NAME explains one: its states, parameters and modes.",
        ]
    )


def _supports() -> list[tuple[str, str]]:
    """Each support and its parameters, those in brackets that may be left out."""
    supports = []
    for support in named.SUPPORTS:
        names = [
            f"{name}=" if default is dataclasses.MISSING else f"[{name}={default}]"
            for name, default in named.parameters_of(support).items()
        ]
        supports.append((f"support={support}", " ".join(names) or "(if not given)"))
    return supports


def _explain(of: type[Structure], arguments: Mapping[str, int | str]) -> str:
    module = _module(of, arguments)
    half = len(module.STATES) // 2
    units = zip(module.STATES[:half], module.STATE_UNITS, strict=False)
    modes = [*module.MODES]
    if len(modes) > _MOST_MODES:  # of feet in space, each in one of several ways
        modes[4:] = [f"... {len(modes)} in all"]
    facts = [
        ("in Python", f"rockeom.{of.__name__}(...)"),
        ("coordinates", ", ".join(f"{name} [{unit}]" for name, unit in units)),
        ("states", ", ".join(module.STATES)),
        ("modes", ", ".join(modes)),
        ("impact laws", _laws(module)),
        ("equations", _where_derived(of.model, arguments)),
    ]
    return "\n".join(
        [
            _title(module),
            "",
            *_aligned(facts),
            "",
            *_aligned(_documented(of) if in_space(module) else _parameters(of, module)),
            *_by_dimensions(of),
            *_of_support(of, module, arguments),
        ]
    )


def _where_derived(name: str, arguments: Mapping[str, int | str]) -> str:
    """The command that shows the equations, and the page that has them with a drawing."""
    command = " ".join(["rockeom derive", name, *(f"{k}={v}" for k, v in arguments.items())])
    page = f"; with a drawing in generated/{name}.md" if name in SHIPPED and not arguments else ""
    return command + page


def _by_dimensions(of: type[Structure]) -> list[str]:
    """The other way to give a block, where there is one."""
    if not hasattr(of, "from_dimensions"):
        return []
    return [
        "",
        "Or by full dimensions [m] in place of half_width and half_height:",
        "  width= height= [centroid_height= above it] [offset= of the centroid, to the right]",
    ]


def _of_support(
    of: type[Structure], module: GeneratedModule, arguments: Mapping[str, int | str]
) -> list[str]:
    """Supports of a structure, and the parameters of each."""
    if not named.takes_support(of):
        return []
    support = str(arguments.get("support", "pinned"))
    words = _words(module)
    rows = [(name, *words[name]) for name in named.parameters_of(support) if name in words]
    own = ["", *_aligned([("OF ITS SUPPORT", "UNIT", "MEANING"), *rows])] if rows else []
    return [*own, "", "It may stand on", *(f"  {line}" for line in _aligned(_supports()))]


def _parameters(of: type[Structure], module: GeneratedModule) -> list[tuple[str, str, str, str]]:
    """A table of the names that --set takes."""
    meanings = _words(module)
    rows = [("PARAMETER", "UNIT", "IF NOT SET", "MEANING")]
    for name, default_value in of.defaults().items():
        called = name if name in meanings else _NAME_IN_MODEL.get(name)
        if name in of.of_each:
            called = f"{of.of_each[name]}_1"
        if called is None:  # no number, such as what the base stands on
            continue
        unit, meaning = meanings[called]
        if name in of.of_each:
            meaning = f"{meaning}, 2, ...: a list"
        default = "required" if default_value is dataclasses.MISSING else str(default_value)
        if default_value is None:
            default = "zero" if name in of.of_each else "as a homogeneous block"
        rows.append((name, unit, default, meaning))
    return rows


def _documented(of: type[Structure]) -> list[tuple[str, str, str, str]]:
    """The same of a class in space, whose docstring says what it makes the parameters of."""
    from docstring_parser.numpydoc import parse  # slow to import

    rows = [("PARAMETER", "UNIT", "IF NOT SET", "MEANING")]
    for item in parse(of.__doc__ or "").params:
        said, default = " ".join((item.description or "").split()), of.defaults()[item.arg_name]
        unit = re.search(r" \[(.+?)\]", said)
        shown = "required" if default is dataclasses.MISSING else str(default)
        unit_shown, meaning = (unit[1], said.replace(unit[0], "")) if unit else ("-", said)
        rows.append((item.arg_name, unit_shown, "as said" if default is None else shown, meaning))
    return rows


def _words(module: GeneratedModule) -> dict[str, tuple[str, str]]:
    """Unit and meaning of each parameter."""
    words = zip(module.PARAMETER_UNITS, module.PARAMETER_MEANINGS, strict=True)
    return dict(zip(module.PARAMETERS, words, strict=True))


def _laws(module: GeneratedModule) -> str:
    if getattr(module, "POINTS", ()):
        return "none: each point has its restitution, and its friction if it may slip"
    if not any(kind == "impact" for _, _, kind in module.TRANSITIONS):
        return "none: the contacts are springs"
    laws = "angular-momentum, energy-ratio=R, velocity-ratio=E"
    laws += ", impulsive" * module.HAS_IMPULSIVE
    default = "impulsive" if isinstance(default_law(module), Impulsive) else "angular-momentum"
    return f"{laws}; if not given, {default}"


def _module(of: type[Structure], arguments: Mapping[str, int | str]) -> GeneratedModule:
    if arguments.get("support") == "pinned":  # as if not given
        arguments = {name: value for name, value in arguments.items() if name != "support"}
    return module_of(of.model, **arguments)


def _title(module: GeneratedModule) -> str:
    return (module.__doc__ or "").partition("\n")[0].rstrip(".")


def _aligned(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Rows as lines of aligned columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
