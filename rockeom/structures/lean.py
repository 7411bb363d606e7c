"""The lean of bodies in space, and the tilt from which one on feet does not come back by itself.

A body with tilt t stands on the foot that reaches farthest in the direction d of its lean, seen
along its own axes. Its centroid, a height h above the feet, is then

    h cos t + s(d) sin t,    s(d) = max over the feet of x cos d + y sin d,

above the ground: highest at tan t = s(d)/h. These tilts are the stability surface; of a prism with
half lengths b and c, s = b |cos d| + c |sin d|. The saddle, its lowest place, is over the edge
nearest to the centroid: a body that leans over a corner may still fall over that edge.
"""

from typing import Any, NamedTuple

import numpy as np

from rockeom.integrator.schema import in_space
from rockeom.structures.positions import BODIES, places

_LEVEL = 1e-9
"""Relative to the height of the centroid: feet that differ less are level."""


TILT, DIRECTION, RESERVE = "tilt", "tilt_direction", "reserve"
"""Names of the quantities of a body: behind its own where there are several."""


class Lean(NamedTuple):
    """How a body leans, numbers or (n,): angles [rad].

    tilt : of its axis from the vertical. azimuth : to which it leans, from x of the ground.
    direction : the same along the axes of the body.
    """

    tilt: Any
    azimuth: Any
    direction: Any


def lean_of(place: Any) -> Lean:
    """The lean of a body by the 12 numbers, or arrays, of `places`."""
    r = place[3:]
    tilt = np.arctan2(np.hypot(r[2], r[5]), r[8])
    # 0 - x, since the direction of what is upright is 0, and that of -0 half a turn
    return Lean(tilt, np.arctan2(r[5], r[2]), np.arctan2(0.0 - r[7], 0.0 - r[6]))


def bodies(module: Any) -> dict[str, int]:
    """Numbers of the bodies in space among the places, by name."""
    kinds = zip(module.POSITIONS, module.POSITION_KINDS, strict=True)
    return {n: i for i, (n, kind) in enumerate(kinds) if kind in BODIES and in_space(module)}


def names_of_leans(module: Any) -> dict[int, tuple[str, str]]:
    """Names of the tilt and its direction of each body in space, by its number among places."""
    of = bodies(module)
    names = {i: f"{name.replace(' ', '_')}_" * (len(of) > 1) for name, i in of.items()}
    return {i: (prefix + TILT, prefix + DIRECTION) for i, prefix in names.items()}


def of_leans(module: Any, poses: Any) -> dict[str, Any]:
    """The tilt of each body, its direction and the reserve, by name; poses as of `barrier`.

    reserve : 1 - tilt/barrier, below zero beyond the barrier; of one body on feet.
    """
    quantities: dict[str, Any] = {}
    for i, names in names_of_leans(module).items():
        lean = lean_of(poses[i])
        quantities |= dict(zip(names, lean, strict=False))
    if stands_on_feet(module):
        quantities[RESERVE] = 1.0 - lean.tilt / barrier(module, poses, lean.direction)
    return quantities


def stands_on_feet(module: Any) -> bool:
    """Whether a structure is one body on three feet or more, which nothing else holds."""
    feet = getattr(module, "POINTS", ())
    return len(bodies(module)) == 1 and len(feet) > 2 and not module.ELEMENT_NAMES


def has_barrier(structure: Any) -> bool:
    """Whether a structure stands on feet, which are level."""
    module = structure.module
    if not stands_on_feet(module):
        return False
    (at,) = places(module, np.zeros(1, int), np.zeros((1, module.N_STATES)), structure.vector)
    heights = np.array([arm[2] for arm in _arms(module, at)])
    return bool(np.ptp(heights) <= _LEVEL * abs(heights).max())


def barrier(module: Any, poses: Any, direction: Any) -> Any:
    """The tilt from which a body on feet does not come back, in a direction along its axes [rad].

    poses (m, 12) : its place and those of its feet, of numbers or of arrays (n,), as of `places`.
    """
    steep = [
        (x * np.cos(direction) + y * np.sin(direction)) / -z for x, y, z in _arms(module, poses)
    ]
    return np.arctan(np.max(steep, axis=0) if np.ndim(steep[0]) else max(steep))


def _arms(module: Any, poses: Any) -> list[tuple[Any, ...]]:
    """Places of the feet from the centroid, along the axes of the body."""
    (i,) = bodies(module).values()
    center, turned = poses[i][:3], poses[i][3:]
    arms = []
    for foot in module.POINTS:
        at = poses[module.POSITIONS.index(foot)]
        apart = [at[k] - center[k] for k in range(3)]
        arms.append(tuple(sum(turned[3 * k + j] * apart[k] for k in range(3)) for j in range(3)))
    return arms


def barriers(structure: Any, directions: np.ndarray) -> np.ndarray:
    """The stability surface of a structure that `has_barrier`, see `Structure.overturning_tilts`."""
    module = structure.module
    (at,) = places(module, np.zeros(1, int), np.zeros((1, module.N_STATES)), structure.vector)
    return barrier(module, np.repeat(at[..., None], directions.size, axis=-1), directions)
