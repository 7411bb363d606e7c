"""From a declaration to a structure: the derivation and the simulation meet here."""

from __future__ import annotations

import copyreg
import pickle
import sys
import time
from collections.abc import Callable
from functools import cache, partial
from typing import TYPE_CHECKING, Any, cast

from rockeom.compiler.cache import kept
from rockeom.compiler.sources import digest
from rockeom.integrator.program import announce, say
from rockeom.integrator.schema import GeneratedModule
from rockeom.integrator.texts import load_text
from rockeom.structures.base import Structure, generated_module
from rockeom.structures.classes import SHIPPED
from rockeom.structures.declared import DeclaredStructure, class_of

if TYPE_CHECKING:
    from rockeom.symbolic import RockingModel

MANY_MODES = 30
"""The derivation of more modes takes many seconds, and is announced before it begins."""

_CLASSES: dict[int, tuple[RockingModel, type[DeclaredStructure]]] = {}


def class_of_model(model: RockingModel) -> type[DeclaredStructure]:
    """The class of structures of a declared model, derived once on a machine.

    Its structures are pickled and copied with the declaration: a module that was derived has no
    file from which another process could import it.
    """
    if id(model) not in _CLASSES:
        from rockeom.codegen import declaration_digest

        made = class_of(_kept_module(model.name, declaration_digest(model), lambda: model))
        made.declaration = model
        copyreg.pickle(made, partial(_reduced, cache(partial(pickle.dumps, model))))
        _CLASSES[id(model)] = model, made  # the model is kept, since its id is used
    return _CLASSES[id(model)][1]


def _reduced(declaration: Callable[[], bytes], structure: DeclaredStructure) -> tuple[Any, ...]:
    """How a structure is made again: of its declaration where its module is not there."""
    return _again, (structure.module.__name__, declaration(), structure.values)


def _again(module: str, declaration: bytes, values: dict[str, float]) -> Structure:
    """In another process the module is derived again, or read from the cache of this machine."""
    if module in sys.modules:
        return class_of(sys.modules[module])(**values)
    return class_of_model(pickle.loads(declaration))(**values)


@cache
def module_of(name: str, **arguments: Any) -> GeneratedModule:
    """The generated module of a shipped structure, or of one of a family, by its arguments.

    That is derived once on a machine: SymPy is loaded where the module is not kept yet, and only
    there.
    """
    if name in SHIPPED and not arguments:
        return generated_module(name)

    def model() -> RockingModel:
        from rockeom.symbolic import derive

        return derive(name, **arguments)

    return _kept_module(name, digest(name, repr(sorted(arguments.items()))), model)


def _kept_module(name: str, digest: str, model: Callable[[], RockingModel]) -> GeneratedModule:
    def text() -> bytes:
        from rockeom.codegen import module_text

        started = time.monotonic()
        of = model()
        modes = len(of.hybrid.mode_names)
        if modes > MANY_MODES and not of.hybrid.is_by_code:
            say(f"deriving {of.name} with {modes} modes")
        encoded = module_text(of).encode()
        announce(f"derived {of.name}", started)
        return encoded

    return cast(GeneratedModule, load_text(name, kept(f"{name}_module", digest, text).decode()))
