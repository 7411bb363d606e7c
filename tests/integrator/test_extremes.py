"""Rocking at the limits: on thresholds, at rest, for a long time, at tiny and huge scales."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.motion.segments import SegmentKind
from tests.typical import on_springs

from .models import point, thrown

GRAVITY = 9.81
BLOCK = rk.RigidBlock(half_width=0.25, half_height=1.0, gravity=GRAVITY)
THRESHOLD = 0.25 * GRAVITY
"""g B/H: products with powers of two, so that the condition is exactly zero at this value."""
P, ALPHA = 2.0, 0.25
SLENDER = rk.SlenderBlock.from_frequency(p=P, alpha=ALPHA, gravity=GRAVITY)
QUIET = rk.GroundMotion.none(100.0)
OTHER = {"left": "right", "right": "left", "both": "both"}
SIGNS = pytest.mark.parametrize("sign", [1, -1])


def pulse(start, length, acceleration, duration):
    """Quiet, a rectangular pulse, quiet: (3, 7) laws."""
    laws = np.zeros((3, 7))
    laws[:, 0] = 0.0, start, start + length
    laws[:, 1] = start, start + length, duration
    laws[:, 2] = SegmentKind.LINEAR
    laws[1, 3] = acceleration
    return rk.GroundMotion(laws)


# -- how a motion begins


def steps_in(run, mode):
    """(n, 2) start and length of the steps in a mode."""
    return run.steps.span[run.steps.mode == BLOCK.module.MODES.index(mode)]


def test_block_that_stands_under_a_sine_lifts_where_the_push_reaches_its_weight():
    """In one step: nothing moves until then."""
    amplitude, period = 4.0, 2.0
    run = rk.simulate(BLOCK, rk.GroundMotion.single_sine(amplitude, period, 3.0))
    lifts = math.asin(THRESHOLD / amplitude) * period / (2 * math.pi)
    assert steps_in(run, "both").tolist() == [[0.0, pytest.approx(lifts, rel=1e-12)]]


@pytest.mark.parametrize("rtol", [1e-5, 1e-8, 1e-11])
@pytest.mark.parametrize("shaken", [True, False])
def test_first_step_is_not_much_shorter_than_those_that_follow(rtol, shaken):
    """Nor so long that the error refuses it again and again."""
    motion = rk.GroundMotion.single_sine(4.0, 2.0, 3.0) if shaken else QUIET
    initial = {} if shaken else {"theta": 0.2}
    run = rk.simulate(BLOCK, motion, initial=initial, options=rk.SolverOptions(rtol=rtol))
    spans = steps_in(run, "left" if shaken else "right")[:, 1]
    assert spans[0] > 0.05 * np.median(spans)


# -- bouncing without loss


def test_elastic_bounces_for_ten_thousand_seconds():
    """No penetration, no drift, no impact too few or too many."""
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(1e4),
        impact=rk.VelocityRatio(1.0),
        initial={"theta": 0.1},
        options=rk.SolverOptions(rtol=1e-13, atol=1e-15, output_step=0.02),
    )
    assert run.outcome is rk.Outcome.COMPLETED
    assert run["theta"][run.mode == "right"].min() > -1e-13
    assert run["theta"][run.mode == "left"].max() < 1e-13
    energy = run["total_energy"] - GRAVITY * BLOCK.half_height
    np.testing.assert_allclose(energy, energy[0], rtol=1e-10)
    # all flights are alike, the first one is half
    times = np.array([0.0, *(impact.time for impact in run.impacts)])
    flights = np.diff(times)
    np.testing.assert_allclose(flights[1:], 2 * flights[0], rtol=1e-9)
    assert len(flights) == int((1e4 + flights[0]) / (2 * flights[0]))
    modes = [impact.mode_after for impact in run.impacts]
    assert modes == ["left" if n % 2 == 0 else "right" for n in range(len(modes))]


# -- infinitely many impacts


@pytest.mark.parametrize("tilt", [0.0, 0.3, -0.3, 0.9])
@pytest.mark.parametrize("ratio", [0.3, 0.8])
def test_accumulation_under_a_constant_push(tilt, ratio):
    """A slender block that leaves with speed v is back with v after (2/p) artanh(v/(p A)).

    A = alpha +- a/g of the side: a series, summed to the end. Rest lasts 100 s from there.
    """
    v = 0.5 * P * ALPHA * (1 - abs(tilt))
    reach = {1: ALPHA * (1 + tilt), -1: ALPHA * (1 - tilt)}
    expected, side, speed = [], 1, v
    while speed > 1e-18 * v:
        expected.append(2 / P * math.atanh(speed / (P * reach[side])))
        side, speed = -side, ratio * speed
    total = math.fsum(expected)

    run = rk.simulate(
        SLENDER,
        rk.GroundMotion.constant(tilt * ALPHA * GRAVITY, duration=total + 100.0),
        impact=rk.VelocityRatio(ratio),
        initial={"theta_dot": v},
    )
    found = [impact.time for impact in run.impacts]
    np.testing.assert_allclose(found[:8], np.cumsum(expected)[:8], rtol=1e-9)
    assert run.events.rest_time == pytest.approx(total, rel=1e-7)
    assert run.events[-1].kind == "rest"
    later = run.t > run.events.rest_time
    assert run.t[later][-1] - run.events.rest_time >= 99.9
    assert set(run.mode[later]) == {"both"}
    assert not run.y[later].any()


@pytest.mark.parametrize("ratio", [1 - 1e-3, 1 - 1e-6, 1 - 1e-9, 1 - 2**-53, 1.0])
@pytest.mark.parametrize("speed", [1e-18, 1e-9, 1e-300])
def test_slow_impact_that_loses_next_to_nothing_ends_by_name(ratio, speed):
    """The sum of so many impacts must not be made one by one."""
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(1.0),
        impact=rk.VelocityRatio(ratio),
        initial={"theta_dot": -speed},
        mode="right",
        options=rk.SolverOptions(max_impacts=1000, max_steps=100_000),
    )
    assert run.outcome in (rk.Outcome.CAME_TO_REST, rk.Outcome.TOO_MANY_IMPACTS)
    assert abs(run.final["theta_dot"]) <= speed * (1 + 1e-9)


# -- on the threshold


@SIGNS
@pytest.mark.parametrize(("ulps", "lifts"), [(-1, False), (0, False), (1, True)])
def test_uplift_one_rounding_error_either_side_of_the_threshold(sign, ulps, lifts):
    a = THRESHOLD + ulps * np.spacing(THRESHOLD)
    run = rk.simulate(BLOCK, rk.GroundMotion.constant(sign * a, duration=100.0))
    if lifts:
        (uplift,) = run.events
        assert (uplift.time, uplift.kind) == (0.0, "uplift")
        assert uplift.mode_after == ("left" if sign > 0 else "right")
        assert run.outcome is rk.Outcome.OVERTURNED
    else:
        assert run.events == ()
        assert not run.y.any()
        assert run.t[-1] == 100.0


@SIGNS
@pytest.mark.parametrize(("ulps", "lifts"), [(-1, False), (0, False), (1, True)])
def test_dead_impact_onto_the_threshold(sign, ulps, lifts):
    """Full contact is entered with its condition exactly zero, or a rounding error beside it."""
    a = THRESHOLD + ulps * np.spacing(THRESHOLD)
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.constant(sign * a, duration=100.0),
        impact=rk.VelocityRatio(0.0),
        initial={"theta": sign * 0.05},
    )
    kinds = [event.kind for event in run.events]
    assert kinds == (["impact", "uplift"] if lifts else ["impact"])
    assert run.events[0].mode_after == "both"
    if lifts:
        assert run.events[1].time == run.events[0].time
        assert run.outcome is rk.Outcome.OVERTURNED
    else:
        assert run.final == {"theta": 0.0, "theta_dot": 0.0}


def test_zero_velocity_impact_is_rest():
    """Upright in a rocking mode, without speed: full contact at once, and nothing more."""
    for mode in ("left", "right"):
        for rate in (0.0, -0.0):
            run = rk.simulate(BLOCK, QUIET, initial={"theta_dot": rate}, mode=mode)
            assert run.outcome is rk.Outcome.CAME_TO_REST
            assert len(run.events) <= 2
            assert not run.y.any()
            assert run.mode[-1] == "both"


@SIGNS
def test_impact_at_the_start(sign):
    """theta = 0 and closing: the impact is at t = 0, once; the block leaves to the other side."""
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(1.0),
        initial={"theta_dot": -sign * 0.1},
        mode="right" if sign > 0 else "left",
        impact=rk.VelocityRatio(0.9),
    )
    first, second = run.impacts[:2]
    assert first.time == 0.0
    assert first.after == {"theta": 0.0, "theta_dot": pytest.approx(-sign * 0.09, rel=1e-15)}
    assert second.time > 0.05
    # the same as if it had left from there
    direct = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(1.0),
        initial={"theta_dot": first.after["theta_dot"]},
        impact=rk.VelocityRatio(0.9),
    )
    assert run.final == pytest.approx(direct.final, abs=1e-11)


@pytest.mark.parametrize("rate", [1e-12, 1e-9, 1e-6])
def test_no_impact_fires_again_after_its_jump(rate):
    """Restarted from the state after an impact: the gap opens first, however slowly."""
    flight = 2 * math.atanh(rate / (P * ALPHA)) / P
    run = rk.simulate(
        SLENDER,
        rk.GroundMotion.none(1.5 * flight),
        impact=rk.VelocityRatio(0.5),
        initial={"theta_dot": rate},
        mode="right",
        options=rk.SolverOptions(rest_tolerance=1e-300),
    )
    assert run.impacts[0].time == pytest.approx(flight, rel=1e-6)
    assert run.impacts[0].before["theta_dot"] == pytest.approx(-rate, rel=1e-6)


# -- on the top: unstable equilibrium and separatrix


@SIGNS
@pytest.mark.parametrize("off", [1e-6, 1e-9, 1e-12])
def test_released_beside_the_unstable_equilibrium(sign, off):
    """A slender block departs from alpha like cosh(p t): the time to fall is a logarithm."""
    below, above = ALPHA * (1 - off), ALPHA * (1 + off)
    back = rk.simulate(SLENDER, QUIET, initial={"theta": sign * below})
    time = math.acosh(ALPHA / (ALPHA - below)) / P
    assert back.outcome is rk.Outcome.CAME_TO_REST
    assert back.impacts[0].time == pytest.approx(time, abs=1e-2)

    over = rk.simulate(SLENDER, QUIET, initial={"theta": sign * above})
    time = math.acosh((math.pi / 2 - ALPHA) / (above - ALPHA)) / P
    assert over.outcome is rk.Outcome.OVERTURNED
    assert over.t[-1] == pytest.approx(time, abs=1e-2)
    assert over.final["theta"] == pytest.approx(sign * math.pi / 2, rel=1e-12)


@pytest.mark.parametrize("ulps", [-1, 0, 1])
def test_released_at_the_unstable_equilibrium(ulps):
    """It may stay, fall or return, as rounding will have it; and the mirror image likewise."""
    theta = BLOCK.alpha + ulps * np.spacing(BLOCK.alpha)
    run, image = (rk.simulate(BLOCK, QUIET, initial={"theta": s * theta}) for s in (1, -1))
    assert run.outcome in (
        rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST, rk.Outcome.OVERTURNED
    )  # fmt: skip
    assert image.outcome is run.outcome
    np.testing.assert_array_equal(image["theta"], -run["theta"])
    # no departure before rounding can have grown
    assert run.at(5.0)["theta"] == pytest.approx(theta, abs=1e-10)


@SIGNS
@pytest.mark.parametrize("excess", [1e-10, 1e-8])
def test_energy_next_to_the_barrier(sign, excess):
    """Thrown up with 1 -+ 1e-10 of the energy of the top: back after 2/p artanh, or over."""
    options = rk.SolverOptions(rtol=1e-13, atol=1e-15)
    speed = sign * P * ALPHA
    back = rk.simulate(
        SLENDER, QUIET, initial={"theta_dot": speed * math.sqrt(1 - excess)}, options=options
    )
    time = 2 / P * math.atanh(math.sqrt(1 - excess))
    assert back.outcome is rk.Outcome.CAME_TO_REST
    assert back.impacts[0].time == pytest.approx(time, abs=1e-4)
    over = rk.simulate(
        SLENDER, QUIET, initial={"theta_dot": speed * math.sqrt(1 + excess)}, options=options
    )
    assert over.outcome is rk.Outcome.OVERTURNED
    assert over.t[-1] > time / 2


# -- short pulses, samples on impacts, symmetric shaking


@pytest.mark.parametrize("length", [1e-6, 1e-9])
def test_pulse_shorter_than_any_step(length):
    """A microsecond in the middle of 100 s of quiet: the block takes its impulse."""
    push = 0.1 / length
    run = rk.simulate(BLOCK, pulse(50.0, length, -push, 100.0), impact=rk.VelocityRatio(0.5))
    uplift = run.events[0]
    assert (uplift.time, uplift.kind, uplift.mode_after) == (50.0, "uplift", "right")
    length = (50.0 + length) - 50.0  # as times near 50 s have it
    acceleration = BLOCK.accelerations({}, ground_acceleration=-push, mode="right")["theta"]
    after = run.at(50.0 + 2 * length)
    # the weight slows it meanwhile
    weight = BLOCK.accelerations({}, mode="right")["theta"]
    expected = acceleration * length + weight * length
    assert after["theta_dot"] == pytest.approx(expected, rel=1e-8)
    assert run.outcome is rk.Outcome.CAME_TO_REST


@pytest.mark.parametrize("length", [1e-6, 1e-9])
def test_pulse_shorter_than_any_step_in_flight(length):
    """And so in the middle of a rocking motion: the rate jumps by the impulse."""
    free = rk.simulate(BLOCK, rk.GroundMotion.none(0.2), initial={"theta": 0.1})
    pushed = rk.simulate(BLOCK, pulse(0.1, length, -0.1 / length, 0.2), initial={"theta": 0.1})
    length = (0.1 + length) - 0.1
    theta = free.at(0.1)["theta"]
    push = [BLOCK.accelerations({"theta": theta}, a)["theta"] for a in (-0.1, 0.0)]
    jump = pushed.at(0.1 + length)["theta_dot"] - free.at(0.1 + length)["theta_dot"]
    assert jump == pytest.approx(push[0] - push[1], rel=1e-5)


@pytest.mark.parametrize("samples", [3, 4, 7])
@pytest.mark.parametrize("ulps", [-1, 0, 1])
def test_impact_on_a_sample_of_the_record(samples, ulps):
    """The record kinks, to a rounding error, where the block lands: one impact, not two or none."""
    free = rk.simulate(BLOCK, rk.GroundMotion.none(1.0), initial={"theta": 0.1})
    time = free.impacts[0].time

    def landing(dt):
        a = np.zeros(samples + 20)
        a[samples + 1 :: 2] = 1.0
        run = rk.simulate(
            BLOCK, rk.GroundMotion.from_array(a, dt), initial={"theta": 0.1}, duration=1.0
        )
        return [impact.time for impact in run.impacts], run.final

    dt = time / samples
    times, final = landing(dt + ulps * np.spacing(dt))
    beside, final_beside = landing(dt * (1 + 1e-9))
    assert times[0] == pytest.approx(time, rel=1e-15)
    np.testing.assert_allclose(times, beside, rtol=1e-7)
    assert final == pytest.approx(final_beside, rel=1e-6)


def test_both_feet_of_a_symmetric_structure_leave_at_once():
    """Thrown up without any tilt, on springs: simultaneous events must not tip it."""
    from_rest = rk.GroundMotion.none(3.0)
    structure = on_springs(foundation_damping=500.0)
    shaking = rk.GroundMotion.single_sine(30.0, period=0.2, duration=3.0)
    run = rk.simulate(structure, from_rest, vertical=shaking)
    assert "flight" in run.mode
    assert not run["theta"].any()
    assert not run["theta_dot"].any()
    assert run.mode[-1] == "both"


@pytest.mark.parametrize("amplitude", [1.5, 3.0, 6.0])
def test_exactly_antisymmetric_pulse_mirrored(amplitude):
    """A pulse and its image, each of two equal halves: equal responses to the last bit."""
    a = amplitude * THRESHOLD * np.array([0.0, 1.0, 0.0, -1.0, 0.0, 0.0])
    runs = [
        rk.simulate(BLOCK, rk.GroundMotion.from_array(s * a, dt=0.25), duration=5.0)
        for s in (1, -1)
    ]
    np.testing.assert_array_equal(runs[0]["theta"], -runs[1]["theta"])
    times = [[event.time for event in run.events] for run in runs]
    assert times[0] == times[1]
    modes = [[event.mode_after for event in run.events] for run in runs]
    assert modes[0] == [OTHER[name] for name in modes[1]]
    # it crosses the threshold on the straight line from 0 to the peak
    assert times[0][0] == pytest.approx(0.25 / amplitude, rel=1e-14)


@SIGNS
@pytest.mark.parametrize("excess", [-1e-6, 0.0, 1e-6, 1e-3])
@pytest.mark.parametrize("shape", ["half sine", "triangle"])
def test_exactly_symmetric_pulse_grazes_the_threshold(sign, excess, shape):
    """It comes back from its peak as it went there: at the threshold itself nothing lifts."""
    peak = sign * THRESHOLD * (1 + excess)
    if shape == "half sine":
        motion = rk.GroundMotion.half_sine(peak, period=1.0)
        reached = math.asin(1 / (1 + max(excess, 0.0))) / (2 * math.pi)
    else:
        motion = rk.GroundMotion.from_array(peak * np.array([0.0, 0.5, 1.0, 0.5, 0.0]), dt=0.125)
        reached = 0.25 / (1 + excess)
    run = rk.simulate(BLOCK, motion, duration=2.0)
    assert run.outcome is rk.Outcome.CAME_TO_REST
    if excess > 0:
        assert run.events[0].kind == "uplift"
        assert run.events[0].time == pytest.approx(reached, rel=1e-12)
        assert run.events[0].mode_after == ("left" if sign > 0 else "right")
    else:
        assert run.events == ()
        assert not run.y.any()


# -- tiny and huge


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1e3, 1e9])
def test_copies_of_any_size_are_alike_in_scaled_time(size):
    """A block of a nanometre, a millimetre, a kilometre: lengths by s, times by sqrt(s)."""

    def shaken(size):
        block = rk.RigidBlock(
            half_width=0.25 * size, half_height=size, mass=size**3, gravity=GRAVITY
        )
        time = math.sqrt(size)
        motion = rk.GroundMotion.single_sine(3 * THRESHOLD, period=0.8 * time, duration=8 * time)
        run = rk.simulate(block, motion, impact=rk.VelocityRatio(0.9))
        return run, [event.time / time for event in run.events]

    (reference, expected), (run, found) = shaken(1.0), shaken(size)
    assert run.outcome is reference.outcome
    assert len(found) == len(expected)
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    assert np.abs(run["theta"]).max() == pytest.approx(np.abs(reference["theta"]).max(), rel=1e-7)


# -- motions that cannot go on: outcomes by name, with what was done


def test_too_many_impacts_keep_what_was_done():
    options = rk.SolverOptions(max_impacts=5)
    run = rk.simulate(
        BLOCK, QUIET, impact=rk.VelocityRatio(1.0), initial={"theta": 0.1}, options=options
    )
    assert run.outcome is rk.Outcome.TOO_MANY_IMPACTS
    assert len(run.impacts) == 6
    assert run.t[-1] == pytest.approx(run.impacts[-1].time, rel=1e-15)


def test_too_many_steps_are_a_stall_that_keeps_what_was_done():
    run = rk.simulate(BLOCK, QUIET, initial={"theta": 0.1}, options=rk.SolverOptions(max_steps=5))
    assert run.outcome is rk.Outcome.STALLED
    assert 0.0 < run.t[-1] < 100.0
    assert run.at(run.t[-1])["theta"] == pytest.approx(run.final["theta"], rel=1e-15)
    assert 0.0 < run.final["theta"] <= 0.1


def test_start_where_there_is_no_potential_is_not_finite():
    run = thrown("one", edge=0.5, start=3.0, a=10.0, duration=10.0)
    assert run.outcome is rk.Outcome.NOT_FINITE
    assert run.final == {"x": 3.0, "x_dot": 1.0}


def test_motion_into_the_end_of_its_potential():
    """Beyond x = 2 the potential is no number: the last state is just before it."""
    run = thrown("one", edge=0.5, a=10.0, speed=3.0, duration=5.0)
    assert run.outcome in (rk.Outcome.NOT_FINITE, rk.Outcome.STALLED)
    assert run.final["x"] == pytest.approx(2.0, abs=1e-6)
    # energy to there: half of the speed's square less what the potential took
    assert run.final["x_dot"] == pytest.approx(math.sqrt(9.0 - 2.0), rel=1e-3)
    assert np.isfinite(run.y).all()


def test_overflow_is_not_finite_and_keeps_what_was_done():
    """Thrown down for ever under a gravity of 1e300."""
    run = thrown("six", gravity=1e300, duration=1e10)
    assert run.outcome in (rk.Outcome.NOT_FINITE, rk.Outcome.OVERTURNED)
    assert np.isfinite(run.y).all()


def test_modes_that_chase_one_another_are_chatter():
    run = thrown("ping", start=1.0, duration=10.0)
    assert run.outcome is rk.Outcome.CHATTER
    assert {event.time for event in run.events} == {0.0}
    assert run.final == {"x": 1.0, "x_dot": 1.0}


@pytest.mark.parametrize("e", [0.0, 0.5])
@settings(max_examples=40)
@given(
    amplitude=st.floats(0.1, 100.0),
    period=st.floats(1e-4, 10.0),
    theta=st.sampled_from([0.0, 1e-300, 1e-17, 0.1, BLOCK.alpha, 0.5]),
    rate=st.sampled_from([0.0, 1e-300, -1e-12, 1.0, -10.0]),
)
def test_nothing_hangs(e, amplitude, period, theta, rate):
    """Any shaking from any state ends within its limits, finite, in a named way."""
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.harmonic(amplitude, period=period, duration=20 * period),
        impact=rk.VelocityRatio(e),
        initial={"theta": theta, "theta_dot": rate},
        options=rk.SolverOptions(max_steps=20_000, max_impacts=2_000),
    )
    assert run.outcome in (
        rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST, rk.Outcome.OVERTURNED
    )  # fmt: skip
    assert np.isfinite(run.y).all()
    assert np.all(np.diff(run.t) >= 0)
    for before, after in itertools.pairwise(run.events):
        assert before.mode_after == after.mode_before


def test_many_at_once_name_the_same_outcomes():
    """Chatter, a point outside its potential and a healthy one side by side in an ensemble."""
    cases = {
        "chatter": rk.Case(point(), rk.GroundMotion.none(1.0), mode="ping"),
        "not finite": rk.Case(
            point(edge=0.5, a=10.0), rk.GroundMotion.none(1.0), initial={"x": 3.0}, mode="one"
        ),
        "completed": rk.Case(
            point(a=0.5), rk.GroundMotion.none(1.0), initial={"x_dot": 1.0}, mode="one"
        ),
    }
    result = rk.simulate_many(lambda case: cases[case], over={"case": list(cases)})
    assert result.outcome.values.tolist() == list(cases)
    assert result.final.sel(case="completed", state="x") == pytest.approx(1.0)
