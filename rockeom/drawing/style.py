"""Common parts of all figures: the figure itself, colours, units and modes."""

from __future__ import annotations

import functools
import io
import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.rcsetup import cycler

from rockeom.drawing.drawn import Run
from rockeom.files import write
from rockeom.numbers import explained
from rockeom.numbers.constants import STANDARD_GRAVITY

INK = "0.25"
LINES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")  # Okabe and Ito (2008)
FEET = {"left": LINES[0], "right": LINES[1]}
"""Colour of each foot; what is of no foot has another one in figures of a single response."""
OTHERS = LINES[2:]
"""Colours of lines that belong to no foot."""
FEET_OF_MODES = {"left": "#9ecae1", "right": "#fdae6b", "both": "#d4d4d4", "flight": "#f7f0a8"}
"""Colour of each mode, named by the feet on the ground: light shades of those of FEET."""
MEANINGS = {
    "left": "on the left foot",
    "right": "on the right foot",
    "both": "full contact",
    "flight": "in flight",
}

_RC: dict[Any, Any] = {
    "font.size": 9.0,
    "axes.labelsize": 9.0,
    "axes.linewidth": 0.7,
    "axes.edgecolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.1,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
}

OVERTURNED = "overturned"
"""The outcome of motions whose curves end with a cross."""

P = ParamSpec("P")
R = TypeVar("R")


def styled(draw: Callable[P, R]) -> Callable[P, R]:
    """Draw in the style of these figures and leave matplotlib's settings as they were."""

    @functools.wraps(draw)
    def inner(*args: P.args, **kwargs: P.kwargs) -> R:
        with mpl.rc_context(_RC):
            return explained_draw(*args, **kwargs)

    explained_draw = explained.calls(axes="ax", fig="figure")(draw)
    return inner


@explained.calls()
def use_style() -> None:
    """Draw all figures that follow, of pyplot too, in the style of these figures."""
    mpl.rcParams.update(_RC | {"axes.prop_cycle": cycler(color=LINES)})


class NotebookFigure(Figure):
    """A figure that a notebook shows without pyplot, and so without a list of open figures."""

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        self.savefig(buffer, format="png", dpi=120)
        return buffer.getvalue()


def save_figure(figure: Figure, path: Path, **options: Any) -> None:
    """Write a figure in the format that the name of the file ends in; options : of savefig."""
    made = io.BytesIO()
    figure.savefig(made, format=path.suffix[1:].lower(), **options)
    write(path, made.getvalue())


def new_figure(width: float, height: float) -> NotebookFigure:
    """An empty figure of that size [in] whose parts make room for each other."""
    return NotebookFigure(figsize=(width, height), dpi=150, layout="constrained")


def parent_figure(ax: Axes) -> Figure:
    """The figure in which `ax` stands."""
    found: Any = ax.figure
    while isinstance(found, SubFigure):
        found = found.figure
    return found


# --- units


def is_dimensionless(run: Run) -> bool:
    """Whether the structure's states, time and accelerations are pure numbers."""
    return run.units["ground_acceleration"] == "-"


def ground_scale(run: Run) -> float:
    """One g in the run's accelerations."""
    return 1.0 if is_dimensionless(run) else STANDARD_GRAVITY


def length_scale(run: Run) -> tuple[float, str]:
    """(factor, unit) in which lengths are shown."""
    return (1.0, "-") if is_dimensionless(run) else (1e3, "mm")


def time_label(run: Run) -> str:
    return "time $p\\,t$ [-]" if is_dimensionless(run) else "time [s]"


# --- names


def plain(text: str) -> str:
    """A name that a user gave, as a figure takes it: no letter of it is read as mathematics."""
    return text.replace("$", r"\$")


def name_of(run: Run) -> str:
    """Name of the structure, in words."""
    return run.structure.module.NAME.replace("_", " ")


def title_of(run: Run) -> str:
    """Structure and motion."""
    structure = name_of(run)
    return f"{structure[:1].upper()}{structure[1:]} under {run.motion.name or 'a ground motion'}"


def symbol(name: str) -> str:
    """How a coordinate, or its rate, is written in a figure."""
    if name.endswith("_dot"):
        return rf"$\dot{{{symbol(name.removesuffix('_dot')).strip('$')}}}$"
    head = name.rstrip("0123456789")
    if name == "theta":
        return r"$\theta$"
    return f"${head}_{{{name[len(head) :]}}}$" if head != name else f"${name}$"


def rate_of(run: Run) -> tuple[str, str]:
    """Mathematics and unit of the angular velocity."""
    p = run.structure.module
    name = symbol(run.states[p.ROTATION]).strip("$")
    return rf"\dot{{{name}}}", "-" if is_dimensionless(run) else p.STATE_UNITS[p.ROTATION_RATE]


def largest(run: Run, name: str, factor: float, unit: str) -> str:
    """The largest size of a quantity, found within the steps and times a factor, in words."""
    size = abs(run.extremes(name).peak) * factor
    shown = f"{size:.3g}" if size < 1e3 else f"{size:.0f}"
    return f"largest {shown}{'' if unit == '-' else f' {unit}'}"


def wrapped(text: str, width: int = 105) -> str:
    return "\n".join(textwrap.wrap(text, width))


# --- modes


def feet_of(mode: str) -> str:
    """Key of FEET_OF_MODES: the cart's "both_left" is full contact."""
    return mode.split("_")[0]


def contact_spans(run: Run) -> tuple[np.ndarray, list[str]]:
    """Starts and ends (n, 2) of the times on the same feet, and the feet in each."""
    spans: list[list[float]] = []
    names: list[str] = []
    for (start, end), mode in zip(*run.support.spans, strict=True):
        name = feet_of(run.structure.module.MODES[mode])
        if names and names[-1] == name:
            spans[-1][1] = end
        else:
            spans.append([start, end])
            names.append(name)
    return np.array(spans).reshape(-1, 2), names


def times_of(run: Run, kind: str) -> np.ndarray:
    """(n,) times of the events of a kind [s]."""
    return np.array([e.time for e in run.events if e.kind == kind])


def shade_full_contact(axes: Sequence[Axes], run: Run) -> None:
    """Grey behind the time in which both feet stand on the ground."""
    spans, names = contact_spans(run)
    for ax in axes:
        for (start, end), name in zip(spans, names, strict=True):
            if name == "both":
                ax.axvspan(start, end, color="0.95", lw=0, zorder=0)


def mark_overturning(
    ax: Axes, run: Run, y: np.ndarray, x: np.ndarray | None = None, color: str = "k"
) -> None:
    """A cross where a curve y (n,) of a motion that overturned ends, against time or x (n,)."""
    if run.outcome != OVERTURNED:
        return
    label = None if OVERTURNED in ax.get_legend_handles_labels()[1] else OVERTURNED
    at = (run.t if x is None else x)[-1:]
    ax.plot(
        at, y[-1:], "X", color=color, ms=6, mec="w", mew=0.6, zorder=5, clip_on=False, label=label
    )


def legend_above(ax: Axes, **kwargs: Any) -> None:
    """A legend in one line above the axes, where it can hide no curve."""
    handles, labels = ax.get_legend_handles_labels()
    handles, labels = kwargs.pop("handles", handles), kwargs.pop("labels", labels)
    ax.legend(
        handles,
        labels,
        loc="lower right",
        bbox_to_anchor=(1.0, 0.99),
        ncols=max(len(labels), 1),
        borderaxespad=0.0,
        borderpad=0.2,
        handlelength=1.6,
        columnspacing=1.4,
        **kwargs,
    )
