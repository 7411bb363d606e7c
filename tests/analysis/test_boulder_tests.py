"""Tests of a boulder by others: the loader, on a folder of its form, and the settled scan."""

import dataclasses
import json

import numpy as np
import pytest

import rockeom as rk
from benchmarks import boulders
from rockeom.analysis.validation import BoulderTests
from rockeom.assessment.plane import planar_block
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
    path.write_text("\n".join([HEADING, LINES[0].replace(",1,0,1,", ",1,2,1,")]))
    with pytest.raises(ValueError, match=r"line 2: specimen_2 of test 7 is 2\. Remedy"):
        BoulderTests.from_folder(folder)
    path.write_text("\n".join([HEADING.replace("dem: 1 KN", "dem: 10 KN"), LINES[0]]))
    assert BoulderTests.from_folder(folder).of_others["specimen_1"] == {}
    np.savez(folder / "table_motions_200hz.npz", a007=np.zeros(3), d007=np.zeros(4))
    with pytest.raises(ValueError, match=r"a007 and d007 .* of \(3,\) and \(4,\)"):
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


def test_the_weakest_block_in_the_plane_of_a_box_is_across_its_narrow_base():
    feet = {"a": (0.5, 0.4), "b": (-0.1, 0.4), "c": (-0.1, -0.4), "d": (0.5, -0.4)}
    inertia = 500.0 / 12 * np.diag([0.8**2 + 0.5**2, 0.6**2 + 0.5**2, 0.6**2 + 0.8**2])
    boulder = rk.Boulder(feet=feet, mass=500.0, centroid=(0.1, 0.0, 0.25), inertia=inertia)
    block, _ = planar_block(boulder)
    expected = (0.3, 0.25, 0.1, 500.0 / 12 * (0.6**2 + 0.5**2))
    found = (block.half_width, block.half_height, abs(block.offset), block.inertia)
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    assert sorted(block.half_width + k * block.offset for k in (-1, 1)) == pytest.approx([0.2, 0.4])


def test_folds_are_predicted_by_the_others():
    """One draw is right on folds 1 and 2, the other on fold 0, which decides nothing of it."""
    folds, fell = np.repeat([0, 1, 2], 4), np.tile([True, True, False, False], 3)
    draws = np.array([fell ^ (folds == 0), fell ^ (folds != 0)])
    np.testing.assert_array_equal(
        boulders.chosen(draws, fell, folds)[folds == 0], ~fell[folds == 0]
    )
    found = boulders.weighed(draws, fell, folds)
    alone = np.where(fell, boulders.WRONG, 1.0 - boulders.WRONG)  # all weight on the first draw
    np.testing.assert_allclose(found[folds == 0], alone[folds == 0], atol=1e-9)
    of_others = 0.5 * np.ones(8)  # of folds 1 and 2: each draw is right on one of two other folds
    np.testing.assert_allclose(found[folds != 0], of_others, atol=1e-9)


def test_outcomes_are_stored_to_the_bit():
    outcomes = {"specimen_1": np.random.default_rng(1).random((3, 45)) < 0.4}
    again = boulders.unpacked({"space": boulders.packed(outcomes)}, 45)
    np.testing.assert_array_equal(again["space"]["specimen_1"], outcomes["specimen_1"])


def test_a_draw_that_has_a_twin_is_predicted_by_it(folder):
    """Two draws of each kind, of which one kind falls in every second test, the other never."""
    tests = dataclasses.replace(
        BoulderTests.from_folder(folder), tests=("1",) * 10, folds=np.repeat([0, 1], 5)
    )
    falls = np.arange(10) % 2 == 0
    draws = np.array([falls, falls, np.zeros(10, bool), np.zeros(10, bool)])
    outcomes = {way: dict.fromkeys(boulders.SPECIMENS, draws) for way in ("space", "plane")}
    lines = boulders.table_of_twins(tests, outcomes).splitlines()
    for way in ("space", "plane"):
        (row,) = (line for line in lines if f"{way}, draws weighed" in line)
        cells = [cell.strip() for cell in row.strip("| ").split("|")]
        assert cells[2:4] == ["2", "1.000"]
        assert float(cells[4]) == pytest.approx(boulders.WRONG**2, abs=1e-3)  # the twin's weight: 1


def test_draws_that_are_stored_are_not_simulated_again(folder, monkeypatch, tmp_path):
    asked = []

    def simulated(tests, treatment, way, draws):
        asked.append((treatment, way, *draws))
        return {name: np.full((1, len(tests.tests)), draws[0] == 1) for name in boulders.SPECIMENS}

    monkeypatch.setattr(boulders, "simulated", simulated)
    monkeypatch.setattr(boulders, "with_friction", lambda *_: (0, 2))
    monkeypatch.setattr(boulders, "STORED", tmp_path / "boulders.json")
    tests = BoulderTests.from_folder(folder)
    boulders.fit(tests, 2)
    assert asked[:2] == [("joined", "space", 0), ("joined", "space", 1)]
    asked.clear()
    boulders.fit(tests, 3)
    assert asked == [("joined", way, 2) for way in boulders.WAYS]
    stored = json.loads((tmp_path / "boulders.json").read_text())
    found = boulders.unpacked(stored["joined"], len(tests.tests))
    assert found["space"]["specimen_2"][:, 0].tolist() == [False, True, False]
    assert stored["priors"]["scan error [m]"] == list(boulders.SCAN_ERROR)
