"""The extremes of the states, within steps, too, and whether one of them has overturned."""

import math

import numpy as np

from rockeom.compiler.decorators import inlined
from rockeom.integrator.bernstein import NEVER, first_fall
from rockeom.integrator.polynomials import polynomial_of, power_sum, quintic_of, slope_at
from rockeom.integrator.provided import (
    FALLS,
    N_FALLS,
    N_STAGES,
    N_STATES,
    NODES,
    ROTATION,
    STILL,
    opening_acceleration,
    overturns_at,
)
from rockeom.integrator.tolerances import CLEAR, EXACT, SETTLED_EXTREME


def widen(extremes, y):
    """Let the smallest and largest values (2, N) take in a state."""
    for i in range(N_STATES):
        extremes[0, i] = min(extremes[0, i], y[i])
        extremes[1, i] = max(extremes[1, i], y[i])


@inlined
def widens(extremes, h, y, y_new, k):
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
        margin = CLEAR * (most - least)
        far = far or least - margin < min(h * extremes[0, n + i], slow)
        far = far or most + margin > max(h * extremes[1, n + i], fast)
        if min(least, slow) >= 0.0 or max(most, fast) <= 0.0:
            continue  # it rises or falls all along
        least, most = min(min(b1, b2), min(b3, b4)), max(max(b1, b2), max(b3, b4))
        margin = CLEAR * (most - least)
        far = far or least - margin < extremes[0, i] or most + margin > extremes[1, i]
    return far


def widen_within(extremes, coefficients):
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
        extremes[0, i] = min(extremes[0, i], min(least, turning_point(coefficients, low, i, -1.0)))
        extremes[1, i] = max(extremes[1, i], max(most, turning_point(coefficients, high, i, 1.0)))


def turning_point(coefficients, x, i, sign):
    """Value of state i at its maximum (sign 1) or minimum (-1) beside the node x of a step."""
    low, high = max(x - 0.25, 0.0), min(x + 0.25, 1.0)
    for _ in range(6):
        slope, bend = slope_at(coefficients, x, i)
        if sign * bend >= 0.0:
            break
        before = x
        x = min(max(x - slope / bend, low), high)
        if abs(x - before) < SETTLED_EXTREME:
            break  # an extreme's error is of the order of the square of that
    return power_sum(coefficients, x, i)


# -- overturning: a coordinate that may fall reaches its bound ------------------------------------


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


def leans_most(extremes, fallen, p):
    """The state, of those that may fall, nearest to its bound, and how far it has come.

    Another coordinate than the rotation counts against its bound as the rotation does.
    """
    leaning, leans = ROTATION, max(-extremes[0, ROTATION], extremes[1, ROTATION])
    if N_FALLS > 0:
        for i in range(N_FALLS):
            other = max(-extremes[0, FALLS[i]], extremes[1, FALLS[i]]) * fallen / overturns_at(i, p)
            if other > leans:
                leaning, leans = FALLS[i], other
    return leaning, leans


def own_time(mode, y, p):
    """Time in which a rocking motion goes on, 1/sqrt(acceleration); 0 where nothing drives it."""
    a = abs(opening_acceleration(mode, y, p, *STILL))
    return 1.0 / math.sqrt(a) if a > 0.0 else 0.0
