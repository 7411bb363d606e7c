"""ASCE 43-05, appendix A: sliding and rocking of a rigid body that is not anchored.

The text of the standard was not at hand but for an incomplete copy of the beginning of its
appendix: the definitions of A.1, without the rule by which horizontal components combine in its
spectrum and without the factor F_H for them; the outline of A.2, without its equations. The
formulas here are those of a single horizontal component, derived again from energy.
"""

import math

import numpy as np

from rockeom.analysis.standards.check import (
    Check,
    Shaking,
    check_block,
    inertia_per_mass,
    non_negative,
    peak_acceleration,
    spectral_acceleration,
)
from rockeom.motion import DesignSpectrum, GroundMotion
from rockeom.motion.scaling import Acceleration
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, positive_number, require
from rockeom.structures.classes import RigidBlock

_SLIDING_DAMPING = 0.1
_VERTICAL = 0.4
"""Part of the peak vertical acceleration that takes weight off the feet."""
_PERIODS = np.geomspace(0.02, 10.0, 321)
"""Periods between which the one of A.1 is looked for [s], 2 % apart."""


def asce_43_sliding(
    friction: float,
    vertical_acceleration: Acceleration,
    shaking: Shaking,
    *,
    room: float = math.nan,
    gravity: float = STANDARD_GRAVITY,
) -> Check:
    """Sliding displacement of a rigid body by ASCE 43-05, A.1.

    Parameters
    ----------
    friction : float
        Coefficient of friction mu.
    vertical_acceleration : float or str
        Peak vertical acceleration A_v, a number [m/s2] or a text with its unit; 0 without any.
    shaking : GroundMotion or callable or DesignSpectrum
        Horizontal motion; or a function of period [s] and damping ratio that gives the displacement
        [m]; or a `DesignSpectrum` for 10 %, or for 5 %, then with `modified_spectrum`.
    room : float, optional
        Distance that the body may slide to one side [m].
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    Check
        Sliding displacement and room [m]. Where the spectrum stays below c_s, the displacement is 0
        for a ground whose peak acceleration is at most mu_e g, and NaN, no answer, for another.

    Raises
    ------
    InputError
        For numbers that cannot be, for vertical shaking that lifts the body, and for a spectrum
        that is still above c_s at its longest period (10 s at most).

    Notes
    -----
    ``mu_e = mu (1 - 0.4 A_v/g)``, ``c_s = 2 mu_e g``; f_es is the lowest frequency at which the
    spectrum for 10 % of damping is c_s, and the displacement is ``c_s/(2 pi f_es)**2``. An elastic
    spring whose force is m c_s at the displacement stores as much energy as friction takes.

    Domain: a rigid body on level ground that slides and does not rock. How horizontal components
    combine in the spectrum was not at hand, nor a factor F_H that the standard has for them: give
    the spectrum that should count. With one component alone the displacement is less than that of
    the standard for two.

    References
    ----------
    ASCE/SEI 43-05, appendix A.1, second-hand.
    """
    where = "asce_43_sliding"
    mu = positive_number("friction", friction, where)
    g = positive_number("gravity", gravity, where)
    vertical = peak_acceleration(where, "vertical_acceleration", vertical_acceleration)
    rule = "it takes all weight off the feet: the procedure has no answer"
    require(_VERTICAL * vertical < g, where, "vertical_acceleration", vertical, rule)
    if not math.isnan(room):
        non_negative(where, "room", room)
    grip = mu * (1.0 - _VERTICAL * vertical / g) * g
    slid = _slid(shaking, grip)
    verdict = "stays in its place" if slid == 0.0 else "slides"
    if math.isnan(slid):
        verdict = "no answer: the spectrum stays below c_s"
    elif not math.isnan(room) and slid > 0.0:
        verdict = "slides within its room" if slid <= room else "slides beyond its room"
    source = "ASCE 43-05, A.1, second-hand, one horizontal component"
    return Check("ASCE 43, sliding", "displacement", slid, float(room), "m", verdict, source)


def _slid(shaking: Shaking, grip: float) -> float:
    """The displacement at the longest period at which the spectrum is 2 mu_e g."""
    from scipy.optimize import brentq  # takes long to import

    coefficient, periods = 2.0 * grip, _PERIODS
    if isinstance(shaking, DesignSpectrum):
        inside = (periods > shaking.shortest) & (periods < shaking.longest)
        ends = [t for t in (shaking.shortest, shaking.longest) if periods[0] <= t <= periods[-1]]
        periods = np.sort([*periods[inside], *ends])

    def excess(period: float) -> float:
        return spectral_acceleration(shaking, period, _SLIDING_DAMPING) - coefficient

    above = np.array([excess(t) >= 0.0 for t in periods.tolist()])
    if above[-1]:
        raise InputError("shaking", of="asce_43_sliding").wrong(
            f"exceeds 2 mu_e g, {coefficient:.3g} m/s2, at its longest period, {periods[-1]:g} s: "
            "give a spectrum that goes on to longer periods"
        )
    if not above.any():
        return math.nan if _peak(shaking) > grip else 0.0
    last = int(np.flatnonzero(above)[-1])
    period = brentq(excess, periods[last], periods[last + 1], xtol=1e-15, rtol=1e-14)
    return float(coefficient * (period / (2.0 * math.pi)) ** 2)


def _peak(shaking: Shaking) -> float:
    """Peak ground acceleration, or the acceleration at the shortest period [m/s2]."""
    if isinstance(shaking, GroundMotion):
        return shaking.peak
    if isinstance(shaking, DesignSpectrum):
        return float(shaking(shaking.shortest))
    return spectral_acceleration(shaking, float(_PERIODS[0]), _SLIDING_DAMPING)


def asce_43_rocking(block: RigidBlock, shaking: Shaking, *, rotation: float | None = None) -> Check:
    """Rocking of a rigid body to a rotation, by ASCE 43-05, A.2.

    Parameters
    ----------
    block : RigidBlock
        Block.
    shaking : GroundMotion or callable or DesignSpectrum
        Horizontal motion; or a function of period [s] and damping ratio that gives the displacement
        [m]; or a `DesignSpectrum`, with `modified_spectrum` for another damping than its own.
    rotation : float, optional
        Largest rotation t that the block may have [rad]; alpha, that of overturning, if not given.

    Returns
    -------
    Check
        Spectral acceleration at the frequency and the damping of the rotation, and that which takes
        the block there [m/s2].

    Raises
    ------
    InputError
        For another structure, a rotation outside 0 to alpha, a block so broad that C_R is not
        positive, and a spectrum without this period.

    Notes
    -----
    With ``a = b/h``, ``f = cos(t) + a sin(t)`` and ``C3 = I_o/(m h**2)``::

        SA_cap = 2 g (f - 1)/t
        f_e = sqrt(2 g (f - 1)/(C3 h t**2))/(2 pi)
        C_R = 1 - 2 a**2/C3,  gamma = -2 ln(C_R),  damping = gamma/sqrt(4 pi**2 + gamma**2)

    Derived here: a rotational spring with the moment m h SA_cap at t stores the energy m g h (f -
    1) that the block has there. C_R is the ratio of angular velocities at an impact by angular
    momentum, a restitution of velocities; two impacts a cycle are the logarithmic decrement gamma.

    Domain: a rigid body on level ground that rocks and does not slide. The standard has, besides, a
    factor for vertical motion and lets the mass that is shaken differ from that which resists;
    their equations were not at hand, and both are left out. Its capacity with vertical motion is
    less.

    References
    ----------
    ASCE/SEI 43-05, appendix A.2, second-hand.
    """
    where = "asce_43_rocking"
    check_block(where, block)
    t = block.alpha if rotation is None else positive_number("rotation", rotation, where)
    rule = f"give at most alpha, {block.alpha:.4g} rad: beyond it the block does not come back"
    require(t <= block.alpha, where, "rotation", t, rule)
    height, g = float(block.half_height), float(block.gravity)
    a, c3 = float(block.half_width) / height, inertia_per_mass(block) / height**2
    rise = math.cos(t) + a * math.sin(t) - 1.0
    capacity = 2.0 * g * rise / t
    period = 2.0 * math.pi / math.sqrt(2.0 * g * rise / (c3 * height * t**2))
    restitution = 1.0 - 2.0 * a**2 / c3
    if restitution <= 0.0:
        raise InputError("block", of=where).wrong("is so broad that it does not rock on: it lands")
    gamma = -2.0 * math.log(restitution)
    demand = spectral_acceleration(shaking, period, gamma / math.hypot(2.0 * math.pi, gamma))
    reached = "overturns" if rotation is None else f"turns beyond {t:.3g} rad"
    short = "stands" if rotation is None else f"turns less than {t:.3g} rad"
    verdict = reached if demand >= capacity else short
    source = "ASCE 43-05, A.2, derived, without the standard's vertical motion"
    name, quantity = "ASCE 43, rocking", "spectral acceleration"
    return Check(name, quantity, demand, capacity, "m/s2", verdict, source)
