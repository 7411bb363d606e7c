"""Elastic spectrum of NZS 1170.5:2004: shapes by site class, and the factor near a fault.

The standard was not at hand: its branches, those of its commentary, the limit of Z R and the factor
near a fault are as github.com/Agent6-6-6/NZS1170.5-Seismic-Coefficient-functions has them.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rockeom.motion.units import STANDARD_GRAVITY

LARGEST_HAZARD = 0.7
"""Limit of Z R."""
NO_NEAR_FAULT = 0.75
"""Return period factor R up to which a fault does not count."""
_PERIODS, _LARGEST = (1.5, 4.0, 5.0), (1.0, 1.6, 1.72)
"""Factor at a fault, 0.24 T + 0.64 and 0.12 T + 1.12 between these periods [s]."""
_NEAR, _FAR = 2e3, 20e3
"""Distances of a fault up to which the factor is full, and from which there is none [m]."""
_WITH_1_5 = math.nextafter(1.5, 2.0)


class SiteClass(NamedTuple):
    """Spectral shape factor Ch(T) of modal analysis.

    start + rise T up to 0.1 s, a plateau, power/T**0.75 from the corner to the end, velocity/T up
    to 3 s, displacement/T**2 [s].
    """

    start: float
    rise: float
    plateau: float
    corner: float
    power: float
    velocity: float
    displacement: float
    end: float = _WITH_1_5

    def shape(self, t: np.ndarray) -> np.ndarray:
        """Ch at periods [s], of their shape."""
        late = np.maximum(t, 0.1)  # divides by no zero
        return np.select(
            [t < 0.1, t < self.corner, t < self.end, t < 3.0],
            [
                self.start + self.rise * t,
                np.full_like(t, self.plateau),
                np.minimum(self.plateau, self.power / late**0.75),
                self.velocity / late,
            ],
            self.displacement / late**2,
        )


_ROCK = SiteClass(1.0, 13.5, 2.35, 0.3, 1.6 * 0.5**0.75, 1.05, 3.15)
SITE_CLASSES = {
    "A": _ROCK,
    "B": _ROCK,
    "C": SiteClass(1.33, 16.0, 2.93, 0.3, 2.0 * 0.5**0.75, 1.32, 3.96),
    "D": SiteClass(1.12, 18.8, 3.0, 0.56, 2.4 * 0.75**0.75, 2.14, 6.42),
    "E": SiteClass(1.12, 18.8, 3.0, 1.0, 3.0, 3.32, 9.96, end=1.5),
}


@dataclass(frozen=True)
class Coefficient:
    """C(T) = Ch(T) Z R N(T, D) times g [m/s2].

    hazard : Z R. near : part of the factor at a fault, between 0 and 1.
    """

    site: SiteClass
    hazard: float
    near: float

    def __call__(self, t: np.ndarray) -> np.ndarray:
        factor = 1.0 + self.near * (np.interp(t, _PERIODS, _LARGEST) - 1.0)
        return np.asarray(STANDARD_GRAVITY * self.hazard * self.site.shape(t) * factor)


def coefficient(site: str, hazard: float, return_factor: float, distance: float) -> Coefficient:
    """C(T) of a site class at a distance [m] from a fault, with Z R as the limit allows."""
    near = min(max((_FAR - distance) / (_FAR - _NEAR), 0.0), 1.0)
    limited = min(hazard * return_factor, LARGEST_HAZARD)
    return Coefficient(SITE_CLASSES[site], limited, near if return_factor > NO_NEAR_FAULT else 0.0)
