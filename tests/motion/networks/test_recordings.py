"""Components belong together by the station, instrument and event of their headers."""

import pytest

import rockeom as rk
from rockeom.assessment.assess import by_recording
from tests.motion.networks.twins import TWINS
from tests.refusals import told

NORTH = {"HNE": "HNN"}
OTHERS = {
    "station": NORTH | {"ABC1": "ABC2"},
    "instrument": {"HNE": "HLN"},
    "event": NORTH | {"USER0: ": "EVENT_TIME_HHMMSS: 120000"},
    "place": NORTH | {"USER0: ": "LOCATION: 10"},
}
BOREHOLE = {f"{'Dir.':18s}4": f"{'Dir.':18s}2"}


def written(folder, files):
    """Files of twins by their names, with words replaced."""
    for name, (twin, words) in files.items():
        text = TWINS[twin]().text
        for old, new in words.items():
            assert old in text
            text = text.replace(old, new)
        (folder / name).write_text(text)
    return [folder / name for name in files]


@pytest.mark.filterwarnings("ignore:.*vertical components")
def test_components_of_a_station_are_one_recording_whatever_their_files_are_called(tmp_path):
    written(tmp_path, {"0111a.x": ("dyna", {}), "CHAN002.V2": ("dyna", NORTH)})
    (recording,) = rk.MotionSet.from_folder(tmp_path).scaled_to("pga", 1.0).recordings()
    assert [one.name for one in recording.horizontal] == ["0111a", "CHAN002"]
    block = rk.RigidBlock(half_width=0.15, half_height=0.75)
    answer = rk.assess(block, *written(tmp_path, {"C": ("cwb", {})}), pga=2.0)
    assert answer.conditions.recordings.tolist() == [0, 0]


@pytest.mark.parametrize("other", OTHERS)
def test_components_of_another_station_or_event_are_refused(tmp_path, other):
    paths = written(tmp_path, {"S-000": ("dyna", {}), "S-090": ("dyna", OTHERS[other])})
    assert "are of several recordings, XX.ABC1" in told(rk.Recording.read, *paths)
    assert len(rk.MotionSet.from_folder(tmp_path).recordings()) == 2
    assert len(by_recording(rk.MotionSet.from_folder(tmp_path))) == 2


def test_borehole_and_surface_are_two_stations(tmp_path):
    paths = written(tmp_path, {"A.NS2": ("kik_net", {}), "A.EW1": ("kik_net", BOREHOLE)})
    assert "ABC001 borehole" in told(rk.Recording.read, *paths)


def test_parallel_components_are_no_recording(tmp_path):
    paths = written(tmp_path, {"S-000": ("usc", {}), "S-090": ("usc", {"N08W": "N10W"})})
    assert "at no right angle" in told(rk.Recording.read, *paths)


def test_files_in_a_list_are_asked_for_one_after_the_other():
    assert "Recording.read(a, b)" in told(rk.Recording.read, ["a.NS", "a.EW"])


def test_two_stages_of_processing_count_once_or_not_at_all(tmp_path):
    written(tmp_path, {"A.V1": ("cesmd_v1", {}), "A.V2": ("cesmd_v2", {})})
    error = told(rk.MotionSet.from_folder, tmp_path)
    assert "A.V1 and A.V2 both give 360 Deg - roof of 11111 roof" in error
    assert 'pattern="*.V2"' in error
    (tmp_path / "A.V1").unlink()
    written(tmp_path, {"A.V1": ("cesmd_v1", {"90 Deg": "270 Deg", "   90": "  270"})})
    assert "several stages of processing" in told(rk.Recording.read, *tmp_path.iterdir())


def test_velocities_of_a_folder_are_named_and_left_out(tmp_path):
    velocity = {"DATA_TYPE: ACCELERATION": "DATA_TYPE: VELOCITY"}
    written(tmp_path, {"A.ACC.ASC": ("dyna", {}), "A.VEL.ASC": ("dyna", velocity)})
    with pytest.warns(UserWarning, match=r"no accelerations of a network or PEER: A\.VEL\.ASC"):
        assert rk.MotionSet.from_folder(tmp_path).names == ("A.ACC",)
    assert "A.VEL.ASC" in told(rk.MotionSet.from_folder, tmp_path, "*.VEL.*")
    (tmp_path / "A.ACC.ASC").unlink()
    assert "no accelerations of" in told(rk.MotionSet.from_folder, tmp_path)


def test_components_of_one_direction_are_chosen_by_number(tmp_path):
    (path,) = written(tmp_path, {"A": ("geonet_v2a", {"S62W": "N28W"})})
    error = told(rk.GroundMotion.read, path, component="n28w")
    assert "2 of its components" in error
    assert "component= as a number." in error
    assert rk.GroundMotion.read(path, component=2).name == "A, 2 N28W"


def test_files_of_one_stem_are_named_by_their_endings(tmp_path):
    written(tmp_path, {"A.s0a": ("usc", {}), "A.s0b": ("usc", {"N08W": "N82E"})})
    assert rk.MotionSet.from_folder(tmp_path).names == ("A.s0a", "A.s0b")
