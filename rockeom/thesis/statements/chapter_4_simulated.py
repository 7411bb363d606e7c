"""Statements of section 4.8 on the free vibration of the wall simulated."""

import numpy as np

from rockeom.thesis.figures import FIGURES, NOT_DRAWN, chapter_4_simulated as figures
from rockeom.thesis.free_vibration_table import measured_peaks
from rockeom.thesis.statements import statement as st

statement = st.Register()

_PEAKS = st.data("Table A-1, thirteen peaks")


# --- 4.8.1 the equivalent oscillator


@statement(
    "4.8.1", "there is not a single r value implemented using the current framework which can "
    "simulate the energy dissipation of the free vibration decay correctly",
    st.at_least(0.0, why="gap between the 95 % intervals of early and late passages"),
    st.simulation("4-27, r fitted"), _PEAKS,
    figure="4-36",
)  # fmt: skip
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


@statement(
    "4.8.1", "results in a large change to the subsequent response",
    st.at_least(10.0, "% of the first peak", why="large: 10 % or more"),
    st.simulation("4-27 with r of 4-31 larger by 0.02 in one band"),
    figure="4-38", lost="the deviations of the figure are not legible",
)  # fmt: skip
def sensitivity_to_4_31() -> st.Finding:
    off = figures.moved(figures.with_deviations_of_4_31())
    first = 1e3 * abs(measured_peaks()[1][0])
    return st.finding(
        100 * max(off) / first,
        f"{', '.join(f'{x:.1f}' for x in off)} mm, of {first:.1f} mm at first",
    )


# --- 4.8.2 substitute gravity about fixed corners


@statement(
    "4.8.2", "appears to vary between 0.91 for the large displacement cycles to around 0.88",
    st.near([0.91, 0.88], 0.02, why="means of six passages each, to two digits of r"),
    st.simulation("4-32, released at each peak"), _PEAKS,
    figure="4-39",
)  # fmt: skip
def ratios_of_large_and_small_cycles() -> st.Finding:
    r, _ = figures.ratios_by_release()
    early, late = float(r[:6].mean()), float(r[6:].mean())
    return st.finding([early, late], f"{early:.3f} and {late:.3f}")


@statement(
    "4.8.2", "no apparent relationship can be deduced to describe how the r value varies",
    st.at_most(1.0, "half-widths", why="slope over the half-width of its 95 % interval"),
    st.simulation("4-32, released at each peak"), _PEAKS,
    figure="4-40",
)  # fmt: skip
def restitution_by_release_against_speed() -> st.Finding:
    return st.slope_of(*figures.ratios_by_release(), 0.88)


@statement(
    "4.8.2", "is seemingly random",
    st.at_least(0.0, why="largest r from the right less smallest from the left, eight passages"),
    st.simulation("4-32, released at each peak"), _PEAKS,
    figure="4-40",
)  # fmt: skip
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


@statement(
    "4.8.2", "the moving average data resembles the empirical r expression",
    st.at_most(0.05, why="resembles: rms of the averages off 4-31"),
    st.simulation("4-32, released at each peak"), st.closed_form("4-31"),
    figure="4-41",
)  # fmt: skip
def moving_averages() -> st.Finding:
    r, speed = figures.ratios_by_release()
    mean, at = (r[1:] + r[:-1]) / 2, (speed[1:] + speed[:-1]) / 2
    off = mean - np.array([figures.BY_4_31.at(x) for x in at])
    return st.finding(
        float(np.sqrt(np.mean(off**2))),
        f"rms {np.sqrt(np.mean(off**2)):.3f} off it, {off.min():+.3f} to {off.max():+.3f}; "
        f"{mean.std(ddof=1):.3f} (standard deviation) about their own mean",
    )


@statement(
    "4.8.2", "it is not a dramatic improvement over the use of a single r value",
    st.at_least(0.5, why="dramatic: half of the rms error of the peaks with r = 0.88"),
    st.simulation("4-32 with 4-31"), _PEAKS,
    figure="4-42",
)  # fmt: skip
def improvement_by_4_31() -> st.Finding:
    by_4_31, constant = figures.miss(figures.BY_4_31), figures.miss(figures.CONSTANT)
    return st.finding(
        by_4_31.peak / constant.peak,
        f"rms of the peaks and their times: {by_4_31} with 4-31, {constant} with 0.88",
    )


@statement(
    "4.8.2", "an equally effective simulation can be achieved if r is varied linearly between 0.88 "
    "and 0.91",
    st.near(1.0, 0.1, why="equally: 10 %, rms error of the peaks over that with 4-31"),
    st.simulation("4-32 with 4-36"), _PEAKS,
    figure="4-43", lost="which r of 4-36 belongs to the large speeds the text says in both ways",
)  # fmt: skip
def effect_of_4_36() -> st.Finding:
    by_4_36, by_4_31 = figures.miss(figures.BY_4_36), figures.miss(figures.BY_4_31)
    return st.finding(
        by_4_36.peak / by_4_31.peak,
        f"rms of the peaks and their times: {by_4_36} with 4-36, {by_4_31} with 4-31",
    )


@statement(
    "4.8.2", "an acceleration greater than 11.1 m/s2 is needed to start it",
    st.rounded("11.1", unit="m/s2"),
    st.closed_form("4-32 at rest"),
    figure="4-43",
)  # fmt: skip
def acceleration_that_starts_the_wall() -> st.Finding:
    start = figures.FIXED.uplift_acceleration
    assert start is not None
    return st.finding(start, f"{start:.2f} m/s2")


@statement(
    "4.8.2", "It is observed from Figure 4-49",
    st.near(1.0, 0.0, why="Figure 4-49 is a free vibration with a range of r"),
    st.printed("captions 4-39 and 4-49"),
    slip=True,
)  # fmt: skip
def figure_of_the_range_of_restitution() -> st.Finding:
    return st.finding(
        "4-49" in FIGURES, f"4-39: {FIGURES['4-39'].title}; of 4-49: {NOT_DRAWN['4-49']}"
    )


# --- 4.8.3 sensitivity


@statement(
    "4.8.3", "moderately sensitive to r, most where it changes early",
    st.at_most([1.0, 1.0], why="change by each slower band over that by the band before"),
    st.simulation("4-40 with r of 4-38 larger by 0.02 in one band"),
    figure="4-48", lost="the deviations of the figure are not stated",
)  # fmt: skip
def sensitivity_to_4_38() -> st.Finding:
    off = np.array(figures.moved(figures.with_deviations_of_4_38()))
    return st.finding(off[1:] / off[:-1], f"{', '.join(f'{x:.1f}' for x in off)} mm")
