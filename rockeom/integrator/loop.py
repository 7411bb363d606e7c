"""The integration loop: one text for every structure and method.

This file is not imported. `rockeom.integrator.program` joins it to a generated module (which
defines rates, guards, jump, opening_acceleration and the tables) and to the text of a step
(take_step, dense_output), so that the compiler sees one self-contained program.

It reads in the order of the work: settle what is due, step, find the first event, land on it,
jump, go on. Ahead of all that, steps in which nothing happens are taken by `uneventful_steps`.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import (
    AMBIGUOUS,
    AT_SPEED,
    AT_THE_START,
    BY_FOOT,
    BY_NUMBER,
    CAME_TO_REST,
    CHATTER,
    COMPLETED,
    CONTACT,
    ENERGY_ROUNDING,
    EVENTS_KEPT,
    FRESH,
    FULL,
    IDLE,
    IMPACT,
    IMPACTS,
    IMPOSSIBLE,
    LANDING,
    LAST_ERROR,
    LIFTING,
    NEWS,
    NEXT_STEP,
    NO_SOLUTION,
    NOT_FINITE,
    OVERTURNED,
    RATIO,
    REFINED,
    REFINED_TO,
    REST,
    SEVERAL_SOLUTIONS,
    SLIPPING,
    STALLED,
    STAYS_OPEN,
    STEPPED_OVER,
    STEPS_KEPT,
    SWITCH,
    TAKEN,
    TIME,
    TOO_MANY_IMPACTS,
    TOUCHING,
    UPLIFT,
)
from rockeom.compiler.decorators import Floats, Floats2, Floats3, Ints, Ints2, entry, inlined

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.interface import (
        CLOSED,
        COARSE,
        ERROR_EXPONENT,
        FALLS,
        GUARDS,
        HELD,
        KINDS,
        N_ALL_STAGES,
        N_FALLS,
        N_GUARDS,
        N_KNOWN,
        N_PARTS,
        N_POINTS,
        N_STAGES,
        N_STATES,
        NARROW,
        NODES,
        PARTS,
        POWERS_TO_BERNSTEIN,
        QUARTIC,
        QUINTIC,
        ROTATION,
        ROTATION_RATE,
        ROUNDER,
        SAMPLES_TO_BERNSTEIN,
        SIDES,
        STAGE_TIMES,
        TARGETS,
        dense_output,
        end_closed,
        energies,
        fall_within,
        fits_by_forces,
        guard_noise,
        guards,
        held_guards,
        held_upright,
        is_closed,
        is_rounding,
        jump,
        kinematics,
        longest_turn,
        nothing_moves,
        only_hop,
        opening_acceleration,
        overturns_at,
        pass_on,
        rates,
        reactions,
        step_over,
        still_closed,
        take_step,
        time_of_bounces,
        to_landing,
    )

TURN = 20_000  # steps after which a call returns, so that Python may answer an interrupt
MOST_IDLE, MOST_IDLE_POINTS = 100, 1000  # events at one instant; with more they are chatter
CROWDED = 20  # after so many of them points step over the time of a rest
CLOSED_GAP = 1e-12  # of the overturning rotation: by so much feet may miss the ground on landing

# Places in the loop's scratch array
_K = 0
_W = _K + N_ALL_STAGES * (N_STATES + 2)
_Y_NEW = _W + N_STATES
_AFTER = _Y_NEW + N_STATES
_POWERS = _AFTER + N_STATES
_GUARDS = _POWERS + 8 * N_STATES
_BERNSTEIN = _GUARDS + N_GUARDS + N_PARTS
_STACK = _BERNSTEIN + 8 * (N_GUARDS + N_PARTS + 1)
_NOISE = _STACK + 640
_KNOWN = _NOISE + (len(SIDES) + 1) * (N_GUARDS + N_PARTS)
SCRATCH = _KNOWN + N_KNOWN

EPS = 2.220446049250313e-16
EXACT, SAMPLED = 8.0 * EPS, 64.0 * EPS  # rounding in the coefficients of a guard's polynomial
NEVER = 2.0  # a place behind the end of any step
MOST_PARTS = 4096  # of a polynomial that are looked at: seven roots need some 600


@inlined
def sine(x):
    """Sine, within 2.5e-16: its Taylor series about multiples of pi, of which odd ones turn it."""
    n = (x * 0.3183098861837907 + ROUNDER) - ROUNDER
    r = (x - n * 3.1415926534682512) - n * 1.2154201013012384e-10
    odd = n - 2.0 * ((0.5 * n + ROUNDER) - ROUNDER)
    z = r * r
    zz = z * z
    s0 = -1 / 6 + z * (1 / 120)
    s1 = -1 / 5040 + z * (1 / 362880)
    s2 = -1 / 39916800 + z * (1 / 6227020800)
    s3 = -1 / 1307674368000 + z * (1 / 355687428096000)
    s4 = -1 / 121645100408832000 + z * (1 / 51090942171709440000)
    s1 += zz * s2
    s3 += zz * s4
    return (1.0 - 2.0 * odd * odd) * (r + r * z * (s0 + zz * (s1 + zz * zz * s3)))


def pulse(row, t):
    """Ground acceleration at t by a curved law, see `shaking`."""
    kind = row[2]
    tau = t - row[0]
    if kind == 1.0:  # sine
        return row[3] * sine(row[4] * tau + row[5])
    if kind == 4.0:
        return mavroeidis_papageorgiou(row, tau)
    # expm1, since the compiler would call exp for every law, just in case
    x = row[4] * (tau - row[5])
    if kind == 2.0:  # symmetric Ricker
        return row[3] * (1.0 - 2.0 * x * x) / (1.0 + math.expm1(x * x))
    return row[3] * x * (x * x - 3.0) / (1.0 + math.expm1(0.5 * x * x))


def mavroeidis_papageorgiou(row, tau):
    """Ground acceleration by the pulse of Mavroeidis and Papageorgiou: three sines."""
    ratio, angle, turn = row[6] / row[4], row[4] * tau + row[5], row[6] * tau
    beside = (1.0 + ratio) * sine(angle + turn) + (1.0 - ratio) * sine(angle - turn)
    return row[3] * (0.5 * beside - sine(angle))


@inlined
def shaking(row, t):
    """Ground acceleration at t by the law in a row of a motion's table."""
    if row[2] == 0.0:  # linear
        return row[3] + row[4] * (t - row[0])
    return pulse(row, t)


@inlined
def shake(row, t, h, first, last, out, at):
    """Ground accelerations at the stages from `first` to before `last` of a step, to out[at + j].

    They do not wait for the state, so that the compiler may find several at once.
    """
    if row[2] == 0.0:
        start, change = row[3] + row[4] * (t - row[0]), row[4] * h
        for j in range(first, last):
            out[at + j] = start + STAGE_TIMES[j] * change
    else:
        shake_by_curve(row, t, h, first, last, out, at)


def shake_by_curve(row, t, h, first, last, out, at):
    if row[2] == 1.0:
        angle, turn, size = row[4] * (t - row[0]) + row[5], row[4] * h, row[3]
        for j in range(first, last):
            out[at + j] = size * sine(angle + STAGE_TIMES[j] * turn)
    else:
        for j in range(first, last):
            out[at + j] = pulse(row, t + STAGE_TIMES[j] * h)


QUIET = (0.0, np.inf, 0.0, 0.0, 0.0, 0.0, 0.0)
"""The row of ground that stands still."""


@inlined
def row_at(table, n, t):
    """(n, row) of a motion's table that holds at t and after it, from row n on; quiet behind it."""
    while n < table.shape[0] and t >= table[n, 1]:
        n += 1
    if n == table.shape[0]:
        return n, QUIET
    return n, row_of(table, n)


@inlined
def row_of(table, n):
    return (
        table[n, 0], table[n, 1], table[n, 2], table[n, 3], table[n, 4], table[n, 5], table[n, 6]
    )  # fmt: skip


# -- first fall of a guard through zero ----------------------------------------------------------


@inlined
def bernstein_at(b, at, x):
    """Value and slope at x of the polynomial with Bernstein coefficients b[at : at + 8].

    De Casteljau's scheme, written out.
    """
    a0, a1, a2, a3 = b[at], b[at + 1], b[at + 2], b[at + 3]
    a4, a5, a6, a7 = b[at + 4], b[at + 5], b[at + 6], b[at + 7]
    a0, a1, a2, a3 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2), a3 + x * (a4 - a3)
    a4, a5, a6 = a4 + x * (a5 - a4), a5 + x * (a6 - a5), a6 + x * (a7 - a6)
    a0, a1, a2 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2)
    a3, a4, a5 = a3 + x * (a4 - a3), a4 + x * (a5 - a4), a5 + x * (a6 - a5)
    a0, a1, a2 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2)
    a3, a4 = a3 + x * (a4 - a3), a4 + x * (a5 - a4)
    a0, a1 = a0 + x * (a1 - a0), a1 + x * (a2 - a1)
    a2, a3 = a2 + x * (a3 - a2), a3 + x * (a4 - a3)
    a0, a1, a2 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2)
    a0, a1 = a0 + x * (a1 - a0), a1 + x * (a2 - a1)
    return a0 + x * (a1 - a0), 7.0 * (a1 - a0)


def first_fall(b, at, grain, touching, noise, stack):
    """Smallest x in (0, 1] at which a polynomial falls through zero, or NEVER.

    b[at : at + 8] Bernstein coefficients on [0, 1]. Its coefficients bound a polynomial, and the
    number of their changes of sign bounds that of its roots: a part without change has no root, a
    part with one has one, other parts are halved. So no pair of roots is stepped over.

    grain : rounding error of a coefficient, relative to the largest.
    touching : the guard was closed at x = 0 (an event was just there); that root is no other event.
    noise : beside x = 0 coefficients below it are rounding errors.
    stack (640,) : scratch; ten places hold the coefficients of a part, its start and its width.
    """
    scale = size(b, at)
    if scale == 0.0:
        return NEVER
    opening = max(grain * scale, noise)
    noise = grain * scale
    for i in range(8):
        stack[i] = b[at + i]
    if touching:
        stack[0] = 0.0
    stack[8], stack[9] = 0.0, 1.0
    before = -1 if b[at] < -noise and not touching else 1  # sign before a part
    part = 0
    for _ in range(MOST_PARTS):
        if part < 0:
            break
        start, width = stack[part + 8], stack[part + 9]
        negligible = opening if start == 0.0 else noise
        changes = 0
        first = sign = 0
        for i in range(8):
            if abs(stack[part + i]) > negligible:
                new = 1 if stack[part + i] > 0.0 else -1
                if sign == 0:
                    first = new
                elif new != sign:
                    changes += 1
                sign = new
        decided = changes == 0 or width < 1e-13
        ends = abs(stack[part + 7]) > negligible  # else the last change of sign may be none
        if first < 0 and before > 0 and decided:
            return start  # it falls exactly where this part begins
        if changes == 0:
            before = sign if sign != 0 else before
            part -= 10
        elif decided or (changes == 1 and first == before and ends):
            if first > 0:
                return start + width * fall(stack, part)
            before = sign  # begins below zero and rises
            part -= 10
        else:
            # halve: de Casteljau gives both halves at once; the lower one is looked at first
            lower = part + 10
            for n in range(7, -1, -1):
                stack[lower + 7 - n] = stack[part]
                for i in range(part, part + n):
                    stack[i] = 0.5 * (stack[i] + stack[i + 1])
            stack[lower + 8], stack[lower + 9] = start, 0.5 * width
            stack[part + 8], stack[part + 9] = start + 0.5 * width, 0.5 * width
            part = lower
    if part >= 0:
        return stack[part + 8]  # given up: the step is looked at again, shorter
    return NEVER if before > 0 or b[at] >= -noise else 0.0  # 0: below zero all along


def larger_falls(b, part, touching, noise, stack):
    """(place, part): where the larger of two polynomials first falls through zero, and which it is.

    b : the Bernstein coefficients of both begin at 8 * part and 8 * (part + 1); its last eight
        places are scratch. Each may fall and rise while the other holds the guard open.
    """
    p = 0.0
    risen = -1.0  # where the guard opens that begins below zero
    open_ = part if b[8 * part] >= b[8 * part + 8] else part + 1
    rest = 8 * (N_GUARDS + N_PARTS)
    if not touching and not starts_open(b, 8 * open_):
        open_ = 2 * part + 1 - open_
        if not starts_open(b, 8 * open_):
            p = NEVER
            for i in range(part, part + 2):
                for j in range(8):
                    b[rest + j] = -b[8 * i + j]
                x = first_fall(b, rest, SAMPLED, False, 0.0, stack)
                if x < p:
                    p, open_ = x, i
            if p == NEVER:
                return 0.0, open_
            risen = p
    for _ in range(32):  # two polynomials of degree seven cross zero 14 times
        part_from(b, 8 * open_, p, rest)
        touches = (touching and p == 0.0) or p == risen
        x = first_fall(b, rest, SAMPLED, touches, noise if p == 0.0 else 0.0, stack)
        if x == NEVER:
            return NEVER, open_
        p += (1.0 - p) * x
        other = 2 * part + 1 - open_
        if bernstein_at(b, 8 * other, p)[0] <= SAMPLED * size(b, 8 * other):
            return p, open_
        open_ = other
    return p, open_


def rises_first(b, at, noise):
    """Whether a polynomial beside zero is above it where it is first more than noise."""
    x = 1e-6
    for _ in range(20):
        value, _ = bernstein_at(b, at, x)
        if abs(value) > noise:
            return value > 0.0
        x *= 2.0
    return True


def starts_open(b, at):
    """Whether a polynomial is positive at zero, or opens there."""
    noise = SAMPLED * size(b, at)
    for i in range(8):
        if abs(b[at + i]) > noise:
            return b[at + i] > 0.0
    return False


def part_from(b, at, x, to):
    """Bernstein coefficients b[to : to + 8] on [x, 1] of a polynomial."""
    for i in range(8):
        b[to + i] = b[at + i]
    for n in range(7, 0, -1):
        for i in range(n):
            b[to + i] += x * (b[to + i + 1] - b[to + i])


def size(b, at):
    largest = 0.0
    for i in range(8):
        largest = max(largest, abs(b[at + i]))
    return largest


def fall(b, at):
    """The single fall through zero on [0, 1], by Newton's method within a bracket."""
    low, high = 0.0, 1.0
    # start from the parabola with the same ends and slope: a hop is nearly one
    rise = 7.0 * (b[at + 1] - b[at])
    bend = b[at] + rise - b[at + 7]
    x = 0.5
    if bend > 0.0 and b[at] >= 0.0:
        x = (rise + math.sqrt(rise * rise + 4.0 * bend * b[at])) / (2.0 * bend)
    if not 0.0 < x < 1.0:
        x = 0.5
    for n in range(200):
        value, slope = bernstein_at(b, at, x)
        if value > 0.0:
            low = x
        else:
            high = x
        step = -value / slope if slope < 0.0 else np.inf
        x += step
        if abs(step) <= 1e-10 or high - low <= 2.0 * EPS:
            break  # the error left is about the square of that
        if not low < x < high or n % 8 == 7:
            x = 0.5 * (low + high)
    return min(max(x, low), high)


@inlined
def power_sum(coefficients, x, i):
    """State i at x in [0, 1] of a step from its dense output (8 * N,)."""
    value = coefficients[7 * N_STATES + i]
    for j in range(6, -1, -1):
        value = value * x + coefficients[j * N_STATES + i]
    return value


def dense_at(coefficients, x, out):
    """All states at x in [0, 1] of a step, into out (N,)."""
    for i in range(N_STATES):
        out[i] = power_sum(coefficients, x, i)


@inlined
def quintic_of(i, side, h, y, y_new, k):
    """Bernstein coefficients of coordinate i to a side, by place, rate and acceleration at both
    ends."""
    n = N_STATES // 2
    fifth, part = 0.2 * side * h, 0.05 * side * h * h
    q0, q1 = side * y[i], side * y_new[i]
    v0, v1 = fifth * y[n + i], fifth * y_new[n + i]
    a0, a1 = part * k[n + i], part * k[N_STAGES * N_STATES + n + i]
    return q0, q0 + v0, q0 + 2.0 * v0 + a0, q1 - 2.0 * v1 + a1, q1 - v1, q1


@inlined
def gap_at_ends(side, h, y, y_new, k):
    """The same of the gap, the rotation to a side; of the rotation itself without one, 0.0."""
    return quintic_of(ROTATION, 1.0 if side == 0.0 else side, h, y, y_new, k)


@inlined
def stays_open(gap, touching):
    """Whether the gap of a rocking phase clearly stays open in a step, without dense output.

    gap : as of `gap_at_ends`. Where all coefficients are positive by a margin far above its error,
    there is no root; what leaves from rest is zero for long, but for rounding, see `rounding`.
    """
    b0, b1, b2, b3, b4, b5 = gap
    least, grain = 1e-3 * max(b0, b5), 1e-11 * b5
    leaves = b1 > least and b2 > least and (b0 > least or touching == 0)
    leaves = leaves or (touching == 0 and abs(b1) <= grain and b2 >= -grain)
    return leaves and b3 > least and b4 > least and b5 > least


def closes_once(gap, touching):
    """Place in a step at which the gap of a rocking phase clearly closes, once, or NEVER.

    Where the coefficients change their sign once, by a margin as in `stays_open`, there is one
    root.
    """
    b0, b1, b2, b3, b4, b5 = gap
    doubt = 1e-3 * max(max(abs(b1), abs(b2)), max(abs(b3), abs(b4)))
    if (touching != 0 and b0 <= doubt) or (touching == 0 and b1 <= doubt) or b5 >= -doubt:
        return NEVER
    # behind the first that is not clearly positive, none is; behind a negative one, all are
    falls = (b2 > doubt or b3 <= doubt) and (b3 > doubt or b4 <= doubt)
    falls = falls and (b2 >= -doubt or b3 < -doubt) and (b3 >= -doubt or b4 < -doubt)
    falls = falls and (b2 > doubt or b4 <= doubt)
    if not (falls and (b1 > doubt or (b2 < -doubt and b3 < -doubt))):
        return NEVER
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
        if abs(move) < 1e-7:  # the error left is about the square of that
            return x if 0.0 < x < 1.0 else NEVER
    return NEVER


@inlined
def rises_and_falls(gap):
    """Whether a gap that opens stays open until beside the end of a step, where it closes."""
    _, b1, b2, b3, b4, _ = gap
    least = 1e-3 * max(b2, b3)
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


def extrapolate(h, move, y, y_new, k):
    """Move the end of a step by a small part of it, on the quintics through both ends."""
    n = N_STATES // 2
    part = move / h
    for i in range(n):
        v0, v1 = h * y[n + i], h * y_new[n + i]
        a0, a1 = h * h * k[n + i], h * h * k[N_STAGES * N_STATES + n + i]
        jerk = 60.0 * (y_new[i] - y[i]) - 36.0 * v1 - 24.0 * v0 + 9.0 * a1 - 3.0 * a0
        y_new[i] += part * (v1 + part * (0.5 * a1 + part * jerk / 6.0))
        y_new[n + i] += part * (a1 + 0.5 * part * jerk) / h


@inlined
def quintics_through_ends(h, y, y_new, k, quintics):
    """The coefficients of all coordinates, those of coordinate i from 8 * i + 1 on.

    The first and the last stand there twice, so that their differences know no end.
    """
    for i in range(N_STATES // 2):
        b0, b1, b2, b3, b4, b5 = quintic_of(i, 1.0, h, y, y_new, k)
        at = 8 * i
        quintics[at] = quintics[at + 1] = b0
        quintics[at + 2], quintics[at + 3], quintics[at + 4], quintics[at + 5] = b1, b2, b3, b4
        quintics[at + 6] = quintics[at + 7] = b5


def stays_held(contact, t, h, y, y_new, k, p, gx, gy, w, g, b, quintics):
    """Whether all guards of a contact state clearly stay open in a step, without dense output.

    They are sampled on the quintics through both ends, see `stays_open`. quintics : scratch.
    """
    if HELD >= 0 and contact == HELD and straight(gx, gy):
        return stays_on_both_feet(t, h, y, y_new, k, p, gx)
    n = N_STATES // 2
    quintics_through_ends(h, y, y_new, k, quintics)
    for m in range(8):
        for i in range(n):
            at = 8 * i + 1
            place = QUINTIC[m, 0] * quintics[at]
            slope = 0.0
            for j in range(5):
                place += QUINTIC[m, j + 1] * quintics[at + j + 1]
                slope += QUARTIC[m, j] * (quintics[at + j + 1] - quintics[at + j])
            w[i], w[n + i] = place, slope * (5.0 / h)
        tau = t + NODES[m] * h
        guards(contact, w, p, shaking(gx, tau), shaking(gy, tau), g)
        for n_g in range(N_GUARDS + N_PARTS):
            b[8 * n_g + m] = g[n_g]
    for n_g in range(GUARDS[contact]):
        held = clearly_open(b, 8 * n_g)
        if N_PARTS > 0 and PARTS[contact][n_g] >= 0:
            part = 8 * PARTS[contact][n_g]
            held = clearly_open(b, part) or clearly_open(b, part + 8)
        if not held:
            return False
    return True


def stays_on_both_feet(t, h, y, y_new, k, p, gx):
    """The same for guards that are sums of the state and of ground that moves in a straight line.

    The coefficients of such a sum are the sums of those of the quintics, and of their slopes.
    """
    n = N_STATES // 2
    quintics, w, g = np.empty(8 * (N_STATES // 2)), np.empty(N_STATES), np.empty(N_GUARDS + N_PARTS)
    quintics_through_ends(h, y, y_new, k, quintics)
    rate, ground, change = 1.0 / h, shaking(gx, t), 0.2 * h * gx[4]
    least, most, total = np.inf, 0.0, 0.0
    w[ROTATION] = w[ROTATION_RATE] = 0.0
    for j in range(6):
        for i in range(n):
            if i != ROTATION:
                at = 8 * i + j
                before, here, behind = quintics[at], quintics[at + 1], quintics[at + 2]
                w[i] = here
                w[n + i] = rate * (j * (here - before) + (5 - j) * (behind - here))
        held_guards(w, p, ground + j * change, g)
        for n_g in range(N_GUARDS):
            least, most, total = min(least, g[n_g]), max(most, g[n_g]), total + g[n_g]
    return 1e-3 * most < least and math.isfinite(total)


@inlined
def cannot_move(contact, rate, y, p):
    """Whether a structure stands on both its feet, and has no state that could move there."""
    if (N_STATES > 2 and N_POINTS == 0) or N_PARTS > 0 or SIDES[contact] != 0.0:
        return False
    for i in range(N_STATES):
        if rate[i] != 0.0:
            return False
    for n in range(GUARDS[contact]):
        kind = KINDS[contact][n]
        if kind != UPLIFT and kind != LIFTING and kind != SLIPPING:
            return False
    return True if N_POINTS == 0 else nothing_moves(contact, y, p)


@inlined
def stands_until(contact, t, end, y, p, gx, gy, g):
    """Whether a structure that cannot move stays on both its feet while straight laws last.

    The accelerations with which its feet would lift are linear in those of the ground, so that
    both ends decide.
    """
    if gx[2] != 0.0 or gy[2] != 0.0:
        return False
    for turn in range(2):
        tau = end if turn == 1 else t
        guards(contact, y, p, shaking(gx, tau), shaking(gy, tau), g)
        size = 0.0
        for n in range(GUARDS[contact]):
            size += abs(g[n])
        for n in range(GUARDS[contact]):
            if not g[n] > 1e-9 * size:
                return False
    return True


def overlooks(contact, t, h, p, gx, gy, rtol, atol, coefficients, at_end, w, rate):
    """Whether a step passed over forces that act beside a closed gap only, unseen by its stages.

    The dense output is asked closer and closer to the end of the step, or to its start, whether it
    obeys the equations: what it lacks there of velocity must be small beside the tolerance.
    """
    n = N_STATES // 2
    part = 0.25
    for _ in range(11):
        part *= 0.5
        x = 1.0 - part if at_end else part
        tau = t + x * h
        dense_at(coefficients, x, w)
        rates(contact, w, p, shaking(gx, tau), shaking(gy, tau), rate)
        for i in range(n, N_STATES):
            slope, _ = slope_at(coefficients, x, i)
            lacks = part * abs(h * rate[i] - slope)
            if lacks > 100.0 * (atol[i] + rtol * abs(w[i])):
                return True
    return False


@inlined
def beside_gap(contact, guard, there, away):
    """Whether a guard is a gap, or is closed where the gap is small beside the step's other end."""
    small = abs(there[ROTATION]) < 0.1 * abs(away[ROTATION])
    return KINDS[contact][guard] == IMPACT or small


def clearly_open(b, at):
    """Whether a guard of eight samples b[at : at + 8] stays open, far above a quintic's error.

    All coefficients of its polynomial are positive then by a margin.
    """
    least, most = np.inf, 0.0
    for i in range(8):
        value = 0.0
        for m in range(8):
            value += SAMPLES_TO_BERNSTEIN[i, m] * b[at + m]
        least, most = min(least, value), max(most, abs(value))
    return 1e-3 * most < least < np.inf  # no samples that are not numbers


@inlined
def polynomial_of(state, side, coefficients, b, at):
    """Bernstein coefficients b[at : at + 8] of a state to a side, from the dense output."""
    for i in range(8):
        b[at + i] = 0.0
        for j in range(i + 1):
            power = side * coefficients[j * N_STATES + state]
            b[at + i] += POWERS_TO_BERNSTEIN[i, j] * power


def guard_polynomials(contact, t, h, p, gx, gy, coefficients, w, g, b):
    """Bernstein coefficients of all guards over the step of the dense output, into b (m * 8,)."""
    sampled = False
    for n in range(GUARDS[contact]):
        if KINDS[contact][n] != IMPACT:
            sampled = True
            continue
        # an impact's guard is the rotation, on its side: exactly the dense output
        polynomial_of(ROTATION, SIDES[contact], coefficients, b, 8 * n)
    if not sampled:
        return
    for n in range(N_GUARDS + N_PARTS):
        if n >= N_GUARDS or KINDS[contact][n] != IMPACT:
            for i in range(8):
                b[8 * n + i] = 0.0
    for m in range(8):
        dense_at(coefficients, NODES[m], w)
        tau = t + NODES[m] * h
        guards(contact, w, p, shaking(gx, tau), shaking(gy, tau), g)
        for n in range(N_GUARDS + N_PARTS):
            if n >= N_GUARDS or KINDS[contact][n] != IMPACT:
                for i in range(8):
                    b[8 * n + i] += SAMPLES_TO_BERNSTEIN[i, m] * g[n]


def noise_of(contact, index, p, fallen, noise, w, g):
    """Size of the rounding errors of a switch's guard, by what the last digits of parameters make.

    The force of a tendon is that of its length less another one; near upright nothing but the
    rounding of both may be left, or less than counts beside any other force. Found where the
    structure leans a little, once in each call of the loop: noise holds what is known of the guards
    of each contact state, or -1, and has room for one more.
    """
    if KINDS[contact][index] != SWITCH:
        return 0.0
    first = contact * (N_GUARDS + N_PARTS)
    other = noise[len(SIDES) * (N_GUARDS + N_PARTS) :]
    if noise[first] < 0.0:
        for i in range(N_STATES):
            w[i] = 0.0
        w[ROTATION] = 0.01 * SIDES[contact] * min(fallen, 1.0)
        for i in range(N_GUARDS):
            noise[first + i] = 0.0
        for j in range(p.shape[0]):
            value = p[j]
            p[j] = value * (1.0 + 1e-6)
            guards(contact, w, p, 0.0, 0.0, other)
            p[j] = value * (1.0 - 1e-6)
            guards(contact, w, p, 0.0, 0.0, g)
            p[j] = value
            for i in range(GUARDS[contact]):
                change = abs(other[i] - g[i])
                if change < np.inf:
                    noise[first + i] += 0.5e6 * SAMPLED * change
    return noise[first + index]


@inlined
def grain_of(contact, index, y, p, ax, ay, h, fallen, noise, w, g, b, stride):
    """Size of the rounding errors of a guard: of an element's, or of a gap or a force."""
    return (
        noise_of(contact, index, p, fallen, noise, w, g)
        if N_POINTS == 0
        else noise_of(contact, index, p, fallen, noise, w, g)
        if KINDS[contact][index] == SWITCH
        else guard_noise(contact, index, y, p, ax, ay, h, b, stride)
    )


def rounding(contact, index, h, y, p, ax, ay, b):
    """Size of the rounding errors of a guard that opens from closed.

    A gap that opens without speed grows with the third power of time out of accelerations that
    cancel: what is left of them by rounding acts over the whole step.
    """
    scale = size(b, 8 * index)
    if KINDS[contact][index] != IMPACT:
        left = abs(b[8 * index])
        if N_PARTS > 0 and PARTS[contact][index] >= 0:
            part = 8 * PARTS[contact][index]
            scale = max(size(b, part), size(b, part + 8))
            left = abs(max(b[part], b[part + 8]))
        return max(SAMPLED * scale, min(2.0 * left, 1e-8 * scale))
    acceleration = 0.0
    for other in range(len(SIDES)):
        if SIDES[other] != 0.0:
            acceleration += abs(opening_acceleration(other, y, p, ax, ay))
    return max(1e-11 * scale, 1e-10 * acceleration * h * h)


@inlined
def is_known(touching, i):
    """Whether a guard is known to be closed: the one that `touching` is, or one of several."""
    return touching == i if N_POINTS == 0 else is_closed(touching, i)


def first_event(
    contact, t, h, instant, landed, touching, y, p, gx, gy, fallen, noises, w, g, b, stack
):  # fmt: skip
    """Where in a step a guard first falls through zero, which, and what is known of it there.

    Returns (place, guard, slope, from_closed, unclear): the place in the step, NEVER if no guard
    falls, the slope of its polynomial in time; whether it was closed at the start, and whether
    nothing but rounding errors says that it falls. b : the polynomials of all guards. landed : the
    guard that ends the step already, or -1.
    """
    place, target, slope = NEVER, -1, 0.0
    from_closed = unclear = False
    rocks = rocking(contact)
    ax, ay = shaking(gx, t), shaking(gy, t)
    for i in range(GUARDS[contact]):
        known = is_known(touching, i)
        if i == landed or (landed >= 0 and known):
            continue
        closed = known
        whole = N_PARTS == 0 or PARTS[contact][i] < 0
        if b[8 * i] < 0.0 and whole and not rocks and not closed:
            # beside zero but for rounding, by an event before this one, is closed, too
            near = grain_of(contact, i, y, p, ax, ay, h, fallen, noises, w, g, b, 8)
            if KINDS[contact][i] == IMPACT:
                near = CLOSED_GAP * fallen
            closed = b[8 * i] >= -near
        noise = 0.0
        if closed:
            noise = rounding(contact, i, h, y, p, ax, ay, b)
            grain = grain_of(contact, i, y, p, ax, ay, h, fallen, noises, w, g, b, 8)
            noise = max(noise, grain)
        row = i
        if not whole:
            x, row = larger_falls(b, PARTS[contact][i], closed, noise, stack)
        else:
            grain = EXACT if KINDS[contact][i] == IMPACT else SAMPLED
            x = first_fall(b, 8 * i, grain, closed, noise, stack)
        doubtful = known and abs(b[8 * row + 1]) <= noise
        beside = closed and not known and x * h <= instant
        if beside and rises_first(b, 8 * row, noise):
            continue
        if x < place:
            hover = size(b, 8 * row)
            if hover <= grain_of(contact, i, y, p, ax, ay, h, fallen, noises, w, g, b, 8):
                continue  # nothing but rounding errors
            place = x
            target = i
            unclear = doubtful
            from_closed = closed or (not rocks and abs(b[8 * row]) <= SAMPLED * hover)
            from_closed &= not beside  # else it is known to fall
            slope = bernstein_at(b, 8 * row, x)[1] / h
    return place, target, slope, from_closed, unclear


# -- impacts -------------------------------------------------------------------------------------


@inlined
def ratio_at(law, ratio, impact, y, p):
    """Ratio of the rates of rotation at an impact from the state y; `ratio`, unless tabled.

    impact : its number in the motion.
    """
    return ratio if law < AT_SPEED else tabled_ratio(law, impact, y, p)


def tabled_ratio(law, impact, y, p):
    """The ratio by the table at the end of p, that of the left foot before the right one's.

    The left foot lands where the rotation falls. AT_SPEED: the energy ratio in pieces of the rate,
    rows of limit, value at zero and slope, and their number. BY_FOOT: of each foot the energy ratio
    at no rate, its slope, and what is divided by the rate. BY_NUMBER: of each foot the ratio of
    each impact, and their number, behind which they begin anew.
    """
    speed = abs(y[ROTATION_RATE])
    if law == BY_FOOT:
        end = p.shape[0] if y[ROTATION_RATE] > 0.0 else p.shape[0] - 3
        energy = p[end - 3] + p[end - 2] * speed
        if p[end - 1] != 0.0:
            energy += p[end - 1] / speed
        return math.sqrt(min(max(energy, 0.0), 1.0))
    rows = int(p[-1])
    if law == BY_NUMBER:
        row = p.shape[0] - 1 - (rows if y[ROTATION_RATE] > 0.0 else 2 * rows)
        return p[row + impact - rows * int(impact / rows)]
    row = p.shape[0] - 1 - 3 * rows
    for _ in range(rows - 1):
        if speed < p[row]:
            break
        row += 3
    energy = p[row + 1] + p[row + 2] * speed
    return math.sqrt(energy) if energy <= 1.0 else np.nan


# -- infinitely many impacts ---------------------------------------------------------------------


@inlined
def may_fade(side, y, rate, law, ratio, tolerance):
    """Whether the flight after an impact is short enough for `time_to_rest` to be finite."""
    a, v = -side * rate[ROTATION_RATE], abs(y[ROTATION_RATE])
    longest = tolerance * (1.0 - ratio) if law == RATIO else tolerance
    return a > 0.0 and 4.0 * v * v <= 1.001 * longest * longest * a


def time_to_rest(contact, y, p, law, ratio, impacts, ax, ay, tolerance, w, out, kick):
    """(time, contact): when the infinitely many impacts to come will all have happened.

    Close to the end of a free rocking motion the flights between impacts are parabolas: a flight
    that leaves with gap rate v under the closing acceleration a lasts 2 v / a, and the impact
    map gives the v of the next. Their sum converges. Returns (inf, contact) while it is longer
    than `tolerance` in units of 1/sqrt(a), or while an acceleration opens the gap.

    impacts : how many there were. `out` gets the state in which the structure stands once the
    rotation has given to the other rates what flights and impacts give them; `stand` moves these
    through the time. kick (2 * N,) : scratch.
    """
    held = -1
    for c in range(len(SIDES)):
        if SIDES[c] == 0.0:
            held = c
    if held < 0:
        return np.inf, contact
    for i in range(N_STATES):
        w[i] = y[i]
        kick[i] = 0.0
    smooth = kick[N_STATES:]
    total = flight = a = 0.0
    start = abs(y[ROTATION_RATE])
    loss = whole = 1.0
    last_flight = last_a = last_loss = np.inf  # of the flight before, to the other side
    pairs = True  # of flights to one side and the other are complete
    for turn in range(1000):
        a_before, last_a, last_flight = last_a, a, flight
        pairs = not pairs
        rates(contact, w, p, ax, ay, out)
        a = -SIDES[contact] * out[ROTATION_RATE]
        if not a > 0.0:
            return np.inf, contact
        v = abs(w[ROTATION_RATE])
        flight = 2.0 * v / a
        total += flight
        if total > tolerance / math.sqrt(a):
            return np.inf, contact
        rates(held, w, p, ax, ay, smooth)
        for i in range(N_STATES):
            w[i] += flight * out[i]
            if i >= N_STATES // 2:
                kick[i] += flight * (out[i] - smooth[i])
        w[ROTATION] = 0.0
        # what is left of them counts by the speed that is left
        small = 1e-13 * start
        alike = abs(a - a_before) * v <= small * a and abs(loss - last_loss) * v <= small
        if v <= EPS * start or turn == 999 or (pairs and turn > 2 and alike):
            # what a constant loss leaves of the two series of flights
            left = (1.0 - loss) * (1.0 - (last_loss if law > AT_SPEED else loss))
            total += (last_flight + flight) * left / (1.0 - left)
            w[ROTATION_RATE] = 0.0
            if v > EPS * start:
                whole = 1.0 / (1.0 - (1.0 - loss) * v / start)  # all is in proportion to speeds
        contact = jump(contact, 0, law, ratio_at(law, ratio, impacts + turn, w, p), w, p, out)
        for i in range(N_STATES // 2, N_STATES):
            kick[i] += out[i] - w[i]
        if SIDES[contact] == 0.0:
            for i in range(N_STATES):
                out[i] = y[i] + whole * kick[i]
            out[ROTATION] = out[ROTATION_RATE] = 0.0
            return total, contact
        last_loss = loss
        loss = 1.0 - abs(out[ROTATION_RATE]) / v
        # one foot, or one impact, may lose next to nothing where the other does not
        least = max(loss, last_loss) if law > AT_SPEED else loss
        if not least > 0.0 or flight > least * tolerance / math.sqrt(a):
            return np.inf, contact  # so little is lost that the end is far, or never comes
        for i in range(N_STATES):
            w[i] = out[i]
    return np.inf, contact


def stand(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new):
    """Move what still moves in full contact through the time h in which impacts faded.

    One step of the method, from y at t into y_new: so the work of the ground and of dampers in that
    time is theirs. k : scratch, the rates of a step. Returns whether its error is tolerable.
    """
    for i in range(N_STATES):
        y_new[i] = y[i]
    if h == 0.0:
        return True
    rates(contact, y, p, shaking(gx, t), shaking(gy, t), k)
    error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new)
    y_new[ROTATION] = y_new[ROTATION_RATE] = 0.0
    return error <= 1.0


# -- the loop ------------------------------------------------------------------------------------


def first_step(contact, t, y, rate, p, gx, gy, rtol, atol, w, later):
    """A first step, from the sizes of the state, of its rate, and of the change of that.

    A rocking structure tells how long it may be, by Hairer's estimate or a tenth of its own time;
    elsewhere it is a cautious one. w, later (N,) : scratch.
    """
    size = speed = change = 0.0
    for i in range(N_STATES):
        scale = atol[i] + rtol * abs(y[i])
        size = max(size, abs(y[i]) / scale)
        speed = max(speed, abs(rate[i]) / scale)
    cautious = 1e-6 if size < 1e-5 or speed < 1e-5 else 0.01 * size / speed
    longest = 0.1 * own_time(contact, y, p)
    if NARROW or not rocking(contact) or not cautious < longest:
        return cautious
    for i in range(N_STATES):
        w[i] = y[i] + cautious * rate[i]
    rates(contact, w, p, shaking(gx, t + cautious), shaking(gy, t + cautious), later)
    for i in range(N_STATES):
        scale = cautious * (atol[i] + rtol * abs(y[i]))
        change = max(change, abs(later[i] - rate[i]) / scale)
    most = max(speed, change)
    if not 0.0 < most < np.inf:
        return cautious
    return max(cautious, min(longest, (0.01 / most) ** -ERROR_EXPONENT))


@inlined
def power(x, exponent):
    """x**exponent within 4 per cent, for x of at most 1 and an exponent of at most 0.2.

    The control of steps asks for no more, and waits for it: Pade's approximation about 0.1.
    """
    factor = 0.1**exponent
    while x < 0.01:
        x *= 100.0
        factor *= 0.01**exponent
    z = 10.0 * x - 1.0
    above = 12.0 + z * (6.0 * (2.0 + exponent) + z * ((1.0 + exponent) * (2.0 + exponent)))
    below = 12.0 + z * (6.0 * (2.0 - exponent) + z * ((1.0 - exponent) * (2.0 - exponent)))
    return factor * above / below


@inlined
def most_error(rtol):
    """Estimated error above which an equal step is refused, in units of the tolerance."""
    return max(1.0, COARSE / rtol)


def settle(contact, t, h, y, p, gx, gy, touching, rtol, g, w, rate, fallen, noise):
    """Index of a guard that is below zero and stays there, the lowest if there are several; or -1.

    Ground acceleration may jump where a law of the ground begins, and a new contact state may be
    one that cannot last. Impacts are not asked, they happen only in motion; nor is the guard
    through which the state has just come, nor one that rounding left below zero while it rises.
    """
    if GUARDS[contact] == 0 or (GUARDS[contact] == 1 and KINDS[contact][0] == IMPACT):
        return -1
    due = -1
    moved = False
    guards(contact, y, p, shaking(gx, t), shaking(gy, t), g)
    for i in range(GUARDS[contact]):
        known = is_known(touching, i)
        kind = KINDS[contact][i]
        if known or kind in (IMPACT, LANDING) or not g[i] < 0.0:
            continue
        if not moved:
            # look ahead, by some of the errors that the time of an event may have
            moved = True
            tau = max(64.0 * EPS * max(t, h), 1e-4 * rtol * h)
            rates(contact, y, p, shaking(gx, t), shaking(gy, t), rate)
            for n in range(N_STATES):
                w[n] = y[n] + tau * rate[n]
            guards(contact, w, p, shaking(gx, t + tau), shaking(gy, t + tau), g)
        if g[i] < 0.0 and (due < 0 or g[i] < g[due]):
            due = i
    if due >= 0:
        value, ax, ay = g[due], shaking(gx, t), shaking(gy, t)
        if value >= -grain_of(contact, due, y, p, ax, ay, 0.0, fallen, noise, w, g, g, 1):
            return -1
    return due


@inlined
def sampling_step(row):
    """Largest step in which eight samples of a guard follow a law of the ground.

    Only guards of uplift and of springs are sampled; in full contact nothing else may move, and
    the error of a step says nothing of the ground.
    """
    if row[2] == 0.0:
        return np.inf
    return (1.0 if row[2] == 1.0 else 0.5) / abs(row[4])


def record_step(row, t, h, contact, coefficients, steps, step_contact, step_states):
    steps[row, 0] = t
    steps[row, 1] = h
    step_contact[row] = contact
    for j in range(8):
        for i in range(N_STATES):
            step_states[row, j, i] = coefficients[j * N_STATES + i]


def record_event(
    row, t, kind, before, follows, guard, y, after, events, event_kinds, event_states
):  # fmt: skip
    events[row] = t
    event_kinds[row, 0] = kind
    event_kinds[row, 1] = before
    event_kinds[row, 2] = follows
    event_kinds[row, 3] = guard
    for i in range(N_STATES):
        event_states[row, 0, i] = y[i]
        event_states[row, 1, i] = after[i]


def uneventful_steps(
    contact, t, h_next, last_error, taken, turn, nx, ny, horizontal, vertical, t_end, fixed,
    refined_to, coarse, h_max, fallen, p, rtol, atol, y, k, y_new, peaks, coefficients,
):  # fmt: skip
    """Take steps in which nothing happens, one after the other, as the loop itself would.

    Nearly all steps of a motion are such; here nothing is asked that concerns others. Returns the
    loop's own variables behind them, with the error of a step that was taken and is left for the
    loop to judge, or -1, and whether the ground's acceleration has jumped.
    """
    rocks = rocking(contact)
    side = SIDES[contact]
    nx, gx = row_at(horizontal, nx, t)
    ny, gy = row_at(vertical, ny, t)
    while taken <= turn:
        if t >= gx[1]:
            before_x = shaking(gx, t)
            nx, gx = row_at(horizontal, nx, t)
            if jumps(before_x, shaking(gx, t)):
                return t, h_next, last_error, taken, -1.0, True, nx, gx, ny, gy
        if t >= gy[1]:
            before_y = shaking(gy, t)
            ny, gy = row_at(vertical, ny, t)
            if jumps(before_y, shaking(gy, t)):
                return t, h_next, last_error, taken, -1.0, True, nx, gx, ny, gy
        if not t < t_end or not (rocks or straight(gx, gy)):
            break
        last = min(gx[1], gy[1], t_end)
        span = min(gx[1] - gx[0], gy[1] - gy[0])
        equal = fixed > 0 and t >= refined_to and span < np.inf
        proposed = span / fixed if equal else h_next
        h = min(proposed, h_max)
        cut = t + 1.1 * h >= last
        if cut:
            h = last - t
        taken += 1
        error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new)
        gap = gap_at_ends(side, h, y, y_new, k)
        open_ = stays_open(gap, -1)
        if HELD >= 0 and contact == HELD:
            open_ = stays_on_both_feet(t, h, y, y_new, k, p, gx)
        ordinary = error <= (coarse if equal else 1.0) and finite_end(k) and open_
        if not ordinary or may_fall(fallen, gap, h, y, y_new, k, p):
            return t, h_next, last_error, taken, error, False, nx, gx, ny, gy
        if peaks.shape[0] > 0:
            if widens(peaks, h, y, y_new, k):
                dense_output(contact, t, h, y, p, gx, gy, k, coefficients)
                widen_within(peaks, coefficients)
            widen(peaks, y_new)
        h_next = proposed
        if not cut:
            h_next, last_error = controlled(h, error, last_error)
        t = last if cut or t + h > last else t + h
        for i in range(N_STATES):
            y[i] = y_new[i]
            k[i] = k[N_STAGES * N_STATES + i]
    return t, h_next, last_error, taken, -1.0, False, nx, gx, ny, gy


@inlined
def straight(gx, gy):
    """Whether the ground moves by a straight line, and not up or down: see `held_guards`."""
    return gx[2] == 0.0 and gy[2] == 0.0 and gy[3] == 0.0 and gy[4] == 0.0


@inlined
def controlled(h, error, last_error):
    """(step to come, error to remember), by proportional-integral control.

    The last error damps the answer to this one.
    """
    error = max(error, 1e-10)
    factor = power(error, 0.7 * ERROR_EXPONENT) * power(last_error, -0.4 * ERROR_EXPONENT)
    return h * min(5.0, max(0.2, 0.9 * factor)), error


@entry
def integrate(
    status: Ints, clock: Floats, y: Floats, rate: Floats, t_end: float, horizontal: Floats2,
    vertical: Floats2, p: Floats, law: int, ratio: float, rtol: float, atol: Floats, h_max: float,
    fixed: int, fallen: float, rest_tolerance: float, max_impacts: int, max_steps: int,
    steps: Floats2, step_contact: Ints, step_states: Floats3, events: Floats, event_kinds: Ints2,
    event_states: Floats3, peaks: Floats2, scratch: Floats,
) -> int:  # fmt: skip
    """Integrate to t_end, to the outcome that ends the motion, or until a record or turn is FULL.

    status, clock : what must be known to go on, see `rockeom.codes`.
    y, rate (N,) : the state and its rate.
    These four are changed in place, so that a call goes on where the last one ended, to the last
    bit.
    horizontal, vertical (m, 7) : the ground's motion, each row start, end, kind and constants of
        a law; no step straddles an end, and behind the last one the ground stands still.
    fixed : 0 to control the error, or the number of equal steps in each law of the ground. An equal
        step whose estimated error is above COARSE is refused, and the rest of its law is
        integrated with control of the error.
    steps (n, 2) start and length, step_contact (n,), step_states (n, 8, N) the dense output of
    each step; n = 0 keeps none. events (m,) times, event_kinds (m, 4) kind, contact before and
    after and the guard that fell, event_states (m, 2, N) state before and after.
    """
    k = scratch[_K:_W]  # rates of the stages of a step, and the ground at each
    w = scratch[_W:_Y_NEW]
    y_new = scratch[_Y_NEW:_AFTER]
    after = scratch[_AFTER:_POWERS]
    coefficients = scratch[_POWERS:_GUARDS]
    g = scratch[_GUARDS:_BERNSTEIN]
    b = scratch[_BERNSTEIN:_STACK]
    stack = scratch[_STACK:_NOISE]
    noises = scratch[_NOISE:_KNOWN]
    known = scratch[_KNOWN:SCRATCH]
    contact, touching = status[CONTACT], status[TOUCHING]
    impacts, taken, refined = status[IMPACTS], status[TAKEN], status[REFINED]
    idle, news, fresh = status[IDLE], status[NEWS], status[FRESH]
    n_steps, n_events = status[STEPS_KEPT], status[EVENTS_KEPT]
    for i in range(N_STATES):
        k[i] = rate[i]
    t, h_next = clock[TIME], clock[NEXT_STEP]
    last_error = clock[LAST_ERROR] if clock[LAST_ERROR] > 0.0 else 1.0
    refined_to = clock[REFINED_TO]
    coarse = most_error(rtol)
    nx, gx = row_at(horizontal, 0, t)
    ny, gy = row_at(vertical, 0, t)
    keep = steps.shape[0] > 0
    follow = peaks.shape[0] > 0
    rocks = rocking(contact)
    side = SIDES[contact]
    outcome = COMPLETED
    follows = 0  # the contact state behind the bounces that a landing begins
    h = 0.0
    turn = taken + TURN
    sampled = False  # whether the guards at the end of the step before are known
    still = False  # whether nothing moved in it, and no event was at its end
    for i in range(noises.shape[0]):
        noises[i] = -1.0

    if N_POINTS > 0:
        begins = taken == 0 and impacts == 0 and fresh == 1
        if begins and fits_by_forces(contact, y, p, shaking(gx, t), shaking(gy, t)) == AMBIGUOUS:
            return SEVERAL_SOLUTIONS

    while True:
        # a call that ends where a law does must tell the next one of the jump
        if t >= gx[1]:
            before_x = shaking(gx, t)
            nx, gx = row_at(horizontal, nx, t)
            if jumps(before_x, shaking(gx, t)):
                fresh = news = 1
        if t >= gy[1]:
            before_y = shaking(gy, t)
            ny, gy = row_at(vertical, ny, t)
            if jumps(before_y, shaking(gy, t)):
                fresh = news = 1
        unjudged = -1.0  # the error of a step that is already taken
        uneventful = fresh == 0 and touching < 0 and not keep and (rocks or contact == HELD)
        if N_POINTS == 0 and not NARROW and uneventful:
            t, h_next, last_error, taken, unjudged, jumped, nx, gx, ny, gy = uneventful_steps(
                contact, t, h_next, last_error, taken, min(turn, max_steps - 1), nx, ny, horizontal,
                vertical, t_end, fixed, refined_to, coarse, h_max, fallen, p, rtol, atol, y, k,
                y_new, peaks, coefficients,
            )  # fmt: skip
            if taken >= max_steps and unjudged == -1.0:
                outcome = STALLED
                break
            if jumped:
                fresh = news = 1
            if t >= gx[1] or t >= gy[1]:
                continue  # the other table's law ends there, too
        if not t < t_end:
            break
        full = (keep and n_steps + 2 > steps.shape[0]) or n_events + 2 > events.shape[0]
        if full or taken > turn:
            outcome = FULL
            break
        last = min(gx[1], gy[1], t_end)

        landed = -1  # the guard that ends this contact state now
        if fresh == 1:
            sampled = still = False
            if news == 1 and not rocks:
                h = min(h_next, last - t)  # at rest the next step may be of any length
                landed = settle(
                    contact, t, h, y, p, gx, gy, touching, rtol, g, w, k, fallen, noises
                )
            if landed < 0:
                rates(contact, y, p, shaking(gx, t), shaking(gy, t), k)
                fresh = news = 0
                if h_next == 0.0:
                    h_next = first_step(contact, t, y, k, p, gx, gy, rtol, atol, w, after)

        if landed < 0:
            # -- step, cut where a law of the ground ends, and once more to the first event in it
            span = min(gx[1] - gx[0], gy[1] - gy[0])
            equal = fixed > 0 and t >= refined_to and span < np.inf
            if equal:
                h_next = span / fixed
            bound = coarse if equal else 1.0
            still = still or cannot_move(contact, k, y, p)
            proposed = np.inf if still else h_next
            h = min(proposed, h_max)
            if not rocks:
                h = min(h, sampling_step(gx), sampling_step(gy))
            if N_POINTS > 0:
                h = min(h, longest_turn(y))
            longest = min(proposed, last - t)
            cut = t + 1.1 * h >= last
            if cut:
                h = last - t
            target = -1
            slope = more = 0.0
            sampled = sampled and touching < 0 and not still
            corrections = overlooked = 0
            beyond = turned = hops = False
            lands = False  # whether it is known that nothing but a landing ends it
            stands = still and last - t <= h_max
            stands = stands and stands_until(contact, t, last, y, p, gx, gy, g)
            if stands:
                taken += 1
                h = last - t
                cut = True
            if still:
                # nothing moves: the state is known without a step
                for i in range(N_STATES):
                    y_new[i] = y[i]
                    k[N_STAGES * N_STATES + i] = 0.0
                for i in range(8 * N_STATES):
                    coefficients[i] = y[i] if i < N_STATES else 0.0
            if rocks and touching == 0 and not NARROW:
                # a hop so short that its parabola tells where it ends
                flight = -2.0 * y[ROTATION_RATE] / k[ROTATION_RATE]
                height = side * y[ROTATION_RATE] * flight  # not lost among the smallest numbers
                if 0.0 < flight < 0.9 * h and height > 1e-290:
                    h = flight
                    cut = False
                    hops = True
            whole, hop = h, 0
            if N_POINTS > 0:
                flight = np.inf
                if touching > 0:
                    hop, flight = only_hop(contact, touching, y, p, k)
                if 1e3 * EPS * t < flight < 0.9 * h:
                    h = flight
                    hops = True
            while not stands:
                error = 0.0
                if unjudged != -1.0:
                    error, unjudged = unjudged, -1.0
                else:
                    taken += 1
                    if not still:
                        error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new)
                finite = math.isfinite(error) and finite_end(k)
                if not finite or error > bound:
                    # refused: too inaccurate, or not finite
                    if equal:
                        equal, bound = False, 1.0
                        refined_to = last
                        refined += 1
                    cut = hops = lands = False
                    target = -1
                    corrections = 0
                    shrink = 0.9 * error**ERROR_EXPONENT if finite else 0.1
                    h *= max(0.1, shrink)
                    h_next = h
                    if h <= 4.0 * EPS * t or h < 1e-290 or taken >= max_steps:
                        finite = error == error and finite_end(k)  # else no step is short enough
                        outcome = STALLED if finite else NOT_FINITE
                        break
                    continue
                gap = gap_at_ends(side, h, y, y_new, k)
                if hops:
                    # it ends there if the gap clearly stays open until then
                    hops = False
                    if N_POINTS > 0:
                        falls, place = fall_within(
                            contact, t, h, y, y_new, k, N_STAGES * N_STATES, p, gx, gy, w, b,
                            False, touching, hop,
                        )  # fmt: skip
                        if falls != hop:
                            h = whole
                            continue
                        cut = False
                        lands = True
                    elif not (abs(to_impact(side, y_new, k)) < 0.1 * h and rises_and_falls(gap)):
                        h *= 0.5  # no parabola: a step must not end just beside an impact
                        continue
                    target = hop
                if target >= 0:
                    # this step ends at the event: correct what is left of the guard there
                    tau = t + h
                    if rocks:
                        move = to_impact(side, y_new, k)
                        near = 0.1 if corrections == 0 else 0.01
                    elif lands:
                        near = 0.1 if corrections == 0 else 0.01
                        move = 0.0
                        if N_POINTS > 0:
                            move = to_landing(contact, target, y_new, p, k[N_STAGES * N_STATES :])
                    else:
                        guards(contact, y_new, p, shaking(gx, tau), shaking(gy, tau), g)
                        move = -g[target] / slope if slope < 0.0 else 0.0
                        near = 0.01
                    least = max(2.0 * EPS * tau, 1e-5 * rtol * h)
                    small = math.sqrt(max(1e-13, min(1e-6, rtol))) * h
                    if (rocks or lands) and not NARROW and abs(move) <= small:
                        extrapolate(h, move, y, y_new, k)
                        more = move
                    elif corrections < 8 and least < abs(move) < near * h:
                        corrections += 1
                        h += move
                        continue
                    misplaced = abs(move) >= 0.01 * h
                    misplaced = misplaced or (
                        not (rocks or lands)
                        and fell_before(contact, target, touching, h, y_new, g, b)
                    )
                    if N_POINTS > 0 and misplaced and KINDS[contact][target] == LANDING:
                        misplaced = not is_rounding(contact, target, y_new, p)
                    if misplaced and h > 1e-6 * longest:
                        # the guard is not where its polynomial put it: look again in less time
                        h *= 0.5
                        lands = False
                        target = -1
                        corrections = 0
                        continue
                    landed = target
                elif not (cut or still):
                    h_next, last_error = controlled(h, error, last_error)
                open_ = False
                if rocks and landed < 0:
                    open_ = stays_open(gap, touching)
                    place = NEVER if open_ or NARROW else closes_once(gap, touching)
                    if place < NEVER:
                        target = 0
                        h *= place
                        cut = False
                        continue
                elif landed < 0 and (touching < 0 or N_POINTS > 0) and not still:
                    ends = False
                    if N_POINTS > 0:
                        falls, place = fall_within(
                            contact, t, h, y, y_new, k, N_STAGES * N_STATES, p, gx, gy, w, b,
                            sampled, touching, -1,
                        )  # fmt: skip
                        open_ = sampled = falls == STAYS_OPEN
                        if falls >= 0:
                            lands, target = True, falls
                            h *= place
                            cut = False
                            continue
                        ends = not open_ and end_closed(contact, b)
                    if not (open_ or ends or touching >= 0):
                        open_ = stays_held(contact, t, h, y, y_new, k, p, gx, gy, w, g, b, stack)
                beyond = may_fall(fallen, gap, h, y, y_new, k, p)
                turned = follow and widens(peaks, h, y, y_new, k)
                leaves = NARROW and touching >= 0 and beside_gap(contact, touching, y, y_new)
                closes = NARROW and landed >= 0 and beside_gap(contact, landed, y_new, y)
                asked = keep or turned or beyond or leaves or closes
                if not still and (asked or not (open_ or landed >= 0)):
                    dense_output(contact, t, h, y, p, gx, gy, k, coefficients)
                    if more != 0.0:
                        shorten(coefficients, 1.0 + more / h)
                        for i in range(N_STATES):
                            left = y_new[i] - power_sum(coefficients, 1.0, i)
                            coefficients[7 * N_STATES + i] += left
                h += more
                again = (leaves or closes) and overlooked < 20
                if again and overlooks(
                    contact, t, h, p, gx, gy, rtol, atol, coefficients, closes, w, after
                ):
                    overlooked += 1
                    h *= 0.3
                    h_next = h
                    cut = False
                    target = landed = -1
                    corrections = 0
                    continue
                if open_ or (landed >= 0 and not closes):
                    break
                instant = 4.0 * EPS * max(t, h)
                guard_polynomials(contact, t, h, p, gx, gy, coefficients, w, g, b)
                place, target, slope, from_closed, unclear = first_event(
                    contact, t, h, instant, landed, touching, y, p, gx, gy, fallen, noises, w, g, b,
                    stack,
                )  # fmt: skip
                if place == NEVER:
                    break
                landed = -1
                if place * h <= instant:
                    if rocks:
                        # it does not fall where both its rate and its acceleration open it
                        slow = y[ROTATION_RATE] == 0.0 or side * k[ROTATION_RATE] > 0.0
                    else:
                        slow = unclear or opens_soon(
                            contact, target, t, h, y, p, gx, gy, k, w, g, after,
                            noise_of(contact, target, p, fallen, noises, w, g),
                        )  # fmt: skip
                    if from_closed and slow and h > max(1e-6 * longest, 1e3 * EPS * t):
                        # an opening so short that rounding, or the error of a dense output of
                        # low order, hides it in a step of this length
                        h *= 0.1
                        cut = False
                        target = -1
                        continue
                    h = 0.0  # it falls here and now
                if place >= 1.0 or h == 0.0:
                    landed = target
                    break
                h *= place
                cut = False
            if outcome != COMPLETED:
                break
            sampled = sampled and not beyond

            # -- fallen over: the step ends where it passed the bound
            x = NEVER
            if h > 0.0 and beyond:
                x = falls_at(coefficients, fallen, p, b, stack)
            if x < NEVER:
                dense_at(coefficients, x, y_new)
                shorten(coefficients, x)
                h *= x
                cut = False
                outcome = OVERTURNED

            if h > 0.0:
                if keep:
                    record_step(
                        n_steps, t, h, contact, coefficients, steps, step_contact, step_states
                    )
                    n_steps += 1
                t = last if cut or t + h > last else t + h
                if follow:
                    if turned:
                        widen_within(peaks, coefficients)
                    widen(peaks, y_new)
                for i in range(N_STATES):
                    y[i] = y_new[i]
                    k[i] = k[N_STAGES * N_STATES + i]
                touching = -1
                idle = follows = 0
            if outcome != COMPLETED:
                break
            if taken >= max_steps:
                outcome = STALLED
                break

        if landed < 0:
            continue

        # -- the event: pass into the contact state that follows
        idle += 1
        before, kind, closed = contact, KINDS[contact][landed], touching
        touching = -1
        ax, ay = shaking(gx, t), shaking(gy, t)
        rests, stepped, stepped_to = np.inf, False, 0
        if idle > (MOST_IDLE if N_POINTS == 0 else MOST_IDLE_POINTS):
            outcome = CHATTER
            if follows < 0:  # the bounces have an end, but nothing that may follow it
                outcome = NO_SOLUTION if follows == IMPOSSIBLE else SEVERAL_SOLUTIONS
            break
        if N_POINTS > 0 and CROWDED * int(idle / CROWDED) == idle:
            rests, stepped_to = step_over(
                before, y, p, ax, ay, rest_tolerance, last - t, False, rtol, known, y_new
            )
            stepped = rests < np.inf
        if N_POINTS == 0:
            contact = jump(before, landed, law, ratio_at(law, ratio, impacts, y, p), y, p, after)
        elif not stepped:
            length = max(h, min(h_next, last - t))
            tau = 1e-5 * length
            contact, touching = pass_on(
                before, landed, length, y, p, ax, ay, shaking(gx, t + tau), shaking(gy, t + tau),
                tau, rtol, known, after,
            )  # fmt: skip
            if contact < 0:
                outcome = NO_SOLUTION if contact == IMPOSSIBLE else SEVERAL_SOLUTIONS
                contact = before
                rests, stepped_to = step_over(
                    before, y, p, ax, ay, rest_tolerance, last - t, True, rtol, known, y_new
                )
                # what has come to its end and goes on as before is no way out
                stepped = rests < np.inf and (kind == LANDING or stepped_to != before)
                if not stepped:
                    break
                outcome = COMPLETED
            elif kind == SWITCH:
                touching = still_closed(before, contact, landed, closed, touching)
        if stepped:
            follows = stepped_to
            fresh = news = 1
        else:
            record_event(
                n_events, t, kind, before, contact, landed, y, after, events, event_kinds,
                event_states,
            )  # fmt: skip
            n_events += 1
            for i in range(N_STATES):
                y[i] = after[i]
            rocks = rocking(contact)
            side = SIDES[contact]
            fresh = news = 1
            if N_POINTS == 0 and (kind != IMPACT or SIDES[contact] != 0.0):
                touching = CLOSED[before][landed]
            if kind in (UPLIFT, LIFTING):
                h_next = 0.0  # the gap opens slowly: its first moments want a short step
            if kind != IMPACT and kind != LANDING:
                continue
            if N_POINTS == 0 and idle > 1 and SIDES[contact] == 0.0:
                # it opened and closed in no time: that uplift was none
                for i in range(GUARDS[contact]):
                    if TARGETS[contact][i] == before:
                        touching = i
            impacts += 1
            if impacts > max_impacts:
                outcome = TOO_MANY_IMPACTS
                break
            # -- the rest of infinitely many impacts at once
            if N_POINTS > 0:
                rests, follows = time_of_bounces(
                    contact, y, p, ax, ay, rest_tolerance, rtol, known, y_new
                )
            elif SIDES[contact] == 0.0:
                continue
            else:
                rates(contact, y, p, ax, ay, k)
                if not may_fade(side, y, k, law, ratio, rest_tolerance):
                    if rocks and t < last and h_next != 0.0:
                        fresh = news = 0  # the next step begins with these rates
                    continue
                rests, follows = time_to_rest(
                    contact, y, p, law, ratio, impacts, ax, ay, rest_tolerance, w, after,
                    coefficients,
                )  # fmt: skip
        if not (stepped or t + rests < last or rests < 16.0 * EPS * t):
            continue
        kept = contact  # in which the time of the rest is recorded
        if N_POINTS > 0:
            for i in range(8 * N_STATES):
                coefficients[i] = 0.0
            for i in range(N_STATES):
                coefficients[i] = w[i] = y[i]
                coefficients[N_STATES + i] = y_new[i] - y[i]
        else:
            kept = follows
            if not stand(follows, t, rests, after, p, gx, gy, rtol, atol, k, y_new):
                continue
            if keep and t + rests > t:
                dense_output(follows, t, rests, after, p, gx, gy, k, coefficients)
            for i in range(N_STATES):
                w[i] = y[i] + (y_new[i] - after[i])  # there, had the impacts not faded yet
        if keep and t + rests > t:
            record_step(n_steps, t, rests, kept, coefficients, steps, step_contact, step_states)
            n_steps += 1
        t = min(t + rests, last) if stepped else t + rests
        record_event(
            n_events, t, REST, contact, follows, STEPPED_OVER if stepped else -1, w, y_new, events,
            event_kinds, event_states,
        )  # fmt: skip
        n_events += 1
        if follow:
            widen(peaks, y_new)
        for i in range(N_STATES):
            y[i] = y_new[i]
        contact = follows
        rocks = rocking(contact)
        side = SIDES[contact]
        touching = -1
        h_next = 0.0

    status[CONTACT], status[TOUCHING] = contact, touching
    status[IMPACTS], status[TAKEN], status[REFINED] = impacts, taken, refined
    status[IDLE], status[NEWS], status[FRESH] = idle, news, fresh
    status[STEPS_KEPT], status[EVENTS_KEPT] = n_steps, n_events
    for i in range(N_STATES):
        rate[i] = k[i]
    clock[TIME], clock[NEXT_STEP] = t, h_next
    clock[LAST_ERROR], clock[REFINED_TO] = last_error, refined_to
    return outcome


def opens_soon(contact, index, t, h, y, p, gx, gy, k, w, g, later, noise):
    """Whether a guard that is closed at t is open a little later, by its motion to third order.

    Where shaking begins from nothing it is the change of the acceleration that opens it. It may be
    open for a short part of the step only. noise : rounding errors of the guard.
    """
    tau, n = h / 64.0, N_STATES // 2
    for _ in range(4):
        for i in range(n):
            w[i] = y[i] + tau * (y[n + i] + 0.5 * tau * k[n + i])
            w[n + i] = y[n + i] + tau * k[n + i]
        ax, ay = shaking(gx, t + tau), shaking(gy, t + tau)
        rates(contact, w, p, ax, ay, later)
        for i in range(n):
            w[i] += tau * tau * (later[n + i] - k[n + i]) / 6.0
            w[n + i] += 0.5 * tau * (later[n + i] - k[n + i])
        guards(contact, w, p, ax, ay, g)
        if g[index] > noise:
            return True
        tau /= 32.0
    return 0.0 < noise >= abs(g[index])  # nothing but rounding errors at first: who knows


@inlined
def fell_before(contact, target, touching, h, y, g, b):
    """Whether another guard fell before the event that a step ends on, by more than rounding.

    An event at which a guard hardly touches zero is corrected by much: it may pass another one.
    Forces are judged by `settle` after it.
    """
    for i in range(GUARDS[contact]):
        if i == target or KINDS[contact][i] in (UPLIFT, LIFTING, SLIPPING):
            continue
        if KINDS[contact][i] == IMPACT:
            fell = -g[i] > 1e-9 * h * abs(y[ROTATION_RATE])
        else:
            fell = -g[i] > 1e-9 * size(b, 8 * i) and b[8 * i] > 0.0 and not is_known(touching, i)
        if fell:
            return True
    return False


@inlined
def finite_end(k):
    """Whether the rates at the end of a step are finite: the state is not, if they are not."""
    total = 0.0
    for i in range(N_STATES):
        total += k[N_STAGES * N_STATES + i]
    return math.isfinite(total)


@inlined
def jumps(before, after):
    """Whether the ground's acceleration jumps between two laws, by more than rounding."""
    return not abs(after - before) <= 1e-10 * (abs(before) + abs(after))


def rocking(contact):
    """Whether a contact state ends by an impact and in no other way."""
    return GUARDS[contact] == 1 and KINDS[contact][0] == IMPACT


def widen(peaks, y):
    """Let the smallest and largest values (2, N) take in a state."""
    for i in range(N_STATES):
        peaks[0, i] = min(peaks[0, i], y[i])
        peaks[1, i] = max(peaks[1, i], y[i])


@inlined
def widens(peaks, h, y, y_new, k):
    """Whether a state may turn back within a step, outside of the extremes known so far.

    By the quintics through both ends: the Bernstein coefficients of a coordinate bound how far it
    may go, those of its slope where it may turn, and how far its rate may go.
    """
    far = False
    n = N_STATES // 2
    for i in range(n):
        _, b1, b2, b3, b4, _ = quintic_of(i, 1.0, h, y, y_new, k)
        v0, v1, part = h * y[n + i], h * y_new[n + i], 0.25 * h * h
        d1, d3 = v0 + part * k[n + i], v1 - part * k[N_STAGES * N_STATES + n + i]
        d2 = 5.0 * (b3 - b2)
        slow, fast = min(v0, v1), max(v0, v1)
        least, most = min(d1, min(d2, d3)), max(d1, max(d2, d3))
        margin = 1e-3 * (most - least)
        far = far or least - margin < min(h * peaks[0, n + i], slow)
        far = far or most + margin > max(h * peaks[1, n + i], fast)
        if min(least, slow) >= 0.0 or max(most, fast) <= 0.0:
            continue  # it rises or falls all along
        least, most = min(min(b1, b2), min(b3, b4)), max(max(b1, b2), max(b3, b4))
        margin = 1e-3 * (most - least)
        far = far or least - margin < peaks[0, i] or most + margin > peaks[1, i]
    return far


def widen_within(peaks, coefficients):
    """Take in the turning points of the states inside a step, from its dense output."""
    for i in range(N_STATES):
        least, most = np.inf, -np.inf
        low = high = 0.0
        for m in range(8):
            value = power_sum(coefficients, NODES[m], i)
            if value < least:
                least, low = value, NODES[m]
            if value > most:
                most, high = value, NODES[m]
        peaks[0, i] = min(peaks[0, i], min(least, turning_point(coefficients, low, i, -1.0)))
        peaks[1, i] = max(peaks[1, i], max(most, turning_point(coefficients, high, i, 1.0)))


def turning_point(coefficients, x, i, sign):
    """Value of state i at its maximum (sign 1) or minimum (-1) beside the node x of a step."""
    low, high = max(x - 0.25, 0.0), min(x + 0.25, 1.0)
    for _ in range(6):
        slope, bend = slope_at(coefficients, x, i)
        if sign * bend >= 0.0:
            break
        before = x
        x = min(max(x - slope / bend, low), high)
        if abs(x - before) < 1e-9:
            break  # an extreme's error is of the order of the square of that
    return power_sum(coefficients, x, i)


def slope_at(coefficients, x, i):
    """First and second derivative of state i by x."""
    slope, bend = 7.0 * coefficients[7 * N_STATES + i], 42.0 * coefficients[7 * N_STATES + i]
    for j in range(6, 0, -1):
        slope = slope * x + j * coefficients[j * N_STATES + i]
    for j in range(6, 1, -1):
        bend = bend * x + j * (j - 1) * coefficients[j * N_STATES + i]
    return slope, bend


@inlined
def may_fall(fallen, gap, h, y, y_new, k, p):
    """Whether the rotation, or another coordinate that falls, may reach its bound in a step.

    gap : as of `gap_at_ends`.
    """
    may = may_reach(fallen, gap)
    if N_FALLS > 0:
        for i in range(N_FALLS):
            may |= may_reach(overturns_at(i, p), quintic_of(FALLS[i], 1.0, h, y, y_new, k))
    return may


@inlined
def may_reach(bound, quintic):
    """Whether the size of a coordinate may reach `bound` in a step, by `quintic_of`."""
    _, b1, b2, b3, b4, b5 = quintic
    within = max(max(abs(b1), abs(b2)), max(abs(b3), abs(b4)))
    return max(abs(b5), 1.001 * within) >= bound


def falls_at(coefficients, fallen, p, b, stack):
    """Place in a step at which the rotation, or another coordinate, has fallen, or NEVER."""
    place = bound_passed(ROTATION, coefficients, fallen, b, stack)
    if N_FALLS > 0:
        for i in range(N_FALLS):
            place = min(place, bound_passed(FALLS[i], coefficients, overturns_at(i, p), b, stack))
    return place


def bound_passed(state, coefficients, bound, b, stack):
    """Place in a step at which the size of a state first reaches `bound`, or NEVER."""
    place = 1.0 if abs(power_sum(coefficients, 1.0, state)) >= bound else NEVER
    for turn in range(2):
        polynomial_of(state, 1.0 - 2.0 * turn, coefficients, b, 0)
        for i in range(8):
            b[i] += bound
        place = min(place, first_fall(b, 0, EXACT, False, 0.0, stack))
    return place


def shorten(coefficients, x):
    """Make [0, x] of a step its whole [0, 1]; x may be a little above 1."""
    factor = 1.0
    for j in range(8):
        for i in range(N_STATES):
            coefficients[j * N_STATES + i] *= factor
        factor *= x


@inlined
def standing(contact, y, p):
    """Whether a structure stands on both its feet."""
    return (
        SIDES[contact] == 0.0 and KINDS[contact][0] == UPLIFT
        if N_POINTS == 0
        else held_upright(contact, y, p)
    )


@entry
def at_rest(contact: int, y: Floats, p: Floats) -> bool:
    """Full contact, and a kinetic energy below a billionth of the weight's potential energy."""
    if not standing(contact, y, p):
        return False
    energy = np.empty(3)
    energies(contact, y, p, energy)
    return energy[0] <= 1e-9 * abs(energy[1])


def own_time(contact, y, p):
    """Time in which a rocking motion goes on, 1/sqrt(acceleration); 0 where nothing drives it."""
    a = abs(opening_acceleration(contact, y, p, 0.0, 0.0))
    return 1.0 / math.sqrt(a) if a > 0.0 else 0.0


def leans_most(peaks, fallen, p):
    """Of what may fall, the state that has come nearest to its bound, and how far it has come.

    That of another coordinate than the rotation counts beside its bound as the rotation's does.
    """
    leaning, leans = ROTATION, max(-peaks[0, ROTATION], peaks[1, ROTATION])
    if N_FALLS > 0:
        for i in range(N_FALLS):
            other = max(-peaks[0, FALLS[i]], peaks[1, FALLS[i]]) * fallen / overturns_at(i, p)
            if other > leans:
                leaning, leans = FALLS[i], other
    return leaning, leans


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
            left += status[n, TAKEN]
            code = integrate(
                status[n], clock[n], y, rates[n], t_end[n], horizontal[h_rows[n, 0] : h_rows[n, 1]],
                vertical[v_rows[n, 0] : v_rows[n, 1]], p[n], law[n], ratio[n], rtol, atol, h_max,
                fixed, fallen[n], rest_tolerance, max_impacts, max_steps,
                steps, step_contact, step_states, events, event_kinds, event_states, peaks[n],
                scratch,
            )  # fmt: skip
            left -= status[n, TAKEN]
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


def row_for(table, n, t):
    """As row_at, but the very end of a motion still belongs to its last law."""
    if table.shape[0] > 0 and t == table[-1, 1]:
        return table.shape[0] - 1, row_of(table, table.shape[0] - 1)
    return row_at(table, n, t)


@entry
def evaluate(
    contacts: Ints, t: Floats, states: Floats2, horizontal: Floats2, vertical: Floats2, p: Floats,
    energy: Floats2, force: Floats2, motion: Floats2,
):  # fmt: skip
    """Energies, reactions and kinematics (columns of the last three) at every sample."""
    nx = ny = 0
    for n in range(t.shape[0]):
        nx, gx = row_for(horizontal, nx, t[n])
        ny, gy = row_for(vertical, ny, t[n])
        ax, ay = shaking(gx, t[n]), shaking(gy, t[n])
        energies(contacts[n], states[n], p, energy[n])
        reactions(contacts[n], states[n], p, ax, ay, force[n])
        kinematics(contacts[n], states[n], p, motion[n])
