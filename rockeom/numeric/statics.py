"""The pushover curve, solved numerically: any structure, any number of other coordinates."""

from __future__ import annotations

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
        forces[index] = _force(structure, float(rotations[index]))
    return forces


def angles(rotations) -> np.ndarray:
    """Rotations as finite floats; raises TypeError or ValueError where one is none."""
    found = numbers("rotations", rotations)
    if not np.isfinite(found).all():
        raise ValueError(f"rotations hold {found[~np.isfinite(found)][0]}: give finite numbers")
    return found


def _force(structure: Structure, rotation: float) -> float:
    """Equilibrium in the contact state that is consistent with it."""
    m = structure.module
    side = -1.0 if rotation < 0 else 1.0
    if structure.rocks_on_rigid_ground:
        return _solve(structure, m.CONTACTS.index("right" if side > 0 else "left"), rotation)[0]
    for contact, count in enumerate(m.GUARDS):
        if m.SIDES[contact] * side < 0:
            continue
        force, y = _solve(structure, contact, rotation)
        g = np.zeros(m.N_GUARDS + m.N_PARTS)
        m.guards(contact, y, structure.vector, 0.0, 0.0, g)
        if np.isfinite(force) and g[:count].min() >= -1e-9 * max(1.0, np.abs(g[:count]).max()):
            return force
    raise ValueError(f"no equilibrium of {structure.model} at rotation {rotation}")


def _solve(structure: Structure, contact: int, rotation: float) -> tuple[float, np.ndarray]:
    """(force, state): the rotation given, the load and the other coordinates unknown."""
    m, p = structure.module, structure.vector
    n = m.N_STATES // 2
    others = [i for i in range(n) if i != m.ROTATION]

    def state(unknown: np.ndarray) -> np.ndarray:
        y = np.zeros(m.N_STATES)
        y[m.ROTATION] = rotation
        y[others] = unknown[1:]
        return y

    def lacking(unknown: np.ndarray) -> np.ndarray:
        out = np.empty(n)
        m.statics(contact, state(unknown), p, unknown[0], out)
        return out

    # the equations are linear but for small terms: one Newton start from rest suffices
    start = np.zeros(1 + len(others))
    found = optimize.root(lacking, start, method="hybr", options={"xtol": 1e-13})
    size = max(1.0, float(np.abs(lacking(start)).max()))
    if np.abs(found.fun).max() > 1e-8 * size:
        return np.nan, state(found.x)
    return float(found.x[0]), state(found.x)
