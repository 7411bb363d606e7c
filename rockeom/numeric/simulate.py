"""Simulate a structure under a ground motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from rockeom.numeric.impact import ImpactLaw
from rockeom.numeric.options import SolverOptions
from rockeom.numeric.response import Outcome, Response, Steps
from rockeom.numeric.specialise import program

if TYPE_CHECKING:
    from rockeom.motion import GroundMotion
    from rockeom.numeric.structures import Structure

_OUTCOMES = tuple(Outcome)


def simulate(
    structure: Structure,
    motion: GroundMotion,
    *,
    impact: ImpactLaw | None = None,
    initial: Mapping[str, float] | None = None,
    duration: float | None = None,
    vertical: GroundMotion | None = None,
    phase: str | None = None,
    options: SolverOptions | None = None,
) -> Response:
    """Response of a structure to a horizontal (and a vertical) ground motion.

    impact : AngularMomentum() if not given; EnergyRatio(r), VelocityRatio(e) or Impulsive().
    initial : states by name; what is not named is zero.
    duration : [s]; the motion's own if not given. After the motion the ground stands still.
    phase : contact state at the start, where the state leaves it open.

    Raises ValueError for states that are unknown, not finite or already fallen over.
    """
    options = options or SolverOptions()
    y0 = structure.state(initial or {})
    contact = structure.contact(y0, phase, -_first_push(motion))
    fallen = structure.overturning_rotation
    rotation = structure.states[structure.module.ROTATION]
    if abs(y0[structure.module.ROTATION]) >= fallen:
        raise ValueError(
            f"initial {rotation} is {y0[structure.module.ROTATION]}: the structure lies on the "
            f"ground from {fallen:.6g} on; start below"
        )
    end = motion.duration if duration is None else float(duration)
    if not (math.isfinite(end) and end > 0):
        raise ValueError(f"duration is {end} s: it must be finite and positive")
    law, ratio = structure.law(impact)
    compiled = program(structure.module, options.method)
    tables = _table(motion), _table(vertical)
    problem = _Problem(compiled, structure.vector, law, ratio, fallen, options)
    record = problem.run(contact, y0, tables, end, options.max_impacts)
    outcome, last, span, contacts, powers = record.outcome, record.contact, *record.steps
    n = len(y0)
    shaking_ends = max(m.shaking_ends for m in (motion, vertical) if m is not None)
    if outcome is Outcome.COMPLETED and shaking_ends <= end and problem.falls(record, end):
        outcome = Outcome.OVERTURNED
    if len(span) == 0:  # ended before the first step: keep the start
        span = np.array([[0.0, np.finfo(float).tiny]])
        contacts = np.array([contact])
        powers = np.zeros((1, 8, n))
        powers[0, 0] = y0
    response = Response(
        structure=structure,
        motion=motion,
        vertical=vertical,
        outcome=outcome,
        duration=end,
        output_step=options.output_step or end / 4000,
        statistics={"steps": len(span), "events": len(record.events[0]), "method": options.method},
        steps=Steps(span, contacts, powers),
        passages=record.events,
        tables=tables,
        program=compiled,
    )
    if outcome is Outcome.COMPLETED and shaking_ends <= end and _is_at_rest(response, last):
        return replace(response, outcome=Outcome.CAME_TO_REST)
    return response


@dataclass(frozen=True)
class _Record:
    """What a run of the compiled loop left: the end, the steps and the events."""

    outcome: Outcome
    contact: int
    y: np.ndarray
    steps: tuple[np.ndarray, np.ndarray, np.ndarray]
    events: tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class _Problem:
    """A compiled loop with all that stays the same while it runs."""

    compiled: ModuleType
    vector: np.ndarray
    law: int
    ratio: float
    fallen: float
    options: SolverOptions

    def run(
        self,
        contact: int,
        y0: np.ndarray,
        tables: tuple[np.ndarray, np.ndarray],
        t_end: float,
        max_impacts: int,
        keep: bool = True,
    ) -> _Record:
        """Run to t_end or to an outcome, emptying the loop's records whenever they are full."""
        o, n = self.options, len(y0)
        status = np.array([contact, -1, 0, 0, 0, 0])
        clock = np.zeros(2)
        y = y0.copy()
        size, events = (256 + sum(len(table) for table in tables) if keep else 0), 256
        full = len(_OUTCOMES)
        code = full
        chunks: list[tuple[np.ndarray, ...]] = []
        while code == full:
            steps = (np.empty((size, 2)), np.empty(size, np.int64), np.empty((size, 8, n)))
            marks = (np.empty(events), np.empty((events, 3), np.int64), np.empty((events, 2, n)))
            status[4:] = 0
            code = self.compiled.integrate(
                status, clock, y, t_end, *tables, self.vector, self.law, self.ratio,
                o.rtol, np.full(n, o.atol), o.max_step, self.fallen, o.rest_tolerance,
                max_impacts, o.max_steps, *steps, *marks,
            )  # fmt: skip
            chunks.append((*(a[: status[4]] for a in steps), *(a[: status[5]] for a in marks)))
        span, contacts, powers, times, kinds, states = (
            np.concatenate(parts) if len(parts) > 1 else parts[0]
            for parts in zip(*chunks, strict=True)
        )
        steps, marks = (span, contacts, powers), (times, kinds, states)
        return _Record(_OUTCOMES[code], int(status[0]), y, steps, marks)

    def falls(self, record: _Record, end: float) -> bool:
        """Whether the free motion that follows a record leads to the ground, not back upright.

        It is followed, unrecorded, until the next impact; on springs while it leans further.
        """
        p, contact, y = self.compiled, record.contact, record.y
        quiet = _table(None), _table(None)
        if p.CONTACTS[contact] == "both":
            return False
        if p.SIDES[contact] != 0 and 0 in p.KINDS[contact]:
            last = self.run(contact, y, quiet, 1e3 * max(end, 1.0), 0, keep=False)
            return last.outcome is Outcome.OVERTURNED
        for _ in range(100):
            lean = abs(y[p.ROTATION])
            last = self.run(contact, y, quiet, 0.1 * end, self.options.max_impacts, keep=False)
            contact, y = last.contact, last.y
            if last.outcome is not Outcome.COMPLETED or abs(y[p.ROTATION]) <= lean:
                return last.outcome is Outcome.OVERTURNED
        return False


def _is_at_rest(response: Response, contact: int) -> bool:
    """Full contact, and no more motion than a millionth of the largest kinetic energy."""
    p = response.program
    if p.CONTACTS[contact] != "both" or 1 not in p.KINDS[contact]:
        return False
    if not any(response.final[name] for name in p.STATES[len(p.STATES) // 2 :]):
        return True
    kinetic = response["kinetic_energy"]
    return bool(kinetic[-1] <= 1e-6 * kinetic.max())


def _first_push(motion: GroundMotion) -> float:
    """Sign of the first ground acceleration that is not zero; 0 if there is none."""
    middle = 0.5 * (motion.segments[:, 0] + motion.segments[:, 1])
    pushes = motion.acceleration(middle)
    return float(np.sign(pushes[pushes != 0.0][0])) if pushes.any() else 0.0


def _table(motion: GroundMotion | None) -> np.ndarray:
    """(m, 7) rows of a motion for the compiled loop; none for ground that stands still."""
    return np.empty((0, 7)) if motion is None else np.array(motion.segments)
