"""`rockeom thesis statements`."""

from rockeom.cli import main


def test_statements_of_figures_come_with_what_was_found(capsys):
    assert main(["thesis", "statements", "2-22"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "2 to 3 times" in said
    assert "found: " in said
    assert "(differs)" in said


def test_figure_that_is_not_drawn_has_no_statements(capsys):
    assert main(["thesis", "statements", "4-54"]) == 2
    assert "'4-54'" in capsys.readouterr().err
