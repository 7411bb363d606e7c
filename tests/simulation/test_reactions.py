"""Forces of the ground: by hand, at rest, and what they say of the model's own assumptions."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from tests.typical import S1, TOTAL_MASS, column, on_springs

GRAVITY = 9.81


@settings(max_examples=100)
@given(
    theta=st.floats(0.001, 1.0),
    side=st.sampled_from([-1, 1]),
    theta_dot=st.floats(-2, 2),
    ground=st.floats(-5, 5),
)
def test_rigid_block_in_motion(theta, side, theta_dot, ground):
    """Thesis 3-8 and 3-9, with 2-9 (its cosine corrected) for the angular acceleration."""
    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
    m, radius, alpha, p = block.mass, block.radius, block.alpha, block.frequency_parameter
    lean = alpha - theta
    acceleration = -(p**2) * (side * math.sin(lean) + ground / GRAVITY * math.cos(lean))
    state = {"theta": side * theta, "theta_dot": theta_dot}
    assert block.accelerations(state, ground)["theta"] == pytest.approx(
        acceleration, rel=1e-12, abs=1e-12
    )

    turning = side * radius * theta_dot**2 * math.sin(lean)
    horizontal = m * (ground + turning + radius * acceleration * math.cos(lean))
    vertical = m * (
        GRAVITY
        - radius * theta_dot**2 * math.cos(lean)
        + side * radius * acceleration * math.sin(lean)
    )
    forces = block.reactions(state, ground)
    pivot, other = ("right", "left") if side == 1 else ("left", "right")
    scale = 1e-11 * m * GRAVITY
    assert forces["horizontal_reaction"] == pytest.approx(horizontal, rel=1e-11, abs=scale)
    assert forces[f"{pivot}_reaction"] == pytest.approx(vertical, rel=1e-11, abs=scale)
    assert forces[f"{other}_reaction"] == 0.0


@pytest.mark.parametrize(
    ("structure", "mass"),
    [
        (rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0), 300.0),
        (rk.SlenderBlock(radius=0.4, alpha=0.2, mass=300.0), 300.0),
        (rk.LumpedMassStructure(**S1), TOTAL_MASS),
        (column(), TOTAL_MASS),
        (on_springs(), TOTAL_MASS),
    ],
    ids=lambda x: getattr(x, "model", ""),
)
def test_standing_structure_presses_with_its_weight(structure, mass):
    forces = structure.reactions({})
    assert forces["horizontal_reaction"] == pytest.approx(0.0, abs=1e-9)
    assert forces["left_reaction"] == pytest.approx(mass * GRAVITY / 2, rel=1e-12)
    assert forces["right_reaction"] == pytest.approx(mass * GRAVITY / 2, rel=1e-12)
    # and, raised by the ground, with more: the whole of m (g + a_y)
    forces = structure.reactions({}, ground_acceleration=0.5, vertical_ground_acceleration=2.0)
    vertical = forces["left_reaction"] + forces["right_reaction"]
    if structure.model != "two_spring_structure":  # springs do not know the ground's acceleration
        assert vertical == pytest.approx(mass * (GRAVITY + 2.0), rel=1e-12)
        # moments about the centre of the base: the left foot is relieved by a ground moving right
        assert forces["horizontal_reaction"] != 0.0
        assert forces["left_reaction"] > forces["right_reaction"]


def test_moment_of_the_reactions_in_full_contact():
    """Overturning moment m H a of a standing block is carried by the difference of the feet."""
    block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)
    forces = block.reactions({}, ground_acceleration=1.3)
    assert forces["horizontal_reaction"] == pytest.approx(300 * 1.3, rel=1e-12)
    couple = (forces["left_reaction"] - forces["right_reaction"]) * 0.1
    assert couple == pytest.approx(300 * 1.3 * 0.4, rel=1e-12)


def test_friction_demand_of_free_rocking():
    """Slender limit 3-14 over 3-15 at a vanishing speed; here at the release, by 3-8 and 3-9."""
    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
    release = 0.05
    run = rk.simulate(block, rk.GroundMotion.none(5.0), initial={"theta": release})
    alpha = block.alpha
    # the least speed and the largest lever: when rocking dies out, 3/4 sin cos/(1 - 3/4 sin^2)
    limit = 0.75 * math.sin(alpha) * math.cos(alpha) / (1 - 0.75 * math.sin(alpha) ** 2)
    assert run.support.friction_demand == pytest.approx(limit, rel=1e-2)
    assert run.support.friction_demand <= limit
    assert not run.support.lost_contact
    assert f"{run.support.friction_demand:.3g}" in run.support.describe()


def test_ground_falling_faster_than_the_structure_is_reported():
    block = rk.RigidBlock(half_width=0.1, half_height=0.4)
    drop = rk.GroundMotion.half_sine(-1.5 * GRAVITY, period=0.2)
    run = rk.simulate(
        block,
        rk.GroundMotion.none(0.1),
        vertical=drop,
        initial={"theta": 0.05},
        duration=0.1,
    )
    assert run.support.lost_contact
    assert "negative" in run.support.describe()
    assert "No foot" not in run.support.describe()
    quiet = rk.simulate(block, rk.GroundMotion.none(0.1), initial={"theta": 0.05})
    assert not quiet.support.lost_contact
    assert "No foot" in quiet.support.describe()


def test_cart_has_no_feet_to_speak_of():
    cart = rk.TwoSpringCart(**S1, foundation_stiffness=550e3)
    run = rk.simulate(cart, rk.GroundMotion.none(0.5), initial={"u": 0.01})
    assert math.isnan(run.support.friction_demand)
    assert not run.support.lost_contact
    assert "no feet" in run.support.describe()


def test_reactions_follow_from_the_motion_of_the_centroid():
    """m (a + x'') and m (g + a_y + y'') with x, y differentiated numerically along a run."""
    structure = column()
    motion = rk.GroundMotion.harmonic(3.0, period=0.4, duration=1.0)
    run = rk.simulate(structure, motion, initial={"theta": 0.06})
    mode = rk.derive("flexible_structure").lambdify()["right"]
    t, h = run.impacts[0].time / 2, 1e-4
    places = mode.positions(
        np.array(list(run.at([t - h, t, t + h]).values())), structure.parameters()
    )
    masses = {"superstructure": S1["mass"], "base": S1["base_mass"]}
    second = sum(
        m * (places[name][:, 0] - 2 * places[name][:, 1] + places[name][:, 2]) / h**2
        for name, m in masses.items()
    )
    state = {name: float(value) for name, value in run.at(t).items()}
    forces = structure.reactions(state, float(motion.acceleration(t)))
    shaking = TOTAL_MASS * float(motion.acceleration(t))
    assert forces["horizontal_reaction"] == pytest.approx(second[0] + shaking, rel=1e-4)
    assert forces["right_reaction"] == pytest.approx(second[1] + TOTAL_MASS * GRAVITY, rel=1e-4)
