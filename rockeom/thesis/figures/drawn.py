"""A figure of the thesis: a function that draws it, and the statements that it decides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from types import ModuleType
from typing import NamedTuple

from matplotlib.figure import Figure

from rockeom.plots import style


class Source(Enum):
    """Source of the data of a figure."""

    PRINTED = "printed data"  # numbers that the thesis prints are drawn
    COMPUTED = "computed"  # all that it depends on is printed, or said with it
    IN_KIND = "in kind"  # another record or values of one's own: what it shows, not its numbers


class Statement(NamedTuple):
    """A sentence of the thesis with a number, and the number that was found.

    where : section, page or figure of the thesis. printed : what it says there. found : what comes
    out here, with its unit. holds : whether they agree as far as the sentence asks; None where
    neither can be said, with the reason in `found`.
    """

    where: str
    printed: str
    found: str
    holds: bool | None

    @property
    def verdict(self) -> str:
        """In a word."""
        return {True: "holds", False: "differs", None: "open"}[self.holds]


class Drawn(NamedTuple):
    """A figure with the statements that go with it."""

    figure: Figure
    statements: tuple[Statement, ...] = ()


@dataclass(frozen=True)
class ThesisFigure:
    """A figure of the thesis, drawn again when it is called.

    number : such as "2-16". source : what stands behind it. text : its title, and below it what
    the thesis leaves open and what is assumed. draw : what draws it.
    """

    number: str
    source: Source
    text: str
    draw: Callable[[], Figure | Drawn]

    @property
    def title(self) -> str:
        """The first line of its text."""
        return self.text.partition("\n")[0].rstrip(".")

    @property
    def sort_key(self) -> tuple[str, int, str]:
        """Its place among the others: chapter, number, letter."""
        chapter, _, place = self.number.partition("-")
        digits = place.rstrip("abcd")
        return chapter, int(digits), place[len(digits) :]

    def drawn(self) -> Drawn:
        """The figure and its statements."""
        result = self.draw()
        return result if isinstance(result, Drawn) else Drawn(result)

    def __call__(self) -> Figure:
        return self.drawn().figure


def thesis_figure(source: Source) -> Callable[[Callable[[], Figure | Drawn]], ThesisFigure]:
    """Make a function `figure_2_16` the figure 2-16 in the style of all; its docstring is the text.

    The function returns the figure, or `Drawn` with the statements that it can decide.
    """

    def made(draw: Callable[[], Figure | Drawn]) -> ThesisFigure:
        number = draw.__name__.removeprefix("figure_").replace("_", "-")
        text = (draw.__doc__ or "").strip()
        return ThesisFigure(number, source, text, style.styled(draw))

    return made


def figures_of(modules: tuple[ModuleType, ...]) -> dict[str, ThesisFigure]:
    """The figures of these modules, by number, in the order of the thesis."""
    figures = [
        value
        for module in modules
        for value in vars(module).values()
        if isinstance(value, ThesisFigure)
    ]
    return {one.number: one for one in sorted(set(figures), key=lambda one: one.sort_key)}
