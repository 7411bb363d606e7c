"""Figures of the thesis, drawn anew from printed numbers, closed forms and simulations.

    from rockeom.thesis.figures import FIGURES

    FIGURES["2-16"]().savefig("2-16.png")
    FIGURES["2-16"].text                      # its conventions, and what the thesis leaves open
    FIGURES["2-16"].drawn().statements        # what the thesis says of it, and what comes out

What a caption or the text leaves open is said with each figure, and so is what was taken for it.
A module here holds the figures of one subject; `FIGURES` finds them by themselves.
"""

from rockeom.thesis.figures import chapter_2, chapter_3, chapter_4_wall
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, ThesisFigure, figures_of

__all__ = ["FIGURES", "NOT_DRAWN", "Drawn", "Source", "Statement", "ThesisFigure"]

FIGURES: dict[str, ThesisFigure] = figures_of(
    (
        chapter_2,
        chapter_3,
        chapter_4_wall,
    )
)
"""Number of a figure -> the figure."""

NOT_DRAWN: dict[str, str] = {}
"""Number of a figure that cannot be drawn from the text -> why."""
