"""Restitution: ratios r of kinetic energies after and before an impact, predicted and measured.

The literature calls r as well as e = sqrt(r), the ratio of angular velocities, "coefficient of
restitution". Here a name says which it is; all of thesis 2-6, 3-3, 3-16, 5-4, 5-14 are r.

These are the thesis's formulas for blocks and for two lumped masses. Tests compare the derived
impacts and energies with them, so that they are independent of the derivation, and the energies are
accurate at any small rotation. For any other structure `Impacts` and `FreeVibration.restitution`
find r of a measured record by the derived energies, and `velocity_ratio` of the structure is the
square root of the predicted r.
"""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import slenderness
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, not_negative, numbers, positive, require

# --- energies and velocities


def velocity_ratio_from_energy_ratio(energy_ratio: ArrayLike):
    """Velocity ratio e = sqrt(r) of an impact, angular velocities after and before it; thesis 2-4.

    Parameters
    ----------
    energy_ratio : array_like
        Energy ratio r of the impact, any shape.

    Returns
    -------
    float or ndarray
        Velocity ratio e, in the shape of the argument.

    Raises
    ------
    ValueError
        Outside 0 (no rebound) to 1 (no loss).

    Examples
    --------
    >>> from rockeom import analysis
    >>> round(float(analysis.formulas.velocity_ratio_from_energy_ratio(0.81)), 6)  # e of r
    0.9
    """
    (r,) = numbers("velocity_ratio_from_energy_ratio", energy_ratio=energy_ratio)
    require((r >= 0) & (r <= 1), "velocity_ratio_from_energy_ratio", "energy_ratio", r, _RANGE)
    return np.sqrt(r)


def energy_ratio_from_velocity_ratio(velocity_ratio: ArrayLike):
    """Energy ratio r = e^2 of an impact, kinetic energies after and before it; thesis 2-4.

    Parameters
    ----------
    velocity_ratio : array_like
        Velocity ratio e of the impact, any shape.

    Returns
    -------
    float or ndarray
        Energy ratio r, in the shape of the argument.

    Raises
    ------
    ValueError
        Outside 0 (no rebound) to 1 (no loss).

    Examples
    --------
    >>> from rockeom import analysis
    >>> round(float(analysis.formulas.energy_ratio_from_velocity_ratio(0.9)), 6)  # r of e
    0.81
    """
    (e,) = numbers("energy_ratio_from_velocity_ratio", velocity_ratio=velocity_ratio)
    require((e >= 0) & (e <= 1), "energy_ratio_from_velocity_ratio", "velocity_ratio", e, _RANGE)
    return np.square(e)


# --- predicted: angular momentum about the new pivot is conserved


def energy_ratio_of_block(
    alpha: ArrayLike,
    *,
    inertia: ArrayLike | None = None,
    mass: ArrayLike | None = None,
    radius: ArrayLike | None = None,
):
    """Energy ratio r of a symmetric block that rolls from edge to edge; thesis 2-6, Housner (1963).

    Parameters
    ----------
    alpha : array_like
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    inertia : array_like, optional
        Moment of inertia I about the centroid [kg m2]; with it `mass` and `radius`. Without the
        three, those of a homogeneous rectangle: ``I = m R**2/3``.
    mass : array_like, optional
        Mass m [kg].
    radius : array_like, optional
        Distance R from an edge to the centroid [m].

    Returns
    -------
    float or ndarray
        Energy ratio ``(1 - (m R**2/I_o)(1 - cos(2 alpha)))**2`` with ``I_o = I + m R**2``, in the
        shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        Where only some of the three are given, and for a block so squat that the angular velocity
        after the impact would be reversed: it does not roll on, both edges stay down.

    Examples
    --------
    >>> from rockeom import analysis
    >>> round(float(analysis.formulas.energy_ratio_of_block(0.2)), 4)  # r
    0.8851
    """
    where = "energy_ratio_of_block"
    alpha = slenderness(where, alpha)
    properties = {"inertia": inertia, "mass": mass, "radius": radius}
    missing = [name for name, value in properties.items() if value is None]
    if inertia is None or mass is None or radius is None:
        if len(missing) < 3:
            raise InputError(missing[0], of=where).says(
                f"{', '.join(missing)} is missing: give inertia, mass and radius together, or none "
                "of them for a homogeneous rectangle"
            )
        radius_ratio = np.asarray(0.75)  # m R**2/I_o
    else:
        (inertia,) = not_negative(where, inertia=inertia)
        mass, radius = positive(where, mass=mass, radius=radius)
        radius_ratio = mass * radius**2 / (inertia + mass * radius**2)
    e = 1 - 2 * radius_ratio * np.sin(alpha) ** 2
    require(e >= 0, where, "alpha", alpha, _SQUAT)
    return e**2


def energy_ratio_of_lumped_mass(
    *,
    mass: ArrayLike,
    height: ArrayLike,
    inertia: ArrayLike,
    base_mass: ArrayLike,
    base_height: ArrayLike,
    base_inertia: ArrayLike,
    half_width: ArrayLike,
):
    """Energy ratio r of a rigid structure of two lumped masses on two feet; thesis 5-14.

    The names are those of `LumpedMassStructure`.

    Parameters
    ----------
    mass : array_like
        Upper mass [kg].
    height : array_like
        Height of the upper mass above the ground [m].
    inertia : array_like
        Moment of inertia of the upper mass about its own centroid [kg m2].
    base_mass : array_like
        Mass of the base [kg].
    base_height : array_like
        Height of the mass of the base above the ground [m].
    base_inertia : array_like
        Moment of inertia of the base about its own centroid [kg m2].
    half_width : array_like
        Half of the distance between the feet [m].

    Returns
    -------
    float or ndarray
        Energy ratio r, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a structure so squat that the angular velocity would be reversed: it does not roll on,
        both feet stay down.
    """
    where = "energy_ratio_of_lumped_mass"
    mass, height, half_width = positive(where, mass=mass, height=height, half_width=half_width)
    inertia, base_mass, base_height, base_inertia = not_negative(
        where,
        inertia=inertia,
        base_mass=base_mass,
        base_height=base_height,
        base_inertia=base_inertia,
    )
    upright = mass * height**2 + inertia + base_mass * base_height**2 + base_inertia
    across = (mass + base_mass) * half_width**2
    require(upright >= across, where, "half_width", half_width, _SQUAT)
    return ((upright - across) / (upright + across)) ** 2


# --- measured: successive peaks of free rocking


def gravitational_energy(
    theta: ArrayLike,
    *,
    mass: ArrayLike,
    radius: ArrayLike,
    alpha: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Potential energy of a tilted mass, above that upright; thesis 3-2, a term of 5-3.

    Parameters
    ----------
    theta : array_like
        Rotation, either sign [rad].
    mass : array_like
        Mass [kg].
    radius : array_like
        Length R of the line from the pivot to the mass [m].
    alpha : array_like
        Angle of that line from the vertical, upright [rad].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Energy [J], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a mass or a radius that is not positive, and an alpha outside (0, pi/2).
    """
    where = "gravitational_energy"
    (theta,) = numbers(where, theta=theta)
    mass, radius, gravity = positive(where, mass=mass, radius=radius, gravity=gravity)
    return mass * gravity * radius * _rise(np.abs(theta), slenderness(where, alpha))


def spring_energy(theta: ArrayLike, rotational_stiffness: ArrayLike):
    """Energy of a rotational spring; thesis 3-4.

    Parameters
    ----------
    theta : array_like
        Rotation [rad].
    rotational_stiffness : array_like
        Stiffness of the spring [N m/rad].

    Returns
    -------
    float or ndarray
        Energy [J], in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite, or whose shapes do not broadcast.
    """
    (theta,) = numbers("spring_energy", theta=theta)
    (stiffness,) = not_negative("spring_energy", rotational_stiffness=rotational_stiffness)
    return stiffness * theta**2 / 2


def energy_ratios_from_peaks(
    peaks: ArrayLike,
    alpha: ArrayLike,
    *,
    rotational_stiffness: float = 0.0,
    mass: ArrayLike | None = None,
    radius: ArrayLike | None = None,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Energy ratio r of each impact between successive peaks of a rocking block; thesis 3-3 and
    3-16.

    Parameters
    ----------
    peaks : array_like
        Peak rotations (..., n), one on each side in turn [rad]; the signs do not count.
    alpha : array_like
        Slenderness [rad]; for several blocks (..., 1), as the others.
    rotational_stiffness : float, optional
        Stiffness of an elastic rotational spring [N m/rad], thesis 3-16; with it `mass` and
        `radius`. Without it thesis 3-3, for which neither counts.
    mass : array_like, optional
        Mass [kg].
    radius : array_like, optional
        Distance R from an edge to the centroid [m].
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    ndarray
        Energy ratios (..., n - 1). A measured r exceeds 1 where a peak is higher than the one
        before.

    Raises
    ------
    ValueError
        For fewer than two peaks, and for a peak that is zero or at or beyond alpha.

    See Also
    --------
    rockeom.analysis.identification.Impacts.of_peaks : For any other structure, with intervals.
    """
    where = "energy_ratios_from_peaks"
    alpha = slenderness(where, alpha)
    sizes = _sizes(where, peaks, alpha)
    energies = _rise(sizes, alpha)
    if rotational_stiffness:
        if mass is None or radius is None:
            raise InputError("mass", of=where).says(
                "mass or radius is missing: with a rotational_stiffness the energy of gravity "
                "counts in joules, so give both"
            )
        energies = gravitational_energy(
            sizes, mass=mass, radius=radius, alpha=alpha, gravity=gravity
        ) + spring_energy(sizes, rotational_stiffness)
    return energies[..., 1:] / energies[..., :-1]


def energy_ratios_from_peaks_of_lumped_mass(
    peaks: ArrayLike,
    *,
    mass: ArrayLike,
    height: ArrayLike,
    base_mass: ArrayLike,
    base_height: ArrayLike,
    half_width: ArrayLike,
):
    """Energy ratio r of each impact between peaks of a structure of two lumped masses; thesis 5-4.

    Parameters
    ----------
    peaks : array_like
        Peak rotations (..., n), one on each side in turn [rad]; the signs do not count.
    mass : array_like
        Upper mass [kg].
    height : array_like
        Height of the upper mass above the ground [m].
    base_mass : array_like
        Mass of the base [kg].
    base_height : array_like
        Height of the mass of the base above the ground [m].
    half_width : array_like
        Half of the distance between the feet [m].

    Returns
    -------
    ndarray
        Energy ratios (..., n - 1).

    Raises
    ------
    ValueError
        For fewer than two peaks, and for a peak that is zero or at or beyond the rotation at which
        the structure balances.
    """
    where = "energy_ratios_from_peaks_of_lumped_mass"
    mass, height, half_width = positive(where, mass=mass, height=height, half_width=half_width)
    base_mass, base_height = not_negative(where, base_mass=base_mass, base_height=base_height)
    total = mass + base_mass
    centroid = (mass * height + base_mass * base_height) / total
    # the weight of both masses acts at their centroid
    alpha = np.arctan2(half_width, centroid)
    energies = _rise(_sizes(where, peaks, alpha), alpha)
    return energies[..., 1:] / energies[..., :-1]


def _rise(size, alpha):
    """cos(alpha - size) - cos(alpha), without cancellation."""
    return 2 * np.sin(alpha - size / 2) * np.sin(size / 2)


def _sizes(where: str, peaks: ArrayLike, alpha) -> np.ndarray:
    """Sizes of the peaks, (..., n), checked."""
    (peaks,) = numbers(where, peaks=peaks)
    if peaks.ndim == 0 or peaks.shape[-1] < 2:
        raise InputError("peaks", peaks, where).give("at least two successive peaks")
    sizes = np.abs(peaks)
    rule = f"a free structure turns back between 0 and its balance at {alpha} rad; give radians"
    require((sizes > 0) & (sizes < alpha), where, "peaks", peaks, rule)
    return sizes


_RANGE = "it must lie between 0 (no rebound) and 1 (no loss)"
_SQUAT = (
    "so squat that an impact would reverse the rotation: it does not roll from edge to edge; "
    "make it more slender"
)
