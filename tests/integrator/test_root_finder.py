"""The first fall of a polynomial of degree 7 through zero, against extremes by numpy.roots."""

import functools
import itertools
from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import assume, example, given, settings, strategies as st

import rockeom as rk
from rockeom.integrator.methods.tableau import NODES, powers_to_bernstein, samples_to_bernstein
from tests import machine_code


@functools.cache
def loop():
    """Compiled where it is first asked for: to collect the tests costs nothing."""
    return machine_code.functions(LOOP, rk.RigidBlock(half_width=0.25, half_height=1.0).module)


LOOP = """
@entry
def the_fall(b: Floats) -> float:
    return fall(b, 0)

@entry
def at(b: Floats, x: float, out: Floats):
    out[0], out[1] = bernstein_at(b, 0, x)

@entry
def the_first_fall(b: Floats, closed: bool, noise: float, stack: Floats) -> float:
    return first_fall(b, 0, EXACT, closed, noise, stack)

@entry
def of_gap(b: Floats, closed: int, out: Floats):
    gap = b[0], b[1], b[2], b[3], b[4], b[5]
    out[0] = 1.0 if stays_open(gap, closed == 0) else 0.0
    out[1] = closes_once(gap, closed == 0)
    out[2] = 1.0 if rises_and_falls(gap) else 0.0

@entry
def of_samples(b: Floats) -> bool:
    return clearly_open(b, 0)

@entry
def the_bound(coefficients: Floats, bound: float, b: Floats, stack: Floats) -> float:
    return bound_passed(ROTATION, coefficients, bound, b, stack)

@entry
def the_power(x: float, exponent: float) -> float:
    return power(x, exponent)
"""
NEVER = 2.0
TO_BERNSTEIN = samples_to_bernstein()


def fall(b):
    return loop()["the_fall"](b)


def at(b, x):
    found = np.empty(2)
    loop()["at"](b, x, found)
    return found


def first_fall(b, closed=False, noise=0.0):
    stack = np.empty(640)
    return loop()["the_first_fall"](np.array(b, dtype=float), closed, noise, stack)


def value(b, x):
    """The polynomial at x, without rounding."""
    n, d = Fraction(x).as_integer_ratio()
    terms = (comb(7, i) * Fraction(c) * (n**i * (d - n) ** (7 - i)) for i, c in enumerate(b))
    return sum(terms) / d**7


def bernstein(powers):
    """Bernstein coefficients (8,) of the polynomial with the given coefficients of 1, x, x^2 ..."""
    powers = [*powers, *[0] * (8 - len(powers))]
    return [
        float(sum(Fraction(comb(i, j), comb(7, j)) * powers[j] for j in range(i + 1)))
        for i in range(8)
    ]


def product(factors):
    """Coefficients of 1, x, x^2 ... of a product of polynomials."""
    powers = [Fraction(1)]
    for factor in factors:
        longer = [Fraction(0)] * (len(powers) + len(factor) - 1)
        for (i, a), (j, c) in itertools.product(enumerate(powers), enumerate(factor)):
            longer[i + j] += a * c
        powers = longer
    return powers


X = np.polynomial.Polynomial([0, 1])
DEGREE_6 = np.array([(comb(6, i) * X**i * (1 - X) ** (6 - i)).coef for i in range(7)])
"""Coefficients of 1, x, x^2 ... of the Bernstein polynomials of degree 6, one a row."""


def witnesses(b):
    """(x, value) of the ends and of all extremes in [0, 1], by numpy.roots of the derivative.

    Between two sign changes there is an extreme: they bracket every fall. Extremes that rounding
    may hide are refused.
    """
    b = np.array(b, dtype=float)
    roots = np.polynomial.Polynomial(np.diff(b) @ DEGREE_6).roots()
    inside = roots.real[(abs(roots.imag) < 1e-3) & (roots.real > 0) & (roots.real < 1)]
    size = np.abs(b).max()
    found = [(x, float(value(b, x))) for x in [0.0, *sorted(inside.tolist()), 1.0]]
    clear = [(x, v) for x, v in found if abs(v) > 1e-11 * size]
    assume(all(pair in clear for pair in found[1:-1]))
    return clear


def check_first_fall(b, closed=False):
    """The root found lies in the first bracket of a fall, and the guard is zero there."""
    clear = witnesses(b)
    places, signs = [x for x, _ in clear], [v > 0 for _, v in clear]
    falls = [n for n in range(1, len(signs)) if signs[n - 1] and not signs[n]]
    found = first_fall(b, closed)
    size = np.abs(b).max()
    if falls:
        n = falls[0]
        assert places[n - 1] < found <= places[n]
        assert abs(value(b, found)) <= 64 * np.finfo(float).eps * size
    elif signs and not any(signs):
        assert found == 0.0  # it is below zero throughout: it has fallen
    else:
        # what ends at zero may fall there or not
        assert found == NEVER or (found > places[-1] and abs(b[7]) <= 1e-11 * size)


coefficients = st.one_of(
    st.integers(-5, 5),
    st.floats(-1, 1, allow_subnormal=False).filter(lambda v: v == 0 or abs(v) > 1e-6),
)


@settings(max_examples=500)
@given(start=st.floats(1e-3, 1), rest=st.lists(coefficients, min_size=7, max_size=7))
@example(start=1, rest=[0] * 6 + [-1])
@example(start=1, rest=[-1, 1, -1, 1, -1, 1, -1])
def test_any_polynomial_that_begins_positive(start, rest):
    check_first_fall([start, *rest])


@settings(max_examples=300)
@given(
    first=st.fractions(Fraction(1, 50), Fraction(24, 25), max_denominator=10**6),
    log_width=st.floats(-4, -1.5),
    third=st.fractions(-3, 3, max_denominator=1000),
    height=st.fractions(0, 2, max_denominator=1000),
)
def test_close_pair_is_not_stepped_over(first, log_width, third, height):
    """It falls at `first` and is positive again 1e-4 to 0.03 later; and then two more factors."""
    second = first + Fraction(10**log_width)
    factors = [
        [-first, 1], [-second, 1], [Fraction(1, 100) + height, -1, 1], [Fraction(1, 2) - third, 1]
    ]  # fmt: skip
    powers = product(factors)
    assume(powers[0] != 0)  # what begins at zero falls there
    sign = 1 if powers[0] > 0 else -1
    check_first_fall(bernstein([sign * c for c in powers]))


@settings(max_examples=100)
@given(
    st.lists(
        st.fractions(Fraction(1, 20), Fraction(19, 20), max_denominator=200),
        min_size=7,
        max_size=7,
        unique=True,
    )
)
def test_seven_roots_in_a_step(roots):
    check_first_fall(bernstein(product([[r, -1] for r in roots])))


@settings(max_examples=300)
@given(
    residual=st.floats(-1e-16, 1e-16),
    rest=st.lists(coefficients, min_size=6, max_size=6),
)
def test_guard_that_is_closed_at_the_start_opens_and_falls_later(residual, rest):
    """What is left at the last event is no event; b[1] > 0: it opens."""
    check_first_fall([0.0, 1.0, *rest], closed=True)
    clean = first_fall([0.0, 1.0, *rest], closed=True)
    assert first_fall([residual, 1.0, *rest], closed=True) == clean


def test_guard_that_is_closed_and_does_not_open_falls_at_once():
    assert first_fall([0, -1, -1, -1, -1, -1, -1, -1], closed=True) == 0.0
    assert first_fall([0, -1, 3, 3, 3, 3, 3, 3], closed=True) == 0.0
    assert first_fall([0, 0, 0, 0, 0, 0, 0, -1], closed=True) == 0.0


@settings(max_examples=300)
@given(start=st.floats(-1, -1e-3), rest=st.lists(coefficients, min_size=7, max_size=7))
@example(start=-0.6, rest=[0.88, -0.81, -0.99, -0.35, 0.98, -0.47, 0.66])
def test_guard_that_begins_below_zero_has_fallen_or_rises_first(start, rest):
    check_first_fall([start, *rest])


@pytest.mark.parametrize("place", [Fraction(1, 2), Fraction(1, 4), Fraction(1, 3), Fraction(7, 10)])
@pytest.mark.parametrize("power", [2, 4, 6])
def test_tangent_from_above_is_no_fall(place, power):
    assert first_fall(bernstein(product([[place, -1]] * power))) == NEVER


@pytest.mark.parametrize("power", [3, 5, 7])
def test_flat_fall(power):
    """A root of odd multiplicity: found where rounding allows, the more loosely the flatter."""
    b = bernstein(product([[Fraction(3, 10), -1]] * power))
    assert first_fall(b) == pytest.approx(0.3, abs=(64 * np.finfo(float).eps) ** (1 / power))


@pytest.mark.parametrize("rises", [[], [Fraction(3, 5)], [Fraction(3, 5), Fraction(9, 10)]])
@pytest.mark.parametrize("place", [Fraction(1, 2), Fraction(1, 4), Fraction(3, 8)])
def test_fall_exactly_where_the_interval_is_halved(place, rises):
    """The root is the end of one part and the start of the next: neither may leave it out."""
    b = bernstein(product([[r, -1] for r in [place, *rises]]))
    assert first_fall(b) == pytest.approx(float(place), abs=1e-14)


def test_fall_at_the_very_end():
    """Nothing is below zero yet: it may count here, or in the next step."""
    assert first_fall(bernstein([1, -1])) in (1.0, NEVER)
    assert first_fall(bernstein(product([[1, -1], [2, -1]]))) in (1.0, NEVER)


@pytest.mark.parametrize("scale", [1e-300, 1e-30, 1e30, 1e300])
def test_size_of_a_guard_does_not_matter(scale):
    b = np.array(bernstein(product([[Fraction(1, 3), -1], [Fraction(2, 3), -1], [2, 1]])))
    assert first_fall(scale * b) == pytest.approx(1 / 3, abs=1e-14)


def test_polynomial_of_zeros_never_falls():
    assert first_fall([0.0] * 8) == NEVER
    assert first_fall([0.0] * 8, closed=True) == NEVER


def test_single_fall_is_found_to_the_last_bits():
    """`fall` alone: steep at one end and flat at the other, where false position is slow."""
    for b in ([1, 1, 1, 1, 1, 1, 1, -1e-9], [1e-9, -1, -1, -1, -1, -1, -1, -1], [1] + [-1] * 7):
        x = fall(np.array(b, dtype=float))
        step = 4 * np.finfo(float).eps
        assert value(b, x + step) <= 0 <= value(b, max(x - step, 0.0))


@settings(max_examples=100)
@given(b=st.lists(st.floats(-1, 1), min_size=8, max_size=8), x=st.floats(0, 1))
def test_value_by_de_casteljau(b, x):
    found, slope = at(np.array(b), x)
    rounding = 1e-15 * max(1e-300, *map(abs, b)) * 8
    assert found == pytest.approx(float(value(b, x)), abs=rounding)
    # the slope has the differences of the coefficients for its own, one degree less
    slopes = 7 * np.diff(b)
    expected = sum(comb(6, i) * x**i * (1 - x) ** (6 - i) * c for i, c in enumerate(slopes))
    assert slope == pytest.approx(float(expected), abs=20 * rounding)


@settings(max_examples=50)
@given(st.lists(st.integers(-9, 9), min_size=8, max_size=8))
def test_samples_and_powers_give_the_same_bernstein_form(powers):
    expected = bernstein(powers)
    np.testing.assert_allclose(powers_to_bernstein() @ powers, expected, atol=1e-13)
    sampled = TO_BERNSTEIN @ np.polynomial.Polynomial(powers)(NODES)
    np.testing.assert_allclose(sampled, expected, atol=1e-11)


# -- the quintic of a gap, which decides most steps


def of_gap(b, closed=False):
    """(stays open, place where it closes once or NEVER, closes at the end only)."""
    found = np.empty(3)
    loop()["of_gap"](np.array(b, dtype=float), 0 if closed else -1, found)
    return bool(found[0]), found[1], bool(found[2])


def roots_of_quintic(b):
    """Real roots in [0, 1], by numpy.roots, and those beside the real axis."""
    x, rest = np.polynomial.Polynomial([0, 1]), np.polynomial.Polynomial([1, -1])
    roots = sum(comb(5, i) * c * x**i * rest ** (5 - i) for i, c in enumerate(b)).roots()
    near = roots.real[np.abs(roots.imag) < 1e-4]
    return near[(near > -1e-9) & (near < 1 + 1e-9)]


@settings(max_examples=1000)
@given(
    start=st.one_of(st.just(0.0), st.floats(1e-3, 1)),
    rest=st.lists(coefficients, min_size=5, max_size=5),
)
@example(start=0.0, rest=[1, 0.1, -0.5, 0.1, -1])
@example(start=1.0, rest=[1, 1, 1, 1, -1])
@example(start=0.0, rest=[1, 1, 1, 1, -0.01])
def test_gap_that_clearly_closes_or_stays_open(start, rest):
    """What is certified is so: no root, or one where it was found; and by a margin."""
    b = [start, *rest]
    closed = start == 0.0
    stays, place, rises = of_gap(b, closed)
    roots = roots_of_quintic(b)
    if closed:
        roots = roots[roots > 1e-9]
    assert not (stays and place < NEVER)
    if stays:
        assert len(roots) == 0
    if place < NEVER:
        assert len(roots) == 1
        assert place == pytest.approx(roots[0], abs=1e-9)
    if rises and closed:
        # it may close beside the end, if its last coefficient is small
        size = max(abs(c) for c in rest[:4])
        assert abs(rest[4]) > 0.01 * size or all(x > 0.5 for x in roots)


@pytest.mark.parametrize("second", [0.002, 0.0, -0.0005, -0.05, -0.18])
def test_gap_that_closes_early_in_a_step_is_certain_too(second):
    """Whatever the second coefficient is: behind a clear fall there is one change of sign."""
    gap = [0.1, second, -0.2, -0.45, -0.7, -1.0]
    (root,) = roots_of_quintic(gap)
    assert of_gap(gap)[1] == pytest.approx(root, abs=1e-9)
    closed = of_gap([0.0, *gap[1:]], closed=True)[1]
    assert (closed < NEVER) == (second > 0.001)  # else it rises in no time, if at all
    assert of_gap([0.1, second, -0.2, -0.0001, -0.7, -1.0])[1] == NEVER  # there may be two more


@pytest.mark.parametrize(
    ("curvature", "leaves"), [(0.0, True), (1e-4, True), (-1e-13, True), (-1e-6, False)]
)
def test_gap_that_leaves_from_rest(curvature, leaves):
    """Without speed, and with no acceleration but by rounding, the change of that opens it."""
    gap = [0.0, 0.0, curvature, 0.1, 0.4, 1.0]
    assert of_gap(gap, closed=True)[0] == leaves
    assert not of_gap(gap)[0]  # a gap that was not closed by an event is not there
    assert not of_gap([0.0, -1e-6, *gap[2:]], closed=True)[0]  # it closes first
    assert not of_gap([*gap[:3], 1e-4, 0.4, 1.0], closed=True)[0]


def test_samples_stay_open_where_all_coefficients_of_their_polynomial_do():
    """Not where one of the eight is no number: nothing is known of that guard."""
    random = np.random.default_rng(5)
    known = set()
    for samples in 1.0 + random.uniform(0.0, 1.0, (2000, 1)) * random.uniform(-1, 1, (2000, 8)):
        coefficients = TO_BERNSTEIN @ samples
        wanted = coefficients.min() > 1e-3 * np.abs(coefficients).max()
        assert loop()["of_samples"](samples) == wanted
        known.add(bool(wanted))
        samples[random.integers(8)] = np.nan
        assert not loop()["of_samples"](samples)
    assert known == {False, True}


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("places", [(0.3, 0.4, 0.8), (0.55, 0.6, 0.9), (0.05, 0.6, 0.7)])
def test_bound_is_passed_where_a_structure_first_reaches_it(places, side):
    """Within a step it goes beyond the bound, comes back, and goes beyond it again."""
    powers = 20.0 * np.polynomial.polynomial.polyfromroots(places)
    powers[0] += 1.0
    coefficients = np.zeros((8, 2))
    coefficients[:4, 0] = side * powers
    found = loop()["the_bound"](coefficients.ravel(), 1.0, np.empty(8), np.empty(640))
    assert found == pytest.approx(min(places), abs=1e-12)


def test_bound_that_only_the_end_of_a_step_reaches():
    coefficients = np.zeros((8, 2))
    coefficients[1, 0] = 1.0
    for bound, place in ((1.0, 1.0), (1.0 + 1e-9, NEVER), (0.5, 0.5)):
        found = loop()["the_bound"](coefficients.ravel(), bound, np.empty(8), np.empty(640))
        assert found == pytest.approx(place, abs=1e-12)


@pytest.mark.parametrize("order", [4, 5, 8])
def test_powers_of_the_control_are_right_within_four_per_cent(order):
    for exponent in (-0.7 / order, 0.4 / order):
        for x in np.logspace(-10, 0, 101).tolist():
            assert loop()["the_power"](x, exponent) == pytest.approx(x**exponent, rel=0.04)
