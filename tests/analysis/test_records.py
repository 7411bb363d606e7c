"""Measured records: what is read, what noise it has, and what the signal chain does to both."""

import numpy as np
import pytest

from rockeom import analysis
from rockeom.analysis import identification
from tests.refusals import told

T = np.arange(0.0, 4.0, 0.001)


def test_columns_are_read_in_si_units(tmp_path):
    path = tmp_path / "test 5.csv"
    rows = "\n".join(f"{0.005 * i + 2:.3f},{i % 7},{i - 3},{0.1 * i:.1f}" for i in range(20))
    path.write_text(f"time (s),top displacement (mm),tendon,table (g)\n{rows}\n")
    record = analysis.MeasuredRecord.from_csv(
        path, units={"tendon": "kN"}, noise={"tendon": 20.0, "table": 0.0}
    )
    assert [*record.channels] == ["top displacement", "tendon", "table"]
    assert record.step == pytest.approx(0.005, rel=1e-12)
    assert record.time[0] == 2.0
    assert record.name == "test 5"
    np.testing.assert_allclose(record["top displacement"], 1e-3 * (np.arange(20) % 7))
    np.testing.assert_allclose(record["tendon"], 1e3 * (np.arange(20) - 3.0))
    np.testing.assert_allclose(record["table"], 9.81 * 0.1 * np.arange(20))
    assert record.noise["tendon"].level == 20.0
    one = analysis.MeasuredRecord.from_csv(path, units={"tendon": "N"}, channels=["tendon"])
    assert [*one.channels] == ["tendon"]


@pytest.mark.parametrize(
    ("text", "arguments", "words"),
    [
        ("time,a\n0,1\n", {}, ["line 1", "'a'", "units={'a'"]),
        ("time,a (furlong)\n0,1\n", {}, ["line 1", "'furlong'", "mm"]),
        ("time,a (mm)\n0,1\n", {"units": {"a": "kN"}}, ["'mm'", "'kN'", "leave it out"]),
        ("time,a (mm)\n0,1\n", {"units": {"b": "mm"}}, ["'b'", "'a'"]),
        ("time,a (mm)\n0,1\n", {"channels": ["time"]}, ["'time'", "'a'"]),
        ("time,a (mm)\n0,1\n", {"channels": ["a", "a"]}, ["twice"]),
        ("t,a (mm)\n0,1\n", {}, ["'time'", "'t'"]),
        ("time (ms),a (mm)\n0,1\n1,2\n", {}, ["'ms'", "seconds"]),
        ("time,a (mm)\n0,1\n0.1,two\n0.2,3\n", {}, ["line 3", "a of sample 2", "'two'"]),
        ("time,a (mm)\n0,1\n0.1,nan\n0.2,3\n", {}, ["line 3", "a of sample 2", "nan"]),
        ("time,a (mm)\n0,1\n0.1,1\n0.4,3\n0.5,1\n", {}, ["line 4", "not uniform", "0.4"]),
        ("time,a (mm)\n0,1\n0.1\n", {}, ["line 3", "1 columns"]),
        ("0,1\n0.1,2\n", {}, ["no names", "first line"]),
    ],
)
def test_what_a_file_leaves_open_is_refused_with_its_place(tmp_path, text, arguments, words):
    path = tmp_path / "r.csv"
    path.write_text(text)
    message = told(analysis.MeasuredRecord.from_csv, path, **arguments)
    for word in ["r.csv", *words]:
        assert word in message


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: analysis.MeasuredRecord(T[:4], {"x": T[:4]}), "at least 8"),
        (lambda: analysis.MeasuredRecord(T**2, {"x": T}), "not even"),
        (lambda: analysis.MeasuredRecord(T, {"x": T[1:]}), "x has the shape"),
        (lambda: analysis.MeasuredRecord(T, {"x": T * np.nan}), r"x\[0\] is nan"),
        (lambda: analysis.MeasuredRecord(T, {"x": T}, {"y": 1.0}), "noise of .*'y'"),
        (lambda: analysis.MeasuredRecord(T, {"x": T}, {"x": -1.0}), "level is -1"),
        (lambda: wave(0.0).low_pass(600.0), "half of the rate of sampling, 500 Hz"),
        (lambda: wave(0.0).with_derivatives("x", window=0.004), "too few samples"),
        (lambda: wave(0.0).resampled(1.5), "whole number"),
    ],
)
def test_what_cannot_be_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_unknown_channel_is_named():
    with pytest.raises(KeyError, match="'y'; there are x"):
        wave(0.0)["y"]


def wave(sigma, seed=0, frequency=1.5):
    """Decaying rocking, whose rate jumps at each passage, with white noise."""
    clean = np.exp(-0.4 * T) * np.abs(np.cos(2 * np.pi * frequency * T))
    clean *= np.sign(np.cos(2 * np.pi * frequency * T)) + 0.3
    noise = np.random.default_rng(seed).normal(0.0, sigma, len(T)) if sigma else 0.0
    return analysis.MeasuredRecord(T, {"x": clean + noise})


# --- noise


@pytest.mark.parametrize("sigma", [1e-6, 1e-3, 0.05])
def test_noise_is_found_from_the_record_itself(sigma):
    """Bends at impacts and strays do not count; nor does it matter whether the steps are even."""
    found = [wave(sigma, seed).noise["x"].level for seed in range(4)]
    np.testing.assert_allclose(found, sigma, rtol=0.1)
    uneven = np.cumsum(np.random.default_rng(5).uniform(0.5, 1.5, len(T))) * 1e-3
    x = np.cos(9 * uneven) + np.random.default_rng(6).normal(0.0, sigma, len(T))
    x[::500] += 0.5
    assert identification.noise_level(uneven, x) == pytest.approx(sigma, rel=0.1)


def test_a_record_without_noise_has_none():
    assert wave(0.0).noise["x"].level < 1e-12


CHAIN = {
    "low pass": lambda r: (r.low_pass(40.0), "x"),
    "twice": lambda r: (r.low_pass(80.0).low_pass(60.0, order=2), "x"),
    "rate": lambda r: (r.with_derivatives("x", 0.05), "x_dot"),
    "acceleration": lambda r: (r.with_derivatives("x", 0.05), "x_ddot"),
    "rate of the filtered": lambda r: (r.low_pass(40.0).with_derivatives("x", 0.05), "x_dot"),
    "every third": lambda r: (
        r.low_pass(40.0).resampled(1 / 3).with_derivatives("x", 0.06),
        "x_dot",
    ),
}


@pytest.mark.parametrize("name", CHAIN)
def test_stated_noise_is_the_scatter_behind_the_chain(name):
    """Against the scatter over noisy copies: to 2 %, and white noise is not assumed twice."""
    clean, channel = CHAIN[name](wave(0.0))
    noisy = [CHAIN[name](wave(1e-3, seed))[0] for seed in range(12)]
    inside = slice(60, -60)  # the ends are noisier
    errors = [(one[channel] - clean[channel])[inside] for one in noisy]
    stated = np.mean([one.noise[channel].level for one in noisy])
    assert np.std(errors) == pytest.approx(stated, rel=0.05)


def test_noise_of_a_weighted_sum():
    noise = identification.Noise.white(2.0).through([0.5, 0.5])
    assert noise.level == pytest.approx(np.sqrt(2.0))
    # y0 + y1 of y = (x_i + x_{i+1})/2 is x0/2 + x1 + x2/2
    assert noise.of_sum([1.0, 1.0]) == pytest.approx(2.0 * np.sqrt(1.5))
    assert noise.of_sum([1.0, -1.0]) == pytest.approx(2.0 * np.sqrt(0.5))


# --- filters


def test_low_pass_shifts_no_phase_and_halves_at_its_cutoff():
    x = {f"{f}": np.sin(2 * np.pi * f * T) for f in (5, 25, 60)}
    record = analysis.MeasuredRecord(T, x, dict.fromkeys(x, 0.0))
    filtered = record.low_pass(25.0)
    gain = record.low_pass_gain([5, 25, 60], 25.0)
    assert gain[1] == pytest.approx(0.5)
    for name, expected in zip(x, gain, strict=True):
        inner = slice(1000, 3000)
        np.testing.assert_allclose(filtered[name][inner], expected * x[name][inner], atol=1e-6)


def test_low_pass_takes_little_of_round_peaks_and_the_more_the_faster_they_are():
    record = wave(1e-5)
    strong, weak = (identification.low_pass_on_peaks(record, "x", f) for f in (8.0, 25.0))
    lost = [np.abs(c.after / c.before - 1)[1:-1] for c in (strong, weak)]
    assert np.all(lost[1] < 5e-3)
    assert np.all(lost[0] > 2 * lost[1])
    faster = identification.low_pass_on_peaks(wave(1e-5, frequency=4.0), "x", 25.0)
    assert np.abs(faster.after / faster.before - 1)[1:-1].min() > lost[1].max()


def test_velocity_is_the_same_after_resampling():
    """Section 3.2.2: up, down, or as it is, within the noise, and within it of the truth."""
    sigma = 1e-4
    x = np.cos(6 * T)
    record = analysis.MeasuredRecord(
        T, {"x": x + np.random.default_rng(1).normal(0, sigma, len(T))}
    )
    found = record.velocities_by_resampling("x", 0.08, factors=(0.5, 1 / 3, 2.0))
    assert set(found.velocity) == {0.5, 1 / 3, 1.0, 2.0}
    assert found.noise / 4 < found.spread < 1.5 * found.noise
    inner = slice(50, -50)
    for velocity in found.velocity.values():
        error = (velocity + 6 * np.sin(6 * found.time))[inner]
        assert np.std(error) < 2 * found.noise
