"""Texts of programs as machine code and as plain Python, by name."""

import ast
from collections.abc import Callable, Iterable
from types import ModuleType
from typing import Any

from rockeom.compiler.machine import Loaded, compiled
from rockeom.compiler.modules import Modules, Text, as_python, module_text, parsed
from rockeom.compiler.printer import Program
from rockeom.integrator.linking import LOOP, Linked, linked
from rockeom.integrator.schema import PROVIDED

HEAD = """
import math
import numpy as np
from rockeom.compiler.decorators import *
"""
"""What a text needs that stands alone."""
RULES = ("rockeom.numbers.derivatives", "rockeom.integrator.tangents.derivatives")
ALONE = Linked((), Modules({PROVIDED: ()}), frozenset())


def functions(
    text: str,
    of: ModuleType | None = None,
    method: str = "DOP853",
    contract: bool = True,
    bounds: bool = False,
    more: Iterable[str] = (),
) -> dict[str, Callable[..., Any]]:
    """The entries of a text, which may call all that the program of a generated module has.

    Of that program only what the text calls is made, or all of it where the text is empty.
    more : modules that are part of the program, too.
    """
    roots, modules, _ = ALONE if of is None else linked(of, method)
    rules = [*map(module_text, more)]
    texts = modules.closure([*roots, *rules])
    own = Text("the test's text", importing(text, texts) + text, fused=True)
    needed = modules.closure([*rules, own]) if text else texts
    printed = Program(needed, modules, contract, bounds=bounds)
    return Loaded(compiled(printed.ir()), printed.entries, bounds=bounds).functions


def importing(text: str, texts: Iterable[Text], written: str = PROVIDED) -> str:
    """Statements that import all that a text uses of other texts.

    written : the module that stands for texts which are those of no module.
    """
    used = {node.id for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}
    lines = ""
    for other in texts:
        parts = parsed(other.source, other.name)
        path = other.name.removesuffix(".py").replace("/", ".")
        module = f"rockeom.{path}" if other.alone else written
        for name in sorted(used & (parts.functions.keys() | parts.constants.keys())):
            lines += f"from {module} import {name}\n"
    return lines


def plain(module: ModuleType, method: str, part: str = LOOP) -> dict[str, Any]:
    """All functions and constants of a part of a program, as Python has them."""
    roots, modules, _ = linked(module, method, part)
    return as_python(modules.closure(roots), {"__name__": "plain"})


def plain_texts(*modules: str, **provided: Any) -> dict[str, Any]:
    """Functions and constants of modules of the integrator, for what is provided."""
    texts = ALONE.modules.closure(module_text(f"rockeom.integrator.{name}") for name in modules)
    ground = {"AXES": 2, "DIRECTIONS": 2, "STILL": (0.0, 0.0)}
    return as_python(texts, {"__name__": "plain", **ground, **provided})
