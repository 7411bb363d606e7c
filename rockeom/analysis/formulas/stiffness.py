"""Stiffness of columns, from their material and their section."""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import not_negative, positive, require


def cantilever_stiffness(
    youngs_modulus: ArrayLike,
    second_moment: ArrayLike,
    length: ArrayLike,
    shear_flexibility: ArrayLike = 0.0,
):
    """Force over displacement at the free end of a clamped column, ``3 E I/L**3``.

    Parameters
    ----------
    youngs_modulus : array_like
        Young's modulus E [Pa].
    second_moment : array_like
        Second moment of area I [m4].
    length : array_like
        Length L [m].
    shear_flexibility : array_like, optional
        Flexibility 1/(G A_s) in shear [1/N], zero for slender columns. With it the stiffness is
        ``1/(L**3/(3 E I) + L/(G A_s))``.

    Returns
    -------
    float or ndarray
        Stiffness [N/m], in the shape of all arguments, broadcast.

    Raises
    ------
    ValueError
        For numbers that are not positive, and a negative shear flexibility.

    Notes
    -----
    A column that both ends clamp, a storey of a frame with stiff beams, has four times ``3 E
    I/L**3``.

    References
    ----------
    S. P. Timoshenko and J. M. Gere, Mechanics of Materials, chapter 9.

    Examples
    --------
    >>> from rockeom.analysis.formulas import cantilever_stiffness
    >>> float(cantilever_stiffness(30e9, 0.6**4 / 12, 6.0))  # concrete, 0.6 m by 0.6 m; N/m
    4500000.0
    """
    where = "cantilever_stiffness"
    modulus, moment, length = positive(
        where, youngs_modulus=youngs_modulus, second_moment=second_moment, length=length
    )
    (shear,) = not_negative(where, shear_flexibility=shear_flexibility)
    rule = "give the modulus in Pa, the second moment of area in m4 and the length in m"
    stiffness = 1 / (length**3 / (3 * modulus * moment) + length * shear)
    require(np.isfinite(stiffness), where, "second_moment", moment, rule)
    return stiffness
