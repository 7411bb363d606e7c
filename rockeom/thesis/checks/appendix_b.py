"""Checks of the equations of appendix B, with the wall of those of chapter 4."""

import math

import numpy as np
import sympy as sp
from sympy import Rational

from rockeom.thesis import notation as th
from rockeom.thesis.checks import chapter_4_free_vibration, check, wall
from rockeom.thesis.checks.approximations import taylor
from rockeom.thesis.checks.chapter_4_free_vibration import DESCENT, kinetic_energy, rise_of_centroid
from rockeom.thesis.checks.check import Checks, Finding, Findings, close, derived, vanishes
from rockeom.thesis.equation import Equation, fractions


def _sine(equation: Equation, relation: sp.Eq) -> Findings:
    for side in equation.sides:
        rest = wall.placed(relation.lhs - relation.rhs, side)
        yield vanishes("left minus right side", rest, wall.reduced)


def _rate(equation: Equation, *relations: sp.Eq) -> Findings:
    """Both sides of B-5, differentiated by time."""
    angle = sp.Function("theta")(th.t)
    rate = sp.sin(angle).diff(th.t) / angle.diff(th.t)
    for side in equation.sides:
        for relation in relations:
            rest = relation.rhs * rate.subs(angle, th.theta) - th.Delta_d / th.H
            yield vanishes(
                "rate of sin(theta) minus that of Delta/H", wall.placed(rest, side), wall.reduced
            )


def _small_rate(equation: Equation, *relations: sp.Eq) -> Findings:
    exact = wall.right("B-6").subs(th.theta, sp.asin(th.Delta / th.H))
    *below, leading = taylor(exact - relations[0].rhs, (th.Delta,), 2)
    for order, term in enumerate(below):
        yield vanishes(f"term of order {order} of exact minus thesis", term, sp.simplify)
    error = th.Delta_d * th.Delta**2 / (2 * th.H**3)
    yield vanishes("its term of order 2 minus the stated error", leading - error, sp.simplify)
    size = float((1 - relations[0].rhs / exact).subs({**wall.WALL, th.Delta: wall.FALL}))
    yield close("error over the rate at 30.41 mm", size, 7.8e-5, 0.05e-5)


METRES = {th.H: wall.HEIGHT / 1e3, th.B: wall.HALF_WIDTH / 1e3}
CORNER, DEVELOPED, UPRIGHT = (
    d / 1e3 for d in (2 * wall.HALF_WIDTH, wall.HALF_WIDTH + wall.VANISHES, wall.HALF_WIDTH)
)
"""Lengths d that have lifted [m]."""


def _inertia(equation: Equation, relation: sp.Eq) -> Findings:
    total = float(wall.MASS)

    def about(d: float) -> float:
        return float(relation.rhs.subs({**METRES, th.d_lifted: d}))

    def radius(d: float) -> float:
        return math.hypot(d - wall.HALF_WIDTH / 1e3, wall.CENTROID / 1e3)

    yield close("reduction of I_o, upright", 1 - about(UPRIGHT) / about(DEVELOPED), 0.03, 0.002)
    ratio = [about(d) / radius(d) for d in np.linspace(UPRIGHT, CORNER, 51)]
    change = max(ratio) / min(ratio) - 1
    yield Finding("change of I_o/R on its way, below 2 % by 4.7", change, 0 < change < 0.02)
    arm = 2 * total * (wall.HALF_WIDTH / 1e3) ** 2 / about(CORNER)
    yield close("r of 2-6 about the corner, 0.835 by 4.9.2.1", (1 - arm) ** 2, 0.835, 5e-4)


def _parallel_axes(equation: Equation, relation: sp.Eq) -> Findings:
    """A panel that has lifted up to its far edge, and a mass on its centreline."""
    across, up = sp.symbols("across up")
    panel = sp.integrate(
        (across**2 + up**2) / (th.d_lifted * th.H), (across, 0, th.d_lifted), (up, 0, th.H)
    )
    added = Rational("2.537") ** 2 + (th.d_lifted - th.B) ** 2
    exact = 686 + Rational("577.56") * panel + 442 + Rational("1438.5") * added
    rest = fractions(relation.rhs).doit() - exact
    yield vanishes("thesis minus both by the theorem of Steiner", rest, sp.expand)


def _work(equation: Equation, *relations: sp.Eq) -> Findings:
    """The mean of the forces at both ends, times the way."""
    trapezium = (th.k * th.x_1 + th.k * th.x_2) / 2 * (th.x_2 - th.x_1)
    rest = sp.expand(relations[0].rhs.doit() - trapezium)
    yield vanishes("thesis minus the area below the force", rest)


def _extension(equation: Equation, *relations: sp.Eq) -> Findings:
    stated = relations[0].rhs
    strain = stated / th.L_T
    rest = strain * th.E_tendon * th.A_tendon - th.P_tendon
    yield vanishes("stress of the stated strain times A, minus the force", rest, sp.simplify)
    for force, extension in ((wall.FORCE, 6.4564), (wall.YIELD, 13.5814)):
        by_equation = float(stated.subs(wall.WALL).subs(th.P_tendon, force))
        yield close(f"extension in mm at {float(force)} kN", by_equation, extension, 5e-5)


def _before_yield(equation: Equation, *relations: sp.Eq) -> Findings:
    """Work against the elastic force since the 75.6 kN."""
    exact = (th.P_tendon**2 - wall.FORCE**2) / (2 * wall.STIFFNESS)
    for relation in relations:
        rest = (relation.rhs.doit().subs(wall.WALL) - exact).expand()
        for force in (0, wall.FORCE, 133.39, wall.YIELD):
            gap = rest.subs(th.P_tendon, force)
            yield close(f"thesis minus work in J at {float(force)} kN", gap, 0, 0.005)


def _after_yield(equation: Equation, *relations: sp.Eq) -> Findings:
    """Work of an elastic and of a constant force."""
    reserve = (wall.YIELD - wall.FORCE) / wall.STIFFNESS
    exact = (wall.YIELD**2 - wall.FORCE**2) / (2 * wall.STIFFNESS) + wall.YIELD * (
        th.extension - reserve
    )
    for relation in relations:
        rest = relation.rhs.doit().subs(wall.WALL) - exact
        for more in (0, 5, 20):
            gap = rest.subs(th.extension, reserve + more)
            what = f"thesis minus work in J, {more} mm beyond yield"
            yield close(what, gap, 0, 0.005)


CHECKS: Checks = {
    "B-1": derived(wall.TURNED, wall.by_geometry(wall.tendon_uplift, u_edge=wall.edge_uplift)),
    "B-2": derived(wall.TURNED, wall.by_geometry(wall.tendon_uplift, u_edge=wall.edge_uplift)),
    "B-3": derived(
        wall.TURNED, wall.by_geometry(wall.with_numbers(wall.tendon_uplift), B=wall.half_width)
    ),
    "B-4": derived(wall.TURNED, rise_of_centroid, DESCENT),
    "B-5": derived(wall.TURNED, _sine),
    "B-6": derived("derivative of B-5", _rate),
    "B-7": derived("Taylor series of B-6", _small_rate, "order 2 in Delta/H: 0.008 % at 30.41 mm"),
    "B-8": derived(
        "kinetic energy of the wall about a fixed and a moving O",
        kinetic_energy,
        chapter_4_free_vibration.MOVING_INERTIA,
    ),
    "B-9": (
        derived("a panel, and a mass on its centreline", _parallel_axes),
        check.reproduced("what the text says of I_o, I_o/R and r", _inertia),
    ),
    "B-10": derived("area below the force", _work),
    "B-11": derived("Hooke's law; the extensions of B.3", _extension),
    "B-12": derived("work of the elastic tendon", _before_yield),
    "B-13": derived("work of the elastic-plastic tendon", _after_yield),
}
