"""Time of the first response in a new process: import, and the first call of simulate."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

PROGRAM = """
import time
started = time.perf_counter()
import rockeom as rk
block = rk.RigidBlock(half_width=0.095, half_height=0.45)
run = rk.simulate(block, rk.GroundMotion.single_sine(amplitude=2.8, period=0.5, duration=6.0))
print(time.perf_counter() - started, time.process_time())
assert run.impacts
"""


Taken = tuple[float, float]
"""By the clock on the wall, and by the processor's, which counts from the start of Python [s]."""


def _new_process(folder: str) -> Taken:
    caches = {"ROCKEOM_CACHE_DIR": f"{folder}/rockeom"}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | caches,
        check=True,
        capture_output=True,
        text=True,
    )
    wall, processor = map(float, done.stdout.split())
    return wall, processor


def measure(repeats: int) -> tuple[Taken, Taken]:
    """(first call ever, fastest first call of later processes): the caches empty, and filled."""
    with tempfile.TemporaryDirectory() as folder:
        ever = _new_process(folder)
        return ever, min(_new_process(folder) for _ in range(repeats))
