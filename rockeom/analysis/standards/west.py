"""West's criterion, that of uplift by statics."""

from rockeom.analysis.formulas.uplift import uplift_acceleration
from rockeom.analysis.standards.check import Check, check_block, peak_acceleration
from rockeom.motion.scaling import Acceleration
from rockeom.structures.classes import RigidBlock


def west_uplift(block: RigidBlock, ground_acceleration: Acceleration) -> Check:
    """Uplift of a block by West's criterion, a_g = g b/h.

    Parameters
    ----------
    block : RigidBlock
        Block, with the centroid at the distance b from an edge and at the height h.
    ground_acceleration : float or str
        Peak ground acceleration a_g, a number [m/s2] or a text with its unit, "0.4 g".

    Returns
    -------
    Check
        Peak ground acceleration and that at which a foot lifts [m/s2].

    Raises
    ------
    InputError
        For another structure, and for an acceleration that is negative or not finite.

    Notes
    -----
    Domain: rigid level ground, horizontal shaking in one plane, friction above b/h. West proposed
    it as the criterion of overturning. By statics it is that of uplift; overturning needs more.

    References
    ----------
    Milne (1908), who quotes West.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom.analysis import standards
    >>> rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0)  # m
    >>> print(standards.west_uplift(rack, "0.4 g"))
    West: peak ground acceleration 3.92 m/s2, limit 2.94 m/s2: a foot lifts
    """
    check_block("west_uplift", block)
    demand = peak_acceleration("west_uplift", "ground_acceleration", ground_acceleration)
    capacity = float(uplift_acceleration(block.half_width, block.half_height, block.gravity))
    verdict = "a foot lifts" if demand >= capacity else "no foot lifts"
    source = "West, quoted by Milne (1908); statics"
    return Check("West", "peak ground acceleration", demand, capacity, "m/s2", verdict, source)
