"""Names that things had before: they work, and say what they are called now."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, TypeVar

T = TypeVar("T", bound=type)

CLASSES = {"Phase": "Mechanism", "Law": "NamedFunction"}
"""Of `rockeom.symbolic`."""


def say(old: str, new: str, above: int = 2) -> None:
    """Warn whoever used the old name, who stands so many calls above."""
    warnings.warn(f"{old} is now called {new}", DeprecationWarning, stacklevel=above + 1)


def names(**new_of_old: str) -> Callable[[T], T]:
    """Let a class take these arguments, and have these attributes, by their old names, too."""

    def understanding(cls: T) -> T:
        init = cls.__init__  # type: ignore[misc]

        @wraps(init)
        def understood(self: Any, *given: Any, **named: Any) -> None:
            for old, new in new_of_old.items():
                if old in named:
                    say(f"{cls.__name__}: {old}", new)
                    named[new] = named.pop(old)
            init(self, *given, **named)

        setattr(cls, "__init__", understood)  # noqa: B010
        for old, new in new_of_old.items():
            setattr(cls, old, _read(cls.__name__, old, new))
        return cls

    return understanding


def _read(of: str, old: str, new: str) -> property:
    def read(self: Any) -> Any:
        say(f"{of}.{old}", new)
        return getattr(self, new)

    read.__doc__ = f"The former name of {new}."
    return property(read)


def classes(module: Mapping[str, Any], name: str) -> Any:
    """The class that had this name in a module's names; None where none had."""
    if name not in CLASSES:
        return None
    say(name, CLASSES[name], above=3)
    return module[CLASSES[name]]
