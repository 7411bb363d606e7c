"""States of an element that switches, and what ends them."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.model import InternalVariable


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
    sets : mapping of InternalVariable to sympy.Expr, optional
        Values of internal variables behind it.
    """

    guard: tuple[sp.Expr, ...]
    target: int
    back: int | None = None
    sets: Mapping[InternalVariable, sp.Expr] = MappingProxyType({})
