"""Blocks that rock freely to rest: every impact time is known exactly."""

import itertools
import math

import numpy as np
import pytest

import rockeom as rk
from tests.exact import FreeBlock, FreeSlenderBlock, first, impact_times, rest_time

P, ALPHA, RELEASE = 2.14, 0.25, 0.2
QUIET = rk.GroundMotion.none(100.0)

LAWS = pytest.mark.parametrize(
    ("law", "energy_ratio"),
    [
        (rk.AngularMomentum(), (1 - 1.5 * math.sin(ALPHA) ** 2) ** 2),  # thesis 2-6
        (rk.EnergyRatio(0.81), 0.81),
        (rk.VelocityRatio(0.95), 0.95**2),
    ],
    ids=["angular momentum", "energy ratio", "velocity ratio"],
)
BLOCKS = pytest.mark.parametrize(
    ("structure", "exact"),
    [
        (rk.RigidBlock.from_frequency(p=P, alpha=ALPHA), FreeBlock(P, ALPHA)),
        (rk.SlenderBlock.from_frequency(p=P, alpha=ALPHA), FreeSlenderBlock(P, ALPHA)),
    ],
    ids=["rigid block", "slender block"],
)


@BLOCKS
@LAWS
def test_twenty_impact_times(structure, exact, law, energy_ratio):
    run = rk.simulate(structure, QUIET, impact=law, initial={"theta": RELEASE})
    found = np.array([impact.time for impact in run.impacts[:20]])
    expected = first(20, impact_times(exact, RELEASE, energy_ratio))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=0)


@BLOCKS
@LAWS
def test_speeds_at_impacts(structure, exact, law, energy_ratio):
    run = rk.simulate(structure, QUIET, impact=law, initial={"theta": RELEASE})
    arriving = np.array([abs(impact.before["theta_dot"]) for impact in run.impacts[:20]])
    leaving = np.array([abs(impact.after["theta_dot"]) for impact in run.impacts[:20]])
    speed = math.sqrt(2 * exact.impact_energy(RELEASE)) * energy_ratio ** (np.arange(20) / 2)
    np.testing.assert_allclose(arriving, speed, rtol=1e-8)
    np.testing.assert_allclose(leaving / arriving, math.sqrt(energy_ratio), rtol=1e-14)


def test_peak_rotations():
    """Rest is reached between impacts at the angles that energy allows."""
    structure = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)
    run = rk.simulate(structure, QUIET, impact=rk.EnergyRatio(0.81), initial={"theta": RELEASE})
    exact = FreeBlock(P, ALPHA)
    times = [0.0, *(impact.time for impact in run.impacts[:12])]
    peak = RELEASE
    for n, (before, after) in enumerate(itertools.pairwise(times[1:])):
        peak = exact.peak(0.81 * exact.impact_energy(peak))
        middle = run.at((before + after) / 2)
        assert middle["theta"] == pytest.approx((-1) ** (n + 1) * peak, rel=1e-9)
        assert abs(middle["theta_dot"]) < 1e-8


# -- infinitely many impacts in a finite time


def test_infinitely_many_impacts_end_in_rest_that_lasts():
    block = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)
    run = rk.simulate(
        block, rk.GroundMotion.none(110.0), impact=rk.VelocityRatio(0.9), initial={"theta": RELEASE}
    )
    # computed once with 50 digits
    assert run.impacts[0].time == pytest.approx(1.071994026, abs=1e-9)
    assert run.events.rest_time == pytest.approx(10.648687, abs=1e-6)

    expected = rest_time(FreeBlock(P, ALPHA), RELEASE, 0.81)
    assert run.events.rest_time == pytest.approx(expected, rel=1e-10)
    assert run.outcome is rk.Outcome.CAME_TO_REST

    after = run.t > run.events.rest_time
    assert after.any()
    assert run.t[-1] == 110.0
    assert not run["theta"][after].any()
    assert not run["theta_dot"][after].any()
    assert set(run.mode[after]) == {"both"}
    assert not [event for event in run.events if event.time > run.events.rest_time]


@pytest.mark.parametrize("ratio", [0.3, 0.7, 0.97])
def test_rest_time_of_other_restitutions(ratio):
    block = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)
    run = rk.simulate(block, QUIET, impact=rk.VelocityRatio(ratio), initial={"theta": RELEASE})
    expected = rest_time(FreeBlock(P, ALPHA), RELEASE, ratio**2)
    assert run.events.rest_time == pytest.approx(expected, rel=1e-10)


def test_rest_time_converges_with_its_tolerance():
    block = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)
    expected = rest_time(FreeBlock(P, ALPHA), RELEASE, 0.81)

    def error(tolerance):
        run = rk.simulate(
            block,
            QUIET,
            impact=rk.VelocityRatio(0.9),
            initial={"theta": RELEASE},
            options=rk.SolverOptions(rest_tolerance=tolerance),
        )
        return abs(run.events.rest_time - expected)

    # what is summed in closed form are parabolas: the error is that of a cubic
    assert error(0.3) > 1e-5
    assert error(0.03) < error(0.3) / 100


def test_dead_impact_ends_the_motion_at_once():
    block = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)
    run = rk.simulate(block, QUIET, impact=rk.VelocityRatio(0.0), initial={"theta": RELEASE})
    (impact,) = run.impacts
    assert impact.time == pytest.approx(FreeBlock(P, ALPHA).quarter(RELEASE), rel=1e-10)
    assert impact.mode_after == "both"
    assert impact.after == {"theta": 0.0, "theta_dot": 0.0}
    assert run.outcome is rk.Outcome.CAME_TO_REST


def test_lossless_impacts_never_end():
    """e = 1: as many impacts as half periods, each of the first one's length."""
    block = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)
    run = rk.simulate(block, QUIET, impact=rk.VelocityRatio(1.0), initial={"theta": RELEASE})
    quarter = FreeBlock(P, ALPHA).quarter(RELEASE)
    times = np.array([impact.time for impact in run.impacts])
    assert len(times) == int((100.0 + quarter) / (2 * quarter))
    np.testing.assert_allclose(times, quarter * (2 * np.arange(len(times)) + 1), rtol=1e-9)
    assert run.outcome is rk.Outcome.COMPLETED
    assert run.events.rest_time is None


@pytest.mark.parametrize(("part", "impacts"), [(0.01, 900), (0.1, 275)])
def test_many_impacts_make_no_drift_in_time(part, impacts):
    """Each impact is landed on to rounding errors of its own: they do not add up to one side.

    What each left of its gap, within what is allowed, was 50 times as much after 250 impacts.
    """
    block = rk.SlenderBlock.from_frequency(p=P, alpha=ALPHA)
    options = rk.SolverOptions(rtol=1e-12, atol=1e-14, max_impacts=10_000)
    run = rk.simulate(
        block, rk.GroundMotion.none(120.0), impact=rk.VelocityRatio(1.0),
        initial={"theta": part * ALPHA}, options=options,
    )  # fmt: skip
    times = np.array([impact.time for impact in run.impacts])
    quarter = math.acosh(1.0 / (1.0 - part)) / P
    assert len(times) == pytest.approx(impacts, abs=10)
    drift = times - quarter * (2 * np.arange(len(times)) + 1)
    assert np.abs(drift).max() < 2e-11
