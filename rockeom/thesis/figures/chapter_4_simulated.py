"""Simulations of the free vibration of the wall of chapter 4, section 4.8.

As in Figure 4-37 and those after it, the wall is let go at rest at the first peak of Table A-1.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import identification
from rockeom.plots import style
from rockeom.thesis.figures.chapter_4_free_vibration import HOUSNER, draw_sides
from rockeom.thesis.figures.chapter_4_wall import (
    MM,
    bands_raised,
    draw_displacements,
    draw_histories,
    moved,
    released,
)
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.free_vibration_table import STIFFER, WALL, measured_peaks

FIXED = rk.SimplifiedSubstituteGravityWall.from_wall(WALL)
"""The wall of 4-32, about its corners."""
STILL = rk.GroundMotion.none(0.5)
"""Long enough to reach the next peak."""


# --- the equivalent oscillator


def oscillator(r: float) -> rk.ControlledWallOscillator:
    """With all of the mass, and F_k as it follows from the energies."""
    return rk.ControlledWallOscillator.from_wall(WALL, r, effective_mass=WALL.mass)


def fitted_ratio(first: int, last: int) -> identification.Fit:
    """r of the oscillator, fitted to the peaks from `first` on, at which it starts, to `last`."""
    peak = measured_peaks()[1][first : last + 1]

    def case(r: float) -> rk.Case:
        return rk.Case(oscillator(r), rk.GroundMotion.none(2.0), initial={"u": float(peak[0])})

    return analysis.fit_free_vibration(
        case, {"r": 0.87}, peaks=peak, quantity="u", bounds={"r": (0.1, 1.0)}
    )


@thesis_figure(Source.IN_KIND)
def figure_4_36() -> Drawn:
    """Free vibration of the equivalent oscillator with one r for all passages, and Table A-1.

    The r of the thesis are not stated but for the first, that of 2-6; here 0.835 by 2-6 about the
    corner, 0.88 and 0.93. The effective mass is all of the mass, n the epsilon of 4-7, and F_k is
    not raised.
    """
    curves = [(f"r = {r:.3f}", released(oscillator(r))) for r in (HOUSNER, 0.88, 0.93)]
    early, late = fitted_ratio(0, 5), fitted_ratio(8, 12)
    ratios = [
        f"{found.values['r']:.3f} ({found.interval('r')[0]:.3f} to {found.interval('r')[1]:.3f})"
        for found in (early, late)
    ]
    return Drawn(
        draw_displacements(curves),
        (
            Statement(
                "4.8.1", "no single r is right: one that works early loses too little later",
                f"the first five passages ask for r = {ratios[0]}, the last four of the first "
                f"twelve for {ratios[1]}",
                bool(early.interval("r")[0] > late.interval("r")[1]),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.IN_KIND)
def figure_4_38() -> Drawn:
    """Effect of small changes of r in 4-31 on the free vibration of the equivalent oscillator.

    The deviations of the thesis are not stated; here r is 0.02 larger in one of the three faster
    bands of speed at a time. The oscillator is that of Figure 4-37, r that of the instantaneous
    speed. The differences stand below.
    """
    law = rk.EnergyRatioAtSpeed.equation_4_31()

    def of(given: rk.EnergyRatioAtSpeed) -> rk.Structure:
        return rk.ControlledWallOscillator.from_wall(
            WALL, given, held=False, effective_mass=WALL.mass / STIFFER
        )

    curves = [("4-31", released(of(law)))]
    for label, changed in bands_raised(law):
        curves.append((label, released(of(changed))))
    off = ", ".join(f"{by:.1f}" for by in moved(curves))
    return Drawn(
        draw_displacements(curves),
        (
            Statement(
                "4.8.1", "a minor deviation of 4-31 changes the later response by much",
                "r larger by 0.02 in the fastest band and the next two moves the wall by up to "
                f"{off} mm, of 30 mm at first",
                bool(max(moved(curves)) > 3.0),
            ),
        ),
    )  # fmt: skip


# --- substitute gravity about fixed corners


@thesis_figure(Source.IN_KIND)
def figure_4_39() -> Drawn:
    """Free vibration of the substitute-gravity wall about fixed corners with one r.

    The r of the thesis are not stated but for the first, that of 2-6; here 0.835, and 0.88 and 0.91
    of the text.
    """
    curves = [
        (f"r = {r:.3f}", released(FIXED, rk.EnergyRatio(r))) for r in (HOUSNER, 0.88, 0.91)
    ]  # fmt: skip
    r = ratios_by_release()[0]
    early, late = r[:6], r[6:]
    return Drawn(
        draw_displacements(curves),
        (
            Statement(
                "4.8.2", "the right r lies between 0.91 in large cycles and 0.88 in small ones",
                f"released at each peak: {early.mean():.3f} on average of the first six passages, "
                f"{late.mean():.3f} of the next six",
                bool(abs(early.mean() - 0.91) < 0.02 and abs(late.mean() - 0.88) < 0.02),
            ),
        ),
    )  # fmt: skip


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


@thesis_figure(Source.COMPUTED)
def figure_4_40() -> Drawn:
    """r with which the substitute-gravity wall comes from each measured peak to the next.

    About fixed corners, by release at each of the first twelve peaks of Table A-1; against the
    speed of the impact and the peak before.
    """
    r, speed = ratios_by_release()
    peak = measured_peaks()[1][:-1]
    figure = style.new_figure(7.6, 3.4)
    by_speed, by_peak = figure.subplots(1, 2, sharey=True)
    for side, mark in ((1, ">"), (-1, "<")):
        rows = np.sign(peak) == side
        by_speed.plot(
            speed[rows], r[rows], mark, color=style.INK, ms=4, mfc="white", mew=0.9
        )  # fmt: skip
    draw_sides(by_peak, peak, r)
    by_speed.set_xlabel(r"speed at the impact $|\dot\Delta|$ [m/s]")
    by_peak.set_xlabel(r"peak before $|\Delta_0|$ [mm]")
    by_speed.set_ylabel("energy ratio $r$ [-]")
    by_speed.set_ylim(0.6, 1.0)
    by_speed.set_xlim(0, None)
    by_peak.set_xlim(0, None)
    style.legend_above(by_peak)
    line = identification.fit(lambda r, slope: r + slope * speed, r, {"r": 0.88, "slope": 0.0})
    low, high = line.interval("slope")
    early = slice(0, 8)
    left, right = (r[early][peak[early] * side > 0] for side in (-1, 1))
    place = upright(8)
    return Drawn(
        figure,
        (
            Statement(
                "4.8.2", "no apparent relation of r to the speed",
                f"slope {low:.2f} to {high:.2f} s/m with 95 % confidence",
                bool(low < 0 < high),
            ),
            Statement(
                "4.8.2", "r is seemingly random",
                f"the first eight alternate with the side, {left.min():.3f} to {left.max():.3f} "
                f"coming from the left, {right.min():.3f} to {right.max():.3f} from the right; an "
                f"upright {place.values['x'] * MM:.2f} mm to the right "
                f"({place.interval('x')[0] * MM:.2f} to {place.interval('x')[1] * MM:.2f}) of the "
                "gauge's zero would be some of it: the wall slid",
                bool(right.max() > left.min()),
            ),
        ),
    )  # fmt: skip


def upright(passages: int) -> identification.Fit:
    """Displacement x [m] at which the wall would stand, that r be one for the first passages.

    By the energies at the peaks, counted from there.
    """
    peak = measured_peaks()[1][: passages + 1]
    energy = WALL.potential_energy

    def off(r: float, x: float) -> np.ndarray:
        return np.log(energy(peak[1:] - x) / energy(peak[:-1] - x)) - np.log(r)

    return identification.fit(off, np.zeros(passages), {"r": 0.89, "x": 5e-4})


@thesis_figure(Source.COMPUTED)
def figure_4_41() -> Drawn:
    """Moving averages of two successive r of Figure 4-40 against their speed, and 4-31.

    Also drawn: pieces fitted to the r of Figure 4-40 themselves in the bands of 4-31, without
    slopes.
    """
    r, speed = ratios_by_release()
    mean, at = (r[1:] + r[:-1]) / 2, (speed[1:] + speed[:-1]) / 2
    law = rk.EnergyRatioAtSpeed.equation_4_31()
    limits = [limit for limit, _, _ in law.pieces[:-1] if np.sum(speed < limit) >= 1]
    fitted = rk.EnergyRatioAtSpeed.from_data(speed, r, limits=limits, slopes=False)
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    v = np.linspace(0.01, 0.9, 800)
    ax.plot(v, [law.at(x) for x in v], color=style.LINES[0], label="4-31")
    ax.plot(v, [fitted.at(x) for x in v], "--", color=style.LINES[1], label="fitted in its bands")
    ax.plot(speed, r, ".", color="0.6", ms=5, label="by release")
    ax.plot(at, mean, "o", color=style.INK, mfc="white", ms=4.5, label="mean of two")
    ax.set_xlabel(r"speed at the impact $|\dot\Delta|$ [m/s]")
    ax.set_ylabel("energy ratio $r$ [-]")
    ax.set_xlim(0, 0.9)
    ax.set_ylim(0.7, 1.0)
    style.legend_above(ax)
    off = mean - np.array([law.at(x) for x in at])
    spread = mean.std(ddof=1)
    return Drawn(
        figure,
        (
            Statement(
                "4.8.2", "the moving averages resemble 4-31",
                f"they lie {off.min():+.3f} to {off.max():+.3f} off it, {off.mean():+.3f} on "
                f"average, and {spread:.3f} (standard deviation) about their own mean; "
                f"rms {np.sqrt(np.mean(off**2)):.3f} off 4-31",
                bool(np.sqrt(np.mean(off**2)) < spread),
            ),
        ),
    )  # fmt: skip


class Miss(NamedTuple):
    """Root mean squares of what the first thirteen peaks are off [mm], and their times [ms]."""

    peak: float
    time: float

    def __str__(self) -> str:
        return f"{self.peak:.2f} mm and {self.time:.1f} ms"


@cache
def miss(law: rk.EnergyRatio | rk.EnergyRatioAtSpeed) -> Miss:
    """Free vibration of the wall about fixed corners, as in `thesis.free_vibration_table`."""
    time, peak = measured_peaks()
    start = {"theta": float(WALL.rotation(peak[0]))}
    run = rk.simulate(FIXED, rk.GroundMotion.none(1.6), impact=law, initial=start)
    simulated = identification.swings(run, "theta", len(peak))
    off = WALL.height * np.sin(simulated.peak) - peak, simulated.peak_time - time
    return Miss(*(float(np.sqrt(np.mean(x**2)) * MM) for x in off))


CONSTANT = rk.EnergyRatio(0.88)
BY_4_31 = rk.EnergyRatioAtSpeed.equation_4_31()
BY_4_36 = rk.EnergyRatioAtSpeed.equation_4_36()


@thesis_figure(Source.COMPUTED)
def figure_4_42() -> Drawn:
    """Free vibration of the substitute-gravity wall about fixed corners with 4-31.

    With the points of Table A-1.
    """
    return Drawn(
        draw_law(BY_4_31, "4-31"),
        (
            Statement(
                "4.8.2", "no dramatic improvement over a single r",
                f"rms off at the first thirteen peaks and their times: {miss(BY_4_31)} with 4-31, "
                f"{miss(CONSTANT)} with r = 0.88",
                bool(miss(BY_4_31).peak > 0.5 * miss(CONSTANT).peak),
            ),
        ),
    )  # fmt: skip


@thesis_figure(Source.COMPUTED)
def figure_4_43() -> Drawn:
    """Free vibration of the substitute-gravity wall about fixed corners with 4-36.

    With the points of Table A-1. 4-36 is as printed, with the larger r for the larger speed.
    """
    start = FIXED.uplift_acceleration
    assert start is not None
    return Drawn(
        draw_law(BY_4_36, "4-36"),
        (
            Statement(
                "4.8.2", "as effective as 4-31",
                f"rms off at the first thirteen peaks and their times: {miss(BY_4_36)} with 4-36, "
                f"{miss(BY_4_31)} with 4-31",
                None,
            ),
            Statement(
                "4.8.2", "an acceleration greater than 11.1 m/s2 is needed to start it",
                f"{start:.2f} m/s2", bool(abs(start - 11.1) < 0.05),
            ),
        ),
    )  # fmt: skip


def draw_law(law: rk.EnergyRatioAtSpeed, name: str) -> Figure:
    """Displacement, velocity and acceleration of the wall about fixed corners under a law."""
    return draw_histories([(name, released(FIXED, law), {"color": style.LINES[0]})])
