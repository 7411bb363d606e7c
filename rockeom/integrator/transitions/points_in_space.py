"""Points that touch in space: which modes may follow, and the impulses or forces of each.

Points have no friction. Some that touch may be idle: the others bear the load without them.
The contract of points, as points_in_plane.py fulfils it.
"""

import numpy as np

from rockeom.codes import FRICTIONLESS, IDLE_POINT, OPEN
from rockeom.compiler.decorators import inlined, rolled
from rockeom.generated.numeric_modes import PLACE_VALUES, share_load, touching
from rockeom.integrator.provided import (
    ANGLES,
    AXES,
    N_POINTS,
    N_STATES,
    STILL,
    point_state,
    rates,
)
from rockeom.integrator.tolerances import NEARLY, NO_TURN
from rockeom.integrator.transitions.points import (
    COUPLING,
    N_COORDINATES,
    ROWS,
    exceeds,
)

__fused__ = False

SIGN_OF = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # by the state of a point
BEARS, IDLES = 1, 2  # digits of states in the number of a mode


def is_smooth(point):
    """Whether a point has no friction whatever the parameters are."""
    return True


@rolled
def candidate_of(number, mode, near, sliding, wanted, contact, impulse):
    """A mode that may follow, with its impulses (ROWS,), or -1; number : below N_CANDIDATES.

    The number says whether points that would bear nothing are idle, and which points touch: all of
    them first, since of modes that move alike the one that keeps more points closed follows. Where
    more bear than are independent, and one of them would pull, it is idle, and the others are
    solved again.
    """
    left, candidate = int(number * 0.5), 0
    unloaded = number - 2 * left == 1
    for i in range(N_POINTS):
        half = int(left * 0.5)
        if left - 2 * half == 0:  # it touches
            if near[i] == 0:
                return -1
            candidate += BEARS * PLACE_VALUES[i]
        left = half
    share = np.empty(N_POINTS)
    for _ in range(3 * N_POINTS):
        which = wrongly_loaded(candidate, 0.0, wanted, contact, share)
        if which >= 0:
            candidate += changed_digit(candidate, which)
    if unloaded:
        which = wrongly_loaded(candidate, NEARLY, wanted, contact, share)
        if which < 0 or point_state(candidate, which) == IDLE_POINT:
            return -1
        candidate += changed_digit(candidate, which)
    shares_in(candidate, wanted, contact, share)
    bear(candidate, share, impulse)
    return candidate


def wrongly_loaded(candidate, tolerance, wanted, contact, share):
    """A point that would pull and may be idle, or that is idle and would bear; or -1.

    The one of which that is most so, a force below `tolerance` of the largest being none. share
    (N_POINTS,) : of `shares_in`.
    """
    independent, bearing = shares_in(candidate, wanted, contact, share)
    largest = 0.0
    for i in range(N_POINTS):
        largest = max(largest, abs(share[i]))
    most, which = NEARLY * largest, -1
    for i in range(N_POINTS):
        idle = point_state(candidate, i) == IDLE_POINT
        touches = idle or (point_state(candidate, i) == FRICTIONLESS and bearing > independent)
        wrong = (share[i] if idle else 2.0 * tolerance * largest - share[i]) if touches else 0.0
        if wrong > most:
            most, which = wrong, i
    return which


@inlined
def changed_digit(mode, point):
    """What the number of a mode gains where a point that bears is idle, or the other way."""
    change = IDLES - BEARS if point_state(mode, point) == FRICTIONLESS else BEARS - IDLES
    return change * PLACE_VALUES[point]


def impulses_of(candidate, wanted, contact, impulse):
    """The impulses, or forces, with which points come to be as a mode says, (ROWS,).

    wanted (ROWS,) : changes of the velocities, or accelerations, where points are closed.
    """
    share = np.empty(N_POINTS)
    shares_in(candidate, wanted, contact, share)
    bear(candidate, share, impulse)


@inlined
def bear(candidate, share, impulse):
    """The impulses (ROWS,) of the points that bear."""
    for r in range(ROWS):
        impulse[r] = 0.0
    for i in range(N_POINTS):
        if point_state(candidate, i) == FRICTIONLESS:
            impulse[AXES * i] = share[i]


@rolled
def shares_in(candidate, wanted, contact, share):
    """(independent, bearing): how many points bear, and how many of these are independent.

    share (N_POINTS,) : what each bears, and an idle one would.
    """
    a, found = np.empty(N_POINTS * (N_POINTS + 1)), np.empty(N_POINTS)
    place = np.empty(N_POINTS, np.int64)
    order, bearing = touching(candidate, N_POINTS, place)
    width = order + 1
    for i in range(bearing):
        row = AXES * place[i]
        for j in range(order):
            a[i * width + j] = contact[COUPLING + row * ROWS + AXES * place[j]]
        a[i * width + order] = wanted[row]
    independent = share_load(bearing, order - bearing, a, found)
    for i in range(N_POINTS):
        share[i] = 0.0
    for j in range(order):
        share[place[j]] = found[j]
    return independent, bearing


def margin_of(candidate, near, sliding, wanted, contact, sizes, impulse, least_of_all):
    """The least margin by which impulses, or forces, fit; negative where they do not.

    They press, and open points leave; idle ones stay, and would pull. A margin is relative to
    sizes, see `sizes_of`. Once it is below `least_of_all` no other one is computed.
    """
    least, share = np.inf, np.empty(N_POINTS)
    shares_in(candidate, wanted, contact, share)
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        state, normal = point_state(candidate, i), AXES * i
        if state == FRICTIONLESS:
            least = min(least, share[i] / sizes[ROWS + i])
        else:
            leaves = exceeds(normal, wanted, contact, impulse) / sizes[normal]
            least = min(least, leaves if state == OPEN else -abs(leaves))
        if state == IDLE_POINT:
            least = min(least, -share[i] / sizes[ROWS + i])
        if not least >= least_of_all:
            return least
    return least


def held_upright(mode, y, p):
    """Whether points are closed that keep the structure from turning."""
    dy = np.empty(N_STATES)
    rates(mode, y, p, *STILL, dy)
    held = False
    for i in range(N_POINTS):
        held = held or point_state(mode, i) != OPEN
    for i in range(N_COORDINATES):
        turns = abs(y[i + N_COORDINATES]) > NO_TURN or dy[i + N_COORDINATES] != 0.0
        held = held and not (ANGLES[i] == 1.0 and turns)
    return held


@inlined
def tips_over(y, p):
    """Whether a body falls where no forces fit: some always do without friction."""
    return False
