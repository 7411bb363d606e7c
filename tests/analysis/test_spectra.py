"""Elastic response spectra: exact where accelerations are linear between samples."""

import numpy as np
import pytest
from scipy.linalg import expm

import rockeom as rk
from rockeom import analysis

RNG = np.random.default_rng(7)
RECORD = rk.GroundMotion.from_array(RNG.standard_normal(200), 0.02)


def stepped(motion, period, xi, parts):
    """Displacements by the matrix exponential of oscillator and ramp, so many to a sample."""
    w = 2 * np.pi / period
    h = motion.dt / parts
    a = np.array([[0, 1, 0, 0], [-w * w, -2 * xi * w, -1, 0], [0, 0, 0, 1], [0, 0, 0, 0]], float)
    step = expm(a * h)
    u, found = np.zeros(2), [0.0]
    for k in range(len(motion.samples) - 1):
        ramp = (motion.samples[k + 1] - motion.samples[k]) / motion.dt
        x = np.array([*u, motion.samples[k], ramp])
        for _ in range(parts):
            x = step @ x
            found.append(x[0])
        u = x[:2]
    return np.array(found), u


@pytest.mark.parametrize(("period", "xi"), [(0.04, 0.05), (0.3, 0.0), (1.0, 0.2), (8.0, 0.05)])
def test_history_and_largest_displacement_are_those_of_the_matrix_exponential(period, xi):
    exact, end = stepped(RECORD, period, xi, 20)
    history = analysis.oscillator_history(RECORD, period, xi)
    assert np.allclose(
        [history.displacement[-1], history.velocity[-1]], end, rtol=1e-10, atol=1e-14
    )
    largest = float(analysis.response_spectrum(RECORD, period, xi).displacement[0])
    # never below what is seen between the samples, and above it by the gaps of 1/20 sample only,
    # unless the oscillator swings out further when the record is over
    free = np.hypot(end[0], end[1] * period / (2 * np.pi))
    assert largest >= np.abs(exact).max() * (1 - 1e-12)
    assert largest <= max(np.abs(exact).max() * (1 + 2e-2), free)


def test_free_vibration_after_a_pulse_is_counted():
    """A short push leaves the velocity I; without damping the peak after it is I/omega."""
    pulse = rk.GroundMotion.from_array([0.0, 1.0, 0.0], 1e-3)
    largest = analysis.response_spectrum(pulse, 2.0, 0.0).displacement[0]
    assert largest == pytest.approx(1e-3 / np.pi, rel=1e-5)


def test_limits_of_very_stiff_and_very_soft_oscillators():
    stiff = analysis.response_spectrum(RECORD, 1e-3).pseudo_acceleration[0]
    assert stiff == pytest.approx(RECORD.peak, rel=2e-2)
    t = np.arange(200) * 0.02
    velocity = np.concatenate([[0], np.cumsum((RECORD.samples[1:] + RECORD.samples[:-1]) * 0.01)])
    drift = np.abs(np.cumsum(velocity) * 0.02).max()
    soft = analysis.oscillator_history(RECORD, 2000.0, 0.0)
    assert np.abs(soft.displacement).max() == pytest.approx(drift, rel=2e-2)
    assert len(soft.time) == len(t)


@pytest.mark.parametrize(
    ("period", "damping", "said"),
    [(0.0, 0.05, "periods"), (1.0, 1.0, "damping_ratio"), (1.0, -0.1, "damping_ratio")],
)
def test_spectrum_refuses_what_does_not_vibrate(period, damping, said):
    with pytest.raises(ValueError, match=said):
        analysis.response_spectrum(RECORD, period, damping)
