"""The body that stands on feet in space: a prism on its corners, a statue on its legs."""

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from rockeom.numbers.checks import require_word
from rockeom.symbolic import space
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Rigid
from rockeom.symbolic.model import Parameter, coordinate, parameter
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.parts.supports import FRICTION, RESTITUTION
from rockeom.symbolic.registry import family
from rockeom.symbolic.structures.rigid_block import MASS

PLACE = tuple(
    coordinate(axis, axis, "m", f"place of the centroid along {axis}, relative to the ground")
    for axis in "xyz"
)
ANGLES = (
    coordinate(r"\psi", "yaw", "rad", "turn about the vertical, counter-clockwise from above"),
    coordinate(r"\theta", "pitch", "rad", "turn about y, before yaw"),
    coordinate(r"\phi", "roll", "rad", "turn about x, before pitch"),
)
YAW, PITCH, ROLL = ANGLES
FRAME = space.frame(YAW.position, PITCH.position, ROLL.position, tuple(c.position for c in PLACE))
CENTROID_HEIGHT = parameter("h", "centroid_height", "m", "height of the centroid above the feet")
WIDTH = parameter("a", "width", "m", "length of the base along x of the body")
DEPTH = parameter("d", "depth", "m", "length of the base along y of the body")
OFFSETS = tuple(
    Parameter(
        sp.Symbol(f"e_{axis}", real=True),
        f"offset_{axis}",
        "m",
        f"place of the centroid along {axis} of the body, from the middle of the base",
    )
    for axis in "xy"
)
CORNERS = {
    "south_west": (-1, -1), "south_east": (1, -1), "north_east": (1, 1), "north_west": (-1, 1),
}  # fmt: skip
MOMENTS = ("xx", "yy", "zz")
PRODUCTS = ("xy", "xz", "yz")
FALLEN = sp.Rational(7, 5)
"""Tilt [rad] at which it has overturned: below a quarter turn, at which the angles are singular."""
SLIPS = {"never": None, "freely": sp.S.Zero, "rubbing": FRICTION.symbol}
"""Coefficients of friction of feet by the word for how they slip."""


@family
def prism(slips: str = "never") -> Any:
    """A block on the four corners of its base, which never slip, slip freely, or with friction.

    slips : a word of `SLIPS`.
    """
    b, c = WIDTH.symbol / 2, DEPTH.symbol / 2
    down = -CENTROID_HEIGHT.symbol
    corners = {
        name: (i * b - OFFSETS[0].symbol, j * c - OFFSETS[1].symbol, down)
        for name, (i, j) in CORNERS.items()
    }
    inertia = sp.diag(*(_inertia(axes).symbol for axes in MOMENTS))
    size = (WIDTH, DEPTH, CENTROID_HEIGHT, *OFFSETS, *map(_inertia, MOMENTS))
    return _standing("prism", "Prism in space", corners, inertia, size, slips)


@family
def legged_statue(
    feet: Sequence[str] = ("one", "two", "three"), slips: str = "never", uneven: bool = False
) -> Any:
    """A rigid body of any shape on feet, which never slip, slip freely, or with friction.

    feet : their names. slips : a word of `SLIPS`. uneven : whether feet have heights of their own.
    """
    every = {axes: _inertia(axes) for axes in (*MOMENTS, *PRODUCTS)}
    axes = ("x", "y", *("z" * uneven))
    arms = {foot: [_arm(foot, axis) for axis in axes] for foot in feet}
    places = {}
    for foot, (x, y, *rise) in arms.items():
        z = sum((height.symbol for height in rise), -CENTROID_HEIGHT.symbol)
        places[foot] = (x.symbol, y.symbol, z)
    inertia = sp.Matrix(3, 3, lambda i, j: every["".join(sorted("xyz"[i] + "xyz"[j]))].symbol)
    size = (CENTROID_HEIGHT, *every.values(), *(p for arm in arms.values() for p in arm))
    return _standing("legged_statue", "Statue on legs in space", places, inertia, size, slips)


def _standing(
    name: str,
    title: str,
    feet: Mapping[str, tuple[sp.Expr, sp.Expr, sp.Expr]],
    inertia: sp.Matrix,
    size: tuple[Parameter, ...],
    slips: str,
) -> Model:
    """A body on feet whose places are given from the centroid."""
    require_word("slips", slips, SLIPS, name)
    friction = (FRICTION,) if slips == "rubbing" else ()
    law = Rigid(RESTITUTION.symbol, SLIPS[slips], "newton" if slips == "freely" else "moreau")
    return Model(
        name=name,
        title=title,
        parameters=(
            MASS,
            *size,
            *friction,
            RESTITUTION,
            GRAVITY,
        ),
        coordinates=(*PLACE, *ANGLES),
        bodies=(space.body("body", MASS.symbol, inertia, FRAME),),
        gravity=GRAVITY.symbol,
        rotation=PITCH,
        contacts=space.feet(FRAME, feet, law),
        falls=space.tilt(FRAME, FALLEN),
    )


def _inertia(axes: str) -> Parameter:
    if axes in MOMENTS:
        meaning = f"moment of inertia about {axes[0]}"
        return parameter(f"I_{axes}", f"inertia_{axes}", "kg m2", meaning)
    meaning = f"entry {axes} of the inertia tensor"
    return Parameter(sp.Symbol(f"I_{axes}", real=True), f"inertia_{axes}", "kg m2", meaning)


def _arm(foot: str, axis: str) -> Parameter:
    meaning = f"place of {foot} along {axis} of the body, from the centroid"
    if axis == "z":
        meaning = f"height of {foot} above the lowest feet"
    symbol = sp.Symbol(f"{axis}_{{{foot.replace('_', '')}}}", real=True)
    return Parameter(symbol, f"{foot}_{axis}", "m", meaning)
