"""Strength of masonry walls that rock in their plane."""

from __future__ import annotations

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
    """Horizontal force at which a wall rocks on its crushed corner [N].

    axial_force N [N] at the base, the wall's weight counted in; length L and thickness t [m];
    shear_span H0, the height of zero moment above the base [m]; compressive_strength f_c [Pa];
    stress_block : height of the rectangle of stresses over f_c; any shapes, broadcast. With
    s0 = N/(L t)

        V = N L/(2 H0) (1 - s0/(0.85 f_c)),

    the moment N (L - a)/2 of a rigid wall without tension whose corner presses with 0.85 f_c on the
    length a = N/(0.85 f_c t). P-delta is no part of it.
    Sources: G. Magenes and G. M. Calvi, In-plane seismic response of brick masonry walls,
    Earthquake Eng. Struct. Dyn. 26 (1997) 1091-1112; EN 1998-3 (2005), C.4.2.1, which has 1.15
    for 1/0.85.

    Raises ValueError where the axial force alone crushes the wall.
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
