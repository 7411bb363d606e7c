"""Former names of functions, classes, arguments and attributes.

For one release a former name works, and gives one DeprecationWarning with the name of today. All of
them are made here, so that the release after removes them by the uses of this file. CHANGELOG lists
them.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from operator import attrgetter
from typing import Any, TypeVar

from rockeom.numbers.callers import is_of_package

T = TypeVar("T")
C = TypeVar("C", bound=type)


def warn(former: str, name: str) -> None:
    """Say the name of today, at the line outside the package that used the former one."""
    say(f"{former} is now called {name}")


def say(message: str, category: type[Warning] = DeprecationWarning) -> None:
    """Give a warning at the line outside the package that calls it."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and is_of_package(frame):
        level, frame = level + 1, frame.f_back
    warnings.warn(message, category, stacklevel=level)


def names(
    module: str, today: Mapping[str, str], read: Callable[[str], Any]
) -> Callable[[str], Any]:
    """A `__getattr__` for a module: what its names of today give, under their former ones.

    today : the name of today of each former one. read : gives what a name of today stands for, such
    as `globals().__getitem__`.
    """

    def getattr_of_module(name: str) -> Any:
        if name not in today:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        warn(f"{module}.{name}", f"{module}.{today[name]}")
        return read(today[name])

    return getattr_of_module


def arguments(**names: str) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Let a function take arguments by their former names, too: `@arguments(phase="mode")`."""

    def of_today(what: str, named: dict[str, Any]) -> dict[str, Any]:
        for former in names.keys() & named.keys():
            today = names[former]
            if today in named:
                raise TypeError(
                    f"{what}: {former} is the former name of {today}, and both are given"
                )
            warn(f"{what}: {former}", today)
            named[today] = named.pop(former)
        return named

    return _taking(names, of_today)


def moved(
    today: str, record: Callable[..., Any], *formers: str
) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Let a function take what is a field of one of its arguments as an argument, as it did.

    With `@moved("options", Options, "width")` f(width=3) is f(options=Options(width=3)).
    """

    def of_today(what: str, named: dict[str, Any]) -> dict[str, Any]:
        fields = {former: named.pop(former) for former in formers if former in named}
        if named.get(today) is not None:
            raise TypeError(f"{what}: {', '.join(fields)} belongs into {today}, which is given too")
        for former in fields:
            warn(f"{what}: {former}", f"{today}=rk.{record.__name__}({former}=...)")
        return named | {today: record(**fields)}

    return _taking(formers, of_today)


def needless(**remedies: str) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Let a function take arguments that have no effect any more, and say what to do instead."""

    def of_today(what: str, named: dict[str, Any]) -> dict[str, Any]:
        for former in remedies.keys() & named.keys():
            del named[former]
            say(f"{what}: {former} has no effect: {remedies[former]}")
        return named

    return _taking(remedies, of_today)


def _taking(
    formers: Iterable[str], of_today: Callable[[str, dict[str, Any]], dict[str, Any]]
) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Let a function take former names of arguments, of which others are made for it."""
    none_among = frozenset(formers).isdisjoint  # true of most calls, which cost little

    def decorate(function: Callable[..., T]) -> Callable[..., T]:
        @wraps(function)
        def with_former_names(*values: Any, **named: Any) -> T:
            if none_among(named):
                return function(*values, **named)
            return function(*values, **of_today(function.__qualname__, named))

        return with_former_names

    return decorate


def attributes(**names: str) -> Callable[[C], C]:
    """Let a class have attributes and methods under their former names, too.

    A name of today may be that of an attribute of an attribute: `@attributes(rest="events.rest")`.
    """

    def decorate(cls: C) -> C:
        for former, name in names.items():
            setattr(cls, former, _former_attribute(cls.__name__, former, name))
        return cls

    return decorate


def fields(**names: str) -> Callable[[C], C]:
    """Both of a class of fields: arguments of its constructor, and attributes."""

    def decorate(cls: C) -> C:
        init: Callable[..., None] = cls.__init__  # type: ignore[misc]
        init.__qualname__ = cls.__qualname__
        setattr(cls, "__init__", arguments(**names)(init))  # noqa: B010
        return attributes(**names)(cls)

    return decorate


def _former_attribute(of: str, former: str, name: str) -> property:
    def read(self: Any) -> Any:
        warn(f"{of}.{former}", name)
        return attrgetter(name)(self)

    read.__doc__ = f"The former name of {name}."
    return property(read)
