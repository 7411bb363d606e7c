"""python -m tests.oracle: every shipped structure by Python, the printer, numba and NumPy.

Motions of them, and of a dozen declared structures, check every index.
"""

import sys
import time

import rockeom as rk
from tests.oracle.ways import ROUNDING, by_numba, by_numpy, differences, printed, python
from tests.shipped import PINNED
from tests.soak import bounds
from tests.soak.cases import MODELS, draw


def main() -> int:
    bad = 0
    for i, model in enumerate(MODELS):
        structure = draw(i).structure
        module, started = structure.module, time.monotonic()
        plain, machine, jitted = python(module, "DOP853"), printed(module), by_numba(module)
        found = [f"Python: {d}" for d in differences(module, structure.vector, plain, machine, 50)]
        found += [f"numba: {d}" for d in differences(module, structure.vector, jitted, machine, 50)]
        if model in PINNED:
            arrays = by_numpy(module, rk.derive(model))
            unlike = differences(module, structure.vector, arrays, machine, 50, ulps=ROUNDING)
            found += [f"NumPy: {d}" for d in unlike]
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
