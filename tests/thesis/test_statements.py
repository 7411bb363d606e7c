"""Statements of the thesis: one rule judges them, and each verdict rests on a number."""

import importlib
from dataclasses import replace

import numpy as np
import pytest

from rockeom.motion import MotionError
from rockeom.thesis import statements
from rockeom.thesis.figures import FIGURES, Source
from rockeom.thesis.printed import TABLES
from rockeom.thesis.statements import STATEMENTS, Verdict
from rockeom.thesis.statements.statement import (
    Origin,
    Statement,
    at_least,
    at_most,
    between,
    closed_form,
    data,
    finding,
    near,
    ranging,
    simulation,
    unknown,
)


def statement(limits, number, **options):
    return Statement("4.5", "a number", limits, (closed_form("4-16"),), lambda: number, **options)


# --- the rule


@pytest.mark.parametrize(
    ("limits", "number", "verdict"),
    [
        (near(35.7, 0.05, why=""), finding(35.73, ""), "holds"),
        (near(35.7, 0.05, why=""), finding(35.80, ""), "differs"),
        (at_most(0.8, why=""), finding(0.72, ""), "holds"),
        (at_least(11.1, why=""), finding(11.0, ""), "differs"),
        (between(2.0, 3.0, why=""), ranging([2.1, 2.9], ""), "holds"),
        (between(2.0, 3.0, why=""), ranging([2.1, 4.3], ""), "open"),
        (between(2.0, 3.0, why=""), ranging([3.1, 4.3], ""), "differs"),
        (near([1.0, 2.0], 0.1, why=""), finding([1.0, 2.0], ""), "holds"),
        (near([1.0, 2.0], 0.1, why=""), finding([1.0, 3.0], ""), "differs"),
    ],
)
def test_number_within_the_limits_holds_and_a_range_across_one_is_open(limits, number, verdict):
    assert statement(limits, number).judged().verdict.value == verdict


def test_lost_input_leaves_a_statement_open_with_what_can_be_said():
    one = statement(at_most(1.0, why=""), finding(0.5, "0.5 mm"), lost="the trace is lost").judged()
    assert one.verdict is Verdict.OPEN
    assert one.words == "the trace is lost; 0.5 mm"


def test_statement_without_a_number_is_refused_unless_an_input_is_lost():
    nothing = unknown("no force is printed")
    assert statement(at_most(1.0, why=""), nothing, lost="lost").judged().verdict is Verdict.OPEN
    with pytest.raises(ValueError, match="0 numbers for 1 printed"):
        statement(at_most(1.0, why=""), nothing).judged()


def test_missing_record_leaves_a_statement_open_and_says_what_to_install():
    def missing():
        raise MotionError("the extra 'records' is not installed")

    one = replace(statement(at_most(1.0, why=""), None), find=missing).judged()
    assert (one.verdict, one.words) == (Verdict.OPEN, "the extra 'records' is not installed")


def test_two_simulated_sides_are_refused():
    with pytest.raises(ValueError, match="both sides are simulated"):
        Statement(
            "4.9.1.4", "adequately characterises the response", at_least(0.9, why="adequate"),
            (simulation("4-42 of a simulation"), simulation("4-27")), lambda: finding(0.99, ""),
        )  # fmt: skip


def test_comparison_without_evidence_is_refused():
    with pytest.raises(ValueError, match="one or two"):
        Statement("4.5", "a number", at_most(1.0, why=""), (), lambda: finding(0.5, ""))


def test_number_that_is_none_is_refused():
    with pytest.raises(ValueError, match="not a number"):
        finding(np.nan, "R2 of no rows")


# --- the list


@pytest.fixture(scope="module")
def judgements():
    return tuple(one.judged() for one in STATEMENTS)


def test_printed_number_changed_beyond_the_threshold_makes_holds_differ(judgements):
    """And back: with the limits at what was found, the others would hold."""
    decided = [one for one in judgements if one.verdict is not Verdict.OPEN]
    assert decided
    for one in decided:
        of, number = one.statement, one.finding
        if one.verdict is Verdict.HOLDS:
            limits, expected = of.limits.excluding(number), Verdict.DIFFERS
        else:
            limits = replace(of.limits, low=number.low, high=number.high)
            expected = Verdict.HOLDS
        changed = replace(of, limits=limits, find=lambda number=number: number)
        assert changed.judged().verdict is expected, of.words


def test_no_error_of_the_text_holds(judgements):
    slips = [one for one in judgements if one.statement.slip]
    assert [one.statement.words for one in slips if one.verdict is not Verdict.DIFFERS] == []


def test_counts_are_of_all_statements(judgements):
    assert sum(statements.counts(judgements).values()) == len(STATEMENTS)


def test_every_statement_names_its_threshold_its_evidence_and_its_function():
    functions = [one.function for one in STATEMENTS]
    assert len(set(functions)) == len(functions)
    for one in STATEMENTS:
        module, _, name = one.function.partition("(")[0].rpartition(".")
        assert callable(getattr(importlib.import_module(module), name)), one.function
        assert one.words, one.place
        assert one.limits.why, one.words
        assert all(evidence.name for evidence in one.evidence)
        assert one.figure in ("", *FIGURES), one.figure


def test_tables_that_statements_name_exist():
    for one in STATEMENTS:
        for name in (one.place, *(evidence.name for evidence in one.evidence)):
            if name.startswith("Table "):
                assert name.removeprefix("Table ").partition(",")[0] in TABLES, name


def test_figure_in_kind_decides_nothing_by_a_simulation():
    """Its inputs are not those of the thesis: what it shows can be said, not judged."""
    for one in STATEMENTS:
        simulated = Origin.SIMULATION in (evidence.origin for evidence in one.evidence)
        if one.figure and FIGURES[one.figure].source is Source.IN_KIND and simulated:
            assert one.lost, one.words


def test_statements_are_selected_by_figure_section_and_table():
    assert {one.figure for one in statements.select("4-20")} == {"4-20"}
    assert set(statements.select("4.6")) == {
        one for one in STATEMENTS if one.place.partition(",")[0].startswith("4.6")
    }
    with pytest.raises(KeyError, match=r"no statement of '9\.9'"):
        statements.select("9.9")


def test_measured_range_is_compared_by_its_ends():
    assert data("Table A-1").origin is Origin.DATA
    whole = ranging([3.0, 1.0, 2.0], "")
    assert (whole.low[0], whole.high[0]) == (1.0, 3.0)
