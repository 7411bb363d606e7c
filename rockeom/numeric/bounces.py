"""When the infinitely many impacts to come will all have happened, and what follows then.

Joined behind contacts.py, whose passages the impacts are, see `rockeom.numeric.program`.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from rockeom.contract import IMPOSSIBLE, LANDING, OPEN, STICK

if TYPE_CHECKING:  # joined before this text
    from rockeom.numeric.joined import (
        COUPLING,
        FITS,
        GRAIN,
        GUARDS,
        KINDS,
        MATRIX,
        N_COORDINATES,
        N_POINTS,
        N_STATES,
        POINT,
        POINT_STATES,
        ROTATION,
        ROWS,
        SUBJECTS,
        acceleration_of,
        all_known,
        go_on_as,
        meet,
        points,
        put_on,
        rate_of,
        rates,
    )

LEAST_HOP = 1e-11  # relative to the terms of a gap: lower flights are summed up
SLOWEST = 1e4  # s: what is slower has no end of its bounces that needs to be found at once


def time_of_bounces(contact, y, p, ax, ay, tolerance, known, out):
    """(time, contact): when the infinitely many impacts to come will all have happened.

    From a landing after which points leave what they touched: close to the end flights are
    parabolas, each from the rates of the state in which it begins, and the impacts between are
    those of any landing. They are followed until one is like another before it but for its speed:
    what is left is a geometric series then. out (N,) : the state after it, all these points closed.
    Returns (inf, contact) while the time is longer than `tolerance` times sqrt(l/a), a the
    acceleration that closes the gap and l the radius of gyration.
    """
    n = N_COORDINATES
    dy, w = np.empty(N_STATES), np.empty(N_STATES)
    bouncing, near = np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS, np.int64)
    met, landed = np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS, np.int64)
    heights = np.zeros(N_POINTS)  # by themselves: they are lost among the last digits of a state
    rates(contact, y, p, ax, ay, dy)
    start, limit = slow_bounces(contact, y, tolerance, known, dy, bouncing, heights)
    if start == 0.0:
        return np.inf, contact
    for i in range(N_STATES):
        w[i] = y[i]
    total = last = 0.0
    here = contact
    # a flight before, with which others are compared
    first, first_here, first_total, rate_then, ratio_then = -1, -1, 0.0, 0.0, 0.0
    w_then = np.empty(N_STATES)
    flights, patience = 0, 2
    for _turn in range(4000):
        if _turn > 0:
            rates(here, w, p, ax, ay, dy)
        flight, which = next_landing(here, bouncing, heights, known, dy)
        if flight < 0.0:
            return np.inf, contact
        if which < 0 or is_slow(here, bouncing, start, known, w):
            break
        if total + flight > limit:
            # where the last flights were nothing, some have come to their end and others fly on
            if not (last < 1e-6 * total and some_ended(here, bouncing)):
                return np.inf, contact
            break
        rate = known[which * POINT + 1]
        alike = which == first and here == first_here
        if alike:
            ratio, period = rate / rate_then, total - first_total
            left = ratio / (1.0 - ratio) if ratio < 1.0 else 0.0  # in periods like the last
            if total + left * period > limit:
                return np.inf, contact
            all_landed = True
            for i in range(N_POINTS):
                all_landed = all_landed and landed[i] >= bouncing[i]
            if left > 0.0 and all_landed and abs(ratio - ratio_then) <= 1e-9 * (1.0 - ratio):
                to_the_end(ratio, period, w_then, w)
                total += left * period
                break
            ratio_then = ratio
        if alike or first < 0 or flights == patience:
            if flights == patience and not alike:
                patience *= 2
            first, first_here, first_total, rate_then, flights = which, here, total, rate, 0
            for i in range(N_STATES):
                w_then[i] = w[i]
            for i in range(N_POINTS):
                landed[i] = 0
        flights += 1
        last = flight
        total += flight
        fly(here, which, flight, known, dy, bouncing, heights, near, w)
        for i in range(N_POINTS):
            met[i] = near[i]
            landed[i] = max(landed[i], near[i])
        for i in range(N_STATES):
            out[i] = w[i]
        points(w, p, known)
        here, _ = meet(
            here, landing_of(here, which), near, w, p, ax, ay, ax, ay, 1e-3 * flight, known, out
        )
        if here < 0:
            return np.inf, contact
        for i in range(n, N_STATES):
            w[i] = out[i]
        points(w, p, known)
        for i in range(N_POINTS):
            if met[i] == 1 and POINT_STATES[here][i] == OPEN and known[i * POINT + 1] > 0.0:
                bouncing[i] = 1
    follows = all_closed(here, bouncing, start, p, ax, ay, known, near, w, out)
    return (total, follows) if follows >= 0 else (np.inf, contact)


def slow_bounces(contact, y, tolerance, known, dy, bouncing, heights):
    """(start, limit): the fastest rate at which points leave, and the longest time of bounces.

    dy (N,) : rates of the state. bouncing (N_POINTS,) : set to 1 for these points, and
    for others in flight that land as soon, from their heights (N_POINTS,). Zero where no point
    leaves, or where one is too fast for such a time.
    """
    longest = start = 0.0
    lost = True
    for i in range(N_POINTS):
        gap, rate = known[i * POINT], known[i * POINT + 1]
        _, size = rate_of(known, 2 * i, y, 0)
        if POINT_STATES[contact][i] != OPEN or gap > GRAIN * size or rate <= 0.0:
            continue
        a = -acceleration_of(known, 2 * i, dy)
        low = 0.5 * rate * rate < LEAST_HOP * size * abs(a)
        if not (a > 0.0 or low) or 2.0 * rate > tolerance * SLOWEST * abs(a):
            return 0.0, 0.0
        bouncing[i] = 1
        start = max(start, rate)
        longest = max(longest, 2.0 * rate / abs(a))
        lost = lost and low
    if start == 0.0:
        return 0.0, 0.0
    inertia = known[MATRIX + ROTATION * N_COORDINATES + ROTATION]
    limit = np.inf
    for i in range(N_POINTS):
        if bouncing[i] == 1:
            radius = math.sqrt(inertia * known[COUPLING + 2 * i * ROWS + 2 * i])
            limit = min(
                limit, tolerance * math.sqrt(radius / abs(acceleration_of(known, 2 * i, dy)))
            )
    if lost:
        limit = SLOWEST * longest  # flights so low end among rounding errors
    if longest > limit:
        return 0.0, 0.0
    for i in range(N_POINTS):
        gap, rate = known[i * POINT], known[i * POINT + 1]
        if POINT_STATES[contact][i] == OPEN and bouncing[i] == 0:
            a = -acceleration_of(known, 2 * i, dy)
            if a > 0.0 and rate + math.sqrt(rate * rate + 2.0 * a * gap) <= limit * a:
                bouncing[i], heights[i] = 1, gap
    return start, limit


def next_landing(here, bouncing, heights, told, dy):
    """(time, point) of the next landing of those that bounce: negative where none lands again.

    A gap that opens faster waits for the landing of another.
    """
    flight, which, waits = np.inf, -1, False
    for i in range(N_POINTS):
        if bouncing[i] == 0 or POINT_STATES[here][i] != OPEN:
            continue
        rate, a = told[i * POINT + 1], -acceleration_of(told, 2 * i, dy)
        if not a > 0.0:
            waits = True
            continue
        lasts = (rate + math.sqrt(rate * rate + 2.0 * a * heights[i])) / a
        if lasts < flight:
            flight, which = lasts, i
    return (-1.0, which) if waits and which < 0 else (flight, which)


def landing_of(contact, point):
    """The guard of a point's landing."""
    guard = -1
    for i in range(GUARDS[contact]):
        if KINDS[contact][i] == LANDING and SUBJECTS[contact][i] == point:
            guard = i
    return guard


def is_slow(here, bouncing, start, told, w):
    """Whether nothing but the digits of other velocities is left of those of the bounces."""
    fastest = whole = 0.0
    for i in range(N_POINTS):
        if bouncing[i] == 1 and POINT_STATES[here][i] == OPEN:
            fastest = max(fastest, told[i * POINT + 1])
        _, speed = rate_of(told, 2 * i, w, N_COORDINATES)
        whole = max(whole, speed)
    return fastest <= max(1e-7 * start, 1e-8 * whole)


def some_ended(here, bouncing):
    """Whether some points that bounced are closed: of those still in flight it is taken back."""
    ended = False
    for i in range(N_POINTS):
        if bouncing[i] == 1 and POINT_STATES[here][i] == OPEN:
            bouncing[i] = 0
        else:
            ended = ended or bouncing[i] == 1
    return ended


def fly(here, which, flight, told, dy, bouncing, heights, near, w):
    """Move a state w to the next landing, and say which points touch there, in near."""
    n = N_COORDINATES
    for i in range(N_POINTS):
        near[i] = 1 if POINT_STATES[here][i] != OPEN else 0
        if bouncing[i] == 1 and near[i] == 0:
            rise = told[i * POINT + 1] * flight
            drop = -0.5 * acceleration_of(told, 2 * i, dy) * flight * flight
            heights[i] += rise - drop
            if i == which or heights[i] <= 1e-9 * drop:
                heights[i], near[i] = 0.0, 1
    for i in range(n):
        w[i] += flight * (w[n + i] + 0.5 * flight * dy[n + i])
        w[n + i] += flight * dy[n + i]


def to_the_end(ratio, period, w_then, w):
    """Move a state w on through periods each of which is the last one times a ratio.

    w_then : a period before w. In that time a velocity is what it ends at, and what shrinks with
    each period: so a place moves by the first times the period, and by what shrinks as its square.
    """
    n = N_COORDINATES
    left, left_of_squares = ratio / (1.0 - ratio), ratio * ratio / (1.0 - ratio * ratio)
    for i in range(n):
        w[n + i] += left * (w[n + i] - w_then[n + i])
        along_ = period * w[n + i]
        w[i] += left * along_ + left_of_squares * (w[i] - w_then[i] - along_)


def all_closed(here, bouncing, start, p, ax, ay, known, near, w, out):
    """The contact state that follows once all points that bounce are closed, or a negative number.

    w : the state until then; out : with them closed. known, near : scratch.
    """
    n = N_COORDINATES
    sizes = np.empty(ROWS + N_POINTS)
    rows, wanted, sliding = np.zeros(ROWS, np.int64), np.zeros(ROWS), np.zeros(N_POINTS)
    for i in range(N_STATES):
        out[i] = w[i]
    all_known(out, p, here, known)
    for i in range(N_POINTS):
        closed = bouncing[i] == 1 or POINT_STATES[here][i] != OPEN
        near[i] = 1 if closed else 0
        if closed:
            rows[2 * i], wanted[2 * i] = 1, -known[i * POINT]
    put_on(rows, wanted, 0, known, out)
    points(out, p, known)
    for i in range(N_POINTS):
        if near[i] == 0 and known[i * POINT] <= 0.0 and known[i * POINT + 1] <= 0.0:
            return IMPOSSIBLE  # it landed before
        if near[i] == 0:
            continue
        wanted[2 * i] = -known[i * POINT + 1]
        slip, size = rate_of(known, 2 * i + 1, out, n)
        sticks = POINT_STATES[here][i] == STICK
        if sticks or abs(slip) <= start + FITS * size:  # so slow a slip has ended, too
            rows[2 * i + 1], wanted[2 * i + 1] = 1, -slip
        else:
            sliding[i] = 1.0 if slip > 0.0 else -1.0
    put_on(rows, wanted, n, known, out)
    points(out, p, known)
    follows = go_on_as(here, False, near, sliding, out, p, ax, ay, ax, ay, 1e-6, known, sizes)
    for i in range(N_POINTS):
        if bouncing[i] == 1 and follows >= 0 and POINT_STATES[follows][i] == OPEN:
            return IMPOSSIBLE
    return follows
