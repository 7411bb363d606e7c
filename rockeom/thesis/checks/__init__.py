"""The checks of each equation, by its number."""

from importlib import import_module

from rockeom.thesis.checks.check import Check, Finding, Means, close, vanishes

__all__ = ["CHECKS", "Check", "Finding", "Means", "close", "vanishes"]

_MODULES = (
    "engine approximations chapter_2 section_2_6 chapter_3 chapter_4_geometry "
    "chapter_4_free_vibration chapter_4_oscillator shipped_walls "
    "chapter_5 appendix_d"
)
"""The modules of checks, in the order of the checks of an equation."""


def _all() -> dict[str, tuple[Check, ...]]:
    by_number: dict[str, tuple[Check, ...]] = {}
    for name in _MODULES.split():
        for number, check in import_module(f"{__name__}.{name}").CHECKS.items():
            checks = check if isinstance(check, tuple) else (check,)
            by_number[number] = (*by_number.get(number, ()), *checks)
    return by_number


CHECKS = _all()
