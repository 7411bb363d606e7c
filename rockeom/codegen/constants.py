"""Parts of expressions that depend on parameters alone: named, and computed once by `prepare`."""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp


class Constants:
    """The constants of a module. names : of each, by its expression in parameters."""

    def __init__(self, parameters: Iterable[sp.Symbol]) -> None:
        self.parameters = frozenset(parameters)
        self.names: dict[sp.Expr, sp.Symbol] = {}
        self._fixed: dict[sp.Basic, bool] = {}

    def fixed(self, expr: sp.Basic) -> bool:
        """Whether an expression contains parameters alone."""
        if expr not in self._fixed:
            parts = all(self.fixed(a) for a in expr.args)
            self._fixed[expr] = parts if expr.args else expr.free_symbols <= self.parameters
        return self._fixed[expr]

    def name(self, expr: sp.Expr) -> sp.Expr:
        """A name for an expression in parameters alone; numbers and symbols need none."""
        if expr.is_Atom or expr.is_number:
            return expr
        if expr.could_extract_minus_sign():
            return -self.name(-expr)
        return self.names.setdefault(expr, sp.Symbol(f"c{len(self.names)}"))

    def hoisted(self, expr: sp.Expr) -> sp.Expr:
        """The expression with all parts that depend on parameters alone named as constants."""
        if expr.is_Atom:
            return expr
        if self.fixed(expr):
            return self.name(expr)
        if expr.is_Add or expr.is_Mul:
            fixed = [a for a in expr.args if self.fixed(a)]
            moving = [self.hoisted(a) for a in expr.args if not self.fixed(a)]
            return expr.func(*([self.name(expr.func(*fixed))] if fixed else []), *moving)
        return expr.func(*(self.hoisted(a) for a in expr.args))
