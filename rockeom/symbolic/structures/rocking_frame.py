"""A beam on columns that are not joined to it, nor to the ground (Makris and Vassiliou 2013)."""

import sympy as sp

from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.model import Body, Parameter, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, ROTATION
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel, rocking_structure


@shipped(may_vanish=("beam_mass",))
def rocking_frame() -> RockingModel:
    """Equal rectangular columns that rock in step under a rigid beam, which stays level.

    The beam rides on the upper corners opposite the pressed feet, and slides on none. As all
    columns turn alike, they are one body of their mass and inertia together; the forces on the
    feet are sums over the columns.
    """
    columns = Parameter(
        sp.Symbol("n", positive=True, integer=True), "columns", "-", "number of columns"
    )
    column_mass = parameter("m_c", "column_mass", "kg", "mass of each column")
    half_width = parameter("B", "half_width", "m", "half of the width of a column")
    half_height = parameter("H", "half_height", "m", "half of the height of a column")
    beam_mass = parameter("m_b", "beam_mass", "kg", "mass of the beam")
    b, h, theta = half_width.symbol, half_height.symbol, ROTATION.position
    n, apart = columns.symbol, sp.Max(6 * b, 6 * h / 5)
    mass = n * column_mass.symbol
    above = rectangle((n - 1) * apart / 2 + 2 * b, 0, h / 4)
    each = {"outline": rectangle(b, h), "copies": n, "apart": apart}

    def bodies(pivot):
        x, y = turned((-SIDE * b, 2 * h), pivot, theta)
        return [
            Body("beam", beam_mass.symbol, (x + SIDE * b, y), outline=above),
            Body(
                "columns", mass, turned((0, h), pivot, theta), mass * (b**2 + h**2) / 3, theta,
                **each,
            ),
        ]  # fmt: skip

    return rocking_structure(
        name="rocking_frame",
        title="Rocking frame: a beam on free-standing columns",
        parameters=(columns, column_mass, half_width, half_height, beam_mass, GRAVITY),
        coordinates=(ROTATION,),
        bodies=bodies,
        half_width=b,
        gravity=GRAVITY.symbol,
        reference="Makris and Vassiliou (2013)",
    )
