"""Statements of section 5.2 on the tests of the steel column."""

import math

import numpy as np

from rockeom.analysis import formulas, identification
from rockeom.thesis.figures import chapter_5_tests as figures
from rockeom.thesis.printed import COLUMN, FIGURE_5_6, FIGURE_5_10, GAUGE
from rockeom.thesis.statements import statement as st

statement = st.Register()

_RUN_1, _RUN_2 = st.printed("Figure 5-6, sixteen points"), st.printed("Figure 5-10, sixteen points")


@statement(
    "5.2", "These are 285 mm, 1056 mm and 1093.8 mm respectively",
    st.rounded("1093.8", unit="mm", why="half of the last digit of the third"),
    st.closed_form("the first two as sides of a right angle"),
)  # fmt: skip
def distance_of_the_gauge() -> st.Finding:
    far = 1e3 * math.hypot(*GAUGE)
    return st.finding(far, f"{far:.1f} mm of {1e3 * GAUGE[0]:g} and {1e3 * GAUGE[1]:g} mm")


@statement(
    "Figure 5-6, theta/alpha_e", "0.099 ... 0.076 ... 0.062 ... 0.051",
    st.near(np.abs(FIGURE_5_6.numbers("theta/alpha_e")[::2]), 0.0006,
         why="half of the last digit, and of that of the displacement"),
    st.closed_form("5-2 of the displacements with atan(285/1050)"),
    figure="5-7",
)  # fmt: skip
def rotations_of_figure_5_6() -> st.Finding:
    rotation = identification.rotation_from_displacement(
        figures.points(1)[1][::2], **figures.MEASURED_AT
    )
    phi = np.abs(rotation) / figures.ALPHA
    return st.finding(phi, ", ".join(f"{x:.3f}" for x in phi))


# --- run 1: steel feet


@statement(
    "5.2.1", "The r value in this experiment varied between 0.75 and 0.95",
    st.between([0.75] * 7, [0.95] * 7, why="the printed range"),
    _RUN_1,
    figure="5-9",
)  # fmt: skip
def range_of_restitution() -> st.Finding:
    r = figures.impacts().energy_ratio
    return st.finding(r, f"{r.min():.3f} to {r.max():.3f} of the seven printed impacts")


@statement(
    "5.2.1", "the r value increased as the vibration diminished",
    st.at_most(0.0, "per alpha_e", why="slope of r against the peak before"),
    _RUN_1,
    figure="5-9",
)  # fmt: skip
def restitution_against_the_peak() -> st.Finding:
    rocking = figures.impacts()
    peak = np.abs(rocking.peak_before) / figures.ALPHA
    slope = float(np.polyfit(peak, rocking.energy_ratio, 1)[0])
    return st.finding(
        slope, f"by {-0.1 * slope:.2f} from 0.1 alpha_e to upright, by a straight line"
    )


@statement(
    "5.3.1", "approximately 12% below the average r value from the free rocking decay",
    st.about(12.0, "%", why="approximately"),
    st.closed_form("0.74 of 5-14"), _RUN_1,
    figure="5-6",
)  # fmt: skip
def theoretical_ratio_below_the_mean() -> st.Finding:
    mean = float(figures.impacts().energy_ratio.mean())
    below = 100 * (1 - 0.74 / mean)
    return st.finding(
        below, f"{below:.1f} % below {mean:.3f}, the mean of the seven printed impacts"
    )


# --- run 2: soft rubber


@statement(
    "5.2.2", "the vibration decayed much more rapidly than the corresponding experiment with the "
    "solid steel feet",
    st.at_least(1.1, why="much more: 10 % or more, decrement of a half-cycle over that on steel"),
    _RUN_2, _RUN_1,
    figure="5-10",
)  # fmt: skip
def decay_on_rubber() -> st.Finding:
    left = [abs(figures.points(run)[1][::2][7] / figures.points(run)[1][0]) for run in (1, 2)]
    cycles = [math.log(1 / x) / 7 for x in left]
    return st.finding(
        cycles[1] / cycles[0],
        f"seven half-cycles leave {100 * left[1]:.0f} % of the first peak on rubber, "
        f"{100 * left[0]:.0f} % on steel: {cycles[1]:.3f} and {cycles[0]:.3f} a half-cycle",
    )


@statement(
    "5.2.2", "the rotation centre migrated smoothly from one edge of the base plate to the other",
    st.near([0.0, 600.0], 60.0, "mm", why="to within 10 % of the plate's width"),
    st.closed_form("5-5 at the printed peaks of Figure 5-10"),
    figure="5-12", lost="the uplifts from which the centre was found are lost",
)  # fmt: skip
def travel_of_the_rotation_centre() -> st.Finding:
    centre = 1e3 * identification.rotation_centre(figures.smooth_trace(2)[1])
    return st.finding(
        [centre.min(), centre.max()], f"by 5-5 from {centre.min():.0f} to {centre.max():.0f} mm"
    )


@statement(
    "5.2.2", "the modification was found to be relatively insignificant",
    st.at_most(10.0, "%", why="insignificant: 10 %"),
    st.closed_form("5-6"), st.closed_form("5-2"),
    figure="5-13",
)  # fmt: skip
def rotation_about_the_moving_centre() -> st.Finding:
    first = FIGURE_5_10.numbers("displacement")[0] / 1e3
    fixed = float(identification.rotation_from_displacement(first, **figures.MEASURED_AT))
    centre = identification.rotation_centre(first)
    moving = float(identification.rotation_about_moving_centre(first, centre, GAUGE[1]))
    change = 100 * (moving / fixed - 1)
    return st.finding(abs(change), f"at {1e3 * first:.2f} mm 5-6 gives {change:+.2f} % of 5-2")


@statement(
    "5.2.2", "a similar nonlinear increase in the quarter period to the specimen with solid feet",
    st.at_least(0.8, why="correlation of the quarter period with the rotation"),
    _RUN_2,
    figure="5-14",
)  # fmt: skip
def quarter_periods_on_rubber() -> st.Finding:
    time, displacement = figures.points(2)
    quarters = np.diff(time)[2::2]
    trend = float(np.corrcoef(np.abs(displacement[2::2][: len(quarters)]), quarters)[0, 1])
    return st.finding(
        trend,
        f"{quarters.min():.3f} to {quarters.max():.3f} s after the first peak, correlation with "
        f"the peak {trend:.2f}",
    )


@statement(
    "5.2.2", "approximately 56 Hz. This is much higher than the expected natural frequency of the "
    "flexural response",
    st.at_least(1.1, why="much higher: 10 % or more, 56 Hz over the highest of the model"),
    st.closed_form("vibration of 5-34 and 5-35, feet down and on one foot"),
    figure="5-15",
)  # fmt: skip
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


@statement(
    "5.2.2", "The average viscous damping ratio over the entire record was 0.104",
    st.rounded("0.104"),
    _RUN_2,
    figure="5-16", lost="the record continues to smaller peaks, which are not printed",
)  # fmt: skip
def mean_damping_on_rubber() -> st.Finding:
    _, ratio = _damping()
    return st.finding(
        ratio.mean(),
        f"{ratio.mean():.3f} over the six printed cycles, {ratio.min():.3f} to {ratio.max():.3f}",
    )


@statement(
    "5.2.2", "increased as the motion decayed",
    st.at_most(0.0, why="correlation of the damping ratio with the peak, all printed cycles"),
    _RUN_2,
    figure="5-16",
)  # fmt: skip
def damping_against_the_peak() -> st.Finding:
    size, ratio = _damping()
    every, later = (float(np.corrcoef(size[k:], ratio[k:])[0, 1]) for k in (0, 1))
    return st.finding(
        every, f"{every:+.2f}; {later:+.2f} after the first cycle, which has {ratio[0]:.3f}"
    )


# --- errors of the text


@statement(
    "5.2, 5.3.3", "the ideal structural stiffness (k = 571.8 kN/m)",
    st.rounded("571.8", unit="kN/m", why="half of the last digit, for the run on solid feet"),
    st.closed_form("5-1 with the period on solid feet, 0.112 s"),
    slip=True,
)  # fmt: skip
def stiffness_of_the_column() -> st.Finding:
    k = [
        float(identification.stiffness_from_period(COLUMN["mass"], t)) / 1e3 for t in (0.112, 0.092)
    ]
    return st.finding(
        k[0],
        f"5-1 gives {k[0]:.1f} kN/m at their 0.112 s; {k[1]:.1f} kN/m belongs to 0.092 s, that of "
        "the rubber pad",
    )


@statement(
    "5.2.2, with 5-6", "H = 1056 mm",
    st.rounded("1056", unit="mm", why="half of the last digit, for H of the mass"),
    st.printed("height of the mass and of the gauge"),
    slip=True,
)  # fmt: skip
def height_in_5_6() -> st.Finding:
    return st.finding(
        1e3 * COLUMN["height"],
        f"H' = {1e3 * GAUGE[1]:g} mm, to the gauge; H of the mass is {1e3 * COLUMN['height']:g} mm",
    )


@statement(
    "captions 5-23, 5-25", "r_{sim} = 0.81",
    st.rounded("0.81", why="half of the last digit, as the average r of the tests"),
    st.printed("Figure 5-6, seven impacts"),
    slip=True,
)  # fmt: skip
def mean_restitution_of_the_captions() -> st.Finding:
    mean = float(figures.impacts().energy_ratio.mean())
    return st.finding(
        mean,
        f"the mean of Figure 5-6 is {mean:.3f}, of which 0.74 is about 12 % below, as 5.3.1 says; "
        f"of 0.81 it is {100 * (1 - 0.74 / 0.81):.1f} % below",
    )
