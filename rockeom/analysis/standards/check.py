"""Result of a check, and the arguments that checks share."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockeom.analysis.design.displacement_based import modified_spectrum
from rockeom.analysis.dynamics.spectra import Spectrum, response_spectrum
from rockeom.motion import DesignSpectrum, GroundMotion
from rockeom.motion.units import acceleration
from rockeom.numbers.checks import InputError, InputTypeError, finite_number
from rockeom.structures.classes import RigidBlock

__all__ = ["Check"]

Shaking = GroundMotion | Spectrum | DesignSpectrum
"""A motion, a displacement [m] of period [s] and damping ratio, or a spectrum for 5 %."""


@dataclass(frozen=True)
class Check:
    """Result of a check of a code; it prints as a sentence.

    Parameters
    ----------
    name : str
        Name of the check.
    quantity : str
        Quantity that the check compares.
    demand : float
        Demand, in `unit`; NaN where the check has no answer.
    capacity : float
        Capacity, in `unit`; NaN where none was stated.
    unit : str
        Unit of both: "m/s2", "m/s", "m" or "N".
    verdict : str
        Verdict of the check, in words.
    source : str
        Source, with the parts that are second-hand.
    """

    name: str
    quantity: str
    demand: float
    capacity: float
    unit: str
    verdict: str
    source: str

    @property
    def ratio(self) -> float:
        """Demand over capacity; NaN without one of them."""
        return self.demand / self.capacity

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        limit = "" if np.isnan(self.capacity) else f", limit {self.capacity:.3g}{unit}"
        return f"{self.name}: {self.quantity} {self.demand:.3g}{unit}{limit}: {self.verdict}"


def check_block(where: str, block: Any) -> None:
    """Raise InputTypeError for anything but a rigid block."""
    if not isinstance(block, RigidBlock):
        raise InputTypeError("block", block, where).give(
            "a rk.RigidBlock, such as rk.RigidBlock.from_dimensions(width=0.6, height=2.0)"
        )


def inertia_per_mass(block: RigidBlock) -> float:
    """I_o/m about an edge [m2]."""
    return float(block.gravity * block.radius / block.frequency_parameter**2)


def peak_acceleration(where: str, name: str, value: float | str) -> float:
    """An acceleration of zero or more [m/s2], a number or a text with its unit."""
    return non_negative(where, name, acceleration(name, value))


def non_negative(where: str, name: str, value: float) -> float:
    """A number of zero or more; raises InputError for another."""
    x = finite_number(name, value, where)
    if x < 0.0:
        raise InputError(name, x, where).give("zero or a positive number, in SI units")
    return x


def spectral_displacement(shaking: Shaking, period: float, damping_ratio: float) -> float:
    """Displacement [m] at a period [s]; a design spectrum of another damping is modified.

    Raises InputTypeError for another shaking, and InputError for a function that gives none.
    """
    if isinstance(shaking, GroundMotion):
        return float(response_spectrum(shaking, period, damping_ratio).displacement[0])
    if isinstance(shaking, DesignSpectrum):
        if shaking.damping_ratio == damping_ratio:
            return float(shaking.displacement(period))
        return float(modified_spectrum(shaking)(period, damping_ratio))
    if not callable(shaking):
        raise InputTypeError("shaking", shaking).give(
            "a GroundMotion, a DesignSpectrum, or a function of period and damping ratio"
        )
    displacement = float(shaking(period, damping_ratio))
    if not (np.isfinite(displacement) and displacement >= 0.0):
        raise InputError("shaking").wrong(
            f"gives {displacement:g} m at {period:.4g} s: give a function that gives displacements"
        )
    return displacement


def spectral_acceleration(shaking: Shaking, period: float, damping_ratio: float) -> float:
    """Pseudo-acceleration [m/s2] at a period [s]."""
    return spectral_displacement(shaking, period, damping_ratio) * (2.0 * np.pi / period) ** 2
