"""The reference by itself, before anything is compared with it: energies and closed forms."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings, strategies as st

from tests.mechanics import OPEN, SLIP_LEFT, SLIP_RIGHT, STICK

from . import closed_forms as exact
from .cases import leaning, leaning_motion
from .reference import Block, UndecidedError, followers, held, landings, one, state_of, touching
from .two_blocks import Stack, lower_begins_to_rock, momentum

sizes = st.floats(0.1, 3.0)


@settings(max_examples=60)
@given(b=sizes, h=sizes, mu=st.floats(0.02, 1.2), a=st.floats(0.0, 40.0), up=st.floats(-5.0, 5.0))
def test_a_block_at_rest_starts_as_by_hand(b, h, mu, a, up):
    g = 9.81 + up
    assume(abs(a - mu * g) > 1e-6 and abs(a - b / h * g) > 1e-6)
    assume(abs(mu - exact.critical_friction(a, g, b, h)) > 1e-6 and abs(mu - b / h) > 1e-6)
    block = Block(b, h, mu)
    for side in (1.0, -1.0):
        found = one(followers(block.at(), (side * a, up)))
        by_hand = exact.start(a, g, b, h, mu)
        expected = np.array([side * by_hand.x, by_hand.y, side * by_hand.theta])
        scale = max(1.0, np.abs(expected).max())
        np.testing.assert_allclose(found.motion, expected, atol=1e-10 * scale)
        forces = found.normal.sum(), side * found.friction.sum()
        np.testing.assert_allclose(forces, [by_hand.normal, by_hand.friction], rtol=1e-9, atol=1e-9)


def test_friction_at_which_a_block_rocks_without_sliding_rises_to_painleve():
    b, h = 0.3, 1.1
    rising = [exact.critical_friction(a, 9.81, b, h) for a in (2.7, 5.0, 20.0, 1e3, 1e9)]
    assert rising == sorted(rising)
    np.testing.assert_allclose(rising[0], b / h, rtol=0.02)
    np.testing.assert_allclose(rising[-1], exact.painleve_friction(b, h), rtol=1e-7)


def test_a_leaning_block_of_little_friction_slides_and_rocks_to_rest():
    """Two time-stepping programs give impacts at 1.07026 and 2.2918 to 2.2949 s, the slip at rest
    between -0.0459 and -0.0471 m."""
    motion = leaning_motion()
    np.testing.assert_allclose(motion.times("landing")[:2], [1.0702656, 2.2916414], atol=5e-8)
    begins, ends = motion.times("slip begins"), motion.times("slip ends")
    np.testing.assert_allclose(begins[:2], [0.9681553, 2.1685834], atol=5e-8)
    np.testing.assert_allclose(ends[:2], [1.3452220, 2.6924774], atol=5e-8)
    upright = leaning().b * (math.cos(0.2) - 1.0)
    assert motion.time == pytest.approx(4.0118, abs=1e-4)
    assert motion.end[0] - upright == pytest.approx(-0.04592, abs=5e-6)


def test_the_second_landing_sticks_in_its_impulse_and_slips_at_once():
    motion = leaning_motion()
    event = next(e for e in motion.events if e.kind == "landing" and e.time > 2.0)
    found = one(landings(state_of(motion.of, event.before)))
    assert found.pattern == (OPEN, STICK)
    assert event.pattern_before == (SLIP_LEFT, OPEN)
    assert event.pattern_after == (OPEN, SLIP_RIGHT)


def test_energy_is_lost_to_friction_and_impacts_alone():
    motion = leaning_motion()

    def energy(y):
        at = state_of(motion.of, y)
        return at.kinetic()[0] + at.potential[0]

    nodes, weights = np.polynomial.legendre.leggauss(60)
    for pattern, span in motion.spans[:8]:
        start, end = span.t[0], span.t[-1]
        times = start + 0.5 * (end - start) * (nodes + 1)
        work = 0.0
        for t, weight in zip(times, weights, strict=True):
            at = state_of(motion.of, span.sol(t))
            slips = at.rates[0, :, 0]
            work += 0.5 * (end - start) * weight * float(held(at, pattern).friction @ slips)
        assert work <= 1e-12
        assert energy(span.y[:, -1]) - energy(span.y[:, 0]) == pytest.approx(work, abs=1e-10)


@pytest.mark.parametrize("alpha", [0.15, 0.25, 0.4])
@pytest.mark.parametrize("e", [0.0, 0.3])
@pytest.mark.parametrize("more", [0.5, 0.999, 1.001, 3.0])
def test_a_corner_lands_as_by_hand(alpha, e, more):
    mu = more * exact.sticking_friction(alpha)
    block = Block(math.sin(alpha), math.cos(alpha), mu, e)
    found = one(landings(block.at(theta_dot=-0.7, y_dot=-0.7 * block.b)))
    assert found.motion[2] / -0.7 == pytest.approx(exact.landing_ratio(alpha, mu, e), rel=1e-12)
    assert (found.pattern[0] == STICK) == (more > 1)
    assert found.pattern[1] == OPEN


@settings(max_examples=60)
@example(b=1.0, h=1.0, mu=2.0, inertia=0.25, along=-1.0, up=0.0, rate=0.5, theta=0.0)
@given(
    b=sizes, h=sizes, mu=st.floats(0.0, 3.0), inertia=st.floats(0.1, 3.0),
    along=st.floats(-2, 2), up=st.floats(-2, 2), rate=st.floats(-2, 2),
    theta=st.sampled_from([0.0, 0.3, -0.7]),
)  # fmt: skip
def test_no_landing_without_restitution_gains_energy(b, h, mu, inertia, along, up, rate, theta):
    block = Block(b, h, mu, inertia=inertia)
    at = block.at(theta=theta, x_dot=along, y_dot=up, theta_dot=rate)
    assume(at.rates[0, touching(at), 1].min() < -1e-6)
    candidates = landings(at)  # several, where much friction leaves it open
    assert candidates
    for found in candidates:
        assert at.kinetic(found.motion)[0] <= at.kinetic()[0] * (1 + 1e-12)


def test_a_landing_with_restitution_may_gain_energy_under_this_law():
    """The known flaw of Newton's restitution with friction, which a user is to be told."""
    rng = np.random.default_rng(1)
    ratios = []
    for _ in range(100):
        block = Block(*rng.uniform(0.2, 2.0, 2), friction=rng.uniform(0.1, 2.0), restitution=0.9)
        at = block.at(theta=0.3, x_dot=rng.normal(), y_dot=rng.normal(), theta_dot=rng.normal())
        ratios.append(at.kinetic(one(landings(at)).motion)[0] / at.kinetic()[0])
    assert max(ratios) > 1.01


def test_a_flat_block_bounces_without_turning_unless_friction_is_large():
    block = Block(0.5, 0.8, 0.3, restitution=0.4)
    found = one(landings(block.at(x_dot=5.0, y_dot=-2.0)))
    arm = 0.3 * 0.8 / 0.5
    left, right = found.normal
    assert right / left == pytest.approx((1 + arm) / (1 - arm), rel=1e-12)
    np.testing.assert_allclose(found.motion, [5.0 - 0.3 * 1.4 * 2.0, 0.8, 0.0], atol=1e-14)
    rough = Block(0.5, 0.8, 0.7, restitution=0.4)
    found = one(landings(rough.at(x_dot=5.0, y_dot=-2.0)))
    assert found.pattern == (OPEN, SLIP_RIGHT)
    assert found.motion[2] > 0


def test_painleve_a_block_that_slides_flat_has_no_motion_and_one_that_turns_fast_has_two():
    b, h = 0.5, 1.0
    bound = exact.painleve_friction(b, h)
    smooth, rough = Block(b, h, bound - 0.01), Block(b, h, bound + 0.01)
    # below the bound the leading foot alone bears it: tripping
    assert one(followers(smooth.at(x_dot=1.0))).pattern == (OPEN, SLIP_RIGHT)
    for side in (1.0, -1.0):
        with pytest.raises(UndecidedError, match="no solution"):
            one(followers(rough.at(x_dot=side)))
        block = Block(b, h, 1.5)
        turning = block.at(theta=0.1 * side, theta_dot=4.0 * side, x_dot=8.0 * side)
        with pytest.raises(UndecidedError, match="several") as caught:
            one(followers(turning))
        assert len(caught.value.fits) == 2


SIZES = st.floats(0.2, 2.0)


@st.composite
def stacks(draw):
    b1, b2, h2 = draw(SIZES), draw(SIZES), draw(SIZES)
    b2 = min(b1, b2)
    return Stack(b1, draw(SIZES), b2, max(h2, 0.75 * b2), draw(SIZES), draw(SIZES))


@settings(max_examples=40)
@given(stack=stacks())
def test_an_upper_block_that_lands_sets_the_lower_one_rocking_as_by_hand(stack):
    rocks = lower_begins_to_rock(stack)
    at = stack.at((0.0, 0.0), (0.0, -1.0), (1, 1))
    found = one(landings(at))
    after = found.motion
    assert (abs(after[2]) > 1e-9) == rocks
    s = stack.b2 / math.hypot(stack.b2, stack.h2)
    if not rocks:
        assert after[5] / -1.0 == pytest.approx(1 - 1.5 * s * s, rel=1e-10)
        return
    assert after[2] < 0
    assert found.pattern[:2] == (STICK, OPEN)
    if found.pattern[3] == OPEN:  # else it stays whole on the lower block
        foot = -stack.b2, 2 * stack.h1
        assert momentum(at, after, foot, [1]) == pytest.approx(
            momentum(at, at.states.v[0], foot, [1]), rel=1e-9, abs=1e-9
        )
    pivot = -stack.b1, 0.0
    assert momentum(at, after, pivot) == pytest.approx(
        momentum(at, at.states.v[0], pivot), rel=1e-9, abs=1e-9
    )
    assert at.kinetic(after)[0] < at.kinetic()[0]


def test_two_blocks_whose_interface_stays_closed_are_one():
    stack = Stack(0.5, 0.4, 0.45, 0.3, 2.0, 1.5)
    found = one(followers(stack.at((0.1, 0.1), (0.3, 0.3), (1, 1))))
    assert found.pattern == (OPEN, STICK, STICK, STICK)
    centre = (2.0 * 0.4 + 1.5 * 1.1) / 3.5
    inertia = sum(
        m * (b * b + h * h) / 3 + m * (at - centre) ** 2
        for m, b, h, at in ((2.0, 0.5, 0.4, 0.4), (1.5, 0.45, 0.3, 1.1))
    )
    block = Block(0.5, centre, 10.0, mass=3.5, inertia=inertia)
    whole = one(followers(block.at(theta=0.1, theta_dot=0.3)))
    assert found.motion[2] == pytest.approx(whole.motion[2], rel=1e-12)
    assert found.motion[5] == pytest.approx(whole.motion[2], rel=1e-12)
    np.testing.assert_allclose(found.normal[:2], whole.normal, atol=1e-11)
