"""Statements of sections 4.9.1.3 to 4.9.1.5 and 4.9.2.1 on simulated runs of the shaken wall.

The motions of the shaking table are lost. Runs are simulated with the records that were meant, and
their ranges are those of `rockeom.thesis.shaken.wall_motions`: the peak that was meant and that of
the table, each within 10 %, and for Sylmar the time scale of Tabas.
"""

from functools import partial

import numpy as np

import rockeom as rk
from rockeom.analysis import identification
from rockeom.thesis import shaken
from rockeom.thesis.figures import chapter_4_shaken
from rockeom.thesis.figures.chapter_4_runs import CONSTANT, displacement, oscillator_run
from rockeom.thesis.figures.chapter_4_shaken import MEASURED_PEAK, peaks_by_ratio, settled_speeds
from rockeom.thesis.figures.chapter_4_tests import BESIDE, settled
from rockeom.thesis.figures.chapter_4_wall import legible
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_1, TABLE_4_2, TABLE_4_3, TABLE_4_5
from rockeom.thesis.statements import statement as st
from rockeom.thesis.wall_tests import back_calculated_force

statement = st.Register()

_TABLE = "the motion of the table is lost"
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


_FIGURES = {("2", "SDOF"): "4-66", ("4", "SDOF"): "4-67", ("9", "constant r"): "4-79"}
for _table, _run, _model in (
    *((TABLE_4_3, run, model) for model in ("SDOF", "MHSG") for run in ("1", "2", "4")),
    *((TABLE_4_5, run, model) for model in ("r by 4-31", "constant r") for run in ("7", "9")),
):
    _u, _v = (abs(_table.cell(_run, f"{what}, {_model}")) for what in ("displacement", "velocity"))
    statement(
        f"Table {_table.number}, run {_run}, {_model}",
        f"a largest displacement of {_u:g} mm and velocity of {_v:g} m/s",
        st.near([_u, _v], [0.1 * _u, 0.1 * _v], why="sizes in mm and m/s: 10 %"),
        st.simulation("4-40" if _model == "MHSG" else "4-27"),
        figure=_FIGURES.get((_run, _model), ""), lost=_TABLE,
    )(partial(peaks_of_run, _run, _model))  # fmt: skip


@statement(
    "4.9.1.3", "acceptable peak displacement predictions",
    st.near(1.0, 0.25, why="acceptable: within a quarter of the measured one, as the shades of the "
         "table have it, for some run"),
    st.printed("Table 4-3, displacement by SDOF over that measured, the nearest run"),
)  # fmt: skip
def printed_peaks_by_sdof() -> st.Finding:
    ratios = {
        run: abs(TABLE_4_3.cell(run, "displacement, SDOF") / TABLE_4_3.cell(run, "displacement"))
        for run in ("1", "2", "3", "4", "6")
    }
    best = min(ratios.values(), key=lambda x: abs(x - 1))
    return st.finding(best, ", ".join(f"run {run} {x:.2f}" for run, x in ratios.items()))


@statement(
    "4.9.1.3", "the tracking in the simulation of this case, during moderate rocking motion is "
    "excellent",
    st.at_least(0.9, why="correlation with the measured trace"),
    st.simulation("4-27"),
    figure="4-68", lost="the measured trace is lost",
)  # fmt: skip
def tracking_of_run_4() -> st.Finding:
    return st.unknown("there is nothing to correlate with")


@statement(
    "4.9.2.1", "They all underestimated the peak response by a large margin",
    st.at_most([0.9] * 6, why="a large margin: 10 % or more"),
    st.printed("Table 4-5, simulated displacements over those measured"),
    figure="4-79",
)  # fmt: skip
def printed_peaks_with_110_kn() -> st.Finding:
    ratios = [
        abs(TABLE_4_5.cell(run, f"displacement, {name}") / TABLE_4_5.cell(run, "displacement"))
        for run in ("7", "8", "9")
        for name in ("r by 4-31", "constant r")
    ]
    return st.finding(ratios, f"{min(ratios):.2f} to {max(ratios):.2f} of the measured ones")


@statement(
    "4.9.2.1", "the simulations with the two r settings produced very similar",
    st.about([1.0] * 3, why="very similar"),
    st.printed("Table 4-5, displacements with constant r over those by 4-31"),
    figure="4-79",
)  # fmt: skip
def similarity_of_both_settings() -> st.Finding:
    ratios = [
        abs(TABLE_4_5.cell(run, "displacement, constant r"))
        / abs(TABLE_4_5.cell(run, "displacement, r by 4-31"))
        for run in ("7", "8", "9")
    ]
    return st.finding(ratios, f"{', '.join(f'{x:.2f}' for x in ratios)} in runs 7 to 9")


@statement(
    "4.9.2.1, Table 4-5", "a constant r value of 0.835",
    st.near(CONSTANT, 0.0005, why="half of the last digit"),
    st.printed("Table 4-5, head: r = 0.852"),
    slip=True,
)  # fmt: skip
def constant_restitution_of_table_4_5() -> st.Finding:
    return st.finding(0.852, "0.852 in the head of the table and under Figure 4-79")


@statement(
    "Table 4-1, run 4", "a time scale of 0.6, and 23.9 mm measured",
    st.near(abs(TABLE_4_2.cell("4", "largest displacement")), 2.39, "mm", why="10 %"),
    st.simulation("4-27 with r of 4-31, time scaled by 0.6 and by 0.38"),
    lost=_TABLE,
)  # fmt: skip
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


@statement(
    "4.9.1.4", "adequately characterises the overall dynamic response",
    st.at_least(0.927, why="adequate: the R2 of 4-16 that the text calls so"),
    st.closed_form("4-30"), st.data("Table A-1, -M_e a at the legible peaks by 4-42"),
    figure="4-69", lost="the data of the shaking-table tests are lost",
)  # fmt: skip
def restoring_force_of_the_free_vibration() -> st.Finding:
    measured = identification.FreeVibration.table_a1()
    rows = measured.at_peak & legible()
    force = back_calculated_force(WALL.mass, measured.acceleration[rows])
    own = WALL.restoring_force(measured.displacement[rows])
    fit = float(identification.coefficient_of_determination(force, own))
    return st.finding(fit, f"{fit:.3f} in the free vibration")


@statement(
    "4.9.1.4", "a single r value for all displacement and velocity ranges at times produced "
    "satisfactory time-history predictions",
    st.near(1e3 * abs(MEASURED_PEAK), 2.39, "mm", why="satisfactory: 10 % of the measured peak"),
    st.simulation("4-27 with r = 0.852"),
    figure="4-70", lost=_TABLE,
)  # fmt: skip
def run_4_with_a_constant_ratio() -> st.Finding:
    peaks = shaken.oscillator_peaks("4", 0.852)
    return st.ranging(_sizes(peaks)[:, 0], _said(peaks))


@statement(
    "4.9.1.4", "none improved the response prediction",
    st.at_least(0.1, why="least error of the trials, of the measured peak: 10 %"),
    st.simulation("4-27 with other backbones and dampings"),
    figure="4-70", lost=_TABLE,
)  # fmt: skip
def trials_of_run_4() -> st.Finding:
    peaks = {name: 1e3 * float(run.peak) for name, run in chapter_4_shaken.trials().items()}
    error = min(abs(x / (1e3 * abs(MEASURED_PEAK)) - 1) for x in peaks.values())
    return st.finding(error, ", ".join(f"{name} {x:.1f} mm" for name, x in peaks.items()))


@statement(
    "4.9.1.4", "only 11% of the analyses resulted in conservative peak displacement predictions",
    st.near(11.0, 1.1, "%", why="10 %, of the analyses that reach the measured peak"),
    st.simulation("4-27 with 101 r within 10 % of 0.852"),
    figure="4-71", lost=_TABLE,
)  # fmt: skip
def conservative_analyses() -> st.Finding:
    _, peaks = peaks_by_ratio()
    share = 100 * float(np.mean(peaks >= abs(MEASURED_PEAK)))
    return st.finding(
        share,
        f"{share:.0f} % reach the measured 23.91 mm; the largest is {1e3 * peaks.max():.1f} mm",
    )


@statement(
    "4.9.1.4", "there does not appear to be any trend in the variation",
    st.at_least(1 / 3, why="share of turning points, 2/3 of a random sequence: half of that"),
    st.simulation("4-27 with 101 r within 10 % of 0.852"),
    figure="4-71", lost=_TABLE,
)  # fmt: skip
def trend_with_restitution() -> st.Finding:
    _, peaks = peaks_by_ratio()
    jumps = np.sign(np.diff(peaks))
    turns = int(np.count_nonzero(jumps[1:] * jumps[:-1] < 0))
    return st.finding(
        turns / (len(peaks) - 2),
        f"{turns} of {len(peaks) - 2}; {1e3 * peaks.min():.2f} to {1e3 * peaks.max():.2f} mm",
    )


# --- 4.9.1.5 sensitivity


@statement(
    "4.9.1.5", "An example of this can be observed in Figure 4-73 when Z is between 5.7 and 6.0",
    st.near(2, 0.0, "velocities", why="a line each way: the wall passes upright twice a cycle"),
    st.simulation("4-43 with Z = 5.88 m/s2 and r = 0.852"),
    figure="4-72",
)  # fmt: skip
def velocities_of_the_steady_motion() -> st.Finding:
    u, _, speeds = settled()
    distinct = len(np.unique(np.round(speeds, 6)))
    return st.finding(
        distinct,
        f"{distinct} velocities when upright in 40 cycles, {np.abs(speeds).max():.3f} m/s, "
        f"{1e3 * np.abs(u).max():.1f} mm",
    )


@statement(
    "Figure 4-73", "like the case when Z = 6.03 ms",
    st.at_least(3, "velocities", why="the period has doubled above 6.03 m/s2"),
    st.simulation("4-43 at 8 Hz with Z = 6.1 m/s2 and r = 0.852"),
    figure="4-73", slip=True,
)  # fmt: skip
def velocities_above_the_doubling() -> st.Finding:
    counts = [
        len(np.unique(np.round(settled_speeds(8.0, z, {"u": 0.0})[0], 4))) for z in (5.9, 6.1)
    ]
    return st.finding(
        counts[1], f"{counts[0]} and {counts[1]} velocities when upright at 5.9 and 6.1"
    )


@statement(
    "4.9.1.5", "increased further from 6.2, the well defined lines now disappear into a smear band",
    st.at_least(9, "velocities", why="a smear: more than a period doubled twice, 8"),
    st.simulation("4-43 at 8 Hz with Z = 6.3 m/s2"),
    figure="4-73", slip=True,
)  # fmt: skip
def velocities_in_the_smear() -> st.Finding:
    starts = ({"u": 0.0}, {"u": 0.02}, {"u": 0.004, "u_dot": -0.6})
    counts = [len(np.unique(np.round(settled_speeds(8.0, 6.3, at)[0], 4))) for at in starts]
    return st.ranging(counts, f"{counts} velocities when upright at 6.3, from three starts")


@statement(
    "4.9.1.5", "demonstrate that extreme sensitivity also occurs in the experimental results",
    st.at_least(10.0, "times", why="growth of the distance between two motions"),
    st.simulation("run 4 by 4-27 from upright and from 0.1 mm"),
    figure="4-74", lost="runs 18 and 19 of another study, and what was different in them, are lost",
)  # fmt: skip
def growth_of_a_small_difference() -> st.Finding:
    first = oscillator_run("4")
    again = rk.simulate(first.structure, first.motion, initial={"u": BESIDE})
    t = np.arange(0.0, 15.0, 2e-3)
    apart = float(np.abs(displacement(first, t) - displacement(again, t)).max())
    return st.finding(
        apart / BESIDE,
        f"in kind, {1e3 * BESIDE:g} mm apart at first they come {1e3 * apart:.2f} mm apart",
    )
