"""Quarter periods of a free block: the slender block, and the block of any rotation.

Both start from rest. p = sqrt(m g R/I_o) is the frequency parameter [rad/s],
`RigidBlock.frequency_parameter`; alpha is the rotation of unstable equilibrium [rad].
"""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import slenderness
from rockeom.numbers.checks import not_negative, positive, require


def quarter_period(amplitude_ratio: ArrayLike, p: ArrayLike):
    """Time from rest at a rotation to the impact of a slender block; thesis 2-5 over 4.

    Parameters
    ----------
    amplitude_ratio : array_like
        Rotation at rest over the slenderness, theta_0/alpha, at least 0 and below 1.
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].

    Returns
    -------
    float or ndarray
        Time acosh(1/(1 - theta_0/alpha))/p [s], in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For a rotation at or beyond alpha: the block does not fall back.

    References
    ----------
    Housner (1963); Muto et al. (1960).
    """
    where = "quarter_period"
    (p,) = positive(where, p=p)
    (ratio,) = not_negative(where, amplitude_ratio=amplitude_ratio)
    require(ratio < 1, where, "amplitude_ratio", ratio, _BALANCE)
    # acosh(1/(1 - x)) without its cancellation at small x
    return (np.log1p(np.sqrt(ratio * (2 - ratio))) - np.log1p(-ratio)) / p


def exact_quarter_period(theta_0: ArrayLike, alpha: ArrayLike, p: ArrayLike):
    """Time from rest at any rotation to the impact of a block.

    Parameters
    ----------
    theta_0 : array_like
        Rotation at rest, at least 0 and below alpha [rad].
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].

    Returns
    -------
    float or ndarray
        Time [s], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a rotation at or beyond alpha: the block does not fall back.

    See Also
    --------
    quarter_period : The approximation for slender blocks and small rotations, thesis 2-5.

    Notes
    -----
    This is what thesis 2-5 approximates: the exact time of ``theta'' = -p**2 sin(alpha - theta)``,
    thesis 2-2. With a = sin((alpha - theta_0)/2) and b = sin(alpha/2) it is the elliptic integral::

        (1/p) int_a^b ds/sqrt((1 - s**2)(s**2 - a**2))
            = (K(k) - F(asin(cos(alpha/2)/k), k))/p,  k = cos((alpha - theta_0)/2),

    which is evaluated in Carlson's symmetric form, where nothing cancels.

    Examples
    --------
    >>> from rockeom import analysis
    >>> float(analysis.formulas.exact_quarter_period(0.1, alpha=0.25, p=2.14))  # s
    0.5145...
    """
    from scipy.special import elliprf  # takes long to import

    where = "exact_quarter_period"
    alpha = slenderness(where, alpha)
    (p,) = positive(where, p=p)
    (theta,) = not_negative(where, theta_0=theta_0)
    require(theta < alpha, where, "theta_0", theta, _BALANCE)
    lean = (alpha - theta) / 2
    a2, b2 = np.sin(lean) ** 2, np.sin(alpha / 2) ** 2
    difference = np.sin(alpha - theta / 2) * np.sin(theta / 2)  # b2 - a2
    c2 = np.cos(lean) ** 2  # 1 - a2
    root = elliprf(a2 * c2, b2 * c2, a2 * np.cos(alpha / 2) ** 2)
    return np.sqrt(difference) * root / p


def rocking_period(amplitude_ratio: ArrayLike, p: ArrayLike):
    """Period of a cycle of the slender block whose impacts lose nothing; thesis 2-5.

    Parameters
    ----------
    amplitude_ratio : array_like
        Rotation at rest over the slenderness, theta_0/alpha, at least 0 and below 1.
    p : array_like
        Frequency parameter sqrt(m g R/I_o) of the block about an edge [rad/s].

    Returns
    -------
    float or ndarray
        Period, four quarter periods [s], in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For a rotation at or beyond alpha: the block does not fall back.

    Notes
    -----
    With losses each half cycle starts from a smaller rotation and is shorter.

    References
    ----------
    Housner (1963).

    Examples
    --------
    >>> from rockeom import analysis
    >>> float(analysis.formulas.rocking_period(0.5, p=2.14))  # s, of theta_0/alpha = 0.5
    2.4616...
    """
    return 4 * quarter_period(amplitude_ratio, p)


_BALANCE = (
    "at alpha the block balances and beyond it falls over, so there is no period: "
    "give a rotation below alpha"
)
