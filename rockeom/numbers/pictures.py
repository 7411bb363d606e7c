"""Pictures of a value by a package above its own, which knows its class.

A class asks for its picture by name. `rockeom`, where all packages meet, registers the module that
draws them; it is imported, with matplotlib, for the first picture.
"""

from collections.abc import Callable
from types import ModuleType
from typing import Any

_homes: list[Callable[[], ModuleType]] = []


def register(home: Callable[[], ModuleType]) -> None:
    """Say how the module of the pictures is imported."""
    _homes[:] = [home]


def picture(name: str, *args: Any, **kwargs: Any) -> Any:
    """The picture that the function of that name draws of the arguments."""
    (home,) = _homes
    return getattr(home(), name)(*args, **kwargs)
