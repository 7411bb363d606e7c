"""Wrong calls, attributes and assignments in the words of the package, with the name meant.

    @explained.attributes(pga="peak")
    @explained.calls(frequency="period=1/frequency")
    @dataclass(frozen=True)
    class GroundMotion: ...

Nothing is looked up before an error is read: calls that fit cost one more function, and `hasattr`
as little as before.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import FrozenInstanceError, is_dataclass
from functools import wraps
from traceback import walk_tb
from types import FunctionType, MappingProxyType
from typing import TYPE_CHECKING, Any, TypeVar

from rockeom.numbers.checks import described, near

F = TypeVar("F", bound=Callable[..., Any])
C = TypeVar("C", bound=type)


# -- calls


def calls(**meant: str) -> Callable[[F], F]:
    """Explain calls whose arguments do not fit: of a function, or of a class and all its methods.

    meant : by unknown names that people try, what to write instead.
    The error is a TypeError, as Python's own, that names all that is missing, unknown and unnamed.
    """

    def decorate(of: F) -> F:
        if not isinstance(of, type):
            return _explained(of, meant)
        for name, member in list(vars(of).items()):
            if name == "__init__":
                setattr(of, name, _explained(member, meant, of))
            if isinstance(member, FunctionType) and name[0] != "_":
                setattr(of, name, _explained(member, meant))
            if isinstance(member, classmethod) and name[0] != "_":
                setattr(of, name, classmethod(_explained(member.__func__, meant)))
        return of

    return decorate


def _explained(function: F, meant: Mapping[str, str], described_by: Any = None) -> F:
    """The function, its arguments described by its own docstring or by that of a class."""

    @wraps(function)
    def call(*values: Any, **named: Any) -> Any:
        try:
            return function(*values, **named)
        except TypeError as error:
            if not _has_not_begun(function, error):
                raise
            doc = (described_by or function).__doc__
            message = misfit(function, values, named, meant, doc)
        raise TypeError(message)

    return call  # type: ignore[return-value]


def _has_not_begun(function: Callable[..., Any], error: TypeError) -> bool:
    """Whether an error is Python's own, of a call whose arguments do not fit."""
    of = inspect.unwrap(function)
    codes = [frame.f_code for frame, _ in walk_tb(error.__traceback__)]
    return of.__code__ not in codes and str(error).startswith(f"{of.__qualname__}()")


def misfit(
    function: Callable[..., Any], values: tuple[Any, ...], named: Mapping[str, Any],
    meant: Mapping[str, str] = MappingProxyType({}), doc: str | None = None,
) -> str:  # fmt: skip
    """A call that does not fit the arguments of a function, in words."""
    arguments = [*inspect.signature(function).parameters.values()]
    if arguments and arguments[0].name in ("self", "cls"):
        arguments, values = arguments[1:], values[1:]
    others = any(a.kind is a.VAR_KEYWORD for a in arguments)
    arguments = [a for a in arguments if a.kind not in (a.VAR_POSITIONAL, a.VAR_KEYWORD)]
    names = [a.name for a in arguments]
    placed = [a.name for a in arguments if a.kind is not a.KEYWORD_ONLY]
    required = [a.name for a in arguments if a.default is a.empty]
    unknown = [name for name in named if name not in names]
    unnamed = [a for a in names if a not in {*placed, *named}]
    text = [f"{name} is given twice" for name in placed[: len(values)] if name in named]
    if lacks := [name for name in required if name not in {*placed[: len(values)], *named}]:
        text.append(f"missing {listed(lacks, doc)}")
    for name in unknown:
        known = {**dict.fromkeys(names), **meant}
        hint = f" (give {meant[name]})" if name in meant else near(name, known, meant)
        text.append(f"unknown {name}{hint}")
    for value in values[len(placed) : len(placed) + 1]:
        such_as = f", such as {unnamed[0]}=" if unnamed else ""
        wrong = f"needs its name{such_as}" if unnamed or others else "is one too many"
        text.append(f"{described(value)} {wrong}")
    optional = [name for name in names if name not in required]
    what = getattr(function, "__qualname__", "").removesuffix(".__init__")
    return f"{what}: {'; '.join(text)}. {_taken(required, optional, others)}"


def listed(names: Iterable[str], doc: str | None) -> str:
    """Names of arguments, each with the first sentence that a docstring says of it."""
    from docstring_parser.numpydoc import parse  # of an error alone

    said = {
        name: " ".join((item.description or "").split()).partition(". ")[0].removesuffix(".")
        for item in parse(doc or "").params
        for name in item.arg_name.split(", ")
    }
    return ", ".join(f"{name} ({said[name]})" if said.get(name) else name for name in names)


def _taken(required: list[str], optional: list[str], others: bool) -> str:
    parts = [", ".join(required)] if required else []
    parts += [f"optional: {', '.join(optional)}"] if optional else []
    parts += ["others by name"] if others else []
    return f"It takes {'; '.join(parts) or 'nothing'}"


# -- attributes


class UnknownAttributeError(AttributeError):
    """An attribute that an object lacks; who reads the message is offered the one that was meant.

    offers : gives the names that people may have meant, each with what to write for it. It waits
    until the message is read, so that `hasattr` costs as little as before.
    """

    def __init__(self, message: str, name: str, offers: Callable[[], Mapping[str, str]]) -> None:
        super().__init__(message, name=name, obj=None)  # Python would add a suggestion of its own
        self._name, self._offers = name, offers

    def __str__(self) -> str:
        offers = self._offers()
        return self.args[0] + near(self._name, offers, instead=offers)

    def __reduce__(self) -> tuple[Any, ...]:
        return AttributeError, (str(self),)


def public_names(owner: Any) -> dict[str, str]:
    """The public attributes of an object as offers: each stands for itself."""
    return {name: name for name in dir(owner) if not name.startswith("_")}


def missing(owner: Any, name: str, synonyms: Callable[[], Mapping[str, str]] = dict) -> Any:
    """Raise UnknownAttributeError for an attribute that an object lacks: for `__getattr__`.

    synonyms : gives further offers. A property that itself raised AttributeError is evaluated
    again, so that its own error is seen.
    """
    if hasattr(type(owner), name):
        return object.__getattribute__(owner, name)
    message = f"{type(owner).__name__!r} object has no attribute {name!r}"
    if name.startswith("_"):
        raise AttributeError(message)
    raise UnknownAttributeError(message, name, lambda: {**synonyms(), **public_names(owner)})


def attributes(**meant: str) -> Callable[[C], C]:
    """Let objects of a class explain unknown attributes, and assignments where it is frozen.

    meant : by unknown names that people try, what to write instead.
    """

    def explain(self: Any, name: str) -> Any:
        return missing(self, name, lambda: meant)

    def decorate(cls: C) -> C:
        setattr(cls, "_meant", meant)  # noqa: B010
        if "__getattr__" not in vars(cls):
            setattr(cls, "__getattr__", explain)  # noqa: B010
        if is_dataclass(cls) and cls.__dataclass_params__.frozen:  # type: ignore[attr-defined]
            refuse_assignments(cls)
        return cls

    return decorate


def record(**meant: str) -> Callable[[C], C]:
    """As `calls` of a class with its own words, and `attributes`."""
    return lambda cls: attributes()(calls(**meant)(cls))


class Constructors(type):
    """A class that explains unknown attributes of its own, such as other constructors."""

    if not TYPE_CHECKING:  # for type checkers an unknown attribute stays an error

        def __getattr__(cls, name: str) -> Any:
            message = f"type object {cls.__name__!r} has no attribute {name!r}"
            if name.startswith("_"):
                raise AttributeError(message)
            offers = {**vars(cls).get("_meant", {}), **public_names(cls)}
            raise UnknownAttributeError(message, name, lambda: offers)


def refuse_assignments(cls: type) -> None:
    """Let objects of a frozen class say how another one is made, where an attribute is set."""

    def refuse(self: Any, name: str, value: Any) -> None:
        kind, known = type(self).__name__, set(self.__dataclass_fields__)
        if name not in known:
            raise FrozenInstanceError(f"{kind}: {name} cannot be set{near(name, known)}")
        raise FrozenInstanceError(
            f"{kind}: {name} cannot be set, the object stays as it was made: make another, "
            f"dataclasses.replace(it, {name}={described(value)})"
        )

    setattr(cls, "__setattr__", refuse)  # noqa: B010
