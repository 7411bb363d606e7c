"""States of an element that switches, and what ends them."""

from typing import Any, NamedTuple

import sympy as sp

from rockeom.numbers.checks import InputError
from rockeom.symbolic import valid
from rockeom.symbolic.model import InternalVariable, internal_variable


def switch_of(element: int) -> sp.Symbol:
    """chi: the state of an element, a number."""
    return sp.Symbol(rf"\chi_{element}", real=True)


def check_element(element: Any, **expressions: Any) -> None:
    """Refuse names, places and constants of an element that cannot be; expressions : its others."""
    what = f"element {element.name!r}"
    valid.texts(what, name=element.name)
    ends = {item: getattr(element, item, None) for item in ("place", "end")}
    valid.points(what, **{item: point for item, point in ends.items() if point is not None})
    valid.expressions(what, **expressions, **element.constants)
    valid.not_negative(what, **element.constants)
    for item in sorted(element.positive):
        if sp.sympify(getattr(element, item)).is_zero:
            raise InputError(item, 0, what).give("a positive one, or leave it out")


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
