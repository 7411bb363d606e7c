"""The beginning of a mode, which shows whether it is the one that follows."""

from collections.abc import Mapping
from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.algebra import brief, determinant, positive_below
from rockeom.symbolic.fractions import cancelled
from rockeom.symbolic.modes.balance import Balance


class Start(NamedTuple):
    """Accelerations and forces, or rates and impulses, with which a mode begins.

    motion : by symbols of accelerations or rates. normal : by point; friction : of a group, by its
    first point.
    """

    motion: dict[sp.Symbol, sp.Expr]
    normal: dict[int, sp.Expr]
    friction: dict[int, sp.Expr]


def from_rest(balance: Balance, place: Mapping[sp.Symbol, sp.Expr]) -> Start:
    """Beginning of a mode from rest at given positions, in closed form.

    Accelerations of all coordinates, normal forces and friction are quotients; where the
    friction is less than friction can be, and no normal force negative, it is what begins.
    """
    of = balance.of
    still = dict(place) | dict.fromkeys(of.qd, sp.S.Zero)
    matrix, forcing, drift = (
        m.applyfunc(lambda e: brief(e.subs(still)))
        for m in (balance.mass_matrix, balance.forcing, of.drift)
    )
    motions = of.motions.applyfunc(lambda e: brief(e.subs(still)))
    m = matrix.rows
    divisor = determinant(matrix.as_immutable(), brief)

    def cofactor(j: int, i: int) -> sp.Expr:
        minor = matrix.minor_submatrix(j, i).as_immutable()
        return (-1) ** (i + j) * determinant(minor, brief)

    above = [brief(sum(cofactor(j, i) * forcing[j] for j in range(m))) for i in range(m)]
    every = (motions * sp.Matrix(m, 1, above) if m else sp.zeros(of.n, 1)) + drift * divisor

    def quotient(expr: sp.Expr) -> sp.Expr:
        expr = sp.expand(brief(expr.subs(still)))
        alone = expr.subs(dict.fromkeys(of.qdd, 0))
        moved = sum(sp.diff(expr, a) * e for a, e in zip(of.qdd, every, strict=True))
        return positive_below(cancelled(brief(alone * divisor + moved) / divisor))

    normal, friction = balance.forces
    return Start(
        dict(zip(of.qdd, map(quotient, of.qdd), strict=True)),
        {i: quotient(e) for i, e in normal.items()},
        {i: quotient(e) for i, e in friction.items()},
    )
