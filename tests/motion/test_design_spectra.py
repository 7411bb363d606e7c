"""Design spectra by hand, motions that have them, and the check of Eurocode 8 made to fail."""

import math
import pickle
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest

import rockeom as rk
from rockeom.motion import JenningsEnvelope
from rockeom.motion.design import matching
from rockeom.motion.spectra import largest_displacement, oscillator_history
from tests.refusals import refused, told

EUROCODE = rk.DesignSpectrum.eurocode_8("0.25 g", "B")
G = 9.81


def record(seed=0):
    """Noise as of a firm ground, 12 s of it."""
    envelope = JenningsEnvelope(rise=2.0, until=7.0, decay=0.6)
    made = rk.GroundMotion.clough_penzien(
        0.01, duration=12.0, seed=seed, envelope=envelope, dt=0.01
    )
    return replace(made, name="quake")


# --- spectra by hand


@pytest.mark.parametrize(
    ("ground", "spectrum_type", "s", "corners"),
    [
        ("A", 1, 1.0, (0.15, 0.4, 2.0)), ("B", 1, 1.2, (0.15, 0.5, 2.0)),
        ("C", 1, 1.15, (0.20, 0.6, 2.0)), ("D", 1, 1.35, (0.20, 0.8, 2.0)),
        ("E", 1, 1.4, (0.15, 0.5, 2.0)), ("A", 2, 1.0, (0.05, 0.25, 1.2)),
        ("b", 2, 1.35, (0.05, 0.25, 1.2)), ("C", 2, 1.5, (0.10, 0.25, 1.2)),
        ("D", 2, 1.8, (0.10, 0.30, 1.2)), ("E", 2, 1.6, (0.05, 0.25, 1.2)),
    ],
)  # fmt: skip
def test_eurocode_at_its_corners(ground, spectrum_type, s, corners):
    spectrum = rk.DesignSpectrum.eurocode_8(2.0, ground, spectrum_type)
    t_b, t_c, t_d = corners
    by_hand = [2 * s, 2 * s * 1.75, 5 * s, 5 * s, 5 * s * t_c / t_d, 5 * s * t_c * t_d / 16]
    assert spectrum([0.0, t_b / 2, t_b, t_c, t_d, 4.0]) == pytest.approx(by_hand)
    displacement = 5 * s * t_c * t_d / (4 * math.pi**2)
    assert spectrum.displacement([t_d, 4.0]) == pytest.approx([displacement] * 2)


@pytest.mark.parametrize(
    ("damping_ratio", "eta"), [(0.05, 1.0), (0.10, math.sqrt(10 / 15)), (0.30, 0.55)]
)
def test_eurocode_of_another_damping(damping_ratio, eta):
    spectrum = rk.DesignSpectrum.eurocode_8(1.0, "A", damping_ratio=damping_ratio)
    assert spectrum([0.0, 0.3]) == pytest.approx([1.0, 2.5 * eta])


def test_asce_7_at_its_corners():
    spectrum = rk.DesignSpectrum.asce_7("1.0 g", "0.6 g", 8.0)
    found = spectrum([0.0, 0.06, 0.12, 0.6, 1.0, 8.0, 16.0]) / G
    assert found == pytest.approx([0.4, 0.7, 1.0, 1.0, 0.6, 0.075, 0.6 * 8 / 256])


NZS_PERIODS = [0, 0.1, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5]
NZS_TABLE = {  # table 3.1, in hundredths
    "A": "100 235 235 189 160 140 124 112 103 95 70 53 42 35 26 20 16",
    "B": "100 235 235 189 160 140 124 112 103 95 70 53 42 35 26 20 16",
    "C": "133 293 293 236 200 174 155 141 129 119 88 66 53 44 32 25 20",
    "D": "112 300 300 300 300 284 253 229 209 193 143 107 86 71 52 40 32",
    "E": "112 300 300 300 300 300 300 300 300 300 221 166 133 111 81 62 49",
}


@pytest.mark.parametrize("site", NZS_TABLE)
def test_nzs_1170_5_has_the_shape_factors_of_its_table(site):
    spectrum = rk.DesignSpectrum.nzs_1170_5(0.4, 1.0, site.lower())
    table = np.array(NZS_TABLE[site].split(), dtype=float) / 100
    assert spectrum(NZS_PERIODS) / (0.4 * G) == pytest.approx(table, abs=5.1e-3)


def test_nzs_1170_5_is_its_formulas():
    t = [0.05, 0.2, 0.4, 1.5, 2.0, 5.0]
    by_hand = {
        "B": [1 + 13.5 * 0.05, 2.35, 1.6 * 1.25**0.75, 1.6 / 3**0.75, 1.05 / 2, 3.15 / 25],
        "C": [1.33 + 16 * 0.05, 2.93, 2 * 1.25**0.75, 2 / 3**0.75, 1.32 / 2, 3.96 / 25],
        "D": [1.12 + 18.8 * 0.05, 3.0, 3.0, 2.4 / 2**0.75, 2.14 / 2, 6.42 / 25],
    }
    for site, shape in by_hand.items():
        spectrum = rk.DesignSpectrum.nzs_1170_5(0.3, 1.3, site)
        assert spectrum(t) == pytest.approx(0.39 * G * np.array(shape), rel=1e-12)


@pytest.mark.parametrize(
    ("return_factor", "distance", "share"),
    [(1.0, 2e3, 1.0), (1.0, 0.0, 1.0), (1.0, 11e3, 0.5), (1.0, 20e3, 0.0), (0.75, 0.0, 0.0)],
)
def test_nzs_1170_5_near_a_fault(return_factor, distance, share):
    t = np.array([1.0, 2.0, 3.0, 4.5, 6.0])
    largest = [1.0, 0.24 * 2 + 0.64, 0.24 * 3 + 0.64, 0.12 * 4.5 + 1.12, 1.72]
    far = rk.DesignSpectrum.nzs_1170_5(0.4, return_factor, "C")
    near = rk.DesignSpectrum.nzs_1170_5(0.4, return_factor, "C", fault_distance=distance)
    expected = 1 + share * (np.array(largest) - 1)
    assert near(t) / far(t) == pytest.approx(expected, rel=1e-12)
    assert ("fault at" in near.name) == (share > 0)


def test_nzs_1170_5_limits_z_r_and_says_so():
    limited = rk.DesignSpectrum.nzs_1170_5(0.6, 1.8, "D")
    assert limited(0.3) == pytest.approx(0.7 * G * 3.0)
    assert "Z R 0.7 (limit)" in limited.name
    assert "limit" not in rk.DesignSpectrum.nzs_1170_5(0.7, 1.0, "D").name


def test_table_is_linear_between_its_points_and_defined_nowhere_else():
    spectrum = rk.DesignSpectrum.from_table([0.1, 0.5, 2.0], [0.4, 0.8, 0.2], units="g")
    found = spectrum([[0.1, 0.3], [0.5, 2.0]]) / G
    assert found == pytest.approx(np.array([[0.4, 0.6], [0.8, 0.2]]))
    for outside in (0.0, 2.1):
        with pytest.raises(rk.InputError, match=f"from 0.1 to 2 s, and not at {outside:g} s"):
            spectrum(outside)


def test_spectrum_of_a_function():
    spectrum = rk.DesignSpectrum("site", 0.05, 0.1, 2.0, shape=lambda t: 3.0 / t)
    assert spectrum([0.5, 1.0]) == pytest.approx([6.0, 3.0])
    with pytest.raises(AttributeError, match=r"did you mean .*eurocode_8"):
        rk.DesignSpectrum.eurocode8(2.0, "B")


def test_spectrum_is_compared_and_travels():
    for spectrum in (EUROCODE, rk.DesignSpectrum.nzs_1170_5(0.4, 1.0, "C")):
        assert pickle.loads(pickle.dumps(spectrum)) == spectrum
    assert rk.DesignSpectrum.eurocode_8("0.25 g", "C") != EUROCODE


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda s: s.eurocode_8(2.0, "F"), "ground_type is 'F': give one of A, B, C, D, E"),
        (lambda s: s.eurocode_8(2.0, "B", 3), "spectrum_type is 3: give 1 or 2"),
        (lambda s: s.eurocode_8("2.0", "B"), "a text with its unit"),
        (lambda s: s.eurocode_8(-2.0, "B"), "ground_acceleration is -2: give a positive"),
        (lambda s: s.eurocode_8(2.0, "B", damping_ratio=0.0), "damping_ratio is 0"),
        (lambda s: s.asce_7(9.0, 6.0, 0.5), r"t_l is 0\.5: give T_L, above s_d1/s_ds ="),
        (lambda s: s.nzs_1170_5(0.4, 1.0, "F"), "site_class is 'F': give one of A, B, C, D, E"),
        (lambda s: s.nzs_1170_5(0.4, 1.0, "A", fault_distance=-1), "fault_distance is -1"),
        (lambda s: s.from_table([0.1], [1.0]), "give two or more of each"),
        (lambda s: s.from_table([0.2, 0.1], [1.0, 1.0]), "periods do not rise"),
        (lambda s: s.from_table([0.1, 0.2], [1.0, 0.0]), "accelerations is an array of shape"),
        (lambda s: s.from_table([0.1, 0.2], [1.0, 2.0], units="m"), "units 'm' are unknown"),
    ],
)
def test_spectrum_that_cannot_be_is_refused(make, said):
    with pytest.raises(rk.InputError, match=said):
        make(rk.DesignSpectrum)


@pytest.mark.parametrize(
    "make",
    [
        lambda: rk.DesignSpectrum.eurocode_8(0.25, "B"),
        lambda: rk.DesignSpectrum.asce_7(0.25, 0.1, 8.0),
    ],
)
def test_acceleration_that_was_hardly_meant_in_m_s2_is_questioned(make):
    with pytest.warns(
        UserWarning, match=r'0\.25 m/s2, .*: was it meant in g\? Then write "0\.25 g"'
    ):
        make()


# --- motions that have one


@pytest.mark.parametrize("period", [0.03, 0.2, 1.7])
def test_largest_displacement_of_a_record(period):
    motion = record()
    time, value = largest_displacement(motion.samples, motion.dt, period, 0.05)
    (exact,) = motion.response_spectrum(period, 0.05).displacement
    assert abs(value) == pytest.approx(exact, rel=4e-3)
    history = oscillator_history(motion, period, 0.05)
    assert np.interp(time, history.time, history.displacement) == pytest.approx(value, rel=0.02)


@pytest.mark.parametrize("period", [0.1, 0.5, 2.0])
def test_wavelet_gives_one_oscillator_the_response_that_is_missing(period):
    """By the exact response to the wavelet alone, which has a peak at the time asked for."""
    t = 0.005 * np.arange(4000)
    target = matching.Target(np.array([period]), np.array([1.0]), 0.05)
    added = matching._adjustment(t, np.array([10.0]), np.array([0.7]), target)
    motion = rk.GroundMotion.from_array(added, 0.005)
    history = oscillator_history(motion, period, 0.05)
    response = (2 * np.pi / period) ** 2 * history.displacement
    assert np.interp(10.0, history.time, response) == pytest.approx(0.7, rel=0.01)
    beside = np.abs(history.time - 10.0) < 0.2 * period
    assert response[beside].max() == pytest.approx(0.7, rel=0.01)
    assert abs(motion.velocity(20.0)) < 0.02 * motion.peak_velocity


def test_noise_of_white_spectral_density():
    """S_a**2/r**2 = G (omega (pi/(4 xi) - 1) + omega - omega_0) is that of a constant density G."""
    periods, xi, density = np.geomspace(0.05, 2.0, 400), 0.05, 0.01
    omega = 2 * np.pi / periods
    variance = density * (omega * (np.pi / (4 * xi) - 1) + omega - omega[-1])
    target = matching.Target(periods, 3.0 * np.sqrt(variance), xi)
    made = matching.noise(target, 4000, 0.01, np.random.default_rng(3))
    assert made.std() == pytest.approx(np.sqrt(density * (omega[0] - omega[-1])), rel=0.05)


@pytest.mark.parametrize(
    "spectrum",
    [
        EUROCODE,
        rk.DesignSpectrum.asce_7("1.0 g", "0.6 g", 8.0),
        rk.DesignSpectrum.from_table(
            [0.05, 0.2, 0.6, 3.0], [3.0, 6.0, 6.0, 1.0], damping_ratio=0.1
        ),
    ],
)
def test_matched_record_has_the_spectrum(spectrum):
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        motion = spectrum.matched(record(), between=(0.1, 2.0))
    periods = np.geomspace(0.1, 2.0, 150)
    found = motion.response_spectrum(periods, spectrum.damping_ratio).pseudo_acceleration
    ratio = found / spectrum(periods)
    assert 0.85 < ratio.min() <= ratio.max() < 1.15
    assert abs(ratio.mean() - 1.0) < 0.02
    assert abs(motion.velocity(motion.duration)) < 1e-3 * motion.peak_velocity
    assert abs(motion.displacement(motion.duration)) < 0.01 * motion.peak_displacement
    farther = motion.peak_displacement > spectrum.displacement(periods).max()
    assert farther == any("the ground moves by" in str(one.message) for one in warned)
    check_differences_in_the_source(spectrum, motion, 0.1, 2.0)
    if spectrum.shortest == 0.0:
        assert motion.peak < 1.06 * spectrum(0.0)
    assert motion.name == "quake, matched"
    assert f"matched to {spectrum.name} within" in motion.source


def check_differences_in_the_source(spectrum, motion, first, last):
    """Those at the oscillators, and up to those between them, which are the largest of all."""
    said = re.search(r"within (\d+) % at (\d+) periods, (\d+) % between", motion.source)
    at, number, between = map(int, said.groups())
    xi = spectrum.damping_ratio
    own = matching.periods(first, last, xi)
    assert len(own) == number
    for periods, part in ((own, at), (np.geomspace(first, last, 700), between)):
        found = motion.response_spectrum(periods, xi).pseudo_acceleration / spectrum(periods)
        assert 100 * np.abs(found - 1.0).max() == pytest.approx(part, abs=1.0)


def test_artificial_motions_meet_eurocode_and_come_again_with_their_seed():
    motions = EUROCODE.compatible_motions(3, seed=4, duration=20.0, between=(0.1, 1.25))
    check = EUROCODE.check(motions, period=0.6)
    assert check.passed
    assert check.clauses == {"a": True, "b": True, "c": True}
    check_differences_in_the_source(EUROCODE, motions[0], 0.1, 1.25)  # after the factor of peaks
    one = EUROCODE.compatible_motions(1, seed=4, duration=20.0, between=(0.1, 1.25))[0]
    assert one.samples / one.peak == pytest.approx(motions[0].samples / motions[0].peak)
    assert np.corrcoef(motions[0].samples, motions[1].samples)[0, 1] < 0.2
    start, end = motions[0].significant_interval()
    assert 8.0 < end - start < 14.0


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda s: s.matched(rk.GroundMotion.single_sine(1.0, 0.5)), r"resampled\(dt\) gives it"),
        (lambda s: s.matched(record(), between=(0.01, 1.0)), r"too coarse.* between=\(0\.02, 1\)"),
        (lambda s: s.matched(record(), between=(0.1, 5.0)), "from 0 to 4 s, and not at 5 s"),
        (lambda s: s.matched(record(), between=(1.0, 0.1)), "between is 1: give less than"),
        (lambda s: s.matched(record(), between=0.1), r"between is 0\.1: give a shorter and a"),
        (lambda s: s.matched("quake"), "record is 'quake': give a GroundMotion"),
        (
            lambda s: s.matched(rk.GroundMotion.from_array(np.zeros(99), 0.01)),
            "record is 'array': give a",
        ),
        (lambda s: s.compatible_motions(0, seed=1), "number is 0"),
        (lambda s: s.compatible_motions(1, seed=-1), "seed is -1"),
        (lambda s: s.compatible_motions(1, seed=1, envelope=3.0), "give a function of times"),
    ],
)
def test_motion_that_cannot_be_matched_is_refused(call, said):
    with pytest.raises(rk.InputError, match=said):
        call(EUROCODE)


def test_record_that_does_not_come_near_the_spectrum_is_refused():
    """Half a second has no response at 4 s of which a wavelet could make the largest."""
    short = rk.GroundMotion.from_array(np.sin(np.linspace(0.0, 12.0, 50)), 0.01)
    assert "after matching: give another record" in told(EUROCODE.matched, short)


# --- the check


def own_spectrum(motion, raised=1.0, at=0.3):
    """The spectrum of a motion, at the periods of a check for 0.5 s, raised about one of them."""
    periods = np.append(0.0, np.geomspace(0.1, 1.0, 100))
    values = np.append(motion.peak, motion.response_spectrum(periods[1:]).pseudo_acceleration)
    values[np.abs(periods - at) < 0.02] *= raised
    return rk.DesignSpectrum.from_table(periods, values)


@pytest.mark.parametrize(("raised", "passed"), [(1.0, True), (1.09, True), (1.13, False)])
def test_clause_c_of_the_check(raised, passed):
    motion = record(3)
    check = own_spectrum(motion, raised).check([motion] * 3, period=0.5)
    assert check.clauses == {"a": True, "b": True, "c": passed}
    assert check.ratio.min() == pytest.approx(1.0 / raised, abs=2e-3)
    assert ("3.2.3.1.2(4): met" in str(check)) is passed
    if not passed:
        assert "(c) no   mean spectrum at least 88 % of the target, at 0." in str(check)


def test_clauses_a_and_b_of_the_check():
    motion = record(3)
    spectrum = own_spectrum(motion)
    assert spectrum.check([motion, motion], 0.5).clauses == {"a": False, "b": True, "c": True}
    weaker = [0.98 * motion, 0.99 * motion, 1.02 * motion]
    assert spectrum.check(weaker, 0.5).clauses == {"a": True, "b": False, "c": True}


def test_check_that_has_no_answer_is_refused():
    motion = record()
    with pytest.raises(rk.InputError, match="spectra for 5 %"):
        rk.DesignSpectrum.eurocode_8(2.0, "A", damping_ratio=0.1).check([motion], 0.5)
    assert "not at 5 s" in told(EUROCODE.check, [motion] * 3, 2.5)
    assert "give three or more" in told(EUROCODE.check, [], 0.5)
    assert refused(EUROCODE.check, ["quake"], 0.5) == ("motions", "quake")
    assert refused(EUROCODE.check, motion, 0.5)[0] == "motions"
    assert refused(EUROCODE.check, [replace(motion, is_vertical=True)], 0.5) == ("motions", "quake")
