"""Figures of 4.9.1: the wall of chapter 4 on the shaking table, and its oscillator.

The traces of the tests are lost; Table 4-2 has the largest displacements and tendon forces.
The record of test run 4 is Northridge 1994, Sylmar 360, in 0.6 of its time. The components at 32
and 122 degrees in FEMA P695's near-field set give it the peak of Table 4-1, 8.273 m/s2.
"""

from functools import cache
from itertools import groupby

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

import rockeom as rk
from rockeom.analysis import dynamics
from rockeom.plots import style
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.figures.chapter_2_blocks import draw_branch
from rockeom.thesis.figures.chapter_4_wall import overview_and_origin, symmetric
from rockeom.thesis.free_vibration_table import STIFFER, WALL
from rockeom.thesis.shaken import R_4_71, oscillator_of, wall_motion
from rockeom.thesis.wall_tests import back_calculated_force

MEASURED_PEAK = -23.91e-3
"""Largest displacement of test run 4, Table 4-2 [m]."""
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


def draw_forces_when_still(
    axes: tuple[Axes, ...], wall: rk.ControlledWall, motion: rk.GroundMotion, mark: str, label: str
) -> float:
    """Forces by 4-42 of a wall with r = 0.852; returns the largest displacement [m]."""
    run = rk.simulate(
        wall, motion, impact=rk.EnergyRatio(R_4_71), options=rk.SolverOptions(output_step=1e-3)
    )
    d, force = forces_when_still(run)
    color = {"o": style.LINES[1], "^": style.LINES[2]}[mark]
    for ax in axes:
        ax.plot(d * dr.MM, force / 1e3, mark, color=color, ms=3.2, mfc="none", mew=0.8, label=label)
    return float(np.abs(d).max())


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 3.4, columns=2)
def figure_4_69(*axes: Axes) -> None:
    """The static restoring force, 4-30, and the force by 4-42 from a dynamic response.

    The traces are lost. `ControlledWall` replaces them, the wall by Lagrange's equations with all
    terms, with r = 0.852, under the motion of test run 4 and under 1.4 times it, as
    the first does not go beyond 5 mm; from 1.5 times it on the tendon yields, and the points fall
    below the curve with its prestress. M_e is the whole mass, as in the thesis.
    """
    overview_and_origin(*axes)
    reach = [
        draw_forces_when_still(
            axes, rk.ControlledWall.thesis(), wall_motion("4").scaled(acceleration=scale), mark,
            f"4-42, run 4 times {scale:g}",
        )
        for scale, mark in ((1.0, "o"), (1.4, "^"))
    ]  # fmt: skip
    for ax, far in zip(axes, (1.05 * max(reach), 0.008), strict=True):
        u = symmetric(far)
        ax.plot(
            u * dr.MM, WALL.restoring_force(u) / 1e3, color=style.LINES[0], label="4-30", zorder=1
        )
        ax.set_xlim(-far * dr.MM, far * dr.MM)
    axes[0].set_ylabel("restoring force $F_k$ [kN]")
    axes[0].legend(loc="upper left", fontsize=7.5)


# --- the oscillator for many r, and under harmonic motion


@cache
def peaks_by_ratio() -> tuple[np.ndarray, np.ndarray]:
    """r within 10 % of 0.852, and the largest displacement of run 4 with each [m]."""
    record = wall_motion("4")
    ratios = R_4_71 * np.linspace(0.9, 1.1, RATIOS)

    def shaken(r: float) -> rk.Case:
        return rk.Case(oscillator_of("4", float(r)), record)

    sweep = rk.simulate_many(shaken, over={"r": ratios})
    return ratios, sweep.peak.sel(state="u").values


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 3.4, columns=2)
def figure_4_71(left: Axes, right: Axes) -> None:
    """Peaks of the oscillator in test run 4 for many r about 0.852.

    The motion of the table is not printed. Here it is the intended record, Northridge 1994, Sylmar
    360, its time scaled by 0.6 (Table 4-1). The response with r = 0.852 replaces the measured
    curve of the thesis. The oscillator is that of 4-37, with all of its mass
    driven by the ground (4-39).
    """
    ratios, peaks = peaks_by_ratio()
    reference = peaks[len(ratios) // 2]
    at = (R_4_71, reference * dr.MM)
    left.plot(ratios, peaks * dr.MM, ".-", ms=3, lw=0.5, color=style.LINES[0])
    left.plot(*at, "o", ms=6, mfc="none", color=style.LINES[1])
    left.annotate("r = 0.852", at, (-20, -18), textcoords="offset points", fontsize=8)
    left.set(xlabel=dr.RATIO, ylabel=r"largest $|\Delta|$ [mm]", ylim=(0, None))
    over = np.sort(peaks) / reference
    right.step(over, 1 - np.arange(len(over)) / len(over), color=style.LINES[0], where="pre")
    right.axvline(1.0, color=style.LINES[1], lw=0.9)
    right.set(xlabel="ratio to the peak at r = 0.852 [-]", ylim=(0, 1.02))
    right.set_ylabel("part of the analyses at or above [-]")


CYCLES = 120
"""Periods of the ground in which a motion of Figures 4-72 and 4-73 settles."""
OSCILLATOR = rk.ControlledWallOscillator.from_wall(WALL, R_4_71, effective_mass=WALL.mass / STIFFER)


def settled_run(
    frequency: float, amplitude: float, start: dict[str, float]
) -> tuple[rk.Response, np.ndarray]:
    """Motion under Z sin(2 pi f t), and its velocities when upright [m/s] after `CYCLES`."""
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=(CYCLES + 40) * period)
    options = rk.SolverOptions(rtol=1e-9, atol=1e-11)
    run = rk.simulate(OSCILLATOR, motion, initial=start, options=options)
    late = [event.before for event in run.events if event.time > CYCLES * period]
    # other events are not passages
    return run, np.array([state["u_dot"] for state in late if abs(state["u"]) < 1e-9])


def settled_speeds(
    frequency: float, amplitude: float, start: dict[str, float]
) -> tuple[np.ndarray, dict[str, float]]:
    """Velocities of `settled_run`, and its last state."""
    run, speeds = settled_run(frequency, amplitude, start)
    return speeds, {name: run.final[name] for name in ("u", "u_dot")}


HARMONIC = (8.0, 5.88)
"""Frequency [Hz] and amplitude [m/s2] of Figure 4-72."""


@cache
def settled() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, velocity and speeds when upright of the last cycles, under `HARMONIC`."""
    run, speeds = settled_run(*HARMONIC, {"u": 0.0})
    end = float(run.t[-1])
    last = run.at(np.linspace(end - 4 / HARMONIC[0], end, 1601))
    return last["u"], last["u_dot"], speeds


@dr.thesis_axes(dr.Source.COMPUTED, 4.6, 3.6)
def figure_4_72(ax: Axes) -> None:
    """Phase diagram of the oscillator under 5.88 sin(16 pi t), when it has settled.

    From rest, after 120 cycles of the ground, four cycles; r = 0.852. The oscillator is that of
    4-37. The equation of the text has M_e Z sin(16 pi t), so that P_e of the caption is for a unit
    of mass. Dots are passages through upright, the points of Figure 4-73.
    """
    u, v, speeds = settled()
    ax.plot(u * dr.MM, v, lw=1.0)
    ax.plot(np.zeros_like(speeds), speeds, "o", ms=4, color=style.LINES[1])
    ax.axvline(0.0, color=style.INK, lw=0.5)
    ax.set(xlabel=dr.DELTA, ylabel=dr.VELOCITY)


def stroboscope(frequency: float, amplitude: float) -> dynamics.StroboscopicMap:
    """Stroboscopic map of the oscillator under Z sin(2 pi f t): displacement and velocity."""
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=2 * period)
    return dynamics.StroboscopicMap(OSCILLATOR, motion, period, states=("u", "u_dot"))


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


@dr.thesis_axes(dr.Source.COMPUTED, 7.6, 3.6, columns=2)
def figure_4_73(stated: Axes, sought: Axes) -> None:
    """Velocities when upright under Z sin(16 pi t): at 8 Hz nothing splits, at 4.553 Hz it does.

    The thesis has one line for Z from 5.7 to 6.0 m/s2, a period that doubles at 6.03 (dotted), and
    a smear from 6.2 on. At its 8 Hz the oscillator has one motion, its own mirror image, from each
    of three starts (left). The multipliers of that motion stay complex from 5 to 7 m/s2, of size
    0.85, so that its period cannot double.

    The description of the thesis fits 4.553 Hz (right), a value of one's own, chosen so that the
    period doubles at 6.03; the smear from 6.21 on then follows. Lines are a motion of four passages
    a cycle, followed from 6.02 up and down, and the doubled one, dashed where they are unstable;
    black dots are where a motion settles that is followed up. Orange dots are motions from rest:
    below 5.97 they settle to one of two passages a cycle, which stays stable next to the other. A
    third, with passages of 0.8 m/s, is out of the picture. The oscillator is that of 4-37 with the
    constant r = 0.852.
    """

    def dots(ax: Axes, z: float, speeds: np.ndarray, color: str, size: float) -> None:
        ax.plot(np.full_like(speeds, z), speeds, ".", ms=size, mew=0, color=color)

    for z in np.linspace(5.6, 6.5, 19):
        dots(sought, z, settled_speeds(4.553, z, {"u": 0.0})[0], style.LINES[1], 3.5)
    for z in np.linspace(5.6, 6.5, 10):
        for start in ({"u": 0.0}, {"u": 0.02}, {"u": 0.004, "u_dot": -0.6}):
            dots(stated, z, settled_speeds(8.0, z, start)[0], style.INK, 3.0)
    state = dict(zip(("u", "u_dot"), DOUBLING, strict=True))
    for z in np.arange(6.02, 6.5, 0.01):
        speeds, state = settled_speeds(4.553, z, state)
        dots(sought, z, speeds, style.INK, 2.0)
    settled_at_8_hz = stroboscope(8.0, 6.02).points({"u": 0.004, "u_dot": 0.2}, 60)[-1]
    for ax, frequency, first, reach, title in (
        (stated, 8.0, settled_at_8_hz, 0.6, "8 Hz, as stated"),
        (sought, 4.553, DOUBLING, 0.3, "4.553 Hz, sought"),
    ):
        for branch in branches_of(frequency, first):
            draw_branch(ax, branch, upright_velocities(branch))
        ax.set_title(title, fontsize=9)
        ax.axvline(6.03, color=style.INK, lw=0.6, ls=":")
        ax.set(xlabel="amplitude $Z$ [m/s$^2$]", ylim=(-reach, reach))
    stated.set_ylabel(r"velocity when upright $\dot\Delta$ [m/s]")
