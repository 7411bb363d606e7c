"""The checks of each equation, by its number."""

from __future__ import annotations

from rockeom.thesis.checks import (
    appendix_b,
    appendix_d,
    approximations,
    chapter_2,
    chapter_3,
    chapter_4,
    chapter_5,
    engine,
    section_2_6,
)
from rockeom.thesis.checks.check import Check, Finding, Means, close, vanishes

__all__ = ["CHECKS", "Check", "Finding", "Means", "close", "vanishes"]


def _all() -> dict[str, tuple[Check, ...]]:
    found: dict[str, tuple[Check, ...]] = {}
    chapters = chapter_2, section_2_6, chapter_3, chapter_4, chapter_5, appendix_b, appendix_d
    for module in (engine, approximations, *chapters):
        for number, check in module.CHECKS.items():
            checks = check if isinstance(check, tuple) else (check,)
            found[number] = (*found.get(number, ()), *checks)
    return found


CHECKS = _all()
