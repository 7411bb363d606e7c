"""Formulas of chapter 4 for the wall of its tests, by printed numbers and by its geometry."""

import numpy as np
import pytest

from rockeom import analysis
from rockeom.thesis.wall_tests import (
    back_calculated_force,
    corrected_uplifts,
    energy_ratio_4_31,
    energy_ratio_4_36,
    energy_ratio_4_38,
    harmonic_force,
    quarter_period_fit,
)
from tests.refusals import refused

WALL = analysis.Wall.thesis()


def test_gauges_outside_the_wall():
    """Readings of gauges on the line of the base give back the uplift of its edges."""
    d = np.array([-0.03, -0.001, 0.002, 0.02])
    edges = corrected_uplifts(WALL.uplift(d, -0.538), WALL.uplift(d, 0.538))
    np.testing.assert_allclose(edges.left, WALL.uplift(d, -0.508), rtol=1e-9)
    np.testing.assert_allclose(edges.right, WALL.uplift(d, 0.508), rtol=1e-9)
    inside = np.where(d > 0, 1, -1) * (WALL.detached_length(d) - 0.508)
    np.testing.assert_allclose(edges.centre_from_left_gauge, 0.538 + inside, rtol=1e-9)
    # 4-1 to 4-4 as printed, in mm
    left, right = -0.9, 11.8
    x = 1076 * 0.9 / 12.7
    edges = corrected_uplifts(left * 1e-3, right * 1e-3)
    assert edges.left == pytest.approx(left * (x - 30) / x * 1e-3)
    assert edges.right == pytest.approx(right * (1076 - x - 30) / (1076 - x) * 1e-3)
    level = corrected_uplifts(1e-3, 1e-3)
    assert (level.left, level.right) == (1e-3, 1e-3)
    assert np.isnan(level.centre_from_left_gauge)


def test_bands_of_the_restitution():
    v = np.array([0.0, 0.15, -0.299, 0.3, 0.4, 0.47, -0.7, 0.78, 0.9])
    expected = [0.85, 0.85 + 0.15 / 45, 0.85 + 0.299 / 45, 0.81, 0.81, 0.852, 0.852, 0.95, 0.95]
    np.testing.assert_allclose(energy_ratio_4_31(v), expected, rtol=1e-15)
    v = np.array([-0.2, 0.364999, 0.365, 0.47, 0.78])
    expected = [0.645, 0.809999, 0.81, 0.85, 0.94]
    np.testing.assert_allclose(energy_ratio_4_38(v), expected, rtol=1e-15)
    # the text wants 0.88 for the slowest and 0.91 for the fastest impacts or the reverse
    np.testing.assert_allclose(energy_ratio_4_36([0.34, -1.02]), [0.88, 0.91], atol=1e-4)
    assert refused(energy_ratio_4_36, 5.0) == ("velocity", 5.0)


def test_forces_of_the_ground():
    assert back_calculated_force(2016.06, -12.0, 2.0) == pytest.approx(20160.6)
    # 16 pi t reaches pi/2 after 1/32 s
    assert harmonic_force(1 / 32, 2016.06, 5.88) == pytest.approx(-2016.06 * 5.88)


def test_an_argument_outside_its_range_is_refused():
    assert refused(corrected_uplifts, 0.0, 0.0, 1.0, 0.5) == ("overhang", 0.5)
    assert refused(quarter_period_fit, 6.0) == ("displacement", 6.0)
