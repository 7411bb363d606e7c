"""Elastic response spectra: exact where accelerations are linear between samples."""

from itertools import accumulate, pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics
from tests.refusals import refused

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
    history = dynamics.oscillator_history(RECORD, period, xi)
    assert np.allclose(
        [history.displacement[-1], history.velocity[-1]], end, rtol=1e-10, atol=1e-14
    )
    largest = float(analysis.response_spectrum(RECORD, period, xi).displacement[0])
    # never below what is seen between the samples, and above it by the gaps of 1/20 sample only,
    # unless the oscillator swings out further when the record is over
    free = np.hypot(end[0], end[1] * period / (2 * np.pi))
    assert largest >= np.abs(exact).max() * (1 - 1e-12)
    assert largest <= max(np.abs(exact).max() * (1 + 2e-2), free)


def largest(values):
    """Largest size (k,) of rows (n, k), between them by the parabola through the highest three."""
    found = []
    for y in np.abs(values).T:
        i = int(np.argmax(y))
        if not 0 < i < len(y) - 1:
            found.append(y[i])
            continue
        fall, bend = y[i + 1] - y[i - 1], y[i - 1] - 2 * y[i] + y[i + 1]
        found.append(y[i] - fall**2 / (8 * bend))
    return np.array(found)


def answers(u, v, period, xi):
    """Displacement, velocity and absolute acceleration, (n, 3)."""
    w = 2 * np.pi / period
    return np.stack([u, v, w**2 * u + 2 * xi * w * v], axis=-1)


@pytest.mark.parametrize("seed", [7, 8, 9])
@pytest.mark.parametrize(("period", "xi"), [(0.05, 0.05), (0.3, 0.0), (1.0, 0.2), (8.0, 0.05)])
def test_spectra_of_a_record_are_those_of_the_matrix_exponential(period, xi, seed):
    """All three, between the samples and behind the record, to 1e-8: 250 steps to a sample."""
    record = rk.GroundMotion.from_array(np.random.default_rng(seed).standard_normal(60), 0.02)
    w, parts = 2 * np.pi / period, 250
    a = np.array([[0, 1, 0, 0], [-w * w, -2 * xi * w, -1, 0], [0, 0, 0, 1], [0, 0, 0, 0]])
    powers = np.array([*accumulate([np.eye(4), *[expm(a * record.dt / parts)] * parts], np.matmul)])
    x, rows = np.zeros(2), []
    for start, end in zip(record.samples[:-1], record.samples[1:], strict=True):
        found = powers @ np.array([*x, start, (end - start) / record.dt])
        rows.append(found[:-1, :2])
        x = found[-1, :2]
    step = expm(a[:2, :2] * period / 2000)
    free = np.array([*accumulate([x, *[step] * 2000], lambda y, by: by @ y)])
    best = np.maximum(
        largest(answers(*np.concatenate(rows).T, period, xi)),
        largest(answers(*free.T, period, xi)),
    )
    spectrum = record.response_spectrum(period, xi)
    given = spectrum.displacement, spectrum.velocity, spectrum.acceleration
    assert np.concatenate(given) == pytest.approx(best, rel=1e-8)


ANALYTIC = {
    "cosine, which jumps": rk.GroundMotion.single_cosine(1.0, 0.6),
    "constant": rk.GroundMotion.constant(1.0, 0.4, 2.0),
    "Ricker": rk.GroundMotion.ricker(1.0, 0.4, duration=2.0),
    "antisymmetric Ricker": rk.GroundMotion.ricker(1.0, 0.4, duration=2.0, antisymmetric=True),
    "near-fault pulse": rk.GroundMotion.mavroeidis_papageorgiou(0.5, 0.6, 1.7, 0.4),
}


@pytest.mark.parametrize("motion", ANALYTIC.values(), ids=ANALYTIC)
def test_spectra_of_an_analytic_motion_are_those_of_an_integrator(motion):
    """DOP853 from break to break, and on for a period in which the oscillator is free."""
    period, xi = 0.5, 0.05
    w = 2 * np.pi / period
    state, found = np.zeros(2), []
    for start, end in pairwise([*motion.breakpoints, motion.duration + period]):
        inside = np.nextafter(start, end), np.nextafter(end, start)

        def rate(t, y, inside=inside):
            a = motion.acceleration(np.clip(t, *inside))
            return [y[1], -2 * xi * w * y[1] - w * w * y[0] - a]

        t = np.linspace(start, end, max(int((end - start) / period * 2000), 100))
        given = {"method": "DOP853", "t_eval": t, "rtol": 1e-11, "atol": 1e-13, "max_step": 0.05}
        run = solve_ivp(rate, (start, end), state, **given)
        state = run.y[:, -1]
        found.append(largest(answers(*run.y, period, xi)))
    spectrum = motion.response_spectrum(period, xi)
    given = spectrum.displacement, spectrum.velocity, spectrum.acceleration
    assert np.concatenate(given) == pytest.approx(np.max(found, axis=0), rel=1e-8)


def test_spectrum_keeps_the_shape_of_its_periods_and_the_name_of_its_motion():
    spectrum = RECORD.response_spectrum([[0.2, 0.5], [1.0, 2.0]])
    assert spectrum.name == RECORD.name
    for values in (spectrum.displacement, spectrum.velocity, spectrum.acceleration):
        assert values.shape == (2, 2)
    again = analysis.response_spectrum(RECORD, 1.0)
    assert again.acceleration[0] == spectrum.acceleration[1, 0]
    assert spectrum.pseudo_acceleration == pytest.approx(spectrum.acceleration, rel=0.1)
    assert len(RECORD.response_spectrum().periods) == 100


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
    soft = dynamics.oscillator_history(RECORD, 2000.0, 0.0)
    assert np.abs(soft.displacement).max() == pytest.approx(drift, rel=2e-2)
    assert len(soft.time) == len(t)


@pytest.mark.parametrize(
    ("period", "damping", "said"),
    [(0.0, 0.05, "periods[0]"), (1.0, 1.0, "damping_ratio"), (1.0, -0.1, "damping_ratio")],
)
def test_spectrum_refuses_what_does_not_vibrate(period, damping, said):
    assert refused(analysis.response_spectrum, RECORD, period, damping)[0] == said
