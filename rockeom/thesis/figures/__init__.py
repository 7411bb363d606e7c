"""Figures of the thesis, drawn anew from printed numbers, closed forms and simulations.

    from rockeom.thesis.figures import FIGURES

    FIGURES["2-16"]().savefig("2-16.png")
    FIGURES["2-16"].text                      # its conventions, and what the thesis leaves open
    FIGURES["2-16"].drawn().statements        # what the thesis says of it, and what comes out

What a caption or the text leaves open is said with each figure, and so is what was taken for it.
A module here holds the figures of one subject; `FIGURES` finds them by themselves.
"""

from rockeom.thesis.figures import (
    chapter_2,
    chapter_2_blocks,
    chapter_2_design,
    chapter_3,
    chapter_4_free_vibration,
    chapter_4_shaken,
    chapter_4_simulated,
    chapter_4_spectra,
    chapter_4_wall,
    chapter_5_flexible,
    chapter_5_rigid,
    chapter_5_tests,
)
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, ThesisFigure, figures_of

__all__ = ["FIGURES", "NOT_DRAWN", "Drawn", "Source", "Statement", "ThesisFigure"]

FIGURES: dict[str, ThesisFigure] = figures_of(
    (
        chapter_2,
        chapter_2_blocks,
        chapter_2_design,
        chapter_3,
        chapter_4_free_vibration,
        chapter_4_shaken,
        chapter_4_simulated,
        chapter_4_spectra,
        chapter_4_wall,
        chapter_5_flexible,
        chapter_5_rigid,
        chapter_5_tests,
    )
)
"""Number of a figure -> the figure."""

_TRACES = "the measured traces of chapter 3 are lost"
NOT_DRAWN: dict[str, str] = {
    "3-1": "a drawing and a photograph of the specimen",
    "3-2": "a drawing of the steel mechanism",
    "3-11": "a diagram of forces: the notebook on Housner's block has one",
    "3-12": f"{_TRACES}; 3-13 has the simulated block",
    "3-18": f"{_TRACES}; `Impacts` finds r in a record",
    "3-19": f"{_TRACES}; `Impacts.histogram` counts",
    "3-20": f"{_TRACES}; `Impacts.cumulative` sums",
    "3-21": f"{_TRACES}; `Impacts` finds r against the speed in a record",
    "3-23": f"{_TRACES}, and with them the impact forces",
}
"""Number of a figure that cannot be drawn from the text -> why."""
