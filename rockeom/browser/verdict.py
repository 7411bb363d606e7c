"""The statics of a page: the acceleration that lifts a foot, and whether it slides before.

The same as `rockeom.assessment.statics`, for structures on rigid ground with full contact. Unknown
are the acceleration and the coordinates that are free in full contact, whose equations are linear
but for small terms: Newton's method from rest. This text is joined to others, see
`rockeom.browser.page`.
"""

import numpy as np

from rockeom.browser.written import BOTH_MODE, LEFT_FOOT, N_REACTIONS, RIGHT_FOOT
from rockeom.compiler.decorators import Floats, entry
from rockeom.integrator.provided import N_STATES, ROTATION, rates, reactions

N = N_STATES // 2
NEWTON_STEPS = 8
"""Steps of Newton's method: the first one solves what is linear."""


@entry
def uplift_and_friction(p: Floats, out: Floats):
    """The least acceleration that lifts a foot [m/s2], the friction that prevents sliding before.

    The friction coefficient is that of both sides: with less it slides first to one of them.
    """
    left, right = lifting(LEFT_FOOT, p), lifting(RIGHT_FOOT, p)
    y, forces = np.zeros(N_STATES), np.zeros(N_REACTIONS)
    reactions(BOTH_MODE, y, p, 0.0, 0.0, forces)
    weight = forces[LEFT_FOOT] + forces[RIGHT_FOOT]
    reactions(BOTH_MODE, y, p, 0.0, 1.0, forces)
    mass = forces[LEFT_FOOT] + forces[RIGHT_FOOT] - weight
    out[0], out[1] = min(left, right), max(left, right) * mass / weight


def lifting(foot, p):
    """The size of the ground acceleration under which the force on a foot vanishes; inf if none."""
    unknown, value, moved = np.zeros(N), np.zeros(N), np.zeros(N)
    slopes = np.zeros((N, N))
    for _ in range(NEWTON_STEPS):
        lacking(unknown, foot, p, value)
        for j in range(N):
            h = 1.0 if j == 0 else 1e-3
            unknown[j] = unknown[j] + h
            lacking(unknown, foot, p, moved)
            unknown[j] = unknown[j] - h
            for i in range(N):
                slopes[i, j] = (moved[i] - value[i]) / h
        if not eliminated(slopes, value):
            return np.inf
        for i in range(N):
            unknown[i] = unknown[i] - value[i]
    return abs(unknown[0])


def lacking(unknown, foot, p, out):
    """The force on the foot, and the accelerations of free coordinates, which equilibrium lacks."""
    y, dy, forces = np.zeros(N_STATES), np.zeros(N_STATES), np.zeros(N_REACTIONS)
    k = 1
    for i in range(N):
        if i != ROTATION:
            y[i] = unknown[k]
            k = k + 1
    rates(BOTH_MODE, y, p, unknown[0], 0.0, dy)
    reactions(BOTH_MODE, y, p, unknown[0], 0.0, forces)
    out[0] = forces[foot]
    k = 1
    for i in range(N):
        if i != ROTATION:
            out[k] = dy[N + i]
            k = k + 1


def eliminated(a, b):
    """Solve a x = b in place by Gauss and Jordan, with pivoting; whether there is a solution.

    A coordinate that is held has no equation, and stays: its row is zero.
    """
    for i in range(1, N):
        if largest(a, i) == 0.0:
            a[i, i] = 1.0
            b[i] = 0.0
    for i in range(N):
        best = i
        for k in range(i + 1, N):
            if abs(a[k, i]) > abs(a[best, i]):
                best = k
        if a[best, i] == 0.0:
            return False
        for j in range(N):
            a[i, j], a[best, j] = a[best, j], a[i, j]
        b[i], b[best] = b[best], b[i]
        for k in range(N):
            if k != i:
                share = a[k, i] / a[i, i]
                for j in range(i, N):
                    a[k, j] = a[k, j] - share * a[i, j]
                b[k] = b[k] - share * b[i]
    for i in range(N):
        b[i] = b[i] / a[i, i]
    return True


def largest(a, i):
    """The largest size in row i."""
    size = 0.0
    for j in range(N):
        size = max(size, abs(a[i, j]))
    return size
