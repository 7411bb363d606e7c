"""Questions about parameters that are allowed and hardly meant: lengths and dampings.

Each function returns the sentences of one question, none where the values are plausible.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from rockeom.structures.units import is_dimensionless

if TYPE_CHECKING:
    from rockeom.structures.classes import Structure

TALLEST = 50.0
"""Size of a body above which its lengths are questioned [m]."""
LEAST_DAMPING = 1e-3
"""Part of critical damping below which that of a damped column is questioned."""


def size(structure: Structure) -> tuple[str, ...]:
    """Lengths in centimetres or millimetres that were given for metres."""
    if is_dimensionless(structure.module) or structure.vector.dtype != float:
        return ()
    rows = zip(structure.module.PARAMETER_UNITS, structure.vector, strict=False)
    lengths = [float(value) for unit, value in rows if unit == "m"]
    for corners in structure.shapes.outlines.values():
        lengths += np.ptp(corners, axis=0).tolist()
    largest = max(lengths, default=0.0)
    if not largest > TALLEST:
        return ()
    return (
        f"The structure measures {largest:.4g} m: were its lengths given in cm or mm? They are in "
        "metres.",
    )


def damping(structure: Structure) -> tuple[str, ...]:
    """A damping ratio that was given for a damping in N s/m."""
    if structure.vector.dtype != float:
        return ()
    return _of_columns(structure) or _of_dampers(structure)


def _of_columns(structure: Structure) -> tuple[str, ...]:
    """By the first mode on a fixed base."""
    if not structure.rocks_on_rigid_ground:
        return ()
    units = zip(structure.module.PARAMETER_UNITS, structure.vector, strict=False)
    if not any(unit == "N s/m" and value > 0.0 for unit, value in units):
        return ()
    try:
        held = structure.fixed_base()
    except ValueError:  # nothing moves on a fixed base
        return ()
    ratio, period = held.damping_ratios[0], held.periods[0]
    if not 0.0 < ratio < LEAST_DAMPING:
        return ()
    return (
        f"On a fixed base {ratio:.2g} of critical damping remain at {period:.4g} s: was a damping "
        f"ratio given for a damping in N s/m? A ratio of 0.05 takes {0.05 / ratio:.3g} times as "
        "much.",
    )


def _of_dampers(structure: Structure) -> tuple[str, ...]:
    """By the stiffness beside each damper and the largest mass, which tell the order of a ratio."""
    module = structure.module
    units = dict(zip(module.PARAMETERS, module.PARAMETER_UNITS, strict=True))
    values = dict(zip(module.PARAMETERS, structure.vector.tolist(), strict=False))
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
