"""The functions of a generated module at many states at once, where nothing is integrated."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rockeom.many import Differs, Many, of_many, values

if TYPE_CHECKING:
    from rockeom.numeric.structures import Structure


def at_states(
    structure: Structure, function: str, contact: np.ndarray, y: np.ndarray, *given: float
) -> dict[str, np.ndarray]:
    """What a function of the structure's module says of each of n states, by name, (n,) each.

    function : "energies", "reactions", "kinematics", or "statics", whose names are those of the
    coordinates. contact (n,) : number of the contact state of each; y (n, N). given : what the
    function takes behind the parameters.
    """
    m = structure.module
    names = m.STATES[: m.N_STATES // 2] if function == "statics" else getattr(m, function.upper())
    found = np.empty((len(names), len(y)))

    def fill(rows: np.ndarray) -> None:
        number = int(contact[rows[0]])
        if len(rows) == 1:  # the same bits, sooner
            getattr(m, function)(number, y[rows[0]], structure.vector, *given, found[:, rows[0]])
            return
        states = np.array([Many(column) for column in y[rows].T], dtype=object)
        out = np.empty(len(names), dtype=object)
        try:
            getattr(of_many(m), function)(number, states, structure.vector, *given, out)
        except Differs as ways:  # states that do not go the same way through a function
            for part in ways.parts:
                fill(rows[part])
            return
        for row, value in zip(found, out, strict=True):
            row[rows] = values(value)

    for number in np.unique(contact):
        fill(np.flatnonzero(contact == number))
    return dict(zip(names, found, strict=True))
