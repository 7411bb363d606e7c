"""The beginning of each page: symbols, functions and constants; and energies of a mode."""

import re
from collections.abc import Iterable

import sympy as sp

from rockeom.symbolic.algebra import SIDE, angles_in
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import NamedFunction
from rockeom.symbolic.text.page import Block, Display, Heading, Table
from rockeom.symbolic.write.notation import Notation
from rockeom.symbolic.write.polar import polar_parameters


def symbols_of(
    model: HybridModel, polar: bool, signs: Iterable[tuple[sp.Symbol, str]] = ()
) -> list[Block]:
    notation = Notation(model.modes[0], model)
    header = ("Symbol", "Name", "Unit", "Meaning")

    def row(symbol: sp.Symbol, name: str, unit: str, meaning: str) -> tuple[str, ...]:
        unit = re.sub(r"(?<=[a-z])[23]", lambda m: {"2": "²", "3": "³"}[m[0]], unit)
        return f"${notation.plain(symbol)}$", name and f"`{name}`", unit, meaning

    rows = [row(c.position, c.name, c.unit, c.meaning) for c in model.coordinates]
    rows += [row(z.symbol, z.name, z.unit, z.meaning) for z in model.internal]
    rows += [row(p.symbol, p.name, p.unit, p.meaning) for p in model.parameters]
    unit = "m/s2" if model.modes[0].gravity.free_symbols else "g"
    *across, _ = model.shaking
    words = ["horizontal ground acceleration, positive to the right"]
    if len(across) > 1:
        words = [f"{which} horizontal ground acceleration" for which in ("first", "second")]
    words.append("vertical ground acceleration, positive upwards")
    rows += [row(a, "", unit, meaning) for a, meaning in zip(model.shaking, words, strict=True)]
    if any(mode.has_side for mode in model.modes):
        side = rf"\operatorname{{sgn}} {notation.plain(model.rotation.position)}"
        rows.append(row(SIDE, "", "-", f"side, ${side}$"))
    rows += [row(symbol, "", "-", meaning) for symbol, meaning in signs]
    blocks: list[Block] = [
        Heading(2, "Symbols"),
        Table(header, tuple(rows)),
        "Dots denote derivatives with respect to time.",
    ]
    blocks += _functions(model, notation)
    derived = [(d.symbol, d.name, d.unit, d.meaning, d.value) for d in model.definitions]
    if polar:
        derived += [(p.symbol, "", p.unit, p.meaning, e) for p, e in polar_parameters(model)]
    known: dict[sp.Symbol, sp.Expr] = {}
    lines = []
    for symbol, *_, value in derived:
        lines.append(f"{notation.plain(symbol)} = {notation.plain(_in_terms_of(known, value))}")
        known[symbol] = value
    if derived:
        table = Table(header, tuple(row(*words) for *words, _ in derived))
        blocks += ["Constants that follow from these:", table, Display(tuple(lines))]
    return blocks


def _functions(model: HybridModel, notation: Notation) -> list[Block]:
    """Functions of the coordinates that the equations name, written out."""
    if not model.functions:
        return []
    rows = tuple(
        (f"${notation.plain(x.symbol)}$", f"`{x.name}`", x.unit, x.meaning) for x in model.functions
    )
    q = notation.plain(model.rotation.position)
    constant = [f for f in model.functions if f.symbol.is_Symbol and f.unit == "m"]  # in positions
    text = f"Functions that the equations name; a prime is a derivative with respect to ${q}$."
    for f in constant:
        symbol = notation.plain(f.symbol)
        text += f" Lagrange's equations take ${symbol}$ as a constant at each instant."
    table = Table(("Symbol", "Name", "Unit", "Meaning"), rows)
    whole = [f for f in model.functions if not isinstance(f.value, sp.Piecewise)]
    lines = (f"{notation.plain(x.symbol)} = {notation.plain(x.value)}" for x in whole)
    pieces = [_pieces(f, notation) for f in model.functions if f not in whole]
    return [text, table, Display(tuple(lines)), *pieces]


def _pieces(function: NamedFunction, notation: Notation) -> str:
    """A function in pieces, each below a limit and the last one beyond all, as a sentence."""
    words = []
    for value, holds in function.value.args:
        limit = "beyond" if holds == True else f"for ${notation.plain(holds.lhs)}$ below "  # noqa: E712
        limit += "" if holds == True else f"${notation.plain(holds.rhs)}$"  # noqa: E712
        words.append(f"${notation.plain(value)}$ {limit}")
    return f"${notation.plain(function.symbol)}$ is {', '.join(words)}."


def _in_terms_of(known: dict[sp.Symbol, sp.Expr], expr: sp.Expr) -> sp.Expr:
    """`expr`, the angles in it written by the constants known before where that is shorter."""
    for symbol, value in known.items():
        for angle in angles_in(expr):
            ratio = sp.cancel(angle / value)
            if ratio.count_ops() + 1 < angle.count_ops():
                expr = expr.subs(angle, ratio * symbol)
    return expr


def listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def energies(mode: Mode, notation: Notation) -> list[Block]:
    """The energies that are not zero."""
    equations = mode.equations
    lines = [
        f"T = {notation.write(equations.kinetic_energy)}",
        f"V_g = {notation.write(equations.gravitational_energy)}",
        f"V_e = {notation.plain(equations.elastic_energy)}",
        f"D = {notation.plain(mode.dissipation_function)}",
    ]
    lines = [line for line in lines if not line.endswith(" = 0")]
    return [Display(tuple(lines))] if lines else []
