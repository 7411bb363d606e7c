"""The state within a step: quintics through both ends, and the dense output of the method."""

from typing import NamedTuple

from rockeom.compiler.decorators import inlined
from rockeom.integrator.provided import N_STAGES, N_STATES, POWERS_TO_BERNSTEIN, ROTATION


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


def slope_at(coefficients, x, i):
    """First and second derivative of state i by x."""
    slope, bend = 7.0 * coefficients[7 * N_STATES + i], 42.0 * coefficients[7 * N_STATES + i]
    for j in range(6, 0, -1):
        slope = slope * x + j * coefficients[j * N_STATES + i]
    for j in range(6, 1, -1):
        bend = bend * x + j * (j - 1) * coefficients[j * N_STATES + i]
    return slope, bend


def shorten(coefficients, x):
    """Make [0, x] of a step its whole [0, 1]; x may be a little above 1."""
    factor = 1.0
    for j in range(8):
        for i in range(N_STATES):
            coefficients[j * N_STATES + i] *= factor
        factor *= x


@inlined
def polynomial_of(state, side, coefficients, b, at):
    """Bernstein coefficients b[at : at + 8] of a state to a side, from the dense output."""
    for i in range(8):
        b[at + i] = 0.0
        for j in range(i + 1):
            power = side * coefficients[j * N_STATES + state]
            b[at + i] += POWERS_TO_BERNSTEIN[i, j] * power


class Ends(NamedTuple):
    """A coordinate, its rate and its acceleration at both ends of a step."""

    q0: float
    v0: float
    a0: float
    q1: float
    v1: float
    a1: float


@inlined
def quintic_through(side, h, ends):
    """Bernstein coefficients of a coordinate to a side, by the quintic through both ends."""
    fifth, part = 0.2 * side * h, 0.05 * side * h * h
    q0, v0, a0 = side * ends.q0, fifth * ends.v0, part * ends.a0
    q1, v1, a1 = side * ends.q1, fifth * ends.v1, part * ends.a1
    return q0, q0 + v0, q0 + 2.0 * v0 + a0, q1 - 2.0 * v1 + a1, q1 - v1, q1


@inlined
def quintic_of(i, side, h, y, y_new, k):
    """The same of coordinate i of a state y (N,) and of that at the end, with the rates k."""
    n, end = N_STATES // 2, N_STAGES * N_STATES
    ends = Ends(y[i], y[n + i], k[n + i], y_new[i], y_new[n + i], k[end + n + i])
    return quintic_through(side, h, ends)


@inlined
def gap_at_ends(side, h, y, y_new, k):
    """The same of the gap, the rotation to a side; of the rotation itself without one, 0.0."""
    return quintic_of(ROTATION, 1.0 if side == 0.0 else side, h, y, y_new, k)


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


def extrapolate(h, move, y, y_new, k):
    """Move the end of a step by a small part of it, on the quintics through both ends.

    A rate that stays the same in the step keeps its value to the last bit, as that of a tie that
    has broken must: its quintic has the rounding errors of the coordinate, divided by the step.
    """
    n = N_STATES // 2
    part = move / h
    for i in range(n):
        v0, v1 = h * y[n + i], h * y_new[n + i]
        a0, a1 = h * h * k[n + i], h * h * k[N_STAGES * N_STATES + n + i]
        jerk = 60.0 * (y_new[i] - y[i]) - 36.0 * v1 - 24.0 * v0 + 9.0 * a1 - 3.0 * a0
        y_new[i] += part * (v1 + part * (0.5 * a1 + part * jerk / 6.0))
        if v1 != v0 or a1 != 0.0 or a0 != 0.0:
            y_new[n + i] += part * (a1 + 0.5 * part * jerk) / h
