"""The NumPy functions of a model in a notebook: shapes, and what they say of simple states."""

import math

import numpy as np
import pytest

import rockeom as rk

BLOCK = {"mass": 300.0, "half_width": 0.1, "height": 0.4, "inertia": 17.0, "gravity": 9.81}


@pytest.fixture(scope="module")
def modes():
    return rk.derive("rigid_block").lambdify()


def test_one_set_of_functions_for_each_mode(modes):
    assert list(modes) == ["left", "both", "right"]
    assert modes["right"].states == ("theta", "theta_dot")
    assert modes["right"].coordinates == ("theta",)
    assert modes["both"].coordinates == ()


@pytest.mark.parametrize("shape", [(), (5,), (4, 3)])
def test_shapes_follow_the_states(modes, shape):
    y = np.full((2, *shape), 0.1)
    for name, d in (("right", 1), ("both", 0)):
        mode = modes[name]
        assert mode.mass_matrix(y, BLOCK).shape == (d, d, *shape)
        assert mode.forcing(y, BLOCK, ax=1.0).shape == (d, *shape)
        assert mode.accelerations(y, BLOCK, ax=1.0).shape == (d, *shape)
        assert mode.rates(y, BLOCK, ax=1.0, ay=0.5).shape == (2, *shape)
        named = {**mode.energies(y, BLOCK), **mode.reactions(y, BLOCK), **mode.guards(y, BLOCK)}
        assert {values.shape for values in named.values()} == {shape}
        places = mode.positions(y, BLOCK)
        assert set(places) == {"block", "left_foot", "right_foot"}
        assert {place.shape for place in places.values()} == {(2, *shape)}


def test_parameters_and_accelerations_may_be_arrays(modes):
    heights = np.linspace(0.2, 0.8, 7)
    found = modes["right"].accelerations([0.05, 0.0], BLOCK | {"height": heights}, ax=0.7)
    one_by_one = [
        modes["right"].accelerations([0.05, 0.0], BLOCK | {"height": h}, ax=0.7)[0] for h in heights
    ]
    np.testing.assert_array_equal(found[0], one_by_one)
    pushed = modes["right"].accelerations([0.05, 0.0], BLOCK, ax=np.array([-1.0, 0.0, 1.0]))
    assert np.all(np.diff(pushed[0]) < 0)


def test_uplift_guard_of_a_standing_block_changes_sign_at_the_threshold(modes):
    threshold = 9.81 * 0.1 / 0.4
    guards = modes["both"].guards([0.0, 0.0], BLOCK, ax=threshold * np.array([0.999, 1.001]))
    assert np.sign(guards["left"]).tolist() == [1, -1]
    assert np.all(guards["right"] > 0)


def test_a_block_that_balances_neither_falls_nor_returns(modes):
    alpha = math.atan2(0.1, 0.4)
    assert modes["right"].accelerations([alpha, 0.0], BLOCK)[0] == pytest.approx(0, abs=1e-13)
    centroid = modes["right"].positions([alpha, 0.0], BLOCK)["block"]
    np.testing.assert_allclose(centroid, [0.1, math.hypot(0.1, 0.4)])
