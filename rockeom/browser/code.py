"""The case of a page as Python that a reader may run: each value of a control is a place {k}."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from rockeom.browser.controls import Controls, Menu
from rockeom.browser.traced import SIGNS, Node, Tape, Traced, node_of
from rockeom.motion import GroundMotion, MotionError
from rockeom.motion.formula import formula_of
from rockeom.simulation.case import Case
from rockeom.structures.declared import DeclaredStructure
from rockeom.sweeps.case_numbers import FACTORS, OtherCase

_HEAD = "import numpy as np\nimport rockeom as rk\n\n"
_TAIL = (
    '\nrun = rk.simulate({call}, options=rk.SolverOptions(method="DOP853"))\nprint(run.summary())\n'
)


def script(case: Callable[..., Case], controls: Controls) -> str:
    """Python that simulates the case at some values, where {k} is that of control k.

    A record, and a function without a source, are named in a comment: the reader has them.
    """
    if isinstance(case, OtherCase):
        return _of_case(case, controls)
    return _of_function(case, controls)


def _of_function(case: Callable[..., Case], controls: Controls) -> str:
    try:
        source = inspect.cleandoc(inspect.getsource(case))
    except (OSError, TypeError):
        source = ""
    name = getattr(case, "__name__", "case")
    if not source.startswith("def "):
        source, name = "function = ...  # that of the page", "function"
    given = [
        f"{n}={_chosen(control, k) if isinstance(control, Menu) else f'{{{k}}}'}"
        for k, (n, control) in enumerate(controls.of.items())
    ]
    made = f"case = {name}({', '.join(given)})\n"
    parts = ("impact", "initial", "duration", "vertical", "mode")
    rest = "".join(f", {part}=case.{part}" for part in parts)
    called = _TAIL.format(call=f"case.structure, case.motion{rest}")
    return f"{_HEAD}{source}\n{made}{called}"


def _of_case(other: OtherCase, controls: Controls) -> str:
    place = {name: k for k, name in enumerate(controls.of)}
    given = controls.traced(Tape(), controls.start)
    factors = {name: number.path[0] for name, number in other.numbers.items() if _is_factor(number)}
    for name in factors:
        given[name] = controls.start[place[name]]
    case = other(**given)
    parts = {}
    for name in (f.name for f in fields(Case)):
        value = getattr(other.case if name in ("motion", "vertical") and factors else case, name)
        control = controls.of.get(name)
        if isinstance(control, Menu):
            parts[name] = _chosen(control, place[name])
        elif value is not None:
            parts[name] = code_of(value)
    for name, factor in factors.items():
        for motion in ("motion", "vertical"):
            if motion in parts and other.numbers[name].part in ("case", motion):
                parts[motion] += (
                    f".scaled({factor}={{{place[name]}}})"
                    if factor in FACTORS
                    else (f".scaled_to(pga={{{place[name]}}})")
                )
    lines = [f"structure = {parts.pop('structure')}", f"motion = {parts.pop('motion')}"]
    rest = "".join(f", {name}={text}" for name, text in parts.items())
    return _HEAD + "\n".join(lines) + "\n" + _TAIL.format(call=f"structure, motion{rest}")


def _is_factor(number: Any) -> bool:
    return number.path[0] in (*FACTORS, "pga")


def _chosen(menu: Menu, place: int) -> str:
    """The option of a menu whose label is in place."""
    options = ", ".join(f"{label!r}: {code_of(x)}" for label, x in menu.options.items())
    return f"{{{options}}}[{{{place}}}]"


def code_of(x: Any) -> str:
    """A part of a case as Python."""
    if _is_traced(x):
        return _number(node_of(x))
    if isinstance(x, GroundMotion):
        return _motion(x)
    if isinstance(x, DeclaredStructure) or (is_dataclass(x) and not isinstance(x, type)):
        return f"rk.{type(x).__name__}({_arguments(x)})"
    if isinstance(x, Mapping):
        return f"{{{', '.join(f'{k!r}: {code_of(v)}' for k, v in x.items())}}}"
    if isinstance(x, tuple | list):
        return f"[{', '.join(map(code_of, x))}]"
    return repr(x)


def _arguments(x: Any) -> str:
    of = () if isinstance(x, DeclaredStructure) else fields(x)
    defaults = {f.name: f.default for f in of if f.default is not MISSING}
    given = {f.name: getattr(x, f.name) for f in of if f.init} or x.parameters()
    return ", ".join(
        f"{name}={code_of(value)}"
        for name, value in given.items()
        if _is_traced(value) or name not in defaults or value != defaults[name]
    )


def _is_traced(x: Any) -> bool:
    return isinstance(x, Traced)


def _motion(motion: GroundMotion) -> str:
    formula = formula_of(motion)
    if formula is None:
        return _record(motion)
    given = ", ".join(
        f"{name}={code_of(x)}" for name, x in formula.arguments.items() if x is not None
    )
    return f"rk.GroundMotion.{formula.make.__name__}({given})"


def _record(motion: GroundMotion) -> str:
    """A record by its name in the library, if it has one; the file of another is the reader's."""
    with suppress(MotionError, ImportError):
        if GroundMotion.from_library(motion.name) == motion:
            return f"rk.GroundMotion.from_library({motion.name!r})"
    return f"rk.GroundMotion.read({motion.name!r})"


def _number(node: Any) -> str:
    if not isinstance(node, Node):
        return repr(node)
    if node.operation == "slider":
        return f"{{{node.of[0]}}}"
    a, *rest = map(_number, node.of)
    if node.operation in SIGNS:
        return f"({a} {SIGNS[node.operation]} {rest[0]})"
    return f"-{a}" if node.operation == "neg" else f"np.{node.operation}({', '.join([a, *rest])})"
