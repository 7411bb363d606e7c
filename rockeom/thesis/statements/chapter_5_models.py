"""Statements of section 5.3 on the models of the steel column.

The motion of the shaking table is lost: runs 3 and 4 are simulated with the records that were
meant, and their ranges are those of the component and of 15 % of the peak.
"""

import math

import numpy as np

from rockeom.analysis import formulas, identification
from rockeom.motion import STANDARD_GRAVITY
from rockeom.thesis import shaken
from rockeom.thesis.figures import chapter_5_models as figures
from rockeom.thesis.printed import COLUMN, FIGURE_5_6, TABLE_5_1
from rockeom.thesis.statements import statement as st

_MODELS = {
    "A": shaken.MODEL_A,
    "B": shaken.model_b(),
    "B on 10 MN/m": shaken.model_b(10e6),
    "C": figures.MODEL_C,
}


def _said(peaks: np.ndarray) -> str:
    """A range of largest displacements in words."""
    return f"{peaks[0]:.1f} mm as meant, {peaks.min():.1f} to {peaks.max():.1f} mm over the range"


# --- 5.3.1 Model A


def restitution_of_the_column() -> st.Finding:
    r = float(formulas.energy_ratio_of_lumped_mass(**COLUMN))
    return st.finding(r, f"{r:.3f}")


_RELEASED = {
    "A": (lambda: figures.released(shaken.MODEL_A, 0.74), "Figure 5-6"),
    "B": (lambda: figures.released_on_springs(550e3), "Figure 5-10"),
}


def first_quarter(model: str) -> st.Finding:
    released, number = _RELEASED[model]
    (start, zero, *_), _ = figures.measured(number)
    own = figures.first_zero(released())
    return st.finding(
        own / float(zero - start),
        f"from rest to upright in {own:.3f} s; the times printed are {float(zero - start):.3f} s "
        "apart",
    )


def matching(model: str, peaks: str) -> st.Finding:
    """Rms error of the first peaks of run 1 with r = 0.81 over that with 0.74."""
    own, other = (
        figures.rms_of_peaks(figures.released(_MODELS[model], r), "Figure 5-6", int(peaks))
        for r in (0.81, 0.74)
    )
    return st.finding(own / other, f"rms {own:.2f} mm, with 0.74 {other:.2f} mm")


def largest_displacement(run: str, model: str) -> st.Finding:
    peaks = figures.band(run, _MODELS[model])
    said = _said(peaks)
    if run == "4":
        other = peaks[len(figures.SCALES)]
        said += (
            f"; N76W is published as 254 degrees today, the component 164 comes to {other:.1f} mm"
        )
    return st.ranging(peaks, said)


def effect_of_the_model(run: str, model: str, other: str) -> st.Finding:
    """How far the largest displacements by one model are from those by another."""
    own, beside = (figures.band(run, _MODELS[name]) for name in (model, other))
    change = 100 * np.abs(own / beside - 1)
    return st.ranging(
        change,
        f"by {change.min():.0f} to {change.max():.0f} % of the largest displacement: {_said(own)} "
        f"by Model {model}, {_said(beside)} by Model {other}",
    )


def run_3_with_the_ratio_of_the_test() -> st.Finding:
    measured = TABLE_5_1.cell("3", "largest displacement")
    with_081, with_074 = (figures.band("3", shaken.MODEL_A, r) for r in (0.81, 0.74))
    ratio = np.abs(with_081 - measured) / np.abs(with_074 - measured)
    return st.ranging(ratio, f"with r = 0.81 {_said(with_081)}; with 0.74 {_said(with_074)}")


def ratio_of_velocities_of_the_column() -> st.Finding:
    energies, velocities = (
        figures.rms_of_peaks(figures.released(shaken.MODEL_A, r), "Figure 5-6")
        for r in (0.74, 0.74**2)
    )
    return st.finding(
        velocities / energies,
        f"the peaks of Figure 5-6 are met within {energies:.1f} mm (rms) with the energy times "
        f"0.74, the velocity times {math.sqrt(0.74):.3f}, and within {velocities:.1f} mm with the "
        "velocity times 0.74",
    )


# --- 5.3.2 Model B


def stiffness_of_the_rubber() -> st.Finding:
    weight = (COLUMN["mass"] + COLUMN["base_mass"]) * STANDARD_GRAVITY
    k = weight / 2 / 1.5e-3 / 1e3
    return st.finding(k, f"{k:.0f} kN/m")


def forces_at_lift_off() -> st.Finding:
    a = figures.approximation(550e3)
    jump = 100 * (a["P_crit2"] / a["P_crit"] - 1)
    return st.finding(abs(jump), f"P_crit2 is {jump:+.2f} % of P_crit off")


def accuracy_of_the_linear_approximation() -> st.Finding:
    u, force = figures.exact_pushover(550e3)
    off = np.abs(figures.approximate_force(550e3, u) - force).max()
    worst = 100 * float(off / figures.approximation(550e3)["P_crit"])
    return st.finding(worst, f"off by {worst:.1f} % of P_crit at most")


def best_ratio_on_rubber() -> st.Finding:
    errors = figures.errors_on_rubber()
    best = min(errors, key=lambda r: errors[r])
    return st.finding(
        best, f"{best:.2f}: rms {errors[best]:.1f} mm, with 0.74 {errors[0.74]:.1f} mm"
    )


def peaks_against_the_stiffness() -> st.Finding:
    runs = [figures.released_on_springs(k * 1e3) for k in (550, 275, 825)]
    meant, *others = (identification.swings(run, "u", 8) for run in runs)
    peaks = max(float(np.abs(one.peak - meant.peak).max()) for one in others)
    times = max(float(np.abs(one.peak_time - meant.peak_time).max()) for one in others)
    of = abs(meant.peak[0]), float(np.diff(meant.peak_time).mean())
    changes = [100 * peaks / of[0], 100 * times / of[1]]
    errors = [figures.rms_of_peaks(run, "Figure 5-10") for run in runs]
    return st.finding(
        changes,
        f"the peaks change by up to {changes[0]:.1f} % of the first displacement, their times by "
        f"up to {times:.2f} s, {changes[1]:.0f} % of a half-cycle; the rms error of the peaks is "
        f"{min(errors):.1f} to {max(errors):.1f} mm",
    )


def settlement(stiffness: str) -> st.Finding:
    """stiffness : k_f [kN/m]."""
    deepest = figures.WEIGHT / (2 * float(stiffness))
    return st.finding(deepest, f"a foot that bears all of the weight goes down by {deepest:.2f} mm")


# --- 5.3.3 Model C


def end_of_rocking() -> st.Finding:
    ends = [
        figures.rocking_ends(figures.released(one, 0.74))
        for one in (figures.MODEL_C, shaken.MODEL_A)
    ]
    return st.finding(ends[0] - ends[1], f"{ends[0] - ends[1]:.2f} s, with 0.1 mm as the end")


def vibration_after_rocking() -> st.Finding:
    run, stiff = (figures.released(one, 0.74) for one in (figures.MODEL_C, shaken.MODEL_A))
    lasts, ends = figures.deformation_lasts(run), figures.rocking_ends(stiff)
    return st.finding(
        lasts - ends,
        f"uplifts of 0.1 mm end at {figures.rocking_ends(run):.2f} s, deformations of 0.1 mm at "
        f"{lasts:.2f} s; the rigid column's uplifts at {ends:.2f} s",
    )


def isolation_by_rocking() -> st.Finding:
    compared = [figures.beside(scale, run).ratios for run in "34" for scale in (0.85, 1.0, 1.15)]
    drift = [one["displacement"] for one in compared]
    relief = [1 / one["base_shear"] for one in compared]
    return st.ranging(
        list(zip(drift, relief, strict=True)),
        f"displacement x {min(drift):.1f} to {max(drift):.1f}, base shear x {1 / max(relief):.2f} "
        f"to {1 / min(relief):.2f} under the records of runs 3 and 4, 85 to 115 % of their peaks",
    )


_VARIED = {
    "r": (figures.with_ratios, "0.04 more or less"),
    "k": (figures.with_stiffnesses, "10 % more or less"),
    "c": (figures.with_dampings, "from none to 6 % of damping"),
}


def sensitivity(parameter: str) -> st.Finding:
    """Largest change of the largest displacement from that of the first run [%]."""
    curves, what = _VARIED[parameter]
    sizes = [figures.largest(run) for run in curves().values()]
    spread = 100 * max(abs(x / sizes[0] - 1) for x in sizes[1:])
    return st.finding(spread, f"{what} changes the largest displacement by {spread:.0f} %")


# --- 5.4, 6.3 conclusions


def accuracy_of_model_c() -> st.Finding:
    columns = {"571.8 kN/m": figures.MODEL_C, "385.8 kN/m": shaken.model_c(385.8e3, 412.7)}
    errors = {
        f"{r:g} and {k}": figures.rms_of_peaks(figures.released(of, r), "Figure 5-6")
        for k, of in columns.items()
        for r in (0.81, 0.74)
    }
    said = ", ".join(f"{error:.1f} mm with {name}" for name, error in errors.items())
    share = 100 * np.array([*errors.values()]) / FIGURE_5_6.numbers("displacement")[0]
    return st.ranging(share, f"rms error of seven peaks of run 1 by r and k {said}")


def improvement_by_model_c() -> st.Finding:
    errors = {
        r: [figures.rms_of_peaks(figures.released(_MODELS[of], r), "Figure 5-6") for of in "CA"]
        for r in (0.81, 0.74)
    }
    return st.ranging(
        [bending / stiff for bending, stiff in errors.values()],
        "; ".join(
            f"r = {r:g}: rms of seven peaks of run 1 {bending:.1f} mm, by Model A {stiff:.1f} mm"
            for r, (bending, stiff) in errors.items()
        ),
    )
