"""What the loop carries from stage to stage, in records with named fields.

This text is joined to others, see `rockeom.integrator.program`.
"""

from __future__ import annotations

from typing import NamedTuple

from rockeom.compiler.decorators import Floats, Floats2, Floats3, Ints, Ints2, inlined

Row = tuple[float, float, float, float, float, float, float]
"""A segment of the ground: start, end, kind, and its constants, see `rockeom.motion.segments`."""


class Ground(NamedTuple):
    """The segments of the ground motion that hold now, and their rows in the tables."""

    n_x: int
    x: Row
    n_y: int
    y: Row


class Case(NamedTuple):
    """What stays the same in a motion, see `integrate`.

    coarse : the largest error of an equal step, in units of the tolerance.
    """

    t_end: float
    horizontal: Floats2
    vertical: Floats2
    p: Floats
    law: int
    ratio: float
    rtol: float
    atol: Floats
    h_max: float
    fixed: int
    coarse: float
    fallen: float
    rest_tolerance: float
    max_impacts: int
    max_steps: int


class Arrays(NamedTuple):
    """The state y (N,), and arrays to work in, which the stages leave to one another.

    k : rates at the stages of a step, from the start on; those at its end begin at END. y_new : the
    state at the end of a step. coefficients : its dense output. b : the polynomials of guards, and
    g values of them. noises : their rounding errors, see `noise_of`. after : the state after an
    event. known : of points, see `all_known`. w, stack : scratch.
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
    known: Floats


class Recorder(NamedTuple):
    """Where steps, events and extremes are written, see `integrate`; no rows where they are not."""

    steps: Floats2
    step_modes: Ints
    step_states: Floats3
    events: Floats
    event_kinds: Ints2
    event_states: Floats3
    extremes: Floats2


class Motion(NamedTuple):
    """Where a motion is between two steps.

    touching : the guards that are known to be closed. rate_stale : the rates at the start of the
    next step are not known yet. guard_due : a guard may be below zero. sampled : the guards at the
    end of the step before are known. still : nothing moved in it. idle : events at this instant.
    follows : the mode after the impacts that a landing begins, negative where there is none.
    """

    t: float
    mode: int
    touching: int
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
    landing ends it. slope : of the guard. more : what the end was moved by. overturns : something
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
