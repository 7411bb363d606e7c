"""Checks of section 2.6: one passage through x = 0 leaves the fraction r of the kinetic energy.

With the velocity v as a function of the rotation, x'' = v dv/dx, so that delta(x) g(x') gives
dv/dx = delta(x) g(v) / v: separable, and with g = C v**2 solved by v_f = v_0 exp(C).
"""

from functools import cache
from typing import Any

import numpy as np
import sympy as sp

from rockeom.analysis.formulas.controlled_wall import peak_sequence
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks import check
from rockeom.thesis.checks.check import Finding, Findings, close, derived, states, vanishes
from rockeom.thesis.checks.engine import shipped
from rockeom.thesis.equation import Equation

W = sp.Dummy("w", positive=True)
"""A speed."""


def right(number: str) -> sp.Expr:
    """Right-hand side of an equation of one relation, in the form that holds."""
    (relation,) = EQUATIONS[number].right
    return relation.rhs


def left(number: str) -> sp.Expr:
    return EQUATIONS[number].right[0].lhs


def _factors(expr: sp.Expr, side: int) -> sp.Expr:
    """2-20 and 2-27 for the functions of the rotation and of the velocity."""
    return expr.subs({left("2-19a"): right("2-20"), left("2-27"): right("2-27")})


def smooth(expr: sp.Expr) -> sp.Expr:
    """2-20 for the delta, in the limit n -> 0."""
    with_n = expr.replace(sp.DiracDelta, lambda at: right("2-20").subs(th.x, at)).doit()
    return sp.limit(with_n, th.n, 0, "+")


# --- 2-17 to 2-20


def _concentrated(equation: Equation, relation: sp.Eq) -> Findings:
    whole = sp.integrate(relation.rhs, (th.x, th.below_zero, th.above_zero))
    beside = sp.integrate(relation.rhs, (th.x, th.above_zero, 2 * th.above_zero))
    yield vanishes("integral over a passage minus the 1 of 2-22", whole - 1, sp.simplify)
    yield vanishes("integral next to the impact", beside)


def _normal(equation: Equation, relation: sp.Eq) -> Findings:
    line = (th.x, -sp.oo, sp.oo)
    yield vanishes("its integral minus 1", sp.integrate(relation.rhs, line) - 1)
    wave = sp.integrate(relation.rhs * sp.cos(W * th.x), line)
    yield vanishes("limit of its integral with cos(w x) minus cos(0)", sp.limit(wave, th.n, 0) - 1)
    yield vanishes("its limit at x = w", sp.limit(relation.rhs.subs(th.x, W), th.n, 0))


# --- 2-21


def _without_gravity(equation: Equation, *relations: sp.Eq) -> Findings:
    """Lengths and times of the impact are of order n, x = n xi and t = n sigma."""
    xi, xi_dd, force = (sp.Dummy(name, real=True) for name in ("xi", "xi_dd", "force"))

    def in_its_scale(relation: sp.Eq) -> sp.Expr:
        rest = (relation.lhs - relation.rhs).replace(sp.Derivative, lambda *_: th.x_dd)
        rest = rest.subs({th.x: th.n * xi, th.x_dd: xi_dd / th.n, th.F_delta: force / th.n})
        return sp.limit(sp.expand(th.n * rest), th.n, 0, "+")

    (whole,) = EQUATIONS["2-17"].right
    rest = in_its_scale(whole) - in_its_scale(relations[0])
    yield vanishes("2-17 minus 2-21a in the scale of the impact, as n -> 0", rest)


def differentials() -> dict:
    """dx' = x'' dt and dx = x' dt, with x'' = f g by 2-18 and 2-21a."""
    acceleration = right("2-18").subs(left("2-19a"), right("2-19a"))
    return {th.dx_d: acceleration * th.dt, th.dx: th.x_d * th.dt}


# --- 2-22 to 2-27


def _requirement(equation: Equation, before: sp.Eq, after: sp.Eq) -> Findings:
    velocity, function = sp.Function("v")(th.x), left("2-23").func
    growth = before.lhs.subs(th.x_df, velocity).diff(th.x)
    growth = growth.subs(velocity.diff(th.x), right("2-20") * function(velocity) / velocity)
    with_n = before.rhs.replace(sp.DiracDelta, lambda at: right("2-20").subs(th.x, at))
    yield vanishes(
        "growth of the left integral along the passage minus that of the right one",
        growth - with_n.diff(th.x_f).subs(th.x_f, th.x),
        sp.simplify,
    )
    yield vanishes("the right integral minus what it shall be", smooth(before.rhs) - after.rhs)
    yield vanishes("the left integrals minus each other", before.lhs - after.lhs)


def factor_of_power(relation: sp.Eq, power: int) -> sp.Expr:
    """K by 2-24 for a power of the velocity."""
    start, end = (limit.subs(th.x_d0, W) for limit in relation.lhs.limits[0][1:])
    inside = (relation.lhs.function * th.K).subs(th.exponent, power)
    return sp.simplify(sp.integrate(inside, (th.x_d, start, end)) / relation.rhs)


def factor_of_square(side: int) -> sp.Expr:
    return factor_of_power(EQUATIONS["2-24"].right[0], 2)


def _exit_velocity(equation: Equation, relation: sp.Eq) -> Findings:
    _, start, end = relation.lhs.limits[0]
    yield vanishes("ratio of kinetic energies of its limits minus r", end**2 / start**2 - th.r)
    rest = relation.lhs.function - th.x_d / right("2-23")
    yield vanishes("its integrand minus x'/g", rest, sp.simplify)
    yield vanishes("its value minus that of 2-22", relation.rhs - EQUATIONS["2-22"].right[1].rhs)
    slopes = [sp.diff(factor_of_power(relation, power), W) for power in (1, 2, 3)]
    holds = [slope == 0 for slope in slopes] == [False, True, False]
    yield Finding("K does not depend on the velocity for m = 2, of m = 1, 2, 3", slopes, holds)


def velocity_left(g: sp.Expr, direction: int) -> sp.Expr:
    """Velocity after a passage over that before, for delta(x) g(x') as n -> 0."""
    factor = sp.limit((g / th.x_d**2).subs(th.x_d, direction * W), th.n, 0, "+")
    return sp.simplify(sp.exp(direction * factor))


def _passages(g: sp.Expr, sides: tuple[int, ...]) -> Findings:
    for direction in sides:
        what = f"ratio of the velocities of a passage to {'+-'[direction < 0]}x minus sqrt(r)"
        yield vanishes(what, velocity_left(g, direction) - sp.sqrt(th.r), sp.simplify)


def _velocity_function(equation: Equation, relation: sp.Eq) -> Findings:
    yield from _passages(relation.rhs, equation.sides)


def engine_force(side: int = 1) -> sp.Expr:
    """Force of the impact in the equation of motion of the engine's block, on its right."""
    motion = engine_motion()
    return motion.subs(th.r, 1) - motion


@cache
def engine_impulse(side: int) -> sp.Expr:
    """Its integral over the rotation; it knows the width of the tanh, as the limit does not."""
    return sp.integrate(sp.expand(engine_force()), (th.x, -sp.oo, sp.oo))


def _same_force(rest: sp.Expr) -> sp.Expr:
    return sp.simplify(sp.expand_log(sp.expand(rest), force=True))


def _force(equation: Equation, *relations: sp.Eq) -> Findings:
    force = relations[0].rhs
    g = sp.integrate(force, (th.x, -sp.oo, sp.oo))
    rest = force - right("2-20") * g
    yield vanishes("force minus delta_n times its integral over x", rest, sp.expand)
    yield from _passages(g, equation.sides)


# --- 2-29, and how much gravity and the width of the force matter

RELEASE, ENERGY_RATIO, WIDTH = 0.4, 0.7225, 1e-3
"""x_0, r and n of Figure 2-16."""


def potential(x: Any) -> Any:
    """Energy of 2-17 without a force, above that of the upright block."""
    return abs(x) - x**2 / 2


@cache
def peaks_with_force(width: float) -> np.ndarray:
    """Peaks of 2-29 in closed form: the release of Figure 2-16, and those of three passages."""
    return np.abs(peak_sequence(lambda x: np.tanh(x / width) - x, RELEASE, ENERGY_RATIO, width, 3))


def peaks_with_impacts(count: int) -> np.ndarray:
    """The same by 2-17 without a force, the energy multiplied by r at each impact."""
    return 1 - np.sqrt(1 - 2 * potential(RELEASE) * ENERGY_RATIO ** np.arange(count + 1))


def _peaks(equation: Equation, relation: sp.Eq) -> Findings:
    exact = peaks_with_impacts(3)
    narrow, wide = (peaks_with_force(n) - exact for n in (WIDTH, 2 * WIDTH))
    for i in (1, 2, 3):
        yield close(f"error of peak {i} of Figure 2-16, n = 0.001", narrow[i], 0, 1e-3)
        yield close("the same for twice the n, over it", wide[i] / narrow[i], 2, 0.1)


GRAVITY_ADDS = -3.33e-3
"""To the integral of 2-22, for n = 0.001 and the first impact of Figure 2-16."""


def neglected(width: float) -> float:
    """Integral of 2-22 minus 1 for the first impact of Figure 2-16, gravity included."""
    before, after = map(potential, peaks_with_force(width)[:2])
    return float(np.log(after / before) / np.log(ENERGY_RATIO)) - 1


def _gravity_is_small(equation: Equation, *relations: sp.Eq) -> Findings:
    yield close("what gravity adds, n = 0.001", neglected(WIDTH), GRAVITY_ADDS, 0.02e-3)
    ratio = neglected(2 * WIDTH) / neglected(WIDTH)
    yield close("the same for twice the n, over it", ratio, 2, 0.1)


_NEGLECTED = (
    f"order 1 in n: {abs(GRAVITY_ADDS):.2%} of the integral at n = {WIDTH}, the first impact of "
    "Figure 2-16"
)
_BY_PASSAGE = "the velocity after one passage, dv/dx = delta(x) g(v)/v"


def engine_motion(side: int = 1) -> sp.Expr:
    """Left minus right side of the equation of motion of the engine's block, in our symbols."""
    model = shipped("dirac_delta_block")
    (rotation,) = model.coordinates
    own = model.symbols
    motion = model.equations("right_core").residual[0]
    motion = (motion / model.parameters[0].symbol ** 2).subs({GROUND_X: 0, GROUND_Y: 0})
    put = {rotation.position: th.x, rotation.velocity: th.x_d, rotation.acceleration: th.x_dd}
    put |= {own["regularisation"]: th.n, own["energy_ratio"]: th.r}
    return motion.subs(put, simultaneous=True)


_DIFFERENTIALS = states(
    0, "left minus right side by dt", lambda expr, side: expr.subs(differentials())
)

CHECKS: check.Checks = {
    "2-18": derived(
        "with 2-20 and 2-27 it gives 2-28", states(lambda side: right("2-28"), put=_factors)
    ),
    "2-19a": derived("its integrals across and next to the impact", _concentrated),
    "2-19b": derived(
        "limit of 2-20 as n -> 0",
        states(0, put=lambda expr, side: smooth(expr.subs(th.x, side * W))),
    ),
    "2-19c": derived(
        "limit of the integral of 2-20 as n -> 0",
        states(1, put=lambda expr, side: smooth(expr + 1)),
    ),
    "2-20": derived("its integrals, and their limits as n -> 0", _normal),
    "2-21a": derived("2-17 in the scale of the impact, as n -> 0", _without_gravity),
    "2-21b": derived("dx' = x'' dt with 2-18", _DIFFERENTIALS),
    "2-21c": derived("dx' = x'' dt with 2-18", _DIFFERENTIALS),
    "2-21d": derived("dx' = x'' dt and dx = x' dt with 2-18", _DIFFERENTIALS),
    "2-22": (
        derived(_BY_PASSAGE, _requirement),
        derived("first peak of 2-29 in closed form", _gravity_is_small, _NEGLECTED),
    ),
    "2-23": derived("in 2-22 it gives 2-24", states(lambda side: th.x_d / left("2-24").function)),
    "2-24": derived("2-22 with 2-23, the kinetic energies in the ratio r", _exit_velocity),
    "2-25": derived(_BY_PASSAGE, states(factor_of_square, reduce=_same_force)),
    "2-26": derived(_BY_PASSAGE, _velocity_function),
    "2-27": (
        derived(
            "integral over x of the force in dirac_delta_block",
            states(engine_impulse, reduce=_same_force),
        ),
        derived(f"{_BY_PASSAGE}, in both directions, n -> 0", _velocity_function),
    ),
    "2-28": (
        derived(
            "the force in the equation of motion of dirac_delta_block",
            states(engine_force, reduce=_same_force),
        ),
        derived(f"{_BY_PASSAGE}, in both directions, n -> 0", _force),
    ),
    "2-29": (
        derived(
            "equation of motion by Lagrange's equations: dirac_delta_block",
            states(engine_motion, reduce=_same_force),
        ),
        derived("peaks of Figure 2-16 in closed form", _peaks),
    ),
}
