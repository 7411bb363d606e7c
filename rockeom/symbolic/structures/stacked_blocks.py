"""Two rigid blocks on one another (Psycharis 1990; Spanos, Roussis and Politis 2001)."""

import sympy as sp

from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Rigid, feet
from rockeom.symbolic.model import Body, Parameter, coordinate, parameter, rectangle, turned
from rockeom.symbolic.parts.superstructures import GRAVITY
from rockeom.symbolic.parts.supports import FREE_ROTATION, FRICTION, RESTITUTION, X, Y
from rockeom.symbolic.registry import shipped

THETA = FREE_ROTATION
XI = coordinate("xi", "xi", "m", "place of the upper base's centre along the lower block's top")
ETA = coordinate("eta", "eta", "m", "height of the upper base's centre above the lower block's top")
PHI = coordinate("phi", "phi", "rad", "rotation of the upper block, positive clockwise")


def _parameters(index: int, which: str) -> tuple[Parameter, ...]:
    return tuple(
        parameter(f"{symbol}_{index}", f"{which}_{name}", unit, f"{meaning} of the {which} block")
        for symbol, name, unit, meaning in (
            ("m", "mass", "kg", "mass"),
            ("b", "half_width", "m", "half of the width"),
            ("h", "half_height", "m", "half of the height"),
            ("I", "inertia", "kg m2", "moment of inertia about the centroid"),
        )
    )


@shipped(
    place=3.6,
    may_vanish=("lower_inertia", "upper_inertia", "restitution"),
    defaults={
        "lower_mass": 1.0,
        "upper_mass": 1.0,
        "lower_inertia": "that of a homogeneous rectangle",
        "upper_inertia": "that of a homogeneous rectangle",
        "restitution": 0.0,
    },
)
def stacked_blocks(law: str = "newton", support: str = "pinned") -> Model:
    """The corners of the upper block rest on the lower one, whose corners rest on the ground.

    Corners open and close, and none of them slips: the friction that a point needs is its friction
    over its normal force. A restitution of 0 to 1 is the ratio of the rates of a gap after and
    before a corner lands alone. The upper block is no wider than the lower one.

    Two of `RigidBlock` under one gravity, `lower` and `upper`, may take the place of the parameters
    of each block.

    The states are x, y [m] and theta [rad] of the lower block's base; xi and eta [m] of the upper
    block's base along and above the lower one's top, and its rotation phi [rad]; and their rates.

    Parameters
    ----------
    support : Support, optional
        Without one no corner slips; impacts are by Newton's law, or above a restitution of 0 by
        Poisson's, since Newton's has no impulse for many landings that do not slip. At corners of
        both blocks ``rk.Sliding(friction=..., restitution=..., law=...)`` has its own of each; its
        equations are derived at their first use.

    Examples
    --------
    >>> import rockeom as rk
    >>> pedestal = rk.RigidBlock(half_width=0.3, half_height=0.4, mass=500.0)  # m, kg
    >>> statue = rk.RigidBlock(half_width=0.2, half_height=0.7, mass=300.0)
    >>> stack = rk.StackedBlocks(lower=pedestal, upper=statue)
    >>> stack.upper_mass  # kg
    300.0
    """
    lower, upper = _parameters(1, "lower"), _parameters(2, "upper")
    m_1, b_1, h_1, i_1 = (p.symbol for p in lower)
    m_2, b_2, h_2, i_2 = (p.symbol for p in upper)
    theta, phi = THETA.position, PHI.position

    def on_lower(point):
        """A point that turns with the lower block, whose base's centre is at (x, y)."""
        across, up = turned(point, (0, 0), theta)
        return X.position + across, Y.position + up

    foot = on_lower((XI.position, 2 * h_1 + ETA.position))
    across, up = turned((0, h_2), (0, 0), phi)

    def corner(s):
        """A place of the upper block, in axes that turn with the lower one's top."""
        dx, dy = turned((s * b_2, 0), (0, 0), phi - theta)
        return XI.position + dx, ETA.position + dy

    slips = support == "sliding"
    friction = (FRICTION,) if slips else ()
    rigid = Rigid(RESTITUTION.symbol, FRICTION.symbol if slips else None, law)
    bottom = Body("lower", m_1, on_lower((0, h_1)), i_1, theta, outline=rectangle(b_1, h_1))
    place = foot[0] + across, foot[1] + up
    top = Body("upper", m_2, place, i_2, phi, outline=rectangle(b_2, h_2))
    return Model(
        name="stacked_blocks" + f"_by_{law}" * (law != "newton") + "_that_slide" * slips,
        title="Two rigid blocks on one another",
        parameters=(*lower, *upper, GRAVITY, *friction, RESTITUTION),
        coordinates=(X, Y, THETA, XI, ETA, PHI),
        bodies=(bottom, top),
        gravity=GRAVITY.symbol,
        rotation=PHI,
        contacts=(
            *feet(
                gap=lambda s: on_lower((s * b_1, 0))[1],
                slip=lambda s: on_lower((s * b_1, 0))[0],
                law=rigid,
            ),
            *feet(
                gap=lambda s: corner(s)[1],
                slip=lambda s: corner(s)[0],
                law=rigid,
                names=("upper_left", "upper_right"),
                place=lambda s: on_lower((corner(s)[0], 2 * h_1 + corner(s)[1])),
            ),
        ),
        overturning=sp.pi / 2,
        falls={THETA: sp.pi / 2},
        load_point=top.position,
        reference="Psycharis (1990)",
    )
