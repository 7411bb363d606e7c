"""Motions that are only counted: many one after the other, and whether a motion ends in a fall."""

import numpy as np

from rockeom.codes import (
    AT_THE_START,
    CAME_TO_REST,
    COMPLETED,
    ENERGY_ROUNDING,
    EVENTS_KEPT,
    FULL,
    IMPACT,
    IMPACTS,
    LANDING,
    MODE,
    OVERTURNED,
    STEPS,
    STEPS_KEPT,
)
from rockeom.compiler.decorators import Floats, Floats2, Ints, entry, inlined, unrolled
from rockeom.integrator.extremes import leans_most, own_time
from rockeom.integrator.ground import ground_accelerations, rows_after, segment_for, tables
from rockeom.integrator.loop import _GUARDS, _POWERS, SCRATCH, TURN, integrate
from rockeom.integrator.provided import (
    AXES,
    BENT,
    N_GUARDS,
    N_PARTS,
    N_STATES,
    ROTATION,
    ROTATION_RATE,
    STILL,
    energies,
    guards,
    is_tilt,
    kind_of,
    kinematics,
    reactions,
    side_of,
    standing,
)
from rockeom.integrator.records import Batch, Case, Motions, Recorder
from rockeom.integrator.tolerances import AT_REST, REST_AFTER_MOTION, TURNED_BACK


@entry
def at_rest(mode: int, y: Floats, p: Floats) -> bool:
    """Full contact, and a kinetic energy below a billionth of the weight's potential energy."""
    if not standing(mode, y, p):
        return False
    energy = np.empty(3)
    energies(mode, y, p, energy)
    return energy[0] <= AT_REST * abs(energy[1])


@entry
def falls(mode: int, y: Floats, case: Case, reach: float) -> bool:
    """Whether free motion from here leads to the ground, and not back upright.

    It is followed until the next impact, or, on springs, while the structure leans further and has
    not been upright. case : with tables of ground that does not shake. reach [s] : how long at a
    time.
    """
    if standing(mode, y, case.p):
        return False
    rocks = side_of(mode) != 0.0 and kind_of(mode, 0) == IMPACT
    free = case
    if rocks:
        # a rocking motion has a time of its own, in which it comes back or falls
        reach = max(reach, 10.0 * own_time(mode, y, case.p))
        free = free._replace(max_impacts=0)
    events, event_kinds = np.empty(64), np.empty((64, 4), np.int64)
    event_states, extremes = np.empty((64, 2, N_STATES)), np.empty((2, N_STATES))
    # free motion of a tilt and a direction is periodic: where it has turned back, it will again
    wobbles = rocks and AXES == 3 and N_STATES == 4
    # how it leans between calls is looked at on springs, and where it may pass flat without impact
    followed = 0 if rocks and not wobbles else 2
    recorder = Recorder(
        np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1)),
        events, event_kinds, event_states, extremes[:followed],
    )  # fmt: skip
    status = np.empty(len(AT_THE_START), np.int64)
    for i in range(len(AT_THE_START)):
        status[i] = AT_THE_START[i]
    status[MODE] = mode
    rate, scratch = np.empty(N_STATES), np.zeros(SCRATCH)
    clock = np.zeros(4)
    state = np.empty(N_STATES)
    for i in range(N_STATES):
        state[i] = y[i]
    lean = 0.0
    for n in range(1000):
        before = abs(state[ROTATION])
        for i in range(N_STATES):
            extremes[0, i] = extremes[1, i] = state[i]
        if n == 0:
            _, lean = leans_most(extremes, case.fallen, case.p)
            lean = tilt_of(state, case.p) if BENT else lean
        status[STEPS_KEPT] = status[EVENTS_KEPT] = 0
        free = free._replace(t_end=(n + 1) * reach)
        code = integrate(status, clock, state, rate, free, recorder, scratch)
        leaning, leans = leans_most(extremes, case.fallen, case.p)
        upright = extremes[0, leaning] < 0.0 < extremes[1, leaning] and not wobbles
        if BENT:
            leans, upright = tilt_of(state, case.p), False
        if code == OVERTURNED and not upright:
            return True
        if code not in (COMPLETED, FULL):
            return False
        if wobbles and leans > (1.0 + TURNED_BACK) * max(before, abs(state[ROTATION])):
            return False
        if not rocks:
            if upright or (n > 0 and leans <= lean):
                return False
            lean = leans
    return False


def tilt_of(y, p):
    """How far a body in space leans, by its bound of tilt: the more, the larger it is."""
    g, leans, in_flight = np.empty(N_GUARDS + N_PARTS), -np.inf, 0  # where no forces are sought
    guards(in_flight, y, p, *STILL, g)
    for i in range(N_GUARDS):
        leans = max(leans, -g[i]) if is_tilt(in_flight, i) else leans
    return leans


@entry
def integrate_many(first: int, batch: Batch) -> int:
    """Integrate motions one after the other, keeping the end, the extremes and the impacts.

    first : the motion to go on with. Returns the one that the next call goes on with: n if there is
    none, less if a TURN is over.
    """
    events, event_kinds = np.empty(64), np.empty((64, 4), np.int64)
    event_states = np.empty((64, 2, N_STATES))
    steps, step_modes, step_states = np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1))
    scratch = np.zeros(SCRATCH)
    left = TURN
    for n in range(first, len(batch.states)):
        if left < 0:
            return n
        y, status = batch.states[n], batch.status[n]
        case = case_of(
            batch, n, batch.t_end[n],
            batch.horizontal[batch.h_rows[n, 0] : batch.h_rows[n, 1]],
            batch.transverse[batch.t_rows[n, 0] : batch.t_rows[n, 1]],
            batch.vertical[batch.v_rows[n, 0] : batch.v_rows[n, 1]],
        )  # fmt: skip
        recorder = Recorder(
            steps, step_modes, step_states, events, event_kinds, event_states, batch.extremes[n]
        )
        code = batch.outcome[n]
        while code == FULL:
            if left < 0:
                return n
            status[EVENTS_KEPT] = 0
            left += status[STEPS]
            before = status[IMPACTS]
            code = integrate(status, batch.clock[n], y, batch.rates[n], case, recorder, scratch)
            left -= status[STEPS]
            count_impacts(batch, n, before, recorder, scratch[_POWERS:_GUARDS])
        if code == COMPLETED and batch.quiet_from[n] <= batch.t_end[n]:
            free = case._replace(
                horizontal=rows_after(case.horizontal),
                transverse=rows_after(case.transverse),
                vertical=rows_after(case.vertical),
                h_max=np.inf,
                fixed=0,
                rest_tolerance=REST_AFTER_MOTION,
            )
            if falls(status[MODE], y, free, 0.1 * batch.t_end[n]):
                code = OVERTURNED
            elif at_rest(status[MODE], y, case.p):
                code = CAME_TO_REST
        batch.outcome[n] = code
    return len(batch.states)


@inlined
def case_of(batch, n, t_end, horizontal, transverse, vertical):
    """Motion n of a batch, with its segments, until a time."""
    return Case(
        t_end, horizontal, transverse, vertical, batch.p[n], batch.law[n], batch.ratio[n],
        batch.rtol, batch.atol, batch.h_max, batch.fixed, batch.fallen[n], batch.rest_tolerance,
        batch.max_impacts, batch.max_steps,
    )  # fmt: skip


def count_impacts(batch, n, before, recorder, energy):
    """Note the times of the impacts that a call of `integrate` recorded, and what they gain.

    before : how many there were. energy : scratch.
    """
    noted = before
    for e in range(batch.status[n, EVENTS_KEPT]):
        kind = recorder.event_kinds[e, 0]
        if kind != IMPACT and kind != LANDING:
            continue
        if noted < batch.impact_times.shape[1]:
            batch.impact_times[n, noted] = recorder.events[e]
            noted += 1
        add_gain(
            recorder.event_kinds[e, 1],
            recorder.event_kinds[e, 2],
            recorder.event_states[e, 0],
            recorder.event_states[e, 1],
            batch.p[n],
            energy,
            batch.gains[n],
        )


@inlined
def add_gain(before, after, arriving, leaving, p, energy, gains):
    """Count an impact that gains kinetic energy beyond rounding, and add what it gains.

    before, after : modes; arriving, leaving (N,) : the states. energy : scratch.
    gains (2,) : number of such impacts, and the sum of what they gain [J].
    """
    # a single coordinate has one inertia on both feet: its speed says it, sooner
    if N_STATES == 2 and not abs(leaving[ROTATION_RATE]) > abs(arriving[ROTATION_RATE]):
        return
    energies(before, arriving, p, energy)
    kinetic = energy[0]
    energies(after, leaving, p, energy)
    if energy[0] > kinetic * (1.0 + ENERGY_ROUNDING):
        gains[0] += 1.0
        gains[1] += energy[0] - kinetic


@entry
def evaluate(
    modes: Ints, t: Floats, states: Floats2, shaken: Motions, p: Floats, energy: Floats2,
    force: Floats2, motion: Floats2,
):  # fmt: skip
    """Energies, reactions and kinematics (columns of the last three) at every sample."""
    motions, numbers = tables(shaken), tuple(0 for _ in unrolled(range(AXES)))
    for n in range(t.shape[0]):
        ground = tuple(
            segment_for(motions[axis], numbers[axis], t[n]) for axis in unrolled(range(AXES))
        )
        numbers = tuple(ground[axis].number for axis in unrolled(range(AXES)))
        energies(modes[n], states[n], p, energy[n])
        reactions(modes[n], states[n], p, *ground_accelerations(ground, t[n]), force[n])
        kinematics(modes[n], states[n], p, motion[n])
