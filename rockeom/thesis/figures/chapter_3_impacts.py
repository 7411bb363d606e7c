"""Figures of 3.2.4: the energy that impacts of the free rocking block lose."""

from functools import cache

import numpy as np
import sympy as sp
from matplotlib.axes import Axes

from rockeom.analysis.identification import Impacts
from rockeom.plots import style
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.figures.chapter_3 import BLOCK, RUNS, SPRING, measured_impacts, record

THRESHOLD = 6.0
"""Energy below which the thesis leaves impacts out [J]."""


@cache
def corrected_impacts(release: float, seed: int) -> tuple[Impacts, Impacts]:
    """Impacts of a run in kind without and with the energy of the spring, those above 6 J."""
    data = record(release, seed, spring=True)
    plain = Impacts.of_record(data, BLOCK)
    chosen = plain.energy_before >= THRESHOLD
    corrected = Impacts.of_record(data, BLOCK, rotational_stiffness=SPRING)
    return plain.select(chosen), corrected.select(chosen)


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 4.6, 2, 2)
def figure_3_17(*axes: Axes) -> None:
    """Total energy at the peaks with and without the correction for the spring, in four runs.

    Runs in kind, released from 7.9, 6.5, 5 and 3.5 degrees, with the spring of Figures 3-9 and 3-10
    and a r for each foot. The energy after an impact, 3-1 with or without 3-4, is drawn at the time
    of the impact, the first one at the release. Impacts below 6 J are left out, as in the text.
    """
    for ax, (release, seed) in zip(axes, RUNS, strict=True):
        plain, corrected = corrected_impacts(release, seed)
        for impacts, line, label in (
            (plain, "--", "without the spring"), (corrected, "-", "with the spring"),
        ):  # fmt: skip
            time = np.append(0.0, impacts.time)
            energy = np.append(impacts.energy_before[0], impacts.energy_after)
            ax.step(time, energy, line, where="post", lw=0.9, color=style.INK, label=label)
        dr.draw_feet(ax, corrected.foot == "left", corrected.time, corrected.energy_after, ms=5)
        ax.set_title(f"released at {release:g} degrees", fontsize=9)
        ax.set(xlabel=dr.TIME, ylabel="total energy [J]", ylim=(0, None))
    dr.legend_of_first(style.parent_figure(axes[0]), 4)


def fitted_change(number: str, speed: np.ndarray) -> np.ndarray:
    """Change of energy [J] at impact speeds (n,) [rad/s] by equation 3-17 or 3-18."""
    change = sp.lambdify(th.theta_d_peak, EQUATIONS[number].right[0].rhs)
    return np.asarray(change(speed))


@dr.thesis_axes(dr.Source.PRINTED, 6.4, 3.8)
def figure_3_22(ax: Axes) -> None:
    """Change of energy against the speed at an impact: 3-17, 3-18, and the points of Figure 3-3.

    The energies are those of the block at the printed peaks, the speed that of the energy before.
    Positive speed: the right foot lands.
    """
    speed = np.linspace(-1.0, 1.0, 401)
    impacts = measured_impacts()
    ax.plot(speed, fitted_change("3-17", speed), label="3-17, all impacts")
    right = speed[speed > 0]
    ax.plot(right, fitted_change("3-18", right), "--", label="3-18, right edge")
    ax.plot(
        impacts.speed, impacts.energy_change, "o", ms=4.5, label="Figure 3-3, measured", **dr.OPEN
    )
    ax.set(xlabel=r"speed $\dot\theta$ at the impact [rad/s]", ylim=(-10, 0.5))
    ax.set_ylabel(r"change of energy $\Delta E$ [J]")
    ax.legend(loc="lower right")
