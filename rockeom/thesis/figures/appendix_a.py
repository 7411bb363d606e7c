"""Figures of appendix A in kind: motions of the shaking table and their response spectra.

The motions of the table are lost. Drawn are the records that were meant, with the peaks that the
table reached; Tabas and Llolleo are not at hand.
"""

import numpy as np
from matplotlib.figure import Figure

from rockeom.plots import style
from rockeom.thesis import shaken
from rockeom.thesis.figures.chapter_4_tests import draw_meant_and_reached
from rockeom.thesis.figures.drawn import Source, ThesisFigure

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
    below.set(ylabel="displacement [mm]", xlabel="time [s]", xlim=(0, t[-1]))
    figure.align_ylabels((top, below))
    return figure


def motion_of(number: str, run: str) -> ThesisFigure:
    text = (
        f"Motion of the table in run {run}, {shaken.MOTION_NAMES[run]}.\n\n"
        f"Drawn is {_MEANT}; its displacement is the integral of the record, "
        "without a correction of its baseline."
    )
    return ThesisFigure(number, Source.IN_KIND, text, style.styled(lambda: draw_motion(run)))


def spectrum_of(number: str, run: str, remark: str = "") -> ThesisFigure:
    text = (
        f"Response spectrum of run {run}, {shaken.MOTION_NAMES[run]}, damped by 5 %.\n\n"
        f"Drawn is {_MEANT}, and the record with the peak that was meant.{remark}"
    )
    return ThesisFigure(
        number, Source.IN_KIND, text, style.styled(lambda: draw_meant_and_reached(run))
    )


figure_a_1 = motion_of("A-1", "1")
figure_a_2 = spectrum_of(
    "A-2", "1", " The caption of the thesis names run 2, and the motion of run 1."
)
figure_a_3 = motion_of("A-3", "2")
figure_a_4 = spectrum_of("A-4", "2")
figure_a_7 = motion_of("A-7", "4")
figure_a_8 = spectrum_of("A-8", "4")
