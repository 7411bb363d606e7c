"""Functions of a text as machine code, by name."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

from rockeom.compiler.machine import Loaded, compiled
from rockeom.compiler.parsed import Text
from rockeom.compiler.printer import Program
from rockeom.integrator.program import texts
from rockeom.integrator.texts import text_of

HEAD = """
import math
import numpy as np
from rockeom.compiler.decorators import *
"""
"""What a text needs that stands alone."""
PRELUDE = Text("generated/prelude.py", text_of("generated/prelude.py"))


def functions(
    text: str,
    of: ModuleType | None = None,
    method: str = "DOP853",
    contract: bool = True,
    bounds: bool = False,
) -> dict[str, Callable[..., Any]]:
    """The entries of a text, which may call all that the program of a generated module has."""
    parts = [PRELUDE] if of is None else texts(of, method)
    printed = Program([*parts, Text("the test's text", text, fused=True)], contract, bounds=bounds)
    return Loaded(compiled(printed.ir()), printed.entries, bounds=bounds).functions
