"""Coverage of intervals of shares over azimuths, and of their difference from the plane.

    python -m benchmarks.azimuths          # 1000 replicates of each of 60 settings, minutes

Recordings shake a body at four azimuths. Its capacities there, and that of its planar block, are
normal with correlations of 0 to 1 within a recording; at two azimuths it falls sooner and later
than at the others, or at all alike; it falls with a probability of 0.02 to 0.5. The truth is the
mean over azimuths. Least and mean coverage at 95 %, and mean width, over all settings:

    recordings                   3       6      12      30
    sum of parts      least    0.986   0.975   0.970   0.958
                      mean     0.999   0.998   0.997   0.996
                      width     0.81    0.63    0.45    0.28
    effective number  least    0.997   0.967   0.952   0.923
                      mean     1.000   0.994   0.984   0.970
                      width     0.93    0.56    0.33    0.19
    space less plane  least    1.000   0.999   0.985   0.965
                      mean     1.000   1.000   0.998   0.987
                      width     2.00    1.48    0.69    0.32

"sum of parts" is what `assess` prints of the share: Clopper and Pearson's of the sum of the parts
of azimuths at which each recording overturns the body. "effective number" is Clopper and Pearson's
of an effective number of motions by the variance between recordings, with Student's factor (Korn
and Graubard 1998, Survey Methodology 24, 193-201): shorter, and too short. "space less plane" is
the difference that `assess` prints, recording by recording, at one intensity.
"""

import argparse
from collections import defaultdict
from itertools import product
from typing import NamedTuple

import numpy as np
from scipy.special import ndtr, ndtri, stdtrit

from rockeom.analysis.risk.fragility import proportion_interval
from rockeom.assessment.remedies import paired_gain
from rockeom.assessment.trials import Trials, by_parts

LEVEL, TURNS, REPLICATES = 0.95, 4, 1000
RECORDINGS = 3, 6, 12, 30
CORRELATIONS = 0.0, 0.3, 0.6, 0.9, 1.0
PROBABILITIES = 0.02, 0.05, 0.1, 0.2, 0.35, 0.5
SHIFTS = 0.0, 1.0
PLANAR_SHIFT = 0.3
"""The planar block falls sooner by this part of the standard deviation."""


class Setting(NamedTuple):
    """n recordings, the correlation within one, the probability in the middle, and the shift of
    capacities at the first and the last azimuth."""

    n: int
    correlation: float
    probability: float
    shift: float


def drawn(setting: Setting, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Falls in space (n, TURNS) and in the plane (n,)."""
    n, rho, probability, _ = setting
    shared, own = rng.standard_normal((n, 1)), rng.standard_normal((n, TURNS + 1))
    capacity = np.sqrt(rho) * shared + np.sqrt(1.0 - rho) * own
    fell = capacity < ndtri(probability) + _shifts(setting)
    return fell[:, :-1], fell[:, -1]


def _shifts(setting: Setting) -> np.ndarray:
    return np.array([-setting.shift, *[0.0] * (TURNS - 2), setting.shift, PLANAR_SHIFT])


def truth(setting: Setting) -> tuple[float, float]:
    """Probability over all azimuths, and that in the plane."""
    each = ndtr(ndtri(setting.probability) + _shifts(setting))
    return float(each[:-1].mean()), float(each[-1])


def effective(fell: np.ndarray) -> tuple[float, float]:
    """Clopper and Pearson's of an effective number of motions; of parts that all agree, of n."""
    parts, n = fell.mean(axis=1), len(fell)
    mean, variance = parts.mean(), parts.var(ddof=1) / n
    number = min(mean * (1.0 - mean) / variance, fell.size) if variance else n
    number *= (stdtrit(fell.size - 1, 0.5 + 0.5 * LEVEL) / stdtrit(n - 1, 0.5 + 0.5 * LEVEL)) ** 2
    low, high = proportion_interval(mean * number, number, LEVEL)
    return float(low), float(high)


def intervals(fell: np.ndarray, planar: np.ndarray) -> dict[str, tuple[float, float]]:
    """Intervals of falls in space (n, TURNS) and in the plane (n,), by their names."""
    recording = np.repeat(np.arange(len(fell)), TURNS)
    both = (
        Trials(one.reshape(-1, 1), np.ones((fell.size, 1), bool), (), None, "", {}, {}, {})
        for one in (fell, np.repeat(planar, TURNS))
    )
    gain = paired_gain(*both, recording, LEVEL)
    assert gain is not None
    return {
        "sum of parts": by_parts(fell.ravel(), recording, LEVEL),
        "effective number": effective(fell),
        "space less plane": (gain.lower, gain.upper),
    }


def coverage(setting: Setting, replicates: int, seed: int = 0) -> dict[str, tuple[float, float]]:
    """Part of the replicates in which each interval holds the truth, and its mean width."""
    rng = np.random.default_rng(seed)
    share, planar = truth(setting)
    right = {"space less plane": share - planar}
    held: defaultdict[str, list[tuple[bool, float]]] = defaultdict(list)
    for _ in range(replicates):
        for name, (low, high) in intervals(*drawn(setting, rng)).items():
            held[name].append((low <= right.get(name, share) <= high, high - low))
    return {name: tuple(np.mean(rows, axis=0).tolist()) for name, rows in held.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--replicates", type=int, default=REPLICATES)
    replicates = parser.parse_args().replicates
    for n in RECORDINGS:
        settings = product([n], CORRELATIONS, PROBABILITIES, SHIFTS)
        found = [coverage(Setting(*setting), replicates) for setting in settings]
        for name in found[0]:
            held, width = np.array([one[name] for one in found]).T
            print(f"{n:4} {name:18} {held.min():.3f}  {held.mean():.3f}  {width.mean():.2f}")


if __name__ == "__main__":
    main()
