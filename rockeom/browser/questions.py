"""The questions that a page asks of its program: a motion, its end, and where the bodies are.

This text is joined to others, behind the set-up; see `rockeom.browser.page`.
"""

import numpy as np

from rockeom.browser.places import (
    OF_END,
    OF_FALLEN,
    OF_LAW,
    OF_MODE,
    OF_QUIET,
    OF_RATIO,
    OF_ROWS_T,
    OF_ROWS_X,
    OF_ROWS_Y,
    OF_SIZE,
)
from rockeom.browser.written import MOST_P, N_NUMBERS, ROWS_T, ROWS_X, ROWS_Y, set_up
from rockeom.codes import (
    AT_THE_START,
    CAME_TO_REST,
    COMPLETED,
    EVENTS_KEPT,
    FULL,
    IMPACT,
    LANDING,
    MODE,
    OVERTURNED,
    STEPS_KEPT,
)
from rockeom.compiler.decorators import Floats, Floats2, Ints, entry, unrolled
from rockeom.integrator.batches import at_rest, falls
from rockeom.integrator.ground import ground_acceleration, segment_for, tables
from rockeom.integrator.loop import SCRATCH, integrate
from rockeom.integrator.provided import (
    AXES,
    N_STATES,
    ROTATION,
    energies,
    positions,
    powers,
    shapes,
)
from rockeom.integrator.records import Case, Recorder

UNKNOWN_WAY = -1
RTOL, ATOL = 1e-8, 1e-10
MOST_IMPACTS, MOST_STEPS = 100000, 200000
KEPT = 256
"""Steps in a record before it is emptied."""


def case_of_page(numbers, end, p, horizontal, transverse, vertical, atol):
    """The case that a set-up has written, which lasts until `end` at least."""
    return Case(
        max(numbers[OF_END], end),
        horizontal[0 : int(numbers[OF_ROWS_X])],
        transverse[0 : int(numbers[OF_ROWS_T])],
        vertical[0 : int(numbers[OF_ROWS_Y])],
        p[0 : int(numbers[OF_SIZE])],
        int(numbers[OF_LAW]), numbers[OF_RATIO], RTOL, atol, np.inf, 0, numbers[OF_FALLEN], 1e-6,
        MOST_IMPACTS, MOST_STEPS,
    )  # fmt: skip


def ended(code, status, y, case, quiet_from):
    """The outcome of a motion that was followed to its end, the ground at rest."""
    if code != COMPLETED or quiet_from > case.t_end:
        return code
    still = case.horizontal[0:0]
    free = case._replace(horizontal=still, transverse=still, vertical=still)
    if falls(status[MODE], y, free, 0.1 * case.t_end):
        return OVERTURNED
    if at_rest(status[MODE], y, case.p):
        return CAME_TO_REST
    return code


def begin(numbers, status, clock, rate, atol):
    """The status of a motion at its start."""
    for i in range(len(AT_THE_START)):
        status[i] = AT_THE_START[i]
    status[MODE] = int(numbers[OF_MODE])
    for i in range(4):
        clock[i] = 0.0
    for i in range(N_STATES):
        rate[i], atol[i] = 0.0, ATOL


@entry
def motion(
    sliders: Floats, end: float, p: Floats, numbers: Floats, states: Floats2, modes: Ints,
    ground: Floats2, impacts: Floats, spacing: Floats, readings: Floats,
) -> int:  # fmt: skip
    """A motion at equal times: its outcome, or -1 where no way of the set-up is known.

    end [s] : until then at least, 0 for the duration of the case.
    states (n, N), modes (n,), ground (k, n) : at each, the ground along its axes.
    impacts (k,) : times of the first ones. spacing (3,) : of the times; how many there are, and of
    impacts that are noted. readings (5,) : whether it overturns, its largest rotation, the number
    of impacts, the time from the first to the third and that of the last; nan where there is none.
    """
    y, horizontal, transverse = np.empty(N_STATES), np.empty((ROWS_X, 7)), np.empty((ROWS_T, 7))
    vertical, atol, rate = np.empty((ROWS_Y, 7)), np.empty(N_STATES), np.empty(N_STATES)
    if set_up(sliders, y, p, horizontal, transverse, vertical, numbers) < 0:
        return UNKNOWN_WAY
    status, clock = np.empty(len(AT_THE_START), np.int64), np.empty(4)
    begin(numbers, status, clock, rate, atol)
    case = case_of_page(numbers, end, p, horizontal, transverse, vertical, atol)
    n = states.shape[0]
    kept = KEPT if n > 0 else 0  # a motion without samples needs no steps
    steps, step_modes = np.empty((KEPT, 2)), np.empty(KEPT, np.int64)
    step_states = np.empty((KEPT, 8, N_STATES))
    events, event_kinds = np.empty(KEPT), np.empty((KEPT, 4), np.int64)
    extremes = np.empty((2, N_STATES))
    recorder = Recorder(
        steps[0:kept], step_modes[0:kept], step_states[0:kept], events, event_kinds,
        np.empty((KEPT, 2, N_STATES)), extremes,
    )  # fmt: skip
    for i in range(N_STATES):
        extremes[0, i] = extremes[1, i] = y[i]
    between = case.t_end / (n - 1)
    scratch = np.zeros(SCRATCH)
    code, at, number, first = FULL, 0, 0, 0.0
    readings[3] = readings[4] = np.nan
    while code == FULL:
        status[STEPS_KEPT] = status[EVENTS_KEPT] = 0
        code = integrate(status, clock, y, rate, case, recorder, scratch)
        for i in range(status[STEPS_KEPT]):
            last = steps[i, 0] + steps[i, 1]
            while at < n and at * between <= last:
                x = min(max((at * between - steps[i, 0]) / steps[i, 1], 0.0), 1.0)
                for j in range(N_STATES):
                    states[at, j] = state_at(step_states, i, j, x)
                modes[at] = step_modes[i]
                at = at + 1
        for i in range(status[EVENTS_KEPT]):
            kind = event_kinds[i, 0]
            if kind not in (IMPACT, LANDING):
                continue
            if number < impacts.shape[0]:
                impacts[number] = events[i]
            if number == 0:
                first = events[i]
            elif number == 2:
                readings[3] = events[i] - first
            number, readings[4] = number + 1, events[i]
    shaking = tables(case)
    for axis in unrolled(range(AXES)):
        sample_ground(shaking[axis], between, ground[axis])
    spacing[0], spacing[1] = between, float(at)
    spacing[2] = float(min(number, impacts.shape[0]))
    code = ended(code, status, y, case, numbers[OF_QUIET])
    readings[0] = 1.0 if code == OVERTURNED else 0.0
    readings[1] = max(-extremes[0, ROTATION], extremes[1, ROTATION])
    readings[2] = float(number)
    return code


@entry
def fate(sliders: Floats, end: float, readings: Floats) -> int:
    """The outcome of a motion without samples; end and readings as of `motion`."""
    return motion(
        sliders, end, np.empty(MOST_P), np.empty(N_NUMBERS), np.empty((0, N_STATES)),
        np.empty(0, np.int64), np.empty((AXES, 0)), np.empty(0), np.empty(3), readings,
    )  # fmt: skip


def sample_ground(table, between, out):
    """Ground accelerations by a table at equal times."""
    row = 0
    for i in range(len(out)):
        row, segment = segment_for(table, row, i * between)
        out[i] = ground_acceleration(segment, i * between)


def state_at(step_states, step, j, x):
    """State j within a step, at x in [0, 1]."""
    value = step_states[step, 7, j]
    for k in range(6, -1, -1):
        value = value * x + step_states[step, k, j]
    return value


@entry
def places(mode: int, y: Floats, p: Floats, out: Floats):
    """Places (x, y) and rotations of bodies and feet, one after the other."""
    positions(mode, y, p, out)


@entry
def corners(p: Floats, out: Floats):
    """Corners of the outlines of the bodies, and the ends of members."""
    shapes(p, out)


@entry
def energy_history(
    states: Floats2, modes: Ints, p: Floats, ground: Floats2, spacing: Floats, out: Floats2
):
    """Energies at the samples of a motion, out (5, n), as `motion` has left it.

    Kinetic, gravitational and elastic energy, each less that upright at rest, in space the
    gravitational one less its lowest; work of the ground and of declared forces since the start, by
    the trapezoidal rule on the samples; and what was lost since then, which is what these leave: at
    impacts, in dampers and by yielding.
    """
    energy, rest, power = np.empty(3), np.empty(3), np.empty(3)
    energies(modes[0], np.zeros(N_STATES), p, rest)
    if AXES == 3:  # where zero coordinates may be below the ground
        rest[1] = np.inf
        for i in range(int(spacing[1])):
            energies(modes[i], states[i], p, energy)
            rest[1] = min(rest[1], energy[1])
    work, before, start = 0.0, 0.0, 0.0
    for i in range(int(spacing[1])):
        energies(modes[i], states[i], p, energy)
        shaking = tuple(ground[axis, i] for axis in unrolled(range(AXES)))
        powers(modes[i], states[i], p, *shaking, power)
        driving, total = power[0] + power[2], 0.0
        for j in range(3):
            out[j, i] = energy[j] - rest[j]
            total += out[j, i]
        if i == 0:
            start = total
        else:
            work += 0.5 * spacing[0] * (before + driving)
        before = driving
        out[3, i], out[4, i] = work, start + work - total
