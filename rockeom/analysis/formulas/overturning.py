"""Housner's criteria of overturning: a constant push, half a sine, an earthquake (thesis 2.2).

    from rockeom.analysis import formulas

    formulas.overturning_half_sine(duration=0.5, alpha=0.2, p=2.14)  # m/s2

All are of the slender block, theta'' = p**2 (theta -+ alpha) + p**2 a_g/g. As long as it stays on
one foot, q = theta - alpha + theta'/p obeys q' = p (q + a_g/g): the block overturns without an
impact if q, which starts from -alpha where the ground reaches g alpha, is positive in the end.
Source: Housner (1963).
"""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import slenderness
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import positive, require


def overturning_constant(
    duration: ArrayLike, alpha: ArrayLike, p: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """Constant acceleration that overturns a slender block within the time of its push.

    Parameters
    ----------
    duration : array_like
        Duration t_1 of the push [s].
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Least acceleration a that overturns [m/s2], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and an alpha outside (0, pi/2).

    Notes
    -----
    The least a with 2 (a/(g alpha)) (a/(g alpha) - 1) (cosh(p t_1) - 1) >= 1, which is the same as
    (a/(g alpha)) (1 - exp(-p t_1)) >= 1.

    References
    ----------
    Housner (1963).
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
    """Amplitude of half a sine that overturns a slender block.

    Parameters
    ----------
    duration : array_like
        Duration t_1 of the half wave, pi/omega [s].
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].
    whole : bool, optional
        Whether the end of the pulse counts. With False the result is Housner's ``g alpha sqrt(1 +
        (omega/p)**2)``, in which the sine goes on while the block falls: it then pulls the block
        back, and the amplitude is larger.

    Returns
    -------
    float or ndarray
        Amplitude a of the acceleration [m/s2], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and an alpha outside (0, pi/2).

    Notes
    -----
    With A = a/(g alpha), sin(psi) = 1/A, the ground reaching g alpha at psi/omega, w = omega/p, and
    q = theta - alpha + theta'/p, q vanishes in the end for ``A (sin(psi) + w (cos(psi) + exp(-(pi -
    psi)/w))) = 1 + w**2``.

    References
    ----------
    Housner (1963).

    Examples
    --------
    >>> from rockeom import analysis
    >>> amplitude = analysis.formulas.overturning_half_sine(duration=0.5, alpha=0.25, p=2.14)
    >>> round(float(amplitude), 2)  # m/s2
    5.55
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

    Parameters
    ----------
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Spectral velocity S_v = alpha g/p [m/s], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and an alpha outside (0, pi/2).

    Notes
    -----
    The energy that pushes like those of an earthquake bring on the average, ``(m R S_v)**2/(2
    I_o)``, is that of the balance, ``m g R alpha**2/2``. For the rectangle with the half-diagonal
    R, S_v is alpha sqrt(4 g R/3). The spectrum is assumed flat, as that of white noise, and impacts
    to lose nothing.

    References
    ----------
    Housner (1963).
    """
    where = "overturning_spectral_velocity"
    p, gravity = positive(where, p=p, gravity=gravity)
    return slenderness(where, alpha) * gravity / p


def stable_slenderness(
    spectral_velocity: ArrayLike, p: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """Slenderness of the block that an earthquake overturns with even odds, p S_v/g.

    Parameters
    ----------
    spectral_velocity : array_like
        Undamped spectral velocity S_v [m/s].
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Slenderness alpha [rad], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and where alpha is pi/2 or more.

    See Also
    --------
    overturning_spectral_velocity : The inverse.
    """
    where = "stable_slenderness"
    velocity, p, gravity = positive(
        where, spectral_velocity=spectral_velocity, p=p, gravity=gravity
    )
    angle = p * velocity / gravity
    rule = "so strong a motion overturns any slender block"
    require(angle < np.pi / 2, where, "spectral_velocity", velocity, rule)
    return angle
