"""Simulation-based calibration of posteriors: 200 tests with known parameters, by kind of test.

    python -m benchmarks.calibration free      # out/calibration_free.json and .png, about 8 min
    python -m benchmarks.calibration shaken --number 200

Parameters are drawn from their priors, a test is simulated with them, and its posterior is sampled
(Talts et al. 2018, arXiv:1804.06788). If the posterior is right, the rank of the true parameter
among the draws is uniform, and intervals of 90 % hold it in 90 % of the tests. An error of the
likelihood, of its gradient or of the sampler moves the ranks. Nothing of a test is known to the
search for its mode but the readings.
"""

import argparse
import json
import math
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from scipy import stats

import rockeom as rk
from rockeom.analysis.identification import Observed, posterior

NUMBER = 200
DRAWS, WARM_UP, THIN = 198, 60, 2
"""Of one chain; every second draw is nearly independent, and 99 of them give a hundred ranks."""
BINS = 20
CONFIDENCE = 0.9
HOLD = (171, 189)
"""Intervals of 90 % that hold the truth, of 200: fewer or more come in less than one of thirty."""
LEVEL = 0.01

HEIGHT, NOMINAL, MASS = 0.45, 0.1, 300.0
INERTIA = MASS / 3 * (HEIGHT**2 + NOMINAL**2)
KNOWN = 1e-3
"""Noise of readings, where it is no parameter [rad]."""
FALLEN = 0.6
"""A rotation from which no block of these returns [rad]."""


def block(half_width: Any) -> rk.RigidBlock:
    """A block whose feet stand within its nominal base."""
    return rk.RigidBlock(half_width=half_width, half_height=HEIGHT, mass=MASS, inertia=INERTIA)


def free(left: Any, right: Any, half_width: Any, theta: Any) -> rk.Case:
    law = rk.EnergyRatio(left=left, right=right)
    return rk.Case(block(half_width), rk.GroundMotion.none(2.5), law, {"theta": theta})


def shaken(left: Any, right: Any, half_width: Any) -> rk.Case:
    """By a pulse that overturns one block of ten."""
    pulse = rk.GroundMotion.single_sine(3.0, 0.38, duration=3.0)
    return rk.Case(block(half_width), pulse, rk.EnergyRatio(left=left, right=right))


def short(r: Any, half_width: Any) -> rk.Case:
    still = rk.GroundMotion.none(1.0)
    return rk.Case(block(half_width), still, rk.EnergyRatio(r), {"theta": 0.05})


class Design(NamedTuple):
    """A kind of test: its case, the instants of its readings [s], and the priors."""

    case: Callable[..., rk.Case]
    instants: np.ndarray
    priors: Mapping[str, Any]

    def test(self, seed: int) -> tuple[dict[str, float], Observed, bool]:
        """The truth, what was measured, and whether it overturned; of that seed."""
        rng = np.random.default_rng([2018, seed])  # another stream than the sampler's
        truth = {name: float(of.rvs(random_state=rng)) for name, of in self.priors.items()}
        run = rk.simulate(**vars(self.case(**{n: x for n, x in truth.items() if n != "noise"})))
        theta = run.at(np.minimum(self.instants, run.t[-1]))["theta"]
        noise = truth.get("noise", KNOWN)
        read = theta + noise * rng.standard_normal(len(theta))
        fallen = np.flatnonzero(np.abs(read) >= FALLEN)
        if len(fallen):  # the sensor says no more than that
            read[fallen[0] :] = math.copysign(math.inf, read[fallen[0]])
        observed = Observed.history(
            self.case, self.instants, read, limit=FALLEN,
            noise="noise" if "noise" in truth else KNOWN,
        )  # fmt: skip
        return truth, observed, bool(len(fallen))


RATIO, NARROWER, NOISE = (
    stats.uniform(0.7, 0.25), stats.uniform(0.07, 0.03), stats.lognorm(0.5, scale=1e-3),
)  # fmt: skip
BY_FOOT = {"left": RATIO, "right": RATIO, "half_width": NARROWER}
DESIGNS = {
    "free": Design(
        free, np.arange(0.01, 2.5, 0.02),
        {**BY_FOOT, "theta": stats.norm(0.05, 0.003), "noise": NOISE},
    ),
    "shaken": Design(shaken, np.arange(0.02, 3.0, 0.02), {**BY_FOOT, "noise": NOISE}),
    "short": Design(short, np.arange(0.01, 1.0, 0.02), {"r": RATIO, "half_width": NARROWER}),
}  # fmt: skip


class Replicate(NamedTuple):
    """A test and its posterior: of each parameter the rank of the truth, and whether intervals of
    90 % by draws and by Laplace's approximation hold it; the cost; what the motions did."""

    rank: dict[str, int]
    held: dict[str, bool]
    held_by_laplace: dict[str, bool]
    gradients: int
    simulations: int
    seconds: float
    diverging: int
    overturned: bool
    undetermined: bool
    outcomes: dict[str, int]


def replicate(
    design: Design, seed: int, draws: int = DRAWS, warm_up: int = WARM_UP, thin: int = THIN
) -> Replicate:
    started = time.process_time()
    truth, observed, overturned = design.test(seed)
    found = posterior(observed, design.priors, seed=seed)
    drawn = found.sample(draws, chains=1, warm_up=warm_up, seed=seed)

    def holds(of: Any, name: str) -> bool:
        low, high = of.interval(name, CONFIDENCE)
        return bool(low <= truth[name] <= high)

    counts = found.counts
    return Replicate(
        {n: int((x[0, thin - 1 :: thin] < truth[n]).sum()) for n, x in drawn.values.items()},
        {name: holds(drawn, name) for name in truth},
        {name: holds(found.laplace, name) for name in truth},
        counts.pop("gradients"), counts.pop("simulations"), time.process_time() - started,
        drawn.diverging, overturned, bool(found.undetermined), counts,
    )  # fmt: skip


class Verdict(NamedTuple):
    """Of a parameter: intervals that hold the truth, by draws and by Laplace; the test of ranks."""

    held: int
    held_by_laplace: int
    chi_square: float
    p_value: float

    @property
    def right(self) -> bool:
        return HOLD[0] <= self.held <= HOLD[1] and self.p_value > LEVEL


def histogram(found: Sequence[Replicate], name: str, ranks: int, bins: int) -> np.ndarray:
    edges = np.linspace(0, ranks, bins + 1)
    return np.histogram([one.rank[name] for one in found], edges - 0.5)[0]


def verdicts(found: Sequence[Replicate], ranks: int, bins: int = BINS) -> dict[str, Verdict]:
    """By parameter; ranks : how many are possible."""
    told = {}
    for name in found[0].rank:
        test = stats.chisquare(histogram(found, name, ranks, bins))
        held = sum(one.held[name] for one in found)
        by_laplace = sum(one.held_by_laplace[name] for one in found)
        told[name] = Verdict(held, by_laplace, float(test.statistic), float(test.pvalue))
    return told


def drawn_ranks(found: Sequence[Replicate], ranks: int) -> plt.Figure:
    """Histograms of the ranks, with the band in which 99 % of the counts of a uniform one lie."""
    names = list(found[0].rank)
    figure, axes = plt.subplots(
        1, len(names), figsize=(2.2 * len(names), 2.4), sharey=True, layout="constrained"
    )
    band = stats.binom.interval(0.99, len(found), 1 / BINS)
    for ax, name in zip(axes, names, strict=True):
        ax.axhspan(*band, color="0.88")
        ax.axhline(len(found) / BINS, color="0.6", lw=0.8)
        counts = histogram(found, name, ranks, BINS)
        ax.bar((np.arange(BINS) + 0.5) * ranks / BINS, counts, 0.9 * ranks / BINS)
        ax.set(title=name, xlabel="rank of the truth")
    axes[0].set_ylabel(f"tests, of {len(found)}")
    return figure


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("design", choices=DESIGNS)
    parser.add_argument("--number", type=int, default=NUMBER, help="tests")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of what is written")
    given = parser.parse_args()
    found = []
    with ProcessPoolExecutor(given.jobs) as pool:
        for one in pool.map(partial(replicate, DESIGNS[given.design]), range(given.number)):
            found.append(one)
            if len(found) % 10 == 0:
                print(f"{len(found)} of {given.number}", flush=True)
    ranks = DRAWS // THIN + 1
    told = verdicts(found, ranks)
    cost = {
        "gradients of a posterior": float(np.mean([one.gradients for one in found])),
        "simulations of a posterior": float(np.mean([one.simulations for one in found])),
        "seconds of a posterior": float(np.mean([one.seconds for one in found])),
        "tests that overturned": sum(one.overturned for one in found),
        "tests that leave a parameter to its prior": sum(one.undetermined for one in found),
        "diverging trajectories": sum(one.diverging for one in found),
    }
    outcomes = sum((Counter(one.outcomes) for one in found), Counter[str]())
    for name, verdict in told.items():
        print(
            f"{name:12s} {verdict.held} of {given.number} held ({verdict.held_by_laplace} by "
            f"Laplace), chi square {verdict.chi_square:.1f}, p = {verdict.p_value:.3f}"
            f"{'' if verdict.right else '  <- outside'}"
        )
    for what, value in {**cost, **outcomes}.items():
        print(f"{what}: {value:.5g}")
    given.out.mkdir(parents=True, exist_ok=True)
    path = given.out / f"calibration_{given.design}"
    content = {
        "tests": given.number, "cost": cost, "outcomes": outcomes,
        "parameters": {name: verdict._asdict() for name, verdict in told.items()},
        "ranks": {name: [one.rank[name] for one in found] for name in told},
    }  # fmt: skip
    path.with_suffix(".json").write_text(json.dumps(content, indent=1), encoding="utf-8")
    drawn_ranks(found, ranks).savefig(path.with_suffix(".png"), dpi=150)
    return 0 if all(verdict.right for verdict in told.values()) else 1


if __name__ == "__main__":
    raise SystemExit(main())
