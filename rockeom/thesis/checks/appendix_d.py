"""Checks of the equations of Appendix D that the engine alone does not decide."""

import cmath

import numpy as np
import sympy as sp

from rockeom.symbolic.model import GROUND_X, GROUND_Y, turned
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks.check import Checks, Findings, close, derived, vanishes
from rockeom.thesis.checks.engine import MODE, coefficients, residual, shipped
from rockeom.thesis.comparison import PIER, at_side, in_engine_notation, normal_form
from rockeom.thesis.equation import Equation

MODEL_C = "flexible_structure"

# --- Lagrange's equation in time: SymPy differentiates by it, the engine knows rates instead

theta_t, u_t = sp.Function("theta")(th.t), sp.Function("u")(th.t)
IN_TIME = {
    th.theta: theta_t,
    th.u: u_t,
    th.theta_d: theta_t.diff(th.t),
    th.u_d: u_t.diff(th.t),
}
AT_ONE_TIME = {
    theta_t.diff(th.t, 2): th.theta_dd,
    u_t.diff(th.t, 2): th.u_dd,
    theta_t.diff(th.t): th.theta_d,
    u_t.diff(th.t): th.u_d,
    theta_t: th.theta,
    u_t: th.u,
}


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
    """One turn after another, and the argument of a complex number."""
    axis = ("D-9", "D-10").index(equation.number)
    for side in equation.sides:
        first = turned((0, 1), (0, 0), th.A_angle)
        twice = turned(first, (0, 0), side * th.B_angle)
        stated = at_side(relation.rhs, side)
        yield vanishes("right side minus two turns", stated - twice[axis], sp.expand)
        whole = cmath.exp(1j * (1.3 + side * 0.4))
        value = at_side(relation.lhs, side).subs({th.A_angle: 1.3, th.B_angle: 0.4})
        yield close("left side at 1.3 and 0.4", value, (whole.imag, whole.real)[axis], 1e-14)


# --- the first-order form

RATES = (th.y_1d, th.y_2d, th.y_3d, th.y_4d)


def _first_order(equation: Equation, relation: sp.Eq) -> Findings:
    """Its rows are D-28; at states chosen at random the solution is the engine's acceleration."""
    rows = sp.Matrix([x.lhs - x.rhs for x in EQUATIONS["D-28"].right])
    matrix, right = sp.linear_eq_to_matrix(list(rows), RATES)
    whole = {th.M_matrix: matrix, th.y_d_column: sp.Matrix(RATES), th.f_column: right}
    left, column = (side.subs(whole).doit() for side in (relation.lhs, relation.rhs))
    for i, row in enumerate(sp.Matrix(left - column) - rows, 1):
        yield vanishes(f"row {i} minus that of D-28", row, sp.expand)
    rng = np.random.default_rng(27)
    for side in equation.sides:
        model = shipped(MODEL_C)
        symbols = coefficients(model, side)
        exact = model.equations(MODE[side])
        systems = [
            sp.Matrix(matrix.applyfunc(lambda e, s=side, k=symbols: in_engine_notation(e, s, k))),
            sp.Matrix(right.applyfunc(lambda e, s=side, k=symbols: in_engine_notation(e, s, k))),
            exact.mass_matrix,
            exact.forcing,
        ]
        free = sorted(set().union(*(e.free_symbols for e in systems)), key=str)
        n = {x: rng.uniform(0.5, 2.0) for x in free} | {GROUND_Y: 0.0, GROUND_X: -1.3}
        n |= {PIER["theta"]: side * 0.2, PIER["u"]: 0.1}
        for radius, height in ((th.R_e, "height"), (th.R_b, "base_height")):
            n[radius] = np.hypot(n[PIER["half_width"]], n[PIER[height]])
        m, f, inertia, forcing = (
            np.array(sp.Matrix(e.subs(n)).tolist(), dtype=float) for e in systems
        )
        solved, (turning, deforming) = np.linalg.solve(m, f), np.linalg.solve(inertia, forcing)
        wanted = (n[PIER["u_dot"]], deforming[0], n[PIER["theta_dot"]], turning[0])
        for i, (a, b) in enumerate(zip(solved[:, 0], wanted, strict=True), 1):
            yield close(f"rate of y_{i} at a random state", a, b, 1e-10)


_ENGINE = "equations of motion of flexible_structure"

CHECKS: Checks = {
    "D-5": derived(f"with D-14, D-15, D-17 and D-18: {_ENGINE}", _lagrange),
    "D-9": derived("one turn after another; complex numbers", _sum_of_angles),
    "D-10": derived("one turn after another; complex numbers", _sum_of_angles),
    "D-27": derived(f"D-28 in matrices; solved: {_ENGINE}", _first_order),
}
