"""Every equation of the thesis is decided by its checks.

Where the thesis is wrong, what is printed differs from what is derived, and by the stated excess.
"""

from dataclasses import replace

import pytest
import sympy as sp

from rockeom.thesis import (
    CHECKS,
    EQUATIONS,
    Verdict,
    decide,
    entry,
    equation,
    notation as th,
    verification,
)
from rockeom.thesis.checks import Means
from rockeom.thesis.equation import Kind, says
from tests.refusals import refused, refuses

from .wrong import slips


@pytest.mark.parametrize("number", EQUATIONS)
def test_equation_is_decided(number):
    decision = decide(number)
    assert decision.verdict.passes, decision.why
    assert decision.findings


def test_every_symbol_has_its_entry():
    for number, one in EQUATIONS.items():
        for symbol in one.symbols:
            found = entry(symbol, one.chapter)
            assert found.unit, (number, symbol)
            assert found.meaning, (number, symbol)


WRONG = [n for n, one in EQUATIONS.items() if one.is_erratum]


@pytest.mark.parametrize("number", WRONG)
def test_slip_in_a_printed_form_that_is_wrong_is_noticed(number):
    """It is wrong by its excess and by nothing else: also if its numbers are quoted wrongly."""
    one = EQUATIONS[number]
    tried = [s for s in slips(one.printed, everything=False) if s[1] != one.corrected]
    assert tried
    for words, printed in tried:
        quoted = replace(one, printed=printed)
        assert not all(f.holds for f in verification._excess(quoted)), words


def test_slip_in_a_printed_form_fails_the_verification(monkeypatch):
    one = EQUATIONS["2-9"]
    (relation,) = one.printed
    printed = says(relation.lhs * 2, 0)
    monkeypatch.setattr(verification, "equation", lambda number: replace(one, printed=printed))
    decision = decide("2-9")
    assert decision.verdict is Verdict.FAILED
    assert "printed minus right form minus the excess" in decision.why


@pytest.mark.parametrize("number", ["3-14", "4-1"])
def test_domain_of_a_printed_form_is_neither_too_wide_nor_too_narrow(number):
    one = EQUATIONS[number]
    assert decide(number).verdict is Verdict.LIMITED
    inside, outside = one.domain.inside, one.domain.outside
    for wrong in (replace(one.domain, inside=outside), replace(one.domain, outside=inside)):
        findings = verification._excess(replace(one, domain=wrong))
        assert not all(f.holds for f in findings)


# --- the framework itself


def test_printed_form_that_passes_its_checks_is_not_an_erratum(monkeypatch):
    """Nothing may be called wrong that no check finds wrong."""
    one = EQUATIONS["2-6"]
    (relation,) = one.printed
    same = says(relation.lhs, sp.expand(relation.rhs))
    harmless = replace(one, corrected=same, reason="the same, expanded", excess=(0,))
    monkeypatch.setattr(verification, "equation", lambda number: harmless)
    assert decide("2-6").verdict is Verdict.FAILED


def test_wrong_correction_is_noticed(monkeypatch):
    one = EQUATIONS["2-9"]
    (relation,) = one.corrected
    wrong = replace(one, corrected=says(relation.lhs + th.I_o, 0))
    monkeypatch.setattr(verification, "equation", lambda number: wrong)
    decision = decide("2-9")
    assert decision.verdict is Verdict.FAILED
    assert "I_b" in decision.why or "theta" in decision.why


def test_form_that_cannot_be_compared_fails_and_does_not_hide_the_others(monkeypatch):
    """Nor is a printed form proved wrong by a check that breaks."""
    one = EQUATIONS["2-9"]
    foreign = says(one.printed[0].lhs * sp.Symbol("z"), 0)
    for broken in (replace(one, corrected=foreign), replace(one, printed=foreign)):
        monkeypatch.setattr(verification, "equation", lambda number, broken=broken: broken)
        decision = decide("2-9")
        assert decision.verdict is Verdict.FAILED
        assert "not translated: ['z']" in decision.why


def test_equation_without_check_does_not_pass(monkeypatch):
    monkeypatch.setitem(CHECKS, "2-6", ())
    assert decide("2-6").verdict is Verdict.UNCHECKED
    monkeypatch.setitem(CHECKS, "3-17", (replace(CHECKS["3-17"][0], means=Means.TRANSCRIBED),))
    assert decide("3-17").verdict is Verdict.UNCHECKED, "numbers typed twice are no evidence"
    assert not verification.verify(["2-6", "2-9"]).passes


def test_order_is_that_of_the_thesis():
    def place(number: str) -> tuple[str, int, str]:
        chapter, _, rest = number.partition("-")
        digits = rest.rstrip("abcd")
        return chapter, int(digits), rest[len(digits) :]

    assert sorted(EQUATIONS, key=place) == list(EQUATIONS)


def test_number_that_is_not_there_is_told_with_those_that_are():
    assert refused(equation, "5-99") == ("number", "5-99")
    assert refused(equation, "7-1") == ("number", "7-1")


@pytest.mark.parametrize("written", ["D-23", "d-23", " D-23 ", "2-8A"])
def test_number_is_found_as_people_write_it(written):
    assert equation(written).number in ("D-23", "2-8a")


def test_form_that_is_not_there_is_refused():
    with pytest.raises(ValueError, match="has no corrected form"):
        equation("2-6").latex("corrected")
    with pytest.raises(ValueError, match="has no printed form"):
        equation("5-9").latex("printed")
    with refuses("form", "left"):
        equation("2-6").latex("left")


def test_equations_typeset():
    for number, one in EQUATIONS.items():
        assert isinstance(one.kind, Kind), number
        assert one.section, number
        for form in ("right", *(["printed"] if one.printed else [])):
            text = one.latex(form)
            assert text.count("{") == text.count("}"), (number, text)
            assert "Piecewise" not in text, (number, text)
