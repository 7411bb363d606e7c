"""Statements of the thesis: one rule judges them, and each verdict rests on a number."""

import re
import unicodedata

import numpy as np
import pytest

from rockeom import InputError
from rockeom.thesis import statements
from rockeom.thesis.figures import FIGURES
from rockeom.thesis.printed import TABLES
from rockeom.thesis.statements import STATEMENTS, Verdict
from rockeom.thesis.statements.statement import (
    Origin,
    Statement,
    evidence,
    finding,
    from_row,
    limits,
    ranging,
    unknown,
)
from tests import shared
from tests.thesis import pins


def judged(allows, number, lost=""):
    """A statement with these limits, of which this number was found."""

    class Known(Statement):
        def find(self):
            return number() if callable(number) else number

    return Known(
        "4.5", "", "a number", "", limits(allows), evidence("closed form: 4-16"), lost, "", ""
    ).judged()


# --- the rule


@pytest.mark.parametrize(
    ("allows", "number", "verdict"),
    [
        ("35.7", finding(35.73, ""), "holds"),
        ("35.7", finding(35.80, ""), "differs"),
        ("-0.50", finding(-0.504, ""), "holds"),
        ("160 +- 5", finding(164, ""), "holds"),
        ("160 +- 2 %", finding(164, ""), "differs"),
        ("-2.5, 1.7 +- 10 %", finding([-2.7, 1.6], ""), "holds"),
        ("0.31 +- 0.001, 0.01 +- 5e-4", finding([0.3105, 0.0106], ""), "differs"),
        ("<= 0.8", finding(0.72, ""), "holds"),
        (">= 11.1", finding(11.0, ""), "differs"),
        ("= 2", finding(2, ""), "holds"),
        ("2 to 3", ranging([2.1, 2.9], ""), "holds"),
        ("2 to 3", ranging([2.1, 4.3], ""), "open"),
        ("2 to 3", ranging([3.1, 4.3], ""), "differs"),
        ("1.0, 2.0", finding([1.0, 2.0], ""), "holds"),
        ("1.0, 2.0", finding([1.0, 3.0], ""), "differs"),
        ("2 to 3", finding([2.1, 2.2, 2.3], ""), "holds"),
        ("2 to 3", finding([2.1, 2.2, 3.3], ""), "differs"),
    ],
)
def test_number_within_the_limits_holds_and_a_range_across_one_is_open(allows, number, verdict):
    assert judged(allows, number).verdict.value == verdict


def test_lost_input_leaves_a_statement_open_with_what_can_be_said():
    one = judged("<= 1", finding(0.5, "0.5 mm"), lost="the trace is lost")
    assert one.verdict is Verdict.OPEN
    assert one.words == "the trace is lost; 0.5 mm"


def test_statement_without_a_number_is_refused_unless_an_input_is_lost():
    nothing = unknown("no force is printed")
    assert judged("<= 1", nothing, lost="lost").verdict is Verdict.OPEN
    with pytest.raises(ValueError, match="0 numbers for 1 printed"):
        judged("<= 1", nothing)


def test_missing_record_leaves_a_statement_open_and_says_what_to_install():
    def missing():
        raise InputError("words").says("the extra 'records' is not installed")

    one = judged("<= 1", missing)
    assert (one.verdict, one.words) == (Verdict.OPEN, "the extra 'records' is not installed")


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"evidence": "simulation: 4-42 | simulation: 4-27"}, "both sides are simulated"),
        ({"evidence": ""}, "'' is not a valid Origin"),
        ({"evidence": "data: a | data: b | data: c"}, "one or two pieces of evidence, not 3"),
        ({"limits": "about 5"}, "limits 'about 5': neither a number, a range nor a side"),
    ],
)
def test_row_that_cannot_be_judged_is_refused_with_its_place(changed, message):
    row = dict.fromkeys(("figure", "scan", "unit", "lost", "correction"), "")
    row |= {"place": "4.5", "quotation": "a number", "limits": "0.5", "why": "half a digit"}
    with pytest.raises(ValueError, match=f"^4.5, wall.drift: .*{re.escape(message)}"):
        from_row(row | {"evidence": "closed form: 4-16", "function": "wall.drift"} | changed)


def test_number_that_is_none_is_refused():
    with pytest.raises(ValueError, match="not a number"):
        finding(np.nan, "R2 of no rows")


# --- the list


@pytest.fixture(scope="module")
def judgements():
    return tuple(one.judged() for one in STATEMENTS)


def test_every_statement_is_the_reviewed_one():
    """`tests.thesis.pins` says how to review a change."""
    reviewed = [(row.function, row.digest) for row in pins.pinned()]
    assert [(one.function, pins.digest(one)) for one in STATEMENTS] == reviewed


def test_every_verdict_is_the_reviewed_one_and_rests_on_the_same_numbers(judgements):
    pinned = pins.pinned()
    for one, row in zip(judgements, pinned, strict=True):
        if one.finding is None:
            assert "is not installed" in one.words, row
            continue
        assert one.verdict.value == row.verdict, row
        simulated = Origin.SIMULATION in (side.origin for side in one.statement.evidence)
        ends = [list(map(float, pair.split(":"))) for pair in row.found.split()]
        np.testing.assert_allclose(
            [one.finding.low, one.finding.high],
            np.array([[pair[0], pair[-1]] for pair in ends]).reshape(-1, 2).T,
            rtol=0.02 if simulated else 1e-4,
            atol=1e-12,
            err_msg=str(row),
        )


def _folded(text):
    """Text as quotations are compared: NFKC, words joined at line ends, one blank, no markup."""
    text = unicodedata.normalize("NFKC", text).translate(
        str.maketrans("\u2019\u201c\u201d", '\'""')
    )
    text = re.sub(r"(\w)-\s*\n\s*(\w)", r"\1\2", text)
    return " ".join(re.sub(r"\*|</?i>", "", text).split())


LEFT_OUT = 500
"""Characters that "..." of a quotation may stand for: a paragraph, not a chapter."""


def _quoted(words, text):
    """Whether words stand in a text, in their order where "..." leaves some out."""
    pieces = (re.escape(_folded(piece)) for piece in words.split("..."))
    return re.search(f".{{0,{LEFT_OUT}}}?".join(pieces), text) is not None


def test_every_quotation_stands_in_the_thesis():
    """Or its garbled reading does, where the scan is garbled or has a formula in its notation."""
    text = _folded(shared.path("thesis.txt").read_text(encoding="utf-8"))
    quotations = [one.scan or one.words for one in STATEMENTS]
    cited = r"cells\.(?:caption|elsewhere)\([\d-]+; ([^;]+?)(?:; [^;]+)?\)$"
    quotations += [m[1] for one in STATEMENTS if (m := re.match(cited, one.function))]
    wrong = [words for words in quotations if not _quoted(words, text)]
    needless = [one.words for one in STATEMENTS if one.scan and _quoted(one.words, text)]
    assert (wrong, needless) == ([], [])


def test_quotations_are_compared_as_words():
    text = _folded("time-\nhistory of a\twall,\nwith \u2019n\u2019 = *10*")
    assert _quoted("timehistory of a wall", text)
    assert _quoted("history ... 'n' = 10", text)
    assert not _quoted("wall ... history", text)


def test_no_error_of_the_text_holds(judgements):
    slips = [one for one in judgements if one.statement.correction]
    assert {one.verdict for one in slips} == {Verdict.DIFFERS}


def test_every_statement_names_its_threshold_its_evidence_and_its_figure():
    for one in STATEMENTS:
        assert one.words, one.place
        assert one.limits.why, one.words
        assert all(side.name for side in one.evidence)
        assert one.figure in ("", *FIGURES), one.figure


def test_tables_that_statements_name_exist():
    for one in STATEMENTS:
        for name in (one.place, *(side.name for side in one.evidence)):
            if name.startswith("Table "):
                assert name.removeprefix("Table ").partition(",")[0] in TABLES, name


def test_simulation_in_kind_decides_nothing():
    """Its inputs are not those of the thesis: what it shows can be said, not judged."""
    for one in STATEMENTS:
        if any("in kind" in side.name for side in one.evidence):
            assert one.lost, one.words


def test_statements_are_selected_by_figure_section_and_table():
    assert {one.figure for one in statements.select("4-20")} == {"4-20"}
    assert statements.select("table 4-3") == statements.select("Table 4-3")
    assert set(statements.select("4.6")) == {
        one for one in STATEMENTS if one.place.partition(",")[0].startswith("4.6")
    }
    with pytest.raises(KeyError, match=r"no statement of '9\.9'"):
        statements.select("9.9")
