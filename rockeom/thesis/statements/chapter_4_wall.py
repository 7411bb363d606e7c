"""Statements of sections 4.2 to 4.6 on the wall and its tendon."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from rockeom.analysis import formulas
from rockeom.thesis.figures.chapter_4_wall import TendonOfTable
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_2
from rockeom.thesis.statements.statement import (
    Found,
    Register,
    at_least,
    at_most,
    closed_form,
    data,
    found,
    near,
    printed,
    ranging,
)

statement = Register()


@statement(
    "4.5", "a maximum displacement of 35.7 mm (1.5 % lateral drift)",
    near([35.7, 1.5], 0.05, why="35.7 mm and 1.5 % to half of the last digit"),
    printed("Table 4-2, run 5"),
)  # fmt: skip
def largest_drift() -> Found:
    displacement = TABLE_4_2.cell("5", "largest displacement")
    drift = 100 * displacement / 1e3 / WALL.height
    return found(
        [displacement, drift], f"{displacement:g} mm, {drift:.2f} % of H = {WALL.height:g} m"
    )


@statement(
    "4.5", "In all the test runs, the wall re-centered to within 0.8 mm",
    at_most(0.8, "mm", why="the printed number"),
    printed("Table 4-2, change of alignment"),
)  # fmt: skip
def residual_displacement() -> Found:
    left = max(map(abs, TABLE_4_2.numbers("change of alignment")))
    return found(left, f"{left:.2f} mm at most")


# --- the tendon of 4.6


@cache
def tendon() -> TendonOfTable:
    return TendonOfTable.fitted()


def fit_of_4_16(rows: np.ndarray) -> tuple[float, float]:
    """R2 of 4-16 over rows of Table A-1, with 4-7 as printed and with 4-7 from the edge."""
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    return tendon().r_squared(WALL, rows), tendon().r_squared(edge, rows)


@statement(
    "4.6", "achieves an R^2 value of 0.927",
    near(0.927, 0.0005, why="half of the last digit"),
    closed_form("4-16"), data("Table A-1, tendon force"),
    figure="4-20", lost="the R2 of the text is of the whole record, of which Table A-1 has points",
)  # fmt: skip
def fit_of_the_tendon_force() -> Found:
    rows, peaks = fit_of_4_16(tendon().legible), fit_of_4_16(tendon().peaks)
    return found(
        rows[0],
        f"{rows[0]:.3f} at all legible rows, {peaks[0]:.3f} at the peaks; {rows[1]:.3f} and "
        f"{peaks[1]:.3f} with 4-7 from the edge",
    )


@statement(
    "4.6", "matches the experimental data adequately",
    at_least(0.927, why="the R2 that the text calls adequate"),
    closed_form("4-16"), data("Table A-1, tendon force"),
    figure="4-20",
)  # fmt: skip
def adequacy_of_the_tendon_force() -> Found:
    of = tendon()
    r_squared, _ = fit_of_4_16(of.legible)
    large = of.peaks & (np.abs(of.displacement) > 6e-3)
    above = (WALL.tendon_force(of.displacement[large]) - of.force[large]) / 1e3
    return found(
        r_squared,
        f"{r_squared:.3f}; yet 4-16 lies {above.min():.1f} to {above.max():.1f} kN above the "
        f"{large.sum()} peaks beyond 6 mm",
    )


@statement(
    "4.6, at 4-16", "the axial stiffness EA/L of the tendon",
    near(WALL.tendons[0].stiffness / 1e6, 0.0, "kN/mm", why="E, A and L of Appendix B"),
    data("Table A-1, tendon force at the peaks"),
    figure="4-20",
)  # fmt: skip
def stiffness_of_the_tendon() -> Found:
    fit, stiffness = tendon().fit, WALL.tendons[0].stiffness / 1e6
    low, high = (stiffness * factor for factor in fit.interval("factor"))
    return ranging(
        [low, high],
        f"{low:.2f} to {high:.2f} kN/mm with 95 % confidence, {100 * fit.values['factor']:.0f} % "
        f"of EA/L, from {fit.values['start'] / 1e3:.1f} kN on; R2 = {fit.r_squared:.3f}",
    )
