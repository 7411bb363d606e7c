"""The pushover curve, solved numerically: any structure, any number of other coordinates."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from scipy import optimize

from rockeom.integrator.schema import angles as angles_of
from rockeom.numbers.checks import numbers
from rockeom.structures.contact_modes import Points

if TYPE_CHECKING:
    from rockeom.structures.classes import Structure


def pushover(structure: Structure, rotations) -> np.ndarray:
    """Force at the load point in equilibrium at each rotation; see Structure.pushover."""
    rotations = angles(rotations)
    forces = np.empty(rotations.shape)
    for index in np.ndindex(rotations.shape):
        forces[index] = structure.equilibrium(float(rotations[index]))[0]
    return forces


def angles(rotations) -> np.ndarray:
    """Rotations as finite floats; raises TypeError or ValueError where one is none."""
    found = numbers("rotations", rotations)
    if not np.isfinite(found).all():
        raise ValueError(f"rotations hold {found[~np.isfinite(found)][0]}: give finite numbers")
    return found


def equilibrium(structure: Structure, rotation: float) -> tuple[float, np.ndarray]:
    """(force, state) of equilibrium in the contact state that is consistent with it."""
    m = structure.module
    side = -1.0 if rotation < 0 else 1.0
    if structure.stands_on_points:
        return _on_points(structure, rotation)
    if structure.rocks_on_rigid_ground:
        return _solve(structure, m.MODES.index("right" if side > 0 else "left"), rotation)
    for contact, count in enumerate(m.GUARDS):
        if m.SIDES[contact] * side < 0:
            continue
        force, y = _solve(structure, contact, rotation)
        g = np.zeros(m.N_GUARDS + m.N_PARTS)
        m.guards(contact, y, structure.vector, 0.0, 0.0, g)
        if np.isfinite(force) and g[:count].min() >= -1e-9 * max(1.0, np.abs(g[:count]).max()):
            return force, y
    raise ValueError(f"no equilibrium of {structure.model} at rotation {rotation}")


def _on_points(structure: Structure, rotation: float) -> tuple[float, np.ndarray]:
    """(force, state) of a structure on points that may open: they stick, and give what they can."""
    m, p = structure.module, structure.vector
    n = m.N_STATES // 2
    if len(m.POINTS):
        rotation = rotation or 1e-12  # upright it is the force at which it lifts, to the right
    upright = structure.state({m.STATES[m.ROTATION]: rotation})
    held = _held(structure, upright)
    places = [i for i in range(n - getattr(m, "N_INTERNAL", 0)) if i != m.ROTATION]
    free = [i for i in places if not np.any(held[:, i])]
    tied = [i for i in places if i not in free]

    def state(unknown: np.ndarray) -> np.ndarray:
        named = {m.STATES[i]: x for i, x in zip(free, unknown, strict=True)}
        return _as_it_stood(structure, structure.state({m.STATES[m.ROTATION]: rotation, **named}))

    def statics(y: np.ndarray, load: float) -> np.ndarray:
        """Of the rotation and what is free: virtual work, the tied coordinates moving along."""
        lacking = np.empty(n)
        m.statics(structure.contact(y), y, p, load, lacking)
        rows = _held(structure, y)
        moving = [m.ROTATION, *free]
        along = -np.linalg.lstsq(rows[:, tied], rows[:, moving], rcond=None)[0]
        return lacking[moving] + along.T @ lacking[tied]

    forces = np.zeros(len(m.REACTIONS))
    m.reactions(structure.contact(upright), upright, p, 0.0, 0.0, forces)
    force, y = _balanced(state, statics, len(free), noise=1e-12 * np.abs(forces).sum())
    if not np.isfinite(force):
        raise ValueError(f"no equilibrium of {structure.model} at rotation {rotation}")
    return force, y


def _as_it_stood(structure: Structure, y: np.ndarray) -> np.ndarray:
    """The state moved along, so that the points that touch are where they stood upright."""
    m, p = structure.module, structure.vector
    touching, rows = _touching(structure, y)
    slips = [m.KINEMATICS.index(f"{m.POINTS[i]}_slip") for i in np.flatnonzero(touching)]
    moved = []
    for state in (y, structure.state({})):
        out = np.empty(len(m.KINEMATICS))
        m.kinematics(structure.contact(state), state, p, out)
        moved.append(out[slips])
    lacking = np.concatenate([np.zeros(len(slips)), moved[1] - moved[0]])
    level = np.flatnonzero(np.array(angles_of(m)) == 0.0)
    y = y.copy()
    y[level] += np.linalg.lstsq(rows[:, level], lacking, rcond=None)[0]
    return y


def _held(structure: Structure, y: np.ndarray) -> np.ndarray:
    """(k, n) the directions in which the points that touch in a state hold it."""
    return _touching(structure, y)[1]


def _touching(structure: Structure, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(m,) whether each point touches in a state, and (k, n) the directions in which they hold it.

    Those of all gaps stand before those of all slips.
    """
    points = Points(structure.module, y, structure.vector)
    touching = points.touching().near == 1
    return touching, np.vstack([points.normal[touching], points.tangential[touching]])


def _solve(structure: Structure, contact: int, rotation: float) -> tuple[float, np.ndarray]:
    """(force, state): the rotation given, the load and the other coordinates unknown; nan: none."""
    m, p = structure.module, structure.vector
    n = m.N_STATES // 2
    others = [i for i in range(n) if i != m.ROTATION]

    def state(unknown: np.ndarray) -> np.ndarray:
        y = np.zeros(m.N_STATES)
        y[m.ROTATION] = rotation
        y[others] = unknown
        return y

    def every(y: np.ndarray, load: float) -> np.ndarray:
        lacking = np.empty(n)
        m.statics(contact, y, p, load, lacking)
        return lacking

    upright = state(np.zeros(len(others)))
    acts = every(upright, 1.0 + abs(every(upright, 0.0)[m.ROTATION])) - every(upright, 0.0)
    # the equation that gives the load is one in which it stands
    loaded = m.ROTATION if acts[m.ROTATION] else int(np.abs(acts).argmax())
    rows = [loaded, *(i for i in range(n) if i != loaded)]

    def statics(y: np.ndarray, load: float) -> np.ndarray:
        return every(y, load)[rows]

    return _balanced(state, statics, len(others))


def _balanced(
    state: Callable[[np.ndarray], np.ndarray],
    statics: Callable[[np.ndarray, float], np.ndarray],
    unknowns: int,
    noise: float = 0.0,
) -> tuple[float, np.ndarray]:
    """(force, state) in equilibrium; nan where none was found.

    state : of the unknowns; statics : what is lacking of equilibrium in a state under a load, first
    in the equation that gives the load, which is that of the rotation where the load acts on it.
    noise : what is left by rounding where large forces balance [N].
    """

    def lacking(unknown: np.ndarray) -> tuple[np.ndarray, float]:
        """What the other equations lack under the load that satisfies the first."""
        y = state(unknown)
        none = statics(y, 0.0)
        load = 1.0 + abs(none[0])  # one newton might be lost beside the other forces
        with_load = statics(y, load)
        share = none[0] / (none[0] - with_load[0])
        return (none + share * (with_load - none))[1:], share * load

    at = np.zeros(unknowns)
    if not unknowns:
        return lacking(at)[1], state(at)
    # a metre may be too much or next to nothing: each unknown is counted in the distance at which
    # its own stiffness would restore equilibrium, and each equation likewise
    missing = lacking(at)[0]
    missing[np.abs(missing) <= noise] = 0.0
    small = 1e-6 * np.eye(unknowns)
    stiffness = [
        abs(lacking(e)[0][i] - lacking(-e)[0][i]) / 2e-6 or 1.0 for i, e in enumerate(small)
    ]
    length = np.abs(missing) / stiffness
    length[length <= (1e-6 * length.max() if noise else 0.0)] = length.max() or 1.0
    found = optimize.root(
        lambda x: lacking(length * x)[0] / (stiffness * length),
        at,
        method="hybr",
        options={"xtol": 1e-13},
    )
    at = length * found.x
    left = np.abs(found.fun)
    done = (left <= 1e-8) | (left * stiffness * length <= noise)
    return (lacking(at)[1] if done.all() else np.nan), state(at)


def uplift_acceleration(structure: Structure) -> float:
    """Ground acceleration at which the force on a foot vanishes; see the structure's own.

    Unknown are the acceleration and the coordinates that are free in full contact. Their equations
    are linear, but for small terms: Newton's method from standing.
    """
    m, p = structure.module, structure.vector
    n = m.N_STATES // 2
    contact = structure.contact(np.zeros(m.N_STATES))
    free = [i for i in range(n) if i != m.ROTATION]
    steps = np.array([1.0, *(1e-3 for _ in free)])

    def lacking(unknown: np.ndarray, foot: int) -> np.ndarray:
        y, rates, forces = np.zeros(2 * n), np.zeros(2 * n), np.zeros(len(m.REACTIONS))
        y[free] = unknown[1:]
        m.rates(contact, y, p, unknown[0], 0.0, rates)
        m.reactions(contact, y, p, unknown[0], 0.0, forces)
        return np.array([forces[foot], *rates[[n + i for i in free]]])

    def lifts(foot: int) -> float:
        unknown = np.zeros(1 + len(free))
        for _ in range(50):
            value = lacking(unknown, foot)
            slopes = np.transpose(
                [(lacking(unknown + h, foot) - value) / h.max() for h in np.diag(steps)]
            )
            # a coordinate that is held has no equation, and stays
            kept: np.ndarray = np.abs(slopes).max(axis=1) > 0.0
            kept[0] = True
            change = np.zeros_like(unknown)
            try:
                change[kept] = np.linalg.solve(slopes[np.ix_(kept, kept)], -value[kept])
            except np.linalg.LinAlgError:
                return math.inf  # all its mass is on the ground
            unknown += change
            if abs(change[0]) <= 1e-13 * abs(unknown[0]):
                break
        return abs(float(unknown[0]))

    return min(lifts(m.REACTIONS.index(f"{foot}_reaction")) for foot in ("left", "right"))
