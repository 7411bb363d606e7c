"""One motion of one structure: what `simulate` is asked, and the same as numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rockeom.arguments import number, told
from rockeom.motion import GroundMotion
from rockeom.motion.segments import C1, END, KIND, LINEAR, START
from rockeom.numeric.impact import ImpactLaw
from rockeom.numeric.structures import Structure, check_states

STILL = np.empty((0, 7))
"""The table of ground that stands still, which all share."""
STILL.flags.writeable = False


class Problem(NamedTuple):
    """A case as the compiled loop takes it.

    contact : number of the contact state at the start; y0 (N,) the state there.
    vector : the parameters; table : what a law of impact adds to them; law, ratio : of the
        impacts; fallen : bound of the rotation.
    horizontal, vertical : tables (m, 7) of the ground's motion; end [s];
    quiet_from : when the ground has come to stand still [s].
    """

    contact: int
    y0: np.ndarray
    vector: np.ndarray
    table: list[float]
    law: int
    ratio: float
    fallen: float
    horizontal: np.ndarray
    vertical: np.ndarray
    end: float
    quiet_from: float

    def p(self, width: int = 0) -> np.ndarray:
        """The parameters with the table behind them, which is read from its end.

        width : of the widest table of several cases, so that all have rows of one length.
        """
        if not (self.table or width):
            return self.vector
        return np.concatenate([self.vector, np.zeros(max(width - len(self.table), 0)), self.table])


@dataclass(frozen=True)
class Case:
    """A structure, its ground motion and start; the arguments are those of `simulate`.

    Raises TypeError for what is no structure, no ground motion or no mapping of states.
    """

    structure: Structure
    motion: GroundMotion
    impact: ImpactLaw | None = None
    initial: Mapping[str, float] | None = None
    duration: float | None = None
    vertical: GroundMotion | None = None
    phase: str | None = None

    def __post_init__(self) -> None:
        if isinstance(self.structure, GroundMotion) and isinstance(self.motion, Structure):
            raise TypeError("structure and motion are swapped: the structure comes first")
        if not isinstance(self.structure, Structure):
            raise TypeError(
                f"structure is {told(self.structure)}: give a structure, such as "
                "rk.RigidBlock(half_width=0.1, half_height=0.4) or rk.structure(model, ...)"
            )
        _check_motion("motion", self.motion)
        if self.vertical is not None:
            _check_motion("vertical", self.vertical)
        if self.initial is not None:
            check_states("initial", self.initial, self.structure)

    def problem(self) -> Problem:
        """The case in numbers; raises ValueError for a state or a duration that cannot be."""
        structure, motion = self.structure, self.motion
        y0 = structure.state({} if self.initial is None else self.initial)
        rotation = y0[structure.module.ROTATION]
        fallen = structure.overturning_rotation
        if abs(rotation) >= fallen:
            raise ValueError(
                f"initial {structure.states[structure.module.ROTATION]} is {rotation}: the "
                f"structure lies on the ground from {fallen:.6g} on; start below"
            )
        end = motion.duration if self.duration is None else number("duration", self.duration)
        if not (math.isfinite(end) and end > 0):
            raise ValueError(f"duration is {end} s: it must be finite and positive")
        law, ratio = structure.law(self.impact)
        moves = rotation or y0[structure.module.ROTATION_RATE]
        quiet = max(m.shaking_ends for m in (motion, self.vertical) if m is not None)
        if math.isclose(quiet, end, rel_tol=1e-12):
            quiet = end  # a duration that is a difference of others is so but for rounding
        known = moves or structure.rocks_on_rigid_ground or self.phase is not None
        return Problem(
            contact=structure.contact(y0, self.phase, 0.0 if known else self._about_to_turn(y0)),
            y0=y0,
            vector=structure.vector,
            table=structure.impact_table(self.impact),
            law=law,
            ratio=ratio,
            fallen=fallen,
            horizontal=_table(motion),
            vertical=_table(self.vertical),
            end=end,
            quiet_from=quiet,
        )

    def _about_to_turn(self, y0: np.ndarray) -> float:
        """Sign of the rotation to come from upright and at rest, by the equations; 0 if none is.

        Weight or springs may turn a structure, too, that shaking does not. Those of both sides are
        added: what only one of them has is its support. Where nothing turns it yet, the first push
        of the ground will.
        """
        structure, m = self.structure, self.structure.module
        pushes = _pushes(self.motion)
        lift = 0.0 if self.vertical is None else _pushes(self.vertical, 1)[0]
        turn, rate = 0.0, np.zeros(len(y0))
        for side in (-1.0, 1.0):
            contact = structure.contact(y0, None, side)
            m.rates(contact, y0, structure.vector, pushes[0], lift, rate)
            turn += float(rate[m.ROTATION_RATE])
        first = pushes[pushes != 0.0][:1].sum()
        return float(np.sign(turn) or -np.sign(first))


def _check_motion(name: str, motion: Any) -> None:
    if not isinstance(motion, GroundMotion):
        raise TypeError(
            f"{name} is {told(motion)}: give a ground motion, such as "
            "GroundMotion.from_array(values, dt) of accelerations, GroundMotion.read(path) of a "
            "file, or GroundMotion.none(duration) of no shaking"
        )


def _pushes(motion: GroundMotion, laws: int | None = None) -> np.ndarray:
    """The ground acceleration of the first laws, a thousandth of the law's own time behind a start.

    Neither at the start, where a sine is zero, nor in its middle, where it may be so again.
    laws : how many; all if not given.
    """
    start, end, kind, rate = motion.segments[:laws, [START, END, KIND, C1]].T
    curved = (kind != LINEAR) & (rate != 0.0)
    own = np.minimum(end - start, 1.0 / np.where(curved, np.abs(rate), 1e-9))
    return motion.acceleration(start + 1e-3 * own)


def _table(motion: GroundMotion | None) -> np.ndarray:
    """(m, 7) rows of a motion for the compiled loop; none for ground that stands still."""
    return STILL if motion is None else motion.segments
