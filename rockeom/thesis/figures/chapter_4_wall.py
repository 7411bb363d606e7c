"""The figures of chapter 4, the controlled rocking wall; see `rockeom.thesis.figures`.

The measured points are those of Table A-1, the peaks and the zero crossings of the free vibration;
of the continuous record nothing else is printed. Rows of which a number had to be guessed are left
out. A zero crossing is an instant without acceleration, so that its displacement is not zero.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics, formulas, identification
from rockeom.analysis.unfinished import finished
from rockeom.plots import free_body as fb, style
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.thesis.figures.chapter_2_blocks import draw_branch
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.free_vibration_table import STIFFER, WALL
from rockeom.thesis.shaken import sylmar_360, wall_motion
from rockeom.thesis.wall_tests import back_calculated_force, quarter_period_fit

MM = 1e3
GAUGE = 0.030
"""From the edge of the wall out to the uplift gauge [m]."""

CORNER = formulas.RotationCentre(C1=WALL.half_width, C2=0.0, epsilon=WALL.rotation_centre.epsilon)
"""The path of 4-37, which ends at the edge."""
RATIOS = 101
"""How many r Figure 4-71 has."""


def legible() -> np.ndarray:
    """(45,) whether a row of Table A-1 is one of which no number had to be guessed."""
    return np.asarray(identification.FreeVibration.table_a1().reading) != "guessed"


def draw_measured(ax: Axes, column: str, unit: float, label: str = "") -> None:
    """A column of Table A-1, over its unit, against the displacement in mm.

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


def symmetric(largest: float, number: int = 1201) -> np.ndarray:
    """(number,) displacements from -largest to largest [m], closer together about zero."""
    s = np.linspace(-1.0, 1.0, number)
    return largest * s * np.abs(s)


def overview_and_origin(width: float = 7.6) -> tuple[Figure, Axes, Axes]:
    """A figure of two axes side by side: all displacements, and those about zero."""
    figure = style.new_figure(width, 3.4)
    left, right = figure.subplots(1, 2)
    for ax, title in ((left, "a) all displacements"), (right, "b) about upright")):
        ax.set_title(title, fontsize=9)
        ax.set_xlabel(r"displacement $\Delta$ [mm]")
    return figure, left, right


# --- where the wall turns, and what follows from it


@thesis_figure(Source.COMPUTED)
def figure_4_17() -> Figure:
    """Distance of the rotation centre from the edge against the displacement: 4-7 and Table A-1.

    The distances of the table count from the uplift gauge, 30 mm outside the edge: at the peaks
    its own uplifts of the edges place the centre 30 mm nearer. Referred to the edge, 4-7 has 442
    and 66 mm in place of the printed 412 and 96 mm. All are drawn here as seen from the gauge.
    """
    measured = identification.FreeVibration.table_a1()
    d = symmetric(0.032)
    printed, edge = formulas.RotationCentre.thesis_gauge(), formulas.RotationCentre.thesis_edge()
    figure = style.new_figure(6.6, 3.6)
    ax = figure.add_subplot()
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
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel("distance from the gauge [mm]")
    ax.set_ylim(0, 600)
    ax.legend(loc="upper left", fontsize=7.5)
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_18() -> Figure:
    """Uplift of both edges of the base against the displacement: 4-9 and Table A-1.

    The curve of 4-9 is continued to the pressed edge, which it takes down by
    (B - b) sin(theta).
    """
    measured = identification.FreeVibration.table_a1()
    figure, *axes = overview_and_origin()
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
    return figure


def tilted_wall(ax: Axes, b: float, theta: float) -> dict[str, np.ndarray]:
    """The wall of Figure 4-4 turned clockwise through theta about a point b from its centreline.

    Returns its points: the rotation centre, the edges, the foot and the top of the tendon on the
    centreline, and the centroid.
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


@thesis_figure(Source.COMPUTED)
def figure_4_19() -> Figure:
    """Geometry of the extension of the tendon: the wall turned about O in its base.

    Drawn to scale, but turned much further than in any of the tests. The base is straight and the
    pressed edge enters the ground, as 4-1 has it.
    """
    figure = style.new_figure(7.4, 4.2)
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
    return figure


class TendonOfTable(NamedTuple):
    """The rows of Table A-1 that tell the force of the tendon.

    displacement [m], force [N] (n,); legible, peaks (n,) : which rows are legible, which of these
    are peaks. fit : of the initial force and the stiffness of 4-16 to these peaks.
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

    def statements(self, edge: analysis.Wall) -> tuple[Statement, ...]:
        """Of 4-16 with 4-7 as printed, and from the edge of the wall."""
        r2 = {
            wall: (self.r_squared(wall, self.legible), self.r_squared(wall, self.peaks))
            for wall in (WALL, edge)
        }
        large = self.peaks & (np.abs(self.displacement) > 6e-3)
        above = [
            (wall.tendon_force(self.displacement[large]) - self.force[large]) / 1e3 for wall in r2
        ]
        low, high = self.fit.interval("factor")
        factor, start = self.fit.values["factor"], self.fit.values["start"]
        return (
            Statement(
                "4.6", "R2 = 0.927 of 4-16",
                f"R2 = {r2[WALL][0]:.3f} at all legible rows of Table A-1, {r2[WALL][1]:.3f} at "
                f"its peaks; {r2[edge][0]:.3f} and {r2[edge][1]:.3f} with "
                "4-7 from the edge. The text's is of the whole record, which is not printed",
                None,
            ),
            Statement(
                "4.6", "4-16 matches the data adequately",
                f"it lies {above[0].min():.1f} to {above[0].max():.1f} kN, on average "
                f"{above[0].mean():.1f}, above the {large.sum()} peaks beyond 6 mm; "
                f"{above[1].min():.1f} to {above[1].max():.1f} kN with 4-7 from the edge",
                False,
            ),
            Statement(
                "4.6", "4-16 with the EA/L of the tendon",
                f"{WALL.tendons[0].stiffness / 1e6:.2f} kN/mm; the peaks ask for {factor:.3f} of "
                f"it ({low:.3f} to {high:.3f}), from {start / 1e3:.1f} kN on; "
                f"R2 = {self.fit.r_squared:.3f}",
                bool(low < 1 < high),
            ),
        )  # fmt: skip


def tendon_line(d: np.ndarray, start: float, factor: float) -> np.ndarray:
    """4-16 with an initial force [N] and a factor of its stiffness."""
    return start + factor * WALL.tendons[0].stiffness * WALL.tendon_extension(d)


@thesis_figure(Source.COMPUTED)
def figure_4_20() -> Drawn:
    """Force of the tendon against the displacement: 4-16 and Table A-1.

    With the stiffness of appendix B, an unstressed length of 3093.5 mm; 4-16 adds the extension
    to the distance of the anchors instead of taking it off. The curve lies above the peaks. Dotted
    is 4-16 with its initial force and its stiffness fitted to the legible peaks.
    """
    measured = TendonOfTable.fitted()
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    figure, *axes = overview_and_origin()
    for ax, far in zip(axes, (0.032, 0.005), strict=True):
        d = symmetric(far)
        line = tendon_line(d, **measured.fit.values)
        ax.set_prop_cycle(color=style.LINES)
        ax.plot(d * MM, WALL.tendon_force(d) / 1e3, label="4-16 with 4-7 as printed")
        ax.plot(d * MM, edge.tendon_force(d) / 1e3, "--", label="4-16 with 4-7 from the edge")
        ax.plot(d * MM, line / 1e3, ":", label="stiffness fitted to peaks")
        draw_measured(ax, "tendon_force", 1e3)
    axes[0].set_ylabel("tendon force $P$ [kN]")
    axes[0].set_ylim(70, 175)
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set_xlim(-5, 5)
    axes[1].set_ylim(74, 88)
    return Drawn(figure, measured.statements(edge))


# --- quarter periods and conservative motion


@thesis_figure(Source.COMPUTED)
def figure_4_24() -> Drawn:
    """Quarter periods against the peak: 4-17, the fit 4-5, quadrature, and Table A-1.

    Not in the thesis: the time of a conservative motion to upright, 4-24. It ends at D = 0, the
    measured one at the instant without acceleration, a millimetre or two before.
    """
    measured = identification.FreeVibration.table_a1()
    starts = np.flatnonzero(measured.at_peak[:-1])
    starts = starts[legible()[starts] & legible()[starts + 1]]
    peak, time = measured.displacement[starts], np.diff(measured.time)[starts]
    d = np.linspace(1e-3, 0.032, 200)
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    ax.set_prop_cycle(color=style.LINES)
    heavier = replace(WALL, inertia=13215.0)
    printed = r"4-17, $I_o$ = 13 215 kg m$^2$ (B-9 as printed)"
    ax.plot(
        d * MM, WALL.quarter_period_substitute_gravity(d), label=r"4-17, $I_o$ = 12 101 kg m$^2$"
    )
    ax.plot(d * MM, heavier.quarter_period_substitute_gravity(d), ":", label=printed)
    ax.plot(d * MM, quarter_period_fit(d), "--", label="4-5, fitted")
    ax.plot(d * MM, WALL.quarter_period_exact(d), "-.", label="4-24, no losses, to upright")
    for side, mark, name in ((1, ">", "to the right"), (-1, "<", "to the left")):
        rows = np.sign(peak) == side
        ax.plot(
            np.abs(peak[rows]) * MM, time[rows], mark, color=style.INK, ms=4, mfc="white", mew=0.9,
            label=f"Table A-1, from peaks {name}",
        )  # fmt: skip
    ax.set_xlabel(r"peak displacement $|\Delta_0|$ [mm]")
    ax.set_ylabel("quarter period [s]")
    ax.set_xlim(0, 33)
    ax.set_ylim(0, 0.085)
    ax.legend(loc="lower right", fontsize=7.5)
    every = np.flatnonzero(measured.at_peak[:-1])

    def r_squared(wall: analysis.Wall, rows: np.ndarray) -> float:
        predicted = wall.quarter_period_substitute_gravity(np.abs(measured.displacement[rows]))
        return identification.coefficient_of_determination(np.diff(measured.time)[rows], predicted)

    r2 = [r_squared(wall, every) for wall in (heavier, WALL)]
    clear = [r_squared(wall, starts) for wall in (heavier, WALL)]
    return Drawn(
        figure,
        (
            Statement(
                "4.7", "R2 = 0.911 of 4-17",
                f"R2 = {r2[0]:.3f} with 13 215 kg m2, {r2[1]:.3f} with 12 101 kg m2, of all "
                f"22 quarters; {clear[0]:.3f} and {clear[1]:.3f} of the {len(starts)} legible",
                bool(abs(r2[0] - 0.911) < 2e-3),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_32() -> Figure:
    """Trajectories without losses from measured peaks, 4-23, and the measured zero crossings.

    Only both ends of the measured trajectories are printed, in Table A-1. Their distance from the
    curves at the zero crossing is the energy lost by then: about half of r.
    """
    measured = identification.FreeVibration.table_a1()
    figure = style.new_figure(6.4, 4.0)
    ax = figure.add_subplot()
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
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel(r"velocity $\dot\Delta$ [m/s]")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=7.5)
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_33() -> Figure:
    """Displacement in time without losses, 4-24, from five measured peaks to upright.

    The thesis does not say which five; here the 1st, 5th, 9th, 13th and 17th peak of Table A-1,
    each with the zero crossing after it. At the crossing of the first three the wall is 3 to 5 ms
    ahead of the curve, which the 6 % more of F_k in 4.8.1 make up for in part.
    """
    measured = identification.FreeVibration.table_a1()
    figure = style.new_figure(6.4, 3.6)
    ax = figure.add_subplot()
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
    ax.set_xlabel("time after the peak [s]")
    ax.set_ylabel(r"displacement $|\Delta|$ [mm]")
    ax.set_xlim(0, None)
    ax.set_ylim(0, None)
    ax.legend()
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_35() -> Figure:
    """Restoring force F_k of the wall against displacement, 4-30, and -M a at measured peaks.

    The force of 4-30 is the exact derivative of the energies, where the thesis has differences.
    Measured is -M_e a at the peaks of Table A-1, as 4-42 has it, with the whole mass for M_e.
    """
    measured = identification.FreeVibration.table_a1()
    rows = measured.at_peak & legible()
    figure, left, right = overview_and_origin()
    stronger = analysis.Wall.thesis(111e3)
    for ax, far in ((left, 0.055), (right, 0.012)):
        d = symmetric(far)
        ax.set_prop_cycle(color=style.LINES)
        ax.plot(d * MM, WALL.restoring_force(d) / 1e3, label="4-30, 75.6 kN")
        ax.plot(d * MM, 1.06 * WALL.restoring_force(d) / 1e3, "--", label="6 % more")
        ax.plot(d * MM, stronger.restoring_force(d) / 1e3, ":", label="4-30, 111 kN")
        near = rows & (np.abs(measured.displacement) < far)
        force = back_calculated_force(WALL.mass, measured.acceleration)
        ax.plot(
            measured.displacement[near] * MM, force[near] / 1e3, "o", color=style.INK, ms=3.6,
            mfc="white", mew=0.9, label="measured, 75.6 kN",
        )  # fmt: skip
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
    return figure


# --- the motion in time


class History(NamedTuple):
    """(n,) times [s] and the displacement Delta [m], its rate [m/s] and acceleration [m/s2]."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


def released(structure: rk.Structure, law: ImpactLaw | None = None) -> History:
    """The free vibration from the first peak of Table A-1, whose last peak is at 1.91 s."""
    start = float(identification.FreeVibration.table_a1().displacement[0])
    oscillates = isinstance(structure, rk.ControlledWallOscillator)
    initial = {"u": start} if oscillates else {"theta": float(WALL.rotation(start))}
    run = rk.simulate(structure, rk.GroundMotion.none(2.0), impact=law, initial=initial)
    if oscillates:
        mass = structure.parameters()["effective_mass"]
        return History(run.t, run["u"], run["u_dot"], run["horizontal_reaction"] / mass)
    theta, rate = run["theta"], run["theta_dot"]
    turning = np.empty(len(run.t))
    for phase in np.unique(run.mode):
        rows = run.mode == phase
        state = {name: run[name][rows] for name in run.states}
        turning[rows] = structure.accelerations(state, mode=str(phase))["theta"]
    h, sin, cos = WALL.height, np.sin(theta), np.cos(theta)  # 4-33 to 4-35
    return History(run.t, h * sin, h * cos * rate, h * (turning * cos - rate**2 * sin))


def draw_histories(curves: list[tuple[str, History, dict[str, Any]]]) -> Figure:
    """Displacement, velocity and acceleration of each, and the points of Table A-1."""
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    figure = style.new_figure(7.6, 5.6)
    axes = figure.subplots(3, 1, sharex=True)
    for label, history, line in curves:
        for ax, y, unit in zip(axes, history[1:], (MM, 1.0, 1.0), strict=True):
            ax.plot(history.time, y * unit, label=label, **line)
    columns = (measured.displacement * MM, measured.velocity, measured.acceleration)
    for ax, y in zip(axes, columns, strict=True):
        ax.plot(
            measured.time[chosen], y[chosen], "o", color=style.INK, mfc="white", mew=0.8, ms=3.2,
            label="Table A-1", zorder=5,
        )  # fmt: skip
    names = (r"$\Delta$ [mm]", r"$\dot\Delta$ [m/s]", r"$\ddot\Delta$ [m/s$^2$]")
    for ax, name in zip(axes, names, strict=True):
        ax.set_ylabel(name)
    axes[2].set_xlabel("time [s]")
    axes[2].set_xlim(0, 2)
    style.legend_above(axes[0])
    figure.align_ylabels(axes)
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_37() -> Figure:
    """Free vibration of the equivalent oscillator with r of 4-31, and Table A-1.

    As the text has it: the effective mass is all of the mass, n is the epsilon of 4-7, F_k is
    raised by 6 % (here the mass is lowered by as much, which is the same equation), and r is that
    of the instantaneous velocity, so that it changes within a passage. Dashed: r of a whole
    passage is that of the speed with which the wall would come upright without losses. The second
    and third passages then exceed the limit of 0.78 m/s and lose 5 % instead of 15 %.
    """
    law = rk.EnergyRatioAtSpeed.equation_4_31()
    curves = []
    for label, held, line in (
        ("r of the instantaneous speed", False, {"color": style.LINES[0]}),
        ("r of the whole passage", True, {"color": style.LINES[1], "ls": "--", "lw": 0.8}),
    ):
        wall = rk.ControlledWallOscillator.from_wall(
            WALL, law, held=held, effective_mass=WALL.mass / STIFFER
        )
        curves.append((label, released(wall), line))
    return draw_histories(curves)


# --- the substitute-gravity wall


@thesis_figure(Source.COMPUTED)
def figure_4_44() -> Figure:
    """Changes of R, alpha and b' by a rotation centre that moves, and its path: 4-37.

    4-37 lets the centre go to the edge of the wall, 508 mm, where 4-7, which the tendon's force
    still follows, stops 96 mm before. Both are drawn.
    """
    figure = style.new_figure(7.6, 3.8)
    wall, path = figure.subplots(1, 2, width_ratios=(1.0, 1.7))
    theta, b = 0.12, 0.34
    at = tilted_wall(wall, b, theta)
    fb.line(wall, at["centre"], at["centroid"])
    axis = at["centre"] + 2.3 * np.array([np.sin(theta), np.cos(theta)])
    fb.line(wall, at["centre"], axis)
    fb.angle(wall, at["centre"], at["centroid"], axis, 1.25, r"$\alpha$", label_radius=1.12)
    fb.centroid(wall, at["centroid"])
    wall.annotate("$R$", (at["centre"] + at["centroid"]) / 2, (-10, -8), textcoords="offset points")
    fb.pivot(wall, at["centre"], "$O$", (11, -9))
    fb.dimension(wall, at["foot"], at["centre"], "$b'$", shift=-0.2, offset=(-2, -8))
    wall.set(xlim=(-1.0, 1.2), ylim=(-0.45, 2.75))

    d = symmetric(0.032)
    path.set_prop_cycle(color=style.LINES)
    path.plot(d * MM, CORNER.distance(d) * MM, label="4-37: 508 mm")
    path.plot(d * MM, WALL.rotation_centre.distance(d) * MM, "--", label="as 4-7: 412 mm")
    path.set_xlabel(r"displacement $\Delta$ [mm]")
    path.set_ylabel("$b'$ [mm]")
    path.legend(loc="lower right")
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_46() -> Figure:
    """What 10 % of n change: the half-width b' of 4-37 and the force of the tendon, 4-16.

    n is the epsilon of 4-7, 3.551 mm.
    """
    figure = style.new_figure(7.6, 3.2)
    left, right = figure.subplots(1, 2)
    d = symmetric(0.015)
    for color, line, factor in ((style.LINES[1], "--", 0.9), (style.LINES[0], "-", 1.0),
                                (style.LINES[2], "-.", 1.1)):  # fmt: skip
        n = factor * WALL.rotation_centre.epsilon
        wall = replace(WALL, rotation_centre=replace(WALL.rotation_centre, epsilon=n))
        corner = replace(CORNER, epsilon=n)
        kind = {"color": color, "ls": line, "label": f"{factor:.1f} n = {n * MM:.2f} mm"}
        left.plot(d * MM, corner.distance(d) * MM, **kind)
        right.plot(d * MM, wall.tendon_force(d) / 1e3, **kind)
    for ax, name in ((left, "$b'$ [mm]"), (right, "tendon force $P$ [kN]")):
        ax.set_xlabel(r"displacement $\Delta$ [mm]")
        ax.set_ylabel(name)
        ax.legend(loc="lower right" if ax is left else "upper center", fontsize=7.5)
    return figure


def substitute_gravity(factor: float = 1.0) -> rk.SubstituteGravityWall:
    """The wall of 4-37, its n times a factor."""
    n = factor * WALL.rotation_centre.epsilon
    return rk.SubstituteGravityWall.from_wall(
        replace(WALL, rotation_centre=replace(WALL.rotation_centre, epsilon=n))
    )


@thesis_figure(Source.COMPUTED)
def figure_4_45() -> Figure:
    """Free vibration of the substitute-gravity wall with r of 4-38, and Table A-1.

    The rotation centre moves by 4-37, to the edge; the tendon's force is that of 4-16. The moment
    of inertia is 12 101 kg m2 about a corner, a constant; the text does not say which it has.
    Dashed: 13 215 kg m2, which is B-9 as printed.
    """
    law = rk.EnergyRatioAtSpeed.equation_4_38()
    heavier = rk.SubstituteGravityWall.from_wall(replace(WALL, inertia=13215.0))
    return draw_histories(
        [
            (r"$I_o$ = 12 101 kg m$^2$", released(substitute_gravity(), law),
             {"color": style.LINES[0]}),
            (r"$I_o$ = 13 215 kg m$^2$", released(heavier, law),
             {"color": style.LINES[1], "ls": "--", "lw": 0.8}),
        ]
    )  # fmt: skip


def draw_displacements(curves: list[tuple[str, History]]) -> Figure:
    """The displacement of each in time, the first as the one to compare with.

    Below is by how much the others differ from it, so that none hides another.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    figure = style.new_figure(7.6, 4.6)
    ax, below = figure.subplots(2, 1, sharex=True, height_ratios=(2.0, 1.0))
    reference = curves[0][1]
    for (label, history), color, line in zip(
        curves, (style.LINES[0], *style.LINES[1:4]), ("-", "--", "-.", ":"), strict=False
    ):
        kind: dict[str, Any] = {"ls": line, "color": color}
        ax.plot(history.time, history.displacement * MM, label=label, **kind)
        if history is not reference:
            off = history.displacement - np.interp(
                history.time, reference.time, reference.displacement
            )
            below.plot(history.time, off * MM, **kind)
    ax.plot(
        measured.time[chosen], measured.displacement[chosen] * MM, "o", color=style.INK,
        mfc="white", mew=0.8, ms=3.0, label="Table A-1", zorder=5,
    )  # fmt: skip
    below.axhline(0.0, color=style.LINES[0], lw=0.8)
    below.set_xlabel("time [s]")
    ax.set_ylabel(r"displacement $\Delta$ [mm]")
    below.set_ylabel(f"less {curves[0][0]} [mm]")
    ax.set_xlim(0, 2)
    style.legend_above(ax)
    figure.align_ylabels((ax, below))
    return figure


@thesis_figure(Source.COMPUTED)
def figure_4_47() -> Figure:
    """What 10 % of n change in the free vibration of the substitute-gravity wall with 4-38.

    By themselves next to nothing, as the thesis says. But with 1.1 n the third passage has
    0.779 m/s, just below the limit of 0.78 m/s where r of 4-38 falls from 0.94 to 0.85, and all
    later peaks are lower.
    """
    law = rk.EnergyRatioAtSpeed.equation_4_38()
    return draw_displacements(
        [
            (f"{factor:.1f} n", released(substitute_gravity(factor), law))
            for factor in (1.0, 0.9, 1.1)
        ]
    )


def bands_raised(
    law: rk.EnergyRatioAtSpeed, by: float = 0.02
) -> list[tuple[str, rk.EnergyRatioAtSpeed]]:
    """A law with r larger in one of its three faster bands at a time, and what to call each."""
    laws = []
    for band in (3, 2, 1):
        pieces = list(law.pieces)
        limit, r, slope = pieces[band]
        pieces[band] = (limit, r + by, slope)
        laws.append((f"{r:.2f} → {r + by:.2f}", rk.EnergyRatioAtSpeed(tuple(pieces))))
    return laws


def moved(curves: list[tuple[str, History]]) -> list[float]:
    """By how much each curve but the first differs from it at most [mm]."""
    first = curves[0][1]
    return [
        float(np.abs(np.interp(first.time, h.time, h.displacement) - first.displacement).max() * MM)
        for _, h in curves[1:]
    ]


@thesis_figure(Source.COMPUTED)
def figure_4_48() -> Drawn:
    """Effect of small changes of r in 4-38 on the free vibration of the substitute-gravity wall.

    The text does not state the deviations of the thesis. Here r is 0.02 larger in one of the three
    faster bands at a time. In the fastest one this brings one more passage, with 0.783 m/s, over
    the limit of 0.78 m/s. In the slowest of them it moves the wall so little that its curve lies
    under that of 4-38: the differences stand below.
    """
    law = rk.EnergyRatioAtSpeed.equation_4_38()
    curves = [("4-38", released(substitute_gravity(), law))]
    for label, changed in bands_raised(law):
        curves.append((label, released(substitute_gravity(), changed)))
    off = ", ".join(f"{by:.1f}" for by in moved(curves))
    return Drawn(
        draw_displacements(curves),
        (
            Statement(
                "4.8.3", "the response is moderately sensitive to r, most where it changes early",
                f"r larger by 0.02 in the fastest band and the next two moves the wall by up to "
                f"{off} mm",
                bool(np.all(np.diff(moved(curves)) < 0)),
            ),
        ),
    )  # fmt: skip


# --- shaking


@thesis_figure(Source.IN_KIND)
def figure_4_71() -> Drawn:
    """Peaks of the oscillator in test run 4 for many r about 0.852.

    The motion of the table is not printed. Here it is the record that was meant, Northridge 1994,
    Sylmar 360, its time scaled by 0.6 (Table 4-1). The measured curve of the thesis is
    replaced by the response with r = 0.852. The oscillator is that of 4-37, with all of its mass
    driven by the ground (4-39).
    """
    record = wall_motion("4")
    ratios = 0.852 * np.linspace(0.9, 1.1, RATIOS)

    def shaken(r: float) -> rk.Case:
        wall = rk.ControlledWallOscillator.from_wall(
            WALL, float(r), effective_mass=WALL.mass / STIFFER
        )
        return rk.Case(wall, record)

    sweep = finished(rk.simulate_many(shaken, over={"r": ratios}))
    peaks = sweep.peak.sel(state="u").values
    reference = peaks[len(ratios) // 2]
    figure = style.new_figure(7.6, 3.4)
    left, right = figure.subplots(1, 2)
    left.plot(ratios, peaks * MM, ".-", ms=3, lw=0.5, color=style.LINES[0])
    left.plot(0.852, reference * MM, "o", ms=6, mfc="none", color=style.LINES[1])
    left.annotate(
        "r = 0.852", (0.852, reference * MM), (-20, 14), textcoords="offset points", fontsize=8
    )
    left.set_xlabel("energy ratio $r$ [-]")
    left.set_ylabel(r"largest $|\Delta|$ [mm]")
    left.set_ylim(0, None)
    over = np.sort(peaks) / reference
    right.step(over, 1 - np.arange(len(over)) / len(over), color=style.LINES[0], where="pre")
    right.axvline(1.0, color=style.LINES[1], lw=0.9)
    right.set_xlabel("ratio to the peak at r = 0.852 [-]")
    right.set_ylabel("part of the analyses at or above [-]")
    right.set_ylim(0, 1.02)
    conservative = float(np.mean(np.delete(peaks, len(ratios) // 2) >= reference))
    jumps = np.sign(np.diff(peaks))
    turns = int(np.count_nonzero(jumps[1:] * jumps[:-1] < 0))
    return Drawn(figure, (
        Statement(
            "4.9.1.4", "11 % of the analyses were conservative, against the measured peak of "
            "23.9 mm",
            f"{100 * conservative:.0f} % reach the {reference * MM:.2f} mm of r = 0.852; the "
            f"largest peak is {peaks.max() * MM:.1f} mm, {100 * np.mean(peaks * MM >= 23.91):.0f} "
            "% reach 23.9 mm",
            bool(abs(conservative - 0.11) < 0.05),
        ),
        Statement(
            "4.9.1.4", "very sensitive to r, without any trend",
            f"from {peaks.min() * MM:.2f} to {peaks.max() * MM:.2f} mm; of {len(ratios) - 2} inner "
            f"peaks {turns} are turning points",
            bool(turns > 0.3 * len(ratios) and np.ptp(peaks) > 0.3 * reference),
        ),
        time_scale_of_run_4(),
    ))  # fmt: skip


def time_scale_of_run_4() -> Statement:
    """Peaks of run 4 with the time scale of Tabas in place of the one printed."""
    as_of = {scale: sylmar_360().scaled(time=scale) for scale in (0.6, 0.38)}
    oscillator = rk.ControlledWallOscillator.from_wall(
        WALL, 0.852, effective_mass=WALL.mass / STIFFER
    )
    peaks = {
        scale: MM * abs(rk.simulate(oscillator, record).extremes("u").peak)
        for scale, record in as_of.items()
    }
    speeds = {
        scale: float(np.abs(np.cumsum(record.sampled(1e-3)[1])).max() * 1e-3)
        for scale, record in as_of.items()
    }
    return Statement(
        "Table 4-1", "the time of Sylmar is scaled by 0.6; PGV 0.743 m/s; 23.9 mm were measured",
        f"with r = 0.852 it gives {peaks[0.6]:.1f} mm, but {peaks[0.38]:.1f} mm scaled by 0.38 as "
        f"Tabas is; the PGV of 0.6 is {speeds[0.6]:.3f} m/s, of 0.38 {speeds[0.38]:.3f} m/s",
        None,
    )  # fmt: skip


CYCLES = 120
"""Periods of the ground in which a motion of Figure 4-73 settles."""


def settled_speeds(
    frequency: float, amplitude: float, start: dict[str, float]
) -> tuple[np.ndarray, dict[str, float]]:
    """Velocities when upright [m/s] after `CYCLES` of a harmonic shaking, and the last state."""
    wall = rk.ControlledWallOscillator.from_wall(WALL, 0.852, effective_mass=WALL.mass / STIFFER)
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=(CYCLES + 40) * period)
    options = rk.SolverOptions(rtol=1e-9, atol=1e-11, output_step=period)
    run = rk.simulate(wall, motion, initial=start, options=options)
    passages = [e.before for e in run.events if e.time > CYCLES * period]
    speeds = [
        state["u_dot"] for state in passages if abs(state["u"]) < 1e-9
    ]  # not those of the core
    return np.array(speeds), {name: run.final[name] for name in ("u", "u_dot")}


def stroboscope(frequency: float, amplitude: float) -> dynamics.StroboscopicMap:
    """The oscillator under Z sin(2 pi f t), by its displacement and velocity once a period."""
    wall = rk.ControlledWallOscillator.from_wall(WALL, 0.852, effective_mass=WALL.mass / STIFFER)
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=2 * period)
    return dynamics.StroboscopicMap(wall, motion, period, states=("u", "u_dot"))


def upright_velocities(branch: dynamics.OrbitBranch) -> np.ndarray:
    """(k, m) velocities when upright of each motion of a branch [m/s], a passage a column.

    Each row is turned so that it continues the one before; where their number changes new columns
    begin, and what is not there is nan.
    """
    rows = [
        [e.before["u_dot"] for run in orbit.runs for e in run.events if abs(e.before["u"]) < 1e-9]
        for orbit in branch.orbits
    ]
    groups = [list(group) for _, group in groupby(rows, len)]
    table = np.full((len(rows), sum(len(group[0]) for group in groups)), np.nan)
    lines = iter(table)
    first = 0
    for group in groups:
        last = np.array(group[0])
        for row, line in zip(group, lines, strict=False):
            turns = [np.roll(row, k) for k in range(len(row))]
            last = turns[int(np.argmin([np.abs(turn - last).max() for turn in turns]))]
            line[first : first + len(row)] = last
        first += len(group[0])
    return table


DOUBLING = (0.000228, 0.0341)
"""Displacement [m] and velocity [m/s] of the motion at 4.553 Hz and 6.02 m/s2 that will double."""


def branches_of(frequency: float, start: ArrayLike) -> list[dynamics.OrbitBranch]:
    """Motions of one period from 6.02 m/s2 down and up, and those that double there, if any do."""

    def at(amplitude: float) -> dynamics.StroboscopicMap:
        return stroboscope(frequency, amplitude)

    down, up = (finished(dynamics.orbit_branch(at, (6.02, end), start)) for end in (5.6, 6.5))
    flips = [one for one in up.bifurcations if one.kind == "period doubling"]
    return [down, up, *(finished(up.switched(one)) for one in flips[:1])]


@thesis_figure(Source.COMPUTED)
def figure_4_73() -> Figure:
    """Velocities when upright under Z sin(16 pi t): at 8 Hz nothing splits, at 4.553 Hz it does.

    The thesis has one line for Z from 5.7 to 6.0 m/s2, a period that doubles at 6.03, and a smear
    from 6.2 on. At its 8 Hz the oscillator has one motion, its own mirror image, from each of
    three starts (left). The multipliers of that motion stay complex from 5 to 7 m/s2, of size
    0.85, so that its period cannot double.

    The description of the thesis fits 4.553 Hz (right), chosen so that the period doubles at 6.03;
    the smear from 6.21 on then follows. Black is a motion of four passages a cycle,
    followed from 6.02 up and down. Orange dots are motions from rest: below 5.97 they settle to one
    of two passages a cycle, which stays stable beside the other. A third, with passages of 0.8 m/s,
    is out of the picture. The oscillator is that of 4-37 with the constant r = 0.852.
    """
    figure = style.new_figure(7.6, 3.6)
    stated, sought = figure.subplots(1, 2)

    def dots(ax: Axes, z: float, speeds: np.ndarray, color: str, size: float) -> None:
        ax.plot(np.full_like(speeds, z), speeds, ".", ms=size, mew=0, color=color)

    for z in np.linspace(5.6, 6.5, 19):
        for start in ({"u": 0.0}, {"u": 0.02}, {"u": 0.004, "u_dot": -0.6}):
            dots(stated, z, settled_speeds(8.0, z, start)[0], style.INK, 3.0)
        dots(sought, z, settled_speeds(4.553, z, {"u": 0.0})[0], style.LINES[1], 3.5)
    for way in (np.arange(6.02, 5.59, -0.02), np.arange(6.02, 6.5, 0.01)):
        state = dict(zip(("u", "u_dot"), DOUBLING, strict=True))
        for z in way:
            speeds, state = settled_speeds(4.553, z, state)
            dots(sought, z, speeds, style.INK, 2.0)
    settled = stroboscope(8.0, 6.02).points({"u": 0.004, "u_dot": 0.2}, 60)[-1]
    for ax, frequency, first in ((stated, 8.0, settled), (sought, 4.553, DOUBLING)):
        for branch in branches_of(frequency, first):
            draw_branch(ax, branch, upright_velocities(branch))
    stated.set_title("8 Hz, as stated", fontsize=9)
    sought.set_title("4.553 Hz, sought", fontsize=9)
    for ax, reach in ((stated, 0.6), (sought, 0.3)):
        ax.axvline(6.03, color=style.INK, lw=0.6, ls=":")
        ax.set_xlabel("amplitude $Z$ [m/s$^2$]")
        ax.set_ylim(-reach, reach)
    stated.set_ylabel(r"velocity when upright $\dot\Delta$ [m/s]")
    return figure
