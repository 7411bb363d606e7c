"""Single items of a declaration: numbers, points, symbols, texts and names.

Each check raises ValueError, which names what is declared, the item and the remedy.
"""

import re
import unicodedata
from collections.abc import Collection, Iterable
from numbers import Real
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.numbers.checks import InputError, require

LONGEST = 100
"""Letters of a name: files are called by it."""


def _commands(names: str) -> frozenset[str]:
    return frozenset(rf"\{name}" for name in names.split())


_LETTERS = _commands("""
    alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi pi
    varpi rho varrho sigma varsigma tau upsilon phi varphi chi psi omega Gamma Delta Theta Lambda Xi
    Pi Sigma Upsilon Phi Psi Omega ell hbar pm prime star ast
    dot ddot dddot hat bar tilde acute grave check breve vec mathring
    mathrm mathit mathbf mathcal mathbb mathfrak mathsf boldsymbol
""")
"""Commands of TeX in symbols: letters, accents and alphabets."""
_NOTATION = _commands("""
    frac tfrac sqrt cdot times le ge leq geq lt gt ne approx infty partial sum int left right text
    operatorname sin cos tan arcsin arccos arctan sinh cosh tanh exp ln log min max quad thinspace
""")
"""Further commands of TeX in the mathematics of a text."""
_SYMBOL = re.compile(r"[\w\\{}', +-]*[^\W\d_][\w\\{}', +-]*")


def expressions(what: str, **items: Any) -> None:
    """Each must be a SymPy expression or a number: text would be run as a program."""
    for item, value in items.items():
        number = isinstance(value, Real) and not isinstance(value, bool)
        if not (number or isinstance(value, sp.Expr)):
            raise InputError(item, value, what).give(
                "a number or a SymPy expression, such as `parameter(...).symbol`"
            )
        require(not sp.sympify(value).has(sp.nan, sp.zoo), what, item, value, "give a finite value")


def points(what: str, axes: Collection[int] = (2,), **items: Any) -> None:
    """Each must be a tuple of expressions, as many as there may be axes."""
    for item, value in items.items():
        if not isinstance(value, tuple) or len(value) not in axes:
            in_space = ", in space (x, y, z)" if 3 in axes else ""
            raise InputError(item, value, what).give(f"a point as (x, y){in_space}")
        places = zip("xyz", value, strict=False)
        expressions(what, **{f"{axis} of {item}": e for axis, e in places})


def matrices(what: str, **items: Any) -> None:
    """Each must be a matrix (3, 3) of expressions."""
    for item, value in items.items():
        if not isinstance(value, sp.MatrixBase) or value.shape != (3, 3):
            raise InputError(item, value, what).give("a matrix of SymPy, 3 by 3, in space")
        rows = {f"entry {i}, {j} of {item}": value[i, j] for i in range(3) for j in range(3)}
        expressions(what, **rows)


def symmetric(what: str, **items: sp.MatrixBase) -> None:
    for item, value in items.items():
        if not value.is_symmetric():
            raise InputError(item, value, what).so("it is not symmetric: give its other half alike")


def corners(what: str, outline: Any) -> None:
    """Three points or more, or none."""
    if not isinstance(outline, tuple) or len(outline) in (1, 2):
        raise InputError("outline", outline, what).says(
            f"its outline is {outline!r}: give three corners (x, y) or more from its centre, such "
            "as `rectangle(half_width, half_height)`"
        )
    points(what, **{f"corner {i} of its outline": corner for i, corner in enumerate(outline)})


def symbols(what: str, **items: Any) -> None:
    for item, value in items.items():
        require(isinstance(value, sp.Symbol), what, item, value, "give a SymPy symbol")
        _typeset(what, value.name)


def _typeset(what: str, name: str) -> None:
    """A symbol becomes a part of documents in LaTeX, and must do nothing there."""
    known = set(re.findall(r"\\[A-Za-z]*", name)) <= _LETTERS
    balanced = name.count("{") == name.count("}")
    if not (_SYMBOL.fullmatch(name) and len(name) <= LONGEST and known and balanced):
        raise InputError("symbol", name, what).says(
            f"the symbol {name[:LONGEST]!r} must consist of letters, digits, _, primes, braces and "
            "TeX's names of letters and accents, such as theta, M_b, k_{f,1} or \\dot{x}, and "
            f"have 1 to {LONGEST} letters"
        )


def texts(what: str, **items: Any) -> None:
    for item, value in items.items():
        require(isinstance(value, str), what, item, value, "give a text")
        for mathematics in re.findall(r"\$([^$]*)\$", value):
            unknown = set(re.findall(r"\\[A-Za-z]+", mathematics)) - _NOTATION - _LETTERS
            if unknown or "^^" in mathematics:
                raise InputError(item, value, what).says(
                    f"the mathematics of {item}, {mathematics!r}, holds "
                    f"{', '.join(sorted(unknown)) or '^^'}: write letters and the usual notation"
                )


def name(what: str, name: Any) -> None:
    """A name must be one that Python's keywords can be, `lambda` and the like included."""
    if not isinstance(name, str) or not name.isidentifier() or len(name) > LONGEST:
        raise InputError("name", name, what).says(
            f"the name {str(name)[:LONGEST]!r} must consist of letters, digits and underscores, "
            f"not begin with a digit, and have 1 to {LONGEST} letters"
        )
    plain = unicodedata.normalize("NFKC", name)
    require(name == plain, what, "name", name, f"give what Python reads, {plain!r}")


def not_negative(what: str, **items: Any) -> None:
    """None may be negative whatever the parameters are."""
    for item, value in items.items():
        if sp.sympify(value).is_negative:
            raise InputError(item, value, what).so("it is negative: give it its other sign")


def laws(what: str, symbol: Any) -> None:
    """The symbol of a named function, a plain one or a function of one coordinate."""
    function = isinstance(symbol, AppliedUndef) and len(symbol.args) == 1
    if not (isinstance(symbol, sp.Symbol) or function):
        raise InputError("symbol", symbol, what).says(
            f"its symbol is {symbol}: give a symbol, or a function of one coordinate"
        )
    _typeset(what, symbol.func.__name__ if function else symbol.name)


def repeated(names: Iterable[Any]) -> list[str]:
    """Items that occur more than once, as texts."""
    names = list(names)
    return sorted({str(n) for n in names if names.count(n) > 1})


def counts(what: str, **items: Any) -> None:
    """Each must be a whole number, from one up."""
    for item, value in items.items():
        if not isinstance(value, int) or isinstance(value, bool) or value < 1:
            raise InputError(item, value, what).give("a whole number of at least 1")
