"""One response against time."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from rockeom.codes import IDLE_POINT, SLIP_LEFT, SLIP_RIGHT
from rockeom.drawing import style
from rockeom.drawing.checks import check_drawn
from rockeom.drawing.plan import AZIMUTHS, barrier_tilts, tilts_of
from rockeom.drawing.quantities import draw_curves, plot_quantities, require_axes
from rockeom.integrator.schema import in_space
from rockeom.motion.slope import WORLD
from rockeom.numbers.checks import number, require
from rockeom.simulation.response import Response
from rockeom.structures.slope import overturning_angles

Draw = Callable[[Axes, Response], None]


@style.styled
def plot_response(
    run: Response,
    *names: str,
    ax: Axes | None = None,
    figure: Figure | SubFigure | None = None,
    start: float | None = None,
    end: float | None = None,
) -> Figure | SubFigure:
    """Draw ground motion, rotation, displacement, uplift, impacts and contacts on one time axis.

    Parameters
    ----------
    run : Response
        Response.
    *names : str
        Names of quantities of the response, to draw these instead, a row each.
    ax : matplotlib.axes.Axes, optional
        Axes to draw the quantities in, which have one unit; the rotation if none is named.
    figure : matplotlib.figure.Figure, optional
        Empty figure or subfigure to draw in; a new one if not given.
    start : float, optional
        Start of the time axis [s]; that of the response if not given.
    end : float, optional
        End of the time axis [s]; that of the response if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure, that of `ax` where axes are given.

    Raises
    ------
    KeyError
        For an unknown quantity.
    ValueError
        For a start behind the end.

    Notes
    -----
    The time in full contact is shaded. Curves of a motion that overturned end with a cross, and
    overturning angles within reach of the rotation are dashed. A tie that breaks has a cross.
    Impacts are drawn as high as the
    angular velocity just before them, so that the endless small ones before rest do not hide the
    large ones. In the lowest row each contact has a bar where it is closed, with a black one below
    where it slides, and is grey where it touches and bears nothing. Structures in space have their
    tilt in place of the rotation, and their yaw.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse)
    >>> figure = plots.plot_response(run)
    >>> figure = plots.plot_response(run, "theta", "left_uplift")
    """
    check_drawn("run", run, Response)
    require_axes(ax, figure)
    limits = _limits(run, start, end)
    if names or ax is not None:
        rotation = run.states[run.structure.module.ROTATION]
        figure, axes = plot_quantities(run, names or (rotation,), ax, figure)
        style.shade_full_contact(axes, run)
    else:
        figure, axes = _overview(run, figure)
        style.shade_full_contact(axes[:-1], run)
    axes[-1].set(xlabel=style.time_label(run), xlim=limits)
    return figure


def _limits(run: Response, start: float | None, end: float | None) -> tuple[float, float]:
    """The part of the time axis shown [s]."""
    first = float(run.t[0]) if start is None else number("start", start)
    last = float(run.t[-1]) if end is None else number("end", end)
    require(first < last, "", "start", first, f"give less than the end, {last:g} s")
    return first, last


def _overview(run: Response, figure: Figure | SubFigure | None) -> tuple[Figure | SubFigure, Any]:
    """The rows that this structure fills, below a title with the outcome."""
    rows = _rows(run)
    heights = [height for _, height in rows]
    figure = figure or style.new_figure(7.2, 0.9 + 1.25 * sum(heights))
    axes = figure.subplots(len(rows), 1, sharex=True, gridspec_kw={"height_ratios": heights})
    for ax, (draw, _) in zip(axes, rows, strict=True):
        draw(ax, run)
    figure.align_ylabels(axes)
    title = style.wrapped(style.plain(style.title_of(run)))
    figure.suptitle(f"{title}\nOutcome: {run.outcome}. {run.outcome.sentence}", fontsize=9.5)
    return figure, axes


def _rows(run: Response) -> list[tuple[Draw, float]]:
    """The rows that this structure fills, with their relative heights."""
    motions = (run.motion, run.transverse, run.vertical)
    shaken = any(m is not None and m.peak > 0.0 for m in motions)
    rows: list[tuple[Draw, float]] = [(_ground, 1.0)] if shaken else []
    if in_space(run.structure.module):
        rows += [(_tilt, 1.0)] + [(_yaw, 0.8)] * bool(_turns(run))
    else:
        rows += [(_rotation, 1.0)]
    # the cart's coordinate is its displacement
    turns = run.structure.module.STATE_UNITS[run.structure.module.ROTATION] != "m"
    rows += [(_displacement, 1.0)] if turns and "displacement" in run.names else []
    contacts = style.contacts(run)
    rows += [(_uplift, 1.0)] if {f"{name}_uplift" for name in contacts} <= {*run.names} else []
    rows += [(_ties, 1.0)] if run.ties else []
    rows += [(_impacts, 0.7)] if len(run.impacts) else []
    return [*rows, (_contacts, 0.15 + 0.13 * len(contacts))]


def _ground(ax: Axes, run: Response) -> None:
    scale = style.ground_scale(run)
    across, up = ("along", "normal") if run.slope else ("horizontal", "vertical")
    ax.plot(run.t, run["ground_acceleration"] / scale, color=style.INK, lw=0.7, label=across)
    ax.set_ylabel("ground\nacceleration [g]")
    if run.transverse is not None or run.azimuth:
        transverse = run["transverse_ground_acceleration"] / scale
        ax.plot(run.t, transverse, color=style.OTHERS[1], lw=0.7, label="transverse")
        style.legend_above(ax)
    if run.vertical is not None or (run.slope and run.ground_axes == WORLD):
        vertical = run["vertical_ground_acceleration"] / scale
        ax.plot(run.t, vertical, color=style.OTHERS[0], lw=0.7, label=up)
        style.legend_above(ax)


def _rotation(ax: Axes, run: Response) -> None:
    """The coordinate that overturns, and other rotations."""
    name = run.states[run.structure.module.ROTATION]
    names = [name, *_others(run, "rad")] if run.units[name] == "rad" else [name]
    what = "displacement" if run.units[name] == "m" else "rotation"
    what += f" {style.symbol(name)}" * (len(names) == 1)
    shown = {one: style.symbol(one) for one in names}
    draw_curves(ax, run, shown, what, style.strokes(style.OTHERS))
    if run.units[name] == "rad":
        _overturning_angles(ax, run)
        style.legend_above(ax)


def _tilt(ax: Axes, run: Response) -> None:
    """Tilt of each body in space, and the least barrier, where that is in reach."""
    bodies = tilts_of(run.places.rotations())
    for (body, tilt), stroke in zip(bodies.items(), style.strokes(style.OTHERS), strict=False):
        name = "tilt" if len(bodies) == 1 else style.plain(body.replace("_", " "))
        label = f"{name}, largest {tilt.max():.3g} rad"
        ax.plot(run.t, tilt, label=label, **stroke)  # type: ignore[arg-type]
        style.mark_overturning(ax, run, tilt, color=stroke["color"])
    least = barrier_tilts(run.structure, next(iter(bodies)), AZIMUTHS).min()
    if least < ax.get_ylim()[1]:
        ax.axhline(least, color=style.INK, lw=0.8, ls="--", zorder=1, label="least barrier")
    ax.set_ylabel("tilt\n[rad]")
    style.legend_above(ax)


def _turns(run: Response) -> list[str]:
    """Angles of a structure in space that are neither its tilt nor a part of it."""
    m = run.structure.module
    angles = [n for n in run.states[: m.N_STATES // 2] if run.units[n] == "rad"]
    return [name for name in angles if name not in ("pitch", "roll", run.states[m.ROTATION])]


def _yaw(ax: Axes, run: Response) -> None:
    shown = {name: style.symbol(name) for name in _turns(run)}
    what = next(iter(shown)) if len(shown) == 1 else "turn"
    draw_curves(ax, run, shown, what, style.strokes(style.OTHERS))


def _others(run: Response, unit: str) -> list[str]:
    """Coordinates of a unit, without the one that overturns."""
    m = run.structure.module
    coordinates = run.states[: m.N_STATES // 2]
    return [n for n in coordinates if run.units[n] == unit and n != run.states[m.ROTATION]]


def _overturning_angles(ax: Axes, run: Response) -> None:
    """A scale of theta/alpha where one alpha is that of both sides; dashed lines within reach."""
    left, right = overturning_angles(run.structure, run.slope) or (np.nan, np.nan)
    if not np.isfinite(left + right):
        return
    low, high = ax.get_ylim()
    reached = [angle for angle in (-left, right) if low < angle < high]
    for angle in reached:
        name = "overturning angle" if run.slope else r"$\alpha$"
        label = name if angle == reached[0] else None
        ax.axhline(angle, color=style.INK, lw=0.8, ls="--", zorder=1, label=label)
    if np.isclose(left, right, rtol=1e-9):
        functions = (lambda y: y / left, lambda y: y * left)
        ax.secondary_yaxis("right", functions=functions).set_ylabel(r"$\theta/\alpha$ [-]")
        ax.spines["right"].set_visible(False)


def _displacement(ax: Axes, run: Response) -> None:
    """The load point, and every coordinate that is a length."""
    lengths = {n: style.symbol(n) if len(n) < 4 else n for n in _others(run, "m")}
    names = {"displacement": "load point", **lengths}
    draw_curves(ax, run, names, "displacement", style.strokes(style.OTHERS))


def _uplift(ax: Axes, run: Response) -> None:
    names = {
        f"{name}_uplift": name.replace("_", " ") + " foot" * (name in style.FEET)
        for name in style.contacts(run)
    }
    what = "uplift of feet" if len(names) == 2 else "uplift"
    draw_curves(ax, run, names, what, style.strokes(_OF_CONTACTS))


_OF_CONTACTS = (*style.FEET.values(), *style.OTHERS)


def _ties(ax: Axes, run: Response) -> None:
    """Forces of ties, with a cross where one breaks."""
    names = {f"{name}_force": name.replace("_", " ") for name in run.ties}
    draw_curves(ax, run, names, "force of ties", style.strokes(style.OTHERS))
    for line, tie in zip(ax.lines, run.ties.values(), strict=False):
        if tie.broke_at is not None:
            ax.plot(tie.broke_at, tie.largest_force, "x", color=str(line.get_color()), ms=6)


def _impacts(ax: Axes, run: Response) -> None:
    times, speeds = run.impacts.times, run.impacts.speeds
    ax.vlines(times, 0.0, speeds, color=style.INK, lw=0.9)
    ax.plot(times, speeds, ".", color=style.INK, ms=2.5, label=run.impacts.describe())
    ax.set_ylim(0.0, 1.08 * speeds.max() or 1.0)
    rate, unit = style.rate_of(run)
    points = run.impacts[0].kind == "landing"
    ax.set_ylabel("landing speed\n[m/s]" if points else f"impact speed\n$|{rate}|$ [{unit}]")
    style.legend_above(ax)


def _contacts(ax: Axes, run: Response) -> None:
    """A lane for each contact: a bar where it is closed, and a black one below where it slides."""
    contacts = style.contacts(run)
    for lane, (states, stroke) in enumerate(
        zip(contacts.values(), style.strokes(_OF_CONTACTS), strict=False)
    ):
        slides, idle = np.isin(states, (SLIP_LEFT, SLIP_RIGHT)), states == IDLE_POINT
        lane_of = [(states > 0, 0.1, stroke["color"]), (slides, 0.6, "k")]
        for spans, top, color in lane_of + [(idle, 0.1, "0.8")] * bool(idle.any()):
            bars = style.bars(style.spans_in(run, spans))
            ax.broken_barh(bars, (lane + top, 0.9 - top), facecolor=color, lw=0)
    names = [name.replace("_", " ") for name in contacts]
    ax.set_yticks(np.arange(len(names)) + 0.5, names, fontsize=7)
    ax.set_ylim(len(names), 0)
    ax.grid(visible=False)
    ax.set_ylabel("contact")
