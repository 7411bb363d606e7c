"""Rotation, stiffness and damping coefficient of a model from measured quantities."""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import not_negative, numbers, positive, require

# --- the column on a fixed base


def stiffness_from_period(mass: ArrayLike, period: ArrayLike):
    """Lateral stiffness of a mass that vibrates on a fixed base, 4 pi^2 m/T^2; thesis 5-1.

    Parameters
    ----------
    mass : array_like
        Mass m [kg].
    period : array_like
        Period T [s].

    Returns
    -------
    float or ndarray
        Stiffness [N/m], in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.
    """
    mass, period = positive("stiffness_from_period", mass=mass, period=period)
    return mass * (2 * np.pi / period) ** 2


def viscous_coefficient(damping_ratio: ArrayLike, mass: ArrayLike, stiffness: ArrayLike):
    """Coefficient of the viscous damper, 2 xi sqrt(m k); thesis 5-36.

    Parameters
    ----------
    damping_ratio : array_like
        Damping ratio xi.
    mass : array_like
        Mass m [kg].
    stiffness : array_like
        Stiffness k [N/m].

    Returns
    -------
    float or ndarray
        Coefficient [N s/m], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.
    """
    (ratio,) = not_negative("viscous_coefficient", damping_ratio=damping_ratio)
    mass, stiffness = positive("viscous_coefficient", mass=mass, stiffness=stiffness)
    return 2 * ratio * np.sqrt(mass * stiffness)


# --- the rotation of a rigid structure about its feet


def rotation_from_displacement(displacement: ArrayLike, half_width: ArrayLike, height: ArrayLike):
    """Rotation of a rigid structure from the displacement of one of its points; thesis 5-2.

    Parameters
    ----------
    displacement : array_like
        Horizontal displacement of a point of the centreline, either sign [m].
    half_width : array_like
        Distance from the centreline to the pivot [m].
    height : array_like
        Height of the point above the feet [m].

    Returns
    -------
    float or ndarray
        Rotation [rad], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a displacement that no rotation about the foot reaches.
    """
    return _rotation("rotation_from_displacement", displacement, half_width, height)


def displacement_from_rotation(rotation: ArrayLike, half_width: ArrayLike, height: ArrayLike):
    """Displacement that a rotation gives, the inverse of thesis 5-2.

    Parameters
    ----------
    rotation : array_like
        Rotation, either sign [rad].
    half_width : array_like
        Distance from the centreline to the pivot [m].
    height : array_like
        Height of the point of the centreline above the feet [m].

    Returns
    -------
    float or ndarray
        Horizontal displacement of the point [m], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a half-width or a height that is not positive.
    """
    where = "displacement_from_rotation"
    (rotation,) = numbers(where, rotation=rotation)
    half_width, height = positive(where, half_width=half_width, height=height)
    half = rotation / 2
    # B - R sin(alpha - |theta|), without cancellation
    return 2 * np.sin(half) * (height * np.cos(half) + half_width * np.sin(np.abs(half)))


def _rotation(where: str, displacement: ArrayLike, half_width: ArrayLike, height: ArrayLike):
    (displacement,) = numbers(where, displacement=displacement)
    (half_width,) = not_negative(where, half_width=half_width)
    (height,) = positive(where, height=height)
    size, radius = np.abs(displacement), np.hypot(half_width, height)
    rule = (
        "no rotation about the foot displaces the point by more than half_width + "
        "hypot(half_width, height); give metres"
    )
    require(size <= half_width + radius, where, "displacement", displacement, rule)
    alpha = np.arctan2(half_width, height)
    lean = np.arcsin(np.clip((half_width - size) / radius, -1.0, 1.0))
    # alpha - lean, of which half the sine is known without cancellation
    half = np.arcsin(np.clip(size / (2 * radius * np.cos((alpha + lean) / 2)), 0.0, 1.0))
    return 2 * np.copysign(half, displacement)


# --- the column on a rubber pad, whose centre of rotation moves


def rotation_centre(
    displacement: ArrayLike,
    *,
    reach: ArrayLike = 0.2201,
    slope: ArrayLike = 127.6,
    base_width: ArrayLike = 0.6,
):
    """Distance of the centre of rotation from the left edge of the base; thesis 5-5.

    Parameters
    ----------
    displacement : array_like
        Displacement of the point of measurement, either sign [m].
    reach : array_like, optional
        Reach of the centre to either side [m].
    slope : array_like, optional
        Slope of the hyperbolic tangent [1/m].
    base_width : array_like, optional
        Width of the base [m].

    Returns
    -------
    float or ndarray
        Distance, reach tanh(slope displacement) + base_width/2 [m], in the shape of all arguments,
        broadcast.

    Raises
    ------
    ValueError
        Where the centre would pass the edge of the base.

    Notes
    -----
    The default values were fitted to one test, run 2 of McManus (1980): a steel column on soft
    rubber, displacements of up to 0.029 m at a height of 1.056 m.
    """
    where = "rotation_centre"
    (displacement,) = numbers(where, displacement=displacement)
    slope, base_width = positive(where, slope=slope, base_width=base_width)
    (reach,) = not_negative(where, reach=reach)
    rule = "the centre would pass the edge of the base: give at most base_width/2"
    require(reach <= base_width / 2, where, "reach", reach, rule)
    return reach * np.tanh(slope * displacement) + base_width / 2


def rotation_about_moving_centre(
    displacement: ArrayLike,
    centre: ArrayLike,
    height: ArrayLike,
    base_width: ArrayLike = 0.6,
):
    """Rotation of a structure about a centre that moves along its base; thesis 5-6.

    Parameters
    ----------
    displacement : array_like
        Horizontal displacement of a point of the centreline [m].
    centre : array_like
        Distance of the centre from the left edge of the base, such as `rotation_centre` gives [m].
    height : array_like
        Height of the point above the feet [m].
    base_width : array_like, optional
        Width of the base [m]; 0.6 is that of the column of McManus (1980).

    Returns
    -------
    float or ndarray
        Rotation [rad], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a centre outside the base, and a displacement that no rotation reaches.

    Notes
    -----
    This is 5-2 with half_width = base_width/2 - min(x, y), x and y = base_width - x the distances
    to both edges: the present centre counts as the pivot of the whole rotation.
    """
    where = "rotation_about_moving_centre"
    (centre,) = numbers(where, centre=centre)
    (base_width,) = positive(where, base_width=base_width)
    rule = "the centre of rotation lies between the edges, from 0 to base_width"
    require((centre >= 0) & (centre <= base_width), where, "centre", centre, rule)
    half_width = np.abs(centre - base_width / 2)
    return _rotation(where, displacement, half_width, height)
