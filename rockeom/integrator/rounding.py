"""Rounding errors of guards, below which nothing says whether one is open or closed."""

import numpy as np

from rockeom.codes import IMPACT, SWITCH
from rockeom.integrator.bernstein import size
from rockeom.integrator.provided import (
    N_GUARDS,
    N_MODES,
    N_PARTS,
    N_STATES,
    ROTATION,
    STILL,
    guards,
    guards_in,
    kind_of,
    opening_acceleration,
    part_of,
    side_of,
)
from rockeom.integrator.tolerances import (
    ACCELERATION_AT_REST,
    DIFFERENCE,
    FORCE_AT_REST,
    GAP_AT_REST,
    SAMPLED,
)


def noise_of(mode, index, p, fallen, noise, w, g):
    """Size of the rounding errors of a switch's guard, by what the last digits of parameters make.

    The force of a tendon is that of its length less another one; near upright nothing but the
    rounding of both may be left, or less than counts beside any other force. Found where the
    structure leans a little, once in each call of the loop: noise holds what is known of the guards
    of each mode, or -1, and has room for one more.
    """
    if kind_of(mode, index) != SWITCH:
        return 0.0
    first = mode * (N_GUARDS + N_PARTS)
    other = noise[N_MODES * (N_GUARDS + N_PARTS) :]
    if noise[first] < 0.0:
        for i in range(N_STATES):
            w[i] = 0.0
        w[ROTATION] = 0.01 * side_of(mode) * min(fallen, 1.0)
        for i in range(N_GUARDS):
            noise[first + i] = 0.0
        for j in range(p.shape[0]):
            value = p[j]
            p[j] = value * (1.0 + DIFFERENCE)
            guards(mode, w, p, *STILL, other)
            p[j] = value * (1.0 - DIFFERENCE)
            guards(mode, w, p, *STILL, g)
            p[j] = value
            for i in range(guards_in(mode)):
                change = abs(other[i] - g[i])
                if change < np.inf:
                    noise[first + i] += 0.5 / DIFFERENCE * SAMPLED * change
    return noise[first + index]


def rounding(mode, index, h, y, p, shaking, b):
    """Size of the rounding errors of a guard that opens from closed.

    A gap that opens without speed grows with the third power of time out of accelerations that
    cancel: what is left of them by rounding acts over the whole step.
    """
    scale = size(b, 8 * index)
    if kind_of(mode, index) != IMPACT:
        left = abs(b[8 * index])
        if N_PARTS > 0 and part_of(mode, index) >= 0:
            part = 8 * part_of(mode, index)
            scale = max(size(b, part), size(b, part + 8))
            left = abs(max(b[part], b[part + 8]))
        return max(SAMPLED * scale, min(2.0 * left, FORCE_AT_REST * scale))
    acceleration = 0.0
    for other in range(N_MODES):
        if side_of(other) != 0.0:
            acceleration += abs(opening_acceleration(other, y, p, *shaking))
    return max(GAP_AT_REST * scale, ACCELERATION_AT_REST * acceleration * h * h)
