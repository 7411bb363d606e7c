"""Points that touch in space: which modes may follow, and the impulses or forces of each.

A point is smooth, never slips, or slips with Coulomb's friction. Some that touch may be idle: the
others bear the load without them. One that never slips, and would have to, may be released, so that
it bears without friction. The contract of points, as points_in_plane.py fulfils it.
"""

import math

import numpy as np

from rockeom.codes import BEARS, IDLES, LIFTING, NEVER_SLIPS, NO_MORE, OPEN, RELEASED, STICKING
from rockeom.compiler.decorators import inlined, rolled
from rockeom.generated.numeric_modes import (
    LEAST_PART_OF_TURN,
    PLACE_VALUES,
    REDUNDANT,
    any_rubs,
    digit_along,
    digit_of,
    hold,
    is_smooth_by,
    least_friction,
    rubs_by,
    slips_by,
    solve_by_rows,
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
from rockeom.integrator.tolerances import (
    A_PIVOT,
    ABOUT_TO_SLIP,
    FIRST_SLIP,
    FROM_REST,
    JUST_SLIPS,
    LEAST_FIRST_SLIP,
    LEAST_SIZE,
    LEAST_YIELD,
    MOST_FIRST_SLIP,
    NEARLY,
    NO_TURN,
    OF_YIELDS,
    SAME_DIRECTION,
    STOPPED,
    SWEPT,
)
from rockeom.integrator.transitions.points import (
    CONTACT_SIZE,
    COUPLING,
    LAWS,
    MATRIX,
    N_COORDINATES,
    POINT,
    ROWS,
    exceeds,
    rate_of,
    row_of_point,
    slip_of,
)

__fused__ = False

CHOICES = [np.base_repr(i, 3) for i in range(3**N_POINTS)]  # of a state for each point that is near
OPENS_IN = np.array([choices.count("2") for choices in CHOICES])
CHANGES_IN = np.array([choices.count("1") for choices in CHOICES])  # that slip, or are released
# Of no point, one, two ...: choices in the order in which they are tried, fewer open ones first
IN_TURN = np.concatenate([np.argsort(OPENS_IN[: 3**m], kind="stable") for m in range(N_POINTS + 1)])
UNCHANGED_IN_TURN = IN_TURN[
    CHANGES_IN[IN_TURN] == 0
]  # of these, what neither slips nor is released
SIGN_OF = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # by the state of a point
MOST_ITERATIONS = 40  # for the directions of slips that are not known
FIRST_TURNS = 3  # of them, before those after Newton
MOST_HALVES = 70  # of yields, which are within 36 powers of ten
MOST_SWEEPS = 1000  # over points, towards impulses that suit one another
MOST_PROJECTIONS = 4000  # onto their cones, where sweeps have no end
MOST_CHANGE = 2.0  # of the logarithm of a yield, in one of them


def is_smooth(point):
    """Whether a point has no friction whatever the parameters are."""
    return is_smooth_by(SMOOTH, point)


@inlined
def rubs(point, contact):
    """Whether a point may slip with friction."""
    return rubs_by(SMOOTH, contact[LAWS:], point)


@rolled
def candidate_of(number, extra, mode, near, sliding, wanted, contact, impulse):
    """A mode that may follow, with its impulses (ROWS,), or -1, or NO_MORE from a number on.

    The number says which of the points that are near bear, slip, or are open, none of them first,
    since the mode that keeps more points closed follows; and whether points that would bear nothing
    are idle. In place of a slip one that never does is released: extra is twice the number of
    these, less one where only points are that would pull if they stuck. One that slips already is
    released already.
    """
    place, none_slips = int(number * 0.5), not any_rubs(N_POINTS, SMOOTH, contact[LAWS:])
    of_point, sets = 2 if none_slips and extra == 0 else 3, 1
    for i in range(N_POINTS):
        sets *= of_point if near[i] == 1 else 1
    if place >= sets:
        return NO_MORE
    if of_point == 2:
        left = UNCHANGED_IN_TURN[sets - 1 + place]
    else:
        left = IN_TURN[int(sets * 0.5) + place]
    released = int(0.5 * (extra + 1.0))
    if extra > 2 * CHANGES_IN[left] or (CHANGES_IN[left] != released and none_slips):
        return -1
    share, motion, idle = np.empty(ROWS), np.empty(N_COORDINATES), number - 2 * int(number * 0.5)
    candidate, freed, more, unknown = chosen_states(left, near, sliding, contact)
    if candidate < 0 or more != released:
        return -1
    if extra < 2 * more and not would_pull(candidate, candidate + freed, wanted, contact, share):
        return -1
    candidate += freed
    if idle == 1 and not some_nearly_idle(candidate, impulse):
        return -1  # `impulse` is of the number before, with the same choices
    if unknown:
        candidate = with_directions(candidate, sliding, wanted, contact, share, motion)
        if candidate < 0:
            return -1
    shares_in(candidate, wanted, contact, share)
    for _ in range(3 * N_POINTS):
        which = wrongly_loaded(candidate, 0.0, contact, share)
        if which < 0:
            break
        candidate += changed_digit(candidate, which, sliding, contact)
        shares_in(candidate, wanted, contact, share)
    if idle == 1:
        which = wrongly_loaded(candidate, NEARLY, contact, share)
        if which < 0 or digit_of(candidate, which) == IDLES:
            return -1
        candidate += changed_digit(candidate, which, sliding, contact)
        shares_in(candidate, wanted, contact, share)
    but_of_idle(candidate, share, impulse)
    return candidate


def chosen_states(choices, near, sliding, contact):
    """(candidate, freed, more, unknown): the mode of a state for each point that is near, or -1.

    freed : by how much its number grows where the points are released that would slip and never
    do, and more : how many these are. unknown : some slips have no direction yet.
    """
    candidate, freed, more, unknown, left = 0, 0, 0, False, choices
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        third = int(left / 3)
        choice, left = left - 3 * third, third
        moves, friction = sliding[i] != 0.0, rubs(i, contact)
        if choice == 2:
            continue
        if choice == 1 and (is_smooth(i) or (moves and not friction)):
            return -1, 0, 0, False
        elif choice == 1 and not friction:
            candidate += BEARS * PLACE_VALUES[i]
            freed, more = freed + (RELEASED - BEARS) * PLACE_VALUES[i], more + 1
        elif choice == 1:
            candidate, unknown = candidate + digit_of_slip(i, contact) * PLACE_VALUES[i], True
        elif moves and friction:
            return -1, 0, 0, False
        else:
            slips = moves and not is_smooth(i)
            candidate += (RELEASED if slips else BEARS) * PLACE_VALUES[i]
    return candidate, freed, more, unknown


@inlined
def some_nearly_idle(candidate, impulse):
    """Whether a point that is to bear has next to no normal impulse."""
    largest, least = 0.0, np.inf
    for i in range(N_POINTS):
        largest = max(largest, abs(impulse[DIRECTIONS * i]))
        if digit_of(candidate, i) != OPEN:
            least = min(least, impulse[DIRECTIONS * i])
    return not least > NEARLY * largest


@inlined
def digit_of_slip(point, contact):
    """The digit of a point that slips as it does now."""
    at = point * POINT
    return digit_along(contact[at + 2], contact[at + 3])


@rolled
def with_directions(candidate, sliding, wanted, contact, share, motion):
    """The mode with the directions of slips that begin, or that an impact leaves, or -1.

    Friction opposes the slip that follows it, which is not known before. Such points are held as by
    dampers along the ground, T = -c w with c = mu N/|w|, whose yields 1/c are found by iteration:
    first by themselves, then after Newton. The directions go into the rates of slips in `contact`,
    where those that are known stand. motion (n,) : with which the points slip, see `yielding`.
    """
    held, alone, yields = np.empty(ROWS), np.zeros(N_POINTS), np.zeros(N_POINTS)
    stuck, free = candidate, candidate
    for i in range(N_POINTS):
        digit = digit_of(candidate, i)
        if slips_by(digit) and sliding[i] == 0.0:
            stuck += (BEARS - digit) * PLACE_VALUES[i]
            free += (RELEASED - digit) * PLACE_VALUES[i]
            alone[i] = contact[COUPLING + (DIRECTIONS * i + 1) * (ROWS + 1)]
    shares_in(stuck, wanted, contact, held)
    if not first_yields(stuck, alone, contact, held, yields):
        after = np.empty(ROWS)
        swept(stuck, sliding, wanted, contact, share, after)
        for i in range(N_POINTS):
            if alone[i] > 0.0:
                u, v = after[DIRECTIONS * i + 1], after[DIRECTIONS * i + 2]
                bound = max(bound_of(i, contact, share), LEAST_SIZE)
                yields[i] = max(math.sqrt(u * u + v * v) / bound, LEAST_YIELD * alone[i])
    softer, excess, worst = np.empty(CONTACT_SIZE), np.zeros(N_POINTS), np.inf
    for turn in range(MOST_ITERATIONS):
        yielding(free, alone, yields, held, contact, softer, share, motion)
        worst = excess_of_dampers(alone, yields, contact, share, motion, excess)
        if not worst > SAME_DIRECTION or not worst < np.inf:
            break
        if turn < FIRST_TURNS:
            for i in range(N_POINTS):
                yields[i] *= 1.0 + excess[i]
        else:
            after_newton(free, alone, yields, held, contact, softer, share, excess)
        if are_least(alone, yields):
            yielding(free, alone, yields, held, contact, softer, share, motion)
            worst = excess_of_dampers(alone, yields, contact, share, motion, excess)
            if worst <= JUST_SLIPS:
                break
            if none_exceeds(alone, excess):
                return -1
    if not worst <= JUST_SLIPS:
        worst = halved(free, alone, yields, held, contact, softer, share, motion, excess)
    if not worst <= JUST_SLIPS:
        return -1
    fastest = 0.0
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            speed, _ = slip_of(contact, i, motion, 0)
            fastest = max(fastest, speed)
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            u, _ = rate_of(contact, DIRECTIONS * i + 1, motion, 0)
            v, _ = rate_of(contact, DIRECTIONS * i + 2, motion, 0)
            speed = math.sqrt(u * u + v * v)
            if not speed > A_PIVOT * LEAST_PART_OF_TURN * fastest:
                return -1  # others turn about it, and it sticks
            contact[i * POINT + 2], contact[i * POINT + 3] = u / speed, v / speed
            stuck += (digit_of_slip(i, contact) - BEARS) * PLACE_VALUES[i]
    return stuck


@rolled
def halved(free, alone, yields, held, contact, softer, share, motion, excess):
    """The excess left of a damper that is the only one, its yield found by halving; else inf.

    Where it yields little it has too much friction, or the point would pull, and too little where
    it yields much: whatever the friction, it slips in between.
    """
    point, count, worst = 0, 0, np.inf
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            point, count = i, count + 1
    low, high = LEAST_YIELD * alone[point], alone[point] / LEAST_YIELD
    for turn in range(MOST_HALVES if count == 1 else 0):
        middle = math.sqrt(low * high)
        yields[point] = low if turn == 0 else (high if turn == 1 else middle)
        yielding(free, alone, yields, held, contact, softer, share, motion)
        worst = excess_of_dampers(alone, yields, contact, share, motion, excess)
        yields_more = excess[point] > 0.0 or not worst < np.inf
        if turn < 2 and yields_more != (turn == 0):
            return np.inf  # friction holds it, or would have to be more
        if turn >= 2 and yields_more:
            low = middle
        elif turn >= 2:
            high = middle
    return worst


@rolled
def first_yields(stuck, alone, contact, held, yields):
    """Where the iteration of `with_directions` begins, (N_POINTS,); whether they are about to slip.

    In the ratios of `least_friction`, and as large as that of one of these points alone would be.
    alone (N_POINTS,) : how freely each of them moves along the ground; 0 of others.
    """
    c, most, largest = np.zeros(N_POINTS), 0.0, 0.0
    part = least_friction(stuck, N_COORDINATES, N_POINTS, SMOOTH, contact, held, c)
    if part > 1.0 + ABOUT_TO_SLIP:
        return False
    for i in range(N_POINTS):
        largest = max(largest, bound_of(i, contact, held))
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            if not (bound_of(i, contact, held) > NEARLY * largest and c[i] > 0.0):
                return False  # a point that lifts as it begins to slip, too
            most = max(most, 1.0 / (c[i] * alone[i]))
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            yields[i] = max(part - 1.0, LEAST_YIELD) / (c[i] * most)
    return True


@rolled
def swept(candidate, sliding, wanted, contact, impulse, rates_after):
    """Impulses, or forces, of points that may press, by sweeps over them, and what follows.

    Those of a candidate that are not open may open, stick or slip, each as suits the others: a
    sweep changes the normal one of each by what closes its gap, and its friction towards what stops
    its slip, within its bound (Gauss and Seidel, with projections). So it tells what is likely, but
    for rounding; a slip that goes on has its direction. impulse (ROWS,), and rates_after (ROWS,),
    by which gaps and slips then change, or their rates.
    """
    change, largest = np.inf, LEAST_SIZE
    for r in range(ROWS):
        impulse[r] = 0.0
    for _ in range(MOST_SWEEPS):
        if change <= SWEPT * largest:
            break
        change, largest = 0.0, LEAST_SIZE
        for i in range(N_POINTS):
            if digit_of(candidate, i) == OPEN:
                continue
            row = DIRECTIONS * i
            own = contact[COUPLING + row * (ROWS + 1)]
            before = impulse[row]
            impulse[row] = max(before - exceeds(row, wanted, contact, impulse) / own, 0.0)
            change = max(change, abs(impulse[row] - before))
            largest = max(largest, impulse[row])
            if not is_smooth(i):
                change = max(change, rubbed(i, sliding, wanted, contact, impulse))
    if change > SWEPT * largest:
        projected(candidate, sliding, wanted, contact, impulse)
    for r in range(ROWS):
        rates_after[r] = exceeds(r, wanted, contact, impulse)


@rolled
def projected(candidate, sliding, wanted, contact, impulse):
    """The same as `swept` where sweeps go round in circles, as they may where friction is large.

    The impulse of a point changes against its velocity, that of the gap raised by mu times that of
    the slip, and is projected onto the cone of friction (de Saxce and Feng, 1998), in small steps.
    """
    for _ in range(MOST_PROJECTIONS):
        change, largest = 0.0, LEAST_SIZE
        for i in range(N_POINTS):
            if digit_of(candidate, i) == OPEN:
                continue
            row, mu, own = DIRECTIONS * i, contact[LAWS + 2 * i + 1], 0.0
            for k in range(DIRECTIONS):
                own += contact[COUPLING + (row + k) * (ROWS + 1)]
            normal, before = exceeds(row, wanted, contact, impulse), impulse[row]
            if sliding[i] != 0.0 or not rubs(i, contact):
                impulse[row] = max(before - normal / own, 0.0)
                if not is_smooth(i):
                    rubbed(i, sliding, wanted, contact, impulse)
            else:
                u = exceeds(row + 1, wanted, contact, impulse)
                v = exceeds(row + 2, wanted, contact, impulse)
                x, y = impulse[row + 1] - u / own, impulse[row + 2] - v / own
                press = before - (normal + mu * math.sqrt(u * u + v * v)) / own
                size = math.sqrt(x * x + y * y)
                if size > mu * press:
                    press = max((mu * size + press) / (1.0 + mu * mu), 0.0)
                    x, y = mu * press * x / size, mu * press * y / size
                impulse[row], impulse[row + 1], impulse[row + 2] = press, x, y
            change, largest = max(change, abs(impulse[row] - before)), max(largest, impulse[row])
        if change <= SWEPT * largest:
            break


def rubbed(point, sliding, wanted, contact, impulse):
    """Change the friction of a point towards what stops its slip; by how much that was."""
    row, at = DIRECTIONS * point, point * POINT
    before_x, before_y = impulse[row + 1], impulse[row + 2]
    bound = bound_of(point, contact, impulse)
    x, y = -contact[at + 2], -contact[at + 3]
    if sliding[point] == 0.0:
        own = 0.0
        for k in range(1, DIRECTIONS):
            own += contact[COUPLING + (row + k) * (ROWS + 1)]
        x = before_x - exceeds(row + 1, wanted, contact, impulse) / own
        y = before_y - exceeds(row + 2, wanted, contact, impulse) / own
    size = math.sqrt(x * x + y * y)
    within = bound / size if size > bound or sliding[point] != 0.0 else 1.0
    impulse[row + 1], impulse[row + 2] = within * x, within * y
    return abs(within * x - before_x) + abs(within * y - before_y)


@rolled
def are_least(alone, yields):
    """Whether all yields are so small that points are about to slip: the least are kept then."""
    most = 0.0
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            most = max(most, yields[i] / alone[i])
    if most >= LEAST_YIELD or most == 0.0:
        return False
    for i in range(N_POINTS):
        yields[i] *= LEAST_YIELD / most
    return True


@rolled
def none_exceeds(alone, excess):
    """Whether friction holds all points that were to slip, but for rounding."""
    most = -np.inf
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            most = max(most, excess[i])
    return most < -JUST_SLIPS


@rolled
def excess_of_dampers(alone, yields, contact, share, motion, excess):
    """Excess of dampers over friction, c |w|/(mu N) - 1, and the largest; inf of what pulls."""
    worst = 0.0
    excess[:N_POINTS] = 0.0
    for i in range(N_POINTS):
        if alone[i] > 0.0:
            u, _ = rate_of(contact, DIRECTIONS * i + 1, motion, 0)
            v, _ = rate_of(contact, DIRECTIONS * i + 2, motion, 0)
            bound = bound_of(i, contact, share)
            if not (bound > 0.0 and yields[i] > 0.0):
                return np.inf
            excess[i] = math.sqrt(u * u + v * v) / (yields[i] * bound) - 1.0
            worst = max(worst, abs(excess[i]))
    return worst


@rolled
def after_newton(free, alone, yields, held, contact, softer, share, excess):
    """One step of Newton towards yields without an excess, in their logarithms.

    The first unknown is of all of them at once, on which little depends where slips just begin.
    """
    b, motion = np.zeros(N_POINTS * (N_POINTS + 1)), np.empty(N_COORDINATES)
    changed, size, trial = np.empty(N_POINTS), N_POINTS + 1, np.empty(N_POINTS)
    first = -1
    for j in range(N_POINTS):
        b[j * size + j] = 1.0
        b[j * size + N_POINTS] = -excess[j]
        first = j if first < 0 and alone[j] > 0.0 else first
    for j in range(N_POINTS):
        if alone[j] > 0.0:
            for i in range(N_POINTS):
                both = i == j or j == first
                trial[i] = yields[i] * (1.0 + OF_YIELDS if both else 1.0)
            yielding(free, alone, trial, held, contact, softer, share, motion)
            excess_of_dampers(alone, trial, contact, share, motion, changed)
            for i in range(N_POINTS):
                if alone[i] > 0.0:
                    b[i * size + j] = (changed[i] - excess[i]) / OF_YIELDS
    solve_by_rows(N_POINTS, b)
    for j in range(N_POINTS):
        own, of_all = b[j * size + N_POINTS], b[first * size + N_POINTS]
        step = max(min(of_all, MOST_CHANGE), -MOST_CHANGE)
        step += max(min(own, MOST_CHANGE), -MOST_CHANGE) if j != first else 0.0
        yields[j] *= math.exp(step)


@rolled
def yielding(free, alone, yields, held, contact, softer, share, motion):
    """Motion (n,) of points on dampers apart from that where all stick, and the shares then.

    held, share (ROWS,) : with no slip, and with it, but for the forces of the dampers. free : the
    mode in which dampers alone hold these points along the ground. Where those are stiff the motion
    is small, and known as exactly as a large one: (M + J' c J) motion = J' (share - held).
    """
    n, matrix = N_COORDINATES, softer[MATRIX:]
    softer[:] = contact
    unbalanced, nothing = np.zeros(N_COORDINATES), np.zeros(ROWS)
    for i in range(N_POINTS):
        for k in range(1, DIRECTIONS):
            row = DIRECTIONS * i + k
            start = row_of_point(row)
            for j in range(n):
                if alone[i] > 0.0:
                    unbalanced[j] -= contact[start + j] * held[row]
                    for m in range(n):
                        lever = contact[start + j] * contact[start + m]
                        matrix[j * n + m] += lever / yields[i]
    forces_in(free, unbalanced, nothing, softer, motion, share)
    for r in range(ROWS):
        share[r] += held[r]


@inlined
def bound_of(point, contact, share):
    """The largest friction of a point."""
    return contact[LAWS + 2 * point + 1] * share[DIRECTIONS * point]


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


def wrongly_loaded(candidate, tolerance, contact, share):
    """A point that would pull and may be idle, or that is idle and would bear; or -1.

    The one of which that is most so, a force below `tolerance` of the largest being none. share
    (ROWS,) : of `shares_in`.
    """
    largest, idle, loaded = 0.0, -1, -1
    for i in range(N_POINTS):
        largest = max(largest, abs(share[DIRECTIONS * i]))
    most = most_of_loaded = NEARLY * largest
    for i in range(N_POINTS):
        digit, force = digit_of(candidate, i), share[DIRECTIONS * i]
        if digit == IDLES and force > most:
            most, idle = force, i
        elif digit not in (OPEN, IDLES, RELEASED):
            pull = 2.0 * tolerance * largest - force
            if pull > most_of_loaded:
                most_of_loaded, loaded = pull, i
    if loaded >= 0 and most_of_loaded > most and has_spare_point(candidate, contact):
        return loaded
    return idle


@inlined
def changed_digit(mode, point, sliding, contact):
    """Gain of the number of a mode where a point that bears is idle, or the other way."""
    digit, changed = digit_of(mode, point), IDLES
    if digit == IDLES:
        slips = sliding[point] != 0.0 and rubs(point, contact)
        changed = digit_of_slip(point, contact) if slips else BEARS
    return (changed - digit) * PLACE_VALUES[point]


def impulses_of(candidate, wanted, contact, impulse):
    """The impulses, or forces, with which points come to be as a mode says, (ROWS,).

    wanted (ROWS,) : changes of the velocities, or accelerations, where points are closed. Slips
    have the directions of their rates in `contact`.
    """
    share = np.empty(ROWS)
    shares_in(candidate, wanted, contact, share)
    but_of_idle(candidate, share, impulse)


def but_of_idle(candidate, share, impulse):
    """The impulses that act: what idle points would have is none."""
    for r in range(ROWS):
        idle = digit_of(candidate, int(r / DIRECTIONS)) == IDLES
        impulse[r] = 0.0 if idle else share[r]


def shares_in(candidate, wanted, contact, share):
    """Impulses, or forces, in each row that is held, into share (ROWS,); how many are independent.

    The normal one of a point that is idle is the one that it would have.
    """
    nothing, change = np.zeros(N_COORDINATES), np.empty(N_COORDINATES)
    return forces_in(candidate, nothing, wanted, contact, change, share)


@rolled
def forces_in(candidate, forces, wanted, contact, change, share):
    """`shares_in` where forces (n,) act, too, and the change of the velocities (n,)."""
    bias = np.empty(ROWS)
    for r in range(ROWS):
        bias[r] = -wanted[r]
    return hold(
        candidate, N_COORDINATES, N_POINTS, SMOOTH, contact[MATRIX:], forces, contact, bias, change,
        share,
    )  # fmt: skip


@rolled
def has_spare_point(candidate, contact):
    """Whether a point may cease to bear, and the others keep its gap closed."""
    bearing, count = np.zeros(N_POINTS, np.int64), 0
    for i in range(N_POINTS):
        if digit_of(candidate, i) not in (OPEN, IDLES):
            bearing[i], count = 1, count + 1
    return independent_gaps(bearing, contact) < count


def slides_end(near, sliding, contact):
    """Whether points of near (N_POINTS,) that slide, and never do, stick again.

    They were released. A body that stands flat on them, where they hold all gaps, would slide as on
    ice until it is struck, and no shaking would make it rock: there the slide ends at once.
    """
    released, all_ = False, np.empty(N_POINTS, np.int64)
    for i in range(N_POINTS):
        never, all_[i] = contact[LAWS + 2 * i + 1] >= NEVER_SLIPS, 1
        released = released or (sliding[i] != 0.0 and never)
    if not released:
        return False
    held = independent_gaps(near, contact)
    return held >= 3 and held == independent_gaps(all_, contact)


@rolled
def independent_gaps(near, contact):
    """How many rows of gaps of the points of near (N_POINTS,) are independent.

    Nothing but rounding is left of the others by Gram and Schmidt.
    """
    n, kept, rows = N_COORDINATES, 0, np.empty(N_POINTS * N_COORDINATES)
    for i in range(N_POINTS):
        if near[i] == 0:
            continue
        first, last, whole = row_of_point(DIRECTIONS * i), kept * n, 0.0
        for j in range(n):
            rows[last + j] = contact[first + j]
            whole += contact[first + j] ** 2
        for k in range(kept):
            along_ = 0.0
            for j in range(n):
                along_ += rows[k * n + j] * rows[last + j]
            for j in range(n):
                rows[last + j] -= along_ * rows[k * n + j]
        left = 0.0
        for j in range(n):
            left += rows[last + j] ** 2
        if left <= REDUNDANT * whole:
            continue
        for j in range(n):
            rows[last + j] /= math.sqrt(left)
        kept += 1
    return kept


@inlined
def has_idle_point(candidate):
    """Whether a point is idle, which has no impulse but a share that it would have."""
    idle = False
    for i in range(N_POINTS):
        idle = idle or digit_of(candidate, i) == IDLES
    return idle


def margin_of(candidate, near, sliding, wanted, contact, sizes, impulse, least_of_all):
    """The least margin by which impulses, or forces, fit; negative where they do not.

    They press, and open points leave; idle ones stay, and would pull; those that stick use no more
    than their friction, and those that begin to slip do so against it. A margin is relative to
    sizes, see `sizes_of`. Once it is below `least_of_all` no other one is computed.
    """
    least, share, bound, stuck = np.inf, np.empty(ROWS), 0.0, -1
    share[:] = impulse
    if has_idle_point(candidate):
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
        if slips_by(digit) and sliding[i] == 0.0:
            x, y = contact[i * POINT + 2], contact[i * POINT + 3]
            u = exceeds(normal + 1, wanted, contact, impulse)
            v = exceeds(normal + 2, wanted, contact, impulse)
            size = max(sizes[normal + 1], sizes[normal + 2])
            size *= math.sqrt(x * x + y * y) + LEAST_SIZE
            ahead, aside = (u * x + v * y) / size, abs(u * y - v * x) / size
            least = min(least, ahead + FROM_REST, FROM_REST - aside)
        if digit == BEARS and rubs(i, contact):
            bound, stuck = bound + max(bound_of(i, contact, share), 0.0), i
        if not least >= least_of_all:
            return least
    if stuck >= 0:
        dampers = np.empty(N_POINTS)
        part = least_friction(candidate, N_COORDINATES, N_POINTS, SMOOTH, contact, share, dampers)
        least = min(least, (1.0 - part) * bound / sizes[ROWS + stuck])
    return least


def slips_begin(mode, sliding):
    """Whether points slip in a mode that do not slip yet."""
    begins = False
    for i in range(N_POINTS):
        begins = begins or (slips_by(digit_of(mode, i)) and sliding[i] == 0.0)
    return begins


def aim_slips(mode, sliding, wanted, contact, motion):
    """Put the directions of slips that begin in a mode into `contact`, see `with_directions`.

    wanted (ROWS,) : the accelerations that points lack where nothing touches. motion (n,) : on
    return that with which they slip. Returns whether directions are found.
    """
    share = np.empty(ROWS)
    return with_directions(mode, sliding, wanted, contact, share, motion) >= 0


def begin_slips(mode, sliding, wanted, speed, contact, y):
    """Let slips begin that have no velocity yet, which gives friction its direction.

    speed : [m/s] that of the fastest, but for FIRST_SLIP and LEAST_FIRST_SLIP.
    """
    motion, largest = np.zeros(N_COORDINATES), 0.0
    if not aim_slips(mode, sliding, wanted, contact, motion):
        return
    for i in range(N_COORDINATES):
        largest = max(largest, abs(motion[i]))
    if largest == 0.0:
        return
    first = min(FIRST_SLIP, max(LEAST_FIRST_SLIP, speed)) / largest
    for i in range(N_POINTS):  # the slowest of them must not seem to have ended
        if slips_by(digit_of(mode, i)) and sliding[i] == 0.0:
            slip, _ = slip_of(contact, i, motion, 0)
            if slip * first < LEAST_FIRST_SLIP <= slip * MOST_FIRST_SLIP / largest:
                first = LEAST_FIRST_SLIP / slip
    for i in range(N_COORDINATES):
        y[N_COORDINATES + i] += motion[i] * first


@inlined
def stops(kind, point, subject, mode, slip):
    """Whether the slip of a point has come to its end, where one has turned or ended.

    Where a force vanishes, too: slow slips turn so late, see `slow_turns`, that it may do so early.
    """
    return kind in (STICKING, LIFTING) and slip <= STOPPED


def held_upright(mode, y, p):
    """Whether points are closed that keep the structure from turning."""
    dy = np.empty(N_STATES)
    rates(mode, y, p, *STILL, dy)
    held = False
    for i in range(N_POINTS):
        held = held or point_state(mode, i) != OPEN
    for i in range(N_COORDINATES):
        turns = max(abs(y[i + N_COORDINATES]), abs(dy[i + N_COORDINATES])) > NO_TURN
        held = held and not (ANGLES[i] == 1.0 and turns)
    return held


@inlined
def tips_over(y, p):
    """Whether a body falls where no forces fit."""
    return False
