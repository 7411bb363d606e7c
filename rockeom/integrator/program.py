"""A structure and a method as one program of machine code.

The generated module, the text of a step and the loop are joined, printed for LLVM and compiled; the
machine code is kept on disk under the hash of all that it follows from. So a changed structure,
method, loop or processor has another program, and what was compiled for an old text is never used
for a new one.
"""

from __future__ import annotations

import gc
import json
import math
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from rockeom.codes import NEWTON
from rockeom.compiler.cache import kept
from rockeom.compiler.locks import lock_held_by_forks
from rockeom.compiler.machine import Function, Loaded, compiled, target
from rockeom.compiler.modules import Modules, Text, module_text, without
from rockeom.compiler.types import NOTHING, Array, Entry
from rockeom.integrator.schema import (
    PRELUDE,
    PROVIDED,
    GeneratedModule,
    angles,
    has_points,
    impact_law,
)
from rockeom.integrator.texts import digest, source

if TYPE_CHECKING:
    from rockeom.compiler.printer import Program as Printed

_HERE = "rockeom.integrator"
_SIZES = ("SCRATCH", "Z_SIZE", "W_SIZE")


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
        codes.append(_shared(shared, lambda: printed(generated, method, LOOP, bounds).halves()[1]))
    return Program("_".join(keys[-1]), generated, *codes, bounds=bounds)


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


LOOP, VECTORS, GLUE, TANGENTS = "loop", "vectors", "lanes", "derivatives"
"""The parts of a program, each compiled and kept by itself: a sweep in lanes finds the loop there
that a single motion has been run by. Vectors are the work on all lanes at once, and the third is
what it is called by. Derivatives are the texts of the loop once more, printed for duals."""
_ENTRIES = {
    LOOP: ("loop", "batches"), VECTORS: (), GLUE: ("lanes.loop",), TANGENTS: ("variational",),
}  # fmt: skip
"""The modules of a part whose entries Python calls; those of vectors are in a text of its own."""
_DECLARED, _SEARCHED = ("table",), ("search", "landings")
"""The modules that say which mode follows an event."""
_OF_TANGENTS = "rockeom.numbers.derivatives", f"{_HERE}.derivatives", f"{_HERE}.batches"
"""Modules by which numbers carry derivatives along, and the loop: its calls of a function count
where it is decided whether that is written out."""

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
    for package in ("rockeom.compiler", f"{_HERE}.methods"):
        names = sorted(file.name for file in files(package).iterdir() if file.is_file())
        stems = [name.removesuffix(".py") for name in names if name.endswith(".py")]
        sources += [module_text(f"{package}.{stem}").source for stem in stems]
    return tuple(sources)


def _made(generated: GeneratedModule, method: str, part: str, bounds: bool = False) -> bytes:
    """A line that describes a part of a program, and its machine code."""
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


def sizes_of(made: Printed) -> dict[str, int]:
    """The sizes of the scratch arrays of a program, by name."""
    return {name: int(made.names[name]) for name in _SIZES if name in made.names}


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


def printed(
    generated: GeneratedModule,
    method: str,
    part: str,
    bounds: bool = False,
    contract: bool = True,
    more: Iterable[Text] = (),
    provided: Mapping[str, tuple[Text, ...]] = MappingProxyType({}),
) -> Printed:
    """A part of a program as LLVM is given it; contract as in `Printed`.

    more : texts with entries of their own. provided : of modules that they import, see `Modules`.
    """
    # only where something is compiled; so are the texts of methods and lanes below
    from rockeom.compiler.printer import GROWTH, Program as Printed

    # a loop over lanes becomes one of vectors only where it calls nothing
    few = has_points(generated) or not contract  # they have many modes; a page is a small file
    growth = 0.1 * GROWTH if few else GROWTH
    growth = math.inf if part == VECTORS else growth
    roots, modules, own = linked(generated, method, part)
    modules = replace(modules, provided={**modules.provided, **provided})
    with _nothing_collected():
        return Printed(
            [*roots, *more], modules, contract=contract, growth=growth, bounds=bounds, own=own
        )


@contextmanager
def _nothing_collected() -> Iterator[None]:
    """Without Python's search for what is no longer used: trees are large, and all of them are."""
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


class Linked(NamedTuple):
    """The texts whose entries a part of a program has, and the modules that they import.

    own : names of the texts that belong to the structure and the method.
    """

    roots: tuple[Text, ...]
    modules: Modules
    own: frozenset[str]


def linked(generated: GeneratedModule, method: str, part: str = LOOP, steps: bool = True) -> Linked:
    """A part of a program, which calls the entries of other parts.

    steps : with the text of the method's step, which only a compiler needs.
    """
    entries = [f"{_HERE}.{name}" for name in _ENTRIES[part]]

    def read(module: str) -> Text:
        text = module_text(module)
        # lanes do not have the loop's last digits in any case
        return replace(text, fused=text.fused or part == VECTORS, elsewhere=module not in entries)

    step = _step(generated, method, part, read) if steps else ()
    own = (Text(f"{generated.NAME}.py", source(generated), fused=part == VECTORS), *step)
    prelude = _prelude_of_lanes(read(PRELUDE)) if part == VECTORS and steps else (read(PRELUDE),)
    provided = {PROVIDED: (*own, *_transitions(generated, read)), PRELUDE: prelude}
    roots = [*step[-1:]] if part == VECTORS else []
    roots += map(read, [*entries, *(_OF_TANGENTS if part == TANGENTS else ())])
    names = frozenset(text.name for text in (*prelude, *own))
    return Linked(tuple(roots), Modules(provided, read), names)


def _prelude_of_lanes(prelude: Text) -> tuple[Text, Text]:
    """The prelude of generated modules with a sine and a cosine that have no branches."""
    from rockeom.integrator.lanes.step import SINES

    return without(prelude, "sine_cosine"), Text("sines of lanes", SINES, fused=True)


def _transitions(generated: GeneratedModule, read: Callable[[str], Text]) -> list[Text]:
    """How the modes of a structure follow one another, and what the texts of that ask of it."""
    bounces = getattr(generated, "N_POINTS", 0) > 0  # and does not move through elements alone
    which = [read(f"{_HERE}.transitions.{n}") for n in (_SEARCHED if bounces else _DECLARED)]
    if not has_points(generated):
        return [Text("what follows from a structure", "N_POINTS = CONTACT_SIZE = 0\n"), *which]
    facts = f"from {_HERE}.transitions.points import CONTACT_SIZE\nANGLES = {angles(generated)!r}\n"
    law = "newton" if impact_law(generated) == NEWTON else "impacts"
    which.append(read(f"{_HERE}.transitions.{law}"))
    return [Text("what follows from a structure", facts), *which]


def _step(
    generated: GeneratedModule, method: str, part: str, read: Callable[[str], Text]
) -> tuple[Text, ...]:
    """The step of a method, and that of lanes."""
    from rockeom.integrator.methods.tableau import step_text, tableau

    n = generated.N_STATES // 2
    if method == "Radau":
        from rockeom.integrator.methods.radau import constants_text

        constants = Text("the constants of Radau", constants_text(n))
        return constants, read(f"{_HERE}.methods.radau_step")
    quick = getattr(generated, "QUICK", ())
    step = step_text(tableau(method), n, generated.ROTATION, quick)
    texts = [Text(f"the step of {method}", step, fused=True)]
    if part in (VECTORS, GLUE):
        from rockeom.integrator.lanes.step import lanes_text, numbers_text

        texts.append(Text("the numbers of lanes", numbers_text(tableau(method), generated)))
        step = lanes_text(tableau(method), generated)
        texts.append(Text(VECTORS, step, fused=True, elsewhere=part != VECTORS))
    return tuple(texts)
