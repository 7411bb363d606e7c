"""M x = f written out in plain numbers: accelerations, and rates after an impact."""

from collections.abc import Callable, Sequence

import sympy as sp

from rockeom.codegen.text import Text
from rockeom.symbolic.algebra import MOST_TERMS, SIDE, number_of_terms, slopes, tidy

TOTAL_GRAVITY = sp.Symbol("total_gravity")
"""Gravity and the vertical acceleration of the ground, g + a_y in the plane."""


def solve(
    text: Text,
    function: str,
    matrix: sp.Matrix,
    right: sp.Matrix,
    out: Sequence[str],
    indent: str,
    gravity: sp.Expr | None = None,
    states: bool = True,
) -> list[str]:
    """Lines that solve matrix * x = right for plain numbers, x assigned to the names in `out`.

    Unknowns whose coefficients are constants are eliminated here, symbolically: divisions by
    them are hoisted, and what cancels is gone. Where `gravity` is given, the right-hand
    side is collected by it and by the ground acceleration: weight and vertical shaking act
    alike, as their sum.
    """

    entries, solved = eliminated(text, matrix, right, out, indent, gravity)
    first = {} if gravity is None else {TOTAL_GRAVITY.name: gravity + text.model.shaking[-1]}
    lines = text.evaluate(function, entries, indent, first, hoist=True, states=states)
    return lines + solved


def eliminated(
    text: Text,
    matrix: sp.Matrix,
    right: sp.Matrix,
    out: Sequence[str],
    indent: str,
    gravity: sp.Expr | None = None,
) -> tuple[dict[str, sp.Expr], list[str]]:
    """(what is to be evaluated, by name; the lines behind it that solve), see `solve`."""

    def collected(expr: sp.Expr) -> sp.Expr:
        if gravity is None or number_of_terms(expr) > MOST_TERMS:
            return expr
        sums = by_states(text, expr)
        return _collected(text, expr, gravity) if sums is None else sums

    M, F = matrix.copy(), right.copy()
    left, last = eliminate(text, M, F)
    left.sort(key=lambda j: not text.fixed(M[j, j]))
    entries = {f"m{a}{b}": M[i, j] for a, i in enumerate(left) for b, j in enumerate(left[: a + 1])}
    entries |= {f"f{a}": collected(F[i]) for a, i in enumerate(left)}
    if left and text.fixed(M[left[0], left[0]]):
        del entries["m00"]
        entries["r0"] = 1 / M[left[0], left[0]]
    solved = _symmetric(len(left), [out[i] for i in left], indent, known="r0" in entries)
    for j, value, share in reversed(last):
        apart = "_" if text.n > 10 else ""
        pull = [(f"share_{j}{apart}{i}", out[i], e) for i, e in share.items() if e != 0]
        entries |= {name: e for name, _, e in pull}
        entries[f"{out[j]}_alone" if pull else out[j]] = collected(value)
        if pull:
            taken = "".join(f" - {name} * {x}" for name, x, _ in pull)
            solved.append(f"{indent}{out[j]} = {out[j]}_alone{taken}")
    return entries, solved


def unsymmetric(
    text: Text,
    matrix: sp.Matrix,
    right: sp.Matrix,
    out: Sequence[str],
    indent: str,
    gravity: sp.Expr,
) -> tuple[dict[str, sp.Expr], list[str]]:
    """The same of a matrix that friction makes unsymmetric.

    Unknowns whose rows and columns friction leaves alike are eliminated first: theirs is the
    matrix of a motion without friction, whose pivots are positive. One or two others are found by
    determinants, which may change sign with friction while no pivot would show it.
    """
    n = matrix.rows
    alike = [i for i in range(n) if all(tidy(matrix[i, j] - matrix[j, i]) == 0 for j in range(n))]
    order = [*alike, *(i for i in range(n) if i not in alike)]
    alone = max(n - 2, 0)
    entries = {
        f"m{a}{b}": matrix[i, j]
        for a, i in enumerate(order)
        for b, j in enumerate(order)
    }  # fmt: skip
    entries |= {f"f{a}": _collected(text, right[i], gravity) for a, i in enumerate(order)}
    lines = []
    for j in range(alone):
        lines.append(f"r{j} = 1.0 / m{j}{j}")
        for i in range(j + 1, n):
            lines.append(f"l{i}{j} = m{i}{j} * r{j}")
            lines += [f"m{i}{k} -= l{i}{j} * m{j}{k}" for k in range(j + 1, n)]
            lines.append(f"f{i} -= l{i}{j} * f{j}")
    x = [out[i] for i in order]
    a, b = n - 2, n - 1
    if n == 1:
        lines.append(f"{x[0]} = f0 / m00")
    else:
        lines += [
            f"det_0 = 1.0 / (m{a}{a} * m{b}{b} - m{a}{b} * m{b}{a})",
            f"{x[a]} = (f{a} * m{b}{b} - m{a}{b} * f{b}) * det_0",
            f"{x[b]} = (m{a}{a} * f{b} - f{a} * m{b}{a}) * det_0",
        ]
    for i in reversed(range(alone)):
        back = "".join(f" - m{i}{k} * {x[k]}" for k in range(i + 1, n))
        lines.append(f"{x[i]} = (f{i}{back}) * r{i}")
    return entries, [indent + line for line in lines]


def eliminate(
    text: Text, M: sp.Matrix, F: sp.Matrix
) -> tuple[list[int], list[tuple[int, sp.Expr, dict[int, sp.Expr]]]]:
    """Eliminate from M x = F, in place, the unknowns whose coefficients are constants.

    Returns the unknowns that are left, and for each that is gone: its number, its value alone,
    and the share of each of those left then that is subtracted from it.
    """
    left, last = list(range(M.rows)), []

    def simple(j: int) -> bool:
        return text.fixed(M[j, j]) and all(text.fixed(M[i, j] / M[j, j]) for i in left)

    while (j := next((j for j in left if simple(j)), None)) is not None:
        left.remove(j)
        share = {i: sp.expand(M[i, j] / M[j, j]) for i in left}
        for i in left:
            if share[i] == 0:
                continue
            F[i] = tidy(F[i] - share[i] * F[j])
            for k in left:
                M[i, k] = tidy(M[i, k] - share[i] * M[j, k])
        last.append((j, sp.expand(F[j] / M[j, j]), share))
    return left, last


def by_states(text: Text, expr: sp.Expr) -> sp.Expr | None:
    """An expression as constants by states and horizontal shaking, or None if it is no such sum.

    The processor then waits for one product and one sum after the last state is known.
    """
    states = [x for c in text.model.coordinates for x in (c.position, c.velocity)]
    variables = [*states, *text.model.shaking[:-1]]
    if any(not part.free_symbols.isdisjoint(states) for part in expr.atoms(sp.Function, sp.Pow)):
        return None  # as of most
    factors = []
    for slope in slopes(expr, variables):
        factor = sp.expand(slope)
        if factor.has(*variables) or not text.fixed(factor):
            return None
        factors.append(sp.factor_terms(factor))
    rest = expr.xreplace(dict.fromkeys(variables, sp.S.Zero))
    if not text.fixed(rest):
        return None
    return sp.Add(rest, *(f * x for f, x in zip(factors, variables, strict=True)))


def _collected(text: Text, expr: sp.Expr, gravity: sp.Expr) -> sp.Expr:
    """Collected by angles, then by g and the vertical ground acceleration, and by horizontal ones.

    The factor of a sine is ready while the processor still works on the sine.
    """
    if number_of_terms(expr) > MOST_TERMS:
        return expr
    *horizontal, vertical = text.model.shaking
    expr = sp.expand(expr.subs(vertical, TOTAL_GRAVITY - gravity))
    moving = (f for f in expr.atoms(sp.sin, sp.cos) if not text.fixed(f))

    def by_side(e: sp.Expr) -> sp.Expr:
        return sp.factor_terms(_collect(e, [SIDE]))

    def by_ground(e: sp.Expr) -> sp.Expr:
        return _collect(e, [TOTAL_GRAVITY, *horizontal], by_side)

    return _collect(expr, sorted(moving, key=sp.default_sort_key), by_ground)


def _collect(
    expr: sp.Expr, factors: Sequence[sp.Expr], then: Callable[[sp.Expr], sp.Expr] | None = None
) -> sp.Expr:
    """A sum of products by the power of the first of these factors that each has.

    then : what becomes of what each power is multiplied by. As `sympy.collect`, which looks for
    more than factors and takes a third of the time of a large structure.
    """
    by: dict[sp.Expr, list[sp.Expr]] = {}
    for term in sp.Add.make_args(expr):
        powers = term.as_powers_dict()
        factor = next((f ** powers[f] for f in factors if f in powers), sp.S.One)
        by.setdefault(factor, []).append(term / factor)
    shares = ((factor, sp.Add(*terms)) for factor, terms in by.items())
    return sp.Add(*(factor * (then(e) if then else e) for factor, e in shares))


def _symmetric(n: int, out: Sequence[str], indent: str, known: bool = False) -> list[str]:
    """Lines that solve a symmetric n x n system by L D L^T, written out without loops.

    The entries are m00, m10, m11 (lower triangle) and f0, f1. Where the first reciprocal pivot
    is `known`, r0 holds it, and m00 does not occur.
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
