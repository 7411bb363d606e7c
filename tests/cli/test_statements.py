"""`rockeom thesis statements`."""

from rockeom.cli import main


def test_statements_of_a_figure_come_with_threshold_evidence_and_verdict(capsys):
    assert main(["thesis", "statements", "4-20"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "allows: at least 0.927 (the R2 that the text calls adequate)" in said
    assert "compared with: 4-16 (closed form) against Table A-1, tendon force (data)" in said
    assert said.endswith("holds 1, differs 0, open 1")


def test_figure_and_its_statements_come_from_one_list(capsys, tmp_path):
    main(["thesis", "statements", "4-20"])
    statements = capsys.readouterr().out.rpartition("\n\n")[0]
    main(["thesis", "figure", "4-20", "--out", str(tmp_path / "4-20.png")])
    assert capsys.readouterr().out.rstrip().endswith(statements.rstrip())


def test_figure_that_is_not_drawn_has_no_statements(capsys):
    assert main(["thesis", "statements", "4-54"]) == 2
    assert "'4-54'" in capsys.readouterr().err
