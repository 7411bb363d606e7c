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
WEDGE = 2.414213562373095  # tangent of the angle to its axis at which a slip has turned: 67.5 deg
MOST_PART = 1e100  # of its friction that a guard counts
LEAST_SLIP = 1e-10  # [m/s] at which a slip has ended: a slower one turns faster than steps follow
MOST_SHARES = 60  # of the iteration for the least friction
SAME_PART = 1e-13  # of it, that all points use: it has come to its end
PIVOTS = 1e-5  # of the fastest: points that are slower are those about which others turn
LEAST_PART_OF_TURN = 1e-6  # of the fastest: the velocity of a point about which others turn


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


def rows_of_mode(mode, m, smooth, row):
    """(normal, held, all): how many rows a mode holds, and with those of idle points, into row.

    row (3 m,) : row 3 i is that of the gap of point i, those of its slips follow. Gaps of points
    that bear come first, then slips of those that stick, and last gaps of idle points.
    """
    held = 0
    for i in range(m):
        digit = digit_of(mode, i)
        if digit != OPEN and digit != IDLES:
            row[held] = 3 * i
            held += 1
    normal = held
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
    return normal, held, every


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
def reduced_rows(k, width, a, pivots):
    """How many of k rows of a symmetric matrix are independent: those whose pivots (k,) are 1.

    a (k, width) row by row : by Gauss and Jordan with pivots on the diagonal. The columns of the
    others, in the rows of the independent ones, are then F, by which their rows follow.
    """
    rank, largest = 0, 0.0
    for i in range(k):
        pivots[i] = 0
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
    return rank


@inlined
def weight_of(a, width, pivots, k, i, j):
    """By how much the independent row i enters row j, of k rows and others."""
    own = 1.0 if i == j else 0.0
    return own if j < k and pivots[j] == 1 else a[i * width + j]


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
    width = k + others + 1
    pivots = np.empty(MOST_ROWS, np.int64)
    rank = reduced_rows(k, width, a, pivots)
    if rank < k:
        spread_load(k, width, pivots, a)
    for j in range(k + others):
        share[j] = 0.0
        for i in range(k):
            if pivots[i] == 1:
                weight = weight_of(a, width, pivots, k, i, j)
                share[j] += weight * a[i * width + width - 1]
    return rank


@rolled
def share_load_with_slips(normal, k, others, a, share):
    """`share_load` where some of the `normal` first rows are of points that slip.

    a : behind the columns of all rows and the right-hand side, once more the columns of the rows of
    gaps, first of those that bear, as they are without friction: a (k, k + others + 1 + normal +
    others). The normal forces are linear in the place of a point, too.
    """
    width, last = k + others + 1 + normal + others, k + others
    across, spans = normal + others, k - normal
    g, h = np.empty(MOST_ROWS * MOST_ROWS), np.empty(MOST_ROWS * MOST_ROWS)
    pivots, stuck = np.empty(MOST_ROWS, np.int64), np.empty(MOST_ROWS, np.int64)
    for i in range(normal):
        for j in range(across):
            g[i * across + j] = a[i * width + last + 1 + j]
    for i in range(spans):
        for j in range(spans):
            h[i * spans + j] = a[(normal + i) * width + normal + j]
    reduced_rows(normal, across, g, pivots)
    reduced_rows(spans, spans, h, stuck)
    row, order = np.empty(MOST_ROWS, np.int64), 0
    for i in range(k):
        if (pivots[i] if i < normal else stuck[i - normal]) == 1:
            row[order] = i
            order += 1
    size = order + 1
    b = np.empty(MOST_ROWS * (MOST_ROWS + 1))
    for r in range(order):
        for s in range(order):
            total = 0.0
            if row[s] >= normal:
                total = a[row[r] * width + row[s]]
            else:
                for i in range(normal):
                    weight = weight_of(g, across, pivots, normal, row[s], i)
                    total += weight * a[row[r] * width + i]
            b[r * size + s] = total
        b[r * size + order] = a[row[r] * width + last]
    solve_by_rows(order, b)
    for j in range(k + others):
        share[j] = 0.0
    for r in range(order):
        force = b[r * size + order]
        if row[r] >= normal:
            share[row[r]] = force
        else:
            for j in range(across):
                weight = weight_of(g, across, pivots, normal, row[r], j)
                share[j if j < normal else k + j - normal] += weight * force


@rolled
def solve_by_rows(order, b):
    """Solve b (order, order + 1) in place by Gauss and Jordan; the solution in its last column."""
    size = order + 1
    for n in range(order):
        best = n
        for i in range(n + 1, order):
            if abs(b[i * size + n]) > abs(b[best * size + n]):
                best = i
        for j in range(size):
            b[n * size + j], b[best * size + j] = b[best * size + j], b[n * size + j]
        inverse = 1.0 / b[n * size + n] if b[n * size + n] != 0.0 else 0.0
        for j in range(size):
            b[n * size + j] *= inverse
        for i in range(order):
            factor = b[i * size + n]
            if i != n:
                for j in range(size):
                    b[i * size + j] -= factor * b[n * size + j]


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
def motion_in_code(mode, n, m, smooth, matrix, forces, told, laws, accelerations, share):
    """Accelerations (n,) in a mode, and the forces at each point: normal, along x and y, (3 m,).

    matrix (n, n), forces (n,) : of `free_motion`. told : of `points`. laws (2 m,) : restitution and
    friction of each. share : zero of a point that is open; of an idle one what it would bear,
    negative as long as it is idle.
    """
    row, along = np.empty(MOST_ROWS, np.int64), np.empty(2 * MOST_POINTS_IN_SPACE)
    normal, held, every = rows_of_mode(mode, m, smooth, row)
    slipping = slips_in(mode, m)
    if slipping:
        directions_of_slips(mode, n, m, told, along)
    for r in range(3 * m):
        share[r] = 0.0
    again = normal + every - held if slipping else 0  # columns of gaps once more, without friction
    b = np.empty(MOST_COORDINATES * (MOST_ROWS + 1 + MOST_POINTS_IN_SPACE))
    scratch, inverse = np.empty(MOST_COORDINATES * MOST_COORDINATES), np.empty(MOST_COORDINATES)
    columns = 1 + held + again
    for i in range(n):
        b[i * columns] = forces[i]
    for r in range(held + again):
        of = row[r] if r < held else row[r - held if r - held < normal else r - normal]
        lever, point = lever_of(of, n), int(of / 3)
        ties = slipping and r < normal and slips_by(digit_of(mode, point))
        for i in range(n):
            value = told[lever + i]
            if ties:
                rubs = along[2 * point] * told[lever + n + i]
                rubs += along[2 * point + 1] * told[lever + 2 * n + i]
                value -= laws[2 * point + 1] * rubs
            b[i * columns + 1 + r] = value
    solve_through_mass(n, matrix, b, columns, scratch, inverse, MASSLESS_IN_SPACE)
    if held > 0:
        a, found = np.empty(MOST_ROWS * (2 * MOST_ROWS + 1)), np.empty(MOST_ROWS)
        width = every + 1 + again
        for r in range(held):
            for s in range(width):
                # of M^-1 J' with friction; by symmetry of idle points; then the free accelerations
                lever, column = lever_of(row[r], n), s + 1
                if held <= s < every:
                    lever, column = lever_of(row[s], n), r + 1
                elif s == every:
                    column = 0
                elif s > every:
                    column = held + s - every
                total = 0.0
                for i in range(n):
                    total += told[lever + i] * b[i * columns + column]
                a[r * width + s] = total
            a[r * width + every] = -a[r * width + every] - told[bias_of(row[r], n)]
        if slipping:
            share_load_with_slips(normal, held, every - held, a, found)
        else:
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
    add_friction(mode, m, laws, along, share)


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


@inlined
def bias_of(row, n):
    """Where the bias of a row stands in what `points` tells."""
    point = int(row / 3)
    return point * (FIRST_LEVER + 3 * n) + FIRST_BIAS + row - 3 * point


def guards_in_code(mode, n, m, smooth, told, laws, share, g):
    """Guards of the points of a mode into g: m gaps, or what points bear, or would not; then 2 m of
    slips and of sticking, where a point has friction that is not endless.
    """
    pressing = 0.0
    for i in range(m):
        digit = digit_of(mode, i)
        g[i] = share[3 * i]
        if digit == OPEN:
            g[i] = told[i * (FIRST_LEVER + 3 * n)]
        elif digit == IDLES:
            g[i] = -share[3 * i]
        elif digit == BEARS and rubs_by(smooth, laws, i):
            pressing += laws[2 * i + 1] * max(share[3 * i], 0.0)
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
            part = least_friction(mode, n, m, smooth, told, laws, share, dampers)
            square = min(part, MOST_PART) ** 2
            g[m + i] = pressing * (1.0 - square) / (1.0 + square)  # finite where a load vanishes
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
def least_friction(mode, n, m, smooth, told, laws, share, c):
    """The least part of their friction that points which stick must use, in some share of it.

    Rigid bodies leave open how they share forces along the ground. The least of the largest parts
    |T|/(mu N) is reached where all points use the same part of theirs, along the velocities v = J q
    of some motion q, but for those about which it turns: T = c v with c = mu N/|v|, times the part.
    Such c (m,) are found from the forces in `share`.
    """
    load, bound = np.zeros(MOST_COORDINATES), np.zeros(MOST_POINTS_IN_SPACE)
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
    if most > 0.0:
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
