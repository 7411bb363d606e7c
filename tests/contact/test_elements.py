"""Springs and dampers that press and never pull: their states, forces and guards."""

import importlib
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.codes import SWITCH
from rockeom.integrator.texts import load_text
from rockeom.symbolic import Model, Unilateral
from tests.contact import declared

SHIPPED = importlib.import_module("rockeom.generated.two_spring_structure")
NAMES = ("mass", "height", "inertia", "gravity", "stiffness", "damping", "half_width")


@cache
def on_two_springs():
    return load_text("two_springs", module_text(declared.two_springs()))


def parameters(rng):
    """(of the declared structure, of the shipped one), prepared: the same block."""
    values = dict(zip(NAMES, rng.uniform(0.5, 2.0, len(NAMES)), strict=True))
    mine = on_two_springs()
    shipped = {
        "mass": values["mass"], "height": values["height"], "inertia": values["inertia"],
        "base_mass": 0.0, "base_height": 0.0, "base_inertia": 0.0,
        "half_width": values["half_width"], "gravity": values["gravity"],
        "foundation_stiffness": values["stiffness"], "foundation_damping": values["damping"],
    }  # fmt: skip
    return (
        mine.prepare(np.array([values[n] for n in mine.PARAMETERS])),
        SHIPPED.prepare(np.array([shipped[n] for n in SHIPPED.PARAMETERS])),
    )


def test_two_springs_have_the_modes_of_the_shipped_structure():
    assert sorted(on_two_springs().MODES) == sorted(SHIPPED.MODES)


@pytest.mark.parametrize("mode", SHIPPED.MODES)
def test_two_springs_move_as_the_shipped_structure(mode):
    """Rates, energies, reactions and guards, at random states: one was declared mode by mode."""
    rng, mine = np.random.default_rng(1), on_two_springs()
    here, there = mine.MODES.index(mode), SHIPPED.MODES.index(mode)
    for _ in range(20):
        p, q = parameters(rng)
        y, ground = rng.normal(0, 0.3, 4), rng.normal(0, 1, 2)
        for name, size, given in (("rates", 4, ground), ("reactions", 3, ground),
                                  ("energies", 3, ()), ("kinematics", 3, ())):  # fmt: skip
            found, wanted = np.zeros(size), np.zeros(size)
            getattr(mine, name)(here, y, p, *given, found)
            getattr(SHIPPED, name)(there, y, q, *given, wanted)
            if name == "kinematics":  # theirs count from rest, ours from the springs' ends
                at_rest = np.zeros(size)
                mine.kinematics(here, np.zeros(4), p, at_rest)
                found -= at_rest
            assert found == pytest.approx(wanted, rel=1e-12, abs=1e-12), name


def _led_to(m, mode, y, p, ground):
    """Each guard's value and parts by the mode to which it leads."""
    g, number = np.zeros(m.N_GUARDS + m.N_PARTS), m.MODES.index(mode)
    m.guards(number, y, p, *ground, g)
    found = {}
    for k in range(m.GUARDS[number]):
        assert m.KINDS[number][k] == SWITCH
        part = m.PARTS[number][k]
        parts = sorted(g[part : part + 2]) if part >= 0 else []
        found[m.MODES[m.TARGETS[number][k]]] = [g[k], *parts]
    return found


@pytest.mark.parametrize("mode", SHIPPED.MODES)
def test_two_springs_switch_as_the_shipped_structure(mode):
    rng, mine = np.random.default_rng(2), on_two_springs()
    for _ in range(20):
        p, q = parameters(rng)
        y, ground = rng.normal(0, 0.3, 4), rng.normal(0, 1, 2)
        found = _led_to(mine, mode, y, p, ground)
        wanted = _led_to(SHIPPED, mode, y, q, ground)
        assert found.keys() == wanted.keys()
        for target, values in wanted.items():
            assert found[target] == pytest.approx(values, rel=1e-12, abs=1e-12)


def test_the_guard_that_leads_back_is_that_of_the_same_element():
    m = on_two_springs()
    for mode, targets in enumerate(m.TARGETS):
        for k, target in enumerate(targets):
            back = m.REVERSE[mode][k]
            assert m.TARGETS[target][back] == mode
            assert m.SUBJECTS[target][back] == m.SUBJECTS[mode][k]


def bed(springs: int, uneven: tuple[int, ...] = (), bent: tuple[int, ...] = ()) -> Model:
    """A block on a row of equal springs and dampers, the outer two at its feet.

    uneven : those with another damper. bent : those with other heights.
    """
    of = declared.two_springs()
    k, c, b = (p.symbol for p in of.parameters[-3:])
    theta = of.rotation.position
    centre = -sp.sympify(of.elements[0].compression).subs(theta, 0)
    return Model(
        name="bed", title="A block on a bed of springs", parameters=of.parameters,
        coordinates=of.coordinates, bodies=of.bodies, gravity=of.gravity, rotation=of.rotation,
        elements=[
            Unilateral(
                f"spring_{i}",
                -centre
                + (sp.Rational(2 * i, springs - 1) - 1) * b * sp.sin(theta)
                - (sp.Rational(i * i, 10) * sp.cos(theta) if i in bent else 0),
                k, (2 if i in uneven else 1) * c,
            )
            for i in range(springs)
        ],
    )  # fmt: skip


def one_after_the_other(n: int, ratio: np.ndarray, rng) -> set[tuple[int, ...]]:
    """Sets of springs of a straight row that press in random states: closed, and not pulled."""
    x = np.linspace(-1.0, 1.0, n)
    line, moves = rng.normal(size=(2, 20_000, 1)), rng.normal(size=(2, 20_000, 1))
    depth, rate = line[0] + line[1] * x, moves[0] + moves[1] * x
    return {tuple(row) for row in ((depth > 0) & (depth + ratio * rate > 0)).astype(int).tolist()}


@pytest.mark.parametrize("n", [2, 3, 5, 7])
def test_a_bed_of_springs_has_the_sets_of_neighbours_that_a_straight_base_presses(n):
    states = {s.elements for s in bed(n).modes.states}
    assert states == one_after_the_other(n, np.ones(n), np.random.default_rng(n))
    assert len(states) == n * (n + 1) // 2 + 1
    assert len(bed(n).modes.derived) == 1  # elements add forces, and no mode


@pytest.mark.parametrize("changes", [{"uneven": (1,)}, {"uneven": (0, 3)}, {"bent": (3,)}])
def test_springs_that_differ_have_every_combination_that_may_be(changes):
    """A damper of another proportion, or a place beside the row: any of them may press alone."""
    apart = len(next(iter(changes.values())))
    row = 4 - apart  # those that are alike; two of anything make a row of their own
    alike = row * (row + 1) // 2 + 1
    assert len({s.elements for s in bed(4, **changes).modes.states}) == alike * 2**apart


def test_random_states_of_an_uneven_bed_are_among_its_combinations():
    ratio = np.array([1.0, 3.0, 1.0, 3.0])
    found = one_after_the_other(4, ratio, np.random.default_rng(1))
    assert any("101" in "".join(map(str, states)) for states in found)  # no neighbours
    assert found <= {s.elements for s in bed(4, uneven=(1, 3)).modes.states}


def test_each_guard_leads_to_the_set_with_one_neighbour_more_or_less():
    """And a spring between two that press, or beyond one that does not, has none that falls."""
    m = load_text("bed", module_text(bed(5)))
    rng = np.random.default_rng(3)
    p = m.prepare(rng.uniform(0.5, 2.0, len(m.PARAMETERS)))
    for mode, states in enumerate(m.ELEMENT_STATES):
        g = np.zeros(m.N_GUARDS + m.N_PARTS)
        m.guards(mode, rng.normal(0.0, 0.3, 4), p, 0.0, 0.0, g)
        leads = {m.ELEMENT_STATES[t] for t in m.TARGETS[mode]} - {states}
        turned = {(*states[:i], 1 - states[i], *states[i + 1 :]) for i in range(5)}
        assert leads == turned & set(m.ELEMENT_STATES)
        for k, target in enumerate(m.TARGETS[mode]):
            if target == mode:
                assert g[k] > 0.0
                assert m.PARTS[mode][k] == m.REVERSE[mode][k] == -1


def test_too_many_elements_are_refused_when_they_are_declared():
    assert len(bed(40).modes.states) == 821
    with pytest.raises(ValueError, match=r"100 elements have 5051 combinations .* than 4096"):
        bed(100)
    with pytest.raises(ValueError, match=r"13 elements have \d+ combinations .* than 4096"):
        bed(13, bent=tuple(range(13)))


def test_a_motion_on_springs_is_that_of_the_shipped_structure():
    block = {"mass": 1.0, "height": 1.0, "inertia": 0.4, "half_width": 0.3}
    mine = rk.structure(declared.two_springs(), **block, stiffness=2000.0, damping=20.0)
    shipped = rk.TwoSpringStructure(
        **block, base_mass=1e-12, base_height=1e-9, base_inertia=0.0, foundation_stiffness=2000.0,
        foundation_damping=20.0,
    )  # fmt: skip
    runs = [
        rk.simulate(s, rk.GroundMotion.none(2.0), initial={"theta": 0.2}) for s in (mine, shipped)
    ]
    found, wanted = ([(e.time, e.mode_before, e.mode_after) for e in run.events] for run in runs)
    assert len(found) >= 8
    assert [e[1:] for e in found] == [e[1:] for e in wanted]
    assert [e[0] for e in found] == pytest.approx([e[0] for e in wanted], rel=1e-8)
    assert runs[0]["theta"][-1] == pytest.approx(runs[1]["theta"][-1], rel=1e-7)
