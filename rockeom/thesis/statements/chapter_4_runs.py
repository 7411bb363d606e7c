"""Statements of sections 4.9.1.3 to 4.9.1.5 and 4.9.2.1 on simulated runs of the shaken wall.

The motions of the shaking table are lost. Runs are simulated with the records that were meant, and
their ranges are those of `rockeom.thesis.shaken.wall_motions`: the peak that was meant and that of
the table, each within 10 %, and for Sylmar the time scale of Tabas.
"""

import numpy as np

import rockeom as rk
from rockeom.analysis import identification
from rockeom.thesis import shaken
from rockeom.thesis.figures.chapter_4_free_vibration import legible
from rockeom.thesis.figures.chapter_4_shaken import (
    displacement,
    measured_peak,
    oscillator_run,
    peaks_by_ratio,
    settled,
    settled_speeds,
)
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_1, TABLE_4_3
from rockeom.thesis.statements import statement as st
from rockeom.thesis.wall_tests import back_calculated_force

_LAW_31 = rk.EnergyRatioAtSpeed.equation_4_31()
_LAW_38 = rk.EnergyRatioAtSpeed.equation_4_38()


# --- Tables 4-3 and 4-5


def _sizes(peaks: np.ndarray) -> np.ndarray:
    """Sizes of displacement [mm] and velocity [m/s] under each motion, (n, 2)."""
    return np.abs(peaks[:, :2]) * [1e3, 1.0]


def _said(peaks: np.ndarray) -> str:
    (u, v), sizes = peaks[0, :2], _sizes(peaks)
    return (
        f"{1e3 * u:.2f} mm and {v:.2f} m/s with the peak of the table; {sizes[:, 0].min():.1f} to "
        f"{sizes[:, 0].max():.1f} mm, {sizes[:, 1].min():.2f} to {sizes[:, 1].max():.2f} m/s over "
        "the range"
    )


_LAWS = {"SDOF": _LAW_31, "MHSG": _LAW_38, "r by 4-31": _LAW_31, "constant r": 0.852}


def peaks_of_run(run: str, model: str) -> st.Finding:
    """Sizes of displacement and velocity of a run, by a model as the tables name it."""
    simulated = shaken.substitute_gravity_peaks if model == "MHSG" else shaken.oscillator_peaks
    peaks = simulated(run, _LAWS[model])
    return st.ranging(_sizes(peaks), _said(peaks))


def printed_peaks_by_sdof() -> st.Finding:
    ratios = {
        run: abs(TABLE_4_3.cell(run, "displacement, SDOF") / TABLE_4_3.cell(run, "displacement"))
        for run in ("1", "2", "3", "4", "6")
    }
    best = min(ratios.values(), key=lambda x: abs(x - 1))
    return st.finding(best, ", ".join(f"run {run} {x:.2f}" for run, x in ratios.items()))


def tracking_of_run_4() -> st.Finding:
    return st.unknown("there is nothing to correlate with")


def time_scale_of_run_4() -> st.Finding:
    motions = [shaken.sylmar_360().scaled(time=x) for x in (shaken.SYLMAR_TIME, shaken.TABAS_TIME)]
    wall = shaken.oscillator_of("4", _LAW_31)
    peaks = [1e3 * abs(rk.simulate(wall, m).extremes("u").peak) for m in motions]
    speeds = [m.peak_velocity for m in motions]
    return st.ranging(
        peaks,
        f"{peaks[0]:.1f} mm, but {peaks[1]:.1f} mm scaled by 0.38 as Tabas is; the PGV is "
        f"{speeds[0]:.3f} and {speeds[1]:.3f} m/s, printed {TABLE_4_1.cell('4', 'PGV'):g}",
    )


# --- 4.9.1.4 trials


def restoring_force_of_the_free_vibration() -> st.Finding:
    measured = identification.FreeVibration.table_a1()
    rows = measured.at_peak & legible()
    force = back_calculated_force(WALL.mass, measured.acceleration[rows])
    own = WALL.restoring_force(measured.displacement[rows])
    fit = float(identification.coefficient_of_determination(force, own))
    return st.finding(fit, f"{fit:.3f} in the free vibration")


def run_4_with_a_constant_ratio() -> st.Finding:
    peaks = shaken.oscillator_peaks("4", 0.852)
    return st.ranging(_sizes(peaks)[:, 0], _said(peaks))


def trials_of_run_4() -> st.Finding:
    peaks = {name: 1e3 * float(run.peak) for name, run in shaken.trials().items()}
    error = min(abs(x / (1e3 * abs(measured_peak("4"))) - 1) for x in peaks.values())
    return st.finding(error, ", ".join(f"{name} {x:.1f} mm" for name, x in peaks.items()))


def conservative_analyses() -> st.Finding:
    _, peaks = peaks_by_ratio()
    share = 100 * float(np.mean(peaks >= abs(measured_peak("4"))))
    return st.finding(
        share,
        f"{share:.0f} % reach the measured 23.91 mm; the largest is {1e3 * peaks.max():.1f} mm",
    )


def trend_with_restitution() -> st.Finding:
    _, peaks = peaks_by_ratio()
    jumps = np.sign(np.diff(peaks))
    turns = int(np.count_nonzero(jumps[1:] * jumps[:-1] < 0))
    return st.finding(
        turns / (len(peaks) - 2),
        f"{turns} of {len(peaks) - 2}; {1e3 * peaks.min():.2f} to {1e3 * peaks.max():.2f} mm",
    )


# --- 4.9.1.5 sensitivity


def velocities_of_the_steady_motion() -> st.Finding:
    u, _, speeds = settled()
    distinct = len(np.unique(np.round(speeds, 6)))
    return st.finding(
        distinct,
        f"{distinct} velocities when upright in 40 cycles, {np.abs(speeds).max():.3f} m/s, "
        f"{1e3 * np.abs(u).max():.1f} mm",
    )


def velocities_above_the_doubling() -> st.Finding:
    counts = [
        len(np.unique(np.round(settled_speeds(8.0, z, {"u": 0.0})[0], 4))) for z in (5.9, 6.1)
    ]
    return st.finding(
        counts[1], f"{counts[0]} and {counts[1]} velocities when upright at 5.9 and 6.1"
    )


def velocities_in_the_smear() -> st.Finding:
    starts = ({"u": 0.0}, {"u": 0.02}, {"u": 0.004, "u_dot": -0.6})
    counts = [len(np.unique(np.round(settled_speeds(8.0, 6.3, at)[0], 4))) for at in starts]
    return st.ranging(counts, f"{counts} velocities when upright at 6.3, from three starts")


def growth_of_a_small_difference() -> st.Finding:
    first = oscillator_run("4")
    again = rk.simulate(first.structure, first.motion, initial={"u": shaken.BESIDE})
    t = np.arange(0.0, 15.0, 2e-3)
    apart = float(np.abs(displacement(first, t) - displacement(again, t)).max())
    return st.finding(
        apart / shaken.BESIDE,
        f"in kind, {1e3 * shaken.BESIDE:g} mm apart at first they come {1e3 * apart:.2f} mm apart",
    )
