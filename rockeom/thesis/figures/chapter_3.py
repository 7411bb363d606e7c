"""Figures of 3.1 to 3.2.2, motion and energy of the free block; see `rockeom.thesis.figures`.

The text prints only the thirteen points of Figure 3-3 of the 430 tests; the traces are lost. In
kind here means simulated records of the same block, sampled as the tests were, a thousand times a
second, with noise of 0.01 degrees, and with an r for each foot: the means of those that Figure 3-3
gives.
"""

from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.symbolic import Body, coordinate, parameter, rocking_structure, turned
from rockeom.thesis import points_of_interest
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

ROTATION = r"rotation $\theta$ [deg]"
SPRING = 300.0
"""Stiffness of the hypothetical rotational spring in simulated records [N m/rad]; not printed."""


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


def release_delay() -> float:
    """Time of the release of the block of Figure 3-3 [s]."""
    time, rotation = points()
    quarter = formulas.exact_quarter_period(rotation[0], BLOCK.alpha, BLOCK.frequency_parameter)
    return float(time[1] - quarter)


def mark_points(ax: Axes, label: str = "Figure 3-3, measured") -> None:
    """The printed peaks and zeros, in degrees."""
    time, rotation = points()
    ax.plot(time, np.degrees(rotation), "o", ms=4, zorder=5, label=label, **dr.OPEN)


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
    _, rotation = points()
    run = rocking(BLOCK, float(rotation[0]), 3.2)
    late = release_delay()
    left, right = (feet()[f] for f in ("left", "right"))
    label = f"simulated, r = {left:.2f} and {right:.2f} (left, right foot lands)"
    held = np.append(rotation[0], run["theta"])
    ax.plot(np.append(0.0, run.t + late), np.degrees(held), label=label)
    mark_points(ax)
    ax.set(xlim=(0, 3.2), xlabel=dr.TIME, ylabel=ROTATION)
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
    trace.set_ylabel(ROTATION)
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
    ax.set(xlim=(0, 6), xlabel="time after the release [s]", ylabel=ROTATION)
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
        ax.set(xlabel=ROTATION, ylabel=r"rate $\dot\theta$ [rad/s]")
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
def figure_3_9(ax: Axes) -> None:
    """Energy of the block in a record in kind, whose block has a spring that nobody knows of.

    The text suspects the steel mechanism to be a rotational spring and does not print its
    stiffness; here it is 300 N m/rad. The energies are those of the block alone, 3-1 and 3-2, the
    rate by differentiation over 0.05 s, which rounds the impacts.
    """
    derived, energies = energies_in_kind()
    parts = {"potential": energies.gravity, "kinetic": energies.kinetic}
    draw_energies(ax, derived.time, 3.0, **parts, total=energies.total)
    start = float(identification.static_energy(BLOCK, np.radians(7.876)))
    ax.axhline(start, color=style.INK, lw=0.7, ls="--", label="at the release")
    style.legend_above(ax)


@dr.thesis_axes(dr.Source.IN_KIND, 7.0, 3.4)
def figure_3_10(ax: Axes) -> None:
    """The same with the energy of the hypothetical spring, fitted to the record, 3-4.

    Fitted is the stiffness with which the total changes least within each half-cycle. The thesis
    takes the largest excess and the rotation at which it occurs instead.
    """
    derived, energies = energies_in_kind()
    fit = identification.fitted_rotational_spring(derived, BLOCK, count=5)
    stored = formulas.spring_energy(derived["theta"], fit.stiffness)
    parts = {"potential": energies.gravity, "kinetic": energies.kinetic, "spring": stored}
    total, alone = energies.total + stored, energies.total
    draw_energies(ax, derived.time, 3.0, **parts, total=total, alone=alone)
    style.legend_above(ax)
