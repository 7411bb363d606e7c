"""Statements of sections 4.5.1 and 4.7 on the measured free vibration of the wall."""

import math

import numpy as np
from scipy.integrate import trapezoid
from scipy.special import erf

from rockeom.analysis import identification
from rockeom.thesis.figures import chapter_4_free_vibration as figures
from rockeom.thesis.figures.chapter_4_free_vibration import GAUGE, legible
from rockeom.thesis.free_vibration_table import PEAKS, WALL
from rockeom.thesis.printed import FIGURE_4_29
from rockeom.thesis.statements import statement as st
from rockeom.thesis.statements.chapter_4_wall import fits_of_quarters
from rockeom.thesis.wall_tests import quarter_period_fit


def _measured() -> identification.FreeVibration:
    return identification.FreeVibration.table_a1()


# --- 4.5.1 the record


def correction_of_the_toe() -> st.Finding:
    taken = 100 * GAUGE / np.asarray(_measured().centre_from_edge)[figures.peaks()]
    return st.finding(
        taken.max(), f"by {taken.min():.0f} to {taken.max():.0f} % at the first 13 peaks"
    )


def travel_of_the_centre_while_rocking() -> st.Finding:
    x = 1e3 * np.asarray(_measured().centre_from_edge)[figures.peaks()[:9]]
    return st.finding(float(np.ptp(x)), f"from {x.min():.0f} to {x.max():.0f} mm")


def centre_at_the_end() -> st.Finding:
    measured = _measured()
    x = 1e3 * np.asarray(measured.centre_from_edge)
    late, early = x[measured.at_peak & legible()][-3:], x[figures.peaks()[:9]]
    return st.finding(
        late.max() / early.max(),
        f"{late.min():.0f} to {late.max():.0f} mm at the last 3 legible peaks, {early.min():.0f} "
        f"to {early.max():.0f} mm at the first 9",
    )


def fit_of_4_5() -> st.Finding:
    rows, every = fits_of_quarters(quarter_period_fit)
    return st.ranging(
        [rows, every], f"{rows:.4f} at the 19 legible quarters, {every:.4f} at all 22"
    )


def coefficients_of_4_5() -> st.Finding:
    fit = figures.fitted_quarters()
    ends = [fit.interval(name) for name in ("k", "c")]
    k, c = (fit.values[name] for name in ("k", "c"))
    return st.ranging(
        list(zip(*ends, strict=True)),
        f"{k:.3f} s/sqrt(m), {ends[0][0]:.3f} to {ends[0][1]:.3f}; {1e3 * c:.1f} ms, "
        f"{1e3 * ends[1][0]:.1f} to {1e3 * ends[1][1]:.1f} ms with 95 % confidence",
    )


def range_of_frequency() -> st.Finding:
    peak, time = figures.quarters()
    fast, slow = 1 / (4 * time[np.argmin(np.abs(peak))]), 1 / (4 * time[0])
    last = 1 / (4 * _measured().quarter_periods().time[-4:])
    drift = 100 * abs(peak[0]) / WALL.height
    return st.finding(
        [fast, slow],
        f"{fast:.1f} Hz at the smallest legible peak to {slow:.1f} Hz at {drift:.2f} %; "
        f"{last.min():.1f} to {last.max():.1f} Hz where rows had to be guessed",
    )


def uplift_against_displacement() -> st.Finding:
    measured, chosen = _measured(), legible()
    left, right = np.asarray(measured.left_uplift), np.asarray(measured.right_uplift)
    uplift = np.where(measured.displacement > 0, left, right)[chosen]
    size = np.abs(measured.displacement[chosen])
    line = identification.fit(lambda k, c: k * size + c, uplift, {"k": 0.4, "c": 1e-4})
    return st.finding(
        line.r_squared,
        f"{line.r_squared:.3f}, {line.values['k']:.3f} of the displacement; about the far edge it "
        f"were {2 * WALL.half_width / WALL.height:.3f}",
    )


def fit_of_4_9() -> st.Finding:
    measured = _measured()
    size = np.abs(measured.displacement)
    left, right = np.asarray(measured.left_uplift), np.asarray(measured.right_uplift)
    uplift = np.where(measured.displacement > 0, left, right)
    fits = [
        float(identification.coefficient_of_determination(uplift[rows], WALL.uplift(size[rows])))
        for rows in (legible(), measured.at_peak & legible())
    ]
    return st.ranging(fits, f"{fits[0]:.3f} at all legible rows, {fits[1]:.3f} at the peaks")


def slopes_of_the_tendon_force() -> st.Finding:
    measured, chosen = _measured(), legible()
    size, force = np.abs(measured.displacement[chosen]), np.asarray(measured.tendon_force)[chosen]
    slopes = []
    for rows in (size < 2e-3, (size > 2e-3) & (size < 8e-3)):
        x, y = size[rows], force[rows]
        slopes.append(identification.fit(lambda k, c, x=x: k * x + c, y, {"k": 1e6, "c": 75e3}))
    small, large = slopes
    ratios = [a / b for a in small.interval("k") for b in large.interval("k")]
    said = ", ".join(
        f"{s.values['k'] / 1e6:.2f} kN/mm ({s.interval('k')[0] / 1e6:.2f} to "
        f"{s.interval('k')[1] / 1e6:.2f})"
        for s in slopes
    )
    return st.ranging(ratios, f"{said} with 95 % confidence; the zero of the gauge is not upright")


def column_of_the_rotation_centre() -> st.Finding:
    measured = _measured()
    rows = measured.at_peak & legible() & (np.abs(measured.displacement) > 5e-3)
    beside = measured.centre_from_edge - measured.rotation_centre(WALL.half_width)
    more = 1e3 * float(np.median(beside[rows]))
    return st.finding(more, f"{more:.0f} mm more than its uplifts say: the gauge is 30 mm outside")


def displacement_at_the_crossings() -> st.Finding:
    measured = _measured()
    rows = ~measured.at_peak & legible()
    mean = 1e3 * float(np.mean(np.abs(measured.displacement[rows])))
    return st.finding(mean, f"there the wall is {mean:.1f} mm from the gauge's zero on average")


# --- 4.7 energy


def onset_of_dissipation() -> st.Finding:
    measured = _measured()
    lost = [
        100 * (1 - (measured.velocity[row + 1] / speed[-1]) ** 2)
        for row, (_, speed) in zip(figures.peaks()[:5], figures.paths_without_losses(), strict=True)
    ]
    return st.unknown(
        f"at the crossings of the first five half cycles {min(lost):.0f} to {max(lost):.0f} % of "
        "the kinetic energy without losses are missing",
    )


def loss_within_four_millimetres() -> st.Finding:
    n = WALL.rotation_centre.epsilon
    within = 100 * float(erf(4e-3 / n))
    return st.finding(
        within, f"4-28 with n = {1e3 * n:.2f} mm has {within:.0f} % of its loss there"
    )


def share_of_the_tendon() -> st.Finding:
    energies = _measured().energies(WALL)
    share = 100 * float(energies.elastic[0] / energies.total[0])
    return st.finding(share, f"{share:.1f} %")


def energy_at_the_crossings() -> st.Finding:
    total = _measured().energies(WALL).total[:13]
    rises = int(np.sum(total[1::2] > total[:-1:2]))
    most = 100 * float((total[1::2] / total[:-1:2]).max() - 1)
    return st.finding(rises, f"at {rises} of the 6, by up to {most:.0f} %")


def energies_of_figure_4_29() -> st.Finding:
    energies = _measured().energies(WALL).total[figures.peaks()]
    off = np.abs(energies - FIGURE_4_29.numbers("total energy")).max()
    return st.finding(energies, f"off by {off:.1f} J at most")


def scatter_of_restitution() -> st.Finding:
    lost = figures.losses()
    large = lost.chosen & (np.abs(lost.peak) > 7e-3)
    spread = [
        float(np.std(lost.energy_ratio[rows], ddof=1)) for rows in (large, lost.chosen & ~large)
    ]
    return st.finding(spread[0], f"{spread[0]:.3f}; {spread[1]:.3f} from smaller ones")


def mean_restitution() -> st.Finding:
    r = figures.losses().energy_ratio[: PEAKS - 1]
    low, high = identification.fit(lambda mean: np.full(len(r), mean), r, {"mean": 0.85}).interval(
        "mean"
    )
    return st.ranging(
        [low, high],
        f"{r.mean():.3f}, {low:.3f} to {high:.3f} with 95 % confidence; {figures.HOUSNER:.3f} by "
        "2-6",
    )


def restitution_against_the_speed() -> st.Finding:
    r, speed = (x[: PEAKS - 1] for x in figures.losses()[:2])
    line = identification.fit(lambda r, slope: r + slope * speed, r, {"r": 0.85, "slope": 0.0})
    low, high = line.interval("slope")
    return st.finding(
        abs(low + high) / (high - low), f"slope {low:+.2f} to {high:+.2f} s/m with 95 % confidence"
    )


def crossings_within_the_boundary() -> st.Finding:
    measured = _measured()
    rows = ~measured.at_peak & legible()
    size, speed = np.abs(measured.displacement[rows]), np.abs(measured.velocity[rows])
    limit = WALL.dissipation_limit(np.linspace(5e-4, 0.0325, 400))
    inside = size < np.interp(speed, limit.speed, limit.displacement)
    outside = 100 * float(1 - inside.mean())
    return st.finding(outside, f"{inside.sum()} of {len(inside)} measured crossings lie inside it")


def speeds_of_the_trajectories() -> st.Finding:
    measured, rows = _measured(), figures.peaks()[:5]
    own = [float(speed[-1]) for _, speed in figures.paths_without_losses()]
    ratio = np.abs(measured.velocity[rows + 1]) / own
    return st.finding(ratio, f"upright it has {ratio.min():.2f} to {ratio.max():.2f} of its speed")


_SAMPLE = 0.005
"""Time between samples of the test, of which the time of a peak is one [s]; section 4.5.1."""


def times_of_the_trajectories() -> st.Finding:
    """By 4-24, from each of the first five peaks to the displacement of the crossing after it."""
    measured, ratios = _measured(), []
    for row in figures.peaks()[:5]:
        start, end = np.abs(measured.displacement[row : row + 2])
        s = np.linspace(0.0, math.sqrt(1 - end / start), 2001)[1:]  # Delta = start (1 - s**2)
        pace = 2 * start * s / np.abs(WALL.phase_trajectory(start, start * (1 - s**2)))
        own = float(trapezoid(pace, s) + pace[0] * s[0])
        quarter = float(measured.time[row + 1] - measured.time[row])
        ratios.append([own / (quarter + _SAMPLE / 2), own / (quarter - _SAMPLE / 2)])
    low, high = np.min(ratios, axis=0)[0], np.max(ratios, axis=0)[1]
    return st.ranging(
        np.transpose(ratios),
        f"{low:.2f} to {high:.2f} of the measured times, each peak being known to a sample",
    )


# --- 4.8.1 the restoring force


def restoring_force_at_the_peaks() -> st.Finding:
    measured = _measured()
    rows = measured.at_peak & legible()
    force = -WALL.mass * measured.acceleration[rows]
    ratio = np.asarray(WALL.restoring_force(measured.displacement[rows]) / force)
    return st.finding(
        [ratio.min(), ratio.max()],
        f"F_k is {ratio.min():.2f} to {ratio.max():.2f} of -M a at the legible peaks of Table A-1",
    )
