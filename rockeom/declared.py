"""From a declaration to a structure: where what derives and what simulates are joined."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

from rockeom.numeric.program import load_text
from rockeom.numeric.store import kept
from rockeom.numeric.structures import SHIPPED, Structure, class_of
from rockeom.sources import digest

if TYPE_CHECKING:
    from rockeom.symbolic import RockingModel

_MODULES: dict[int, tuple[RockingModel, ModuleType]] = {}


def module_of_model(model: RockingModel) -> ModuleType:
    """The generated module of a declared model, derived once on a machine."""
    if id(model) not in _MODULES:
        from rockeom.codegen import declaration_digest

        module = _kept_module(model.name, declaration_digest(model), lambda: model)
        _MODULES[id(model)] = model, module  # the model kept: its id is used
    return _MODULES[id(model)][1]


@cache
def module_of(name: str, **arguments: str | int) -> ModuleType:
    """The generated module of a shipped structure, or of one of a family, by its arguments.

    That is derived once on a machine: SymPy is loaded where the module is not kept yet, and only
    there.
    """
    if name in SHIPPED and not arguments:
        return import_module(f"rockeom.generated.{name}")

    def model() -> RockingModel:
        from rockeom.symbolic import derive

        return derive(name, **arguments)

    return _kept_module(name, digest(name, repr(sorted(arguments.items()))), model)


def _kept_module(name: str, digest: str, model: Callable[[], RockingModel]) -> ModuleType:
    def text() -> bytes:
        from rockeom.codegen import module_text

        return module_text(model()).encode()

    return load_text(name, kept(f"{name}_module", digest, text).decode())


def class_of_model(model: RockingModel) -> type[Structure]:
    """The class of structures of a declared model."""
    return class_of(module_of_model(model))
