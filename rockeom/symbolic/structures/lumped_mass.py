"""Rigid structure of two lumped masses on rigid ground (thesis Model A, 5.3.1)."""

from typing import Any

from rockeom.symbolic.parts.superstructures import MAY_VANISH, rigid
from rockeom.symbolic.parts.supports import pinned, standing
from rockeom.symbolic.registry import shipped


@shipped(place=5, may_vanish=MAY_VANISH)
def lumped_mass_structure(support: str = "pinned", **details: Any) -> Any:
    """A rigid superstructure and a base, both lumped masses that rock about two fixed pivots.

    Parameters
    ----------
    support : Support, optional
        Support of the base; rk.Pinned() on rigid ground if not given.
    restraint : sequence of Strap or Anchor, optional
        Restraints of the base, on feet of `Sliding`; the point of a strap moves with the base.
    loads : sequence of Push, optional
        Forces of time on the base, on feet of `Sliding`.
    """
    if support != "pinned" or details:
        return standing(rigid(), support, **details)
    title = "Rigid lumped-mass structure on rigid ground (Model A)"
    sources = {"theta": "thesis 5-11", "impact": "thesis 5-12, 5-13", "energy_ratio": "thesis 5-14"}
    return pinned(rigid(), title, "thesis 5-8 to 5-14", sources)
