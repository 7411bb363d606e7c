"""Modes whose number is a code of digits, one for the state of each point: forces, solved for.

A structure in space has one set of equations, and rows for the three directions of each point:

    M q'' = f + J' lambda        J q'' + bias = 0 in the directions that the points hold

In a mode these are solved as numbers. A part of each generated module that imports from it, as the
prelude is; functions take the number n of coordinates and m of points, `smooth`, which has a binary
digit 1 for each point without friction, and leave what they find in arrays of their caller.
"""

import math

import numpy as np

from rockeom.codes import (
    BEARS,
    DIGITS_OF_STATES,
    IDLES,
    MOST_POINTS_IN_SPACE,
    NEVER_SLIPS,
    OPEN,
    SLIPS,
)
from rockeom.compiler.decorators import everywhere, inlined, rolled

__fused__ = False

MOST_COORDINATES = 24
MOST_ROWS = 3 * MOST_POINTS_IN_SPACE
MOST_UNKNOWNS = MOST_COORDINATES * (MOST_COORDINATES + 1)
STATES_OF_POINT = len(DIGITS_OF_STATES)
PLACE_VALUES = tuple(STATES_OF_POINT**i for i in range(MOST_POINTS_IN_SPACE))
# Powers of two, so that products with them are exact, and sooner than a division
INVERSE_PLACES = tuple(1.0 / value for value in PLACE_VALUES)
NEXT_PLACE = 1.0 / STATES_OF_POINT
INVERSE_BINARY_PLACES = tuple(0.5**i for i in range(MOST_POINTS_IN_SPACE))

# Where `points` tells what of each: gap, rates of gap and slips, their biases, rows of all three
FIRST_BIAS = 4
FIRST_LEVER = 7

ENOUGH = 0.1  # of a diagonal entry, that is left: a pivot as good as any
REDUNDANT = 1e-12  # of a diagonal entry, that is left: its row follows from others
NONE_OF_TERMS = 1e-14  # of the terms of a sum: nothing but rounding errors
WEDGE = 2.414213562373095  # tangent of the angle to its axis at which a slip has turned: 67.5 deg
MOST_PART = 1e100  # of its friction that a guard counts
SLOW_SLIP = 1e-7  # [m/s] below which a slip turns as slowly as there, see `slow_turns`
LEAST_SLIP = 1e-13  # [m/s] at which a slip has ended: a slower one turns faster than steps follow
NO_YIELD = 1e-6  # of force times null vector: neither point turns about the other, but for rounding
MOST_SHARES = 60  # of the iteration for the least friction
SAME_PART = 1e-13  # of it, that all points use: it has come to its end
PIVOTS = 1e-5  # of the fastest: points that are slower are those about which others turn
LEAST_PART_OF_TURN = 1e-6  # of the fastest: the velocity of a point about which others turn


@everywhere
def digit_of(mode, point):
    """The digit of a point in the number of a mode."""
    rest = int(mode * INVERSE_PLACES[point])
    return rest - STATES_OF_POINT * int(rest * NEXT_PLACE)


@everywhere
def is_smooth_by(smooth, point):
    """Whether a point has no friction."""
    rest = int(smooth * INVERSE_BINARY_PLACES[point])
    return rest - 2 * int(rest * 0.5) == 1


@inlined
def slips_by(digit):
    """Whether a point slips."""
    return digit >= SLIPS


def slips_in(mode, m):
    """Whether any point slips in a mode."""
    some = False
    for i in range(m):
        some = some or slips_by(digit_of(mode, i))
    return some


@inlined
def laws_in(told, n, m):
    """Restitution and friction of each point (2 m,), which stand behind what `points` tells."""
    return told[m * (FIRST_LEVER + 3 * n) :]


@inlined
def axis_of(digit):
    """The axis (x, y) that is nearest to the direction of a slip."""
    turns = digit - SLIPS
    x = 1.0 if turns == 0 else (-1.0 if turns == 2 else 0.0)
    y = 1.0 if turns == 1 else (-1.0 if turns == 3 else 0.0)
    return x, y


def digit_along(x, y):
    """The digit of a point that slips in a direction."""
    if abs(x) >= abs(y):
        return SLIPS if x >= 0.0 else SLIPS + 2
    return SLIPS + 1 if y >= 0.0 else SLIPS + 3


@everywhere
def directions_of_slips(mode, n, m, told, along):
    """Unit vectors (2 m,) of the slips of a mode, by the rates that `points` tells.

    Beyond a stop, where a slip has turned to the other side of its axis, that of before goes on.
    """
    for i in range(m):
        digit, at = digit_of(mode, i), i * (FIRST_LEVER + 3 * n)
        along[2 * i] = along[2 * i + 1] = 0.0
        if slips_by(digit):
            x, y = axis_of(digit)
            u, v = told[at + 2], told[at + 3]
            size = (u * u + v * v) ** 0.5  # of many states at once, too
            size = -size if u * x + v * y < 0.0 else size
            along[2 * i] = u / size if size != 0.0 else x
            along[2 * i + 1] = v / size if size != 0.0 else y


@everywhere
def rows_in(mode, m, smooth, rows):
    """Which rows a mode holds: 1 in rows (3 m,), 2 of the gap of an idle point, or else 0."""
    for i in range(m):
        digit, at = digit_of(mode, i), 3 * i
        rows[at] = 0 if digit == OPEN else (2 if digit == IDLES else 1)
        rows[at + 1] = rows[at + 2] = 1 if digit == BEARS and not is_smooth_by(smooth, i) else 0


# -- forces of points that bear -------------------------------------------------------------------


@everywhere
def hold(mode, n, m, smooth, matrix, forces, told, bias, x, share):
    """Accelerations x (n,) in a mode, and the forces at each point into share (3 m,).

    The accelerations that the rows of a mode allow, J x + bias = 0, are x_0 + N s, by elimination
    in G = J'J with pivots on its diagonal. In what is left of the equations of motion,

        M (x_0 + N s) - f = J' lambda

    the forces are lambda = J z, with an unknown for each pivot. So points share a load, where there
    are more of them than it needs, as equal springs under a body do, without torsion: normal forces
    are linear in the place of a point. Forces along the ground of points that stick are shared
    alike; since all lie in one plane, the sum and the moment of these do not depend on the others.
    A point that slips has its friction with its normal force.

    matrix (n, n), forces (n,), bias (3 m,) : M, f and bias; for impulses, 0 as f, and the negative
    change of velocities as bias. told : of `points`, then the `laws`. share : of an idle point what
    it would bear. Returns how many rows are independent.
    """
    rows, pivots = np.empty(MOST_ROWS, np.int64), np.empty(MOST_COORDINATES, np.int64)
    g, b, width = np.empty(MOST_UNKNOWNS), np.empty(MOST_UNKNOWNS), n + 1
    free, ways = np.empty(MOST_COORDINATES, np.int64), np.empty(MOST_UNKNOWNS)
    z, along = np.empty(MOST_COORDINATES), np.empty(2 * MOST_POINTS_IN_SPACE)
    laws = laws_in(told, n, m)
    directions_of_slips(mode, n, m, told, along)
    rows_in(mode, m, smooth, rows)
    squares_of_rows(n, m, rows, told, bias, g)
    for i in range(n):
        for j in range(i, n):
            b[i * width + j] = b[j * width + i] = -g[i * width + j]
    rub(mode, n, m, laws, along, told, b)
    rank = reduced_rows(n, width, g, pivots)
    order = allowed(n, g, pivots, x, free, ways)
    unbalanced(n, matrix, forces, x, z)
    for i in range(n):
        b[i * width + n] = z[i]
    for r in range(order):
        moved(n, matrix, ways, r, z)
        for i in range(n):
            b[i * width + free[r]] = z[i]
    solve_by_rows(n, b)
    for i in range(n):
        z[i] = b[i * width + n] if pivots[i] == 1 else 0.0
    forces_of_points(n, m, 3, rows, told, z, share)
    add_friction(mode, m, laws, along, share)
    for r in range(order):
        z[r] = b[free[r] * width + n]
    go(n, order, ways, z, x)
    return rank


@everywhere
def unknowns_of_forces(n, matrix, forces, g, pivots, x, z):
    """The unknowns z (n,) of J'J z = M x - f; g (n, n + 1) is of `reduced_rows`."""
    left = np.empty(MOST_COORDINATES)
    unbalanced(n, matrix, forces, x, left)
    for i in range(n):
        z[i] = 0.0
        if pivots[i] == 1:
            for j in range(n):
                if pivots[j] == 1:
                    z[i] += g[i * (n + 1) + j] * left[j]


@everywhere
def press_by_squares(n, m, matrix, forces, g, rows, pivots, told, accelerations, share):
    """Accelerations (n,) where nothing slips, and the normal force at each point into share (3 m,).

    g (n, n + 1) : J'J and -J' bias behind it. told : gaps and their rows alone.
    """
    z = np.empty(MOST_COORDINATES)
    move_by_squares(n, matrix, forces, g, pivots, accelerations)
    unknowns_of_forces(n, matrix, forces, g, pivots, accelerations, z)
    forces_of_points(n, m, 1, rows, told, z, share)


@everywhere
def forces_of_points(n, m, directions, rows, told, z, share):
    """The forces J z of rows that are held, also of the gap of an idle point, into share (3 m,).

    directions : 3, or 1 for normal forces alone.
    """
    for point in range(m):
        for k in range(directions):
            lever, total = point * (FIRST_LEVER + 3 * n) + FIRST_LEVER + k * n, 0.0
            if rows[3 * point + k] > 0:
                for i in range(n):
                    total += told[lever + i] * z[i]
            share[3 * point + k] = total


@inlined
def biases_of_rows(n, m, told, bias):
    """Biases of all rows into bias (3 m,)."""
    for i in range(m):
        for k in range(3):
            bias[3 * i + k] = told[i * (FIRST_LEVER + 3 * n) + FIRST_BIAS + k]


@everywhere
def squares_of_rows(n, m, rows, told, bias, g):
    """G = J'J of the rows that are held, and -J' bias behind it, into g (n, n + 1): above all.

    Below its diagonal g stays zero.
    """
    width = n + 1
    for i in range(n * width):
        g[i] = 0.0
    for point in range(m):
        gap, sticks = point * (FIRST_LEVER + 3 * n) + FIRST_LEVER, 1.0 * rows[3 * point + 1]
        if rows[3 * point] == 1:
            for i in range(n):
                u = told[gap + i]
                v, w = sticks * told[gap + n + i], sticks * told[gap + 2 * n + i]
                for j in range(i, n):
                    x, y, z = told[gap + j], told[gap + n + j], told[gap + 2 * n + j]
                    g[i * width + j] += u * x + v * y + w * z
                x, y, z = bias[3 * point], bias[3 * point + 1], bias[3 * point + 2]
                g[i * width + n] -= u * x + v * y + w * z


@inlined
def rub(mode, n, m, laws, along, told, b):
    """Add the columns of friction, of the points that slip, to b (n, n + 1)."""
    for point in range(m):
        if slips_by(digit_of(mode, point)):
            lever, friction = lever_of(3 * point, n), laws[2 * point + 1]
            for i in range(n):
                slip = along[2 * point] * told[lever + n + i]
                slip += along[2 * point + 1] * told[lever + 2 * n + i]
                for j in range(n):
                    b[i * (n + 1) + j] += friction * slip * told[lever + j]


@everywhere
def allowed(n, g, pivots, x, free, ways):
    """The accelerations that rows allow, x_0 + N s: x_0 into x (n,), columns of N into ways.

    g (n, n + 1) : of `reduced_rows`. free (n,), ways (n, n) : the coordinates s, and the column of
    each in a row, 1 of its own. Returns how many there are.
    """
    order = 0
    for k in range(n):
        x[k] = g[k * (n + 1) + n] if pivots[k] == 1 else 0.0
        if pivots[k] == 0:
            for i in range(n):
                ways[order * n + i] = -g[i * (n + 1) + k] if pivots[i] == 1 else 0.0
            ways[order * n + k] = 1.0
            free[order] = k
            order += 1
    return order


@everywhere
def unbalanced(n, matrix, forces, x, left):
    """f - M x into left (n,)."""
    for i in range(n):
        total = forces[i]
        for j in range(n):
            total -= matrix[i * n + j] * x[j]
        left[i] = total


@everywhere
def moved(n, matrix, ways, r, out):
    """M times the way r, into out (n,)."""
    for i in range(n):
        total = 0.0
        for j in range(n):
            total += matrix[i * n + j] * ways[r * n + j]
        out[i] = total


@everywhere
def go(n, order, ways, s, x):
    """Add N s to x (n,); zero where nothing but rounding is left."""
    for i in range(n):
        total, largest = x[i], abs(x[i])
        for r in range(order):
            term = s[r] * ways[r * n + i]
            total += term
            largest += abs(term)
        x[i] = total if abs(total) > NONE_OF_TERMS * largest else 0.0


@everywhere
def move(mode, n, m, smooth, matrix, forces, told, bias, x):
    """Accelerations x (n,) alone, as `hold` has them where nothing slips."""
    rows, pivots = np.empty(MOST_ROWS, np.int64), np.empty(MOST_COORDINATES, np.int64)
    g = np.empty(MOST_UNKNOWNS)
    rows_in(mode, m, smooth, rows)
    squares_of_rows(n, m, rows, told, bias, g)
    move_by_squares(n, matrix, forces, g, pivots, x)


@everywhere
def move_by_squares(n, matrix, forces, g, pivots, x):
    """Accelerations x (n,) where nothing slips; N' (M N s - f + M x_0) = 0 has no forces.

    g (n, n + 1) : J'J and -J' bias behind it. Returns how many rows are independent.
    """
    free, ways = np.empty(MOST_COORDINATES, np.int64), np.empty(MOST_UNKNOWNS)
    rest, along = np.empty(MOST_COORDINATES), np.empty(MOST_COORDINATES)
    left = np.empty(MOST_UNKNOWNS)
    rank = reduced_rows(n, n + 1, g, pivots)
    order = allowed(n, g, pivots, x, free, ways)
    unbalanced(n, matrix, forces, x, rest)
    for r in range(order):
        moved(n, matrix, ways, r, along)
        total = 0.0
        for i in range(n):
            total += rest[i] * ways[r * n + i]
        left[r * (order + 1) + order] = total
        for s in range(order):
            total = 0.0
            for i in range(n):
                total += along[i] * ways[s * n + i]
            left[r * (order + 1) + s] = total
    solve_by_rows(order, left)
    for r in range(order):
        rest[r] = left[r * (order + 1) + order]
    go(n, order, ways, rest, x)
    return rank


@everywhere
def reduced_rows(k, width, a, pivots):
    """How many of k rows of a symmetric matrix are independent: those whose pivots (k,) are 1.

    a (k, width) row by row, with what stands behind the matrix, read above its diagonal : swept
    (Goodnight 1979) by pivots on it, the next of which is the first with enough left of it, or that
    with most. The columns of the others, in the rows of the independent ones, are then F, by which
    their rows follow; in the columns of these is the negative inverse.
    """
    own, row, rank, largest = np.empty(MOST_COORDINATES), np.empty(MOST_COORDINATES + 1), 0, 0.0
    for i in range(k):
        largest = max(largest, a[i * width + i])
    for i in range(k):
        pivots[i] = 0
        own[i] = max(a[i * width + i], REDUNDANT * largest)  # not of what is rounding alone
    for _ in range(k):
        best, most = -1, REDUNDANT
        for i in range(k):
            if pivots[i] == 0 and a[i * width + i] > most * own[i]:
                best = i
                if a[i * width + i] > ENOUGH * own[i]:
                    break
                most = a[i * width + i] / own[i]
        if best < 0:
            break
        pivots[best] = 1
        rank += 1
        inverse = 1.0 / a[best * width + best]
        for j in range(width):
            row[j] = a[j * width + best] if j < best else a[best * width + j]
        for i in range(k):
            factor = row[i] * inverse
            if i != best and factor != 0.0:
                for j in range(i, width):
                    a[i * width + j] -= factor * row[j]
                a[min(i, best) * width + max(i, best)] = factor
        for j in range(k, width):
            a[best * width + j] *= inverse
        a[best * width + best] = -inverse
    for i in range(1, k):
        for j in range(i):
            a[i * width + j] = a[j * width + i]
    return rank


@everywhere
def solve_by_rows(order, b):
    """Solve b (order, order + 1) in place by Gauss; the solution in its last column."""
    size = order + 1
    for n in range(order):
        best = n
        for i in range(n + 1, order):
            if abs(b[i * size + n]) > abs(b[best * size + n]):
                best = i
        if best != n:
            for j in range(size):
                b[n * size + j], b[best * size + j] = b[best * size + j], b[n * size + j]
        inverse = 1.0 / b[n * size + n] if b[n * size + n] != 0.0 else 0.0
        b[n * size + n] = inverse
        for i in range(n + 1, order):
            factor = b[i * size + n] * inverse
            if factor != 0.0:
                for j in range(n + 1, size):
                    b[i * size + j] -= factor * b[n * size + j]
    for back in range(order):
        n = order - 1 - back
        total = b[n * size + order]
        for j in range(n + 1, order):
            total -= b[n * size + j] * b[j * size + order]
        b[n * size + order] = total * b[n * size + n]


# -- a mode ---------------------------------------------------------------------------------------


@everywhere
def motion_in_code(mode, n, m, smooth, matrix, forces, told, accelerations, share):
    """Accelerations (n,) in a mode, and the forces at each point: normal, along x and y, (3 m,).

    matrix (n, n), forces (n,) : of `free_motion`. told : of `points`, then the `laws`. share : zero
    of a point that is open; of an idle one what it would bear, negative as long as it is idle.
    """
    bias = np.empty(MOST_ROWS)
    biases_of_rows(n, m, told, bias)
    hold(mode, n, m, smooth, matrix, forces, told, bias, accelerations, share)
    if some_are_slow(mode, n, m, told):
        slow_turns(mode, n, m, smooth, told, matrix, accelerations)


def is_slow(mode, point, n, told):
    """Whether a point slips, and slowly."""
    at = point * (FIRST_LEVER + 3 * n)
    square = told[at + 2] * told[at + 2] + told[at + 3] * told[at + 3]
    return slips_by(digit_of(mode, point)) and square < SLOW_SLIP * SLOW_SLIP


def some_are_slow(mode, n, m, told):
    """Whether any point slips slowly."""
    some = False
    for i in range(m):
        some = some or is_slow(mode, i, n, told)
    return some


def slow_turns(mode, n, m, smooth, told, matrix, accelerations):
    """Let slow slips turn no faster than one of SLOW_SLIP would, in accelerations (n,).

    A slip turns towards what drives it, the faster the slower it is: by mu g/|w|, a million times a
    second, which explicit steps would have to follow though nothing else happens. Where it is slow,
    a mass of the point resists its acceleration across the slip, and so only that it turns. Rows
    that are held stay so. matrix (n, n) : M, to which these masses are added.
    """
    along, nothing = np.empty(2 * MOST_POINTS_IN_SPACE), np.zeros(MOST_ROWS)
    across, own = np.empty(MOST_COORDINATES), np.empty(MOST_COORDINATES)
    forces, change = np.zeros(MOST_COORDINATES), np.empty(MOST_COORDINATES)
    directions_of_slips(mode, n, m, told, along)
    for j in range(n):
        own[j] = matrix[j * n + j]
    for i in range(m):
        if not is_slow(mode, i, n, told):
            continue
        at = i * (FIRST_LEVER + 3 * n)
        speed = math.sqrt(told[at + 2] ** 2 + told[at + 3] ** 2)
        x, y = -along[2 * i + 1], along[2 * i]
        turns = x * told[at + FIRST_BIAS + 1] + y * told[at + FIRST_BIAS + 2]
        lever, freely = lever_of(3 * i + 1, n), 0.0
        for j in range(n):
            across[j] = x * told[lever + j] + y * told[lever + n + j]
            turns += across[j] * accelerations[j]
            freely += across[j] ** 2 / own[j] if own[j] > 0.0 else 0.0
        slower = SLOW_SLIP / max(speed, LEAST_SLIP) - 1.0
        mass = slower / freely if freely > 0.0 else 0.0
        for j in range(n):
            forces[j] -= mass * turns * across[j]
            for k in range(n):
                matrix[j * n + k] += mass * across[j] * across[k]
    move(mode, n, m, smooth, matrix, forces, told, nothing, change)
    for j in range(n):
        accelerations[j] += change[j]


@everywhere
def add_friction(mode, m, laws, along, share):
    """The friction of points that slip into share (3 m,), by what they bear; along (2 m,)."""
    for i in range(m):
        if slips_by(digit_of(mode, i)):
            friction = laws[2 * i + 1] * share[3 * i]
            share[3 * i + 1] = -friction * along[2 * i]
            share[3 * i + 2] = -friction * along[2 * i + 1]


@inlined
def lever_of(row, n):
    """Where a row of J begins in what `points` tells."""
    point = int(row / 3)
    return point * (FIRST_LEVER + 3 * n) + FIRST_LEVER + (row - 3 * point) * n


def guards_in_code(mode, n, m, smooth, told, share, g):
    """Guards of the points of a mode into g: m gaps, or what points bear, or would not; then 2 m of
    slips and of sticking, where a point has friction that is not endless.
    """
    pressing, pulled, laws = 0.0, 0.0, laws_in(told, n, m)
    for i in range(m):
        digit = digit_of(mode, i)
        g[i] = share[3 * i]
        if digit == OPEN:
            g[i] = told[i * (FIRST_LEVER + 3 * n)]
        elif digit == IDLES:
            g[i] = -share[3 * i]
        elif digit == BEARS and rubs_by(smooth, laws, i):
            pressing += laws[2 * i + 1] * max(share[3 * i], 0.0)
            pulled += math.sqrt(share[3 * i + 1] ** 2 + share[3 * i + 2] ** 2)
    if not any_rubs(m, smooth, laws):
        return
    first = True
    for i in range(m):
        digit, at = digit_of(mode, i), i * (FIRST_LEVER + 3 * n)
        g[m + i] = g[2 * m + i] = 1.0
        if slips_by(digit):
            x, y = axis_of(digit)
            ahead, aside = told[at + 2] * x + told[at + 3] * y, told[at + 3] * x - told[at + 2] * y
            g[m + i] = WEDGE * ahead + aside - LEAST_SLIP
            g[2 * m + i] = WEDGE * ahead - aside - LEAST_SLIP
        elif digit == BEARS and rubs_by(smooth, laws, i) and first:
            dampers = np.empty(MOST_POINTS_IN_SPACE)
            part = least_friction(mode, n, m, smooth, told, share, dampers)
            used = part * pressing if part < MOST_PART else pressing + pulled
            size = math.sqrt(pressing * pressing + used * used)
            # where a load vanishes it is finite, and negative if friction does not vanish as well
            g[m + i] = (pressing - used) * (pressing + used) / size if size > 0.0 else 0.0
            first = False


def rubs_by(smooth, laws, point):
    """Whether a point may slip with friction."""
    return not is_smooth_by(smooth, point) and laws[2 * point + 1] < NEVER_SLIPS


def any_rubs(m, smooth, laws):
    """Whether any point may slip with friction."""
    some = False
    for i in range(m):
        some = some or rubs_by(smooth, laws, i)
    return some


@rolled
def least_friction(mode, n, m, smooth, told, share, c):
    """The least part of their friction that points which stick must use, in some share of it.

    Rigid bodies leave open how they share forces along the ground. The least of the largest parts
    |T|/(mu N) is reached where all points use the same part of theirs, along the velocities v = J q
    of some motion q, but for those about which it turns: T = c v with c = mu N/|v|, times the part.
    Such c (m,) are found from the forces in `share`.
    """
    load, bound = np.zeros(MOST_COORDINATES), np.zeros(MOST_POINTS_IN_SPACE)
    laws = laws_in(told, n, m)
    acts, count, first, second, unable = 0.0, 0, -1, -1, 0
    for i in range(m):
        c[i] = 0.0
        if digit_of(mode, i) == BEARS and rubs_by(smooth, laws, i):
            for k in range(2):
                lever = lever_of(3 * i + 1 + k, n)
                acts = max(acts, abs(share[3 * i + 1 + k]))
                for j in range(n):
                    load[j] += told[lever + j] * share[3 * i + 1 + k]
            bound[i] = laws[2 * i + 1] * max(share[3 * i], 0.0)
            if bound[i] > 0.0:
                c[i], count = bound[i], count + 1
                second = i if first >= 0 else second
                first = i if first < 0 else first
            elif share[3 * i + 1] != 0.0 or share[3 * i + 2] != 0.0:
                unable += 1
    if acts == 0.0:
        return 0.0
    if count == 0 or (count == 1 and unable > 0):
        return NEVER_SLIPS
    if count == 1:
        return math.sqrt(share[3 * first + 1] ** 2 + share[3 * first + 2] ** 2) / bound[first]
    if count == 2 and unable == 0:
        return least_friction_of_two(first, second, n, told, bound, share, c)
    return least_friction_of_more(n, m, told, bound, load, c)


@rolled
def least_friction_of_two(first, second, n, told, bound, share, c):
    """`least_friction` of two points: T = T_0 + s z, with z in the null space of their rows.

    The larger of two parts, each convex in s, is least where they are alike, or at the least of one
    of them, where the motion turns about the other point. bound (m,) : mu N.
    """
    g, pivots = np.empty(16), np.empty(MOST_ROWS, np.int64)
    force, z, trial = np.empty(4), np.zeros(4), np.empty(4)
    row = np.empty(4, np.int64)
    for k in range(2):
        row[k], row[2 + k] = 3 * first + 1 + k, 3 * second + 1 + k
    for r in range(4):
        force[r] = share[row[r]]
        for s in range(4):
            lever, other, total = lever_of(row[r], n), lever_of(row[s], n), 0.0
            for j in range(n):
                total += told[lever + j] * told[other + j]
            g[4 * r + s] = total
    if reduced_rows(4, 4, g, pivots) < 4:
        for s in range(4):
            if pivots[s] == 0:
                z[s] = 1.0
                for r in range(4):
                    z[r] -= g[4 * r + s] if pivots[r] == 1 else 0.0
                break
    # |T|**2 / bound**2 = of_0 + 2 s of_1 + s**2 of_2 of each
    b, d = bound[first], bound[second]
    a_0, a_1 = (force[0] ** 2 + force[1] ** 2) / b**2, (force[0] * z[0] + force[1] * z[1]) / b**2
    d_0, d_1 = (force[2] ** 2 + force[3] ** 2) / d**2, (force[2] * z[2] + force[3] * z[3]) / d**2
    a_2, d_2 = (z[0] ** 2 + z[1] ** 2) / b**2, (z[2] ** 2 + z[3] ** 2) / d**2
    trial[0] = -a_1 / a_2 if a_2 > 0.0 else 0.0
    trial[1] = -d_1 / d_2 if d_2 > 0.0 else 0.0
    e_0, e_1, e_2 = a_0 - d_0, a_1 - d_1, a_2 - d_2
    root = math.sqrt(max(e_1 * e_1 - e_0 * e_2, 0.0))
    lead = -(e_1 + (root if e_1 >= 0.0 else -root))
    trial[2] = lead / e_2 if e_2 != 0.0 else trial[0]
    trial[3] = e_0 / lead if lead != 0.0 else trial[0]
    least, at = NEVER_SLIPS, 0.0
    for k in range(4):
        to = trial[k]
        most = max(a_0 + to * (2.0 * a_1 + to * a_2), d_0 + to * (2.0 * d_1 + to * d_2))
        if most < least:
            least, at = most, to
    # velocities along the forces, such that the rows' null space does no work: z' J q = 0
    yields_a, yields_d = abs(d_1 + at * d_2) * d * d, abs(a_1 + at * a_2) * b * b
    most = max(yields_a, yields_d)
    c[first] = c[second] = 1.0
    if most > NO_YIELD * (b * math.sqrt(a_0 * a_2) * b + d * math.sqrt(d_0 * d_2) * d):
        c[first] = 1.0 / max(yields_a / most, LEAST_PART_OF_TURN)
        c[second] = 1.0 / max(yields_d / most, LEAST_PART_OF_TURN)
    return math.sqrt(least)


@rolled
def least_friction_of_more(n, m, told, bound, load, c):
    """`least_friction` of any number of points, by iteration. load (n,) : all their forces."""
    h, q = np.empty(MOST_COORDINATES * (MOST_COORDINATES + 1)), np.empty(MOST_COORDINATES)
    speed = np.empty(MOST_POINTS_IN_SPACE)
    lowest, last, found = (
        NEVER_SLIPS,
        np.zeros(MOST_POINTS_IN_SPACE),
        np.zeros(MOST_POINTS_IN_SPACE),
    )
    for turn in range(MOST_SHARES):
        for i in range(n):
            for j in range(n):
                total = 0.0
                for k in range(m):
                    for w in range(2):
                        lever = lever_of(3 * k + 1 + w, n)
                        total += c[k] * told[lever + i] * told[lever + j]
                h[i * (n + 1) + j] = total
            h[i * (n + 1) + n] = load[i]
        pivots = np.empty(MOST_ROWS, np.int64)
        reduced_rows(n, n + 1, h, pivots)
        for i in range(n):
            q[i] = h[i * (n + 1) + n] if pivots[i] == 1 else 0.0
        part, fastest, least = 0.0, 0.0, NEVER_SLIPS
        for i in range(m):
            if c[i] > 0.0:
                u, v, lever = 0.0, 0.0, lever_of(3 * i + 1, n)
                for j in range(n):
                    u += told[lever + j] * q[j]
                    v += told[lever + n + j] * q[j]
                speed[i] = math.sqrt(u * u + v * v)
                part = max(part, c[i] * speed[i] / bound[i])
                fastest = max(fastest, speed[i])
        for i in range(m):
            found[i] = c[i] if part < lowest else found[i]
        lowest = min(lowest, part)
        for i in range(m):
            if c[i] > 0.0:
                if speed[i] > PIVOTS * fastest or c[i] * speed[i] > part * bound[i]:
                    least = min(least, c[i] * speed[i] / bound[i])
                slowest = LEAST_PART_OF_TURN / bound[i]
                before, next_ = 1.0 / c[i], max(speed[i] / (fastest * bound[i]), slowest)
                gain, gained = next_ - before, before - last[i]
                last[i] = before
                if turn % 3 == 2 and 0.0 < gain * gained < gained * gained:
                    # Aitken's sum of a geometric series
                    next_ = max(next_ + gain * gain / (gained - gain), slowest)
                c[i] = 1.0 / next_
        if part - least <= SAME_PART * part:
            break
    for i in range(m):
        c[i] = found[i]
    return lowest
