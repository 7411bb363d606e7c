"""Slips of a wall, and the rotation centre between two gauges, where both are known."""

import numpy as np
import pytest

from rockeom import analysis
from rockeom.analysis import identification
from tests.refusals import refused

WALL = analysis.Wall.thesis()
T = np.arange(0.0, 2.4, 0.005)


def sliding(sigma_mm=0.05, sigma_kn=0.1):
    """A decaying motion of 3 Hz about an origin that jumps twice, at passages through upright."""
    rng = np.random.default_rng(7)
    own = 0.02 * np.exp(-0.5 * T) * np.cos(2 * np.pi * 3 * T)
    origin = np.where(T < 7 / 12, 0.0, np.where(T < 15 / 12, 1.2e-3, -0.6e-3))
    force = WALL.tendon_force(own) + rng.normal(0, sigma_kn * 1e3, len(T))
    left = WALL.uplift(own, -WALL.half_width) + rng.normal(0, sigma_mm * 1e-3, len(T))
    right = WALL.uplift(own, WALL.half_width) + rng.normal(0, sigma_mm * 1e-3, len(T))
    moved = own + origin + rng.normal(0, sigma_mm * 1e-3, len(T))
    return moved, force, left, right, lambda t: np.interp(t, T, origin)


@pytest.mark.parametrize("by", ["tendon force", "uplifts"])
def test_slips_are_found_with_their_size_and_place(by):
    moved, force, left, right, origin = sliding()
    if by == "uplifts":
        found = identification.slips_from_uplifts(T, moved, left, right, WALL)
    else:
        found = identification.slips_from_tendon_force(T, moved, force, WALL)
    assert len(found.time) > 10
    error = found.shift - origin(found.time)
    assert np.mean(np.abs(error) <= found.half_width) > 0.8
    assert np.abs(error).max() < 2e-4
    jumps = np.flatnonzero(np.abs(found.steps) > 5e-4)
    np.testing.assert_allclose(found.steps[jumps], [1.2e-3, -1.8e-3], atol=2e-4)
    assert found.clear[jumps].all()
    assert found.clear.sum() < 5


def test_a_wall_that_stays_has_no_slips():
    moved, force, *_, origin = sliding()
    found = identification.slips_from_tendon_force(T, moved - origin(T), force, WALL)
    assert np.abs(found.shift).max() < 2e-4


def test_rotation_centre_between_gauges_with_its_uncertainty():
    turned, centre, sigma = 0.01, 0.25, 2e-5
    rng = np.random.default_rng(0)
    left = turned * centre + rng.normal(0, sigma, 4000)
    right = -turned * (0.6 - centre) + rng.normal(0, sigma, 4000)
    found, half_width = identification.rotation_centre_between_gauges(left, right, 0.6, noise=sigma)
    assert np.mean(np.abs(found - centre) <= half_width) == pytest.approx(0.954, abs=0.012)
    # 4-1 has absolute values, the same for readings of opposite signs
    printed = 0.6 * np.abs(left) / (np.abs(left) + np.abs(right))
    np.testing.assert_allclose(found, printed, rtol=1e-12)
    still, _ = identification.rotation_centre_between_gauges(
        [3e-5, 0.0], [-3e-5, 0.0], 0.6, noise=2e-5
    )
    assert np.isnan(still).all()


def test_what_cannot_be_is_refused():
    with pytest.raises(ValueError, match="never passes upright"):
        identification.slips_from_tendon_force(T, 0.02 + 0 * T, 0 * T, WALL)
    assert refused(identification.slips_from_tendon_force, T[:5], T[:5], T[:5], WALL)[0] == "time"
    assert refused(identification.rotation_centre_between_gauges, 0.1, 0.2, 0.0) == ("spacing", 0.0)
