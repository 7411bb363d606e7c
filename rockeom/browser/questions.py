"""The questions that a page asks of its program: a motion, its end, and where the bodies are.

This text is joined to others, behind the set-up; see `rockeom.browser.page`.
"""

from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import (
    AT_THE_START,
    CAME_TO_REST,
    COMPLETED,
    EVENTS_KEPT,
    FULL,
    IMPACT,
    IMPACTS,
    LANDING,
    MODE,
    OVERTURNED,
    STEPS_KEPT,
)
from rockeom.compiler.decorators import Floats, Floats2, Ints, entry

if TYPE_CHECKING:  # joined before this text
    from rockeom.browser.verdict import uplift_and_friction
    from rockeom.browser.written import MOST_P, ROWS_X, ROWS_Y, set_up
    from rockeom.integrator.batches import at_rest, falls
    from rockeom.integrator.extremes import widen
    from rockeom.integrator.ground import ground_acceleration, segment_for
    from rockeom.integrator.interface import N_STATES, positions, shapes
    from rockeom.integrator.loop import SCRATCH, integrate
    from rockeom.integrator.records import Case, Recorder

UNKNOWN_WAY = -1
RTOL, ATOL = 1e-8, 1e-10
MOST_IMPACTS, MOST_STEPS = 100000, 200000
KEPT = 256
"""Steps in a record before it is emptied."""

NUMBERS = 11
(
    OF_MODE, OF_LAW, OF_RATIO, OF_FALLEN, OF_END, OF_QUIET, OF_ROWS_X, OF_ROWS_Y, OF_SIZE,
    OF_UPLIFT, OF_FRICTION,
) = range(NUMBERS)  # fmt: skip
"""Places in the numbers of a problem: OF_ROWS_X and OF_ROWS_Y are the rows of the ground motions,
OF_SIZE the length of p. OF_UPLIFT and OF_FRICTION follow from them, see `verdict`."""


def case_of_page(numbers, p, horizontal, vertical, atol):
    """The case that a set-up has written."""
    return Case(
        numbers[OF_END],
        horizontal[0 : int(numbers[OF_ROWS_X])],
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
    free = case._replace(horizontal=still, vertical=still)
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
    sliders: Floats, p: Floats, numbers: Floats, states: Floats2, modes: Ints, ground: Floats,
    impacts: Floats, spacing: Floats,
) -> int:  # fmt: skip
    """A motion at equal times: its outcome, or -1 where no way of the set-up is known.

    states (n, N), modes (n,), ground (n,) : at each. impacts (k,) : times of the first ones.
    spacing (4,) : of the times; how many there are, of impacts, and of impacts that are noted.
    """
    y, horizontal = np.empty(N_STATES), np.empty((ROWS_X, 7))
    vertical, atol, rate = np.empty((ROWS_Y, 7)), np.empty(N_STATES), np.empty(N_STATES)
    if set_up(sliders, y, p, horizontal, vertical, numbers) < 0:
        return UNKNOWN_WAY
    status, clock = np.empty(len(AT_THE_START), np.int64), np.empty(4)
    begin(numbers, status, clock, rate, atol)
    case = case_of_page(numbers, p, horizontal, vertical, atol)
    steps, step_modes = np.empty((KEPT, 2)), np.empty(KEPT, np.int64)
    step_states = np.empty((KEPT, 8, N_STATES))
    events, event_kinds = np.empty(KEPT), np.empty((KEPT, 4), np.int64)
    recorder = Recorder(
        steps, step_modes, step_states, events, event_kinds, np.empty((KEPT, 2, N_STATES)),
        np.empty((0, N_STATES)),
    )  # fmt: skip
    numbers[OF_UPLIFT], numbers[OF_FRICTION] = uplift_and_friction(case.p)
    n = states.shape[0]
    between = case.t_end / (n - 1)
    scratch = np.zeros(SCRATCH)
    code, at, noted = FULL, 0, 0
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
            if (kind in (IMPACT, LANDING)) and noted < impacts.shape[0]:
                impacts[noted] = events[i]
                noted = noted + 1
    row = 0
    for i in range(n):
        row, found = segment_for(case.horizontal, row, i * between)
        ground[i] = ground_acceleration(found, i * between)
    spacing[0], spacing[1] = between, float(at)
    spacing[2], spacing[3] = float(status[IMPACTS]), float(noted)
    return ended(code, status, y, case, numbers[OF_QUIET])


def state_at(step_states, step, j, x):
    """State j within a step, at x in [0, 1]."""
    value = step_states[step, 7, j]
    for k in range(6, -1, -1):
        value = value * x + step_states[step, k, j]
    return value


@entry
def fate(sliders: Floats, extremes: Floats2) -> int:
    """The outcome of a motion, and the extremes (2, N) of its states; -1 for an unknown way."""
    y, p, numbers = np.empty(N_STATES), np.empty(MOST_P), np.empty(NUMBERS)
    horizontal, vertical = np.empty((ROWS_X, 7)), np.empty((ROWS_Y, 7))
    atol, rate = np.empty(N_STATES), np.empty(N_STATES)
    if set_up(sliders, y, p, horizontal, vertical, numbers) < 0:
        return UNKNOWN_WAY
    status, clock = np.empty(len(AT_THE_START), np.int64), np.empty(4)
    begin(numbers, status, clock, rate, atol)
    case = case_of_page(numbers, p, horizontal, vertical, atol)
    events, event_kinds = np.empty(64), np.empty((64, 4), np.int64)
    recorder = Recorder(
        np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1)), events, event_kinds,
        np.empty((64, 2, N_STATES)), extremes,
    )  # fmt: skip
    widen(extremes, y)
    for i in range(N_STATES):
        extremes[0, i] = extremes[1, i] = y[i]
    scratch, code = np.zeros(SCRATCH), FULL
    while code == FULL:
        status[EVENTS_KEPT] = 0
        code = integrate(status, clock, y, rate, case, recorder, scratch)
    return ended(code, status, y, case, numbers[OF_QUIET])


@entry
def places(mode: int, y: Floats, p: Floats, out: Floats):
    """Places (x, y) and rotations of bodies and feet, one after the other."""
    positions(mode, y, p, out)


@entry
def corners(p: Floats, out: Floats):
    """Corners of the outlines of the bodies, and the ends of members."""
    shapes(p, out)
