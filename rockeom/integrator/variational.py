"""Derivatives carried along a motion: one text for every structure and method.

Joined behind the loop, see `rockeom.integrator.program`, and printed for numbers with derivatives:
the steps that a motion was made of are repeated with all derivatives in them. The motion is
known by then, so that it is the same to the last bit, with derivatives or without.

Derivatives are those at a fixed time, but beside an event: it moves with the numbers that the
motion depends on, by

    tau = -dg / (dg/dt along the motion)

of the guard g that falls there; the states on both sides are followed as they move with it, through
the same transition as in the loop, and back to the fixed time by the rates on either side.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockeom.codes import GRAZES, IMPACT, LANDING, OTHER_WAY, REST, STEPPED_OVER
from rockeom.compiler.decorators import Duals, Duals2, Duals3, Floats, Ints, entry, inlined
from rockeom.integrator.full_contact import cannot_move
from rockeom.integrator.ground import (
    ground_acceleration,
    ground_accelerations,
    segment_at,
    segment_of,
)
from rockeom.integrator.provided import (
    N_ALL_STAGES,
    N_GUARDS,
    N_KNOWN,
    N_PARTS,
    N_POINTS,
    N_STATES,
    ROTATION_RATE,
    guards,
    jump,
    moving,
    rate,
    rates,
    take_step,
    value,
)
from rockeom.integrator.records import Case, Ground, Recorder, State
from rockeom.integrator.tolerances import BEND_OF_GUARD, SAME_RATES, SOON_IN_STEP
from rockeom.integrator.transitions.candidates import ground_now_and_later, pass_on
from rockeom.integrator.transitions.declared import stand, time_to_rest
from rockeom.integrator.transitions.restitution import velocity_ratio_at
from rockeom.integrator.transitions.zeno import time_of_bounces

DIGITS = 10_000.0
"""How many times the tolerance a guard must have sunk below zero, had nothing happened there:
below, less than two digits of its derivatives are known."""

# Places in the scratch array of duals, and in that of floats
_STAGES = 0
_NEW = _STAGES + N_ALL_STAGES * (N_STATES + 2)
_MOVED = _NEW + N_STATES
_BEHIND = _MOVED + N_STATES
_STATE = _BEHIND + N_STATES
_GUARD = _STATE + N_STATES
_KNOWN_POINTS = _GUARD + N_GUARDS + N_PARTS
DUALS_SIZE = _KNOWN_POINTS + N_KNOWN
FLOATS_SIZE = 4 * N_STATES


class Varied(NamedTuple):
    """The numbers of a motion with their derivatives.

    horizontal, vertical : tables of the ground motion, empty where nothing in them varies; corners
    : whether the ends of their segments do. p, ratio (1,) : as of `Case`. longest : of the steps in
    which derivatives are carried, see `go_on`.
    """

    horizontal: Duals2
    vertical: Duals2
    corners: bool
    p: Duals
    ratio: Duals
    longest: float


class Tangents(NamedTuple):
    """Where the states with their derivatives are written.

    y (N,) : at the start, and on return at the end. times (q,) : ascending, with the states (q, N)
    there. event_states (k, 2, N) : on both sides of each event, and event_times (k,), as they move.
    reached (1,) : the event up to which they are known.
    """

    times: Floats
    y: Duals
    states: Duals2
    event_states: Duals3
    event_times: Duals
    reached: Ints


class Shaken(NamedTuple):
    """The segments of the ground that hold, without and with derivatives, and how they begin.

    tau_x, tau_y : derivatives of the times at which they begin; their values are zero.
    """

    ground: Ground
    varied: Ground
    tau_x: float
    tau_y: float


@entry
def carry(
    recorder: Recorder, case: Case, varied: Varied, out: Tangents, floats: Floats, duals: Duals
) -> int:
    """Carry the state at the start with its derivatives to the end of a recorded motion.

    recorder : steps, with their dense output, and events of the motion. floats, duals : scratch.
    Returns 0, GRAZES, or OTHER_WAY where a transition is not found again.
    """
    y, start = out.y, floats[:N_STATES]
    shaken = shaken_at_the_start(case, varied)
    e = q = impacts = i = 0
    length = 0.0
    while i <= len(recorder.steps):
        last = i == len(recorder.steps)
        t = recorder.steps[i, 0] if not last else np.inf
        # -- what has happened at its start; a segment of the ground may begin there, too
        due = recorder.events.shape[0] > e and recorder.events[e] <= t
        lands = due and recorder.event_kinds[e, 0] in (IMPACT, LANDING)
        if not (lands or (last and not due)):
            mode = recorder.event_kinds[e, 1] if due else recorder.step_modes[i]
            t_event = recorder.events[e] if due else t
            shaken = next_shaken(mode, t_event, shaken, case, varied, y, floats)
        if due:
            out.reached[0] = e
            code, e, impacts, rested = pass_through(
                e, impacts, length, recorder, shaken, case, varied, out, floats, duals
            )
            if code != 0:
                return code
            if rested and not last and recorder.events[e - 1] > t:
                i += 1  # what was recorded of the time of the rest
            length = 0.0
            continue
        if last:
            break
        # -- the step itself, and parts of it up to the times that are asked for
        mode, length = recorder.step_modes[i], recorder.steps[i, 1]
        for j in range(N_STATES):
            start[j] = recorder.step_states[i, 0, j]
        put(y, start)
        still = stands_still(mode, t, shaken.ground, case.p, floats)
        q = states_within(mode, t, length, still, q, shaken.varied, case, varied, out, duals)
        if not still:
            go_on(mode, t, length, y, shaken.varied, case, varied, duals)
            for j in range(N_STATES):
                y[j] = duals[_NEW + j]
        i += 1
    while q < len(out.times):
        for j in range(N_STATES):
            out.states[q, j] = y[j]
        q += 1
    out.reached[0] = e
    return 0


@inlined
def shaken_at_the_start(case, varied):
    n_x, x, varied_x = row_behind(case.horizontal, varied.horizontal, 0, 0.0)
    n_y, y, varied_y = row_behind(case.vertical, varied.vertical, 0, 0.0)
    begins = moving(0.0, 0.0)
    return Shaken(
        Ground(n_x, x, n_y, y), Ground(n_x, varied_x, n_y, varied_y), tau_x=begins, tau_y=begins
    )


@inlined
def next_shaken(mode, t, shaken, case, varied, y, floats):
    """The segments that hold at t and after it; y where their beginnings vary."""
    n_x, x, varied_x, tau_x = shaken.ground.n_x, shaken.ground.x, shaken.varied.x, shaken.tau_x
    n_y, row_y, varied_y, tau_y = shaken.ground.n_y, shaken.ground.y, shaken.varied.y, shaken.tau_y
    if t >= x[1]:
        tau_x = varied_x[1] - value(varied_x[1])
        n_x, row, varied_x = row_behind(case.horizontal, varied.horizontal, n_x, t)
        if varied.corners:
            turn_corner(mode, t, x, row_y, row, row_y, tau_x, case.p, y, floats)
        x = row
    if t >= row_y[1]:
        tau_y = varied_y[1] - value(varied_y[1])
        n_y, row, varied_y = row_behind(case.vertical, varied.vertical, n_y, t)
        if varied.corners:
            turn_corner(mode, t, x, row_y, x, row, tau_y, case.p, y, floats)
        row_y = row
    return Shaken(
        Ground(n_x, x, n_y, row_y), Ground(n_x, varied_x, n_y, varied_y), tau_x=tau_x, tau_y=tau_y
    )


def states_within(mode, t, h, still, q, ground, case, varied, out, duals):
    """Write the states at the times within a step; returns the number of the next time."""
    y_new = duals[_NEW:_MOVED]
    while q < len(out.times) and out.times[q] < t + h:
        part = out.times[q] - t
        if part > 0.0 and not still:
            go_on(mode, t, part, out.y, ground, case, varied, duals)
        else:
            for j in range(N_STATES):
                y_new[j] = out.y[j]
        for j in range(N_STATES):
            out.states[q, j] = y_new[j]
        q += 1
    return q


def go_on(mode, t, h, y, ground, case, varied, duals):
    """A step of the motion with its derivatives, from y into duals[_NEW:], in parts.

    A state that does not vibrate has no error in a step, however long it is; its derivatives would
    grow there by as much as the step is longer than stability allows. So parts are at most
    `varied.longest`.
    """
    k, here, y_new = duals[_STAGES:_NEW], duals[_MOVED:_BEHIND], duals[_NEW:_MOVED]
    parts = 1 + int(h / varied.longest)
    part = h / parts
    for j in range(N_STATES):
        y_new[j] = y[j]
    for i in range(parts):
        for j in range(N_STATES):
            here[j] = y_new[j]
        now = t + i * part
        ax, ay = ground_accelerations(ground, now)
        rates(mode, here, varied.p, ax, ay, k)
        take_step(
            mode, now, part, here, varied.p, ground.x, ground.y, case.rtol, case.atol, k, y_new
        )


def stands_still(mode, t, ground, p, floats):
    """Whether nothing can move in a step from the state floats[:N], nor its derivatives."""
    start, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    for j in range(N_STATES // 2, N_STATES):
        if start[j] != 0.0:
            return False
    ax, ay = ground_accelerations(ground, t)
    rates(mode, start, p, ax, ay, rate_there)
    return cannot_move(mode, rate_there, start, p)


def row_behind(table, varied_table, n, t):
    """(n, row, row with its derivatives) of the segment that holds at t and after it.

    A table with derivatives that is empty changes nothing.
    """
    n, row = segment_at(table, n, t)
    if n < varied_table.shape[0]:
        return n, row, segment_of(varied_table, n)
    return n, row, row


def pass_through(e, impacts, length, recorder, shaken, case, varied, out, floats, duals):
    """(code, event, impacts, rested): pass through event e and those that follow at its instant.

    Returns the event that is next, and whether infinitely many impacts were the last.
    """
    y, ground = out.y, shaken.ground
    before, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    moved, behind = duals[_MOVED:_BEHIND], duals[_BEHIND:_STATE]
    t, mode = recorder.events[e], recorder.event_kinds[e, 1]
    if recorder.event_kinds[e, 3] == STEPPED_OVER:
        return GRAZES, e, impacts, False
    for j in range(N_STATES):
        before[j] = recorder.event_states[e, 0, j]
    put(y, before)
    ax, ay = ground_accelerations(ground, t)
    rates(mode, before, case.p, ax, ay, rate_there)
    code, tau = moves_by(e, length, recorder, shaken, case, varied, y, floats, duals)
    if code != 0:
        return code, e, impacts, False
    for j in range(N_STATES):
        moved[j] = y[j] + rate_there[j] * tau
    rested = False
    while True:
        kind = recorder.event_kinds[e, 0]
        rested = kind == REST
        if recorder.event_kinds[e, 3] == STEPPED_OVER:
            return GRAZES, e, impacts, False
        if rested:  # after the last impact, at t
            rests, follows = comes_to_rest(
                e, t + tau, impacts, recorder, shaken.varied, case, varied, duals
            )
            tau += rests - value(rests)
            t = recorder.events[e]
        else:
            follows = passed(
                e, t + tau, length, impacts, recorder, shaken.varied, case, varied, duals
            )
        if follows != recorder.event_kinds[e, 2]:
            return OTHER_WAY, e, impacts, rested
        out.event_times[e] = t + tau
        for j in range(N_STATES):
            out.event_states[e, 0, j] = moved[j]
            before[j] = recorder.event_states[e, 1, j]
        put(behind, before)
        for j in range(N_STATES):
            out.event_states[e, 1, j] = moved[j] = behind[j]
        if kind in (IMPACT, LANDING):
            impacts += 1
        e += 1
        more = e < recorder.events.shape[0]
        if not (more and (recorder.events[e] == t or recorder.event_kinds[e, 0] == REST)):
            break
    ax, ay = ground_accelerations(ground, t)
    rates(follows, before, case.p, ax, ay, rate_there)
    for j in range(N_STATES):
        y[j] = moved[j] - rate_there[j] * tau
    return 0, e, impacts, rested


def moves_by(e, length, recorder, shaken, case, varied, y, floats, duals):
    """(code, tau): the derivatives of the time of an event.

    It is a segment of the ground that begins, the start of the motion, or a guard that falls.
    """
    t, mode, guard = recorder.events[e], recorder.event_kinds[e, 1], recorder.event_kinds[e, 3]
    ground, p = shaken.ground, case.p
    begins = recorder.event_kinds[e, 0] not in (IMPACT, LANDING)
    if begins and t == ground.x[0]:
        return 0, shaken.tau_x
    if begins and t == ground.y[0]:
        return 0, shaken.tau_y
    still = moving(0.0, 0.0)
    if t == 0.0:
        return 0, still
    g, state = duals[_GUARD:_KNOWN_POINTS], duals[_STATE:_GUARD]
    before, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    later, rate_soon = floats[2 * N_STATES : 3 * N_STATES], floats[3 * N_STATES :]
    # how fast the guard falls, and how fast that changes
    falls = rate_along_motion(mode, guard, t, before, rate_there, ground, p, state, g)
    ahead = BEND_OF_GUARD * length
    for j in range(N_STATES):
        later[j] = before[j] + ahead * rate_there[j]
    soon = t + ahead
    ax, ay = ground_accelerations(ground, soon)
    rates(mode, later, p, ax, ay, rate_soon)
    after = rate_along_motion(mode, guard, soon, later, rate_soon, ground, p, state, g)
    for j in range(N_STATES):
        later[j] = case.atol[j] + case.rtol * abs(before[j])
    ax, ay = ground_accelerations(ground, t)
    grain = abs(guard_along(mode, guard, before, later, ax, ay, p, state, g))
    # where it falls faster and faster it comes from where it was open: a short hop is no graze
    bends = max(after - falls, 0.0) / ahead if ahead > 0.0 else 0.0
    if not falls < 0.0 or falls * falls <= DIGITS * grain * bends:
        # its time is not known; where nothing changes there, none is asked for
        return (0 if goes_on(e, t, ground, p, recorder, floats) else GRAZES), still
    now = shaken.varied
    guards(mode, y, varied.p, ground_acceleration(now.x, t), ground_acceleration(now.y, t), g)
    return 0, (value(g[guard]) - g[guard]) / falls


def rate_along_motion(mode, guard, t, y, dy, ground, p, state, g):
    """How fast a guard changes along the motion."""
    now = moving(t, 1.0)
    ax, ay = ground_accelerations(ground, now)
    return guard_along(mode, guard, y, dy, ax, ay, p, state, g)


def guard_along(mode, guard, y, dy, ax, ay, p, state, g):
    """How fast a guard changes where the state does so by dy."""
    for j in range(N_STATES):
        state[j] = moving(y[j], dy[j])
    guards(mode, state, p, ax, ay, g)
    return rate(g[guard])


def goes_on(e, t, ground, p, recorder, floats):
    """Whether neither the state nor its rates change at an event."""
    y, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    rate_behind = floats[2 * N_STATES : 3 * N_STATES]
    for j in range(N_STATES):
        y[j] = recorder.event_states[e, 1, j]
    ax, ay = ground_accelerations(ground, t)
    rates(recorder.event_kinds[e, 2], y, p, ax, ay, rate_behind)
    same = True
    for j in range(N_STATES):
        y[j] = recorder.event_states[e, 0, j]
        same = same and recorder.event_states[e, 1, j] == y[j]
        size = abs(rate_there[j]) + abs(rate_behind[j])
        same = same and abs(rate_behind[j] - rate_there[j]) <= SAME_RATES * size
    return same


@inlined
def passed(e, now, length, impacts, recorder, ground, case, varied, duals):
    """The mode after an event, as in the loop; the state there into duals[_BEHIND:].

    now : the time of the event, with its derivatives. The state before is in duals[_MOVED:].
    """
    mode, guard = recorder.event_kinds[e, 1], recorder.event_kinds[e, 3]
    y, out, p = duals[_MOVED:_BEHIND], duals[_BEHIND:_STATE], varied.p
    if N_POINTS == 0:
        ratio = velocity_ratio_at(case.law, varied.ratio[0], impacts, y[ROTATION_RATE], p)
        follows = jump(mode, guard, case.law, ratio, y, p, out)
    else:
        ahead, known = SOON_IN_STEP * length, duals[_KNOWN_POINTS:]
        ax, ay = ground_accelerations(ground, now)
        later_ax, later_ay = ground_accelerations(ground, value(now) + ahead)
        accelerations = np.empty(5)
        ground_now_and_later(ax, ay, later_ax, later_ay, ahead, accelerations)
        follows, _ = pass_on(mode, guard, length, y, p, accelerations, case.rtol, known, out)
    return follows


@inlined
def comes_to_rest(e, now, impacts, recorder, ground, case, varied, duals):
    """(time, mode) of infinitely many impacts, as in the loop; the state there in duals[_BEHIND:].

    duals[_MOVED:] : the state at the last recorded impact, on return that before they have ended.
    now : the time of that impact, with its derivatives.
    """
    mode, tolerance, p = recorder.event_kinds[e, 1], case.rest_tolerance, varied.p
    y, out, stands = duals[_MOVED:_BEHIND], duals[_BEHIND:_STATE], duals[_NEW:_MOVED]
    ax, ay = ground_accelerations(ground, now)
    if N_POINTS > 0:
        known = duals[_KNOWN_POINTS:]
        rests, follows = time_of_bounces(
            State(mode, y, p, ax, ay), tolerance, case.rtol, known, out
        )
    else:
        rests, follows = time_to_rest(
            mode, y, p, case.law, varied.ratio[0], impacts, ax, ay, tolerance, stands
        )
        stand(
            follows, now, rests, stands, p, ground, case.rtol, case.atol, duals[_STAGES:_NEW], out
        )
        for j in range(N_STATES):
            y[j] += out[j] - stands[j]  # there, had the impacts not faded yet
    return rests, follows


def turn_corner(mode, t, gx, gy, new_x, new_y, tau, p, y, floats):
    """The state where one segment of the ground ends and another begins, at a time that varies."""
    here, before = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    behind = floats[2 * N_STATES : 3 * N_STATES]
    for j in range(N_STATES):
        here[j] = value(y[j])
    rates(mode, here, p, ground_acceleration(gx, t), ground_acceleration(gy, t), before)
    rates(mode, here, p, ground_acceleration(new_x, t), ground_acceleration(new_y, t), behind)
    for j in range(N_STATES):
        y[j] += (before[j] - behind[j]) * tau


@inlined
def put(y, values):
    """Give numbers other values, and leave their derivatives."""
    for j in range(N_STATES):
        y[j] = values[j] + (y[j] - value(y[j]))
