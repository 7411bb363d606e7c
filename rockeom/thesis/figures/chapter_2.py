"""Figures of chapter 2: uplifting oscillators, mats, and impacts as forces."""

import math
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom.analysis.formulas import foundation
from rockeom.analysis.formulas.restitution import energy_ratio_of_block
from rockeom.analysis.formulas.uplift import uplift_displacement, uplifted_frequency
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import let_go

OMEGA_OF_2_6 = 56.10
"""Angular frequency of the column of Figure 2-6 on a fixed base [rad/s]."""

START, ENERGY_RATIO = 0.4, 0.7225
"""x_0 and r of Figures 2-16 and 2-17."""


# --- 2.4 flexible structures and foundations


@dr.thesis_axes(dr.Source.COMPUTED, 7.2, 5.0, 2, sharex=True)
def figure_2_6(top: Axes, bottom: Axes) -> None:
    """Free vibration of Chopra and Yim's oscillator: rotation and deformation.

    Given are H/B = 1/0.3, read as H = 1 m and B = 0.3 m, omega = 56.10 rad/s, xi = 0.03 and
    theta_0 = 0.05 theta_crit. Left open are what theta_crit is, taken as atan(B/H); the
    deformation at the release, that of static equilibrium under a force on its mass,
    u_c (dotted); and what happens at an impact: here momentum is conserved (`Impulsive`), and each
    ends in full contact. With it is the same structure with exact kinematics and P-delta.
    """
    omega, xi, height, half_width = OMEGA_OF_2_6, 0.03, 1.0, 0.3
    crit = math.atan(half_width / height)
    u_c = float(uplift_displacement(omega, half_width, height))
    small = rk.UpliftingOscillator.from_frequency(
        angular_frequency=omega, damping_ratio=xi, height=height, half_width=half_width
    )
    exact = rk.FlexibleStructure(
        mass=small.mass, height=height, inertia=0.0, base_mass=0.0, base_height=0.0,
        base_inertia=0.0, half_width=half_width, stiffness=small.stiffness, damping=small.damping,
    )  # fmt: skip
    for structure, label, line in (
        (small, "small displacements (2-7)", {"color": style.LINES[0]}),
        (exact, "exact kinematics, P-delta", {"color": style.LINES[1], "ls": "--", "lw": 0.8}),
    ):
        run = let_go(structure, 2.0, rk.Impulsive(), theta=0.05 * crit, u=u_c)
        top.plot(run.t, run["theta"] / crit, label=label, **line)
        bottom.plot(run.t, run["u"] / u_c, **line)
    for level in (-1.0, 1.0):
        bottom.axhline(level, ls=":", **dr.THIN)
    style.legend_above(top)
    top.set_ylabel(r"$\theta/\theta_{crit}$ [-]")
    bottom.set(ylabel="$u/u_c$ [-]", xlabel=dr.TIME)
    uplifted = uplifted_frequency(omega, half_width, height) / omega
    style.parent_figure(top).suptitle(
        f"Free vibration of an uplifting oscillator; $u_c$ = {1e3 * u_c:.3f} mm, "
        rf"$\lambda_r/\omega$ = {uplifted:.2f}",
        fontsize=9.5,
    )


@dr.thesis_axes(dr.Source.IN_KIND, 6.0, 3.8)
def figure_2_8(ax: Axes) -> None:
    """Moment and rotation of a mat on rigid ground, two springs and a tension-less Winkler bed.

    The figure gives no numbers. In kind: that the two springs and the bed have the same vertical
    and rotational stiffness (Table 2-2 for a rectangular mat) is a choice. The moment is in units
    of W b and the rotation in that at which an edge lifts off the bed, so that no other value
    counts.
    """
    weight, half_width, stiffness = 1.0, 1.0, 1.0
    bed = float(foundation.winkler_stiffness(stiffness, half_width))
    uplift = float(foundation.winkler_uplift_rotation(weight, bed, half_width))
    spacing = half_width / math.sqrt(3)
    rotation = np.linspace(0.0, 8.0, 1601) * uplift
    # the ground bears any moment up to that of the edge before the mat turns
    rigid = foundation.rigid_moment(rotation, weight, half_width)
    springs = foundation.two_spring_moment(rotation, weight, stiffness / 2, spacing)
    winkler = foundation.winkler_moment(rotation, weight, bed, half_width)
    names = "rigid ground", "two springs at $b/\\sqrt{3}$", "Winkler bed"
    moments = zip(names, (rigid, springs, winkler), strict=True)
    curves = [(name, rotation / uplift, moment / (weight * half_width)) for name, moment in moments]
    dr.draw_curves(ax, curves, dr.SOLID)
    first = foundation.two_spring_uplift_rotation(weight, stiffness / 2, spacing) / uplift
    for words, at, offset, side in (
        ("an edge lifts", (1.0, 1 / 3), (10, -14), "left"),
        ("a spring is free", (first, 1 / math.sqrt(3)), (-6, 5), "right"),
    ):
        ax.plot(*at, "o", color=style.INK, ms=4, zorder=5)
        ax.annotate(words, at, offset, textcoords="offset points", ha=side)
    rotation_label = r"rotation $\theta/\theta_{up}$ [-]"
    ax.set(xlabel=rotation_label, ylabel="moment $M/(W b)$ [-]", xlim=(0, 8), ylim=(0, 1.1))
    ax.legend(loc="lower right")


# --- 2.6 impacts as forces


@dr.thesis_axes(dr.Source.IN_KIND, 5.6, 3.4)
def figure_2_15(ax: Axes) -> None:
    """The Gaussian that becomes Dirac's delta.

    In kind: the text does not say for which n it is drawn; 1, 0.5, 0.2 and 0.1 are a choice.
    """
    x = np.linspace(-2.0, 2.0, 2001)
    bells = {n: np.exp(-((x / n) ** 2)) / (n * math.sqrt(math.pi)) for n in (1.0, 0.5, 0.2, 0.1)}
    dr.draw_curves(ax, [(f"$n$ = {n:g}", x, y) for n, y in bells.items()], dr.SOLID)
    ax.set(xlabel="$x$ [-]", ylabel=r"$\delta_n(x)$ [-]")
    ax.legend()


def released(n: float, duration: float = 8.0) -> rk.Response:
    """The 1:3 block of Figures 2-16 and 2-17, its impacts spread over the width n."""
    block = rk.DiracDeltaBlock(alpha=math.atan(1 / 3), energy_ratio=ENERGY_RATIO, regularisation=n)
    return let_go(block, duration, x=START)


def released_with_impacts(duration: float = 8.0) -> rk.Response:
    """The same with impacts in no time; p = 1 rad/s, so that seconds are scaled time."""
    block = rk.SlenderBlock.from_frequency(p=1.0, alpha=math.atan(1 / 3))
    return let_go(block, duration, rk.EnergyRatio(ENERGY_RATIO), theta=block.alpha * START)


def peaks_between(run: rk.Response) -> np.ndarray:
    """(m,) largest |x| between the passages through x = 0."""
    core = {"left_core", "right_core"}
    zeros = [e.time for e in run.events if {e.mode_before, e.mode_after} == core]
    x, t = np.abs(run["x"]), run.t
    return np.array([x[(t >= start) & (t <= end)].max() for start, end in pairwise(zeros)])


def exact_peaks(number: int) -> np.ndarray:
    """(number,) peaks after the impacts: each impact multiplies x - x**2/2 by r."""
    energy = (START - START**2 / 2) * ENERGY_RATIO ** np.arange(1, number + 1)
    return 1 - np.sqrt(1 - 2 * energy)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_2_16() -> Figure:
    """The block released from x = 0.4 by both formulations, and how the one nears the other.

    All is given: a 1:3 block, r = 0.7225, which is that of 2-6, and n = 1e-3. The steps are those
    of this package, whose error is far below the difference.
    """
    assert math.isclose(float(energy_ratio_of_block(math.atan(1 / 3))), ENERGY_RATIO)
    spread, sudden = released(1e-3), released_with_impacts()
    alpha = math.atan(1 / 3)
    figure = style.new_figure(9.0, 5.6)
    grid = figure.add_gridspec(3, 2, width_ratios=(1.7, 1.0))
    axes = [figure.add_subplot(grid[i, 0]) for i in range(3)]
    x = sudden["theta"] / alpha
    # of 2-17, without its force
    exact = (x, sudden["theta_dot"] / alpha, x - np.where(sudden.mode == "right", 1.0, -1.0))
    # the ground stands still: the horizontal reaction is alpha x''
    computed = (spread["x"], spread["x_dot"], spread["horizontal_reaction"] / alpha)
    names = ("$x$ [-]", r"$\dot{x}$ [-]", r"$\ddot{x}$ [-]")
    for ax, sharp, smooth, name in zip(axes, exact, computed, names, strict=True):
        ax.plot(sudden.t, sharp, label="piecewise", lw=1.6, color=style.LINES[0])
        ax.plot(
            spread.t, smooth, "--", label=r"Dirac-$\delta$, $n = 10^{-3}$", color=style.LINES[1]
        )
        ax.set(ylabel=name, xlim=(0, 8))
    axes[2].set_yscale("symlog", linthresh=1.0)
    axes[2].set_yticks([-10, -1, 0, 1, 10], ["-10", "-1", "0", "1", "10"])
    axes[2].set_xlabel(r"scaled time $\tau$ [-]")
    style.legend_above(axes[0])
    figure.align_ylabels(axes)

    ax = figure.add_subplot(grid[:, 1])
    widths = np.array([1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4])
    errors = np.array([np.abs(peaks_between(released(n))[:3] - exact_peaks(3)) for n in widths])
    for i, error in enumerate(errors.T):
        ax.loglog(widths, error, "o-", ms=3.5, color=style.LINES[i], label=f"peak {i + 1}")
    ax.loglog(widths, widths, ":", color=style.INK, label="$n$")
    ax.set(xlabel="$n$ [-]", ylabel="error of the peaks after an impact [-]")
    ax.legend()
    return figure


@dr.thesis_axes(dr.Source.IN_KIND, 7.2, 3.6)
def figure_2_17(ax: Axes) -> None:
    """The effect of n on the same motion.

    In kind: the text does not say for which three n it is drawn; 0.1, 0.01 and 0.001 are a choice.
    """
    runs = {n: released(n) for n in (1e-1, 1e-2, 1e-3)}
    dr.draw_curves(ax, [(f"$n$ = {n:g}", run.t, run["x"]) for n, run in runs.items()], dr.SOLID)
    sudden = released_with_impacts()
    ax.plot(sudden.t, sudden["theta"] / math.atan(1 / 3), ":", color=style.INK, label="piecewise")
    ax.set(xlim=(0, 8), xlabel=r"scaled time $\tau$ [-]", ylabel="$x$ [-]")
    style.legend_above(ax)
