"""Points that meet in an impact, and the forces that fit at an instant of it, by Coulomb's law."""

from typing import NamedTuple

import numpy as np

from rockeom.codes import NEVER_SLIPS
from rockeom.compiler.decorators import Floats, Ints, inlined, rolled
from rockeom.integrator.provided import N_POINTS
from rockeom.integrator.tolerances import (
    BEYOND_MOST,
    CLEAR_FIT,
    FITS,
    LEAST_SIZE,
    NOTHING_LEFT,
    SAME_ROWS,
)
from rockeom.integrator.transitions.points import COUPLING, LAWS, ROWS, eliminate

__fused__ = False


class Meeting(NamedTuple):
    """Points that meet, and what they do at an instant of the impact.

    near (N_POINTS,) : 1 of those that touch. sizes : of `sizes_of`. rate, impulse (ROWS,) : now.
    slides (N_POINTS,) : signs of slips, 0 where there is none. first : see `lines_of`.
    holds (N_POINTS,) : 1 where a gap is held: the point presses, or leaves. most : of a force that
    holds a gap, if that can be, or 0. acts : 1 where one may press. given : normal forces, besides
    those that hold a gap. target (ROWS,) : rates of change of the gaps that are held, and 0 of
    slips.
    unknown (ROWS,) : 1 of forces that are to be found, where points hold a gap or stick. sigma
    (N_POINTS,) : sign of the slip that friction opposes. force, change (ROWS,) : forces, and rates
    of change by them.
    """

    near: Ints
    sizes: Floats
    rate: Floats
    impulse: Floats
    slides: Floats
    first: Ints
    holds: Ints
    acts: Ints
    given: Floats
    target: Floats
    unknown: Ints
    sigma: Floats
    force: Floats
    change: Floats
    most: Floats


def slips_now(m):
    """The signs of the slips, 0 where they are none."""
    for i in range(N_POINTS):
        slip = m.rate[2 * i + 1]
        m.slides[i] = 0.0
        if m.near[i] == 1 and abs(slip) > NOTHING_LEFT * m.sizes[2 * i + 1]:
            m.slides[i] = 1.0 if slip > 0.0 else -1.0


def lines_of(m, contact):
    """The first point that has the slip of each, such as level feet: they share their friction."""
    for i in range(N_POINTS):
        m.first[i] = i
        of_this = contact[COUPLING + (2 * i + 1) * ROWS + 2 * i + 1]
        for back in range(i):
            j = i - 1 - back
            of_that = contact[COUPLING + (2 * j + 1) * ROWS + 2 * j + 1]
            apart = of_this + of_that - 2.0 * contact[COUPLING + (2 * i + 1) * ROWS + 2 * j + 1]
            if m.near[i] == 1 and m.near[j] == 1 and apart <= SAME_ROWS * (of_this + of_that):
                m.first[i] = j


def grip(lines, m, contact):
    """Stop the slips of points that never slip, and may press, by infinite friction: at once.

    The normal impulse that goes with it is none. It may let others close faster than at the rates
    of lines (N_POINTS,), which press from now on, too.
    """
    a, held = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    for _ in range(N_POINTS):
        order, moves = 0, False
        for i in range(N_POINTS):
            if m.acts[i] == 1 and contact[LAWS + 2 * i + 1] >= NEVER_SLIPS:
                held[order] = 2 * i + 1
                moves = moves or m.rate[2 * i + 1] != 0.0
                order += 1
        if not moves:
            break
        width = order + 1
        for r in range(order):
            for s in range(order):
                a[r * width + s] = contact[COUPLING + held[r] * ROWS + held[s]]
            a[r * width + order] = -m.rate[held[r]]
        eliminate(a, order, width)
        for r in range(order):
            m.impulse[held[r]] += a[r * width + order]
            for s in range(ROWS):
                by = contact[COUPLING + s * ROWS + held[r]]
                m.rate[s] += by * a[r * width + order]
        for r in range(order):
            m.rate[held[r]] = 0.0
        for i in range(N_POINTS):
            below = m.rate[2 * i] < lines[i] - NOTHING_LEFT * m.sizes[2 * i]
            m.acts[i] = 1 if m.near[i] == 1 and below else m.acts[i]


def combination(code, m, contact):
    """Whether there is a combination of this number, of what points do that is not known.

    Those that hold a gap press or leave; those that do not slip stick or begin to slip.
    """
    left = code
    for i in range(N_POINTS):
        m.unknown[2 * i] = m.unknown[2 * i + 1] = 0
        m.sigma[i] = m.slides[i]
        if m.holds[i] == 1:
            half = int(0.5 * left)
            m.unknown[2 * i] = 1 - (left - 2 * half)
            left = half
        if m.first[i] != i:
            m.sigma[i] = m.sigma[m.first[i]]
        elif m.slides[i] == 0.0:
            friction = friction_on_line(i, m, contact)
            choice = 0
            if 0.0 < friction < NEVER_SLIPS:
                third = int((left + 0.5) / 3.0)
                choice, left = left - 3 * third, third
            m.sigma[i] = 1.0 if choice == 1 else -1.0 if choice == 2 else 0.0
            m.unknown[2 * i + 1] = 1 if choice == 0 and friction > 0.0 else 0
    return left == 0


@inlined
def friction_on_line(point, m, contact):
    """The largest coefficient of friction of points that share the slip of one and may press."""
    most = 0.0
    for j in range(N_POINTS):
        if m.first[j] == point and m.acts[j] == 1:
            most = max(most, contact[LAWS + 2 * j + 1])
    return most


@inlined
def tie_of(point, m, contact):
    """Friction in parts of the normal force of a point that slips; 0 of one that does not."""
    return -m.sigma[point] * contact[LAWS + 2 * point + 1] if m.sigma[point] != 0.0 else 0.0


@rolled
def forces_with(m, given, target, contact):
    """The forces, with which held gaps move at the rates of target (ROWS,), and points stick.

    given (N_POINTS,) : normal forces, besides those that hold a gap.
    """
    a, rows = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    order, force = 0, m.force
    for i in range(N_POINTS):
        force[2 * i] = given[i]
        force[2 * i + 1] = tie_of(i, m, contact) * given[i]
    for r in range(ROWS):
        if m.unknown[r] == 1:
            rows[order] = r
            order += 1
    width = order + 1
    for r in range(order):
        row = COUPLING + rows[r] * ROWS
        for s in range(order):
            a[r * width + s] = contact[row + rows[s]]
            point = int(0.5 * rows[s])
            if rows[s] == 2 * point:
                a[r * width + s] += tie_of(point, m, contact) * contact[row + rows[s] + 1]
        a[r * width + order] = target[rows[r]]
        for s in range(ROWS):
            a[r * width + order] -= contact[row + s] * force[s]
    eliminate(a, order, width)
    for r in range(order):
        more, point = a[r * width + order], int(0.5 * rows[r])
        force[rows[r]] += more
        if rows[r] == 2 * point:
            force[rows[r] + 1] += tie_of(point, m, contact) * more
    for r in range(ROWS):
        m.change[r] = 0.0
        for s in range(ROWS):
            m.change[r] += contact[COUPLING + r * ROWS + s] * force[s]


def bound_of(point, m, contact):
    """The largest friction of the points that share the slip of one."""
    bound = 0.0
    for j in range(N_POINTS):
        if m.first[j] == point:
            bound += contact[LAWS + 2 * j + 1] * max(m.force[2 * j], 0.0)
    return bound


def least_margin(m, contact):
    """The least margin by which forces fit: they press, bound friction, and what leaves opens."""
    largest, least = LEAST_SIZE, np.inf
    for r in range(ROWS):
        largest = max(largest, abs(m.force[r]))
    for i in range(N_POINTS):
        normal, along = 2 * i, 2 * i + 1
        if m.holds[i] == 1 and m.unknown[normal] == 1:
            least = min(least, (m.force[normal] - m.given[i]) / largest)
        elif m.holds[i] == 1:
            size = contact[COUPLING + normal * ROWS + normal] * largest + abs(m.target[normal])
            least = min(least, (m.change[normal] - m.target[normal]) / size)
        if m.first[i] != i or m.slides[i] != 0.0:
            continue
        if m.unknown[along] == 1 and friction_on_line(i, m, contact) < NEVER_SLIPS:
            least = min(least, (bound_of(i, m, contact) - abs(m.force[along])) / largest)
        elif m.sigma[i] != 0.0:
            size = contact[COUPLING + along * ROWS + along] * largest
            least = min(least, m.sigma[i] * m.change[along] / size)
    return least


def choose(m, contact):
    """Whether forces fit: those that fit best, by `least_margin`, and what they do, on return.

    Those that hold a gap are within `most` where some are that fit.
    """
    best = best_fit(True, m, contact)
    if best < 0:
        best = best_fit(False, m, contact)
    if best < 0:
        return False
    combination(best, m, contact)
    forces_with(m, m.given, m.target, contact)
    return True


def best_fit(bounded, m, contact):
    """The number of the combination that fits best, or -1. bounded : only those within `most`."""
    best, most, code = -1, -FITS, 0
    while combination(code, m, contact):
        forces_with(m, m.given, m.target, contact)
        margin = least_margin(m, contact)
        if margin > most and not (bounded and is_beyond_most(m)):
            best, most = code, margin
            if margin > CLEAR_FIT:
                break
        code += 1
    return best


def is_beyond_most(m):
    """Whether a force that holds a gap is above `most`."""
    beyond = False
    for i in range(N_POINTS):
        holds = m.holds[i] == 1 and m.unknown[2 * i] == 1 and m.most[i] > 0.0
        beyond = beyond or (holds and m.force[2 * i] > (1.0 + BEYOND_MOST) * m.most[i])
    return beyond
