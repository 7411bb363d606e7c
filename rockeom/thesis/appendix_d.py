"""Appendix D: Model C derived.

Typed by hand from the thesis, in its own symbols. A vector is a column (i, j), measured from the
pivot of its side: O for theta > 0, O' for theta < 0.
"""

from sympy import Derivative, Integer, Matrix, Rational, cos, sign, sin

from rockeom.thesis import notation as th
from rockeom.thesis.chapter_5 import THETA_OF_MODEL_C, U_OF_MODEL_C
from rockeom.thesis.equation import NEGATIVE, POSITIVE, Kind, replaced, says, section
from rockeom.thesis.notation import R_b, R_e, alpha_b, alpha_e, m_b, m_e, theta, theta_d, u, u_d

X_E = -R_e * sin(alpha_e - theta) + u * cos(theta)
X_B = -R_b * sin(alpha_b - theta)


def kinetic(mass, squared_speed, inertia):
    """Kinetic energy of one of the masses."""
    return Rational(1, 2) * mass * squared_speed + Rational(1, 2) * inertia * theta_d**2


D_8_BRACKETS = (
    R_e * theta_d * cos(alpha_e - theta) - theta_d * u * sin(theta) + u_d * cos(theta),
    R_e * theta_d * sin(alpha_e - theta) - theta_d * u * cos(theta) + u_d * sin(theta),
)


def d_8_squares(rate, last):
    """The last line of D-8, the square of each bracket by itself.

    Slips that cancel between the two are seen only there: `rate` stands for theta' in both terms
    of u u', and `last` is the function squared in the last one.
    """
    return (
        R_e**2 * theta_d**2 * cos(alpha_e - theta) ** 2
        - 2 * R_e * u * theta_d**2 * sin(theta) * cos(alpha_e - theta)
        + 2 * u_d * R_e * theta_d * cos(alpha_e - theta) * cos(theta)
        + u**2 * theta_d**2 * sin(theta) ** 2
        - 2 * u * u_d * rate * sin(theta) * cos(theta)
        + u_d**2 * cos(theta) ** 2,
        R_e**2 * theta_d**2 * sin(alpha_e - theta) ** 2
        - 2 * R_e * u * theta_d**2 * cos(theta) * sin(alpha_e - theta)
        - 2 * u_d * R_e * theta_d * sin(alpha_e - theta) * sin(theta)
        + u**2 * theta_d**2 * cos(theta) ** 2
        + 2 * u * u_d * rate * sin(theta) * cos(theta)
        + u_d**2 * last(theta) ** 2,
    )


T_E = kinetic(
    m_e,
    R_e**2 * theta_d**2
    + u**2 * theta_d**2
    + u_d**2
    - 2 * R_e * u * theta_d**2 * sin(alpha_e)
    + 2 * u_d * R_e * theta_d * cos(alpha_e),
    th.I_eg,
)
T_B_FIRST = kinetic(
    m_b,
    (R_b * theta_d * cos(alpha_b - theta)) ** 2 + (R_b * theta_d * sin(alpha_b - theta)) ** 2,
    th.I_bg,
)
T_B = kinetic(m_b, R_b * theta_d**2, th.I_bg)
SQUARED = {m_b * R_b * theta_d**2 / 2: m_b * R_b**2 * theta_d**2 / 2}
V_OF_MODEL_C = (
    m_e * th.g * (R_e * cos(alpha_e - theta) - u * sin(theta))
    + m_b * th.g * (R_b * cos(alpha_b - theta))
    + Rational(1, 2) * th.k * u**2
)


def on_side(relations, side):
    """Relations for one sign of theta."""
    return replaced(relations, {th.s: Integer(side)})


FROM_RIGHT_PIVOT = {
    "D-1 position of the superstructure from O": Kind.DEFINITION(
        th.r_e, Matrix([X_E, R_e * cos(alpha_e - theta) - u * sin(theta)])
    ),
    "D-2 position of the base structure from O": Kind.DEFINITION(
        th.r_b,
        Matrix([-R_b * sin(alpha_e - theta), R_b * cos(alpha_e - theta)]),
        correction={f(alpha_e - theta): f(alpha_b - theta) for f in (sin, cos)},
        reason="alpha_e is printed for alpha_b.",
    ),
    "D-3 velocity of the superstructure": Kind.CLOSED_FORM(
        th.v_e,
        Matrix(
            [
                theta_d * R_e * cos(alpha_e - theta) - theta_d * u * sin(theta) + u_d * cos(theta),
                theta_d * R_e * sin(alpha_e - theta) - theta_d * u * cos(theta) - u_d * sin(theta),
            ]
        ),
    ),
    "D-4 velocity of the base structure": Kind.CLOSED_FORM(
        th.v_b,
        Matrix([theta_d * R_b * cos(alpha_e - theta), theta_d * R_b * sin(alpha_e - theta)]),
        correction={f(alpha_e - theta): f(alpha_b - theta) for f in (sin, cos)},
        reason="alpha_e is printed for alpha_b.",
    ),
    "D-6 Lagrangian": Kind.DEFINITION(th.L, th.T - th.V),
    "D-7 kinetic energy": Kind.DEFINITION(th.T, th.T_e + th.T_b),
    "D-8 kinetic energy of the superstructure": Kind.CLOSED_FORM(
        th.T_e,
        kinetic(m_e, D_8_BRACKETS[0] ** 2 + D_8_BRACKETS[1] ** 2, th.I_eg),
        kinetic(m_e, sum(d_8_squares(1, cos)), th.I_eg),
        correction={
            u_d * sin(theta): -u_d * sin(theta),
            2 * u_d**2 * cos(theta) ** 2: u_d**2 * cos(theta) ** 2 + u_d**2 * sin(theta) ** 2,
        },
        reason="Four slips: + u' sin(theta) for - u' sin(theta) in the second bracket; theta' "
        "missing in both terms 2 u u' sin(theta) cos(theta); u'^2 cos(theta)^2 for u'^2 "
        "sin(theta)^2 in the square of the second bracket.",
    ),
    "D-11 kinetic energy of the superstructure": Kind.CLOSED_FORM(th.T_e, T_E),
    "D-12 kinetic energy of the base structure": Kind.CLOSED_FORM(
        th.T_b, T_B_FIRST, T_B, correction=SQUARED, reason="R_b is not squared in the last line."
    ),
    "D-13 potential energy": Kind.CLOSED_FORM(th.V, V_OF_MODEL_C),
    "D-14 Lagrangian written out": Kind.CLOSED_FORM(
        th.L,
        T_E + T_B - V_OF_MODEL_C,
        correction=SQUARED,
        reason="R_b is not squared in the kinetic energy of the base structure, as in D-12.",
    ),
    "D-16 generalised forces of the d'Alembert loads -m a_g i": Kind.DEFINITION(
        (
            *says(
                th.Q_theta,
                -m_e * th.a_g * Derivative(X_E, theta) - m_b * th.a_g * Derivative(X_B, theta),
            ),
            *says(th.Q_u, -m_e * th.a_g * Derivative(X_E, u) - m_b * th.a_g * Derivative(X_B, u)),
        ),
        illegible="Not legible; the definition of a generalised force, of which D-17 and D-18 "
        "follow.",
    ),
    "D-17 generalised force of the rotation": Kind.CLOSED_FORM(
        th.Q_theta,
        -m_e * th.a_g * (R_e * cos(alpha_e - theta) - u * sin(theta))
        - m_b * th.a_g * R_b * cos(alpha_b - theta),
    ),
    "D-18 generalised force of the deformation": Kind.CLOSED_FORM(
        th.Q_u, -m_e * th.a_g * cos(theta)
    ),
    "D-19 Model C for theta > 0: rotation": Kind.MOTION(
        on_side(THETA_OF_MODEL_C, 1),
        illegible="Not legible; D-5 with D-14 (corrected), D-15 and D-17.",
    ),
    "D-20 Model C for theta > 0: deformation": Kind.MOTION(
        on_side(U_OF_MODEL_C, 1), illegible="Not legible; D-5 with D-14 (corrected), D-15 and D-18."
    ),
}


FROM_LEFT_PIVOT = {
    "D-21 position of the superstructure from O'": Kind.DEFINITION(
        th.r_e,
        Matrix(
            [
                R_e * sin(alpha_e + theta) + u * cos(theta),
                R_e * cos(alpha_e + theta) - u * sin(theta),
            ]
        ),
    ),
    "D-22 position of the base structure from O'": Kind.DEFINITION(
        th.r_b,
        Matrix([R_b * sin(alpha_e + theta), R_b * cos(alpha_e + theta)]),
        correction={f(alpha_e + theta): f(alpha_b + theta) for f in (sin, cos)},
        reason="alpha_e is printed for alpha_b.",
    ),
    "D-23 Model C for theta < 0: rotation": Kind.MOTION(
        replaced(on_side(THETA_OF_MODEL_C, -1), {u * cos(theta): -u * cos(theta)}),
        correction={-u * cos(theta): u * cos(theta)},
        reason="In the gravity term the sign of u cos(theta) is wrong: a deformation u > 0 moves "
        "the weight to the right on either side, so that D-19, D-23 and D-25 alike have -m_e g u "
        "cos(theta).",
    ),
    "D-24 Model C for theta < 0: deformation": Kind.MOTION(on_side(U_OF_MODEL_C, -1)),
}


# --- the first-order form

S_Y = sign(th.y_3)

DEFORMATION_ROW = says(
    m_e * th.y_2d + (m_e * R_e * cos(alpha_e)) * th.y_4d,
    (m_e * th.y_1 - S_Y * m_e * R_e * sin(alpha_e)) * th.y_4**2
    + m_e * th.g * sin(th.y_3)
    - th.k * th.y_1
    - th.c * th.y_2
    - m_e * th.a_g * cos(th.y_3),
)


# u and u' stand for y_1 and y_2
ROTATION_ROW = says(
    th.f_1 * th.y_2d + th.f_2 * th.y_4d,
    (S_Y * 2 * m_e * u_d * R_e * sin(alpha_e) - 2 * m_e * u * u_d) * th.y_4
    - S_Y * m_e * th.g * (R_e * sin(alpha_e - S_Y * th.y_3) - S_Y * th.y_1 * cos(th.y_3))
    - S_Y * m_b * th.g * R_b * sin(alpha_b - S_Y * th.y_3)
    - m_e * th.a_g * (R_e * cos(alpha_e - S_Y * th.y_3) - th.y_1 * sin(th.y_3))
    - m_b * th.a_g * R_b * cos(alpha_b - S_Y * th.y_3),
)

ON_EITHER_SIDE = {
    "D-5 Lagrange's equation with a dissipation function": Kind.DEFINITION(
        Derivative(Derivative(th.LAGRANGIAN(th.q_t, th.q_t.diff(th.t)), th.q_t.diff(th.t)), th.t)
        - Derivative(th.LAGRANGIAN(th.q_t, th.q_t.diff(th.t)), th.q_t)
        + Derivative(th.DISSIPATION(th.q_t.diff(th.t)), th.q_t.diff(th.t)),
        th.Q_i,
    ),
    "D-9 sine of a sum": Kind.DEFINITION(
        sin(th.A_angle + th.PM * th.B_angle),
        sin(th.A_angle) * cos(th.B_angle) + th.PM * cos(th.A_angle) * sin(th.B_angle),
    ),
    "D-10 cosine of a sum": Kind.DEFINITION(
        cos(th.A_angle + th.PM * th.B_angle),
        cos(th.A_angle) * cos(th.B_angle) - th.PM * sin(th.A_angle) * sin(th.B_angle),
    ),
    "D-15 dissipation function (the thesis calls it a force)": Kind.DEFINITION(
        th.F_nc, Rational(1, 2) * th.c * u_d**2
    ),
    "D-25 Model C: rotation, as 5-34": Kind.MOTION(THETA_OF_MODEL_C),
    "D-26 Model C: deformation, as 5-35": Kind.MOTION(U_OF_MODEL_C),
    "D-27 Model C as a system of first order, y = (u, u', theta, theta')": Kind.PROCEDURE(
        th.M_matrix * th.y_d_column,
        th.f_column,
        remark="f is a function of t and y; so is M, which D-28 shows.",
    ),
    "D-28 its rows": Kind.PROCEDURE(
        (*says(th.y_1d, th.y_2), *DEFORMATION_ROW, *says(th.y_3d, th.y_4), *ROTATION_ROW),
        remark="u and u' in the first bracket of the last row are y_1 and y_2, two notations "
        "mixed.",
    ),
    "D-29 the coefficients of its last row": Kind.PROCEDURE(
        (
            *says(th.f_1, m_e * R_e * cos(alpha_e)),
            *says(
                th.f_2,
                m_e * R_e**2
                + m_e * th.y_1**2
                - S_Y * 2 * m_e * th.y_1 * R_e * sin(alpha_e)
                + th.I_eg
                + m_b * R_b**2
                + th.I_bg,
            ),
        )
    ),
}

APPENDIX_D = (
    *section("Appendix D", FROM_RIGHT_PIVOT, sides=POSITIVE),
    *section("Appendix D", FROM_LEFT_PIVOT, sides=NEGATIVE),
    *section("Appendix D", ON_EITHER_SIDE),
)
