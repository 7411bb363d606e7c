"""From a declaration to a structure: where what derives and what simulates are joined."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

from rockeom.arguments import near
from rockeom.numeric.program import load_text
from rockeom.numeric.store import kept
from rockeom.numeric.structures import SHIPPED, Structure, class_of
from rockeom.sources import digest

if TYPE_CHECKING:
    from rockeom.symbolic import RockingModel

_MODULES: dict[int, tuple[RockingModel, ModuleType]] = {}


def _module_of(model: RockingModel) -> ModuleType:
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


def structure(model: Any, /, **parameters: float) -> Structure:
    """A structure of a model: the name of a shipped one, or a RockingModel that you declared.

    A declared model is derived and compiled at its first use (some seconds, once on a machine: the
    user's cache keeps both). Raises ParameterError for missing or unknown parameters and
    ValueError for values that are not finite or negative, for a model that cannot be simulated,
    and where the values give a body a negative mass or a base a negative width.
    """
    if isinstance(model, str):
        if model not in SHIPPED:
            raise ValueError(
                f"no structure named {model!r}{near(model, SHIPPED)}; shipped are "
                f"{', '.join(SHIPPED)}"
            )
        return SHIPPED[model](**parameters)
    if not hasattr(model, "check_values"):
        raise TypeError(
            f"structure() takes the name of a shipped structure or a RockingModel, not {model!r}"
        )
    return class_of(_module_of(model))(**parameters)
