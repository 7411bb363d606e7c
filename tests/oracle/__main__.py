"""python -m tests.oracle: every shipped structure by Python, the printer, numba and NumPy.

Motions of them, and of a dozen declared structures, check every index.
"""

import sys
import time

import rockeom as rk
from tests.oracle.ways import ROUNDING, by_numba, by_numpy, differences, printed, python
from tests.shipped import PINNED, plain
from tests.soak import bounds
from tests.soak.cases import MODELS, draw


def main() -> int:
    bad = 0
    drawn = {model: draw(i).structure for i, model in enumerate(MODELS)}
    newer = {name: rk.structure(name, **plain(name)) for name in PINNED if name not in drawn}
    for model, structure in (drawn | newer).items():
        module, started = structure.module, time.monotonic()
        interpreted, machine, jitted = python(module, "DOP853"), printed(module), by_numba(module)
        arrays = by_numpy(module, rk.derive(model))
        found = []
        for way, other, ulps in [
            ("Python", interpreted, 0.0),
            ("numba", jitted, 0.0),
            ("NumPy", arrays, ROUNDING),
        ]:
            unlike = differences(module, structure.vector, other, machine, 50, ulps)
            found += [f"{way}: {difference}" for difference in unlike]
        bad += len(found)
        took = time.monotonic() - started
        print(f"{model}: {len(found)} differences, {took:.0f} s", *found[:10], sep="\n    ")
        sys.stdout.flush()
    with bounds.checked():
        for name in (*MODELS, *bounds.STRUCTURES):
            found = bounds.searched([name], range(3))
            bad += len(found)
            print(f"{name}: {len(found)} indices out of bounds", *found, sep="\n    ", flush=True)
    return min(bad, 1)


if __name__ == "__main__":
    sys.exit(main())
