"""Figures of 4.9.1: the wall of chapter 4 on the shaking table, and its oscillator.

The traces of the tests are lost; Table 4-2 has the largest displacements and tendon forces.
The record of test run 4 is Northridge 1994, Sylmar 360, in 0.6 of its time. The components at 32
and 122 degrees in FEMA P695's near-field set give it the peak of Table 4-1, 8.273 m/s2.
"""

from dataclasses import replace
from functools import cache
from itertools import groupby
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

import rockeom as rk
from rockeom.analysis import design, dynamics, formulas
from rockeom.plots import style
from rockeom.thesis.figures.chapter_2_blocks import draw_branch
from rockeom.thesis.figures.chapter_4_wall import overview_and_origin, symmetric
from rockeom.thesis.figures.drawn import MM, Source, thesis_panels
from rockeom.thesis.free_vibration_table import STIFFER, WALL
from rockeom.thesis.shaken import oscillator_of, wall_motion
from rockeom.thesis.wall_tests import back_calculated_force, energy_ratio_4_31

MEASURED_PEAK = -23.91e-3
"""Largest displacement of test run 4, Table 4-2 [m]."""
RATIO = 0.852
RATIOS = 101
"""Number of r in Figure 4-71."""


# --- test run 4


def forces_when_still(run: rk.Response) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [m] and -M_e (a_g + a) [N] of 4-42, where the displacement turns back."""
    d = run["displacement"]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(d))) != 0) + 1
    h, mass = WALL.height, WALL.mass
    pairs = []
    for i in turns[np.abs(d[turns]) > 2e-4]:
        state = {name: float(run[name][i]) for name in run.states}
        ground = float(run["ground_acceleration"][i])
        turning = run.structure.accelerations(state, mode=run.mode[i], ground_acceleration=ground)[
            "theta"
        ]
        sin, cos = np.sin(state["theta"]), np.cos(state["theta"])
        a = h * (turning * cos - state["theta_dot"] ** 2 * sin)
        pairs.append((d[i], back_calculated_force(mass, a, ground)))
    displacement, force = np.array(pairs).T
    return displacement, force


@thesis_panels(Source.IN_KIND, 7.6, 3.4)
def figure_4_69(figure: Figure) -> None:
    """The static restoring force, 4-30, and the force by 4-42 from a dynamic response.

    The traces are lost. `ControlledWall` replaces them, the wall by Lagrange's equations with all
    terms, with r = 0.852, under the motion of test run 4 and under 1.4 times it, as
    the first does not go beyond 5 mm; from 1.5 times it on the tendon yields, and the points fall
    below the curve with its prestress. M_e is the whole mass, as in the thesis.
    """
    motion = wall_motion("4")
    left, right = overview_and_origin(figure)
    parts = []
    for scale, mark, color in ((1.0, "o", style.LINES[1]), (1.4, "^", style.LINES[2])):
        run = rk.simulate(
            rk.ControlledWall.thesis(), motion.scaled(acceleration=scale),
            impact=rk.EnergyRatio(RATIO),
            options=rk.SolverOptions(output_step=1e-3),
        )  # fmt: skip
        d, force = forces_when_still(run)
        parts.append((d, force))
        for ax in (left, right):
            ax.plot(d * MM, force / 1e3, mark, color=color, ms=3.2, mfc="none", mew=0.8,
                    label=f"4-42, run 4 times {scale:g}")  # fmt: skip
    d, force = (np.concatenate(x) for x in zip(*parts, strict=True))
    for ax, far in ((left, 1.05 * np.abs(d).max()), (right, 0.008)):
        u = symmetric(float(far))
        ax.plot(u * MM, WALL.restoring_force(u) / 1e3, color=style.LINES[0], label="4-30", zorder=1)
        ax.set_xlim(-far * MM, far * MM)
    left.set_ylabel("restoring force $F_k$ [kN]")
    left.legend(loc="upper left", fontsize=7.5)


# --- trials of 4.9.1.4

SHAKEN = 5.0
"""Duration of the trials [s]."""


@cache
def trials() -> dict[str, design.OscillatorResponse]:
    """Responses of the oscillator under run 4 with the backbones and damping of 4.9.1.4."""
    mass, n = WALL.mass, WALL.rotation_centre.epsilon
    force = design.tabulated(WALL.restoring_force, 0.06)
    passages = design.PassageDamping(RATIO, n)
    natural = 2 * np.pi * np.sqrt(mass * 2e-3 / float(WALL.restoring_force(2e-3)))
    critical = float(formulas.priestley_damping(RATIO))
    viscous = design.ViscousDamping.of_ratio(critical, mass, natural)
    straight = design.tabulated(design.linear_start(WALL.restoring_force, 2e-3), 0.06)
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    other = design.tabulated(edge.restoring_force, 0.06)
    choices: dict[str, tuple[Any, tuple[design.Damping, ...]]] = {
        "r = 0.852": (force, (passages,)),
        "r by 4-31": (force, (design.PassageDamping(energy_ratio_4_31, n),)),
        "centre 442, 66 mm": (other, (passages,)),
        "linear start": (straight, (passages,)),
        "bilinear": (design.bilinear_fit(WALL.restoring_force, 0.03), (passages,)),
        "viscous below 5 mm": (force, (passages, replace(viscous, below=5e-3))),
        "viscous": (force, (viscous,)),
        "tangent stiffness": (force, (design.TangentDamping.of_ratio(critical, natural),)),
    }
    return {
        name: design.EquivalentOscillator(mass, *choice).response(
            wall_motion("4"), duration=SHAKEN, step=2.5e-3
        )
        for name, choice in choices.items()
    }


@thesis_panels(Source.IN_KIND, 8.8, 3.6)
def figure_4_70(figure: Figure) -> None:
    """The oscillator with r = 0.852 under the record of test run 4, and other trials.

    The motion is the record that the test names, not that of the table, and the measured trace is
    lost; a line marks its peak of 23.91 mm. Right: the peaks of the changes that 4.9.1.4 tries;
    the thesis does not state their values. Here the other rotation centre is 4-7 referred to the
    edge, since that of Figure 4-60 is lost; the linear start goes to 2 mm; the bilinear backbone is
    the nearest up to 30 mm. Viscous damping is that of 2-16 for r at the period of the secant at
    2 mm, either everywhere or below 5 mm together with r; the damping by the tangent stiffness has
    the same ratio there.
    """
    responses = trials()
    left, right = figure.subplots(1, 2, width_ratios=(1.7, 1.0))
    for name, color, width in (
        ("r = 0.852", style.LINES[0], 1.1),
        ("viscous", style.LINES[1], 0.8),
    ):
        run = responses[name]
        left.plot(run.time, run.displacement * MM, color=color, lw=width, label=name)
    left.axhline(MEASURED_PEAK * MM, color=style.INK, lw=0.8, ls=":", label="measured peak")
    left.set(xlim=(0, SHAKEN), xlabel="time [s]", ylabel=r"displacement $\Delta$ [mm]")
    style.legend_above(left)
    peaks = {name: float(run.peak) * MM for name, run in responses.items()}
    places = np.arange(len(peaks))[::-1]
    right.barh(places, list(peaks.values()), color=style.LINES[5], height=0.6)
    right.axvline(-MEASURED_PEAK * MM, color=style.INK, lw=0.8, ls=":")
    right.set_yticks(places, list(peaks))
    right.set_xlabel(r"largest $|\Delta|$ [mm]")


# --- the oscillator for many r, and under harmonic motion


@cache
def peaks_by_ratio() -> tuple[np.ndarray, np.ndarray]:
    """r within 10 % of 0.852, and the largest displacement of run 4 with each [m]."""
    record = wall_motion("4")
    ratios = RATIO * np.linspace(0.9, 1.1, RATIOS)

    def shaken(r: float) -> rk.Case:
        return rk.Case(oscillator_of("4", float(r)), record)

    sweep = rk.simulate_many(shaken, over={"r": ratios})
    return ratios, sweep.peak.sel(state="u").values


@thesis_panels(Source.IN_KIND, 7.6, 3.4)
def figure_4_71(figure: Figure) -> None:
    """Peaks of the oscillator in test run 4 for many r about 0.852.

    The motion of the table is not printed. Here it is the intended record, Northridge 1994, Sylmar
    360, its time scaled by 0.6 (Table 4-1). The response with r = 0.852 replaces the measured
    curve of the thesis. The oscillator is that of 4-37, with all of its mass
    driven by the ground (4-39).
    """
    ratios, peaks = peaks_by_ratio()
    reference = peaks[len(ratios) // 2]
    left, right = figure.subplots(1, 2)
    left.plot(ratios, peaks * MM, ".-", ms=3, lw=0.5, color=style.LINES[0])
    left.plot(0.852, reference * MM, "o", ms=6, mfc="none", color=style.LINES[1])
    left.annotate(
        "r = 0.852", (0.852, reference * MM), (-20, 14), textcoords="offset points", fontsize=8
    )
    left.set(xlabel="energy ratio $r$ [-]", ylabel=r"largest $|\Delta|$ [mm]", ylim=(0, None))
    over = np.sort(peaks) / reference
    right.step(over, 1 - np.arange(len(over)) / len(over), color=style.LINES[0], where="pre")
    right.axvline(1.0, color=style.LINES[1], lw=0.9)
    right.set(
        xlabel="ratio to the peak at r = 0.852 [-]",
        ylabel="part of the analyses at or above [-]",
        ylim=(0, 1.02),
    )


CYCLES = 120
"""Periods of the ground in which a motion of Figure 4-73 settles."""


def settled_speeds(
    frequency: float, amplitude: float, start: dict[str, float]
) -> tuple[np.ndarray, dict[str, float]]:
    """Velocities when upright [m/s] after `CYCLES` of a harmonic shaking, and the last state."""
    wall = rk.ControlledWallOscillator.from_wall(WALL, 0.852, effective_mass=WALL.mass / STIFFER)
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=(CYCLES + 40) * period)
    options = rk.SolverOptions(rtol=1e-9, atol=1e-11, output_step=period)
    run = rk.simulate(wall, motion, initial=start, options=options)
    passages = [e.before for e in run.events if e.time > CYCLES * period]
    speeds = [
        state["u_dot"] for state in passages if abs(state["u"]) < 1e-9
    ]  # other events are not passages
    return np.array(speeds), {name: run.final[name] for name in ("u", "u_dot")}


def stroboscope(frequency: float, amplitude: float) -> dynamics.StroboscopicMap:
    """Stroboscopic map of the oscillator under Z sin(2 pi f t): displacement and velocity."""
    wall = rk.ControlledWallOscillator.from_wall(WALL, 0.852, effective_mass=WALL.mass / STIFFER)
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=2 * period)
    return dynamics.StroboscopicMap(wall, motion, period, states=("u", "u_dot"))


def upright_velocities(branch: dynamics.OrbitBranch) -> np.ndarray:
    """Velocities when upright (k, m) [m/s]: one row for each motion, one column for each passage.

    The passages of a row rotate so that they continue the row before. New columns begin where their
    number changes; other entries are nan.
    """
    rows = [
        [e.before["u_dot"] for run in orbit.runs for e in run.events if abs(e.before["u"]) < 1e-9]
        for orbit in branch.orbits
    ]
    groups = [list(group) for _, group in groupby(rows, len)]
    table = np.full((len(rows), sum(len(group[0]) for group in groups)), np.nan)
    lines = iter(table)
    first = 0
    for group in groups:
        last = np.array(group[0])
        for row, line in zip(group, lines, strict=False):
            turns = [np.roll(row, k) for k in range(len(row))]
            last = turns[int(np.argmin([np.abs(turn - last).max() for turn in turns]))]
            line[first : first + len(row)] = last
        first += len(group[0])
    return table


DOUBLING = (0.000228, 0.0341)
"""Displacement [m] and velocity [m/s] of the motion at 4.553 Hz and 6.02 m/s2 that will double."""


def branches_of(frequency: float, start: ArrayLike) -> list[dynamics.OrbitBranch]:
    """Orbit branches of one period from 6.02 m/s2 down and up, and a branch that doubles."""

    def at(amplitude: float) -> dynamics.StroboscopicMap:
        return stroboscope(frequency, amplitude)

    down, up = (dynamics.orbit_branch(at, (6.02, end), start) for end in (5.6, 6.5))
    flips = [one for one in up.bifurcations if one.kind == "period doubling"]
    return [down, up, *(up.switched(one) for one in flips[:1])]


@thesis_panels(Source.COMPUTED, 7.6, 3.6)
def figure_4_73(figure: Figure) -> None:
    """Velocities when upright under Z sin(16 pi t): at 8 Hz nothing splits, at 4.553 Hz it does.

    The thesis has one line for Z from 5.7 to 6.0 m/s2, a period that doubles at 6.03, and a smear
    from 6.2 on. At its 8 Hz the oscillator has one motion, its own mirror image, from each of
    three starts (left). The multipliers of that motion stay complex from 5 to 7 m/s2, of size
    0.85, so that its period cannot double.

    The description of the thesis fits 4.553 Hz (right), chosen so that the period doubles at 6.03;
    the smear from 6.21 on then follows. Black is a motion of four passages a cycle,
    followed from 6.02 up and down. Orange dots are motions from rest: below 5.97 they settle to one
    of two passages a cycle, which stays stable next to the other. A third, with passages of
    0.8 m/s, is out of the picture. The oscillator is that of 4-37 with the constant r = 0.852.
    """
    stated, sought = figure.subplots(1, 2)

    def dots(ax: Axes, z: float, speeds: np.ndarray, color: str, size: float) -> None:
        ax.plot(np.full_like(speeds, z), speeds, ".", ms=size, mew=0, color=color)

    for z in np.linspace(5.6, 6.5, 19):
        for start in ({"u": 0.0}, {"u": 0.02}, {"u": 0.004, "u_dot": -0.6}):
            dots(stated, z, settled_speeds(8.0, z, start)[0], style.INK, 3.0)
        dots(sought, z, settled_speeds(4.553, z, {"u": 0.0})[0], style.LINES[1], 3.5)
    for way in (np.arange(6.02, 5.59, -0.02), np.arange(6.02, 6.5, 0.01)):
        state = dict(zip(("u", "u_dot"), DOUBLING, strict=True))
        for z in way:
            speeds, state = settled_speeds(4.553, z, state)
            dots(sought, z, speeds, style.INK, 2.0)
    settled = stroboscope(8.0, 6.02).points({"u": 0.004, "u_dot": 0.2}, 60)[-1]
    for ax, frequency, first in ((stated, 8.0, settled), (sought, 4.553, DOUBLING)):
        for branch in branches_of(frequency, first):
            draw_branch(ax, branch, upright_velocities(branch))
    stated.set_title("8 Hz, as stated", fontsize=9)
    sought.set_title("4.553 Hz, sought", fontsize=9)
    for ax, reach in ((stated, 0.6), (sought, 0.3)):
        ax.axvline(6.03, color=style.INK, lw=0.6, ls=":")
        ax.set(xlabel="amplitude $Z$ [m/s$^2$]", ylim=(-reach, reach))
    stated.set_ylabel(r"velocity when upright $\dot\Delta$ [m/s]")
