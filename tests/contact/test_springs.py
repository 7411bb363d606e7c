"""Springs and dampers that always act: what follows from them, and what a response calls them."""

import importlib
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from rockeom.codegen import module_text
from rockeom.integrator.texts import load_text
from rockeom.structures.classes import SHIPPED
from rockeom.symbolic import Spring, Unilateral, rocking_structure
from rockeom.symbolic.algebra import tidy
from rockeom.symbolic.structures.flexible import flexible_structure
from rockeom.symbolic.structures.two_spring import two_spring_structure
from tests.contact import declared
from tests.contact.test_pinned import COLUMN, NAMED, column
from tests.shipped import plain

U = COLUMN.coordinates[1]
SPRING = Spring("column", U.position, NAMED["stiffness"], NAMED["damping"])


def named_column():
    """The free column with its spring by name, in place of energies."""
    return replace(column(), elements=(SPRING,), elastic_energy=sp.S.Zero, dissipation=sp.S.Zero)


def test_a_spring_is_the_energies_that_it_stands_for():
    """On pinned feet, too, where nothing that switches may stand."""
    by_name, by_energies, shipped = named_column().reduced, column().reduced, COLUMN
    for mode in shipped.mode_names:
        one, other = by_name.equations(mode), by_energies.equations(mode)
        for what in ("elastic_forces", "damping_forces", "mass_matrix"):
            assert all(tidy(e) == 0 for e in getattr(one, what) - getattr(other, what)), what
        assert one.elastic_energy == other.elastic_energy
    assert [e.name for e in by_name.modes[0].elements] == ["column"]
    assert named_column().switching == ()
    assert named_column().springs == (SPRING,)


def test_a_spring_beside_springs_that_press_adds_no_mode():
    plainly = declared.two_springs()
    theta = plainly.rotation
    k, c = sp.Integer(3), sp.Rational(1, 2)
    guy = Spring("guy", 2 * theta.position, k, c, initial_force=sp.Integer(5))
    model = replace(plainly, elements=(guy, *plainly.elements))
    module = load_text("guyed", module_text(model))
    assert set(module.MODES) == set(plainly.modes.names)
    assert tuple(e.name for e in plainly.elements) == module.ELEMENTS
    assert ("guy", *module.ELEMENTS) == module.ELEMENT_NAMES
    rng = np.random.default_rng(1)
    n = module.N_STATES // 2
    rotation, rate = module.ROTATION, module.ROTATION_RATE
    for mode, states in enumerate(module.ELEMENT_STATES):
        p = module.prepare(rng.uniform(0.5, 2.0, len(module.PARAMETERS)))
        y, out = rng.normal(0.0, 0.3, 2 * n), np.zeros(12)
        module.elements(mode, y, p, out)
        told = out.reshape(3, 4)
        force = 5 + 3 * 2 * y[rotation] + 0.5 * 2 * y[rate]
        still = 5 + 3 * 2 * y[rotation]
        assert told[0] == pytest.approx(
            [2 * y[rotation], force, still**2 / 6, 0.5 * (2 * y[rate]) ** 2]
        )
        forces = np.zeros(len(module.REACTIONS))
        module.reactions(mode, y, p, 0.0, 0.0, forces)
        for i, name in enumerate(module.ELEMENTS):
            assert told[1 + i, 1] == pytest.approx(
                forces[module.REACTIONS.index(f"{name}_reaction")]
            )
            assert bool(told[1 + i, 2]) == bool(states[i])
        energies = np.zeros(3)
        module.energies(mode, y, p, energies)
        assert told[:, 2].sum() == pytest.approx(energies[2])


WITH_ELEMENTS = [
    name for name in SHIPPED if importlib.import_module(f"rockeom.generated.{name}").ELEMENT_NAMES
]


@pytest.mark.parametrize("name", WITH_ELEMENTS)
def test_elements_of_a_structure_store_its_energy_and_lose_its_power(name):
    """In each mode, at random states; the oscillator's elastic energy has its weight."""
    structure = SHIPPED[name](**plain(name))
    m, p = structure.module, structure.vector
    rng = np.random.default_rng(2)
    for mode in range(len(m.MODES)):
        for _ in range(3):
            y = rng.normal(0.0, 0.05, m.N_STATES)
            told, energies, powers = np.zeros(4 * len(m.ELEMENT_NAMES)), np.zeros(3), np.zeros(3)
            m.elements(mode, y, p, told)
            m.energies(mode, y, p, energies)
            m.powers(mode, y, p, 1.3, 0.4, powers)
            _, _, stored, lost = told.reshape(-1, 4).T
            if name != "controlled_wall_oscillator":
                assert stored.sum() == pytest.approx(energies[2], rel=1e-9)
            assert lost.sum() == pytest.approx(powers[1], rel=1e-9, abs=1e-12)


def test_springs_under_feet_have_the_names_of_their_feet_on_both_sides():
    structure = SHIPPED["two_spring_structure"](**plain("two_spring_structure"))
    m, p = structure.module, structure.vector
    y = np.array([0.2, -0.3, 0.1, -0.4])
    for mode in range(len(m.MODES)):
        told, forces, moved = np.zeros(8), np.zeros(3), np.zeros(3)
        m.elements(mode, y, p, told)
        m.reactions(mode, y, p, 0.0, 0.0, forces)
        m.kinematics(mode, y, p, moved)
        settled = np.zeros(3)
        m.elements(m.MODES.index("both"), np.zeros(4), p, told_at_rest := np.zeros(8))
        m.kinematics(mode, np.zeros(4), p, settled)
        assert told[[1, 5]] == pytest.approx(forces[1:])
        assert told[[0, 4]] - told_at_rest[[0, 4]] == pytest.approx(settled[1:] - moved[1:])


def one_body(**changes):
    theta, u = COLUMN.coordinates
    what = {
        "name": "mine", "title": "mine", "parameters": COLUMN.parameters,
        "coordinates": (theta, u), "half_width": NAMED["half_width"], "gravity": NAMED["gravity"],
        "bodies": lambda pivot: COLUMN.modes[0].bodies,
    }  # fmt: skip
    return rocking_structure(**(what | changes))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Spring("column", U.position, sp.Integer(-1)), "stiffness is -1: it is negative"),
        (lambda: Spring("column", "u"), "deformation is 'u'"),
        (lambda: Spring(1, U.position), "name is 1"),
        (
            lambda: one_body(elements=[Unilateral("column", U.position, sp.S.One)]),
            "give objects of Spring",
        ),
        (lambda: one_body(elements=[SPRING, SPRING]), "declared twice: column"),
        (lambda: one_body(elements=[replace(SPRING, name="a b")]), "letters, digits"),
        (lambda: one_body(elements=[replace(SPRING, mirrored="image")]), "elements on one side"),
        (lambda: one_body(elements=[replace(SPRING, deformation=U.velocity)]), "element 'column'"),
        (
            lambda: replace(
                named_column(), elements=(Unilateral("column", U.position, sp.S.One),)
            ),
            "declare a spring that never leaves as a Spring",
        ),
        (
            lambda: replace(
                two_spring_structure(),
                modes=(
                    replace(two_spring_structure().modes[0], elements=()),
                    *two_spring_structure().modes[1:],
                ),
            ),
            "differ in elements",
        ),
    ],
)  # fmt: skip
def test_springs_that_cannot_be_meant_are_refused(make, said):
    assert one_body(elements=[SPRING]).modes[0].elements == (SPRING,)
    assert flexible_structure().modes[0].elements == (SPRING,)
    with pytest.raises(ValueError, match=said):
        make()
