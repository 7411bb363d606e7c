"""Where the thesis linearises: its form is the leading Taylor term of the exact one.

The first term in which they differ is stated by hand, and with it the order of the error, and so
is its size for the thesis's own block and column. Both are checked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import NamedTuple

import sympy as sp
from sympy import cos, sign

from rockeom.symbolic.model import GROUND_X
from rockeom.symbolic.statics import pushover
from rockeom.thesis import notation as th, printed
from rockeom.thesis.checks import engine
from rockeom.thesis.checks.check import Checks, Findings, close, derived, vanishes
from rockeom.thesis.checks.engine import THETA, foot_force, in_polar, lift_off_sine, shipped
from rockeom.thesis.comparison import ALPHA, BLOCK, PIER, SCALED, R, in_engine_notation, normal_form
from rockeom.thesis.equation import Equation, stated

s, _WEIGHT = sign(th.theta), th.m * th.g
STIFFNESS = in_engine_notation(th.k_f, 1)
LIFT_OFF = sp.Dummy("lambda", positive=True)
"""W / (2 k_f B), the rotation 5-22, small where the springs are stiff."""


class State(NamedTuple):
    """Numbers for the engine's symbols, and what they are."""

    words: str
    numbers: Mapping[sp.Symbol, float]

    def value(self, expr: sp.Expr) -> float:
        return float(expr.subs(self.numbers))


def first_impact() -> State:
    """The block of chapter 3 at the first impact of Figure 3-3, where it is released at 7.876 deg.

    In the equations of motion, upright and at rest; non-dimensional under beta = 1.
    """
    half_width, height = printed.BLOCK["half_width"], printed.BLOCK["half_height"]
    mass, radius = printed.BLOCK["mass"], math.hypot(half_width, height)
    numbers = {
        BLOCK["mass"]: mass,
        BLOCK["inertia"]: mass * radius**2 / 3,
        PIER["gravity"]: 9.81,
        R: radius,
        ALPHA: math.atan2(half_width, height),
        THETA: 0.0,
        PIER["theta_dot"]: 0.771,
        PIER["theta_ddot"]: 0.0,
        SCALED["x"]: 0.0,
        SCALED["x_ddot"]: 0.0,
        th.beta: 1.0,
        th.omega: 1.0,
        th.t: 0.0,
    }
    return State("the block of chapter 3, alpha = 11.8 deg, at its first impact", numbers)


def half_way_to_lift_off() -> State:
    """The column of chapter 5 on the springs of 5.3.2, at half the rotation of lift-off."""
    column, spring = printed.COLUMN, 550e3
    weight = 9.81 * (column["mass"] + column["base_mass"])
    half_way = weight / (2 * spring * column["half_width"]) / 2
    numbers = {PIER[name]: value for name, value in column.items()}
    numbers |= {PIER["gravity"]: 9.81, STIFFNESS: spring}
    numbers |= {THETA: half_way, PIER["u"]: column["height"] * half_way}
    return State("the column of chapter 5, half way to lift-off", numbers)


AT_IMPACT, HALF_WAY = first_impact(), half_way_to_lift_off()
UPRIGHT = AT_IMPACT._replace(words="the block of chapter 3, alpha = 11.8 deg, upright")
LIFTING = HALF_WAY._replace(words="the column of chapter 5 as it lifts off")
RELEASED = State(
    "the column of chapter 5 at 28 mm, as released", {**HALF_WAY.numbers, THETA: 0.0264}
)


@dataclass(frozen=True)
class Approximation:
    """exact(side) - factor * thesis = error, of the given order in the small symbols.

    size : of the error over the exact value, for theta > 0 and the numbers of `at`.
    """

    exact: Callable[[int], sp.Expr]
    error: sp.Expr
    size: float
    order: int
    small: tuple[sp.Symbol, ...]
    at: State
    factor: sp.Expr = sp.S.One

    @property
    def words(self) -> str:
        small = ", ".join("theta_crit" if x == LIFT_OFF else str(x) for x in self.small)
        return f"order {self.order} in {small}; {100 * self.size:.2g} % for {self.at.words}"


def springs():
    return shipped("two_spring_structure")


def spring_force(foot: str) -> sp.Expr:
    return foot_force(springs(), foot)


def stiff(expr: sp.Expr) -> sp.Expr:
    """`expr` in terms of the rotation at lift-off instead of the springs' stiffness."""
    weight = in_engine_notation(th.W, 1)
    of_rotation = weight / (2 * PIER["half_width"] * LIFT_OFF)  # what it is multiplied by vanishes
    return sp.expand(expr).subs(STIFFNESS, of_rotation)


def on_lifting(mode: str) -> sp.Expr:
    """Exact pushover force at the rotation at which the left spring lifts."""
    return pushover(springs(), mode).subs(THETA, sp.asin(lift_off_sine(springs())))


def start(side: int) -> sp.Expr:
    """Exact angular acceleration of the rectangular block at theta = 0."""
    exact = engine.acceleration(shipped("rigid_block"), side).subs({THETA: 0, GROUND_X: 0})
    return engine.rectangular(in_polar(exact))


def impact_force(side: int, axis: int) -> sp.Expr:
    return engine.force_at_impact(shipped("rigid_block"), side, axis, start)


def resting_force(side: int, axis: int) -> sp.Expr:
    return impact_force(side, axis).subs(PIER["theta_dot"], 0)


of_block = partial(Approximation, small=(ALPHA,), at=AT_IMPACT)
of_springs = partial(Approximation, order=3, small=(THETA,), at=HALF_WAY)
of_lifting = partial(Approximation, small=(LIFT_OFF,), at=LIFTING)
"""The block of chapter 3 at its first impact, slender; the column on both springs, its rotation
small; the column as it lifts off, its springs stiff."""

APPROXIMATIONS: dict[str, Approximation] = {
    "2-3": Approximation(
        lambda side: in_polar(engine.residual(shipped("rigid_block"), side)).subs(GROUND_X, 0),
        -th.m * th.g * th.R * (th.alpha - th.theta) ** 3 / 6,
        7.1e-3,
        order=3,
        small=(THETA, ALPHA),
        at=UPRIGHT,
    ),
    "2-14": Approximation(
        lambda side: engine.nondimensional(shipped("nondimensional_block"), side),
        -(th.alpha**3)
        * (s * (1 - s * th.x) ** 3 / 6 + th.beta * cos(th.omega * th.t) * (1 - s * th.x) ** 2 / 2),
        1.4e-2,
        order=3,
        small=(ALPHA,),
        at=UPRIGHT,
        factor=th.alpha,
    ),
    "3-10": of_block(start, s * th.g * th.alpha**3 / (8 * th.R), 7.1e-3, 3),
    "3-11": of_block(partial(impact_force, axis=0), s * _WEIGHT * th.alpha**3 / 8, 7.4e-3, 3),
    "3-12": of_block(partial(impact_force, axis=1), _WEIGHT * th.alpha**4 / 8, 2.4e-4, 4),
    "3-14": of_block(partial(resting_force, axis=0), s * _WEIGHT * th.alpha**3 / 8, 7.1e-3, 3),
    "3-15": of_block(partial(resting_force, axis=1), _WEIGHT * th.alpha**4 / 8, 2.3e-4, 4),
    "5-19": of_springs(
        lambda side: (spring_force("right") - spring_force("right").subs(THETA, 0)) / STIFFNESS,
        -th.B * th.theta**3 / 6,
        1.2e-6,
    ),
    "5-20": of_springs(lambda side: spring_force("left"), th.k_f * th.B * th.theta**3 / 6, 1.2e-6),
    "5-21": of_springs(
        lambda side: spring_force("right"), -th.k_f * th.B * th.theta**3 / 6, 3.8e-7
    ),
    "5-22": of_lifting(lambda side: sp.asin(lift_off_sine(springs())), LIFT_OFF**3 / 6, 4.6e-6, 3),
    "5-24": of_springs(
        lambda side: pushover(springs(), "both"),
        -(th.k_f * th.B**2 + th.W * th.H_c) * th.theta**3 / (3 * th.H_e),
        1.2e-6,
    ),
    "5-25": Approximation(
        lambda side: pushover(springs(), "both").subs(THETA, sp.asin(PIER["u"] / PIER["height"])),
        -th.W * th.H_c * th.u**3 / (2 * th.H_e**4),
        5.1e-8,
        order=3,
        small=(PIER["u"],),
        at=HALF_WAY,
    ),
    "5-26": of_lifting(
        lambda side: on_lifting("both"), -th.W * th.H_c * LIFT_OFF**3 / (2 * th.H_e), 2.1e-7, 3
    ),
    # After lift-off the thesis turns the structure about the pressed foot, which is not where the
    # base's centre is guided: the two differ by the factor 1 + (B/H_e) tan(theta).
    "5-31": Approximation(
        lambda side: pushover(springs(), "right"),
        th.W * th.B**2 * th.theta / th.H_e**2,
        7.1e-3,
        order=1,
        small=(THETA,),
        at=RELEASED,
    ),
    "5-32": of_lifting(
        lambda side: on_lifting("right"), th.W * th.B**2 * LIFT_OFF / th.H_e**2, 1.4e-3, 1
    ),
}
for _other, _same in (("5-27", "5-25"), ("5-28", "5-24"), ("5-29", "5-26")):
    APPROXIMATIONS[_other] = APPROXIMATIONS[_same]


@lru_cache(maxsize=64)  # the exact expression is compared with many a wrong one
def taylor(expr: sp.Expr, small: tuple[sp.Symbol, ...], order: int) -> list[sp.Expr]:
    """Terms of total order 0 to `order` in the small symbols."""
    scale = sp.Dummy("scale", positive=True)
    term = expr.subs({x: scale * x for x in small}, simultaneous=True)
    terms = []
    for n in range(order + 1):
        terms.append(term.subs(scale, 0) / sp.factorial(n))
        term = sp.diff(term, scale)
    return terms


def leads(
    exact: sp.Expr,
    thesis: sp.Expr,
    small: tuple[sp.Symbol, ...],
    order: int,
    error: sp.Expr,
    reduce: Callable[[sp.Expr], sp.Expr] = sp.simplify,
) -> Findings:
    """Check that exact minus thesis begins with the stated error, of an order in small symbols."""
    both = zip(*(taylor(e, small, order) for e in (exact, thesis)), strict=True)
    *below, leading = (a - b for a, b in both)
    for n, term in enumerate(below):
        yield vanishes(f"term of order {n} of exact minus thesis", term, reduce)
    yield vanishes(f"its term of order {order} minus the stated error", leading - error, reduce)


def _find(equation: Equation, relation: sp.Eq) -> Findings:
    case = APPROXIMATIONS[equation.number]
    for side in equation.sides:
        (whole,) = stated(relation)
        thesis = in_engine_notation(case.factor * whole, side)
        exact, error = case.exact(side), in_engine_notation(case.error, side, {LIFT_OFF: LIFT_OFF})
        if side > 0:
            size = abs(1 - case.at.value(thesis) / case.at.value(exact))
            what = f"error over the value for {case.at.words}"
            yield close(what, size, case.size, 0.05 * case.size)
        if LIFT_OFF in case.small:
            thesis, exact, error = map(stiff, (thesis, exact, error))
        yield from leads(exact, thesis, case.small, case.order, error, normal_form)


ROUTE = "leading Taylor term of the exact expression of the engine"
CHECKS: Checks = {n: derived(ROUTE, _find, case.words) for n, case in APPROXIMATIONS.items()}
