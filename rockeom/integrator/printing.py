"""A part of a program as LLVM is given it: only where something is compiled."""

import gc
import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from types import MappingProxyType

from rockeom.compiler.modules import Text
from rockeom.compiler.printer import GROWTH, Program as Printed
from rockeom.integrator.linking import VECTORS, linked
from rockeom.integrator.schema import GeneratedModule, has_points

_SIZES = ("SCRATCH", "Z_SIZE", "W_SIZE")


def sizes_of(made: Printed) -> dict[str, int]:
    """The sizes of the scratch arrays of a program, by name."""
    return {name: int(made.names[name]) for name in _SIZES if name in made.names}


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
