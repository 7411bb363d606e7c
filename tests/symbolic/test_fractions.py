"""What stands for `cancel`, `together` and `expand` gives what SymPy gives, to the letter."""

import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st

from rockeom.symbolic.algebra import slopes
from rockeom.symbolic.fractions import cancelled, expanded, over_one_denominator

x, y, z = sp.symbols("x y z", positive=True)
ANGLE = sp.Symbol("theta", real=True)
ATOMS = [x, y, z, sp.sin(ANGLE), sp.cos(ANGLE), sp.Rational(1, 2), sp.Integer(-3)]


def _combined(inner):
    sums = st.lists(inner, min_size=2, max_size=4).map(lambda parts: sp.Add(*parts))
    products = st.lists(inner, min_size=2, max_size=3).map(lambda parts: sp.Mul(*parts))
    quotients = st.tuples(inner, inner).filter(lambda of: of[1] != 0).map(lambda of: of[0] / of[1])
    return sums | products | quotients | inner.map(lambda e: e**2)


EXPRESSIONS = st.recursive(st.sampled_from(ATOMS), _combined, max_leaves=12).filter(
    lambda e: e.is_finite is not False and not e.has(sp.nan, sp.zoo)
)


@settings(max_examples=100)
@given(EXPRESSIONS)
def test_rational_expressions_become_what_sympy_makes_of_them(expr):
    try:
        lowest = sp.cancel(expr)
    except ZeroDivisionError:
        return  # a denominator that vanishes once it is expanded
    assert cancelled(expr) == lowest
    assert over_one_denominator(expr) == sp.together(expr)
    assert expanded(expr) == sp.expand(expr)


ROOT = sp.sqrt(1 + x**2 / y**2)


@pytest.mark.parametrize(
    "expr",
    [
        z * ROOT / (x * ROOT + y * ROOT),  # the root goes
        (x + ROOT) / (x**2 - ROOT**2 + y),  # it stays
        (x + ROOT) * (y + ROOT) / (z * ROOT),
        (x**3 + 1 / ROOT**3) / (1 / (x + ROOT) + 1 / (x - ROOT)),
        (sp.sin(ANGLE * (x + y)) + 1) ** 2 / (sp.sin(ANGLE * (x + y)) + 1),
        sp.exp(x + y) * (x + y) / (sp.exp(x) + x),
        sp.Function("f")(x) * (x + y) ** 2 / (x * sp.Function("f")(x) + y * sp.Function("f")(x)),
        (1.5 * x + y) ** 2 / (x + sp.pi * y),
        (x + y) ** 2 * (x + z) / ((x - y) ** 2 * (x * (y + z))),
        sp.Add(*(sp.Symbol(f"a{i}") for i in range(50))) * (x + y),
        sp.S.Zero,
    ],
)
def test_roots_functions_and_numbers_of_other_kinds_become_what_sympy_makes_of_them(expr):
    assert cancelled(expr) == sp.cancel(expr)
    assert over_one_denominator(expr) == sp.together(expr)
    assert expanded(expr) == sp.expand(expr)


def test_fractions_of_fractions_take_no_product_of_all_denominators():
    """SymPy multiplies all twenty before it divides."""
    fraction = x
    for i in range(20):
        fraction = 1 / (fraction + sp.Symbol(f"b{i % 4}", positive=True)) + z / (x + y)
    value = cancelled(
        fraction - fraction.xreplace({x: y, y: x}).xreplace({x: y, y: x}) + x / (x * y)
    )
    assert value == 1 / y


def test_derivatives_are_those_of_all_terms():
    expr = x * y + sp.sin(x) * z + y**2 * (x + z) + 3
    assert slopes(expr, (x, y, ANGLE, z)) == [sp.diff(expr, s) for s in (x, y, ANGLE, z)]
