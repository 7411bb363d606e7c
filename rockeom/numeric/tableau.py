"""Embedded Runge-Kutta pairs, and the text of one step and of its dense output.

The coefficients are SciPy's (`scipy.integrate.DOP853`, `RK45`); a tableau proves its order
conditions when it is built. Writing a step out, each stage one line, lets the compiler drop
zero coefficients and keep the rest as constants.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy import integrate


@dataclass(frozen=True)
class Tableau:
    """An explicit pair with dense output.

    a (m, m), c (m,) : all stages, those that only the dense output needs last.
    b (s,) : weights of the new state; stage s is the rate there (first same as last).
    errors : one or two (s + 1,) weights of the error estimate, see `error_text`.
    dense (m, d) : y(t + x h) = y + h sum_j x**(j+1) sum_i dense[i, j] k_i.
    order : of the new state; error_order : exponent of the step control.
    """

    name: str
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    errors: tuple[np.ndarray, ...]
    dense: np.ndarray
    order: int
    error_order: int

    def __post_init__(self) -> None:
        stages = len(self.b)
        a, b, c = self.a, self.b, self.c
        if not np.allclose(a.sum(axis=1), c, atol=1e-13):
            raise ValueError(f"{self.name}: rows of a do not sum to c")
        for k in range(1, self.order + 1):  # quadrature conditions
            if abs(b @ c[:stages] ** (k - 1) - 1 / k) > 1e-13:
                raise ValueError(f"{self.name}: sum b c^{k - 1} is not 1/{k}")
        for k in range(1, self.order):  # one family of tall trees: sum b_i a_ij c_j^(k-1)
            tall = b @ a[:stages, :stages] @ c[:stages] ** (k - 1)
            if abs(tall - 1 / (k * (k + 1))) > 1e-13:
                raise ValueError(f"{self.name}: sum b a c^{k - 1} is not 1/{k * (k + 1)}")
        ends = self.dense.sum(axis=1)
        if not np.allclose(ends[:stages], b, atol=1e-12) or np.abs(ends[stages:]).max() > 1e-12:
            raise ValueError(f"{self.name}: the dense output does not end at the new state")

    @property
    def stages(self) -> int:
        return len(self.b)

    @property
    def degree(self) -> int:
        return self.dense.shape[1]


@cache
def tableau(name: str) -> Tableau:
    """The pair of that name, "DOP853" (order 8) or "RK45" (order 5)."""
    if name == "RK45":
        return _rk45()
    if name == "DOP853":
        return _dop853()
    raise ValueError(f"no method {name!r}; there are 'DOP853' and 'RK45'")


def _square(rows: np.ndarray, size: int) -> np.ndarray:
    full = np.zeros((size, size))
    full[: rows.shape[0], : rows.shape[1]] = rows
    return full


def _rk45() -> Tableau:
    """Dormand and Prince (1980) 5(4), dense output of degree 4 by Shampine (1986)."""
    r = integrate.RK45
    a = _square(r.A, 7)
    a[6, :6] = r.B
    return Tableau("RK45", a, r.B, np.append(r.C, 1.0), (r.E,), r.P, 5, 4)


def _dop853() -> Tableau:
    """Hairer, Norsett and Wanner (1993) 8(5,3), dense output of degree 7."""
    r = integrate.DOP853
    a = _square(r.A, 16)
    a[12, :12] = r.B
    a[13:, :] = r.A_EXTRA
    c = np.concatenate([r.C, [1.0], r.C_EXTRA])
    # the book's form y + F0 x + F1 x(1-x) + F2 x^2(1-x) + ..., turned into powers of x
    weights = np.zeros((7, 16))
    weights[0, :12] = r.B
    weights[1] = -weights[0]
    weights[1, 0] += 1.0
    weights[2] = 2 * weights[0]
    weights[2, 0] -= 1.0
    weights[2, 12] -= 1.0
    weights[3:] = r.D
    dense = np.zeros((16, 7))
    basis = np.polynomial.Polynomial([1.0])
    for i in range(7):
        basis = basis * np.polynomial.Polynomial([0.0, 1.0] if i % 2 == 0 else [1.0, -1.0])
        dense[:, : len(basis.coef) - 1] += np.outer(weights[i], basis.coef[1:])
    return Tableau("DOP853", a, r.B, c, (r.E5, r.E3), dense, 8, 7)


# -- Bernstein form of a polynomial on a step ---------------------------------------------------

NODES = (1 - np.cos(np.pi * np.arange(8) / 7)) / 2
"""Where a guard is sampled in a step: 8 Chebyshev points, both ends among them."""


def _bernstein_at(x: np.ndarray, degree: int) -> np.ndarray:
    from scipy.special import comb

    i = np.arange(degree + 1)
    x = np.asarray(x, dtype=float)[:, None]
    return comb(degree, i) * x**i * (1 - x) ** (degree - i)


def samples_to_bernstein() -> np.ndarray:
    """(8, 8): values at NODES -> Bernstein coefficients of the interpolating polynomial."""
    matrix = np.linalg.inv(_bernstein_at(NODES, 7))
    matrix[0], matrix[-1] = np.eye(8)[0], np.eye(8)[-1]  # the ends are exact
    return matrix


def powers_to_bernstein() -> np.ndarray:
    """(8, 8): coefficients of 1, x, ... x^7 -> Bernstein coefficients."""
    from scipy.special import comb

    return np.array([[comb(i, j) / comb(7, j) for j in range(8)] for i in range(8)])


# -- the text of a step -------------------------------------------------------------------------


def _sum(weights: np.ndarray, indent: str) -> str:
    terms = [f"{w!r} * k[{i}, i]" for i, w in enumerate(weights.tolist()) if w]
    return f"\n{indent}+ ".join(terms)


def _stage(i: int, row: np.ndarray, c: float) -> str:
    return f"""    for i in range(N_STATES):
        w[i] = y[i] + h * (
            {_sum(row, " " * 12)}
        )
    tau = t + {c!r} * h
    rates(contact, w, p, ground(gx, tau), ground(gy, tau), k[{i}])
"""


def step_text(method: Tableau) -> str:
    """Source of `take_step`, `dense_output` and the constants of a method."""
    s = method.stages
    stages = "".join(_stage(i, method.a[i], float(method.c[i])) for i in range(1, s))
    extra = "".join(_stage(i, method.a[i], float(method.c[i])) for i in range(s + 1, len(method.c)))
    sums = "".join(
        f"""        e{n} = (
            {_sum(e, " " * 12)}
        ) / scale
        s{n} += e{n} * e{n}
"""
        for n, e in enumerate(method.errors)
    )
    if len(method.errors) == 2:
        # Hairer's combination of the fifth- and third-order estimates
        norm = """    if s0 == 0.0 and s1 == 0.0:
        return 0.0
    return abs(h) * s0 / math.sqrt((s0 + 0.01 * s1) * N_STATES)
"""
        start = "    s0 = s1 = 0.0\n"
    else:
        norm = "    return abs(h) * math.sqrt(s0 / N_STATES)\n"
        start = "    s0 = 0.0\n"
    dense = "".join(
        f"""        coefficients[{j + 1}, i] = h * (
            {_sum(method.dense[:, j], " " * 12)}
        )
"""
        for j in range(method.degree)
    )
    return f'''

METHOD = "{method.name}"
N_STAGES = {s}
N_ALL_STAGES = {len(method.c)}
DEGREE = {method.degree}
ERROR_EXPONENT = {-1.0 / (method.error_order + 1)!r}
SAMPLES_TO_BERNSTEIN = np.array({samples_to_bernstein().tolist()!r})
POWERS_TO_BERNSTEIN = np.array({powers_to_bernstein().tolist()!r})
NODES = np.array({NODES.tolist()!r})


@_compiled
def take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, w, y_new):
    """One step from y at t; k[0] holds the rate there, k[N_STAGES] that at the new state.

    Returns the norm of the estimated error, 1 at the tolerance.
    """
{stages}    for i in range(N_STATES):
        y_new[i] = y[i] + h * (
            {_sum(method.b, " " * 12)}
        )
    tau = t + h
    rates(contact, y_new, p, ground(gx, tau), ground(gy, tau), k[{s}])
{start}    for i in range(N_STATES):
        scale = atol[i] + rtol * max(abs(y[i]), abs(y_new[i]))
{sums}{norm}

@_compiled
def dense_output(contact, t, h, y, p, gx, gy, k, w, coefficients):
    """Coefficients (8, N) of the powers of x = (time - t)/h over the step just taken."""
{extra}    for i in range(N_STATES):
        coefficients[0, i] = y[i]
{dense}        for j in range(DEGREE + 1, 8):
            coefficients[j, i] = 0.0
'''
