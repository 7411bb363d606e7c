"""Figures of 2.2 and 2.5: restitution, and the rigid block as a non-linear dynamic system.

The block of 2-10 to 2-14 has the states x = theta/alpha and x' = dx/dt in the time p t. Chapter 2
calls r a ratio of kinetic energies in 2-4, and in Figure 2-12, after Hogan (1989), a ratio of
speeds: there it is 0.5 as a ratio of speeds.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom.analysis.dynamics.branches import (
    FLIPS,
    Cascade,
    OrbitBranch,
    orbit_branch,
    period_doublings,
)
from rockeom.analysis.dynamics.orbits import PeriodicOrbit, StroboscopicMap
from rockeom.analysis.dynamics.overturning import overturning_boundaries
from rockeom.analysis.formulas.restitution import energy_ratio_of_block
from rockeom.analysis.sweeps import STANDS
from rockeom.analysis.unfinished import finished
from rockeom.motion import STANDARD_GRAVITY
from rockeom.plots import style
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.printed import TABLE_2_1

# --- 2.2 restitution


@thesis_figure(Source.PRINTED)
def figure_2_2() -> Drawn:
    """Restitution of blocks of different slenderness: 2-6 and the measured values of Table 2-1."""
    ratio, measured = (np.array(TABLE_2_1.numbers(name)) for name in ("H/B", "measured r"))
    predicted = energy_ratio_of_block(np.arctan(1 / ratio))
    slender = np.linspace(1.8, 9.0, 200)
    figure = style.new_figure(5.6, 3.6)
    ax = figure.add_subplot()
    ax.plot(slender, energy_ratio_of_block(np.arctan(1 / slender)), color=style.INK, label="2-6")
    sources = (
        "Ogawa (1977)",
        "Peña et al. (2007)",
        "Aslam et al. (1980)",
        "ElGawady et al. (2006)",
    )
    for source, rows, mark, color in zip(
        sources, ([0, 1, 2], [3, 6, 7], [4], [5]), "os^D", style.LINES, strict=False
    ):
        ax.plot(ratio[rows], measured[rows], mark, color=color, ms=5, label=source)
    ax.set_xlabel("slenderness $H/B$ [-]")
    ax.set_ylabel("energy ratio $r$ [-]")
    ax.set_xlim(1.8, 9.0)
    ax.set_ylim(0.35, 1.0)
    ax.legend(loc="lower right")
    error = measured - predicted
    squat = np.abs(error[ratio <= 4]).mean()
    slim = np.abs(error[ratio > 4]).mean()
    return Drawn(
        figure,
        (
            Statement(
                "2.2", "measured r in general exceed those of 2-6",
                f"{int((error > 0).sum())} of {len(error)} do", bool((error > 0).mean() > 0.5),
            ),
            Statement(
                "2.2", "the inconsistencies diminish as the slenderness increases",
                f"mean error {squat:.3f} up to H/B = 4, {slim:.3f} beyond", bool(slim < squat),
            ),
        ),
    )  # fmt: skip


# --- 2.5 phase portraits

UNIT = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)
"""p = 1 rad/s, so that seconds are the time p t."""


def free_portrait(start: float, law: rk.EnergyRatio, duration: float) -> rk.Response:
    """Free rocking of 2-14 from rest at x."""
    return rk.simulate(
        UNIT,
        rk.GroundMotion.none(duration),
        impact=law,
        initial={"theta": start * UNIT.alpha},
    )


def bare_portrait(ax: Axes, reach: float) -> None:
    ax.axhline(0, color=style.INK, lw=0.6)
    ax.axvline(0, color=style.INK, lw=0.6)
    ax.set_xlabel(r"rotation $x=\theta/\alpha$ [-]")
    ax.set_ylabel(r"rate $\dot x$ [-]")
    ax.set_xlim(-reach, reach)


def arrow(ax: Axes, x: np.ndarray, y: np.ndarray, at: int, color: str) -> None:
    ax.annotate(
        "", (x[at + 1], y[at + 1]), (x[at], y[at]),
        arrowprops={"arrowstyle": "->", "color": color, "lw": 1.1},
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_2_9() -> Figure:
    """Phase portrait of a free block without losses, from a range of rotations.

    Drawn is 2-14; its trajectories are hyperbolas, x'**2 = (1 - |x|)**2 - (1 - x_0)**2. The
    rotations of the thesis are not stated: here they are 0.2 to 0.95 of alpha, and the balance,
    which bounds them (dashed).
    """
    figure = style.new_figure(5.0, 4.2)
    ax = figure.add_subplot()
    for start, color in zip((0.2, 0.4, 0.6, 0.8, 0.95), style.LINES, strict=False):
        x = start * np.cos(np.linspace(0.0, np.pi, 801))  # closer together where it turns
        rate = -np.sqrt(np.maximum((1 - np.abs(x)) ** 2 - (1 - start) ** 2, 0.0))
        ax.plot(np.append(x, -x), np.append(rate, -rate), color=color, label=f"$x_0$ = {start:g}")
        arrow(ax, x, rate, 250, color)
    ax.plot([1, 0, -1, 0, 1], [0, -1, 0, 1, 0], "--", color=style.INK, lw=0.9, label="balance")
    bare_portrait(ax, 1.15)
    ax.legend(loc="upper right", bbox_to_anchor=(1.0, 1.0), fontsize=7.5)
    return figure


@thesis_figure(Source.COMPUTED)
def figure_2_10() -> Drawn:
    """Phase portrait of a free block with r = 0.9, released just inside its balance.

    Drawn is 2-14 from x = 0.99, which is a choice. r is the ratio of kinetic energies of 2-4, so
    that the speed falls to 0.949 of itself at each crossing.
    """
    run = free_portrait(0.99, rk.EnergyRatio(0.9), 120.0)
    x, rate = run["theta"] / UNIT.alpha, run["theta_dot"] / UNIT.alpha
    figure = style.new_figure(5.0, 4.2)
    ax = figure.add_subplot()
    ax.plot(x, rate, color=style.LINES[0], lw=0.9)
    arrow(ax, x, rate, int(np.argmax(x < 0.5)), style.LINES[0])
    crossings = run.impacts[:6]
    after = np.array([abs(e.after["theta_dot"]) for e in crossings])
    before = np.array([abs(e.before["theta_dot"]) for e in crossings])
    ax.plot(np.zeros(len(after)), [e.after["theta_dot"] / UNIT.alpha for e in crossings], ".",
            color=style.LINES[1], ms=5, label="after an impact")  # fmt: skip
    bare_portrait(ax, 1.15)
    ax.legend(loc="upper right")
    energy_ratios = (after / before) ** 2
    return Drawn(
        figure,
        (
            Statement(
                "2.5.1", "r = 0.9 at every crossing of the y axis, by 2-4",
                f"{energy_ratios.min():.4f} to {energy_ratios.max():.4f} of the kinetic energy",
                bool(np.allclose(energy_ratios, 0.9, rtol=1e-6)),
            ),
            Statement(
                "2.5.1", "in the long term the block comes to rest",
                f"{run.outcome} after p t = {run.events.rest_time or math.nan:.1f}",
                run.outcome == "came to rest",
            ),
        ),
    )  # fmt: skip


# --- 2.5 harmonic shaking of 2-13

SQUAT = rk.NondimensionalBlock(alpha=math.atan(0.5))
OMEGA, SPEED_RATIO = 2 * math.pi / 3, 0.5
PERIOD = 2 * math.pi / OMEGA
SETTLING, KEPT = 120, 24
"""Cycles of the ground before the ones that are shown, and those."""


@cache
def driven(beta: float, start: tuple[float, float] = (0.1, 0.0)) -> rk.Response:
    """2-13, put right, under beta cos(omega t) for `SETTLING` and `KEPT` cycles."""
    ground = rk.GroundMotion.harmonic(
        SQUAT.alpha * beta,
        period=PERIOD,
        phase=math.pi / 2,
        duration=(SETTLING + KEPT) * PERIOD,
    )
    return rk.simulate(
        SQUAT,
        ground,
        impact=rk.VelocityRatio(SPEED_RATIO),
        initial={"x": start[0], "x_dot": start[1]},
        options=rk.SolverOptions(rtol=1e-9, atol=1e-11, output_step=PERIOD / 100),
    )


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


def stroboscope(beta: float, speed_ratio: float = SPEED_RATIO) -> StroboscopicMap:
    """The block under beta cos(omega t), looked at every half period, each second time mirrored."""
    ground = rk.GroundMotion.harmonic(
        SQUAT.alpha * beta, period=PERIOD, phase=math.pi / 2, duration=2 * PERIOD
    )
    return StroboscopicMap(SQUAT, ground, PERIOD, rk.VelocityRatio(speed_ratio), mirrored=True)


@cache
def symmetric_state() -> np.ndarray:
    """(2,) of the symmetric motion at `START`, settled."""
    return stroboscope(START).points({"x_dot": -0.3}, 60)[-1]


@cache
def cascade() -> Cascade:
    """Break of symmetry and the first five doublings."""
    return period_doublings(stroboscope, (START, AMPLITUDES[-1]), symmetric_state(), number=5)


@cache
def branches(doublings: int) -> tuple[OrbitBranch, ...]:
    """The symmetric motions, the asymmetric ones, and those of so many doublings, to the end."""
    followed = [finished(orbit_branch(stroboscope, (START, AMPLITUDES[-1]), symmetric_state()))]
    for _ in range(doublings + 1):
        leaves = next(one for one in followed[-1].bifurcations if one.kind in FLIPS)
        followed.append(finished(followed[-1].switched(leaves)))
    return tuple(followed)


@cache
def branches_by_energy() -> tuple[OrbitBranch, OrbitBranch]:
    """Symmetric and asymmetric motions where 0.5 is the ratio of energies, to the end.

    The first of them is reached from the ratio of speeds, which grows to sqrt(0.5).
    """
    ratio = math.sqrt(SPEED_RATIO)
    grown = finished(orbit_branch(
        lambda e: stroboscope(START, e), (SPEED_RATIO, ratio), symmetric_state(), step=0.1
    ))  # fmt: skip
    symmetric = finished(orbit_branch(
        lambda beta: stroboscope(beta, ratio), (START, AMPLITUDES[-1]), grown.orbits[-1].state,
        step=0.05,
    ))  # fmt: skip
    (broken,) = symmetric.bifurcations
    return symmetric, finished(symmetric.switched(broken, step=0.05))


STABLE: dict[str, Any] = {"color": style.LINES[0], "lw": 0.9}
UNSTABLE: dict[str, Any] = {"color": style.LINES[1], "lw": 0.7, "ls": "--"}


def draw_branch(ax: Axes, branch: OrbitBranch, states: np.ndarray) -> None:
    """States (k, m) of the motions of a branch, full where these last, dashed where they do not."""
    stable = np.abs(branch.multipliers).max(axis=1) < 1 - 1e-6  # not where one is on the circle
    until = stable | np.append(False, stable[:-1]) | np.append(stable[1:], False)
    ax.plot(branch.values, np.where(stable[:, None], np.nan, states), **UNSTABLE)
    ax.plot(branch.values, np.where(until[:, None], states, np.nan), **STABLE)


@thesis_figure(Source.IN_KIND)
def figure_2_11() -> Drawn:
    """Steady orbits of a block under harmonic shaking: symmetric, asymmetric, of two cycles.

    The values of the thesis are not stated. Drawn is 2-13, put right, with alpha = atan(0.5),
    omega = 2 pi/3 and a speed ratio of 0.5 as in Figure 2-12, under beta = 2, 2.8 and 3.15: the
    orbit that lasts (full), and those that it has left, which are unstable (dashed).
    """
    figure = style.new_figure(8.6, 3.2)
    lasting = []
    for i, (ax, beta, title) in enumerate(zip(
        figure.subplots(1, 3, sharey=True), (2.0, 2.8, 3.15),
        ("symmetric", "asymmetric", "two cycles"), strict=True,
    )):  # fmt: skip
        orbits = [branch.at(beta) for branch in branches(doublings=1)[: i + 1]]
        for orbit in orbits:
            _, states = orbit.trajectory()
            ax.plot(*states.T, **(STABLE if orbit.stable else UNSTABLE))
        bare_portrait(ax, 1.1 * float(max(orbit.size[0] for orbit in orbits)))
        ax.set_title(rf"{title}, $\beta$ = {beta:g}", fontsize=9)
        lasting.append((beta, orbits[-1]))
    for ax in figure.axes[1:]:
        ax.set_ylabel("")
    orbits_in_words = "; ".join(
        f"beta = {beta:g}: {described(orbit)}, multipliers up to {abs(orbit.multipliers[0]):.3f}"
        for beta, orbit in lasting
    )
    return Drawn(
        figure,
        (
            Statement(
                "Figure 2-11", "there are symmetric and asymmetric steady orbits", orbits_in_words,
                all(orbit.stable for _, orbit in lasting)
                and [orbit.symmetric for _, orbit in lasting] == [True, False, False],
            ),
        ),
    )  # fmt: skip


def described(orbit: PeriodicOrbit) -> str:
    return f"{'' if orbit.symmetric else 'a'}symmetric {orbit.order}"


@thesis_figure(Source.COMPUTED)
def figure_2_12() -> Drawn:
    """Period doubling under harmonic shaking: speeds when upright against the amplitude.

    All is given: alpha = atan(0.5), r = 0.5, omega = 2 pi/3, beta from 3 to 3.26. r is a ratio of
    speeds, and 2-13 is put right. Each beta starts from x = 0.1 and settles in 120 cycles; the
    speeds of the next 24 are dots. Each start finds one of two mirrored motions, which are drawn
    as the one whose faster passage is to the right.

    Lines are periodic motions, found by Newton's method and followed as beta changes: full where
    they last, dashed where they are unstable, the symmetric one and those of 1, 2, 4 and 8 cycles.
    Where one leaves another a multiplier is -1. These beta are found to 1e-8; where they pile up
    follows from the last two and Feigenbaum's constant.
    """
    figure = style.new_figure(6.6, 4.4)
    ax = figure.add_subplot()
    counts = [draw_settled(ax, float(beta)) for beta in AMPLITUDES]
    for branch in branches(doublings=3):
        speeds = branch.at_impacts("x_dot")
        turned = np.abs(speeds.max(axis=1)) < np.abs(speeds.min(axis=1))
        draw_branch(ax, branch, np.where(turned[:, None], -speeds, speeds))
    for one in cascade().bifurcations[1:]:
        ax.axvline(one.value, color=style.INK, lw=0.5, ls=":")
    ax.set_xlabel(r"amplitude $\beta$ [-]")
    ax.set_ylabel(r"rate when upright $\dot x$ [-]")
    ax.set_xlim(3.0, 3.26)
    ax.plot([], [], ".", color=style.INK, ms=4, label="settled")
    ax.plot([], [], **STABLE, label="stable orbit")
    ax.plot([], [], **UNSTABLE, label="unstable orbit")
    ax.legend(loc="center left", fontsize=7.5)
    return Drawn(figure, statements_on_doubling(np.array(counts)))


def draw_settled(ax: Axes, beta: float) -> int:
    """Dots at the speeds of the settled motion, the faster passage to the right; their number."""
    speeds = upright_speeds(driven(beta))
    mirror = 1.0 if abs(speeds.max()) >= abs(speeds.min()) else -1.0
    ax.plot(np.full_like(speeds, beta), mirror * speeds, ".", ms=1.6, mew=0, color=style.INK)
    return distinct(speeds)


def statements_on_doubling(counts: np.ndarray) -> tuple[Statement, ...]:
    """Statements of section 2.5.1 and Figure 2-12; counts : of dots at each of `AMPLITUDES`."""
    doubled = {n: AMPLITUDES[counts == n] for n in (2, 4, 8)}
    dots = "; ".join(
        f"{n} dots from {b.min():.3f} to {b.max():.3f}" for n, b in doubled.items() if len(b)
    )
    smeared = AMPLITUDES[counts > 16]
    breaks, *values = cascade().values
    limits = cascade().accumulations
    by_energy = branches_by_energy()
    flips = [one for one in by_energy[1].bifurcations if one.value > AMPLITUDES[0]]
    return (
        Statement(
            "2.5.1", "two dots are a (1,1) orbit, 4 and 8 those of 2 and 4 cycles",
            dots, all(len(b) > 0 for b in doubled.values()),
        ),
        Statement(
            "2.5.1", "the period doubles with increasing frequency until a distinct point",
            f"the symmetry breaks at {breaks:.8f}; the period doubles at "
            + ", ".join(f"{value:.8f}" for value in values)
            + f"; the doublings pile up at {limits[-1]:.6f}, by the two before the last "
            f"{limits[-2]:.6f}",
            bool((np.diff(values) > 0).all() and cascade().ratios[-1] > 4.0),
        ),
        Statement(
            "Figure 2-12", "r = 0.5",
            "as a ratio of energies, as in 2-4, the (1,1) orbit does not double from 3 to "
            f"3.26: its symmetry breaks at {by_energy[0].bifurcations[0].value:.8f}, and the "
            "orbit behind lasts"
            if not flips and by_energy[1].stable[1:].all() else f"also of energies {flips}",
            bool(flips),
        ),
        Statement(
            "2.5.1", "smeared bands for beta > 3.34, where the figure has ended",
            f"from {smeared.min():.3f} on: 3.234 may be meant" if len(smeared) else "none",
            len(smeared) == 0,
        ),
    )  # fmt: skip


# --- 2.5 pulses


def draw_rotations(
    ax: Axes, runs: list[tuple[str, rk.Response]], reach: float, until: float
) -> None:
    for (label, run), color in zip(runs, style.LINES, strict=False):
        ratio = run["theta"] / run.structure.alpha  # type: ignore[attr-defined]
        fell = run.outcome == "overturned"
        ax.plot(run.t, ratio, color=color, ls="--" if fell else "-",
                label=f"{label}{', overturns' if fell else ''}")  # fmt: skip
    ax.set_xlim(0, until)
    ax.set_ylim(-reach, reach)
    ax.set_xlabel("time [s]")
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
    case = sine_on_block(slenderness, peak, period, ratio)
    return rk.simulate(case.structure, case.motion, impact=case.impact)


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
    sweep = finished(rk.simulate_many(case, over))
    return finished(overturning_boundaries(case, sweep, accuracy=1e-9))


def draw_fates(ax: Axes, boundaries: xr.Dataset, name: str, first: float, last: float) -> None:
    """A bar along `name` with the changes of fate to six digits."""
    at = boundaries[name].values
    fates = [*boundaries["below"].values, boundaries["above"].values[-1]]
    edges = [first, *at, last]
    for kind, low, high in zip(fates, edges[:-1], edges[1:], strict=True):
        ax.axvspan(low, high, color="white" if math.isinf(kind) else FATES[int(kind)], lw=0)
        if high - low > 0.1 * (last - first):
            ax.text((low + high) / 2, 0.5, fate(kind), ha="center", va="center", fontsize=8)
    for i, value in enumerate(at):
        aside = i + 1 < len(at) and at[i + 1] - value < 0.1 * (last - first)
        ax.annotate(
            f"{value:.6f}", (value, 1.0), (-2 if aside else 2, 2), textcoords="offset points",
            ha="right" if aside else "left", fontsize=8,
        )  # fmt: skip
        ax.axvline(value, color=style.INK, lw=0.8)
    ax.set(xlim=(first, last), ylim=(0, 1), yticks=[])
    ax.grid(visible=False)


FATES = ("#c98a72", "#f2cdbb")
"""Colours of overturning without an impact, and after one."""


@thesis_figure(Source.COMPUTED)
def figure_2_13() -> Drawn:
    """A block under one sine that grows: 0.172 g overturns it, 0.454 g does not.

    T = 2.192 s and r = 0.954, the ratio of energies of 2-6. The block "1 m wide and 8 m high" has
    these as its half-width and half-height: with half of them 0.172 g does not overturn it. The
    other peaks of the thesis are not stated; here they are 0.14, 0.3 and 0.5 g. Below stands at
    which peaks the fate changes, as it was found between 5001 pulses from 0.1 to 0.6 g.
    """
    peaks = (0.14, 0.172, 0.3, 0.454, 0.5)
    runs = {peak: pulsed(8.0, peak, 2.192, 0.954) for peak in peaks}
    figure = style.new_figure(7.2, 4.4)
    above, below = figure.subplots(2, height_ratios=(5, 1))
    draw_rotations(above, [(f"{peak:g} g", run) for peak, run in runs.items()], 1.8, 12.0)
    changes = changes_of_fate(
        "amplitude", 0.1, 0.6, 5001, slenderness=8.0, period=2.192, ratio=0.954
    )
    draw_fates(below, changes, "amplitude", 0.1, 0.6)
    below.set_xlabel("peak of the pulse [g]")
    weak, strong = runs[0.172], runs[0.454]
    reached = abs(strong.extremes("theta").peak) / strong.structure.alpha  # type: ignore[attr-defined]
    at = changes["amplitude"].values
    fates = [f"{fate(f)} from {a:.6f} g" for a, f in zip(at, changes["above"].values, strict=True)]
    return Drawn(
        figure,
        (
            Statement("2.5.1", "a pulse of 0.172 g overturns it",
                      f"{weak.outcome}; pulses do from {at[0]:.6f} g on",
                      weak.outcome == "overturned"),
            Statement("2.5.1", "one of 0.454 g does not",
                      f"{strong.outcome}, at most {reached:.2f} alpha",
                      strong.outcome in STANDS),
            Statement("2.5.1", "a stronger pulse may be the safer one",
                      "; ".join(fates), bool(np.isinf(changes["above"]).any())),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_2_14() -> Drawn:
    """Four blocks under one sine: small changes of the aspect ratio, large ones of the motion.

    The sine has 0.3 g and 2 s, r is by 2-6. The width is not stated: the half-width is 1 m here,
    as in Figure 2-13. Below stands at which aspect ratio the fate changes, as it was found between
    1501 blocks from 3.5 to 5.
    """
    ratios = (3.8, 3.82, 4.26, 4.28)
    runs = {ratio: pulsed(ratio, 0.3, 2.0, None) for ratio in ratios}
    figure = style.new_figure(7.2, 4.4)
    above, below = figure.subplots(2, height_ratios=(5, 1))
    draw_rotations(above, [(f"H/B = {ratio:g}", run) for ratio, run in runs.items()], 1.6, 14.0)
    changes = changes_of_fate("slenderness", 3.5, 5.0, 1501, amplitude=0.3, period=2.0, ratio=None)
    draw_fates(below, changes, "slenderness", 3.5, 5.0)
    below.set_xlabel("aspect ratio $H/B$ [-]")
    peaks = {
        ratio: abs(run.extremes("theta").peak) / run.structure.alpha  # type: ignore[attr-defined]
        for ratio, run in runs.items()
    }
    fell = [ratio for ratio, run in runs.items() if run.outcome == "overturned"]
    fates = ", ".join(
        f"{ratio:g}: {'overturns' if ratio in fell else f'{peak:.2f} alpha'}"
        for ratio, peak in peaks.items()
    )
    at = ", ".join(f"{value:.6f}" for value in changes["slenderness"].values)
    return Drawn(
        figure,
        (
            Statement(
                "2.5.1", "0.5 % of the aspect ratio can lead to a very different response",
                f"{fates}; the fate changes at {at}",
                (3.8 in fell) != (3.82 in fell) or (4.26 in fell) != (4.28 in fell),
            ),
        ),
    )  # fmt: skip
