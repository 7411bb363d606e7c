"""Common parts of all figures: the figure itself, colours, units and modes."""

import functools
import io
import re
import textwrap
from collections.abc import Callable, Iterator, Sequence
from itertools import cycle, product
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.rcsetup import cycler

from rockeom.files import write
from rockeom.integrator.schema import in_space
from rockeom.numbers import explained
from rockeom.numbers.constants import STANDARD_GRAVITY
from rockeom.simulation.response import Response

INK = "0.25"
LINES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")  # Okabe and Ito (2008)
FEET = {"left": LINES[0], "right": LINES[1]}
"""Colour of each foot; what is of no foot has another one in figures of a single response."""
OTHERS = LINES[2:]
"""Colours of lines that belong to no foot."""
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


def strokes(colors: Sequence[str]) -> Iterator[dict[str, str]]:
    """Colour and kind of line of one curve after the other, never the same two for two curves."""
    return (
        {"color": color, "ls": line} for line, color in cycle(product(("-", "--", ":"), colors))
    )


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


def new_axes(width: float, height: float) -> tuple[NotebookFigure, Axes]:
    """An empty figure of that size [in], and its only axes."""
    figure = new_figure(width, height)
    return figure, figure.add_subplot()


def parent_figure(ax: Axes) -> Figure:
    """The figure in which `ax` stands."""
    figure: Any = ax.figure
    while isinstance(figure, SubFigure):
        figure = figure.figure
    return figure


# --- units


def is_dimensionless(run: Response) -> bool:
    """Whether the structure's states, time and accelerations are pure numbers."""
    return run.units["ground_acceleration"] == "-"


def ground_scale(run: Response) -> float:
    """One g in the run's accelerations."""
    return 1.0 if is_dimensionless(run) else STANDARD_GRAVITY


def length_scale(run: Response) -> tuple[float, str]:
    """(factor, unit) in which lengths are shown."""
    return (1.0, "-") if is_dimensionless(run) else (1e3, "mm")


def time_label(run: Response) -> str:
    return "time $p\\,t$ [-]" if is_dimensionless(run) else "time [s]"


# --- names


def plain(text: str) -> str:
    """A name that a user gave, as a figure takes it: no letter of it is read as mathematics."""
    return text.replace("$", r"\$")


def name_of(run: Response) -> str:
    """Name of the structure, in words."""
    of = run.structure
    name = of.model if in_space(of.module) else of.module.NAME  # a boulder is a legged statue
    return name.replace("_", " ")


def title_of(run: Response) -> str:
    """Structure and motion."""
    structure = name_of(run)
    if run.slope:
        structure += f" on a slope of {np.degrees(run.slope):.3g} degrees"
    return f"{structure[:1].upper()}{structure[1:]} under {run.motion.name or 'a ground motion'}"


def symbol(name: str) -> str:
    """How a coordinate, or its rate, is written in a figure: a letter and its index, or words."""
    if name.endswith("_dot"):
        return rf"$\dot{{{symbol(name.removesuffix('_dot')).strip('$')}}}$"
    head = name.rstrip("0123456789")
    index, head = name[len(head) :], head.removesuffix("_")
    if _GREEK.fullmatch(head):
        head = f"\\{head}"
    elif len(head) > 1:
        head = rf"\mathrm{{{head.replace('_', ' ').replace(' ', chr(92) + ' ')}}}"
    return f"${head}_{{{index}}}$" if index else f"${head}$"


_GREEK = re.compile(
    "alpha|beta|gamma|delta|eta|theta|kappa|mu|nu|xi|rho|sigma|tau|phi|chi|psi|omega"
)


def rate_of(run: Response) -> tuple[str, str]:
    """Mathematics and unit of the angular velocity."""
    p = run.structure.module
    name = symbol(run.states[p.ROTATION]).strip("$")
    return rf"\dot{{{name}}}", "-" if is_dimensionless(run) else p.STATE_UNITS[p.ROTATION_RATE]


def largest(run: Response, name: str, factor: float, unit: str) -> str:
    """The largest size of a quantity, found within the steps and times a factor, in words."""
    size = abs(run.extremes(name).peak) * factor
    shown = f"{size:.3g}" if size < 999.5 else f"{size:.0f}"
    return f"largest {shown}{'' if unit == '-' else f' {unit}'}"


def digits(value: float, number: int = 3) -> str:
    """A value rounded to a number of digits, without an exponent below 1e10."""
    return f"{float(f'{value:.{number}g}'):.10g}"


def wrapped(text: str, width: int = 105) -> str:
    return "\n".join(textwrap.wrap(text, width))


# --- modes


def feet_of(mode: str) -> str:
    """The feet that are down in a mode, by its name: the cart's "both_left" is full contact."""
    return mode.split("_")[0]


def contacts(run: Response) -> dict[str, np.ndarray]:
    """The states (k,) of each contact in the k spans between events, the feet first: 0 if open."""
    m, (_, modes) = run.structure.module, run.support.spans
    chosen, which = np.unique(modes, return_inverse=True)  # in space the modes are too many
    states = {
        name: np.array([table[mode][i] for mode in chosen])[which]
        for names, states_of in (("POINTS", "POINT_STATES"), ("ELEMENTS", "ELEMENT_STATES"))
        for table in [getattr(m, states_of, ())]
        for i, name in enumerate(getattr(m, names, ()))
        if f"{name}_uplift" in m.KINEMATICS
    }
    feet = np.array([feet_of(m.MODES[mode]) for mode in modes])
    states = states or {foot: np.isin(feet, (foot, "both")).astype(int) for foot in FEET}
    return {name: states[name] for name in sorted(states, key=lambda name: name not in FEET)}


def spans_in(run: Response, chosen: np.ndarray) -> np.ndarray:
    """Starts and ends (k, 2) of the times in those spans between events that are `chosen`."""
    spans, _ = run.support.spans
    edges = np.diff(np.concatenate([[0], chosen, [0]]).astype(int))
    return np.column_stack([spans[edges[:-1] > 0, 0], spans[edges[1:] < 0, 1]])


def bars(spans: np.ndarray) -> list[tuple[float, float]]:
    """Starts and lengths of spans (k, 2), as `broken_barh` takes them."""
    return [(start, end - start) for start, end in spans.tolist()]


def full_contact(run: Response) -> np.ndarray:
    """Starts and ends (k, 2) of the times in which each contact is closed, but for walls."""
    m = run.structure.module
    kinds = dict(zip(m.POSITIONS, m.POSITION_KINDS, strict=True))
    closed = {name: states > 0 for name, states in contacts(run).items()}
    feet = [one for name, one in closed.items() if "wall" not in kinds.get(name, "")]
    return spans_in(run, np.all(feet or [*closed.values()], axis=0))


def shade_full_contact(axes: Sequence[Axes], run: Response) -> None:
    """Grey behind the time in which all contacts are closed."""
    for ax in axes:
        for start, end in full_contact(run):
            ax.axvspan(start, end, color="0.95", lw=0, zorder=0)


def mark_overturning(
    ax: Axes, run: Response, y: np.ndarray, x: np.ndarray | None = None, color: str = "k"
) -> None:
    """A cross where a curve y (n,) of a motion that overturned ends, against time or x (n,)."""
    if run.outcome != OVERTURNED:
        return
    label = None if OVERTURNED in ax.get_legend_handles_labels()[1] else OVERTURNED
    at = (run.t if x is None else x)[-1:]
    ax.plot(
        at, y[-1:], "X", color=color, ms=6, mec="w", mew=0.6, zorder=5, clip_on=False, label=label
    )


_LETTERS_PER_INCH = 19.0
_BESIDE_LABEL = 8  # letters that a handle and the gap to the next one take


def legend_above(ax: Axes, handles: Sequence[Any] = (), **kwargs: Any) -> None:
    """A legend above the axes, where it can hide no curve; as few lines as their width allows.

    handles : what it explains; all that has a label if not given.
    """
    handles = handles or ax.get_legend_handles_labels()[0]
    labels = [str(handle.get_label()) for handle in handles]
    letters = [_BESIDE_LABEL + len(re.sub(r"\\(?=\w)|[${}]", "", label)) for label in labels]
    room = ax.get_window_extent().width / parent_figure(ax).dpi * _LETTERS_PER_INCH
    ax.legend(
        handles,
        labels,
        loc="lower right",
        bbox_to_anchor=(1.0, 0.99),
        ncols=max(len(labels) if sum(letters) <= room else int(room / max(letters)), 1),
        borderaxespad=0.0,
        borderpad=0.2,
        handlelength=1.6,
        columnspacing=1.4,
        **kwargs,
    )
