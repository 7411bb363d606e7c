"""Records of a declaration: parameters, coordinates, bodies, feet, and what a sketch shows.

All of it is data: `rockeom.symbolic.lagrange` derives equations of motion from bodies whose
positions are functions of coordinates.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from rockeom.numbers import explained
from rockeom.numbers.checks import require_word
from rockeom.symbolic import valid

Point = tuple[sp.Expr, ...]
"""A place (x, y) in the plane, y upwards; (x, y, z) in space, z upwards."""
Outline = tuple[Point, ...]

GROUND_ACCELERATIONS = GROUND_X, GROUND_Y, _ = sp.symbols("a_x a_y a_z", real=True)
"""Accelerations of the ground [m/s2] along the axes of a place, the last of which is vertical."""


@explained.record()
@dataclass(frozen=True)
class Parameter:
    """Constant of a structure. It has no default: physics is never assumed silently.

    Parameters
    ----------
    symbol : sympy.Symbol
        Symbol in the equations.
    name : str
        Name of the argument.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.
    """

    symbol: sp.Symbol
    name: str
    unit: str
    meaning: str

    def __post_init__(self) -> None:
        what = f"parameter {self.name!r}"
        valid.symbols(what, symbol=self.symbol)
        valid.texts(what, unit=self.unit, meaning=self.meaning)


@dataclass(frozen=True)
class Definition:
    """Constant that follows from the parameters; equations are written with its symbol.

    Parameters
    ----------
    symbol : sympy.Symbol
        Symbol.
    name : str
        Name.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.
    value : sympy.Expr
        Expression of the parameters.
    """

    symbol: sp.Symbol
    name: str
    unit: str
    meaning: str
    value: sp.Expr

    def __post_init__(self) -> None:
        what = f"definition {self.name!r}"
        valid.symbols(what, symbol=self.symbol)
        valid.texts(what, name=self.name, unit=self.unit, meaning=self.meaning)
        valid.expressions(what, value=self.value)


@dataclass(frozen=True)
class NamedFunction:
    """Function of the coordinates that equations name instead of writing it out.

    Parameters
    ----------
    symbol : sympy.Expr
        Function such as b(theta), whose derivatives are then those of `value`; or a plain symbol,
        which is a constant for Lagrange's equations.
    name : str
        Name.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.
    value : sympy.Expr
        Expression, which may contain the side, the parameters, and named functions that stand
        before it.
    """

    symbol: sp.Expr
    name: str
    unit: str
    meaning: str
    value: sp.Expr

    def __post_init__(self) -> None:
        what = f"function {self.name!r}"
        valid.expressions(what, symbol=self.symbol, value=self.value)
        valid.texts(what, name=self.name, unit=self.unit, meaning=self.meaning)
        valid.laws(what, symbol=self.symbol)


@explained.record()
@dataclass(frozen=True)
class Coordinate:
    """Generalised coordinate with its velocity and acceleration symbols.

    Parameters
    ----------
    position : sympy.Symbol
        Symbol of the position.
    velocity : sympy.Symbol
        Symbol of the velocity.
    acceleration : sympy.Symbol
        Symbol of the acceleration.
    name : str
        Name of the state.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.
    """

    position: sp.Symbol
    velocity: sp.Symbol
    acceleration: sp.Symbol
    name: str
    unit: str
    meaning: str

    def __post_init__(self) -> None:
        what = f"coordinate {self.name!r}"
        valid.symbols(
            what, position=self.position, velocity=self.velocity, acceleration=self.acceleration
        )
        valid.texts(what, unit=self.unit, meaning=self.meaning)


@dataclass(frozen=True)
class InternalVariable:
    """State of first order, with no coordinate behind it: its rate is a function of the states.

    Such as the force of a Maxwell element, or the place between its spring and its damper.

    Parameters
    ----------
    symbol : sympy.Symbol
        Symbol.
    name : str
        Name of the state.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.
    """

    symbol: sp.Symbol
    name: str
    unit: str
    meaning: str

    def __post_init__(self) -> None:
        what = f"internal variable {self.name!r}"
        valid.symbols(what, symbol=self.symbol)
        valid.texts(what, unit=self.unit, meaning=self.meaning)

    @property
    def rate(self) -> sp.Symbol:
        """The symbol of its rate."""
        return sp.Symbol(rf"\dot{{{_tex(str(self.symbol))}}}", real=True)


@explained.record()
@dataclass(frozen=True)
class Body:
    """Rigid body.

    Parameters
    ----------
    name : str
        Name of the body, by which positions and sketches have it.
    mass : sympy.Expr
        Mass of the body.
    position : tuple of (sympy.Expr, sympy.Expr)
        Place (x, y) of the centroid; in space (x, y, z), see `rockeom.symbolic.space`.
    inertia : sympy.Expr, optional
        Moment of inertia about the centroid; in space the tensor (3, 3) in axes of the body.
    rotation : sympy.Expr, optional
        Angle through which the body turns, clockwise; in space the matrix (3, 3) that takes axes of
        the body to those of the ground.
    polar : tuple of (sympy.Symbol, sympy.Symbol, sympy.Symbol, sympy.Symbol), optional
        Symbols (half_width, height, R, alpha): the radius R and the angle alpha replace the
        half-width and the body's height where equations are shown in the form R sin(alpha - s
        theta).
    outline : tuple of (sympy.Expr, sympy.Expr), optional
        Corners in a sketch, from the centroid in axes that turn with the body, see `rectangle`;
        none for a mass without a size.
    copies : sympy.Expr, optional
        Number of bodies where one represents several alike, side by side.
    apart : sympy.Expr, optional
        Distance of the copies in a sketch.

    Examples
    --------
    >>> import sympy as sp
    >>> from rockeom.symbolic import Body, rectangle, turned
    >>> m, b, h, theta = sp.symbols("m b h theta")
    >>> body = Body("block", m, turned((0, h), (b, 0), theta), m * (b**2 + h**2) / 3, theta,
    ...             outline=rectangle(b, h))
    """

    name: str
    mass: sp.Expr
    position: Point
    inertia: sp.Expr = sp.S.Zero
    rotation: sp.Expr = sp.S.Zero
    polar: tuple[sp.Symbol, sp.Symbol, sp.Symbol, sp.Symbol] | None = None
    outline: Outline = ()
    copies: sp.Expr = sp.S.One
    apart: sp.Expr = sp.S.Zero

    def __post_init__(self) -> None:
        what = f"body {self.name!r}"
        valid.texts(what, name=self.name)
        valid.points(what, axes=(2, 3), position=self.position)
        valid.expressions(what, mass=self.mass)
        valid.not_negative(what, mass=self.mass)
        if len(self.position) == 2:
            valid.expressions(what, inertia=self.inertia, rotation=self.rotation)
            valid.not_negative(what, inertia=self.inertia)
        else:
            self._in_space(what)
        valid.expressions(what, **{f"polar {x}": x for x in self.polar or ()})
        if isinstance(self.outline, list | tuple):
            object.__setattr__(self, "outline", tuple(self.outline))
        valid.corners(what, self.outline)
        valid.expressions(what, copies=self.copies, apart=self.apart)

    def _in_space(self, what: str) -> None:
        """Make matrices of the tensor and the orientation; a body without them is a point mass."""
        inertia = sp.zeros(3, 3) if self.inertia == 0 else self.inertia
        rotation = sp.eye(3) if self.rotation == 0 else self.rotation
        valid.matrices(what, inertia=inertia, rotation=rotation)
        for name, matrix in (("inertia", inertia), ("rotation", rotation)):
            object.__setattr__(self, name, sp.ImmutableMatrix(matrix))
        valid.symmetric(what, inertia=self.inertia)


@dataclass(frozen=True)
class Tilt:
    """Angle of a body's axis from the vertical, at some size of which it has overturned.

    Parameters
    ----------
    name : str
        Name, by which events have it.
    cosine : sympy.Expr
        Cosine of the angle.
    """

    name: str
    cosine: sp.Expr

    def __post_init__(self) -> None:
        valid.name("tilt", self.name)
        valid.expressions("tilt", cosine=self.cosine)


def shaking(bodies: Iterable[Body]) -> tuple[sp.Symbol, ...]:
    """The accelerations of the ground under some bodies: two in the plane, three in space."""
    return GROUND_ACCELERATIONS[: max((len(body.position) for body in bodies), default=2)]


GROUND = "ground"
"""The end of a member that does not end at a body."""

MEMBERS = ("column", "cantilever", "rod", "tendon", "spring", "damper", "wall")


@dataclass(frozen=True)
class Member:
    """Line of a sketch between two bodies; it enters no equation.

    Parameters
    ----------
    kind : str
        "column", which bends and whose ends turn with the bodies; "cantilever", the end of which
        turns freely; "rod", "tendon", "spring" or "damper", which are straight; "wall", a face
        that stands, from its foot to its top, the wall on its left.
    start : str
        Name of the body at the start, or "ground".
    end : str
        Name of the body at the end, or "ground".
    start_at : tuple of (sympy.Expr, sympy.Expr), optional
        Place on the first body, from the centre in axes that turn with it; on the ground from the
        origin.
    end_at : tuple of (sympy.Expr, sympy.Expr), optional
        Place on the second body.
    """

    kind: str
    start: str
    end: str
    start_at: Point = (sp.S.Zero, sp.S.Zero)
    end_at: Point = (sp.S.Zero, sp.S.Zero)

    def __post_init__(self) -> None:
        what = f"member from {self.start!r} to {self.end!r}"
        require_word("kind", self.kind, MEMBERS, what)
        valid.points(what, start_at=self.start_at, end_at=self.end_at)


@dataclass(frozen=True)
class Foot:
    """Point of the base that may touch the ground.

    Parameters
    ----------
    position : tuple of (sympy.Expr, sympy.Expr)
        Place (x, y).
    force : sympy.Expr, optional
        Vertical force of the ground on the foot where a spring or damper gives it; None where the
        ground is rigid and the force is a constraint's.
    sprung : bool, optional
        Whether a sketch shows a spring and a damper under it.
    """

    position: tuple[sp.Expr, sp.Expr]
    force: sp.Expr | None = None
    sprung: bool = False

    def __post_init__(self) -> None:
        valid.points("foot", position=self.position)
        if self.force is not None:
            valid.expressions("foot", force=self.force)


@explained.calls()
def coordinate(symbol: str, name: str, unit: str, meaning: str) -> Coordinate:
    """Coordinate; its velocity and acceleration are typeset with one and two dots.

    Parameters
    ----------
    symbol : str
        Letter of the equations, as LaTeX sets it.
    name : str
        Name of the state.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.

    Returns
    -------
    Coordinate
        Coordinate.
    """
    return Coordinate(
        sp.Symbol(symbol, real=True),
        sp.Symbol(rf"\dot{{{_tex(symbol)}}}", real=True),
        sp.Symbol(rf"\ddot{{{_tex(symbol)}}}", real=True),
        name,
        unit,
        meaning,
    )


@explained.calls()
def internal_variable(symbol: str, name: str, unit: str, meaning: str) -> InternalVariable:
    """Internal variable, of either sign.

    Parameters
    ----------
    symbol : str
        Letter of the equations, as LaTeX sets it.
    name : str
        Name of the state.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.

    Returns
    -------
    InternalVariable
        Internal variable.
    """
    return InternalVariable(sp.Symbol(symbol, real=True), name, unit, meaning)


@explained.calls()
def parameter(symbol: str, name: str, unit: str, meaning: str) -> Parameter:
    """Positive parameter.

    Parameters
    ----------
    symbol : str
        Letter of the equations, as LaTeX sets it.
    name : str
        Name of the argument.
    unit : str
        SI unit as a text, such as "kg m2"; "-" for a pure number.
    meaning : str
        Meaning in words, for tables and error messages.

    Returns
    -------
    Parameter
        Parameter.
    """
    return Parameter(sp.Symbol(symbol, positive=True), name, unit, meaning)


def _tex(symbol: str) -> str:
    return sp.latex(sp.Symbol(symbol))


@explained.calls()
def rectangle(half_width: sp.Expr, below: sp.Expr, above: sp.Expr | None = None) -> Outline:
    """Corners of a rectangle about a body's centre.

    Parameters
    ----------
    half_width : sympy.Expr
        Half of the width.
    below : sympy.Expr
        Distance that it reaches below the centre.
    above : sympy.Expr, optional
        Distance that it reaches above the centre; as far as below if not given.

    Returns
    -------
    tuple of (sympy.Expr, sympy.Expr)
        Corners.
    """
    low, high = -sp.sympify(below), sp.sympify(below if above is None else above)
    b = sp.sympify(half_width)
    return (-b, low), (b, low), (b, high), (-b, high)


@explained.calls()
def turned(point, about, angle) -> tuple[sp.Expr, sp.Expr]:
    """Point turned clockwise about another one.

    Parameters
    ----------
    point : tuple of (sympy.Expr, sympy.Expr)
        Point (x, y).
    about : tuple of (sympy.Expr, sympy.Expr)
        Pivot (x, y).
    angle : sympy.Expr
        Angle.

    Returns
    -------
    tuple of (sympy.Expr, sympy.Expr)
        Place (x, y).
    """
    point = tuple(point)
    valid.points("turned", point=point, about=tuple(about))
    dx, dy = sp.sympify(point[0]) - about[0], sp.sympify(point[1]) - about[1]
    cos, sin = sp.cos(angle), sp.sin(angle)
    return about[0] + dx * cos + dy * sin, about[1] - dx * sin + dy * cos
