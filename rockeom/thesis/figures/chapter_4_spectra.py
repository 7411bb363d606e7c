"""Spectra of a window that moves along a record, Figures 4-50 and 4-51; section 4.9.1.

The measured traces are lost. In kind is a simulated wall, sampled as the tests were, 200 times a
second, with noise of 0.05 mm. The text states the window, 0.43 times the sampling rate, and its
step of two samples. It does not state Kaiser's beta, here 6, nor the segments of Welch's average:
one here, for 2.3 Hz at best, which beta makes 3.4 Hz.
"""

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import identification
from rockeom.plots import style
from rockeom.thesis import shaken
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import let_go

RATE, NOISE = 200.0, 0.05e-3
START = -0.03041
"""First peak of Table A-1 [m]."""


OSCILLATOR = shaken.oscillator_of("5", rk.EnergyRatioAtSpeed.equation_4_31())
"""That of Figure 4-37, with r of 4-31."""


def sampled(run: rk.Response, duration: float, **more: np.ndarray) -> analysis.MeasuredRecord:
    """The displacement as a test would have it, and other channels."""
    t = np.arange(round(duration * RATE)) / RATE
    noise = np.random.default_rng(0).normal(0.0, NOISE, len(t))
    displacement = run.at(t)["u"] + noise
    return analysis.MeasuredRecord(t, {"displacement": displacement, **more})


@cache
def free_decay() -> analysis.MeasuredRecord:
    return sampled(let_go(OSCILLATOR, 3.5, u=START), 3.5)


@cache
def windows_of_decay() -> identification.MovingWindow:
    return identification.moving_window(free_decay(), "displacement", frequencies=(0.5, 25.0))


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
    record, windows = free_decay(), windows_of_decay()
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
