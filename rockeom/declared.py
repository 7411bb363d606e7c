"""From a declaration to a structure: where what derives and what simulates are joined."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

from rockeom.arguments import near
from rockeom.numeric.program import load_text
from rockeom.numeric.store import kept
from rockeom.numeric.structures import SHIPPED, Structure, class_of

if TYPE_CHECKING:
    from rockeom.symbolic import RockingModel

_MODULES: dict[int, tuple[RockingModel, ModuleType]] = {}


def _module_of(model: RockingModel) -> ModuleType:
    """The generated module of a declared model, derived once on a machine."""
    if id(model) not in _MODULES:
        from rockeom.codegen import declaration_digest, module_text

        text = kept(
            f"{model.name}_module",
            declaration_digest(model),
            lambda: module_text(model).encode(),
        ).decode()
        _MODULES[id(model)] = model, load_text(model.name, text)  # the model kept: its id is used
    return _MODULES[id(model)][1]


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
