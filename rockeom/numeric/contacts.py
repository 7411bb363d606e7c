"""Passages between contact states that are found: which one follows is not declared.

Joined to the generated modules of structures whose contacts may open, slide and bounce, see
`rockeom.numeric.program`. There a contact state says of each point whether it is open, sticks or
slips to a side. Where one ends, all that may follow are tried: at a landing, those whose impulses
fit the velocities after them; then those whose forces fit the accelerations. What fits none, or
several that move differently, ends the motion.

Velocities and accelerations of a point are those of its gap (normal) and of its slip (tangential).
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from rockeom.contract import (
    AMBIGUOUS,
    IMPOSSIBLE,
    LANDING,
    LIFTING,
    OPEN,
    SLIPPING,
    STICK,
    STICKING,
    SWITCH,
)
from rockeom.marks import inlined

if TYPE_CHECKING:  # joined before this text
    from rockeom.numeric.joined import (
        ANGLES,
        CLOSED,
        ELEMENT_STATES,
        GUARDS,
        KINDS,
        N_ELEMENTS,
        N_GUARDS,
        N_PARTS,
        N_POINTS,
        N_STATES,
        POINT_STATES,
        ROTATION,
        SHARED,
        SUBJECTS,
        free_motion,
        guards,
        jump,
        point_laws,
        points,
        rates,
        shaking,
    )

N_COORDINATES = N_STATES // 2
POINT = 5 + N_STATES  # numbers that `points` tells of each: gap, its rate, that of the slip, ...
ROWS = 2 * N_POINTS  # the directions in which points are held: row 2 i is normal, 2 i + 1 along
GRAIN = 4e-15  # relative rounding error of a gap
LEAST_HOP = 1e-11  # relative to the terms of a gap: lower flights are summed up
FITS = 1e-11  # relative rounding error of what a candidate must fulfil
NEARLY = 1e-9  # and of forces and accelerations, by which an event's time may be off
SLOWEST = 1e4  # s: what is slower has no end of its bounces that needs to be found at once
ALIKE = 1e-7  # relative difference of accelerations that are the same but for the event's time
INSIDE = (  # weights of way, rates and accelerations at both ends, of a place and of its slope
    (0.5, 0.15625, -0.15625, 0.015625, 0.015625, 1.875, -0.4375, -0.4375, -0.03125, 0.03125),
    (
        459 / 512, 39 / 1024, -189 / 1024, 9 / 2048, 27 / 2048, 135 / 128, -95 / 256, 81 / 256,
        -21 / 512, -27 / 512,
    ),
)  # fmt: skip
SIGN_OF = (0.0, 0.0, 1.0, -1.0)  # by the state of a point
HALVES = (
    1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.00390625, 0.001953125,
    0.0009765625, 0.00048828125, 0.000244140625, 0.0001220703125, 6.103515625e-05,
    3.0517578125e-05, 1.52587890625e-05, 7.62939453125e-06, 3.814697265625e-06,
    1.9073486328125e-06, 9.5367431640625e-07, 4.76837158203125e-07, 2.384185791015625e-07,
    1.1920928955078125e-07, 5.960464477539063e-08, 2.9802322387695312e-08,
    1.4901161193847656e-08, 7.450580596923828e-09, 3.725290298461914e-09, 1.862645149230957e-09,
    9.313225746154785e-10, 4.656612873077393e-10,
)  # fmt: skip


def is_closed(touching, i):
    """Whether guard i is among those that are closed now: `touching` has a binary digit of each."""
    n = int(touching * HALVES[i])
    return touching > 0 and n - 2 * int(n * 0.5) == 1


# -- steps ---------------------------------------------------------------------------------------


@inlined
def longest_turn(y):
    """The longest step in which angles change so little that eight samples follow a gap."""
    fastest = 1e-300
    for i in range(N_COORDINATES):
        fastest = max(fastest, ANGLES[i] * abs(y[N_COORDINATES + i]))
    return 1.0 / fastest


def stays_within(contact, t, h, y, y_new, k, end, p, gx, gy, w, g, samples, sampled, touching):
    """Whether all guards of a contact state stay far from zero in a step.

    They are parabolas, all but a tenth, through four samples on the quintics through both ends, and
    above a quarter of their size. Those that are closed at the start, see `is_closed`, open as
    clearly.

    k : the rates at the start, and from `end` on those at the end. gx, gy : laws of the ground.
    samples (4 * guards,) : those of each guard. sampled : whether they are those of the step
    before, whose last are the first of this one.
    """
    for i in range(GUARDS[contact] if sampled else 0):
        samples[4 * i] = samples[4 * i + 3]
    for m in range(1 if sampled else 0, 4):
        if m == 1 or m == 2:
            between(h, m - 1, y, y_new, k, end, w)
        else:
            for i in range(N_STATES):
                w[i] = y[i] if m == 0 else y_new[i]
        tau = t + (0.5 * m if m < 2 else 0.25 * (m + 1)) * h
        guards(contact, w, p, shaking(gx, tau), shaking(gy, tau), g)
        for i in range(GUARDS[contact]):
            samples[4 * i + m] = g[i]
    for i in range(GUARDS[contact]):
        first, middle, later, last = (
            samples[4 * i],
            samples[4 * i + 1],
            samples[4 * i + 2],
            samples[4 * i + 3],
        )
        opens = is_closed(touching, i)
        first = 0.0 if opens else first
        bend = 2.0 * middle - 0.5 * (first + last)
        least = min(bend, last) if opens else min(first, min(bend, last))
        if not least > 0.25 * max(first, max(abs(bend), last)):
            return False
        most = 0.02 if opens else 0.1  # it must not turn the slope at the start, either
        if not abs(later - (0.0625 * first + 0.375 * bend + 0.5625 * last)) <= most * least:
            return False
    return True


def end_closed(contact, samples):
    """Whether a guard is closed at the end of a step, by the samples of `stays_within`."""
    closed = False
    for i in range(GUARDS[contact]):
        closed = closed or samples[4 * i + 3] < 0.0
    return closed


def between(h, place, y, y_new, k, end, w):
    """The state in the middle of a step, or at three quarters, on the quintics through both ends.

    place : the row of INSIDE. w (N,) : the state.
    """
    n, rate, hh = N_COORDINATES, 1.0 / h, h * h
    for i in range(n):
        way, v0, v1 = y_new[i] - y[i], h * y[n + i], h * y_new[n + i]
        a0, a1 = hh * k[n + i], hh * k[end + n + i]
        w[i] = y[i] + (
            INSIDE[place][0] * way + INSIDE[place][1] * v0 + INSIDE[place][2] * v1
            + INSIDE[place][3] * a0 + INSIDE[place][4] * a1
        )  # fmt: skip
        w[n + i] = rate * (
            INSIDE[place][5] * way + INSIDE[place][6] * v0 + INSIDE[place][7] * v1
            + INSIDE[place][8] * a0 + INSIDE[place][9] * a1
        )  # fmt: skip


def guard_noise(contact, index, y, p, b, stride):
    """Size of the rounding errors of a guard.

    Of a gap, by the terms whose difference it is; of a force, by how large forces are: b holds of
    each guard `stride` numbers, in a step or at an instant.
    """
    kind = KINDS[contact][index]
    if kind == LANDING:
        told = np.empty(POINT * N_POINTS)
        points(y, p, told)
        _, size = rate_of(told, 2 * SUBJECTS[contact][index], y, 0)
        return GRAIN * size
    if kind != LIFTING and kind != SLIPPING:
        return 0.0
    largest = 0.0
    for i in range(GUARDS[contact]):
        if KINDS[contact][i] == LIFTING or KINDS[contact][i] == SLIPPING:
            for j in range(stride * i, stride * i + stride):
                largest = max(largest, abs(b[j]))
    return 1e-13 * largest


# -- linear equations ----------------------------------------------------------------------------


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
        if best <= 1e-12 * largest:
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
            if i != n and factor != 0.0:
                for j in range(n, width):
                    a[i * width + j] -= factor * a[n * width + j]
    # back to the order of the unknowns
    found = np.empty(ROWS)
    for n in range(order):
        found[column[n]] = a[n * width + order] if n < rank else 0.0
    for n in range(order):
        a[n * width + order] = found[n]


def solved_at_once(a, order):
    """Whether it was one equation, or two that are far from saying the same: then they are solved.

    Most of those at an event are; arguments as of `eliminate`.
    """
    if order == 1:
        a[1] = a[1] / a[0] if a[0] != 0.0 else 0.0
        return True
    if order > 2:
        return False
    largest = max(max(abs(a[0]), abs(a[1])), max(abs(a[3]), abs(a[4])))
    determinant = a[0] * a[4] - a[1] * a[3]
    if not abs(determinant) > 1e-6 * largest * largest:
        return False
    inverse = 1.0 / determinant
    a[2], a[5] = (a[2] * a[4] - a[1] * a[5]) * inverse, (a[0] * a[5] - a[2] * a[3]) * inverse
    return True


def through_mass(matrix, b, width):
    """Solve M x = b in place, b (n, width), by Gauss without a search for pivots: M is positive.

    matrix (n, n) : M, which is kept. What has no inertia does not move.
    """
    n = N_COORDINATES
    a, inverse = np.empty(N_COORDINATES * N_COORDINATES), np.empty(N_COORDINATES)
    for i in range(n * n):
        a[i] = matrix[i]
    for i in range(n):
        pivot = a[i * n + i]
        inverse[i] = 1.0 / pivot if pivot > 1e-13 * matrix[i * n + i] else 0.0
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


def response_to_impulses(y, p, ax, ay, contact, told, spread, coupling):
    """What unit impulses at the points do: to the velocities, and to those of the points.

    told : of `points`. spread (n, ROWS) : M^-1 J'; coupling (ROWS, ROWS) : J M^-1 J'.
    Returns the inertia that the rotation has.
    """
    n = N_COORDINATES
    matrix, forces = np.empty(N_COORDINATES * N_COORDINATES), np.empty(N_COORDINATES)
    free_motion(y, p, ax, ay, contact, matrix, forces)
    for i in range(n):
        for r in range(N_POINTS):
            spread[i * ROWS + 2 * r] = told[r * POINT + 5 + i]
            spread[i * ROWS + 2 * r + 1] = told[r * POINT + 5 + n + i]
    through_mass(matrix, spread, ROWS)
    for r in range(ROWS):
        for s in range(r, ROWS):
            coupling[r * ROWS + s] = coupling[s * ROWS + r] = along(told, r, spread, s)
    return matrix[ROTATION * n + ROTATION]


@inlined
def along(told, row, spread, s):
    """J of a row times column s of `spread`."""
    start = row_of_point(row)
    total = 0.0
    for i in range(N_COORDINATES):
        total += told[start + i] * spread[i * ROWS + s]
    return total


@inlined
def row_of_point(row):
    """Where the Jacobian of a row begins in what `points` tells."""
    point = int(row * 0.5)
    return point * POINT + 5 + (row - 2 * point) * N_COORDINATES


def rate_of(told, row, y, first):
    """J of a row times y[first : first + n], and the sum of the terms' sizes."""
    start = row_of_point(row)
    total = size = 0.0
    for i in range(N_COORDINATES):
        term = told[start + i] * y[first + i]
        total += term
        size += abs(term)
    return total, size


@inlined
def acceleration_of(told, row, dy):
    """Of a gap or a slip, from the rates (N,) of the state."""
    total, _ = rate_of(told, row, dy, N_COORDINATES)
    point = int(row * 0.5)
    return total + told[point * POINT + 3 + row - 2 * point]


def put_on(rows, wanted, first, told, spread, coupling, y):
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
            a[r * width + s] = coupling[held[r] * ROWS + held[s]]
        a[r * width + order] = wanted[held[r]]
    eliminate(a, order, width)
    for i in range(N_COORDINATES):
        value, size = y[first + i], abs(y[first + i])
        for r in range(order):
            change = spread[i * ROWS + held[r]] * a[r * width + order]
            value += change
            size += abs(change)
        y[first + i] = value if abs(value) > 1e-14 * size else 0.0  # but for rounding


# -- candidates ----------------------------------------------------------------------------------


@inlined
def may_follow(candidate, contact, near, sliding):
    """Whether a contact state has the elements of another, and its points can be as it says.

    near (N_POINTS,) : 1 where a point touches. sliding (N_POINTS,) : the sign of its slip, 0 where
    it does not move.
    """
    for i in range(N_ELEMENTS):
        if ELEMENT_STATES[candidate][i] != ELEMENT_STATES[contact][i]:
            return False
    for i in range(N_POINTS):
        state = POINT_STATES[candidate][i]
        if state == OPEN:
            continue
        if near[i] == 0:
            return False
        if sliding[i] != 0.0 and SIGN_OF[state] != sliding[i]:
            return False
    return True


def impulses_of(candidate, wanted, laws, coupling, fractions, impulse):
    """The impulses with which points come to be as a contact state says, into impulse (ROWS,).

    wanted (ROWS,) : changes of the velocities where points are closed. fractions (N_POINTS,) :
    where sticking points share their friction, the part of the normal impulse that it is; not a
    number where it is to be found.
    """
    a, unknown = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    ties = np.empty(ROWS)  # of a normal impulse: friction in parts of it; of friction: none
    order = 0
    for i in range(N_POINTS):
        state, normal = POINT_STATES[candidate][i], 2 * i
        impulse[normal] = impulse[normal + 1] = 0.0
        if state == OPEN:
            continue
        unknown[order], ties[order] = normal, 0.0
        order += 1
        if state != STICK:
            ties[order - 1] = -laws[normal + 1] * SIGN_OF[state]
        elif fractions[i] == fractions[i]:
            ties[order - 1] = fractions[i]
        elif SHARED[candidate][i] == i:
            unknown[order], ties[order] = normal + 1, 0.0
            order += 1
    width = order + 1
    for m in range(order):
        row = unknown[m] * ROWS
        for s in range(order):
            value = coupling[row + unknown[s]]
            if ties[s] != 0.0:
                value += ties[s] * coupling[row + unknown[s] + 1]
            a[m * width + s] = value
        a[m * width + order] = wanted[unknown[m]]
    eliminate(a, order, width)
    for m in range(order):
        impulse[unknown[m]] = a[m * width + order]
        if ties[m] != 0.0:
            impulse[unknown[m] + 1] = ties[m] * a[m * width + order]


def impulses_fit(candidate, near, arriving, leaving, laws, impulse, sizes):
    """The least margin by which impulses fit; negative where they do not.

    They press, friction is within its bound, and all points leave as they may. A margin is relative
    to sizes (ROWS + N_POINTS,), the velocities and the normal impulses of the whole motion.
    """
    least = np.inf
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        state, normal = POINT_STATES[candidate][i], 2 * i
        if state == OPEN:
            opens = leaving[normal] + laws[normal] * min(arriving[normal], 0.0)
            least = min(least, opens / sizes[normal])
            continue
        least = min(least, impulse[normal] / sizes[ROWS + i])
        if state == STICK:
            along_, bound = 0.0, 0.0
            for j in range(N_POINTS):
                if POINT_STATES[candidate][j] == STICK and (
                    SHARED[candidate][j] == SHARED[candidate][i]
                ):
                    along_ += impulse[2 * j + 1]
                    bound += laws[2 * j + 1] * max(impulse[2 * j], 0.0)
            least = min(least, (bound - abs(along_)) / sizes[ROWS + i])
        else:
            least = min(least, SIGN_OF[state] * leaving[normal + 1] / sizes[normal + 1])
    return least


def collide(contact, near, y, p, laws, told, spread, coupling, out):
    """Velocities after all touching points have met, into out[n:].

    The law is the algebraic one: each closing gap opens at the rate e times that at which it
    closed, or faster where nothing presses; friction opposes the slip after the impact; all points
    at once. Returns a contact state of the impulses that fit, the best of those that lead to the
    same velocities, or IMPOSSIBLE, or AMBIGUOUS.
    """
    n = N_COORDINATES
    arriving, leaving, sizes = np.empty(ROWS), np.empty(ROWS), np.empty(ROWS + N_POINTS)
    impulse, after, apart = np.empty(ROWS), np.empty(N_COORDINATES), np.empty(N_COORDINATES)
    chosen, forces = np.empty(N_COORDINATES), np.empty(N_COORDINATES)
    matrix = np.empty(N_COORDINATES * N_COORDINATES)
    free_motion(y, p, 0.0, 0.0, contact, matrix, forces)
    fractions, wanted = np.empty(N_POINTS), np.empty(ROWS)
    sliding = np.zeros(N_POINTS)
    for i in range(n):
        apart[i] = y[n + i]
    whole = squared(matrix, apart)
    for r in range(ROWS):
        arriving[r], _ = rate_of(told, r, y, n)
        wanted[r] = -arriving[r]
        sizes[r] = math.sqrt(coupling[r * ROWS + r] * whole) + 1e-300
    for i in range(N_POINTS):
        wanted[2 * i] -= laws[2 * i] * min(arriving[2 * i], 0.0)
        sizes[ROWS + i] = math.sqrt(whole / coupling[2 * i * ROWS + 2 * i]) + 1e-300
    found, best = IMPOSSIBLE, -np.inf
    for candidate in range(len(POINT_STATES)):
        if not may_follow(candidate, contact, near, sliding):
            continue
        for i in range(N_POINTS):
            fractions[i] = np.nan
        impulses_of(candidate, wanted, laws, coupling, fractions, impulse)
        if share(candidate, told, impulse, fractions):
            impulses_of(candidate, wanted, laws, coupling, fractions, impulse)
        for r in range(ROWS):
            leaving[r] = arriving[r]
            for s in range(ROWS):
                leaving[r] += coupling[r * ROWS + s] * impulse[s]
        margin = impulses_fit(candidate, near, arriving, leaving, laws, impulse, sizes)
        if not margin >= -FITS:
            continue
        for i in range(n):
            value = y[n + i]
            for r in range(ROWS):
                value += spread[i * ROWS + r] * impulse[r]
            if found < 0:
                after[i] = value
            apart[i] = value - after[i]
        if squared(matrix, apart) > 1e-18 * whole:
            return AMBIGUOUS
        if margin > best:
            found, best = candidate, margin
            for i in range(n):
                chosen[i] = after[i] + apart[i]
    for i in range(n):
        out[n + i] = chosen[i] if found >= 0 else y[n + i]
    return found


def touching_points(contact, y, p, told, near, sliding):
    """Which points touch in a state, and the signs of their slips: near and sliding (N_POINTS,).

    told : of `points`, found here. A point that a contact state has closed does.
    """
    points(y, p, told)
    for i in range(N_POINTS):
        _, size = rate_of(told, 2 * i, y, 0)
        _, speed = rate_of(told, 2 * i, y, N_COORDINATES)
        slip, slips = rate_of(told, 2 * i + 1, y, N_COORDINATES)
        closed = told[i * POINT] <= 1e-9 * size and abs(told[i * POINT + 1]) <= 1e-9 * speed
        near[i] = 1 if closed or POINT_STATES[contact][i] != OPEN else 0
        sliding[i] = 0.0
        if near[i] == 1 and abs(slip) > 1e-9 * slips:
            sliding[i] = 1.0 if slip > 0.0 else -1.0


def fits_by_forces(contact, y, p, ax, ay):
    """The contact state that fits the forces in a state, or IMPOSSIBLE, or AMBIGUOUS.

    contact : that which the state's gaps and velocities tell of, with its elements.
    """
    told = np.empty(POINT * N_POINTS)
    spread, coupling = np.empty(N_COORDINATES * ROWS), np.empty(ROWS * ROWS)
    near, sliding = np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS)
    touching_points(contact, y, p, told, near, sliding)
    response_to_impulses(y, p, ax, ay, contact, told, spread, coupling)
    scales = np.empty(ROWS + N_POINTS)
    return go_on_as(
        contact, False, near, sliding, y, p, ax, ay, ax, ay, 1e-9, told, coupling, scales
    )


def share(candidate, told, force, fractions):
    """The fraction of friction of sticking points at different heights, which share their sum.

    Which of them gives it cannot be told of rigid bodies; all mobilise the same fraction of it, as
    they do when they slip. Returns whether there are such points.
    """
    found = False
    for i in range(N_POINTS):
        if POINT_STATES[candidate][i] != STICK or SHARED[candidate][i] == i:
            continue
        first = SHARED[candidate][i]
        apart = 0.0
        for j in range(N_COORDINATES):
            one, other = row_of_point(2 * i + 1) + j, row_of_point(2 * first + 1) + j
            apart = max(apart, abs(told[one] - told[other]))
        if apart > 1e-9:
            found = True
    if not found:
        return False
    for i in range(N_POINTS):
        if POINT_STATES[candidate][i] != STICK:
            continue
        tangential = normal = 0.0
        members = 0
        for j in range(N_POINTS):
            if POINT_STATES[candidate][j] == STICK and SHARED[candidate][j] == SHARED[candidate][i]:
                tangential += force[2 * j + 1]
                normal += force[2 * j]
                members += 1
        if members > 1 and normal != 0.0:
            fractions[i] = tangential / normal
    return True


def forces_fit(candidate, near, sliding, y, p, ax, ay, told, scales, dy, g):
    """The least margin by which forces and accelerations fit; negative where they do not.

    A margin is relative to scales, see `sizes_of`. dy (N,), g : rates and guards found.
    """
    rates(candidate, y, p, ax, ay, dy)
    guards(candidate, y, p, ax, ay, g)
    least = np.inf
    for i in range(GUARDS[candidate]):
        if KINDS[candidate][i] == LIFTING or KINDS[candidate][i] == SLIPPING:
            least = min(least, g[i] / scales[ROWS + SUBJECTS[candidate][i]])
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        state = POINT_STATES[candidate][i]
        if state == OPEN:
            least = min(least, acceleration_of(told, 2 * i, dy) / scales[2 * i])
        elif state != STICK and sliding[i] == 0.0:
            pushed = SIGN_OF[state] * acceleration_of(told, 2 * i + 1, dy)
            least = min(least, pushed / scales[2 * i + 1])
    return least


def go_on_as(
    contact, ends, near, sliding, y, p, ax, ay, later_x, later_y, tau, told, coupling, scales
):  # fmt: skip
    """The contact state whose forces and accelerations fit, or IMPOSSIBLE, or AMBIGUOUS.

    ends : whether `contact` has come to its end, so that it follows only where nothing else does.
    later_x, later_y : the ground's acceleration a time tau later, when the margins of those that
    move alike decide between them. scales (ROWS + N_POINTS,) : of `sizes_of`, found here.
    """
    n = N_COORDINATES
    dy, g, first = np.empty(N_STATES), np.empty(N_GUARDS + N_PARTS), np.empty(N_COORDINATES)
    w = np.empty(N_STATES)
    later, apart = np.empty(POINT * N_POINTS), np.empty(N_COORDINATES)
    matrix = np.empty(N_COORDINATES * N_COORDINATES)
    free = sizes_of(y, p, ax, ay, contact, coupling, matrix, scales)
    found, several = IMPOSSIBLE, 0
    fitting = np.empty(len(POINT_STATES), np.int64)  # the first `several` of it
    for candidate in range(len(POINT_STATES)):
        if not may_follow(candidate, contact, near, sliding):
            continue
        fit = forces_fit(candidate, near, sliding, y, p, ax, ay, told, scales, dy, g)
        if not fit >= -NEARLY:
            continue
        fitting[several] = candidate
        several += 1
        if found < 0:
            found = candidate
            for i in range(n):
                first[i] = dy[n + i]
            continue
        for i in range(n):
            apart[i] = dy[n + i] - first[i]
        if squared(matrix, apart) > ALIKE * ALIKE * free:
            return AMBIGUOUS
    if several == 0 or (several == 1 and not (ends and found == contact)):
        return found
    # of those that move alike now, what fits best a little later
    for i in range(n):
        w[i] = y[i] + tau * (y[n + i] + 0.5 * tau * first[i])
        w[n + i] = y[n + i] + tau * first[i]
    points(w, p, later)
    best = -np.inf
    for i in range(several):
        candidate = fitting[i]
        margin = forces_fit(candidate, near, sliding, w, p, later_x, later_y, later, scales, dy, g)
        if candidate == contact and ends:
            # what has come to its end goes on only where nothing but rounding errors ended it
            if several == 1 and margin < -FITS:
                return IMPOSSIBLE
            margin = np.inf if margin >= -FITS else -1e300
        # of those that fit as well, the one that keeps more points closed, which stands first
        if margin > best + FITS:
            found, best = candidate, margin
    return found


def sizes_of(y, p, ax, ay, contact, coupling, matrix, scales):
    """How large accelerations and forces are: those of the motion without contacts, squared.

    In the measure of the mass, see `squared`; with the ground at rest, too, so that they do not
    vanish with the weight. scales (ROWS + N_POINTS,) : of the accelerations of points, and of the
    normal forces.
    """
    n = N_COORDINATES
    forces, at_rest = np.empty(N_COORDINATES), np.empty(N_COORDINATES)
    both = np.empty(2 * N_COORDINATES)
    free_motion(y, p, ax, ay, contact, matrix, forces)
    free_motion(y, p, 0.0, 0.0, contact, matrix, at_rest)
    for i in range(n):
        both[2 * i], both[2 * i + 1] = forces[i], at_rest[i]
    through_mass(matrix, both, 2)
    moved = quiet = 0.0
    for i in range(n):
        moved += forces[i] * both[2 * i]
        quiet += at_rest[i] * both[2 * i + 1]
    free = max(moved, quiet)
    for r in range(ROWS):
        scales[r] = math.sqrt(coupling[r * ROWS + r] * free) + 1e-300
    for i in range(N_POINTS):
        scales[ROWS + i] = math.sqrt(free / coupling[2 * i * ROWS + 2 * i]) + 1e-300
    return free


def squared(matrix, x):
    total = 0.0
    for i in range(N_COORDINATES):
        for j in range(N_COORDINATES):
            total += x[i] * matrix[i * N_COORDINATES + j] * x[j]
    return total


# -- passages ------------------------------------------------------------------------------------


def pass_on(contact, guard, h, y, p, ax, ay, later_x, later_y, tau, out):
    """The end of a contact state by a guard: state after into out (N,).

    Returns the contact state that follows, or IMPOSSIBLE, or AMBIGUOUS, and which of its guards are
    closed, see `is_closed`.
    """
    for i in range(N_STATES):
        out[i] = y[i]
    kind, subject = KINDS[contact][guard], SUBJECTS[contact][guard]
    if kind == SWITCH:
        follows, touching = contact, -1
        if N_ELEMENTS > 0:
            follows = jump(contact, guard, 0, 0.0, y, p, out)
            if CLOSED[contact][guard] >= 0:
                touching = int(1.0 / HALVES[CLOSED[contact][guard]])
        return follows, touching
    told, laws = np.empty(POINT * N_POINTS), np.empty(ROWS)
    spread, coupling = np.empty(N_COORDINATES * ROWS), np.empty(ROWS * ROWS)
    near, rows = np.zeros(N_POINTS, np.int64), np.zeros(ROWS, np.int64)
    wanted = np.zeros(ROWS)
    points(out, p, told)
    point_laws(p, laws)
    response_to_impulses(out, p, ax, ay, contact, told, spread, coupling)
    # -- which points touch: they are put on what they touch
    for i in range(N_POINTS):
        closed = POINT_STATES[contact][i] != OPEN or (kind == LANDING and i == subject)
        if not closed and kind == LANDING:
            gap, rate = told[i * POINT], told[i * POINT + 1]
            _, size = rate_of(told, 2 * i, out, 0)
            closed = rate <= 0.0 and gap <= 1e-9 * h * abs(rate) + 1e-13 * size
        if closed:
            near[i] = 1
            rows[2 * i], wanted[2 * i] = 1, -told[i * POINT]
    put_on(rows, wanted, 0, told, spread, coupling, out)
    return meet(
        contact, guard, kind, near, y, p, ax, ay, later_x, later_y, tau, told, laws, spread,
        coupling, out,
    )  # fmt: skip


def meet(
    contact, guard, kind, near, y, p, ax, ay, later_x, later_y, tau, told, laws, spread, coupling,
    out,
):  # fmt: skip
    """What follows where the points of near (N_POINTS,) touch: velocities, and the contact state.

    out (N,) : the state, at first that before. Returns as `pass_on`.
    """
    n, subject = N_COORDINATES, SUBJECTS[contact][guard]
    rows, wanted, sliding = np.zeros(ROWS, np.int64), np.zeros(ROWS), np.zeros(N_POINTS)
    for i in range(N_POINTS):
        rows[2 * i] = near[i]
    points(out, p, told)
    # -- which of them move along, or leave
    as_said = contact  # by the velocities of this contact state
    if kind == LANDING:
        as_said = collide(contact, near, out, p, laws, told, spread, coupling, out)
        if as_said < 0:
            return as_said, -1
    points(out, p, told)
    leaving = np.zeros(N_POINTS, np.int64)
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        state = POINT_STATES[as_said][i]
        rate, size = rate_of(told, 2 * i, out, n)
        _before, size_before = rate_of(told, 2 * i, y, n)
        leaves = rate > FITS * max(size, size_before)
        if leaves and (state == OPEN or laws[2 * i] > 0.0) and kind == LANDING:
            leaving[i], near[i] = 1, 0
            rows[2 * i] = 0
            continue
        wanted[2 * i] = -rate
        slip, size = rate_of(told, 2 * i + 1, out, n)
        still = state == STICK or abs(slip) <= FITS * size
        if kind == STICKING and SHARED[contact][i] == SHARED[contact][subject]:
            still = True
        if still:
            rows[2 * i + 1], wanted[2 * i + 1] = 1, -slip
        else:
            sliding[i] = 1.0 if slip > 0.0 else -1.0
    put_on(rows, wanted, n, told, spread, coupling, out)
    points(out, p, told)
    ends = kind in (LIFTING, SLIPPING)
    scales = np.empty(ROWS + N_POINTS)
    follows = go_on_as(
        contact, ends, near, sliding, out, p, ax, ay, later_x, later_y, tau, told, coupling, scales
    )
    if follows < 0:
        return follows, -1
    return follows, closed_guards(
        follows, contact, guard, near, leaving, sliding, out, p, ax, ay, scales
    )


def closed_guards(follows, contact, guard, near, leaving, sliding, y, p, ax, ay, scales):
    """Which guards of a contact state are zero as it begins, see `is_closed`; -1 for none."""
    g = np.empty(N_GUARDS + N_PARTS)
    guards(follows, y, p, ax, ay, g)
    touching = 0
    for i in range(GUARDS[follows]):
        kind, subject = KINDS[follows][i], SUBJECTS[follows][i]
        closed = follows == contact and i == guard and kind != LANDING
        if kind == LANDING:
            closed = near[subject] == 1 or leaving[subject] == 1
        elif kind == STICKING:
            closed = sliding[subject] == 0.0
        elif kind in (LIFTING, SLIPPING):
            closed = closed or abs(g[i]) <= NEARLY * scales[ROWS + subject]
        if closed:
            touching += int(1.0 / HALVES[i])
    return touching if touching > 0 else -1


def nothing_moves(contact, y, p):
    """Whether no acceleration of the ground moves anything in a contact state, in a state at rest.

    Accelerations are sums of a part of each of the ground's, and of none: two are tried at once.
    """
    dy = np.empty(N_STATES)
    rates(contact, y, p, 1.0, 0.7, dy)
    moves = False
    for i in range(N_STATES):
        moves = moves or dy[i] != 0.0
    return not moves


def held_upright(contact, y, p):
    """Whether points are closed that keep the structure from turning."""
    if y[ROTATION + N_COORDINATES] != 0.0:
        return False
    dy = np.empty(N_STATES)
    rates(contact, y, p, 0.0, 0.0, dy)
    held = False
    for i in range(N_POINTS):
        held = held or POINT_STATES[contact][i] != OPEN
    return held and dy[ROTATION + N_COORDINATES] == 0.0


# -- infinitely many impacts ---------------------------------------------------------------------


def time_of_bounces(contact, y, p, ax, ay, tolerance, out):
    """(time, contact): when the infinitely many impacts to come will all have happened.

    From a landing after which points leave what they touched: close to the end flights are
    parabolas, each from the rates of the state in which it begins, and the impacts between are
    those of any landing. They are followed until their times are a geometric series to the last
    digits, whose rest is summed. out (N,) : the state then, all these points closed.
    Returns (inf, contact) while the time is longer than `tolerance` times sqrt(l/a), a the
    acceleration that closes the gap and l the radius of gyration.
    """
    n = N_COORDINATES
    told, laws = np.empty(POINT * N_POINTS), np.empty(ROWS)
    spread, coupling = np.empty(N_COORDINATES * ROWS), np.empty(ROWS * ROWS)
    dy, w = np.empty(N_STATES), np.empty(N_STATES)
    bouncing = np.zeros(N_POINTS, np.int64)
    points(y, p, told)
    for i in range(N_STATES):
        w[i] = y[i]
    rates(contact, w, p, ax, ay, dy)
    point_laws(p, laws)
    limit = np.inf
    lost = True
    inertia = longest = start = 0.0
    for i in range(N_POINTS):
        gap, rate = told[i * POINT], told[i * POINT + 1]
        _, size = rate_of(told, 2 * i, y, 0)
        if POINT_STATES[contact][i] != OPEN or gap > GRAIN * size or rate <= 0.0:
            continue
        a = -acceleration_of(told, 2 * i, dy)
        if not a > 0.0:
            return np.inf, contact
        bouncing[i] = 1
        if 2.0 * rate / a > tolerance * SLOWEST:
            return np.inf, contact
        if start == 0.0:
            inertia = response_to_impulses(y, p, ax, ay, contact, told, spread, coupling)
        start = max(start, rate)
        longest = max(longest, 2.0 * rate / a)
        radius = math.sqrt(inertia * coupling[2 * i * ROWS + 2 * i])
        limit = min(limit, tolerance * math.sqrt(radius / a))
        lost = lost and 0.5 * rate * rate < LEAST_HOP * size * a
    if lost:
        limit = SLOWEST * longest  # flights so low end among rounding errors
    if start == 0.0 or longest > limit:
        return np.inf, contact
    # counted by themselves: they are lost among the last digits of a state
    heights = np.zeros(N_POINTS)
    for i in range(N_POINTS):
        # others that are in flight, and land as soon
        gap, rate = told[i * POINT], told[i * POINT + 1]
        if POINT_STATES[contact][i] == OPEN and bouncing[i] == 0:
            a = -acceleration_of(told, 2 * i, dy)
            if a > 0.0 and rate + math.sqrt(rate * rate + 2.0 * a * gap) <= limit * a:
                bouncing[i], heights[i] = 1, gap
    near, met = np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS, np.int64)
    total = flight = before = last = 0.0
    here = contact
    for _turn in range(4000):
        # the next landing of those that bounce
        points(w, p, told)
        rates(here, w, p, ax, ay, dy)
        flight, which, fastest, whole = np.inf, -1, 0.0, 0.0
        for i in range(N_POINTS):
            if bouncing[i] == 0 or POINT_STATES[here][i] != OPEN:
                continue
            rate = told[i * POINT + 1]
            a = -acceleration_of(told, 2 * i, dy)
            if not a > 0.0:
                return np.inf, contact
            lasts = (rate + math.sqrt(rate * rate + 2.0 * a * heights[i])) / a
            fastest = max(fastest, rate)
            if lasts < flight:
                flight, which = lasts, i
        if which < 0:
            break
        for i in range(N_POINTS):
            _, speed = rate_of(told, 2 * i, w, n)
            whole = max(whole, speed)
        if fastest <= max(1e-7 * start, 1e-8 * whole):  # behind that are the digits of the others
            break
        if total + flight > limit:
            # where the last flights were nothing, some have come to their end and others fly on
            if not last < 1e-6 * total:
                return np.inf, contact
            ended = False
            for i in range(N_POINTS):
                if bouncing[i] == 1 and POINT_STATES[here][i] == OPEN:
                    bouncing[i] = 0
                else:
                    ended = ended or bouncing[i] == 1
            if not ended:
                return np.inf, contact
            break
        before, last = last, flight
        total += flight
        for i in range(N_POINTS):
            near[i] = 1 if POINT_STATES[here][i] != OPEN else 0
            if bouncing[i] == 1 and near[i] == 0:
                rise = told[i * POINT + 1] * flight
                drop = -0.5 * acceleration_of(told, 2 * i, dy) * flight * flight
                heights[i] += rise - drop
                if i == which or heights[i] <= 1e-9 * drop:
                    heights[i], near[i] = 0.0, 1
            met[i] = near[i]
        for i in range(n):
            w[i] += flight * (w[n + i] + 0.5 * flight * dy[n + i])
            w[n + i] += flight * dy[n + i]
        guard = -1
        for i in range(GUARDS[here]):
            if KINDS[here][i] == LANDING and SUBJECTS[here][i] == which:
                guard = i
        for i in range(N_STATES):
            out[i] = w[i]
        here, _ = meet(
            here, guard, LANDING, near, w, p, ax, ay, ax, ay, 1e-3 * flight, told, laws, spread,
            coupling, out,
        )  # fmt: skip
        if here < 0:
            return np.inf, contact
        for i in range(n, N_STATES):
            w[i] = out[i]
        points(w, p, told)
        for i in range(N_POINTS):
            if met[i] == 1 and POINT_STATES[here][i] == OPEN and told[i * POINT + 1] > 0.0:
                bouncing[i] = 1
    if last > 0.0 and before > last:
        total += last * last / (before - last)
    # all of them closed: what follows then
    rows, wanted, sliding = np.zeros(ROWS, np.int64), np.zeros(ROWS), np.zeros(N_POINTS)
    for i in range(N_STATES):
        out[i] = w[i]
    points(out, p, told)
    response_to_impulses(out, p, ax, ay, here, told, spread, coupling)
    for i in range(N_POINTS):
        closed = bouncing[i] == 1 or POINT_STATES[here][i] != OPEN
        near[i] = 1 if closed else 0
        if closed:
            rows[2 * i], wanted[2 * i] = 1, -told[i * POINT]
    put_on(rows, wanted, 0, told, spread, coupling, out)
    points(out, p, told)
    for i in range(N_POINTS):
        if near[i] == 0 and told[i * POINT] <= 0.0 and told[i * POINT + 1] <= 0.0:
            return np.inf, contact  # it landed before
        if near[i] == 0:
            continue
        wanted[2 * i] = -told[i * POINT + 1]
        slip, size = rate_of(told, 2 * i + 1, out, n)
        sticks = POINT_STATES[here][i] == STICK
        if sticks or abs(slip) <= start + FITS * size:  # so slow a slip has ended, too
            rows[2 * i + 1], wanted[2 * i + 1] = 1, -slip
        else:
            sliding[i] = 1.0 if slip > 0.0 else -1.0
    response_to_impulses(out, p, ax, ay, here, told, spread, coupling)
    put_on(rows, wanted, n, told, spread, coupling, out)
    points(out, p, told)
    scales = np.empty(ROWS + N_POINTS)
    follows = go_on_as(
        here, False, near, sliding, out, p, ax, ay, ax, ay, 1e-6, told, coupling, scales
    )
    if follows < 0:
        return np.inf, contact
    for i in range(N_POINTS):
        if bouncing[i] == 1 and POINT_STATES[follows][i] == OPEN:
            return np.inf, contact
    return total, follows
