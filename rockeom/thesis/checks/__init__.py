"""The checks of each equation, by its number."""

from rockeom.thesis.checks import (
    appendix_b,
    appendix_d,
    approximations,
    chapter_2,
    chapter_3,
    chapter_4_free_vibration,
    chapter_4_geometry,
    chapter_4_oscillator,
    chapter_4_substitute_gravity,
    chapter_5,
    engine,
    section_2_6,
    shipped_walls,
)
from rockeom.thesis.checks.check import Check, Finding, Means, close, vanishes

__all__ = ["CHECKS", "Check", "Finding", "Means", "close", "vanishes"]

_MODULES = (
    engine,
    approximations,
    chapter_2,
    section_2_6,
    chapter_3,
    chapter_4_geometry,
    chapter_4_free_vibration,
    chapter_4_oscillator,
    chapter_4_substitute_gravity,
    shipped_walls,
    chapter_5,
    appendix_b,
    appendix_d,
)


def _all() -> dict[str, tuple[Check, ...]]:
    by_number: dict[str, tuple[Check, ...]] = {}
    for module in _MODULES:
        for number, check in module.CHECKS.items():
            checks = check if isinstance(check, tuple) else (check,)
            by_number[number] = (*by_number.get(number, ()), *checks)
    return by_number


CHECKS = _all()
