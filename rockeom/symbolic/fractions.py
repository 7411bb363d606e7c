"""Rational expressions in lowest terms, by arithmetic of fractions of polynomials."""

from functools import lru_cache

import sympy as sp
from sympy.polys.domains import ZZ
from sympy.polys.fields import FracElement, FracField
from sympy.polys.orderings import lex


def cancelled(expr: sp.Expr) -> sp.Expr:
    """The same as `sympy.cancel`: one fraction in lowest terms, which is unique.

    SymPy brings a sum of fractions over the product of all denominators and expands that before it
    divides by what both have in common, which takes minutes where fractions contain fractions.
    Here each part is brought to lowest terms before it enters the next. The square of a root is no
    root, which polynomials do not know: where a root remains, SymPy cancels.
    """
    generators = _generators(expr)
    if not generators or not all(map(_is_known, generators)):
        return sp.cancel(expr)
    ordered = sp.Poly(sp.Add(*generators)).gens  # in SymPy's order, which decides on signs
    fractions = _Fractions(ordered)
    found = fractions.of(expr)
    if not all(x.is_Symbol or x.is_Function for x in fractions.used_by(found)):
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


def _is_known(generator: sp.Expr) -> bool:
    """Whether SymPy takes it for a generator as it stands."""
    if generator.is_Function:
        return isinstance(generator, sp.sin | sp.cos) and generator.expand() == generator
    return generator.is_Symbol or generator.is_Pow


def _generators(expr: sp.Expr) -> set[sp.Expr]:
    """Symbols, functions and roots of which an expression is a fraction of polynomials."""
    found, seen, waiting = set(), set(), [expr]
    while waiting:
        part = waiting.pop()
        if part in seen or part.is_Rational:
            continue
        seen.add(part)
        if part.is_Add or part.is_Mul:
            waiting += part.args
        elif part.is_Pow and part.exp.is_Integer:
            waiting.append(part.base)
        else:
            found.add(_root(part) if part.is_Pow and part.exp.is_Rational else part)
    return found


def _root(power: sp.Pow) -> sp.Expr:
    """The root of which a rational power is an integer one."""
    return sp.Pow(power.base, sp.Rational(1, power.exp.q))


class _Fractions:
    """Values of expressions in the field of fractions; that of each part is computed once."""

    def __init__(self, generators: tuple[sp.Expr, ...]) -> None:
        self.generators = generators
        self.field = FracField(generators, ZZ, lex)
        self.known = dict(zip(generators, self.field.gens, strict=True))

    def used_by(self, fraction: FracElement) -> set[sp.Expr]:
        """The generators that it contains."""
        monomials = (*fraction.numer, *fraction.denom)
        return {x for m in monomials for x, n in zip(self.generators, m, strict=True) if n}

    def of(self, expr: sp.Expr) -> FracElement:
        """The fraction that an expression is."""
        if expr not in self.known:
            self.known[expr] = self._made(expr)
        return self.known[expr]

    def _made(self, expr: sp.Expr) -> FracElement:
        if expr.is_Rational:
            return self.field.raw_new(self.field.ring(expr.p), self.field.ring(expr.q))
        if expr.is_Add:
            return self._sum(map(self.of, expr.args))
        if expr.is_Mul:
            return sp.prod(map(self.of, expr.args))
        if expr.exp.is_Integer:
            return self.of(expr.base) ** int(expr.exp)
        return self.of(_root(expr)) ** expr.exp.p

    def _sum(self, fractions) -> FracElement:
        """Those of one denominator first: most have one of few, and a common divisor is costly."""
        above: dict = {}
        for x in fractions:
            above[x.denom] = above.get(x.denom, self.field.ring.zero) + x.numer
        parts = (self.field.new(numer, denom) for denom, numer in above.items() if numer)
        return sum(parts, self.field.zero)
