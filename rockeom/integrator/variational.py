"""Derivatives carried along a motion: one text for every structure and method.

Joined behind the loop, see `rockeom.integrator.program`, and printed for numbers with derivatives:
the steps that a motion was made of are taken once more, with all derivatives in them. What moved
is known by then, so that the motion itself is the same to the last bit, with or without.

Derivatives are those at a fixed time, but beside an event: it moves with the numbers that the
motion depends on, by

    tau = -dg / (dg/dt along the motion)

of the guard g that falls there; the states on both sides are followed as they move with it, through
the same passage as in the loop, and taken back to the fixed time by the rates on either side.
"""

from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import GRAZES, IMPACT, LANDING, OTHER_WAY, REST, STEPPED_OVER
from rockeom.compiler.decorators import (
    Duals,
    Duals2,
    Duals3,
    Floats,
    Floats2,
    Floats3,
    Ints,
    Ints2,
    entry,
    inlined,
)

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.full_contact import cannot_move
    from rockeom.integrator.ground import ground_acceleration, segment_at, segment_of
    from rockeom.integrator.interface import (
        N_ALL_STAGES,
        N_GUARDS,
        N_PARTS,
        N_POINTS,
        N_STATES,
        guards,
        jump,
        moving,
        rate,
        rates,
        take_step,
        value,
    )
    from rockeom.integrator.transitions.declared import ratio_at, stand, time_to_rest
    from rockeom.integrator.transitions.searched import N_KNOWN, pass_on
    from rockeom.integrator.transitions.zeno import time_of_bounces

DIGITS = 1e4
"""How many times the tolerance a guard must have sunk below zero, had nothing happened there:
below, less than two digits of its derivatives are known."""

# Places in the scratch array of duals, and in that of floats
_STAGES = 0
_NEW = _STAGES + N_ALL_STAGES * (N_STATES + 2)
_MOVED = _NEW + N_STATES
_BEHIND = _MOVED + N_STATES
_STATE = _BEHIND + N_STATES
_KICK = _STATE + N_STATES
_GUARD = _KICK + 2 * N_STATES
_TOLD = _GUARD + N_GUARDS + N_PARTS
DUALS_SIZE = _TOLD + N_KNOWN
FLOATS_SIZE = 4 * N_STATES


@entry
def carry(
    steps: Floats2, step_contact: Ints, step_states: Floats3, events: Floats, event_kinds: Ints2,
    event_states: Floats3, horizontal: Floats2, vertical: Floats2, dual_horizontal: Duals2,
    dual_vertical: Duals2, corners: bool, p: Floats, dual_p: Duals, law: int, dual_ratio: Duals,
    rtol: float, atol: Floats, rest_tolerance: float, longest: float, times: Floats, y: Duals,
    found: Duals2, event_y: Duals3, event_t: Duals, floats: Floats, duals: Duals, told: Ints,
) -> int:  # fmt: skip
    """Carry y, the state at the start with its derivatives, to the end of a motion.

    steps to event_states : the record of the motion, see `integrate`, step_states that of dense
    outputs. horizontal to rest_tolerance : what it was integrated with; corners : whether ends of
    laws of the ground move. longest : of the steps of derivatives, see `go_on`. found (q, N) : the
    state at the times (q,), which ascend. event_y (k, 2, N), event_t (k,) : the states on both
    sides of each event, and its time, as they move. floats, duals : scratch. told (1,) : the event
    to which it has come.
    Returns 0, GRAZES, or OTHER_WAY where a passage is not found again.
    """
    y_new = duals[_NEW:_MOVED]
    start = floats[:N_STATES]
    nx, gx, dual_gx = row_behind(horizontal, dual_horizontal, 0, 0.0)
    ny, gy, dual_gy = row_behind(vertical, dual_vertical, 0, 0.0)
    tau_x = tau_y = moving(0.0, 0.0)
    e = q = impacts = 0
    i = 0
    length = 0.0
    while i <= len(steps):
        last = i == len(steps)
        t = steps[i, 0] if not last else np.inf
        # -- what has happened at its start; a law of the ground may begin there, too
        due = events.shape[0] > e and events[e] <= t
        t_event = events[e] if due else t
        lands = due and event_kinds[e, 0] in (IMPACT, LANDING)
        if not (lands or (last and not due)):
            contact = event_kinds[e, 1] if due else step_contact[i]
            if t_event >= gx[1]:
                tau_x = dual_gx[1] - value(dual_gx[1])
                nx, row, dual_gx = row_behind(horizontal, dual_horizontal, nx, t_event)
                if corners:
                    turn_corner(contact, t_event, gx, gy, row, gy, tau_x, p, y, floats)
                gx = row
            if t_event >= gy[1]:
                tau_y = dual_gy[1] - value(dual_gy[1])
                ny, row, dual_gy = row_behind(vertical, dual_vertical, ny, t_event)
                if corners:
                    turn_corner(contact, t_event, gx, gy, gx, row, tau_y, p, y, floats)
                gy = row
        if due:
            told[0] = e
            code, e, impacts, rested = pass_through(
                e, impacts, length, events, event_kinds, event_states, gx, gy, dual_gx, dual_gy,
                tau_x, tau_y, p, dual_p, law, dual_ratio, rtol, atol, rest_tolerance, y, event_y,
                event_t, floats, duals,
            )  # fmt: skip
            if code != 0:
                return code
            if rested and not last and events[e - 1] > t:
                i += 1  # what was recorded of the time of the rest
            length = 0.0
            continue
        if last:
            break
        # -- the step itself, and parts of it up to the times that are asked for
        contact, h = step_contact[i], steps[i, 1]
        for j in range(N_STATES):
            start[j] = step_states[i, 0, j]
        put(y, start)
        still = stands_still(contact, t, gx, gy, p, floats)
        while q < len(times) and times[q] < t + h:
            part = times[q] - t
            for j in range(N_STATES):
                y_new[j] = y[j]
            if part > 0.0 and not still:
                go_on(
                    contact, t, part, longest, y, dual_p, dual_gx, dual_gy, rtol, atol, duals, y_new
                )
            for j in range(N_STATES):
                found[q, j] = y_new[j]
            q += 1
        if not still:
            go_on(contact, t, h, longest, y, dual_p, dual_gx, dual_gy, rtol, atol, duals, y_new)
            for j in range(N_STATES):
                y[j] = y_new[j]
        length = h
        i += 1
    while q < len(times):
        for j in range(N_STATES):
            found[q, j] = y[j]
        q += 1
    told[0] = e
    return 0


def go_on(contact, t, h, longest, y, p, gx, gy, rtol, atol, duals, y_new):
    """A step of the motion with its derivatives, from y into y_new, in parts up to `longest`.

    What does not vibrate errs in no step, however long; were it followed in such a step, what a
    number changes would grow by as much as the step is longer than stability allows.
    """
    k, here = duals[_STAGES:_NEW], duals[_MOVED:_BEHIND]
    parts = 1 + int(h / longest)
    part = h / parts
    for j in range(N_STATES):
        y_new[j] = y[j]
    for i in range(parts):
        for j in range(N_STATES):
            here[j] = y_new[j]
        now = t + i * part
        rates(contact, here, p, ground_acceleration(gx, now), ground_acceleration(gy, now), k)
        take_step(contact, now, part, here, p, gx, gy, rtol, atol, k, y_new)


def stands_still(contact, t, gx, gy, p, floats):
    """Whether nothing can move in a step from the state floats[:N], nor its derivatives."""
    start, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    for j in range(N_STATES // 2, N_STATES):
        if start[j] != 0.0:
            return False
    rates(contact, start, p, ground_acceleration(gx, t), ground_acceleration(gy, t), rate_there)
    return cannot_move(contact, rate_there, start, p)


def row_behind(table, dual_table, n, t):
    """(n, row, row with its derivatives) of the law of the ground that holds at t and after it.

    A dual table that is empty changes nothing.
    """
    n, row = segment_at(table, n, t)
    if n < dual_table.shape[0]:
        return n, row, segment_of(dual_table, n)
    return n, row, row


def pass_through(
    e, impacts, length, events, event_kinds, event_states, gx, gy, dual_gx, dual_gy, tau_x, tau_y,
    p, dual_p, law, dual_ratio, rtol, atol, rest_tolerance, y, event_y, event_t, floats, duals,
):  # fmt: skip
    """(code, event, impacts, rested): pass through event e and what follows it in no time.

    Returns the event that is next, and whether infinitely many impacts were the last.
    """
    before, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    moved, behind = duals[_MOVED:_BEHIND], duals[_BEHIND:_STATE]
    t, contact, guard = events[e], event_kinds[e, 1], event_kinds[e, 3]
    if guard == STEPPED_OVER:
        return GRAZES, e, impacts, False
    for j in range(N_STATES):
        before[j] = event_states[e, 0, j]
    put(y, before)
    rates(contact, before, p, ground_acceleration(gx, t), ground_acceleration(gy, t), rate_there)
    code, tau = moves_by(
        e, contact, guard, length, t, event_kinds, event_states, gx, gy, dual_gx, dual_gy, tau_x,
        tau_y, p, dual_p, rtol, atol, y, floats, duals,
    )  # fmt: skip
    if code != 0:
        return code, e, impacts, False
    for j in range(N_STATES):
        moved[j] = y[j] + rate_there[j] * tau
    rested = False
    while True:
        rested = event_kinds[e, 0] == REST
        kind, contact, guard = event_kinds[e, 0], event_kinds[e, 1], event_kinds[e, 3]
        if guard == STEPPED_OVER:
            return GRAZES, e, impacts, False
        ax, ay = ground_acceleration(dual_gx, t + tau), ground_acceleration(dual_gy, t + tau)
        if kind == REST:  # after the last impact, at t
            rests, follows = comes_to_rest(
                contact, t, tau, impacts, moved, dual_p, law, dual_ratio, ax, ay, dual_gx, dual_gy,
                rtol, atol, rest_tolerance, behind, duals,
            )  # fmt: skip
            tau += rests - value(rests)
            t = events[e]
        else:
            follows = passed(
                contact, guard, length, t, impacts, moved, dual_p, law, dual_ratio, ax, ay, dual_gx,
                dual_gy, rtol, behind, duals,
            )  # fmt: skip
        if follows != event_kinds[e, 2]:
            return OTHER_WAY, e, impacts, rested
        event_t[e] = t + tau
        for j in range(N_STATES):
            event_y[e, 0, j] = moved[j]
            before[j] = event_states[e, 1, j]
        put(behind, before)
        for j in range(N_STATES):
            event_y[e, 1, j] = moved[j] = behind[j]
        if kind in (IMPACT, LANDING):
            impacts += 1
        e += 1
        at_once = e < events.shape[0] and (events[e] == t or event_kinds[e, 0] == REST)
        if not at_once:
            break
    rates(follows, before, p, ground_acceleration(gx, t), ground_acceleration(gy, t), rate_there)
    for j in range(N_STATES):
        y[j] = moved[j] - rate_there[j] * tau
    return 0, e, impacts, rested


def moves_by(
    e, contact, guard, length, t, event_kinds, event_states, gx, gy, dual_gx, dual_gy, tau_x, tau_y,
    p, dual_p, rtol, atol, y, floats, duals,
):  # fmt: skip
    """(code, tau): how the time of an event moves.

    It is a law of the ground that begins, the start of the motion, or a guard that falls.
    """
    begins = event_kinds[e, 0] not in (IMPACT, LANDING)
    if begins and t == gx[0]:
        return 0, tau_x
    if begins and t == gy[0]:
        return 0, tau_y
    still = moving(0.0, 0.0)
    if t == 0.0:
        return 0, still
    g, state = duals[_GUARD:_TOLD], duals[_STATE:_KICK]
    before, rate_there = floats[:N_STATES], floats[N_STATES : 2 * N_STATES]
    later, rate_soon = floats[2 * N_STATES : 3 * N_STATES], floats[3 * N_STATES :]
    # how fast the guard falls, and how fast that changes
    falls = falls_by(contact, guard, t, before, rate_there, gx, gy, p, state, g)
    ahead = 1e-3 * length
    for j in range(N_STATES):
        later[j] = before[j] + ahead * rate_there[j]
    soon = t + ahead
    rates(
        contact, later, p, ground_acceleration(gx, soon), ground_acceleration(gy, soon), rate_soon
    )
    after = falls_by(contact, guard, soon, later, rate_soon, gx, gy, p, state, g)
    for j in range(N_STATES):
        later[j] = atol[j] + rtol * abs(before[j])
    grain = abs(
        guard_along(
            contact,
            guard,
            before,
            later,
            ground_acceleration(gx, t),
            ground_acceleration(gy, t),
            p,
            state,
            g,
        )
    )
    # where it falls faster and faster it comes from where it was open: a short hop is no graze
    bends = max(after - falls, 0.0) / ahead if ahead > 0.0 else 0.0
    if not falls < 0.0 or falls * falls <= DIGITS * grain * bends:
        # its time is not known; where nothing changes there, none is asked for
        return (0 if goes_on(e, t, gx, gy, p, event_kinds, event_states, floats) else GRAZES), still
    guards(contact, y, dual_p, ground_acceleration(dual_gx, t), ground_acceleration(dual_gy, t), g)
    return 0, (value(g[guard]) - g[guard]) / falls


def falls_by(contact, guard, t, y, dy, gx, gy, p, state, g):
    """How fast a guard changes along the motion."""
    now = moving(t, 1.0)
    return guard_along(
        contact,
        guard,
        y,
        dy,
        ground_acceleration(gx, now),
        ground_acceleration(gy, now),
        p,
        state,
        g,
    )


def guard_along(contact, guard, y, dy, ax, ay, p, state, g):
    """How fast a guard changes where the state does so by dy."""
    for j in range(N_STATES):
        state[j] = moving(y[j], dy[j])
    guards(contact, state, p, ax, ay, g)
    return rate(g[guard])


def goes_on(e, t, gx, gy, p, event_kinds, event_states, floats):
    """Whether neither the state nor its rates change at an event."""
    rate_there, y, rate_behind = (
        floats[N_STATES : 2 * N_STATES],
        floats[:N_STATES],
        floats[2 * N_STATES :],
    )
    for j in range(N_STATES):
        y[j] = event_states[e, 1, j]
    rates(
        event_kinds[e, 2], y, p, ground_acceleration(gx, t), ground_acceleration(gy, t), rate_behind
    )
    same = True
    for j in range(N_STATES):
        y[j] = event_states[e, 0, j]
        same = same and event_states[e, 1, j] == y[j]
        size = abs(rate_there[j]) + abs(rate_behind[j])
        same = same and abs(rate_behind[j] - rate_there[j]) <= 1e-8 * size
    return same


@inlined
def passed(
    contact, guard, length, t, impacts, y, p, law, dual_ratio, ax, ay, gx, gy, rtol, out, duals
):  # fmt: skip
    """The contact state behind a passage, as in the loop; the state there into out."""
    if N_POINTS == 0:
        ratio = ratio_at(law, dual_ratio[0], impacts, y, p)
        follows = jump(contact, guard, law, ratio, y, p, out)
    else:
        ahead = 1e-5 * length
        later_x, later_y = ground_acceleration(gx, t + ahead), ground_acceleration(gy, t + ahead)
        follows, _ = pass_on(
            contact, guard, length, y, p, ax, ay, later_x, later_y, ahead, rtol, duals[_TOLD:], out
        )
    return follows


@inlined
def comes_to_rest(
    contact, t, tau, impacts, y, p, law, dual_ratio, ax, ay, gx, gy, rtol, atol, tolerance, out,
    duals,
):  # fmt: skip
    """(time, contact) of infinitely many impacts, as in the loop; the state behind them into out.

    y : that at the last one that is told of; changed into the one before they have ended.
    """
    if N_POINTS > 0:
        rests, follows = time_of_bounces(contact, y, p, ax, ay, tolerance, rtol, duals[_TOLD:], out)
    else:
        w, stands, kick = duals[_STATE:_KICK], duals[_NEW:_MOVED], duals[_KICK:_GUARD]
        rests, follows = time_to_rest(
            contact, y, p, law, dual_ratio[0], impacts, ax, ay, tolerance, w, stands, kick
        )
        stand(follows, t + tau, rests, stands, p, gx, gy, rtol, atol, duals[_STAGES:_NEW], out)
        for j in range(N_STATES):
            y[j] += out[j] - stands[j]  # there, had the impacts not faded yet
    return rests, follows


def turn_corner(contact, t, gx, gy, new_x, new_y, tau, p, y, floats):
    """The state where one law of the ground ends and another begins, at a time that moves."""
    here, before, behind = (
        floats[:N_STATES],
        floats[N_STATES : 2 * N_STATES],
        floats[2 * N_STATES :],
    )
    for j in range(N_STATES):
        here[j] = value(y[j])
    rates(contact, here, p, ground_acceleration(gx, t), ground_acceleration(gy, t), before)
    rates(contact, here, p, ground_acceleration(new_x, t), ground_acceleration(new_y, t), behind)
    for j in range(N_STATES):
        y[j] += (before[j] - behind[j]) * tau


@inlined
def put(y, values):
    """Give numbers other values, and leave their derivatives."""
    for j in range(N_STATES):
        y[j] = values[j] + (y[j] - value(y[j]))
