"""Statements of chapter 3 on the free rocking block."""

import math

import numpy as np

from rockeom.analysis import formulas, identification
from rockeom.thesis.figures import chapter_3 as figures
from rockeom.thesis.figures.chapter_3 import (
    BLOCK,
    PRINTED_HOUSNER,
    R_HOUSNER,
    corrected_impacts,
    fitted_change,
    impact_forces,
    measured_impacts,
)
from rockeom.thesis.points_of_interest import points_by_score
from rockeom.thesis.printed import TABLE_3_1
from rockeom.thesis.statements import statement as st


def aspect_ratio() -> st.Finding:
    ratio = 1 / math.tan(BLOCK.alpha)
    return st.finding(ratio, f"{ratio:.2f} of the centroid's height and half of the width")


# --- 3.2 the motion


def quarters_of_figure_3_3() -> st.Finding:
    quarters = np.diff(figures.points()[0])[::2]
    ratio = float((quarters[1:] / quarters[:-1]).max())
    return st.finding(ratio, f"{', '.join(f'{q:.3f}' for q in quarters)} s")


def points_of_a_record() -> st.Finding:
    scored = points_by_score(figures.record(), "theta")
    n = len(scored.peaks) + len(scored.crossings)
    return st.finding(n, f"{len(scored.peaks)} peaks and {len(scored.crossings)} crossings in kind")


def accuracy_of_2_5() -> st.Finding:
    error = _errors_of_quarters()
    return st.finding(
        100 * np.abs(error[1:]).max(),
        f"{100 * np.abs(error[1:]).max():.1f} % at most of 11 quarters; the first, which holds the "
        f"delay of the release, {100 * error[0]:.1f} %",
    )


def sign_of_the_error_of_2_5() -> st.Finding:
    error = _errors_of_quarters()[1:]
    return st.finding(
        int((error > 0).sum()),
        f"{(error > 0).sum()} of 11, by {100 * error.mean():+.1f} % on the average",
    )


def _errors_of_quarters() -> np.ndarray:
    """Relative errors of 2-5 at the twelve quarters of Figure 3-3."""
    time, rotation = figures.points()
    peaks = np.abs(np.where(rotation[:-1] != 0, rotation[:-1], rotation[1:]))
    predicted = formulas.quarter_period(peaks / BLOCK.alpha, BLOCK.frequency_parameter)
    return predicted / np.diff(time) - 1


def crossings_with_less_restitution() -> st.Finding:
    measured = figures.points()[0][1::2] - figures.release_delay()
    off = [
        float(np.abs([hit.time for hit in figures.housner(r, 14.0).impacts[:6]] - measured).max())
        for r in (PRINTED_HOUSNER, 0.88 * PRINTED_HOUSNER)
    ]
    return st.finding(
        off[1] / off[0],
        f"off by {off[0]:.2f} s at most with 0.89, by {off[1]:.2f} s with 0.88 of it",
    )


def end_with_less_restitution() -> st.Finding:
    ends = [
        figures.housner(r, 14.0).events.rest_time or math.inf
        for r in (PRINTED_HOUSNER, 0.88 * PRINTED_HOUSNER)
    ]
    return st.finding(ends[1] / ends[0], f"at {ends[1]:.1f} s instead of {ends[0]:.1f} s")


def speed_at_the_second_impact() -> st.Finding:
    own = float(abs(measured_impacts().speed[1]))
    predicted = abs(figures.housner(PRINTED_HOUSNER, 14.0).impacts[1].before["theta_dot"])
    return st.finding(
        own / predicted,
        f"from the printed peaks, without another energy, {own:.3f} rad/s; predicted "
        f"{predicted:.3f} rad/s",
    )


# --- 3.2.2 energy


def rate_by_resampling() -> st.Finding:
    again = figures.record().velocities_by_resampling("theta", 0.05)
    return st.finding(
        again.spread / again.noise,
        f"in kind, the rate at half and twice the sampling is off by {again.spread:.4f} rad/s "
        f"(standard deviation), its noise being {again.noise:.4f} rad/s",
    )


def energy_between_the_peaks() -> st.Finding:
    energy = measured_impacts().energy_before
    ratio = float(energy[1:].max() / energy[0])
    return st.finding(ratio, f"at the later printed peaks {100 * ratio:.0f} % at most")


def energy_at_one_degree() -> st.Finding:
    energy = float(identification.static_energy(BLOCK, math.radians(1.1)))
    return st.finding(energy, f"{energy:.2f} J, for the printed mass and size")


def rotation_of_the_threshold() -> st.Finding:
    share = 100 * math.radians(1.1) / BLOCK.alpha
    return st.finding(share, f"{share:.1f} % of {math.degrees(BLOCK.alpha):.2f} degrees")


# --- 3.2.3 support forces


def baseline_of_table_3_1() -> st.Finding:
    first = figures.housner(R_HOUSNER, 14.0).impacts[0]
    speed = abs(first.before["theta_dot"])
    horizontal, vertical = formulas.block_reactions_at_impact(
        speed, 1, slender=True, **figures.SHAPE
    )
    v, h = float(vertical) / 1e3, abs(float(horizontal)) / 1e3
    return st.finding([v, h], f"{v:.3f} and {h:.3f} kN at {speed:.3f} rad/s")


def rise_of_the_horizontal_force() -> st.Finding:
    ratio = TABLE_3_1.cell("horizontal", "measured peak") / TABLE_3_1.cell("horizontal", "baseline")
    return st.finding(100 * (ratio - 1), f"by {100 * (ratio - 1):.1f} %: {ratio:.3f} is the ratio")


def limit_of_the_vertical_force() -> st.Finding:
    h, v = formulas.block_reactions_at_impact(0.0, 1, slender=True, **figures.SHAPE)
    weight = BLOCK.mass * BLOCK.gravity
    return st.finding(
        float(v) / weight,
        f"{float(v) / 1e3:.3f} kN of {weight / 1e3:.3f} kN; the horizontal force chatters between "
        f"\N{PLUS-MINUS SIGN}{abs(float(h)) / 1e3:.3f} kN",
    )


def _support_forces() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Speeds of impacts up to the largest [rad/s], with the forces H and V [N], (201,) each."""
    most = float(formulas.impact_speed(BLOCK.alpha, alpha=BLOCK.alpha, radius=BLOCK.radius))
    speed = np.linspace(0.0, most, 201)
    return speed, *formulas.block_reactions_at_impact(speed, 1, slender=True, **figures.SHAPE)


def range_of_the_support_forces() -> st.Finding:
    speed, h, v = _support_forces()
    change = [100 * float(np.ptp(x) / np.abs(x).max()) for x in (v, h)]
    return st.finding(
        max(change),
        f"up to {speed[-1]:.2f} rad/s the vertical force changes by {change[0]:.0f} %, the "
        f"horizontal one by {change[1]:.0f} %",
    )


def direction_of_the_support_force() -> st.Finding:
    _, h, v = _support_forces()
    angle = np.degrees(np.arctan2(np.abs(h), v))
    return st.finding(
        float(np.ptp(angle)), f"from {angle.min():.2f} to {angle.max():.2f} degrees of the vertical"
    )


def _slope(values: np.ndarray) -> float:
    """Growth of a force of impacts on the left foot, from 0.2 to 0.8 rad/s, in kind."""
    speed = np.abs(impact_forces().speed)
    left = impact_forces().speed < 0
    line = np.polyfit(speed[left], np.abs(values[left]), 1)
    return float(np.polyval(line, 0.8) / np.polyval(line, 0.2) - 1)


def growth_of_impact_force(component: str) -> st.Finding:
    growth = 100 * _slope(getattr(impact_forces(), component))
    return st.finding(growth, f"in kind {growth:+.0f} % (left foot)")


def direction_of_impact_forces() -> st.Finding:
    forces = impact_forces()
    left = forces.speed < 0
    line = np.polyfit(np.abs(forces.speed[left]), np.degrees(forces.angle[left]), 1)
    change = [float(np.polyval(line, v)) for v in (0.2, 0.8)]
    more = 100 * _slope(forces.magnitude)
    return st.finding(
        change[1] - change[0],
        f"in kind from {change[0]:.0f} to {change[1]:.0f} degrees, the magnitude {more:+.0f} %",
    )


# --- 3.2.4 restitution


def restitution_by_foot() -> st.Finding:
    impacts = measured_impacts()
    gap = impacts.at_foot("right").energy_ratio.min() - impacts.at_foot("left").energy_ratio.max()
    listed = ", ".join(f"{r:.3f}" for r in impacts.energy_ratio)
    return st.finding(float(gap), f"r by 3-3 {listed}; the left foot lands first")


def effect_of_the_correction() -> st.Finding:
    changes = [
        np.abs(corrected.energy_ratio - plain.energy_ratio)
        for plain, corrected in (corrected_impacts(*run) for run in figures.RUNS)
    ]
    first = max(float(x[0]) for x in changes)
    later = max(float(x[2:].max()) for x in changes)
    return st.finding(
        later, f"in kind by {first:.3f} at most at the first impact, {later:.3f} after the cycle"
    )


def mean_restitution() -> st.Finding:
    mean = float(measured_impacts().energy_ratio.mean())
    return st.finding(mean, f"{mean:.3f} of the six printed")


def range_of_restitution() -> st.Finding:
    r = measured_impacts().energy_ratio
    return st.finding(r, f"{r.min():.3f} to {r.max():.3f}, the six printed")


def fit_of_losses(number: str, foot: str) -> st.Finding:
    of = measured_impacts().at_foot(foot)
    off = float(np.abs(of.energy_change - fitted_change(number, of.speed)).max())
    return st.finding(off, f"off by {off:.2f} J at most where the {foot} foot lands")


def restitution_against_the_speed() -> st.Finding:
    slopes = [
        float(np.polyfit(np.abs(of.speed), of.energy_ratio, 1)[0])
        for of in map(measured_impacts().at_foot, ("left", "right"))
    ]
    return st.finding(
        [-slopes[0], slopes[1]],
        f"slopes of {slopes[0]:+.2f} and {slopes[1]:+.2f} s/rad of three impacts on each foot",
    )


def loss_against_the_impact_force() -> st.Finding:
    return st.unknown("no impact force is printed but the peaks of one run, Table 3-1")


# --- 3.3 summary


def restitution_of_the_block() -> st.Finding:
    five = float(formulas.energy_ratio_of_block(math.atan(1 / 5.0)))
    return st.finding(
        R_HOUSNER,
        f"{R_HOUSNER:.3f} at {1 / math.tan(BLOCK.alpha):.2f}; {five:.3f} belongs to 5",
    )


def share_below_housner() -> st.Finding:
    r = measured_impacts().energy_ratio
    share = 100 * float(np.mean(r < R_HOUSNER))
    return st.finding(share, f"{share:.0f} % of the six printed are below {R_HOUSNER:.3f}")


_BUNCHES = ((0.73, 0.76), (0.8, 0.86), (0.9, 0.95))


def bunches_of_restitution() -> st.Finding:
    r = np.round(measured_impacts().energy_ratio, 2)
    inside = [int(np.sum((r >= low) & (r <= high))) for low, high in _BUNCHES]
    return st.finding(
        sum(inside), f"{inside[0]}, {inside[1]} and {inside[2]} of the six printed lie in them"
    )


def matching_with_one_ratio() -> st.Finding:
    """Errors of six peaks, of the first, and of their times, of a half-cycle, with the best r."""
    time, rotation = figures.points()
    peak, at = np.abs(rotation[::2]), time[::2] - figures.release_delay()
    errors = {}
    for r in np.arange(0.78, 0.85, 0.0025).tolist():
        own = identification.swings(figures.housner(r, 14.0), "theta", len(peak))
        sizes = np.abs(np.abs(own.peak) - peak)[1:] / peak[0]
        late = np.abs(own.peak_time - at)[1:] / np.diff(at).mean()
        rms = [float(np.sqrt(np.mean(x**2))) for x in (sizes, late)]
        errors[r] = max(rms), float(max(sizes.max(), late.max()))
    rms, worst = (100 * np.array([*errors.values()]).min(axis=0)).tolist()
    return st.ranging([rms, worst], f"{rms:.1f} % (rms) or {worst:.1f} % (largest) with the best r")
