"""A sweep on the workers of a dask cluster, one of which is killed."""

import os
import signal
import sys
import time
from contextlib import suppress

import numpy as np
import pytest

import rockeom as rk
from tests.sweeping import simulate_many

pytest.importorskip("zarr")
distributed = pytest.importorskip("distributed")

OVER = {"frequency": np.linspace(0.5, 4.0, 20), "amplitude": np.linspace(1.0, 8.0, 50)}


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_worker_of_a_cluster_is_killed_midway(tmp_path):
    """What it had is given to others; the dataset is that of threads, to the last bit."""
    block, here = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25), os.getpid()
    store, fatal = tmp_path / "map.zarr", tmp_path / "fatal"

    def pulse(frequency, amplitude):
        """The first worker that comes here dies, once ten chunks are there; others wait for it."""
        while frequency > 2.0 and os.getpid() != here and fatal.exists():
            if len([*(store / "outcome" / "c").glob("[0-9]*")]) >= 10:
                with suppress(FileNotFoundError):
                    fatal.unlink()
                    os.kill(os.getpid(), signal.SIGKILL)
            time.sleep(0.005)
        return rk.Case(block, rk.GroundMotion.half_sine(amplitude, 1 / frequency, duration=4.0))

    fatal.touch()
    how = {"impact_times": 3, "chunk": 20, "progress": False}
    with (
        distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        executor = client.get_executor(pure=False)
        found = simulate_many(pulse, OVER, store=store, executor=executor, **how)
    assert not fatal.exists()
    assert found.identical(simulate_many(pulse, OVER, **how))
    assert found.identical(simulate_many(pulse, OVER, store=store, **how))
