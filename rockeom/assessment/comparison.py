"""Checks of codes at each intensity, next to the motions of the records."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rockeom.analysis.standards.check import Check
from rockeom.assessment.words import in_g
from rockeom.numbers.checks import InputError, InputTypeError

Checks = Callable[[float], Sequence[Check]]
"""Gives the checks at a PGA [m/s2]."""

HOW_TO_READ = "Demand over limit, and the verdict of the check."


def checks_at(checks: Checks | None, levels: np.ndarray) -> tuple[tuple[Check, ...], ...]:
    """(m, k) checks at each PGA (m,) [m/s2]; none without a function.

    Raises InputTypeError for anything but a function of PGA that gives checks, and InputError where
    it does not give the same ones at each PGA.
    """
    if checks is None:
        return ()
    rows = [_checks(checks(pga)) if callable(checks) else _checks(checks) for pga in levels]
    first = [one.name for one in rows[0]]
    for pga, row in zip(levels.tolist(), rows, strict=True):
        if [one.name for one in row] != first:
            raise InputError("checks", of="assess").wrong(
                f"gives others at {in_g(pga)} than at {in_g(float(levels[0]))}: give the same ones "
                "at each PGA, in one order"
            )
    return tuple(rows)


def _checks(values: Any) -> tuple[Check, ...]:
    row = tuple(values) if isinstance(values, list | tuple) else ()
    if not row or not all(isinstance(one, Check) for one in row):
        raise InputTypeError("checks", values, "assess").give(
            "a function of PGA that returns a list of checks, such as lambda pga: "
            "[rk.analysis.standards.west_uplift(block, pga)]"
        )
    return row


def rows_of(checks: tuple[tuple[Check, ...], ...]) -> list[tuple[str, ...]]:
    """(k, 1 + m) name of each check, and its result at each PGA."""
    return [(row[0].name, *map(_result, row)) for row in zip(*checks, strict=True)]


def _result(check: Check) -> str:
    if np.isfinite(check.ratio):
        return f"{check.ratio:.2f}, {check.verdict}"
    if np.isfinite(check.demand):
        return f"{check.demand:.3g} {check.unit}, {check.verdict}"
    return check.verdict


def sources_of(checks: tuple[tuple[Check, ...], ...]) -> tuple[str, ...]:
    """Quantity and source of each check."""
    return tuple(
        f"{row[0].name}: {' or '.join(dict.fromkeys(one.quantity for one in row))}. "
        f"Source: {row[0].source}."
        for row in zip(*checks, strict=True)
    )
