"""Units of what is known of a motion, by its structure."""

from __future__ import annotations

from typing import Any


def is_dimensionless(module: Any) -> bool:
    """Whether a structure's states, time and accelerations are pure numbers."""
    return module.STATE_UNITS[module.ROTATION] == "-"


def units_of(module: Any) -> dict[str, str]:
    """Unit of each quantity of a response, by name; 1 where it has none, as in UDUNITS."""
    m = module
    found = dict(zip(m.STATES, m.STATE_UNITS, strict=True))
    found |= dict.fromkeys((*m.ENERGIES, "total_energy"), "J")
    found |= dict.fromkeys(m.REACTIONS, "N") | dict.fromkeys(m.KINEMATICS, "m")
    found |= dict.fromkeys(("ground_acceleration", "vertical_ground_acceleration"), "m/s2")
    if is_dimensionless(m):
        return dict.fromkeys(found, "1")
    return {name: "1" if unit == "-" else unit for name, unit in found.items()}
