"""Numbers behind the figures of the free vibration of the wall of chapter 4."""

import numpy as np
import pytest
from scipy.integrate import quad

from rockeom.analysis import identification
from rockeom.thesis.figures import (
    chapter_4_free_vibration as record,
    chapter_4_simulated as simulated,
)
from rockeom.thesis.free_vibration_table import WALL, measured_peaks
from rockeom.thesis.statements import chapter_4_wall as wall


def test_no_curve_lies_above_the_motion_without_losses():
    """The speeds of Table A-1 stay below 4-23 from the peak before."""
    measured = identification.FreeVibration.table_a1()
    for row, (_, speed) in zip(record.peaks()[:5], record.paths_without_losses(), strict=True):
        assert abs(measured.velocity[row + 1]) < speed.max()


def test_restitution_about_the_corner_is_the_constant_of_4_9_2_1():
    assert pytest.approx(0.835, abs=1e-3) == record.HOUSNER


def test_inertia_of_the_figures_is_that_of_b_9_as_printed():
    """R2 of 4-17: 0.910 with 13 215 kg m2 for the printed 0.911, 0.920 with the right inertia."""
    assert wall.fit_of_4_17(13215.0)[1] == pytest.approx(0.910, abs=5e-4)
    assert wall.fit_of_4_17(record.WALL.corner_inertia)[1] == pytest.approx(0.920, abs=5e-4)


def test_ratios_by_release_are_those_of_the_energies_of_the_peaks():
    """Of 4-32: the integral of the weight and the tendon's force times their lever."""
    r, speed = simulated.ratios_by_release()
    _, peak = measured_peaks()
    alpha = np.arctan2(WALL.half_width, WALL.centroid_height)

    def moment(theta):
        force = WALL.mass * 9.81 + WALL.tendon_force(WALL.height * np.sin(theta))
        return force * WALL.corner_radius * np.sin(alpha - theta)

    theta = np.abs(WALL.rotation(peak))
    energy = np.array([quad(moment, 0.0, x)[0] for x in theta])
    assert r == pytest.approx(energy[1:] / energy[:-1], abs=1e-6)
    landing = np.sqrt(2 * energy[:-1] / WALL.corner_inertia) * WALL.height
    assert speed == pytest.approx(landing, rel=1e-6)
    # an upright displaced to one side makes the ratios alternate
    place = simulated.upright(8)
    assert place.interval("x")[0] > 0
