"""Figures of 3.2.4: the energy that impacts of the free rocking block lose."""

from functools import cache

import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.analysis import identification
from rockeom.analysis.identification import Impacts
from rockeom.plots import style
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.figures import chapter_3
from rockeom.thesis.figures.chapter_3 import BLOCK, R_HOUSNER, RUNS, SHAPE, measured_impacts, record
from rockeom.thesis.figures.chapter_3_forces import WINDOW, calm_record
from rockeom.thesis.figures.drawn import OPEN, Source, thesis_axes, thesis_panels

THRESHOLD = 6.0
"""Energy below which the thesis leaves impacts out [J]."""


@cache
def corrected_impacts(release: float, seed: int) -> tuple[Impacts, Impacts]:
    """Impacts of a run in kind without and with the energy of the spring, those above 6 J."""
    data = record(release, seed, spring=True)
    plain = Impacts.of_record(data, BLOCK)
    chosen = plain.energy_before >= THRESHOLD
    corrected = Impacts.of_record(data, BLOCK, rotational_stiffness=chapter_3.SPRING)
    return plain.select(chosen), corrected.select(chosen)


@thesis_panels(Source.IN_KIND, 7.6, 4.6)
def figure_3_17(figure: Figure) -> None:
    """Total energy at the peaks with and without the correction for the spring, in four runs.

    Runs in kind, released from 7.9, 6.5, 5 and 3.5 degrees, with the spring of Figures 3-9 and 3-10
    and a r for each foot. The energy after an impact, 3-1 with or without 3-4, is drawn at the time
    of the impact, the first one at the release. Impacts below 6 J are left out, as in the text.
    """
    for ax, (release, seed) in zip(figure.subplots(2, 2).ravel(), RUNS, strict=True):
        for impacts, line, label in zip(
            corrected_impacts(release, seed), ("--", "-"), ("without", "with"), strict=True
        ):
            time = np.append(0.0, impacts.time)
            energy = np.append(impacts.energy_before[0], impacts.energy_after)
            ax.step(time, energy, line, where="post", lw=0.9, color=style.INK,
                    label=f"{label} the spring")  # fmt: skip
            for foot, mark in (("left", "<"), ("right", ">")):
                one = impacts.at_foot(foot)
                ax.plot(one.time, one.energy_after, mark, color=style.FEET[foot], ms=5, mew=0.9,
                        mfc="none" if line == "--" else style.FEET[foot],
                        label=f"{foot} foot lands" if line == "-" else None)  # fmt: skip
        ax.set_title(f"released at {release:g} degrees", fontsize=9)
        ax.set(xlabel="time [s]", ylabel="total energy [J]", ylim=(0, None))
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4)


# --- restitution of all runs in kind


@cache
def impacts_in_kind() -> Impacts:
    """Impacts of the four runs in kind, without the spring."""
    return Impacts.together([Impacts.of_record(record(*run), BLOCK) for run in RUNS])


def draw_by_foot(ax: Axes, impacts: Impacts, x: np.ndarray, y: np.ndarray) -> None:
    """Points of each foot, filled by its colour."""
    for foot, mark in (("left", "<"), ("right", ">")):
        one = impacts.foot == foot
        ax.plot(x[one], y[one], mark, ms=4, color=style.FEET[foot], label=f"{foot} foot lands")


def mark_housner(ax: Axes, vertical: bool = False) -> None:
    """A line at r of 2-6."""
    line = ax.axvline if vertical else ax.axhline
    line(R_HOUSNER, color=style.INK, ls="--", lw=0.8, label=f"2-6, {R_HOUSNER:.3f}")


@thesis_panels(Source.IN_KIND, 7.6, 3.2)
def figure_3_18(figure: Figure) -> None:
    """r against the peak before the impact: all impacts, and those above 6 J; in kind.

    The four runs of Figure 3-17 without the spring; their r are those of Figure 3-3 for each foot,
    so that there are two bunches and not the three of the tests.
    """
    every = impacts_in_kind()
    for ax, impacts, title in zip(
        figure.subplots(1, 2, sharey=True),
        (every, every.select(every.energy_before >= THRESHOLD)),
        ("all impacts", "impacts above 6 J"),
        strict=True,
    ):
        draw_by_foot(ax, impacts, np.degrees(impacts.peak_before), impacts.energy_ratio)
        mark_housner(ax)
        ax.set_title(title, fontsize=9)
        ax.set_xlabel(r"peak before the impact $\theta_{peak}$ [deg]")
    figure.axes[0].set(ylabel="energy ratio $r$ [-]", ylim=(0.6, 1.1))
    figure.axes[1].legend(loc="lower center")


@thesis_axes(Source.IN_KIND, 5.8, 3.2)
def figure_3_19(ax: Axes) -> None:
    """Frequency of r in classes of 0.01, of the impacts above 6 J of the runs in kind."""
    impacts = filtered()
    edges, _ = impacts.histogram()
    counts = {
        foot: np.histogram(impacts.at_foot(foot).energy_ratio, edges)[0]
        for foot in ("left", "right")
    }
    below = np.zeros(len(edges) - 1)
    for foot, count in counts.items():
        ax.bar(edges[:-1], count, 0.01, below, align="edge", color=style.FEET[foot],
               edgecolor="white", lw=0.5, label=f"{foot} foot lands")  # fmt: skip
        below += count
    mark_housner(ax, vertical=True)
    ax.set(xlabel="energy ratio $r$ [-]", ylabel="number of impacts [-]")
    ax.legend()


@thesis_axes(Source.IN_KIND, 5.8, 3.2)
def figure_3_20(ax: Axes) -> None:
    """Cumulative frequency of r of the impacts above 6 J of the runs in kind."""
    r, part = filtered().cumulative()
    ax.step(np.append(r[0], r), np.append(0.0, 100 * part), where="post", color=style.LINES[0])
    mark_housner(ax, vertical=True)
    ax.axvline(float(r.mean()), color=style.LINES[1], lw=0.8, ls=":", label=f"mean, {r.mean():.3f}")
    ax.set(xlabel="energy ratio $r$ [-]", ylabel="impacts with no more [%]", ylim=(0, 101))
    ax.legend()


def filtered() -> Impacts:
    """The impacts in kind above 6 J."""
    every = impacts_in_kind()
    return every.select(every.energy_before >= THRESHOLD)


@thesis_axes(Source.IN_KIND, 5.8, 3.4)
def figure_3_21(ax: Axes) -> None:
    """r against the speed at the impact: runs in kind, and the printed points of Figure 3-3."""
    impacts, printed = filtered(), measured_impacts()
    draw_by_foot(ax, impacts, impacts.speed, impacts.energy_ratio)
    ax.plot(printed.speed, printed.energy_ratio, "o", ms=5, label="Figure 3-3, measured", **OPEN)
    mark_housner(ax)
    ax.set(
        xlabel=r"speed $\dot\theta$ at the impact [rad/s]",
        ylabel="energy ratio $r$ [-]",
        ylim=(0.6, 1.05),
    )
    ax.legend(loc="lower center", ncols=2)


def fitted_change(number: str, speed: np.ndarray) -> np.ndarray:
    """Change of energy [J] at impact speeds (n,) [rad/s] by equation 3-17 or 3-18."""
    change = sp.lambdify(th.theta_d_peak, EQUATIONS[number].right[0].rhs)
    return np.asarray(change(speed))


@thesis_axes(Source.PRINTED, 6.4, 3.8)
def figure_3_22(ax: Axes) -> None:
    """Change of energy against the speed at an impact: 3-17, 3-18, and the points of Figure 3-3.

    The energies are those of the block at the printed peaks, the speed that of the energy before.
    Crosses are four simulated runs in kind, without the spring. Positive speed: the right foot
    lands.
    """
    speed = np.linspace(-1.0, 1.0, 401)
    impacts = measured_impacts()
    ax.plot(speed, fitted_change("3-17", speed), label="3-17, all impacts")
    right = speed[speed > 0]
    ax.plot(right, fitted_change("3-18", right), "--", label="3-18, right edge")
    kind = impacts_in_kind()
    ax.plot(kind.speed, kind.energy_change, "x", ms=4, color="0.6", label="in kind")
    ax.plot(impacts.speed, impacts.energy_change, "o", ms=4.5, label="Figure 3-3, measured", **OPEN)
    ax.set(
        xlabel=r"speed $\dot\theta$ at the impact [rad/s]",
        ylabel=r"change of energy $\Delta E$ [J]",
        ylim=(-10, 0.5),
    )
    ax.legend(loc="lower right")


@cache
def changes_and_forces() -> tuple[Impacts, np.ndarray]:
    """Impacts of the runs of Figure 3-15 above 6 J, and the largest force about each [N]."""
    impacts, forces = [], []
    for release, seed in RUNS:
        calm = calm_record(release, seed)
        of_run = Impacts.of_record(calm, BLOCK, threshold=THRESHOLD)
        impact_forces = identification.impact_forces_of_record(calm, window=WINDOW, **SHAPE)
        nearest = np.abs(impact_forces.time[:, None] - of_run.time).argmin(axis=0)
        impacts.append(of_run)
        forces.append(impact_forces.magnitude[nearest])
    return Impacts.together(impacts), np.concatenate(forces)


@thesis_panels(Source.IN_KIND, 7.6, 3.2)
def figure_3_23(figure: Figure) -> None:
    """Energy lost and r against the magnitude of the impact force, in kind.

    The forces are those of Figure 3-16: jumps of the rate spread over a window of 0.03 s.
    """
    impacts, force = changes_and_forces()
    for ax, values, label in zip(
        figure.subplots(1, 2),
        (impacts.energy_change, impacts.energy_ratio),
        (r"change of energy $\Delta E$ [J]", "energy ratio $r$ [-]"),
        strict=True,
    ):
        draw_by_foot(ax, impacts, force / 1e3, values)
        ax.set(xlabel="magnitude of the impact force [kN]", ylabel=label)
    figure.axes[1].legend(loc="center right")
