"""Equations of the thesis, typed by hand from its pages and in its own symbols.

Nothing here is derived, and nothing is imported from the engine. An entry holds what is printed
and, where that is wrong or not legible, what should stand there and why.

sgn and |.| are `sign` and `Abs`; the double sign +- is `PM`, its upper sign for theta > 0. A
vector is a column (i, j), measured from the pivot of its side: O for theta > 0, O' for theta < 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from sympy import Abs, Derivative, Function, Matrix, Rational, atan, cos, sign, sin, sqrt

BOTH, POSITIVE, NEGATIVE = (1, -1), (1,), (-1,)
"""Signs of theta for which an equation is meant."""


@dataclass(frozen=True)
class Equation:
    """An equation of the thesis.

    number : as in the thesis.
    meaning : what it states.
    printed : one relation for each equals sign; empty where the page is not legible.
    corrected : what should be printed; None where the printed form is right.
    reason : why it is corrected; "" where it is not.
    sides : signs of theta for which it is meant.
    """

    number: str
    meaning: str
    printed: tuple[sp.Eq, ...]
    corrected: tuple[sp.Eq, ...] | None = None
    reason: str = ""
    sides: tuple[int, ...] = BOTH

    @property
    def right(self) -> tuple[sp.Eq, ...]:
        """The relations that hold."""
        return self.printed if self.corrected is None else self.corrected

    @property
    def is_erratum(self) -> bool:
        """Whether something legible is printed that is wrong."""
        return bool(self.printed) and self.corrected is not None


def says(left, *rights) -> tuple[sp.Eq, ...]:
    """left = right, and for a chain left = right_1 = right_2 = ... each with the same left."""
    return tuple(sp.Eq(left, right, evaluate=False) for right in rights)


def real(names: str) -> list[sp.Symbol]:
    return [sp.Symbol(name, real=True) for name in names.split()]


def positive(names: str) -> list[sp.Symbol]:
    return [sp.Symbol(name, positive=True) for name in names.split()]


# --- symbols

theta, x, u = real("theta x u")
theta_d, u_d = real(r"\dot{\theta} \dot{u}")
theta_dd, u_dd, x_dd = real(r"\ddot{\theta} \ddot{u} \ddot{x}")
a_g, a_gx = real(r"\ddot{u}_g \ddot{u}_{gx}")
(g,) = positive("g")
PM = sp.Symbol(r"\pm", real=True)
s = sign(theta)

# chapters 2 and 3: the block
m, R, alpha, I_o = positive("m R alpha I_o")
beta, omega, Omega, t, tau, r = positive("beta omega Omega t tau r")
u_cx_dd, u_cy_dd, F_H, F_V = real(r"\ddot{u}_{cx} \ddot{u}_{cy} F_H F_V")
FH_impact, FV_impact, FH_limit, FV_limit = real("FH_{impact} FV_{impact} FH_{lim} FV_{lim}")
theta_d_impact, theta_d_max = real(r"\dot{\theta}_{impact} \dot{\theta}_{max,impact}")
(theta_dd_impact,) = real(r"\ddot{\theta}_{impact}")

# chapter 5 and Appendix D: superstructure (e) on a base structure (b)
m_e, m_b, R_e, R_b, alpha_e, alpha_b = positive("m_e m_b R_e R_b alpha_e alpha_b")
H_e, H_b, B, I_eg, I_bg, I_O = positive("H_e H_b B I_{e,g} I_{b,g} I_O")
theta_d1, theta_d2, L_before, L_after = real(r"\dot{\theta}_1 \dot{\theta}_2 L_{before} L_{after}")
W, k_f, H_c, alpha_c, R_c, delta_0 = positive("W k_f H_c alpha_c R_c delta_0")
k_u, P_t, P, P_crit, P_crit2 = real("k(u) P(t) P P_{crit} P_{crit2}")
delta_change, f_L, f_R, theta_crit = real(r"\Delta\delta f_L f_R theta_{crit}")
u_crit, u_overturn = positive("u_{crit} u_{overturn}")
k, c = positive("k c")
displacement, r_e, r_b, v_e, v_b = real("Displacement r_e r_b v_e v_b")
T, T_e, T_b, V, L, F_nc, Q_theta, Q_u = real(r"T T_e T_b V \mathcal{L} F_{nc} Q_\theta Q_u")
A_angle, B_angle = real("A B_1")  # the second is B in the thesis, which is the half-width here


# --- chapter 2: the rigid block

CHAPTER_2 = (
    Equation(
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
    Equation(
        "2-3",
        "the same for a slender block and theta > 0",
        says(I_o * theta_dd - m * g * R * theta, -m * g * R * alpha),
        sides=POSITIVE,
    ),
    Equation(
        "2-6",
        "ratio of kinetic energies at an impact, by angular momentum about the new pivot",
        says(r, (1 - m * R**2 / I_o * (1 - cos(2 * alpha))) ** 2),
    ),
    Equation(
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
    ),
    Equation("2-10", "non-dimensional rotation", says(x, theta / alpha)),
    Equation("2-11", "non-dimensional frequency", says(omega, Omega * sqrt(I_o / (m * g * R)))),
    Equation("2-12", "non-dimensional time", says(t, sqrt(m * g * R / I_o) * tau)),
    Equation(
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
    ),
    Equation(
        "2-14",
        "the same for a slender block",
        (),
        says(x_dd - x + sign(x), -beta * cos(omega * t)),
        "Not legible; the limit of 2-13 as alpha goes to zero, which 2-17 repeats.",
    ),
)


# --- chapter 3: support forces of the rigid block

CHAPTER_3 = (
    Equation(
        "3-6",
        "horizontal acceleration of the centroid",
        says(
            u_cx_dd,
            a_gx
            + s * R * theta_d**2 * sin(alpha - Abs(theta))
            + R * theta_dd * cos(alpha - Abs(theta)),
        ),
    ),
    Equation(
        "3-7",
        "vertical acceleration of the centroid",
        says(
            u_cy_dd,
            -R * theta_d**2 * cos(alpha - Abs(theta)) + s * R * theta_dd * sin(alpha - Abs(theta)),
        ),
    ),
    Equation(
        "3-8",
        "horizontal force of the support",
        says(
            F_H,
            m
            * (
                a_gx
                + s * R * theta_d**2 * sin(alpha - Abs(theta))
                + R * theta_dd * cos(alpha - Abs(theta))
            ),
        ),
    ),
    Equation(
        "3-9",
        "vertical force of the support",
        says(
            F_V,
            m
            * (
                g
                - R * theta_d**2 * cos(alpha - Abs(theta))
                + s * R * theta_dd * sin(alpha - Abs(theta))
            ),
        ),
    ),
    Equation(
        "3-10",
        "angular acceleration beside an impact, rectangular block, from 2-3",
        says(theta_dd_impact, -s * 3 * g / (4 * R) * alpha),
    ),
    Equation(
        "3-11",
        "horizontal force beside an impact",
        says(
            FH_impact,
            m
            * (
                s * R * theta_d_impact**2 * sin(alpha) - s * Rational(3, 4) * g * alpha * cos(alpha)
            ),
        ),
    ),
    Equation(
        "3-12",
        "vertical force beside an impact",
        says(
            FV_impact,
            m
            * (
                g - R * theta_d_impact**2 * cos(alpha) - s * Rational(3, 4) * g * alpha * sin(alpha)
            ),
        ),
        says(
            FV_impact,
            m * (g - R * theta_d_impact**2 * cos(alpha) - Rational(3, 4) * g * alpha * sin(alpha)),
        ),
        "sgn(theta) in the last term is too much: that of 3-9 and that of 3-10 cancel, as in 3-15.",
    ),
    Equation(
        "3-13",
        "largest speed at an impact, after release at alpha",
        says(theta_d_max, PM * sqrt(3 * g / (2 * R) * (1 - cos(alpha)))),
    ),
    Equation(
        "3-14",
        "horizontal force beside an impact as the speed vanishes",
        says(FH_limit, 3 * m * g / 4 * alpha * cos(alpha)),
        says(FH_limit, -s * 3 * m * g / 4 * alpha * cos(alpha)),
        "Printed is the magnitude; the force of 3-11 points against the side of theta.",
    ),
    Equation(
        "3-15",
        "vertical force beside an impact as the speed vanishes",
        says(FV_limit, m * g * (1 - Rational(3, 4) * alpha * sin(alpha))),
    ),
)


# --- 5.3.1: Model A, two rigid lumped masses on rigid ground


VELOCITY_RATIO = ((m_e * (H_e**2 - B**2) + I_eg) + (m_b * (H_b**2 - B**2) + I_bg)) / (
    (m_e * (H_e**2 + B**2) + I_eg) + (m_b * (H_b**2 + B**2) + I_bg)
)
"""theta_d2 / theta_d1, printed above 5-14."""

MODEL_A = (
    Equation(
        "5-8",
        "moment of inertia about either pivot",
        says(I_O, (I_eg + m_e * R_e**2) + (I_bg + m_b * R_b**2)),
    ),
    Equation(
        "5-9",
        "Model A for theta > 0",
        (),
        says(
            theta_dd,
            -m_e * R_e * g / I_O * (a_g / g * cos(alpha_e - theta) + sin(alpha_e - theta))
            - m_b * R_b * g / I_O * (a_g / g * cos(alpha_b - theta) + sin(alpha_b - theta)),
        ),
        "Not legible; the moments about O, in the form of 5-10.",
        POSITIVE,
    ),
    # 5-10 and 5-11 write M_e and M_b for m_e and m_b.
    Equation(
        "5-10",
        "Model A for theta < 0",
        says(
            theta_dd,
            -m_e * R_e * g / I_O * (a_g / g * cos(alpha_e + theta) - sin(alpha_e + theta))
            - m_b * R_b * g / I_O * (a_g / g * cos(alpha_b + theta) - sin(alpha_b + theta)),
        ),
        sides=NEGATIVE,
    ),
    Equation(
        "5-11",
        "Model A",
        says(
            theta_dd,
            -m_e
            * R_e
            * g
            / I_O
            * (a_g / g * cos(alpha_e + s * theta) + s * sin(alpha_e + s * theta))
            - m_b
            * R_b
            * g
            / I_O
            * (a_g / g * cos(alpha_b + s * theta) + s * sin(alpha_b + s * theta)),
        ),
        says(
            theta_dd,
            -m_e
            * R_e
            * g
            / I_O
            * (a_g / g * cos(alpha_e - s * theta) + s * sin(alpha_e - s * theta))
            - m_b
            * R_b
            * g
            / I_O
            * (a_g / g * cos(alpha_b - s * theta) + s * sin(alpha_b - s * theta)),
        ),
        "The angles are alpha - sgn(theta) theta, as in 5-34; for theta < 0 that is 5-10.",
    ),
    Equation(
        "5-12",
        "angular momentum about the impending pivot, before an impact",
        says(
            L_before,
            m_e * R_e * theta_d1 * cos(alpha_e) * H_e
            - m_e * R_e * theta_d1 * sin(alpha_e) * B
            + I_eg * theta_d1
            + m_b * R_b * theta_d1 * cos(alpha_b) * H_b
            - m_b * R_b * theta_d1 * sin(alpha_b) * B
            + I_bg * theta_d1,
            ((m_e * (H_e**2 - B**2) + I_eg) + (m_b * (H_b**2 - B**2) + I_bg)) * theta_d1,
        ),
    ),
    Equation(
        "5-13",
        "angular momentum about the new pivot, after an impact",
        says(
            L_after,
            m_e * R_e * theta_d2 * cos(alpha_e) * H_e
            + m_e * R_e * theta_d2 * sin(alpha_e) * B
            + I_eg * theta_d2
            + m_b * R_b * theta_d2 * cos(alpha_b) * H_b
            + m_b * R_b * theta_d2 * sin(alpha_b) * B
            + I_bg * theta_d2,
            ((m_e * (H_e**2 + B**2) + I_eg) + (m_b * (H_b**2 + B**2) + I_bg)) * theta_d2,
        ),
    ),
    Equation(
        "5-14",
        "ratio of kinetic energies at an impact",
        says(
            r,
            VELOCITY_RATIO**2,
        ),
    ),
)


# --- 5.3.2: Model B, the rigid structure on two springs that only push

MODEL_B = (
    Equation(
        "5-15",
        "equivalent cart",
        says((m_e + m_b) * u_dd + k_u, P_t),
    ),
    Equation("5-16", "settlement under self-weight", says(delta_0, W / (2 * k_f))),
    Equation("5-17", "weight", says(W, (m_e + m_b) * g)),
    Equation("5-18", "displacement of the superstructure", says(u, H_e * sin(theta))),
    Equation("5-19", "change of a spring's length, small theta", says(delta_change, B * theta)),
    Equation("5-20", "force of the left spring, small theta", says(f_L, W / 2 - k_f * B * theta)),
    Equation("5-21", "force of the right spring, small theta", says(f_R, W / 2 + k_f * B * theta)),
    Equation("5-22", "rotation at lift-off, small theta", says(theta_crit, W / (2 * k_f * B))),
    Equation("5-23", "displacement at lift-off", says(u_crit, W * H_e / (2 * k_f * B))),
    Equation(
        "5-24",
        "pushover force with both springs pressed, small theta",
        says(P, (2 * k_f * B**2 / H_e - g * (m_e + m_b * H_b / H_e)) * theta),
    ),
    Equation(
        "5-25",
        "the same by the displacement",
        says(P, (2 * k_f * B**2 - m_e * g * H_e - m_b * g * H_b) / H_e**2 * u),
    ),
    Equation(
        "5-26",
        "force at lift-off",
        says(P_crit, W * B / H_e - g * (m_e + m_b * H_b / H_e) * W / (2 * k_f * B)),
    ),
    Equation(
        "5-27",
        "5-25 with the centroid of the system",
        says(P, (2 * k_f * B**2 - W * H_c) / H_e**2 * u),
    ),
    Equation(
        "5-28",
        "5-24 with the centroid of the system",
        (),
        says(P, (2 * k_f * B**2 - W * H_c) / H_e * theta),
        'Not legible; reconstructed from "Equations 5-24 through 5-26 can be simplified".',
    ),
    Equation(
        "5-29",
        "5-26 with the centroid of the system",
        says(P_crit, W / H_e * (B - W * H_c / (2 * k_f * B)) * u),
        says(P_crit, W / H_e * (B - W * H_c / (2 * k_f * B))),
        "The factor u is too much: with it the right-hand side is not a force.",
    ),
    Equation(
        "5-30",
        "centroid of the system",
        (
            *says(H_c, (m_e * H_e + m_b * H_b) / (m_e + m_b)),
            *says(alpha_c, B / H_c),
            *says(R_c, sqrt(B**2 + H_c**2)),
        ),
        (
            *says(H_c, (m_e * H_e + m_b * H_b) / (m_e + m_b)),
            *says(alpha_c, atan(B / H_c)),
            *says(R_c, sqrt(B**2 + H_c**2)),
        ),
        "The arctangent of the angle is missing.",
    ),
    Equation(
        "5-31",
        "force after lift-off",
        says(P, W * R_c * sin(alpha_c - theta) / (R_e * cos(alpha_e - theta))),
        sides=POSITIVE,
    ),
    Equation(
        "5-32",
        "force just after lift-off",
        says(
            P_crit2,
            W * R_c * sin(alpha_c - W / (2 * k_f * B)) / (R_e * cos(alpha_e - W / (2 * k_f * B))),
        ),
        sides=POSITIVE,
    ),
    Equation(
        "5-33",
        "displacement of zero force, and the straight line to it from lift-off",
        (
            *says(u_overturn, R_e * (sin(alpha_e) + sin(alpha_c - alpha_e))),
            *says(P, P_crit2 * (u - u_overturn) / (u_crit - u_overturn)),
        ),
        sides=POSITIVE,
    ),
)


# --- 5.3.3: Model C, the superstructure on a flexible column

THETA_OF_MODEL_C = says(
    (m_e * R_e**2 + m_e * u**2 - s * 2 * m_e * u * R_e * sin(alpha_e) + I_eg + m_b * R_b**2 + I_bg)
    * theta_dd
    + (2 * m_e * u * u_d - s * 2 * m_e * u_d * R_e * sin(alpha_e)) * theta_d
    + m_e * u_dd * R_e * cos(alpha_e)
    + s * m_e * g * (R_e * sin(alpha_e - s * theta) - s * u * cos(theta))
    + s * m_b * g * R_b * sin(alpha_b - s * theta),
    -m_e * a_g * (R_e * cos(alpha_e - s * theta) - u * sin(theta))
    - m_b * a_g * R_b * cos(alpha_b - s * theta),
)
U_OF_MODEL_C = says(
    m_e * u_dd
    + m_e * R_e * cos(alpha_e) * theta_dd
    - (m_e * u - s * m_e * R_e * sin(alpha_e)) * theta_d**2
    - m_e * g * sin(theta)
    + k * u
    + c * u_d,
    -m_e * a_g * cos(theta),
)

MODEL_C = (
    Equation("5-34", "Model C: rotation", THETA_OF_MODEL_C),
    Equation("5-35", "Model C: deformation", U_OF_MODEL_C),
    Equation(
        "5-37",
        "displacement of the superstructure from its upright position",
        says(
            displacement,
            Matrix(
                [
                    s * R_e * (sin(alpha_e) - sin(alpha_e - s * theta)) + u * cos(theta),
                    R_e * (cos(alpha_e - s * theta) - cos(alpha_e)) - u * sin(theta),
                ]
            ),
        ),
    ),
)


# --- Appendix D: Model C derived

q_t = Function("q_i")(t)
LAGRANGIAN, DISSIPATION = Function(r"\mathcal{L}"), Function("F_{nc}")
(Q_i,) = real("Q_i")

X_E = -R_e * sin(alpha_e - theta) + u * cos(theta)
X_B = -R_b * sin(alpha_b - theta)

D_8_BRACKETS = (
    Rational(1, 2)
    * m_e
    * (
        (R_e * theta_d * cos(alpha_e - theta) - theta_d * u * sin(theta) + u_d * cos(theta)) ** 2
        + (R_e * theta_d * sin(alpha_e - theta) - theta_d * u * cos(theta) + u_d * sin(theta)) ** 2
    )
    + Rational(1, 2) * I_eg * theta_d**2
)
D_8_BRACKETS_CORRECTED = (
    Rational(1, 2)
    * m_e
    * (
        (R_e * theta_d * cos(alpha_e - theta) - theta_d * u * sin(theta) + u_d * cos(theta)) ** 2
        + (R_e * theta_d * sin(alpha_e - theta) - theta_d * u * cos(theta) - u_d * sin(theta)) ** 2
    )
    + Rational(1, 2) * I_eg * theta_d**2
)
# The last line of D-8, the square of each bracket by itself: slips that cancel between the two
# are seen only there.
D_8_SQUARES = (
    R_e**2 * theta_d**2 * cos(alpha_e - theta) ** 2
    - 2 * R_e * u * theta_d**2 * sin(theta) * cos(alpha_e - theta)
    + 2 * u_d * R_e * theta_d * cos(alpha_e - theta) * cos(theta)
    + u**2 * theta_d**2 * sin(theta) ** 2
    - 2 * u * u_d * sin(theta) * cos(theta)
    + u_d**2 * cos(theta) ** 2,
    R_e**2 * theta_d**2 * sin(alpha_e - theta) ** 2
    - 2 * R_e * u * theta_d**2 * cos(theta) * sin(alpha_e - theta)
    - 2 * u_d * R_e * theta_d * sin(alpha_e - theta) * sin(theta)
    + u**2 * theta_d**2 * cos(theta) ** 2
    + 2 * u * u_d * sin(theta) * cos(theta)
    + u_d**2 * cos(theta) ** 2,
)
D_8_SQUARES_CORRECTED = (
    R_e**2 * theta_d**2 * cos(alpha_e - theta) ** 2
    - 2 * R_e * u * theta_d**2 * sin(theta) * cos(alpha_e - theta)
    + 2 * u_d * R_e * theta_d * cos(alpha_e - theta) * cos(theta)
    + u**2 * theta_d**2 * sin(theta) ** 2
    - 2 * u * u_d * theta_d * sin(theta) * cos(theta)
    + u_d**2 * cos(theta) ** 2,
    R_e**2 * theta_d**2 * sin(alpha_e - theta) ** 2
    - 2 * R_e * u * theta_d**2 * cos(theta) * sin(alpha_e - theta)
    - 2 * u_d * R_e * theta_d * sin(alpha_e - theta) * sin(theta)
    + u**2 * theta_d**2 * cos(theta) ** 2
    + 2 * u * u_d * theta_d * sin(theta) * cos(theta)
    + u_d**2 * sin(theta) ** 2,
)

T_E = (
    Rational(1, 2)
    * m_e
    * (
        R_e**2 * theta_d**2
        + u**2 * theta_d**2
        + u_d**2
        - 2 * R_e * u * theta_d**2 * sin(alpha_e)
        + 2 * u_d * R_e * theta_d * cos(alpha_e)
    )
    + Rational(1, 2) * I_eg * theta_d**2
)
T_B_FIRST = (
    Rational(1, 2)
    * m_b
    * ((R_b * theta_d * cos(alpha_b - theta)) ** 2 + (R_b * theta_d * sin(alpha_b - theta)) ** 2)
    + Rational(1, 2) * I_bg * theta_d**2
)
T_B = Rational(1, 2) * m_b * R_b * theta_d**2 + Rational(1, 2) * I_bg * theta_d**2
T_B_CORRECTED = Rational(1, 2) * m_b * R_b**2 * theta_d**2 + Rational(1, 2) * I_bg * theta_d**2
V_OF_MODEL_C = (
    m_e * g * (R_e * cos(alpha_e - theta) - u * sin(theta))
    + m_b * g * (R_b * cos(alpha_b - theta))
    + Rational(1, 2) * k * u**2
)

APPENDIX_D = (
    Equation(
        "D-1",
        "position of the superstructure from O",
        says(r_e, Matrix([X_E, R_e * cos(alpha_e - theta) - u * sin(theta)])),
        sides=POSITIVE,
    ),
    Equation(
        "D-2",
        "position of the base structure from O",
        says(r_b, Matrix([-R_b * sin(alpha_e - theta), R_b * cos(alpha_e - theta)])),
        says(r_b, Matrix([X_B, R_b * cos(alpha_b - theta)])),
        "alpha_e is printed for alpha_b.",
        POSITIVE,
    ),
    Equation(
        "D-3",
        "velocity of the superstructure",
        says(
            v_e,
            Matrix(
                [
                    theta_d * R_e * cos(alpha_e - theta)
                    - theta_d * u * sin(theta)
                    + u_d * cos(theta),
                    theta_d * R_e * sin(alpha_e - theta)
                    - theta_d * u * cos(theta)
                    - u_d * sin(theta),
                ]
            ),
        ),
        sides=POSITIVE,
    ),
    Equation(
        "D-4",
        "velocity of the base structure",
        says(
            v_b,
            Matrix([theta_d * R_b * cos(alpha_e - theta), theta_d * R_b * sin(alpha_e - theta)]),
        ),
        says(
            v_b,
            Matrix([theta_d * R_b * cos(alpha_b - theta), theta_d * R_b * sin(alpha_b - theta)]),
        ),
        "alpha_e is printed for alpha_b.",
        POSITIVE,
    ),
    Equation(
        "D-5",
        "Lagrange's equation with a dissipation function",
        says(
            Derivative(Derivative(LAGRANGIAN(q_t, q_t.diff(t)), q_t.diff(t)), t)
            - Derivative(LAGRANGIAN(q_t, q_t.diff(t)), q_t)
            + Derivative(DISSIPATION(q_t.diff(t)), q_t.diff(t)),
            Q_i,
        ),
    ),
    Equation("D-6", "Lagrangian", says(L, T - V), sides=POSITIVE),
    Equation("D-7", "kinetic energy", says(T, T_e + T_b), sides=POSITIVE),
    Equation(
        "D-8",
        "kinetic energy of the superstructure",
        says(
            T_e,
            D_8_BRACKETS,
            Rational(1, 2) * m_e * sum(D_8_SQUARES) + Rational(1, 2) * I_eg * theta_d**2,
        ),
        says(
            T_e,
            D_8_BRACKETS_CORRECTED,
            Rational(1, 2) * m_e * sum(D_8_SQUARES_CORRECTED) + Rational(1, 2) * I_eg * theta_d**2,
        ),
        "Four slips: + u' sin(theta) for - u' sin(theta) in the second bracket; theta' missing "
        "in both terms 2 u u' sin(theta) cos(theta); u'^2 cos(theta)^2 for u'^2 sin(theta)^2 in "
        "the square of the second bracket.",
        POSITIVE,
    ),
    Equation(
        "D-9",
        "sine of a sum",
        says(
            sin(A_angle + PM * B_angle),
            sin(A_angle) * cos(B_angle) + PM * cos(A_angle) * sin(B_angle),
        ),
    ),
    Equation(
        "D-10",
        "cosine of a sum",
        says(
            cos(A_angle + PM * B_angle),
            cos(A_angle) * cos(B_angle) - PM * sin(A_angle) * sin(B_angle),
        ),
    ),
    Equation("D-11", "kinetic energy of the superstructure", says(T_e, T_E), sides=POSITIVE),
    Equation(
        "D-12",
        "kinetic energy of the base structure",
        says(T_b, T_B_FIRST, T_B),
        says(T_b, T_B_FIRST, T_B_CORRECTED),
        "R_b is not squared in the last line.",
        POSITIVE,
    ),
    Equation("D-13", "potential energy", says(V, V_OF_MODEL_C), sides=POSITIVE),
    Equation(
        "D-14",
        "Lagrangian written out",
        says(L, T_E + T_B - V_OF_MODEL_C),
        says(L, T_E + T_B_CORRECTED - V_OF_MODEL_C),
        "R_b is not squared in the kinetic energy of the base structure, as in D-12.",
        POSITIVE,
    ),
    Equation(
        "D-15",
        "dissipation function (the thesis calls it a force)",
        says(F_nc, Rational(1, 2) * c * u_d**2),
    ),
    Equation(
        "D-16",
        "generalised forces of the d'Alembert loads -m a_g i",
        (),
        (
            *says(
                Q_theta, -m_e * a_g * Derivative(X_E, theta) - m_b * a_g * Derivative(X_B, theta)
            ),
            *says(Q_u, -m_e * a_g * Derivative(X_E, u) - m_b * a_g * Derivative(X_B, u)),
        ),
        "Not legible; the definition of a generalised force, of which D-17 and D-18 follow.",
        POSITIVE,
    ),
    Equation(
        "D-17",
        "generalised force of the rotation",
        says(
            Q_theta,
            -m_e * a_g * (R_e * cos(alpha_e - theta) - u * sin(theta))
            - m_b * a_g * R_b * cos(alpha_b - theta),
        ),
        sides=POSITIVE,
    ),
    Equation(
        "D-18",
        "generalised force of the deformation",
        says(Q_u, -m_e * a_g * cos(theta)),
        sides=POSITIVE,
    ),
    Equation(
        "D-19",
        "Model C for theta > 0: rotation",
        (),
        says(
            (
                m_e * R_e**2
                + m_e * u**2
                - 2 * m_e * u * R_e * sin(alpha_e)
                + I_eg
                + m_b * R_b**2
                + I_bg
            )
            * theta_dd
            + (2 * m_e * u * u_d - 2 * m_e * u_d * R_e * sin(alpha_e)) * theta_d
            + m_e * u_dd * R_e * cos(alpha_e)
            + m_e * g * (R_e * sin(alpha_e - theta) - u * cos(theta))
            + m_b * g * R_b * sin(alpha_b - theta),
            -m_e * a_g * (R_e * cos(alpha_e - theta) - u * sin(theta))
            - m_b * a_g * R_b * cos(alpha_b - theta),
        ),
        "Not legible; D-5 with D-14 (corrected), D-15 and D-17.",
        POSITIVE,
    ),
    Equation(
        "D-20",
        "Model C for theta > 0: deformation",
        (),
        says(
            m_e * u_dd
            + m_e * R_e * cos(alpha_e) * theta_dd
            - (m_e * u - m_e * R_e * sin(alpha_e)) * theta_d**2
            - m_e * g * sin(theta)
            + k * u
            + c * u_d,
            -m_e * a_g * cos(theta),
        ),
        "Not legible; D-5 with D-14 (corrected), D-15 and D-18.",
        POSITIVE,
    ),
    Equation(
        "D-21",
        "position of the superstructure from O'",
        says(
            r_e,
            Matrix(
                [
                    R_e * sin(alpha_e + theta) + u * cos(theta),
                    R_e * cos(alpha_e + theta) - u * sin(theta),
                ]
            ),
        ),
        sides=NEGATIVE,
    ),
    Equation(
        "D-22",
        "position of the base structure from O'",
        says(r_b, Matrix([R_b * sin(alpha_e + theta), R_b * cos(alpha_e + theta)])),
        says(r_b, Matrix([R_b * sin(alpha_b + theta), R_b * cos(alpha_b + theta)])),
        "alpha_e is printed for alpha_b.",
        NEGATIVE,
    ),
    Equation(
        "D-23",
        "Model C for theta < 0: rotation",
        says(
            (
                m_e * R_e**2
                + m_e * u**2
                + 2 * m_e * u * R_e * sin(alpha_e)
                + I_eg
                + m_b * R_b**2
                + I_bg
            )
            * theta_dd
            + (2 * m_e * u * u_d + 2 * m_e * u_d * R_e * sin(alpha_e)) * theta_d
            + m_e * u_dd * R_e * cos(alpha_e)
            - m_e * g * (R_e * sin(alpha_e + theta) - u * cos(theta))
            - m_b * g * R_b * sin(alpha_b + theta),
            -m_e * a_g * (R_e * cos(alpha_e + theta) - u * sin(theta))
            - m_b * a_g * R_b * cos(alpha_b + theta),
        ),
        says(
            (
                m_e * R_e**2
                + m_e * u**2
                + 2 * m_e * u * R_e * sin(alpha_e)
                + I_eg
                + m_b * R_b**2
                + I_bg
            )
            * theta_dd
            + (2 * m_e * u * u_d + 2 * m_e * u_d * R_e * sin(alpha_e)) * theta_d
            + m_e * u_dd * R_e * cos(alpha_e)
            - m_e * g * (R_e * sin(alpha_e + theta) + u * cos(theta))
            - m_b * g * R_b * sin(alpha_b + theta),
            -m_e * a_g * (R_e * cos(alpha_e + theta) - u * sin(theta))
            - m_b * a_g * R_b * cos(alpha_b + theta),
        ),
        "In the gravity term the sign of u cos(theta) is wrong: a deformation u > 0 moves the "
        "weight to the right on either side, so that -m_e g u cos(theta) stands in D-19, D-23 "
        "and D-25 alike.",
        NEGATIVE,
    ),
    Equation(
        "D-24",
        "Model C for theta < 0: deformation",
        says(
            m_e * u_dd
            + m_e * R_e * cos(alpha_e) * theta_dd
            - (m_e * u + m_e * R_e * sin(alpha_e)) * theta_d**2
            - m_e * g * sin(theta)
            + k * u
            + c * u_d,
            -m_e * a_g * cos(theta),
        ),
        sides=NEGATIVE,
    ),
    Equation("D-25", "Model C: rotation, as 5-34", THETA_OF_MODEL_C),
    Equation("D-26", "Model C: deformation, as 5-35", U_OF_MODEL_C),
)

EQUATIONS: dict[str, Equation] = {
    equation.number: equation
    for equation in (*CHAPTER_2, *CHAPTER_3, *MODEL_A, *MODEL_B, *MODEL_C, *APPENDIX_D)
}
