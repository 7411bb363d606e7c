"""Table A-1 on the free vibration of the wall of chapter 4, sections 4.5 and 4.7.

Only that table of the continuous record is printed: its peaks and the instants without
acceleration between them. A line between two of them is the polynomial of degree five that has the
printed displacement, velocity and acceleration at both ends, with zero velocity at a peak;
it stands for no measurement. Rows of which a number had to be guessed are left out.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.special import erf

from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures.chapter_4_wall import (
    GAUGE,
    MM,
    draw_measured,
    legible,
)
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.free_vibration_table import PEAKS, WALL
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
ENERGIES_4_29 = (
    617.9, 541.9, 488.9, 415.6, 363.6, 320.3, 275.8, 246.6, 215.4, 172.4, 157.1, 113.5, 88.7,
)  # fmt: skip
"""Total energy at the first thirteen peaks, as the table in Figure 4-29 has it [J]."""

MEASURED: dict[str, Any] = {
    "color": style.INK,
    "ls": "",
    "marker": "o",
    "mfc": "white",
    "mew": 0.8,
    "zorder": 5,
}


class Trace(NamedTuple):
    """(n,) times [s], displacement [m] and velocity [m/s] between the rows of Table A-1."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray


@cache
def trace() -> Trace:
    """The polynomials between the legible rows, up to the first that is guessed."""
    from scipy.interpolate import BPoly

    measured = identification.FreeVibration.table_a1()
    last = int(np.argmin(legible()))
    velocity = np.where(measured.at_peak, 0.0, measured.velocity)
    rows = np.column_stack([measured.displacement, velocity, measured.acceleration])[:last]
    path = BPoly.from_derivatives(measured.time[:last], rows)
    time = np.linspace(0.0, measured.time[last - 1], 4001)
    return Trace(time, path(time), path.derivative()(time))


def peaks() -> np.ndarray:
    """Rows of the first thirteen peaks of Table A-1, those of Figure 4-29."""
    return np.flatnonzero(identification.FreeVibration.table_a1().at_peak)[:PEAKS]


# --- 4.5 the record


@thesis_figure(Source.PRINTED)
def figure_4_11() -> Drawn:
    """Corrected response of the wall in run 5: displacement, uplifts and rotation centre.

    Drawn are the rows of Table A-1, whose uplifts are corrected already: its last column is the
    distance of the centre from the gauge that they give (4-1, with the 30 mm). Hollow are the
    uplifts as the gauges read them, by 4-3 and 4-4 backwards. The table that shook the wall stands
    still in this test; the record of its motion is not printed.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    line = trace()
    figure = style.new_figure(7.2, 6.0)
    top, uplifts, centre = figure.subplots(3, 1, sharex=True)
    top.plot(line.time, line.displacement * MM, color="0.7", lw=0.8)
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
    centre.set_ylabel("centre from\nthe gauge [mm]")
    centre.set_ylim(0, 620)
    centre.set_xlabel("time [s]")
    figure.align_ylabels((top, uplifts, centre))

    rows = peaks()
    taken = GAUGE / x[rows]
    early, late = x[rows[:9]] * MM, x[peak][-3:] * MM
    return Drawn(
        figure,
        (
            Statement(
                "4.5.1", "the correction reduces the compression of the toe by up to 26 %",
                f"by {100 * taken.min():.0f} to {100 * taken.max():.0f} % at the first 13 peaks",
                bool(taken.max() < 0.265),
            ),
            Statement(
                "4.5.1", "the centre stays once rocking has begun, and moves to the middle at last",
                f"{early.min():.0f} to {early.max():.0f} mm at the first 9 peaks, "
                f"{late.min():.0f} to {late.max():.0f} mm at the last 3 that are legible",
                bool(np.ptp(early) < 50 and late.max() > 200),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.PRINTED)
def figure_4_12() -> Figure:
    """Free vibration of the wall, its peaks and crossings marked: Table A-1.

    A crossing is where the acceleration vanishes; the displacement there is up to 3 mm, since the
    wall slid. Crosses are rows of which a number had to be guessed.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    line = trace()
    figure = style.new_figure(7.2, 3.2)
    ax = figure.add_subplot()
    ax.axhline(0.0, color=style.INK, lw=0.6)
    ax.plot(line.time, line.displacement * MM, color=style.LINES[0], lw=0.9)
    draw_marked(ax, measured.time, measured.displacement * MM, measured.at_peak, chosen)
    ax.set_xlabel("time [s]")
    ax.set_ylabel(r"displacement $\Delta$ [mm]")
    ax.legend()
    return figure


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


@thesis_figure(Source.COMPUTED)
def figure_4_13() -> Drawn:
    """Quarter periods against the peak they begin at: Table A-1 and the fit 4-5.

    4-5 has three numbers, of which these data tell only two: what counts of the first two is the
    factor of the root of the displacement, 0.505 s sqrt(2/5155 mm). Dashed is that form fitted
    again, by least squares to the 19 quarters whose rows are legible, with the 95 % band of the
    curve.
    """
    measured = identification.FreeVibration.table_a1()
    starts = np.flatnonzero(measured.at_peak[:-1])
    starts = starts[legible()[starts] & legible()[starts + 1]]
    size, time = np.abs(measured.displacement[starts]), np.diff(measured.time)[starts]
    root = np.sqrt(size)
    fit = identification.fit(lambda k, c: k * root + c, time, {"k": 0.3, "c": 0.01})
    d = np.linspace(1e-4, 0.032, 200)
    slopes = np.column_stack([np.sqrt(d), np.ones_like(d)])
    fitted = slopes @ np.array(list(fit.values.values()))
    spread = np.sqrt(np.einsum("ni,ij,nj->n", slopes, fit.covariance, slopes))
    reach = (fit.interval("c")[1] - fit.values["c"]) / fit.standard_error["c"]

    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    band: dict[str, Any] = {"color": style.LINES[1], "alpha": 0.15, "lw": 0}
    ax.fill_between(d * MM, fitted - reach * spread, fitted + reach * spread, **band)
    ax.plot(d * MM, quarter_period_fit(d), color=style.LINES[0], label="4-5")
    ax.plot(d * MM, fitted, "--", color=style.LINES[1], label="fitted again, 95 % band")
    draw_sides(ax, measured.displacement[starts], time)
    ax.set_xlabel(r"peak displacement $|\Delta_0|$ [mm]")
    ax.set_ylabel("quarter period [s]")
    ax.set_xlim(0, 33)
    ax.set_ylim(0, 0.08)
    ax.legend(loc="lower right")
    r2 = identification.coefficient_of_determination(time, quarter_period_fit(size))
    printed = 0.505 * np.sqrt(2 / 5.155)
    low, high = fit.interval("k")
    slow, fast = 1 / (4 * time[0]), 1 / (4 * time[np.argmin(size)])
    last = 1 / (4 * measured.quarter_periods().time[-4:])
    drift = 100 * np.abs(measured.displacement[0]) / WALL.height
    return Drawn(
        figure,
        (
            Statement("4.5.1", "R2 = 0.976 of 4-5", f"R2 = {r2:.3f}", bool(abs(r2 - 0.976) < 2e-3)),
            Statement(
                "4.5.1", f"4-5: {printed:.3f} s/sqrt(m) and 0.010 s",
                f"k = {fit.values['k']:.3f} s/sqrt(m), {low:.3f} to {high:.3f}; "
                f"c = {fit.values['c'] * 1e3:.1f} ms, {fit.interval('c')[0] * 1e3:.1f} to "
                f"{fit.interval('c')[1] * 1e3:.1f}; R2 = {fit.r_squared:.3f}",
                bool(low < printed < high and fit.interval("c")[0] < 0.01),
            ),
            Statement(
                "4.5.1", "11 Hz in the smallest motions to 4 Hz at a drift of 1.2 %",
                f"{fast:.1f} Hz at the smallest legible peak to {slow:.1f} Hz at {drift:.2f} %; "
                f"{last.min():.1f} to {last.max():.1f} Hz where rows had to be guessed",
                None,
            ),
        ),
    )  # fmt: skip


def draw_sides(ax: Axes, peak: np.ndarray, y: np.ndarray) -> None:
    """Draw values at peaks [m], with one mark for peaks to the right and one for the left."""
    for side, mark, name in ((1, ">", "from peaks to the right"), (-1, "<", "to the left")):
        rows = np.sign(peak) == side
        ax.plot(
            np.abs(peak[rows]) * MM, y[rows], mark, color=style.INK, ms=4, mfc="white", mew=0.9,
            label=name,
        )  # fmt: skip


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
        ax.set_xlim(-far * MM, far * MM)
        ax.set_xlabel(r"displacement $\Delta$ [mm]")
    left.axhline(0.0, color=style.INK, lw=0.6)
    left.set_ylabel("uplift $u'$ [mm]")
    right.set_ylabel("tendon force $P$ [kN]")
    left.legend(loc="upper center")
    right.legend(loc="upper center")
    return figure


@thesis_figure(Source.PRINTED)
def figure_4_14() -> Drawn:
    """Uplifts of the edges, and the force of the tendon, against the displacement: Table A-1.

    One row after the other is connected, as the samples were in the thesis, which rounds the force
    off about upright in the same way.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    left, right = np.asarray(measured.left_uplift), np.asarray(measured.right_uplift)
    uplift = np.where(measured.displacement > 0, left, right)[chosen]
    size = np.abs(measured.displacement[chosen])
    line = identification.fit(lambda k, c: k * size + c, uplift, {"k": 0.4, "c": 1e-4})
    return Drawn(
        draw_uplifts_and_force(close=False),
        (
            Statement(
                "4.5.1", "the uplift is strongly correlated to the displacement",
                f"R2 = {line.r_squared:.3f} of a straight line, {line.values['k']:.3f} of the "
                f"displacement; about the far edge it were {2 * WALL.half_width / WALL.height:.3f}",
                bool(line.r_squared > 0.95),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.PRINTED)
def figure_4_15() -> Drawn:
    """The same about upright, the rows by themselves: Table A-1.

    Without the rows that had to be guessed seven peaks are this small.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    size, force = np.abs(measured.displacement[chosen]), np.asarray(measured.tendon_force)[chosen]
    slopes = []
    for rows in (size < 2e-3, (size > 2e-3) & (size < 8e-3)):
        x, y = size[rows], force[rows]
        slopes.append(identification.fit(lambda k, c, x=x: k * x + c, y, {"k": 1e6, "c": 75e3}))
    small, large = (f"{s.values['k'] / 1e6:.2f}" for s in slopes)
    bounds = ["{:.2f} to {:.2f}".format(*(x / 1e6 for x in s.interval("k"))) for s in slopes]
    return Drawn(
        draw_uplifts_and_force(close=True),
        (
            Statement(
                "4.5.1", "the force rises slowly, and steeply from some 2 mm on",
                f"{small} kN/mm below 2 mm ({bounds[0]}), {large} from 2 to 8 mm ({bounds[1]}); "
                "but the wall slid, so that the zero of the gauge is not upright",
                bool(slopes[1].interval("k")[0] > slopes[0].values["k"]),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_22b() -> Drawn:
    """I_o/R against the place of the rotation centre, from the centreline to the edge.

    I_o is B-9 with the added masses where they are, (d - B)^2; R from the centre to the centroid.
    """
    b = np.linspace(0.0, WALL.half_width, 201)
    ratio = WALL.moment_of_inertia(WALL.half_width + b) / np.hypot(b, WALL.centroid_height)
    off = 100 * (ratio / ratio[-1] - 1)
    figure = style.new_figure(5.0, 3.2)
    ax = figure.add_subplot()
    ax.plot(b * MM, ratio, color=style.LINES[0])
    ax.axhline(ratio[-1], color=style.INK, lw=0.6, ls=":")
    ax.set_xlabel("rotation centre from the centreline $b$ [mm]")
    ax.set_ylabel("$I_o/R$ [kg m]")
    ax.set_ylim(0.95 * ratio.min(), 1.05 * ratio.max())
    return Drawn(
        figure,
        (
            Statement(
                "4.7", "I_o/R deviates by less than 2 %",
                f"by up to {np.abs(off).max():.2f} % from that about the corner",
                bool(np.abs(off).max() < 2),
            ),
        ),
    )  # fmt: skip


# --- 4.7 energy


def draw_speeds(ax: Axes) -> None:
    """Speed against displacement: the trace, and the rows of Table A-1."""
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    line = trace()
    ax.plot(line.displacement * MM, np.abs(line.velocity), color=style.LINES[0], lw=0.6)
    draw_marked(ax, measured.displacement * MM, np.abs(measured.velocity), measured.at_peak, chosen)
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel(r"speed $|\dot\Delta|$ [m/s]")
    ax.set_ylim(0, None)


@thesis_figure(Source.PRINTED)
def figure_4_25() -> Figure:
    """Free vibration of the wall in the phase plane: Table A-1.

    The lines between the rows are smooth by their making; that the record has no steps of speed,
    as the thesis says, they cannot show.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    line = trace()
    figure = style.new_figure(5.4, 4.0)
    ax = figure.add_subplot()
    ax.axhline(0.0, color=style.INK, lw=0.6)
    ax.axvline(0.0, color=style.INK, lw=0.6)
    ax.plot(line.displacement * MM, line.velocity, color=style.LINES[0], lw=0.7)
    draw_marked(ax, measured.displacement * MM, measured.velocity, measured.at_peak, chosen)
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel(r"velocity $\dot\Delta$ [m/s]")
    ax.legend(loc="upper right", fontsize=7.5)
    return figure


@thesis_figure(Source.PRINTED)
def figure_4_26() -> Drawn:
    """Speed against displacement, whichever way the wall moves: Table A-1.

    Dotted is the way without losses to and from each of the first five peaks, 4-23.
    """
    figure = style.new_figure(6.4, 3.8)
    ax = figure.add_subplot()
    draw_speeds(ax)
    measured = identification.FreeVibration.table_a1()
    lost = []
    for n, row in enumerate(peaks()[:5]):
        d0 = measured.displacement[row]
        d = d0 * np.linspace(1.0, 0.0, 300) ** 2
        speed = np.abs(WALL.phase_trajectory(d0, d))
        label = "without losses, 4-23" if n == 0 else None
        ax.plot(d * MM, speed, ":", color=style.LINES[1], lw=0.9, label=label)
        lost.append(1 - (measured.velocity[row + 1] / speed[-1]) ** 2)
    ax.set_ylim(0, 0.9)
    style.legend_above(ax)
    return Drawn(
        figure,
        (
            Statement(
                "4.7", "the wall leaves its path at about a quarter of the peak",
                "the record between the rows is not printed; at the crossings of the first five "
                f"half cycles {100 * min(lost):.0f} to {100 * max(lost):.0f} % of the kinetic "
                "energy without losses are missing",
                None,
            ),
        ),
    )  # fmt: skip


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


@thesis_figure(Source.COMPUTED)
def figure_4_27() -> Drawn:
    """Where the wall loses energy, by displacement and speed: 4-25, 4-26 and Table A-1.

    The boundary of the thesis is drawn by eye into the record, which is not printed. Here it is a
    quarter of each peak with the speed that the wall has there without losses; both equations are
    missing from the text and follow its words. Dotted are the 4 mm of the text.
    """
    figure = style.new_figure(6.4, 3.8)
    ax = figure.add_subplot()
    draw_boundary(ax)
    draw_speeds(ax)
    for side in (-4, 4):
        ax.axvline(side, color=style.LINES[2], lw=0.9, ls=":", label="4 mm" if side > 0 else None)
    style.legend_above(ax)
    n = WALL.rotation_centre.epsilon
    return Drawn(
        figure,
        (
            Statement(
                "4.7", "small displacements, less than 4 mm say, lose energy at any speed",
                f"the damping force 4-28, with n = {n * MM:.2f} mm, has {100 * erf(4e-3 / n):.0f} "
                "% of its loss within 4 mm; of the record nothing can be said",
                None,
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_28() -> Drawn:
    """Energies of the wall in the first three cycles: 4-18 to 4-20 at the rows of Table A-1.

    The elastic energy is that of the measured force of the tendon, as in Figure 4-29. Lines connect
    the rows.
    """
    measured = identification.FreeVibration.table_a1()
    energies = measured.energies(WALL)
    n = 13
    figure = style.new_figure(6.6, 3.6)
    ax = figure.add_subplot()
    for values, label, color in (
        (energies.total, "total", style.INK),
        (energies.elastic, "tendon $U_E$", style.LINES[0]),
        (energies.kinetic, "motion $E_k$", style.LINES[1]),
        (energies.gravity, "gravity $U$", style.LINES[2]),
    ):
        ax.plot(measured.time[:n], values[:n], "o-", ms=3.5, lw=0.9, color=color, label=label)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("energy [J]")
    ax.set_ylim(0, 700)
    ax.legend(loc="upper right", ncols=4)
    share = 100 * energies.elastic[0] / energies.total[0]
    total = energies.total[:n]
    rises = int(np.sum(total[1::2] > total[:-1:2]))
    drop = 100 * (1 - total[1::2] / total[:-1:2])
    return Drawn(
        figure,
        (
            Statement(
                "4.7", "over 80 % of the energy is elastic energy of the tendon at first",
                f"{share:.1f} %", bool(share > 80),
            ),
            Statement(
                "4.7", "when upright the total erroneously increases",
                f"at {rises} of the 6 crossings it is above that of the peak before, by up to "
                f"{-drop.min():.0f} %",
                bool(rises >= 3),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_29() -> Drawn:
    """Displacement and total energy in the free vibration: 4-18 to 4-20 and Table A-1.

    Filled are the energies at the peaks, crosses those of the table in the thesis's figure.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    energies, rows = measured.energies(WALL).total, peaks()
    figure = style.new_figure(7.0, 4.4)
    top, bottom = figure.subplots(2, 1, sharex=True)
    line = trace()
    top.plot(line.time, line.displacement * MM, color="0.7", lw=0.8)
    top.plot(measured.time[chosen], measured.displacement[chosen] * MM, ms=3.2, **MEASURED)
    top.set_ylabel(r"displacement $\Delta$ [mm]")
    bottom.plot(measured.time[chosen], energies[chosen], color="0.8", lw=0.8)
    bottom.plot(measured.time[rows], energies[rows], "o", color=style.LINES[0], ms=4, label="found")
    bottom.plot(
        measured.time[rows], ENERGIES_4_29, "x", color=style.LINES[1], ms=6, label="printed"
    )
    bottom.set_xlabel("time [s]")
    bottom.set_ylabel("total energy [J]")
    bottom.set_ylim(0, None)
    bottom.legend()
    off = energies[rows] - ENERGIES_4_29
    return Drawn(
        figure,
        (
            Statement(
                "Figure 4-29", "617.9, 541.9, 488.9, ... 88.7 J at thirteen peaks",
                f"within {np.abs(off).max():.1f} J of all thirteen", bool(np.abs(off).max() < 1.5),
            ),
        ),
    )  # fmt: skip


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
    left.annotate(
        f"2-6: {HOUSNER:.3f}", (0.4, HOUSNER), (0, 3), textcoords="offset points", fontsize=7.5
    )
    left.set_ylim(low, high)
    left.set_ylabel("energy ratio $r$ [-]")
    left.set_xlabel(r"peak before $|\Delta|$ [mm]")
    right.set_xlabel(r"speed at the crossing $|\dot\Delta|$ [m/s]")
    style.legend_above(right)
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_30() -> Drawn:
    """Apparent restitution of each passage against the peak before it and its speed.

    r is the ratio of the total energies at successive peaks. Left out are passages next to a row
    that had to be guessed.
    """
    lost = losses()
    large = lost.chosen & (np.abs(lost.peak) > 7e-3)
    small = lost.chosen & ~large
    spread = [np.std(lost.energy_ratio[rows], ddof=1) for rows in (large, small)]
    return Drawn(
        draw_ratios(0.0, 1.25),
        (
            Statement(
                "4.7", "a constant r will do but for small vibrations, where errors are magnified",
                f"standard deviation {spread[0]:.3f} from peaks above 7 mm, {spread[1]:.3f} below",
                bool(spread[0] < 0.07 < spread[1]),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_31() -> Drawn:
    """The same from r = 0.7 to 1.

    The intervals are those of the twelve passages between the peaks of Figure 4-29: of their mean,
    by side, and of the slope of a straight line of r over the speed.
    """
    lost = losses()
    r, speed, peak = (x[: PEAKS - 1] for x in lost[:3])
    mean = identification.fit(lambda r: np.full(len(speed), r), r, {"r": 0.85})
    line = identification.fit(lambda r, slope: r + slope * speed, r, {"r": 0.85, "slope": 0.0})
    low, high = mean.interval("r")
    slope = line.interval("slope")
    sides = []
    for side in (1, -1):
        of_side = r[np.sign(peak) == side]
        sides.append(
            identification.fit(lambda r, to=of_side: np.full(to.shape, r), of_side, {"r": 0.85})
        )
    ratios = ["{:.3f} ({:.3f} to {:.3f})".format(s.values["r"], *s.interval("r")) for s in sides]
    return Drawn(
        draw_ratios(0.7, 1.0),
        (
            Statement(
                "4.7", "r is generally close to that of 2-6",
                f"{mean.values['r']:.3f} on average ({low:.3f} to {high:.3f}); {HOUSNER:.3f} by "
                "2-6 about the corner",
                bool(low < HOUSNER < high),
            ),
            Statement(
                "4.7", "no apparent relation of r to the speed",
                f"slope {slope[0]:.2f} to {slope[1]:.2f} s/m", bool(slope[0] < 0 < slope[1]),
            ),
            Statement(
                "4.7", "no difference of the sides is spoken of, as in chapter 3",
                f"{ratios[0]} coming right, {ratios[1]} left: no clear difference",
                None,
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_34() -> Drawn:
    """Where the wall begins to lose energy: 4-25 and 4-26 about the crossings of Table A-1.

    The boundary found by eye in Figure 4-27 is not printed; what can be said is whether the
    measured crossings, at which about half of the energy of a passage is lost, lie inside.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    rows = ~measured.at_peak & chosen
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    draw_boundary(ax)
    size, speed = measured.displacement[rows], np.abs(measured.velocity[rows])
    ax.plot(size * MM, speed, "o", color=style.INK, mfc="white", ms=4, label="crossings, Table A-1")
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel(r"speed $|\dot\Delta|$ [m/s]")
    ax.set_ylim(0, 1.0)
    ax.legend(loc="lower right", fontsize=7.5)
    limit = WALL.dissipation_limit(np.linspace(5e-4, 0.0325, 400))
    inside = np.abs(size) < np.interp(speed, limit.speed, limit.displacement)
    return Drawn(
        figure,
        (
            Statement(
                "4.7", "the boundary closely matches that of the experiment",
                f"that of the experiment is not printed; {inside.sum()} of {len(inside)} measured "
                "crossings lie inside",
                None,
            ),
        ),
    )  # fmt: skip
