"""Figures of chapter 5: the steel column that bends, Model C, and what rocking does for it.

Stiffness and damping are those of 5-1 and 5-36, 571.8 kN/m and 502.4 N s/m. At an impact the
angular velocity is multiplied by the root of r and the column's rate is left, as the thesis does.
"""

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import design
from rockeom.plots import style
from rockeom.simulation.response import Response
from rockeom.thesis import shaken
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.figures.chapter_5_rigid import DISPLACEMENT, draw_decay, draw_shaken, released

MODEL_C = shaken.model_c()
STILL = 0.1e-3
"""Uplift below which rocking is said to have ceased [m]."""


def rocking_ends(run: Response) -> float:
    """When the last uplift above `STILL` ends [s]."""
    uplift = np.maximum(run["left_uplift"], run["right_uplift"])
    return float(run.t[np.flatnonzero(uplift > STILL)[-1]])


def deformation_lasts(run: Response) -> float:
    """When the column's deformation last exceeds 0.1 mm [s]."""
    return float(run.t[np.flatnonzero(np.abs(run["u"]) > STILL)[-1]])


def draw_apart(run: Response, end: float) -> Figure:
    """Rotation and deformation, each by itself."""
    figure, (top, below) = dr.panels(6.6, 4.2, 2, sharex=True)
    top.plot(run.t, dr.MM * run["theta"], color=style.LINES[0])
    top.set_ylabel(r"rotation $\theta$ [mrad]")
    below.plot(run.t, dr.MM * run["u"], color=style.LINES[2])
    below.set(ylabel="deformation $u$ [mm]", xlabel=dr.TIME, xlim=(0, end))
    return figure


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_38() -> Figure:
    """Displacement and uplift of the column that bends after its release, r = 0.74.

    Model C. The release is put where the first zero meets the measured one, as in Figure 5-22.
    Rocking is said to end with the last uplift of 0.1 mm.
    """
    run = released(MODEL_C, 0.74)
    return draw_decay("Figure 5-6", ("Model C, r = 0.74", run), uplift=run)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_39() -> Figure:
    """Rotation and deformation of the column after its release, each by itself, r = 0.74.

    As Figure 5-38; time counts from the release.
    """
    return draw_apart(released(MODEL_C, 0.74), 2.2)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_41() -> Figure:
    """Displacement and uplift of the column that bends after its release, r = 0.81.

    As Figure 5-38, with the average of the measured energy ratios.
    """
    run = released(MODEL_C, 0.81)
    return draw_decay("Figure 5-6", ("Model C, r = 0.81", run), uplift=run)


@dr.thesis_axes(dr.Source.COMPUTED, 6.6, 5.4, 3, sharex=True)
def figure_5_42(*axes: Axes) -> None:
    """Displacement, rotation and deformation after the release with r = 0.74 and r = 0.81.

    As Figure 5-38; time counts from the release.
    """
    runs = {f"r = {r}": released(MODEL_C, r) for r in (0.74, 0.81)}
    names = {"displacement": DISPLACEMENT, "theta": r"$\theta$ [mrad]", "u": "$u$ [mm]"}
    for ax, (name, label) in zip(axes, names.items(), strict=True):
        curves = [(said, run.t, dr.MM * run[name]) for said, run in runs.items()]
        dr.draw_curves(ax, curves, dr.SOLID, lw=0.9)
        ax.set_ylabel(label)
    style.legend_above(axes[0])
    axes[-1].set(xlabel=dr.TIME, xlim=(0, 2.2))


# --- shaken


def shaken_column(**changes: float) -> Response:
    return shaken.column_run("3", shaken.model_c(**changes), 0.74)


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_43() -> Figure:
    """The column that bends in run 3, El Centro with 0.8 g in 1/5 of its time, r = 0.74.

    Model C. The record and its scale are those of Figure 5-24.
    """
    run, rigid = shaken_column(), shaken.column_run("3", shaken.MODEL_A, 0.74)
    return draw_shaken("3", ("Model C", run), ("Model A", rigid))


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_44() -> Figure:
    """Rotation and deformation of the column in run 3, each by itself, r = 0.74.

    As Figure 5-43.
    """
    return draw_apart(shaken_column(), 4.5)


# --- rocking as isolation


@cache
def beside(scale: float = 1.0, run: str = "3") -> design.Isolation:
    """A run's record times a factor, rocking and on a fixed base."""
    return analysis.compare_with_fixed_base(
        MODEL_C, shaken.column_motion(run).scaled(scale), impact=rk.EnergyRatio(0.74)
    )


SCALES = (0.25, 0.5, 1.0, 2.0)


@dr.thesis_axes(dr.Source.IN_KIND, 6.8, 6.2, 3)
def figure_5_45(force: Axes, drift: Axes, ratio: Axes) -> None:
    """Lateral force and displacement of the column in run 3, rocking and on a fixed base.

    Model C with r = 0.74, k = 571.8 kN/m, c = 502.4 N s/m, under the record of Figure 5-24. The
    force is the base shear. Below, not in the thesis: base shear, base moment and displacement of
    the column that rocks over those on the fixed base, against the scale of the record.
    """
    compared = beside()
    runs = {"fixed base": compared.fixed_run, "rocking": compared.rocking_run}
    for ax, quantity, unit, label in (
        (force, "horizontal_reaction", 1e-3, "base shear [kN]"),
        (drift, "displacement", dr.MM, DISPLACEMENT),
    ):
        curves = [(said, run.t, unit * run[quantity]) for said, run in runs.items()]
        dr.draw_curves(ax, curves, dr.SOLID, style.LINES[1::-1], lw=0.9)
        ax.set(xlabel=dr.TIME, ylabel=label, xlim=(0, 3.0))
    style.legend_above(force)
    ratios = [beside(scale).ratios for scale in SCALES]
    for name, color in zip(ratios[0], style.LINES[2:5], strict=True):
        by_scale, label = [one[name] for one in ratios], name.replace("_", " ")
        ratio.plot(SCALES, by_scale, ".-", color=color, label=label)
    ratio.axhline(1.0, ls=":", **dr.THIN)
    ratio.set(
        xlabel="scale of the record [-]", ylabel="rocking over\nfixed base [-]", ylim=(0, None)
    )
    style.legend_above(ratio)


def draw_range(ax: Axes, runs: dict[str, Response]) -> None:
    """Displacements of several responses."""
    curves = [(label, run.t, dr.MM * run["displacement"]) for label, run in runs.items()]
    dr.draw_curves(ax, curves, lw=0.9)
    ax.set(xlabel=dr.TIME, ylabel=DISPLACEMENT, xlim=(0, 3.0))
    style.legend_above(ax)


def with_ratios() -> dict[str, Response]:
    """Run 3 by energy ratio, the first one as meant."""
    return {f"r = {r:.2f}": shaken.column_run("3", MODEL_C, r) for r in (0.74, 0.70, 0.78)}


def with_stiffnesses() -> dict[str, Response]:
    """Run 3 by stiffness, 10 % less and more."""
    return {
        f"k = {factor * 571.8:.0f} kN/m": shaken_column(stiffness=factor * 571.8e3)
        for factor in (1.0, 0.9, 1.1)
    }


def with_dampings() -> dict[str, Response]:
    """Run 3 by damping coefficient, none and twice as much."""
    return {
        f"c = {factor * 502.4:.0f} N s/m": shaken_column(damping=factor * 502.4)
        for factor in (1.0, 0.0, 2.0)
    }


@dr.thesis_axes(dr.Source.IN_KIND, 6.6, 4.6, 2)
def figure_5_46(top: Axes, below: Axes) -> None:
    """Displacement of the column in run 3 with a range of r and of k.

    The values of the thesis are not legible; taken are r = 0.70, 0.74 and 0.78, and k 10 % below
    and above 571.8 kN/m, with c = 502.4 N s/m. The record is that of Figure 5-24.
    """
    draw_range(top, with_ratios())
    draw_range(below, with_stiffnesses())


@dr.thesis_axes(dr.Source.IN_KIND, 6.6, 3.2)
def figure_5_47(ax: Axes) -> None:
    """Displacement of the column in run 3 with a range of c, k = 571.8 kN/m.

    The values of the thesis are not legible; taken are none, 3 % (502.4 N s/m) and 6 % of critical
    damping, with r = 0.74. The record is that of Figure 5-24.
    """
    draw_range(ax, with_dampings())
