"""Embedded Runge-Kutta pairs, and the text of one step and of its dense output.

A tableau proves its order conditions when it is built. Writing a step out, each stage one line,
lets the compiler drop zero coefficients and keep the rest as constants.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from math import comb
from typing import Any

import numpy as np

from rockeom.integrator.methods.coefficients import PAIRS


@dataclass(frozen=True, eq=False)
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
    def coarse(self) -> float:
        """Estimated relative error of an equal step from which on it is not left as it is.

        An estimate of a much lower order than the method's says little of its error.
        """
        return 1e-7 if self.error_order + 1 >= self.order else 1e-3

    @property
    def degree(self) -> int:
        return self.dense.shape[1]

    @cached_property
    def twice(self) -> np.ndarray:
        """(m, m) a @ a: positions of the stages by accelerations, see `_stage`."""
        return product(self.a, self.a)


@cache
def tableau(name: str) -> Tableau:
    """The explicit pair of that name in coefficients.py."""
    if name not in PAIRS:
        raise ValueError(f"no method {name!r}; there are {' and '.join(map(repr, PAIRS))}")
    pair: Any = PAIRS[name]
    return _of_the_book(name, pair) if hasattr(pair, "D") else _plain(name, pair)


def _square(rows: np.ndarray, size: int) -> np.ndarray:
    full = np.zeros((size, size))
    full[: rows.shape[0], : rows.shape[1]] = rows
    return full


def _plain(name: str, r: Any) -> Tableau:
    """A pair whose dense output needs no other stages, P its weights."""
    a = _square(r.A, len(r.B) + 1)
    a[-1, :-1] = r.B
    c = np.append(r.C, 1.0)
    return Tableau(name, a, r.B, c, (r.E,), r.P, r.order, r.error_estimator_order)


def _of_the_book(name: str, r: Any) -> Tableau:
    """Hairer, Norsett and Wanner's (1993), with stages for the dense output of degree 7."""
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
    return Tableau(name, a, r.B, c, (r.E5, r.E3), dense, r.order, r.error_estimator_order)


# -- Bernstein form of a polynomial on a step ---------------------------------------------------

NODES = (1 - np.cos(np.pi * np.arange(8) / 7)) / 2
"""Where a guard is sampled in a step: 8 Chebyshev points, both ends among them."""


def bernstein_at(x: np.ndarray, degree: int) -> np.ndarray:
    """(m, degree + 1): the Bernstein polynomials at x (m,)."""
    powers = range(degree + 1)
    return np.array([comb(degree, i) * x**i * (1 - x) ** (degree - i) for i in powers]).T


def samples_to_bernstein() -> np.ndarray:
    """(8, 8): values at NODES -> Bernstein coefficients of the interpolating polynomial.

    Inverted exactly: an error in it is one in all guards.
    """
    nodes = [Fraction(x) for x in NODES.tolist()]
    rows = [[comb(7, i) * x**i * (1 - x) ** (7 - i) for i in range(8)] for x in nodes]
    unit = [[Fraction(int(n == j)) for j in range(8)] for n in range(8)]
    return np.array([[float(v) for v in row] for row in exact_solution(rows, unit)])


def exact_solution(
    matrix: list[list[Fraction]], right: list[list[Fraction]]
) -> list[list[Fraction]]:
    """The matrix x (n, m) with matrix x = right, by Gauss and Jordan."""
    size = len(matrix)
    rows = [[*row, *values] for row, values in zip(matrix, right, strict=True)]
    for n in range(size):
        pivot = next(m for m in range(n, size) if rows[m][n])
        rows[n], rows[pivot] = rows[pivot], rows[n]
        rows[n] = [v / rows[n][n] for v in rows[n]]
        for m in range(size):
            if m != n:
                rows[m] = [v - rows[m][n] * w for v, w in zip(rows[m], rows[n], strict=True)]
    return [row[size:] for row in rows]


def product(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """left @ right of coefficients, rounded once; 0 where nothing but their rounding is left."""
    rows, columns = left.tolist(), right.T.tolist()
    exact = np.array(
        [[float(sum(Fraction(x) * Fraction(y) for x, y in zip(r, c, strict=True) if x and y))
          for c in columns] for r in rows]
    )  # fmt: skip
    exact[np.abs(exact) < 2 * np.finfo(float).eps * (np.abs(left) @ np.abs(right))] = 0.0
    return exact


def powers_to_bernstein() -> np.ndarray:
    """(8, 8): coefficients of 1, x, ... x^7 -> Bernstein coefficients."""
    return np.array([[comb(i, j) / comb(7, j) for j in range(8)] for i in range(8)])


# -- the text of a step -------------------------------------------------------------------------


def _sum(weights: np.ndarray, name: str, indent: str) -> str:
    """sum_j weights[j] * name(j), the latest stage last: the others need not wait for it."""
    terms = [f"{w!r} * {name.format(j)}" for j, w in enumerate(weights.tolist()) if w]
    return f"\n{indent}+ ".join(terms)


def _moved(weights: np.ndarray, of: str, indent: str) -> str:
    """The velocity of a coordinate, by its accelerations in the stages before."""
    return _onwards(f"v0{of}", "h", weights, of, indent) + "\n"


def _onwards(start: str, unit: str, weights: np.ndarray, of: str, indent: str) -> str:
    """start + unit * sum_j weights[j] * a_j: a product and a sum behind the latest stage.

    All else is found while that one is still worked on.
    """
    last = int(np.flatnonzero(weights)[-1])
    text = start
    if weights[:last].any():
        more = indent + "    "
        text += f" + {unit} * (\n{more}{_sum(weights[:last], f'a{{}}{of}', more)}\n{indent})"
    return f"({text}) + ({unit} * {weights.tolist()[last]!r}) * a{last}{of}"


def _moves(method: Tableau, j: int, of: str, indent: str) -> str:
    """Velocity v and position q of one coordinate at a stage; `of` stands behind their names."""
    moved = f"{indent}v{j}{of} = " + _moved(method.a[j, :j], of, indent)
    place = f"(q0{of} + {float(method.c[j])!r} * (h * v0{of}))"
    if method.twice[j].any():
        place = _onwards(place, "hh", method.twice[j], of, indent)
    return f"{moved}{indent}q{j}{of} = {place}\n"


def _stage(
    method: Tableau,
    j: int,
    n: int,
    ground: str,
    accelerations: str = "accelerations",
    mode: str = "mode",
    still: Sequence[int] = (),
) -> str:
    """Positions q, velocities v and accelerations a of a stage.

    ground : accelerations of the ground, found before the step. accelerations : what finds those
    of the coordinates. still : coordinates that do not move.
    Positions follow from the accelerations of all stages but the one just before, whose weight is
    zero (Nystrom's form): so the sines of a stage are found while that one is still worked on.
    """
    text = "".join(_moves(method, j, f"_{i}", "    ") for i in range(n) if i not in still)
    text += "".join(f"    q{j}_{i}, v{j}_{i} = q0_{i}, v0_{i}\n" for i in still)
    states = ", ".join([f"q{j}_{i}" for i in range(n)] + [f"v{j}_{i}" for i in range(n)])
    names = ", ".join(f"a{j}_{i}" for i in range(n))
    return f"""{text}    ({names},) = {accelerations}(
        {mode}, {states}, p, {ground}
    )
"""


def method_header(method: Tableau, stages: int, all_stages: int) -> str:
    """The constants that the loop wants of every method."""
    return f'''import numpy as np

METHOD = "{method.name}"
N_STAGES = {stages}
N_ALL_STAGES = {all_stages}
DEGREE = {method.degree}
STAGE_TIMES = np.array({method.c.tolist()!r})  # in the length of a step
ERROR_EXPONENT = {-1.0 / (method.error_order + 1)!r}
COARSE = {method.coarse!r}  # estimated relative error above which an equal step is refused
SAMPLES_TO_BERNSTEIN = np.array({samples_to_bernstein().tolist()!r})
POWERS_TO_BERNSTEIN = np.array({powers_to_bernstein().tolist()!r})
NODES = np.array({NODES.tolist()!r})
QUINTIC = np.array({bernstein_at(NODES, 5).tolist()!r})  # at the nodes: values of a quintic
QUARTIC = np.array({bernstein_at(NODES, 4).tolist()!r})  # and of its slope, by coefficients
'''


def error_text(
    method: Tableau,
    n: int,
    of: Sequence[int] | None = None,
    still: Sequence[int] = (),
    in_lanes: bool = False,
) -> str:
    """Lines that find `error`, the norm of the estimates of the error.

    of : the coordinates that have one; None for all n. still : those of them that do not move, and
    whose error is none. in_lanes : divide and take roots as seldom as can be, which is most of the
    work where vectors do all else; tolerances may then not be below 1e-150.

    Both estimates of DOP853 make one (Hairer's combination of the fifth and the third order). The
    fifth has a zero of its own: for a mode that decays with h lambda = -5.65, well within the
    region of stability, it vanishes while the step is wrong by a quarter of the mode. So where
    h lambda, of the last two stages at the end of the step, is beyond 5.3, the error is not less
    than half of the third, by which what is left of it was seen to be bounded there.
    """
    s = method.stages
    two = len(method.errors) == 2
    lines = "".join(f"    s{m} = 0.0\n" for m in range(len(method.errors)))
    lines += "    d_rate = d_state = 0.0\n" if two else ""
    by_accelerations = [product(e[None], method.a[: s + 1, : s + 1])[0] for e in method.errors]
    chosen = range(n) if of is None else of
    size = "N_STATES" if of is None else str(2.0 * len(of))
    moving = [i for i in chosen if i not in still]
    if in_lanes:
        for i in moving:
            of_place = f"atol[{i}] + rtol * max(abs(q0_{i}), abs(q{s}_{i}))"
            of_rate = f"atol[{n + i}] + rtol * max(abs(v0_{i}), abs(v{s}_{i}))"
            lines += f"    scale_{n + i}, scale_{i} = {of_place}, {of_rate}\n"
            lines += f"    inverse = 1.0 / (scale_{i} * scale_{n + i})\n"
            lines += f"    scale_{i} *= inverse\n    scale_{n + i} *= inverse\n"
    for i in [*moving, *(n + i for i in moving)]:
        place, rate = (
            (f"q{{}}_{i}", f"v{{}}_{i}") if i < n else (f"v{{}}_{i - n}", f"a{{}}_{i - n}")
        )
        largest = f"max(abs({place.format(0)}), abs({place.format(s)}))"
        scale = f"scale_{i}" if in_lanes else f"1.0 / (atol[{i}] + rtol * {largest})"
        lines += f"    scale = {scale}\n"
        for m, e in enumerate(by_accelerations if i < n else method.errors):
            unit = "h * scale" if i < n else "scale"
            terms = _sum(e, f"a{{}}_{i % n}", " " * 8)
            lines += f"    e = {unit} * (\n        {terms}\n    )\n"
            lines += f"    s{m} += e * e\n"
        if two and i >= n:
            for name, what in (("d_rate", rate), ("d_state", place)):
                lines += f"    e = scale * ({what.format(s)} - {what.format(s - 1)})\n"
                lines += f"    {name} += e * e\n"
    if not two:
        return lines + f"    error = abs(h) * math.sqrt(s0 / {size})\n"
    lines += f"""    both = (s0 + 0.01 * s1) * {size}
    stiff = h * h * d_rate > {5.3**2!r} * d_state and d_state > 0.01 * h * h * s1
"""
    if in_lanes:
        return f"""{lines}    square = s0 * s0 / both if s0 != 0.0 else 0.0
    square = max(square, 0.25 / {size} * s1) if stiff else square
    error = abs(h) * math.sqrt(square)
"""
    return f"""{lines}    error = abs(h) * s0 / math.sqrt(both) if s0 != 0.0 else 0.0
    error = max(error, 0.5 * abs(h) * math.sqrt(s1 / {size})) if stiff else error
"""


_STEP_ARGUMENTS = "t, h, y, p, ground, rtol, atol, k, y_new"
_SHAKING = "*shaking_at(k, GROUND + {}, N_ALL_STAGES)"


def _step_body(
    method: Tableau,
    n: int,
    mode: str,
    errors: str,
    function: str = "accelerations",
    still: Sequence[int] = (),
) -> str:
    """Lines of a step in a mode, stage by stage, each written out.

    errors : lines that find its error. function : gives the accelerations. still : the coordinates
    that do not move.
    """
    s, size = method.stages, 2 * n
    start = "".join(f"    q0_{i} = y[{i}]\n    v0_{i} = y[{n + i}]\n" for i in range(n))
    start += "".join(f"    a0_{i} = k[{n + i}]\n" for i in range(n))
    stages = "".join(
        _stage(method, j, n, _SHAKING.format(j), function, mode, still) for j in range(1, s + 1)
    )
    ends = "".join(f"    y_new[{i}] = q{s}_{i}\n    y_new[{n + i}] = v{s}_{i}\n" for i in range(n))
    ends += "".join(f"    k[{s * size + i}] = v{s}_{i}\n" for i in range(n))
    ends += "".join(
        f"    k[{j * size + n + i}] = a{j}_{i}\n" for j in range(1, s + 1) for i in range(n)
    )
    return f"""    ground_at_stages(ground, t, h, 1, N_STAGES + 1, k, GROUND)
    hh = h * h
{start}{stages}{ends}{errors}    return error
"""


def _quick_steps(
    method: Tableau, n: int, rotation: int, quick: Sequence[tuple[int, int]]
) -> tuple[str, str]:
    """Lines of `take_step` that pass some modes to steps of their own, and these functions."""
    branches = functions = ""
    for m, moves in quick:
        branches += f"""    if EQUATIONS[mode] == {m}:
        return quick_step_{m}(mode, {_STEP_ARGUMENTS})
"""
        body = _step_body(method, n, "mode", error_text(method, n, [moves]), f"accelerations_{m}")
        functions += f'''

def quick_step_{m}(mode, {_STEP_ARGUMENTS}):
    """`take_step` by one set of equations."""
{body}'''
    if n > 1:  # a structure of one coordinate takes no steps in full contact
        branches += f"""    if FULL_CONTACT >= 0:
        if mode == FULL_CONTACT:
            return full_contact_step({_STEP_ARGUMENTS})
"""
        errors = error_text(method, n, still=[rotation])
        functions += f'''

def full_contact_step({_STEP_ARGUMENTS}):
    """`take_step` on both feet, where little of the equations is left."""
{_step_body(method, n, "FULL_CONTACT", errors, still=[rotation])}'''
    return branches, functions


def step_text(
    method: Tableau, n: int, rotation: int = 0, quick: Sequence[tuple[int, int]] = ()
) -> str:
    """Source of `take_step`, `dense_output` and the constants of a method, for n coordinates.

    Numbers are plain variables; the rates of all stages are left in an array only for the dense
    output.

    rotation : the coordinate that does not move in full contact.
    quick : equations of the structure that have steps of their own, each with the coordinate that
    the others follow: nothing is worked out that its acceleration does not ask for, and the error
    is that of this coordinate.
    """
    branches, functions = _quick_steps(method, n, rotation, quick)
    provided = ["EQUATIONS", "FULL_CONTACT", "N_STATES", "accelerations"]
    provided += [f"accelerations_{m}" for m, _ in quick]
    return f'''import math

from rockeom.integrator.ground import ground_at_stages, shaking_at
from rockeom.integrator.provided import {", ".join(provided)}
{method_header(method, method.stages, len(method.c))}
GROUND = N_ALL_STAGES * N_STATES  # place behind the rates: the ground at each stage


def take_step(mode, {_STEP_ARGUMENTS}):
    """One step from y at t, into y_new. k: the rates of stage j begin at j * N.

    The accelerations of stage 0 are known; those of stage N_STAGES are at the new state.
    Returns the norm of the estimated error, 1 at the tolerance.
    """
{branches}{_step_body(method, n, "mode", error_text(method, n))}{functions}

{_dense_text(method, n)}'''


def _dense_text(method: Tableau, n: int) -> str:
    """Source of `dense_output`, where what is done with each coordinate is a loop over them.

    It is not called in every step, and shorter so. The velocities of the stages are found once
    more: weights of accelerations alone would be ten times as large, and so would be the rounding
    errors.
    """
    s, size, total = method.stages, 2 * n, len(method.c)
    one = "        "

    def recalled(rate: str, stages: Sequence[int], first: int) -> str:
        return "".join(f"{one}{rate}{j} = k[{j * size + first} + i]\n" for j in stages)

    start = f"    for i in range({n}):\n{one}q0, v0 = y[i], y[{n} + i]\n"
    states = ", ".join(f"w[{i}]" for i in range(size))
    stages = ""
    for j in range(s + 1, total):
        names = ", ".join(f"k[{j * size + n + i}]" for i in range(n))
        stages += start + recalled("a", range(j), n) + _moves(method, j, "", one)
        stages += f"{one}w[i], w[{n} + i], k[{j * size} + i] = q{j}, v{j}, v{j}\n"
        stages += f"""    ({names},) = accelerations(
        mode, {states}, p, {_SHAKING.format(j)}
    )
"""
    powers = start + recalled("a", range(total), n) + recalled("v", range(s + 1, total), 0)
    powers += "".join(f"{one}v{j} = " + _moved(method.a[j, :j], "", one) for j in range(1, s + 1))
    for first, at, rate in ((0, "q0", "v{}"), (n, "v0", "a{}")):
        powers += f"{one}coefficients[{first} + i] = {at}\n"
        for j in range(1, 8):
            coefficient = "0.0"
            if j <= method.degree:
                terms = _sum(method.dense[:, j - 1], rate, one + "    ")
                coefficient = f"h * (\n{one}    {terms}\n{one})"
            powers += f"{one}coefficients[{j * size + first} + i] = {coefficient}\n"
    return f'''
def dense_output(mode, t, h, y, p, ground, k, coefficients):
    """Coefficients (8 * N,) of the powers of x = (time - t)/h over the step just taken."""
    ground_at_stages(ground, t, h, N_STAGES + 1, N_ALL_STAGES, k, GROUND)
    hh = h * h
    w = np.empty({size})  # the state of a stage
{stages}{powers}'''
