"""Several responses on one time axis."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.lines import Line2D

from rockeom.drawing import style
from rockeom.drawing.checks import check_drawn
from rockeom.numbers.checks import InputError, require_type
from rockeom.simulation.response import Response


@style.styled
def plot_comparison(
    runs: Sequence[Response],
    labels: Sequence[str] | None = None,
    *,
    figure: Figure | SubFigure | None = None,
    start: float | None = None,
    end: float | None = None,
    title: str | None = None,
) -> Figure | SubFigure:
    """Draw ground motion, displacement, uplift of each foot and impacts of several responses.

    Parameters
    ----------
    runs : sequence of Response
        Responses.
    labels : sequence of str, optional
        Name of each response; the structures' names if not given.
    figure : matplotlib.figure.Figure, optional
        Empty figure or subfigure to draw in; a new one if not given.
    start : float, optional
        Start of the time axis [s]; that of the responses if not given.
    end : float, optional
        End of the time axis [s]; that of the responses if not given.
    title : str, optional
        Title above the figure.

    Returns
    -------
    matplotlib.figure.Figure
        Figure. Curves of motions that overturned end with a cross.

    Raises
    ------
    ValueError
        For no runs, for another number of labels than of runs, and for structures with and without
        units in one figure.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> runs = [rk.simulate(block, pulse, impact=rk.EnergyRatio(r)) for r in (0.8, 0.95)]
    >>> figure = plots.plot_comparison(runs, ["r = 0.8", "r = 0.95"])
    """
    require_type("runs", runs, Sequence, "a list of responses")
    for i, run in enumerate(runs):
        check_drawn(f"runs[{i}]", run, Response)
    labels = [style.name_of(run) for run in runs] if labels is None else labels
    if not runs or len(labels) != len(runs):
        raise InputError("labels", labels).give(f"one for each of {len(runs)} runs")
    if len({style.is_dimensionless(run) for run in runs}) > 1:
        raise InputError("runs").says("some have units and some none: compare them apart")
    feet = ("left", "right") if any("left_uplift" in run.names for run in runs) else ()
    heights = [0.8, 1.6, *(0.9 for _ in feet), 0.1 + 0.28 * len(runs)]
    figure = figure or style.new_figure(7.2, 1.0 + 1.25 * sum(heights))
    axes = figure.subplots(len(heights), 1, sharex=True, gridspec_kw={"height_ratios": heights})
    _ground(axes[0], runs)
    _lengths(axes[1], runs, "displacement", "displacement of\nload point")
    for ax, foot in zip(axes[2:], feet, strict=False):
        _lengths(ax, runs, f"{foot}_uplift", f"uplift of\n{foot} foot")
    _impact_lanes(axes[-1], runs)
    axes[-1].set(
        xlabel=style.time_label(runs[0]),
        xlim=(
            0.0 if start is None else start,
            max(run.t[-1] for run in runs) if end is None else end,
        ),
    )
    figure.align_ylabels(axes)
    named = [f"{label}: {_end(run)}" for label, run in zip(labels, runs, strict=True)]
    figure.suptitle(style.wrapped(title or _title(runs)), fontsize=9.5)
    figure.legend(
        handles=[Line2D([], [], color=color, lw=2) for color in _colors(runs)],
        labels=named,
        loc="outside lower center",
        ncols=len(runs) if sum(map(len, named)) < 90 else 1,
    )
    return figure


def _end(run: Response) -> str:
    """The outcome; where it has not overturned, the largest theta/alpha."""
    if run.outcome == style.OVERTURNED or "rotation_ratio" not in run.names:
        return str(run.outcome)
    ratio = abs(run.extremes("rotation_ratio").peak)
    return f"{run.outcome}, largest $\\theta/\\alpha$ {ratio:.2f}" if ratio else str(run.outcome)


def _title(runs: Sequence[Response]) -> str:
    motions = dict.fromkeys(style.plain(run.motion.name) or "a ground motion" for run in runs)
    return f"Run to {'; '.join(motions)}"


def _colors(runs: Sequence[Response]) -> list[str]:
    return [style.LINES[i % len(style.LINES)] for i in range(len(runs))]


def _ground(ax: Axes, runs: Sequence[Response]) -> None:
    shared = all(run.motion == runs[0].motion for run in runs)
    for run, color in zip(runs, _colors(runs), strict=True):
        a = run["ground_acceleration"] / style.ground_scale(run)
        ax.plot(run.t, a, color=style.INK if shared else color, lw=0.7)
    ax.set_ylabel("ground\nacceleration [g]")


def _lengths(ax: Axes, runs: Sequence[Response], name: str, label: str) -> None:
    factor, unit = style.length_scale(runs[0])
    for run, color in zip(runs, _colors(runs), strict=True):
        if name in run.names:
            size = style.largest(run, name, factor, unit)
            ax.plot(run.t, run[name] * factor, color=color, label=size)
    for run, color in zip(runs, _colors(runs), strict=True):
        if name in run.names:
            style.mark_overturning(ax, run, run[name] * factor, color=color)
    ax.set_ylabel(f"{label} [{unit}]")
    style.legend_above(ax)


def _impact_lanes(ax: Axes, runs: Sequence[Response]) -> None:
    """A lane a run: impacts as high as their speed, and full contact as a grey band."""
    fastest = max(run.impacts.speeds.max(initial=0.0) for run in runs)
    for lane, (run, color) in enumerate(zip(runs, _colors(runs), strict=True)):
        floor = -float(lane)
        ax.broken_barh(style.bars(style.full_contact(run)), (floor, 0.8), facecolor="0.9", lw=0)
        times, speeds = run.impacts.times, run.impacts.speeds
        ax.vlines(times, floor, floor + 0.8 * speeds / (fastest or 1.0), color=color, lw=0.9)
    ax.set(ylim=(-len(runs) + 0.95, 0.9), yticks=[])
    ax.grid(visible=False, axis="y")
    ax.set_ylabel("impacts")
    counts, faster = (
        ", ".join(str(len(impacts)) for impacts in each)
        for each in ([run.impacts for run in runs], [run.impacts.above() for run in runs])
    )
    unit = style.rate_of(runs[0])[1]
    ax.set_title(
        f"{counts} impacts, {faster} of them faster than {runs[0].impacts.measurable:g} {unit}\n"
        f"as high as the angular velocity before them (up to {fastest:.3g} {unit}); "
        "grey: full contact",
        fontsize=8,
        loc="right",
        pad=3,
    )
