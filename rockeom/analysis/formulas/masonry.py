"""Strength of masonry walls that rock in their plane."""

from numpy.typing import ArrayLike

from rockeom.numbers.checks import numbers, positive, require


def rocking_strength(
    axial_force: ArrayLike,
    length: ArrayLike,
    shear_span: ArrayLike,
    thickness: ArrayLike,
    compressive_strength: ArrayLike,
    stress_block: ArrayLike = 0.85,
):
    """Horizontal force at which a wall rocks on its crushed corner.

    Parameters
    ----------
    axial_force : array_like
        Axial force N at the base, the wall's weight counted in [N].
    length : array_like
        Length L of the wall [m].
    shear_span : array_like
        Height H0 of zero moment above the base [m].
    thickness : array_like
        Thickness t of the wall [m].
    compressive_strength : array_like
        Compressive strength f_c [Pa].
    stress_block : array_like, optional
        Height of the rectangle of stresses over f_c.

    Returns
    -------
    float or ndarray
        Force V at the height of zero moment [N], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and where the axial force alone crushes the wall.

    Notes
    -----
    With s0 = N/(L t)::

        V = N L/(2 H0) (1 - s0/(0.85 f_c)),

    the moment N (L - a)/2 of a rigid wall without tension whose corner presses with 0.85 f_c on the
    length a = N/(0.85 f_c t). P-delta is no part of it.

    References
    ----------
    G. Magenes and G. M. Calvi, In-plane seismic response of brick masonry walls, Earthquake Eng.
    Struct. Dyn. 26 (1997) 1091-1112; EN 1998-3 (2005), C.4.2.1, which has 1.15 for 1/0.85.

    Examples
    --------
    >>> from rockeom import analysis
    >>> round(float(analysis.formulas.rocking_strength(104.8e3, 1.0, 1.325, 0.2, 73e6)))  # N
    39213
    """
    where = "rocking_strength"
    force, length, span, thickness, strength, block = positive(
        where, axial_force=axial_force, length=length, shear_span=shear_span, thickness=thickness,
        compressive_strength=compressive_strength, stress_block=stress_block,
    )  # fmt: skip
    (crushed,) = numbers(where, crushed=force / (length * thickness * block * strength))
    rule = "it is more than the wall bears, stress_block compressive_strength length thickness"
    require(crushed < 1, where, "axial_force", force, rule)
    return force * length / (2 * span) * (1 - crushed)
