"""The shipped structures, which the files of `rockeom/symbolic/structures` declare."""

import importlib
import math
import pkgutil
import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from inspect import signature
from typing import Any, cast

from rockeom.numbers import explained
from rockeom.numbers.checks import InputTypeError, near
from rockeom.symbolic import structures
from rockeom.symbolic.rocking import RockingModel


@dataclass(frozen=True)
class Arguments:
    """How the class of a shipped structure takes its parameters, besides names, units and meanings.

    may_vanish : those that may be zero. defaults : numbers; or words for what the class computes.
    called : the argument of a parameter that has another name, or that is a part of it.
    """

    may_vanish: Collection[str] = ()
    defaults: Mapping[str, float | str] = field(default_factory=dict)
    called: Mapping[str, str] = field(default_factory=dict)


_PLACES: dict[str, float] = {}
_DECLARED: dict[str, Callable[[], RockingModel]] = {}
ARGUMENTS: dict[str, Arguments] = {}
"""The arguments of the classes of shipped structures, by name."""
FAMILIES: dict[str, Callable[..., RockingModel]] = {}
"""The functions that declare a structure for each set of their arguments, by name."""


def shipped(declare: Any = None, /, *, place: float = math.inf, **arguments: Any) -> Any:
    """Mark the function that declares a structure, which is called by the function's name.

    place : in lists of all structures. Those that name none come last, by their names. arguments :
    those of `Arguments`. The docstring of the function becomes that of the class.

    Raises ValueError where two functions declare a structure of one name.
    """
    if declare is None:
        return partial(shipped, place=place, **arguments)
    name = declare.__name__
    if name in _DECLARED and _DECLARED[name].__module__ != declare.__module__:
        there = ", ".join(f.__module__ for f in (_DECLARED[name], declare))
        raise ValueError(f"two structures are called {name}, in {there}: rename one")
    _PLACES[name], _DECLARED[name] = place, declare
    ARGUMENTS[name] = Arguments(**arguments)
    return declare


def family(declare: Callable[..., RockingModel]) -> Callable[..., RockingModel]:
    """Mark a function that declares a structure for each set of its arguments.

    Those are derived where they are used, and `derive` takes the arguments by name.
    """
    FAMILIES[declare.__name__] = declare
    return declare


def found() -> dict[str, Callable[[], RockingModel]]:
    """The functions that declare the shipped structures, by name and in order."""
    for module in pkgutil.iter_modules(structures.__path__, f"{structures.__name__}."):
        importlib.import_module(module.name)
    return {name: _DECLARED[name] for name in sorted(_DECLARED, key=lambda n: (_PLACES[n], n))}


SHIPPED = found()


def models() -> tuple[str, ...]:
    """Names of the shipped structures. ``rockeom models`` lists families, too.

    Returns
    -------
    tuple of str
        Names.

    Examples
    --------
    >>> import rockeom as rk
    >>> "rigid_block" in rk.models()
    True
    """
    return tuple(SHIPPED)


@explained.calls()
def derive(structure: Any, **arguments: str | int) -> RockingModel:
    """Equations of a structure, derived once in a session.

    Parameters
    ----------
    structure : str, type or Structure
        Name of a shipped structure or of a family, its class, or a structure, whose support and
        storeys are then those of the equations.
    **arguments : str or int
        Arguments of a family, such as ``derive("shear_frame", storeys=3)``.

    Returns
    -------
    RockingModel
        Model with its equations of motion and impact maps.

    Raises
    ------
    KeyError
        If there is none of that name; the message names all of them.
    InputTypeError
        For arguments that it does not take, and for what is no structure.

    Examples
    --------
    >>> import rockeom as rk
    >>> model = rk.derive(rk.RigidBlock)
    >>> [c.name for c in model.coordinates]
    ['theta']
    >>> mass_matrix = model.equations("right").mass_matrix  # SymPy
    """
    declaration = getattr(structure, "declaration", None) or structure
    if hasattr(declaration, "reduced"):
        return cast(RockingModel, declaration.reduced)
    every = SHIPPED | FAMILIES
    name = structure if isinstance(structure, str) else getattr(structure, "model", None)
    if not isinstance(name, str):
        raise InputTypeError("structure", structure).give(
            "a name such as 'rigid_block', a class such as rk.RigidBlock, or a structure"
        )
    if name not in every:
        hint = near(re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name), every)  # of a class, too
        raise KeyError(f"no structure named {name!r}{hint}; shipped are {', '.join(every)}")
    if not isinstance(structure, str | type):
        arguments = {**structure.derivation, **arguments}
    try:
        signature(every[name]).bind(**arguments)
    except TypeError:
        raise InputTypeError("arguments").says(
            explained.misfit(every[name], (), arguments)
        ) from None
    return _derived(every[name], **arguments)


@lru_cache(maxsize=None, typed=True)  # True is not 1, which a declaration would take
def _derived(structure: Callable[..., RockingModel], **arguments: str | int) -> RockingModel:
    return structure(**arguments).reduced
