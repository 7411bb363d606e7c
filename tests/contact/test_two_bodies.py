"""Two bodies on one another in axes of the ground, where a gap contains coordinates of both."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom import codegen
from rockeom.modelling import declared as of_declarations
from rockeom.structures.searched_modes import Points
from rockeom.symbolic.algebra import SIDE, brief, vanishes
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from tests.mechanics import OPEN, STICK

from . import declared
from .reference import held
from .test_two_blocks import STACK, STILL, structure


@cache
def block_and_load() -> rk.Structure:
    return rk.structure(
        declared.block_and_load(),
        half_width=0.5,
        half_height=0.4,
        mass=2.0,
        inertia=0.3,
        upper_mass=1.5,
    )


@pytest.mark.parametrize("theta", [0.0, 0.1, -0.3])
def test_all_bodies_stand_on_one_another_at_the_start(theta):
    structure = block_and_load()
    run = rk.simulate(structure, rk.GroundMotion.none(0.1), initial={"theta": theta}, duration=1e-4)
    y = np.array([run[name][0] for name in run.states])
    points = Points(structure.module, y, structure.vector)
    assert np.abs(points.gap[[1 if theta > 0 else 0, 2]]).max() < 1e-15
    assert points.gap.min() > -1e-15
    assert theta or str(rk.simulate(structure, rk.GroundMotion.none(1.0)).outcome) == "came to rest"


def test_blocks_that_rock_on_one_another_move_as_the_reference():
    state = {"theta": 0.1, "phi": -0.05, "theta_dot": 0.2, "phi_dot": 0.4}
    run = rk.simulate(structure(STACK), STILL, initial=state, duration=1e-6)
    at = STACK.mechanics.in_state({name: float(run[name][0]) for name in run.states})
    model = declared.two_blocks()
    mechanism = model.mode("right_upper_left")
    lower, upper = at.parts.masses
    moves = np.vstack(
        [row for body in at.parts.masses for row in (*body.centre.jacobian[0], body.turn)]
    )
    biases = [x for body in at.parts.masses for x in (*body.centre.bias[0], 0.0)]
    q = [x for body in at.parts.masses for x in (*body.centre.value[0], at.states.q[0] @ body.turn)]
    v = moves @ at.states.v[0]
    values = {
        "mass": lower.mass, "inertia": lower.inertia, "gravity": 9.81,
        "half_width": STACK.b1, "half_height": STACK.h1, "upper_half_width": STACK.b2,
        "upper_half_height": STACK.h2, "upper_mass": upper.mass, "upper_inertia": upper.inertia,
    }  # fmt: skip
    put = {p.symbol: values[p.name] for p in model.parameters}
    put |= dict(zip((*mechanism.q, *mechanism.qd), (*q, *v), strict=True))
    put |= {GROUND_X: 0, GROUND_Y: 0}
    side = 1 if mechanism.states[1] else -1  # the one it is written for, or with s
    put[SIDE] = side

    def number(matrix):
        return np.array(matrix.subs(put).tolist(), dtype=float)

    motions = number(mechanism.motions)
    turned = np.linalg.solve(number(mechanism.mass_matrix), number(mechanism.forcing))
    found = (motions @ turned + number(mechanism.drift)).ravel()
    expected = moves @ held(at, (OPEN, STICK, STICK, OPEN)).motion + biases
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_a_product_of_too_many_terms_is_not_expanded_and_is_still_found_to_vanish():
    sums = [sum(sp.symbols(f"{letter}:5")) for letter in "abcd"]
    product = sp.Mul(*sums)
    assert brief(product) == product
    assert vanishes(product - sp.expand(product))
    assert not vanishes(product - sums[0])
    assert brief(sums[0] * sums[1]) == sp.expand(sums[0] * sums[1])


def test_the_derivation_of_many_modes_is_announced_before_it_begins(monkeypatch, capsys):
    monkeypatch.setattr(of_declarations, "kept", lambda name, digest, made: made())
    monkeypatch.setattr(of_declarations, "MANY_MODES", 3)
    begun = []
    monkeypatch.setattr(codegen, "module_text", lambda model: begun.append(capsys.readouterr().err))
    with pytest.raises(AttributeError):  # nothing was derived
        of_declarations.class_of_model(replace(declared.block_and_load(), title="Announced"))
    assert begun == ["rockeom: deriving block_and_load with 8 modes\n"]
