"""Restitution, energy and support forces from records of blocks whose impacts are known."""

import functools

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import identification
from tests.exact import FreeBlock
from tests.typical import S1 as COLUMN

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
SHAPE = {"mass": BLOCK.mass, "alpha": BLOCK.alpha, "radius": BLOCK.radius}
RELEASE = np.radians(7.876)
BY_FOOT = {"left": 0.76, "right": 0.93}  # about those of Figure 3-19


@functools.cache
def rocking():
    """(t, theta, rate) at 500 samples a second, 5 s, with a ratio for each foot that lands."""
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(5.0),
        initial={"theta": RELEASE},
        impact=rk.EnergyRatio(**BY_FOOT),
    )
    t = np.arange(2500) * 0.002
    found = run.at(t, side="left")
    return t, found["theta"], found["theta_dot"]


def noisy(sigma, seed=0):
    t, theta, _ = rocking()
    noise = np.random.default_rng(seed).normal(0.0, sigma, len(t)) if sigma else 0.0
    return analysis.MeasuredRecord(t, {"theta": theta + noise})


# --- restitution


def test_block_of_figure_3_3():
    time = [0, 0.793, 1.34, 1.824, 2.239, 2.61, 2.937]
    peaks = np.radians([7.876, -5.119, 4.759, -3.419, 3.105, -2.291, 2.075])
    found = identification.Impacts.of_peaks(
        time, peaks, BLOCK, deviation=np.radians(0.0005 / 3**0.5)
    )
    printed = [0.763, 0.948, 0.769, 0.922, 0.767, 0.915]
    np.testing.assert_allclose(found.energy_ratio, printed, atol=5e-4)
    assert found.foot.tolist() == ["left", "right"] * 3
    assert found.speed[0] == pytest.approx(-0.771, abs=5e-4)  # of Table 3-1
    # 3.2.4: "impacts on the left edge dissipate more energy"; their ratios do not overlap
    left, right = (found.at_foot(foot).mean() for foot in ("left", "right"))
    assert left.energy_ratio + left.half_width < right.energy_ratio - right.half_width
    # six joules are "approximately" 1.1 degrees or a tenth of alpha
    assert np.degrees(np.abs(found.select(found.energy_before > 6).peak_before)).min() > 1.1
    assert identification.static_energy(BLOCK, np.radians(1.2)) == pytest.approx(6.0, abs=0.3)


@pytest.mark.parametrize("structure", ["rigid", "flexible"])
def test_column_of_figure_5_6(structure):
    """By the energies of the rigid structure; those of the bent column differ by 0.006 at most."""
    time = [0.138, 0.453, 0.695, 0.901, 1.106, 1.274, 1.443, 1.590]
    mm = np.array([27.93, -21.30, 17.42, -14.18, 12.16, -10.17, 8.88, -7.77])
    peaks = identification.rotation_from_displacement(mm * 1e-3, 0.285, 1.056)
    if structure == "rigid":
        column, near = rk.LumpedMassStructure(**COLUMN), 6e-4
    else:
        column, near = rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4), 7e-3
    found = identification.Impacts.of_peaks(time, peaks, column)
    printed = [0.770, 0.823, 0.818, 0.860, 0.839, 0.875, 0.876]
    np.testing.assert_allclose(found.energy_ratio, printed, atol=near)


def test_energies_are_the_structures_own():
    """Of a block 3-2; of the wall those of 4-18 and 4-20, but for what these leave out (0.6 %)."""
    theta = np.array([-0.1, -1e-3, 0.02, 0.19])
    closed = analysis.formulas.gravitational_energy(theta, **SHAPE)
    np.testing.assert_allclose(identification.static_energy(BLOCK, theta), closed, rtol=1e-9)
    wall, formulas = rk.ControlledWall.thesis(), analysis.Wall.thesis()
    d = np.array([-0.03, -0.01, 0.005, 0.02])
    found = identification.static_energy(wall, np.arcsin(d / formulas.height))
    np.testing.assert_allclose(found, formulas.potential_energy(d), rtol=6e-3)


@pytest.mark.parametrize(
    "structure",
    [
        rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4),
        rk.FlexibleControlledWall.thesis(),
    ],
    ids=lambda one: one.model,
)
def test_static_energy_is_the_work_of_the_load_that_holds_it(structure):
    """Virtual work, whatever the structure: the force at the load point, over its displacement."""
    rotations = np.linspace(0.004, 0.012, 161)
    held = [structure.equilibrium(float(x)) for x in rotations]
    m, place = structure.module, np.empty(len(structure.module.KINEMATICS))
    displacement = []
    for _, y in held:
        m.kinematics(structure.mode_number(y), y, structure.vector, place)
        displacement.append(place[m.KINEMATICS.index("displacement")])
    force = np.array([f for f, _ in held])
    work = np.sum((force[1:] + force[:-1]) / 2 * np.diff(displacement))
    first, last = identification.static_energy(structure, rotations[[0, -1]])
    assert last - first == pytest.approx(work, rel=1e-4)


def test_wall_of_table_a_1():
    """By the energies of the derived wall as by 4-18 and 4-20, whose r Figure 4-30 shows."""
    table = identification.FreeVibration.table_a1()
    formulas, rows = analysis.Wall.thesis(), table.at_peak
    peaks = table.displacement[rows]
    found = identification.Impacts.of_peaks(
        table.time[rows], formulas.rotation(peaks), rk.ControlledWall.thesis()
    )
    energies = formulas.potential_energy(peaks)
    np.testing.assert_allclose(found.energy_ratio, energies[1:] / energies[:-1], rtol=3e-3)
    # of the energy before; measured, after what has been lost on the way, 0.77 and less
    height = formulas.height * np.abs(found.speed[:3])
    np.testing.assert_allclose(height, np.abs(table.velocity[1:6:2]), rtol=0.08)


def test_spring_counts_as_in_3_16():
    peaks = np.array([0.12, -0.1, 0.09])
    found = identification.Impacts.of_peaks([0, 1, 2], peaks, BLOCK, rotational_stiffness=900.0)
    closed = analysis.formulas.energy_ratios_from_peaks(
        peaks, BLOCK.alpha, rotational_stiffness=900.0, mass=BLOCK.mass, radius=BLOCK.radius
    )
    np.testing.assert_allclose(found.energy_ratio, closed, rtol=1e-9)


def test_restitution_is_recovered_within_its_stated_uncertainty():
    """100 records with noise of 0.02 degrees: 95 % intervals, no wider than they need be."""
    trials = [
        identification.Impacts.of_record(noisy(np.radians(0.02), seed), BLOCK, threshold=6.5)
        for seed in range(100)
    ]
    assert {len(one) for one in trials} == {9}
    ratio = np.array([one.energy_ratio for one in trials])
    half_width = np.array([one.half_width for one in trials])
    true = np.array([BY_FOOT[foot] for foot in trials[0].foot])
    assert np.mean(np.abs(ratio - true) <= half_width) >= 0.95
    scatter = ratio.std(axis=0, ddof=1)
    assert np.mean(half_width.mean(axis=0) / scatter) <= 2.0
    assert half_width.mean() <= 2 * np.sqrt(np.mean(scatter**2))
    # the feet are told apart in every record
    for one in trials:
        left, right = (one.at_foot(foot).mean() for foot in ("left", "right"))
        assert abs(left.energy_ratio - 0.76) < 2 * left.half_width
        assert left.energy_ratio + left.half_width < right.energy_ratio - right.half_width


def test_restitution_of_a_recorded_displacement_is_that_of_the_rotation():
    """The centroid's place was measured, not the rotation: the same ratios, the same intervals."""
    t, theta, _ = rocking()
    sigma = np.radians(0.02)
    place = identification.displacement_from_rotation(theta, BLOCK.half_width, BLOCK.half_height)
    noise = np.random.default_rng(0).normal(0.0, sigma, len(t))
    turned = analysis.MeasuredRecord(t, {"theta": theta + noise})
    moved = analysis.MeasuredRecord(t, {"top": place + BLOCK.half_height * noise})
    found = identification.Impacts.of_record(
        moved, BLOCK, "top", quantity="displacement", threshold=6.5, smallest=1e-3
    )
    usual = identification.Impacts.of_record(turned, BLOCK, threshold=6.5)
    true = np.array([BY_FOOT[foot] for foot in found.foot])
    assert np.all(np.abs(found.energy_ratio - true) < 2 * found.half_width)
    np.testing.assert_allclose(found.half_width, usual.half_width, rtol=0.25)
    np.testing.assert_allclose(found.speed, usual.speed, rtol=0.01)


@pytest.mark.parametrize("rate", [200, 1000])
def test_record_without_noise_that_comes_to_rest_needs_no_argument(rate):
    run = rk.simulate(
        BLOCK, rk.GroundMotion.none(9.0), initial={"theta": RELEASE}, impact=rk.EnergyRatio(0.85)
    )
    assert run.events.rest_time < 7
    t = np.arange(9 * rate) / rate
    record = analysis.MeasuredRecord(t, {"theta": run.at(t)["theta"]})
    found = identification.Impacts.of_record(record, BLOCK)
    assert len(found) > 30
    clear = found.peak_before**2 > (20 / rate) ** 3  # the last half-cycles have few samples
    np.testing.assert_allclose(found.energy_ratio[clear], 0.85, atol=2e-4)
    free = identification.FreeVibration.from_samples(t, run.at(t)["theta"])
    exact = FreeBlock(BLOCK.frequency_parameter, BLOCK.alpha)
    quarters = free.quarter_periods()
    expected = [exact.quarter(abs(peak)) for peak in quarters.peak[:8]]
    # a spline rounds the bend at the crossing
    np.testing.assert_allclose(quarters.time[:8], expected, atol=0.02 / rate)


def test_uncertainty_follows_the_noise_and_grows_as_the_energy_falls():
    calm, loud = (
        identification.Impacts.of_record(noisy(np.radians(s)), BLOCK, threshold=6.5)
        for s in (0.01, 0.04)
    )
    np.testing.assert_allclose(loud.half_width / calm.half_width, 4.0, rtol=0.1)
    assert calm.half_width[-1] > 3 * calm.half_width[0]


def test_a_filter_before_changes_neither_the_ratios_nor_their_intervals():
    """Its noise is no longer white, and the intervals know it."""
    errors, growth = [], []
    for seed in range(12):
        record = noisy(np.radians(0.02), seed)
        plain = identification.Impacts.of_record(record, BLOCK, threshold=6.5)
        found = identification.Impacts.of_record(record.low_pass(40.0), BLOCK, threshold=6.5)
        true = np.array([BY_FOOT[foot] for foot in found.foot])
        errors.append((found.energy_ratio - true) / found.half_width)
        growth.append(found.half_width / plain.half_width)
    np.testing.assert_allclose(growth, 1.0, atol=0.2)
    assert 0.4 < np.std(errors) < 0.62  # of half-widths that are two standard deviations


def test_means_histogram_and_distribution():
    found = identification.Impacts.of_record(noisy(np.radians(0.02)), BLOCK, threshold=6.5)
    both = found.mean()  # the feet differ: the interval is that of the scatter
    assert both.scatter == pytest.approx(0.09, abs=0.01)
    assert both.half_width > 10 * found.at_foot("left").mean().half_width
    edges, counts = found.histogram(0.05)
    assert counts.sum() == len(found) == both.number
    assert counts[np.searchsorted(edges, 0.76) - 1] == 5
    r, part = found.cumulative()
    assert np.all(np.diff(r) >= 0)
    assert part[-1] == 1.0
    twice = identification.Impacts.together([found, found])
    assert len(twice) == 18


def test_fit_of_the_energy_loss_recovers_3_17():
    """Energies made by the printed polynomial, and 1 % of noise."""

    def printed(v):
        return 5.525 * v**3 - 9.661 * v**2 - 0.6663 * v

    v = np.random.default_rng(3).uniform(0.2, 1.1, 400)
    before = 0.5 * 94.0 * v**2
    after = before + printed(v) + np.random.default_rng(4).normal(0, 0.05, len(v))
    zeros = np.zeros_like(v)
    impacts = identification.Impacts(
        time=zeros, foot=np.full(len(v), "right"), speed=v, peak_before=zeros, peak_after=zeros,
        energy_before=before, energy_after=after, half_width=zeros,
    )  # fmt: skip
    fit = impacts.energy_loss_fit()
    error = (fit.coefficients - [-0.6663, -9.661, 5.525]) / fit.deviations
    assert np.abs(error).max() < 3
    assert fit.r_squared > 0.99
    assert fit(0.8) == pytest.approx(printed(0.8), abs=0.05)


# --- energy in the course of the motion


def test_energy_of_a_record_is_constant_between_impacts():
    record = noisy(np.radians(0.01)).with_derivatives("theta", 0.06)
    energies = identification.record_energies(record, BLOCK)
    _, theta, rate = rocking()
    exact = (
        analysis.formulas.gravitational_energy(theta, **SHAPE)
        + 0.5 * BLOCK.mass * (4 / 3 * BLOCK.radius**2) * rate**2
    )
    smooth = identification.support_forces_of_record(record, window=0.06, **SHAPE).smooth
    inside = smooth & (record.time < 3)
    error = np.abs(energies.total - exact)[inside]
    assert np.mean(error**2) ** 0.5 < 0.2  # J, of 28
    assert error.max() < 0.04 * exact[0]
    np.testing.assert_allclose(energies.elastic, 0.0)


def test_hypothetical_spring_is_fitted():
    """A block on a spring of 2 kN m/rad: its gravity and motion alone seem not to be constant."""
    k, sigma = 2000.0, np.radians(0.005)
    from scipy.integrate import solve_ivp

    inertia = 4 / 3 * BLOCK.mass * BLOCK.radius**2
    weight = BLOCK.mass * 9.81 * BLOCK.radius

    def rate(t, y):
        s = np.sign(y[0])
        return [y[1], -(s * weight * np.sin(BLOCK.alpha - s * y[0]) + k * y[0]) / inertia]

    def upright(t, y):
        return y[0]

    upright.terminal = True
    t, theta = np.arange(1500) * 0.002, np.zeros(1500)
    start, y = 0.0, [0.13, 0.0]
    for _ in range(8):
        run = solve_ivp(rate, (0, 3), y, events=upright, dense_output=True, rtol=1e-9, atol=1e-12)
        end = run.t[-1]
        inside = (t >= start) & (t < start + end)
        theta[inside] = run.sol(t[inside] - start)[0]
        start += end
        v = run.y[1, -1] * 0.93
        y = [np.sign(v) * 1e-9, v]
    record = analysis.MeasuredRecord(
        t, {"theta": theta + np.random.default_rng(2).normal(0, sigma, len(t))}
    ).between(0.0, start - 0.01)
    known = record.with_derivatives("theta", 0.05)
    found = identification.fitted_rotational_spring(known, BLOCK, count=5)
    assert found.stiffness == pytest.approx(k, abs=4 * found.deviation)
    assert found.deviation < 0.05 * k
    # as the thesis has it: from the excess at one rotation
    assert identification.rotational_stiffness_from_excess(k / 2 * 0.1**2, -0.1) == pytest.approx(k)


# --- forces


@pytest.mark.parametrize("window", [0.08, 0.1])
def test_support_forces_meet_the_derived_reactions_within_the_stated_noise(window):
    record = noisy(np.radians(0.01), seed=1)
    found = identification.support_forces_of_record(record, window=window, **SHAPE)
    _, theta, rate = rocking()
    rows = np.flatnonzero(found.smooth & (record.time < 4))[::3]
    derived = [BLOCK.reactions({"theta": theta[i], "theta_dot": rate[i]}) for i in rows]
    horizontal = np.array([one["horizontal_reaction"] for one in derived])
    vertical = np.array([one["left_reaction"] + one["right_reaction"] for one in derived])
    for force, exact, half_width in (
        (found.horizontal, horizontal, found.horizontal_half_width),
        (found.vertical, vertical, found.vertical_half_width),
    ):
        error = (force[rows] - exact) / half_width[rows]
        assert 0.92 < np.mean(np.abs(error) <= 1) <= 1
        assert 2 * np.sqrt(np.mean(error**2)) == pytest.approx(1.0, abs=0.15)
    assert found.vertical_half_width[rows].max() < 0.02 * BLOCK.mass * 9.81


def test_baseline_of_table_3_1():
    """3.08 kN (3.087 here) and 0.48 kN at 0.771 rad/s; measured 3.43 and 1.62 kN."""
    horizontal, vertical = analysis.formulas.block_reactions_at_impact(
        -0.771, 1, slender=True, **SHAPE
    )
    assert vertical == pytest.approx(3080.0, abs=10.0)
    assert abs(horizontal) == pytest.approx(480.0, abs=5.0)
    found = identification.impact_forces_of_record(noisy(np.radians(0.005)), window=0.04, **SHAPE)
    assert found.speed[0] == pytest.approx(-0.771, abs=5e-3)
    assert found.baseline_vertical[0] == pytest.approx(3080.0, abs=12.0)
    assert abs(found.baseline_horizontal[0]) == pytest.approx(480.0, abs=12.0)


def test_impact_force_of_a_record_is_that_of_its_sampling():
    """The impact of the simulation has no duration: half the window, and the force doubles."""
    record = noisy(0.0)
    wide, narrow = (
        identification.impact_forces_of_record(record, window=w, **SHAPE) for w in (0.08, 0.04)
    )
    for one in (wide, narrow):
        excess = np.abs(one.horizontal) - np.abs(one.baseline_horizontal)
        left = one.speed < 0  # those that lose most
        assert np.all(excess[left][:3] < 1.1 * one.expected_horizontal[left][:3])
        assert np.all(excess[left][:3] > 0.2 * one.expected_horizontal[left][:3])
    ratio = narrow.expected_horizontal / wide.expected_horizontal
    np.testing.assert_allclose(ratio[:6], 2.0, rtol=0.15)
    gain = [identification.kink_gain(0.001, w) for w in (0.02, 0.04, 0.08)]
    np.testing.assert_allclose(np.diff(np.log(gain)), -np.log(2), atol=0.06)


# --- refused


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: identification.Impacts.of_peaks([0], [0.1], BLOCK), "at least two peaks"),
        (lambda: identification.Impacts.of_peaks([0, 1], [0.1, 0.05], BLOCK), "both sides in turn"),
        (lambda: identification.Impacts.of_peaks([0, 1], [7.9, -5.1], BLOCK), "give radians"),
        (
            lambda: identification.Impacts.of_record(noisy(0.0), BLOCK).at_foot("both"),
            "left or right",
        ),
        (
            lambda: identification.Impacts.of_record(noisy(0.0), BLOCK, threshold=99).mean(),
            "no impact",
        ),
        (
            lambda: identification.Impacts.of_record(
                noisy(0.0), BLOCK, threshold=25
            ).energy_loss_fit(),
            "do not determine",
        ),
        (lambda: identification.record_energies(noisy(0.0), BLOCK), "with_derivatives"),
    ],
)
def test_what_cannot_be_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
