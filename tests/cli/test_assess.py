"""`rockeom assess`: will it overturn?"""

import numpy as np
import pytest

from rockeom.cli import main
from rockeom.sweeps import run as sweeps
from tests.interrupts import interrupted_at

BLOCK = ["rigid_block", "--set", "width=0.5", "height=2.0", "mass=400"]


@pytest.fixture
def record(tmp_path):
    path = tmp_path / "shaking.txt"
    t = 0.02 * np.arange(200)
    a = 4.0 * np.sin(9.0 * t) * np.exp(-0.5 * t)
    path.write_text("\n".join(f"{x:.3f} {y:.9e}" for x, y in zip(t, a, strict=True)))
    return ["--motion", str(path), "--units", "m/s2"]


def test_command_answers_in_words_and_writes_the_page(record, tmp_path, capsys):
    out = tmp_path / "rack.html"
    more = ["--pga", "0.4g", "6", "0.8 g", "--friction", "0.4", "--out", str(out)]
    assert main(["assess", *BLOCK, *record, *more]) == 0
    said = capsys.readouterr()
    assert said.out.startswith("Will it overturn? RigidBlock under 1 record\n")
    assert "a foot lifts from 0.25 g" in said.out
    assert "it rocks first" in said.out
    for pga in ("0.4 g", "0.612 g", "0.8 g"):
        assert f"PGA {pga}: " in said.out
    assert f"wrote {out}" in said.out
    assert "simulating 1 record ..." in said.err
    assert "Will it overturn?" in out.read_text(encoding="utf-8")


def test_without_friction_and_a_page_it_says_that_sliding_was_not_judged(record, capsys):
    assert main(["assess", *BLOCK, "centroid_height=0.8", *record]) == 0
    said = capsys.readouterr().out
    assert "Sliding: not judged" in said
    assert "a foot lifts from 0.312 g" in said
    assert "wrote" not in said


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--pga", "0.4 gee"], ["pga", "0.4 gee"]),
        (["--pga", "much"], ["pga", "much", "0.4 g"]),
        (["--friction", "-1"], ["friction", "-1"]),
        (["--level", "95"], ["level", "0.95"]),
        (["--impact", "soft"], ["--impact soft"]),
        (["--out", "page.docx"], ["page.docx", ".html"]),
        (["--out", "no/such/page.html"], ["no/such", "make it"]),
        (["--set", "width=0.5"], ["width is given twice"]),
    ],
)
def test_mistake_is_named_with_its_remedy(record, arguments, words, capsys):
    assert main(["assess", *BLOCK, *record, *arguments]) == 2
    said = capsys.readouterr().err
    assert all(word in said for word in words), said


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["rigid_block", "--set", "width=0.5"], ["no height", "width=0.6 height=2.0"]),
        (["rigid_block", "--set", "width=0.5", "height=2", "hight=1"], ["hight", "height"]),
        (["rigid_block", "--set", "width=wide", "height=2"], ["wide", "no number"]),
        (["rigid_block", "--set", "width=0.5", "height=-2"], ["height", "-2"]),
        (["rigid_blok", "--set", "width=0.5", "height=2"], ["rigid_block"]),
        (["nondimensional_block", "--set", "alpha=0.2"], ["assess", "RigidBlock"]),
    ],
)
def test_structure_that_cannot_be_is_named(record, given, words, capsys):
    assert main(["assess", *given, *record]) == 2
    said = capsys.readouterr().err
    assert all(word in said for word in words), said


def test_folder_without_records_is_named(tmp_path, capsys):
    for folder in (tmp_path, tmp_path / "none.AT2"):
        assert main(["assess", *BLOCK, "--motion", str(folder)]) == 2
        said = capsys.readouterr().err
        assert str(folder) in said
    assert main(["assess", *BLOCK, "--motion", str(tmp_path)]) == 2
    assert f"--motion {tmp_path}/*.txt --units g" in capsys.readouterr().err


def recording(tmp_path) -> list[str]:
    """Files of PEER of one recording: two horizontal components and a vertical one."""
    t = 0.02 * np.arange(150)
    for i, component in enumerate(("000", "090", "-UP")):
        a = (0.3, 0.25, 0.1)[i] * np.sin((9.0 + i) * t) * np.exp(-0.5 * t)
        head = f"PEER\nSome, 1/1/2000, A, {component}\nACCELERATION TIME SERIES IN UNITS OF G\n"
        text = f"{head}NPTS= {len(a)}, DT= .0200 SEC\n" + "\n".join(f"{x:.7E}" for x in a)
        (tmp_path / f"RSN1_SOME_A{component}.AT2").write_text(text)
    return ["--motion", str(tmp_path)]


@pytest.mark.filterwarnings("ignore:.*vertical components")
def test_components_of_one_recording_count_as_one(tmp_path, capsys):
    files = recording(tmp_path)
    assert main(["assess", *BLOCK, *files, "--pga", "0.3g"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "1 recording of 2 records" in said
    assert "no vertical shaking" in said
    assert main(["assess", *BLOCK, *files, "--pga", "0.3g", "--components", "all"]) == 0
    assert "Vertical shaking: that of 2 of 2 records" in " ".join(capsys.readouterr().out.split())


@pytest.mark.filterwarnings("ignore:.*vertical components")
def test_floors_are_those_of_the_components(tmp_path, capsys):
    out = tmp_path / "page.html"
    floor = ["--floor", "0.5", "0.17", "--floor-height", "0.8", "--out", str(out)]
    assert main(["assess", *BLOCK, *recording(tmp_path), "--pga", "0.3g", *floor]) == 0
    assert "1 recording of 2 records" in " ".join(capsys.readouterr().out.split())
    assert "RSN1_SOME_A090, floor at 0.8 of the height" in out.read_text(encoding="utf-8")


def test_lengths_in_mm_are_questioned_until_they_are_checked(record, capsys):
    large = ["rigid_block", "--set", "width=600", "height=1800", "mass=1"]
    assert main(["assess", *large, *record]) == 0
    said = capsys.readouterr().out
    assert said.index("Question: The structure measures 1800 m") < said.index("No verdict")
    assert "--units-checked" in said
    assert main(["assess", *large, *record, "--units-checked"]) == 0
    assert "No verdict" not in capsys.readouterr().out


def test_interrupt_ends_it_without_a_verdict(record, monkeypatch, capsys):
    monkeypatch.setattr(sweeps, "in_threads", interrupted_at(1, sweeps.in_threads))
    assert main(["assess", *BLOCK, *record]) == 130
    assert capsys.readouterr().out == ""
