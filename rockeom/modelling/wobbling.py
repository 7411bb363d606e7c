"""`WobblingColumn` and `Podium`: round columns that roll on their rims."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.modelling.standing import check_tensor
from rockeom.motion.segments import C1, END, KIND, LINEAR, START, acceleration
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError
from rockeom.numbers.functions import checked, mathematics
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.positions import Solid, box, cylinder

PART_OF_PULSE = 0.1
"""Radians of a curved segment of the ground motion between the times at which it may push."""


class _RollingColumns(StructureWithFields):
    """Round columns on their rims; see `WobblingColumn` and `Podium`."""

    if TYPE_CHECKING:  # fields of both
        radius: float
        height: float
        mass: float

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module."""
        return module_of(self.model)

    @property
    def alpha(self) -> float:
        """Tilt at which the centroid is above the rim [rad]: it overturns beyond."""
        return mathematics.atan2(self.radius, self.parameters()["centroid_height"])

    @property
    def symmetry_angle(self) -> float:
        """Angle about the vertical after which it is as before [rad]: any does."""
        return 0.0

    @property
    def overturning_angles(self) -> tuple[float, float]:
        return self.alpha, self.alpha

    @functools.cached_property
    def solids(self) -> dict[str, Solid]:
        below, top = self.parameters()["centroid_height"], getattr(self, "top_radius", None)
        return {"column": cylinder(self.radius, self.height, top, below)}

    def parameters(self) -> dict[str, float]:
        b, top = self.radius, getattr(self, "top_radius", None)
        a = b if top is None else top
        # of a truncated cone, from the integrals of r^2, z r^2, z^2 r^2 and r^4, r linear in z
        area = a * a + a * b + b * b
        first = (3.0 * a * a + 2.0 * a * b + b * b) / (4.0 * area)
        second = (6.0 * a * a + 3.0 * a * b + b * b) / (10.0 * area)
        fourth = (a**4 + a**3 * b + a * a * b * b + a * b**3 + b**4) / area
        along = 0.3 * self.mass * fourth
        values = {
            "centroid_height": self.height * first,
            "inertia_xx": along / 2 + self.mass * self.height**2 * (second - first * first),
            "inertia_zz": along,
        }
        own = {name: getattr(self, name, None) for name in self.module.PARAMETERS}
        return values | {name: value for name, value in own.items() if value is not None}

    def started(self, y0: np.ndarray, named: Mapping[str, Any], ground: Any) -> np.ndarray:
        m = self.module
        leans = bool(y0[m.ROTATION] or y0[m.ROTATION_RATE])
        push = None if leans or "direction" in named else self._first_push(ground)
        if push is not None and push[1]:  # shaken along x alone it rocks in that plane, exactly
            y0[self.states.index("direction")] = math.atan2(-push[1], -push[0])
        return y0

    def _first_push(self, ground: Any) -> np.ndarray | None:
        """Accelerations (3,) of the ground as the column first lifts; None where it never does."""
        names = ("radius", "centroid_height", "gravity")
        try:  # where cases are handled as one, those whose ground or size differ are told apart
            tables = [np.asarray(table, dtype=float) for table in ground.tables]
            radius, height, gravity = (float(self.parameters()[name]) for name in names)
        except TypeError as error:
            raise InputError("direction").says(
                "the direction in which it first leans has no derivative, and follows no slider: "
                "name the initial direction, or start from a tilt"
            ) from error

        def shaking(t: np.ndarray) -> np.ndarray:
            return np.array([_at(table, t) for table in tables])

        def lifts(t: np.ndarray) -> np.ndarray:
            x, y, up = shaking(t)
            return np.hypot(x, y) * height - (gravity + up) * radius

        times = np.unique(np.concatenate([*map(_times_of_pushes, tables)]))
        pushed = np.flatnonzero(lifts(times) > 0.0)
        if not len(pushed):
            return None
        when = times[pushed[0]]
        if pushed[0] > 0:
            from scipy.optimize import brentq  # slow to import

            before = times[pushed[0] - 1]
            lifted = brentq(lambda t: lifts(np.array([t]))[0], before, when, xtol=1e-15)
            when = min(when, lifted * (1.0 + 1e-12))  # behind it, where the ground jumps
        return shaking(np.array([when]))[:, 0]


def _times_of_pushes(table: np.ndarray) -> np.ndarray:
    """Times (k,) at one of which a motion lifts the column, if it does.

    Along a straight line the margin is convex, and largest at an end.
    """
    curved = table[table[:, KIND] != LINEAR]
    within = [np.arange(row[START], row[END], PART_OF_PULSE / abs(row[C1])) for row in curved]
    ends = table[:, END]
    return np.concatenate([table[:, START], ends[np.isfinite(ends)], *within])


def _at(table: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Acceleration (n,) at times (n,) of the segments (m, 7) of a motion."""
    if not len(table):
        return np.zeros(len(t))
    rows = np.maximum(np.searchsorted(table[:, START], t, side="right") - 1, 0)
    return acceleration(table[rows], t - table[rows, START]) * (t <= table[-1, END])


class WobblingColumn(_RollingColumns):
    """Round column on its rim in space: it rocks, and rolls on its rim without twist.

    The states are `tilt` [rad], the angle of the axis from the vertical, `direction` [rad], the
    azimuth to which a positive tilt leans, counter-clockwise from x, and their rates. A negative
    tilt leans to the opposite side.

    Parameters
    ----------
    radius : float
        Radius of the round base [m].
    height : float
        Height of the column [m].
    mass : float
        Mass [kg].
    top_radius : float, optional
        Radius of the top of a truncated cone, zero for a cone [m]; that of the base if not given.
    centroid_height : float, optional
        Height of the centroid above the base [m]; that of a homogeneous cone if not given.
    inertia_xx : float, optional
        Moment of inertia about a diameter through the centroid [kg m2], of the same.
    inertia_zz : float, optional
        Moment of inertia about the axis [kg m2], of the same.
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For numbers out of their ranges, and moments that no masses have.

    Notes
    -----
    The model is the restricted one of Vassiliou et al. (2017): base and ground roll on one another
    without slip, and the twist about the axis stays zero. It loses no energy as it wobbles.

    Rocking in exactly one plane is a singular limit. There the base comes flat and strikes the
    ground with the opposite rim: by default an impact that conserves the angular momentum about
    that rim, as a planar block's does, or another impact law. With any precession, however small,
    it passes by flat without an impact, and the point of contact runs on by
    ``pi sqrt((I_1 + m H^2 + m b^2)/(I_1 + m H^2))``, more than half a turn (Srinivasan and Ruina
    2008): see `rockeom.analysis.formulas.turn_of_contact`. A column that comes nearer to flat than
    some 1e-12 rad strikes, and forces so near are those of no real one. The plane is unstable:
    under a single component along any direction but x, rounding soon makes it precess.

    From rest it leans away from the first push of the ground that lifts it. Where an impact has
    brought it to rest again, it keeps the diameter along which it rocked.

    Examples
    --------
    >>> import rockeom as rk
    >>> column = rk.WobblingColumn(radius=0.25, height=2.0, mass=1000.0)  # m, kg
    >>> run = rk.simulate(
    ...     column, rk.GroundMotion.none(2.0), initial={"tilt": 0.1, "direction_dot": 0.5}
    ... )  # rad, rad/s
    >>> len(run.impacts), run.outcome.value
    (0, 'completed')
    """

    model: ClassVar[str] = "wobbling_column"
    may_vanish = frozenset({"top_radius"})
    radius: float
    height: float
    mass: float
    top_radius: float | None = None
    centroid_height: float | None = None
    inertia_xx: float | None = None
    inertia_zz: float | None = None
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        values = self.parameters()
        across, along = values["inertia_xx"], values["inertia_zz"]
        moments = checked(np.array([across, across, along]))
        check_tensor("WobblingColumn", np.diag(moments))
        if checked(values["centroid_height"]) > checked(self.height):
            raise InputError("centroid_height", self.centroid_height, "WobblingColumn").give(
                f"a height above the base of at most its own, {self.height:g} m"
            )


class Podium(_RollingColumns):
    """Rigid slab on equal round columns that wobble alike, as a building on a podium of them.

    The columns touch the slab with the rim opposite the one on the ground, so that it moves by
    twice the way of a column's centroid and does not turn (Vassiliou 2018). The states are those of
    `WobblingColumn`, `tilt` and `direction` of each column.

    Parameters
    ----------
    columns : int
        Number of columns.
    slab_mass : float
        Mass of the slab [kg].
    radius : float
        Radius of a column [m].
    height : float
        Height of a column [m].
    mass : float
        Mass of a column [kg].
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For numbers out of their ranges, and a number of columns that is not whole.

    Notes
    -----
    See `WobblingColumn` for the model and for rocking in one plane, which is that of `RockingFrame`
    then.

    Examples
    --------
    >>> import rockeom as rk
    >>> podium = rk.Podium(columns=4, slab_mass=20.0, radius=0.25, height=2.0, mass=3.0)  # m, kg
    >>> round(podium.velocity_ratio, 4)  # of an impact in one plane
    0.8872
    """

    model: ClassVar[str] = "podium"
    may_vanish = frozenset({"slab_mass"})
    whole = frozenset({"columns"})
    columns: int
    slab_mass: float
    radius: float
    height: float
    mass: float
    gravity: float = STANDARD_GRAVITY

    @functools.cached_property
    def solids(self) -> dict[str, Solid]:
        side, thick = 6.0 * self.radius, 0.15 * self.height  # its sizes are not known
        return {"slab": box(side, side, thick, (0.0, 0.0, thick / 2)), **super().solids}
