"""A group of `rockeom.analysis`: a package with the public names of its modules.

The names are those of the functions and classes that the modules define, so that no list repeats
them, or the list `__all__` of a module. A module is imported when a name is looked for, not with
the package.
"""

import sys
from collections.abc import Callable
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import Any

from rockeom.numbers import explained


def attributes(package: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """`__getattr__` and `__dir__` of the group with the `__name__` given."""
    group = sys.modules[package]
    last = package.rpartition(".")[2]
    modules = [module.name for module in iter_modules(group.__path__)]

    def load(module: str) -> ModuleType:
        return import_module(f"rockeom.analysis.{last}.{module}")

    def get(name: str) -> Any:
        if name == "__all__":
            return sorted(one for module in modules for one in defined(load(module)))
        if name in modules:
            return load(name)
        for module in () if name.startswith("_") else modules:
            if name in defined(load(module)):
                setattr(group, name, getattr(load(module), name))
                return getattr(group, name)
        message = f"module {package!r} has no attribute {name!r}"
        if name.startswith("_"):
            raise AttributeError(message)
        raise explained.UnknownAttributeError(message, name, lambda: {n: n for n in get("__all__")})

    return get, lambda: sorted({*get("__all__"), *modules})


def defined(module: ModuleType) -> list[str]:
    """The public names of a module, in the order of their definition."""
    if hasattr(module, "__all__"):
        return list(module.__all__)
    return [
        name
        for name, value in vars(module).items()
        if not name.startswith("_")
        and hasattr(value, "__qualname__")
        and value.__module__ == module.__name__
    ]
