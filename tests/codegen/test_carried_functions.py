"""Derivatives that generated functions carry, against those of the declaration.

From M q'' = F follows M dq'' = dF - dM q''. On one side dM and dF are those of SymPy's expressions
by complex steps (Squire and Trapp 1998), exact to rounding, and LAPACK solves; on the other side
the generated text calculates with numbers that carry derivatives, in Python and as machine code.
Nothing is shared but the expressions.
"""

import copy
import functools

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codes import IMPULSIVE
from rockeom.compiler.types import WIDTH
from rockeom.numbers.functions import of_compounds
from rockeom.structures.classes import SHIPPED
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from tests.codegen.test_generated_functions import JUMPS, STRUCTURES, Sample, model, module
from tests.evaluation import Values
from tests.machine_code import HEAD, RULES, functions
from tests.shipped import PINNED, plain

STATES, STEP = 10, 1e-30
TOLERANCE = 1e-11

ENTRIES = """
@entry
def carried_rates(mode: int, y: Duals, p: Duals, a: Duals, dy: Duals):
    rates(mode, y, p, a[0], a[1], dy)

@entry
def carried_guards(mode: int, y: Duals, p: Duals, a: Duals, g: Duals):
    guards(mode, y, p, a[0], a[1], g)
"""
JUMP = """
@entry
def carried_jump(
    mode: int, guard: int, law: int, ratio: Duals, y: Duals, p: Duals, after: Duals
) -> int:
    return jump(mode, guard, law, ratio[0], y, p, after)
"""


@functools.cache
def compiled(name):
    jumps = JUMP if name in PINNED else ""
    return functions(HEAD + ENTRIES + jumps, module(name), more=RULES)


class Carried:
    """Random states of a mode, each with a direction in which all of it changes."""

    def __init__(self, name, mode_name, at=None):
        self.name, self.mode_name = name, mode_name
        self.at = at = at or Sample(name, mode_name, STATES)
        rng = np.random.default_rng(7)
        self.dy = np.where(at.y.any(axis=1, keepdims=True), rng.normal(size=at.y.shape), 0.0)
        self.da = rng.normal(size=(2, STATES))
        self.dp = {k: v * rng.normal(size=STATES) for k, v in at.parameters.items()}
        self.moved = self.beside(at)

    def beside(self, at):
        """A sample, by an imaginary step along the direction."""
        moved = copy.copy(at)
        step = 1j * STEP
        moved.y = at.y + step * self.dy
        moved.ax, moved.ay = at.ax + step * self.da[0], at.ay + step * self.da[1]
        moved.parameters = {k: v + step * self.dp[k] for k, v in at.parameters.items()}
        return moved

    def slopes(self, *expressions):
        """(k, n): derivatives of expressions of the model."""
        return self.moved.values(*expressions).imag / STEP

    def accelerations(self):
        """(d, n) q'', its derivative, and of what size the terms are that the latter is made of."""
        equations, d = self.at.model.equations(self.mode_name), len(self.at.mode.coordinates)
        found = self.moved.values(*equations.mass_matrix, *equations.forcing)
        matrix = np.moveaxis(found[: d * d].reshape(d, d, STATES), -1, 0)
        force = found[d * d :].T
        q = np.linalg.solve(matrix.real, force.real[..., None])[..., 0]
        terms = (force.imag / STEP)[..., None], (matrix.imag / STEP) @ q[..., None]
        dq = np.linalg.solve(matrix.real, terms[0] - terms[1])[..., 0]
        inverse = np.abs(np.linalg.inv(matrix.real))
        size = inverse @ (np.abs(terms[0]) + np.abs(terms[1]))
        return q.T, dq.T, size[..., 0].T

    @functools.cached_property
    def duals(self):
        """Of each state y, p and (ax, ay), of numbers with one derivative."""
        at, names = self.at, module(self.name).PARAMETERS
        given = np.array([at.parameters[k] for k in names]), np.array([self.dp[k] for k in names])
        prepare = of_compounds(module(self.name)).prepare
        return [
            (
                with_slopes(at.y[:, i], self.dy[:, i]),
                prepare(with_slopes(given[0][:, i], given[1][:, i])),
                with_slopes([at.ax[i], at.ay[i]], self.da[:, i]),
            )
            for i in range(STATES)
        ]

    def carried(self, function, length):
        """(length, n) derivatives of a generated function: in Python, and in machine code."""
        number = module(self.name).MODES.index(self.mode_name)
        plain = getattr(of_compounds(module(self.name)), function)
        machine = compiled(self.name)[f"carried_{function}"]
        found = np.empty((2, length, STATES))
        for i, (y, p, a) in enumerate(self.duals):
            out, dense = np.zeros(length, dtype=object), np.zeros((length, 1 + WIDTH))
            plain(number, y, p, a[0], a[1], out)
            found[0, :, i] = slopes_of(out)
            machine(number, *map(in_memory, (y, p, a)), dense)
            found[1, :, i] = dense[:, 1]
            assert not dense[:, 2:].any()
        return found


def with_slopes(values, along):
    found = np.empty(len(values), dtype=object)
    found[:] = [rk.Dual(float(v), [d]) for v, d in zip(values, along, strict=True)]
    return found


def slopes_of(array):
    return [x.tangent[0] if isinstance(x, rk.Dual) else 0.0 for x in array]


def in_memory(array):
    """As the program takes them: each number, and WIDTH derivatives behind it."""
    found = np.zeros((len(array), 1 + WIDTH))
    found[:, 0] = [x.value if isinstance(x, rk.Dual) else x for x in array]
    found[:, 1] = slopes_of(array)
    return found


def assert_carried(what, found, expected, size):
    for way, rows in zip(("in Python", "as machine code"), found, strict=True):
        excess = np.abs(rows - expected) / np.maximum(size, 1e-300)
        assert excess.max() <= TOLERANCE, f"{what} {way}: {excess.max():.1e} of its terms' size"


@functools.cache
def cases(name):
    return [Carried(name, mode_name) for mode_name in model(name).mode_names]


@STRUCTURES
def test_accelerations(name):
    for case in cases(name):
        coordinates = case.at.model.coordinates
        found = case.carried("rates", 2 * len(coordinates))
        _, slope, size = case.accelerations()
        for c, expected, scale in zip(case.at.mode.coordinates, slope, size, strict=True):
            row = coordinates.index(c)
            half = len(coordinates)
            assert_carried(f"{c.name}'' in {case.mode_name}", found[:, half + row], expected, scale)
            assert_carried(
                f"{c.name}' in {case.mode_name}", found[:, row], case.dy[half + row], 1.0
            )


@STRUCTURES
def test_guards(name):
    m = module(name)
    for case in cases(name):
        found = case.carried("guards", m.N_GUARDS + m.N_PARTS)
        leaving = [t for t in case.at.model.transitions if t.source == case.mode_name]
        for row, t in enumerate(leaving):
            if t.kind == "uplift":  # how it would open in the state that follows
                opened = Sample(name, t.target, STATES)
                opened.y, opened.parameters = case.at.y, case.at.parameters
                opened.ax, opened.ay = case.at.ax, case.at.ay
                follows = Carried(name, t.target, opened)
                _, slopes, sizes = follows.accelerations()
                place = [c.name for c in opened.mode.coordinates].index(opened.model.rotation.name)
                expected, size = -opened.side * slopes[place], sizes[place]
            else:
                (expected,) = case.slopes(t.guard)
                size = np.abs(expected).max()
            assert_carried(f"{case.mode_name} to {t.target}", found[:, row], expected, size)


def landing(name, mode_name):
    """States at an impact, of structures from slender to squat, where the old foot cannot lift."""
    m, sample = module(name), Sample(name, mode_name, STATES)
    width = "alpha" if "alpha" in sample.parameters else "half_width"
    sample.parameters[width] *= np.linspace(1, 4, STATES)
    sample.y[m.ROTATION] = 0.0
    sample.y[m.ROTATION_RATE] = -sample.side * np.abs(sample.y[m.ROTATION_RATE])
    return sample


@pytest.mark.parametrize(("name", "law"), JUMPS)
def test_jump(name, law):
    """Of each impact, by the closed form of the impulse map, or by a ratio that changes, too."""
    m, (ratio, by) = module(name), (0.7, 0.3)
    for t in (t for t in model(name).transitions if t.kind == "impact"):
        case = Carried(name, t.source, landing(name, t.source))
        expected = {target: case.dy.copy() for target in (t.target, t.fallback)}
        for target, slopes in expected.items():
            if law == IMPULSIVE:
                slopes[m.ROTATION_RATE] = 0.0
                impulse = model(name).impulse_map(t.source, target)
                after = case.slopes(*impulse.velocities())
                for c, row in zip(impulse.coordinates, after, strict=True):
                    slopes[m.STATES.index(f"{c.name}_dot")] = row
            else:
                rates = case.at.y[m.ROTATION_RATE], case.dy[m.ROTATION_RATE]
                slopes[m.ROTATION_RATE] = by * rates[0] + ratio * rates[1]
            slopes[m.ROTATION] = 0.0
        for i, (y, p, _) in enumerate(case.duals):
            out, mode = np.zeros((m.N_STATES, 1 + WIDTH)), m.MODES.index(t.source)
            given = map(in_memory, (with_slopes([ratio], [by]), y, p))
            follows = compiled(name)["carried_jump"](mode, 0, law, *given, out)
            slopes = expected[m.MODES[follows]][:, i]
            np.testing.assert_allclose(
                out[:, 1], slopes, rtol=0, atol=TOLERANCE * np.abs(slopes).max()
            )


@STRUCTURES
def test_ratio_of_the_law_and_bound_of_falling(name):
    case, m = cases(name)[0], of_compounds(module(name))
    ratio = case.at.model.velocity_ratio
    for function, expr in (
        (m.velocity_ratio, sp.Integer(1) if ratio is None else ratio),
        (m.overturning, case.at.model.overturning),
    ):
        found = slopes_of([function(p) for _, p, _ in case.duals])
        (expected,) = case.slopes(expr)
        np.testing.assert_allclose(found, expected, rtol=TOLERANCE, atol=TOLERANCE)


# -- points that open, stick and slip ------------------------------------------------------------


def mode_accelerations(name, state, given):
    """(d, n) q'' = T z + tau of a mechanism, with M z = F of the motion its contacts leave it."""
    derived = model(name)
    mechanism = derived.modes.mode_of(state)
    known = Values(given | derived.modes.signs(state))

    def values(matrix):
        rows = [np.broadcast_to(known[sp.sympify(e)], (STATES,)) for e in matrix]
        shape = (*matrix.shape, STATES)
        return np.moveaxis(np.reshape(np.array(rows, complex), shape), -1, 0)

    found = values(mechanism.drift)
    if mechanism.independent:
        z = np.linalg.solve(values(mechanism.mass_matrix), values(mechanism.forcing))
        found = values(mechanism.motions) @ z + found
    return found[..., 0].T


@pytest.mark.parametrize("name", [name for name in SHIPPED if name not in PINNED])
def test_accelerations_while_points_stick_and_slip(name):
    m, derived, rng = module(name), model(name), np.random.default_rng(5)
    usual = rk.structure(name, **plain(name)).parameters()
    sizes = np.array([usual[k] * rng.uniform(0.9, 1.1, STATES) for k in m.PARAMETERS])
    d = len(derived.coordinates)
    drawn = [sizes, rng.uniform(-0.4, 0.4, (2 * d, STATES)), rng.uniform(-5, 5, (2, STATES))]
    along = [x * rng.normal(size=x.shape) for x in drawn]
    symbols = [
        *(x.symbol for x in derived.parameters), *(c.position for c in derived.coordinates),
        *(c.velocity for c in derived.coordinates), GROUND_X, GROUND_Y,
    ]  # fmt: skip
    moved = np.concatenate(drawn) + 1j * STEP * np.concatenate(along)
    given = dict(zip(symbols, moved, strict=True))
    for state in derived.modes.states:
        exact = mode_accelerations(name, state, given)
        for i, expected in enumerate(exact.T):
            p, y, a = (with_slopes(x[:, i], dx[:, i]) for x, dx in zip(drawn, along, strict=True))
            p, out = of_compounds(m).prepare(p), np.zeros((2 * d, 1 + WIDTH))
            number = m.MODES.index(state.name)
            compiled(name)["carried_rates"](number, *map(in_memory, (y, p, a)), out)
            for column, value in enumerate((expected.real, expected.imag / STEP)):
                size = np.abs(value).max()
                np.testing.assert_allclose(out[d:, column], value, rtol=0, atol=1e-10 * size)
