"""Figures of 2.7, controlled rocking: hysteresis and its equivalent damping."""

import numpy as np
from matplotlib.axes import Axes

from rockeom.analysis import design, formulas
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr

LOADING, UNLOADING = style.LINES[0], style.LINES[1]
HARDENING, FLAG_HEIGHT, BILINEAR_HARDENING = 0.05, 0.35, 0.2
"""k_p/k_i and beta_FS of the flag, and k_p/k_i of the bilinear rule in Table 2-4."""

EXPONENTS = (0.3, 0.5)
"""Range assumed for alpha_T, which the thesis does not state; it is unsourced."""

RULES = {
    "bilinear": design.BilinearRule(1.0, 1.0, BILINEAR_HARDENING),
    "Takeda": design.TakedaRule(1.0, 1.0, HARDENING, EXPONENTS[1]),
    "flag": design.FlagRule(1.0, 1.0, HARDENING, FLAG_HEIGHT),
}
"""The rules of Figure 2-21, in units of yield, with the parameters of Table 2-4; Takeda's k_p/k_i,
which it does not state, is that of the flag."""


def draw_way(ax: Axes, u: np.ndarray, f: np.ndarray, color: str, label: str = "") -> None:
    """A line with an arrow in its middle."""
    ax.plot(u, f, color=color, label=label)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(u), np.diff(f)))])
    at = way[-1] * np.array([0.52, 0.56])
    x, y = np.interp(at, way, u), np.interp(at, way, f)
    ax.annotate(
        "", (x[1], y[1]), (x[0], y[0]), arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.0}
    )


def axes_through_zero(ax: Axes, title: str, xlabel: str = "displacement $u/u_y$ [-]") -> None:
    ax.axhline(0, color=style.INK, lw=0.6, zorder=1)
    ax.axvline(0, color=style.INK, lw=0.6, zorder=1)
    ax.set_title(title, fontsize=9)
    ax.set_xlabel(xlabel)


# --- the three kinds of systems


@dr.thesis_axes(dr.Source.IN_KIND, 8.6, 3.2, columns=3, sharey=True)
def figure_2_19(*axes: Axes) -> None:
    """Idealised force and displacement: fixed base, free rocking, controlled rocking.

    In kind: the figure gives no numbers. The ductile structure is bilinear, the block is rigid with
    the force F_y at uplift that falls to zero at its balance, ten times the yield displacement
    away, and the controlled one has the flag of Figure 2-21: k_p/k_i = 0.2 of the bilinear one and
    0.05 of the flag, beta_FS = 0.35. Blue is loading, orange unloading; the block's is the same
    line, drawn a little below.
    """
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
    titles = ("fixed base, ductile", "free rocking", "controlled rocking")
    for ax, title in zip(axes, titles, strict=True):
        axes_through_zero(ax, title)
    axes[0].set_ylabel("force $F/F_y$ [-]")


# --- the flag and its dissipaters


@dr.thesis_axes(dr.Source.IN_KIND, 8.6, 3.2, columns=3, sharey=True)
def figure_2_20(*axes: Axes) -> None:
    """Moment and rotation with added dissipaters: elastic and plastic, friction, viscous.

    In kind: the figure gives no numbers. The moment of the axial load and the added element is
    bilinear elastic, with k_p/k_i = 0.05 of a joint that is ten times stiffer before it opens than
    the dissipater; it is M_AE + M_N = lambda/(1 + lambda) at the design rotation, the dissipater
    M_ED = 1/(1 + lambda), by 2-30; lambda is 0.75, 1.25 and 3. The rotation is harmonic, with the
    design rotation as its amplitude.
    """
    for ax, kind in zip(axes, DISSIPATERS, strict=True):
        for ratio, color in zip(LAMBDAS, style.LINES, strict=False):
            loop = loop_with_dissipaters(kind, ratio)
            ax.plot(*closed(loop), color=color, label=rf"$\lambda$ = {ratio:g}")
        axes_through_zero(ax, kind, r"rotation $\theta/\theta_d$ [-]")
    axes[0].set_ylabel("moment $M/M_d$ [-]")
    axes[0].legend(loc="upper left", fontsize=7.5)


DISSIPATERS = ("elastic and plastic", "friction", "viscous")
LAMBDAS = (0.75, 1.25, 3.0)


def loop_with_dissipaters(kind: str, ratio: float) -> design.HysteresisLoop:
    """The second cycle of a harmonic rotation, in units of the design rotation and moment."""
    angle = np.linspace(0.0, 4 * np.pi, 801)
    theta, rate = np.sin(angle), np.cos(angle)
    restoring, dissipating = dissipaters(kind, ratio, theta, rate)
    late = angle >= 2 * np.pi - 1e-9
    moment = (restoring + dissipating)[late]
    return design.HysteresisLoop(theta[late][:-1], moment[:-1])


def closed(loop: design.HysteresisLoop) -> list[np.ndarray]:
    """The corners of a loop, the first once more at its end."""
    return [np.append(x, x[0]) for x in loop]


JOINT = design.FlagRule(1.0, 0.01, HARDENING * 0.01)
"""Moment of the axial load and the added element; it opens at 0.01 of the design rotation."""


def moment_at_design_over_opening() -> float:
    """The moment that re-centres, at the design rotation over that at which the joint opens."""
    return float(JOINT.backbone(1.0) / JOINT.yield_force)


def residual_rotation(ratio: float) -> float:
    """The rotation with no moment while it returns, of elastic and plastic dissipaters."""
    theta, moment = loop_with_dissipaters("elastic and plastic", ratio)
    back = (np.gradient(theta) < 0) & (theta > 0)
    below = moment[back] < 0
    return float(theta[back][np.argmax(below)]) if below.any() else 0.0


def dissipaters(
    kind: str, ratio: float, theta: np.ndarray, rate: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Moments of the elastic parts and of a dissipater along rotations and their rates."""
    elastic = JOINT.backbone(theta) / float(JOINT.backbone(1.0)) * ratio / (1 + ratio)
    share = 1 / (1 + ratio)
    if kind == "elastic and plastic":
        rule = design.BilinearRule(1.0, 0.1, 0.0)
        return elastic, share * rule.along(theta)
    return elastic, share * (np.sign(rate) if kind == "friction" else rate)


# --- hysteresis and equivalent damping


@dr.thesis_axes(dr.Source.IN_KIND, 8.6, 3.4, columns=3, sharey=True)
def figure_2_21(bilinear: Axes, takeda: Axes, flag: Axes) -> None:
    """Three rules of hysteresis, and what 2-32 makes of their loops.

    In kind: the figure gives no numbers. The ductility is 4, k_p/k_i = 0.2 for the bilinear rule
    and 0.05 for the others, beta_FS = 0.35, and alpha_T = 0.5, which is unsourced.
    """
    mu = 4.0
    for ax, (name, rule) in zip((bilinear, takeda, flag), RULES.items(), strict=True):
        loop = rule.simulated_loop(mu)
        ax.fill(*closed(loop), color=style.LINES[5], alpha=0.25, lw=0)
        ax.plot(*closed(loop), color=style.LINES[0])
        ax.plot([0, 1], [0, 1], ":", color=style.INK, lw=1.0)
        axes_through_zero(ax, rf"{name}: $\xi_{{hyst}}$ = {100 * loop.damping:.1f} %")
    bilinear.set_ylabel("force $F/F_y$ [-]")
    hardened, top = float(RULES["bilinear"].backbone(2.6)), float(RULES["flag"].backbone(3.0))
    low = (3.0, top - FLAG_HEIGHT)
    flag.annotate("", low, (3.0, top), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    for ax, words, at, offset in (
        (bilinear, "$k_i$", (0.5, 0.5), (4, -8)),
        (bilinear, "$k_p$", (2.6, hardened), (-8, 6)),
        (bilinear, r"$\mu u_y$", (4.0, 0.0), (-6, 5)),
        (takeda, r"$k_i\,\mu^{-\alpha_T}$", (2.8, 0.55), (3, -8)),
        (flag, r"$\beta_{FS} F_y$", low, (-12, -13)),
    ):
        ax.annotate(words, at, offset, textcoords="offset points", fontsize=8)


@dr.thesis_axes(dr.Source.IN_KIND, 5.8, 3.6)
def figure_2_22(ax: Axes) -> None:
    """Equivalent hysteretic damping against ductility: 2-32a to 2-32c.

    In kind: the parameters are not stated under the figure. k_p/k_i = 0.2 for the bilinear rule and
    0.05 for the flag, with beta_FS = 0.35, are those of Table 2-4. alpha_T is nowhere stated:
    Takeda's band is of 0.3 (upper edge) to 0.5, an unsourced range, with k_p/k_i = 0.05.
    """
    mu = np.linspace(1.0, 8.0, 281)
    for name, color in (("bilinear", style.LINES[0]), ("flag", style.LINES[2])):
        ax.plot(mu, 100 * RULES[name].damping(mu), color=color, label=name)
    low, high = (
        100 * design.TakedaRule(1.0, 1.0, HARDENING, exponent).damping(mu)
        for exponent in reversed(EXPONENTS)
    )
    label = rf"Takeda, $\alpha_T$ = {EXPONENTS[0]:g} to {EXPONENTS[1]:g}"
    ax.fill_between(mu, low, high, color=style.LINES[1], alpha=0.5, lw=0, label=label)
    ax.set(xlabel=r"ductility $\mu$ [-]", xlim=(1, 8), ylim=(0, 30))
    ax.set_ylabel(r"damping ratio $\xi_{hyst}$ [%]")
    ax.legend(loc="upper left", ncols=2)


def period_terms() -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Effective periods [s], and the term of 2-33 at each of them by rule of Table 2-4."""
    period = np.linspace(0.1, 4.0, 391)
    factors = formulas.damping.GRANT_FACTORS.items()
    return period, {name: 1 + (period + f.c) ** -f.d for name, f in factors}


@dr.thesis_axes(dr.Source.PRINTED, 6.4, 3.6)
def figure_2_23(ax: Axes) -> None:
    """How the damping of 2-33 depends on the period: its term 1 + (T_e + c)**-d, Table 2-4.

    Dotted is where the period adds 10 % to the damping.
    """
    period, terms = period_terms()
    curves = [(name.replace("_", " "), period, term) for name, term in terms.items()]
    dr.draw_curves(ax, curves, ("-", "--", "-.", ":", "-", "--"))
    ax.axhline(1.1, color=style.INK, lw=0.6, ls=":")
    ax.annotate("10 %", (4.0, 1.1), (2, 0), textcoords="offset points", va="center", fontsize=8)
    ax.set(xlabel="effective period $T_e$ [s]", xlim=(0, 4), ylim=(0.9, 3.0))
    ax.set_ylabel(r"$1 + (T_e + c)^{-d}$ [-]")
    ax.legend(loc="upper right", ncols=2)
