"""`rockeom thesis tables`."""

import pytest

from rockeom.cli import main
from rockeom.thesis.tables import TABLES


def test_list_names_each_table_and_what_it_holds(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["thesis", "tables"]) == 0
    lines = capsys.readouterr().out.splitlines()
    for number, table in TABLES.items():
        (line,) = (line for line in lines if line.startswith(f"{number}  "))
        assert table.title in line
    assert f"{len(TABLES)} tables" in lines[-1]


def test_table_is_shown_printed_beside_computed_in_columns(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    assert main(["thesis", "tables", "2-1"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("Table 2-1: Apparent coefficients")
    lines = text.splitlines()
    (aluminium,) = (line.split() for line in lines if line.split()[:1] == ["762"])
    assert aluminium[-3:] == ["0.856", "0.888", f"{(1 - 1.5 / 26) ** 2:.4f}"]  # H/B = 5
    rule = next(i for i, line in enumerate(lines) if set(line) == {"-", " "})
    assert lines[rule - 1].split()[-2:] == ["printed", "computed"]
    assert "- r is the ratio of kinetic energies, 2-4;" in text
    assert max(map(len, lines)) <= 100


def test_several_are_shown_in_the_order_asked_for(capsys):
    assert main(["thesis", "tables", "3-1", "2-3"]) == 0
    text = capsys.readouterr().out
    assert 0 == text.index("Table 3-1:") < text.index("Table 2-3:")
    assert "237.5" in text  # computed, beside the printed
    assert "337.5" in text


def test_table_a_1_brings_the_peaks_of_the_models(capsys):
    assert main(["thesis", "tables", "A-1"]) == 0
    said = capsys.readouterr()
    assert "computing" in said.err
    lines = said.out.splitlines()
    (best,) = (line for line in lines if line.startswith("2  ControlledWallOscillator"))
    assert "r = 0.88, F_k + 6 %" in best
    assert best.split()[-2:] == ["5.34", "1.13"]
    start = next(i for i, line in enumerate(lines) if line.startswith("Displacements at the peaks"))
    numbers = [line.split() for line in lines[start:] if line.strip()[:1] in "-0123456789"]
    peaks = [row for row in numbers if len(row) == 10 and "." in row[0]]
    assert len(peaks) == 13
    assert peaks[0] == ["-30.41"] * 10


@pytest.mark.parametrize("arguments", [["2-6"], ["2-1", "2.3"]])
def test_what_is_no_table_is_told_and_nothing_shown(arguments, capsys):
    assert main(["thesis", "tables", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert repr(arguments[-1]) in said.err
    assert "Figure 3-3" in said.err
