"""Simulate a structure under a ground motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rockeom.contract import AT_THE_START, CONTACT, EVENTS_KEPT, FULL, REFINED, STEPS_KEPT
from rockeom.numeric.case import STILL, Case, Problem
from rockeom.numeric.impact import ImpactLaw
from rockeom.numeric.options import SolverOptions
from rockeom.numeric.program import Program, program
from rockeom.numeric.response import Outcome, Response, Steps

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

    Raises ValueError for states that are unknown, not finite or already fallen over, and TypeError
    for an argument of another kind than is asked for.
    """
    case = Case(structure, motion, impact, initial, duration, vertical, phase)
    options = SolverOptions.of(options)
    problem = case.problem()
    compiled = program(structure.module, options.method)
    record = run(compiled, problem, options)
    return Response(
        structure=structure,
        motion=motion,
        vertical=vertical,
        outcome=record.outcome,
        duration=problem.end,
        output_step=options.output_step or problem.end / 4000,
        statistics={
            "steps": len(record.steps.span),
            "events": len(record.events[0]),
            "method": options.method,
            **({"refined": record.refined} if options.steps_per_law else {}),
        },
        steps=record.steps,
        end=record.y,
        passages=record.events,
        tables=(problem.horizontal, problem.vertical),
        program=compiled,
    )


@dataclass(frozen=True)
class Record:
    """What the compiled loop left of a motion: how it ended, its steps and its events.

    refined : laws of the ground in which equal steps would have been too long.
    """

    outcome: Outcome
    y: np.ndarray
    steps: Steps
    events: tuple[np.ndarray, np.ndarray, np.ndarray]
    refined: int


def run(compiled: Program, problem: Problem, options: SolverOptions, keep: bool = True) -> Record:
    """Run the compiled loop to its end, emptying its records whenever they are full."""
    n, q, p = len(problem.y0), problem, problem.p()
    atol = np.full(n, options.atol)
    status = AT_THE_START.copy()
    status[CONTACT] = q.contact
    clock = np.zeros(4)
    y, rate, scratch = q.y0.copy(), np.zeros(n), np.zeros(compiled.SCRATCH)
    peaks = np.empty((0, n))  # not asked for
    size, events = (256 + len(q.horizontal) + len(q.vertical) if keep else 0), 256
    code = FULL
    chunks: list[tuple[np.ndarray, ...]] = []
    while code == FULL:
        steps = (np.empty((size, 2)), np.empty(size, np.int64), np.empty((size, 8, n)))
        marks = (np.empty(events), np.empty((events, 3), np.int64), np.empty((events, 2, n)))
        status[[STEPS_KEPT, EVENTS_KEPT]] = 0
        code = compiled.integrate(
            status, clock, y, rate, q.end, q.horizontal, q.vertical, p, q.law, q.ratio,
            options.rtol, atol, options.max_step, options.steps_per_law, q.fallen,
            options.rest_tolerance, options.max_impacts, options.max_steps,
            *steps, *marks, peaks, scratch,
        )  # fmt: skip
        kept, noted = status[[STEPS_KEPT, EVENTS_KEPT]]
        chunks.append((*(a[:kept] for a in steps), *(a[:noted] for a in marks)))
    span, contacts, powers, times, kinds, states = (
        np.concatenate(parts) if len(parts) > 1 else parts[0] for parts in zip(*chunks, strict=True)
    )
    if len(span) == 0:  # ended before the first step: keep the start
        span, contacts = np.array([[0.0, np.finfo(float).tiny]]), np.array([q.contact])
        powers = np.zeros((1, 8, n))
        powers[0, 0] = q.y0
    outcome = _OUTCOMES[code]
    if outcome is Outcome.COMPLETED and q.quiet_from <= q.end:
        contact, reach = int(status[CONTACT]), 0.1 * q.end
        if compiled.falls(
            contact, y, STILL, p, q.law, q.ratio, options.rtol, atol, q.fallen,
            options.max_impacts, options.max_steps, reach,
        ):  # fmt: skip
            outcome = Outcome.OVERTURNED
        elif compiled.at_rest(contact, y, p):
            outcome = Outcome.CAME_TO_REST
    taken = Steps(span, contacts, powers)
    return Record(outcome, y, taken, (times, kinds, states), int(status[REFINED]))
