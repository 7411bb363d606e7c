"""Chopra and Yim's flexible structure of one mass on a massless base (thesis 2.4.1)."""

import sympy as sp

from rockeom.symbolic.algebra import truncated
from rockeom.symbolic.elements import Spring
from rockeom.symbolic.model import Body, Member, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import (
    DAMPING,
    DEFORMATION,
    GRAVITY,
    HALF_WIDTH,
    ROTATION,
    STIFFNESS,
)
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel, rocking_structure

MASS = parameter("m", "mass", "kg", "mass, a point")
HEIGHT = parameter("H", "height", "m", "height of the mass above the base")


@shipped(place=8, may_vanish=("damping",))
def uplifting_oscillator() -> RockingModel:
    """An elastic, damped column with a point mass; the base has none (Chopra and Yim 1985).

    Positions are those of the flexible structure to first order in the rotation and the
    deformation: statics is that of the undeformed shape, without P-delta, and it never overturns.
    By `Impulsive` each impact ends in full contact. The base has no weight to keep it down:
    `lost_contact` says whether a foot would have jumped.
    """
    theta, u = ROTATION, DEFORMATION
    small = (theta.position, u.position)
    outline = rectangle(HALF_WIDTH.symbol, 0)

    def bodies(pivot):
        exact = turned((u.position, HEIGHT.symbol), pivot, theta.position)
        x, y = (truncated(e, small, 1) for e in exact)
        base = turned((0, 0), pivot, theta.position)
        return [
            Body("mass", MASS.symbol, (x, y)),
            Body("base", sp.S.Zero, base, rotation=theta.position, outline=outline),
        ]

    return rocking_structure(
        name="uplifting_oscillator",
        title="Uplifting oscillator: a flexible structure on a massless base, small displacements",
        parameters=(MASS, HEIGHT, HALF_WIDTH, STIFFNESS, DAMPING, GRAVITY),
        coordinates=(theta, u),
        bodies=bodies,
        half_width=HALF_WIDTH.symbol,
        gravity=GRAVITY.symbol,
        elements=(Spring("column", u.position, STIFFNESS.symbol, DAMPING.symbol),),
        members=(Member("cantilever", "base", "mass"),),
        small=(*small, theta.velocity, u.velocity),
        reference="Chopra and Yim (1985); thesis 2-7, 2-8",
    )
