"""How near a motion came to overturning: theta/alpha, by the overturning angle of each side.

In space it is the tilt by that of the stability surface in the direction of the lean.
"""

import math
from typing import NamedTuple

import numpy as np

from rockeom.numbers.degrees import with_degrees
from rockeom.simulation.extremes import Extremes
from rockeom.structures.base import Structure
from rockeom.structures.slope import overturning_angles

RATIO = "rotation_ratio"
"""Name of theta/alpha among the quantities of a response."""


def describe_tilt(
    tilt: Extremes, direction: float, reserve: Extremes | None, towards: float
) -> str:
    """The largest tilt and the least reserve of a body in space, and the azimuths of both."""
    if not tilt.maximum > _NO_TILT:
        return "It did not tilt."
    text = f"Largest tilt: {with_degrees(tilt.maximum, 'rad')} towards {_in_degrees(direction)}"
    text += f" at {tilt.maximum_time:.4g} s"
    if reserve is None:
        return f"{text}."
    part = max(1.0 - reserve.minimum, 0.0)
    left = f"{100 * reserve.minimum:.3g} %" if part < 1.0 else "none"
    where = f", towards {_in_degrees(towards)}" if part else ""
    return f"{text}. Largest tilt/barrier: {part:.3g}{where}. Reserve: {left}."


_NO_TILT = 1e-12
"""[rad] What rounding leaves of the tilt of a body that stands, or slides."""


def _in_degrees(azimuth: float) -> str:
    return f"{round(math.degrees(azimuth), 1) + 0.0:g} degrees"


class Reserve(NamedTuple):
    """Largest theta/alpha of a motion.

    Parameters
    ----------
    ratio : float
        Ratio theta/alpha.
    side : str
        "left" or "right".
    time : float
        Time [s].
    angle : float
        Overturning angle of that side, in the unit of the rotation.
    """

    ratio: float
    side: str
    time: float
    angle: float

    @property
    def reserve(self) -> float:
        """1 - theta/alpha, the part of the overturning angle that was left; 0 where none was."""
        return max(1.0 - self.ratio, 0.0)

    def describe(self, unit: str) -> str:
        """Reserve in a sentence.

        Parameters
        ----------
        unit : str
            Unit of the rotation.

        Returns
        -------
        str
            Sentence.
        """
        angle = f"the overturning angle to the {self.side} is {with_degrees(self.angle, unit)}"
        left = f"{100 * self.reserve:.3g} %" if self.ratio < 1.0 else "none"
        return f"Largest theta/alpha: {self.ratio:.3g}; {angle}. Reserve: {left}."


def reserve_of(structure: Structure, rotation: Extremes, slope: float = 0.0) -> Reserve | None:
    """The reserve of a motion by the extremes of its rotation; None where there is no angle."""
    if (angles := overturning_angles(structure, slope)) is None:
        return None
    sides = (
        Reserve(max(size, 0.0) / angle if angle else math.inf, side, time, angle)
        for size, side, time, angle in (
            (-rotation.minimum, "left", rotation.minimum_time, angles[0]),
            (rotation.maximum, "right", rotation.maximum_time, angles[1]),
        )
    )
    nearest = max(sides, key=lambda one: (one.ratio, -one.angle))
    return nearest if math.isfinite(nearest.ratio) and math.isfinite(nearest.angle) else None


def rotation_ratio(structure: Structure, rotation: np.ndarray, slope: float = 0.0) -> np.ndarray:
    """Rotations (n,) over the overturning angle of their side, with their sign."""
    angles = overturning_angles(structure, slope)
    assert angles is not None
    return rotation / np.where(rotation < 0.0, *angles)
