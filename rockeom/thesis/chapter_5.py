"""Chapter 5: the two-mass structure, rigid (A), on two springs (B) and flexible (C).

Typed by hand from the thesis, in its own symbols.
"""

from sympy import Abs, Float, Matrix, Min, Piecewise, asin, atan, cos, log, pi, sin, sqrt, tanh

from rockeom.thesis import notation as th
from rockeom.thesis.equation import NEGATIVE, POSITIVE, Kind, says, section
from rockeom.thesis.notation import B, H_e, R_b, R_e, W, alpha_b, alpha_e, g, m_b, m_e, s, theta

# --- 5.2: the column of McManus (1980), and what its tests say

E_PEAK_BEFORE, E_PEAK_AFTER = (
    m_e * R_e * (cos(alpha_e - Abs(peak)) - cos(alpha_e))
    + m_b * R_b * (cos(alpha_b - Abs(peak)) - cos(alpha_b))
    for peak in (th.theta_before, th.theta_after)
)
"""5-3 over g, at the peaks before and after an impact."""

CENTRE_ARM = 300 - Min(th.x_centre, th.y_centre)
"""B'(x, y), of a base plate 600 mm wide."""


def rotation(alpha_measured, arm, radius):
    """Rotation about a pivot, by the displacement of a point."""
    return Piecewise(
        (alpha_measured - asin((arm - th.Delta) / radius), th.Delta > 0),
        (asin((arm + th.Delta) / radius) - alpha_measured, th.Delta < 0),
    )


COLUMN = {
    "5-1 stiffness of the column from its period on a fixed base": Kind.CLOSED_FORM(
        th.k,
        4 * pi**2 / th.T_fixed**2 * m_e,
        Float("571.8e3"),
        remark="T_fixed is the 0.092 s of the rubber pad, also where the feet are of steel (runs "
        "1 and 3); with their 0.112 s k is 385.8 kN/m.",
    )
}


STEEL_FEET = {
    "5-2 rotation from the measured displacement": Kind.CLOSED_FORM(
        (
            *says(theta, rotation(th.alpha_measured, th.B_measured, th.R_measured)),
            *says(th.alpha_measured, atan(th.B_measured / th.H_measured)),
        )
    ),
    "5-3 gravitational energy above that of the upright structure": Kind.DEFINITION(
        th.U_grav,
        m_e * g * R_e * (cos(alpha_e - Abs(theta)) - cos(alpha_e))
        + m_b * g * R_b * (cos(alpha_b - Abs(theta)) - cos(alpha_b)),
    ),
    (
        "5-4 ratio of kinetic energies at an impact from the peaks before and after it"
    ): Kind.RESTITUTION(
        th.r_i,
        th.E_after / th.E_before,
        th.U_after / th.U_before,
        E_PEAK_AFTER / E_PEAK_BEFORE,
        remark="The list of symbols has R_e and alpha_e twice, the second time for R_b, alpha_b.",
    ),
}


RUBBER_FEET = {
    "5-5 distance of the centre of rotation from the left edge, on rubber, in mm": Kind.FIT(
        th.x_centre,
        Float("220.1") * tanh(Float("0.1276") * th.Delta) + 300,
        fitted="Fitted to rotation centres that are not in the text, which bears out the 300 mm "
        "of the centreline and a reach within the base plate, and nothing closer.",
        remark="For the column of McManus on rubber and displacements up to 29 mm.",
    ),
    "5-6 5-2 about the centre of rotation of that moment": Kind.APPROXIMATION(
        (
            *says(
                theta,
                rotation(
                    atan(CENTRE_ARM / th.H_measured),
                    CENTRE_ARM,
                    sqrt(CENTRE_ARM**2 + th.H_measured**2),
                ),
            ),
        ),
        remark="Written out; the thesis has alpha', B' and R' as functions of x and y, and H for "
        "H' once. The present centre counts as the pivot of the whole rotation.",
    ),
    "5-7 equivalent viscous damping ratio of a cycle": Kind.APPROXIMATION(
        th.xi_i,
        1 / (2 * pi) * log(th.Delta_i / th.Delta_next),
        remark="The average of 0.104 is of the whole record; the cycles of Figure 5-10 have 0.052 "
        "to 0.083.",
    ),
}


# --- 5.3.1: Model A, two rigid lumped masses on rigid ground


VELOCITY_RATIO = ((m_e * (H_e**2 - B**2) + th.I_eg) + (m_b * (th.H_b**2 - B**2) + th.I_bg)) / (
    (m_e * (H_e**2 + B**2) + th.I_eg) + (m_b * (th.H_b**2 + B**2) + th.I_bg)
)
"""theta_d2 / theta_d1, printed above 5-14."""


def angular_momentum(rate, side):
    """Angular momentum of both masses; side : 1 about the pivot of the turn, -1 about the other."""
    return sum(
        mass * radius * rate * cos(angle) * height
        + side * mass * radius * rate * sin(angle) * B
        + inertia * rate
        for mass, radius, angle, height, inertia in (
            (m_e, R_e, alpha_e, H_e, th.I_eg),
            (m_b, R_b, alpha_b, th.H_b, th.I_bg),
        )
    )


def turning(mass, radius, angle, side):
    """Angular acceleration by the moments of one of the masses."""
    return -mass * radius * g / th.I_O * (th.a_g / g * cos(angle) + side * sin(angle))


MODEL_A = {
    "5-8 moment of inertia about either pivot": Kind.DEFINITION(
        th.I_O, (th.I_eg + m_e * R_e**2) + (th.I_bg + m_b * R_b**2)
    ),
    "5-9 Model A for theta > 0": Kind.MOTION(
        th.theta_dd,
        turning(m_e, R_e, alpha_e - theta, 1) + turning(m_b, R_b, alpha_b - theta, 1),
        illegible="Not legible; the moments about O, in the form of 5-10.",
        sides=POSITIVE,
    ),
    # 5-10 and 5-11 write M_e and M_b for m_e and m_b.
    "5-10 Model A for theta < 0": Kind.MOTION(
        th.theta_dd,
        turning(m_e, R_e, alpha_e + theta, -1) + turning(m_b, R_b, alpha_b + theta, -1),
        sides=NEGATIVE,
    ),
    "5-11 Model A": Kind.MOTION(
        th.theta_dd,
        turning(m_e, R_e, alpha_e + s * theta, s) + turning(m_b, R_b, alpha_b + s * theta, s),
        correction={
            turning(m, R, alpha + s * theta, s): turning(m, R, alpha - s * theta, s)
            for m, R, alpha in ((m_e, R_e, alpha_e), (m_b, R_b, alpha_b))
        },
        reason="The angles are alpha - sgn(theta) theta, as in 5-34; for theta < 0 that is 5-10.",
    ),
    "5-12 angular momentum about the impending pivot, before an impact": Kind.RESTITUTION(
        th.L_before,
        angular_momentum(th.theta_d1, -1),
        ((m_e * (H_e**2 - B**2) + th.I_eg) + (m_b * (th.H_b**2 - B**2) + th.I_bg)) * th.theta_d1,
    ),
    "5-13 angular momentum about the new pivot, after an impact": Kind.RESTITUTION(
        th.L_after,
        angular_momentum(th.theta_d2, 1),
        ((m_e * (H_e**2 + B**2) + th.I_eg) + (m_b * (th.H_b**2 + B**2) + th.I_bg)) * th.theta_d2,
    ),
    "5-14 ratio of kinetic energies at an impact": Kind.RESTITUTION(th.r, VELOCITY_RATIO**2),
}


# --- 5.3.2: Model B, the rigid structure on two springs that only push

LIFT_OFF_FORCE = W / H_e * (B - W * th.H_c / (2 * th.k_f * B))
"""5-26 with the centroid of the system."""


def after_lift_off(angle):
    """Force on one spring at a rotation."""
    return W * th.R_c * sin(th.alpha_c - angle) / (R_e * cos(alpha_e - angle))


MODEL_B = {
    "5-15 equivalent cart": Kind.MOTION((m_e + m_b) * th.u_dd + th.k_u, th.P_t),
    "5-16 settlement under self-weight": Kind.CLOSED_FORM(th.delta_0, W / (2 * th.k_f)),
    "5-17 weight": Kind.DEFINITION(W, (m_e + m_b) * g),
    "5-18 displacement of the superstructure": Kind.CLOSED_FORM(th.u, H_e * sin(theta)),
    "5-19 change of a spring's length, small theta": Kind.APPROXIMATION(th.delta_change, B * theta),
    "5-20 force of the left spring, small theta": Kind.CLOSED_FORM(
        th.f_L, W / 2 - th.k_f * B * theta
    ),
    "5-21 force of the right spring, small theta": Kind.CLOSED_FORM(
        th.f_R, W / 2 + th.k_f * B * theta
    ),
    "5-22 rotation at lift-off, small theta": Kind.CLOSED_FORM(th.theta_crit, W / (2 * th.k_f * B)),
    "5-23 displacement at lift-off": Kind.APPROXIMATION(th.u_crit, W * H_e / (2 * th.k_f * B)),
    "5-24 pushover force with both springs pressed, small theta": Kind.CLOSED_FORM(
        th.P, (2 * th.k_f * B**2 / H_e - g * (m_e + m_b * th.H_b / H_e)) * theta
    ),
    "5-25 the same by the displacement": Kind.CLOSED_FORM(
        th.P, (2 * th.k_f * B**2 - m_e * g * H_e - m_b * g * th.H_b) / H_e**2 * th.u
    ),
    "5-26 force at lift-off": Kind.CLOSED_FORM(
        th.P_crit, W * B / H_e - g * (m_e + m_b * th.H_b / H_e) * W / (2 * th.k_f * B)
    ),
    "5-27 5-25 with the centroid of the system": Kind.CLOSED_FORM(
        th.P, (2 * th.k_f * B**2 - W * th.H_c) / H_e**2 * th.u
    ),
    "5-28 5-24 with the centroid of the system": Kind.CLOSED_FORM(
        th.P,
        (2 * th.k_f * B**2 - W * th.H_c) / H_e * theta,
        illegible="Not legible. The text simplifies 5-24 to 5-26; 5-27 is 5-25 and 5-29 is 5-26: "
        "there remains 5-24, with W H_c for g (m_e H_e + m_b H_b) by 5-17 and 5-30.",
    ),
    "5-29 5-26 with the centroid of the system": Kind.CLOSED_FORM(
        th.P_crit,
        LIFT_OFF_FORCE * th.u,
        correction={LIFT_OFF_FORCE * th.u: LIFT_OFF_FORCE},
        reason="The factor u is too much: with it the right-hand side is not a force.",
    ),
    "5-30 centroid of the system": Kind.DEFINITION(
        (
            *says(th.H_c, (m_e * H_e + m_b * th.H_b) / (m_e + m_b)),
            *says(th.alpha_c, B / th.H_c),
            *says(th.R_c, sqrt(B**2 + th.H_c**2)),
        ),
        correction={B / th.H_c: atan(B / th.H_c)},
        reason="The arctangent of the angle is missing.",
    ),
    "5-31 force after lift-off": Kind.CLOSED_FORM(
        th.P,
        after_lift_off(theta),
        remark="Exact where the pressed foot is held horizontally, about which the moments are "
        "taken. Where the centre of the base is guided instead, as by the two springs, the exact "
        "force is greater by the factor 1 + (B/H_e) tan(theta).",
        sides=POSITIVE,
    ),
    "5-32 force just after lift-off": Kind.CLOSED_FORM(
        th.P_crit2,
        after_lift_off(W / (2 * th.k_f * B)),
        sides=POSITIVE,
    ),
    (
        "5-33 displacement of zero force, and the straight line to it from lift-off"
    ): Kind.APPROXIMATION(
        (
            *says(th.u_overturn, R_e * (sin(alpha_e) + sin(th.alpha_c - alpha_e))),
            *says(th.P, th.P_crit2 * (th.u - th.u_overturn) / (th.u_crit - th.u_overturn)),
        ),
        sides=POSITIVE,
    ),
}


# --- 5.3.3: Model C, the superstructure on a flexible column

THETA_OF_MODEL_C = says(
    (
        m_e * R_e**2
        + m_e * th.u**2
        - s * 2 * m_e * th.u * R_e * sin(alpha_e)
        + th.I_eg
        + m_b * R_b**2
        + th.I_bg
    )
    * th.theta_dd
    + (2 * m_e * th.u * th.u_d - s * 2 * m_e * th.u_d * R_e * sin(alpha_e)) * th.theta_d
    + m_e * th.u_dd * R_e * cos(alpha_e)
    + s * m_e * g * (R_e * sin(alpha_e - s * theta) - s * th.u * cos(theta))
    + s * m_b * g * R_b * sin(alpha_b - s * theta),
    -m_e * th.a_g * (R_e * cos(alpha_e - s * theta) - th.u * sin(theta))
    - m_b * th.a_g * R_b * cos(alpha_b - s * theta),
)
U_OF_MODEL_C = says(
    m_e * th.u_dd
    + m_e * R_e * cos(alpha_e) * th.theta_dd
    - (m_e * th.u - s * m_e * R_e * sin(alpha_e)) * th.theta_d**2
    - m_e * g * sin(theta)
    + th.k * th.u
    + th.c * th.u_d,
    -m_e * th.a_g * cos(theta),
)

MODEL_C_MOTION = {
    "5-34 Model C: rotation": Kind.MOTION(THETA_OF_MODEL_C),
    "5-35 Model C: deformation": Kind.MOTION(U_OF_MODEL_C),
}

MODEL_C_COLUMN = {
    "5-36 viscous coefficient of the column, 3 % of the critical one": Kind.CLOSED_FORM(
        th.c, Float("0.03") * 2 * sqrt(m_e * th.k), Float("502.4")
    ),
    "5-37 displacement of the superstructure from its upright position": Kind.CLOSED_FORM(
        th.displacement,
        Matrix(
            [
                s * R_e * (sin(alpha_e) - sin(alpha_e - s * theta)) + th.u * cos(theta),
                R_e * (cos(alpha_e - s * theta) - cos(alpha_e)) - th.u * sin(theta),
            ]
        ),
    ),
}

CHAPTER_5 = (
    *section("5.2", COLUMN, units="571800 N/m"),
    *section("5.2.1", STEEL_FEET),
    *section("5.2.2", RUBBER_FEET, units="220.1 mm, 0.1276 1/mm, 300 mm"),
    *section("5.3.1", MODEL_A),
    *section("5.3.2", MODEL_B),
    *section("5.3.3", MODEL_C_MOTION),
    *section("5.3.3.1", MODEL_C_COLUMN, units="502.4 N s/m"),
)
