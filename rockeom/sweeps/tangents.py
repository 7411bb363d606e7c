"""Derivatives of a motion with respect to anything that a case is made of.

    import rockeom as rk

    numbers = rk.duals(half_width=0.1, theta=0.15)
    block = rk.RigidBlock(half_width=numbers["half_width"], half_height=0.4)
    start = {"theta": numbers["theta"]}
    found = rk.tangents(rk.Case(block, rk.GroundMotion.none(3.0), initial=start))
    found.event_times[0]  # of the first impact, by the half-width and by the first rotation
    found.at([1.0, 2.0])  # (2, 2, 2): of the states then

They are exact: nothing is moved by a little to see what it does. The same texts repeat the steps
of the motion, printed for numbers with derivatives; what happens where a guard falls,
`rockeom/integrator/tangents/variational.py` says.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.codes import GRAZES, OTHER_WAY
from rockeom.compiler.types import WIDTH
from rockeom.integrator import records
from rockeom.integrator.program import tangent_program
from rockeom.integrator.schema import has_landings, is_by_code
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, array_of
from rockeom.numbers.dual import nominal, tangent_of, value_of
from rockeom.simulation.case import Case, Problem, ProblemTangents, check_case, parted
from rockeom.simulation.ground import COMPONENTS, ground_of
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Outcome, Response, fall_is_judged
from rockeom.simulation.simulate import simulated
from rockeom.structures.searched_modes import slipping


@dataclass(frozen=True, eq=False)
class Tangents:
    """Motion with its derivatives along m directions, those of the duals of its case.

    Parameters
    ----------
    response : Response
        Motion, with the bits that `simulate` gives.
    start : ndarray
        Derivatives of the state at the start (N, m).
    event_times : ndarray
        Derivatives of the time of each of ``response.events`` (k, m).
    before : ndarray
        Derivatives of the states before each event, at the event, which moves (k, N, m).
    after : ndarray
        Derivatives of the states after each event (k, N, m).
    end : ndarray
        Derivatives of the state at the end of the motion, as far as a dual `duration` moves that,
        too (N, m).
    end_time : ndarray
        Derivatives of the time of that end (m,): zero, but where a structure falls or `duration` is
        a dual.
    grazing : str
        "", or a sentence on the event that cannot be passed: one whose guard falls so slowly that
        its time is not known, so that a little more or less of anything and it is another, or none.
        Derivatives behind it are NaN.
    motion : object
        Motion of the integrator.
    """

    response: Response
    start: np.ndarray
    event_times: np.ndarray
    before: np.ndarray
    after: np.ndarray
    end: np.ndarray
    end_time: np.ndarray
    grazing: str
    motion: Motion

    @property
    def along(self) -> ProblemTangents:
        """Derivatives of the numbers from which the motion follows."""
        return self.motion.along

    @property
    def parameters(self) -> np.ndarray:
        """(P, m) of the parameters as equations take them, with the constants that follow."""
        return self.along.p[: len(self.response.structure.vector)]

    def at(self, times: ArrayLike) -> np.ndarray:
        """Derivatives of the states at fixed times, behind an event at one.

        Parameters
        ----------
        times : array_like
            Times (n,) [s].

        Returns
        -------
        ndarray
            Derivatives (n, N, m).

        Raises
        ------
        ValueError
            For times outside of the motion.
        """
        instants = np.atleast_1d(array_of("times", times, "Tangents.at"))
        end = self.motion.last_time
        if instants.size and not (instants.min() >= 0.0 and instants.max() <= end):
            raise InputError("times", times, "Tangents.at").give(f"times from 0 to {end:.6g} s")
        order = np.argsort(instants, kind="stable")
        derivatives = np.empty((len(instants), *self.end.shape))
        derivatives[order] = self.motion.carried(instants[order]).at_times
        return derivatives


@explained.calls()
def tangents(case: Case, options: SolverOptions | None = None) -> Tangents:
    """Motion of a case that holds duals, with its derivatives along their directions.

    Parameters
    ----------
    case : Case
        Case some of whose numbers are duals, see `duals`.
    options : SolverOptions, optional
        Choices of the integration; the defaults if not given.

    Returns
    -------
    Tangents
        Motion and derivatives. They are those of the steps that were made, and as accurate as the
        motion.

    Raises
    ------
    ValueError
        As `simulate`, and for a structure of which a force jumps where no mode ends: derivatives
        end there, too; and where a point slips with friction in space.
    TypeError
        As `simulate`.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> start = rk.duals(theta=0.1, theta_dot=0.0)  # rad, rad/s
    >>> flow = rk.tangents(rk.Case(block, rk.GroundMotion.none(2.0), initial=start))
    >>> flow.end.shape
    (2, 2)
    """
    check_case(case)
    return of_problem(case, *_with_duals(case), SolverOptions.of(options))


def states_at(
    case: Case, times: np.ndarray, options: SolverOptions | None = None
) -> tuple[Response, np.ndarray]:
    """The motion of a case that holds duals, and derivatives (n, N, m) of its states at times (n,).

    The same as `tangents(case).at(times)` in half the time. times : ascending [s]; those behind the
    end of the motion have the derivatives zero.
    """
    motion = _motion(case, *_with_duals(case), SolverOptions.of(options))
    inside = times <= motion.last_time
    derivatives = np.zeros((len(times), len(motion.problem.y0), motion.directions))
    derivatives[inside] = motion.carried(times[inside]).at_times
    return motion.response, derivatives


def _with_duals(case: Case) -> tuple[Problem, ProblemTangents]:
    problem, along = parted(case.problem())
    if not along.end.size:
        raise InputError("case").says(
            "the case holds no duals: make its numbers by rk.duals, as in "
            "rk.RigidBlock(**rk.duals(half_width=0.1), half_height=0.4)"
        )
    return problem, along


def of_problem(
    case: Case, problem: Problem, along: ProblemTangents, options: SolverOptions
) -> Tangents:
    """The same of a case in numbers: for whoever runs it again from another state."""
    motion = _motion(case, problem, along, options)
    carried = motion.carried(np.empty(0))
    end, end_time = _end(case, motion, carried.end)
    before, after = carried.event_states[:, 0], carried.event_states[:, 1]
    return Tangents(
        motion.response, along.y0, carried.event_times, before, after,
        end, end_time, motion.said_of(carried), motion,
    )  # fmt: skip


def _motion(case: Case, problem: Problem, along: ProblemTangents, options: SolverOptions) -> Motion:
    if case.structure.jumps_between_events:
        raise InputError("case", of="tangents").says(
            f"a force of {type(case.structure).__name__} jumps between its events, and derivatives "
            "with it: give it one law for all speeds, or the speed of the last impact"
        )
    response = simulated(nominal(case), problem, options)
    _check_slips(response)
    return Motion(response, problem, along)


def _check_slips(response: Response) -> None:
    """Raises InputError where a point slips with friction in space: friction turns with the slip.

    Where that is slow it turns so fast that steps follow the motion and not its derivatives, and
    the end of a slip has no direction.
    """
    module, steps = response.structure.module, response.steps
    if not (has_landings(module) and is_by_code(module)):
        return
    which = np.flatnonzero(slipping(module, steps.mode))
    if len(which):
        mode, t = module.MODES[int(steps.mode[which[0]])], float(steps.span[which[0], 0])
        raise InputError("case", of="tangents").says(
            f"a point slips from {t:.6g} s, in mode {mode}, and its friction turns with the slip: "
            "derivatives of such a motion are not known. Take differences of two motions, end it "
            "before, or let points stick, by friction=None"
        )


class _Carried(NamedTuple):
    """Derivatives along m directions, as `propagate_tangents` leaves them.

    stopped : 0, or why it did not come to the end, at the event `at`.
    """

    end: np.ndarray
    at_times: np.ndarray
    event_states: np.ndarray
    event_times: np.ndarray
    stopped: int
    at: int


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion and what it is derived by."""

    response: Response
    problem: Problem
    along: ProblemTangents

    @property
    def directions(self) -> int:
        return self.along.y0.shape[1]

    @cached_property
    def shakes(self) -> np.ndarray:
        """(m,) whether the ground moves otherwise in a direction."""
        moves = np.zeros(self.directions, dtype=bool)
        for rows in self.grounds:
            moves |= [along.any() for along in np.moveaxis(rows, -1, 0)]
        return moves

    @property
    def grounds(self) -> list[np.ndarray]:
        """Derivatives of the tables of the ground's motions that have some: others are one zero."""
        tables = (getattr(self.along, name) for name in COMPONENTS)
        return [x for x in tables if any(x.strides)]

    @cached_property
    def order(self) -> np.ndarray:
        """(m,) the directions, those in which the ground moves otherwise last, and so together.

        Records are long, and with all their derivatives longer.
        """
        return np.argsort(self.shakes, kind="stable")

    @cached_property
    def last_time(self) -> float:
        """When the motion ends [s]."""
        return float(self.response.steps.span[-1].sum())

    @property
    def falls(self) -> bool:
        """Whether it ends because a coordinate has reached its bound."""
        fallen = self.response.outcome is Outcome.OVERTURNED and not fall_is_judged(self.response)
        return fallen and self.last_time < self.response.duration

    def rates(self, t: float) -> np.ndarray:
        """(N,) rates of the states up to a time."""
        r, (y, modes) = self.response, self.response.steps.at(np.array([t]), "left")
        before = float(np.nextafter(t, 0.0))  # at a corner a motion tells what is behind it
        rates = np.empty(len(r.states))
        shaking = map(float, ground_of(r).accelerations(before))
        r.structure.module.rates(int(modes[0]), y[0], r.structure.vector, *shaking, rates)
        return rates

    @cached_property
    def longest_step(self) -> float:
        """The step in which derivatives follow the fastest possible vibration [s]."""
        structure = self.response.structure
        if structure.rocks_on_rigid_ground and len(structure.states) == 2:
            return math.inf  # nothing vibrates
        of_method = _RADIANS.get(self.response.statistics["method"], math.inf)
        fastest = max(structure.small_motion)
        return of_method / fastest if fastest > 0.0 else math.inf

    def carried(self, times: np.ndarray) -> _Carried:
        """times (n,) ascend; as many directions at a time as the program carries."""
        r, q, along = self.response, self.problem, self.along
        steps, (t, kinds, states) = r.steps, r.events.columns
        program = tangent_program(r.structure.module, r.statistics["method"])
        n, k, size = len(q.y0), len(t), 1 + WIDTH
        p, atol = q.p(), np.full(n, r.options.atol)
        case = records.Case(
            t_end=q.end, horizontal=q.horizontal, transverse=q.transverse, vertical=q.vertical,
            p=p, law=q.law, ratio=q.ratio, rtol=r.options.rtol, atol=atol,
            h_max=r.options.max_step, fixed=0,
            fallen=q.fallen, rest_tolerance=r.options.rest_tolerance,
            max_impacts=r.options.max_impacts, max_steps=r.options.max_steps,
        )  # fmt: skip
        shapes = (n,), (len(times), n), (k, 2, n), (k,)
        whole = [np.empty((*shape, self.directions)) for shape in shapes]
        why, at = 0, 0
        for first in range(0, self.directions, WIDTH):
            some = self.order[first : first + WIDTH]
            shaken = some[self.shakes[some]]
            tables = ((getattr(q, name), getattr(along, name)) for name in COMPONENTS)
            rows = [_dual(*table, some) if shaken.size else _NO_ROWS for table in tables]
            corners = any(x[:, :2, j].any() for x in self.grounds for j in shaken)
            y, told = _dual(q.y0, along.y0, some), np.zeros(1, np.int64)
            at_times, event_y, event_t = (np.full((*x, size), np.nan) for x in shapes[1:])
            stopped = program.propagate_tangents(
                steps.span, steps.mode, steps.powers, t, kinds, states, np.empty((0, n)), *case,
                *rows, corners, _dual(p, along.p, some), _dual(q.ratio, along.ratio, some)[None],
                self.longest_step, times, y, at_times, event_y, event_t, told, np.zeros((3, n)),
            )  # fmt: skip
            if stopped:
                y[:] = np.nan
            if first == 0:
                why, at = stopped, int(told[0])
            for array, part in zip(whole, (y, at_times, event_y, event_t), strict=True):
                array[..., some] = part[..., 1 : 1 + len(some)]
        return _Carried(whole[0], whole[1], whole[2], whole[3], why, at)

    def said_of(self, carried: _Carried) -> str:
        """Why derivatives end before the motion does, or nothing."""
        lost = ~np.isfinite(carried.event_states).all(axis=(1, 2, 3))
        if not (carried.stopped or lost.any()):
            return ""
        event = self.response.events[carried.at if carried.stopped else int(np.argmax(lost))]
        what = f"the {event.kind} at {event.time:.6g} s, {event.mode_before} to {event.mode_after}"
        return f"{what}, {_WHY[carried.stopped]}"


_RADIANS = {"DOP853": 0.6, "RK45": 0.2}
"""Radians of a vibration in an explicit step without an error that counts; an implicit one is
stable however long."""

_WHY = {
    0: "has no derivative: something is a root of what is zero there",
    GRAZES: "grazes: its guard falls so slowly that the time of it is not known",
    OTHER_WAY: "is one of several events that fit as well: which, is not known",
}


def _dual(x: Any, along: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Numbers with their derivatives in some directions behind them, as the program takes them."""
    duals = np.zeros((np.size(x), 1 + WIDTH))
    duals[:, 0] = np.ravel(x)
    for place, direction in enumerate(some, 1):  # one after the other: a record is long
        duals[:, place] = along[..., direction].ravel()
    return duals.reshape(*np.shape(x), 1 + WIDTH)


_NO_ROWS = np.empty((0, 7, 1 + WIDTH))
"""For a motion's table that no direction changes: the program has its rows already."""


def _end(case: Case, motion: Motion, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Derivatives of the state at the end, and of the time of the end, see `Tangents`."""
    r, m = motion.response, motion.directions
    if not motion.falls:
        moves = motion.along.end
        return (
            end + motion.rates(motion.last_time)[:, None] * moves if moves.any() else end
        ), moves
    # it ends where a rotation reaches its bound
    y, falls = r.end, case.structure.falls
    name = min(falls, key=lambda s: abs(abs(y[r.states.index(s)]) / value_of(falls[s]) - 1.0))
    i = r.states.index(name)
    speed = motion.rates(motion.last_time)[i]
    return end, (np.sign(y[i]) * tangent_of(falls[name], m) - end[i]) / speed
