"""Figures of chapter 3, the free block: motion, energy, support forces, impacts.

The text prints only the thirteen points of Figure 3-3 of the 430 tests; the traces are lost. In
kind here means simulated records of the same block, sampled as the tests were, a thousand times a
second, with noise of 0.01 degrees, and with an r for each foot: the means of those that Figure 3-3
gives.
"""

from functools import cache
from typing import Any

import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.analysis.identification import Impacts
from rockeom.plots import style
from rockeom.symbolic import Body, parameter, rocking_structure, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, ROTATION
from rockeom.symbolic.structures.rigid_block import HALF_WIDTH, HEIGHT, INERTIA, MASS
from rockeom.thesis import notation as th, points_of_interest
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import let_go
from rockeom.thesis.printed import BLOCK as BLOCK_VALUES, FIGURE_3_3

BLOCK = rk.RigidBlock(**BLOCK_VALUES)
SHAPE: dict[str, Any] = {"mass": BLOCK.mass, "alpha": BLOCK.alpha, "radius": BLOCK.radius}
R_HOUSNER = float(formulas.energy_ratio_of_block(BLOCK.alpha))
PRINTED_HOUSNER = 0.89
"""Energy ratio of section 3.3; 2-6 gives 0.879 for this block."""

RATE, NOISE = 1000, float(np.radians(0.01))
"""Samples a second, and the standard deviation of the noise of a simulated record [rad]."""

DEGREES = r"rotation $\theta$ [deg]"
SPRING = 300.0
"""Stiffness of the hypothetical rotational spring in simulated records [N m/rad]; not printed."""


# --- what is printed


@cache
def points() -> tuple[np.ndarray, np.ndarray]:
    """(13,) times [s] and rotations [rad] of Figure 3-3: peaks and zeros in turn."""
    rows = np.array(FIGURE_3_3.rows, dtype=float)
    return rows[:, 0], np.radians(rows[:, 1])


@cache
def measured_impacts() -> Impacts:
    """The six impacts between the peaks of Figure 3-3; a thousandth of a degree is printed."""
    time, rotation = points()
    rounding = np.radians(0.001) / np.sqrt(12)
    return Impacts.of_peaks(time[::2], rotation[::2], BLOCK, deviation=rounding)


@cache
def feet() -> dict[str, float]:
    """Mean r of Figure 3-3 at each foot that lands."""
    impacts = measured_impacts()
    return {f: float(np.mean(impacts.at_foot(f).energy_ratio)) for f in ("left", "right")}


def release_delay() -> float:
    """Time of the release of the block of Figure 3-3 [s]."""
    time, rotation = points()
    quarter = formulas.exact_quarter_period(rotation[0], BLOCK.alpha, BLOCK.frequency_parameter)
    return float(time[1] - quarter)


def mark_quarters(ax: Axes, ratio: np.ndarray, quarters: np.ndarray, of: str) -> None:
    """Quarter periods (n,) against the peak that they begin or end at, in turn."""
    for first, mark, name in ((0, "o", "from a peak"), (1, "s", "to a peak")):
        label = f"{of}, {name}"
        ax.plot(ratio[first::2], quarters[first::2], mark, ms=4, label=label, **dr.OPEN)


# --- records in kind


def rocking(structure: rk.Structure, release: float, duration: float) -> rk.Response:
    """A free decay from a release [rad] whose r is that of the foot that lands."""
    return let_go(structure, duration, rk.EnergyRatio(**feet()), theta=release)


@cache
def on_spring() -> rk.Structure:
    """The block with a rotational spring: the steel mechanism of section 3.2.2, if it were one."""
    k = parameter("k", "rotational_stiffness", "N m/rad", "stiffness of the spring")
    theta, height = ROTATION.position, HEIGHT.symbol
    model = rocking_structure(
        name="block_on_a_spring",
        title="Rigid block with a rotational spring",
        parameters=[MASS, HALF_WIDTH, HEIGHT, INERTIA, GRAVITY, k],
        coordinates=[ROTATION],
        bodies=lambda pivot: [
            Body("block", MASS.symbol, turned((0, height), pivot, theta), INERTIA.symbol, theta)
        ],
        half_width=HALF_WIDTH.symbol,
        gravity=GRAVITY.symbol,
        elastic_energy=k.symbol * theta**2 / 2,
    )
    return rk.structure(model, **BLOCK.parameters(), rotational_stiffness=SPRING)


@cache
def record(
    release: float = 7.876, seed: int = 0, spring: bool = False, noise: float = NOISE
) -> analysis.MeasuredRecord:
    """A simulated record in kind: five seconds from a release [deg], with noise [rad]."""
    structure = on_spring() if spring else BLOCK
    t = np.arange(5 * RATE) / RATE
    theta = rocking(structure, float(np.radians(release)), 5.0).at(t)["theta"]
    error = np.random.default_rng(seed).normal(0.0, noise, len(t))
    return analysis.MeasuredRecord(t, {"theta": theta + error}, {"theta": noise})


RUNS = ((7.876, 1), (6.5, 2), (5.0, 3), (3.5, 4))
"""Releases [deg] and seeds of four runs in kind; the thesis's four are not stated."""


@cache
def housner(ratio: float, duration: float = 5.0) -> rk.Response:
    """Housner's block released as that of Figure 3-3."""
    return let_go(BLOCK, duration, rk.EnergyRatio(ratio), theta=float(points()[1][0]))


# --- the motion


@dr.thesis_axes(dr.Source.PRINTED, 7.2, 3.2)
def figure_3_3(ax: Axes) -> None:
    """Rotation of the block after a release: the thirteen printed points.

    The line is a simulated block in kind, its r that of the printed peaks of each foot. The block
    of the test was let go some 0.07 s after time 0, which is put in here.
    """
    time, rotation = points()
    run = rocking(BLOCK, float(rotation[0]), 3.2)
    late = release_delay()
    left, right = (feet()[f] for f in ("left", "right"))
    label = f"simulated, r = {left:.2f} and {right:.2f} (left, right foot lands)"
    held = np.append(rotation[0], run["theta"])
    ax.plot(np.append(0.0, run.t + late), np.degrees(held), label=label)
    look = {**dr.OPEN, "ms": 4, "zorder": 5}
    ax.plot(time, np.degrees(rotation), "o", label="Figure 3-3, measured", **look)
    ax.set(xlim=(0, 3.2), xlabel=dr.TIME, ylabel=DEGREES)
    style.legend_above(ax)


@dr.thesis_axes(dr.Source.IN_KIND, 7.2, 4.4, 2, sharex=True, height_ratios=(1.5, 1.0))
def figure_3_4(trace: Axes, score: Axes) -> None:
    """How the thesis's algorithm finds peaks: the score of each sample, and SciPy's finder.

    A window of 500 samples moves along; its largest and its smallest sample have a point each. The
    threshold was the user's choice and is not printed: here it is half of the window. The trace is
    a simulated record. scipy.signal.find_peaks asks for a prominence of ten standard deviations of
    the noise instead.
    """
    data = record()
    degrees = np.degrees(data["theta"])
    trace.plot(data.time, degrees, lw=0.8, color=style.INK)
    for points_of, mark, size, color, label in (
        (points_of_interest.points_by_prominence, "s", 7, style.LINES[1], "find_peaks"),
        (points_of_interest.points_by_score, "o", 4, style.LINES[0], "score above the threshold"),
    ):
        rows = points_of(data, "theta").peaks
        label = f"{label}: {len(rows)}"
        trace.plot(
            data.time[rows], degrees[rows], mark, ms=size, mfc="none", color=color, label=label
        )
    trace.set_ylabel(DEGREES)
    trace.legend(loc="upper right", ncols=2)
    scores = points_of_interest.importance_scores(data["theta"], 500)
    score.plot(data.time, scores, lw=0.8, color=style.LINES[0])
    score.axhline(250, ls="--", **dr.THIN)
    score.annotate("threshold", (5.0, 250), (4, 0), textcoords="offset points", va="center")
    score.set(ylabel="score [-]", xlabel=dr.TIME, xlim=(0, 5))


@dr.thesis_axes(dr.Source.PRINTED, 6.2, 3.6)
def figure_3_5(ax: Axes) -> None:
    """Quarter periods against the peak rotation: Figure 3-3, 2-5, and the block of any rotation.

    A quarter ends or begins at a printed peak. The first one of the test is 0.07 s too long: the
    block was let go later than at time 0.
    """
    time, rotation = points()
    quarters = np.diff(time)
    peaks = np.abs(np.where(rotation[:-1] != 0, rotation[:-1], rotation[1:]))
    p, alpha = BLOCK.frequency_parameter, BLOCK.alpha
    x = np.linspace(0.0, 0.8, 200)
    slender = formulas.quarter_period(x, p)
    exact = formulas.exact_quarter_period(x * alpha, alpha, p)
    ax.plot(x, slender, color=style.LINES[0], label="2-5, slender")
    ax.fill_between(x, 0.9 * slender, 1.1 * slender, alpha=0.12, lw=0, label="within 10 %")
    ax.plot(x, exact, "--", color=style.LINES[1], label="any rotation")
    mark_quarters(ax, peaks / alpha, quarters, "Figure 3-3")
    ax.set(xlabel=r"peak rotation $|\theta_0|/\alpha$ [-]", xlim=(0, 0.8), ylim=(0, 0.6))
    ax.set_ylabel("quarter period [s]")
    ax.legend(loc="upper left")


@dr.thesis_axes(dr.Source.PRINTED, 7.2, 3.2)
def figure_3_6(ax: Axes) -> None:
    """Rotation in time: the printed points of Figure 3-3 and Housner's block with two r.

    r is the 0.89 of section 3.3, and 0.88 of it. The measured points are moved by the 0.07 s by
    which the block was let go after time 0. The trace of the thesis's figure, another run perhaps,
    is not printed.
    """
    time, rotation = points()
    for ratio, line in ((PRINTED_HOUSNER, "-"), (0.88 * PRINTED_HOUSNER, "--")):
        run = housner(ratio, 14.0)
        label = f"simulated, r = {ratio:.3f}"
        ax.plot(run.t, np.degrees(run["theta"]), line, lw=0.9, label=label)
    moved = np.maximum(time - release_delay(), 0.0)
    ax.plot(moved, np.degrees(rotation), "o", ms=4, label="Figure 3-3, measured", **dr.OPEN)
    ax.set(xlim=(0, 6), xlabel="time after the release [s]", ylabel=DEGREES)
    style.legend_above(ax)


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 3.6, columns=2, sharey=True)
def figure_3_7(*axes: Axes) -> None:
    """Phase diagrams of the record in kind and of Housner's block with two r.

    The rate of the record is found by differentiation (a polynomial of degree 4 over 0.05 s), which
    rounds the jumps at the impacts. A is the first quarter, B the return half a cycle later.
    """
    derived = record().with_derivatives("theta", 0.05)
    early = derived.time < 2.4
    degrees = np.degrees(derived["theta"][early])
    for ax, ratio in zip(axes, (PRINTED_HOUSNER, 0.88 * PRINTED_HOUSNER), strict=True):
        ax.plot(degrees, derived["theta_dot"][early], label="record in kind", **dr.THIN)
        run = housner(ratio, 14.0)
        end = run.t < run.impacts[4].time
        label = f"simulated, r = {ratio:.3f}"
        ax.plot(np.degrees(run["theta"][end]), run["theta_dot"][end], "--", lw=0.9, label=label)
        ax.annotate("A", (4.0, -0.66), ha="center", va="top")
        ax.annotate("B", (-3.2, 0.6), ha="center", va="bottom")
        ax.set(xlabel=DEGREES, ylabel=r"rate $\dot\theta$ [rad/s]")
        ax.label_outer()
        style.legend_above(ax)


# --- energy


CURVES: dict[str, dict[str, Any]] = {
    "potential": {"label": "potential $U$", "color": style.LINES[0], "lw": 0.9},
    "kinetic": {"label": "kinetic $E_k$", "color": style.LINES[2], "lw": 0.9},
    "spring": {"label": "spring", "color": style.LINES[3], "lw": 0.9},
    "total": {"label": "total", "color": style.LINES[1], "lw": 1.2},
    "alone": {"label": "without the spring", "color": style.LINES[1], "lw": 0.8, "ls": ":"},
}


def draw_energies(ax: Axes, time: np.ndarray, end: float, **energies: np.ndarray) -> None:
    """Energies (n,) by their names in `CURVES`, up to a time."""
    rows = time < end
    for name, energy in energies.items():
        ax.plot(time[rows], energy[rows], **CURVES[name])
    ax.set(xlabel=dr.TIME, ylabel="energy [J]", ylim=(0, None))


@dr.thesis_axes(dr.Source.COMPUTED, 7.0, 3.2)
def figure_3_8(ax: Axes) -> None:
    """Idealised energy of a rocking cycle: Housner's block, released as in Figure 3-3.

    A to D are those of 3-3: peak, just before the impact, just after it, next peak.
    """
    run = housner(R_HOUSNER)
    upright = BLOCK.energies({}, mode="both")["gravitational_energy"]
    end = run.impacts[1].time + 0.4
    potential, kinetic = run["gravitational_energy"] - upright, run["kinetic_energy"]
    draw_energies(ax, run.t, end, potential=potential, kinetic=kinetic, total=potential + kinetic)
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


@cache
def energies_in_kind() -> tuple[analysis.MeasuredRecord, identification.Energies]:
    """The record of the block on the spring, and the energies of the block alone."""
    derived = record(spring=True).with_derivatives("theta", 0.05)
    return derived, identification.record_energies(derived, BLOCK)


@dr.thesis_axes(dr.Source.IN_KIND, 7.0, 3.4)
def figure_3_10(ax: Axes) -> None:
    """Energy of the block in a record in kind, without and with that of a fitted spring, 3-4.

    The text suspects the steel mechanism to be a rotational spring and does not print its
    stiffness; here the block has one of 300 N m/rad. The energies are those of the block alone, 3-1
    and 3-2, the rate by differentiation over 0.05 s, which rounds the impacts. Without the spring
    (dotted, as in Figure 3-9) the block comes to more energy than at the release (dashed). Fitted
    is the stiffness with which the total changes least within each half-cycle. The thesis takes the
    largest excess and the rotation at which it occurs instead.
    """
    derived, energies = energies_in_kind()
    fit = identification.fitted_rotational_spring(derived, BLOCK, count=5)
    stored = formulas.spring_energy(derived["theta"], fit.stiffness)
    parts = {"potential": energies.gravity, "kinetic": energies.kinetic, "spring": stored}
    total, alone = energies.total + stored, energies.total
    draw_energies(ax, derived.time, 3.0, **parts, total=total, alone=alone)
    start = float(identification.static_energy(BLOCK, np.radians(7.876)))
    ax.axhline(start, ls="--", label="at the release", **dr.THIN)
    style.legend_above(ax)


# --- 3.2.3 support forces

WINDOW = 0.03
"""Window of the derivatives that give impact forces [s]; the thesis does not state its own."""
SPEED = r"speed $\dot\theta$ before the impact [rad/s]"


def draw_forces(
    time: np.ndarray, horizontal: np.ndarray, vertical: np.ndarray, until: float
) -> Figure:
    """Horizontal and vertical support force [N] in time, and the weight."""
    figure, (top, below) = dr.panels(7.2, 4.2, 2, sharex=True)
    top.plot(time, horizontal / 1e3, lw=0.8, color=style.LINES[0])
    top.set_ylabel("horizontal force [kN]")
    below.plot(time, vertical / 1e3, lw=0.8, color=style.LINES[0])
    weight = BLOCK.mass * BLOCK.gravity / 1e3
    below.axhline(weight, ls="--", label="weight", **dr.THIN)
    below.legend(loc="lower right")
    below.set(ylabel="vertical force [kN]", xlabel=dr.TIME, xlim=(0, until))
    return figure


def calm_record(release: float, seed: int) -> analysis.MeasuredRecord:
    """A simulated record from a release [deg], with a tenth of the noise of the others."""
    return record(release, seed, noise=NOISE / 10)


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_3_12() -> Figure:
    """Support forces of the block by 3-8 and 3-9 from a record in kind.

    The record is that of the first release of Figure 3-15, with a tenth of the noise of the others;
    its rotation is differentiated twice over a window of 0.03 s, which spreads the jumps of the
    rate at the impacts to spikes.
    """
    forces = identification.support_forces_of_record(calm_record(*RUNS[0]), window=WINDOW, **SHAPE)
    return draw_forces(forces.time, forces.horizontal, forces.vertical, 4.9)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_3_13() -> Figure:
    """Support forces of Housner's block, released as in Figure 3-3.

    r is 0.879, of 2-6; that of the figure is not printed. The forces at the impacts, infinite for
    no time, are not drawn.
    """
    run = housner(R_HOUSNER, 14.0)
    vertical = run["left_reaction"] + run["right_reaction"]
    return draw_forces(run.t, run["horizontal_reaction"], vertical, 10.0)


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.0, columns=3)
def figure_3_14(*axes: Axes) -> None:
    """Support forces just before and after an impact against the speed: 3-11 and 3-12.

    Up to the largest speed of free rocking, 3-13. Positive speed: the right foot lands. The angle
    is that of the resultant from the vertical.
    """
    alpha, radius = BLOCK.alpha, BLOCK.radius
    most = float(formulas.impact_speed(alpha, alpha=alpha, radius=radius))
    speed = np.linspace(-most, most, 401)
    for side, label, line in ((1, "on the right foot", "-"), (-1, "on the left foot", "--")):
        h, v = formulas.block_reactions_at_impact(speed, side, slender=True, **SHAPE)
        angle = np.degrees(np.arctan2(h, v))
        for ax, y in zip(axes, (h / 1e3, v / 1e3, angle), strict=True):
            ax.plot(speed, y, line, label=label)
    names = "horizontal force [kN]", "vertical force [kN]", "angle of the resultant [deg]"
    for ax, name in zip(axes, names, strict=True):
        ax.set(xlabel=r"speed $\dot\theta$ [rad/s]", ylabel=name)
    axes[1].set_ylim(0, 3.6)
    axes[2].legend(loc="center")


@cache
def impact_forces() -> identification.ImpactForces:
    """Impacts of the four runs in kind above 0.15 rad/s, with a tenth of the noise."""
    forces = [
        identification.impact_forces_of_record(calm_record(*run), window=WINDOW, **SHAPE)
        for run in RUNS
    ]
    columns = [np.concatenate(column) for column in zip(*forces, strict=True)]
    fast = np.abs(columns[1]) > 0.15
    return identification.ImpactForces(*(column[fast] for column in columns))


@dr.thesis_axes(dr.Source.IN_KIND, 7.4, 5.4, 2, 2, sharex=True)
def figure_3_15(a: Axes, b: Axes, c: Axes, d: Axes) -> None:
    """Forces about each impact of records in kind against the speed, and the baseline.

    Upper row: the largest vertical force about an impact, and the horizontal one where it is
    positive. Lower row: the vertical force of the record one window before the impact, and the
    horizontal one where it is negative. The impacts of the simulation have no duration: what is
    drawn over the baseline, 3-11 and 3-12, is the jump of the rate, spread over the window of the
    derivatives, here 0.03 s. The thesis does not state its window. The noise is a tenth of that of
    the others.
    """
    forces, before = impact_forces(), vertical_before_impacts()
    speed, h, v = forces.speed, forces.horizontal, forces.vertical
    for ax, values, baseline, rows, name in (
        (a, v, forces.baseline_vertical, v > 0, "a) largest vertical"),
        (b, h, forces.baseline_horizontal, h > 0, "b) positive horizontal"),
        (c, before, forces.baseline_vertical, before > 0, "c) vertical force before"),
        (d, h, forces.baseline_horizontal, h < 0, "d) negative horizontal"),
    ):
        dr.draw_feet(ax, speed[rows] < 0, speed[rows], values[rows] / 1e3)
        # horizontal, the baseline just after has the size of that before, and the other sign
        smooth = np.copysign(baseline, values)[rows]
        ax.plot(speed[rows], smooth / 1e3, "_", color=style.INK, ms=6, label="baseline")
        ax.set_ylabel(f"{name} [kN]")
    for ax in (c, d):
        ax.set_xlabel(SPEED)
    dr.legend_of_first(style.parent_figure(a), 3)


@cache
def vertical_before_impacts() -> np.ndarray:
    """Vertical support force of the records, a window before each impact of `impact_forces` [N]."""
    forces_before = []
    for release, seed in RUNS:
        calm = calm_record(release, seed)
        forces = identification.support_forces_of_record(calm, window=WINDOW, **SHAPE)
        impacts = identification.impact_forces_of_record(calm, window=WINDOW, **SHAPE)
        time = impacts.time[np.abs(impacts.speed) > 0.15]
        forces_before.append(np.interp(time - WINDOW, forces.time, forces.vertical))
    return np.concatenate(forces_before)


@dr.thesis_axes(dr.Source.IN_KIND, 7.4, 3.2, columns=2)
def figure_3_16(magnitude: Axes, direction: Axes) -> None:
    """Magnitude and direction of the largest forces of Figure 3-15 against the speed; in kind.

    The angle is that of the resultant from the vertical.
    """
    forces = impact_forces()
    for ax, y in ((magnitude, forces.magnitude / 1e3), (direction, np.degrees(forces.angle))):
        dr.draw_feet(ax, forces.speed < 0, forces.speed, y)
        ax.set_xlabel(SPEED)
    magnitude.set(ylabel="magnitude [kN]", ylim=(0, None))
    direction.set_ylabel("angle from the vertical [deg]")
    magnitude.legend(loc="lower center")


# --- 3.2.4 restitution

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
