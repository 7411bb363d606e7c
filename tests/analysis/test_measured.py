"""Measured displacements and periods: geometry drawn point by point, and the printed results."""

import math

import numpy as np
import pytest

from rockeom.analysis import formulas, identification
from tests.refusals import refused


def test_stiffness_and_damper_of_the_steel_column():
    """5-1 and 5-36: 571.8 kN/m and 502.4 N s/m share one mass."""
    mass = 122.6
    assert identification.stiffness_from_period(mass, 0.092) == pytest.approx(571.8e3, abs=50)
    assert identification.viscous_coefficient(0.03, mass, 571.8e3) == pytest.approx(502.4, abs=0.05)
    # the steel feet's own period, which 5.2 states but 5-1 does not use
    assert identification.stiffness_from_period(mass, 0.112) == pytest.approx(385.8e3, abs=50)


def test_damper_makes_the_decrement():
    """A free oscillator with this damper decays with the damping ratio that was asked for."""
    mass, stiffness, ratio = 122.6, 571.8e3, 0.03
    c = identification.viscous_coefficient(ratio, mass, stiffness)
    decay, frequency = c / (2 * mass), math.sqrt(stiffness / mass - (c / (2 * mass)) ** 2)
    peaks = np.exp(-decay * 2 * math.pi / frequency * np.arange(2))
    assert formulas.damping_from_decrement_exact(*peaks) == pytest.approx(ratio, rel=1e-12)


def place(rotation, half_width, height):
    """Displacement of the point above the base's centre, turned about the foot it stands on."""
    side = 1.0 if rotation >= 0 else -1.0
    x, y = -side * half_width, height
    return (x * math.cos(rotation) + y * math.sin(rotation)) - x


@pytest.mark.parametrize("rotation", [-1.2, -0.26, -1e-3, 0.0, 1e-3, 0.1, 0.26, 0.27, 1.2])
def test_rotation_and_displacement_of_a_point(rotation):
    """Beyond the balance, 0.264 rad, too."""
    displacement = place(rotation, 0.285, 1.056)
    assert identification.displacement_from_rotation(rotation, 0.285, 1.056) == pytest.approx(
        displacement, rel=1e-12, abs=1e-15
    )
    assert identification.rotation_from_displacement(displacement, 0.285, 1.056) == pytest.approx(
        rotation, rel=1e-11, abs=1e-15
    )


def test_tiny_rotations_keep_their_digits():
    tiny = np.array([-1e-6, 1e-9, 1e-13])
    back = identification.rotation_from_displacement(
        identification.displacement_from_rotation(tiny, 0.285, 1.056), 0.285, 1.056
    )
    np.testing.assert_allclose(back, tiny, rtol=1e-15)
    np.testing.assert_allclose(
        identification.rotation_from_displacement(tiny, 0.285, 1.056), tiny / 1.056, rtol=1e-6
    )


def test_centre_of_rotation_moves_from_edge_to_edge():
    """5-5 in millimetres: 220.1 tanh(0.1276 Delta) + 300."""
    displacement = np.array([-0.03, -0.002, 0.0, 0.002, 0.03])
    centre = identification.rotation_centre(displacement)
    np.testing.assert_allclose(centre + centre[::-1], 0.6, rtol=1e-14)  # antisymmetric
    assert (np.diff(centre) > 0).all()
    assert centre[-1] == pytest.approx(0.5201, abs=3e-4)
    assert centre[3] == pytest.approx(0.300 + 0.0549, abs=1e-4)
    slope = (identification.rotation_centre(1e-6) - 0.3) / 1e-6
    assert slope == pytest.approx(28.08, abs=0.01)  # 220.1 times 0.1276


def test_moving_centre_at_a_foot_is_the_foot():
    displacement = np.array([-0.02, 0.0, 0.02])
    for centre, half_width in ((0.585, 0.285), (0.015, 0.285), (0.5, 0.2)):
        np.testing.assert_array_equal(
            identification.rotation_about_moving_centre(displacement, centre, 1.056),
            identification.rotation_from_displacement(
                displacement, np.float64(abs(centre - 0.3)), 1.056
            ),
        )
        assert abs(centre - 0.3) == pytest.approx(half_width)


def test_moving_centre_changes_the_rotation_little():
    """5.2.2: "the modification was found to be relatively insignificant"."""
    displacement = np.array([28.58, -25.22, 17.12, -18.20, 11.48]) / 1e3
    moving = identification.rotation_about_moving_centre(
        displacement, identification.rotation_centre(displacement), 1.056
    )
    fixed = identification.rotation_from_displacement(displacement, 0.285, 1.056)
    np.testing.assert_allclose(moving, fixed, rtol=2e-3)
    assert (moving != fixed).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: identification.rotation_from_displacement([27.93, 0.1], 0.285, 1.056),
            "displacement[0]",
        ),
        (lambda: identification.rotation_from_displacement(0.1, 0.285, 0.0), "height"),
        (lambda: identification.rotation_centre(0.01, base_width=0.4), "reach"),
        (lambda: identification.rotation_about_moving_centre(0.01, 0.7, 1.056), "centre"),
        (lambda: identification.stiffness_from_period(100.0, 0.0), "period"),
        (lambda: identification.viscous_coefficient(-0.1, 1.0, 1.0), "damping_ratio"),
    ],
)
def test_impossible_input_is_refused(call, message):
    assert refused(call)[0] == message
