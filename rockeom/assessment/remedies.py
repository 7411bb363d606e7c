"""Changes that help a structure to stand, each with its effect."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any, NamedTuple

from rockeom.assessment.statics import Statics, statics_of
from rockeom.assessment.trials import Conditions, Trials, scaled
from rockeom.structures.base import Structure

WIDER = 0.05
"""Width that a wider base gains, half of it on each side [m]."""
LOWER = 0.1
"""Part of its height by which a centroid is lowered."""


class Remedy(NamedTuple):
    """A changed structure under the same conditions."""

    change: str
    statics: Statics
    trials: Trials


def remedies(structure: Structure, conditions: Conditions, level: float) -> tuple[Remedy, ...]:
    """A wider base and a lower centroid, where the structure has such numbers."""
    return tuple(
        Remedy(change, statics_of(changed), scaled(changed, conditions, level))
        for change, changed in _changed(structure)
    )


def _changed(structure: Structure) -> Iterator[tuple[str, Structure]]:
    """Changed structures of the same mass and inertia, each with the change in words."""
    if not hasattr(structure, "__dataclass_fields__"):
        return
    same: Any = structure
    names = structure.defaults()
    kept = {"inertia": structure.parameters()["inertia"]} if "inertia" in names else {}
    if "half_width" in names:
        wider = dataclasses.replace(same, half_width=same.half_width + WIDER / 2, **kept)
        yield f"a base {100 * WIDER:g} cm wider, half of it on each side", wider
    for name in {"half_height", "height"} & names.keys():
        lower = {name: (1 - LOWER) * getattr(structure, name)}
        yield f"a centroid {100 * LOWER:g} % lower", dataclasses.replace(same, **lower, **kept)
