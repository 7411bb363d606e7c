"""Elementary functions whose bits are the same everywhere, for programs that run in a browser.

Browsers have no common library of mathematics: their sines differ in the last digit, and one digit
decides which impact comes first. These functions use sums, products, quotients and square roots
alone, each rounded as IEEE 754 asks, and are within 3 units in the last place of the exact values
(`own_pow` within 1 + |y log x| of them). Arguments of sines reach up to 1e5.

This text is joined to others, see `rockeom.browser.program`.
"""

import math

import numpy as np

from rockeom.compiler.decorators import apart, rolled

SINE = np.array([(-1.0) ** k / math.factorial(2 * k + 1) for k in range(1, 9)])
COSINE = np.array([(-1.0) ** k / math.factorial(2 * k) for k in range(2, 10)])
EXPONENTIAL = np.array([1.0 / math.factorial(k) for k in range(2, 15)])
ARTANH = np.array([2.0 / (2 * k + 1) for k in range(1, 12)])
ARCTANGENT = np.array([(-1.0) ** k / (2 * k + 1) for k in range(1, 22)])
"""Coefficients of Taylor polynomials, from the second or third on."""

HALF_PI = (1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21)
"""pi/2 in three parts, the first two of 33 bits: their products with whole numbers are exact."""
LN2 = (0.6931471804855391, 7.440617110012397e-11)
"""ln(2) in two parts, the first of 33 bits."""

BITS = (1024, 512, 256, 128, 64, 32, 16, 8, 4, 2, 1)
UP = (math.inf, *(2.0**n for n in BITS[1:]))
DOWN = tuple(2.0**-n for n in BITS)
"""Powers of two, by which a number is scaled without rounding."""


@apart
@rolled
def own_polynomial(coefficients, x):
    """Sum of coefficients[k] x**k."""
    value = 0.0
    for k in range(len(coefficients) - 1, -1, -1):
        value = value * x + coefficients[k]
    return value


def own_round(x):
    """The whole number next to x, for |x| below 1e15."""
    return int(x + 0.5) if x >= 0.0 else int(x - 0.5)


@apart
@rolled
def own_power_of_two(n):
    """2**n of a whole number, exactly; 0 or infinity beyond the range."""
    left, value = abs(n), 1.0
    for i in range(len(BITS)):
        if left >= BITS[i]:
            left = left - BITS[i]
            value = value * (UP[i] if n >= 0 else DOWN[i])
    return value


# -- sines ---------------------------------------------------------------------------------------


@apart
def own_sine(x, quarters):
    """sin(x + quarters pi/2), by the quadrant of x and the rest."""
    if not abs(x) < 1e9:
        return np.nan
    n = own_round(x / 1.5707963267948966)
    k = float(n)
    high = (x - k * HALF_PI[0]) - k * HALF_PI[1]
    r = high - k * HALF_PI[2]
    low = (high - r) - k * HALF_PI[2]
    square = r * r
    turns = int(0.25 * (k + quarters))
    quadrant = n + quarters - 4 * turns
    if quadrant < 0:
        quadrant = quadrant + 4
    if quadrant == 0 or quadrant == 2:
        value = r + (r * (square * own_polynomial(SINE, square)) + low)
    else:
        rest = square * square * own_polynomial(COSINE, square) - r * low
        half = 0.5 * square
        whole = 1.0 - half
        value = whole + (((1.0 - whole) - half) + rest)
    return value if quadrant < 2 else -value


def own_sin(x):
    return own_sine(x, 0)


def own_cos(x):
    return own_sine(x, 1)


def own_tan(x):
    return own_sine(x, 0) / own_sine(x, 1)


# -- exponentials --------------------------------------------------------------------------------


@apart
def own_expm1_rest(x, k):
    """exp(x - k ln(2)) - 1, for what is left below half of ln(2)."""
    high, low = x - k * LN2[0], k * LN2[1]
    r = high - low
    return r + (r * r * own_polynomial(EXPONENTIAL, r) + ((high - r) - low))


@apart
def own_exp(x):
    if x != x:
        return x
    if x > 710.0:
        return np.inf
    if x < -746.0:
        return 0.0
    n = own_round(x / 0.6931471805599453)
    value = 1.0 + own_expm1_rest(x, float(n))
    half = int(0.5 * n)
    return value * own_power_of_two(half) * own_power_of_two(n - half)


@apart
def own_expm1(x):
    if x != x:
        return x
    if x > 710.0:
        return np.inf
    if x < -40.0:
        return -1.0
    n = own_round(x / 0.6931471805599453)
    rest = own_expm1_rest(x, float(n))
    if n == 0:
        return rest
    if n > 1000:
        return own_exp(x)
    power = own_power_of_two(n)
    return (power - 1.0) + power * rest


def own_sinh(x):
    size = abs(x)
    half, e = own_exp(0.5 * size), own_expm1(min(size, 40.0))
    value = 0.5 * half * half if size > 40.0 else 0.5 * (e + e / (e + 1.0))
    return value if x >= 0.0 else -value


def own_cosh(x):
    size = abs(x)
    half, e = own_exp(0.5 * size), own_exp(min(size, 40.0))
    return 0.5 * half * half if size > 40.0 else 0.5 * (e + 1.0 / e)


def own_tanh(x):
    e = own_expm1(min(2.0 * abs(x), 80.0))
    value = e / (e + 2.0)
    return value if x >= 0.0 else -value


# -- logarithms ----------------------------------------------------------------------------------


@apart
@rolled
def own_exponent(x):
    """n of x = m 2**n, m from sqrt(1/2) to sqrt(2), for 0 < x < infinity."""
    n = 0
    for i in range(1, len(BITS)):
        if x >= UP[i]:
            x, n = x * DOWN[i], n + BITS[i]
        elif x < DOWN[i]:
            x, n = x * UP[i], n - BITS[i]
    while x < 0.7071067811865476:
        x, n = x * 2.0, n - 1
    while x >= 1.4142135623730951:
        x, n = x * 0.5, n + 1
    return n


@apart
def own_log1p_rest(f):
    """ln(1 + f), for 1 + f from sqrt(1/2) to sqrt(2)."""
    s = f / (2.0 + f)
    square, half = s * s, 0.5 * f * f
    return f - (half - s * (half + square * own_polynomial(ARTANH, square)))


@apart
def own_log(x):
    if not x > 0.0:
        return -np.inf if x == 0.0 else np.nan
    if not x < np.inf:
        return x
    n = own_exponent(x)
    half = int(-0.5 * n)
    k, m = float(n), x * own_power_of_two(half) * own_power_of_two(-n - half)
    return k * LN2[0] + (own_log1p_rest(m - 1.0) + k * LN2[1])


def own_log1p(x):
    if -0.29 < x < 0.41:
        return own_log1p_rest(x)
    whole = 1.0 + x
    return own_log(whole) + (x - (whole - 1.0)) / whole if 0.0 < whole < np.inf else own_log(whole)


@apart
def own_pow(x, y):
    """x**y of a positive x, or of 0."""
    if y == 0.0:
        return 1.0
    if x == 0.0:
        return 0.0 if y > 0.0 else np.inf
    return own_exp(y * own_log(x))


def own_asinh(x):
    size = abs(x)
    value = (
        own_log(2.0 * size)
        if size > 1e9
        else own_log1p(size + size * size / (1.0 + math.sqrt(1.0 + size * size)))
    )
    return value if x >= 0.0 else -value


def own_acosh(x):
    above = x - 1.0
    return (
        own_log(2.0 * x) if x > 1e9 else own_log1p(above + math.sqrt(2.0 * above + above * above))
    )


def own_atanh(x):
    size = abs(x)
    value = 0.5 * own_log1p(2.0 * size / (1.0 - size))
    return value if x >= 0.0 else -value


# -- arcs ----------------------------------------------------------------------------------------


@apart
def own_atan(x):
    size = abs(x)
    y = 1.0 / size if size > 1.0 else size
    turned = y > 0.4142135623730951
    if turned:
        y = (y - 1.0) / (y + 1.0)
    square = y * y
    value = y + y * (square * own_polynomial(ARCTANGENT, square))
    if turned:
        value = 0.7853981633974483 + (value + 3.061616997868383e-17)
    if size > 1.0:
        value = 1.5707963267948966 - (value - 6.123233995736766e-17)
    return value if x >= 0.0 else -value


def own_asin(x):
    return own_atan(x / math.sqrt((1.0 - x) * (1.0 + x)))


def own_acos(x):
    return 2.0 * own_atan(math.sqrt((1.0 - x) / (1.0 + x)))
