"""Figures of 4.5 to 4.7: Table A-1 on the free vibration of the wall, its geometry and forces.

Only that table of the continuous record is printed: its peaks and the instants without
acceleration between them. They are drawn as points: no curve between them is printed. Rows of which
a number had to be guessed are left out. A zero crossing is an instant without acceleration, so that
its displacement is not zero.
"""

from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import PEAKS, WALL
from rockeom.thesis.printed import FIGURE_4_29
from rockeom.thesis.wall_tests import back_calculated_force, quarter_period_fit

GAUGE = 0.030
"""Distance from the edge of the wall outward to the uplift gauge [m]."""


def legible() -> np.ndarray:
    """(45,) whether all numbers of a row of Table A-1 are legible."""
    return np.asarray(identification.FreeVibration.table_a1().reading) != "guessed"


def quarters() -> tuple[np.ndarray, np.ndarray]:
    """Peaks [m] and the quarter periods after them [s], (19,), of the legible rows."""
    measured = identification.FreeVibration.table_a1()
    starts = np.flatnonzero(measured.at_peak[:-1])
    starts = starts[legible()[starts] & legible()[starts + 1]]
    return measured.displacement[starts], np.diff(measured.time)[starts]


def draw_rows(
    ax: Axes, x: np.ndarray, y: np.ndarray, label: str = "", guessed: bool = True
) -> None:
    """Values (45,) of the rows of Table A-1: peaks filled, crossings open, guessed rows crossed."""
    at_peak, clear = identification.FreeVibration.table_a1().at_peak, legible()
    for rows, mark, face, name in (
        (at_peak & clear, "o", style.INK, "peaks"),
        (~at_peak & clear, "o", "white", "zero crossings"),
        *([(~clear, "x", style.INK, "guessed")] if guessed else []),
    ):
        look = {**dr.OPEN, "mfc": face, "ms": 4, "zorder": 5, "label": f"{label}{name}"}
        ax.plot(x[rows], y[rows], mark, **look)


def draw_measured(ax: Axes, column: str, unit: float, label: str = "") -> None:
    """Draw a column of Table A-1, over its unit, against the displacement in mm.

    column : as `FreeVibration` names it.
    """
    measured = identification.FreeVibration.table_a1()
    x, y = measured.displacement * dr.MM, getattr(measured, column) / unit
    draw_rows(ax, x, y, label, guessed=False)


def symmetric(largest: float, number: int = 1201) -> np.ndarray:
    """(number,) displacements from -largest to largest [m], closer together about zero."""
    s = np.linspace(-1.0, 1.0, number)
    return largest * s * np.abs(s)


def overview_and_origin(*axes: Axes) -> None:
    """Titles of two axes side by side: all displacements, and those about zero."""
    for ax, title in zip(axes, ("a) all displacements", "b) about upright"), strict=True):
        ax.set_title(title, fontsize=9)
        ax.set_xlabel(dr.DELTA)


# --- the rotation centre, the uplift and the tendon


@dr.thesis_axes(dr.Source.COMPUTED, 6.6, 3.6)
def figure_4_17(ax: Axes) -> None:
    """Distance of the rotation centre from the edge against the displacement: 4-7 and Table A-1.

    The distances of the table count from the uplift gauge, 30 mm outside the edge: at the peaks
    its own uplifts of the edges place the centre 30 mm nearer. Referred to the edge, 4-7 has 442
    and 66 mm in place of the printed 412 and 96 mm. All curves count from the gauge.
    """
    measured = identification.FreeVibration.table_a1()
    d = symmetric(0.032)
    printed, edge = formulas.RotationCentre.thesis_gauge(), formulas.RotationCentre.thesis_edge()
    as_printed, moved = printed.distance_from_edge(d), edge.distance_from_edge(d) + GAUGE
    curves = ("4-7 as printed: 412, 96 mm", as_printed), ("442, 66 mm, plus 30 mm", moved)
    dr.draw_curves(ax, [(label, d * dr.MM, y * dr.MM) for label, y in curves])
    draw_measured(ax, "centre_from_edge", 1e-3, "Table A-1 ")
    rows = measured.at_peak & legible() & (np.abs(measured.displacement) > 5e-3)
    from_uplifts = measured.rotation_centre(WALL.half_width)[rows] + GAUGE
    ax.plot(measured.displacement[rows] * dr.MM, from_uplifts * dr.MM, "+", ms=9, mew=1.0,
            color=style.LINES[2], zorder=4, label="its uplifts, plus 30 mm")  # fmt: skip
    ax.set(xlabel=dr.DELTA, ylabel="distance from the gauge [mm]", ylim=(0, 600))
    ax.legend(loc="upper left", fontsize=7.5)


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.4, columns=2)
def figure_4_18(*axes: Axes) -> None:
    """Uplift of both edges of the base against the displacement: 4-9 and Table A-1.

    The curve of 4-9 continues to the pressed edge, whose uplift it makes -(B - b) sin(theta).
    """
    measured = identification.FreeVibration.table_a1()
    overview_and_origin(*axes)
    for ax, far in zip(axes, (0.032, 0.005), strict=True):
        d = symmetric(far)
        near = legible() & (np.abs(measured.displacement) < far)
        for name, side, mark in (("left", -1, "o"), ("right", 1, "s")):
            color = style.FEET[name]
            curve = WALL.uplift(d, side * WALL.half_width)
            ax.plot(d * dr.MM, curve * dr.MM, color=color, label=f"{name} edge, 4-9")
            x, y = measured.displacement[near], getattr(measured, f"{name}_uplift")[near]
            look = {**dr.OPEN, "color": color, "ms": 3.6, "label": f"{name} edge, measured"}
            ax.plot(x * dr.MM, y * dr.MM, mark, **look)
        ax.axhline(0.0, color=style.INK, lw=0.6)
    axes[0].set_ylabel("uplift $u'$ [mm]")
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set_xlim(-5, 5)


@cache
def tendon_fit() -> identification.Fit:
    """Initial force [N] of 4-16 and the factor of its stiffness, by the peaks of Table A-1."""
    measured = identification.FreeVibration.table_a1()
    peaks = measured.at_peak & legible()
    d, force = measured.displacement[peaks], np.asarray(measured.tendon_force)[peaks]
    guess = {"start": 75e3, "factor": 1.0}
    return identification.fit(lambda start, factor: tendon_line(d, start, factor), force, guess)


def tendon_line(d: np.ndarray, start: float, factor: float) -> np.ndarray:
    """Tendon force [N] by 4-16 with an initial force [N] and a factor of its stiffness."""
    return start + factor * WALL.tendons[0].stiffness * WALL.tendon_extension(d)


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.4, columns=2)
def figure_4_20(*axes: Axes) -> None:
    """Force of the tendon against the displacement: 4-16 and Table A-1.

    With the stiffness of appendix B, an unstressed length of 3093.5 mm; 4-16 adds the extension
    to the distance of the anchors instead of subtracting it. The curve lies above the peaks. Dotted
    is 4-16 with its initial force and its stiffness fitted to the legible peaks.
    """
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    overview_and_origin(*axes)
    for ax, far in zip(axes, (0.032, 0.005), strict=True):
        d = symmetric(far)
        curves = (
            ("4-16 with 4-7 as printed", WALL.tendon_force(d)),
            ("4-16 with 4-7 from the edge", edge.tendon_force(d)),
            ("stiffness fitted to peaks", tendon_line(d, **tendon_fit().values)),
        )
        dr.draw_curves(ax, [(label, d * dr.MM, y / 1e3) for label, y in curves], ("-", "--", ":"))
        draw_measured(ax, "tendon_force", 1e3)
    axes[0].set(ylabel="tendon force $P$ [kN]", ylim=(70, 175))
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set(xlim=(-5, 5), ylim=(73, 88))


# --- quarter periods and conservative motion


@dr.thesis_axes(dr.Source.COMPUTED, 6.0, 3.6)
def figure_4_24(ax: Axes) -> None:
    """Quarter periods against the peak: 4-17, the fit 4-5, quadrature, and Table A-1.

    The thesis does not have the time of a conservative motion to upright, 4-24. It ends at D = 0,
    the measured one at the instant without acceleration, a millimetre or two before.
    """
    peak, time = quarters()
    d = np.linspace(1e-3, 0.032, 200)
    heavier = replace(WALL, inertia=13215.0).quarter_period_substitute_gravity(d)
    curves = (
        (r"4-17, $I_o$ = 12 101 kg m$^2$", WALL.quarter_period_substitute_gravity(d)),
        (r"4-17, $I_o$ = 13 215 kg m$^2$ (B-9 as printed)", heavier),
        ("4-5, fitted", quarter_period_fit(d)),
        ("4-24, no losses, to upright", WALL.quarter_period_exact(d)),
    )
    dr.draw_curves(ax, [(label, d * dr.MM, y) for label, y in curves], ("-", ":", "--", "-."))
    labels = "Table A-1, from peaks to the right", "Table A-1, from peaks to the left"
    dr.draw_sides(ax, peak, time, labels=labels)
    ax.set(xlabel=r"peak displacement $|\Delta_0|$ [mm]", xlim=(0, 33), ylim=(0, 0.085))
    ax.set_ylabel("quarter period [s]")
    ax.legend(loc="lower right", fontsize=7.5)


@dr.thesis_axes(dr.Source.COMPUTED, 6.4, 4.0)
def figure_4_32(ax: Axes) -> None:
    """Trajectories without losses from measured peaks, 4-23, and the measured zero crossings.

    Table A-1 has only both ends of the measured trajectories. Their distance from the
    curves at the zero crossing is the energy lost by then: about half of r.
    """
    measured = identification.FreeVibration.table_a1()
    for color, row in zip(style.LINES, (0, 4, 8, 12, 16, 20), strict=True):
        for start, line in ((row, "-"), (row + 2, "--")):
            d0 = measured.displacement[start]
            d = d0 * np.linspace(1.0, 0.0, 400) ** 2
            label = rf"$\Delta_0$ = {d0 * dr.MM:.1f} mm"
            ax.plot(d * dr.MM, WALL.phase_trajectory(d0, d), line, color=color, label=label)
            draw_ends(ax, start, measured.displacement, measured.velocity, color)
    ax.axhline(0.0, color=style.INK, lw=0.6)
    ax.axvline(0.0, color=style.INK, lw=0.6)
    ax.set(xlabel=dr.DELTA, ylabel=dr.VELOCITY)
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7.5)


def draw_ends(ax: Axes, start: int, x: np.ndarray, y: np.ndarray, color: str) -> None:
    """A measured peak and the zero crossing after it, x [m]."""
    rows, look = [start, start + 1], {**dr.OPEN, "color": color, "ms": 4, "zorder": 5}
    ax.plot(x[rows] * dr.MM, y[rows], "o", clip_on=False, **look)


@dr.thesis_axes(dr.Source.COMPUTED, 6.4, 3.6)
def figure_4_33(ax: Axes) -> None:
    """Displacement in time without losses, 4-24, from five measured peaks to upright.

    The thesis does not say which five; here the 1st, 5th, 9th, 13th and 17th peak of Table A-1,
    each with the zero crossing after it. At the crossing of the first three the wall is 3 to 5 ms
    ahead of the curve, which the 6 % more of F_k in 4.8.1 make up for in part.
    """
    measured = identification.FreeVibration.table_a1()
    for color, start in zip(style.LINES, (0, 8, 16, 24, 32), strict=False):
        d0 = abs(measured.displacement[start])
        d = d0 * np.cos(np.linspace(0.1, np.pi / 2, 40))
        time = np.append(0.0, WALL.time_along_trajectory(d0, d))
        label = rf"$|\Delta_0|$ = {d0 * dr.MM:.1f} mm"
        ax.plot(time, np.append(d0, d) * dr.MM, color=color, label=label)
        sided = np.sign(measured.displacement[start]) * measured.displacement * dr.MM
        draw_ends(ax, start, (measured.time - measured.time[start]) / dr.MM, sided, color)
    ax.set(xlabel="time after the peak [s]", ylabel=dr.SIZE, xlim=(0, None), ylim=(0, None))
    ax.legend()


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.4, columns=2)
def figure_4_35(left: Axes, right: Axes) -> None:
    """Restoring force F_k of the wall against displacement, 4-30, and -M a at measured peaks.

    The force of 4-30 is the exact derivative of the energies, where the thesis has differences.
    The points are -M_e a at the peaks of Table A-1, by 4-42, with the whole mass for M_e. The one
    of 39 kN is the first row of the table, the instant of the release, whose acceleration is larger
    than that of any later peak; the thesis gives no reason.
    """
    measured = identification.FreeVibration.table_a1()
    overview_and_origin(left, right)
    stronger = analysis.Wall.thesis(111e3)
    measured_force = back_calculated_force(WALL.mass, measured.acceleration)
    for ax, far in ((left, 0.055), (right, 0.012)):
        d = symmetric(far)
        curves = (
            ("4-30, 75.6 kN", WALL.restoring_force(d)),
            ("6 % more", 1.06 * WALL.restoring_force(d)),
            ("4-30, 111 kN", stronger.restoring_force(d)),
        )
        dr.draw_curves(ax, [(label, d * dr.MM, y / 1e3) for label, y in curves], ("-", "--", ":"))
        near = measured.at_peak & legible() & (np.abs(measured.displacement) < far)
        x, y = measured.displacement[near] * dr.MM, measured_force[near] / 1e3
        ax.plot(x, y, "o", ms=3.6, label="measured, 75.6 kN", **dr.OPEN)
    d = np.linspace(2e-3, 0.012, 2001)
    force = WALL.restoring_force(d)
    top = int(force[: len(d) // 2].argmax())
    low = top + int(force[top:].argmin())
    line = {"arrowstyle": "-", "color": style.INK, "lw": 0.6}
    for row, place in ((top, (-11.5, 24.0)), (low, (3.5, -4.0))):
        at = (d[row] * dr.MM, force[row] / 1e3)
        words = f"{at[1]:.1f} kN at {at[0]:.1f} mm"
        right.annotate(words, at, place, fontsize=8, arrowprops=line)
    yields = WALL.yield_displacement()
    release = (measured.displacement[0] * dr.MM, measured_force[0] / 1e3)
    for words, at, offset in (
        ("tendon yields", (yields * dr.MM, WALL.restoring_force(yields) / 1e3), (-40, -30)),
        ("at the release", release, (14, 3)),
    ):
        left.annotate(words, at, offset, textcoords="offset points", fontsize=8, arrowprops=line)
    left.set_ylabel("restoring force $F_k$ [kN]")
    left.legend(loc="upper left", fontsize=7.5)


# --- the free vibration

HOUSNER = float(
    formulas.energy_ratio_of_block(
        np.arctan2(WALL.half_width, WALL.centroid_height),
        inertia=WALL.corner_inertia - WALL.mass * WALL.corner_radius**2,
        mass=WALL.mass,
        radius=WALL.corner_radius,
    )
)
"""r of 2-6 for the wall about its corner."""


def peaks() -> np.ndarray:
    """Rows of the first thirteen peaks of Table A-1, those of Figure 4-29."""
    return np.flatnonzero(identification.FreeVibration.table_a1().at_peak)[:PEAKS]


# --- 4.5 the record


def draw_displacement(ax: Axes) -> None:
    """Displacements in time of the legible rows of Table A-1."""
    measured, clear = identification.FreeVibration.table_a1(), legible()
    ax.plot(measured.time[clear], measured.displacement[clear] * dr.MM, "o", ms=3.2, **dr.OPEN)
    ax.set_ylabel(dr.DELTA)


@dr.thesis_axes(dr.Source.PRINTED, 7.2, 6.0, 3, sharex=True)
def figure_4_11(top: Axes, uplifts: Axes, centre: Axes) -> None:
    """Corrected response of the wall in run 5: displacement, uplifts and rotation centre.

    Drawn are the rows of Table A-1, whose uplifts are corrected already: its last column is the
    distance of the centre from the gauge that they give (4-1, with the 30 mm). Hollow are the
    uplifts as the gauges read them, by 4-3 and 4-4 backwards. The table that shook the wall stands
    still in this test; the record of its motion is not printed.
    """
    measured = identification.FreeVibration.table_a1()
    draw_displacement(top)
    peak = measured.at_peak & legible()
    time, x = measured.time[peak], np.asarray(measured.centre_from_edge)[peak]
    left, right = (np.asarray(u)[peak] for u in (measured.left_uplift, measured.right_uplift))
    width = 2 * (WALL.half_width + GAUGE)
    of_left = np.where(left < right, x, width - x)  # x counts from the gauge of the pressed edge
    for name, uplift, reach, mark in (
        ("left", left, of_left, "o"),
        ("right", right, width - of_left, "s"),
    ):
        color = style.FEET[name]
        uplifts.plot(time, uplift * dr.MM, mark, color=color, ms=3, label=f"{name} edge")
        look = {**dr.OPEN, "color": color, "ms": 4.4, "mfc": "none", "label": f"{name} gauge"}
        uplifts.plot(time, uplift * reach / (reach - GAUGE) * dr.MM, mark, **look)
    uplifts.set_ylabel("uplift $u'$ [mm]")
    style.legend_above(uplifts)
    centre.plot(time, x * dr.MM, "o", color=style.LINES[2], ms=3.5)
    centre.axhline(width / 2 * dr.MM, color=style.INK, lw=0.6, ls=":")
    centre.annotate("centreline", (0.02, width / 2 * dr.MM - 45), fontsize=7.5)
    centre.set(ylabel="centre from\nthe gauge [mm]", ylim=(0, 620), xlabel=dr.TIME)


@dr.thesis_axes(dr.Source.PRINTED, 7.2, 3.2)
def figure_4_12(ax: Axes) -> None:
    """Free vibration of the wall, its peaks and crossings marked: Table A-1.

    A crossing is where the acceleration vanishes; the displacement there is up to 3 mm, since the
    wall slid. Crosses are rows of which a number had to be guessed.
    """
    measured = identification.FreeVibration.table_a1()
    ax.axhline(0.0, color=style.INK, lw=0.6)
    draw_rows(ax, measured.time, measured.displacement * dr.MM)
    ax.set(xlabel=dr.TIME, ylabel=dr.DELTA)
    ax.legend()


@cache
def fitted_quarters() -> identification.Fit:
    """k [s/m**0.5] and c [s] of quarter periods k sqrt(displacement) + c."""
    peak, time = quarters()
    root = np.sqrt(np.abs(peak))
    return identification.fit(lambda k, c: k * root + c, time, {"k": 0.3, "c": 0.01})


@dr.thesis_axes(dr.Source.COMPUTED, 6.0, 3.6)
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

    band = fitted - reach * spread, fitted + reach * spread
    ax.fill_between(d * dr.MM, *band, color=style.LINES[1], alpha=0.15, lw=0)
    ax.plot(d * dr.MM, quarter_period_fit(d), color=style.LINES[0], label="4-5")
    ax.plot(d * dr.MM, fitted, "--", color=style.LINES[1], label="fitted again, 95 % band")
    dr.draw_sides(ax, peak, time)
    ax.set(xlabel=r"peak displacement $|\Delta_0|$ [mm]", xlim=(0, 33), ylim=(0, 0.08))
    ax.set_ylabel("quarter period [s]")
    ax.legend(loc="lower right")


def draw_uplifts_and_force(close: bool) -> Figure:
    """Uplifts of both edges, and the tendon's force, against the displacement.

    close : about upright, the rows by themselves; else all, one after the other connected.
    """
    measured = identification.FreeVibration.table_a1()
    figure, (left, right) = dr.panels(7.6, 3.4, columns=2)
    far = 0.0063 if close else 0.034
    rows = legible() & (np.abs(measured.displacement) < far)
    d = measured.displacement[rows] * dr.MM
    joined = "" if close else "-"
    for name, mark in (("left", "o"), ("right", "s")):
        uplift = np.asarray(getattr(measured, f"{name}_uplift"))[rows] * dr.MM
        look = {**dr.OPEN, "color": style.FEET[name], "ls": joined, "lw": 0.5, "ms": 3.5}
        left.plot(d, uplift, marker=mark, label=f"{name} edge", **look)
    right.plot(d, np.asarray(measured.tendon_force)[rows] / 1e3, ls=joined, lw=0.5, color="0.6")
    draw_measured(right, "tendon_force", 1e3)
    if close:
        right.set_ylim(74.5, 86)
    left.axhline(0.0, color=style.INK, lw=0.6)
    for ax, name in ((left, "uplift $u'$ [mm]"), (right, "tendon force $P$ [kN]")):
        ax.set(xlim=(-far * dr.MM, far * dr.MM), xlabel=dr.DELTA, ylabel=name)
        ax.legend(loc="upper center")
    return figure


@dr.thesis_figure(dr.Source.PRINTED)
def figure_4_14() -> Figure:
    """Uplifts of the edges, and the force of the tendon, against the displacement: Table A-1.

    One row after the other is connected, as the samples were in the thesis, which rounds the force
    off about upright in the same way.
    """
    return draw_uplifts_and_force(close=False)


@dr.thesis_figure(dr.Source.PRINTED)
def figure_4_15() -> Figure:
    """The same about upright, the rows by themselves: Table A-1.

    Without the rows that had to be guessed seven peaks are this small.
    """
    return draw_uplifts_and_force(close=True)


def inertia_over_radius() -> tuple[np.ndarray, np.ndarray]:
    """Distances of the rotation centre from the centreline [m], and I_o/R about it [kg m]."""
    b = np.linspace(0.0, WALL.half_width, 201)
    return b, WALL.moment_of_inertia(WALL.half_width + b) / np.hypot(b, WALL.centroid_height)


@dr.thesis_axes(dr.Source.COMPUTED, 5.0, 3.2)
def figure_4_22b(ax: Axes) -> None:
    """I_o/R against the place of the rotation centre, from the centreline to the edge.

    I_o is B-9 with the added masses where they are, (d - B)^2; R from the centre to the centroid.
    Dotted is its value at the edge.
    """
    b, ratio = inertia_over_radius()
    ax.plot(b * dr.MM, ratio, color=style.LINES[0])
    ax.axhline(ratio[-1], color=style.INK, lw=0.6, ls=":")
    ax.set(xlabel="rotation centre from the centreline $b$ [mm]", ylabel="$I_o/R$ [kg m]")
    ax.set_ylim(0.95 * ratio.min(), 1.05 * ratio.max())


# --- 4.7 energy


def draw_speeds(ax: Axes) -> None:
    """Speed against displacement at the rows of Table A-1."""
    measured = identification.FreeVibration.table_a1()
    draw_rows(ax, measured.displacement * dr.MM, np.abs(measured.velocity))
    ax.set(xlabel=dr.DELTA, ylabel=r"speed $|\dot\Delta|$ [m/s]", ylim=(-0.02, None))


def draw_paths_without_losses(ax: Axes, sided: bool) -> None:
    """Motions by 4-23 from the first five peaks; sided : with the direction of their velocity."""
    for n, (d, speed) in enumerate(paths_without_losses()):
        label = "without losses, 4-23" if n == 0 else None
        velocity = -np.sign(d[0]) * speed if sided else speed
        ax.plot(d * dr.MM, velocity, ":", color=style.LINES[1], lw=0.9, label=label)


@dr.thesis_axes(dr.Source.PRINTED, 5.4, 4.0)
def figure_4_25(ax: Axes) -> None:
    """Free vibration of the wall in the phase plane: Table A-1.

    Dotted are motions without losses from the first five peaks to upright, 4-23. That the record
    has no steps of speed, as the thesis says, its peaks and crossings cannot show.
    """
    measured = identification.FreeVibration.table_a1()
    ax.axhline(0.0, color=style.INK, lw=0.6)
    ax.axvline(0.0, color=style.INK, lw=0.6)
    draw_rows(ax, measured.displacement * dr.MM, measured.velocity)
    ax.set(xlabel=dr.DELTA, ylabel=dr.VELOCITY)
    draw_paths_without_losses(ax, sided=True)
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


@dr.thesis_axes(dr.Source.PRINTED, 6.4, 3.8)
def figure_4_26(ax: Axes) -> None:
    """Speed against displacement, whichever way the wall moves: Table A-1.

    Dotted is the motion without losses from each of the first five peaks to upright, 4-23, above
    which no point can lie.
    """
    draw_speeds(ax)
    draw_paths_without_losses(ax, sided=False)
    ax.set_ylim(-0.02, 0.9)
    style.legend_above(ax)


def draw_boundary(ax: Axes) -> None:
    """4-25 and 4-26: a quarter of the peak, and the speed without losses there."""
    peak = np.linspace(1e-3, 0.0325, 60)
    limit = WALL.dissipation_limit(peak)
    d, color = limit.displacement * dr.MM, style.LINES[1]
    ax.plot(-d, limit.speed, "--", color=color)
    ax.plot(d, limit.speed, "--", color=color, label="a quarter of the peak, 4-25, 4-26")
    ax.fill_betweenx(limit.speed, -d, d, color=color, alpha=0.12, lw=0)


@dr.thesis_axes(dr.Source.COMPUTED, 6.4, 3.8)
def figure_4_27(ax: Axes) -> None:
    """Where the wall loses energy, by displacement and speed: 4-25, 4-26 and Table A-1.

    The boundary of the thesis is drawn by eye into the record, which is not printed. Here it is a
    quarter of each peak with the speed that the wall has there without losses; both equations are
    missing from the text and follow its words. Dotted are the 4 mm of the text.
    """
    draw_boundary(ax)
    draw_speeds(ax)
    ax.vlines([-4, 4], 0, 1, style.LINES[2], ":", lw=0.9, label="4 mm")
    style.legend_above(ax)


@dr.thesis_axes(dr.Source.COMPUTED, 6.6, 3.6)
def figure_4_28(ax: Axes) -> None:
    """Energies of the wall in the first three cycles: 4-18 to 4-20 at the rows of Table A-1.

    The elastic energy is that of the measured force of the tendon, as in Figure 4-29. Lines connect
    the rows.
    """
    measured = identification.FreeVibration.table_a1()
    energies = measured.energies(WALL)
    curves = {
        "total": energies.total,
        "tendon $U_E$": energies.elastic,
        "motion $E_k$": energies.kinetic,
        "gravity $U$": energies.gravity,
    }
    rows = [(label, measured.time[:13], values[:13]) for label, values in curves.items()]
    colors = (style.INK, *style.LINES)
    dr.draw_curves(ax, rows, dr.SOLID, colors, marker="o", ms=3.5, lw=0.9)
    ax.set(xlabel=dr.TIME, ylabel="energy [J]", ylim=(0, 700))
    ax.legend(loc="upper right", ncols=4)


@dr.thesis_axes(dr.Source.COMPUTED, 7.0, 4.4, 2, sharex=True)
def figure_4_29(top: Axes, bottom: Axes) -> None:
    """Displacement and total energy in the free vibration: 4-18 to 4-20 and Table A-1.

    Filled are the energies at the peaks, crosses those of the table in the thesis's figure.
    """
    measured, clear = identification.FreeVibration.table_a1(), legible()
    energies, rows = measured.energies(WALL).total, peaks()
    printed = FIGURE_4_29.numbers("total energy")
    draw_displacement(top)
    bottom.plot(measured.time[clear], energies[clear], color="0.8", lw=0.8)
    at = measured.time[rows]
    bottom.plot(at, energies[rows], "o", color=style.LINES[0], ms=4, label="computed")
    bottom.plot(at, printed, "x", color=style.LINES[1], ms=6, label="printed")
    bottom.set(xlabel=dr.TIME, ylabel="total energy [J]", ylim=(0, None))
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
    r, speed, peak, rows = losses()
    figure, (left, right) = dr.panels(7.6, 3.4, columns=2, sharey=True)
    labels = "wall comes from the right", "wall comes from the left"
    for ax, x in ((left, np.abs(peak) * dr.MM), (right, speed)):
        dr.draw_sides(ax, peak[rows], r[rows], x[rows], labels)
        ax.axhline(HOUSNER, color=style.INK, lw=0.8, ls=":", label=f"2-6: {HOUSNER:.3f}")
        ax.set_xlim(0, None)
    left.set(ylim=(low, high), ylabel=dr.RATIO, xlabel=r"peak before $|\Delta|$ [mm]")
    left.legend(loc="lower right", fontsize=7.5)
    right.set_xlabel(r"speed at the crossing $|\dot\Delta|$ [m/s]")
    return figure


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_30() -> Figure:
    """Apparent restitution of each passage against the peak before it and its speed.

    r is the ratio of the total energies at successive peaks. Left out are passages next to a row
    that had to be guessed.
    """
    return draw_ratios(0.0, 1.25)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_31() -> Figure:
    """The same from r = 0.7 to 1."""
    return draw_ratios(0.7, 1.0)


@dr.thesis_axes(dr.Source.COMPUTED, 6.0, 3.6)
def figure_4_34(ax: Axes) -> None:
    """Where the wall begins to lose energy: 4-25 and 4-26 about the crossings of Table A-1.

    The boundary found by eye in Figure 4-27 is not printed; what can be said is whether the
    measured crossings, at which about half of the energy of a passage is lost, lie inside.
    """
    measured = identification.FreeVibration.table_a1()
    rows = ~measured.at_peak & legible()
    draw_boundary(ax)
    d, speed = measured.displacement[rows] * dr.MM, np.abs(measured.velocity[rows])
    ax.plot(d, speed, "o", ms=4, label="crossings, Table A-1", **dr.OPEN)
    ax.set(xlabel=dr.DELTA, ylabel=r"speed $|\dot\Delta|$ [m/s]", ylim=(0, 1.0))
    ax.legend(loc="lower right", fontsize=7.5)
