"""States of an element that switches, and what ends them."""

from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.model import InternalVariable, internal_variable


def switch_of(element: int) -> sp.Symbol:
    """chi: the state of an element, a number."""
    return sp.Symbol(rf"\chi_{element}", real=True)


class Ending(NamedTuple):
    """End of a state of an element.

    Parameters
    ----------
    guard : tuple of sympy.Expr
        Guards, positive inside the state; of two, the larger counts.
    target : int
        Number of the state that follows.
    back : int, optional
        Number of the target's ending whose guard is zero then, if any.
    sets : tuple of (InternalVariable, sympy.Expr), optional
        Values of internal variables behind it.
    """

    guard: tuple[sp.Expr, ...]
    target: int
    back: int | None = None
    sets: tuple[tuple[InternalVariable, sp.Expr], ...] = ()


def broken_of(name: str) -> InternalVariable:
    """b: 1 once an element has broken, else 0."""
    return internal_variable(f"b_{name}", f"{name}_broken", "-", f"1 once {name} has broken")


def where_whole(guard: sp.Expr, broken: InternalVariable, size: sp.Expr) -> sp.Expr:
    """A guard of an element that is whole; once it has broken the negative of a size."""
    b = broken.symbol
    return (1 - b) * guard - b * size
