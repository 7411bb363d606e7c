"""Points that touch in space: which modes may follow, and the impulses or forces of each.

A point is smooth, or never slips. Some that touch may be idle: the others bear the load without
them. One that would have to slip may be released, so that it bears without friction. The contract
of points, as points_in_plane.py fulfils it.
"""

import numpy as np

from rockeom.codes import BEARS, IDLES, OPEN, RELEASED
from rockeom.compiler.decorators import inlined, rolled
from rockeom.generated.numeric_modes import (
    PLACE_VALUES,
    digit_of,
    is_smooth_by,
    rows_of_mode,
    share_load,
)
from rockeom.integrator.provided import (
    ANGLES,
    DIRECTIONS,
    N_POINTS,
    N_STATES,
    SMOOTH,
    STILL,
    point_state,
    rates,
)
from rockeom.integrator.tolerances import NEARLY, NO_TURN
from rockeom.integrator.transitions.points import COUPLING, N_COORDINATES, ROWS, exceeds

__fused__ = False

SETS_OF_POINTS = 2**N_POINTS
SIGN_OF = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # by the state of a point


def is_smooth(point):
    """Whether a point has no friction whatever the parameters are."""
    return is_smooth_by(SMOOTH, point)


@rolled
def candidate_of(number, extra, mode, near, sliding, wanted, contact, impulse):
    """A mode that may follow, with its impulses (ROWS,), or -1; number : below N_CANDIDATES.

    The number says whether points that would bear nothing are idle, which points touch, all of them
    first, since the mode that keeps more points closed follows, and which of these are released.
    extra : twice the number of these, less one where only points are that would pull if they stuck.
    A point that slips is released already.
    """
    left, share = int(number * 0.5), np.empty(ROWS)
    candidate, freed, more, released = 0, 0, 0, int(left / SETS_OF_POINTS)
    for i in range(N_POINTS):
        half, rest = int(left * 0.5), int(released * 0.5)
        touches, frees = left - 2 * half == 0, released - 2 * rest == 1
        slips = not is_smooth(i) and near[i] == 1 and sliding[i] != 0.0
        if (touches and near[i] == 0) or (frees and (is_smooth(i) or slips or not touches)):
            return -1
        if touches:
            candidate += (RELEASED if slips else BEARS) * PLACE_VALUES[i]
        if frees:
            freed, more = freed + (RELEASED - BEARS) * PLACE_VALUES[i], more + 1
        left, released = half, rest
    if extra != 2 * more and extra != 2 * more - 1:
        return -1
    if extra < 2 * more and not would_pull(candidate, candidate + freed, wanted, contact, share):
        return -1
    candidate += freed
    for _ in range(3 * N_POINTS):
        which = wrongly_loaded(candidate, 0.0, wanted, contact, share)
        if which < 0:
            break
        candidate += changed_digit(candidate, which)
    if number - 2 * int(number * 0.5) == 1:
        which = wrongly_loaded(candidate, NEARLY, wanted, contact, share)
        if which < 0 or digit_of(candidate, which) == IDLES:
            return -1
        candidate += changed_digit(candidate, which)
    impulses_of(candidate, wanted, contact, impulse)
    return candidate


def would_pull(sticks, candidate, wanted, contact, share):
    """Whether the points that a candidate releases press on nothing, or pull, where they stick."""
    shares_in(sticks, wanted, contact, share)
    largest, pulls = 0.0, True
    for i in range(N_POINTS):
        largest = max(largest, abs(share[DIRECTIONS * i]))
    for i in range(N_POINTS):
        released = digit_of(candidate, i) != digit_of(sticks, i)
        pulls = pulls and not (released and share[DIRECTIONS * i] > NEARLY * largest)
    return pulls


def wrongly_loaded(candidate, tolerance, wanted, contact, share):
    """A point that would pull and may be idle, or that is idle and would bear; or -1.

    The one of which that is most so, a force below `tolerance` of the largest being none. share
    (ROWS,) : of `shares_in`.
    """
    shares_in(candidate, wanted, contact, share)
    spare, largest = has_spare_point(candidate, contact), 0.0
    for i in range(N_POINTS):
        largest = max(largest, abs(share[DIRECTIONS * i]))
    most, which = NEARLY * largest, -1
    for i in range(N_POINTS):
        digit, force = digit_of(candidate, i), share[DIRECTIONS * i]
        wrong = 0.0
        if digit == IDLES:
            wrong = force
        elif digit == BEARS and spare:
            wrong = 2.0 * tolerance * largest - force
        if wrong > most:
            most, which = wrong, i
    return which


@inlined
def changed_digit(mode, point):
    """Gain of the number of a mode where a point that bears is idle, or the other way."""
    change = IDLES - BEARS if digit_of(mode, point) == BEARS else BEARS - IDLES
    return change * PLACE_VALUES[point]


def impulses_of(candidate, wanted, contact, impulse):
    """The impulses, or forces, with which points come to be as a mode says, (ROWS,).

    wanted (ROWS,) : changes of the velocities, or accelerations, where points are closed.
    """
    shares_in(candidate, wanted, contact, impulse)
    for i in range(N_POINTS):
        if digit_of(candidate, i) == IDLES:
            impulse[DIRECTIONS * i] = 0.0


@rolled
def shares_in(candidate, wanted, contact, share):
    """Impulses, or forces, in each row that is held, into share (ROWS,).

    The normal one of a point that is idle is the one that it would have.
    """
    a, found = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS)
    row = np.empty(ROWS, np.int64)
    held, every = rows_of_mode(candidate, N_POINTS, SMOOTH, row)
    width = every + 1
    for r in range(held):
        for s in range(every):
            a[r * width + s] = contact[COUPLING + row[r] * ROWS + row[s]]
        a[r * width + every] = wanted[row[r]]
    share_load(held, every - held, a, found)
    for r in range(ROWS):
        share[r] = 0.0
    for r in range(every):
        share[row[r]] = found[r]


@rolled
def has_spare_point(candidate, contact):
    """Whether a point may cease to bear, and the others keep its gap closed."""
    a, found = np.empty(N_POINTS * (N_POINTS + 1)), np.empty(N_POINTS)
    row, bearing = np.empty(N_POINTS, np.int64), 0
    for i in range(N_POINTS):
        if digit_of(candidate, i) in (BEARS, RELEASED):
            row[bearing] = DIRECTIONS * i
            bearing += 1
    width = bearing + 1
    for r in range(bearing):
        for s in range(bearing):
            a[r * width + s] = contact[COUPLING + row[r] * ROWS + row[s]]
        a[r * width + bearing] = 0.0
    return share_load(bearing, 0, a, found) < bearing


def margin_of(candidate, near, sliding, wanted, contact, sizes, impulse, least_of_all):
    """The least margin by which impulses, or forces, fit; negative where they do not.

    They press, and open points leave; idle ones stay, and would pull. A margin is relative to
    sizes, see `sizes_of`. Once it is below `least_of_all` no other one is computed.
    """
    least, share = np.inf, np.empty(ROWS)
    shares_in(candidate, wanted, contact, share)
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        digit, normal = digit_of(candidate, i), DIRECTIONS * i
        if digit in (OPEN, IDLES):
            leaves = exceeds(normal, wanted, contact, impulse) / sizes[normal]
            least = min(least, leaves if digit == OPEN else -abs(leaves))
        if digit != OPEN:
            presses = share[normal] / sizes[ROWS + i]
            least = min(least, -presses if digit == IDLES else presses)
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
    """Whether a body falls where no forces fit."""
    return False
