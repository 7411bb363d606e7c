"""A rocking wall linked to an elastic frame: what is left where one of the three is not."""

import numpy as np
import pytest
from scipy.linalg import eigh

import rockeom as rk

GRAVITY = 9.81
WALL = {"mass": 40e3, "half_width": 1.2, "height": 5.0, "inertia": 4e5}
FRAME = {"frame_mass": 60e3, "frame_stiffness": 5e6, "frame_damping": 0.0}
LINK = {"link_height": 8.0, "link_stiffness": 4e7, "link_damping": 0.0}
PIVOT_INERTIA = WALL["inertia"] + WALL["mass"] * (WALL["height"] ** 2 + WALL["half_width"] ** 2)


def linked(**changes):
    return rk.WallWithFrame(**(WALL | FRAME | LINK | changes))


def wall(**changes):
    values = {"mass": WALL["mass"], "base_mass": 0.0, "base_height": 0.0, "base_inertia": 0.0}
    values |= {k: WALL[k] for k in ("half_width", "height", "inertia")}
    return rk.LumpedMassStructure(**(values | changes))


# -- no link, no frame, no wall


def test_without_a_link_the_wall_and_the_frame_move_by_themselves():
    """The wall as a block of its own; the frame as an oscillator, whatever the wall does."""
    apart = linked(link_stiffness=1e-9, link_damping=1e-12, frame_damping=2e4)
    state = {"theta": 0.03, "theta_dot": -0.2}
    both = apart.accelerations(state | {"u": 0.02, "u_dot": 0.1}, 1.5, 0.7)
    assert both["theta"] == pytest.approx(wall().accelerations(state, 1.5, 0.7)["theta"])
    assert both["u"] == pytest.approx(-1.5 - (5e6 * 0.02 + 2e4 * 0.1) / 60e3)
    assert apart.velocity_ratio == pytest.approx(wall().velocity_ratio, rel=1e-14)
    forces = apart.reactions(state | {"u": 0.02, "u_dot": 0.1}, 1.5, 0.7)
    assert forces == pytest.approx(wall().reactions(state, 1.5, 0.7))


@pytest.mark.parametrize("damping", [0.0, 3e4])
def test_with_the_wall_on_the_ground_frame_and_link_are_springs_side_by_side(damping):
    period = 2 * np.pi / np.sqrt((5e6 + 4e7) / 60e3)
    held = linked(link_damping=damping).fixed_base()
    assert held.periods == pytest.approx([period], rel=1e-10)
    ratio = damping / (2 * np.sqrt((5e6 + 4e7) * 60e3))
    assert held.damping_ratios == pytest.approx([ratio], abs=1e-12)


def on_the_wall(rotations):
    """(force at the link's height that holds the wall alone, what its axis moves there)."""
    b, h, h_l = WALL["half_width"], WALL["height"], LINK["link_height"]
    restoring = WALL["mass"] * GRAVITY * (b * np.cos(rotations) - h * np.sin(rotations))
    lever = h_l * np.cos(rotations) + b * np.sin(rotations)
    return restoring / lever, h_l * np.sin(rotations) + b * (1 - np.cos(rotations))


def test_without_frame_the_pushover_is_that_of_the_wall_alone():
    rotations = np.array([0.0, 0.02, 0.1])
    light = linked(frame_mass=1e-6, frame_stiffness=1e-6)
    np.testing.assert_allclose(light.pushover(rotations), on_the_wall(rotations)[0], rtol=1e-7)


@pytest.mark.parametrize("link", [4e7, 1e9])
def test_a_push_on_the_frame_is_shared_with_the_wall(link):
    """The link hands on what holds the wall and gives way to it; the stiffer, the less."""
    rotations = np.array([-0.05, 0.01, 0.05])
    alone, moved = on_the_wall(np.abs(rotations))
    expected = np.sign(rotations) * (alone + 5e6 * (moved + alone / link))
    found = linked(link_stiffness=link).pushover(rotations)
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def modes(structure, rotation):
    """Circular frequencies of small motion about the equilibrium under a held push [rad/s]."""
    m, p = structure.module, structure.vector
    force, y = structure.equilibrium(rotation)
    mode = m.MODES.index("right")

    def lacking(q):
        out = np.zeros(2)
        m.statics(mode, np.array([*q, 0.0, 0.0]), p, force, out)
        return out

    steps = 1e-5 * np.eye(2)
    stiffness = [(lacking(y[:2] + h) - lacking(y[:2] - h)) / 2e-5 for h in steps]
    squares = eigh(
        np.transpose(stiffness), np.diag([PIVOT_INERTIA, FRAME["frame_mass"]]), eigvals_only=True
    )
    return np.sqrt(squares)


def test_modes_of_the_lifted_wall_on_a_stiff_link():
    """The slow one turns wall and frame as one body, the fast one stretches the link."""
    b, h, h_l = WALL["half_width"], WALL["height"], LINK["link_height"]
    theta = 0.02
    stiff = linked(link_stiffness=1e11)
    slow, fast = modes(stiff, theta)
    moved = h_l * np.sin(theta) + b * (1 - np.cos(theta))
    lever = h_l * np.cos(theta) + b * np.sin(theta)
    inertia = PIVOT_INERTIA + FRAME["frame_mass"] * lever**2
    weight = WALL["mass"] * GRAVITY
    restoring = weight * (b * np.cos(theta) - h * np.sin(theta)) + 5e6 * moved * lever
    # energy to the second order, less what the push does that holds it there
    curvature = b * np.cos(theta) - h_l * np.sin(theta)
    stiffness = 5e6 * (lever**2 + moved * curvature) - restoring / lever * curvature
    stiffness -= weight * (b * np.sin(theta) + h * np.cos(theta))
    assert slow == pytest.approx(np.sqrt(stiffness / inertia), rel=1e-4)
    stretched = np.sqrt(1e11 * (1 / FRAME["frame_mass"] + lever**2 / PIVOT_INERTIA))
    assert fast == pytest.approx(stretched, rel=1e-3)


def test_mass_matrix_and_stiffness_are_those_of_the_motion():
    """What the statics of `modes` leaves out: the accelerations are those of these matrices."""
    y = {"theta": 0.02, "u": 0.3}
    out = np.zeros(2)
    s = linked()
    s.module.statics(s.module.MODES.index("right"), s.state(y), s.vector, 0.0, out)
    found = s.accelerations(y)
    assert found["theta"] == pytest.approx(-out[0] / PIVOT_INERTIA, rel=1e-12)
    assert found["u"] == pytest.approx(-out[1] / FRAME["frame_mass"], rel=1e-12)


# -- impacts and energy


def test_an_impact_of_the_wall_does_not_jolt_the_frame():
    for law in (rk.AngularMomentum(), rk.Impulsive()):
        landing = {"theta_dot": -0.3, "u": 0.01, "u_dot": 0.2}
        after, follows = linked().after_impact(landing, "right", law)
        assert follows == "left"
        assert after["u_dot"] == 0.2
        assert after["theta_dot"] == pytest.approx(-0.3 * wall().velocity_ratio, rel=1e-13)


def test_energy_is_kept_between_impacts():
    run = rk.simulate(linked(), rk.GroundMotion.none(4.0), initial={"theta": 0.04, "u": 0.3})
    assert len(run.impacts) >= 2
    jumps = np.flatnonzero(np.diff(run.t) == 0.0)
    changes = np.diff(run["total_energy"])
    size = np.ptp(run["elastic_energy"])
    assert np.abs(np.delete(changes, jumps)).max() < 1e-7 * size
    assert (changes[jumps] < 1e-9 * size).all()
