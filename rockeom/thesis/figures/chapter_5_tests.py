"""The figures of section 5.2, the release tests of the steel column; see `rockeom.thesis.figures`.

Printed are the peaks and zeros of Figures 5-6 and 5-10. The traces of displacement, uplift and
acceleration between them are lost; where a line is drawn it says what it is.
"""

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.figures.chapter_3 import mark_quarters
from rockeom.thesis.free_vibration_table import let_go
from rockeom.thesis.printed import COLUMN as COLUMN_VALUES, FIGURE_5_6, FIGURE_5_10, GAUGE

RIGID = rk.LumpedMassStructure(**COLUMN_VALUES)
FLEXIBLE = rk.FlexibleStructure(**COLUMN_VALUES, stiffness=571.8e3, damping=502.4)
ALPHA = float(np.arctan2(RIGID.half_width, RIGID.height))
"""alpha_e of Figure 5-8 [rad]."""
MEASURED_AT = dict(zip(("half_width", "height"), GAUGE, strict=True))


@cache
def points(run: int) -> tuple[np.ndarray, np.ndarray]:
    """(n,) times [s] and displacements [m] of a run: peaks and zeros in turn."""
    table = {1: FIGURE_5_6, 2: FIGURE_5_10}[run]
    rows = np.array(table.rows, dtype=float)
    return rows[:, 0], rows[:, 1] / dr.MM


def smooth_trace(run: int, n: int = 1200) -> tuple[np.ndarray, np.ndarray]:
    """(t, displacement) of a curve through the printed points that is level at the peaks."""
    from scipy.interpolate import PchipInterpolator

    time, displacement = points(run)
    t = np.linspace(time[0], time[-1], n)
    return t, PchipInterpolator(time, displacement)(t)


def draw_points(ax: Axes, run: int) -> None:
    """The printed points of a run, and the curve through them."""
    t, trace = smooth_trace(run)
    time, displacement = points(run)
    ax.plot(t, trace * dr.MM, "--", lw=0.8, label="curve through the points")
    ax.plot(time, displacement * dr.MM, "o", ms=4, zorder=5, label="printed", **dr.OPEN)
    ax.set(xlabel=dr.TIME, ylabel=dr.DELTA)
    style.legend_above(ax)


@cache
def impacts() -> identification.Impacts:
    """Impacts of run 1: r by 5-4 from the printed peaks, good to the last printed digit."""
    time, displacement = points(1)
    rotation = identification.rotation_from_displacement(displacement[::2], **MEASURED_AT)
    rounding = 0.01e-3 / np.sqrt(12) / MEASURED_AT["height"]
    return identification.Impacts.of_peaks(time[::2], rotation, RIGID, deviation=rounding)


# --- run 1: steel feet


@dr.thesis_axes(dr.Source.PRINTED, 7.2, 3.2)
def figure_5_6(ax: Axes) -> None:
    """Displacement of the column in run 1, released on steel feet: the sixteen printed points.

    Dashed: a curve through them that is level at the peaks, no measurement. The uplifts of the
    thesis's figure are not printed. Above each impact is its r, by 5-4 of the peaks on both sides.
    """
    draw_points(ax, 1)
    rocking = impacts()
    for i, (time, r) in enumerate(zip(rocking.time, rocking.energy_ratio, strict=True)):
        text = f"$r$ = {r:.3f}" if i == 0 else f"{r:.3f}"
        ax.annotate(text, (time, 31), ha="center", fontsize=7.5, color=style.INK)
        ax.axvline(time, 0.0, 0.93, color="0.85", lw=0.6, zorder=0)
    ax.set_ylim(-30, 36)


def draw_quarters(run: int, peaks: np.ndarray, label: str) -> Figure:
    """Quarter periods that begin or end at a printed peak, and those of the rigid column.

    peaks : (n,) rotations of the points, zero at the crossings.
    """
    time, _ = points(run)
    quarters = np.diff(time)
    size = np.abs(np.where(peaks[:-1] != 0, peaks[:-1], peaks[1:]))
    own = np.linspace(1e-4, 0.12 * ALPHA, 60)
    total = RIGID.mass + RIGID.base_mass
    centroid = (RIGID.mass * RIGID.height + RIGID.base_mass * RIGID.base_height) / total
    alpha = float(np.arctan2(RIGID.half_width, centroid))
    p = np.sqrt(-RIGID.accelerations({"theta": alpha / 2})["theta"] / np.sin(alpha / 2))
    figure, ax = style.new_axes(6.2, 3.6)
    ax.plot(own / ALPHA, formulas.exact_quarter_period(own, alpha, p), label=label)
    mark_quarters(ax, size / ALPHA, quarters, "printed points")
    ax.set(xlabel=r"peak rotation $|\theta_0|/\alpha_e$ [-]", xlim=(0, 0.12), ylim=(0, None))
    ax.set_ylabel("quarter period [s]")
    ax.legend(loc="upper left")
    return figure


@dr.thesis_figure(dr.Source.PRINTED)
def figure_5_7() -> Figure:
    """Quarter periods of run 1 against the peak rotation, and those of the rigid column.

    The rotations are those of 5-2. The line is the exact time from rest to upright of the rigid
    column with the masses of this project's set; the text gives none. The first quarter holds the
    delay of the release.
    """
    _, displacement = points(1)
    rotation = identification.rotation_from_displacement(displacement, **MEASURED_AT)
    return draw_quarters(1, rotation, "rigid column")


@dr.thesis_axes(dr.Source.PRINTED, 6.0, 3.4)
def figure_5_9(ax: Axes) -> None:
    """r of run 1 against the peak rotation before the impact, by 5-4 from the printed peaks.

    The figure of the thesis has the whole record, which continues to smaller rotations. Bars: what
    the last printed digit of the peaks leaves open.
    """
    rocking = impacts()
    r, peak = rocking.energy_ratio, np.abs(rocking.peak_before) / ALPHA
    ax.errorbar(peak, r, rocking.half_width, fmt="none", ecolor=style.INK, capsize=2, lw=0.8)
    dr.draw_feet(ax, rocking.foot == "left", peak, r, ms=5)
    ax.axhline(0.74, ls="--", **dr.THIN)
    ax.annotate("5-14: 0.74", (0.118, 0.74), (0, 3), textcoords="offset points", ha="right")
    before = r"peak rotation before the impact $|\theta|/\alpha_e$ [-]"
    ax.set(xlabel=before, ylabel="r [-]", xlim=(0, 0.12), ylim=(0.7, 1.0))
    ax.legend(loc="upper right")


# --- run 2: soft rubber


@dr.thesis_axes(dr.Source.PRINTED, 7.2, 3.2)
def figure_5_10(ax: Axes) -> None:
    """Displacement of the column in run 2, released on soft rubber: the sixteen printed points.

    Dashed: a curve through them that is level at the peaks, no measurement. The uplifts of the
    thesis's figure are not printed.
    """
    draw_points(ax, 2)


@dr.thesis_axes(dr.Source.IN_KIND, 7.2, 3.2)
def figure_5_12(ax: Axes) -> None:
    """Place of the rotation centre in run 2 in time, by 5-5 of the displacement.

    The uplifts from which the thesis found it are not printed. Here it is 5-5 of the curve through
    the printed points of Figure 5-10, without the difference by direction that the text saw.
    """
    t, trace = smooth_trace(2)
    centre = identification.rotation_centre(trace)
    ax.plot(t, centre * dr.MM, label="5-5 of the curve through the points")
    mark_edges(ax, 1.8)
    ax.set_xlabel(dr.TIME)
    style.legend_above(ax)


def mark_edges(ax: Axes, right: float) -> None:
    """Dashed lines at both edges of the base, named at the right end."""
    for edge, name, offset in ((0, "left edge", 3), (600, "right edge", -10)):
        ax.axhline(edge, ls="--", **dr.THIN)
        at = (right, edge)
        ax.annotate(name, at, (0, offset), textcoords="offset points", ha="right", fontsize=8)
    ax.set(ylabel="from the left edge $x$ [mm]", ylim=(-20, 620))


@dr.thesis_axes(dr.Source.COMPUTED, 5.6, 3.4)
def figure_5_13(ax: Axes) -> None:
    """Place of the rotation centre against the displacement in run 2: 5-5.

    The measured values, by direction of motion, are not printed.
    """
    d = np.linspace(-0.03, 0.03, 301)
    ax.plot(d * dr.MM, identification.rotation_centre(d) * dr.MM, label="5-5")
    mark_edges(ax, 29.5)
    ax.set(xlabel=dr.DELTA, xlim=(-30, 30))
    ax.legend(loc="upper left", bbox_to_anchor=(0.0, 0.9))


@dr.thesis_figure(dr.Source.PRINTED)
def figure_5_14() -> Figure:
    """Quarter periods of run 2 against the peak rotation, and those of the column on steel feet.

    Rotations by 5-6, about the centre of 5-5. The line is the rigid column that turns about its
    feet, as in Figure 5-7: the soft layer hardly changes the quarters. The first one holds the
    delay of the release.
    """
    _, displacement = points(2)
    rotation = identification.rotation_about_moving_centre(
        displacement, identification.rotation_centre(displacement), MEASURED_AT["height"]
    )
    return draw_quarters(2, rotation, "rigid column on its feet")


def frequencies(mode: str) -> list[float]:
    """Frequencies of vibration of the flexible column in a mode [Hz], if they are real.

    Those of its equations linearised about upright, without damping.
    """
    free = ("theta", "u") if mode != "both" else ("u",)
    still = rk.FlexibleStructure(**COLUMN_VALUES, stiffness=571.8e3, damping=0.0)
    start, h = {"theta": 1e-6 if mode != "both" else 0.0}, 1e-7
    rows = []
    for name in free:
        above, below = (
            still.accelerations({**start, name: start.get(name, 0.0) + s * h}, mode=mode)
            for s in (1, -1)
        )
        rows.append([(above[n] - below[n]) / (2 * h) for n in free])
    squares = -np.linalg.eigvals(np.transpose(rows)).real
    return sorted(float(np.sqrt(s) / (2 * np.pi)) for s in squares if s > 0)


@dr.thesis_axes(dr.Source.IN_KIND, 7.2, 4.6, 2)
def figure_5_15(trace: Axes, spectrum: Axes) -> None:
    """Horizontal acceleration of the column's mass after a release, and its spectrum; in kind.

    The measured trace, on rubber, is not printed. Here the flexible column is released on steel
    feet from 28 mm, with impulsive impacts, and sampled a thousand times a second. Spectra of the
    rocking alone and of what follows it; dashed are the modes of the model, in full contact and on
    one foot.
    """
    start = float(identification.rotation_from_displacement(0.02858, **MEASURED_AT))
    run = let_go(FLEXIBLE, 2.5, rk.Impulsive(), theta=start)
    t = np.arange(2500) / 1000
    x = run.at(t, names=["displacement"])["displacement"]
    record = analysis.MeasuredRecord(t, {"x": x}, {"x": 0.0}).with_derivatives("x", 0.008)
    trace.plot(t, record["x_ddot"], lw=0.7, color=style.LINES[0])
    trace.set(xlabel=dr.TIME, ylabel=r"acceleration [m/s$^2$]")
    rest = run.events.rest_time or 1.2
    for part, span, color, label in (
        (record.between(0.0, rest), rest, style.LINES[0], "while it rocks"),
        (record.between(rest, 2.5), 2.5 - rest, style.LINES[1], "in full contact"),
    ):
        windows = identification.moving_window(
            part, "x_ddot", window=0.95 * span, frequencies=(0.0, 80.0)
        )
        spectrum.plot(windows.frequency, windows.amplitude[0], color=color, label=label)
    both, foot = frequencies("both")[0], frequencies("right")[-1]
    for mode, name, line in (
        (both, f"{both:.1f} Hz", "--"),
        (foot, f"{foot:.1f} Hz", "--"),
        (56, "56 Hz, measured", ":"),
    ):
        spectrum.axvline(mode, ls=line, **dr.THIN)
        spectrum.annotate(name, (mode, 1.07), (3, 0), textcoords="offset points", fontsize=8)
    spectrum.set(ylim=(0, 1.18), xlim=(0, 80), xlabel="frequency [Hz]")
    spectrum.set_ylabel("amplitude over its largest [-]")
    spectrum.legend(loc="center right")


@dr.thesis_axes(dr.Source.PRINTED, 5.6, 3.4)
def figure_5_16(ax: Axes) -> None:
    """Damping ratio of each cycle of run 2 against its peak, by 5-7.

    A cycle goes from a printed peak to the next but one, on the same side. The record of the
    thesis continues to smaller peaks.
    """
    _, displacement = points(2)
    peaks = displacement[::2]
    ratio = formulas.damping_from_decrement(peaks[:-2], peaks[2:])
    dr.draw_sides(ax, peaks[:-2], ratio)
    ax.axhline(0.104, ls="--", **dr.THIN)
    ax.annotate("0.104, all of the record", (29.5, 0.104), (0, 3), textcoords="offset points",
                ha="right", fontsize=8)  # fmt: skip
    ax.set(xlabel=r"peak displacement $|\Delta|$ [mm]", xlim=(0, 30), ylim=(0, 0.12))
    ax.set_ylabel(r"damping ratio $\xi$ [-]")
    ax.legend(loc="lower left")
