"""Places that generated modules tell: against formulas by hand, and against the energies."""

import functools

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.structures.classes import SHIPPED as CLASSES
from rockeom.structures.positions import places
from rockeom.symbolic import SHIPPED
from tests.contact import declared
from tests.shipped import plain
from tests.typical import S1, column

ANGLES = st.floats(-0.4, 0.4)
LENGTHS = st.floats(-0.5, 0.5)


def rotated(point, about, angle):
    """A point turned clockwise about another one, by the matrix of a rotation."""
    cos, sin = np.cos(angle), np.sin(angle)
    return np.asarray(about) + np.array([[cos, sin], [-sin, cos]]) @ (np.subtract(point, about))


def assert_places(structure, state, expected):
    told = structure.positions(state)
    for name, place in expected.items():
        np.testing.assert_allclose(told[name], place, rtol=1e-12, atol=1e-12, err_msg=name)


# --- by hand

BLOCK = rk.RigidBlock(half_width=0.3, half_height=1.1)


@given(ANGLES)
def test_rigid_block_turns_about_the_foot_to_whose_side_it_leans(theta):
    pivot = (0.3 if theta > 0 else -0.3, 0.0)
    points = {"block": (0, 1.1), "left": (-0.3, 0), "right": (0.3, 0), "load": (0, 1.1)}
    expected = {name: rotated(point, pivot, theta) for name, point in points.items()}
    assert_places(BLOCK, {"theta": theta}, expected)
    assert BLOCK.rotations({"theta": theta}) == {"block": theta}


@given(ANGLES, LENGTHS)
def test_elastic_column_bends_at_right_angles_to_the_turned_base(theta, u):
    pivot = (np.sign(theta) * S1["half_width"], 0.0)
    base = rotated((0, S1["base_height"]), pivot, theta)
    axis = np.array([np.sin(theta), np.cos(theta)])
    across = np.array([np.cos(theta), -np.sin(theta)])
    mass = base + (S1["height"] - S1["base_height"]) * axis + u * across
    expected = {"base": base, "superstructure": mass, "load": mass}
    assert_places(column(), {"theta": theta, "u": u}, expected)


FRAME = {
    "masses": [2e4, 1e4], "heights": [3.0, 6.5], "stiffnesses": [2e7, 1e7], "dampings": [0.0, 0.0],
    "half_width": 2.0, "base_mass": 3e4, "base_height": 0.3, "base_inertia": 1e4,
}  # fmt: skip


@functools.cache
def frame(support):
    return rk.ShearFrame(**FRAME, support=support)


@given(ANGLES, LENGTHS, LENGTHS)
def test_floors_of_a_frame_move_at_right_angles_to_its_turned_axis(theta, u_1, u_2):
    across = np.array([np.cos(theta), -np.sin(theta)])
    up = np.array([np.sin(theta), np.cos(theta)])
    pivot = 2.0 if theta > 0 else -2.0
    middle = np.array([pivot, 0.0]) - pivot * across
    expected = {
        "floor 1": middle + 3.0 * up + u_1 * across,
        "floor 2": middle + 6.5 * up + u_2 * across,
        "base": middle + 0.3 * up,
        "left": middle - 2.0 * across,
        "right": middle + 2.0 * across,
    }
    assert_places(frame(rk.Pinned()), {"theta": theta, "u_1": u_1, "u_2": u_2}, expected)


@given(ANGLES, LENGTHS)
def test_block_that_slides_stands_on_its_lower_corner(theta, x):
    block = rk.SlidingBlock(half_width=0.3, half_height=1.1, friction=0.3, restitution=0.0)
    middle = np.array([x, 0.3 * np.sin(abs(theta))])
    points = {"block": (0, 1.1), "left": (-0.3, 0), "right": (0.3, 0)}
    expected = {name: middle + rotated(p, (0, 0), theta) for name, p in points.items()}
    assert_places(block, {"theta": theta, "x": x}, expected)


@given(ANGLES, LENGTHS)
def test_springs_of_a_bed_stand_under_its_sole(theta, u):
    bed = frame(rk.Winkler(springs=5, stiffness=5e7, damping=0.0))
    settled = 6e4 * 9.81 / (5 * 5e7)
    told = bed.positions({"theta": theta, "u_1": u, "heave": 0.2})
    middle = told["spring_3"]
    names = ["left", "spring_2", "spring_3", "spring_4", "right"]
    for i, name in enumerate(names):
        place = middle + (i - 2) * np.array([np.cos(theta), -np.sin(theta)])
        np.testing.assert_allclose(told[name], place, atol=1e-12)
    assert middle[1] == pytest.approx(0.2 - settled)


@given(ANGLES)
def test_beam_of_a_rocking_frame_stays_level_on_the_corners_that_rise(theta):
    columns = rk.RockingFrame(
        columns=3, column_mass=1e4, half_width=0.6, half_height=3.0, beam_mass=5e4
    )
    s = 1.0 if theta > 0 else -1.0
    corner = rotated((-s * 0.6, 6.0), (s * 0.6, 0.0), theta)
    expected = {
        "columns": rotated((0, 3.0), (s * 0.6, 0.0), theta),
        "beam": corner + np.array([s * 0.6, 0.0]),
    }
    assert_places(columns, {"theta": theta}, expected)
    assert columns.rotations({"theta": theta}) == {"beam": 0.0, "columns": theta}


STACK = rk.StackedBlocks(
    lower=rk.RigidBlock(half_width=0.5, half_height=0.4, mass=2.0),
    upper=rk.RigidBlock(half_width=0.3, half_height=0.7),
)


@given(st.floats(0.01, 0.3), st.floats(0.01, 0.3))
def test_upper_block_stands_on_its_corner_on_the_turned_top_of_the_lower_one(theta, lean):
    phi = theta + lean
    pivot = (0.5, 0.0)
    told = STACK.positions({"theta": theta, "phi": phi})
    foot = rotated((told["right"][0] - 0.5, 0.0), (told["right"][0], 0.0), theta)
    np.testing.assert_allclose(told["lower"], foot + rotated((0, 0.4), (0, 0), theta), atol=1e-12)
    assert told["right"][1] == pytest.approx(pivot[1], abs=1e-12)
    # its right corner is on the line through the lower block's top
    corner = told["upper"] + rotated((0.3, -0.7), (0, 0), phi)
    np.testing.assert_allclose(told["upper_right"], corner, atol=1e-12)
    above = rotated(corner - foot, (0, 0), -theta)
    assert above[1] == pytest.approx(0.8, abs=1e-12)


@functools.cache
def on_unequal_feet():
    return rk.structure(
        declared.unequal_feet(), mass=900.0, inertia=540.0, gravity=9.81, friction=0.3,
        restitution=0.0, height=1.0, left_width=0.3, right_width=0.5, leg=0.2,
    )  # fmt: skip


@given(st.floats(-0.6, 0.3), LENGTHS)
def test_lower_one_of_two_unequal_feet_is_on_the_ground(theta, x):
    told = on_unequal_feet().positions({"theta": theta, "x": x})
    left, right = (rotated(p, (0, 0), theta) for p in ((-0.3, 0.0), (0.5, -0.2)))
    middle = np.array([x, -min(left[1], right[1])])
    for name, point in {"left": left, "right": right}.items():
        np.testing.assert_allclose(told[name], middle + point, atol=1e-12)
    np.testing.assert_allclose(told["block"], middle + rotated((0, 1.0), (0, 0), theta), atol=1e-12)


# --- of every shipped structure


def shipped(name):
    small = {"alpha": 1e-5} if name == "dirac_delta_block" else {}  # what its equations hold for
    return CLASSES[name](**(plain(name) | small))


@functools.cache
def parts(name):
    """A structure, and mass and inertia of each of its bodies."""
    structure, model = shipped(name), SHIPPED[name]().hybrid
    values = {p.symbol: structure.parameters()[p.name] for p in model.parameters}

    def number(expr):
        return float(model.written_out(expr).xreplace(model.constants).subs(values))

    bodies = model.modes[0].bodies
    return structure, np.array([(number(b.mass), number(b.inertia)) for b in bodies])


# its lever is taken as fixed at each instant: the rate at which it moves is not in the model
HELD = "substitute_gravity_wall"


@pytest.mark.parametrize("name", [name for name in SHIPPED if name != HELD])
@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_masses_move_as_the_kinetic_energy_says(name, data):
    structure, masses = parts(name)
    m, p, n = structure.module, structure.vector, structure.module.N_STATES // 2
    numbers = st.floats(-0.15, 0.15)
    y = np.array(data.draw(st.lists(numbers, min_size=2 * n, max_size=2 * n)))
    mode = data.draw(st.integers(0, len(m.MODES) - 1))
    if m.SIDES[mode]:
        y[m.ROTATION] = m.SIDES[mode] * abs(y[m.ROTATION])
    energies = np.zeros(3)
    m.energies(mode, y, p, energies)
    step = 1e-4
    moved = np.array([y, y])
    moved[:, :n] += step * np.array([[-1.0], [1.0]]) * y[n:]
    before, after = places(m, np.array([mode, mode]), moved, p)[:, : len(masses)]
    speeds = (after - before) / (2 * step)
    squares = np.column_stack([(speeds[:, :2] ** 2).sum(axis=1), speeds[:, 2] ** 2])
    kinetic = (masses * squares).sum() / 2
    scale = np.abs(masses).sum() * (speeds**2).max()
    rounding = 1e-12  # of the speeds, by differences of places about 1
    assert kinetic == pytest.approx(energies[0], rel=1e-6, abs=1e-8 * scale + rounding)


LINEAR = ("slender_block", "uplifting_oscillator", "dirac_delta_block")
"""Their responses tell displacements to second order; places are exact."""


@pytest.mark.parametrize("name", [name for name in SHIPPED if name not in LINEAR])
def test_load_point_and_feet_are_displaced_as_the_response_says(name):
    structure = shipped(name)
    m, p = structure.module, structure.vector
    y = np.linspace(0.02, 0.1, m.N_STATES)
    told = np.zeros(len(m.KINEMATICS))
    for mode in range(len(m.MODES)):
        m.kinematics(mode, y, p, told)
        here, rest = places(m, np.array([mode, mode]), np.array([y, 0.0 * y]), p)
        moved = dict(zip(m.POSITIONS, here - rest, strict=True))
        value = dict(zip(m.KINEMATICS, told, strict=True))
        assert moved["load"][0] == pytest.approx(value["displacement"], abs=1e-12)
        for i, kind in enumerate(m.POSITION_KINDS):
            if kind == "foot":
                foot = m.POSITIONS[i]
                assert moved[foot][1] == pytest.approx(value[f"{foot}_uplift"], abs=1e-12)


@given(ANGLES, LENGTHS, st.floats(0.0, 0.5))
def test_gap_of_a_contact_is_its_height(theta, x, y):
    block = rk.SlidingBlock(half_width=0.3, half_height=1.0, friction=0.3, restitution=0.0)
    m, state = block.module, np.array([x, y, theta, 0.0, 0.0, 0.0])
    told = np.zeros(len(m.KINEMATICS))
    m.kinematics(0, state, block.vector, told)
    (found,) = places(m, np.array([0]), state[None], block.vector)
    for name in ("left", "right"):
        gap = told[m.KINEMATICS.index(f"{name}_uplift")]
        assert found[m.POSITIONS.index(name), 1] == pytest.approx(gap, abs=1e-15)


def test_arrays_of_states_are_told_at_once():
    theta, u = np.linspace(-0.1, 0.1, 5)[:, None], np.array([0.0, 0.03])
    told, turned = (f({"theta": theta, "u": u}) for f in (column().positions, column().rotations))
    for i, j in np.ndindex(5, 2):
        one = column().positions({"theta": theta[i, 0], "u": u[j]})
        for name, place in one.items():
            assert told[name].shape == (5, 2, 2)
            np.testing.assert_array_equal(told[name][i, j], place)
        assert turned["base"][i, j] == theta[i, 0]


@pytest.mark.parametrize(
    ("state", "error", "said"),
    [
        (0.1, TypeError, "name the states"),
        ({"phi": 0.1}, ValueError, "unknown state 'phi'"),
        ({"theta": "0.1"}, TypeError, "state theta is '0.1'"),
        ({"theta": [0.1, 0.2], "u": [0.0, 0.0, 0.1]}, ValueError, "broadcast"),
        ({"theta": [0.1, np.nan]}, ValueError, "state theta is nan"),
    ],
)
def test_places_of_what_is_no_state_are_refused(state, error, said):
    with pytest.raises(error, match=said):
        column().positions(state)


def test_motion_through_impacts_is_one_curve():
    """A foot that lands lands where it stood, and nothing jumps where a velocity does."""
    run = rk.simulate(BLOCK, rk.GroundMotion.none(6.0), initial={"theta": 0.15})
    assert len(run.impacts) > 5
    found, turned = run.places.positions(), run.places.rotations()
    assert set(found) == {"block", "left", "right", "load"}
    np.testing.assert_array_equal(turned["block"], run["theta"])
    twice = np.flatnonzero(np.diff(run.t) == 0.0)
    assert len(twice)
    for name, places_ in found.items():
        assert places_.shape == (len(run.t), 2)
        np.testing.assert_allclose(places_[twice], places_[twice + 1], atol=1e-9, err_msg=name)
    for foot, side in (("left", -0.3), ("right", 0.3)):
        down = found[foot][:, 1] < 1e-12
        np.testing.assert_allclose(found[foot][down, 0], side, atol=1e-9)
        np.testing.assert_allclose(found[foot][:, 1], run[f"{foot}_uplift"], atol=1e-12)
