"""How a block at rest begins to move: closed forms of Shenton (1996), out of derived expressions.

The ground accelerates to the right, a > 0: the block begins about its left foot, s = -1, and
slides to the left, sigma = -1. Half-dimensions b, h; g' = g + a_y; a homogeneous rectangle.
"""

from functools import cache

import pytest
import sympy as sp

import rockeom as rk
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.modes.kinematics import sign_of_slip

MODEL = rk.derive("sliding_block")
M, B, H, INERTIA, G, MU, _ = (p.symbol for p in MODEL.parameters)
X, Y, THETA = (c.acceleration for c in MODEL.coordinates)
A = sp.Symbol("a", positive=True)
WEIGHT = sp.Symbol("gw", positive=True)  # g' = g + a_y
RECTANGLE = M * (B**2 + H**2) / 3
MU_C = (A * (4 * B**2 + H**2) + 3 * WEIGHT * B * H) / (WEIGHT * (4 * H**2 + B**2) + 3 * A * B * H)


def of_rectangle(expr) -> sp.Expr:
    to_the_left = {SIDE: -1, sign_of_slip(0): -1}
    expr = (
        sp.sympify(expr)
        .subs(to_the_left)
        .subs({INERTIA: RECTANGLE, GROUND_X: A, GROUND_Y: WEIGHT - G})
    )
    return sp.cancel(sp.together(expr))


@cache
def start(name: str):
    """Accelerations, normal forces and friction with which a mode begins from rest."""
    found = MODEL.mode(name).from_rest(MODEL.modes.standing)
    return type(found)(*({k: of_rectangle(e) for k, e in part.items()} for part in found))


def pressed(name: str) -> tuple[sp.Expr, sp.Expr]:
    """(normal force, friction) at the one foot that is down."""
    (normal,), (friction,) = (part.values() for part in start(name)[1:])
    return normal, friction


def same(found, wanted) -> bool:
    return sp.simplify(found - wanted) == 0


def test_at_rest_the_feet_share_the_weight_and_the_overturning_moment():
    """So it rests for a <= g' b/h, where the right foot presses, and a <= mu g'."""
    at_rest = start("both")
    assert set(at_rest.motion.values()) == {0}
    assert same(at_rest.normal[0], M * (WEIGHT / 2 + A * H / (2 * B)))
    assert same(at_rest.normal[1], M * (WEIGHT / 2 - A * H / (2 * B)))
    assert same(at_rest.friction[0], M * A)
    assert sp.solve(at_rest.normal[1], A) == [WEIGHT * B / H]
    cone = MU * (at_rest.normal[0] + at_rest.normal[1])
    assert sp.solve(cone - at_rest.friction[0], A) == [MU * WEIGHT]


def test_sliding_on_both_feet_needs_friction_below_the_slenderness():
    sliding = start("both_slides_left")
    assert same(sliding.motion[X], MU * WEIGHT - A)  # of the block over the ground
    assert same(sliding.normal[1], M * WEIGHT / 2 * (1 - MU * H / B))


def test_rocking_begins_with_the_pinned_block_s_acceleration():
    rocking = start("left")
    p2 = sp.Rational(3, 4) / (B**2 + H**2)
    assert same(rocking.motion[THETA], -p2 * (A * H - WEIGHT * B))
    assert same(rocking.motion[Y], B * p2 * (A * H - WEIGHT * B))


def test_slide_rock_begins_with_shentons_normal_force():
    begins = start("left_slides_left")
    below = 4 * B**2 + H**2 - 3 * MU * B * H
    wanted = M * WEIGHT * (B**2 + H**2) / below
    normal, friction = pressed("left_slides_left")
    assert same(normal, wanted)
    # and so, by Newton's second law of the centroid
    assert same(friction, MU * wanted)
    assert same(begins.motion[THETA], 3 * WEIGHT * (B - MU * H) / below)
    assert same(begins.motion[X] + A + H * begins.motion[THETA], MU * wanted / M)
    assert same(begins.motion[Y] + WEIGHT, wanted / M)


def test_between_them_stands_the_critical_friction():
    """Where rocking needs all friction that there is, and where slide-rock would not slide."""
    normal, friction = pressed("left")
    assert same(friction / normal, MU_C)
    # at the start, upright, the foot goes as the base's centre
    assert sp.simplify(start("left_slides_left").motion[X].subs(MU, MU_C)) == 0
    assert same(MU_C.subs(A, WEIGHT * B / H), B / H)  # it begins where sliding ends


def test_critical_friction_rises_to_the_painleve_bound():
    bound = (4 * B**2 + H**2) / (3 * B * H)
    assert same(sp.limit(MU_C, A, sp.oo), bound)
    rise = 4 * WEIGHT * (B**2 + H**2) ** 2 / (3 * A * B * H + WEIGHT * (B**2 + 4 * H**2)) ** 2
    assert rise.is_positive
    assert same(sp.diff(MU_C, A), rise)
    assert same(sp.solve(1 / pressed("left_slides_left")[0], MU)[0], bound)


@pytest.mark.parametrize("name", ["right", "right_slides_right"])
def test_to_the_other_side_all_is_mirrored(name):
    """With the ground to the left the same forces, friction and accelerations turned round."""
    found = MODEL.mode(name).from_rest(MODEL.modes.standing)
    slips = {sign_of_slip(0): 1, SIDE: 1, GROUND_X: -A}
    image = start({"right": "left", "right_slides_right": "left_slides_left"}[name])
    for place, there in ((X, -1), (THETA, -1), (Y, 1)):
        here = of_rectangle(found.motion[place].subs(slips))
        assert same(here, there * image.motion[place])
    for part, there in ((found.normal, 1), (found.friction, -1)):
        (here,) = part.values()
        force = pressed({"right": "left", "right_slides_right": "left_slides_left"}[name])
        assert same(of_rectangle(here.subs(slips)), there * force[there < 0])
