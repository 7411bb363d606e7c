"""Checks of the equations of Appendix D that the engine alone does not decide."""

import sympy as sp

from rockeom.symbolic.model import turned
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks.check import Checks, Findings, derived, vanishes
from rockeom.thesis.checks.engine import MODEL_C, residual, shipped
from rockeom.thesis.comparison import at_side, in_engine_notation, normal_form
from rockeom.thesis.equation import Equation

# --- Lagrange's equation in time: SymPy differentiates by it, the engine knows rates instead

theta_t, u_t = sp.Function("theta")(th.t), sp.Function("u")(th.t)
IN_TIME = {th.theta: theta_t, th.u: u_t, th.theta_d: theta_t.diff(th.t), th.u_d: u_t.diff(th.t)}
AT_ONE_TIME = {theta_t.diff(th.t, 2): th.theta_dd, u_t.diff(th.t, 2): th.u_dd}
AT_ONE_TIME |= {value: symbol for symbol, value in reversed(IN_TIME.items())}


def lagranges_equation(
    statement: sp.Eq, lagrangian: sp.Expr, coordinate: sp.Expr, force: sp.Expr
) -> sp.Expr:
    """D-5, `statement`, for one coordinate: left minus right side, the dissipation that of D-15."""
    (dissipation,) = EQUATIONS["D-15"].right
    left = statement.lhs.subs(th.q_t, coordinate)
    left = left.replace(th.LAGRANGIAN, lambda *_: lagrangian.subs(IN_TIME))
    left = left.replace(th.DISSIPATION, lambda *_: dissipation.rhs.subs(IN_TIME)).doit()
    for derivative, symbol in AT_ONE_TIME.items():
        left = left.subs(derivative, symbol)
    return left - statement.rhs.subs(th.Q_i, force)


def _lagrange(equation: Equation, statement: sp.Eq) -> Findings:
    lagrangian = EQUATIONS["D-14"].right[0].rhs
    for row, (coordinate, force) in enumerate(((theta_t, "D-17"), (u_t, "D-18"))):
        stated = EQUATIONS[force].right[0].rhs
        derived = lagranges_equation(statement, lagrangian, coordinate, stated)
        rest = in_engine_notation(derived, 1) - residual(shipped(MODEL_C), 1, row)
        what = f"D-5 with D-14, D-15 and {force} minus engine, theta > 0"
        yield vanishes(what, rest, normal_form)


# --- angles


def _sum_of_angles(equation: Equation, relation: sp.Eq) -> Findings:
    """One turn after another."""
    axis = ("D-9", "D-10").index(equation.number)
    for side in equation.sides:
        twice = turned(turned((0, 1), (0, 0), th.A_angle), (0, 0), side * th.B_angle)[axis]
        for what, stated in zip(("left", "right"), relation.args, strict=True):
            rest = at_side(stated, side) - twice
            yield vanishes(f"{what} side minus two turns", rest, sp.expand_trig)


# --- the first-order form

RATES = sp.Matrix([th.y_1d, th.y_2d, th.y_3d, th.y_4d])


def _first_order(equation: Equation, relation: sp.Eq) -> Findings:
    """Its rows are those of D-28."""
    rows = sp.Matrix([x.lhs - x.rhs for x in EQUATIONS["D-28"].right])
    matrix, right = sp.linear_eq_to_matrix(list(rows), list(RATES))
    whole = {th.M_matrix: matrix, th.y_d_column: RATES, th.f_column: right}
    left, column = (side.subs(whole).doit() for side in relation.args)
    for i, row in enumerate(sp.Matrix(left - column) - rows, 1):
        yield vanishes(f"row {i} minus that of D-28", row, sp.expand)


_ENGINE = "equations of motion of flexible_structure"

CHECKS: Checks = {
    "D-5": derived(f"with D-14, D-15, D-17 and D-18: {_ENGINE}", _lagrange),
    "D-9": derived("one turn after another", _sum_of_angles),
    "D-10": derived("one turn after another", _sum_of_angles),
    "D-27": derived("D-28 in matrices", _first_order),
}
