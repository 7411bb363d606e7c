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
    equation,
    notation as th,
    verification,
)
from rockeom.thesis.checks import Means
from rockeom.thesis.equation import says
from tests.refusals import refused, refuses

from .wrong import notices, slips


@pytest.mark.parametrize("number", EQUATIONS)
def test_equation_is_decided(number):
    decision = decide(number)
    assert decision.verdict.passes, decision.why
    assert decision.findings


WRONG = [n for n, one in EQUATIONS.items() if one.is_erratum]


@pytest.mark.parametrize("number", WRONG)
def test_slip_in_a_printed_form_that_is_wrong_is_noticed(number):
    """It is wrong by its correction and by nothing else: also if its numbers are quoted wrongly."""
    one = EQUATIONS[number]
    tried = [s for s in slips(one.printed, everything=False) if s[1] != one.corrected]
    assert tried
    for words, printed in tried:
        try:
            quoted = replace(one, printed=printed)
        except ValueError:  # the piece that is to be replaced is not there
            continue
        assert notices(one, quoted.right), words


def test_excess_of_a_printed_form_is_that_found_by_hand():
    u, u_d, theta_d = th.u, th.u_d, th.theta_d
    by_hand = {
        "2-9": (-2 * th.m * th.a_g * th.R * sp.sin(th.alpha) * sp.sin(th.PM * th.theta),),
        "3-12": ((1 - th.s) * sp.Rational(3, 4) * th.m * th.g * th.alpha * sp.sin(th.alpha),),
        "D-8": (
            2 * th.m_e * u_d * theta_d * sp.sin(th.theta)
            * (th.R_e * sp.sin(th.alpha_e - th.theta) - u * sp.cos(th.theta)),
            th.m_e * u_d**2 * sp.cos(2 * th.theta) / 2,
        ),
    }  # fmt: skip
    for number, excess in by_hand.items():
        pairs = zip(EQUATIONS[number].excess, excess, strict=True)
        assert [sp.simplify(sp.expand_trig(a - b)) for a, b in pairs] == [0] * len(excess), number


@pytest.mark.parametrize("number", ["3-14", "4-1"])
def test_domain_of_a_printed_form_is_neither_too_wide_nor_too_narrow(number):
    one = EQUATIONS[number]
    assert decide(number).verdict is Verdict.LIMITED
    inside, outside = one.domain.inside, one.domain.outside
    for wrong in (replace(one.domain, inside=outside), replace(one.domain, outside=inside)):
        findings = verification._domain(replace(one, domain=wrong))
        assert not all(f.holds for f in findings)


# --- the framework itself


def test_printed_form_that_passes_its_checks_is_not_an_erratum(monkeypatch):
    """Nothing may be called wrong that no check finds wrong."""
    one = EQUATIONS["2-6"]
    (relation,) = one.printed
    same = {relation.rhs: sp.expand(relation.rhs)}
    harmless = replace(one, correction=same, reason="the same, expanded")
    monkeypatch.setattr(verification, "equation", lambda number: harmless)
    assert decide("2-6").verdict is Verdict.FAILED


def test_wrong_correction_is_noticed(monkeypatch):
    one = EQUATIONS["2-9"]
    (relation,) = one.printed
    wrong = replace(one, correction={**one.correction, relation.rhs: th.I_o})
    monkeypatch.setattr(verification, "equation", lambda number: wrong)
    decision = decide("2-9")
    assert decision.verdict is Verdict.FAILED
    assert "I_b" in decision.why or "theta" in decision.why


def test_form_that_cannot_be_compared_fails_and_does_not_hide_the_others(monkeypatch):
    """Nor is a printed form proved wrong by a check that breaks."""
    one = EQUATIONS["2-9"]
    foreign = {**one.correction, th.I_o: sp.Symbol("z")}
    printed = says(one.printed[0].lhs * sp.Symbol("z"), 0)
    for broken in (replace(one, correction=foreign), replace(one, printed=printed)):
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
        for form in ("right", *(["printed"] if one.printed else [])):
            text = one.latex(form)
            assert text.count("{") == text.count("}"), (number, text)
            assert "Piecewise" not in text, (number, text)
