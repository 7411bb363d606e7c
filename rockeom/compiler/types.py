"""Types of machine code, and the functions that it asks of the system, as LLVM calls them."""

from __future__ import annotations

from typing import NamedTuple

FLOAT, INT, BOOL = "double", "i64", "i1"
"""Scalar types are called as in LLVM."""

DUAL = "dual"
"""A number with its derivatives in WIDTH directions: what is printed for it carries them along."""

WIDTH = 16
VECTOR = f"<{WIDTH} x double>"
IN_MEMORY = {DUAL: f"[{1 + WIDTH} x double]"}
"""Types in a place of an array, where they differ from the name of the type."""


def words(part: str) -> int:
    """How many 64 bits a part of a value takes."""
    return WIDTH if part == VECTOR else 1


class Array(NamedTuple):
    """An array, by its element type and its number of dimensions."""

    element: str
    dimensions: int


class Tuple(NamedTuple):
    """A tuple of values; fields : their names where it is a record."""

    items: tuple[Type, ...]
    fields: tuple[str, ...] = ()


Type = str | Array | Tuple
NOTHING = Tuple(())
"""The result of a function without `return`."""


class Entry(NamedTuple):
    """A function that Python calls: names and types of its arguments, type of what it returns."""

    arguments: tuple[tuple[str, Type], ...]
    returns: Type


MATH = {
    "sqrt": "llvm.sqrt.f64", "sin": "llvm.sin.f64", "cos": "llvm.cos.f64", "exp": "llvm.exp.f64",
    "log": "llvm.log.f64",
    **{name: name for name in (
        "expm1", "log1p", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh",
        "atanh",
    )},
}  # fmt: skip
"""Functions of one float, and what LLVM calls them."""

LIBRARY = frozenset({"sin", "cos", "exp", "log", "pow", "sincos", *MATH} - {"sqrt"})
"""Functions that a program may ask of the system's library of mathematics."""
