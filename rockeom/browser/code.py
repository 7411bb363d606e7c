"""The case of a page as Python that a reader may run: each value of a control is a place {k}."""

import inspect
import re
import textwrap
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from typing import Any

from rockeom.browser.controls import Controls, Menu, Slider
from rockeom.browser.program import METHOD
from rockeom.browser.traced import SIGNS, Node, Tape, Traced, node_of
from rockeom.motion import GroundMotion
from rockeom.motion.formula import formula_of
from rockeom.numbers.checks import InputError
from rockeom.simulation.case import Case
from rockeom.structures.declared import DeclaredStructure
from rockeom.sweeps.case_numbers import OtherCase

_DATE = re.compile(r"\d+/\d+/")
"""The month and the day of a record, which its name in the library has not."""
_DRAWN = "shape"
"""The argument that only pictures take, thousands of numbers of a mesh."""
_HEAD = "import numpy as np\nimport rockeom as rk\n\n"
_TAIL = f"""
run = rk.simulate({{call}}, options=rk.SolverOptions(method="{METHOD}"))
print(run.summary())
"""


def script(case: Callable[..., Case], controls: Controls) -> str:
    """Python that simulates the case at some values, where {k} is that of control k.

    A record, and a function without a source, are named in a comment: the reader has them.
    """
    if isinstance(case, OtherCase):
        return _of_case(case, controls)
    return _of_function(case, controls)


def _of_function(case: Callable[..., Case], controls: Controls) -> str:
    try:
        source = textwrap.dedent(inspect.getsource(case))
    except (OSError, TypeError):
        source = ""
    name = getattr(case, "__name__", "case")
    if not source.startswith("def ") or case.__code__.co_freevars:  # it would not run elsewhere
        source, name = "function = ...  # that of the page", "function"
    arguments = [f"{n}={_chosen(control, k)}" for k, (n, control) in enumerate(controls.of.items())]
    made = f"case = {name}({', '.join(arguments)})\n"
    parts = ("impact", "initial", "duration", "vertical", "mode", "transverse", "azimuth")
    rest = "".join(f", {part}=case.{part}" for part in parts)
    called = _TAIL.format(call=f"case.structure, case.motion{rest}")
    return f"{_HEAD}{source}\n{made}{called}"


def _of_case(other: OtherCase, controls: Controls) -> str:
    place = {name: k for k, name in enumerate(controls.of)}
    factors = {name: n.path[0] for name, n in other.numbers.items() if _is_factor(n)}
    unscaled = OtherCase(other.case, tuple(name for name in other.names if name not in factors))
    arguments = controls.traced(Tape(), controls.start)
    arguments = {name: x for name, x in arguments.items() if name not in factors}
    parts = _parts(unscaled(**arguments))
    for name, control in controls.of.items():
        if isinstance(control, Menu):
            chosen = {label: _parts(unscaled(**{**arguments, name: x})).get(name, "None")
                      for label, x in control.options.items()}  # fmt: skip
            parts[name] = _choice(chosen, place[name])
    for name, factor in factors.items():
        call = f".{_SCALED[factor].format(f'{{{place[name]}}}')}"
        part = other.numbers[name].part
        for motion in ("motion", "vertical") if part == "case" else (part,):
            if motion in parts:
                parts[motion] += call
    lines = [f"structure = {parts.pop('structure')}", f"motion = {parts.pop('motion')}"]
    rest = "".join(f", {name}={text}" for name, text in parts.items())
    return _HEAD + "\n".join(lines) + "\n" + _TAIL.format(call=f"structure, motion{rest}")


_SCALED = {
    "scale": "scaled({})", "time_scale": "scaled(1.0, time={})", "pga": "scaled_to(pga={})",
}  # fmt: skip


def _is_factor(number: Any) -> bool:
    return number.path[0] in _SCALED


def _parts(case: Case) -> dict[str, str]:
    """The parts of a case that were given; pages have level ground."""
    parts = {field.name: getattr(case, field.name) for field in fields(Case)}
    del parts["slope"], parts["ground_axes"]
    return {name: code_of(x) for name, x in parts.items() if x is not None}


def _choice(options: Mapping[str, str], place: int) -> str:
    """The option of a menu whose label is in place."""
    return f"{{{', '.join(f'{label!r}: {x}' for label, x in options.items())}}}[{{{place}}}]"


def _chosen(control: Slider | Menu, place: int) -> str:
    if isinstance(control, Menu):
        return _choice({label: code_of(x) for label, x in control.options.items()}, place)
    return f"{{{place}}}"


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
    if isinstance(x, DeclaredStructure):
        defaults, values = type(x).defaults(), x.parameters()
    else:
        defaults = {f.name: f.default for f in fields(x)}
        values = {f.name: getattr(x, f.name) for f in fields(x) if f.init}
    return ", ".join(
        f"{name}={code_of(value)}"
        for name, value in values.items()
        if name != _DRAWN
        if _is_traced(value) or (value is not defaults.get(name) and value != defaults.get(name))
    )


def _is_traced(x: Any) -> bool:
    """Asked here, since to a type checker no motion and no float is one."""
    return isinstance(x, Traced)


def _motion(motion: GroundMotion) -> str:
    formula = formula_of(motion)
    if formula is None:
        return _record(motion)
    arguments = ", ".join(
        f"{name}={code_of(x)}" for name, x in formula.arguments.items() if x is not None
    )
    return f"rk.GroundMotion.{formula.make.__name__}({arguments})"


def _record(motion: GroundMotion) -> str:
    """A record by its name in the library, if it has one; the file of another is the reader's."""
    with suppress(InputError, ImportError):
        words = " ".join(re.findall(r"\w+", _DATE.sub("", motion.name)))
        if GroundMotion.from_library(words) == motion:
            return f"rk.GroundMotion.from_library({words!r})"
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
