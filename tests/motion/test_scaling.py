"""Motions, sets and recordings scaled to an intensity, and multiplied by numbers."""

from dataclasses import replace

import numpy as np
import pytest

import rockeom as rk
from rockeom.motion.units import acceleration
from tests.refusals import refused, refuses, told

DT = 0.01
BLOCK = rk.RigidBlock(half_width=0.2, half_height=1.0)


def record(seed=0, name="quake", vertical=False, n=600):
    t = DT * np.arange(n)
    shape = np.random.default_rng(seed).standard_normal(n).cumsum() * np.exp(-((t - 3.0) ** 2))
    motion = rk.GroundMotion.from_array(shape - shape.mean(), DT, name=name)
    return replace(motion, is_vertical=vertical)


MOTION = record()
ACROSS = record(1, "across")
PAIR = rk.Recording("quake", (MOTION, ACROSS), record(2, "up", vertical=True))
FIRST = PAIR.in_plane()[0]


# --- values with their units


@pytest.mark.parametrize(
    ("text", "si"),
    [("0.4 g", 0.4 * 9.81), (".4g", 0.4 * 9.81), ("250 cm/s2", 2.5), ("3e2 gal", 3.0),
     ("2 m/s^2", 2.0), ("10 ft/sec/sec", 3.048)],
)  # fmt: skip
def test_acceleration_with_its_unit(text, si):
    assert acceleration("pga", text) == pytest.approx(si, rel=1e-15)
    assert MOTION.scaled_to(text).peak == pytest.approx(si)


@pytest.mark.parametrize(
    ("scaled_to", "said"),
    [
        ({}, 'no intensity: give exactly one, such as pga="0.4 g"'),
        ({"pga": 1.0, "sa": 2.0, "period": 1.0}, r"pga=1\.0 and sa=2\.0: give exactly one"),
        ({"sa": 2.0}, r"sa needs the period of its oscillator \[s\]: give period="),
        ({"pga": 2.0, "period": 1.0}, "pga has no period"),
        ({"sa": 2.0, "period": 0.0}, "period is 0: give a positive number"),
        ({"pga": -1.0}, "pga is -1: give a positive number"),
        ({"pga": "-0.4 g"}, "pga is -3.924.*: give a positive number"),
        ({"pga": "0.4"}, r"pga is '0\.4': give a number of m/s2, or a text with its unit"),
        ({"pga": "0,4 g"}, "a text with its unit"),
        ({"pga": "0.4 s"}, r"pga is '0\.4 s': units 's' are unknown: choose one of m/s2, g"),
        ({"pga": [1.0]}, r"pga is \[1\.0\]: give a number"),
        ({"pga": True}, "pga is True: give a number"),
    ],
)
def test_intensity_that_cannot_be_scaled_to_is_refused_alike(scaled_to, said):
    for given in (MOTION, PAIR, rk.MotionSet([MOTION])):
        with pytest.raises(rk.InputError, match=said):
            given.scaled_to(**scaled_to)


def test_peak_is_another_word_for_pga():
    assert MOTION.scaled_to(peak=2.0) == MOTION.scaled_to(2.0) == MOTION.scaled_to(pga=2.0)
    assert refused(MOTION.scaled_to, 1.0, pga=1.0) == ("pga", 1.0)


def test_motion_without_shaking_is_refused():
    still = rk.GroundMotion.none(1.0)
    for wanted in ({"pga": 1.0}, {"sa": 1.0, "period": 0.5}):
        assert "no factor makes" in told(still.scaled_to, **wanted)
        with pytest.raises(rk.InputError, match="no factor makes"):
            rk.Recording("still", (still,)).scaled_to(**wanted)


# --- one motion


@pytest.mark.parametrize("damping_ratio", [0.0, 0.05, 0.2])
def test_motion_has_the_spectral_acceleration_that_it_was_scaled_to(damping_ratio):
    scaled = MOTION.scaled_to(sa="0.3 g", period=0.7, damping_ratio=damping_ratio)
    found = scaled.response_spectrum(0.7, damping_ratio).pseudo_acceleration
    assert found == pytest.approx([0.3 * 9.81], rel=1e-12)


def test_pulse_is_scaled_to_a_spectral_acceleration_at_resonance():
    """Undamped, a sine of n cycles at resonance: u = pi n a / omega**2 at its end."""
    pulse = rk.GroundMotion.harmonic(1.0, period=0.5, duration=1.0)
    factor = pulse.scaled_to(sa=1.0, period=0.5, damping_ratio=0.0).peak
    assert factor == pytest.approx(1.0 / (2 * np.pi), rel=1e-9)


def test_multiplied_motion_has_its_factor_in_its_name():
    assert (2 * MOTION) == (MOTION * 2) == MOTION.scaled(2.0)
    assert (np.float64(2.0) * MOTION).name == "quake-A2-T1"
    assert (3 * MOTION / 4).name == "quake-A0.75-T1"
    assert (MOTION / 4).samples == pytest.approx(0.25 * MOTION.samples)


@pytest.mark.parametrize("given", [MOTION, PAIR])
def test_motion_is_multiplied_by_numbers_only(given):
    for wrong in (given, "2", None, np.array([1.0, 2.0]), True):
        with pytest.raises(TypeError, match=r"give a number, as in 2 \* motion"):
            given * wrong
    with refuses("factor", 0):
        given / 0


def test_factors_of_a_sweep_and_of_a_dual_go_through_the_operators():
    over = {"factor": np.linspace(1.0, 3.0, 12)}
    stronger = rk.simulate_many(lambda factor: rk.Case(BLOCK, factor * MOTION), over)
    by_method = rk.simulate_many(lambda factor: rk.Case(BLOCK, MOTION.scaled(factor)), over)
    assert np.array_equal(stronger.peak, by_method.peak)
    doubled = rk.Dual(2.0, [1.0]) * MOTION
    assert doubled.peak.tangent == pytest.approx([MOTION.peak])


def test_sweep_over_spectral_accelerations_is_that_of_single_runs():
    levels = [1.0, 2.0, 4.0]
    sweep = rk.simulate_many(
        lambda sa: rk.Case(BLOCK, MOTION.scaled_to(sa=sa, period=0.8)), {"sa": levels}
    )
    alone = [rk.simulate(BLOCK, MOTION.scaled_to(sa=sa, period=0.8)) for sa in levels]
    assert [len(run.impacts) for run in alone] == sweep.impacts.values.tolist()


# --- sets


def test_set_is_scaled_by_the_arguments_of_a_motion():
    motions = rk.MotionSet([MOTION, ACROSS])
    assert motions.scaled_to("0.4 g") == motions.scaled_to(pga="0.4 g")
    assert motions.scaled_to(pga="0.4 g") == motions.scaled_to("pga", "0.4 g")
    scaled = motions.scaled_to(sa=3.0, period=0.5, of="geometric mean")
    assert scaled == motions.scaled_to("sa", 3.0, period=0.5, of="geometric mean")
    sa = scaled.intensities("sa", period=0.5)
    assert sa[0] * sa[1] == pytest.approx(9.0)
    assert refused(motions.scaled_to, "pga", 3.0, sa=2.0, period=1.0) == ("intensity", "pga")
    assert refused(motions.scaled_to, "pga")[0] == "value"


def test_vertical_component_of_a_set_is_scaled_along_with_its_recording():
    names = ("ELC-180", "ELC-270", "ELC-UP", "KOB-000")
    motions = rk.MotionSet(
        record(i, name, vertical=name.endswith("UP")) for i, name in enumerate(names)
    )
    with pytest.raises(rk.InputError, match=r'ELC-UP is a vertical component.*of="recording"'):
        motions.scaled_to(pga=3.0)
    scaled = motions.scaled_to(pga=3.0, of="recording")
    factors = scaled.intensities("pga") / motions.intensities("pga")
    assert factors[:3] == pytest.approx([factors[0]] * 3)
    assert np.sqrt(scaled[0].peak * scaled[1].peak) == pytest.approx(3.0)
    assert scaled[3].peak == pytest.approx(3.0)
    median = motions.scaled_to(pga=3.0, of="median")
    assert np.median([median[i].peak for i in (0, 1, 3)]) == pytest.approx(3.0)
    up = rk.MotionSet([motions["ELC-UP"]]).scaled_to(pga=1.5)
    assert up[0].peak == pytest.approx(1.5)


# --- recordings


@pytest.mark.parametrize("wanted", [{"pga": 3.0}, {"sa": 3.0, "period": 0.5}])
@pytest.mark.parametrize("of", ["geometric mean", "larger", "srss", "rotd50", "rotd100"])
def test_components_of_a_recording_are_scaled_by_one_factor(wanted, of):
    scaled = PAIR.scaled_to(**wanted, of=of)
    motions = zip(
        (*scaled.horizontal, scaled.vertical), (*PAIR.horizontal, PAIR.vertical), strict=True
    )
    factors = [new.samples[300] / old.samples[300] for new, old in motions]
    assert factors == pytest.approx([factors[0]] * 3)
    if "sa" in wanted:
        found = scaled.response_spectrum(0.5, of=of).pseudo_acceleration
        assert found == pytest.approx([3.0])


def test_spectra_of_components_by_hand():
    one, other = (m.response_spectrum([0.5, 1.0]).displacement for m in PAIR.horizontal)
    found = {of: PAIR.response_spectrum([0.5, 1.0], of=of).displacement
             for of in ("geometric mean", "larger", "srss")}  # fmt: skip
    assert found["geometric mean"] == pytest.approx(np.sqrt(one * other))
    assert found["larger"] == pytest.approx(np.maximum(one, other))
    assert found["srss"] == pytest.approx(np.hypot(one, other))
    assert refused(PAIR.response_spectrum, [1.0], of="mean") == ("of", "mean")


@pytest.mark.parametrize("direction", [0, 30, 137])
def test_rotated_spectra_of_shaking_along_one_line_do_not_know_its_direction(direction):
    """Along a line at angle d a component at angle a has |cos(a - d)| of the shaking."""
    turn = np.radians(direction)
    pair = rk.Recording("line", (MOTION * np.cos(turn), MOTION * np.sin(turn)))
    along = MOTION.response_spectrum([0.4]).pseudo_acceleration
    largest = pair.response_spectrum([0.4], of="rotd100").pseudo_acceleration
    median = pair.response_spectrum([0.4], of="rotd50").pseudo_acceleration
    assert largest == pytest.approx(along)
    assert median / along == pytest.approx(np.cos(np.pi / 4), abs=0.01)


def test_recording_shakes_a_structure_with_its_vertical_component():
    first, second = (PAIR * 2.0).in_plane()
    for one, alone in ((first, MOTION), (second, ACROSS)):
        run = rk.simulate(BLOCK, one)
        by_hand = rk.simulate(BLOCK, alone.scaled(2.0), vertical=PAIR.vertical.scaled(2.0))
        assert np.array_equal(run.y, by_hand.y)
        assert run.vertical == by_hand.vertical
    assert rk.Case(BLOCK, first) == rk.Case(BLOCK, 2 * MOTION, vertical=2 * PAIR.vertical)
    assert first.in_plane() == (first,)


def test_incremental_analysis_of_recordings_scales_the_vertical_component_along():
    sweep = rk.simulate_many(
        lambda motion, pga: rk.Case(BLOCK, motion.scaled_to(pga)),
        {"motion": PAIR.in_plane(), "pga": [2.0, 4.0]},
    )
    assert sweep.motion.values.tolist() == ["quake", "across"]
    factor = 4.0 / ACROSS.peak
    alone = rk.simulate(BLOCK, factor * ACROSS, vertical=factor * PAIR.vertical)
    assert sweep.peak.sel(motion="across", pga=4.0, state="theta") == pytest.approx(
        alone.extremes("theta").peak
    )


def test_component_at_an_angle_keeps_the_vertical_one():
    turned = PAIR.along(np.pi / 2)
    assert turned.horizontal[0].samples == pytest.approx(ACROSS.samples)
    assert turned.vertical is PAIR.vertical


def test_component_that_is_a_little_shorter_gets_zeros_and_is_named():
    """The two of El Centro have 5372 and 5346 samples; the sum is that of arrays with zeros."""
    (pair,) = rk.MotionSet.from_library("El Centro 1940", components="all").recordings()
    one, other = pair.horizontal
    turned = pair.along(0.3).horizontal[0]
    zeros = np.append(other.samples, np.zeros(26))
    by_hand = np.cos(0.3) * one.samples + np.sin(0.3) * zeros
    np.testing.assert_allclose(turned.samples, by_hand, atol=1e-12)
    assert turned.name.endswith(f"to {other.name}, 26 zeros at its end")
    spectra = {of: pair.response_spectrum([0.5], of=of) for of in ("rotd50", "rotd100", "larger")}
    assert spectra["rotd50"].name == f"{pair.name}, rotd50, {other.name}, 26 zeros at its end"
    assert spectra["rotd100"].displacement[0] >= spectra["larger"].displacement[0]
    short = rk.Recording("x", (one, other.trimmed(0.0, 50.0)))
    assert "not recorded at the same times" in told(short.along, 0.3)


@pytest.mark.parametrize(
    ("make", "error", "said"),
    [
        (lambda: rk.Case(BLOCK, PAIR), TypeError, "two horizontal components.*in_plane"),
        (lambda: rk.simulate(BLOCK, FIRST, vertical=MOTION), TypeError, "leave it out"),
        (lambda: rk.Recording("none", ()), rk.InputError, "has 0 horizontal components"),
        (lambda: rk.Recording("x", ("a.at2",)), rk.InputError, r"'a\.at2': give ground motions"),
        (lambda: rk.Recording("x", MOTION).along(1.0), rk.InputError, "one horizontal component"),
    ],
)  # fmt: skip
def test_recording_that_leaves_open_what_shakes_is_refused(make, error, said):
    with pytest.raises(error, match=said):
        make()
