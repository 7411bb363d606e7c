"""Statements of chapter 2: restitution, uplift, non-linear dynamics, impacts as forces."""

from __future__ import annotations

import math

import numpy as np

import rockeom as rk
from rockeom.analysis import formulas
from rockeom.analysis.sweeps import STANDS
from rockeom.motion import STANDARD_GRAVITY
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.figures import chapter_2 as forces, chapter_2_blocks as blocks
from rockeom.thesis.printed import BLOCK, TABLE_2_1, TABLE_2_3
from rockeom.thesis.statements.statement import (
    Found,
    Register,
    at_least,
    at_most,
    between,
    closed_form,
    found,
    near,
    printed,
    ranging,
    simulation,
)
from rockeom.thesis.tables import computed

statement = Register()


# --- 2.2 restitution


def _errors_of_2_6() -> tuple[np.ndarray, np.ndarray]:
    """Slenderness H/B and measured less computed r of each row of Table 2-1."""
    ratio, measured = (np.array(TABLE_2_1.numbers(name)) for name in ("H/B", "measured r"))
    return ratio, measured - formulas.energy_ratio_of_block(np.arctan(1 / ratio))


@statement(
    "2.2", "experimental r values in general exceed those predicted by Equation 2-6",
    at_least(5, "rows of 8", why="in general: more than half"),
    closed_form("2-6"), printed("Table 2-1, experimental r"),
    figure="2-2",
)  # fmt: skip
def measured_ratios_above_2_6() -> Found:
    _, error = _errors_of_2_6()
    above = int((error > 0).sum())
    return found(above, f"{above} of {len(error)} rows")


@statement(
    "2.2", "the inconsistencies diminish as the slenderness of the block is increased",
    at_most(1.0, why="mean error of slender blocks over that of squat ones"),
    closed_form("2-6"), printed("Table 2-1, experimental r"),
    figure="2-2",
)  # fmt: skip
def errors_of_slender_blocks() -> Found:
    ratio, error = _errors_of_2_6()
    squat, slim = (float(np.abs(error[of]).mean()) for of in (ratio <= 4, ratio > 4))
    return found(slim / squat, f"mean error {squat:.3f} up to H/B = 4, {slim:.3f} beyond")


# --- 2.4 flexible structures and foundations


@statement(
    "2.4.1", "an effective damping ratio close to 0.5",
    near(0.5, 0.05, why="close to: 10 %"),
    closed_form("2-8b"),
)  # fmt: skip
def damping_of_the_uplifted_column() -> Found:
    ratio = float(formulas.uplifted_damping(0.05, 1.0, 10.0))
    return found(ratio, f"{ratio:.3f} for 0.05 and H/B = 10")


@statement(
    "2.4.1", "The long period motion tends to alternate between the \N{PLUS-MINUS SIGN}u_c",
    near(1.0, 0.1, "u_c", why="10 % of the critical deformation"),
    simulation("2-7 released as under Figure 2-6"),
    figure="2-6",
    lost="the deformation at the release and the meaning of theta_crit are not stated",
)  # fmt: skip
def mean_deformation_while_uplifted() -> Found:
    omega, height, half_width = 56.10, 1.0, 0.3
    u_c = float(formulas.uplift.uplift_displacement(omega, half_width, height))
    structure = rk.UpliftingOscillator.from_frequency(
        angular_frequency=omega, damping_ratio=0.03, height=height, half_width=half_width
    )
    run = rk.simulate(
        structure, rk.GroundMotion.none(2.0), impact=rk.Impulsive(),
        initial={"theta": 0.05 * math.atan(half_width / height), "u": u_c},
    )  # fmt: skip
    first = run.impacts[0].time
    t = np.linspace(0.0, first, 2001)
    mean = float(abs(np.mean(run.at(t)["u"]))) / u_c
    return found(mean, f"{mean:.2f} u_c on average until the first impact")


@statement(
    "2.4.2", "the lengthening of fundamental period (T_l) of the rocking system is a function of "
    "the uplift",
    at_least(1.0, why="secant period at three times the rotation of the uplift over that before"),
    closed_form("moment of two springs, Figure 2-8"),
)  # fmt: skip
def lengthening_of_the_period() -> Found:
    lifts = float(formulas.foundation.two_spring_uplift_rotation(1.0, 0.5, 1.0))
    rotations = lifts * np.array([1.0, 2.0, 3.0])
    moment = formulas.foundation.two_spring_moment(rotations, 1.0, 0.5, 1.0)
    periods = np.sqrt(rotations / moment)
    longer = periods / periods[0]
    return found(
        float(longer[-1]),
        f"the secant period is {longer[1]:.2f} and {longer[2]:.2f} times that before at twice and "
        "three times the rotation at which a spring is free",
    )


@statement(
    "2.4.2", "the mode shapes and ratio of natural vibration modes do not change",
    near(1.0, 0.1, why="do not change: 10 %"),
    simulation("small vibration of a two-storey frame on two springs"),
    lost="the third finding of the same list denies it: T_1 changes and T_2 does not",
)  # fmt: skip
def ratio_of_periods_with_uplift() -> Found:
    whole, lifted = (_periods_of_frame(lifted) for lifted in (False, True))
    ratio = float((lifted[0] / lifted[1]) / (whole[0] / whole[1]))
    return found(
        ratio, f"T_1/T_2 of a frame of our own is {ratio:.2f} times as large on half the stiffness"
    )


@statement(
    "2.4.2", "the second and higher modes are typically not affected at all",
    near(1.0, 0.1, why="not affected: 10 %"),
    simulation("small vibration of a two-storey frame on two springs"),
    lost="no structure is stated",
)  # fmt: skip
def second_period_with_uplift() -> Found:
    whole, lifted = (_periods_of_frame(lifted) for lifted in (False, True))
    first, second = (float(lifted[i] / whole[i]) for i in (0, 1))
    return found(
        second, f"a frame of our own on half the stiffness: T_1 x {first:.2f}, T_2 x {second:.2f}"
    )


def _periods_of_frame(lifted: bool) -> np.ndarray:
    """Periods [s] of two storeys on ground whose rotational stiffness an uplift has halved."""
    stiffness = np.array([[2.0, -1.0], [-1.0, 1.0]]) * 30e6
    heights, masses = np.array([3.5, 7.0]), np.array([20e3, 20e3])
    ground = 2e8 * (0.5 if lifted else 1.0)
    flexibility = np.linalg.inv(stiffness) + np.outer(heights, heights) / ground
    rates = np.linalg.eigvals(flexibility * masses)
    return np.sort(2 * np.pi * np.sqrt(rates.real))[::-1]


@statement(
    "Table 2-2", "k_f = K_z B_f and c_f = C_z B_f of a rectangular mat",
    near(1.0, 0.0, "B_f K_z", why="as printed, for a half-width of 1 m"),
    closed_form("two springs that share K_z"),
    slip=True,
)  # fmt: skip
def stiffness_of_a_rectangular_mat() -> Found:
    mat = formulas.rectangular_mat(1.0, 1.0, 2.18, 20e6, 1 / 3, 1800.0)
    ratio = float(mat.stiffness / mat.vertical_stiffness)
    return found(ratio, f"k_f = {ratio:g} K_z: two springs share it, and K_z B_f is no stiffness")


# --- 2.5 phase portraits and harmonic shaking


@statement(
    "2.5.1", "the angular speed is reduced instantaneously by the coefficient of restitution as "
    "described by Equation 2-4",
    near(0.9, 1e-6, why="r = 0.9 of Figure 2-10"),
    simulation("2-14 with r = 0.9"),
    figure="2-10",
)  # fmt: skip
def energy_ratio_at_each_crossing() -> Found:
    crossings = blocks.released_inside_balance().impacts[:6]
    ratios = [(e.after["theta_dot"] / e.before["theta_dot"]) ** 2 for e in crossings]
    return ranging(ratios, f"{min(ratios):.6f} to {max(ratios):.6f} of the kinetic energy")


@statement(
    "2.5.1", "in the long term, the block will come to rest",
    at_most(120.0, "p t", why="within the time simulated"),
    simulation("2-14 with r = 0.9"),
    figure="2-10",
)  # fmt: skip
def time_of_rest() -> Found:
    run = blocks.released_inside_balance()
    rest = run.events.rest_time
    return found(math.inf if rest is None else rest, f"{run.outcome} after p t = {rest:.1f}")


@statement(
    "Figure 2-11", "symmetric and asymmetric steady state orbits",
    at_least(1.0, why="stable orbits of each kind"),
    simulation("2-13 under harmonic shaking"),
    figure="2-11", lost="the amplitudes and frequencies of the orbits are not stated",
)  # fmt: skip
def steady_orbits_of_both_kinds() -> Found:
    lasting = [
        (beta, blocks.branches(doublings=1)[i].at(beta)) for i, beta in enumerate((2.0, 2.8, 3.15))
    ]
    kinds = [orbit.symmetric for _, orbit in lasting if orbit.stable]
    said = "; ".join(
        f"beta = {beta:g}: {'' if one.symmetric else 'a'}symmetric {one.order}, multipliers up to "
        f"{abs(one.multipliers[0]):.3f}"
        for beta, one in lasting
    )
    return found(min(kinds.count(True), kinds.count(False)), said)


@statement(
    "2.5.1", "Two dots ... (1,1) orbit ... while 4 and 8 dots corresponds with the period 2 and 4 "
    "cycles",
    at_least(1, "values of beta", why="each number of dots occurs"),
    simulation("2-13 with the values of Figure 2-12"),
    figure="2-12",
)  # fmt: skip
def dots_of_the_bifurcation_diagram() -> Found:
    counts = blocks.settled_counts()
    at = {n: blocks.AMPLITUDES[counts == n] for n in (2, 4, 8)}
    said = "; ".join(f"{n} dots from {b.min():.3f} to {b.max():.3f}" for n, b in at.items())
    return found(min(map(len, at.values())), said)


@statement(
    "2.5.1", "doubling in period occurs with increasing frequency until at a distinct point",
    between(4.0, 5.5, why="the ratio of successive intervals nears 4.669 where doublings pile up"),
    simulation("2-13 with the values of Figure 2-12"),
    figure="2-12",
)  # fmt: skip
def cascade_of_doublings() -> Found:
    breaks, *values = blocks.cascade().values
    limits = blocks.cascade().accumulations
    ratio = float(blocks.cascade().ratios[-1])
    return found(
        ratio,
        f"the last ratio of intervals is {ratio:.3f}; the symmetry breaks at {breaks:.8f}, the "
        f"period doubles at {', '.join(f'{value:.8f}' for value in values)}, and the doublings "
        f"pile up at {limits[-1]:.6f}",
    )


@statement(
    "2.5.1, Figure 2-12", "r = 0.5",
    at_least(1, "doublings", why="with r the ratio of energies of 2-4"),
    simulation("2-13 with r = 0.5 as the ratio of energies"),
    figure="2-12", slip=True,
)  # fmt: skip
def doublings_with_the_ratio_of_energies() -> Found:
    symmetric, asymmetric = blocks.branches_by_energy()
    flips = [one for one in asymmetric.bifurcations if one.value > blocks.AMPLITUDES[0]]
    counts = [
        blocks.distinct(np.abs(blocks.upright_speeds(blocks.driven(b)))) for b in (3.0, 3.18, 3.22)
    ]
    return found(
        len(flips),
        f"none from 3 to 3.26: the symmetry breaks at {symmetric.bifurcations[0].value:.8f}, and "
        f"the orbit behind lasts; with 0.5 as the ratio of velocities the doublings come out, "
        f"{', '.join(map(str, counts))} velocities at beta = 3, 3.18, 3.22",
    )


@statement(
    "2.5.1", "in the smeared bands for \N{GREEK SMALL LETTER BETA} > 3.34",
    at_most(blocks.AMPLITUDES[-1], why="within Figure 2-12, which ends at 3.26"),
    printed("2.5.1, 3.34"),
    slip=True,
)  # fmt: skip
def smeared_bands() -> Found:
    smeared = blocks.AMPLITUDES[blocks.settled_counts() > 16]
    return found(
        3.34, f"smeared from {smeared.min():.3f} on: 3.234 may be meant; the doublings end there"
    )


# --- 2.5 pulses


@statement(
    "2.5.1", "a pulse with a peak acceleration of 0.172 g results in overturning",
    near(1.0, 0.0, "overturned", why="it overturns"),
    simulation("2-9 with the values of Figure 2-13"),
    figure="2-13",
)  # fmt: skip
def weak_pulse_overturns() -> Found:
    weak = blocks.pulsed(8.0, 0.172, 2.192, 0.954)
    at = blocks.fates_of_2_13()["amplitude"].values
    return found(
        weak.outcome == "overturned", f"{weak.outcome}; pulses do so from {at[0]:.6f} g on"
    )


@statement(
    "2.5.1", "while a pulse of 0.454 g does not",
    near(1.0, 0.0, "survived", why="it does not overturn"),
    simulation("2-9 with the values of Figure 2-13"),
    figure="2-13",
)  # fmt: skip
def strong_pulse_does_not_overturn() -> Found:
    strong = blocks.pulsed(8.0, 0.454, 2.192, 0.954)
    reached = abs(strong.extremes("theta").peak) / strong.structure.alpha  # type: ignore[attr-defined]
    return found(strong.outcome in STANDS, f"{strong.outcome}, at most {reached:.2f} alpha")


@statement(
    "2.5.1", "increasing peak ground acceleration may not necessarily lead to increased risk of "
    "overturning",
    at_least(1, "safe ranges", why="above a peak that overturns"),
    simulation("2-9 with the values of Figure 2-13"),
    figure="2-13",
)  # fmt: skip
def safe_peaks_above_overturning() -> Found:
    changes = blocks.fates_of_2_13()
    fates = [
        f"{blocks.fate(f)} from {a:.6f} g"
        for a, f in zip(changes["amplitude"].values, changes["above"].values, strict=True)
    ]
    return found(int(np.isinf(changes["above"]).sum()), "; ".join(fates))


@statement(
    "2.5.1", "differing only by 0.5% in aspect ratio",
    at_least(1, "of two pairs", why="one block of a pair overturns, the other does not"),
    simulation("2-9 with half-widths of 1 m"),
    figure="2-14", lost="the size of the blocks is not stated",
)  # fmt: skip
def fates_of_similar_blocks() -> Found:
    ratios = (3.8, 3.82, 4.26, 4.28)
    fell = [blocks.pulsed(x, 0.3, 2.0, None).outcome == "overturned" for x in ratios]
    at = blocks.changes_of_fate(
        "slenderness", 3.5, 5.0, 1501, amplitude=0.3, period=2.0, ratio=None
    )["slenderness"].values
    said = ", ".join(
        f"{x:g} {'overturns' if f else 'stands'}" for x, f in zip(ratios, fell, strict=True)
    )
    return found(
        (fell[0] != fell[1]) + (fell[2] != fell[3]),
        f"with half-widths of 1 m {said}; the fate changes at {', '.join(f'{x:.6f}' for x in at)}",
    )


@statement(
    "2.5.1, Figure 2-13", "a 1 m wide by 8 m high rigid block",
    near(2.192, 0.001, "s", why="the period of the pulse is 2 pi/(3 p) of the block"),
    closed_form("2 pi/(3 p) with half-sizes 0.5 and 4 m"),
    slip=True,
)  # fmt: skip
def size_of_the_block_of_2_13() -> Found:
    periods = []
    for half_width, half_height in ((0.5, 4.0), (1.0, 8.0)):
        p = math.sqrt(3 * STANDARD_GRAVITY / (4 * math.hypot(half_width, half_height)))
        periods.append(2 * math.pi / (3 * p))
    return found(
        periods[0], f"{periods[0]:.3f} s for it, and {periods[1]:.3f} s for half-sizes of 1 and 8 m"
    )


@statement(
    "2.5.1", "greater than tan(\N{GREEK SMALL LETTER ALPHA})",
    near(math.tan(math.atan2(BLOCK["half_width"], BLOCK["half_height"])), 0.0, "m/s2",
         why="S_a at which rocking begins, for the block of chapter 3"),
    closed_form("2-1"),
    slip=True,
)  # fmt: skip
def acceleration_of_uplift() -> Found:
    slope = BLOCK["half_width"] / BLOCK["half_height"]
    return found(
        STANDARD_GRAVITY * slope,
        f"g tan(alpha) = {STANDARD_GRAVITY * slope:.2f} m/s2; tan(alpha) has no unit",
    )


@statement(
    "2.5.1", "The FEMA 365 procedure",
    near(365, 0.0, why="the number of the document"),
    printed("2.5.1, FEMA 356 (2000)"),
    slip=True,
)  # fmt: skip
def number_of_the_fema_document() -> Found:
    return found(356, "FEMA 356, as elsewhere in the text")


@statement(
    "2.5.1", "converted into a peak rotation following Equation 2-16",
    near(1.0, 0.0, why="2-16 has a displacement in it"),
    printed("2-16"),
    slip=True,
)  # fmt: skip
def equation_of_the_peak_rotation() -> Found:
    of = EQUATIONS["2-16"]
    names = {symbol.name for symbol in of.symbols}
    return found(
        any("delta" in name.lower() for name in names),
        f"2-16 is the {of.meaning}; a rotation is the displacement over R cos(alpha)",
    )


@statement(
    "2.5.1", "the FEMA damping value in Equation 2-15 is up to 10% less",
    at_most(10.0, "%", why="the printed number"),
    closed_form("2-15 and 2-16 for r from 0.49 to 1"),
    slip=True,
)  # fmt: skip
def damping_of_fema_356() -> Found:
    r = np.linspace(0.49, 0.999, 200)
    less = 100 * (1 - formulas.fema_356_damping(r) / formulas.priestley_damping(r))
    return found(less.max(), f"{less.min():.0f} to {less.max():.0f} % less")


# --- 2.6 impacts as forces


@statement(
    "2.6", "the two formulations yield near identical results",
    at_most(0.01, "alpha", why="near identical: 1 % of the overturning angle, with n = 0.001"),
    simulation("2-29"), closed_form("piecewise energies at the peaks"),
    figure="2-16",
)  # fmt: skip
def peaks_of_the_dirac_formulation() -> Found:
    error = np.abs(forces.peaks_between(forces.released(1e-3))[:3] - forces.exact_peaks(3))
    return found(error.max(), f"the first three peaks are off by {error.max():.4f} alpha at most")


# --- Table 2-3


@statement(
    "Table 2-3", "r = 0.944 and 0.914 by 2-6",
    near(TABLE_2_3.numbers("r by 2-6"), 0.0005, why="half of the last digit"),
    closed_form("2-6 with the inertia of B-9"),
    slip=True,
)  # fmt: skip
def ratios_of_table_2_3() -> Found:
    rows = computed("2-3")
    r, damping = ([float(row[i] or 0.0) for row in rows] for i in (5, 6))
    roots = [math.sqrt(x) for x in r]
    return found(
        r,
        f"{r[0]:.3f} and {r[1]:.3f}, and by 2-16 a damping of {damping[0]:.1f} and "
        f"{damping[1]:.1f} %; printed are the velocity ratios, {roots[0]:.3f} and {roots[1]:.3f}",
    )
