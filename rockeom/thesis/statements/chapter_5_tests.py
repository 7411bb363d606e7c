"""Statements of section 5.2 on the tests of the steel column."""

import math

import numpy as np

from rockeom.analysis import formulas, identification
from rockeom.thesis import shaken
from rockeom.thesis.figures import chapter_5_tests as figures
from rockeom.thesis.printed import COLUMN, FIGURE_5_10, GAUGE
from rockeom.thesis.statements import statement as st


def distance_of_the_gauge() -> st.Finding:
    far = 1e3 * math.hypot(*GAUGE)
    return st.finding(far, f"{far:.1f} mm of {1e3 * GAUGE[0]:g} and {1e3 * GAUGE[1]:g} mm")


def stiffness_of_the_column() -> st.Finding:
    k = [
        float(identification.stiffness_from_period(COLUMN["mass"], t)) / 1e3 for t in (0.112, 0.092)
    ]
    return st.finding(
        k[0],
        f"5-1 gives {k[0]:.1f} kN/m at their 0.112 s; {k[1]:.1f} kN/m belongs to 0.092 s, that of "
        "the rubber pad",
    )


def rotations_of_figure_5_6() -> st.Finding:
    rotation = identification.rotation_from_displacement(
        figures.points(1)[1][::2], **figures.MEASURED_AT
    )
    phi = np.abs(rotation) / figures.ALPHA
    return st.finding(phi, ", ".join(f"{x:.3f}" for x in phi))


# --- run 1: steel feet


def range_of_restitution() -> st.Finding:
    r = figures.impacts().energy_ratio
    return st.finding(r, f"{r.min():.3f} to {r.max():.3f} of the seven printed impacts")


def restitution_against_the_peak() -> st.Finding:
    rocking = figures.impacts()
    peak, r = np.abs(rocking.peak_before) / figures.ALPHA, rocking.energy_ratio
    line = identification.fit(lambda r, slope: r + slope * peak, r, {"r": 0.9, "slope": 0.0})
    low, high = line.interval("slope")
    return st.ranging([low, high], f"{low:.2f} to {high:.2f} with 95 % confidence")


def theoretical_ratio_below_the_mean() -> st.Finding:
    mean = float(figures.impacts().energy_ratio.mean())
    below = 100 * (1 - 0.74 / mean)
    return st.finding(
        below, f"{below:.1f} % below {mean:.3f}, the mean of the seven printed impacts"
    )


def mean_restitution_of_the_captions() -> st.Finding:
    mean = float(figures.impacts().energy_ratio.mean())
    return st.finding(
        mean,
        f"the mean of Figure 5-6 is {mean:.3f}, of which 0.74 is about 12 % below, as 5.3.1 says; "
        f"of 0.81 it is {100 * (1 - 0.74 / 0.81):.1f} % below",
    )


# --- run 2: soft rubber


def decay_on_rubber() -> st.Finding:
    left = [abs(figures.points(run)[1][::2][7] / figures.points(run)[1][0]) for run in (1, 2)]
    cycles = [math.log(1 / x) / 7 for x in left]
    return st.finding(
        cycles[1] / cycles[0],
        f"seven half-cycles leave {100 * left[1]:.0f} % of the first peak on rubber, "
        f"{100 * left[0]:.0f} % on steel: {cycles[1]:.3f} and {cycles[0]:.3f} a half-cycle",
    )


def travel_of_the_rotation_centre() -> st.Finding:
    centre = 1e3 * identification.rotation_centre(figures.smooth_trace(2)[1])
    return st.finding(
        [centre.min(), centre.max()], f"by 5-5 from {centre.min():.0f} to {centre.max():.0f} mm"
    )


def rotation_about_the_moving_centre() -> st.Finding:
    first = FIGURE_5_10.numbers("displacement")[0] / 1e3
    fixed = float(identification.rotation_from_displacement(first, **figures.MEASURED_AT))
    centre = identification.rotation_centre(first)
    moving = float(identification.rotation_about_moving_centre(first, centre, GAUGE[1]))
    change = 100 * (moving / fixed - 1)
    return st.finding(abs(change), f"at {1e3 * first:.2f} mm 5-6 gives {change:+.2f} % of 5-2")


def height_in_5_6() -> st.Finding:
    return st.finding(
        1e3 * COLUMN["height"],
        f"H' = {1e3 * GAUGE[1]:g} mm, to the gauge; H of the mass is {1e3 * COLUMN['height']:g} mm",
    )


def quarter_periods_on_rubber() -> st.Finding:
    time, displacement = figures.points(2)
    quarters = np.diff(time)[2::2]
    trend = float(np.corrcoef(np.abs(displacement[2::2][: len(quarters)]), quarters)[0, 1])
    return st.finding(
        trend,
        f"{quarters.min():.3f} to {quarters.max():.3f} s after the first peak, correlation with "
        f"the peak {trend:.2f}",
    )


def frequency_of_the_elastic_mode() -> st.Finding:
    both, foot = figures.frequencies("both")[0], figures.frequencies("right")[-1]
    return st.finding(
        56 / max(both, foot),
        f"the model with one mass has {both:.1f} Hz with both feet down and {foot:.1f} Hz on one "
        "foot, so that 56 Hz is neither",
    )


def _damping() -> tuple[np.ndarray, np.ndarray]:
    """Peaks [m] before six cycles of run 2, and the damping ratio of each by 5-7."""
    peaks = figures.points(2)[1][::2]
    return np.abs(peaks[:-2]), formulas.damping_from_decrement(peaks[:-2], peaks[2:])


def mean_damping_on_rubber() -> st.Finding:
    _, ratio = _damping()
    return st.finding(
        ratio.mean(),
        f"{ratio.mean():.3f} over the six printed cycles, {ratio.min():.3f} to {ratio.max():.3f}",
    )


def damping_against_the_peak() -> st.Finding:
    size, ratio = _damping()
    line = identification.fit(
        lambda d, slope: d + slope * size / size[0], ratio, {"d": 0.07, "slope": 0.0}
    )
    low, high = line.interval("slope")
    later = float(np.corrcoef(size[1:], ratio[1:])[0, 1])
    return st.ranging(
        [low, high],
        f"{low:+.3f} to {high:+.3f} with 95 % confidence; without the first cycle, which has "
        f"{ratio[0]:.3f}, the correlation is {later:+.2f}",
    )


# --- runs 3 and 4


def pulses_of_pacoima_dam() -> st.Finding:
    motion = shaken.column_motion("4")
    samples = np.abs(np.asarray(motion.samples))
    t = float(motion.dt or 0.0) * np.arange(len(samples))
    share = 100 * float((samples[t < 2] ** 2).sum() / (samples[t < 7] ** 2).sum())
    later = float(samples[(t >= 2) & (t < 7)].max() / motion.peak)
    return st.finding(
        share, f"{share:.0f} %; the peak of the five seconds is {later:.2f} of the largest"
    )
