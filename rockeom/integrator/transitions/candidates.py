"""Modes that may follow an event, of points that may open, slide and bounce: none is declared.

A mode says of each point whether it is open, sticks or slips to a side. Where one ends, all that
may follow are tried: at a landing, those whose impulses fit the velocities after them; then those
whose forces fit the accelerations. An event that none fits, or several that move differently, ends
the motion.
"""

import math

import numpy as np

from rockeom.codes import (
    AMBIGUOUS,
    IDLE_POINT,
    IMPOSSIBLE,
    LANDING,
    LIFTING,
    NEVER_SLIPS,
    NO_MORE,
    OPEN,
    SLIPPING,
    STICK,
    STICKING,
    SWITCH,
)
from rockeom.compiler.decorators import inlined, rolled, unrolled
from rockeom.integrator.ground import shaking_at
from rockeom.integrator.provided import (
    AXES,
    DIRECTIONS,
    EXTRA_CANDIDATES,
    FIRST_FITS,
    MOST_FITTING,
    N_CANDIDATES,
    N_ELEMENTS,
    N_GUARDS,
    N_PARTS,
    N_POINTS,
    N_STATES,
    RETURNS_SLIPS,
    ROTATION,
    STILL,
    aim_slips,
    begin_slips,
    candidate_of,
    free_motion,
    guards,
    guards_in,
    impulses_of,
    is_smooth,
    jump,
    kind_of,
    landed,
    margin_of,
    point_state,
    points,
    rates,
    reverse_of,
    slides_end,
    slips_begin,
    stops,
    subject_of,
)
from rockeom.integrator.tolerances import (
    CLEAR_FIT,
    CLOSEST,
    FITS,
    FORCE_OF_LARGEST,
    GIVEN,
    GRAIN,
    LARGEST,
    LEAST_PUSH,
    LEAST_SIZE,
    NEARLY,
    NO_GAP,
    NO_GAP_IN_STEP,
    NO_GAP_OF_TERMS,
    NO_MOTION,
    NO_SLIP,
    PUSH,
    SAME_VELOCITIES,
    SLIP_WITH_HOP,
    SLOW,
    SOON_AT_START,
)
from rockeom.integrator.transitions.points import (
    BIASES,
    CONTACT_SIZE,
    COUPLING,
    HALVES,
    LAWS,
    MATRIX,
    N_COORDINATES,
    POINT,
    ROWS,
    SPREAD,
    along,
    contact_data,
    hold_slip,
    is_closed,
    put_on,
    rate_of,
    row_of_point,
    slip_of,
    through_mass,
)

__fused__ = False

# Places in `ground`: the accelerations of the ground now, those a little later, and how much
LATER = AXES
HOW_MUCH = 2 * AXES
GROUND_SIZE = HOW_MUCH + 1

ALL_AT_ONCE = (1.0, 0.7, 0.9)[:AXES]  # accelerations of the ground, all others than one another
STEPS_ERROR = 100.0  # in tolerances of the motion: the error of a state after many steps
ALIKE = 100.0  # times that: difference of accelerations that are the same but for the event's time


def guard_noise(mode, index, y, p, shaking, h, b, stride):
    """Size of the rounding errors of a guard in a step h.

    For a gap, by the terms whose difference it is, and by what acts on it; for a force, by the
    largest of them and by what would hold the structure: b holds `stride` numbers of each guard,
    in a step or at an instant.
    """
    kind = kind_of(mode, index)
    if kind != LANDING and kind != LIFTING and kind != SLIPPING:
        return 0.0
    contact, sizes, wanted = np.empty(CONTACT_SIZE), np.empty(ROWS + N_POINTS), np.empty(ROWS)
    point = subject_of(mode, index)
    contact_data(y, p, mode, contact)
    without_forces(y, p, shaking, mode, contact, wanted, sizes)
    if kind == LANDING:
        _, size = rate_of(contact, DIRECTIONS * point, y, 0)
        push = max(PUSH * freedom_of(point, mode, contact), LEAST_PUSH) * sizes[DIRECTIONS * point]
        return GRAIN * size + push * h * h
    largest = 0.0
    for i in range(guards_in(mode)):
        if kind_of(mode, i) == LIFTING or kind_of(mode, i) == SLIPPING:
            for j in range(stride * i, stride * i + stride):
                largest = max(largest, abs(b[j]))
    return max(FORCE_OF_LARGEST * largest, FITS * sizes[ROWS + point])


def freedom_of(point, mode, contact):
    """How freely a gap opens while others are closed, at most 1: as their points move apart.

    Square root of J M^-1 J' of the difference of their rows, over that of the point alone.
    """
    alone = COUPLING + DIRECTIONS * point * (ROWS + 1)
    least = contact[alone]
    for i in range(N_POINTS):
        if point_state(mode, i) != OPEN:
            between_ = contact[COUPLING + DIRECTIONS * point * ROWS + DIRECTIONS * i]
            other = contact[COUPLING + DIRECTIONS * i * (ROWS + 1)]
            apart = contact[alone] - 2.0 * between_ + other
            least = min(least, max(apart, 0.0))
    return math.sqrt(least / contact[alone])


def fitting_states(
    mode, left_out, extra, near, sliding, wanted, contact, sizes, tolerance, alike, fitting, chosen
):  # fmt: skip
    """(best, several): of all modes but one those whose impulses, or forces, fit.

    They fit by `tolerance`, and what they change of the velocities, or accelerations, differs by no
    more than `alike`, squared in the measure of the mass: the best, which has the largest margin,
    is AMBIGUOUS if it does, and IMPOSSIBLE if none fits. left_out : a mode that is none of them, or
    -1. extra : 0, or which candidates they are that follow only where none with a lower number
    fits. fitting, chosen (ROWS,) : on return the `several` modes that fit, and the impulses, or
    forces, of the best.
    """
    impulse, first = np.empty(ROWS), np.empty(N_COORDINATES)
    this, apart = np.empty(N_COORDINATES), np.empty(N_COORDINATES)
    best, several, most = IMPOSSIBLE, 0, -np.inf
    for number in range(N_CANDIDATES):
        candidate = candidate_of(number, extra, mode, near, sliding, wanted, contact, impulse)
        if candidate == NO_MORE:
            break
        if candidate < 0 or candidate == left_out:
            continue
        margin = margin_of(
            candidate, near, sliding, wanted, contact, sizes, impulse, -tolerance
        )  # fmt: skip
        if not margin >= -tolerance:
            continue
        change_by(impulse, contact, this)
        for i in range(N_COORDINATES):
            if several == 0:
                first[i] = this[i]
            apart[i] = this[i] - first[i]
        differs = several > 0 and squared(contact, apart) > alike
        if differs and not FIRST_FITS:
            return AMBIGUOUS, several
        if differs:
            continue
        if several < MOST_FITTING:
            fitting[several] = candidate
            several += 1
        if margin > most:
            best, most = candidate, margin
            chosen[:ROWS] = impulse
        if FIRST_FITS and margin > CLEAR_FIT:
            break
    return best, several


def change_by(impulse, contact, change):
    """The changes of velocities (n,) by impulses (ROWS,), or accelerations by forces."""
    for i in range(N_COORDINATES):
        change[i] = 0.0
        for r in range(ROWS):
            change[i] += contact[SPREAD + i * ROWS + r] * impulse[r]


def sizes_of(whole, contact, sizes):
    """How large what points do is, relative to the whole motion, into sizes (ROWS + N_POINTS,).

    whole : the velocities, or accelerations, squared in the measure of the mass. Sizes of those of
    the points come first, then those of normal impulses, or forces.
    """
    for r in range(ROWS):
        sizes[r] = math.sqrt(contact[COUPLING + r * ROWS + r] * whole) + LEAST_SIZE
    for i in range(N_POINTS):
        freely = contact[COUPLING + DIRECTIONS * i * (ROWS + 1)]
        sizes[ROWS + i] = math.sqrt(whole / freely) + LEAST_SIZE


def radius_of(contact, point):
    """The radius of gyration of what a point moves: the length with which its gap is compared.

    It is that of a rotation with all other coordinates held; 1 where nothing turns.
    """
    inertia = contact[MATRIX + ROTATION * N_COORDINATES + ROTATION]
    return math.sqrt(inertia * contact[COUPLING + DIRECTIONS * point * (ROWS + 1)])


def squared(contact, x):
    """The square in the measure of the mass."""
    total = 0.0
    for i in range(N_COORDINATES):
        for j in range(N_COORDINATES):
            total += x[i] * contact[MATRIX + i * N_COORDINATES + j] * x[j]
    return total


def collide(mode, near, slowest, contact, y):
    """Velocities y[n:] after all closed points have met.

    The law is the algebraic one: each closing gap opens at the rate e times that at which it
    closed, or faster where nothing presses; friction opposes the slip after the impact, by Moreau's
    law that slip and e times the one before; all points at once. Returns a mode of the impulses
    that fit, the best of those that lead to the same velocities, or IMPOSSIBLE, or AMBIGUOUS.
    slowest : what counts as the same, squared in the measure of the mass, at least.
    """
    n = N_COORDINATES
    wanted, sizes = np.empty(ROWS), np.empty(ROWS + N_POINTS)
    change, sliding = np.empty(N_COORDINATES), np.zeros(N_POINTS)
    fitting = np.empty(MOST_FITTING, np.int64)
    for i in range(n):
        change[i] = y[n + i]
    whole = squared(contact, change)
    sizes_of(whole, contact, sizes)
    for r in range(ROWS):
        arriving, _ = rate_of(contact, r, y, n)
        wanted[r] = -arriving
        point = int(r / DIRECTIONS)
        if DIRECTIONS * point == r:
            wanted[r] -= contact[LAWS + 2 * point] * min(arriving, 0.0)
        elif RETURNS_SLIPS:
            wanted[r] -= contact[LAWS + 2 * point] * arriving
    alike = max(SAME_VELOCITIES * whole, slowest)
    follows, impulse = IMPOSSIBLE, np.empty(ROWS)
    for extra in range(EXTRA_CANDIDATES + 1):
        if follows == IMPOSSIBLE:
            follows, _ = fitting_states(
                mode, -1, extra, near, sliding, wanted, contact, sizes, FITS, alike, fitting,
                impulse,
            )  # fmt: skip
    if follows >= 0:
        change_by(impulse, contact, change)
        for i in range(n):
            y[n + i] += change[i]
    return follows


@rolled
def closed_points(y, p, mode, contact, near, sliding):
    """Which points touch in a given state, and the signs of their slips, into near and sliding.

    contact : of `contact_data`. near, sliding (N_POINTS,) : a point touches whose gap is closed,
    and does not open. A gap is compared with the error of its own terms, GIVEN, and with the size
    of the structure, see `radius_of`: so a slender block that leans stands on one foot. A velocity
    is compared with the most that the kinetic energy can give the point, or, where nothing but
    rounding errors moves, with sqrt(a l), a the acceleration of the point in free motion.
    """
    free, speeds = np.empty(ROWS + N_POINTS), np.empty(ROWS + N_POINTS)
    wanted = np.empty(ROWS)
    without_forces(y, p, STILL, mode, contact, wanted, free)
    sizes_of(squared(contact, y[N_COORDINATES:]), contact, speeds)
    for i in range(N_POINTS):
        length = radius_of(contact, i)
        _, size = rate_of(contact, DIRECTIONS * i, y, 0)
        closed = contact[i * POINT] <= min(NO_GAP * max(size, length), GIVEN * size)
        row = DIRECTIONS * i
        least = max(GIVEN * speeds[row], NO_MOTION * math.sqrt(free[row] * length))
        rate = abs(contact[i * POINT + 1])
        near[i] = 1 if closed and rate <= least else 0
        slip, _ = slip_of(contact, i, y, N_COORDINATES)
        row += 1
        least = max(GIVEN * speeds[row], NO_MOTION * math.sqrt(free[row] * length))
        sliding[i] = 0.0 if abs(slip) <= least else 1.0 if slip > 0.0 else -1.0
        # in a hop of a point that never slips both velocities are of one size, small as they are
        if (
            sliding[i] != 0.0
            and contact[LAWS + 2 * i + 1] >= NEVER_SLIPS
            and rate > SLIP_WITH_HOP * abs(slip)
        ):
            near[i] = 0


def fits_by_forces(mode, y, p, shaking):
    """The mode that fits the forces in a state, or IMPOSSIBLE, or AMBIGUOUS.

    mode : that which the state's gaps and velocities tell of, with its elements.
    """
    contact, sizes = np.empty(CONTACT_SIZE), np.empty(ROWS + N_POINTS)
    near, sliding = np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS)
    contact_data(y, p, mode, contact)
    if hardly_apart(contact):
        return AMBIGUOUS
    closed_points(y, p, mode, contact, near, sliding)
    for i in range(N_POINTS):
        if point_state(mode, i) != OPEN:
            near[i] = 1
    ground = np.empty(GROUND_SIZE)
    ground_now_and_later(shaking, shaking, SOON_AT_START, ground)
    return select_by_forces(mode, False, near, sliding, y, p, ground, 0.0, contact, sizes)


def hardly_apart(contact):
    """Whether two points are so close that rounding errors hide which of them carries."""
    for i in range(N_POINTS):
        for j in range(i):
            apart = 0.0
            of_this, of_that = row_of_point(DIRECTIONS * i), row_of_point(DIRECTIONS * j)
            for m in range(N_COORDINATES):
                lever, other = contact[of_this + m], contact[of_that + m]
                difference = abs(lever - other)
                if difference > GRAIN * max(abs(lever), abs(other)):
                    apart = max(apart, difference)
            if 0.0 < apart < CLOSEST * radius_of(contact, i):
                return True
    return False


@inlined
def ground_now_and_later(shaking, later, how_much, ground):
    """The accelerations of the ground now and a little `later`, into ground (GROUND_SIZE,)."""
    for axis in unrolled(range(AXES)):
        ground[axis], ground[LATER + axis] = shaking[axis], later[axis]
    ground[HOW_MUCH] = how_much


def without_forces(y, p, shaking, mode, contact, wanted, sizes):
    """The accelerations that points lack where nothing touches, into wanted (ROWS,), and sizes.

    sizes (ROWS + N_POINTS,) : of `sizes_of`, for accelerations with the ground at rest, too, so
    that they do not vanish with the weight. Returns the larger of both, squared.
    """
    n = N_COORDINATES
    forces, at_rest = np.empty(N_COORDINATES), np.empty(N_COORDINATES)
    both, matrix = np.empty(2 * N_COORDINATES), contact[MATRIX:]
    free_motion(y, p, *shaking, mode, matrix, forces)
    free_motion(y, p, *STILL, mode, matrix, at_rest)
    for i in range(n):
        both[2 * i], both[2 * i + 1] = forces[i], at_rest[i]
    through_mass(matrix, both, 2)
    moved = quiet = 0.0
    for i in range(n):
        moved += forces[i] * both[2 * i]
        quiet += at_rest[i] * both[2 * i + 1]
    for i in range(N_POINTS):
        for m in range(DIRECTIONS):
            row = DIRECTIONS * i + m
            wanted[row] = -along(contact, row, both, 0, 2) - contact[i * POINT + BIASES + m]
    whole = max(moved, quiet)
    sizes_of(whole, contact, sizes)
    return whole


def select_by_forces(mode, ends, near, sliding, y, p, ground, rtol, contact, sizes):
    """The mode whose forces and accelerations fit, or IMPOSSIBLE, or AMBIGUOUS.

    ends : whether `mode` has come to its end, so that it follows only where nothing else does.
    ground (GROUND_SIZE,) : where several modes move alike, their margins a little later decide
    between them. rtol : the relative tolerance of the motion, by whose error a mode must fit where
    none fits nearly. sizes (ROWS + N_POINTS,) : of `without_forces`, found here.
    """
    wanted, fitting = np.empty(ROWS), np.empty(MOST_FITTING, np.int64)
    shaking = shaking_at(ground, 0, 1)
    whole = without_forces(y, p, shaking, mode, contact, wanted, sizes)
    follows, chosen = IMPOSSIBLE, np.empty(ROWS)
    for turn in range(2 * (EXTRA_CANDIDATES + 1)):
        # the state after many steps is off by more than an event's time
        extra = int(turn / 2)
        error = NEARLY if turn == 2 * extra else STEPS_ERROR * rtol
        if follows != IMPOSSIBLE or error < NEARLY:
            continue
        alike = ALIKE * ALIKE * error * error * whole
        follows, several = fitting_states(
            mode, -1, extra, near, sliding, wanted, contact, sizes, error, alike, fitting, chosen
        )  # fmt: skip
        decided = several <= 1 and not (ends and follows == mode)
        if ends and (follows == AMBIGUOUS or (FIRST_FITS and follows == mode)):
            # the mode that has come to its end and another one move apart: only one of them lasts
            fitting[0] = mode
            follows = best_later(mode, ends, near, sliding, sizes, fitting, 1, y, p, ground)
            decided = follows != IMPOSSIBLE
            if not decided:
                follows, several = fitting_states(
                    mode, mode, extra, near, sliding, wanted, contact, sizes, error, alike,
                    fitting, chosen,
                )  # fmt: skip
                decided = several <= 1
        if follows >= 0 and not decided:
            follows = best_later(mode, ends, near, sliding, sizes, fitting, several, y, p, ground)
    return follows


@rolled
def best_later(mode, ends, near, sliding, sizes, fitting, several, y, p, ground):
    """The mode that fits best a little later, of those that move alike now.

    fitting : its first `several` numbers are these modes. sizes : of forces and accelerations now.
    """
    n, tau = N_COORDINATES, ground[HOW_MUCH]
    dy, w = np.empty(N_STATES), np.empty(N_STATES)
    contact, of_then = np.empty(CONTACT_SIZE), np.empty(ROWS + N_POINTS)
    impulse, wanted = np.empty(ROWS), np.empty(ROWS)
    shaking, later = shaking_at(ground, 0, 1), shaking_at(ground, LATER, 1)
    rates(fitting[0], y, p, *shaking, dy)
    for i in range(n):
        w[i] = y[i] + tau * (y[n + i] + 0.5 * tau * dy[n + i])
        w[n + i] = y[n + i] + tau * dy[n + i]
    contact_data(w, p, mode, contact)
    without_forces(w, p, later, mode, contact, wanted, of_then)
    follows, best = IMPOSSIBLE, -np.inf
    for i in range(several):
        candidate = fitting[i]
        if slips_begin(candidate, sliding):
            aim_slips(candidate, sliding, wanted, contact, impulse)
        impulses_of(candidate, wanted, contact, impulse)
        margin = margin_of(candidate, near, sliding, wanted, contact, sizes, impulse, -np.inf)
        if candidate == mode and ends:
            # what has come to its end goes on only where nothing but rounding errors ended it
            if several == 1 and margin < -FITS:
                return IMPOSSIBLE
            margin = np.inf if margin >= -FITS else -LARGEST
        # of those that fit as well, the one that keeps more points closed, which stands first
        if margin > best + FITS:
            follows, best = candidate, margin
    return follows


# -- transitions ---------------------------------------------------------------------------------


def pass_on(mode, guard, h, y, p, ground, rtol, contact, out):
    """The end of a mode by a guard: state after into out (N,).

    Returns the mode that follows, or IMPOSSIBLE, or AMBIGUOUS, and which of its guards are
    closed, see `is_closed`.
    """
    for i in range(N_STATES):
        out[i] = y[i]
    kind, subject = kind_of(mode, guard), subject_of(mode, guard)
    if kind == SWITCH:
        follows, closed = mode, -1
        if N_ELEMENTS > 0:
            follows = jump(mode, guard, 0, 0.0, y, p, out)
            if reverse_of(mode, guard) >= 0:
                closed = int(1.0 / HALVES[reverse_of(mode, guard)])
        return follows, closed
    near, rows = np.zeros(N_POINTS, np.int64), np.zeros(ROWS, np.int64)
    wanted = np.zeros(ROWS)
    contact_data(out, p, mode, contact)
    # -- which points touch: they are put on what they touch
    for i in range(N_POINTS):
        touches = point_state(mode, i) != OPEN or (kind == LANDING and i == subject)
        if not touches and kind == LANDING:
            gap, rate = contact[i * POINT], contact[i * POINT + 1]
            _, size = rate_of(contact, DIRECTIONS * i, out, 0)
            touches = rate <= 0.0 and gap <= NO_GAP_IN_STEP * h * abs(rate) + NO_GAP_OF_TERMS * size
        if touches:
            near[i] = 1
            rows[DIRECTIONS * i], wanted[DIRECTIONS * i] = 1, -contact[i * POINT]
    put_on(rows, wanted, 0, contact, out)
    return meet(mode, guard, near, y, p, ground, rtol, contact, out)


def slow_landing(mode, near, y, p, shaking, contact):
    """How slow a landing is at which it does not matter what follows, see `collide`.

    The speed is SLOW times sqrt(a l), a the acceleration of a point in free motion and l the radius
    of gyration, as of bounces that end at once.
    """
    sizes, wanted = np.empty(ROWS + N_POINTS), np.empty(ROWS)
    without_forces(y, p, shaking, mode, contact, wanted, sizes)
    slowest = np.inf
    for i in range(N_POINTS):
        if near[i] == 1:  # the force that holds a point, times the length
            slowest = min(slowest, sizes[ROWS + i] * radius_of(contact, i))
    return SLOW * SLOW * slowest


def still_closed(before, follows, guard, closed_before, closed):
    """The guards that are closed as a mode begins, with those of other elements.

    Two bars on one rotation stop to yield at the same instant, one after the other: the force of
    the first is still at its strength. closed_before : the guards closed before, see `is_closed`.
    """
    for i in range(min(guards_in(before), guards_in(follows))):
        alike = kind_of(before, i) == SWITCH and kind_of(follows, i) == SWITCH
        alike = alike and subject_of(before, i) == subject_of(follows, i)
        alike = alike and subject_of(before, i) != subject_of(before, guard)
        if alike and is_closed(closed_before, i) and not is_closed(closed, i):
            closed = max(closed, 0) + int(1.0 / HALVES[i])
    return closed


def meet(mode, guard, near, y, p, ground, rtol, contact, out):
    """The velocities and the mode that follow where the points of near (N_POINTS,) touch.

    out (N,) : the state, at first that before, of whose places all is known. Returns as `pass_on`.
    """
    n, kind, subject = N_COORDINATES, kind_of(mode, guard), subject_of(mode, guard)
    rows, wanted, sliding = np.zeros(ROWS, np.int64), np.zeros(ROWS), np.zeros(N_POINTS)
    as_said = mode  # by the velocities of this mode
    if kind == LANDING:
        as_said = landed(mode, near, y, p, ground, contact, out)
        if as_said < 0:
            return as_said, -1
    # -- which of them stay, and move along, or leave
    leaving, sizes = np.zeros(N_POINTS, np.int64), np.empty(ROWS + N_POINTS)
    sizes_of(squared(contact, y[n:]), contact, sizes)
    shaking = shaking_at(ground, 0, 1)
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        state = point_state(as_said, i)
        rate, size = rate_of(contact, DIRECTIONS * i, out, n)
        leaves = rate > FITS * max(size, sizes[DIRECTIONS * i])
        if leaves and (state == OPEN or contact[LAWS + 2 * i] > 0.0) and kind == LANDING:
            leaving[i], near[i] = 1, 0
            continue
        rows[DIRECTIONS * i], wanted[DIRECTIONS * i] = 1, -rate
        if is_smooth(i):
            continue
        slip, size = slip_of(contact, i, out, n)
        still = abs(slip) <= FITS * max(size, sizes[DIRECTIONS * i + 1])
        # what sticks by Moreau's law slips back, e times as fast
        back = RETURNS_SLIPS and kind == LANDING and contact[LAWS + 2 * i] > 0.0
        still = still or (state == STICK and not back)
        if state == IDLE_POINT and not still:
            still = at_rest_along(i, slip, mode, out, p, shaking, contact)
        if stops(kind, i, subject, mode, slip):
            still = True
        if still:
            hold_slip(contact, i, out, rows, wanted)
        else:
            sliding[i] = 1.0 if slip > 0.0 else -1.0
    end_slides(near, sliding, contact, out, rows, wanted)
    put_on(rows, wanted, n, contact, out)
    points(out, p, contact)
    ends = kind in (LIFTING, SLIPPING)
    follows = select_by_forces(mode, ends, near, sliding, out, p, ground, rtol, contact, sizes)
    if follows < 0:
        return follows, -1
    start_slips(follows, sliding, out, p, shaking, rtol, contact)
    g = np.empty(N_GUARDS + N_PARTS)
    guards(follows, out, p, *shaking, g)
    return follows, closed_guards(follows, mode, guard, near, leaving, sliding, g, sizes)


def end_slides(near, sliding, contact, y, rows, wanted):
    """Let rows (ROWS,) hold points that slide and never do, where they stick again."""
    if slides_end(near, sliding, contact):
        for i in range(N_POINTS):
            if sliding[i] != 0.0 and contact[LAWS + 2 * i + 1] >= NEVER_SLIPS:
                hold_slip(contact, i, y, rows, wanted)
                sliding[i] = 0.0


def start_slips(mode, sliding, y, p, shaking, rtol, contact):
    """Give slips that begin in a mode their first velocity in y, where friction depends on it."""
    if slips_begin(mode, sliding):
        wanted, sizes = np.empty(ROWS), np.empty(ROWS + N_POINTS)
        without_forces(y, p, shaking, mode, contact, wanted, sizes)
        begin_slips(mode, sliding, wanted, STEPS_ERROR * rtol, contact, y)


def at_rest_along(point, slip, mode, y, p, shaking, contact):
    """Whether the slip of a point is nothing but what rounding leaves of a structure at rest.

    There no velocity has a size to compare it with: that is sqrt(a l), as in `closed_points`.
    """
    wanted, sizes = np.empty(ROWS), np.empty(ROWS + N_POINTS)
    without_forces(y, p, shaking, mode, contact, wanted, sizes)
    size = math.sqrt(sizes[DIRECTIONS * point + 1] * radius_of(contact, point))
    return abs(slip) <= NO_SLIP * size


@rolled
def closed_guards(follows, mode, guard, near, leaving, sliding, g, sizes):
    """Which guards g of a mode are zero as it begins, see `is_closed`; -1 for none."""
    closed = 0
    for i in range(guards_in(follows)):
        kind, subject = kind_of(follows, i), subject_of(follows, i)
        zero = follows == mode and i == guard and kind != LANDING
        if kind == LANDING:
            zero = near[subject] == 1 or leaving[subject] == 1
        elif kind == STICKING:
            zero = sliding[subject] == 0.0
        elif kind in (LIFTING, SLIPPING):
            zero = zero or abs(g[i]) <= NEARLY * sizes[ROWS + subject]
        if zero:
            closed += int(1.0 / HALVES[i])
    return closed if closed > 0 else -1


def nothing_moves(mode, y, p):
    """Whether no acceleration of the ground moves anything in a mode, in a state at rest.

    Accelerations are sums of a part of each of the ground's, and of none: all are tried at once.
    """
    dy = np.empty(N_STATES)
    rates(mode, y, p, *ALL_AT_ONCE, dy)
    moves = False
    for i in range(N_STATES):
        moves = moves or dy[i] != 0.0
    return not moves
