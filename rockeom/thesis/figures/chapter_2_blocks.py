"""Figures of 2.2 and 2.5: restitution, and the rigid block as a non-linear dynamic system.

The block of 2-10 to 2-14 has the states x = theta/alpha and x' = dx/dt in the time p t. Chapter 2
calls r a ratio of kinetic energies in 2-4, and in Figure 2-12, after Hogan (1989), a ratio of
speeds: there it is 0.5 as a ratio of speeds.
"""

import math
from functools import cache
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

import rockeom as rk
from rockeom.analysis import dynamics
from rockeom.analysis.dynamics.branches import FLIPS
from rockeom.analysis.formulas.restitution import energy_ratio_of_block
from rockeom.motion import STANDARD_GRAVITY
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import let_go
from rockeom.thesis.printed import TABLE_2_1

# --- 2.2 restitution


@dr.thesis_axes(dr.Source.PRINTED, 5.6, 3.6)
def figure_2_2(ax: Axes) -> None:
    """Restitution of blocks of different slenderness: 2-6 and the measured values of Table 2-1."""
    ratio, measured = (np.array(TABLE_2_1.numbers(name)) for name in ("H/B", "measured r"))
    slender = np.linspace(1.8, 9.0, 200)
    ax.plot(slender, energy_ratio_of_block(np.arctan(1 / slender)), color=style.INK, label="2-6")
    for source, rows, mark, color in (
        ("Ogawa (1977)", [0, 1, 2], "o", style.LINES[0]),
        ("Peña et al. (2007)", [3, 6, 7], "s", style.LINES[1]),
        ("Aslam et al. (1980)", [4], "^", style.LINES[2]),
        ("ElGawady et al. (2006)", [5], "D", style.LINES[3]),
    ):
        ax.plot(ratio[rows], measured[rows], mark, color=color, ms=5, label=source)
    ax.set(xlabel="slenderness $H/B$ [-]", ylabel=dr.RATIO, xlim=(1.8, 9.0), ylim=(0.35, 1.0))
    ax.legend(loc="lower right")


# --- 2.5 phase portraits

UNIT = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)
"""p = 1 rad/s, so that seconds are the time p t."""


def bare_portrait(ax: Axes, reach: float) -> None:
    ax.axhline(0, color=style.INK, lw=0.6)
    ax.axvline(0, color=style.INK, lw=0.6)
    ax.set(xlabel=r"rotation $x=\theta/\alpha$ [-]", xlim=(-reach, reach))
    ax.set_ylabel(r"rate $\dot x$ [-]")


def arrow(ax: Axes, x: np.ndarray, y: np.ndarray, at: int, color: str) -> None:
    ax.annotate(
        "", (x[at + 1], y[at + 1]), (x[at], y[at]),
        arrowprops={"arrowstyle": "->", "color": color, "lw": 1.1},
    )  # fmt: skip


@dr.thesis_axes(dr.Source.COMPUTED, 5.0, 4.2)
def figure_2_9(ax: Axes) -> None:
    """Phase portrait of a free block without losses, from a range of rotations.

    Drawn is 2-14; its trajectories are hyperbolas, x'**2 = (1 - |x|)**2 - (1 - x_0)**2. The
    rotations of the thesis are not stated: 0.2 to 0.95 of alpha are a choice of some of them. The
    balance bounds them (dashed).
    """
    for start, color in zip((0.2, 0.4, 0.6, 0.8, 0.95), style.LINES, strict=False):
        x = start * np.cos(np.linspace(0.0, np.pi, 801))  # closer together where it turns
        rate = -np.sqrt(np.maximum((1 - np.abs(x)) ** 2 - (1 - start) ** 2, 0.0))
        ax.plot(np.append(x, -x), np.append(rate, -rate), color=color, label=f"$x_0$ = {start:g}")
        arrow(ax, x, rate, 250, color)
    ax.plot([1, 0, -1, 0, 1], [0, -1, 0, 1, 0], "--", color=style.INK, lw=0.9, label="balance")
    bare_portrait(ax, 1.15)
    ax.legend(loc="upper right", bbox_to_anchor=(1.0, 1.0), fontsize=7.5)


@cache
def released_inside_balance() -> rk.Response:
    """The motion of Figure 2-10, free rocking of 2-14 from rest."""
    return let_go(UNIT, 120.0, rk.EnergyRatio(0.9), theta=0.99 * UNIT.alpha)


@dr.thesis_axes(dr.Source.COMPUTED, 5.0, 4.2)
def figure_2_10(ax: Axes) -> None:
    """Phase portrait of a free block with r = 0.9, released just inside its balance.

    Drawn is 2-14 from x = 0.99, which is a choice. r is the ratio of kinetic energies
    of 2-4, so that the speed falls to 0.949 of itself at each crossing; circles are the rates after
    the first six impacts.
    """
    run = released_inside_balance()
    x, rate = run["theta"] / UNIT.alpha, run["theta_dot"] / UNIT.alpha
    bare_portrait(ax, 1.15)
    ax.plot(x, rate, color=style.LINES[0], lw=0.9)
    arrow(ax, x, rate, int(np.argmax(x < 0.5)), style.LINES[0])
    after = [event.after["theta_dot"] / UNIT.alpha for event in run.impacts[:6]]
    ax.plot(np.zeros(6), after, "o", color=style.LINES[1], mfc="white", ms=5, zorder=6,
            label="after an impact")  # fmt: skip
    ax.legend(loc="upper right")


# --- 2.5 harmonic shaking of 2-13

SQUAT = rk.NondimensionalBlock(alpha=math.atan(0.5))
OMEGA, SPEED_RATIO = 2 * math.pi / 3, 0.5
PERIOD = 2 * math.pi / OMEGA


def shaking(beta: float, cycles: int) -> rk.GroundMotion:
    """beta cos(omega t) for so many cycles."""
    return rk.GroundMotion.harmonic(
        SQUAT.alpha * beta, period=PERIOD, phase=math.pi / 2, duration=cycles * PERIOD
    )


SETTLING, KEPT = 400, 24
"""Cycles of the ground before the ones that are shown, and those. Next to a doubling the motion
settles slowly: at beta = 3.1075 it has two speeds, and seems to have four after 120 cycles."""


@cache
def driven(beta: float) -> rk.Response:
    """2-13, put right, under beta cos(omega t) for `SETTLING` and `KEPT` cycles."""
    return rk.simulate(
        SQUAT, shaking(beta, SETTLING + KEPT), impact=rk.VelocityRatio(SPEED_RATIO),
        initial={"x": 0.1}, options=rk.SolverOptions(rtol=1e-9, atol=1e-11),
    )  # fmt: skip


def upright_speeds(run: rk.Response) -> np.ndarray:
    """(n,) rates x' with which the block comes upright in the cycles kept."""
    return np.array([e.before["x_dot"] for e in run.impacts if e.time > SETTLING * PERIOD])


def distinct(values: np.ndarray, apart: float = 2e-3) -> int:
    """How many values there are that differ by more than what has not settled."""
    return 1 + int((np.diff(np.sort(values)) > apart).sum()) if len(values) else 0


AMPLITUDES = np.linspace(3.0, 3.26, 105)
"""beta of Figure 2-12."""

START = 2.0
"""beta at which the motion of two mirrored halves is stable."""


def stroboscope(beta: float, speed_ratio: float = SPEED_RATIO) -> dynamics.StroboscopicMap:
    """The block under beta cos(omega t), looked at every half period, each second time mirrored."""
    law = rk.VelocityRatio(speed_ratio)
    return dynamics.StroboscopicMap(SQUAT, shaking(beta, 2), PERIOD, law, mirrored=True)


@cache
def symmetric_state() -> np.ndarray:
    """(2,) of the symmetric motion at `START`, settled."""
    return stroboscope(START).points({"x_dot": -0.3}, 60)[-1]


@cache
def cascade() -> dynamics.Cascade:
    """Break of symmetry and the first four doublings."""
    return dynamics.period_doublings(
        stroboscope, (START, AMPLITUDES[-1]), symmetric_state(), number=4
    )


@cache
def branches(doublings: int) -> tuple[dynamics.OrbitBranch, ...]:
    """The symmetric motions, the asymmetric ones, and those of so many doublings, to the end."""
    followed = [dynamics.orbit_branch(stroboscope, (START, AMPLITUDES[-1]), symmetric_state())]
    for _ in range(doublings + 1):
        leaves = next(one for one in followed[-1].bifurcations if one.kind in FLIPS)
        followed.append(followed[-1].switched(leaves))
    return tuple(followed)


@cache
def branches_by_energy() -> tuple[dynamics.OrbitBranch, dynamics.OrbitBranch]:
    """Symmetric and asymmetric motions where 0.5 is the ratio of energies, to the end.

    The first of them is reached from the ratio of speeds, which grows to sqrt(0.5).
    """
    ratio = math.sqrt(SPEED_RATIO)
    grown = dynamics.orbit_branch(
        lambda e: stroboscope(START, e), (SPEED_RATIO, ratio), symmetric_state(), step=0.1
    )  # fmt: skip
    symmetric = dynamics.orbit_branch(
        lambda beta: stroboscope(beta, ratio), (START, AMPLITUDES[-1]), grown.orbits[-1].state,
        step=0.05,
    )  # fmt: skip
    (broken,) = symmetric.bifurcations
    return symmetric, symmetric.switched(broken, step=0.05)


STABLE: dict[str, Any] = {"color": style.LINES[0], "lw": 0.9}
UNSTABLE: dict[str, Any] = {"color": style.LINES[1], "lw": 0.7, "ls": "--"}


def draw_branch(ax: Axes, branch: dynamics.OrbitBranch, states: np.ndarray) -> None:
    """States (k, m) of the motions of a branch, full where these last, dashed where they do not."""
    stable = np.abs(branch.multipliers).max(axis=1) < 1 - 1e-6  # not where one is on the circle
    until = stable | np.append(False, stable[:-1]) | np.append(stable[1:], False)
    ax.plot(branch.values, np.where(stable[:, None], np.nan, states), **UNSTABLE)
    ax.plot(branch.values, np.where(until[:, None], states, np.nan), **STABLE)


@dr.thesis_axes(dr.Source.IN_KIND, 8.6, 3.2, columns=3, sharey=True)
def figure_2_11(*axes: Axes) -> None:
    """Steady orbits of a block under harmonic shaking: symmetric, asymmetric, of two cycles.

    In kind: the values of the thesis are not stated. Drawn is 2-13, put right, with
    alpha = atan(0.5), omega = 2 pi/3 and a speed ratio of 0.5 as in Figure 2-12, under beta = 2,
    2.8 and 3.15: the orbit that lasts (full), and those that it has left, which are unstable
    (dashed).
    """
    titles = ("symmetric", "asymmetric", "two cycles")
    for i, (ax, beta, title) in enumerate(zip(axes, (2.0, 2.8, 3.15), titles, strict=True)):
        orbits = [branch.at(beta) for branch in branches(doublings=1)[: i + 1]]
        for orbit in orbits:
            _, states = orbit.trajectory()
            ax.plot(*states.T, **(STABLE if orbit.stable else UNSTABLE))
        bare_portrait(ax, 1.1 * float(max(orbit.size[0] for orbit in orbits)))
        ax.set_title(rf"{title}, $\beta$ = {beta:g}", fontsize=9)
        ax.label_outer()


@dr.thesis_axes(dr.Source.COMPUTED, 6.6, 4.4)
def figure_2_12(ax: Axes) -> None:
    """Period doubling under harmonic shaking: speeds when upright against the amplitude.

    All is given: alpha = atan(0.5), r = 0.5, omega = 2 pi/3, beta from 3 to 3.26. r is a ratio of
    speeds, and 2-13 is put right. Each beta starts from x = 0.1 and settles in 400 cycles; the
    speeds of the next 24 are dots. Each start finds one of two mirrored motions, which are drawn
    as the one whose faster passage is to the right.

    Lines are periodic motions, found by Newton's method and followed as beta changes: full where
    they last, dashed where they are unstable, the symmetric one and those of 1, 2, 4 and 8 cycles.
    Where one leaves another a multiplier is -1 (dotted).
    """
    for beta in AMPLITUDES:
        draw_settled(ax, float(beta))
    for branch in branches(doublings=3):
        speeds = branch.at_impacts("x_dot")
        turned = np.abs(speeds.max(axis=1)) < np.abs(speeds.min(axis=1))
        draw_branch(ax, branch, np.where(turned[:, None], -speeds, speeds))
        for leaves in branch.bifurcations:
            ax.axvline(leaves.value, color=style.INK, lw=0.5, ls=":")
    ax.set(xlabel=r"amplitude $\beta$ [-]", xlim=(3.0, 3.26))
    ax.set_ylabel(r"rate when upright $\dot x$ [-]")
    ax.plot([], [], ".", color=style.INK, ms=4, label="settled")
    ax.plot([], [], **STABLE, label="stable orbit")
    ax.plot([], [], **UNSTABLE, label="unstable orbit")
    ax.legend(loc="center left", fontsize=7.5)


def draw_settled(ax: Axes, beta: float) -> None:
    """Dots at the speeds of the settled motion, the faster passage to the right."""
    speeds = upright_speeds(driven(beta))
    mirror = 1.0 if abs(speeds.max()) >= abs(speeds.min()) else -1.0
    ax.plot(np.full_like(speeds, beta), mirror * speeds, ".", ms=1.6, mew=0, color=style.INK)


@cache
def settled_counts() -> np.ndarray:
    """Numbers of different speeds when upright, at each of `AMPLITUDES`."""
    return np.array([distinct(upright_speeds(driven(float(beta)))) for beta in AMPLITUDES])


# --- 2.5 pulses


def draw_rotations(
    ax: Axes, runs: list[tuple[str, rk.Response]], reach: float, until: float
) -> None:
    for (label, run), color in zip(runs, style.LINES, strict=False):
        fell = run.outcome == "overturned"
        alpha = run.structure.alpha  # type: ignore[attr-defined]
        label = f"{label}, overturns" if fell else label
        ax.plot(run.t, run["theta"] / alpha, "--" if fell else "-", color=color, label=label)
    ax.set(xlim=(0, until), ylim=(-reach, reach), xlabel=dr.TIME)
    ax.set_ylabel(r"rotation $\theta/\alpha$ [-]")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def sine_on_block(
    slenderness: float, amplitude: float, period: float, ratio: float | None
) -> rk.Case:
    """A block 2 m wide under one sine, its amplitude in g; r by 2-6 if none is given."""
    block = rk.RigidBlock(half_width=1.0, half_height=slenderness)
    pulse = rk.GroundMotion.single_sine(amplitude * STANDARD_GRAVITY, period, duration=20.0)
    return rk.Case(block, pulse, impact=None if ratio is None else rk.EnergyRatio(ratio))


@cache
def pulsed(slenderness: float, peak: float, period: float, ratio: float | None) -> rk.Response:
    """The motion of `sine_on_block`."""
    return rk.simulate(sine_on_block(slenderness, peak, period, ratio))


def fate(impacts: float) -> str:
    """A fate in words; impacts : before overturning, inf for none."""
    if math.isinf(impacts):
        return "stands"
    return {0.0: "overturns", 1.0: "overturns after an impact"}.get(
        impacts, f"overturns after {impacts:.0f} impacts"
    )


@cache
def changes_of_fate(
    name: str, first: float, last: float, cases: int, **of_all: float | None
) -> xr.Dataset:
    """Where the fate of `sine_on_block` changes along one of its arguments, to 1e-9 of it."""

    def case(**one: float) -> rk.Case:
        return sine_on_block(**one, **of_all)  # type: ignore[arg-type]

    over = {name: np.linspace(first, last, cases)}
    sweep = rk.simulate_many(case, over)
    return dynamics.overturning_boundaries(case, sweep, accuracy=1e-9)


def draw_fates(ax: Axes, boundaries: xr.Dataset, name: str, first: float, last: float) -> None:
    """A bar along `name` with the changes of fate to six digits."""
    at = boundaries[name].values
    fates = [*boundaries["below"].values, boundaries["above"].values[-1]]
    edges = [first, *at, last]
    for kind, low, high in zip(fates, edges[:-1], edges[1:], strict=True):
        ax.axvspan(low, high, color=STANDS if math.isinf(kind) else FATES[int(kind)], lw=0)
        middle = (low + high) / 2
        if high - low > 0.1 * (last - first):
            ax.text(middle, 0.5, fate(kind), ha="center", va="center", fontsize=8)
        else:
            line = {"arrowstyle": "-", **dr.THIN}
            ax.annotate(fate(kind), (middle, 1.0), (0, 15), textcoords="offset points",
                        ha="center", fontsize=8, arrowprops=line)  # fmt: skip
    for i, value in enumerate(at):
        aside = i + 1 < len(at) and at[i + 1] - value < 0.1 * (last - first)
        ax.annotate(
            f"{value:.6f}", (value, 1.0), (-2 if aside else 2, 2), textcoords="offset points",
            ha="right" if aside else "left", fontsize=8,
        )  # fmt: skip
        ax.axvline(value, **dr.THIN)
    ax.set(xlim=(first, last), ylim=(0, 1), yticks=[])
    ax.grid(visible=False)


STANDS, FATES = "#d5eadb", ("#c98a72", "#f2cdbb")
"""Colours of blocks that stand, of overturning without an impact, and after one."""


def fates_of_2_13() -> xr.Dataset:
    """Where the fate of the block of Figure 2-13 changes with the peak of the pulse."""
    return changes_of_fate("amplitude", 0.1, 0.6, 5001, slenderness=8.0, period=2.192, ratio=0.954)


@dr.thesis_axes(dr.Source.COMPUTED, 7.2, 4.4, 2, height_ratios=(5, 1))
def figure_2_13(above: Axes, below: Axes) -> None:
    """A block under one sine that grows: 0.172 g overturns it, 0.454 g does not.

    T = 2.192 s and r = 0.954, the ratio of energies of 2-6. The block "1 m wide and 8 m high" has
    these as its half-width and half-height: with half of them 0.454 g overturns it, too. The
    other peaks of the thesis are not stated; here they are 0.14, 0.3 and 0.5 g. Below stands at
    which peaks the fate changes, as it was found between 5001 pulses from 0.1 to 0.6 g: the range
    that holds 0.454 g, in which the block stands above weaker pulses that overturn it, is narrow.
    """
    peaks = (0.14, 0.172, 0.3, 0.454, 0.5)
    runs = {peak: pulsed(8.0, peak, 2.192, 0.954) for peak in peaks}
    draw_rotations(above, [(f"{peak:g} g", run) for peak, run in runs.items()], 1.8, 12.0)
    draw_fates(below, fates_of_2_13(), "amplitude", 0.1, 0.6)
    below.set_xlabel("peak of the pulse [g]")


RATIOS_OF_2_14 = (3.8, 3.82, 4.26, 4.28)
"""Aspect ratios H/B of the blocks of Figure 2-14."""


@dr.thesis_axes(dr.Source.IN_KIND, 7.2, 4.4, 2, height_ratios=(5, 1))
def figure_2_14(above: Axes, below: Axes) -> None:
    """Four blocks under one sine: small changes of the aspect ratio, large ones of the motion.

    The sine has 0.3 g and 2 s, r is by 2-6. In kind: the width is not stated; the half-width is
    1 m here, as in Figure 2-13. Below stands at which aspect ratio the fate changes, as it was
    found between 1501 blocks from 3.5 to 5.
    """
    runs = {ratio: pulsed(ratio, 0.3, 2.0, None) for ratio in RATIOS_OF_2_14}
    draw_rotations(above, [(f"H/B = {ratio:g}", run) for ratio, run in runs.items()], 1.6, 14.0)
    changes = changes_of_fate("slenderness", 3.5, 5.0, 1501, amplitude=0.3, period=2.0, ratio=None)
    draw_fates(below, changes, "slenderness", 3.5, 5.0)
    below.set_xlabel("aspect ratio $H/B$ [-]")
