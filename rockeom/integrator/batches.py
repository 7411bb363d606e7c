"""Motions that are only counted: many one after the other, and whether a motion ends in a fall.

This text is joined to others, see `rockeom.integrator.program`.
"""

from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import (
    AT_THE_START,
    CAME_TO_REST,
    COMPLETED,
    CONTACT,
    ENERGY_ROUNDING,
    EVENTS_KEPT,
    FULL,
    IMPACT,
    IMPACTS,
    LANDING,
    OVERTURNED,
    STEPS,
    STEPS_KEPT,
)
from rockeom.compiler.decorators import Floats, Floats2, Floats3, Ints, Ints2, entry, inlined

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.extremes import widen
    from rockeom.integrator.ground import ground_acceleration, segment_for
    from rockeom.integrator.interface import (
        KINDS,
        N_STATES,
        ROTATION_RATE,
        SIDES,
        energies,
        kinematics,
        reactions,
        standing,
    )
    from rockeom.integrator.loop import _GUARDS, _POWERS, SCRATCH, TURN, integrate
    from rockeom.integrator.overturning import leans_most, own_time


@entry
def at_rest(contact: int, y: Floats, p: Floats) -> bool:
    """Full contact, and a kinetic energy below a billionth of the weight's potential energy."""
    if not standing(contact, y, p):
        return False
    energy = np.empty(3)
    energies(contact, y, p, energy)
    return energy[0] <= 1e-9 * abs(energy[1])


@entry
def falls(
    contact: int, y: Floats, still: Floats2, p: Floats, law: int, ratio: float, rtol: float,
    atol: Floats, fallen: float, max_impacts: int, max_steps: int, reach: float,
) -> bool:  # fmt: skip
    """Whether free motion from here leads to the ground, and not back upright.

    It is followed until the next impact, or, on springs, while the structure leans further and has
    not been upright; `reach` [s] is how long at a time; `still` the table of ground that is.
    """
    if standing(contact, y, p):
        return False
    rocks = SIDES[contact] != 0.0 and KINDS[contact][0] == IMPACT
    if rocks:
        # a rocking motion has a time of its own, in which it comes back or falls
        reach = max(reach, 10.0 * own_time(contact, y, p))
    steps, step_contact, step_states = np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1))
    events, event_kinds = np.empty(64), np.empty((64, 4), np.int64)
    event_states = np.empty((64, 2, N_STATES))
    peaks = np.empty((2, N_STATES))
    status = np.empty(len(AT_THE_START), np.int64)
    for i in range(len(AT_THE_START)):
        status[i] = AT_THE_START[i]
    status[CONTACT] = contact
    rate, scratch = np.empty(N_STATES), np.zeros(SCRATCH)
    clock = np.zeros(4)
    state = np.empty(N_STATES)
    for i in range(N_STATES):
        state[i] = y[i]
    lean = 0.0
    followed = 0 if rocks else 2  # how it leans between calls is looked at on springs only
    for n in range(1000):
        for i in range(N_STATES):
            peaks[0, i] = peaks[1, i] = state[i]
        if n == 0:
            _, lean = leans_most(peaks, fallen, p)
        status[STEPS_KEPT] = status[EVENTS_KEPT] = 0
        code = integrate(
            status, clock, state, rate, (n + 1) * reach, still, still, p, law, ratio, rtol, atol,
            np.inf, 0, fallen, 1e-6, 0 if rocks else max_impacts, max_steps,
            steps, step_contact, step_states, events, event_kinds, event_states, peaks[:followed],
            scratch,
        )  # fmt: skip
        leaning, leans = leans_most(peaks, fallen, p)
        upright = peaks[0, leaning] < 0.0 < peaks[1, leaning]
        if code == OVERTURNED and not upright:
            return True
        if code not in (COMPLETED, FULL):
            return False
        if not rocks:
            if upright or (n > 0 and leans <= lean):
                return False
            lean = leans
    return False


@entry
def integrate_many(
    first: int, status: Ints2, clock: Floats2, states: Floats2, rates: Floats2, t_end: Floats,
    quiet_from: Floats, horizontal: Floats2, h_rows: Ints2, vertical: Floats2, v_rows: Ints2,
    p: Floats2, law: Ints, ratio: Floats, rtol: float, atol: Floats, h_max: float, fixed: int,
    fallen: Floats, rest_tolerance: float, max_impacts: int, max_steps: int, outcome: Ints,
    peaks: Floats3, impact_times: Floats2, gains: Floats2,
) -> int:  # fmt: skip
    """Integrate n motions one after the other, keeping the end, the peaks and the impacts.

    first : the motion to go on with. Returns the one that the next call goes on with: n if there is
    none, less if a TURN is over.
    status (n, 10), clock (n, 4), states and rates (n, N) as in `integrate`, at the start, and on
    return at the end. horizontal, vertical : the rows of all motions, those of motion i from
    h_rows[i, 0] to h_rows[i, 1]. t_end, quiet_from, law, ratio, fallen (n,), p (n, m). outcome
    (n,): FULL, or that of a motion that has ended. impact_times (n, k): the first k of each.
    gains (n, 2): see `add_gain`.
    """
    steps, step_contact, step_states = np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1))
    events, event_kinds = np.empty(64), np.empty((64, 4), np.int64)
    event_states = np.empty((64, 2, N_STATES))
    scratch = np.zeros(SCRATCH)
    left = TURN
    for n in range(first, len(states)):
        if left < 0:
            return n
        y = states[n]
        widen(peaks[n], y)
        noted = status[n, IMPACTS]
        code = outcome[n]
        while code == FULL:
            if left < 0:
                return n
            status[n, EVENTS_KEPT] = 0
            left += status[n, STEPS]
            code = integrate(
                status[n], clock[n], y, rates[n], t_end[n], horizontal[h_rows[n, 0] : h_rows[n, 1]],
                vertical[v_rows[n, 0] : v_rows[n, 1]], p[n], law[n], ratio[n], rtol, atol, h_max,
                fixed, fallen[n], rest_tolerance, max_impacts, max_steps,
                steps, step_contact, step_states, events, event_kinds, event_states, peaks[n],
                scratch,
            )  # fmt: skip
            left -= status[n, STEPS]
            for e in range(status[n, EVENTS_KEPT]):
                if event_kinds[e, 0] != IMPACT and event_kinds[e, 0] != LANDING:
                    continue
                if noted < impact_times.shape[1]:
                    impact_times[n, noted] = events[e]
                    noted += 1
                add_gain(
                    event_kinds[e, 1],
                    event_kinds[e, 2],
                    event_states[e, 0],
                    event_states[e, 1],
                    p[n],
                    scratch[_POWERS:_GUARDS],
                    gains[n],
                )
        if code == COMPLETED and quiet_from[n] <= t_end[n]:
            reach = 0.1 * t_end[n]
            if falls(
                status[n, CONTACT], y, horizontal[:0], p[n], law[n], ratio[n], rtol, atol,
                fallen[n], max_impacts, max_steps, reach,
            ):  # fmt: skip
                code = OVERTURNED
            elif at_rest(status[n, CONTACT], y, p[n]):
                code = CAME_TO_REST
        outcome[n] = code
    return len(states)


@inlined
def add_gain(before, after, arriving, leaving, p, energy, gains):
    """Count an impact that gains kinetic energy beyond rounding, and add what it gains.

    before, after : contact states; arriving, leaving (N,) : the states. energy : scratch.
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
    contacts: Ints, t: Floats, states: Floats2, horizontal: Floats2, vertical: Floats2, p: Floats,
    energy: Floats2, force: Floats2, motion: Floats2,
):  # fmt: skip
    """Energies, reactions and kinematics (columns of the last three) at every sample."""
    nx = ny = 0
    for n in range(t.shape[0]):
        nx, gx = segment_for(horizontal, nx, t[n])
        ny, gy = segment_for(vertical, ny, t[n])
        ax, ay = ground_acceleration(gx, t[n]), ground_acceleration(gy, t[n])
        energies(contacts[n], states[n], p, energy[n])
        reactions(contacts[n], states[n], p, ax, ay, force[n])
        kinematics(contacts[n], states[n], p, motion[n])
