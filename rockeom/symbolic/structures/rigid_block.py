"""Housner's block, and its slender and non-dimensional forms (thesis 2.2 and 2.5.1)."""

from typing import Any

import sympy as sp

from rockeom.symbolic.model import Body, coordinate, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, ROTATION
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel, rocking_structure

MASS = parameter("m", "mass", "kg", "mass")
HALF_WIDTH = parameter("B", "half_width", "m", "half of the width of the base")
HEIGHT = parameter("H", "height", "m", "height of the centroid above the base")
INERTIA = parameter("I_g", "inertia", "kg m2", "moment of inertia about the centroid")
BLOCK: dict[str, Any] = {
    "may_vanish": ("inertia",),
    "defaults": {"mass": 1.0, "inertia": "that of a homogeneous rectangle"},
}
"""Arguments of the classes of blocks."""


@shipped(place=1, **BLOCK, called={"height": "half_height"})
def rigid_block() -> RockingModel:
    """Housner's rigid body, which rocks about its two edges; any size of rotation.

    Parameters
    ----------
    full_height : float, optional
        Height of the whole block [m], for a strap and for words; `from_dimensions` sets it.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
    >>> round(block.alpha, 4), round(block.p, 3)  # rad, rad/s
    (0.245, 4.224)
    >>> round(block.uplift_acceleration, 3)  # m/s2
    2.453
    """
    b, h = HALF_WIDTH.symbol, HEIGHT.symbol
    polar = (b, h, sp.Symbol("R", positive=True), sp.Symbol("alpha", positive=True))
    theta, outline = ROTATION.position, rectangle(b, h)

    def bodies(pivot):
        centroid = turned((0, h), pivot, theta)
        return [Body("block", MASS.symbol, centroid, INERTIA.symbol, theta, polar, outline)]

    return rocking_structure(
        name="rigid_block",
        title="Rigid block on rigid ground",
        parameters=(MASS, HALF_WIDTH, HEIGHT, INERTIA, GRAVITY),
        coordinates=(ROTATION,),
        bodies=bodies,
        half_width=b,
        gravity=GRAVITY.symbol,
        reference="Housner (1963); thesis 2-2, 2-6, 2-9, 3-8, 3-9",
        sources={
            "theta": "thesis 2-2, 2-9",
            "energy_ratio": "thesis 2-6",
            "horizontal_reaction": "thesis 3-8",
            "vertical_reaction": "thesis 3-9",
        },
    )


@shipped(place=2, **BLOCK)
def slender_block() -> RockingModel:
    """The block linearised for small rotation and small alpha (thesis 2-3, 2-14).

    Rotation, alpha and horizontal ground acceleration in g are small of first order. The
    restitution keeps the exact geometry (thesis 2-6), as Housner's does.
    """
    radius = parameter("R", "radius", "m", "distance of the centroid from either edge")
    alpha = parameter("alpha", "alpha", "rad", "angle of that line from the vertical")
    r, a = radius.symbol, alpha.symbol
    theta = ROTATION.position
    half_width, height = r * sp.sin(a), r * sp.cos(a)
    outline = rectangle(half_width, height)

    def bodies(pivot):
        centroid = turned((0, height), pivot, theta)
        return [Body("block", MASS.symbol, centroid, INERTIA.symbol, theta, outline=outline)]

    return rocking_structure(
        name="slender_block",
        title="Slender rigid block, linearised",
        parameters=(MASS, radius, alpha, INERTIA, GRAVITY),
        coordinates=(ROTATION,),
        bodies=bodies,
        half_width=half_width,
        gravity=GRAVITY.symbol,
        small=(theta, ROTATION.velocity, a, sp.Symbol("a_x", real=True)),
        reference="Housner (1963); thesis 2-3, 2-14",
        sources={"theta": "thesis 2-3, 2-14"},
    )


@shipped(place=3, defaults={"radius_ratio": 0.75})
def nondimensional_block() -> RockingModel:
    """The block in x = theta/alpha and time p t (thesis 2-10 to 2-13); accelerations in units of g.

    Mass in units of m, length in units of g/p**2, time in units of 1/p, so that gravity is 1,
    ground accelerations are in units of g, and I_o = mgR/p**2 leaves two numbers: alpha and
    rho = m R**2/I_o (3/4 for a rectangular block), which is the radius in these units.
    """
    x = coordinate("x", "x", "-", "rotation over alpha")
    alpha = parameter("alpha", "alpha", "rad", "angle of the line from edge to centroid")
    ratio = parameter("rho", "radius_ratio", "-", "$m R^2/I_o$, 3/4 for a rectangular block")
    a, rho = alpha.symbol, ratio.symbol
    angle, height = a * x.position, rho * sp.cos(a)
    outline = rectangle(rho * sp.sin(a), height)

    def bodies(pivot):
        centroid = turned((0, height), pivot, angle)
        return [Body("block", sp.Integer(1), centroid, rho - rho**2, angle, outline=outline)]

    return rocking_structure(
        name="nondimensional_block",
        title="Non-dimensional rigid block",
        parameters=(alpha, ratio),
        coordinates=(x,),
        bodies=bodies,
        half_width=rho * sp.sin(a),
        gravity=sp.Integer(1),
        rotation_angle=angle,
        overturning=sp.pi / (2 * a),
        reference="Hogan (1989); thesis 2-13",
        sources={"x": "thesis 2-13"},
    )
