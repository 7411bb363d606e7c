"""Thesis and engine brought to one notation, and a comparison that decides exactly.

The thesis places a body by R and alpha, the engine by half-width and height:

    R sin(alpha) = B,    R cos(alpha) = H,    R**2 = B**2 + H**2

The rest are polynomials in sines and cosines; division by sin**2 + cos**2 - 1 decides whether one
is zero. None of the engine's simplification is used for it.
"""

import random
from collections.abc import Mapping
from functools import lru_cache

import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.symbolic import derive
from rockeom.symbolic.model import GROUND_X
from rockeom.symbolic.statics import LOAD
from rockeom.thesis import notation as th
from rockeom.thesis.equation import stated

BLOCK, SLENDER = derive("rigid_block").symbols, derive("slender_block").symbols
SCALED = derive("nondimensional_block").symbols
PIER = derive("flexible_structure").symbols
CART = derive("two_spring_cart").symbols
R, ALPHA = SLENDER["radius"], SLENDER["alpha"]

_weight = (PIER["mass"] + PIER["base_mass"]) * PIER["gravity"]
_centroid = sp.cancel(
    (PIER["mass"] * PIER["height"] + PIER["base_mass"] * PIER["base_height"])
    / (PIER["mass"] + PIER["base_mass"])
)
POLAR = (
    (th.R_e, th.alpha_e, PIER["height"]),
    (th.R_b, th.alpha_b, PIER["base_height"]),
    (th.R_c, th.alpha_c, _centroid),
)
"""Radius and angle in the thesis, height in the engine."""

TO_ENGINE: dict[sp.Symbol, sp.Expr] = {
    th.theta: PIER["theta"],
    th.theta_d: PIER["theta_dot"],
    th.theta_d1: PIER["theta_dot"],
    th.theta_d2: PIER["theta_dot"],
    th.theta_d_impact: PIER["theta_dot"],
    th.theta_dd: PIER["theta_ddot"],
    th.u: PIER["u"],
    th.u_d: PIER["u_dot"],
    th.u_dd: PIER["u_ddot"],
    th.a_g: GROUND_X,
    th.a_gx: GROUND_X,
    th.g: PIER["gravity"],
    th.m: BLOCK["mass"],
    th.R: R,
    th.alpha: ALPHA,
    th.x: SCALED["x"],
    th.x_dd: SCALED["x_ddot"],
    th.I_o: BLOCK["inertia"] + BLOCK["mass"] * R**2,
    th.m_e: PIER["mass"],
    th.H_e: PIER["height"],
    th.I_eg: PIER["inertia"],
    th.m_b: PIER["base_mass"],
    th.H_b: PIER["base_height"],
    th.I_bg: PIER["base_inertia"],
    th.B: PIER["half_width"],
    th.I_O: PIER["inertia"]
    + PIER["mass"] * (PIER["half_width"] ** 2 + PIER["height"] ** 2)
    + PIER["base_inertia"]
    + PIER["base_mass"] * (PIER["half_width"] ** 2 + PIER["base_height"] ** 2),
    th.k: PIER["stiffness"],
    th.c: PIER["damping"],
    th.k_f: CART["foundation_stiffness"],
    th.W: _weight,
    th.H_c: _centroid,
    th.P: LOAD,
    th.u_crit: CART["lift_off"],
    th.P_crit2: CART["lift_off_force"],
    th.u_overturn: CART["top"],
}
"""The engine's name or expression of each symbol of the thesis."""

OWN = {th.beta, th.omega, th.t, th.R_e, th.R_b, th.R_c}
"""Symbols of the thesis that the engine has no counterpart of; the radii go in `normal_form`."""


def at_side(expr, side: int):
    """sgn(theta), |theta|, the double sign and the cases of a brace for one sign of theta."""
    if expr.has(sp.sign, sp.Abs):
        expr = expr.replace(sp.sign, lambda _: sp.Integer(side))
        expr = expr.replace(sp.Abs, lambda argument: side * argument)
    cases = {th.theta > 0: side > 0, th.theta < 0: side < 0}
    return expr.subs({k: sp.sympify(v) for k, v in cases.items()}).subs(th.PM, side)


def rate(expr: sp.Expr, order: int = 1) -> sp.Expr:
    """Derivative by time of a function of the rotation and its rate."""
    for _ in range(order):
        expr = sp.diff(expr, th.theta) * th.theta_d + sp.diff(expr, th.theta_d) * th.theta_dd
    return expr


def spread(expr: sp.Expr) -> sp.Expr:
    """Sines and cosines of sums as products."""
    tangents = expr.replace(sp.tan, lambda a: sp.sin(a) / sp.cos(a))
    angles = {f: f.func(sp.expand(f.args[0])) for f in tangents.atoms(sp.sin, sp.cos)}
    return sp.expand_trig(tangents.xreplace(angles))


def in_engine_notation(
    expr: sp.Expr, side: int, values: Mapping[sp.Symbol, sp.Expr] | None = None
) -> sp.Expr:
    """A thesis expression in the engine's symbols; `known` adds values of further symbols.

    Raises ValueError if a symbol of the thesis has no meaning in the engine: what is not
    understood must not pass for a difference.
    """
    expr = spread(at_side(sp.sympify(expr), side).doit())
    half_width = PIER["half_width"]
    polar: dict[sp.Expr, sp.Expr] = {}
    for radius, angle, height in POLAR:
        polar |= {sp.sin(angle): half_width / radius, sp.cos(angle): height / radius}
    values = values or {}
    expr = expr.xreplace(polar)
    unknown = expr.free_symbols - set(TO_ENGINE) - OWN - set(values)
    if unknown:
        raise ValueError(f"not translated: {sorted(map(str, unknown))}")
    return expr.xreplace({**TO_ENGINE, **values})


@lru_cache(maxsize=1024)  # of several relations of an equation most are compared again and again
def normal_form(expr: sp.Expr) -> sp.Expr:
    """The numerator of `expr`, reduced: zero if and only if `expr` is."""
    numerator = sp.fraction(sp.together(sp.expand(spread(expr))))[0]
    trig: dict[sp.Expr, sp.Symbol] = {}
    for angle in {f.args[0] for f in numerator.atoms(sp.sin, sp.cos)}:
        trig |= {sp.sin(angle): sp.Dummy("S"), sp.cos(angle): sp.Dummy("C")}
    result = sp.expand(numerator.subs(trig))
    for sine, cosine in zip(list(trig.values())[::2], list(trig.values())[1::2], strict=True):
        result = sp.rem(result, sine**2 + cosine**2 - 1, cosine)
    for radius, _, height in POLAR:
        if result.has(radius):
            result = sp.rem(result, radius**2 - PIER["half_width"] ** 2 - height**2, radius)
            result = sp.fraction(sp.together(result))[0]
    return sp.expand(result).subs({v: f for f, v in trig.items()})


def differs_somewhere(difference: sp.Expr) -> bool:
    """Whether a difference is certainly not zero for some positive numbers, with their R.

    False decides nothing: there may be no number, or one too close to zero to tell.
    """
    draw = random.Random(1)
    unknown = difference.free_symbols | difference.atoms(AppliedUndef, sp.Derivative)
    at = {x: sp.Float(draw.randrange(100, 900), 50) / 1000 for x in sorted(unknown, key=str)}
    if any(x.is_negative or x.is_integer for x in at):
        return False
    for radius, _, height in (p for p in POLAR if p[0] in at):
        at[radius] = sp.sqrt(PIER["half_width"] ** 2 + height**2).xreplace(at)
    value = difference.xreplace(at).evalf(15, maxn=40)
    return bool(value.is_number and value.is_finite and abs(value) > 1e-9)


def differences(
    relation: sp.Eq, derived, side: int, values: Mapping[sp.Symbol, sp.Expr] | None = None
) -> list[sp.Expr]:
    """Thesis minus engine for one relation, a term for each component, not yet reduced.

    derived : the engine's counterpart of the value that the relation states.
    """
    rows = derived if isinstance(derived, sp.MatrixBase) else [derived]
    return [
        in_engine_notation(a, side, values) - sp.sympify(b)
        for a, b in zip(stated(relation), rows, strict=True)
    ]
