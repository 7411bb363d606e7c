"""The end of events without end: infinitely many impacts to come, or any events at one instant."""

import math
from typing import NamedTuple

import numpy as np

from rockeom.codes import IMPOSSIBLE, LANDING, NEVER_SLIPS, OPEN, STICK, STICKING
from rockeom.compiler.decorators import Floats, Ints
from rockeom.integrator.provided import (
    DIRECTIONS,
    N_POINTS,
    N_STATES,
    SIGN_OF,
    free_motion,
    guards_in,
    is_smooth,
    kind_of,
    point_state,
    points,
    rates,
    subject_of,
)
from rockeom.integrator.tolerances import (
    ENDED,
    ENDED_FLIGHT,
    ENDED_OF_ALL,
    FITS,
    GRAIN,
    LONGEST_LOST,
    LOST_HOP,
    NO_DROP,
    NO_HOP,
    SOON_AT_REST,
    SOON_IN_FLIGHT,
    STEADY,
)
from rockeom.integrator.transitions.candidates import (
    GROUND_SIZE,
    collide,
    end_slides,
    ground_now_and_later,
    meet,
    radius_of,
    select_by_forces,
    squared,
    start_slips,
    without_forces,
)
from rockeom.integrator.transitions.points import (
    COUPLING,
    LAWS,
    MATRIX,
    N_COORDINATES,
    POINT,
    ROWS,
    acceleration_of,
    contact_data,
    gap_rounding,
    hold_slip,
    put_on,
    rate_of,
    slip_of,
    through_mass,
)

__fused__ = False

SLOWEST = 5.0  # changes of velocity that are stepped over, in accelerations times the time
MOST_FLIGHTS = 4000  # that are followed, until few and slow ones are left
FAST = 100.0  # rates of landings that no rest takes, in accelerations times its longest time
SHORTER = 4  # times of a step over events that are tried, each a tenth of the one before


class Bounces(NamedTuple):
    """The points that bounce (N_POINTS,): 1 of those; their gaps; and 1 of those that touch now.

    The gaps are kept apart from the state, since they are lost among its last digits.
    """

    points: Ints
    heights: Floats
    near: Ints


class Hop(NamedTuple):
    """The flight, a parabola, of a point that has just left the ground, or is about to land.

    height : times the acceleration that closes the gap; zero where there is no such flight. radius
    : of gyration, of what the point moves. lost : whether the point leaves, and does not rise above
    rounding errors.
    """

    height: float
    acceleration: float
    radius: float
    lost: bool


class Flight(NamedTuple):
    """Motion until a point lands, or, with point -1, a slip ends; guard : of that event."""

    time: float
    point: int
    guard: int


class Reference(NamedTuple):
    """A landing with which those after it are compared: in the end rates shrink by one ratio.

    point, mode : which point landed, and in which mode; -1 before there is such a landing. time :
    from the start. rate : of the landing. ratio : of the last two rates that were compared. flights
    : since; after `patience` of them, and then of twice as many, another landing takes its place.
    """

    point: int
    mode: int
    time: float
    rate: float
    ratio: float
    flights: int
    patience: int


class Period(NamedTuple):
    """The flights from the reference to a landing like it.

    ratio : of the rates of these two landings. time : of the flights. remaining : time of all
    periods to come, if each is the one before times the ratio.
    """

    ratio: float
    time: float
    remaining: float


def time_of_bounces(state, tolerance, rtol, contact, out):
    """(time, mode): when the infinitely many impacts to come will all have happened.

    From a landing after which points leave what they touched. out (N,) : the state after that time,
    with these points closed. Returns (inf, mode) while the time is longer than `tolerance` times
    sqrt(l/a), a the acceleration of a point in free motion and l the radius of gyration. Lost
    flights may take LONGEST_LOST of it, and where they take longer, they end at once. The mode is
    IMPOSSIBLE or AMBIGUOUS, and the time inf, where none or several may follow that.
    """
    mode, y = state.mode, state.y
    w, dy = np.empty(N_STATES), np.empty(N_STATES)
    bouncing, near = np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS, np.int64)
    bounces = Bounces(bouncing, np.zeros(N_POINTS), near)
    rates(mode, y, state.p, *state.shaking, dy)
    start, limit, lost = slow_bounces(state, tolerance, contact, dy, bounces.points)
    if start == 0.0:
        return np.inf, mode
    total, follows = np.inf, mode
    if limit > 0.0:
        w[:N_STATES] = y
        beside_bounces(mode, limit, contact, dy, bounces)
        flying = state._replace(y=w)
        total, follows = sum_of_flights(flying, start, limit, rtol, contact, dy, bounces, out)
    if follows < 0:
        total, follows = np.inf, mode
    if lost and not total < np.inf:
        total = 0.0
        bounces.points[:N_POINTS] = 0
        # in space a point that never slips and hops as slowly as it slips has come to rest, too
        ends = start if DIRECTIONS == 3 else 0.0
        follows = all_closed(state, bounces, ends, 0.0, rtol, contact, out)
    for _ in range(N_POINTS):
        after = state._replace(mode=follows, y=out)
        if not (total < np.inf and follows >= 0 and any_lost(after, contact, dy)):
            break
        # what follows may bring back a point that left: it has no time to
        w[:N_STATES] = out
        bounces.points[:N_POINTS] = 0
        follows = all_closed(after._replace(y=w), bounces, 0.0, 0.0, rtol, contact, out)
    return (total, follows) if follows >= 0 else (np.inf, follows)


def any_lost(state, contact, dy):
    """Whether a flight that begins in a state is lost. known, dy : scratch."""
    lost = False
    rates(state.mode, state.y, state.p, *state.shaking, dy)
    points(state.y, state.p, contact)
    for i in range(N_POINTS):
        lost = lost or hop_of(i, state.mode, state.y, contact, dy).lost
    return lost


def sum_of_flights(state, start, limit, rtol, contact, dy, bounces, out):
    """(time, mode) of bounces from a state, whose y (N,) moves on to their end.

    Close to the end flights are parabolas, each from the rates of the state in which it begins, and
    the impacts between are those of any landing. They are followed until one is like another before
    it but for its speed: the rest is a geometric series then. limit : the longest time, see
    `time_of_bounces`: in a longer one, or where nothing may follow, the mode is negative. dy : the
    rates of y.
    """
    w, mode, landed = state.y, state.mode, np.zeros(N_POINTS, np.int64)
    total = last = 0.0  # time of the flights so far, and of the last one that a landing ended
    reference, w_reference = Reference(-1, -1, 0.0, 0.0, 0.0, 1, 1), np.empty(N_STATES)
    for number in range(MOST_FLIGHTS + 1):
        if number > 0:
            rates(mode, w, state.p, *state.shaking, dy)
        if have_ended(mode, bounces, start, contact, w, dy):
            break
        flight = next_flight(mode, bounces, w, contact, dy)
        # too many, or too long: it is the end only where all that still flies is no bounce
        if number == MOST_FLIGHTS:
            if fast_fly_on(mode, bounces, start, contact, dy):
                return np.inf, IMPOSSIBLE
            break
        if not total + flight.time <= limit:
            # where the last flights were nothing, some have come to their end and others fly on
            if not (last <= ENDED_FLIGHT * total and some_ended(mode, bounces.points)):
                return np.inf, IMPOSSIBLE
            break
        if flight.point >= 0:
            rate, last = contact[flight.point * POINT + 1], flight.time
            period = period_since(reference, rate, total)
            repeats = flight.point == reference.point and mode == reference.mode
            if repeats and total + period.remaining > limit:
                return np.inf, IMPOSSIBLE
            # a point that has not landed yet would be left out of the series
            if repeats and is_geometric(period, reference) and all_landed(landed, bounces.points):
                sum_series(period, w_reference, w)
                total += period.remaining
                break
            if repeats or reference.flights == reference.patience:
                ratio = period.ratio if repeats else reference.ratio
                patience = reference.patience if repeats else 2 * reference.patience
                reference = Reference(flight.point, mode, total, rate, ratio, 0, patience)
                w_reference[:N_STATES] = w
                landed[:N_POINTS] = 0
            reference = reference._replace(flights=reference.flights + 1)
        total += flight.time
        fly(mode, flight, contact, dy, bounces, w)
        for i in range(N_POINTS):
            landed[i] = max(landed[i], bounces.near[i])
        mode = mode_after_flight(state._replace(mode=mode), flight, rtol, contact, bounces, out)
        if mode < 0:
            return np.inf, mode
    return total, all_closed(state._replace(mode=mode), bounces, start, limit, rtol, contact, out)


def period_since(reference, rate, time):
    """The period that a landing ends, if it is like the reference; rate, time : of the landing."""
    ratio, duration = rate / reference.rate, time - reference.time
    # ratio + ratio**2 + ... = ratio / (1 - ratio)
    remaining = ratio / (1.0 - ratio) * duration if ratio < 1.0 else 0.0
    return Period(ratio, duration, remaining)


def is_geometric(period, reference):
    """Whether periods shrink, and by the same ratio as before.

    An error of the ratio changes the sum by as much over 1 - ratio.
    """
    ratio = period.ratio
    return 0.0 < ratio < 1.0 and abs(ratio - reference.ratio) <= STEADY * (1.0 - ratio)


def all_landed(landed, bouncing):
    """Whether all points that bounce have landed."""
    every = True
    for i in range(N_POINTS):
        every = every and landed[i] >= bouncing[i]
    return every


def mode_after_flight(state, flight, rtol, contact, bounces, out):
    """The mode after the landing, or the end of a slip, that a flight ends with; y moves there.

    Points that leave by it bounce, too.
    """
    w, p = state.y, state.p
    touched, ground = np.zeros(N_POINTS, np.int64), np.empty(GROUND_SIZE)
    touched[:N_POINTS] = bounces.near
    out[:N_STATES] = w
    points(w, p, contact)
    ground_now_and_later(state.shaking, state.shaking, SOON_IN_FLIGHT * flight.time, ground)
    follows, _ = meet(state.mode, flight.guard, bounces.near, w, p, ground, rtol, contact, out)
    if follows < 0:
        return follows
    w[N_COORDINATES:N_STATES] = out[N_COORDINATES:N_STATES]
    points(w, p, contact)
    for i in range(N_POINTS):
        if touched[i] == 1 and point_state(follows, i) == OPEN and contact[i * POINT + 1] > 0.0:
            bounces.points[i] = 1
    return follows


def hop_of(point, mode, y, contact, dy):
    """The flight of a point that begins in a state. dy (N,) : rates of the state."""
    gap, rate = contact[point * POINT], contact[point * POINT + 1]
    _, size = rate_of(contact, DIRECTIONS * point, y, 0)
    radius = radius_of(contact, point)
    a = -acceleration_of(contact, DIRECTIONS * point, dy)
    if point_state(mode, point) != OPEN or gap > GRAIN * size:
        return Hop(0.0, a, radius, False)
    height = 0.5 * rate * rate
    lost = rate > 0.0 and height < max(LOST_HOP * size, NO_HOP * radius) * a
    return Hop(height, a, radius, lost)


def slow_bounces(state, tolerance, contact, dy, bouncing):
    """(start, limit, lost): the fastest rate of points that leave, or land, and the longest time.

    bouncing (N_POINTS,) : set to 1 for these points. lost : whether a flight of theirs is. Zeros
    where no point leaves and comes back; no time where one is too fast for it.
    """
    mode, y, start = state.mode, state.y, 0.0
    all_lost, any_is_lost, returns, fast = True, False, False, False
    for i in range(N_POINTS):
        hop, rate = hop_of(i, mode, y, contact, dy), contact[i * POINT + 1]
        if hop.height == 0.0:
            continue
        bouncing[i] = 1
        start = max(start, abs(rate))
        all_lost, any_is_lost = all_lost and hop.lost, any_is_lost or hop.lost
        returns = returns or hop.acceleration > 0.0 or rate < 0.0
        highest = tolerance * tolerance * hop.radius * hop.acceleration
        fast = fast or (not hop.lost and 8.0 * hop.height > highest > 0.0)
    if not returns:
        return 0.0, 0.0, False
    if fast:
        return start, 0.0, any_is_lost
    wanted, sizes = np.empty(ROWS), np.empty(ROWS + N_POINTS)
    without_forces(y, state.p, state.shaking, mode, contact, wanted, sizes)
    most, limit = max(tolerance, LONGEST_LOST) if all_lost else tolerance, np.inf
    for i in range(N_POINTS):
        if bouncing[i] == 1:
            limit = min(limit, most * math.sqrt(radius_of(contact, i) / sizes[DIRECTIONS * i]))
    for i in range(N_POINTS):
        a, rate = -acceleration_of(contact, DIRECTIONS * i, dy), contact[i * POINT + 1]
        fastest = limit * sizes[DIRECTIONS * i]
        if bouncing[i] == 1 and (rate < -fastest or (a <= 0.0 and rate > fastest)):
            return start, 0.0, any_is_lost  # it lands at once, or leaves for good
    return start, limit, any_is_lost


def beside_bounces(mode, limit, contact, dy, bounces):
    """Let points in flight bounce, too, that land within the time of the bounces, and as slowly.

    A gap that closes much faster than accelerations close it in that time ends by its own impact.
    """
    for i in range(N_POINTS):
        gap, rate = contact[i * POINT], contact[i * POINT + 1]
        if point_state(mode, i) == OPEN and bounces.points[i] == 0:
            a = -acceleration_of(contact, DIRECTIONS * i, dy)
            slow = a > 0.0 and -rate <= FAST * limit * a
            if slow and rate + math.sqrt(rate * rate + 2.0 * a * gap) <= limit * a:
                bounces.points[i], bounces.heights[i] = 1, gap


def next_flight(mode, bounces, w, contact, dy):
    """The flight of all points from a state w to the first landing, or end of a slip."""
    landing, point = next_landing(mode, bounces, w, contact, dy)
    stop, guard = next_stop(mode, w, contact, dy)
    if stop < landing:
        return Flight(stop, -1, guard)
    return Flight(landing, point, landing_of(mode, point))


def next_landing(mode, bounces, w, contact, dy):
    """(time, point) of the next landing of those that bounce: (inf, -1) where none lands by itself.

    A gap that opens faster and faster waits for the landing of another.
    """
    first, point = np.inf, -1
    for i in range(N_POINTS):
        if bounces.points[i] == 0 or point_state(mode, i) != OPEN:
            continue
        height, a = bounces.heights[i], -acceleration_of(contact, DIRECTIONS * i, dy)
        rate, size = rate_of(contact, DIRECTIONS * i, w, N_COORDINATES)
        if height == 0.0 and -FITS * size <= rate < 0.0:
            rate = 0.0  # it would land again and again, and nothing would change
        square = rate * rate + 2.0 * a * height
        time = np.inf
        if rate < 0.0 and square >= 0.0:
            time = 2.0 * height / (math.sqrt(square) - rate)
        elif a > 0.0:
            time = (rate + math.sqrt(square)) / a
        if time < first:
            first, point = time, i
    return first, point


def next_stop(mode, w, contact, dy):
    """(time, guard) of the next end of a slip, as friction and what else acts now slow it."""
    time, guard = np.inf, -1
    for i in range(guards_in(mode)):
        if kind_of(mode, i) != STICKING:
            continue
        point = subject_of(mode, i)
        sign = SIGN_OF[point_state(mode, point)]
        slip, _ = rate_of(contact, DIRECTIONS * point + 1, w, N_COORDINATES)
        slows = -sign * acceleration_of(contact, DIRECTIONS * point + 1, dy)
        lasts = max(sign * slip, 0.0) / slows if slows > 0.0 else np.inf
        if lasts < time:
            time, guard = lasts, i
    return time, guard


def landing_of(mode, point):
    """The guard of a point's landing."""
    guard = -1
    for i in range(guards_in(mode)):
        if kind_of(mode, i) == LANDING and subject_of(mode, i) == point:
            guard = i
    return guard


def speed_of(point, heights, contact, dy):
    """The rate at which a point lands that bounces."""
    rate, a = contact[point * POINT + 1], -acceleration_of(contact, DIRECTIONS * point, dy)
    return math.sqrt(rate * rate + 2.0 * max(a, 0.0) * heights[point])


def have_ended(mode, bounces, start, contact, w, dy):
    """Whether nothing but the digits of other velocities is left of those of the bounces."""
    fastest = whole = 0.0
    for i in range(N_POINTS):
        if bounces.points[i] == 1 and point_state(mode, i) == OPEN:
            fastest = max(fastest, speed_of(i, bounces.heights, contact, dy))
        _, speed = rate_of(contact, DIRECTIONS * i, w, N_COORDINATES)
        whole = max(whole, speed)
    return fastest <= max(ENDED * start, ENDED_OF_ALL * whole)


def fast_fly_on(mode, bounces, start, contact, dy):
    """Take the bounces back of points that are as fast as at the start: whether all are.

    start : the rate of the fastest then.
    """
    every, bouncing = True, bounces.points
    for i in range(N_POINTS):
        if bouncing[i] == 1 and point_state(mode, i) == OPEN:
            bouncing[i] = 0 if speed_of(i, bounces.heights, contact, dy) > start else 1
        every = every and bouncing[i] == 0
    return every


def some_ended(mode, bouncing):
    """Whether some points that bounced are closed. For those still in flight it is undone."""
    ended = False
    for i in range(N_POINTS):
        if bouncing[i] == 1 and point_state(mode, i) == OPEN:
            bouncing[i] = 0
        else:
            ended = ended or bouncing[i] == 1
    return ended


def fly(mode, flight, contact, dy, bounces, w):
    """Move a state w to the next landing, and say which points touch there, in `bounces.near`."""
    n, heights, near, time = N_COORDINATES, bounces.heights, bounces.near, flight.time
    for i in range(N_POINTS):
        near[i] = 1 if point_state(mode, i) != OPEN else 0
        if bounces.points[i] == 1 and near[i] == 0:
            rise = contact[i * POINT + 1] * time
            drop = -0.5 * acceleration_of(contact, DIRECTIONS * i, dy) * time * time
            heights[i] += rise - drop
            if i == flight.point or heights[i] <= NO_DROP * drop:
                heights[i], near[i] = 0.0, 1
    for i in range(n):
        w[i] += time * (w[n + i] + 0.5 * time * dy[n + i])
        w[n + i] += time * dy[n + i]


def sum_series(period, w_before, w):
    """Move a state w on through periods each of which is the one before times a ratio.

    w_before : a period before w. A velocity is the one at the end, and a part that shrinks with
    each period: so a place moves by the first times the period, and by the second as its square.
    """
    n, ratio = N_COORDINATES, period.ratio
    left, left_of_squares = ratio / (1.0 - ratio), ratio * ratio / (1.0 - ratio * ratio)
    for i in range(n):
        w[n + i] += left * (w[n + i] - w_before[n + i])
        along_ = period.time * w[n + i]
        w[i] += left * along_ + left_of_squares * (w[i] - w_before[i] - along_)


def all_closed(state, bounces, start, time, rtol, contact, out):
    """The mode that follows once all points that bounce are closed, or a negative number.

    So are others whose flights are lost. state : until then; out : its y with them closed, and with
    slips ended, see `close_and_end_slips`. contact : scratch.
    """
    here, w, p, shaking = state
    near = bounces.near
    sizes, dy = np.empty(ROWS + N_POINTS), np.empty(N_STATES)
    rows, wanted, sliding = np.zeros(ROWS, np.int64), np.zeros(ROWS), np.zeros(N_POINTS)
    out[:N_STATES] = w
    contact_data(out, p, here, contact)
    rates(here, w, p, *shaking, dy)
    without_forces(out, p, shaking, here, contact, wanted, sizes)
    for i in range(N_POINTS):
        lost = hop_of(i, here, w, contact, dy).lost
        closed = lost or bounces.points[i] == 1 or point_state(here, i) != OPEN
        near[i] = 1 if closed else 0
        if closed:
            rows[DIRECTIONS * i], wanted[DIRECTIONS * i] = 1, -contact[i * POINT]
    put_on(rows, wanted, 0, contact, out)
    points(out, p, contact)
    rounding = gap_rounding(contact, out)
    for i in range(N_POINTS):
        gap, rate = contact[i * POINT], contact[i * POINT + 1]
        if near[i] == 0 and (gap <= 0.0 >= rate or (gap <= rounding and rate < 0.0)):
            return IMPOSSIBLE  # it landed before
        if near[i] == 0:
            continue
        wanted[DIRECTIONS * i] = -contact[i * POINT + 1]
        if point_state(here, i) == STICK:
            hold_slip(contact, i, out, rows, wanted)
    close_and_end_slips(here, near, start, time, contact, sizes, rows, wanted, sliding, out)
    points(out, p, contact)
    ground = np.empty(GROUND_SIZE)
    ground_now_and_later(shaking, shaking, SOON_AT_REST, ground)
    follows = select_by_forces(here, False, near, sliding, out, p, ground, rtol, contact, sizes)
    start_slips(follows, sliding, out, p, shaking, rtol, contact)
    return follows


def close_and_end_slips(here, near, start, time, contact, sizes, rows, wanted, sliding, out):
    """Close points, and end slips that are slower than `start`, or that friction stops in `time`.

    rows, wanted : what closes the points, and is changed. sliding : set for the slips that go on;
    all of them do where they end only together with faster motions, since those take longer.
    """
    n = N_COORDINATES
    held, ends = np.empty(N_COORDINATES), np.zeros(N_POINTS, np.int64)
    for i in range(N_POINTS):
        if near[i] == 0 or is_smooth(i) or point_state(here, i) == STICK:
            continue
        slip, _ = slip_of(contact, i, out, n)
        sliding[i] = 1.0 if slip > 0.0 else -1.0
    end_slides(near, sliding, contact, out, rows, wanted)
    for i in range(N_POINTS):
        if sliding[i] == 0.0:
            continue
        slip, size = slip_of(contact, i, out, n)
        friction = contact[LAWS + 2 * i + 1]
        slows = min(friction, 1.0) * sizes[DIRECTIONS * i] if friction < NEVER_SLIPS else 0.0
        ends[i] = 1 if abs(slip) <= max(start, time * slows) + FITS * size else 0
    put_on(rows, wanted, n, contact, out)
    by_itself = 0.0
    for i in range(N_POINTS):
        for axis in range(DIRECTIONS):
            wanted[DIRECTIONS * i + axis] = 0.0
        if ends[i] == 1:
            row = DIRECTIONS * i + 1
            slip, size = slip_of(contact, i, out, n)
            hold_slip(contact, i, out, rows, wanted)
            least = max(abs(slip), FITS * size)
            by_itself += least * least / contact[COUPLING + row * ROWS + row]
    held[:n] = out[n:N_STATES]
    put_on(rows, wanted, n, contact, out)
    for i in range(n):
        held[i] -= out[n + i]
    together = squared(contact, held) > SLOWEST * SLOWEST * by_itself
    for i in range(n):
        if together:
            out[n + i] += held[i]
    for i in range(N_POINTS):
        if ends[i] == 1 and not together:
            sliding[i] = 0.0


def step_over(state, tolerance, longest, fits, rtol, contact, out):
    """(time, mode): a step over events without end, or over one that nothing may follow.

    In `tolerance` times sqrt(l/a), see `time_of_bounces`, but no more than `longest`, and in a
    shorter time where a faster landing lies within it. out (N,) : the state after it. The time is
    inf, and the mode IMPOSSIBLE or AMBIGUOUS, where no impulses fit, where they change
    velocities by more than accelerations can in such a time, or, if `fits`, where no forces fit
    after it.
    """
    wanted, sizes = np.empty(ROWS), np.empty(ROWS + N_POINTS)
    mode, y, p = state.mode, state.y, state.p
    contact_data(y, p, mode, contact)
    whole = without_forces(y, p, state.shaking, mode, contact, wanted, sizes)
    time, taken, follows = np.inf, np.inf, IMPOSSIBLE
    for i in range(N_POINTS):
        time = min(time, math.sqrt(radius_of(contact, i) / sizes[DIRECTIONS * i]))
    time = min(tolerance * time, longest)
    for _ in range(SHORTER):
        if not taken < np.inf:
            taken, follows = step_of_moreau(state, time, whole, sizes, fits, rtol, contact, out)
            time *= 0.1
    return taken, follows


def step_of_moreau(state, time, whole, sizes, fits, rtol, contact, out):
    """(time, mode) of a time step of Moreau, or inf, see `step_over`.

    Velocities change by what moves the structure freely, and by impulses at the points that touch,
    which do not bounce. whole, sizes : of `without_forces`.
    """
    mode, y, p, shaking = state
    n, w, dy = N_COORDINATES, np.empty(N_STATES), np.empty(N_STATES)
    forces, near = np.empty(N_COORDINATES), np.zeros(N_POINTS, np.int64)
    contact_data(y, p, mode, contact)
    rates(mode, y, p, *shaking, dy)
    free_motion(y, p, *shaking, mode, contact[MATRIX:], forces)
    through_mass(contact[MATRIX:], forces, 1)
    for i in range(n):
        massless = contact[MATRIX + i * n + i] == 0.0
        w[n + i] = y[n + i] + time * (dy[n + i] if massless else forces[i])
    alike = np.inf
    for i in range(N_POINTS):
        gap, rate = contact[i * POINT], contact[i * POINT + 1]
        falls, _ = rate_of(contact, DIRECTIONS * i, w, n)
        least = gap + time * min(rate, min(falls, 0.0)) - time * time * sizes[DIRECTIONS * i]
        _, size = rate_of(contact, DIRECTIONS * i, y, 0)
        near[i] = 1 if point_state(mode, i) != OPEN or least <= GRAIN * size else 0
        if near[i] == 1:
            alike = min(alike, time * time * sizes[ROWS + i] * sizes[DIRECTIONS * i])
        contact[LAWS + 2 * i] = 0.0  # restitution
    as_said = collide(mode, near, alike, contact, w)
    if as_said < 0:
        return np.inf, as_said
    for i in range(n):
        forces[i] = w[n + i] - y[n + i]
        w[i] = y[i] + time * w[n + i]
    if squared(contact, forces) > SLOWEST * SLOWEST * time * time * whole:
        return np.inf, IMPOSSIBLE
    none = Bounces(np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS), near)
    after = state._replace(mode=as_said, y=w)
    follows = all_closed(after, none, 0.0, time, rtol, contact, out)
    if follows < 0 and fits:
        return np.inf, follows
    return time, follows if follows >= 0 else as_said
