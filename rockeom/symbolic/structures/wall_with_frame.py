"""A rocking wall beside an elastic frame, linked to it."""

from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.elements import Spring
from rockeom.symbolic.model import GROUND_Y, Body, Member, coordinate, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY, ROTATION
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel, rocking_structure


@shipped(
    may_vanish=("inertia", "frame_damping", "link_stiffness", "link_damping"),
)
def wall_with_frame() -> RockingModel:
    """A rigid wall on rigid ground and a frame of one mass on elastic columns of its own.

    The link is a spring and a damper between the wall's axis and the frame's mass, and stays
    level. How far from the wall the frame stands changes nothing but a sketch. The forces on the
    feet are those of the wall alone: the frame's columns carry its mass.
    """
    mass = parameter("m", "mass", "kg", "mass of the wall")
    half_width = parameter("B", "half_width", "m", "half of the width of the wall")
    height = parameter("H", "height", "m", "height of the wall's centroid")
    inertia = parameter("I_g", "inertia", "kg m2", "the wall's inertia about its centroid")
    frame_mass = parameter("m_f", "frame_mass", "kg", "mass of the frame")
    frame_stiffness = parameter("k_f", "frame_stiffness", "N/m", "lateral stiffness of the frame")
    frame_damping = parameter("c_f", "frame_damping", "N s/m", "damping of the frame")
    link_height = parameter("h_l", "link_height", "m", "height of the frame and of the link")
    link_stiffness = parameter("k_l", "link_stiffness", "N/m", "stiffness of the link")
    link_damping = parameter("c_l", "link_damping", "N s/m", "damping of the link")
    moved = coordinate("u", "u", "m", "displacement of the frame")
    theta, u, b = ROTATION.position, moved.position, half_width.symbol
    linked, _ = turned((0, link_height.symbol), (SIDE * b, 0), theta)
    stretch = linked - u
    columns = frame_stiffness.symbol * u + frame_damping.symbol * moved.velocity
    beside, end = 16 * b / 5, 4 * b / 5
    outline = rectangle(b, height.symbol)

    def bodies(pivot):
        return [
            Body("frame", frame_mass.symbol, (beside + u, link_height.symbol)),
            Body(
                "wall", mass.symbol, turned((0, height.symbol), pivot, theta), inertia.symbol,
                theta, outline=outline,
            ),
        ]  # fmt: skip

    return rocking_structure(
        name="wall_with_frame",
        title="Rocking wall beside an elastic frame",
        parameters=(
            mass, half_width, height, inertia, frame_mass, frame_stiffness, frame_damping,
            link_height, link_stiffness, link_damping, GRAVITY,
        ),
        coordinates=(ROTATION, moved),
        bodies=bodies,
        half_width=b,
        gravity=GRAVITY.symbol,
        elements=(
            Spring("frame", u, frame_stiffness.symbol, frame_damping.symbol),
            Spring("link", stretch, link_stiffness.symbol, link_damping.symbol),
        ),
        members=(
            Member("spring", "wall", "frame", (0, link_height.symbol - height.symbol), (-end, 0)),
            Member("rod", "frame", "frame", (-end, 0), (end, 0)),
            *(
                Member("column", "ground", "frame", (beside + x, 0), (x, 0))
                for x in (-7 * b / 10, 7 * b / 10)
            ),
        ),
        beside_feet=(-columns, frame_mass.symbol * (GRAVITY.symbol + GROUND_Y)),
    )  # fmt: skip
