"""Rows of the record of a motion, and the mode that begins with an event."""

from rockeom.codes import LIFTING, OUT_OF_BOUNDS, OVERTURNED, UPLIFT
from rockeom.compiler.decorators import inlined
from rockeom.integrator.provided import N_STATES, is_tilt, kind_of


def record_step(recorder, row, t, h, mode, coefficients):
    """The start, length, mode and dense output of a step."""
    recorder.steps[row, 0] = t
    recorder.steps[row, 1] = h
    recorder.step_modes[row] = mode
    for j in range(8):
        for i in range(N_STATES):
            recorder.step_states[row, j, i] = coefficients[j * N_STATES + i]


def record_event(recorder, row, t, kind, before, after, guard, y, y_after):
    """The time, kind, modes, guard and states of an event."""
    recorder.events[row] = t
    recorder.event_kinds[row, 0] = kind
    recorder.event_kinds[row, 1] = before
    recorder.event_kinds[row, 2] = after
    recorder.event_kinds[row, 3] = guard
    for i in range(N_STATES):
        recorder.event_states[row, 0, i] = y[i]
        recorder.event_states[row, 1, i] = y_after[i]


@inlined
def enter_mode(motion, guard, mode, closed, a, recorder):
    """Record an event, and go on in the mode that follows, from the state after it."""
    kind = kind_of(motion.mode, guard)
    record_event(recorder, motion.n_events, motion.t, kind, motion.mode, mode, guard, a.y, a.after)
    for i in range(N_STATES):
        a.y[i] = a.after[i]
    # where a gap opens, it opens slowly: its first moments want a short step
    h_next = 0.0 if kind in (UPLIFT, LIFTING) else motion.h_next
    return motion._replace(
        mode=mode,
        closed=closed,
        h_next=h_next,
        rate_stale=True,
        guard_due=True,
        n_events=motion.n_events + 1,
    )


@inlined
def end_at_bound(motion, guard, a, recorder):
    """Record where a motion reaches a bound, and end it there."""
    for i in range(N_STATES):
        a.after[i] = a.y[i]
    outcome = OVERTURNED if is_tilt(motion.mode, guard) else OUT_OF_BOUNDS
    return enter_mode(motion, guard, motion.mode, -1, a, recorder)._replace(outcome=outcome)
