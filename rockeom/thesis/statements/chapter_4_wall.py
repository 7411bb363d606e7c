"""Statements of sections 4.2 to 4.7 and B.2 on the wall, its tendon and its inertia."""

import math
from dataclasses import replace
from functools import cache

import numpy as np

from rockeom.analysis import formulas, identification
from rockeom.thesis.figures.chapter_4_free_vibration import inertia_over_radius
from rockeom.thesis.figures.chapter_4_wall import TendonOfTable
from rockeom.thesis.free_vibration_table import WALL
from rockeom.thesis.printed import TABLE_4_2, TENDON
from rockeom.thesis.statements import statement as st
from rockeom.thesis.tables import computed

statement = st.Register()


@statement(
    "4.5", "a maximum displacement of 35.7 mm (1.5 % lateral drift)",
    st.rounded("35.7", "1.5", why="35.7 mm and 1.5 % to half of the last digit"),
    st.printed("Table 4-2, run 5"),
)  # fmt: skip
def largest_drift() -> st.Finding:
    displacement = TABLE_4_2.cell("5", "largest displacement")
    drift = 100 * displacement / 1e3 / WALL.height
    return st.finding(
        [displacement, drift], f"{displacement:g} mm, {drift:.2f} % of H = {WALL.height:g} m"
    )


@statement(
    "4.5", "In all the test runs, the wall re-centered to within 0.8 mm",
    st.at_most(0.8, "mm", why="the printed number"),
    st.printed("Table 4-2, change of alignment"),
)  # fmt: skip
def residual_displacement() -> st.Finding:
    left = max(map(abs, TABLE_4_2.numbers("change of alignment")))
    return st.finding(left, f"{left:.2f} mm at most")


@statement(
    "4.5", "After each test run, the tendon returned to approximately the same tension force",
    st.at_most(10.0, "%", why="approximately: 10 %, change of the force"),
    st.printed("Table 4-2, tendon force before and after"),
)  # fmt: skip
def change_of_the_tendon_force() -> st.Finding:
    before, after = (TABLE_4_2.numbers(f"tendon force {when}") for when in ("before", "after"))
    change = 100 * float(np.abs(np.array(after) / before - 1).max())
    return st.finding(change, f"by up to {change:.1f} %")


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
    st.rounded("0.927"),
    st.closed_form("4-16"), st.data("Table A-1, tendon force"),
    figure="4-20", lost="the R2 of the text is of the whole record, of which Table A-1 has points",
)  # fmt: skip
def fit_of_the_tendon_force() -> st.Finding:
    rows, peaks = fit_of_4_16(tendon().legible), fit_of_4_16(tendon().peaks)
    return st.finding(
        rows[0],
        f"{rows[0]:.3f} at all legible rows, {peaks[0]:.3f} at the peaks; {rows[1]:.3f} and "
        f"{peaks[1]:.3f} with 4-7 from the edge",
    )


@statement(
    "4.6", "matches the experimental data adequately",
    st.at_least(0.927, why="the R2 that the text calls adequate"),
    st.closed_form("4-16"), st.data("Table A-1, tendon force"),
    figure="4-20",
)  # fmt: skip
def adequacy_of_the_tendon_force() -> st.Finding:
    of = tendon()
    r_squared, _ = fit_of_4_16(of.legible)
    large = of.peaks & (np.abs(of.displacement) > 6e-3)
    above = (WALL.tendon_force(of.displacement[large]) - of.force[large]) / 1e3
    return st.finding(
        r_squared,
        f"{r_squared:.3f}; yet 4-16 lies {above.min():.1f} to {above.max():.1f} kN above the "
        f"{large.sum()} peaks beyond 6 mm",
    )


@statement(
    "4.6, at 4-16", "the axial stiffness EA/L of the tendon",
    st.near(WALL.tendons[0].stiffness / 1e6, 0.0, "kN/mm", why="E, A and L of Appendix B"),
    st.data("Table A-1, tendon force at the peaks"),
    figure="4-20",
)  # fmt: skip
def stiffness_of_the_tendon() -> st.Finding:
    fit, stiffness = tendon().fit, WALL.tendons[0].stiffness / 1e6
    low, high = (stiffness * factor for factor in fit.interval("factor"))
    return st.ranging(
        [low, high],
        f"{low:.2f} to {high:.2f} kN/mm with 95 % confidence, {100 * fit.values['factor']:.0f} % "
        f"of EA/L, from {fit.values['start'] / 1e3:.1f} kN on; R2 = {fit.r_squared:.3f}",
    )


# --- 4.2, 4.5: the tendon and the tests


@statement(
    "4.2", "a specific rupture strength of 195 kN",
    st.rounded("195", unit="kN"),
    st.printed("4.2, 1100 MPa and 177 mm2"),
)  # fmt: skip
def rupture_of_the_tendon() -> st.Finding:
    force = TENDON["rupture"] * TENDON["section"] / 1e3
    return st.finding(force, f"{force:.1f} kN")


@statement(
    "4.2", "a yield strength of 160 kN",
    st.near(160.0, 5.0, "kN", why="half of the last digit that is not zero"),
    st.printed("4.2, 900 MPa and 177 mm2"),
)  # fmt: skip
def yield_of_the_tendon() -> st.Finding:
    force = TENDON["yield"] * TENDON["section"] / 1e3
    return st.finding(force, f"{force:.1f} kN")


@statement(
    "4.5", "The post-tensioning tendon remained elastic throughout the tests",
    st.at_most(WALL.tendons[0].yield_force / 1e3, "kN", why="the force at which the tendon yields"),
    st.printed("Table 4-2, largest tendon force"),
)  # fmt: skip
def largest_tendon_force() -> st.Finding:
    largest = max(TABLE_4_2.numbers("largest tendon force"))
    return st.finding(largest, f"{largest:.1f} kN at most")


@statement(
    "4.6, at 4-16", "the initial unbonded length of the tendon, 3106.6 mm",
    st.rounded("3106.6", unit="mm"),
    st.closed_form("3100 mm between the anchors, less the extension by the initial force"),
    slip=True,
)  # fmt: skip
def unbonded_length() -> st.Finding:
    length = 3100 - 1e3 * WALL.tendons[0].initial_extension
    return st.finding(length, f"{length:.2f} mm: less the extension, not plus")


# --- 4.7, B.2: inertia


def fit_of_4_17(inertia: float) -> float:
    """R2 of 4-17 over all quarters of Table A-1, with a moment of inertia about the corner."""
    measured = identification.FreeVibration.table_a1()
    rows = np.flatnonzero(measured.at_peak[:-1])
    wall = replace(WALL, inertia=inertia)
    predicted = wall.quarter_period_substitute_gravity(np.abs(measured.displacement[rows]))
    return identification.coefficient_of_determination(np.diff(measured.time)[rows], predicted)


@statement(
    "4.7", "this is supported by an R^2 value of 0.911",
    st.near(0.911, 0.0015, why="half of the last digit, and one digit of the times of Table A-1"),
    st.closed_form("4-17 with B-9 as printed, 13 215 kg m2"), st.data("Table A-1, 22 quarters"),
    figure="4-24",
)  # fmt: skip
def fit_of_the_quarter_periods() -> st.Finding:
    as_printed, right = fit_of_4_17(13215.0), fit_of_4_17(WALL.corner_inertia)
    return st.finding(
        as_printed,
        f"{as_printed:.3f} with 13 215 kg m2, {right:.3f} with the 12 101 kg m2 of B-9 put right: "
        "the figure has the inertia as printed",
    )


@statement(
    "4.7", "maximum deviation of I_0 divided by R is less than 2%",
    st.at_most(2.0, "%", why="the printed number"),
    st.closed_form("B-9 put right, over R from the centre to the centroid"),
    figure="4-22b",
)  # fmt: skip
def deviation_of_inertia_over_radius() -> st.Finding:
    _, ratio = inertia_over_radius()
    off = 100 * float(np.abs(ratio / ratio[-1] - 1).max())
    return st.finding(off, f"by up to {off:.2f} % from that about the corner")


@statement(
    "B.2", "the maximum effect of this is only a 3% reduction",
    st.rounded("3", unit="%"),
    st.closed_form("B-9 put right, from the outermost centre of 4-7 to the centreline"),
)  # fmt: skip
def reduction_of_the_inertia() -> st.Finding:
    half = WALL.half_width
    lifted = half + WALL.rotation_centre.C1, half
    outermost, middle = (float(WALL.moment_of_inertia(d)) for d in lifted)
    # as printed the added mass is at the distance d, and not d - B, from the centre
    more = [1438.5 * (d**2 - (d - half) ** 2) for d in lifted]
    as_printed = 100 * (1 - (middle + more[1]) / (outermost + more[0]))
    less = 100 * (1 - middle / outermost)
    return st.finding(less, f"{less:.1f} %; B-9 as printed gives {as_printed:.1f} %")


@statement(
    "4.9.1.4, Figure 4-79", "constant r of 0.852",
    st.rounded("0.852", why="half of the last digit, as r of 2-6 about the corner"),
    st.closed_form("2-6 with B-9 put right"),
    slip=True,
)  # fmt: skip
def constant_restitution_of_the_wall() -> st.Finding:
    r = float(computed("2-3")[1][5] or 0.0)
    mass, half, centroid = WALL.mass, WALL.half_width, WALL.centroid_height
    inertia = 686 + 577.56 * (2.743**2 + 4 * half**2) / 3 + 442 + 1438.5 * (2.537**2 + 4 * half**2)
    lost = mass * (half**2 + centroid**2) / inertia * (1 - math.cos(2 * math.atan2(half, centroid)))
    return st.finding(
        r,
        f"{r:.3f}, as in 4.9.2.1; {(1 - lost) ** 2:.3f} follows from B-9 as printed with a height "
        "of 2.743 m, that of the wall being 2.438 m",
    )
