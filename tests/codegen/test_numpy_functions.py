"""The NumPy functions of a model in a notebook: shapes, and what they say of simple states."""

import math

import numpy as np
import pytest

import rockeom as rk

BLOCK = {"mass": 300.0, "half_width": 0.1, "height": 0.4, "inertia": 17.0, "gravity": 9.81}


@pytest.fixture(scope="module")
def phases():
    return rk.derive("rigid_block").lambdify()


def test_one_set_of_functions_for_each_contact_state(phases):
    assert list(phases) == ["left", "both", "right"]
    assert phases["right"].states == ("theta", "theta_dot")
    assert phases["right"].coordinates == ("theta",)
    assert phases["both"].coordinates == ()


@pytest.mark.parametrize("shape", [(), (5,), (4, 3)])
def test_shapes_follow_the_states(phases, shape):
    y = np.full((2, *shape), 0.1)
    for contact, d in (("right", 1), ("both", 0)):
        phase = phases[contact]
        assert phase.mass_matrix(y, BLOCK).shape == (d, d, *shape)
        assert phase.forcing(y, BLOCK, ax=1.0).shape == (d, *shape)
        assert phase.accelerations(y, BLOCK, ax=1.0).shape == (d, *shape)
        assert phase.rates(y, BLOCK, ax=1.0, ay=0.5).shape == (2, *shape)
        named = {**phase.energies(y, BLOCK), **phase.reactions(y, BLOCK), **phase.guards(y, BLOCK)}
        assert {values.shape for values in named.values()} == {shape}
        places = phase.positions(y, BLOCK)
        assert set(places) == {"block", "left_foot", "right_foot"}
        assert {place.shape for place in places.values()} == {(2, *shape)}


def test_parameters_and_accelerations_may_be_arrays(phases):
    heights = np.linspace(0.2, 0.8, 7)
    found = phases["right"].accelerations([0.05, 0.0], BLOCK | {"height": heights}, ax=0.7)
    one_by_one = [
        phases["right"].accelerations([0.05, 0.0], BLOCK | {"height": h}, ax=0.7)[0]
        for h in heights
    ]
    np.testing.assert_array_equal(found[0], one_by_one)
    pushed = phases["right"].accelerations([0.05, 0.0], BLOCK, ax=np.array([-1.0, 0.0, 1.0]))
    assert np.all(np.diff(pushed[0]) < 0)


def test_uplift_guard_of_a_standing_block_changes_sign_at_the_threshold(phases):
    threshold = 9.81 * 0.1 / 0.4
    guards = phases["both"].guards([0.0, 0.0], BLOCK, ax=threshold * np.array([0.999, 1.001]))
    assert np.sign(guards["left"]).tolist() == [1, -1]
    assert np.all(guards["right"] > 0)


def test_a_block_that_balances_neither_falls_nor_returns(phases):
    alpha = math.atan2(0.1, 0.4)
    assert phases["right"].accelerations([alpha, 0.0], BLOCK)[0] == pytest.approx(0, abs=1e-13)
    centroid = phases["right"].positions([alpha, 0.0], BLOCK)["block"]
    np.testing.assert_allclose(centroid, [0.1, math.hypot(0.1, 0.4)])
