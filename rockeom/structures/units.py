"""Units of the quantities of a motion, by its structure."""

from collections.abc import Mapping
from typing import Any

from rockeom.integrator.schema import ground_axes


def is_dimensionless(module: Any) -> bool:
    """Whether a structure's states, time and accelerations are pure numbers."""
    return module.STATE_UNITS[module.ROTATION] == "-"


def ground_accelerations(module: Any) -> tuple[str, ...]:
    """Names of the components of the ground's acceleration, in the order of the equations."""
    names = (f"{axis}_ground_acceleration" for axis in ground_axes(module))
    return tuple(name.removeprefix("horizontal_") for name in names)


def main_units(module: Any) -> dict[str, str]:
    """Units of the values of compiled functions by name, states first; "-" for pure numbers."""
    units = dict(zip(module.STATES, module.STATE_UNITS, strict=True))
    units |= dict.fromkeys((*module.ENERGIES, "total_energy"), "J")
    units |= dict.fromkeys(module.REACTIONS, "N") | dict.fromkeys(module.KINEMATICS, "m")
    units |= dict.fromkeys(ground_accelerations(module), "m/s2")
    return dimensioned(module, units)


def dimensioned(module: Any, units: Mapping[str, str]) -> dict[str, str]:
    """The units, of a structure that has some."""
    return dict.fromkeys(units, "-") if is_dimensionless(module) else dict(units)


def time_unit(module: Any) -> str:
    return "-" if is_dimensionless(module) else "s"


def with_unit(name: str, unit: str) -> str:
    """A heading: the name and, where there is one, the unit."""
    return f"{name} [{unit}]" if unit else name


def in_udunits(unit: str) -> str:
    """The unit in tables with the CF conventions: 1 where there is none."""
    return "1" if unit == "-" else unit
