"""Modes whose number is a code of digits, one for the state of each point: forces, solved for.

A structure in space has one set of equations, and rows for the three directions of each point:

    M q'' = f + J' lambda        J q'' + bias = 0 in the directions that the points hold

In a mode these are solved as numbers. A part of each generated module that imports from it, as the
prelude is; functions take the number n of coordinates and m of points, `smooth`, which has a binary
digit 1 for each point without friction, and leave what they find in arrays of their caller.
"""

import numpy as np

from rockeom.codes import BEARS, DIGITS_OF_STATES, IDLES, MOST_POINTS_IN_SPACE, OPEN
from rockeom.compiler.decorators import inlined, rolled

__fused__ = False

MOST_COORDINATES = 24
MOST_ROWS = 3 * MOST_POINTS_IN_SPACE
STATES_OF_POINT = len(DIGITS_OF_STATES)
POWERS_OF_TWO = tuple(2**i for i in range(MOST_POINTS_IN_SPACE))
PLACE_VALUES = tuple(STATES_OF_POINT**i for i in range(MOST_POINTS_IN_SPACE))

# Where `points` tells what of each: gap, rates of gap and slips, their biases, rows of all three
FIRST_BIAS = 4
FIRST_LEVER = 7

MASSLESS_IN_SPACE = 1e-13  # of an entry of M: a pivot below it is none, see points.py
REDUNDANT = 1e-12  # of the largest pivot: a row that others give, but for rounding
NONE_OF_TERMS = 1e-14  # of the terms of a sum: nothing but rounding errors


@inlined
def digit_of(mode, point):
    """The digit of a point in the number of a mode."""
    rest = int(mode / PLACE_VALUES[point])
    return rest - STATES_OF_POINT * int(rest / STATES_OF_POINT)


@inlined
def is_smooth_by(smooth, point):
    """Whether a point has no friction."""
    rest = int(smooth / POWERS_OF_TWO[point])
    return rest - 2 * int(rest * 0.5) == 1


def rows_of_mode(mode, m, smooth, row):
    """(held, all): how many rows a mode holds, and with those of idle points, into row (3 m,).

    Row 3 i is that of the gap of point i, those of its slips follow. Gaps of points that bear come
    first, then slips of those that stick, and last gaps of idle points.
    """
    held = 0
    for i in range(m):
        digit = digit_of(mode, i)
        if digit != OPEN and digit != IDLES:
            row[held] = 3 * i
            held += 1
    for i in range(m):
        if digit_of(mode, i) == BEARS and not is_smooth_by(smooth, i):
            row[held] = 3 * i + 1
            row[held + 1] = 3 * i + 2
            held += 2
    every = held
    for i in range(m):
        if digit_of(mode, i) == IDLES:
            row[every] = 3 * i
            every += 1
    return held, every


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
    """Forces in k rows that are held, and those that `others` would have, into share.

    More than three points of a rigid body leave open how they share the load. They do so as equal
    springs under the body, without torsion: the normal forces are linear in the place of a point.
    Forces along the ground of points that stick are shared alike; since all lie in one plane, the
    sum and the moment of these do not depend on the others. Such forces are a combination of the
    rows of J, each of which is one of as many as are independent.

    a (k, k + others + 1) row by row, changed : J M^-1 J' of the rows, the columns of the others,
    and the accelerations that forces are to give. share (k + others,). Returns how many rows are
    independent.
    """
    width, rank, largest = k + others + 1, 0, 0.0
    pivots = np.zeros(MOST_ROWS, np.int64)
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
    """From the forces of the independent rows alone to theirs where all share the load.

    With F, by which all other rows are combinations of theirs: (1 + F F') N = N of those alone. The
    forces stand in the last column of a.
    """
    left, row = np.empty(MOST_ROWS * (MOST_ROWS + 1)), np.empty(MOST_ROWS, np.int64)
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
def motion_in_code(mode, n, m, smooth, matrix, forces, told, accelerations, share):
    """Accelerations (n,) in a mode, and the forces at each point: normal, along x and y, (3 m,).

    matrix (n, n), forces (n,) : of `free_motion`. told : of `points`. share : zero of a point that
    is open; of an idle one what it would bear, negative as long as it is idle.
    """
    row = np.empty(MOST_ROWS, np.int64)
    held, every = rows_of_mode(mode, m, smooth, row)
    for r in range(3 * m):
        share[r] = 0.0
    b = np.empty(MOST_COORDINATES * (MOST_ROWS + 1))
    scratch, inverse = np.empty(MOST_COORDINATES * MOST_COORDINATES), np.empty(MOST_COORDINATES)
    columns = held + 1
    for i in range(n):
        b[i * columns] = forces[i]
    for r in range(held):
        lever = lever_of(row[r], n)
        for i in range(n):
            b[i * columns + 1 + r] = told[lever + i]
    solve_through_mass(n, matrix, b, columns, scratch, inverse, MASSLESS_IN_SPACE)
    if held > 0:
        a, found = np.empty(MOST_ROWS * (MOST_ROWS + 1)), np.empty(MOST_ROWS)
        width = every + 1
        for r in range(held):
            for s in range(width):
                # M^-1 J' of this row, or last the free accelerations
                lever, column = lever_of(row[s if s < every else r], n), r + 1 if s < every else 0
                total = 0.0
                for i in range(n):
                    total += told[lever + i] * b[i * columns + column]
                a[r * width + s] = total
            a[r * width + every] = -a[r * width + every] - told[bias_of(row[r], n)]
        share_load(held, every - held, a, found)
        for r in range(every):
            share[row[r]] = found[r]
    for i in range(n):
        total, largest = b[i * columns], abs(b[i * columns])
        for r in range(held):
            term = share[row[r]] * b[i * columns + 1 + r]
            total += term
            largest += abs(term)
        accelerations[i] = total if abs(total) > NONE_OF_TERMS * largest else 0.0


@inlined
def lever_of(row, n):
    """Where a row of J begins in what `points` tells."""
    point = int(row / 3)
    return point * (FIRST_LEVER + 3 * n) + FIRST_LEVER + (row - 3 * point) * n


@inlined
def bias_of(row, n):
    """Where the bias of a row stands in what `points` tells."""
    point = int(row / 3)
    return point * (FIRST_LEVER + 3 * n) + FIRST_BIAS + row - 3 * point


@inlined
def guards_in_code(mode, n, m, told, share, g):
    """Guards of the points of a mode into g (m,): a gap, or what a point bears, or would not."""
    for i in range(m):
        digit = digit_of(mode, i)
        g[i] = share[3 * i]
        if digit == OPEN:
            g[i] = told[i * (FIRST_LEVER + 3 * n)]
        elif digit == IDLES:
            g[i] = -share[3 * i]
