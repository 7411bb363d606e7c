"""Guards: which one ends a mode, where in a step, and which stay open in all of it.

First the bounds by which most steps are known to have no event, without dense output; then the
polynomials of all guards over a step, and the first of them that falls through zero.
"""

import math

import numpy as np

from rockeom.codes import IMPACT, LANDING, LIFTING, SLIPPING, UPLIFT
from rockeom.compiler.decorators import inlined
from rockeom.integrator.bernstein import (
    NEVER,
    bernstein_at,
    clearly_open,
    first_fall,
    larger_falls,
    rises_first,
    size,
)
from rockeom.integrator.ground import ground_acceleration, ground_accelerations, straight
from rockeom.integrator.polynomials import (
    dense_at,
    polynomial_of,
    quintics_through_ends,
    slope_at,
)
from rockeom.integrator.provided import (
    BENT,
    FULL_CONTACT,
    LOCALISED,
    N_GUARDS,
    N_PARTS,
    N_STAGES,
    N_STATES,
    NODES,
    QUARTIC,
    QUINTIC,
    ROTATION,
    ROTATION_RATE,
    SAMPLES_TO_BERNSTEIN,
    full_contact_guards,
    grain_of,
    guards,
    guards_in,
    just_closed,
    kind_of,
    part_of,
    rates,
    side_of,
)
from rockeom.integrator.records import Fall
from rockeom.integrator.rounding import rounding
from rockeom.integrator.tolerances import (
    CLEAR,
    EPS,
    EXACT,
    GAP_AT_REST,
    GAP_ON_LANDING,
    LOOK_AHEAD,
    PASSED,
    SAMPLED,
    SETTLED_CLOSING,
)


@inlined
def rocking(mode):
    """Whether a mode ends by an impact and in no other way."""
    return guards_in(mode) == 1 and kind_of(mode, 0) == IMPACT


@inlined
def stays_open(gap, closed):
    """Whether the gap of a rocking mode clearly stays open in a step, without dense output.

    gap : as of `gap_at_ends`. Where all coefficients are positive by a margin far above its error,
    there is no root; what leaves from rest is zero for long, but for rounding, see `rounding`.
    closed : at the start. Without branches, so that lanes ask it of vectors.
    """
    b0, b1, b2, b3, b4, b5 = gap
    least, grain = CLEAR * max(b0, b5), GAP_AT_REST * b5
    leaves = (b1 > least) & (b2 > least) & ((b0 > least) | closed)
    leaves |= closed & (abs(b1) <= grain) & (b2 >= -grain)
    return leaves & (b3 > least) & (b4 > least) & (b5 > least)


@inlined
def changes_sign_once(gap, closed, least):
    """Whether a gap clearly closes once in a step: its coefficients are positive, then negative.

    By a margin as in `stays_open`. Behind the first that is not clearly positive none is, and
    behind a negative one all are: then there is one root. least : of what the gap is at the start,
    or of how it opens there from closed, in units of the margin.
    """
    b0, b1, b2, b3, b4, b5 = gap
    doubt = CLEAR * max(max(abs(b1), abs(b2)), max(abs(b3), abs(b4)))
    once = ((b0 > least * doubt) | (closed & (b1 > least * doubt))) & (b5 < -doubt)
    once &= ((b2 > doubt) | (b3 <= doubt)) & ((b3 > doubt) | (b4 <= doubt))
    once &= ((b2 >= -doubt) | (b3 < -doubt)) & ((b3 >= -doubt) | (b4 < -doubt))
    return once & ((b2 > doubt) | (b4 <= doubt)) & ((b1 > doubt) | ((b2 < -doubt) & (b3 < -doubt)))


def closes_once(gap, closed):
    """Place in a step at which the gap of a rocking mode clearly closes, once, or NEVER."""
    if not changes_sign_once(gap, closed, 1.0):
        return NEVER
    b0, b1, b2, b3, b4, b5 = gap
    # Newton's method within a bracket, from the parabola with the same ends and slope
    low, high = 0.0, 1.0
    rise = 5.0 * (b1 - b0)
    bend = b0 + rise - b5
    x = (rise + math.sqrt(max(rise * rise + 4.0 * bend * b0, 0.0))) / (2.0 * bend)
    for _ in range(30):
        if not low < x < high:
            x = 0.5 * (low + high)
        c0, c1, c2 = b0 + x * (b1 - b0), b1 + x * (b2 - b1), b2 + x * (b3 - b2)
        c3, c4 = b3 + x * (b4 - b3), b4 + x * (b5 - b4)
        c0, c1, c2 = c0 + x * (c1 - c0), c1 + x * (c2 - c1), c2 + x * (c3 - c2)
        c3 += x * (c4 - c3)
        c0, c1, c2 = c0 + x * (c1 - c0), c1 + x * (c2 - c1), c2 + x * (c3 - c2)
        c0, c1 = c0 + x * (c1 - c0), c1 + x * (c2 - c1)
        value, slope = c0 + x * (c1 - c0), 5.0 * (c1 - c0)
        if value > 0.0:
            low = x
        else:
            high = x
        move = value / slope if slope < 0.0 else 1.0
        x -= move
        if abs(move) < SETTLED_CLOSING:  # the error left is about the square of that
            return x if 0.0 < x < 1.0 else NEVER
    return NEVER


@inlined
def rises_and_falls(gap):
    """Whether a gap that opens stays open until beside the end of a step, where it closes."""
    _, b1, b2, b3, b4, _ = gap
    least = CLEAR * max(b2, b3)
    return b1 > least and b2 > least and b3 > least and b4 > least


@inlined
def to_impact(side, y_new, k):
    """Time from the end of a step to the impact beside it; infinite where the gap does not close.

    By the parabola there, from which it differs by the third power of that time.
    """
    q, v = side * y_new[ROTATION], side * y_new[ROTATION_RATE]
    if not v < 0.0:
        return np.inf
    move = -q / v
    return move - 0.5 * side * k[N_STAGES * N_STATES + ROTATION_RATE] * move * move / v


def stays_held(mode, t, h, ground, case, a):
    """Whether all guards of a mode clearly stay open in a step, without dense output.

    They are sampled on the quintics through both ends, see `stays_open`.
    """
    if FULL_CONTACT >= 0 and mode == FULL_CONTACT and straight(ground):
        return stays_on_both_feet(t, h, a.y, a.y_new, a.k, case.p, ground[0].row)
    n, w, g, b, quintics = N_STATES // 2, a.w, a.g, a.b, a.stack
    quintics_through_ends(h, a.y, a.y_new, a.k, quintics)
    for m in range(8):
        for i in range(n):
            at = 8 * i + 1
            place = QUINTIC[m, 0] * quintics[at]
            slope = 0.0
            for j in range(5):
                place += QUINTIC[m, j + 1] * quintics[at + j + 1]
                slope += QUARTIC[m, j] * (quintics[at + j + 1] - quintics[at + j])
            w[i], w[n + i] = place, slope * (5.0 / h)
        guards_at(mode, t + NODES[m] * h, w, case.p, ground, g)
        for n_g in range(N_GUARDS + N_PARTS):
            b[8 * n_g + m] = g[n_g]
    for n_g in range(guards_in(mode)):
        held = clearly_open(b, 8 * n_g)
        if N_PARTS > 0 and part_of(mode, n_g) >= 0:
            part = 8 * part_of(mode, n_g)
            held = clearly_open(b, part) or clearly_open(b, part + 8)
        if not held:
            return False
    return True


def stays_on_both_feet(t, h, y, y_new, k, p, row):
    """The same for guards that are sums of the state and of ground that moves in a straight line.

    The coefficients of such a sum are the sums of those of the quintics, and of their slopes.
    """
    n = N_STATES // 2
    quintics, w, g = np.empty(8 * (N_STATES // 2)), np.empty(N_STATES), np.empty(N_GUARDS + N_PARTS)
    quintics_through_ends(h, y, y_new, k, quintics)
    rate, ground, change = 1.0 / h, ground_acceleration(row, t), 0.2 * h * row[4]
    least, most, total = np.inf, 0.0, 0.0
    w[ROTATION] = w[ROTATION_RATE] = 0.0
    for j in range(6):
        for i in range(n):
            if i != ROTATION:
                at = 8 * i + j
                before, here, behind = quintics[at], quintics[at + 1], quintics[at + 2]
                w[i] = here
                w[n + i] = rate * (j * (here - before) + (5 - j) * (behind - here))
        full_contact_guards(w, p, ground + j * change, g)
        for n_g in range(N_GUARDS):
            least, most, total = min(least, g[n_g]), max(most, g[n_g]), total + g[n_g]
    return CLEAR * most < least and math.isfinite(total)


@inlined
def acts_beside(mode, guard, there, away):
    """Whether forces that act beside a closed gap only may, where a guard is closed."""
    return LOCALISED and guard >= 0 and beside_gap(mode, guard, there, away)


@inlined
def beside_gap(mode, guard, there, away):
    """Whether a guard is a gap, or is closed where the gap is small beside the step's other end."""
    small = abs(there[ROTATION]) < 0.1 * abs(away[ROTATION])
    return kind_of(mode, guard) == IMPACT or small


@inlined
def guards_at(mode, t, y, p, ground, g):
    """The guards of a mode in a state at a time of the ground's segments, into g."""
    guards(mode, y, p, *ground_accelerations(ground, t), g)


def guard_polynomials(mode, t, h, ground, case, a):
    """Bernstein coefficients of all guards over the step of the dense output, into b (m * 8,)."""
    w, g, b = a.w, a.g, a.b
    sampled = False
    for n in range(guards_in(mode)):
        if kind_of(mode, n) != IMPACT:
            sampled = True
            continue
        # the guard of an impact is the rotation, on its side: exactly the dense output
        polynomial_of(ROTATION, side_of(mode), a.coefficients, b, 8 * n)
    if not sampled:
        return
    for n in range(N_GUARDS + N_PARTS):
        if n >= N_GUARDS or kind_of(mode, n) != IMPACT:
            for i in range(8):
                b[8 * n + i] = 0.0
    for m in range(8):
        dense_at(a.coefficients, NODES[m], w)
        guards_at(mode, t + NODES[m] * h, w, case.p, ground, g)
        for n in range(N_GUARDS + N_PARTS):
            if n >= N_GUARDS or kind_of(mode, n) != IMPACT:
                for i in range(8):
                    b[8 * n + i] += SAMPLES_TO_BERNSTEIN[i, m] * g[n]


def first_event(mode, t, h, instant, landed, closed, ground, case, a):
    """The first guard that falls through zero in a step, see `Fall`; NEVER where none does.

    a.b : the polynomials of all guards. instant : events in a shorter time are at the start.
    landed : the guard that ends the step already, or -1. closed : those known to be so at the
    start: an event was just there.
    """
    first = Fall(NEVER, -1, 0.0, False, False)
    b = a.b
    shaking = ground_accelerations(ground, t)
    for i in range(guards_in(mode)):
        at_event = just_closed(closed, i)
        if i == landed or (landed >= 0 and at_event):
            continue
        starts_closed = at_event or closed_but_for_rounding(mode, i, shaking, h, case, a)
        noise = 0.0
        if starts_closed:
            noise = rounding(mode, i, h, a.y, case.p, shaking, b)
            noise = max(noise, grain_of(mode, i, shaking, h, b, 8, case, a))
        place, row = fall_of_guard(mode, i, starts_closed, noise, a)
        # a guard that is closed by the same event, and opens, falls later if at all
        beside = starts_closed and not at_event and place * h <= instant
        if not place < first.place or (beside and rises_first(b, 8 * row, noise)):
            continue
        largest = size(b, 8 * row)
        if largest <= grain_of(mode, i, shaking, h, b, 8, case, a):
            continue  # it hovers: nothing but rounding errors
        touches = not rocking(mode) and abs(b[8 * row]) <= SAMPLED * largest
        first = Fall(
            place,
            guard=i,
            slope=bernstein_at(b, 8 * row, place)[1] / h,
            from_closed=(starts_closed or touches) and not beside,
            unclear=at_event and abs(b[8 * row + 1]) <= noise,
        )
    return first


@inlined
def is_whole(mode, guard):
    """Whether a guard has one polynomial, and not the larger of two parts."""
    return N_PARTS == 0 or part_of(mode, guard) < 0


@inlined
def closed_but_for_rounding(mode, guard, shaking, h, case, a):
    """Whether a guard is below zero at the start by rounding: an event before closed it, too."""
    start = a.b[8 * guard]
    if not start < 0.0 or not is_whole(mode, guard) or rocking(mode):
        return False
    near = grain_of(mode, guard, shaking, h, a.b, 8, case, a)
    if kind_of(mode, guard) == IMPACT:
        near = GAP_ON_LANDING * case.fallen
    return start >= -near


@inlined
def fall_of_guard(mode, guard, starts_closed, noise, a):
    """(place, row): where in a step a guard first falls, and the row of its polynomial in a.b."""
    if not is_whole(mode, guard):
        return larger_falls(a.b, part_of(mode, guard), starts_closed, noise, a.stack)
    grain = EXACT if kind_of(mode, guard) == IMPACT else SAMPLED
    return first_fall(a.b, 8 * guard, grain, starts_closed, noise, a.stack), guard


def settle(mode, t, h, closed, ground, case, a):
    """Index of a guard that is below zero and stays there, the lowest if there are several; or -1.

    The acceleration of the ground may jump where a segment begins, and a new mode may be one that
    cannot last. Impacts happen only in motion, and are left out; so are the guard through which the
    state has just come, and one that rounding left below zero while it rises.
    """
    if guards_in(mode) == 0 or rocking(mode):
        return -1
    due = -1
    moved = False
    w, g, rate = a.w, a.g, a.k
    shaking = ground_accelerations(ground, t)
    guards(mode, a.y, case.p, *shaking, g)
    for i in range(guards_in(mode)):
        at_event = just_closed(closed, i)
        kind = kind_of(mode, i)
        if at_event or kind in (IMPACT, LANDING) or not g[i] < 0.0:
            continue
        if not moved:
            # look ahead, by some of the errors that the time of an event may have
            moved = True
            tau = max(64.0 * EPS * max(t, h), LOOK_AHEAD * case.rtol * h)
            rates(mode, a.y, case.p, *shaking, rate)
            for n in range(N_STATES):
                w[n] = a.y[n] + tau * rate[n]
            guards_at(mode, t + tau, w, case.p, ground, g)
        if g[i] < 0.0 and (due < 0 or g[i] < g[due]):
            due = i
    if due >= 0:
        value = g[due]
        if value >= -grain_of(mode, due, shaking, 0.0, g, 1, case, a):
            return -1
    return due


def opens_soon(mode, index, t, h, ground, case, a, noise):
    """Whether a guard that is closed at t is open a little later, by its motion to third order.

    Where shaking begins from nothing it is the change of the acceleration that opens it. It may be
    open for a short part of the step only. noise : rounding errors of the guard.
    """
    tau, n = h / 64.0, N_STATES // 2
    y, k, w, g, later = a.y, a.k, a.w, a.g, a.after
    for _ in range(4):
        for i in range(n):
            w[i] = y[i] + tau * (y[n + i] + 0.5 * tau * k[n + i])
            w[n + i] = y[n + i] + tau * k[n + i]
        shaking = ground_accelerations(ground, t + tau)
        rates(mode, w, case.p, *shaking, later)
        for i in range(n):
            w[i] += tau * tau * (later[n + i] - k[n + i]) / 6.0
            w[n + i] += 0.5 * tau * (later[n + i] - k[n + i])
        guards(mode, w, case.p, *shaking, g)
        if g[index] > noise:
            return True
        tau /= 32.0
    return 0.0 < noise >= abs(g[index])  # nothing but rounding errors at first: who knows


@inlined
def fell_before(mode, target, closed, h, y, g, b):
    """Whether another guard fell before the event that a step ends on, by more than rounding.

    An event at which a guard hardly touches zero is corrected by much: it may pass another one.
    Forces are judged by `settle` after it, but for friction, of which a load that vanishes leaves
    nothing: it is overcome before.
    """
    for i in range(guards_in(mode)):
        kind = kind_of(mode, i)
        if i == target or kind in (UPLIFT, LIFTING) or (kind == SLIPPING and not BENT):
            continue
        if kind == IMPACT:
            fell = -g[i] > PASSED * h * abs(y[ROTATION_RATE])
        else:
            fell = -g[i] > PASSED * size(b, 8 * i) and b[8 * i] > 0.0 and not just_closed(closed, i)
        if fell:
            return True
    return False


def overlooks(mode, t, h, ground, case, a, at_end):
    """Whether a step passed over forces that act beside a closed gap only, unseen by its stages.

    The dense output is asked closer and closer to the end of the step, or to its start, whether it
    obeys the equations: the velocity that it lacks there must be small compared with the tolerance.
    """
    n, w, rate = N_STATES // 2, a.w, a.after
    part = 0.25
    for _ in range(11):
        part *= 0.5
        x = 1.0 - part if at_end else part
        tau = t + x * h
        dense_at(a.coefficients, x, w)
        rates(mode, w, case.p, *ground_accelerations(ground, tau), rate)
        for i in range(n, N_STATES):
            slope, _ = slope_at(a.coefficients, x, i)
            lacks = part * abs(h * rate[i] - slope)
            if lacks > 100.0 * (case.atol[i] + case.rtol * abs(w[i])):
                return True
    return False
