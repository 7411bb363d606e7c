"""Sine and cosine of an angle, computed together: where the function is called."""

from collections.abc import Mapping

import sympy as sp

from rockeom.codegen.printer import python
from rockeom.symbolic.algebra import angles_in


def named_angles(exprs: Mapping[str, sp.Expr]) -> tuple[dict[str, sp.Expr], dict[sp.Expr, str]]:
    """The expressions with names for sines and cosines, and the name of each angle."""
    angles = {a for e in exprs.values() for a in angles_in(e)}
    names: dict[sp.Expr, str] = {}
    for angle in sorted(angles, key=sp.default_sort_key):
        plain = angle.is_Symbol and not str(angle).endswith("_")
        names[angle] = str(angle) if plain else f"angle_{len(names)}"
    named = {sp.sin(a): sp.Symbol(f"sin_{n}") for a, n in names.items()}
    named |= {sp.cos(a): sp.Symbol(f"cos_{n}") for a, n in names.items()}
    return {k: e.xreplace(named) for k, e in exprs.items()}, names


def assigned_angles(names: Mapping[sp.Expr, str], indent: str) -> list[str]:
    """Lines that find the sine and cosine of each angle."""
    return [
        f"{indent}sin_{name}, cos_{name} = sine_cosine({python(angle)})"
        for angle, name in names.items()
    ]
