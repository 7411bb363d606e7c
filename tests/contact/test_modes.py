"""Which modes follow from a declaration, and how each moves.

Accelerations, normal forces and friction of every mode against one system of equations
solved by numpy (`tests.contact.kkt`), at random states that fit it and random parameters.
"""

import importlib
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codes import LANDING, LIFTING, SLIPPING, STICKING, SWITCH
from rockeom.modelling.declared import class_of_model
from rockeom.structures.searched_modes import Points
from rockeom.symbolic.algebra import inverted, tidy
from rockeom.symbolic.reactions import total_reaction
from tests.contact import declared, kkt

DECLARED = {
    "sliding_block": lambda: rk.derive("sliding_block"),
    "unequal_feet": declared.unequal_feet,
    "four_feet": declared.four_feet,
    "on_a_step": declared.on_a_step,
    "stacked_blocks": lambda: rk.derive("stacked_blocks"),
}
EACH = pytest.mark.parametrize("name", DECLARED)


@cache
def model(name: str):
    return DECLARED[name]()


@cache
def module(name: str):
    if name in rk.models():  # what is generated is what is derived: another test compares them
        return importlib.import_module(f"rockeom.generated.{name}")
    return class_of_model(model(name)).module  # derived once for all tests


def cases(name: str, seed: int):
    """(module, mode, state that fits it, parameters, ground) of each mode."""
    m, rng = module(name), np.random.default_rng(seed)
    for mode in range(len(m.MODES)):
        values = dict(zip(m.PARAMETERS, rng.uniform(0.5, 1.5, len(m.PARAMETERS)), strict=True))
        values["friction"] = 0.3 * values.get("friction", 0.0)
        p = m.prepare(np.array([values[name] for name in m.PARAMETERS]))
        y = kkt.put_on(m, mode, rng.normal(0, 0.3, m.N_STATES), p)
        yield m, mode, y, p, rng.normal(0, 1, 2)


def small(difference, *of) -> bool:
    size = 1 + max(float(np.abs(x).max(initial=0)) for x in of)
    return bool(np.abs(difference).max(initial=0) < 1e-9 * size)


@EACH
@pytest.mark.parametrize("seed", range(3))
def test_accelerations_and_forces_fulfil_all_equations_at_once(name, seed):
    for m, mode, y, p, ground in cases(name, seed):
        found = kkt.solve(m, mode, y, p, *ground)
        rates, forces = np.zeros(m.N_STATES), np.zeros(len(m.REACTIONS))
        m.rates(mode, y, p, *ground, rates)
        m.reactions(mode, y, p, *ground, forces)
        n = m.N_STATES // 2
        told = dict(zip(m.REACTIONS, forces, strict=True))
        normal = np.array([told[f"{point}_reaction"] for point in m.POINTS])
        assert small(rates[n:] - found.accelerations, found.accelerations), m.MODES[mode]
        assert small(rates[:n] - y[n:], y)
        assert small(normal - found.normal, found.normal), m.MODES[mode]
        for first, many in kkt.groups(m, mode).items():
            total = sum(told[f"{m.POINTS[i]}_friction"] for i in many)
            assert small(total - found.friction[first], found.normal), m.MODES[mode]


@EACH
def test_points_are_what_was_declared(name):
    """Gaps, slips, their rates and biases, against differences of the declared functions."""
    m, n = module(name), module(name).N_STATES // 2
    of = model(name)
    symbols = [c.position for c in of.coordinates] + [p.symbol for p in of.parameters]
    places = sp.lambdify(symbols, [c.at(c.side) for c in of.contacts], modules="numpy")
    for _, _, y, p, _ in cases(name, 5):
        values = list(p[: len(m.PARAMETERS)])

        def at(t, y=y, values=values):
            return np.array(places(*(y[:n] + t * y[n:]), *values), dtype=float)

        found, step = kkt.points(m, y, p), 1e-4
        first = (at(step) - at(-step)) / (2 * step)
        second = (at(step) - 2 * at(0) + at(-step)) / step**2
        assert np.allclose(found.gap, at(0)[:, 0], rtol=0, atol=1e-12)
        assert np.allclose(found.gap_rate, first[:, 0], rtol=0, atol=1e-6)
        assert np.allclose(found.slip_rate, first[:, 1], rtol=0, atol=1e-6)
        assert np.allclose(found.gap_bias, second[:, 0], rtol=0, atol=1e-5)
        assert np.allclose(found.slip_bias, second[:, 1], rtol=0, atol=1e-5)
        assert np.allclose(found.normal @ y[n:], found.gap_rate, rtol=0, atol=1e-12)
        assert np.allclose(found.along @ y[n:], found.slip_rate, rtol=0, atol=1e-12)


@EACH
def test_points_of_many_states_have_the_bits_of_each_by_itself(name):
    found = list(cases(name, 9))
    m, p = found[0][0], found[0][3]
    states = np.array([y for _, _, y, _, _ in found])
    many = Points(m, states.reshape(len(states), 1, -1), p)
    for y, *rows in zip(states, many.gap, many.gap_rate, many.normal, strict=True):
        alone = Points(m, y, p)
        for row, expected in zip(rows, (alone.gap, alone.gap_rate, alone.normal), strict=True):
            assert (row[0] == expected).all()


@EACH
def test_guards_are_gaps_forces_and_slip_rates(name):
    for m, mode, y, p, ground in cases(name, 7):
        found, at = kkt.solve(m, mode, y, p, *ground), kkt.points(m, y, p)
        laws, g = np.zeros(2 * m.N_POINTS), np.zeros(m.N_GUARDS + m.N_PARTS)
        m.point_laws(p, laws)
        m.guards(mode, y, p, *ground, g)
        states = m.POINT_STATES[mode]
        wanted = []
        for i, state in enumerate(states):
            if state == kkt.OPEN:
                wanted.append((LANDING, i, at.gap[i]))
                continue
            wanted.append((LIFTING, i, found.normal[i]))
            many = kkt.groups(m, mode).get(i)  # of those that share, once
            if many and kkt.sign(state):
                wanted.append((STICKING, i, kkt.sign(state) * at.slip_rate[i]))
            elif many and laws[2 * i + 1] < 1e300:
                cone = sum(laws[2 * j + 1] * found.normal[j] for j in many)
                wanted += [(SLIPPING, i, cone - way * found.friction[i]) for way in (1, -1)]
        parts = []
        for e, on in enumerate(m.ELEMENT_STATES[mode]):
            compression, press = pressed(m, e, y, p)
            two = [-p[m.PARAMETERS.index("stiffness")] * compression, -press]
            wanted.append((SWITCH, m.N_POINTS + e, press if on else max(two)))
            parts += two
        assert g[m.N_GUARDS :] == pytest.approx(parts, rel=1e-6, abs=1e-6)
        count = m.GUARDS[mode]
        assert [(kind, i) for kind, i, _ in wanted] == [
            (m.KINDS[mode][k], m.SUBJECTS[mode][k]) for k in range(count)
        ]
        differences = g[:count] - np.array([value for *_, value in wanted])
        differences[m.GUARDS[mode] - m.N_ELEMENTS :] *= 1e-3  # by differences, see above
        assert small(differences, found.normal, y)


def pressed(m, element: int, y, p) -> tuple[float, float]:
    """(compression, k d + c d') of an element, the rate by differences."""
    column, n, step = m.KINEMATICS.index(f"{m.ELEMENTS[element]}_uplift"), m.N_STATES // 2, 1e-4

    def compression(t: float) -> float:
        out, moved = np.zeros(len(m.KINEMATICS)), y.copy()
        moved[:n] += t * y[n:]
        m.kinematics(0, moved, p, out)
        return -float(out[column])

    rate = (compression(step) - compression(-step)) / (2 * step)
    k, c = (p[m.PARAMETERS.index(name)] for name in ("stiffness", "damping"))
    return compression(0.0), k * compression(0.0) + c * rate


def test_a_block_on_two_feet_has_shentons_modes_on_either_side():
    states = {s.name: s.points for s in model("sliding_block").modes.states}
    assert states == {
        "both": (1, 1), "both_slides_right": (2, 2), "both_slides_left": (3, 3),
        "left": (1, 0), "left_slides_right": (2, 0), "left_slides_left": (3, 0),
        "right": (0, 1), "right_slides_right": (0, 2), "right_slides_left": (0, 3),
        "flight": (0, 0),
    }  # fmt: skip
    # mirror images and both ways of a slip are one mechanism
    assert len(model("sliding_block").modes.derived) == 5


def test_of_four_feet_at_different_heights_any_two_stand_and_no_three():
    closed = {s.points for s in model("four_feet").modes.states}
    down = {tuple(i for i, state in enumerate(points) if state) for points in closed}
    pairs = {(i, j) for i in range(4) for j in range(i + 1, 4)}
    assert down == pairs | {(i,) for i in range(4)} | {()}


def test_on_unequal_feet_the_block_leans():
    m = module("unequal_feet")
    p = m.prepare(np.array([1.0, 1.0, 0.7, 9.81, 0.4, 0.0, 0.3, 0.5, 0.1]))
    y = kkt.put_on(m, m.MODES.index("both"), np.zeros(6), p)
    assert y[2] == pytest.approx(-np.arctan(0.1 / 0.8), abs=1e-15)
    found = kkt.solve(m, 0, y, p, 0.0, 0.0)
    # the centroid by hand: moments about the left foot, on level ground
    lever = (0.3 * np.cos(y[2]) + 1.0 * np.sin(y[2])) / np.hypot(0.8, 0.1)
    assert found.normal == pytest.approx([9.81 * (1 - lever), 9.81 * lever], rel=1e-12)


def test_a_pinned_foot_gives_the_pinned_block_term_by_term():
    pinned = rk.derive("rigid_block").mode("right")
    mode = model("sliding_block").mode("right")
    for mine, theirs in (
        (mode.mass_matrix, pinned.equations.mass_matrix),
        (mode.forcing, pinned.equations.forcing),
    ):
        assert sp.expand(mine[0] - theirs[0]) == 0


def test_a_pinned_foot_is_pushed_as_the_pinned_block_s():
    mode = model("sliding_block").mode("right")
    horizontal, vertical = total_reaction(rk.derive("rigid_block").mode("right"))
    tied = mode.motions * sp.Matrix([mode.qdd[2]]) + mode.drift
    put = {mode.qdd[0]: tied[0], mode.qdd[1]: tied[1]}
    (normal,), (friction,) = (part.values() for part in mode.forces)
    assert tidy(normal.subs(put) - vertical) == 0
    assert tidy(friction.subs(put) - horizontal) == 0


@pytest.mark.parametrize("foot", ["left", "right"])
def test_two_blocks_that_cannot_open_are_one(foot):
    """The equation of two masses on one base, derived in minimal coordinates."""
    mode = model("stacked_blocks").mode(f"{foot}_upper_both")
    one = rk.derive("lumped_mass_structure").mode("right")
    stack = {p.name: p.symbol for p in model("stacked_blocks").parameters}
    whole = {p.name: p.symbol for p in rk.derive("lumped_mass_structure").parameters}
    same = {
        "mass": stack["upper_mass"],
        "height": 2 * stack["lower_half_height"] + stack["upper_half_height"],
        "inertia": stack["upper_inertia"],
        "base_mass": stack["lower_mass"],
        "base_height": stack["lower_half_height"],
        "base_inertia": stack["lower_inertia"],
        "half_width": stack["lower_half_width"],
    }
    put = {whole[name]: value for name, value in same.items()}
    aligned = {model("stacked_blocks").coordinates[3].position: 0}
    (free,) = mode.independent
    put |= {one.coordinates[0].position: mode.q[free]}
    for mine, theirs in (
        (mode.mass_matrix, one.equations.mass_matrix),
        (mode.forcing, one.equations.forcing),
    ):
        assert tidy(mine[0].subs(aligned) - theirs[0].subs(put, simultaneous=True)) == 0


def test_inverse_of_a_matrix_of_symbols():
    a, b, c = sp.symbols("a b c")
    matrix = sp.Matrix([[a, b, 0], [0, c, 1], [a, 0, 1]])
    assert sp.simplify(matrix * inverted(matrix) - sp.eye(3)) == sp.zeros(3)
