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
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

from rockeom.compiler.cache import kept
from rockeom.compiler.locks import lock_held_by_forks
from rockeom.compiler.machine import Function, Loaded, compiled, target
from rockeom.compiler.parsed import Text
from rockeom.compiler.types import NOTHING, Array, Entry
from rockeom.integrator.schema import (
    IMPACT_TEXTS,
    POINT_TEXTS,
    POINTS,
    GeneratedModule,
    angles,
    has_points,
    point_texts,
)
from rockeom.integrator.texts import digest, source, text_of

if TYPE_CHECKING:
    from rockeom.compiler.printer import Program as Printed

_LANES = "integrator/lanes/loop.py"
_OF_POINTS = ("integrator/transitions/landings.py", "integrator/transitions/zeno.py")
_TABLE, _SEARCH = "integrator/transitions/table.py", "integrator/transitions/search.py"
"""The two that say which mode follows an event: one is declared, or searched."""
_OF_STEPS = (
    "integrator/records.py", "integrator/recorder.py", "integrator/ground.py",
    "integrator/bernstein.py", "integrator/polynomials.py", "integrator/extremes.py",
    "integrator/overturning.py", "integrator/rounding.py", "integrator/guards.py",
    "integrator/full_contact.py", "integrator/steps.py",
    "integrator/transitions/declared.py",
)  # fmt: skip
"""Texts with one job each, of which the loop makes use."""
_LOOPS = ("integrator/loop.py", "integrator/batches.py")
_DERIVATIVES, _VARIATIONAL = "integrator/derivatives.py", "integrator/variational.py"
_SLOPES = "numbers/derivatives.py"
JOINED = (
    *POINT_TEXTS, *IMPACT_TEXTS, *_OF_POINTS, _TABLE, _SEARCH, *_OF_STEPS, *_LOOPS, _LANES,
    _DERIVATIVES, _VARIATIONAL,
)  # fmt: skip
"""Files that are joined to programs, and not imported."""
_PRELUDE = "generated/prelude.py"
_OF_ALL = (
    _PRELUDE, *_OF_STEPS, *_LOOPS, *_OF_POINTS, _TABLE, _SEARCH, "integrator/methods/tableau.py",
    "integrator/methods/coefficients.py", "integrator/methods/radau.py",
    "integrator/methods/radau_step.py", "compiler/printer.py", "compiler/frontend.py",
    "compiler/parsed.py", "compiler/machine.py", "compiler/lines.py", "compiler/types.py",
    "integrator/program.py", "integrator/texts.py", "codes.py",
)  # fmt: skip
"""Modules whose texts every program follows from, besides that of its structure."""
_SIZES = ("SCRATCH", "Z_SIZE", "W_SIZE", "FLOATS_SIZE", "DUALS_SIZE")


class Program:
    """The functions of a structure with a method in machine code, and the tables of its module.

    integrate, integrate_many, falls, at_rest, evaluate, and integrate_lanes in one with lanes, as
    in loop.py and lanes/loop.py; carry, as in variational.py, in one that carries derivatives; the
    sizes of the arrays that they want as scratch; all else is that of the generated module.

    codes : of the loop, and of lanes, which call it. bounds : they check indices.
    """

    SCRATCH: int
    Z_SIZE: int
    W_SIZE: int
    FLOATS_SIZE: int
    DUALS_SIZE: int

    integrate: Function
    integrate_many: Function
    integrate_lanes: Function
    falls: Function
    at_rest: Function
    evaluate: Function
    carry: Function

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


def carrying(generated: GeneratedModule, method: str) -> Program:
    """The program that carries derivatives along the motions of a generated module."""
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
        codes.append(_shared(shared, lambda: _halves(printed(generated, method, LOOP, bounds))[1]))
    return Program("_".join(keys[-1]), generated, *codes, bounds=bounds)


_SHARED: dict[str, bytes] = {}


def _shared(digest: str, ir: Callable[[], str]) -> bytes:
    """The half of a loop that structures have in common, made and kept once for all of them."""
    if digest not in _SHARED:
        made = json.dumps({"entries": {}, "sizes": {}}).encode() + b"\n"
        _SHARED[digest] = kept("loop", digest, lambda: made + compiled(ir(), False))
    return _SHARED[digest]


def _halves(made: Printed) -> tuple[str, str]:
    """A loop in two: what is the structure's own, with its step, and what others have, too.

    Most of a loop is in the second, and it follows from a few numbers: how many states there are,
    which modes follow which. All blocks have the same.
    """
    return made.halves(made.texts[:3])


LOOP, VECTORS, GLUE, TANGENTS = "loop", "vectors", "lanes", "derivatives"
"""The parts of a program, each compiled and kept by itself: a sweep in lanes finds the loop there
that a single motion has been run by. Vectors are the work on all lanes at once, and the third is
what it is called by. Derivatives are the texts of the loop once more, printed for duals."""
_OTHERS = {
    VECTORS: (_LANES, "integrator/lanes/step.py"),
    GLUE: (_LANES, "integrator/lanes/step.py"),
    TANGENTS: (_SLOPES, _DERIVATIVES, _VARIATIONAL),
}
"""Texts from which a part is made besides those of the loop."""

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
    return (
        source(generated), *(text.source for text in _of_points(generated)), method,
        *(text_of(name) for name in (*_OF_ALL, *_OTHERS.get(part, ()))),
        *(["bounds"] if bounds else []),
    )  # fmt: skip


def _made(generated: GeneratedModule, method: str, part: str, bounds: bool = False) -> bytes:
    """A line that describes a part of a program, and its machine code."""
    started = time.monotonic()
    made = printed(generated, method, part, bounds)
    described: dict[str, Any] = {"entries": made.entries, "sizes": sizes_of(made)}
    if part == LOOP:
        own, rest = _halves(made)
        described["shared"] = digest(rest, target(), text_of("compiler/machine.py"))
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
    more: Sequence[Text] = (),
) -> Printed:
    """A part of a program as LLVM is given it; contract as in `Printed`, more texts are joined."""
    # only where something is compiled; so are the texts of methods and lanes below
    from rockeom.compiler.printer import GROWTH, Program as Printed

    # a loop over lanes becomes one of vectors only where it calls nothing
    few = has_points(generated) or not contract  # they have many modes; a page is a small file
    growth = 0.1 * GROWTH if few else GROWTH
    growth = math.inf if part == VECTORS else growth
    texts = [*joined_texts(generated, method, part), *more]
    with _nothing_collected():
        return Printed(texts, contract=contract, growth=growth, bounds=bounds)


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


def joined_texts(generated: GeneratedModule, method: str, part: str) -> list[Text]:
    """The texts that a part of a program is printed from; it calls the entries of other parts."""
    own = {LOOP: _LOOPS, VECTORS: (VECTORS,), GLUE: (_LANES,), TANGENTS: (_VARIATIONAL,)}[part]
    found = texts(generated, method, part in (VECTORS, GLUE))
    if part == TANGENTS:
        found += [_joined(name, fused=True) for name in _OTHERS[TANGENTS]]
    found = [replace(text, elsewhere=text.name not in own) for text in found]
    if part == VECTORS:
        from rockeom.integrator.lanes.step import SINES

        found.append(Text("sines of lanes", SINES))
        # lanes do not have the loop's last digits in any case
        found = [replace(text, fused=True) for text in found]
    return found


def texts(generated: GeneratedModule, method: str, lanes: bool = False) -> list[Text]:
    """The parts of a program, in the order in which one needs the other."""
    from rockeom.integrator.methods.tableau import step_text, tableau

    n = generated.N_STATES // 2
    if method == "Radau":
        from rockeom.integrator.methods.radau import implicit_step_text

        step = implicit_step_text(n)
    else:
        quick = getattr(generated, "QUICK", ())
        step = step_text(tableau(method), n, generated.ROTATION, quick)
    contract = _SEARCH if _bounces(generated) else _TABLE
    parts = [
        *texts_of(generated),
        Text(f"the step of {method}", step, fused=True),
        *_of_points(generated),
        *(_joined(name, fused=True) for name in (*_OF_STEPS, contract, *_LOOPS)),
    ]
    if lanes:
        from rockeom.integrator.lanes.step import lanes_text

        step = lanes_text(tableau(method), generated)
        parts.append(Text(VECTORS, step, fused=True))
        parts.append(_joined(_LANES, fused=True))
    return parts


def texts_of(generated: GeneratedModule) -> list[Text]:
    """The text of a generated module, behind that of what it may import."""
    return [Text(_PRELUDE, text_of(_PRELUDE)), Text(f"{generated.NAME}.py", source(generated))]


def _of_points(generated: GeneratedModule) -> list[Text]:
    """The texts that find the mode that follows, where a structure does not declare it."""
    if not has_points(generated):
        return [Text("no points", "N_POINTS = N_KNOWN = 0\n")]
    which = f"\n\nANGLES = {angles(generated)!r}  # which coordinates are\n"
    others = (*point_texts(generated)[1:], *(_OF_POINTS if _bounces(generated) else ()))
    return [Text(POINTS, text_of(POINTS) + which), *map(_joined, others)]


def _bounces(generated: GeneratedModule) -> bool:
    """Whether a structure has points that may open, slide and bounce, besides elements."""
    return getattr(generated, "N_POINTS", 0) > 0


def _joined(name: str, fused: bool = False) -> Text:
    """The text of a module of this package as a part of a program."""
    return Text(name, text_of(name), fused=fused)
