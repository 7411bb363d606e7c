"""The length of steps: the first one, and each next one by the error of the last."""

import math

import numpy as np

from rockeom.compiler.decorators import inlined
from rockeom.integrator.extremes import own_time
from rockeom.integrator.ground import ground_accelerations
from rockeom.integrator.guards import rocking
from rockeom.integrator.provided import (
    COARSE,
    ERROR_EXPONENT,
    LOCALISED,
    N_STAGES,
    N_STATES,
    rates,
)
from rockeom.integrator.tolerances import LEAST_ERROR, SHORTEST_FIRST, SMALL_STATE


def first_step(mode, t, y, rate, p, ground, rtol, atol, w, later):
    """A first step, from the sizes of the state, of its rate, and of the change of that.

    A rocking structure tells how long it may be, by Hairer's estimate or a tenth of its own time;
    elsewhere it is a cautious one. w, later (N,) : scratch.
    """
    size = speed = change = 0.0
    for i in range(N_STATES):
        scale = atol[i] + rtol * abs(y[i])
        size = max(size, abs(y[i]) / scale)
        speed = max(speed, abs(rate[i]) / scale)
    cautious = SHORTEST_FIRST if size < SMALL_STATE or speed < SMALL_STATE else 0.01 * size / speed
    longest = 0.1 * own_time(mode, y, p)
    if LOCALISED or not rocking(mode) or not cautious < longest:
        return cautious
    for i in range(N_STATES):
        w[i] = y[i] + cautious * rate[i]
    tau = t + cautious
    rates(mode, w, p, *ground_accelerations(ground, tau), later)
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


@inlined
def controlled(h, error, last_error):
    """(step to come, error to remember), by proportional-integral control.

    The last error damps the answer to this one.
    """
    error = max(error, LEAST_ERROR)
    factor = power(error, 0.7 * ERROR_EXPONENT) * power(last_error, -0.4 * ERROR_EXPONENT)
    return h * min(5.0, max(0.2, 0.9 * factor)), error


@inlined
def finite_end(k):
    """Whether the rates at the end of a step are finite: the state is not, if they are not."""
    total = 0.0
    for i in range(N_STATES):
        total += k[N_STAGES * N_STATES + i]
    return math.isfinite(total)
