"""Figures of 4.9.1: the wall of chapter 4 on the shaking table, and trials of its oscillator.

The traces of the tests are lost; Table 4-2 has the largest displacements and tendon forces.
Test run 4 was shaken by Northridge 1994, Sylmar 360, in 0.6 of its time: the component is made of
those at 32 and 122 degrees in FEMA P695's near-field set, and has the table's peak of 8.273 m/s2.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import design, formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures.chapter_4_wall import (
    MM,
    draw_measured,
    legible,
    overview_and_origin,
    symmetric,
)
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_2
from rockeom.thesis.shaken import wall_motion
from rockeom.thesis.wall_tests import back_calculated_force, energy_ratio_4_31

SPREAD = 2.5e-3
"""The sliding that 4.9.1.1 makes of its scatter [m], to either side."""
RUNS = ("1", "2", "3", "4", "6")
"""The tests with 75 kN."""
MEASURED_PEAK = -23.91e-3
"""Largest displacement of test run 4, Table 4-2 [m]."""
RATIO = 0.852


def rows_of_75_kn() -> dict[str, np.ndarray]:
    """Displacement [m], tendon force before and largest [N], change of alignment [m]; (5,) each."""
    chosen = [row for row in TABLE_4_2.rows if row[0] in RUNS]
    names = ("displacement", "before", "largest", "after", "alignment")
    columns = zip(*(row[1:] for row in chosen), strict=True)
    unit = (1e-3, 1e3, 1e3, 1e3, 1e-3)
    return {n: u * np.array(c, dtype=float) for n, u, c in zip(names, unit, columns, strict=True)}


def bending(displacement: np.ndarray) -> np.ndarray:
    """How far the wall bends under F_k [m], with the stiffness of its fixed-base period."""
    stiffness = WALL.mass * (2 * np.pi / WALL.fixed_base_period) ** 2
    return WALL.restoring_force(displacement) / stiffness


@thesis_figure(Source.IN_KIND)
def figure_4_57() -> Drawn:
    """Uplifts of both edges against the displacement, and the sliding read from them.

    The measured uplifts of the shaking-table tests are lost: drawn are 4-9, which the thesis finds
    to hold for them unchanged, the points of the free vibration in Table A-1, and a band of
    2.5 mm of sliding to either side.
    """
    measured, chosen = identification.FreeVibration.table_a1(), legible()
    figure, *axes = overview_and_origin()
    b = WALL.half_width
    for ax, far in zip(axes, (0.032, 0.008), strict=True):
        d = symmetric(far + SPREAD)
        near = chosen & (np.abs(measured.displacement) < far)
        for name, side, mark, color in (
            ("left", -1, "o", style.LINES[0]),
            ("right", 1, "s", style.LINES[1]),
        ):
            uplift = WALL.uplift(d, side * b)
            low, high = (d - SPREAD) * MM, (d + SPREAD) * MM
            ax.fill_betweenx(uplift * MM, low, high, color=color, alpha=0.15, lw=0)
            ax.plot(d * MM, uplift * MM, color=color, label=f"{name} edge, 4-9")
            ax.plot(
                measured.displacement[near] * MM, getattr(measured, f"{name}_uplift")[near] * MM,
                mark, color=color, ms=3.6, mfc="white", mew=0.9, label=f"{name} edge, Table A-1",
            )  # fmt: skip
        ax.set_xlim(-far * MM, far * MM)
    axes[0].set_ylabel("uplift $u'$ [mm]")
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set_ylim(-0.6, 4.0)
    change = np.abs(rows_of_75_kn()["alignment"]).max()
    bent = float(np.abs(bending(symmetric(0.008))).max())
    return Drawn(
        figure,
        (
            Statement(
                "4.9.1.1", "typical sliding of about 2.5 mm to either side, from the scatter",
                f"after the tests at most {change * MM:.2f} mm are left (Table 4-2); bending, "
                f"which shifts the points too, is {bent * MM:.2f} mm at most; the traces are lost",
                None,
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.IN_KIND)
def figure_4_58() -> Drawn:
    """Tendon force against the displacement: 4-16, and the largest of each test in Table 4-2.

    The traces are lost; of each of the five tests with 75 kN its largest displacement and its
    largest tendon force are printed. The band is 2.5 mm of sliding to either side. The prestress
    of the curve is 75.6 kN.
    """
    tests = rows_of_75_kn()
    figure, *axes = overview_and_origin()
    for ax, far in zip(axes, (0.032, 0.012), strict=True):
        d = symmetric(far + SPREAD)
        force = WALL.tendon_force(d) / 1e3
        low, high = (d - SPREAD) * MM, (d + SPREAD) * MM
        ax.fill_betweenx(force, low, high, color=style.LINES[0], alpha=0.15, lw=0,
                         label="2.5 mm of sliding")  # fmt: skip
        ax.plot(d * MM, force, color=style.LINES[0], label="4-16")
        draw_measured(ax, "tendon_force", 1e3, "Table A-1 ")
        ax.plot(tests["displacement"] * MM, tests["largest"] / 1e3, "D", color=style.LINES[1],
                ms=5, label="Table 4-2, largest of a test", zorder=6)  # fmt: skip
        ax.set_xlim(-far * MM, far * MM)
    axes[0].set_ylabel("tendon force $P$ [kN]")
    axes[0].set_ylim(70, 165)
    axes[1].set_ylim(72, 115)
    axes[0].legend(loc="upper center", fontsize=7)
    computed = np.array(
        [
            float(analysis.Wall.thesis(before).tendon_force(d))
            for d, before in zip(tests["displacement"], tests["before"], strict=True)
        ]
    )
    ratio = computed / tests["largest"] - 1
    # how far the curve must shift to pass through the point
    grid = np.linspace(0.0, 0.04, 4001)
    shifts = np.array(
        [
            np.interp(largest, analysis.Wall.thesis(before).tendon_force(grid), grid) - abs(d)
            for d, largest, before in zip(
                tests["displacement"], tests["largest"], tests["before"], strict=True
            )
        ]
    )
    return Drawn(
        figure,
        (
            Statement(
                "4.9.1.1", "a reasonable prediction by the theoretical expression",
                f"{100 * ratio.min():.1f} to {100 * ratio.max():.1f} % above the largest of "
                "the five tests", bool(np.abs(ratio).max() < 0.1),
            ),
            Statement(
                "4.9.1.1", "a spread of about 2.5 mm",
                f"the five points lie {np.abs(shifts).min() * MM:.1f} to "
                f"{np.abs(shifts).max() * MM:.1f} mm beside the curve, all to the same side",
                bool(np.abs(shifts).max() < SPREAD),
            ),
        ),
    )  # fmt: skip


# --- test run 4


def forces_when_still(run: rk.Response) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [m] and -M_e (a_g + a) [N] of 4-42, where the displacement turns back."""
    d = run["displacement"]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(d))) != 0) + 1
    h, mass = WALL.height, WALL.mass
    pairs = []
    for i in turns[np.abs(d[turns]) > 2e-4]:
        state = {name: float(run[name][i]) for name in run.states}
        ground = float(run["ground_acceleration"][i])
        turning = run.structure.accelerations(state, mode=run.mode[i], ground_acceleration=ground)[
            "theta"
        ]
        sin, cos = np.sin(state["theta"]), np.cos(state["theta"])
        a = h * (turning * cos - state["theta_dot"] ** 2 * sin)
        pairs.append((d[i], back_calculated_force(mass, a, ground)))
    displacement, force = np.array(pairs).T
    return displacement, force


@thesis_figure(Source.IN_KIND)
def figure_4_69() -> Drawn:
    """The static restoring force, 4-30, and what 4-42 reads from a dynamic response.

    The traces are lost. In their place stands `ControlledWall`, the wall by Lagrange's equations
    with no term dropped, with r = 0.852, under the motion of test run 4 and under 1.4 times it, as
    the first does not go beyond 5 mm; from 1.5 times it on the tendon yields, and the points fall
    below the curve with its prestress. M_e is the whole mass, as in the thesis.
    """
    motion = wall_motion("4")
    figure, left, right = overview_and_origin()
    parts = []
    for scale, mark, color in ((1.0, "o", style.LINES[1]), (1.4, "^", style.LINES[2])):
        run = rk.simulate(
            rk.ControlledWall.thesis(), motion.scaled(acceleration=scale),
            impact=rk.EnergyRatio(RATIO),
            options=rk.SolverOptions(output_step=1e-3),
        )  # fmt: skip
        d, force = forces_when_still(run)
        parts.append((d, force))
        for ax in (left, right):
            ax.plot(d * MM, force / 1e3, mark, color=color, ms=3.2, mfc="none", mew=0.8,
                    label=f"4-42, run 4 times {scale:g}")  # fmt: skip
    d, force = (np.concatenate(x) for x in zip(*parts, strict=True))
    for ax, far in ((left, 1.05 * np.abs(d).max()), (right, 0.008)):
        u = symmetric(float(far))
        ax.plot(u * MM, WALL.restoring_force(u) / 1e3, color=style.LINES[0], label="4-30", zorder=1)
        ax.set_xlim(-far * MM, far * MM)
    left.set_ylabel("restoring force $F_k$ [kN]")
    left.legend(loc="upper left", fontsize=7.5)
    predicted = WALL.restoring_force(d)
    fit = float(identification.coefficient_of_determination(force, predicted))
    ratio = float(np.median(np.abs(force / predicted)[np.abs(d) > 1e-3]))
    return Drawn(
        figure,
        (
            Statement(
                "4.9.1.4", "4-30 adequately characterises the dynamic response",
                f"R2 = {fit:.3f} for {len(d)} points; beyond 1 mm 4-42 has {ratio:.3f} times "
                "the force on the median, as the ground pushes the mass below H", bool(fit > 0.9),
            ),
        ),
    )  # fmt: skip


# --- trials of 4.9.1.4

SHAKEN = 5.0
"""How long the trials are followed [s]."""


@cache
def trials() -> dict[str, design.OscillatorResponse]:
    """The oscillator under run 4, as 4.9.1.4 changes its backbone and its damping."""
    mass, n = WALL.mass, WALL.rotation_centre.epsilon
    force = design.tabulated(WALL.restoring_force, 0.06)
    passages = design.PassageDamping(RATIO, n)
    natural = 2 * np.pi * np.sqrt(mass * 2e-3 / float(WALL.restoring_force(2e-3)))
    critical = float(formulas.priestley_damping(RATIO))
    viscous = design.ViscousDamping.of_ratio(critical, mass, natural)
    straight = design.tabulated(design.linear_start(WALL.restoring_force, 2e-3), 0.06)
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    other = design.tabulated(edge.restoring_force, 0.06)
    choices: dict[str, tuple[Any, tuple[design.Damping, ...]]] = {
        "r = 0.852": (force, (passages,)),
        "r by 4-31": (force, (design.PassageDamping(energy_ratio_4_31, n),)),
        "centre 442, 66 mm": (other, (passages,)),
        "linear start": (straight, (passages,)),
        "bilinear": (design.bilinear_fit(WALL.restoring_force, 0.03), (passages,)),
        "viscous below 5 mm": (force, (passages, replace(viscous, below=5e-3))),
        "viscous": (force, (viscous,)),
        "tangent stiffness": (force, (design.TangentDamping.of_ratio(critical, natural),)),
    }
    return {
        name: design.EquivalentOscillator(mass, *choice).response(
            wall_motion("4"), duration=SHAKEN, step=2.5e-3
        )
        for name, choice in choices.items()
    }


@thesis_figure(Source.IN_KIND)
def figure_4_70() -> Drawn:
    """The oscillator with r = 0.852 under the record of test run 4, and other trials.

    The motion is the record that the test names, not that of the table, and the measured trace is
    lost; its peak of 23.91 mm is drawn as a line. Right: the peaks of the changes that 4.9.1.4
    tries; their values are not stated. Here the other rotation centre is 4-7 referred to the edge,
    for that of Figure 4-60 is lost, the linear start goes to 2 mm, the bilinear backbone
    is the nearest up to 30 mm, and viscous damping is that of 2-16 for r at the period of the
    secant at 2 mm, everywhere or below 5 mm with r besides; that of the tangent stiffness has the
    same ratio there.
    """
    responses = trials()
    figure = style.new_figure(8.8, 3.6)
    left, right = figure.subplots(1, 2, width_ratios=(1.7, 1.0))
    for name, color, width in (
        ("r = 0.852", style.LINES[0], 1.1),
        ("viscous", style.LINES[1], 0.8),
    ):
        run = responses[name]
        left.plot(run.time, run.displacement * MM, color=color, lw=width, label=name)
    left.axhline(MEASURED_PEAK * MM, color=style.INK, lw=0.8, ls=":", label="measured peak")
    left.set_xlim(0, SHAKEN)
    left.set_xlabel("time [s]")
    left.set_ylabel(r"displacement $\Delta$ [mm]")
    style.legend_above(left)
    peaks = {name: float(run.peak) * MM for name, run in responses.items()}
    places = np.arange(len(peaks))[::-1]
    right.barh(places, list(peaks.values()), color=style.LINES[5], height=0.6)
    right.axvline(-MEASURED_PEAK * MM, color=style.INK, lw=0.8, ls=":")
    right.set_yticks(places, list(peaks))
    right.set_xlabel(r"largest $|\Delta|$ [mm]")
    return Drawn(
        figure,
        (
            Statement(
                "4.9.1.4", "a constant r at times gives a satisfactory prediction",
                f"{peaks['r = 0.852']:.1f} mm under the record, measured 23.91 mm under the "
                "motion of the table, which is lost",
                None,
            ),
            Statement(
                "4.9.1.4", "no change of backbone or damping improves it",
                ", ".join(f"{name} {peak:.1f} mm" for name, peak in peaks.items()),
                bool(all(abs(p - 23.91) > 0.25 * 23.91 for p in peaks.values())),
            ),
        ),
    )  # fmt: skip
