"""A figure of the thesis: a function that draws it, and what it is drawn from."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from types import ModuleType
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.plots import style
from rockeom.thesis.equation import place_of

MM = 1e3
"""Millimetres of a metre."""

OPEN: dict[str, Any] = {"color": style.INK, "mfc": "white", "mew": 0.9}
"""Look of measured points."""


class Source(Enum):
    """Source of the data of a figure."""

    PRINTED = "printed data"  # numbers that the thesis prints are drawn
    COMPUTED = "computed"  # all that it depends on is printed, or said with it
    IN_KIND = "in kind"  # another record or values of one's own: what it shows, not its numbers


@dataclass(frozen=True)
class ThesisFigure:
    """Figure of the thesis, drawn again when it is called.

    Parameters
    ----------
    number : str
        Number, such as "2-16".
    source : Source
        Source of the data.
    text : str
        Title, and below it the facts that the thesis leaves open and the assumptions.
    draw : callable
        Function that draws it.
    """

    number: str
    source: Source
    text: str
    draw: Callable[[], Figure]

    @property
    def title(self) -> str:
        """The first line of its text."""
        return self.text.partition("\n")[0].rstrip(".")

    def __call__(self) -> Figure:
        return self.draw()


def thesis_figure(source: Source) -> Callable[[Callable[[], Figure]], ThesisFigure]:
    """Make a function `figure_2_16` the figure 2-16 in the style of all, with its docstring."""
    return lambda draw: _entry(draw, source, draw)


def thesis_panels(
    source: Source, width: float, height: float
) -> Callable[[Callable[[Figure], None]], ThesisFigure]:
    """The same of a function that draws into an empty figure of that size [in]."""
    return lambda draw: _entry(draw, source, lambda: _filled(width, height, draw))


def thesis_axes(
    source: Source, width: float, height: float
) -> Callable[[Callable[[Axes], None]], ThesisFigure]:
    """The same of a function that draws into the only axes of such a figure."""
    return lambda draw: _entry(
        draw, source, lambda: _filled(width, height, lambda figure: draw(figure.add_subplot()))
    )


def _filled(width: float, height: float, draw: Callable[[Figure], None]) -> Figure:
    figure = style.new_figure(width, height)
    draw(figure)
    return figure


def _entry(named: Callable, source: Source, draw: Callable[[], Figure]) -> ThesisFigure:
    number = named.__name__.removeprefix("figure_").replace("_", "-")
    return ThesisFigure(number, source, (named.__doc__ or "").strip(), style.styled(draw))


def figures_of(modules: tuple[ModuleType, ...]) -> dict[str, ThesisFigure]:
    """The figures of these modules, by number, in the order of the thesis."""
    figures = [
        value
        for module in modules
        for value in vars(module).values()
        if isinstance(value, ThesisFigure)
    ]
    return {one.number: one for one in sorted(set(figures), key=place_of)}
