"""Mallet's criterion: a sudden velocity of the ground overturns the block."""

import math

from rockeom.analysis.standards.check import Check, check_block, inertia_per_mass, non_negative
from rockeom.structures.classes import RigidBlock


def mallet_overturning(block: RigidBlock, ground_velocity: float) -> Check:
    """Overturning of a block by a sudden velocity of the ground, Mallet's criterion.

    Parameters
    ----------
    block : RigidBlock
        Block, with the centroid at the distance R from an edge and at the height h.
    ground_velocity : float
        Velocity that the ground has at once [m/s], such as the peak ground velocity.

    Returns
    -------
    Check
        Velocity of the ground and the least one that overturns [m/s].

    Raises
    ------
    InputError
        For another structure, and for a velocity that is negative or not finite.

    Notes
    -----
    ``V**2 = 2 g R (1 - cos(alpha)) I_o/(m h**2)``, and for a homogeneous rectangle ``(8/3) g R (1 -
    cos(alpha))/cos(alpha)**2``. Derived here, not copied: the angular momentum about the edge is
    kept, ``m h V = I_o theta'``, and the energy after it, ``I_o theta'**2/2``, lifts the centroid
    above the edge, ``m g R (1 - cos(alpha))``.

    Domain: one sudden velocity from rest that stays, no impact after it. The peak velocity of an
    earthquake is neither sudden nor lasting.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom.analysis import standards
    >>> rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0)  # m
    >>> print(standards.mallet_overturning(rack, 0.5))
    Mallet: velocity of the ground 0.5 m/s, limit 1.12 m/s: stands
    """
    check_block("mallet_overturning", block)
    demand = non_negative("mallet_overturning", "ground_velocity", ground_velocity)
    rise = block.radius * (1.0 - math.cos(block.alpha))
    inertia = inertia_per_mass(block)
    capacity = math.sqrt(2.0 * block.gravity * rise * inertia) / float(block.half_height)
    verdict = "overturns" if demand >= capacity else "stands"
    source = "Mallet; derived from angular momentum and energy"
    return Check("Mallet", "velocity of the ground", demand, capacity, "m/s", verdict, source)
