"""Checks of an equation: findings on its printed form, and on the corrected one."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Any

import sympy as sp

from rockeom.thesis.comparison import at_side, differs_somewhere
from rockeom.thesis.equation import Equation, stated


class Means(Enum):
    """Ways to decide an equation."""

    DERIVED = "derived"  # from first principles, by the engine or an independent route
    REPRODUCED = "reproduced"  # numbers of a table or a figure come out
    TRANSCRIBED = "transcribed"  # an empirical fit: its coefficients are data


@dataclass(frozen=True)
class Finding:
    """One comparison.

    Parameters
    ----------
    what : str
        Subject of the comparison.
    rest : object
        Remainder of the difference: zero, or an error and how large it may be, in words.
    holds : bool
        Whether the equation passes.
    comparable : bool, optional
        False where the comparison broke off; it then proves nothing, not even that a printed form
        is wrong.
    """

    what: str
    rest: Any
    holds: bool
    comparable: bool = True


Findings = Iterator[Finding]
Find = Callable[..., Findings]
"""Function of an equation and each of its relations."""


@dataclass(frozen=True)
class Check:
    """Comparison that decides the relations of an equation, right or wrong ones alike.

    Parameters
    ----------
    means : Means
        Way to decide.
    route : str
        Derivation, in words.
    find : callable
        Function of the equation and its relations that gives findings. It must fail for a wrong
        form: it is run on the printed form of an erratum too, where at least one finding must not
        hold.
    error : str, optional
        For an approximation, the order of its error and the size at the thesis's numbers.
    """

    means: Means
    route: str
    find: Find
    error: str = ""


Checks = dict[str, Check | tuple[Check, ...]]
"""Checks of equations by their numbers."""


def derived(route: str, find: Find, error: str = "") -> Check:
    """A check from first principles."""
    return Check(Means.DERIVED, route, find, error)


def reproduced(route: str, find: Find, error: str = "") -> Check:
    """A check by numbers of a table, a figure or the text."""
    return Check(Means.REPRODUCED, route, find, error)


def transcribed(route: str, find: Find) -> Check:
    """A check of what the thesis fitted or chose, typed a second time: no evidence by itself."""
    return Check(Means.TRANSCRIBED, route, find)


@dataclass(frozen=True)
class Unreduced:
    """A difference known not to be zero; reduced only to be read."""

    difference: sp.Expr
    reduce: Callable[[sp.Expr], Any]

    def __str__(self) -> str:
        return str(self.reduce(self.difference))


def vanishes(what: str, difference: Any, reduce: Callable[[sp.Expr], Any] = sp.sympify) -> Finding:
    """Finding that a difference is exactly zero.

    reduce : makes zero of every difference that is zero. Only it can show that one is; that one
        is not, its value for some numbers shows sooner.
    """
    difference = sp.sympify(difference)
    if reduce is not sp.sympify and differs_somewhere(difference):
        return Finding(what, Unreduced(difference, reduce), False)
    rest = reduce(difference)
    return Finding(what, rest, bool(rest == 0))


def on_side(side: int) -> str:
    """Words for a sign of theta."""
    return f"theta {'>' if side > 0 else '<'} 0"


def states(
    value: Any,
    what: str = "thesis minus exact",
    put: Callable[[sp.Expr, int], sp.Expr] = at_side,
    reduce: Callable[[sp.Expr], Any] = sp.simplify,
) -> Find:
    """Check that each relation states a value: an expression, or a function of the sign of theta.

    put : brings what is stated, for a sign of theta, into symbols of the value, in which `reduce`
        makes zero of zero.
    """

    def find(equation: Equation, *relations: sp.Eq) -> Findings:
        for side in equation.sides:
            exact = value(side) if callable(value) else value
            for relation in relations:
                (whole,) = stated(relation)
                yield vanishes(f"{what}, {on_side(side)}", put(whole, side) - exact, reduce)

    return find


def positive(what: str, value: Any) -> Finding:
    """Finding that an expression or a number is positive, of symbols whatever they stand for."""
    return Finding(f"{what} is positive", value, bool(sp.sympify(value).is_positive))


def close(what: str, value: float, stated: float, within: float) -> Finding:
    """Finding that two numbers differ by at most `within`, absolutely."""
    difference = abs(float(value) - float(stated))
    return Finding(f"{what}: {value:.6g} for {stated:.6g}", difference, difference <= within)
