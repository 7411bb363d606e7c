"""Statements of section 5.3 on the models of the steel column.

The motion of the shaking table is lost: runs 3 and 4 are simulated with the records that were
meant, and their ranges are those of the component and of 15 % of the peak.
"""

import itertools
import math
from typing import Any

import numpy as np

import rockeom as rk
from rockeom.analysis import formulas, identification
from rockeom.motion import STANDARD_GRAVITY
from rockeom.thesis import shaken
from rockeom.thesis.figures import chapter_5_flexible as flexible, chapter_5_rigid as rigid
from rockeom.thesis.free_vibration_table import let_go
from rockeom.thesis.printed import COLUMN, FIGURE_5_6, GAUGE, TABLE_5_1
from rockeom.thesis.statements import statement as st


def _better(structure: rk.Structure, peaks: int, digits: int) -> st.Finding:
    """Rms error of the first peaks of run 1 with r = 0.81 over that with 0.74."""
    own, other = (
        rigid.rms_of_peaks(rigid.released(structure, r), "Figure 5-6", peaks) for r in (0.81, 0.74)
    )
    return st.finding(own / other, f"rms {own:.{digits}f} mm, with 0.74 {other:.{digits}f} mm")


def _said(peaks: np.ndarray) -> str:
    """A range of largest displacements in words."""
    return f"{peaks[0]:.1f} mm as meant, {peaks.min():.1f} to {peaks.max():.1f} mm over the range"


def _changed(ratio: np.ndarray) -> st.Finding:
    """How far ratios of largest displacements are from 1."""
    change = 100 * np.abs(ratio - 1)
    return st.ranging(
        change, f"by {change.min():.0f} to {change.max():.0f} % of the largest displacement"
    )


# --- 5.3.1 Model A


def restitution_of_the_column() -> st.Finding:
    r = float(formulas.energy_ratio_of_lumped_mass(**COLUMN))
    return st.finding(r, f"{r:.3f}")


def _first_quarter(run: Any, number: str) -> st.Finding:
    (start, zero, *_), _ = rigid.measured(number)
    own = rigid.first_zero(run)
    return st.finding(
        own / float(zero - start),
        f"from rest to upright in {own:.3f} s; the times printed are {float(zero - start):.3f} s "
        "apart",
    )


def first_quarter_by_model_a() -> st.Finding:
    return _first_quarter(rigid.released(shaken.MODEL_A, 0.74), "Figure 5-6")


def matching_with_the_ratio_of_the_test() -> st.Finding:
    return _better(shaken.MODEL_A, 8, 2)


def run_3_by_model_a() -> st.Finding:
    peaks = rigid.band("3", shaken.MODEL_A)
    return st.ranging(peaks, _said(peaks))


def run_3_with_the_ratio_of_the_test() -> st.Finding:
    measured = TABLE_5_1.cell("3", "largest displacement")
    with_081, with_074 = (rigid.band("3", shaken.MODEL_A, r) for r in (0.81, 0.74))
    ratio = np.abs(with_081 - measured) / np.abs(with_074 - measured)
    return st.ranging(ratio, f"with r = 0.81 {_said(with_081)}; with 0.74 {_said(with_074)}")


# --- 5.3.2 Model B


def stiffness_of_the_rubber() -> st.Finding:
    weight = (COLUMN["mass"] + COLUMN["base_mass"]) * STANDARD_GRAVITY
    k = weight / 2 / 1.5e-3 / 1e3
    return st.finding(k, f"{k:.0f} kN/m")


def forces_at_lift_off() -> st.Finding:
    a = rigid.approximation(550e3)
    jump = 100 * (a["P_crit2"] / a["P_crit"] - 1)
    return st.finding(abs(jump), f"P_crit2 is {jump:+.2f} % of P_crit off")


def accuracy_of_the_linear_approximation() -> st.Finding:
    u, force = rigid.exact_pushover(550e3)
    off = np.abs(rigid.approximate_force(550e3, u) - force).max()
    worst = 100 * float(off / rigid.approximation(550e3)["P_crit"])
    return st.finding(worst, f"off by {worst:.1f} % of P_crit at most")


def first_quarter_by_model_b() -> st.Finding:
    return _first_quarter(rigid.released_on_springs(550e3), "Figure 5-10")


def best_ratio_on_rubber() -> st.Finding:
    errors = rigid.errors_on_rubber()
    best = min(errors, key=lambda r: errors[r])
    return st.finding(
        best, f"{best:.2f}: rms {errors[best]:.1f} mm, with 0.74 {errors[0.74]:.1f} mm"
    )


def peaks_against_the_stiffness() -> st.Finding:
    runs = [rigid.released_on_springs(k * 1e3) for k in (550, 275, 825)]
    swings = [identification.swings(run, "u", 8) for run in runs]
    first = abs(swings[0].peak[0])
    change = 100 * max(float(np.abs(one.peak - swings[0].peak).max()) for one in swings[1:]) / first
    late = max(float(np.abs(one.peak_time - swings[0].peak_time).max()) for one in swings[1:])
    errors = [rigid.rms_of_peaks(run, "Figure 5-10") for run in runs]
    return st.finding(
        change,
        f"seven peaks change by up to {change:.1f} % of the first displacement, their times by up "
        f"to {late:.2f} s; their rms error is {min(errors):.1f} to {max(errors):.1f} mm",
    )


def run_4_by_model_b() -> st.Finding:
    peaks = rigid.band("4", shaken.model_b())
    return st.ranging(
        peaks,
        f"{_said(peaks)}; N76W is published as 254 degrees today, the component 164 comes to "
        f"{peaks[len(rigid.SCALES)]:.1f} mm",
    )


def compression_of_the_rubber() -> st.Finding:
    return _settled(550e3)


def _settled(k_f: float) -> st.Finding:
    deepest = 1e3 * rigid.WEIGHT / (2 * k_f)
    return st.finding(deepest, f"a foot that bears all of the weight goes down by {deepest:.2f} mm")


def compression_of_stiff_rubber() -> st.Finding:
    return _settled(10e6)


def effect_of_the_stiffness_in_run_4() -> st.Finding:
    stiff, soft = (rigid.band("4", shaken.model_b(k)) for k in (10e6, 550e3))
    return _changed(stiff / soft)


def stiff_springs_and_rigid_ground_in_run_4() -> st.Finding:
    cart, run = (rigid.band("4", one) for one in (shaken.model_b(10e6), shaken.MODEL_A))
    change = 100 * np.abs(cart / run - 1)
    return st.ranging(change, f"{_said(cart)} on 10 MN/m; {_said(run)} on rigid ground")


# --- 5.3.3 Model C


def end_of_rocking() -> st.Finding:
    ends = [
        flexible.rocking_ends(rigid.released(one, 0.74))
        for one in (flexible.MODEL_C, shaken.MODEL_A)
    ]
    return st.finding(ends[0] - ends[1], f"{ends[0] - ends[1]:.2f} s, with 0.1 mm as the end")


def vibration_after_rocking() -> st.Finding:
    run, stiff = (rigid.released(one, 0.74) for one in (flexible.MODEL_C, shaken.MODEL_A))
    lasts, ends = flexible.deformation_lasts(run), flexible.rocking_ends(stiff)
    return st.finding(
        lasts - ends,
        f"uplifts of 0.1 mm end at {flexible.rocking_ends(run):.2f} s, deformations of 0.1 mm at "
        f"{lasts:.2f} s; the rigid column's uplifts at {ends:.2f} s",
    )


def matching_of_the_flexible_column() -> st.Finding:
    return _better(flexible.MODEL_C, 4, 1)


def run_3_by_model_c() -> st.Finding:
    peaks = rigid.band("3", flexible.MODEL_C)
    return st.ranging(peaks, _said(peaks))


def effect_of_flexibility_in_run_3() -> st.Finding:
    bending, stiff = (rigid.band("3", one) for one in (flexible.MODEL_C, shaken.MODEL_A))
    return _changed(bending / stiff)


def isolation_by_rocking() -> st.Finding:
    compared = [flexible.beside(scale, run).ratios for run in "34" for scale in (0.85, 1.0, 1.15)]
    drift = [one["displacement"] for one in compared]
    relief = [1 / one["base_shear"] for one in compared]
    return st.ranging(
        list(zip(drift, relief, strict=True)),
        f"displacement x {min(drift):.1f} to {max(drift):.1f}, base shear x {1 / max(relief):.2f} "
        f"to {1 / min(relief):.2f} under the records of runs 3 and 4, 85 to 115 % of their peaks",
    )


def _spread(curves: dict[str, Any], what: str) -> st.Finding:
    """Largest change of the largest displacement from that of the first run [%]."""
    sizes = [rigid.largest(run) for run in curves.values()]
    spread = 100 * max(abs(x / sizes[0] - 1) for x in sizes[1:])
    return st.finding(spread, f"{what} changes the largest displacement by {spread:.0f} %")


def sensitivity_to_restitution() -> st.Finding:
    return _spread(flexible.with_ratios(), "0.04 more or less")


def sensitivity_to_stiffness() -> st.Finding:
    return _spread(flexible.with_stiffnesses(), "10 % more or less")


def sensitivity_to_damping() -> st.Finding:
    return _spread(flexible.with_dampings(), "from none to 6 % of damping")


# --- errors of the text


def ratio_of_velocities_of_the_column() -> st.Finding:
    errors = [_error_of_column(law) for law in (rk.EnergyRatio(0.74), rk.VelocityRatio(0.74))]
    return st.finding(
        errors[1] / errors[0],
        f"the peaks of Figure 5-6 are met within {errors[0]:.1f} mm (rms) with the energy times "
        f"0.74, the velocity times {math.sqrt(0.74):.3f}, and within {errors[1]:.1f} mm with the "
        "velocity times 0.74",
    )


def _error_of_column(law: rk.EnergyRatio | rk.VelocityRatio) -> float:
    """Root mean square of the errors of the peaks in Figure 5-6 [mm]."""
    peaks = np.abs([float(row[1]) for row in FIGURE_5_6.rows if row[1]])
    start = float(identification.rotation_from_displacement(peaks[0] / 1e3, *GAUGE))
    run = let_go(rk.LumpedMassStructure(**COLUMN), 4.0, law, theta=start)
    zeros = [0.0, *(event.time for event in run.impacts)]
    turns = [0.0, *(0.5 * (a + b) for a, b in itertools.pairwise(zeros[1:]))][: len(peaks)]
    own = identification.displacement_from_rotation(
        np.abs(run.at(np.array(turns))["theta"]), *GAUGE
    )
    return float(np.sqrt(np.mean((1e3 * own - peaks) ** 2)))


def accuracy_of_model_c() -> st.Finding:
    errors = [
        rigid.rms_of_peaks(rigid.released(flexible.MODEL_C, r), "Figure 5-6") for r in (0.81, 0.74)
    ]
    share = 100 * np.array(errors) / FIGURE_5_6.numbers("displacement")[0]
    return st.ranging(
        share,
        f"rms error of seven peaks of run 1 {errors[0]:.1f} mm with r = 0.81, {errors[1]:.1f} mm "
        "with 0.74",
    )


_MODELS = (flexible.MODEL_C, shaken.MODEL_A)


def improvement_by_model_c() -> st.Finding:
    errors = {
        r: [rigid.rms_of_peaks(rigid.released(of, r), "Figure 5-6") for of in _MODELS]
        for r in (0.81, 0.74)
    }
    return st.ranging(
        [bending / stiff for bending, stiff in errors.values()],
        "; ".join(
            f"r = {r:g}: rms of seven peaks of run 1 {bending:.1f} mm, by Model A {stiff:.1f} mm"
            for r, (bending, stiff) in errors.items()
        ),
    )


def precision_of_the_linear_approximation() -> st.Finding:
    return accuracy_of_the_linear_approximation()
