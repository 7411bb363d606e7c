"""Coverage and size where motions depend on one another: fragility, bands, calibration.

    python -m benchmarks.dependence                      # 2000 replicates of each, an hour
    python -m benchmarks.dependence --replicates 200 --only fragility

Records scaled to several intensities: each of n recordings has two components, whose lognormal
capacities (median 1, dispersion 0.4) have a part of their variance in common. Campaigns: a part of
the variance of the logarithms of all peaks is that of a parameter which all tests of a campaign
share; 30 % overturn. Intervals are those of 95 %, tests those at 5 %. Of 2000 replicates the level
less two standard errors is 0.940, the size with two of them 0.060.

The guide to fragility has the table of curves. Of three recordings there is no curve in 18, 37 and
369 replicates with none, half or all of the variance shared. Counted as independent, 22 recordings
with half of it hold the median in 0.62. How often bands hold the whole distribution, and their mean
width at the middle with 20 % shared:

    tests x campaigns    20 x 2  20 x 5  60 x 5  20 x 20  60 x 20  60 x 100  60 x 1
     0 % shared           1.000   0.989   0.992    0.966    0.971     0.950   0.960
    20 %                  1.000   0.973   0.964    0.962    0.955     0.950   0.460
    50 %                  0.993   0.966   0.959    0.952    0.956     0.947   0.202
    width                  1.00    0.60    0.51     0.23     0.20      0.08    0.35

One campaign does not show what its tests share. The size of `calibration_of` with `outcomes=`, and
without, which assumes independent tests; frequencies lie in their expected ranges in 0.97 or more:

    tests x campaigns    60 x 300         60 x 39          10 x 99
     0 % shared           0.049 (0.050)    0.056 (0.066)    0.057 (0.056)
    20 %                  0.049 (0.324)    0.054 (0.345)    0.053 (0.089)
    50 %                  0.054 (0.530)    0.054 (0.550)    0.046 (0.138)
"""

import argparse
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
import xarray as xr
from scipy import stats

from benchmarks.coverage import DISPERSION, LEVEL, ensemble, limit_of
from rockeom.analysis import fragility_of
from rockeom.analysis.risk.fragility import Estimate
from rockeom.analysis.validation import Ensemble, calibration_of

REPLICATES = 2000
FELL = 0.3


class Told(NamedTuple):
    """Whether what was told is true, and how wide it is."""

    holds: bool
    width: float = np.nan


Replicate = Callable[[np.random.Generator], dict[str, Told]]
"""What one replicate tells, by name; nothing where there is no curve."""


class Study(NamedTuple):
    """What is counted, and one replicate of it."""

    name: str
    once: Replicate


# --- recordings at several intensities


def recordings(
    rng: np.random.Generator, n: int, shared: float, highest: float = 2.0, dispersion: float = 0.4
) -> xr.Dataset:
    """A sweep of the two components of n recordings at eight intensities.

    shared : part of the variance of the logarithm of capacities that both components have in
        common. highest : intensity, as a deviate of the true curve.
    """
    own = np.sqrt(1.0 - shared) * rng.standard_normal((n, 2))
    capacity = own + np.sqrt(shared) * rng.standard_normal((n, 1))
    deviates = np.linspace(-2.0, highest, 8)
    fell = capacity.reshape(-1, 1) <= deviates
    names = [f"S{i}-{azimuth}" for i in range(n) for azimuth in ("000", "090")]
    return xr.Dataset(
        {"outcome": (("motion", "pga"), np.where(fell, "overturned", "completed"))},
        coords={"motion": names, "pga": np.exp(dispersion * deviates)},
    )


def fragility(
    rng: np.random.Generator, n: int, shared: float, group: str | None, **others: float
) -> dict[str, Told]:
    dispersion = others.get("dispersion", 0.4)
    try:
        curve = fragility_of(recordings(rng, n, shared, **others), intensity="pga", group=group)
    except ValueError:
        return {}
    told = {
        f"PGA at {100 * part:.0f} %": _told(
            curve.quantile(part, LEVEL), np.exp(dispersion * stats.norm.ppf(part))
        )
        for part in (0.05, 0.5)
    }
    for part in (0.16, 0.84):
        at = np.exp(dispersion * stats.norm.ppf(part))
        lower, upper = curve.bounds(at, LEVEL)
        told[f"band at {100 * part:.0f} %"] = Told(bool(lower <= part <= upper), upper - lower)
    return told


def _told(estimate: Estimate, truth: float) -> Told:
    """Its width is the logarithm of the ratio of its ends."""
    lower, upper = max(estimate.lower, 1e-300), estimate.upper
    return Told(estimate.lower <= truth <= upper, float(np.log(upper / lower)))


# --- campaigns


def campaigns(rng: np.random.Generator, n: int, m: int, shared: float) -> np.ndarray:
    """(n, m) logarithms of peaks over their dispersion, of m campaigns of n tests."""
    own = np.sqrt(1.0 - shared) * rng.standard_normal((n, m))
    return own + np.sqrt(shared) * rng.standard_normal(m)


def band(rng: np.random.Generator, n: int, m: int, shared: float) -> dict[str, Told]:
    """Whether the band has the whole true distribution, on both sides of each of its steps."""
    made = ensemble(DISPERSION * campaigns(rng, n, m, shared), FELL)
    one = Ensemble(made.peaks[:, 0], made.overturned[:, 0]) if m == 1 else made
    peaks = np.sort(one.peaks[~one.overturned], axis=None)
    x = np.concatenate([peaks, np.nextafter(peaks, 0.0), [limit_of(FELL)]])
    truth = stats.norm.cdf(np.log(x) / DISPERSION)
    lower, upper = one.band(x, LEVEL)
    middle = np.argmin(np.abs(truth - 0.5))
    holds = bool(((lower <= truth) & (truth <= upper)).all())
    return {"band": Told(holds, upper[middle] - lower[middle])}


def calibration(rng: np.random.Generator, n: int, m: int, shared: float) -> dict[str, Told]:
    """Sizes with and without campaigns, and whether frequencies lie in the ranges."""
    limits = stats.norm.ppf(rng.uniform(0.02, 0.98, n))[:, None]
    fell = campaigns(rng, n, m + 1, shared) > limits
    measured, simulated = fell[:, 0], fell[:, 1:]
    probability = (simulated.sum(axis=1) + 0.5) / (m + 1.0)
    found = calibration_of(measured, probability, outcomes=simulated)
    alone = calibration_of(measured, probability, seed=int(rng.integers(2**31)))
    size = 1.0 - LEVEL + 1e-9
    told = {
        "size, outcomes": Told(found.p_value <= size),
        "size, independent": Told(alone.p_value <= size),
    }
    for i in range(len(found.number)):
        low, high = found.expected_lower[i], found.expected_upper[i]
        told[f"range of bin {i + 1}"] = Told(bool(low <= found.frequency[i] <= high), high - low)
    return told


# --- all of them


def studies() -> Iterator[Study]:
    for n in (3, 6, 12, 22, 44):
        for shared in (0.0, 0.5, 1.0):
            once = partial(fragility, n=n, shared=shared, group="recording")
            yield Study(f"fragility, {n} recordings, {shared:.0%} shared", once)
    for what, others in (
        ("up to the median", {"highest": 0.0}), ("up to 69 %", {"highest": 0.5}),
        ("dispersion 0.6", {"dispersion": 0.6}),
    ):  # fmt: skip
        once = partial(fragility, n=22, shared=0.5, group="recording", **others)
        yield Study(f"fragility, 22 recordings, 50% shared, {what}", once)
    once = partial(fragility, n=22, shared=0.5, group=None)
    yield Study("fragility, no group, 22 recordings, 50% shared", once)
    for n, m in ((60, 1), (20, 2), (20, 5), (60, 5), (20, 20), (60, 20), (60, 100), (60, 300)):
        for shared in (0.0, 0.2, 0.5):
            once = partial(band, n=n, m=m, shared=shared)
            yield Study(f"band, {n} tests x {m} campaigns, {shared:.0%} shared", once)
    for n, m in ((60, 300), (60, 39), (10, 99)):
        for shared in (0.0, 0.2, 0.5):
            once = partial(calibration, n=n, m=m, shared=shared)
            yield Study(f"calibration, {n} tests, {m} campaigns, {shared:.0%} shared", once)


class Count(NamedTuple):
    """How many of the replicates that tell something are true, and how wide it is on the mean.

    width : mean of those that are finite; infinite : number of the others.
    """

    true: int
    number: int
    width: float
    infinite: int


def counts(study: Study, replicates: int, seed: int = 0) -> tuple[dict[str, Count], int]:
    """By the name of what is told; and the number of replicates that tell nothing."""
    every: dict[str, list[Told]] = defaultdict(list)
    silent = 0
    for one in np.random.SeedSequence(seed).spawn(replicates):
        told = study.once(np.random.default_rng(one))
        silent += not told
        for name, value in told.items():
            every[name].append(value)
    found = {}
    for name, values in every.items():
        widths = np.array([one.width for one in values])
        finite = widths[np.isfinite(widths)]
        width = float(finite.mean()) if finite.size else np.nan
        lost = int(np.isinf(widths).sum())
        found[name] = Count(sum(one.holds for one in values), len(values), width, lost)
    return found, silent


def keeps(name: str, count: Count) -> bool:
    """Whether a level or a size is kept, less or plus two standard errors."""
    size = name.startswith("size")
    stated = 1.0 - LEVEL if size else LEVEL
    slack = 2.0 * np.sqrt(stated * (1.0 - stated) / count.number)
    part = count.true / count.number
    return bool(part <= stated + slack if size else part >= stated - slack)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--replicates", type=int, default=REPLICATES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="", help="studies whose names begin so")
    asked = parser.parse_args()
    for study in (one for one in studies() if one.name.startswith(asked.only)):
        found, silent = counts(study, asked.replicates, asked.seed)
        print(study.name + (f"; {silent} without intervals" if silent else ""))
        for name, one in found.items():
            part, fault = one.true / one.number, "" if keeps(name, one) else "  OUTSIDE"
            infinite = f" ({one.infinite} infinite)" if one.infinite else ""
            width = "" if np.isnan(one.width) else f", width {one.width:.3f}{infinite}"
            print(f"  {name:20} {part:.4f} of {one.number}{width}{fault}", flush=True)


if __name__ == "__main__":
    main()
