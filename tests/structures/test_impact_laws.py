"""Laws of impact by foot, in joules, and drawn by seed, on Housner's block of chapter 3."""

import math

import numpy as np
import pytest
from scipy import stats

import rockeom as rk
from rockeom.analysis import formulas

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
STILL = rk.GroundMotion.none(20.0)
START = {"theta": 0.15}
MEASURED = (0.763, 0.948, 0.769, 0.922, 0.767, 0.915)
LAWS = [
    rk.EnergyRatio(left=0.7, right=0.95),
    rk.EnergyRatioAtSpeed(((0.3, 0.8, 0.1), (math.inf, 0.9, 0.0)), height=1.0),
    rk.EnergyLossAtSpeed.equation_3_17(),
    rk.EnergyRatioByImpact(MEASURED),
    rk.RandomEnergyRatio(MEASURED, seed=3),
    rk.RandomEnergyRatio(left=MEASURED[::2], right=MEASURED[1::2], seed=3),
]


def released(law, **options):
    how = rk.SolverOptions(**options) if options else None
    return rk.simulate(BLOCK, STILL, impact=law, initial=START, options=how)


def energy_ratios(run):
    """Of the kinetic energies after and before each impact above 0.01 rad/s."""
    faster = run.impacts.above(0.01)
    return np.array([(e.after["theta_dot"] / e.before["theta_dot"]) ** 2 for e in faster])


def test_the_ratio_is_that_of_the_foot_that_lands():
    run = released(rk.EnergyRatio(left=0.7, right=0.95))
    for impact, r in zip(run.impacts[:8], energy_ratios(run), strict=False):
        uplift = run.at(impact.time - 1e-3, names=("left_uplift", "right_uplift"))
        left_lands = uplift["left_uplift"] > uplift["right_uplift"]
        assert r == pytest.approx(0.7 if left_lands else 0.95, rel=1e-12)


def lean(rise, alpha):
    """theta at which cos(alpha - theta) is `rise` above cos(alpha), by Newton's method."""
    theta = rise / math.sin(alpha)
    for _ in range(20):
        theta -= (2 * math.sin(alpha - theta / 2) * math.sin(theta / 2) - rise) / math.sin(
            alpha - theta
        )
    return theta


@pytest.mark.parametrize(("left", "right"), [(0.7, 0.95), (1.0, 0.5), (0.6, 1.0)])
def test_rest_after_infinitely_many_impacts_that_differ_by_foot(left, right):
    """The flights take twice the quarter periods of quadrature, their energies fall by r in turn.

    A foot that loses nothing does not keep the other one from ending the motion.
    """
    alpha, p = BLOCK.alpha, BLOCK.frequency_parameter
    rise = 2 * math.sin(alpha - 0.075) * math.sin(0.075)
    rises = rise * np.cumprod([1.0, *[left, right] * 100])
    peaks = [lean(rise, alpha) for rise in rises if rise > 1e-20]
    quarters = formulas.exact_quarter_period(np.array(peaks), alpha, p)
    run = released(rk.EnergyRatio(left=left, right=right))
    assert run.outcome is rk.Outcome.CAME_TO_REST
    assert run.events.rest_time == pytest.approx(2 * quarters.sum() - quarters[0], abs=1e-6)


def test_one_ratio_for_both_feet_is_one_ratio():
    one, two = released(rk.EnergyRatio(0.8)), released(rk.EnergyRatio(left=0.8, right=0.8))
    assert [e.time for e in one.impacts[:100]] == [e.time for e in two.impacts[:100]]
    assert repr(rk.EnergyRatio(0.8)) == "EnergyRatio(r=0.8)"


def test_losses_in_joules_are_those_of_3_17():
    """The cubic with its sign, as printed: Delta E = 5.525 w3 - 9.661 w2 - 0.6663 w."""
    run = released(rk.EnergyLossAtSpeed.equation_3_17())
    feet = set()
    for impact in run.impacts.above(0.07):
        w = impact.before["theta_dot"]
        before = BLOCK.energies(impact.before, impact.mode_before)["kinetic_energy"]
        after = BLOCK.energies(impact.after, impact.mode_after)["kinetic_energy"]
        assert after - before == pytest.approx(5.525 * w**3 - 9.661 * w**2 - 0.6663 * w, rel=1e-9)
        assert rk.EnergyLossAtSpeed.equation_3_17().loss(w) == pytest.approx(before - after)
        feet.add(w > 0)
    assert feet == {False, True}
    # where the cubic would give energy none is lost, and where it asks for more than all, all is
    slow = [(e.before["theta_dot"], e.after["theta_dot"]) for e in run.impacts]
    assert any(-0.067 < w < -0.001 and after == w for w, after in slow)
    assert any(0 < w < 0.0165 and after == 0.0 for w, after in slow)
    with pytest.raises(TypeError, match=r"nondimensional_block.*joules"):
        rk.simulate(
            rk.NondimensionalBlock(alpha=0.25), STILL, initial={"x": 0.1},
            impact=rk.EnergyLossAtSpeed.equation_3_18(),
        )  # fmt: skip


def test_impacts_have_their_own_ratios_in_turn():
    r = energy_ratios(released(rk.EnergyRatioByImpact(MEASURED)))
    assert r == pytest.approx(np.resize(MEASURED, len(r)), rel=1e-9)
    for wrong, kind, said in (
        ([0.8, 1.2], ValueError, r"of impact 1 is 1\.2"),
        ([], TypeError, "ratio of each impact"),
        (0.8, TypeError, "EnergyRatio"),
    ):
        with pytest.raises(kind, match=said):
            rk.EnergyRatioByImpact(wrong)


def test_drawn_ratios_follow_from_seed_and_number_alone():
    law = rk.RandomEnergyRatio(MEASURED, seed=7)
    reference = energy_ratios(released(law))
    assert set(np.round(reference, 9)) == set(MEASURED)
    for options in ({"rtol": 1e-5}, {"max_step": 0.01}, {"method": "RK45"}):
        assert energy_ratios(released(law, **options)) == pytest.approx(reference, rel=1e-9)
    other = energy_ratios(released(rk.RandomEnergyRatio(MEASURED, seed=8)))
    assert not np.allclose(other[:10], reference[:10])


def test_impacts_are_counted_through_a_long_motion():
    """Records are emptied on the way, and behind the 500th impact the draws begin anew."""
    law = rk.RandomEnergyRatio([0.5, 0.6, 0.7], seed=1)
    shaking = rk.GroundMotion.harmonic(4.0, frequency=3.0, duration=100.0)
    r = energy_ratios(rk.simulate(BLOCK, shaking, impact=law))
    assert len(r) > 550
    assert r == pytest.approx(np.resize(law.drawn["left"], len(r)), rel=1e-12)


@pytest.mark.parametrize("shaken", [False, True])
def test_feet_are_the_image_of_each_other(shaken):
    motion = rk.GroundMotion.single_sine(2.0, 0.3, 3.0) if shaken else STILL
    for one, other in (
        (rk.EnergyRatio(left=0.7, right=0.95), rk.EnergyRatio(left=0.95, right=0.7)),
        (
            rk.EnergyLossAtSpeed(left=(0.1, 9.0, 5.0), right=(0.2, 3.0, -1.0)),
            rk.EnergyLossAtSpeed(left=(0.2, 3.0, -1.0), right=(0.1, 9.0, 5.0)),
        ),
    ):
        run = rk.simulate(BLOCK, motion, impact=one, initial={"theta": 0.05})
        image = rk.simulate(BLOCK, -motion, impact=other, initial={"theta": -0.05})
        assert len(run.impacts) == len(image.impacts) > 5
        assert np.array_equal(run.y, -image.y)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_sweeps_and_the_state_after_an_impact_have_the_same_law(law):
    run = released(law)
    for n, impact in enumerate(run.impacts.above(0.01)):
        landing = {"theta_dot": impact.before["theta_dot"]}
        after, _ = BLOCK.after_impact(landing, impact.mode_before, law, impact_number=n)
        assert after["theta_dot"] == pytest.approx(impact.after["theta_dot"], rel=1e-14)
    n = len(run.impacts.above(0.01))
    for lanes in (False, True):
        found = rk.simulate_many(
            lambda theta: rk.Case(BLOCK, STILL, law, {"theta": theta}),
            over={"theta": [0.05, 0.15]}, impact_times=n,
            sweep_options=rk.SweepOptions(lanes=lanes),
        )  # fmt: skip
        times = found.impact_time.sel(theta=0.15)
        assert times.values == pytest.approx([e.time for e in run.impacts[:n]], abs=1e-8)


def test_distributions_are_cut_off_at_zero_and_one():
    law = rk.RandomEnergyRatio([0.9, 1.2, -0.1, 0.8], seed=0)
    assert (law.mean, law.std) == (pytest.approx(0.85), pytest.approx(0.05))
    assert set(law.drawn["left"]) == {0.8, 0.9}
    normal = rk.RandomEnergyRatio.normal(0.95, 0.1, seed=2)
    cut = stats.truncnorm(-9.5, 0.5, loc=0.95, scale=0.1)
    assert normal.mean == pytest.approx(cut.mean(), abs=1e-5)
    assert normal.std == pytest.approx(cut.std(), rel=3e-3)
    # what is drawn is such a sample: Kolmogorov and Smirnov's test does not refuse it
    assert stats.kstest(normal.drawn["right"], cut.cdf).pvalue > 0.05


def test_pieces_fitted_to_impacts():
    law = rk.EnergyRatioAtSpeed.equation_4_31()
    speed = np.linspace(-0.9, 0.9, 181)
    r = np.array([law.at(v) for v in speed])
    limits = (0.3, 0.47, 0.78)
    found = rk.EnergyRatioAtSpeed.from_data(speed, r, limits=limits)
    assert np.array(found.pieces) == pytest.approx(np.array(law.pieces), abs=1e-9)
    steps = rk.EnergyRatioAtSpeed.from_data(speed, r, limits=limits, slopes=False)
    slow = np.abs(speed) < 0.3
    assert steps.pieces[0] == (0.3, pytest.approx(r[slow].mean()), 0.0)
    with pytest.raises(ValueError, match=r"too few.*move the limits"):
        rk.EnergyRatioAtSpeed.from_data(speed, r, limits=(0.005,))
    with pytest.raises(ValueError, match="one finite number of each"):
        rk.EnergyRatioAtSpeed.from_data(speed, r[1:])


def test_losses_fitted_to_impacts():
    law = rk.EnergyLossAtSpeed.equation_3_18()
    rate = np.linspace(-0.9, 0.9, 40)
    found = rk.EnergyLossAtSpeed.from_data(rate, [law.loss(w) for w in rate])
    assert found.left == pytest.approx(law.left)
    assert found.right == pytest.approx(law.right)
    with pytest.raises(ValueError, match="left foot are too few"):
        rk.EnergyLossAtSpeed.from_data(np.abs(rate), np.abs(rate))
    with pytest.raises(ValueError, match="one finite number of each"):
        rk.EnergyLossAtSpeed.from_data(rate, rate[1:])


@pytest.mark.parametrize(
    ("made", "error", "says"),
    [
        (lambda: rk.EnergyRatio(), TypeError, r"left and right .*\(left=..., right=...\)"),
        (lambda: rk.EnergyRatio(0.8, left=0.7), TypeError, "left and right"),
        (lambda: rk.EnergyRatio(left=0.7), TypeError, "left and right"),
        (lambda: rk.EnergyRatio(left=0.7, right=1.2), ValueError, "right foot is 1.2"),
        (lambda: rk.EnergyLossAtSpeed((1.0, 2.0), (0.0, 0.0, 0.0)), TypeError, "three numbers"),
        (lambda: rk.EnergyLossAtSpeed((0, 0, 0), (0, math.nan, 0)), ValueError, "right.*finite"),
        (lambda: rk.RandomEnergyRatio(seed=1), TypeError, "left and right"),
        (lambda: rk.RandomEnergyRatio([1.1, 1.2]), ValueError, "without one from 0"),
        (lambda: rk.RandomEnergyRatio(0.8), ValueError, "give a list"),
        (lambda: rk.RandomEnergyRatio([0.8], seed=0.5), TypeError, "whole number"),
        (lambda: rk.RandomEnergyRatio.normal(0.8, 0.0), ValueError, "std positive"),
        (lambda: rk.RandomEnergyRatio.normal(9.0, 0.1), ValueError, "nothing from 0 to 1"),
    ],
)
def test_what_is_no_law(made, error, says):
    with pytest.raises(error, match=says):
        made()
