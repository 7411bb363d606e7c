"""Points that touch in a plane: which modes may follow, and the impulses or forces of each.

A point sticks or slips to the right or to the left. The contract of points, as points_in_space.py
fulfils it.
"""

import math

import numpy as np

from rockeom.codes import FRICTIONLESS, NEVER_SLIPS, OPEN, STICK, STICKING
from rockeom.compiler.decorators import inlined, rolled
from rockeom.integrator.provided import (
    FEET_OF,
    N_ELEMENTS,
    N_MODES,
    N_POINTS,
    N_STATES,
    POSITIONS,
    ROTATION,
    STILL,
    element_state,
    point_state,
    points,
    positions,
    rates,
    shares_with,
)
from rockeom.integrator.tolerances import APART, INDEPENDENT, NO_TURN
from rockeom.integrator.transitions.points import (
    COUPLING,
    LAWS,
    N_COORDINATES,
    POINT,
    ROWS,
    eliminate,
    exceeds,
    row_of_point,
)

__fused__ = False

SIGN_OF = (0.0, 0.0, 1.0, -1.0, 0.0)  # by the state of a point
TIPPED = 2.0  # a block has come back from 1.7 times the angle at which its weight is balanced


@inlined
def candidate_of(number, extra, mode, near, sliding, wanted, contact, impulse):
    """A mode that may follow, with its impulses (ROWS,), or -1; number : below N_CANDIDATES."""
    if not may_follow(number, mode, near, sliding):
        return -1
    impulses_of(number, wanted, contact, impulse)
    return number


def is_smooth(point):
    """Whether a point has no friction whatever the parameters are: it never sticks."""
    smooth = True
    for mode in range(N_MODES):
        smooth = smooth and point_state(mode, point) != STICK
    return smooth


@inlined
def may_follow(candidate, mode, near, sliding):
    """Whether a mode has the elements of another, and its points can be as it says.

    near (N_POINTS,) : 1 where a point touches. sliding (N_POINTS,) : the sign of its slip, 0 where
    it does not move.
    """
    for i in range(N_ELEMENTS):
        if element_state(candidate, i) != element_state(mode, i):
            return False
    for i in range(N_POINTS):
        state = point_state(candidate, i)
        if state == OPEN:
            continue
        if near[i] == 0:
            return False
        if state != FRICTIONLESS and sliding[i] != 0.0 and SIGN_OF[state] != sliding[i]:
            return False
    return True


def impulses_of(candidate, wanted, contact, impulse):
    """The impulses, or forces, with which points come to be as a mode says, (ROWS,).

    wanted (ROWS,) : changes of the velocities, or accelerations, where points are closed.
    """
    closed = point = 0
    for i in range(N_POINTS):
        impulse[2 * i] = impulse[2 * i + 1] = 0.0
        if point_state(candidate, i) != OPEN:
            closed, point = closed + 1, i
    if closed == 0 or (closed == 1 and held_alone(candidate, point, wanted, contact, impulse)):
        return
    fractions = np.empty(N_POINTS)
    for i in range(N_POINTS):
        fractions[i] = np.nan
    held_by(candidate, wanted, contact, fractions, impulse)
    if share(candidate, contact, impulse, fractions):
        held_by(candidate, wanted, contact, fractions, impulse)


@inlined
def held_alone(candidate, point, wanted, contact, impulse):
    """`impulses_of` where one point is closed: whether its equations are far from saying the same.

    Most of those at an event are such ones.
    """
    normal, state = 2 * point, point_state(candidate, point)
    at = COUPLING + normal * ROWS + normal
    across, between_, along_ = contact[at], contact[at + 1], contact[at + ROWS + 1]
    if state != STICK:
        tie = -contact[LAWS + normal + 1] * SIGN_OF[state]
        presses = across + tie * between_
        impulse[normal] = wanted[normal] / presses if presses != 0.0 else 0.0
        impulse[normal + 1] = tie * impulse[normal]
        return True
    largest = max(across, max(along_, abs(between_)))
    determinant = across * along_ - between_ * between_
    if not determinant > INDEPENDENT * largest * largest:
        return False
    inverse = 1.0 / determinant
    impulse[normal] = (wanted[normal] * along_ - between_ * wanted[normal + 1]) * inverse
    impulse[normal + 1] = (across * wanted[normal + 1] - wanted[normal] * between_) * inverse
    return True


@rolled
def held_by(candidate, wanted, contact, fractions, impulse):
    """`impulses_of` where sticking points that share their friction have fractions (N_POINTS,).

    These are the parts of the normal impulse that it is; not a number where it is to be found.
    """
    a, unknown = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    friction = np.empty(ROWS, np.int64)  # row of the friction at the point of an unknown
    ties = np.empty(ROWS)  # of a normal impulse: friction in parts of it; of friction: none
    order = 0
    for i in range(N_POINTS):
        state, normal = point_state(candidate, i), 2 * i
        if state == OPEN:
            continue
        unknown[order], friction[order], ties[order] = normal, normal + 1, 0.0
        order += 1
        if state != STICK:
            ties[order - 1] = -contact[LAWS + normal + 1] * SIGN_OF[state]
        elif fractions[i] == fractions[i]:
            ties[order - 1] = fractions[i]
        elif shares_with(candidate, i) == i:
            unknown[order], friction[order], ties[order] = normal + 1, normal + 1, 0.0
            order += 1
    width = order + 1
    for m in range(order):
        row = COUPLING + unknown[m] * ROWS
        for s in range(order):
            value = contact[row + unknown[s]]
            value += ties[s] * contact[row + friction[s]]
            a[m * width + s] = value
        a[m * width + order] = wanted[unknown[m]]
    eliminate(a, order, width)
    for m in range(order):
        impulse[unknown[m]] = a[m * width + order]
        if ties[m] != 0.0:
            impulse[unknown[m] + 1] = ties[m] * a[m * width + order]


@rolled
def share(candidate, contact, force, fractions):
    """The fraction of friction of sticking points at different heights, which share their sum.

    Rigid bodies do not determine the share of each; all mobilise the same fraction of their bounds,
    as they do when they slip. Returns whether there are such points.
    """
    several = False
    for i in range(N_POINTS):
        if point_state(candidate, i) != STICK or shares_with(candidate, i) == i:
            continue
        first = shares_with(candidate, i)
        apart = 0.0
        for j in range(N_COORDINATES):
            one, other = row_of_point(2 * i + 1) + j, row_of_point(2 * first + 1) + j
            apart = max(apart, abs(contact[one] - contact[other]))
        if apart > APART:
            several = True
    if not several:
        return False
    for i in range(N_POINTS):
        if point_state(candidate, i) != STICK:
            continue
        tangential = normal = 0.0
        members = 0
        for j in range(N_POINTS):
            if point_state(candidate, j) == STICK and shares_with(candidate, j) == shares_with(
                candidate, i
            ):
                tangential += force[2 * j + 1]
                normal += force[2 * j]
                members += 1
        if members > 1 and normal != 0.0:
            fractions[i] = tangential / normal
    return True


def margin_of(candidate, near, sliding, wanted, contact, sizes, impulse, least_of_all):
    """The least margin by which impulses, or forces, fit; negative where they do not.

    They press, friction is within its bound and opposes the slip, and open points leave as they
    may. A margin is relative to sizes, see `sizes_of`. Once it is below `least_of_all` no
    other one is computed.
    """
    least = np.inf
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        state, normal = point_state(candidate, i), 2 * i
        if state == OPEN:
            least = min(least, exceeds(normal, wanted, contact, impulse) / sizes[normal])
        else:
            least = min(least, impulse[normal] / sizes[ROWS + i])
        if not least >= least_of_all:
            return least
        if state == STICK:
            sum_, bound = 0.0, 0.0
            for j in range(N_POINTS):
                if point_state(candidate, j) == STICK and (
                    shares_with(candidate, j) == shares_with(candidate, i)
                ):
                    sum_ += impulse[2 * j + 1]
                    most = contact[LAWS + 2 * j + 1] * max(impulse[2 * j], 0.0)
                    bound += most if contact[LAWS + 2 * j + 1] < NEVER_SLIPS else np.inf
            least = min(least, (bound - abs(sum_)) / sizes[ROWS + i])
        elif SIGN_OF[state] != 0.0 and sliding[i] == 0.0:
            slips = SIGN_OF[state] * exceeds(normal + 1, wanted, contact, impulse)
            least = min(least, slips / sizes[normal + 1])
        elif state == FRICTIONLESS and not is_smooth(i):  # it has friction, and must not slip
            slips = abs(exceeds(normal + 1, wanted, contact, impulse))
            least = min(least, -slips / sizes[normal + 1])
    return least


@inlined
def slips_begin(mode, sliding):
    """Whether points slip in a mode whose directions are not known: their sides are."""
    return False


@inlined
def aim_slips(mode, sliding, wanted, contact, motion):
    """No direction is sought."""
    return False


@inlined
def begin_slips(mode, sliding, wanted, speed, contact, y):
    """Slips begin by themselves."""
    pass


@inlined
def stops(kind, point, subject, mode, slip):
    """Whether the slip of a point ends with that of another one."""
    return kind == STICKING and shares_with(mode, point) == shares_with(mode, subject)


@inlined
def slides_end(near, sliding, contact):
    """No point is released."""
    return False


def held_upright(mode, y, p):
    """Whether points are closed that keep the structure from turning."""
    if abs(y[ROTATION + N_COORDINATES]) > NO_TURN:
        return False
    dy = np.empty(N_STATES)
    rates(mode, y, p, *STILL, dy)
    held = False
    for i in range(N_POINTS):
        held = held or point_state(mode, i) != OPEN
    return held and dy[ROTATION + N_COORDINATES] == 0.0


def tips_over(y, p):
    """Whether a body turns outward beyond TIPPED times the angle at which its weight is balanced.

    Relative to what bears it: the sine of that angle is the difference of the gaps of its feet over
    their distance.
    """
    contact, places = np.empty(POINT * N_POINTS), np.empty(3 * len(POSITIONS))
    points(y, p, contact)
    positions(0, y, p, places)  # of bodies first, then of points
    for body in range(len(FEET_OF)):
        low = high = -1
        for i in range(N_POINTS):
            if FEET_OF[body][i] == 1:
                low = i if low < 0 or contact[POINT * i] < contact[POINT * low] else low
                high = i if high < 0 or contact[POINT * i] > contact[POINT * high] else high
        centre, foot, other = 3 * body, 3 * (len(FEET_OF) + low), 3 * (len(FEET_OF) + high)
        across, up = places[centre] - places[foot], places[centre + 1] - places[foot + 1]
        base, tilt = places[other] - places[foot], places[other + 1] - places[foot + 1]
        lever, height = base * across + tilt * up, abs(base * up - tilt * across)
        if height > 0.0 and contact[POINT * high + 1] > contact[POINT * low + 1]:
            sine = (contact[POINT * high] - contact[POINT * low]) / math.sqrt(
                base * base + tilt * tilt
            )
            if math.asin(min(1.0, sine)) > TIPPED * math.atan(lever / height):
                return True
    return False
