"""Files of networks on the command line: components, vertical shaking, folders of mixed formats."""

import json

import pytest

from rockeom.cli import main
from tests.motion.networks.twins import TWINS

BLOCK = ["rigid_block", "--set", "width=0.3", "height=1.5", "mass=100"]


@pytest.fixture
def files(tmp_path):
    """Files of three formats: three components, three components, one."""
    for name in ("cwb", "afad", "knet"):
        (tmp_path / f"{name}.dat").write_text(TWINS[name]().text)
    (tmp_path / "notes.md").write_text("Records of three networks.\n")
    return tmp_path


def test_component_of_a_file_is_simulated_with_its_vertical_one(files, capsys):
    path, out = str(files / "cwb.dat"), files / "out"
    assert main(["simulate", *BLOCK, "--motion", path]) == 2
    assert "1 U, 2 N, 3 E. Remedy: choose one by --component" in capsys.readouterr().err
    chosen = ["--component", "90", "--vertical", path, "--out", str(out)]
    assert main(["simulate", *BLOCK, "--motion", path, *chosen]) == 0
    summary = json.loads((out / "summary.json").read_text())
    up, _, east = TWINS["cwb"]().directions
    assert summary["motion"]["peak"] == pytest.approx(abs(east.acceleration).max())
    assert summary["vertical"]["peak"] == pytest.approx(abs(up.acceleration).max())


def test_component_of_a_file_is_assessed(files, capsys):
    motion = ["--motion", str(files / "cwb.dat"), "--component", "E", "--pga", "0.3g"]
    assert main(["assess", *BLOCK, *motion]) == 0
    assert "under 1 record" in capsys.readouterr().out
    assert main(["assess", *BLOCK, *motion, "--components", "all"]) == 2
    assert "one of both says" in capsys.readouterr().err


def test_horizontal_record_as_the_vertical_one_is_asked_about(files, capsys):
    paths = ["--motion", str(files / "cwb.dat"), "--component", "E"]
    assert main(["simulate", *BLOCK, *paths, "--vertical", str(files / "knet.dat")]) == 0
    assert "vertical ground motion is a horizontal component" in capsys.readouterr().out


def test_vertical_component_of_a_file_without_one_is_refused(files, capsys):
    path = files / "horizontal.dat"
    text = TWINS["unam"]().text.replace("/V/", "/N45E/")
    path.write_text(text.replace("         V", "      N45E"))
    shaken = ["--motion", str(files / "knet.dat"), "--vertical", str(path)]
    assert main(["simulate", *BLOCK, *shaken]) == 2
    assert "0 of horizontal, N45E, horizontal, N90E" in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore:.*vertical components", "ignore:.*no records of a network")
@pytest.mark.parametrize("components", [(), ("--components", "all")], ids=["plane", "vertical"])
@pytest.mark.parametrize("given", ["folder", "files"])
def test_mixed_formats_are_assessed_by_recording(files, capsys, given, components):
    named = [files] if given == "folder" else sorted(files.glob("*.dat"))
    motions = ["--motion", *map(str, named), "--pga", "0.3g", *components]
    assert main(["assess", *BLOCK, *motions]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "3 recordings of 5 records" in said
    assert ("no vertical shaking" in said) == (not components)
    assert ("that of 4 of 5 records" in said) == bool(components)
