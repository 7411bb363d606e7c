"""Statistical validation: known truth, closed forms, enumeration, SciPy where all stood."""

import math
from functools import partial
from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy import stats

import rockeom as rk
from benchmarks import coverage, dependence
from rockeom.analysis import validation
from rockeom.analysis.validation import Ensemble
from rockeom.analysis.validation.comparison import OUTCOME_TESTS, PEAK_TESTS
from tests.refusals import refused, refuses, told

FELL = np.inf


def ensemble(*peaks) -> Ensemble:
    """An ensemble of peaks, infinite where the motion overturned."""
    given_ = np.array(peaks, dtype=float)
    return Ensemble(given_, np.isinf(given_))


# --- motions that overturned are in everything


def test_an_overturned_motion_needs_no_peak_and_exceeds_every_rotation():
    made = Ensemble([0.1, np.nan, 0.3], [False, True, False])
    assert made.peaks.tolist() == [0.1, np.inf, 0.3]
    assert made.distribution([0.1, 0.2, 1e9]).tolist() == pytest.approx([1 / 3, 1 / 3, 2 / 3])
    assert made.censored(0.2).tolist() == [0.1, 0.2, 0.2]
    assert repr(made) == "Ensemble: 3 motions, 1 overturned"


def test_noise_of_a_block_at_rest_is_no_rotation():
    made = ensemble(2e-4, 0.0, 0.3, FELL).resolved(0.001)
    assert made.peaks.tolist() == [0.0, 0.0, 0.3, np.inf]
    assert made.overturned.tolist() == [False, False, False, True]


@pytest.mark.parametrize(
    ("peaks", "overturned", "error", "words"),
    [
        ([0.1, np.nan], [True, False], ValueError, "peaks[1]"),
        ([0.1, np.inf], False, ValueError, "peaks[1]"),
        ([0.1, -0.2], False, ValueError, "peaks[1]"),
        ([0.1, 0.2], [0, 1], TypeError, "overturned"),
        ([0.1, 0.2], [True], ValueError, "peaks"),
        ([], False, ValueError, "peaks"),
        (["high"], False, TypeError, "peaks"),
    ],
)
def test_missing_peaks_and_outcomes_are_named(peaks, overturned, error, words):
    with refuses(words, kind=error):
        Ensemble(peaks, overturned)


def test_a_number_of_overturned_motions_needs_a_limit():
    measured, simulated = (
        ensemble(0.1, FELL),
        ensemble([0.1, 0.2, 0.3] * 13, [0.1, FELL, FELL] * 13),
    )
    for function in (validation.crps, validation.compare_means, validation.predictive_test):
        with pytest.raises(ValueError, match=r"1 of 2 motions overturned and have no peak: give l"):
            function(measured, simulated)
        function(measured, simulated, limit=0.25)
        assert refused(function, measured, simulated, limit=-1.0) == ("limit", -1.0)


def test_a_sweep_is_an_ensemble_unless_a_case_gave_no_answer():
    block = rk.RigidBlock(half_width=0.1, half_height=0.5)
    case = rk.Case(block, rk.GroundMotion.single_sine(2.2, 0.5, duration=3.0))
    sweep = rk.simulate_many(case, {"amplitude": [1.0, 2.2, 20.0]})
    made = Ensemble.from_sweep(sweep)
    assert made.overturned.tolist() == [False, False, True]
    peak = rk.simulate(block, case.motion).extremes("theta").peak
    assert made.peaks[1] == pytest.approx(peak, rel=1e-8)
    sweep["outcome"].values[1] = "too many steps"
    assert "3 cases 1 without an answer (1 too many steps" in told(Ensemble.from_sweep, sweep)


# --- coverage of intervals, size and power of tests, on known truth


@pytest.mark.parametrize(
    ("name", "replicates"),
    [
        ("band of 10, 30% overturned", 400),
        ("band of 40, 0% overturned", 400),
        ("distance of means, 40 x 100, 30% overturned", 300),
        ("distance of means, 40 and 160, 0% overturned", 300),
        ("probability, interval of 60", 80),
        ("probability, range of 10", 200),
        ("calibration of 10, size", 100),
        ("paired difference, 20 records", 800),
        ("cramer-von mises, 20 and 60, 30%, size", 40),
        ("anderson-darling, 20 and 60, 30%, size", 40),
        ("kolmogorov-smirnov, 20 and 60, 30%, size", 40),
        ("fisher, 30 and 60, 30 %, size", 200),
        ("predictive, 10, 60%, parameter shared, size", 300),
        ("predictive, 60, 30%, independent, size", 150),
        ("sample size for a mean 0.4 off, power 0.8", 400),
        ("sample size for a distribution 0.3 off, power 0.8", 100),
    ],
)
def test_what_is_stated_holds_on_known_truth(name, replicates):
    """The whole study is `python -m benchmarks.coverage`."""
    (study,) = (one for one in coverage.studies() if one.name == name)
    assert coverage.keeps(study, coverage.hits(study, replicates, seed=1), replicates)


def test_the_band_is_no_wider_than_its_level_needs():
    """That of a level of 0.5 is left about as often as the distribution of Kolmogorov says."""
    n, replicates = 50, 400
    rng = np.random.default_rng(2)
    holds = 0
    for _ in range(replicates):
        made = Ensemble(np.sort(rng.random(n)))
        lower, _ = made.band(made.peaks, 0.5)
        _, upper = made.band(np.nextafter(made.peaks, 0.0), 0.5)
        holds += bool(((lower <= made.peaks) & (made.peaks <= upper)).all())
    reach = np.sqrt(np.log(4.0) / (2 * n))
    expected = stats.kstwo.cdf(reach, n)
    assert expected > 0.5
    assert abs(holds / replicates - expected) < 4 * np.sqrt(0.25 / replicates)


@pytest.mark.parametrize(
    ("what", "n", "m", "shared"),
    [
        (dependence.band, 20, 5, 0.5),
        (dependence.band, 20, 20, 0.2),
        (dependence.calibration, 40, 60, 0.5),
    ],
)
def test_what_is_said_of_campaigns_holds_where_their_tests_share_a_parameter(what, n, m, shared):
    """The whole study is `python -m benchmarks.dependence`."""
    once = partial(what, n=n, m=m, shared=shared)
    found, _ = dependence.counts(dependence.Study("", once), 150, seed=1)
    parts = {name: one.true / one.number for name, one in found.items()}
    assert parts.pop("size, independent", 0.5) > 0.3  # a right model, rejected
    assert parts.pop("size, outcomes", 0.0) < 0.1
    assert all(part > 0.9 for part in parts.values())


def test_band_of_campaigns_of_independent_tests_is_that_of_all_motions():
    """Both reach as far where nothing is shared, that of one campaign by an inequality."""
    peaks = np.exp(np.random.default_rng(3).standard_normal((20, 200)))
    every, one = Ensemble(peaks), Ensemble(peaks.ravel())
    reach = [made.band(1.0)[1] - made.distribution(1.0) for made in (every, one)]
    assert 0.85 < reach[0] / reach[1] < 1.1
    assert (every.campaigns, one.campaigns) == (200, 1)
    alike = Ensemble(np.repeat(peaks[:, :1], 30, axis=1))  # thirty times the same campaign
    assert alike.band(1.0)[0] == alike.distribution(1.0)


@pytest.mark.parametrize("change", [{"shift": 0.4}, {"shift": -0.4}, {"spread": 2.0}])
def test_a_campaign_of_another_truth_is_rejected(change):
    pairs = (coverage.campaign(np.random.default_rng(i), 60, 199, 0.3, **change) for i in range(10))
    limit = coverage.limit_of(0.3)
    assert sum(validation.predictive_test(*p, limit=limit).p_value <= 0.05 for p in pairs) >= 8


# --- tests


@pytest.mark.parametrize("seed", range(3))
def test_where_nothing_overturned_the_tests_are_those_of_scipy(seed):
    rng = np.random.default_rng(seed)
    x, y = rng.random(25), rng.random(60) ** 1.5
    by = {test: validation.compare_peaks(Ensemble(x), Ensemble(y), test) for test in PEAK_TESTS}
    references = stats.cramervonmises_2samp(x, y), stats.ks_2samp(x, y)
    for test, reference in zip(PEAK_TESTS[:2], references, strict=True):
        assert by[test].statistic == pytest.approx(reference.statistic, rel=1e-9)
        assert by[test].p_value == pytest.approx(reference.pvalue, abs=0.03)


def test_the_statistic_of_anderson_and_darling_is_that_of_pettitt():
    """Pettitt (1976), Biometrika 63(1), 161-168: of the numbers of x among the first i of all."""
    rng = np.random.default_rng(4)
    x, y = rng.random(12), rng.random(30)
    n, m = len(x), len(y)
    both = np.sort(np.concatenate([x, y]))
    i = np.arange(1, n + m)
    of_x = np.searchsorted(np.sort(x), both[:-1], side="right")
    expected = ((of_x * (n + m) - n * i) ** 2 / (i * (n + m - i))).sum() / (n * m)
    found = validation.compare_peaks(Ensemble(x), Ensemble(y), "anderson-darling")
    assert found.statistic == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("test", PEAK_TESTS)
def test_the_p_value_with_overturned_motions_is_that_of_all_divisions(test):
    values = np.array([0.1, 0.1, 0.4, FELL, 0.2, 0.5, 0.6, FELL, FELL])
    n = 4

    def statistic(chosen):
        x, y = values[list(chosen)], np.delete(values, list(chosen))
        at, times = np.unique(values, return_counts=True)
        f, g, h = (np.array([(a <= v).mean() for v in at]) for a in (x, y, values))
        size = len(x) * len(y) / len(values) ** 2
        if test == "kolmogorov-smirnov":
            return np.abs(f - g).max()
        weight = times if test == "cramer-von mises" else times[:-1] / (h * (1 - h))[:-1]
        return size * (weight * ((f - g) ** 2)[: len(weight)]).sum()

    all_ = np.array([statistic(c) for c in combinations(range(len(values)), n)])
    measured, simulated = ensemble(*values[:n]), ensemble(*values[n:])
    found = validation.compare_peaks(measured, simulated, test)
    assert found.statistic == pytest.approx(all_[0], rel=1e-12)
    assert found.p_value == pytest.approx((all_ >= all_[0] - 1e-12).mean(), abs=0.02)


def test_ensembles_that_all_overturned_are_alike():
    both = ensemble(FELL, FELL), ensemble(FELL, FELL, FELL)
    for test in PEAK_TESTS:
        assert validation.compare_peaks(*both, test) == (0.0, 1.0)
    for test in OUTCOME_TESTS:
        assert validation.compare_outcomes(*both, test).p_value == 1.0


def test_outcomes_are_compared_by_the_numbers_that_overturned():
    """Fisher's tea: 3 of 4 and 1 of 4, of which the p-value is 34/70."""
    measured, simulated = ensemble(0.1, FELL, FELL, FELL), ensemble(0.1, 0.2, 0.3, FELL)
    found = validation.compare_outcomes(measured, simulated)
    assert found == pytest.approx((9.0, 34 / 70))
    assert validation.compare_outcomes(measured, simulated, "barnard").p_value < found.p_value


@pytest.mark.parametrize("function", [validation.compare_peaks, validation.compare_outcomes])
def test_an_unknown_test_comes_with_a_remedy(function):
    assert refused(function, ensemble(0.1), ensemble(0.2), "fischer") == ("test", "fischer")


cells = st.sampled_from([0.0, 0.1, 0.2, 0.7, FELL])
campaigns = st.integers(1, 4).flatmap(
    lambda n: st.lists(st.lists(cells, min_size=n, max_size=n), min_size=2, max_size=9)
)


@given(campaigns)
def test_no_more_campaigns_are_rejected_than_stated_whatever_they_are(columns):
    """Each of all campaigns as the measured one: of M, at most k have a p-value of k/M or less."""
    peaks = np.array(columns).T
    found = []
    for i in range(len(columns)):
        pair = ensemble(*peaks[:, i]), ensemble(*np.delete(peaks, i, axis=1))
        found.append(validation.predictive_test(*pair, limit=0.5)[2:])
    for p_values in np.array(found).T:
        for k in range(1, len(columns) + 1):
            assert (p_values <= k / len(columns) + 1e-9).sum() <= k


@given(campaigns)
def test_distances_of_a_campaign_are_those_of_all_pairs(columns):
    peaks = np.array(columns).T
    counted = np.minimum(peaks, 0.5)
    pairs = np.abs(counted[:, :, None] - counted[:, None, :]).mean(axis=2)
    expected = pairs[:, 0].sum() / pairs.mean(axis=1).sum() if pairs.any() else 1.0
    below = (peaks[:, 1:] < peaks[:, :1]).sum(1) + 0.5 * (peaks[:, 1:] == peaks[:, :1]).sum(1)
    pair = ensemble(*peaks[:, 0]), ensemble(*peaks[:, 1:])
    found = validation.predictive_test(*pair, limit=0.5)
    assert found.distance == pytest.approx(expected, rel=1e-9)
    assert found.bias == pytest.approx(np.mean((below + 0.5) / len(columns)) - 0.5, abs=1e-12)


def test_simulations_of_other_tests_are_refused():
    with refuses("measured"):
        validation.predictive_test(ensemble(0.1, 0.2), ensemble([0.1], [0.2], [0.3]))


# --- means


def test_the_mean_of_a_campaign_of_normal_peaks_has_the_interval_of_student():
    rng = np.random.default_rng(1)
    records = rng.uniform(1.0, 2.0, 5)
    peaks = 0.1 * rng.standard_normal((5, 20001)) + records[:, None]
    measured, simulated = Ensemble(3.0 * peaks[:, 0]), Ensemble(peaks[:, 1:])
    found = validation.compare_means(measured, simulated, level=0.9)
    apart = 3.0 * peaks[:, 0] - peaks[:, 1:].mean(axis=1)
    reach = stats.t.ppf(0.95, 4) * apart.std(ddof=1) / np.sqrt(5)
    assert found.value == pytest.approx(apart.mean(), rel=1e-12)
    assert (found.lower, found.upper) == pytest.approx(
        (apart.mean() - reach, apart.mean() + reach), abs=0.05 * reach
    )


def test_overturned_motions_count_in_means_at_the_limit():
    simulated = Ensemble(np.random.default_rng(2).uniform(0.0, 0.4, (3, 40)))
    found = validation.compare_means(ensemble(0.1, 0.3, FELL), simulated, limit=0.35)
    expected = (0.1 + 0.3 + 0.35) / 3 - np.minimum(simulated.peaks, 0.35).mean()
    assert found.value == pytest.approx(expected, rel=1e-12)
    assert found.lower < found.value < found.upper


def test_an_interval_of_the_mean_has_the_doubt_about_a_parameter_of_all_tests():
    rng = np.random.default_rng(3)
    own, of_campaign = 0.01 * rng.standard_normal((30, 400)), rng.standard_normal(400)
    peaks = Ensemble(1.0 + own[:, 0]), Ensemble(1.0 + own + 0.1 * of_campaign)
    low, high = validation.compare_means(*peaks)[1:]
    alone = validation.compare_means(peaks[0], Ensemble(1.0 + own))
    assert high - low > 10 * (alone.upper - alone.lower)


def test_the_means_of_independent_normal_ensembles_are_those_of_welch():
    rng = np.random.default_rng(4)
    x, y = 10 + rng.standard_normal(6), 10 + rng.standard_normal(400)
    found = validation.compare_means(Ensemble(x), Ensemble(y))
    expected = stats.ttest_ind(x, y, equal_var=False).confidence_interval(0.95)
    reach = 0.5 * (expected.high - expected.low)
    assert found.value == pytest.approx(x.mean() - y.mean(), rel=1e-12)
    assert tuple(found[1:]) == pytest.approx(tuple(expected), abs=0.1 * reach)


def test_an_interval_of_too_few_campaigns_is_refused():
    simulated = Ensemble(np.random.default_rng(5).uniform(size=(3, 38)))
    assert refused(validation.compare_means, ensemble(0.1, 0.3, 0.2), simulated) == ("level", 0.95)


# --- scores


@pytest.mark.parametrize("z", [-1.5, 0.0, 0.4, 2.0])
def test_crps_of_a_normal_prediction_has_its_closed_form(z):
    """Gneiting and Raftery (2007), equation 21; m quantiles stand for the distribution."""
    mean, deviation, m = 5.0, 0.7, 4000
    quantiles = stats.norm.ppf((np.arange(m) + 0.5) / m, mean, deviation)
    found = validation.crps(ensemble(mean + z * deviation), ensemble(*quantiles))
    expected = deviation * (
        z * (2 * stats.norm.cdf(z) - 1) + 2 * stats.norm.pdf(z) - 1 / np.sqrt(np.pi)
    )
    assert found.tolist() == pytest.approx([expected], rel=1e-3)


peaks_or_fell = st.one_of(st.floats(0.0, 1.0), st.just(FELL))


@given(peaks_or_fell, st.lists(peaks_or_fell, min_size=1, max_size=6), st.floats(0.01, 1.5))
def test_crps_is_the_integral_up_to_the_limit(x, y, limit):
    """By the sum over the pieces on which both distributions are constant."""
    ends = np.unique([0.0, limit, *(v for v in (x, *y) if v < limit)])
    middle = 0.5 * (ends[1:] + ends[:-1])
    f = np.array([np.mean([v <= at for v in y]) for at in middle])
    expected = ((f - (x <= middle)) ** 2 * np.diff(ends)).sum()
    (found,) = validation.crps(ensemble(x), ensemble([y][0]), limit=limit)
    assert found == pytest.approx(expected, abs=1e-12)


@given(st.lists(st.floats(0.5, 9.0), min_size=1, max_size=5), st.lists(peaks_or_fell, min_size=2))
def test_beyond_the_limit_a_peak_counts_as_overturned(x, y):
    simulated = ensemble(*y)
    one = validation.crps(ensemble(*x), simulated, limit=0.5)
    other = validation.crps(ensemble(*[FELL] * len(x)), simulated, limit=0.5)
    np.testing.assert_array_equal(one, other)


def test_no_other_model_scores_better_than_the_true_one():
    rng = np.random.default_rng(5)
    limit = coverage.limit_of(0.3)
    logarithms = 0.4 * rng.standard_normal((2000, 1)) + 0.4 * rng.standard_normal((2000, 61))
    measured, right = (coverage.ensemble(x, 0.3) for x in (logarithms[:, 0], logarithms[:, 1:]))
    score = validation.crps(measured, right, limit=limit)
    fell = measured.overturned
    brier = validation.brier_score(fell, right.overturning_probability())
    for shift in (-0.35, 0.35):
        wrong = coverage.ensemble(logarithms[:, 1:] + shift, 0.3)
        worse = validation.crps(measured, wrong, limit=limit)
        assert stats.ttest_rel(worse, score, alternative="greater").pvalue < 1e-6
        worse = validation.brier_score(fell, wrong.overturning_probability())
        assert stats.ttest_rel(worse, brier, alternative="greater").pvalue < 1e-6


def test_brier_score_is_smallest_for_the_frequency():
    fell = np.arange(10) < 3
    scores = [validation.brier_score(fell, p).mean() for p in (0.2, 0.3, 0.4)]
    assert scores[1] == pytest.approx(0.21)
    assert scores[1] < min(scores[0], scores[2])
    assert refused(validation.brier_score, fell[:2], [0.1, 1.2]) == ("probability[1]", 1.2)


# --- reliability diagrams


@pytest.mark.parametrize("level", [0.5, 0.8, 0.9, 0.99])
def test_the_expected_range_is_that_of_all_outcomes(level):
    p = np.array([0.05, 0.2, 0.3, 0.35, 0.6, 0.9])
    density = np.zeros(len(p) + 1)
    for outcomes in product([0, 1], repeat=len(p)):
        density[sum(outcomes)] += np.prod(np.where(outcomes, p, 1 - p))
    found = validation.calibration_of(p > 0.5, p, bins=1, level=level)
    low, high = len(p) * found.expected_lower[0], len(p) * found.expected_upper[0]
    counts, tail = np.arange(len(p) + 1), (1 - level) / 2
    assert density[counts < low - 0.5].sum() <= tail < density[counts < low + 0.5].sum()
    assert density[counts > high + 0.5].sum() <= tail < density[counts > high - 0.5].sum()


def test_bins_count_each_test_once_and_have_the_exact_interval():
    p, fell = np.array([0.0, 0.1, 0.5, 0.5, 1.0]), np.array([False, True, True, False, True])
    found = validation.calibration_of(fell, p, bins=[0.0, 0.1, 0.5, 1.0])
    assert found.number.tolist() == [1, 1, 3]
    assert found.frequency.tolist() == pytest.approx([0.0, 1.0, 2 / 3])
    assert found.probability.tolist() == pytest.approx([0.0, 0.1, 2 / 3])
    exact = stats.binomtest(2, 3).proportion_ci(0.95)
    assert (found.lower[2], found.upper[2]) == pytest.approx((exact.low, exact.high))
    assert len(validation.calibration_of(fell, p, bins=10).number) == 4  # of ten, six are empty


def test_p_value_of_campaigns_is_the_rank_of_the_measured_one():
    """By hand: each of m + 1 campaigns against the mean of all others, in one bin."""
    rng = np.random.default_rng(4)
    every = rng.random((12, 61)) < rng.random((12, 1))
    found = validation.calibration_of(
        every[:, 0], every[:, 1:].mean(axis=1), 1, outcomes=every[:, 1:], level=0.9
    )
    excess = []
    for j in range(61):
        p = (np.delete(every, j, axis=1).sum(axis=1) + 0.5) / 61
        excess.append((every[:, j].sum() - p.sum()) ** 2 / (p * (1 - p)).sum())
    assert found.p_value == pytest.approx(np.mean(np.array(excess) >= excess[0] * (1 - 1e-9)))
    counts = np.sort(every[:, 1:].sum(axis=0))
    assert (found.expected_lower[0], found.expected_upper[0]) == (counts[2] / 12, counts[-3] / 12)
    assert repr(found).splitlines()[0].endswith("if the probabilities are right; by 60 campaigns")
    alone = validation.calibration_of(every[:, 0], np.full(12, 0.5))
    assert repr(alone).splitlines()[0].endswith("; assumes independent tests")


@pytest.mark.parametrize(
    ("outcomes", "said"),
    [
        (np.zeros((3, 60)), "outcomes"),
        (np.zeros((2, 38)), "outcomes"),
        (np.zeros((2, 60)), "probability[0]"),
        (np.full((2, 40), 0.5), "outcomes[0, 0]"),
    ],
)
def test_campaigns_of_other_tests_or_too_few_are_refused(outcomes, said):
    with refuses(said):
        validation.calibration_of([True, False], [0.5, 0.5], outcomes=outcomes)


def test_a_motion_that_overturned_where_it_never_does_is_impossible():
    found = validation.calibration_of([True, False], [0.0, 0.0])
    assert found.p_value == 1e-4
    assert "predicted 0.000, observed 0.500 of 2" in repr(found)


def test_probabilities_outside_the_bins_are_refused():
    with refuses("probability[1]", 0.7):
        validation.calibration_of([True, False], [0.2, 0.7], bins=[0.0, 0.5])
    with refuses("bins[0]", 0.0):
        validation.calibration_of([True, False], [0.2, 0.7], bins=[0.0, 0.0, 1.0])


def test_no_finite_number_of_motions_makes_a_probability_certain():
    made = ensemble([0.1, 0.2, 0.3], [0.1, FELL, FELL], [FELL, FELL, FELL])
    assert made.overturning_probability().tolist() == pytest.approx([0.125, 0.625, 0.875])


# --- numbers of tests


@pytest.mark.parametrize(("difference", "number"), [(0.2, 199), (0.5, 34), (0.8, 15)])
def test_numbers_for_a_mean_are_those_of_the_tables(difference, number):
    """Cohen (1988), Statistical power analysis; two-sided, 5 %, power 0.8, by G*Power."""
    assert validation.sample_size_for_mean(-difference, 1.0) == number
    assert validation.sample_size_for_mean(3 * difference, 3.0) == number


def test_few_tests_show_a_large_difference_as_often_as_simulated():
    n = validation.sample_size_for_mean(2.0, 1.0)
    rng = np.random.default_rng(6)
    seen = [
        (stats.ttest_1samp(2.0 + rng.standard_normal((k, 4000)), 0.0).pvalue <= 0.05).mean()
        for k in (n - 1, n)
    ]
    assert seen[0] < 0.78 < 0.82 < seen[1]


def test_a_structure_that_never_overturned_needs_many_tests():
    """With none of n, the upper bound of 95 % is 1 - 0.025**(1/n)."""
    assert validation.sample_size_for_proportion(0.0, 0.05) == 72
    assert 1 - 0.025 ** (1 / 72) <= 0.05 < 1 - 0.025 ** (1 / 71)


def test_a_number_for_a_proportion_is_the_least():
    n = validation.sample_size_for_proportion(0.5, 0.2)
    interval = [stats.binomtest(k, 2 * k).proportion_ci() for k in (n // 2, n // 2 - 1)]
    assert [one.high - one.low <= 0.2 for one in interval] == [True, False]


def test_a_number_for_a_distribution_grows_with_the_square():
    assert validation.sample_size_for_distribution(0.2) == 128
    assert validation.sample_size_for_distribution(0.1) == pytest.approx(4 * 128, abs=4)
    assert refused(validation.sample_size_for_distribution, 0.1, power=1.0) == ("power", 1.0)


def test_models_that_disagree_are_compared_by_the_binomial_distribution():
    """Of ten tests on which one alone is right, the first is so of eight."""
    right = np.array([True] * 8 + [False] * 2 + [True, False] * 5)
    other = np.array([False] * 8 + [True] * 2 + [True, False] * 5)
    found = validation.disagreement(right, other)
    assert found[:2] == (8, 2)
    assert found.p_value == pytest.approx(2 * sum(math.comb(10, k) for k in (8, 9, 10)) / 2**10)
    assert validation.disagreement(right, right) == (0, 0, 1.0)
    for less in (right[:1], right[0], np.tile(right, (2, 1))):  # which would be compared with each
        with pytest.raises(ValueError, match="one value of each model for a test"):
            validation.disagreement(right, less)


def test_a_paired_difference_of_groups_of_one_test_is_the_paired_t_test():
    rng = np.random.default_rng(3)
    one, two = rng.random((2, 30))
    found, interval = (
        validation.paired_difference(one, two, np.arange(30), level=0.9),
        stats.ttest_rel(one, two).confidence_interval(0.9),
    )
    np.testing.assert_allclose(found[1:], interval, rtol=1e-12)
    with pytest.raises(ValueError, match="groups"):
        validation.paired_difference(one, two, np.zeros(30))
    with pytest.raises(ValueError, match="groups"):
        validation.paired_difference(one, two, np.zeros(3))
    with pytest.raises(ValueError, match="right"):
        validation.disagreement(one, two)
