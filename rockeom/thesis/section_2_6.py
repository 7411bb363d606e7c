"""Chapter 2, section 2.6: the impact of a slender block as a force, a Dirac delta.

Typed by hand from the thesis, in its own symbols.
"""

from sympy import Derivative, DiracDelta, Integral, Ne, Piecewise, exp, log, pi, sign, sqrt, tanh

from rockeom.thesis import notation as th
from rockeom.thesis.equation import POSITIVE, Kind, section
from rockeom.thesis.notation import F_delta, K, dt, dx_d, exponent, n, r, x, x_d, x_d0, x_dd

f, g = th.DISPLACEMENT_FUNCTION(x), th.VELOCITY_FUNCTION(x_d)
DELTA_N = exp(-(x**2) / n**2) / (n * sqrt(pi))
"""2-20."""

NO_MINUS = {log(sqrt(r)): -log(sqrt(r))}
THE_MINUS = (
    "The minus sign is too much: ln(sqrt(r)) is negative for r < 1, and so is the force that slows "
    "the block where it stands on the right-hand side, as in 2-17. With the minus an impact "
    "multiplies the kinetic energy by 1/r."
)

IMPACT_AS_FORCE = {
    "2-17 free slender block, the impact as a force": Kind.MOTION(
        x_dd - x + sign(x),
        F_delta,
        remark="The force stands on the right: one that slows the block is against its velocity.",
    ),
    (
        "2-18 force of the impact: a function of the rotation times one of the velocity"
    ): Kind.DEFINITION(F_delta, f * g),
    "2-19a the function of the rotation is a Dirac delta": Kind.DEFINITION(f, DiracDelta(x)),
    "2-19b which vanishes away from zero": Kind.DEFINITION(Piecewise((DiracDelta(x), Ne(x, 0))), 0),
    "2-19c and has the integral one": Kind.DEFINITION(
        Integral(DiracDelta(x), (x, th.below_zero, th.above_zero)),
        1,
        remark="The interval contains zero: a < 0 < b.",
    ),
    "2-20 normal distribution that stands for the delta": Kind.DEFINITION(
        th.delta_n, DELTA_N, remark="It is the delta in the limit n -> 0."
    ),
    "2-21a the block during an impact, gravity neglected": Kind.MOTION(
        Derivative(th.x_t, (th.t_scaled, 2)), F_delta
    ),
    "2-21b the same by the velocity": Kind.MOTION(
        dx_d / dt**2,
        DiracDelta(x) * g,
        correction={dx_d / dt**2: dx_d / dt},
        reason="The derivative of the velocity by time is its first: dt is squared in 2-21a only, "
        "where the rotation is differentiated twice.",
    ),
    "2-21c the same, velocity and time on different sides": Kind.MOTION(
        1 / g * dx_d, DiracDelta(x) * dt
    ),
    "2-21d the same, velocity and rotation on different sides": Kind.MOTION(
        x_d / g * dx_d, DiracDelta(x) * th.dx
    ),
    "2-22 what the function of the velocity must satisfy": Kind.CLOSED_FORM(
        Integral(x_d / g, (x_d, x_d0, th.x_df)),
        Integral(DiracDelta(x), (x, -th.x_0, th.x_f)),
        1,
        remark="For a passage in the direction of +x; in that of -x both limits of x change sign "
        "and the integrals are -1, hence the signum in 2-27.",
        sides=POSITIVE,
    ),
    "2-23 power of the velocity, on trial": Kind.DEFINITION(g, K * x_d**exponent),
    (
        "2-24 2-22 for that power and an impact that leaves the fraction r of the kinetic energy"
    ): Kind.CLOSED_FORM(
        Integral(1 / (K * x_d ** (exponent - 1)), (x_d, x_d0, sqrt(r) * x_d0)),
        1,
        remark="m = 2 is the only power for which K does not depend on the velocity.",
        sides=POSITIVE,
    ),
    "2-25 the factor for the second power": Kind.CLOSED_FORM(K, log(sqrt(r)), sides=POSITIVE),
    "2-26 function of the velocity, for a passage in the direction of +x": Kind.CLOSED_FORM(
        g, -log(sqrt(r)) * x_d**2, correction=NO_MINUS, reason=THE_MINUS, sides=POSITIVE
    ),
    "2-27 function of the velocity, for both directions": Kind.CLOSED_FORM(
        g,
        -log(sqrt(r)) * x_d**2 * tanh(x_d / n),
        correction=NO_MINUS,
        reason=THE_MINUS,
        remark="The tanh stands for the signum of the velocity; its n is that of 2-20, by choice: "
        "as n goes to zero any width of the tanh takes the same energy.",
    ),
    "2-28 force of the impact": Kind.CLOSED_FORM(
        F_delta,
        -log(sqrt(r)) / (n * sqrt(pi)) * tanh(x_d / n) * x_d**2 * exp(-(x**2) / n**2),
        correction=NO_MINUS,
        reason=THE_MINUS,
    ),
    "2-29 free slender block in one smooth equation": Kind.MOTION(
        x_dd - x + tanh(x / n),
        -log(sqrt(r)) / (n * sqrt(pi)) * tanh(x_d / n) * x_d**2 * exp(-(x**2) / n**2),
        correction=NO_MINUS,
        reason=THE_MINUS,
        remark="Its peaks approach those of the block with impacts in proportion to n.",
    ),
}

SECTION_2_6 = section("2.6", IMPACT_AS_FORCE)
