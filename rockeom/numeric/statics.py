"""The pushover curve, solved numerically: any structure, any number of other coordinates."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy import optimize

from rockeom.arguments import numbers

if TYPE_CHECKING:
    from rockeom.numeric.structures import Structure


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
    if structure.rocks_on_rigid_ground:
        return _solve(structure, m.CONTACTS.index("right" if side > 0 else "left"), rotation)
    for contact, count in enumerate(m.GUARDS):
        if m.SIDES[contact] * side < 0:
            continue
        force, y = _solve(structure, contact, rotation)
        g = np.zeros(m.N_GUARDS + m.N_PARTS)
        m.guards(contact, y, structure.vector, 0.0, 0.0, g)
        if np.isfinite(force) and g[:count].min() >= -1e-9 * max(1.0, np.abs(g[:count]).max()):
            return force, y
    raise ValueError(f"no equilibrium of {structure.model} at rotation {rotation}")


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

    def forces(unknown: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
        """What all lack of equilibrium without a load and with one, and that load."""
        none, with_load = np.empty(n), np.empty(n)
        m.statics(contact, state(unknown), p, 0.0, none)
        load = 1.0 + abs(none[m.ROTATION])  # one newton might be lost beside the other forces
        m.statics(contact, state(unknown), p, load, with_load)
        return none, with_load, load

    none, with_load, _ = forces(np.zeros(len(others)))
    loaded = m.ROTATION  # the equation that gives the load: one in which it stands
    if with_load[loaded] == none[loaded]:
        loaded = int(np.abs(with_load - none).argmax())
    rest = [i for i in range(n) if i != loaded]

    def lacking(unknown: np.ndarray) -> tuple[np.ndarray, float]:
        """What the other equations lack under the load that satisfies the one."""
        none, with_load, load = forces(unknown)
        share = none[loaded] / (none[loaded] - with_load[loaded])
        return (none + share * (with_load - none))[rest], share * load

    at = np.zeros(len(others))
    if not others:
        return lacking(at)[1], state(at)
    # a metre may be too much or next to nothing: each unknown is counted in the distance at which
    # its own stiffness would restore equilibrium, and each equation likewise
    missing = lacking(at)[0]
    small = 1e-6 * np.eye(len(others))
    stiffness = [
        abs(lacking(e)[0][i] - lacking(-e)[0][i]) / 2e-6 or 1.0 for i, e in enumerate(small)
    ]
    length = np.abs(missing) / stiffness
    length[length == 0.0] = length.max() or 1.0
    found = optimize.root(
        lambda x: lacking(length * x)[0] / (stiffness * length),
        at,
        method="hybr",
        options={"xtol": 1e-13},
    )
    at = length * found.x
    return (lacking(at)[1] if np.abs(found.fun).max() <= 1e-8 else np.nan), state(at)


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
