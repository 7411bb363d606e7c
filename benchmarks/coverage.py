"""Coverage of intervals, size and power of tests: `rockeom.analysis.validation` on known truth.

    python -m benchmarks.coverage                      # 4000 replicates of each, minutes
    python -m benchmarks.coverage --replicates 500 --only predictive

Peaks are lognormal with a dispersion of 0.6: half of the variance of their logarithms is that of
the records, the rest that of motions under one record. Those above a quantile overturn.
"""

import argparse
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy import stats

from rockeom.analysis import validation
from rockeom.analysis.validation import Ensemble

DISPERSION = 0.6
OF_RECORDS = OF_MOTIONS = DISPERSION / np.sqrt(2.0)
LEVEL = 0.95
REPLICATES = 4000

Replicate = Callable[[np.random.Generator], bool]


class Study(NamedTuple):
    """What is counted, how often it should be true, and one replicate of it.

    rule : "at least", "about" or "at most" the stated part of the replicates; "" for a power.
    cost : how many times fewer replicates are made of it.
    """

    name: str
    rule: str
    stated: float
    once: Replicate
    cost: int = 1


# --- ensembles of known truth


def limit_of(part: float) -> float:
    """The rotation above which this part of the motions overturns."""
    return float(np.exp(DISPERSION * stats.norm.isf(part))) if part else np.inf


def ensemble(logarithms: np.ndarray, part: float) -> Ensemble:
    peaks = np.exp(logarithms)
    return Ensemble(peaks, peaks > limit_of(part))


def independent(rng: np.random.Generator, n: int, part: float, shift: float = 0.0) -> Ensemble:
    """Motions of a record each."""
    return ensemble(shift + DISPERSION * rng.standard_normal(n), part)


def campaign(
    rng: np.random.Generator,
    n: int,
    m: int,
    part: float,
    *,
    shift: float = 0.0,
    spread: float = 1.0,
    shared: bool = False,
) -> tuple[Ensemble, Ensemble]:
    """(n,) measured motions and (n, m) simulated ones of the same records.

    shift, spread : by which logarithms of measured peaks are larger, and scatter more, than those
        simulated. shared : whether half of the variance of motions is that of a parameter which is
        the same in all tests of a campaign.
    """
    own = rng.standard_normal((n, m + 1))
    if shared:
        own = np.sqrt(0.5) * (own + rng.standard_normal(m + 1))
    scatter = OF_MOTIONS * own
    scatter[:, 0] = shift + spread * scatter[:, 0]
    logarithms = OF_RECORDS * rng.standard_normal((n, 1)) + scatter
    return ensemble(logarithms[:, 0], part), ensemble(logarithms[:, 1:], part)


# --- one replicate each


def band_holds(rng: np.random.Generator, n: int, part: float) -> bool:
    """Whether the band has the whole true distribution, on both sides of each of its steps."""
    made = independent(rng, n, part)
    peaks = np.sort(made.peaks[~made.overturned])
    last = min(limit_of(part), 1e3)
    x = np.concatenate([peaks, np.nextafter(peaks, 0.0), [last]])
    truth = stats.norm.cdf(np.log(x) / DISPERSION)
    lower, upper = made.band(x, LEVEL)
    return bool(((lower <= truth) & (truth <= upper)).all())


def mean_holds(rng: np.random.Generator, n: int, part: float, paired: bool) -> bool:
    """Whether the interval has the true distance of the means, which is zero."""
    if paired:
        measured, simulated = campaign(rng, n, 100, part)
    else:
        measured, simulated = independent(rng, n, part), independent(rng, 4 * n, part)
    limit = limit_of(part) if part else None
    found = validation.compare_means(measured, simulated, limit=limit, level=LEVEL)
    return found.lower <= 0.0 <= found.upper


def probability_holds(rng: np.random.Generator, n: int, what: str) -> bool:
    """Whether the bounds of all motions in one bin have the true mean, or the range the frequency.

    what : "interval" or "range", or "p_value" for a rejection at 5 %, by five bins.
    """
    p = rng.random(n)
    bins = 5 if what == "p_value" else 1
    found = validation.calibration_of(rng.random(n) < p, p, bins, seed=int(rng.integers(2**31)))
    if what == "p_value":
        return found.p_value <= 1.0 - LEVEL
    if what == "interval":
        return bool(found.lower[0] <= p.mean() <= found.upper[0])
    return bool(found.expected_lower[0] <= found.frequency[0] <= found.expected_upper[0])


def peaks_differ(
    rng: np.random.Generator, n: int, m: int, part: float, test: str, shift: float = 0.0
) -> bool:
    pair = independent(rng, n, part, shift), independent(rng, m, part)
    seed = int(rng.integers(2**31))
    return validation.compare_peaks(*pair, test, seed=seed).p_value <= 1.0 - LEVEL


def tables_differ(rng: np.random.Generator, n: int, m: int, part: float, test: str) -> bool:
    """The same by a table of scipy.stats, which is for peaks that all differ."""
    x, y = (np.minimum(independent(rng, k, part).peaks, limit_of(part)) for k in (n, m))
    with warnings.catch_warnings():  # of p-values beyond the table
        warnings.simplefilter("ignore")
        done = (
            stats.anderson_ksamp([x, y]) if test == "anderson_ksamp" else getattr(stats, test)(x, y)
        )
    return bool(done.pvalue <= 1.0 - LEVEL)


def outcomes_differ(rng: np.random.Generator, n: int, part: float, other: float, test: str) -> bool:
    pair = independent(rng, n, part), independent(rng, 2 * n, other)
    return validation.compare_outcomes(*pair, test).p_value <= 1.0 - LEVEL


def campaign_differs(rng: np.random.Generator, n: int, part: float, **how: float) -> bool:
    limit = limit_of(part) if part else None
    pair = campaign(rng, n, 199, part, **how)
    return validation.predictive_test(*pair, limit=limit).p_value <= 1.0 - LEVEL + 1e-12


def pooled_differs(rng: np.random.Generator, n: int, part: float, **how: float) -> bool:
    """The test of Cramer and von Mises of all motions together, with records that both share."""
    pair = campaign(rng, n, 9, part, **how)
    return validation.compare_peaks(*pair, seed=int(rng.integers(2**31))).p_value <= 1.0 - LEVEL


def mean_is_seen(rng: np.random.Generator, size: float, n: int) -> bool:
    """Whether n tests show a normal difference of a size."""
    found = stats.ttest_1samp(size + rng.standard_normal(n), 0.0).confidence_interval(LEVEL)
    return not found.low <= 0.0 <= found.high


def distribution_is_seen(rng: np.random.Generator, distance: float, power: float) -> bool:
    """Whether the band leaves out a model whose distribution is off by a distance."""
    n = validation.sample_size_for_distribution(distance, LEVEL, power)
    shift = 2.0 * DISPERSION * stats.norm.isf(0.5 - 0.5 * distance)  # the largest is the distance
    made = independent(rng, n, 0.0, shift)
    x = np.concatenate([made.peaks, np.nextafter(made.peaks, 0.0)])
    lower, upper = made.band(x, LEVEL)
    model = stats.norm.cdf(np.log(x) / DISPERSION)
    return bool(((model < lower) | (model > upper)).any())


def paired_holds(rng: np.random.Generator, n: int) -> bool:
    """Whether the interval of n records, of 1 to 24 tests each, has the true difference: none."""
    sizes = rng.integers(1, 25, n)
    groups, of_records = np.repeat(np.arange(n), sizes), rng.beta(4.0, 0.8, (2, n))
    of_records[1] = of_records.mean(axis=0)  # both models are wrong on the same records
    right = rng.random((2, len(groups))) < of_records[:, groups]
    found = validation.paired_difference(*right, groups)
    return found.lower <= 0.0 <= found.upper


# --- all of them


def studies() -> Iterator[Study]:
    for n in (10, 40, 226):
        for part in (0.0, 0.3):
            name = f"band of {n}, {part:.0%} overturned"
            yield Study(name, "at least", LEVEL, partial(band_holds, n=n, part=part))
    for n in (10, 40, 226):
        for part in (0.0, 0.3):
            for paired in (True, False):
                kind = f"{n} x 100" if paired else f"{n} and {4 * n}"
                name = f"distance of means, {kind}, {part:.0%} overturned"
                once = partial(mean_holds, n=n, part=part, paired=paired)
                yield Study(name, "about", LEVEL, once)
    for n in (10, 60):
        for what in ("interval", "range"):
            once = partial(probability_holds, n=n, what=what)
            yield Study(f"probability, {what} of {n}", "at least", LEVEL, once)
        once = partial(probability_holds, n=n, what="p_value")
        yield Study(f"calibration of {n}, size", "at most", 1.0 - LEVEL, once, 2)
    for n in (10, 20, 49):
        yield Study(f"paired difference, {n} records", "about", LEVEL, partial(paired_holds, n=n))
    yield from _tests()
    for power in (0.8, 0.95):
        n = validation.sample_size_for_mean(0.4, 1.0, LEVEL, power)
        once = partial(mean_is_seen, size=0.4, n=n)
        yield Study(f"sample size for a mean 0.4 off, power {power}", "about", power, once)
        for distance in (0.15, 0.3):
            once = partial(distribution_is_seen, distance=distance, power=power)
            name = f"sample size for a distribution {distance} off, power {power}"
            yield Study(name, "at least", power, once)


def _tests() -> Iterator[Study]:
    """Size, then power."""
    alpha = 1.0 - LEVEL
    for test in validation.comparison.PEAK_TESTS:
        for n, m, part in ((20, 60, 0.0), (20, 60, 0.3), (40, 160, 0.6)):
            once = partial(peaks_differ, n=n, m=m, part=part, test=test)
            yield Study(f"{test}, {n} and {m}, {part:.0%}, size", "at most", alpha, once, 4)
    for test in ("cramervonmises_2samp", "ks_2samp", "anderson_ksamp"):
        once = partial(tables_differ, n=20, m=200, part=0.3, test=test)
        yield Study(f"scipy.stats.{test}, 20 and 200, 30%, size", "", 0.0, once)
    for test in validation.comparison.OUTCOME_TESTS:
        once = partial(outcomes_differ, n=30, part=0.3, other=0.3, test=test)
        yield Study(f"{test}, 30 and 60, 30 %, size", "at most", alpha, once, 2)
    for n in (10, 60):
        for part in (0.0, 0.3, 0.6):
            for shared in (False, True):
                how = "parameter shared" if shared else "independent"
                once = partial(campaign_differs, n=n, part=part, shared=shared)
                yield Study(f"predictive, {n}, {part:.0%}, {how}, size", "at most", alpha, once)
    once = partial(pooled_differs, n=60, part=0.3)
    yield Study("cramer-von mises, same 60 records, 30%, size", "at most", alpha, once, 8)
    for test in validation.comparison.PEAK_TESTS:
        once = partial(peaks_differ, n=20, m=60, part=0.3, test=test, shift=0.4)
        yield Study(f"{test}, 20 and 60, 30%, peaks x 1.5, power", "", 0.0, once, 4)
    for test in validation.comparison.OUTCOME_TESTS:
        once = partial(outcomes_differ, n=30, part=0.3, other=0.6, test=test)
        yield Study(f"{test}, 30 and 60, 30 % and 60 %, power", "", 0.0, once, 2)
    for n in (20, 60, 226):
        for shift in (0.1, 0.2, 0.4):
            once = partial(campaign_differs, n=n, part=0.3, shift=shift)
            yield Study(f"predictive, {n}, 30%, peaks x {np.exp(shift):.2f}, power", "", 0.0, once)
    for spread in (0.5, 1.5):
        once = partial(campaign_differs, n=60, part=0.3, spread=spread)
        yield Study(f"predictive, 60, 30%, scatter x {spread}, power", "", 0.0, once)
    once = partial(pooled_differs, n=60, part=0.3, shift=0.2)
    yield Study("cramer-von mises, same 60 records, 30%, peaks x 1.22, power", "", 0.0, once, 8)


def hits(study: Study, replicates: int, seed: int) -> int:
    """How many of the replicates, each with a seed of its own, are true."""
    seeds = np.random.SeedSequence(seed).spawn(replicates)
    return sum(study.once(np.random.default_rng(one)) for one in seeds)


def keeps(study: Study, count: int, replicates: int, level: float = 0.999) -> bool:
    """Whether a count agrees with the rule, within the error of Monte Carlo."""
    slack = 1.0 - level
    low = stats.binom.cdf(count, replicates, study.stated) < slack
    high = stats.binom.sf(count - 1, replicates, study.stated) < slack
    return not (
        (study.rule in ("at least", "about") and low)
        or (study.rule in ("at most", "about") and high)
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--replicates", type=int, default=REPLICATES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="", help="studies whose names begin so")
    asked = parser.parse_args()
    for study in (one for one in studies() if one.name.startswith(asked.only)):
        replicates = max(1, asked.replicates // study.cost)
        count = hits(study, replicates, asked.seed)
        part = count / replicates
        error = 1.96 * np.sqrt(part * (1.0 - part) / replicates)
        rule = f"{study.rule} {study.stated:.2f}" if study.rule else ""
        fault = "" if not study.rule or keeps(study, count, replicates) else "  OUTSIDE"
        line = f"{study.name:64} {part:.4f} +- {error:.4f} of {replicates:5}  {rule}{fault}"
        print(line, flush=True)


if __name__ == "__main__":
    main()
