"""The same shape of the same material, a number of times as large.

Lengths grow with the factor, areas and strengths with its square, masses with its cube. Stiffnesses
follow from a modulus of elasticity that stays, and dampers from damping ratios that stay.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from rockeom.integrator.schema import in_space
from rockeom.simulation.case import Case
from rockeom.structures.base import Structure
from rockeom.sweeps.case_numbers import of_structure, with_numbers

POWERS = {
    "m": 1, "kg": 3, "kg m2": 5, "N": 2, "N m": 3, "N/m": 1, "N s/m": 2, "N m/rad": 3,
    "N m s/rad": 4, "m/s2": 0, "rad": 0, "-": 0,
}  # fmt: skip
"""The power of the factor with which a number of a unit grows."""


@dataclass(frozen=True)
class Sized:
    """The function of a case with a factor of size as its last number."""

    case: Callable[..., Case]
    name: str = "times as large"

    def __call__(self, **values: Any) -> Case:
        factor = values.pop(self.name)
        return enlarged(self.case(**values), factor)


def can_be_enlarged(structure: Structure) -> bool:
    """Whether the units of all numbers of the structure say how they grow, and one grows."""
    if in_space(structure.module):
        return False  # drawings of three sizes are of the plane
    units = [number.unit for number in of_structure(structure).values()]
    return all(unit in POWERS for unit in units) and any(POWERS[unit] for unit in units)


def enlarged(case: Case, factor: Any) -> Case:
    """The case of a structure that is larger by a factor, and so are initial displacements."""
    numbers = [
        (number, number.value * _power(factor, POWERS[number.unit]))
        for number in of_structure(case.structure).values()
        if number.value is not None and POWERS[number.unit]
    ]
    units = dict(zip(case.structure.states, case.structure.module.STATE_UNITS, strict=True))
    start = case.initial and {
        name: x * factor if units[name] == "m" else x for name, x in case.initial.items()
    }
    return replace(with_numbers(case, numbers), initial=start)


def _power(x: Any, n: int) -> Any:
    """A power by products, which has the same bits in Python and on a page."""
    return math.prod([x] * n)
