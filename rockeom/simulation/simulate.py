"""Simulate a structure under a ground motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from rockeom.codes import (
    AT_THE_START,
    CONTACT,
    EVENTS_KEPT,
    FULL,
    OUTCOMES,
    REFINED,
    STEPS_KEPT,
)
from rockeom.integrator.program import Program, program
from rockeom.numbers.checks import told
from rockeom.simulation.case import STILL, Case, Problem, without_duals
from rockeom.simulation.method_selection import chosen
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.recorder import (
    ALL,
    KEPT,
    SAMPLES,
    AllSteps,
    Gathering,
    Passages,
    Samples,
    SomeSamples,
    Steps,
)
from rockeom.simulation.response import Outcome, Response
from rockeom.structures.impact_laws import ImpactLaw

if TYPE_CHECKING:
    from rockeom.motion import GroundMotion
    from rockeom.structures.classes import Structure


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
    keep: str = "all",
) -> Response:
    """Response of a structure to a horizontal (and a vertical) ground motion.

    impact : Impulsive(), EnergyRatio(r), VelocityRatio(e), AngularMomentum() or another impact law;
        `structure.default_impact` if not given. `statistics["impact_law"]` of the response has it.
    initial : states by name; what is not named is zero.
    duration : [s]; the motion's own if not given. After the motion the ground stands still.
    phase : contact state at the start, where the state leaves it open.
    keep : "all", the polynomials of every step, from which all follows at any time: 24 + 64 N bytes
        a step, of N states. "samples", for records of hours: the states every `output_step` of the
        options and on both sides of every event, and the extremes of `main_names`, which are found
        while the motion runs. What needs the steps then says so: `at`, works and other extremes,
        the forces that friction and contact had to bear, `base_moment`.

    Raises ValueError for states that are unknown, not finite or already fallen over, and TypeError
    for an argument of another kind than is asked for.
    """
    if keep not in KEPT:
        raise ValueError(f"keep is {told(keep)}: choose {' or '.join(map(repr, KEPT))}")
    case = Case(structure, motion, impact, initial, duration, vertical, phase)
    return simulated(case, without_duals(case.problem()), SolverOptions.of(options), keep)


def simulated(case: Case, problem: Problem, options: SolverOptions, keep: str = ALL) -> Response:
    """The response of a case, given in numbers as well."""
    structure, motion = case.structure, case.motion
    choice = chosen(structure, problem, options)
    compiled = program(structure.module, choice.method)
    said: dict[str, Any] = {"method": choice.method, "chosen": choice.because}
    if law := structure.describe_impact(case.impact):
        said["impact_law"] = law

    def response(record: Steps | Samples, of: Ran) -> Response:
        return Response(
            structure, motion, case.vertical, case.impact, options, of.outcome, problem.end, said,
            record, of.y, of.events,
        )  # fmt: skip

    gathering: AllSteps | SomeSamples = AllSteps()
    if keep == SAMPLES:
        nothing_yet = response(_at_the_start(problem), _nothing(len(problem.y0)))
        gathering = SomeSamples(nothing_yet.output_step, *nothing_yet.told_of_steps())
    ran = run(compiled, problem, options, gathering)
    if not len(gathering):  # ended before the first step: keep the start
        gathering.add(_at_the_start(problem))
    said = {"steps": len(gathering), "events": len(ran.events[0]), **said}
    if options.steps_per_segment:
        said["refined"] = ran.refined
    return response(gathering.record(ran.events), ran)


@dataclass(frozen=True)
class Ran:
    """What the compiled loop left of a motion: how it ended and its events.

    refined : segments of the ground's motion in which equal steps would have been too long.
    """

    outcome: Outcome
    y: np.ndarray
    events: Passages
    refined: int


def run(
    compiled: Program, problem: Problem, options: SolverOptions, gathering: Gathering | None = None
) -> Ran:
    """Run the compiled loop to its end, emptying its records whenever they are full.

    gathering : takes the steps, if given.
    """
    idle = _benches(compiled, gathering is not None)
    try:
        bench = idle.pop()  # in one go: threads may ask for one at the same time
    except IndexError:
        bench = _Bench(compiled, gathering is not None)
    try:
        return bench.run(problem, options, gathering)
    finally:
        idle.append(bench)


@cache
def _benches(compiled: Program, keep: bool) -> list[_Bench]:
    """Those of a program that nobody uses now."""
    return []


_STEPS, _EVENTS = 1024, 4096
"""How many are recorded before the record is emptied."""

_TINY = float(np.finfo(float).tiny)


def _at_the_start(problem: Problem) -> Steps:
    """The record of a motion that has not begun."""
    powers = np.zeros((1, 8, len(problem.y0)))
    powers[0, 0] = problem.y0
    return Steps(np.array([[0.0, _TINY]]), np.array([problem.contact]), powers)


def _nothing(n: int) -> Ran:
    """What is left of a motion of n states that has not begun."""
    events = np.empty(0), np.empty((0, 4), np.int64), np.empty((0, 2, n))
    return Ran(Outcome.COMPLETED, np.zeros(n), events, 0)


class _Bench:
    """The arrays in which one motion at a time is integrated, and the functions bound to them.

    It is used for one motion after the other: to bind arrays takes longer than a short motion.
    """

    def __init__(self, compiled: Program, keep: bool) -> None:
        n, rows = compiled.N_STATES, _STEPS if keep else 0
        self.status, self.clock = AT_THE_START.copy(), np.zeros(4)
        self.y, self.rate, self.atol = np.zeros(n), np.zeros(n), np.zeros(n)
        self.steps = np.empty((rows, 2)), np.empty(rows, np.int64), np.empty((rows, 8, n))
        self.events = np.empty(_EVENTS), np.empty((_EVENTS, 4), np.int64), np.empty((_EVENTS, 2, n))
        p, peaks = np.zeros(1), np.empty((0, n))  # bound anew; not asked for
        self.integrate = compiled.integrate.bound(
            self.status, self.clock, self.y, self.rate, 0.0, STILL, STILL, p, 0, 0.0, 0.0,
            self.atol, 0.0, 0, 0.0, 0.0, 0, 0, *self.steps, *self.events, peaks,
            np.zeros(compiled.SCRATCH),
        )  # fmt: skip
        self.falls = compiled.falls.bound(
            0, self.y, 0.0, STILL, STILL, p, 0, 0.0, 0.0, self.atol, np.inf, 0, 0.0, 1e-6, 0, 0, 0.0
        )
        self.at_rest = compiled.at_rest.bound(0, self.y, p)

    def run(self, q: Problem, options: SolverOptions, gathering: Gathering | None) -> Ran:
        status, p = self.status, q.p()
        status[:], self.clock[:], self.y[:], self.rate[:] = AT_THE_START, 0.0, q.y0, 0.0
        status[CONTACT], self.atol[:] = q.contact, options.atol
        integrate = self.integrate
        integrate["t_end"], integrate["h_max"] = q.end, options.max_step
        integrate["horizontal"], integrate["vertical"] = q.horizontal, q.vertical
        integrate["fixed"] = options.steps_per_segment
        for bound in (integrate, self.falls):
            bound["p"], bound["law"], bound["ratio"], bound["fallen"] = p, q.law, q.ratio, q.fallen
            bound["rtol"], bound["max_impacts"] = options.rtol, options.max_impacts
            bound["max_steps"] = options.max_steps
        integrate["rest_tolerance"] = options.rest_tolerance
        code = FULL
        found: list[Passages] = []
        while code == FULL:
            status[STEPS_KEPT] = status[EVENTS_KEPT] = 0
            code = integrate()
            kept, noted = int(status[STEPS_KEPT]), int(status[EVENTS_KEPT])
            if gathering is not None:
                gathering.add(Steps(*(a[:kept] for a in self.steps)))
            times, kinds, states = (a[:noted].copy() for a in self.events)
            found.append((times, kinds, states))
        outcome = Outcome(OUTCOMES[code])
        if outcome is Outcome.COMPLETED and q.quiet_from <= q.end:
            outcome = self._later(p, 0.1 * q.end)
        times, kinds, states = (
            found[0] if len(found) == 1 else map(np.concatenate, zip(*found, strict=True))
        )
        return Ran(outcome, self.y.copy(), (times, kinds, states), int(status[REFINED]))

    def _later(self, p: np.ndarray, reach: float) -> Outcome:
        """What will become of a motion that was followed to its end, the ground at rest."""
        contact = int(self.status[CONTACT])
        self.falls["mode"] = self.at_rest["mode"] = contact
        self.falls["reach"], self.at_rest["p"] = reach, p
        if self.falls():
            return Outcome.OVERTURNED
        return Outcome.CAME_TO_REST if self.at_rest() else Outcome.COMPLETED
