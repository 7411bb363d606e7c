"""Uplift of a structure, and its vibration after it."""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import not_negative, positive


def uplift_acceleration(
    half_width: ArrayLike, half_height: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """Ground acceleration at which a rigid block starts to rock, g B/H; thesis 2-1.

    Parameters
    ----------
    half_width : array_like
        Half of the width of the block, B [m].
    half_height : array_like
        Half of its height, H [m].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Acceleration [m/s2], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    Notes
    -----
    Milne and West proposed it as the criterion of overturning; it is that of uplift, and
    overturning needs more.

    References
    ----------
    Milne (1908).
    """
    half_width, half_height, gravity = positive(
        "uplift_acceleration", half_width=half_width, half_height=half_height, gravity=gravity
    )
    return gravity * half_width / half_height


def uplift_displacement(
    angular_frequency: ArrayLike,
    half_width: ArrayLike,
    height: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Deformation at which a mass on an elastic column lifts a foot, ``g B/(omega**2 H)``.

    Parameters
    ----------
    angular_frequency : array_like
        Angular frequency omega of the column on a fixed base [rad/s].
    half_width : array_like
        Half of the width of the base, B [m].
    height : array_like
        Height H of the mass [m].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Deformation u_c [m], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    Notes
    -----
    The base has no mass. This is the critical static deformation of thesis 2.4.1.

    References
    ----------
    Chopra and Yim (1985).
    """
    omega, half_width, height, gravity = positive(
        "uplift_displacement",
        angular_frequency=angular_frequency,
        half_width=half_width,
        height=height,
        gravity=gravity,
    )
    return gravity * half_width / (omega**2 * height)


def uplifted_frequency(angular_frequency: ArrayLike, half_width: ArrayLike, height: ArrayLike):
    """Angular frequency of the column's vibration while a foot is lifted; thesis 2-8a.

    Parameters
    ----------
    angular_frequency : array_like
        Angular frequency omega of the column on a fixed base [rad/s].
    half_width : array_like
        Half of the width of the base, B [m].
    height : array_like
        Height H of the mass [m].

    Returns
    -------
    float or ndarray
        Angular frequency omega R/B with R = hypot(B, H) [rad/s], in the shape of all arguments,
        broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    Notes
    -----
    The column then bends against the inertia of the rotation, not against the ground. The base has
    no mass, rotations are small. Chapter 2 writes B for the width as well; here it is the half.

    References
    ----------
    Chopra and Yim (1985).
    """
    (omega,) = positive("uplifted_frequency", angular_frequency=angular_frequency)
    half_width, height = positive("uplifted_frequency", half_width=half_width, height=height)
    return omega * np.hypot(half_width, height) / half_width


def uplifted_damping(damping_ratio: ArrayLike, half_width: ArrayLike, height: ArrayLike):
    """Damping ratio of the column's vibration while a foot is lifted; thesis 2-8b.

    Parameters
    ----------
    damping_ratio : array_like
        Damping ratio xi of the column on a fixed base.
    half_width : array_like
        Half of the width of the base, B [m].
    height : array_like
        Height H of the mass [m].

    Returns
    -------
    float or ndarray
        Damping ratio xi R/B, in the shape of all arguments, broadcast; it may exceed 1: then the
        column does not vibrate.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    Notes
    -----
    The ratio to xi depends on the slenderness H/B alone, not on the size.
    """
    (ratio,) = not_negative("uplifted_damping", damping_ratio=damping_ratio)
    half_width, height = positive("uplifted_damping", half_width=half_width, height=height)
    return ratio * np.hypot(half_width, height) / half_width
