"""Tangents: derivatives propagated along a motion, by one text for every structure and method.

The text is printed for numbers with derivatives, see `rockeom.integrator.program`: the steps that a
motion was made of are repeated with all derivatives in them. The motion is known by then, so that
it is the same to the last bit, with derivatives or without.

Derivatives are those at a fixed time, except at an event: its time varies with the numbers that the
motion depends on, by

    tau = -dg / (dg/dt along the motion)

of the guard g that falls there. The states on both sides of it follow the event, through the same
transition as in the loop, and return to the fixed time by the rates on either side.
"""

from typing import NamedTuple

import numpy as np

from rockeom.codes import GRAZES, IMPACT, LANDING, OTHER_WAY, REST, STEPPED_OVER
from rockeom.compiler.decorators import (
    Duals,
    Duals2,
    Duals3,
    Floats,
    Floats2,
    Ints,
    entry,
    inlined,
    unrolled,
)
from rockeom.integrator.full_contact import cannot_move
from rockeom.integrator.ground import (
    ground_accelerations,
    ground_at,
    segment_at,
    segment_of,
    tables,
)
from rockeom.integrator.provided import (
    AXES,
    CONTACT_SIZE,
    N_ALL_STAGES,
    N_GUARDS,
    N_PARTS,
    N_POINTS,
    N_STATES,
    ROTATION_RATE,
    guards,
    jump,
    moving,
    rate,
    rates,
    take_step,
    value,
)
from rockeom.integrator.records import Case, Ground, Recorder, Segment, State
from rockeom.integrator.tolerances import BEND_OF_GUARD, SAME_RATES, SOON_IN_STEP
from rockeom.integrator.transitions.candidates import GROUND_SIZE, ground_now_and_later, pass_on
from rockeom.integrator.transitions.declared import stand, time_to_rest
from rockeom.integrator.transitions.restitution import velocity_ratio_at
from rockeom.integrator.transitions.zeno import time_of_bounces

DIGITS = 10_000.0
"""How many times the tolerance a guard must have sunk below zero, had nothing happened there:
below, less than two digits of its derivatives are known."""


class Varied(NamedTuple):
    """The numbers of a motion with their derivatives.

    horizontal, transverse, vertical : tables of the ground motion, empty where nothing in them
    varies; corners : whether the ends of their segments do. p, ratio (1,) : as of `Case`. longest :
    of the steps in which derivatives are propagated, see `take_parts`.
    """

    horizontal: Duals2
    transverse: Duals2
    vertical: Duals2
    corners: bool
    p: Duals
    ratio: Duals
    longest: float


class Tangents(NamedTuple):
    """Where the states with their derivatives are written.

    y (N,) : at the start, and on return at the end. times (q,) : ascending, with the states (q, N)
    there. event_states (k, 2, N) : on both sides of each event, and event_times (k,), as they move.
    reached (1,) : the event up to which they are known.
    """

    times: Floats
    y: Duals
    states: Duals2
    event_states: Duals3
    event_times: Duals
    reached: Ints


class Scratch(NamedTuple):
    """Arrays to work in; states and rates are (N,).

    rate : before an event, or at the start of a step. y_later, rate_later : a little later. stages
    : rates at the stages of a step. y_new : the state at its end. y_before, y_after : on both sides
    of an event, which moves. y_moving : along a direction. guards : all of a mode. points : see
    `contact_data`.
    """

    rate: Floats
    y_later: Floats
    rate_later: Floats
    stages: Duals
    y_new: Duals
    y_before: Duals
    y_after: Duals
    y_moving: Duals
    guards: Duals
    points: Duals


class Setup(NamedTuple):
    """Data that stay the same while derivatives are propagated, and the arrays that they fill."""

    recorder: Recorder
    case: Case
    varied: Varied
    out: Tangents
    scratch: Scratch


class Segments(NamedTuple):
    """The segments of the ground that hold, and how they begin.

    tau : derivatives of the times at which they begin, along each axis; their values are zero.
    """

    ground: Ground
    tau: tuple[float, ...]


class Progress(NamedTuple):
    """How far derivatives are propagated.

    event, step, query : numbers of the next event, step and time that is asked for. impacts : so
    far. length : of the last step, zero after an event.
    """

    event: int
    step: int
    query: int
    impacts: int
    length: float


class RecordedEvent(NamedTuple):
    """An event of a motion; guard : that fell, or STEPPED_OVER."""

    time: float
    kind: int
    mode_before: int
    mode_after: int
    guard: int


@entry
def propagate_tangents(
    recorder: Recorder, case: Case, varied: Varied, out: Tangents, floats: Floats2
) -> int:
    """Propagate the state at the start with its derivatives to the end of a recorded motion.

    recorder : steps, with their dense output, and events of the motion. floats (3, N) : scratch.
    Returns 0, GRAZES, or OTHER_WAY where a transition is not found again.
    """
    scratch = Scratch(
        rate=floats[0], y_later=floats[1], rate_later=floats[2],
        stages=np.zeros(N_ALL_STAGES * (N_STATES + AXES)), y_new=np.zeros(N_STATES),
        y_before=np.zeros(N_STATES), y_after=np.zeros(N_STATES), y_moving=np.zeros(N_STATES),
        guards=np.zeros(N_GUARDS + N_PARTS), points=np.zeros(CONTACT_SIZE),
    )  # fmt: skip
    setup = Setup(recorder, case, varied, out, scratch)
    segments = first_segments(case)
    progress = Progress(event=0, step=0, query=0, impacts=0, length=0.0)
    while progress.step < len(recorder.steps) or progress.event < len(recorder.events):
        if event_is_next(progress, recorder):
            event = event_at(progress.event, recorder)
            # an impact moves by its guard, also where a segment begins at the same instant
            if not is_impact(event):
                segments = segments_at(event.time, event.mode_before, segments, setup)
            out.reached[0] = progress.event
            code, progress = cross_events(progress, segments, setup)
            if code != 0:
                return code
        else:
            t, mode = recorder.steps[progress.step, 0], recorder.step_modes[progress.step]
            segments = segments_at(t, mode, segments, setup)
            progress = cross_step(progress, segments, setup)
    for i in range(progress.query, len(out.times)):
        out.states[i][:N_STATES] = out.y
    out.reached[0] = progress.event
    return 0


@inlined
def event_at(i, recorder):
    kinds = recorder.event_kinds[i]
    return RecordedEvent(recorder.events[i], kinds[0], kinds[1], kinds[2], kinds[3])


def is_impact(event):
    return event.kind in (IMPACT, LANDING)


@inlined
def event_is_next(progress, recorder):
    """Whether an event comes before the next step, or at its start."""
    i, step = progress.event, progress.step
    steps_left, events_left = step < len(recorder.steps), i < len(recorder.events)
    return events_left and (not steps_left or recorder.events[i] <= recorder.steps[step, 0])


@inlined
def rates_at(mode, t, y, ground, p, out):
    rates(mode, y, p, *ground_accelerations(ground, t), out)


@inlined
def set_values(y, values):
    """Give numbers other values, and leave their derivatives."""
    for j in range(N_STATES):
        y[j] = values[j] + (y[j] - value(y[j]))


# -- the ground ------------------------------------------------------------------------------------


def first_segments(case):
    still = tuple(moving(0.0, 0.0) for _ in unrolled(range(AXES)))
    return Segments(ground_at(0.0, case), still)


@inlined
def segments_at(t, mode, segments, setup):
    """The segments that hold at t and after it; the state crosses corners at their beginnings."""
    ground, tau = segments.ground, segments.tau
    motions, along = tables(setup.case), tables(setup.varied)
    for axis in unrolled(range(AXES)):
        if t >= ground[axis].row[1]:
            before, end = ground, varied_segment(ground[axis], along[axis]).row[1]
            start, new = end - value(end), segment_at(motions[axis], ground[axis].number, t)
            ground = tuple(new if i == axis else ground[i] for i in unrolled(range(AXES)))
            tau = tuple(start if i == axis else tau[i] for i in unrolled(range(AXES)))
            if setup.varied.corners:
                cross_corner(t, mode, before, ground, start, setup)
    return Segments(ground, tau)


@inlined
def varied_ground(ground, varied):
    """Segments with their derivatives; a table with derivatives that is empty changes nothing."""
    motions = tables(varied)
    return tuple(varied_segment(ground[axis], motions[axis]) for axis in unrolled(range(AXES)))


@inlined
def varied_segment(segment, table):
    """A segment with its derivatives."""
    if segment.number < table.shape[0]:
        return Segment(segment.number, segment_of(table, segment.number))
    return segment


def cross_corner(t, mode, before, after, tau, setup):
    """The state where one segment of the ground ends and another begins, at a time that varies."""
    y, p, scratch = setup.out.y, setup.case.p, setup.scratch
    for j in range(N_STATES):
        scratch.y_later[j] = value(y[j])
    rates_at(mode, t, scratch.y_later, before, p, scratch.rate)
    rates_at(mode, t, scratch.y_later, after, p, scratch.rate_later)
    for j in range(N_STATES):
        y[j] += (scratch.rate[j] - scratch.rate_later[j]) * tau


# -- steps -----------------------------------------------------------------------------------------


@inlined
def cross_step(progress, segments, setup):
    """Behind a recorded step; the states at the times within it are written."""
    recorder, out, y_new = setup.recorder, setup.out, setup.scratch.y_new
    i, query = progress.step, progress.query
    along = varied_ground(segments.ground, setup.varied)
    mode, t, length = recorder.step_modes[i], recorder.steps[i, 0], recorder.steps[i, 1]
    start = recorder.step_states[i, 0]
    set_values(out.y, start)
    still = stands_still(mode, t, start, segments.ground, setup)
    while query < len(out.times) and out.times[query] < t + length:
        advance(mode, t, out.times[query] - t, still, along, setup)
        out.states[query][:N_STATES] = y_new
        query += 1
    advance(mode, t, length, still, along, setup)
    out.y[:N_STATES] = y_new
    return progress._replace(step=i + 1, query=query, length=length)


def stands_still(mode, t, y, ground, setup):
    """Whether nothing can move in a step from a state y, nor its derivatives."""
    for j in range(N_STATES // 2, N_STATES):
        if y[j] != 0.0:
            return False
    rates_at(mode, t, y, ground, setup.case.p, setup.scratch.rate)
    return cannot_move(mode, setup.scratch.rate, y, setup.case.p)


@inlined
def advance(mode, t, h, still, ground, setup):
    """The state a time h after t with its derivatives, into `scratch.y_new`."""
    y, scratch = setup.out.y, setup.scratch
    if still or not h > 0.0:
        scratch.y_new[:N_STATES] = y
    else:
        parts = 1 + int(h / setup.varied.longest)
        take_parts(mode, t, h / parts, parts, y, scratch.y_before, scratch.y_new, ground, setup)


def take_parts(mode, t, part, parts, start, y, y_new, ground, setup):
    """Equal parts of a step from a state, with derivatives, to y_new; y : scratch.

    A state that does not vibrate has no error in a step, however long it is; its derivatives would
    grow there by as much as the step is longer than stability allows. So parts are at most
    `varied.longest`. Arrays that are arguments do not overlap, which the compiler uses.
    """
    p, stages, rtol, atol = setup.varied.p, setup.scratch.stages, setup.case.rtol, setup.case.atol
    y_new[:N_STATES] = start
    for i in range(parts):
        y[:N_STATES] = y_new
        now = t + i * part
        rates_at(mode, now, y, ground, p, stages)
        take_step(mode, now, part, y, p, ground, rtol, atol, stages, y_new)


# -- events ----------------------------------------------------------------------------------------


def cross_events(progress, segments, setup):
    """(code, progress) behind the next event and those that follow at its instant.

    An event moves by tau with the numbers that vary. With the rates f before and after it, the
    state at the fixed time becomes

        y_after = transition(y_before + f_before tau) - f_after tau

    which is called saltation.
    """
    recorder, y, scratch = setup.recorder, setup.out.y, setup.scratch
    i, impacts, step = progress.event, progress.impacts, progress.step
    event, y_recorded = event_at(i, recorder), recorder.event_states[i, 0]
    t, ground, p = event.time, segments.ground, setup.case.p
    along = varied_ground(ground, setup.varied)
    set_values(y, y_recorded)
    rates_at(event.mode_before, t, y_recorded, ground, p, scratch.rate)
    code, tau = event_time_sensitivity(progress, segments, setup)
    if code != 0:
        return code, progress
    for j in range(N_STATES):
        scratch.y_before[j] = y[j] + scratch.rate[j] * tau
    while True:
        event = event_at(i, recorder)
        if event.guard == STEPPED_OVER:
            return GRAZES, progress
        if event.kind == REST:  # as long after the last impact, at t, as those to come take
            duration, mode = rest_after_impacts(event, t + tau, impacts, along, setup)
            tau += duration - value(duration)
            t = event.time
        else:
            mode = mode_after_event(event, t + tau, progress.length, impacts, along, setup)
        if mode != event.mode_after:
            return OTHER_WAY, progress
        write_event(i, t + tau, setup)
        impacts += int(is_impact(event))
        i += 1
        if not follows_at_once(i, t, recorder):
            break
    rates_at(mode, t, recorder.event_states[i - 1, 1], ground, p, scratch.rate)
    for j in range(N_STATES):
        y[j] = scratch.y_before[j] - scratch.rate[j] * tau
    if event.kind == REST and step < len(recorder.steps) and t > recorder.steps[step, 0]:
        step += 1  # it was recorded for the time of the rest
    return 0, progress._replace(event=i, impacts=impacts, step=step, length=0.0)


def follows_at_once(i, t, recorder):
    """Whether event i belongs to those at t; a rest belongs to its last impact."""
    more = i < len(recorder.events)
    return more and (recorder.events[i] == t or recorder.event_kinds[i, 0] == REST)


def write_event(i, t, setup):
    """Write both sides of an event; that after it is that before the next one at its instant."""
    out, before, after = setup.out, setup.scratch.y_before, setup.scratch.y_after
    set_values(after, setup.recorder.event_states[i, 1])
    out.event_times[i] = t
    out.event_states[i, 0][:N_STATES] = before
    out.event_states[i, 1][:N_STATES] = after
    before[:N_STATES] = after


def event_time_sensitivity(progress, segments, setup):
    """(code, tau): the derivatives of the time of the next event.

    It is a segment of the ground that begins, the start of the motion, or a guard that falls. The
    rates before it are in `scratch.rate`.
    """
    event, y = event_at(progress.event, setup.recorder), setup.out.y
    t, ground, g = event.time, segments.ground, setup.scratch.guards
    fixed = moving(0.0, 0.0)
    if event.guard == STEPPED_OVER:
        return GRAZES, fixed
    for axis in unrolled(range(AXES)):
        if not is_impact(event) and t == ground[axis].row[0]:
            return 0, segments.tau[axis]
    if t == 0.0:
        return 0, fixed
    y_recorded = setup.recorder.event_states[progress.event, 0]
    slope = guard_rate(event, t, y_recorded, setup.scratch.rate, ground, setup)
    if not falls_clearly(slope, event, y_recorded, progress.length, ground, setup):
        # its time is not known; where nothing changes there, none is asked for
        return (0 if nothing_changes(progress.event, ground, setup) else GRAZES), fixed
    shaking = ground_accelerations(varied_ground(ground, setup.varied), t)
    guards(event.mode_before, y, setup.varied.p, *shaking, g)
    return 0, (value(g[event.guard]) - g[event.guard]) / slope


def falls_clearly(slope, event, y, length, ground, setup):
    """Whether a guard falls so fast through zero that its time is known, see `DIGITS`.

    With the slope s at zero, and a bend b that slows its fall, it would sink by s**2 / (2 b) below
    zero: by many times as much as the tolerance of the state changes it.
    """
    case, t, scratch = setup.case, event.time, setup.scratch
    later, rate_later = scratch.y_later, scratch.rate_later
    ahead = BEND_OF_GUARD * length
    for j in range(N_STATES):
        later[j] = y[j] + ahead * scratch.rate[j]
    rates_at(event.mode_before, t + ahead, later, ground, case.p, rate_later)
    slope_later = guard_rate(event, t + ahead, later, rate_later, ground, setup)
    for j in range(N_STATES):
        later[j] = case.atol[j] + case.rtol * abs(y[j])
    shaking = ground_accelerations(ground, t)
    error = abs(guard_derivative(event, y, later, shaking, setup))
    # where it falls faster and faster it comes from where it was open: a short hop is no graze
    bend = max(slope_later - slope, 0.0) / ahead if ahead > 0.0 else 0.0
    return slope < 0.0 and not slope * slope <= DIGITS * error * bend


def guard_rate(event, t, y, dy, ground, setup):
    """How fast the guard of an event changes along the motion."""
    shaking = ground_accelerations(ground, moving(t, 1.0))
    return guard_derivative(event, y, dy, shaking, setup)


def guard_derivative(event, y, dy, shaking, setup):
    """How fast the guard of an event changes where the state does so by dy."""
    state, g = setup.scratch.y_moving, setup.scratch.guards
    for j in range(N_STATES):
        state[j] = moving(y[j], dy[j])
    guards(event.mode_before, state, setup.case.p, *shaking, g)
    return rate(g[event.guard])


def nothing_changes(i, ground, setup):
    """Whether neither the state nor its rates change at event i."""
    event, before = event_at(i, setup.recorder), setup.recorder.event_states[i, 0]
    after, scratch = setup.recorder.event_states[i, 1], setup.scratch
    rates_at(event.mode_after, event.time, after, ground, setup.case.p, scratch.rate_later)
    same = True
    for j in range(N_STATES):
        rate_before, rate_after = scratch.rate[j], scratch.rate_later[j]
        size = abs(rate_before) + abs(rate_after)
        same = same and after[j] == before[j] and abs(rate_after - rate_before) <= SAME_RATES * size
    return same


@inlined
def mode_after_event(event, now, length, impacts, ground, setup):
    """The mode after an event, as in the loop; the state from `scratch.y_before` to `y_after`.

    now : the time of the event, with its derivatives.
    """
    mode, guard, case, p = event.mode_before, event.guard, setup.case, setup.varied.p
    y, out = setup.scratch.y_before, setup.scratch.y_after
    if N_POINTS == 0:
        ratio = velocity_ratio_at(case.law, setup.varied.ratio[0], impacts, y[ROTATION_RATE], p)
        return jump(mode, guard, case.law, ratio, y, p, out)
    else:
        ahead = SOON_IN_STEP * length
        shaking = ground_accelerations(ground, now)
        later = ground_accelerations(ground, value(now) + ahead)
        accelerations = np.empty(GROUND_SIZE)
        ground_now_and_later(shaking, later, ahead, accelerations)
        points = setup.scratch.points
        follows, _ = pass_on(mode, guard, length, y, p, accelerations, case.rtol, points, out)
        return follows


@inlined
def rest_after_impacts(event, now, impacts, ground, setup):
    """(time, mode) of infinitely many impacts, as in the loop; the state goes to `scratch.y_after`.

    scratch.y_before : the state at the last recorded impact, on return that before they have ended.
    now : the time of that impact, with its derivatives.
    """
    case, varied, scratch = setup.case, setup.varied, setup.scratch
    mode, tolerance, p = event.mode_before, case.rest_tolerance, varied.p
    y, out, stands = scratch.y_before, scratch.y_after, scratch.y_new
    shaking = ground_accelerations(ground, now)
    if N_POINTS > 0:
        state = State(mode, y, p, shaking)
        return time_of_bounces(state, tolerance, case.rtol, scratch.points, out)
    else:
        rests, follows = time_to_rest(
            mode, y, p, case.law, varied.ratio[0], impacts, shaking, tolerance, stands
        )
        stand(follows, now, rests, stands, p, ground, case.rtol, case.atol, scratch.stages, out)
        for j in range(N_STATES):
            y[j] += out[j] - stands[j]  # there, had the impacts not faded yet
        return rests, follows
