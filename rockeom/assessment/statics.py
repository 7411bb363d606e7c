"""Uplift, sliding and restraint under a horizontal acceleration that grows slowly.

The ground accelerates the whole structure by a. A structure of mass m, its centroid at the height h
and at the distance b from the edge about which it leans, presses with N = m (g - a_v) on the
ground, where a_v is the largest vertical acceleration, upwards or downwards: databases have
components of either sign. With the coefficient of friction mu it lifts where m a h > N b, and
slides where m a > mu N. A horizontal force F at the height z holds it still if

    F >= (m a h - N b)/z   or it lifts      F <= (m a h + N b)/z   or it tips to the other side
    F >= m a - mu N        or it slides     F <= m a + mu N        or its base is pushed out

A strap takes what it must: its strength is the largest of the lower bounds. One that is too high
pushes the base out: up to z = (a h + b N/m)/(a - mu N/m) one holds. A force T that holds an edge
down needs T >= (m a h - N b)/(2 b), with the distance 2 b of the edges, and T >= m a/mu - N.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from rockeom.integrator.schema import in_space
from rockeom.motion.slope import weight_on
from rockeom.numbers.checks import InputError
from rockeom.structures.base import Structure
from rockeom.structures.evaluation import gravity_of
from rockeom.structures.positions import feet_at_rest, has_barrier, stands_on_feet
from rockeom.structures.shipped.stacked_blocks import StackedBlocks
from rockeom.structures.slope import uplift_accelerations

_SAME = 1e-9
"""Relative difference of a friction coefficient and b/h that is rounding."""

_LIFTS = {
    "facade": "the inner edge, without ties,",
    "isolated_blocks": "a block, on ground that moves as its base does,",
}
"""Parts that lift first, by the models of structures of which it is no foot on the ground."""


class Load(NamedTuple):
    """Load of a restraint.

    Parameters
    ----------
    acceleration : float
        Horizontal acceleration, either way [m/s2].
    vertical : float, optional
        Largest vertical acceleration [m/s2].
    friction : float, optional
        Coefficient of friction below the feet; None where it is unknown, and lifting alone is
        prevented.
    """

    acceleration: float
    vertical: float = 0.0
    friction: float | None = None


class Statics(NamedTuple):
    """Structure at rest, and whatever changes it.

    Parameters
    ----------
    uplift_accelerations : tuple of (float, float)
        Accelerations (left, right) at which it starts to lean there [m/s2].
    weight : float
        Vertical force of the ground, of tendons too [N].
    mass : float
        Mass of all that the ground accelerates [kg].
    arms : tuple of (float, float)
        Horizontal distances b (left, right) of the centroid from the edge about which it leans
        there [m].
    centroid_height : float
        Height h of the centroid of all that the ground accelerates [m].
    base_width : float
        Distance of the edges [m].
    lifts : str, optional
        Part that lifts first, in words.
    one_body : bool, optional
        Whether a strap holds all of it.
    along : float, optional
        Acceleration of the ground that does what the weight along the slope does [m/s2]; `weight`
        is the part normal to it.
    """

    uplift_accelerations: tuple[float, float]
    weight: float
    mass: float
    arms: tuple[float, float]
    centroid_height: float
    base_width: float
    lifts: str = "a foot"
    one_body: bool = True
    along: float = 0.0

    @property
    def one_sided(self) -> bool:
        """Whether it lifts to the right alone."""
        return math.isinf(self.uplift_accelerations[0])

    @property
    def uplift_acceleration(self) -> float:
        """Acceleration that lifts a foot, to the side of the lesser one [m/s2]."""
        return min(self.uplift_accelerations)

    @property
    def frictions_to_rock(self) -> tuple[float, float]:
        """(left, right) coefficients of friction below which it slides before; b/h of a block."""
        left, right = self.uplift_accelerations
        of_mass = self.mass / self.weight
        return of_mass * (left + self.along), of_mass * (right - self.along)

    def sliding_acceleration(self, friction: float) -> float:
        """Acceleration from which it slides, on a slope downhill.

        Parameters
        ----------
        friction : float
            Coefficient of friction.

        Returns
        -------
        float
            Acceleration of the ground [m/s2].
        """
        return friction * self.weight / self.mass - abs(self.along)

    def slides_first(self, friction: float) -> tuple[bool | None, bool | None]:
        """Whether the structure slides before it lifts.

        Parameters
        ----------
        friction : float
            Coefficient of friction.

        Returns
        -------
        tuple of (bool, bool)
            Verdicts (left, right); None at the limit.
        """
        left, right = (
            None if math.isclose(friction, least, rel_tol=_SAME) else friction < least
            for least in self.frictions_to_rock
        )
        return left, right

    def strap(self, load: Load, height: float) -> float:
        """Strength of a strap that holds the structure still.

        Parameters
        ----------
        load : Load
            Load of the strap.
        height : float
            Height of the strap [m].

        Returns
        -------
        float
            Force [N]; 0 where the structure stays by itself, NaN where no force holds it.
        """
        pushed, grip, overturning, restoring = self._at_rest(load)
        force = max(0.0, (overturning - restoring) / height, pushed - grip)
        most = min((overturning + restoring) / height, pushed + grip)
        return force if restoring > 0.0 and force <= most * (1.0 + _SAME) else math.nan

    def highest_strap(self, load: Load) -> float:
        """Height above which a strap pushes the base out.

        Parameters
        ----------
        load : Load
            Load of the strap.

        Returns
        -------
        float
            Height [m]; inf where none does.
        """
        pushed, grip, overturning, restoring = self._at_rest(load)
        pulled_out = pushed > grip and restoring > 0.0
        return (overturning + restoring) / (pushed - grip) if pulled_out else math.inf

    def hold_down(self, load: Load) -> float:
        """Force at the edge that would lift.

        Parameters
        ----------
        load : Load
            Load of the restraint.

        Returns
        -------
        float
            Force [N]; 0 where it stays, inf where none holds it.
        """
        pushed, grip, overturning, restoring = self._at_rest(load)
        if restoring <= 0.0 or (grip == 0.0 and pushed > 0.0):
            return math.inf
        lifting = (overturning - restoring) / self.base_width
        return max(0.0, lifting, 0.0 if load.friction is None else (pushed - grip) / load.friction)

    def _at_rest(self, load: Load) -> tuple[float, float, float, float]:
        """m a, mu N [N], m a h, N b [N m] with the lesser b."""
        weight = self.weight - self.mass * load.vertical
        pushed = self.mass * (load.acceleration + abs(self.along))
        grip = math.inf if load.friction is None else load.friction * weight
        return pushed, grip, pushed * self.centroid_height, weight * min(self.arms)


def statics_of(structure: Structure, slope: float = 0.0) -> Statics:
    """The statics of a structure that rocks on rigid ground, which may slope [rad].

    Raises ValueError for another one, and for one that no acceleration lifts or that cannot stand.
    """
    if isinstance(structure, StackedBlocks):
        if slope:
            raise InputError("slope", slope, "assess").so("stacks are judged on level ground alone")
        if structure.support:
            raise InputError("structure", of="assess").says(
                "corners that slide are not judged: leave out the support of the stack"
            )
        return _of_stack(structure)
    if in_space(structure.module):
        return _in_space(structure, slope)
    if (bare := structure.unrestrained) is not None:
        lifts = _LIFTS.get(structure.model, "a foot, with nothing that holds it,")
        held = hasattr(structure, "restraint")
        return statics_of(bare, slope)._replace(lifts=lifts, one_body=held)
    if structure.model == "facade":
        return _of_facade(structure, slope)
    thresholds = uplift_accelerations(structure, slope)
    m = structure.module
    planar = "left_reaction" in m.REACTIONS
    if thresholds is None or not planar or m.STATE_UNITS[m.ROTATION] != "rad":
        raise InputError("structure", of="assess").says(
            f"{structure.model} has no feet that lift from rigid ground, in metres and seconds: "
            "take a RigidBlock, with friction= where it may slide, StackedBlocks, "
            "LumpedMassStructure, FlexibleStructure, ShearFrame, HeldBlock, Facade or "
            "IsolatedBlocks"
        )
    if not math.isfinite(min(thresholds)):
        raise InputError("structure", structure.model, "assess").so("no acceleration lifts it")
    if min(thresholds) <= 0.0:
        raise InputError("slope", slope, "assess").so(f"{structure.model} cannot stand on it")
    along, normal = weight_on(slope, gravity_of(structure.module, structure.vector))
    feet, lifted = _feet(structure, normal), _feet(structure, normal + 1.0)
    pushed = structure.reactions({}, ground_acceleration=1.0)["horizontal_reaction"]
    mass = abs(float(pushed)) + _moving_mass(structure)
    counted = float((lifted - feet).sum())
    # the beam of a rocking frame bears on the feet of one side, and counts on both
    weight = float(feet.sum() * mass / counted)
    places = structure.positions({})
    width = float(abs(places["right"][0] - places["left"][0]))
    left, right = (feet[::-1] * width).tolist()  # leaning to the right lifts the left foot
    return Statics(
        thresholds,
        weight,
        mass,
        (left / weight, right / weight),
        max(left / (thresholds[0] + along), right / (thresholds[1] - along)) / mass,
        width,
        one_body=math.isclose(counted, mass, rel_tol=1e-6),
        along=along,
    )


class Edge(NamedTuple):
    """Edge of the base of a body in space about which the least acceleration lifts it.

    Parameters
    ----------
    azimuth : float
        Azimuth of the direction, from x of the body, in which it leans about this edge [rad].
    arm : float
        Horizontal distance of the edge from the centroid [m].
    behind : float
        Horizontal distance from the centroid to which the base reaches the other way [m].
    height : float
        Height of the centroid [m].
    """

    azimuth: float
    arm: float
    behind: float
    height: float


def weakest_edge(structure: Structure) -> Edge:
    """The edge nearest to the centroid, of equal ones the first counter-clockwise from x.

    It is one of the base on which the body rests. That of a round base is the one along x.

    Raises InputError for anything but one body at rest on feet or a round base.
    """
    m: Any = structure.module
    at = structure.positions({}) if stands_on_feet(m) or structure.overturning_angles else {}
    if at and has_barrier(structure):
        from scipy.spatial import ConvexHull  # slow to import

        feet, bear = feet_at_rest(structure)
        feet = feet[bear]
        edges = ConvexHull(feet[:, :2]).equations
        x, y, offset = edges[edges[:, -1] >= edges[:, -1].max() * (1.0 + _SAME)].T
        turns = np.mod(np.arctan2(y, x) + _SAME, 2.0 * np.pi) - _SAME  # rounding is no full turn
        i = int(turns.argmin())
        behind = -float((feet[:, :2] @ [x[i], y[i]]).min())
        return Edge(float(turns[i]), -float(offset[i]), behind, -float(feet[0, 2]))
    if structure.overturning_angles:  # of a round column
        (alpha, _), height = structure.overturning_angles, float(at["column"][2])
        arm = height * math.tan(alpha)
        return Edge(0.0, arm, arm, height)
    raise InputError("structure", of="assess").says(
        f"{type(structure).__name__} is not one body at rest on level feet, such as a Prism, nor a "
        "round column"
    )


def _in_space(structure: Structure, slope: float) -> Statics:
    """Statics of the direction in which the least acceleration lifts it."""
    m, name = structure.module, type(structure).__name__
    if slope:
        raise InputError("slope", slope, "assess").so(f"{name} is judged on level ground alone")
    gravity, (_, arm, _, height) = gravity_of(m, structure.vector), weakest_edge(structure)
    least = float(gravity * arm / height)
    weight = float(structure.reactions({})["vertical_reaction"])
    return Statics(
        (least, least), weight, weight / gravity, (arm, arm), height,
        2.0 * arm, "a foot, in the weakest direction,", one_body=False,
    )  # fmt: skip


def _of_facade(facade: Any, slope: float) -> Statics:
    """A facade lifts from its outer edge alone, away from the walls on which it leans."""
    if slope:
        raise InputError("slope", slope, "assess").so("facades are judged on level ground alone")
    at_rest, pushed = facade.reactions({}), facade.reactions({}, ground_acceleration=1.0)
    moment = facade.thickness * at_rest["walls_reaction"]  # about the outer edge
    mass = float(pushed["horizontal_reaction"])
    height = facade.thickness * (pushed["walls_reaction"] - at_rest["walls_reaction"]) / mass
    if moment <= 0.0:
        raise InputError("thrust", facade.thrust, "Facade").so("it cannot stand")
    weight = mass * facade.gravity
    uplifts, arms = (math.inf, moment / (mass * height)), (math.inf, moment / weight)
    return Statics(uplifts, weight, mass, arms, height, facade.thickness, _LIFTS["facade"])


def _of_stack(stack: StackedBlocks) -> Statics:
    """Both blocks lift as one, or the upper one alone."""
    lower, upper = stack.lower, stack.upper
    mass = lower.mass + upper.mass
    heights = np.array([lower.half_height, 2 * lower.half_height + upper.half_height])
    height = float(heights @ [lower.mass, upper.mass]) / mass
    both = stack.gravity * lower.half_width / height
    alone = stack.gravity * upper.half_width / upper.half_height
    lifts = "a foot of the upper block" if alone < both else "a foot"
    least, arm = min(both, alone), lower.half_width
    return Statics(
        (least, least), mass * stack.gravity, mass, (arm, arm), height, 2 * arm, lifts, False
    )


def _feet(structure: Structure, vertical: float) -> np.ndarray:
    """(2,) forces on the left and the right foot under a vertical acceleration [N]."""
    forces = structure.reactions({}, vertical_ground_acceleration=vertical)
    return np.array([forces["left_reaction"], forces["right_reaction"]], dtype=float)


def _moving_mass(structure: Structure) -> float:
    """Mass that moves relative to feet that are held [kg]; that of a rigid structure does not."""
    try:
        return float(structure.fixed_base().effective_masses.sum())
    except ValueError:
        return 0.0


def is_symmetric(structure: Structure) -> bool:
    """Whether the mirror image of each motion is a motion, too.

    By the equations of motion at random states and their mirror images, all coordinates with the
    other sign. One with a coordinate that keeps its sign counts as not symmetric.
    """
    if isinstance(structure, StackedBlocks):
        return True
    if structure.unrestrained is not None or structure.model == "facade":
        return False
    m, p, rng = structure.module, structure.vector, np.random.default_rng(0)
    left, right = np.empty((2, m.N_STATES))
    for y in 0.1 * rng.standard_normal((_STATES, m.N_STATES)):
        y[m.ROTATION] = abs(y[m.ROTATION])
        across, up = rng.standard_normal(2).tolist()
        m.rates(m.MODES.index("left"), -y, p, -across, up, left)
        m.rates(m.MODES.index("right"), y, p, across, up, right)
        if not np.allclose(left, -right, rtol=_SAME, atol=_SAME * np.abs(right).max()):
            return False
    return True


_STATES = 20
"""Random states at which the equations of motion are compared with those of the mirror image."""
