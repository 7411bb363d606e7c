"""The slender block under a record, linear between samples: cosh and sinh pieces are exact."""

import numpy as np
import pytest

import rockeom as rk
from tests.exact import GRAVITY, ShakenSlenderBlock

P, ALPHA, DT = 2.14, 0.25, 0.02
BLOCK = rk.SlenderBlock.from_frequency(p=P, alpha=ALPHA)


def record(seed):
    """A made-up record: smoothed noise that grows and fades, peak 0.6 g, 8 s."""
    noise = np.random.default_rng(seed).normal(size=int(8 / DT) + 1)
    smooth = np.convolve(noise, np.hanning(9), mode="same")
    t = np.arange(len(smooth)) * DT
    shaped = smooth * np.sin(np.pi * t / 8) ** 2
    return shaped / np.abs(shaped).max() * 0.6 * GRAVITY


@pytest.mark.parametrize("seed", range(6))
def test_uplift_impacts_and_motion(seed):
    a = record(seed)
    exact = ShakenSlenderBlock(P, ALPHA, 0.9, a, DT)
    motion = rk.GroundMotion.from_array(a, DT)
    run = rk.simulate(BLOCK, motion, impact=rk.VelocityRatio(0.9))

    # up to the first rest, from which both would start anew
    end = next((e.time for e in run.events if e.mode_after == "both"), 8.0) - 1e-3
    uplift, side = exact.lifts()
    impacts, state = exact.follow(end, uplift, side)
    assert len(impacts) >= 3
    assert run.events[0].kind == "uplift"
    assert run.events[0].time == pytest.approx(uplift, rel=1e-12)
    found = [impact.time for impact in run.impacts if impact.time < end]
    np.testing.assert_allclose(found, impacts, rtol=1e-9)
    at = run.at(end)
    np.testing.assert_allclose([at["theta"], at["theta_dot"]], state, atol=1e-9)


def test_released_block_meets_the_impacts_at_the_tightest_tolerances():
    p, e, dt = 2.0, 0.9, 0.125
    samples = 0.1 * GRAVITY * np.sin(np.arange(25) ** 1.3)
    run = rk.simulate(
        rk.SlenderBlock.from_frequency(p=p, alpha=ALPHA),
        rk.GroundMotion.from_array(samples, dt),
        impact=rk.VelocityRatio(e),
        initial={"theta": 0.05},
        options=rk.SolverOptions(rtol=1e-14, atol=1e-17),
    )
    impacts, _ = ShakenSlenderBlock(p, ALPHA, e, samples, dt).follow(3.0, 0.0, 1, 0.05)
    assert len(run.impacts) == len(impacts) >= 4
    np.testing.assert_allclose([i.time for i in run.impacts], impacts, rtol=0.0, atol=1e-12)


def test_forced_quarter_by_a_constant_acceleration():
    """Thesis 2-14 under a = 1.3 alpha g: theta = 0.3 alpha (cosh(p t) - 1) to the left."""
    motion = rk.GroundMotion.constant(1.3 * ALPHA * GRAVITY, duration=1.0)
    run = rk.simulate(BLOCK, motion)
    t = np.linspace(0, 1, 50)
    expected = -0.3 * ALPHA * (np.cosh(P * t) - 1)
    np.testing.assert_allclose(run.at(t)["theta"], expected, rtol=1e-9, atol=1e-12)
