"""Forces of the ground on a rocking block, from its motion; thesis section 3.2.3.

theta > 0 is clockwise, about the right foot; horizontal to the right and vertical up are positive.
R is the distance from a foot to the centroid, alpha the angle of that line from the vertical.
`RigidBlock.reactions` gives the same forces from the state alone; these serve where the motion was
measured. They are finite between impacts, and do not contain the impact itself.
"""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import side_of, slenderness
from rockeom.analysis.formulas.restitution import gravitational_energy
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import numbers, positive, require

RECTANGLE = 0.75
"""m R**2/I_o of a homogeneous rectangle."""


def centroid_acceleration(
    theta: ArrayLike,
    theta_dot: ArrayLike,
    theta_ddot: ArrayLike,
    *,
    alpha: ArrayLike,
    radius: ArrayLike,
    ground_acceleration: ArrayLike = 0.0,
    side: ArrayLike | None = None,
):
    """Absolute acceleration of the centroid of a rocking block; thesis 3-5 to 3-7.

    Parameters
    ----------
    theta : array_like
        Rotation, positive to the right [rad].
    theta_dot : array_like
        Angular velocity [rad/s].
    theta_ddot : array_like
        Angular acceleration [rad/s2].
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : array_like
        Distance R from an edge to the centroid [m].
    ground_acceleration : array_like, optional
        Horizontal acceleration of the ground [m/s2].
    side : array_like, optional
        1 on the right foot, -1 on the left one; needed only where theta is zero.

    Returns
    -------
    horizontal : float or ndarray
        Horizontal acceleration [m/s2], in the shape of all arguments, broadcast.
    vertical : float or ndarray
        Vertical acceleration, upwards [m/s2].

    Raises
    ------
    ValueError
        Where theta is zero and no side is given, or the side contradicts theta.
    """
    where = "centroid_acceleration"
    theta, rate, second, ground = numbers(
        where,
        theta=theta,
        theta_dot=theta_dot,
        theta_ddot=theta_ddot,
        ground_acceleration=ground_acceleration,
    )
    (radius,) = positive(where, radius=radius)
    s = side_of(where, theta, side)
    lean = slenderness(where, alpha) - np.abs(theta)
    towards, along = radius * rate**2, radius * second  # centripetal, tangential
    horizontal = ground + s * towards * np.sin(lean) + along * np.cos(lean)  # 3-6
    vertical = -towards * np.cos(lean) + s * along * np.sin(lean)  # 3-7
    return horizontal, vertical


def block_reactions(
    theta: ArrayLike,
    theta_dot: ArrayLike,
    theta_ddot: ArrayLike,
    *,
    mass: ArrayLike,
    alpha: ArrayLike,
    radius: ArrayLike,
    ground_acceleration: ArrayLike = 0.0,
    gravity: ArrayLike = STANDARD_GRAVITY,
    side: ArrayLike | None = None,
):
    """Forces of the ground on a rocking block; thesis 3-8 and 3-9.

    Parameters
    ----------
    theta : array_like
        Rotation, positive to the right [rad].
    theta_dot : array_like
        Angular velocity [rad/s].
    theta_ddot : array_like
        Angular acceleration [rad/s2].
    mass : array_like
        Mass [kg].
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : array_like
        Distance R from an edge to the centroid [m].
    ground_acceleration : array_like, optional
        Horizontal acceleration of the ground [m/s2].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].
    side : array_like, optional
        1 on the right foot, -1 on the left one; needed only where theta is zero.

    Returns
    -------
    horizontal : float or ndarray
        Horizontal force [N], in the shape of all arguments, broadcast.
    vertical : float or ndarray
        Vertical force [N]. Where it is negative the foot would have left the ground.

    Raises
    ------
    ValueError
        Where theta is zero and no side is given, or the side contradicts theta.
    """
    mass, gravity = positive("block_reactions", mass=mass, gravity=gravity)
    horizontal, vertical = centroid_acceleration(
        theta,
        theta_dot,
        theta_ddot,
        alpha=alpha,
        radius=radius,
        ground_acceleration=ground_acceleration,
        side=side,
    )
    return mass * horizontal, mass * (gravity + vertical)


def impact_speed(
    theta_0: ArrayLike,
    *,
    alpha: ArrayLike,
    radius: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
    radius_ratio: ArrayLike = RECTANGLE,
):
    """Angular velocity at the impact of a block released at rest; thesis 3-13.

    Parameters
    ----------
    theta_0 : array_like
        Rotation at the release, either sign, at most alpha [rad]; at alpha the result is 3-13, the
        largest speed that free rocking can have.
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : array_like
        Distance R from an edge to the centroid [m].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].
    radius_ratio : array_like, optional
        Ratio m R**2/I_o; the default is that of a homogeneous rectangle.

    Returns
    -------
    float or ndarray
        Angular velocity, positive [rad/s], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        Beyond alpha, where a released block falls over.
    """
    where = "impact_speed"
    alpha = slenderness(where, alpha)
    (theta_0,) = numbers(where, theta_0=theta_0)
    rule = "beyond alpha a released block falls over: give a smaller rotation, in radians"
    require(np.abs(theta_0) <= alpha, where, "theta_0", theta_0, rule)
    energy = gravitational_energy(theta_0, mass=1.0, radius=radius, alpha=alpha, gravity=gravity)
    return np.sqrt(2 * energy * _radius_ratio(where, radius_ratio)) / radius  # I_o = R**2/ratio


def acceleration_at_impact(
    side: ArrayLike,
    *,
    alpha: ArrayLike,
    radius: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
    radius_ratio: ArrayLike = RECTANGLE,
    slender: bool = False,
):
    """Angular acceleration of a free block upright on one foot; thesis 3-10.

    Parameters
    ----------
    side : array_like
        1 where the block stands on its right foot, -1 on its left one.
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : array_like
        Distance R from an edge to the centroid [m].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].
    radius_ratio : array_like, optional
        Ratio m R**2/I_o; the default is that of a homogeneous rectangle.
    slender : bool, optional
        Write alpha for sin(alpha), as thesis 3-10 does; 0.7 % too much for 0.2 rad.

    Returns
    -------
    float or ndarray
        Angular acceleration [rad/s2], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and a side other than 1 and -1.
    """
    where = "acceleration_at_impact"
    alpha = slenderness(where, alpha)
    radius, gravity = positive(where, radius=radius, gravity=gravity)
    s = side_of(where, np.zeros(()), side)
    arm = alpha if slender else np.sin(alpha)
    return -s * _radius_ratio(where, radius_ratio) * gravity / radius * arm


def block_reactions_at_impact(
    theta_dot: ArrayLike,
    side: ArrayLike,
    *,
    mass: ArrayLike,
    alpha: ArrayLike,
    radius: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
    radius_ratio: ArrayLike = RECTANGLE,
    slender: bool = False,
):
    """Forces of the ground just before or after an impact; thesis 3-11 and 3-12.

    Parameters
    ----------
    theta_dot : array_like
        Angular velocity [rad/s]; zero gives the limits 3-14 and 3-15, between which the force
        chatters as rocking dies out.
    side : array_like
        1 where the block stands on its right foot, -1 on its left one.
    mass : array_like
        Mass [kg].
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : array_like
        Distance R from an edge to the centroid [m].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].
    radius_ratio : array_like, optional
        Ratio m R**2/I_o; the default is that of a homogeneous rectangle.
    slender : bool, optional
        Write alpha for sin(alpha), as thesis 3-10 does.

    Returns
    -------
    horizontal : float or ndarray
        Horizontal force [N], in the shape of all arguments, broadcast.
    vertical : float or ndarray
        Vertical force [N].

    Raises
    ------
    ValueError
        For numbers that are not positive, and a side other than 1 and -1.

    Notes
    -----
    The last term of 3-12 is printed with a sgn(theta) that cancels against that of 3-10; it is left
    out here, as 3-15 does.
    """
    (rate,) = numbers("block_reactions_at_impact", theta_dot=theta_dot)
    (side,) = numbers("block_reactions_at_impact", side=side)
    acceleration = acceleration_at_impact(
        side, alpha=alpha, radius=radius, gravity=gravity, radius_ratio=radius_ratio,
        slender=slender,
    )  # fmt: skip
    return block_reactions(
        0.0, rate, acceleration, mass=mass, alpha=alpha, radius=radius, gravity=gravity, side=side
    )


def _radius_ratio(where: str, value: ArrayLike) -> np.ndarray:
    (ratio,) = positive(where, radius_ratio=value)
    rule = "m R**2/I_o is at most 1, that of a point mass, and 3/4 for a homogeneous rectangle"
    require(ratio <= 1, where, "radius_ratio", ratio, rule)
    return ratio
