"""Figures of 3.2.3: support forces of the free rocking block, of equations and of records."""

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures import chapter_3, drawn as dr

WINDOW = 0.03
"""Window of the derivatives that give impact forces [s]; the thesis does not state its own."""
SPEED = r"speed $\dot\theta$ before the impact [rad/s]"


def draw_forces(
    time: np.ndarray, horizontal: np.ndarray, vertical: np.ndarray, until: float
) -> Figure:
    """Horizontal and vertical support force [N] in time, and the weight."""
    figure, (top, below) = dr.panels(7.2, 4.2, 2, sharex=True)
    top.plot(time, horizontal / 1e3, lw=0.8, color=style.LINES[0])
    top.set_ylabel("horizontal force [kN]")
    below.plot(time, vertical / 1e3, lw=0.8, color=style.LINES[0])
    weight = chapter_3.BLOCK.mass * chapter_3.BLOCK.gravity / 1e3
    below.axhline(weight, ls="--", label="weight", **dr.THIN)
    below.legend(loc="lower right")
    below.set(ylabel="vertical force [kN]", xlabel=dr.TIME, xlim=(0, until))
    return figure


def calm_record(release: float, seed: int) -> analysis.MeasuredRecord:
    """A simulated record from a release [deg], with a tenth of the noise of the others."""
    return chapter_3.record(release, seed, noise=chapter_3.NOISE / 10)


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_3_12() -> Figure:
    """Support forces of the block by 3-8 and 3-9 from a record in kind.

    The record is that of the first release of Figure 3-15, with a tenth of the noise of the others;
    its rotation is differentiated twice over a window of 0.03 s, which spreads the jumps of the
    rate at the impacts to spikes.
    """
    forces = identification.support_forces_of_record(
        calm_record(*chapter_3.RUNS[0]), window=WINDOW, **chapter_3.SHAPE
    )
    return draw_forces(forces.time, forces.horizontal, forces.vertical, 4.9)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_3_13() -> Figure:
    """Support forces of Housner's block, released as in Figure 3-3.

    r is 0.879, of 2-6; that of the figure is not printed. The forces at the impacts, infinite for
    no time, are not drawn.
    """
    run = chapter_3.housner(chapter_3.R_HOUSNER, 14.0)
    vertical = run["left_reaction"] + run["right_reaction"]
    return draw_forces(run.t, run["horizontal_reaction"], vertical, 10.0)


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.0, columns=3)
def figure_3_14(*axes: Axes) -> None:
    """Support forces just before and after an impact against the speed: 3-11 and 3-12.

    Up to the largest speed of free rocking, 3-13. Positive speed: the right foot lands. The angle
    is that of the resultant from the vertical.
    """
    alpha, radius = chapter_3.BLOCK.alpha, chapter_3.BLOCK.radius
    most = float(formulas.impact_speed(alpha, alpha=alpha, radius=radius))
    speed = np.linspace(-most, most, 401)
    for side, label, line in ((1, "on the right foot", "-"), (-1, "on the left foot", "--")):
        h, v = formulas.block_reactions_at_impact(speed, side, slender=True, **chapter_3.SHAPE)
        angle = np.degrees(np.arctan2(h, v))
        for ax, y in zip(axes, (h / 1e3, v / 1e3, angle), strict=True):
            ax.plot(speed, y, line, label=label)
    names = "horizontal force [kN]", "vertical force [kN]", "angle of the resultant [deg]"
    for ax, name in zip(axes, names, strict=True):
        ax.set(xlabel=r"speed $\dot\theta$ [rad/s]", ylabel=name)
    axes[1].set_ylim(0, 3.6)
    axes[2].legend(loc="center")


@cache
def impact_forces() -> identification.ImpactForces:
    """Impacts of the four runs in kind above 0.15 rad/s, with a tenth of the noise."""
    forces = [
        identification.impact_forces_of_record(calm_record(*run), window=WINDOW, **chapter_3.SHAPE)
        for run in chapter_3.RUNS
    ]
    columns = [np.concatenate(column) for column in zip(*forces, strict=True)]
    fast = np.abs(columns[1]) > 0.15
    return identification.ImpactForces(*(column[fast] for column in columns))


@dr.thesis_axes(dr.Source.IN_KIND, 7.4, 5.4, 2, 2, sharex=True)
def figure_3_15(a: Axes, b: Axes, c: Axes, d: Axes) -> None:
    """Forces about each impact of records in kind against the speed, and the baseline.

    Upper row: the largest vertical force about an impact, and the horizontal one where it is
    positive. Lower row: the vertical force of the record one window before the impact, and the
    horizontal one where it is negative. The impacts of the simulation have no duration: what is
    drawn over the baseline, 3-11 and 3-12, is the jump of the rate, spread over the window of the
    derivatives, here 0.03 s. The thesis does not state its window. The noise is a tenth of that of
    the others.
    """
    forces, before = impact_forces(), vertical_before_impacts()
    speed, h, v = forces.speed, forces.horizontal, forces.vertical
    for ax, values, baseline, rows, name in (
        (a, v, forces.baseline_vertical, v > 0, "a) largest vertical"),
        (b, h, forces.baseline_horizontal, h > 0, "b) positive horizontal"),
        (c, before, forces.baseline_vertical, before > 0, "c) vertical force before"),
        (d, h, forces.baseline_horizontal, h < 0, "d) negative horizontal"),
    ):
        dr.draw_feet(ax, speed[rows] < 0, speed[rows], values[rows] / 1e3)
        # horizontal, the baseline just after has the size of that before, and the other sign
        smooth = np.copysign(baseline, values)[rows]
        ax.plot(speed[rows], smooth / 1e3, "_", color=style.INK, ms=6, label="baseline")
        ax.set_ylabel(f"{name} [kN]")
    for ax in (c, d):
        ax.set_xlabel(SPEED)
    dr.legend_of_first(style.parent_figure(a), 3)


@cache
def vertical_before_impacts() -> np.ndarray:
    """Vertical support force of the records, a window before each impact of `impact_forces` [N]."""
    forces_before = []
    for release, seed in chapter_3.RUNS:
        calm = calm_record(release, seed)
        forces = identification.support_forces_of_record(calm, window=WINDOW, **chapter_3.SHAPE)
        impacts = identification.impact_forces_of_record(calm, window=WINDOW, **chapter_3.SHAPE)
        time = impacts.time[np.abs(impacts.speed) > 0.15]
        forces_before.append(np.interp(time - WINDOW, forces.time, forces.vertical))
    return np.concatenate(forces_before)


@dr.thesis_axes(dr.Source.IN_KIND, 7.4, 3.2, columns=2)
def figure_3_16(magnitude: Axes, direction: Axes) -> None:
    """Magnitude and direction of the largest forces of Figure 3-15 against the speed; in kind.

    The angle is that of the resultant from the vertical.
    """
    forces = impact_forces()
    for ax, y in ((magnitude, forces.magnitude / 1e3), (direction, np.degrees(forces.angle))):
        dr.draw_feet(ax, forces.speed < 0, forces.speed, y)
        ax.set_xlabel(SPEED)
    magnitude.set(ylabel="magnitude [kN]", ylim=(0, None))
    direction.set_ylabel("angle from the vertical [deg]")
    magnitude.legend(loc="lower center")
