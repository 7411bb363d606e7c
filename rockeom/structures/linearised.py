"""The fastest rates of a structure's small motion at rest, by its equations made linear there."""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from rockeom.structures.classes import Structure

_MOST_LINEAR = 16
"""So many contact states are linearised of a structure that has more: its dampers act in all."""

_DAMPED: dict[ModuleType, bool] = {}
"""Whether the small motion of a module's structures may be damped at all, of those asked so far."""


def fastest_damping(structure: Structure) -> float:
    """A rate that no decay of small motion exceeds, see `Structure.fastest_damping`."""
    module = structure.module
    if module not in _DAMPED:  # with all parameters, be some of them zero in this structure
        values = structure.parameters()
        every = np.array([float(values[name]) or 1.0 for name in module.PARAMETERS])
        _DAMPED[module] = _damping(module, module.prepare(every)) != 0.0
    return _damping(module, structure.vector) if _DAMPED[module] else 0.0


def fastest_rates(structure: Structure) -> tuple[float, float]:
    """(motion, decay) of small motion, see `Structure.small_motion`."""
    motion = decay = 0.0
    for matrix in _linear(structure.module, structure.vector, 0):
        for value in np.linalg.eigvals(matrix).tolist():
            if value.real < 0.0 and abs(value.imag) <= -value.real:
                decay = max(decay, -value.real)
            else:
                motion = max(motion, abs(value))
    return motion, decay


def _damping(m: ModuleType, p: np.ndarray) -> float:
    """Size of what the velocities of small motion add to the accelerations [1/s]."""
    n = m.N_STATES // 2
    return max((float(np.linalg.norm(a[n:])) for a in _linear(m, p, n)), default=0.0)


def _linear(m: ModuleType, p: np.ndarray, first: int) -> Iterator[np.ndarray]:
    """(N, N - first) derivatives of the rates at rest by the states from `first` on.

    Of each contact state that has them: points that touch may hold it there by more than one.
    """
    steps = 1e-6 * np.eye(m.N_STATES)[first:]
    forth, back = np.empty((2, *steps.shape))
    for contact in range(min(len(m.MODES), _MOST_LINEAR)):
        try:
            for step, after, before in zip(steps, forth, back, strict=True):
                m.rates(contact, step, p, 0.0, 0.0, after)
                m.rates(contact, -step, p, 0.0, 0.0, before)
        except (ArithmeticError, ValueError):  # beyond the range of numbers, or of a root
            continue
        found = (forth - back).T / 2e-6
        if np.isfinite(found).all():
            yield found
