"""Figures of the shaking-table tests of the wall of chapter 4, in kind, by the records intended.

The motions of the table and the traces are lost. El Centro 180 (runs 1, 2 and 7) and Sylmar 360
(runs 4 and 9) are at hand, Tabas and Llolleo (runs 3, 6 and 8) are not. Table 4-2 has the largest
displacements and tendon forces of the tests.

Moving windows, Figures 4-50 and 4-51, are on a simulated wall, sampled as the tests were, 200 times
a second, with noise of 0.05 mm. The text states the window, 0.43 times the sampling rate, and its
step of two samples. It does not state Kaiser's beta, here 6, nor the segments of Welch's average:
one here, for 2.3 Hz at best, which beta makes 3.4 Hz.
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
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.figures.chapter_4_free_vibration import (
    draw_measured,
    overview_and_origin,
    symmetric,
)
from rockeom.thesis.figures.chapter_4_shaken import draw_forces_when_still, draw_static_force
from rockeom.thesis.free_vibration_table import WALL, from_first_peak
from rockeom.thesis.printed import TABLE_4_2

ROCKING_PERIODS = (0.10, 0.24)
"""Period of the wall, section 4.4 [s]."""


# --- the motions


@cache
def spectrum(run: str) -> dynamics.ResponseSpectrum:
    """Spectrum of the intended motion, damped by 5 %."""
    return analysis.response_spectrum(shaken.intended_motion(run), np.geomspace(0.03, 3.0, 120))


nzs_1170_5 = rk.DesignSpectrum.nzs_1170_5(0.7, 1.0, "E")
"""Elastic spectrum on very soft soil far from a fault, Z R at its limit [m/s2]."""


def draw_spectrum(ax: Axes, run: str, label: str, factor: float = 1.0, **look: object) -> None:
    curve = spectrum(run)
    ax.plot(curve.periods, factor * curve.pseudo_acceleration, label=label, **look)  # type: ignore[arg-type]


def mark_rocking_periods(ax: Axes) -> None:
    ax.axvspan(*ROCKING_PERIODS, color=style.LINES[4], alpha=0.25, lw=0, label="rocking periods")
    ax.set(xlabel="period [s]", ylabel=r"spectral acceleration [m/s$^2$]")


@dr.thesis_axes(dr.Source.IN_KIND, 6.0, 3.6)
def figure_4_6(ax: Axes) -> None:
    """Response spectra of test runs 1 and 2: the motions intended, and at the table's peak.

    The motions that the table made are lost; of them the peaks are printed. Dashed is the record
    scaled to that peak: the table cannot be distinguished from it. The damping is 5 %. These are
    the spectra of Figures A-2 and A-4, too; the caption of A-2 names run 2 with the motion of 1.
    """
    for run, color in (("2", style.LINES[0]), ("1", style.LINES[2])):
        factor = shaken.wall_motion(run).peak / shaken.intended_motion(run).peak
        name = f"run {run}: {shaken.MOTION_NAMES[run]}"
        draw_spectrum(ax, run, f"{name}, intended", color=color)
        draw_spectrum(ax, run, f"{name}, at the table's peak", factor, color=color, ls="--")
    mark_rocking_periods(ax)
    ax.set(xlim=(0, 3), ylim=(0, None))
    ax.legend()


@dr.thesis_axes(dr.Source.IN_KIND, 6.0, 3.6)
def figure_4_7(ax: Axes) -> None:
    """Response spectra of the tests and the elastic design spectrum of NZS 1170.5.

    Spectra of the motions intended, damped by 5 %, without those of Tabas and Llolleo, which are
    not at hand. The design spectrum is that of NZS 1170.5, the most detrimental as the text has it:
    very soft soil is class E, and Z R is at most 0.7. It is second-hand, by a public program for
    the standard.
    """
    for run, label in (("1", "run 1"), ("2", "runs 2, 7"), ("4", "runs 4, 9")):
        draw_spectrum(ax, run, f"{label}: {shaken.MOTION_NAMES[run]}")
    t = spectrum("2").periods
    ax.plot(t, nzs_1170_5(t), color=style.INK, lw=1.5, label="NZS 1170.5, class E, Z R = 0.7")
    mark_rocking_periods(ax)
    ax.set(xscale="log", xlim=(t[0], t[-1]), ylim=(0, 38))
    ax.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
    ax.legend(loc="upper right", fontsize=7.5)


# --- uplifts and tendon forces, sections 4.9.1.1 and 4.9.2

SPREAD = 2.5e-3
"""Sliding to either side that 4.9.1.1 infers from the scatter [m]."""
RUNS = ("1", "2", "3", "4", "6")
"""The tests with 75 kN."""
MORE = analysis.Wall.thesis(111e3)
GROUPS = (("75 kN", RUNS, "o"), ("110 kN", ("7", "8", "9"), "s"))
COLORS = (style.INK, style.LINES[1])
"""Colours of the tests with 75 and with 110 kN."""


def rows_of(runs: tuple[str, ...]) -> dict[str, np.ndarray]:
    """Displacement [m], tendon force before and largest [N], change of alignment [m]; (n,) each."""
    table = np.array([row[1:] for row in TABLE_4_2.rows if row[0] in runs], dtype=float)
    units = {"displacement": 1e-3, "before": 1e3, "largest": 1e3, "after": 1e3, "alignment": 1e-3}
    return {name: unit * x for (name, unit), x in zip(units.items(), table.T, strict=False)}


def rows_of_75_kn() -> dict[str, np.ndarray]:
    """`rows_of` the tests with 75 kN."""
    return rows_of(RUNS)


def read_from_tendon(runs: tuple[str, ...], bends: bool = True) -> dict[str, np.ndarray]:
    """Rotation centre and uplift by the largest displacement and tendon force of tests.

    The extension of the tendon by its stiffness places the rotation centre; both maxima count as
    simultaneous. bends : whether to subtract the bending of the wall, F_k/k, from the displacement
    first; else all of it is rotation. Returns displacement and force [m, N], the part of the
    displacement that is rotation, the distance of the centre from the edge and the edge's uplift
    [m]; (n,) each.
    """
    rows = rows_of(runs)
    d, before, force = rows["displacement"], rows["before"], rows["largest"]
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


def bending(displacement: ArrayLike, wall: analysis.Wall = WALL) -> np.ndarray:
    """Bending of the wall under F_k [m], with the stiffness of its fixed-base period, 0.0428 s."""
    stiffness = wall.mass * (2 * np.pi / wall.fixed_base_period) ** 2
    return np.asarray(wall.restoring_force(displacement) / stiffness)


def draw_read(ax: Axes, quantity: str, unit: float) -> None:
    """A quantity of `read_from_tendon` over its unit, by the size of the displacement."""
    for (label, runs, mark), color in zip(GROUPS, COLORS, strict=True):
        values = read_from_tendon(runs)
        x, y = np.abs(values["displacement"]) * dr.MM, values[quantity] / unit
        face = "white" if mark == "o" else color
        ax.plot(x, y, mark, color=color, ms=5, mfc=face, zorder=5, label=f"tests with {label}")
    ax.set_xlabel(dr.SIZE)


def draw_slid(ax: Axes, d: np.ndarray, y: np.ndarray, color: str, label: str) -> None:
    """A curve (n,) over displacements [m] with the band of `SPREAD` to either side."""
    ax.fill_betweenx(y, (d - SPREAD) * dr.MM, (d + SPREAD) * dr.MM, color=color, alpha=0.15, lw=0)
    ax.plot(d * dr.MM, y, color=color, label=label)


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 3.4, columns=2)
def figure_4_57(*axes: Axes) -> None:
    """Uplifts of both edges against the displacement on the shaking table: 4-9 and Table 4-2.

    The measured uplifts of the tests are lost. Points are what Table 4-2 says of them: the uplift
    of the edge at the largest displacement of each test with 75 kN, by the extension of the tendon,
    without and with the bending of the wall. The band is 2.5 mm of sliding to either side of 4-9.
    """
    overview_and_origin(*axes)
    for ax, far in zip(axes, (0.032, 0.008), strict=True):
        d = symmetric(far + SPREAD)
        for name, side in (("left", -1), ("right", 1)):
            uplift = WALL.uplift(d, side * WALL.half_width) * dr.MM
            draw_slid(ax, d, uplift, style.FEET[name], f"{name} edge, 4-9")
        for bends, face in ((False, "white"), (True, style.INK)):
            read = read_from_tendon(RUNS, bends)
            near = np.abs(read["displacement"]) < far
            label = f"Table 4-2, {'less bending' if bends else 'all of the displacement'}"
            ax.plot(
                read["displacement"][near] * dr.MM, read["uplift"][near] * dr.MM, "D", ms=4.5,
                color=style.INK, mfc=face, zorder=6, label=label,
            )  # fmt: skip
        ax.set_xlim(-far * dr.MM, far * dr.MM)
    axes[0].set(ylabel="uplift $u'$ [mm]", ylim=(None, 17))
    axes[0].legend(loc="upper center", fontsize=7.5)
    axes[1].set_ylim(-0.6, 4.0)


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 3.4, columns=2)
def figure_4_58(*axes: Axes) -> None:
    """Tendon force against the displacement: 4-16, and the largest of each test in Table 4-2.

    The traces are lost; the thesis prints the largest displacement and the largest tendon force of
    each of the five tests with 75 kN. The band is 2.5 mm of sliding to either side. The prestress
    of the curve is 75.6 kN.
    """
    tests = rows_of_75_kn()
    overview_and_origin(*axes)
    for ax, far in zip(axes, (0.032, 0.012), strict=True):
        d = symmetric(far + SPREAD)
        draw_slid(ax, d, WALL.tendon_force(d) / 1e3, style.LINES[0], "4-16")
        draw_measured(ax, "tendon_force", 1e3, "Table A-1 ")
        x, y = tests["displacement"] * dr.MM, tests["largest"] / 1e3
        label = "Table 4-2, largest of a test"
        ax.plot(x, y, "D", color=style.LINES[1], ms=5, zorder=6, label=label)
        ax.set_xlim(-far * dr.MM, far * dr.MM)
    axes[0].set(ylabel="tendon force $P$ [kN]", ylim=(70, 165))
    axes[1].set_ylim(72, 115)
    axes[0].legend(loc="upper center", fontsize=7)


@dr.thesis_axes(dr.Source.IN_KIND, 6.0, 3.6)
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
    ax.plot(d * dr.MM, edge.distance_from_edge(d) * dr.MM, label="4-7 from the edge")
    as_printed = gauge.distance_from_edge(d) * dr.MM
    ax.plot(d * dr.MM, as_printed, "--", color=style.LINES[5], label="4-7 as printed")
    draw_read(ax, "from_edge", 1e-3)
    ax.set_ylabel("distance from the edge [mm]")
    ax.legend()


@dr.thesis_axes(dr.Source.IN_KIND, 6.0, 3.6)
def figure_4_76(ax: Axes) -> None:
    """Uplift of the edge against the displacement: 4-9, and what Table 4-2 says of the tests.

    As Figure 4-75: the uplift of the edge follows from the tendon's extension and the rotation,
    without the bending of the wall.
    """
    d = np.linspace(0.0, 0.03, 600)
    ax.plot(d * dr.MM, MORE.uplift(d) * dr.MM, label="4-9")
    draw_read(ax, "uplift", 1e-3)
    ax.set_ylabel("uplift $u'$ [mm]")
    ax.legend()


@dr.thesis_axes(dr.Source.IN_KIND, 6.0, 3.6)
def figure_4_77(ax: Axes) -> None:
    """Tendon force against the displacement with 110 kN: 4-16, and the largest of each test.

    The traces are lost; Table 4-2 has the largest displacement and tendon force of each test.
    """
    d = symmetric(0.012)
    labels = "4-16, 75.6 kN", "4-16, 111 kN"
    for wall, said, (label, runs, mark), color in zip(
        (WALL, MORE), labels, GROUPS, COLORS, strict=True
    ):
        ax.plot(d * dr.MM, wall.tendon_force(d) / 1e3, color=color, label=said)
        tests = rows_of(runs)
        near = np.abs(tests["displacement"]) < 0.012
        x, y = tests["displacement"][near] * dr.MM, tests["largest"][near] / 1e3
        ax.plot(x, y, mark, color=color, mfc="white", label=f"tests with {label}")
    ax.set(xlabel=dr.DELTA, ylabel="tendon force $P$ [kN]", ylim=(70, 150))
    ax.legend(loc="upper center", ncols=2, fontsize=7.5)


@dr.thesis_axes(dr.Source.IN_KIND, 7.6, 3.4, columns=2)
def figure_4_78(*axes: Axes) -> None:
    """Restoring force with 75.6 and with 111 kN, and what 4-42 reads from a dynamic response.

    The traces are lost. Points are those of `ControlledWall` with 111 kN and r = 0.852 under the
    motions of runs 7 and 9, where the wall turns back, as in Figure 4-69. The tendon of both yields
    at the same force, at the bars.
    """
    overview_and_origin(*axes)
    for run, mark in (("7", "^"), ("9", "o")):
        rocking = rk.ControlledWall.from_wall(shaken.wall_of(run))
        draw_forces_when_still(axes, rocking, shaken.wall_motion(run), mark, f"4-42, run {run}")
    for ax, far in zip(axes, (0.07, 0.006), strict=True):
        for wall, label, color in (
            (MORE, "111 kN", style.LINES[4]), (WALL, "75.6 kN", style.LINES[0]),
        ):  # fmt: skip
            draw_static_force(ax, wall, far, label, color)
            ends = wall.yield_displacement() * np.array([-1.0, 1.0])
            ax.plot(ends * dr.MM, wall.restoring_force(ends) / 1e3, "|", ms=10, color=color)
    axes[0].set_ylabel("restoring force $F_k$ [kN]")
    axes[0].legend(loc="upper left", fontsize=7.5)


# --- moving windows, section 4.9.1

RATE, NOISE = 200.0, 0.05e-3
OSCILLATOR = shaken.oscillator_of("5", rk.EnergyRatioAtSpeed.equation_4_31())
"""The oscillator of Figure 4-37, with r of 4-31."""


def sampled(run: rk.Response, duration: float, **more: np.ndarray) -> analysis.MeasuredRecord:
    """The displacement as a test would have it, and other channels."""
    t = np.arange(round(duration * RATE)) / RATE
    noise = np.random.default_rng(0).normal(0.0, NOISE, len(t))
    displacement = run.at(t)["u"] + noise
    return analysis.MeasuredRecord(t, {"displacement": displacement, **more})


@cache
def free_decay() -> tuple[analysis.MeasuredRecord, identification.MovingWindow]:
    """The free vibration from the first peak of Table A-1 as a record, and windows on it."""
    record = sampled(from_first_peak(OSCILLATOR, 3.5), 3.5)
    return record, identification.moving_window(record, "displacement", frequencies=(0.5, 25.0))


@cache
def windows_of_shaking() -> identification.MovingWindow:
    return identification.moving_window(noise(), "displacement", "table", frequencies=(1.0, 25.0))


@cache
def noise() -> analysis.MeasuredRecord:
    """The wall under noise between 0.5 and 20 Hz that swells and fades, at most 6 m/s2."""
    from scipy.signal import butter, sosfilt

    t = np.arange(round(6 * RATE)) / RATE
    band = butter(2, [0.5, 20.0], "bandpass", output="sos", fs=RATE)
    ground = sosfilt(band, np.random.default_rng(4).normal(size=len(t))) * np.sin(np.pi * t / 6)
    motion = rk.GroundMotion.from_array(ground, 1 / RATE).scaled_to(peak=6.0)
    run = rk.simulate(OSCILLATOR, motion, duration=6.0)
    return sampled(run, 6.0, table=motion.acceleration(t))


@cache
def frequencies(run: str, until: float) -> np.ndarray:
    """The largest frequency of the windows of a run by 4-27 that are shaken (n,) [Hz].

    As a test would have recorded it. Windows count as shaken where the table has more than a tenth
    of its largest mean acceleration.
    """
    law, motion = rk.EnergyRatioAtSpeed.equation_4_31(), shaken.wall_motion(run)
    simulated = shaken.oscillator_run(run, law)
    t = np.arange(int(simulated.t[-1] * RATE)) / RATE
    record = sampled(simulated, len(t) / RATE, table=motion.acceleration(t))
    moving = identification.moving_window(
        record, "displacement", "table", segments=2, beta=2.0, frequencies=(1.0, 15.0)
    )
    samples = round(0.43 * RATE)
    size = np.convolve(np.abs(record["table"]), np.ones(samples) / samples, mode="same")
    table = np.interp(moving.time, record.time, size)
    return moving.dominant[(table > 0.1 * table.max()) & (moving.time < until)]


def draw_spectrogram(ax: Axes, windows: identification.MovingWindow) -> None:
    ax.pcolormesh(
        windows.time, windows.frequency, windows.amplitude.T, cmap="Greys", rasterized=True
    )
    ax.plot(windows.time, windows.dominant, color=style.LINES[1], lw=1.0, label="largest")
    ax.set(xlabel="time, middle of the window [s]", ylabel="frequency [Hz]")
    ax.grid(visible=False)


def draw_records(ax: Axes, record: analysis.MeasuredRecord, window: tuple[float, float]) -> None:
    ax.plot(record.time, record["displacement"] * dr.MM, lw=0.8, label="displacement [mm]")
    ax.plot(record.time, record["table"], lw=0.6, color="0.6", label=r"table [m/s$^2$]")
    ax.axvspan(*window, color=style.LINES[4], alpha=0.35, lw=0)
    ax.set(xlabel=dr.TIME, ylabel="1. records [mm], [m/s$^2$]", xlim=(0, 6))
    style.legend_above(ax)


def draw_spectra(ax: Axes, inside: analysis.MeasuredRecord) -> None:
    """Spectra of both channels of a record as long as one window."""
    for channel, color in (("displacement", style.LINES[0]), ("table", "0.6")):
        one = identification.moving_window(
            inside, channel, window=len(inside.time) * inside.step, frequencies=(1.0, 25.0)
        )
        ax.plot(one.frequency, one.amplitude[0], color=color, label=channel)
    ax.set(ylabel="2. spectra over their largest [-]", xlabel="frequency [Hz]")
    style.legend_above(ax)


def draw_transfer(ax: Axes, windows: identification.MovingWindow, which: int) -> None:
    ax.plot(windows.frequency, windows.amplitude[which] * windows.largest[which] * dr.MM)
    ax.axvline(windows.dominant[which], color=style.LINES[1], ls="--", lw=0.9)
    ax.set(ylabel="3. transfer [mm/(m/s$^2$)]", xlabel="frequency [Hz]")


def draw_stack(ax: Axes, windows: identification.MovingWindow) -> None:
    """Every twentieth window, each before the ones that follow it."""
    for level, amplitude in zip(windows.time[::20], windows.amplitude[::20], strict=True):
        line, order = level + 0.9 * amplitude, 10 - level
        ax.fill_between(windows.frequency, level, line, color="white", lw=0, zorder=order)
        ax.plot(windows.frequency, line, lw=0.6, color=style.INK, zorder=order)
    ax.plot(windows.dominant[::20], windows.time[::20] + 0.9, color=style.LINES[1], lw=1, zorder=20)
    ax.set(xlabel="frequency [Hz]", ylabel="4. time, middle of the window [s]")
    ax.grid(visible=False)


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_4_50() -> Figure:
    """How the moving window finds the frequencies of a structure, step by step; in kind.

    The wall is the oscillator of Figure 4-37 under noise between 0.5 and 20 Hz of at most 6 m/s2;
    the figure of the thesis does not say which test it shows. 1: the window on the records.
    2: spectra of both in it. 3: the transfer function, the cross spectrum over that of the table.
    4: those of every twentieth window, each over its largest. 5: the same from above.
    """
    record = noise()
    windows = windows_of_shaking()
    which = int(np.searchsorted(windows.time, 2.5))
    middle = float(windows.time[which])
    inside = record.between(middle - windows.span / 2, middle + windows.span / 2)
    figure = style.new_figure(7.6, 7.2)
    grid = figure.add_gridspec(3, 2)
    draw_records(figure.add_subplot(grid[0, :]), record, (inside.time[0], inside.time[-1]))
    draw_spectra(figure.add_subplot(grid[1, 0]), inside)
    draw_transfer(figure.add_subplot(grid[1, 1]), windows, which)
    draw_stack(figure.add_subplot(grid[2, 0]), windows)
    draw_spectrogram(above := figure.add_subplot(grid[2, 1]), windows)
    above.set_ylabel("5. frequency [Hz]")
    return figure


@dr.thesis_axes(dr.Source.IN_KIND, 7.2, 4.8, 2, sharex=True, height_ratios=(1.0, 1.8))
def figure_4_51(trace: Axes, ax: Axes) -> None:
    """The moving window on the free decay of the wall: its response alone; in kind.

    The table stands still, so that there is no input to divide by: this is the spectrum of the
    displacement, over its largest in each window. The wall is the oscillator of Figure 4-37. It
    does not bend: what the text takes for bending, the last frequencies, it has from turning about
    a centre that hardly leaves the middle. A is smooth rocking, B its end, C what follows.
    """
    record, windows = free_decay()
    trace.plot(record.time, record["displacement"] * dr.MM, lw=0.8)
    trace.set_ylabel(dr.DELTA)
    draw_spectrogram(ax, windows)
    ax.set_xlim(0, 3.5)
    dominant, time = windows.dominant, windows.time
    passing = float(time[np.argmax(dominant > 6.0)])
    top = float(time[np.argmax(dominant)])
    circle = {"boxstyle": "circle", "fc": "white", "ec": style.INK}
    for name, at in (
        ("A", (passing / 2, 2.2)),
        ("B", (top, dominant.max() + 2.5)),
        ("C", (2.9, 5.5)),
    ):
        ax.annotate(name, at, ha="center", va="center", weight="bold", bbox=circle)
    ax.legend(loc="upper right")
