"""Figures of the shaking-table tests of the wall of chapter 4, in kind, by the records intended.

The motions of the table and the traces are lost. El Centro 180 (runs 1, 2 and 7) and Sylmar 360
(runs 4 and 9) are at hand, Tabas and Llolleo (runs 3, 6 and 8) are not. Simulated is the wall by
4-27 (SDOF) and by 4-40 (MHSG), as for Tables 4-3 and 4-5; of the tests, Table 4-2 has the largest
displacements and tendon forces.
"""

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics, formulas, identification
from rockeom.plots import style
from rockeom.thesis import shaken
from rockeom.thesis.figures.chapter_4_runs import displacement, oscillator_run
from rockeom.thesis.figures.chapter_4_shaken import CYCLES, forces_when_still
from rockeom.thesis.figures.chapter_4_spectra import NOISE, RATE
from rockeom.thesis.figures.chapter_4_wall import draw_measured, overview_and_origin, symmetric
from rockeom.thesis.figures.drawn import MM, Source, thesis_axes, thesis_figure, thesis_panels
from rockeom.thesis.free_vibration_table import STIFFER, WALL
from rockeom.thesis.printed import TABLE_4_2

ROCKING_PERIODS = (0.10, 0.24)
"""Period of the wall, section 4.4 [s]."""


# --- the motions


@cache
def spectrum(run: str) -> dynamics.ResponseSpectrum:
    """Spectrum of the intended motion, damped by 5 %."""
    return analysis.response_spectrum(shaken.intended_motion(run), np.geomspace(0.03, 3.0, 120))


def nzs_1170_5(period: np.ndarray, hazard: float = 0.7) -> np.ndarray:
    """Elastic spectrum of NZS 1170.5 (2004) on very soft soil (class E) [m/s2].

    period (n,) [s]. hazard: Z R, at most 0.7. The shape factor is that of its commentary; far from
    a fault.
    """
    # second-hand, as the standard is not at hand: its branches and the limit of Z R are those of
    # github.com/Agent6-6-6/NZS1170.5-Seismic-Coefficient-functions
    t = np.asarray(period)
    shape = np.select(
        [t < 0.1, t < 1.0, t < 1.5, t < 3.0],
        [1.12 + 18.8 * t, 3.0, 3.0 / t**0.75, 3.32 / t],
        9.96 / t**2,
    )
    return np.asarray(shaken.G * hazard * shape)


def draw_spectrum(ax: Axes, run: str, label: str, factor: float = 1.0, **look: object) -> None:
    curve = spectrum(run)
    ax.plot(curve.periods, factor * curve.pseudo_acceleration, label=label, **look)  # type: ignore[arg-type]


def draw_meant_and_reached(run: str) -> Figure:
    """Spectrum of a run as intended, and the same with the peak that the table reached."""
    factor = shaken.wall_motion(run).peak / shaken.intended_motion(run).peak
    figure, ax = style.new_axes(5.6, 3.4)
    draw_spectrum(ax, run, f"intended: {shaken.MOTION_NAMES[run]}")
    draw_spectrum(ax, run, "intended, at the peak of the table", factor, ls="--")
    ax.set(
        xlim=(0, 3), ylim=(0, None), xlabel="period [s]", ylabel=r"spectral acceleration [m/s$^2$]"
    )
    ax.legend()
    return figure


@thesis_figure(Source.IN_KIND)
def figure_4_6() -> Figure:
    """Response spectrum of test run 2: the motion intended, and the same at the table's peak.

    The motion that the table made is lost; of it the peak is printed. Dashed is the record scaled
    to that peak: the table cannot be distinguished from it. The damping is 5 %, as in the appendix.
    """
    figure = draw_meant_and_reached("2")
    figure.axes[0].axvspan(*ROCKING_PERIODS, color=style.LINES[4], alpha=0.25, lw=0)
    return figure


@thesis_axes(Source.IN_KIND, 6.0, 3.6)
def figure_4_7(ax: Axes) -> None:
    """Response spectra of the tests and the elastic design spectrum of NZS 1170.5.

    Spectra of the motions intended, damped by 5 %, without those of Tabas and Llolleo, which are
    not at hand. The design spectrum is that of NZS 1170.5, the most detrimental as the text has it:
    very soft soil is class E, and Z R is at most 0.7. It is second-hand, by a public program for
    the standard. The band holds the rocking periods.
    """
    runs = {"1": "run 1", "2": "runs 2, 7", "4": "runs 4, 9"}
    for run, label in runs.items():
        draw_spectrum(ax, run, f"{label}: {shaken.MOTION_NAMES[run]}")
    t = spectrum("2").periods
    ax.plot(t, nzs_1170_5(t), color=style.INK, lw=1.5, label="NZS 1170.5, class E, Z R = 0.7")
    ax.axvspan(*ROCKING_PERIODS, color=style.LINES[4], alpha=0.25, lw=0)
    ax.set(xscale="log", xlim=(t[0], t[-1]), ylim=(0, 32))
    ax.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
    ax.set(xlabel="period [s]", ylabel=r"spectral acceleration [m/s$^2$]")
    ax.legend(loc="upper right", fontsize=7.5)


# --- moving windows


@cache
def windows(run: str) -> tuple[analysis.MeasuredRecord, identification.MovingWindow]:
    """A run of 4-27 as a test would have recorded it, and its transfer functions."""
    simulated = oscillator_run(run)
    t = np.arange(int(simulated.t[-1] * RATE)) / RATE
    u = displacement(simulated, t) + np.random.default_rng(0).normal(0.0, NOISE, len(t))
    record = analysis.MeasuredRecord(
        t, {"displacement": u, "table": shaken.wall_motion(run).acceleration(t)}
    )
    return record, identification.moving_window(
        record, "displacement", "table", segments=2, beta=2.0, frequencies=(1.0, 15.0)
    )


def draw_windows(figure: Figure, run: str, until: float) -> None:
    """The trace and its spectrogram."""
    record, moving = windows(run)
    trace, ax = figure.subplots(2, 1, sharex=True, height_ratios=(1.0, 1.6))
    trace.plot(record.time, record["displacement"] * MM, lw=0.7)
    trace.set_ylabel(r"displacement $\Delta$ [mm]")
    ax.pcolormesh(moving.time, moving.frequency, moving.amplitude.T, cmap="Greys", rasterized=True)
    ax.plot(moving.time, moving.dominant, ".", ms=2, color=style.LINES[1], label="largest")
    ax.set(xlabel="time, middle of the window [s]", ylabel="frequency [Hz]")
    ax.grid(visible=False)
    ax.set_xlim(0, until)
    style.legend_above(ax, markerscale=4)


def frequencies(run: str, until: float) -> np.ndarray:
    """The largest frequency of the windows that are shaken (n,) [Hz]."""
    record, moving = windows(run)
    table = np.abs(np.interp(moving.time, record.time, envelope(record)))
    strong = (table > 0.1 * table.max()) & (moving.time < until)
    return moving.dominant[strong]


def envelope(record: analysis.MeasuredRecord) -> np.ndarray:
    """Mean size of the table's acceleration about each instant, over the length of a window."""
    samples = round(0.43 * RATE)
    return np.convolve(np.abs(record["table"]), np.ones(samples) / samples, mode="same")


def between(values: np.ndarray, low: float, high: float) -> float:
    """Part of the values in an interval, in percent."""
    return 100 * float(np.mean((values >= low) & (values <= high)))


@thesis_panels(Source.IN_KIND, 7.2, 4.8)
def figure_4_52(figure: Figure) -> None:
    """Moving window on test run 1: half of El Centro 180.

    Simulated by 4-27 with r of 4-31 and sampled as the tests were, 200 times a second, with noise
    of 0.05 mm. Beta and segments are not stated: with one segment, as in Figure 4-50, the quotient
    is largest wherever this record has a gap in its spectrum, so that there are two, beta is 2, and
    frequencies above 15 Hz are left out; the bandwidth is 3.7 Hz. With one to three segments and
    beta 2 or 6, from 39 to 74 % of the windows of runs 1 and 2 are between 7 and 12 Hz. Windows
    count as shaken where the table has more than a tenth of its largest mean acceleration. The
    oscillator cannot bend: its high frequencies are those of small turns about the middle.
    """
    draw_windows(figure, "1", 30.0)


@thesis_panels(Source.IN_KIND, 7.2, 4.8)
def figure_4_53(figure: Figure) -> None:
    """Moving window on test run 2: El Centro 180.

    As Figure 4-52. The caption is lost; the text has Figures 4-52 to 4-56 for the runs in order.
    """
    draw_windows(figure, "2", 30.0)


@thesis_panels(Source.IN_KIND, 7.2, 4.8)
def figure_4_55(figure: Figure) -> None:
    """Moving window on test run 4: Sylmar 360 in 0.6 of its time.

    As Figure 4-52, with the record that was meant in place of the table's own motion.
    """
    draw_windows(figure, "4", 15.0)


# --- sensitivity, section 4.9.1.5

HARMONIC = (5.88, 8.0)
"""Amplitude [m/s2] and frequency [Hz] of Figure 4-72."""


@cache
def settled() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, velocity and speeds when upright of the last cycles, under `HARMONIC`."""
    amplitude, frequency = HARMONIC
    wall = rk.ControlledWallOscillator.from_wall(WALL, 0.852, effective_mass=WALL.mass / STIFFER)
    duration = (CYCLES + 40) / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=1 / frequency, duration=duration)
    run = rk.simulate(wall, motion, options=rk.SolverOptions(rtol=1e-9, atol=1e-11))
    last = run.at(np.linspace(duration - 4 / frequency, duration, 1601))
    late = [e.before for e in run.events if e.time > CYCLES / frequency]
    speeds = np.array([s["u_dot"] for s in late if abs(s["u"]) < 1e-9])
    return last["u"], last["u_dot"], speeds


@thesis_axes(Source.COMPUTED, 4.6, 3.6)
def figure_4_72(ax: Axes) -> None:
    """Phase diagram of the oscillator under 5.88 sin(16 pi t), when it has settled.

    From rest, after 120 cycles of the ground, four cycles; r = 0.852. The oscillator is that of
    4-37. The equation of the text has M_e Z sin(16 pi t), so that P_e of the caption is for a unit
    of mass. Dots are passages through upright, the points of Figure 4-73.
    """
    u, v, speeds = settled()
    ax.plot(u * MM, v, lw=1.0)
    ax.plot(np.zeros_like(speeds), speeds, "o", ms=4, color=style.LINES[1])
    ax.axvline(0.0, color=style.INK, lw=0.5)
    ax.set(xlabel=r"displacement $\Delta$ [mm]", ylabel=r"velocity $\dot\Delta$ [m/s]")


BESIDE = 0.1e-3
"""How far from upright the second of two runs begins [m]."""


@thesis_axes(Source.IN_KIND, 7.2, 3.2)
def figure_4_74(ax: Axes) -> None:
    """The same motion twice, the wall once upright and once 0.1 mm from it.

    The two tests are lost, runs 18 and 19 of another study with the same motion and prestress; what
    was different in them is not known. In kind is test run 4 by 4-27 with r of 4-31, from upright
    and from 0.1 mm next to it: after a test up to 0.7 mm were left (Table 4-2).
    """
    first = oscillator_run("4")
    again = rk.simulate(first.structure, first.motion, initial={"u": BESIDE})
    t = np.arange(0.0, 15.0, 2e-3)
    one, other = displacement(first, t), displacement(again, t)
    ax.plot(t, one * MM, lw=0.9, label="from upright")
    ax.plot(t, other * MM, lw=0.9, label="from 0.1 mm next to it")
    ax.set(xlim=(0, 15), xlabel="time [s]", ylabel=r"displacement $\Delta$ [mm]")
    style.legend_above(ax)


# --- uplifts and tendon forces, sections 4.9.1.1 and 4.9.2

SPREAD = 2.5e-3
"""Sliding to either side that 4.9.1.1 infers from the scatter [m]."""
RUNS = ("1", "2", "3", "4", "6")
"""The tests with 75 kN."""
MORE = analysis.Wall.thesis(111e3)
GROUPS = (("75 kN", ("1", "2", "3", "4", "6"), "o"), ("110 kN", ("7", "8", "9"), "s"))


def read_from_tendon(runs: tuple[str, ...], bends: bool = True) -> dict[str, np.ndarray]:
    """Rotation centre and uplift by the largest displacement and tendon force of tests.

    The extension of the tendon by its stiffness places the rotation centre; both maxima count as
    simultaneous. bends : whether to subtract the bending of the wall, F_k/k, from the displacement
    first; else all of it is rotation. Returns displacement and force [m, N], the part of the
    displacement that is rotation, the distance of the centre from the edge and the edge's uplift
    [m]; (n,) each.
    """
    rows = [row for row in TABLE_4_2.rows if row[0] in runs]
    d, before, force = np.array([row[1:4] for row in rows], dtype=float).T * [[1e-3], [1e3], [1e3]]
    extension = (force - before) / MORE.tendons[0].stiffness
    bent = np.array([
        float(bending(x, analysis.Wall.thesis(p))) for x, p in zip(np.abs(d), before, strict=True)
    ]) if bends else 0.0  # fmt: skip
    turn = np.tan(MORE.rotation(np.abs(d) - bent))
    beside = extension / turn  # of the tendon, in the middle
    half = MORE.half_width
    return {
        "displacement": d,
        "rigid": np.abs(d) - bent,
        "force": force,
        "from_edge": half - beside,
        "uplift": (beside + half) * turn,
    }


def rows_of_75_kn() -> dict[str, np.ndarray]:
    """Displacement [m], tendon force before and largest [N], change of alignment [m]; (5,) each."""
    chosen = [row for row in TABLE_4_2.rows if row[0] in RUNS]
    names = ("displacement", "before", "largest", "after", "alignment")
    columns = zip(*(row[1:] for row in chosen), strict=True)
    unit = (1e-3, 1e3, 1e3, 1e3, 1e-3)
    return {n: u * np.array(c, dtype=float) for n, u, c in zip(names, unit, columns, strict=True)}


def bending(displacement: ArrayLike, wall: analysis.Wall = WALL) -> np.ndarray:
    """Bending of the wall under F_k [m], with the stiffness of its fixed-base period, 0.0428 s."""
    stiffness = wall.mass * (2 * np.pi / wall.fixed_base_period) ** 2
    return np.asarray(wall.restoring_force(displacement) / stiffness)


def draw_read(ax: Axes, quantity: str, unit: float) -> None:
    for (label, runs, mark), color in zip(GROUPS, (style.INK, style.LINES[1]), strict=True):
        values = read_from_tendon(runs)
        ax.plot(
            np.abs(values["displacement"]) * MM, values[quantity] / unit, mark, color=color, ms=5,
            mfc="white" if mark == "o" else color, zorder=5, label=f"tests with {label}",
        )  # fmt: skip
    ax.set_xlabel(r"displacement $|\Delta|$ [mm]")


@thesis_panels(Source.IN_KIND, 7.6, 3.4)
def figure_4_57(figure: Figure) -> None:
    """Uplifts of both edges against the displacement on the shaking table: 4-9 and Table 4-2.

    The measured uplifts of the tests are lost. Points are what Table 4-2 says of them: the uplift
    of the edge at the largest displacement of each test with 75 kN, by the extension of the tendon,
    without and with the bending of the wall. The band is 2.5 mm of sliding to either side of 4-9.
    """
    axes = overview_and_origin(figure)
    b = WALL.half_width
    for ax, far in zip(axes, (0.032, 0.008), strict=True):
        d = symmetric(far + SPREAD)
        for name, side, color in (("left", -1, style.LINES[0]), ("right", 1, style.LINES[1])):
            uplift = WALL.uplift(d, side * b)
            low, high = (d - SPREAD) * MM, (d + SPREAD) * MM
            ax.fill_betweenx(uplift * MM, low, high, color=color, alpha=0.15, lw=0)
            ax.plot(d * MM, uplift * MM, color=color, label=f"{name} edge, 4-9")
        for bends, face in ((False, "white"), (True, style.INK)):
            read = read_from_tendon(GROUPS[0][1], bends)
            inside = np.abs(read["displacement"]) < far
            ax.plot(
                read["displacement"][inside] * MM, read["uplift"][inside] * MM, "D", ms=4.5,
                color=style.INK, mfc=face, zorder=6,
                label=f"Table 4-2, {'less bending' if bends else 'all of the displacement'}",
            )  # fmt: skip
        ax.set_xlim(-far * MM, far * MM)
    axes[0].set_ylabel("uplift $u'$ [mm]")
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set_ylim(-0.6, 4.0)


@thesis_panels(Source.IN_KIND, 7.6, 3.4)
def figure_4_58(figure: Figure) -> None:
    """Tendon force against the displacement: 4-16, and the largest of each test in Table 4-2.

    The traces are lost; the thesis prints the largest displacement and the largest tendon force of
    each of the five tests with 75 kN. The band is 2.5 mm of sliding to either side. The prestress
    of the curve is 75.6 kN.
    """
    tests = rows_of_75_kn()
    axes = overview_and_origin(figure)
    for ax, far in zip(axes, (0.032, 0.012), strict=True):
        d = symmetric(far + SPREAD)
        force = WALL.tendon_force(d) / 1e3
        low, high = (d - SPREAD) * MM, (d + SPREAD) * MM
        ax.fill_betweenx(force, low, high, color=style.LINES[0], alpha=0.15, lw=0,
                         label="2.5 mm of sliding")  # fmt: skip
        ax.plot(d * MM, force, color=style.LINES[0], label="4-16")
        draw_measured(ax, "tendon_force", 1e3, "Table A-1 ")
        ax.plot(tests["displacement"] * MM, tests["largest"] / 1e3, "D", color=style.LINES[1],
                ms=5, label="Table 4-2, largest of a test", zorder=6)  # fmt: skip
        ax.set_xlim(-far * MM, far * MM)
    axes[0].set(ylabel="tendon force $P$ [kN]", ylim=(70, 165))
    axes[1].set_ylim(72, 115)
    axes[0].legend(loc="upper center", fontsize=7)


@thesis_axes(Source.IN_KIND, 6.0, 3.6)
def figure_4_75(ax: Axes) -> None:
    """Distance of the rotation centre from the edge: 4-7, and what Table 4-2 says of the tests.

    The uplifts measured are lost. The points follow from the largest tendon force and displacement
    of each test, as the tendon's extension is the uplift of the middle. The points leave
    out the bending of the wall, F_k over the stiffness of its fixed-base period, 0.0428 s; where
    sliding is part of it the centre comes out too near the middle. 4-7 is drawn as seen from the
    edge, 442 and 66 mm, and as printed, from the gauge.
    """
    d = np.linspace(0.0, 0.03, 600)
    edge, gauge = formulas.RotationCentre.thesis_edge(), formulas.RotationCentre.thesis_gauge()
    ax.plot(d * MM, edge.distance_from_edge(d) * MM, label="4-7 from the edge")
    ax.plot(d * MM, gauge.distance_from_edge(d) * MM, "--", color=style.LINES[5],
            label="4-7 as printed")  # fmt: skip
    draw_read(ax, "from_edge", 1e-3)
    ax.set_ylabel("distance from the edge [mm]")
    ax.legend()


@thesis_axes(Source.IN_KIND, 6.0, 3.6)
def figure_4_76(ax: Axes) -> None:
    """Uplift of the edge against the displacement: 4-9, and what Table 4-2 says of the tests.

    As Figure 4-75: the uplift of the edge follows from the tendon's extension and the rotation,
    without the bending of the wall.
    """
    d = np.linspace(0.0, 0.03, 600)
    ax.plot(d * MM, MORE.uplift(d) * MM, label="4-9")
    draw_read(ax, "uplift", 1e-3)
    ax.set_ylabel("uplift $u'$ [mm]")
    ax.legend()


@thesis_axes(Source.IN_KIND, 6.0, 3.6)
def figure_4_77(ax: Axes) -> None:
    """Tendon force against the displacement with 110 kN: 4-16, and the largest of each test.

    The traces are lost; Table 4-2 has the largest displacement and tendon force of each test.
    """
    d = symmetric(0.012)
    for wall, label, color in (
        (MORE, "4-16, 111 kN", style.LINES[1]), (WALL, "4-16, 75.6 kN", style.INK),
    ):  # fmt: skip
        ax.plot(d * MM, wall.tendon_force(d) / 1e3, color=color, label=label)
    for (label, runs, mark), color in zip(GROUPS, (style.INK, style.LINES[1]), strict=True):
        values = read_from_tendon(runs)
        near = np.abs(values["displacement"]) < 0.012
        ax.plot(values["displacement"][near] * MM, values["force"][near] / 1e3, mark, color=color,
                mfc="white", label=f"tests with {label}")  # fmt: skip
    ax.set(xlabel=r"displacement $\Delta$ [mm]", ylabel="tendon force $P$ [kN]", ylim=(70, 150))
    ax.legend(loc="upper center", ncols=2, fontsize=7.5)


@thesis_panels(Source.IN_KIND, 7.6, 3.4)
def figure_4_78(figure: Figure) -> None:
    """Restoring force with 75.6 and with 111 kN, and what 4-42 reads from a dynamic response.

    The traces are lost. Points are those of `ControlledWall` with 111 kN and r = 0.852 under the
    motions of runs 7 and 9, where the wall turns back, as in Figure 4-69. The tendon of both yields
    at the same force.
    """
    axes = overview_and_origin(figure)
    for run, mark, color in (("7", "^", style.LINES[2]), ("9", "o", style.LINES[4])):
        response = rk.simulate(
            rk.ControlledWall.from_wall(shaken.wall_of(run)), shaken.wall_motion(run),
            impact=rk.EnergyRatio(0.852), options=rk.SolverOptions(output_step=1e-3),
        )  # fmt: skip
        d, force = forces_when_still(response)
        for ax in axes:
            ax.plot(d * MM, force / 1e3, mark, color=color, ms=3.2, mfc="none", mew=0.8,
                    label=f"4-42, run {run}")  # fmt: skip
    for ax, far in zip(axes, (0.07, 0.006), strict=True):
        d = symmetric(far)
        for wall, label, color in (
            (MORE, "111 kN", style.LINES[1]), (WALL, "75.6 kN", style.LINES[0]),
        ):  # fmt: skip
            ax.plot(d * MM, wall.restoring_force(d) / 1e3, color=color, zorder=1, label=label)
            limit = wall.yield_displacement()
            if limit < far:
                for end in (-limit, limit):
                    ax.plot(end * MM, wall.restoring_force(end) / 1e3, "|", ms=10, color=color)
        ax.set_xlim(-far * MM, far * MM)
    axes[0].set_ylabel("restoring force $F_k$ [kN]")
    axes[0].legend(loc="upper left", fontsize=7.5)
