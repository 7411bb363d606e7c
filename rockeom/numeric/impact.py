"""Laws of impact, each named by what it prescribes so that none can be taken for another."""

from __future__ import annotations

import inspect
import math
from dataclasses import dataclass
from typing import Any, Protocol

from rockeom.arguments import is_number, number, told
from rockeom.contract import AT_SPEED, IMPULSIVE, RATIO
from rockeom.many import mathematics


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
        return RATIO, mathematics.sqrt(self.r)


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


@dataclass(frozen=True)
class EnergyRatioAtSpeed:
    """Energy ratio r that depends on the speed at the impact, in straight pieces.

    pieces : of increasing speed, each (limit, r at no speed, slope [s/m]); r is theirs below the
        limit [m/s], which for the last one is infinite. At a limit the faster piece holds.
    height : of the point whose speed it is, above the base [m]. None: the height that the structure
        names, as walls do; without one the law is refused.

    Where r would exceed 1, an impact would give energy; such a motion ends as not finite.
    """

    pieces: tuple[tuple[float, float, float], ...]
    height: float | None = None

    def __post_init__(self) -> None:
        if not _are_pieces(self.pieces):
            raise TypeError(
                f"pieces of an energy ratio are {told(self.pieces)}: give three numbers for each, "
                "(limit [m/s], r at no speed, slope [s/m]), as ((math.inf, 0.865, 0.0441),)"
            )
        if self.height is not None:
            number("height of an energy ratio in pieces", self.height)
        limits = [limit for limit, _, _ in self.pieces]
        if not limits or limits[-1] != math.inf or limits != sorted(set(limits)):
            raise ValueError(
                f"energy ratio in pieces with the limits {limits} m/s: they must increase, and the "
                "last one be infinite"
            )
        start = 0.0
        for limit, r, slope in self.pieces:
            _check(f"energy ratio r at {start} m/s", r + slope * start)
            if limit < math.inf:
                _check(f"energy ratio r below {limit} m/s", r + slope * limit)
                start = limit
        if limits[0] <= 0 or (self.height is not None and not self.height > 0):
            raise ValueError("limits and the height of an energy ratio in pieces must be positive")

    @classmethod
    def equation_4_31(cls) -> EnergyRatioAtSpeed:
        """Thesis 4-31, of the equivalent oscillator of a controlled wall."""
        return cls(
            ((0.3, 0.85, 0.01 / 0.45), (0.47, 0.81, 0.0), (0.78, 0.852, 0.0), (math.inf, 0.95, 0.0))
        )

    @classmethod
    def equation_4_36(cls) -> EnergyRatioAtSpeed:
        """Thesis 4-36, of the simplified substitute gravity; as printed."""
        return cls(((math.inf, 0.865, 0.0441),))

    @classmethod
    def equation_4_38(cls) -> EnergyRatioAtSpeed:
        """Thesis 4-38, of the substitute gravity with a rotation centre that moves."""
        return cls(
            ((0.365, 0.445, 1.0), (0.47, 0.81, 0.0), (0.78, 0.85, 0.0), (math.inf, 0.94, 0.0))
        )

    def at(self, speed: float) -> float:
        """r at a speed [m/s], of either sign."""
        speed = abs(number("speed", speed))
        return next(r + slope * speed for limit, r, slope in self.pieces if speed < limit)

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        return AT_SPEED, math.nan

    def table(self, height: float | None, name: str) -> list[float]:
        """What the compiled loop reads behind the parameters: the pieces by the rate of rotation.

        height : the structure's own [m], or None.
        """
        lever = self.height if self.height is not None else height
        if lever is None:
            raise ValueError(
                f"the energy ratio depends on a speed, and {name} does not tell of which point: "
                "give EnergyRatioAtSpeed(..., height=...)"
            )
        rows = [(limit / lever, r, slope * lever) for limit, r, slope in self.pieces]
        return [*(number for row in rows for number in row), float(len(rows))]


_LAWS = (EnergyRatio, VelocityRatio, AngularMomentum, Impulsive, EnergyRatioAtSpeed)


def check_law(impact: Any) -> None:
    """Raise TypeError for what is no law of impact; a number could be either ratio."""
    if isinstance(impact, _LAWS):
        return
    try:  # a law of the caller's own; a path, too, has a method of that name
        inspect.signature(impact.resolve).bind(1.0, True, "name")
    except (AttributeError, TypeError, ValueError):
        r = impact if is_number(impact) else 0.8
        raise TypeError(
            f"impact is {told(impact)}: give a law, such as rk.EnergyRatio({r}) or "
            f"rk.VelocityRatio({r}), rk.AngularMomentum() or rk.Impulsive()"
        ) from None


def _are_pieces(pieces: Any) -> bool:
    try:
        rows = [tuple(piece) for piece in pieces]
    except TypeError:
        return False
    return all(len(row) == 3 and all(map(is_number, row)) for row in rows)


def _check(what: str, value: float) -> None:
    if not 0.0 <= number(what, value) <= 1.0:
        raise ValueError(f"{what} is {value}: it must lie between 0 (no rebound) and 1 (no loss)")
