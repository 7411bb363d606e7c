"""`RollingCylinder`: a round body on the rim of its base in space, which rolls or slips freely."""

from __future__ import annotations

import functools
from typing import Any, ClassVar

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, number
from rockeom.numbers.functions import checked, mathematics
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.positions import Solid, cylinder


class RollingCylinder(StructureWithFields):
    """Cylinder in space that leans on the rim of its base, and rolls on it or slips freely.

    The states are the place x, y, z of the centroid relative to the ground [m], x and y the two
    horizontal directions and z upwards, its yaw, pitch and roll [rad], and their rates. `on_rim`
    gives them by the tilt. The point of contact is called `rim`.

    Parameters
    ----------
    radius : float
        Radius of the rim [m].
    height : float
        Height [m]; 0 for a thin disc.
    mass : float
        Mass [kg].
    friction : float, optional
        None for a rim that rolls without slip, or 0 for a smooth one.
    centroid_height : float, optional
        Height of the centroid above the rim [m]; half of the height if not given.
    inertia_across : float, optional
        Moment of inertia about a diameter through the centroid [kg m2]; that of a homogeneous
        cylinder if not given. With the other one it makes a frustum, a vase or any round body.
    inertia_along : float, optional
        The same about the axis of the body [kg m2].
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For numbers out of their ranges, and moments that no masses have.

    Notes
    -----
    Rolling, the velocity of the material at the point of contact is zero, a constraint that is not
    holonomic: the rim of a cylinder that wobbles comes to any place. A rim opens where it would
    pull, and an impact closes it without a rebound. Where its normal force vanishes and it still
    has to hold, it is released, as a corner of a `Prism` is: it slips freely until it opens.

    Lying flat, a base has no lowest point. With any precession it does not come to lie flat: it
    passes at a small tilt, while the point of contact turns by pi sqrt((I1 + m h^2 + m b^2)/(I1 +
    m h^2)), or on a smooth rim by pi sqrt((I1 + m b^2)/I1) (Srinivasan and Ruina 2008). A motion in
    a vertical plane ends there, with the outcome "out of bounds": pitch and roll of 1e-9 rad, with
    errors of 1e-12, do not say to a thousandth where the opposite rim would strike, and one point
    of contact has no mode in which the whole base bears, to which such impacts lead. Use a
    `WobblingColumn`, whose states are tilt and direction, to rock in a plane.

    Examples
    --------
    >>> import rockeom as rk
    >>> can = rk.RollingCylinder(radius=0.033, height=0.12, mass=0.35)  # m, kg
    >>> start = can.on_rim(0.15, precession=0.1)  # rad, rad/s
    >>> run = rk.simulate(can, rk.GroundMotion.none(0.3), initial=start)
    >>> run.outcome.value
    'completed'
    """

    model: ClassVar[str] = "rolling_cylinder"
    may_vanish = frozenset({"friction", "height", "centroid_height"})
    radius: float
    height: float
    mass: float
    friction: float | None = None
    centroid_height: float | None = None
    inertia_across: float | None = None
    inertia_along: float | None = None
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        if self.friction is not None and self.friction != 0:
            raise InputError("friction", self.friction, "RollingCylinder").give(
                "None, for a rim that rolls without slip, or 0, for a smooth one: a rim that slips "
                "with friction is not modelled"
            )
        values = {name: checked(x) for name, x in self.parameters().items()}
        across, along = values["inertia_across"], values["inertia_along"]
        if along > 2.0 * across * (1.0 + 1e-9):
            raise InputError("inertia_along", along, "RollingCylinder").wrong(
                f"is {along:.6g} kg m2, and no round body has more than twice its inertia_across, "
                f"{across:.6g} kg m2"
            )

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module of such a rim."""
        return module_of(self.model, **self.derivation)

    @property
    def derivation(self) -> dict[str, Any]:
        return {"rolls": "without slip" if self.friction is None else "freely"}

    def parameters(self) -> dict[str, float]:
        square = self.radius * self.radius
        values = {
            "centroid_height": self.height / 2,
            "inertia_across": self.mass * (3 * square + self.height * self.height) / 12,
            "inertia_along": self.mass * square / 2,
        }
        values |= {name: getattr(self, name) for name in values if getattr(self, name) is not None}
        return values | {name: getattr(self, name) for name in ("mass", "radius", "gravity")}

    @functools.cached_property
    def solids(self) -> dict[str, Solid]:
        height = self.parameters()["centroid_height"]
        return {"body": cylinder(self.radius, self.height, None, height)}

    def on_rim(
        self,
        tilt: float,
        *,
        direction: float = 0.0,
        tilt_rate: float = 0.0,
        precession: float = 0.0,
        spin: float | None = None,
        yaw: float = 0.0,
    ) -> dict[str, float]:
        """Initial state in which it leans on its rim, for `rk.simulate(..., initial=...)`.

        Places and their rates that are not in it follow: the rim touches, and rolls.

        Parameters
        ----------
        tilt : float
            Angle of the axis from the vertical [rad], above zero.
        direction : float, optional
            Azimuth to which it leans, and of the point of contact from the centre of the base,
            counter-clockwise from x [rad].
        tilt_rate : float, optional
            Rate of the tilt [rad/s].
        precession : float, optional
            Rate of the direction [rad/s].
        spin : float, optional
            Rate about its own axis relative to a body that turns with the direction [rad/s]; minus
            the precession, of which no twist results, if not given.
        yaw : float, optional
            Yaw [rad], which says how the body has turned about its own axis.

        Returns
        -------
        dict of str to float
            Yaw, pitch and roll [rad], and their rates [rad/s].

        Raises
        ------
        InputError
            For a tilt of zero, at which no point of the rim is the lowest, and beyond 80 degrees.

        Examples
        --------
        >>> import rockeom as rk
        >>> disc = rk.RollingCylinder(radius=0.04, height=0.0, mass=0.4)  # m, kg
        >>> start = disc.on_rim(0.1, direction=1.5)
        >>> {name: round(angle, 3) for name, angle in start.items() if "dot" not in name}
        {'yaw': 0.0, 'pitch': 0.007, 'roll': -0.1}
        """
        given = {"direction": direction, "tilt_rate": tilt_rate, "precession": precession}
        given |= {"yaw": yaw, "spin": -precession if spin is None else spin, "tilt": tilt}
        for name, value in given.items():
            number(name, value, "on_rim", "a number in rad or rad/s")
        if not 0.0 < tilt < _FALLEN:
            raise InputError("tilt", tilt, "on_rim").give(
                f"an angle above zero, where a point of the rim is the lowest, and below {_FALLEN}"
            )
        s, c = mathematics.sin(tilt), mathematics.cos(tilt)
        s_d, c_d = mathematics.sin(direction - yaw), mathematics.cos(direction - yaw)
        pitch, roll = mathematics.atan2(s * c_d, c), -mathematics.asin(s * s_d)
        # the angular velocity in axes that have turned by the yaw
        along_x = given["spin"] * s * c_d - tilt_rate * s_d
        along_y = given["spin"] * s * s_d + tilt_rate * c_d
        roll_rate = along_x / mathematics.cos(pitch)
        turning = precession + given["spin"] * c + roll_rate * mathematics.sin(pitch)
        angles = {"yaw": yaw, "pitch": pitch, "roll": roll}
        return angles | {"yaw_dot": turning, "pitch_dot": along_y, "roll_dot": roll_rate}


_FALLEN = 1.4
"""Tilt at which it has overturned, of its declaration [rad]."""
