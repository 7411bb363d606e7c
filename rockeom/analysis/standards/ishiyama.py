"""Ishiyama's criteria: a peak acceleration and a peak velocity that are both needed."""

import math

from rockeom.analysis.standards.check import Check, check_block, non_negative, peak_acceleration
from rockeom.motion.scaling import Acceleration
from rockeom.structures.classes import RigidBlock

_VELOCITY = 1.0
"""Velocity that overturns, times sqrt(H)/B [m**0.5/s]: 10 in centimetres."""


def ishiyama_overturning(
    block: RigidBlock, ground_acceleration: Acceleration, ground_velocity: float
) -> Check:
    """Overturning of a block by Ishiyama's criteria, which both have to hold.

    Parameters
    ----------
    block : RigidBlock
        Block, of the width B and the height H.
    ground_acceleration : float or str
        Peak ground acceleration A, a number [m/s2] or a text with its unit, "0.4 g".
    ground_velocity : float
        Peak ground velocity V [m/s].

    Returns
    -------
    Check
        The criterion with the lesser ratio, acceleration [m/s2] or velocity [m/s]: it decides.

    Raises
    ------
    InputError
        For another structure, and for numbers that are negative or not finite.

    Notes
    -----
    The block falls if ``A >= g B/H`` and ``V >= 10 B/sqrt(H)`` with B and H in cm and V in cm/s,
    which is ``V >= B/sqrt(H)`` in m and m/s. B is twice the distance of the centroid from an edge,
    H twice its height.

    The text of the paper was not at hand: both criteria are second-hand, and so is their domain.
    The velocity is 0.39 times that of `mallet_overturning` for a slender rectangle.

    References
    ----------
    Ishiyama (1982), second-hand.
    """
    where = "ishiyama_overturning"
    check_block(where, block)
    shaking = peak_acceleration(where, "ground_acceleration", ground_acceleration)
    velocity = non_negative(where, "ground_velocity", ground_velocity)
    width, height = 2.0 * float(block.half_width), 2.0 * float(block.half_height)
    criteria = [
        ("peak ground acceleration", shaking, block.gravity * width / height, "m/s2"),
        ("peak ground velocity", velocity, _VELOCITY * width / math.sqrt(height), "m/s"),
    ]
    quantity, demand, capacity, unit = min(criteria, key=lambda row: row[1] / row[2])
    verdict = "overturns" if demand >= capacity else "stands"
    source = "Ishiyama (1982), second-hand: both criteria must hold, the one shown decides"
    return Check("Ishiyama", quantity, demand, capacity, unit, verdict, source)
