"""The integration loop: one text for every structure and method.

This file is not imported. `rockeom.integrator.program` joins it to a generated module (which
defines rates, guards, jump, opening_acceleration and the tables) and to the text of a step
(take_step, dense_output), so that the compiler sees one self-contained program.

It reads in the order of the work: settle what is due, step, find the first event, land on it,
jump, go on. Ahead of all that, steps in which nothing happens are taken by `uneventful_steps`.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import (
    AMBIGUOUS,
    CHATTER,
    COMPLETED,
    CONTACT,
    EVENTS_KEPT,
    FRESH,
    FULL,
    IDLE,
    IMPACT,
    IMPACTS,
    IMPOSSIBLE,
    LANDING,
    LAST_ERROR,
    LIFTING,
    NEWS,
    NEXT_STEP,
    NO_SOLUTION,
    NOT_FINITE,
    OVERTURNED,
    REFINED,
    REFINED_TO,
    REST,
    SEVERAL_SOLUTIONS,
    STALLED,
    STAYS_OPEN,
    STEPPED_OVER,
    STEPS_KEPT,
    SWITCH,
    TAKEN,
    TIME,
    TOO_MANY_IMPACTS,
    TOUCHING,
    UPLIFT,
)
from rockeom.compiler.decorators import Floats, Floats2, Floats3, Ints, Ints2, entry

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.bernstein import EPS, NEVER
    from rockeom.integrator.extremes import widen, widen_within, widens
    from rockeom.integrator.full_contact import cannot_move, stands_until
    from rockeom.integrator.ground import jumps, row_at, sampling_step, shaking, straight
    from rockeom.integrator.guards import (
        beside_gap,
        closes_once,
        fell_before,
        first_event,
        guard_polynomials,
        opens_soon,
        overlooks,
        rises_and_falls,
        rocking,
        settle,
        stays_held,
        stays_on_both_feet,
        stays_open,
        to_impact,
    )
    from rockeom.integrator.interface import (
        CLOSED,
        ERROR_EXPONENT,
        GUARDS,
        HELD,
        KINDS,
        N_ALL_STAGES,
        N_GUARDS,
        N_PARTS,
        N_POINTS,
        N_STAGES,
        N_STATES,
        NARROW,
        ROTATION_RATE,
        SIDES,
        TARGETS,
        dense_output,
        guards,
        jump,
        rates,
        take_step,
    )
    from rockeom.integrator.overturning import falls_at, may_fall
    from rockeom.integrator.polynomials import (
        dense_at,
        extrapolate,
        gap_at_ends,
        power_sum,
        shorten,
    )
    from rockeom.integrator.rounding import noise_of
    from rockeom.integrator.steps import controlled, finite_end, first_step, most_error
    from rockeom.integrator.transitions.declared import may_fade, ratio_at, stand, time_to_rest
    from rockeom.integrator.transitions.landings import (
        end_closed,
        fall_within,
        is_rounding,
        longest_turn,
        only_hop,
        to_landing,
    )
    from rockeom.integrator.transitions.searched import (
        N_KNOWN,
        fits_by_forces,
        pass_on,
        still_closed,
    )
    from rockeom.integrator.transitions.zeno import step_over, time_of_bounces

TURN = 20_000  # steps after which a call returns, so that Python may answer an interrupt
MOST_IDLE, MOST_IDLE_POINTS = 100, 1000  # events at one instant; with more they are chatter
CROWDED = 20  # after so many of them points step over the time of a rest
# Places in the loop's scratch array
_K = 0
_W = _K + N_ALL_STAGES * (N_STATES + 2)
_Y_NEW = _W + N_STATES
_AFTER = _Y_NEW + N_STATES
_POWERS = _AFTER + N_STATES
_GUARDS = _POWERS + 8 * N_STATES
_BERNSTEIN = _GUARDS + N_GUARDS + N_PARTS
_STACK = _BERNSTEIN + 8 * (N_GUARDS + N_PARTS + 1)
_NOISE = _STACK + 640
_KNOWN = _NOISE + (len(SIDES) + 1) * (N_GUARDS + N_PARTS)
SCRATCH = _KNOWN + N_KNOWN


def record_step(row, t, h, contact, coefficients, steps, step_contact, step_states):
    steps[row, 0] = t
    steps[row, 1] = h
    step_contact[row] = contact
    for j in range(8):
        for i in range(N_STATES):
            step_states[row, j, i] = coefficients[j * N_STATES + i]


def record_event(
    row, t, kind, before, follows, guard, y, after, events, event_kinds, event_states
):  # fmt: skip
    events[row] = t
    event_kinds[row, 0] = kind
    event_kinds[row, 1] = before
    event_kinds[row, 2] = follows
    event_kinds[row, 3] = guard
    for i in range(N_STATES):
        event_states[row, 0, i] = y[i]
        event_states[row, 1, i] = after[i]


def uneventful_steps(
    contact, t, h_next, last_error, taken, turn, nx, ny, horizontal, vertical, t_end, fixed,
    refined_to, coarse, h_max, fallen, p, rtol, atol, y, k, y_new, peaks, coefficients,
):  # fmt: skip
    """Take steps in which nothing happens, one after the other, as the loop itself would.

    Nearly all steps of a motion are such; here nothing is asked that concerns others. Returns the
    loop's own variables behind them, with the error of a step that was taken and is left for the
    loop to judge, or -1, and whether the ground's acceleration has jumped.
    """
    rocks = rocking(contact)
    side = SIDES[contact]
    nx, gx = row_at(horizontal, nx, t)
    ny, gy = row_at(vertical, ny, t)
    while taken <= turn:
        if t >= gx[1]:
            before_x = shaking(gx, t)
            nx, gx = row_at(horizontal, nx, t)
            if jumps(before_x, shaking(gx, t)):
                return t, h_next, last_error, taken, -1.0, True, nx, gx, ny, gy
        if t >= gy[1]:
            before_y = shaking(gy, t)
            ny, gy = row_at(vertical, ny, t)
            if jumps(before_y, shaking(gy, t)):
                return t, h_next, last_error, taken, -1.0, True, nx, gx, ny, gy
        if not t < t_end or not (rocks or straight(gx, gy)):
            break
        last = min(gx[1], gy[1], t_end)
        span = min(gx[1] - gx[0], gy[1] - gy[0])
        equal = fixed > 0 and t >= refined_to and span < np.inf
        proposed = span / fixed if equal else h_next
        h = min(proposed, h_max)
        cut = t + 1.1 * h >= last
        if cut:
            h = last - t
        taken += 1
        error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new)
        gap = gap_at_ends(side, h, y, y_new, k)
        open_ = stays_open(gap, -1)
        if HELD >= 0 and contact == HELD:
            open_ = stays_on_both_feet(t, h, y, y_new, k, p, gx)
        ordinary = error <= (coarse if equal else 1.0) and finite_end(k) and open_
        if not ordinary or may_fall(fallen, gap, h, y, y_new, k, p):
            return t, h_next, last_error, taken, error, False, nx, gx, ny, gy
        if peaks.shape[0] > 0:
            if widens(peaks, h, y, y_new, k):
                dense_output(contact, t, h, y, p, gx, gy, k, coefficients)
                widen_within(peaks, coefficients)
            widen(peaks, y_new)
        h_next = proposed
        if not cut:
            h_next, last_error = controlled(h, error, last_error)
        t = last if cut or t + h > last else t + h
        for i in range(N_STATES):
            y[i] = y_new[i]
            k[i] = k[N_STAGES * N_STATES + i]
    return t, h_next, last_error, taken, -1.0, False, nx, gx, ny, gy


@entry
def integrate(
    status: Ints, clock: Floats, y: Floats, rate: Floats, t_end: float, horizontal: Floats2,
    vertical: Floats2, p: Floats, law: int, ratio: float, rtol: float, atol: Floats, h_max: float,
    fixed: int, fallen: float, rest_tolerance: float, max_impacts: int, max_steps: int,
    steps: Floats2, step_contact: Ints, step_states: Floats3, events: Floats, event_kinds: Ints2,
    event_states: Floats3, peaks: Floats2, scratch: Floats,
) -> int:  # fmt: skip
    """Integrate to t_end, to the outcome that ends the motion, or until a record or turn is FULL.

    status, clock : what must be known to go on, see `rockeom.codes`.
    y, rate (N,) : the state and its rate.
    These four are changed in place, so that a call goes on where the last one ended, to the last
    bit.
    horizontal, vertical (m, 7) : the ground's motion, each row start, end, kind and constants of
        a law; no step straddles an end, and behind the last one the ground stands still.
    fixed : 0 to control the error, or the number of equal steps in each law of the ground. An equal
        step whose estimated error is above COARSE is refused, and the rest of its law is
        integrated with control of the error.
    steps (n, 2) start and length, step_contact (n,), step_states (n, 8, N) the dense output of
    each step; n = 0 keeps none. events (m,) times, event_kinds (m, 4) kind, contact before and
    after and the guard that fell, event_states (m, 2, N) state before and after.
    """
    k = scratch[_K:_W]  # rates of the stages of a step, and the ground at each
    w = scratch[_W:_Y_NEW]
    y_new = scratch[_Y_NEW:_AFTER]
    after = scratch[_AFTER:_POWERS]
    coefficients = scratch[_POWERS:_GUARDS]
    g = scratch[_GUARDS:_BERNSTEIN]
    b = scratch[_BERNSTEIN:_STACK]
    stack = scratch[_STACK:_NOISE]
    noises = scratch[_NOISE:_KNOWN]
    known = scratch[_KNOWN:SCRATCH]
    contact, touching = status[CONTACT], status[TOUCHING]
    impacts, taken, refined = status[IMPACTS], status[TAKEN], status[REFINED]
    idle, news, fresh = status[IDLE], status[NEWS], status[FRESH]
    n_steps, n_events = status[STEPS_KEPT], status[EVENTS_KEPT]
    for i in range(N_STATES):
        k[i] = rate[i]
    t, h_next = clock[TIME], clock[NEXT_STEP]
    last_error = clock[LAST_ERROR] if clock[LAST_ERROR] > 0.0 else 1.0
    refined_to = clock[REFINED_TO]
    coarse = most_error(rtol)
    nx, gx = row_at(horizontal, 0, t)
    ny, gy = row_at(vertical, 0, t)
    keep = steps.shape[0] > 0
    follow = peaks.shape[0] > 0
    rocks = rocking(contact)
    side = SIDES[contact]
    outcome = COMPLETED
    follows = 0  # the contact state behind the bounces that a landing begins
    h = 0.0
    turn = taken + TURN
    sampled = False  # whether the guards at the end of the step before are known
    still = False  # whether nothing moved in it, and no event was at its end
    for i in range(noises.shape[0]):
        noises[i] = -1.0

    if N_POINTS > 0:
        begins = taken == 0 and impacts == 0 and fresh == 1
        if begins and fits_by_forces(contact, y, p, shaking(gx, t), shaking(gy, t)) == AMBIGUOUS:
            return SEVERAL_SOLUTIONS

    while True:
        # a call that ends where a law does must tell the next one of the jump
        if t >= gx[1]:
            before_x = shaking(gx, t)
            nx, gx = row_at(horizontal, nx, t)
            if jumps(before_x, shaking(gx, t)):
                fresh = news = 1
        if t >= gy[1]:
            before_y = shaking(gy, t)
            ny, gy = row_at(vertical, ny, t)
            if jumps(before_y, shaking(gy, t)):
                fresh = news = 1
        unjudged = -1.0  # the error of a step that is already taken
        uneventful = fresh == 0 and touching < 0 and not keep and (rocks or contact == HELD)
        if N_POINTS == 0 and not NARROW and uneventful:
            t, h_next, last_error, taken, unjudged, jumped, nx, gx, ny, gy = uneventful_steps(
                contact, t, h_next, last_error, taken, min(turn, max_steps - 1), nx, ny, horizontal,
                vertical, t_end, fixed, refined_to, coarse, h_max, fallen, p, rtol, atol, y, k,
                y_new, peaks, coefficients,
            )  # fmt: skip
            if taken >= max_steps and unjudged == -1.0:
                outcome = STALLED
                break
            if jumped:
                fresh = news = 1
            if t >= gx[1] or t >= gy[1]:
                continue  # the other table's law ends there, too
        if not t < t_end:
            break
        full = (keep and n_steps + 2 > steps.shape[0]) or n_events + 2 > events.shape[0]
        if full or taken > turn:
            outcome = FULL
            break
        last = min(gx[1], gy[1], t_end)

        landed = -1  # the guard that ends this contact state now
        if fresh == 1:
            sampled = still = False
            if news == 1 and not rocks:
                h = min(h_next, last - t)  # at rest the next step may be of any length
                landed = settle(
                    contact, t, h, y, p, gx, gy, touching, rtol, g, w, k, fallen, noises
                )
            if landed < 0:
                rates(contact, y, p, shaking(gx, t), shaking(gy, t), k)
                fresh = news = 0
                if h_next == 0.0:
                    h_next = first_step(contact, t, y, k, p, gx, gy, rtol, atol, w, after)

        if landed < 0:
            # -- step, cut where a law of the ground ends, and once more to the first event in it
            span = min(gx[1] - gx[0], gy[1] - gy[0])
            equal = fixed > 0 and t >= refined_to and span < np.inf
            if equal:
                h_next = span / fixed
            bound = coarse if equal else 1.0
            still = still or cannot_move(contact, k, y, p)
            proposed = np.inf if still else h_next
            h = min(proposed, h_max)
            if not rocks:
                h = min(h, sampling_step(gx), sampling_step(gy))
            if N_POINTS > 0:
                h = min(h, longest_turn(y))
            longest = min(proposed, last - t)
            cut = t + 1.1 * h >= last
            if cut:
                h = last - t
            target = -1
            slope = more = 0.0
            sampled = sampled and touching < 0 and not still
            corrections = overlooked = 0
            beyond = turned = hops = False
            lands = False  # whether it is known that nothing but a landing ends it
            stands = still and last - t <= h_max
            stands = stands and stands_until(contact, t, last, y, p, gx, gy, g)
            if stands:
                taken += 1
                h = last - t
                cut = True
            if still:
                # nothing moves: the state is known without a step
                for i in range(N_STATES):
                    y_new[i] = y[i]
                    k[N_STAGES * N_STATES + i] = 0.0
                for i in range(8 * N_STATES):
                    coefficients[i] = y[i] if i < N_STATES else 0.0
            if rocks and touching == 0 and not NARROW:
                # a hop so short that its parabola tells where it ends
                flight = -2.0 * y[ROTATION_RATE] / k[ROTATION_RATE]
                height = side * y[ROTATION_RATE] * flight  # not lost among the smallest numbers
                if 0.0 < flight < 0.9 * h and height > 1e-290:
                    h = flight
                    cut = False
                    hops = True
            whole, hop = h, 0
            if N_POINTS > 0:
                flight = np.inf
                if touching > 0:
                    hop, flight = only_hop(contact, touching, y, p, k)
                if 1e3 * EPS * t < flight < 0.9 * h:
                    h = flight
                    hops = True
            while not stands:
                error = 0.0
                if unjudged != -1.0:
                    error, unjudged = unjudged, -1.0
                else:
                    taken += 1
                    if not still:
                        error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new)
                finite = math.isfinite(error) and finite_end(k)
                if not finite or error > bound:
                    # refused: too inaccurate, or not finite
                    if equal:
                        equal, bound = False, 1.0
                        refined_to = last
                        refined += 1
                    cut = hops = lands = False
                    target = -1
                    corrections = 0
                    shrink = 0.9 * error**ERROR_EXPONENT if finite else 0.1
                    h *= max(0.1, shrink)
                    h_next = h
                    if h <= 4.0 * EPS * t or h < 1e-290 or taken >= max_steps:
                        finite = error == error and finite_end(k)  # else no step is short enough
                        outcome = STALLED if finite else NOT_FINITE
                        break
                    continue
                gap = gap_at_ends(side, h, y, y_new, k)
                if hops:
                    # it ends there if the gap clearly stays open until then
                    hops = False
                    if N_POINTS > 0:
                        falls, place = fall_within(
                            contact, t, h, y, y_new, k, N_STAGES * N_STATES, p, gx, gy, w, b,
                            False, touching, hop,
                        )  # fmt: skip
                        if falls != hop:
                            h = whole
                            continue
                        cut = False
                        lands = True
                    elif not (abs(to_impact(side, y_new, k)) < 0.1 * h and rises_and_falls(gap)):
                        h *= 0.5  # no parabola: a step must not end just beside an impact
                        continue
                    target = hop
                if target >= 0:
                    # this step ends at the event: correct what is left of the guard there
                    tau = t + h
                    if rocks:
                        move = to_impact(side, y_new, k)
                        near = 0.1 if corrections == 0 else 0.01
                    elif lands:
                        near = 0.1 if corrections == 0 else 0.01
                        move = 0.0
                        if N_POINTS > 0:
                            move = to_landing(contact, target, y_new, p, k[N_STAGES * N_STATES :])
                    else:
                        guards(contact, y_new, p, shaking(gx, tau), shaking(gy, tau), g)
                        move = -g[target] / slope if slope < 0.0 else 0.0
                        near = 0.01
                    least = max(2.0 * EPS * tau, 1e-5 * rtol * h)
                    small = math.sqrt(max(1e-13, min(1e-6, rtol))) * h
                    if (rocks or lands) and not NARROW and abs(move) <= small:
                        extrapolate(h, move, y, y_new, k)
                        more = move
                    elif corrections < 8 and least < abs(move) < near * h:
                        corrections += 1
                        h += move
                        continue
                    misplaced = abs(move) >= 0.01 * h
                    misplaced = misplaced or (
                        not (rocks or lands)
                        and fell_before(contact, target, touching, h, y_new, g, b)
                    )
                    if N_POINTS > 0 and misplaced and KINDS[contact][target] == LANDING:
                        misplaced = not is_rounding(contact, target, y_new, p)
                    if misplaced and h > 1e-6 * longest:
                        # the guard is not where its polynomial put it: look again in less time
                        h *= 0.5
                        lands = False
                        target = -1
                        corrections = 0
                        continue
                    landed = target
                elif not (cut or still):
                    h_next, last_error = controlled(h, error, last_error)
                open_ = False
                if rocks and landed < 0:
                    open_ = stays_open(gap, touching)
                    place = NEVER if open_ or NARROW else closes_once(gap, touching)
                    if place < NEVER:
                        target = 0
                        h *= place
                        cut = False
                        continue
                elif landed < 0 and (touching < 0 or N_POINTS > 0) and not still:
                    ends = False
                    if N_POINTS > 0:
                        falls, place = fall_within(
                            contact, t, h, y, y_new, k, N_STAGES * N_STATES, p, gx, gy, w, b,
                            sampled, touching, -1,
                        )  # fmt: skip
                        open_ = sampled = falls == STAYS_OPEN
                        if falls >= 0:
                            lands, target = True, falls
                            h *= place
                            cut = False
                            continue
                        ends = not open_ and end_closed(contact, b)
                    if not (open_ or ends or touching >= 0):
                        open_ = stays_held(contact, t, h, y, y_new, k, p, gx, gy, w, g, b, stack)
                beyond = may_fall(fallen, gap, h, y, y_new, k, p)
                turned = follow and widens(peaks, h, y, y_new, k)
                leaves = NARROW and touching >= 0 and beside_gap(contact, touching, y, y_new)
                closes = NARROW and landed >= 0 and beside_gap(contact, landed, y_new, y)
                asked = keep or turned or beyond or leaves or closes
                if not still and (asked or not (open_ or landed >= 0)):
                    dense_output(contact, t, h, y, p, gx, gy, k, coefficients)
                    if more != 0.0:
                        shorten(coefficients, 1.0 + more / h)
                        for i in range(N_STATES):
                            left = y_new[i] - power_sum(coefficients, 1.0, i)
                            coefficients[7 * N_STATES + i] += left
                h += more
                again = (leaves or closes) and overlooked < 20
                if again and overlooks(
                    contact, t, h, p, gx, gy, rtol, atol, coefficients, closes, w, after
                ):
                    overlooked += 1
                    h *= 0.3
                    h_next = h
                    cut = False
                    target = landed = -1
                    corrections = 0
                    continue
                if open_ or (landed >= 0 and not closes):
                    break
                instant = 4.0 * EPS * max(t, h)
                guard_polynomials(contact, t, h, p, gx, gy, coefficients, w, g, b)
                place, target, slope, from_closed, unclear = first_event(
                    contact, t, h, instant, landed, touching, y, p, gx, gy, fallen, noises, w, g, b,
                    stack,
                )  # fmt: skip
                if place == NEVER:
                    break
                landed = -1
                if place * h <= instant:
                    if rocks:
                        # it does not fall where both its rate and its acceleration open it
                        slow = y[ROTATION_RATE] == 0.0 or side * k[ROTATION_RATE] > 0.0
                    else:
                        slow = unclear or opens_soon(
                            contact, target, t, h, y, p, gx, gy, k, w, g, after,
                            noise_of(contact, target, p, fallen, noises, w, g),
                        )  # fmt: skip
                    if from_closed and slow and h > max(1e-6 * longest, 1e3 * EPS * t):
                        # an opening so short that rounding, or the error of a dense output of
                        # low order, hides it in a step of this length
                        h *= 0.1
                        cut = False
                        target = -1
                        continue
                    h = 0.0  # it falls here and now
                if place >= 1.0 or h == 0.0:
                    landed = target
                    break
                h *= place
                cut = False
            if outcome != COMPLETED:
                break
            sampled = sampled and not beyond

            # -- fallen over: the step ends where it passed the bound
            x = NEVER
            if h > 0.0 and beyond:
                x = falls_at(coefficients, fallen, p, b, stack)
            if x < NEVER:
                dense_at(coefficients, x, y_new)
                shorten(coefficients, x)
                h *= x
                cut = False
                outcome = OVERTURNED

            if h > 0.0:
                if keep:
                    record_step(
                        n_steps, t, h, contact, coefficients, steps, step_contact, step_states
                    )
                    n_steps += 1
                t = last if cut or t + h > last else t + h
                if follow:
                    if turned:
                        widen_within(peaks, coefficients)
                    widen(peaks, y_new)
                for i in range(N_STATES):
                    y[i] = y_new[i]
                    k[i] = k[N_STAGES * N_STATES + i]
                touching = -1
                idle = follows = 0
            if outcome != COMPLETED:
                break
            if taken >= max_steps:
                outcome = STALLED
                break

        if landed < 0:
            continue

        # -- the event: pass into the contact state that follows
        idle += 1
        before, kind, closed = contact, KINDS[contact][landed], touching
        touching = -1
        ax, ay = shaking(gx, t), shaking(gy, t)
        rests, stepped, stepped_to = np.inf, False, 0
        if idle > (MOST_IDLE if N_POINTS == 0 else MOST_IDLE_POINTS):
            outcome = CHATTER
            if follows < 0:  # the bounces have an end, but nothing that may follow it
                outcome = NO_SOLUTION if follows == IMPOSSIBLE else SEVERAL_SOLUTIONS
            break
        if N_POINTS > 0 and CROWDED * int(idle / CROWDED) == idle:
            rests, stepped_to = step_over(
                before, y, p, ax, ay, rest_tolerance, last - t, False, rtol, known, y_new
            )
            stepped = rests < np.inf
        if N_POINTS == 0:
            contact = jump(before, landed, law, ratio_at(law, ratio, impacts, y, p), y, p, after)
        elif not stepped:
            length = max(h, min(h_next, last - t))
            tau = 1e-5 * length
            contact, touching = pass_on(
                before, landed, length, y, p, ax, ay, shaking(gx, t + tau), shaking(gy, t + tau),
                tau, rtol, known, after,
            )  # fmt: skip
            if contact < 0:
                outcome = NO_SOLUTION if contact == IMPOSSIBLE else SEVERAL_SOLUTIONS
                contact = before
                rests, stepped_to = step_over(
                    before, y, p, ax, ay, rest_tolerance, last - t, True, rtol, known, y_new
                )
                # what has come to its end and goes on as before is no way out
                stepped = rests < np.inf and (kind == LANDING or stepped_to != before)
                if not stepped:
                    break
                outcome = COMPLETED
            elif kind == SWITCH:
                touching = still_closed(before, contact, landed, closed, touching)
        if stepped:
            follows = stepped_to
            fresh = news = 1
        else:
            record_event(
                n_events, t, kind, before, contact, landed, y, after, events, event_kinds,
                event_states,
            )  # fmt: skip
            n_events += 1
            for i in range(N_STATES):
                y[i] = after[i]
            rocks = rocking(contact)
            side = SIDES[contact]
            fresh = news = 1
            if N_POINTS == 0 and (kind != IMPACT or SIDES[contact] != 0.0):
                touching = CLOSED[before][landed]
            if kind in (UPLIFT, LIFTING):
                h_next = 0.0  # the gap opens slowly: its first moments want a short step
            if kind != IMPACT and kind != LANDING:
                continue
            if N_POINTS == 0 and idle > 1 and SIDES[contact] == 0.0:
                # it opened and closed in no time: that uplift was none
                for i in range(GUARDS[contact]):
                    if TARGETS[contact][i] == before:
                        touching = i
            impacts += 1
            if impacts > max_impacts:
                outcome = TOO_MANY_IMPACTS
                break
            # -- the rest of infinitely many impacts at once
            if N_POINTS > 0:
                rests, follows = time_of_bounces(
                    contact, y, p, ax, ay, rest_tolerance, rtol, known, y_new
                )
            elif SIDES[contact] == 0.0:
                continue
            else:
                rates(contact, y, p, ax, ay, k)
                if not may_fade(side, y, k, law, ratio, rest_tolerance):
                    if rocks and t < last and h_next != 0.0:
                        fresh = news = 0  # the next step begins with these rates
                    continue
                rests, follows = time_to_rest(
                    contact, y, p, law, ratio, impacts, ax, ay, rest_tolerance, w, after,
                    coefficients,
                )  # fmt: skip
        if not (stepped or t + rests < last or rests < 16.0 * EPS * t):
            continue
        kept = contact  # in which the time of the rest is recorded
        if N_POINTS > 0:
            for i in range(8 * N_STATES):
                coefficients[i] = 0.0
            for i in range(N_STATES):
                coefficients[i] = w[i] = y[i]
                coefficients[N_STATES + i] = y_new[i] - y[i]
        else:
            kept = follows
            if not stand(follows, t, rests, after, p, gx, gy, rtol, atol, k, y_new):
                continue
            if keep and t + rests > t:
                dense_output(follows, t, rests, after, p, gx, gy, k, coefficients)
            for i in range(N_STATES):
                w[i] = y[i] + (y_new[i] - after[i])  # there, had the impacts not faded yet
        if keep and t + rests > t:
            record_step(n_steps, t, rests, kept, coefficients, steps, step_contact, step_states)
            n_steps += 1
        t = min(t + rests, last) if stepped else t + rests
        record_event(
            n_events, t, REST, contact, follows, STEPPED_OVER if stepped else -1, w, y_new, events,
            event_kinds, event_states,
        )  # fmt: skip
        n_events += 1
        if follow:
            widen(peaks, y_new)
        for i in range(N_STATES):
            y[i] = y_new[i]
        contact = follows
        rocks = rocking(contact)
        side = SIDES[contact]
        touching = -1
        h_next = 0.0

    status[CONTACT], status[TOUCHING] = contact, touching
    status[IMPACTS], status[TAKEN], status[REFINED] = impacts, taken, refined
    status[IDLE], status[NEWS], status[FRESH] = idle, news, fresh
    status[STEPS_KEPT], status[EVENTS_KEPT] = n_steps, n_events
    for i in range(N_STATES):
        rate[i] = k[i]
    clock[TIME], clock[NEXT_STEP] = t, h_next
    clock[LAST_ERROR], clock[REFINED_TO] = last_error, refined_to
    return outcome
