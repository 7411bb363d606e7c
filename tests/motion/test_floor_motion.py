"""The motion of a floor of an elastic building, compared with other integrations of the same."""

import dataclasses

import numpy as np
import pytest
from scipy import signal
from scipy.linalg import eigh

import rockeom as rk
from tests.refusals import refused, told

DT = 0.01


def record() -> rk.GroundMotion:
    t = DT * np.arange(600)
    a = np.sin(9.0 * t) * np.exp(-0.6 * t) + 0.4 * np.sin(31.0 * t) * np.exp(-0.3 * t)
    return rk.GroundMotion.from_array(a, DT, name="record")


def test_roof_of_one_mode_moves_as_an_oscillator_solved_by_scipy():
    omega, xi = 2 * np.pi / 0.5, 0.05
    floor = rk.floor_motion(record(), periods=0.5, participation=1.0, damping_ratio=xi)
    t = floor.dt * np.arange(len(floor.samples))
    absolute = signal.TransferFunction([2 * xi * omega, omega**2], [1, 2 * xi * omega, omega**2])
    _, expected, _ = signal.lsim(absolute, record().acceleration(t), t)
    np.testing.assert_allclose(floor.samples, expected, atol=1e-10)


def test_floors_of_a_frame_move_as_its_matrices_say():
    """Two storeys as one linear system of four states, with the damping of Rayleigh."""
    m, k = np.diag([20e3, 15e3]), np.array([[5e7, -2e7], [-2e7, 2e7]])
    squares, phi = eigh(k, m)
    omega = np.sqrt(squares)
    xi = 0.05
    of_mass, of_stiffness = 2 * xi * omega.prod() / omega.sum(), 2 * xi / omega.sum()
    pull = np.linalg.solve(m, np.hstack([k, of_mass * m + of_stiffness * k]))
    system = np.vstack([np.eye(2, 4, 2), -pull])
    shares = phi * (phi.T @ m @ np.ones(2))  # of the floor in the row, of the mode in the column
    for floor in (0, 1):
        made = rk.floor_motion(record(), 2 * np.pi / omega, participation=shares[floor])
        t = made.dt * np.arange(len(made.samples))
        force = np.array([[0.0], [0.0], [-1.0], [-1.0]])
        _, absolute, _ = signal.lsim(
            (system, force, -pull[[floor]], [[0.0]]), record().acceleration(t), t
        )
        np.testing.assert_allclose(made.samples, absolute, atol=1e-9)


def test_many_modes_on_the_ground_and_stiff_buildings_move_as_the_ground():
    a = record()
    on_the_ground = rk.floor_motion(a, periods=[0.6, 0.2], height=0.0)
    stiff = rk.floor_motion(a, periods=[0.002], height=1.0)
    t = DT * np.arange(600)
    np.testing.assert_allclose(on_the_ground.acceleration(t), a.samples, atol=1e-12)
    np.testing.assert_allclose(stiff.acceleration(t), a.samples, atol=2e-3)


def test_roof_in_resonance_grows_to_the_steady_state_of_the_shear_building():
    """Under a harmonic motion the closed form of the shear beam, 4/pi times Q of its first mode."""
    xi, period = 0.05, 0.5
    shaking = rk.GroundMotion.harmonic(1.0, period=period, duration=20.0)
    roof = rk.floor_motion(shaking, periods=[period, period / 3], damping_ratio=xi)
    steady = np.abs(roof.samples[(roof.dt * np.arange(len(roof.samples)) > 15.0)]).max()
    r = np.array([1.0, 1.0 / 3.0])  # of the frequency of the ground to those of the modes
    absolute = (1 + 2j * xi * r) / (1 - r**2 + 2j * xi * r)
    shares = np.array([4 / np.pi, -4 / (3 * np.pi)])
    assert steady == pytest.approx(abs(1 - shares.sum() + shares @ absolute), rel=5e-3)


def test_building_rings_on_after_the_record_until_a_hundredth_is_left():
    push = rk.GroundMotion.half_sine(2.0, period=0.4, duration=0.2)
    floor = rk.floor_motion(push, periods=0.5, damping_ratio=0.02)
    after = np.abs(floor.samples[floor.dt * np.arange(len(floor.samples)) > 0.2])
    last = after[-round(0.5 / floor.dt) :].max()
    assert last / after.max() == pytest.approx(0.0103, rel=0.1)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"periods": [0.2, 0.6]}, ["periods is [0.2, 0.6]", "longest first"]),
        ({"periods": []}, ["periods", "positive"]),
        ({"periods": "0.5 s"}, ["periods"]),
        ({"periods": [0.5, -0.1]}, ["positive"]),
        ({"periods": 0.5, "height": 12.0}, ["height is 12", "from 0 to 1"]),
        ({"periods": 0.5, "damping_ratio": 5.0}, ["damping_ratio is 5", "0.05"]),
        ({"periods": 0.5, "participation": [1.0, 0.3]}, ["participation", "1 period"]),
        ({"periods": 0.5, "participation": 1.0, "height": 0.5}, ["exclude"]),
    ],
)
def test_mistake_is_named_with_its_remedy(arguments, words):
    message = told(rk.floor_motion, record(), **arguments)
    assert all(word in message for word in words), message


def test_vertical_record_and_a_path_are_refused():
    up = dataclasses.replace(record(), is_vertical=True)
    for wrong in (up, "record.at2"):
        assert refused(rk.floor_motion, wrong, periods=0.5)[0] == "record"
