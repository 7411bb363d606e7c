"""Chapter 2: rigid blocks, flexible structures that uplift, impact as a force, damping.

Typed by hand from the thesis, in its own symbols.
"""

import sympy as sp
from sympy import acosh, cos, log, pi, sign, sin, sqrt

from rockeom.thesis.equation import POSITIVE, Kind, says, section
from rockeom.thesis.notation import (
    M_AE,
    M_ED,
    M_N,
    PM,
    B,
    C_i,
    H,
    I_o,
    Omega,
    R,
    a_g,
    a_peak,
    alpha,
    alpha_T,
    beta,
    beta_FS,
    effective_period,
    fit_a,
    fit_b,
    fit_c,
    fit_d,
    fit_e,
    fit_f,
    g,
    k_i,
    k_p,
    lambda_r,
    m,
    mu,
    omega,
    omega_n,
    p,
    period,
    r,
    recentring,
    t,
    tau,
    theta,
    theta_0,
    theta_d1,
    theta_d2,
    theta_dd,
    u,
    u_d,
    u_dd,
    x,
    x_dd,
    xi,
    xi_bilinear,
    xi_const,
    xi_el,
    xi_eq,
    xi_flag,
    xi_hyst,
    xi_takeda,
    xi_tang,
    xi_v,
    zeta_r,
)

UPLIFT = section(
    "2.1",
    Kind.CLOSED_FORM(
        "2-1",
        "ground acceleration beyond which a rectangular block starts to rock",
        (sp.Gt(a_peak, g * B / H),),
        remark="Needed for overturning, but not enough for it. B and H are the whole width and "
        "height; only their ratio counts.",
    ),
)

FREE_BLOCK = section(
    "2.2",
    Kind.MOTION(
        "2-2",
        "free rocking of a rigid block about its edge",
        says(
            I_o * theta_dd,
            sp.Piecewise(
                (-m * g * R * sin(alpha - theta), theta > 0),
                (m * g * R * sin(alpha + theta), theta < 0),
            ),
        ),
    ),
    # 2-3 has I_o as 2-2 and 2-5 do; the scanned text reads I_alpha there.
    Kind.APPROXIMATION(
        "2-3",
        "the same for a slender block and theta > 0",
        says(I_o * theta_dd - m * g * R * theta, -m * g * R * alpha),
        sides=POSITIVE,
    ),
    Kind.DEFINITION(
        "2-4",
        "apparent coefficient of restitution, the ratio of kinetic energies",
        says(r, (theta_d2 / theta_d1) ** 2),
        remark="The angular velocity is multiplied by sqrt(r) at an impact. Figure 2-12 and the "
        "text of 5.3.1.1 multiply it by r.",
    ),
    Kind.APPROXIMATION(
        "2-5",
        "period of free rocking from rest at theta_0, of a slender block without losses",
        (*says(period, 4 / p * acosh(1 / (1 - theta_0 / alpha))), *says(p, sqrt(m * g * R / I_o))),
        remark="With losses it holds for each quarter, with the peak that the quarter starts from "
        "or ends at.",
        sides=POSITIVE,
    ),
    Kind.RESTITUTION(
        "2-6",
        "ratio of kinetic energies at an impact, by angular momentum about the new pivot",
        says(r, (1 - m * R**2 / I_o * (1 - cos(2 * alpha))) ** 2),
    ),
)

FLEXIBLE = section(
    "2.4.1",
    Kind.MOTION(
        "2-7",
        "deformation of a flexible structure on a massless base while a foot is lifted",
        says(u_dd + 2 * zeta_r * lambda_r * u_d + lambda_r**2 * u, -(a_g - PM * g * H / B)),
        remark="Small displacements, without P-delta and without rotary inertia of the mass.",
    ),
    Kind.CLOSED_FORM(
        "2-8a",
        "its natural frequency",
        says(lambda_r, omega_n * (R / B)),
        remark="B is half the width of the base, and R**2 = B**2 + H**2.",
    ),
    Kind.CLOSED_FORM(
        "2-8b",
        "its damping ratio",
        says(zeta_r, xi * (R / B)),
        remark="B is half the width of the base. R/B depends on the slenderness alone, not on the "
        "size of the structure.",
    ),
)

SHAKEN_BLOCK = section(
    "2.5.1",
    Kind.MOTION(
        "2-9",
        "block under horizontal ground acceleration",
        says(
            I_o * theta_dd
            + PM * m * g * R * sin(alpha - PM * theta)
            + m * a_g * R * cos(alpha + PM * theta),
            0,
        ),
        says(
            I_o * theta_dd
            + PM * m * g * R * sin(alpha - PM * theta)
            + m * a_g * R * cos(alpha - PM * theta),
            0,
        ),
        "The signs in the cosine are reversed: the lever of the ground's force is the height of "
        "the centroid, R cos(alpha -+ theta), with the same angle as in the sine.",
        excess=(-2 * m * a_g * R * sin(alpha) * sin(PM * theta),),
    ),
    Kind.DEFINITION("2-10", "non-dimensional rotation", says(x, theta / alpha)),
    Kind.DEFINITION(
        "2-11", "non-dimensional frequency", says(omega, Omega * sqrt(I_o / (m * g * R)))
    ),
    Kind.DEFINITION("2-12", "non-dimensional time", says(t, sqrt(m * g * R / I_o) * tau)),
    Kind.MOTION(
        "2-13",
        "block under harmonic ground acceleration, non-dimensional",
        says(
            alpha * x_dd + PM * sin(alpha * (1 - PM * x)),
            -alpha * beta * cos(omega * t) * cos(alpha * (alpha * (1 - PM * x))),
        ),
        says(
            alpha * x_dd + PM * sin(alpha * (1 - PM * x)),
            -alpha * beta * cos(omega * t) * cos(alpha * (1 - PM * x)),
        ),
        "alpha stands twice in the cosine on the right; put 2-10 to 2-12 into 2-9.",
        excess=(
            alpha
            * beta
            * cos(omega * t)
            * (cos(alpha**2 * (1 - PM * x)) - cos(alpha * (1 - PM * x))),
        ),
    ),
    Kind.APPROXIMATION(
        "2-14",
        "the same for a slender block",
        (),
        says(x_dd - x + sign(x), -beta * cos(omega * t)),
        "Not legible; the limit of 2-13 as alpha goes to zero, which 2-17 repeats.",
    ),
    Kind.FIT(
        "2-15",
        "equivalent damping of rocking after FEMA 356",
        says(xi_eq, sp.Mul(0.4, 1 - sqrt(r), evaluate=False)),
        remark="The text calls it up to 10 % less than 2-16: it is 41 to 51 % less for r from 1 to "
        "0.49, by at most 12 percentage points of damping.",
    ),
    Kind.FIT(
        "2-16",
        "equivalent damping of rocking after Priestley et al. (1978)",
        says(xi_eq, -0.34 * log(r)),
        remark="r is the ratio of energies, 2-4. Table 2-3 puts the ratio of velocities in, which "
        "halves the damping. The text also cites 2-16 where it turns displacements into rotations.",
    ),
)

CONTROLLED = section(
    "2.7",
    Kind.DEFINITION(
        "2-30",
        "ratio of the moments that re-centre a controlled rocking system to those that dissipate",
        says(recentring, (M_AE + M_N) / M_ED),
    ),
    Kind.DEFINITION(
        "2-31",
        "equivalent damping, the sum of the elastic and the hysteretic one",
        says(xi_eq, xi_el + xi_hyst),
        remark="The text refers to it once as 2-30.",
    ),
    Kind.CLOSED_FORM(
        "2-32a",
        "hysteretic damping of the bilinear rule",
        says(xi_bilinear, (mu - 1) * (1 - k_p / k_i) * 2 / (pi * mu * (1 + k_p / k_i * (mu - 1)))),
        remark="2-32a to 2-32c go with the secant stiffness at the largest displacement, although "
        "the text introduces them with the initial one.",
    ),
    Kind.CLOSED_FORM(
        "2-32b",
        "hysteretic damping of the Takeda rule",
        says(xi_takeda, (1 - (1 - k_p / k_i) * mu ** (alpha_T - 1) - k_p / k_i * mu**alpha_T) / pi),
    ),
    Kind.CLOSED_FORM(
        "2-32c",
        "hysteretic damping of the flag-shaped rule",
        says(xi_flag, beta_FS * (mu - 1) / (pi * mu * (1 + k_p / k_i * (mu - 1)))),
        remark="beta_FS is the gap between loading and unloading at the same displacement. Where "
        "it is the drop along the elastic branch, a factor 1 - k_p/k_i is missing.",
    ),
    Kind.FIT(
        "2-33",
        "equivalent damping by the analysis expression of Grant et al. (2005)",
        says(
            xi_eq,
            fit_a * (1 - 1 / mu**fit_b) * (1 + 1 / (effective_period + fit_c) ** fit_d)
            + mu**fit_e * xi_const
            + mu**fit_f * xi_tang,
        ),
        remark="One of the two elastic dampings is zero. Factors of EPP and flag stand apart, not "
        "of bilinear and flag as the text says.",
    ),
    Kind.FIT(
        "2-34",
        "the same without the period",
        says(xi_eq, xi_v + C_i * ((mu - 1) / (pi * mu))),
        remark="The thesis gives no values of C_i.",
    ),
    Kind.FIT(
        "2-35",
        "equivalent damping by the design expression of Grant et al. (2005)",
        says(
            xi_eq,
            0.05 + fit_a * (1 - 1 / mu**fit_b) * (1 + 1 / (effective_period + fit_c) ** fit_d),
        ),
        remark="It recalibrates 2-33, where the text says 2-31. Only a b of the flag's "
        "factors counts, and b is given to one digit: its damping beyond 5 % is good to 8 %.",
    ),
)

CHAPTER_2 = (*UPLIFT, *FREE_BLOCK, *FLEXIBLE, *SHAKEN_BLOCK, *CONTROLLED)
