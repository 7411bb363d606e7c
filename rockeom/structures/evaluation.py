"""The functions of a generated module at many states at once, where nothing is integrated."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from rockeom.numbers.batch import Differs, Many, values
from rockeom.numbers.functions import of_compounds
from rockeom.numbers.jet import Jet

if TYPE_CHECKING:
    from rockeom.structures.classes import Structure

OF_ELEMENT = {"deformation": "m", "force": "N", "energy": "J"}
"""Quantities of each element, and their units."""


def at_states(
    structure: Structure, function: str, contact: np.ndarray, y: np.ndarray, *given: Any
) -> dict[str, np.ndarray]:
    """What a function of the structure's module says of each of n states, by name, (n,) each.

    function : "energies", "reactions", "kinematics", or "statics", whose names are those of the
    coordinates. contact (n,) : number of the contact state of each; y (n, N). given : what the
    function takes behind the parameters, each a number, or (n,) of them.
    """
    m = structure.module
    names = m.STATES[: m.N_STATES // 2] if function == "statics" else getattr(m, function.upper())
    found = filled(structure, function, len(names), contact, y, *given)
    return dict(zip(names, found, strict=True))


def filled(
    structure: Structure, function: str, size: int, contact: np.ndarray, y: np.ndarray, *given: Any
) -> np.ndarray:
    """(size, n) of what a function of the structure's module fills `out` with; as `at_states`."""
    m, p = structure.module, structure.vector
    found = np.empty((size, len(y)))

    def fill(number: int, rows: np.ndarray) -> None:
        if len(rows) == 1:  # the same bits, sooner
            alone = (float(_of(x, rows)) for x in given)
            getattr(m, function)(number, y[rows[0]], p, *alone, found[:, rows[0]])
            return
        states = np.array([Many(column) for column in y[rows].T], dtype=object)
        out = np.empty(size, dtype=object)
        many = (x if np.ndim(x) == 0 else Many(x[rows]) for x in given)
        getattr(of_compounds(m), function)(number, states, p, *many, out)
        for row, value in zip(found, out, strict=True):
            row[rows] = values(value)

    by_contact(contact, fill)
    return found


def _of(given: Any, rows: np.ndarray) -> Any:
    return given if np.ndim(given) == 0 else given[rows[0]]


def jets(
    structure: Structure, function: str, size: int, contact: np.ndarray, y: np.ndarray,
    rates: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """(3, size, n): what a function of coordinates gives, and its first two rates.

    function : "positions" or "kinematics". rates (N, n) : those of the states y (n, N).
    """
    m, p = structure.module, structure.vector
    n = m.N_STATES // 2
    found = np.empty((3, size, len(y)))

    def fill(number: int, rows: np.ndarray) -> None:
        moving = (y[rows].T[:n], rates[:n, rows], rates[n:, rows])
        others = (Jet(x, 0.0, 0.0) for x in y[rows].T[n:])
        states = np.array([*map(Jet, *moving), *others][: m.N_STATES], dtype=object)
        out = np.empty(size, dtype=object)
        getattr(of_compounds(m), function)(number, states, p, out)
        for i, x in enumerate(out):
            parts = (x.value, x.first, x.second) if isinstance(x, Jet) else (x, 0.0, 0.0)
            for order, part in enumerate(parts):
                found[order, i, rows] = part

    with np.errstate(all="ignore"):  # of what is not finite, it says so
        by_contact(contact, fill)
    return found


def by_contact(contact: np.ndarray, fill: Callable[[int, np.ndarray], None]) -> None:
    """Call fill(contact state, rows) for all rows of each, of those that go the same way."""
    if len(contact) == 1:  # sooner
        fill(int(contact[0]), np.zeros(1, int))
        return
    left = [(int(number), np.flatnonzero(contact == number)) for number in np.unique(contact)]
    while left:  # a function that calls itself would hold all these arrays until garbage is sought
        number, rows = left.pop()
        try:
            fill(number, rows)
        except Differs as ways:
            left += [(number, rows[part]) for part in ways.parts]


def motion_of_places(
    structure: Structure, contact: np.ndarray, y: np.ndarray, ax: Any = 0.0, ay: Any = 0.0
) -> np.ndarray:
    """(3, m, 3, n): x, y and rotation of each of POSITIONS, with their first two rates.

    contact (n,), y (n, N), ax and ay, numbers or (n,), of the ground. Relative to the ground.
    """
    m = structure.module
    rates = filled(structure, "rates", m.N_STATES, contact, y, ax, ay)
    found = jets(structure, "positions", 3 * len(m.POSITIONS), contact, y, rates)
    return found.reshape(3, len(m.POSITIONS), 3, len(y))


def velocities(structure: Structure, contact: np.ndarray, y: np.ndarray) -> dict[str, np.ndarray]:
    """(n, 2) of each place, relative to the ground, by name."""
    found = motion_of_places(structure, contact, y)[1]
    return {n: one[:2].T for n, one in zip(structure.module.POSITIONS, found, strict=True)}


def accelerations(
    structure: Structure, contact: np.ndarray, y: np.ndarray, ax: Any = 0.0, ay: Any = 0.0
) -> dict[str, np.ndarray]:
    """(n, 2) of each place, absolute: with those of the ground, by name."""
    found = motion_of_places(structure, contact, y, ax, ay)[2]
    ground = np.stack(np.broadcast_arrays(ax, ay, y[:, 0])[:2])
    names = structure.module.POSITIONS
    return {n: (one[:2] + ground).T for n, one in zip(names, found, strict=True)}


def elements(structure: Structure, contact: np.ndarray, y: np.ndarray) -> dict[str, np.ndarray]:
    """Deformation, force and energy of each element, (n,) each by name."""
    names = structure.module.ELEMENT_NAMES
    found = filled(structure, "elements", 4 * len(names), contact, y).reshape(len(names), 4, len(y))
    return {
        f"{name}_{what}": value
        for name, values in zip(names, found, strict=True)
        for what, value in zip(OF_ELEMENT, values, strict=False)
    }
