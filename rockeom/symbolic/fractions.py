"""SymPy's `cancel`, `together` and `expand` for the large expressions of a derivation.

Each gives the same as SymPy's, to the letter. It takes seconds where SymPy takes minutes, since
equal parts of an expression are handled once, in sparse polynomials.
"""

from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.polys.domains import QQ, ZZ
from sympy.polys.fields import FracField
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing


def cancelled(expr: sp.Expr) -> sp.Expr:
    """The same as `sympy.cancel`: one fraction in lowest terms, which is unique.

    SymPy brings a sum of fractions over the product of all denominators and expands that before it
    divides by what both have in common, which takes minutes where fractions contain fractions.
    Here each part is brought to lowest terms before it enters the next. The square of a root is no
    root, which polynomials do not know: where a root remains, SymPy cancels.
    """
    generators = {_root(x) if x.is_Pow else x for x in _leaves(expr, _is_power)}
    if not generators or not all(map(_is_known, generators)):
        return sp.cancel(expr)
    ordered = sp.Poly(sp.Add(*generators)).gens  # in SymPy's order, which decides on signs
    found = _Values(FracField(ordered, ZZ, lex), _sum_of_fractions).of(expr)
    monomials = (*found.numer, *found.denom)
    remain = {x for m in monomials for x, n in zip(ordered, m, strict=True) if n}
    if any(x.is_Pow for x in remain):
        return sp.cancel(expr)
    return found.numer.as_expr() / found.denom.as_expr()


@lru_cache(maxsize=4096)  # sums of quotients have few denominators, each many times
def over_one_denominator(expr: sp.Expr) -> sp.Expr:
    """The same as `sympy.together`."""
    if expr.is_Atom or expr.is_Function:
        return expr
    if expr.is_Pow:
        return expr.func(over_one_denominator(expr.base), expr.exp)
    parts = list(map(over_one_denominator, expr.args))
    return sp.gcd_terms(parts) if expr.is_Add else expr.func(*parts)


MOST_GENERATORS = 40
"""With more of them the exponents of each product take longer than SymPy's expansion."""


def expanded(expr: sp.Expr) -> sp.Expr:
    """The same as `sympy.expand`. Terms that are products already are left aside."""
    generators = _leaves(expr, _is_product)
    if not all(map(_stays, generators)):
        return sp.expand(expr)
    if any(x.is_Pow and x.base.is_Add for x in generators):
        return _expanded_above(expr, generators)
    sums = [term for term in sp.Add.make_args(expr) if not _has_no_sum(term)]
    if not sums:
        return expr
    products = [term for term in sp.Add.make_args(expr) if _has_no_sum(term)]
    return sp.Add(*products, _expanded_above(sp.Add(*sums), generators))


def _expanded_above(expr: sp.Expr, generators: set[sp.Expr]) -> sp.Expr:
    """Expansion by SymPy, which multiplies out a product in a denominator, too."""
    if not 0 < len(generators) <= MOST_GENERATORS:
        return sp.expand(expr)
    ring = _ring(frozenset(generators))
    found = _Values(ring, sum).of(expr)
    below = [i for i, x in enumerate(ring.symbols) if x.is_Pow]
    sums = [i for i in below if ring.symbols[i].base.is_Add]
    for monomial, number in found.iterterms() if sums else ():
        product = number.denominator != 1 or sum(monomial[i] for i in below) > 1
        if product and any(monomial[i] for i in sums):
            return sp.expand(expr)
    return found.as_expr()


def _has_no_sum(term: sp.Expr) -> bool:
    """Whether no factor of a term is a sum or the power of one."""
    factors = sp.Mul.make_args(term)
    return not any(f.is_Add or (f.is_Pow and f.base.is_Add) for f in factors)


@lru_cache(maxsize=4096)  # denominators are sums, and each is in many expressions
def _stays(part: sp.Expr) -> bool:
    """Whether nothing in a part can be expanded, nor in its powers."""
    root = part.is_Pow and not part.exp.is_Integer
    return part.is_Symbol or (not root and sp.expand(part) == part)


@lru_cache(maxsize=256)
def _ring(generators: frozenset[sp.Expr]) -> PolyRing:
    return PolyRing(tuple(sorted(generators, key=sp.default_sort_key)), QQ, lex)


def _is_known(generator: sp.Expr) -> bool:
    """Whether SymPy takes it for a generator as it stands."""
    if generator.is_Function:
        return isinstance(generator, sp.sin | sp.cos) and sp.expand(generator) == generator
    return generator.is_Symbol or generator.is_Pow


def _is_power(power: sp.Pow) -> bool:
    return power.exp.is_Integer


def _is_product(power: sp.Pow) -> bool:
    return power.exp.is_Integer and power.exp > 0


def _leaves(expr: sp.Expr, inside: Callable[[sp.Pow], bool]) -> set[sp.Expr]:
    """The parts of which an expression is made by sums, products and powers.

    inside : whether a power is such a one, and no part itself.
    """
    found, seen, waiting = set(), set(), [expr]
    while waiting:
        part = waiting.pop()
        if part in seen or part.is_Rational:
            continue
        seen.add(part)
        if part.is_Add or part.is_Mul:
            waiting += part.args
        elif part.is_Pow and inside(part):
            waiting.append(part.base)
        else:
            found.add(part)
    return found


def _root(power: sp.Pow) -> sp.Expr:
    """The root of which a rational power is an integer one; of others, itself."""
    return sp.Pow(power.base, sp.Rational(1, power.exp.q)) if power.exp.is_Rational else power


class _Values:
    """Values of expressions in a ring or a field; that of each part is computed once.

    total : the sum of some values.
    """

    def __init__(self, of: Any, total: Callable[[Iterable[Any]], Any]) -> None:
        self.ground, self.total = of.ground_new, total
        self.known = dict(zip(of.symbols, of.gens, strict=True))

    def of(self, expr: sp.Expr) -> Any:
        if expr not in self.known:
            self.known[expr] = self._made(expr)
        return self.known[expr]

    def _made(self, expr: sp.Expr) -> Any:
        if expr.is_Rational:
            return self.ground(expr)
        if expr.is_Add:
            return self.total(map(self.of, expr.args))
        if expr.is_Mul:
            return sp.prod(map(self.of, expr.args))
        if expr.exp.is_Integer:
            return self.of(expr.base) ** int(expr.exp)
        return self.of(_root(expr)) ** expr.exp.p


def _sum_of_fractions(fractions: Iterable[Any]) -> Any:
    """Sum of fractions, equal denominators first: most have one of few, and divisors are costly."""
    above: dict[Any, Any] = {}
    for x in fractions:
        above[x.denom] = above.get(x.denom, 0) + x.numer
        field = x.field
    parts = (field.new(numer, denom) for denom, numer in above.items() if numer)
    return sum(parts, field.zero)
