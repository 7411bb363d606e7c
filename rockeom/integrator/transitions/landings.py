"""Where in a step a guard of points that may open, slide and bounce falls, where that is clear.

Joined behind points.py, see `rockeom.integrator.program`. The loop decides what four samples of
each guard leave unclear.
"""

import math

import numpy as np

from rockeom.codes import LANDING, STAYS_OPEN, UNCLEAR
from rockeom.compiler.decorators import inlined
from rockeom.integrator.guards import guards_at
from rockeom.integrator.provided import (
    ANGLES,
    DIRECTIONS,
    N_POINTS,
    N_STAGES,
    N_STATES,
    STILL,
    guards,
    guards_in,
    kind_of,
    points,
    subject_of,
)
from rockeom.integrator.tolerances import LEAST_PRODUCT, LEAST_SIZE, SETTLED_PARABOLA
from rockeom.integrator.transitions.points import (
    N_COORDINATES,
    POINT,
    ROW,
    acceleration_of,
    gap_rounding,
    is_closed,
)

__fused__ = False

INSIDE = (  # weights of way, rates and accelerations at both ends, of a place and of its slope
    (0.5, 0.15625, -0.15625, 0.015625, 0.015625, 1.875, -0.4375, -0.4375, -0.03125, 0.03125),
    (
        459 / 512, 39 / 1024, -189 / 1024, 9 / 2048, 27 / 2048, 135 / 128, -95 / 256, 81 / 256,
        -21 / 512, -27 / 512,
    ),
)  # fmt: skip


@inlined
def longest_turn(y):
    """The longest step in which angles change so little that eight samples follow a gap."""
    fastest = LEAST_SIZE
    for i in range(N_COORDINATES):
        fastest = max(fastest, ANGLES[i] * abs(y[N_COORDINATES + i]))
    return 1.0 / fastest


def single_hop(mode, closed, y, p, dy):
    """(guard, time): the one gap that opens from closed, and when its parabola closes it again.

    (-1, inf) where none does, or several. dy (N,) : rates. closed : see `is_closed`.
    """
    contact = np.empty(POINT * N_POINTS)
    points(y, p, contact)
    hop, lasts = -1, np.inf
    for i in range(guards_in(mode)):
        if kind_of(mode, i) != LANDING or not is_closed(closed, i):
            continue
        point = subject_of(mode, i)
        rate, a = contact[point * POINT + 1], -acceleration_of(contact, DIRECTIONS * point, dy)
        # a hop must not be lost among the smallest numbers
        if hop >= 0 or not (rate > 0.0 and a > 0.0 and 2.0 * rate * rate > LEAST_PRODUCT * a):
            return -1, np.inf
        hop, lasts = i, 2.0 * rate / a
    return hop, lasts


def fall_within(motion, ground, step, sampled, hop, case, a):
    """(guard, place): which guard of a mode falls through zero in a step, and where.

    STAYS_OPEN where all of them stay far from zero, UNCLEAR where these samples leave a doubt.
    They are sampled on the quintics through both ends: parabolas through the ends and the middle,
    but for what they miss at three quarters. The samples are four rows of all guards: at the start,
    in the middle, at three quarters, at the end.

    sampled : they are those of the step before, whose last are the first of this one.
    hop : a gap that opens at the start and should be closed again at the end, or -1.
    """
    mode, t, h, samples, w, p = motion.mode, motion.t, step.h, a.b, a.w, case.p
    at_end = samples[3 * ROW :]
    if sampled:
        for i in range(guards_in(mode)):
            samples[i] = at_end[i]
    else:
        guards_at(mode, t, a.y, p, ground, samples)
    between(h, 0, a.y, a.y_new, a.k, w)
    guards_at(mode, t + 0.5 * h, w, p, ground, samples[ROW:])
    between(h, 1, a.y, a.y_new, a.k, w)
    guards_at(mode, t + 0.75 * h, w, p, ground, samples[2 * ROW :])
    guards_at(mode, t + h, a.y_new, p, ground, at_end)
    falls, place = STAYS_OPEN, 0.0
    for i in range(guards_in(mode)):
        opens = motion.closed > 0 and is_closed(motion.closed, i)
        if i != hop and stays_open_by(samples, i, opens):
            continue
        if falls != STAYS_OPEN or kind_of(mode, i) != LANDING:
            return UNCLEAR, 0.0
        falls, place = i, falls_by(samples, i, opens, i == hop)
        if place == 0.0:
            return UNCLEAR, 0.0
    return falls, place


@inlined
def parabola_of(samples, i, opens):
    """(first, bend, last, missed) of guard i: Bernstein coefficients, and what misses them.

    missed : by how much it is none, at three quarters. opens : it is closed at
    the start.
    """
    first = 0.0 if opens else samples[i]
    middle, later, last = samples[ROW + i], samples[2 * ROW + i], samples[3 * ROW + i]
    bend = 2.0 * middle - 0.5 * (first + last)
    return first, bend, last, later - (0.0625 * first + 0.375 * bend + 0.5625 * last)


@inlined
def stays_open_by(samples, i, opens):
    """Whether guard i stays above a quarter of its size; `opens` from closed, and as clearly."""
    first, bend, last, missed = parabola_of(samples, i, opens)
    least = min(bend, last) if opens else min(first, min(bend, last))
    if not least > 0.25 * max(first, max(abs(bend), last)):
        return False
    most = 0.02 if opens else 0.1  # it must not turn the slope at the start, either
    return abs(missed) <= most * least


def falls_by(samples, i, opens, at_end):
    """Where guard i falls through zero, if it clearly does once; or zero.

    A parabola from f to -g has one root between, where its slope is at least 2 sqrt(f g); one that
    opens from zero has the slope there, and less that slope where it falls. Its error at three
    quarters, d, zero at the ends and in the middle, has a slope less than 11 d if it is a cubic.
    So there is one root as long as f, or half of the slope, and g are above 6 d; here they are far
    above, for an error that is no cubic.

    at_end : whether it should open from zero, and be beside zero at the end.
    """
    first, bend, last, missed = parabola_of(samples, i, opens)
    if at_end:
        return 1.0 if abs(missed) <= 0.02 * bend and abs(last) < 0.1 * bend else 0.0
    if not min(bend if opens else first, -last) > 50.0 * abs(missed):
        return 0.0
    rise, curve, cubic = 2.0 * (bend - first), first - 2.0 * bend + last, missed / -0.046875
    root = math.sqrt(rise * rise - 4.0 * curve * first)
    x = (rise + root) / (-2.0 * curve) if rise > 0.0 else 2.0 * first / (root - rise)
    for _ in range(3):
        value = first + x * (rise + x * curve) + cubic * x * (x - 0.5) * (x - 1.0)
        slope = rise + 2.0 * x * curve + cubic * (x * (3.0 * x - 3.0) + 0.5)
        x -= value / slope
    return x if SETTLED_PARABOLA < x < 1.0 else 0.0


def to_landing(mode, guard, y, p, dy):
    """Time from the end of a step to the landing beside it; infinite where the gap does not close.

    By the parabola there, from which it differs by the third power of that time. dy (N,) : rates.
    The gap is that of the guard, as `fall_within` sees it: what drift closed points have is none
    of it.
    """
    contact, g = np.empty(POINT * N_POINTS), np.empty(ROW)
    points(y, p, contact)
    guards(mode, y, p, *STILL, g)
    point = subject_of(mode, guard)
    rate = contact[point * POINT + 1]
    if not rate < 0.0:
        return np.inf
    move = -g[guard] / rate
    return move - 0.5 * acceleration_of(contact, DIRECTIONS * point, dy) * move * move / rate


def is_rounding(mode, guard, y, p):
    """Whether a gap is closed but for the rounding errors of the places of all points."""
    contact, g = np.empty(POINT * N_POINTS), np.empty(ROW)
    points(y, p, contact)
    guards(mode, y, p, *STILL, g)
    return abs(g[guard]) <= gap_rounding(contact, y)


def end_closed(mode, samples):
    """Whether a guard is closed at the end of a step, by the samples of `fall_within`."""
    closed = False
    for i in range(guards_in(mode)):
        closed = closed or samples[3 * ROW + i] < 0.0
    return closed


@inlined
def between(h, place, y, y_new, k, w):
    """The state in the middle of a step, or at three quarters, on the quintics through both ends.

    place : the row of INSIDE. w (N,) : the state.
    """
    n, end, rate, hh = N_COORDINATES, N_STAGES * N_STATES, 1.0 / h, h * h
    for i in range(n):
        way, v0, v1 = y_new[i] - y[i], h * y[n + i], h * y_new[n + i]
        a0, a1 = hh * k[n + i], hh * k[end + n + i]
        w[i] = y[i] + (
            INSIDE[place][0] * way + INSIDE[place][1] * v0 + INSIDE[place][2] * v1
            + INSIDE[place][3] * a0 + INSIDE[place][4] * a1
        )  # fmt: skip
        w[n + i] = rate * (
            INSIDE[place][5] * way + INSIDE[place][6] * v0 + INSIDE[place][7] * v1
            + INSIDE[place][8] * a0 + INSIDE[place][9] * a1
        )  # fmt: skip
