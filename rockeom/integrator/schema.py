"""What a generated module offers, and what follows from that alone."""

from __future__ import annotations

from types import ModuleType

SEARCHED = "integrator/transitions/searched.py"
"""The text that searches for the mode that follows, of structures with contact points."""


def has_points(module: ModuleType) -> bool:
    """Whether a structure's contact states are found from its points and elements."""
    return hasattr(module, "POINT_STATES")


def angles(module: ModuleType) -> tuple[float, ...]:
    """1 of each coordinate that is an angle, 0 of others."""
    units = module.STATE_UNITS[: module.N_STATES // 2]
    return tuple(1.0 if unit == "rad" else 0.0 for unit in units)
