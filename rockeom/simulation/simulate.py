"""Simulate a structure under a ground motion."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from rockeom.codes import AT_THE_START, EVENTS_KEPT, FULL, MODE, OUTCOMES, REFINED, STEPS_KEPT
from rockeom.integrator.program import Program, program
from rockeom.motion import GroundMotion
from rockeom.motion.recording import Recording
from rockeom.motion.slope import SLOPE
from rockeom.numbers import explained
from rockeom.numbers.checks import InputTypeError, require
from rockeom.simulation.case import Case, Problem, without_duals
from rockeom.simulation.events import EventColumns, Events
from rockeom.simulation.ground import COMPONENTS, STILL, rows_after
from rockeom.simulation.method_selection import chosen
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.outcome import Outcome
from rockeom.simulation.quantities import Quantities
from rockeom.simulation.recorder import ALL, KEEP, SAMPLES, DenseRecorder, Recorder, SampleRecorder
from rockeom.simulation.response import Response
from rockeom.simulation.steps import Steps
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw


@explained.calls(
    restitution="impact=rk.VelocityRatio(e)",
    e="impact=rk.VelocityRatio(e)",
    r="impact=rk.EnergyRatio(r)",
    rtol="options=rk.SolverOptions(rtol=...)",
    method="options=rk.SolverOptions(method=...)",
    dt="options=rk.SolverOptions(output_step=...)",
    theta='initial={"theta": ...}',
    time="duration=",
    t_end="duration=",
)
def simulate(
    structure: Structure | Case,
    motion: GroundMotion | Recording | None = None,
    *,
    impact: ImpactLaw | None = None,
    initial: Mapping[str, float] | None = None,
    duration: float | None = None,
    vertical: GroundMotion | None = None,
    mode: str | None = None,
    options: SolverOptions | None = None,
    keep: str = "all",
    slope: float | str = 0.0,
    ground_axes: str = SLOPE,
    transverse: GroundMotion | None = None,
    azimuth: float | str = 0.0,
) -> Response:
    """Simulate a structure under a horizontal (and a vertical) ground motion.

    Parameters
    ----------
    structure : Structure or Case
        Structure that is shaken; or a `Case`, which has all but `options` and `keep`.
    motion : GroundMotion or Recording, optional
        Horizontal ground motion, or a recording with one horizontal component, which brings its
        vertical one along. A structure in space takes a recording with two horizontal components,
        see `Recording.in_space`.
    impact : ImpactLaw, optional
        Impact law: Impulsive(), EnergyRatio(r), VelocityRatio(e), AngularMomentum() or another one;
        `Structure.default_impact` if not given. ``statistics["impact_law"]`` of the response has
        it.
    initial : dict of str to float, optional
        Values of states by name [rad, m, rad/s, m/s]; others are zero. An angle may be named in
        degrees: ``{"theta_degrees": 5}``.
    duration : float, optional
        Duration [s]; the motion's own if not given. After the motion the ground stands still.
    vertical : GroundMotion, optional
        Vertical ground motion.
    mode : str, optional
        Name of the mode at the start, where the state leaves it open.
    options : SolverOptions, optional
        Choices of the integration; the defaults if not given.
    keep : str, optional
        "all", the polynomials of every step, from which all follows at any time: 24 + 64 N bytes a
        step, of N states. "samples", for records of hours: the states every `output_step` of the
        options and on both sides of every event, and the extremes of states, energies, forces and
        displacements, which are evaluated while the motion runs: some .1 ms a step, as a line on
        stderr says from 100,000 steps on. Whatever needs the steps then raises ValueError:
        `Response.at`, works and other extremes, `Response.support`.
    slope : float or str, optional
        Slope of the ground, a number [rad] or a text such as "5 deg" or "1 in 20": it falls to the
        right where it is positive. Rotations are those from its normal, downhill positive, and
        displacements those along it. Without `initial` the structure starts in equilibrium on it.
    ground_axes : str, optional
        "slope": the ground motions are along and normal to the slope; "world": they are level and
        upright.
    transverse : GroundMotion, optional
        Second horizontal ground motion, at a right angle counter-clockwise from the first one seen
        from above, of a structure in space.
    azimuth : float or str, optional
        Azimuth of the x axis of a structure in space from the first horizontal ground motion,
        counter-clockwise seen from above: a number [rad] or a text such as "30 deg". The axes of
        the response are those of the structure.

    Returns
    -------
    Response
        Motion as sampled and at any time, with its events, extremes and outcome.

    Raises
    ------
    ValueError
        For states that are unknown, not finite or already fallen over.
    TypeError
        For an argument of the wrong kind.

    See Also
    --------
    simulate_many : Many motions at once, over the values of parameters.
    sensitivity : Derivatives of peaks and other results by parameters.

    Notes
    -----
    The motion is integrated through every impact: each event is located on the polynomial of its
    step, and the impact map of the structure gives the state after it. Impacts that follow one
    another ever faster end in rest by their closed-form sum.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse, impact=rk.VelocityRatio(0.9), initial={"theta": 0.01})
    >>> print(run.outcome)
    completed
    >>> print(f"{run.extremes('theta').peak:.4f} rad")
    0.1423 rad
    """
    require(keep in KEEP, "", "keep", keep, f"choose {' or '.join(map(repr, KEEP))}")
    parts: Any = motion, impact, initial, duration, vertical, mode
    others: Any = slope, ground_axes, transverse, azimuth
    case = structure if isinstance(structure, Case) else Case(structure, *parts, *others)
    if case is structure and any(x is not None for x in parts) | (
        others != (0.0, SLOPE, None, 0.0)
    ):
        raise InputTypeError("structure").wrong(
            "is a case, which has the other arguments: give others to dataclasses.replace(case, "
            "...)"
        )
    return simulated(case, without_duals(case.problem()), SolverOptions.of(options), keep)


def simulated(case: Case, problem: Problem, options: SolverOptions, keep: str = ALL) -> Response:
    """The response of a case, given in numbers as well."""
    structure = case.structure
    choice = chosen(structure, problem, options)
    compiled = program(structure.module, choice.method)
    recorder: DenseRecorder | SampleRecorder = DenseRecorder()
    if keep == SAMPLES:
        quantities = Quantities(structure, case.ground, choice.method)
        names, spacing = quantities.main_names, options.spacing(problem.end)
        recorder = SampleRecorder(spacing, names, quantities.columns(names))
    motion = run(compiled, problem, options, recorder)
    if not len(recorder):  # ended before the first step: keep the start
        recorder.add(_at_the_start(problem))
    statistics: dict[str, Any] = {"steps": len(recorder), "events": len(motion.events.times)}
    statistics |= {"method": choice.method, "chosen": choice.because}
    if law := structure.describe_impact(case.impact):
        statistics["impact_law"] = law
    if options.steps_per_segment:
        statistics["refined"] = motion.refined
    return Response(
        structure, case.motion, case.vertical, case.impact, options, motion.outcome, problem.end,
        statistics, recorder.record(motion.events), Events(structure, motion.events), motion.y,
        case.slope, case.ground_axes, case.transverse, case.azimuth,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Integrated:
    """A motion as the compiled loop leaves it: how it ended, its last state and its events.

    refined : segments of the ground motion in which equal steps would have been too long.
    """

    outcome: Outcome
    y: np.ndarray
    events: EventColumns
    refined: int


def run(
    compiled: Program, problem: Problem, options: SolverOptions, recorder: Recorder | None = None
) -> Integrated:
    """Run the compiled loop to its end, emptying its records whenever they are full.

    recorder : of the steps, if given.
    """
    idle = _benches(compiled, recorder is not None)
    try:
        bench = idle.pop()  # in one go: threads may ask for one at the same time
    except IndexError:
        bench = _Bench(compiled, recorder is not None)
    try:
        return bench.run(problem, options, recorder)
    finally:
        idle.append(bench)


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
        p, peaks = np.zeros(1), np.empty((0, n))  # bound again; not asked for
        self.integrate = compiled.integrate.bound(
            self.status, self.clock, self.y, self.rate, 0.0, STILL, STILL, STILL, p, 0, 0.0,
            0.0, self.atol, 0.0, 0, 0.0, 0.0, 0, 0, *self.steps, *self.events, peaks,
            np.zeros(compiled.SCRATCH),
        )  # fmt: skip
        self.falls = compiled.falls.bound(
            0, self.y, 0.0, STILL, STILL, STILL, p, 0, 0.0, 0.0, self.atol, np.inf, 0, 0.0, 1e-6,
            0, 0, 0.0,
        )  # fmt: skip
        self.at_rest = compiled.at_rest.bound(0, self.y, p)

    def run(self, q: Problem, options: SolverOptions, recorder: Recorder | None) -> Integrated:
        status, p = self.status, q.p()
        status[:], self.clock[:], self.y[:], self.rate[:] = AT_THE_START, 0.0, q.y0, 0.0
        status[MODE], self.atol[:] = q.mode, options.atol
        integrate = self.integrate
        integrate["t_end"], integrate["h_max"] = q.end, options.max_step
        for name in COMPONENTS:
            integrate[name] = getattr(q, name)
        integrate["fixed"] = options.steps_per_segment
        for bound in (integrate, self.falls):
            bound["p"], bound["law"], bound["ratio"], bound["fallen"] = p, q.law, q.ratio, q.fallen
            bound["rtol"], bound["max_impacts"] = options.rtol, options.max_impacts
            bound["max_steps"] = options.max_steps
        integrate["rest_tolerance"] = options.rest_tolerance
        code = FULL
        parts: list[EventColumns] = []
        while code == FULL:
            status[STEPS_KEPT] = status[EVENTS_KEPT] = 0
            code = integrate()
            kept, noted = int(status[STEPS_KEPT]), int(status[EVENTS_KEPT])
            if recorder is not None:
                recorder.add(Steps(*(a[:kept] for a in self.steps)))
            parts.append(EventColumns(*(a[:noted].copy() for a in self.events)))
        outcome = Outcome(OUTCOMES[code])
        if outcome is Outcome.COMPLETED and q.quiet_from <= q.end:
            for name in COMPONENTS:
                self.falls[name] = rows_after(getattr(q, name))
            outcome = self._later(p, 0.1 * q.end)
        events = parts[0]
        if len(parts) > 1:
            events = EventColumns(*map(np.concatenate, zip(*parts, strict=True)))
        return Integrated(outcome, self.y.copy(), events, int(status[REFINED]))

    def _later(self, p: np.ndarray, reach: float) -> Outcome:
        """The outcome of a motion that was followed to its end, the ground at rest."""
        mode = int(self.status[MODE])
        self.falls["mode"] = self.at_rest["mode"] = mode
        self.falls["reach"], self.at_rest["p"] = reach, p
        if self.falls():
            return Outcome.OVERTURNED
        return Outcome.CAME_TO_REST if self.at_rest() else Outcome.COMPLETED


@cache
def _benches(compiled: Program, keep: bool) -> list[_Bench]:
    """Benches of a program that nobody uses now."""
    return []


_STEPS, _EVENTS = 1024, 4096
"""How many are recorded before the record is emptied."""

_TINY = float(np.finfo(float).tiny)


def _at_the_start(problem: Problem) -> Steps:
    """The record of a motion that has not begun."""
    powers = np.zeros((1, 8, len(problem.y0)))
    powers[0, 0] = problem.y0
    return Steps(np.array([[0.0, _TINY]]), np.array([problem.mode]), powers)
