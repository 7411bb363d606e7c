"""The states of events, given back: what a motion passed through can be asked, and goes on."""

import math

import numpy as np
import pytest

import rockeom as rk
from tests.refusals import refused

from . import declared

END = 1.5
STILL = rk.GroundMotion.none(END)


def _block(r: np.random.Generator):
    block = rk.SlidingBlock(
        half_width=0.3,
        half_height=1.0,
        friction=float(r.choice([0.15, 0.3, 0.8])),
        restitution=float(r.choice([0.0, 0.3])),
    )
    return block, {"theta": r.uniform(-0.28, 0.28), "x_dot": r.uniform(-1.0, 1.0)}


def _stack(r: np.random.Generator):
    lower = rk.RigidBlock(half_width=0.5, half_height=0.5, mass=1000.0)
    upper = rk.RigidBlock(half_width=0.3, half_height=0.6, mass=500.0)
    stack = rk.StackedBlocks(lower=lower, upper=upper)
    return stack, {"phi": r.uniform(-0.25, 0.25), "theta": float(r.choice([0.0, 0.1, -0.05]))}


def _declared(r: np.random.Generator):
    values = {"mass": 3.0, "height": 1.0, "inertia": 1.2, "gravity": 9.81, "leg": 0.2}
    values |= {"left_width": 0.4, "right_width": 0.3, "restitution": 0.0}
    model = declared.unequal_feet()
    return rk.structure(model, friction=r.uniform(0.2, 0.6), **values), {
        "theta": -0.28 + float(r.choice([-1, 1])) * r.uniform(0.03, 0.1),
        "theta_dot": r.uniform(-0.1, 0.1),
    }


KINDS = {"block": _block, "stack": _stack, "declared feet": _declared}


def _passed(kind: str, seed: int):
    """(structure, its motion, the first events of it and the last)."""
    structure, initial = KINDS[kind](np.random.default_rng(seed))
    run = rk.simulate(structure, STILL, initial=initial)
    events = list(run.events)
    return structure, run, events[:8] + events[8:][-2:]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(5))
def test_a_state_of_an_event_is_accepted(kind, seed):
    """Its gaps and rates are none but for rounding, however small its coordinates are."""
    structure, _, events = _passed(kind, seed)
    assert events or kind == "declared feet"  # which may fall over at once
    for event in events:
        for state in (event.before, event.after):
            structure.positions(state)
            assert math.isfinite(sum(structure.energies(state).values()))
        if kind != "stack":
            structure.accelerations(event.after)
            structure.reactions(event.after)
        rk.simulate(structure, rk.GroundMotion.none(1e-3), initial=event.after)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(5))
def test_a_motion_goes_on_from_a_state_of_an_event(kind, seed):
    structure, run, events = _passed(kind, seed)
    for event in events[:4]:
        left = min(END, run.t[-1]) - event.time
        later = rk.simulate(structure, rk.GroundMotion.none(left), initial=event.after)
        at = 0.5 * min(left, later.t[-1])
        for name in run.states:
            expected = np.interp(event.time + at, run.t, run[name])
            found = np.interp(at, later.t, later[name])
            assert found == pytest.approx(expected, abs=2e-4)


@pytest.mark.parametrize("small", [1e-12, 1e-9, 1e-6])
def test_a_gap_is_refused_by_the_size_of_the_structure(small):
    """1e-7 m below the ground is the error of a coarse motion of a block of 1 m, 1e-5 m is not."""
    block = rk.SlidingBlock(half_width=0.3, half_height=1.0, friction=0.5, restitution=0.0)
    block.positions({"y": -1e-7, "x": small})
    assert refused(block.positions, {"y": -1e-5, "x": small}) == ("left", -1e-05)
