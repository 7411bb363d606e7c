"""Bodies in space: frames that turn, and what is fixed in them.

Axes are x, the first horizontal one, y, the second one, and z upwards; azimuths are
counter-clockwise seen from above.

A column on its rim, two coordinates:

    from rockeom.symbolic import Model, coordinate, parameter, space

    tilt = coordinate("theta", "tilt", "rad", "tilt of the axis")
    direction = coordinate("psi", "direction", "rad", "azimuth of the point of contact")
    at = space.wobble(tilt.position, direction.position, radius=b.symbol)
    column = space.cylinder("column", m.symbol, b.symbol, 2 * H.symbol, at, (0, 0, H.symbol))
    Model(name="column", title="Column on its rim", parameters=(m, b, H, g),
          coordinates=(tilt, direction), bodies=[column], gravity=g.symbol, rotation=tilt,
          bounds={"flat": tilt.position})
"""

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic import valid
from rockeom.symbolic.contacts import Contact, Rigid
from rockeom.symbolic.model import Body, Coordinate, Point, Tilt

_ORIGIN = (sp.S.Zero, sp.S.Zero, sp.S.Zero)
_FLAT = sp.Rational(1, 10**9)


@dataclass(frozen=True)
class Frame:
    """Axes that move with a body.

    Parameters
    ----------
    rotation : sympy.Matrix
        Matrix (3, 3) that takes components along these axes to those along the axes of the ground.
    origin : tuple of (sympy.Expr, sympy.Expr, sympy.Expr)
        Place (x, y, z) of the origin.
    """

    rotation: sp.ImmutableMatrix
    origin: Point = _ORIGIN

    def __post_init__(self) -> None:
        valid.matrices("frame", rotation=self.rotation)
        valid.points("frame", axes=(3,), origin=self.origin)
        object.__setattr__(self, "rotation", sp.ImmutableMatrix(self.rotation))

    def at(self, point: Point) -> Point:
        """Place in the axes of the ground.

        Parameters
        ----------
        point : tuple of (sympy.Expr, sympy.Expr, sympy.Expr)
            Place in these axes.

        Returns
        -------
        tuple of (sympy.Expr, sympy.Expr, sympy.Expr)
            Place (x, y, z).
        """
        valid.points("frame", axes=(3,), point=tuple(point))
        return tuple(self.rotation * sp.Matrix(point) + sp.Matrix(self.origin))


def about(axis: str, angle: sp.Expr) -> sp.ImmutableMatrix:
    """Rotation about an axis of the ground, by the right-hand rule.

    Parameters
    ----------
    axis : str
        "x", "y" or "z".
    angle : sympy.Expr
        Angle.

    Returns
    -------
    sympy.Matrix
        Matrix (3, 3).
    """
    return _turned(axis, sp.cos(angle), sp.sin(angle))


def _turned(axis: str, cos: sp.Expr, sin: sp.Expr) -> sp.ImmutableMatrix:
    turned = {
        "x": [[1, 0, 0], [0, cos, -sin], [0, sin, cos]],
        "y": [[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]],
        "z": [[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]],
    }
    return sp.ImmutableMatrix(turned[axis])


@explained.calls()
def frame(yaw: sp.Expr, pitch: sp.Expr, roll: sp.Expr, origin: Point = _ORIGIN) -> Frame:
    """Frame by three angles, about x first, then about y, then about the vertical.

    Rz(yaw) Ry(pitch) Rx(roll) is regular for a structure that stands, whatever its yaw, and
    singular at a pitch of 90 degrees, where it lies.

    Parameters
    ----------
    yaw, pitch, roll : sympy.Expr
        Angles about z, y and x.
    origin : tuple of (sympy.Expr, sympy.Expr, sympy.Expr), optional
        Place (x, y, z) of the origin.

    Returns
    -------
    Frame
        Frame.
    """
    return Frame(about("z", yaw) * about("y", pitch) * about("x", roll), tuple(origin))


@explained.calls()
def wobble(tilt: sp.Expr, direction: sp.Expr, radius: sp.Expr) -> Frame:
    """Frame of a round base that rolls on its rim without twist.

    It leans by the tilt towards the azimuth of the point of contact, which runs along a circle of
    the same radius on the ground: base and ground roll on one another without slip. That the twist
    stays zero is a restriction of the model; the friction at a free rim gives it nearly (Vassiliou,
    Burger, Egger, Bachmann, Broccardo and Stojadinovic 2017).

    Parameters
    ----------
    tilt : sympy.Expr
        Angle of the axis from the vertical.
    direction : sympy.Expr
        Azimuth of the point of contact from the origin.
    radius : sympy.Expr
        Radius of the base.

    Returns
    -------
    Frame
        Frame in the centre of the base; for no tilt it is that of the ground.
    """
    # by half of the tilt: the inertia of the precession is of the order of its square, and of a
    # small angle 1 - cos has no digits
    cos, sin = sp.cos(tilt / 2), sp.sin(tilt / 2)
    tilted = _turned("y", 1 - 2 * sin**2, 2 * sin * cos)
    rotation = about("z", direction) * tilted * about("z", -direction)
    contact = radius * sp.Matrix([sp.cos(direction), sp.sin(direction), 0])
    return Frame(rotation, tuple(contact - rotation * contact))


@explained.calls()
def body(
    name: str, mass: sp.Expr, inertia: sp.Matrix, at: Frame, centroid: Point = _ORIGIN
) -> Body:
    """Rigid body in a frame.

    Parameters
    ----------
    name : str
        Name of the body.
    mass : sympy.Expr
        Mass.
    inertia : sympy.Matrix
        Inertia tensor (3, 3) about the centroid, along the axes of the frame.
    at : Frame
        Frame.
    centroid : tuple of (sympy.Expr, sympy.Expr, sympy.Expr), optional
        Place of the centroid in the frame.

    Returns
    -------
    Body
        Body.
    """
    return Body(name, mass, at.at(centroid), inertia, at.rotation)


@explained.calls()
def box(
    name: str, mass: sp.Expr, size: tuple[sp.Expr, sp.Expr, sp.Expr], at: Frame,
    centroid: Point = _ORIGIN,
) -> Body:  # fmt: skip
    """Homogeneous box whose edges lie along the axes of a frame.

    Parameters
    ----------
    name : str
        Name of the body.
    mass : sympy.Expr
        Mass.
    size : tuple of (sympy.Expr, sympy.Expr, sympy.Expr)
        Full lengths of the edges along x, y and z of the frame.
    at : Frame
        Frame.
    centroid : tuple of (sympy.Expr, sympy.Expr, sympy.Expr), optional
        Place of the centroid in the frame.

    Returns
    -------
    Body
        Body.
    """
    squares = sp.Matrix([mass * sp.sympify(length) ** 2 / 12 for length in size])
    return body(name, mass, sum(squares) * sp.eye(3) - sp.diag(*squares), at, centroid)


@explained.calls()
def cylinder(
    name: str, mass: sp.Expr, radius: sp.Expr, height: sp.Expr, at: Frame, centroid: Point = _ORIGIN
) -> Body:
    """Homogeneous cylinder whose axis lies along z of a frame.

    Parameters
    ----------
    name : str
        Name of the body.
    mass : sympy.Expr
        Mass.
    radius : sympy.Expr
        Radius.
    height : sympy.Expr
        Full height.
    at : Frame
        Frame.
    centroid : tuple of (sympy.Expr, sympy.Expr, sympy.Expr), optional
        Place of the centroid in the frame.

    Returns
    -------
    Body
        Body.
    """
    across = mass * (3 * sp.sympify(radius) ** 2 + sp.sympify(height) ** 2) / 12
    along = mass * sp.sympify(radius) ** 2 / 2
    return body(name, mass, sp.diag(across, across, along), at, centroid)


@explained.calls()
def feet(at: Frame, places: Mapping[str, Point], law: Rigid) -> tuple[Contact, ...]:
    """Points of a body that may touch level ground, z = 0.

    Parameters
    ----------
    at : Frame
        Frame of the body.
    places : dict of str to tuple of (sympy.Expr, sympy.Expr, sympy.Expr)
        Place of each point in the frame, by its name.
    law : Rigid
        Contact law of all.

    Returns
    -------
    tuple of Contact
        Points.

    Examples
    --------
    >>> from rockeom.symbolic import Rigid, space
    >>> frame = space.frame(0, 0, 0, origin=(0, 0, 1))
    >>> [c.gap for c in space.feet(frame, {"a": (1, 0, -1), "b": (0, 1, -1)}, Rigid(friction=0))]
    [0, 0]
    """
    contacts = []
    for name, place in places.items():
        x, y, z = at.at(tuple(place))
        contacts.append(Contact(name, z, (x, y), law))
    return tuple(contacts)


@explained.calls()
def rim(
    at: Frame, radius: sp.Expr, law: Rigid, centre: Point = _ORIGIN, name: str = "rim"
) -> Contact:
    """Rim of a round base, whose lowest point may touch level ground, z = 0.

    Without friction it slips freely; else it rolls without slip: the velocity of the material at
    the lowest point is zero, which integrates to no function of the coordinates. Lying flat, it has
    no lowest point: see `flat`.

    Parameters
    ----------
    at : Frame
        Frame of the body, z along its axis.
    radius : sympy.Expr
        Radius of the rim.
    law : Rigid
        Contact law, with friction=None or friction=0.
    centre : tuple of (sympy.Expr, sympy.Expr, sympy.Expr), optional
        Place of the rim's centre in the frame.
    name : str, optional
        Name of the contact.

    Returns
    -------
    Contact
        Lowest point.

    Examples
    --------
    >>> import sympy as sp
    >>> from rockeom.symbolic import Rigid, space
    >>> height, pitch, b = sp.symbols("z theta b")
    >>> space.rim(space.frame(0, pitch, 0, origin=(0, 0, height)), b, Rigid()).gap
    -b*sqrt(sin(theta)**2) + z
    """
    valid.expressions("rim", radius=radius)
    middle = at.at(tuple(centre))
    places = {axis: sp.Symbol(rf"\chi_{{{name} {axis}}}", real=True) for axis in "xy"}
    sine, values = _sine_of_tilt(at), {}
    for i, place in enumerate(places.values()):
        values[place] = centre[i] - radius * at.rotation[2, i] / sine
    x, y, _ = at.at((*places.values(), centre[2]))
    return Contact(name, middle[2] - radius * sine, (x, y), law, material=values)


def _sine_of_tilt(at: Frame) -> sp.Expr:
    """Sine of the angle of z of a frame from the vertical, with all digits where it is small."""
    return sp.sqrt(at.rotation[2, 0] ** 2 + at.rotation[2, 1] ** 2)


@explained.calls()
def flat(at: Frame, least: sp.Expr = _FLAT) -> dict[str, sp.Expr]:
    """Bound at which a round base lies flat, where no point of its rim is the lowest.

    Only a motion in a plane comes to it: after it the opposite point would strike. With any
    precession a rim passes flat without an impact, at a least tilt in proportion to it.

    Parameters
    ----------
    at : Frame
        Frame of the body, z along its axis.
    least : sympy.Expr, optional
        Sine of the tilt that counts as none.

    Returns
    -------
    dict of str to sympy.Expr
        What `bounds` of a model takes.
    """
    return {"flat": _sine_of_tilt(at) - least}


@explained.calls()
def tilt(at: Frame, angle: sp.Expr, name: str = "tilt") -> dict[Coordinate | Tilt, sp.Expr]:
    """Overturning of a body by the angle of its axis, z of its frame, from the vertical.

    Parameters
    ----------
    at : Frame
        Frame of the body.
    angle : sympy.Expr
        Angle at which it has overturned, below a quarter turn.
    name : str, optional
        Name, by which the event has it.

    Returns
    -------
    dict of Tilt to sympy.Expr
        What `falls` of a model takes.
    """
    return {Tilt(name, at.rotation[2, 2]): sp.sympify(angle)}
