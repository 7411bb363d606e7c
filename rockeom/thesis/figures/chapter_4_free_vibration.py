"""Table A-1 on the free vibration of the wall of chapter 4, sections 4.5 and 4.7.

Only that table of the continuous record is printed: its peaks and the instants without
acceleration between them. They are drawn as points: no curve between them is printed. Rows of which
a number had to be guessed are left out.
"""

from functools import cache
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures.chapter_4_wall import (
    GAUGE,
    draw_measured,
    draw_sides,
    legible,
    quarters,
)
from rockeom.thesis.figures.drawn import MM, Source, thesis_axes, thesis_figure, thesis_panels
from rockeom.thesis.free_vibration_table import PEAKS, WALL
from rockeom.thesis.printed import FIGURE_4_29
from rockeom.thesis.wall_tests import quarter_period_fit

HOUSNER = float(
    formulas.energy_ratio_of_block(
        np.arctan2(WALL.half_width, WALL.centroid_height),
        inertia=WALL.corner_inertia - WALL.mass * WALL.corner_radius**2,
        mass=WALL.mass,
        radius=WALL.corner_radius,
    )
)
"""r of 2-6 for the wall about its corner."""
MEASURED: dict[str, Any] = {
    "color": style.INK,
    "ls": "",
    "marker": "o",
    "mfc": "white",
    "mew": 0.8,
    "zorder": 5,
}


def peaks() -> np.ndarray:
    """Rows of the first thirteen peaks of Table A-1, those of Figure 4-29."""
    return np.flatnonzero(identification.FreeVibration.table_a1().at_peak)[:PEAKS]


# --- 4.5 the record


@thesis_panels(Source.PRINTED, 7.2, 6.0)
def figure_4_11(figure: Figure) -> None:
    """Corrected response of the wall in run 5: displacement, uplifts and rotation centre.

    Drawn are the rows of Table A-1, whose uplifts are corrected already: its last column is the
    distance of the centre from the gauge that they give (4-1, with the 30 mm). Hollow are the
    uplifts as the gauges read them, by 4-3 and 4-4 backwards. The table that shook the wall stands
    still in this test; the record of its motion is not printed.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    top, uplifts, centre = figure.subplots(3, 1, sharex=True)
    top.plot(measured.time[chosen], measured.displacement[chosen] * MM, ms=3.2, **MEASURED)
    top.set_ylabel(r"displacement $\Delta$ [mm]")
    x = np.asarray(measured.centre_from_edge)
    peak = measured.at_peak & chosen
    left, right = np.asarray(measured.left_uplift), np.asarray(measured.right_uplift)
    width = 2 * (WALL.half_width + GAUGE)
    # the centre lies x from the gauge of the pressed edge
    pressed = left < right
    of_left = np.where(pressed, x, width - x)
    for name, uplift, reach, mark in (
        ("left", left, of_left, "o"),
        ("right", right, width - of_left, "s"),
    ):
        color = style.FEET[name]
        read = uplift * reach / (reach - GAUGE)
        label = f"{name} edge"
        uplifts.plot(measured.time[peak], uplift[peak] * MM, mark, color=color, ms=3, label=label)
        uplifts.plot(
            measured.time[peak], read[peak] * MM, mark, color=color, ms=4.4, mfc="none", mew=0.7,
            label=f"{name} gauge",
        )  # fmt: skip
    uplifts.set_ylabel("uplift $u'$ [mm]")
    style.legend_above(uplifts)
    centre.plot(measured.time[peak], x[peak] * MM, "o", color=style.LINES[2], ms=3.5)
    centre.axhline((WALL.half_width + GAUGE) * MM, color=style.INK, lw=0.6, ls=":")
    centre.annotate("centreline", (0.02, (WALL.half_width + GAUGE) * MM - 45), fontsize=7.5)
    centre.set(ylabel="centre from\nthe gauge [mm]", ylim=(0, 620), xlabel="time [s]")
    figure.align_ylabels((top, uplifts, centre))


@thesis_axes(Source.PRINTED, 7.2, 3.2)
def figure_4_12(ax: Axes) -> None:
    """Free vibration of the wall, its peaks and crossings marked: Table A-1.

    A crossing is where the acceleration vanishes; the displacement there is up to 3 mm, since the
    wall slid. Crosses are rows of which a number had to be guessed.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    ax.axhline(0.0, color=style.INK, lw=0.6)
    draw_marked(ax, measured.time, measured.displacement * MM, measured.at_peak, chosen)
    ax.set(xlabel="time [s]", ylabel=r"displacement $\Delta$ [mm]")
    ax.legend()


def draw_marked(
    ax: Axes, x: np.ndarray, y: np.ndarray, at_peak: np.ndarray, chosen: np.ndarray
) -> None:
    """Peaks filled, crossings open, guessed rows crossed."""
    for rows, mark, face, label in (
        (at_peak & chosen, "o", style.INK, "peaks"),
        (~at_peak & chosen, "o", "white", "zero crossings"),
        (~chosen, "x", style.INK, "guessed"),
    ):
        ax.plot(x[rows], y[rows], mark, color=style.INK, mfc=face, ms=4, mew=0.8, label=label)


@cache
def fitted_quarters() -> identification.Fit:
    """k [s/m**0.5] and c [s] of quarter periods k sqrt(displacement) + c."""
    peak, time = quarters()
    root = np.sqrt(np.abs(peak))
    return identification.fit(lambda k, c: k * root + c, time, {"k": 0.3, "c": 0.01})


@thesis_axes(Source.COMPUTED, 6.0, 3.6)
def figure_4_13(ax: Axes) -> None:
    """Quarter periods against the peak they begin at: Table A-1 and the fit 4-5.

    4-5 has three numbers, of which these data tell only two: what counts of the first two is the
    factor of the root of the displacement, 0.505 s sqrt(2/5155 mm). Dashed is that form fitted
    again, by least squares to the 19 quarters whose rows are legible, with the 95 % band of the
    curve.
    """
    peak, time = quarters()
    fit = fitted_quarters()
    d = np.linspace(1e-4, 0.032, 200)
    slopes = np.column_stack([np.sqrt(d), np.ones_like(d)])
    fitted = slopes @ np.array(list(fit.values.values()))
    spread = np.sqrt(np.einsum("ni,ij,nj->n", slopes, fit.covariance, slopes))
    reach = (fit.interval("c")[1] - fit.values["c"]) / fit.standard_error["c"]

    band: dict[str, Any] = {"color": style.LINES[1], "alpha": 0.15, "lw": 0}
    ax.fill_between(d * MM, fitted - reach * spread, fitted + reach * spread, **band)
    ax.plot(d * MM, quarter_period_fit(d), color=style.LINES[0], label="4-5")
    ax.plot(d * MM, fitted, "--", color=style.LINES[1], label="fitted again, 95 % band")
    draw_sides(ax, peak, time)
    ax.set(
        xlabel=r"peak displacement $|\Delta_0|$ [mm]",
        ylabel="quarter period [s]",
        xlim=(0, 33),
        ylim=(0, 0.08),
    )
    ax.legend(loc="lower right")


def draw_uplifts_and_force(close: bool) -> Figure:
    """Uplifts of both edges, and the tendon's force, against the displacement.

    close : about upright, the rows by themselves; else all, one after the other connected.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    figure = style.new_figure(7.6, 3.4)
    left, right = figure.subplots(1, 2)
    far = 0.0063 if close else 0.034
    rows = chosen & (np.abs(measured.displacement) < far)
    d = measured.displacement[rows] * MM
    joined = "" if close else "-"
    for name, mark in (("left", "o"), ("right", "s")):
        uplift = np.asarray(getattr(measured, f"{name}_uplift"))[rows] * MM
        left.plot(
            d, uplift, ls=joined, lw=0.5, marker=mark, ms=3.5, mfc="white", mew=0.9,
            color=style.FEET[name], label=f"{name} edge",
        )  # fmt: skip
    right.plot(d, np.asarray(measured.tendon_force)[rows] / 1e3, ls=joined, lw=0.5, color="0.6")
    draw_measured(right, "tendon_force", 1e3)
    if close:
        right.set_ylim(74.5, 86)
    for ax in (left, right):
        ax.set(xlim=(-far * MM, far * MM), xlabel=r"displacement $\Delta$ [mm]")
    left.axhline(0.0, color=style.INK, lw=0.6)
    left.set_ylabel("uplift $u'$ [mm]")
    right.set_ylabel("tendon force $P$ [kN]")
    left.legend(loc="upper center")
    right.legend(loc="upper center")
    return figure


@thesis_figure(Source.PRINTED)
def figure_4_14() -> Figure:
    """Uplifts of the edges, and the force of the tendon, against the displacement: Table A-1.

    One row after the other is connected, as the samples were in the thesis, which rounds the force
    off about upright in the same way.
    """
    return draw_uplifts_and_force(close=False)


@thesis_figure(Source.PRINTED)
def figure_4_15() -> Figure:
    """The same about upright, the rows by themselves: Table A-1.

    Without the rows that had to be guessed seven peaks are this small.
    """
    return draw_uplifts_and_force(close=True)


def inertia_over_radius() -> tuple[np.ndarray, np.ndarray]:
    """Distances of the rotation centre from the centreline [m], and I_o/R about it [kg m]."""
    b = np.linspace(0.0, WALL.half_width, 201)
    return b, WALL.moment_of_inertia(WALL.half_width + b) / np.hypot(b, WALL.centroid_height)


@thesis_axes(Source.COMPUTED, 5.0, 3.2)
def figure_4_22b(ax: Axes) -> None:
    """I_o/R against the place of the rotation centre, from the centreline to the edge.

    I_o is B-9 with the added masses where they are, (d - B)^2; R from the centre to the centroid.
    """
    b, ratio = inertia_over_radius()
    ax.plot(b * MM, ratio, color=style.LINES[0])
    ax.axhline(ratio[-1], color=style.INK, lw=0.6, ls=":")
    ax.set(
        xlabel="rotation centre from the centreline $b$ [mm]",
        ylabel="$I_o/R$ [kg m]",
        ylim=(0.95 * ratio.min(), 1.05 * ratio.max()),
    )


# --- 4.7 energy


def draw_speeds(ax: Axes) -> None:
    """Speed against displacement at the rows of Table A-1."""
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    draw_marked(ax, measured.displacement * MM, np.abs(measured.velocity), measured.at_peak, chosen)
    ax.set(
        xlabel=r"displacement $\Delta$ [mm]", ylabel=r"speed $|\dot\Delta|$ [m/s]", ylim=(0, None)
    )


@thesis_axes(Source.PRINTED, 5.4, 4.0)
def figure_4_25(ax: Axes) -> None:
    """Free vibration of the wall in the phase plane: Table A-1.

    Dotted are motions without losses from the first five peaks to upright, 4-23. That the record
    has no steps of speed, as the thesis says, its peaks and crossings cannot show.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    ax.axhline(0.0, color=style.INK, lw=0.6)
    ax.axvline(0.0, color=style.INK, lw=0.6)
    draw_marked(ax, measured.displacement * MM, measured.velocity, measured.at_peak, chosen)
    ax.set(xlabel=r"displacement $\Delta$ [mm]", ylabel=r"velocity $\dot\Delta$ [m/s]")
    for n, (d, speed) in enumerate(paths_without_losses()):
        label = "without losses, 4-23" if n == 0 else None
        ax.plot(d * MM, -np.sign(d[0]) * speed, ":", color=style.LINES[1], lw=0.9, label=label)
    ax.legend(loc="upper right", fontsize=7.5)


def paths_without_losses() -> list[tuple[np.ndarray, np.ndarray]]:
    """Displacements [m] and speeds [m/s] by 4-23, from each of the first five peaks to upright."""
    measured = identification.FreeVibration.table_a1()
    paths = []
    for row in peaks()[:5]:
        start = measured.displacement[row]
        d = start * np.linspace(1.0, 0.0, 300) ** 2
        paths.append((d, np.abs(WALL.phase_trajectory(start, d))))
    return paths


@thesis_axes(Source.PRINTED, 6.4, 3.8)
def figure_4_26(ax: Axes) -> None:
    """Speed against displacement, whichever way the wall moves: Table A-1.

    Dotted is the motion without losses from each of the first five peaks to upright, 4-23, above
    which no point can lie.
    """
    draw_speeds(ax)
    for n, (d, speed) in enumerate(paths_without_losses()):
        label = "without losses, 4-23" if n == 0 else None
        ax.plot(d * MM, speed, ":", color=style.LINES[1], lw=0.9, label=label)
    ax.set_ylim(0, 0.9)
    style.legend_above(ax)


def draw_boundary(ax: Axes) -> None:
    """4-25 and 4-26: a quarter of the peak, and the speed without losses there."""
    peak = np.linspace(1e-3, 0.0325, 60)
    limit = WALL.dissipation_limit(peak)
    label = "a quarter of the peak, 4-25, 4-26"
    for side in (-1, 1):
        ax.plot(
            side * limit.displacement * MM, limit.speed, "--", color=style.LINES[1],
            label=label if side > 0 else None,
        )  # fmt: skip
    ax.fill_betweenx(
        limit.speed, -limit.displacement * MM, limit.displacement * MM,
        color=style.LINES[1], alpha=0.12, lw=0,
    )  # fmt: skip


@thesis_axes(Source.COMPUTED, 6.4, 3.8)
def figure_4_27(ax: Axes) -> None:
    """Where the wall loses energy, by displacement and speed: 4-25, 4-26 and Table A-1.

    The boundary of the thesis is drawn by eye into the record, which is not printed. Here it is a
    quarter of each peak with the speed that the wall has there without losses; both equations are
    missing from the text and follow its words. Dotted are the 4 mm of the text.
    """
    draw_boundary(ax)
    draw_speeds(ax)
    for side in (-4, 4):
        ax.axvline(side, color=style.LINES[2], lw=0.9, ls=":", label="4 mm" if side > 0 else None)
    style.legend_above(ax)


@thesis_axes(Source.COMPUTED, 6.6, 3.6)
def figure_4_28(ax: Axes) -> None:
    """Energies of the wall in the first three cycles: 4-18 to 4-20 at the rows of Table A-1.

    The elastic energy is that of the measured force of the tendon, as in Figure 4-29. Lines connect
    the rows.
    """
    measured = identification.FreeVibration.table_a1()
    energies = measured.energies(WALL)
    n = 13
    for values, label, color in (
        (energies.total, "total", style.INK),
        (energies.elastic, "tendon $U_E$", style.LINES[0]),
        (energies.kinetic, "motion $E_k$", style.LINES[1]),
        (energies.gravity, "gravity $U$", style.LINES[2]),
    ):
        ax.plot(measured.time[:n], values[:n], "o-", ms=3.5, lw=0.9, color=color, label=label)
    ax.set(xlabel="time [s]", ylabel="energy [J]", ylim=(0, 700))
    ax.legend(loc="upper right", ncols=4)


@thesis_panels(Source.COMPUTED, 7.0, 4.4)
def figure_4_29(figure: Figure) -> None:
    """Displacement and total energy in the free vibration: 4-18 to 4-20 and Table A-1.

    Filled are the energies at the peaks, crosses those of the table in the thesis's figure.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    energies, rows = measured.energies(WALL).total, peaks()
    top, bottom = figure.subplots(2, 1, sharex=True)
    top.plot(measured.time[chosen], measured.displacement[chosen] * MM, ms=3.2, **MEASURED)
    top.set_ylabel(r"displacement $\Delta$ [mm]")
    bottom.plot(measured.time[chosen], energies[chosen], color="0.8", lw=0.8)
    bottom.plot(measured.time[rows], energies[rows], "o", color=style.LINES[0], ms=4, label="found")
    bottom.plot(
        measured.time[rows],
        FIGURE_4_29.numbers("total energy"),
        "x",
        color=style.LINES[1],
        ms=6,
        label="printed",
    )
    bottom.set(xlabel="time [s]", ylabel="total energy [J]", ylim=(0, None))
    bottom.legend()


class Losses(NamedTuple):
    """(n,) of each passage: r, speed [m/s], the peak before [m]; which of them are legible."""

    energy_ratio: np.ndarray
    speed: np.ndarray
    peak: np.ndarray
    chosen: np.ndarray


def losses() -> Losses:
    """Losses by Table A-1, by energies from the measured force of the tendon."""
    measured = identification.FreeVibration.table_a1()
    r, speed, peak = measured.restitution(WALL)
    rows = np.flatnonzero(measured.at_peak)
    clear = legible()
    return Losses(r, speed, peak, clear[rows[:-1]] & clear[rows[1:]])


def draw_ratios(low: float, high: float) -> Figure:
    """r of each passage against the peak before it and the speed in it, from low to high."""
    lost = losses()
    figure = style.new_figure(7.6, 3.4)
    left, right = figure.subplots(1, 2, sharey=True)
    for ax, x in ((left, np.abs(lost.peak) * MM), (right, lost.speed)):
        for side, mark, label in ((1, ">", "from the right"), (-1, "<", "from the left")):
            rows = (np.sign(lost.peak) == side) & lost.chosen
            ax.plot(
                x[rows], lost.energy_ratio[rows], mark, color=style.LINES[0], ms=5, mfc="white",
                label=f"wall comes {label}",
            )  # fmt: skip
        ax.axhline(HOUSNER, color=style.INK, lw=0.8, ls=":")
        ax.set_xlim(0, None)
    left.plot([], [], color=style.INK, lw=0.8, ls=":", label=f"2-6: {HOUSNER:.3f}")
    left.legend(loc="lower right", fontsize=7.5)
    left.set(ylim=(low, high), ylabel="energy ratio $r$ [-]", xlabel=r"peak before $|\Delta|$ [mm]")
    right.set_xlabel(r"speed at the crossing $|\dot\Delta|$ [m/s]")
    style.legend_above(right)
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_30() -> Figure:
    """Apparent restitution of each passage against the peak before it and its speed.

    r is the ratio of the total energies at successive peaks. Left out are passages next to a row
    that had to be guessed.
    """
    return draw_ratios(0.0, 1.25)


@thesis_figure(Source.COMPUTED)
def figure_4_31() -> Figure:
    """The same from r = 0.7 to 1."""
    return draw_ratios(0.7, 1.0)


@thesis_axes(Source.COMPUTED, 6.0, 3.6)
def figure_4_34(ax: Axes) -> None:
    """Where the wall begins to lose energy: 4-25 and 4-26 about the crossings of Table A-1.

    The boundary found by eye in Figure 4-27 is not printed; what can be said is whether the
    measured crossings, at which about half of the energy of a passage is lost, lie inside.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    rows = ~measured.at_peak & chosen
    draw_boundary(ax)
    size, speed = measured.displacement[rows], np.abs(measured.velocity[rows])
    ax.plot(size * MM, speed, "o", color=style.INK, mfc="white", ms=4, label="crossings, Table A-1")
    ax.set(
        xlabel=r"displacement $\Delta$ [mm]", ylabel=r"speed $|\dot\Delta|$ [m/s]", ylim=(0, 1.0)
    )
    ax.legend(loc="lower right", fontsize=7.5)
