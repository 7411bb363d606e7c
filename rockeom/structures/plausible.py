"""Questions about parameters that are allowed and hardly meant, such as lengths and dampings.

Each function returns the sentences of one question, none where the values are plausible. p : the
parameters and constants, plain numbers.
"""

import math

import numpy as np

from rockeom.integrator.schema import GeneratedModule
from rockeom.structures.declared_modes import rocks_on_rigid_ground
from rockeom.structures.modal import Modal, free_states
from rockeom.structures.positions import shapes
from rockeom.structures.units import is_dimensionless

TALLEST = 50.0
"""Size of a body above which its lengths are questioned [m]."""
ON_EARTH = 9.5, 10.1
"""Accelerations of gravity that are not questioned [m/s2]."""
ROUGHEST_SURFACE = 1.5
"""Friction coefficient above which one that is given is questioned."""
LEAST_DAMPING = 1e-3
"""Part of critical damping below which that of a damped column is questioned."""


def parameters(m: GeneratedModule, p: np.ndarray) -> tuple[str, ...]:
    """All questions about the parameters."""
    rows = zip(m.PARAMETERS, m.PARAMETER_UNITS, p.tolist(), strict=False)
    roughest = max((x for name, u, x in rows if "friction" in name and u == "-"), default=0.0)
    return (*size(m, p), *gravity(m, p), *friction(roughest), *damping(m, p))


def size(m: GeneratedModule, p: np.ndarray) -> tuple[str, ...]:
    """Lengths in centimetres or millimetres that were given for metres."""
    if is_dimensionless(m):
        return ()
    rows = zip(m.PARAMETER_UNITS, p, strict=False)
    lengths = [float(value) for unit, value in rows if unit == "m"]
    for corners in shapes(m, p).outlines.values():
        lengths += np.ptp(corners, axis=0).tolist()
    largest = max(lengths, default=0.0)
    if not largest > TALLEST:
        return ()
    return (
        f"The structure measures {largest:.4g} m: were its lengths given in cm or mm? They are in "
        "metres.",
    )


def gravity(m: GeneratedModule, p: np.ndarray) -> tuple[str, ...]:
    """Gravity in other units, or of another planet."""
    g = dict(zip(m.PARAMETERS, p.tolist(), strict=False)).get("gravity", ON_EARTH[0])
    if is_dimensionless(m) or ON_EARTH[0] <= g <= ON_EARTH[1]:
        return ()
    return (f"gravity is {g:.4g} m/s2, and 9.81 on Earth: was it given in another unit?",)


def friction(coefficient: float) -> tuple[str, ...]:
    """A friction coefficient in percent, or an angle of friction in degrees."""
    said = (
        f"friction is {coefficient:.4g}, more than {ROUGHEST_SURFACE:g}, that of rubber on rough "
        "concrete: was it given in percent, or as an angle?",
    )
    return said if coefficient > ROUGHEST_SURFACE else ()


def damping(m: GeneratedModule, p: np.ndarray) -> tuple[str, ...]:
    """A damping ratio that was given for a damping in N s/m."""
    return _of_columns(m, p) or _of_dampers(m, p)


def _of_columns(m: GeneratedModule, p: np.ndarray) -> tuple[str, ...]:
    """A hint by the first mode of vibration on a fixed base."""
    if not rocks_on_rigid_ground(m):
        return ()
    units = zip(m.PARAMETER_UNITS, p, strict=False)
    if not any(unit == "N s/m" and value > 0.0 for unit, value in units):
        return ()
    free = free_states(m, p)
    if not free.any():
        return ()
    held = Modal(m, p, free)
    ratio, period = held.damping_ratios[0], held.periods[0]
    if not 0.0 < ratio < LEAST_DAMPING:
        return ()
    return (
        f"On a fixed base {ratio:.2g} of critical damping remain at {period:.4g} s: was a damping "
        f"ratio given for a damping in N s/m? A ratio of 0.05 takes {0.05 / ratio:.3g} times as "
        "much.",
    )


def _of_dampers(m: GeneratedModule, p: np.ndarray) -> tuple[str, ...]:
    """A hint by the stiffness at each damper and the largest mass: the order of a ratio."""
    units = dict(zip(m.PARAMETERS, m.PARAMETER_UNITS, strict=True))
    values = dict(zip(m.PARAMETERS, p.tolist(), strict=False))
    mass = max((values[name] for name, unit in units.items() if unit == "kg"), default=0.0)
    for name, unit in units.items():
        spring = name.replace("damping", "stiffness")
        if unit != "N s/m" or units.get(spring) != "N/m":
            continue
        critical = 2.0 * math.sqrt(values[spring] * mass)
        if 0.0 < values[name] < LEAST_DAMPING * critical:
            return (
                f"{name} is {values[name]:.4g} N s/m, about {values[name] / critical:.1g} of the "
                f"critical damping of {mass:.4g} kg on {spring}: was a damping ratio given for it? "
                f"A ratio of 0.05 is about {0.05 * critical:.3g} N s/m.",
            )
    return ()
