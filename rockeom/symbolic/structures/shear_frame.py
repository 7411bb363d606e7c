"""A frame of any number of storeys that rocks on rigid ground."""

from typing import Any

from rockeom.symbolic import valid
from rockeom.symbolic.parts import superstructures
from rockeom.symbolic.parts.supports import standing
from rockeom.symbolic.registry import family


@family
def shear_frame(storeys: int, support: str = "pinned", **details: Any) -> Any:
    """Floors on a rigid base, springs and dampers between neighbours.

    support : what the base stands on, see `rockeom.symbolic.parts.supports`, and its details.
    """
    valid.counts("shear_frame", storeys=storeys)
    return standing(superstructures.shear_frame(storeys), support, **details)
