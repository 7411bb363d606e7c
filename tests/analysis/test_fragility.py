"""Fragility curves: against closed forms, an optimisation of another kind, and chance itself."""

import dataclasses
from itertools import product

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize
from scipy.stats import binomtest, norm, t as student

from benchmarks import dependence
from rockeom.analysis.risk.fragility import (
    fit_fragility,
    fragility_of,
    proportion_interval,
    proportion_interval_by_group,
)
from rockeom.analysis.sweeps import outcome_labels, peaks_of
from tests.refusals import refused, told

IM = np.array([0.1, 0.2, 0.3, 0.4, 0.6, 0.8])
HITS = np.array([0, 2, 5, 4, 9, 19])
OF = np.array([20, 20, 18, 10, 15, 20])


def probability(im, median, dispersion):
    return norm.cdf(np.log(im / median) / dispersion)


def unlikelihood(parameters, im=IM, hits=HITS, of=OF):
    """The negative logarithm of Baker's equation 11, by binomial probabilities."""
    p = probability(im, *parameters)
    return -np.sum(hits * np.log(p) + (of - hits) * np.log1p(-p))


# --- the curve


def test_median_and_dispersion_are_those_another_optimisation_finds():
    found = minimize(unlikelihood, [0.5, 0.5], method="Nelder-Mead",
                     options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000})  # fmt: skip
    curve = fit_fragility(IM, HITS, OF)
    assert (curve.median, curve.dispersion) == pytest.approx(found.x, rel=1e-6)


@pytest.mark.parametrize("unit", [1e-3, 1.0, 9.81e3])
def test_two_intensities_are_met_exactly_in_any_unit(unit):
    """As many parameters as fractions: Phi(ln(x/median)/dispersion) is each of them."""
    im, hits = unit * np.array([0.2, 0.5]), np.array([3, 16])
    curve = fit_fragility(im, hits, 20)
    deviates = norm.ppf(hits / 20)
    dispersion = np.log(im[1] / im[0]) / (deviates[1] - deviates[0])
    assert curve.dispersion == pytest.approx(dispersion, rel=1e-10)
    assert curve.median == pytest.approx(im[0] * np.exp(-deviates[0] * dispersion), rel=1e-10)
    np.testing.assert_allclose(curve.probability(im), hits / 20, rtol=1e-10)


def test_single_motions_say_the_same_as_their_numbers():
    each = np.repeat(IM, OF)
    exceeded = np.concatenate([np.arange(n) < k for n, k in zip(OF, HITS, strict=True)])
    one, all_ = fit_fragility(each, exceeded), fit_fragility(IM, HITS, OF)
    assert (one.median, one.dispersion) == pytest.approx((all_.median, all_.dispersion), rel=1e-9)
    np.testing.assert_allclose(one.covariance, all_.covariance, rtol=1e-8)
    for found, expected in zip(one.fractions(), (IM, HITS / OF), strict=True):
        np.testing.assert_allclose(found, expected)


@pytest.mark.parametrize(("median", "dispersion"), [(0.3, 0.1), (2.0, 0.6), (50.0, 1.5)])
def test_fractions_of_a_known_curve_give_it_back(median, dispersion):
    """A billion motions: fractions are probabilities but for the last."""
    im = median * np.exp(dispersion * np.linspace(-2.0, 2.0, 9))
    number = 10**9
    hits = np.round(number * probability(im, median, dispersion))
    curve = fit_fragility(im, hits, number)
    assert (curve.median, curve.dispersion) == pytest.approx((median, dispersion), rel=1e-6)


# --- its doubt


def test_covariance_is_the_inverse_of_the_information_by_differences():
    """Expected information of binomial counts: the sum of n (dp/dx)(dp/dy)/(p(1-p))."""
    curve = fit_fragility(IM, HITS, OF)
    at = np.array([curve.median, curve.dispersion])
    p = probability(IM, *at)
    slopes = []
    for i in range(2):
        step = 1e-6 * at * (np.arange(2) == i)
        change = probability(IM, *(at + step)) - probability(IM, *(at - step))
        slopes.append(change / (2 * step[i]))
    information = np.array([[np.sum(OF * a * b / (p * (1 - p))) for a in slopes] for b in slopes])
    np.testing.assert_allclose(curve.covariance, np.linalg.inv(information), rtol=1e-7)


def test_bounds_lie_around_the_truth_as_often_as_their_level_says():
    rng = np.random.default_rng(5)
    im = np.linspace(0.2, 1.2, 11)
    truth = probability(im, 0.6, 0.4)
    inside = []
    for hits in rng.binomial(44, truth, size=(150, len(im))):
        low, high = fit_fragility(im, hits, 44).bounds(im, 0.9)
        inside.append((low <= truth) & (truth <= high))
    assert np.mean(inside, axis=0) == pytest.approx(0.9, abs=0.08)


def test_bounds_hold_the_curve_and_widen_with_the_level():
    curve = fit_fragility(IM, HITS, OF)
    im = np.linspace(0.01, 2.0, 50).reshape(5, 10)
    (low, high), (lower, higher) = curve.bounds(im, 0.5), curve.bounds(im, 0.95)
    p = curve.probability(im)
    assert p.shape == low.shape == (5, 10)
    assert np.all((lower <= low) & (low <= p) & (p <= high) & (high <= higher))
    assert refused(curve.bounds, im, 95) == ("level", 95)


# --- what has no curve


@pytest.mark.parametrize(
    ("im", "hits", "of", "message"),
    [
        ([0.1, 0.2, 0.3, 0.4], [0, 0, 5, 5], 5, "separable"),
        ([0.1, 0.2, 0.3], [0, 2, 5], 5, "separable"),
        ([0.1, 0.2], [0, 0], 5, "none of 10 motions exceeded"),
        ([0.1, 0.2], [5, 5], 5, "all of 10 motions exceeded"),
        ([0.3, 0.3], [1, 0], 1, "all motions have the intensity 0.3"),
        ([0.1, 0.2, 0.3], [4, 3, 1], 5, "falls as the intensity rises"),
        ([0.1, 0.3], [5, 0], 5, "falls as the intensity rises"),
        ([0.0, 0.3], [0, 3], 5, r"intensity\[0\] is 0"),
        ([0.1, 0.3], [0, 6], 5, r"exceeded\[1\] is 6"),
        ([0.1, 0.3], [0.5, 2], 5, "whole numbers"),
        ([0.1, np.nan], [0, 2], 5, "finite"),
        ([0.1, 0.2, 0.3], [0, 2], 5, "do not broadcast"),
    ],
)
def test_what_no_curve_fits_best_is_refused_and_said_why(im, hits, of, message):
    with pytest.raises(ValueError, match=message):
        fit_fragility(im, hits, of)


# --- of a sweep


def sweep(outcome=None) -> xr.Dataset:
    """Four records at five intensities; one case of the last record has no answer."""
    labels = np.array([
        ["came to rest", "came to rest", "completed", "overturned", "overturned"],
        ["completed", "overturned", "overturned", "overturned", "overturned"],
        ["completed", "completed", "completed", "completed", "overturned"],
        ["completed", "completed", "overturned", "stalled", "completed"],
    ])  # fmt: skip
    peak = np.where(labels == "overturned", 1.6, 0.02 * np.arange(1, 6))
    return xr.Dataset(
        {
            "outcome": (("record", "pga"), labels) if outcome is None else outcome(labels),
            "peak": (("record", "pga", "state"), np.stack([peak, 9 * peak], axis=-1)),
        },
        coords={"record": list("abcd"), "pga": [1.0, 2.0, 3.0, 4.0, 5.0],
                "state": ["theta", "theta_dot"]},
    )  # fmt: skip


def flagged(labels):
    """Numbers with the meanings of CF, in no order."""
    flags = {"stalled": 0, "overturned": 7, "came_to_rest": 2, "completed": 3}
    numbers = np.vectorize(lambda x: flags[x.replace(" ", "_")])(labels)
    attrs = {"flag_values": np.array([*flags.values()]), "flag_meanings": " ".join(flags)}
    return xr.Variable(("record", "pga"), numbers, attrs)


@pytest.mark.parametrize("outcome", [None, flagged])
def test_sweep_counts_who_overturns_at_each_intensity(outcome):
    curve = fragility_of(sweep(outcome), intensity="pga")
    expected = fit_fragility([1, 2, 3, 4, 5], [0, 1, 2, 2, 3], [4, 4, 4, 3, 4])
    assert (curve.median, curve.dispersion) == pytest.approx(
        (expected.median, expected.dispersion), rel=1e-9
    )
    assert curve.left_out == 1
    assert curve.number.sum() == 19


def test_sweep_counts_who_reaches_a_limit_or_overturns():
    curve = fragility_of(sweep(), intensity="pga", demand="theta", limit=0.0999)
    _, fractions = curve.fractions()
    np.testing.assert_allclose(fractions, [0, 1 / 4, 2 / 4, 2 / 3, 1.0])


def test_cases_of_a_table_count_as_those_of_a_grid():
    table = sweep().stack(case=("record", "pga")).reset_index("case")
    one, other = fragility_of(table, intensity="pga"), fragility_of(sweep(), intensity="pga")
    assert one.median == pytest.approx(other.median, rel=1e-9)


def test_labels_are_the_same_however_outcomes_are_kept():
    found = outcome_labels(sweep(flagged))
    np.testing.assert_array_equal(found.values, outcome_labels(sweep()).values)
    assert found.dims == ("record", "pga")


def test_names_that_a_sweep_does_not_have_are_refused_with_those_it_has():
    assert refused(fragility_of, sweep(), intensity="pgv") == ("name", "pgv")
    assert refused(peaks_of, sweep(), "drift") == ("name", "drift")
    assert refused(fragility_of, sweep(), intensity="pga", limit=0.1) == ("limit", 0.1)
    with pytest.raises(ValueError, match="no `outcome`"):
        outcome_labels(sweep().drop_vars("outcome"))
    odd = sweep(flagged)
    odd["outcome"].attrs["flag_meanings"] = "completed"
    assert "do not name it" in told(outcome_labels, odd)


# --- records scaled to several intensities, and fractions by themselves


def scaled_records(n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """(n, 8) which of n records overturns at each intensity, each from its own one on."""
    limits = 0.6 * np.exp(0.4 * np.random.default_rng(seed).standard_normal((n, 1)))
    im = np.array([0.15, 0.25, 0.35, 0.5, 0.7, 0.9, 1.2, 1.6])
    return np.broadcast_to(im, (n, 8)), im > limits


def test_covariance_by_record_is_that_of_scores_which_one_capacity_decides():
    """By numerical slopes, and the covariance of indicators that one normal number decides."""
    im, hits = scaled_records(20, seed=3)
    curve = fit_fragility(im, hits, group=np.arange(20)[:, None])
    best, levels = np.array([curve.median, curve.dispersion]), im[0]
    steps = 1e-5 * np.eye(2)
    p = probability(levels, *best)
    slopes = np.array([
        probability(levels, *(best + h)) - probability(levels, *(best - h)) for h in steps
    ]) / 2e-5  # fmt: skip
    indicators = np.minimum.outer(p, p) - np.multiply.outer(p, p)
    weights = slopes / (p * (1 - p))
    bread = np.linalg.inv(20 * weights @ slopes.T)
    expected = bread @ (20 * weights @ indicators @ weights.T) @ bread
    np.testing.assert_allclose(curve.covariance, expected, rtol=1e-6)


def test_record_that_is_counted_twice_says_nothing_new():
    im, hits = scaled_records(20, seed=3)
    record = np.arange(20)[:, None]
    once = fit_fragility(im, hits, group=record)
    twice = fit_fragility(*(np.hstack([x, x]) for x in (im, hits)), group=record)
    np.testing.assert_allclose(twice.covariance, once.covariance, rtol=1e-9)


def test_interval_of_a_quantile_ends_where_a_bound_has_its_probability():
    grouped = fragility_of(of_recordings(), intensity="pga")
    for curve, part in product((grouped, fit_fragility(IM, HITS, OF)), (0.05, 0.5, 0.9)):
        value, low, high = curve.quantile(part, level=0.9)
        assert (curve.probability(value), curve.bounds(low, 0.9)[1]) == pytest.approx((part, part))
        assert curve.bounds(high, 0.9)[0] == pytest.approx(part)


def test_interval_by_record_is_wider_by_students_factor():
    im, hits = scaled_records(20, seed=3)
    curve = fit_fragility(im, hits, group=np.arange(20)[:, None])
    low, high = curve.bounds(0.5)
    width = norm.ppf(high) - norm.ppf(low)
    low, high = dataclasses.replace(curve, groups=0).bounds(0.5)
    factor = student.ppf(0.975, 19) / norm.ppf(0.975)
    assert width == pytest.approx(factor * (norm.ppf(high) - norm.ppf(low)))


def test_interval_of_a_curve_that_may_be_flat_has_no_end():
    curve = fit_fragility([0.5, 0.5, 1.0, 1.0], [0, 1, 0, 1], [3, 3, 1, 1])
    assert curve.quantile(0.5)[1:] == (0.0, np.inf)
    with pytest.raises(ValueError, match="falls as the intensity rises"):
        fit_fragility([0.5, 1.0], [300_000, 300_001], 10**6)


def test_interval_by_group_is_that_of_groups_all_or_any_of_which_exceed():
    group = np.repeat(np.arange(6), 2)
    hits = np.array([1, 1, 1, 0, 0, 0, 0, 0, 1, 1, 0, 1], dtype=bool)
    every = binomtest(2, 6).proportion_ci(0.95, method="exact")
    some = binomtest(4, 6).proportion_ci(0.95, method="exact")
    assert proportion_interval_by_group(hits, group) == pytest.approx((every.low, some.high))
    none = proportion_interval_by_group(np.zeros(12), group)
    assert none == pytest.approx((0.0, 1.0 - 0.025 ** (1 / 6)))  # 0.459, of 12 tests 0.265
    assert refused(proportion_interval_by_group, hits, group[:3]) == ("group", 3)


@pytest.mark.parametrize("level", [0.5, 0.95, 0.999])
def test_interval_of_a_fraction_is_that_of_scipy(level):
    for number in (1, 7, 44):
        for hits in (0, 1, number // 2, number):
            expected = binomtest(hits, number).proportion_ci(level, method="exact")
            assert proportion_interval(hits, number, level) == pytest.approx(expected, abs=1e-12)


def test_impossible_fractions_are_refused():
    for wrong in ((5, 4), (-1, 4), (0, 0)):
        assert "proportion_interval" in told(proportion_interval, *wrong)


# --- recordings of a sweep, and cases without an answer


def of_recordings(n=12, shared=0.5, **changed) -> xr.Dataset:
    made = dependence.recordings(np.random.default_rng(1), n, shared)
    return made.assign_coords(**changed)


def test_components_of_a_recording_are_one_group():
    """By default from the names, which scaled motions have with a factor and a number."""
    sweep = of_recordings()
    default = fragility_of(sweep, intensity="pga")
    station, fell = np.repeat(np.arange(12), 2)[:, None], sweep.outcome.values == "overturned"
    by_hand = fit_fragility(sweep.pga.values, fell, group=station)
    np.testing.assert_allclose(default.covariance, by_hand.covariance)
    assert default.groups == 12
    assert repr(default).endswith("192 motions in 12 groups")
    table = sweep.stack(case=("motion", "pga")).reset_index("case")
    names = [f"{name}-A1.5-T1 (2)" for name in table.motion.values]
    for other in (table, table.assign_coords(motion=("case", names))):
        curve = fragility_of(other, intensity="pga")
        np.testing.assert_allclose(curve.covariance, default.covariance)


@pytest.mark.parametrize(
    ("group", "groups", "said"),
    [
        ("motion", 24, "192 motions in 24 groups"),
        ("event", 4, "192 motions in 4 groups"),
        (None, 0, "192 motions counted as independent"),
    ],
)
def test_groups_of_another_name_or_none_are_said(group, groups, said):
    place = np.arange(24)
    sweep = of_recordings(event=("motion", place % 4), region=("motion", np.zeros(24)))
    curve = fragility_of(sweep, intensity="pga", group=group)
    assert curve.groups == groups
    assert said in repr(curve)
    assert refused(fragility_of, sweep, intensity="pga", group="region") == ("group", 1)
    assert refused(fragility_of, sweep, intensity="pga", group="evnt") == ("name", "evnt")
