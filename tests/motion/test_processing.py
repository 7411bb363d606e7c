"""Records made fit for use: what is taken out is what was put in, and the rest stays."""

import numpy as np
import pytest

from rockeom import InputError
from rockeom.motion import GroundMotion
from tests.refusals import refused

DT, N = 0.01, 2001
T = DT * np.arange(N)
SINE = GroundMotion.from_array(np.sin(2 * np.pi * 2.0 * T), DT, name="sine")


# --- baselines


@pytest.mark.parametrize("of", ["acceleration", "velocity", "displacement"])
@pytest.mark.parametrize("degree", [2, 3, 5])
def test_record_that_is_a_polynomial_has_nothing_left(of, degree):
    """Each has the integrals that its baseline is of: a polynomial that starts at rest."""
    lost = {"acceleration": 0, "velocity": 1, "displacement": 2}[of]
    power = degree - lost
    record = GroundMotion.from_array((T / T[-1]) ** power, DT)
    left = record.baseline_corrected(degree, of).samples
    # linear between samples, the record is a polynomial but for (dt/T)**2
    assert np.abs(left).max() < 5e-5


def test_baseline_of_the_velocity_leaves_the_shaking_and_takes_the_drift():
    drift = GroundMotion.from_array(SINE.samples + 0.02, DT, name="drifting")
    assert drift.peak_displacement > 4.0
    mended = drift.baseline_corrected(1)
    assert mended.samples == pytest.approx(SINE.baseline_corrected(1).samples, abs=1e-12)
    assert mended.peak_displacement < 0.2 * drift.peak_displacement
    assert mended.name == "drifting"
    assert mended.source == "array, less its baseline, of degree 1 of the velocity"


def test_quiet_time_behind_a_record_belongs_to_its_baseline():
    padded = SINE.padded_by(0.505)
    mended = padded.baseline_corrected(3)
    assert mended.duration == padded.duration
    assert len(mended.samples) == N + 50


# --- filters


def test_filter_leaves_half_of_the_amplitude_at_its_corner_and_no_phase():
    for given in ({"low": 2.0}, {"high": 2.0}):
        passed = SINE.filtered(**given).samples
        middle = slice(700, 1300)
        assert passed[middle] == pytest.approx(0.5 * SINE.samples[middle], abs=2e-3)


def test_filter_takes_out_what_lies_beyond_its_corners():
    slow, fast = np.sin(2 * np.pi * 0.1 * T), np.sin(2 * np.pi * 20.0 * T)
    mixed = GroundMotion.from_array(SINE.samples + slow + fast, DT)
    passed = mixed.filtered(low=0.5, high=8.0)
    middle = slice(700, 1300)
    assert passed.samples[middle] == pytest.approx(SINE.samples[middle], abs=0.02)
    assert passed.duration == mixed.duration
    assert passed.source.endswith("filtered, low corner 0.5 Hz, high corner 8 Hz, order 4 "
                                  "forward and backward")  # fmt: skip


# --- another step


def test_linear_resampling_to_a_part_of_the_step_keeps_the_motion():
    fine = SINE.resampled(0.0025)
    t = np.linspace(0, T[-1], 997)
    assert fine.acceleration(t) == pytest.approx(SINE.acceleration(t), abs=1e-12)
    assert fine.dt == 0.0025
    assert SINE.resampled(0.3).duration == pytest.approx(19.8)  # the last whole step
    pulse = GroundMotion.half_sine(1.0, 0.5, duration=1.0)
    assert pulse.resampled(0.01).samples == pytest.approx(pulse.sampled(0.01)[1])


@pytest.mark.parametrize("dt", [0.005, 0.004, 0.02, 0.0125])
def test_band_limited_resampling_follows_what_both_steps_can_hold(dt):
    """A sine of 2 Hz within the record, where linear values are off by their chord."""
    new = SINE.resampled(dt, method="band limited")
    t = dt * np.arange(len(new.samples))
    inner = (t > 2.0) & (t < 18.0)
    assert new.samples[inner] == pytest.approx(np.sin(2 * np.pi * 2.0 * t[inner]), abs=2e-3)
    assert new.duration == pytest.approx(SINE.duration)


def test_band_limited_resampling_takes_out_what_the_new_step_cannot_hold():
    fast = GroundMotion.from_array(np.sin(2 * np.pi * 40.0 * T), DT)
    assert np.abs(fast.resampled(0.05, "band limited").samples[20:-20]).max() < 1e-2
    assert np.abs(fast.resampled(0.055).samples).max() > 0.5  # folded down


# --- a part of the time


def test_part_of_a_record_has_its_samples():
    part = SINE.trimmed(2.0, 5.0)
    assert np.array_equal(part.samples, SINE.samples[200:501])
    assert part.source == "array, from 2 to 5 s"
    start, end = SINE.significant_interval()
    assert SINE.trimmed(start, end).duration == pytest.approx(end - start, abs=0.01)
    padded = SINE.padded_by(3.0)
    assert padded.trimmed(1.0).duration == pytest.approx(padded.duration - 1.0)


@pytest.mark.parametrize(
    "motion",
    [
        GroundMotion.constant(1.0, 1.0, 3.0),
        GroundMotion.harmonic(2.0, frequency=1.3, duration=3.0, phase=0.2),
        GroundMotion.ricker(1.0, 0.5),
        GroundMotion.ricker(1.0, 0.5, antisymmetric=True),
    ],
    ids=lambda motion: motion.name,
)
def test_part_of_an_analytic_motion_is_exact(motion):
    part = motion.trimmed(0.3, 2.6)
    t = np.linspace(0.0, 2.3, 301)[:-1]
    assert part.acceleration(t) == pytest.approx(motion.acceleration(t + 0.3), abs=1e-14)
    assert part.samples is None


def test_near_fault_pulse_keeps_its_beginning():
    pulse = GroundMotion.mavroeidis_papageorgiou(0.5, 1.0, 2.0)
    part = pulse.trimmed(0.0, 1.5)
    assert part.velocity(1.2) == pulse.velocity(1.2)
    assert refused(pulse.trimmed, 0.5) == ("start", 0.5)
    assert pulse.resampled(0.01).trimmed(0.5).velocity(0.0) == 0.0


# --- what cannot be done


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda m: m.baseline_corrected(0), r"degree is 0: give a whole number of at least 1"),
        (lambda m: m.baseline_corrected(1.5), r"degree is 1\.5: give a whole number"),
        (lambda m: m.baseline_corrected(12), r"degree is 12: give at most 10"),
        (lambda m: m.baseline_corrected(1, "force"), r"baseline of 'force' is unknown.*velocity"),
        (lambda m: m.filtered(), r"no corner: give low, high or both"),
        (lambda m: m.filtered(low=60.0), "low is 60: give a corner below 50 Hz, half"),
        (lambda m: m.filtered(low=1e-9), r"low is 1e-09: .* above 0\.0005 Hz"),
        (lambda m: m.filtered(high=-1.0), r"high is -1: .* above 0\.0005 Hz"),
        (lambda m: m.filtered(5.0, 1.0), r"low is 5 Hz and high 1 Hz: .* smaller one as low"),
        (lambda m: m.filtered(1.0, order=0), r"order is 0: give a whole number of at least 1"),
        (lambda m: m.resampled(-1.0), r"dt is -1: give a positive"),
        (lambda m: m.resampled(30.0), r"dt is 30: give less than the motion's 20 s"),
        (lambda m: m.resampled(0.01, "cubic"), r"method is 'cubic': give \"linear\" or"),
        (lambda m: m.resampled(0.01 / np.pi, "band limited"), r"in no ratio of whole numbers"),
        (lambda m: m.trimmed(5.0, 2.0), r"start is 5 s and end 2 s: give times between 0 and"),
        (lambda m: m.trimmed(1.0, 99.0), r"end 99 s"),
        (lambda m: m.trimmed(1.0, 1.001), r"acceleration is an array of shape \(1,\):"),
    ],
)
def test_what_cannot_be_done_is_refused_with_the_value_and_a_remedy(call, said):
    with pytest.raises(InputError, match=said):
        call(SINE)


@pytest.mark.parametrize("call", [
    lambda m: m.baseline_corrected(), lambda m: m.filtered(low=1.0),
    lambda m: m.resampled(0.01, "band limited"),
])  # fmt: skip
def test_motion_without_samples_is_sent_to_get_some(call):
    with pytest.raises(InputError, match=r"has no samples for .*: resampled\(dt\) gives it some"):
        call(GroundMotion.half_sine(1.0, 0.5))
