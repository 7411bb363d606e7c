"""Ground motions against time, and their response spectra."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from rockeom.drawing import style
from rockeom.drawing.checks import check_drawn
from rockeom.motion.design.spectra import DesignSpectrum
from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.spectra import ResponseSpectrum
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.numbers.constants import STANDARD_GRAVITY

_POINTS = 4000
"""Times at which a motion is drawn, besides its breaks."""

_BY_NAME = 6
"""Number of spectra with names in the legend; more are one crowd, with their median."""


@style.styled
def plot_motion(
    motion: GroundMotion,
    *,
    figure: Figure | SubFigure | None = None,
    start: float = 0.0,
    end: float | None = None,
) -> Figure | SubFigure:
    """Draw acceleration [g], velocity [m/s] and displacement [m] of the ground on one time axis.

    Parameters
    ----------
    motion : GroundMotion
        Ground motion.
    figure : matplotlib.figure.Figure, optional
        Empty figure or subfigure to draw in; a new one if not given.
    start : float, optional
        Start of the time axis [s].
    end : float, optional
        End of the time axis [s]; that of the motion if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure. The largest value of each curve is that of the whole motion, within its segments
        too.

    Raises
    ------
    TypeError
        For anything but a ground motion.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> figure = plots.plot_motion(rk.GroundMotion.ricker(4.0, 0.6))  # m/s2, s
    """
    check_drawn("motion", motion, GroundMotion)
    figure = figure or style.new_figure(7.2, 4.6)
    axes = figure.subplots(3, 1, sharex=True)
    breaks = motion.breakpoints
    t = np.unique(np.concatenate([np.linspace(0.0, motion.duration, _POINTS), breaks]))
    # a jump is drawn as one: the last value before a break stands at it, too
    jumps = np.nextafter(breaks[1:], 0.0)
    both = np.sort(np.concatenate([t, jumps]))
    rows = (
        ("acceleration [g]", both, motion.acceleration(both) / STANDARD_GRAVITY,
         motion.peak / STANDARD_GRAVITY, "PGA {:.3g} g"),
        ("velocity [m/s]", t, motion.velocity(t), motion.peak_velocity, "PGV {:.3g} m/s"),
        ("displacement [m]", t, motion.displacement(t), motion.peak_displacement, "PGD {:.3g} m"),
    )  # fmt: skip
    for ax, (label, times, values, peak, said), color in zip(
        axes, rows, (style.INK, *style.LINES[:2]), strict=True
    ):
        ax.plot(times, values, color=color, lw=0.8, label=said.format(peak))
        ax.set_ylabel(label)
        style.legend_above(ax)
    axes[-1].set(xlabel="time [s]", xlim=(start, motion.duration if end is None else end))
    figure.align_ylabels(axes)
    figure.suptitle(style.wrapped(style.plain(motion.name) or "Ground motion"), fontsize=9.5)
    return figure


@style.styled
def plot_spectra(
    spectra: Sequence[ResponseSpectrum],
    *,
    figure: Figure | SubFigure | None = None,
    title: str | None = None,
    target: DesignSpectrum | None = None,
) -> Figure | SubFigure:
    """Draw pseudo-acceleration [g], relative velocity [m/s] and displacement [m] over the period
    [s].

    Parameters
    ----------
    spectra : sequence of ResponseSpectrum
        Spectra of one damping ratio and the same periods, such as those of `MotionSet`. More than
        six are drawn by their median and the band between the 16th and the 84th percentile.
    figure : matplotlib.figure.Figure, optional
        Empty figure or subfigure to draw in; a new one if not given.
    title : str, optional
        Title above the figure.
    target : DesignSpectrum, optional
        Design spectrum to compare with, drawn where it is defined.

    Returns
    -------
    matplotlib.figure.Figure
        Figure.

    Raises
    ------
    ValueError
        For no spectra, and for spectra of several dampings or periods.
    """
    if not isinstance(spectra, Sequence):
        raise InputTypeError("spectra", spectra).give("a list, as [motion.response_spectrum()]")
    if not spectra:
        raise InputError("spectra").says("no spectra: give one or more")
    first = spectra[0]
    for one in spectra[1:]:
        same = np.array_equal(one.periods, first.periods)
        if not same or one.damping_ratio != first.damping_ratio:
            raise InputError("spectra").says(
                f"the spectra of {first.name!r} and {one.name!r} have other periods or damping: "
                "draw them in figures of their own"
            )
    rows = len(spectra) if 1 < len(spectra) <= _BY_NAME else 1
    figure = figure or style.new_figure(7.2, 2.8 + 0.18 * rows)
    axes = figure.subplots(1, 3, sharex=True)
    for ax, (of, scale, label) in zip(
        axes,
        (
            ("pseudo_acceleration", STANDARD_GRAVITY, "pseudo-acceleration [g]"),
            ("velocity", 1.0, "relative velocity [m/s]"),
            ("displacement", 1.0, "relative displacement [m]"),
        ),
        strict=True,
    ):
        values = np.array([getattr(one, of) for one in spectra]) / scale
        _draw(ax, first.periods, values, [style.plain(one.name) for one in spectra])
        if target is not None:
            _draw_target(ax, first.periods, target, of)
        ax.set(xscale="log", xlabel="period [s]", ylabel=label)
        ax.set_ylim(bottom=0.0)
    handles, labels = axes[0].get_legend_handles_labels()
    columns = 1 if rows > 1 else len(labels)
    figure.legend(handles, labels, loc="outside lower center", ncols=columns)
    damping = f"damping ratio {100 * first.damping_ratio:g} %"
    figure.suptitle(
        f"{style.wrapped(title or 'Elastic response spectra')}, {damping}", fontsize=9.5
    )
    return figure


def _draw_target(ax: Axes, periods: np.ndarray, target: DesignSpectrum, of: str) -> None:
    """A design spectrum as ordinates of one kind; it has no relative velocity."""
    t = periods[(periods >= target.shortest) & (periods <= target.longest)]
    powers = {"pseudo_acceleration": 1.0 / STANDARD_GRAVITY, "displacement": (t / (2 * np.pi)) ** 2}
    if of in powers:
        name = style.plain(target.name)
        ax.plot(t, powers[of] * target(t), "--", color=style.INK, lw=1.4, label=name, zorder=4)


def _draw(ax: Axes, periods: np.ndarray, values: np.ndarray, names: Sequence[str]) -> None:
    """Lines of a few spectra (m, n); of many the crowd, its median and its band."""
    if len(values) <= _BY_NAME:
        for one, name, color in zip(values, names, style.LINES, strict=False):
            ax.plot(periods, one, color=color, label=name)
        return
    labels = [f"each of {len(values)}", *["_"] * (len(values) - 1)]
    ax.plot(periods, values.T, color="0.75", lw=0.4, label=labels)
    low, median, high = np.percentile(values, (16, 50, 84), axis=0)
    band = style.LINES[0]
    ax.fill_between(
        periods, low, high, color=band, alpha=0.25, lw=0, label="16 to 84 %", zorder=2.5
    )
    ax.plot(periods, median, color=band, lw=1.6, label="median")
