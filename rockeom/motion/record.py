"""A record as a reader returns it, and where a network has it from."""

from typing import NamedTuple

import numpy as np

from rockeom.motion.components import channel


class Origin(NamedTuple):
    """Station and earthquake of a record, and its direction, as the file of a network has them.

    component : direction as the file names it, such as "N28W". azimuth : clockwise from north
    [degrees]; None where the file gives none. stage : of processing, such as "corrected".
    """

    station: str
    event: str
    component: str
    azimuth: float | None = None
    stage: str = ""

    @property
    def recording(self) -> str:
        """Station, instrument and event, which the components of one recording have in common.

        Empty where the file names no station.
        """
        parts = self.station, channel(self.component), self.event
        return ", ".join(filter(None, parts)) if self.station else ""


class Record(NamedTuple):
    """Accelerations (n,) [m/s2] at times 0, dt, 2 dt ... [s], with name and source.

    is_vertical : whether the file says so, see `components`. origin : of a file of a network.
    """

    acceleration: np.ndarray
    dt: float
    name: str
    source: str
    is_vertical: bool = False
    origin: Origin | None = None

    @property
    def component(self) -> str:
        """Direction as the file names it; empty where it names none."""
        return "" if self.origin is None else self.origin.component

    @property
    def azimuth(self) -> float | None:
        """Azimuth, clockwise from north [degrees]; None where the file gives none."""
        return None if self.origin is None else self.origin.azimuth
