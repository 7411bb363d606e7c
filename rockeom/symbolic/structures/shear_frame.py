"""A frame of any number of storeys that rocks on rigid ground."""

from __future__ import annotations

from rockeom.symbolic import valid
from rockeom.symbolic.model import RockingModel
from rockeom.symbolic.parts import superstructures
from rockeom.symbolic.parts.supports import pinned
from rockeom.symbolic.registry import family


@family
def shear_frame(storeys: int) -> RockingModel:
    """Floors on a rocking rigid base, springs and dampers between neighbours."""
    valid.counts("shear_frame", storeys=storeys)
    return pinned(superstructures.shear_frame(storeys))
