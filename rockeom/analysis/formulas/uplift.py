"""Uplift of a structure, and its vibration after it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import not_negative, positive


def uplift_acceleration(
    half_width: ArrayLike, half_height: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """Ground acceleration at which a rigid block starts to rock, g B/H [m/s2]; thesis 2-1.

    half_width, half_height [m]; gravity [m/s2]; any shapes, broadcast. Milne and West proposed it
    as the criterion of overturning; it is that of uplift, and overturning needs more.
    Source: Milne (1908).
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
    """Deformation u_c at which a mass on an elastic column lifts a foot, g B/(omega**2 H) [m].

    angular_frequency of the column on a fixed base [rad/s]; half_width, height of the mass [m];
    gravity [m/s2]; any shapes, broadcast. The base has no mass. The critical static deformation
    of thesis 2.4.1, Chopra and Yim (1985).
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
    """Angular frequency of the column's vibration while a foot is lifted [rad/s]; thesis 2-8a.

    angular_frequency of the column on a fixed base [rad/s]; half_width B, height H of the mass
    [m]; any shapes, broadcast. Returns omega R/B, R = hypot(B, H): the column then bends against
    the inertia of the rotation, not against the ground. Massless base, small rotations.
    Source: Chopra and Yim (1985). Chapter 2 writes B for the width as well; here it is the half.
    """
    (omega,) = positive("uplifted_frequency", angular_frequency=angular_frequency)
    half_width, height = positive("uplifted_frequency", half_width=half_width, height=height)
    return omega * np.hypot(half_width, height) / half_width


def uplifted_damping(damping_ratio: ArrayLike, half_width: ArrayLike, height: ArrayLike):
    """Damping ratio of the column's vibration while a foot is lifted; thesis 2-8b.

    damping_ratio of the column on a fixed base; half_width, height of the mass [m]; any shapes,
    broadcast. Returns xi R/B, which may exceed 1: then the column does not vibrate.
    It depends on the slenderness H/B alone, not on the size.
    """
    (ratio,) = not_negative("uplifted_damping", damping_ratio=damping_ratio)
    half_width, height = positive("uplifted_damping", half_width=half_width, height=height)
    return ratio * np.hypot(half_width, height) / half_width
