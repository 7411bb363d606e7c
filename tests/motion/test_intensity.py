"""Velocity, displacement, intensity measures: closed forms of a sine, a dense sampling of any."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from rockeom import InputError
from rockeom.motion import GroundMotion, Measures, intensity
from tests.refusals import refused

RECORD = GroundMotion.from_array(np.random.default_rng(5).normal(size=20), 0.05, name="noise")
OF_EACH_KIND = {
    "linear": GroundMotion.constant(-1.5, 1.0, 3.0),
    "record": RECORD,
    "padded record": RECORD.padded_by(2.0),
    "sine": GroundMotion.harmonic(1.0, frequency=1.3, duration=3.0, phase=0.4),
    "cosine and quiet": GroundMotion.single_cosine(2.0, 0.7),
    "Ricker": GroundMotion.ricker(3.0, 0.4),
    "antisymmetric Ricker": GroundMotion.ricker(3.0, 0.4, antisymmetric=True),
    "Mavroeidis-Papageorgiou": GroundMotion.mavroeidis_papageorgiou(0.5, 1.2, 1.7, 0.6),
}
each_kind = pytest.mark.parametrize("motion", OF_EACH_KIND.values(), ids=OF_EACH_KIND)


def integral(function, motion, end):
    """Segment by segment: no rule may straddle a kink."""
    breaks = [t for t in motion.breakpoints if t < end] + [end]
    return sum(quad(function, *part, epsabs=1e-13, limit=200)[0] for part in pairwise(breaks))


# --- velocity and displacement


@each_kind
def test_velocity_and_displacement_are_the_integrals_of_the_acceleration(motion):
    for t in (0.37 * motion.duration, motion.duration):
        v = integral(motion.acceleration, motion, t)
        d = integral(motion.velocity, motion, t)
        assert motion.velocity(t) == pytest.approx(v, rel=1e-11, abs=1e-13)
        assert motion.displacement(t) == pytest.approx(d, rel=1e-11, abs=1e-13)


def test_ground_rests_before_a_motion_and_coasts_behind_it():
    """A step of 1.5 m/s2 over one second leaves 1.5 m/s and 0.75 m."""
    motion = GroundMotion.constant(1.5, 1.0)
    assert motion.velocity([-1.0, 0.0, 1.0, 3.0]) == pytest.approx([0.0, 0.0, 1.5, 1.5])
    assert motion.displacement([-1.0, 1.0, 3.0]) == pytest.approx([0.0, 0.75, 3.75])
    assert motion.velocity(np.zeros((2, 3))).shape == (2, 3)
    assert np.ndim(motion.displacement(0.5)) == 0


@each_kind
def test_velocity_and_displacement_scale_with_the_motion(motion):
    scaled = motion.scaled(acceleration=2.0, time=0.5)
    t = motion.duration * np.linspace(0.05, 1.0, 9)
    assert scaled.velocity(0.5 * t) == pytest.approx(motion.velocity(t), rel=1e-11, abs=1e-13)
    assert scaled.displacement(0.5 * t) == pytest.approx(
        0.5 * motion.displacement(t), rel=1e-11, abs=1e-13
    )


# --- the pulse of Mavroeidis and Papageorgiou, by the formulas printed


def test_pulse_is_that_of_the_printed_formulas():
    """Mavroeidis and Papageorgiou (2003), about the centre of the pulse."""
    a, f, g, nu = 0.7, 0.8, 2.3, 0.9
    motion = GroundMotion.mavroeidis_papageorgiou(a, 1 / f, g, nu, duration=6.0)
    x = np.linspace(-0.5, 0.5, 101)[1:-1] * g / f
    t = x + 0.5 * g / f
    fast, slow = 2 * math.pi * f * x, 2 * math.pi * f / g * x
    velocity = 0.5 * a * (1 + np.cos(slow)) * np.cos(fast + nu)
    acceleration = -a * math.pi * f / g * (
        np.sin(slow) * np.cos(fast + nu) + g * np.sin(fast + nu) * (1 + np.cos(slow))
    )  # fmt: skip
    displacement = a / (4 * math.pi * f) * (
        np.sin(fast + nu)
        + 0.5 * g / (g - 1) * np.sin(2 * math.pi * f * (g - 1) / g * x + nu)
        + 0.5 * g / (g + 1) * np.sin(2 * math.pi * f * (g + 1) / g * x + nu)
    )  # fmt: skip

    assert motion.velocity(t) == pytest.approx(velocity, abs=1e-14)
    assert motion.acceleration(t) == pytest.approx(acceleration, abs=1e-13)
    # as printed it has a constant of its own, which the lasting displacement has not
    assert np.diff(motion.displacement(t)) == pytest.approx(np.diff(displacement), abs=1e-14)
    before, after = (math.sin(nu + side * math.pi * g) for side in (-1, 1))
    lasting = a / (4 * math.pi * f * (1 - g**2)) * (after - before)
    assert motion.displacement(6.0) == pytest.approx(lasting, rel=1e-12)


def test_pulse_without_a_longer_envelope_is_refused():
    assert refused(GroundMotion.mavroeidis_papageorgiou, 0.5, 1.0, 1.0) == ("gamma", 1.0)
    with pytest.raises(InputError, match="c3, the rate of an envelope, must lie"):
        GroundMotion([[0.0, 1.0, 4.0, 1.0, 2.0, 0.0, 3.0]])


# --- closed forms of a sine


AMPLITUDE, PERIOD, TURNS = 2.0, 0.5, 7  # no part of the intensity asked for is reached at rest
OMEGA = 2 * math.pi / PERIOD
SINE = GroundMotion.harmonic(AMPLITUDE, period=PERIOD, duration=TURNS * PERIOD)


def husid(part):
    """Time at which that part of the Arias intensity of the sine is reached, by its closed form."""
    end = TURNS * PERIOD
    return brentq(lambda t: t - math.sin(2 * OMEGA * t) / (2 * OMEGA) - part * end, 0, end)


def test_measures_of_a_sine_are_its_closed_forms_and_have_units():
    found = SINE.measures()
    end = TURNS * PERIOD
    assert isinstance(found, Measures)
    assert found.pga == pytest.approx(AMPLITUDE, rel=1e-15)
    # v = A/omega (1 - cos), whose mean carries the ground away
    assert found.pgv == SINE.peak_velocity == pytest.approx(2 * AMPLITUDE / OMEGA, rel=1e-14)
    assert found.pgd == SINE.peak_displacement == pytest.approx(AMPLITUDE / OMEGA * end, rel=1e-13)
    assert found.arias_intensity == pytest.approx(
        math.pi / (2 * 9.81) * AMPLITUDE**2 * end / 2, rel=1e-13
    )
    assert found.cav == pytest.approx(4 * TURNS * AMPLITUDE / OMEGA, rel=1e-13)
    assert found.significant_duration_5_75 == pytest.approx(husid(0.75) - husid(0.05), rel=1e-11)
    assert found.significant_duration_5_95 == pytest.approx(husid(0.95) - husid(0.05), rel=1e-11)
    first = math.asin(0.05 * 9.81 / AMPLITUDE) / OMEGA
    assert found.bracketed_duration == pytest.approx(end - 2 * first, rel=1e-13)

    assert set(found.units.values()) == {"m/s2", "m/s", "m", "s"}
    lines = str(found).splitlines()
    assert lines[0].split() == ["pga", "2", "m/s2"]
    assert len(lines) == len(found.units)


def test_periods_of_a_long_sine_are_its_own():
    """Whole turns in 40 s have one line in the Fourier spectrum; resonance is at its period."""
    long = GroundMotion.harmonic(1.0, period=0.5, duration=40.0).resampled(0.005)
    assert intensity.mean_period(long) == pytest.approx(0.5, rel=1e-3)
    near = intensity.PREDOMINANT[np.argmin(np.abs(intensity.PREDOMINANT - 0.5))]
    assert intensity.predominant_period(long) == near


# --- any motion, against a dense sampling


@each_kind
def test_measures_of_any_motion_are_those_of_a_dense_sampling(motion):
    t = np.linspace(0, motion.duration, 50_001)
    a, v, d = motion.acceleration(t), motion.velocity(t), motion.displacement(t)
    parts = intensity._Parts(motion)
    for exact, sampled in (
        (parts.peak_velocity, np.abs(v).max()),
        (parts.peak_displacement, np.abs(d).max()),
    ):
        assert sampled * (1 - 1e-12) <= exact <= sampled * (1 + 1e-6)
    assert parts.cumulative_absolute_velocity == pytest.approx(np.trapezoid(np.abs(a), t), rel=2e-4)
    squares = np.cumsum(a**2)
    assert parts.squares[-1] == pytest.approx(np.trapezoid(a**2, t), rel=2e-4)
    for lower, upper in ((0.05, 0.95), (0.2, 0.5)):
        at = t[np.searchsorted(squares, np.array([lower, upper]) * squares[-1])]
        assert parts.significant_interval(lower, upper) == pytest.approx(at, abs=3 * t[1])
    above = t[np.abs(a) >= 0.3]
    assert parts.bracketed_duration(0.3) == pytest.approx(np.ptp(above), abs=3 * t[1])


def test_no_two_crossings_of_zero_are_passed_over():
    """A pulse may turn just beyond zero: CAV is no less than what its velocity goes to and fro."""
    rng = np.random.default_rng(0)
    for _ in range(60):
        period, gamma = rng.uniform(0.1, 2.0), 1.0 + rng.exponential()
        motion = GroundMotion.mavroeidis_papageorgiou(1.0, period, gamma, rng.uniform(-4, 4))
        v = motion.velocity(np.linspace(0.0, gamma * period, 3001))
        lost = intensity.cumulative_absolute_velocity(motion) - np.abs(np.diff(v)).sum()
        assert -1e-12 < lost < 1e-4


def test_peak_velocity_between_samples_is_found():
    """Linear from 1 to -3 m/s2 in one step: the velocity is largest a quarter into it."""
    motion = GroundMotion.from_array([1.0, -3.0], 1.0)
    assert intensity.peak_velocity(GroundMotion.from_array([1.0, -1.0], 1.0)) == 0.25
    assert motion.peak_velocity == pytest.approx(1.0)  # and -1 at the end
    assert motion.velocity(0.25) == pytest.approx(0.125)
    # it comes to a stop after half of the step, where the displacement turns
    assert motion.displacement(0.5) == pytest.approx(1 / 24)
    assert intensity.cumulative_absolute_velocity(motion) == pytest.approx(0.125 + 1.125)
    assert intensity.bracketed_duration(motion, 2.0) == pytest.approx(0.25)
    assert intensity.bracketed_duration(motion, 3.5) == 0.0


def test_whole_of_the_arias_intensity_ends_with_the_shaking():
    motion = GroundMotion.constant(2.0, 1.0, 5.0)
    assert motion.significant_interval(0.0, 1.0) == pytest.approx((0.0, 1.0))
    assert motion.significant_interval(0.25, 0.75) == pytest.approx((0.25, 0.75))
    assert intensity.significant_duration(motion, 0.25, 0.75) == pytest.approx(0.5)
    assert intensity.arias_intensity(motion, gravity=10.0) == pytest.approx(math.pi / 20 * 4)


def test_motion_without_shaking_has_no_durations_and_no_periods():
    found = GroundMotion.none(3.0).measures()
    assert (found.pga, found.pgv, found.pgd, found.cav, found.bracketed_duration) == (0.0,) * 5
    assert math.isnan(found.significant_duration_5_95)
    assert math.isnan(found.mean_period)
    assert math.isnan(found.predominant_period)
    slow = GroundMotion.from_array([0.0, 1.0, 0.0], 5.0)  # nothing is known above 0.1 Hz
    assert math.isnan(slow.measures().mean_period)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: SINE.significant_interval(0.9, 0.1), "lower"),
        (lambda: SINE.significant_interval(0.1, 1.5), "lower"),
        (lambda: GroundMotion.none(1.0).significant_interval(), "motion"),
        (lambda: intensity.arias_intensity(SINE, 0.0), "gravity"),
        (lambda: intensity.bracketed_duration(SINE, -1.0), "threshold"),
    ],
)
def test_what_cannot_be_measured_is_refused(call, said):
    assert refused(call)[0] == said
