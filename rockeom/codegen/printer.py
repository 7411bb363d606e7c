"""SymPy expressions to lines of Python: named symbols, common subexpressions, wrapped lines."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

import sympy as sp
from sympy.printing.pycode import PythonCodePrinter

WIDTH = 96


class _Printer(PythonCodePrinter):
    """Python of the standard library alone."""

    def _print_Max(self, expr):
        return f"max({', '.join(self._print(a) for a in expr.args)})"


_PRINTER = _Printer({"fully_qualified_modules": True})


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
    names, exprs = list(targets), [sp.sympify(e) for e in targets.values()]
    before = sum(int(sp.count_ops(e)) for e in exprs)
    shared, reduced = sp.cse(exprs, order="canonical")
    lines: list[str] = []
    for symbol, value in shared:
        lines += assign(str(symbol), python(value), indent)
    for name, value in zip(names, reduced, strict=True):
        lines += assign(name, python(value), indent)
    after = sum(int(sp.count_ops(e)) for e in [v for _, v in shared] + list(reduced))
    return lines, before, after


def solve_symmetric(n: int, out: Sequence[str], indent: str, known: bool = False) -> list[str]:
    """Lines that solve a symmetric n x n system by L D L^T, written out without loops.

    The entries stand in m00, m10, m11 (lower triangle) and f0, f1. Where the first reciprocal
    pivot is `known`, it stands in r0, and m00 nowhere.
    """
    lines = []
    for j in range(n):
        if j > 0 or not known:
            lines.append(f"r{j} = 1.0 / m{j}{j}")
        for i in range(j + 1, n):
            lines.append(f"l{i}{j} = m{i}{j} * r{j}")
        for i in range(j + 1, n):
            for k in range(j + 1, i + 1):
                lines.append(f"m{i}{k} -= l{i}{j} * m{k}{j}")
            lines.append(f"f{i} -= l{i}{j} * f{j}")
    for i in reversed(range(n)):
        back = "".join(f" - l{k}{i} * {out[k]}" for k in range(i + 1, n))
        lines.append(f"{out[i]} = f{i} * r{i}{back}")
    return [indent + line for line in lines]
