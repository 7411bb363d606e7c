"""Figures of the geometry and the static forces of the wall of chapter 4, sections 4.6 and 4.7.

The measured points are those of Table A-1, the peaks and the zero crossings of the free vibration;
the thesis prints nothing else of the continuous record. Rows with a guessed number are left out. A
zero crossing is an instant without acceleration, so that its displacement is not zero.
"""

from dataclasses import replace
from functools import cache

import numpy as np
from matplotlib.axes import Axes

from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import WALL
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
