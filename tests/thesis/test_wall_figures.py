"""Numbers behind the figures of the free vibration of the wall of chapter 4."""

import numpy as np
import pytest
from scipy.integrate import quad

from rockeom.analysis import identification
from rockeom.thesis import statements
from rockeom.thesis.figures import (
    FIGURES,
    chapter_4_free_vibration as record,
    chapter_4_simulated as simulated,
)
from rockeom.thesis.free_vibration_table import WALL, measured_peaks


def verdicts(number):
    return [statement.verdict for statement in FIGURES[number].drawn().statements]


def test_the_line_between_the_rows_passes_through_them():
    measured, line = identification.FreeVibration.table_a1(), record.trace()
    rows = np.flatnonzero(np.cumsum(~record.legible()) == 0)
    at = np.interp(measured.time[rows], line.time, line.displacement)
    assert at == pytest.approx(measured.displacement[rows], abs=1e-6)
    slope = np.gradient(line.displacement, line.time)
    assert slope[1:-1] == pytest.approx(line.velocity[1:-1], abs=2e-3)


def test_what_the_table_says_of_the_thesis():
    """A verdict that changes is a claim of the thesis that was decided otherwise."""
    # the constant r of section 4.9.2.1
    assert pytest.approx(0.835, abs=1e-3) == record.HOUSNER
    assert verdicts("4-11") == ["differs", "holds"]  # 38 % of the toe's compression, not 26 %
    assert verdicts("4-15") == ["differs"]
    assert verdicts("4-29") == ["holds"]
    (quarters,) = FIGURES["4-24"].drawn().statements
    assert quarters.found.startswith("R2 = 0.910 with 13 215")


def test_tendon_force_is_adequate_by_the_measure_of_the_text_and_lies_above_the_peaks():
    """R2 of 0.927; no part of the curve about upright can change the 2.4 to 7.2 kN."""
    judged = [one.judged() for one in statements.of_figure("4-20")]
    assert [one.verdict.value for one in judged] == ["open", "holds", "differs"]
    assert "2.4 to 7.2 kN" in judged[1].words


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
