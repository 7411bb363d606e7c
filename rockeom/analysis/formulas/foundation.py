"""Foundation mats that may lift: their springs, and the moment that they bear (thesis 2.4).

A mat is rigid and carries a weight at its centre. Rotations are small: a point at the distance x
from the centre line moves down by x times the rotation. The moment is that of the ground on the
mat; the overturning moment of the weight on a structure that leans (P-delta) is no part of it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import numbers, positive, require

# --- springs of a mat on an elastic half-space


@dataclass(frozen=True, eq=False)
class FoundationSprings:
    """Two springs with dampers in place of an elastic half-space under a mat; Table 2-2.

    Parameters
    ----------
    vertical_stiffness : ndarray
        Stiffness K_z of the mat on the half-space [N/m].
    vertical_damping : ndarray
        Coefficient C_z of the mat on the half-space [N s/m].
    half_spacing : ndarray
        Distance of each spring from the centre line [m].
    """

    vertical_stiffness: np.ndarray
    vertical_damping: np.ndarray
    half_spacing: np.ndarray

    @property
    def stiffness(self) -> np.ndarray:
        """Stiffness of each of the two springs, K_z/2 [N/m]."""
        return self.vertical_stiffness / 2

    @property
    def damping(self) -> np.ndarray:
        """Coefficient of each of the two dampers, C_z/2 [N s/m]."""
        return self.vertical_damping / 2

    @property
    def rotational_stiffness(self) -> np.ndarray:
        """Moment over rotation while both springs press [N m]."""
        return 2 * self.stiffness * self.half_spacing**2


def circular_mat(
    radius: ArrayLike, shear_modulus: ArrayLike, poisson_ratio: ArrayLike, density: ArrayLike
) -> FoundationSprings:
    """Springs of a circular mat on an elastic half-space; thesis Table 2-2.

    Parameters
    ----------
    radius : array_like
        Radius R of the mat [m].
    shear_modulus : array_like
        Shear modulus G of the ground [Pa].
    poisson_ratio : array_like
        Poisson's ratio nu of the ground.
    density : array_like
        Density rho of the ground [kg/m3].

    Returns
    -------
    FoundationSprings
        Springs and dampers, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and a Poisson's ratio outside [0, 0.5].

    Notes
    -----
    K_z = 4 G R/(1 - nu), C_z = 0.85 K_z R sqrt(rho/G). The springs stand at sqrt(2/3) R, where they
    have the half-space's rotational stiffness ``8 G R**3/(3 (1 - nu))``.

    References
    ----------
    Timoshenko and Goodier (1951), Richart et al. (1970), Yim and Chopra (1983).
    """
    where = "circular_mat"
    radius, modulus, density = positive(
        where, radius=radius, shear_modulus=shear_modulus, density=density
    )
    stiffness = 4 * modulus * radius / (1 - _poisson(where, poisson_ratio))
    damping = 0.85 * stiffness * radius * np.sqrt(density / modulus)
    return FoundationSprings(stiffness, damping, np.sqrt(2 / 3) * radius)


def rectangular_mat(
    half_width: ArrayLike,
    half_length: ArrayLike,
    shape_factor: ArrayLike,
    shear_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    density: ArrayLike,
) -> FoundationSprings:
    """Springs of a rectangular mat on an elastic half-space; thesis Table 2-2, put right.

    Parameters
    ----------
    half_width : array_like
        Half-width b, at right angles to the axis of rotation [m].
    half_length : array_like
        Half-length l, along the axis of rotation [m].
    shape_factor : array_like
        Factor beta_z, a chart of Richart et al. (1970) over the ratio of the sides.
    shear_modulus : array_like
        Shear modulus G of the ground [Pa].
    poisson_ratio : array_like
        Poisson's ratio nu of the ground.
    density : array_like
        Density rho of the ground [kg/m3].

    Returns
    -------
    FoundationSprings
        Springs and dampers, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and a Poisson's ratio outside [0, 0.5].

    Notes
    -----
    K_z = G beta_z sqrt(4 b l)/(1 - nu) and C_z = 13.6 b l sqrt(rho G)/(pi (1 - nu)), and the
    springs of K_z/2 each stand at b/sqrt(3): they have the rotational stiffness ``K_z b**2/3`` of
    the Winkler bed with the same K_z.

    The table has K_z B_f and C_z B_f for each spring, which have another dimension than the
    stiffness that is named with them. B_f and L_f are the whole sides in its K_z, but the halves in
    its C_z, which is that of the circle of equal area, and in its place of the springs.

    References
    ----------
    Barkan (1962), Richart et al. (1970), Yim and Chopra (1983).
    """
    where = "rectangular_mat"
    half_width, half_length, factor, modulus, density = positive(
        where,
        half_width=half_width,
        half_length=half_length,
        shape_factor=shape_factor,
        shear_modulus=shear_modulus,
        density=density,
    )
    rest = 1 - _poisson(where, poisson_ratio)
    stiffness = modulus / rest * factor * np.sqrt(4 * half_width * half_length)
    damping = 13.6 * half_width * half_length / (np.pi * rest) * np.sqrt(density * modulus)
    return FoundationSprings(stiffness, damping, half_width / np.sqrt(3))


@dataclass(frozen=True, eq=False)
class FootingStiffness:
    """Static stiffness of a rigid footing on an elastic half-space.

    Parameters
    ----------
    vertical : ndarray
        Vertical stiffness [N/m].
    rotational : ndarray
        Rotational stiffness, moment over rotation in the plane [N m].
    """

    vertical: np.ndarray
    rotational: np.ndarray


def rectangular_footing(
    half_width: ArrayLike,
    half_length: ArrayLike,
    shear_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
) -> FootingStiffness:
    """Static stiffness of a rigid rectangular footing at the surface of an elastic half-space.

    Parameters
    ----------
    half_width : array_like
        Half of the side in the plane in which the footing turns [m].
    half_length : array_like
        Half of the side at right angles to that plane [m].
    shear_modulus : array_like
        Shear modulus G of the ground at the strain of the earthquake [Pa].
    poisson_ratio : array_like
        Poisson's ratio nu of the ground.

    Returns
    -------
    FootingStiffness
        Vertical and rotational stiffness, in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and a Poisson's ratio outside [0, 0.5].

    Notes
    -----
    With B the lesser and L the greater of the half sides::

        K_z = G B/(1 - nu) (3.1 (L/B)**0.75 + 1.6)
        K_rot = G B**3/(1 - nu) (3.2 L/B + 0.8)            turning about its longer side
        K_rot = G B**3/(1 - nu) (3.73 (L/B)**2.4 + 0.27)   turning about its shorter side

    Embedment stiffens a footing, and layers and frequency change it: all are left out.

    References
    ----------
    A. Pais and E. Kausel, Approximate formulas for dynamic stiffnesses of rigid foundations, Soil
    Dyn. Earthq. Eng. 7 (1988) 213-227; NIST GCR 12-917-21 (2012), Table 2-2a. FEMA 356 (2000),
    Figure 4-4, and ASCE 41 have the same in the whole sides, with fewer digits.
    """
    where = "rectangular_footing"
    width, length, modulus = positive(
        where, half_width=half_width, half_length=half_length, shear_modulus=shear_modulus
    )
    rest = 1 - _poisson(where, poisson_ratio)
    b, ratio = np.minimum(width, length), np.maximum(width, length) / np.minimum(width, length)
    factor = np.where(width <= length, 3.2 * ratio + 0.8, 3.73 * ratio**2.4 + 0.27)
    return FootingStiffness(
        modulus * b / rest * (3.1 * ratio**0.75 + 1.6), modulus * b**3 / rest * factor
    )


def _poisson(where: str, value: ArrayLike) -> np.ndarray:
    (ratio,) = numbers(where, poisson_ratio=value)
    rule = "Poisson's ratio of the ground lies between 0 and 0.5"
    require((ratio >= 0) & (ratio <= 0.5), where, "poisson_ratio", ratio, rule)
    return ratio


def winkler_stiffness(vertical_stiffness: ArrayLike, half_width: ArrayLike):
    """Stiffness per unit width of the bed of springs with a given vertical stiffness, K_z/(2 b).

    Parameters
    ----------
    vertical_stiffness : array_like
        Vertical stiffness K_z of the mat [N/m].
    half_width : array_like
        Half-width b of the mat [m].

    Returns
    -------
    float or ndarray
        Stiffness of the bed per unit width [N/m2], in the shape of both arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    See Also
    --------
    winkler_stiffness_from_rotation : The bed with a given rotational stiffness.
    """
    stiffness, half_width = positive(
        "winkler_stiffness", vertical_stiffness=vertical_stiffness, half_width=half_width
    )
    return stiffness / (2 * half_width)


def winkler_stiffness_from_rotation(rotational_stiffness: ArrayLike, half_width: ArrayLike):
    """Stiffness per unit width of the bed of springs with a given rotational stiffness.

    Parameters
    ----------
    rotational_stiffness : array_like
        Rotational stiffness K of the mat [N m].
    half_width : array_like
        Half-width b of the mat [m].

    Returns
    -------
    float or ndarray
        Stiffness ``3 K/(2 b**3)`` of the bed per unit width [N/m2], in the shape of both arguments,
        broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    See Also
    --------
    winkler_stiffness : The bed with a given vertical stiffness.

    Notes
    -----
    For a half-space this is more than `winkler_stiffness` gives: no bed has both of its
    stiffnesses.

    References
    ----------
    Jennings and Bielak (1973).
    """
    stiffness, half_width = positive(
        "winkler_stiffness_from_rotation",
        rotational_stiffness=rotational_stiffness,
        half_width=half_width,
    )
    return 3 * stiffness / (2 * half_width**3)


# --- moment and rotation of the three interfaces


def rigid_moment(rotation: ArrayLike, weight: ArrayLike, half_width: ArrayLike):
    """Moment of a mat on rigid ground, W b sgn(rotation); thesis Figure 2-8.

    Parameters
    ----------
    rotation : array_like
        Rotation of the mat [rad].
    weight : array_like
        Weight W [N].
    half_width : array_like
        Half-width b of the mat [m].

    Returns
    -------
    float or ndarray
        Moment [N m], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a weight or a half-width that is not positive.

    Notes
    -----
    At rest the ground bears any moment up to W b; the 0 returned there is that of the weight alone.
    """
    (rotation,) = numbers("rigid_moment", rotation=rotation)
    weight, half_width = positive("rigid_moment", weight=weight, half_width=half_width)
    return weight * half_width * np.sign(rotation)


def two_spring_uplift_rotation(weight: ArrayLike, stiffness: ArrayLike, half_spacing: ArrayLike):
    """Rotation at which a mat lifts off one of two springs, W/(2 k d).

    Parameters
    ----------
    weight : array_like
        Weight W [N].
    stiffness : array_like
        Stiffness k of each spring [N/m].
    half_spacing : array_like
        Distance d of each spring from the centre line [m].

    Returns
    -------
    float or ndarray
        Rotation [rad], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.
    """
    weight, stiffness, half_spacing = positive(
        "two_spring_uplift_rotation", weight=weight, stiffness=stiffness, half_spacing=half_spacing
    )
    return weight / (2 * stiffness * half_spacing)


def two_spring_moment(
    rotation: ArrayLike, weight: ArrayLike, stiffness: ArrayLike, half_spacing: ArrayLike
):
    """Moment of a mat on two compression-only springs; thesis Figure 2-8.

    Parameters
    ----------
    rotation : array_like
        Rotation of the mat [rad].
    weight : array_like
        Weight W [N].
    stiffness : array_like
        Stiffness k of each spring [N/m].
    half_spacing : array_like
        Distance d of each spring from the centre line [m].

    Returns
    -------
    float or ndarray
        Moment [N m], in the shape of all arguments, broadcast: ``2 k d**2`` times the rotation
        until a spring is free, W d from there on.

    Raises
    ------
    ValueError
        For a weight, stiffness or spacing that is not positive.
    """
    (rotation,) = numbers("two_spring_moment", rotation=rotation)
    weight, stiffness, half_spacing = positive(
        "two_spring_moment", weight=weight, stiffness=stiffness, half_spacing=half_spacing
    )
    uplift = two_spring_uplift_rotation(weight, stiffness, half_spacing)
    return weight * half_spacing * np.clip(rotation / uplift, -1.0, 1.0)


def winkler_uplift_rotation(weight: ArrayLike, stiffness: ArrayLike, half_width: ArrayLike):
    """Rotation at which an edge lifts off a bed of springs.

    Parameters
    ----------
    weight : array_like
        Weight W [N].
    stiffness : array_like
        Stiffness k_w of the bed per unit width [N/m2].
    half_width : array_like
        Half-width b of the mat [m].

    Returns
    -------
    float or ndarray
        Rotation ``W/(2 k_w b**2)`` [rad], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For arguments that are not finite and positive, or whose shapes do not broadcast.

    Notes
    -----
    The moment is then W b/3, a third of the largest.
    """
    weight, stiffness, half_width = positive(
        "winkler_uplift_rotation", weight=weight, stiffness=stiffness, half_width=half_width
    )
    return weight / (2 * stiffness * half_width**2)


def winkler_moment(
    rotation: ArrayLike, weight: ArrayLike, stiffness: ArrayLike, half_width: ArrayLike
):
    """Moment of a mat on a bed of compression-only springs; thesis Figure 2-8.

    Parameters
    ----------
    rotation : array_like
        Rotation of the mat [rad].
    weight : array_like
        Weight W [N].
    stiffness : array_like
        Stiffness k_w of the bed per unit width [N/m2].
    half_width : array_like
        Half-width b of the mat [m].

    Returns
    -------
    float or ndarray
        Moment [N m], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For a weight, stiffness or half-width that is not positive.

    Notes
    -----
    The moment is W b/3 times rotation/uplift rotation until an edge lifts. From there on it is W b
    (1 - (2/3) sqrt(uplift rotation/rotation)): the part of the mat under pressure shrinks towards
    its edge.
    """
    (rotation,) = numbers("winkler_moment", rotation=rotation)
    weight, stiffness, half_width = positive(
        "winkler_moment", weight=weight, stiffness=stiffness, half_width=half_width
    )
    ratio = np.abs(rotation) / winkler_uplift_rotation(weight, stiffness, half_width)
    part = np.where(ratio <= 1, ratio / 3, 1 - 2 / (3 * np.sqrt(np.maximum(ratio, 1.0))))
    return weight * half_width * np.sign(rotation) * part
