"""The integration loop: one text for every structure and method.

It reads in the order of the work. `integrate` takes one step after the other, each of them by these
stages:

    next_segments    the ground motion goes on by other segments of its tables
    quiet_steps      steps in which nothing can happen, one after the other
    settle_mode      a guard that is below zero where a mode begins, or where the ground jumps
    plan             the next step: its length, and what is known of its end
    attempt          take the step, and judge it: again, shorter; up to an event; or as it is
    accept           record it, and go on from its end
    leave_mode       the event: the mode that follows, and the end of infinitely many impacts

A contract of functions gives the transition at an event. `transitions/table.py` fulfils it for
declared modes, `transitions/search.py` for points that may open, slide and bounce.
"""

import math

import numpy as np

from rockeom.codes import (
    CLOSED,
    COMPLETED,
    EVENTS_KEPT,
    FULL,
    GUARD_DUE,
    IDLE,
    IMPACT,
    IMPACTS,
    LANDING,
    LAST_ERROR,
    MODE,
    NEXT_STEP,
    NOT_FINITE,
    OVERTURNED,
    RATE_STALE,
    REFINED,
    REFINED_TO,
    REST,
    SEVERAL_SOLUTIONS,
    STALLED,
    STEPPED_OVER,
    STEPS,
    STEPS_KEPT,
    STICKING,
    TIME,
    TOO_MANY_IMPACTS,
)
from rockeom.compiler.decorators import Floats, Ints, entry, inlined, unrolled
from rockeom.integrator.bernstein import NEVER
from rockeom.integrator.extremes import falls_at, may_fall, widen, widen_within, widens
from rockeom.integrator.full_contact import cannot_move, stands_until
from rockeom.integrator.ground import (
    first_end,
    ground_accelerations,
    ground_at,
    ground_from,
    jumps,
    sampling_step,
    straight,
)
from rockeom.integrator.guards import (
    acts_beside,
    fell_before,
    first_event,
    guard_polynomials,
    opens_soon,
    overlooks,
    rocking,
    settle,
    stays_held,
    stays_on_both_feet,
    stays_open,
)
from rockeom.integrator.polynomials import (
    dense_at,
    extrapolate,
    gap_at_ends,
    power_sum,
    shorten,
)
from rockeom.integrator.provided import (
    AXES,
    BENT,
    CONTACT_SIZE,
    ERROR_EXPONENT,
    EXTRAPOLATES,
    FULL_CONTACT,
    N_ALL_STAGES,
    N_GUARDS,
    N_MODES,
    N_PARTS,
    N_STAGES,
    N_STATES,
    QUIET_STEPS,
    ROTATION_RATE,
    certain_event,
    dense_output,
    free_flight,
    guards,
    hop_ends,
    initial_mode_is_one,
    is_rounding,
    jammed,
    kind_of,
    longest_turn,
    rates,
    side_of,
    take_step,
    through_rest,
    time_to_landing,
    transition,
    without_hop,
    zeno_time,
)
from rockeom.integrator.recorder import record_event, record_step
from rockeom.integrator.records import (
    Arrays,
    Case,
    Motion,
    Recorder,
    Step,
    records_extremes,
    records_steps,
)
from rockeom.integrator.rounding import noise_of
from rockeom.integrator.steps import controlled, finite_end, first_step, most_error
from rockeom.integrator.tolerances import (
    EPS,
    LEAST_OF_QUINTIC,
    LEAST_PRODUCT,
    PLACED,
    PLACED_BY_QUINTIC,
    SAME_INSTANT,
    SHORTEST_PART,
    SPEED_AT_STOP,
)

TURN = 20_000  # steps after which a call returns, so that Python may answer an interrupt

# Places in the loop's scratch array
_K = 0
_W = _K + N_ALL_STAGES * (N_STATES + AXES)
_Y_NEW = _W + N_STATES
_AFTER = _Y_NEW + N_STATES
_POWERS = _AFTER + N_STATES
_GUARDS = _POWERS + 8 * N_STATES
_BERNSTEIN = _GUARDS + N_GUARDS + N_PARTS
_STACK = _BERNSTEIN + 8 * (N_GUARDS + N_PARTS + 1)
_NOISE = _STACK + 640
_CONTACT = _NOISE + (N_MODES + 1) * (N_GUARDS + N_PARTS)
SCRATCH = _CONTACT + CONTACT_SIZE

END = N_STAGES * N_STATES  # where the rates at the end of a step begin in those of its stages

AGAIN, DONE, UNDECIDED = range(3)  # what becomes of a step


@entry
def integrate(
    status: Ints,
    clock: Floats,
    y: Floats,
    rate: Floats,
    case: Case,
    recorder: Recorder,
    scratch: Floats,
) -> int:
    """Integrate to the end, to the outcome that ends the motion, or until a record or turn is FULL.

    status, clock : what must be known to go on, see `rockeom.codes`.
    y, rate (N,) : the state and its rate.
    These four are changed in place, so that a call goes on where the last one ended, to the last
    bit.
    """
    a = arrays_of(y, rate, scratch)
    motion = resumed(status, clock)
    ground = ground_at(motion.t, case)
    shaking = ground_accelerations(ground, motion.t)
    begins = motion.taken == 0 and motion.impacts == 0 and motion.rate_stale
    if begins and not initial_mode_is_one(motion.mode, y, case.p, shaking):
        return SEVERAL_SOLUTIONS
    turn = motion.taken + TURN
    while True:
        if motion.t >= first_end(ground):
            ground, jumped = next_segments(ground, motion.t, case)
            if jumped:  # a call that ends where a segment does must tell the next one
                motion = motion._replace(rate_stale=True, guard_due=True)
        error = -1.0  # of a step that is already taken
        if QUIET_STEPS and may_be_quiet(motion, recorder):
            motion, ground, error = quiet_steps(motion, ground, turn, case, a, recorder)
            if motion.taken >= case.max_steps and error == -1.0:
                motion = motion._replace(outcome=STALLED)
                break
            if motion.t >= first_end(ground):
                continue  # the other table's segment ends there, too
        if not motion.t < case.t_end:
            break
        if is_full(motion, recorder) or motion.taken > turn:
            motion = motion._replace(outcome=FULL)
            break
        motion, guard, h = settle_mode(motion, ground, case, a)
        if guard < 0:
            step = plan(motion, ground, case, a)
            verdict = DONE if step.stands else AGAIN
            while verdict == AGAIN:
                step = take(motion, ground, step, error, case, a)
                error = -1.0
                verdict, step = judge(motion, ground, step, case, a, recorder)
            if step.outcome == COMPLETED:
                step = fall_over(step, case, a)
                motion, guard, h = accept(motion, step, case, a, recorder)
            else:
                motion = with_control(motion, step)
        mode, guard = jammed(motion, guard, ground, case, a)
        if mode != motion.mode:
            motion = motion._replace(mode=mode, outcome=COMPLETED)
        if motion.outcome != COMPLETED:
            break
        if guard >= 0:
            motion = leave_mode(motion, ground, guard, h, case, a, recorder)
            if motion.outcome != COMPLETED:
                break
    suspend(motion, status, clock, rate, a)
    return motion.outcome


@inlined
def arrays_of(y, rate, scratch):
    """The arrays of the loop, in one that lasts from call to call."""
    for i in range(N_STATES):
        scratch[_K + i] = rate[i]
    for i in range(_NOISE, _CONTACT):
        scratch[i] = -1.0
    return Arrays(
        y,
        k=scratch[_K:_W],
        w=scratch[_W:_Y_NEW],
        y_new=scratch[_Y_NEW:_AFTER],
        after=scratch[_AFTER:_POWERS],
        coefficients=scratch[_POWERS:_GUARDS],
        g=scratch[_GUARDS:_BERNSTEIN],
        b=scratch[_BERNSTEIN:_STACK],
        stack=scratch[_STACK:_NOISE],
        noises=scratch[_NOISE:_CONTACT],
        contact=scratch[_CONTACT:SCRATCH],
    )


@inlined
def resumed(status, clock):
    """The motion where the last call left it."""
    return Motion(
        t=clock[TIME],
        mode=status[MODE],
        closed=status[CLOSED],
        h_next=clock[NEXT_STEP],
        last_error=clock[LAST_ERROR] if clock[LAST_ERROR] > 0.0 else 1.0,
        refined_to=clock[REFINED_TO],
        rate_stale=status[RATE_STALE] == 1,
        guard_due=status[GUARD_DUE] == 1,
        sampled=False,
        still=False,
        taken=status[STEPS],
        refined=status[REFINED],
        impacts=status[IMPACTS],
        idle=status[IDLE],
        n_steps=status[STEPS_KEPT],
        n_events=status[EVENTS_KEPT],
        follows=0,
        outcome=COMPLETED,
    )


@inlined
def suspend(motion, status, clock, rate, a):
    """Leave the motion for the next call."""
    status[MODE], status[CLOSED] = motion.mode, motion.closed
    status[IMPACTS], status[STEPS] = motion.impacts, motion.taken
    status[REFINED], status[IDLE] = motion.refined, motion.idle
    status[GUARD_DUE], status[RATE_STALE] = int(motion.guard_due), int(motion.rate_stale)
    status[STEPS_KEPT], status[EVENTS_KEPT] = motion.n_steps, motion.n_events
    for i in range(N_STATES):
        rate[i] = a.k[i]
    clock[TIME], clock[NEXT_STEP] = motion.t, motion.h_next
    clock[LAST_ERROR], clock[REFINED_TO] = motion.last_error, motion.refined_to


# -- the ground, and steps in which nothing happens ------------------------------------------------


@inlined
def next_segments(ground, t, case):
    """(ground, jumped): the segments that hold from now on, and whether the acceleration jumps."""
    follows, jumped = ground_from(ground, t, case), False
    before, after = ground_accelerations(ground, t), ground_accelerations(follows, t)
    for axis in unrolled(range(AXES)):
        jumped = jumps(before[axis], after[axis]) or jumped
    return follows, jumped


@inlined
def is_full(motion, recorder):
    """Whether a record may have no room for what the next step brings."""
    full = records_steps(recorder) and motion.n_steps + 2 > recorder.steps.shape[0]
    return full or motion.n_events + 2 > recorder.events.shape[0]


@inlined
def may_be_quiet(motion, recorder):
    """Whether steps may be taken in which nothing but the motion itself is looked at."""
    quiet = not motion.rate_stale and motion.closed < 0 and not records_steps(recorder)
    return quiet and (rocking(motion.mode) or motion.mode == FULL_CONTACT)


def quiet_steps(motion, ground, turn, case, a, recorder):
    """Take steps in which nothing happens, one after the other, as the loop itself would.

    Nearly all steps of a motion are such. Returns the motion and the ground after them, and the
    error of a step that was taken and is left for the loop to judge, or -1. turn : the number of
    steps after which it returns.
    """
    mode, t, h_next, last_error = motion.mode, motion.t, motion.h_next, motion.last_error
    taken, p, y, k, y_new = motion.taken, case.p, a.y, a.k, a.y_new
    unjudged, jumped, now = -1.0, False, ground
    most, extremes = min(turn, case.max_steps - 1), recorder.extremes
    while taken <= most:
        if t >= first_end(now):
            now, jumped = next_segments(now, t, case)
        if jumped or not t < case.t_end or not (rocking(mode) or straight(now)):
            break
        last = end_of_segments(now, case)
        proposed, equal = proposed_step(h_next, t, motion.refined_to, now, case)
        h = min(proposed, case.h_max)
        cut = t + 1.1 * h >= last
        if cut:
            h = last - t
        taken += 1
        error = take_step(mode, t, h, y, p, now, case.rtol, case.atol, k, y_new)
        gap = gap_at_ends(side_of(mode), h, y, y_new, k)
        open_ = stays_open(gap, False)
        if FULL_CONTACT >= 0 and mode == FULL_CONTACT:
            open_ = stays_on_both_feet(t, h, y, y_new, k, p, now[0].row)
        ordinary = error <= (most_error(case.rtol) if equal else 1.0) and finite_end(k) and open_
        if not ordinary or may_fall(case.fallen, gap, h, y, y_new, k, p):
            unjudged = error
            break
        if records_extremes(recorder):
            if widens(extremes, h, y, y_new, k):
                dense_output(mode, t, h, y, p, now, k, a.coefficients)
                widen_within(extremes, a.coefficients)
            widen(extremes, y_new)
        h_next = proposed
        if not cut:
            h_next, last_error = controlled(h, error, last_error)
        t = last if cut or t + h > last else t + h
        for i in range(N_STATES):
            y[i] = y_new[i]
            k[i] = k[END + i]
    left = motion._replace(
        t=t, h_next=h_next, last_error=last_error, taken=taken, rate_stale=jumped,
        guard_due=motion.guard_due or jumped,
    )  # fmt: skip
    return left, now, unjudged


# -- a step ----------------------------------------------------------------------------------------


@inlined
def end_of_segments(ground, case):
    return min(first_end(ground), case.t_end)


@inlined
def settle_mode(motion, ground, case, a):
    """(motion, guard, h): the guard that ends the mode now, or -1; else the rates are known now.

    h : the length that the step would have had.
    """
    if not motion.rate_stale:
        return motion, -1, 0.0
    settled = motion._replace(sampled=False, still=False)
    mode, t = motion.mode, motion.t
    if motion.guard_due and not rocking(mode):
        h = min(motion.h_next, end_of_segments(ground, case) - t)  # at rest it may be of any length
        guard = settle(mode, t, h, motion.closed, ground, case, a)
        if guard >= 0:
            return settled, guard, h
    rates(mode, a.y, case.p, *ground_accelerations(ground, t), a.k)
    h_next = motion.h_next
    if h_next == 0.0:
        h_next = first_step(mode, t, a.y, a.k, case.p, ground, case.rtol, case.atol, a.w, a.after)
    return settled._replace(rate_stale=False, guard_due=False, h_next=h_next), -1, 0.0


@inlined
def plan(motion, ground, case, a):
    """The next step: cut where a segment of the ground ends, and where a hop clearly does."""
    mode, t = motion.mode, motion.t
    end = end_of_segments(ground, case)
    h_next, equal = proposed_step(motion.h_next, t, motion.refined_to, ground, case)
    still = motion.still or cannot_move(mode, a.k, a.y, case.p)
    proposed = np.inf if still else h_next
    h = min(proposed, case.h_max)
    if not rocking(mode):
        h = min(h, *tuple(sampling_step(ground[axis].row) for axis in unrolled(range(AXES))))
    h = min(h, longest_turn(a.y))
    longest = min(proposed, end - t)
    cut = t + 1.1 * h >= end
    stands = still and end - t <= case.h_max
    stands = stands and stands_until(mode, t, end, a.y, case.p, ground, a.g)
    if cut or stands:
        h, cut = end - t, True
    if still:
        stay(a)
    whole = h
    hop, flight = free_flight(mode, motion.closed, t, a.y, case.p, a.k)
    hops = flight < 0.9 * h
    if hops:
        h = flight
    return Step(
        h=h, end=end, longest=longest, whole=whole,
        bound=most_error(case.rtol) if equal else 1.0, error=0.0,
        cut=cut, equal=equal, still=still, stands=stands, hops=hops, hop=hop, target=-1, landed=-1,
        lands=False, slope=0.0, more=0.0, corrections=0, value=0.0, moved=0.0, overlooked=0,
        sampled=motion.sampled and motion.closed < 0 and not still, overturns=False, turns=False,
        h_next=h_next, last_error=motion.last_error, refined_to=motion.refined_to,
        refined=motion.refined, taken=motion.taken + int(stands), outcome=COMPLETED,
    )  # fmt: skip


@inlined
def proposed_step(h_next, t, refined_to, ground, case):
    """(length, whether it is an equal one), by the control of the error or by the segment."""
    span = np.inf
    for axis in unrolled(range(AXES)):
        span = min(span, ground[axis].row[1] - ground[axis].row[0])
    equal = case.fixed > 0 and t >= refined_to and span < np.inf
    return span / case.fixed if equal else h_next, equal


@inlined
def stay(a):
    """The end of a step in which nothing moves: the state is known without it."""
    for i in range(N_STATES):
        a.y_new[i] = a.y[i]
        a.k[END + i] = 0.0
    for i in range(8 * N_STATES):
        a.coefficients[i] = a.y[i] if i < N_STATES else 0.0


@inlined
def take(motion, ground, step, error, case, a):
    """Take a step, unless it was taken before with an error that is no longer to be judged."""
    if error != -1.0:
        return step._replace(error=error)
    taken = step.taken + 1
    if step.still:
        return step._replace(error=0.0, taken=taken)
    new = take_step(
        motion.mode, motion.t, step.h, a.y, case.p, ground, case.rtol, case.atol, a.k,
        a.y_new,
    )  # fmt: skip
    return step._replace(error=new, taken=taken)


@inlined
def judge(motion, ground, step, case, a, recorder):
    """(verdict, step): a step that was taken is to be taken AGAIN, otherwise, or is DONE."""
    finite = math.isfinite(step.error) and finite_end(a.k)
    if not finite or step.error > step.bound:
        return refuse(motion, step, finite, case, a)
    gap = gap_at_ends(side_of(motion.mode), step.h, a.y, a.y_new, a.k)
    tried = step
    if tried.hops:
        if not hop_ends(motion, ground, tried, gap, case, a):
            return AGAIN, without_hop(tried)
        tried = tried._replace(hops=False, cut=False, lands=True, target=tried.hop)
    if tried.target >= 0:
        verdict, tried = land(motion, ground, tried, case, a)
        if verdict == AGAIN:
            return AGAIN, tried
    elif not (tried.cut or tried.still):
        h_next, last_error = controlled(tried.h, tried.error, tried.last_error)
        tried = tried._replace(h_next=h_next, last_error=last_error)
    open_ = False
    if tried.landed < 0 and not tried.still:
        guard, place, open_, closed = certain_event(motion, ground, tried, gap, case, a)
        if guard >= 0:
            h = tried.h * place
            return AGAIN, tried._replace(lands=True, target=guard, h=h, cut=False, sampled=False)
        tried = tried._replace(sampled=open_)
        unsure = not (open_ or closed or rocking(motion.mode) or motion.closed >= 0)
        open_ = open_ or (unsure and stays_held(motion.mode, motion.t, tried.h, ground, case, a))
    return look_within(motion, ground, tried, gap, open_, case, a, recorder)


@inlined
def refuse(motion, step, finite, case, a):
    """A step that is too inaccurate, or not finite: shorter."""
    shrink = 0.9 * step.error**ERROR_EXPONENT if finite else 0.1
    h = step.h * max(0.1, shrink)
    outcome = COMPLETED
    if h <= 4.0 * EPS * motion.t or h < LEAST_PRODUCT or step.taken >= case.max_steps:
        number = step.error == step.error and finite_end(a.k)  # else no step is short enough
        outcome = STALLED if number else NOT_FINITE
    return AGAIN if outcome == COMPLETED else DONE, step._replace(
        h=h,
        h_next=h,
        equal=False,
        bound=1.0 if step.equal else step.bound,
        refined_to=step.end if step.equal else step.refined_to,
        refined=step.refined + int(step.equal),
        cut=False,
        hops=False,
        lands=False,
        target=-1,
        corrections=0,
        outcome=outcome,
    )


@inlined
def land(motion, ground, step, case, a):
    """(verdict, step): correct what is left of the guard at the end of a step that ends on it."""
    certain = rocking(motion.mode) or step.lands
    tau, near = motion.t + step.h, 0.01  # near : the largest correction that is believed
    value = 0.0
    if certain:
        move = time_to_landing(motion, step, case, a)
        near = 0.1 if step.corrections == 0 else 0.01
    else:
        ends_before = 0.0
        if BENT and kind_of(motion.mode, step.target) == STICKING:
            # within the step, however short it is: by no more than half of what is left there
            guards(motion.mode, a.y, case.p, *ground_accelerations(ground, motion.t), a.g)
            ends_before = min(SPEED_AT_STOP, case.rtol, 0.5 * max(a.g[step.target], 0.0))
            near = 0.6 if step.corrections == 0 else near
        guards(motion.mode, a.y_new, case.p, *ground_accelerations(ground, tau), a.g)
        value, slope = a.g[step.target] - ends_before, step.slope
        if BENT and step.corrections > 0 and (value - step.value) * step.moved < 0.0:
            slope = (value - step.value) / step.moved
        move = -value / slope if slope < 0.0 else 0.0
    least = max(2.0 * EPS * tau, PLACED * case.rtol * step.h)
    small = math.sqrt(max(LEAST_OF_QUINTIC, min(PLACED_BY_QUINTIC, case.rtol))) * step.h
    more = step.more
    if certain and EXTRAPOLATES and abs(move) <= small:
        extrapolate(step.h, move, a.y, a.y_new, a.k)
        more = move
    elif step.corrections < 8 and least < abs(move) < near * step.h:
        return AGAIN, step._replace(
            corrections=step.corrections + 1, h=step.h + move, value=value, moved=move
        )
    misplaced = abs(move) >= 0.01 * step.h
    misplaced = misplaced or (
        not certain
        and fell_before(motion.mode, step.target, motion.closed, step.h, a.y_new, a.g, a.b)
    )
    if misplaced and kind_of(motion.mode, step.target) == LANDING:
        misplaced = not is_rounding(motion.mode, step.target, a.y_new, case.p)
    if misplaced and step.h > SHORTEST_PART * step.longest:
        # the guard is not where its polynomial put it: look again in less time
        return AGAIN, step._replace(
            h=step.h * 0.5, lands=False, target=-1, corrections=0, more=more
        )
    return UNDECIDED, step._replace(landed=step.target, more=more)


@inlined
def look_within(motion, ground, step, gap, open_, case, a, recorder):
    """(verdict, step): make the dense output where something may happen within, and look there."""
    mode, t = motion.mode, motion.t
    overturns = may_fall(case.fallen, gap, step.h, a.y, a.y_new, a.k, case.p)
    turns = records_extremes(recorder) and widens(recorder.extremes, step.h, a.y, a.y_new, a.k)
    leaves = acts_beside(mode, motion.closed, a.y, a.y_new)
    closes = acts_beside(mode, step.landed, a.y_new, a.y)
    wanted = records_steps(recorder) or turns or overturns or leaves or closes
    if not step.still and (wanted or not (open_ or step.landed >= 0)):
        dense_output(mode, t, step.h, a.y, case.p, ground, a.k, a.coefficients)
        if step.more != 0.0:
            lengthen(step, a)
    h = step.h + step.more
    again = (leaves or closes) and step.overlooked < 20
    if again and overlooks(mode, t, h, ground, case, a, closes):
        h *= 0.3
        return AGAIN, step._replace(
            h=h, h_next=h, overlooked=step.overlooked + 1, cut=False, target=-1, landed=-1,
            corrections=0, overturns=overturns, turns=turns,
        )  # fmt: skip
    seen = step._replace(h=h, overturns=overturns, turns=turns)
    if open_ or (seen.landed >= 0 and not closes):
        return DONE, seen
    return first_event_within(motion, ground, seen, case, a)


@inlined
def lengthen(step, a):
    """Move the end of the dense output to where `extrapolate` has put the state."""
    shorten(a.coefficients, 1.0 + step.more / step.h)
    for i in range(N_STATES):
        left = a.y_new[i] - power_sum(a.coefficients, 1.0, i)
        a.coefficients[7 * N_STATES + i] += left


@inlined
def first_event_within(motion, ground, step, case, a):
    """(verdict, step): up to the first guard that falls by its polynomial over the step."""
    mode, t = motion.mode, motion.t
    instant = 4.0 * EPS * max(t, step.h)
    guard_polynomials(mode, t, step.h, ground, case, a)
    fall = first_event(mode, t, step.h, instant, step.landed, motion.closed, ground, case, a)
    seen = step._replace(target=fall.guard, slope=fall.slope)
    if fall.place == NEVER:
        return DONE, seen
    h = step.h
    if fall.place * h <= instant:
        if rocking(mode):
            # it does not fall where both its rate and its acceleration open it
            slow = a.y[ROTATION_RATE] == 0.0 or side_of(mode) * a.k[ROTATION_RATE] > 0.0
        else:
            noise = noise_of(mode, fall.guard, case.p, case.fallen, a.noises, a.w, a.g)
            slow = fall.unclear or opens_soon(mode, fall.guard, t, h, ground, case, a, noise)
        shortest = max(SHORTEST_PART * step.longest, SAME_INSTANT * t)
        if fall.from_closed and slow and h > shortest:
            # an opening so short that rounding, or the error of a dense output of low order,
            # hides it in a step of this length
            return AGAIN, seen._replace(h=h * 0.1, cut=False, target=-1, landed=-1)
        h = 0.0  # it falls here and now
    if fall.place >= 1.0 or h == 0.0:
        return DONE, seen._replace(h=h, landed=fall.guard)
    return AGAIN, seen._replace(h=h * fall.place, cut=False, landed=-1)


@inlined
def fall_over(step, case, a):
    """The step up to where the structure has overturned, if it has."""
    x = NEVER
    if step.h > 0.0 and step.overturns:
        x = falls_at(a.coefficients, case.fallen, case.p, a.b, a.stack)
    if x == NEVER:
        return step
    dense_at(a.coefficients, x, a.y_new)
    shorten(a.coefficients, x)
    return step._replace(h=step.h * x, cut=False, outcome=OVERTURNED)


@inlined
def with_control(motion, step):
    """The motion with what a step has changed of the control of its length, and its outcome."""
    return motion._replace(
        h_next=step.h_next,
        last_error=step.last_error,
        refined_to=step.refined_to,
        refined=step.refined,
        taken=step.taken,
        outcome=step.outcome,
    )


@inlined
def accept(motion, step, case, a, recorder):
    """(motion, guard, h): record a step, and go on from its end; the guard that ends the mode."""
    went = with_control(motion, step)
    went = went._replace(still=step.still, sampled=step.sampled and not step.overturns)
    t, h = motion.t, step.h
    if h > 0.0:
        if records_steps(recorder):
            record_step(recorder, went.n_steps, t, h, motion.mode, a.coefficients)
            went = went._replace(n_steps=went.n_steps + 1)
        if records_extremes(recorder):
            if step.turns:
                widen_within(recorder.extremes, a.coefficients)
            widen(recorder.extremes, a.y)  # an event may have changed it since the last step
            widen(recorder.extremes, a.y_new)
        for i in range(N_STATES):
            a.y[i] = a.y_new[i]
            a.k[i] = a.k[END + i]
        idle = motion.idle if h < SAME_INSTANT * t else 0  # it is one instant, but for rounding
        t = step.end if step.cut or t + h > step.end else t + h
        went = went._replace(t=t, closed=-1, idle=idle, follows=0)
    if step.outcome == COMPLETED and step.taken >= case.max_steps:
        went = went._replace(outcome=STALLED)
    return went, step.landed, h


# -- an event --------------------------------------------------------------------------------------


@inlined
def leave_mode(motion, ground, guard, h, case, a, recorder):
    """The motion after the event of a guard, and after a rest that may follow from it."""
    kind, end = kind_of(motion.mode, guard), end_of_segments(ground, case)
    left, rest = transition(
        motion._replace(idle=motion.idle + 1), ground, guard, h, end, case, a, recorder
    )
    if left.outcome != COMPLETED:
        return left._replace(closed=-1)
    if not rest.stepped:
        if kind != IMPACT and kind != LANDING:
            return left
        left = left._replace(impacts=left.impacts + 1)
        if left.impacts > case.max_impacts:
            return left._replace(outcome=TOO_MANY_IMPACTS)
        left, rest = zeno_time(left, ground, end, case, a)
    if not (rest.stepped or left.t + rest.time < end or rest.time < 16.0 * EPS * left.t):
        return left
    return come_to_rest(left, ground, rest, end, case, a, recorder)


@inlined
def come_to_rest(motion, ground, rest, end, case, a, recorder):
    """Record the rest of infinitely many impacts, and go on in the mode that follows them."""
    t = motion.t
    mode, rests = through_rest(motion, ground, rest, case, a, recorder)
    if not rests:
        return motion
    rested = motion
    if records_steps(recorder) and t + rest.time > t:
        record_step(recorder, motion.n_steps, t, rest.time, mode, a.coefficients)
        rested = rested._replace(n_steps=motion.n_steps + 1)
    t = min(t + rest.time, end) if rest.stepped else t + rest.time
    guard = STEPPED_OVER if rest.stepped else -1
    record_event(recorder, motion.n_events, t, REST, motion.mode, rest.mode, guard, a.w, a.y_new)
    if records_extremes(recorder):
        widen(recorder.extremes, a.y)
        widen(recorder.extremes, a.y_new)
    for i in range(N_STATES):
        a.y[i] = a.y_new[i]
    return rested._replace(t=t, mode=rest.mode, closed=-1, h_next=0.0, n_events=motion.n_events + 1)
