"""The functions of a generated module at many states at once, where nothing is integrated."""

from collections.abc import Callable
from typing import Any

import numpy as np

from rockeom.integrator.schema import GeneratedModule, ground_axes, in_space, still_ground
from rockeom.numbers.batch import Differs, Many, values
from rockeom.numbers.functions import for_arrays, of_compounds
from rockeom.numbers.jet import Jet
from rockeom.structures.positions import size_of_place

OF_ELEMENT = {"deformation": "m", "force": "N", "energy": "J"}
"""Quantities of each element, and their units."""


def at_states(
    m: GeneratedModule, p: np.ndarray, function: str, modes: np.ndarray, y: np.ndarray, *more: Any
) -> dict[str, np.ndarray]:
    """The values of a function of a generated module in each of n states, by name, (n,) each.

    p : parameters and constants. function : "energies", "reactions", "kinematics", or "statics",
    whose names are those of the coordinates. modes (n,) : number of the mode of each state; y
    (n, N). more : further arguments behind the parameters, each a number, or (n,) of them.
    """
    names = m.STATES[: m.N_STATES // 2] if function == "statics" else getattr(m, function.upper())
    values = filled(m, p, function, len(names), modes, y, *more)
    return dict(zip(names, values, strict=True))


def filled(
    m: GeneratedModule, p: np.ndarray, function: str, size: int, modes: np.ndarray, y: np.ndarray,
    *more: Any,
) -> np.ndarray:  # fmt: skip
    """(size, n) that a function of a generated module fills `out` with; as `at_states`."""
    result = np.empty((size, len(y)))

    def fill(number: int, rows: np.ndarray) -> None:
        if len(rows) == 1:  # the same bits, sooner
            alone = (float(x if np.ndim(x) == 0 else x[rows[0]]) for x in more)
            getattr(m, function)(number, y[rows[0]], p, *alone, result[:, rows[0]])
            return
        states = np.array([Many(column) for column in y[rows].T], dtype=object)
        out = np.empty(size, dtype=object)
        many = (x if np.ndim(x) == 0 else Many(x[rows]) for x in more)
        getattr(of_compounds(m), function)(number, states, p, *many, out)
        for row, value in zip(result, out, strict=True):
            row[rows] = values(value)

    by_mode(modes, fill)
    return result


def jets(
    m: GeneratedModule, p: np.ndarray, function: str, size: int, modes: np.ndarray, y: np.ndarray,
    rates: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """(3, size, n): a function of the coordinates, and its first two rates.

    function : "positions" or "kinematics". rates (N, n) : those of the states y (n, N).
    """
    n = m.N_STATES // 2
    result = np.empty((3, size, len(y)))

    def fill(number: int, rows: np.ndarray) -> None:
        moving = (y[rows].T[:n], rates[:n, rows], rates[n:, rows])
        others = (Jet(x, 0.0, 0.0) for x in y[rows].T[n:])
        states = np.array([*map(Jet, *moving), *others][: m.N_STATES], dtype=object)
        out = np.empty(size, dtype=object)
        getattr(of_compounds(m), function)(number, states, p, out)
        for i, x in enumerate(out):
            parts = (x.value, x.first, x.second) if isinstance(x, Jet) else (x, 0.0, 0.0)
            for order, part in enumerate(parts):
                result[order, i, rows] = part

    with np.errstate(all="ignore"):  # what is not finite shows in the result
        by_mode(modes, fill)
    return result


def by_mode(modes: np.ndarray, fill: Callable[[int, np.ndarray], None]) -> None:
    """Call fill(mode, rows) for all rows of each mode, of those that take the same branches."""
    if len(modes) == 1:  # sooner
        fill(int(modes[0]), np.zeros(1, int))
        return
    left = [(int(number), np.flatnonzero(modes == number)) for number in np.unique(modes)]
    while left:  # a function that calls itself would hold all these arrays until garbage is sought
        number, rows = left.pop()
        try:
            fill(number, rows)
        except Differs as ways:
            left += [(number, rows[part]) for part in ways.parts]


def gravity_of(m: Any, p: np.ndarray) -> Any:
    """Gravity in the equations of a module; it has derivatives where parameters have."""
    size = 10 if in_space(m) else 2  # of a mass and its inertia
    out = np.zeros(size * len(m.POSITIONS) + 1, p.dtype)
    last = size * sum(kind in ("body", "massless") for kind in m.POSITION_KINDS)
    for_arrays(m, p).masses(0, np.zeros(m.N_STATES), p, out)
    return out[last]


def motion_of_places(
    m: GeneratedModule, p: np.ndarray, modes: np.ndarray, y: np.ndarray, *ground: Any
) -> np.ndarray:
    """(3, m, k, n): place and rotation of each of POSITIONS, with their first two rates.

    modes (n,), y (n, N). ground : accelerations, numbers or (n,), none where it stands still.
    Relative to the ground; k, `size_of_place`.
    """
    rates = filled(m, p, "rates", m.N_STATES, modes, y, *(ground or still_ground(m)))
    size = size_of_place(m)
    moved = jets(m, p, "positions", size * len(m.POSITIONS), modes, y, rates)
    return moved.reshape(3, len(m.POSITIONS), size, len(y))


def velocities(
    m: GeneratedModule, p: np.ndarray, modes: np.ndarray, y: np.ndarray
) -> dict[str, np.ndarray]:
    """(n, 2) of each place, in space (n, 3), relative to the ground, by name."""
    moved, axes = motion_of_places(m, p, modes, y)[1], len(ground_axes(m))
    return {name: place[:axes].T for name, place in zip(m.POSITIONS, moved, strict=True)}


def accelerations(
    m: GeneratedModule, p: np.ndarray, modes: np.ndarray, y: np.ndarray, *ground: Any
) -> dict[str, np.ndarray]:
    """(n, 2) of each place, in space (n, 3), absolute: with those of the ground, by name."""
    moved, axes = motion_of_places(m, p, modes, y, *ground)[2], len(ground_axes(m))
    added = np.stack(np.broadcast_arrays(*(ground or still_ground(m)), y[:, 0])[:axes])
    return {name: (place[:axes] + added).T for name, place in zip(m.POSITIONS, moved, strict=True)}


def elements(
    m: GeneratedModule, p: np.ndarray, modes: np.ndarray, y: np.ndarray
) -> dict[str, np.ndarray]:
    """Deformation, force and energy of each element, (n,) each by name."""
    names = m.ELEMENT_NAMES
    every = filled(m, p, "elements", 4 * len(names), modes, y).reshape(len(names), 4, len(y))
    return {
        f"{name}_{what}": value
        for name, values in zip(names, every, strict=True)
        for what, value in zip(OF_ELEMENT, values, strict=False)
    }
