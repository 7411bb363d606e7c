"""The impact of the flexible structure, which the thesis takes over from the rigid one (5-14).

An impulse at the new pivot has no moment about it, and the column's spring and damper transmit
none: the angular momentum about the new pivot and the momentum m_e (u' + H_e theta') of the
superstructure across the column are both conserved.
"""

from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
import sympy as sp

from rockeom.symbolic import RockingModel
from rockeom.thesis.chapter_5 import VELOCITY_RATIO
from rockeom.thesis.checks.engine import MODE, shipped
from rockeom.thesis.comparison import PIER, in_engine_notation, normal_form

M_E, M_B = PIER["mass"], PIER["base_mass"]
H_E, H_B, B = PIER["height"], PIER["base_height"], PIER["half_width"]
I_EG, I_BG = PIER["inertia"], PIER["base_inertia"]
U, U_D, THETA_D = PIER["u"], PIER["u_dot"], PIER["theta_dot"]

SIDES = pytest.mark.parametrize("side", [1, -1], ids=["right to left", "left to right"])


def closed_form(side: int) -> tuple[sp.Expr, sp.Expr]:
    """theta' and u' after the impact, by hand; from the left, u changes sign."""
    v = side * U
    ratio = (I_EG + I_BG + M_B * (H_B**2 - B**2) - M_E * (B**2 - v**2)) / (
        I_EG + I_BG + M_B * (H_B**2 + B**2) + M_E * (B + v) ** 2
    )
    after = ratio * THETA_D
    return after, U_D + H_E * (THETA_D - after)


def impact(side: int):
    return shipped("flexible_structure").impulse_map(MODE[side], MODE[-side])


@SIDES
def test_impulsive_map_is_the_closed_form(side):
    derived = list(impact(side).velocities())
    assert [normal_form(a - b) for a, b in zip(derived, closed_form(side), strict=True)] == [0, 0]


@SIDES
def test_sign_of_the_deformation_matters(side):
    derived = list(impact(side).velocities())
    wrong = [normal_form(a - b) for a, b in zip(derived, closed_form(-side), strict=True)]
    assert all(term != 0 for term in wrong)


# --- by hand: r x m v


def momenta(n: dict, pivot: Fraction, theta_d: Fraction, u_d: Fraction, about: Fraction):
    """(clockwise angular momentum about `about`, p_u, kinetic energy) at theta = 0.

    The structure turns clockwise at theta_d about `pivot`, and the column deforms at u_d.
    """
    angular = (n[I_EG] + n[I_BG]) * theta_d
    energy = angular * theta_d / 2
    superstructure, base = (n[M_E], n[U], n[H_E], u_d), (n[M_B], Fraction(0), n[H_B], Fraction(0))
    for mass, x, y, along in (superstructure, base):
        vx, vy = theta_d * y + along, -theta_d * (x - pivot)
        angular += mass * (y * vx - (x - about) * vy)
        energy += mass * (vx**2 + vy**2) / 2
    return angular, n[M_E] * (theta_d * n[H_E] + u_d), energy


def random_numbers(random: Random) -> dict[sp.Symbol, Fraction]:
    n = {x: Fraction(random.randint(1, 400), 100) for x in (M_E, M_B, H_E, H_B, B, I_EG, I_BG)}
    return n | {x: Fraction(random.randint(-300, 300), 100) for x in (U, U_D, THETA_D)}


def evaluated(expr: sp.Expr, n: dict) -> Fraction:
    value = sp.Rational(expr.subs({k: sp.Rational(v) for k, v in n.items()}))
    return Fraction(int(value.p), int(value.q))


@SIDES
def test_momenta_are_conserved_and_energy_is_not_gained(side):
    """Exactly, in fractions, at random states; about the old pivot momentum is not conserved."""
    random = Random(34)
    after = impact(side).velocities()
    changed_about_old_pivot = False
    for _ in range(25):
        n = random_numbers(random)
        old, new = side * n[B], -side * n[B]
        theta_d, u_d = (evaluated(e, n) for e in after)
        before_impact = momenta(n, old, n[THETA_D], n[U_D], new)
        after_impact = momenta(n, new, theta_d, u_d, new)
        assert before_impact[:2] == after_impact[:2]
        assert after_impact[2] <= before_impact[2]
        about_old = momenta(n, old, n[THETA_D], n[U_D], old)[0]
        changed_about_old_pivot |= about_old != momenta(n, new, theta_d, u_d, old)[0]
    assert changed_about_old_pivot


@SIDES
def test_rule_of_the_thesis_for_the_flexible_structure_does_not_conserve_momentum(side):
    """theta' by the root of 5-14 and u' unchanged: p_u changes wherever theta' does."""
    n = random_numbers(Random(514))
    ratio = evaluated(in_engine_notation(VELOCITY_RATIO, side), n)
    old, new = side * n[B], -side * n[B]
    before = momenta(n, old, n[THETA_D], n[U_D], new)
    after = momenta(n, new, ratio * n[THETA_D], n[U_D], new)
    assert before[0] != after[0]
    assert before[1] != after[1]


# --- a rigid column


def rigid_column(model: RockingModel) -> RockingModel:
    """The flexible structure with its deformation held at zero from the start."""
    held = {U: 0, U_D: 0}

    def hold(expr):
        return sp.sympify(expr).subs(held)

    def rigid(mode):
        return replace(
            mode,
            coordinates=tuple(c for c in mode.coordinates if c.position != U),
            bodies=tuple(replace(b, position=tuple(map(hold, b.position))) for b in mode.bodies),
            elements=(),
            load_point=tuple(map(hold, mode.load_point)),
        )

    modes = tuple(rigid(mode) for mode in model.modes)
    return replace(model, coordinates=(model.rotation,), modes=modes, sources={})


def minus_5_14(ratio: sp.Expr, side: int) -> sp.Expr:
    """A ratio of velocities less the one of which 5-14 prints the square."""
    return normal_form(ratio - in_engine_notation(VELOCITY_RATIO, side))


@SIDES
def test_rigid_column_recovers_5_14(side):
    """Three ways: the model's own ratio, the held coordinate, an impulse that holds the column."""
    model = shipped("flexible_structure")
    assert minus_5_14(model.velocity_ratio, side) == 0

    held = rigid_column(model).impulse_map(MODE[side], MODE[-side])
    assert minus_5_14(held.velocities()[0] / THETA_D, side) == 0

    full, after, impulse = impact(side), sp.Dummy("theta_d_after"), sp.Dummy("impulse")
    still = {U: 0, U_D: 0}
    rows = full.mass_matrix * sp.Matrix([after, 0]) - full.momentum - sp.Matrix([0, impulse])
    ((found, _),) = sp.linsolve(list(rows.subs(still)), [after, impulse])
    assert minus_5_14(found / THETA_D, side) == 0


@SIDES
def test_free_column_that_happens_to_be_straight_does_not_give_5_14(side):
    """With u = u' = 0 before, the column still deforms after: only holding it gives 5-14."""
    ratio = closed_form(side)[0].subs({U: 0, U_D: 0}) / THETA_D
    assert minus_5_14(ratio, side) != 0


@SIDES
def test_light_superstructure_leaves_the_base_to_itself(side):
    """Without the superstructure the base impacts as a rigid block of its own (2-6)."""
    alone = impact(side).velocities()[0].subs({M_E: 0, I_EG: 0}) / THETA_D
    inertia = I_BG + M_B * (B**2 + H_B**2)
    radius_squared, cos_2_alpha = B**2 + H_B**2, (H_B**2 - B**2) / (B**2 + H_B**2)
    housner = 1 - M_B * radius_squared / inertia * (1 - cos_2_alpha)
    assert normal_form(alone - housner) == 0
