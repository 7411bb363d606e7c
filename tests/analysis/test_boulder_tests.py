"""Tests of a boulder by others: the loader, on a folder of its form, and the settled scan."""

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis.validation import BoulderTests
from rockeom.structures.positions import box
from tests.space.test_meshes import triangles, written

T = np.arange(4001) / 200.0
HEADING = "test,specimen_1,specimen_2,dem: 1 KN=1 KS=1,dem: 2 KN=3 KS=1,record,fold,motion"
LINES = ["7,1,0,1,0,RSN1,0,ok", "8,0,0,0,1,RSN1,0,absent", "12,0,1,0,1,'RSN2',3,ok"]


def swung(f: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [m] and acceleration [m/s2] of 5 mm at a frequency [Hz], smoothly begun."""
    window = np.where(np.abs(T - 10.0) < 8.0, np.cos(np.pi * (T - 10.0) / 16.0) ** 4, 0.0)
    x = 0.005 * window * np.sin(2 * np.pi * f * T)
    return x, np.gradient(np.gradient(x, T), T)


@pytest.fixture
def folder(tmp_path):
    """The accelerometer lost the slow motion of test 7, the displacement the fast one of 12."""
    body = box(0.6, 0.8, 0.5)
    for name in ("SP1.ply", "SP2.ply"):
        written(tmp_path / name, body.vertices, triangles(body))
    (tmp_path / "tests.csv").write_text("\n".join([HEADING, *LINES]))
    slow, fast, none = swung(0.5), swung(6.0), np.zeros_like(T)
    arrays = {"a007": none, "d007": slow[0], "a012": fast[1], "d012": none}
    scale = {"a": 1 / 9.80665, "d": -1e3}  # g, and mm of the opposite sign
    np.savez(
        tmp_path / "table_motions_200hz.npz",
        **{name: scale[name[0]] * values for name, values in arrays.items()},
    )
    return tmp_path


def test_tests_without_a_motion_are_left_out(folder):
    tests = BoulderTests.from_folder(folder)
    assert tests.tests == ("7", "12")
    assert tests.records == ("RSN1", "'RSN2'")
    assert tests.folds.tolist() == [0, 3]
    assert tests.overturned["specimen_1"].tolist() == [True, False]
    assert tests.overturned["specimen_2"].tolist() == [False, True]
    of_others = {name: list(models) for name, models in tests.of_others.items()}
    assert of_others == {"specimen_1": ["dem: 1 KN=1 KS=1"], "specimen_2": ["dem: 2 KN=3 KS=1"]}


@pytest.mark.parametrize(("test", "f"), [(0, 0.5), (1, 6.0)])
def test_slow_motion_is_of_the_displacement_and_fast_motion_of_the_accelerometer(folder, test, f):
    tests, expected = BoulderTests.from_folder(folder), swung(f)[1]
    joined = tests.motion(test).acceleration(T)
    np.testing.assert_allclose(joined, expected, atol=0.02 * np.abs(expected).max())
    lost = tests.motion(test, ("acceleration", "displacement")[test]).acceleration(T)
    assert np.abs(lost).max() < 0.02 * np.abs(expected).max()


def test_what_lacks_is_named(folder):
    tests = BoulderTests.from_folder(folder)
    with pytest.raises(ValueError, match="treatment"):
        tests.motion(0, "both")
    path = folder / "tests.csv"
    path.write_text(path.read_text().replace("fold", "part"))
    with pytest.raises(ValueError, match=r"tests\.csv.*'fold'"):
        BoulderTests.from_folder(folder)
    path.write_text("\n".join([HEADING, LINES[0].replace("7,", "9,", 1)]))
    with pytest.raises(ValueError, match="no array a009"):
        BoulderTests.from_folder(folder)
    (folder / "SP2.ply").unlink()
    with pytest.raises(FileNotFoundError, match=r"SP2\.ply"):
        BoulderTests.from_folder(folder)


def test_a_box_that_was_scanned_askew_settles_onto_its_base(tmp_path):
    body = box(0.6, 0.8, 0.5)
    turn = np.array(
        [[1.0, 0.0, 0.0], [0.0, np.cos(0.03), -np.sin(0.03)], [0.0, np.sin(0.03), np.cos(0.03)]]
    )
    path = written(tmp_path / "askew.obj", body.vertices @ turn.T, triangles(body))
    with pytest.raises(ValueError, match="bearing_height"):
        rk.Boulder.from_mesh(path, mass=500.0, bearing_height=0.001)
    boulder = rk.Boulder.from_mesh(path, mass=500.0, bearing_height=0.001, settle=True)
    assert len(boulder.feet) == 4
    assert boulder.centroid[2] == pytest.approx(0.25, abs=1e-12)
    moments = 500.0 / 12 * np.array([0.8**2 + 0.5**2, 0.6**2 + 0.5**2, 0.6**2 + 0.8**2])
    np.testing.assert_allclose(boulder.inertia, np.diag(moments), atol=1e-9)
