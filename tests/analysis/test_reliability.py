"""Probabilities of failure beside closed forms: planes, thrown and pushed slender blocks, peaks."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies
from scipy import stats
from scipy.optimize import minimize, minimize_scalar

import rockeom as rk
from rockeom.analysis import risk
from tests.refusals import refused, refuses

P = 2.0
RADIUS = 0.75 * 9.81 / P**2
"""Of a slender block whose frequency parameter is P."""
SIZES = strategies.floats(0.2, 5.0)
SLENDER_AND_FAST = {"alpha": stats.lognorm(0.1, scale=0.2), "speed": stats.lognorm(0.3, scale=0.2)}


def thrown(alpha, speed):
    """From upright with a rate of rotation [rad/s]; it overturns beyond P alpha."""
    block = rk.SlenderBlock(alpha=alpha, radius=RADIUS)
    still = rk.GroundMotion.none(3.0)
    return rk.Case(block, still, rk.EnergyRatio(0.8), {"theta_dot": speed})


def test_a_plane_of_normal_variables_is_exact():
    """Of g = c + a . x the index is the mean over the standard deviation of g."""

    @settings(max_examples=12, deadline=None)
    @given(strategies.lists(SIZES, min_size=2, max_size=5), SIZES, strategies.booleans())
    def of_any(slopes, size, fails):
        names = [f"x{i}" for i in range(len(slopes))]
        slopes = np.array(slopes) * (-1.0) ** np.arange(len(slopes))
        random = {name: stats.norm(i, 0.3 + i) for i, name in enumerate(names)}
        mean = slopes @ np.arange(len(slopes))
        spread = np.abs(slopes) * (0.3 + np.arange(len(slopes)))
        index = (-size if fails else size) * 1.1
        constant = index * np.linalg.norm(spread) - mean

        def plane(**x):
            return sum((a * x[name] for a, name in zip(slopes, names, strict=True)), constant)

        found = risk.first_order_reliability(plane, random)
        assert found.settled
        assert found.index == pytest.approx(index, rel=1e-9)
        parts = spread**2 / (spread @ spread)
        assert [*found.importance.values()] == pytest.approx(parts, abs=1e-6)
        assert found.probability == pytest.approx(stats.norm.sf(index))
        assert plane(**found.design_point) == pytest.approx(0.0, abs=1e-7)

    of_any()


def test_strength_and_load_that_are_lognormal():
    random = {"strength": stats.lognorm(0.2, scale=5.0), "load": stats.lognorm(0.3, scale=2.0)}
    found = risk.first_order_reliability(lambda strength, load: strength - load, random)
    assert found.index == pytest.approx(math.log(2.5) / math.hypot(0.2, 0.3), rel=1e-9)


def test_one_uniform_variable_has_its_own_probability():
    random = {"x": stats.uniform(0.0, 1.0)}
    rare = risk.first_order_reliability(lambda x: 0.999 - x, random)
    assert rare.probability == pytest.approx(1e-3, rel=1e-8)
    often = risk.first_order_reliability(lambda x: 0.1 - x, random)
    assert often.index < 0.0
    assert often.probability == pytest.approx(0.9, rel=1e-8)


@pytest.mark.parametrize("bend", [0.3, -0.3, 1.0])
def test_a_curved_boundary_is_nearest_where_another_minimisation_has_it(bend):
    random = {"a": stats.norm(0.5, 1.0), "b": stats.norm(0.0, 1.0)}
    found = risk.first_order_reliability(lambda a, b: 3.0 + bend * a * a - b, random)
    other = minimize(
        lambda u: u @ u, [0.5, 2.0], method="SLSQP", tol=1e-14,
        constraints={"type": "eq", "fun": lambda u: 3.0 + bend * (0.5 + u[0]) ** 2 - u[1]},
    )  # fmt: skip
    assert found.settled
    assert found.index == pytest.approx(math.sqrt(other.fun), abs=1e-6)
    assert found.runs < 40


def test_a_corner_is_named_and_its_distance_found_nearly():
    """Both must be exceeded, so that the nearest failure is where two planes meet."""
    random = {"a": stats.norm(0.0, 1.0), "b": stats.norm(0.5, 1.0)}
    found = risk.first_order_reliability(lambda a, b: max(3.0 - a, 3.0 - b), random)
    assert not found.settled
    assert found.angle > 0.1
    assert found.index == pytest.approx(math.hypot(3.0, 2.5), rel=1e-4)
    assert "not settled" in repr(found)


def test_a_thrown_slender_block_overturns_as_its_energy_says():
    """Where speed > P alpha: of logarithms a plane."""
    found = risk.reliability_of(thrown, SLENDER_AND_FAST)
    exact = math.log(P) / math.hypot(0.1, 0.3)
    assert found.settled
    assert found.index == pytest.approx(exact, abs=1e-9)
    assert found.importance["speed"] == pytest.approx(0.9, abs=1e-6)
    assert found.design_point["speed"] == pytest.approx(P * found.design_point["alpha"], rel=1e-9)
    counted = risk.monte_carlo(
        thrown, SLENDER_AND_FAST, 4000, sweep_options=rk.SweepOptions(lanes=False, progress=False)
    )
    low, high = counted.interval(0.99)
    assert low < stats.norm.sf(exact) < high
    assert counted.number == 4000


def test_a_slender_block_whose_median_overturns():
    random = SLENDER_AND_FAST | {"speed": stats.lognorm(0.3, scale=0.6)}
    found = risk.reliability_of(thrown, random)
    assert found.index == pytest.approx(math.log(0.4 / 0.6) / math.hypot(0.1, 0.3), abs=1e-9)


def test_a_slender_block_pushed_for_a_while():
    """It stays beyond its equilibrium where a > g alpha/(1 - exp(-P T)), with T random, too."""

    def pushed(alpha, a, length):
        block = rk.SlenderBlock(alpha=alpha, radius=RADIUS)
        ground = rk.GroundMotion.constant(a, length, total_duration=3.0)
        return rk.Case(block, ground, rk.EnergyRatio(0.8))

    random = {
        "alpha": stats.lognorm(0.1, scale=0.2), "a": stats.lognorm(0.3, scale=2.0),
        "length": stats.norm(0.4, 0.06),
    }  # fmt: skip

    def squared(u):
        alpha, length = 0.2 * math.exp(0.1 * u[0]), 0.4 + 0.06 * u[1]
        a = 9.81 * alpha / (1.0 - math.exp(-P * length))
        return u @ u + (math.log(a / 2.0) / 0.3) ** 2

    found, exact = risk.reliability_of(pushed, random), minimize(squared, [0.0, 0.0], tol=1e-10)
    assert found.settled
    assert found.index == pytest.approx(math.sqrt(exact.fun), abs=1e-8)
    assert found.deviates[[0, 2]] == pytest.approx(exact.x, abs=1e-4)


def test_a_rigid_block_is_nearest_to_overturning_after_an_impact():
    """No ray beside the one found meets overturning sooner, which fates alone tell."""

    def struck(half_width, r, amplitude):
        block = rk.RigidBlock(half_width=half_width, half_height=0.6)
        pulse = rk.GroundMotion.single_sine(amplitude, 0.7, duration=4.0)
        return rk.Case(block, pulse, rk.EnergyRatio(r))

    random = {
        "half_width": stats.norm(0.12, 0.006), "r": stats.uniform(0.7, 0.2),
        "amplitude": stats.lognorm(0.15, scale=2.2),
    }  # fmt: skip
    found = risk.reliability_of(struck, random)
    assert found.settled
    at = found.design_point | {"amplitude": found.design_point["amplitude"] * (1.0 + 1e-9)}
    run = rk.simulate(**vars(struck(**at)))
    assert str(run.outcome) == "overturned"
    assert len(run.impacts) == 1
    assert found.importance["r"] > 1e-4  # without an impact it is 0
    ray = found.deviates / found.index
    across = np.linalg.svd(ray[None])[2][1:]
    for side in (*across, *-across):
        beside = ray + 1e-3 * side
        u = 0.999999 * found.index * np.sqrt(1.0 + 1e-6) * beside / np.linalg.norm(beside)
        of = zip(random.items(), stats.norm.cdf(u), strict=True)
        values = {name: float(marginal.ppf(p)) for (name, marginal), p in of}
        assert str(rk.simulate(**vars(struck(**values))).outcome) != "overturned"


def test_the_peak_of_a_thrown_block_and_its_largest_rate():
    """P^2 (2 alpha theta - theta^2) is the square of the speed at which it passes upright."""

    def needed(u, limit):
        alpha = 0.2 * math.exp(0.1 * u)
        speed = P * math.sqrt(2.0 * alpha * limit - limit**2)
        return math.hypot(u, math.log(speed / 0.2) / 0.3)

    exact = minimize_scalar(needed, bracket=(-1.0, 1.0), args=(0.1,), tol=1e-12).fun
    found = risk.reliability_of(thrown, SLENDER_AND_FAST, demand="theta", limit=0.1)
    assert found.index == pytest.approx(exact, abs=1e-8)
    # the speed is largest at the start
    fast = risk.reliability_of(thrown, SLENDER_AND_FAST, demand="theta_dot", limit=0.3)
    assert fast.index == pytest.approx(math.log(0.3 / 0.2) / 0.3, abs=1e-8)
    assert fast.importance["alpha"] == pytest.approx(0.0, abs=1e-12)


def test_none_of_n_has_the_interval_of_clopper_and_pearson():
    random = SLENDER_AND_FAST | {"speed": stats.uniform(0.01, 0.01)}
    counted = risk.monte_carlo(
        thrown, random, 20, sweep_options=rk.SweepOptions(lanes=False, progress=False)
    )
    assert counted.probability == 0.0
    assert counted.interval(0.9) == pytest.approx((0.0, 1.0 - 0.05 ** (1 / 20)))
    again = risk.monte_carlo(
        thrown, random, 20, sweep_options=rk.SweepOptions(lanes=False, progress=False)
    )
    assert again.sweep.equals(counted.sweep)
    peaks = risk.monte_carlo(
        thrown,
        random,
        20,
        demand="displacement",
        limit=1e-9,
        sweep_options=rk.SweepOptions(lanes=False, progress=False),
    )
    assert peaks.probability == 1.0
    lost = counted.sweep.assign(outcome=("case", ["no solution"] * 5 + ["completed"] * 15))
    said = repr(risk.MonteCarlo(3, 15, 5, lost))
    assert "5 without an answer (5 no solution) left out: 0.15 if none of them fails, 0.4" in said


def test_what_has_no_reliability_is_refused_with_the_reason():
    first, normal = risk.first_order_reliability, {"x": stats.norm(1.0, 0.1)}
    assert refused(first, lambda x: x, {"x": 0.9})[0] == "random"
    assert refused(first, lambda: 1.0, {})[0] == "random"
    with pytest.raises(ValueError, match="no parameter changes the limit state"):
        first(lambda x: 1.0, normal)
    with pytest.raises(ValueError, match="no failure was found within 6 standard"):
        first(lambda x: x, normal)
    with pytest.raises(ValueError, match="jumps"):
        first(lambda x: x if x > 0.8 else -math.inf, normal)
    with pytest.raises(ValueError, match="must be finite"):
        first(lambda x: x * math.nan, normal)
    assert refused(risk.reliability_of, thrown, SLENDER_AND_FAST, demand="theta")[0] == "limit"
    with refuses("limit", 0.0):
        risk.monte_carlo(thrown, SLENDER_AND_FAST, demand="theta", limit=0.0)
    with refuses("of", "base_shear"):
        risk.reliability_of(thrown, SLENDER_AND_FAST, demand="base_shear", limit=1.0)
    slow = SLENDER_AND_FAST | {"speed": stats.uniform(0.01, 0.01)}
    with pytest.raises(ValueError, match="no failure was found within 6 standard"):
        risk.reliability_of(thrown, slow)
