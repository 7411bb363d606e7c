"""A structure and a method as one program of machine code.

The generated module, the text of a step and the loop are joined, printed for LLVM and compiled; the
machine code is kept on disk under the hash of all that it follows from. So a changed structure,
method, loop or processor has another program, and what was compiled for an old text is never used
for a new one.
"""

import json
import os
import sys
import time
from collections.abc import Callable
from functools import cache
from importlib.resources import files
from typing import Any

from rockeom.compiler.cache import kept
from rockeom.compiler.locks import lock_held_by_forks
from rockeom.compiler.machine import Function, Loaded, compiled, target
from rockeom.compiler.modules import Modules, module_text
from rockeom.compiler.types import NOTHING, Array, Entry
from rockeom.integrator.linking import (
    GLUE,
    INTEGRATOR,
    LOOP,
    TANGENTS,
    VECTORS,
    linked,
)
from rockeom.integrator.schema import PROVIDED, GeneratedModule
from rockeom.integrator.texts import digest


class Program:
    """The functions of a structure with a method in machine code, and the tables of its module.

    integrate, integrate_many, falls, at_rest, evaluate, and integrate_lanes in one with lanes, as
    in loop.py and lanes/loop.py; propagate_tangents, as in variational.py, in one for derivatives;
    the sizes of the arrays that they want as scratch; all else is that of the generated module.

    codes : of the loop, and of lanes, which call it. bounds : they check indices.
    """

    SCRATCH: int
    Z_SIZE: int
    W_SIZE: int

    integrate: Function
    integrate_many: Function
    integrate_lanes: Function
    falls: Function
    at_rest: Function
    evaluate: Function
    propagate_tangents: Function

    def __init__(
        self, name: str, module: GeneratedModule, *codes: bytes, bounds: bool = False
    ) -> None:
        entries: dict[str, Entry] = {}
        sizes: dict[str, int] = {}
        objects = []
        for code in codes:
            header, _, machine_code = code.partition(b"\n")
            described = json.loads(header)
            entries |= {n: Entry(*_of_lists(e)) for n, e in described["entries"].items()}
            sizes |= described["sizes"]
            objects.append(machine_code)
        self.name, self.module = name, module
        self.__dict__ |= sizes | Loaded(objects[0], entries, *objects[1:], bounds=bounds).functions

    def __getattr__(self, name: str) -> Any:
        if name == "module":  # not there yet
            raise AttributeError(name)
        return getattr(self.module, name)


def _of_lists(entry: list[Any]) -> tuple[Any, Any]:
    arguments, returns = entry
    return tuple((n, Array(*t) if isinstance(t, list) else t) for n, t in arguments), (
        returns if isinstance(returns, str) else NOTHING
    )


_LOCK = lock_held_by_forks()


def program(generated: GeneratedModule, method: str, lanes: bool = False) -> Program:
    """The program of a generated module and a method's name, compiled where it is not kept yet.

    lanes : with `integrate_lanes`, too.
    """
    with _LOCK:
        parts = (LOOP, VECTORS, GLUE) if lanes else (LOOP,)
        return _of_parts(generated, method, parts, checks_bounds())


def tangent_program(generated: GeneratedModule, method: str) -> Program:
    """The program that propagates derivatives along the motions of a generated module."""
    with _LOCK:
        return _of_parts(generated, method, (TANGENTS,), checks_bounds())


def checks_bounds() -> bool:
    """Whether programs check every index, by $ROCKEOM_CHECK_BOUNDS: slow, to find faults.

    A call in which an index leaves its array raises `machine.OutOfBoundsError` at its end, with
    file, line, index and size.
    """
    return os.environ.get("ROCKEOM_CHECK_BOUNDS", "0") not in ("", "0")


@cache
def _of_parts(
    generated: GeneratedModule, method: str, parts: tuple[str, ...], bounds: bool
) -> Program:
    keys = [_key(generated, method, part, bounds) for part in parts]
    codes = [
        kept(*key, lambda part=part: _made(generated, method, part, bounds))  # type: ignore[misc]
        for key, part in zip(keys, parts, strict=True)
    ]
    if (shared := json.loads(codes[0].partition(b"\n")[0]).get("shared")) is not None:
        codes.append(_shared(shared, lambda: _loop_in_common(generated, method, bounds)))
    return Program("_".join(keys[-1]), generated, *codes, bounds=bounds)


def _loop_in_common(generated: GeneratedModule, method: str, bounds: bool) -> str:
    from rockeom.integrator.printing import printed

    return printed(generated, method, LOOP, bounds).halves()[1]


_SHARED: dict[str, bytes] = {}


def _shared(digest: str, ir: Callable[[], str]) -> bytes:
    """The half of a loop that structures have in common, made and kept once for all of them.

    It is most of a loop, and follows from a few numbers: how many states there are, which modes
    follow which. All blocks have the same.
    """
    if digest not in _SHARED:
        made = json.dumps({"entries": {}, "sizes": {}}).encode() + b"\n"
        _SHARED[digest] = kept("loop", digest, lambda: made + compiled(ir(), False))
    return _SHARED[digest]


_SAID = {VECTORS: " in lanes", GLUE: " in lanes", TANGENTS: " for derivatives"}


def _key(
    generated: GeneratedModule, method: str, part: str, bounds: bool = False
) -> tuple[str, str]:
    """Name of a part of a program, and a hash of all that its code follows from."""
    ending = ("" if part == LOOP else f"_{part}") + ("_bounds" if bounds else "")
    sources = _sources(generated, method, part, bounds)
    return f"{generated.NAME}_{method.lower()}{ending}", digest(part, target(), *sources)


def revision(generated: GeneratedModule, method: str, lanes: bool = False) -> str:
    """A hash of all texts that a program follows from, the same for every processor."""
    part = GLUE if lanes else LOOP
    return digest(part, *_sources(generated, method, part, checks_bounds()))


def _sources(generated: GeneratedModule, method: str, part: str, bounds: bool) -> tuple[str, ...]:
    """The texts that a part is made of, and those that make machine code of them."""
    roots, modules, _ = linked(generated, method, part, steps=False)
    # the step, which is not written yet, may ask for all that is provided
    own = (text.source for text in modules.closure([*roots, *modules.provided[PROVIDED]]))
    return (part, method, *own, *_compiler(), *(["bounds"] if bounds else []))


@cache
def _compiler() -> tuple[str, ...]:
    """The sources of this module with all that it imports, of the language and of all methods."""
    sources = [text.source for text in Modules().closure([module_text(__name__)])]
    for package in ("rockeom.compiler", f"{INTEGRATOR}.methods"):
        names = sorted(file.name for file in files(package).iterdir() if file.is_file())
        stems = [name.removesuffix(".py") for name in names if name.endswith(".py")]
        sources += [module_text(f"{package}.{stem}").source for stem in stems]
    return tuple(sources)


def _made(generated: GeneratedModule, method: str, part: str, bounds: bool = False) -> bytes:
    """A line that describes a part of a program, and its machine code."""
    from rockeom.integrator.printing import printed, sizes_of

    started = time.monotonic()
    made = printed(generated, method, part, bounds)
    described: dict[str, Any] = {"entries": made.entries, "sizes": sizes_of(made)}
    if part == LOOP:
        own, rest = made.halves()
        described["shared"] = digest(rest, target(), module_text("rockeom.compiler.machine").source)
        _shared(described["shared"], lambda: rest)
        code = compiled(own, False)
    else:
        code = compiled(made.ir(), part == VECTORS)
    announce(f"compiled {generated.NAME} with {method}{_SAID.get(part, '')}", started)
    return json.dumps(described).encode() + b"\n" + code


def announce(done: str, started: float) -> None:
    """Tell on stderr of work that took more than a second, and that is stored for the next time.

    started : by time.monotonic().
    """
    took = time.monotonic() - started
    if took > 1.0:
        say(f"{done} in {took:.1f} s, once on this machine")


def say(line: str) -> None:
    """Write a line about work that a user waits for to stderr."""
    if sys.stderr is not None:  # None: a program without a console
        sys.stderr.write(f"rockeom: {line}\n")
        sys.stderr.flush()
