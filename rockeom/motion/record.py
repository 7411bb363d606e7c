"""A record as a reader returns it."""

from typing import NamedTuple

import numpy as np


class Record(NamedTuple):
    """Accelerations (n,) [m/s2] at times 0, dt, 2 dt ... [s], with name and source.

    is_vertical : whether the file says so, see `components`. component, azimuth : as a file of
    several components has them, the azimuth clockwise from north [degrees].
    """

    acceleration: np.ndarray
    dt: float
    name: str
    source: str
    is_vertical: bool = False
    component: str = ""
    azimuth: float | None = None
