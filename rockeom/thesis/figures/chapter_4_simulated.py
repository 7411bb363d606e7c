"""Simulations of the free vibration of the wall of chapter 4, section 4.8.

The wall starts at rest at the first peak of Table A-1.
"""

from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.plots import style
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.figures.chapter_4_free_vibration import HOUSNER, legible, symmetric
from rockeom.thesis.free_vibration_table import (
    STIFFER,
    WALL,
    ModelPeaks,
    from_first_peak,
    measured_peaks,
    released_peaks,
)

CONSTANT = rk.EnergyRatio(0.88)
BY_4_31 = rk.EnergyRatioAtSpeed.equation_4_31()
BY_4_36 = rk.EnergyRatioAtSpeed.equation_4_36()
BY_4_38 = rk.EnergyRatioAtSpeed.equation_4_38()
FIXED = rk.SimplifiedSubstituteGravityWall.from_wall(WALL)
"""The wall of 4-32, about its corners."""
STILL = rk.GroundMotion.none(0.5)
"""Free vibration, long enough to reach the next peak."""
IMPACT_SPEED = r"speed at the impact $|\dot\Delta|$ [m/s]"
CORNER = formulas.RotationCentre(C1=WALL.half_width, C2=0.0, epsilon=WALL.rotation_centre.epsilon)
"""Rotation centre of 4-37, which ends at the edge."""


# --- the motion in time


class History(NamedTuple):
    """Times [s], displacement Delta [m], its velocity [m/s] and acceleration [m/s2]; (n,) each."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


def released(structure: rk.Structure, law: ImpactLaw | None = None) -> History:
    """The free vibration from the first peak of Table A-1, whose last peak is at 1.91 s."""
    return history_of(from_first_peak(structure, 2.0, law))


def history_of(run: rk.Response) -> History:
    """Motion of the point at height H of the wall, or of its oscillator, relative to the ground."""
    if "u" in run.states:
        mass = run.structure.parameters()["effective_mass"]
        return History(run.t, run["u"], run["u_dot"], run["horizontal_reaction"] / mass)
    theta, rate, ground = run["theta"], run["theta_dot"], run["ground_acceleration"]
    turning = np.empty(len(run.t))
    for mode in np.unique(run.mode):
        rows = run.mode == mode
        state = {name: run[name][rows] for name in run.states}
        rates = run.structure.accelerations(state, mode=str(mode), ground_acceleration=ground[rows])
        turning[rows] = rates["theta"]
    h, sin, cos = WALL.height, np.sin(theta), np.cos(theta)  # 4-33 to 4-35
    return History(run.t, h * sin, h * cos * rate, h * (turning * cos - rate**2 * sin))


def draw_histories(curves: list[tuple[str, History]]) -> Figure:
    """Draw displacement, velocity and acceleration of each curve, with the points of Table A-1."""
    measured, clear = identification.FreeVibration.table_a1(), legible()
    figure, axes = dr.panels(7.6, 5.6, 3, sharex=True)
    for ax, name, quantity, unit in (
        (axes[0], r"$\Delta$ [mm]", "displacement", dr.MM),
        (axes[1], r"$\dot\Delta$ [m/s]", "velocity", 1.0),
        (axes[2], r"$\ddot\Delta$ [m/s$^2$]", "acceleration", 1.0),
    ):
        dr.draw_curves(ax, [(label, h.time, getattr(h, quantity) * unit) for label, h in curves])
        points = getattr(measured, quantity)[clear] * unit
        ax.plot(measured.time[clear], points, "o", ms=3.2, zorder=5, label="Table A-1", **dr.OPEN)
        ax.set_ylabel(name)
    axes[2].set(xlabel=dr.TIME, xlim=(0, 2))
    style.legend_above(axes[0])
    return figure


def draw_displacements(curves: list[tuple[str, History]]) -> Figure:
    """Draw the displacement of each curve in time, and below it its difference from the first."""
    measured, clear = identification.FreeVibration.table_a1(), legible()
    figure, (ax, below) = dr.panels(7.6, 4.6, 2, sharex=True, height_ratios=(2.0, 1.0))
    dr.draw_curves(ax, [(label, h.time, h.displacement * dr.MM) for label, h in curves])
    off = differences(curves)
    dr.draw_curves(below, [("", h.time, x) for (_, h), x in zip(curves, off, strict=True)])
    points = measured.displacement[clear] * dr.MM
    ax.plot(measured.time[clear], points, "o", ms=3.0, zorder=5, label="Table A-1", **dr.OPEN)
    below.set(xlabel=dr.TIME, ylabel=f"less {curves[0][0]} [mm]", xlim=(0, 2))
    ax.set_ylabel(dr.DELTA)
    style.legend_above(ax)
    return figure


def differences(curves: list[tuple[str, History]]) -> list[np.ndarray]:
    """Displacement of each curve less that of the first [mm]."""
    first = curves[0][1]
    return [
        (h.displacement - np.interp(h.time, first.time, first.displacement)) * dr.MM
        for _, h in curves
    ]


def moved(curves: list[tuple[str, History]]) -> list[float]:
    """Largest difference of each further curve from the first [mm]."""
    return [float(np.abs(off).max()) for off in differences(curves)[1:]]


# --- the equivalent oscillator


def oscillator(r: float) -> rk.ControlledWallOscillator:
    """The oscillator with the whole mass, and with F_k by the energies."""
    return rk.ControlledWallOscillator.from_wall(WALL, r, effective_mass=WALL.mass)


def by_speed(law: rk.EnergyRatioAtSpeed, of_passage: bool = False) -> History:
    """Free vibration of the oscillator with F_k raised by 6 %, r of the instant or of a passage."""
    lighter = WALL.mass / STIFFER
    return released(
        rk.ControlledWallOscillator.from_wall(WALL, law, held=of_passage, effective_mass=lighter)
    )


def fitted_ratio(first: int, last: int) -> identification.Fit:
    """r of the oscillator, fitted to the peaks from `first` on, at which it starts, to `last`."""
    peak = measured_peaks()[1][first : last + 1]

    def case(r: float) -> rk.Case:
        return rk.Case(oscillator(r), rk.GroundMotion.none(2.0), initial={"u": float(peak[0])})

    return analysis.fit_free_vibration(
        case, {"r": 0.87}, peaks=peak, quantity="u", bounds={"r": (0.1, 1.0)}
    )


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_4_36() -> Figure:
    """Free vibration of the equivalent oscillator with one r for all passages, and Table A-1.

    In kind: the thesis states only the first of its r, that of 2-6, 0.835 about the corner; 0.88
    and 0.93 are a choice. The effective mass is the whole mass, n the epsilon of 4-7, and F_k is
    not raised.
    """
    return draw_displacements(
        [(f"r = {r:.3f}", released(oscillator(r))) for r in (HOUSNER, 0.88, 0.93)]
    )


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_37() -> Figure:
    """Free vibration of the equivalent oscillator with r of 4-31, and Table A-1.

    As in the text, the effective mass is the whole mass, n is the epsilon of 4-7, F_k is raised by
    6 % (here the mass is lowered by as much, which gives the same equation), and r is that of the
    instantaneous velocity, so that it changes within a passage. Dashed: r of a whole passage is
    that of the speed with which the wall would come upright without losses. The second
    and third passages then exceed the limit of 0.78 m/s and lose 5 % instead of 15 %.
    """
    return draw_histories([
        ("r of the instantaneous speed", by_speed(BY_4_31)),
        ("r of the whole passage", by_speed(BY_4_31, of_passage=True)),
    ])  # fmt: skip


@cache
def with_deviations_of_4_31() -> list[tuple[str, History]]:
    """The free vibration by 4-31, and with r larger by 0.02 in one of its three faster bands."""
    return [(label, by_speed(law)) for label, law in (("4-31", BY_4_31), *bands_raised(BY_4_31))]


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_4_38() -> Figure:
    """Effect of small changes of r in 4-31 on the free vibration of the equivalent oscillator.

    In kind: the thesis does not state its deviations; here r is 0.02 larger in one of the three
    faster bands of speed at a time. The oscillator is that of Figure 4-37, r that of the
    instantaneous speed. The differences are below.
    """
    return draw_displacements(with_deviations_of_4_31())


# --- substitute gravity about fixed corners


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_4_39() -> Figure:
    """Free vibration of the substitute-gravity wall about fixed corners with one r.

    In kind: the thesis states only the first of its r, that of 2-6, 0.835; that 0.88 and 0.91 of
    the text are the others is a guess.
    """
    return draw_displacements(
        [(f"r = {r:.3f}", released(FIXED, rk.EnergyRatio(r))) for r in (HOUSNER, 0.88, 0.91)]
    )


@cache
def ratios_by_release() -> tuple[np.ndarray, np.ndarray]:
    """(12,) r that leads from each measured peak to the next, and the speed that it lands with.

    The speed is H theta_dot before the impact [m/s], which no r changes.
    """
    _, peak = measured_peaks()
    theta = WALL.rotation(peak)

    def case(start: float, r: float) -> rk.Case:
        return rk.Case(FIXED, STILL, rk.EnergyRatio(r), initial={"theta": start})

    r = identification.energy_ratios_by_release(case, theta, quantity="theta")
    speed = [
        abs(rk.simulate(FIXED, STILL, initial={"theta": start}).impacts[0].before["theta_dot"])
        for start in theta[:-1].tolist()
    ]
    return r, WALL.height * np.array(speed)


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.4, columns=2, sharey=True)
def figure_4_40(left: Axes, right: Axes) -> None:
    """r with which the substitute-gravity wall comes from each measured peak to the next.

    About fixed corners, by release at each of the first twelve peaks of Table A-1; against the
    speed of the impact and the peak before.
    """
    r, speed = ratios_by_release()
    peak = measured_peaks()[1][:-1]
    dr.draw_sides(left, peak, r, speed)
    dr.draw_sides(right, peak, r)
    left.set(xlabel=IMPACT_SPEED, ylabel=dr.RATIO, ylim=(0.6, 1.0), xlim=(0, None))
    right.set(xlabel=r"peak before $|\Delta_0|$ [mm]", xlim=(0, None))
    right.legend(loc="lower right")


def upright(passages: int) -> identification.Fit:
    """Displacement x [m] at which the wall would stand, that r be one for the first passages.

    By the energies at the peaks, counted from there.
    """
    peak = measured_peaks()[1][: passages + 1]
    energy = WALL.potential_energy

    def off(r: float, x: float) -> np.ndarray:
        return np.log(energy(peak[1:] - x) / energy(peak[:-1] - x)) - np.log(r)

    return identification.fit(off, np.zeros(passages), {"r": 0.89, "x": 5e-4})


@dr.thesis_axes(dr.Source.COMPUTED, 6.0, 3.6)
def figure_4_41(ax: Axes) -> None:
    """Moving averages of two successive r of Figure 4-40 against their speed, and 4-31.

    Also drawn: pieces fitted to the r of Figure 4-40 themselves in the bands of 4-31, without
    slopes.
    """
    r, speed = ratios_by_release()
    mean, at = (r[1:] + r[:-1]) / 2, (speed[1:] + speed[:-1]) / 2
    limits = [limit for limit, _, _ in BY_4_31.pieces[:-1] if np.sum(speed < limit) >= 1]
    fitted = rk.EnergyRatioAtSpeed.from_data(speed, r, limits=limits, slopes=False)
    v = np.linspace(0.01, 0.9, 800)
    ax.plot(v, [BY_4_31.at(x) for x in v], color=style.LINES[0], label="4-31")
    ax.plot(v, [fitted.at(x) for x in v], "--", color=style.LINES[1], label="fitted in its bands")
    ax.plot(speed, r, ".", color="0.6", ms=5, label="by release")
    ax.plot(at, mean, "o", ms=4.5, label="mean of two", **dr.OPEN)
    ax.set(xlabel=IMPACT_SPEED, ylabel=dr.RATIO, xlim=(0, 0.9), ylim=(0.7, 1.0))
    style.legend_above(ax)


@cache
def miss(law: ImpactLaw) -> ModelPeaks:
    """First thirteen peaks of the wall about fixed corners, compared with Table A-1."""
    return released_peaks(FIXED, law)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_42() -> Figure:
    """Free vibration of the substitute-gravity wall about fixed corners with 4-31.

    With the points of Table A-1.
    """
    return draw_histories([("4-31", released(FIXED, BY_4_31))])


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_43() -> Figure:
    """Free vibration of the substitute-gravity wall about fixed corners with 4-36.

    With the points of Table A-1. 4-36 is as printed, with the larger r for the larger speed.
    """
    return draw_histories([("4-36", released(FIXED, BY_4_36))])


# --- the substitute-gravity wall with a moving rotation centre


@dr.thesis_axes(dr.Source.COMPUTED, 5.6, 3.6)
def figure_4_44(ax: Axes) -> None:
    """Place b' of a rotation centre that moves, off the centreline: 4-37.

    With 4-37 the centre reaches the edge of the wall, 508 mm, where 4-7, which the tendon's force
    still follows, stops 96 mm before. Both are drawn.
    """
    d = symmetric(0.032)
    curves = ("4-37: 508 mm", CORNER), ("as 4-7: 412 mm", WALL.rotation_centre)
    dr.draw_curves(ax, [(label, d * dr.MM, centre.distance(d) * dr.MM) for label, centre in curves])
    ax.set(xlabel=dr.DELTA, ylabel="$b'$ [mm]")
    ax.legend(loc="lower right")


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.2, columns=2)
def figure_4_46(left: Axes, right: Axes) -> None:
    """Effect of 10 % of n: the half-width b' of 4-37 and the force of the tendon, 4-16.

    n is the epsilon of 4-7, 3.551 mm.
    """
    d = symmetric(0.015)
    walls = {f: with_n(f) for f in (0.9, 1.0, 1.1)}
    n = {f: wall.rotation_centre.epsilon for f, wall in walls.items()}
    labels = [f"{f:.1f} n = {n[f] * dr.MM:.2f} mm" for f in walls]
    corners = [replace(CORNER, epsilon=n[f]).distance(d) * dr.MM for f in walls]
    forces = [wall.tendon_force(d) / 1e3 for wall in walls.values()]
    for ax, ys, name in ((left, corners, "$b'$ [mm]"), (right, forces, "tendon force $P$ [kN]")):
        dr.draw_curves(ax, [(label, d * dr.MM, y) for label, y in zip(labels, ys, strict=True)])
        ax.set(xlabel=dr.DELTA, ylabel=name)
    left.legend(loc="lower right", fontsize=7.5)
    right.legend(loc="upper center", fontsize=7.5)


def with_n(factor: float) -> analysis.Wall:
    """The wall with its n, the epsilon of 4-7, multiplied by a factor."""
    centre = WALL.rotation_centre
    return replace(WALL, rotation_centre=replace(centre, epsilon=factor * centre.epsilon))


def substitute_gravity(law: rk.EnergyRatioAtSpeed, wall: analysis.Wall = WALL) -> History:
    """Free vibration by 4-40 of a wall whose centre moves by 4-37."""
    return released(rk.SubstituteGravityWall.from_wall(wall), law)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_45() -> Figure:
    """Free vibration of the substitute-gravity wall with r of 4-38, and Table A-1.

    The rotation centre moves by 4-37, to the edge; the tendon's force is that of 4-16. The moment
    of inertia is 12 101 kg m2 about a corner, a constant; the text does not say which it has.
    Dashed: 13 215 kg m2, which is B-9 as printed.
    """
    heavier = replace(WALL, inertia=13215.0)
    return draw_histories([
        (r"$I_o$ = 12 101 kg m$^2$", substitute_gravity(BY_4_38)),
        (r"$I_o$ = 13 215 kg m$^2$", substitute_gravity(BY_4_38, heavier)),
    ])  # fmt: skip


@cache
def with_other_n() -> list[tuple[str, History]]:
    """The free vibration by 4-38, with n as it is, and 10 % less and more."""
    factors = (1.0, 0.9, 1.1)
    return [(f"{f:.1f} n", substitute_gravity(BY_4_38, with_n(f))) for f in factors]


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_4_47() -> Figure:
    """Effect of 10 % of n on the free vibration of the substitute-gravity wall with 4-38.

    The effect itself is very small, as the thesis says. But with 1.1 n the third passage has
    0.779 m/s, just below the limit of 0.78 m/s where r of 4-38 falls from 0.94 to 0.85, and all
    later peaks are lower.
    """
    return draw_displacements(with_other_n())


def bands_raised(
    law: rk.EnergyRatioAtSpeed, by: float = 0.02
) -> list[tuple[str, rk.EnergyRatioAtSpeed]]:
    """Impact laws with r larger in one of the three faster bands, each with its label."""
    laws = []
    for band in (3, 2, 1):
        pieces = list(law.pieces)
        limit, r, slope = pieces[band]
        pieces[band] = (limit, r + by, slope)
        laws.append((f"{r:.2f} → {r + by:.2f}", rk.EnergyRatioAtSpeed(tuple(pieces))))
    return laws


@cache
def with_deviations_of_4_38() -> list[tuple[str, History]]:
    """The free vibration by 4-38, and with r larger by 0.02 in one of its three faster bands."""
    laws = ("4-38", BY_4_38), *bands_raised(BY_4_38)
    return [(label, substitute_gravity(law)) for label, law in laws]


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_4_48() -> Figure:
    """Effect of small changes of r in 4-38 on the free vibration of the substitute-gravity wall.

    In kind: the thesis does not state its deviations. Here r is 0.02 larger in one of the three
    faster bands at a time. In the fastest one this brings one more passage, with 0.783 m/s, over
    the limit of 0.78 m/s. In the slowest of them it moves the wall so little that its curve lies
    under that of 4-38; the differences are below.
    """
    return draw_displacements(with_deviations_of_4_38())
