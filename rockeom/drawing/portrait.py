"""The response in the plane of rotation and rate."""

from collections.abc import Iterator, Sequence
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.drawing import style
from rockeom.drawing.checks import check_drawn
from rockeom.numbers.checks import InputError, require
from rockeom.simulation.response import Response
from rockeom.structures.base import Structure


@style.styled
def plot_phase_portrait(
    run: Response | Sequence[Response], *, separatrix: bool = False, ax: Axes | None = None
) -> Figure:
    """Draw the angular velocity against the rotation; impacts are the dotted jumps.

    Parameters
    ----------
    run : Response or sequence of Response
        A response, or several of one structure, each in another colour.
    separatrix : bool, optional
        Whether to draw the dashed lines on which the structure would reach the balance on each foot
        with no speed left, if nothing drove it and nothing were lost: motions inside come back,
        those outside fall. For structures with one coordinate that have a balance.
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    ValueError
        For no responses, and for the separatrix of a structure that has none.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> still = rk.GroundMotion.none(3.0)  # s
    >>> runs = [rk.simulate(block, still, initial={"theta": theta}) for theta in (0.05, 0.1)]  # rad
    >>> figure = plots.plot_phase_portrait(runs, separatrix=True)
    """
    runs = list(run) if isinstance(run, Sequence) else [run]
    require(bool(runs), "plot_phase_portrait", "runs", runs, "give one response at least")
    for one in runs:
        check_drawn("run", one, Response)
    first = runs[0]
    if ax is None:
        ax = style.new_figure(4.6, 3.8).add_subplot()
        ax.set_title(style.wrapped(style.plain(style.title_of(first)), 70), fontsize=9)
    if separatrix:
        for side in _separatrix(first.structure):
            ax.plot(*side, "--", color=style.INK, lw=0.9)
        ax.plot([], [], "--", color=style.INK, lw=0.9, label="separatrix")
    for one, colour in zip(runs, cycle([*style.OTHERS[:1], *style.LINES[:2], *style.OTHERS[1:]])):
        _draw(ax, one, colour)
    if ax.get_legend_handles_labels()[1]:
        ax.legend(loc="upper right" if separatrix else "best")
    p = first.structure.module
    if len(runs) == 1:
        start = first.y[0, p.ROTATION], first.y[0, p.ROTATION_RATE]
        ax.annotate("start", start, xytext=(4, 4), textcoords="offset points", fontsize=8)
    name = first.states[p.ROTATION]
    unit = "-" if style.is_dimensionless(first) else p.STATE_UNITS[p.ROTATION]
    ax.set_xlabel(f"{style.symbol(name)} [{unit}]")
    rate, unit = style.rate_of(first)
    ax.set_ylabel(f"${rate}$ [{unit}]")
    return style.parent_figure(ax)


def _draw(ax: Axes, run: Response, colour: str) -> None:
    p = run.structure.module
    y, dy = run.y[:, p.ROTATION], run.y[:, p.ROTATION_RATE]
    jumps = np.flatnonzero(np.diff(run.t) == 0) + 1
    for piece in np.split(np.column_stack([y, dy]), jumps):
        ax.plot(*piece.T, color=colour)
    for before, after in run.impacts.columns.states:
        ends = np.array([before, after])
        ax.plot(ends[:, p.ROTATION], ends[:, p.ROTATION_RATE], ":", color=style.OTHERS[1], lw=0.9)
    ax.plot(y[0], dy[0], "o", color=colour, ms=4)
    style.mark_overturning(ax, run, dy, y, colour)


_POINTS = 1000


def _separatrix(structure: Structure) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Rotations and rates (n,) with the energy of the balance, to each side.

    Source: the energies of the structure, kinetic and potential; the balance is where the potential
    is highest before the structure has fallen.
    """
    m = structure.module
    if m.N_STATES != 2:
        raise InputError("separatrix", True, "plot_phase_portrait").says(
            f"{structure.model} has {m.N_STATES} states, and its separatrix is no line in this "
            "plane: leave separatrix=True out"
        )
    name, rate = (m.STATES[i] for i in (m.ROTATION, m.ROTATION_RATE))

    def potential(rotation: np.ndarray) -> np.ndarray:
        energies = structure.energies({name: rotation})
        return energies["gravitational_energy"] + energies["elastic_energy"]

    for side in (1.0, -1.0):
        wide = side * structure.overturning_rotation * np.linspace(0.0, 1.0, _POINTS)[1:]
        top = int(potential(wide).argmax())
        if top in (0, len(wide) - 1):
            raise InputError("separatrix", True, "plot_phase_portrait").says(
                f"{structure.model} has no balance before it has fallen, and no separatrix: leave "
                "separatrix=True out"
            )
        near = np.linspace(wide[top - 1], wide[top + 1], _POINTS)
        balance = near[potential(near).argmax()]
        rotation = balance * np.linspace(1e-9, 1.0, _POINTS)
        held = potential(rotation)
        kinetic = structure.energies({name: rotation, rate: 1.0})["kinetic_energy"]
        speed = np.sqrt((held.max() - held) / kinetic)
        yield np.append(rotation, rotation[::-1]), np.append(speed, -speed[::-1])
