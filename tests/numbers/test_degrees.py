"""Angles that are named in degrees, wherever an angle is given by name."""

import importlib
import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.numbers.degrees import with_degrees
from rockeom.structures.declared import class_of

BLOCK = rk.RigidBlock(half_width=0.2, half_height=1.0)
STILL = rk.GroundMotion.none(1.0)
ALPHA = math.radians(14.0)
DECLARED = class_of(importlib.import_module("rockeom.generated.slender_block"))


def test_parameters_are_named_in_degrees():
    assert rk.SlenderBlock(radius=1.0, alpha_degrees=14) == rk.SlenderBlock(radius=1.0, alpha=ALPHA)
    assert rk.NondimensionalBlock(alpha_degrees=14.0).alpha == ALPHA
    block = rk.RigidBlock.from_frequency(p=2.14, alpha_degrees=14.0)
    assert block == rk.RigidBlock.from_frequency(p=2.14, alpha=ALPHA)
    others = {"radius": 1.0, "mass": 2.0, "inertia": 0.5}
    assert DECLARED(alpha_degrees=14.0, **others) == DECLARED(alpha=ALPHA, **others)


def test_states_are_named_in_degrees():
    start = {"theta_degrees": 5.0, "theta_dot_degrees": 3.0}
    run = rk.simulate(BLOCK, STILL, initial=start)
    assert (run["theta"][0], run["theta_dot"][0]) == (math.radians(5.0), math.radians(3.0))
    assert (
        "0.08727 rad (5 degrees)"
        in rk.simulate(BLOCK, STILL, initial={"theta_degrees": 5.0}).summary()
    )
    angles = np.array([1.0, 2.0])
    found = BLOCK.accelerations({"theta_degrees": angles})["theta"]
    assert (found == BLOCK.accelerations({"theta": np.radians(angles)})["theta"]).all()


def test_a_sweep_varies_angles_in_degrees():
    case = rk.Case(rk.SlenderBlock(radius=1.0, alpha_degrees=14), STILL, initial={"theta": 0.1})
    over = {"alpha_degrees": [12.0, 14.0], "initial theta_degrees": [3.0, 5.0]}
    found = rk.simulate_many(case, over=over)
    assert found["alpha_degrees"].attrs["units"] == "degree"
    plain = rk.simulate_many(
        case, over={name.removesuffix("_degrees"): np.radians(x) for name, x in over.items()}
    )
    np.testing.assert_allclose(found.final.values, plain.final.values, rtol=1e-12)
    with pytest.raises(ValueError, match="'radius_degrees' is unknown"):
        rk.simulate_many(case, over={"radius_degrees": [1.0]})


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: rk.SlenderBlock(radius=1.0, alpha=0.2, alpha_degrees=14), ValueError, "one out"),
        (lambda: rk.SlenderBlock(alpha=0.2, radius_degrees=1), TypeError, "mean radius"),
        (lambda: rk.ShearFrame(storeys_degrees=2), TypeError, "unknown storeys_degrees"),
        (
            lambda: rk.RigidBlock.from_frequency(2.14, alpha=0.2, alpha_degrees=14),
            ValueError,
            "alpha and alpha_degrees are both given",
        ),
        (
            lambda: rk.simulate(BLOCK, STILL, initial={"theta": 0.1, "theta_degrees": 5}),
            ValueError,
            "theta and theta_degrees are both given",
        ),
        (lambda: BLOCK.energies({"x_degrees": 5}), ValueError, "unknown state 'x_degrees'"),
        (lambda: BLOCK.energies({"theta_degrees": "5"}), TypeError, "theta_degrees is '5'"),
        (
            lambda: rk.simulate(BLOCK, STILL, initial={"theta": 5.0}),
            ValueError,
            "give degrees as theta_degrees",
        ),
    ],
)
def test_an_angle_has_one_value_and_a_known_name(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_an_angle_is_shown_in_both_units():
    assert with_degrees(0.245, "rad") == "0.245 rad (14 degrees)"
    assert with_degrees(0.245, "m") == "0.245 m"
    assert with_degrees(0.245, "-") == "0.245"
