"""Hash of a declared model: equal declarations give equal generated text."""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.compiler.sources import digest


def declaration_digest(model: Any) -> str:
    """Hash of all that a generated module follows from: the declaration, SymPy and the derivation.

    Raises TypeError where a declaration holds what is neither text nor number nor expression.
    """
    return digest(*_parts(model))


_ASSUMED = [
    "real", "positive", "negative", "nonnegative", "nonpositive", "nonzero", "integer", "finite",
    "complex",
]  # fmt: skip
"""Assumptions on a function, which its text does not show."""


def _parts(value: Any) -> Iterator[str]:
    """All parts of a value, symbols with their assumptions, so that different values differ."""
    if isinstance(value, sp.Basic):
        yield sp.srepr(value)
        for function in sorted(value.atoms(AppliedUndef), key=sp.default_sort_key):
            yield repr((str(function), [getattr(function, f"is_{what}") for what in _ASSUMED]))
    elif dataclasses.is_dataclass(value):
        yield type(value).__name__
        for field in dataclasses.fields(value):
            yield field.name
            yield from _parts(getattr(value, field.name))
    elif isinstance(value, Mapping):
        yield f"{len(value)} named"
        for key, item in value.items():
            yield from _parts(key)
            yield from _parts(item)
    elif isinstance(value, list | tuple):
        yield f"{len(value)} in a row"
        for item in value:
            yield from _parts(item)
    elif value is None or isinstance(value, str | int | float):
        yield repr(value)
    else:
        raise TypeError(f"a declaration holds {value!r}, which is no text, number or expression")
