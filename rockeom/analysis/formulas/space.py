"""Statics of bodies on feet in space, and steady motions of those on a round base.

    from rockeom.analysis import formulas

    corners = [(-0.3, -0.5), (0.3, -0.5), (0.3, 0.5), (-0.3, 0.5)]  # m, from the centroid
    formulas.overturning_tilt(np.radians([0, 45, 90]), corners, height=1.2)  # rad

Feet are places (n, 2) along x and y from the centroid, seen from above; azimuths are
counter-clockwise from x. A round base has tilts and centroid heights as `rockeom.WobblingColumn`
has them, whose `parameters()` have the names of the arguments.
"""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, numbers, positive, require

_NOT_FALLEN = "give a tilt between 0 and pi/2, in radians"


def base_reach(direction: ArrayLike, feet: ArrayLike):
    """Distance from below the centroid to the line on which a body that leans stands.

    Parameters
    ----------
    direction : array_like
        Azimuth to which it leans [rad].
    feet : array_like
        Places (n, 2) of three or more feet from the centroid, seen from above [m].

    Returns
    -------
    float or ndarray
        Distance w [m], in the shape of `direction`.

    Raises
    ------
    ValueError
        For feet on one line, or that do not support the centroid.

    Notes
    -----
    The line is normal to the direction, through the foot that is farthest that way: ``w = max (x_i
    cos d + y_i sin d)``, of a rectangle of 2 b by 2 c ``b |cos d| + c |sin d|``.

    Examples
    --------
    >>> from rockeom import analysis
    >>> corners = [(-0.3, -0.5), (0.3, -0.5), (0.3, 0.5), (-0.3, 0.5)]  # m
    >>> float(analysis.formulas.base_reach(0.0, corners))
    0.3
    """
    (azimuth,) = numbers("base_reach", direction=direction)
    ways = [x * np.cos(azimuth) + y * np.sin(azimuth) for x, y in _feet("base_reach", feet)]
    return np.max(ways, axis=0)


def overturning_tilt(direction: ArrayLike, feet: ArrayLike, height: ArrayLike):
    """Tilt at which a body on feet overturns: its stability surface, ``atan(w/h)``.

    Parameters
    ----------
    direction : array_like
        Azimuth to which it leans [rad].
    feet : array_like
        Places (n, 2) of three or more feet from the centroid, seen from above [m].
    height : array_like
        Height h of the centroid above the feet [m].

    Returns
    -------
    float or ndarray
        Tilt of its axis [rad], in the shape of direction and height, broadcast.

    Raises
    ------
    ValueError
        For a height that is not positive, and as `base_reach`.

    Notes
    -----
    The centroid is then above the line of `base_reach`, and highest of all tilts towards that
    azimuth. Between azimuths the least tilt is that over an edge, a saddle of the energy.
    """
    reach, (height,) = base_reach(direction, feet), positive("overturning_tilt", height=height)
    return np.arctan2(reach, height)


def overturning_barrier(
    direction: ArrayLike,
    feet: ArrayLike,
    height: ArrayLike,
    mass: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Energy that lifts a body on feet to the tilt at which it overturns.

    Parameters
    ----------
    direction : array_like
        Azimuth to which it leans [rad].
    feet : array_like
        Places (n, 2) of three or more feet from the centroid, seen from above [m].
    height : array_like
        Height h of the centroid above the feet [m].
    mass : array_like
        Mass m [kg].
    gravity : array_like, optional
        Acceleration of gravity g [m/s2].

    Returns
    -------
    float or ndarray
        Energy ``m g (sqrt(w**2 + h**2) - h)`` [J], with w of `base_reach`.

    Raises
    ------
    ValueError
        For numbers that are not positive, and as `base_reach`.
    """
    reach = base_reach(direction, feet)
    height, mass, gravity = positive(
        "overturning_barrier", height=height, mass=mass, gravity=gravity
    )
    return mass * gravity * reach**2 / (np.hypot(reach, height) + height)


def rocking_threshold(
    direction: ArrayLike,
    feet: ArrayLike,
    height: ArrayLike,
    vertical_acceleration: ArrayLike = 0.0,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Horizontal ground acceleration at which a body on feet starts to rock about an edge.

    Parameters
    ----------
    direction : array_like
        Azimuth of the acceleration [rad]; the body leans to the opposite one.
    feet : array_like
        Places (n, 2) of three or more feet from the centroid, seen from above [m].
    height : array_like
        Height h of the centroid above the feet [m].
    vertical_acceleration : array_like, optional
        Acceleration of the ground upwards at that time [m/s2].
    gravity : array_like, optional
        Acceleration of gravity g [m/s2].

    Returns
    -------
    float or ndarray
        Acceleration a [m/s2], zero where the ground falls away. The body slides first where the
        coefficient of friction is below ``a/(g + vertical_acceleration)``.

    Raises
    ------
    ValueError
        For numbers that are not positive, and as `base_reach`.

    Notes
    -----
    The resultant of the weight and of the inertia forces leaves the base: ``a = (g + a_z) min (d_k/
    (h cos p_k))`` over the edges at the distance d_k whose normal makes the angle p_k with the way
    to which it leans, of a rectangle ``(g + a_z) min (b/(h |cos d|), c/(h |sin d|))``.

    Examples
    --------
    >>> from rockeom import analysis
    >>> corners = [(-0.5, -0.7), (0.5, -0.7), (0.5, 0.7), (-0.5, 0.7)]  # m
    >>> a = analysis.formulas.rocking_threshold(0.0, corners, height=0.4, gravity=9.81)
    >>> round(float(a), 4)  # m/s2
    12.2625
    """
    where = "rocking_threshold"
    places = _feet(where, feet)
    height, gravity = positive(where, height=height, gravity=gravity)
    azimuth, up = numbers(where, direction=direction, vertical=vertical_acceleration)
    edges = _edges(where, places)
    towards = -(np.cos(azimuth)[..., None] * edges[:, 0] + np.sin(azimuth)[..., None] * edges[:, 1])
    with np.errstate(divide="ignore"):
        to_edge = np.where(towards > 0.0, -edges[:, 2] / towards, np.inf).min(axis=-1)
    return np.maximum(gravity + up, 0.0) * to_edge / height


def steady_precession(
    tilt: ArrayLike,
    mass: ArrayLike,
    radius: ArrayLike,
    centroid_height: ArrayLike,
    inertia_xx: ArrayLike,
    inertia_zz: ArrayLike,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Rate at which a body on a round rim wobbles steadily at one tilt, without twist.

    Parameters
    ----------
    tilt : array_like
        Tilt t of its axis [rad].
    mass : array_like
        Mass m [kg].
    radius : array_like
        Radius b of the rim [m].
    centroid_height : array_like
        Height H of the centroid above the base [m], zero of a thin disc.
    inertia_xx : array_like
        Moment of inertia I_1 about a diameter through the centroid [kg m2].
    inertia_zz : array_like
        Moment of inertia I_3 about the axis [kg m2].
    gravity : array_like, optional
        Acceleration of gravity g [m/s2].

    Returns
    -------
    float or ndarray
        Rate of the point of contact around the base [rad/s], NaN beyond the tilt at which the
        centroid is above the rim.

    Raises
    ------
    ValueError
        For a tilt that is not between 0 and pi/2, and numbers that are not positive.

    Notes
    -----
    Its square is ``2 m g (b cos t - H sin t)/M'(t)``, with the moment of inertia of the precession
    ``M = m (b (1 - cos t) + H sin t)**2 + I_1 sin(t)**2 + I_3 (1 - cos t)**2``. The motion is one
    of free rolling, too.

    References
    ----------
    Vassiliou, Burger, Egger, Bachmann, Broccardo and Stojadinovic (2017).

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom.analysis import formulas
    >>> column = rk.WobblingColumn(radius=0.25, height=2.0, mass=3.0, gravity=9.81)
    >>> round(float(formulas.steady_precession(0.1, **column.parameters())), 6)  # rad/s
    3.256232
    """
    where = "steady_precession"
    t = _tilt(where, tilt)
    mass, radius, inertia_xx, inertia_zz, gravity = positive(
        where, mass=mass, radius=radius, inertia_xx=inertia_xx, inertia_zz=inertia_zz,
        gravity=gravity,
    )  # fmt: skip
    height = _height(where, centroid_height)
    cos, sin, sagitta = np.cos(t), np.sin(t), 2.0 * np.sin(t / 2) ** 2
    way, slope = radius * sagitta + height * sin, radius * sin + height * cos
    inertia = 2.0 * (mass * way * slope + inertia_xx * sin * cos + inertia_zz * sagitta * sin)
    pushes = radius * cos - height * sin
    with np.errstate(invalid="ignore"):
        return np.sqrt(2.0 * mass * gravity * pushes / inertia)


def euler_disc_precession(
    tilt: ArrayLike, radius: ArrayLike, gravity: ArrayLike = STANDARD_GRAVITY
):
    """Rate of the point of contact of a thin disc that rolls steadily, its centre at rest.

    Parameters
    ----------
    tilt : array_like
        Tilt t of its axis [rad], which is the angle between disc and ground.
    radius : array_like
        Radius a [m].
    gravity : array_like, optional
        Acceleration of gravity g [m/s2].

    Returns
    -------
    float or ndarray
        Rate ``sqrt(4 g/(a sin t))`` [rad/s], which grows without bound as the disc settles.

    Raises
    ------
    ValueError
        For a tilt that is not between 0 and pi/2, and numbers that are not positive.

    References
    ----------
    Moffatt (2000).
    """
    where = "euler_disc_precession"
    radius, gravity = positive(where, radius=radius, gravity=gravity)
    return np.sqrt(4.0 * gravity / (radius * np.sin(_tilt(where, tilt))))


def turn_of_contact(
    mass: ArrayLike,
    radius: ArrayLike,
    centroid_height: ArrayLike,
    inertia_xx: ArrayLike,
    *,
    rolls: bool = True,
):
    """Angle by which the point of contact turns as a round body passes by flat.

    Parameters
    ----------
    mass : array_like
        Mass m [kg].
    radius : array_like
        Radius b of the rim [m].
    centroid_height : array_like
        Height H of the centroid above the base [m].
    inertia_xx : array_like
        Moment of inertia I_1 about a diameter through the centroid [kg m2].
    rolls : bool, optional
        Whether it rolls without slip; with False the rim is smooth.

    Returns
    -------
    float or ndarray
        Limit of the angle for a precession that vanishes [rad], more than half a turn.

    Raises
    ------
    ValueError
        For numbers that are not positive.

    Notes
    -----
    ``pi sqrt((I_1 + m H**2 + m b**2)/(I_1 + m H**2))``, and ``pi sqrt((I_1 + m b**2)/I_1)`` of a
    smooth rim, whatever the moment of inertia about the axis. A can that is pushed to rock seems to
    come back from another side each time.

    References
    ----------
    Srinivasan and Ruina (2008).

    Examples
    --------
    >>> import numpy as np
    >>> from rockeom.analysis import formulas
    >>> turn = formulas.turn_of_contact(1.0, 0.033, 0.06, 0.033**2 / 4 + 0.06**2 / 3)  # kg, m
    >>> round(float(np.degrees(turn)), 4)
    198.384
    """
    where = "turn_of_contact"
    mass, radius, across = positive(where, mass=mass, radius=radius, inertia_xx=inertia_xx)
    if rolls:
        across = across + mass * _height(where, centroid_height) ** 2
    return np.pi * np.sqrt(1.0 + mass * radius**2 / across)


def _tilt(where: str, tilt: ArrayLike) -> np.ndarray:
    (angle,) = numbers(where, tilt=tilt)
    require((angle > 0) & (angle < np.pi / 2), where, "tilt", angle, _NOT_FALLEN)
    return angle


def _height(where: str, centroid_height: ArrayLike) -> np.ndarray:
    (height,) = numbers(where, centroid_height=centroid_height)
    require(height >= 0.0, where, "centroid_height", height, "give the height above the base, in m")
    return height


def _feet(where: str, feet: ArrayLike) -> np.ndarray:
    """Places (n, 2) of feet; raises ValueError where they do not support the centroid."""
    (places,) = numbers(where, feet=feet)
    if places.ndim != 2 or places.shape[1] != 2 or len(places) < 3:
        raise InputError("feet", feet, where).give("places (n, 2) of three or more feet, in m")
    return places if (_edges(where, places)[:, 2] < 0.0).all() else _unsupported(where)


def _edges(where: str, places: np.ndarray) -> np.ndarray:
    """(k, 3) outward normal of each edge of the base, and less its distance from the centroid."""
    from scipy.spatial import ConvexHull, QhullError  # slow to import

    try:
        return ConvexHull(places).equations
    except QhullError:
        raise InputError("feet", of=where).wrong("are on one line: give one that is not") from None


def _unsupported(where: str) -> np.ndarray:
    raise InputError("feet", of=where).wrong(
        "have the centroid, their origin, beyond them: give places from below the centroid"
    )
