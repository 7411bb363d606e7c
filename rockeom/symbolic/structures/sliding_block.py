"""The rigid block that slides, bounces and flies: Shenton's five modes."""

from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Rigid, feet
from rockeom.symbolic.model import Body, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.parts.supports import FREE_ROTATION, FRICTION, RESTITUTION, X, Y
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.structures.rigid_block import BLOCK, HALF_WIDTH, HEIGHT, INERTIA, MASS


@shipped(
    place=3.5,
    may_vanish=("inertia", "friction", "restitution"),
    defaults=BLOCK["defaults"],
    called={"height": "half_height"},
)
def sliding_block(law: str = "newton") -> Model:
    """The rigid block on feet that open, stick, slip and bounce; any size of rotation.

    The states are the place x and the height y of the base's centre [m], theta [rad], and their
    rates. A restitution of 0 to 1 is the ratio of the rates of a foot's gap after and before it
    lands.

    Parameters
    ----------
    full_height : float, optional
        Height of the whole block [m], for a strap and for words; `from_dimensions` sets it.
    """
    x, y, theta = X.position, Y.position, FREE_ROTATION.position
    b, h = HALF_WIDTH.symbol, HEIGHT.symbol

    def placed(point):
        """A point of the block, its base's centre at (x, y)."""
        across, up = turned(point, (0, 0), theta)
        return x + across, y + up

    block = Body(
        "block", MASS.symbol, placed((0, h)), INERTIA.symbol, theta, outline=rectangle(b, h)
    )
    return Model(
        name="sliding_block",
        title="Rigid block that slides, bounces and flies",
        parameters=(MASS, HALF_WIDTH, HEIGHT, INERTIA, GRAVITY, FRICTION, RESTITUTION),
        coordinates=(X, Y, FREE_ROTATION),
        bodies=(block,),
        gravity=GRAVITY.symbol,
        rotation=FREE_ROTATION,
        contacts=feet(
            gap=lambda s: placed((s * b, 0))[1],
            slip=lambda s: placed((s * b, 0))[0],
            law=Rigid(restitution=RESTITUTION.symbol, friction=FRICTION.symbol, law=law),
        ),
        load_point=block.position,
        reference="Shenton (1996)",
    )
