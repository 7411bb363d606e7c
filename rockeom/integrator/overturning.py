"""Overturning: where the rotation, or another coordinate that may fall, reaches its bound."""

import math

from rockeom.compiler.decorators import inlined
from rockeom.integrator.bernstein import (
    NEVER,
    first_fall,
)
from rockeom.integrator.polynomials import polynomial_of, power_sum, quintic_of
from rockeom.integrator.provided import (
    FALLS,
    N_FALLS,
    ROTATION,
    opening_acceleration,
    overturns_at,
)
from rockeom.integrator.tolerances import EXACT


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
    a = abs(opening_acceleration(mode, y, p, 0.0, 0.0))
    return 1.0 / math.sqrt(a) if a > 0.0 else 0.0
