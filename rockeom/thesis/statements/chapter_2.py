"""Statements of chapter 2: restitution, uplift, non-linear dynamics, impacts as forces."""

import math

import numpy as np

import rockeom as rk
from rockeom.analysis import design, formulas
from rockeom.analysis.sweeps import STANDS
from rockeom.motion import STANDARD_GRAVITY
from rockeom.thesis.figures import chapter_2 as forces, chapter_2_blocks as blocks
from rockeom.thesis.free_vibration_table import let_go
from rockeom.thesis.printed import BLOCK, TABLE_2_1, number
from rockeom.thesis.statements import statement as st
from rockeom.thesis.tables import computed

# --- 2.2 Housner's block


def approximation_of_slender_blocks() -> st.Finding:
    alpha, ratio = np.radians(20.0), np.linspace(0.001, 0.99, 25)
    exact = formulas.exact_quarter_period(ratio * alpha, alpha, 1.0)
    error = np.abs(formulas.quarter_period(ratio, 1.0) / exact - 1)
    return st.finding(error.max(), f"off by {100 * error.max():.1f} % at most for 20 degrees")


def vulnerability_with_size() -> st.Finding:
    size = np.array([1.0, 2.0, 4.0, 8.0])
    p = np.sqrt(3 * STANDARD_GRAVITY / (4 * size))
    exponent, *pushed = (
        float(np.polyfit(np.log(size), -np.log(stable), 1)[0])
        for stable in (
            formulas.overturning_spectral_velocity(0.2, p),
            *(formulas.overturning_constant(duration, 0.2, p) for duration in (0.05, 3.0)),
        )
    )
    return st.finding(
        exponent,
        f"{exponent:.2f} in an earthquake; a constant push of 0.05 s {pushed[0]:.2f}, of 3 s "
        f"{pushed[1]:.2f}, so that the size counts the less the longer the push",
    )


def block_of_aslam() -> st.Finding:
    height, width, *_ = TABLE_2_1.rows[4]
    sizes = number(height), number(width)
    return st.finding([sizes[0], sizes[0] / sizes[1]], f"{sizes[0]:g} mm x {sizes[1]:g} mm")


# --- 2.2 restitution


def _errors_of_2_6() -> tuple[np.ndarray, np.ndarray]:
    """Slenderness H/B and measured less computed r of each row of Table 2-1."""
    ratio, measured = (np.array(TABLE_2_1.numbers(name)) for name in ("H/B", "measured r"))
    return ratio, measured - formulas.energy_ratio_of_block(np.arctan(1 / ratio))


def measured_ratios_above_2_6() -> st.Finding:
    _, error = _errors_of_2_6()
    above = int((error > 0).sum())
    return st.finding(above, f"{above} of {len(error)} rows")


def errors_of_slender_blocks() -> st.Finding:
    ratio, error = _errors_of_2_6()
    squat, slim = (float(np.abs(error[of]).mean()) for of in (ratio <= 4, ratio > 4))
    return st.finding(slim / squat, f"mean error {squat:.3f} up to H/B = 4, {slim:.3f} beyond")


# --- 2.4 flexible structures and foundations


def damping_of_the_uplifted_column() -> st.Finding:
    ratio = float(formulas.uplifted_damping(0.05, 1.0, 10.0))
    half = float(formulas.uplifted_damping(0.05, 0.5, 10.0))
    return st.finding(
        ratio, f"{ratio:.3f} for 0.05 and H/B = 10; {half:.2f} where B is the whole width, not half"
    )


def frequency_of_figure_2_6() -> st.Finding:
    frequency = forces.OMEGA_OF_2_6 / (2 * math.pi)
    return st.finding(frequency, f"{frequency:.2f} Hz")


def mean_deformation_while_uplifted() -> st.Finding:
    omega, height, half_width = forces.OMEGA_OF_2_6, 1.0, 0.3
    u_c = float(formulas.uplift.uplift_displacement(omega, half_width, height))
    structure = rk.UpliftingOscillator.from_frequency(
        angular_frequency=omega, damping_ratio=0.03, height=height, half_width=half_width
    )
    start = 0.05 * math.atan(half_width / height)
    run = let_go(structure, 2.0, rk.Impulsive(), theta=start, u=u_c)
    first = run.impacts[0].time
    t = np.linspace(0.0, first, 2001)
    mean = float(abs(np.mean(run.at(t)["u"]))) / u_c
    return st.finding(mean, f"{mean:.2f} u_c on average until the first impact")


def lengthening_of_the_period() -> st.Finding:
    lifts = float(formulas.foundation.two_spring_uplift_rotation(1.0, 0.5, 1.0))
    rotations = lifts * np.array([1.0, 2.0, 3.0])
    moment = formulas.foundation.two_spring_moment(rotations, 1.0, 0.5, 1.0)
    periods = np.sqrt(rotations / moment)
    longer = periods / periods[0]
    return st.finding(
        float(longer[-1]),
        f"the secant period is {longer[1]:.2f} and {longer[2]:.2f} times that before at twice and "
        "three times the rotation at which a spring is free",
    )


def ratio_of_periods_with_uplift() -> st.Finding:
    first, second = _lengthening_of_frames()
    ratio = first / second
    return st.finding(
        ratio.max(),
        f"T_1/T_2 of {_FRAMES} grows by a factor of {ratio.min():.2f} to {ratio.max():.2f}, as the "
        "third finding of the same list has it: T_1 changes and T_2 does not",
    )


def second_period_with_uplift() -> st.Finding:
    first, second = _lengthening_of_frames()
    return st.ranging(
        second,
        f"{_FRAMES}: T_1 grows by a factor of {first.min():.2f} to {first.max():.2f}, T_2 of "
        f"{second.min():.3f} to {second.max():.3f}",
    )


_FRAMES = (
    "shear frames of 2 to 8 storeys on soft to stiff ground, of whose rotational stiffness an "
    "uplift leaves a half or a third"
)


def _lengthening_of_frames() -> np.ndarray:
    """(2, n) factors by which an uplift lengthens T_1 and T_2 of the frames of `_FRAMES`.

    The secant stiffness of two springs falls to a half and a third at twice and three times the
    rotation at which a spring is free.
    """
    factors = [
        _periods_of_frame(storeys, ground * left) / _periods_of_frame(storeys, ground)
        for storeys in (2, 3, 5, 8)
        for ground in (0.1, 1.0, 10.0)
        for left in (1 / 2, 1 / 3)
    ]
    return np.array(factors).T


def _periods_of_frame(storeys: int, ground: float) -> np.ndarray:
    """T_1 and T_2 of equal storeys on a base that turns, in units of 2 pi sqrt(m/k) of a storey.

    ground : rotational stiffness of the base over `storeys` k h**2, with h the height of a storey.
    """
    heights = np.arange(1.0, storeys + 1)
    flexibility = np.minimum.outer(heights, heights)  # of storeys in series
    turned = np.outer(heights, heights) / (storeys * ground)
    return np.sqrt(np.linalg.eigvalsh(flexibility + turned))[::-1][:2]


def stiffness_of_a_rectangular_mat() -> st.Finding:
    mat = formulas.rectangular_mat(1.0, 1.0, 2.18, 20e6, 1 / 3, 1800.0)
    ratio = float(mat.stiffness / mat.vertical_stiffness)
    return st.finding(
        ratio, f"k_f = {ratio:g} K_z: two springs share it, and K_z B_f is no stiffness"
    )


def rotational_stiffness_of_a_circular_mat() -> st.Finding:
    radius, modulus, poisson = 1.0, 20e6, 1 / 3
    springs = formulas.circular_mat(radius, modulus, poisson, 1800.0)
    ratio = float(springs.rotational_stiffness / (8 * modulus * radius**3 / (3 * (1 - poisson))))
    return st.finding(ratio, f"{ratio:.3f} of that of the half-space")


_SIDES = np.array([0.25, 0.5, 1.0, 2.0, 4.0])
"""Length of a mat along the axis of rotation over its width."""


def rotational_stiffness_of_a_rectangular_mat() -> st.Finding:
    mat = formulas.rectangular_footing(1.0, _SIDES, 20e6, 1 / 3)
    ratio = mat.vertical / 3 / mat.rotational
    return st.ranging(
        ratio,
        f"{ratio.min():.2f} to {ratio.max():.2f} of that of the half-space for sides of 1:4 to "
        "4:1: it is that of a Winkler bed with the same K_z",
    )


def winkler_stiffness_of_both_motions() -> st.Finding:
    mat = formulas.rectangular_footing(1.0, _SIDES, 20e6, 1 / 3)
    by_rotation = formulas.winkler_stiffness_from_rotation(mat.rotational, 1.0)
    ratio = by_rotation / formulas.winkler_stiffness(mat.vertical, 1.0)
    return st.ranging(
        ratio,
        f"the rotation asks for {ratio.min():.1f} to {ratio.max():.1f} times the k_w of the "
        "settlement, for sides of 1:4 to 4:1",
    )


# --- 2.5 phase portraits and harmonic shaking


def time_of_rest() -> st.Finding:
    run = blocks.released_inside_balance()
    rest = run.events.rest_time
    return st.finding(math.inf if rest is None else rest, f"{run.outcome} after p t = {rest:.1f}")


def steady_orbits_of_both_kinds() -> st.Finding:
    lasting = [
        (beta, blocks.branches(doublings=1)[i].at(beta)) for i, beta in enumerate((2.0, 2.8, 3.15))
    ]
    kinds = [orbit.symmetric for _, orbit in lasting if orbit.stable]
    said = "; ".join(
        f"beta = {beta:g}: {'' if one.symmetric else 'a'}symmetric {one.order}, multipliers up to "
        f"{abs(one.multipliers[0]):.3f}"
        for beta, one in lasting
    )
    return st.finding(min(kinds.count(True), kinds.count(False)), said)


def dots_of_the_bifurcation_diagram() -> st.Finding:
    """Between the exact doublings, near which a motion settles slowly."""
    _, *doublings = blocks.cascade().values[:4]
    beta, counts = blocks.AMPLITUDES, blocks.settled_counts()
    ends = zip((2, 4, 8), (beta[0], *doublings), doublings, strict=False)
    at = [int(np.sum(counts[(beta >= low) & (beta < high)] == dots)) for dots, low, high in ends]
    two, four, eight = doublings
    return st.finding(
        min(at),
        f"2 dots to beta = {two:.4f}, 4 to {four:.4f} and 8 to {eight:.4f}, at {at[0]}, "
        f"{at[1]} and {at[2]} values",
    )


def cascade_of_doublings() -> st.Finding:
    breaks, *values = blocks.cascade().values
    limits = blocks.cascade().accumulations
    ratio = float(blocks.cascade().ratios[-1])
    return st.finding(
        ratio,
        f"the last ratio of intervals is {ratio:.3f}; the symmetry breaks at {breaks:.8f}, the "
        f"period doubles at {', '.join(f'{value:.8f}' for value in values)}, and the doublings "
        f"pile up at {limits[-1]:.6f}",
    )


def doublings_with_the_ratio_of_energies() -> st.Finding:
    symmetric, asymmetric = blocks.branches_by_energy()
    flips = [one for one in asymmetric.bifurcations if one.value > blocks.AMPLITUDES[0]]
    counts = [
        blocks.distinct(np.abs(blocks.upright_speeds(blocks.driven(b)))) for b in (3.0, 3.18, 3.22)
    ]
    return st.finding(
        len(flips),
        f"none from 3 to 3.26: the symmetry breaks at {symmetric.bifurcations[0].value:.8f}, and "
        f"the orbit behind lasts; with 0.5 as the ratio of velocities the doublings come out, "
        f"{', '.join(map(str, counts))} velocities at beta = 3, 3.18, 3.22",
    )


def smeared_bands() -> st.Finding:
    smeared = blocks.AMPLITUDES[blocks.settled_counts() > 16]
    end, limit = blocks.AMPLITUDES[-1], blocks.cascade().accumulations[-1]
    return st.finding(
        end,
        f"the figure ends at {end:g}; the doublings pile up at {limit:.4f}, and the motion is "
        f"smeared from {smeared.min():.3f} on",
    )


# --- 2.5 pulses


def weak_pulse_overturns() -> st.Finding:
    weak = blocks.pulsed(8.0, 0.172, 2.192, 0.954)
    at = blocks.fates_of_2_13()["amplitude"].values
    return st.finding(
        weak.outcome == "overturned", f"{weak.outcome}; pulses do so from {at[0]:.6f} g on"
    )


def strong_pulse_does_not_overturn() -> st.Finding:
    strong = blocks.pulsed(8.0, 0.454, 2.192, 0.954)
    reached = abs(strong.extremes("theta").peak) / strong.structure.alpha  # type: ignore[attr-defined]
    return st.finding(strong.outcome in STANDS, f"{strong.outcome}, at most {reached:.2f} alpha")


def safe_peaks_above_overturning() -> st.Finding:
    changes = blocks.fates_of_2_13()
    fates = [
        f"{blocks.fate(f)} from {a:.6f} g"
        for a, f in zip(changes["amplitude"].values, changes["above"].values, strict=True)
    ]
    return st.finding(int(np.isinf(changes["above"]).sum()), "; ".join(fates))


def pulses_a_thousandth_apart() -> st.Finding:
    """Pulses on both sides of each peak at which the fate of the block of Figure 2-13 changes."""
    different = 0
    for amplitude in blocks.fates_of_2_13()["amplitude"].values:
        pair = [blocks.pulsed(8.0, amplitude * x, 2.192, 0.954) for x in (0.9995, 1.0005)]
        different += (pair[0].outcome == "overturned") != (pair[1].outcome == "overturned")
    return st.finding(different, f"at {different} peaks one of two such pulses overturns the block")


def fates_of_similar_blocks() -> st.Finding:
    ratios = blocks.RATIOS_OF_2_14
    fell = [blocks.pulsed(x, 0.3, 2.0, None).outcome == "overturned" for x in ratios]
    at = blocks.changes_of_fate(
        "slenderness", 3.5, 5.0, 1501, amplitude=0.3, period=2.0, ratio=None
    )["slenderness"].values
    said = ", ".join(
        f"{x:g} {'overturns' if f else 'stands'}" for x, f in zip(ratios, fell, strict=True)
    )
    return st.finding(
        (fell[0] != fell[1]) + (fell[2] != fell[3]),
        f"with half-widths of 1 m {said}; the fate changes at {', '.join(f'{x:.6f}' for x in at)}",
    )


def differences_of_aspect_ratio() -> st.Finding:
    pairs = np.reshape(blocks.RATIOS_OF_2_14, (2, 2))
    difference = 100 * (pairs[:, 1] / pairs[:, 0] - 1)
    return st.finding(difference, f"{difference[0]:.2f} and {difference[1]:.2f} %")


def energy_ratio_of_block(slenderness: str) -> st.Finding:
    alpha = math.atan(1 / float(slenderness))
    r = float(formulas.energy_ratio_of_block(alpha))
    return st.finding(r, f"{r:.6f}, with alpha = {math.degrees(alpha):.3f} degrees")


def size_of_the_block_of_2_13() -> st.Finding:
    block = rk.RigidBlock(half_width=0.5, half_height=4.0)
    pulse = rk.GroundMotion.single_sine(0.454 * STANDARD_GRAVITY, 2.192, duration=20.0)
    run = rk.simulate(block, pulse, impact=rk.EnergyRatio(0.954))
    return st.finding(
        run.outcome in STANDS,
        f"{run.outcome} without an impact; half-sizes of 1 and 8 m stand, and the pulse of 2.192 s "
        "is 2 pi/(3 p) of these",
    )


def acceleration_of_uplift() -> st.Finding:
    width, height = BLOCK["half_width"], BLOCK["half_height"]
    uplift = float(formulas.uplift_acceleration(width, height))
    return st.finding(
        uplift / STANDARD_GRAVITY / (width / height),
        f"the block of chapter 3 lifts at {uplift:.2f} m/s2 = {uplift / STANDARD_GRAVITY:.3f} g",
    )


_RECORDS = ("El Centro 1940 180", "Pacoima 254", "Sylmar SYL 032")


def estimates_of_fema_356(times: str) -> st.Finding:
    """A block of 1 m by 4 m, under each record with peaks of 1.5 and 2 times that of uplift."""
    block = rk.RigidBlock(half_width=0.5, half_height=2.0)
    uplift = float(formulas.uplift_acceleration(block.half_width, block.half_height))
    motions = [
        rk.GroundMotion.from_library(name).scaled_to(peak=factor * uplift)
        for name in _RECORDS
        for factor in (1.5, 2.0)
    ]
    compared = design.fema_356_against_integration(block, motions)
    own = np.abs(compared.rotation) / block.alpha
    estimated = [
        {"overturned": 1.0, "converged": one.rotation / block.alpha}.get(one.outcome, math.nan)
        for one in compared.fema
    ]
    over = int(np.sum(estimated > float(times) * own))
    said = "; ".join(
        f"{'none' if math.isnan(x) else f'{x:.2f}'} for {y:.2f}"
        for x, y in zip(estimated, own, strict=True)
    )
    return st.finding(
        over,
        f"in kind, {over} of six estimates are {times} times the integrated rotation or more, in "
        f"units of alpha {said}",
    )


def damping_of_fema_356() -> st.Finding:
    r = np.linspace(0.49, 0.999, 200)
    fema, priestley = formulas.fema_356_damping(r), formulas.priestley_damping(r)
    less = 100 * (1 - fema / priestley)
    return st.finding(
        less.max(),
        f"{less.min():.0f} to {less.max():.0f} % less; of the critical damping it is up to "
        f"{100 * (priestley - fema).max():.0f} %",
    )


# --- 2.6 impacts as forces


def peaks_of_the_dirac_formulation() -> st.Finding:
    error = np.abs(forces.peaks_between(forces.released(1e-3))[:3] - forces.exact_peaks(3))
    return st.finding(
        error.max(), f"the first three peaks are off by {error.max():.4f} alpha at most"
    )


def acceleration_of_the_impulse() -> st.Finding:
    n, r = 1e-3, forces.ENERGY_RATIO
    # half of the pulse is over at x = 0: the square of the speed there is sqrt(r) of that before
    squared = 2 * (forces.START - forces.START**2 / 2) * math.sqrt(r)
    largest = -math.log(math.sqrt(r)) / (n * math.sqrt(math.pi)) * squared
    return st.finding(largest, f"{largest:.0f} against 1")


def impulses_with_smaller_n() -> st.Finding:
    """Largest acceleration near the first impact, and time spent within n of upright, by n."""
    heights, times = [], []
    for n in (2e-3, 1e-3):
        run = forces.released(n, 2.0)
        t = np.linspace(0.0, run.duration, 400_001)
        state = run.at(t)
        heights.append(float(np.abs(np.gradient(state["x_dot"], t)).max()))
        times.append(float(np.mean(np.abs(state["x"]) < n)))
    ratios = [heights[1] / heights[0], times[0] / times[1]]
    return st.finding(
        ratios,
        f"with half of n the acceleration reaches {ratios[0]:.2f} times as much, and the block is "
        f"within n of upright {1 / ratios[1]:.2f} times as long",
    )


# --- Table 2-3


def ratios_of_table_2_3() -> st.Finding:
    rows = computed("2-3")
    r, damping = ([float(row[i] or 0.0) for row in rows] for i in (5, 6))
    roots = [math.sqrt(x) for x in r]
    return st.finding(
        r,
        f"{r[0]:.3f} and {r[1]:.3f}, and by 2-16 a damping of {damping[0]:.1f} and "
        f"{damping[1]:.1f} %; printed are the velocity ratios, {roots[0]:.3f} and {roots[1]:.3f}",
    )


def damping_suggested_for_the_walls() -> st.Finding:
    other, wall = (float(row[6] or 0.0) for row in computed("2-3"))
    return st.finding(
        wall,
        f"{wall:.1f} %, and {other:.1f} % for UoA4 with the masses of UoA6; about 3 % comes of the "
        "velocity ratio that Table 2-3 takes for r",
    )


# --- 2.8 conclusion


def blocks_of_all_sizes() -> st.Finding:
    """Slender blocks of one slenderness and of radii of 1 and 9 m under the same pulse in p t."""
    rotations = []
    for radius in (1.0, 9.0):
        block = rk.SlenderBlock(radius=radius, alpha=0.2)
        p = math.sqrt(0.75 * STANDARD_GRAVITY / radius)
        pulse = rk.GroundMotion.single_sine(2.2, 6.0 / p, duration=24.0 / p)
        run = rk.simulate(block, pulse, impact=rk.EnergyRatio(0.9))
        rotations.append(run.at(np.linspace(0.0, 20.0, 401) / p)["theta"] / 0.2)
    small, large = rotations
    apart = float(np.abs(large - small).max())
    return st.finding(apart, f"{apart:.0e} alpha apart, at most {np.abs(small).max():.2f} alpha")
