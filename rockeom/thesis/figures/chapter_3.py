"""The figures of chapter 3, the free rocking block; see `rockeom.thesis.figures`.

The text prints only the thirteen points of Figure 3-3 of the 430 tests; the traces are lost. In
kind here means simulated records of the same block, sampled as the tests were, a thousand times a
second, with noise of 0.01 degrees, and with an r for each foot: the means of those that Figure 3-3
gives.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.symbolic import Body, coordinate, parameter, rocking_structure, turned
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.points_of_interest import (
    importance_scores,
    points_by_prominence,
    points_by_score,
)
from rockeom.thesis.printed import BLOCK as BLOCK_VALUES, FIGURE_3_3

BLOCK = rk.RigidBlock(**BLOCK_VALUES)
SHAPE: dict[str, Any] = {"mass": BLOCK.mass, "alpha": BLOCK.alpha, "radius": BLOCK.radius}
R_HOUSNER = float(formulas.energy_ratio_of_block(BLOCK.alpha))
PRINTED_HOUSNER = 0.89
"""Energy ratio of section 3.3; 2-6 gives 0.879 for this block."""

RATE, NOISE = 1000, float(np.radians(0.01))
"""Samples a second, and the standard deviation of the noise of a simulated record [rad]."""

SPRING = 300.0
"""Stiffness of the hypothetical rotational spring in simulated records [N m/rad]; not printed."""
THRESHOLD = 6.0
"""Energy below which the thesis leaves impacts out [J]."""


# --- what is printed


@cache
def points() -> tuple[np.ndarray, np.ndarray]:
    """(13,) times [s] and rotations [rad] of Figure 3-3: peaks and zeros in turn."""
    rows = np.array(FIGURE_3_3.rows, dtype=float)
    return rows[:, 0], np.radians(rows[:, 1])


@cache
def measured_impacts() -> identification.Impacts:
    """The six impacts between the peaks of Figure 3-3; a thousandth of a degree is printed."""
    time, rotation = points()
    rounding = np.radians(0.001) / np.sqrt(12)
    return identification.Impacts.of_peaks(time[::2], rotation[::2], BLOCK, deviation=rounding)


@cache
def feet() -> dict[str, float]:
    """Mean r of Figure 3-3 at each foot that lands."""
    impacts = measured_impacts()
    return {f: float(np.mean(impacts.at_foot(f).energy_ratio)) for f in ("left", "right")}


def mark_points(ax: Axes, label: str = "Figure 3-3, measured") -> None:
    """The printed peaks and zeros, in degrees."""
    time, rotation = points()
    ax.plot(
        time, np.degrees(rotation), "o", color=style.INK, mfc="white", mew=0.9, ms=4, zorder=5,
        label=label,
    )  # fmt: skip


# --- records in kind


def rocking(structure: rk.Structure, release: float, duration: float) -> rk.Response:
    """A free decay from a release [rad] whose r is that of the foot that lands."""
    return rk.simulate(
        structure,
        rk.GroundMotion.none(duration),
        impact=rk.EnergyRatio(**feet()),
        initial={"theta": release},
    )


@cache
def on_spring() -> rk.Structure:
    """The block with a rotational spring: the steel mechanism of section 3.2.2, if it were one."""
    theta = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
    values = [
        parameter("m", "mass", "kg", "mass"),
        parameter("I", "inertia", "kg m2", "moment of inertia about the centroid"),
        parameter("H", "height", "m", "height of the centroid"),
        parameter("B", "half_width", "m", "half of the distance between the feet"),
        parameter("k", "rotational_stiffness", "N m/rad", "stiffness of the spring"),
        parameter("g", "gravity", "m/s2", "acceleration of gravity"),
    ]
    m, inertia, height, half_width, k, g = (value.symbol for value in values)
    model = rocking_structure(
        name="block_on_a_spring",
        title="Rigid block with a rotational spring",
        parameters=values,
        coordinates=[theta],
        bodies=lambda pivot: [
            Body("block", m, turned((0, height), pivot, theta.position), inertia, theta.position)
        ],
        half_width=half_width,
        gravity=g,
        elastic_energy=k * theta.position**2 / 2,
    )
    own = BLOCK.parameters()
    return rk.structure(model, **own, rotational_stiffness=SPRING)


@cache
def record(release: float = 7.876, seed: int = 0, spring: bool = False) -> analysis.MeasuredRecord:
    """A simulated record in kind: five seconds from a release [deg], with its noise."""
    structure = on_spring() if spring else BLOCK
    t = np.arange(5 * RATE) / RATE
    theta = rocking(structure, float(np.radians(release)), 5.0).at(t)["theta"]
    noise = np.random.default_rng(seed).normal(0.0, NOISE, len(t))
    return analysis.MeasuredRecord(t, {"theta": theta + noise}, {"theta": NOISE})


@cache
def housner(ratio: float, duration: float = 5.0) -> rk.Response:
    """Housner's block released as that of Figure 3-3."""
    return rk.simulate(
        BLOCK,
        rk.GroundMotion.none(duration),
        impact=rk.EnergyRatio(ratio),
        initial={"theta": float(points()[1][0])},
    )


# --- the motion


@thesis_figure(Source.PRINTED)
def figure_3_3() -> Drawn:
    """Rotation of the block after a release: the thirteen printed points.

    The line is a simulated block in kind, its r that of the printed peaks of each foot. The block
    of the test was let go some 0.07 s after time 0, which is put in here.
    """
    time, rotation = points()
    run = rocking(BLOCK, float(rotation[0]), 3.2)
    late = time[1] - formulas.exact_quarter_period(
        rotation[0], BLOCK.alpha, BLOCK.frequency_parameter
    )
    figure = style.new_figure(7.2, 3.2)
    ax = figure.add_subplot()
    left, right = (feet()[f] for f in ("left", "right"))
    label = f"simulated, r = {left:.2f} and {right:.2f} (left, right foot lands)"
    held = np.append(rotation[0], run["theta"])
    ax.plot(np.append(0.0, run.t + late), np.degrees(held), label=label)
    mark_points(ax)
    ax.set_xlim(0, 3.2)
    ax.set_xlabel("time [s]")
    ax.set_ylabel(r"rotation $\theta$ [deg]")
    style.legend_above(ax)
    impacts = measured_impacts()
    listed = ", ".join(f"{r:.3f}" for r in impacts.energy_ratio)
    quarters = np.diff(time)[::2]
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.4",
                "energy dissipation of impacts on the left edge is markedly different to that on "
                "the right edge",
                f"r by 3-3 of the printed peaks: {listed}; the left foot lands first",
                bool(
                    impacts.at_foot("left").energy_ratio.max()
                    < impacts.at_foot("right").energy_ratio.min()
                ),
            ),
            Statement(
                "section 3.2",
                "the period of vibration decreases as the peak amplitude is decreased",
                "quarter periods from peaks: " + ", ".join(f"{q:.3f}" for q in quarters) + " s",
                bool(np.all(np.diff(quarters) < 0)),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_3_4() -> Drawn:
    """How the thesis's algorithm finds peaks: the score of each sample, and SciPy's finder.

    A window of 500 samples moves along; its largest and its smallest sample have a point each. The
    threshold was the user's choice and is not printed: here it is half of the window. The trace is
    a simulated record. scipy.signal.find_peaks asks for a prominence of ten standard deviations of
    the noise instead.
    """
    data = record()
    scores = importance_scores(data["theta"], 500)
    scored = points_by_score(data, "theta")
    by_prominence = points_by_prominence(data, "theta")
    figure = style.new_figure(7.2, 4.4)
    trace, score = figure.subplots(2, 1, sharex=True, height_ratios=(1.5, 1.0))
    trace.plot(data.time, np.degrees(data["theta"]), lw=0.8, color=style.INK)
    for rows, mark, color, label in (
        (by_prominence.peaks, "s", style.LINES[1], "find_peaks"),
        (scored.peaks, "o", style.LINES[0], "score above the threshold"),
    ):
        size = 7 if mark == "s" else 4
        trace.plot(
            data.time[rows], np.degrees(data["theta"][rows]), mark, ms=size, mfc="none",
            color=color, label=f"{label}: {len(rows)}",
        )  # fmt: skip
    trace.set_ylabel(r"rotation $\theta$ [deg]")
    trace.legend(loc="upper right", ncols=2)
    score.plot(data.time, scores, lw=0.8, color=style.LINES[0])
    score.axhline(250, color=style.INK, ls="--", lw=0.8)
    score.annotate("threshold", (4.95, 250), (0, 3), textcoords="offset points", ha="right")
    score.set_ylabel("score [-]")
    score.set_xlabel("time [s]")
    score.set_xlim(0, 5)
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2",
                "each test run contained at least 20 peaks and zero crossings",
                f"of 5 s: by score {len(scored.peaks)} peaks, {len(scored.crossings)} crossings; "
                f"by find_peaks {len(by_prominence.peaks)} and {len(by_prominence.crossings)}",
                len(scored.peaks) + len(scored.crossings) >= 20,
            ),
        ),
    )


@thesis_figure(Source.PRINTED)
def figure_3_5() -> Drawn:
    """Quarter periods against the peak rotation: Figure 3-3, 2-5, and the block of any rotation.

    A quarter ends or begins at a printed peak. The first one of the test is 0.07 s too long: the
    block was let go later than at time 0.
    """
    time, rotation = points()
    quarters = np.diff(time)
    peaks = np.abs(np.where(rotation[:-1] != 0, rotation[:-1], rotation[1:]))
    p, alpha = BLOCK.frequency_parameter, BLOCK.alpha
    slender = formulas.quarter_period(peaks / alpha, p)
    exact = formulas.exact_quarter_period(peaks, alpha, p)
    x = np.linspace(0.0, 0.8, 200)
    figure = style.new_figure(6.2, 3.6)
    ax = figure.add_subplot()
    ax.set_prop_cycle(color=style.LINES)
    ax.plot(x, formulas.quarter_period(x, p), label="2-5, slender")
    ax.fill_between(
        x, 0.9 * formulas.quarter_period(x, p), 1.1 * formulas.quarter_period(x, p), alpha=0.12,
        lw=0, label="within 10 %",
    )  # fmt: skip
    ax.plot(x, formulas.exact_quarter_period(x * alpha, alpha, p), "--", label="any rotation")
    for first, mark, label in ((0, "o", "from a peak"), (1, "s", "to a peak")):
        ax.plot(
            peaks[first::2] / alpha, quarters[first::2], mark, color=style.INK, mfc="white",
            mew=0.9, ms=4, label=f"Figure 3-3, {label}",
        )  # fmt: skip
    ax.set_xlabel(r"peak rotation $|\theta_0|/\alpha$ [-]")
    ax.set_ylabel("quarter period [s]")
    ax.set_xlim(0, 0.8)
    ax.set_ylim(0, 0.6)
    ax.legend(loc="upper left")
    later = slice(1, None)
    error = slender[later] / quarters[later] - 1
    worst = 100 * np.abs(error).max()
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.1",
                "2-5 was generally accurate within 10 %",
                f"{worst:.1f} % at most of 11 quarters; the first, which holds the delay of the "
                f"release, {100 * (slender[0] / quarters[0] - 1):.1f} %",
                bool(worst < 10),
            ),
            Statement(
                "section 3.2.1",
                "the formula typically over-predicted the experimental periods",
                f"in {np.sum(error > 0)} of 11 quarters, by {100 * error.mean():+.1f} % on the "
                f"average; the exact one by {100 * (exact / quarters - 1)[later].mean():+.1f} %",
                bool(np.sum(error > 0) > 5),
            ),
        ),
    )


@thesis_figure(Source.PRINTED)
def figure_3_6() -> Drawn:
    """Rotation in time: the printed points of Figure 3-3 and Housner's block with two r.

    r is the 0.89 of section 3.3, and 0.88 of it. The measured points are moved by the 0.07 s by
    which the block was let go after time 0. The trace of the thesis's figure, another run perhaps,
    is not printed.
    """
    time, rotation = points()
    late = time[1] - float(
        formulas.exact_quarter_period(rotation[0], BLOCK.alpha, BLOCK.frequency_parameter)
    )
    figure = style.new_figure(7.2, 3.2)
    ax = figure.add_subplot()
    ends: list[float] = []
    errors = []
    for ratio, line in ((PRINTED_HOUSNER, "-"), (0.88 * PRINTED_HOUSNER, "--")):
        run = housner(ratio, 14.0)
        label = f"simulated, r = {ratio:.3f}"
        ax.plot(run.t, np.degrees(run["theta"]), line, lw=0.9, label=label)
        ends.append(run.events.rest_time or np.inf)
        own = [hit.time for hit in run.impacts[:6]]
        errors.append(np.array(own) - (time[1::2] - late))
    moved = np.maximum(time - late, 0.0)
    ax.plot(
        moved, np.degrees(rotation), "o", color=style.INK, mfc="white", mew=0.9, ms=4,
        label="Figure 3-3, measured",
    )  # fmt: skip
    ax.set_xlim(0, 6)
    ax.set_xlabel("time after the release [s]")
    ax.set_ylabel(r"rotation $\theta$ [deg]")
    style.legend_above(ax)
    first = [float(np.abs(e[:6]).max()) for e in errors]
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.1",
                "the matching is improved for the first few cycles if r is decreased to 0.88 of "
                "Housner's",
                f"the six crossings are off by {first[0]:.2f} s at most with 0.89, by "
                f"{first[1]:.2f} s with 0.88 of it",
                first[1] < first[0],
            ),
            Statement(
                "section 3.2.1",
                "this predicts the motion to cease much earlier",
                f"at {ends[1]:.1f} s instead of {ends[0]:.1f} s",
                bool(ends[1] < 0.8 * ends[0]),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_3_7() -> Drawn:
    """Phase diagrams of the record in kind and of Housner's block with two r.

    The rate of the record is found by differentiation (a polynomial of degree 4 over 0.05 s), which
    rounds the jumps at the impacts. A is the first quarter, B the return half a cycle later.
    """
    figure = style.new_figure(7.6, 3.6)
    derived = record().with_derivatives("theta", 0.05)
    inside = derived.time < 2.4
    speeds = {}
    for ax, ratio in zip(
        figure.subplots(1, 2, sharey=True), (PRINTED_HOUSNER, 0.88 * PRINTED_HOUSNER), strict=True
    ):
        ax.plot(
            np.degrees(derived["theta"][inside]), derived["theta_dot"][inside], lw=0.8,
            color=style.INK, label="record in kind",
        )  # fmt: skip
        run = housner(ratio, 14.0)
        end = run.t < run.impacts[4].time
        label = f"simulated, r = {ratio:.3f}"
        ax.plot(np.degrees(run["theta"][end]), run["theta_dot"][end], "--", lw=0.9, label=label)
        ax.annotate("A", (4.0, -0.66), ha="center", va="top")
        ax.annotate("B", (-3.2, 0.6), ha="center", va="bottom")
        ax.set_xlabel(r"rotation $\theta$ [deg]")
        style.legend_above(ax)
        speeds[ratio] = [abs(hit.before["theta_dot"]) for hit in run.impacts[:2]]
        if not ax.get_subplotspec().colspan.start:
            ax.set_ylabel(r"rate $\dot\theta$ [rad/s]")
    printed = np.abs(measured_impacts().speed[:2])
    again = record().velocities_by_resampling("theta", 0.05)
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.1",
                "after the release it did not reach the predicted peak rotation at the opposing "
                "side yet it attained the predicted speed by the next impact",
                f"from the printed peaks, without another energy, {printed[1]:.3f} rad/s before "
                f"the second impact; predicted {speeds[PRINTED_HOUSNER][1]:.3f} with r = 0.89 and "
                f"{speeds[0.88 * PRINTED_HOUSNER][1]:.3f} with 0.88 of it; measured speeds are "
                "not printed",
                None,
            ),
            Statement(
                "section 3.2.2",
                "filtering, up- and down-sampling all resulted in more or less the same velocity",
                f"in kind: the rate at half and twice the sampling is off by {again.spread:.4f} "
                f"rad/s (standard deviation), its noise being {again.noise:.4f} rad/s",
                bool(again.spread < 1.5 * again.noise),
            ),
        ),
    )


# --- energy


def draw_energies(
    ax: Axes, time: np.ndarray, curves: list[tuple[str, np.ndarray, dict[str, Any]]]
) -> None:
    for label, energy, line in curves:
        ax.plot(time, energy, label=label, **line)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("energy [J]")
    ax.set_ylim(0, None)


POTENTIAL = {"color": style.LINES[0], "lw": 0.9}
KINETIC = {"color": style.LINES[2], "lw": 0.9}
TOTAL = {"color": style.LINES[1], "lw": 1.2}


@thesis_figure(Source.COMPUTED)
def figure_3_8() -> Drawn:
    """Idealised energy of a rocking cycle: Housner's block, released as in Figure 3-3.

    A to D are those of 3-3: peak, just before the impact, just after it, next peak.
    """
    run = housner(R_HOUSNER)
    upright = BLOCK.energies({}, mode="both")["gravitational_energy"]
    end = run.t <= run.impacts[1].time + 0.4
    potential, kinetic = run["gravitational_energy"] - upright, run["kinetic_energy"]
    figure = style.new_figure(7.0, 3.2)
    ax = figure.add_subplot()
    draw_energies(
        ax,
        run.t[end],
        [
            ("potential $U$", potential[end], POTENTIAL),
            ("kinetic $E_k$", kinetic[end], KINETIC),
            ("total", (potential + kinetic)[end], TOTAL),
        ],
    )
    first = run.impacts[0].time
    peak = run.t[np.argmin(np.where(run.t < run.impacts[1].time, run["theta"], np.inf))]
    start = potential[0]
    for name, at, height in (
        ("A", 0.0, start), ("B", first, start), ("C", first, R_HOUSNER * start),
        ("D", peak, R_HOUSNER * start),
    ):  # fmt: skip
        ax.plot(at, height, "o", color=style.INK, ms=4, zorder=6)
        ax.annotate(name, (at, height), (5, 4), textcoords="offset points")
    ax.set_ylim(0, 1.15 * start)
    style.legend_above(ax)
    after = float(BLOCK.energies(run.impacts[0].after, mode="left")["kinetic_energy"])
    ratio = after / float(BLOCK.energies(run.impacts[0].before, mode="right")["kinetic_energy"])
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.2",
                "immediately after an impact the kinetic energy is reduced to r times that before",
                f"{ratio:.6f} with r = {R_HOUSNER:.6f}; the total is constant within "
                f"{np.ptp((potential + kinetic)[run.t < first]) / start:.0e} of it before",
                bool(abs(ratio - R_HOUSNER) < 1e-9),
            ),
        ),
    )


@cache
def energies_in_kind() -> tuple[analysis.MeasuredRecord, identification.Energies]:
    """The record of the block on the spring, and the energies of the block alone."""
    derived = record(spring=True).with_derivatives("theta", 0.05)
    return derived, identification.record_energies(derived, BLOCK)


@thesis_figure(Source.IN_KIND)
def figure_3_9() -> Drawn:
    """Energy of the block in a record in kind, whose block has a spring that nobody knows of.

    The text suspects the steel mechanism to be a rotational spring and does not print its
    stiffness; here it is 300 N m/rad. The energies are those of the block alone, 3-1 and 3-2, the
    rate by differentiation over 0.05 s, which rounds the impacts.
    """
    derived, energies = energies_in_kind()
    end = derived.time < 3
    figure = style.new_figure(7.0, 3.4)
    ax = figure.add_subplot()
    draw_energies(
        ax,
        derived.time[end],
        [
            ("potential $U$", energies.gravity[end], POTENTIAL),
            ("kinetic $E_k$", energies.kinetic[end], KINETIC),
            ("total", energies.total[end], TOTAL),
        ],
    )
    start = float(identification.static_energy(BLOCK, np.radians(7.876)))
    ax.axhline(start, color=style.INK, lw=0.7, ls="--", label="at the release")
    style.legend_above(ax)
    most = float(energies.total[end].max())
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.2",
                "the block at times possessed potential and kinetic energy greater than the "
                "theoretical maximum",
                f"{most:.1f} J of {start:.1f} J at the release, by construction: the spring's",
                None,
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_3_10() -> Drawn:
    """The same with the energy of the hypothetical spring, fitted to the record, 3-4.

    Fitted is the stiffness with which the total changes least within each half-cycle. The thesis
    takes the largest excess and the rotation at which it occurs instead.
    """
    derived, energies = energies_in_kind()
    fit = identification.fitted_rotational_spring(derived, BLOCK, count=5)
    stored = formulas.spring_energy(derived["theta"], fit.stiffness)
    end = derived.time < 3
    figure = style.new_figure(7.0, 3.4)
    ax = figure.add_subplot()
    draw_energies(
        ax,
        derived.time[end],
        [
            ("potential $U$", energies.gravity[end], POTENTIAL),
            ("kinetic $E_k$", energies.kinetic[end], KINETIC),
            ("spring", stored[end], {"color": style.LINES[3], "lw": 0.9}),
            ("total", (energies.total + stored)[end], TOTAL),
            ("without the spring", energies.total[end], TOTAL | {"ls": ":", "lw": 0.8}),
        ],
    )
    style.legend_above(ax)
    smooth = identification.support_forces_of_record(
        record(spring=True), window=0.05, **SHAPE
    ).smooth
    first = smooth & (derived.time > 0.05) & (derived.time < 0.4)
    spread = [float(np.std(e[first])) for e in (energies.total, energies.total + stored)]
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.2",
                'the "total" energy content has become noticeably more constant during the smooth '
                "rocking phase",
                f"standard deviation in the first quarter {spread[0]:.2f} J without, "
                f"{spread[1]:.2f} J with the spring; fitted {fit.stiffness:.0f} ± "
                f"{2 * fit.deviation:.0f} N m/rad of 300",
                spread[1] < spread[0] / 2 and abs(fit.stiffness - SPRING) < 3 * fit.deviation,
            ),
        ),
    )


RUNS = ((7.876, 1), (6.5, 2), (5.0, 3), (3.5, 4))
"""Releases [deg] and seeds of four runs in kind; the thesis's four are not stated."""
WINDOW = 0.03
"""Window of the derivatives that give impact forces [s]; the thesis does not state its own."""


# --- support forces


@thesis_figure(Source.COMPUTED)
def figure_3_13() -> Drawn:
    """Support forces of Housner's block, released as in Figure 3-3.

    r is 0.879, of 2-6; that of the figure is not printed. The forces at the impacts, infinite for
    no time, are not drawn.
    """
    run = housner(R_HOUSNER, 14.0)
    vertical = run["left_reaction"] + run["right_reaction"]
    figure = style.new_figure(7.2, 4.2)
    axes = figure.subplots(2, 1, sharex=True)
    for ax, force, name in zip(
        axes, (run["horizontal_reaction"], vertical), ("horizontal", "vertical"), strict=True
    ):
        ax.plot(run.t, force / 1e3, lw=0.8, color=style.LINES[0])
        ax.set_ylabel(f"{name} force [kN]")
    weight = BLOCK.mass * BLOCK.gravity / 1e3
    axes[1].axhline(weight, color=style.INK, ls="--", lw=0.8)
    axes[1].annotate("weight", (9.9, weight), (0, 3), textcoords="offset points", ha="right")
    axes[1].set_xlabel("time [s]")
    axes[1].set_xlim(0, 10)
    figure.align_ylabels(axes)
    before = BLOCK.reactions(run.impacts[0].before, mode="right")
    v, h = before["right_reaction"] / 1e3, abs(before["horizontal_reaction"]) / 1e3
    limit_h, limit_v = formulas.block_reactions_at_impact(0.0, 1, slender=True, **SHAPE)
    return Drawn(
        figure,
        (
            Statement(
                "Table 3-1",
                "baseline at 0.771 rad/s: 3.08 kN vertical, 0.48 kN horizontal",
                f"{v:.3f} and {h:.3f} kN at {abs(run.impacts[0].before['theta_dot']):.3f} rad/s",
                bool(abs(v - 3.08) < 0.01 and abs(h - 0.48) < 0.01),
            ),
            Statement(
                "section 3.2.3",
                "about to stop, the horizontal force chatters between extremes while the vertical "
                "one settles below the weight",
                f"limits 3-14 and 3-15: ±{abs(limit_h) / 1e3:.3f} kN and {limit_v / 1e3:.3f} kN, "
                f"the weight being {weight:.3f} kN",
                bool(limit_v < weight * 1e3),
            ),
        ),
    )


@thesis_figure(Source.COMPUTED)
def figure_3_14() -> Drawn:
    """Support forces just before and after an impact against the speed: 3-11 and 3-12.

    Up to the largest speed of free rocking, 3-13. Positive speed: the right foot lands. The angle
    is that of the resultant from the vertical.
    """
    most = float(formulas.impact_speed(BLOCK.alpha, alpha=BLOCK.alpha, radius=BLOCK.radius))
    speed = np.linspace(-most, most, 401)
    figure = style.new_figure(7.6, 3.0)
    axes = figure.subplots(1, 3)
    spans = {}
    for side, label, line in ((1, "on the right foot", "-"), (-1, "on the left foot", "--")):
        h, v = formulas.block_reactions_at_impact(speed, side, slender=True, **SHAPE)
        angle = np.degrees(np.arctan2(h, v))
        for ax, y in zip(axes, (h / 1e3, v / 1e3, angle), strict=True):
            ax.plot(speed, y, line, label=label)
        spans[side] = np.ptp(v) / v.max(), np.ptp(h) / np.abs(h).max(), np.ptp(angle)
    axes[0].set_ylabel("horizontal force [kN]")
    axes[1].set_ylabel("vertical force [kN]")
    axes[2].set_ylabel("angle of the resultant [deg]")
    axes[1].set_ylim(0, 3.6)
    for ax in axes:
        ax.set_xlabel(r"speed $\dot\theta$ [rad/s]")
    axes[2].legend(loc="center")
    v, h, angle = spans[1]
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.3",
                "the support forces remain relatively constant for the probable range of speeds, "
                "and so does their direction",
                f"up to {most:.2f} rad/s the vertical force changes by {100 * v:.0f} %, the "
                f"horizontal one by {100 * h:.0f} %, the angle by {angle:.1f} degrees",
                bool(v < 0.25 and h < 0.25 and angle < 3),
            ),
        ),
    )


@cache
def impact_forces() -> identification.ImpactForces:
    """Impacts of the four runs in kind above 0.15 rad/s, with a tenth of the noise."""
    forces = []
    for release, seed in RUNS:
        theta = rocking(BLOCK, float(np.radians(release)), 5.0)
        t = np.arange(5 * RATE) / RATE
        noise = np.random.default_rng(seed).normal(0.0, NOISE / 10, len(t))
        calm = analysis.MeasuredRecord(t, {"theta": theta.at(t)["theta"] + noise})
        forces.append(identification.impact_forces_of_record(calm, window=WINDOW, **SHAPE))
    columns = [np.concatenate(column) for column in zip(*forces, strict=True)]
    fast = np.abs(columns[1]) > 0.15
    return identification.ImpactForces(*(column[fast] for column in columns))


def grows(speed: np.ndarray, force: np.ndarray) -> float:
    """Growth of a force from 0.2 to 0.8 rad/s on the straight line through its points."""
    slope, level = np.polyfit(np.abs(speed), force, 1)
    return float((level + 0.8 * slope) / (level + 0.2 * slope) - 1)


@thesis_figure(Source.IN_KIND)
def figure_3_15() -> Drawn:
    """Largest forces about each impact of records in kind against the speed, and the baseline.

    The impacts of the simulation have no duration: what is drawn over the baseline, 3-11 and 3-12,
    is the jump of the rate, spread over the window of the derivatives, here 0.03 s. The thesis does
    not state its window; its four parts are two here. The noise is a tenth of that of the others.
    """
    forces = impact_forces()
    figure = style.new_figure(7.4, 3.2)
    axes = figure.subplots(1, 2)
    for ax, force, base, name in (
        (axes[0], forces.vertical, forces.baseline_vertical, "vertical"),
        (axes[1], forces.horizontal, forces.baseline_horizontal, "horizontal"),
    ):
        for foot, side, mark in (("left", -1, "<"), ("right", 1, ">")):
            one = np.sign(forces.speed) == side
            ax.plot(
                forces.speed[one], np.abs(force[one]) / 1e3, mark, ms=4, color=style.FEET[foot],
                label=f"{foot} foot lands",
            )  # fmt: skip
        ax.plot(forces.speed, np.abs(base) / 1e3, "_", color=style.INK, ms=6, label="baseline")
        ax.set_xlabel(r"speed $\dot\theta$ before the impact [rad/s]")
        ax.set_ylabel(f"largest {name} force [kN]")
    axes[1].legend(loc="upper center")
    left = forces.speed < 0
    vertical, horizontal = (
        grows(forces.speed[left], np.abs(f[left])) for f in (forces.vertical, forces.horizontal)
    )
    worst = int(np.argmax(np.abs(forces.speed)))
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.3",
                "the vertical impact forces remain fairly constant, the horizontal one increases "
                "linearly with larger impact speed",
                f"so it is where nothing but a jump of the rate is differentiated: from 0.2 to 0.8 "
                f"rad/s {100 * vertical:+.0f} % and {100 * horizontal:+.0f} % (left foot)",
                bool(abs(vertical) < 0.15 and horizontal > 0.5),
            ),
            Statement(
                "Table 3-1",
                "measured peaks 3.43 kN vertical and 1.62 kN horizontal, over 3.08 and 0.48 kN",
                f"{np.abs(forces.vertical[worst]) / 1e3:.2f} and "
                f"{np.abs(forces.horizontal[worst]) / 1e3:.2f} kN with the window of 0.03 s, of an "
                "impact without duration: such peaks say nothing of its force",
                None,
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_3_16() -> Drawn:
    """Magnitude and direction of the largest forces of Figure 3-15 against the speed; in kind.

    The angle is that of the resultant from the vertical.
    """
    forces = impact_forces()
    angle = np.degrees(forces.angle)
    figure = style.new_figure(7.4, 3.2)
    axes = figure.subplots(1, 2)
    for foot, side, mark in (("left", -1, "<"), ("right", 1, ">")):
        one = np.sign(forces.speed) == side
        for ax, y in zip(axes, (forces.magnitude / 1e3, angle), strict=True):
            ax.plot(
                forces.speed[one], y[one], mark, ms=4, color=style.FEET[foot],
                label=f"{foot} foot lands",
            )  # fmt: skip
    axes[0].set_ylabel("magnitude [kN]")
    axes[0].set_ylim(0, None)
    axes[1].set_ylabel("angle from the vertical [deg]")
    for ax in axes:
        ax.set_xlabel(r"speed $\dot\theta$ before the impact [rad/s]")
    axes[0].legend(loc="lower center")
    left = forces.speed < 0
    change = [
        float(np.polyval(np.polyfit(np.abs(forces.speed[left]), angle[left], 1), v))
        for v in (0.2, 0.8)
    ]
    more = grows(forces.speed[left], forces.magnitude[left])
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.3",
                "the resultant increases only slightly with the speed, but its direction becomes "
                "more horizontal",
                f"from 0.2 to 0.8 rad/s {100 * more:+.0f} %, and from {change[0]:.0f} to "
                f"{change[1]:.0f} degrees (left foot), of impacts without duration",
                bool(more < 0.25 and change[1] > change[0] + 5),
            ),
        ),
    )


# --- restitution


@thesis_figure(Source.IN_KIND)
def figure_3_17() -> Drawn:
    """Effect of the correction for the spring on the energy and on r, in four runs in kind.

    Released from 7.9, 6.5, 5 and 3.5 degrees, with the spring of Figures 3-9 and 3-10 and a r for
    each foot. Energies are those at the peaks; with the correction 3-16, without it 3-3. Impacts
    below 6 J are left out, as in the text.
    """
    figure = style.new_figure(7.6, 4.6)
    changes_first, changes_later = [], []
    for ax, (release, seed) in zip(figure.subplots(2, 2).ravel(), RUNS, strict=True):
        data = record(release, seed, spring=True)
        plain = identification.Impacts.of_record(data, BLOCK)
        chosen = plain.energy_before >= THRESHOLD
        corrected = identification.Impacts.of_record(data, BLOCK, rotational_stiffness=SPRING)
        plain, corrected = plain.select(chosen), corrected.select(chosen)
        for impacts, face, label in (
            (plain, "none", "3-3"), (corrected, "full", "3-16"),
        ):  # fmt: skip
            for foot, mark in (("left", "<"), ("right", ">")):
                one = impacts.at_foot(foot)
                ax.plot(
                    one.time, one.energy_ratio, mark, color=style.FEET[foot], ms=5, mew=0.9,
                    mfc="none" if face == "none" else style.FEET[foot],
                    label=f"{label}, {foot} foot lands",
                )  # fmt: skip
        ax.axhline(R_HOUSNER, color=style.INK, ls="--", lw=0.8)
        ax.set_title(f"released at {release:g} degrees", fontsize=9)
        ax.set_xlabel("time [s]")
        ax.set_ylabel("r [-]")
        ax.set_ylim(0.7, 1.0)
        change = np.abs(corrected.energy_ratio - plain.energy_ratio)
        changes_first.append(change[0])
        changes_later += change[2:].tolist()
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4)
    first, later = max(changes_first), max(changes_later)
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.4",
                "the energy correction typically has little effect on r except for the first cycle",
                f"r changes by {first:.3f} at most at the first impact, by {later:.3f} after the "
                "first cycle",
                bool(later < first),
            ),
        ),
    )


def fit_3_17(speed: np.ndarray) -> np.ndarray:
    """Change of energy [J] by the speed [rad/s], of all impacts, as printed."""
    return 5.525 * speed**3 - 9.661 * speed**2 - 0.6663 * speed


def fit_3_18(speed: np.ndarray) -> np.ndarray:
    """The same of impacts on the right edge."""
    return 7.144 * speed**3 - 7.576 * speed**2 - 0.0381 * speed


@thesis_figure(Source.PRINTED)
def figure_3_22() -> Drawn:
    """Change of energy against the speed at an impact: 3-17, 3-18, and the points of Figure 3-3.

    The energies are those of the block at the printed peaks, the speed that of the energy before.
    Crosses are four simulated runs in kind, without the spring. Positive speed: the right foot
    lands.
    """
    speed = np.linspace(-1.0, 1.0, 401)
    impacts = measured_impacts()
    figure = style.new_figure(6.4, 3.8)
    ax = figure.add_subplot()
    ax.plot(speed, fit_3_17(speed), label="3-17, all impacts")
    ax.plot(speed[speed > 0], fit_3_18(speed[speed > 0]), "--", label="3-18, right edge")
    runs = [
        identification.Impacts.of_record(record(release, seed), BLOCK) for release, seed in RUNS
    ]
    kind = identification.Impacts.together(runs)
    ax.plot(kind.speed, kind.energy_change, "x", ms=4, color="0.6", label="in kind")
    ax.plot(
        impacts.speed, impacts.energy_change, "o", color=style.INK, mfc="white", mew=0.9, ms=4.5,
        label="Figure 3-3, measured",
    )  # fmt: skip
    ax.set_xlabel(r"speed $\dot\theta$ at the impact [rad/s]")
    ax.set_ylabel(r"change of energy $\Delta E$ [J]")
    ax.set_ylim(-10, 0.5)
    ax.legend(loc="lower right")
    left, right = impacts.at_foot("left"), impacts.at_foot("right")
    off = [
        float(np.abs(one.energy_change - fit(one.speed)).max())
        for one, fit in ((left, fit_3_17), (right, fit_3_18), (right, fit_3_17))
    ]
    return Drawn(
        figure,
        (
            Statement(
                "section 3.2.4",
                "two trends: 3-17 for all speeds, 3-18 for impacts on the right edge",
                f"the printed peaks lie within {off[0]:.2f} J of 3-17 where the left foot lands, "
                f"and within {off[1]:.2f} J of 3-18 ({off[2]:.2f} J of 3-17) where the right does",
                bool(off[0] < 1.5 and off[1] < 0.5 < off[2]),
            ),
        ),
    )
