"""Coverage of the intervals of `rockeom.assess` on known truth, by number of recordings.

    python -m benchmarks.assessment                    # 2000 replicates of each, minutes
    python -m benchmarks.assessment --motions          # with motions in place of capacities

Recordings have two components, whose capacities are lognormal with a dispersion of 0.3 or 0.5 and
correlated by 0, 0.5 or 1; they are scaled to four or eight intensities. Of 2000 replicates each the
least coverage at 95 %, its mean over all of these, the part of the replicates in which it is
printed, and the mean width, of a PGA that of its logarithm. The level less two standard errors is
0.940:

    recordings             2       3       6       8      12      30
    fraction, least    0.980   0.980   0.975   0.973   0.956   0.959
              mean     0.995   0.994   0.993   0.993   0.986   0.986
              width     0.90    0.82    0.68    0.61    0.54    0.40
    PGA at 50 %, least                 0.996   0.976   0.957   0.946
              mean                     1.000   0.994   0.983   0.975
              printed               0.21 to 1  0.74-1  0.96-1       1
              width                     1.41    0.94    0.63    0.32
    PGA at 5 %, least                          0.994   0.977   0.954
              mean                             0.999   0.994   0.980
              printed                          0.18-1  0.71-1       1
              width                             1.57    1.12    0.57
    band, least                        0.994   0.976   0.958   0.943
              mean                     0.998   0.993   0.984   0.974
              width                     0.62    0.49    0.37    0.22
    gain, least        1.000   1.000   0.999   0.994   0.982   0.966
              mean     1.000   1.000   1.000   0.999   0.993   0.977
              width     2.00    1.02    0.31    0.22    0.15    0.07
    no curve in                     up to 0.14    0.06    0.01       0

With motions of a statue under 1000 recordings, of which a fifth fall at an intensity and stand at a
higher one, with components that are independent or alike, the least coverages are 0.955 (fraction),
0.980 (PGA at 50 %), 0.994 (PGA at 5 %), 0.971 (band) and 0.950 (gain). The dispersion is not
printed: its interval would hold in 0.92 of the replicates where the motions of a recording are
independent.
"""

import argparse
from collections import defaultdict
from collections.abc import Callable, Iterator
from itertools import product
from typing import NamedTuple

import numpy as np
from scipy.special import ndtr, ndtri

import rockeom as rk
from rockeom.analysis.risk.fragility import (
    Estimate,
    fit_fragility,
    proportion_interval_by_group,
)
from rockeom.assessment.remedies import paired_gain
from rockeom.assessment.trials import OF_CURVE, Trials, pga_of
from rockeom.motion import JenningsEnvelope
from rockeom.motion.units import STANDARD_GRAVITY

LEVEL = 0.95
REPLICATES = 2000
COMPONENTS = 2
RECORDINGS = 2, 3, 6, 8, 12, 30
CORRELATIONS = 0.0, 0.5, 1.0
DISPERSIONS = 0.3, 0.5
INTENSITIES = (0.6, 0.9, 1.2, 1.6), (0.5, 0.6, 0.8, 1.0, 1.2, 1.6, 2.0, 2.4)
"""PGA over the median capacity: four, as one may choose, and the eight of `assess`."""
SHIFT, SCATTER = 0.15, 0.1
"""Of the logarithms of capacities by a measure that helps."""


class Setting(NamedTuple):
    """n recordings of two components whose logarithms of capacity have a dispersion and are
    correlated, scaled to intensities (m,)."""

    n: int
    correlation: float
    dispersion: float
    intensities: tuple[float, ...]


class Truth(NamedTuple):
    """Intensities (m,) over the true median, the dispersion, fractions (m,), gain of a measure."""

    intensities: np.ndarray
    dispersion: float
    fractions: np.ndarray
    gain: float


Outcomes = Callable[[np.random.Generator], tuple[np.ndarray, np.ndarray]]
"""Draws which of n recordings of two components fall at each intensity, (n, 2, m) without a measure
and with one."""


def by_capacity(setting: Setting) -> tuple[Outcomes, Truth]:
    """Motions that fall from the intensity on that is their capacity, the median of which is 1."""
    n, correlation, dispersion, intensities = setting
    x = np.log(intensities)

    def normal(rng: np.random.Generator) -> np.ndarray:
        shared, own = rng.standard_normal((n, 1)), rng.standard_normal((n, COMPONENTS))
        return np.sqrt(correlation) * shared + np.sqrt(1.0 - correlation) * own

    def outcomes(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        before = dispersion * normal(rng)
        after = before + SHIFT + SCATTER * normal(rng)
        return before[..., None] <= x, after[..., None] <= x

    fractions = ndtr(x / dispersion)
    changed = ndtr((x - SHIFT) / np.hypot(dispersion, SCATTER))
    gain = float((fractions - changed).mean())
    return outcomes, Truth(np.array(intensities), dispersion, fractions, gain)


def by_motions(number: int) -> Iterator[tuple[str, Outcomes, Truth]]:
    """Recordings out of many that were simulated, whose frequencies are the truth.

    number : of the recordings in all. Their components are independent motions, then the same one.
    """
    intensities = np.array([0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4])
    envelope = JenningsEnvelope(rise=2.0, until=10.0, decay=0.5)
    records = [
        rk.GroundMotion.kanai_tajimi(0.02, duration=20.0, seed=seed, envelope=envelope)
        for seed in range(COMPONENTS * number)
    ]

    def fallen(width: float) -> np.ndarray:
        block = rk.RigidBlock.from_dimensions(width=width, height=1.8, centroid_height=0.8)
        sweep = rk.simulate_many(
            lambda motion, pga: rk.Case(block, motion.scaled_to(pga=pga), duration=30.0),
            over={"motion": records, "pga": STANDARD_GRAVITY * intensities},
            sweep_options=rk.SweepOptions(progress=False),
        )
        fell = sweep["outcome"].values == "overturned"
        return fell.reshape(number, COMPONENTS, len(intensities))

    both = fallen(0.6), fallen(0.65)
    for name, places in (("independent", [0, 1]), ("alike", [0, 0])):
        before, after = (fell[:, places] for fell in both)
        curve = fit_fragility(np.broadcast_to(intensities, before.shape), before)
        gain = float(before.mean() - after.mean())
        truth = Truth(intensities / curve.median, curve.dispersion, before.mean(axis=(0, 1)), gain)
        for n in RECORDINGS:

            def outcomes(
                rng: np.random.Generator,
                n: int = n,
                before: np.ndarray = before,
                after: np.ndarray = after,
            ) -> tuple[np.ndarray, np.ndarray]:
                rows = rng.integers(0, number, n)
                return before[rows], after[rows]

            yield f"{n} of {number}, components {name}", outcomes, truth


def printed(
    fell: np.ndarray, changed: np.ndarray, truth: Truth
) -> Iterator[tuple[str, float, Estimate]]:
    """What `assess` prints of the outcomes (n, 2, m): its name, the truth, and the interval.

    The width of an interval of an intensity is that of its logarithm.
    """
    n, components, m = fell.shape
    intensities = truth.intensities
    recordings = np.repeat(np.arange(n), components)
    rows, other = (one.reshape(-1, m) for one in (fell, changed))
    for i in range(m):
        yield (
            "fraction", truth.fractions[i],
            Estimate(0.0, *proportion_interval_by_group(rows[:, i], recordings, LEVEL)),
        )  # fmt: skip
    trials = (Trials(one, np.ones_like(one), (), None, "", {}, {}, {}) for one in (rows, other))
    gain = paired_gain(*trials, recordings, LEVEL)
    if gain is not None:
        yield "gain", truth.gain, gain
    if n < OF_CURVE:
        return
    try:
        curve = fit_fragility(
            np.broadcast_to(intensities, rows.shape), rows, group=recordings[:, None]
        )
    except ValueError:
        yield "no curve", 0.0, Estimate(0.0, 0.0, 0.0)
        return
    right = ndtr(np.log(intensities) / truth.dispersion).tolist()
    for one, low, high in zip(right, *curve.bounds(intensities, LEVEL), strict=True):
        yield "band", one, Estimate(0.0, low, high)
    for probability in (0.05, 0.5):
        estimate = pga_of(curve, probability, LEVEL)
        if estimate is not None:
            name = f"PGA at {100 * probability:g} %"
            logarithm = truth.dispersion * float(ndtri(probability))
            yield name, logarithm, Estimate(*map(float, np.log(estimate)))


class Count(NamedTuple):
    """How many intervals there were, which part of them held, and their mean width."""

    number: int
    held: float
    width: float


def study(outcomes: Outcomes, truth: Truth, replicates: int, seed: int = 0) -> dict[str, Count]:
    """The counts of each quantity; of those at several intensities the one that held least."""
    held: defaultdict[tuple[str, float], list[bool]] = defaultdict(list)
    widths: defaultdict[str, list[float]] = defaultdict(list)
    for child in np.random.SeedSequence(seed).spawn(replicates):
        fell, changed = outcomes(np.random.default_rng(child))
        for name, right, (_, low, high) in printed(fell, changed, truth):
            held[name, right].append(low <= right <= high)
            widths[name].append(high - low)
    counts: dict[str, Count] = {}
    for (name, _), one in held.items():
        count = Count(len(one), float(np.mean(one)), float(np.mean(widths[name])))
        counts[name] = min(count, counts.get(name, count), key=lambda other: other.held)
    return counts


def by_capacities() -> Iterator[tuple[str, Outcomes, Truth]]:
    for n, correlation, dispersion, intensities in product(
        RECORDINGS, CORRELATIONS, DISPERSIONS, INTENSITIES
    ):
        name = f"{n}, correlation {correlation:g}, {dispersion:g}, {len(intensities)} intensities"
        yield name, *by_capacity(Setting(n, correlation, dispersion, intensities))


def report(name: str, counts: dict[str, Count], replicates: int) -> None:
    """A line for each quantity; "BELOW" where it held less often than it says."""
    for what, (number, held, width) in counts.items():
        slack = 2.0 * np.sqrt(LEVEL * (1.0 - LEVEL) / number)
        fault = "  BELOW" if held < LEVEL - slack else ""
        part = number / replicates
        if what == "no curve":
            print(f"{name:44} {what:12} in {part:.3f}", flush=True)
        else:
            print(f"{name:44} {what:12} {held:.3f} of {part:.2f}  {width:.2f}{fault}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--replicates", type=int, default=REPLICATES)
    parser.add_argument("--motions", action="store_true")
    asked = parser.parse_args()
    for name, outcomes, truth in by_motions(1000) if asked.motions else by_capacities():
        report(name, study(outcomes, truth, asked.replicates), asked.replicates)


if __name__ == "__main__":
    main()
