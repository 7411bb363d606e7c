"""Statements of sections 4.2 to 4.7 and B.2 on the wall, its tendon and its inertia."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rockeom.analysis import formulas, identification
from rockeom.thesis.figures.chapter_4_free_vibration import (
    inertia_over_radius,
    legible,
    tendon_fit,
)
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_2, TENDON
from rockeom.thesis.statements import statement as st
from rockeom.thesis.tables import computed


def largest_drift() -> st.Finding:
    displacement = TABLE_4_2.cell("5", "largest displacement")
    drift = 100 * displacement / 1e3 / WALL.height
    return st.finding(
        [displacement, drift], f"{displacement:g} mm, {drift:.2f} % of H = {WALL.height:g} m"
    )


def change_of_the_tendon_force() -> st.Finding:
    before, after = (TABLE_4_2.numbers(f"tendon force {when}") for when in ("before", "after"))
    change = 100 * float(np.abs(np.array(after) / before - 1).max())
    return st.finding(change, f"by up to {change:.1f} %")


# --- the tendon of 4.6


def fit_of_4_16(rows: np.ndarray) -> tuple[float, ...]:
    """R2 of 4-16 over rows of Table A-1, with 4-7 as printed and with 4-7 from the edge."""
    measured = identification.FreeVibration.table_a1()
    edge = replace(WALL, rotation_centre=formulas.RotationCentre.thesis_edge())
    d, force = measured.displacement[rows], np.asarray(measured.tendon_force)[rows]
    r_squared = identification.coefficient_of_determination
    return tuple(r_squared(force, wall.tendon_force(d)) for wall in (WALL, edge))


def fit_of_the_tendon_force() -> st.Finding:
    at_peak = identification.FreeVibration.table_a1().at_peak
    rows, peaks = fit_of_4_16(legible()), fit_of_4_16(legible() & at_peak)
    return st.finding(
        rows[0],
        f"{rows[0]:.3f} at all legible rows, {peaks[0]:.3f} at the peaks; {rows[1]:.3f} and "
        f"{peaks[1]:.3f} with 4-7 from the edge",
    )


def adequacy_of_the_tendon_force() -> st.Finding:
    measured, fit = identification.FreeVibration.table_a1(), tendon_fit()
    r_squared, _ = fit_of_4_16(legible())
    large = measured.at_peak & legible() & (np.abs(measured.displacement) > 6e-3)
    force = np.asarray(measured.tendon_force)[large]
    above = (WALL.tendon_force(measured.displacement[large]) - force) / 1e3
    least, most = (100 * factor for factor in fit.interval("factor"))
    return st.finding(
        r_squared,
        f"{r_squared:.3f}; yet 4-16 lies {above.min():.1f} to {above.max():.1f} kN above the "
        f"{large.sum()} peaks beyond 6 mm, which ask for {least:.0f} to {most:.0f} % of EA/L from "
        f"{fit.values['start'] / 1e3:.1f} kN on (95 % confidence)",
    )


# --- 4.2, 4.5: the tendon and the tests


def rupture_of_the_tendon() -> st.Finding:
    force = TENDON["rupture"] * TENDON["section"] / 1e3
    return st.finding(force, f"{force:.1f} kN")


def yield_of_the_tendon() -> st.Finding:
    force = TENDON["yield"] * TENDON["section"] / 1e3
    return st.finding(force, f"{force:.1f} kN")


def unbonded_length() -> st.Finding:
    length = 3100 - 1e3 * WALL.tendons[0].initial_extension
    return st.finding(length, f"{length:.2f} mm: less the extension, not plus")


# --- 4.7, B.2: inertia


def fit_of_4_17(inertia: float) -> tuple[float, float]:
    """R2 of 4-17 as `fits_of_quarters` has it, by inertia about the corner [kg m2]."""
    return fits_of_quarters(replace(WALL, inertia=inertia).quarter_period_substitute_gravity)


def fits_of_quarters(predicted: Callable[[np.ndarray], np.ndarray]) -> tuple[float, float]:
    """R2 of quarter periods over the legible quarters of Table A-1 and over all of them.

    predicted : quarter periods [s] of displacements (n,) [m].
    """
    measured = identification.FreeVibration.table_a1()
    rows, chosen = np.flatnonzero(measured.at_peak[:-1]), legible()
    fits = []
    for of in (rows[chosen[rows] & chosen[rows + 1]], rows):
        size, time = np.abs(measured.displacement[of]), np.diff(measured.time)[of]
        fits.append(identification.coefficient_of_determination(time, predicted(size)))
    return float(fits[0]), float(fits[1])


def fit_of_the_quarter_periods() -> st.Finding:
    as_printed, right = fit_of_4_17(13215.0), fit_of_4_17(WALL.corner_inertia)
    return st.ranging(
        as_printed,
        f"{as_printed[0]:.3f} at the 19 legible quarters, {as_printed[1]:.3f} at all 22, with "
        f"13 215 kg m2; {right[0]:.3f} and {right[1]:.3f} with the 12 101 kg m2 of B-9 put right",
    )


def deviation_of_inertia_over_radius() -> st.Finding:
    _, ratio = inertia_over_radius()
    off = 100 * float(np.abs(ratio / ratio[-1] - 1).max())
    return st.finding(off, f"by up to {off:.2f} % from that about the corner")


def reduction_of_the_inertia() -> st.Finding:
    half = WALL.half_width
    lifted = half + WALL.rotation_centre.C1, half
    outermost, middle = (float(WALL.moment_of_inertia(d)) for d in lifted)
    # as printed the added mass is at the distance d, and not d - B, from the centre
    more = [1438.5 * (d**2 - (d - half) ** 2) for d in lifted]
    as_printed = 100 * (1 - (middle + more[1]) / (outermost + more[0]))
    less = 100 * (1 - middle / outermost)
    return st.finding(less, f"{less:.1f} %; B-9 as printed gives {as_printed:.1f} %")


def constant_restitution_of_the_wall() -> st.Finding:
    r = float(computed("2-3")[1][5] or 0.0)
    mass, half, centroid = WALL.mass, WALL.half_width, WALL.centroid_height
    inertia = 686 + 577.56 * (2.743**2 + 4 * half**2) / 3 + 442 + 1438.5 * (2.537**2 + 4 * half**2)
    lost = mass * (half**2 + centroid**2) / inertia * (1 - math.cos(2 * math.atan2(half, centroid)))
    return st.finding(
        r,
        f"{r:.3f}; {(1 - lost) ** 2:.3f} follows from B-9 as printed with a height of 2.743 m "
        "for the wall of 2.438 m",
    )
