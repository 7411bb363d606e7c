"""The ground of a case, its motions and its slope, as the equations take it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rockeom.motion import GroundMotion
from rockeom.motion.segments import END
from rockeom.motion.slope import SLOPE, tables_on, turned, weight_on
from rockeom.structures.evaluation import gravity_of

STILL = np.empty((0, 7))
"""The table of ground that stands still, which all share."""
STILL.flags.writeable = False


@dataclass(frozen=True)
class Ground:
    """The ground motions of a case, on a slope [rad] where gravity [m/s2] is that of the structure.

    axes : those of the motions, see `rockeom.motion.slope`. On a slope all is along and normal to
    it, and what equations take as acceleration of the ground has the part of the weight in it.
    is_level : whether there is no slope; one of zero that has derivatives is one.
    """

    horizontal: GroundMotion
    vertical: GroundMotion | None
    slope: Any = 0.0
    axes: str = SLOPE
    gravity: Any = 0.0
    is_level: bool = True

    @property
    def weight(self) -> tuple[Any, Any]:
        """(along, normal) accelerations by which equations take the weight on the slope [m/s2]."""
        return (0.0, 0.0) if self.is_level else weight_on(self.slope, self.gravity)

    def shaking(self, t: Any) -> tuple[Any, Any]:
        """Accelerations of the ground itself at times (n,) or a number [m/s2]."""
        across = self.horizontal.acceleration(t)
        up = np.zeros(np.shape(t)) if self.vertical is None else self.vertical.acceleration(t)
        level = self.is_level or self.axes == SLOPE
        return (across, up) if level else turned(self.slope, across, up)

    def accelerations(self, t: Any) -> tuple[Any, Any]:
        """Accelerations at times as equations take them [m/s2], with the part of the weight."""
        (along, normal), (across, up) = self.weight, self.shaking(t)
        return across + along, up + normal

    @cached_property
    def tables(self) -> tuple[np.ndarray, np.ndarray]:
        """(m, 7) segments of both, as equations take them."""
        return self.tables_of(*self.level_tables)

    @property
    def level_tables(self) -> list[np.ndarray]:
        """(m, 7) segments of both motions by themselves."""
        return [STILL if m is None else m.segments for m in self.motions]

    def tables_of(self, *tables: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The same for motions of these segments."""
        if self.is_level:
            return tables[0], tables[1]
        return tables_on(self.slope, self.axes, self.gravity, *tables)

    @property
    def motions(self) -> tuple[GroundMotion, GroundMotion | None]:
        return self.horizontal, self.vertical

    @property
    def quiet_from(self) -> float:
        """Time from which the ground stands still [s]."""
        return max(m.shaking_ends for m in self.motions if m is not None)


def ground_of(case: Any) -> Ground:
    """The ground of a case or a response."""
    motions = case.motion, case.vertical
    if type(case.slope) is float and case.slope == 0.0:
        return Ground(*motions, axes=case.ground_axes)
    gravity = gravity_of(case.structure.module, case.structure.vector)
    return Ground(*motions, case.slope, case.ground_axes, gravity, is_level=False)


def rows_after(table: np.ndarray) -> np.ndarray:
    """Rows of a table behind its motion: the one without end on ground that slopes, or none."""
    return table[-1:] if len(table) and table[-1, END] == np.inf else STILL
