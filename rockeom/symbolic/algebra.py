"""The few rules by which derived expressions are brought to a short, unique form."""

from collections.abc import Callable, Iterable
from functools import lru_cache
from math import comb, prod

import numpy as np
import sympy as sp
from sympy.utilities.iterables import sift

from rockeom.symbolic.fractions import cancelled, expanded, over_one_denominator

SIDE = sp.Symbol("s", real=True)
"""s = sgn(theta): +1 when the structure turns about its right edge, -1 about its left one."""


def at_side(expr: sp.Expr, side: int) -> sp.Expr:
    return sp.sympify(expr).subs(SIDE, side)


def square_is(expr: sp.Expr, base: sp.Expr, square: sp.Expr) -> sp.Expr:
    """Replace base**2 by `square` in every integer power of `base`."""
    squares = {
        p: square ** (p.exp // 2) * base ** (p.exp % 2)
        for p in expr.atoms(sp.Pow)
        if p.base == base and p.exp.is_Integer and p.exp > 1
    }
    return expr.xreplace(squares) if squares else expr


def slopes(expr: sp.Expr, by: Iterable[sp.Symbol]) -> list[sp.Expr]:
    """The derivatives by some symbols: of the terms of a large structure each is in few."""
    containing: dict[sp.Symbol, list[sp.Expr]] = {x: [] for x in by}
    for term in sp.Add.make_args(expr):
        for x in term.free_symbols & containing.keys():
            containing[x].append(term)
    return [sp.Add(*(_slope(e, x) for e in terms)) for x, terms in containing.items()]


def _slope(term: sp.Expr, x: sp.Symbol) -> sp.Expr:
    """The derivative of a term, of which as a rule one factor alone moves."""
    moving, still = sift(sp.Mul.make_args(term), lambda e: x in e.free_symbols, binary=True)
    if len(moving) > 1 or (slope := sp.diff(moving[0], x)).is_Add:
        return sp.diff(term, x)
    return sp.Mul(*still, slope)


def angles_in(expr: sp.Expr) -> list[sp.Expr]:
    found = {f.args[0] for f in expr.atoms(sp.sin, sp.cos)}
    return sorted(found, key=sp.default_sort_key)


MOST_TERMS = 110
"""An expression with more terms stays a sum of products: expanded, it would take minutes and
megabytes where two bodies turn on one another, and no term would cancel. Others have up to 103."""


@lru_cache(maxsize=65536)  # the same factors occur in all entries of a matrix
def number_of_terms(expr: sp.Expr) -> int:
    """The number of terms of an expanded expression, before any of them cancel."""
    if expr.is_Add:
        return sum(map(number_of_terms, expr.args))
    if expr.is_Mul:
        return prod(map(number_of_terms, expr.args))
    if expr.is_Pow and expr.exp.is_Integer and expr.exp > 0:
        terms, power = number_of_terms(expr.base), int(expr.exp)
        return comb(terms + power - 1, power)
    return 1


@lru_cache(maxsize=4096)  # models are derived again and again in a session
def tidy(expr: sp.Expr) -> sp.Expr:
    """Expand, use s**2 = 1 and, for each angle, sin**2 + cos**2 = 1; the shorter of both ways.

    Hyperbolic sines are written as tanh cosh: the slope of log(cosh) comes out as tanh.
    On the polynomials in sines and cosines that positions of bodies give this is a normal
    form: an expression that is identically zero comes out as zero.
    """
    expr = sp.sympify(expr)
    if expr.has(sp.sinh):
        expr = expr.replace(sp.sinh, lambda a: sp.tanh(a) * sp.cosh(a))
    expr = square_is(expanded(expr), SIDE, sp.Integer(1))
    for angle in angles_in(expr):
        sin, cos = sp.sin(angle), sp.cos(angle)
        if not any(p.base in (sin, cos) and p.exp.is_Integer for p in expr.atoms(sp.Pow)):
            continue  # no square to write as the other's
        ways = [
            expanded(square_is(expr, sin, 1 - cos**2)),
            expanded(square_is(expr, cos, 1 - sin**2)),
        ]
        expr = min(ways, key=sp.count_ops)
    return square_is(expr, SIDE, sp.Integer(1))


@lru_cache(maxsize=4096)  # minors are minors of minors
def determinant(matrix: sp.ImmutableMatrix, short: Callable[[sp.Expr], sp.Expr] = tidy) -> sp.Expr:
    """The determinant by the row with the fewest entries: constraints, and storeys, have few.

    short : what is done with each minor; left as they come, they grow with every row.
    """
    n = matrix.rows
    if n == 0:
        return sp.S.One
    row = min(range(n), key=lambda i: sum(e != 0 for e in matrix[i, :]))
    total = sp.S.Zero
    for j in range(n):
        if matrix[row, j] != 0:
            minor = determinant(matrix.minor_submatrix(row, j), short)
            total += (-1) ** (row + j) * matrix[row, j] * minor
    return short(total)


def truncated(expr: sp.Expr, small: tuple[sp.Symbol, ...], order: int) -> sp.Expr:
    """Taylor polynomial of `expr` of the given total order in the `small` symbols."""
    scale = sp.Symbol("epsilon", positive=True)
    scaled = sp.sympify(expr).subs({x: scale * x for x in small}, simultaneous=True)
    total = sp.Integer(0)
    for k in range(order + 1):
        total += sp.diff(scaled, scale, k).subs(scale, 0) / sp.factorial(k)
    return sp.expand(total)


# -- where contacts slip, and by random values ---------------------------------------------------


def brief(expr: sp.Expr) -> sp.Expr:
    """`tidy`, and the square of a sign of slip is 1; an expression of too many terms stays."""
    expr = sp.sympify(expr)
    if number_of_terms(expr) > MOST_TERMS:
        return expr
    expr = tidy(expr)
    for symbol in sorted(expr.free_symbols, key=str):
        if str(symbol).startswith(r"\sigma"):
            expr = square_is(expr, symbol, sp.S.One)
    return expr


def inverted(matrix: sp.Matrix) -> sp.Matrix:
    """The inverse by determinants: entries are short."""
    if matrix.rows == 0:
        return matrix
    n, divisor = matrix.rows, determinant(matrix.as_immutable(), brief)

    def entry(i: int, j: int) -> sp.Expr:
        minor = determinant(matrix.minor_submatrix(j, i).as_immutable(), brief)
        return quotient((-1) ** (i + j) * minor, divisor)

    return sp.Matrix(n, n, entry)


def quotient(above: sp.Expr, below: sp.Expr) -> sp.Expr:
    """One over the other, short: what divides it is a product as a rule."""
    above = sp.expand(above)
    for sign in (1, -1):
        if above == sign * below:
            return sp.Integer(sign)
    return above / below if below.is_Add else sp.expand(above / below)


def together(expr: sp.Expr) -> sp.Expr:
    above, below = sp.fraction(over_one_denominator(expr))
    return positive_below(cancelled(brief(above) / brief(below)))


def positive_below(expr: sp.Expr) -> sp.Expr:
    """A quotient, factored, whose denominator is positive where nothing slips."""
    above, below = sp.fraction(expr)
    slips = {x: 0 for x in below.free_symbols if str(x).startswith(r"\sigma")}
    sign = -1 if below.subs(slips).could_extract_minus_sign() else 1
    return sp.factor(sign * above) / sp.expand(sign * below)


def vanishes(expr: sp.Expr) -> bool:
    """Whether an expression is zero whatever its symbols are.

    Square roots may hide it, and products that are not expanded.
    """
    plain = not expr.atoms(sp.Pow, sp.atan) and number_of_terms(expr) <= MOST_TERMS
    if expr == 0 or plain:
        return expr == 0
    rng = np.random.default_rng(3)
    symbols = sorted(expr.free_symbols, key=str)
    for _ in range(3):
        put = {x: sp.Float(rng.uniform(0.5, 1.5), 30) for x in symbols}
        if abs(sp.N(expr.subs(put), 30)) > 1e-20:
            return False
    return True


def rank(matrix: sp.Matrix) -> int:
    """Rank at random values of all symbols."""
    rng = np.random.default_rng(1)
    symbols = sorted(matrix.free_symbols, key=str)
    put = {x: sp.Float(rng.uniform(0.5, 1.5)) for x in symbols}
    found = np.array(matrix.subs(put).tolist(), dtype=float)
    return int(np.linalg.matrix_rank(found, tol=1e-9))
