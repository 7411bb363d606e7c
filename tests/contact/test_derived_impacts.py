"""Impacts with friction, out of derived expressions: symbolically zero difference.

A rectangular block stands on its left foot, which sticks until the right corner lands. s, c are
the sine and cosine of alpha, tan alpha = b/h; no letter of the derivation.
"""

import sympy as sp

import rockeom as rk
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.modes.kinematics import sign_of_slip

MODEL = rk.derive("sliding_block")
M, B, H, INERTIA, _, MU, E = (p.symbol for p in MODEL.parameters)
X, Y, THETA = (c.velocity for c in MODEL.coordinates)
RADIUS, ALPHA = sp.symbols("R alpha", positive=True)
S, C = sp.sin(ALPHA), sp.cos(ALPHA)
W = sp.Symbol("omega", positive=True)
TURNING_IN = {THETA: W, Y: -B * W}  # about the left corner, towards the right one


def simple(expr) -> sp.Expr:
    put = {INERTIA: M * (B**2 + H**2) / 3, SIDE: 1, sign_of_slip(0): 1}
    expr = expr.subs(put).subs({B: RADIUS * S, H: RADIUS * C})
    return sp.simplify(sp.cancel(sp.trigsimp(sp.together(expr))))


def landing(mode: str, before):
    return MODEL.mode(mode).impact.landing(before, MODEL.modes.standing)


def test_a_corner_that_sticks():
    found = landing("right", TURNING_IN)
    after = sp.Rational(3, 2) * (1 + E) * S**2
    assert simple(found.motion[THETA] / W - (1 - after)) == 0
    (normal,), (friction,) = found.normal.values(), found.friction.values()
    # it needs this friction, whatever the restitution
    assert simple(friction / normal + 3 * S * C / (4 - 3 * S**2)) == 0


def test_a_corner_that_slips():
    """To the right: to keep it, the ground would have to push it to the left by more."""
    found = landing("right_slides_right", TURNING_IN)
    lever = 3 * S * (S - MU * C)
    assert simple(found.motion[THETA] / W - (1 - (1 + 2 * E) * lever) / (1 + lever)) == 0


def test_a_flat_bounce_without_friction_does_not_turn():
    found = landing("both_slides_right", {Y: -W})
    assert found.motion[THETA] == 0
    assert sp.simplify(found.motion[Y] - E * W) == 0


def test_a_flat_bounce_that_slides_loads_the_trailing_foot_by_friction():
    """P_R/P_L = (1 + mu h/b)/(1 - mu h/b) while sliding to the right."""
    found = landing("both_slides_right", {Y: -W, X: 10 * W})
    left, right = (found.normal[i].subs(sign_of_slip(0), 1) for i in (0, 1))
    share = MU * H / B
    assert sp.simplify(right / left - (1 + share) / (1 - share)) == 0
    assert found.motion[THETA] == 0


def test_no_impulse_without_an_impact():
    """Rates that the contact allows go on."""
    about = {THETA: W, Y: B * W}  # about the right corner
    found = landing("right", about)
    assert {sp.simplify(e.subs(SIDE, 1)) for e in found.normal.values()} == {0}
    assert simple(found.motion[THETA] - W) == 0


# --- two blocks on one another

STACK = rk.derive("stacked_blocks")
OF = {p.name: p.symbol for p in STACK.parameters}
RATE = {c.name: c.velocity for c in STACK.coordinates}
BELOW, LOW = OF["lower_half_width"], OF["lower_half_height"]
UPPER = {
    OF["upper_half_width"]: RADIUS * S,
    OF["upper_half_height"]: RADIUS * C,
    OF["upper_inertia"]: OF["upper_mass"] * RADIUS**2 / 3,
    SIDE: 1,
}


def test_an_upper_corner_that_lands_lifts_the_lower_block_s_far_foot_if_that_is_near():
    """If and only if b_1 - b_2 < 6 s c h_1/(4 - 3 s^2): the ground would have to pull it."""
    across = {x.position: 0 for x in STACK.coordinates if x.name == "xi"}
    falling = {RATE["phi"]: W, RATE["eta"]: -OF["upper_half_width"] * W}
    found = STACK.mode("both_upper_right").impact.landing(falling, STACK.modes.standing | across)
    left = sp.fraction(sp.together(found.normal[0].subs(UPPER)))[0]
    bound = RADIUS * S + 6 * S * C * LOW / (4 - 3 * S**2)
    (border,) = sp.solve(left, BELOW)
    assert sp.simplify(sp.trigsimp(border - bound)) == 0
    far = left.subs(BELOW, bound + 1).subs({ALPHA: 0.3, RADIUS: 1, LOW: 1, W: 1, E: 0})
    assert far.subs(OF["upper_mass"], 1) > 0
