"""The moving window on systems whose frequency at each instant is known."""

import numpy as np
import pytest
from scipy import signal

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import identification
from tests.typical import column

RATE = 200.0
T = np.arange(0.0, 8.0, 1 / RATE)
COLUMN = column()


def recorded(**channels):
    return analysis.MeasuredRecord(T[: len(next(iter(channels.values())))], channels)


def test_window_of_the_thesis():
    """86 samples at 200 Hz: 2.3 Hz at best, 0.43 s, a spectrum every two samples."""
    x = np.sin(2 * np.pi * 9 * T)
    found = identification.moving_window(recorded(x=x), "x", beta=0.0)
    assert found.bandwidth == pytest.approx(200 / 86)
    assert found.span == pytest.approx(0.43)
    assert np.diff(found.time) == pytest.approx(0.01)
    assert len(found.time) == (len(T) - 86) // 2 + 1
    np.testing.assert_allclose(found.amplitude.max(axis=1), 1.0)
    with_taper = identification.moving_window(recorded(x=x), "x")
    assert with_taper.bandwidth == pytest.approx(1.48 * 200 / 86, abs=0.05)
    # the taper is there for this: less leaks far from the peak
    far = found.frequency > 40
    assert with_taper.amplitude[:, far].max() < 0.1 * found.amplitude[:, far].max()
    several = identification.moving_window(recorded(x=x), "x", segments=3)
    assert several.bandwidth == pytest.approx(2 * with_taper.bandwidth, rel=0.02)


def test_one_segment_is_the_spectrum_of_scipy():
    x = np.random.default_rng(0).normal(size=86)
    found = identification.moving_window(recorded(x=x), "x")
    f, power = signal.welch(x, RATE, ("kaiser", 6.0), 86, nfft=1024)
    at = np.searchsorted(f, found.frequency[0])
    np.testing.assert_allclose(
        found.amplitude[0] * found.largest[0], np.sqrt(power[at:]), rtol=1e-9
    )


def test_frequencies_of_a_chirp():
    """From 4 to 30 Hz, and 5 % of noise: each within half a bandwidth of the window's middle."""
    f = 4 + 26 * (T / T[-1]) ** 1.5
    x = np.cos(2 * np.pi * np.cumsum(f) / RATE)
    x += np.random.default_rng(1).normal(0, 0.05, len(T))
    found = identification.moving_window(recorded(x=x), "x")
    error = found.dominant - np.interp(found.time, T, f)
    assert np.abs(error).max() < found.bandwidth / 2
    assert np.abs(np.mean(error)) < 0.1


def test_transfer_function_of_an_oscillator_that_softens():
    """Under noise, from 12 to 6 Hz: the excitation's own peaks are divided out."""
    f = np.where(T < 4, 12.0, 6.0)
    rng = np.random.default_rng(2)
    band = signal.butter(2, [4, 20], "bandpass", output="sos", fs=RATE)
    a = signal.sosfilt(band, rng.normal(size=len(T)))
    a += 20 * np.sin(2 * np.pi * 16.5 * T)  # what the ground shakes with most
    x, v = np.zeros_like(T), 0.0
    fine = 20
    ground = np.interp(np.arange(len(T) * fine) / (RATE * fine), T, a)
    u = 0.0
    for i in range(1, len(T)):
        w = 2 * np.pi * f[i]
        for k in range(fine):
            v += (-ground[i * fine + k] - 2 * 0.03 * w * v - w**2 * u) / (RATE * fine)
            u += v / (RATE * fine)
        x[i] = u
    record = recorded(displacement=x, table=a)
    found = identification.moving_window(
        record, "displacement", "table", segments=2, window=0.86, frequencies=(3.0, 40.0)
    )
    assert found.transfer
    for expected, inside in ((12.0, found.time < 3.5), (6.0, found.time > 4.6)):
        median = np.median(found.dominant[inside])
        assert median == pytest.approx(expected, abs=found.bandwidth / 2)
    # the response alone follows the ground as well
    alone = identification.moving_window(record, "displacement", window=0.86)
    assert not alone.transfer
    assert (
        np.abs(found.dominant - np.where(found.time < 4, 12, 6)).mean()
        < np.abs(alone.dominant - np.where(alone.time < 4, 12, 6)).mean()
    )


def test_regimes_of_a_free_decay_of_the_flexible_structure():
    """Smooth rocking, passages through upright in quick succession, then flexure alone."""
    run = rk.simulate(
        COLUMN, rk.GroundMotion.none(4.0), initial={"theta": 0.0283}, impact=rk.Impulsive()
    )
    t = np.arange(0.0, 4.0, 1 / RATE)
    x = run.at(t, names=["displacement"])["displacement"]
    x = x + np.random.default_rng(3).normal(0.0, 1e-5, len(t))
    found = identification.moving_window(analysis.MeasuredRecord(t, {"x": x}), "x")
    half, resolved = found.span / 2, found.bandwidth / 2

    hits = np.array([impact.time for impact in run.impacts.above(0.01)])
    rocking = found.time + half < hits[4]
    # a rocking cycle is two half-cycles between impacts
    own = np.interp(found.time[rocking], (hits[1:] + hits[:-1]) / 2, 0.5 / np.diff(hits))
    assert rocking.sum() > 30
    assert np.abs(found.dominant[rocking] - own).max() < resolved

    fixed = np.sqrt(COLUMN.stiffness / COLUMN.mass) / (2 * np.pi)
    flexure = (found.time - half > run.events.rest_time) & (found.time < 3)
    assert flexure.sum() > 50
    assert np.abs(found.dominant[flexure] - fixed).max() < resolved

    # between both the frequency climbs: the passages come ever faster
    passage = (found.time > hits[5]) & (found.time < run.events.rest_time)
    assert passage.sum() > 8
    climbing = found.dominant[passage]
    assert climbing[0] < 5 + resolved
    assert climbing[-1] > 6
    assert np.all(found.part_above(7.0)[rocking] < 0.1)
    assert np.all(found.part_above(7.0)[flexure] > 0.9)
    between = found.part_above(7.0)[passage]
    assert between[0] < 0.2 < 0.4 < between[-1]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"window": 0.05}, "16 samples"),
        ({"window": 99.0}, "16 samples"),
        ({"segments": 40}, "fewer, or a longer window"),
        ({"beta": -1.0}, "beta is -1.0"),
    ],
)
def test_what_cannot_be_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        identification.moving_window(recorded(x=T), "x", **arguments)
