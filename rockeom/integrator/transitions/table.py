"""Transitions of declared modes: a table says which mode follows which guard.

The contract of transitions, which search.py fulfils for points that may open, slide and bounce.
"""

import numpy as np

from rockeom.codes import BOUND, CHATTER, IMPACT, UPLIFT
from rockeom.compiler.decorators import inlined
from rockeom.integrator.bernstein import NEVER
from rockeom.integrator.ground import ground_accelerations
from rockeom.integrator.guards import (
    closes_once,
    rises_and_falls,
    rocking,
    stays_open,
    to_impact,
)
from rockeom.integrator.provided import (
    LOCALISED,
    N_STATES,
    ROTATION_RATE,
    dense_output,
    guards_in,
    jump,
    kind_of,
    rates,
    reverse_of,
    side_of,
    target_of,
)
from rockeom.integrator.recorder import end_at_bound, enter_mode
from rockeom.integrator.records import Rest, records_steps
from rockeom.integrator.rounding import noise_of
from rockeom.integrator.tolerances import LEAST_PRODUCT
from rockeom.integrator.transitions.declared import may_fade, stand, time_to_rest
from rockeom.integrator.transitions.restitution import velocity_ratio_at

MOST_IDLE = 100  # events at one instant; with more they are chatter
QUIET_STEPS = not LOCALISED  # whether `quiet_steps` takes steps in which nothing can happen
EXTRAPOLATES = not LOCALISED  # whether the end of a step may be moved on its quintics


@inlined
def initial_mode_is_one(mode, y, p, shaking):
    """Whether no other mode may begin in a state."""
    return True


@inlined
def jammed(motion, guard, ground, case, a):
    """(mode, guard) as they are: no point jams, see search.py."""
    return motion.mode, guard


@inlined
def longest_turn(y):
    """The longest step in which eight samples follow a gap: the gap of a foot is the rotation."""
    return np.inf


@inlined
def is_rounding(mode, guard, y, p):
    """Whether a gap is closed but for rounding errors."""
    return False


@inlined
def free_flight(mode, closed, t, y, p, k):
    """(guard, time): a hop so short that its parabola tells where it ends, or an infinite time."""
    if LOCALISED or closed != 0 or not rocking(mode):
        return 0, np.inf
    flight = -2.0 * y[ROTATION_RATE] / k[ROTATION_RATE]
    height = side_of(mode) * y[ROTATION_RATE] * flight  # not lost among the smallest numbers
    return 0, flight if flight > 0.0 and height > LEAST_PRODUCT else np.inf


@inlined
def hop_ends(motion, ground, step, gap, case, a):
    """Whether a step that is one hop clearly ends where it closes again."""
    near = abs(to_impact(side_of(motion.mode), a.y_new, a.k)) < 0.1 * step.h
    return near and rises_and_falls(gap)


@inlined
def without_hop(step):
    """The step to try where a hop is no parabola: one must not end just beside an impact."""
    return step._replace(hops=False, cut=False, h=step.h * 0.5)


@inlined
def certain_event(motion, ground, step, gap, case, a):
    """(guard, place, open, closed): the guard that clearly falls in a step, and where, or -1.

    open : all guards clearly stay open. closed : one is below zero at the end.
    """
    open_, place = False, NEVER
    if rocking(motion.mode):
        open_ = stays_open(gap, motion.closed == 0)
        place = NEVER if open_ or LOCALISED else closes_once(gap, motion.closed == 0)
    return 0 if place < NEVER else -1, place, open_, False


@inlined
def time_to_landing(motion, step, case, a):
    """Time from the end of a step to the landing beside it, infinite where there is none."""
    return to_impact(side_of(motion.mode), a.y_new, a.k)


@inlined
def transition(motion, ground, guard, h, end, case, a, recorder):
    """(motion, rest): in the mode that follows the event of a guard; no rest follows from it."""
    before, kind = motion.mode, kind_of(motion.mode, guard)
    if kind == BOUND:
        return end_at_bound(motion, guard, a, recorder), Rest(np.inf, before, False)
    if motion.idle > MOST_IDLE:
        return motion._replace(outcome=CHATTER), Rest(np.inf, before, False)
    ratio = velocity_ratio_at(case.law, case.ratio, motion.impacts, a.y[ROTATION_RATE], case.p)
    mode = jump(before, guard, case.law, ratio, a.y, case.p, a.after)
    closed = -1
    if kind != IMPACT or side_of(mode) != 0.0:
        closed = reverse_of(before, guard)
    elif motion.idle > 1:
        # it opened and closed in no time: that uplift was none
        for i in range(guards_in(mode)):
            if target_of(mode, i) == before:
                closed = i
    return enter_mode(motion, guard, mode, closed, a, recorder), Rest(np.inf, mode, False)


@inlined
def zeno_time(motion, ground, end, case, a):
    """(motion, rest): when the infinitely many impacts to come will all have happened."""
    mode, t = motion.mode, motion.t
    rest = Rest(np.inf, mode, False)
    if side_of(mode) == 0.0:
        return motion, rest
    shaking = ground_accelerations(ground, t)
    rates(mode, a.y, case.p, *shaking, a.k)
    if not may_fade(side_of(mode), a.y, a.k, case.law, case.ratio, case.rest_tolerance):
        # the next step begins with these rates
        stands = rocking(mode) and t < end and motion.h_next != 0.0
        stale, due = motion.rate_stale and not stands, motion.guard_due and not stands
        return motion._replace(rate_stale=stale, guard_due=due), rest
    time, follows = time_to_rest(
        mode, a.y, case.p, case.law, case.ratio, motion.impacts, shaking, case.rest_tolerance,
        a.after,
    )  # fmt: skip
    return motion._replace(follows=follows), Rest(time, follows, False)


@inlined
def through_rest(motion, ground, rest, case, a, recorder):
    """(mode, whether it is known): the motion until the rest, in this mode.

    Into y_new the state after it, into w that had the impacts not faded yet, and the dense output.
    """
    t = motion.t
    stands = stand(
        rest.mode, t, rest.time, a.after, case.p, ground, case.rtol, case.atol, a.k, a.y_new
    )
    if stands and records_steps(recorder) and t + rest.time > t:
        dense_output(rest.mode, t, rest.time, a.after, case.p, ground, a.k, a.coefficients)
    for i in range(N_STATES):
        a.w[i] = a.y[i] + (a.y_new[i] - a.after[i])
    return rest.mode, stands


@inlined
def just_closed(closed, i):
    """Whether a guard is known to be closed: its number is `closed`."""
    return closed == i


@inlined
def grain_of(mode, index, shaking, h, b, stride, case, a):
    """Size of the rounding errors of a guard."""
    return noise_of(mode, index, case.p, case.fallen, a.noises, a.w, a.g)


@inlined
def can_move(mode, y, p):
    """Whether the ground may move something in full contact: a state besides the rotation's."""
    return N_STATES > 2


@inlined
def standing(mode, y, p):
    """Whether a structure stands on both its feet."""
    return side_of(mode) == 0.0 and kind_of(mode, 0) == UPLIFT
