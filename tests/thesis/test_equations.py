"""Every equation of the thesis is decided by its checks.

Where the thesis is wrong, what is printed differs from what is derived, and by the stated term.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp
from sympy import Rational, atan, cos, sign, sin

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
from rockeom.thesis.checks.engine import DERIVED, evaluate
from rockeom.thesis.comparison import differences, in_engine_notation, normal_form
from rockeom.thesis.equation import Kind, says

s = sign(th.theta)


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


EXCESS: dict[str, list[sp.Expr]] = {
    "2-9": [-2 * s * th.m * th.a_g * th.R * sin(th.alpha) * sin(th.theta)],
    "2-13": [
        th.alpha
        * th.beta
        * cos(th.omega * th.t)
        * (cos(th.alpha**2 * (1 - th.PM * th.x)) - cos(th.alpha * (1 - th.PM * th.x)))
    ],
    "3-12": [(1 - s) * Rational(3, 4) * th.m * th.g * th.alpha * sin(th.alpha)],
    "3-14": [(1 + s) * Rational(3, 4) * th.m * th.g * th.alpha * cos(th.alpha)],
    "5-11": [
        -2
        * sin(th.theta)
        / th.I_O
        * (
            th.m_e * (th.g * th.H_e - s * th.a_g * th.B)
            + th.m_b * (th.g * th.H_b - s * th.a_g * th.B)
        )
    ],
    "5-29": [th.W / th.H_e * (th.B - th.W * th.H_c / (2 * th.k_f * th.B)) * (th.u - 1)],
    "5-30": [0, th.B / th.H_c - atan(th.B / th.H_c), 0],
    "D-2": [
        th.R_b * (sin(th.alpha_b - th.theta) - sin(th.alpha_e - th.theta)),
        th.R_b * (cos(th.alpha_e - th.theta) - cos(th.alpha_b - th.theta)),
    ],
    "D-4": [
        th.R_b * th.theta_d * (cos(th.alpha_e - th.theta) - cos(th.alpha_b - th.theta)),
        th.R_b * th.theta_d * (sin(th.alpha_e - th.theta) - sin(th.alpha_b - th.theta)),
    ],
    "D-8": [
        2
        * th.m_e
        * th.u_d
        * th.theta_d
        * sin(th.theta)
        * (th.R_e * sin(th.alpha_e - th.theta) - th.u * cos(th.theta)),
        th.m_e * th.u_d**2 * cos(2 * th.theta) / 2,
    ],
    "D-12": [0, th.m_b * th.R_b * (1 - th.R_b) * th.theta_d**2 / 2],
    "D-14": [th.m_b * th.R_b * (1 - th.R_b) * th.theta_d**2 / 2],
    "D-22": [
        th.R_b * (sin(th.alpha_e + th.theta) - sin(th.alpha_b + th.theta)),
        th.R_b * (cos(th.alpha_e + th.theta) - cos(th.alpha_b + th.theta)),
    ],
    "D-23": [2 * th.m_e * th.g * th.u * cos(th.theta)],
}
"""Printed minus derived, for each component of each relation, by hand."""

AGREES_ON_ONE_SIDE = {"3-12": 1, "3-14": -1}
"""Sides of theta on which a slip of sign does not show."""


@pytest.mark.parametrize("number", EXCESS)
def test_printed_form_is_wrong_by_the_stated_term(number):
    equation = EQUATIONS[number]
    for side in equation.sides:
        values, known = evaluate(number, side)
        found = [
            d
            for relation, value in zip(equation.printed, values, strict=True)
            for d in differences(relation, value, side, known)
        ]
        stated = [in_engine_notation(e, side) for e in EXCESS[number]]
        assert all(normal_form(a - b) == 0 for a, b in zip(found, stated, strict=True))
        wrong = any(normal_form(e) != 0 for e in found)
        assert wrong is (AGREES_ON_ONE_SIDE.get(number) != side)


def test_every_erratum_of_the_engine_states_its_term():
    assert set(EXCESS) == {n for n in DERIVED if EQUATIONS[n].is_erratum}


# --- the framework itself


def test_printed_form_that_passes_its_checks_is_not_an_erratum(monkeypatch):
    """Nothing may be called wrong that no check finds wrong."""
    one = EQUATIONS["2-6"]
    (relation,) = one.printed
    same = says(relation.lhs, sp.expand(relation.rhs))
    harmless = replace(one, corrected=same, reason="the same, expanded")
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
    assert not verification.verify(["2-6", "2-9"]).passes


def test_order_is_that_of_the_thesis():
    def place(number: str) -> tuple[str, int, str]:
        chapter, _, rest = number.partition("-")
        digits = rest.rstrip("abcd")
        return chapter, int(digits), rest[len(digits) :]

    assert sorted(EQUATIONS, key=place) == list(EQUATIONS)


def test_number_that_is_not_there_is_told_with_those_that_are():
    with pytest.raises(ValueError, match=r"no equation '5-99': chapter 5 has 5-1 to 5-37"):
        equation("5-99")
    with pytest.raises(ValueError, match="chapters are"):
        equation("7-1")


@pytest.mark.parametrize("written", ["D-23", "d-23", " D-23 ", "2-8A"])
def test_number_is_found_as_people_write_it(written):
    assert equation(written).number in ("D-23", "2-8a")


def test_form_that_is_not_there_is_refused():
    with pytest.raises(ValueError, match="has no corrected form"):
        equation("2-6").latex("corrected")
    with pytest.raises(ValueError, match="has no printed form"):
        equation("5-9").latex("printed")
    with pytest.raises(ValueError, match="choose one of right, printed, corrected"):
        equation("2-6").latex("left")


def test_equations_typeset():
    for number, one in EQUATIONS.items():
        assert isinstance(one.kind, Kind), number
        assert one.section, number
        for form in ("right", *(["printed"] if one.printed else [])):
            text = one.latex(form)
            assert text.count("{") == text.count("}"), (number, text)
            assert "Piecewise" not in text, (number, text)
