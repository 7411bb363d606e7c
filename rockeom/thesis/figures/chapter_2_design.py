"""Figures of 2.7, controlled rocking: hysteresis and its equivalent damping."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.analysis import design, formulas
from rockeom.plots import style
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure

LOADING, UNLOADING = style.LINES[0], style.LINES[1]
HARDENING, FLAG_HEIGHT, EXPONENT = 0.05, 0.35, 0.5
"""Assumed k_p/k_i, beta_FS and alpha_T, where the thesis states none; Table 2-4 has the first
two of the flag."""

RULES = {
    "bilinear": design.BilinearRule(1.0, 1.0, HARDENING),
    "Takeda": design.TakedaRule(1.0, 1.0, HARDENING, EXPONENT),
    "flag": design.FlagRule(1.0, 1.0, HARDENING, FLAG_HEIGHT),
}
"""The rules of Figure 2-21, in units of yield."""


def draw_way(ax: Axes, u: np.ndarray, f: np.ndarray, color: str, label: str = "") -> None:
    """A line with an arrow in its middle."""
    ax.plot(u, f, color=color, label=label)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(u), np.diff(f)))])
    at = way[-1] * np.array([0.52, 0.56])
    x, y = np.interp(at, way, u), np.interp(at, way, f)
    ax.annotate(
        "", (x[1], y[1]), (x[0], y[0]), arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.0}
    )


def axes_through_zero(ax: Axes) -> None:
    ax.axhline(0, color=style.INK, lw=0.6, zorder=1)
    ax.axvline(0, color=style.INK, lw=0.6, zorder=1)


# --- the three kinds of systems


@thesis_figure(Source.COMPUTED)
def figure_2_19() -> Figure:
    """Idealised force and displacement: fixed base, free rocking, controlled rocking.

    The figure gives no numbers. Here the ductile structure is bilinear, the block is rigid with
    the force F_y at uplift that falls to zero at its balance, ten times the yield displacement
    away, and the controlled one has the flag of Figure 2-21; k_p/k_i = 0.05, beta_FS = 0.35. Blue
    is loading, orange unloading; the block's is the same line, drawn a little below.
    """
    figure = style.new_figure(8.6, 3.2)
    axes = figure.subplots(1, 3, sharey=True)
    mu = 5.0
    for ax, name in ((axes[0], "bilinear"), (axes[2], "flag")):
        rule = RULES[name]
        loaded = np.array([0.0, 1.0, mu])
        draw_way(ax, loaded, rule.along(loaded), LOADING)
        corners = rule.loop(mu).displacement
        back = np.concatenate([corners[: len(corners) // 2], [-mu]])
        force = rule.along(np.concatenate([loaded, back[1:]]))
        draw_way(ax, back, force[len(loaded) - 1 :], UNLOADING)
    balance, reach = 10.0, np.array([0.0, 5.0])
    force = 1 - reach / balance
    draw_way(axes[1], np.array([0.0, *reach]), np.array([0.0, *force]), LOADING)
    draw_way(axes[1], reach[::-1], force[::-1] - 0.03, UNLOADING)
    draw_way(axes[1], np.array([0.0, 0.0, -5.0]), np.array([1.0, -1.0, -0.5]), UNLOADING)
    for ax, title in zip(
        axes, ("fixed base, ductile", "free rocking", "controlled rocking"), strict=True
    ):
        axes_through_zero(ax)
        ax.set_title(title, fontsize=9)
        ax.set_xlabel("displacement $u/u_y$ [-]")
    axes[0].set_ylabel("force $F/F_y$ [-]")
    return figure


# --- the flag and its dissipaters


@thesis_figure(Source.COMPUTED)
def figure_2_20() -> Drawn:
    """Moment and rotation with added dissipaters: elastic and plastic, friction, viscous.

    The figure gives no numbers. The moment of the axial load and the added element is bilinear
    elastic, with k_p/k_i = 0.05 of a joint that is ten times stiffer before it opens than the
    dissipater; it is M_AE + M_N = lambda/(1 + lambda) at the design rotation, the dissipater
    M_ED = 1/(1 + lambda), by 2-30. The rotation is harmonic, with the design rotation as its
    amplitude.
    """
    figure = style.new_figure(8.6, 3.2)
    angle = np.linspace(0.0, 4 * np.pi, 801)
    theta, rate = np.sin(angle), np.cos(angle)
    kinds = ("elastic and plastic", "friction", "viscous")
    areas: dict[str, list[float]] = {kind: [] for kind in kinds}
    returns: dict[str, list[float]] = {kind: [] for kind in kinds}
    ratios = (0.75, 1.25, 3.0)
    for ax, kind in zip(figure.subplots(1, 3, sharey=True), kinds, strict=True):
        for ratio, color in zip(ratios, style.LINES, strict=False):
            restoring, dissipating = dissipaters(kind, ratio, theta, rate)
            moment = restoring + dissipating
            late = angle >= 2 * np.pi - 1e-9
            ax.plot(theta[late], moment[late], color=color, label=rf"$\lambda$ = {ratio:g}")
            loop = design.HysteresisLoop(theta[late][:-1], moment[late][:-1])
            areas[kind].append(loop.area)
            back = late & (rate < 0) & (theta > 0)
            returns[kind].append(float(theta[back][np.argmax(moment[back] < 0)])
                                 if (moment[back] < 0).any() else 0.0)  # fmt: skip
        axes_through_zero(ax)
        ax.set_title(kind, fontsize=9)
        ax.set_xlabel(r"rotation $\theta/\theta_d$ [-]")
    figure.axes[0].set_ylabel("moment $M/M_d$ [-]")
    figure.axes[0].legend(loc="upper left", fontsize=7.5)
    grows = all(np.all(np.diff(area) < 0) for area in areas.values())
    residual = returns["elastic and plastic"]
    return Drawn(
        figure,
        (
            Statement(
                "2.7", "the smaller lambda, the greater the flag's area",
                "; ".join(f"{k}: " + ", ".join(f"{a:.2f}" for a in v) for k, v in areas.items())
                + f" for lambda = {', '.join(f'{x:g}' for x in ratios)}",
                grows,
            ),
            Statement(
                "2.7", "lambda > 1: little or no residual displacement",
                "elastic and plastic: zero force at "
                + ", ".join(f"{x:.3f}" for x in residual) + " of the design rotation",
                bool(residual[0] > 0.05 and max(residual[1:]) < 0.05),
            ),
        ),
    )  # fmt: skip


def dissipaters(
    kind: str, ratio: float, theta: np.ndarray, rate: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Moments of the elastic parts and of a dissipater along rotations and their rates."""
    joint = design.FlagRule(1.0, 0.01, HARDENING * 0.01)
    elastic = joint.backbone(theta) / float(joint.backbone(1.0)) * ratio / (1 + ratio)
    share = 1 / (1 + ratio)
    if kind == "elastic and plastic":
        rule = design.BilinearRule(1.0, 0.1, 0.0)
        return elastic, share * rule.along(theta)
    return elastic, share * (np.sign(rate) if kind == "friction" else rate)


# --- hysteresis and equivalent damping


@thesis_figure(Source.COMPUTED)
def figure_2_21() -> Drawn:
    """Three rules of hysteresis, and what 2-32 makes of their loops.

    The figure gives no numbers: here the ductility is 4, k_p/k_i = 0.05, alpha_T = 0.5,
    beta_FS = 0.35.
    """
    figure = style.new_figure(8.6, 3.4)
    mu = 4.0
    worst = 0.0
    for ax, (name, rule) in zip(figure.subplots(1, 3, sharey=True), RULES.items(), strict=True):
        loop = rule.simulated_loop(mu)
        u, f = (np.append(x, x[0]) for x in loop)
        ax.fill(u, f, color=style.LINES[5], alpha=0.25, lw=0)
        ax.plot(u, f, color=style.LINES[0])
        ax.plot([0, 1], [0, 1], ":", color=style.INK, lw=1.0)
        axes_through_zero(ax)
        ax.set_title(rf"{name}: $\xi_{{hyst}}$ = {100 * loop.damping:.1f} %", fontsize=9)
        ax.set_xlabel("displacement $u/u_y$ [-]")
        worst = max(worst, abs(loop.damping / float(rule.damping(mu)) - 1))
    bilinear, takeda, flag = figure.axes
    bilinear.set_ylabel("force $F/F_y$ [-]")
    texts: dict[str, Any] = {"fontsize": 8, "textcoords": "offset points"}
    bilinear.annotate("$k_i$", (0.5, 0.5), xytext=(4, -8), **texts)
    bilinear.annotate("$k_p$", (2.6, 1.08), xytext=(0, 5), **texts)
    bilinear.annotate(r"$\mu u_y$", (4.0, 0.0), xytext=(-6, 5), **texts)
    takeda.annotate(r"$k_i\,\mu^{-\alpha_T}$", (2.8, 0.55), xytext=(3, -8), **texts)
    height = float(RULES["flag"].backbone(3.0))
    flag.annotate(
        "", (3.0, height - FLAG_HEIGHT), (3.0, height), arrowprops={"arrowstyle": "<->", "lw": 0.8}
    )
    flag.annotate(r"$\beta_{FS} F_y$", (3.0, height - FLAG_HEIGHT), xytext=(-12, -13), **texts)
    return Drawn(
        figure,
        (
            Statement(
                "2.7", "2-32a to 2-32c are the areas of these loops",
                f"simulated loops to {max(worst, 1e-15):.0e} of it", worst < 1e-9,
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_2_22() -> Drawn:
    """Equivalent hysteretic damping against ductility: 2-32a to 2-32c.

    The parameters are not stated; here k_p/k_i = 0.05, alpha_T = 0.5, beta_FS = 0.35.
    """
    mu = np.linspace(1.0, 8.0, 281)
    figure = style.new_figure(5.8, 3.6)
    ax = figure.add_subplot()
    damping_of = {name: rule.damping(mu) for name, rule in RULES.items()}
    for (name, damping), color in zip(damping_of.items(), style.LINES, strict=False):
        ax.plot(mu, 100 * damping, color=color, label=name)
    ax.set_xlabel(r"ductility $\mu$ [-]")
    ax.set_ylabel(r"damping ratio $\xi_{hyst}$ [%]")
    ax.set_xlim(1, 8)
    ax.set_ylim(0, None)
    ax.legend(loc="center right")
    ranges = {
        name: (damping_of[name][mu >= 1.5] / damping_of["flag"][mu >= 1.5])
        for name in ("bilinear", "Takeda")
    }
    inside = all(((r >= 2) & (r <= 3)).all() for r in ranges.values())
    text = ", ".join(f"{n} {r.min():.1f} to {r.max():.1f} times" for n, r in ranges.items())
    return Drawn(
        figure,
        (
            Statement(
                "2.7", "a flag has consistently 2 to 3 times less damping than the others",
                f"{text} the flag's, from a ductility of 1.5 to 8; the bilinear ratio is "
                f"2 (1 - k_p/k_i)/beta_FS = {2 * (1 - HARDENING) / FLAG_HEIGHT:.1f} at any "
                f"ductility, which is 2 to 3 for beta_FS from {2 * (1 - HARDENING) / 3:.2f} to "
                f"{1 - HARDENING:.2f}",
                inside,
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.PRINTED)
def figure_2_23() -> Drawn:
    """How the damping of 2-33 depends on the period: its term 1 + (T_e + c)**-d, Table 2-4."""
    period = np.linspace(0.1, 4.0, 391)
    figure = style.new_figure(6.4, 3.6)
    ax = figure.add_subplot()
    terms = {name: 1 + (period + f.c) ** -f.d for name, f in formulas.damping.GRANT_FACTORS.items()}
    lines = ("-", "--", "-.", ":", "-", "--")
    for (name, term), color, line in zip(terms.items(), style.LINES, lines, strict=True):
        ax.plot(period, term, line, color=color, label=name.replace("_", " "))
    ax.axhline(1.1, color=style.INK, lw=0.6, ls=":")
    ax.set_xlabel("effective period $T_e$ [s]")
    ax.set_ylabel(r"$1 + (T_e + c)^{-d}$ [-]")
    ax.set_xlim(0, 4)
    ax.set_ylim(0.9, 3.0)
    ax.legend(loc="upper right", ncols=2)
    beyond = {n: float(np.abs(t[period >= 1.0] - 1).max()) for n, t in terms.items()}
    near = [n.replace("_", " ") for n, far in beyond.items() if far <= 0.1]
    flag = terms["flag"][period >= 0.5]
    return Drawn(
        figure,
        (
            Statement(
                "2.7", "for most the term is within 10 % of 1 from 1 s on",
                f"for {len(near)} of {len(terms)}: {', '.join(near)}", len(near) > len(terms) / 2,
            ),
            Statement(
                "2.7", "from 2 s on it is effectively 1 in most",
                ", ".join(
                    f"{n.replace('_', ' ')} {float(np.interp(2.0, period, t)):.2f}"
                    for n, t in terms.items()
                ),
                sum(float(np.interp(2.0, period, t)) < 1.02 for t in terms.values()) > 3,
            ),
            Statement(
                "2.7", "the flag's is nearly constant at 1.5",
                f"{flag.max():.2f} at 0.5 s to {flag.min():.2f} at 4 s",
                bool(np.abs(flag - 1.5).max() < 0.15),
            ),
        ),
    )  # fmt: skip
