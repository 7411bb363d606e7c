"""The checks of chapter 2 notice an equation that is slightly wrong."""

from __future__ import annotations

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS, Equation
from rockeom.thesis.checks.chapter_2 import CHECKS, equivalent, flag_loop, takeda_loop, work
from rockeom.thesis.equation import Relations

HUNDREDTH = sp.Rational(101, 100)


def notices(equation: Equation, relations: Relations) -> bool:
    """Whether a finding of any check does not hold."""
    return any(
        not finding.holds
        for check in _checks(equation.number)
        for finding in check.find(equation, relations)
    )


def _checks(number: str) -> tuple:
    check = CHECKS[number]
    return check if isinstance(check, tuple) else (check,)


def changed(relation: sp.Eq, change) -> sp.Eq:
    """Both sides of an equation of motion are changed, of another the right side."""
    left = relation.lhs if relation.lhs.is_Symbol else change(relation.lhs)
    return relation.func(left, change(relation.rhs), evaluate=False)


def mutations():
    for number in CHECKS:
        for i, relation in enumerate(EQUATIONS[number].right):
            yield number, i, None
            inside = relation.rhs.free_symbols
            if not relation.lhs.is_Symbol:
                inside |= relation.lhs.free_symbols
            for symbol in sorted(inside, key=str):
                if str(symbol) != r"\pm":
                    yield number, i, symbol


@pytest.mark.parametrize(("number", "i", "symbol"), list(mutations()))
def test_a_hundredth_too_much_is_noticed(number, i, symbol):
    """Of the right side (None), or of one symbol wherever it stands."""
    equation = EQUATIONS[number]
    relations = list(equation.right)
    if symbol is None:
        relations[i] = sp.Eq(relations[i].lhs, HUNDREDTH * relations[i].rhs, evaluate=False)
    else:
        relations[i] = changed(relations[i], lambda side: side.subs(symbol, HUNDREDTH * symbol))
    assert notices(equation, tuple(relations))


def test_reversed_inequality_is_noticed():
    (relation,) = EQUATIONS["2-1"].right
    assert notices(EQUATIONS["2-1"], (sp.Lt(relation.lhs, relation.rhs),))
    assert not notices(EQUATIONS["2-1"], (relation,))


def test_sign_of_gravity_in_the_uplifted_motion_is_noticed():
    (relation,) = EQUATIONS["2-7"].right
    (sign,) = (x for x in relation.rhs.free_symbols if str(x) == r"\pm")
    assert notices(EQUATIONS["2-7"], (relation.subs(sign, -sign),))


def test_half_width_of_the_uplifted_structure_is_not_the_width():
    """With the whole width for B, 2-8 would halve the frequency and the damping."""
    for number in ("2-8a", "2-8b"):
        (relation,) = EQUATIONS[number].right
        (width,) = (x for x in relation.rhs.free_symbols if x.name == "B")
        assert notices(EQUATIONS[number], (relation.subs(width, 2 * width),))


@pytest.mark.parametrize(("loop", "sides"), [(takeda_loop, 1), (flag_loop, 2)])
def test_loops_are_clockwise_and_vanish_without_yield(loop, sides):
    """Dissipation is positive past yield and zero at it, for numbers as for the symbols."""
    expr = sides * equivalent(loop())
    put = {x: 0.05 if x.name == "rho" else 0.35 for x in expr.free_symbols if x.name != "mu"}
    (mu,) = (x for x in expr.free_symbols if x.name == "mu")
    damping = [float(expr.subs({**put, mu: value})) for value in (1, 2, 4)]
    assert damping[0] == pytest.approx(0, abs=1e-15)
    assert 0 < damping[1] < damping[2] < 2 / sp.pi


def test_work_of_a_square_loop():
    square = [(sp.Integer(u), sp.Integer(f)) for u, f in ((0, 1), (1, 1), (1, 0), (0, 0))]
    assert work(square) == 1
    assert work(square[::-1]) == -1
