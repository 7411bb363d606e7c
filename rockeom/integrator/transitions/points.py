"""Points that may touch something: gaps, slips and their rates, and how impulses change them.

Velocities and accelerations of a point are those of its gap (normal) and of its slip (tangential).
"""

import math

import numpy as np

from rockeom.codes import MOST_DIGITS
from rockeom.compiler.decorators import inlined, rolled
from rockeom.integrator.provided import (
    DIRECTIONS,
    N_GUARDS,
    N_PARTS,
    N_POINTS,
    N_STATES,
    STILL,
    free_motion,
    point_laws,
    points,
)
from rockeom.integrator.tolerances import (
    GRAIN,
    INDEPENDENT,
    INDEPENDENT_OF_THREE,
    MASSLESS,
    NONE_OF_SUM,
    PIVOT,
)

__fused__ = False

N_COORDINATES = N_STATES // 2
BIASES = 1 + DIRECTIONS  # behind the gap of a point and the rates of gap and slips: their biases
LEVERS = BIASES + DIRECTIONS  # and the rows by which they follow from the velocities
POINT = LEVERS + DIRECTIONS * N_COORDINATES
N_MATRIX = N_COORDINATES * N_COORDINATES
ROW = N_GUARDS + N_PARTS  # what `guards` fills
ROWS = DIRECTIONS * N_POINTS  # in which points are held: DIRECTIONS * i is normal

# Places in `contact` (CONTACT_SIZE,), the data of the points in a state: what `points` tells, the
# laws of `point_laws`, M (n, n), M^-1 J' (n, ROWS), and J M^-1 J' (ROWS, ROWS)
LAWS = POINT * N_POINTS
MATRIX = LAWS + 2 * N_POINTS
SPREAD = MATRIX + N_MATRIX
COUPLING = SPREAD + N_COORDINATES * ROWS
CONTACT_SIZE = COUPLING + ROWS * ROWS

HALVES = 0.5 ** np.arange(1.0 * MOST_DIGITS)


@inlined
def is_closed(closed, i):
    """Whether guard i is among those that are closed now: `closed` has a binary digit of each."""
    n = int(closed * HALVES[i])
    return closed > 0 and n - 2 * int(n * 0.5) == 1


# -- linear equations ----------------------------------------------------------------------------


@rolled
def eliminate(a, order, width):
    """Solve a x = b in place, by Gauss and Jordan with complete pivoting; b stands behind a.

    a (order, width) row by row, of which the first `order` columns are the matrix; order is at most
    ROWS, width one more. Unknowns that the equations do not determine are zero.
    """
    if order == 0 or solved_at_once(a, order):
        return
    column = np.empty(ROWS, np.int64)
    for i in range(order):
        column[i] = i
    largest = 0.0
    for i in range(order):
        for j in range(order):
            largest = max(largest, abs(a[i * width + j]))
    rank = order
    for n in range(order):
        best, row, col = 0.0, n, n
        for i in range(n, order):
            for j in range(n, order):
                if abs(a[i * width + j]) > best:
                    best, row, col = abs(a[i * width + j]), i, j
        if best <= PIVOT * largest:
            rank = n
            break
        if row != n:
            for j in range(n, width):
                swapped = a[n * width + j]
                a[n * width + j] = a[row * width + j]
                a[row * width + j] = swapped
        if col != n:
            for i in range(order):
                swapped = a[i * width + n]
                a[i * width + n] = a[i * width + col]
                a[i * width + col] = swapped
            kept = column[n]
            column[n] = column[col]
            column[col] = kept
        pivot = 1.0 / a[n * width + n]
        for j in range(n, width):
            a[n * width + j] *= pivot
        for i in range(order):
            factor = a[i * width + n]
            if i != n:
                for j in range(n, width):
                    a[i * width + j] -= factor * a[n * width + j]
    # back to the order of the unknowns
    solution = np.empty(ROWS)
    for n in range(order):
        solution[column[n]] = a[n * width + order] if n < rank else 0.0
    for n in range(order):
        a[n * width + order] = solution[n]


def solved_at_once(a, order):
    """Whether it was one equation, or two or three that are far from saying the same: solved then.

    Most of those at an event are; arguments as of `eliminate`.
    """
    if order == 1:
        a[1] = a[1] / a[0] if a[0] != 0.0 else 0.0
        return True
    if order == 2:
        largest = max(max(abs(a[0]), abs(a[1])), max(abs(a[3]), abs(a[4])))
        determinant = a[0] * a[4] - a[1] * a[3]
        if not abs(determinant) > INDEPENDENT * largest * largest:
            return False
        inverse = 1.0 / determinant
        a[2], a[5] = (a[2] * a[4] - a[1] * a[5]) * inverse, (a[0] * a[5] - a[2] * a[3]) * inverse
        return True
    if order > 3:
        return False
    # by the crosswise products of the last two rows, and of each with the right-hand side
    c0, c1, c2 = a[5] * a[10] - a[6] * a[9], a[6] * a[8] - a[4] * a[10], a[4] * a[9] - a[5] * a[8]
    largest = 0.0
    for i in range(3):
        for j in range(3):
            largest = max(largest, abs(a[4 * i + j]))
    determinant = a[0] * c0 + a[1] * c1 + a[2] * c2
    if not abs(determinant) > INDEPENDENT_OF_THREE * largest * largest * largest:
        return False
    inverse = 1.0 / determinant
    d0, d1, d2 = a[7] * a[8] - a[4] * a[11], a[7] * a[9] - a[5] * a[11], a[7] * a[10] - a[6] * a[11]
    x = a[3] * c0 - a[1] * d2 + a[2] * d1
    y = a[3] * c1 + a[0] * d2 - a[2] * d0
    z = a[3] * c2 - a[0] * d1 + a[1] * d0
    a[3], a[7], a[11] = x * inverse, y * inverse, z * inverse
    return True


@rolled
def through_mass(matrix, b, width):
    """Solve M x = b in place, b (n, width), by Gauss without a search for pivots: M is positive.

    matrix (n, n) : M, which is kept. Coordinates without inertia do not move.
    """
    n = N_COORDINATES
    a, inverse = np.empty(N_MATRIX), np.empty(N_COORDINATES)
    for i in range(n * n):
        a[i] = matrix[i]
    for i in range(n):
        pivot = a[i * n + i]
        inverse[i] = 1.0 / pivot if pivot > MASSLESS * matrix[i * n + i] else 0.0
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


@rolled
def contact_data(y, p, mode, contact):
    """Places and rates of the points in a state, and effects of impulses, into `contact`.

    All but what `points` tells follows from the places alone.
    """
    forces = np.empty(N_COORDINATES)
    points(y, p, contact)
    point_laws(p, contact[LAWS:])
    free_motion(y, p, *STILL, mode, contact[MATRIX:], forces)
    couple(contact)


@rolled
def couple(contact):
    """The effects of impulses in `contact`, from the rows of its points and its matrix M."""
    n = N_COORDINATES
    matrix, spread, coupling = contact[MATRIX:], contact[SPREAD:], contact[COUPLING:]
    for i in range(n):
        for r in range(N_POINTS):
            for axis in range(DIRECTIONS):
                lever = r * POINT + LEVERS + axis * n
                spread[i * ROWS + DIRECTIONS * r + axis] = contact[lever + i]
    through_mass(matrix, spread, ROWS)
    for r in range(ROWS):
        for s in range(r, ROWS):
            coupling[r * ROWS + s] = coupling[s * ROWS + r] = along(contact, r, spread, s, ROWS)


@inlined
def along(contact, row, b, s, width):
    """J of a row times column s of b (n, width)."""
    start = row_of_point(row)
    total = 0.0
    for i in range(N_COORDINATES):
        total += contact[start + i] * b[i * width + s]
    return total


@inlined
def exceeds(row, wanted, contact, impulse):
    """The excess of the change of velocity of a row by impulses over the one wanted."""
    total = -wanted[row]
    for s in range(ROWS):
        total += contact[COUPLING + row * ROWS + s] * impulse[s]
    return total


@inlined
def row_of_point(row):
    """Where the Jacobian of a row begins in what `points` tells."""
    point = int(row / DIRECTIONS)
    return point * POINT + LEVERS + (row - DIRECTIONS * point) * N_COORDINATES


def rate_of(contact, row, y, first):
    """J of a row times y[first : first + n], and the sum of the terms' sizes."""
    start = row_of_point(row)
    total = size = 0.0
    for i in range(N_COORDINATES):
        term = contact[start + i] * y[first + i]
        total += term
        size += abs(term)
    return total, size


def slip_of(contact, point, y, first):
    """The slip of a point by y[first : first + n], in space its size, and the size of its terms."""
    slip, size = rate_of(contact, DIRECTIONS * point + 1, y, first)
    if DIRECTIONS == 3:
        other, larger = rate_of(contact, DIRECTIONS * point + 2, y, first)
        slip, size = math.sqrt(slip * slip + other * other), max(size, larger)
    return slip, size


def hold_slip(contact, point, y, rows, wanted):
    """Let rows (ROWS,) hold a point along the ground, by the change of its velocity in `wanted`."""
    for row in range(DIRECTIONS * point + 1, DIRECTIONS * point + DIRECTIONS):
        slip, _ = rate_of(contact, row, y, N_COORDINATES)
        rows[row], wanted[row] = 1, -slip


def gap_rounding(contact, y):
    """The rounding error of a gap where other points are closed: by the largest terms of any."""
    largest = 0.0
    for i in range(N_POINTS):
        _, size = rate_of(contact, DIRECTIONS * i, y, 0)
        largest = max(largest, size)
    return GRAIN * largest


@inlined
def acceleration_of(contact, row, dy):
    """The acceleration of a gap or a slip, from the rates (N,) of the state."""
    total, _ = rate_of(contact, row, dy, N_COORDINATES)
    point = int(row / DIRECTIONS)
    return total + contact[point * POINT + BIASES + row - DIRECTIONS * point]


@inlined
def but_for_rounding(sum_, size):
    """A sum, zero where nothing but rounding errors is left of its terms."""
    return sum_ if abs(sum_) > NONE_OF_SUM * size else 0.0


@rolled
def put_on(rows, wanted, first, contact, y):
    """Change y[first : first + n] the least, in the measure of the mass, so that J y = wanted.

    rows (ROWS,) : 1 where a row is held.
    """
    a, held = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    order = 0
    for r in range(ROWS):
        if rows[r] == 1:
            held[order] = r
            order += 1
    width = order + 1
    for r in range(order):
        for s in range(order):
            a[r * width + s] = contact[COUPLING + held[r] * ROWS + held[s]]
        a[r * width + order] = wanted[held[r]]
    eliminate(a, order, width)
    for i in range(N_COORDINATES):
        value, size = y[first + i], abs(y[first + i])
        for r in range(order):
            change = contact[SPREAD + i * ROWS + held[r]] * a[r * width + order]
            value += change
            size += abs(change)
        y[first + i] = but_for_rounding(value, size)
