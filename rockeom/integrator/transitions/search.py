"""Transitions of points that may open, slide and bounce: the mode that follows is searched.

The contract of transitions, as table.py fulfils it for declared modes.
"""

import numpy as np

from rockeom.codes import (
    AMBIGUOUS,
    BOUND,
    CHATTER,
    IMPOSSIBLE,
    LANDING,
    LIFTING,
    NO_SOLUTION,
    OVERTURNED,
    SEVERAL_SOLUTIONS,
    SLIP_RIGHT,
    SLIPPING,
    STALLED,
    STAYS_OPEN,
    STICKING,
    SWITCH,
)
from rockeom.compiler.decorators import inlined
from rockeom.integrator.bernstein import NEVER
from rockeom.integrator.ground import ground_accelerations
from rockeom.integrator.provided import (
    DIRECTIONS,
    N_POINTS,
    N_STAGES,
    N_STATES,
    guards,
    held_upright,
    kind_of,
    point_state,
    tips_over,
    without,
)
from rockeom.integrator.recorder import end_at_bound, enter_mode
from rockeom.integrator.records import Rest, State
from rockeom.integrator.rounding import noise_of
from rockeom.integrator.tolerances import (
    FIRST_STEP_OF_SLIP,
    JAMMED,
    SAME_INSTANT,
    SOON_IN_STEP,
)
from rockeom.integrator.transitions.candidates import (
    GROUND_SIZE,
    fits_by_forces,
    ground_now_and_later,
    guard_noise,
    nothing_moves,
    pass_on,
    still_closed,
    without_forces,
)
from rockeom.integrator.transitions.landings import end_closed, fall_within, single_hop, to_landing
from rockeom.integrator.transitions.points import ROWS, contact_data, is_closed
from rockeom.integrator.transitions.zeno import step_over, time_of_bounces

MOST_IDLE = 1000  # events at one instant; with more they are chatter
CROWDED = 20  # after so many of them points step over the time of a rest
QUIET_STEPS = False  # see table.py
EXTRAPOLATES = True


@inlined
def initial_mode_is_one(mode, y, p, shaking):
    """Whether no other mode may begin in a state."""
    return fits_by_forces(mode, y, p, shaking) != AMBIGUOUS


@inlined
def jammed(motion, guard, ground, case, a):
    """(mode, guard) as they are, or, where a point jams, that it lands, in a mode without it.

    In space the force at a point that slips may grow beyond all bounds, as 1/sqrt(t' - t), where
    friction presses it down more than it lifts it (Painleve 1895). Only an impact ends that. No
    step is short enough then, or one passes over it, and a force of the other sign `guard` tells.
    """
    mode, follows, most = motion.mode, guard, JAMMED
    stalls = motion.outcome == STALLED and motion.taken < case.max_steps
    if DIRECTIONS == 3 and (stalls or (guard >= 0 and kind_of(mode, guard) == LIFTING)):
        wanted, sizes = np.empty(ROWS), np.empty(ROWS + N_POINTS)
        shaking = ground_accelerations(ground, motion.t)
        contact_data(a.y, case.p, mode, a.contact)
        without_forces(a.y, case.p, shaking, mode, a.contact, wanted, sizes)
        guards(mode, a.y, case.p, *shaking, a.g)
        for i in range(N_POINTS):
            part = abs(a.g[i]) / sizes[ROWS + i]
            if part > most and point_state(motion.mode, i) == SLIP_RIGHT:
                mode, follows, most = without(motion.mode, i), i, part
    return mode, follows


@inlined
def free_flight(mode, closed, t, y, p, k):
    """(guard, time): a hop so short that its parabola tells where it ends, or an infinite time."""
    if not closed > 0:
        return 0, np.inf
    hop, flight = single_hop(mode, closed, y, p, k)
    return hop, flight if SAME_INSTANT * t < flight else np.inf


@inlined
def hop_ends(motion, ground, step, gap, case, a):
    """Whether a step that is one hop clearly ends where it closes again."""
    guard, _ = fall_within(motion, ground, step, False, step.hop, case, a)
    return guard == step.hop


@inlined
def without_hop(step):
    """The step to try where a hop is no parabola: the one that was planned."""
    return step._replace(hops=False, h=step.whole)


@inlined
def certain_event(motion, ground, step, gap, case, a):
    """(guard, place, open, closed): the guard that clearly falls in a step, and where, or -1.

    open : all guards clearly stay open. closed : one is below zero at the end.
    """
    guard, place = fall_within(motion, ground, step, step.sampled, -1, case, a)
    open_ = guard == STAYS_OPEN
    closed = guard < 0 and not open_ and end_closed(motion.mode, a.b)
    return guard if guard >= 0 else -1, place if guard >= 0 else NEVER, open_, closed


@inlined
def time_to_landing(motion, step, case, a):
    """Time from the end of a step to the landing beside it, infinite where there is none."""
    return to_landing(motion.mode, step.target, a.y_new, case.p, a.k[N_STAGES * N_STATES :])


@inlined
def transition(motion, ground, guard, h, end, case, a, recorder):
    """(motion, rest): in the mode that follows the event of a guard, or after a step over events.

    Events without end at one instant, and one that nothing may follow, are stepped over.
    """
    rest = Rest(np.inf, motion.mode, False)
    if kind_of(motion.mode, guard) == BOUND:
        return end_at_bound(motion, guard, a, recorder), rest
    if motion.idle > MOST_IDLE:
        outcome = CHATTER
        if motion.follows < 0:  # the impacts have an end, but nothing that may follow it
            outcome = failure_of(motion.follows, a.y, case.p)
        return motion._replace(outcome=outcome), rest
    if CROWDED * int(motion.idle / CROWDED) == motion.idle:
        rest = stepped_over(motion, ground, end, False, case, a)
        if rest.stepped:
            return after_step_over(motion, rest), rest
    length = max(h, min(motion.h_next, end - motion.t))
    tau = SOON_IN_STEP * length
    shaking = ground_accelerations(ground, motion.t)
    later = ground_accelerations(ground, motion.t + tau)
    accelerations = np.empty(GROUND_SIZE)
    ground_now_and_later(shaking, later, tau, accelerations)
    mode, closed = pass_on(
        motion.mode, guard, length, a.y, case.p, accelerations, case.rtol, a.contact, a.after
    )
    kind = kind_of(motion.mode, guard)
    left = motion
    if DIRECTIONS == 3 and mode == IMPOSSIBLE and kind == LIFTING:
        # what begins jammed has no other way out than an impact, either
        left, kind = motion._replace(mode=without(motion.mode, guard)), LANDING
        mode, closed = pass_on(
            left.mode, guard, length, a.y, case.p, accelerations, case.rtol, a.contact, a.after
        )
    if mode < 0:
        rest = stepped_over(motion, ground, end, True, case, a)
        # what has come to its end and goes on as before is no way out
        if rest.stepped and (kind == LANDING or rest.mode != motion.mode):
            return after_step_over(motion, rest), rest
        return motion._replace(outcome=failure_of(mode, a.y, case.p)), rest
    if kind == SWITCH:
        closed = still_closed(motion.mode, mode, guard, motion.closed, closed)
    went = enter_mode(left, guard, mode, closed, a, recorder)
    if DIRECTIONS == 3 and kind in (SLIPPING, STICKING):
        went = went._replace(h_next=min(went.h_next, FIRST_STEP_OF_SLIP))
    return went, Rest(np.inf, mode, False)


@inlined
def state_of(motion, ground, case, a):
    """The state of a motion between two steps, with the ground there."""
    return State(motion.mode, a.y, case.p, ground_accelerations(ground, motion.t))


@inlined
def failure_of(mode, y, p):
    """The outcome where no mode follows, or several; a fall that has no solution is a fall."""
    if mode != IMPOSSIBLE:
        return SEVERAL_SOLUTIONS
    return OVERTURNED if tips_over(y, p) else NO_SOLUTION


@inlined
def after_step_over(motion, rest):
    return motion._replace(closed=-1, follows=rest.mode, rate_stale=True, guard_due=True)


@inlined
def stepped_over(motion, ground, end, fits, case, a):
    """The rest after a step over events, not stepped where there is none; its state in y_new."""
    state = state_of(motion, ground, case, a)
    longest = end - motion.t
    time, mode = step_over(state, case.rest_tolerance, longest, fits, case.rtol, a.contact, a.y_new)
    return Rest(time, mode, time < np.inf)


@inlined
def zeno_time(motion, ground, end, case, a):
    """(motion, rest): when the infinitely many impacts to come will all have happened."""
    state = state_of(motion, ground, case, a)
    time, follows = time_of_bounces(state, case.rest_tolerance, case.rtol, a.contact, a.y_new)
    return motion._replace(follows=follows), Rest(time, follows, False)


@inlined
def through_rest(motion, ground, rest, case, a, recorder):
    """(mode, whether it is known): the motion until the rest, in this mode: a straight line.

    Into w the state before the rest, and the dense output.
    """
    for i in range(8 * N_STATES):
        a.coefficients[i] = 0.0
    for i in range(N_STATES):
        a.coefficients[i] = a.w[i] = a.y[i]
        a.coefficients[N_STATES + i] = a.y_new[i] - a.y[i]
    return motion.mode, True


@inlined
def just_closed(closed, i):
    """Whether a guard is known to be closed: one of several."""
    return is_closed(closed, i)


@inlined
def grain_of(mode, index, shaking, h, b, stride, case, a):
    """Size of the rounding errors of a guard: of an element's, or of a gap or a force."""
    if kind_of(mode, index) == SWITCH:
        return noise_of(mode, index, case.p, case.fallen, a.noises, a.w, a.g)
    return guard_noise(mode, index, a.y, case.p, shaking, h, b, stride)


@inlined
def can_move(mode, y, p):
    """Whether the ground moves something in a mode, in a state at rest."""
    return not nothing_moves(mode, y, p)


@inlined
def standing(mode, y, p):
    """Whether points are closed that keep the structure from turning."""
    return held_upright(mode, y, p)
