"""SymPy expressions to lines of Python: named symbols, common subexpressions, wrapped lines."""

import textwrap
from collections.abc import Mapping
from functools import lru_cache

import sympy as sp
from sympy.printing.pycode import PythonCodePrinter

WIDTH = 96


class _Printer(PythonCodePrinter):
    """Python of the standard library alone."""

    def _print_Max(self, expr):
        return f"max({', '.join(self._print(a) for a in expr.args)})"


_PRINTER = _Printer({"fully_qualified_modules": True})


@lru_cache(maxsize=4096)  # a comment shows the value of a constant wherever it is read
def python(expr: sp.Expr) -> str:
    return _PRINTER.doprint(expr)


def assign(name: str, code: str, indent: str) -> list[str]:
    """`name = code`, wrapped where it is long; breaks stand at blanks, so before an operator."""
    line = f"{indent}{name} = {code}"
    if len(line) <= WIDTH:
        return [line]
    inner = indent + "    "
    parts = textwrap.wrap(code, WIDTH - len(inner), break_long_words=False, break_on_hyphens=False)
    return [f"{indent}{name} = (", *(inner + part for part in parts), f"{indent})"]


def statements(targets: Mapping[str, sp.Expr], indent: str) -> tuple[list[str], int, int]:
    """Assignments to the targets, shared parts first: (lines, operations before, after)."""
    expressions = tuple((name, sp.sympify(e)) for name, e in targets.items())
    lines, before, after = _statements(expressions, indent)
    return list(lines), before, after


@lru_cache(maxsize=512)  # many transitions set states alike
def _statements(
    targets: tuple[tuple[str, sp.Expr], ...], indent: str
) -> tuple[tuple[str, ...], int, int]:
    names, exprs = [name for name, _ in targets], [e for _, e in targets]
    before = sum(int(sp.count_ops(e)) for e in exprs)
    shared, reduced = sp.cse(exprs, order="canonical")
    lines: list[str] = []
    for symbol, value in shared:
        lines += assign(str(symbol), python(value), indent)
    for name, value in zip(names, reduced, strict=True):
        lines += assign(name, python(value), indent)
    after = sum(int(sp.count_ops(e)) for e in [v for _, v in shared] + list(reduced))
    return tuple(lines), before, after
