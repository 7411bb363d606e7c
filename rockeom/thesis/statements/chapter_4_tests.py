"""Statements of 4.4, 4.9, 4.9.1 to 4.9.1.2, 4.9.2 and Appendix A on tests of the shaken wall."""

from functools import cache

import numpy as np

from rockeom import analysis
from rockeom.analysis import identification
from rockeom.motion import STANDARD_GRAVITY
from rockeom.thesis import shaken
from rockeom.thesis.figures import chapter_4_tests as figures
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_1, TABLE_4_2, TABLE_4_4
from rockeom.thesis.statements import statement as st


def _of_75_kn(table: object, column: str) -> np.ndarray:
    return np.array([table.cell(run, column) for run in figures.RUNS])  # type: ignore[attr-defined]


# --- 4.4 the motions


def peaks_of_the_table() -> st.Finding:
    off = {
        run: 100 * (TABLE_4_1.cell(run, "PGA") / shaken.intended_motion(run).peak - 1)
        for run in ("1", "2", "4", "7", "9")
    }
    return st.finding(
        max(map(abs, off.values())), ", ".join(f"run {run} {x:+.1f} %" for run, x in off.items())
    )


def velocities_of_the_table() -> st.Finding:
    runs = ("1", "2", "4", "7", "9")
    ratio = [TABLE_4_1.cell(run, "PGV") / shaken.intended_motion(run).peak_velocity for run in runs]
    return st.finding(
        ratio, f"their PGV is {min(ratio):.2f} to {max(ratio):.2f} of that of the records"
    )


@cache
def _over_design(run: str) -> np.ndarray:
    """(m, n) spectra of the motions that a run may have had over the design spectrum."""
    t = np.linspace(*figures.ROCKING_PERIODS, 15)
    return np.array([
        analysis.response_spectrum(motion, t).pseudo_acceleration / figures.nzs_1170_5(t)
        for motion in shaken.wall_motions(run)
    ])  # fmt: skip


def el_centro_over_the_design_level() -> st.Finding:
    ratios = [_over_design(run).max(axis=1) for run in ("1", "2")]
    said = ", ".join(f"{x.min():.2f} to {x.max():.2f}" for x in ratios)
    return st.ranging(
        np.transpose(ratios), f"at most {said} of the design level, by the peak meant and reached"
    )


def sylmar_over_the_design_level() -> st.Finding:
    ratio = _over_design("4")
    return st.ranging(
        ratio.ravel(),
        f"over these periods and the peaks of Sylmar {ratio.min():.2f} to {ratio.max():.2f}, on "
        f"average {ratio.mean():.2f}; Tabas and Llolleo are not at hand",
    )


def rocking_periods() -> st.Finding:
    displacement, period = _cycles()
    tests = np.abs(displacement) < 1e-3 * abs(TABLE_4_2.cell("4", "largest displacement"))
    return st.finding(
        [period.min(), period[tests].max()],
        f"{period.min():.3f} s at 2 mm, {period[tests].max():.3f} s below the 23.91 mm of run 4, "
        f"{period.max():.2f} s at 30 mm",
    )


@cache
def _cycles() -> tuple[np.ndarray, np.ndarray]:
    """Peaks of Table A-1 [m] and the times to the next ones of the same side [s], (n,) each."""
    measured = identification.FreeVibration.table_a1()
    time, displacement = measured.time[measured.at_peak], measured.displacement[measured.at_peak]
    return displacement[:-2], time[2:] - time[:-2]


# --- 4.9, 4.9.1 the tests


def runs_by_prestress() -> st.Finding:
    shaken_runs = [row for row in TABLE_4_1.rows if row[3]]
    force = np.array([TABLE_4_1.cell(row[0], "prestress") for row in shaken_runs])
    counts = [int(np.sum(np.abs(force / nominal - 1) < 0.02)) for nominal in (75.0, 110.0)]
    return st.finding(counts, f"{counts[0]} and {counts[1]} of {len(force)}")


def range_of_the_table() -> st.Finding:
    peaks = _of_75_kn(TABLE_4_1, "PGA") / STANDARD_GRAVITY
    return st.finding([peaks.min(), peaks.max()], f"{peaks.min():.3f} to {peaks.max():.3f} g")


def variation_of_the_initial_force() -> st.Finding:
    free = TABLE_4_2.cell("5", "tendon force before")
    spread = 100 * float(np.abs(_of_75_kn(TABLE_4_2, "tendon force before") / free - 1).max())
    return st.finding(spread, f"by up to {spread:.1f} % of the {free:g} kN of the free vibration")


def test_2_over_test_1() -> st.Finding:
    columns = ("PGA", "PGV", "acceleration scale")
    ratios = [TABLE_4_1.cell("2", name) / TABLE_4_1.cell("1", name) for name in columns]
    return st.ranging(
        ratios,
        f"{ratios[0]:.2f} by the PGA of the table, {ratios[1]:.2f} by its PGV, {ratios[2]:g} by "
        "the scale that was meant",
    )


def _modes_of_decay() -> tuple[float, np.ndarray]:
    """The highest frequency [Hz] and those after it."""
    windows = figures.free_decay()[1]
    dominant, time = windows.dominant, windows.time
    return float(dominant.max()), dominant[time > float(time[np.argmax(dominant)]) + windows.span]


def frequency_of_smooth_rocking() -> st.Finding:
    displacement, period = _cycles()
    last = {
        least: 1 / period[np.abs(displacement) > 1e-3 * least][-1] for least in (14.0, 10.0, 8.0)
    }
    said = ", ".join(f"{f:.1f} Hz at {least:g} mm" for least, f in last.items())
    first = 1 / period[0]
    return st.ranging(
        [(first, f) for f in last.values()],
        f"{first:.1f} Hz at 30 mm, {said}; where smooth rocking ends is not printed",
    )


def increase_of_the_frequency() -> st.Finding:
    displacement, period = _cycles()
    ratio = period[0] / period[np.abs(displacement) > 14e-3][-1]
    return st.finding(ratio, f"{ratio:.2f}, and {period[0] / period[-1]:.1f} to that at 2 mm")


def frequency_as_rocking_ends() -> st.Finding:
    top, _ = _modes_of_decay()
    return st.finding(top, f"in kind {top:.1f} Hz")


def frequency_after_rocking() -> st.Finding:
    displacement, period = _cycles()
    small = 1 / period[np.abs(displacement) < 5e-3]
    _, after = _modes_of_decay()
    return st.finding(
        [small.min(), small.max()],
        f"{small[0]:.1f} Hz at 4 mm, rising to {small[-1]:.1f} Hz at 2 mm; in kind "
        f"{after.max():.1f} to {after.min():.1f} Hz later, falling, without a wall that bends",
    )


def frequency_of_bending() -> st.Finding:
    frequency = 1 / WALL.fixed_base_period
    return st.finding(
        frequency,
        f"it bends at {frequency:.1f} Hz; in a motion of 8.5 Hz bending is "
        f"{100 * (8.5 / frequency) ** 2:.0f} % of the displacement",
    )


def share_of_windows(run: str, until: str, low: str, high: str) -> st.Finding:
    """Part of the windows of a run, to a time [s], whose frequency is between two [Hz]."""
    f = figures.frequencies(run, float(until))
    share = 100 * float(np.mean((float(low) <= f) & (f <= float(high))))
    return st.finding(share, f"in kind {share:.0f} % from {low} to {high} Hz")


def tendon_without_uplift() -> st.Finding:
    rise = [
        TABLE_4_2.cell(run, "largest tendon force") - TABLE_4_2.cell(run, "tendon force before")
        for run in ("1", "2", "6")
    ]
    lifted = [1e6 * x / WALL.tendons[0].stiffness for x in rise]
    return st.finding(
        rise,
        f"{', '.join(f'{x:.1f}' for x in rise)} kN in runs 1, 2 and 6: the middle of the base is "
        f"lifted by {min(lifted):.2f} to {max(lifted):.2f} mm",
    )


# --- 4.9.1.1 uplifts and tendon forces


def typical_sliding() -> st.Finding:
    left = 1e3 * float(np.abs(figures.rows_of_75_kn()["alignment"]).max())
    bent = 1e3 * float(figures.bending(0.008))
    return st.finding(
        left,
        f"after the tests at most {left:.2f} mm are left; bending shifts the points, too, by "
        f"{bent:.2f} mm at 8 mm",
    )


def uplifts_of_75_kn() -> st.Finding:
    ratios = [_uplifts_over_4_9(figures.GROUPS[0][1], bends) for bends in (True, False)]
    low, high = np.min(ratios), np.max(ratios)
    return st.ranging(ratios, f"{low:.2f} to {high:.2f}, with and without the bending of the wall")


def _uplifts_over_4_9(runs: tuple[str, ...], bends: bool) -> np.ndarray:
    read = figures.read_from_tendon(runs, bends)
    return np.asarray(read["uplift"] / figures.MORE.uplift(np.abs(read["displacement"])))


def tendon_forces(prestress: str) -> st.Finding:
    """4-16 over the largest tendon force of each test, less 1 [%]."""
    off = []
    for run in next(runs for label, runs, _ in figures.GROUPS if label == prestress):
        wall = analysis.Wall.thesis(1e3 * TABLE_4_2.cell(run, "tendon force before"))
        force = float(wall.tendon_force(1e-3 * TABLE_4_2.cell(run, "largest displacement")))
        off.append(100 * (force / (1e3 * TABLE_4_2.cell(run, "largest tendon force")) - 1))
    return st.finding(off, f"4-16 lies {min(off):.1f} to {max(off):.1f} % above the largest forces")


def spread_of_the_tendon_forces() -> st.Finding:
    grid = np.linspace(0.0, 0.04, 4001)
    tests = figures.rows_of_75_kn()
    shifts = [
        np.interp(largest, analysis.Wall.thesis(before).tendon_force(grid), grid) - abs(d)
        for d, largest, before in zip(
            tests["displacement"], tests["largest"], tests["before"], strict=True
        )
    ]
    size = 1e3 * np.abs(shifts)
    return st.finding(
        size.max(), f"{size.min():.1f} to {size.max():.1f} mm, all to the same side of the curve"
    )


# --- 4.9.1.2 the rotation centre


def sliding_by_the_centre() -> st.Finding:
    ends = 1e3 * np.array([-figures.SPREAD, figures.SPREAD])
    return st.finding(
        ends, f"{ends[0]:g} to {ends[1]:g} mm by the uplifts, 0.8 mm more to one side"
    )


def displacement_by_bending() -> st.Finding:
    bent = 1e3 * float(np.max(figures.bending(np.linspace(0.0, 0.03, 301))))
    soft = bent * (1 / WALL.fixed_base_period / 8.5) ** 2
    return st.ranging(
        [bent, soft],
        f"bending is at most {bent:.2f} mm by the fixed-base period of 4.7, {soft:.1f} mm by the 8 "
        "to 9 Hz that 4.9.1 calls bending",
    )


def centre_with_75_kn() -> st.Finding:
    off = np.array(_beside_4_7(figures.GROUPS[0][1]))
    return st.ranging(
        off, f"read from the tendon, {off.min():+.0f} to {off.max():+.0f} mm from 4-7"
    )


# --- 4.9.2 110 kN


def acceleration_at_the_same_drift() -> st.Finding:
    few = abs(TABLE_4_4.cell("El Centro-A1-T1", "acceleration, 75 kN"))
    rows = ("El Centro-A1-T1", "Northridge-A1-T0.6")
    ratios = [abs(TABLE_4_4.cell(row, "acceleration, 110 kN")) / few for row in rows]
    force = [float(wall.restoring_force(4.5e-3)) for wall in (WALL, figures.MORE)]
    return st.finding(
        ratios,
        f"{ratios[0]:.2f} and {ratios[1]:.2f}; F_k of 4-30 at 4.5 mm {force[1] / force[0]:.2f}",
    )


def _beside_4_7(runs: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Centre read from the tendon less 4-7 as printed [mm], the bending taken out.

    4-7 at the displacement, as it was fitted, and at the part of it that is rotation.
    """
    read = figures.read_from_tendon(runs)
    centre = figures.MORE.rotation_centre.distance_from_edge
    at = np.abs(read["displacement"]), np.abs(read["rigid"])
    whole, rigid = (np.asarray(1e3 * (read["from_edge"] - centre(d))) for d in at)
    return whole, rigid


def centre_with_more_prestress() -> st.Finding:
    off = {label: _beside_4_7(runs) for label, runs, _ in figures.GROUPS}
    said = "; ".join(
        f"{k} {whole.min():+.0f} to {whole.max():+.0f} mm, {rigid.min():+.0f} to "
        f"{rigid.max():+.0f} mm with 4-7 at the part that is rotation"
        for k, (whole, rigid) in off.items()
    )
    worst = [[x[np.abs(x).argmax()] for x in both] for both in off.values()]
    return st.ranging(np.transpose(worst), f"read from the tendon, from 4-7 as printed: {said}")


def uplifts_with_more_prestress() -> st.Finding:
    ratios = {label: _uplifts_over_4_9(runs, True) for label, runs, _ in figures.GROUPS}
    few, many = (float(np.abs(x - 1).max()) for x in ratios.values())
    said = "; ".join(f"{k} {x.min():.2f} to {x.max():.2f}" for k, x in ratios.items())
    return st.finding(many / few, f"uplift read from the tendon over 4-9: {said}")


def force_threshold() -> st.Finding:
    few, many = (float(wall.restoring_force(2e-3)) / 1e3 for wall in (WALL, figures.MORE))
    return st.finding(many / few, f"at 2 mm {many:.1f} kN against {few:.1f} kN")


def displacement_at_yield() -> st.Finding:
    few, many = (1e3 * wall.yield_displacement() for wall in (WALL, figures.MORE))
    return st.finding(many / few, f"{many:.1f} mm against {few:.1f} mm")


def restoring_force_with_more_prestress() -> st.Finding:
    return st.unknown("no force of a test with 110 kN is printed but that of the tendon")
