"""Equivalent viscous damping: of rocking, of hysteresis, and of a measured decay.

Damping ratios are fractions of the critical damping: 0.05 is 5 %. A ductility is the largest
displacement over that at yield, 1 or more; a stiffness_ratio is k_p/k_i, the stiffness after
yield over the initial one.
"""

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import InputError, not_negative, numbers, positive, require

# --- rocking


def fema_356_damping(energy_ratio: ArrayLike):
    """Damping ratio of rocking after FEMA 356, 0.4 (1 - sqrt(r)); thesis 2-15.

    Parameters
    ----------
    energy_ratio : array_like
        Energy ratio r of an impact (thesis 2-6), any shape.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of the argument.

    Raises
    ------
    ValueError
        Outside 0 < r <= 1.

    Notes
    -----
    An empirical fit, 40 to 50 % below `priestley_damping`.
    """
    return 0.4 * (1 - np.sqrt(_energy_ratio("fema_356_damping", energy_ratio)))


def priestley_damping(energy_ratio: ArrayLike):
    """Damping ratio of rocking after Priestley et al. (1978), -0.34 ln(r); thesis 2-16.

    Parameters
    ----------
    energy_ratio : array_like
        Energy ratio r of an impact (thesis 2-6), any shape; not the velocity ratio, which Table 2-3
        has in its place.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of the argument.

    Raises
    ------
    ValueError
        Outside 0 < r <= 1.

    Notes
    -----
    The decrement of small rocking is -ln(r)/pi = -0.318 ln(r).
    """
    return -0.34 * np.log(_energy_ratio("priestley_damping", energy_ratio))


def _energy_ratio(where: str, value: ArrayLike) -> np.ndarray:
    (r,) = numbers(where, energy_ratio=value)
    rule = "the ratio of kinetic energies after and before an impact lies in (0, 1]"
    require((r > 0) & (r <= 1), where, "energy_ratio", r, rule)
    return r


# --- hysteresis


def recentring_ratio(
    restoring_moment: ArrayLike, axial_moment: ArrayLike, dissipating_moment: ArrayLike
):
    """Ratio lambda = (M_AE + M_N)/M_ED of a controlled rocking system; thesis 2-30.

    Parameters
    ----------
    restoring_moment : array_like
        Contribution M_AE of an added elastic element, a tendon, to the design moment [N m].
    axial_moment : array_like
        Contribution M_N of the weight [N m].
    dissipating_moment : array_like
        Contribution M_ED of the dissipaters [N m].

    Returns
    -------
    float or ndarray
        Ratio lambda, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        Where the dissipating moment is not positive, or a contribution is negative.

    Notes
    -----
    The system returns upright where lambda exceeds the ratio of the restoring moments at the design
    rotation and at the opening of the joint; 1 is not enough where they rise.

    References
    ----------
    Palermo et al. (2005).
    """
    where = "recentring_ratio"
    restoring, axial = not_negative(
        where, restoring_moment=restoring_moment, axial_moment=axial_moment
    )
    (dissipating,) = positive(where, dissipating_moment=dissipating_moment)
    return (restoring + axial) / dissipating


def equivalent_damping(elastic_damping: ArrayLike, hysteretic_damping: ArrayLike):
    """Total damping ratio: the sum of the elastic and the hysteretic one; thesis 2-31.

    Parameters
    ----------
    elastic_damping : array_like
        Elastic damping ratio xi_el.
    hysteretic_damping : array_like
        Hysteretic damping ratio xi_hyst.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For a negative damping ratio, or shapes that do not broadcast.

    References
    ----------
    Jacobsen (1930).
    """
    elastic, hysteretic = not_negative(
        "equivalent_damping",
        elastic_damping=elastic_damping,
        hysteretic_damping=hysteretic_damping,
    )
    return elastic + hysteretic


def bilinear_damping(ductility: ArrayLike, stiffness_ratio: ArrayLike):
    """Hysteretic damping ratio of the bilinear rule; thesis 2-32a.

    Parameters
    ----------
    ductility : array_like
        Ductility mu.
    stiffness_ratio : array_like
        Ratio k_p/k_i of the stiffness after yield and the initial one, in [0, 1].

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For a ductility below 1 and a stiffness ratio outside its range.

    Notes
    -----
    As with all three rules, the damping is the area of a cycle over 2 pi F_m u_m. It goes with the
    secant stiffness at the largest displacement, although chapter 2 introduces it with the initial
    one.

    References
    ----------
    Priestley and Grant (2005).
    """
    mu, ratio = _rule_arguments("bilinear_damping", ductility, stiffness_ratio)
    return 2 * (mu - 1) * (1 - ratio) / (np.pi * mu * (1 + ratio * (mu - 1)))


def takeda_damping(ductility: ArrayLike, stiffness_ratio: ArrayLike, unloading_exponent: ArrayLike):
    """Hysteretic damping ratio of the Takeda rule; thesis 2-32b.

    Parameters
    ----------
    ductility : array_like
        Ductility mu.
    stiffness_ratio : array_like
        Ratio k_p/k_i of the stiffness after yield and the initial one, in [0, 1].
    unloading_exponent : array_like
        Exponent alpha_T in [0, 1): the rule unloads with k_i mu^-alpha_T and reloads towards the
        last peak of the other side.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        Where such an unloading would reach zero force beyond the origin, and for a ductility below
        1 or a stiffness ratio outside its range.

    References
    ----------
    Priestley and Grant (2005).
    """
    where = "takeda_damping"
    mu, ratio = _rule_arguments(where, ductility, stiffness_ratio)
    (exponent,) = not_negative(where, unloading_exponent=unloading_exponent)
    rule = "alpha_T lies in [0, 1)"
    require(exponent < 1, where, "unloading_exponent", exponent, rule)
    residual = 1 - (1 - ratio) * mu ** (exponent - 1) - ratio * mu**exponent  # u_r/u_m
    rule = "the unloading is so soft that it passes the origin: give a smaller alpha_T or ductility"
    require(residual >= -1e-12, where, "unloading_exponent", exponent, rule)
    return np.maximum(residual, 0.0) / np.pi


def flag_damping(ductility: ArrayLike, stiffness_ratio: ArrayLike, flag_height: ArrayLike):
    """Hysteretic damping ratio of the flag-shaped rule; thesis 2-32c.

    Parameters
    ----------
    ductility : array_like
        Ductility mu.
    stiffness_ratio : array_like
        Ratio k_p/k_i of the stiffness after yield and the initial one, in [0, 1).
    flag_height : array_like
        Height beta_FS of the flag: the gap between the loading and the unloading branch at the same
        displacement, over the force at yield.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a ductility below 1, a stiffness ratio outside its range, and a flag higher than 1 -
        k_p/k_i, which would not return to the origin.

    Notes
    -----
    Where beta_FS is measured along the elastic branch instead, the damping is 1 - k_p/k_i times as
    large.

    References
    ----------
    Priestley and Grant (2005).
    """
    where = "flag_damping"
    mu, ratio = _rule_arguments(where, ductility, stiffness_ratio)
    (height,) = not_negative(where, flag_height=flag_height)
    rule = "above 1 - stiffness_ratio the unloading does not return to the origin; it is no flag"
    require(height <= 1 - ratio, where, "flag_height", height, rule)
    return height * (mu - 1) / (np.pi * mu * (1 + ratio * (mu - 1)))


def _rule_arguments(where: str, ductility: ArrayLike, stiffness_ratio: ArrayLike):
    (ratio,) = not_negative(where, stiffness_ratio=stiffness_ratio)
    require(ratio <= 1, where, "stiffness_ratio", ratio, "k_p/k_i lies in [0, 1]")
    return _ductility(where, ductility), ratio


def _ductility(where: str, value: ArrayLike) -> np.ndarray:
    (mu,) = numbers(where, ductility=value)
    require(mu >= 1, where, "ductility", mu, "below 1 nothing yields: give 1 or more")
    return mu


# --- empirical fits for displacement-based design


@dataclass(frozen=True)
class DesignFactors:
    """Factors of thesis 2-35 for a rule of hysteresis.

    Parameters
    ----------
    a : float
        Largest hysteretic damping ratio.
    b : float
        Exponent of the ductility.
    c : float
        Period added to the effective one [s].
    d : float
        Exponent of the period.
    """

    a: float
    b: float
    c: float
    d: float


@dataclass(frozen=True)
class GrantFactors(DesignFactors):
    """Factors of thesis 2-33 for a rule of hysteresis.

    Parameters
    ----------
    a : float
        Largest hysteretic damping ratio.
    b : float
        Exponent of the ductility.
    c : float
        Period added to the effective one [s].
    d : float
        Exponent of the period.
    e : float
        Exponent of the ductility with a constant coefficient of elastic damping.
    f : float
        Exponent of the ductility with elastic damping proportional to the tangent stiffness.
    """

    e: float
    f: float


GRANT_FACTORS: Mapping[str, GrantFactors] = MappingProxyType(
    {
        "elastic_perfectly_plastic": GrantFactors(0.224, 0.336, -0.002, 0.250, 0.127, -0.341),
        "bilinear": GrantFactors(0.262, 0.655, 0.813, 4.890, 0.193, -0.808),  # k_p/k_i = 0.2
        "takeda_thin": GrantFactors(0.215, 0.642, 0.824, 6.444, 0.340, -0.378),
        "takeda_fat": GrantFactors(0.305, 0.492, 0.790, 4.463, 0.312, -0.313),
        "flag": GrantFactors(0.251, 0.148, 3.015, 0.511, 0.387, -0.430),  # beta 0.35, k_p/k_i 0.05
        "ramberg_osgood": GrantFactors(0.289, 0.622, 0.856, 6.460, -0.060, -0.647),
    }
)
"""Table 2-4 of the thesis, by rule of hysteresis; Grant et al. (2005)."""

DESIGN_FACTORS: Mapping[str, DesignFactors] = MappingProxyType(
    {
        "elastic_perfectly_plastic": DesignFactors(0.222, 0.397, 0.287, 1.295),
        "bilinear": DesignFactors(0.161, 0.952, 0.945, 2.684),
        "takeda_thin": DesignFactors(0.183, 0.588, 0.848, 3.607),
        "takeda_fat": DesignFactors(0.249, 0.527, 0.761, 3.250),
        # b has one digit, and only a b ln(ductility) counts: good to 8 %
        "flag": DesignFactors(3566.0, 6e-6, 0.223, 0.8405),  # beta 0.35, k_p/k_i 0.05
        "ramberg_osgood": DesignFactors(0.156, 1.049, 0.781, 2.106),
    }
)
"""Table 2-5 of the thesis, by rule of hysteresis; Grant et al. (2005)."""


def grant_damping(
    rule: str | GrantFactors,
    ductility: ArrayLike,
    effective_period: ArrayLike,
    *,
    constant_damping: ArrayLike,
    tangent_damping: ArrayLike,
):
    """Damping ratio by the "analysis" expression of Grant et al. (2005); thesis 2-33.

    Parameters
    ----------
    rule : str or GrantFactors
        Name of one of GRANT_FACTORS, or your own factors.
    ductility : array_like
        Ductility mu.
    effective_period : array_like
        Effective period T_e, of the secant stiffness [s].
    constant_damping : array_like
        Elastic damping ratio xi_const of a structure whose damper has a constant coefficient;
        otherwise 0.
    tangent_damping : array_like
        Elastic damping ratio xi_tang of a structure whose damping is proportional to the tangent
        stiffness; otherwise 0.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of all arguments, broadcast: a (1 - mu^-b)(1 + (T_e + c)^-d) +
        mu^e xi_const + mu^f xi_tang.

    Raises
    ------
    ValueError
        For an unknown rule, a ductility below 1, and a period of -c or less.
    """
    where = "grant_damping"
    factors = _factors(where, rule, GRANT_FACTORS)
    mu = _ductility(where, ductility)
    constant, tangent = not_negative(
        where, constant_damping=constant_damping, tangent_damping=tangent_damping
    )
    elastic = mu**factors.e * constant + mu**factors.f * tangent
    return _hysteretic(where, factors, mu, effective_period) + elastic


def simplified_damping(viscous_damping: ArrayLike, coefficient: ArrayLike, ductility: ArrayLike):
    """Damping ratio without the period: xi_v + C (mu - 1)/(pi mu); thesis 2-34.

    Parameters
    ----------
    viscous_damping : array_like
        Viscous damping ratio xi_v.
    coefficient : array_like
        Coefficient C of the rule of hysteresis.
    ductility : array_like
        Ductility mu.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For negative numbers and a ductility below 1.

    References
    ----------
    Dwairi et al. (2007), Priestley et al. (2007).
    """
    where = "simplified_damping"
    viscous, coefficient = not_negative(
        where, viscous_damping=viscous_damping, coefficient=coefficient
    )
    mu = _ductility(where, ductility)
    return viscous + coefficient * (mu - 1) / (np.pi * mu)


def design_damping(rule: str | DesignFactors, ductility: ArrayLike, effective_period: ArrayLike):
    """Damping ratio by the "design" expression of Grant et al. (2005); thesis 2-35.

    Parameters
    ----------
    rule : str or DesignFactors
        Name of one of DESIGN_FACTORS, or your own factors.
    ductility : array_like
        Ductility mu.
    effective_period : array_like
        Effective period T_e, of the secant stiffness [s].

    Returns
    -------
    float or ndarray
        Damping ratio 0.05 + a (1 - mu^-b)(1 + (T_e + c)^-d), in the shape of all arguments,
        broadcast. It contains the elastic damping of 5 %.

    Raises
    ------
    ValueError
        For an unknown rule, a ductility below 1, and a period of -c or less.
    """
    where = "design_damping"
    factors = _factors(where, rule, DESIGN_FACTORS)
    mu = _ductility(where, ductility)
    return 0.05 + _hysteretic(where, factors, mu, effective_period)


def _hysteretic(where: str, factors: DesignFactors, mu: np.ndarray, period: ArrayLike):
    """The term that 2-33 and 2-35 share."""
    (period,) = positive(where, effective_period=period)
    rule = f"this rule's fit needs more than {-factors.c} s"
    require(period + factors.c > 0, where, "effective_period", period, rule)
    # 1 - mu**-b, exact for the flag's tiny b
    grown = -np.expm1(-factors.b * np.log(mu))
    return factors.a * grown * (1 + (period + factors.c) ** -factors.d)


F = TypeVar("F", bound=DesignFactors)


def _factors(where: str, rule: str | F, table: Mapping[str, F]) -> F:
    if not isinstance(rule, str):
        return rule
    if rule not in table:
        near = difflib.get_close_matches(rule, table, n=1)
        hint = f" (did you mean {near[0]!r}?)" if near else ""
        raise InputError("rule", rule, where).wrong(
            f"is {rule!r}, which is unknown{hint}; there are {', '.join(table)}"
        )
    return table[rule]


# --- a measured decay


def damping_from_decrement(peak: ArrayLike, next_peak: ArrayLike):
    """Damping ratio of a cycle for small damping, ln(peak/next_peak)/(2 pi); thesis 5-7.

    Parameters
    ----------
    peak : array_like
        Peak, in any unit.
    next_peak : array_like
        Peak a whole cycle later, so of the same sign, in the same unit.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of both arguments, broadcast; negative where the motion grew.

    Raises
    ------
    ValueError
        Where a peak is zero or the two are of opposite sides.

    Notes
    -----
    Where peaks are of both sides in turn, a cycle is two peaks apart:
    ``damping_from_decrement(peaks[:-2], peaks[2:])``.
    """
    return _decrement("damping_from_decrement", peak, next_peak) / (2 * np.pi)


def damping_from_decrement_exact(peak: ArrayLike, next_peak: ArrayLike):
    """Damping ratio of a cycle of a linear oscillator, delta/sqrt(4 pi**2 + delta**2).

    Parameters
    ----------
    peak : array_like
        Peak, in any unit.
    next_peak : array_like
        Peak a whole cycle later, so of the same sign, in the same unit.

    Returns
    -------
    float or ndarray
        Damping ratio, in the shape of both arguments, broadcast; negative where the motion grew.

    Raises
    ------
    ValueError
        Where a peak is zero or the two are of opposite sides.

    See Also
    --------
    damping_from_decrement : For small damping, as thesis 5-7 has it.

    Notes
    -----
    The logarithmic decrement is delta = ln(peak/next_peak), which thesis 5-7 divides by 2 pi.
    """
    delta = _decrement("damping_from_decrement_exact", peak, next_peak)
    return delta / np.hypot(2 * np.pi, delta)


def _decrement(where: str, peak: ArrayLike, next_peak: ArrayLike):
    peak, following = numbers(where, peak=peak, next_peak=next_peak)
    require(peak != 0, where, "peak", peak, "a peak is not zero")
    rule = "it must be on the same side as the peak before: the two are a whole cycle apart"
    require(peak * following > 0, where, "next_peak", following, rule)
    return np.log(peak / following)
