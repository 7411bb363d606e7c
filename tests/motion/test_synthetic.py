"""Synthetic motions: their spectrum over many seeds is the closed form, a seed is one motion."""

import math

import numpy as np
import pytest

from rockeom import InputError
from rockeom.motion import (
    GroundMotion,
    JenningsEnvelope,
    ShinozukaSatoEnvelope,
    synthetic,
)

S_0, GROUND, HIGH_PASS = 0.02, (15.0, 0.6), (1.5, 0.7)


def made(model, seed, **given):
    more = {"high_pass_angular_frequency": HIGH_PASS[0], "high_pass_damping_ratio": HIGH_PASS[1]}
    return getattr(GroundMotion, model)(
        S_0, duration=20.47, seed=seed, angular_frequency=GROUND[0], damping_ratio=GROUND[1],
        **(more if model == "clough_penzien" else {}), **given,
    )  # fmt: skip


def density(model, w):
    """As printed: power of a filter's transfer function, which this is by complex numbers."""
    wg, xi = GROUND
    power = np.abs((wg**2 + 2j * xi * wg * w) / (wg**2 - w**2 + 2j * xi * wg * w)) ** 2
    if model == "clough_penzien":
        wf, xi = HIGH_PASS
        power *= np.abs(w**2 / (wf**2 - w**2 + 2j * xi * wf * w)) ** 2
    return S_0 * power


@pytest.mark.parametrize("model", ["kanai_tajimi", "clough_penzien"])
def test_average_spectrum_over_seeds_is_the_closed_form(model):
    """120 seeds, in bands of 8 frequencies: each mean of some 500 squares is within 5 sigma.

    Hann's window keeps what is strong from leaking into what is weak; it makes neighbouring
    frequencies depend on each other, by a factor of 1.9 in the variance of a band's mean.
    """
    n, dt, seeds, band = 2048, 0.01, 120, 8
    window = np.hanning(n)
    power = np.zeros(n // 2 + 1)
    for seed in range(seeds):
        samples = made(model, seed).samples
        assert len(samples) == n
        power += np.abs(np.fft.rfft(window * samples)) ** 2
    power *= dt / (2 * math.pi * (window @ window) * seeds)
    w = 2 * math.pi * np.fft.rfftfreq(n, dt)
    ratio = (power / np.maximum(density(model, w), 1e-12))[8:-9]
    ratio = ratio[: len(ratio) // band * band].reshape(-1, band).mean(axis=1)
    sigma = math.sqrt(1.9 / (band * seeds))
    assert np.abs(ratio - 1).max() < 5 * sigma
    assert np.std(ratio - 1) == pytest.approx(sigma, rel=0.4)  # it is noise, and no more


def test_variance_of_kanai_and_tajimi_is_its_closed_form():
    """pi S_0 omega_g (1 + 4 xi**2)/(2 xi), less what lies above half of the rate of sampling."""
    wg, xi = GROUND
    whole = math.pi * S_0 * wg * (1 + 4 * xi**2) / (2 * xi)
    beyond = 2 * S_0 * (2 * xi * wg) ** 2 / (math.pi / 0.01)
    found = np.mean([np.mean(made("kanai_tajimi", seed).samples ** 2) for seed in range(60)])
    assert found == pytest.approx(whole - beyond, rel=0.04)


def test_seed_is_one_motion_and_another_is_another():
    one, same, other = (made("clough_penzien", seed) for seed in (3, 3, 4))
    assert one.samples.tobytes() == same.samples.tobytes()
    assert one == same
    assert one.name == "Clough-Penzien, seed 3"
    assert not np.allclose(one.samples, other.samples)
    assert "S0 0.02 m2/s3" in one.source


def test_second_filter_leaves_displacements_finite():
    """They grow without bound where the density at zero frequency is not zero."""
    wide, finite = (
        np.median([made(model, seed).peak_displacement for seed in range(5)])
        for model in ("kanai_tajimi", "clough_penzien")
    )
    assert wide > 3 * finite


def test_envelopes_have_their_printed_shapes():
    t = np.array([0.0, 1.0, 2.0, 5.0, 10.0, 12.0])
    jennings = JenningsEnvelope(rise=2.0, until=10.0, decay=0.5)
    assert jennings(t) == pytest.approx([0.0, 0.25, 1.0, 1.0, 1.0, math.exp(-1.0)])
    sato = ShinozukaSatoEnvelope(decay=0.2, rise=0.8)
    fine = np.linspace(0, 20, 20001)
    assert sato(fine).max() == pytest.approx(1.0, rel=1e-6)
    ratio = (math.exp(-0.2) - math.exp(-0.8)) / (math.exp(-0.6) - math.exp(-2.4))
    assert sato(t)[1] / sato(np.array([3.0]))[0] == pytest.approx(ratio)


@pytest.mark.parametrize(
    "envelope", [JenningsEnvelope(2.0, 10.0, 0.5), ShinozukaSatoEnvelope(0.2, 0.8), np.cos]
)
def test_envelope_multiplies_the_stationary_motion(envelope):
    still, shaped = made("kanai_tajimi", 1), made("kanai_tajimi", 1, envelope=envelope)
    t = 0.01 * np.arange(2048)
    assert shaped.samples == pytest.approx(still.samples * envelope(t), abs=1e-15)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: GroundMotion.kanai_tajimi(-1.0, duration=1.0, seed=0), "spectral_intensity is -1"),
        (lambda: GroundMotion.kanai_tajimi(1.0, duration=0.0, seed=0), "duration is 0"),
        (lambda: GroundMotion.kanai_tajimi(1.0, duration=1.0, seed=1.5), "seed is 1.5.*whole"),
        (
            lambda: GroundMotion.kanai_tajimi(1.0, duration=1.0, seed=0, dt=9.0),
            "dt is 9: give a step",
        ),
        (
            lambda: GroundMotion.clough_penzien(
                1.0, duration=1.0, seed=0, high_pass_damping_ratio=0.0
            ),
            "high_pass_damping_ratio is 0: give a positive",
        ),
        (lambda: made("kanai_tajimi", 0, envelope=3.0), "envelope is 3: give a function"),
        (lambda: made("kanai_tajimi", 0, envelope=np.sum), r"shape \(\) for 2048 times"),
        (lambda: JenningsEnvelope(3.0, 2.0, 1.0), "until is 2 s, before the end of the rise, 3 s"),
        (lambda: ShinozukaSatoEnvelope(1.0, 0.5), "rise is 0.5 1/s, not above the decay, 1 1/s"),
        (lambda: ShinozukaSatoEnvelope(-1.0, 0.5), "decay is -1: give a positive"),
    ],
)
def test_motion_that_cannot_be_made_is_refused(call, said):
    with pytest.raises(InputError, match=said):
        call()


def test_density_is_zero_at_rest_only_behind_the_second_filter():
    assert synthetic.spectral_density(0.0, S_0, GROUND) == S_0
    assert synthetic.spectral_density(0.0, S_0, GROUND, HIGH_PASS) == 0.0
