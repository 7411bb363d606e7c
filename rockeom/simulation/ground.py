"""The ground of a case, its motions and its slope, as the equations take it."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rockeom.integrator.records import Motions
from rockeom.integrator.schema import ground_axes
from rockeom.motion import GroundMotion
from rockeom.motion.segments import END
from rockeom.motion.slope import SLOPE, seen_from, tables_at, tables_on, turned, weight_on
from rockeom.numbers.batch import Many
from rockeom.numbers.dual import Dual
from rockeom.structures.evaluation import gravity_of

STILL = np.empty((0, 7))
"""The table of ground that stands still, which all share."""
STILL.flags.writeable = False
COMPONENTS = Motions._fields
"""The components of the ground's motion, of which the loop takes tables."""
PARTS = {"horizontal": "motion"}
"""The name of the part of a case that is a motion, where it has another one."""
MOTIONS = tuple(PARTS.get(name, name) for name in COMPONENTS)
"""The parts of a case that are ground motions."""


@dataclass(frozen=True)
class Ground:
    """The ground of a case, on a slope [rad] where gravity [m/s2] is that of the structure.

    motions : by name, in the order of the equations. axes : those of the motions, see
    `rockeom.motion.slope`. On a slope all is along and normal to it, and what equations take as
    acceleration of the ground has the part of the weight in it. is_level : whether there is no
    slope; one of zero that has derivatives is one. azimuth [rad] : of the structure in space, along
    whose axes all is; None where it is not turned.
    """

    motions: Mapping[str, GroundMotion | None]
    slope: Any = 0.0
    axes: str = SLOPE
    gravity: Any = 0.0
    is_level: bool = True
    azimuth: Any = None

    @property
    def weight(self) -> tuple[Any, ...]:
        """Accelerations by which equations take the weight on the slope [m/s2]."""
        return (0.0,) * len(self.motions) if self.is_level else weight_on(self.slope, self.gravity)

    def shaking(self, t: Any) -> tuple[Any, ...]:
        """Accelerations of the ground itself at times (n,) or a number [m/s2]."""
        still = np.zeros(np.shape(t))
        shaking = [still if m is None else m.acceleration(t) for m in self.motions.values()]
        if self.azimuth is not None:
            return (*seen_from(self.azimuth, *shaking[:2]), *shaking[2:])
        level = self.is_level or self.axes == SLOPE
        return tuple(shaking) if level else turned(self.slope, *shaking)

    def accelerations(self, t: Any) -> tuple[Any, ...]:
        """Accelerations at times as equations take them [m/s2], with the part of the weight."""
        return tuple(a + part for a, part in zip(self.shaking(t), self.weight, strict=True))

    @cached_property
    def tables(self) -> Motions:
        """(m, 7) segments of all, as equations take them."""
        return self.tables_of(*self.level_tables.values())

    @property
    def level_tables(self) -> dict[str, np.ndarray]:
        """(m, 7) segments of the motions by themselves."""
        return {name: STILL if m is None else m.segments for name, m in self.motions.items()}

    def tables_of(self, *tables: np.ndarray) -> Motions:
        """The same for motions of these segments."""
        if not self.is_level:
            tables = tables_on(self.slope, self.axes, self.gravity, *tables)
        if self.azimuth is not None:
            tables = (*tables_at(self.azimuth, *tables[:2]), *tables[2:])
        still = dict.fromkeys(COMPONENTS, STILL)
        return Motions(**still | dict(zip(self.motions, tables, strict=True)))

    @property
    def quiet_from(self) -> float:
        """Time from which the ground stands still [s]."""
        return max(m.shaking_ends for m in self.motions.values() if m is not None)


def ground_of(case: Any) -> Ground:
    """The ground of a case or a response."""
    names = ground_axes(case.structure.module)
    motions = {name: getattr(case, PARTS.get(name, name)) for name in names}
    if _is_none(case.slope):
        azimuth = None if _is_none(case.azimuth) else case.azimuth
        return Ground(motions, axes=case.ground_axes, azimuth=azimuth)
    gravity = gravity_of(case.structure.module, case.structure.vector)
    return Ground(motions, case.slope, case.ground_axes, gravity, is_level=False)


def _is_none(angle: Any) -> bool:
    """Whether an angle turns nothing; one of zero that has derivatives does."""
    return not isinstance(angle, Dual | Many) and bool(angle == 0.0)


def rows_after(table: np.ndarray) -> np.ndarray:
    """Rows of a table behind its motion: the one without end on ground that slopes, or none."""
    return table[-1:] if len(table) and table[-1, END] == np.inf else STILL
