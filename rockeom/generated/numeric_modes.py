"""Modes whose number is a code of digits, one for the state of each point: forces, solved for.

A structure in space has one set of equations and one row for each direction of each point:

    M q'' = f + J' lambda        J q'' + bias = 0 of what the points hold

In a mode these are solved as numbers. A part of each generated module that imports from it, as the
prelude is; functions take the number n of coordinates and m of points, and leave what they find in
arrays of their caller.
"""

import numpy as np

from rockeom.codes import FRICTIONLESS, IDLE_POINT, MOST_POINTS_IN_SPACE, OPEN, STATES_IN_SPACE
from rockeom.compiler.decorators import inlined, rolled

__fused__ = False

MOST_COORDINATES = 24
STATES_OF_POINT = len(STATES_IN_SPACE)
PLACE_VALUES = tuple(STATES_OF_POINT**i for i in range(MOST_POINTS_IN_SPACE))

# Where `points` tells what of each: gap, rates of gap and slips, their biases, rows of all three
FIRST_BIAS = 4
FIRST_LEVER = 7

REDUNDANT = 1e-12  # of the largest pivot: a row that others give, but for rounding
NONE_OF_TERMS = 1e-14  # of the terms of a sum: nothing but rounding errors


@inlined
def state_in_code(mode, point):
    """The state of a point in a mode: a digit of its number."""
    rest = int(mode / PLACE_VALUES[point])
    return STATES_IN_SPACE[rest - STATES_OF_POINT * int(rest / STATES_OF_POINT)]


def touching(mode, m, place):
    """(all, bearing): how many points touch, and bear; those that bear come first in place (m,)."""
    number = bearing = 0
    for turn in range(2):
        for i in range(m):
            if state_in_code(mode, i) == (FRICTIONLESS if turn == 0 else IDLE_POINT):
                place[number] = i
                number += 1
        if turn == 0:
            bearing = number
    return number, bearing


@rolled
def solve_through_mass(n, matrix, b, width, a, inverse, massless):
    """Solve M x = b in place, b (n, width), by Gauss without a search for pivots: M is positive.

    matrix (n, n) : M, which is kept. a (n, n), inverse (n,) : scratch. A pivot below `massless` of
    its entry of M is none: coordinates without inertia do not move.
    """
    for i in range(n * n):
        a[i] = matrix[i]
    for i in range(n):
        pivot = a[i * n + i]
        inverse[i] = 1.0 / pivot if pivot > massless * matrix[i * n + i] else 0.0
        for j in range(i + 1, n):
            factor = a[i * n + j] * inverse[i]
            for m in range(j, n):
                a[j * n + m] -= factor * a[i * n + m]
            for m in range(width):
                b[j * width + m] -= factor * b[i * width + m]
    for back in range(n):
        i = n - 1 - back
        for m in range(width):
            value = b[i * width + m]
            for j in range(i + 1, n):
                value -= a[i * n + j] * b[j * width + m]
            b[i * width + m] = value * inverse[i]


# -- forces of points that bear -------------------------------------------------------------------


@rolled
def share_load(k, others, a, share):
    """Forces of k points that bear, and what `others` would bear beside them, into share.

    More points of a rigid body than three leave open how they share the load. They do so as equal
    springs under the body, without torsion: their forces are linear in the place of a point, and so
    a combination of the rows of J, each of which is one of as many as are independent. The forces
    of the others are those of the same line.

    a (k, k + others + 1) row by row, changed : J M^-1 J' of the points that bear, the columns of
    the others, and the accelerations that forces are to give. share (k + others,). Returns how many
    points are independent.
    """
    width, rank, largest = k + others + 1, 0, 0.0
    pivots = np.zeros(MOST_POINTS_IN_SPACE, np.int64)
    for i in range(k):
        largest = max(largest, a[i * width + i])
    for _ in range(k):
        best = -1
        for i in range(k):
            if pivots[i] == 0 and (best < 0 or a[i * width + i] > a[best * width + best]):
                best = i
        if best < 0 or not a[best * width + best] > REDUNDANT * largest:
            break
        pivots[best] = 1
        rank += 1
        inverse = 1.0 / a[best * width + best]
        for j in range(width):
            a[best * width + j] *= inverse
        for i in range(k):
            factor = a[i * width + best]
            if i != best:
                for j in range(width):
                    a[i * width + j] -= factor * a[best * width + j]
    if rank < k:
        spread_load(k, width, pivots, a)
    for j in range(k + others):
        share[j] = 0.0
        for i in range(k):
            if pivots[i] == 1:
                is_own = 1.0 if i == j else 0.0
                weight = is_own if j < k and pivots[j] == 1 else a[i * width + j]
                share[j] += weight * a[i * width + width - 1]
    return rank


@rolled
def spread_load(k, width, pivots, a):
    """From the forces of the independent points alone to theirs where all share the load.

    With F, by which the rows of all others are combinations of theirs: (1 + F F') N = N of those
    alone. The forces stand in the last column of a.
    """
    left = np.empty(MOST_POINTS_IN_SPACE * (MOST_POINTS_IN_SPACE + 1))
    row = np.empty(MOST_POINTS_IN_SPACE, np.int64)
    rank = 0
    for i in range(k):
        if pivots[i] == 1:
            row[rank] = i
            rank += 1
    size = rank + 1
    for i in range(rank):
        for j in range(rank):
            total = 1.0 if i == j else 0.0
            for m in range(k):
                if pivots[m] == 0:
                    total += a[row[i] * width + m] * a[row[j] * width + m]
            left[i * size + j] = total
        left[i * size + rank] = a[row[i] * width + width - 1]
    for i in range(rank):  # symmetric and positive
        inverse = 1.0 / left[i * size + i]
        for j in range(rank):
            factor = left[j * size + i] * inverse
            if j != i:
                for m in range(i, size):
                    left[j * size + m] -= factor * left[i * size + m]
    for i in range(rank):
        a[row[i] * width + width - 1] = left[i * size + rank] / left[i * size + i]


# -- a mode ---------------------------------------------------------------------------------------


@rolled
def motion_in_code(mode, n, m, matrix, forces, told, accelerations, share):
    """Accelerations (n,) in a mode, and what each point that touches bears, or would, (m,).

    matrix (n, n), forces (n,) : of `free_motion`. told : of `points`. share : zero of a point that
    is open; of an idle one what it would bear, negative as long as it is idle.
    """
    size = FIRST_LEVER + 3 * n
    place = np.empty(MOST_POINTS_IN_SPACE, np.int64)
    order, bearing = touching(mode, m, place)
    for i in range(m):
        share[i] = 0.0
    b = np.empty(MOST_COORDINATES * (MOST_POINTS_IN_SPACE + 1))
    a, scratch = np.empty(MOST_COORDINATES * MOST_COORDINATES), np.empty(MOST_COORDINATES)
    columns = bearing + 1
    for i in range(n):
        b[i * columns] = forces[i]
        for j in range(bearing):
            b[i * columns + 1 + j] = told[place[j] * size + FIRST_LEVER + i]
    solve_through_mass(n, matrix, b, columns, a, scratch, 1e-13)
    if bearing > 0:
        width = order + 1
        for i in range(bearing):
            for j in range(width):
                # of M^-1 J' of this point, or last of the free accelerations
                column = i + 1 if j < order else 0
                row = place[j if j < order else i] * size + FIRST_LEVER
                total = 0.0
                for c in range(n):
                    total += told[row + c] * b[c * columns + column]
                a[i * width + j] = total
            last = i * width + order
            a[last] = -a[last] - told[place[i] * size + FIRST_BIAS]
        found = np.empty(MOST_POINTS_IN_SPACE)
        share_load(bearing, order - bearing, a, found)
        for j in range(order):
            share[place[j]] = found[j]
    for i in range(n):
        total, largest = b[i * columns], abs(b[i * columns])
        for j in range(bearing):
            term = share[place[j]] * b[i * columns + 1 + j]
            total += term
            largest += abs(term)
        accelerations[i] = total if abs(total) > NONE_OF_TERMS * largest else 0.0


@inlined
def guards_in_code(mode, n, m, told, share, g):
    """Guards of the points of a mode into g (m,): a gap, or what a point bears, or would not."""
    for i in range(m):
        state = state_in_code(mode, i)
        g[i] = share[i]
        if state == OPEN:
            g[i] = told[i * (FIRST_LEVER + 3 * n)]
        elif state == IDLE_POINT:
            g[i] = -share[i]
