"""Laws of impact, each named by what it prescribes so that none can be taken for another."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

RATIO, IMPULSIVE = 0, 1  # as in the generated modules


class ImpactLaw(Protocol):
    """What an impact does to the velocities."""

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        """(law, ratio) for a structure whose rigid velocity ratio is given."""
        ...


@dataclass(frozen=True)
class EnergyRatio:
    """Prescribed ratio r of the rocking motion's kinetic energies after and before an impact.

    The rate of rotation is multiplied by sqrt(r), other rates are left (thesis 2-4).
    """

    r: float

    def __post_init__(self) -> None:
        _check("energy ratio r", self.r)

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        return RATIO, math.sqrt(self.r)


@dataclass(frozen=True)
class VelocityRatio:
    """Prescribed ratio e of the rates of rotation after and before an impact; e = sqrt(r)."""

    e: float

    def __post_init__(self) -> None:
        _check("velocity ratio e", self.e)

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        return RATIO, self.e


@dataclass(frozen=True)
class AngularMomentum:
    """Angular momentum of the structure, taken as rigid, about the new pivot is conserved.

    Housner (1963), thesis 2-6 and 5-14. For a flexible structure this is the thesis's rule:
    the deformation's rate is left unchanged. `Impulsive` is the exact law there.
    """

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        return RATIO, velocity_ratio


@dataclass(frozen=True)
class Impulsive:
    """The impulsive form of Lagrange's equations: exact for a flexible structure as well.

    Where the old foot cannot lift, full contact follows.
    """

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        if not has_impulsive:
            raise ValueError(
                f"{name} has no impulsive law: its masses do not tell the impulses; "
                "use AngularMomentum(), EnergyRatio(r) or VelocityRatio(e)"
            )
        return IMPULSIVE, math.nan


def _check(what: str, value: float) -> None:
    if not 0.0 <= value <= 1.0:
        raise ValueError(f"{what} is {value}: it must lie between 0 (no rebound) and 1 (no loss)")
