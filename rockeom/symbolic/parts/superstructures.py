"""Superstructures on a rigid base: masses as functions of the motion of the base."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import sympy as sp

from rockeom.symbolic.elements import Spring
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    Member,
    Outline,
    Parameter,
    Point,
    coordinate,
    parameter,
    rectangle,
)

Place = Callable[[Point], Point]
"""Place of a point of the base, given from the middle between the feet."""

ROTATION = coordinate("theta", "theta", "rad", "rotation, positive clockwise about the right edge")
GRAVITY = parameter("g", "gravity", "m/s2", "acceleration of gravity")
HALF_WIDTH = parameter("B", "half_width", "m", "half of the distance between the feet")
BASE_MASS = parameter("m_b", "base_mass", "kg", "mass of the base structure")
BASE_HEIGHT = parameter("H_b", "base_height", "m", "height of the base's centroid")
BASE_INERTIA = parameter(
    "I_bg", "base_inertia", "kg m2", "its moment of inertia about its centroid"
)
MASS = parameter("m_e", "mass", "kg", "mass of the superstructure")
HEIGHT = parameter("H_e", "height", "m", "height of the superstructure's centroid")
INERTIA = parameter("I_eg", "inertia", "kg m2", "its moment of inertia about its centroid")
DEFORMATION = coordinate("u", "u", "m", "deformation of the column, at right angles to its axis")
STIFFNESS = parameter("k", "stiffness", "N/m", "flexural stiffness of the column")
DAMPING = parameter("c", "damping", "N s/m", "viscous damping coefficient of the column")
MAY_VANISH = (
    *("inertia", "base_mass", "base_height", "base_inertia", "damping", "foundation_damping"),
)
"""Parameters of structures of two masses that may be zero."""
INWARD = sp.Rational(17, 20)
"""Distance of the columns of a sketch from the middle of a floor, over half its width."""


@dataclass(frozen=True)
class Superstructure:
    """Masses on a rigid base, the base among them.

    coordinates : its own, besides those of the base. bodies(place, angle) : when the base has
    turned clockwise through the angle; the first carries the load of a pushover. elements : the
    springs and dampers in it, by name; elastic_energy, dissipation : those of others, the latter
    Rayleigh's function. members : what a sketch shows between the bodies.
    """

    name: str
    title: str
    parameters: tuple[Parameter, ...]
    coordinates: tuple[Coordinate, ...]
    bodies: Callable[[Place, sp.Expr], list[Body]]
    elastic_energy: sp.Expr = sp.S.Zero
    dissipation: sp.Expr = sp.S.Zero
    members: tuple[Member, ...] = ()
    elements: tuple[Spring, ...] = ()

    def about_the_middle(self, place: Place, angle: sp.Expr) -> tuple[Body, ...]:
        """The bodies on a base that turns about no foot: R and alpha have no meaning for them."""
        return tuple(replace(b, polar=None) for b in self.bodies(place, angle))

    @property
    def weight(self) -> sp.Expr:
        """Weight of all masses."""
        bodies = self.bodies(lambda point: point, sp.S.Zero)
        return sum((b.mass for b in bodies), sp.S.Zero) * GRAVITY.symbol


def lumped(
    name: str,
    index: str,
    mass: Parameter,
    height: Parameter,
    inertia: Parameter,
    place: Place,
    angle: sp.Expr,
    deformation: sp.Expr = sp.S.Zero,
    outline: Outline = (),
) -> Body:
    """A mass on the axis of the base, displaced by `deformation` at right angles to it."""
    polar = (
        HALF_WIDTH.symbol,
        height.symbol,
        sp.Symbol(f"R_{index}", positive=True),
        sp.Symbol(f"alpha_{index}", positive=True),
    )
    at = place((deformation, height.symbol))
    return Body(name, mass.symbol, at, inertia.symbol, angle, polar, outline)


def base(place: Place, angle: sp.Expr) -> Body:
    """The base that turns."""
    outline = rectangle(HALF_WIDTH.symbol, BASE_HEIGHT.symbol)
    of = BASE_MASS, BASE_HEIGHT, BASE_INERTIA
    return lumped("base", "b", *of, place, angle, outline=outline)


def _two_masses(place: Place, angle: sp.Expr, deformation: sp.Expr = sp.S.Zero) -> list[Body]:
    top = lumped("superstructure", "e", MASS, HEIGHT, INERTIA, place, angle, deformation)
    return [top, base(place, angle)]


def _on_the_base(kind: str) -> Member:
    """The member that carries the superstructure."""
    return Member(kind, "base", "superstructure", (sp.S.Zero, BASE_HEIGHT.symbol))


def rigid() -> Superstructure:
    """A rigid superstructure and a base, both lumped."""
    return Superstructure(
        "lumped_mass_structure",
        "Rigid lumped-mass structure",
        (MASS, HEIGHT, INERTIA, BASE_MASS, BASE_HEIGHT, BASE_INERTIA, HALF_WIDTH, GRAVITY),
        (),
        _two_masses,
        members=(_on_the_base("rod"),),
    )


def elastic_column() -> Superstructure:
    """A superstructure on an elastic, damped column that stands on a rigid base."""
    u = DEFORMATION
    return Superstructure(
        "flexible_structure",
        "Flexible structure",
        (*rigid().parameters, STIFFNESS, DAMPING),
        (u,),
        lambda place, angle: _two_masses(place, angle, u.position),
        members=(_on_the_base("cantilever"),),
        elements=(Spring("column", u.position, STIFFNESS.symbol, DAMPING.symbol),),
    )


def shear_frame(storeys: int) -> Superstructure:
    """Floors one above the other on a rigid base, springs and dampers between neighbours.

    Floor i moves by u_i relative to the base, at right angles to the turned axis.
    """
    floors = range(1, storeys + 1)

    def each(symbol: str, name: str, unit: str, meaning: str) -> list[Parameter]:
        return [parameter(f"{symbol}_{i}", f"{name}_{i}", unit, f"{meaning} {i}") for i in floors]

    masses = each("m", "mass", "kg", "mass of floor")
    heights = each("h", "height", "m", "height above the feet of floor")
    inertias = each("I", "inertia", "kg m2", "moment of inertia about its centroid of floor")
    stiffnesses = each("k", "stiffness", "N/m", "lateral stiffness of storey")
    dampings = each("c", "damping", "N s/m", "viscous damping coefficient of storey")
    moved = [
        coordinate(f"u_{i}", f"u_{i}", "m", f"displacement of floor {i} relative to the base")
        for i in floors
    ]
    places = [u.position for u in moved]
    drifts = [places[0], *(b - a for a, b in pairwise(places))]

    thick = heights[-1].symbol / 50
    slab = rectangle(HALF_WIDTH.symbol, thick)

    def columns(floor: int) -> Iterator[Member]:
        """The columns of a storey, under a floor."""
        below = f"floor {floor - 1}" if floor > 1 else "base"
        top = thick if floor > 1 else BASE_HEIGHT.symbol
        for x in (-HALF_WIDTH.symbol * INWARD, HALF_WIDTH.symbol * INWARD):
            yield Member("column", below, f"floor {floor}", (x, top), (x, -thick))

    def bodies(place: Place, angle: sp.Expr) -> list[Body]:
        found = [
            lumped(f"floor {i}", str(i), mass, height, inertia, place, angle, u.position, slab)
            for i, mass, height, inertia, u in zip(
                floors, masses, heights, inertias, moved, strict=True
            )
        ]
        return [*reversed(found), base(place, angle)]

    return Superstructure(
        f"shear_frame_{storeys}",
        f"Shear frame of {storeys} storeys" if storeys > 1 else "Shear frame of one storey",
        (
            *masses, *heights, *inertias, BASE_MASS, BASE_HEIGHT, BASE_INERTIA, HALF_WIDTH, GRAVITY,
            *stiffnesses, *dampings,
        ),
        tuple(moved),
        bodies,
        members=tuple(member for i in floors for member in columns(i)),
        elements=tuple(
            Spring(f"storey_{i}", drift, k.symbol, c.symbol)
            for i, drift, k, c in zip(floors, drifts, stiffnesses, dampings, strict=True)
        ),
    )  # fmt: skip
