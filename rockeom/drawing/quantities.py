"""Quantities of a response against time, by their names."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import repeat
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from rockeom.drawing import style
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.simulation.response import Response

Names = Mapping[str, str]
Strokes = Iterable[Mapping[str, Any]]
_OF_AXES: Strokes = repeat({})


def plot_quantities(
    run: Response, names: Sequence[str], ax: Axes | None, figure: Figure | SubFigure | None
) -> tuple[Figure | SubFigure, Sequence[Axes]]:
    """A row for each quantity, or all in `ax`; the figure and the axes drawn in."""
    for name in names:
        _ = run[name]  # an unknown one is refused before anything is drawn
    if ax is not None:
        units = {name: run.units[name] for name in names}
        if len({*units.values()}) > 1:
            of_each = ", ".join(f"{name} [{unit}]" for name, unit in units.items())
            raise InputError("names").says(f"{of_each} have not one unit: give each its own axes")
        what = _word(names[0]) if len(names) == 1 else ""
        draw_curves(ax, run, {name: _word(name) for name in names}, what)
        return style.parent_figure(ax), [ax]
    figure = figure or style.new_figure(7.2, 0.9 + 1.5 * len(names))
    axes = [*figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]]
    for name, row in zip(names, axes, strict=True):
        draw_curves(row, run, {name: _word(name)}, _word(name))
    figure.suptitle(style.wrapped(style.plain(style.title_of(run))), fontsize=9.5)
    figure.align_ylabels(axes)
    return figure, axes


def draw_curves(
    ax: Axes, run: Response, names: Names, what: str, strokes: Strokes = _OF_AXES
) -> None:
    """Quantities of one unit against time, with their largest sizes, and a legend above them.

    names : what each is called. strokes : colour and line of each; those of the axes if not given.
    """
    unit = run.units[next(iter(names))]
    factor, shown = style.length_scale(run) if unit == "m" else (1.0, unit)
    for (name, word), stroke in zip(names.items(), strokes, strict=False):
        label = f"{word}, {style.largest(run, name, factor, shown)}"
        ax.plot(run.t, run[name] * factor, label=label, **stroke)
    for name, line in zip(names, ax.lines[-len(names) :], strict=True):
        style.mark_overturning(ax, run, run[name] * factor, color=str(line.get_color()))
    ax.set_ylabel(f"{what}\n[{shown}]".strip())
    style.legend_above(ax)


def _word(name: str) -> str:
    """A quantity's name for a label: the symbol of an angle, or words."""
    if name.removesuffix("_dot") == "theta":
        return style.symbol(name)
    return style.plain(name.removesuffix("_dot").replace("_", " ")) + (
        " rate" if name.endswith("_dot") else ""
    )


def require_axes(ax: Any, figure: Any) -> None:
    """Raise TypeError or ValueError for what cannot be drawn in."""
    if ax is not None and figure is not None:
        raise InputError("ax").says("ax and figure are both given: give one of them")
    if not (ax is None or isinstance(ax, Axes)):
        raise InputTypeError("ax", ax).give("one axes of matplotlib, as of plt.subplots()[1]")
    if not (figure is None or isinstance(figure, Figure | SubFigure)):
        raise InputTypeError("figure", figure).give("a figure of matplotlib")
