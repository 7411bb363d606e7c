"""Records, with named fields, that the loop carries from stage to stage."""

from typing import NamedTuple

from rockeom.compiler.decorators import Floats, Floats2, Floats3, Ints, Ints2, inlined

Row = tuple[float, float, float, float, float, float, float]
"""A segment of the ground: start, end, kind, and its constants, see `rockeom.motion.segments`."""


class Segment(NamedTuple):
    """The segment of a ground motion that holds now: its number in the table, and its row."""

    number: int
    row: Row


Ground = tuple[Segment, ...]
"""The segments of all motions, in the order of `rockeom.integrator.ground.tables`."""


class Motions(NamedTuple):
    """The tables of the ground's motions, see `Case`."""

    horizontal: Floats2
    transverse: Floats2
    vertical: Floats2


class Case(NamedTuple):
    """Data that stay the same in a motion.

    t_end : the end of the motion. horizontal, transverse, vertical (m, 7) : the ground motion, each
    row start, end, kind and constants of a segment; no step straddles an end, and behind the last
    one the ground is at rest; in the plane the transverse one is empty. p : parameters of the
    structure, and the table of an impact law behind them. law, ratio : of impacts. rtol, atol (N,)
    : tolerances of a step. h_max : the longest step. fixed : 0 to control the error, or the number
    of equal steps in each segment. An equal step whose estimated error is above COARSE is refused,
    and the rest of its segment is integrated with control of the error. fallen : the overturning
    angle. rest_tolerance : see `zeno_time`.
    """

    t_end: float
    horizontal: Floats2
    transverse: Floats2
    vertical: Floats2
    p: Floats
    law: int
    ratio: float
    rtol: float
    atol: Floats
    h_max: float
    fixed: int
    fallen: float
    rest_tolerance: float
    max_impacts: int
    max_steps: int


class Batch(NamedTuple):
    """n motions of one structure, and what is the same in all of them, see `Case`.

    status (n, 10), clock (n, 4), states and rates (n, N) : as of `integrate`, at the start, and on
    return at the end. Motion i has the segments from h_rows[i, 0] to h_rows[i, 1] of `horizontal`,
    and those of t_rows[i] of `transverse` and v_rows[i] of `vertical`. t_end, quiet_from, law,
    ratio, fallen (n,), p (n, m). outcome (n,) : FULL, or that of a motion that has ended. extremes
    (n, 2, N). impact_times (n, k) : of the first k impacts. gains (n, 2) : see `add_gain`.
    """

    status: Ints2
    clock: Floats2
    states: Floats2
    rates: Floats2
    t_end: Floats
    quiet_from: Floats
    horizontal: Floats2
    h_rows: Ints2
    transverse: Floats2
    t_rows: Ints2
    vertical: Floats2
    v_rows: Ints2
    p: Floats2
    law: Ints
    ratio: Floats
    rtol: float
    atol: Floats
    h_max: float
    fixed: int
    fallen: Floats
    rest_tolerance: float
    max_impacts: int
    max_steps: int
    outcome: Ints
    extremes: Floats3
    impact_times: Floats2
    gains: Floats2


class Arrays(NamedTuple):
    """The state y (N,), and arrays to work in, which the stages leave to one another.

    k : rates at the stages of a step, from the start on; those at its end begin at END. y_new : the
    state at the end of a step. coefficients : its dense output. b : the polynomials of guards, and
    g values of them. noises : their rounding errors, see `noise_of`. after : the state after an
    event. contact : of points, see `contact_data`. w, stack : scratch.
    """

    y: Floats
    k: Floats
    w: Floats
    y_new: Floats
    after: Floats
    coefficients: Floats
    g: Floats
    b: Floats
    stack: Floats
    noises: Floats
    contact: Floats


class Recorder(NamedTuple):
    """Where steps, events and extremes are written; no rows where they are not.

    steps (n, 2) : start and length, with the modes (n,) and the dense output (n, 8, N) of each.
    events (m,) : times, with event_kinds (m, 4), which are kind, mode before and after, and the
    guard that fell, and event_states (m, 2, N) before and after. extremes (2, N) of the state.
    """

    steps: Floats2
    step_modes: Ints
    step_states: Floats3
    events: Floats
    event_kinds: Ints2
    event_states: Floats3
    extremes: Floats2


class Motion(NamedTuple):
    """Where a motion is between two steps.

    closed : the guards that are known to be closed. rate_stale : the rates at the start of the
    next step are not known yet. guard_due : a guard may be below zero. sampled : the guards at the
    end of the step before are known. still : nothing moved in it. idle : events at this instant.
    follows : the mode after the impacts that a landing begins, negative where there is none.
    """

    t: float
    mode: int
    closed: int
    h_next: float
    last_error: float
    refined_to: float
    rate_stale: bool
    guard_due: bool
    sampled: bool
    still: bool
    taken: int
    refined: int
    impacts: int
    idle: int
    n_steps: int
    n_events: int
    follows: int
    outcome: int


class Step(NamedTuple):
    """A step that is tried, until it ends where nothing happened within, or at an event.

    end : of the segments of the ground. longest : its length as planned. whole : that without a
    hop. bound : of its error. cut : it ends where a segment does. equal : its length is not
    controlled by its error. hops, hop : it is one flight of a point, to this guard. target : the
    guard on which it should end, and landed on which it does, or -1. lands : nothing but that
    landing ends it. slope : of the guard. more : what the end was moved by. value, moved : of
    the guard before the last correction of the length, and this. overturns : something
    may reach its bound. turns : an extreme may lie within.
    """

    h: float
    end: float
    longest: float
    whole: float
    bound: float
    error: float
    cut: bool
    equal: bool
    still: bool
    stands: bool
    hops: bool
    hop: int
    target: int
    landed: int
    lands: bool
    slope: float
    more: float
    corrections: int
    value: float
    moved: float
    overlooked: int
    sampled: bool
    overturns: bool
    turns: bool
    h_next: float
    last_error: float
    refined_to: float
    refined: int
    taken: int
    outcome: int


class Fall(NamedTuple):
    """The first fall of a guard through zero in a step.

    place : in the step, NEVER if no guard falls. slope : of its polynomial in time. from_closed :
    it was closed at the start. unclear : nothing but rounding errors says that it falls.
    """

    place: float
    guard: int
    slope: float
    from_closed: bool
    unclear: bool


class State(NamedTuple):
    """A state y (N,) in a mode, the parameters p, and the accelerations of the ground there."""

    mode: int
    y: Floats
    p: Floats
    shaking: tuple[float, ...]


class Rest(NamedTuple):
    """The end of infinitely many impacts: after which time, in which mode; or a step over them."""

    time: float
    mode: int
    stepped: bool


@inlined
def records_steps(recorder):
    return recorder.steps.shape[0] > 0


@inlined
def records_extremes(recorder):
    return recorder.extremes.shape[0] > 0
