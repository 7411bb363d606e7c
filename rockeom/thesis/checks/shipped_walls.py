"""The shipped walls against 4-8, 4-16, 4-27, 4-32, 4-37 and 4-40: rotation centre, tendon, motion.

The equation of motion of a structure, with its functions put in, has to be that of the thesis, with
the forces and energies of the thesis put in. Tendons are elastic and on the centreline.
"""

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType

import sympy as sp
from sympy import cos, sin

from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.rocking import RockingModel
from rockeom.thesis import notation as th
from rockeom.thesis.checks.check import Check, Checks, Findings, derived, states, vanishes
from rockeom.thesis.checks.engine import residual, shipped
from rockeom.thesis.checks.wall import HALF_WIDTH, REMAINS, placed, reduced, right
from rockeom.thesis.equation import BOTH, Equation

OSCILLATOR = "controlled_wall_oscillator"
ABOUT_CORNERS, ABOUT_MOVING_CENTRE = "simplified_substitute_gravity_wall", "substitute_gravity_wall"
SPEED = sp.Symbol("speed", positive=True)


def in_thesis_symbols(model: RockingModel, expr: sp.Expr, side: int) -> sp.Expr:
    """An expression of a wall's model by the symbols of the thesis, with its B and C_2 in mm."""
    own = model.symbols
    stiffness = th.E_tendon * th.A_tendon / th.L_T0
    values = {
        "mass": th.m, "effective_mass": th.M_e, "pivot_inertia": th.I_o, "gravity": th.g,
        "height": th.H, "centroid_height": th.H_c, "half_width": HALF_WIDTH,
        "edge_distance": REMAINS, "transition": th.penalty, "tendon_stiffness": stiffness,
        "initial_force": th.P_initial, "eccentricity": 0,
        "permanent_extension": 0, "regularisation": th.n,
        "u": th.Delta, "u_dot": th.Delta_d, "u_ddot": th.Delta_dd,
        "theta": th.theta, "theta_dot": th.theta_d, "theta_ddot": th.theta_dd,
    }  # fmt: skip
    put = {own[name]: sp.sympify(value) for name, value in values.items() if name in own}
    put |= {GROUND_X: th.a_g, GROUND_Y: sp.S.Zero, SIDE: sp.Integer(side)}
    return expr.xreplace(put)


GEOMETRY = ("rotation_centre", "tendon_extension", "rise", "present_speed")
"""Functions of a model whose values replace them; what remains has its own symbol in the thesis."""


def with_geometry(model: RockingModel, expr: sp.Expr) -> sp.Expr:
    """An expression of a model with the values of its functions of the geometry."""
    for one in reversed(model.functions):  # a function may depend on those before it
        if one.name in GEOMETRY:
            expr = expr.subs(one.symbol, one.value)
    return expr.doit()


def by_displacement(expr: sp.Expr) -> sp.Expr:
    """The rotation of an expression by Delta = H sin(theta), 4-33."""
    level = sp.sqrt(th.H**2 - th.Delta**2)
    sine, cosine = th.Delta / th.H, level / th.H
    put = {sin(th.theta): sine, cos(th.theta): cosine, sp.tan(th.theta): sine / cosine}
    return expr.xreplace(put).subs(1 - th.Delta**2 / th.H**2, cosine**2)


def equals(
    name: str, structures: Iterable[str], numbers: Mapping[sp.Symbol, int] = MappingProxyType({})
) -> tuple[Check, ...]:
    """Checks against a function of shipped walls, or the force of their tendons, of Delta."""

    def check(structure: str) -> Check:
        def value(side: int) -> sp.Expr:
            exact = of_function(structure, name, side)
            if name == "rotation_centre":  # 4-8 counts from the edge
                exact = HALF_WIDTH - exact
            return put(by_displacement(exact), side)

        def put(expr: sp.Expr, side: int) -> sp.Expr:
            return placed(expr.subs(numbers).subs(sp.Abs(th.Delta), side * th.Delta), side)

        route = f"{name.replace('_', ' ')} of {structure}"
        return derived(route, states(value, put=put, reduce=reduced))

    return tuple(map(check, structures))


def of_function(structure: str, name: str, side: int) -> sp.Expr:
    """A function of a shipped wall by the symbols of the thesis; its tendon is elastic."""
    model = shipped(structure)
    mode = model.mode("right")
    values = {one.name: one.value for one in model.functions}
    value = values[name] if name in values else mode.put(mode.quantities[name][1], "right")
    return in_thesis_symbols(model, with_geometry(model, value), side)


# --- the equations of motion


def _motion(model: RockingModel, side: int) -> sp.Expr:
    """Left minus right side of the equation of motion, its functions put in."""
    (ratio,) = (one.symbol for one in model.functions if one.name == "energy_ratio")
    motion = with_geometry(model, residual(model, side)).subs(ratio, th.r)
    return in_thesis_symbols(model, motion, side)


def _oscillator(equation: Equation, relation: sp.Eq) -> Findings:
    """4-27 with the energies of 4-18 and 4-16, and with 4-28 and 4-39."""
    model = shipped(OSCILLATOR)
    numbers = {th.m_T: th.m, th.B: HALF_WIDTH}
    stiffness = th.E_tendon * th.A_tendon / th.L_T0
    for side in BOTH:
        one_side = {sp.Abs(th.Delta): side * th.Delta}
        raised, force = (right(n).subs({**numbers, **one_side}) for n in ("4-18", "4-16"))
        stored = raised + force**2 / (2 * stiffness)
        put = {th.F_k: stored.diff(th.Delta), th.F_damp: right("4-28"), th.P_e: right("4-39")}
        rest = (relation.lhs - relation.rhs).subs(put) - _motion(model, side)
        rest = sp.expand_log(by_displacement(rest).subs(th.Delta_d, side * SPEED))
        where = f"Delta and its rate {'>' if side > 0 else '<'} 0"
        yield vanishes(f"thesis minus {OSCILLATOR}, {where}", placed(rest, side), reduced)


def _substitute_gravity(structure: str) -> Callable:
    """The relations with the lever of the structure as R sin(alpha), and M_e as its mass."""

    def find(equation: Equation, motion: sp.Eq, *moment: sp.Eq) -> Findings:
        model = shipped(structure)
        lever = sp.Dummy("lever", positive=True)
        own = model.symbols
        arm = next((f.symbol for f in model.functions if f.name == "lever"), own["half_width"])
        (pull,) = (f.symbol for f in model.functions if f.name == "elastic_force")
        stated = motion.lhs - motion.rhs
        for relation in moment:
            stated = stated.subs(relation.lhs, relation.rhs)
        for side in equation.sides:
            exact = residual(model, side).subs({arm: lever, pull: th.P_tendon})
            exact = in_thesis_symbols(model, exact, side)
            if not moment:
                exact = exact.subs(th.a_g, 0)
            put = {th.M_e: th.m, th.s: sp.Integer(side)}
            one_side = sp.expand(sp.expand_trig(stated.subs(put)))
            polar = {th.R * sin(th.alpha): lever, th.R * cos(th.alpha): th.H_c}
            rest = sp.expand(one_side).subs(polar) - exact
            yield vanishes(f"thesis minus {structure}, theta of sign {side}", rest, sp.expand)

    return find


_TENDON, _HALF_WIDTH = (ABOUT_MOVING_CENTRE, ABOUT_CORNERS), {th.B: HALF_WIDTH}

CHECKS: Checks = {
    "4-8": equals(
        "rotation_centre",
        (OSCILLATOR, *_TENDON, "controlled_wall"),
        {th.C_1: HALF_WIDTH - REMAINS, th.C_2: REMAINS},
    ),
    "4-16": (
        *equals("tendon_force", (OSCILLATOR, *_TENDON), _HALF_WIDTH),
        *equals("elastic_force", _TENDON, _HALF_WIDTH),
    ),
    "4-27": derived(f"motion of {OSCILLATOR}, with 4-16, 4-18, 4-28 and 4-39", _oscillator),
    "4-32": derived(f"motion of {ABOUT_CORNERS}", _substitute_gravity(ABOUT_CORNERS)),
    "4-37": equals("lever", [ABOUT_MOVING_CENTRE]),
    "4-40": derived(f"motion of {ABOUT_MOVING_CENTRE}", _substitute_gravity(ABOUT_MOVING_CENTRE)),
}
