"""A figure of the thesis: a function that draws it, and what it is drawn from."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from types import ModuleType
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.plots import style
from rockeom.thesis.equation import place_of

SOLID = ("-",) * 6
"""The same kind of line for all curves of `draw_curves`."""

MM = 1e3
"""Millimetres of a metre."""

TIME, DELTA, RATIO = "time [s]", r"displacement $\Delta$ [mm]", "energy ratio $r$ [-]"
VELOCITY, SIZE = r"velocity $\dot\Delta$ [m/s]", r"displacement $|\Delta|$ [mm]"
"""Labels of axes."""

OPEN: dict[str, Any] = {"color": style.INK, "mfc": "white", "mew": 0.9}
"""Look of measured points."""
THIN: dict[str, Any] = {"color": style.INK, "lw": 0.8}
"""Look of lines that only help to read."""


class Source(Enum):
    """Source of the data of a figure."""

    PRINTED = "printed data"  # numbers that the thesis prints are drawn
    COMPUTED = "computed"  # all that it depends on is printed
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


def thesis_axes(
    source: Source, width: float, height: float, rows: int = 1, columns: int = 1, **options: Any
) -> Callable[[Callable[..., None]], ThesisFigure]:
    """The same of a function that draws into the axes of such a figure, one row after the other.

    width, height : of the figure [in]. options : of `Figure.subplots`.
    """

    def entry(draw: Callable[..., None]) -> ThesisFigure:
        def filled() -> Figure:
            figure, axes = panels(width, height, rows, columns, **options)
            draw(*axes)
            return figure

        return _entry(draw, source, filled)

    return entry


def panels(
    width: float, height: float, rows: int = 1, columns: int = 1, **options: Any
) -> tuple[Figure, list[Axes]]:
    """A figure of that size [in] and its axes, one row after the other, their labels aligned."""
    figure = style.new_figure(width, height)
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    figure.align_ylabels(axes)
    return figure, list(axes.ravel())


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


# --- what several figures draw


def draw_curves(
    ax: Axes,
    curves: Iterable[tuple[str, np.ndarray, np.ndarray]],
    lines: tuple[str, ...] = ("-", "--", "-.", ":"),
    colors: tuple[str, ...] = style.LINES,
    **look: Any,
) -> None:
    """Curves (label, x, y), each in a colour and kind of line of its own."""
    for (label, x, y), color, line in zip(curves, colors, lines, strict=False):
        ax.plot(x, y, line, color=color, label=label, **look)


def draw_feet(ax: Axes, left: np.ndarray, x: np.ndarray, y: np.ndarray, **look: Any) -> None:
    """Points (n,) of impacts, in the colour of the foot that lands; left (n,) : where it does."""
    for foot, mark, rows in (("left", "<", left), ("right", ">", ~left)):
        label = f"{foot} foot lands"
        look = {"ms": 4, **look}
        ax.plot(x[rows], y[rows], mark, color=style.FEET[foot], label=label, **look)


def draw_sides(
    ax: Axes,
    peak: np.ndarray,
    y: np.ndarray,
    x: np.ndarray | None = None,
    labels: tuple[str, str] = ("from peaks to the right", "to the left"),
) -> None:
    """Values (n,) at peaks [m], with one mark for peaks to the right and one for the left.

    x : where they are drawn; at the sizes of the peaks [mm] if not given.
    """
    at = np.abs(peak) * MM if x is None else x
    for side, mark, label in ((1, ">", labels[0]), (-1, "<", labels[1])):
        rows = np.sign(peak) == side
        ax.plot(at[rows], y[rows], mark, ms=4, label=label, **OPEN)


def legend_of_first(figure: Figure, columns: int) -> None:
    """A legend above all axes, of what the first ones have."""
    figure.legend(
        *figure.axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=columns
    )
