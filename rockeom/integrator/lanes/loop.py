"""Many motions as lanes of one stream of instructions: the loop of `simulate_many`.

This file is not imported. `rockeom.integrator.program` links it with the text of the scalar loop,
with `vectors.py` and with the step of lanes, which is written for each structure.

Each lane has a time, a step and a control of its error of its own. All lanes take their next step
together, whatever it is to each of them: an ordinary one, one more of those that were refused, or
one that is to end at an impact. The quintic of the gap through both ends of a step says what
becomes of it: it stands, it is repeated to end at the impact, or it has ended there. In all other
cases, an uplift, a fall, a doubt, `integrate` takes the lane over, and carries it to the end of
that step or its first event, or, where steps are equal ones, to the end of the segment.

No lane's numbers depend on another's, nor on its place: so the results are the same to the last
bit for any order and number of motions.
"""

import math

import numpy as np

from rockeom.codes import (
    CLOSED,
    COMPLETED,
    EVENTS_KEPT,
    FULL,
    GUARD_DUE,
    IDLE,
    IMPACTS,
    LAST_ERROR,
    MODE,
    NEXT_STEP,
    RATE_STALE,
    STALLED,
    STEPS,
    STEPS_KEPT,
    TIME,
    TOO_MANY_IMPACTS,
    UPLIFT,
)
from rockeom.compiler.decorators import Floats, Ints, entry, inlined
from rockeom.integrator.batches import add_gain, case_of, count_impacts
from rockeom.integrator.ground import (
    ground_acceleration,
    ground_accelerations,
    jumps,
    pulse,
    sampling_step,
    segment_at,
)
from rockeom.integrator.lanes.vectors import (
    Z_AX,
    Z_AY,
    Z_CLOSED,
    Z_DAMP,
    Z_END_X,
    Z_END_Y,
    Z_EQUAL,
    Z_ERROR,
    Z_FALLEN,
    Z_FLIGHT,
    Z_H,
    Z_IMPACT,
    Z_K,
    Z_KIND_X,
    Z_KIND_Y,
    Z_LANDING,
    Z_LAST,
    Z_LEAST,
    Z_LONGEST,
    Z_MODE,
    Z_MOST,
    Z_NEXT,
    Z_P,
    Z_Q,
    Z_SIDE,
    Z_START_X,
    Z_START_Y,
    Z_T,
    Z_T_NEW,
    Z_TAKEN,
    Z_VERDICT,
    Z_X0,
    Z_X1,
    Z_Y0,
    Z_Y1,
    accept_lanes,
    bend_x_lanes,
    bend_y_lanes,
    control_lanes,
    ends_of,
    judge_held_lanes,
    judge_lanes,
    shake_lanes,
)
from rockeom.integrator.lanes.verdicts import (
    DOUBTFUL,
    HOP,
    LANDED,
    REFUSED,
    REPEATED,
    STANDS,
    TURN_AT_END,
    TURNS,
    quintic_of_scaled,
    scaled,
    slope_root,
)
from rockeom.integrator.loop import (
    _AFTER,
    _GUARDS,
    _K,
    _POWERS,
    _W,
    _Y_NEW,
    SCRATCH,
    TURN,
    integrate,
)
from rockeom.integrator.provided import (
    DAMPING,
    GAP_SIDES,
    LANES,
    N_MODES,
    N_PARAMETERS,
    N_STATES,
    NODE_PLACES,
    PLACES,
    ROTATION,
    ROTATION_RATE,
    STAGE_PLACES,
    jump,
    kind_of,
    opening_acceleration,
    rates,
    reverse_of,
    side_of,
    step_lanes,
)
from rockeom.integrator.records import Batch, Recorder, Segment
from rockeom.integrator.steps import first_step, most_error
from rockeom.integrator.tolerances import (
    EPS,
    STAYS_ON_FEET,
)
from rockeom.integrator.transitions.declared import stand, time_to_rest
from rockeom.integrator.transitions.restitution import velocity_ratio_at

# Rows of whole numbers: the case of a lane (-1: none), the rows of its two tables
W_CASE, W_NX, W_NY = (i * LANES for i in range(3))
W_SIZE = 3 * LANES


@inlined
def segment(z, first, lane):
    """The segment of the ground that holds in a lane; first : Z_START_X or Z_START_Y."""
    at = first + lane
    return (
        z[at], np.inf, z[at + 2 * LANES], z[at + 3 * LANES], z[at + 4 * LANES],
        z[at + 5 * LANES], z[at + 6 * LANES],
    )  # fmt: skip


@inlined
def ground_of(z, lane):
    """The segments of a lane."""
    x, y = segment(z, Z_START_X, lane), segment(z, Z_START_Y, lane)
    return Segment(0, x), Segment(0, y)


def plan_lanes(z, h_max):
    """The next step of each lane; that of a lane which is landing is known."""
    for lane in range(LANES):
        t, last, planned = z[Z_T + lane], z[Z_LAST + lane], z[Z_LANDING + lane] != 0.0
        equal = z[Z_EQUAL + lane]
        z[Z_NEXT + lane] = equal if equal > 0.0 else z[Z_NEXT + lane]
        h = min(z[Z_NEXT + lane], h_max)
        h = min(h, z[Z_LONGEST + lane]) if z[Z_SIDE + lane] == 0.0 else h
        cut = t + 1.1 * h >= last
        z[Z_H + lane] = z[Z_H + lane] if planned else (last - t if cut else h)
        z[Z_T_NEW + lane] = z[Z_T_NEW + lane] if planned else (last if cut else t + h)


def turn(lane, z):
    """Let a lane's step end at the first extreme of a state inside it; whether one was found."""
    n, h, place = N_STATES // 2, z[Z_H + lane], 1.0
    for i in range(n):
        at, of_rate = i * LANES + lane, (n + i) * LANES + lane
        of_step = scaled(1.0, h, ends_of(z, i, lane))
        v0, a0, v1, a1 = of_step.v0, of_step.a0, of_step.v1, of_step.a1
        least, most = z[Z_LEAST + at], z[Z_MOST + at]
        _, b1, b2, b3, b4, _ = quintic_of_scaled(of_step)
        inside = min(min(b1, b2), min(b3, b4)) > least and max(max(b1, b2), max(b3, b4)) < most
        d1, d2, d3 = v0 + 0.25 * a0, 5.0 * (b3 - b2), v1 - 0.25 * a1
        if v0 * v1 < 0.0 and not inside:
            place = min(place, slope_root(v0, d1, d2, d3, v1))
        slowest, fastest = z[Z_LEAST + of_rate], z[Z_MOST + of_rate]
        inside = min(d1, min(d2, d3)) > h * slowest and max(d1, max(d2, d3)) < h * fastest
        if a0 * a1 < 0.0 and not inside:
            c1, c2 = 4.0 * (d2 - d1), 4.0 * (d3 - d2)
            # a cubic, raised to a quartic
            place = min(
                place,
                slope_root(a0, 0.25 * a0 + 0.75 * c1, 0.5 * (c1 + c2), 0.75 * c2 + 0.25 * a1, a1),
            )
    if not 0.001 < place < 0.999:
        return False
    z[Z_LANDING + lane], z[Z_H + lane] = TURN_AT_END, place * h
    z[Z_T_NEW + lane] = z[Z_T + lane] + place * h
    return True


# -- one lane ------------------------------------------------------------------------------------


def take_in(lane, z, w, batch):
    """The state of a case into its lane."""
    case, n = w[W_CASE + lane], N_STATES // 2
    status, clock = batch.status[case], batch.clock[case]
    y, rate = batch.states[case], batch.rates[case]
    z[Z_T + lane], z[Z_NEXT + lane] = clock[TIME], clock[NEXT_STEP]
    last_error = clock[LAST_ERROR]
    z[Z_DAMP + lane] = last_error**DAMPING if last_error > 0.0 else 1.0
    z[Z_MODE + lane] = status[MODE]
    z[Z_SIDE + lane] = GAP_SIDES[status[MODE]]
    z[Z_CLOSED + lane] = status[CLOSED]
    z[Z_TAKEN + lane] = status[STEPS]
    z[Z_FALLEN + lane] = batch.fallen[case]
    z[Z_LANDING + lane] = z[Z_FLIGHT + lane] = 0.0
    for i in range(n):
        z[Z_Q + i * LANES + lane] = y[i]
        z[Z_K + i * LANES + lane] = y[n + i]
        z[Z_K + (n + i) * LANES + lane] = rate[n + i]
    for i in range(N_STATES):
        z[Z_LEAST + i * LANES + lane] = batch.extremes[case, 0, i]
        z[Z_MOST + i * LANES + lane] = batch.extremes[case, 1, i]


def take_out(lane, z, w, batch):
    """The state of a lane back into the arrays of its case."""
    case, n = w[W_CASE + lane], N_STATES // 2
    status, clock = batch.status[case], batch.clock[case]
    y, rate = batch.states[case], batch.rates[case]
    if z[Z_T + lane] > clock[TIME]:
        status[IDLE] = 0
    clock[TIME], clock[NEXT_STEP] = z[Z_T + lane], z[Z_NEXT + lane]
    clock[LAST_ERROR] = z[Z_DAMP + lane] ** (1.0 / DAMPING)
    status[MODE] = int(z[Z_MODE + lane])
    status[CLOSED] = int(z[Z_CLOSED + lane])
    status[STEPS] = int(z[Z_TAKEN + lane])
    for i in range(n):
        y[i] = z[Z_Q + i * LANES + lane]
        y[n + i] = rate[i] = z[Z_K + i * LANES + lane]
        rate[n + i] = z[Z_K + (n + i) * LANES + lane]
    for i in range(N_STATES):
        batch.extremes[case, 0, i] = z[Z_LEAST + i * LANES + lane]
        batch.extremes[case, 1, i] = z[Z_MOST + i * LANES + lane]


def alone(lane, z, w, batch, recorder, scratch, until):
    """Carry a lane by the scalar loop until a time; where the error is controlled, to an event."""
    take_out(lane, z, w, batch)
    n = w[W_CASE + lane]
    status = batch.status[n]
    code = FULL
    controlled = z[Z_EQUAL + lane] == 0.0
    room = 2 if controlled else 64
    case = case_of(
        batch, n, until,
        batch.horizontal[w[W_NX + lane] : batch.h_rows[n, 1]],
        batch.transverse[:0],
        batch.vertical[w[W_NY + lane] : batch.v_rows[n, 1]],
    )  # fmt: skip
    own = recorder._replace(events=recorder.events[:room], extremes=batch.extremes[n])
    while code == FULL:
        before = status[IMPACTS]
        status[STEPS_KEPT] = status[EVENTS_KEPT] = 0
        code = integrate(
            status, batch.clock[n], batch.states[n], batch.rates[n], case, own, scratch
        )
        count_impacts(batch, n, before, own, scratch[_POWERS:_GUARDS])
        if controlled:
            break
    if code != COMPLETED and code != FULL:
        batch.outcome[n] = code
    take_in(lane, z, w, batch)


@inlined
def hop(lane, z, t, flight):
    """Let the first step of a short flight end at the next impact.

    The flight before it lasted longer than its parabola; this one does, too, in proportion to the
    square of their lengths, as without ground acceleration.
    """
    length, last = flight, z[Z_FLIGHT + lane]
    if last > 0.0:
        more = ((t - z[Z_IMPACT + lane]) / last - 1.0) * (flight / last) * (flight / last)
        if abs(more) < 0.05:
            length = flight * (1.0 + more)
    z[Z_IMPACT + lane], z[Z_FLIGHT + lane] = t, flight
    if 0.0 < length < z[Z_NEXT + lane] and t + length < z[Z_LAST + lane]:
        z[Z_LANDING + lane], z[Z_H + lane], z[Z_T_NEW + lane] = HOP, length, t + length


def impact(lane, z, w, batch, scratch):
    """Pass a lane that has landed into the mode that follows, as the loop does."""
    case, t, n = w[W_CASE + lane], z[Z_T + lane], N_STATES // 2
    status, y, p, law, ratio = (
        batch.status[case], batch.states[case], batch.p[case], batch.law[case], batch.ratio[case],
    )  # fmt: skip
    after = scratch[_AFTER:_POWERS]
    # what is left of the gap
    left = -z[Z_Q + ROTATION * LANES + lane] / z[Z_K + ROTATION * LANES + lane]
    z[Z_T + lane] = t = min(t + left, batch.t_end[case])
    for i in range(n):
        v, a = z[Z_K + i * LANES + lane], z[Z_K + (n + i) * LANES + lane]
        y[i], y[n + i] = z[Z_Q + i * LANES + lane] + left * (v + 0.5 * left * a), v + left * a
    if status[IMPACTS] < batch.impact_times.shape[1]:
        batch.impact_times[case, status[IMPACTS]] = t
    before, speed = int(z[Z_MODE + lane]), abs(y[ROTATION_RATE])
    passed = velocity_ratio_at(law, ratio, status[IMPACTS], y[ROTATION_RATE], p)
    mode = jump(before, 0, law, passed, y, p, after)
    add_gain(before, mode, y, after, p, scratch[_POWERS:_GUARDS], batch.gains[case])
    widen_lane(lane, z, y)
    widen_lane(lane, z, after)
    closed = -1
    status[IMPACTS] += 1
    status[GUARD_DUE] = status[RATE_STALE] = 1
    for i in range(N_STATES):
        y[i] = after[i]
    if status[IMPACTS] > batch.max_impacts:
        batch.outcome[case] = TOO_MANY_IMPACTS
    elif side_of(mode) != 0.0:
        closed = reverse_of(before, 0)
        mode, rests = fly_or_rest(lane, z, case, mode, speed, batch, scratch)
        if rests:
            closed = -1
    z[Z_MODE + lane], z[Z_SIDE + lane] = mode, GAP_SIDES[mode]
    z[Z_CLOSED + lane] = closed
    for i in range(n):
        z[Z_Q + i * LANES + lane], z[Z_K + i * LANES + lane] = y[i], y[n + i]


@inlined
def fly_or_rest(lane, z, case, mode, speed, batch, scratch):
    """(mode, whether it rests): begin the flight after an impact, or end all to come.

    speed : the angular velocity before the impact.
    """
    y, rate, p, t = batch.states[case], batch.rates[case], batch.p[case], z[Z_T + lane]
    status, tolerance = batch.status[case], batch.rest_tolerance
    after, y_w, n = scratch[_AFTER:_POWERS], scratch[_W:_Y_NEW], N_STATES // 2
    shaking = ground_accelerations(ground_of(z, lane), t)
    rates(mode, y, p, *shaking, rate)
    status[GUARD_DUE] = status[RATE_STALE] = 0
    for i in range(n):
        z[Z_K + (n + i) * LANES + lane] = rate[n + i]
    # the flight to come, if short enough, is the first of those that time_to_rest adds up
    a, v = -side_of(mode) * rate[ROTATION_RATE], abs(y[ROTATION_RATE])
    flight, loss = 2.0 * v / a, 1.0 - v / speed
    rests, follows = np.inf, mode
    # nor is it asked while what this impact has lost says that the sum is far too long
    if a > 0.0 and not flight > min(2.0 * loss, 1.0) * tolerance / math.sqrt(a):
        rests, follows = time_to_rest(
            mode, y, p, batch.law[case], batch.ratio[case], status[IMPACTS], shaking, tolerance,
            after,
        )  # fmt: skip
    hop(lane, z, t, flight)
    short = t + rests < z[Z_LAST + lane] or rests < 16.0 * EPS * t
    if not (
        short
        and stand(
            follows, t, rests, after, p, ground_of(z, lane), batch.rtol, batch.atol,
            scratch[_K:_W], y_w,
        )
    ):  # fmt: skip
        return mode, False
    z[Z_T + lane] = t + rests
    z[Z_NEXT + lane] = z[Z_LANDING + lane] = 0.0
    status[GUARD_DUE] = status[RATE_STALE] = 1
    for i in range(N_STATES):
        y[i] = y_w[i]
    widen_lane(lane, z, y)
    return follows, True


@inlined
def widen_lane(lane, z, y):
    """Let the extremes of a lane take in a state, as `widen` does."""
    for i in range(N_STATES):
        least, most = Z_LEAST + i * LANES + lane, Z_MOST + i * LANES + lane
        z[least], z[most] = min(z[least], y[i]), max(z[most], y[i])


def fresh_rates(lane, z, case, batch):
    """The rates of a lane at its time, found again."""
    t, n = z[Z_T + lane], N_STATES // 2
    y, rate = batch.states[case], batch.rates[case]
    for i in range(n):
        y[i], y[n + i] = z[Z_Q + i * LANES + lane], z[Z_K + i * LANES + lane]
    shaking = ground_accelerations(ground_of(z, lane), t)
    rates(int(z[Z_MODE + lane]), y, batch.p[case], *shaking, rate)
    for i in range(n):
        z[Z_K + (n + i) * LANES + lane] = rate[n + i]


def next_step(lane, z, case, batch, scratch):
    """Let a lane's next step be a first one, as the loop chooses it."""
    z[Z_NEXT + lane] = first_step(
        int(z[Z_MODE + lane]), z[Z_T + lane], batch.states[case], batch.rates[case],
        batch.p[case], ground_of(z, lane), batch.rtol, batch.atol, scratch[_W:_Y_NEW],
        scratch[_AFTER:_POWERS],
    )  # fmt: skip


@inlined
def pass_segment(lane, z, w, first, row_of, table):
    """Pass to the segment of a table that holds at a lane's time; whether the ground jumps there.

    first : as of `segment`. row_of : the place of the segment's row in w.
    """
    t, at = z[Z_T + lane], first + lane
    before = ground_acceleration(segment(z, first, lane), t)
    n, row = segment_at(table, w[row_of + lane] + 1, t)
    w[row_of + lane] = n
    z[at], z[at + LANES], z[at + 2 * LANES], z[at + 3 * LANES] = row[0], row[1], row[2], row[3]
    z[at + 4 * LANES], z[at + 5 * LANES], z[at + 6 * LANES] = row[4], row[5], row[6]
    return jumps(before, ground_acceleration(row, t))


@inlined
def next_segments_of(lane, z, w, case, batch):
    """Pass to the segments of the ground that hold at a lane's time; whether it jumps there."""
    t, jumped = z[Z_T + lane], False
    if t >= z[Z_END_X + lane]:
        rows = batch.horizontal[: batch.h_rows[case, 1]]
        jumped = pass_segment(lane, z, w, Z_START_X, W_NX, rows)
    if t >= z[Z_END_Y + lane]:
        rows = batch.vertical[: batch.v_rows[case, 1]]
        jumped |= pass_segment(lane, z, w, Z_START_Y, W_NY, rows)
    z[Z_LAST + lane] = min(z[Z_END_X + lane], z[Z_END_Y + lane], batch.t_end[case])
    span = min(z[Z_END_X + lane] - z[Z_START_X + lane], z[Z_END_Y + lane] - z[Z_START_Y + lane])
    z[Z_EQUAL + lane] = span / batch.fixed if batch.fixed > 0 and span < np.inf else 0.0
    z[Z_LONGEST + lane] = min(
        sampling_step(segment(z, Z_START_X, lane)), sampling_step(segment(z, Z_START_Y, lane))
    )
    return jumped


@inlined
def straight_on(lane, z, w, case, batch):
    """Pass to the next segment of a record where nothing else changes; whether it is so."""
    rows, n, t = batch.horizontal, w[W_NX + lane] + 1, z[Z_T + lane]
    until = min(z[Z_END_Y + lane], batch.t_end[case])
    if n >= batch.h_rows[case, 1] or not t < until or z[Z_KIND_X + lane] != 0.0:
        return False
    start, end, x0, x1 = rows[n, 0], rows[n, 1], rows[n, 3], rows[n, 4]
    before = z[Z_X0 + lane] + z[Z_X1 + lane] * (t - z[Z_START_X + lane])
    if rows[n, 2] != 0.0 or not t < end or jumps(before, x0 + x1 * (t - start)):
        return False
    w[W_NX + lane] = n
    z[Z_START_X + lane], z[Z_END_X + lane], z[Z_X0 + lane], z[Z_X1 + lane] = start, end, x0, x1
    z[Z_LAST + lane] = min(end, until)
    span = min(end - start, z[Z_END_Y + lane] - z[Z_START_Y + lane])
    z[Z_EQUAL + lane] = span / batch.fixed if batch.fixed > 0 else 0.0
    return True


def skip_segments(lane, z, w, case, batch, up, down, doubt):
    """Pass segments of the ground in which no foot lifts, while it is at rest vertically."""
    rows, n = batch.horizontal, w[W_NX + lane] + 1
    ay, first = z[Z_Y0 + lane], n
    still_up, still_down = up[0] + up[2] * ay, down[0] + down[2] * ay
    while n < batch.h_rows[case, 1] and rows[n, 2] == 0.0 and rows[n, 1] < batch.t_end[case]:
        ax = rows[n, 3]
        ax_end = ax + rows[n, 4] * (rows[n, 1] - rows[n, 0])
        opens = max(still_up + up[1] * ax, still_down + down[1] * ax)
        opens = max(opens, max(still_up + up[1] * ax_end, still_down + down[1] * ax_end))
        if not opens < -doubt:
            break
        n += 1
    if n > first:
        w[W_NX + lane] = n - 1
        z[Z_T + lane] = rows[n - 1, 1]
        z[Z_CLOSED + lane] = -1.0
        batch.status[case, GUARD_DUE] = batch.status[case, RATE_STALE] = 1


def pass_rest(lane, z, w, case, batch):
    """Pass a structure that cannot move on both its feet over the segments in which it stays there.

    The accelerations with which its feet would lift are linear in those of the ground, so that
    both ends of a linear segment decide; it ends where a curved one begins.
    """
    y, p = batch.states[case], batch.p[case]
    up = down = (0.0, 0.0, 0.0)
    for c in range(N_MODES):
        if side_of(c) != 0.0:
            still = opening_acceleration(c, y, p, 0.0, 0.0)
            by_x = opening_acceleration(c, y, p, 1.0, 0.0) - still
            by_y = opening_acceleration(c, y, p, 0.0, 1.0) - still
            if side_of(c) > 0.0:
                up = (still, by_x, by_y)
            else:
                down = (still, by_x, by_y)
    doubt = STAYS_ON_FEET * (abs(up[0]) + abs(down[0]))
    while z[Z_T + lane] < batch.t_end[case]:
        if z[Z_T + lane] >= z[Z_LAST + lane]:
            if z[Z_END_Y + lane] == np.inf and z[Z_KIND_Y + lane] == 0.0 == z[Z_Y1 + lane]:
                skip_segments(lane, z, w, case, batch, up, down, doubt)
            next_segments_of(lane, z, w, case, batch)
        if z[Z_KIND_X + lane] != 0.0 or z[Z_KIND_Y + lane] != 0.0:
            return
        for end in range(2):
            t = z[Z_LAST + lane] if end == 1 else z[Z_T + lane]
            ax, ay = ground_accelerations(ground_of(z, lane), t)
            opens = max(up[0] + up[1] * ax + up[2] * ay, down[0] + down[1] * ax + down[2] * ay)
            if not opens < -doubt:
                return
        z[Z_T + lane] = z[Z_LAST + lane]
        z[Z_CLOSED + lane] = -1.0
        batch.status[case, GUARD_DUE] = batch.status[case, RATE_STALE] = 1


@inlined
def ready(lane, z, w, batch, recorder, scratch):
    """Bring a lane to where it takes its next step with the others; False where its way ends."""
    case = w[W_CASE + lane]
    status = batch.status[case]
    while batch.outcome[case] == FULL and z[Z_T + lane] < batch.t_end[case]:
        if z[Z_TAKEN + lane] >= batch.max_steps:
            batch.outcome[case] = STALLED
            break
        if z[Z_T + lane] >= z[Z_LAST + lane] and next_segments_of(lane, z, w, case, batch):
            status[GUARD_DUE] = status[RATE_STALE] = 1
        if z[Z_SIDE + lane] != 0.0:
            if status[RATE_STALE] == 1:
                fresh_rates(lane, z, case, batch)
                status[GUARD_DUE] = status[RATE_STALE] = 0
            if z[Z_EQUAL + lane] == 0.0 and z[Z_NEXT + lane] == 0.0:
                next_step(lane, z, case, batch, scratch)
            return True
        if N_STATES == 2 and kind_of(int(z[Z_MODE + lane]), 0) == UPLIFT:
            t = z[Z_T + lane]
            pass_rest(lane, z, w, case, batch)
            if z[Z_T + lane] > t:
                continue
        elif status[RATE_STALE] == 0 and z[Z_CLOSED + lane] == -1.0:
            return True
        elif z[Z_EQUAL + lane] == 0.0:
            if z[Z_NEXT + lane] == 0.0:
                fresh_rates(lane, z, case, batch)
                next_step(lane, z, case, batch, scratch)
            until = end_of_step(lane, z, z[Z_NEXT + lane])
            alone(lane, z, w, batch, recorder, scratch, until)
            continue
        alone(lane, z, w, batch, recorder, scratch, z[Z_LAST + lane])
    return False


@inlined
def end_of_step(lane, z, h):
    """End of a step that a lane takes alone; the end of the segment where time does not move."""
    t, last = z[Z_T + lane], z[Z_LAST + lane]
    return last if t + 1.1 * h >= last or t + h <= t else t + h


def shake_all(z, times):
    """Find the ground at some places of the step of each lane."""
    bent_x = bent_y = wavelets = False
    for lane in range(LANES):
        kind_x, kind_y = z[Z_KIND_X + lane], z[Z_KIND_Y + lane]
        bent_x |= kind_x == 1.0
        bent_y |= kind_y == 1.0
        wavelets |= (kind_x > 1.0) | (kind_y > 1.0)
    shake_lanes(z, times)
    if bent_x:
        bend_x_lanes(z, times)
    if bent_y:
        bend_y_lanes(z, times)
    if wavelets:
        for lane in range(LANES):
            t, h, ground = z[Z_T + lane], z[Z_H + lane], ground_of(z, lane)
            for j in range(PLACES):
                if z[Z_KIND_X + lane] > 1.0:
                    z[Z_AX + j * LANES + lane] = pulse(ground[0].row, t + times[j] * h)
                if z[Z_KIND_Y + lane] > 1.0:
                    z[Z_AY + j * LANES + lane] = pulse(ground[1].row, t + times[j] * h)


@inlined
def steps_with_others(lane, z, w, batch):
    """Whether a lane takes its next step at once, by the verdict on the last one."""
    case, verdict = w[W_CASE + lane], z[Z_VERDICT + lane]
    if case < 0:
        return False
    if verdict == TURNS:
        # equal steps stay equal
        at_end = z[Z_EQUAL + lane] != 0.0 or z[Z_LANDING + lane] == TURN_AT_END
        z[Z_VERDICT + lane] = verdict = REPEATED if not at_end and turn(lane, z) else DOUBTFUL
    steps = verdict in (REPEATED, REFUSED)
    if verdict == STANDS:
        # on both feet a structure of one coordinate passes many segments at once
        steps = z[Z_T + lane] < z[Z_LAST + lane] or (
            (N_STATES > 2 or z[Z_SIDE + lane] != 0.0) and straight_on(lane, z, w, case, batch)
        )
    return steps and z[Z_TAKEN + lane] < batch.max_steps


def pass_event(lane, z, w, batch, recorder, scratch):
    """Pass a lane through the event that its last step ended on, or that it leaves in doubt."""
    verdict = z[Z_VERDICT + lane]
    if verdict == LANDED:
        impact(lane, z, w, batch, scratch)
    elif verdict == DOUBTFUL:
        until = z[Z_LAST + lane]
        # nan: beyond an eighth of a turn lanes know no sine, nor soon behind it
        if z[Z_EQUAL + lane] == 0.0 and z[Z_ERROR + lane] == z[Z_ERROR + lane]:
            until = end_of_step(lane, z, z[Z_H + lane])
        alone(lane, z, w, batch, recorder, scratch, until)


@inlined
def put_case(case, lane, z, w, batch):
    """Put a case into a lane that is empty."""
    w[W_CASE + lane] = case
    w[W_NX + lane], w[W_NY + lane] = batch.h_rows[case, 0] - 1, batch.v_rows[case, 0] - 1
    for place in range(Z_LAST, Z_MODE, LANES):
        z[place + lane] = 0.0
    for i in range(N_PARAMETERS):
        z[Z_P + i * LANES + lane] = batch.p[case, i]
    take_in(lane, z, w, batch)


@inlined
def next_in_lane(lane, waiting, z, w, batch, recorder, scratch):
    """(whether a lane runs, the case that waits): go on with its case, or with those that wait."""
    runs = w[W_CASE + lane] >= 0
    if runs:
        pass_event(lane, z, w, batch, recorder, scratch)
    while True:
        if runs:
            if ready(lane, z, w, batch, recorder, scratch):
                return True, waiting
            take_out(lane, z, w, batch)
        w[W_CASE + lane] = -1
        z[Z_KIND_X + lane] = z[Z_KIND_Y + lane] = 0.0
        if waiting == len(batch.t_end):
            return False, waiting
        put_case(waiting, lane, z, w, batch)
        waiting += 1
        runs = True


def run_lanes(first, z, w, batch, recorder, scratch):
    """Run cases from `first` on to their ends, or to the outcomes that end them.

    Returns the next one when a TURN is over, or -1 when all have ended.
    """
    coarse = most_error(batch.rtol)  # such an equal step is left to `integrate`
    waiting, left = first, TURN
    while left >= 0:
        running, held, controlled = 0, False, False
        for lane in range(LANES):
            runs = steps_with_others(lane, z, w, batch)
            if not runs:
                runs, waiting = next_in_lane(lane, waiting, z, w, batch, recorder, scratch)
            if runs:
                running += 1
                held = held or z[Z_SIDE + lane] == 0.0
                controlled = controlled or z[Z_EQUAL + lane] == 0.0
        if running == 0:
            return -1
        left -= running
        plan_lanes(z, batch.h_max)
        shake_all(z, STAGE_PLACES)
        step_lanes(z, batch.rtol, batch.atol)
        if controlled:
            control_lanes(z)
        judge_lanes(z, coarse)
        if held:
            shake_all(z, NODE_PLACES)
            judge_held_lanes(z, coarse)
        accept_lanes(z)
    return waiting


@entry
def integrate_lanes(first: int, z: Floats, w: Ints, batch: Batch) -> int:
    """Integrate the motions of a batch, each to its end.

    first : the motion to begin with. Returns the one that the next call begins with, where a TURN
    is over, or -1 where all have ended. z (Z_SIZE,), w (W_SIZE,) : the lanes, zeros and -1 at
    first; a call goes on with what the last one left there. Whether a motion falls later on, and
    `quiet_from`, are left to `integrate_many`.
    """
    recorder = Recorder(
        np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1)), np.empty(64),
        np.empty((64, 4), np.int64), np.empty((64, 2, N_STATES)), np.empty((0, N_STATES)),
    )  # fmt: skip
    return run_lanes(first, z, w, batch, recorder, np.zeros(SCRATCH))
