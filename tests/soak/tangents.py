"""Derivatives of a motion of the soak, along a direction in which all its numbers change."""

import dataclasses
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

import rockeom as rk
from tests.differences import (
    TIGHT,
    Observed,
    OtherEventsError,
    differenced,
    size_of,
)
from tests.soak.cases import Dice, Motion

OPTIONS = dataclasses.replace(TIGHT, max_steps=20_000, max_impacts=400)
TOLERANCE, REFERENCE = 1e-6, 1e-7
"""A derivative may be wrong by so much of its size, and that with which it is compared."""
FELT = 1e-8
"""Below it a motion has come to nothing, and its events are those of rounding errors."""
SHARE = 0.97
"""Of the motion that is looked at: at its end a law of the ground may end."""


def moved(motion: Motion, s: Any) -> rk.Case:
    """All that is not zero times 1 + s w, each with a w of its own; a ratio becomes less."""
    dice = Dice(motion.seed, 0, 3)

    def times(value: Any) -> Any:
        w = dice.between(-1.0, 1.0)
        number = isinstance(value, float) and value != 0.0 and math.isfinite(value)
        return value * (1.0 + s * w) if number else value

    def shaking(of: rk.GroundMotion) -> rk.GroundMotion:
        return of.scaled(times(1.0), times(1.0))

    structure, law = motion.structure, motion.impact
    sizes = {f.name: times(getattr(structure, f.name)) for f in dataclasses.fields(structure)}
    if isinstance(law, rk.VelocityRatio):
        law = rk.VelocityRatio(law.e * (1.0 - 0.5 * s))
    return rk.Case(
        dataclasses.replace(structure, **sizes), shaking(motion.motion), law,
        {name: times(float(value)) for name, value in motion.initial.items()},
        SHARE * motion.motion.duration, motion.vertical and shaking(motion.vertical), motion.mode,
    )  # fmt: skip


def wrong_tangents(motion: Motion) -> Iterator[str]:
    """Derivatives against differences, where these can be had."""
    try:
        found = rk.tangents(moved(motion, rk.Dual(0.0, [1.0])), OPTIONS)
    except ValueError as refused:
        if "derivative" in str(refused):  # it says so
            return
        raise
    run = found.response
    if found.grazing or run.outcome not in (rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST):
        return
    marks = np.array([0.0, *(e.time for e in run.events), run.duration])
    times = (0.5 * (marks[1:] + marks[:-1]))[np.diff(marks) > 0.02 * run.duration]
    try:
        reference = differenced(lambda s: moved(motion, s), {"s": 0.0}, {"s": 1.0}, times, OPTIONS)
    except (OtherEventsError, ValueError):  # there is none beside it
        return
    if reference.error > REFERENCE:  # too near to other events
        return
    felt = np.array([max(map(abs, e.before.values())) > FELT for e in run.events], dtype=bool)
    parts = found.event_times, found.before, found.after, found.end, found.at(times)
    for name, part, other in zip(Observed._fields, parts, reference.derivative, strict=True):
        of = felt if name in ("event_times", "before", "after") else slice(None)
        error = np.abs(part[..., 0] - other)[of].max(initial=0.0) / size_of(other)
        if not error <= TOLERANCE:
            yield f"tangents: {name} wrong by {error:.1e} of its size"
