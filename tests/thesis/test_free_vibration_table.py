"""The free vibration of Table A-1 beside the models of the wall and their restitution laws."""

from dataclasses import replace

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas, identification
from rockeom.thesis.free_vibration_table import (
    STIFFER,
    WALL,
    free_vibration_peaks,
    measured_peaks,
    released_peaks,
)
from rockeom.thesis.side_by_side import side_by_side

TABLE = identification.FreeVibration.table_a1()


@pytest.fixture(scope="module")
def rows():
    return free_vibration_peaks()


def test_measured_peaks_are_legible_and_the_later_ones_are_left_out():
    time, peak = measured_peaks()
    assert len(time) == len(peak) == 13
    assert time[-1] == 1.315
    at_peaks = TABLE.reading[TABLE.at_peak]
    assert set(at_peaks[:13]) == {"clean"}
    assert len(at_peaks) == 23
    assert (at_peaks[13:] != "clean").sum() == 6
    np.testing.assert_allclose(time / 0.005, np.round(time / 0.005), atol=1e-9)


@pytest.mark.parametrize(
    ("index", "model", "law", "time", "peak"),
    [
        (0, "ControlledWallOscillator", "r = 0.88", 21.88, 1.129),
        (1, "ControlledWallOscillator", "r = 0.88, F_k + 6 %", 5.34, 1.129),
        (2, "ControlledWallOscillator", "4-31, r of a whole passage, F_k + 6 %", 28.25, 1.430),
        (3, "ControlledWallOscillator", "4-31, r of the instant, F_k + 6 %", 21.76, 1.420),
        (4, "SubstituteGravityWall", "4-38", 7.24, 1.421),
        (5, "SimplifiedSubstituteGravityWall", "r = 0.88", 49.47, 1.323),
        (6, "SimplifiedSubstituteGravityWall", "4-31", 12.39, 2.920),
        (7, "SimplifiedSubstituteGravityWall", "4-36", 24.83, 1.142),
        (8, "ControlledWall", "r = 0.88", 16.68, 1.253),
    ],
)
def test_errors_of_each_model_and_law(rows, index, model, law, time, peak):
    """Root mean squares in ms and mm, to the last digit."""
    row = rows[index]
    assert (row.model, row.law) == (model, law)
    assert 1e3 * row.rms_time == pytest.approx(time, abs=0.01)
    assert 1e3 * row.rms_peak == pytest.approx(peak, abs=0.001)
    assert len(rows) == 9


def test_two_models_meet_the_measured_peaks(rows):
    """The oscillator within 6 ms and 1.2 mm, the substitute gravity within 9 ms and 1.5 mm."""
    found = {(r.model, r.law): (r.rms_time, r.rms_peak) for r in rows}
    time, peak = found["ControlledWallOscillator", "r = 0.88, F_k + 6 %"]
    assert time < 6e-3
    assert peak < 1.2e-3
    time, peak = found["SubstituteGravityWall", "4-38"]
    assert time < 9e-3
    assert peak < 1.5e-3


def test_errors_are_those_of_the_rows(rows):
    time, peak = measured_peaks()
    for row in rows:
        assert row.time.shape == row.peak.shape == (13,)
        assert row.time[0] == 0
        assert row.peak[0] == pytest.approx(peak[0], abs=1e-12)
        assert (np.diff(row.time) > 0).all()
        assert (np.sign(row.peak) == np.sign(peak)).all()
        assert row.rms_time**2 == pytest.approx(((row.time - time) ** 2).sum() / 13)
        assert row.rms_peak**2 == pytest.approx(((row.peak - peak) ** 2).sum() / 13)


def test_peaks_of_a_constant_ratio_are_those_of_the_closed_form_for_any_mass(rows):
    closed = formulas.peak_sequence(
        WALL.restoring_force, TABLE.displacement[0], 0.88, WALL.rotation_centre.epsilon, 12
    )
    for row in rows[:2]:
        np.testing.assert_allclose(row.peak, closed, rtol=0, atol=1e-9)


def test_a_greater_force_shortens_all_times_alike(rows):
    np.testing.assert_allclose(rows[0].time, np.sqrt(STIFFER) * rows[1].time, rtol=0, atol=1e-8)
    assert STIFFER == 1.06  # as the words "F_k + 6 %" say


def test_laws_that_jump_answer_small_changes_by_half_a_millimetre(rows):
    """A percent of F_k, or a tenth of epsilon, puts a passage to the other side of 0.78 m/s."""
    at_speed = rk.EnergyRatioAtSpeed
    softer = rk.ControlledWallOscillator.from_wall(
        WALL, at_speed.equation_4_31(), effective_mass=WALL.mass / (STIFFER - 0.01)
    )
    centre = replace(WALL.rotation_centre, epsilon=1.1 * WALL.rotation_centre.epsilon)
    later = rk.SubstituteGravityWall.from_wall(replace(WALL, rotation_centre=centre))
    for structure, law, row in (
        (softer, None, rows[2]),
        (later, at_speed.equation_4_38(), rows[4]),
    ):
        changed = released_peaks(structure, law, "")
        assert row.rms_peak - changed.rms_peak == pytest.approx(0.55e-3, abs=0.1e-3)


def test_tables_show_the_rows(rows):
    _, summary, times, peaks = side_by_side("A-1")
    for i, row in enumerate(rows):
        number, model, law, time, peak = summary.rows[i]
        assert (number, model, law) == (str(i + 1), row.model, row.law)
        assert float(time) == pytest.approx(1e3 * row.rms_time, abs=0.005)
        assert float(peak) == pytest.approx(1e3 * row.rms_peak, abs=0.005)
        assert times.columns[i + 1] == peaks.columns[i + 1] == number
        np.testing.assert_allclose([float(r[i + 1]) for r in times.rows], row.time, atol=5.1e-5)
        np.testing.assert_allclose(
            [float(r[i + 1]) for r in peaks.rows], 1e3 * row.peak, atol=5.1e-3
        )
    time, peak = measured_peaks()
    np.testing.assert_allclose([float(r[0]) for r in times.rows], time)
    np.testing.assert_allclose([float(r[0]) for r in peaks.rows], 1e3 * peak)
