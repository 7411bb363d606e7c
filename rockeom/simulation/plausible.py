"""Questions about values that are allowed and hardly meant: units, masses, friction, impacts.

Each function returns the sentences of one question, none where the values are plausible.
"""

import math
from typing import cast

import numpy as np

from rockeom.codes import UPLIFT
from rockeom.integrator.schema import SearchedModes, in_space
from rockeom.motion import GroundMotion
from rockeom.numbers.degrees import with_degrees
from rockeom.simulation.events import EventColumns, Impacts
from rockeom.simulation.steps import Rows
from rockeom.simulation.support import Support, surfaces
from rockeom.structures.base import FixedBase, Structure
from rockeom.structures.evaluation import at_states
from rockeom.structures.impact_laws import Impulsive
from rockeom.structures.positions import places, positions_of
from rockeom.structures.searched_modes import Points, friction_of
from rockeom.structures.slope import overturning_angles, uplift_accelerations
from rockeom.structures.units import is_dimensionless

SHARE_OF_UPLIFT = 0.5
"""Part of the uplift acceleration below which the unit of a motion is questioned."""
LIKE_G = 0.05, 1.5
"""Peak accelerations that are usual in g, and small in m/s2."""
ROUGHEST = 0.8
"""Friction coefficient above which that of a foot that does not slide is questioned."""


def shaking(structure: Structure, motion: GroundMotion, stood: bool) -> tuple[str, ...]:
    """Accelerations in g that were given for m/s2; stood : whether no foot ever lifted.

    Not asked of the file of a network, whose format states the unit.
    """
    threshold, peak = _uplift_acceleration(structure), motion.peak
    weak = LIKE_G[0] <= peak <= min(LIKE_G[1], SHARE_OF_UPLIFT * threshold)
    if not (stood and weak) or motion.origin is not None:
        return ()
    remedy = (
        f'{motion.peak:.4g} g are given by GroundMotion.from_array(values, dt, units="g")'
        if motion.source == "array"
        else f'{peak:.4g} g are {peak * 9.81:.4g} m/s2: scale it to a pga of "{peak:.4g} g"'
    )
    return (
        f"The largest ground acceleration, {peak:.4g} m/s2, is {peak / threshold:.2g} of that "
        f"which lifts it: was it meant in g? {remedy}.",
    )


def _uplift_acceleration(structure: Structure) -> float:
    """In m/s2; 0 where it is not known."""
    if is_dimensionless(structure.module):
        return 0.0
    threshold = structure.uplift_acceleration
    if threshold is None and structure.slenderness is not None:  # a block on feet that may slide
        return float(structure.parameters()["gravity"] * math.tan(structure.slenderness))
    return threshold or 0.0


def directions(motion: GroundMotion, vertical: GroundMotion | None) -> tuple[str, ...]:
    """A vertical component that was given for a horizontal one, and the reverse."""
    said = []
    if motion.is_vertical:
        said += [
            f"The horizontal ground motion is the vertical component of a record, {motion.name}."
        ]
    if vertical is not None and vertical.origin and vertical.origin.azimuth is not None:
        said += [
            f"The vertical ground motion is a horizontal component of a record, {vertical.name}."
        ]
    return tuple(said)


def default_masses(structure: Structure) -> tuple[str, ...]:
    """Names of the masses that have their default value."""
    return tuple(
        name
        for name, default in structure.defaults().items()
        if name.endswith("mass") and getattr(structure, name) == default
    )


def forces(structure: Structure) -> tuple[str, ...]:
    """Forces that are reported of a structure whose mass was not given."""
    masses = default_masses(structure)
    if not masses or is_dimensionless(structure.module):
        return ()
    verb = "is" if len(masses) == 1 else "are"
    return (
        f"{' and '.join(masses)} {verb} at the default, {structure.defaults()[masses[0]]:g} kg: "
        "give the mass, or read forces, impulses and energies as those of one kilogram.",
    )


def friction(structure: Structure, support: Support) -> tuple[str, ...]:
    """Feet that are assumed not to slide, and need more friction than most surfaces have."""
    slides = any("friction" in name for name in structure.module.PARAMETERS)
    if slides or isinstance(structure, FixedBase) or is_dimensionless(structure.module):
        return ()
    both = (support.friction_demand, support.impact_friction_demand)
    demands = support.friction_demands.values() or [both]
    needed = max((x for pair in demands for x in pair if not math.isnan(x)), default=0.0)
    if not needed > ROUGHEST:
        return ()
    beyond = (
        f"Not sliding needed a friction coefficient of {needed:.3g}, more than the {ROUGHEST:g} of "
        "rough concrete"
        if needed < math.inf
        else "No friction coefficient would have kept it from sliding"
    )
    return (f"{beyond}: hold the feet{_let_slide(structure)}.",)


def _let_slide(structure: Structure) -> str:
    """How feet may slide instead; nothing of a round base, which rolls."""
    module = structure.module
    if not in_space(module):
        return ", or let them slide, by a sliding block or a sliding support"
    feet = any("_slip_" in name for name in module.KINEMATICS)
    return ", or let them slide, by their coefficient of friction" if feet else ""


def gained(structure: Structure, impacts: Impacts, law: str) -> tuple[str, ...]:
    """Impacts that gained energy: how many, how much, and the law that gains none."""
    gains = impacts.energy_gains
    if not len(gains):
        return ()
    unit = "" if is_dimensionless(structure.module) else " J"
    text = (
        f"{len(gains)} of {len(impacts)} impacts gained kinetic energy, "
        f"{gains.sum():.4g}{unit} in all"
    )
    if structure.has_landings:
        cause = "which friction with a restitution above zero can cause"
        return (f"{text}, {cause}; by the laws 'lzb' and 'pairwise' none does.",)
    exact = isinstance(structure.default_impact, Impulsive)
    return (
        f"{text}, by {law}." + " The impulsive law conserves the momenta, and gains none." * exact,
    )


def sloping(structure: Structure, slope: float) -> tuple[str, ...]:
    """Ground on which the structure cannot stand, or on which its feet slide.

    Nothing is said of one that ties hold.
    """
    held = getattr(structure, "restraint", None)
    if not slope or held:
        return ()
    said, bare = [], structure.unrestrained or structure
    uplifts, alpha = uplift_accelerations(bare, slope), structure.slenderness or math.inf
    if min(uplifts) <= 0.0 if uplifts else structure.has_landings and abs(slope) >= alpha:
        said.append("turns downhill about its edge without any shaking")
    friction, least = math.inf, abs(math.tan(slope))
    if structure.has_landings:
        module = cast(SearchedModes, structure.module)
        each = friction_of(module, structure.vector)
        points = Points(module, structure.state({}), structure.vector)
        slides = points.contacts().closed.astype(bool) & points.tangential.any(axis=(-2, -1))
        groups = [[i for i in of if slides[i]] for of in surfaces(module).values()]
        friction = min((each[of].max() for of in groups if of), default=math.inf)
    if friction < least:
        said.append(
            f"slides downhill, since its friction, {friction:.4g}, is below {least:.4g}, the "
            "tangent of the slope"
        )
    words = f"On a slope of {with_degrees(slope, 'rad')} it cannot stand: it"
    return tuple(f"{words} {one}." for one in said)


def tie(motion: GroundMotion, events: EventColumns) -> tuple[str, ...]:
    """An uplift of both feet at once, of which their order decides, on level ground."""
    for t, _, (before, _) in zip(*events.of(UPLIFT), strict=True):
        if not before.any() and motion.acceleration(t) == 0.0:
            return (
                f"At {t:.4g} s both feet lift at once: it leans to the left, and could to the "
                "right as well.",
            )
    return ()


def beyond_wall(structure: Structure, rows: Rows) -> tuple[str, ...]:
    """A lower corner that is beyond the wall that the upper one alone may strike."""
    m = structure.module
    if "wall_gap" not in m.PARAMETERS or "right" not in m.POSITIONS:
        return ()
    at = places(m, rows.mode, rows.y, structure.vector)
    corner = positions_of(m, at)["right"][:, 0]
    wall = structure.positions({})["right"][0] + structure.parameters()["wall_gap"]
    beyond = float(corner.max() - wall)
    if beyond <= _BEYOND_WALL * abs(wall):
        return ()
    return (
        f"The lower corner is up to {1e3 * beyond:.3g} mm beyond the wall, which the upper corner "
        "alone strikes: take a gap that the base does not slide through.",
    )


_BEYOND_WALL = 1e-9
"""Part of the distance of a wall that is rounding."""


def beyond_balance(structure: Structure, rows: Rows, slope: float) -> tuple[str, ...]:
    """A start from which the structure falls over when it is released at rest."""
    m, start = structure.module, rows.y[0]
    rotation = float(start[m.ROTATION])
    if not (structure.rocks_on_rigid_ground and rotation):
        return ()
    if slope:
        bounds = overturning_angles(structure, slope) or (math.inf, math.inf)
        returns = abs(rotation) <= bounds[rotation > 0.0]
    else:
        around, modes = np.array([start, start]), rows.mode[[0, 0]]
        around[:, m.ROTATION] *= 1.0 - 1e-6, 1.0 + 1e-6
        energy = at_states(structure.module, structure.vector, "energies", modes, around)
        potential = energy["gravitational_energy"] + energy["elastic_energy"]
        returns = potential[1] >= potential[0]
    if returns:
        return ()
    name, unit = m.STATES[m.ROTATION], m.STATE_UNITS[m.ROTATION]
    text = f"The initial {name}, {with_degrees(rotation, unit)}, lies beyond the overturning angle"
    if (angles := overturning_angles(structure, slope)) is not None:
        text += f", {with_degrees(angles[rotation > 0.0], unit)}"
    return (f"{text}: released at rest it falls over.",)
