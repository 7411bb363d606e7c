"""Flexible structure of two masses on rigid ground (thesis Model C, 5.3.3 and Appendix D)."""

from typing import Any

from rockeom.symbolic.parts.superstructures import MAY_VANISH, elastic_column
from rockeom.symbolic.parts.supports import pinned, standing
from rockeom.symbolic.registry import shipped


@shipped(place=9, may_vanish=MAY_VANISH)
def flexible_structure(support: str = "pinned", **details: Any) -> Any:
    """A superstructure on an elastic, damped column that stands on a rocking rigid base.

    Parameters
    ----------
    support : Support, optional
        Support of the base; rk.Pinned() on rigid ground if not given.
    restraint : sequence of Strap or Anchor, optional
        Restraints of the base, on feet of `Sliding`; the point of a strap moves with the base.
    loads : sequence of Push, optional
        Forces of time on the base, on feet of `Sliding`.

    Examples
    --------
    >>> import rockeom as rk
    >>> pier = rk.FlexibleStructure(
    ...     mass=200e3, height=10.0, inertia=0.0, base_mass=80e3, base_height=0.5,
    ...     base_inertia=60e3, half_width=2.5, stiffness=32e6, damping=250e3,
    ... )  # kg, m, kg m2, N/m, N s/m
    >>> pier.fixed_base().periods.round(3)  # s
    array([0.497])
    """
    if support != "pinned" or details:
        return standing(elastic_column(), support, **details)
    title = "Flexible structure on rigid ground (Model C)"
    sources = {"theta": "thesis 5-34, D-25", "u": "thesis 5-35, D-26"}
    return pinned(elastic_column(), title, "thesis 5-34, 5-35, D-1 to D-29", sources)
