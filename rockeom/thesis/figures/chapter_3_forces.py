"""Figures of 3.2.3: support forces of the free rocking block, of equations and of records."""

from functools import cache

import numpy as np
from matplotlib.figure import Figure

from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.thesis.figures import chapter_3
from rockeom.thesis.figures.drawn import Source, thesis_figure, thesis_panels

WINDOW = 0.03
"""Window of the derivatives that give impact forces [s]; the thesis does not state its own."""


def draw_forces(
    time: np.ndarray, horizontal: np.ndarray, vertical: np.ndarray, until: float
) -> Figure:
    """Horizontal and vertical support force [N] in time, and the weight."""
    figure = style.new_figure(7.2, 4.2)
    axes = figure.subplots(2, 1, sharex=True)
    for ax, force, name in zip(
        axes, (horizontal, vertical), ("horizontal", "vertical"), strict=True
    ):
        ax.plot(time, force / 1e3, lw=0.8, color=style.LINES[0])
        ax.set_ylabel(f"{name} force [kN]")
    weight = chapter_3.BLOCK.mass * chapter_3.BLOCK.gravity / 1e3
    axes[1].axhline(weight, color=style.INK, ls="--", lw=0.8, label="weight")
    axes[1].legend(loc="lower right")
    axes[1].set(xlabel="time [s]", xlim=(0, until))
    figure.align_ylabels(axes)
    return figure


@thesis_figure(Source.IN_KIND)
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


@thesis_figure(Source.COMPUTED)
def figure_3_13() -> Figure:
    """Support forces of Housner's block, released as in Figure 3-3.

    r is 0.879, of 2-6; that of the figure is not printed. The forces at the impacts, infinite for
    no time, are not drawn.
    """
    run = chapter_3.housner(chapter_3.R_HOUSNER, 14.0)
    vertical = run["left_reaction"] + run["right_reaction"]
    return draw_forces(run.t, run["horizontal_reaction"], vertical, 10.0)


@thesis_panels(Source.COMPUTED, 7.6, 3.0)
def figure_3_14(figure: Figure) -> None:
    """Support forces just before and after an impact against the speed: 3-11 and 3-12.

    Up to the largest speed of free rocking, 3-13. Positive speed: the right foot lands. The angle
    is that of the resultant from the vertical.
    """
    most = float(
        formulas.impact_speed(
            chapter_3.BLOCK.alpha, alpha=chapter_3.BLOCK.alpha, radius=chapter_3.BLOCK.radius
        )
    )
    speed = np.linspace(-most, most, 401)
    axes = figure.subplots(1, 3)
    for side, label, line in ((1, "on the right foot", "-"), (-1, "on the left foot", "--")):
        h, v = formulas.block_reactions_at_impact(speed, side, slender=True, **chapter_3.SHAPE)
        angle = np.degrees(np.arctan2(h, v))
        for ax, y in zip(axes, (h / 1e3, v / 1e3, angle), strict=True):
            ax.plot(speed, y, line, label=label)
    axes[0].set_ylabel("horizontal force [kN]")
    axes[1].set_ylabel("vertical force [kN]")
    axes[2].set_ylabel("angle of the resultant [deg]")
    axes[1].set_ylim(0, 3.6)
    for ax in axes:
        ax.set_xlabel(r"speed $\dot\theta$ [rad/s]")
    axes[2].legend(loc="center")


@cache
def calm_record(release: float, seed: int) -> analysis.MeasuredRecord:
    """A simulated record from a release [deg], with a tenth of the noise of the others."""
    motion = chapter_3.rocking(chapter_3.BLOCK, float(np.radians(release)), 5.0)
    t = np.arange(5 * chapter_3.RATE) / chapter_3.RATE
    noise = np.random.default_rng(seed).normal(0.0, chapter_3.NOISE / 10, len(t))
    return analysis.MeasuredRecord(t, {"theta": motion.at(t)["theta"] + noise})


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


def grows(speed: np.ndarray, force: np.ndarray) -> float:
    """Growth of a force from 0.2 to 0.8 rad/s on the straight line through its points."""
    slope, level = np.polyfit(np.abs(speed), force, 1)
    return float((level + 0.8 * slope) / (level + 0.2 * slope) - 1)


def feet_of(speed: np.ndarray) -> list[tuple[str, str, np.ndarray]]:
    """Name, marker and mask of the impacts of each foot, by the sign of the speed."""
    return [("left", "<", speed < 0), ("right", ">", speed > 0)]


@thesis_panels(Source.IN_KIND, 7.4, 5.4)
def figure_3_15(figure: Figure) -> None:
    """Forces about each impact of records in kind against the speed, and the baseline.

    Upper row: the largest vertical force about an impact, and the horizontal one where it is
    positive. Lower row: the vertical force of the record one window before the impact, and the
    horizontal one where it is negative. The impacts of the simulation have no duration: what is
    drawn over the baseline, 3-11 and 3-12, is the jump of the rate, spread over the window of the
    derivatives, here 0.03 s. The thesis does not state its window. The noise is a tenth of that of
    the others.
    """
    forces, before = impact_forces(), vertical_before_impacts()
    (a, b), (c, d) = figure.subplots(2, 2, sharex=True)
    base = {"color": style.INK, "ms": 6, "ls": "", "marker": "_", "label": "baseline"}
    for ax, values, baseline, chosen, name in (
        (a, forces.vertical, forces.baseline_vertical, forces.vertical > 0, "largest vertical"),
        (b, forces.horizontal, forces.baseline_horizontal, forces.horizontal > 0,
         "positive horizontal"),
        (c, before, forces.baseline_vertical, before > 0, "vertical force before"),
        (d, forces.horizontal, forces.baseline_horizontal, forces.horizontal < 0,
         "negative horizontal"),
    ):  # fmt: skip
        for foot, mark, of_foot in feet_of(forces.speed):
            one = of_foot & chosen
            ax.plot(forces.speed[one], values[one] / 1e3, mark, ms=4, color=style.FEET[foot],
                    label=f"{foot} foot lands")  # fmt: skip
        # horizontal, the baseline just after has the size of that before, and the other sign
        smooth = np.copysign(baseline, values)[chosen]
        ax.plot(forces.speed[chosen], smooth / 1e3, **base)
        ax.set_ylabel(f"{name} [kN]")
    for ax in (c, d):
        ax.set_xlabel(r"speed $\dot\theta$ before the impact [rad/s]")
    for ax, letter in zip((a, b, c, d), "abcd", strict=True):
        ax.set_title(letter, loc="left", fontsize=9)
    handles, labels = a.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)


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


@thesis_panels(Source.IN_KIND, 7.4, 3.2)
def figure_3_16(figure: Figure) -> None:
    """Magnitude and direction of the largest forces of Figure 3-15 against the speed; in kind.

    The angle is that of the resultant from the vertical.
    """
    forces = impact_forces()
    angle = np.degrees(forces.angle)
    axes = figure.subplots(1, 2)
    for foot, side, mark in (("left", -1, "<"), ("right", 1, ">")):
        one = np.sign(forces.speed) == side
        for ax, y in zip(axes, (forces.magnitude / 1e3, angle), strict=True):
            ax.plot(
                forces.speed[one], y[one], mark, ms=4, color=style.FEET[foot],
                label=f"{foot} foot lands",
            )  # fmt: skip
    axes[0].set(ylabel="magnitude [kN]", ylim=(0, None))
    axes[1].set_ylabel("angle from the vertical [deg]")
    for ax in axes:
        ax.set_xlabel(r"speed $\dot\theta$ before the impact [rad/s]")
    axes[0].legend(loc="lower center")
