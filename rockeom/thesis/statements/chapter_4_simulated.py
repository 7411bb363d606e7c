"""Statements of section 4.8 on the free vibration of the wall simulated."""

import numpy as np

from rockeom.thesis.figures import FIGURES, NOT_DRAWN, chapter_4_simulated as figures
from rockeom.thesis.free_vibration_table import measured_peaks
from rockeom.thesis.statements import statement as st

# --- 4.8.1 the equivalent oscillator


def ratios_of_early_and_late_passages() -> st.Finding:
    early, late = figures.fitted_ratio(0, 5), figures.fitted_ratio(8, 12)
    gap = early.interval("r")[0] - late.interval("r")[1]
    said = [
        f"{one.values['r']:.3f} ({one.interval('r')[0]:.3f} to {one.interval('r')[1]:.3f})"
        for one in (early, late)
    ]
    return st.finding(
        gap, f"the first five passages ask for r = {said[0]}, the last four {said[1]}"
    )


def sensitivity_to_4_31() -> st.Finding:
    off = figures.moved(figures.with_deviations_of_4_31())
    first = 1e3 * abs(measured_peaks()[1][0])
    return st.finding(
        100 * max(off) / first,
        f"{', '.join(f'{x:.1f}' for x in off)} mm, of {first:.1f} mm at first",
    )


# --- 4.8.2 substitute gravity about fixed corners


def ratios_of_large_and_small_cycles() -> st.Finding:
    r, _ = figures.ratios_by_release()
    early, late = float(r[:6].mean()), float(r[6:].mean())
    return st.finding([early, late], f"{early:.3f} and {late:.3f}")


def restitution_by_release_against_speed() -> st.Finding:
    return st.slope_of(*figures.ratios_by_release(), 0.88)


def restitution_by_side() -> st.Finding:
    r, _ = figures.ratios_by_release()
    peak = measured_peaks()[1][:-1]
    left, right = (r[:8][peak[:8] * side > 0] for side in (-1, 1))
    place = figures.upright(8)
    low, high = (1e3 * x for x in place.interval("x"))
    return st.finding(
        float(right.max() - left.min()),
        f"the first eight alternate with the side, {left.min():.3f} to {left.max():.3f} coming "
        f"from the left, {right.min():.3f} to {right.max():.3f} from the right; an upright "
        f"{1e3 * place.values['x']:.2f} mm ({low:.2f} to {high:.2f}) to the right of the gauge's "
        "zero explains some of it",
    )


def moving_averages() -> st.Finding:
    r, speed = figures.ratios_by_release()
    mean, at = (r[1:] + r[:-1]) / 2, (speed[1:] + speed[:-1]) / 2
    off = mean - np.array([figures.BY_4_31.at(x) for x in at])
    return st.finding(
        float(np.sqrt(np.mean(off**2))),
        f"rms {np.sqrt(np.mean(off**2)):.3f} off it, {off.min():+.3f} to {off.max():+.3f}; "
        f"{mean.std(ddof=1):.3f} (standard deviation) about their own mean",
    )


def improvement_by_4_31() -> st.Finding:
    by_4_31, constant = figures.miss(figures.BY_4_31), figures.miss(figures.CONSTANT)
    return st.finding(
        by_4_31.peak / constant.peak,
        f"rms of the peaks and their times: {by_4_31} with 4-31, {constant} with 0.88",
    )


def effect_of_4_36() -> st.Finding:
    by_4_36, by_4_31 = figures.miss(figures.BY_4_36), figures.miss(figures.BY_4_31)
    return st.finding(
        by_4_36.peak / by_4_31.peak,
        f"rms of the peaks and their times: {by_4_36} with 4-36, {by_4_31} with 4-31",
    )


def acceleration_that_starts_the_wall() -> st.Finding:
    start = figures.FIXED.uplift_acceleration
    assert start is not None
    return st.finding(start, f"{start:.2f} m/s2")


def figure_of_the_range_of_restitution() -> st.Finding:
    return st.finding(
        "4-49" in FIGURES, f"4-39: {FIGURES['4-39'].title}; of 4-49: {NOT_DRAWN['4-49']}"
    )


# --- 4.8.3 sensitivity


def sensitivity_to_4_38() -> st.Finding:
    off = np.array(figures.moved(figures.with_deviations_of_4_38()))
    return st.finding(off[1:] / off[:-1], f"{', '.join(f'{x:.1f}' for x in off)} mm")
