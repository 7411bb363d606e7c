"""A sketch of a structure, to scale: what its declaration says of places, outlines and members."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.drawing import free_body, style
from rockeom.drawing.checks import check_drawn
from rockeom.drawing.scene import VIEW, Scene
from rockeom.integrator.schema import in_space
from rockeom.motion.slope import slope_angle
from rockeom.numbers.checks import InputError, number
from rockeom.structures.base import Structure
from rockeom.structures.positions import NO_FEET, Member, legs, places, positions_of, rotations_of


@style.styled
def draw_structure(
    structure: Structure,
    *,
    state: Mapping[str, float] | None = None,
    rotation: float = 0.0,
    ax: Axes | None = None,
    slope: float | str = 0.0,
    view: Sequence[float] = VIEW,
) -> Figure:
    """Draw the bodies, the feet and the ground of a structure, in any state.

    Parameters
    ----------
    structure : Structure
        Structure.
    state : dict of str to float, optional
        Values of coordinates by name, such as ``{"theta": 0.1, "u": 0.02}`` [rad, m]; those that
        are not named are zero.
    rotation : float, optional
        Value of the coordinate that overturns, alone [rad, or its unit].
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; a new figure if not given.
    slope : float or str, optional
        Slope of the ground, a number [rad] or a text such as "5 deg".
    view : tuple of (float, float), optional
        Azimuth from which a structure in space is seen, counter-clockwise from x seen from above,
        and elevation [rad].

    Returns
    -------
    matplotlib.figure.Figure
        Figure of the axes.

    Raises
    ------
    ValueError
        For a state that cannot be, a slope of a structure in space, and a view from below.
    TypeError
        For anything but a structure.

    Notes
    -----
    Bodies, contacts and members are drawn as they are declared: a body without an outline as a
    mass, and whatever joins bodies where the declaration has `members`. A tie that is slack is
    dashed, one that has broken has a gap; an arrow shows a push while it acts, a diamond its place.

    A structure in space is drawn in parallel projection, with its shadow straight below on the
    ground. Its feet are orange where they bear, pink where they slide with friction, white where
    they touch and bear nothing, grey and small where they are open, and pale behind a body. A body
    of no known shape is drawn as the plate between its feet and the legs from there to its
    centroid.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> figure = plots.draw_structure(block, state={"theta": 0.1})  # rad
    """
    check_drawn("structure", structure, Structure)
    m = structure.module
    named = {m.STATES[m.ROTATION]: rotation} if rotation else {}
    y = _state(structure, named | dict(state or {}))
    mode, spatial = structure.mode_number(y), in_space(m)
    drawing = Scene(structure, y, mode, view) if spatial else Sketch(structure, y, mode)
    ax = ax or style.new_figure(2.6, 3.4).add_subplot()
    drawing.draw(ax, number("slope", slope_angle(slope)))
    ax.set_aspect("equal", adjustable="datalim")
    ax.axis("off")
    return style.parent_figure(ax)


def _state(structure: Structure, named: Mapping[str, float]) -> np.ndarray:
    """The state of named values; of none, for a round base that cannot lie flat, one that leans."""
    try:
        return structure.state(named)
    except InputError:
        if named:
            raise
        return structure.state({structure.states[structure.module.ROTATION]: _LEANS})


_LEANS = 0.1
_BLUE = style.LINES[0]
_MOST_COPIES = 40  # of a body that are drawn
_MASS = 11.0  # size of a mass without an outline [points]
_SPRUNG = ("spring", "spring_and_damper")
_BENDING = ("column", "cantilever")
_WALLS = {"wall_on_the_left": -1.0, "wall_on_the_right": 1.0}


class _Pose(NamedTuple):
    """Places of bodies and points in a state, by name, and how far the bodies have turned."""

    places: dict[str, np.ndarray]
    angles: dict[str, float]

    def at(self, name: str, points: np.ndarray) -> np.ndarray:
        """(n, 2) where points of a body are, or of the ground."""
        if name not in self.places:
            return points
        return free_body.turned(points, (0.0, 0.0), self.angles.get(name, 0.0)) + self.places[name]

    def ends(self, member: Member) -> tuple[np.ndarray, np.ndarray]:
        """Both ends (2,) of a member."""
        start = self.at(member.start, member.start_at[None])
        return start[0], self.at(member.end, member.end_at[None])[0]

    def along(self, name: str, way: np.ndarray) -> np.ndarray:
        """(2,) a direction that turns with a body."""
        return free_body.turned([way], (0.0, 0.0), self.angles.get(name, 0.0))[0]


class Sketch:
    """A drawing of a structure in a state (N,) and the mode of that number.

    size : of the structure at rest, in proportion to which springs and hatches are drawn.
    copies : where each of a body that stands for several is drawn, next to its place.
    supports : places along the ground, and its level there.
    """

    def __init__(self, structure: Structure, y: np.ndarray, mode: int) -> None:
        m = structure.module
        self.shapes, self.names = structure.shapes, m.POSITIONS
        self.kinds = dict(zip(m.POSITIONS, m.POSITION_KINDS, strict=True))
        self.pushes = [n for n, kind in self.kinds.items() if kind == "push"]
        self.feet = [n for n, kind in self.kinds.items() if kind not in NO_FEET]
        upright = structure.state({})
        self.now, self.legs = _pose(structure, mode, y), legs(structure, mode, y)
        self.rest = _pose(structure, structure.mode_number(upright), upright)
        self.gaps, self.forces = _gaps(structure, mode, y), _forces(structure, mode, y)
        self.broken = {name for name, value in zip(m.STATES, y, strict=True) if value}
        drawn = [self.rest.at(name, outline) for name, outline in self.shapes.outlines.items()]
        self.extent = np.vstack([*self.rest.places.values(), *drawn])
        self.size = float(np.ptp(self.extent, axis=0).max()) or 1.0
        self.copies = {
            name: apart * (number - 1) / 2 * np.linspace(-1.0, 1.0, min(number, _MOST_COPIES))
            for name, (number, apart) in self.shapes.copies.items()
        }
        self.supports: list[tuple[float, float]] = []

    @property
    def closed_feet(self) -> list[str]:
        """Feet without a gap below them, on rigid ground or on another body."""
        return [
            name
            for name in self.feet
            if self.kinds[name] not in _SPRUNG and abs(self.gaps.get(name, 1.0)) <= 1e-9 * self.size
        ]

    def feet_at(self, name: str) -> np.ndarray:
        """(k, 2) where a foot is, and those of the copies of its body."""
        shifts = next(iter(self.copies.values()), np.zeros(1))
        return self.now.places[name] + np.column_stack([shifts, np.zeros(len(shifts))])

    def draw(self, ax: Axes, slope: float = 0.0) -> None:
        """Draw it; slope : of the ground [rad]."""
        others = {*ax.get_children()}
        for member in self.shapes.members:
            self._member(ax, member)
        for name in self.now.angles:
            for shift in self.copies.get(name, np.zeros(1)):
                self._body(ax, name, np.array([shift, 0.0]))
        for name in self.feet:
            for at in self.feet_at(name):
                self._foot(ax, name, at)
        for name in self.pushes:
            self._push(ax, name)
        self._ground(ax)
        if slope:
            free_body.tilt(ax, slope, [x for x in ax.get_children() if x not in others])
            ax.relim()
            ax.autoscale_view()

    # -- bodies

    def _body(self, ax: Axes, name: str, shift: np.ndarray) -> None:
        centre = self.now.places[name] + shift
        if name not in self.shapes.outlines:
            for body, foot in self.legs:
                if self.names[body] == name:
                    ends = [centre, self.now.places[self.names[foot]] + shift]
                    ax.plot(*np.transpose(ends), color=_BLUE, lw=1.2)
            free_body.mass(ax, centre, style.plain(name), (_MASS / 2, 3 + _MASS / 2), _MASS)
            return
        corners = self.now.at(name, self.shapes.outlines[name]) + shift
        if np.ptp(self.shapes.outlines[name], axis=0).min() == 0.0:  # flat
            ax.plot(*corners.T, color=_BLUE, lw=3.0, solid_capstyle="butt")
        else:
            free_body.body(ax, corners)
        if self.kinds[name] != "massless":
            free_body.mass(ax, centre, size=6.0)

    # -- feet

    def _foot(self, ax: Axes, name: str, at: np.ndarray) -> None:
        """A foot, what carries it, and where the ground is under it."""
        kind, (x, y) = self.kinds[name], at
        if kind in _SPRUNG:
            self._sprung(ax, x, min(y, 0.0), damped=kind != "spring")
        elif kind in _WALLS:
            out, half = _WALLS[kind], 0.2 * self.size
            behind = x + out * self.gaps[name]
            free_body.wall(ax, min(y - half, 0.0), y + half, behind, 0.05 * out * self.size)
        elif kind == "foot":
            self.supports.append((x, y - self.gaps[name]))
        ax.plot(x, y, "o", color=style.INK, ms=4, zorder=4)

    def _sprung(self, ax: Axes, x: float, top: float, damped: bool) -> None:
        """A spring, and a damper next to it, as wide as there is room between feet."""
        sprung = [name for name in self.feet if self.kinds[name] in _SPRUNG]
        lowest = min(self.now.places[name][1] for name in sprung)
        low = min(-0.12 * self.size, lowest - 0.04 * self.size)
        feet = sorted(self.rest.places[name][0] for name in sprung)
        room = min((b - a for a, b in pairwise(feet)), default=self.size)
        width = min(0.04 * self.size, 0.25 * room)
        aside = 0.8 * width if damped else 0.0
        free_body.spring(ax, (x - aside, top), (x - aside, low), width)
        if damped:
            free_body.damper(ax, (x + aside, low), (x + aside, top), width)
            ax.plot([x - aside, x + aside], [top, top], color=style.INK, lw=1.0)
        self.supports.append((x, low))

    # -- what joins bodies

    def _member(self, ax: Axes, member: Member) -> None:
        start, end = self.now.ends(member)
        first, last = self.rest.ends(member)
        ends = (member.start, start, last - first), (member.end, end, first - last)
        for name, at, away in ends:
            if self.kinds.get(name, "end") == "end":  # of an element, or on the ground
                self._anchor(ax, member.kind, at, away)
        for shift in self.copies.get(member.start, np.zeros(1)):
            away = np.array([shift, 0.0])
            self._line(ax, member, start + away, end + away)

    def _anchor(self, ax: Axes, kind: str, at: np.ndarray, away: np.ndarray) -> None:
        """The ground or a wall, which holds the fixed end of a member."""
        if kind in _BENDING:
            self.supports.append((at[0], at[1]))
            ax.plot(*at, "s", color=style.INK, ms=4, zorder=4)
        elif abs(away[0]) > abs(away[1]) and (at[1] > 0.0 or kind == "spring"):
            half, behind = 0.12 * self.size, -0.05 * self.size * np.sign(away[0])
            free_body.wall(ax, at[1] - half, at[1] + half, at[0], behind)
            self.extent = np.vstack([self.extent, at])
        elif kind in ("tendon", "damper"):
            ax.plot(*at, "s", color=style.INK, mfc="white", ms=7, zorder=3)
            if at[1] == 0.0:
                self.supports.append((at[0], at[1]))

    def _line(self, ax: Axes, member: Member, start: np.ndarray, end: np.ndarray) -> None:
        if member.kind in _BENDING:
            ax.plot(*self._bent(member, start, end).T, color=_BLUE, lw=1.3, solid_capstyle="butt")
        elif member.kind == "spring":
            free_body.spring(ax, start, end, 0.05 * self.size)
        elif member.kind == "damper":
            free_body.damper(ax, start, end, 0.05 * self.size)
        elif member.kind == "wall":
            depth = 0.05 * self.size * np.sign(start[1] - end[1])
            free_body.wall(ax, start[1], end[1], start[0], depth)
        elif member.start in self.forces:
            self._tie(ax, member.start, start, end)
        else:
            color, width = (_BLUE, 4.0) if member.kind == "rod" else (style.INK, 1.6)
            ax.plot(*np.transpose([start, end]), color=color, lw=width, solid_capstyle="butt")

    def _tie(self, ax: Axes, name: str, start: np.ndarray, end: np.ndarray) -> None:
        """A line where it pulls, a dashed one where it is slack, one with a gap once it broke."""
        broken, tight = f"{name}_broken" in self.broken, self.forces[name] > 0.0
        line, width = ("-" if tight or broken else (0, (4, 3))), 1.6 if tight else 0.9
        stub = 0.4 * (end - start)
        of_broken = (start, start + stub), (end - stub, end)
        for ends in of_broken if broken else ((start, end),):
            ax.plot(*np.transpose(ends), color=style.INK, lw=width, ls=line)
        ax.plot(*start, "o", color=style.INK, ms=3, zorder=4)

    def _push(self, ax: Axes, name: str) -> None:
        """An arrow that ends where a push acts, while it does; else its place."""
        at, force = self.now.places[name], self.forces[name]
        ax.plot(*at, "D", color=free_body.FORCE, mfc="white", ms=4, zorder=4)
        if force:
            free_body.arrow(ax, at - [0.25 * self.size * np.sign(force), 0.0], at)

    def _bent(self, member: Member, start: np.ndarray, end: np.ndarray) -> np.ndarray:
        """(n, 2) a beam whose ends turn with the bodies at which they are, or whose end is free."""
        first, last = self.rest.ends(member)
        way = last - first
        leaving, arriving = (self.now.along(name, way) for name in (member.start, member.end))
        if member.kind == "cantilever":
            arriving = (3 * (end - start) - leaving) / 2
        z = np.linspace(0.0, 1.0, 40)[:, None]
        return (
            (1 + 2 * z) * (1 - z) ** 2 * start + z * (1 - z) ** 2 * leaving
            + z**2 * (3 - 2 * z) * end + z**2 * (z - 1) * arriving
        )  # fmt: skip

    # -- the ground

    def _ground(self, ax: Axes) -> None:
        """The ground under all feet, level between those of one height, and a way beyond them."""
        if not self.supports:
            ends = self.extent[:, 0].min(), self.extent[:, 0].max()
            self.supports = [(x, 0.0) for x in ends]
        feet = sorted(self.supports)
        beyond = max(0.45 * (feet[-1][0] - feet[0][0]), 0.2 * self.size)
        left, depth = feet[0][0] - beyond, 0.05 * self.size
        for (x, level), (after, next_level) in pairwise(feet):
            if abs(next_level - level) > 1e-9 * self.size:
                middle = (x + after) / 2
                free_body.ground(ax, left, middle, level, depth)
                ax.plot([middle, middle], [level, next_level], color=style.INK, lw=1.2)
                left = middle
        free_body.ground(ax, left, feet[-1][0] + beyond, feet[-1][1], depth)


def all_points(structure: Structure, poses: np.ndarray) -> np.ndarray:
    """(n, k, 2) places and corners of bodies and feet, of what `places` has found (n, m, 3)."""
    m, shapes = structure.module, structure.shapes
    at, angles = positions_of(m, poses), rotations_of(m, poses)
    points = [poses[..., :2]]
    for name, angle in angles.items():
        x, y = shapes.outlines.get(name, np.zeros((1, 2))).T
        cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
        corners = np.stack([x * cos + y * sin, y * cos - x * sin], axis=-1) + at[name][:, None]
        number, apart = shapes.copies.get(name, (1, 0.0))
        reach = np.array([apart * (number - 1) / 2, 0.0])
        points += [corners - reach, corners + reach]
    return np.concatenate(points, axis=1)


def _pose(structure: Structure, mode: int, y: np.ndarray) -> _Pose:
    m = structure.module
    (pose,) = places(m, np.array([mode]), y[None], structure.vector)
    angles = {name: float(angle) for name, angle in rotations_of(m, pose).items()}
    return _Pose(positions_of(m, pose), angles)


def _forces(structure: Structure, mode: int, y: np.ndarray) -> dict[str, float]:
    """Forces of elements, by name [N]."""
    m = structure.module
    values = np.zeros(4 * len(m.ELEMENT_NAMES))
    m.elements(mode, y, structure.vector, values)
    return dict(zip(m.ELEMENT_NAMES, values[1::4].tolist(), strict=True))


def _gaps(structure: Structure, mode: int, y: np.ndarray) -> dict[str, float]:
    """Distances of feet from what they touch, by name [m]."""
    m = structure.module
    values = np.zeros(len(m.KINEMATICS))
    m.kinematics(mode, y, structure.vector, values)
    told = dict(zip(m.KINEMATICS, values.tolist(), strict=True))
    return {name: told[f"{name}_uplift"] for name in m.POSITIONS if f"{name}_uplift" in told}
