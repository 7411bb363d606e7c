"""Texts that are printed for numbers with derivatives: the same bits, and the derivatives beside.

None of them is one that the printer was written for. Derivatives are compared with those of closed
forms, and with differences of forty digits.
"""

import math

import mpmath
import numpy as np
import pytest

from rockeom.compiler.parsed import Refused, Text
from rockeom.compiler.printer import Program
from rockeom.compiler.types import WIDTH
from tests.machine_code import HEAD, RULES, functions

KEPLER = """
def eccentric_anomaly(m, e):
    x = m
    for _ in range(60):
        move = (x - e * math.sin(x) - m) / (1.0 - e * math.cos(x))
        x -= move
        if abs(move) < 1e-15:
            break
    return x

@entry
def run(x: Duals, out: Duals):
    out[0] = eccentric_anomaly(x[0], x[1])

@entry
def plain(x: Floats, out: Floats):
    out[0] = eccentric_anomaly(x[0], x[1])
"""

DETERMINANT = """
@entry
def run(x: Duals, out: Duals):
    m = np.zeros((3, 3))
    for i in range(3):
        for j in range(3):
            m[i, j] = x[3 * i + j]
    sign = 1
    for c in range(3):
        best = c
        for r in range(c + 1, 3):
            if abs(m[r, c]) > abs(m[best, c]):
                best = r
        if best != c:
            sign = -sign
            for j in range(3):
                m[c, j], m[best, j] = m[best, j], m[c, j]
        for r in range(c + 1, 3):
            share = m[r, c] / m[c, c]
            for j in range(c, 3):
                m[r, j] -= share * m[c, j]
    out[0] = sign * m[0, 0] * m[1, 1] * m[2, 2]
"""

CHOICES = """
def pair(a, b):
    return (a, 3), b

@entry
def run(x: Duals, out: Duals):
    (a, n), b = pair(x[0], -x[1])
    out[0] = max(a, b, 0.25)
    out[1] = min(a, 1, b)
    out[2] = abs(b) * n - a / 2
    out[3] = a if a > b else b * b
    out[4] = float(int(10.0 * a)) + 2.0 / b
    out[5] = value(a) * a + rate(moving(b, 4.0) ** 3)
    z = out[:2]
    z[1] += a ** 5
    out[6] = x[0] ** 2.5
"""


def dual(values, along):
    out = np.zeros((len(values), 1 + WIDTH))
    out[:, 0] = values
    out[:, 1 : 1 + np.shape(along)[1]] = along
    return out


def of_duals(text):
    return functions(HEAD + text, contract=False, more=RULES[:1])


def test_root_that_a_loop_finds_has_the_derivatives_of_the_equation():
    """Kepler's: m = x - e sin(x); dx/dm = 1/(1 - e cos(x)), dx/de = sin(x) of that."""
    run = of_duals(KEPLER)
    for m, e in ((0.3, 0.2), (2.5, 0.6), (5.0, 0.05)):
        out, plain = np.zeros((1, 1 + WIDTH)), np.zeros(1)
        run["run"](dual([m, e], np.eye(2)), out)
        run["plain"](np.array([m, e]), plain)
        x = out[0, 0]
        assert x == plain[0]  # the derivatives take no bit of it away
        slope = 1 / (1 - e * math.cos(x))
        assert out[0, 1:3] == pytest.approx([slope, slope * math.sin(x)], rel=1e-13)
        assert not out[0, 3:].any()


def test_determinant_has_the_derivatives_of_jacobis_formula():
    run = of_duals(DETERMINANT)["run"]
    rng = np.random.default_rng(3)
    for _ in range(10):
        a, along = rng.normal(size=(3, 3)), rng.normal(size=(9, WIDTH))
        out = np.zeros((1, 1 + WIDTH))
        run(dual(a.ravel(), along), out)
        jacobi = [np.linalg.det(a) * np.trace(np.linalg.solve(a, d.reshape(3, 3))) for d in along.T]
        assert out[0, 0] == pytest.approx(np.linalg.det(a), rel=1e-12)
        assert out[0, 1:] == pytest.approx(jacobi, rel=1e-9)


def test_choices_tuples_and_parts_of_arrays_keep_derivatives():
    run = of_duals(CHOICES)["run"]
    a, b = 1.75, -0.5  # of x[1] it is -b
    out = np.zeros((7, 1 + WIDTH))
    run(dual([a, -b], np.eye(2)), out)
    values = [a, b + a**5, -3 * b - a / 2, a, 17 + 2 / b, a * a + 3 * b * b * 4, a**2.5]
    slopes = [
        [1, 0], [5 * a**4, -1], [-0.5, 3], [1, 0], [0, 2 / b**2], [a, 0], [2.5 * a**1.5, 0],
    ]  # fmt: skip
    assert out[:, 0] == pytest.approx(values, rel=1e-15)
    assert out[:, 1:3] == pytest.approx(np.array(slopes), rel=1e-14)


@pytest.mark.parametrize(
    ("name", "places"),
    [
        *((n, (0.3, -1.2)) for n in ("sin", "cos", "exp", "expm1", "tan", "atan", "sinh", "cosh")),
        *((n, (0.3, -0.6)) for n in ("tanh", "asinh", "asin", "acos", "atanh")),
        *((n, (0.7, 2.6)) for n in ("sqrt", "log", "log1p")),
        ("acosh", (1.5, 3.0)),
    ],
)
def test_function_of_the_library_has_the_slope_of_forty_digits(name, places):
    run = of_duals(f"""
@entry
def run(x: Duals, out: Duals):
    out[0] = math.{name}(x[0] * 1.5) * x[0]
""")["run"]
    with mpmath.workdps(40):
        for x in (p / 1.5 for p in places):
            out = np.zeros((1, 1 + WIDTH))
            run(dual([x], [[1.0]]), out)
            slope = mpmath.diff(lambda z: getattr(mpmath, name)(z * mpmath.mpf(1.5)) * z, x)
            assert out[0, 1] == pytest.approx(float(slope), rel=1e-14)


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("plain[0] = x[0]", "number with derivatives where float is wanted"),
        ("out[0] = 2.0 ** x[0]", "an exponent has no derivatives"),
        ("out[0] = x[0] % 2.0", "Mod of number with derivatives"),
        ("out[0] = x[0] and x[1]", "a test is a bool"),
    ],
)
def test_what_would_lose_derivatives_is_refused_by_line(line, why):
    text = f"""
@entry
def run(x: Duals, plain: Floats, out: Duals):
    {line}
"""
    with pytest.raises(Refused, match=rf"a text.py, line 8, in run.*{why}"):
        Program([Text("a text.py", HEAD + text)])
