"""Housner's criteria of overturning: a constant push, half a sine, an earthquake (thesis 2.2).

    from rockeom.analysis import formulas

    formulas.overturning_half_sine(duration=0.5, alpha=0.2, p=2.14)  # m/s2

All are of the slender block, theta'' = p**2 (theta -+ alpha) + p**2 a_g/g. As long as it stays on
one foot, q = theta - alpha + theta'/p obeys q' = p (q + a_g/g): the block overturns without an
impact if q, which starts from -alpha where the ground reaches g alpha, is positive in the end.
Source: Housner (1963).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import slenderness
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import positive, require


def overturning_constant(
    duration: ArrayLike, alpha: ArrayLike, p: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """Constant acceleration that overturns a slender block in a given time [m/s2].

    duration t_1 of the push [s]; alpha [rad]; p [rad/s]; gravity [m/s2]; any shapes, broadcast.
    The least a with 2 (a/(g alpha)) (a/(g alpha) - 1) (cosh(p t_1) - 1) >= 1, which is the same as
    (a/(g alpha)) (1 - exp(-p t_1)) >= 1. Source: Housner (1963).
    """
    where = "overturning_constant"
    duration, p, gravity = positive(where, duration=duration, p=p, gravity=gravity)
    return gravity * slenderness(where, alpha) / -np.expm1(-p * duration)


def overturning_half_sine(
    duration: ArrayLike,
    alpha: ArrayLike,
    p: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
    *,
    whole: bool = True,
):
    """Amplitude of half a sine that overturns a slender block [m/s2].

    duration t_1 of the half wave, pi/omega [s]; alpha [rad]; p [rad/s]; gravity [m/s2]; any
    shapes, broadcast.
    whole : that the pulse ends counts too. With False it is Housner's g alpha
        sqrt(1 + (omega/p)**2), in which the sine goes on while the block falls: it then pulls the
        block back, and the amplitude is larger.

    With A = a/(g alpha), sin(psi) = 1/A, the ground reaching g alpha at psi/omega, and
    w = omega/p, q vanishes in the end for
    A (sin(psi) + w (cos(psi) + exp(-(pi - psi)/w))) = 1 + w**2.
    Source: Housner (1963), and q of this module. Raises ValueError as the others do.
    """
    where = "overturning_half_sine"
    duration, p, gravity = positive(where, duration=duration, p=p, gravity=gravity)
    alpha = slenderness(where, alpha)
    ratio = np.pi / (duration * p)  # omega/p
    if not whole:
        return gravity * alpha * np.hypot(1.0, ratio)
    return gravity * alpha * np.vectorize(_half_sine, otypes=[float])(ratio)


def _half_sine(ratio: float) -> float:
    from scipy.optimize import brentq  # takes long to import

    def lacking(size: float) -> float:
        psi = np.arcsin(1 / size)
        gained = np.sin(psi) + ratio * (np.cos(psi) + np.exp(-(np.pi - psi) / ratio))
        return float(size * gained - (1 + ratio**2))

    return float(brentq(lacking, 1.0, float(np.hypot(1.0, ratio)), xtol=1e-15, rtol=1e-14))


def overturning_spectral_velocity(
    alpha: ArrayLike,
    p: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Undamped spectral velocity of an earthquake that overturns a slender block with even odds.

    alpha [rad]; p = sqrt(m g R/I_o) [rad/s]; gravity [m/s2]; any shapes, broadcast. Returns
    S_v = alpha g/p [m/s]: the energy that pushes like those of an earthquake bring on the average,
    (m R S_v)**2/(2 I_o), is that of the balance, m g R alpha**2/2. For the rectangle with the
    half-diagonal R it is alpha sqrt(4 g R/3). The spectrum is assumed flat, as that of white
    noise, and impacts to lose nothing. Source: Housner (1963).
    """
    where = "overturning_spectral_velocity"
    p, gravity = positive(where, p=p, gravity=gravity)
    return slenderness(where, alpha) * gravity / p


def stable_slenderness(
    spectral_velocity: ArrayLike, p: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """alpha of the block that an earthquake overturns with even odds [rad]: p S_v/g.

    spectral_velocity S_v, undamped [m/s]; p, gravity as in `overturning_spectral_velocity`, of
    which it is the inverse. Raises ValueError where it is pi/2 or more.
    """
    where = "stable_slenderness"
    velocity, p, gravity = positive(
        where, spectral_velocity=spectral_velocity, p=p, gravity=gravity
    )
    angle = p * velocity / gravity
    rule = "so strong a motion overturns any slender block"
    require(angle < np.pi / 2, where, "spectral_velocity", velocity, rule)
    return angle
