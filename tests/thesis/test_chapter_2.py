"""The checks of chapter 2 notice an equation that is slightly wrong."""

import pytest
import sympy as sp

from rockeom.thesis import EQUATIONS
from rockeom.thesis.checks.chapter_2 import equivalent, flag_loop, takeda_loop, work

from .wrong import notices


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
