"""A map of 400 x 400 sines that push a block, and its boundaries to 1e-6, on all cores.

python -m benchmarks.overturning
"""

import time
from collections.abc import Callable

import numpy as np

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
GRID = {"frequency": np.linspace(0.5, 8.0, 400), "amplitude": np.linspace(0.5, 8.0, 400)}


def timed(work: Callable[[], object]) -> float:
    """Seconds on the clock."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def main() -> None:
    pulse = dynamics.dimensionless_pulses(BLOCK)
    few = {name: values[::80] for name, values in GRID.items()}
    rk.simulate_many(pulse, few)  # what is compiled is not counted
    sweep = rk.simulate_many(pulse, GRID)
    found = analysis.overturning_boundaries(pulse, sweep)
    a_map = timed(lambda: rk.simulate_many(pulse, GRID))
    boundaries = timed(lambda: analysis.overturning_boundaries(pulse, sweep))
    print(f"map of {sweep.outcome.size:,} pulses: {a_map:.2f} s")
    print(f"{found.sizes['boundary']:,} points of boundaries, to 1e-6: {boundaries:.2f} s")


if __name__ == "__main__":
    main()
