"""Energies of any structure, by the same functions as in a simulation.

    from rockeom.analysis.identification import static_energy

    static_energy(column, [0.01, 0.02])  # J, at these rotations, above that upright
    static_energy(column, [0.012, 0.023], quantity="displacement")  # at these metres

In a free test a structure is assumed to pass through its states of equilibrium under a force at the
load point: a rigid one has no others, and a column that bends has little energy besides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.arguments import numbers
from rockeom.numbers.checks import near
from rockeom.structures.evaluation import at_states

if TYPE_CHECKING:
    from rockeom.structures.base import Structure


class Energies(NamedTuple):
    """Energies of a structure in states of a record, of one shape.

    Parameters
    ----------
    gravity : ndarray
        Energy of gravity [J].
    elastic : ndarray
        Energy of springs and tendons [J].
    kinetic : ndarray
        Kinetic energy [J].
    """

    gravity: np.ndarray
    elastic: np.ndarray
    kinetic: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Their sum [J]."""
        return self.gravity + self.elastic + self.kinetic


def static_energy(
    structure: Structure, rotation: ArrayLike, quantity: str | None = None
) -> np.ndarray:
    """Energy of a structure at rest at a rotation, above that upright.

    Parameters
    ----------
    structure : Structure
        Structure that rocks.
    rotation : array_like
        The structure's own coordinate, or the quantity, any shape.
    quantity : str, optional
        Name of the quantity, "displacement" or another of a response that grows with the rotation;
        the rotation if not given.

    Returns
    -------
    ndarray
        Energy [J], in the shape of the rotation.

    Raises
    ------
    ValueError
        Where there is no equilibrium or no such quantity.

    Notes
    -----
    It is the gravitational and elastic energy as they are derived; other coordinates are in
    equilibrium under the load of a pushover. It has no energy that a tendon lost by yielding, and
    none of the weight that replaces the tendon of a `SubstituteGravityWall`.
    """
    (values,) = numbers("static_energy", rotation=rotation)
    y = equilibrium_states(structure, values.ravel(), quantity)
    return energies_of_states(structure, y).total.reshape(values.shape)


def energies_of_states(
    structure: Structure, y: np.ndarray, modes: np.ndarray | None = None
) -> Energies:
    """Energies of a structure in states, above those upright and at rest.

    Parameters
    ----------
    structure : Structure
        Structure with N states.
    y : ndarray
        States (n, N).
    modes : ndarray, optional
        Numbers of their modes (n,); they follow from the states if not given.

    Returns
    -------
    Energies
        Energies (n,) each [J].
    """
    if modes is None:
        modes = np.array([structure.mode_number(state) for state in y], dtype=int)
    upright = np.zeros((1, structure.module.N_STATES))
    m, p = structure.module, structure.vector
    still = at_states(m, p, "energies", np.array([structure.mode_number(upright[0])]), upright)
    energies = at_states(m, p, "energies", modes, y)
    kinetic, gravity, elastic = (energies[name] - still[name] for name in structure.module.ENERGIES)
    return Energies(gravity, elastic, kinetic)


def equilibrium_states(
    structure: Structure, values: ArrayLike, quantity: str | None = None
) -> np.ndarray:
    """States of equilibrium under a force at the load point.

    Parameters
    ----------
    structure : Structure
        Structure with N states.
    values : array_like
        Rotations of the structure (n,) [rad], or values of the quantity.
    quantity : str, optional
        Name of the quantity, as in `static_energy`; the rotation if not given.

    Returns
    -------
    ndarray
        States (n, N).

    Raises
    ------
    ValueError
        Where there is no equilibrium or no such quantity.

    Notes
    -----
    Below the value at which the structure uplifts, in full contact, all displacements are in
    proportion to it.
    """
    (wanted,) = numbers("equilibrium_states", values=values)
    m = structure.module
    if quantity in (None, m.STATES[m.ROTATION]):
        return np.array([_equilibrium(structure, x) for x in wanted]).reshape(-1, m.N_STATES)
    path = _Path(structure, quantity or "")
    return np.array([path.at(x) for x in wanted]).reshape(-1, m.N_STATES)


def _equilibrium(structure: Structure, rotation: float) -> np.ndarray:
    return structure.equilibrium(float(rotation))[1]


_LIFTS, _LIFTED = 1e-12, 1e-6
"""Rotations just after uplift, and of so small an uplift that all grows in proportion, in parts of
the overturning rotation."""


class _Path:
    """States of equilibrium of a structure, by the value of one of its quantities."""

    def __init__(self, structure: Structure, quantity: str) -> None:
        self._structure, self._quantity = structure, quantity
        m = structure.module
        self._names = (*m.STATES[: m.N_STATES // 2], *m.KINEMATICS)
        if quantity not in self._names:
            raise ValueError(
                f"no quantity {quantity!r}{near(quantity, self._names)} determines the position of "
                f"{structure.model}; choose among {', '.join(self._names)}"
            )
        rotation = structure.overturning_rotation
        self._overturning = rotation if np.isfinite(rotation) else 1.0

    def at(self, value: float) -> np.ndarray:
        from scipy.optimize import brentq  # takes long to import

        side, size = (1.0 if value > 0 else -1.0), abs(value)
        low = _LIFTS * self._overturning
        lifting = self._state(side * low)
        least = side * self._of(lifting)
        if size <= least:
            return lifting * (size / least)

        def beyond(rotation: float) -> float:
            return side * self._of(self._state(side * rotation)) - size

        little = _LIFTED * self._overturning
        slope = (beyond(little) + size - least) / little
        high = 1.1 * (size - least) / slope + little if slope > 0 else self._overturning
        while not beyond(min(high, self._overturning)) > 0:
            if high >= self._overturning:
                raise ValueError(
                    f"{self._structure.model} overturns before its {self._quantity} is {value}: "
                    "give a smaller one, in SI units"
                )
            high *= 2
        root = brentq(beyond, low, min(high, self._overturning), xtol=1e-16, rtol=1e-13)
        return self._state(side * root)

    def _state(self, rotation: float) -> np.ndarray:
        return _equilibrium(self._structure, rotation)

    def _of(self, y: np.ndarray) -> float:
        m = self._structure.module
        if self._quantity in m.STATES:
            return float(y[m.STATES.index(self._quantity)])
        out = np.empty(len(m.KINEMATICS))
        m.kinematics(self._structure.mode_number(y), y, self._structure.vector, out)
        return float(out[m.KINEMATICS.index(self._quantity)])
