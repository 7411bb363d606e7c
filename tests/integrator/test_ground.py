"""The ground in the compiled loop: the same motion as GroundMotion's, stopped at every break."""

import math
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.motion.segments import SegmentKind
from tests.machine_code import functions

BLOCK = rk.RigidBlock(half_width=0.25, half_height=1.0, gravity=9.81)
MOTIONS = {
    "none": rk.GroundMotion.none(3.0),
    "constant": rk.GroundMotion.constant(-1.5, duration=1.0, total_duration=3.0),
    "half sine": rk.GroundMotion.half_sine(2.0, period=1.3),
    "single sine": rk.GroundMotion.single_sine(2.0, period=0.7),
    "single cosine": rk.GroundMotion.single_cosine(2.0, period=0.7),
    "harmonic": rk.GroundMotion.harmonic(1.0, frequency=3.3, phase=0.4, duration=3.0),
    "Ricker": rk.GroundMotion.ricker(3.0, period=0.4),
    "antisymmetric Ricker": rk.GroundMotion.ricker(3.0, period=0.4, antisymmetric=True),
    "Mavroeidis-Papageorgiou": rk.GroundMotion.mavroeidis_papageorgiou(0.3, 0.6, 1.7, 0.4),
    "record": rk.GroundMotion.from_array(np.random.default_rng(1).normal(size=300), dt=0.01),
}


IN_ROWS = """
@entry
def in_rows(table: Floats2, times: Floats, found: Floats):
    n = 0
    for i in range(len(times)):
        n, row = segment_at(table, n, times[i])
        found[i] = ground_acceleration(row, times[i])
"""
"""Rows are looked up going on from the last one."""


@cache
def in_rows():
    return functions(IN_ROWS, BLOCK.module)["in_rows"]


def in_loop(motion, times):
    """Acceleration as the loop has it."""
    found = np.empty(len(times))
    in_rows()(motion.segments, np.array(times, dtype=float), found)
    return found


def test_every_kind_of_law_is_among_the_motions():
    kinds = {int(kind) for motion in MOTIONS.values() for kind in motion.segments[:, 2]}
    assert kinds == {int(kind) for kind in SegmentKind}


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_loop_and_motion_agree_on_the_acceleration(motion):
    breaks = motion.breakpoints[:-1]
    times = np.sort(
        np.concatenate(
            [
                np.random.default_rng(0).uniform(0, motion.duration, 400),
                breaks,
                np.nextafter(breaks[1:], 0),
                np.nextafter(breaks, np.inf),
            ]
        )
    )
    np.testing.assert_allclose(
        in_loop(motion, times), motion.acceleration(times), rtol=1e-13, atol=1e-14 * motion.peak
    )


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_ground_stands_still_behind_a_motion(motion):
    after = motion.duration + np.array([1e-9, 1.0, 1e6])
    assert not in_loop(motion, after).any()


@pytest.mark.parametrize("method", ["DOP853", "RK45"])
def test_no_step_straddles_a_breakpoint_of_either_motion(method):
    """Two records whose samples interleave, and one that ends early."""
    rng = np.random.default_rng(2)
    horizontal = rk.GroundMotion.from_array(rng.normal(scale=1.0, size=41), dt=0.1)
    vertical = rk.GroundMotion.from_array(rng.normal(scale=0.8, size=73), dt=0.037)
    run = rk.simulate(
        BLOCK,
        horizontal,
        vertical=vertical,
        initial={"theta": 0.1},
        duration=6.0,
        options=rk.SolverOptions(method=method),
    )
    assert run.t[-1] == 6.0
    start, end = run.steps.span[:, 0], run.steps.span.sum(axis=1)
    breaks = np.concatenate([horizontal.breakpoints, vertical.breakpoints])
    slack = 1e-13
    for b in breaks:
        assert not np.any((start < b - slack) & (end > b + slack))
    # and steps cover the time without gap
    np.testing.assert_allclose(start[1:], end[:-1], atol=slack)


def test_constant_vertical_acceleration_is_more_gravity():
    heavy = rk.RigidBlock(half_width=0.25, half_height=1.0, gravity=9.81 + 2.0)
    motion = rk.GroundMotion.ricker(5.0, period=0.6)
    end = motion.duration
    a = rk.simulate(heavy, motion)
    b = rk.simulate(BLOCK, motion, vertical=rk.GroundMotion.constant(2.0, duration=end))
    assert len(a.impacts) > 3
    assert [e.time for e in b.events] == pytest.approx([e.time for e in a.events], rel=1e-9)
    np.testing.assert_allclose(b["vertical_ground_acceleration"], 2.0)
    t = np.linspace(0, 0.99 * end, 200)
    np.testing.assert_allclose(b.at(t)["theta"], a.at(t)["theta"], atol=1e-10)


def test_reactions_follow_the_same_ground_up_to_the_last_sample():
    """In full contact the horizontal force is mass times ground acceleration, at every sample."""
    motion = rk.GroundMotion.constant(1.0, duration=2.0)
    up = rk.GroundMotion.single_sine(3.0, period=0.5, duration=2.0)
    run = rk.simulate(BLOCK, motion, vertical=up)
    np.testing.assert_allclose(run["horizontal_reaction"], run["ground_acceleration"])
    weight = BLOCK.gravity + run["vertical_ground_acceleration"]
    np.testing.assert_allclose(run["left_reaction"] + run["right_reaction"], weight)


def test_two_records_are_cut_at_both_their_breaks():
    """A vertical step between two horizontal samples: exact hyperbolic pieces either side."""
    p, alpha, jump = 2.0, 0.25, 0.123
    block = rk.SlenderBlock.from_frequency(p=p, alpha=alpha, gravity=9.81)
    vertical = rk.GroundMotion.constant(0.5 * 9.81, duration=jump, total_duration=1.0)
    run = rk.simulate(
        block, rk.GroundMotion.from_array(np.zeros(5), dt=0.1), vertical=vertical,
        initial={"theta": 0.1},
    )  # fmt: skip
    fast = p * math.sqrt(1.5)
    angle = (0.1 - alpha) * math.cosh(fast * jump)
    rate = (0.1 - alpha) * fast * math.sinh(fast * jump)
    x = p * (0.35 - jump)
    expected = alpha + angle * math.cosh(x) + rate / p * math.sinh(x)
    assert run.impacts == () or run.impacts[0].time > 0.35
    assert run.at(0.35)["theta"] == pytest.approx(expected, rel=1e-10)
