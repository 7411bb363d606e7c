"""Support forces of a rocking block: the engine's reactions, and its centroid's path."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.analysis import formulas
from tests.refusals import refused

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
SHAPE = {"alpha": BLOCK.alpha, "radius": BLOCK.radius}
SIDES = [(1, "right"), (-1, "left")]


@settings(max_examples=100)
@given(
    theta=st.floats(0.001, 1.0),
    side=st.sampled_from([-1, 1]),
    theta_dot=st.floats(-2, 2),
    ground=st.floats(-5, 5),
)
def test_forces_are_the_reactions_that_the_engine_derives(theta, side, theta_dot, ground):
    state = {"theta": side * theta, "theta_dot": theta_dot}
    second = BLOCK.accelerations(state, ground)["theta"]
    horizontal, vertical = formulas.block_reactions(
        side * theta, theta_dot, second, mass=BLOCK.mass, ground_acceleration=ground, **SHAPE
    )
    reactions = BLOCK.reactions(state, ground)
    foot = "right_reaction" if side > 0 else "left_reaction"
    near = 1e-11 * BLOCK.mass * 9.81
    assert horizontal == pytest.approx(reactions["horizontal_reaction"], rel=1e-11, abs=near)
    assert vertical == pytest.approx(reactions[foot], rel=1e-11, abs=near)


@pytest.mark.parametrize(("side", "foot"), SIDES)
@pytest.mark.parametrize("rate", [-0.6, 0.0, 0.3])
@pytest.mark.parametrize("inertia", [None, 60.0])
def test_forces_at_an_impact_are_the_reactions_upright(side, foot, rate, inertia):
    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44, inertia=inertia)
    values = block.parameters()
    ratio = block.mass * block.radius**2 / (values["inertia"] + block.mass * block.radius**2)
    horizontal, vertical = formulas.block_reactions_at_impact(
        rate, side, mass=block.mass, radius_ratio=ratio, **SHAPE
    )
    state = {"theta_dot": rate}
    reactions = block.reactions(state, mode=foot)
    assert horizontal == pytest.approx(reactions["horizontal_reaction"], rel=1e-11)
    assert vertical == pytest.approx(reactions[f"{foot}_reaction"], rel=1e-11)
    assert formulas.acceleration_at_impact(side, radius_ratio=ratio, **SHAPE) == pytest.approx(
        block.accelerations(state, mode=foot)["theta"], rel=1e-12
    )


@pytest.mark.parametrize(("side", "foot"), SIDES)
def test_slender_form_is_the_slender_blocks_acceleration(side, foot):
    slender = rk.SlenderBlock(**SHAPE)
    assert formulas.acceleration_at_impact(side, slender=True, **SHAPE) == pytest.approx(
        slender.accelerations({}, mode=foot)["theta"], rel=1e-12
    )
    excess = formulas.acceleration_at_impact(
        side, slender=True, **SHAPE
    ) / formulas.acceleration_at_impact(side, **SHAPE)
    assert excess == pytest.approx(1.0071, abs=1e-4)


@pytest.mark.parametrize("side", [-1, 1])
def test_vertical_force_is_the_same_on_both_feet(side):
    """3-12 as printed would give mg (1 + ...) on one side: its sgn(theta) is an erratum."""
    weight = BLOCK.mass * 9.81
    horizontal, vertical = formulas.block_reactions_at_impact(
        0.0, side, mass=BLOCK.mass, slender=True, **SHAPE
    )
    # the limits as rocking dies out: 3-15 is below the weight, 3-14 is a magnitude
    assert vertical / weight == pytest.approx(0.9684, abs=1e-4)
    assert side * horizontal / weight == pytest.approx(-0.1512, abs=1e-4)


@pytest.mark.parametrize("side", [-1, 1])
def test_acceleration_of_the_centroid_along_a_path(side):
    """Second differences of the centroid's place while theta(t) is a given polynomial."""
    theta, rate, second = side * 0.12, -0.7, 3.1
    h = 1e-4
    t = np.array([-h, 0.0, h])
    path = theta + rate * t + second * t**2 / 2
    # the line from the pivot to the centroid, turned clockwise by theta
    lean = path - side * BLOCK.alpha
    x, y = BLOCK.radius * np.sin(lean), BLOCK.radius * np.cos(lean)
    found = formulas.centroid_acceleration(theta, rate, second, ground_acceleration=1.5, **SHAPE)
    expected = [1.5 + np.diff(x, 2)[0] / h**2, np.diff(y, 2)[0] / h**2]
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_speed_at_the_impact_of_a_release():
    release = math.radians(7.876)
    run = rk.simulate(BLOCK, rk.GroundMotion.none(1.0), initial={"theta": release})
    speed = formulas.impact_speed([release, -release], **SHAPE)
    np.testing.assert_allclose(speed, -run.impacts[0].before["theta_dot"], rtol=1e-9)
    # 3-13: "the maximum foreseeable", of a release at the balance
    greatest = formulas.impact_speed(BLOCK.alpha, **SHAPE)
    assert greatest == pytest.approx(0.8177, abs=1e-4)
    assert (speed < greatest).all()


def test_histories_are_arrays():
    run = rk.simulate(BLOCK, rk.GroundMotion.none(0.3), initial={"theta": -0.12})
    second = [
        BLOCK.accelerations({"theta": x, "theta_dot": v})["theta"]
        for x, v in zip(run["theta"], run["theta_dot"], strict=True)
    ]
    horizontal, vertical = formulas.block_reactions(
        run["theta"], run["theta_dot"], second, mass=BLOCK.mass, **SHAPE
    )
    assert horizontal.shape == vertical.shape == run.t.shape
    np.testing.assert_allclose(vertical, run["left_reaction"], rtol=1e-9)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: formulas.block_reactions([0.1, 0.0], 0.0, 0.0, mass=1.0, **SHAPE), "theta[1]"),
        (lambda: formulas.centroid_acceleration(0.1, 0.0, 0.0, side=-1, **SHAPE), "side"),
        (lambda: formulas.acceleration_at_impact(0, **SHAPE), "side"),
        (lambda: formulas.impact_speed(7.876, **SHAPE), "theta_0"),
        (lambda: formulas.impact_speed(0.1, radius_ratio=1.2, **SHAPE), "radius_ratio"),
    ],
)
def test_impossible_input_is_refused(call, message):
    assert refused(call)[0] == message
