"""The fastest rates of a structure's small motion at rest, by its equations made linear there."""

from collections.abc import Iterator, Mapping

import numpy as np

from rockeom.integrator.schema import GeneratedModule, is_by_code, still_ground

_MOST_LINEAR = 16
"""Number of modes that are linearised, at most: dampers of a structure with more act in all."""

_DAMPED: dict[str, bool] = {}
"""Whether the small motion of structures may be damped at all, by the name of their module."""


def fastest_damping(
    module: GeneratedModule, p: np.ndarray, parameters: Mapping[str, float]
) -> float:
    """A rate that no decay of small motion exceeds, see `Structure.fastest_damping`."""
    name = module.__name__
    if name not in _DAMPED:  # with all parameters, be some of them zero in this structure
        every = np.array([float(parameters[name]) or 1.0 for name in module.PARAMETERS])
        _DAMPED[name] = _damping(module, module.prepare(every)) != 0.0
    return _damping(module, p) if _DAMPED[name] else 0.0


def fastest_rates(module: GeneratedModule, p: np.ndarray) -> tuple[float, float]:
    """(motion, decay) of small motion, see `Structure.small_motion`."""
    motion = decay = 0.0
    for matrix in _linear(module, p, 0):
        for value in np.linalg.eigvals(matrix).tolist():
            if value.real < 0.0 and abs(value.imag) <= -value.real:
                decay = max(decay, -value.real)
            else:
                motion = max(motion, abs(value))
    return motion, decay


def _damping(m: GeneratedModule, p: np.ndarray) -> float:
    """Size of the accelerations by the velocities of small motion [1/s]."""
    n = m.N_STATES // 2
    return max((float(np.linalg.norm(a[n:])) for a in _linear(m, p, n)), default=0.0)


def _linear(m: GeneratedModule, p: np.ndarray, first: int) -> Iterator[np.ndarray]:
    """(N, N - first) derivatives of the rates at rest by the states from `first` on.

    Modes whose points hold the structure by more than is needed have none, and are left out. In
    space flight is the only one: at rest a slip has no direction.
    """
    modes = 1 if is_by_code(m) else min(len(m.MODES), _MOST_LINEAR)
    steps = 1e-6 * np.eye(m.N_STATES)[first:]
    forth, back = np.empty((2, *steps.shape))
    for mode in range(modes):
        try:
            # upright a round base has no inertia against a precession
            with np.errstate(all="ignore"):
                for step, after, before in zip(steps, forth, back, strict=True):
                    m.rates(mode, step, p, *still_ground(m), after)
                    m.rates(mode, -step, p, *still_ground(m), before)
        except (ArithmeticError, ValueError):  # beyond the range of numbers, or of a root
            continue
        derivatives = (forth - back).T / 2e-6
        if np.isfinite(derivatives).all():
            yield derivatives
