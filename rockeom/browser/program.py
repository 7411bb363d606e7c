"""The program of a structure and a method that has the same bits in every browser.

Its operations are rounded one by one, and its elementary functions are those of `elementary`. From
one text of LLVM come a WebAssembly module and machine code of this processor, which is what a page
is compared with.
"""

import json
import re
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

from rockeom.browser.webassembly import Module, module
from rockeom.compiler.machine import Function, Loaded, compiled
from rockeom.compiler.modules import Text, module_text
from rockeom.compiler.printer import Program as Printed
from rockeom.compiler.types import FLOAT, LIBRARY, Entry
from rockeom.integrator.linking import LOOP
from rockeom.integrator.printing import printed, sizes_of
from rockeom.integrator.program import Program
from rockeom.integrator.schema import GeneratedModule

METHOD = "DOP853"
"""The method by which pages integrate."""
_ELEMENTARY = "rockeom.browser.elementary"
_WRITTEN = "rockeom.browser.written"
"""Declares the names that are different ones in each page."""
_LLVM = re.compile(rf"@(?:llvm\.)?({'|'.join(sorted(LIBRARY))})(?:\.f64)?\(")
"""Calls of elementary functions, as the printer writes them."""
_ARGUMENTS = {"pow": 2}


class Portable(NamedTuple):
    """A program: its text of LLVM, its functions that may be called, sizes of scratch arrays."""

    ir: str
    entries: dict[str, Entry]
    sizes: dict[str, int]

    def native(self, generated: GeneratedModule) -> Program:
        """The program of this processor, to be run as others are."""
        described = json.dumps({"entries": self.entries, "sizes": self.sizes}).encode()
        return Program(
            f"{generated.NAME}_portable",
            generated,
            described + b"\n" + compiled(self.ir, passes=()),
        )

    def webassembly(self) -> Module:
        """The same as a WebAssembly module."""
        return module(self.ir, self.entries)


@cache
def portable(
    generated: GeneratedModule,
    method: str,
    questions: tuple[str, ...] = (),
    written: tuple[Text, ...] = (),
) -> Portable:
    """The program of a generated module and a method.

    questions : modules that are printed with it. written : what they ask for of a page.
    """
    more = map(module_text, (_ELEMENTARY, *questions))
    made = printed(generated, method, LOOP, contract=False, more=more, provided={_WRITTEN: written})
    return Portable(_own_functions(made), made.entries, sizes_of(made))


def functions(texts: Sequence[Text]) -> dict[str, Function]:
    """The entries of texts of their own as machine code, by name."""
    made = Printed((module_text(_ELEMENTARY), *texts), contract=False)
    return Loaded(compiled(_own_functions(made), passes=()), made.entries).functions


def _own_functions(printed: Printed) -> str:
    """The text of a program in which calls of elementary functions are of those printed with it."""
    called = _LLVM.findall("".join(f"@{name}(" for name in printed.declared))
    symbols = {name: _symbol(printed, f"own_{name}") for name in sorted(called)}
    ir = "\n".join(
        line
        for line in printed.ir().splitlines()
        if not (line.startswith("declare") and _LLVM.search(line))
    )
    return _LLVM.sub(lambda call: f"@{symbols[call[1]]}(", ir)


def _symbol(printed: Printed, name: str) -> str:
    """The symbol of a function of floats, which is printed if it is not yet."""
    definition = printed.definitions[module_text(_ELEMENTARY).name, name]
    types = (FLOAT,) * _ARGUMENTS.get(name.removeprefix("own_"), 1)
    return printed.function(definition, types, None, definition)[0]
