"""Equations of motion to first order about a state, as matrices."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp

from rockeom.numbers.checks import InputError, near
from rockeom.symbolic.algebra import MOST_TERMS, brief, number_of_terms
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.reading.symbols import Symbols
from rockeom.symbolic.text.shown import Shown


@dataclass(frozen=True, repr=False)
class Linearization(Shown):
    """Equations M x'' + C x' + K x + f0 = F [a_x, a_y] of the deviation x from a state.

    Parameters
    ----------
    q : sympy.Matrix
        Coordinates, whose deviation from the state is x (n, 1).
    M : sympy.Matrix
        Mass matrix (n, n).
    C : sympy.Matrix
        Damping matrix, with gyroscopic terms of a state that moves (n, n).
    K : sympy.Matrix
        Stiffness matrix, with the terms of gravity (n, n).
    f0 : sympy.Matrix
        Constant vector (n, 1): left minus right-hand side in the state, zero in an equilibrium.
        A structure that rocks about a foot has none at zero.
    F : sympy.Matrix
        Input matrix of the ground's accelerations a_x and a_y (n, 2).
    """

    q: sp.Matrix
    M: sp.Matrix
    C: sp.Matrix
    K: sp.Matrix
    f0: sp.Matrix
    F: sp.Matrix

    @cached_property
    def A(self) -> sp.Matrix:
        """System matrix of [x', x''] = A [x, x'] + B [a_x, a_y] + c, as SymPy's (2 n, 2 n)."""
        n = len(self.q)
        rates = self.M.LUsolve(sp.Matrix.hstack(-self.K, -self.C))
        return sp.Matrix.vstack(sp.Matrix.hstack(sp.zeros(n), sp.eye(n)), rates).applyfunc(_short)

    @cached_property
    def B(self) -> sp.Matrix:
        """Input matrix of the state space (2 n, 2)."""
        return sp.Matrix.vstack(sp.zeros(len(self.q), 2), self.M.LUsolve(self.F)).applyfunc(_short)

    @cached_property
    def c(self) -> sp.Matrix:
        """Constant vector of the state space (2 n, 1)."""
        rates = -self.M.LUsolve(self.f0)
        return sp.Matrix.vstack(sp.zeros(len(self.q), 1), rates).applyfunc(_short)

    def equation_lines(self) -> list[str]:
        """LaTeX of the equation, its matrices written out."""
        x, x_dot, x_ddot = r"\Delta q", r"\Delta \dot{q}", r"\Delta \ddot{q}"
        parts = [(self.M, x_ddot), (self.C, x_dot), (self.K, x), (self.f0, "")]
        left = " + ".join(f"{sp.latex(m)} {word}".strip() for m, word in parts if any(m))
        ground = sp.latex(sp.Matrix([GROUND_X, GROUND_Y]))
        return [f"{left} = {sp.latex(self.F)} {ground}"] if self.q else []

    def __repr__(self) -> str:
        return f"<Linearization in {', '.join(map(str, self.q))}>"


def _short(expr: sp.Expr) -> sp.Expr:
    return sp.factor(brief(expr)) if number_of_terms(expr) <= MOST_TERMS else expr


def linearized(
    model: HybridModel, mode: str, op_point: Mapping[Any, Any] | None = None
) -> Linearization:
    """The equations of a mode to first order, see `RockingModel.linearize`."""
    equations = model.equations(mode).map(lambda e: model.in_mode(e, mode))
    put = _state(Symbols.of(model), op_point or {})
    ground = sp.Matrix(model.shaking)

    def here(m: sp.Matrix) -> sp.Matrix:
        return m.xreplace(put).applyfunc(brief)

    residual = equations.residual
    q, u, accelerations = equations.q, equations.u, equations.accelerations
    return Linearization(
        q,
        here(residual.jacobian(accelerations)),
        here(residual.jacobian(u)),
        here(residual.jacobian(q)),
        here(residual),
        here(-residual.jacobian(ground)),
    )


def _state(symbols: Symbols, op_point: Mapping[Any, Any]) -> dict[sp.Symbol, sp.Expr]:
    """Values by symbol of a state, those not named zero."""
    moving = {n for n in symbols if n.endswith("_dot") or n.endswith("_ddot")}
    names = [n for n in symbols if n in moving or f"{n}_ddot" in symbols or n in ("a_x", "a_y")]
    put = {symbols[name]: sp.S.Zero for name in names}
    for key, value in op_point.items():
        symbol = symbols.get(key, key) if isinstance(key, str) else key
        if symbol not in put:
            raise InputError("op_point", of="linearize").says(
                f"{key} is no coordinate, velocity or acceleration{near(str(key), names)}: "
                f"there are {', '.join(names)}"
            )
        if isinstance(value, str):
            raise InputError("op_point", of="linearize").says(
                f"the value of {key} is a text, {value!r}: give a number or an expression of SymPy"
            )
        put[symbol] = sp.sympify(value)
    return put
