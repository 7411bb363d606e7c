"""The table beside OpenSees, Exudyn and MuJoCo, as far as it can be made without them."""

import math
from pathlib import Path

import numpy as np
import pytest

from benchmarks import crosscheck

PAGE = Path(__file__).resolve().parents[2] / "docs" / "verification.md"


def test_first_impact_is_that_of_the_quadrature():
    assert abs(crosscheck.first_impact_of_ours() - crosscheck.first_impact_exactly()) < 1e-12


def test_quadrature_is_that_of_a_slender_block_for_a_small_release(monkeypatch):
    """Where all angles are small, cosh(p t) = alpha/(alpha - theta_0)."""
    block = crosscheck.rk.RigidBlock(half_width=0.001, half_height=1.0)
    monkeypatch.setattr(crosscheck, "BLOCK", block)
    monkeypatch.setattr(crosscheck, "RELEASE", 0.0005)
    p = math.sqrt(0.75 * 9.81 / math.hypot(0.001, 1.0))
    expected = math.acosh(block.alpha / (block.alpha - 0.0005)) / p
    assert crosscheck.first_impact_exactly() == pytest.approx(expected, rel=1e-6)


def test_crossing_of_a_cubic_is_exact():
    def theta(t):
        return (0.37 - t) * (t + 1.0) * (t + 2.0)

    t = np.arange(0.0, 0.7, 0.1)
    rate = (theta(t + 1e-6) - theta(t - 1e-6)) / 2e-6
    assert crosscheck.crossing(t, theta(t), rate) == pytest.approx(0.37, abs=1e-9)


def test_program_that_is_missing_has_a_row_and_a_remedy(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(crosscheck, "missing", lambda way: True)
    page = tmp_path / "page.md"
    page.write_text(f"a\n{crosscheck.START}\nold\n{crosscheck.END}\nb\n", encoding="utf-8")
    crosscheck.main(["--out", str(tmp_path / "out"), "--write", str(page)])
    said = capsys.readouterr().out
    for program in ("OpenSees", "Exudyn", "MuJoCo"):
        assert f"{program} is not installed: pip install" in said
    assert said.count("| not installed ") == len(crosscheck.WAYS)
    text = page.read_text(encoding="utf-8")
    assert text.startswith("a\n")
    assert text.endswith("\nb\n")
    assert "old" not in text
    assert (tmp_path / "out" / "crosscheck.md").read_text(encoding="utf-8").strip() in text


def test_program_that_fails_has_a_row_and_the_others_go_on(capsys):
    def fails(step):
        raise RuntimeError("lacks a library")

    def halves(step):
        return 1.0 + step**2

    ways = [
        crosscheck.Way("m", who, ("math", ""), (0.1, 0.01), run)
        for who, run in (("A", fails), ("B", halves))
    ]
    rows = [row for way in ways for row in crosscheck.rows_of(way, 1.0)]
    assert [row[3] for row in rows] == ["failed", "failed", "1.0e-02", "1.0e-04"]
    assert rows[-1][4] == "2.0"
    assert "A: lacks a library" in capsys.readouterr().err


def test_page_without_marks_is_refused():
    with pytest.raises(ValueError, match="between which the table stands"):
        crosscheck.written("", "no marks")


def test_page_of_verification_holds_the_table():
    text = PAGE.read_text(encoding="utf-8")
    start, end = text.index(crosscheck.START), text.index(crosscheck.END)
    lines = [line for line in text[start:end].splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert cells[0] == list(crosscheck.HEAD)
    assert {(row[0], row[1]) for row in cells[2:]} == {
        (crosscheck.FREE, "rockeom"),
        *((way.motion, way.program) for way in crosscheck.WAYS),
    }
