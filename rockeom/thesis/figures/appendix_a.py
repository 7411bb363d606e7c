"""Figures of appendix A in kind: motions of the shaking table and their response spectra.

The motions of the table are lost. Drawn are the records that were meant, with the peaks that the
table reached; Tabas and Llolleo are not at hand.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from rockeom import analysis
from rockeom.plots import style
from rockeom.thesis import shaken
from rockeom.thesis.figures.drawn import Source, ThesisFigure

_NAMES = {"1": "El Centro 180, half", "2": "El Centro 180", "4": "Sylmar 360 in 0.6 of its time"}
_MEANT = "the record that was meant, with the peak that the table reached, Table 4-1"


def draw_motion(run: str) -> Figure:
    """Acceleration and displacement of the ground in a run of Table 4-1."""
    motion = shaken.wall_motion(run)
    t = np.arange(0.0, min(motion.duration, 40.0), 5e-3)
    figure = style.new_figure(7.2, 4.0)
    top, below = figure.subplots(2, 1, sharex=True)
    top.plot(t, motion.acceleration(t), lw=0.6)
    top.set_ylabel(r"acceleration [m/s$^2$]")
    below.plot(t, 1e3 * motion.displacement(t), lw=0.9)
    below.set_ylabel("displacement [mm]")
    below.set_xlabel("time [s]")
    below.set_xlim(0, t[-1])
    figure.align_ylabels((top, below))
    return figure


def draw_spectrum(run: str) -> Figure:
    """Response spectrum of a run, damped by 5 %: as meant, and with the peak of the table."""
    periods = np.geomspace(0.03, 3.0, 120)
    figure = style.new_figure(5.6, 3.4)
    ax = figure.add_subplot()
    for motion, label, line in (
        (shaken.intended_motion(run), "as meant", "-"),
        (shaken.wall_motion(run), "with the peak of the table", "--"),
    ):
        found = analysis.response_spectrum(motion, periods)
        ax.plot(found.periods, found.pseudo_acceleration, line, label=label)
    ax.set_xlim(0, 3)
    ax.set_ylim(0, None)
    ax.set_xlabel("period [s]")
    ax.set_ylabel(r"spectral acceleration [m/s$^2$]")
    ax.legend()
    return figure


def motion_of(number: str, run: str) -> ThesisFigure:
    text = (
        f"Motion of the table in run {run}, {_NAMES[run]}.\n\nDrawn is {_MEANT}; its displacement "
        "is the integral of the record, without a correction of its baseline."
    )
    return ThesisFigure(number, Source.IN_KIND, text, style.styled(lambda: draw_motion(run)))


def spectrum_of(number: str, run: str, remark: str = "") -> ThesisFigure:
    text = (
        f"Response spectrum of run {run}, {_NAMES[run]}, damped by 5 %.\n\nDrawn is {_MEANT}, and "
        f"the record with the peak that was meant.{remark}"
    )
    return ThesisFigure(number, Source.IN_KIND, text, style.styled(lambda: draw_spectrum(run)))


figure_a_1 = motion_of("A-1", "1")
figure_a_2 = spectrum_of(
    "A-2", "1", " The caption of the thesis names run 2, and the motion of run 1."
)
figure_a_3 = motion_of("A-3", "2")
figure_a_4 = spectrum_of("A-4", "2")
figure_a_7 = motion_of("A-7", "4")
figure_a_8 = spectrum_of("A-8", "4")
