"""Two blocks on one another that do not slip: their impacts, by hand and by the reference."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st

import rockeom as rk
from tests.mechanics import OPEN, STICK

from .reference import UndecidedError, followers, held, landings, one
from .two_blocks import Stack, lower_begins_to_rock

STILL = rk.GroundMotion.none(1.0)
STACK = Stack(0.5, 0.4, 0.45, 0.6, 2.0, 1.5)


def structure(stack: Stack) -> rk.Structure:
    return rk.StackedBlocks(
        lower=rk.RigidBlock(half_width=stack.b1, half_height=stack.h1, mass=stack.m1),
        upper=rk.RigidBlock(half_width=stack.b2, half_height=stack.h2, mass=stack.m2),
    )


SHAKEN = rk.GroundMotion.from_library("El Centro 1940 180").scaled(acceleration=2.0)
TALL = {
    "lower_half_width": 0.5, "lower_half_height": 1.2, "upper_half_width": 0.4,
    "upper_half_height": 1.0, "lower_mass": 6e3, "upper_mass": 4e3,
}  # fmt: skip


def test_a_stack_has_the_law_that_answers_and_friction_where_it_slides():
    assert rk.StackedBlocks(**TALL).describe_impact(None) == ""
    assert rk.StackedBlocks(**TALL, restitution=0.5).describe_impact(None) == "poisson"
    model = rk.derive("stacked_blocks", support="sliding", law="lzb")
    assert {(str(c.law.friction), c.law.law) for c in model.contacts} == {("mu", "lzb")}
    with pytest.raises(TypeError, match=r"unknown friction \(did you mean support = rk\.Sliding"):
        rk.StackedBlocks(**TALL, friction=0.5)
    with pytest.raises(ValueError, match="restitution is given with a support"):
        rk.StackedBlocks(**TALL, restitution=0.1, support=rk.Sliding(friction=0.5, restitution=0.1))


def test_a_bouncing_stack_that_never_slips_answers_under_a_record():
    """By Newton's law a corner that lands at 1e-5 m/s, and slips faster, has no impulse."""
    stack = rk.StackedBlocks(**TALL, restitution=0.5)
    by_newton = rk.structure(rk.derive("stacked_blocks"), **stack.parameters())
    newton, default = (rk.simulate(of, SHAKEN, duration=2.5) for of in (by_newton, stack))
    assert newton.outcome is rk.Outcome.NO_SOLUTION
    assert "An assumption fails: its contacts never slip" in newton.summary()
    assert default.outcome is rk.Outcome.COMPLETED
    assert not len(default.impacts.energy_gains)
    assert default.energy_balance().error < 1e-6


@cache
def released(**initial: float) -> rk.Response:
    return rk.simulate(structure(STACK), STILL, initial=initial, duration=0.6)


@settings(max_examples=15)
@given(
    b1=st.floats(0.2, 2.0), narrow=st.floats(0.1, 1.0), h1=st.floats(0.2, 2.0),
    slender=st.floats(0.8, 5.0), m1=st.floats(0.2, 5.0), m2=st.floats(0.2, 5.0),
)  # fmt: skip
def test_an_upper_block_that_lands_sets_the_lower_one_rocking_as_by_hand(
    b1, narrow, h1, slender, m1, m2
):
    """The lower block stands at rest until then; a foot of the upper one lands."""
    b2 = narrow * b1
    lower, stack, higher = (
        Stack(b1, h * h1, b2, slender * b2, m1, m2) for h in (1 - 1e-6, 1, 1 + 1e-6)
    )
    rocks = lower_begins_to_rock(lower)
    assume(lower_begins_to_rock(higher) == rocks)  # else it hardly moves, by which rounding decides
    start = {"theta": 0.0, "theta_dot": 0.0, "phi": 1e-4, "phi_dot": -0.5}
    run = rk.simulate(structure(stack), STILL, initial=start, duration=0.001)
    first = run.events[0]
    assume(first.kind == "landing")  # else the lower block already rocks by the upper one's weight
    assert first.contact == "upper_left"
    assert first.before["theta"] == first.before["theta_dot"] == 0.0
    assert (abs(first.after["theta_dot"]) > 1e-9 * abs(first.after["phi_dot"])) == rocks
    if not rocks:
        s = b2 / math.hypot(b2, stack.h2)
        ratio = first.after["phi_dot"] / first.before["phi_dot"]
        assert ratio == pytest.approx(1 - 1.5 * s * s, rel=1e-9)


def test_friction_between_the_blocks_is_told_beside_that_on_the_ground():
    """An upper block that lands on a lower one at rest needs 3 s c/(4 - 3 s^2) there, too."""
    squat = Stack(0.3, 0.4, 0.15, 0.6, 1.0, 1.0)
    run = rk.simulate(structure(squat), STILL, initial={"theta": 0.0, "phi": 0.1}, duration=1.0)
    assert {e.contact for e in run.impacts} == {"upper_left", "upper_right"}
    s, c = (x / math.hypot(0.15, 0.6) for x in (0.15, 0.6))
    ground, between = (
        run.support.friction_demands["left+right"],
        run.support.friction_demands["upper_left+upper_right"],
    )
    assert between[1] == pytest.approx(3 * s * c / (4 - 3 * s * s), rel=1e-9)
    assert ground == pytest.approx(
        (run.support.friction_demand, run.support.impact_friction_demand), rel=1e-9
    )
    alone = rk.RigidBlock(half_width=0.15, half_height=0.6)
    free = rk.simulate(alone, STILL, initial={"theta": 0.1}, duration=1.0)
    assert between[0] == pytest.approx(free.support.friction_demand, rel=1e-6)
    assert f"{max(between):.3g} at upper_left+upper_right" in run.summary()


@pytest.mark.parametrize("tilt", [0.1, 0.0999999999, 0.09, 0.07, 0.05, 0.04, 0.03])
def test_friction_at_a_landing_does_not_depend_on_the_rounding_of_its_place(tilt):
    """All coordinates are some 1e-15 there, and so is each gap: which is closed?"""
    squat = Stack(0.3, 0.4, 0.15, 0.6, 1.0, 1.0)
    run = rk.simulate(structure(squat), STILL, initial={"phi": tilt}, duration=1.5)
    demands = run.support.friction_demands["upper_left+upper_right"]
    assert demands[1] == pytest.approx(3 * 0.25 / 1.0625 / (4 - 3 * 0.0625 / 1.0625), rel=1e-9)


def test_rotations_that_are_not_named_are_zero():
    """Heights and places follow from which corners touch; a rotation does not."""
    start = structure(STACK).state({"phi": 0.02, "phi_dot": -0.5})
    names = structure(STACK).states
    named = dict(zip(names, start, strict=True))
    assert named["theta"] == named["theta_dot"] == 0.0
    assert named["phi"] == 0.02


@pytest.mark.parametrize(
    "initial",
    [
        {"theta": 0.0, "phi": 0.1},
        {"theta": 0.05, "phi": 0.0},
        {"theta": 0.05, "phi": 0.05},
        {"theta": 0.05, "phi": -0.05},
    ],
)
def test_every_impact_is_that_of_the_reference(initial):
    run = released(**initial)
    checked = 0
    for event in [e for e in run.events if e.kind == "landing"][:12]:
        before, after = (STACK.mechanics.in_state(s) for s in (event.before, event.after))
        try:
            found = one(landings(before))
        except UndecidedError:
            continue
        checked += 1
        np.testing.assert_allclose(after.states.v[0], found.motion, atol=1e-9)
        assert after.kinetic()[0] <= before.kinetic()[0] * (1 + 1e-12)
    assert checked or not any(e.kind == "landing" for e in run.events)


def test_the_bounces_of_the_lower_block_end_under_the_rocking_upper_one():
    """One mode follows at the end of infinitely many landings of the lower block."""
    run = released(theta=0.0, phi=0.1)
    assert run.outcome is rk.Outcome.CAME_TO_REST
    assert len(run.events) < 400


def test_a_state_of_both_on_one_foot_accelerates_as_the_reference():
    state = {"theta": 0.1, "phi": -0.05, "theta_dot": 0.2, "phi_dot": 0.4}
    run = rk.simulate(structure(STACK), STILL, initial=state, duration=1e-6)
    assert set(run.mode) == {"right_upper_left"}
    at = STACK.mechanics.in_state({name: float(run[name][0]) for name in run.states})
    found = one(followers(at))
    assert found.pattern == (OPEN, STICK, STICK, OPEN)
    turns = structure(STACK).accelerations(state, mode="right_upper_left")
    assert turns["theta"] == pytest.approx(found.motion[2], rel=1e-10)
    assert turns["phi"] == pytest.approx(found.motion[5], rel=1e-10)


@pytest.mark.parametrize("push", [0.0, 0.31, -0.31, 0.32, -0.32])
def test_a_standing_stack_begins_to_rock_as_one_body_beyond_its_own_slenderness(push):
    """Ground acceleration in g; both blocks turn as one from 0.5/1.6 on, the upper one from 0.5."""
    stack = Stack(0.5, 1.0, 0.3, 0.6, 1000.0, 600.0)
    starts = structure(stack).accelerations({}, 9.81 * push)
    if abs(push) < 0.5 / 1.6:
        assert starts == dict.fromkeys(starts, 0.0)
        return
    # about the foot: I of both blocks, and the moment of their weight and of the push
    lower = 1000.0 * 4 / 3 * (0.5**2 + 1.0**2)
    upper = 600.0 * ((0.3**2 + 0.6**2) / 3 + 0.5**2 + 2.6**2)
    moment = (1000.0 * 1.0 + 600.0 * 2.6) * abs(push) - 1600.0 * 0.5
    turning = math.copysign(9.81 * moment / (lower + upper), -push)
    assert starts["theta"] == pytest.approx(turning, rel=1e-12)
    assert starts["phi"] == pytest.approx(turning, rel=1e-12)


def test_where_not_to_slip_needs_a_normal_force_that_pulls_there_is_no_motion():
    """A foot that never slips is held by friction until its normal force is zero.

    Here it needs friction still, at a normal force that falls through zero; opened, it would sink
    into the lower block: its gap would close with 0.67 m/s2.
    """
    run = released(theta=0.05, phi=-0.05)
    at = STACK.mechanics.in_state(run.final)
    closed = held(at, (OPEN, STICK, STICK, OPEN))
    assert closed.normal[2] == pytest.approx(0.0, abs=1e-6)
    assert abs(closed.friction[2]) > 1.0
    opened = held(at, (OPEN, STICK, OPEN, OPEN))
    assert (at.rows[0, 2] @ opened.motion + at.biases[0, 2])[1] < -0.5
    assert str(run.outcome) == "no solution"
