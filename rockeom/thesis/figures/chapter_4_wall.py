"""Figures of the geometry and the static forces of the wall of chapter 4, sections 4.6 and 4.7.

The measured points are those of Table A-1, the peaks and the zero crossings of the free vibration;
the thesis prints nothing else of the continuous record. Rows with a guessed number are left out. A
zero crossing is an instant without acceleration, so that its displacement is not zero.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import free_body as fb, style
from rockeom.thesis.figures.drawn import MM, OPEN, Source, thesis_axes, thesis_panels
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


def draw_measured(ax: Axes, column: str, unit: float, label: str = "") -> None:
    """Draw a column of Table A-1, over its unit, against the displacement in mm.

    column : as `FreeVibration` names it. Peaks are filled, zero crossings open.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    at_peak, x, y = measured.at_peak, measured.displacement, getattr(measured, column)
    marks: dict[str, Any] = {"color": style.INK, "ls": "", "marker": "o", "zorder": 5, "mew": 0.8}
    for rows, face, ms, name in (
        (at_peak, style.INK, 3.6, "at peaks"),
        (~at_peak, "white", 4.2, "at zero crossings"),
    ):
        rows = rows & chosen
        ax.plot(x[rows] * MM, y[rows] / unit, mfc=face, ms=ms, label=f"{label}{name}", **marks)


def draw_sides(
    ax: Axes,
    peak: np.ndarray,
    y: np.ndarray,
    right: str = "from peaks to the right",
    left: str = "to the left",
) -> None:
    """Draw values at peaks [m], with one mark for peaks to the right and one for the left."""
    for side, mark, label in ((1, ">", right), (-1, "<", left)):
        rows = np.sign(peak) == side
        ax.plot(np.abs(peak[rows]) * MM, y[rows], mark, ms=4, label=label, **OPEN)


def symmetric(largest: float, number: int = 1201) -> np.ndarray:
    """(number,) displacements from -largest to largest [m], closer together about zero."""
    s = np.linspace(-1.0, 1.0, number)
    return largest * s * np.abs(s)


def overview_and_origin(figure: Figure) -> tuple[Axes, Axes]:
    """Two axes side by side: all displacements, and those about zero."""
    left, right = figure.subplots(1, 2)
    for ax, title in ((left, "a) all displacements"), (right, "b) about upright")):
        ax.set_title(title, fontsize=9)
        ax.set_xlabel(r"displacement $\Delta$ [mm]")
    return left, right


# --- the rotation centre, the uplift and the tendon


@thesis_axes(Source.COMPUTED, 6.6, 3.6)
def figure_4_17(ax: Axes) -> None:
    """Distance of the rotation centre from the edge against the displacement: 4-7 and Table A-1.

    The distances of the table count from the uplift gauge, 30 mm outside the edge: at the peaks
    its own uplifts of the edges place the centre 30 mm nearer. Referred to the edge, 4-7 has 442
    and 66 mm in place of the printed 412 and 96 mm. All curves count from the gauge.
    """
    measured = identification.FreeVibration.table_a1()
    d = symmetric(0.032)
    printed, edge = formulas.RotationCentre.thesis_gauge(), formulas.RotationCentre.thesis_edge()
    ax.set_prop_cycle(color=style.LINES)
    ax.plot(d * MM, printed.distance_from_edge(d) * MM, label="4-7 as printed: 412, 96 mm")
    ax.plot(d * MM, (edge.distance_from_edge(d) + GAUGE) * MM, "--", label="442, 66 mm, plus 30 mm")
    draw_measured(ax, "centre_from_edge", 1e-3, "Table A-1 ")
    rows = measured.at_peak & legible() & (np.abs(measured.displacement) > 5e-3)
    from_uplifts = measured.rotation_centre(WALL.half_width)[rows] + GAUGE
    ax.plot(
        measured.displacement[rows] * MM, from_uplifts * MM, "+", ms=9, mew=1.0,
        color=style.LINES[2], zorder=4, label="its uplifts, plus 30 mm",
    )  # fmt: skip
    ax.set(
        xlabel=r"displacement $\Delta$ [mm]", ylabel="distance from the gauge [mm]", ylim=(0, 600)
    )
    ax.legend(loc="upper left", fontsize=7.5)


@thesis_panels(Source.COMPUTED, 7.6, 3.4)
def figure_4_18(figure: Figure) -> None:
    """Uplift of both edges of the base against the displacement: 4-9 and Table A-1.

    The curve of 4-9 continues to the pressed edge, whose uplift it makes -(B - b) sin(theta).
    """
    measured = identification.FreeVibration.table_a1()
    axes = overview_and_origin(figure)
    b = WALL.half_width
    chosen = legible()
    for ax, far in zip(axes, (0.032, 0.005), strict=True):
        d = symmetric(far)
        near = chosen & (np.abs(measured.displacement) < far)
        for name, side, mark, color in (
            ("left", -1, "o", style.LINES[0]),
            ("right", 1, "s", style.LINES[1]),
        ):
            uplift = getattr(measured, f"{name}_uplift")
            ax.plot(d * MM, WALL.uplift(d, side * b) * MM, color=color, label=f"{name} edge, 4-9")
            ax.plot(
                measured.displacement[near] * MM, uplift[near] * MM, mark, color=color, ms=3.6,
                mfc="white", mew=0.9, label=f"{name} edge, measured",
            )  # fmt: skip
        ax.axhline(0.0, color=style.INK, lw=0.6)
    axes[0].set_ylabel("uplift $u'$ [mm]")
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set_xlim(-5, 5)


def tilted_wall(ax: Axes, b: float, theta: float) -> dict[str, np.ndarray]:
    """Draw the wall of Figure 4-4, rotated clockwise by theta about a point b off its centreline.

    Returns its points by name: the rotation centre, the edges, the foot and the top of the tendon
    on the centreline, and the centroid.
    """
    half, height = WALL.half_width, WALL.height
    low, high = 0.0, height
    upright = np.array([(-half, low), (half, low), (half, high), (-half, high)])
    centre = np.array([b, 0.0])
    own = {
        "left": (-half, 0.0), "right": (half, 0.0), "foot": (0.0, 0.0), "top": (0.0, height),
        "centroid": (0.0, WALL.centroid_height),
    }  # fmt: skip
    points = {name: fb.turned(at, centre, theta)[0] for name, at in own.items()}
    fb.bare(ax)
    fb.body(ax, upright, faint=True)
    fb.body(ax, fb.turned(upright, centre, theta))
    fb.ground(ax, -1.0, 1.25, depth=0.42)
    return points | {"centre": centre}


@thesis_panels(Source.COMPUTED, 7.4, 4.2)
def figure_4_19(figure: Figure) -> None:
    """Geometry of the extension of the tendon: the wall turned about O in its base.

    Drawn to scale, but turned much further than in any of the tests. The base is straight and the
    pressed edge enters the ground, as 4-1 has it.
    """
    whole, base = figure.subplots(1, 2, width_ratios=(1.0, 1.75))
    b, anchor = 0.32, np.array([0.0, -0.32])
    for ax, theta in ((whole, 0.16), (base, 0.26)):
        at = tilted_wall(ax, b, theta)
        ax.plot(*np.transpose([anchor, at["top"]]), color=fb.FORCE, lw=1.3, zorder=6)
        ax.plot(*anchor, "s", color=fb.FORCE, ms=5, zorder=7)
        fb.line(ax, (0.0, anchor[1]), (0.0, WALL.height + 0.45))
        if ax is whole:
            ax.plot(*at["top"], "s", color=fb.FORCE, ms=5, zorder=7)
            fb.pivot(ax, at["centre"], "$O$", (2, -11))
            fb.angle(ax, at["foot"], (0.0, 1.0), at["top"], 1.5, r"$\theta$", label_radius=1.1)
            level = (0.0, at["top"][1])
            fb.dimension(ax, level, at["top"], r"$\Delta$", shift=0.28, offset=(0, 8))
            corners = ((-0.508, WALL.height), (-0.508, 0.0))
            fb.dimension(ax, *corners[::-1], "$H$", shift=0.3, offset=(-8, 0))
            ax.annotate("tendon", anchor, (9, -3), textcoords="offset points", color=fb.FORCE)
    whole.set(xlim=(-1.05, 1.3), ylim=(-0.5, 3.0))

    fb.pivot(base, at["centre"], "$O$", (2, -12))
    base.plot(*at["foot"], "o", color=style.INK, ms=3.5, zorder=8)
    left = at["left"]
    fb.dimension(base, (left[0], 0.0), left, "$u'$", shift=0.12, offset=(-9, 0))
    fb.dimension(base, (at["foot"][0], 0.0), at["foot"], "$u'_T$", shift=0.1, offset=(-11, 0))
    fb.dimension(base, left, at["centre"], "$d$", shift=0.46, offset=(3, 8))
    fb.dimension(base, at["foot"], at["centre"], "$d_T=d-B$", shift=0.26, offset=(17, 10))
    fb.dimension(base, left, at["foot"], "$B$", shift=0.26, offset=(3, 8))
    fb.angle(base, at["centre"], (-1.0, 0.0), left, 0.62, r"$\theta$", label_radius=0.88)
    fb.dimension(base, (0.0, -0.2), (b, -0.2), "$b$", offset=(0, -8))
    base.annotate("tendon", anchor, (9, -3), textcoords="offset points", color=fb.FORCE)
    base.set(xlim=(-0.85, 0.95), ylim=(-0.42, 0.95))


class TendonOfTable(NamedTuple):
    """Tendon forces of Table A-1.

    displacement [m], force [N] (n,); legible, peaks (n,) : whether a row is legible, whether it is
    a legible peak. fit : the initial force and the stiffness of 4-16, fitted to these peaks.
    """

    displacement: np.ndarray
    force: np.ndarray
    legible: np.ndarray
    peaks: np.ndarray
    fit: identification.Fit

    @classmethod
    def fitted(cls) -> TendonOfTable:
        measured = identification.FreeVibration.table_a1()
        chosen = legible()
        peaks = chosen & measured.at_peak
        x, force = measured.displacement, np.asarray(measured.tendon_force)
        fit = identification.fit(
            lambda start, factor: tendon_line(x[peaks], start, factor), force[peaks],
            {"start": 75e3, "factor": 1.0},
        )  # fmt: skip
        return cls(x, force, chosen, peaks, fit)

    def r_squared(self, wall: analysis.Wall, rows: np.ndarray) -> float:
        computed = wall.tendon_force(self.displacement[rows])
        return identification.coefficient_of_determination(self.force[rows], computed)


def tendon_line(d: np.ndarray, start: float, factor: float) -> np.ndarray:
    """Tendon force [N] by 4-16 with an initial force [N] and a factor of its stiffness."""
    return start + factor * WALL.tendons[0].stiffness * WALL.tendon_extension(d)


@thesis_panels(Source.COMPUTED, 7.6, 3.4)
def figure_4_20(figure: Figure) -> None:
    """Force of the tendon against the displacement: 4-16 and Table A-1.

    With the stiffness of appendix B, an unstressed length of 3093.5 mm; 4-16 adds the extension
    to the distance of the anchors instead of subtracting it. The curve lies above the peaks. Dotted
    is 4-16 with its initial force and its stiffness fitted to the legible peaks.
    """
    measured = TendonOfTable.fitted()
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    axes = overview_and_origin(figure)
    for ax, far in zip(axes, (0.032, 0.005), strict=True):
        d = symmetric(far)
        line = tendon_line(d, **measured.fit.values)
        ax.set_prop_cycle(color=style.LINES)
        ax.plot(d * MM, WALL.tendon_force(d) / 1e3, label="4-16 with 4-7 as printed")
        ax.plot(d * MM, edge.tendon_force(d) / 1e3, "--", label="4-16 with 4-7 from the edge")
        ax.plot(d * MM, line / 1e3, ":", label="stiffness fitted to peaks")
        draw_measured(ax, "tendon_force", 1e3)
    axes[0].set(ylabel="tendon force $P$ [kN]", ylim=(70, 175))
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set(xlim=(-5, 5), ylim=(74, 88))


# --- quarter periods and conservative motion


@thesis_axes(Source.COMPUTED, 6.0, 3.6)
def figure_4_24(ax: Axes) -> None:
    """Quarter periods against the peak: 4-17, the fit 4-5, quadrature, and Table A-1.

    The thesis does not have the time of a conservative motion to upright, 4-24. It ends at D = 0,
    the measured one at the instant without acceleration, a millimetre or two before.
    """
    peak, time = quarters()
    d = np.linspace(1e-3, 0.032, 200)
    ax.set_prop_cycle(color=style.LINES)
    heavier = replace(WALL, inertia=13215.0)
    printed = r"4-17, $I_o$ = 13 215 kg m$^2$ (B-9 as printed)"
    ax.plot(
        d * MM, WALL.quarter_period_substitute_gravity(d), label=r"4-17, $I_o$ = 12 101 kg m$^2$"
    )
    ax.plot(d * MM, heavier.quarter_period_substitute_gravity(d), ":", label=printed)
    ax.plot(d * MM, quarter_period_fit(d), "--", label="4-5, fitted")
    ax.plot(d * MM, WALL.quarter_period_exact(d), "-.", label="4-24, no losses, to upright")
    draw_sides(
        ax, peak, time, *(f"Table A-1, from peaks to the {side}" for side in ("right", "left"))
    )
    ax.set(
        xlabel=r"peak displacement $|\Delta_0|$ [mm]",
        ylabel="quarter period [s]",
        xlim=(0, 33),
        ylim=(0, 0.085),
    )
    ax.legend(loc="lower right", fontsize=7.5)


@thesis_axes(Source.COMPUTED, 6.4, 4.0)
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
            speed = WALL.phase_trajectory(d0, d)
            label = rf"$\Delta_0$ = {d0 * MM:.1f} mm"
            ax.plot(d * MM, speed, line, color=color, label=label)
            ends = [start, start + 1]
            ax.plot(
                measured.displacement[ends] * MM, measured.velocity[ends], "o", ms=4,
                color=color, mfc="white", mew=0.9, zorder=5,
            )  # fmt: skip
    ax.axhline(0.0, color=style.INK, lw=0.6)
    ax.axvline(0.0, color=style.INK, lw=0.6)
    ax.set(xlabel=r"displacement $\Delta$ [mm]", ylabel=r"velocity $\dot\Delta$ [m/s]")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7.5)


@thesis_axes(Source.COMPUTED, 6.4, 3.6)
def figure_4_33(ax: Axes) -> None:
    """Displacement in time without losses, 4-24, from five measured peaks to upright.

    The thesis does not say which five; here the 1st, 5th, 9th, 13th and 17th peak of Table A-1,
    each with the zero crossing after it. At the crossing of the first three the wall is 3 to 5 ms
    ahead of the curve, which the 6 % more of F_k in 4.8.1 make up for in part.
    """
    measured = identification.FreeVibration.table_a1()
    for color, start in zip(style.LINES, (0, 8, 16, 24, 32), strict=False):
        d0 = measured.displacement[start]
        d = np.abs(d0) * np.cos(np.linspace(0.1, np.pi / 2, 40))
        time = np.append(0.0, WALL.time_along_trajectory(np.abs(d0), d))
        label = rf"$|\Delta_0|$ = {abs(d0) * MM:.1f} mm"
        ax.plot(time, np.append(abs(d0), d) * MM, color=color, label=label)
        ends = [start, start + 1]
        ax.plot(
            measured.time[ends] - measured.time[start],
            np.sign(d0) * measured.displacement[ends] * MM,
            "o", ms=4, color=color, mfc="white", mew=0.9, zorder=5, clip_on=False,
        )  # fmt: skip
    ax.set(
        xlabel="time after the peak [s]",
        ylabel=r"displacement $|\Delta|$ [mm]",
        xlim=(0, None),
        ylim=(0, None),
    )
    ax.legend()


@thesis_panels(Source.COMPUTED, 7.6, 3.4)
def figure_4_35(figure: Figure) -> None:
    """Restoring force F_k of the wall against displacement, 4-30, and -M a at measured peaks.

    The force of 4-30 is the exact derivative of the energies, where the thesis has differences.
    The points are -M_e a at the peaks of Table A-1, by 4-42, with the whole mass for M_e.
    """
    measured = identification.FreeVibration.table_a1()
    rows = measured.at_peak & legible()
    left, right = overview_and_origin(figure)
    stronger = analysis.Wall.thesis(111e3)
    for ax, far in ((left, 0.055), (right, 0.012)):
        d = symmetric(far)
        ax.set_prop_cycle(color=style.LINES)
        ax.plot(d * MM, WALL.restoring_force(d) / 1e3, label="4-30, 75.6 kN")
        ax.plot(d * MM, 1.06 * WALL.restoring_force(d) / 1e3, "--", label="6 % more")
        ax.plot(d * MM, stronger.restoring_force(d) / 1e3, ":", label="4-30, 111 kN")
        near = rows & (np.abs(measured.displacement) < far)
        force = back_calculated_force(WALL.mass, measured.acceleration)
        at = measured.displacement[near] * MM
        ax.plot(at, force[near] / 1e3, "o", ms=3.6, label="measured, 75.6 kN", **OPEN)
    d = np.linspace(2e-3, 0.012, 2001)
    force = WALL.restoring_force(d)
    top = int(force[: len(d) // 2].argmax())
    low = top + int(force[top:].argmin())
    for row, place in ((top, (-11.5, 24.0)), (low, (3.5, -4.0))):
        at = (d[row] * MM, force[row] / 1e3)
        right.annotate(
            f"{at[1]:.1f} kN at {at[0]:.1f} mm", at, place, fontsize=8,
            arrowprops={"arrowstyle": "-", "color": style.INK, "lw": 0.6},
        )  # fmt: skip
    yields = WALL.yield_displacement()
    left.annotate(
        "tendon yields",
        (yields * MM, WALL.restoring_force(yields) / 1e3),
        (-40, -30),
        textcoords="offset points",
        fontsize=8,
        arrowprops={"arrowstyle": "-", "color": style.INK, "lw": 0.6},
    )
    left.set_ylabel("restoring force $F_k$ [kN]")
    left.legend(loc="upper left", fontsize=7.5)
