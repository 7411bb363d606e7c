"""An equation of the thesis: as printed and, where that is wrong, as it should be."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property, partial
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.logic.boolalg import Boolean

from rockeom.numbers.checks import require_word
from rockeom.thesis.typeset import written

Relations = tuple[sp.Eq, ...]

BOTH, POSITIVE, NEGATIVE = (1, -1), (1,), (-1,)
"""Signs of theta for which an equation is meant."""


class Kind(Enum):
    """Kind of an equation."""

    MOTION = "equation of motion"
    CLOSED_FORM = "closed form"
    DEFINITION = "definition"
    APPROXIMATION = "approximation"
    RESTITUTION = "restitution"
    FIT = "empirical fit"
    PROCEDURE = "procedure"

    def __call__(
        self, left: Any, *rights: Any, illegible: str = "", **more: Any
    ) -> Callable[..., Equation]:
        """An equation of this kind, to which `section` adds its number, meaning and place.

        Parameters
        ----------
        left : sympy.Expr or Relations
            Left side, or all relations if no right side follows.
        *rights : sympy.Expr
            Right side, and those of further equals signs of a chain.
        illegible : str, optional
            Reason of a form that is restored because nothing legible is printed.
        **more
            Other parameters of `Equation`.
        """
        relations = says(left, *rights) if rights else left
        if illegible:
            return partial(Equation, self, restored=relations, reason=illegible, **more)
        return partial(Equation, self, printed=relations, **more)


@dataclass(frozen=True)
class Domain:
    """Domain in which a printed form is right that is not right in general.

    Parameters
    ----------
    words : str
        Domain in words.
    inside : tuple of sympy.Boolean
        Assumptions on its symbols, such as Q.negative(theta), for each case.
    outside : tuple of sympy.Boolean
        Assumptions on its symbols outside the domain.
    """

    words: str
    inside: tuple[Boolean, ...]
    outside: tuple[Boolean, ...]


@dataclass(frozen=True)
class Equation:
    """Equation of the thesis, in its own symbols. Nothing here is derived.

    Parameters
    ----------
    kind : Kind
        Kind of equation.
    number : str
        Number as in the thesis, with a letter where one number has several lines ("2-8a").
    meaning : str
        Statement of the equation, in words.
    printed : Relations
        One relation for each equals sign; empty where the page is not legible.
    restored : Relations, optional
        Right form where nothing legible is printed.
    correction : dict, optional
        Pieces of a wrong printed form, and what stands for each in the right one.
    reason : str, optional
        Reason of the correction, or of the form that is restored; "" where there is none.
    section : str, optional
        Section of the thesis.
    domain : Domain, optional
        Domain in which a wrong printed form is right all the same; None if nowhere in particular.
    assumption : str, optional
        Choice or assumption of the text in it, which nothing else decides; "" if nothing.
    remark : str, optional
        Facts that a user should know and the equation does not say.
    undetermined : str, optional
        Parts of it that the text leaves open; "" if nothing.
    fitted : str, optional
        What bears out coefficients that the text fitted to data, and how closely; "" if there are
        none.
    units : str, optional
        Units of numbers in its section, "0.505 s, 5155 mm", and of symbols that it counts in one.
    sides : tuple of int, optional
        Signs of theta for which it is meant.
    """

    kind: Kind
    number: str
    meaning: str
    printed: Relations = ()
    restored: Relations = field(default=(), kw_only=True)
    correction: Mapping[sp.Expr, sp.Expr] = field(default_factory=dict, kw_only=True)
    reason: str = field(default="", kw_only=True)
    section: str = field(default="", kw_only=True)
    domain: Domain | None = field(default=None, kw_only=True)
    assumption: str = field(default="", kw_only=True)
    remark: str = field(default="", kw_only=True)
    undetermined: str = field(default="", kw_only=True)
    fitted: str = field(default="", kw_only=True)
    units: str = field(default="", kw_only=True)
    sides: tuple[int, ...] = field(default=BOTH, kw_only=True)

    def __post_init__(self) -> None:
        if bool(self.printed) == bool(self.restored):
            raise ValueError(f"{self.number}: a form is either printed or restored")
        if bool(self.reason) != (self.corrected is not None):
            raise ValueError(f"{self.number}: a reason belongs to a corrected form, and only to it")
        if self.corrected == self.printed:
            raise ValueError(f"{self.number}: the corrected form is the printed one")

    @cached_property
    def corrected(self) -> Relations | None:
        """The right form where it is not the printed one.

        Raises
        ------
        ValueError
            Where a piece that is to be replaced is not in the printed form.
        """
        if not self.correction:
            return self.restored or None
        for piece, right in self.correction.items():
            if replaced(self.printed, {piece: right}) == self.printed:
                raise ValueError(f"{self.number}: {piece} is not in the printed form")
        return replaced(self.printed, self.correction)

    @property
    def right(self) -> Relations:
        """The relations that hold."""
        return self.printed if self.corrected is None else self.corrected

    @property
    def is_erratum(self) -> bool:
        """Whether something legible is printed that is wrong, or is right in a domain only."""
        return bool(self.printed) and self.corrected is not None

    @property
    def chapter(self) -> str:
        """The chapter, 2 to 5, or the appendix, B or D."""
        return self.number.partition("-")[0]

    @property
    def symbols(self) -> tuple[sp.Symbol, ...]:
        """The symbols of both forms, by name."""
        union = set().union(*(r.free_symbols for r in (*self.printed, *(self.corrected or ()))))
        return tuple(sorted(union, key=lambda symbol: symbol.name))

    def lines(self, form: str = "right") -> list[str]:
        """LaTeX of each relation, without delimiters.

        Parameters
        ----------
        form : str, optional
            "right", "printed" or "corrected".

        Returns
        -------
        list of str
            LaTeX of each relation.

        Raises
        ------
        ValueError
            For any other word, and for a form that there is none of.
        """
        forms = {"right": self.right, "printed": self.printed, "corrected": self.corrected}
        require_word("form", form, forms)
        if not forms[form]:
            raise ValueError(f"{self.number} has no {form} form")
        return [written(relation) for relation in forms[form] or ()]

    @property
    def excess(self) -> tuple[sp.Expr, ...]:
        """Printed minus right form of a wrong equation, for each component of each relation.

        The difference is that of the right sides where the left one is one symbol or function,
        else that of left minus right side.
        """
        if not self.is_erratum:
            return ()
        pairs = zip(self.printed, self.right, strict=True)
        components = (zip(stated(a), stated(b), strict=True) for a, b in pairs)
        return tuple(_factored(fractions(a - b)) for each in components for a, b in each)

    @property
    def excess_lines(self) -> list[str]:
        """LaTeX, without delimiters, of the components of the excess that are not zero."""
        return [written(component) for component in self.excess if component != 0]

    def latex(self, form: str = "right") -> str:
        """Relations in one piece, to stand between dollar signs.

        Parameters
        ----------
        form : str, optional
            "right", "printed" or "corrected".

        Returns
        -------
        str
            LaTeX.
        """
        lines = self.lines(form)
        if len(lines) == 1:
            return lines[0]
        return r"\begin{gathered} " + r" \\ ".join(lines) + r" \end{gathered}"

    def _repr_latex_(self) -> str:
        """The equation as Jupyter shows it."""
        return rf"$\displaystyle {self.latex()} \qquad \text{{({self.number})}}$"


def place_of(one: Any) -> tuple[str, int, str]:
    """Where an equation or a figure stands by its number: chapter, number, letter."""
    chapter, _, place = one.number.partition("-")
    digits = place.rstrip("abcd")
    return chapter, int(digits), place[len(digits) :]


def section(
    place: str, entries: Mapping[str, Callable[..., Equation]], **more: Any
) -> tuple[Equation, ...]:
    """The equations of a section of the thesis.

    entries : each under its number and meaning, "4-34 its rate".
    more : parameters that all of them have.
    """
    titles = (title.split(" ", 1) for title in entries)
    return tuple(
        entry(number=number, meaning=meaning, section=place, **more)
        for (number, meaning), entry in zip(titles, entries.values(), strict=True)
    )


def says(left: Any, *rights: Any) -> Relations:
    """left = right, and for a chain left = right_1 = right_2 = ... each with the same left."""
    return tuple(sp.Eq(left, right, evaluate=False) for right in rights)


def replaced(relations: Relations, pieces: Mapping[sp.Expr, sp.Expr]) -> Relations:
    """Relations with other expressions in the places of some; what is not evaluated stays so."""

    def put(expr: sp.Basic) -> sp.Basic:
        if expr in pieces:
            return sp.sympify(pieces[expr])
        args = tuple(map(put, expr.args))
        if args == expr.args:
            return expr
        return expr.func(*args, **{} if expr.func(*expr.args) == expr else {"evaluate": False})

    return tuple(map(put, relations))


def stated(relation: sp.Eq) -> list[sp.Expr]:
    """The value that a relation states, for each component.

    A relation whose left side is a single symbol, or function, gives that a value. Any other states
    that its left minus its right side vanishes.
    """
    named = relation.lhs.is_Symbol or isinstance(relation.lhs, AppliedUndef)
    whole = relation.rhs if named else relation.lhs - relation.rhs
    return list(whole) if isinstance(whole, sp.MatrixBase) else [whole]


def fractions(expr: sp.Expr) -> sp.Expr:
    """An expression with its decimal numbers as fractions, so that equal ones cancel."""
    return expr.xreplace({number: sp.Rational(str(number)) for number in expr.atoms(sp.Float)})


def _factored(expr: sp.Expr) -> sp.Expr:
    """An expression in factors, its functions left as they are."""
    every = sorted(expr.atoms(sp.Function), key=sp.default_sort_key)
    functions = {f: sp.Symbol(f"f_{i:02}") for i, f in enumerate(every)}
    factors = sp.factor(expr.xreplace(functions))
    return factors.xreplace({name: f for f, name in functions.items()})
