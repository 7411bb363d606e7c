"""ASCE 7-16, section 13.3: the force on the attachment of a component."""

import math

from rockeom.analysis.standards.check import Check, non_negative, peak_acceleration
from rockeom.motion.scaling import Acceleration
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import positive_number, require


def asce_7_attachment(
    weight: float,
    s_ds: Acceleration,
    *,
    amplification: float,
    response_modification: float,
    importance: float = 1.0,
    height_ratio: float = 0.0,
    strength: float = math.nan,
) -> Check:
    """Horizontal force on a component by ASCE 7-16, 13.3.

    Parameters
    ----------
    weight : float
        Weight of the component W_p [N].
    s_ds : float or str
        Design spectral acceleration at short periods S_DS, a number [m/s2] or a text with its unit,
        "1.0 g".
    amplification : float
        Component amplification factor a_p.
    response_modification : float
        Component response modification factor R_p.
    importance : float, optional
        Component importance factor I_p.
    height_ratio : float, optional
        Height z of the attachment over that of the roof h, between 0 and 1.
    strength : float, optional
        Horizontal strength of the attachment [N].

    Returns
    -------
    Check
        Force F_p and strength [N].

    Raises
    ------
    InputError
        For numbers that cannot be.

    Notes
    -----
    ``F_p = 0.4 a_p S_DS W_p (1 + 2 z/h)/(R_p/I_p)``, at least ``0.3 S_DS I_p W_p`` and at most
    ``1.6 S_DS I_p W_p``, with S_DS in g. Domain: a component that is attached. It does not
    say whether one that stands free falls.

    References
    ----------
    ASCE/SEI 7-16, 13.3.1.
    """
    where = "asce_7_attachment"
    w = positive_number("weight", weight, where)
    a_p = positive_number("amplification", amplification, where)
    r_p = positive_number("response_modification", response_modification, where)
    i_p = positive_number("importance", importance, where)
    z = non_negative(where, "height_ratio", height_ratio)
    require(z <= 1.0, where, "height_ratio", z, "give at most 1, that of the roof")
    short = peak_acceleration(where, "s_ds", s_ds) / STANDARD_GRAVITY
    force = 0.4 * a_p * short * w * (1.0 + 2.0 * z) / (r_p / i_p)
    force = min(max(force, 0.3 * short * i_p * w), 1.6 * short * i_p * w)
    verdict = "the force to resist"
    if not math.isnan(strength):
        holds = force <= non_negative(where, "strength", strength)
        verdict = "the attachment holds" if holds else "the attachment does not hold"
    source = "ASCE 7-16, 13.3.1"
    return Check("ASCE 7", "force on the attachment", force, float(strength), "N", verdict, source)
