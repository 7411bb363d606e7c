"""A figure of the thesis: a function that draws it, and what it is drawn from."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from types import ModuleType

from matplotlib.figure import Figure

from rockeom.plots import style
from rockeom.thesis.equation import place_of


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

    def made(draw: Callable[[], Figure]) -> ThesisFigure:
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
    return {one.number: one for one in sorted(set(figures), key=place_of)}
