"""`rockeom thesis equations` and `rockeom thesis verify`."""

from dataclasses import replace

import pytest

from rockeom.cli import main
from rockeom.thesis import EQUATIONS, verification
from rockeom.thesis.equation import says


def output(capsys, *arguments: str) -> str:
    assert main(list(arguments)) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("number", ["2-9", "5-11", "D-23"])
def test_an_erratum_is_shown_as_printed_as_it_should_be_and_why(number, capsys):
    text = output(capsys, "thesis", "equations", number)
    before, after = text.index("As printed:"), text.index("As it should be:")
    assert before < after
    assert "wrong as printed" in text
    assert EQUATIONS[number].reason.split()[0] in text
    assert "the printed form fails" in text
    assert "Lagrange" in text


def test_right_equation_is_shown_once(capsys):
    text = output(capsys, "thesis", "equations", "2-6")
    assert "As it should be" not in text
    assert "right as printed" in text
    assert "r = [1 - m R² [1 - cos(2 α)]/I_o]²" in text


def test_lost_equation_says_that_it_is_not_legible(capsys):
    text = output(capsys, "thesis", "equations", "D-19")
    assert "As printed" not in text
    assert "not legible, restored" in text


@pytest.mark.parametrize("number", EQUATIONS)
def test_every_equation_can_be_read_in_a_terminal(number):
    from rockeom.symbolic.text.plain import mathematics

    for line in EQUATIONS[number].lines():
        text = mathematics(line)
        assert "\\" not in text
        assert "begin" not in text
        assert text.count("(") == text.count(")")


def test_list_is_filtered(capsys):
    text = output(capsys, "thesis", "equations", "--chapter", "d", "--verdict", "wrong")
    numbers = [line.split()[0] for line in text.splitlines() if line.startswith(("D-", "5-"))]
    wrong = [e.number for e in EQUATIONS.values() if e.chapter == "D" and e.is_erratum]
    assert numbers == wrong


def test_latex_is_a_numbered_equation(capsys):
    text = output(capsys, "thesis", "equations", "2-9", "5-30", "--latex")
    assert text.count(r"\begin{equation}") == text.count(r"\end{equation}") == 2
    assert r"\tag{2-9}" in text
    assert r"\mp" in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["9-1"], "chapters are 2, 3, 4, 5, B, D"),
        (["5-99"], "5-1 to 5-37"),
        (["--chapter", "8"], "--chapter 8: there are 2, 3, 4, 5, B, D"),
        (["--kind", "poem"], "closed form"),
        (["2-9", "--chapter", "2"], "do not go together"),
        (["--chapter", "D", "--kind", "fit"], "leave one of the filters out"),
    ],
)
def test_what_is_not_there_is_told(arguments, message, capsys):
    assert main(["thesis", "equations", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_verify_prints_a_row_for_each_and_the_counts(capsys):
    text = output(capsys, "thesis", "verify", "2-9", "2-6", "5-9")
    assert [line.split()[0] for line in text.splitlines()[:3]] == ["2-9", "2-6", "5-9"]
    for count in ("1  right as printed", "1  wrong as printed", "1  not legible, restored"):
        assert count in text
    assert "0  failed" in text
    assert "0  not checked" in text


def test_failed_check_is_named_and_the_exit_code_is_1(monkeypatch, capsys):
    (relation,) = EQUATIONS["2-6"].printed
    wrong = replace(EQUATIONS["2-6"], printed=says(relation.lhs, 2 * relation.rhs))
    monkeypatch.setattr(verification, "equation", lambda number: wrong)
    assert main(["thesis", "verify", "2-6", "--failures"]) == 1
    text = capsys.readouterr().out
    assert "2-6    failed" in text
    assert "thesis minus engine" in text
    assert "1  failed" in text
