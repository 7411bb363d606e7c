"""How near motions come to overturning: theta/alpha by side, and the reserve."""

import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.simulation.reserve import reserve_of
from tests.typical import FIRST_MOMENT, S1, TOTAL_MASS, column, on_springs

PULSE = rk.GroundMotion.single_sine(amplitude=4.0, period=0.7, duration=6.0)
STILL = rk.GroundMotion.none(3.0)


def test_overturning_angle_is_that_of_all_masses_and_less_where_a_column_bends():
    rigid = math.atan2(S1["half_width"] * TOTAL_MASS, FIRST_MOMENT)
    assert rk.LumpedMassStructure(**S1).overturning_angles == pytest.approx((rigid, rigid))
    assert on_springs(foundation_stiffness=1e12).overturning_angles[0] == pytest.approx(rigid)
    assert column(stiffness=1e12).overturning_angles[1] == pytest.approx(rigid, rel=1e-6)
    assert column(stiffness=2e4).overturning_angles[1] < 0.97 * rigid


def test_a_column_let_go_within_its_overturning_angle_comes_back():
    soft = column(stiffness=2e4)
    angle = soft.overturning_angles[1]
    force, state = soft.equilibrium(angle)
    assert abs(force) < 1e-6
    for part, comes_back in ((0.99, True), (1.01, False)):
        start = {"theta": part * angle, "u": state[1]}
        run = rk.simulate(soft, STILL, initial=start)
        assert bool(run.impacts) == comes_back


def test_the_reserve_counts_each_side_by_its_own_angle():
    statue = rk.RigidBlock.from_dimensions(width=0.6, height=1.8, offset=0.1)
    left, right = statue.overturning_angles
    run = rk.simulate(statue, PULSE.scaled_to(peak=2.6))
    theta = run.extremes("theta")
    expected = max(-theta.minimum / left, theta.maximum / right)
    found = reserve_of(statue, theta)
    assert (found.ratio, found.reserve) == pytest.approx((expected, 1.0 - expected))
    assert abs(run.extremes("rotation_ratio").peak) == pytest.approx(expected, rel=1e-6)
    assert run.rotation_ratio == pytest.approx(
        run["theta"] / np.where(run["theta"] < 0.0, left, right)
    )
    side = "left" if -theta.minimum / left > theta.maximum / right else "right"
    assert f"the overturning angle to the {side} is" in run.summary()


def test_a_motion_that_overturned_has_no_reserve():
    run = rk.simulate(rk.RigidBlock(half_width=0.2, half_height=1.0), PULSE)
    assert run.outcome == "overturned"
    assert "the overturning angle to the right is 0.1974 rad (11.3 degrees)" in run.summary()
    assert "Reserve: none." in run.summary()


def test_structures_without_an_overturning_angle_say_nothing_of_it():
    oscillator = rk.UpliftingOscillator.from_frequency(20.0, 0.05, height=2.0, half_width=0.5)
    assert oscillator.overturning_angles == (math.inf, math.inf)
    assert "Reserve" not in rk.simulate(oscillator, PULSE).summary()
    held = rk.simulate(column().fixed_base(), PULSE)
    assert held.structure.overturning_angles is None
    with pytest.raises(KeyError):
        held["rotation_ratio"]
