"""A block on four feet at different heights: which of them carry, when it lifts, how it lands."""

import math

import numpy as np
import pytest

import rockeom as rk
from tests.mechanics import BlockOnFeet, Foot

from .declared import four_feet
from .reference import follow

G, MASS, HEIGHT, INERTIA, FRICTION = 9.81, 2.0, 0.9, 0.9, 0.8
FEET = {"a": (-1.5, 0.2), "b": (-0.5, 0.0), "c": (0.4, 0.0), "d": (1.4, 0.3)}
ARMS = {name: np.array([-u, HEIGHT - w]) for name, (u, w) in FEET.items()}
"""From each foot to the mass centre, along and across the base."""
STILL = rk.GroundMotion.none(2.0)


def about(foot: str) -> float:
    return INERTIA + MASS * ARMS[foot] @ ARMS[foot]


def ratio(old: str, new: str) -> float:
    """Rate of rotation after over before a landing, by the angular momentum about the new foot."""
    return (INERTIA + MASS * ARMS[old] @ ARMS[new]) / about(new)


def potential(foot: str, theta: float) -> float:
    """Of the weight, the block turned clockwise about a foot."""
    along, across = ARMS[foot]
    return MASS * G * (across * math.cos(theta) - along * math.sin(theta))


def on_ground(friction: float) -> rk.Structure:
    return rk.structure(
        four_feet(),
        mass=MASS, height=HEIGHT, inertia=INERTIA, gravity=G, friction=friction,
        restitution=0.0, half_width=1.0, stiffness=1e3, damping=1e2,
    )  # fmt: skip


@pytest.fixture(scope="module")
def structure():
    return on_ground(FRICTION)


@pytest.fixture(scope="module")
def rough():
    """On ground on which no foot slips."""
    return on_ground(4.0)


@pytest.fixture(scope="module")
def by_hand():
    feet = tuple(Foot(name, *place, FRICTION, 0.0) for name, place in FEET.items())
    return BlockOnFeet(MASS, INERTIA, HEIGHT, feet, gravity=G)


def test_the_two_lowest_feet_carry_it_by_the_lever(structure):
    forces = structure.reactions({})
    assert forces["b_reaction"] == pytest.approx(MASS * G * 0.4 / 0.9, rel=1e-12)
    assert forces["c_reaction"] == pytest.approx(MASS * G * 0.5 / 0.9, rel=1e-12)
    assert forces["a_reaction"] == forces["d_reaction"] == 0.0


@pytest.mark.parametrize(("side", "pivot", "arm"), [(1, "b", 0.5), (-1, "c", 0.4)])
def test_it_lifts_about_the_lowest_foot_behind_which_the_ground_moves(structure, side, pivot, arm):
    least = G * arm / HEIGHT
    for more in (0.999, 1.001, 1.3):
        a = side * more * least
        motion = rk.GroundMotion.constant(a, 1e-6)
        mode = rk.simulate(structure, motion).mode[-1]
        assert mode == (pivot if more > 1 else "b_c")
        turns = structure.accelerations({}, a, mode=mode)["theta"]
        expected = -side * MASS * (abs(a) * HEIGHT - G * arm) / about(pivot) if more > 1 else 0.0
        assert turns == pytest.approx(expected, abs=1e-12)


def test_a_lean_stands_on_the_foot_on_that_side(rough):
    """Not named, x, y and their rates follow from the lowest foot."""
    for theta, foot in ((0.1, "c"), (0.35, "d"), (-0.1, "b"), (-0.25, "a")):
        run = rk.simulate(rough, STILL, initial={"theta": theta}, duration=1e-3)
        assert set(run.mode) == {foot}
        u, w = FEET[foot]
        height = u * math.sin(theta) - w * math.cos(theta)
        assert run["y"][0] == pytest.approx(height, abs=1e-12)


def test_its_landings_keep_the_momentum_about_the_new_foot(structure):
    run = rk.simulate(structure, STILL, initial={"theta": 0.25}, duration=1.6)
    landings = [e for e in run.events if e.kind == "landing"]
    assert [e.contact for e in landings] == ["b", "c", "b"]
    fallen = potential("c", 0.25) - potential("c", 0.0)
    rate = -math.sqrt(2 * fallen / about("c"))
    for event, (old, new) in zip(landings, ["cb", "bc", "cb"], strict=True):
        assert event.before["theta_dot"] == pytest.approx(rate, rel=1e-9)
        rate *= ratio(old, new)
        assert event.after["theta_dot"] == pytest.approx(rate, rel=1e-9)
        rate = -rate  # it comes back as fast as it went


def test_it_climbs_on_the_outer_foot_and_comes_back(rough):
    start = 1.6
    run = rk.simulate(rough, STILL, initial={"theta_dot": start}, duration=1.2)
    up, down = [e for e in run.events if e.kind == "landing"][:2]
    assert (up.mode_before, up.mode_after) == ("c", "d")
    assert (down.mode_before, down.mode_after) == ("d", "c")
    tilt = math.atan2(0.3, 1.0)
    climbed = potential("c", tilt) - potential("c", 0.0)
    rate = math.sqrt(start**2 - 2 * climbed / about("c"))
    assert up.before["theta"] == pytest.approx(tilt, abs=1e-10)
    assert up.before["theta_dot"] == pytest.approx(rate, rel=1e-9)
    assert up.after["theta_dot"] == pytest.approx(rate * ratio("c", "d"), rel=1e-9)
    back = -rate * ratio("c", "d")
    assert down.before["theta_dot"] == pytest.approx(back, rel=1e-9)
    assert down.after["theta_dot"] == pytest.approx(back * ratio("d", "c"), rel=1e-9)


def test_shaken_it_slides_and_climbs_as_the_reference(structure, by_hand):
    amplitude, period, end = 11.0, 0.9, 0.85

    def ground(t):
        return amplitude * math.sin(2 * math.pi * t / period), 0.0

    still = np.zeros((1, 3))
    reference = follow(by_hand.at(still, still), end, ground)
    motion = rk.GroundMotion.single_sine(amplitude, period)
    run = rk.simulate(structure, motion, duration=end)
    assert {e.kind for e in reference.events} >= {"landing", "slip begins"}
    landings = [e.time for e in run.events if e.kind == "landing"]
    np.testing.assert_allclose(landings, reference.times("landing"), atol=1e-8)
    for t in np.linspace(0.05, 1.0, 10) * end:
        at, expected = run.at(t), reference.named(t)
        for name in ("x", "y", "theta"):
            assert float(at[name]) == pytest.approx(expected[name], abs=1e-7), (name, t)
