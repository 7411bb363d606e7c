"""Rewritings of six equations of the thesis, right and wrong, as a reader would type them.

The equations are 2-2, 2-6, 5-14, 5-34, 5-35 and D-23 as corrected. RIGHT has 40 equations that
say the same as the derived ones, WRONG has 40 with one error each. The equations of motion have
both accelerations of the ground, a_x and a_y; one without them is another equation.

Symbols are plain, without assumptions. `as_declared` gives them the assumptions of the models,
`in_time` writes coordinates as functions of time, `by_parameter` replaces the symbols of
parameters by their names.
"""

from functools import partial
from typing import NamedTuple

import sympy as sp
from sympy import Abs, Eq, cos, sign, sin, sqrt, tan
from sympy.physics.mechanics import dynamicsymbols

t = dynamicsymbols._t

PARAMETERS = sp.symbols("B H m I_g g m_e H_e I_eg m_b H_b I_bg k c")
B, H, m, I_g, g, m_e, H_e, I_eg, m_b, H_b, I_bg, k, c = PARAMETERS
R, alpha, p, I_o, R_e, alpha_e, R_b, alpha_b = sp.symbols("R alpha p I_o R_e alpha_e R_b alpha_b")
STATES = sp.symbols("theta theta_dot theta_ddot u u_dot u_ddot theta_dot_after a_x a_y s")
theta, theta_dot, theta_ddot, u, u_dot, u_ddot, theta_dot_after, a_x, a_y, s = STATES
r, e = sp.symbols("r e")

G = g + a_y
J = I_g + m * (B**2 + H**2)
"""I_o of the block in its parameters."""
J_A = I_bg + I_eg + m_b * (B**2 + H_b**2) + m_e * (B**2 + H_e**2)
"""I_o of the lumped-mass structure in its parameters."""


class Rewriting(NamedTuple):
    """An equation, with the place of the derived one that it is to be compared with.

    model : name of the shipped structure. where : the mode, or the modes before and after an
    impact. why : what was rewritten, or the error. factor : left minus right side over that of
    the derived equation, in plain symbols of parameters; None for 1. The derived equation is a
    row of M q'' - forcing, a row of M+ q'+ - momentum, r - ratio**2 or e - ratio.
    """

    number: str
    model: str
    where: dict
    equation: sp.Expr | sp.Eq
    why: str
    factor: sp.Expr | None = None


# --- ways to write a symbol


def as_declared(equation):
    """Symbols with the assumptions that the models give them."""
    put = {x: sp.Symbol(x.name, positive=True) for x in PARAMETERS}
    return equation.xreplace(put | {x: sp.Symbol(x.name, real=True) for x in STATES})


def in_time(equation):
    """Coordinates and their derivatives as functions of time."""
    rotation, deformation = dynamicsymbols("theta u")
    put = {theta: rotation, theta_dot: rotation.diff(t), theta_ddot: rotation.diff(t, 2)}
    put |= {u: deformation, u_dot: deformation.diff(t), u_ddot: deformation.diff(t, 2)}
    return equation.xreplace(put)


def by_parameter(equation):
    """Parameters by their names."""
    names = {m: "mass", H: "height", I_g: "inertia", B: "half_width", g: "gravity"}
    names |= {m_e: "mass", H_e: "height", I_eg: "inertia", k: "stiffness", c: "damping"}
    names |= {m_b: "base_mass", H_b: "base_height", I_bg: "base_inertia"}
    return equation.xreplace({x: sp.Symbol(name) for x, name in names.items()})


def by_half_angle(equation):
    """Sine and cosine of theta by the tangent of its half."""
    z = tan(theta / 2)
    return equation.xreplace({sin(theta): 2 * z / (1 + z**2), cos(theta): (1 - z**2) / (1 + z**2)})


# --- terms of 2-2 and 5-35, for theta > 0 (side 1) and theta < 0 (side -1), all on the left side


def swing(side):
    """Moments on the block by R and alpha."""
    angle = alpha - side * theta
    return side * m * G * R * sin(angle) + m * a_x * R * cos(angle)


def bend(side):
    """The deformation of the flexible structure, by B and H_e, but for the damper."""
    along = m_e * H_e * theta_ddot + m_e * u_ddot + m_e * (side * B - u) * theta_dot**2
    return along + k * u - m_e * G * sin(theta) + m_e * a_x * cos(theta)


# --- terms of 5-34; D-23 is the equation for theta < 0


class Terms(NamedTuple):
    """Terms of the rotation of the flexible structure, all on the left side."""

    inertia: sp.Expr
    coupling: sp.Expr
    velocity: sp.Expr
    weight_b: sp.Expr
    weight_e: sp.Expr
    ground_b: sp.Expr
    ground_e: sp.Expr


def rotation_terms(side):
    pivot_inertia = I_bg + I_eg + m_b * R_b**2 + m_e * (R_e**2 + u**2)
    return Terms(
        inertia=(pivot_inertia - 2 * side * m_e * u * R_e * sin(alpha_e)) * theta_ddot,
        coupling=m_e * R_e * cos(alpha_e) * u_ddot,
        velocity=(2 * m_e * u * u_dot - 2 * side * m_e * R_e * sin(alpha_e) * u_dot) * theta_dot,
        weight_b=side * m_b * G * R_b * sin(alpha_b - side * theta),
        weight_e=m_e * G * (side * R_e * sin(alpha_e - side * theta) - u * cos(theta)),
        ground_b=m_b * a_x * R_b * cos(alpha_b - side * theta),
        ground_e=m_e * a_x * (R_e * cos(alpha_e - side * theta) - u * sin(theta)),
    )


PLUS, MINUS = rotation_terms(1), rotation_terms(-1)
MOMENT_OF_U = m_e * G * u * cos(theta)


def balance(terms):
    """Terms of the motion on the left side, those of the ground on the right."""
    return Eq(sum(terms[:5]), -terms.ground_b - terms.ground_e)


def lagrange(side):
    """Lagrange's equation of the rotation of the flexible structure, from its places."""
    turn, deformation = dynamicsymbols("theta u")
    kinetic = (I_eg + I_bg) * turn.diff(t) ** 2 / 2
    potential = 0
    for mass, x, y in ((m_e, deformation - side * B, H_e), (m_b, -side * B, H_b)):
        right, up = x * cos(turn) + y * sin(turn), y * cos(turn) - x * sin(turn)
        kinetic += mass * (right.diff(t) ** 2 + up.diff(t) ** 2) / 2
        potential += mass * (a_x * right + G * up)
    return kinetic.diff(turn.diff(t)).diff(t) - (kinetic - potential).diff(turn)


# --- where each equation belongs

ON_RIGHT, ON_LEFT, IMPACT = {"mode": "right"}, {"mode": "left"}, {"impact": ("right", "left")}

block_right = partial(Rewriting, "2-2", "rigid_block", ON_RIGHT)
block_left = partial(Rewriting, "2-2", "rigid_block", ON_LEFT)
block_impact = partial(Rewriting, "2-6", "rigid_block", IMPACT)
impact_a = partial(Rewriting, "5-14", "lumped_mass_structure", IMPACT)
impact_c = partial(Rewriting, "5-14", "flexible_structure", {"impact": ("left", "right")})
turn_right = partial(Rewriting, "5-34", "flexible_structure", ON_RIGHT)
turn_left = partial(Rewriting, "5-34", "flexible_structure", ON_LEFT)
bend_right = partial(Rewriting, "5-35", "flexible_structure", ON_RIGHT)
bend_left = partial(Rewriting, "5-35", "flexible_structure", ON_LEFT)
d_23 = partial(Rewriting, "D-23", "flexible_structure", ON_LEFT)

LOAD = m * G * (B * cos(theta) - H * sin(theta)) + m * a_x * (H * cos(theta) + B * sin(theta))
"""Moments on the block by B and H, theta > 0."""
SPIN = p**2 * ((1 + a_y / g) * sin(alpha - theta) + a_x / g * cos(alpha - theta))
"""Moments over I_o in Housner's form, theta > 0."""
AFTER_A = I_bg + I_eg + m_b * (H_b**2 - B**2) + m_e * (H_e**2 - B**2)
"""Angular momentum of the lumped-mass structure about the new pivot over theta_dot."""

RIGHT = (
    # -- 2-2
    block_right(as_declared(Eq(J * theta_ddot, -sp.expand(LOAD))), "moments on the right side"),
    block_right(Eq(theta_ddot, -SPIN), "Housner's form, by p and alpha", 1 / J),
    block_left(
        Eq(I_o * theta_ddot, m * R * (G * sin(alpha + theta) - a_x * cos(alpha + theta))),
        "by R and alpha, for theta < 0",
    ),
    block_right(
        in_time((I_o * theta_ddot + swing(1)) / (m * g * R)),
        "divided by m g R",
        1 / (m * g * sqrt(B**2 + H**2)),
    ),
    block_left(
        Eq(theta_ddot, -sp.expand(swing(sign(theta)) * p**2 / (m * g * R))), "by sgn(theta)", 1 / J
    ),
    block_right(by_parameter(-J * theta_ddot - LOAD), "parameters by name", sp.Integer(-1)),
    block_right(by_half_angle(J * theta_ddot + LOAD), "by the tangent of half the rotation"),
    block_left(as_declared(J * theta_ddot / m + LOAD.subs(B, s * B) / m), "by s", 1 / m),
    block_right(
        in_time(
            Eq(
                (I_g + m * R**2) * theta_ddot + sign(theta) * m * G * R * sin(alpha - Abs(theta)),
                -m * a_x * R * cos(alpha - Abs(theta)),
            )
        ),
        "by the absolute value of theta",
    ),
    # -- 2-6
    block_impact(Eq(r, (1 - m * R**2 / I_o * (1 - cos(2 * alpha))) ** 2), "Housner's form"),
    block_impact(Eq(r, (1 - 2 * m * R**2 * sin(alpha) ** 2 / I_o) ** 2), "double angle resolved"),
    block_impact(as_declared(Eq(e, (I_g + m * (H**2 - B**2)) / J)), "ratio of velocities"),
    block_impact(Eq(I_o**2 * r, (I_o - 2 * m * B**2) ** 2), "times the square of I_o", J**2),
    block_impact(
        Eq((I_g + m * R**2) * theta_dot_after, (I_g + m * R**2 * cos(2 * alpha)) * theta_dot),
        "angular momentum about the new pivot",
    ),
    block_impact(
        in_time(Eq(theta_dot_after, (1 - 2 * m * B**2 / J) * theta_dot)),
        "velocity after the impact",
        1 / J,
    ),
    block_impact(
        Eq((1 - 2 * m * R**2 * tan(alpha) ** 2 / (1 + tan(alpha) ** 2) / I_o) ** 2, r),
        "by the tangent of alpha, r on the right side",
        sp.Integer(-1),
    ),
    # -- 5-14
    impact_a(as_declared(Eq(r, AFTER_A**2 / J_A**2)), "as printed"),
    impact_a(Eq(r, (1 - 2 * (m_b + m_e) * B**2 / I_o) ** 2), "by the inertia about the pivot"),
    impact_a(
        Eq(
            e,
            (I_bg + I_eg + m_b * R_b**2 * cos(2 * alpha_b) + m_e * R_e**2 * cos(2 * alpha_e))
            / (I_bg + I_eg + m_b * R_b**2 + m_e * R_e**2),
        ),
        "ratio of velocities by distances and angles",
    ),
    impact_a(
        in_time(Eq(I_o * theta_dot_after, (I_o - 2 * (m_e + m_b) * B**2) * theta_dot)),
        "angular momentum about the new pivot",
    ),
    impact_a(by_parameter(sp.expand(r * J_A**2 - AFTER_A**2)), "times the denominator", J_A**2),
    impact_c(
        as_declared(Eq(e, 1 - 2 * (m_e + m_b) * B**2 / J_A)), "the flexible structure held rigid"
    ),
    # -- 5-34
    turn_right(balance(PLUS), "as printed for theta > 0, with a_y"),
    turn_left(balance(rotation_terms(s)), "by s"),
    turn_right(sp.expand(sum(-term / m_e for term in PLUS)), "divided by -m_e", -1 / m_e),
    turn_left(lagrange(-1), "Lagrange's equation from the places of the masses"),
    turn_right(in_time(balance(rotation_terms(sign(theta)))), "by sgn(theta)"),
    turn_right(
        as_declared(
            Eq(
                (I_bg + I_eg + m_b * (B**2 + H_b**2) + m_e * (H_e**2 + (B - u) ** 2)) * theta_ddot
                + m_e * H_e * u_ddot
                - 2 * m_e * (B - u) * theta_dot * u_dot,
                m_b * G * (H_b * sin(theta) - B * cos(theta))
                + m_e * G * (H_e * sin(theta) - (B - u) * cos(theta))
                - m_b * a_x * (H_b * cos(theta) + B * sin(theta))
                - m_e * a_x * (H_e * cos(theta) + (B - u) * sin(theta)),
            )
        ),
        "by width and height, B - u together",
    ),
    # -- 5-35
    bend_right(
        Eq(
            m_e * R_e * cos(alpha_e) * theta_ddot
            + m_e * u_ddot
            + c * u_dot
            - (m_e * u - m_e * R_e * sin(alpha_e)) * theta_dot**2
            + k * u
            - m_e * g * sin(theta),
            -m_e * a_x * cos(theta) + m_e * a_y * sin(theta),
        ),
        "as printed for theta > 0, with a_y",
    ),
    bend_right(
        as_declared(
            Eq(
                u_ddot + H_e * theta_ddot - (u - B) * theta_dot**2 + (c * u_dot + k * u) / m_e,
                G * sin(theta) - a_x * cos(theta),
            )
        ),
        "divided by m_e",
        1 / m_e,
    ),
    bend_right(by_parameter(-bend(1) - c * u_dot), "parameters by name", sp.Integer(-1)),
    bend_left(in_time(Eq(c * u_dot, -sp.expand(bend(-1)))), "the damper alone on the left side"),
    bend_left((bend(s) + c * u_dot).subs(H_e, B / tan(alpha_e)), "by s, B and alpha_e"),
    bend_right(by_half_angle(Eq(c / k * u_dot, -bend(1) / k)), "divided by k", 1 / k),
    # -- D-23
    d_23(balance(MINUS), "as corrected, with a_y"),
    d_23(in_time(sp.expand_trig(balance(MINUS))), "sums of angles expanded"),
    d_23(
        sum(-term / (m_b * g * R_b) for term in MINUS),
        "divided by -m_b g R_b",
        -1 / (m_b * g * sqrt(B**2 + H_b**2)),
    ),
    d_23(
        as_declared(
            (I_bg + I_eg + m_b * (B**2 + H_b**2) + m_e * (H_e**2 + (B + u) ** 2)) * theta_ddot
            + m_e * H_e * u_ddot
            + 2 * m_e * (B + u) * theta_dot * u_dot
            - (m_b * H_b + m_e * H_e) * (G * sin(theta) - a_x * cos(theta))
            - (m_b * B + m_e * (B + u)) * (G * cos(theta) + a_x * sin(theta))
        ),
        "by width and height, masses together",
    ),
    d_23(Eq(2 * sum(MINUS[:3]), -2 * sum(MINUS[3:])), "times 2", sp.Integer(2)),
    d_23(
        by_parameter(sum(rotation_terms(s)).subs({R_b: B / sin(alpha_b), R_e: B / sin(alpha_e)})),
        "by s; distances from the pivot by B and angles",
    ),
)

WRONG = (
    # -- 2-2
    block_right(Eq(theta_ddot, -SPIN.subs(theta, -theta)), "alpha + theta for alpha - theta"),
    block_left(
        Eq(I_o * theta_ddot, m * R * (G * sin(alpha - theta) - a_x * cos(alpha - theta))),
        "theta for s theta on the left side",
    ),
    block_right(as_declared(J * theta_ddot + LOAD.subs(B, 2 * B)), "width for half of it"),
    block_right(in_time(Eq(I_g * theta_ddot, -LOAD)), "Steiner term missing"),
    block_right(Eq(theta_ddot, -SPIN / p), "p for p**2"),
    block_right(
        Eq(theta_ddot, -(p**2) * ((1 + a_y / g) * (alpha - theta) + a_x / g)),
        "form for small angles",
    ),
    block_right(as_declared(J * theta_ddot + LOAD.subs(g, -g - 2 * a_y)), "sign of the weight"),
    block_right(in_time(I_o * theta_ddot + swing(1).subs(a_y, 0)), "a_y missing"),
    # -- 2-6
    block_impact(Eq(e, (1 - m * R**2 / I_o * (1 - cos(2 * alpha))) ** 2), "e for r"),
    block_impact(as_declared(Eq(r, 1 - 2 * m * B**2 / J)), "r for e"),
    block_impact(Eq(r, (1 - m * R**2 / I_o * (1 - cos(alpha))) ** 2), "alpha for 2 alpha"),
    block_impact(Eq(r, (1 - m * R**2 / I_o * (1 + cos(2 * alpha))) ** 2), "sign of the cosine"),
    block_impact(
        Eq(I_g * theta_dot_after, (I_g + m * (H**2 - B**2)) * theta_dot), "I_g for I_o after"
    ),
    block_impact(Eq(r, (1 - sp.Rational(3, 2) * sin(alpha) ** 2) ** 2), "of a rectangle only"),
    block_impact(
        in_time(Eq(I_o * theta_dot_after, (I_o - m * B**2) * theta_dot)), "factor 2 missing"
    ),
    # -- 5-14
    impact_a(Eq(r, AFTER_A / J_A), "square missing"),
    impact_a(as_declared(Eq(r, (AFTER_A / J_A).subs(H_e, H_b) ** 2)), "H_b for H_e"),
    impact_a(by_parameter(Eq(e, (AFTER_A + 2 * m_b * B**2) / J_A)), "sign of m_b B**2"),
    impact_a(Eq(r, (AFTER_A / J_A).subs(I_eg, 0) ** 2), "inertia of the superstructure missing"),
    impact_a(Eq(r, (1 - 2 * (m_b + m_e) * (2 * B) ** 2 / I_o) ** 2), "2 B for B"),
    impact_c(Eq(e, (AFTER_A / J_A) ** 2), "e for r"),
    # -- 5-34
    turn_right(in_time(balance(PLUS._replace(velocity=0 * u))), "Coriolis term missing"),
    turn_right(balance(PLUS._replace(velocity=PLUS.velocity / 2)), "factor 2 missing"),
    turn_right(sum(PLUS) + 2 * MOMENT_OF_U, "sign of u cos(theta)"),
    turn_right(as_declared(balance(PLUS._replace(coupling=m_e * H_b * u_ddot))), "H_b for H_e"),
    turn_left(sum(rotation_terms(s)) - m_e * u**2 * theta_ddot, "inertia m_e u**2 missing"),
    turn_right(balance(PLUS).subs(a_y, 0), "a_y missing"),
    turn_left(lagrange(-1) - in_time(m_b * B**2 * theta_ddot), "part of a Steiner term missing"),
    # -- 5-35
    bend_right(Eq(bend(1), 0), "damping missing"),
    bend_right(in_time(bend(1).subs(theta_dot**2, theta_dot) + c * u_dot), "square missing"),
    bend_right(
        as_declared(
            Eq(
                u_ddot + H_e * theta_ddot + (B - u) * theta_dot**2 + (c * u_dot + k * u) / m_e,
                G * cos(theta) - a_x * sin(theta),
            )
        ),
        "sine and cosine exchanged",
    ),
    bend_left(in_time(Eq(bend(1), -c * u_dot)), "form of the right side on the left one"),
    bend_right((bend(1) + c * u_dot).subs(H_e, R_e), "distance from the pivot for the height"),
    bend_left(by_parameter(bend(-1) + c * u_dot + 2 * m_e * u * theta_dot**2), "sign of u"),
    # -- D-23
    d_23(balance(MINUS._replace(weight_e=MINUS.weight_e + 2 * MOMENT_OF_U)), "as printed"),
    d_23(
        in_time(balance(MINUS._replace(weight_b=-m_b * G * R_b * sin(alpha_b - theta)))),
        "alpha_b - theta for alpha_b + theta",
    ),
    d_23(balance(MINUS._replace(inertia=PLUS.inertia)), "inertia of the right side"),
    d_23(as_declared(sum(MINUS) + 2 * m_e * a_x * u * sin(theta)), "sign of u sin(theta)"),
    d_23(sum(MINUS) + m_b * (R_b - R_b**2) * theta_ddot, "R_b for R_b**2"),
    d_23(
        balance(MINUS._replace(velocity=2 * m_e * (u + R_e * sin(alpha_e)) * theta_dot**2)),
        "square of theta_dot for theta_dot u_dot",
    ),
)
