"""Chapter 3: the rigid block of the free rocking tests, its energy and its support forces.

Typed by hand from the thesis, in its own symbols.
"""

from sympy import Abs, Float, Q, Rational, cos, sin, sqrt

from rockeom.thesis import notation as th
from rockeom.thesis.equation import POSITIVE, Domain, Kind, section
from rockeom.thesis.notation import R, alpha, g, m, s, theta, theta_d, theta_d_peak, theta_dd

PEAK_BEFORE = m * g * R * (cos(alpha - Abs(th.theta_before)) - cos(alpha))
PEAK_AFTER = m * g * R * (cos(alpha - Abs(th.theta_after)) - cos(alpha))
"""3-2 at the peaks before and after an impact."""

ENERGIES = {
    "3-1 kinetic energy of the block": Kind.DEFINITION(
        th.E_k, Rational(1, 2) * th.I_o * theta_d**2
    ),
    "3-2 gravitational energy above that of the upright block": Kind.DEFINITION(
        th.U, m * g * R * (cos(alpha - Abs(theta)) - cos(alpha))
    ),
    (
        "3-3 ratio of kinetic energies at an impact from the peaks before and after it"
    ): Kind.RESTITUTION(
        th.r,
        th.E_after / th.E_before,
        th.U_after / th.U_before,
        PEAK_AFTER / PEAK_BEFORE,
    ),
    "3-4 energy of a hypothetical rotational spring": Kind.DEFINITION(
        th.U_rot, Rational(1, 2) * th.k_rot * theta**2
    ),
}


ANGLE = alpha - Abs(theta)
ACROSS = th.a_gx + s * R * theta_d**2 * sin(ANGLE) + R * theta_dd * cos(ANGLE)
UPWARD = -R * theta_d**2 * cos(ANGLE) + s * R * theta_dd * sin(ANGLE)
"""Acceleration of the centroid, 3-6 and 3-7."""

SUPPORT_FORCES = {
    (
        "3-5 acceleration of the centroid: of the ground, and of the turn about the pivot"
    ): Kind.DEFINITION(th.u_c_dd, th.a_g + th.u_cg_dd),
    "3-6 horizontal acceleration of the centroid": Kind.CLOSED_FORM(
        th.u_cx_dd,
        ACROSS,
    ),
    "3-7 vertical acceleration of the centroid": Kind.CLOSED_FORM(
        th.u_cy_dd,
        UPWARD,
    ),
    "3-8 horizontal force of the support": Kind.CLOSED_FORM(
        th.F_H,
        m * ACROSS,
    ),
    "3-9 vertical force of the support": Kind.CLOSED_FORM(
        th.F_V,
        m * (g + UPWARD),
    ),
    "3-10 angular acceleration next to an impact, rectangular block, from 2-3": Kind.APPROXIMATION(
        th.theta_dd_impact, -s * 3 * g / (4 * R) * alpha
    ),
    "3-11 horizontal force next to an impact": Kind.CLOSED_FORM(
        th.FH_impact,
        m
        * (s * R * th.theta_d_impact**2 * sin(alpha) - s * Rational(3, 4) * g * alpha * cos(alpha)),
    ),
    "3-12 vertical force next to an impact": Kind.CLOSED_FORM(
        th.FV_impact,
        m
        * (g - R * th.theta_d_impact**2 * cos(alpha) - s * Rational(3, 4) * g * alpha * sin(alpha)),
        correction={s: 1},
        reason="sgn(theta) in the last term is too much: that of 3-9 and that of 3-10 cancel, as "
        "in 3-15.",
    ),
    "3-13 largest speed at an impact, after release at alpha": Kind.CLOSED_FORM(
        th.theta_d_max,
        th.PM * sqrt(3 * g / (2 * R) * (1 - cos(alpha))),
        remark="The sign is that of the velocity: the upper one for an impact on the right edge.",
    ),
    "3-14 horizontal force next to an impact as the speed vanishes": Kind.CLOSED_FORM(
        th.FH_limit,
        3 * m * g / 4 * alpha * cos(alpha),
        correction={cos(alpha): -s * cos(alpha)},
        reason="Printed is the magnitude; the force of 3-11 points against the side of theta.",
        domain=Domain("theta < 0", (Q.negative(theta),), (Q.positive(theta),)),
    ),
    "3-15 vertical force next to an impact as the speed vanishes": Kind.CLOSED_FORM(
        th.FV_limit, m * g * (1 - Rational(3, 4) * alpha * sin(alpha))
    ),
}


DISSIPATION = {
    "3-16 3-3 with the energy of the rotational spring": Kind.RESTITUTION(
        th.r,
        (PEAK_AFTER + Rational(1, 2) * th.k_rot * th.theta_after**2)
        / (PEAK_BEFORE + Rational(1, 2) * th.k_rot * th.theta_before**2),
    ),
    "3-17 change of the energy at an impact, in J, fitted to the impacts of both edges": Kind.FIT(
        th.energy_change,
        Float("5.525") * theta_d_peak**3
        - Float("9.661") * theta_d_peak**2
        - Float("0.6663") * theta_d_peak,
        fitted="The measured r of Figure 3-3 agree within 0.036, and its mean within 0.013 with "
        "the bunches of section 3.3: that bears the coefficients out within 5, 2 and 20 %.",
        remark="For the block of chapter 3 and speeds up to 0.8 rad/s. Negative is a loss; the "
        "velocity is that before the impact. On the left edge it gains energy below 0.067 rad/s.",
    ),
    "3-18 the same for the second trend, impacts on the right edge": Kind.FIT(
        th.energy_change,
        Float("7.144") * theta_d_peak**3
        - Float("7.576") * theta_d_peak**2
        - Float("0.0381") * theta_d_peak,
        fitted="The measured r of Figure 3-3 agree within 0.0065, which bears the first two "
        "coefficients out within 3 and 2 %. The sign of the last is that of a loss at small "
        "speeds.",
        remark="For positive velocities; impacts on the right edge follow either 3-17 or 3-18.",
        sides=POSITIVE,
    ),
}

CHAPTER_3 = (
    *section("3.2.2", ENERGIES),
    *section("3.2.3", SUPPORT_FORCES),
    *section(
        "3.2.4",
        DISSIPATION,
        units="5.525 J s3, 9.661 J s2, 0.6663 J s, 7.144 J s3, 7.576 J s2, 0.0381 J s",
    ),
)
